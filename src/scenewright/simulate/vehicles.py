"""The ego as its policy drives it, in any simulator that does not drive it itself, and what it sees of others.

What enters: a policy's accelerations or motions. What leaves: the ego's state after each step, along its route.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoMotion, EgoStart, Observation, VehicleState
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.grounding import Scene
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route
from scenewright.simulate.port import ActorState
from scenewright.solve.limits import DEFAULT_SPEED_LIMIT_MPS


@dataclass(slots=True)
class EgoVehicle:
    """The ego: a policy on a route. State is arc length, lateral offset, speed and acceleration."""

    policy: GuardedPolicy
    route: Route
    road_map: RoadMap
    seed: int = 0
    s_m: float = 0.0
    d_m: float = 0.0
    speed_mps: float = 0.0
    accel_mpss: float = 0.0
    _pose: tuple[float, float, float] = field(init=False, default=(0.0, 0.0, 0.0))

    def start_at(self, s_m: float, speed_mps: float) -> EgoStart:
        """Return what the policy is told when it starts in this state."""
        return EgoStart(
            self.route,
            self.road_map,
            s_m,
            speed_mps,
            self.road_map.lanes[self.route.lanes[0]].speed_limit_mps or DEFAULT_SPEED_LIMIT_MPS,
            self.seed,
            VEHICLE_LENGTH_M,
            VEHICLE_WIDTH_M,
        )

    def reset(self, s_m: float, speed_mps: float) -> None:
        """Put the ego at a state and start its policy there."""
        self.s_m, self.speed_mps = s_m, speed_mps
        self.d_m = self.accel_mpss = 0.0
        self._pose = self.route.path.pose(s_m)
        self.policy.reset(self.start_at(s_m, speed_mps))

    @property
    def state(self) -> ActorState:
        """Where it is; its acceleration is what was decided last."""
        return ActorState(*self._pose, self.speed_mps, self.accel_mpss, self.s_m, self.d_m)

    def decide(self, time_s: float, others: tuple[VehicleState, ...], dt_s: float) -> float | EgoMotion:
        """Ask the policy what it does in the next step; its acceleration is known from now on."""
        action = self.policy.step(Observation(time_s, _seen("ego", self.state, self.s_m, self.route), others), dt_s)
        if isinstance(action, EgoMotion):
            self.accel_mpss = (action.speed_mps - self.speed_mps) / dt_s
        else:
            # A vehicle that stands does not roll back.
            self.accel_mpss = max(action, -self.speed_mps / dt_s)
        return action

    def advance(self, action: float | EgoMotion, dt_s: float) -> None:
        """Carry out one step."""
        if isinstance(action, EgoMotion):
            self._pose = (action.x_m, action.y_m, action.heading_rad)
            self.s_m, self.d_m, _ = self.route.path.to_frenet(*self._pose, self.s_m)
            self.speed_mps = action.speed_mps
            return
        speed = max(0.0, self.speed_mps + self.accel_mpss * dt_s)
        self.s_m += 0.5 * (self.speed_mps + speed) * dt_s
        self.speed_mps = speed
        self._pose = self.route.path.pose(self.s_m)


def seen(scene: Scene, heroes: Mapping[int, ActorState]) -> tuple[VehicleState, ...]:
    """Return the heroes as the ego's policy sees them: where they are, not where they are going."""
    return tuple(_seen(hero.name, heroes[hero.id]) for hero in scene.program.heroes)


def _seen(name: str, state: ActorState, s_m: float | None = None, route: Route | None = None) -> VehicleState:
    return VehicleState(name, *state[:5], VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, s_m, route)
