"""When a trigger may come: an ego that stands where it should be is there, and one in no haste is not waited for."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from many_heroes import PROGRAMS
from situations import HERO, asked_of, scene_of

from scenewright.motion.profile import Profile, chain
from scenewright.plan.triggers import SHORTEST_LEAD_S, TriggerTimes, adapts_until, beside_others
from scenewright.program.printer import print_expression
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import EGO, Actor
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.solve.arrival import TIGHT_LENGTH_M, linear_conditions
from stories import BRAKES_GAP, GOES_FIRST_TIME, STOPS_AND_GOES, YIELDS_DISTANCE, YIELDS_TIME, program

NOW_S = 5.0


def times_of(text: str) -> tuple[TriggerTimes, Actor]:
    scene = ground(parse_program(text), load_map("t_intersection"), {})
    structure = read_structure(scene.program)
    return TriggerTimes(scene, structure, linear_conditions(scene, structure)), scene.program.heroes[0]


def times(text: str = YIELDS_DISTANCE) -> tuple[TriggerTimes, Actor, float]:
    """Return when the trigger of a hero that is to yield comes, and the ego's place (m) at it, at no speed."""
    found, hero = times_of(text)
    side = found.sides[hero.id]
    return found, hero, -side.constant / side.weights[EGO][0]


@pytest.mark.parametrize(
    ("text", "alone"),
    [
        (YIELDS_DISTANCE, True),
        (YIELDS_TIME, True),
        (STOPS_AND_GOES, True),
        (GOES_FIRST_TIME, True),
        (BRAKES_GAP, False),
        (BRAKES_GAP.replace("gap(A0, A1, t1) == 20", "gap(A0, A1, t1) == 20\nA1x(t1) == stop_line - 80"), False),
        (BRAKES_GAP.replace("gap(A0, A1, t1) == 20", "gap(A1, A0, t1) == 20\nA1x(t1) == stop_line - 80"), True),
        (BRAKES_GAP.replace("gap(A0, A1, t1) == 20", "A1x(t1) - A0x(t1) == 20"), False),
    ],
)
def test_who_decides_when_a_trigger_comes(text: str, alone: bool) -> None:
    """A distance is for both to keep, unless the program says where the hero is then and the ego is ahead of it."""
    found, hero = times_of(text)
    assert (hero.id in found.sides) is alone


@given(speed_mps=st.floats(0.5, 15.0), far_m=st.floats(1.0, 60.0))
def test_the_trigger_comes_when_the_ego_is_there(speed_mps: float, far_m: float) -> None:
    found, hero, place_m = times()
    ego = Profile(chain(NOW_S, place_m - far_m, speed_mps, [(200.0, 0.0, 0)]))
    first_s = found.instant_s(hero, NOW_S, ego, None)
    if far_m / speed_mps < 39.0:
        assert ego.state(first_s)[0] == pytest.approx(max(place_m, ego.state(NOW_S + SHORTEST_LEAD_S)[0]), abs=1e-6)
    sooner_s = found.instant_s(hero, NOW_S, ego, NOW_S + 3.0)
    assert sooner_s <= NOW_S + 12.0 + 1e-9, "what is far off need not be foreseen more exactly"
    assert found.instant_s(hero, NOW_S, ego, first_s) == pytest.approx(first_s, abs=0.5), "what is planned stays so"


def test_an_ego_that_is_past_its_place_is_waited_for_no_more() -> None:
    found, hero, place_m = times()
    found.ego_began = (place_m - 50.0, 8.0)
    past = Profile(chain(NOW_S, place_m + 1.0, 8.0, [(60.0, 0.0, 0)]))
    assert found.instant_s(hero, NOW_S, past, None) == NOW_S + SHORTEST_LEAD_S
    never = Profile(chain(NOW_S, place_m - 20.0, 2.0, [(1.0, -2.0, 0), (60.0, 0.0, 0)]))
    assert found.instant_s(hero, NOW_S, never, None) > NOW_S + 30.0


