"""Where vehicles were on the map: whether they drove their route, and whether they touched.

What enters: a route and the trace of a vehicle, or a whole trace. What leaves: the worst of each measure, and the first
moment at which two boxes overlapped. Nothing here knows what a row asks for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.roads import Route
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.trace.model import ActorTrace, Trace

FloatArray = NDArray[np.float64]

MAX_OFFSET_M = 1.0
MAX_ANGLE_RAD = 0.5
MAX_BACK_M = 0.05
_MOVING_MPS = 0.5
_PARTS = 5  # instants looked at in each sample interval


@dataclass(frozen=True, slots=True)
class Worst:
    """The worst of one measure over the run, and what it may be."""

    id: str
    text: str
    limit: float
    measured: float


def route_errors(route: Route, states: ActorTrace) -> list[Worst]:
    """Return how far a vehicle was from its route: beside it, turned away from it, backwards along it."""
    expected = route.path.poses(states.s_m)
    beside = np.hypot(states.x_m - expected[:, 0], states.y_m - expected[:, 1])
    moving = states.speed_mps > _MOVING_MPS
    angle = np.abs(np.angle(np.exp(1j * (states.heading_rad - expected[:, 2]))))
    back = np.maximum.accumulate(states.s_m) - states.s_m
    way = np.hypot(states.x_m[-1] - states.x_m[0], states.y_m[-1] - states.y_m[0])
    made = states.s_m[-1] - states.s_m[0]
    return [
        Worst("line", "is where its route is", MAX_OFFSET_M, float(beside.max())),
        Worst("heading", "is headed as its route", MAX_ANGLE_RAD, float(angle[moving].max(initial=0.0))),
        Worst("progress", "never goes back along its route", MAX_BACK_M, float(back.max())),
        Worst("way", "comes no further than along its route", MAX_OFFSET_M, float(max(0.0, way - made))),
    ]


def first_overlap_s(trace: Trace, until_s: float) -> float | None:
    """Return the first moment up to `until_s` at which the boxes of ego and hero overlap, or None."""
    import shapely

    times = trace.time_s
    instants = np.interp(np.linspace(0, len(times) - 1, _PARTS * (len(times) - 1) + 1), np.arange(len(times)), times)
    instants = instants[instants <= until_s]
    centres = {name: _poses(trace.actors[name], instants) for name in ("ego", "hero")}
    apart = np.hypot(*(centres["ego"][:, :2] - centres["hero"][:, :2]).T)
    near = np.flatnonzero(apart < np.hypot(VEHICLE_LENGTH_M, VEHICLE_WIDTH_M))
    if not len(near):
        return None
    ego, hero = (shapely.polygons(_corners(centres[name][near])) for name in ("ego", "hero"))
    touching = near[shapely.area(shapely.intersection(ego, hero)) > 1e-6]
    return float(instants[touching[0]]) if len(touching) else None


def _poses(states: ActorTrace, instants: FloatArray) -> FloatArray:
    columns = (states.x_m, states.y_m, np.unwrap(states.heading_rad))
    return np.column_stack([np.interp(instants, states.time_s, column) for column in columns])


def _corners(poses: FloatArray) -> FloatArray:
    half = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * (0.5 * VEHICLE_LENGTH_M, 0.5 * VEHICLE_WIDTH_M)
    cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    turn = np.stack([np.stack([cos, -sin], -1), np.stack([sin, cos], -1)], -2)
    corners: FloatArray = poses[:, None, :2] + np.einsum("nij,kj->nki", turn, half)
    return corners
