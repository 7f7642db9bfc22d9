"""A plan: one concrete motion for each orchestrated actor, and what it promises.

What enters: profiles. What leaves: a `Plan` that can be carried out, checked against the program, and written as data.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field

from scenewright.motion.profile import Profile
from scenewright.program.expressions import Order
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene

SCHEMA_VERSION = 1
_SAME_MOMENT_S = 1e-6


@dataclass(frozen=True, slots=True)
class Plan:
    """Motions by actor id; for the ego what was predicted. `tolerance` is the worst miss, in tight tolerances."""

    profiles: Mapping[int, Profile]
    tolerance: float = 0.0
    parameters: Mapping[str, float] = field(default_factory=dict)

    def as_dict(self, scene: Scene) -> dict[str, object]:
        """Return the plan as plain data (`plan.json`)."""
        actors: dict[str, object] = {}
        for actor_id, profile in sorted(self.profiles.items()):
            actor = scene.program.actor(actor_id)
            names = actor.sketch.piece_names()
            knots = [
                {"name": knot, "time_s": at_s, "s_m": s_m, "speed_mps": speed_mps}
                for knot, at_s in profile.knot_times_s.items()
                for s_m, speed_mps, _ in [profile.state(at_s)]
            ]
            pieces = (names[each.piece] if 0 <= each.piece < len(names) else "go" for each in profile.segments)
            segments = [asdict(each) | {"piece": piece} for each, piece in zip(profile.segments, pieces, strict=True)]
            actors[actor.name] = {"knots": knots, "segments": segments}
        return {"schema_version": SCHEMA_VERSION, "tolerance": self.tolerance, "actors": actors}


@dataclass(slots=True)
class PlanWorld:
    """Evaluates terms of the program on the profiles of a plan (see `program.evaluate.World`)."""

    scene: Scene
    profiles: Mapping[int, Profile]
    parameters: Mapping[str, float]
    between_m: float = VEHICLE_LENGTH_M

    def state(self, actor: int, order: Order, time_s: float) -> float:
        """Return position, speed or acceleration of `actor` at an instant; at its last knot that of what ends there."""
        profile = self.profiles[actor]
        last = self.scene.program.actor(actor).sketch.knots[-1]
        if order == 2 and abs(time_s - profile.knot_times_s.get(last, math.inf)) < _SAME_MOMENT_S:
            time_s -= 2 * _SAME_MOMENT_S
        return profile.state(time_s)[order]

    def knot_time_s(self, actor: int, knot: str) -> float:
        """Return when `actor` passes `knot`; infinite where it is not known to."""
        return self.profiles[actor].knot_times_s.get(knot, math.inf)

    def changes_s(self) -> Sequence[float]:
        """Return the instants at which some motion changes."""
        return [segment.start_s for profile in self.profiles.values() for segment in profile.segments]
