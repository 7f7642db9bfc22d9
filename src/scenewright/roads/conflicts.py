"""Where two routes meet: cross, merge or follow, and over which stretches two vehicles could touch there.

What enters: two routes on one map. What leaves: a `Conflict`, or None. Time and speed play no part here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scenewright.roads.path import Path
from scenewright.roads.polyline import FloatArray
from scenewright.roads.routes import Route

VEHICLE_LENGTH_M = 4.5
VEHICLE_WIDTH_M = 2.0
_SAMPLE_M = 1.0
_ZONE_STEP_M = 0.1
_ZONE_REACH_M = 60.0

Zone = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Conflict:
    """The place where two routes meet.

    Attributes
    ----------
    kind
        ``"crossing"``: the centre lines intersect. ``"merging"``: different starts, one end; the place is where the two
        become one. ``"following"``: one start; the place is where they part, or for equal routes where the junction
        begins (without a junction, where the route ends).
    s_a_m, s_b_m
        Arc lengths of the place on each route.
    zone_a_m, zone_b_m
        Arc lengths ``(low, high)`` of a vehicle's centre between which it could touch some vehicle on the other route
        around this place, for boxes of 4.5 m by 2.0 m. On a stretch that both share vehicles can touch everywhere:
        there the zone reaches one vehicle length beyond the place, after which one simply follows the other.
    """

    kind: Literal["crossing", "merging", "following"]
    s_a_m: float
    s_b_m: float
    x_m: float
    y_m: float
    zone_a_m: Zone
    zone_b_m: Zone

    def swapped(self) -> Conflict:
        """Return the same conflict seen from the other route."""
        return Conflict(self.kind, self.s_b_m, self.s_a_m, self.x_m, self.y_m, self.zone_b_m, self.zone_a_m)


@lru_cache(maxsize=1024)
def find_conflict(route_a: Route, route_b: Route) -> Conflict | None:
    """Return where two routes meet, None where they do not.

    Examples
    --------
    >>> from scenewright.roads import load_map, find_route
    >>> t = load_map("t_intersection")
    >>> find_conflict(find_route(t, headings=("S", "E")), find_route(t, headings=("W",))).kind
    'crossing'
    """
    if route_a.lanes == route_b.lanes:
        s_m = route_a.landmarks.get("junction_start", route_a.path.length_m)
        zone = (max(0.0, s_m - VEHICLE_LENGTH_M), min(route_a.path.length_m, s_m + VEHICLE_LENGTH_M))
        return _at("following", route_a, s_m, s_m, zone, zone)
    if route_a.lanes[0] == route_b.lanes[0]:
        return _parting(route_a, route_b)
    shared = _first_shared(route_a, route_b)
    if shared is not None:
        return _merging(route_a, route_b, *shared)
    return _crossing(route_a, route_b)


def shared_offset_m(route_a: Route, route_b: Route) -> float | None:
    """Return what to add to an arc length on `route_b` to compare it with one on `route_a`, on lanes that both take.

    Returns
    -------
    float or None
        0 for routes with the same first lane; None where they share no lane.
    """
    if route_a.lanes[0] == route_b.lanes[0]:
        return 0.0
    shared = _first_shared(route_a, route_b)
    return None if shared is None else shared[0] - shared[1]


def _first_shared(route_a: Route, route_b: Route) -> tuple[float, float] | None:
    """Return the arc lengths at which the first shared lane begins."""
    for name, start_m in zip(route_a.lanes, route_a.lane_starts_m, strict=True):
        if name in route_b.lanes:
            return start_m, route_b.lane_starts_m[route_b.lanes.index(name)]
    return None


def _at(
    kind: Literal["crossing", "merging", "following"], route: Route, s_a: float, s_b: float, zone_a: Zone, zone_b: Zone
) -> Conflict:
    x, y, _ = route.path.pose(s_a)
    return Conflict(kind, s_a, s_b, x, y, zone_a, zone_b)


def _parting(route_a: Route, route_b: Route) -> Conflict:
    same = 0
    while same < min(len(route_a.lanes), len(route_b.lanes)) and route_a.lanes[same] == route_b.lanes[same]:
        same += 1
    s_a, s_b = (
        route.lane_starts_m[same] if same < len(route.lanes) else route.path.length_m for route in (route_a, route_b)
    )
    zone_a, zone_b = _touching(route_a.path, route_b.path, s_a, s_b, back_m=VEHICLE_LENGTH_M, ahead_m=_ZONE_REACH_M)
    return _at("following", route_a, s_a, s_b, zone_a, zone_b)


def _merging(route_a: Route, route_b: Route, s_a: float, s_b: float) -> Conflict:
    zone_a, zone_b = _touching(route_a.path, route_b.path, s_a, s_b, back_m=_ZONE_REACH_M, ahead_m=VEHICLE_LENGTH_M)
    return _at("merging", route_a, s_a, s_b, zone_a, zone_b)


def _crossing(route_a: Route, route_b: Route) -> Conflict | None:
    place = _intersection(route_a.path, route_b.path)
    if place is None:
        return None
    zone_a, zone_b = _touching(route_a.path, route_b.path, *place, back_m=_ZONE_REACH_M, ahead_m=_ZONE_REACH_M)
    return _at("crossing", route_a, *place, zone_a, zone_b)


def _samples(path: Path) -> FloatArray:
    return np.linspace(0.0, path.length_m, max(2, int(np.ceil(path.length_m / _SAMPLE_M)) + 1))


def _intersection(path_a: Path, path_b: Path) -> tuple[float, float] | None:
    """Return the arc lengths of the first intersection along a: on chords, then on the curves by Newton's method."""
    s_a, s_b = _samples(path_a), _samples(path_b)
    points_a, points_b = path_a.poses(s_a)[:, :2], path_b.poses(s_b)[:, :2]
    step_a, step_b = np.diff(points_a, axis=0)[:, None, :], np.diff(points_b, axis=0)[None, :, :]
    between = points_b[None, :-1, :] - points_a[:-1, None, :]
    cross = step_a[..., 0] * step_b[..., 1] - step_a[..., 1] * step_b[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (between[..., 0] * step_b[..., 1] - between[..., 1] * step_b[..., 0]) / cross
        u = (between[..., 0] * step_a[..., 1] - between[..., 1] * step_a[..., 0]) / cross
        hits = np.argwhere((t >= 0.0) & (t <= 1.0) & (u >= 0.0) & (u <= 1.0))
    if not len(hits):
        return None
    i, j = hits[0].tolist()
    a = float(s_a[i] + t[i, j] * (s_a[i + 1] - s_a[i]))
    b = float(s_b[j] + u[i, j] * (s_b[j + 1] - s_b[j]))
    return _polished(path_a, path_b, a, b)


def _polished(path_a: Path, path_b: Path, a: float, b: float) -> tuple[float, float]:
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
        if abs(step_a) + abs(step_b) < 1e-9:
            break
    return a, b


def _touching(
    path_a: Path, path_b: Path, s_a: float, s_b: float, *, back_m: float, ahead_m: float
) -> tuple[Zone, Zone]:
    """Return the stretches around a place over which two vehicles, one on each path, could touch.

    Both stretches stay within the path and within `back_m` before and `ahead_m` behind the place. They are rounded
    outwards to the sampling step.
    """
    along = [
        np.arange(max(0.0, s - back_m), min(path.length_m, s + ahead_m) + 0.5 * _ZONE_STEP_M, _ZONE_STEP_M)
        for path, s in ((path_a, s_a), (path_b, s_b))
    ]
    poses = [path.poses(s) for path, s in zip((path_a, path_b), along, strict=True)]
    touch = _boxes_touch(*poses)
    touched_a: NDArray[np.bool_] = np.any(touch, axis=1)
    touched_b: NDArray[np.bool_] = np.any(touch, axis=0)
    return _stretch(touched_a, along[0], s_a), _stretch(touched_b, along[1], s_b)


def _stretch(touched: NDArray[np.bool_], along_m: FloatArray, s_m: float) -> Zone:
    """Return the unbroken touched stretch around `s_m`."""
    middle = int(np.argmin(np.abs(along_m - s_m)))
    low = high = middle
    while low > 0 and touched[low - 1]:
        low -= 1
    while high < len(along_m) - 1 and touched[high + 1]:
        high += 1
    step = _ZONE_STEP_M
    return max(float(along_m[0]), float(along_m[low]) - step), min(float(along_m[-1]), float(along_m[high]) + step)


def _boxes_touch(poses_a: FloatArray, poses_b: FloatArray) -> NDArray[np.bool_]:
    """Return whether the boxes of every pair of poses overlap (separating axes of both boxes), shape (A, B)."""
    half_length, half_width = 0.5 * VEHICLE_LENGTH_M, 0.5 * VEHICLE_WIDTH_M
    dx = poses_b[None, :, 0] - poses_a[:, None, 0]
    dy = poses_b[None, :, 1] - poses_a[:, None, 1]
    # Most pairs are far apart; only rows and columns with a near pair need the full test.
    near = dx * dx + dy * dy <= 4.0 * (half_length**2 + half_width**2)
    touch = np.zeros(near.shape, dtype=bool)
    rows, columns = np.flatnonzero(near.any(axis=1)), np.flatnonzero(near.any(axis=0))
    if not len(rows):
        return touch
    pairs = np.ix_(rows, columns)
    dx, dy, poses_a, poses_b = dx[pairs], dy[pairs], poses_a[rows], poses_b[columns]
    turned = poses_b[None, :, 2] - poses_a[:, None, 2]
    cos, sin = np.abs(np.cos(turned)), np.abs(np.sin(turned))
    reach_along = half_length + half_length * cos + half_width * sin
    reach_across = half_width + half_length * sin + half_width * cos
    overlap = np.ones(dx.shape, dtype=bool)
    for heading in (poses_a[:, None, 2], poses_b[None, :, 2]):
        overlap &= np.abs(dx * np.cos(heading) + dy * np.sin(heading)) <= reach_along
        overlap &= np.abs(-dx * np.sin(heading) + dy * np.cos(heading)) <= reach_across
    touch[pairs] = overlap
    return touch
