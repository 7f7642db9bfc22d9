"""Lengths, headings and turns of lines of points, worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.roads.polyline import chord_heading_rad, polyline_arc_lengths, turn_of, turned_rad

STAIRS = np.array([[0.0, 0.0], [3.0, 4.0], [3.0, 10.0], [3.0, 10.0], [2.0, 10.0]])


def arc(turn_rad: float, heading_rad: float = 0.3, radius_m: float = 20.0) -> np.ndarray:
    angles = heading_rad + np.linspace(0.0, turn_rad, 60)
    steps = np.column_stack([np.cos(angles), np.sin(angles)]) * abs(turn_rad) * radius_m / 60
    return np.cumsum(steps, axis=0)


def test_lengths_add_up() -> None:
    assert polyline_arc_lengths(STAIRS).tolist() == [0.0, 5.0, 11.0, 11.0, 12.0]


@pytest.mark.parametrize(
    ("end", "heading"),
    [((1, 0), 0.0), ((0, 2), np.pi / 2), ((-3, 0), np.pi), ((0, -1), -np.pi / 2), ((2, 2), np.pi / 4)],
)
def test_a_heading_counts_from_east_to_the_left(end: tuple[float, float], heading: float) -> None:
    assert chord_heading_rad(np.zeros(2), np.array(end, dtype=float)) == pytest.approx(heading)


@given(turn=st.floats(-10.0, 10.0).filter(lambda turn: abs(turn) > 0.1), heading=st.floats(-3.0, 3.0))
def test_a_turn_counts_its_windings_whichever_way_it_is_headed(turn: float, heading: float) -> None:
    assert turned_rad(arc(turn, heading)) == pytest.approx(turn * 58 / 59, rel=1e-3)


def test_points_that_coincide_turn_nothing() -> None:
    assert turned_rad(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1e-5], [2.0, 1e-5]])) == 0.0
    assert turned_rad(np.zeros((3, 2))) == 0.0


@pytest.mark.parametrize(
    ("degrees", "name"), [(29.0, "straight"), (33.0, "left"), (-29.0, "straight"), (-33.0, "right"), (200.0, "left")]
)
def test_less_than_thirty_degrees_is_straight(degrees: float, name: str) -> None:
    assert turn_of(arc(np.radians(degrees))) == name
