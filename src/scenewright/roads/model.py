"""The lane graph: driving lanes with geometry and neighbours, directed as traffic drives.

What enters: lanes that a map reader has sampled and linked. What leaves: `Lane` and `RoadMap`, immutable, with what a
drawing needs (outlines, stop lines). This module reads no files and knows no map format.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np

from scenewright.roads.polyline import FloatArray, Turn, chord_heading_rad, polyline_arc_lengths

LaneKind = Literal["road", "driveway"]


@dataclass(frozen=True, slots=True, eq=False)
class Lane:
    """One driving lane of one road section, directed as traffic drives.

    Attributes
    ----------
    id
        ``road.section.lane``, such as ``"1.0.-1"``.
    kind
        ``"driveway"`` for driveways, car parks and service roads, else ``"road"``.
    turn
        The way a lane turns inside a junction; None outside.
    centerline_xy, left_edge_xy, right_edge_xy
        Points in metres, shape (N, 2), in driving direction; left and right as the driver sees them.
    width_m
        Width where the lane is widest; most lanes have the same width everywhere.
    successors, predecessors
        Ids of the lanes that follow and precede in driving direction.
    left_neighbor, right_neighbor
        Ids of the adjacent lanes with the same driving direction.
    stop_line_s_m
        Arc length of the lane's (last) stop line, from the lane's start in driving direction.
    """

    id: str
    road_id: str
    kind: LaneKind
    turn: Turn | None
    junction_id: str | None
    centerline_xy: FloatArray
    left_edge_xy: FloatArray
    right_edge_xy: FloatArray
    width_m: float
    length_m: float
    speed_limit_mps: float | None = None
    successors: tuple[str, ...] = ()
    predecessors: tuple[str, ...] = ()
    left_neighbor: str | None = None
    right_neighbor: str | None = None
    stop_line_s_m: float | None = None

    @property
    def start_heading_rad(self) -> float:
        """Heading at the lane's first point."""
        return chord_heading_rad(self.centerline_xy[0], self.centerline_xy[1])

    @property
    def end_heading_rad(self) -> float:
        """Heading at the lane's last point."""
        return chord_heading_rad(self.centerline_xy[-2], self.centerline_xy[-1])

    def outline(self) -> FloatArray:
        """Return the lane's polygon, left edge forwards then right edge backwards, shape (2N, 2), metres."""
        return np.vstack([self.left_edge_xy, self.right_edge_xy[::-1]])

    def stop_line(self) -> FloatArray | None:
        """Return the stop line's two end points (left, right), shape (2, 2), metres; None where there is none."""
        if self.stop_line_s_m is None:
            return None
        along_m = polyline_arc_lengths(self.centerline_xy)
        ends = [
            [float(np.interp(self.stop_line_s_m, along_m, edge[:, axis])) for axis in (0, 1)]
            for edge in (self.left_edge_xy, self.right_edge_xy)
        ]
        return np.array(ends)


@dataclass(frozen=True, slots=True, eq=False)
class RoadMap:
    """A map's lanes by id.

    Attributes
    ----------
    name, source
        The map's name and the file it was read from.
    lanes
        All driving lanes, in the file's order.
    notes
        What the reader left out or mended, one sentence each; empty for a clean map.
    """

    name: str
    source: Path
    lanes: Mapping[str, Lane]
    notes: tuple[str, ...] = field(default=())

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest and largest coordinates of all lane edges: ``(x_min, y_min, x_max, y_max)``, metres."""
        points = np.vstack(list(self.lane_polygons().values()))
        low, high = points.min(axis=0), points.max(axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def lane_polygons(self) -> dict[str, FloatArray]:
        """Return every lane's outline by lane id (see `Lane.outline`)."""
        return {lane_id: lane.outline() for lane_id, lane in self.lanes.items()}

    def stop_lines(self) -> dict[str, FloatArray]:
        """Return the end points of every stop line by lane id (see `Lane.stop_line`)."""
        lines = ((lane_id, lane.stop_line()) for lane_id, lane in self.lanes.items())
        return {lane_id: line for lane_id, line in lines if line is not None}
