"""Overlap, time to collision and post-encroachment time in small steps, to hold the judge's own against.

Boxes are polygons here, and whether two of them overlap is asked of the normals of all their edges.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scenewright.judge.boxes import MovingBox, moving_box
from scenewright.judge.case import Box
from scenewright.trace.model import ActorTrace, FloatArray


def larger(box: Box, by_m: float) -> Box:
    """Return a box that reaches so much further on every side, or less far."""
    return Box(box.length_m + 2.0 * by_m, box.width_m + 2.0 * by_m)


def touch(a: FloatArray, b: FloatArray) -> NDArray[np.bool_]:
    """Whether two polygons overlap, each (N, 4, 2): only of those that reach so far is it asked."""
    middles = [polygon.mean(axis=1) for polygon in (a, b)]
    reach_m = sum(
        np.linalg.norm(each - middle[:, None], axis=2).max(1) for each, middle in zip((a, b), middles, strict=True)
    )
    near = np.linalg.norm(middles[0] - middles[1], axis=1) <= reach_m
    a, b = a[near], b[near]
    together = np.ones(len(a), dtype=bool)
    for polygon in (a, b):
        edges = np.roll(polygon, -1, axis=1) - polygon
        for edge in np.moveaxis(edges, 1, 0):
            normal = np.stack([-edge[:, 1], edge[:, 0]], axis=-1)
            of_a, of_b = np.einsum("nij,nj->ni", a, normal), np.einsum("nij,nj->ni", b, normal)
            together &= (of_a.max(1) > of_b.min(1)) & (of_b.max(1) > of_a.min(1))
    near[near] = together
    return near


def collision_s(a: MovingBox, b: MovingBox, step_s: float, horizon_s: float = 8.0) -> float:
    """Return when two boxes first touch if each of them keeps its speed and heading; infinite where they do not."""
    later_s = np.arange(0.0, horizon_s, step_s)

    def driven(moving: MovingBox) -> FloatArray:
        ahead = np.array([np.cos(moving.heading_rad[0]), np.sin(moving.heading_rad[0])])
        return moving.corners() + (moving.speed_mps[0] * later_s[:, None] * ahead)[:, None, :]

    hits = np.flatnonzero(touch(driven(a), driven(b)))
    return float(later_s[hits[0]]) if len(hits) else np.inf


def encroachment_s(a: ActorTrace, b: ActorTrace, boxes: tuple[Box, Box], most_s: float = np.inf) -> float:
    """Return the least time between two evenly spaced samples at which boxes overlap; infinite beyond `most_s`."""
    of_a, of_b = (moving_box(each, box, each.time_s).corners() for each, box in zip((a, b), boxes, strict=True))
    count, step_s = len(of_a), float(a.time_s[1] - a.time_s[0])
    for lag in range(min(count, int(min(most_s, 1e6) / step_s) + 1)):
        if touch(of_a[: count - lag], of_b[lag:]).any() or touch(of_a[lag:], of_b[: count - lag]).any():
            return lag * step_s
    return np.inf
