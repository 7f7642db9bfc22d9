"""What a clause says of its subject: deeds, facts of a way, flags, and amounts that a use gives a unit."""

from __future__ import annotations

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.translate.read.attach import read_clause
from scenewright.translate.read.chunks import sentences
from scenewright.translate.read.clauses import Clause
from scenewright.translate.read.narrative import Narrative


def clause(text: str) -> Clause:
    (chunks,) = sentences(text)
    return read_clause([chunk for chunk in chunks if chunk.kind not in ("harmless", "comma")], Narrative(text))


def test_deeds_and_flags() -> None:
    assert clause("the hero gently brakes to a stop").flags == {"standstill"}
    assert clause("the hero does not give way").flags == {"insists"}
    assert clause("the hero has to go").deed == "drive on"
    assert clause("the hero passes the conflict point").is_event


@pytest.mark.parametrize(
    "text", ["the hero is 12 m/s before the stop line", "the hero brakes with an acceleration of 3 m/s^2",
             "the hero yields to the hero", "the hero is 12 before the stop line"],
)  # fmt: skip
def test_what_does_not_go_together_is_left_over(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        clause(text)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("the hero turns left out of the driveway onto the eastbound lane",
         {"turn": "left", "origin": "driveway", "destination": "road", "destination_heading": "E"}),
        ("the hero comes from the east along the road", {"heading": "W", "origin": "road"}),
        ("the hero leaves the eastbound road to the left, into the driveway",
         {"heading": "E", "origin": "road", "turn": "left", "destination": "driveway"}),
        ("the hero turns left into the driveway from the eastbound lane",
         {"turn": "left", "destination": "driveway", "heading": "E", "origin": "road"}),
        ("the hero stays in its lane on the westbound road", {"turn": "straight", "heading": "W", "origin": "road"}),
        ("the hero turns left across the ego's path into the driveway", {"turn": "left", "destination": "driveway"}),
    ],
)  # fmt: skip
def test_ways(text: str, facts: dict[str, str]) -> None:
    assert clause(text).facts == facts


@pytest.mark.parametrize(
    "text",
    ["the hero turns left turns right", "the hero is headed west is headed east", "the hero is to the left",
     "the hero comes from", "the hero is then headed"],
)  # fmt: skip
def test_what_is_no_way_is_left_over(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        clause(text)


def test_what_carries_meaning_is_counted() -> None:
    said = clause("the hero passes the conflict point")
    assert said.is_event
    assert not said.says_more_than("measures")
    assert clause("the hero brakes").says_more_than("measures")
