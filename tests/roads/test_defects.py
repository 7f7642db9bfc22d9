"""Maps with defects, made from maps without: each loads with notes, or is refused by a message, and never in vain."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from lxml import etree

from scenewright.errors import MapError
from scenewright.roads import RoadMap, all_routes, load_map
from scenewright.roads.defects import Defects

from .conftest import FOREIGN, map_source

Element = etree._Element
SMALL = ["t_intersection", "esmini/simple_3way_intersection", "esmini/highway_exit", "ncap/X-Intersection_NCAP"]
BROKE = "tell those who offer the reader, with the file"
MALFORMED = sorted(f"malformed/{path.stem}" for path in FOREIGN.glob("malformed/*.xodr"))


def one_of(chance: random.Random, found: Sequence[Element]) -> Element:
    """Return an element that is to be spoilt, one of no map where there is none of its kind."""
    return chance.choice(found or [etree.SubElement(etree.Element("none"), "none")])


def drop(element: Element) -> None:
    parent = element.getparent()
    assert parent is not None
    parent.remove(element)


def drop_a_road(root: Element, chance: random.Random) -> None:
    drop(one_of(chance, root.findall("road")))


def shift_a_section_by_micrometres(root: Element, chance: random.Random) -> None:
    section = one_of(chance, root.findall(".//laneSection"))
    section.set("s", repr(float(section.get("s", "0")) + chance.uniform(-1e-6, 1e-6)))


def double_a_section(root: Element, chance: random.Random) -> None:
    section = one_of(chance, root.findall(".//laneSection"))
    again = etree.fromstring(etree.tostring(section))
    again.set("s", repr(float(section.get("s", "0")) + chance.choice([0.0, 3e-7, 1e-6, 1e-3])))
    section.addnext(again)


def shuffle_the_sections(root: Element, chance: random.Random) -> None:
    for lanes in root.findall("road/lanes"):
        sections = lanes.findall("laneSection")
        chance.shuffle(sections)
        lanes.extend(sections)


def drop_a_link(root: Element, chance: random.Random) -> None:
    found = root.findall(".//successor") + root.findall(".//predecessor") + root.findall(".//laneLink")
    drop(one_of(chance, found))


def link_to_a_lane_that_is_not_there(root: Element, chance: random.Random) -> None:
    one_of(chance, root.findall(".//lane/link/*")).set("id", str(chance.choice([-9, 7])))
    for link in root.findall(".//laneLink")[:1]:
        link.set("to", "23")


def link_to_a_road_that_is_not_there(root: Element, chance: random.Random) -> None:
    linked = [element for element in root.iter("predecessor", "successor") if element.get("elementId")]
    one_of(chance, linked).set("elementId", "nowhere")


def flatten_a_piece(root: Element, chance: random.Random) -> None:
    piece = one_of(chance, root.findall(".//geometry"))
    again = etree.fromstring(etree.tostring(piece))
    again.set("length", chance.choice(["0", "1e-9", "1e-300"]))
    piece.addprevious(again)


def shrink_a_road(root: Element, chance: random.Random) -> None:
    road = one_of(chance, root.findall("road"))
    for element in (road, *road.findall(".//geometry")):
        element.set("length", chance.choice(["0", "1e-7"]))
    for section in road.findall(".//laneSection"):
        section.set("s", "0")


def spoil_a_number(root: Element, chance: random.Random) -> None:
    element = chance.choice([e for e in root.iter() if e.attrib])
    name = chance.choice(sorted(str(key) for key in element.attrib))
    element.set(name, chance.choice(["1e300", "-1e300", "nan", "inf", "-5", "0", "", "1e9", "999999999", "x"]))


def bend_a_piece(root: Element, chance: random.Random) -> None:
    piece = one_of(chance, root.findall(".//geometry"))
    piece[:] = [etree.Element("arc", curvature=chance.choice(["1e9", "-1e9", "1e-300", "5"]))]


DEFECTS: list[Callable[[Element, random.Random], None]] = [
    drop_a_road,
    shift_a_section_by_micrometres,
    double_a_section,
    shuffle_the_sections,
    drop_a_link,
    link_to_a_lane_that_is_not_there,
    link_to_a_road_that_is_not_there,
    flatten_a_piece,
    shrink_a_road,
    spoil_a_number,
    bend_a_piece,
]


def written(folder: Path, root: Element) -> Path:
    source = folder / f"spoilt{len(list(folder.iterdir()))}.xodr"
    source.write_bytes(etree.tostring(root))
    return source


def read_or_told(source: Path) -> RoadMap | None:
    """Return the map, sound in itself, or None where it is refused as the house does."""
    try:
        road_map = load_map(source)
    except MapError as error:
        told = (error.place, error.found, error.expected, error.fix)
    else:
        told = None
    if told is not None:
        assert all(told)
        assert told[3] != BROKE, "a fault of the reader, not of the map"
        return None
    for lane in road_map.lanes.values():
        assert np.all(np.isfinite(lane.centerline_xy))
        assert lane.length_m > 0.0
        for name in (*lane.successors, *lane.predecessors, lane.left_neighbor, lane.right_neighbor):
            assert name is None or name in road_map.lanes
        assert all(lane.id in road_map.lanes[name].predecessors for name in lane.successors)
    assert len(road_map.notes) <= 8, "one line for each kind, however many there are"
    return road_map


@pytest.mark.parametrize("defect", DEFECTS, ids=lambda defect: defect.__name__)
@pytest.mark.parametrize("name", [*SMALL, *MALFORMED])
def test_a_map_with_defects_is_read_with_notes_or_refused(
    name: str, defect: Callable[[Element, random.Random], None], tmp_path: Path
) -> None:
    text = map_source(name).read_bytes()
    for seed in range(6):
        chance = random.Random(seed)
        root = etree.fromstring(text)
        for _ in range(chance.choice([1, 1, 3])):
            defect(root, chance)
        read_or_told(written(tmp_path, root))


def test_lane_sections_of_a_micrometre_are_passed_over(shared_dir: Path) -> None:
    road_map = load_map(shared_dir / "cases" / "near-zero-lane-sections.xodr")
    assert road_map.lanes["1.0.-1"].successors == ("1.2.-1",)
    assert road_map.lanes["1.2.-1"].predecessors == ("1.0.-1",)
    (note,) = road_map.notes
    assert "passed over" in note
    assert "1.1.-1" in note


def test_a_road_ends_where_the_next_one_was_cut_away(shared_dir: Path) -> None:
    road_map = load_map(shared_dir / "cases" / "cut-out-map.xodr")
    assert len(road_map.lanes) == 2
    assert road_map.notes == ("roads end where they are linked to roads that are not in the file: road 1 to road 7",)


@pytest.mark.parametrize("at_m", ["0", "40", "300"])
@pytest.mark.parametrize("count", [1, 3])
def test_short_sections_change_no_route(at_m: str, count: int, tmp_path: Path) -> None:
    """At a road's beginning, within it and at its end, one or several in a row: traffic drives on as before."""
    ours = load_map("t_intersection")
    root = etree.fromstring(ours.source.read_bytes())
    for road in (road for road in root.findall("road") if road.get("junction") == "-1"):
        lanes = road.find("lanes")
        assert lanes is not None
        (whole,) = lanes.findall("laneSection")
        starts = [min(float(at_m), float(road.get("length", "0"))) + 4e-7 * i for i in range(count)]
        for start in [*starts[: None if at_m != "0" else 0], *([] if at_m == "0" else [starts[-1] + 4e-7])]:
            lanes.append(_section_between(whole, start))
        if at_m == "0":
            for i in range(count):
                lanes.append(_section_between(whole, 4e-7 * (i + 1)))
        _link_in_a_row(lanes.findall("laneSection"))
    road_map = load_map(written(tmp_path, root))
    assert [route.headings for route in all_routes(road_map)] == [route.headings for route in all_routes(ours)]
    assert len(road_map.notes) == 1


