"""Sample the driving lanes of OpenDRIVE roads: centre line, edges, width, kind, speed limit, neighbours, stop line.

What enters: road records. What leaves: `Lane` objects that are not linked to each other yet (see `opendrive`).
"""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np

from scenewright.errors import MapError, Place
from scenewright.roads.model import Lane, LaneKind
from scenewright.roads.opendrive_records import LaneRecord, RoadRecord, SectionRecord, evaluate_cubics
from scenewright.roads.polyline import FloatArray, polyline_arc_lengths, turn_of
from scenewright.roads.reference_line import poses_along

DRIVING_TYPES = frozenset({"driving", "entry", "exit", "onRamp", "offRamp", "connectingRamp"})
_DRIVEWAY_TYPES = frozenset({"lowSpeed", "townPrivate"})
_DRIVEWAY_NAME = re.compile(r"drive\s?way|parking|car\s?park|service", re.IGNORECASE)
_STEP_CURVED_M = 0.5
_STEP_STRAIGHT_M = 2.0
_NARROWEST_M = 0.5
# What is shorter has no direction to speak of; traffic passes over it (`opendrive` joins what lies before and behind).
SHORTEST_M = 0.01
_LARGEST_COORDINATE_M = 1e8


def lane_id(road_id: str, section: int, number: int) -> str:
    """Return the id a lane has everywhere: road, section, lane."""
    return f"{road_id}.{section}.{number}"


def runs_along(road: RoadRecord, number: int) -> bool:
    """Whether traffic on the lane drives in the direction of growing s."""
    return (number < 0) == road.right_hand


def driving_lanes(road: RoadRecord, map_name: str) -> list[Lane]:
    """Sample all driving lanes of a road, but those of sections too short to drive in.

    Raises
    ------
    MapError
        If a driving lane has no width, or lies nowhere on earth.
    """
    if not any(record.type in DRIVING_TYPES for section in road.sections for record in section.lanes):
        return []
    if not road.geometries and road.length_m >= SHORTEST_M:
        raise MapError(
            f"road {road.id!r} has driving lanes but no reference line",
            place=Place(map_name, line=road.line),
            found="an empty <planView>",
            expected="at least one <geometry>",
            fix="export the map with its geometry",
        )
    return [
        lane
        for index, section in enumerate(road.sections)
        if section.end_m - section.start_m >= SHORTEST_M
        for lane in _section_lanes(road, index, section, map_name)
    ]


def _section_lanes(road: RoadRecord, index: int, section: SectionRecord, map_name: str) -> list[Lane]:
    s_m = _sample_points(road, section)
    poses = poses_along(road.geometries, s_m)
    offset = evaluate_cubics(road.lane_offsets, s_m)
    lanes: dict[int, Lane] = {}
    for side in (1, -1):
        inner = offset
        for record in sorted((r for r in section.lanes if r.number * side > 0), key=lambda r: abs(r.number)):
            outer = _outer_edge(record, side, offset, inner, s_m - section.start_m, map_name)
            _check_place(road, np.column_stack([poses, outer]), record.line, map_name)
            if record.type in DRIVING_TYPES and float(np.max(np.abs(outer - inner))) >= _NARROWEST_M:
                lanes[record.number] = _lane(road, index, section, record, s_m, poses, inner, outer)
            inner = outer
    return [_with_neighbors(road, number, lanes) for number in lanes]


def _check_place(road: RoadRecord, places_m: FloatArray, line: int, map_name: str) -> None:
    if not np.all(np.abs(places_m) <= _LARGEST_COORDINATE_M):
        raise MapError(
            f"road {road.id!r} leaves the earth",
            place=Place(map_name, line=line),
            found=f"a place or a turn beyond {_LARGEST_COORDINATE_M:g} (m, rad)",
            expected="a road of a place, a curvature and a width that can be driven",
            fix="correct the road's <planView> and the width of its lanes, or export the map again",
        )


