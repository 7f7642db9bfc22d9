"""How fast a vehicle may be in a turn: the condition that a stretch of motion keeps to it all through the turn.

What enters: positions and speeds at the ends of a stretch, where the turn lies, its top speed. What leaves: a
condition. Speed over distance is monotone within a stretch of one acceleration, so its largest value within the turn
is at a known place.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.motion.algebra import Condition, Value, compare, conjunction, disjunction, pin
from scenewright.roads.routes import Route


@dataclass(frozen=True, slots=True)
class TurnSpan:
    """Where on a route a turn begins and ends (m)."""

    start_m: float
    end_m: float

    @classmethod
    def of(cls, route: Route) -> TurnSpan | None:
        """Return the turn of `route`, or None where it goes straight."""
        start, end = route.landmarks.get("turn_start"), route.landmarks.get("turn_end")
        return None if route.turn == "straight" or start is None or end is None else cls(start, end)


def keeps_to_turn_speed(
    turn: TurnSpan, top_mps: float, x0: Value, v0: Value, x1: Value, v1: Value, braking: bool
) -> Condition:
    """Return the condition that speed stays at most `top_mps` (m/s) wherever a stretch lies within the turn.

    Where it speeds up or holds its speed, the end is fastest. Where it brakes, the fastest place within the turn is its
    beginning, and ``v^2`` falls linearly with distance.
    """
    start, end, top = pin(turn.start_m), pin(turn.end_m), pin(top_mps)
    outside = [compare(">=", x0, end), compare("<=", x1, start)]
    if not braking:
        return disjunction([*outside, compare("<=", v1, top)])
    within = conjunction([compare(">=", x0, start), compare("<=", v0, top)])
    falling = compare("<=", (v0 * v0 - v1 * v1) * (x1 - start), (top * top - v1 * v1) * (x1 - x0))
    entering = conjunction([compare("<", x0, start), falling])
    return disjunction([*outside, within, entering])


def is_slow_in_turn(turn: TurnSpan, top_mps: float, x0: Value, v0: Value, x1: Value, v1: Value) -> Condition:
    """Return a linear condition that is enough for `keeps_to_turn_speed`: at both ends of a stretch that touches it."""
    start, end, top = pin(turn.start_m), pin(turn.end_m), pin(top_mps)
    slow = conjunction([compare("<=", v0, top), compare("<=", v1, top)])
    return disjunction([compare(">=", x0, end), compare("<=", x1, start), slow])


def tightest_curvature(route: Route) -> float:
    """Return the largest curvature (1/m) of a route's turn; 0 where it goes straight."""
    turn = TurnSpan.of(route)
    if turn is None:
        return 0.0
    steps = max(2, int((turn.end_m - turn.start_m) / 0.5))
    places = (turn.start_m + (turn.end_m - turn.start_m) * i / steps for i in range(steps + 1))
    return max(abs(route.path.curvature(s_m)) for s_m in places)
