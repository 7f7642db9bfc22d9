"""Refutes, or finds values, with z3: exact, with cores.

What enters: named formulas over unknowns. What leaves: that nothing meets them all, with the names that already clash;
or values; or that neither was found. The text that z3 parses is written here and read nowhere else.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

import z3

from scenewright.solve.proofs.events import Unknown
from scenewright.solve.proofs.polynomials import All, Atom, Formula, Polynomial, Some
from scenewright.solve.proofs.relaxation import Named

z3.set_param("ctrl_c", False)  # its own handler would take Ctrl-C for an answer

_STEPS = ("simplify", "solve-eqs", "simplify", "propagate-ineqs", "qfnra-nlsat")


@dataclass(frozen=True, slots=True)
class Answer:
    """What z3 says: ``refuted``, ``met`` with values, or ``unknown``."""

    kind: Literal["refuted", "met", "unknown"]
    core: tuple[str, ...] = ()
    values: tuple[float, ...] = ()


def ask(unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
    """Ask whether all `formulas` can hold at once."""
    unknowns = tightened(unknowns, formulas)
    if any(each.low > each.high for each in unknowns):
        return Answer("refuted")
    context = z3.Context()
    solver = z3.Then(*_STEPS, ctx=context).solver()
    solver.set("timeout", max(1, int(timeout_s * 1000)))
    solver.from_string(_text(unknowns, formulas))
    answer = solver.check()
    if answer == z3.unsat:
        return Answer("refuted")
    if answer == z3.sat:
        return Answer("met", values=_values(solver.model(), len(unknowns)))
    return Answer("unknown")


def tightened(unknowns: Sequence[Unknown], formulas: Sequence[Named]) -> list[Unknown]:
    """Return the unknowns with the ranges that comparisons of one of them with a number leave."""
    found = list(unknowns)
    open_parts = [each.formula for each in formulas]
    while open_parts:
        part = open_parts.pop()
        if isinstance(part, All):
            open_parts += part.parts
        elif isinstance(part, Atom) and part.left.degree == 1 and len(part.left.terms) - (() in part.left.terms) == 1:
            ((key, factor),) = ((key, value) for key, value in part.left.terms.items() if key)
            bound, number = -part.left.terms.get((), Fraction(0)) / factor, key[0]
            low, high = found[number].low, found[number].high
            if part.relation == "==" or factor < 0:
                low = max(low, bound)
            if part.relation == "==" or factor > 0:
                high = min(high, bound)
            found[number] = replace(found[number], low=low, high=high)
    return found


def core(unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> tuple[str, ...]:
    """Return origins that already clash, each of them needed as far as that could be told in time."""
    origins = list(dict.fromkeys(each.origin for each in formulas))
    context = z3.Context()
    solver = z3.Solver(ctx=context)
    solver.set("timeout", max(1, int(timeout_s * 1000)))
    solver.from_string(_text(unknowns, formulas, named=True))
    if solver.check() == z3.unsat:
        used = {formulas[int(str(name)[1:])].origin for name in solver.unsat_core()}
        origins = [origin for origin in origins if origin in used]
    until = time.monotonic() + timeout_s
    for origin in list(origins):
        rest = [each for each in formulas if each.origin in origins and each.origin != origin]
        if time.monotonic() < until and ask(unknowns, rest, 0.5).kind == "refuted":
            origins.remove(origin)
    return tuple(origins)


def _values(model: z3.ModelRef, count: int) -> tuple[float, ...]:
    found = [0.0] * count
    for declaration in model.decls():
        if declaration.arity():  # z3 tells also how it divides by zero
            continue
        value = model[declaration]
        if z3.is_algebraic_value(value):
            value = value.approx(12)
        found[int(declaration.name()[1:])] = float(value.as_fraction())
    return tuple(found)


def _text(unknowns: Sequence[Unknown], formulas: Sequence[Named], named: bool = False) -> str:
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
