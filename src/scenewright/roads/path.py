"""A smooth path by arc length, and Frenet coordinates on it.

What enters: points along a line. What leaves: poses, curvature and the way between map and path coordinates, as plain
floats in a few microseconds a call: planners and simulators ask for one pose at a time. It knows nothing of lanes.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np

from scenewright.roads.polyline import FloatArray, polyline_arc_lengths

_MIN_SPACING_M = 0.25  # closer points would turn rounding in a map file into kinks
_NEAR_M = 10.0  # how far the foot point may lie from where the caller expects it
_STEP_LIMIT_M = 2.0
_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(5)

Segment = tuple[float, float, float, float, float, float, float, float]
_Foot = tuple[float, float, float, float, float]  # arc length, x, y, and the derivatives of x and y


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A cubic spline through points, parametrised by its own arc length.

    Outside ``[0, length_m]`` the path goes on straight along its end tangents.

    Examples
    --------
    >>> path = Path.from_points([[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]])
    >>> [round(value, 6) for value in path.pose(4.0)]
    [4.0, 0.0, 0.0]
    >>> [round(value, 6) for value in path.to_frenet(12.0, 1.0)]
    [12.0, 1.0, 0.0]
    """

    knots_m: tuple[float, ...]
    segments: tuple[Segment, ...]
    points_xy: FloatArray = field(repr=False)

    @classmethod
    def from_points(cls, points_xy: FloatArray | list[list[float]]) -> Path:
        """Fit the path.

        Parameters
        ----------
        points_xy
            At least two points in metres, shape (N, 2), in order; points that nearly coincide are thinned out.

        Raises
        ------
        ValueError
            If fewer than two distinct points remain.
        """
        points = _thinned(np.asarray(points_xy, dtype=float))
        along_m = polyline_arc_lengths(points)
        # The parameter of a spline through chords is not its arc length: measure the arcs, fit again, and it nearly is.
        for _ in range(3):
            coefficients = [_spline(along_m, points[:, axis]) for axis in (0, 1)]
            along_m = np.concatenate([[0.0], np.cumsum(_arc_lengths(along_m, *coefficients))])
        x, y = (_spline(along_m, points[:, axis]) for axis in (0, 1))
        segments = tuple(tuple(row) for row in np.hstack([x, y]).tolist())
        return cls(tuple(along_m.tolist()), segments, points)

    @property
    def length_m(self) -> float:
        """Arc length from the first point to the last."""
        return self.knots_m[-1]

    def pose(self, s_m: float) -> tuple[float, float, float]:
        """Return ``x_m, y_m, heading_rad`` at an arc length."""
        x, y, dx, dy, _, _ = self._derivatives(s_m)
        return x, y, atan2(dy, dx)

    def curvature(self, s_m: float) -> float:
        """Return the curvature in 1/m at an arc length, left turns positive."""
        _, _, dx, dy, ddx, ddy = self._derivatives(s_m)
        speed = dx * dx + dy * dy
        return (dx * ddy - dy * ddx) / (speed * sqrt(speed))

    def poses(self, s_m: FloatArray) -> FloatArray:
        """Return ``x, y, heading`` at many arc lengths, shape (N, 3)."""
        s = np.atleast_1d(np.asarray(s_m, dtype=float))
        t, (ax, bx, cx, dx, ay, by, cy, dy) = self._at(s)
        tangent_x, tangent_y = bx + t * (2 * cx + 3 * dx * t), by + t * (2 * cy + 3 * dy * t)
        norm, over = np.hypot(tangent_x, tangent_y), s - np.clip(s, 0.0, self.length_m)
        x = ax + t * (bx + t * (cx + t * dx)) + over * tangent_x / norm
        y = ay + t * (by + t * (cy + t * dy)) + over * tangent_y / norm
        return np.column_stack([x, y, np.arctan2(tangent_y, tangent_x)])

    def curvatures(self, s_m: FloatArray) -> FloatArray:
        """Return the curvature in 1/m at many arc lengths, left turns positive, shape (N,)."""
        t, (_, bx, cx, dx, _, by, cy, dy) = self._at(s_m)
        x1, y1 = bx + t * (2 * cx + 3 * dx * t), by + t * (2 * cy + 3 * dy * t)
        x2, y2 = 2 * cx + 6 * dx * t, 2 * cy + 6 * dy * t
        speed = x1 * x1 + y1 * y1
        bends = (x1 * y2 - y1 * x2) / (speed * np.sqrt(speed))
        return np.where((s_m >= 0.0) & (s_m <= self.length_m), bends, 0.0)

    def _at(self, s_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return how far arc lengths are behind the knots before them, and the segments there, a row each number."""
        knots = np.array(self.knots_m)
        inside = np.clip(s_m, 0.0, knots[-1])
        index = np.clip(np.searchsorted(knots, inside, side="right") - 1, 0, len(knots) - 2)
        return inside - knots[index], np.array(self.segments)[index].T

    def to_cartesian(self, s_m: float, d_m: float = 0.0, heading_error_rad: float = 0.0) -> tuple[float, float, float]:
        """Return ``x_m, y_m, heading_rad`` of a place `d_m` left of the path at `s_m`, heading off by an angle."""
        x, y, heading = self.pose(s_m)
        return x - d_m * sin(heading), y + d_m * cos(heading), wrap_rad(heading + heading_error_rad)

    def to_frenet(
        self, x_m: float, y_m: float, heading_rad: float | None = None, near_s_m: float | None = None
    ) -> tuple[float, float, float]:
        """Return ``s_m, d_m, heading_error_rad`` of a pose.

        Parameters
        ----------
        x_m, y_m, heading_rad
            The pose in the map; without a heading the heading error is 0.
        near_s_m
            Where the foot point is expected. It is then sought nearby first, which is faster and does not
            jump where the path passes the same place twice.

        Returns
        -------
        tuple
            Arc length of the foot point, lateral distance (left positive) and heading relative to the path, in
            (-pi, pi]. Before the path's start s is negative, behind its end it exceeds the length.
        """
        foot = None if near_s_m is None else self._foot(x_m, y_m, near_s_m)
        if foot is None or (near_s_m is not None and abs(foot[0] - near_s_m) > _NEAR_M):
            foot = self._foot_anywhere(x_m, y_m)
        s, x, y, dx, dy = foot
        heading = atan2(dy, dx)
        d = ((y_m - y) * dx - (x_m - x) * dy) / hypot(dx, dy)
        return s, d, 0.0 if heading_rad is None else wrap_rad(heading_rad - heading)

    def _derivatives(self, s_m: float) -> tuple[float, float, float, float, float, float]:
        knots = self.knots_m
        if 0.0 <= s_m <= knots[-1]:
            index = bisect_right(knots, s_m, 1, len(knots) - 1) - 1
            t = s_m - knots[index]
            ax, bx, cx, dx, ay, by, cy, dy = self.segments[index]
            return (
                ax + t * (bx + t * (cx + t * dx)),
                ay + t * (by + t * (cy + t * dy)),
                bx + t * (2.0 * cx + 3.0 * dx * t),
                by + t * (2.0 * cy + 3.0 * dy * t),
                2.0 * cx + 6.0 * dx * t,
                2.0 * cy + 6.0 * dy * t,
            )
        index, t = (0, 0.0) if s_m < 0.0 else (-1, knots[-1] - knots[-2])
        ax, bx, cx, dx, ay, by, cy, dy = self.segments[index]
        tx, ty = bx + t * (2.0 * cx + 3.0 * dx * t), by + t * (2.0 * cy + 3.0 * dy * t)
        norm = hypot(tx, ty)
        tx, ty = tx / norm, ty / norm
        over = s_m if s_m < 0.0 else s_m - knots[-1]
        return (
            ax + t * (bx + t * (cx + t * dx)) + over * tx,
            ay + t * (by + t * (cy + t * dy)) + over * ty,
            tx,
            ty,
            0.0,
            0.0,
        )

    def _foot(self, x_m: float, y_m: float, guess_m: float) -> _Foot | None:
        """Newton's method for the foot of the perpendicular; None where it does not settle."""
        s = guess_m
        for _ in range(25):
            x, y, dx, dy, ddx, ddy = self._derivatives(s)
            rx, ry = x_m - x, y_m - y
            slope = dx * dx + dy * dy - rx * ddx - ry * ddy
            # Beyond the centre of curvature the slope changes sign; a floor keeps the step downhill.
            step = (rx * dx + ry * dy) / max(slope, 0.1)
            if abs(step) < 1e-9:
                return s, x, y, dx, dy
            # A straight extension is met in one step; on the path itself long steps may leave the basin.
            if 0.0 <= s <= self.knots_m[-1]:
                step = max(-_STEP_LIMIT_M, min(_STEP_LIMIT_M, step))
            s += step
        return (s, *self._derivatives(s)[:4]) if abs(step) < 1e-6 else None

    def _foot_anywhere(self, x_m: float, y_m: float) -> _Foot:
        offsets = self.points_xy - (x_m, y_m)
        nearest = self.knots_m[int(np.argmin(offsets[:, 0] ** 2 + offsets[:, 1] ** 2))]
        return self._foot(x_m, y_m, nearest) or (nearest, *self._derivatives(nearest)[:4])


def wrap_rad(angle_rad: float) -> float:
    """Return the same angle in (-pi, pi]."""
    wrapped = angle_rad % (2.0 * pi)
    return wrapped - 2.0 * pi if wrapped > pi else wrapped


def _thinned(points_xy: FloatArray) -> FloatArray:
    kept = [points_xy[0]]
    for point in points_xy[1:-1]:
        if hypot(*(point - kept[-1])) >= _MIN_SPACING_M:
            kept.append(point)
    last = points_xy[-1]
    while len(kept) > 1 and hypot(*(last - kept[-1])) < _MIN_SPACING_M:
        kept.pop()
    if hypot(*(last - kept[0])) < 1e-6 and len(kept) == 1:
        raise ValueError("a path needs two distinct points")
    return np.array([*kept, last])


def _spline(along_m: FloatArray, values: FloatArray) -> FloatArray:
    """Return coefficients (a, b, c, d) of each piece of the C2 cubic spline, curvature constant in its end pieces."""
    h, slope = np.diff(along_m), np.diff(values) / np.diff(along_m)
    count = len(values)
    if count == 2:
        return np.array([[values[0], slope[0], 0.0, 0.0]])
    # Unknown second derivatives m[1..n-2]; m[0] = m[1] and m[n-1] = m[n-2] (Thomas' algorithm on plain floats).
    diagonal = (2.0 * (h[:-1] + h[1:])).tolist()
    diagonal[0] += float(h[0])
    diagonal[-1] += float(h[-1])
    right = (6.0 * np.diff(slope)).tolist()
    off = h[1:-1].tolist()
    for i, between in enumerate(off):
        factor = between / diagonal[i]
        diagonal[i + 1] -= factor * between
        right[i + 1] -= factor * right[i]
    inner = [right[-1] / diagonal[-1]]
    for i in range(len(off) - 1, -1, -1):
        inner.append((right[i] - off[i] * inner[-1]) / diagonal[i])
    m = np.array([inner[-1], *reversed(inner), inner[0]])
    return np.column_stack(
        [values[:-1], slope - h * (2.0 * m[:-1] + m[1:]) / 6.0, m[:-1] / 2.0, np.diff(m) / (6.0 * h)]
    )


def _arc_lengths(along_m: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    half = 0.5 * np.diff(along_m)[:, None]
    t = half * (_GAUSS_NODES[None, :] + 1.0)
    speed = np.hypot(*(c[:, 1:2] + t * (2.0 * c[:, 2:3] + 3.0 * c[:, 3:4] * t) for c in (x, y)))
    lengths: FloatArray = (half * speed) @ _GAUSS_WEIGHTS
    return lengths
