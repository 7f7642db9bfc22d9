"""The paper's baseline protocol: what a driver model is told, when, and what becomes of what it says."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from scenewright.drive.protocol import EgoMotion, VehicleState
from scenewright.errors import PolicyError
from scenewright.orchestrate import set_up
from scenewright.plan.planner import Planner
from scenewright.request import Request, Stages
from scenewright.simulate.beginning import first_plan
from scenewright.simulate.loop import Rates, Run, simulate
from scenewright.simulate.port import Start
from scenewright.study.rivals import run_method
from scenewright.study.rivals.follower import FollowingHeroes
from scenewright.study.rivals.waypoints import DriverStart, SteadyFollower, View, Waypoint, WaypointDriver

HERO = 1
YIELDS = """\
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]

Constraints:
A0x(t0) == intersection - 90
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 18
A1x(t2) == conflict_point - 6
A1v(t2) == 0
"""


@dataclass
class Recorder:
    """Does what a test wants, and writes down what it is told."""

    answer: float | EgoMotion = 0.0
    starts: list[DriverStart] = field(default_factory=list)
    views: list[View] = field(default_factory=list)
    waypoints: list[Waypoint] = field(default_factory=list)

    def reset(self, start: DriverStart) -> None:
        self.starts.append(start)

    def step(self, view: View, waypoint: Waypoint, dt_s: float) -> float | EgoMotion:
        assert dt_s == 0.02
        self.views.append(view)
        self.waypoints.append(waypoint)
        return self.answer


def follow(driver: WaypointDriver, ego: str = "constant") -> tuple[Run, FollowingHeroes, Planner]:
    request = Request(YIELDS, ego=ego)
    world, _ = set_up(request, Stages(None))
    planned = first_plan(world)
    assert planned is not None
    planner, start, _ = planned
    heroes = FollowingHeroes(planner, world.limits, {HERO: driver}, 0.02)
    first = Start.of(world.scene, world.ego, (start.s_m, start.speed_mps), heroes.plan.profiles)
    return simulate(world.simulator, first, heroes, Rates(0.02, None)), heroes, planner


def test_model_takes_over_after_one_second_of_our_motion() -> None:
    driver = Recorder()
    run, _, _ = follow(driver)
    (start,) = driver.starts
    plan = run.first_plan.profiles[HERO]
    assert len(start.history) == len(start.others["ego"]) == 51
    for index, state in enumerate(start.history):
        assert (state.s_m, state.speed_mps) == pytest.approx(plan.state(index * 0.02)[:2])
    assert driver.views[0].time_s == pytest.approx(1.0)
    hero = run.trace.actors["hero"]
    assert np.ptp(hero.speed_mps[50:]) < 1e-9  # it holds its speed from then on, whatever the plan says


def test_waypoints_are_four_seconds_ahead_and_come_once_a_second() -> None:
    driver = Recorder()
    run, _, _ = follow(driver)
    issued = [driver.waypoints[0]]
    moments = [driver.views[0].time_s]
    for view, waypoint in zip(driver.views, driver.waypoints, strict=True):
        if waypoint is not issued[-1]:
            issued.append(waypoint)
            moments.append(view.time_s)
    assert moments == pytest.approx(np.arange(1.0, 1.0 + len(moments)))
    assert [waypoint.time_s for waypoint in issued] == pytest.approx([moment + 4.0 for moment in moments])
    # With an ego that does as foreseen, the first is where the first plan has the hero.
    path = run.first_plan.profiles[HERO]
    assert issued[0].time_s == 5.0
    assert path.state(5.0)[0] > 0.0


def test_solver_is_asked_once_a_second_from_where_the_hero_is() -> None:
    run, _, planner = follow(Recorder(answer=-0.4))
    asked = [record for record in planner.records[1:] if record.backend]
    assert [record.time_s for record in asked[:3]] == pytest.approx([1.0, 2.0, 3.0])
    # The last plan begins in the state that the hero really had then, not in the planned one, and holds what it drove.
    found, hero = asked[-1].time_s, run.trace.actors["hero"]
    for time_s in (0.5 * found, found):
        assert planner.plan.profiles[HERO].state(time_s)[0] == pytest.approx(hero.position(time_s), abs=1e-3)
    assert abs(hero.position(found) - run.first_plan.profiles[HERO].state(found)[0]) > 0.2


def test_model_sees_others_without_their_intentions() -> None:
    driver = Recorder()
    follow(driver)
    for view in driver.views:
        (ego,) = view.others
        assert ego.name == "ego"
        assert (ego.s_m, ego.route) == (None, None)
        assert view.own.route is not None


def test_what_a_car_cannot_do_is_cut() -> None:
    run, _, _ = follow(Recorder(answer=50.0))
    hero = run.trace.actors["hero"]
    assert float(hero.accel_mps2.max()) <= 4.0 + 1e-9
    run, _, _ = follow(Recorder(answer=-50.0))
    hero = run.trace.actors["hero"]
    assert float(hero.accel_mps2.min()) >= -8.0 - 1e-9
    assert float(hero.speed_mps.min()) == 0.0


def test_a_model_that_returns_no_number_is_told() -> None:
    run, _, _ = follow(Recorder(answer=float("nan")))
    assert run.status == "failed"
    assert "the driver model returned no motion at 1.0" in str(run.fault)


def test_a_motion_counts_by_its_speed() -> None:
    run, _, _ = follow(Recorder(answer=EgoMotion(0.0, 0.0, 0.0, 3.0)))
    hero = run.trace.actors["hero"]
    assert float(hero.speed_mps[-1]) == pytest.approx(3.0)


def test_shipped_driver_is_at_its_waypoint_in_time() -> None:
    run, heroes, _ = follow(Recorder())
    scene_route = heroes._scene.routes[HERO]
    driver = SteadyFollower()
    driver.reset(DriverStart(scene_route, heroes._scene.road_map, (), {}, 0.02, 0))
    s_m, speed = 20.0, 8.0
    waypoint = Waypoint(*scene_route.path.pose(60.0), 4.0)
    for step in range(200):
        own = VehicleState("hero", 0.0, 0.0, 0.0, speed, 0.0, 4.5, 1.9, s_m=s_m, route=scene_route)
        accel = driver.step(View(step * 0.02, own, ()), waypoint, 0.02)
        s_m, speed = s_m + speed * 0.02 + 0.5 * accel * 0.02**2, speed + accel * 0.02
    assert s_m == pytest.approx(60.0, abs=0.5)
    assert run.status == "finished"


def test_a_model_of_ones_own_is_plugged_in_by_its_name() -> None:
    name = "scenewright.study.rivals.waypoints:SteadyFollower"
    ours, theirs = run_method("follower", Request(YIELDS)), run_method(f"follower:{name}", Request(YIELDS))
    assert ours.run is not None
    assert theirs.run is not None
    assert np.array_equal(ours.run.trace.actors["hero"].s_m, theirs.run.trace.actors["hero"].s_m)
    gentle = run_method(f"follower:{name}:brake_mpss=1.0", Request(YIELDS))
    assert gentle.run is not None
    assert float(gentle.run.trace.actors["hero"].accel_mps2[60:].min()) >= -1.0 - 1e-9


def test_a_model_that_is_not_there_is_refused() -> None:
    with pytest.raises(PolicyError):
        run_method("follower:nowhere:Model", Request(YIELDS))
