"""The paper's baseline: a driver model that follows the waypoint our plan gives 4 s ahead, re-issued at 1 Hz.

What enters: a planner with its first plan, driver models, and the ego's state after every step. What leaves: motions.
For the first second the hero does what the plan says, which warms the model up. From then on the solver is asked once a
second, from where the hero really is, and what the model does with its waypoint is its own affair.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isfinite

from scenewright.drive.protocol import EgoMotion, VehicleState
from scenewright.errors import PolicyError
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.plan.planner import Planner, Replan
from scenewright.plan.prediction import EgoSample
from scenewright.program.types import EGO, Actor
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.grounding import Scene
from scenewright.roads.turns import TurnSpan
from scenewright.solve.plan import Plan
from scenewright.study.rivals.script import top_speed_mps
from scenewright.study.rivals.waypoints import DriverStart, View, Waypoint, WaypointDriver

WARM_UP_S = 1.0
ISSUE_EVERY_S = 1.0
AHEAD_S = 4.0
_ROUNDING_S = 1e-6


@dataclass(slots=True)
class _Vehicle:
    """A hero on its way: its driver, what it drove so far, and where it is to be."""

    actor: Actor
    limits: Limits
    turn: TurnSpan | None
    driver: WaypointDriver
    history: list[VehicleState]
    motion: Profile
    waypoint: Waypoint | None = None


class FollowingHeroes:
    """Heroes driven by driver models; `simulate.loop.HeroDriver` says what the attributes are.

    Parameters
    ----------
    planner
        Holds the first plan.
    drivers
        A driver model for each hero id.
    step_s
        The simulator's step.
    seed
        Handed to the driver models.
    """

    def __init__(
        self,
        planner: Planner,
        limits: Mapping[int, Limits],
        drivers: Mapping[int, WaypointDriver],
        step_s: float,
        seed: int = 0,
    ) -> None:
        self.plan: Plan = planner.plan
        self._planner, self._step_s, self._seed = planner, step_s, seed
        self._scene: Scene = planner.scene
        self._vehicles = {
            hero.id: _Vehicle(
                hero,
                limits[hero.id],
                TurnSpan.of(self._scene.routes[hero.id]),
                drivers[hero.id],
                [],
                planner.plan.profiles[hero.id],
            )
            for hero in self._scene.program.heroes
        }
        self._ego_history: list[VehicleState] = []
        self._issued_s = 0.0
        self._remember((0.0, *planner.plan.profiles[EGO].state(0.0)))

    @property
    def ego_knots_s(self) -> dict[str, float]:
        """When the ego passed its knots."""
        return self._planner.ego_knots_s

    @property
    def records(self) -> list[Replan]:
        """What every re-solve came to."""
        return self._planner.records

    def tick(self, time_s: float) -> Replan:
        """Return the last record: this method keeps its own time."""
        return self.records[-1]

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego; once a second, solve again and issue waypoints; let the models drive the next step."""
        time_s = sample[0]
        self._planner.observe(sample)
        self._remember(sample)
        if time_s < WARM_UP_S - _ROUNDING_S:
            return
        if time_s >= self._issued_s + ISSUE_EVERY_S - _ROUNDING_S:
            self._issue(time_s)
        for vehicle in self._vehicles.values():
            vehicle.motion = self._driven_on(vehicle, time_s)
        self.plan = replace(
            self._planner.plan,
            profiles={
                **self._planner.plan.profiles,
                **{hero: vehicle.motion for hero, vehicle in self._vehicles.items()},
            },
        )

    # -- waypoints --------------------------------------------------------------------------------------------------
    def _issue(self, time_s: float) -> None:
        first = self._issued_s == 0.0
        self._issued_s = time_s
        self._solve(time_s)
        for hero, vehicle in self._vehicles.items():
            s_m = self._planner.plan.profiles[hero].state(time_s + AHEAD_S)[0]
            route = self._scene.routes[hero]
            vehicle.waypoint = Waypoint(*route.path.pose(min(s_m, route.path.length_m)), time_s + AHEAD_S)
            if first:
                vehicle.driver.reset(self._start(vehicle))

    def _solve(self, time_s: float) -> None:
        """Ask for a plan from where the heroes are."""
        plan = self._planner.plan
        here = {hero: self._from_here(vehicle, time_s) for hero, vehicle in self._vehicles.items()}
        self._planner.plan = replace(plan, profiles={**plan.profiles, **here})
        self._planner.tick(time_s)

    def _from_here(self, vehicle: _Vehicle, time_s: float) -> Profile:
        """Return the plan as it is, but for a hero before its trigger what it drove, and what it planned from there."""
        hero = vehicle.actor
        planned = self._planner.plan.profiles[hero.id]
        knot = self._planner.structure.trigger_knot(hero.id)
        trigger_s = planned.knot_times_s.get(knot or "", 0.0)
        if trigger_s <= time_s:
            return planned
        onward = []
        s_m, speed_mps, _ = vehicle.motion.state(time_s)
        for segment in planned.cut(time_s).segments:
            onward.append(replace(segment, s_m=s_m, speed_mps=speed_mps))
            s_m, speed_mps = onward[-1].end_s_m, onward[-1].end_speed_mps
        return Profile((*_driven(vehicle.motion, time_s), *onward), planned.knot_times_s)

    # -- driving ----------------------------------------------------------------------------------------------------
    def _driven_on(self, vehicle: _Vehicle, time_s: float) -> Profile:
        own, limits = vehicle.history[-1], vehicle.limits
        assert vehicle.waypoint is not None
        assert own.s_m is not None
        others = tuple(v.history[-1] for v in self._vehicles.values() if v is not vehicle)
        view = View(time_s, own, (self._ego_history[-1], *(_unrouted(other) for other in others)))
        action = vehicle.driver.step(view, vehicle.waypoint, self._step_s)
        accel = (action.speed_mps - own.speed_mps) / self._step_s if isinstance(action, EgoMotion) else float(action)
        if not isfinite(accel):
            fix = "return a number from step() in every case"
            raise PolicyError(f"the driver model returned no motion at {time_s:.2f} s", found=str(action), fix=fix)
        top = top_speed_mps(limits, vehicle.turn, own.s_m + own.speed_mps * self._step_s)
        accel = min(accel, limits.accel_max_mpss, (top - own.speed_mps) / self._step_s)
        accel = max(accel, -limits.brake_max_mpss, -own.speed_mps / self._step_s)
        knots = self._planner.plan.profiles[vehicle.actor.id].knot_times_s
        step = Segment(time_s, self._step_s, own.s_m, own.speed_mps, accel)
        return Profile((*_driven(vehicle.motion, time_s), step), knots)

    # -- what was seen ----------------------------------------------------------------------------------------------
    def _remember(self, sample: EgoSample) -> None:
        time_s, s_m, speed, accel = sample
        self._ego_history.append(_unrouted(self._state(self._scene.program.ego, s_m, speed, accel)))
        for vehicle in self._vehicles.values():
            s_m, speed, _ = vehicle.motion.state(time_s)
            accel = vehicle.motion.state(time_s - _ROUNDING_S)[2]  # what comes next is for the model to say
            vehicle.history.append(self._state(vehicle.actor, s_m, speed, accel))

    def _state(self, actor: Actor, s_m: float, speed: float, accel: float) -> VehicleState:
        route = self._scene.routes[actor.id]
        pose = route.path.pose(s_m)
        return VehicleState(
            actor.name, *pose, speed, accel, VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, s_m=s_m, route=route
        )  # fmt: skip

    def _start(self, vehicle: _Vehicle) -> DriverStart:
        others = {v.actor.name: tuple(_unrouted(s) for s in v.history) for v in self._vehicles.values()}
        others[self._scene.program.ego.name] = tuple(self._ego_history)
        del others[vehicle.actor.name]
        route = self._scene.routes[vehicle.actor.id]
        return DriverStart(route, self._scene.road_map, tuple(vehicle.history), others, self._step_s, self._seed)


def _driven(motion: Profile, until_s: float) -> list[Segment]:
    """Return what was driven of a motion up to a time."""
    begun = [segment for segment in motion.segments if segment.start_s < until_s - _ROUNDING_S]
    if begun and begun[-1].end_s > until_s + _ROUNDING_S:
        begun[-1] = begun[-1].part(begun[-1].start_s, until_s)
    return begun


def _unrouted(state: VehicleState) -> VehicleState:
    """Return a vehicle as others see it."""
    return replace(state, s_m=None, route=None)