def _section_between(whole: Element, start_m: float) -> Element:
    section = etree.fromstring(etree.tostring(whole))
    section.set("s", repr(start_m))
    return section


def _link_in_a_row(sections: list[Element]) -> None:
    """Link each lane to that of the same number in the sections beside; links to other roads stay at the ends."""
    for index, section in enumerate(sections):
        for lane in section.iter("lane"):
            link = lane.find("link")
            if link is None:
                link = etree.SubElement(lane, "link")
                lane.insert(0, link)
            for tag, inside in (("predecessor", index > 0), ("successor", index < len(sections) - 1)):
                if inside and lane.get("id") != "0":
                    for old in link.findall(tag):
                        link.remove(old)
                    etree.SubElement(link, tag, id=str(lane.get("id")))


def test_sections_out_of_order_are_read_in_order(tmp_path: Path) -> None:
    source = map_source("esmini/highway_exit")
    root = etree.fromstring(source.read_bytes())
    shuffle_the_sections(root, random.Random(1))
    road_map = load_map(written(tmp_path, root))
    assert {i: lane.successors for i, lane in road_map.lanes.items()} == {
        i: lane.successors for i, lane in load_map(source).lanes.items()
    }
    assert any("in order of s" in note for note in road_map.notes)


def test_a_road_ends_where_its_junction_was_cut_away(tmp_path: Path) -> None:
    text = load_map("t_intersection").source.read_text(encoding="utf-8")
    source = tmp_path / "cut.xodr"
    source.write_text(re.sub(r'(elementType="junction" elementId=)"[^"]*"', r'\1"99"', text, count=1), encoding="utf-8")
    (note,) = load_map(source).notes
    assert re.fullmatch(r"roads end where they are linked to junctions .*: road \w+ to junction 99", note)


