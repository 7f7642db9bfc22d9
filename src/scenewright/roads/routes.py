"""Routes: ways through a map along its lanes, with headings, a turn, and landmarks as arc lengths.

What enters: a `RoadMap`. What leaves: `Route` objects, always in the same order, and a search among them. A route
passes one junction, from the very beginning of its approach arm to the end of its exit arm. U-turns are left out. On a
closed road a route goes around once, and ends a little before it is where it began.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from typing import TypedDict, Unpack

import numpy as np

from scenewright.errors import MapError
from scenewright.roads.model import Lane, LaneKind, RoadMap
from scenewright.roads.path import Path, wrap_rad
from scenewright.roads.polyline import FloatArray, Turn, polyline_arc_lengths, turn_of, turned_rad

Ends = tuple[float, float]  # something at the beginning of a line, and something at its end

_CARDINALS = "ENWS"  # counter-clockwise from the x axis
_U_TURN_FROM_RAD = np.radians(150.0)
_CLOSING_GAP_M = 10.0  # left between the two ends of a route around a closed road, so that places on it are unique
_ORIGINS = {"road": "from the road", "driveway": "from the driveway"}


@dataclass(frozen=True, slots=True, eq=False)
class Route:
    """A way through a map.

    Attributes
    ----------
    lanes, lane_starts_m
        Lane ids in driving order, and the arc length on `path` at which each begins; the first one's is negative where
        a route around a closed road begins within a lane (which then is its last lane, too).
    headings
        Cardinal letters of the directions of travel before and after a turn, ``("S", "W")``; one letter where straight.
    landmarks
        Arc lengths in metres: ``route_end`` always; with a junction also ``junction_start``, ``junction_end``,
        ``turn_start``, ``turn_end`` and ``stop_line`` (the map's, else where the junction begins).
    junction_id
        The junction that it passes, if any.
    """

    lanes: tuple[str, ...]
    lane_starts_m: tuple[float, ...]
    path: Path = field(repr=False)
    headings: tuple[str, ...]
    turn: Turn
    origin_kind: LaneKind
    destination_kind: LaneKind
    landmarks: Mapping[str, float] = field(repr=False)
    junction_id: str | None = None

    def __str__(self) -> str:
        return f"{', '.join(self.headings)}: {_ORIGINS[self.origin_kind]}, {self.turn}"


@lru_cache(maxsize=32)
def all_routes(road_map: RoadMap) -> tuple[Route, ...]:
    """Return all routes through one junction, those along roads that meet no junction, and those around closed roads.

    The order follows the order of the lanes in the map's file, and is the same every time.

    Examples
    --------
    >>> from scenewright.roads.load import load_map
    >>> [str(route) for route in all_routes(load_map("t_intersection"))][:2]
    ['W: from the road, straight', 'E: from the road, straight']
    """
    lanes = road_map.lanes
    chains: list[tuple[str, ...]] = []
    for lane in lanes.values():
        if lane.junction_id is None:
            continue
        if all(lanes[name].junction_id != lane.junction_id for name in lane.predecessors):
            chains += _junction_chains(lanes, lane)
    routes = [_route(lanes, *_with_arms(lanes, chain), chain) for chain in chains]
    through = _through_chains(lanes)
    through += _rings(lanes, {name for chain in (*chains, *through) for name in chain})
    routes += [_route(lanes, chain, _left_out_m(lanes, chain), ()) for chain in through]
    return tuple(route for route in routes if route is not None)


class RouteQuery(TypedDict, total=False):
    """Conditions on a route; what is absent or None does not matter.

    `headings` are all of a route's headings, such as ``("S", "W")`` or ``("W",)``; `origin_heading` and
    `destination_heading` one cardinal letter each. Kinds are ``"road"`` or ``"driveway"``, turns ``"left"``,
    ``"right"`` or ``"straight"``. `lanes` are ids that the route passes in this order, not necessarily all it passes.
    """

    headings: Sequence[str] | None
    origin_kind: str | None
    origin_heading: str | None
    turn: str | None
    destination_kind: str | None
    destination_heading: str | None
    lanes: Sequence[str] | None


def find_routes(road_map: RoadMap, **asked: Unpack[RouteQuery]) -> tuple[Route, ...]:
    """Return the routes that meet every condition of `RouteQuery` given, in the order of `all_routes`."""
    return tuple(route for route in all_routes(road_map) if _meets(route, asked))


def find_route(road_map: RoadMap, **asked: Unpack[RouteQuery]) -> Route:
    """Return the one route that meets every condition of `RouteQuery` given.

    Raises
    ------
    MapError
        If no route or more than one fits; the message lists what there is.

    Examples
    --------
    >>> from scenewright.roads.load import load_map
    >>> find_route(load_map("t_intersection"), headings=("S", "W")).turn
    'right'
    """
    found = find_routes(road_map, **asked)
    if len(found) == 1:
        return found[0]
    given = ((name, value) for name, value in asked.items() if value is not None)
    wanted = "; ".join(f"{name} {_shown(value)}" for name, value in given) or "any route"
    if found:
        raise MapError(
            f"more than one route on {road_map.name} fits",
            found=f"{wanted}, which fits {_listed(found, with_lanes=True)}",
            expected="a description that only one route meets",
            fix="say also where it comes from, how it turns, or which lanes it takes",
        )
    there_are = _listed(all_routes(road_map), with_lanes=False)
    raise MapError(
        f"no route on {road_map.name} fits",
        found=wanted,
        expected=f"one of {there_are}" if there_are else "a map with at least one way through",
        fix="choose one of these routes, or another map" if there_are else "choose another map",
    )


def _meets(route: Route, asked: RouteQuery) -> bool:
    facts = {
        "headings": route.headings,
        "origin_kind": route.origin_kind,
        "origin_heading": route.headings[0],
        "turn": route.turn,
        "destination_kind": route.destination_kind,
        "destination_heading": route.headings[-1],
    }
    for name, value in asked.items():
        if value is None:
            continue
        if name == "lanes":
            if not _passes(route.lanes, asked["lanes"] or ()):
                return False
        elif facts[name] != (tuple(asked["headings"] or ()) if name == "headings" else value):
            return False
    return True


def _shown(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)


def _listed(routes: tuple[Route, ...], *, with_lanes: bool) -> str:
    texts = [f"{route} (lanes {' '.join(route.lanes)})" if with_lanes else str(route) for route in routes]
    unique = list(dict.fromkeys(texts))
    return "; ".join(unique[:12]) + ("; ..." if len(unique) > 12 else "")


def _passes(passed: tuple[str, ...], wanted: Sequence[str]) -> bool:
    rest = iter(passed)
    return all(name in rest for name in wanted)


def _junction_chains(lanes: Mapping[str, Lane], entry: Lane) -> list[tuple[str, ...]]:
    """Return every way from an entry lane to where it leaves the junction."""
    done: list[tuple[str, ...]] = []
    open_chains: list[tuple[str, ...]] = [(entry.id,)]
    while open_chains:
        chain = open_chains.pop(0)
        inside = [
            n for n in lanes[chain[-1]].successors if lanes[n].junction_id == entry.junction_id and n not in chain
        ]
        open_chains += [(*chain, name) for name in inside]
        if not inside:
            done.append(chain)
    return done


def _with_arms(lanes: Mapping[str, Lane], chain: tuple[str, ...]) -> tuple[tuple[str, ...], Ends]:
    """Return the lanes of a way through a junction with both its arms, and what the route leaves out at its ends (m).

    Where the exit leads back to the approach, the lanes that are both are parted in the middle.
    """
    before = _follow(lanes, chain[0], lambda lane: lane.predecessors)[::-1]
    after = _follow(lanes, chain[-1], lambda lane: lane.successors)
    both = [name for name in after if name in before]
    if not both:
        whole = (*before, *chain, *after)
        return whole, _left_out_m(lanes, whole)
    half_m = 0.5 * sum(lanes[name].length_m for name in both)
    for name in both:
        if half_m <= lanes[name].length_m:
            break
        half_m -= lanes[name].length_m
    gap_m = 0.5 * _gap_m(lanes[name])
    parted = (*before[before.index(name) :], *chain, *after[: after.index(name) + 1])
    return parted, (half_m + gap_m, lanes[name].length_m - half_m + gap_m)


def _left_out_m(lanes: Mapping[str, Lane], chain: tuple[str, ...]) -> Ends:
    """Return what a route along lanes leaves out at its ends (m): something where it would run into itself."""
    first, last = lanes[chain[0]], lanes[chain[-1]]
    is_ring = first.id in last.successors
    begins_beside = not is_ring and any(name in chain for name in first.predecessors)
    ends_beside = is_ring or any(name in chain for name in last.successors)
    return _gap_m(first) * begins_beside, _gap_m(last) * ends_beside


def _gap_m(lane: Lane) -> float:
    return min(_CLOSING_GAP_M, 0.5 * lane.length_m)


def _follow(lanes: Mapping[str, Lane], start: str, step: Callable[[Lane], tuple[str, ...]]) -> list[str]:
    """Walk along an arm until the map or the arm ends; where lanes join or part, keep to the first in the file."""
    walked: list[str] = []
    name = start
    while True:
        following = [n for n in step(lanes[name]) if lanes[n].junction_id is None and n not in walked]
        if not following:
            return walked
        name = following[0]
        walked.append(name)


def _through_chains(lanes: Mapping[str, Lane]) -> list[tuple[str, ...]]:
    chains = []
    for lane in lanes.values():
        if lane.junction_id is None and not lane.predecessors:
            chain = (lane.id, *_follow(lanes, lane.id, lambda each: each.successors))
            if all(lanes[n].junction_id is None for n in lanes[chain[-1]].successors):
                chains.append(chain)
    return chains


def _rings(lanes: Mapping[str, Lane], taken: set[str]) -> list[tuple[str, ...]]:
    """Return once around each closed road that no chain in `taken` leads along, from its first lane in the file."""
    rings, seen = [], set(taken)
    for lane in lanes.values():
        if lane.junction_id is None and lane.id not in seen:
            ring = _around(lanes, lane.id)
            rings += [ring] if ring else []
            seen |= set(ring)
    return rings


def _around(lanes: Mapping[str, Lane], start: str) -> tuple[str, ...]:
    """Return the fewest lanes that lead from a lane back to itself outside junctions; none where none do."""
    ways: list[tuple[str, ...]] = [(start,)]
    seen = {start}
    for way in ways:
        for name in lanes[way[-1]].successors:
            if name == start:
                return way
            if lanes[name].junction_id is None and name not in seen:
                seen.add(name)
                ways.append((*way, name))
    return ()


def _route(
    lanes: Mapping[str, Lane], chain: tuple[str, ...], left_out_m: Ends, inside: tuple[str, ...]
) -> Route | None:
    points = _joined([lanes[name] for name in (inside or chain)])
    turned = turned_rad(points) if inside else 0.0
    if abs(turned) > _U_TURN_FROM_RAD:
        return None
    turn: Turn = turn_of(points) if inside else "straight"
    path = Path.from_points(_cut(_joined([lanes[name] for name in chain]), left_out_m))
    starts = _lane_starts_m(lanes, chain, path, 0.0 - left_out_m[0])
    first, last = lanes[chain[0]], lanes[chain[-1]]
    landmarks = {"route_end": path.length_m}
    at = first.start_heading_rad
    if inside:
        at = lanes[inside[0]].start_heading_rad
        landmarks = _landmarks(lanes, chain, inside, starts, path.length_m)
    return Route(
        lanes=chain,
        lane_starts_m=starts,
        path=path,
        headings=_headings(at, turned, turn),
        turn=turn,
        origin_kind=first.kind,
        destination_kind=last.kind,
        landmarks=landmarks,
        junction_id=lanes[inside[0]].junction_id if inside else None,
    )


def _joined(lanes: list[Lane]) -> FloatArray:
    """Return the lanes' centre lines as one, the doubled points where they meet dropped."""
    pieces = [lane.centerline_xy[:-1] for lane in lanes[:-1]]
    return np.vstack([*pieces, lanes[-1].centerline_xy])


def _cut(points: FloatArray, left_out_m: Ends) -> FloatArray:
    """Return a line without so much of its beginning and of its end."""
    if not any(left_out_m):
        return points
    along_m = polyline_arc_lengths(points)
    first_m, last_m = left_out_m[0], float(along_m[-1]) - left_out_m[1]
    kept = along_m[(along_m > first_m) & (along_m < last_m)]
    at_m = np.concatenate([[first_m], kept, [last_m]])
    return np.column_stack([np.interp(at_m, along_m, points[:, axis]) for axis in (0, 1)])


def _lane_starts_m(lanes: Mapping[str, Lane], chain: tuple[str, ...], path: Path, first_m: float) -> tuple[float, ...]:
    starts = [first_m]
    for before, name in pairwise(chain):
        x, y = lanes[name].centerline_xy[0].tolist()
        starts.append(path.to_frenet(x, y, near_s_m=starts[-1] + lanes[before].length_m)[0])
    return tuple(starts)


def _landmarks(
    lanes: Mapping[str, Lane], chain: tuple[str, ...], inside: tuple[str, ...], starts: tuple[float, ...], end_m: float
) -> dict[str, float]:
    first = chain.index(inside[0])
    after = first + len(inside)
    junction_start = starts[first]
    junction_end = starts[after] if after < len(starts) else end_m
    stops = [
        start + stop
        for name, start in zip(chain[:first], starts, strict=False)
        if (stop := lanes[name].stop_line_s_m) is not None
    ]
    return {
        "stop_line": stops[-1] if stops else junction_start,
        "junction_start": junction_start,
        "turn_start": junction_start,
        "turn_end": junction_end,
        "junction_end": junction_end,
        "route_end": end_m,
    }


def _headings(start_rad: float, turned_by_rad: float, turn: Turn) -> tuple[str, ...]:
    """Return cardinal letters; after a turn the letter always differs, however flat the turn."""
    quarter = round(wrap_rad(start_rad) / (np.pi / 2)) % 4
    if turn == "straight":
        return (_CARDINALS[quarter],)
    after = round(wrap_rad(start_rad + turned_by_rad) / (np.pi / 2)) % 4
    if after == quarter:
        after = (quarter + (1 if turn == "left" else -1)) % 4
    return _CARDINALS[quarter], _CARDINALS[after]
