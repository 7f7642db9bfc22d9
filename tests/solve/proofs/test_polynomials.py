"""Polynomials and formulas: arithmetic, negation, violation."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from posed import violation

from scenewright.solve.proofs.polynomials import (
    FALSE,
    TRUE,
    Polynomial,
    TooHigh,
    compare,
    every,
    polynomial,
    some,
    unknown,
)

X, Y = unknown(0), unknown(1)
NUMBERS = st.fractions(-9, 9, max_denominator=8)
POINTS = st.tuples(NUMBERS, NUMBERS)


@given(NUMBERS, NUMBERS, POINTS)
def test_arithmetic_is_that_of_numbers(a: Fraction, b: Fraction, point: tuple[Fraction, Fraction]) -> None:
    x, y = point
    made = (a * X - Y + b) * (X + 2 * Y) - 3
    assert made.value(point) == pytest.approx(float((a * x - y + b) * (x + 2 * y) - 3), abs=1e-9)
    assert (made - made).terms == {}
    assert (X - b).constant is None
    assert (polynomial(a) + b).constant == a + b


def test_a_third_degree_is_refused() -> None:
    with pytest.raises(TooHigh):
        _ = X * Y * X
    assert (X * Y).degree == 2
    assert polynomial(3).degree == 0


def test_what_holds_or_fails_by_itself_is_a_truth_value() -> None:
    assert compare("<=", 1, 2) == TRUE
    assert compare("<", 2, 2) == FALSE
    assert every([TRUE, compare("<", X, 2)]) == compare("<", X, 2)
    assert every([FALSE, compare("<", X, 2)]) == FALSE
    assert some([TRUE, compare("<", X, 2)]) == TRUE
    assert some([]) == FALSE
    assert every([]) == TRUE


def test_a_violation_is_that_of_the_nearest_alternative() -> None:
    formula = every([some([compare("<=", X, 1), compare(">=", X, 5)]), compare("==", Y, 0)])
    assert violation(formula, (2.0, 0.0)) == 1.0
    assert violation(formula, (4.5, 0.0)) == 0.5
    assert violation(formula, (0.0, -2.0)) == 2.0
    assert violation(FALSE, (0.0, 0.0)) == float("inf")


def test_no_cubic_hides_in_a_sum() -> None:
    assert isinstance(X + Y, Polynomial)
    assert ((X + Y) - Y).terms == X.terms
