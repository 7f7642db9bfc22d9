"""Plans: whatever the planner returns is a motion that a car can drive and that does what the program says."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from scenarios import (
    BEHIND_ITSELF,
    BOUNDED,
    BRAKES,
    NOT_YIELDING,
    ONE_SIDED,
    TOO_FAST,
    YIELDS,
    YIELDS_THEN_GOES,
    Example,
    limits_of,
    read_structure,
)
from scenewright.motion.profile import Profile, chain
from scenewright.program.evaluate import violation
from scenewright.program.manner import USUAL
from scenewright.program.printer import print_expression
from scenewright.program.structure import knots_of
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.solve.limits import ACCEL_MAX_MPSS, COUNTER, ROOM, Limits
from scenewright.solve.plan import Plan, PlanWorld
from scenewright.solve.planner import Planner, check_profiles
from scenewright.solve.reach import Prospects
from scenewright.solve.situation import HeroState, Situation

LEAST_STAND_S = float(USUAL.stricter(ROOM).stands_s)
PLANNED = (BRAKES, YIELDS, NOT_YIELDING, YIELDS_THEN_GOES, ONE_SIDED, BOUNDED)
_STEP_S = 0.001
_SLACK = 5e-3


def planner_of(scene: Scene) -> Planner:
    structure = read_structure(scene.program)
    conditions = linear_conditions(scene, structure)
    return Planner(scene, structure, limits_of(scene), Z3Backend(), conditions, budget_s=20.0)


def ego_at(speed_mps: float, s_m: float, time_s: float) -> Profile:
    """An ego that drives at one speed and is at `s_m` at `time_s`."""
    return Profile(chain(0.0, s_m - speed_mps * time_s, speed_mps, [(60.0, 0.0, 0)]))


def situation_of(scene: Scene, speed_mps: float, trigger_s: float) -> Situation:
    """The ego at one speed all along, at its trigger when asked, its later knots where the program wants them."""
    conditions = [c for c in linear_conditions(scene, read_structure(scene.program)) if set(c.weights) == {0}]
    placed = {
        knot: -(c.constant + c.weights[0][1] * speed_mps) / c.weights[0][0]
        for c in conditions
        if c.weights[0][0]
        for owner, knot in c.moments
        if owner == 0
    }
    if "t1" in placed:
        ego = ego_at(speed_mps, placed["t1"], trigger_s)
    else:
        ego = ego_at(speed_mps, placed.get("t0", scene.landmark_m(0, "intersection") - 110.0), 0.0)
    knots = {"t0": 0.0, "t1": trigger_s}
    if "t2" in placed:
        arrival = ego.time_at(placed["t2"])
        assert arrival is not None
        knots["t2"] = arrival
    return Situation(0.0, ego, knots, {}, {1: trigger_s})


def assert_drivable(profile: Profile, limits: Limits, until_s: float, scene: Scene) -> None:
    """Check at every millisecond, from positions alone where possible: nothing jumps, nothing exceeds a limit."""
    times = np.arange(profile.start_s, until_s, _STEP_S)
    states = np.array([profile.state(float(t)) for t in times])
    position, speed, accel = states.T
    assert speed.min() >= 0
    assert speed.max() <= limits.speed_max_mps + 1e-4
    assert accel.min() >= -limits.brake_max_mpss - 1e-3
    assert accel.max() <= limits.accel_max_mpss + 1e-3
    # What positions do between two samples is what the speeds say, and speeds change no faster than is allowed.
    travelled, changed = np.diff(position), np.diff(speed)
    largest = max(limits.accel_max_mpss, limits.brake_max_mpss)
    np.testing.assert_allclose(travelled, (speed[1:] + speed[:-1]) / 2 * _STEP_S, atol=largest * _STEP_S**2)
    assert abs(changed).max() <= largest * _STEP_S + 1e-6
    turn = scene.routes[1].landmarks
    if scene.routes[1].turn != "straight":
        inside = (position >= turn["turn_start"]) & (position <= turn["turn_end"])
        inside &= times >= profile.knot_times_s["t1"]
        if inside.any():
            assert speed[inside].max() <= limits.turn_speed_max_mps + 1e-3


def assert_does_what_it_should(scene: Scene, plan: Plan, ego_knots: set[str]) -> None:
    """Evaluate every constraint on the plan whose moments are known in it."""
    world = PlanWorld(scene, plan.profiles, {name: float(value) for name, value in scene.parameters.items()})
    for constraint in scene.program.constraints:
        knots = set(knots_of(constraint.formula))
        alone = {actor for actor, _ in knots} == {0}
        if alone or any(actor == 0 and knot not in ego_knots for actor, knot in knots):
            continue
        assert violation(constraint.formula, world) <= _SLACK, constraint.id


@pytest.mark.parametrize("case", PLANNED, ids=lambda case: case.name)
@pytest.mark.parametrize(("speed_mps", "trigger_s"), [(8.0, 7.0), (5.5, 10.0)])
def test_a_first_plan_is_drivable_and_does_what_it_should(case: Example, speed_mps: float, trigger_s: float) -> None:
    scene = case.scene()
    situation = situation_of(scene, speed_mps, trigger_s)
    attempt = planner_of(scene).first_plan([situation], budget_s=20.0)
    assert attempt.plan is not None, attempt.reason
    assert attempt.status == "sat"
    hero = attempt.plan.profiles[1]
    assert hero.knot_times_s["t0"] == 0.0
    assert hero.knot_times_s["t1"] == pytest.approx(trigger_s, abs=1e-6)
    assert list(hero.knot_times_s.values()) == sorted(hero.knot_times_s.values())
    assert_drivable(hero, limits_of(scene)[1], hero.end_s + 1.0, scene)
    known = set(situation.ego_knots_s) if attempt.promises_outcome else {"t0", "t1"}
    assert_does_what_it_should(scene, attempt.plan, known)


@settings(max_examples=12, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(
    case=st.sampled_from([YIELDS, BRAKES, BOUNDED]),
    faster=st.floats(-0.8, 0.8),
    now_s=st.floats(1.0, 5.0),
    ahead_m=st.floats(-2.0, 2.0),
)
def test_a_replan_goes_on_from_where_all_are(case: Example, faster: float, now_s: float, ahead_m: float) -> None:
    scene = case.scene()
    planner = planner_of(scene)
    first = situation_of(scene, 8.0, 9.0)
    plan = planner.first_plan([first], budget_s=20.0).plan
    assert plan is not None
    hero = plan.profiles[1]
    place, speed, _ = hero.state(now_s)
    ego_m, ego_speed, _ = first.ego.state(now_s)
    ego = Profile(chain(now_s, ego_m + ahead_m, ego_speed + faster, [(60.0, 0.0, 0)]))
    trigger_s = ego.time_at(first.ego.state(9.0)[0])
    assert trigger_s is not None
    state = HeroState(now_s, place, speed, 0, {"t0": 0.0}, hero)
    again = Situation(
        now_s, ego, {"t0": 0.0, "t1": trigger_s}, {1: state}, {1: trigger_s}, {1: hero.knot_times_s["t1"]}, 0.05
    )
    attempt = planner.replan([again])
    if attempt.plan is None:
        return  # a few tries a tick may be too few; what is returned must be right
    moved = attempt.plan.profiles[1]
    assert moved.start_s == pytest.approx(now_s)
    assert moved.state(now_s)[:2] == pytest.approx((place, speed), abs=1e-6)
    assert_drivable(moved, limits_of(scene)[1], moved.end_s + 1.0, scene)
    if attempt.status == "sat":
        joined = replace(attempt.plan, profiles={**attempt.plan.profiles, 0: Profile(ego.segments, again.ego_knots_s)})
        late = {c.id for c in scene.program.constraints if any(k == "t0" for _, k in knots_of(c.formula))}
        trimmed = replace(scene.program, constraints=tuple(c for c in scene.program.constraints if c.id not in late))
        assert_does_what_it_should(replace(scene, program=trimmed), joined, {"t0", "t1"})


@pytest.mark.parametrize("case", [TOO_FAST, BEHIND_ITSELF], ids=lambda case: case.name)
def test_there_is_no_exact_plan_for_what_cannot_happen(case: Example) -> None:
    scene = case.scene()
    attempt = planner_of(scene).first_plan([situation_of(scene, 8.0, 7.0)], budget_s=20.0)
    assert attempt.status in ("unsat", "relaxed")
    assert (attempt.plan is None) is (attempt.status == "unsat")
    assert attempt.plan is not None or attempt.reason


def test_the_same_situation_has_the_same_plan() -> None:
    plans = []
    for _ in range(2):
        scene = YIELDS.scene()
        plan = planner_of(scene).first_plan([situation_of(scene, 8.0, 7.0)], budget_s=20.0).plan
        assert plan is not None
        plans.append(plan.as_dict(scene))
    assert plans[0] == plans[1]


def test_a_plan_as_data() -> None:
    scene = YIELDS.scene()
    plan = planner_of(scene).first_plan([situation_of(scene, 8.0, 7.0)], budget_s=20.0).plan
    assert plan is not None
    data = plan.as_dict(scene)
    assert data["schema_version"] == 1
    hero = data["actors"]["hero"]
    assert [knot["name"] for knot in hero["knots"]] == ["t0", "t1", "t2"]
    assert {segment["piece"] for segment in hero["segments"]} == {"go", "dec"}
    for segment in hero["segments"]:
        s_m, speed, _ = plan.profiles[1].state(segment["start_s"])
        assert (segment["s_m"], segment["speed_mps"]) == pytest.approx((s_m, speed))


@settings(max_examples=20, deadline=None)
@given(
    behind_m=st.floats(4.0, 25.0),
    speed_mps=st.floats(0.0, 7.0),
    expected_s=st.floats(2.0, 9.0),
    earlier_s=st.floats(0.5, 3.0),
)
def test_a_hero_is_ready_for_an_ego_that_makes_haste_and_for_one_that_stops(
    behind_m: float, speed_mps: float, expected_s: float, earlier_s: float
) -> None:
    scene = YIELDS.scene()
    planner = planner_of(scene)
    place = scene.landmark_m(1, "conflict_point", 0) - 20.0
    past = Profile(chain(0.0, place - behind_m, speed_mps, [(0.1, 0.0, 0)]))
    state = HeroState(0.0, place - behind_m, speed_mps, 0, {"t0": 0.0}, past)
    arrival_s = max(0.6, expected_s - earlier_s)
    earliest = {1: ((0.0, arrival_s), (expected_s, expected_s))}
    ego = ego_at(3.0, scene.landmark_m(0, "stop_line") - 25.0, expected_s)
    situation = Situation(0.0, ego, {"t0": 0.0, "t1": expected_s}, {1: state}, {1: expected_s}, earliest_s=earliest)
    prospects = Prospects(scene, planner.structure, planner.limits, planner.conditions)
    for style in prospects.versions(situation, replace(COUNTER, ready=True), 0.0, gently=True):
        plan = planner._solve(situation, style, Fraction(0), 20.0)
        if not isinstance(plan, Plan):
            continue
        approach = [segment for segment in plan.profiles[1].segments if segment.piece == 0]
        for segment in approach[:-1]:
            if style.wait is not None:
                # From where it stands it gets to its place at no more than all it has, as fast as it must be.
                if segment.end_speed_mps == 0.0:
                    run_m = place - segment.end_s_m
                    assert math.sqrt(2 * limits_of(scene)[1].accel_max_mpss * run_m) >= COUNTER.trigger_speed_mps
                    assert run_m > 0.0
            else:
                assert style.waiting_place_m is not None
                stop_m = segment.end_speed_mps**2 / (2 * limits_of(scene)[1].brake_max_mpss)
                if segment.end_s < expected_s - style.sets_off_s:
                    assert segment.end_s_m + stop_m <= style.waiting_place_m + 1e-3
                left_s = np.interp(segment.end_s, [0.0, expected_s], [arrival_s, expected_s]) - segment.end_s
                reach_m = segment.end_speed_mps * left_s + 0.5 * limits_of(scene)[1].accel_max_mpss * left_s**2
                assert segment.end_s_m + reach_m >= place - 1e-3


def standing(planner: Planner, situation: Situation) -> tuple[Situation, float]:
    """Return the situation a moment after the hero has come to its stand, and when it has (s)."""
    first = planner.first_plan([situation]).plan
    assert first is not None
    profile = first.profiles[1]
    now_s = profile.knot_times_s["t2"] + 0.1
    past = {knot: profile.knot_times_s[knot] for knot in ("t0", "t1", "t2")}
    hero = HeroState(now_s, profile.state(now_s)[0], 0.0, 2, past, profile)
    after = replace(situation, time_s=now_s, heroes={1: hero}, trigger_s={})
    return after, past["t2"]


def test_one_that_is_late_goes_as_soon_and_as_hard_as_it_can() -> None:
    """It stands, and the ego will be there before it: no time is lost that another whim of the ego may give back."""
    scene = YIELDS_THEN_GOES.scene()
    planner = planner_of(scene)
    situation = situation_of(scene, 12.0, 4.0)
    after, stands_since_s = standing(planner, situation)
    plans = (planner.replan([after]).plan for _ in range(20))  # a tick makes a few tries, the next one goes on
    plan = next(each for each in plans if each is not None)
    stands_s = plan.profiles[1].knot_times_s["t3"] - stands_since_s
    assert LEAST_STAND_S <= stands_s <= LEAST_STAND_S + 0.03
    assert max(segment.accel_mpss for segment in plan.profiles[1].segments) >= 0.97 * ACCEL_MAX_MPSS


def test_one_that_is_pressed_stands_no_longer_than_can_be_seen() -> None:
    """The ego is expected late, so nothing speaks against a longer stand but that it might make haste."""
    scene = YIELDS_THEN_GOES.scene()
    stands_s, passes_s = {}, {}
    for pressed in (False, True):
        planner = planner_of(scene)
        situation = situation_of(scene, 1.5, 15.0)
        after, stands_since_s = standing(planner, situation)
        plan = planner.replan([replace(after, pressed=pressed)]).plan
        assert plan is not None
        knots_s = plan.profiles[1].knot_times_s
        stands_s[pressed], passes_s[pressed] = knots_s["t3"] - stands_since_s, knots_s["t4"]
    assert stands_s[True] < LEAST_STAND_S + 0.05 < stands_s[False]
    assert passes_s[True] < passes_s[False] - 0.2


def test_a_sliver_of_time_that_rounding_leaves_is_no_part_of_a_piece() -> None:
    scene = BRAKES.scene()
    rate = next(c for c in scene.program.constraints if "A1a(dec)" in print_expression(c.formula))

    def braking(rest_s: float) -> Profile:
        moves = [(2.0, 0.0, 0), (2.0, -3.0, 1), (rest_s, 0.0, 1)]
        return Profile(chain(0.0, 100.0, 6.0, moves), {"t0": 0.0, "t1": 2.0, "t2": 4.0 + rest_s})

    parameters = {name: float(value) for name, value in scene.parameters.items()}
    ego = ego_at(8.0, 60.0, 0.0)
    assert check_profiles(scene, {0: ego, 1: braking(7.6e-6)}, parameters, [rate], 0.0) is None
    assert check_profiles(scene, {0: ego, 1: braking(0.5)}, parameters, [rate], 0.0) is not None


@pytest.mark.parametrize(
    ("asked", "can_be"),
    [("always[1, 2] (A1v <= 9)", True), ("eventually[1, 3] (A1v <= 6)", True), ("A1v(2.0) == 40", False)],
)
def test_a_first_plan_breaks_nothing_that_is_asked_of_heroes_alone(asked: str, can_be: bool) -> None:
    scene = replace(YIELDS, text=YIELDS.text + asked + "\n").scene()
    attempt = planner_of(scene).first_plan([situation_of(scene, 8.0, 7.0)], budget_s=20.0)
    assert (attempt.plan is not None) is can_be, attempt.reason
    if attempt.plan is not None:
        world = PlanWorld(scene, attempt.plan.profiles, attempt.plan.parameters)
        assert violation(scene.program.constraints[-1].formula, world) <= 1e-3
