"""Formulas fall into the parts that they are made of, and say whom they speak of."""

from __future__ import annotations

import pytest

from scenarios import example
from scenewright.judge.tolerance import TIGHT as OF_THE_JUDGE
from scenewright.program import expressions as ex
from scenewright.program.printer import print_expression
from scenewright.program.text import parse_program
from scenewright.solve.proofs.forms import TIGHT, asserted, compared_dimension, free_actors, lasting_places

HEAD = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- W\n- [t0, go, t1, dec, t2]\n\nConstraints:\n"


def formula(text: str) -> ex.Formula:
    return parse_program(HEAD + "A0(t1) == A1(t1)\n" + text + "\n").constraints[-1].formula


def body(text: str) -> ex.Formula:
    found = formula(f"always[A1(t0), A1(t2)] ({text})")
    assert isinstance(found, ex.Temporal)
    return found.body


def said(text: str) -> str:
    program = parse_program(HEAD + "A0(t1) == A1(t1)\n" + text + "\n")
    return print_expression(asserted(program.constraints[-1].formula, program))


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("not (A1v(t1) <= 3 or A0v(t1) < 3)", "A1v(t1) > 3 and A0v(t1) >= 3"),
        ("not not (A1v(t1) <= 3)", "A1v(t1) <= 3"),
        ("not (A1v(t1) == 3)", "A1v(t1) < 3 or A1v(t1) > 3"),
        ("A1v(t1) <= 3 implies A0v(t1) <= 3", "A1v(t1) > 3 or A0v(t1) <= 3"),
        ("not (A1v(t1) <= 3 implies A0v(t1) <= 3)", "A1v(t1) <= 3 and A0v(t1) > 3"),
        ("never[1, 2] (A1v <= 3)", "always[1, 2] (A1v > 3)"),
        ("not never[1, 2] (A1v <= 3)", "eventually[1, 2] (A1v <= 3)"),
        ("not always[1, 2] (A1v <= 3)", "eventually[1, 2] (A1v > 3)"),
        ("not eventually[1, 2] (A1v <= 3)", "always[1, 2] (A1v > 3)"),
        ("A1v(dec) <= 3", "always[A1(t1), A1(t2)] (A1v <= 3)"),
        ("not (A1v(dec) <= 3)", "eventually[A1(t1), A1(t2)] (A1v > 3)"),
        ("not (A1a(dec) <= -3)", "A1a(dec) > -3"),
    ],
)
def test_the_same_without_denials(text: str, same: str) -> None:
    assert said(text) == said(same) == print_expression(formula(same))


def test_whom_a_body_speaks_of() -> None:
    assert free_actors(body("A1v <= 3")) == {1}
    assert free_actors(body("A1v <= A0v")) == {0, 1}
    assert free_actors(body("gap(A1, A0) >= 3")) == {0, 1}
    assert free_actors(body("A1v <= A0v(t1)")) == {1}  # that of actor 0 has a moment of its own


def test_what_is_asked_of_a_piece_is_asked_at_each_moment() -> None:
    compared = formula("3 - A1a(dec) * 2 >= 1")
    node = ex.piece_of(compared)
    assert isinstance(compared, ex.Compare)
    assert node is not None
    changed = ex.at_each_moment(compared, node)
    assert ex.piece_of(changed) is None
    assert ex.State(1, 2, None) in list(ex.walk(changed))
    assert ex.piece_of(formula("A1a(t1) <= 3")) is None


def test_what_lasts_of_places_is_told_from_what_is_a_law_of_motion() -> None:
    lines = [
        "always[A1(t0), A1(t1)] (gap(A0, A1) >= 20)",
        "never[A1(t0), 3] (A1x > stop_line and A0v < 2)",
        "always[A1(t0), A1(t1)] (A1v <= 8 and A1a <= 1)",
        "eventually[A1(t0), A1(t1)] (gap(A0, A1) >= 30)",
        "not eventually[1, 2] (tta(A1, stop_line) < 2)",
        "A1v(t1) == 50 or always[1, 2] (A1x >= 5)",
    ]
    program = parse_program(HEAD + "A0(t1) == A1(t1)\n" + "\n".join(lines) + "\n")
    ends = [print_expression(node.end) for node in lasting_places(program)]
    assert ends == ["A1(t1)", "3", "2", "2"]


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
