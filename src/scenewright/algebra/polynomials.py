"""Polynomials of unknowns with exact coefficients, and formulas over them: what solvers and the planner are given.

What enters: rationals and unknowns, by number. What leaves: polynomials of second degree at most, and trees of
conjunctions and disjunctions with comparisons to zero as leaves; their text, for solvers that read SMT-LIB. Negation is
pushed to the leaves as it is made.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

Point = Mapping[int, float] | Sequence[float] | NDArray[np.float64]
Monomial = tuple[int, ...]  # the unknowns that are multiplied, in ascending order; () is the constant
Item = TypeVar("Item")
ZERO, ONE = Fraction(0), Fraction(1)


class TooHigh(Exception):  # noqa: N818 - a signal of the algebra, turned into a refusal by name where it is used
    """A product is of a higher degree than solvers take."""


@dataclass(frozen=True, slots=True)
class Unknown:
    """A real number to be found; its kind is ``time``, ``place``, ``speed``, ``rate`` or ``other``."""

    name: str
    low: Fraction
    high: Fraction
    kind: str


@dataclass(slots=True)
class Polynomial:
    """A sum of monomials with exact coefficients. Supports ``+ - *``; never changed once it is made."""

    terms: Mapping[Monomial, Fraction]

    def __add__(self, other: Scalar) -> Polynomial:
        total = dict(self.terms)
        for key, value in polynomial(other).terms.items():
            total[key] = total.get(key, ZERO) + value
        return Polynomial({key: value for key, value in total.items() if value})

    __radd__ = __add__

    def __neg__(self) -> Polynomial:
        return Polynomial({key: -value for key, value in self.terms.items()})

    def __sub__(self, other: Scalar) -> Polynomial:
        return self + (-polynomial(other))

    def __rsub__(self, other: Scalar) -> Polynomial:
        return polynomial(other) + (-self)

    def __mul__(self, other: Scalar) -> Polynomial:
        if not isinstance(other, Polynomial):
            return Polynomial({key: value * other for key, value in self.terms.items()}) if other else Polynomial({})
        product: dict[Monomial, Fraction] = {}
        for left, a in self.terms.items():
            for right, b in other.terms.items():
                if len(left) + len(right) > 2:
                    raise TooHigh("it multiplies more than two unknowns")
                key = tuple(sorted(left + right))
                product[key] = product.get(key, ZERO) + a * b
        return Polynomial({key: value for key, value in product.items() if value})

    __rmul__ = __mul__

    @property
    def constant(self) -> Fraction | None:
        """The value where no unknown is in it, else None."""
        if not self.terms:
            return ZERO
        return self.terms[()] if len(self.terms) == 1 and () in self.terms else None

    @property
    def degree(self) -> int:
        """The most unknowns that are multiplied."""
        return max((len(key) for key in self.terms), default=0)

    @property
    def number(self) -> int:
        """Which unknown it is, where it is one."""
        return next(iter(self.terms))[0]

    def value(self, point: Point) -> float:
        """Return the value at a point."""
        total = 0.0
        for key, coefficient in self.terms.items():
            term = float(coefficient)
            for number in key:
                term *= float(point[number])
            total += term
        return total


Scalar = Polynomial | Fraction | int


def polynomial(value: Scalar) -> Polynomial:
    """Return `value` as a polynomial."""
    if isinstance(value, Polynomial):
        return value
    return Polynomial({(): Fraction(value)}) if value else Polynomial({})


def unknown(number: int) -> Polynomial:
    """Return the polynomial that is one unknown."""
    return Polynomial({(number,): ONE})


# -- formulas -------------------------------------------------------------------------------------------------------
Relation = Literal["<=", "<", "=="]


@dataclass(frozen=True, slots=True)
class Atom:
    """``left relation 0``."""

    left: Polynomial
    relation: Relation


@dataclass(frozen=True, slots=True)
class All:
    """A conjunction."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True, slots=True)
