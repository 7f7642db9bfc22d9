"""OpenDRIVE to `RoadMap`: sample the driving lanes and join them into a directed graph.

What enters: an ``.xodr`` file. What leaves: a `RoadMap`. Elevation, superelevation and traffic lights are not read.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from scenewright.errors import MapError, Place
from scenewright.roads.model import Lane, RoadMap
from scenewright.roads.opendrive_lanes import driving_lanes, lane_id, runs_along
from scenewright.roads.opendrive_records import ConnectionRecord, OpenDriveRecord, RoadRecord
from scenewright.roads.opendrive_xml import read_opendrive

End = Literal["start", "end"]

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
    record = read_opendrive(source)
    lanes = {lane.id: lane for road in record.roads for lane in driving_lanes(road, source.name)}
    if not lanes:
        raise MapError(
            "the map has no driving lanes",
            place=Place(source.name),
            found=f"{len(record.roads)} roads without lanes of type driving",
            expected='at least one <lane type="driving">',
            fix="check the lanes' types in the tool that wrote the map",
        )
    notes: list[str] = []
    arcs = _directed_arcs(record, lanes, source.name, notes)
    linked = {
        lane.id: replace(
            lane,
            successors=tuple(after for before, after in arcs if before == lane.id),
            predecessors=tuple(before for before, after in arcs if after == lane.id),
        )
        for lane in lanes.values()
    }
    return RoadMap(source.stem, source, _with_inherited_limits(linked), tuple(notes))


def _directed_arcs(
    record: OpenDriveRecord, lanes: dict[str, Lane], map_name: str, notes: list[str]
) -> list[tuple[str, str]]:
    """Turn every stated touch of two lane ends into (before, after); files state some touches twice."""
    roads = {road.id: road for road in record.roads}
    arcs: dict[tuple[str, str], None] = {}
    touches = [*_section_touches(record), *_road_touches(record, roads, map_name)]
    touches += _junction_touches(record, roads, map_name)
    for one, other in touches:
        if one.lane_id not in lanes or other.lane_id not in lanes or one.lets_out == other.lets_out:
            continue
        before, after = (one, other) if one.lets_out else (other, one)
        if (before.lane_id, after.lane_id) in arcs:
            continue
        fault = _misfit(lanes[before.lane_id], lanes[after.lane_id])
        if fault:
            notes.append(f"lanes {before.lane_id} and {after.lane_id} are linked in the file but {fault}: not joined")
        else:
            arcs[before.lane_id, after.lane_id] = None
    return list(arcs)


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
    record: OpenDriveRecord, roads: dict[str, RoadRecord], map_name: str
) -> Iterator[tuple[_Port, _Port]]:
    for road in record.roads:
        ends: tuple[End, End] = ("start", "end")
        for end in ends:
            link = road.predecessor if end == "start" else road.successor
            if link is None or link.element_type != "road":
                continue
            other = roads.get(link.element_id)
            if other is None:
                raise _no_such_road(map_name, link.line, f"road {road.id!r} is linked to", link.element_id, roads)
            contact: End = "end" if link.contact == "end" else "start"
            section = 0 if end == "start" else len(road.sections) - 1
            for lane in road.sections[section].lanes:
                number = lane.predecessor if end == "start" else lane.successor
                if number is not None:
                    yield _Port(road, section, lane.number, end), _port_at(other, number, contact)


def _junction_touches(
    record: OpenDriveRecord, roads: dict[str, RoadRecord], map_name: str
) -> Iterator[tuple[_Port, _Port]]:
    for connection in record.connections:
        ends = []
        for road_id in (connection.incoming_road, connection.connecting_road):
            if road_id not in roads:
                raise _no_such_road(map_name, connection.line, "the junction connects", road_id, roads)
            ends.append(roads[road_id])
        incoming, connecting = ends
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


def _no_such_road(map_name: str, line: int, what: str, road_id: str, roads: dict[str, RoadRecord]) -> MapError:
    return MapError(
        f"{what} a road that does not exist",
        place=Place(map_name, line=line),
        found=f"road id {road_id!r}",
        expected="one of " + ", ".join(list(roads)[:12]) + (", ..." if len(roads) > 12 else ""),
        fix="correct the id or add the road",
    )


def _with_inherited_limits(lanes: dict[str, Lane]) -> dict[str, Lane]:
    """Give lanes inside junctions, which files seldom type, the limit of the lane that leads to them."""
    result = dict(lanes)
    for lane in lanes.values():
        if lane.junction_id is not None and lane.speed_limit_mps is None:
            before = [lanes[name].speed_limit_mps for name in lane.predecessors]
            result[lane.id] = replace(lane, speed_limit_mps=next((v for v in before if v is not None), None))
    return result
