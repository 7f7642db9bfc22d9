"""Plans: whatever the planner returns is a motion that a car can drive and that does what the program says."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from situations import HERO, driven_on, planner_of, scene_of

from scenarios import BEHIND_ITSELF, FEASIBLE, TOO_FAST, YIELDS, Example, limits_of
from scenewright.judge.tolerance import TIGHT, dimension_of
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import begin, orchestrate
from scenewright.plan.planner import GOOD, Attempt, Planner
from scenewright.program.evaluate import violation
from scenewright.program.types import EGO
from scenewright.request import Request, Stages
from scenewright.roads.grounding import Scene
from scenewright.simulate.beginning import first_plan
from scenewright.solve.holding import not_held
from scenewright.solve.plan import Plan, PlanWorld
from scenewright.study.benchmark import benchmark_rows, draw_row
from stories import BRAKES_GAP, STOPS_AHEAD, STOPS_AND_GOES, STORIES, YIELDS_DISTANCE, program

pytestmark = pytest.mark.usefixtures("replanned_seldom")
STARTS_NEAR = program(
    "W",
    "t0, go, t1, dec, t2",
    """
gap(A0, A1, t0) == 8 m
A0v(t0) == 13
A1v(t0) == 8
A0(t1) == A1(t1)
gap(A0, A1, t1) == 20 m
A1v(t2) == 0
""",
)
STANDS_AHEAD = program(
    "W",
    "t0, stop, t1, acc, t2",
    """
A0(t1) == A1(t1)
gap(A0, A1, t1) == 25 m
A1v(t2) == 8
""",
)
NEAR_ITS_END = program(
    "W",
    "t0, go, t1, dec, t2",
    """
