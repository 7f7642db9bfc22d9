"""Every constraint in plain words, whatever program it is; what has none stays code and nothing is left out."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from random_stories import told_stories

from scenewright.errors import Span
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from scenewright.study.benchmark import benchmark_rows
from scenewright.translate.compile import clause_around, compile_story
from scenewright.translate.decompile import decompiled
from scenewright.translate.lines import (
    in_words,
    lines_of_program,
    lines_of_story,
    named,
    told_constraints,
    told_knots,
    words_of,
)
from scenewright.translate.story import Quote

ROOT = Path(__file__).resolve().parents[2]
LETTERS = re.compile(r"\bA\d+[xva(.]|==|<=|>=|\bt\d\b")
SAID = (
    "The ego, a van, drives west at 2.5 m/s. When it is 25 m before the stop line and the hero is 4 s away, the hero "
    "brakes\nto a stop, then it waits."
)
TEXT = "It brakes at once."
PROGRAM = f"""
description:
"{TEXT}"
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]
Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]
Constraints:
A0x(t0) == stop_line - 60
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30  @3..9
rate: A1a(dec) == -3
A1v(t2) == 0
A0x(t2) == conflict_point
A1(t2) < A0(t2)
odd: A1v(t1) * A0v(t0) == 12
"""


def program(text: str = PROGRAM) -> Program:
    return parse_program(text)


def test_constraints_are_clauses_that_say_when() -> None:
    assert list(told_constraints(program()).values()) == [
        "the ego is 60 m before the stop line at the start",
        "all of this is at one moment, when the hero begins to brake",
        "the ego is 30 m before the conflict point when the hero begins to brake",
        "the hero has a deceleration of 3 m/s^2 while it brakes",
        "the hero stands when it finishes braking",
        "the ego passes the conflict point",
        "the hero finishes braking before the ego passes the conflict point",
        "A1v(t1) * A0v(t0) == 12",
    ]


def test_a_moment_by_the_clock_is_told_with_each_clause() -> None:
    told = told_constraints(program(f"{PROGRAM.rstrip()}\nA1x(2.5) == stop_line - 3\nA1v(2.5) <= 9\n"))
    assert list(told.values())[-2:] == [
        "the hero is 3 m before the stop line 2.5 s after the start",
        "the hero drives at a speed of at most 9 m/s 2.5 s after the start",
    ]


def test_what_has_no_words_is_told_as_code_below_the_rest() -> None:
    lines = lines_of_program(program())
    assert [line.sentence for line in lines[-1:]] == ["Besides: A1v(t1) * A0v(t0) == 12."]
    assert [line.words for line in lines if "30 m" in line.sentence] == [TEXT.removesuffix(".")]
    only = program(PROGRAM.replace("[t0, go, t1, go, t2]", "[t0, go, t1, dec, t2]"))  # no story: a deed of the ego
    told = [line.sentence for line in lines_of_program(only)]
    assert told[0] == "The ego is headed west and goes straight on."
    assert len(told) == 2 + len(only.constraints)


def test_knots_are_told_by_what_happens_at_them() -> None:
    assert told_knots(program()) == {
        (0, "t0"): "start",
        (1, "t0"): "start",
        (0, "t1"): "the hero begins to brake",
        (1, "t1"): "the hero begins to brake",
        (0, "t2"): "the ego passes the conflict point",
        (1, "t2"): "the hero finishes braking",
    }


def test_a_name_that_somebody_gave_is_kept_and_words_of_a_text_come_first() -> None:
    whole = program()
    assert named(whole, whole.constraint("rate")).startswith("rate: the hero has a deceleration")
    assert not named(whole, whole.constraints[0]).startswith("c1")
    assert in_words(whole, whole.constraints[2]) == "brakes"
    assert in_words(whole, whole.constraints[0]).startswith("the ego is 60 m")


@pytest.mark.parametrize("row", benchmark_rows(), ids=lambda row: str(row.id))
def test_programs_of_the_benchmark_have_words_for_all_they_say(row: object) -> None:
    whole = parse_program(row.program_text)  # type: ignore[attr-defined]
    told = [*told_constraints(whole).values(), *(line.sentence for line in lines_of_program(whole))]
    assert not [each for each in told if LETTERS.search(each) or not each]


def test_random_stories_have_words_for_each_constraint() -> None:
    for story, _ in told_stories(60):
        whole = compile_story(story)
        untold = {each.id for each in decompiled(whole, leniently=True).untold}
        assert not [
            each for name, each in told_constraints(whole).items() if name not in untold and LETTERS.search(each)
        ]
        assert lines_of_story(story, "")


def quote(words: str) -> Quote:
    start = SAID.index(words)
    return Quote(start, start + len(words), words)


@pytest.mark.parametrize(
    ("words", "clause"),
    [
        ("25 m", "it is 25 m before the stop line"),
        ("4 s", "the hero is 4 s away"),
        ("2.5 m/s", "drives west at 2.5 m/s"),
        ("a stop", "the hero brakes\nto a stop"),
        ("25 m before the stop line and the hero", "it is 25 m before the stop line and the hero is 4 s away"),
        (SAID, SAID.removesuffix(".")),
    ],
)
def test_a_clause_is_found_around_what_is_quoted(words: str, clause: str) -> None:
    found = clause_around(SAID, quote(words).span)
    assert found.excerpt(SAID).rstrip(".") == clause
    assert clause_around(SAID, Span(found.start, found.end)) == found


def test_each_stretch_is_told_once_and_in_one_line() -> None:
    assert words_of([quote("25 m"), quote("stop line"), quote("to a stop")], SAID) == (
        "it is 25 m before the stop line ... the hero brakes to a stop"
    )
    assert words_of([], SAID) == ""
