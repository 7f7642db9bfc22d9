"""Which tight tolerance applies to a comparison is told from what is compared."""

from __future__ import annotations

import pytest

from scenarios import example
from scenewright.judge.tolerance import TIGHT as OF_THE_JUDGE
from scenewright.program.text import parse_program
from scenewright.solve.tolerances import TIGHT, compared_dimension


@pytest.mark.parametrize(
    ("line", "dimension"),
    [
        ("A0x(t1) == 5", "length"),
        ("A0v(t1) == 5", "speed"),
        ("A0a(t1) == 5", "acceleration"),
        ("tta(A0, stop_line, t1) == 5", "time"),
        ("headway(A0, A1, t1) == 5", "time"),
        ("gap(A0, A1, t1) == 5", "length"),
        ("A0(t1) == 5", "time"),
        ("5 == A1v(dec)", "speed"),
    ],
)
def test_tolerances_are_told_from_what_is_compared(line: str, dimension: str) -> None:
    program = parse_program(example("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\ntested: {line}"))
    assert compared_dimension(program.constraint("tested").formula) == dimension


def test_they_are_those_that_the_judge_measures_with() -> None:
    assert {dimension: float(value) for dimension, value in TIGHT.items()} == {
        dimension: pytest.approx(OF_THE_JUDGE.of(dimension)) for dimension in TIGHT
    }
