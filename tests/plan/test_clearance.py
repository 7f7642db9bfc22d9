"""A hero on the ego's lane: which of the two is ahead, and that neither starts or drives inside the other."""

from __future__ import annotations

import pytest
from followers import SIGNS
from hypothesis import given, settings
from hypothesis import strategies as st

from scenarios import BRAKES, YIELDS, example, limits_of, read_structure
from scenewright.plan.foresight import Clearance
from scenewright.plan.planner import Planner
from scenewright.plan.prediction import Driver
from scenewright.program.text import parse_program
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.arrival import linear_conditions

EGO, HERO = 0, 1


def scene_with(distance: str) -> Scene:
    text = example("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{distance}\nA1v(t2) == 0\n")
    program = parse_program(text)
    return ground(program, load_map("t_intersection"), {})


def clearance_of(scene: Scene) -> Clearance | None:
    structure = read_structure(scene.program)
    conditions = linear_conditions(scene, structure, with_bounds=True)
    return Clearance.of(scene, structure, conditions, scene.program.heroes[0])


@pytest.mark.parametrize(
    ("distance", "ahead"),
    [
        ("gap(A0, A1, t1) == 20", True),
        ("20 == gap(A0, A1, t1)", True),
        ("gap(A1, A0, t1) == 20", False),
        ("gap(A0, A1, t1) == -20", False),
        ("headway(A0, A1, t1) == 2", True),
        ("ttc(A0, A1, t1) == 4", True),
        ("ttc(A1, A0, t1) == 4", False),
        ("headway(A0, A1, t1) < 1.5", True),
        ("gap(A0, A1, t1) >= -30", False),
        ("A1x(t1) - A0x(t1) == 15", True),
        ("A0x(t1) - A1x(t1) == 15", False),
    ],
)
def test_the_distance_tells_who_is_ahead(distance: str, ahead: bool) -> None:
    clearance = clearance_of(scene_with(distance))
    assert clearance is not None
    assert clearance.ahead is ahead


def test_whoever_is_to_have_merged_ahead_of_the_ego_is_not_planned_through_it() -> None:
    """Where it starts is open: it began behind the ego and drove through it."""
    rows = "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 13.8\nA1x(t1) == turn_end + 20.2\nA1a(dec) == -4\nA1v(t2) == 2.7\n"
    text = example("S, E", "t0, go, t1, dec, t2", rows).replace("- W\n", "- E\n", 1)
    scene = ground(parse_program(text), load_map("t_intersection"), {})
    clearance = clearance_of(scene)
    assert clearance is not None
    assert clearance.ahead
    assert clearance.since_m == pytest.approx(scene.landmarks_m[HERO]["turn_end"], abs=1.0)
    structure = read_structure(scene.program)
    planner = Planner(scene, structure, limits_of(scene), Driver(SIGNS), linear_conditions(scene, structure))
    attempt = planner.begin((0.0, scene.landmarks_m[EGO]["intersection"] - 100.0, 13.9, 0.0))
    ego, hero = attempt.plan.profiles[EGO], attempt.plan.profiles[HERO]
    for k in range(int(10 * hero.knot_times_s["t1"]) + 1):
        s_m = hero.state(0.1 * k)[0]
        if s_m >= clearance.since_m:
            assert s_m + clearance.offset_m - ego.state(0.1 * k)[0] > VEHICLE_LENGTH_M


def test_that_one_is_ahead_at_all_tells_no_distance() -> None:
    assert clearance_of(scene_with("gap(A0, A1, t0) > 0")) is None


@pytest.mark.parametrize(("ego_m", "hero_m", "ahead"), [(100, 120, True), (120, 100, False), (100, 103, None)])
def test_places_of_both_tell_it_too(ego_m: int, hero_m: int, ahead: bool | None) -> None:
    """Unless the program wants them nearer than anybody keeps."""
    clearance = clearance_of(scene_with(f"A0x(t1) == {ego_m}\nA1x(t1) == {hero_m}"))
    assert (None if clearance is None else clearance.ahead) is ahead
    assert clearance is None or not clearance.of_distance


@pytest.mark.parametrize(("start", "ahead"), [("gap(A0, A1, t0) == 20", True), ("A0x(t0) - A1x(t0) == 15", False)])
def test_where_both_start_tells_it_where_the_trigger_does_not(start: str, ahead: bool) -> None:
    clearance = clearance_of(scene_with(f"{start}\nA0x(t1) == 250\nA1v(t1) == 8"))
    assert clearance is not None
    assert (clearance.ahead, clearance.of_distance) == (ahead, False)


def test_who_only_crosses_need_not_keep_clear() -> None:
    assert clearance_of(YIELDS.scene()) is None


@settings(max_examples=6, deadline=None)
@given(ego_mps=st.floats(7.0, 13.0), slows_mpss=st.floats(-0.5, 0.3))
def test_nobody_starts_or_drives_inside_the_other(ego_mps: float, slows_mpss: float) -> None:
    scene = BRAKES.scene()
    structure = read_structure(scene.program)
    predictor = Driver.on(scene.routes[EGO], SIGNS)
    planner = Planner(scene, structure, limits_of(scene), predictor, linear_conditions(scene, structure))
    attempt = planner.begin((0.0, 180.0, ego_mps, slows_mpss))
    assert attempt.is_good
    hero, ego = attempt.plan.profiles[HERO], attempt.plan.profiles[EGO]
    trigger_s = hero.knot_times_s["t1"]
    gaps_m = [hero.state(0.05 * k)[0] - ego.state(0.05 * k)[0] for k in range(int(trigger_s / 0.05))]
    assert min(gaps_m) > VEHICLE_LENGTH_M
    # The distance changes plainly at the trigger: then it is the one that was asked for at one instant only.
    assert abs(hero.state(trigger_s)[1] - ego.state(trigger_s)[1]) > 0.4