@pytest.mark.parametrize(("planned_s", "expected_s"), [(3.0, 6.0), (6.4, 6.4), (9.0, 7.0)])
@pytest.mark.parametrize("short", [0.0, 0.5, 0.8])
def test_the_trigger_may_come_while_the_ego_stands_there(planned_s: float, expected_s: float, short: float) -> None:
    found, hero, place_m = times()
    stand_m = place_m - short * TIGHT_LENGTH_M
    ego = Profile(chain(NOW_S, stand_m - 1.0, 2.0, [(1.0, -2.0, 0), (1.0, 0.0, 0), (3.0, 1.0, 0)]))
    assert found.instant_s(hero, NOW_S, ego, planned_s) == pytest.approx(expected_s)


def test_an_ego_that_passes_its_place_before_it_stands_is_there_when_it_passes() -> None:
    found, hero, place_m = times()
    ego = Profile(chain(NOW_S, place_m - 0.8, 2.0, [(1.0, -2.0, 0), (1.0, 0.0, 0), (9.0, 1.0, 0)]))
    instant_s = found.instant_s(hero, NOW_S, ego, 6.4)
    assert instant_s < 6.0
    assert ego.state(instant_s)[0] == pytest.approx(place_m)


@pytest.mark.parametrize("short_m", [0.6, 3.0])
def test_an_ego_that_stands_too_far_off_is_waited_for(short_m: float) -> None:
    found, hero, place_m = times()
    ego = Profile(chain(NOW_S, place_m - short_m - 1.0, 2.0, [(1.0, -2.0, 0), (1.0, 0.0, 0), (9.0, 1.0, 0)]))
    instant_s = found.instant_s(hero, NOW_S, ego, 6.4)
    assert ego.state(instant_s)[0] == pytest.approx(place_m)


@pytest.mark.parametrize(("late_m", "due"), [(0.02, True), (0.05, True), (0.6, False)])
def test_a_time_that_was_met_between_two_ticks_is_not_waited_for_again(late_m: float, due: bool) -> None:
    """An ego that slows down later is as near in time once more, when it stops; the trigger was to come now."""
    found, hero, place_m = times(YIELDS_TIME)
    side = found.sides[hero.id]
    lead_s = side.weights[EGO][1] / side.weights[EGO][0]
    began_m, way = place_m - lead_s * 4.0 + late_m, [(1.5, 0.0, 0), (4.0 / 1.5, -1.5, 0), (20.0, 0.0, 0)]
    ego = Profile(chain(NOW_S, began_m, 4.0, way))
    assert (found.instant_s(hero, NOW_S, ego, NOW_S + 0.01) < NOW_S + 0.1) is due
    assert found.instant_s(hero, NOW_S, ego, NOW_S + 3.0) > NOW_S + 1.5


def test_knots_of_the_ego_are_passed_one_after_another() -> None:
    found, hero, place_m = times(STOPS_AND_GOES)
    turn_m = found.scene.landmark_m(EGO, "turn_start")
    ego = Profile(chain(NOW_S, place_m - 10.0, 5.0, [(60.0, 0.0, 0)]))
    trigger_s = found.instant_s(hero, NOW_S, ego, None)
    knots = found.ego_knots_s(NOW_S, ego, {"t0": 0.0}, {hero.id: trigger_s})
    assert knots["t0"] == 0.0
    assert knots["t1"] == trigger_s
    assert ego.state(knots["t2"])[0] == pytest.approx(turn_m)
    stops = Profile(chain(NOW_S, place_m - 10.0, 5.0, [(2.5, -2.0, 0), (60.0, 0.0, 0)]))
    assert "t2" not in found.ego_knots_s(NOW_S, stops, {"t0": 0.0}, {hero.id: NOW_S + 12.0})


