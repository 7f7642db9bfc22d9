"""Programs in Python: the same data as the text form, and faults where they are made."""

from __future__ import annotations

from fractions import Fraction

import pytest
from small_programs import DESCRIPTION, pair, survives

from scenewright.errors import ProgramError
from scenewright.program.builder import (
    Scenario,
    always,
    conflict_point,
    just_before,
    si,
    stop_line,
    turn_end,
)
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.program.types import IntentRoute, LanesRoute, Sketch


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


def test_what_a_manner_said_before_stays() -> None:
    scene, _, _ = pair()
    scene.manner(settled_s=1)
    scene.manner(stands_s=2)
    manner = scene.program().manner
    assert (manner.settled_s, manner.stands_s) == (1, 2)


def test_what_is_no_vehicle_sketch_or_list_is_told() -> None:
    scene, ego, _ = pair()
    for measure in (ego.gap_to, ego.freespace, ego.ttc, ego.headway):
        with pytest.raises(TypeError, match="'hero' is not a vehicle"):
            measure("hero", "t1")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="is not a vehicle"):
        stop_line.of("hero")  # type: ignore[arg-type]
    with pytest.raises(ProgramError, match="not a motion sketch"):
        scene.actor("other", "W", sketch=["t0", 3, "t1"])  # type: ignore[arg-type]
    with pytest.raises(ProgramError, match="a list of ids"):
        scene.actor("other", lanes="1.0.-1", sketch="t0 go t1")
    with pytest.raises(ProgramError, match="gap_m is out of range"):
        scene.parameter("gap_m", 50, low=10, high=40)
