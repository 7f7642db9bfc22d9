"""Routes around roads that end where they begin: a ring, a ring that a ramp leads onto, a ring through a junction."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from scenewright.roads import Route, all_routes, find_conflict, find_route, load_map
from scenewright.roads.conflicts import conflicts, shared_stretches

RADIUS_M = 50.0
ROUND_M = 2 * math.pi * RADIUS_M


def road(number: int, links: str, start: tuple[float, float, float], shape: str, length_m: float, lanes: str) -> str:
    x, y, heading = start
    return (
        f'<road id="{number}" name="" length="{length_m:.9f}" junction="{"9" if number == 10 else "-1"}">'
        f"<link>{links}</link><planView>"
        f'<geometry s="0" x="{x:.9f}" y="{y:.9f}" hdg="{heading:.12f}" length="{length_m:.9f}">{shape}</geometry>'
        f'</planView><lanes><laneSection s="0">{lanes}</laneSection></lanes></road>'
    )


def lane(number: int, links: str = "") -> str:
    side = "left" if number > 0 else "right"
    width = '<width sOffset="0" a="3.5" b="0" c="0" d="0"/>'
    return f'<{side}><lane id="{number}" type="driving"><link>{links}</link>{width}</lane></{side}>'


CENTRE = '<center><lane id="0" type="none"/></center>'
ARC = '<arc curvature="0.02"/>'
ON = '<predecessor id="-1"/><successor id="-1"/>'


def linked(before: int, after: int, kind: str = "road") -> str:
    contacts = ('contactPoint="end"', 'contactPoint="start"') if kind == "road" else ("", "")
    return (
        f'<predecessor elementType="{kind}" elementId="{before}" {contacts[0]}/>'
        f'<successor elementType="{kind}" elementId="{after}" {contacts[1]}/>'
    )


def write(folder: Path, *parts: str) -> Path:
    path = folder / "closed.xodr"
    path.write_text(f'<OpenDRIVE><header revMajor="1" revMinor="4"/>{"".join(parts)}</OpenDRIVE>', encoding="utf-8")
    return path


@pytest.fixture
def ring(tmp_path: Path) -> tuple[Route, ...]:
    """Two half circles, a lane each way: no lane is without one before it."""
    other_way = '<predecessor id="1"/><successor id="1"/>'
    lanes = lane(1, other_way) + CENTRE + lane(-1, ON)
    half_m = 0.5 * ROUND_M
    halves = [
        road(1, linked(2, 2), (RADIUS_M, 0.0, math.pi / 2), ARC, half_m, lanes),
        road(2, linked(1, 1), (-RADIUS_M, 0.0, -math.pi / 2), ARC, half_m, lanes),
    ]
    return all_routes(load_map(write(tmp_path, *halves)))


@pytest.fixture
def through_a_junction(tmp_path: Path) -> Route:
    """A road that leaves a junction and comes back to its other side."""
    across_m = 0.1 * ROUND_M
    angle = across_m / RADIUS_M
    end = (RADIUS_M * math.cos(angle), RADIUS_M * math.sin(angle), math.pi / 2 + angle)
    parts = [
        road(1, linked(9, 9, "junction"), end, ARC, ROUND_M - across_m, CENTRE + lane(-1)),
        road(10, linked(1, 1), (RADIUS_M, 0.0, math.pi / 2), ARC, across_m, CENTRE + lane(-1, ON)),
        '<junction id="9" name=""><connection id="0" incomingRoad="1" connectingRoad="10" contactPoint="start">'
        '<laneLink from="-1" to="-1"/></connection></junction>',
    ]
    (route,) = all_routes(load_map(write(tmp_path, *parts)))
    return route


def test_a_ring_is_driven_around_once_each_way(ring: tuple[Route, ...]) -> None:
    assert [route.lanes for route in ring] == [("1.0.1", "2.0.1"), ("1.0.-1", "2.0.-1")]
    for route, radius_m in zip(ring, (RADIUS_M - 1.75, RADIUS_M + 1.75), strict=True):
        assert route.turn == "straight"
        assert route.landmarks["route_end"] == pytest.approx(2 * math.pi * radius_m - 10.0, abs=0.05)
        ends = (route.path.pose(0.0)[:2], route.path.pose(route.path.length_m)[:2])
        assert math.dist(*ends) == pytest.approx(10.0, abs=0.1)
        assert route.path.to_frenet(*ends[1])[0] == pytest.approx(route.path.length_m)
        assert route.path.to_frenet(*ends[0])[0] == pytest.approx(0.0, abs=1e-6)


def test_around_a_ring_vehicles_follow_each_other_and_never_meet_those_that_come(ring: tuple[Route, ...]) -> None:
    one, other = ring
    assert conflicts(one, other) == ()
    following = find_conflict(one, one)
    assert following is not None
    assert (following.kind, following.s_a_m) == ("following", one.path.length_m)


def test_a_ring_through_a_junction_is_parted_opposite_of_it(through_a_junction: Route) -> None:
    route = through_a_junction
    assert route.lanes == ("1.0.-1", "10.0.-1", "1.0.-1")
    assert route.lane_starts_m[0] < 0.0 < route.lane_starts_m[1]
    before_m = route.landmarks["junction_start"]
    after_m = route.landmarks["route_end"] - route.landmarks["junction_end"]
    assert before_m == pytest.approx(after_m, abs=0.1)
    assert math.dist(route.path.pose(0.0)[:2], route.path.pose(route.path.length_m)[:2]) == pytest.approx(10.0, abs=0.1)
    (stretch,) = shared_stretches(route, route)
    assert stretch.begin == (0.0, 0.0)


def test_a_loop_road_belongs_to_both_routes_through_its_junction(shared_dir: Path) -> None:
    loop = load_map(shared_dir / "cases" / "loop.xodr")
    into, out = find_route(loop, headings=("E",)), find_route(loop, headings=("S",))
    assert into.lanes[-1] == out.lanes[0] == "2.0.-1"
    assert into.junction_id == out.junction_id == "9"
