"""The lane graph: links are mutual, lane ends meet, and what does not meet is not joined."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from scenewright.roads import RoadMap, load_map, shipped_maps

from .conftest import OURS, READABLE, any_map


def test_lanes_that_do_not_meet_are_not_joined_and_noted(tmp_path: Path) -> None:
    source = tmp_path / "moved.xodr"
    source.write_text(OURS.replace('x="-314.0000000000"', 'x="-334.0000000000"', 1), encoding="utf-8")
    road_map = load_map(source)
    assert road_map.lanes["1.0.-1"].successors == ()
    assert any("20.0 m apart" in note for note in road_map.notes)


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
