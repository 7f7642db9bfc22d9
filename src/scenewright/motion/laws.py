"""Laws of motion: which motions a piece admits, and from that one definition all that others need of it.

What enters: bounds on rate and speed. What leaves: for a `Law` what it `admits`, the exact conditions on the ends of a
stretch that it can reach (`reach`, over numbers or over polynomials of unknowns), and a motion between ends that can
be reached (`realise`). A part of a piece obeys the same law, so pieces may be split anywhere. It knows no program and
no map; jerk is no part of a law.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

# A number of any kind, or a polynomial of unknowns: reach conditions are written once for all of them.
Number = Any
Move = tuple[float, float]  # duration (s), acceleration (m/s^2)


@dataclass(frozen=True, slots=True)
class Law:
    """An acceleration within ``rate_low..rate_high`` and a speed within ``speed_low..speed_high``, all along (SI).

    Examples
    --------
    >>> braking = Law(Fraction(-8), Fraction(0), Fraction(0), Fraction(18))
    >>> braking.meet(Law(Fraction(-3), Fraction(4), Fraction(0), Fraction(14))).rate_low
    Fraction(-3, 1)
    """

    rate_low: Fraction
    rate_high: Fraction
    speed_low: Fraction
    speed_high: Fraction

    def meet(self, other: Law) -> Law:
        """Return the law that both together make; `is_empty` where nothing obeys both."""
        return Law(
            max(self.rate_low, other.rate_low),
            min(self.rate_high, other.rate_high),
            max(self.speed_low, other.speed_low),
            min(self.speed_high, other.speed_high),
        )

    @property
    def is_empty(self) -> bool:
        """Whether no motion obeys this law."""
        return self.rate_low > self.rate_high or self.speed_low > self.speed_high

    def words(self) -> str:
        """Say in plain words what a motion of this law does and does not do.

        Examples
        --------
        >>> Law(Fraction(-8), Fraction(0), Fraction(0), Fraction(18)).words()
        'brakes at 8 m/s^2 at most, never speeds up, and is 18 m/s fast at most'
        """
        if self.speed_high <= 0:
            return "stands"
        low, high, top = (f"{abs(float(value)):.3g}" for value in (self.rate_low, self.rate_high, self.speed_high))
        brakes = f"brakes at {low} m/s^2 at most" if self.rate_low < 0 else "never brakes"
        speeds_up = f"speeds up at {high} m/s^2 at most" if self.rate_high > 0 else "never speeds up"
        return f"{brakes}, {speeds_up}, and is {top} m/s fast at most"

    def admits(self, speed_mps: float, moves: Sequence[Move], slack: float = 1e-6) -> bool:
        """Whether a motion that begins at `speed_mps` and makes these moves obeys the law, up to `slack` (SI)."""
        low, high = float(self.speed_low) - slack, float(self.speed_high) + slack
        if not low <= speed_mps <= high:
            return False
        for duration_s, rate_mpss in moves:
            if duration_s <= 0.0:
                continue
            speed_mps += duration_s * rate_mpss
            if not float(self.rate_low) - slack <= rate_mpss <= float(self.rate_high) + slack:
                return False
            if not low <= speed_mps <= high:
                return False
        return True


ANY_RATE, ANY_SPEED = Fraction(1000), Fraction(1000)
ANY = Law(-ANY_RATE, ANY_RATE, -ANY_SPEED, ANY_SPEED)


@dataclass(frozen=True, slots=True)
class Reach:
    """What the ends of a stretch must meet: `rows` ``<= 0``, `equal` ``== 0``, of each of `choices` one ``<= 0``."""

    rows: tuple[Number, ...] = ()
    equal: tuple[Number, ...] = ()
    choices: tuple[tuple[Number, Number], ...] = ()
    impossible: bool = False


def reach(law: Law, v1: Number, v2: Number, d: Number, x: Number) -> Reach:
    """Return the conditions, exact, under which a motion of `law` leads from speed `v1` to `v2` in time `d` over `x`.

    Speeds at the ends are within the law's own bounds, and ``d >= 0``: both are for the caller to say. All conditions
    are of second degree at most. Derived from the two extreme motions, fastest first and slowest first: `x` lies
    between their integrals. Where the top or the lowest speed is not met on the way an extreme has two rates, else
    three; the pairs in `choices` tell these cases apart.
    """
    if law.is_empty:
        return Reach(impossible=True)
    al, be, lo, hi = law.rate_low, law.rate_high, law.speed_low, law.speed_high
    if al == be:
        return Reach(equal=fixed(al, v1, v2, d, x))
    rows = bounded(al, be, lo, hi, v1, v2, d, x)
    return Reach(rows=rows, choices=capped(al, be, lo, hi, v1, v2, d, x) if al < 0 < be else ())


def fixed(al: Number, v1: Number, v2: Number, d: Number, x: Number) -> tuple[Number, Number]:
    """Return what is zero where the rate is `al`: the second by itself says that there is one rate."""
    return v2 - v1 - al * d, 2 * x - (v1 + v2) * d


def bounded(
    al: Number, be: Number, lo: Number, hi: Number, v1: Number, v2: Number, d: Number, x: Number
) -> tuple[Number, ...]:
    """Return what is at most zero where the rate is between `al` and `be`, and the speed between `lo` and `hi`."""
    over, under = be * d - (v2 - v1), v2 - v1 - al * d
    return (
        -over,
        -under,
        (be - al) * (2 * x - 2 * v1 * d - be * d * d) + over * over,
        (be - al) * (2 * v1 * d + al * d * d - 2 * x) + under * under,
        lo * d - x,
        x - hi * d,
    )


def capped(
    al: Number, be: Number, lo: Number, hi: Number, v1: Number, v2: Number, d: Number, x: Number
) -> tuple[tuple[Number, Number], tuple[Number, Number]]:
    """Return pairs, of which one is at most zero, where both signs of the rate are possible.

    The top speed is not met, or what it costs to meet it; the lowest likewise.
    """
    top = (
        -al * v1 + be * v2 - al * be * d - (be - al) * hi,
        -al * (hi - v1) * (hi - v1) + be * (hi - v2) * (hi - v2) + 2 * al * be * (hi * d - x),
    )
    low = (
        -be * (v1 - lo) + al * (v2 - lo) - al * be * d,
        be * (v1 - lo) * (v1 - lo) - al * (v2 - lo) * (v2 - lo) + 2 * al * be * (x - lo * d),
    )
    return top, low


def realise(law: Law, v1: float, v2: float, d: float, x: float) -> list[Move]:
    """Return moves of `law` from speed `v1` to `v2` in `d` seconds over `x` metres, for ends within its reach.

    Even acceleration is always legal between such ends; it is mixed with the fastest or the slowest motion, whichever
    side `x` is on. `x` is linear in the share of the mixture, so it is met exactly; at most five rates come of it.
    """
    if d <= 0.0:
        return []
    even = (v2 - v1) / d
    missing = x - 0.5 * (v1 + v2) * d
    if abs(missing) < 1e-12:
        return [(d, even)]
    extreme = _fastest(law, v1, v2, d) if missing > 0 else _slowest(law, v1, v2, d)
    reachable = _distance(v1, extreme) - 0.5 * (v1 + v2) * d
    share = 1.0 if abs(reachable) < 1e-15 else min(1.0, missing / reachable)
    return [(duration, even + share * (rate - even)) for duration, rate in extreme if duration > 0.0]


def _fastest(law: Law, v1: float, v2: float, d: float) -> list[Move]:
    """Return the motion that is at each instant as fast as any: up at the highest rate, level at the top, down."""
    up, down, top = float(law.rate_high), float(law.rate_low), float(law.speed_high)
    return _peaked(up, down, top, v1, v2, d)


def _slowest(law: Law, v1: float, v2: float, d: float) -> list[Move]:
    """Return the motion that is at each instant as slow as any."""
    moves = _peaked(-float(law.rate_low), -float(law.rate_high), -float(law.speed_low), -v1, -v2, d)
    return [(duration, -rate) for duration, rate in moves]


def _peaked(up: float, down: float, top: float, v1: float, v2: float, d: float) -> list[Move]:
    if up - down < 1e-12:
        return [(d, (v2 - v1) / d)]
    first = min(d, max(0.0, (v2 - v1 - down * d) / (up - down)))
    if v1 + up * first <= top + 1e-12 or up <= 0.0 or down >= 0.0:
        return [(first, up), (d - first, down)]
    rising, falling = max(0.0, (top - v1) / up), max(0.0, (top - v2) / -down)
    return [(rising, up), (max(0.0, d - rising - falling), 0.0), (falling, down)]


def _distance(v1: float, moves: Sequence[Move]) -> float:
    total = 0.0
    for duration, rate in moves:
        total += (v1 + 0.5 * rate * duration) * duration
        v1 += rate * duration
    return total


def holds(conditions: Reach, slack: float = 0.0) -> bool:
    """Whether conditions over numbers hold, each up to `slack`."""
    return (
        not conditions.impossible
        and all(row <= slack for row in conditions.rows)
        and all(abs(row) <= slack for row in conditions.equal)
        and all(min(pair) <= slack for pair in conditions.choices)
    )
