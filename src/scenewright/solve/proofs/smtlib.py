"""Formulas as SMT-LIB text, for every solver that reads it.

What enters: unknowns and named formulas. What leaves: declarations and assertions; it asks nothing and parses nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from scenewright.solve.proofs.events import Unknown
from scenewright.solve.proofs.polynomials import All, Atom, Formula, Named, Polynomial, Some


def smtlib(unknowns: Sequence[Unknown], formulas: Sequence[Named], named: bool = False) -> str:
    """Return the problem as text: unknown i is ``u<i>``, and with `named` formula i is ``n<i>``, for cores."""
    lines = ["(set-option :produce-unsat-cores true)"] if named else []
    for number, each in enumerate(unknowns):
        lines.append(f"(declare-const u{number} Real)")
        lines.append(f"(assert (<= {_number(each.low)} u{number} {_number(each.high)}))")
    for number, formula in enumerate(formulas):
        text = _formula(formula.formula)
        lines.append(f"(assert (! {text} :named n{number}))" if named else f"(assert {text})")
    return "\n".join(lines)


def _formula(formula: Formula) -> str:
    match formula:
        case Atom(left=left, relation=relation):
            return f"({'=' if relation == '==' else relation} {_polynomial(left)} 0.0)"
        case All(parts=parts):
            return f"(and {' '.join(map(_formula, parts))})" if parts else "true"
        case Some(parts=parts):
            return f"(or {' '.join(map(_formula, parts))})" if parts else "false"


def _polynomial(polynomial: Polynomial) -> str:
    parts = []
    for key, coefficient in polynomial.terms.items():
        factors = [f"u{unknown}" for unknown in key]
        if coefficient != 1 or not factors:
            factors.insert(0, _number(coefficient))
        parts.append(f"(* {' '.join(factors)})" if len(factors) > 1 else factors[0])
    return f"(+ {' '.join(parts)})" if len(parts) > 1 else parts[0]


def _number(value: Fraction) -> str:
    size = abs(value)
    text = f"{size.numerator}.0" if size.denominator == 1 else f"(/ {size.numerator}.0 {size.denominator}.0)"
    return f"(- {text})" if value < 0 else text
