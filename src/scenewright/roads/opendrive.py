"""OpenDRIVE to `RoadMap`: sample the driving lanes and join them into a directed graph.

What enters: an ``.xodr`` file. What leaves: a `RoadMap`. Elevation, superelevation and traffic lights are not read.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from scenewright.errors import MapError, Place
from scenewright.roads.defects import Defects
from scenewright.roads.model import Lane, RoadMap
from scenewright.roads.opendrive_lanes import DRIVING_TYPES, SHORTEST_M, driving_lanes, lane_id, runs_along
from scenewright.roads.opendrive_records import ConnectionRecord, OpenDriveRecord, RoadRecord
from scenewright.roads.opendrive_xml import read_opendrive

End = Literal["start", "end"]

_Arcs = dict[tuple[str, str], None]  # lane ids (before, after), in the order of the file

_NO_ROAD = "roads end where they are linked to roads that are not in the file"
_NO_JUNCTION = "roads end where they are linked to junctions that are not in the file, or join nothing"
_NO_CONNECTION = "connections of junctions with roads that are not in the file are left out"
_NO_LANE = "links to lanes that are not in the file are left out"
_NO_MEETING = "lanes are linked in the file, but do not meet, and are not joined"
_TOO_SHORT = f"lanes shorter than {100 * SHORTEST_M:g} cm are passed over, and what lies before and behind is joined"

_WIDEST_GAP_M = 1.0
_WIDEST_BEND_RAD = np.radians(60.0)


@dataclass(frozen=True, slots=True)
class _Port:
    """One end, in the road's own direction, of one lane."""

    road: RoadRecord
    section: int
    number: int
    end: End

    @property
    def lane_id(self) -> str:
        return lane_id(self.road.id, self.section, self.number)

    @property
    def is_in_file(self) -> bool:
        """Whether there is such a lane, whatever it is for."""
        return any(lane.number == self.number for lane in self.road.sections[self.section].lanes)

    @property
    def lets_out(self) -> bool:
        """Whether traffic leaves the lane here."""
        return runs_along(self.road, self.number) == (self.end == "end")


def load_opendrive(source: Path) -> RoadMap:
    """Read an OpenDRIVE file into a lane graph.

    Raises
    ------
    MapError
        If the file is missing, broken, contradicts itself or has no driving lane.
    """
    defects = Defects()
    record = read_opendrive(source, defects)
    sampled = [lane for road in record.roads for lane in driving_lanes(road, source.name)]
    lanes = {lane.id: lane for lane in sampled if lane.length_m >= SHORTEST_M}
    short = _short_lanes(record) | {lane.id for lane in sampled if lane.id not in lanes}
    if not lanes:
        raise MapError(
            "the map has no driving lanes",
            place=Place(source.name),
            found=f"{len(short)} lanes, all shorter than {100 * SHORTEST_M:g} cm"
            if short
            else f"{len(record.roads)} roads without lanes of type driving",
            expected='at least one <lane type="driving">',
            fix="check the lanes' types in the tool that wrote the map",
        )
    for name in sorted(short):
        defects.add(_TOO_SHORT, name)
    arcs = _directed_arcs(record, lanes.keys() | short, defects)
    arcs = _that_meet(_passed_over(arcs, short), lanes, defects)
    after: dict[str, list[str]] = {name: [] for name in lanes}
    before: dict[str, list[str]] = {name: [] for name in lanes}
    for one, other in arcs:
        after[one].append(other)
        before[other].append(one)
    linked = {
        name: _without_strangers(replace(lane, successors=tuple(after[name]), predecessors=tuple(before[name])), lanes)
        for name, lane in lanes.items()
    }
    return RoadMap(source.stem, source, _with_inherited_limits(linked), defects.notes())


def _short_lanes(record: OpenDriveRecord) -> set[str]:
    """Return the ids of the driving lanes in sections that have next to no length."""
    return {
        lane_id(road.id, index, lane.number)
        for road in record.roads
        for index, section in enumerate(road.sections)
        if section.end_m - section.start_m < SHORTEST_M
        for lane in section.lanes
        if lane.type in DRIVING_TYPES
    }


def _without_strangers(lane: Lane, lanes: dict[str, Lane]) -> Lane:
    """Return a lane without neighbours that are no lanes of the map: those that had no length."""
    left, right = (name if name in lanes else None for name in (lane.left_neighbor, lane.right_neighbor))
    return replace(lane, left_neighbor=left, right_neighbor=right)


def _directed_arcs(record: OpenDriveRecord, known: Set[str], defects: Defects) -> _Arcs:
    """Turn every stated touch of two lane ends into (before, after); files state some touches twice."""
    roads = {road.id: road for road in record.roads}
    arcs: _Arcs = {}
    touches = [*_section_touches(record), *_road_touches(record, roads, defects)]
    touches += _junction_touches(record, roads, defects)
    for one, other in touches:
        if one.lane_id not in known and other.lane_id not in known:
            continue
        if not (one.is_in_file and other.is_in_file):
            defects.add(_NO_LANE, f"{one.lane_id} to {other.lane_id}")
        elif one.lane_id in known and other.lane_id in known and one.lets_out != other.lets_out:
            before, after = (one, other) if one.lets_out else (other, one)
            arcs[before.lane_id, after.lane_id] = None
    return arcs


