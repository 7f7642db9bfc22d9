"""Which routes there are, their headings and landmarks, and what is said when none or several fit."""

from __future__ import annotations

import pytest

from scenewright.errors import MapError
from scenewright.roads import RoadMap, all_routes, find_route, find_routes

from .conftest import any_map


def test_all_routes_of_our_map(t_map: RoadMap) -> None:
    assert [str(route) for route in all_routes(t_map)] == [
        "W: from the road, straight",
        "E: from the road, straight",
        "S, W: from the driveway, right",
        "S, E: from the driveway, left",
        "E, N: from the road, left",
        "W, N: from the road, right",
    ]


def test_routes_of_skewed_junctions_get_the_nearest_letters() -> None:
    assert {(*route.headings, route.turn) for route in all_routes(any_map("esmini/fabriksgatan"))} == {
        *((letter, "straight") for letter in "NESW"),
        *((*pair, "right") for pair in ("NE", "ES", "SW", "WN")),
        *((*pair, "left") for pair in ("NW", "WS", "SE", "EN")),
    }
    # Three arms 120 degrees apart: every way turns by 60, and the letter after a turn is never the one before.
    assert {(*route.headings, route.turn) for route in all_routes(any_map("esmini/simple_3way_intersection"))} == {
        ("E", "N", "left"),
        ("E", "S", "right"),
        ("N", "W", "left"),
        ("N", "E", "right"),
        ("S", "W", "right"),
        ("S", "E", "left"),
    }


def test_landmarks_lie_in_driving_order(road_map: RoadMap) -> None:
    for route in all_routes(road_map):
        marks = route.landmarks
        assert 0 < marks["stop_line"] <= marks["junction_start"] == marks["turn_start"]
        assert marks["turn_start"] < marks["turn_end"] == marks["junction_end"] < marks["route_end"]
        assert marks["route_end"] == route.path.length_m
        assert marks["junction_start"] in route.lane_starts_m


def test_landmarks_on_our_map(t_map: RoadMap) -> None:
    right = find_route(t_map, headings=("S", "W"))
    assert right.landmarks["stop_line"] == pytest.approx(128.5, abs=1e-3)
    assert right.landmarks["junction_start"] == pytest.approx(130.0, abs=1e-3)
    assert right.path.pose(right.landmarks["turn_end"]) == pytest.approx((-14.0, 1.75, 3.14159), abs=1e-2)
    straight = find_route(t_map, headings=("W",))
    assert straight.landmarks["stop_line"] == straight.landmarks["junction_start"] == pytest.approx(300.0)
    assert straight.landmarks["junction_end"] == pytest.approx(328.0)


def test_conditions_select(t_map: RoadMap) -> None:
    assert find_route(t_map, origin_kind="driveway", turn="left").headings == ("S", "E")
    assert find_route(t_map, origin_heading="W", destination_kind="driveway").turn == "right"
    assert find_route(t_map, lanes=["1.0.-1", "3.0.-1"]).headings == ("E", "N")
    assert find_routes(t_map, lanes=["3.0.-1", "1.0.-1"]) == ()
    assert len(find_routes(t_map, destination_heading="W")) == 2
    assert len(find_routes(t_map, turn=None)) == 6


def test_no_fit_says_what_there_is(t_map: RoadMap) -> None:
    with pytest.raises(MapError) as caught:
        find_route(t_map, headings=("N", "W"))
    assert "headings N, W" in str(caught.value)
    assert "S, W: from the driveway, right" in str(caught.value.expected)


def test_several_fits_are_listed(t_map: RoadMap) -> None:
    with pytest.raises(MapError, match="more than one route") as caught:
        find_route(t_map, turn="straight")
    assert "W: from the road, straight (lanes 2.0.1 10.0.-1 1.0.1)" in str(caught.value.found)


def test_a_road_without_a_junction_has_through_routes() -> None:
    routes = all_routes(any_map("ncap/StraightRoad_NCAP"))
    assert [(route.headings, route.turn) for route in routes] == [(("W",), "straight"), (("E",), "straight")]
    assert set(routes[0].landmarks) == {"route_end"}
    assert routes[0].path.length_m == pytest.approx(1500.0)


def test_no_route_turns_back() -> None:
    for route in all_routes(any_map("carla/Town01")):
        assert len(set(route.lanes)) == len(route.lanes)
        roads = {lane_id.split(".")[0] for lane_id in (route.lanes[0], route.lanes[-1])}
        assert len(roads) == 2 or len(route.lanes) == 1
