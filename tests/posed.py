"""Small problems for solvers: two by hand, any number at random, and how one is made a little easier or harder."""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

from scenewright.algebra.polynomials import (
    ZERO,
    All,
    Atom,
    Formula,
    Named,
    Polynomial,
    Some,
    Unknown,
    atom,
    compare,
    every,
    some,
    unknown,
)
from scenewright.solve.proofs.refuters import Answer, Refuter

X, Y = unknown(0), unknown(1)
UNKNOWNS = [Unknown("x", Fraction(0), Fraction(10), "other"), Unknown("y", Fraction(-5), Fraction(5), "other")]


def named(**formulas: Formula) -> list[Named]:
    return [Named(formula, name) for name, formula in formulas.items()]


def asked(refuter: Refuter, timeout_s: float) -> Answer:
    """Ask something easy."""
    return refuter.ask(UNKNOWNS, named(a=compare("==", X * X, 2)), timeout_s)


def at_random(seed: int) -> tuple[list[Unknown], list[Named]]:
    """Return a problem of second degree at random; about half of them cannot be met."""
    draw = random.Random(seed)
    unknowns = []
    for number in range(draw.randint(2, 4)):
        low = draw.randint(-6, 4)
        unknowns.append(Unknown(f"x{number}", Fraction(low), Fraction(low + draw.randint(1, 9)), "other"))
    formulas = [Named(_tree(draw, len(unknowns), 2), f"f{number}") for number in range(draw.randint(2, 4))]
    return unknowns, [each for each in formulas if each.formula != All(())]


def _tree(draw: random.Random, count: int, depth: int) -> Formula:
    if depth and draw.random() < 0.6:
        parts = [_tree(draw, count, depth - 1) for _ in range(draw.randint(2, 3))]
        return every(parts) if draw.random() < 0.5 else some(parts)
    left = Polynomial({})
    for _ in range(draw.randint(1, 3)):
        key = sorted(draw.randrange(count) for _ in range(draw.randint(1, 2)))
        left += Polynomial({tuple(key): Fraction(draw.choice([-3, -2, -1, 1, 2, 3]))})
    return compare(draw.choice(["==", "<=", "<", ">=", "<=", ">="]), left, Fraction(draw.randint(-40, 40), 4))


def eased(formulas: list[Named], by: Fraction) -> list[Named]:
    """Return the formulas with every comparison let off by as much; harder ones for a negative number."""
    return [Named(_eased(each.formula, by), each.origin) for each in formulas]


def _eased(formula: Formula, by: Fraction) -> Formula:
    match formula:
        case Atom(left=left, relation="=="):
            return every([atom(left - max(by, ZERO), "<="), atom(-left - max(by, ZERO), "<=")])
        case Atom(left=left, relation=relation):
            return atom(left - by, relation)
        case All(parts=parts):
            return every(_eased(part, by) for part in parts)
        case _:
            return some(_eased(part, by) for part in formula.parts)


def violation(formula: Formula, point: Sequence[float]) -> float:
    """Return by how much `formula` fails at a point, in the units of its comparisons; zero where it holds."""
    match formula:
        case Atom(left=left, relation="=="):
            return abs(left.value(point))
        case Atom(left=left):
            return max(0.0, left.value(point))
        case All(parts=parts):
            return max((violation(part, point) for part in parts), default=0.0)
        case Some(parts=parts):
            return min((violation(part, point) for part in parts), default=float("inf"))
