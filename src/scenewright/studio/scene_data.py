"""What the plan view draws of a map: lanes, stop lines, the actors' routes and their landmarks, in page coordinates.

What enters: a run's manifest and its trace. What leaves: plain lists of rounded numbers, relative to an origin near the
run so that a browser's single-precision drawing stays exact. It knows nothing of programs, verdicts or HTML.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from scenewright.errors import ScenewrightError
from scenewright.trace.model import ActorTrace, Trace

if TYPE_CHECKING:
    from scenewright.roads.model import Lane, RoadMap
    from scenewright.roads.path import Path

FloatArray = NDArray[np.float64]
Json = dict[str, Any]

_SURROUNDINGS_M = 150.0  # lanes farther from the run than this are left out: a town's map would not fit in a page
_DEVIATION_M = 0.02  # drawn lines stay this close to the map's
_BEFORE_M, _AFTER_M = 15.0, 40.0  # how much of a route is drawn before the run's first and behind its last position


@dataclass(frozen=True, slots=True)
class SceneGeometry:
    """The drawing's data.

    Attributes
    ----------
    origin_xy_m
        What was subtracted from all coordinates.
    roads
        Lanes, centre lines and stop lines as lists of points; None where the map cannot be read.
    routes, landmarks
        By actor name: ``[x, y, s]`` along its route, and ``{"name", "s", "x", "y", "heading"}`` of each landmark.
    problem
        Why there are no roads, in one sentence; None where there are.
    """

    origin_xy_m: tuple[float, float]
    roads: Json | None
    routes: dict[str, list[list[float]]]
    landmarks: dict[str, list[Json]]
    problem: str | None = None


def scene_geometry(manifest: Mapping[str, Any], trace: Trace) -> SceneGeometry:
    """Return what is to be drawn under the vehicles.

    Parameters
    ----------
    manifest
        The run's manifest; ``map``, ``routes`` and ``landmarks`` are read, any may be missing.
    trace
        The run's trace; it says which part of the map matters and where each route's arc length begins.
    """
    origin = _origin(trace)
    try:
        road_map = _load(manifest)
    except (ScenewrightError, OSError) as error:
        reason = getattr(error, "message", None) or str(error)
        return SceneGeometry(origin, None, {}, {}, f"the map could not be read ({reason}), so no roads are drawn")
    routes: dict[str, list[list[float]]] = {}
    landmarks: dict[str, list[Json]] = {}
    for name, actor in trace.actors.items():
        route = _route_of(road_map, manifest, name, actor)
        if route is None:
            continue
        path, shift_m = route
        routes[name] = _route_points(path, shift_m, actor, origin)
        marks = (manifest.get("landmarks") or {}).get(name) or {}
        landmarks[name] = _landmark_poses(path, shift_m, marks, origin)
    return SceneGeometry(origin, _roads(road_map, trace, origin), routes, landmarks)


def _load(manifest: Mapping[str, Any]) -> RoadMap:
    from scenewright.roads.load import load_map, shipped_maps

    described = manifest.get("map") or {}
    name = described.get("name")
    # A shipped map is found by its name wherever the package is installed; the file's path may be another machine's.
    if name in shipped_maps():
        return load_map(name)
    return load_map(described.get("file") or name or "")


def _origin(trace: Trace) -> tuple[float, float]:
    points = _visited(trace)
    if not len(points) or np.abs(points).max() < 5000.0:
        return 0.0, 0.0
    x, y = np.round(np.median(points, axis=0), -2)
    return float(x), float(y)


def _visited(trace: Trace) -> FloatArray:
    """Return all places where a vehicle was, shape (N, 2), without what is not a number."""
    points = np.vstack([np.column_stack([actor.x_m, actor.y_m]) for actor in trace.actors.values()])
    return points[np.isfinite(points).all(axis=1)]


def _route_of(
    road_map: RoadMap, manifest: Mapping[str, Any], name: str, actor: ActorTrace
) -> tuple[Path, float] | None:
    """Return the actor's path, and what to subtract from its route's arc length to get the path's."""
    from scenewright.roads.path import Path

    lane_ids = ((manifest.get("routes") or {}).get(name) or {}).get("lanes") or []
    lanes = [road_map.lanes[lane_id] for lane_id in lane_ids if lane_id in road_map.lanes]
    if not lanes:
        return None
    path = Path.from_points(_joined(lanes))
    # Where a route counts its arc length from is the route's own affair; the trace, which has both, tells.
    known = np.flatnonzero(np.isfinite(actor.x_m) & np.isfinite(actor.y_m) & np.isfinite(actor.s_m))
    if not known.size:
        return None
    chosen = known[np.linspace(0, known.size - 1, min(known.size, 15)).astype(int)]
    shifts = [actor.s_m[i] - path.to_frenet(float(actor.x_m[i]), float(actor.y_m[i]))[0] for i in chosen]
    return path, float(np.median(shifts))


