"""The story as it grows: who is meant, which moment, what lies between two deeds."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.errors import ProgramError, UnknownWordsError
from scenewright.translate import story as st
from scenewright.translate.read.narrative import Narrative, take_labels
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Verb

WAYS = "The ego turns left out of the driveway. The hero drives west along the road. "
STOPS = WAYS + "When the ego is 12 m before the stop line, the hero stops 5 m before the conflict point. "


def test_actors_are_numbered_as_they_come_and_the_ego_is_0() -> None:
    story = read("A truck comes from the road. The AV comes from the driveway. A bus and the car 'x' stand.")
    assert [(actor.id, actor.name, actor.kind) for actor in story.actors] == [
        (0, "ego", "car"), (1, "truck", "truck"), (2, "bus", "bus"), (3, "x", "car"),
    ]  # fmt: skip
    assert read("The ego has an open way. A cyclist brakes.").actors[1].kind == "cyclist"  # refused when it is compiled


def test_what_lies_between_two_deeds() -> None:
    start = "The ego has an open way. The hero brakes until it drives at 3 m/s. "
    then = "When the ego is at the stop line, the hero begins to speed up until it drives at 9 m/s."
    assert [deed.verb for deed in read(start + then).deeds] == [Verb.BRAKE, Verb.DRIVE, Verb.SPEED_UP]


def test_two_heroes_at_moments_of_the_ego_whose_order_is_not_said() -> None:
    text = (
        "The ego has an open way. When the ego is 30 m before the stop line, the truck begins to brake. "
        "When the ego drives at 5 m/s, the van begins to brake."
    )
    (question,) = read(text).questions
    either, later = question.alternatives
    assert [len(read(text, {question.slot: answer}).ego) for answer in (either, later)] == [1, 2]
    assert not read(f"{text} In the ego's order: the truck begins to brake.").questions
    for word in ("Later", "Then", "After that", "Afterwards"):
        told = read(text.replace("When the ego drives", f"{word}, when the ego drives"))
        assert (len(told.ego), told.questions) == (2, ()), word


def test_deeds_at_the_moment_that_was_told() -> None:
    start = "The ego has an open way. When the ego is 30 m before the stop line, "
    both = read(f"{start}the truck brakes and the van speeds up.")
    assert len({deed.begins for deed in both.deeds if deed.verb != Verb.DRIVE}) == 1
    later = read(f"{start}the van is 20 m before the conflict point. Then the van speeds up.")
    assert later.deeds[1].begins == 1
    assert len(later.moments[1].conditions) == 2


def test_a_deed_after_an_event_begins_after_it() -> None:
    story = read("The ego has an open way. The hero brakes to a stop 2 s after the ego is at the stop line.")
    (order,) = story.orders
    assert (order.first, order.second) == (story.ego[0], story.deeds[1].begins)
    assert story.deeds[0].verb == Verb.DRIVE
    with pytest.raises(UnknownWordsError, match="nothing was told of this event"):
        read("The ego has an open way. The hero brakes to a stop after it passes the stop line.")


def test_where_a_deed_begins() -> None:
    story = read("The ego has an open way. The hero brakes 15 m before the stop line.")
    assert [deed.verb for deed in story.deeds] == [Verb.DRIVE, Verb.BRAKE]


def test_who_stops_for_some_time_stands_for_it() -> None:
    story = read("The ego has an open way. The hero stops at the stop line for 3 s and drives on.")
    assert [deed.verb for deed in story.deeds] == [Verb.BRAKE, Verb.STAND, Verb.DRIVE]
    (order,) = story.orders
    assert (order.first, order.second, order.op) == (story.deeds[1].begins, story.deeds[1].ends, "==")
    with pytest.raises(UnknownWordsError, match="lasts so long"):
        read("The ego has an open way. The hero brakes to a standstill for 3 s.")


def test_what_is_told_behind_a_passing_is_after_it_or_meanwhile_which_is_asked() -> None:
    start = (
        "The ego has an open way. The hero is 40 m from its stop line. When the ego is 30 m from the conflict point, "
    )
    text = f"{start}the hero goes first. It accelerates at 2 m/s^2."
    story = read(text)
    (question,) = (each for each in story.questions if "accelerates" in each.text)
    assert [deed.verb for deed in story.deeds] == [Verb.DRIVE, Verb.DRIVE, Verb.SPEED_UP]
    meanwhile = read(text, {question.slot: "meanwhile"})
    assert [deed.verb for deed in meanwhile.deeds] == [Verb.DRIVE, Verb.SPEED_UP]
    assert meanwhile.deeds[1].throughout == story.deeds[2].throughout


def test_who_stands_at_the_start_stands_until_it_does_something() -> None:
    start = "The ego has an open way. A truck stands at the stop line. When the ego is 30 m from the conflict point, "
    story = read(f"{start}the truck sets off.")
    assert [deed.verb for deed in story.deeds] == [Verb.STAND, Verb.DRIVE]
    assert story.assumptions == ("truck stands still until then",)


def test_the_same_is_one_moment_and_a_deed_may_end_at_a_stop() -> None:
    twice = "When the ego is 12 m before the stop line, the truck brakes until it comes to a stop."
    story = read(f"{STOPS}{twice}")
    assert len({deed.begins for deed in story.deeds if deed.verb == "brake"}) == 1
    (stands,) = story.moments[story.deeds[-1].ends].conditions
    assert (stands.actor, stands.amount and stands.amount.value) == (2, 0)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    "text",
    [
        "It waits until the ego has passed the conflict point. Then it drives on.",
        "Once the ego has passed the conflict point, it drives on.",
        "When the ego has passed, it drives on.",
        "It waits until the ego has passed. Then it drives on.",
    ],
)
def test_who_waits_goes_on_after_what_it_waits_for(text: str) -> None:
    story = read(STOPS + text)
    (passed,) = (each for each in story.moments[story.deeds[-1].begins].conditions if isinstance(each, st.Measure))
    assert (passed.actor, passed.place, passed.op) == (0, st.Place("conflict_point"), ">=")
    assert story.ego[-1] == story.deeds[-1].begins
    assert [deed.verb for deed in story.deeds] == ["drive on", "brake", "stand still", "drive on"]
    assert ("'ego has passed' is of the conflict point" in story.assumptions) == ("has passed the" not in text)


@pytest.mark.parametrize(
    "text", ["When the hero turns left, the truck brakes.", "When the bus brakes, the hero stops."]
)
def test_what_is_no_condition_or_was_not_told_is_refused(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        read(WAYS + text)


def test_labels_are_taken_and_offsets_stay() -> None:
    limit = "Parameter limit_kmph is 10 m/s, from 5 km/h to 50 km/h."
    text = f"Title: a. b\nMap: town\nManner: stands_s is 2000 ms.\n{limit}\nThe ego"
    narrative = Narrative(text)
    rest = take_labels(text, narrative)
    assert len(rest) == len(text)
    assert rest.replace(".", " ").split() == ["The", "ego"]
    assert (narrative.title, narrative.map_name, narrative.manner.stands_s) == ("a. b", "town", 2)
    (parameter,) = narrative.parameters
    assert (parameter.value, parameter.low, parameter.high) == (Fraction(36), 5, 50)


@pytest.mark.parametrize("line", ["Parameter gap is 3 m.", "Parameter gap_m is 3 s.", "Manner: stands_s is 900 s."])
def test_labels_that_make_no_sense(line: str) -> None:
    with pytest.raises((UnknownWordsError, ProgramError)):
        take_labels(line, Narrative(line))
