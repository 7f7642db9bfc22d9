"""Tolerances, physical dimensions of terms, and by how much something misses what was asked.

What enters: terms of a program; errors in SI units. What leaves: a `Miss`, a small tree that keeps errors in their
own units, so that any tolerance can be applied to it afterwards. It evaluates no term.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from scenewright.program.expressions import (
    Arithmetic,
    Compare,
    Derived,
    Elapsed,
    Landmark,
    Negate,
    Number,
    ParameterRef,
    State,
    Term,
)
from scenewright.units import SI_SYMBOL, Dimension, unit_of_name

FloatArray = NDArray[np.float64]
Values = float | FloatArray
Exponents = tuple[int, int]  # of metres and of seconds

_EXPONENTS: dict[Dimension, Exponents] = {"length": (1, 0), "time": (0, 1), "speed": (1, -1), "acceleration": (1, -2)}
_NAMES: dict[Exponents, Dimension] = {exponents: name for name, exponents in _EXPONENTS.items()}
_STATE: tuple[Dimension, Dimension, Dimension] = ("length", "speed", "acceleration")
EXACT = 1e-6  # what has no tolerance must hold but for rounding


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How far a measured quantity may lie from the required one, by dimension."""

    length_m: float
    time_s: float
    speed_mps: float
    accel_mpss: float

    def of(self, dimension: Dimension | None) -> float:
        """Return the tolerance for a dimension in its SI unit; for None the rounding error that anything may have."""
        match dimension:
            case "length":
                return self.length_m
            case "time":
                return self.time_s
            case "speed":
                return self.speed_mps
            case "acceleration":
                return self.accel_mpss
            case None:
                return EXACT


TIGHT = Tolerance(0.5, 0.1, 0.25, 0.25)
LOOSE = Tolerance(2.0, 0.5, 1.0, 1.0)
# From finest to coarsest, to draw success over tolerance; verdicts name the middle two.
LEVELS = {
    "fine": Tolerance(0.1, 0.02, 0.05, 0.05),
    "tight": TIGHT,
    "loose": LOOSE,
    "coarse": Tolerance(5.0, 1.0, 2.5, 2.5),
}


@dataclass(frozen=True, slots=True)
class Leaf:
    """One error, never negative: 0 where the comparison holds. Dimension None: there is no tolerance for it."""

    error: Values
    dimension: Dimension | None


@dataclass(frozen=True, slots=True)
class Every:
    """All parts must hold."""

    parts: tuple[Miss, ...]


@dataclass(frozen=True, slots=True)
class Some:
    """One part must hold."""

    parts: tuple[Miss, ...]


@dataclass(frozen=True, slots=True)
class Throughout:
    """The part must hold at each of its instants (the axis of its errors)."""

    part: Miss


@dataclass(frozen=True, slots=True)
class Sometime:
    """The part must hold at one of its instants."""

    part: Miss


Miss = Leaf | Every | Some | Throughout | Sometime


def normalised(miss: Miss, tolerance: Tolerance) -> Values:
    """Return the error in units of the tolerance: what is at most 1 holds."""
    match miss:
        case Leaf(error=error, dimension=dimension):
            return error / tolerance.of(dimension)
        case Every(parts=parts):
            return reduce(np.maximum, (np.asarray(normalised(part, tolerance)) for part in parts))
        case Some(parts=parts):
            return reduce(np.minimum, (np.asarray(normalised(part, tolerance)) for part in parts))
        case Throughout(part=part):
            return float(np.max(normalised(part, tolerance)))
        case Sometime(part=part):
            return float(np.min(normalised(part, tolerance)))


def only_dimension(miss: Miss) -> Dimension | None:
    """Return the dimension of all errors of a miss; None where they have several, or one has none."""
    match miss:
        case Leaf(dimension=dimension):
            return dimension
        case Every(parts=parts) | Some(parts=parts):
            found = {only_dimension(part) for part in parts}
            return found.pop() if len(found) == 1 else None
        case Throughout(part=part) | Sometime(part=part):
            return only_dimension(part)


def dimension_of(node: Compare) -> Dimension | None:
    """Return the dimension of what is compared; None for plain numbers and for products that have no name here."""
    exponents = _exponents(node.left) or _exponents(node.right)
    return None if exponents is None else _NAMES.get(exponents)


def dimension_of_dividend(node: Compare) -> Dimension | None:
    """Return the dimension of what is divided in a quotient that is one side of a comparison."""
    for side in (node.left, node.right):
        if isinstance(side, Arithmetic) and side.operator == "/":
            return _NAMES.get(_exponents(side.left) or (0, 0))
    return None


def unit_symbol(dimension: Dimension | None) -> str:
    """Return the SI symbol, or nothing for what has no dimension."""
    return "" if dimension is None else SI_SYMBOL[dimension]


def _exponents(term: Term) -> Exponents | None:
    match term:
        case Number():
            return None  # a bare number takes the dimension of what it stands beside
        case ParameterRef(name=name):
            unit = unit_of_name(name)
            return None if unit is None else _EXPONENTS[unit.dimension]
        case Landmark():
            return _EXPONENTS["length"]
        case Elapsed():
            return _EXPONENTS["time"]
        case State(order=order):
            return _EXPONENTS[_STATE[order]]
        case Derived(kind=kind):
            return _EXPONENTS["length" if kind in ("gap", "freespace") else "time"]
        case Negate(operand=operand):
            return _exponents(operand)
        case Arithmetic(operator=("+" | "-"), left=left, right=right):
            return _exponents(left) or _exponents(right)
        case Arithmetic(operator=operator, left=left, right=right):
            (m, s), (n, t) = _exponents(left) or (0, 0), _exponents(right) or (0, 0)
            return (m + n, s + t) if operator == "*" else (m - n, s - t)
