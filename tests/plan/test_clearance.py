"""A hero on the ego's lane: which of the two is ahead, and that neither starts or drives inside the other."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.solve.clearance import OUT_OF_WAY_M, Clearance, out_of_way_mps
from scenewright.solve.planner import Planner
from scenewright.solve.situation import Situation

from scenarios import BRAKES, YIELDS, example, limits_of, read_structure
from scenewright.motion.profile import Profile, chain
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
    return Clearance.of(scene, structure, linear_conditions(scene, structure), scene.program.heroes[0])


@pytest.mark.parametrize(
    ("distance", "ahead"),
    [
        ("gap(A0, A1, t1) == 20", True),
        ("20 == gap(A0, A1, t1)", True),
        ("gap(A1, A0, t1) == 20", False),
        ("headway(A0, A1, t1) == 2", True),
        ("ttc(A0, A1, t1) == 4", True),
        ("ttc(A1, A0, t1) == 4", False),
        ("A1x(t1) - A0x(t1) == 15", True),
        ("A0x(t1) - A1x(t1) == 15", False),
    ],
)
def test_the_distance_tells_who_is_ahead(distance: str, ahead: bool) -> None:
    clearance = clearance_of(scene_with(distance))
    assert clearance is not None
    assert clearance.ahead is ahead


def test_who_only_crosses_need_not_keep_clear() -> None:
    assert clearance_of(YIELDS.scene()) is None


TIMED = "A0(t1) == A1(t1)\ntta(A0, conflict_point, t1) == 2 s\ntta(A1, conflict_point, t1) == {seconds}\n{after}"
STOPS, FIRST = "A1v(t2) == 0\n", "A1x(t2) == conflict_point\nA0x(t2) == conflict_point\nA1(t2) < A0(t2)\n"


@given(seconds=st.floats(0.5, 8.0))
def test_who_is_timed_is_out_of_the_way_from_some_speed_on(seconds: float) -> None:
    text = example("E, N", "t0, go, t1, dec, t2", TIMED.format(seconds=f"{seconds:.3f} s", after=STOPS))
    scene = ground(parse_program(text), load_map("t_intersection"), {})
    structure = read_structure(scene.program)
    least_mps = out_of_way_mps(scene, structure, linear_conditions(scene, structure), scene.program.heroes[0])
    conflict = scene.conflict(EGO, HERO)
    assert conflict is not None
    place_m = scene.landmark_m(HERO, "conflict_point", EGO) - round(seconds, 3) * least_mps
    assert place_m == pytest.approx(conflict.zone_b_m[0] - OUT_OF_WAY_M)


def test_who_is_to_be_first_or_has_its_place_need_not_be_out_of_the_way() -> None:
    first = example("E, N", "t0, go, t1, acc, t2", TIMED.format(seconds="2 s", after=FIRST))
    for scene in (ground(parse_program(first), load_map("t_intersection"), {}), BRAKES.scene()):
        structure = read_structure(scene.program)
        assert out_of_way_mps(scene, structure, linear_conditions(scene, structure), scene.program.heroes[0]) == 0.0


@settings(max_examples=8, deadline=None)
@given(ego_mps=st.floats(4.0, 13.0), slows_mpss=st.floats(-0.5, 0.3), instant_s=st.sampled_from([1.5, 2.5, 4.0]))
def test_nobody_starts_or_drives_inside_the_other(ego_mps: float, slows_mpss: float, instant_s: float) -> None:
    scene = BRAKES.scene()
    structure = read_structure(scene.program)
    planner = Planner(scene, structure, limits_of(scene), Z3Backend(), linear_conditions(scene, structure), 20.0)
    ego = Profile(chain(0.0, 180.0, ego_mps, [(6.0, slows_mpss, 0)]))
    plan = planner.first_plan([Situation(0.0, ego, {"t0": 0.0, "t1": instant_s}, {}, {HERO: instant_s})]).plan
    if plan is None:
        return
    for step in range(int(instant_s / 0.05)):
        gap_m = plan.profiles[HERO].state(0.05 * step)[0] - ego.state(0.05 * step)[0]
        assert gap_m > VEHICLE_LENGTH_M
    # It draws away where it can: then the gap is the one that was asked for at one instant only.
    if ego_mps < 11.0:
        assert plan.profiles[HERO].state(instant_s)[1] > ego.state(instant_s)[1] + 0.4
