"""Conflict points and zones, against shapely's geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import affinity
from shapely.geometry import LineString, Point, box

from scenewright.roads import Conflict, RoadMap, Route, all_routes, find_conflict, find_route, shared_offset_m
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M

from .conftest import any_map


def line_of(route: Route) -> LineString:
    return LineString(route.path.poses(np.arange(0.0, route.path.length_m, 0.1))[:, :2])


def vehicle(route: Route, s_m: float):  # type: ignore[no-untyped-def]
    x, y, heading = route.path.pose(s_m)
    half_length, half_width = VEHICLE_LENGTH_M / 2, VEHICLE_WIDTH_M / 2
    body = box(-half_length, -half_width, half_length, half_width)
    return affinity.translate(affinity.rotate(body, heading, origin=(0, 0), use_radians=True), x, y)


def pairs(road_map: RoadMap) -> list[tuple[Route, Route]]:
    routes = all_routes(road_map)
    return [(a, b) for a in routes for b in routes if a is not b]


def test_crossings_are_where_the_lines_intersect(road_map: RoadMap) -> None:
    crossings = 0
    for a, b in pairs(road_map):
        conflict = find_conflict(a, b)
        if set(a.lanes) & set(b.lanes):
            assert conflict is not None
            assert conflict.kind != "crossing"
            continue
        meeting = line_of(a).intersection(line_of(b))
        assert (conflict is None) == meeting.is_empty
        if conflict is not None:
            crossings += 1
            assert conflict.kind == "crossing"
            assert meeting.distance(Point(conflict.x_m, conflict.y_m)) < 0.01
    assert crossings >= 6


def test_the_place_lies_on_both_routes(road_map: RoadMap) -> None:
    for a, b in pairs(road_map):
        conflict = find_conflict(a, b)
        if conflict is None:
            continue
        assert a.path.pose(conflict.s_a_m)[:2] == pytest.approx((conflict.x_m, conflict.y_m), abs=0.01)
        assert b.path.pose(conflict.s_b_m)[:2] == pytest.approx((conflict.x_m, conflict.y_m), abs=0.01)
        assert conflict.zone_a_m[0] < conflict.s_a_m < conflict.zone_a_m[1]
        assert conflict.zone_b_m[0] < conflict.s_b_m < conflict.zone_b_m[1]


def test_seen_from_the_other_route_it_is_the_same(t_map: RoadMap) -> None:
    for a, b in pairs(t_map):
        one, other = find_conflict(a, b), find_conflict(b, a)
        if one is None or other is None:
            assert one is other is None
            continue
        for field in Conflict.__slots__:
            assert getattr(one, field) == pytest.approx(getattr(other.swapped(), field), abs=0.11) or field == "kind"
        assert one.kind == other.kind


def test_outside_the_zone_nothing_touches(t_map: RoadMap) -> None:
    for a, b in pairs(t_map):
        conflict = find_conflict(a, b)
        if conflict is None or conflict.kind != "crossing":
            continue
        others = [vehicle(b, s) for s in np.arange(conflict.s_b_m - 25.0, conflict.s_b_m + 25.0, 0.25)]
        low, high = conflict.zone_a_m
        for s_m in (low - 0.01, high + 0.01, low - 5.0, high + 5.0):
            assert not any(vehicle(a, s_m).intersects(other) for other in others)
        for s_m in (low + 0.3, high - 0.3, conflict.s_a_m):
            assert any(vehicle(a, s_m).intersects(other) for other in others)


def test_a_right_angle_gives_the_zone_of_the_textbook() -> None:
    crossing = any_map("ncap/X-Intersection_NCAP")
    a, b = find_route(crossing, headings=("W",)), find_route(crossing, headings=("N",))
    conflict = find_conflict(a, b)
    assert conflict is not None
    reach_m = VEHICLE_LENGTH_M / 2 + VEHICLE_WIDTH_M / 2
    assert conflict.zone_a_m == pytest.approx((conflict.s_a_m - reach_m, conflict.s_a_m + reach_m), abs=0.21)


def test_merging_routes_become_one_at_the_place(road_map: RoadMap) -> None:
    merges = 0
    for a, b in pairs(road_map):
        conflict = find_conflict(a, b)
        if conflict is None or conflict.kind != "merging":
            continue
        merges += 1
        offset_m = shared_offset_m(a, b)
        assert offset_m == pytest.approx(conflict.s_a_m - conflict.s_b_m)
        for beyond_m in (0.5, 10.0):
            at_a = a.path.pose(conflict.s_a_m + beyond_m)[:2]
            at_b = b.path.pose(conflict.s_a_m + beyond_m - offset_m)[:2]
            assert math.dist(at_a, at_b) < 0.05
        assert math.dist(a.path.pose(conflict.s_a_m - 8)[:2], b.path.pose(conflict.s_b_m - 8)[:2]) > 0.2
        assert conflict.zone_a_m[1] == pytest.approx(conflict.s_a_m + VEHICLE_LENGTH_M, abs=0.11)
    assert merges >= 6


def test_following_routes_part_at_the_place(road_map: RoadMap) -> None:
    for a, b in pairs(road_map):
        conflict = find_conflict(a, b)
        if conflict is None or conflict.kind != "following":
            continue
        assert a.lanes[0] == b.lanes[0]
        assert shared_offset_m(a, b) == 0.0
        assert conflict.s_a_m == pytest.approx(conflict.s_b_m, abs=0.01)
        assert math.dist(a.path.pose(conflict.s_a_m - 1)[:2], b.path.pose(conflict.s_b_m - 1)[:2]) < 0.02
        assert math.dist(a.path.pose(conflict.s_a_m + 9)[:2], b.path.pose(conflict.s_b_m + 9)[:2]) > 0.5


def test_one_route_follows_itself_from_the_junction_on(t_map: RoadMap) -> None:
    route = find_route(t_map, headings=("S", "W"))
    conflict = find_conflict(route, route)
    assert conflict is not None
    assert conflict.kind == "following"
    assert conflict.s_a_m == route.landmarks["junction_start"]


def test_traffic_that_only_passes_by_has_no_conflict(t_map: RoadMap) -> None:
    west, east = find_route(t_map, headings=("W",)), find_route(t_map, headings=("E",))
    assert find_conflict(west, east) is None
    assert shared_offset_m(west, east) is None
    assert find_conflict(find_route(t_map, headings=("S", "W")), east) is None
