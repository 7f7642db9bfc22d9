"""Reference-line geometry of OpenDRIVE: points and headings of line, arc, spiral, poly3 and paramPoly3.

What enters: `Geometry` records. What leaves: positions and headings at given distances. It knows nothing of lanes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from scenewright.roads.polyline import FloatArray

Shape = Literal["line", "arc", "spiral", "poly3", "paramPoly3"]

_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, slots=True)
class Geometry:
    """One piece of a road's reference line.

    `values` depends on the shape: arc: curvature; spiral: curvature at start and end; poly3: a b c d;
    paramPoly3: aU bU cU dU aV bV cV dV and the parameter's value at the end of the piece.
    """

    s_m: float
    x_m: float
    y_m: float
    heading_rad: float
    length_m: float
    shape: Shape
    values: tuple[float, ...]
    line: int

    def poses(self, along_m: FloatArray) -> FloatArray:
        """Return ``x, y, heading`` at distances from the piece's start, shape (N, 3)."""
        u, v, turned = _LOCAL[self.shape](self, np.asarray(along_m, dtype=float))
        cos, sin = np.cos(self.heading_rad), np.sin(self.heading_rad)
        return np.column_stack(
            [self.x_m + u * cos - v * sin, self.y_m + u * sin + v * cos, self.heading_rad + turned],
        )


def poses_along(geometries: tuple[Geometry, ...], s_m: FloatArray) -> FloatArray:
    """Return ``x, y, heading`` of a whole reference line at road coordinates `s_m`, shape (N, 3)."""
    starts = np.array([geometry.s_m for geometry in geometries])
    index = np.clip(np.searchsorted(starts, s_m + 1e-9, side="right") - 1, 0, len(geometries) - 1)
    poses = np.empty((len(s_m), 3))
    for number in sorted(set(index.tolist())):  # np.unique would load numpy's masked arrays, which takes longer
        chosen = index == number
        poses[chosen] = geometries[number].poses(s_m[chosen] - starts[number])
    return poses


_Local = tuple[FloatArray, FloatArray, FloatArray]


def _line(_: Geometry, along_m: FloatArray) -> _Local:
    zero = np.zeros_like(along_m)
    return along_m, zero, zero


def _arc(geometry: Geometry, along_m: FloatArray) -> _Local:
    (curvature,) = geometry.values
    if abs(curvature) < 1e-12:
        return _line(geometry, along_m)
    turned = curvature * along_m
    return np.sin(turned) / curvature, (1.0 - np.cos(turned)) / curvature, turned


def _spiral(geometry: Geometry, along_m: FloatArray) -> _Local:
    start, end = geometry.values
    rate = (end - start) / geometry.length_m

    def heading(t: FloatArray) -> FloatArray:
        return start * t + 0.5 * rate * t * t

    def integrals(begin: FloatArray, end_m: FloatArray) -> FloatArray:
        """Return the ways in x and y over many short stretches, shape (N, 2)."""
        half = 0.5 * (end_m - begin)
        angles = heading(begin[:, None] + half[:, None] * (_GAUSS_NODES + 1.0)[None, :])
        return half[:, None] * np.column_stack([np.cos(angles) @ _GAUSS_WEIGHTS, np.sin(angles) @ _GAUSS_WEIGHTS])

    # Fresnel integrals by Gauss quadrature on short panels: exact to rounding, without scipy's start-up. The whole
    # panels before a place are summed up once.
    edges = np.linspace(0.0, geometry.length_m, max(1, int(np.ceil(geometry.length_m / 2.0))) + 1)
    before = np.vstack([np.zeros((1, 2)), np.cumsum(integrals(edges[:-1], edges[1:]), axis=0)])
    panel = np.clip(np.searchsorted(edges, along_m, side="right") - 1, 0, len(edges) - 2)
    ways = before[panel] + integrals(edges[panel], along_m)
    return ways[:, 0], ways[:, 1], heading(along_m)


def _poly3(geometry: Geometry, along_m: FloatArray) -> _Local:
    a, b, c, d = geometry.values
    # s is measured along the curve but v is a function of u, so u(s) comes from inverting the arc length.
    grid = np.linspace(0.0, geometry.length_m, max(101, int(geometry.length_m * 20)))
    speed = np.hypot(1.0, b + 2 * c * grid + 3 * d * grid**2)
    arc = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(grid))])
    u = np.interp(along_m, arc, grid)
    return u, a + b * u + c * u**2 + d * u**3, np.arctan(b + 2 * c * u + 3 * d * u**2)


def _param_poly3(geometry: Geometry, along_m: FloatArray) -> _Local:
    a_u, b_u, c_u, d_u, a_v, b_v, c_v, d_v, end = geometry.values
    p = along_m * (end / geometry.length_m)
    u = a_u + b_u * p + c_u * p**2 + d_u * p**3
    v = a_v + b_v * p + c_v * p**2 + d_v * p**3
    du = b_u + 2 * c_u * p + 3 * d_u * p**2
    dv = b_v + 2 * c_v * p + 3 * d_v * p**2
    return u, v, np.arctan2(dv, du)


_LOCAL: dict[Shape, Callable[[Geometry, FloatArray], _Local]] = {
    "line": _line,
    "arc": _arc,
    "spiral": _spiral,
    "poly3": _poly3,
    "paramPoly3": _param_poly3,
}
