"""Where paths intersect: on curves that are known, and of random paths as shapely has it of their chords."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from scenewright.roads.intersections import intersections
from scenewright.roads.path import Path


def straight(start: tuple[float, float], heading_rad: float, length_m: float) -> Path:
    along = np.linspace(0.0, length_m, 20)[:, None]
    return Path.from_points(np.array(start) + along * np.array([np.cos(heading_rad), np.sin(heading_rad)]))


def circle(radius_m: float, turn_rad: float) -> Path:
    angles = np.linspace(0.0, turn_rad, 200)
    return Path.from_points(radius_m * np.column_stack([np.cos(angles), np.sin(angles)]))


def test_two_lines_meet_where_they_meet() -> None:
    met = intersections(straight((0, 0), 0.0, 100.0), straight((40.3, -30.0), np.pi / 2, 100.0))
    assert met == [pytest.approx((40.3, 30.0), abs=1e-6)]
    assert intersections(straight((0, 0), 0.0, 40.0), straight((40.3, -30.0), np.pi / 2, 100.0)) == []


def test_a_line_meets_a_circle_twice_in_the_order_of_the_first() -> None:
    """Through the centre: at 10 m and 60 m of the line, right and left of a circle of 25 m."""
    met = intersections(straight((-35.0, 0.0), 0.0, 80.0), circle(25.0, 6.0))
    assert [place[0] for place in met] == pytest.approx([10.0, 60.0], abs=1e-3)
    assert [place[1] for place in met] == pytest.approx([25.0 * np.pi, 0.0], abs=1e-2)


def test_lines_beside_each_other_never_meet() -> None:
    assert intersections(straight((0, 0), 0.4, 90.0), straight((0, 3.5), 0.4, 90.0)) == []


@settings(max_examples=25)
@given(seed=st.integers(0, 10**6))
def test_random_paths_meet_where_their_lines_do(seed: int) -> None:
    chance = np.random.default_rng(seed)
    paths = []
    for _ in range(2):
        headings = chance.uniform(-np.pi, np.pi) + np.cumsum(chance.normal(0.0, 0.25, 12))
        steps = 8.0 * np.column_stack([np.cos(headings), np.sin(headings)])
        paths.append(Path.from_points(chance.uniform(-15.0, 15.0, 2) + np.cumsum(steps, axis=0)))
    met = intersections(*paths)
    for s_a, s_b in met:
        assert np.hypot(*(np.subtract(paths[0].pose(s_a), paths[1].pose(s_b))[:2])) < 0.1
    lines = [shapely.LineString(path.poses(np.arange(0.0, path.length_m, 0.05))[:, :2]) for path in paths]
    wanted = shapely.get_coordinates(lines[0].intersection(lines[1]))
    found = np.array([paths[0].pose(s_a)[:2] for s_a, _ in met]).reshape(-1, 2)
    for point in wanted:
        assert np.hypot(*(found - point).T).min(initial=np.inf) < 0.5
