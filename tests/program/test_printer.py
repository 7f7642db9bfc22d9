"""The one form in which each construct is printed, which reads back as the same data."""

from __future__ import annotations

import pytest
from small_programs import formula

from scenarios import EXAMPLE_TABLE, Example
from scenewright.program.printer import print_expression, print_program
from scenewright.program.text import parse_program


@pytest.mark.parametrize("case", EXAMPLE_TABLE, ids=lambda case: case.name)
def test_examples_print_and_parse_without_loss(case: Example) -> None:
    program = case.program()
    text = print_program(program)
    assert parse_program(text) == program
    assert print_program(parse_program(text)) == text


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("A0v(t0) == 36 km/h", "A0v(t0) == 10"),
        ("A0v(t0) == 30 mph", "A0v(t0) == 13.4112"),
        ("A0x(t0) == 100 ft", "A0x(t0) == 30.48"),
        ("A0(t1) == 2 min", "A0(t1) == 120"),
        ("A0a(go) == -1 g", "A0a(go) == -9.80665"),
        ("A0v(t0) == 1/3", "A0v(t0) == 1/3"),
        ("A0v(t0) == 2 * (1/3)", "A0v(t0) == 2 * (1/3)"),
        ("A0v(1/3 s) == 1e-2", "A0v(1/3) == 0.01"),
        ("A0x(t0) == just before stop_line", "A0x(t0) == stop_line - 5"),
        ("A0x(t0) == just before A1.turn_end", "A0x(t0) == A1.turn_end - 5"),
        ("A0x(t1) == A0.conflict_point(A2)", "A0x(t1) == A0.conflict_point(A2)"),
        ("1 < A0v(t0) <= 5", "1 < A0v(t0) and A0v(t0) <= 5"),
        ("not (A0v(t0) > 1 or A0v(t1) > 1)", "not (A0v(t0) > 1 or A0v(t1) > 1)"),
        ("A0v(t0) > 1 implies A0v(t1) > 1 implies A0v(1) > 1", "A0v(t0) > 1 implies (A0v(t1) > 1 implies A0v(1) > 1)"),
        ("A0x(A1(t1)) - 2 - 3 == 4", "A0x(A1(t1)) - 2 - 3 == 4"),
        ("A0x(t1) - (2 - 3) == 4", "A0x(t1) - (2 - 3) == 4"),
        ("A0x(t1) / 2 / 4 == 4", "A0x(t1) / 2 / 4 == 4"),
        ("-A0v(t1) * 2 == -(3)", "-A0v(t1) * 2 == -3"),
        ("tta(A1, A1.stop_line, A0(t1)) == 2", "tta(A1, A1.stop_line, A0(t1)) == 2"),
        ("eventually[A0(t0), 5](A0v < 1 and A0a < 0)", "eventually[A0(t0), 5](A0v < 1 and A0a < 0)"),
    ],
)
def test_constructs_and_their_one_form(text: str, printed: str) -> None:
    assert print_expression(formula(text)) == printed
    assert formula(printed) == formula(text)
