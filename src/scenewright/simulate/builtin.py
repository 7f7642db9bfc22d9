"""The built-in simulator: the ego as its policy drives it, heroes exactly where they are to be.

What enters: a start and the heroes' motions. What leaves: everybody's states. There are no bodies that could collide.
"""

from __future__ import annotations

from collections.abc import Mapping

from scenewright.drive.protocol import EgoMotion
from scenewright.motion.profile import Profile
from scenewright.program.types import EGO
from scenewright.simulate.port import Capabilities, Snapshot, Start, on_route
from scenewright.simulate.vehicles import seen


class BuiltIn:
    """The first adapter of `port.Simulator`."""

    capabilities = Capabilities()

    def reset(self, start: Start, step_s: float) -> None:
        """Put everybody at `start`, and start the ego's policy there."""
        self._scene, self._ego, self._step_s, self._steps = start.scene, start.ego, step_s, 0
        self._heroes = {actor: state for actor, state in start.first.items() if actor != EGO}
        self._motions: Mapping[int, Profile] = {}
        self._action: float | EgoMotion = 0.0
        first = start.first[EGO]
        self._ego.reset(first.s_m, first.speed_mps)

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        """Take the heroes' motions, and ask the ego's policy, which sees where heroes are now."""
        self._motions = heroes
        self._place_heroes()
        self._action = self._ego.decide(self._time_s, seen(self._scene, self._heroes), self._step_s)

    def step(self) -> None:
        """Move everybody by a step."""
        self._ego.advance(self._action, self._step_s)
        self._steps += 1
        self._place_heroes()

    def observe(self) -> Snapshot:
        """Return where everybody is."""
        return Snapshot(self._time_s, {EGO: self._ego.state, **self._heroes})

    def close(self) -> None:
        """Do nothing: nothing was opened."""

    @property
    def _time_s(self) -> float:
        return round(self._steps * self._step_s, 9)

    def _place_heroes(self) -> None:
        routes, now_s = self._scene.routes, self._time_s
        self._heroes = {hero: on_route(routes[hero], m.state(now_s)) for hero, m in self._motions.items()}
