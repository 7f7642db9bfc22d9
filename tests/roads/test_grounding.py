"""Programs on maps: routes, landmarks, parameters, and what a map cannot give."""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path

import pytest

from scenewright.errors import MapError, ParameterError
from scenewright.program.text import parse_program
from scenewright.roads import find_conflict, find_route, load_map
from scenewright.roads.grounding import Scene, ground, parameter_values

sys.path.insert(0, str(Path(__file__).parents[1]))
from scenarios import EXAMPLE_TABLE, PAPER_HESITATES, PAPER_TURNS, YIELDS, Example, example

T = load_map("t_intersection")


def scene_of(text: str, **values: float | str | Fraction) -> Scene:
    return ground(parse_program(text), T, values)


def crossing(constraints: str, **values: float | str | Fraction) -> Scene:
    return scene_of(example("E, N", "t0, go, t1, dec, t2", constraints), **values)


@pytest.mark.parametrize("case", EXAMPLE_TABLE, ids=lambda case: case.name)
def test_examples_ground_on_the_shipped_map(case: Example) -> None:
    scene = case.scene()
    assert set(scene.routes) == {0, 1}
    for actor in scene.program.actors:
        assert scene.landmarks_m[actor.id].items() >= dict(scene.routes[actor.id].landmarks).items()
    assert {p.name for p in scene.open_parameters()} == {p.name for p in scene.program.parameters} - set(
        case.parameters
    )


def test_landmarks_are_those_of_the_roads() -> None:
    scene = YIELDS.scene()
    ego, hero = find_route(T, headings=("W",)), find_route(T, headings=("E", "N"))
    conflict = find_conflict(ego, hero)
    assert conflict is not None
    for name in ("stop_line", "turn_start", "turn_end", "junction_start", "junction_end", "route_end"):
        assert scene.landmark_m(0, name) == ego.landmarks[name]
        assert scene.landmark_m(1, name) == hero.landmarks[name]
    for name in ("conflict_point", "intersection", "turn"):
        assert scene.landmark_m(0, name) == scene.landmark_m(0, name, 1) == conflict.s_a_m
        assert scene.landmark_m(1, name) == scene.landmark_m(1, name, 0) == conflict.s_b_m
    assert scene.conflict(0, 1) == conflict
    ego_point, hero_point = ego.path.pose(conflict.s_a_m)[:2], hero.path.pose(conflict.s_b_m)[:2]
    assert ego_point == pytest.approx(hero_point, abs=0.05)


def test_where_the_papers_routes_part_is_the_turn() -> None:
    scene = PAPER_TURNS.scene()
    assert scene.offset_m(0, 1) == pytest.approx(0.0)
    assert scene.landmark_m(1, "turn") >= scene.landmark_m(1, "junction_start")
    assert PAPER_HESITATES.scene().landmark_m(0, "turn") == PAPER_HESITATES.scene().landmark_m(0, "conflict_point")


def test_without_a_conflict_the_intersection_is_where_the_junction_begins() -> None:
    scene = scene_of(example("E", "t0, go, t1", "A0x(t0) == intersection - 50\nA1x(t0) == turn - 5"))
    assert scene.landmark_m(0, "intersection") == scene.landmark_m(0, "junction_start")
    assert scene.landmark_m(1, "turn") == scene.landmark_m(1, "junction_start")


@pytest.mark.parametrize(
    ("intent", "headings"),
    [
        ("from driveway, left", ("S", "E")),
        ("from driveway, right into road", ("S", "W")),
        ("from road headed W, straight", ("W",)),
        ("from, right into driveway", ("W", "N")),
        ("from road, left", ("E", "N")),
        ("from, left headed N", ("E", "N")),
        ("from driveway, headed W", ("S", "W")),
    ],
)
def test_intents_find_their_routes(intent: str, headings: tuple[str, ...]) -> None:
    scene = scene_of(example(intent, "t0, go, t1", "A0v(t0) == 5"))
    assert scene.routes[1].headings == headings