class Some:
    """A disjunction."""

    parts: tuple[Formula, ...]


Formula = Atom | All | Some
TRUE, FALSE = All(()), Some(())


@dataclass(frozen=True, slots=True)
class Named:
    """A formula, and what it rests on: a constraint's id, or a law in words.

    `besides` are ids of constraints that it rests on, too: those that make a law narrower. `refused` says why a
    constraint could not be lowered, where it could not; there is nothing in its formula then.
    """

    formula: Formula
    origin: str
    besides: tuple[str, ...] = ()
    refused: str = ""

    @property
    def origins(self) -> tuple[str, ...]:
        """All that it rests on."""
        return (self.origin, *self.besides)


def resting_on(formulas: Sequence[Named], origins: Collection[str]) -> list[Named]:
    """Return the formulas that rest on `origins` alone."""
    return [each for each in formulas if all(origin in origins for origin in each.origins)]


def origins_of(formulas: Iterable[Named]) -> list[str]:
    """Return all that formulas rest on, each once."""
    return list(dict.fromkeys(origin for each in formulas for origin in each.origins))


def needed(items: Sequence[Item], clash: Callable[[list[Item]], bool]) -> list[Item]:
    """Return what of `items`, which clash together, is needed for that: all but what is found superfluous."""
    kept = list(items)
    for item in items:
        fewer = [other for other in kept if other is not item]
        if clash(fewer):
            kept = fewer
    return kept


def atom(left: Scalar, relation: Relation) -> Formula:
    """Return a comparison with zero; a truth value where no unknown is in it."""
    left = polynomial(left)
    value = left.constant
    if value is None:
        return Atom(left, relation)
    held = value == 0 if relation == "==" else value < 0 if relation == "<" else value <= 0
    return TRUE if held else FALSE


def compare(operator: str, left: Scalar, right: Scalar) -> Formula:
    """Return ``left operator right``, with any of ``== <= < >= >``."""
    match operator:
        case "==" | "<=" | "<":
            return atom(polynomial(left) - right, operator)
        case ">=":
            return atom(polynomial(right) - left, "<=")
        case _:
            return atom(polynomial(right) - left, "<")


def every(parts: Iterable[Formula]) -> Formula:
    """Return the conjunction of `parts`, flat."""
    return _joined(All, parts, FALSE)


def some(parts: Iterable[Formula]) -> Formula:
    """Return the disjunction of `parts`, flat."""
    return _joined(Some, parts, TRUE)


def _joined(kind: type[All | Some], parts: Iterable[Formula], deciding: Formula) -> Formula:
    found: list[Formula] = []
    for part in parts:
        if isinstance(part, kind):
            found += part.parts
        elif part == deciding:
            return deciding
        else:
            found.append(part)
    return found[0] if len(found) == 1 else kind(tuple(found))


def atoms(formula: Formula) -> Iterator[Atom]:
    """Yield every comparison in `formula`."""
    if isinstance(formula, Atom):
        yield formula
    else:
        for part in formula.parts:
            yield from atoms(part)


def conjuncts(formulas: Iterable[Formula]) -> Iterator[Atom | Some]:
    """Yield what holds in every case: comparisons, and choices."""
    for part in formulas:
        if isinstance(part, All):
            yield from conjuncts(part.parts)
        else:
            yield part


# -- text --------------------------------------------------------------------------------------------------------------
def smtlib(unknowns: Sequence[Unknown], formulas: Sequence[Named]) -> str:
    """Return the problem as text: unknown i is ``u<i>``."""
    lines: list[str] = []
    for number, each in enumerate(unknowns):
        lines.append(f"(declare-const u{number} Real)")
        lines.append(f"(assert (<= {_number(each.low)} u{number} {_number(each.high)}))")
    return "\n".join([*lines, *(f"(assert {_formula(each.formula)})" for each in formulas)])


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