A0(t1) == A1(t1)
A0x(t1) == A0.route_end - 60
gap(A0, A1, t1) == 30
A1a(dec) == -1
A1v(t2) == 0
""",
)
STEP_S = 0.005
ROWS = [row for row in benchmark_rows() if row.id % 8 == 0]

PLACED = "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 60"


@cache
def planned(source: str, parameters: tuple[tuple[str, float | str], ...], ego: str) -> tuple[Scene, Attempt, Planner]:
    world, _, answer = begin(Request(source, dict(parameters), ego=ego), Stages(None))
    assert answer == "feasible"
    found = first_plan(world)
    assert found is not None
    return world.scene, found[2], found[0]


def assert_drivable(profile: Profile, limits: Limits, scene: Scene) -> None:
    """Check from positions and speeds alone where possible: nothing jumps, nothing exceeds a limit."""
    times = np.arange(profile.start_s, profile.end_s + 1.0, STEP_S)
    place, speed, accel = np.array([profile.state(float(t)) for t in times]).T
    assert speed.min() >= 0.0
    assert speed.max() <= limits.speed_max_mps + 1e-4
    assert accel.min() >= -limits.brake_max_mpss - 1e-3
    assert accel.max() <= limits.accel_max_mpss + 1e-3
    largest = max(limits.accel_max_mpss, limits.brake_max_mpss)
    travelled = (speed[1:] + speed[:-1]) / 2 * STEP_S
    np.testing.assert_allclose(np.diff(place), travelled, atol=largest * STEP_S**2)
    assert abs(np.diff(speed)).max() <= largest * STEP_S + 1e-6
    bends = np.array([abs(scene.routes[HERO].path.curvature(float(s_m))) for s_m in place[::10]])
    assert (bends * speed[::10] ** 2).max() <= limits.lateral_max_mpss + 1e-3


def broken(scene: Scene, plan: Plan) -> list[str]:
    return [str(each) for each in not_held(scene, plan.profiles, dimension_of, TIGHT.of)]


def check(scene: Scene, attempt: Attempt, limits: Limits) -> None:
    assert attempt.missed.by <= GOOD
    assert attempt.is_good
    hero = attempt.plan.profiles[HERO]
    assert hero.knot_times_s["t0"] == 0.0
    assert list(hero.knot_times_s.values()) == sorted(hero.knot_times_s.values())
    assert_drivable(hero, limits, scene)
    assert broken(scene, attempt.plan) == []


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"row {row.id}")
def test_first_plans_of_the_benchmark_do_what_they_should(row) -> None:  # type: ignore[no-untyped-def]
    scene, attempt, planner = planned(row.program_text, tuple(draw_row(row, 0, 0).items()), "idm")
    check(scene, attempt, planner.limits[HERO])


@pytest.mark.parametrize("ego", ["constant", "idm"])
@pytest.mark.parametrize("case", FEASIBLE, ids=lambda case: case.name)
def test_first_plans_of_the_examples_do_what_they_should(case: Example, ego: str) -> None:
    scene, attempt, planner = planned(case.text, tuple(case.parameters.items()), ego)
    check(scene, attempt, planner.limits[HERO])


@pytest.mark.parametrize(
    "asked",
    [
        "A1v(2.0) == 4",
        "A1x(2.0) == conflict_point - 60",
        "A1v(A0(t2)) == 0",
        "A1v(A0(t1)) >= 5",
        "always[1, 2] (A1v <= 9)",
        "eventually[1, 3] (A1v <= 6)",
        "always[A1(t0), A1(t1)] (A1v <= 5)",
        "always[A0(t1), A0(t2)] (A1v <= 5.5)",
        "always[A1(t0), A1(t1)] (A1x >= conflict_point - 60)",
        "A1a(dec) <= -3",
        "A1(t2) - A1(t1) >= 4",
        "tta(A1, conflict_point, t1) == 2.5",
        "A1v(t1) == A0v(t1) - 6",
        "A1v(t1) <= 4 or A1v(t1) >= 15",
    ],
)
def test_what_is_said_of_any_moment_or_stretch_is_held(asked: str) -> None:
    text = f"{YIELDS_DISTANCE.replace('A1x(t1) == conflict_point - 18', 'A1x(t1) <= conflict_point - 14')}"
    scene, attempt, planner = planned(f"{text}A0x(t2) == conflict_point\nprobe: {asked}\n", (), "constant")
    check(scene, attempt, planner.limits[HERO])
    world = PlanWorld(scene, attempt.plan.profiles, attempt.plan.parameters)
    assert violation(scene.program.constraint("probe").formula, world) <= 0.05


@pytest.mark.parametrize("case", [TOO_FAST, BEHIND_ITSELF], ids=lambda case: case.name)
def test_there_is_no_good_plan_for_what_cannot_happen(case: Example) -> None:
    attempt = planner_of(case.scene()).begin((0.0, 180.0, 8.0, 0.0))
    assert not attempt.is_good
    assert attempt.plan.tolerance == attempt.missed.by > 1.0


@pytest.mark.parametrize("mps", [3, 5, 12])
def test_an_ego_that_follows_is_led_to_the_distance_asked_for_however_it_starts(mps: int) -> None:
    """What a plan counts on of the ego that follows is what is foreseen of it then."""
    text = BRAKES_GAP.replace("A0(t1) == A1(t1)", f"A0v(t0) == {mps}\nA0(t1) == A1(t1)")
    scene, attempt, planner = planned(text, (), "idm")
    check(scene, attempt, planner.limits[HERO])


def test_the_same_situation_has_the_same_plan() -> None:
    scene, plans = scene_of(YIELDS_DISTANCE), []
    for _ in range(2):
        attempt = planner_of(scene).begin((0.0, 180.0, 9.0, 0.0))
        plans.append((attempt.plan.as_dict(scene), attempt.missed, attempt.steps))
    assert plans[0] == plans[1]


def test_who_is_to_pass_after_the_ego_waits_out_of_its_way() -> None:
    trigger = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 60\nA1x(t1) == conflict_point - 30\n"
    passes = "A0x(t2) == conflict_point\nA1x(t2) == conflict_point\nA1(t2) - A0(t2) == 4\n"
    planner = planner_of(scene_of(program("S, W", "t0, go, t1, go, t2", trigger + passes)))
    attempt = planner.begin((0.0, 180.0, 12.0, 0.0))
    assert attempt.is_good
    hero, ego = (attempt.plan.profiles[actor] for actor in (HERO, EGO))
    zone_m = planner._asked.zones_m[HERO]
    assert hero.knot_times_s["t1"] < ego.knot_times_s["t2"]
    assert hero.state(ego.knot_times_s["t2"])[0] <= zone_m + 0.5
    assert zone_m < hero.state(hero.knot_times_s["t2"])[0]


# -- ticks ----------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("story", STORIES)
@pytest.mark.parametrize(("faster_mps", "mpss", "now_s"), [(0.8, 0.5, 0.4), (-0.8, -0.2, 1.0), (0.5, -0.3, 2.2)])
def test_a_tick_goes_on_from_where_all_are_and_leaves_the_past(
    story: str, faster_mps: float, mpss: float, now_s: float
) -> None:
    planner = planner_of(scene_of(STORIES[story]))
    (place,) = (each for each in planner.conditions if each.moments == {(EGO, "t0")})
    per_metre, per_speed = place.weights[EGO]
    planner.begin((0.0, -(place.constant + 9.0 * per_speed) / per_metre, 9.0, 0.0))
    before = planner.plan.profiles[HERO]
    driven_on(planner, 0.0, now_s, faster_mps, mpss)
    record = planner.tick(now_s)
    after = planner.plan.profiles[HERO]
    for time_s in np.linspace(0.0, now_s, 12):
        assert after.state(float(time_s))[:2] == pytest.approx(before.state(float(time_s))[:2], abs=1e-6)
    assert planner.records[-1] is record
    assert record.time_s == now_s
    assert record.tolerance == planner.plan.tolerance
    assert (record.status == "sat") == (record.tolerance <= GOOD)
    if story.endswith("distance"):
        assert record.status == "sat"
        hero = planner.plan.profiles[HERO]
        assert planner.plan.profiles[EGO].state(hero.knot_times_s["t1"])[0] == pytest.approx(
            planner.scene.landmark_m(EGO, "conflict_point", HERO) - (30.0 if story.startswith("yields") else 40.0),
            abs=0.1,
        )
    driven_on(planner, now_s, now_s + 0.1)
    planner.tick(now_s + 0.1)  # a few steps may not have been enough for all of a plan to be exact
    assert_drivable(planner.plan.profiles[HERO], planner.limits[HERO], planner.scene)


def test_one_that_stands_goes_the_sooner_the_sooner_the_ego_comes() -> None:
    """It is to be first, whatever the ego does; how long it stands is a matter of taste."""
    passes_s = []
    for rest_s in (2.5, 9.0):
        planner = planner_of(scene_of(STOPS_AND_GOES))
        planner.begin((0.0, planner.scene.landmark_m(EGO, "stop_line") - 50.0, 2.5, 0.0))
        stands_s = planner.plan.profiles[HERO].knot_times_s["t2"]
        now_s = round(np.ceil(10.0 * (stands_s + 0.05)) / 10.0, 2)
        driven_on(planner, 0.0, now_s)
        s_m = planner._ego.samples[-1][1]
        speed_mps = (planner.scene.landmark_m(EGO, "turn_start") - s_m) / rest_s
        assert speed_mps > 0.3
        planner._ego.predictor = Known(Profile(chain(now_s, s_m, speed_mps, [(60.0, 0.0, 0)])))
        planner.tick(now_s)
        passes_s.append(planner.plan.profiles[HERO].knot_times_s["t4"])
        assert planner.plan.profiles[HERO].knot_times_s["t2"] == stands_s
    assert passes_s[0] < passes_s[1] - 0.1


class Known:
    """Foresees one motion, whatever was seen."""

    def __init__(self, motion: Profile) -> None:
        self.motion = motion

    def predict(self, history: object) -> Profile:
        return self.motion


@pytest.mark.parametrize(("s_m", "mps"), [(100.0, 9.0), (150.0, 6.0), (180.0, 9.0)])
def test_at_a_slower_pace_a_hero_comes_more_slowly_to_its_trigger(s_m: float, mps: float) -> None:
    scene = YIELDS.scene()
    limits = {actor: own if actor == EGO else own.at_pace(0.43) for actor, own in limits_of(scene).items()}
    usual = planner_of(scene)
    slow = Planner(scene, usual.structure, limits, usual._ego.predictor, usual.conditions)
    speeds = []
    for planner in (usual, slow):
        hero = planner.begin((0.0, s_m, mps, 0.0)).plan.profiles[HERO]
        speeds.append(hero.state(hero.knot_times_s["t1"])[1])
    assert speeds[1] < speeds[0] - 1.0


def test_how_somebody_begins_is_not_given_up_for_what_is_to_come() -> None:
    """From there the ego comes nearer than one likes; but the start is the most certain thing of all."""
    _, attempt, _ = planned(STARTS_NEAR, (), "constant")
    ego, lead = (attempt.plan.profiles[actor].state(0.0) for actor in (EGO, HERO))
    assert lead[0] - ego[0] == pytest.approx(8.0, abs=0.05)
    assert lead[1] == pytest.approx(8.0, abs=0.05)


def test_who_is_to_stand_until_its_trigger_stands_and_the_ego_has_to_come() -> None:
    """One that stands is not to drive at its trigger, and stands for as long as the other takes to come."""
    _, attempt, _ = planned(STANDS_AHEAD, (), "idm")
    lead = attempt.plan.profiles[HERO]
    assert lead.state(0.0)[1] == pytest.approx(0.0, abs=0.01)
    assert lead.knot_times_s["t1"] > 2.0


@pytest.mark.usefixtures("searched_less")
@pytest.mark.parametrize("ego", ["idm", "constant"])
def test_what_the_program_asks_for_is_not_given_up_for_room(ego: str) -> None:
    """Whoever is told where and how it brakes does so, even if the ego is not foreseen to answer it."""
    world, _, _ = begin(Request(STOPS_AHEAD, {}, ego=ego), Stages(None))
    found = first_plan(world)
    assert found is not None
    assert not broken(world.scene, found[2].plan)


def test_all_that_is_asked_is_planned_on_the_road_that_there_is() -> None:
    """Braking so gently takes more than is left of the road at a usual speed."""
    scene, attempt, _ = planned(NEAR_ITS_END, (), "constant")
    lead = attempt.plan.profiles[HERO]
    assert lead.state(lead.knot_times_s["t2"])[0] < scene.routes[HERO].landmarks["route_end"]
    assert not broken(scene, attempt.plan)


def test_a_speed_that_can_be_proven_to_be_had_is_planned() -> None:
    """What is kept of the highest speed is no more than what may come between two nodes."""
    asked = STANDS_AHEAD.replace("A1v(t2) == 8", "A1v(t2) == 17.9")
    scene, attempt, _ = planned(asked, (), "constant")
    assert not broken(scene, attempt.plan)


def test_triggers_come_in_the_order_of_the_ego() -> None:
    text = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2, go, t3]

Actor 1 (near):
- W
- [t0, go, t1, dec, t2]

Actor 2 (far):
- W
- [t0, go, t1, acc, t2]

Constraints:
gap(A1, A2, t0) == 20
gap(A0, A1, t0) == 50
A0(t1) == A1(t1)
gap(A0, A1, t1) == 30
A1v(t2) == 0
A0(t2) == A2(t1)
gap(A0, A2, t2) == 60
A2(t2) - A2(t1) == 3
"""
    world = begin(Request(f'scenario "two"\n{text}', ego="constant"), Stages(None))[0]
    planned = first_plan(world)
    assert planned is not None
    times = planned[2].plan.profiles[EGO].knot_times_s
    assert times["t1"] <= times["t2"] + 1e-6
    assert planned[2].is_good


