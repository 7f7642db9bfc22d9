"""Maps by name and by file: which there are, which kinds, read once and anew where the file was edited."""

from __future__ import annotations

from pathlib import Path

from scenewright.roads import load_map

from .conftest import OURS, refused


def test_a_missing_map_names_the_shipped_ones(tmp_path: Path) -> None:
    assert "t_intersection" in str(refused(tmp_path / "nowhere.xodr").expected)
    assert "did you mean 't_intersection'" in str(refused(Path("t_intersecton")).fix)
    assert "folder" in str(refused(tmp_path).found)


def test_another_kind_of_file_is_named(tmp_path: Path) -> None:
    other = tmp_path / "map.osm"
    other.write_text("<osm/>")
    assert "'.osm'" in str(refused(other).found)


def test_an_edited_map_is_read_anew(tmp_path: Path) -> None:
    import os

    source = tmp_path / "edited.xodr"
    source.write_text(OURS, encoding="utf-8")
    before = load_map(source)
    source.write_text(OURS.replace('name="driveway"', 'name="lane"').replace("lowSpeed", "town"), encoding="utf-8")
    os.utime(source, ns=(0, before.source.stat().st_mtime_ns + 1_000_000_000))
    assert {lane.kind for lane in load_map(source).lanes.values()} == {"road"}


def test_a_map_is_read_once() -> None:
    assert load_map("t_intersection") is load_map("t_intersection")
