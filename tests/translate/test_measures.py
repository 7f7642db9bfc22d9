"""Comparisons become measures, with the amounts that somebody most likely wrote."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.expressions import Compare
from scenewright.program.text import parse_program
from scenewright.translate.measures import measure_of
from scenewright.translate.phrases import Phrases
from scenewright.translate.story import Actor, Story

TWO = """
Actor 0 (ego):
- W
- [t0, go, t1]
Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]
Constraints:
A0(t1) == A1(t1)
"""
PHRASES = Phrases(Story((Actor(0, "ego"), Actor(1, "hero"))))


def told(formula: str) -> str | None:
    program = parse_program(TWO + formula)
    compare = program.constraints[-1].formula
    assert isinstance(compare, Compare)
    measure = measure_of(compare, program)
    return None if measure is None else PHRASES.clause(measure)


@pytest.mark.parametrize(
    ("written", "amount"),
    [
        ("12.5 m/s", "12.5 m/s"), ("13.89 m/s", "13.89 m/s"), ("50 km/h", "50 km/h"), ("30 mph", "30 mph"),
        ("100/3 m/s", "120 km/h"), ("1/7 m/s", "1/7 m/s"),
    ],
)  # fmt: skip
def test_an_amount_is_told_in_the_unit_that_somebody_wrote(written: str, amount: str) -> None:
    assert told(f"A1v(t1) == {written}") == f"the hero drives at {amount}"


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("A0x(t1) == stop_line - 12", "the ego is 12 m before the stop line"),
        ("12 == stop_line - A0x(t1)", "the ego is 12 m before the stop line"),
        ("stop_line - A0x(t1) >= 80 ft", "the ego is at least 80 ft before the stop line"),
        ("A1a(t1) <= -3", "the hero has a deceleration of at least 3 m/s^2"),
        ("A1v(t1) - A0v(t1) > 2", "the hero drives more than 2 m/s faster than the ego"),
        ("gap(A1, A0, t1) == -20", "the ego is 20 m behind the hero"),
        ("tta(A0, conflict_point, t1) <= 4", "the ego is at most 4 s from the conflict point"),
    ],
)
def test_however_it_is_written_it_is_one_measure(formula: str, words: str) -> None:
    assert told(formula) == words


def test_what_is_no_measure_is_none_and_a_sum_of_amounts_is_refused() -> None:
    assert told("A0x(t1) + A1x(t1) == 12") is None
    assert told("A1v(t2) - A1v(t1) == 1") is None
    with pytest.raises(TranslationError, match="sum of amounts"):
        told("A0x(t1) == stop_line - gap_m - other_m")
