"""Formulas as SMT-LIB text."""

from __future__ import annotations

from fractions import Fraction

from scenewright.solve.proofs.events import Unknown
from scenewright.solve.proofs.polynomials import FALSE, Named, compare, every, some, unknown
from scenewright.solve.proofs.smtlib import smtlib

X, Y = unknown(0), unknown(1)
UNKNOWNS = [Unknown("x", Fraction(-1, 3), Fraction(10), "other"), Unknown("y", Fraction(0), Fraction(1), "other")]


def test_numbers_are_exact_and_products_are_written_out() -> None:
    *declared, asserted = smtlib(UNKNOWNS, [Named(compare("<", 2 * X * Y, Fraction(1, 3)), "a")]).splitlines()
    assert declared == [
        "(declare-const u0 Real)",
        "(assert (<= (- (/ 1.0 3.0)) u0 10.0))",
        "(declare-const u1 Real)",
        "(assert (<= 0.0 u1 1.0))",
    ]
    assert asserted == "(assert (< (+ (* 2.0 u0 u1) (- (/ 1.0 3.0))) 0.0))"


def test_trees_and_names() -> None:
    tree = every([some([compare("==", X, Y), compare("<=", X, 0)]), compare("<=", Y, 1)])
    text = smtlib(UNKNOWNS, [Named(tree, "a"), Named(FALSE, "b")], named=True)
    assert text.startswith("(set-option :produce-unsat-cores true)")
    assert "(! (and (or (= (+ u0 (* (- 1.0) u1)) 0.0) (<= u0 0.0)) (<= (+ u1 (- 1.0)) 0.0)) :named n0)" in text
    assert "(! false :named n1)" in text
