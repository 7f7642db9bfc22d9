"""Numbers that stay numbers: no division by zero, and nothing so large that arithmetic with it would overflow.

What enters: the terms of a constraint, and values of parameters where they are known. What leaves: nothing, or the
first term that is at fault, with what is wrong. It knows no units (see `check`) and no motion.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.units import is_size_of_a_scenario, size_of_a_scenario

# Between these lies what a state, a place or a time of a scenario may be, where it is not zero; a product of a few of
# them stays below the limit, one of dozens does not.
_STATE = Fraction(10**4)
_LARGEST_TERM = Fraction(10**30)
# What stands below a line may come near to zero in a scenario; that is the solver's and the judge's to see.
_SMALLEST_DIVISOR = Fraction(1, 10**3)

LONGEST_S = Fraction(120)  # that a run lasts

Values = Mapping[str, Fraction]


@dataclass(frozen=True, slots=True)
class Magnitude:
    """How large a term may get, and its exact value where it has one whatever happens."""

    most: Fraction
    constant: Fraction | None = None


class NoNumberError(Exception):
    """A term has no value, or one that no scenario has."""

    def __init__(self, term: ex.Term, message: str, found: str, expected: str) -> None:
        super().__init__(message)
        self.term, self.message, self.found, self.expected = term, message, found, expected


def check_numbers(formula: ex.Formula, values: Values) -> None:
    """Raise `NoNumberError` at the first term of `formula` that is no number; `values` (SI) are those of parameters."""
    for node in ex.walk(formula):
        match node:
            case ex.Compare(left=left, right=right):
                for side in (left, right):
                    magnitude(side, values)
            case ex.Temporal(start=start, end=end):
                for bound in (start, end):
                    _check_time(bound, values)
            case ex.State(at=ex.Number() as at) | ex.Derived(at=ex.Number() as at):
                _check_time(at, values)
            case _:
                pass


def _check_time(term: ex.Term, values: Values) -> None:
    time_s = magnitude(term, values).constant
    if time_s is not None and time_s > LONGEST_S:
        expected = f"a time up to {LONGEST_S} s, or a knot of one who is there then"
        raise NoNumberError(term, f"no run lasts for {float(time_s):g} s", f"{float(time_s):g} s", expected)


def magnitude(term: ex.Term, values: Values) -> Magnitude:
    """Return how large `term` may get; raises `NoNumberError` where it is none."""
    match term:
        case ex.Number(value=value):
            return _exactly(term, value)
        case ex.ParameterRef(name=name) if name in values:
            return _exactly(term, values[name])
        case ex.Negate(operand=operand):
            inner = magnitude(operand, values)
            return Magnitude(inner.most, None if inner.constant is None else -inner.constant)
        case ex.Arithmetic(operator=operator, left=left, right=right):
            return _combined(term, operator, magnitude(left, values), magnitude(right, values))
        case _:
            return Magnitude(_STATE)


def _exactly(term: ex.Term, value: Fraction) -> Magnitude:
    if not is_size_of_a_scenario(value):
        raise NoNumberError(term, "no scenario has a number of this size", _shown(value), size_of_a_scenario())
    return Magnitude(abs(value), value)


def _combined(term: ex.Arithmetic, operator: str, left: Magnitude, right: Magnitude) -> Magnitude:
    a, b = left.constant, right.constant
    constant: Fraction | None = None
    if operator == "/":
        if b == 0:
            raise NoNumberError(term.right, "something is divided by zero", "0", "a divisor that is not zero")
        most = left.most / (_SMALLEST_DIVISOR if b is None else abs(b))
        constant = a / b if a is not None and b is not None else None
    elif operator == "*":
        most = left.most * right.most
        constant = Fraction(0) if 0 in (a, b) else a * b if a is not None and b is not None else None
    else:
        most = left.most + right.most
        if a is not None and b is not None:
            constant = a + b if operator == "+" else a - b
        elif operator == "-" and term.left == term.right:
            constant = Fraction(0)
    if most > _LARGEST_TERM:
        raise NoNumberError(
            term, "this gets larger than any quantity of a scenario", f"up to {_shown(most)}", "smaller factors"
        )
    return Magnitude(most if constant is None else abs(constant), constant)


def _shown(value: Fraction) -> str:
    """Return a number in short, however long it is: `float` would overflow."""
    powers = round((value.numerator.bit_length() - value.denominator.bit_length()) * math.log10(2))
    return f"{float(value):.9g}" if abs(powers) < 300 else f"about 1e{powers}"
