"""Two programs mean the same where a solver finds their constraints equivalent, and every change of meaning is told."""

from __future__ import annotations

import pytest

from scenarios import EXAMPLE_TABLE, Example
from scenewright.program.text import parse_program
from scenewright.study.meaning import differences

TEXT = """
parameters:
- ego_distance_m
- hero_tta_s

Actor 0 (ego):
- S, W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2, stop, t3, acc, t4]

Constraints:
A0x(t0) == stop_line - 50
A0(t1) == A1(t1)
A0x(t1) == stop_line - ego_distance_m
tta(A1, conflict_point, t1) == hero_tta_s
A1x(t2) == conflict_point - 6
A1v(t2) == 0
A1v(stop) == 0
A1x(t4) == conflict_point
A0x(t2) == turn_start
A1(t4) < A0(t2)
"""


def told(changed: str) -> list[str]:
    return differences(parse_program(TEXT), parse_program(changed))


@pytest.mark.parametrize("example", EXAMPLE_TABLE, ids=lambda example: example.name)
def test_every_scenario_means_what_it_means(example: Example) -> None:
    program = example.program()
    assert differences(program, program) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("A0x(t1) == stop_line - ego_distance_m", "stop_line - A0x(t1) == ego_distance_m"),
        ("A0(t1) == A1(t1)", "A1(t1) == A0(t1)"),
        ("A1v(t2) == 0\nA1v(stop) == 0", "A1v(stop) == 0"),
        ("A1(t4) < A0(t2)", "A0(t2) > A1(t4)"),
        ("A1x(t2) == conflict_point - 6", "A1x(t2) + 1 == conflict_point - 5"),
        ("A1x(t2) == conflict_point - 6", "A1x(t3) == conflict_point - 6"),
        ("A0x(t0) == stop_line - 50\nA0(t1) == A1(t1)", "A0(t1) == A1(t1)\nA0x(t0) == stop_line - 50"),
        ("A0x(t1)", "A0x(A1(t1))"),
        ("[t0, go, t1, go, t2]", "[t0, go, t1, go, t2, go, t3]"),
        ("acc, t4]", "acc, t4, go, t5]"),
        ("acc, t4]", "acc, t4, go, t5, stop, t6]"),
    ],
)
def test_another_wording_is_the_same(old: str, new: str) -> None:
    assert old in TEXT
    assert told(TEXT.replace(old, new)) == []


def test_names_of_knots_mean_nothing() -> None:
    other = TEXT
    for number in (4, 3, 2, 1, 0):
        other = other.replace(f"t{number}", f"k{number}")
    assert told(other) == []


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ("stop_line - 50", "stop_line - 51", "lost: A0x(t0)"),
        ("A0(t1) == A1(t1)\n", "", "lost: A0(t1) == A1(t1)"),
        ("A0x(t1) == stop_line", "A0x(t1) == turn_start", "lost: A0x(t1)"),
        ("tta(A1, conflict_point, t1) == hero_tta_s\n", "", "lost: tta"),
        ("A1(t4) < A0(t2)", "A1(t4) > A0(t2)", "lost: A1(t4) < A0(t2)"),
        ("A0x(t2) == turn_start", "A0x(t2) == conflict_point", "added: A0x(t2)"),
        ("A1v(stop) == 0", "A1v(stop) == 0\nA1v(t1) == 9", "added: A1v(t1) == 9"),
        ("- S, W", "- S, E", "route S, E instead of S, W"),
        ("acc, t4", "go, t4", "hero: go, dec, stop, go instead of go, dec, stop, acc"),
        ("acc, t4]", "acc, t4, dec, t5]", "hero: go, dec, stop, acc, dec instead of go, dec, stop, acc"),
        ("acc, t4]\n\nConstraints:", "acc, t4, stop, t5]\n\nConstraints:\nA1v(t5) == 0", "added: A1v(t5) == 0"),
    ],
)
def test_a_change_of_meaning_is_told(old: str, new: str, word: str) -> None:
    assert old in TEXT
    assert any(word in line for line in told(TEXT.replace(old, new)))


def test_a_number_and_a_parameter_of_that_value_are_the_same() -> None:
    given = TEXT.replace("- hero_tta_s", "- hero_tta_s = 3")
    assert differences(parse_program(given), parse_program(TEXT.replace("== hero_tta_s", "== 3"))) == []


SINCE = "A1(t4) < A0(t2)"


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("always[A1(t1), A1(t2)](A1v <= 10)", "never[A1(t1), A1(t2)](A1v > 10)", True),
        ("always[A1(t1), A1(t2)](A1v <= 10)", "always[A1(t1), A1(t2)](A1v <= 11)", False),
        ("always[A1(t1), A1(t2)](A1v <= 10)", "always[A0(t1), A1(t2)](10 >= A1v)", True),
        ("eventually[A1(t1), A1(t2)](A1v <= 3)", "not always[A1(t1), A1(t2)](A1v > 3)", True),
        ("eventually[A0(t0), A0(t1)](A0v >= 12)", "eventually[A0(t0), A0(t2)](A0v >= 12)", False),
        ("A1v(t2) <= 1", "eventually[A1(t1), A1(t2)](A1v <= 0)", True),  # it stops there in any case
        ("A0v(t1) > 3 or A0v(t1) < 2", "not (A0v(t1) <= 3 and A0v(t1) >= 2)", True),
        ("A0v(t1) > 3 or A0v(t1) < 2", "A0v(t1) > 3", False),
        ("A1a(dec) == -3", "-3 == A1a(dec)", True),
        ("A1a(dec) == -3", "A1a(dec) == -2", False),
        ("A1a(dec) == -3", "A1v(t2) - A1v(t1) == -3 * (A1(t2) - A1(t1))", True),
    ],
)
def test_stretches_of_time_rates_and_logic_are_compared_by_meaning(one: str, other: str, same: bool) -> None:
    programs = [parse_program(TEXT.replace(SINCE, f"{SINCE}\n{formula}")) for formula in (one, other)]
    found = differences(*programs)
    assert any(line.startswith(("lost", "added")) for line in found) is not same, found
