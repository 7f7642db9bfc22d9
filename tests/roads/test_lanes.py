"""The lane graph: links, neighbours, kinds, limits, stop lines and outlines."""

from __future__ import annotations

import numpy as np
import pytest
from shapely.geometry import Point, Polygon

from scenewright.roads import RoadMap, load_map, shipped_maps
from scenewright.roads.polyline import polyline_arc_lengths

from .conftest import FOREIGN, any_map

ALL_FOREIGN = sorted(str(p.relative_to(FOREIGN).with_suffix("")) for p in FOREIGN.glob("*/*.xodr"))
READABLE = ["t_intersection", *(name for name in ALL_FOREIGN if not name.startswith("malformed"))]


@pytest.mark.parametrize("name", READABLE)
def test_links_are_mutual_and_lane_ends_meet(name: str) -> None:
    lanes = any_map(name).lanes
    for lane in lanes.values():
        for after in (lanes[other] for other in lane.successors):
            assert lane.id in after.predecessors
            assert np.hypot(*(after.centerline_xy[0] - lane.centerline_xy[-1])) < 0.05
            assert abs(np.angle(np.exp(1j * (after.start_heading_rad - lane.end_heading_rad)))) < np.radians(15.0)
        for before in lane.predecessors:
            assert lane.id in lanes[before].successors


@pytest.mark.parametrize("name", READABLE)
def test_neighbours_lie_on_their_side_and_drive_the_same_way(name: str) -> None:
    lanes = any_map(name).lanes
    for lane in lanes.values():
        for neighbor, back, side in ((lane.left_neighbor, "right", 1.0), (lane.right_neighbor, "left", -1.0)):
            if neighbor is None:
                continue
            other = lanes[neighbor]
            assert getattr(other, f"{back}_neighbor") == lane.id
            middle = len(lane.centerline_xy) // 2
            ahead = lane.centerline_xy[middle] - lane.centerline_xy[middle - 1]
            aside = other.centerline_xy[middle] - lane.centerline_xy[middle]
            assert side * float(ahead[0] * aside[1] - ahead[1] * aside[0]) > 0.0


@pytest.mark.parametrize("name", READABLE)
def test_every_lane_is_measured(name: str) -> None:
    road_map = any_map(name)
    west, south, east, north = road_map.bounds
    for lane in road_map.lanes.values():
        assert lane.length_m == pytest.approx(polyline_arc_lengths(lane.centerline_xy)[-1])
        assert 0.5 <= lane.width_m <= 15.0
        assert not lane.centerline_xy.flags.writeable
        assert np.all((lane.outline() >= (west - 1e-9, south - 1e-9)) & (lane.outline() <= (east + 1e-9, north + 1e-9)))
    assert road_map.notes == ()


def test_our_map_is_what_it_says(t_map: RoadMap) -> None:
    assert "t_intersection" in shipped_maps()
    assert len(t_map.lanes) == 12
    arms = [lane for lane in t_map.lanes.values() if lane.junction_id is None]
    assert {lane.id: lane.length_m for lane in arms} == pytest.approx(
        {"1.0.1": 300, "1.0.-1": 300, "2.0.1": 300, "2.0.-1": 300, "3.0.1": 130, "3.0.-1": 130}
    )
    assert {lane.id for lane in arms if lane.kind == "driveway"} == {"3.0.1", "3.0.-1"}
    for lane in arms:
        assert lane.speed_limit_mps == pytest.approx((20 if lane.kind == "driveway" else 50) / 3.6)
        assert lane.width_m == pytest.approx(3.5)
    turns = sorted(str(lane.turn) for lane in t_map.lanes.values() if lane.junction_id is not None)
    assert turns == ["left", "left", "right", "right", "straight", "straight"]


def test_the_stop_line_crosses_the_driveway_exit(t_map: RoadMap) -> None:
    assert list(t_map.stop_lines()) == ["3.0.1"]
    assert t_map.lanes["3.0.1"].stop_line_s_m == pytest.approx(128.5)
    assert np.sort(t_map.stop_lines()["3.0.1"], axis=0) == pytest.approx(np.array([[-3.5, 15.5], [0.0, 15.5]]))


def test_outlines_hold_their_centre_lines(road_map: RoadMap) -> None:
    for lane_id, outline in road_map.lane_polygons().items():
        polygon = Polygon(outline)
        assert polygon.is_valid
        x, y = road_map.lanes[lane_id].centerline_xy[len(outline) // 4]
        assert polygon.contains(Point(x, y))
        left = Point(*road_map.lanes[lane_id].left_edge_xy[0])
        assert left.distance(Point(*outline[0])) == 0.0


def test_limits_come_in_every_unit() -> None:
    town = any_map("carla/Town01")
    assert town.lanes["1.0.1"].speed_limit_mps == pytest.approx(25 * 0.44704)
    simple = any_map("esmini/simple_3way_intersection")
    assert all(lane.speed_limit_mps == pytest.approx(10.0) for lane in simple.lanes.values())


def test_stop_lines_of_other_people_are_found() -> None:
    assert len(any_map("esmini/multi_intersections").stop_lines()) > 10


def test_a_map_is_read_once() -> None:
    assert load_map("t_intersection") is load_map("t_intersection")
