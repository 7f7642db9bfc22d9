"""Searches continuous time for the instant at which something holds best, and for crossings.

What enters: functions of arrays of instants, and the instants to start from. What leaves: instants, found between
samples to far below a millisecond. It knows nothing of programs and traces.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.judge.tolerance import FloatArray

Score = Callable[[FloatArray], FloatArray]
_POINTS = 33
_ROUNDS = 8  # each makes the bracket sixteen times smaller: from 0.02 s to below a picosecond
_MOST = 24


@dataclass(frozen=True, slots=True)
class Minimum:
    """A local minimum: where, and how low."""

    time_s: float
    score: float


def minima(score: Score, grid_s: FloatArray) -> list[Minimum]:
    """Return the local minima of `score`, refined between the points of the grid, best first, then earliest.

    Of a stretch that is equally low the first instant counts.
    """
    values = score(grid_s)
    before = np.concatenate(([np.inf], values[:-1]))
    after = np.concatenate((values[1:], [np.inf]))
    low = np.flatnonzero((values < before) & (values <= after) & np.isfinite(values))
    low = low[np.argsort(values[low], kind="stable")][:_MOST]
    found = _refined(score, grid_s, low) if len(low) else []
    return sorted(found, key=lambda minimum: (round(minimum.score, 9), minimum.time_s))


def stretches(holds: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the first and the last index of each stretch of points at which something holds."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], holds, [False]))))
    return [(int(first), int(beyond) - 1) for first, beyond in edges.reshape(-1, 2)]


def sharpen(score: Score, grid_s: FloatArray) -> FloatArray:
    """Return the refined instants of the lowest few local minima."""
    return np.array([minimum.time_s for minimum in minima(score, grid_s)[:4]], dtype=np.float64)


def _refined(score: Score, grid_s: FloatArray, lowest: NDArray[np.intp]) -> list[Minimum]:
    """Refine all minima at once: a call of `score` costs more than the instants it is asked for."""
    low, high = grid_s[np.maximum(lowest - 1, 0)], grid_s[np.minimum(lowest + 1, len(grid_s) - 1)]
    best_s, best = grid_s[lowest], score(grid_s[lowest])
    each = np.arange(len(lowest))
    for _ in range(_ROUNDS):
        points = np.linspace(low, high, _POINTS, axis=1)
        values = score(points.ravel()).reshape(points.shape)
        at = np.argmin(values, axis=1)
        point_s, value = points[each, at], values[each, at]
        better = (value < best) | ((value == best) & (point_s < best_s))
        best_s, best = np.where(better, point_s, best_s), np.where(better, value, best)
        low, high = points[each, np.maximum(at - 1, 0)], points[each, np.minimum(at + 1, _POINTS - 1)]
    return [Minimum(float(time_s), float(value)) for time_s, value in zip(best_s, best, strict=True)]


def first_crossing(level: Score, grid_s: FloatArray) -> float | None:
    """Return the first instant at which `level` is zero or has changed its sign, or None."""
    values = level(grid_s)
    if values[0] == 0:
        return float(grid_s[0])
    changed = np.flatnonzero(np.sign(values[1:]) != np.sign(values[0]))
    if not len(changed):
        return None
    low, high = float(grid_s[changed[0]]), float(grid_s[changed[0] + 1])
    for _ in range(_ROUNDS):
        points = np.linspace(low, high, _POINTS)
        inside = level(points)
        at = int(np.argmax(np.sign(inside) != np.sign(values[0])))
        if at == 0:
            return float(points[0])
        low, high = float(points[at - 1]), float(points[at])
    return high
