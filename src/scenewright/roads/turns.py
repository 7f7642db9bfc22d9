"""Where the turn of a route is, and how tight.

What enters: a route. What leaves: the places where its turn begins and ends, and its tightest curvature.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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


def tightest_curvature(route: Route) -> float:
    """Return the largest curvature (1/m) of a route's turn; 0 where it goes straight."""
    turn = TurnSpan.of(route)
    if turn is None:
        return 0.0
    steps = max(2, int((turn.end_m - turn.start_m) / 0.5))
    places = turn.start_m + (turn.end_m - turn.start_m) * np.arange(steps + 1) / steps
    return float(np.abs(route.path.curvatures(places)).max())
