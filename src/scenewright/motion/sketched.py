"""The motion that a sketch stands for, over numbers or unknowns: the paper's algorithms 1 and 2, continuous in speed.

What enters: speeds at the knots, durations of the pieces, a first position. What leaves: the state at a knot (a
symbolic time) and at a concrete time (nested choices over pieces). Knot speeds are the unknowns, so acceleration limits
are linear and positions bilinear: ``2 (x1 - x0) = (v0 + v1) d``.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from scenewright.motion.algebra import Condition, Symbol, Value, compare, conjunction, select
from scenewright.motion.polynomial import state_after

# Numerator and (positive) denominator: accelerations are differences of speeds over durations.
Ratio = tuple[Value, Value]
ONE = Fraction(1)


@dataclass(frozen=True, slots=True)
class SketchedMotion:
    """One actor's motion.

    Attributes
    ----------
    start
        Time of the first knot (s).
    positions, speeds
        At the knots, shape (K + 1,): known numbers or unknowns (m, m/s).
    durations
        Of the pieces, shape (K,) (s).
    accelerations
        Of the pieces where they are known or have a symbol of their own, else None (m/s^2).
    """

    start: Value
    positions: tuple[Value, ...]
    speeds: tuple[Value, ...]
    durations: tuple[Value, ...]
    accelerations: tuple[Value | None, ...]

    def time_at_knot(self, index: int) -> Value:
        """Return the time (s) from the start of the scenario to knot `index`."""
        total = self.start
        for duration in self.durations[:index]:
            total = total + duration
        return total

    def state_at_knot(self, index: int, order: int) -> Ratio:
        """Return the state at a symbolic time (algorithm 1) as a ratio.

        Acceleration is that of the piece that begins there, or at the last knot of the one that ends.
        """
        if order == 0:
            return self.positions[index], ONE
        if order == 1:
            return self.speeds[index], ONE
        return self.acceleration_of(min(index, len(self.durations) - 1))

    def acceleration_of(self, piece: int) -> Ratio:
        """Return the acceleration of a piece as a ratio."""
        known = self.accelerations[piece]
        if known is not None:
            return known, ONE
        return self.speeds[piece + 1] - self.speeds[piece], self.durations[piece]

    def state_at_time(self, time: Value, order: int) -> Value:
        """Return the state at a concrete time (algorithm 2): a choice over the pieces, and rest of motion after them.

        All accelerations must be known or have a symbol.
        """
        return self._choose(time, order, 0)

    def _choose(self, time: Value, order: int, piece: int) -> Value:
        if piece == len(self.durations):
            held = [self.positions[-1], self.speeds[-1], Fraction(0)]
            rest: Value = state_after(held, time - self.time_at_knot(piece), order)
            return rest
        begin = self.time_at_knot(piece)
        end = begin + self.durations[piece]
        inside: Condition = compare("<", time, end)
        if piece == 0:
            inside = conjunction([compare(">=", time, begin), inside]) if isinstance(begin, Symbol) else inside
        acceleration = self.accelerations[piece]
        if acceleration is None:
            raise ValueError("a concrete time needs the acceleration of every piece")
        derivatives = [self.positions[piece], self.speeds[piece], acceleration]
        then: Value = state_after(derivatives, time - begin, order)
        if isinstance(inside, bool):
            return then if inside else self._choose(time, order, piece + 1)
        return select(inside, then, self._choose(time, order, piece + 1))
