"""How the lowering sees an actor's motion: by knot, by piece, by time.

What enters: a `Profile` (prediction, history) or a `SketchedMotion` with the knots that it passes. What leaves: values:
known motion gives numbers, sketched motion unknowns.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from scenewright.motion.algebra import Value, pin
from scenewright.motion.profile import Profile
from scenewright.motion.sketched import ONE, Ratio, SketchedMotion


class MotionView(Protocol):
    """One actor's motion as terms. A knot that will not be passed gives None."""

    def time(self, knot: str) -> Value | None:
        """Return when `knot` is passed (s)."""
        ...

    def at_knot(self, knot: str, order: int) -> Ratio | None:
        """Return the state at `knot`."""
        ...

    def at_time(self, time: Value, order: int) -> Value | None:
        """Return the state at a concrete or symbolic time."""
        ...

    def on_piece(self, piece: int, order: int) -> Ratio | None:
        """Return the state that holds all through a piece of the sketch."""
        ...


@dataclass(frozen=True, slots=True)
class KnownView:
    """A motion that is known or predicted, with the times of the knots that are known."""

    profile: Profile
    knot_times_s: Mapping[str, float]

    def time(self, knot: str) -> Value | None:
        """Return when `knot` is passed (s)."""
        time_s = self.knot_times_s.get(knot)
        return None if time_s is None else pin(time_s)

    def at_knot(self, knot: str, order: int) -> Ratio | None:
        """Return the state at `knot`."""
        time_s = self.knot_times_s.get(knot)
        return None if time_s is None else (pin(self.profile.state(time_s)[order]), ONE)

    def at_time(self, time: Value, order: int) -> Value | None:
        """Return the state at a known time; None where the time is itself unknown."""
        if not isinstance(time, int | Fraction):
            return None
        return pin(self.profile.state(float(time))[order])

    def on_piece(self, piece: int, order: int) -> Ratio | None:
        """Return None: known motion has no pieces of a sketch."""
        return None


@dataclass(frozen=True, slots=True)
class SketchedView:
    """A motion to be found.

    Attributes
    ----------
    knots
        Indices in `motion` by name.
    pieces
        The first and last stretch of `motion` that carries out a piece of the sketch.
    past
        The knots that are history.
    """

    motion: SketchedMotion
    knots: Mapping[str, int]
    pieces: Mapping[int, tuple[int, int]]
    past: KnownView | None = None

    def time(self, knot: str) -> Value | None:
        """Return when `knot` is passed (s)."""
        if knot in self.knots:
            return self.motion.time_at_knot(self.knots[knot])
        return self.past.time(knot) if self.past else None

    def at_knot(self, knot: str, order: int) -> Ratio | None:
        """Return the state at `knot`."""
        if knot in self.knots:
            return self.motion.state_at_knot(self.knots[knot], order)
        return self.past.at_knot(knot, order) if self.past else None

    def at_time(self, time: Value, order: int) -> Value | None:
        """Return the state at a time; None where an acceleration has no value of its own."""
        if any(acceleration is None for acceleration in self.motion.accelerations):
            return None
        return self.motion.state_at_time(time, order)

    def on_piece(self, piece: int, order: int) -> Ratio | None:
        """Return the acceleration of a piece, or the speed of one that holds it."""
        if piece not in self.pieces:
            return None
        first, last = self.pieces[piece]
        if first != last:
            return None
        return self.motion.acceleration_of(first) if order == 2 else self.motion.state_at_knot(first, order)