def _passed_over(arcs: _Arcs, short: set[str]) -> _Arcs:
    """Join what lies before and behind lanes that are too short to be lanes, several in a row as well."""
    after: dict[str, list[str]] = {}
    for one, other in arcs:
        after.setdefault(one, []).append(other)
    result: _Arcs = {}
    for one, other in arcs:
        if one in short:
            continue
        waiting, seen = [other], {other}
        while waiting:
            name = waiting.pop()
            if name not in short:
                result[one, name] = None
                continue
            new = [each for each in reversed(after.get(name, [])) if each not in seen]
            seen.update(new)
            waiting += new
    return result


def _that_meet(arcs: _Arcs, lanes: dict[str, Lane], defects: Defects) -> _Arcs:
    result: _Arcs = {}
    for before, after in arcs:
        fault = _misfit(lanes[before], lanes[after])
        if fault:
            defects.add(_NO_MEETING, f"{before} and {after} {fault}")
        else:
            result[before, after] = None
    return result


def _misfit(before: Lane, after: Lane) -> str | None:
    gap_m = float(np.hypot(*(after.centerline_xy[0] - before.centerline_xy[-1])))
    bend = (after.start_heading_rad - before.end_heading_rad + np.pi) % (2 * np.pi) - np.pi
    if gap_m > _WIDEST_GAP_M:
        return f"lie {gap_m:.1f} m apart"
    if abs(bend) > _WIDEST_BEND_RAD:
        return f"meet at {abs(np.degrees(bend)):.0f} degrees"
    return None


def _section_touches(record: OpenDriveRecord) -> Iterator[tuple[_Port, _Port]]:
    for road in record.roads:
        for index in range(len(road.sections) - 1):
            for lane in road.sections[index].lanes:
                if lane.successor is not None:
                    yield _Port(road, index, lane.number, "end"), _Port(road, index + 1, lane.successor, "start")
            for lane in road.sections[index + 1].lanes:
                if lane.predecessor is not None:
                    yield _Port(road, index + 1, lane.number, "start"), _Port(road, index, lane.predecessor, "end")


def _road_touches(
    record: OpenDriveRecord, roads: dict[str, RoadRecord], defects: Defects
) -> Iterator[tuple[_Port, _Port]]:
    junctions = {each.junction_id for each in record.connections}
    for road in record.roads:
        ends: tuple[End, End] = ("start", "end")
        for end in ends:
            link = road.predecessor if end == "start" else road.successor
            if link is not None and link.element_type == "junction" and link.element_id not in junctions:
                defects.add(_NO_JUNCTION, f"road {road.id} to junction {link.element_id}")
            if link is None or link.element_type != "road":
                continue
            other = roads.get(link.element_id)
            if other is None:
                defects.add(_NO_ROAD, f"road {road.id} to road {link.element_id}")
                continue
            contact: End = "end" if link.contact == "end" else "start"
            section = 0 if end == "start" else len(road.sections) - 1
            for lane in road.sections[section].lanes:
                number = lane.predecessor if end == "start" else lane.successor
                if number is not None:
                    yield _Port(road, section, lane.number, end), _port_at(other, number, contact)


def _junction_touches(
    record: OpenDriveRecord, roads: dict[str, RoadRecord], defects: Defects
) -> Iterator[tuple[_Port, _Port]]:
    for connection in record.connections:
        incoming, connecting = (roads.get(name) for name in (connection.incoming_road, connection.connecting_road))
        if incoming is None or connecting is None:
            roads_named = f"{connection.incoming_road} to {connection.connecting_road}"
            defects.add(_NO_CONNECTION, f"{roads_named} in junction {connection.junction_id}")
            continue
        contact: End = "end" if connection.contact == "end" else "start"
        for end in _ends_at_junction(incoming, connection):
            for number_in, number_connecting in connection.lane_links:
                yield _port_at(incoming, number_in, end), _port_at(connecting, number_connecting, contact)


def _ends_at_junction(road: RoadRecord, connection: ConnectionRecord) -> Iterator[End]:
    ends: tuple[End, End] = ("start", "end")
    for end in ends:
        link = road.predecessor if end == "start" else road.successor
        if link is not None and link.element_type == "junction" and link.element_id == connection.junction_id:
            yield end


def _port_at(road: RoadRecord, number: int, end: End) -> _Port:
    return _Port(road, 0 if end == "start" else len(road.sections) - 1, number, end)


def _with_inherited_limits(lanes: dict[str, Lane]) -> dict[str, Lane]:
    """Give lanes inside junctions, which files seldom type, the limit of the lane that leads to them."""
    result = dict(lanes)
    for lane in lanes.values():
        if lane.junction_id is not None and lane.speed_limit_mps is None:
            before = [lanes[name].speed_limit_mps for name in lane.predecessors]
            result[lane.id] = replace(lane, speed_limit_mps=next((v for v in before if v is not None), None))
    return result
