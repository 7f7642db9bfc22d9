"""Oriented boxes in motion: overlap, distance, time to collision.

What enters: poses as arrays, and box sizes. What leaves: arrays. It knows nothing of actors' names or programs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.judge.case import Box
from scenewright.judge.tolerance import FloatArray
from scenewright.trace.model import ActorTrace

_HORIZON_S, _STILL_MPS = 8.0, 1e-9
# Between two samples a pose is no further from the straight line than this acceleration of any point of a box bends
# it: more than brakes, bends and turns of the car about itself come to together. And into how many parts it is cut.
_BENT_MPSS, _PARTS = 25.0, 40


@dataclass(frozen=True, slots=True, eq=False)
class MovingBox:
    """A box and its poses over time; arrays of one shape."""

    box: Box
    x_m: FloatArray
    y_m: FloatArray
    heading_rad: FloatArray
    speed_mps: FloatArray

    def at(self, index: NDArray[np.bool_ | np.intp]) -> MovingBox:
        """Return the poses that an index or mask picks."""
        return MovingBox(self.box, self.x_m[index], self.y_m[index], self.heading_rad[index], self.speed_mps[index])

    def corners(self) -> FloatArray:
        """Return the corners in order around the box, shape (N, 4, 2)."""
        along = np.array([0.5, 0.5, -0.5, -0.5]) * self.box.length_m
        across = np.array([0.5, -0.5, -0.5, 0.5]) * self.box.width_m
        cos, sin = np.cos(self.heading_rad)[:, None], np.sin(self.heading_rad)[:, None]
        x = self.x_m[:, None] + cos * along - sin * across
        y = self.y_m[:, None] + sin * along + cos * across
        return np.stack([x, y], axis=-1)


def moving_box(states: ActorTrace, box: Box, time_s: FloatArray) -> MovingBox:
    """Return the box of an actor at any instants, poses interpolated linearly."""
    heading = np.unwrap(states.heading_rad)
    values = (np.interp(time_s, states.time_s, v) for v in (states.x_m, states.y_m, heading, states.speed_mps))
    return MovingBox(box, *values)


def reach_m(a: Box, b: Box) -> float:
    """Return the distance of centres (m) beyond which two boxes cannot touch."""
    return 0.5 * float(np.hypot(a.length_m, a.width_m) + np.hypot(b.length_m, b.width_m))


def overlapping(a: MovingBox, b: MovingBox) -> NDArray[np.bool_]:
    """Return where two boxes overlap (separating axes), shape (N,)."""
    near = np.hypot(a.x_m - b.x_m, a.y_m - b.y_m) <= reach_m(a.box, b.box)
    result = np.zeros(len(a.x_m), dtype=bool)
    if near.any():
        result[near] = _boxes_overlap(a.at(near), b.at(near))
    return result


def _boxes_overlap(a: MovingBox, b: MovingBox) -> NDArray[np.bool_]:
    x, y = b.x_m - a.x_m, b.y_m - a.y_m
    overlap = np.ones(len(x), dtype=bool)
    for cos, sin, half in _axes(a, b):
        overlap &= np.abs(x * cos + y * sin) < half
    return overlap


def _axes(a: MovingBox, b: MovingBox) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
    """Yield the four directions along which two boxes are apart if they are, and the half extents of both together."""
    for own, other in ((a, b), (b, a)):
        cos, sin = np.cos(own.heading_rad), np.sin(own.heading_rad)
        turned = other.heading_rad - own.heading_rad
        along, across = np.abs(np.cos(turned)), np.abs(np.sin(turned))
        length, width = other.box.length_m, other.box.width_m
        yield cos, sin, 0.5 * (own.box.length_m + length * along + width * across)
        yield -sin, cos, 0.5 * (own.box.width_m + length * across + width * along)


def distances_m(a: MovingBox, b: MovingBox) -> FloatArray:
    """Return the distance between two boxes, 0 where they overlap, shape (N,)."""
    corners_a, corners_b = a.corners(), b.corners()
    apart = np.minimum(_corner_to_edge(corners_a, corners_b), _corner_to_edge(corners_b, corners_a))
    return np.where(overlapping(a, b), 0.0, apart)


def closest_m(a: MovingBox, b: MovingBox) -> tuple[float, int]:
    """Return the least distance (m) between two boxes and the index at which they have it."""
    centres = np.hypot(a.x_m - b.x_m, a.y_m - b.y_m)
    # Boxes are no further apart than their centres, and no nearer than that less their reach.
    candidates = np.flatnonzero(centres <= centres.min() + reach_m(a.box, b.box))
    distances = distances_m(a.at(candidates), b.at(candidates))
    best = int(np.argmin(distances))
    return float(distances[best]), int(candidates[best])


def surely_apart_m(a: ActorTrace, b: ActorTrace, boxes: tuple[Box, Box]) -> float:
    """Return a distance (m) that two boxes keep at every moment of two traces, between their samples too.

    No point of a box moves further than its centre and its turn carry it: between two moments the distance is at least
    half of what it is at both together, less half of the way that both may come towards each other in between.
    """
    bound, nearest = _between_m(a, b, boxes, a.time_s)
    close = np.flatnonzero(bound <= nearest)
    steps = np.diff(a.time_s)
    inside = a.time_s[close, None] + steps[close, None] * np.linspace(0.0, 1.0, _PARTS + 1)
    fine = [_between_m(a, b, boxes, times)[0].min() for times in inside]
    bent_m = 2.0 * _BENT_MPSS * float(steps.max(initial=0.0)) ** 2 / 8.0
    return min([nearest, *map(float, fine)]) - bent_m


def _between_m(a: ActorTrace, b: ActorTrace, boxes: tuple[Box, Box], times: FloatArray) -> tuple[FloatArray, float]:
    """Return what the distance is at least between each two of some instants, and the least at the instants."""
    one, other = (moving_box(states, box, times) for states, box in zip((a, b), boxes, strict=True))
    apart = distances_m(one, other)
    ways = [
        np.hypot(np.diff(m.x_m), np.diff(m.y_m)) + np.abs(np.diff(m.heading_rad)) * m.box.reach_m()
        for m in (one, other)
    ]
    return 0.5 * (apart[1:] + apart[:-1] - ways[0] - ways[1]), float(apart.min())


def _corner_to_edge(points: FloatArray, polygon: FloatArray) -> FloatArray:
    start, end = polygon[:, None, :, :], np.roll(polygon, -1, axis=1)[:, None, :, :]
    edge = end - start
    offset = points[:, :, None, :] - start
    share = np.clip((offset * edge).sum(-1) / (edge * edge).sum(-1), 0.0, 1.0)
    gap = np.hypot(*np.moveaxis(offset - share[..., None] * edge, -1, 0))
    return np.asarray(gap.min(axis=(1, 2)), dtype=np.float64)


def times_to_collision_s(a: MovingBox, b: MovingBox) -> FloatArray:
    """Return when the boxes would touch if both kept speed and heading, infinite beyond 8 s, shape (N,).

    It is exact: along each axis that could separate them both keep their extent and close at an even speed, so they
    overlap along it in one interval of time, and overlap while they do so along all four.
    """
    x, y = b.x_m - a.x_m, b.y_m - a.y_m
    closing_x = a.speed_mps * np.cos(a.heading_rad) - b.speed_mps * np.cos(b.heading_rad)
    closing_y = a.speed_mps * np.sin(a.heading_rad) - b.speed_mps * np.sin(b.heading_rad)
    enters, leaves = np.zeros(len(x)), np.full(len(x), np.inf)
    for cos, sin, half in _axes(a, b):
        apart, closing = x * cos + y * sin, closing_x * cos + closing_y * sin
        closes = np.abs(closing) > _STILL_MPS  # who does not is there always or never
        meets, lasts = apart / np.where(closes, closing, 1.0), half / np.where(closes, np.abs(closing), 1.0)
        enters = np.maximum(enters, np.where(closes, meets - lasts, np.where(np.abs(apart) < half, 0.0, np.inf)))
        leaves = np.minimum(leaves, np.where(closes, meets + lasts, np.inf))
    return np.where((enters < leaves) & (enters <= _HORIZON_S), enters, np.inf)
