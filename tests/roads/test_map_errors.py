"""What is said of maps that are missing, broken or of another kind."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.errors import MapError
from scenewright.roads import load_map

from .conftest import FOREIGN, map_source

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


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


def test_a_missing_map_names_the_shipped_ones(tmp_path: Path) -> None:
    assert "t_intersection" in str(refused(tmp_path / "nowhere.xodr").expected)
    assert "did you mean 't_intersection'" in str(refused(Path("t_intersecton")).fix)
    assert "folder" in str(refused(tmp_path).found)


def test_another_kind_of_file_is_named(tmp_path: Path) -> None:
    other = tmp_path / "map.osm"
    other.write_text("<osm/>")
    assert "'.osm'" in str(refused(other).found)


@pytest.mark.parametrize("text", ["", "not xml at all", OURS[: len(OURS) // 2], OURS.replace("</planView>", "", 1)])
def test_what_is_not_xml(tmp_path: Path, text: str) -> None:
    assert "not well-formed XML" in broken(tmp_path, text).message


def test_what_is_xml_but_not_opendrive(tmp_path: Path) -> None:
    assert broken(tmp_path, "<commonRoad/>").found == "root element <commonRoad>"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('curvStart="0"', 'curvStart="zero"', "not a number"),
        ('curvStart="0"', 'curvStart="nan"', "not a number"),
        ('curvStart="0" ', "", "lacks the attribute 'curvStart'"),
        ("<arc ", "<clothoid ", "shape that is not known"),
        ('curvStart="0"', 'curvStart="1e300"', "larger than any map"),
        ('length="300.0000000000" id="1"', 'length="1e8" id="1"', "longer than any road"),
        ('length="300.0000000000" id="1"', 'length="200" id="1"', "differ"),
        ('length="300.0000000000" id="1"', 'length="-3" id="1"', "has no length"),
        ('unit="km/h"', 'unit="knots"', "unit is not known"),
        ('<laneSection s="0">', '<laneSection s="999">', "lane section has no length"),
        ('<lane id="-1" type="driving"', '<lane id="5" type="driving"', "wrong side"),
        ('<width sOffset="0" a="3.5" b="0" c="0" d="0"/>', "", "has no width"),
        ('<predecessor id="1"/>', '<predecessor id="0"/>', "linked to the centre lane"),
        ('length="300.0000000000" id="2"', 'length="300.0000000000" id="1"', "two roads have the id"),
    ],
)
def test_a_fault_is_found_where_it_lies(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in OURS
    error = broken(tmp_path, OURS.replace(old, new, 1))
    assert message in error.message
    assert error.place is not None
    assert error.place.line is not None
    assert abs(error.place.line - line_of(OURS, old)) <= 1


def test_a_reference_line_with_a_jump(tmp_path: Path) -> None:
    second = OURS.split("<geometry ")[6]
    x = second.split('x="')[1].split('"')[0]
    moved = OURS.replace(second, second.replace(f'x="{x}"', f'x="{float(x) + 5.0}"', 1))
    assert "jumps" in broken(tmp_path, moved).message


def test_a_map_without_roads_or_lanes(tmp_path: Path) -> None:
    assert "no roads" in broken(tmp_path, "<OpenDRIVE><header/></OpenDRIVE>").message
    assert "no driving lanes" in broken(tmp_path, OURS.replace('type="driving"', 'type="sidewalk"')).message


def test_lanes_that_do_not_meet_are_not_joined_and_noted(tmp_path: Path) -> None:
    source = tmp_path / "moved.xodr"
    source.write_text(OURS.replace('x="-314.0000000000"', 'x="-334.0000000000"', 1), encoding="utf-8")
    road_map = load_map(source)
    assert road_map.lanes["1.0.-1"].successors == ()
    assert any("20.0 m apart" in note for note in road_map.notes)


def test_entities_are_not_expanded(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret words")
    head = f'<?xml version="1.0"?><!DOCTYPE OpenDRIVE [<!ENTITY x SYSTEM "{secret.as_uri()}">]>'
    assert "secret words" not in str(broken(tmp_path, f"{head}<OpenDRIVE><road>&x;</road></OpenDRIVE>"))


@pytest.mark.parametrize("name", sorted(path.stem for path in FOREIGN.glob("malformed/*.xodr")) or ["absent"])
def test_files_that_broke_a_reader_once_are_explained(name: str) -> None:
    error = refused(map_source(f"malformed/{name}"))
    assert error.place is not None
    assert error.place.line is not None


def test_an_edited_map_is_read_anew(tmp_path: Path) -> None:
    import os

    source = tmp_path / "edited.xodr"
    source.write_text(OURS, encoding="utf-8")
    before = load_map(source)
    source.write_text(OURS.replace('name="driveway"', 'name="lane"').replace("lowSpeed", "town"), encoding="utf-8")
    os.utime(source, ns=(0, before.source.stat().st_mtime_ns + 1_000_000_000))
    assert {lane.kind for lane in load_map(source).lanes.values()} == {"road"}
