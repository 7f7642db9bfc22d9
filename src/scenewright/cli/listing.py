"""`maps`, `egos`, `simulators` and `solvers`: what there is to drive on, to drive with and in, and to refute with.

What enters: a map's name or file, or nothing. What leaves: lists and tables, for people or as JSON.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Annotated, Any

from scenewright.cli.console import print_json, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson, argument, complete_map

if TYPE_CHECKING:
    from rich.console import Console

    from scenewright.plugins import Kind
    from scenewright.roads.model import RoadMap

_SHOWN = 30
_PLACES = {"stop_line": "stop line", "junction_start": "begins", "junction_end": "ends", "route_end": "route end"}

MapArgument = Annotated[
    str | None,
    argument(
        "[NAME|FILE]", "A shipped map or an OpenDRIVE file; all shipped maps where nothing is named.", complete_map
    ),
]


def maps(name: MapArgument = None, as_json: AsJson = False) -> None:
    """List the shipped maps, or the routes, landmarks and conflict points of one map."""
    with told(as_json):
        from scenewright.roads.load import load_map, shipped_maps

        if name is not None:
            described = describe(load_map(name))
            if as_json:
                print_json(described)
            else:
                _show(stdout(), described)
            return
        known = [describe(load_map(each)) for each in shipped_maps()]
        if as_json:
            print_json(known)
            return
        for each in known:
            stdout().print(f"{each['name']}  {len(each['routes'])} routes, {len(each['lanes'])} lanes")
        stdout().print("\nscenewright maps NAME shows routes and landmarks; an OpenDRIVE file may stand for NAME.")


def egos(as_json: AsJson = False) -> None:
    """List the driving policies that --ego can name."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.drive.loading import policy_descriptions

        described = policy_descriptions()
        if as_json:
            print_json(described)
            return
        stdout().print(tables.facts(described.items()))
        stdout().print("\nYour own: --ego module:Class, a class with reset(start) and step(observation, dt_s).")


def solvers(as_json: AsJson = False) -> None:
    """List the solvers that check --solver can name: what each can do, or how to install it."""
    with told(as_json):
        from scenewright.solve.proofs.refuters import SOLVERS

        _list_parts(SOLVERS, as_json)


def simulators(as_json: AsJson = False) -> None:
    """List the simulators that run --simulator can name: what each can do, or how to install it."""
    with told(as_json):
        from scenewright.simulate.port import SIMULATORS

        _list_parts(SIMULATORS, as_json)


def _list_parts(kind: Kind[Any], as_json: bool) -> None:
    """Print what each part can do in the words of its capabilities, or what it misses."""
    from scenewright.cli import tables

    described = kind.words()
    if as_json:
        print_json(described)
        return
    stdout().print(tables.facts(described.items()))
    stdout().print(f"\nYour own: a package with an entry point in the group {kind.group}.")


def describe(road_map: RoadMap) -> dict[str, Any]:
    """Return a map as plain data: lanes, routes with landmarks, and where routes through one junction meet."""
    from scenewright.roads.conflicts import find_conflict
    from scenewright.roads.routes import all_routes

    routes = all_routes(road_map)
    junctions = [_junctions(road_map, route.lanes) for route in routes]
    conflicts = []
    for (a, one), (b, other) in combinations(enumerate(routes), 2):
        if not junctions[a] & junctions[b]:
            continue
        conflict = find_conflict(one, other)
        if conflict is not None:
            numbers = {"a_m": round(conflict.s_a_m, 3), "b_m": round(conflict.s_b_m, 3)}
            conflicts.append({"a": a + 1, "b": b + 1, "kind": conflict.kind, **numbers})
    return {
        "name": road_map.name,
        "notes": list(road_map.notes),
        "routes": [
            {
                "number": number,
                "headings": list(route.headings),
                "turn": route.turn,
                "from": route.origin_kind,
                "to": route.destination_kind,
                "lanes": list(route.lanes),
                "landmarks_m": {name: round(s_m, 3) for name, s_m in route.landmarks.items()},
            }
            for number, route in enumerate(routes, start=1)
        ],
        "conflicts": conflicts,
        "lanes": [
            {
                "id": lane.id,
                "kind": lane.kind,
                "length_m": round(lane.length_m, 3),
                "width_m": round(lane.width_m, 3),
                "speed_limit_mps": None if lane.speed_limit_mps is None else round(lane.speed_limit_mps, 3),
                "junction": lane.junction_id,
            }
            for lane in road_map.lanes.values()
        ],
    }


def _junctions(road_map: RoadMap, lanes: tuple[str, ...]) -> set[str]:
    return {junction for lane in lanes if (junction := road_map.lanes[lane].junction_id) is not None}


def _show(console: Console, described: dict[str, Any]) -> None:
    from scenewright.cli import tables

    routes = {route["number"]: route for route in described["routes"]}
    console.print(f"{described['name']}: routes; in metres along each: stop line, junction, end", style="bold")
    columns = _PLACES.values()
    made = tables.table("no", "headings", "turn", "from", "to", *columns, right=("no", *columns))
    for number, route in list(routes.items())[:_SHOWN]:
        places = (route["landmarks_m"].get(name) for name in _PLACES)
        made.add_row(
            str(number),
            ", ".join(route["headings"]),
            route["turn"],
            route["from"],
            route["to"],
            *("-" if s_m is None else f"{s_m:.1f}" for s_m in places),
        )
    console.print(made)
    _rest(console, len(routes), "routes")
    console.print("conflict points: where two routes meet, in metres along each", style="bold")
    made = tables.table("route", "and route", "kind", "m on first", "m on second", right=("m on first", "m on second"))
    for conflict in described["conflicts"][:_SHOWN]:
        a, b = routes[conflict["a"]], routes[conflict["b"]]
        made.add_row(_named(a), _named(b), conflict["kind"], f"{conflict['a_m']:.1f}", f"{conflict['b_m']:.1f}")
    console.print(made)
    _rest(console, len(described["conflicts"]), "conflict points")
    console.print("lanes", style="bold")
    made = tables.table("lane", "kind", "length m", "width m", "limit m/s", right=("length m", "width m", "limit m/s"))
    for lane in described["lanes"][:_SHOWN]:
        limit = lane["speed_limit_mps"]
        numbers = (f"{lane['length_m']:.1f}", f"{lane['width_m']:.1f}", "-" if limit is None else f"{limit:.1f}")
        made.add_row(lane["id"], lane["kind"], *numbers)
    console.print(made)
    _rest(console, len(described["lanes"]), "lanes")
    for note in described["notes"]:
        console.print(f"note: {note}", soft_wrap=True, markup=False)


def _named(route: dict[str, Any]) -> str:
    return f"{route['number']} ({', '.join(route['headings'])})"


def _rest(console: Console, count: int, what: str) -> None:
    if count > _SHOWN:
        console.print(f"... and {count - _SHOWN} more {what}; --json prints all")
