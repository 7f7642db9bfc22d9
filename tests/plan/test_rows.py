"""What a plan owes and prefers: each row is beyond zero where what it forbids is done, and only there."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from situations import HERO, Array, begun, planner_of, problem_of, scene_of

from scenewright.plan.problem import Problem
from scenewright.plan.rows import HeroRows, Rows
from scenewright.program.types import PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from stories import STORIES, program

YIELDS, GAP, WAITS = STORIES["yields, distance"], STORIES["brakes at a rate"], STORIES["stops and goes"]
FAINT = GAP.replace("A1a(dec) == -3", "A1a(dec) == -0.2").replace("A1v(t2) == 0", "A1v(t2) == 5")
BOUNDED = YIELDS + "always[A1(t0), A1(t1)] (A1v <= 7)\nalways[A1(t1), A1(t2)] (A1a >= -4)\n"


def hero_rows(problem: Problem, z: Array) -> HeroRows:
    hero = problem.asked.scene.program.actor(HERO)
    shot, nodes = problem.shots(z)[HERO], problem._nodes[HERO]
    return HeroRows(problem.asked, problem.now, hero, shot, problem.moments, nodes, Rows(), Rows())


def worst(problem: Problem, z: Array) -> float:
    """Return by how much the worst of a hero's bounds is broken, in units of cost."""
    rows = hero_rows(problem, z)
    rows.add_all()
    return max(rows.bounds.values)


def planned(text: str) -> tuple[Problem, Array]:
    problem = problem_of(text)
    return problem, problem.guess.copy()


def moved(problem: Problem, z: Array, **by: float) -> Array:
    """Return the values with the hero's first place, its first speed, or its accelerations in pieces changed."""
    z, start = z.copy(), dict(zip(("place", "speed"), problem._starts[HERO], strict=True))
    for what, much in by.items():
        if what in start:
            z[start[what].unknown] += much
            continue
        for leg in problem._legs[HERO]:
            if leg.kind is PieceKind(what):
                z[list(leg.accels)] += much
    return z


def test_a_row_has_its_weight_and_what_is_unpleasant_counts_beyond_zero_only() -> None:
    rows = Rows()
    rows.add(2.0, np.array([1.0, -1.0]), 3.0, most=5.0)
    rows.beyond(np.array([-0.1, 0.5]), np.array([[5.0, 5.0], [1.0, 0.0]]), 2.0)
    assert rows.values.tolist() == [6.0, 1.0]
    assert rows.slopes.tolist() == [[3.0, -3.0], [2.0, 0.0]]
    assert rows.most.tolist() == [5.0, float("inf")]


@pytest.mark.parametrize("text", [YIELDS, GAP, WAITS, BOUNDED, FAINT])
def test_a_good_plan_breaks_no_bound_by_much(text: str) -> None:
    problem, z = planned(text)
    assert worst(problem, z) < 2.0


@pytest.mark.parametrize(
    ("text", "by"),
    [
        (YIELDS, {"speed": -20.0}),  # backwards
        (YIELDS, {"speed": 15.0}),  # faster than the road allows
        (YIELDS, {"dec": 2.5}),  # it does hardly brake
        (YIELDS, {"go": -2.0}),  # it brakes before it is to
        (GAP, {"place": -25.0}),  # inside the ego
        (BOUNDED, {"speed": 4.0}),  # faster than this program allows
        (BOUNDED, {"dec": -5.0}),  # harder than this program allows
    ],
)
def test_what_is_forbidden_costs(text: str, by: dict[str, float]) -> None:
    problem, z = planned(text)
    assert worst(problem, moved(problem, z, **by)) > 5.0 + max(0.0, worst(problem, z))


@pytest.mark.parametrize(("top_mps", "broken"), [(6.8, False), (7.6, True)])
def test_a_narrower_law_is_kept_where_it_holds(top_mps: float, broken: bool) -> None:
    problem, z = planned(BOUNDED)
    fastest_mps = float(max(problem.shots(z)[HERO].v))
    rows = hero_rows(problem, moved(problem, z, speed=top_mps - fastest_mps))
    for span in rows._spans():
        rows._narrowed(*span)
    assert bool(max(rows.bounds.values) > 30.0) == broken


def test_in_the_ego_s_way_nobody_waits_for_it() -> None:
    problem, z = planned(YIELDS)
    shot, zone_m = problem.shots(z)[HERO], problem.asked.zones_m[HERO]
    trigger = problem.asked.trigger(HERO)
    assert trigger is not None
    there_m = float(shot.s[shot.first_node[problem._nodes[HERO][trigger]]])
    for beyond_m in (-1.0, 1.0):
        rows = hero_rows(problem, moved(problem, z, place=zone_m + beyond_m - there_m))
        rows._before_trigger()
        evenly = [k for k, most in enumerate(rows.bounds.most) if most < 100.0]
        assert max(rows.bounds.values[k] for k in evenly) == pytest.approx(
            beyond_m * problem.asked.wanted.out_of_way_price, abs=0.1
        )


