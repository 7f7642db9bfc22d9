"""Polynomials and formulas: arithmetic, negation, violation, what of them clashes, and their text."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from posed import violation
from scenewright.algebra.polynomials import (
    FALSE,
    TRUE,
    Named,
    Polynomial,
    TooHigh,
    Unknown,
    compare,
    every,
    needed,
    polynomial,
    smtlib,
    some,
    unknown,
)

X, Y = unknown(0), unknown(1)
RANGES = [Unknown("x", Fraction(-1, 3), Fraction(10), "other"), Unknown("y", Fraction(0), Fraction(1), "other")]
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


@pytest.mark.parametrize("seed", range(20))
def test_what_is_needed_clashes_and_nothing_in_it_can_be_left_out(seed: int) -> None:
    draw = random.Random(seed)
    clashing = [set(draw.sample(range(12), draw.randint(1, 4))) for _ in range(3)]

    def clash(items: list[int]) -> bool:
        return any(each <= set(items) for each in clashing)

    found = needed(range(12), clash)
    assert clash(found)
    assert not any(clash([other for other in found if other != item]) for item in found)


def test_what_does_not_clash_by_itself_is_kept() -> None:
    """Whoever gives up asking says that nothing clashes."""
    assert needed("abc", lambda _: False) == ["a", "b", "c"]


# -- text -------------------------------------------------------------------------------------------------------------
def test_numbers_are_exact_and_products_are_written_out() -> None:
    *declared, asserted = smtlib(RANGES, [Named(compare("<", 2 * X * Y, Fraction(1, 3)), "a")]).splitlines()
    assert declared == [
        "(declare-const u0 Real)",
        "(assert (<= (- (/ 1.0 3.0)) u0 10.0))",
        "(declare-const u1 Real)",
        "(assert (<= 0.0 u1 1.0))",
    ]
    assert asserted == "(assert (< (+ (* 2.0 u0 u1) (- (/ 1.0 3.0))) 0.0))"


def test_trees() -> None:
    tree = every([some([compare("==", X, Y), compare("<=", X, 0)]), compare("<=", Y, 1)])
    text = smtlib(RANGES, [Named(tree, "a"), Named(FALSE, "b")])
    assert "(assert (and (or (= (+ u0 (* (- 1.0) u1)) 0.0) (<= u0 0.0)) (<= (+ u1 (- 1.0)) 0.0)))" in text
    assert "(assert false)" in text
