"""Makes terms out of terms, in the one form that the text has for them: printing and parsing then agree.

What enters: terms. What leaves: a term. Constants fold only where the text form would fold them too.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Literal

from scenewright.errors import Span
from scenewright.program.expressions import Arithmetic, Negate, Number, Term

JUST_BEFORE_M = Fraction(5)  # the paper's convention: "just before L" is L - 5.0 m


def negate(operand: Term, span: Span | None = None) -> Term:
    """Return the negative of a term; numbers are negated in place."""
    if isinstance(operand, Number):
        return Number(-operand.value, span)
    return Negate(operand, span)


def combine(operator: Literal["+", "-", "*", "/"], left: Term, right: Term, span: Span | None = None) -> Term:
    """Return ``left operator right``; a quotient of two numbers is a number, so that ``1/3`` stays exact."""
    if operator == "/" and isinstance(left, Number) and isinstance(right, Number) and right.value:
        return Number(left.value / right.value, span)
    return Arithmetic(operator, left, right, span)


def just_before(place: Term, span: Span | None = None) -> Term:
    """Return the position just before `place`."""
    return Arithmetic("-", place, Number(JUST_BEFORE_M, span), span)