def test_lanes_find_their_route() -> None:
    lanes = find_route(T, headings=("E", "N")).lanes
    scene = scene_of(example(f"lanes {', '.join(lanes)}", "t0, go, t1", "A0v(t0) == 5"))
    assert scene.routes[1].lanes == lanes


@pytest.mark.parametrize(
    ("route", "words"),
    [
        ("N", "no route on t_intersection fits"),
        ("E, S", "no route on t_intersection fits"),
        ("from driveway", "more than one route"),
        ("lanes 9.9.9", "no route on t_intersection fits"),
    ],
)
def test_a_route_that_is_not_there_is_told_with_the_actors_name(route: str, words: str) -> None:
    with pytest.raises(MapError, match=rf"^hero \(A1\): {words}") as caught:
        scene_of(example(route, "t0, go, t1", "A0v(t0) == 5"))
    assert str(caught.value).startswith("hero (A1)")
    assert caught.value.expected


@pytest.mark.parametrize("name", ["conflict_point", "A0.conflict_point", "A0.conflict_point(A1)"])
def test_routes_that_never_meet_have_no_conflict_point(name: str) -> None:
    with pytest.raises(MapError, match=r"no conflict point|never meet"):
        scene_of(example("E", "t0, go, t1", f"A0x(t0) == {name} - 50"))


def test_a_landmark_on_another_actors_route_is_looked_up_there() -> None:
    scene = scene_of(example("W, N", "t0, go, t1", "A1x(t0) == A0.stop_line - 5"))
    assert scene.landmark_m(0, "stop_line") == 300.0
    with pytest.raises(MapError, match="ego's route has no conflict point"):
        scene_of(example("E", "t0, go, t1", "tta(A1, A0.conflict_point, t0) == 3"))


@pytest.mark.parametrize(
    "line",
    [
        "gap(A0, A1, t1) == 12",
        "A1x(t1) - A0x(t1) == 12",
        "ttc(A0, A1, t1) < 2",
        "A1x(t1) == A0x(t1) + 20",
        "A1x(t1) - 5 >= A0x(t1)",
        "A1x(t0) == A0.stop_line - 5",
        "tta(A1, A0.stop_line, t1) == 3",
    ],
)
def test_a_gap_needs_a_lane_that_both_use(line: str) -> None:
    with pytest.raises(MapError, match="their routes share no lane") as caught:
        crossing(line)
    assert "conflict point" in (caught.value.fix or "")
    shared = scene_of(example("W", "t0, go, t1", line))
    assert shared.offset_m(0, 1) == 0.0
    assert shared.offset_m(1, 1) == 0.0


# -- parameters -----------------------------------------------------------------------------------------------------
def test_values_come_in_the_unit_of_the_name() -> None:
    values = "A1x(t1) == conflict_point - near_ft\nA1v(t1) == fast_mph\nA1v(t0) == slow_mps"
    scene = crossing(values, near_ft="40", fast_mph=10.5)
    assert scene.parameters == {"near_ft": Fraction("12.192"), "fast_mph": Fraction("10.5") * Fraction("0.44704")}
    assert [p.name for p in scene.open_parameters()] == ["slow_mps"]


def test_a_value_given_outdoes_one_in_the_program() -> None:
    text = "parameters:\n- near_m = 20 in [10, 30]\n" + example(
        "E, N", "t0, go, t1", "A1x(t1) == conflict_point - near_m"
    )
    assert scene_of(text).parameters == {"near_m": 20}
    assert scene_of(text, near_m=12.5).parameters == {"near_m": Fraction("12.5")}


@pytest.mark.parametrize("value", ["abc", "", "nan", "inf", "-inf", float("nan"), float("inf"), "1/0", "12 m"])
def test_what_is_not_a_number_is_refused(value: float | str) -> None:
    with pytest.raises(ParameterError, match="near_m is not a number") as caught:
        crossing("A1x(t1) == conflict_point - near_m", near_m=value)
    assert caught.value.found == str(value)


