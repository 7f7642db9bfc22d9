"""Stretches of a text are whole clauses, each once."""

from __future__ import annotations

import pytest

from scenewright.errors import Span
from scenewright.translate.story import Quote
from scenewright.translate.stretches import clause_around, words_of

TEXT = (
    "The ego, a van, drives west at 2.5 m/s. When it is 25 m before the stop line and the hero is 4 s away, the hero "
    "brakes\nto a stop, then it waits."
)


def quote(words: str) -> Quote:
    start = TEXT.index(words)
    return Quote(start, start + len(words), words)


@pytest.mark.parametrize(
    ("words", "clause"),
    [
        ("25 m", "it is 25 m before the stop line"),
        ("4 s", "the hero is 4 s away"),
        ("2.5 m/s", "drives west at 2.5 m/s"),
        ("a stop", "the hero brakes\nto a stop"),
        ("25 m before the stop line and the hero", "it is 25 m before the stop line and the hero is 4 s away"),
        (TEXT, TEXT.removesuffix(".")),
    ],
)
def test_a_clause_is_found_around_what_is_quoted(words: str, clause: str) -> None:
    found = clause_around(TEXT, quote(words).span)
    assert found.excerpt(TEXT).rstrip(".") == clause
    assert clause_around(TEXT, Span(found.start, found.end)) == found


def test_each_stretch_is_told_once_and_in_one_line() -> None:
    assert words_of([quote("25 m"), quote("stop line"), quote("to a stop")], TEXT) == (
        "it is 25 m before the stop line ... the hero brakes to a stop"
    )
    assert words_of([], TEXT) == ""
