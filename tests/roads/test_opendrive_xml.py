"""What a file says wrongly is found where it lies, with its line."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scenewright.roads import load_map

from .conftest import FOREIGN, OURS, broken, map_source, refused


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


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


@pytest.mark.parametrize("name", sorted(path.stem for path in FOREIGN.glob("malformed/*.xodr")) or ["absent"])
def test_files_that_broke_a_reader_once_are_explained(name: str) -> None:
    error = refused(map_source(f"malformed/{name}"))
    assert error.place is not None
    assert error.place.line is not None


@pytest.mark.parametrize(("kind", "limit_kmph"), [("motorway", 130), ("rural", 100), ("town", None)])
def test_a_road_that_tells_no_limit_has_that_of_its_kind(tmp_path: Path, kind: str, limit_kmph: int | None) -> None:
    source = tmp_path / "kind.xodr"
    text = re.sub(r'<type ([^>]*)type="[^"]*">\s*<speed [^>]*/>', rf'<type \1type="{kind}">', OURS)
    assert f'type="{kind}"' in text
    source.write_text(text, encoding="utf-8")
    road_map = load_map(source)
    limits = {lane.speed_limit_mps for lane in road_map.lanes.values()}
    assert limits == {None if limit_kmph is None else limit_kmph / 3.6}
    assert any("no speed limit" in note for note in road_map.notes) == (limit_kmph is not None)
