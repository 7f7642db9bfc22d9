"""Read an OpenDRIVE file (1.4 to 1.8) into records, and refuse what is broken with line, finding and remedy.

What enters: a path. What leaves: an `OpenDriveRecord`. This module does not sample geometry or link lanes, and it reads
no elevation: the world is flat here.
"""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np

from scenewright.errors import MapError, Place
from scenewright.roads.defects import Defects
from scenewright.roads.opendrive_file import Element, parse_opendrive
from scenewright.roads.opendrive_records import (
    ConnectionRecord,
    Cubic,
    LaneRecord,
    OpenDriveRecord,
    RoadLink,
    RoadRecord,
    RoadTypeRecord,
    SectionRecord,
    StopLineRecord,
)
from scenewright.roads.reference_line import Geometry, Shape

# No place on earth is further from another, and no road is longer: beyond lies a mistake, or an attack on memory.
_LARGEST_NUMBER = 1e9
_LONGEST_ROAD_M = 1e5
_SHORTEST_PIECE_M = 1e-6  # rates of change along anything shorter would overflow
_LONGEST_LANES_M = 1e7
_SPEED_UNITS_MPS = {"m/s": 1.0, "km/h": 1.0 / 3.6, "kmh": 1.0 / 3.6, "kph": 1.0 / 3.6, "mph": 0.44704}
# Where a road tells its type and no limit; other types are taken for roads in town. From Germany:
# Autobahn-Richtgeschwindigkeits-V, 1 (130 km/h), and StVO, 3 (3) (100 km/h outside of towns).
_USUAL_KMPH = {"motorway": 130, "rural": 100}
_SHAPE_ATTRIBUTES: dict[Shape, tuple[str, ...]] = {
    "line": (),
    "arc": ("curvature",),
    "spiral": ("curvStart", "curvEnd"),
    "poly3": ("a", "b", "c", "d"),
    "paramPoly3": ("aU", "bU", "cU", "dU", "aV", "bV", "cV", "dV"),
}
_STOP_LINE_SIGNAL = "294"  # German road-marking catalogue, the one OpenDRIVE exporters use


def read_opendrive(source: Path, defects: Defects) -> OpenDriveRecord:
    """Read a file.

    Parameters
    ----------
    source
        Path of an ``.xodr`` file.
    defects
        Takes what is mended or left out on the way.

    Raises
    ------
    MapError
        If the file is missing, is not XML, is not OpenDRIVE, or contradicts itself.
    """
    return _FileReader(source.name, defects).read(parse_opendrive(source))


def _length_tolerance_m(road_length: float) -> float:
    return max(0.1, 0.001 * road_length)


def _tag(at: Element) -> str:
    return str(at.tag)


