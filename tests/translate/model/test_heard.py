"""Who is spoken of, and which place: what sentences leave possible."""

from __future__ import annotations

import pytest

from scenewright.translate.model.heard import Heard

CALLED = {0: ("the ego", "The ego", "ego"), 1: ("the van", "A van", "van")}


@pytest.mark.parametrize(
    ("text", "at", "who"),
    [
        ("When the ego is 25 m and the van is 15 m before the stop line, it waits.", "25", {0}),
        ("When the ego is 25 m and the van is 15 m before the stop line, it waits.", "15", {1}),
        ("When the ego is 25 m and the van is 15 m before the stop line, it waits.", "waits", {0, 1}),
        ("The ego drives west. A van comes. It stops 5 m before it.", "5 m", {1}),
        ("25 m before the conflict point the van brakes at 3 m/s^2.", "3 m", {1}),
        ("The van brakes and stops 5 m before the stop line of the ego.", "5 m", {1}),
        ("The distance of the ego to the stop line is 12 m.", "12", {0}),
        ("With the ego 4 s short of the stop line the van goes.", "4 s", {0}),
        ("With the ego 4 s short of the stop line the van goes.", "goes", {1}),
        ("After waiting for 2 s the van goes on.", "2 s", {1}),
    ],
)
def test_who_is_spoken_of(text: str, at: str, who: set[int]) -> None:
    assert Heard(text, CALLED).subjects(text.index(at)) == who


@pytest.mark.parametrize(
    ("text", "at", "place"),
    [
        ("When the ego is 25 m and the van is 15 m before the stop line.", "25", "stop_line"),
        ("The ego is 25 m before the stop line and the van 15 m before the turn.", "15", "turn"),
        ("The ego is 25 m before the stop line and 40 m before the intersection.", "25", "stop_line"),
        ("The stop line is 8 m ahead of the van.", "8", "stop_line"),
        ("The ego is 8 m away.", "8", None),
    ],
)
def test_to_which_place_an_amount_is_counted(text: str, at: str, place: str | None) -> None:
    assert Heard(text, CALLED).place(text.index(at)) == place


def test_longest_name_is_heard_and_a_name_of_two_is_of_both() -> None:
    heard = Heard("The car under test sees the car.", {0: ("The car under test",), 1: ("the car",), 2: ("car",)})
    assert [each.value for each in heard.said[0] if each.kind == "who"] == ["0", "1"]
    both = Heard("A car waits.", {1: ("A car",), 2: ("A car",)})
    assert both.subjects(6) == {1, 2}


def test_clause_of_a_place() -> None:
    text = "The ego is 25 m and the van is 15 m before the stop line."
    told = [each.text for each in Heard(text, CALLED).clause(text.index("15"))]
    assert told == ["the van", "is", "15 m", "before", "the stop line"]


def test_text_without_any_word_of_meaning_is_heard_too() -> None:
    heard = Heard("the a", {0: ("the",)})
    assert heard.subjects(0) == {0}
    assert heard.place(4) is None
