"""Polynomials of time over one piece of motion, for numbers and symbols alike.

What enters: the derivatives at the start of a piece (position, speed, acceleration, ...). What leaves: any derivative
at any moment of the piece (the paper's algorithms 3 and 4), and bounds that hold over the whole piece.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import comb, factorial
from typing import Any

# A number of any kind (float, Fraction) or a `Symbol`; one kind in, the same kind out. Python has no type for that.
Number = Any


def state_after(derivatives: Sequence[Number], elapsed: Number, order: int) -> Number:
    """Return the derivative of `order` after `elapsed` within a piece.

    Parameters
    ----------
    derivatives
        Position, speed, acceleration, ... at the start of the piece; those above are zero.
    elapsed
        Time since the start of the piece (s).
    order
        0 for position, 1 for speed, 2 for acceleration.

    Notes
    -----
    The paper's algorithm 4: the sum over k of ``rates[k] * t**(k - o) / (k - o)!``.

    Examples
    --------
    >>> state_after([0.0, 10.0, -2.0], 3.0, 0)
    21.0
    """
    total = derivatives[order]
    power = elapsed
    for k in range(order + 1, len(derivatives)):
        total = total + derivatives[k] * power * Fraction(1, factorial(k - order))
        power = power * elapsed
    return float(total) if isinstance(elapsed, float) else total


def bernstein_coefficients(derivatives: Sequence[Number], duration: Number, order: int = 0) -> list[Number]:
    """Return the Bernstein coefficients over ``[0, duration]`` of the derivative of `order`.

    The polynomial stays within the smallest and largest coefficient over the whole span, and takes the first and the
    last one at its ends: a bound at the coefficients is a bound at every instant, not only at samples.

    Examples
    --------
    >>> bernstein_coefficients([0.0, 10.0, -2.0], 3.0)
    [0.0, 15.0, 21.0]
    """
    monomials: list[Number] = []
    power: Number = None
    for k in range(order, len(derivatives)):
        term = derivatives[k] if power is None else derivatives[k] * power
        monomials.append(term * Fraction(1, factorial(k - order)))
        power = duration if power is None else power * duration
    degree = len(monomials) - 1
    result: list[Number] = []
    for i in range(degree + 1):
        total = monomials[0]
        for j in range(1, i + 1):
            total = total + monomials[j] * Fraction(comb(i, j), comb(degree, j))
        result.append(float(total) if isinstance(total, float) else total)
    return result