class _FileReader:
    """Holds the file's name for messages; every method turns one kind of element into its record."""

    def __init__(self, name: str, defects: Defects) -> None:
        self.name = name
        self.defects = defects

    def fault(self, message: str, at: Element, *, found: str, expected: str, fix: str) -> MapError:
        return MapError(message, place=Place(self.name, line=at.sourceline), found=found, expected=expected, fix=fix)

    def text(self, at: Element, attribute: str) -> str:
        value = at.get(attribute)
        if value is None:
            raise self.fault(
                f"<{_tag(at)}> lacks the attribute {attribute!r}",
                at,
                found="attributes " + (", ".join(str(key) for key in at.attrib) or "none"),
                expected=f'{attribute}="..."',
                fix=f"add {attribute} to this <{_tag(at)}> or export the map again",
            )
        return value

    def number(self, at: Element, attribute: str, default: float | None = None) -> float:
        if default is not None and at.get(attribute) is None:
            return default
        text = self.text(at, attribute)
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not abs(value) <= _LARGEST_NUMBER:
            finite = math.isfinite(value)
            raise self.fault(
                f"{attribute} of <{_tag(at)}> is " + ("larger than any map" if finite else "not a number"),
                at,
                found=repr(text),
                expected=f"a number up to {_LARGEST_NUMBER:g} in size" if finite else "a finite number",
                fix="correct the value or export the map again",
            )
        return value

    def integer(self, at: Element, attribute: str) -> int:
        value = self.number(at, attribute)
        if value != int(value):
            raise self.fault(
                f"{attribute} of <{_tag(at)}> is not a whole number",
                at,
                found=repr(at.get(attribute)),
                expected="a whole number",
                fix="correct the value or export the map again",
            )
        return int(value)

    def length(self, at: Element) -> float:
        value = self.number(at, "length")
        if not 0.0 <= value <= _LONGEST_ROAD_M:
            raise self.fault(
                f"<{_tag(at)}> has no length" if value < 0.0 else f"<{_tag(at)}> is longer than any road",
                at,
                found=f"length {value:g} m",
                expected=f"a length from 0 to {_LONGEST_ROAD_M:g} m",
                fix=f"remove this <{_tag(at)}> or correct its length",
            )
        return value

    def child(self, at: Element, tag: str) -> Element:
        found = at.find(tag)
        if found is None:
            raise self.fault(
                f"<{_tag(at)}> lacks <{tag}>",
                at,
                found="children " + (", ".join(f"<{_tag(child)}>" for child in at) or "none"),
                expected=f"<{tag}>",
                fix="complete the element or export the map again",
            )
        return found

    def read(self, root: Element) -> OpenDriveRecord:
        roads = tuple(self.road(road) for road in root.findall("road"))
        if not roads:
            raise self.fault(
                "the map has no roads",
                root,
                found="no <road>",
                expected="at least one <road>",
                fix="export the map with its roads",
            )
        seen: dict[str, int] = {}
        for element, record in zip(root.findall("road"), roads, strict=True):
            if record.id in seen:
                raise self.fault(
                    f"two roads have the id {record.id!r}",
                    element,
                    found=f"the first stands in line {seen[record.id]}",
                    expected="one road for each id",
                    fix="rename one of them and the links to it",
                )
            seen[record.id] = record.line
        lanes_m = sum(len(s.lanes) * (s.end_m - s.start_m) for record in roads for s in record.sections)
        if lanes_m > _LONGEST_LANES_M:
            raise self.fault(
                "the map has more lanes than can be read",
                root,
                found=f"{lanes_m / 1000:,.0f} km of lanes",
                expected=f"at most {_LONGEST_LANES_M / 1000:,.0f} km",
                fix="cut out the part of the map that the scenario is about",
            )
        connections = [
            self.connection(junction, connection)
            for junction in root.findall("junction")
            for connection in junction.findall("connection")
        ]
        return OpenDriveRecord(roads, tuple(record for record in connections if record is not None))

    def road(self, at: Element) -> RoadRecord:
        length = self.length(at)
        junction = at.get("junction", "-1")
        lanes, types = self.child(at, "lanes"), self.types(at)
        found, changes_m = self.sections(lanes, length, self.text(at, "id")), [each.start_m for each in types]
        link = at.find("link")
        return RoadRecord(
            id=self.text(at, "id"),
            name=at.get("name", ""),
            length_m=length,
            junction_id=None if junction == "-1" else junction,
            right_hand=at.get("rule", "RHT") != "LHT",
            geometries=self.plan_view(at, length),
            lane_offsets=self.cubics(lanes, "laneOffset", "s"),
            sections=tuple(each for section in found for each in section.parts(changes_m)),
            types=types,
            predecessor=None if link is None else self.road_link(link.find("predecessor")),
            successor=None if link is None else self.road_link(link.find("successor")),
            stop_lines=self.stop_lines(at),
            user_kind=next((data.get("value") for data in at.findall("userData") if data.get("code") == "kind"), None),
            line=at.sourceline or 0,
        )

    def plan_view(self, road: Element, road_length: float) -> tuple[Geometry, ...]:
        read = [self.geometry(piece) for piece in self.child(road, "planView").findall("geometry")]
        pieces = sorted((piece for piece in read if piece.length_m > _SHORTEST_PIECE_M), key=lambda piece: piece.s_m)
        if len(pieces) < len(read):
            self.defects.add("pieces of a reference line that have no length are left out", f"road {road.get('id')}")
        total = sum(piece.length_m for piece in pieces)
        if abs(total - road_length) > _length_tolerance_m(road_length):
            raise self.fault(
                "the road's length and the length of its reference line differ",
                road,
                found=f"road {road_length:g} m, geometry {total:g} m in {len(pieces)} pieces",
                expected="equal lengths",
                fix="correct the road's length attribute or complete its <planView>",
            )
        for before, after in pairwise(pieces):
            end = before.poses(np.array([before.length_m]))[0]
            jump = math.hypot(after.x_m - end[0], after.y_m - end[1])
            if jump > 0.5:
                raise MapError(
                    "the road's reference line jumps",
                    place=Place(self.name, line=after.line),
                    found=f"a gap of {jump:.2f} m before this <geometry>",
                    expected="a piece that starts where the one before ends",
                    fix="correct x and y of this <geometry> or the length of the one before",
                )
        return tuple(pieces)

    def geometry(self, at: Element) -> Geometry:
        length = self.length(at)
        for shape, attributes in _SHAPE_ATTRIBUTES.items():
            piece = at.find(shape)
            if piece is None:
                continue
            values = tuple(self.number(piece, attribute) for attribute in attributes)
            if shape == "paramPoly3":
                values += (length if piece.get("pRange") == "arcLength" else 1.0,)
            x, y, heading, s = (self.number(at, attribute) for attribute in ("x", "y", "hdg", "s"))
            return Geometry(s, x, y, heading, length, shape, values, at.sourceline or 0)
        raise self.fault(
            "the geometry has a shape that is not known",
            at,
            found=", ".join(f"<{_tag(child)}>" for child in at) or "an empty <geometry>",
            expected="one of " + ", ".join(f"<{shape}>" for shape in _SHAPE_ATTRIBUTES),
            fix="export the map with one of these shapes",
        )

    def cubics(self, at: Element, tag: str, start: str) -> tuple[Cubic, ...]:
        found = [
            Cubic(self.number(item, start), *(self.number(item, name) for name in ("a", "b", "c", "d")))
            for item in at.findall(tag)
        ]
        return tuple(sorted(found, key=lambda cubic: cubic.start_m))

    def sections(self, lanes: Element, road_length: float, road_id: str) -> tuple[SectionRecord, ...]:
        elements = lanes.findall("laneSection")
        if not elements:
            self.child(lanes, "laneSection")
        starts = [max(0.0, self.number(element, "s")) for element in elements]
        if starts != sorted(starts):
            self.defects.add("lane sections are read in order of s", f"road {road_id}")
        order = sorted(range(len(starts)), key=starts.__getitem__)
        beyond = starts[order[-1]] - road_length
        if beyond > _length_tolerance_m(road_length):
            raise self.fault(
                "the lane section has no length",
                elements[order[-1]],
                found=f"it starts at s = {starts[order[-1]]:g} m, the road ends at {road_length:g} m",
                expected="sections that start inside the road",
                fix="remove the section or correct its s",
            )
        ends = [*(starts[i] for i in order[1:]), max(road_length, starts[order[-1]])]
        return tuple(
            SectionRecord(starts[i], end, self.lanes(elements[i]), elements[i].sourceline or 0)
            for i, end in zip(order, ends, strict=True)
        )

    def lanes(self, section: Element) -> tuple[LaneRecord, ...]:
        records = [self.lane(lane, side) for side in ("left", "right") for lane in section.findall(f"{side}/lane")]
        return tuple(sorted(records, key=lambda record: record.number))

    def lane(self, at: Element, side: str) -> LaneRecord:
        number = self.integer(at, "id")
        if (number > 0) != (side == "left") or number == 0:
            raise self.fault(
                f"lane {number} stands on the wrong side",
                at,
                found=f"id {number} under <{side}>",
                expected="positive ids under <left>, negative ids under <right>",
                fix="correct the lane's id",
            )
        link = at.find("link")
        speeds = [(self.number(each, "sOffset", 0.0), self.speed_limit(each)) for each in at.findall("speed")]
        return LaneRecord(
            number=number,
            type=at.get("type", "none"),
            widths=self.cubics(at, "width", "sOffset"),
            borders=self.cubics(at, "border", "sOffset"),
            predecessor=None if link is None else self.lane_link(link, "predecessor", number),
            successor=None if link is None else self.lane_link(link, "successor", number),
            speeds=tuple(sorted(speeds, key=lambda each: each[0])),
            line=at.sourceline or 0,
        )

    def lane_link(self, link: Element, tag: str, number: int) -> int | None:
        target = link.find(tag)
        if target is None:
            return None
        other = self.integer(target, "id")
        if other == 0:
            raise self.fault(
                f"lane {number} is linked to the centre lane",
                target,
                found=f'<{tag} id="0"/>',
                expected="the id of a lane that can be driven, or no link",
                fix="remove this link or give the lane that it leads to",
            )
        return other

    def types(self, road: Element) -> tuple[RoadTypeRecord, ...]:
        records = []
        for item in road.findall("type"):
            speed = item.find("speed")
            limit = None if speed is None else self.speed_limit(speed)
            if speed is None and (usual_kmph := _USUAL_KMPH.get(item.get("type", ""))) is not None:
                what = f"no speed limit is told on a {item.get('type')} road: {usual_kmph} km/h is taken"
                self.defects.add(what, f"road {road.get('id')}")
                limit = usual_kmph / 3.6
            records.append(RoadTypeRecord(self.number(item, "s", 0.0), item.get("type", ""), limit))
        return tuple(sorted(records, key=lambda record: record.start_m))

    def speed_limit(self, at: Element) -> float | None:
        if at.get("max") in {"no limit", "undefined"}:
            return None
        unit = at.get("unit", "m/s")
        if unit not in _SPEED_UNITS_MPS:
            raise self.fault(
                "the speed's unit is not known",
                at,
                found=repr(unit),
                expected="one of " + ", ".join(_SPEED_UNITS_MPS),
                fix="correct the unit",
            )
        value = self.number(at, "max") * _SPEED_UNITS_MPS[unit]
        return value if value > 0.0 else None

    def road_link(self, at: Element | None) -> RoadLink | None:
        if at is None:
            return None
        kind = at.get("elementType", "road")
        return RoadLink(kind, self.text(at, "elementId"), at.get("contactPoint"), at.sourceline or 0)

    def stop_lines(self, road: Element) -> tuple[StopLineRecord, ...]:
        found = [signal for signal in road.findall("signals/signal") if signal.get("type") == _STOP_LINE_SIGNAL]
        for item in road.findall("objects/object"):
            words = " ".join(item.get(key, "") for key in ("type", "subtype", "name")).lower()
            if "stopline" in words.replace(" ", "").replace("_", ""):
                found.append(item)
        return tuple(self.stop_line(item) for item in found)

    def stop_line(self, at: Element) -> StopLineRecord:
        orientation = at.get("orientation", "none")
        validity = at.find("validity")
        lanes = None if validity is None else (self.integer(validity, "fromLane"), self.integer(validity, "toLane"))
        return StopLineRecord(self.number(at, "s"), along=orientation != "-", against=orientation != "+", lanes=lanes)

    def connection(self, junction: Element, at: Element) -> ConnectionRecord | None:
        connecting = at.get("connectingRoad") or at.get("linkedRoad")
        incoming = at.get("incomingRoad")
        if connecting is None or incoming is None:  # virtual connections have neither and carry no lanes
            return None
        links = tuple((self.integer(link, "from"), self.integer(link, "to")) for link in at.findall("laneLink"))
        contact = at.get("contactPoint", "start")
        return ConnectionRecord(self.text(junction, "id"), incoming, connecting, contact, links, at.sourceline or 0)
