"""Who is meant: by name, kind and what describes somebody; pronouns; and questions where two fit."""

from __future__ import annotations

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.program.printer import print_expression
from scenewright.translate.read.cast import NEW
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Measure, Story, within
from scenewright.translate.understand import understand

EGO = "The ego turns left out of the driveway. "


def heroes(story: Story) -> list[tuple[str, str]]:
    return [(actor.name, actor.kind) for actor in story.heroes]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("A red delivery van drives west. The van brakes.", [("van", "van")]),
        ("A pickup drives west. The car brakes. The vehicle drives on.", [("car", "car")]),
        ("A red car drives west. A blue car drives east. The blue car brakes.", [("car", "car"), ("blue car", "car")]),
        ("The other car drives west. It brakes.", [("car", "car")]),
        ("A truck drives west. Another truck drives east.", [("truck", "truck"), ("truck 2", "truck")]),
        ("The hero drives west. The car 'x' drives east.", [("hero", "car"), ("x", "car")]),
        ("A cyclist drives west.", [("cyclist", "cyclist")]),
    ],
)
def test_people(text: str, names: list[tuple[str, str]]) -> None:
    answers = {f"who {text.find('blue car', 20) + 5}": NEW}
    assert heroes(read(EGO + text, answers)) == names


def test_a_second_one_of_a_kind_is_asked_about() -> None:
    text = EGO + "A car drives west. When a car is 20 m before the conflict point, it brakes."
    (question,) = read(text).questions
    assert question.alternatives == ("car", NEW)
    assert [len(heroes(read(text, {question.slot: told}))) for told in question.alternatives] == [1, 2]


def test_our_car_is_the_ego_and_the_car_may_be_too() -> None:
    (question,) = read("Our car drives west. The car brakes.").questions
    assert "ego" in question.alternatives


def test_what_describes_somebody_tells_its_way() -> None:
    story = read(EGO + "When the westbound car is 20 m before the conflict point, the oncoming truck brakes.")
    assert (story.actors[1].way.heading, story.actors[2].relations[0].kind) == ("W", "oncoming")


def test_who_does_something_is_not_the_ego() -> None:
    story = read("The ego drives west. The hero is ahead of it. When the ego is 9 m behind the hero, it brakes.")
    assert story.deeds[-1].actor == 1
    assert not story.questions


@pytest.mark.parametrize("text", ["They brake.", "The hero is an ego.", "The hero is a hero of the ego."])
def test_who_cannot_be_told_apart_is_refused(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        read(EGO + "A bus drives west. A van drives east. The hero drives west. " + text)


def test_a_second_one_is_somebody_new_and_the_first_one_is_the_other() -> None:
    text = "The ego drives west. A car drives west 40 m ahead of the ego. A second car drives west 30 m ahead of the "
    text += "first car. When the ego is 25 m behind the first car, the second car brakes."
    story = understand(text).story
    assert [actor.name for actor in story.actors] == ["ego", "car", "second car"]
    program = understand(text).program
    formulas = {print_expression(each.formula) for each in program.constraints}
    assert {"gap(A1, A2, t0) == 30", "gap(A0, A1, t1) == 25", "A0(t1) == A2(t1)"} <= formulas


def test_the_second_one_is_not_the_first_though_nobody_calls_that_so() -> None:
    text = "The ego drives west. An oncoming car turns left. A second car turns right out of the driveway. When the "
    text += "ego is 40 m before the conflict point, the second car brakes."
    program = understand(text).program
    assert [" ".join(actor.sketch.pieces) for actor in program.heroes] == ["go", "go dec"]


def test_the_other_one_is_not_who_was_spoken_of_last() -> None:
    text = "The ego drives west. A red car is oncoming and turns left. A blue car turns right out of the driveway. "
    text += "When the ego is 40 m before the intersection, the red car brakes. Then the other car speeds up to 8 m/s."
    assert [" ".join(actor.sketch.pieces) for actor in understand(text).program.heroes] == ["go dec", "go acc"]


TWO = "The ego turns left out of the driveway. The hero drives west. A van drives east. "


@pytest.mark.parametrize(
    ("said", "partners", "is_asked"),
    [
        ("When the ego is 12 m before the conflict point, the van brakes.", {2}, False),
        ("When the ego is 12 m before the conflict point, the hero brakes.", {None}, False),
        ("When the ego is 12 m before the conflict point with the van, the hero brakes.", {2}, False),
        ("When the ego is 12 m before the conflict point, a truck from the left brakes.", {3}, False),
        (
            "When the ego passes the stop line, the van goes on to pass the conflict point before the ego.",
            {2},
            False,
        ),
        ("When the ego is 12 m before the conflict point and the hero is 4 s from it, the van brakes.", {None}, True),
        ("At the start, the ego is 60 m before the conflict point.", {None}, True),
    ],
)
def test_a_conflict_point_of_the_ego_is_that_with_whom_the_sentence_is_about(
    said: str, partners: set[int | None], is_asked: bool
) -> None:
    story = read(TWO + said)
    places = [each.place for each in within(story.moments, Measure) if each.actor == 0 and each.place is not None]
    assert {place.partner for place in places if place.name == "conflict_point"} == partners
    assert any(question.slot.startswith("conflict point") for question in story.questions) is is_asked
