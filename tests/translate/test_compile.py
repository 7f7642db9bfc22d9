"""From story to program: what the program language does not know is refused by name."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from scenewright.errors import ProgramError, TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute, IntentRoute, LanesRoute
from scenewright.translate import story as st
from scenewright.translate.compile import compile_story, route_of
from scenewright.translate.decompile import way_of

STORY = st.Story(
    (st.Actor(0, "ego", st.Way(heading="W", turn="straight")), st.Actor(1, "hero", st.Way(heading="E", turn="left"))),
    (
        st.Moment(),
        st.Moment((st.Measure(0, st.Quantity.PLACE, "==", st.Amount(Fraction(30), "ft"), st.Place("stop_line")),)),
        st.Moment((st.Measure(1, st.Quantity.SPEED, "==", st.Amount(Fraction(0), "m/s")),)),
    ),
    (1,),
    (st.Deed(1, st.Verb.DRIVE, 0, 1), st.Deed(1, st.Verb.BRAKE, 1, 2)),
)


def test_a_story_becomes_the_program_of_the_paper() -> None:
    program = compile_story(STORY)
    formulas = [print_expression(constraint.formula) for constraint in program.constraints]
    assert formulas == ["A0(t1) == A1(t1)", "A0x(t1) == stop_line - 9.144", "A1v(t2) == 0"]
    assert program.ego.sketch.knots == ("t0", "t1", "t2")  # it drives on after the moment that it shares


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        (replace(STORY, actors=(*STORY.actors, st.Actor(2, "Anna", kind="pedestrian"))), "a pedestrian"),
        (replace(STORY, deeds=(*STORY.deeds, st.Deed(1, "change lanes", 2, 2))), "'change lanes'"),
        (replace(STORY, deeds=(*STORY.deeds, st.Deed(0, st.Verb.BRAKE, 0, 1))), "a deed of the ego"),
        (replace(STORY, deeds=(*STORY.deeds, st.Deed(1, st.Verb.STAND, 0, 2))), "two deeds of hero at one time"),
        (replace(STORY, holds=(st.Hold("always", st.Point(3), st.Point(0), STORY.moments[2].conditions[0]),),
                 moments=(*STORY.moments, st.Moment())), "a moment that is nobody's"),
        (replace(STORY, actors=(STORY.actors[0], replace(STORY.actors[1], relations=(st.Relation("above", 0),)))),
         "that somebody is above"),
    ],
)  # fmt: skip
def test_what_cannot_be_said_is_refused_by_name(changed: st.Story, named: str) -> None:
    with pytest.raises(TranslationError) as caught:
        compile_story(changed)
    assert caught.value.message == f"{named} cannot be said in a program yet"
    assert caught.value.fix


def test_a_speed_in_metres_is_no_program() -> None:
    wrong = st.Moment((st.Measure(1, st.Quantity.SPEED, "==", st.Amount(Fraction(3), "m")),))
    with pytest.raises(ProgramError, match="two different things are compared"):
        compile_story(replace(STORY, moments=(*STORY.moments[:2], wrong)))


def test_ways_are_whole_where_the_facts_are() -> None:
    for route in (HeadingsRoute(("W",)), HeadingsRoute(("S", "W")), HeadingsRoute(("S", "E")), LanesRoute(("1.0.-1",)),
                  HeadingsRoute(("W", "W")), HeadingsRoute(("N", "E", "N")), IntentRoute("driveway", "left"),
                  IntentRoute(), IntentRoute("road", None, "driveway", "W", "N")):  # fmt: skip
        assert route_of(way_of(route)) == route
