"""The vehicles of the built-in simulator: the ego as its policy drives it, and what others see.

What enters: a policy's accelerations or motions. What leaves: the ego's state after each step, along its route.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoMotion, EgoStart, Observation, VehicleState
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route
from scenewright.solve.limits import DEFAULT_SPEED_LIMIT_MPS


@dataclass(slots=True)
class EgoVehicle:
    """The ego: a policy on a route. State is arc length, lateral offset, heading error, speed and acceleration."""

    policy: GuardedPolicy
    route: Route
    road_map: RoadMap
    seed: int = 0
    s_m: float = 0.0
    d_m: float = 0.0
    heading_error_rad: float = 0.0
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
        self.d_m = self.heading_error_rad = self.accel_mpss = 0.0
        self._pose = self.route.path.pose(s_m)
        self.policy.reset(self.start_at(s_m, speed_mps))

    def seen(self) -> VehicleState:
        """Return the ego's state as everybody sees it."""
        x_m, y_m, heading = self._pose
        return VehicleState(
            "ego", x_m, y_m, heading, self.speed_mps, self.accel_mpss, VEHICLE_LENGTH_M, VEHICLE_WIDTH_M,
            self.s_m, self.route,
        )  # fmt: skip

    def decide(self, time_s: float, others: tuple[VehicleState, ...], dt_s: float) -> float | EgoMotion:
        """Ask the policy what it does in the next step; its acceleration is known from now on."""
        action = self.policy.step(Observation(time_s, self.seen(), others), dt_s)
        if isinstance(action, EgoMotion):
            self.accel_mpss = (action.speed_mps - self.speed_mps) / dt_s
        else:
            # A vehicle that stands does not roll back.
            self.accel_mpss = max(action, -self.speed_mps / dt_s)
        return action

    def advance(self, action: float | EgoMotion, dt_s: float) -> None:
        """Carry out one step."""
        if isinstance(action, EgoMotion):
            s_m, d_m, error = self.route.path.to_frenet(action.x_m, action.y_m, action.heading_rad, self.s_m)
            self.s_m, self.d_m, self.heading_error_rad = s_m, d_m, error
            self.speed_mps = action.speed_mps
            self._pose = (action.x_m, action.y_m, action.heading_rad)
            return
        speed = max(0.0, self.speed_mps + self.accel_mpss * dt_s)
        self.s_m += 0.5 * (self.speed_mps + speed) * dt_s
        self.speed_mps = speed
        self._pose = self.route.path.pose(self.s_m)

    @property
    def pose(self) -> tuple[float, float, float]:
        """Position (m) and heading (rad) in the map."""
        return self._pose