def _sample_points(road: RoadRecord, section: SectionRecord) -> FloatArray:
    """Sample densely where anything bends, and always at the places where a polynomial changes."""
    breaks = {section.start_m, section.end_m}
    breaks.update(geometry.s_m for geometry in road.geometries)
    breaks.update(cubic.start_m for cubic in road.lane_offsets)
    for lane in section.lanes:
        breaks.update(section.start_m + cubic.start_m for cubic in (*lane.widths, *lane.borders))
    inside = sorted(s for s in breaks if section.start_m <= s <= section.end_m)
    bends = any(cubic.b or cubic.c or cubic.d for cubic in road.lane_offsets) or any(
        cubic.b or cubic.c or cubic.d for lane in section.lanes for cubic in (*lane.widths, *lane.borders)
    )
    starts = [geometry.s_m for geometry in road.geometries]
    points: list[float] = []
    for low, high in pairwise(inside):
        if high - low < 1e-6:
            continue
        piece = road.geometries[max(0, int(np.searchsorted(starts, low + 1e-6)) - 1)]
        step = _STEP_STRAIGHT_M if piece.shape == "line" and not bends else _STEP_CURVED_M
        points.extend(np.linspace(low, high, max(2, int(np.ceil((high - low) / step)) + 1))[:-1])
    return np.array([*points, section.end_m])


def _outer_edge(
    record: LaneRecord, side: int, offset: FloatArray, inner: FloatArray, ds_m: FloatArray, map_name: str
) -> FloatArray:
    if record.widths:
        # A fitted taper may dip a little below zero; edges must never cross.
        width: FloatArray = np.maximum(evaluate_cubics(record.widths, ds_m), 0.0)
        return inner + side * width
    if record.borders:
        return offset + evaluate_cubics(record.borders, ds_m)
    if record.type not in DRIVING_TYPES:
        return inner
    raise MapError(
        f"driving lane {record.number} has no width",
        place=Place(map_name, line=record.line),
        found="neither <width> nor <border>",
        expected="at least one <width>",
        fix="give the lane a width or export the map again",
    )


def _lane(
    road: RoadRecord,
    index: int,
    section: SectionRecord,
    record: LaneRecord,
    s_m: FloatArray,
    poses: FloatArray,
    inner: FloatArray,
    outer: FloatArray,
) -> Lane:
    normal = np.column_stack([-np.sin(poses[:, 2]), np.cos(poses[:, 2])])
    center, near, far = (poses[:, :2] + t[:, None] * normal for t in (0.5 * (inner + outer), inner, outer))
    along = runs_along(road, record.number)
    if not along:
        center, near, far = center[::-1], near[::-1], far[::-1]
    left, right = (near, far) if road.right_hand else (far, near)
    length_m = float(polyline_arc_lengths(center)[-1])
    limits = [item.speed_limit_mps for item in road.types if item.start_m <= section.start_m + 1e-6]
    limit = record.speed_limit_mps if record.speed_limit_mps is not None else (limits[-1] if limits else None)
    for array in (center, left, right):
        array.flags.writeable = False
    return Lane(
        id=lane_id(road.id, index, record.number),
        road_id=road.id,
        kind=_kind(road, section),
        turn=None if road.junction_id is None else turn_of(center),
        junction_id=road.junction_id,
        centerline_xy=center,
        left_edge_xy=left,
        right_edge_xy=right,
        width_m=float(np.max(np.abs(outer - inner))),
        length_m=length_m,
        speed_limit_mps=limit,
        stop_line_s_m=_stop_line_s_m(road, section, record.number, s_m, center),
    )


def _kind(road: RoadRecord, section: SectionRecord) -> LaneKind:
    if road.user_kind in ("road", "driveway"):
        return "driveway" if road.user_kind == "driveway" else "road"
    types = [item.type for item in road.types if item.start_m <= section.start_m + 1e-6]
    slow = bool(types) and types[-1] in _DRIVEWAY_TYPES
    return "driveway" if slow or _DRIVEWAY_NAME.search(road.name) else "road"


def _stop_line_s_m(
    road: RoadRecord, section: SectionRecord, number: int, s_m: FloatArray, center: FloatArray
) -> float | None:
    along = runs_along(road, number)
    arc_m = polyline_arc_lengths(center)
    found = []
    for line in road.stop_lines:
        holds = line.along if along else line.against
        if line.lanes is not None:
            holds = holds and min(line.lanes) <= number <= max(line.lanes)
        if holds and section.start_m <= line.s_m <= section.end_m:
            found.append(float(np.interp(line.s_m, s_m, arc_m if along else arc_m[::-1])))
    return max(found, default=None)


def _with_neighbors(road: RoadRecord, number: int, lanes: dict[int, Lane]) -> Lane:
    side = 1 if number > 0 else -1
    inward = lanes.get(number - side)
    outward = lanes.get(number + side)
    left, right = (inward, outward) if road.right_hand else (outward, inward)
    return replace(
        lanes[number],
        left_neighbor=None if left is None else left.id,
        right_neighbor=None if right is None else right.id,
    )
