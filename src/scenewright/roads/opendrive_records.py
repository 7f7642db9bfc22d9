"""What an OpenDRIVE file says, as typed records, still in the file's own terms (roads, sections, signed lane ids).

What enters: values that `opendrive_xml` has read. What leaves: records with the line they stood in, and the polynomials
evaluated. Nothing here links lanes or chooses driving lanes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from scenewright.roads.polyline import FloatArray
from scenewright.roads.reference_line import Geometry

_SAME_PLACE_M = 1e-6


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
    """A lane of a section; `widths` starts at the section's start, negative ids lie right of the reference line.

    `speeds` are speed limits (m/s; None where there is none of its own), each from so far behind that start on.
    """

    number: int
    type: str
    widths: tuple[Cubic, ...]
    borders: tuple[Cubic, ...]
    predecessor: int | None
    successor: int | None
    speeds: tuple[tuple[float, float | None], ...]
    line: int

    @property
    def speed_limit_mps(self) -> float | None:
        """The limit where its section starts."""
        return next((limit for start_m, limit in reversed(self.speeds) if start_m <= _SAME_PLACE_M), None)

    def behind(self, ahead_m: float) -> LaneRecord:
        """Return the same lane of a section that starts so much later, in the same lane section."""
        widths, borders = (
            tuple(replace(each, start_m=each.start_m - ahead_m) for each in cubics)
            for cubics in (self.widths, self.borders)
        )
        speeds = tuple((start_m - ahead_m, limit) for start_m, limit in self.speeds)
        return replace(self, widths=widths, borders=borders, speeds=speeds, predecessor=self.number)


@dataclass(frozen=True, slots=True)
class SectionRecord:
    """A lane section from `start_m` to `end_m` of its road."""

    start_m: float
    end_m: float
    lanes: tuple[LaneRecord, ...]
    line: int

    def parts(self, places_m: Iterable[float]) -> Iterator[SectionRecord]:
        """Yield it in sections in each of which a lane has one speed limit, cut at these places of its road, too."""
        own_m = (self.start_m + start_m for lane in self.lanes for start_m, _ in lane.speeds)
        cuts_m = sorted({s for s in (*places_m, *own_m) if self.start_m + _SAME_PLACE_M < s < self.end_m})
        for start_m, end_m in pairwise((self.start_m, *cuts_m, self.end_m)):
            later_m = start_m - self.start_m
            lanes = [lane.behind(later_m) if later_m else lane for lane in self.lanes]
            if end_m != self.end_m:
                lanes = [replace(lane, successor=lane.number) for lane in lanes]
            yield replace(self, start_m=start_m, end_m=end_m, lanes=tuple(lanes))


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
