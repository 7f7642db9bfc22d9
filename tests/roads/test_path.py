"""Arc length, curvature and Frenet coordinates of paths, on known curves and on every route of the maps."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scenewright.roads import Path, RoadMap, all_routes, load_map
from scenewright.roads.path import wrap_rad

from .conftest import MAPS, any_map


def quarter_circle(radius_m: float, count: int = 40) -> Path:
    angle = np.linspace(0.0, math.pi / 2, count)
    return Path.from_points(np.column_stack([radius_m * np.sin(angle), radius_m * (1.0 - np.cos(angle))]))


def test_a_quarter_circle_has_its_length_curvature_and_heading() -> None:
    path = quarter_circle(9.0)
    assert path.length_m == pytest.approx(9.0 * math.pi / 2, abs=1e-4)
    for s_m in np.linspace(0.0, path.length_m, 30):
        assert path.curvature(s_m) == pytest.approx(1 / 9.0, rel=0.01)
        assert path.pose(s_m)[2] == pytest.approx(s_m / 9.0, abs=1e-3)


def test_beyond_its_ends_a_path_goes_on_straight() -> None:
    path = quarter_circle(9.0)
    x, y, heading = path.pose(path.length_m + 5.0)
    assert (x, y, heading) == pytest.approx((9.0, 14.0, math.pi / 2), abs=1e-2)
    assert path.pose(-3.0) == pytest.approx((-3.0, 0.0, 0.0), abs=1e-2)
    assert path.curvature(-1.0) == path.curvature(path.length_m + 1.0) == 0.0
    assert path.to_frenet(x, y, heading, near_s_m=path.length_m) == pytest.approx((path.length_m + 5.0, 0, 0), abs=1e-6)
    assert path.to_frenet(-40.0, 2.0)[:2] == pytest.approx((-40.0, 2.0), abs=0.2)


def test_points_that_nearly_coincide_make_no_kink() -> None:
    points = [[0.0, 0.0], [10.0, 0.0], [10.001, 0.001], [20.0, 0.0], [30.0, 0.0]]
    path = Path.from_points(points)
    assert max(abs(path.curvature(s_m)) for s_m in np.arange(0.0, 30.0, 0.1)) < 1e-2
    with pytest.raises(ValueError, match="two distinct"):
        Path.from_points([[1.0, 1.0], [1.0, 1.0]])


def test_arc_length_is_true_on_every_route(road_map: RoadMap) -> None:
    for route in all_routes(road_map):
        path = route.path
        s_m = np.linspace(0.0, path.length_m, 40_001)
        xy = path.poses(s_m)[:, :2]
        steps = np.hypot(*np.diff(xy, axis=0).T)
        assert steps.sum() == pytest.approx(path.length_m, abs=2e-3)
        assert np.abs(steps / np.diff(s_m) - 1.0).max() < 1e-3


def test_poses_at_many_places_are_the_poses_at_each(road_map: RoadMap) -> None:
    path = all_routes(road_map)[0].path
    s_m = np.linspace(-20.0, path.length_m + 20.0, 200)
    assert path.poses(s_m) == pytest.approx(np.array([path.pose(float(s)) for s in s_m]), abs=1e-9)


def test_routes_run_through_the_middle_of_their_lanes(road_map: RoadMap) -> None:
    for route in all_routes(road_map):
        for lane_id, start_m in zip(route.lanes, route.lane_starts_m, strict=True):
            lane = road_map.lanes[lane_id]
            near_m = start_m
            for x, y in lane.centerline_xy.tolist():
                near_m, d_m, _ = route.path.to_frenet(x, y, near_s_m=near_m)
                assert abs(d_m) < 0.02


def test_many_curvatures_are_those_of_each(t_map: RoadMap) -> None:
    for route in all_routes(t_map):
        s_m = np.arange(-3.0, route.path.length_m + 5.0, 0.37)
        assert route.path.curvatures(s_m).tolist() == [route.path.curvature(float(s)) for s in s_m]


def test_curvature_on_our_map_is_that_of_a_car(t_map: RoadMap) -> None:
    for route in all_routes(t_map):
        s_m = np.arange(0.0, route.path.length_m, 0.05)
        curvature = np.array([route.path.curvature(float(s)) for s in s_m])
        assert np.abs(np.diff(curvature)).max() < 0.002  # no jumps: below 0.04 1/m^2
        tightest = float(np.abs(curvature).max())
        if route.turn == "straight":
            assert tightest < 1e-6
        else:
            assert 1 / tightest == pytest.approx({"right": 9.0, "left": 13.0}[route.turn], abs=0.5)
            turning = s_m[np.abs(curvature) > 1e-3]
            assert turning.min() >= route.landmarks["turn_start"] - 0.5
            assert turning.max() <= route.landmarks["turn_end"] + 0.5


@pytest.mark.parametrize("name", MAPS)
@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_frenet_round_trip(name: str, data: st.DataObject) -> None:
    routes = all_routes(any_map(name))
    route = routes[data.draw(st.integers(0, len(routes) - 1))]
    path = route.path
    around_turn = st.floats(route.landmarks["turn_start"] - 5.0, route.landmarks["turn_end"] + 5.0)
    s_m = data.draw(st.one_of(st.floats(-10.0, path.length_m + 10.0), around_turn))
    d_m = data.draw(st.floats(-3.0, 3.0))
    error_rad = data.draw(st.floats(-3.0, 3.0))
    x_m, y_m, heading_rad = path.to_cartesian(s_m, d_m, error_rad)
    for near_s_m in (s_m, s_m + 4.0, s_m - 4.0, None):
        found_s_m, found_d_m, found_error_rad = path.to_frenet(x_m, y_m, heading_rad, near_s_m=near_s_m)
        back = path.to_cartesian(found_s_m, found_d_m, found_error_rad)
        assert math.hypot(back[0] - x_m, back[1] - y_m) < 0.01
        assert abs(wrap_rad(back[2] - heading_rad)) < math.radians(0.1)
        assert found_s_m == pytest.approx(s_m, abs=0.01)
        assert found_d_m == pytest.approx(d_m, abs=0.01)


def test_an_expectation_far_off_does_not_mislead(t_map: RoadMap) -> None:
    path = all_routes(t_map)[0].path
    x_m, y_m, _ = path.to_cartesian(300.0, 1.0)
    assert path.to_frenet(x_m, y_m, near_s_m=20.0)[:2] == pytest.approx((300.0, 1.0), abs=1e-6)


def test_a_path_survives_pickling() -> None:
    path = all_routes(load_map("t_intersection"))[2].path
    assert pickle.loads(pickle.dumps(path)).pose(140.0) == path.pose(140.0)
