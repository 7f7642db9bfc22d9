"""A zone is where boxes touch and nowhere else, against shapely."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from scenewright.roads import RoadMap, Route, all_routes
from scenewright.roads.bodies import CAR, Body
from scenewright.roads.conflicts import Conflict, conflicts
from scenewright.roads.path import Path
from scenewright.roads.polyline import FloatArray
from scenewright.roads.zones import boxes_touch, overlap, touching

TRUCK = Body(10.0, 2.5)


def bodies_at(route: Route, s_m: FloatArray, body: Body) -> NDArray[np.object_]:
    x, y, heading = route.path.poses(s_m).T
    along, across = (0.5 * body.length_m * np.array([1, 1, -1, -1]), 0.5 * body.width_m * np.array([1, -1, -1, 1]))
    cos, sin = np.cos(heading)[:, None], np.sin(heading)[:, None]
    corners = np.stack([x[:, None] + along * cos - across * sin, y[:, None] + along * sin + across * cos], axis=2)
    return shapely.polygons(corners)


def touched(route: Route, s_m: FloatArray, body: Body, others: NDArray[np.object_]) -> NDArray[np.bool_]:
    return shapely.intersects(bodies_at(route, s_m, body)[:, None], others[None, :]).any(axis=1)


@pytest.mark.parametrize("bodies", [(CAR, CAR), (TRUCK, CAR)], ids=["cars", "truck and car"])
def test_a_zone_is_where_boxes_touch_and_nowhere_else(road_map: RoadMap, bodies: tuple[Body, Body]) -> None:
    for a, b in combinations(all_routes(road_map), 2):
        for conflict in conflicts(a, b, *bodies):
            check_zone(a, b, conflict, bodies)
            check_zone(b, a, conflict.swapped(), bodies[::-1])


def check_zone(a: Route, b: Route, conflict: Conflict, bodies: tuple[Body, Body]) -> None:
    low, high = conflict.zone_a_m
    others = bodies_at(b, np.arange(conflict.zone_b_m[0], conflict.zone_b_m[1], 0.05), bodies[1])
    inside = np.linspace(low + 0.15, high - 0.15, 25)
    assert touched(a, inside, bodies[0], others).all(), (a, b, conflict)
    length_m = 0.5 * (bodies[0].length_m + bodies[1].length_m)
    outside = []
    if conflict.kind != "following" and low > 0.0:
        outside.append(low - 0.05)
    if conflict.kind != "merging" and high < a.path.length_m:
        outside.append(high + 0.05)
    assert not outside or not touched(a, np.array(outside), bodies[0], others).any(), (a, b, conflict)
    if conflict.kind == "following":
        assert low == pytest.approx(max(0.0, conflict.s_a_m - length_m), abs=0.11)
    if conflict.kind == "merging":
        assert high == pytest.approx(min(a.path.length_m, conflict.s_a_m + length_m), abs=0.11)


pose = st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0), st.floats(-3.2, 3.2))


def polygon(place: tuple[float, float, float], body: Body) -> shapely.Polygon:
    x, y, heading = place
    cos, sin = np.cos(heading), np.sin(heading)
    corners = [
        (x + along * body.length_m / 2 * cos - across * body.width_m / 2 * sin,
         y + along * body.length_m / 2 * sin + across * body.width_m / 2 * cos)
        for along, across in ((1, 1), (1, -1), (-1, -1), (-1, 1))
    ]  # fmt: skip
    return shapely.Polygon(corners)


@settings(max_examples=200)
@given(one=pose, other=pose)
def test_boxes_overlap_as_polygons_do(one: tuple[float, float, float], other: tuple[float, float, float]) -> None:
    shapes = polygon(one, CAR), polygon(other, TRUCK)
    if not 0.0 < shapes[0].distance(shapes[1]) < 1e-6:  # at the very edge rounding decides
        touch = bool(overlap(np.array(one), np.array(other), CAR, TRUCK))
        assert touch == shapes[0].intersects(shapes[1])
        assert bool(boxes_touch(np.array([one]), np.array([other]), CAR, TRUCK)[0, 0]) == touch


def test_every_pair_is_looked_at_however_many() -> None:
    """One car a metre along two long rows of places: each touches those within a length, across blocks of rows."""
    along = np.column_stack([np.arange(0.0, 150.0), np.zeros(150), np.zeros(150)])
    touch = boxes_touch(along, along[:130], CAR, CAR)
    assert np.array_equal(touch, np.abs(along[:, None, 0] - along[None, :130, 0]) <= CAR.length_m)


@pytest.mark.parametrize(("back_m", "ahead_m"), [(np.inf, np.inf), (2.0, np.inf), (np.inf, 1.5)])
def test_a_right_angle_is_touched_over_half_of_both_bodies(back_m: float, ahead_m: float) -> None:
    """Where two straight ways cross: half a length and half a width on either side, no further than asked for."""
    east = Path.from_points([[float(x), 0.0] for x in range(0, 101, 5)])
    north = Path.from_points([[60.0, float(y)] for y in range(-50, 51, 5)])
    half_m = 0.5 * (CAR.length_m + CAR.width_m)
    zones = touching((east, north), (60.0, 50.0), (CAR, CAR), back_m=back_m, ahead_m=ahead_m)
    for (low, high), place in zip(zones, (60.0, 50.0), strict=True):
        assert low == pytest.approx(place - min(half_m, back_m), abs=0.15)
        assert high == pytest.approx(place + min(half_m, ahead_m), abs=0.15)
