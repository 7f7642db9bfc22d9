"""Lists of clauses, joined conditions, and where a sentence is cut."""

from __future__ import annotations

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.translate import story as st
from scenewright.translate.read.chunks import sentences
from scenewright.translate.read.clauses import Clause
from scenewright.translate.read.items import items_of, parted, segments_of
from scenewright.translate.read.narrative import Narrative

A, B, C = "the ego stands", "the hero drives at 5 m/s", "the hero is 3 m before the stop line"


def shape(text: str) -> list[object]:
    (chunks,) = sentences(text)

    def of(item: object) -> object:
        if isinstance(item, Clause) and item.joined:
            (item,) = item.joined
        return (item.joint, *map(of, item.parts)) if isinstance(item, st.Compound) else "clause"

    return [of(item) for item in items_of(Narrative(text), chunks)]


def test_lists_and_joined_conditions() -> None:
    assert shape(f"{A}, {B} and {C}") == ["clause"] * 3
    assert shape(f"either {A} or both {B} and {C}") == [("or", "clause", ("and", "clause", "clause"))]
    assert shape(f"if both {A} and {B} then it is not so that {C}") == [
        ("if", ("and", "clause", "clause"), ("not", "clause"))
    ]


@pytest.mark.parametrize("text", [f"either {A}", f"if {A}", f"if {A} then {B} then {C}", f"both {A}"])
def test_half_a_condition_is_refused(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        shape(text)


def test_before_is_a_link_where_a_clause_follows() -> None:
    (chunks,) = sentences("the hero stands 5 m before the stop line at least 2 s before the ego begins to turn")
    segments = segments_of(chunks)
    assert [segment.link for segment in segments] == ["main", "before"]
    assert [op for op, _ in segments[1].margins] == [">="]


def test_a_moment_ends_at_the_comma_before_a_deed() -> None:
    (chunks,) = sentences(f"{A}, {B}, the hero brakes, coming to a halt")
    assert [chunk.value for chunk in parted(chunks)[1][:2]] == ["hero", "brake"]
    with pytest.raises(UnknownWordsError, match="where the moment ends"):
        parted(chunks[:2])


def test_a_list_of_three_that_nothing_is_said_of_is_refused() -> None:
    with pytest.raises(UnknownWordsError, match="nothing is said"):
        shape("the ego, the bus and the van stand")
    assert shape("the hero, travelling west, stands") == ["clause"] * 3
