"""The maps that the tests of roads run on: ours, two made by others where they are at hand, and broken ones."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.errors import MapError
from scenewright.roads import RoadMap, load_map

FOREIGN = Path(__file__).parents[2].parent / "shared" / "maps"
ALL_FOREIGN = sorted(str(p.relative_to(FOREIGN).with_suffix("")) for p in FOREIGN.glob("*/*.xodr"))
READABLE = ["t_intersection", *(name for name in ALL_FOREIGN if not name.startswith("malformed"))]
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


OURS = load_map("t_intersection").source.read_text(encoding="utf-8")


def refused(source: Path) -> MapError:
    with pytest.raises(MapError) as caught:
        load_map(source)
    for part in (caught.value.found, caught.value.expected, caught.value.fix):
        assert part
    return caught.value


def broken(tmp_path: Path, text: str) -> MapError:
    source = tmp_path / "broken.xodr"
    source.write_text(text, encoding="utf-8")
    error = refused(source)
    assert error.place is not None
    assert error.place.name == "broken.xodr"
    return error