@pytest.mark.parametrize("distance", ["headway(A0, A1, t1) < 1.5", "ttc(A0, A1, t1) <= 3"])
def test_a_bound_on_the_distance_to_an_ego_that_follows_is_met_in_seconds(distance: str) -> None:
    """It is foreseen to follow, as where the distance is told: else the trigger is put off, tick by tick."""
    rest = f"gap(A0, A1, t0) > 0\nA0(t1) == A1(t1)\n{distance}\nA1a(dec) == -3\nA1v(t2) == 0"
    result = orchestrate(Request(program("W", "t0, go, t1, dec, t2", rest), ego="idm", takes=1))
    assert result.status == "success"
    assert result.verdict is not None
    assert result.verdict.facts["trigger_time_s"]["hero"] < 12.0


@pytest.mark.parametrize("ego", ["idm", "constant", "noisy"])
@pytest.mark.parametrize(("hero", "ego_way", "place"), [("S, W", "W", ""), ("W", "S, W", "A0x(t1) == turn_end + 40\n")])
def test_where_ways_have_merged_the_signs_of_that_road_count(hero: str, ego_way: str, place: str, ego: str) -> None:
    """Of the road that one of them comes from, 20 km/h, neither a plan nor the forecast knows any more."""
    rest = f"A0(t1) == A1(t1)\n{place}gap(A0, A1, t1) == 25\nA1v(t1) == 10\nA1v(t2) == 4"
    result = orchestrate(Request(program(hero, "t0, go, t1, dec, t2", rest, ego_way), ego=ego, takes=1))
    assert result.status == "success"
    assert result.run is not None
    merged_m = result.scene.landmarks_m[HERO]["turn_end"]
    driven = result.run.trace.actors["hero"]
    assert result.verdict is not None
    assert driven.s_m[driven.time_s <= result.verdict.facts["trigger_time_s"]["hero"]][-1] > merged_m


