"""Where the lines of two paths intersect, over the whole of both.

What enters: two paths. What leaves: pairs of arc lengths. It knows nothing of lanes: where two paths run along each
other, rounding makes them intersect again and again, and that is told as it is.
"""

from __future__ import annotations

from math import dist

import numpy as np

from scenewright.roads.path import Path
from scenewright.roads.polyline import FloatArray

Place = tuple[float, float]

_SAMPLE_M = 1.0
_BLOCK = 32  # chords whose common box is looked at before any of them
_NO_GAP_M = 0.1
_SAME_M = 1e-6  # rounding, of an intersection that is found from two chords
_STRAY_M = 2.0  # Newton's method starts within a chord of the intersection; it has no business further away


def intersections(path_a: Path, path_b: Path) -> list[Place]:
    """Return the arc lengths on both paths of every intersection, along the first: on chords, then on the curves."""
    s_a, s_b = _samples(path_a), _samples(path_b)
    points_a, points_b = path_a.poses(s_a)[:, :2], path_b.poses(s_b)[:, :2]
    found: list[Place] = []
    for i, j in _near_blocks(points_a, points_b):
        part_a, part_b = slice(i, i + _BLOCK + 1), slice(j, j + _BLOCK + 1)
        on_chords = _on_chords(points_a[part_a], points_b[part_b], s_a[part_a], s_b[part_b])
        found += [_polished(path_a, path_b, a, b) for a, b in on_chords]
    # Chords on one straight line have no point of their own in common: what rounding makes of them is anywhere.
    met = sorted(place for place in found if _gap_m(path_a, path_b, *place) < _NO_GAP_M)
    # One at the end of a chord is at the beginning of the next one, too.
    return [place for number, place in enumerate(met) if not number or dist(place, met[number - 1]) > _SAME_M]


def _gap_m(path_a: Path, path_b: Path, a: float, b: float) -> float:
    return dist(path_a.pose(a)[:2], path_b.pose(b)[:2])


def _samples(path: Path) -> FloatArray:
    return np.linspace(0.0, path.length_m, max(2, int(np.ceil(path.length_m / _SAMPLE_M)) + 1))


def _near_blocks(points_a: FloatArray, points_b: FloatArray) -> list[tuple[int, int]]:
    """Return the first chords of all pairs of blocks whose boxes overlap."""
    (low_a, high_a), (low_b, high_b) = _boxes(points_a), _boxes(points_b)
    apart = (low_a[:, None] > high_b[None]) | (low_b[None] > high_a[:, None])
    return [(i * _BLOCK, j * _BLOCK) for i, j in np.argwhere(~apart.any(axis=2)).tolist()]


def _boxes(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    low, high = np.minimum(points[:-1], points[1:]), np.maximum(points[:-1], points[1:])
    starts = np.arange(0, len(low), _BLOCK)
    return np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)


def _on_chords(points_a: FloatArray, points_b: FloatArray, s_a: FloatArray, s_b: FloatArray) -> list[Place]:
    step_a, step_b = np.diff(points_a, axis=0)[:, None, :], np.diff(points_b, axis=0)[None, :, :]
    between = points_b[None, :-1, :] - points_a[:-1, None, :]
    cross = step_a[..., 0] * step_b[..., 1] - step_a[..., 1] * step_b[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (between[..., 0] * step_b[..., 1] - between[..., 1] * step_b[..., 0]) / cross
        u = (between[..., 0] * step_a[..., 1] - between[..., 1] * step_a[..., 0]) / cross
        hits = np.argwhere((t >= 0.0) & (t <= 1.0) & (u >= 0.0) & (u <= 1.0))
    return [
        (
            float(s_a[i] + t[i, j] * (s_a[i + 1] - s_a[i])),
            float(s_b[j] + u[i, j] * (s_b[j + 1] - s_b[j])),
        )
        for i, j in hits.tolist()
    ]


def _polished(path_a: Path, path_b: Path, first_a: float, first_b: float) -> Place:
    a, b = first_a, first_b
    for _ in range(20):
        xa, ya, ha = path_a.pose(a)
        xb, yb, hb = path_b.pose(b)
        determinant = np.sin(ha - hb)
        if abs(determinant) < 1e-6:
            break
        dx, dy = xb - xa, yb - ya
        step_a = float((-dx * np.sin(hb) + dy * np.cos(hb)) / determinant)
        step_b = float((-dx * np.sin(ha) + dy * np.cos(ha)) / determinant)
        a, b = a + step_a, b + step_b
        if abs(a - first_a) + abs(b - first_b) > _STRAY_M:
            return first_a, first_b
        if abs(step_a) + abs(step_b) < 1e-9:
            break
    return a, b