def _joined(lanes: Sequence[Lane]) -> FloatArray:
    """Return the centre lines one after the other; of neighbouring lanes (a lane change) only the last is kept."""
    parts: list[FloatArray] = []
    for lane, after in zip(lanes, [*lanes[1:], None], strict=True):
        if after is not None and after.id in (lane.left_neighbor, lane.right_neighbor):
            continue
        parts.append(lane.centerline_xy)
    return np.vstack(parts)


def _route_points(path: Path, shift_m: float, actor: ActorTrace, origin: tuple[float, float]) -> list[list[float]]:
    passed = actor.s_m[np.isfinite(actor.s_m)]
    first = max(float(passed.min()) - _BEFORE_M - shift_m, 0.0)
    last = min(float(passed.max()) + _AFTER_M - shift_m, path.length_m)
    if last <= first:
        return []
    along = np.linspace(first, last, max(2, int(np.ceil(last - first)) + 1))
    points = _points(path.poses(along)[:, :2], origin)
    steps = [0.0, *(float(np.hypot(b[0] - a[0], b[1] - a[1])) for a, b in pairwise(points))]
    return [[x, y, round(first + shift_m + float(s), 2)] for (x, y), s in zip(points, np.cumsum(steps), strict=True)]


def _landmark_poses(path: Path, shift_m: float, marks: Mapping[str, Any], origin: tuple[float, float]) -> list[Json]:
    known = {name: float(s) for name, s in marks.items() if isinstance(s, int | float) and np.isfinite(s)}
    if not known:
        return []
    poses = path.poses(np.array(list(known.values())) - shift_m)
    return [
        {
            "name": name,
            "s": round(s, 3),
            "x": round(float(x) - origin[0], 3),
            "y": round(float(y) - origin[1], 3),
            "heading": round(float(heading), 4),
        }
        for (name, s), (x, y, heading) in zip(known.items(), poses, strict=True)
    ]


def _roads(road_map: RoadMap, trace: Trace, origin: tuple[float, float]) -> Json:
    visited = _visited(trace)
    low = visited.min(axis=0, initial=np.inf) - _SURROUNDINGS_M
    high = visited.max(axis=0, initial=-np.inf) + _SURROUNDINGS_M
    lanes, stop_lines = [], []
    for lane in road_map.lanes.values():
        outline = lane.outline()
        if (outline.max(axis=0) < low).any() or (outline.min(axis=0) > high).any():
            continue
        left, right = _points(lane.left_edge_xy, origin), _points(lane.right_edge_xy, origin)
        lanes.append(
            {
                "id": lane.id,
                "kind": lane.kind,
                "inside": lane.junction_id is not None,
                "left": left,
                "right": right,
                "centre": _points(lane.centerline_xy, origin),
            }
        )
        stop_line = lane.stop_line()
        if stop_line is not None:
            stop_lines.append(_points(stop_line, origin))
    return {"name": road_map.name, "lanes": lanes, "stop_lines": stop_lines}


def _points(points_xy: FloatArray, origin: tuple[float, float]) -> list[list[float]]:
    """Return a line with as few points as its shape needs, relative to the origin, in centimetres."""
    from shapely import LineString

    line = LineString(np.asarray(points_xy) - np.array(origin)).simplify(_DEVIATION_M)
    return [[round(float(x), 2), round(float(y), 2)] for x, y in line.coords]
