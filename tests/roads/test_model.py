"""Lanes and maps as data: headings, outlines, stop lines, bounds."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from shapely.geometry import Point, Polygon

from scenewright.roads.model import Lane, RoadMap
from scenewright.roads.polyline import polyline_arc_lengths


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


def lane(points: list[tuple[float, float]], half_m: float = 1.75, **more: object) -> Lane:
    centre = np.array(points)
    ahead = np.diff(centre, axis=0)[0] / np.hypot(*np.diff(centre, axis=0)[0])
    aside = half_m * np.array([-ahead[1], ahead[0]])
    length_m = float(polyline_arc_lengths(centre)[-1])
    values = {"kind": "road", "turn": None, "junction_id": None, **more}
    return Lane("1.0.-1", "1", **values, centerline_xy=centre, left_edge_xy=centre + aside,
                right_edge_xy=centre - aside, width_m=2 * half_m, length_m=length_m)  # type: ignore[arg-type]  # fmt: skip


def test_a_lane_is_headed_as_its_first_and_last_pieces_are() -> None:
    bent = lane([(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)])
    assert bent.start_heading_rad == 0.0
    assert bent.end_heading_rad == pytest.approx(np.pi / 2)


def test_a_stop_line_lies_across_where_its_arc_length_says() -> None:
    assert lane([(0.0, 0.0), (0.0, 20.0)]).stop_line() is None
    line = lane([(0.0, 0.0), (0.0, 20.0)], stop_line_s_m=18.5).stop_line()
    assert line == pytest.approx(np.array([[-1.75, 18.5], [1.75, 18.5]]))  # left, right as the driver sees it


def test_a_map_says_what_its_lanes_say() -> None:
    lanes = {
        "a": lane([(0.0, 0.0), (10.0, 0.0)]),
        "b": lane([(10.0, 0.0), (20.0, 0.0)], junction_id="7", stop_line_s_m=4.0),
        "c": lane([(10.0, 0.0), (20.0, 3.0)], junction_id="7"),
    }
    road_map = RoadMap("made", Path("made.xodr"), lanes)
    assert list(road_map.stop_lines()) == ["b"]
    assert road_map.bounds[:3] == (0.0, -1.75, pytest.approx(20.0, abs=0.6))
    assert lanes["a"].outline() == pytest.approx(np.array([[0, 1.75], [10, 1.75], [10, -1.75], [0, -1.75]]))
