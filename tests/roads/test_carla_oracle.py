"""The reader against another reading of the same files: CARLA's map, which needs no simulator."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from scenewright.roads import RoadMap, load_map

from .conftest import map_source

carla = pytest.importorskip("carla", reason="the carla wheel is not installed")

# CARLA holds speed limits, links and positions in single precision and with y to the right.
COMPARED = ["t_intersection", "esmini/simple_3way_intersection", "esmini/fabriksgatan", "carla/Town01"]


def oracle(name: str) -> tuple[RoadMap, Any]:
    source = map_source(name)
    return load_map(source), carla.Map(source.stem, source.read_text(encoding="utf-8"))


def lane_id(waypoint: Any) -> str:
    return f"{waypoint.road_id}.{waypoint.section_id}.{waypoint.lane_id}"


@pytest.mark.parametrize("name", COMPARED)
def test_lane_centres_are_where_carla_sees_them(name: str) -> None:
    road_map, other = oracle(name)
    seen = set()
    for waypoint in other.generate_waypoints(2.0):
        lane = road_map.lanes[lane_id(waypoint)]
        place = waypoint.transform.location
        step = np.diff(lane.centerline_xy, axis=0)
        point = np.array([place.x, -place.y])
        along = np.clip(((point - lane.centerline_xy[:-1]) * step).sum(axis=1) / (step**2).sum(axis=1), 0.0, 1.0)
        feet = lane.centerline_xy[:-1] + along[:, None] * step
        nearest = int(np.argmin(np.hypot(*(feet - point).T)))
        assert np.hypot(*(feet[nearest] - point)) < 0.05
        yaw = -np.radians(waypoint.transform.rotation.yaw)
        heading = np.arctan2(step[nearest][1], step[nearest][0])
        assert abs(np.angle(np.exp(1j * (yaw - heading)))) < np.radians(3.0)
        assert waypoint.lane_width == pytest.approx(lane.width_m, abs=0.01)
        seen.add(lane.id)
    assert seen == set(road_map.lanes)


@pytest.mark.parametrize("name", COMPARED)
def test_lanes_lead_where_carla_says(name: str) -> None:
    road_map, other = oracle(name)
    pairs = {(lane_id(a), lane_id(b)) for a, b in other.get_topology()}
    theirs = {(before, after) for before, after in pairs if before != after}  # a dead end leads to itself there
    ours = {(lane.id, after) for lane in road_map.lanes.values() for after in lane.successors}
    if name == "esmini/simple_3way_intersection":
        # Its connections name both ends of each connecting road; CARLA then loses every way into the junction.
        ours = {(before, after) for before, after in ours if road_map.lanes[after].junction_id is None}
    assert theirs == ours
