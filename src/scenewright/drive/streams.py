"""The streams of traffic that meet the ego's route, and who in them may be on the way there.

What enters: the ego's route and map once, then the others' places and headings. What leaves: for every other vehicle
the streams that it may belong to, and how far along them it is. Where a vehicle really goes is not known here: it
belongs to every stream that its place and heading allow. What to do about it is not decided here either (see `driver`).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin

from scenewright.drive.boxes import free_way_m
from scenewright.drive.protocol import EgoStart, VehicleState
from scenewright.roads import Path, Route, all_routes, find_conflict
from scenewright.roads.path import wrap_rad

_LANE_REACH_M = 2.0
_HEADING_REACH_RAD = 0.5
# Who drives on the ego's own path and along it: a car of 1.9 m that keeps to a lane of 3.9 m is no further off, and
# changing lanes at 1 m/s and 10 m/s turns it by half of that. Measured: 4 m before it merges one is at 0.24 rad.
_ON_IT_M, _ALONG_IT_RAD = 1.0, 0.2
_STANDING_MPS = 0.3
_ELSEWHERE_M = 6.0
_SIDE_MARGIN_M = 0.2
_CROSSING_MPS = 1.0
_ALONG_COSINE = 0.7
_NEAR_GAP_M = 6.0
_CROSSING_CLEARANCE_S = 0.5
_LOOK_AGAIN_S = 0.2  # a vehicle that is elsewhere does not come here at once
_TURN_RANK = {"straight": 0, "right": 1, "left": 2}


@dataclass(frozen=True, slots=True, eq=False)
class Stream:
    """Traffic on one route that crosses the ego's or merges with it.

    Attributes
    ----------
    path
        Where this traffic goes.
    ego_in_m, ego_out_m
        Arc lengths on the ego's route between which its centre is where it could touch this traffic.
    hold_m
        The last place at or before `ego_in_m` where the ego is in nobody's way: the entry of overlapping zones.
    in_m, out_m
        The same for this traffic, on its path.
    ego_yields
        Whether this traffic has the right of way.
    merges
        Whether the ego goes on in the same lane as this traffic.
    """

    path: Path
    ego_in_m: float
    ego_out_m: float
    hold_m: float
    in_m: float
    out_m: float
    ego_yields: bool
    merges: bool


@dataclass(slots=True, eq=False)
class Foot:
    """Where a vehicle is in relation to one path, refreshed as seldom as that allows."""

    path: Path
    s_m: float | None = None
    d_m: float = 0.0
    heading_error_rad: float = 0.0
    again_s: float = -1.0

    def look(self, vehicle: VehicleState, time_s: float) -> bool:
        """Bring the foot point up to date; return False where the vehicle was far off at the last look, just before."""
        if time_s < self.again_s:
            return False
        self.s_m, self.d_m, self.heading_error_rad = self.path.to_frenet(
            vehicle.x_m, vehicle.y_m, vehicle.heading_rad, near_s_m=self.s_m
        )
        if abs(self.d_m) > _ELSEWHERE_M:
            self.again_s = time_s + _LOOK_AGAIN_S
        return True


@dataclass(slots=True, eq=False)
class Approach:
    """One vehicle as a member of one stream."""

    stream: Stream
    foot: Foot
    accepted: bool = False  # the ego has decided to go before this vehicle

    def look(self, vehicle: VehicleState, time_s: float) -> bool:
        """Return whether the vehicle may be in this stream now, in front of or within the place of conflict."""
        foot = self.foot
        if not foot.look(vehicle, time_s):
            return False
        if abs(foot.d_m) > _LANE_REACH_M or abs(foot.heading_error_rad) > _HEADING_REACH_RAD:
            foot.again_s = time_s + _LOOK_AGAIN_S
            return False
        assert foot.s_m is not None
        return foot.s_m < self.stream.out_m


@dataclass(slots=True, eq=False)
class Neighbour:
    """What the driver remembers of one other vehicle."""

    on_ego_path: Foot
    approaches: tuple[Approach, ...]
    stands_since_s: float | None = None

    def watch(self, vehicle: VehicleState, time_s: float) -> None:
        """Note since when the vehicle stands."""
        if vehicle.speed_mps >= _STANDING_MPS:
            self.stands_since_s = None
        elif self.stands_since_s is None:
            self.stands_since_s = time_s

    def gap_ahead_m(self, vehicle: VehicleState, ego: VehicleState, ego_s_m: float, time_s: float) -> float | None:
        """Return the free distance in metres to this vehicle's box, None where it is not in the ego's way.

        Nor is a vehicle that crosses and will be gone in time.
        """
        foot = self.on_ego_path
        if not foot.look(vehicle, time_s) or foot.s_m is None or foot.s_m <= ego_s_m:
            return None
        sine, cosine = sin(foot.heading_error_rad), cos(foot.heading_error_rad)
        across, along = abs(sine), abs(cosine)
        reach_m = 0.5 * (vehicle.length_m * across + vehicle.width_m * along + ego.width_m) + _SIDE_MARGIN_M
        if abs(foot.d_m) >= reach_m:
            return None
        gap_m = foot.s_m - ego_s_m - 0.5 * (vehicle.length_m * along + vehicle.width_m * across + ego.length_m)
        sideways_mps = vehicle.speed_mps * sine
        if abs(sideways_mps) > _CROSSING_MPS:
            leaves_s = (reach_m - foot.d_m if sideways_mps > 0.0 else reach_m + foot.d_m) / abs(sideways_mps)
            if leaves_s + _CROSSING_CLEARANCE_S < gap_m / max(ego.speed_mps, _CROSSING_MPS):
                return None
        if gap_m < _NEAR_GAP_M and cosine < _ALONG_COSINE:
            # Beside a vehicle that lies across a curve, the projection says too little: drive there in thought.
            reach_m = max(gap_m, 0.0) + vehicle.length_m + ego.length_m
            return free_way_m(self.on_ego_path.path, ego, ego_s_m, vehicle, reach_m=reach_m)
        return gap_m

    @property
    def goes_its_way(self) -> bool:
        """Whether the vehicle, at the last look, was on the ego's own path and drove along it."""
        foot = self.on_ego_path
        return abs(foot.d_m) < _ON_IT_M and abs(foot.heading_error_rad) < _ALONG_IT_RAD

    @property
    def lies_across(self) -> bool:
        """Whether the vehicle stands or drives across the ego's path, or against it, rather than along it."""
        return cos(self.on_ego_path.heading_error_rad) < _ALONG_COSINE

    def speed_along_mps(self, vehicle: VehicleState) -> float:
        """Return the vehicle's speed along the ego's path in m/s, 0 where it comes towards the ego."""
        return max(0.0, vehicle.speed_mps * cos(self.on_ego_path.heading_error_rad))


