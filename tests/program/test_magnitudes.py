"""Numbers that stay numbers: how large a term may get, its value where it has one, division by what is zero."""

from __future__ import annotations

import math
from contextlib import nullcontext
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_programs import FRAME

from scenewright.errors import ProgramError
from scenewright.program import expressions as ex
from scenewright.program.check import check_program, check_values
from scenewright.program.magnitudes import LONGEST_S, Magnitude, NoNumberError, check_numbers, magnitude
from scenewright.program.printer import print_expression
from scenewright.program.text import parse_program
from strategies import fractions, terms


def test_a_divisor_may_be_a_parameter_that_is_not_zero() -> None:
    text = "parameters:\n- a_m in [0, 10]\n" + FRAME.format("A1x(t1) / a_m <= 3")
    program = parse_program(text)
    check_program(program, text)
    check_values(program, {"a_m": Fraction(2)})
    for value, words in ((Fraction(0), "divided by zero"), (Fraction(1, 10**300), "number of this size")):
        with pytest.raises(ProgramError, match=words):
            check_values(program, {"a_m": value}, text)


NAMES = ["a_m", "b_m"]


def values_of(term: ex.Term, values: dict[str, Fraction], state: float) -> float:
    """Return what a term is worth where all states, places and times are `state`; NaN where it divides by zero."""
    match term:
        case ex.Number(value=value):
            return float(value)
        case ex.ParameterRef(name=name):
            return float(values[name])
        case ex.Negate(operand=operand):
            return -values_of(operand, values, state)
        case ex.Arithmetic(operator=operator, left=left, right=right):
            a, b = values_of(left, values, state), values_of(right, values, state)
            if operator == "/":
                return a / b if b else math.nan
            return {"+": a + b, "-": a - b, "*": a * b}[operator]
        case _:
            return state


@given(term=terms(NAMES), values=st.fixed_dictionaries(dict.fromkeys(NAMES, fractions)), state=st.floats(0.01, 1e4))
def test_no_term_gets_larger_than_told_and_a_constant_is_what_it_is_worth(
    term: ex.Term, values: dict[str, Fraction], state: float
) -> None:
    try:
        told = magnitude(term, values)
    except NoNumberError:
        return
    worth, elsewhere = values_of(term, values, state), values_of(term, values, 0.7 * state)
    if told.constant is not None:
        assert float(told.constant) == pytest.approx(worth, rel=1e-6, abs=1e-6)
        assert worth == pytest.approx(elsewhere, rel=1e-6, abs=1e-6)
    divides = any(isinstance(node, ex.Arithmetic) and node.operator == "/" for node in ex.walk(term))
    if not divides:  # what stands below a line may come nearer to zero than is reckoned with
        assert abs(worth) <= float(told.most) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("term", "most", "constant"),
    [
        ("3 - 5", 2, -2),
        ("2 * 3 / 4", Fraction(3, 2), Fraction(3, 2)),
        ("A1x", 10**4, None),
        ("A1x - A1x", 0, 0),
        ("A1x + A1x", 2 * 10**4, None),
        ("0 * A1x", 0, 0),
        ("A1x * -3", 3 * 10**4, None),
        ("A1x / 2", 5 * 10**3, None),
        ("3 / A1v", 3 * 10**3, None),
        ("a_m * 2", 14, 14),
        ("b_m * 2", 2 * 10**4, None),  # without a value
    ],
)
def test_how_large_a_term_may_get(term: str, most: Fraction, constant: Fraction | None) -> None:
    formula = parse_program(FRAME.format(f"always[0, 1]({term} == 0)")).constraints[0].formula
    assert magnitude(formula.body.left, {"a_m": Fraction(7)}) == Magnitude(Fraction(most), constant)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("line", "late"),
    [
        ("A1v({}) == 0", True),
        ("always[0, {}] (A1v >= 0)", True),
        ("eventually[{}, A1(t1)] (A1v >= 0)", True),
        ("A1(t1) <= {}", False),
    ],
)
def test_no_moment_is_later_than_a_run_lasts(line: str, late: bool) -> None:
    assert LONGEST_S == 120
    for time in ("120", *(("60 + b_m",) if "[" in line else ())):
        check_numbers(parse_program(FRAME.format(line.format(time))).constraints[0].formula, {"b_m": Fraction(60)})
    for time in ("121", *(("60 + b_m",) if "[" in line else ())):
        formula = parse_program(FRAME.format(line.format(time))).constraints[0].formula
        with pytest.raises(NoNumberError, match="no run lasts for 121 s") if late else nullcontext():
            check_numbers(formula, {"b_m": Fraction(61)})


def test_the_fault_is_the_part_that_has_no_value() -> None:
    formula = parse_program(FRAME.format("A1x(t1) <= 3 + A1v(t1) / (a_m - 7)")).constraints[0].formula
    check_numbers(formula, {"a_m": Fraction(8)})
    check_numbers(formula, {})
    with pytest.raises(NoNumberError, match="divided by zero") as caught:
        check_numbers(formula, {"a_m": Fraction(7)})
    assert print_expression(caught.value.term) == "a_m - 7"
