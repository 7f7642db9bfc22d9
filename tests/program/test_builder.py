"""Programs in Python: the same data as the text form, and faults where they are made."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.errors import ProgramError
from scenewright.program.builder import (
    Condition,
    Scenario,
    Vehicle,
    always,
    conflict_point,
    eventually,
    just_before,
    never,
    si,
    stop_line,
    turn_end,
)
from scenewright.program.expressions import Compare, Knot, Number, State
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.program.types import IntentRoute, LanesRoute, Program, Sketch

DESCRIPTION = "When the ego is close, the car brakes."


def pair() -> tuple[Scenario, Vehicle, Vehicle]:
    scene = Scenario("oncoming left turner yields", map="t_intersection", description=DESCRIPTION)
    ego = scene.ego("W", sketch="t0 go t1 go t2")
    hero = scene.actor("hero", "E", "N", sketch="t0 go t1 dec t2")
    return scene, ego, hero


def survives(program: Program) -> None:
    text = print_program(program)
    assert parse_program(text) == program
    assert print_program(parse_program(text)) == text


def test_python_and_text_give_the_same_program() -> None:
    scene, ego, hero = pair()
    gap = scene.parameter("ego_distance_m", low=3, high=60)
    scene.require(ego.x("t1") == conflict_point - gap)
    scene.require(ego.tta(stop_line, "t1") == 3.0)
    scene.require(hero.v("t2") == 0, words="the car brakes")
    scene.require(hero.a("dec") == -3.0, id="rate")
    scene.require(ego.time("t1") == hero.time("t1"))
    scene.require(hero.time("t2") < ego.time("t2"))
    scene.require(hero.x("t2") == just_before(turn_end))
    program = scene.program()
    assert program == parse_program(
        f"""
