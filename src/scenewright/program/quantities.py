"""What a scenario written in Python is made of: states, times, landmarks, operators on them, and conditions.

What enters: operators and Python numbers. What leaves: terms and formulas of the program. It decides nothing and checks
little (`builder.Scenario.require` does); a condition is a thing to be met, not a truth value.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from numbers import Real
from typing import Literal, NoReturn

from scenewright.errors import ProgramError
from scenewright.program import arithmetic
from scenewright.program.expressions import (
    At,
    Compare,
    ComparisonOperator,
    Derived,
    DerivedKind,
    Elapsed,
    Formula,
    Knot,
    Landmark,
    Logic,
    Number,
    Order,
    PieceRef,
    State,
    Temporal,
    Term,
)
from scenewright.program.printer import print_expression
from scenewright.program.types import (
    Actor,
    PieceKind,
)
from scenewright.units import UNITS, decimal_fraction


@dataclass(frozen=True, slots=True, eq=False)
class Condition:
    """Something that must hold. Combine with ``&``, ``|``, ``~`` and `implies`."""

    formula: Formula

    def __and__(self, other: Condition) -> Condition:
        return _joined("and", self, other)

    def __or__(self, other: Condition) -> Condition:
        return _joined("or", self, other)

    def __invert__(self) -> Condition:
        return Condition(Logic("not", (self.formula,)))

    def implies(self, other: Condition) -> Condition:
        """Return the condition that `other` holds wherever this one does."""
        return Condition(Logic("implies", (self.formula, formula_of(other))))

    def __bool__(self) -> NoReturn:
        raise TypeError(
            f"'{self}' is something to be met, not a truth value. Python cannot build conditions from 'and', 'or', "
            "'not' or a chained comparison (a < b < c): write (a < b) & (b < c), and |, ~, .implies()"
        )

    def __str__(self) -> str:
        return print_expression(self.formula)


@dataclass(frozen=True, slots=True, eq=False)
class Quantity:
    """A number that the scenario decides: a state, a time, a landmark, a parameter, or arithmetic on those (SI units).

    Python numbers on the other side of an operator are taken as the decimals that they print as: 0.1 is exactly 1/10.
    """

    term: Term

    def __add__(self, other: Operand) -> Quantity:
        return _arithmetic("+", self, other)

    def __radd__(self, other: Operand) -> Quantity:
        return _arithmetic("+", other, self)

    def __sub__(self, other: Operand) -> Quantity:
        return _arithmetic("-", self, other)

    def __rsub__(self, other: Operand) -> Quantity:
        return _arithmetic("-", other, self)

    def __mul__(self, other: Operand) -> Quantity:
        return _arithmetic("*", self, other)

    def __rmul__(self, other: Operand) -> Quantity:
        return _arithmetic("*", other, self)

    def __truediv__(self, other: Operand) -> Quantity:
        return _arithmetic("/", self, other)

    def __rtruediv__(self, other: Operand) -> Quantity:
        return _arithmetic("/", other, self)

    def __neg__(self) -> Quantity:
        return Computed(arithmetic.negate(self.term))

    def __pos__(self) -> Quantity:
        return self

    def __eq__(self, other: Operand) -> Condition:  # type: ignore[override]
        return _comparison("==", self, other)

    def __ne__(self, other: Operand) -> NoReturn:  # type: ignore[override]
        raise TypeError(
            f"'{self} != ...' is nearly always true of a measured quantity: write (a < b) | (a > b) if it is meant"
        )

    def __lt__(self, other: Operand) -> Condition:
        return _comparison("<", self, other)

    def __le__(self, other: Operand) -> Condition:
        return _comparison("<=", self, other)

    def __gt__(self, other: Operand) -> Condition:
        return _comparison(">", self, other)

    def __ge__(self, other: Operand) -> Condition:
        return _comparison(">=", self, other)

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> NoReturn:
        raise TypeError(f"'{self}' has no value while the scenario is being written, so it is neither true nor false")

    def __str__(self) -> str:
        return print_expression(self.term)


@dataclass(frozen=True, slots=True, eq=False)
class Computed(Quantity):
    """Any quantity but a bare landmark.

    A sibling of `Place`: Python asks the right side first where its class is below that of the left, and
    ``ego.x("t1") == stop_line`` would be written the wrong way round.
    """


@dataclass(frozen=True, slots=True, eq=False)
class Place(Quantity):
    """A landmark: a named arc length (m) on a route. It belongs to the actor whose position it is compared with."""

    def of(self, actor: Vehicle, other: Vehicle | None = None) -> Place:
        """Return this landmark on the route of `actor`; `other` tells whom a conflict point is shared with."""
        assert isinstance(self.term, Landmark)
        return Place(Landmark(self.term.name, _id_of(actor), None if other is None else _id_of(other)))


Operand = Quantity | float | Fraction | Decimal
Moment = Operand | str | None

stop_line = Place(Landmark("stop_line"))
conflict_point = Place(Landmark("conflict_point"))
intersection = Place(Landmark("intersection"))
turn = Place(Landmark("turn"))
turn_start = Place(Landmark("turn_start"))
turn_end = Place(Landmark("turn_end"))
junction_start = Place(Landmark("junction_start"))
junction_end = Place(Landmark("junction_end"))
route_end = Place(Landmark("route_end"))


def just_before(place: Quantity) -> Quantity:
    """Return the position just before `place`, which the paper takes to be 5 m."""
    return Computed(arithmetic.just_before(place.term))


def si(value: float | int | Fraction, unit: str) -> Fraction:
    """Return `value` of `unit` in SI units, exactly.

    >>> si(36, "km/h")
    Fraction(10, 1)
    """
    if unit not in UNITS:
        raise ProgramError(f"there is no unit {unit}", found=unit, expected=", ".join(UNITS))
    return exact(value) * UNITS[unit].si_factor


@dataclass(frozen=True, slots=True, eq=False)
class Vehicle:
    """An actor, to ask for its states.

    A moment is a knot or piece of its own sketch, a time in s, or the `time` of another actor's knot.
    """

    actor: Actor

    @property
    def id(self) -> int:
        """The number of the actor; 0 is the ego."""
        return self.actor.id

    def x(self, at: Moment = None) -> Quantity:
        """Return the position along the route (m)."""
        return self._state(0, at)

    def v(self, at: Moment = None) -> Quantity:
        """Return the speed (m/s)."""
        return self._state(1, at)

    def a(self, at: Moment = None) -> Quantity:
        """Return the acceleration (m/s^2), at a moment or of a whole piece such as ``dec``."""
        return self._state(2, at)

    def time(self, knot: str) -> Quantity:
        """Return the time from the start of the scenario to a knot (s)."""
        self._known_moment(Knot(knot))
        return Computed(Elapsed(self.id, knot))

    def tta(self, place: Place, at: Moment = None) -> Quantity:
        """Return the time to arrival at `place`: distance over speed (s)."""
        if not isinstance(place, Place):
            raise TypeError(f"tta is measured to a landmark such as stop_line, not to {place!r}")
        assert isinstance(place.term, Landmark)
        return self._derived("tta", place.term, at)

    def gap_to(self, other: Vehicle, at: Moment = None) -> Quantity:
        """Return how far `other` is ahead (m), between reference points, along the lane that both share."""
        return self._derived("gap", _id_of(other), at)

    def freespace(self, other: Vehicle, at: Moment = None) -> Quantity:
        """Return what lies between the bodies (m), with `other` ahead, along the lane that both share."""
        return self._derived("freespace", _id_of(other), at)

    def ttc(self, other: Vehicle, at: Moment = None) -> Quantity:
        """Return the time to collision with `other` ahead: what lies between the bodies, over the closing speed (s)."""
        return self._derived("ttc", _id_of(other), at)

    def headway(self, other: Vehicle, at: Moment = None) -> Quantity:
        """Return the headway to `other` ahead: what lies between the bodies, over own speed (s)."""
        return self._derived("headway", _id_of(other), at)

    def _state(self, order: Order, at: Moment) -> Quantity:
        return Computed(State(self.id, order, self._moment(at)))

    def _derived(self, kind: DerivedKind, target: int | Landmark, at: Moment) -> Quantity:
        moment = self._moment(at)
        if isinstance(moment, PieceRef):
            raise ProgramError(f"{kind} has a moment, not a piece", found=moment.name, expected="a knot or a time in s")
        return Computed(Derived(kind, self.id, target, moment))

    def _moment(self, at: Moment) -> At:
        if at is None:
            return None
        if isinstance(at, str):
            named = PieceRef(at) if at.rstrip("0123456789") in set(PieceKind) else Knot(at)
            self._known_moment(named)
            return named
        if isinstance(at, Quantity):
            if not isinstance(at.term, Elapsed):
                raise ProgramError(
                    "this is not a moment", found=str(at), expected="a knot, a time in s, other.time('t1')"
                )
            return at.term
        value = exact(at)
        if value < 0:
            raise ProgramError("a moment lies before the start", found=f"{float(value):g} s", expected="0 s or later")
        return Number(value)

    def _known_moment(self, at: Knot | PieceRef) -> None:
        sketch, name = self.actor.sketch, at.name
        there_are: Sequence[str] = sketch.knots if isinstance(at, Knot) else sketch.piece_names()
        if name not in there_are and f"{name}1" not in there_are:
            kind = "knot" if isinstance(at, Knot) else "piece"
            raise ProgramError(
                f"{self.actor.name} has no {kind} {name}", found=name, expected=", ".join(there_are) or "none at all"
            )


def _id_of(vehicle: object) -> int:
    if not isinstance(vehicle, Vehicle):
        raise TypeError(f"{vehicle!r} is not a vehicle, as scene.ego(...) and scene.actor(...) return them")
    return vehicle.id


def always(start: Operand, end: Operand, body: Condition) -> Condition:
    """Return the condition that `body`, whose states have no moment, holds at every instant of ``start..end`` (s)."""
    return _temporal("always", start, end, body)


def never(start: Operand, end: Operand, body: Condition) -> Condition:
    """Return the condition that `body` holds at no instant from `start` to `end` (s)."""
    return _temporal("never", start, end, body)


def eventually(start: Operand, end: Operand, body: Condition) -> Condition:
    """Return the condition that `body` holds at some instant from `start` to `end` (s)."""
    return _temporal("eventually", start, end, body)


def exact(value: object) -> Fraction:
    """Return the rational that a Python number prints as; raises ProgramError for anything else."""
    if isinstance(value, bool) or not isinstance(value, Real | Decimal) or not _is_finite(value):
        raise ProgramError("this is not a number", found=repr(value), expected="a finite number")
    try:
        return value if isinstance(value, Fraction) else decimal_fraction(str(value))
    except ValueError as error:
        raise ProgramError("no scenario has a number of this size", expected=str(error), fix="round it") from None


def _is_finite(value: Real | Decimal) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number or a fraction beyond every float: large, but finite
        return True


def _term(value: object) -> Term:
    if isinstance(value, Quantity):
        return value.term
    if isinstance(value, Condition):
        raise TypeError(f"'{value}' is a condition, not a quantity: join conditions with &, | and ~")
    return Number(exact(value))


def formula_of(value: object) -> Formula:
    """Return the formula of a condition; raises TypeError for anything else."""
    if not isinstance(value, Condition):
        raise TypeError(f"{value!r} is not a condition such as ego.v('t1') <= 10")
    return value.formula


def _arithmetic(operator: Literal["+", "-", "*", "/"], left: object, right: object) -> Quantity:
    return Computed(arithmetic.combine(operator, _term(left), _term(right)))


def _comparison(operator: ComparisonOperator, left: Quantity, right: object) -> Condition:
    return Condition(Compare(operator, left.term, _term(right)))


def _joined(operator: Literal["and", "or"], left: Condition, right: object) -> Condition:
    operands: list[Formula] = []
    for formula in (left.formula, formula_of(right)):
        flat = isinstance(formula, Logic) and formula.operator == operator
        operands += formula.operands if flat and isinstance(formula, Logic) else (formula,)
    return Condition(Logic(operator, tuple(operands)))


def _temporal(
    operator: Literal["always", "never", "eventually"], start: object, end: object, body: Condition
) -> Condition:
    return Condition(Temporal(operator, _term(start), _term(end), formula_of(body)))
