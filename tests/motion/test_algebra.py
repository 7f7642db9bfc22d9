"""Numbers and symbols obey the same rules; rounding is bounded and happens in one place."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import smtlib
from scenewright.motion.algebra import (
    Symbol,
    compare,
    conjunction,
    disjunction,
    negation,
    pin,
    select,
    smt,
)

ratios = st.fractions(-50, 50, max_denominator=60)
OPERATORS = {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b}


@given(ratios, ratios, st.sampled_from("+-*"), st.sampled_from(["ss", "sn", "ns"]))
def test_symbols_compute_what_numbers_do(a: Fraction, b: Fraction, sign: str, kinds: str) -> None:
    operate = OPERATORS[sign]
    left = Symbol("p") if kinds[0] == "s" else a
    right = Symbol("q") if kinds[1] == "s" else b
    result = operate(left, right)
    assert smtlib.value(smt(result), {"p": a, "q": b}) == operate(a, b)


@given(ratios)
def test_negation_of_a_symbol(a: Fraction) -> None:
    assert smtlib.value(smt(-Symbol("p")), {"p": a}) == -a


@given(ratios, ratios, st.sampled_from(["==", "<=", ">=", "<", ">"]))
def test_comparisons_say_the_same_of_symbols_and_numbers(a: Fraction, b: Fraction, operator: str) -> None:
    known = compare(operator, a, b)
    text = compare(operator, Symbol("p"), b)
    assert isinstance(known, bool)
    assert isinstance(text, str)
    assert smtlib.value(text, {"p": a}) is known
    chosen = select(compare(operator, Symbol("p"), b), Symbol("p"), b)
    assert smtlib.value(smt(chosen), {"p": a}) == (a if known else b)


@given(st.fractions(-(10**6), 10**6))
def test_numbers_are_written_exactly(a: Fraction) -> None:
    assert smtlib.value(smt(a), {}) == a


@given(st.floats(-1e6, 1e6))
def test_pinning_is_off_by_half_a_tenth_of_a_millimetre_at_most(measured: float) -> None:
    pinned = pin(measured)
    assert abs(pinned - Fraction(measured)) <= Fraction(1, 20000) + Fraction(1, 10**9)
    assert pinned.denominator <= 10**4
    assert pin(pinned) == pinned


def test_known_conditions_fold() -> None:
    p = compare(">", Symbol("p"), Fraction(0))
    assert conjunction([]) is True
    assert disjunction([]) is False
    assert conjunction([True, p, True]) == p
    assert conjunction([p, False]) is False
    assert disjunction([p, True]) is True
    assert disjunction([False, p]) == p
    assert negation(True) is False
    assert negation(p) == "(not (> p 0.0))"
    assert select(True, Fraction(1), Symbol("p")) == 1


@pytest.mark.parametrize("zero", [0, Fraction(0)])
def test_nothing_is_written_for_nothing(zero: Fraction | int) -> None:
    p = Symbol("p")
    assert p + zero is p
    assert zero + p is p
    assert p - zero is p
    assert p * 1 is p
    assert p * zero == 0
    assert not isinstance(p * zero, Symbol)
