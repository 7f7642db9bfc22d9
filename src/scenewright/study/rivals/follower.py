"""The paper's baseline: a driver model that follows the waypoint our plan gives 4 s ahead, re-issued at 1 Hz.

What enters: a replanner with its first plan, driver models, and the ego's state after every step. What leaves: motions.
For the first second the hero does what the plan says, which warms the model up. From then on the solver is asked once a
second, from where the hero really is, and what the model does with its waypoint is its own affair.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from scenewright.drive.protocol import EgoMotion, VehicleState
from scenewright.motion.profile import Profile, Segment
from scenewright.plan.prediction import EgoSample
from scenewright.program.types import EGO, Actor
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.grounding import Scene
from scenewright.simulate.replanner import Replan, Replanner
from scenewright.solve.limits import Limits
from scenewright.solve.plan import Plan
from scenewright.solve.situation import Situation
from scenewright.solve.turns import TurnSpan
from scenewright.study.rivals.script import top_speed_mps
from scenewright.study.rivals.waypoints import DriverStart, View, Waypoint, WaypointDriver

WARM_UP_S = 1.0
ISSUE_EVERY_S = 1.0
AHEAD_S = 4.0
_ROUNDING_S = 1e-6


class AskedAnew(Replanner):
    """A replanner that solves at every tick: a plan that still fits the ego may no longer fit the hero."""

    __slots__ = ()

    def _plan_still_fits(self, time_s: float, situation: Situation) -> bool:
        return False


@dataclass(slots=True)
class _Vehicle:
    """A hero on its way: its state, its driver, and where it is to be."""

    actor: Actor
    limits: Limits
    turn: TurnSpan | None
    driver: WaypointDriver
    history: list[VehicleState]
    motion: Profile
    waypoint: Waypoint | None = None


class FollowingHeroes:
    """Heroes driven by driver models; `simulate.heroes.HeroDriver` says what the attributes are.

    Parameters
    ----------
    replanner
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
        replanner: Replanner,
        limits: Mapping[int, Limits],
        drivers: Mapping[int, WaypointDriver],
        step_s: float,
        seed: int = 0,
    ) -> None:
        self.plan: Plan = replanner.plan
        self._replanner, self._step_s, self._seed = replanner, step_s, seed
        self._scene: Scene = replanner.scene
        self._vehicles = {
            hero.id: _Vehicle(
                hero,
                limits[hero.id],
                TurnSpan.of(self._scene.routes[hero.id]),
                drivers[hero.id],
                [],
                replanner.plan.profiles[hero.id],
            )
            for hero in self._scene.program.heroes
        }
        self._ego_history: list[VehicleState] = []
        self._issued_s = 0.0
        self._remember((0.0, *replanner.plan.profiles[EGO].state(0.0)))

    @property
    def ego_knots_s(self) -> dict[str, float]:
        """When the ego passed its knots."""
        return self._replanner.ego_knots_s

    @property
    def records(self) -> list[Replan]:
        """What every re-solve came to."""
        return self._replanner.records

    @property
    def is_alarmed(self) -> bool:
        """Return that nothing alarms it: this method keeps its own time."""
        return False

    def tick(self, time_s: float) -> Replan:
        """Return the last record: this method keeps its own time."""
        return self.records[-1]

    def ego_stood_s(self, time_s: float) -> float:
        """Return for how long the ego has not moved (s)."""
        return self._replanner.ego_stood_s(time_s)

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego; once a second, solve again and issue waypoints; let the models drive the next step."""
        time_s = sample[0]
        self._replanner.observe(sample)
        self._remember(sample)
        if time_s < WARM_UP_S - _ROUNDING_S:
            return
        if time_s >= self._issued_s + ISSUE_EVERY_S - _ROUNDING_S:
            self._issue(time_s)
        for vehicle in self._vehicles.values():
            vehicle.motion = self._driven(vehicle, time_s)
        self.plan = replace(
            self._replanner.plan,
            profiles={
                **self._replanner.plan.profiles,
                **{hero: vehicle.motion for hero, vehicle in self._vehicles.items()},
            },
        )

    # -- waypoints --------------------------------------------------------------------------------------------------
    def _issue(self, time_s: float) -> None:
        first = self._issued_s == 0.0
        self._issued_s = time_s
        self._solve(time_s)
        for hero, vehicle in self._vehicles.items():
            s_m = self._replanner.plan.profiles[hero].state(time_s + AHEAD_S)[0]
            route = self._scene.routes[hero]
            vehicle.waypoint = Waypoint(*route.path.pose(min(s_m, route.path.length_m)), time_s + AHEAD_S)
            if first:
                vehicle.driver.reset(self._start(vehicle))

    def _solve(self, time_s: float) -> None:
        """Ask for a plan from where the heroes are; where there is none, the last one goes on."""
        before = self._replanner.plan
        self._replanner.plan = replace(
            before, profiles={**before.profiles, **{h: self._from_here(v, time_s) for h, v in self._vehicles.items()}}
        )
        asked = self._replanner.plan
        self._replanner.tick(time_s)
        if self._replanner.plan is asked:
            self._replanner.plan = before

    def _from_here(self, vehicle: _Vehicle, time_s: float) -> Profile:
        """Return the plan as it is, but for a hero before its trigger from its real state on."""
        hero = vehicle.actor
        planned = self._replanner.plan.profiles[hero.id]
        knot = self._replanner.structure.trigger_knot(hero.id)
        trigger_s = planned.knot_times_s.get(knot or "", 0.0)
        if trigger_s <= time_s:
            return planned
        names = hero.sketch.knots[1:]
        piece = sum(1 for name in names if planned.knot_times_s.get(name, trigger_s) <= time_s)
        s_m, speed, _ = vehicle.motion.state(time_s)
        return Profile((Segment(time_s, trigger_s - time_s, s_m, speed, 0.0, piece),), planned.knot_times_s)

    # -- driving ----------------------------------------------------------------------------------------------------
    def _driven(self, vehicle: _Vehicle, time_s: float) -> Profile:
        own, limits = vehicle.history[-1], vehicle.limits
        assert vehicle.waypoint is not None
        assert own.s_m is not None
        others = tuple(v.history[-1] for v in self._vehicles.values() if v is not vehicle)
        view = View(time_s, own, (self._ego_history[-1], *(_unrouted(other) for other in others)))
        action = vehicle.driver.step(view, vehicle.waypoint, self._step_s)
        accel = (action.speed_mps - own.speed_mps) / self._step_s if isinstance(action, EgoMotion) else float(action)
        top = top_speed_mps(limits, vehicle.turn, own.s_m + own.speed_mps * self._step_s)
        accel = min(accel, limits.accel_max_mpss, (top - own.speed_mps) / self._step_s)
        accel = max(accel, -limits.brake_max_mpss, -own.speed_mps / self._step_s)
        knots = self._replanner.plan.profiles[vehicle.actor.id].knot_times_s
        return Profile((Segment(time_s, self._step_s, own.s_m, own.speed_mps, accel),), knots)

    # -- what was seen ----------------------------------------------------------------------------------------------
    def _remember(self, sample: EgoSample) -> None:
        time_s, s_m, speed, accel = sample
        self._ego_history.append(_unrouted(self._state(self._scene.program.ego, s_m, speed, accel)))
        for vehicle in self._vehicles.values():
            vehicle.history.append(self._state(vehicle.actor, *vehicle.motion.state(time_s)))

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


def _unrouted(state: VehicleState) -> VehicleState:
    """Return a vehicle as others see it."""
    return replace(state, s_m=None, route=None)
