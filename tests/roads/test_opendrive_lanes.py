"""Driving lanes: neighbours, width, limits, side of the road and what states them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from scenewright.roads import all_routes, find_route, load_map
from scenewright.roads.polyline import polyline_arc_lengths

from .conftest import OURS, READABLE, any_map


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
    assert [note for note in road_map.notes if not note.startswith("no speed limit is told")] == []


def test_limits_come_in_every_unit() -> None:
    town = any_map("carla/Town01")
    assert town.lanes["1.0.1"].speed_limit_mps == pytest.approx(25 * 0.44704)
    simple = any_map("esmini/simple_3way_intersection")
    assert all(lane.speed_limit_mps == pytest.approx(10.0) for lane in simple.lanes.values())


IN_ROAD = '<type s="100" type="town"><speed max="30" unit="km/h"/></type>\n    <planView>'
IN_LANES = '<speed sOffset="100" max="30" unit="km/h"/></lane>'


@pytest.mark.parametrize(("mark", "count", "told"), [("<planView>", 1, IN_ROAD), ("</lane>", 3, IN_LANES)])
def test_a_limit_holds_from_where_it_stands(tmp_path: Path, mark: str, count: int, told: str) -> None:
    """On the west arm, for whoever drives along it and for whoever comes the other way; nothing else changes."""
    source = tmp_path / "zone.xodr"
    source.write_text(OURS.replace(mark, told, count), encoding="utf-8")
    before, now = load_map("t_intersection"), load_map(source)
    for number in (1, -1):
        lanes = [now.lanes[f"1.{section}.{number}"] for section in (0, 1)]
        assert [lane.length_m for lane in lanes] == pytest.approx([100.0, 200.0])
        assert [lane.speed_limit_mps for lane in lanes] == pytest.approx([50 / 3.6, 30 / 3.6])
    assert {name for name in now.lanes if not name.startswith("1.1.")} == before.lanes.keys()
    for headings in (("E",), ("W",), ("E", "N"), ("S", "W")):
        old, new = (find_route(road_map, headings=headings) for road_map in (before, now))
        along = np.linspace(0.0, old.landmarks["route_end"], 300)
        assert np.allclose(old.path.poses(along), new.path.poses(along), atol=1e-3)
        assert new.landmarks == pytest.approx(old.landmarks, abs=1e-3)


def test_stop_lines_of_other_people_are_found() -> None:
    assert len(any_map("esmini/multi_intersections").stop_lines()) > 10


def test_left_hand_traffic_drives_on_the_left(tmp_path: Path) -> None:
    source = tmp_path / "left.xodr"
    roads = OURS.split("  <road ")
    lone = roads[0] + "  <road " + roads[1].replace("RHT", "LHT") + "</OpenDRIVE>"
    source.write_text(lone.replace('<successor elementType="junction" elementId="100"/>', ""), encoding="utf-8")
    for route in all_routes(load_map(source)):
        _, y, heading = route.path.pose(10.0)
        (lane,) = (load_map(source).lanes[name] for name in route.lanes)
        # The left edge is the verge, on the driver's left, and the road's middle is on the right.
        assert math.cos(heading) * y == pytest.approx(1.75)
        assert lane.left_edge_xy[0][1] == pytest.approx(2 * y)
        assert lane.right_edge_xy[0][1] == pytest.approx(0.0)


def test_lanes_stated_by_borders_are_those_stated_by_widths(tmp_path: Path) -> None:
    source = tmp_path / "borders.xodr"
    width = '<width sOffset="0" a="3.5" b="0" c="0" d="0"/>'
    text = OURS
    for side, border in (("<right>", "-3.5"), ("<left>", "3.5")):
        head, *rest = text.split(side)
        text = head + "".join(side + part.replace(width, width.replace("3.5", border), 1) for part in rest)
    source.write_text(text.replace("<width", "<border"), encoding="utf-8")
    ours = load_map("t_intersection")
    for lane_id, lane in load_map(source).lanes.items():
        assert lane.outline() == pytest.approx(ours.lanes[lane_id].outline())