def test_a_knot_at_a_place_that_is_behind_the_ego_is_passed_with_the_one_before() -> None:
    found, _, place_m = times(STOPS_AND_GOES)
    found.ego_began = (place_m - 60.0, 5.0)
    beyond = Profile(chain(NOW_S, found.scene.landmark_m(EGO, "turn_start") + 2.0, 5.0, [(60.0, 0.0, 0)]))
    knots = found.ego_knots_s(NOW_S, beyond, {"t0": 0.0, "t1": 4.0}, {})
    assert knots["t2"] == NOW_S


def test_who_hangs_on_a_hero_that_adapts_adapts_until_then() -> None:
    """In a chain all adapt, each until its own knot; who hangs on nobody with a trigger does not."""
    text = PROGRAMS["chain"](3).replace(
        "Constraints:", "Actor 4 (alone):\n- E\n- [t0, go, t1, dec, t2]\n\nConstraints:"
    )
    program = parse_program(text + "A4v(t1) == 5\n")
    assert adapts_until(program, read_structure(program), {}) == {1: "t1", 2: "t1", 3: "t1"}


@pytest.mark.parametrize(("sync", "until"), [("", {1: "t1"}), ("A0(t1) == A1(t1)\n", {1: "t1"})])
@pytest.mark.parametrize(
    ("lasting", "counts"), [("gap(A1, A0) <= 20", True), ("A1x <= A1.stop_line", True), ("A1v <= 9", False)]
)
def test_who_has_to_be_beside_others_or_until_they_are_somewhere_adapts_until_its_last_knot(
    sync: str, until: dict[int, str], lasting: str, counts: bool
) -> None:
    sketches = "Actor 0:\n- W\n- [t0, go, t1, go, t2]\nActor 1:\n- W\n- [t0, go, t1]\n"
    program = parse_program(f"{sketches}Constraints:\n{sync}always[A0(t0), A0(t1)] ({lasting})\n")
    structure = read_structure(program)
    assert adapts_until(program, structure, {}) == (until if counts or sync else {})
    told = {hero: list(map(print_expression, ends)) for hero, ends in beside_others(program, structure).items()}
    assert told == ({1: ["A0(t1)"]} if counts and not sync else {})


@pytest.mark.parametrize(
    ("line", "until"),
    [
        ("A1(t1) - A0(t1) == 2", "t1"),
        ("A1(t2) - A0(t1) >= 1.5", "t2"),
        ("A1(t2) > A0(t1)", "t2"),
        ("A0(t1) - A1(t1) == 2", None),  # the ego may answer what it does, and would be waited for for ever
        ("A1(t2) < A0(t1)", None),
    ],
)
def test_without_a_trigger_it_adapts_until_it_comes_behind_a_moment_of_the_ego(line: str, until: str | None) -> None:
    asked = asked_of(scene_of(program("E, N", "t0, go, t1, dec, t2", f"A0x(t1) == conflict_point\n{line}")))
    assert asked.adapts_until == ({} if until is None else {HERO: until})


def test_a_moment_of_the_ego_that_comes_before_its_trigger_is_looked_for_before_it() -> None:
    text = program(
        "E, N",
        "t0, go, t1, dec, t2",
        "A0(t2) == A1(t1)\nA0x(t1) == conflict_point - 60\n"
        "A0x(t2) == conflict_point - 30\nA1x(t1) == conflict_point - 18\nA1v(t2) == 0",
    )
    found, hero = times_of(text.replace("t0, go, t1, go, t2]", "t0, go, t1, go, t2, go, t3]", 1))
    meets_m = found.scene.landmarks_m[EGO]["conflict_point"]
    found.ego_began = (meets_m - 100.0, 10.0)
    even = Profile(chain(0.0, meets_m - 100.0, 10.0, [(20.0, 0.0, 0)]))
    knots = found.ego_knots_s(0.0, even, {}, {hero.id: 7.0})
    assert knots == pytest.approx({"t1": 4.0, "t2": 7.0})
