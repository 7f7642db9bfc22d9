"""Map readers are found by entry point and by the ending of a file, and imported when they are asked for."""

from __future__ import annotations

import sys
import tomllib
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from scenewright.errors import MapError, MissingExtraError
from scenewright.roads import RoadMap, load_map
from scenewright.roads.readers import GROUP, endings, reader_for

READER = """
from dataclasses import replace
from scenewright.roads import RoadMap, load_map

def read(source):
    word = source.read_text()
    if word == "broken":
        raise ZeroDivisionError("no lanes to divide by")
    if word in ("loose", "dots"):
        lanes = dict(load_map("t_intersection").lanes)
        first = next(iter(lanes.values()))
        changed = {"successors": ("9.9.9",)} if word == "loose" else {"centerline_xy": first.centerline_xy[:1]}
        return RoadMap(word, source, {**lanes, first.id: replace(first, **changed)})
    if word == "leaves":
        raise SystemExit(3)
    return replace(load_map("t_intersection"), name=word) if word != "nothing" else None
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of somebody else's, as an installer leaves it; one of its readers needs an extra that is not there."""
    (tmp_path / "wordmaps.py").write_text(READER, encoding="utf-8")
    (tmp_path / "wordmaps_apart.py").write_text("raise ImportError('nothing of this is to be imported')")
    about = tmp_path / "wordmaps-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: wordmaps\nVersion: 1.0\nProvides-Extra: deep\n"
        'Requires-Dist: numpy>=1; extra == "deep"\nRequires-Dist: no-such-library>=2; extra == "deep"\n'
    )
    points = f"[{GROUP}]\nword = wordmaps:read\ndeep = wordmaps_apart:read [deep]\nxodr = wordmaps_apart:read\n"
    (about / "entry_points.txt").write_text(f"{points}bad = wordmaps_apart:read\n")
    monkeypatch.syspath_prepend(tmp_path)
    for name in ("wordmaps", "wordmaps_apart"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return tmp_path


def test_the_reader_of_opendrive_is_registered_like_any_other() -> None:
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    ((name, value),) = project["entry-points"][GROUP].items()
    assert name == "xodr"
    module, _, function = value.partition(":")
    reader = reader_for(".xodr")
    assert reader is not None
    assert (reader.__module__, reader.__name__) == (module, function)
    assert reader_for(".XODR") is reader
    assert ".xodr" in endings()
    assert all(point.value == value for point in entry_points(group=GROUP) if point.name == name)


def test_a_package_brings_a_reader(package: Path) -> None:
    source = package / "town.word"
    source.write_text("mine")
    assert {".bad", ".deep", ".word", ".xodr"} <= set(endings())
    assert "wordmaps" not in sys.modules, "what is listed is not imported"
    road_map = load_map(source)
    assert isinstance(road_map, RoadMap)
    assert road_map.name == "mine"


def test_what_is_missing_is_found_without_importing_it(package: Path) -> None:
    source = package / "town.deep"
    source.write_text("mine")
    with pytest.raises(MissingExtraError, match=r"no-such-library.*\n.*pip install \"wordmaps\[deep\]\""):
        load_map(source)
    assert "wordmaps_apart" not in sys.modules


def test_no_package_takes_the_place_of_ours(package: Path) -> None:
    assert package.is_dir()
    assert load_map(load_map("t_intersection").source).lanes


@pytest.mark.parametrize(
    ("name", "word", "message", "found"),
    [
        ("a.word", "broken", "failed on this one", "ZeroDivisionError: no lanes to divide by"),
        ("g.word", "loose", "failed on this one", "is linked to 9.9.9, which is not there"),
        ("h.word", "dots", "failed on this one", "is not drawn by two finite points or more"),
        ("f.word", "leaves", "failed on this one", "SystemExit: 3"),
        ("b.word", "nothing", "failed on this one", "it returned a NoneType"),
        ("c.bad", "mine", "cannot be imported", "ImportError: nothing of this"),
        ("d.none", "mine", "not a kind of map that can be read", "'.none'"),
        ("e", "mine", "not a kind of map that can be read", "'nothing'"),
    ],
)
def test_readers_that_fail_are_named(package: Path, name: str, word: str, message: str, found: str) -> None:
    source = package / name
    source.write_text(word)
    with pytest.raises(MapError, match=message) as caught:
        load_map(source)
    assert found in str(caught.value.found)
    assert caught.value.expected
    assert caught.value.fix


@pytest.mark.parametrize("name", ["x" * 100_000, "a\0b.xodr", "", "\udcff.xodr"])
def test_names_that_no_file_has(name: str) -> None:
    with pytest.raises(MapError, match="there is no such map") as caught:
        load_map(name)
    assert len(str(caught.value)) < 6_000