@dataclass(slots=True, eq=False)
class Surroundings:
    """The streams that meet the ego's route, and the neighbours seen so far."""

    ego_path: Path
    streams: tuple[Stream, ...]
    neighbours: dict[str, Neighbour] = field(default_factory=dict)

    def neighbour(self, vehicle: VehicleState, time_s: float) -> Neighbour:
        """Return what is remembered of a vehicle, brought up to date."""
        known = self.neighbours.get(vehicle.name)
        if known is None:
            approaches = tuple(Approach(stream, Foot(stream.path)) for stream in self.streams)
            known = self.neighbours[vehicle.name] = Neighbour(Foot(self.ego_path), approaches)
        known.watch(vehicle, time_s)
        return known


def surroundings_of(start: EgoStart) -> Surroundings:
    """Find the streams that cross the ego's route or merge with it; geometry only, done once before a run."""
    ego, lanes = start.route, start.road_map.lanes
    junctions = {lanes[name].junction_id for name in ego.lanes} - {None}
    met = []
    for route in all_routes(start.road_map):
        if not any(lanes[name].junction_id in junctions for name in route.lanes):
            continue
        conflict = find_conflict(ego, route)
        if conflict is None or conflict.kind == "following":
            continue
        met.append((route, conflict))
    zones = [conflict.zone_a_m for _, conflict in met]
    streams = tuple(
        Stream(
            path=route.path,
            ego_in_m=conflict.zone_a_m[0],
            ego_out_m=conflict.zone_a_m[1],
            hold_m=_hold_m(conflict.zone_a_m[0], zones),
            in_m=conflict.zone_b_m[0],
            out_m=conflict.zone_b_m[1],
            ego_yields=yields(ego, route),
            merges=conflict.kind == "merging",
        )
        for route, conflict in met
    )
    return Surroundings(ego.path, streams)


def _hold_m(entry_m: float, zones: list[tuple[float, float]]) -> float:
    """Walk back from a zone's entry to a place that lies in no other zone."""
    for low_m, high_m in sorted(zones, reverse=True):
        if low_m < entry_m <= high_m:
            return _hold_m(low_m, zones)
    return entry_m


def yields(ego: Route, other: Route) -> bool:
    """Return whether traffic on one route owes the right of way to traffic on another, in right-hand traffic.

    Driveways yield to roads, left turns to oncoming traffic, turns to those that go straight on; else the one from
    the right goes first.
    """
    if ego.origin_kind != other.origin_kind:
        return ego.origin_kind == "driveway"
    rank, other_rank = _TURN_RANK[ego.turn], _TURN_RANK[other.turn]
    if rank != other_rank:
        return rank > other_rank
    towards_rad = wrap_rad(_entry_heading_rad(other) - _entry_heading_rad(ego))
    return 0.25 * pi < towards_rad < 0.75 * pi  # comes from the right, that is: drives to the left


def _entry_heading_rad(route: Route) -> float:
    return route.path.pose(route.landmarks.get("junction_start", 0.0))[2]
