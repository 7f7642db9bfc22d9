"""Ways on a map: what the map leaves open is asked, what does not fit is refused."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.roads.load import load_map
from scenewright.roads.model import RoadMap
from scenewright.translate.phrases import Phrases
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Quantity, Story
from scenewright.translate.understand import understand
from scenewright.translate.ways import put_on_map

MAP = load_map("t_intersection")


def ways(text: str, **answers: str) -> Story:
    return put_on_map(read(text), MAP, {name.replace("_", " "): value for name, value in answers.items()})


def told(story: Story) -> list[str]:
    return [Phrases(story).way(actor.way) for actor in story.actors]


def test_facts_that_one_way_fits_become_that_way() -> None:
    story = ways("The ego comes from the driveway and turns left. The hero is on the road, westbound, lane following.")
    assert told(story) == ["is headed south and turns left", "is headed west and goes straight on"]
    assert not story.questions


def test_relations_decide_with_the_other_way() -> None:
    story = ways("The ego is headed west and goes straight on. The hero is oncoming and turns left.")
    assert told(story)[1] == "is headed east and turns left"
    for side, heading in (("left", "west"), ("right", "east")):  # of a driver who comes out of it headed south
        story = ways(f"The ego turns left out of the driveway. A car comes from its {side} and goes straight on.")
        assert told(story)[1] == f"is headed {heading} and goes straight on"
        assert not story.questions


def test_who_is_ahead_is_so_at_the_start() -> None:
    story = ways("The ego is headed west and goes straight on. The hero is ahead of the ego and goes straight on.")
    (gap,) = story.moments[0].conditions
    assert (gap.actor, gap.quantity, gap.op, gap.other) == (0, Quantity.GAP, ">", 1)  # type: ignore[union-attr]


def test_several_ways_are_a_question_and_its_answer_decides() -> None:
    text = "The ego has an open way. An oncoming hero is headed east and turns left."
    (question,) = ways(text).questions
    assert question.slot == "way of ego"
    assert question.default is not None
    assert set(question.alternatives) == {"is headed west and goes straight on", "is headed west and turns right"}
    answered = ways(text, way_of_ego="is headed west and turns right")
    assert not answered.questions
    assert told(answered)[0] == "is headed west and turns right"


def test_who_is_told_where_it_heads_and_not_to_turn_goes_straight_on_and_that_is_told() -> None:
    placed = ways("The ego is headed west. The hero is headed east and turns left.")
    assert (placed.questions, placed.assumptions) == ((), ("ego goes straight on",))
    assert told(placed)[0] == "is headed west and goes straight on"


def test_who_is_ahead_of_one_that_turns_may_turn_too() -> None:
    (question,) = ways("The ego is headed west and turns right. The hero is ahead of the ego.").questions
    assert (question.slot, len(question.alternatives), question.default) == ("way of hero", 2, 0)


def test_no_way_that_fits_is_refused_with_those_that_there_are() -> None:
    with pytest.raises(TranslationError, match="no way on t_intersection fits what is said of the hero") as caught:
        ways("The ego is headed west and goes straight on. The hero is headed north and turns left.")
    assert "right" in (caught.value.expected or "")
    with pytest.raises(TranslationError, match="no way on nothing fits") as caught:
        put_on_map(read("The ego is headed west. The hero is oncoming."), RoadMap("nothing", MAP.source, {}), {})
    assert caught.value.expected == "a map with at least one way through"


def test_who_has_a_gap_at_the_start_and_no_way_begins_in_that_lane() -> None:
    parked = "The ego drives east. A truck is parked 60 m ahead of it. "
    found = understand(parked + "When the ego is 30 m behind the truck, the truck sets off.")
    assert [actor.way.heading for actor in found.story.actors] == ["E", "E"]
    assert not found.questions
    assert "truck begins in the lane of the ego" in found.story.assumptions