@given(shorter_s=st.floats(0.0, 5.0))
def test_pieces_last_long_enough_to_be_seen(shorter_s: float) -> None:
    problem, z = planned(WAITS)
    asked, knots = problem.asked, problem.asked.scene.program.actor(HERO).sketch.knots
    stands, goes = (problem.moments[asked.knot(HERO, name)].unknown for name in knots[2:4])
    assert stands is not None
    assert goes is not None
    z[goes] = max(z[goes] - shorter_s, z[stands] + 0.05)
    rows = hero_rows(problem, z)
    rows._pieces()
    lasts_s = z[goes] - z[stands]
    assert (max(rows.bounds.values) > 1e-9) == (lasts_s < asked.wanted.shortest_stand_s - 1e-9)


def test_who_stands_is_not_to_move() -> None:
    problem, z = planned(WAITS)
    found = {}
    for name, values in {"stands": z, "rolls": moved(problem, z, speed=0.5)}.items():
        rows = hero_rows(problem, values)
        rows._pieces()
        found[name] = max(abs(value) for value in rows.costs.values)
    assert found["rolls"] > found["stands"] + 100.0


def test_an_even_motion_is_more_pleasant_than_a_jerky_one() -> None:
    problem, z = planned(YIELDS)
    jerky, legs = z.copy(), problem._legs[HERO]
    for k, accel in enumerate(legs[0].accels):
        jerky[accel] += 0.8 * (-1) ** k
    costs = []
    for values in (z, jerky):
        rows = hero_rows(problem, values)
        rows._comfort()
        costs.append(sum(value**2 for value in rows.costs.values))
    assert costs[1] > 2.0 * costs[0] + 1.0


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_two_on_one_lane_are_apart_before_the_trigger(side: float) -> None:
    text = GAP if side > 0 else GAP.replace("gap(A0, A1, t1)", "gap(A1, A0, t1)")
    planner = begun(text)
    hero, ego = planner.plan.profiles[HERO], planner.plan.profiles[0]
    trigger_s = hero.knot_times_s["t1"]
    problem, z = planned(text)
    offset_m = problem.now.on_lane[HERO].offset_m
    assert problem.now.on_lane[HERO].side == side
    for time_s in np.linspace(0.0, trigger_s, 50):
        room_m = side * (hero.state(float(time_s))[0] + offset_m - ego.state(float(time_s))[0])
        assert room_m > VEHICLE_LENGTH_M
    rows = hero_rows(problem, moved(problem, z, place=-side * 30.0))
    rows._before_trigger()
    assert max(rows.bounds.values) > 30.0


def test_who_is_waited_for_can_be_waited_for() -> None:
    """Long before its trigger, of which the ego decides, a hero is where it could still stop and set off again."""
    problem = problem_of(YIELDS, s_m=100.0)
    z, trigger = problem.guess, problem.asked.trigger(HERO)
    assert HERO in problem.now.triggers_s
    assert trigger is not None
    shot = problem.shots(z)[HERO]
    node = shot.first_node[problem._nodes[HERO][trigger]]
    assert float(shot.time[node]) > 6.0
    # It is at its place almost at once: it could not set off any more to be as fast there.
    rest_m = float(shot.s[node] - shot.s[0]) - 0.5
    early = moved(problem, z, place=rest_m, speed=-rest_m / float(shot.time[node]))
    found = []
    for values in (z, early):
        rows = hero_rows(problem, values)
        rows._before_trigger()
        found.append(max(rows.bounds.values))
    assert found[0] < 3.0
    assert found[1] > found[0] + 5.0


@pytest.mark.parametrize(("lead_m", "past_m"), [(40, 45), (30, 30), (30, 45)])
def test_nobody_begins_faster_than_the_bend_that_it_begins_in_allows(lead_m: int, past_m: int) -> None:
    """Its first state is free, and a part of its motion as any other: it began with 14 m/s where 8.6 goes."""
    asked = f"A0(t1) == A1(t1)\nA0x(t1) == stop_line - 30\nA1x(t1) == turn_end + {past_m}\nA1v(t1) >= 9\nA1v(t2) == 3\n"
    scene = scene_of(program("E, N", "t0, go, t1, dec, t2", asked))
    planner = planner_of(scene)
    hero = planner.begin((0.0, scene.landmarks_m[0]["stop_line"] - 30.0 - lead_m, 13.9, 0.0)).plan.profiles[1]
    s_m, speed_mps, _ = hero.state(0.0)
    assert abs(scene.routes[1].path.curvature(s_m)) * speed_mps**2 <= 6.0


def test_nobody_begins_within_the_junction_though_no_trigger_tells_where_it_is() -> None:
    scene = scene_of(program("W", "t0, go, t1, dec, t2", "A1v(3) == 8\nA1v(6) == 4\nA1(t1) >= 3.5\nA1(t1) <= 4\n"))
    planner = planner_of(scene)
    hero = planner.begin((0.0, 189.0, 13.9, 0.0)).plan.profiles[1]
    assert hero.state(0.0)[0] <= scene.landmarks_m[1]["junction_start"] + 0.01
