"""From program to story: one form for what can be written in many, and refusals by name."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.expressions import Compare
from scenewright.program.text import parse_program
from scenewright.study.meaning import differences
from scenewright.translate.compile import compile_story
from scenewright.translate.decompile import decompile, measure_of
from scenewright.translate.phrases import Phrases
from scenewright.translate.story import Actor, Story

HEAD = (
    "Actor 0 (av):\n- W\n- [s, go, m, go, e]\n\nActor 1 (hero):\n- E, N\n- [s, go, m, dec, e, stop, u, acc, v]\n\n"
    "Constraints:\nA0(m) == A1(m)\nA0x(m) == conflict_point - 30\n"
)
SAME = (
    ("A1x(m) == conflict_point - 20", "conflict_point - A1x(m) == 20"),
    ("A1x(m) <= conflict_point - 20", "20 <= conflict_point - A1x(m)"),
    ("A1v(m) == 8", "2 * A1v(m) == 16"),
    ("A1a(dec) >= -3", "-A1a(dec) <= 3"),
    ("A1(e) - A1(m) >= 3", "A1(m) + 3 <= A1(e)"),
    ("A1(e) < A0(e) and A0x(e) == conflict_point", "A0(e) > A1(e) and conflict_point == A0x(e)"),
    ("A1v(A0(m)) >= 4", "A1v(m) >= 4"),
    ("not always[A1(s), A1(m)] (A1v <= 9)", "eventually[A1(s), A1(m)] (not (A1v <= 9))"),
    ("A1(m) == 5 s", "A0(m) == 5"),
    ("A1v(m) == 50 km/h", "A1v(m) == 125/9"),
)
UNTOLD = (
    "A1x(e) - A1x(m) == 12",
    "A1v(e) * A1v(m) == 12",
    "A1v(m) == 2 * A1v(s)",
    "A1x(m) == conflict_point - a_m - b_m",
    "A1x(m) == conflict_point - 2 * a_m",
    "A1v(m) == 5 or always[1, 2] (A1v >= 9)",
    "A0v(go1) <= 9",
    "a_m <= 12 m",
    "A1v(m) >= 4 or A1v(e) == 0",
    "A1(e) + A1(m) == 12",
)


@pytest.mark.parametrize(("one", "other"), SAME)
def test_two_ways_to_write_it_are_one_story(one: str, other: str) -> None:
    first, second = (decompile(parse_program(f"{HEAD}{each}\n")) for each in (one, other))
    assert compile_story(first).constraints[-2:] == compile_story(second).constraints[-2:] or first == second


@pytest.mark.parametrize("constraint", UNTOLD)
def test_what_has_no_story_is_refused_by_name(constraint: str) -> None:
    with pytest.raises(TranslationError) as caught:
        decompile(parse_program(f"{HEAD}{constraint}\n"))
    assert "cannot be told in words yet" in caught.value.message


@pytest.mark.parametrize("constraint", [SAME[0][1], SAME[3][1], SAME[4][1], SAME[5][1]])
def test_the_compiler_writes_it_with_the_same_meaning(constraint: str) -> None:
    """By another judge of meaning, which asks a solver."""
    program = parse_program(f"{HEAD}{constraint}\nA1v(e) == 0\nA1v(stop) == 0\nA1v(v) == 5\n")
    assert differences(program, compile_story(decompile(program))) == []


def test_a_knot_of_the_ego_of_which_nothing_is_asked_is_no_moment() -> None:
    story = decompile(parse_program(HEAD))
    assert (len(story.ego), story.actors[0].name) == (1, "ego")


def test_a_deed_of_the_ego_has_no_story() -> None:
    with pytest.raises(TranslationError, match="a deed of the ego"):
        decompile(parse_program(HEAD.replace("[s, go, m, go, e]", "[s, go, m, dec, e]")))


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
        ("tta(A0, conflict_point, t1) <= 4", "the ego is at most 4 s from the conflict point or past it"),
    ],
)
def test_however_it_is_written_it_is_one_measure(formula: str, words: str) -> None:
    assert told(formula) == words


def test_what_is_no_measure_is_none_and_a_sum_of_amounts_is_refused() -> None:
    assert told("A0x(t1) + A1x(t1) == 12") is None
    assert told("A1v(t2) - A1v(t1) == 1") is None
    with pytest.raises(TranslationError, match="sum of amounts"):
        told("A0x(t1) == stop_line - gap_m - other_m")
