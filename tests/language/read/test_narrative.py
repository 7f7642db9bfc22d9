"""The story as it grows: who is meant, which moment, what lies between two deeds."""

from __future__ import annotations

from scenewright.language.read.sentences import read
from scenewright.language.story import Verb


def test_actors_are_numbered_as_they_come_and_the_ego_is_0() -> None:
    story = read("A truck comes from the road. The AV comes from the driveway. A bus and the car 'x' stand.")
    assert [(actor.id, actor.name, actor.kind) for actor in story.actors] == [
        (0, "ego", "car"), (1, "truck", "truck"), (2, "bus", "bus"), (3, "x", "car"),
    ]  # fmt: skip


def test_somebody_that_the_program_language_does_not_know_is_in_the_story() -> None:
    assert read("The ego has an open way. A cyclist brakes to a stop.").actors[1].kind == "cyclist"


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
