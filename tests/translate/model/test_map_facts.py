"""What a model is told of a map is what is on it."""

from __future__ import annotations

import re
from pathlib import Path

from scenewright.roads.load import load_map
from scenewright.roads.routes import all_routes, find_routes
from scenewright.translate.model.map_facts import map_facts

T_INTERSECTION = load_map("t_intersection")


def test_map_is_told_as_it_is() -> None:
    told = map_facts(T_INTERSECTION)
    ways = re.findall(
        r"^- \d+: from the (\w+), heading (\w)\w+, (?:turns )?(\w+)[ ,].*?the (\w+), then (\w)", told, re.MULTILINE
    )
    assert len(ways) == len(all_routes(T_INTERSECTION)) == 6
    for origin, heading, turn, destination, end in ways:
        kinds = find_routes(T_INTERSECTION, origin_kind=origin, turn=turn, destination_kind=destination)  # type: ignore[arg-type]
        assert any((each.headings[0], each.headings[-1]) == (heading.upper(), end.upper()) for each in kinds)
    assert "come together into one lane" in told


def test_large_map_is_cut_and_said_to_be(shared_dir: Path) -> None:
    told = map_facts(load_map(shared_dir / "maps" / "carla" / "Town01.xodr"))
    assert "more, which this list leaves out" in told
    assert len(told) < 20_000
