"""The ego as its policy drives it, in any simulator that does not drive it itself, and what it sees of others.

What enters: a policy's accelerations or motions. What leaves: the ego's state after each step, along its route.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoMotion, EgoStart, Observation, VehicleState
from scenewright.motion.limits import DEFAULT_SPEED_LIMIT_MPS
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.grounding import Scene
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route
from scenewright.simulate.port import at_pose, on_route
from scenewright.trace.model import ActorState


@dataclass(slots=True)
class EgoVehicle:
    """The ego: a policy on a route; the acceleration of its state is what was decided last."""

    policy: GuardedPolicy
    route: Route
    road_map: RoadMap
    seed: int = 0
    state: ActorState = field(init=False)

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
        self.state = on_route(self.route, (s_m, speed_mps, 0.0))
        self.policy.reset(self.start_at(s_m, speed_mps))

    def decide(self, time_s: float, others: tuple[VehicleState, ...], dt_s: float) -> float | EgoMotion:
        """Ask the policy what it does in the next step, known from now on; beyond its road it drives straight on."""
        now, length_m = self.state, self.route.path.length_m
        seen_now = Observation(time_s, _seen("ego", now, now.s_m, self.route), others)
        action = self.policy.step(seen_now, dt_s) if now.s_m < length_m else 0.0
        if isinstance(action, EgoMotion):
            accel_mpss = (action.speed_mps - now.speed_mps) / dt_s
        else:
            # A vehicle that stands does not roll back.
            accel_mpss = max(action, -now.speed_mps / dt_s)
        self.state = now._replace(accel_mps2=accel_mpss)
        return action

    def advance(self, action: float | EgoMotion, dt_s: float) -> None:
        """Carry out one step."""
        s_m, d_m, before_mps, accel_mpss = self.state.s_m, self.state.d_m, self.state.speed_mps, self.state.accel_mps2
        if isinstance(action, EgoMotion):
            pose = (action.x_m, action.y_m, action.heading_rad)
            self.state = at_pose(self.route, pose, action.speed_mps, accel_mpss, s_m)
            return
        speed_mps = max(0.0, before_mps + accel_mpss * dt_s)
        # Who has left the line of its route by a motion of its own is not put back onto it: it goes on beside it.
        way_m = 0.5 * (before_mps + speed_mps) * dt_s
        # Beyond the centre of a bend there is no way along it; the floor keeps it going.
        s_m += way_m / max(0.1, 1.0 - self.route.path.curvature(s_m + 0.5 * way_m) * d_m) if d_m else way_m
        self.state = on_route(self.route, (s_m, speed_mps, accel_mpss), d_m)


def seen(scene: Scene, heroes: Mapping[int, ActorState]) -> tuple[VehicleState, ...]:
    """Return heroes as the ego's policy sees them, those that there are: where they are, not where they are going."""
    return tuple(_seen(hero.name, heroes[hero.id]) for hero in scene.program.heroes if hero.id in heroes)


def _seen(name: str, state: ActorState, s_m: float | None = None, route: Route | None = None) -> VehicleState:
    return VehicleState(name, *state[:5], VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, s_m, route)