def test_whoever_begins_behind_the_ego_does_not_tailgate() -> None:
    rest = "A0(t1) == A1(t1)\nheadway(A1, A0, t1) == 1\nA1v(t1) >= 10\nA1a(dec) == -4\nA1v(t2) == 2"
    world = begin(Request(program("W", "t0, go, t1, dec, t2", rest), ego="idm"), Stages(None))[0]
    planned = first_plan(world)
    assert planned is not None
    ego, hero = (planned[2].plan.profiles[actor].state(0.0) for actor in (EGO, HERO))
    room_m = ego[0] - hero[0] - 4.5
    assert planned[2].is_good
    assert 0.95 * hero[1] <= room_m < 3.0 * hero[1]


@pytest.mark.parametrize("ego", ["idm", "constant"])
def test_who_is_to_stand_at_its_trigger_does(ego: str) -> None:
    text = program(
        "E", "t0, go, t1, acc, t2", "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 80\nA1v(t1) == 0\nA1v(t2) == 5"
    )
    assert orchestrate(Request(text, ego=ego, takes=1)).status == "success"


def test_whoever_hangs_on_the_trigger_of_another_can_be_as_slow_as_told_too() -> None:
    text = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (first):
- W
- [t0, go, t1, dec, t2]

Actor 2 (next):
- E
- [t0, go, t1, acc, t2]

