"""The turn of a route: where it is, and how tight."""

from __future__ import annotations

from scenewright.roads import find_route, load_map
from scenewright.roads.turns import TurnSpan, tightest_curvature

T = load_map("t_intersection")


def test_the_turn_of_a_route() -> None:
    assert TurnSpan.of(find_route(T, headings=("W",))) is None
    assert tightest_curvature(find_route(T, headings=("W",))) == 0.0
    right, left = (find_route(T, headings=h) for h in (("S", "W"), ("S", "E")))
    assert TurnSpan.of(right) == TurnSpan(right.landmarks["turn_start"], right.landmarks["turn_end"])
    assert tightest_curvature(right) > tightest_curvature(left) > 0.02
