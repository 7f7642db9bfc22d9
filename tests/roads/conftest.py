"""The maps that the tests of roads run on: ours, and two made by others where they are at hand."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.roads import RoadMap, load_map

FOREIGN = Path(__file__).parents[2].parent / "shared" / "maps"
MAPS = ["t_intersection", "esmini/simple_3way_intersection", "esmini/fabriksgatan"]


def map_source(name: str) -> Path:
    """Return a map's file, or skip the test where it is not at hand."""
    if "/" not in name:
        return load_map(name).source
    source = FOREIGN / f"{name}.xodr"
    if not source.exists():
        pytest.skip(f"the map {name} is not beside the repository")
    return source


def any_map(name: str) -> RoadMap:
    return load_map(map_source(name))


@pytest.fixture
def t_map() -> RoadMap:
    return load_map("t_intersection")


@pytest.fixture(params=MAPS)
def road_map(request: pytest.FixtureRequest) -> RoadMap:
    return any_map(request.param)