def test_links_to_what_is_not_there_are_told_once_for_all(tmp_path: Path) -> None:
    text = load_map("t_intersection").source.read_text(encoding="utf-8")
    text = re.sub(r'<laneLink from="(-?1)" to="-?1"/>', r'<laneLink from="\1" to="-4"/>', text)
    source = tmp_path / "cut.xodr"
    source.write_text(text.replace('incomingRoad="2"', 'incomingRoad="77"'), encoding="utf-8")
    connections, lanes = load_map(source).notes
    assert "77 to" in connections
    assert "links to lanes that are not in the file" in lanes


HEAD = '<?xml version="1.0"?>'
BOMB = "".join(f'<!ENTITY {name} "{f"&{before};" * 10}">' for before, name in zip("abcdefgh", "bcdefghi", strict=True))


@pytest.mark.parametrize(
    "text",
    [
        f'{HEAD}<!DOCTYPE OpenDRIVE [<!ENTITY a "aaaaaaaaaa">{BOMB}]><OpenDRIVE><road name="&i;"/></OpenDRIVE>',
        f'{HEAD}<!DOCTYPE OpenDRIVE [<!ENTITY a "aaaaaaaaaa">{BOMB}]><OpenDRIVE><road>&i;</road></OpenDRIVE>',
        "<OpenDRIVE>" + "<road>" * 100_000,
        "<OpenDRIVE>" + "<road>" * 100_000 + "</road>" * 100_000 + "</OpenDRIVE>",
        "<OpenDRIVE " + " ".join(f'a{i}="1"' for i in range(50_000)) + "/>",
        "\x00" * 10_000,
        "<OpenDRIVE/>",
    ],
    ids=["bomb in an attribute", "bomb in a text", "open", "deep", "wide", "zeros", "nothing"],
)
def test_xml_that_is_an_attack_is_refused(text: str, tmp_path: Path) -> None:
    source = tmp_path / "spoilt.xodr"
    source.write_text(text, encoding="utf-8")
    assert read_or_told(source) is None


def test_a_long_spiral_is_read_as_quickly_as_a_short_one(tmp_path: Path) -> None:
    geometry = '<geometry s="0" x="0" y="0" hdg="0" length="90000"><spiral curvStart="0" curvEnd="1e-5"/></geometry>'
    lane = '<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>'
    source = tmp_path / "spiral.xodr"
    source.write_text(
        f'<OpenDRIVE><road id="1" length="90000" junction="-1"><planView>{geometry}</planView>'
        f'<lanes><laneSection s="0"><right>{lane}</right></laneSection></lanes></road></OpenDRIVE>',
        encoding="utf-8",
    )
    assert load_map(source).lanes["1.0.-1"].length_m == pytest.approx(90_000, rel=1e-4)


def test_a_note_names_the_first_places_and_counts_the_others() -> None:
    defects = Defects()
    for number in range(8):
        defects.add("lanes are left out", f"lane {number}")
        defects.add("lanes are left out", f"lane {number}")
    assert defects.notes() == ("lanes are left out: lane 0; lane 1; lane 2; lane 3; lane 4; and 3 more",)