scenario "oncoming left turner yields"
map "t_intersection"
description: "{DESCRIPTION}"
parameters:
- ego_distance_m in [3, 60]
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]
Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]
Constraints:
A0x(t1) == conflict_point - ego_distance_m
tta(A0, stop_line, t1) == 3
A1v(t2) == 0  @23..37
rate: A1a(dec) == -3
A0(t1) == A1(t1)
A1(t2) < A0(t2)
A1x(t2) == just before turn_end
"""
    )
    assert program.words_of(program.constraint("c3")) == "the car brakes"
    assert scene.text() == print_program(program)
    survives(program)


EXPRESSIONS = [
    (lambda e, h, p: e.x("t1") - h.x("t1") == 3, "A0x(t1) - A1x(t1) == 3"),
    (lambda e, h, p: 3 == h.v("t1"), "A1v(t1) == 3"),  # noqa: SIM300
    (lambda e, h, p: 3 < h.v("t1"), "A1v(t1) > 3"),  # noqa: SIM300
    (lambda e, h, p: e.x(3.4) <= 10 - p, "A0x(3.4) <= 10 - p_m"),
    (lambda e, h, p: e.x(h.time("t2")) >= -p, "A0x(A1(t2)) >= -p_m"),
    (lambda e, h, p: e.v("t0") * 2 == h.v("t0") / 3 + 1, "A0v(t0) * 2 == A1v(t0) / 3 + 1"),
    (lambda e, h, p: e.x("t0") == (p + 1) * 2 - (3 - p), "A0x(t0) == (p_m + 1) * 2 - (3 - p_m)"),
    (lambda e, h, p: 1 / (e.v("t0") * 2) < 3 / h.v("t0"), "1 / (A0v(t0) * 2) < 3 / A1v(t0)"),
    (lambda e, h, p: e.x("t0") == p * Fraction(1, 3), "A0x(t0) == p_m * (1/3)"),
    (lambda e, h, p: e.v("t0") == si(30, "mph"), "A0v(t0) == 13.4112"),
    (lambda e, h, p: e.v("t0") == Decimal("0.1"), "A0v(t0) == 0.1"),
    (lambda e, h, p: e.v("t0") == np.float64(0.1), "A0v(t0) == 0.1"),
    (lambda e, h, p: e.v("t0") == +h.v("t0"), "A0v(t0) == A1v(t0)"),
    (lambda e, h, p: e.x("t0") == conflict_point.of(h), "A0x(t0) == A1.conflict_point"),
    (lambda e, h, p: e.x("t0") == conflict_point.of(e, h), "A0x(t0) == A0.conflict_point(A1)"),
    (lambda e, h, p: stop_line + 3 < e.x("t0"), "stop_line + 3 < A0x(t0)"),
    (lambda e, h, p: stop_line - e.x("t0") < 3, "stop_line - A0x(t0) < 3"),
    (lambda e, h, p: e.gap_to(h, "t1") == p, "gap(A0, A1, t1) == p_m"),
    (lambda e, h, p: e.ttc(h, 2) < e.headway(h, h.time("t1")), "ttc(A0, A1, 2) < headway(A0, A1, A1(t1))"),
    (lambda e, h, p: h.tta(conflict_point.of(e), "t1") == 2, "tta(A1, A0.conflict_point, t1) == 2"),
    (
        lambda e, h, p: (e.v(1) > 2) & (e.v(2) > 2) & (h.v(1) > 2) | ~(h.v(2) > 1),
        "A0v(1) > 2 and A0v(2) > 2 and A1v(1) > 2 or not A1v(2) > 1",
    ),
    (lambda e, h, p: (e.v(1) > 2).implies(h.v(1) < 3), "A0v(1) > 2 implies A1v(1) < 3"),
    (
        lambda e, h, p: always(e.time("t0"), 5, (h.v() < 3) | (h.a() < 0)),
        "always[A0(t0), 5](A1v < 3 or A1a < 0)",
    ),
    (lambda e, h, p: never(0, h.time("t1"), e.gap_to(h) < p), "never[0, A1(t1)](gap(A0, A1) < p_m)"),
    (lambda e, h, p: eventually(0, 9, e.tta(stop_line.of(e)) < 1), "eventually[0, 9](tta(A0, A0.stop_line) < 1)"),
]


@pytest.mark.parametrize(("build", "printed"), EXPRESSIONS, ids=[printed for _, printed in EXPRESSIONS])
def test_operators(build: object, printed: str) -> None:
    scene, ego, hero = pair()
    condition = build(ego, hero, scene.parameter("p_m"))
    assert str(condition) == printed
    scene.require(condition)
    survives(scene.program())


@given(st.floats(1e-9, 1e6) | st.floats(-1e6, -1e-9) | st.just(0.0))
def test_floats_are_the_decimals_that_they_print_as(value: float) -> None:
    scene, ego, _ = pair()
    scene.require(ego.v("t0") == value)
    (constraint,) = scene.program().constraints
    assert constraint.formula == Compare("==", State(0, 1, Knot("t0")), Number(Fraction(str(value))))


NOT_TRUTH_VALUES = [
    lambda e, h: 1 < e.v("t0") < 5,
    lambda e, h: e.v("t0") > 1 and h.v("t0") > 1,
    lambda e, h: not e.v("t0") > 1,
    lambda e, h: bool(e.v("t0")),
    lambda e, h: 5 if e.x("t0") == 1 else 6,
    lambda e, h: e.v("t0") in [h.v("t0")],
]


@pytest.mark.parametrize("use", NOT_TRUTH_VALUES)
def test_conditions_are_no_truth_values(use: object) -> None:
    _, ego, hero = pair()
    with pytest.raises(TypeError, match=r"truth value|neither true nor false"):
        use(ego, hero)


def test_a_chained_comparison_is_told_how_to_be_written() -> None:
    _, ego, _ = pair()
    with pytest.raises(TypeError, match=r"\(a < b\) & \(b < c\)"):
        1 < ego.v("t0") < 5  # noqa: B015


TYPE_FAULTS = [
    (lambda s, e, h: e.x("t0") != 3, "nearly always true"),
    (lambda s, e, h: e.x("t0") + (e.v("t0") == 3), "is a condition, not a quantity"),
    (lambda s, e, h: (e.v("t0") == 3) & e.v("t0"), "is not a condition"),
    (lambda s, e, h: (e.v("t0") == 3) & True, "is not a condition"),
    (lambda s, e, h: s.require(True), "is not a condition"),
    (lambda s, e, h: always(0, 1, e.v()), "is not a condition"),
    (lambda s, e, h: e.tta(h, "t1"), "measured to a landmark"),
    (lambda s, e, h: {e.x("t0")}, "unhashable"),
]


@pytest.mark.parametrize(("use", "words"), TYPE_FAULTS, ids=[words for _, words in TYPE_FAULTS])
def test_wrong_kinds(use: object, words: str) -> None:
    with pytest.raises(TypeError, match=words):
        use(*pair())


FAULTS = [
    (lambda s, e, h: e.x("t9"), "ego has no knot t9"),
    (lambda s, e, h: h.a("acc"), "hero has no piece acc"),
    (lambda s, e, h: h.time("dec"), "hero has no knot dec"),
    (lambda s, e, h: e.x(-1), "before the start"),
    (lambda s, e, h: e.x(h.x("t0")), "not a moment"),
    (lambda s, e, h: e.gap_to(h, "go"), "gap has a moment, not a piece"),
    (lambda s, e, h: e.x("t0") <= float("nan"), "not a number"),  # noqa: PLW0177
    (lambda s, e, h: e.x("t0") == float("inf"), "not a number"),
    (lambda s, e, h: e.x("t0") == "12", "not a number"),
    (lambda s, e, h: e.x("t0") == True, "not a number"),  # noqa: E712
    (lambda s, e, h: e.x("t0") == None, "not a number"),  # noqa: E711
    (lambda s, e, h: si(3, "furlong"), "no unit furlong"),
    (lambda s, e, h: s.require(e.x("t0") == e.v("t0")), "two different things"),
    (lambda s, e, h: s.require(e.v() == 3), "has no moment"),
    (lambda s, e, h: s.require(e.gap_to(e, "t1") == 3), "to itself"),
    (lambda s, e, h: s.require(e.v("t0") == 1, id="c2") + s.require(e.v("t0") == 2), "two conditions are called c2"),
    (lambda s, e, h: s.require(e.v("t0") == 1, id="no id"), "not an id"),
    (lambda s, e, h: s.require(e.v("t0") == 1, words="never said"), "not in the description"),
    (lambda s, e, h: s.require(e.v("t0") == Scenario("x").parameter("q_mps")), "q_mps is not declared"),
    (lambda s, e, h: s.parameter("speed"), "has no unit"),
    (lambda s, e, h: s.parameter("a b_m"), "has no unit"),
    (lambda s, e, h: [s.parameter("a_m"), s.parameter("a_m")], "declared twice"),
    (lambda s, e, h: s.parameter("a_m", low=5, high=3), "range of a_m is empty"),
    (lambda s, e, h: s.parameter("a_m", float("nan")), "not a number"),
    (lambda s, e, h: s.ego("E"), "already an actor"),
    (lambda s, e, h: s.actor("hero", "E", sketch="t0 go t1"), "already an actor hero"),
    (lambda s, e, h: s.actor("two words", "E", sketch="t0 go t1"), "not a name"),
    (lambda s, e, h: s.actor("x", "Q", sketch="t0 go t1"), "not a heading"),
    (lambda s, e, h: s.actor("x", sketch="t0 go t1"), "one route"),
    (lambda s, e, h: s.actor("x", "E", lanes=["1.0.1"], sketch="t0 go t1"), "one route"),
    (lambda s, e, h: s.actor("x", "E", sketch="t0 go"), "not a motion sketch"),
    (lambda s, e, h: s.actor("x", "E", sketch="t0 fly t1"), "not a motion sketch"),
    (lambda s, e, h: s.actor("x", "E", sketch="t0 go t0"), "not a motion sketch"),
    (lambda s, e, h: s.actor("x", "E", sketch="t0 go stop2"), "not a motion sketch"),
    (lambda s, e, h: s.actor("x", "E", sketch=""), "not a motion sketch"),
]


@pytest.mark.parametrize(("use", "words"), FAULTS, ids=[words for _, words in FAULTS])
def test_faults_are_raised_where_they_are_made(use: object, words: str) -> None:
    with pytest.raises(ProgramError, match=words):
        use(*pair())


def test_a_scenario_needs_an_ego_and_somebody_else() -> None:
    scene = Scenario("alone")
    with pytest.raises(ProgramError, match="no ego"):
        scene.program()
    scene.ego("W")
    with pytest.raises(ProgramError, match="nobody but the ego"):
        scene.program()


def test_what_the_text_form_cannot_say_is_refused() -> None:
    scene = Scenario("odd lanes")
    scene.ego("W")
    scene.actor("hero", lanes=["no dots here"], sketch="t0 go t1")
    with pytest.raises(ProgramError):
        scene.program()


def test_routes_sketches_and_order_of_actors() -> None:
    scene = Scenario('with "quotes" and \\', map="maps/x.xodr")
    first = scene.actor("first", lanes=["1.0.-1", "2.0.-1"], sketch="[t0, go, t1, stop, t2]")
    second = scene.actor("second", route=IntentRoute("driveway", "left"), sketch=Sketch(("a",), ()))
    ego = scene.ego("S", "W", name="av")
    assert (first.id, second.id, ego.id) == (1, 2, 0)
    program = scene.program()
    assert [actor.name for actor in program.actors] == ["av", "first", "second"]
    assert program.actor(1).route == LanesRoute(("1.0.-1", "2.0.-1"))
    survives(program)


def test_one_end_of_a_range_is_enough() -> None:
    scene, *_ = pair()
    scene.parameter("gap_ft", low=10)
    (parameter,) = scene.program().parameters
    assert (parameter.low, parameter.high) == (Fraction(10), Fraction(1000) / Fraction("0.3048"))
    survives(scene.program())


def test_conditions_and_quantities_show_what_they_say() -> None:
    _, ego, _ = pair()
    condition = ego.x("t1") == stop_line
    assert isinstance(condition, Condition)
    assert f"{condition}" == "A0x(t1) == stop_line"
    assert f"{ego.x('t1') + 1}" == "A0x(t1) + 1"