@pytest.mark.parametrize(("value", "shown"), [(-1, "-1 m"), (1e6, "1e+06 m"), ("2000", "2000 m")])
def test_what_is_out_of_range_is_refused(value: float | str, shown: str) -> None:
    with pytest.raises(ParameterError, match="near_m is out of range") as caught:
        crossing("A1x(t1) == conflict_point - near_m", near_m=value)
    assert caught.value.found == shown
    assert caught.value.expected == "0 to 1000 m"


def test_a_declared_range_holds() -> None:
    text = "parameters:\n- near_m in [10, 30]\n" + example("E, N", "t0, go, t1", "A1x(t1) == conflict_point - near_m")
    with pytest.raises(ParameterError) as caught:
        scene_of(text, near_m=31)
    assert (caught.value.found, caught.value.expected) == ("31 m", "10 to 30 m")


def test_an_unknown_parameter_is_refused_with_the_nearest() -> None:
    with pytest.raises(ParameterError, match="no parameter neer_m") as caught:
        crossing("A1x(t1) == conflict_point - near_m", neer_m=3)
    assert caught.value.fix == "did you mean near_m?"
    with pytest.raises(ParameterError) as caught:
        crossing("A1v(t1) == 3", near_m=3)
    assert "this one has none" in (caught.value.expected or "")


def test_exact_values_stay_exact() -> None:
    program = parse_program(example("E, N", "t0, go, t1", "A1x(t1) == conflict_point - near_m"))
    assert parameter_values(program, {"near_m": Fraction(1, 3)}) == {"near_m": Fraction(1, 3)}
    assert parameter_values(program, {"near_m": 0.1}) == {"near_m": Fraction(1, 10)}


@pytest.mark.parametrize(
    ("formula", "given", "read", "noted"),
    [
        ("A1a(dec) == rate_mpss", 3, -3, True),
        ("A1a(dec) == rate_mpss", -3, -3, False),
        ("A1a(dec) == -rate_mpss", 3, 3, False),
        ("A1a(dec) == -rate_mpss", -3, 3, True),
        ("A1a(t1) == rate_mpss", 3, 3, False),
        ("A1a(t1) <= rate_mpss", 3, 3, False),
    ],
)
def test_decelerations_may_be_given_with_either_sign(formula: str, given: int, read: int, noted: bool) -> None:
    scene = crossing(formula, rate_mpss=given)
    assert scene.parameters == {"rate_mpss": read}
    assert bool(scene.notes) is noted
    assert all("rate_mpss is a deceleration" in note for note in scene.notes)


@pytest.mark.parametrize(
    ("formula", "declared", "read"),
    [
        ("A1a(dec) == rate_mpss", "in [2, 4]", (-4, -2)),
        ("A1a(dec) == rate_mpss", "in [-4, -2]", (-4, -2)),
        ("A1a(dec) == -rate_mpss", "in [-4, -2]", (2, 4)),
        ("A1a(dec) == -rate_mpss", "= -3 in [-4, -2]", (2, 4)),
        ("A1a(dec) == -rate_mpss", "in [-1, 4]", (-1, 4)),
        ("A1a(dec) == rate_mpss", "in [0, 3]", (-3, 0)),
        ("A1a(dec) == rate_mpss", "in [3, 3]", (-3, -3)),
    ],
)
def test_the_range_of_a_deceleration_may_have_either_sign(formula: str, declared: str, read: tuple[int, int]) -> None:
    text = f"parameters:\n- rate_mpss {declared}\n" + example("E, N", "t0, go, t1, dec, t2", formula)
    scene = scene_of(text)
    (rate,) = scene.program.parameters
    assert (rate.low, rate.high) == read
    assert bool(scene.notes) is ((rate.low, rate.high) != parse_program(text).parameters[0].bounds())
    if rate.value is not None:
        assert scene.parameters == {"rate_mpss": rate.value}


def test_a_parameter_without_effect_is_noted() -> None:
    text = "parameters:\n- nearby_m = 3\n" + example("E, N", "t0, go, t1", "A1x(t1) == conflict_point - near_m")
    assert scene_of(text).notes == ("no constraint speaks of the parameter nearby_m: it has no effect",)
