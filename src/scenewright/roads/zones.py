"""Over which stretches around a place two vehicles, one on each path, could touch.

What enters: two paths, a place on both, two bodies. What leaves: a stretch of each path. Lanes, time and speed play no
part here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scenewright.roads.bodies import Body
from scenewright.roads.intersections import Place
from scenewright.roads.path import Path
from scenewright.roads.polyline import FloatArray

Zone = tuple[float, float]

_STEP_M = 0.1
_REACH_M = 60.0  # how far from the place is looked at first
_FURTHEST_M = 240.0  # lanes that merge as flat as that are one road long before
_ROWS = 64  # compared at a time: so few are near each other, and far from most of the other path


def touching(
    paths: tuple[Path, Path],
    place: Place,
    bodies: tuple[Body, Body],
    *,
    back_m: float = np.inf,
    ahead_m: float = np.inf,
) -> tuple[Zone, Zone]:
    """Return the stretches around a place over which two vehicles, one on each path, could touch.

    They hold every arc length at which a vehicle on one path touches one somewhere in the other stretch, without a
    gap around the place; they are rounded outwards to 0.1 m. Both stay within their path and within `back_m` before and
    `ahead_m` behind the place.
    """
    reach_m = _REACH_M
    while True:
        along = [
            _grid(path, s_m, min(back_m, reach_m), min(ahead_m, reach_m))
            for path, s_m in zip(paths, place, strict=True)
        ]
        poses_a, poses_b = (path.poses(s_m) for path, s_m in zip(paths, along, strict=True))
        spans = _spans(
            boxes_touch(poses_a, poses_b, *bodies), _nearest(along[0], place[0]), _nearest(along[1], place[1])
        )
        cut_short = any(
            (low == 0 and back_m > reach_m and grid[0] > 0.0)
            or (high == len(grid) - 1 and ahead_m > reach_m and grid[-1] < path.length_m - _STEP_M)
            for (low, high), grid, path in zip(spans, along, paths, strict=True)
        )
        if not cut_short or reach_m >= _FURTHEST_M:
            first, second = (_zone(grid, *span) for grid, span in zip(along, spans, strict=True))
            return first, second
        reach_m *= 2.0


def _grid(path: Path, s_m: float, back_m: float, ahead_m: float) -> FloatArray:
    end_m = min(path.length_m, s_m + ahead_m)
    grid: FloatArray = np.arange(max(0.0, s_m - back_m), end_m + 0.5 * _STEP_M, _STEP_M)
    return np.minimum(grid, end_m)


def _nearest(grid: FloatArray, s_m: float) -> int:
    return int(np.argmin(np.abs(grid - s_m)))


def _zone(grid: FloatArray, low: int, high: int) -> Zone:
    return max(float(grid[0]), float(grid[low]) - _STEP_M), min(float(grid[-1]), float(grid[high]) + _STEP_M)


def _spans(touch: NDArray[np.bool_], row: int, column: int) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return the unbroken touched rows around `row` and columns around `column`, each counting the other's only."""
    rows, columns = (0, touch.shape[0] - 1), (0, touch.shape[1] - 1)
    while True:
        before = rows, columns
        rows = _unbroken(np.any(touch[:, columns[0] : columns[1] + 1], axis=1), row)
        columns = _unbroken(np.any(touch[rows[0] : rows[1] + 1], axis=0), column)
        if (rows, columns) == before:
            return rows, columns


def _unbroken(touched: NDArray[np.bool_], middle: int) -> tuple[int, int]:
    low = high = middle
    while low > 0 and touched[low - 1]:
        low -= 1
    while high < len(touched) - 1 and touched[high + 1]:
        high += 1
    return low, high


def boxes_touch(poses_a: FloatArray, poses_b: FloatArray, body_a: Body, body_b: Body) -> NDArray[np.bool_]:
    """Return whether the boxes of every pair of poses overlap (separating axes of both boxes), shape (A, B)."""
    touch = np.zeros((len(poses_a), len(poses_b)), dtype=bool)
    # Most pairs are far apart; only near ones need the full test.
    reach_m = body_a.reach_m() + body_b.reach_m()
    places_b = poses_b[:, :2]
    for first in range(0, len(poses_a), _ROWS):
        block = poses_a[first : first + _ROWS]
        low, high = block[:, :2].min(axis=0) - reach_m, block[:, :2].max(axis=0) + reach_m
        columns = np.flatnonzero(np.all((places_b >= low) & (places_b <= high), axis=1))
        apart = places_b[None, columns] - block[:, None, :2]
        row, column = np.nonzero((apart * apart).sum(axis=2) <= reach_m**2)
        column = columns[column]
        touch[first + row, column] = overlap(block[row], poses_b[column], body_a, body_b)
    return touch


def overlap(poses_a: FloatArray, poses_b: FloatArray, body_a: Body, body_b: Body) -> NDArray[np.bool_]:
    """Return whether boxes overlap; poses are ``x, y, heading`` along the last axis, all other axes are broadcast."""
    dx, dy, turned = (poses_b[..., k] - poses_a[..., k] for k in range(3))
    cos, sin = np.abs(np.cos(turned)), np.abs(np.sin(turned))
    touch = np.ones(dx.shape, dtype=bool)
    for own, other, heading in ((body_a, body_b, poses_a[..., 2]), (body_b, body_a, poses_b[..., 2])):
        along_m = 0.5 * (own.length_m + other.length_m * cos + other.width_m * sin)
        across_m = 0.5 * (own.width_m + other.length_m * sin + other.width_m * cos)
        touch &= np.abs(dx * np.cos(heading) + dy * np.sin(heading)) <= along_m
        touch &= np.abs(-dx * np.sin(heading) + dy * np.cos(heading)) <= across_m
    return touch
