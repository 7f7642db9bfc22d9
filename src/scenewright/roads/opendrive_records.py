"""What an OpenDRIVE file says, as typed records, still in the file's own terms (roads, sections, signed lane ids).

What enters: values that `opendrive_xml` has read. What leaves: records with the line they stood in, and the polynomials
evaluated. Nothing here links lanes or chooses driving lanes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scenewright.roads.polyline import FloatArray
from scenewright.roads.reference_line import Geometry


@dataclass(frozen=True, slots=True)
class Cubic:
    """``a + b ds + c ds^2 + d ds^3`` from `start_m` on, until the next one starts."""

    start_m: float
    a: float
    b: float
    c: float
    d: float


def evaluate_cubics(cubics: tuple[Cubic, ...], s_m: FloatArray) -> FloatArray:
    """Return the piecewise polynomial at `s_m`; before the first piece, and where there is none, 0."""
    if not cubics:
        return np.zeros_like(s_m)
    starts = np.array([cubic.start_m for cubic in cubics])
    coefficients = np.array([[cubic.a, cubic.b, cubic.c, cubic.d] for cubic in cubics])
    index = np.searchsorted(starts, s_m + 1e-9, side="right") - 1
    chosen = coefficients[np.maximum(index, 0)]
    ds = s_m - starts[np.maximum(index, 0)]
    value = chosen[:, 0] + ds * (chosen[:, 1] + ds * (chosen[:, 2] + ds * chosen[:, 3]))
    return np.where(index < 0, 0.0, value)


@dataclass(frozen=True, slots=True)
class LaneRecord:
    """A lane of a section; `widths` starts at the section's start, negative ids lie right of the reference line."""

    number: int
    type: str
    widths: tuple[Cubic, ...]
    borders: tuple[Cubic, ...]
    predecessor: int | None
    successor: int | None
    speed_limit_mps: float | None
    line: int


@dataclass(frozen=True, slots=True)
class SectionRecord:
    """A lane section from `start_m` to `end_m` of its road."""

    start_m: float
    end_m: float
    lanes: tuple[LaneRecord, ...]
    line: int


@dataclass(frozen=True, slots=True)
class RoadLink:
    """What a road's end touches: ``element_type`` road or junction; `contact` is start or end of that road."""

    element_type: str
    element_id: str
    contact: str | None
    line: int


@dataclass(frozen=True, slots=True)
class RoadTypeRecord:
    """A road's type and speed limit from `start_m` on."""

    start_m: float
    type: str
    speed_limit_mps: float | None


@dataclass(frozen=True, slots=True)
class StopLineRecord:
    """A stop line across a road at `s_m`; it holds for traffic along s, against s, or both."""

    s_m: float
    along: bool
    against: bool
    lanes: tuple[int, int] | None


@dataclass(frozen=True, slots=True)
class RoadRecord:
    """One road."""

    id: str
    name: str
    length_m: float
    junction_id: str | None
    right_hand: bool
    geometries: tuple[Geometry, ...]
    lane_offsets: tuple[Cubic, ...]
    sections: tuple[SectionRecord, ...]
    types: tuple[RoadTypeRecord, ...]
    predecessor: RoadLink | None
    successor: RoadLink | None
    stop_lines: tuple[StopLineRecord, ...]
    user_kind: str | None
    line: int


@dataclass(frozen=True, slots=True)
class ConnectionRecord:
    """A junction's connection; `lane_links` are pairs (lane of the incoming road, lane of the connecting road)."""

    junction_id: str
    incoming_road: str
    connecting_road: str
    contact: str
    lane_links: tuple[tuple[int, int], ...]
    line: int


@dataclass(frozen=True, slots=True)
class OpenDriveRecord:
    """A whole file."""

    roads: tuple[RoadRecord, ...]
    connections: tuple[ConnectionRecord, ...]
