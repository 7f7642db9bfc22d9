"""Two simulators that are not the built-in one: cars that steer and lag, and one with a driving stack of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, cos, hypot, sin

from scenewright.drive.protocol import EgoMotion
from scenewright.motion.profile import Profile
from scenewright.program.types import EGO
from scenewright.roads.path import wrap_rad
from scenewright.roads.routes import Route
from scenewright.simulate.port import Capabilities, Snapshot, Start, at_pose
from scenewright.simulate.vehicles import seen
from scenewright.trace.model import ActorState

AHEAD_M, ENGINE_S, PER_M, PER_MPS = 2.0, 0.2, 1.0, 2.0


@dataclass
class Car:
    """A bicycle without slip that steers for a point ahead of it; its engine takes its time."""

    route: Route
    state: ActorState

    def follow(self, motion: Profile, time_s: float, dt_s: float) -> None:
        now, (s_m, speed_mps, accel_mpss) = self.state, motion.state(time_s)
        asked = accel_mpss + PER_MPS * (speed_mps - now.speed_mps) + PER_M * (s_m - now.s_m)
        self.drive(now.accel_mps2 + (asked - now.accel_mps2) * dt_s / ENGINE_S, dt_s)

    def drive(self, accel_mpss: float, dt_s: float) -> None:
        now = self.state
        x_m, y_m, _ = self.route.path.pose(now.s_m + AHEAD_M)
        off_rad = wrap_rad(atan2(y_m - now.y_m, x_m - now.x_m) - now.heading_rad)
        curvature = 2.0 * sin(off_rad) / hypot(x_m - now.x_m, y_m - now.y_m)
        speed_mps = max(0.0, now.speed_mps + accel_mpss * dt_s)
        driven_m = 0.5 * (now.speed_mps + speed_mps) * dt_s
        heading_rad = now.heading_rad + 0.5 * curvature * driven_m
        pose = (
            now.x_m + driven_m * cos(heading_rad),
            now.y_m + driven_m * sin(heading_rad),
            wrap_rad(now.heading_rad + curvature * driven_m),
        )
        self.state = at_pose(self.route, pose, speed_mps, (speed_mps - now.speed_mps) / dt_s, now.s_m)


class Bicycles:
    """Heroes are cars that track their motion; the ego's policy drives as in the built-in simulator."""

    capabilities = Capabilities(place_error_m=0.2, speed_error_mps=0.5)

    def reset(self, start: Start, step_s: float) -> None:
        self.start, self.step_s, self.steps = start, step_s, 0
        self.cars = {actor: Car(start.scene.routes[actor], state) for actor, state in start.first.items()}
        self.motions: Mapping[int, Profile] = {}
        self.action: float | EgoMotion = 0.0
        self.reset_ego()

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        self.motions = heroes
        self.decide()

    def step(self) -> None:
        self.move_ego()
        for hero, motion in self.motions.items():
            self.cars[hero].follow(motion, self.time_s, self.step_s)
        self.steps += 1

    def observe(self) -> Snapshot:
        return Snapshot(self.time_s, {actor: car.state for actor, car in self.cars.items()} | {EGO: self.ego_state()})

    def close(self) -> None:
        pass

    @property
    def time_s(self) -> float:
        return round(self.steps * self.step_s, 9)

    # -- the ego ------------------------------------------------------------------------------------------------------
    def reset_ego(self) -> None:
        first = self.start.first[EGO]
        self.start.ego.reset(first.s_m, first.speed_mps)

    def ego_state(self) -> ActorState:
        return self.start.ego.state

    def decide(self) -> None:
        heroes = {actor: car.state for actor, car in self.cars.items() if actor != EGO}
        self.action = self.start.ego.decide(self.time_s, seen(self.start.scene, heroes), self.step_s)

    def move_ego(self) -> None:
        self.start.ego.advance(self.action, self.step_s)


class OwnStack(Bicycles):
    """A driving stack drives the ego in there: it takes a while to be at 9 m/s, and holds that."""

    capabilities = Capabilities(drives_ego=True, place_error_m=0.2, speed_error_mps=0.5)

    def reset_ego(self) -> None:
        pass

    def ego_state(self) -> ActorState:
        return self.cars[EGO].state

    def decide(self) -> None:
        pass

    def move_ego(self) -> None:
        self.cars[EGO].drive(0.5 * (9.0 - self.ego_state().speed_mps), self.step_s)
