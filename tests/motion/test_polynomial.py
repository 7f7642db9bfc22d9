"""Polynomial pieces: derivatives at any moment, and bounds that hold over the whole piece."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import smtlib
from scenewright.motion.algebra import Symbol, smt
from scenewright.motion.polynomial import bernstein_coefficients, state_after

ratios = st.fractions(-30, 30, max_denominator=40)
derivatives = st.lists(ratios, min_size=3, max_size=6)
durations = st.fractions(0, 20, max_denominator=30)


def by_numpy(rates: list[Fraction], elapsed: float, order: int) -> float:
    """The same polynomial by another road: power coefficients, differentiated by numpy."""
    factorials = np.cumprod([1, *range(1, len(rates))])
    polynomial = np.polynomial.Polynomial(
        [float(rate) / factor for rate, factor in zip(rates, factorials, strict=True)]
    )
    return float(polynomial.deriv(order)(elapsed)) if order else float(polynomial(elapsed))


@given(derivatives, durations, st.sampled_from([0, 1, 2]))
def test_state_after_is_the_taylor_polynomial(rates: list[Fraction], elapsed: Fraction, order: int) -> None:
    exact = state_after(rates, elapsed, order)
    assert float(exact) == pytest.approx(by_numpy(rates, float(elapsed), order), rel=1e-9, abs=1e-6)


@given(derivatives, durations, st.sampled_from([0, 1, 2]))
def test_symbols_give_what_numbers_give(rates: list[Fraction], elapsed: Fraction, order: int) -> None:
    names = [f"r{k}" for k in range(len(rates))]
    symbolic = state_after([Symbol(name) for name in names], Symbol("t"), order)
    known = dict(zip(names, rates, strict=True)) | {"t": elapsed}
    assert smtlib.value(smt(symbolic), known) == state_after(rates, elapsed, order)


@given(derivatives, durations, st.sampled_from([0, 1]), st.fractions(0, 1, max_denominator=50))
def test_bernstein_coefficients_bound_every_instant(
    rates: list[Fraction], duration: Fraction, order: int, part: Fraction
) -> None:
    coefficients = bernstein_coefficients(rates, duration, order)
    inside = state_after(rates, duration * part, order)
    assert min(coefficients) <= inside <= max(coefficients)


@given(derivatives, durations, st.sampled_from([0, 1, 2]))
def test_bernstein_coefficients_are_tight_at_the_ends(rates: list[Fraction], duration: Fraction, order: int) -> None:
    coefficients = bernstein_coefficients(rates, duration, order)
    assert len(coefficients) == len(rates) - order
    assert coefficients[0] == rates[order]
    assert coefficients[-1] == state_after(rates, duration, order)


def test_one_kind_in_the_same_kind_out() -> None:
    assert isinstance(state_after([0.0, 10.0, -2.0], 3.0, 0), float)
    assert isinstance(state_after([Fraction(0), Fraction(10), Fraction(-2)], Fraction(3), 1), Fraction)
    assert bernstein_coefficients([0.0, 10.0, -2.0], 3.0) == [0.0, 15.0, 21.0]
