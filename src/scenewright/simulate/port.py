"""What a simulator is to the loop: it is reset, told how heroes are to move, stepped and looked at; found by name.

What enters: a start, and at every step the heroes' motions. What leaves: where everybody really is. Nothing here steps
anything: `builtin` is the first adapter, others come by an entry point of the group ``scenewright.simulators``, a class
without arguments. `scenewright.testing.check_simulator` is the contract as a test.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, inf, isfinite, sin
from typing import TYPE_CHECKING, NamedTuple, Protocol

from scenewright.errors import SimulatorError
from scenewright.plugins import Kind
from scenewright.program.types import EGO
from scenewright.trace.model import ActorState

if TYPE_CHECKING:
    from scenewright.motion.profile import Profile
    from scenewright.roads.grounding import Scene
    from scenewright.roads.routes import Route
    from scenewright.simulate.vehicles import EgoVehicle

GROUP = "scenewright.simulators"


def on_route(route: Route, motion: tuple[float, float, float], d_m: float = 0.0) -> ActorState:
    """Return who drives along its route, on its line or beside it, from arc length (m), speed (m/s) and m/s^2."""
    x_m, y_m, heading_rad = route.path.pose(motion[0])
    beside = (x_m - d_m * sin(heading_rad), y_m + d_m * cos(heading_rad), heading_rad)
    return ActorState(*beside, *motion[1:], motion[0], d_m)


def at_pose(
    route: Route, pose: tuple[float, float, float], speed_mps: float, accel_mps2: float, near_s_m: float
) -> ActorState:
    """Return who is at a pose in the map, sought near an arc length of its route."""
    return ActorState(*pose, speed_mps, accel_mps2, *route.path.to_frenet(*pose, near_s_m)[:2])


class Snapshot(NamedTuple):
    """Everybody at one instant, by actor id (`EGO` is the ego's); it stays as it is when the simulator goes on."""

    time_s: float
    actors: Mapping[int, ActorState]


@dataclass(frozen=True, slots=True)
class Start:
    """How a run begins; the same start may be begun again and again.

    Attributes
    ----------
    scene
        Map, routes by actor id, and who takes part.
    ego
        The policy under test on its route, for a simulator that does not drive the ego itself: `EgoVehicle.reset` it,
        then let it `decide` and `advance` in every step.
    first
        The first state of everybody, by actor id.
    """

    scene: Scene
    ego: EgoVehicle
    first: Mapping[int, ActorState]

    @classmethod
    def of(cls, scene: Scene, ego: EgoVehicle, ego_first: tuple[float, float], heroes: Mapping[int, Profile]) -> Start:
        """Return the start with the ego at an arc length (m) and speed (m/s), and heroes where their motions begin."""
        motions = {EGO: (*ego_first, 0.0)} | {hero.id: heroes[hero.id].state(0.0) for hero in scene.program.heroes}
        return cls(scene, ego, {actor: on_route(scene.routes[actor], motion) for actor, motion in motions.items()})


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What can be expected of a simulator.

    Attributes
    ----------
    drives_ego
        Whether the stack under test drives the ego in there; the policy of ``--ego`` is not asked then.
    repeatable
        Whether the same start and motions give the same run, to the last bit.
    place_error_m, speed_error_mps
        How far heroes, and an ego that its policy drives, may be from where they are told to be, and from how fast.
    """

    drives_ego: bool = False
    repeatable: bool = True
    place_error_m: float = 0.0
    speed_error_mps: float = 0.0

    def words(self) -> str:
        """Say it in a line."""
        exact = self.place_error_m == self.speed_error_mps == 0.0
        near = f"heroes within {self.place_error_m:g} m and {self.speed_error_mps:g} m/s of their motion"
        return ", ".join(
            [
                "drives the ego itself" if self.drives_ego else "drives the policy of --ego",
                "heroes exactly on their motion" if exact else near,
                "repeatable" if self.repeatable else "not repeatable",
            ]
        )


class Simulator(Protocol):
    """A world in which the ego and the heroes drive. Nothing is opened before the first `reset`.

    What goes wrong in there is a `SimulatorError`; a `PolicyError` of the ego's policy is let through.
    """

    capabilities: Capabilities

    def reset(self, start: Start, step_s: float) -> None:
        """Put everybody at `start`, at time 0; whatever was before is forgotten."""

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        """Take how heroes are to move from now on; called before every step.

        ``heroes[actor].state(time_s)`` is arc length on its route, speed and acceleration, now and in the next seconds.
        No time passes.
        """

    def step(self) -> None:
        """Let `step_s` pass."""

    def observe(self) -> Snapshot:
        """Return where everybody is; this changes nothing."""

    def close(self) -> None:
        """Give back what was opened, if anything was; may be called more than once, and whatever went wrong before."""


_OURS = {"builtin": "scenewright.simulate.builtin:BuiltIn"}
SIMULATORS: Kind[Simulator] = Kind(GROUP, _OURS, "simulator", "drives", SimulatorError, Capabilities)


def shown(simulator: Simulator, after: Callable[[], None], start: Start, since_s: float = -inf) -> Snapshot:
    """Return where everybody is after something is done; raises `SimulatorError` where nobody can drive on from it."""
    with SIMULATORS.blamed(simulator):
        after()
        now = simulator.observe()
        for actor in start.first:
            if not isinstance(state := now.actors.get(actor), ActorState) or not all(map(isfinite, state)):
                raise ValueError(f"at {now.time_s:.2f} s actor {actor} is {state}")
        if not since_s < now.time_s < inf:
            raise ValueError(f"a step from {since_s:.2f} s led to {now.time_s:.2f} s")
    return now
