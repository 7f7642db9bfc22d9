"""Tells a model what is on one map: the ways that there are, their places, and where two of them meet.

What enters: a `RoadMap`. What leaves: text. Nothing is told that the map does not hold; of a large map only the first
ways are, and it is said so.
"""

from __future__ import annotations

from itertools import combinations

from scenewright.roads.conflicts import find_conflict
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route, all_routes
from scenewright.translate.phrases import COMPASS_WORDS, PLACES

# What a prompt tells of a large map: some thousand tokens of it, and that there is more.
_MOST_WAYS = 60
_MOST_PAIRS = 150
_OWN = ("stop_line", "turn_start", "turn_end", "junction_start", "junction_end", "route_end")
_HOW = {"crossing": "cross", "merging": "come together into one lane", "following": "begin on one lane, and part"}


def map_facts(road_map: RoadMap) -> str:
    """Return ways, places and meetings of `road_map` as lines of text.

    Examples
    --------
    >>> from scenewright.roads.load import load_map
    >>> print(map_facts(load_map("t_intersection")).splitlines()[1])
    - 1: from the road, heading west, straight on, into the road, then west
    """
    ways = all_routes(road_map)
    shown = ways[:_MOST_WAYS]
    lines = [f"Map: {road_map.name}. The ways that there are:"]
    lines += [f"- {number}: {_told(way)}" for number, way in enumerate(shown, start=1)]
    lines += [f"- and {len(ways) - len(shown)} more, which this list leaves out"] if len(ways) > len(shown) else []
    met = [
        f"- {one} and {other} {_HOW[conflict.kind]}"
        for (one, first), (other, second) in combinations(enumerate(shown, start=1), 2)
        if _junctions(road_map, first) & _junctions(road_map, second)
        if (conflict := find_conflict(first, second)) is not None
    ]
    lines += ["Which of them meet, each pair in its conflict point:", *met[:_MOST_PAIRS]]
    lines += [f"- and {len(met) - _MOST_PAIRS} more pairs"] if len(met) > _MOST_PAIRS else []
    return "\n".join([*lines, "- no others: between those there is no conflict point, no gap and no time to collision"])


def _told(way: Route) -> str:
    turn = "straight on" if way.turn == "straight" else f"turns {way.turn}"
    first, last = (COMPASS_WORDS[heading] for heading in (way.headings[0], way.headings[-1]))
    missing = [PLACES[name] for name in _OWN if name not in way.landmarks]
    none = f"; it has no {', no '.join(missing)}" if missing else ""
    return f"from the {way.origin_kind}, heading {first}, {turn}, into the {way.destination_kind}, then {last}{none}"


def _junctions(road_map: RoadMap, way: Route) -> set[str]:
    return {name for lane in way.lanes if (name := road_map.lanes[lane].junction_id) is not None}