Constraints:
A0(t1) == A1(t1)
gap(A0, A1, t1) == 30
A1v(t2) == 4
A2(t1) - A1(t1) == 1.5 s
A2v(t1) <= 0.2
A2v(t2) == 5
"""
    assert orchestrate(Request(text, ego="constant", takes=1)).status == "success"


def test_an_ego_that_follows_is_not_waited_for_to_come_nearer_to_one_that_stands() -> None:
    """Where it stops behind others is nearer than asked: the one ahead has to drive on to its place for the two."""
    placed = "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 8\nA1x(t1) == stop_line - 20\nA1v(t2) == 0"
    assert orchestrate(Request(program("W", "t0, go, t1, dec, t2", placed), ego="dawdler", takes=1)).status == "success"


def test_a_trigger_does_not_come_before_it_can_be_seen_what_was_before() -> None:
    two = "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 40\ngap(A0, A1, A1(t2)) == 20\nA1v(t2) == 6"
    result = orchestrate(Request(program("W", "t0, go, t1, dec, t2", two), ego="idm", takes=1))
    assert result.status == "success"


@pytest.mark.parametrize(
    ("sketch", "rest"),
    [
        ("t0, go, t1", "A0x(t2) == stop_line\nA1x(t1) == stop_line\nA1(t1) - A0(t2) == 1.5"),
        ("t0, go, t1, dec, t2", f"{PLACED}\nA1v(t2) == 0\neventually[A1(t1), A1(t2)] (A1a <= -4)"),
        ("t0, go, t1, acc, t2", f"{PLACED}\nA1v(t1) == 4\nA1v(t2) == 10\neventually[A1(t1), A1(t2)] (A1a >= 3.5)"),
        ("t0, go, t1, dec, t2", f"{PLACED}\nA1v(t2) == 4\nalways[-5, -1] (A1v >= 100)"),
        ("t0, go, t1, dec, t2", f"{PLACED}\nA1x(t0) == stop_line - 200\nA1x(t1) == stop_line - 30\nA1v(t2) == 0"),
        (
            "t0, go, t1, go, t2, dec, t3",
            f"{PLACED}\nA1x(t1) == stop_line - 60\nA1x(t2) == stop_line - 30\nA1v(t2) == 10\nA1v(t3) == 3\n"
            "A1x(t3) == stop_line\nA1(t3) - A1(t2) == 3.5",
        ),
    ],
    ids=["after a moment of the ego's", "brakes hard once", "speeds up hard once", "over", "far off", "begins plainly"],
)
def test_whatever_can_plainly_be_done_is_done(sketch: str, rest: str) -> None:
    result = orchestrate(Request(program("E", sketch, rest), ego="constant", takes=1))
    assert result.status == "success"


def test_a_plan_that_does_what_is_asked_is_not_given_up_while_the_ego_drives_as_foreseen() -> None:
    told = (
        "A0v(t0) == 6.6\nA0x(t0) == conflict_point - 105.112\nA0(t1) == A1(t1)\nA0x(t1) == conflict_point - 79.9\n"
        "A1x(t1) == conflict_point - 29.2\nA1x(t4) == conflict_point - 1.683\nA1v(t4) == 10.2\n"
    )
    text = program("S, E", "t0, go, t1, dec, t2, stop, t3, go, t4", told, ego_route="E")
    result = orchestrate(Request(text, ego="constant", takes=1))
    assert result.status == "success"
    assert result.run is not None
    assert max(each.tolerance for each in result.run.replans) <= GOOD


def test_somebody_may_do_nothing_in_particular() -> None:
    text = program("E", "t0, go, t1, dec, t2", f"{PLACED}\nA1v(t2) == 0")
    text = text.replace("\nConstraints", "\nActor 2 (other):\n- E, N\n- [t0]\n\nConstraints")
    assert orchestrate(Request(text, ego="constant", takes=1)).status == "success"


def test_it_is_noted_when_the_ego_passed_whatever_was_also_a_heros_moment() -> None:
    text = program(
        "W", "t0, go, t1, dec, t2", "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 40\nA1v(t2) == 8\nA0(t2) == A1(t2)"
    )
    run = orchestrate(Request(text, ego="idm", takes=1)).run
    assert run is not None
    assert run.ego_knots_s["t2"] == run.last_plan.profiles[HERO].knot_times_s["t2"]


def test_a_hero_waits_until_the_ego_has_come_to_stand() -> None:
    waits = "gap(A0, A1, t1) == 30\nA0(t1) == A1(t1)\nA1v(t2) == 0\nA0v(t2) == 0\nA1(t3) > A0(t2)\nA1v(t4) == 5"
    text = program("W", "t0, go, t1, dec, t2, stop, t3, acc, t4", waits)
    assert orchestrate(Request(text, ego="stop-and-go", takes=1)).status == "success"


def test_who_ends_standing_stands_though_one_behind_it_is_to_pass() -> None:
    """It was to let the other one by: so it set off again at once."""
    hero = "Actor 1 (h1):\n- W\n- [t0, go, t1, dec, t2]\n\n"
    behind = "Actor 2 (h2):\n- W\n- [t0, go, t1, go, t2]\n\n"
    text = f"Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\n{hero}{behind}Constraints:\n" + (
        "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 70\nA1x(t1) == stop_line - 40\nA1v(t2) == 0\nA0(t1) == A2(t1)\n"
        "gap(A2, A1, t1) == 20\nA2x(t2) == stop_line + 40\nA2(t2) - A1(t2) == 5\n"
    )
    planner = planner_of(scene_of(text))
    planner.begin((0.0, 150.0, 13.9, 0.0))
    motion = planner.plan.profiles[1]
    assert motion.state(motion.knot_times_s["t2"] + 0.5)[1] == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize(
    ("sides", "place", "least", "most", "ego"),
    [
        ("A0, A1", "stop_line - 30", "20", "30", "staller"),
        ("A0, A1", "stop_line - 30", "20", "30", "stop-and-go"),
        ("A1, A0", "stop_line - 20", "10", "18", "idm"),
    ],
)
def test_a_distance_that_is_to_be_kept_is_kept_at_all_moments(
    sides: str, place: str, least: str, most: str, ego: str
) -> None:
    """Whatever the ego does meanwhile, and the judge looks at all of it: a plan at more than how it begins and ends."""
    kept = f"always[A0(t0), A0(t1)] (gap({sides}) >= {least} and gap({sides}) <= {most})"
    rest = f"A0(t1) == A1(t1)\nA0x(t1) == {place}\nA1v(t2) == 3\n{kept}"
    assert orchestrate(Request(program("W", "t0, go, t1, dec, t2", rest), ego=ego, takes=1)).status == "success"


@pytest.mark.parametrize("rate", ["A1a(dec) <= -4", "always[A1(t1), A1(t2)] (A1a <= -4)"])
def test_a_sign_beyond_its_trigger_does_not_slow_down_who_is_to_brake_hard(rate: str) -> None:
    """It brakes from 46 km/h 25 m before the conflict point: the driveway's 20 km/h begin only behind that place."""
    places = "A0x(t1) == conflict_point - 30\nA1x(t1) == conflict_point - 25\nA1x(t2) == conflict_point - 5\n"
    text = program("E, N", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{places}A1v(t2) == 0\n{rate}")
    assert orchestrate(Request(text, ego="constant", takes=1)).status == "success"


BRAKES = "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 40\n"
FOLLOWS = "A0(t1) == A1(t1)\ngap(A1, A0, t1) == 30\nA0v(t1) >= 5\nheadway(A1, A0, t2) == 1\nA1(t3) - A1(t2) == 6\n"
KEEPS = "(headway(A1, A0) >= 0.6 and headway(A1, A0) <= 1.6)"
TWICE = "A0x(t1) == stop_line - 100\nA0x(t2) == stop_line - 30\n"


@pytest.mark.parametrize(
    ("sketch", "rest", "ego"),
    [
        (
            "t0, go, t1, dec, t2, acc, t3",
            f"{BRAKES}A0(t2) == A1(t2)\ngap(A0, A1, A0(t2)) == 22\nA1v(t3) == 11",
            "noisy",
        ),
        ("t0, go, t1, acc, t2, go, t3", f"{FOLLOWS}always[A1(t2), A1(t3)] {KEEPS}", "stop-and-go"),
        ("t0, go, t1", "A0x(t1) == stop_line - 10\nalways[A0(t0), A0(t1)] (headway(A1, A0) <= 2)", "idm"),
        ("t0, go, t1", f"{TWICE}always[A0(t1), A0(t2)] (gap(A0, A1) >= 18 and gap(A0, A1) <= 24)", "stop-and-go"),
    ],
)
def test_what_a_hero_is_to_do_with_the_ego_after_its_trigger_or_without_one_is_done(
    sketch: str, rest: str, ego: str
) -> None:
    """A second moment of both, an end of braking that the ego tells, and keeping a distance all along."""
    assert orchestrate(Request(program("W", sketch, rest), ego=ego, takes=1)).status == "success"


def test_who_waits_until_the_ego_has_passed_goes_on_then() -> None:
    """It has no trigger: its last knot, in the driveway beyond, is no place to be at late, nor to keep clear for."""
    waits = "A0x(t1) == conflict_point\nalways[A1(t0), A0(t1)] (A1x <= stop_line)\nA1x(t2) == turn_end"
    result = orchestrate(Request(program("E, N", "t0, go, t1, go, t2", waits), ego="stop-and-go", seed=1, takes=1))
    assert result.status == "success"
    assert result.run is not None
    assert result.run.trace.duration_s < 60.0


def test_a_second_moment_that_comes_too_soon_is_missed_by_one_who_drives_as_cars_do() -> None:
    """An ego that is much too fast is there before the hero can have done what was to be done before."""
    first = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 80\nA1x(t1) == conflict_point - 60\nA1v(t2) == 6\n"
    second = "A0(t2) == A1(t3)\nA0x(t2) == conflict_point - 35\nA1x(t3) == conflict_point - 25\nA1v(t4) == 0"
    text = program("E, N", "t0, go, t1, dec, t2, go, t3, dec, t4", first + second)
    result = orchestrate(Request(text, ego="speeder", takes=1))
    assert result.verdict is not None
    moves = [each for each in result.verdict.conditions if each.id.startswith("kin_hero")]
    assert moves
    assert all(each.holds_at(TIGHT) for each in moves)


@pytest.mark.parametrize("ego", ["staller", "stop-and-go"])
def test_what_is_to_be_done_so_long_after_the_ego_is_done_then(ego: str) -> None:
    rest = "A0x(t1) == stop_line - 60\nA1(t1) - A0(t1) == 2\nA1x(t1) == conflict_point - 30\nA1v(t2) == 0"
    assert orchestrate(Request(program("E, N", "t0, go, t1, dec, t2", rest), ego=ego, takes=1)).status == "success"


@pytest.mark.parametrize("ego", ["constant", "idm"])
def test_who_is_asked_to_be_faster_than_signs_let_it_is(ego: str) -> None:
    """Out of a driveway with 20 km/h it is to brake to 9 m/s: what no program asks for is not what it is kept from."""
    places = "A0x(t1) == conflict_point - 40\nA1x(t1) == conflict_point - 53\nA1x(t2) == conflict_point - 38\n"
    text = program("S, E", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{places}A1v(t2) == 9")
    assert orchestrate(Request(text, ego=ego, takes=1)).status == "success"


def test_who_is_fast_at_its_last_knot_brakes_for_the_bend_that_comes_soon() -> None:
    places = "A0x(t1) == conflict_point - 13\nA1x(t1) == conflict_point - 76\nA1x(t2) == conflict_point - 66\n"
    rest = f"A0(t1) == A1(t1)\nA0v(t0) == 4.8\n{places}A1v(t2) == 13.6\nA1x(t3) == conflict_point - 40"
    result = orchestrate(Request(program("W, N", "t0, go, t1, acc, t2, go, t3", rest), ego="constant"))
    assert result.status == "success"
