"""Tells a model what is on one map: its routes, the landmarks on them, and where they meet.

What enters: a `RoadMap`. What leaves: text. Nothing is told that the map does not hold; of a large map only the first
routes are, and it is said so.
"""

from __future__ import annotations

from itertools import combinations

from scenewright.program.printer import print_route
from scenewright.program.types import HeadingsRoute, LanesRoute
from scenewright.roads.conflicts import find_conflict
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route, all_routes, find_routes

_MOST_ROUTES = 60
_MOST_PAIRS = 150
_COMPASS = {"N": "north", "E": "east", "S": "south", "W": "west"}
_LANDMARKS = ("stop_line", "turn_start", "turn_end", "junction_start", "junction_end", "route_end")
_HOW = {
    "crossing": "cross",
    "merging": "come together into one lane",
    "following": "begin on one lane, so one vehicle follows the other, and part",
}


def map_facts(road_map: RoadMap) -> str:
    """Return routes, landmarks and meetings of `road_map` as lines of text.

    Examples
    --------
    >>> from scenewright.roads.load import load_map
    >>> print(map_facts(load_map("t_intersection")).splitlines()[2])
    - `W`: from the road, heading west; straight on; into the road, heading west. No turn: turn_start is no place here.
    """
    routes = all_routes(road_map)
    shown = routes[:_MOST_ROUTES]
    written = {id(route): written_route(road_map, route) for route in shown}
    lines = [f"Map: {road_map.name}", "Routes, as they are written in a program:"]
    lines += [f"- `{written[id(route)]}`: {_told(route)}" for route in shown]
    if len(routes) > len(shown):
        lines.append(f"- ... and {len(routes) - len(shown)} more, which this list leaves out")
    lines += ["", "Where two routes meet (the conflict_point of a program with these two):"]
    lines += _meetings(road_map, shown, written)
    lines += [
        "- Two vehicles on the same route follow each other; their conflict_point is where the junction begins (on a "
        "road without one, where the route ends).",
        "- gap, headway and ttc exist for vehicles on one route, and where routes begin on one lane or come together.",
        "- Routes that are not listed as a pair here never meet and share no lane: between them there is no "
        "conflict_point and no gap.",
    ]
    return "\n".join(lines)


def written_route(road_map: RoadMap, route: Route) -> str:
    """Return `route` as a program writes it: by headings where that names it alone, else by its lanes."""
    if len(find_routes(road_map, headings=route.headings)) == 1:
        return print_route(HeadingsRoute(route.headings))
    return print_route(LanesRoute(route.lanes))


def _told(route: Route) -> str:
    way = "straight on" if route.turn == "straight" else f"turns {route.turn}"
    first, last = _COMPASS[route.headings[0]], _COMPASS[route.headings[-1]]
    text = f"from the {route.origin_kind}, heading {first}; {way}; into the {route.destination_kind}, heading {last}."
    if route.turn == "straight" and "turn_start" in route.landmarks:
        return f"{text} No turn: turn_start is no place here."
    missing = [name for name in _LANDMARKS if name not in route.landmarks]
    return f"{text} It has no {', no '.join(missing)}." if missing else text


def _meetings(road_map: RoadMap, routes: tuple[Route, ...], written: dict[int, str]) -> list[str]:
    junctions = {
        id(route): {name for lane in route.lanes if (name := road_map.lanes[lane].junction_id) is not None}
        for route in routes
    }
    lines: list[str] = []
    for one, other in combinations(routes, 2):
        if not junctions[id(one)] & junctions[id(other)]:
            continue
        conflict = find_conflict(one, other)
        if conflict is None:
            continue
        if len(lines) == _MOST_PAIRS:
            lines.append("- ... and more, which this list leaves out")
            break
        lines.append(f"- `{written[id(one)]}` and `{written[id(other)]}` {_HOW[conflict.kind]}")
    return lines
