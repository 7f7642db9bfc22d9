"""Chunks attach by type and dimension, whatever their order, and nothing that carries meaning is left over."""

from __future__ import annotations

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.translate.read.attach import read_clause
from scenewright.translate.read.chunks import sentences
from scenewright.translate.read.clauses import Clause
from scenewright.translate.read.narrative import Narrative


def clause(text: str) -> Clause:
    (chunks,) = sentences(text)
    return read_clause(chunks, Narrative(text))


@pytest.mark.parametrize(
    "texts",
    [
        (
            "the hero is 12 m before the stop line",
            "the hero before the stop line 12 m",
            "12 m before its stop line the hero is",
        ),
        ("the hero is 3 s from the stop line", "the hero's time to arrival at the stop line is 3 s"),
        (
            "the hero is 20 m behind the ego",
            "the ego is 20 m ahead of the hero",
            "the hero's gap is 20 m behind the ego",
        ),
        ("the hero has a headway of 2 s to the ego", "the hero is 2 s behind the ego"),
        ("the hero drives at 8 m/s", "the hero has a speed of 8 m/s", "the hero's speed is 8 m/s"),
        ("the hero is at the stop line", "the hero reaches its stop line", "the hero arrives at the stop line"),
    ],
)
def test_one_measure_said_in_several_ways(texts: tuple[str, ...]) -> None:
    found = [clause(text).measures for text in texts]
    assert len(found[0]) == 1
    kinds = [(each.quantity, each.op, each.amount, each.place) for (each,) in found]
    assert kinds == kinds[:1] * len(texts)


@pytest.mark.parametrize(
    "text",
    ["the hero is 12 m before", "the hero is 12 m with the ego", "the hero is the ego", "12 m before the stop line",
     "the hero is at least at the stop line", "the hero passes", "the hero brakes and speeds up",
     "the hero is 2 s past the stop line", "the hero turns left turns right"],
)  # fmt: skip
def test_what_is_left_over_is_named(text: str) -> None:
    with pytest.raises(UnknownWordsError, match="could not be understood here"):
        clause(text)
