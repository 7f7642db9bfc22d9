"""Small facts about lines of points: cumulative length, heading, how far and which way a line turns.

What enters: points, shape (N, 2), metres. What leaves: numbers. For smooth curves see `path`.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Turn = Literal["left", "right", "straight"]

_TURN_FROM_RAD = np.radians(30.0)


def polyline_arc_lengths(points_xy: FloatArray) -> FloatArray:
    """Return the cumulative chord length at every point of a polyline, shape (N,), metres."""
    steps = np.diff(points_xy, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])


def chord_heading_rad(start_xy: FloatArray, end_xy: FloatArray) -> float:
    """Return the heading of the way from one point to another."""
    return float(np.arctan2(end_xy[1] - start_xy[1], end_xy[0] - start_xy[0]))


def turned_rad(points_xy: FloatArray) -> float:
    """Return by how much a line turns from its first to its last piece, left positive, windings counted."""
    steps = np.diff(points_xy, axis=0)
    steps = steps[np.hypot(steps[:, 0], steps[:, 1]) > 1e-3]
    headings = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    return float(headings[-1] - headings[0]) if len(headings) else 0.0


def turn_of(points_xy: FloatArray) -> Turn:
    """Name the way a line turns; less than 30 degrees is straight."""
    turned = turned_rad(points_xy)
    if abs(turned) < _TURN_FROM_RAD:
        return "straight"
    return "left" if turned > 0 else "right"
