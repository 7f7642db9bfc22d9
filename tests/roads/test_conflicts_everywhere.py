"""Every conflict of every pair of routes, on all maps at hand, against lane centre lines in shapely."""

from __future__ import annotations

from functools import cache
from itertools import combinations
from pathlib import Path

import pytest
import shapely

from scenewright.errors import MapError
from scenewright.roads import RoadMap, Route, all_routes, find_conflict, load_map
from scenewright.roads.bodies import CAR, Body
from scenewright.roads.conflicts import Conflict, conflicts, shared_stretches

from .conftest import FOREIGN, any_map

ONE_PLACE_M = 1.0
SOURCES = ["t_intersection", *sorted(path.relative_to(FOREIGN).as_posix() for path in FOREIGN.rglob("*.xodr"))]
TRUCK = Body(10.0, 2.5)
Pair = tuple[Route, Route, tuple[Conflict, ...]]
_PAIRS, _BOTH_SIDES = 400, 100  # of a town that has more, every so manieth is looked at; fewer from both sides


@cache
def pairs_on(source: str | Path) -> tuple[RoadMap, list[Pair]]:
    """Return a map, and each pair of its routes with their conflicts as cars have them; made once for all tests."""
    road_map = load_map(source)
    pairs = list(combinations(all_routes(road_map), 2))
    return road_map, [(a, b, conflicts(a, b)) for a, b in pairs[:: max(1, len(pairs) // _PAIRS)]]


@pytest.fixture(scope="module", params=SOURCES)  # all tests of one map come after each other
def every_map(request: pytest.FixtureRequest) -> tuple[RoadMap, list[Pair]]:
    try:
        return pairs_on(request.param if "/" not in request.param else FOREIGN / request.param)
    except MapError as error:
        pytest.skip(f"{request.param} is refused: {error.message}")


@pytest.fixture
def loop(shared_dir: Path) -> tuple[Route, Route]:
    """Return two routes that share a road and cross where they pass the junction: into the loop, and out of it."""
    first, second = all_routes(load_map(shared_dir / "cases" / "loop.xodr"))
    return first, second


def centre_lines(road_map: RoadMap, route: Route, but: set[str]) -> shapely.Geometry:
    return shapely.union_all([shapely.LineString(road_map.lanes[n].centerline_xy) for n in route.lanes if n not in but])


def crossings_of(road_map: RoadMap, a: Route, b: Route) -> list[shapely.Point]:
    """Return where the lines cross, but for lanes that both take and where they still lie beside each other there."""
    both = set(a.lanes) & set(b.lanes)
    line_a, line_b = centre_lines(road_map, a, set()), centre_lines(road_map, b, set())
    met = centre_lines(road_map, a, both).intersection(line_b) | line_a.intersection(centre_lines(road_map, b, both))
    points = [shapely.Point(*xy) for xy in shapely.get_coordinates(met)]
    if not both or not points:
        return points
    shared = shapely.union_all([shapely.LineString(road_map.lanes[name].centerline_xy) for name in both])
    beside = shapely.get_parts(shapely.line_merge(line_a.intersection(line_b.buffer(0.5))))
    one = [part for part in beside if part.distance(shared) < ONE_PLACE_M]
    return [point for point in points if all(point.distance(part) > ONE_PLACE_M for part in (shared, *one))]


def test_crossings_are_all_those_of_the_centre_lines(every_map: tuple[RoadMap, list[Pair]]) -> None:
    road_map, pairs = every_map
    for a, b, met in pairs:
        found = [shapely.Point(each.x_m, each.y_m) for each in met if each.kind == "crossing"]
        wanted = crossings_of(road_map, a, b)
        for points, others in ((found, wanted), (wanted, found)):
            assert all(any(point.distance(other) < ONE_PLACE_M for other in others) for point in points), (a, b)


def test_lanes_that_both_take_begin_in_a_merge_and_end_in_a_parting(every_map: tuple[RoadMap, list[Pair]]) -> None:
    for a, b, met in every_map[1]:
        kinds = [each.kind for each in met]
        stretches = shared_stretches(a, b)
        assert bool(stretches) == bool(set(a.lanes) & set(b.lanes))
        assert kinds.count("merging") == sum(not stretch.together for stretch in stretches)
        assert kinds.count("following") == sum(stretch.together or stretch.goes_on for stretch in stretches)


def test_from_the_other_route_they_are_the_same_in_the_same_order(every_map: tuple[RoadMap, list[Pair]]) -> None:
    pairs = every_map[1]
    for a, b, _ in pairs[:: max(1, len(pairs) // _BOTH_SIDES)]:
        found = conflicts(a, b, CAR, TRUCK)
        assert conflicts(b, a, TRUCK, CAR) == tuple(conflict.swapped() for conflict in found)
        ways = [conflict.s_a_m + conflict.s_b_m for conflict in found]
        assert ways == sorted(ways)


def test_the_crossing_in_the_junction_counts_before_a_road_in_common(loop: tuple[Route, Route]) -> None:
    into, out = loop
    assert [each.kind for each in conflicts(into, out)] == ["merging", "crossing"]
    counts = find_conflict(into, out)
    assert counts is not None
    assert counts.kind == "crossing"
    assert (counts.s_a_m, counts.s_b_m) == pytest.approx((118.25, 392.74), abs=0.01)
    assert find_conflict(out, into) == counts.swapped()


def test_lanes_side_by_side_never_meet() -> None:
    first, *others = all_routes(any_map("alks/alks_road_different_curvatures"))
    assert [conflicts(first, other) for other in others] == [()] * len(others)
