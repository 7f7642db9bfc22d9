"""A reference driver: follows, slows down for curves, stops at the stop line, yields, takes gaps, and is wary.

What enters: traits, the start, and what it sees at each step. What leaves: an acceleration along the route. The
ordinary and the hostile policies differ in their traits and in what they make of the acceleration (see `idm`,
`hostile`). The driver learns of the others only what eyes tell: place, heading, speed, acceleration and size.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from scenewright.drive.protocol import EgoStart, Envelope, Observation, VehicleState
from scenewright.drive.speeds import (
    SpeedProfile,
    following_accel,
    free_accel,
    needed_brake,
    speed_profile,
    stopping_accel,
    travel_time,
)
from scenewright.drive.streams import Approach, Neighbour, Stream, Surroundings, surroundings_of

_AT_LINE_M, _AT_LINE_MPS = 1.0, 0.1
_LINE_MARGIN_M = 0.3  # between bumper and stop line
_ZONE_MARGIN_M = 0.5
_ACROSS_MARGIN_M = 1.0
_PAST_WAITING_M = 0.5
_HORIZON_S = 4.0
_CLEARANCE_S = 0.3
_MERGE_CLEARANCE_S = 0.8
_KEEP_DECISION_S = 0.5  # a gap once taken is given up only where it has become this much shorter
_WONT_STOP_MPSS = 3.5  # nobody is expected to brake harder than this for others
_SETS_OFF_MPSS, _SETS_OFF_S = 0.3, 2.5
_PULLS_OUT_MPSS = 1.5  # one that speeds up like this means to go first
_SPEEDS_UP_S = 2.0  # how long one that speeds up is taken to go on doing so
_GAP_ACCEL = 0.85  # of the full acceleration, since the driver model approaches its speed slowly
_NEAR_M, _NEAR_S = 120.0, 8.5  # whom it sees: as far as it drives in so long, where that is more


@dataclass(frozen=True, slots=True)
class Traits:
    """What distinguishes one driver from another.

    Attributes
    ----------
    desired_mps
        Own speed limit, or None for the roads' alone.
    limit_factor
        What it makes of the roads' limits.
    headway_s, standstill_m, accel_mpss, brake_mpss
        The intelligent driver model's time headway, standstill gap, acceleration and comfortable deceleration.
    emergency_mpss
        The hardest braking.
    lateral_mpss
        Comfortable lateral acceleration in curves.
    min_stop_s
        How long it stands at a stop line.
    critical_gap_s
        The shortest time to arrival of another vehicle before which it goes; more where the way across takes longer.
    patience_s
        How long it waits for a vehicle that stands itself.
    lawful
        Whether it heeds the stop line and the right of way, and is wary of those who do not.
    """

    desired_mps: float | None = None
    limit_factor: float = 1.0
    headway_s: float = 1.2
    standstill_m: float = 2.0
    accel_mpss: float = 1.5
    brake_mpss: float = 2.0
    emergency_mpss: float = 8.0
    lateral_mpss: float = 2.5
    min_stop_s: float = 0.8
    critical_gap_s: float = 4.5
    patience_s: float = 2.0
    lawful: bool = True


@dataclass(slots=True)
class Driver:
    """One driver on one route; made anew for every run.

    Attributes
    ----------
    traits, start
        Who drives, and where it begins.
    profile
        The speeds it wants along the route.
    envelope
        What it promises: kept by construction, whatever the others do.
    """

    traits: Traits
    start: EgoStart
    profile: SpeedProfile = field(init=False)
    envelope: Envelope = field(init=False)
    _surroundings: Surroundings = field(init=False, repr=False)
    _line_m: float | None = field(init=False, repr=False)  # centre of the ego where it stands at the stop line
    _stood_s: float = field(init=False, default=0.0, repr=False)
    _near_m: float = field(init=False, repr=False)

    def __post_init__(self) -> None:
        traits, start = self.traits, self.start
        self.profile = wanted_speeds(traits, start)
        self.envelope = Envelope(
            max(1.05 * self.profile.max_mps, start.speed_mps), -traits.emergency_mpss, traits.accel_mpss
        )
        self._surroundings = surroundings_of(start)
        self._near_m = start.s_m
        self._line_m = None
        stop_line_m = start.route.landmarks.get("stop_line")
        if traits.lawful and start.route.origin_kind == "driveway" and stop_line_m is not None:
            line_m = stop_line_m - 0.5 * start.length_m - _LINE_MARGIN_M
            if needed_brake(start.speed_mps, line_m - start.s_m) <= traits.emergency_mpss:
                self._line_m = line_m

    def accelerate(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2 for the next step; it never leads to reversing."""
        traits, ego, time_s = self.traits, observation.ego, observation.time_s
        s_m, speed_mps = self._place(ego), ego.speed_mps
        accel = free_accel(speed_mps, s_m, self.profile, traits.accel_mpss, traits.brake_mpss)
        if self._line_m is not None:
            accel = min(accel, self._heed_line(s_m, speed_mps, dt_s))
        interaction = 0.0
        for other in observation.others:
            neighbour, follows = self._surroundings.neighbour(other, time_s), False
            if abs(other.x_m - ego.x_m) + abs(other.y_m - ego.y_m) < max(_NEAR_M, _NEAR_S * speed_mps):
                gap_m = neighbour.gap_ahead_m(other, ego, s_m, time_s)
                if gap_m is not None and neighbour.lies_across:
                    accel = min(accel, stopping_accel(speed_mps, gap_m - _ACROSS_MARGIN_M, traits.brake_mpss))
                elif gap_m is not None:
                    follows = neighbour.goes_its_way
                    interaction = min(interaction, self._follow(gap_m, speed_mps, neighbour.speed_along_mps(other)))
            if traits.lawful and not follows:  # whoever is ahead on its own way is not given way to
                accel = min(accel, self._heed(neighbour, other, s_m, speed_mps, time_s))
        return self.bounded(accel + interaction, speed_mps, dt_s)

    def bounded(self, accel_mpss: float, speed_mps: float, dt_s: float) -> float:
        """Return an acceleration in m/s^2 brought within the envelope, and that does not reverse."""
        promise = self.envelope
        most = min(promise.accel_max_mpss, (promise.speed_max_mps - speed_mps) / dt_s)
        return max(promise.accel_min_mpss, -speed_mps / dt_s, min(most, accel_mpss))

    def _place(self, ego: VehicleState) -> float:
        if ego.s_m is not None:
            return ego.s_m
        self._near_m = self.start.route.path.to_frenet(ego.x_m, ego.y_m, near_s_m=self._near_m)[0]
        return self._near_m

    def _heed_line(self, s_m: float, speed_mps: float, dt_s: float) -> float:
        assert self._line_m is not None
        to_line_m = self._line_m - s_m
        if speed_mps < _AT_LINE_MPS and abs(to_line_m) < _AT_LINE_M:
            self._stood_s += dt_s
        if self._stood_s >= self.traits.min_stop_s or to_line_m < -_AT_LINE_M:
            self._line_m = None
            return inf
        return stopping_accel(speed_mps, to_line_m, self.traits.brake_mpss)

    def _follow(self, gap_m: float, speed_mps: float, leader_mps: float) -> float:
        traits = self.traits
        return following_accel(
            speed_mps,
            gap_m,
            leader_mps,
            accel_mpss=traits.accel_mpss,
            brake_mpss=traits.brake_mpss,
            headway_s=traits.headway_s,
            standstill_m=traits.standstill_m,
        )

    def _heed(self, neighbour: Neighbour, other: VehicleState, s_m: float, speed_mps: float, time_s: float) -> float:
        """Return the largest acceleration that leaves another vehicle its way, where it must be left."""
        since_s = neighbour.stands_since_s
        if since_s is not None and time_s - since_s >= self.traits.patience_s:
            return inf  # it waits for us, or for ever; should it be in the way itself, we follow it
        accel = inf
        for approach in neighbour.approaches:
            stream = approach.stream
            if s_m >= stream.hold_m or not approach.look(other, time_s):
                continue
            waiting_m = self._waiting_place(stream)
            if stream.ego_yields and s_m <= waiting_m + _PAST_WAITING_M:
                if not self._accepts_gap(approach, other, s_m, speed_mps, standing=since_s is not None):
                    accel = min(accel, stopping_accel(speed_mps, waiting_m - s_m, self.traits.brake_mpss))
            elif self._in_the_way(approach, other, s_m, speed_mps):
                to_zone_m = stream.hold_m - _ZONE_MARGIN_M - s_m
                accel = min(accel, stopping_accel(speed_mps, to_zone_m, self.traits.brake_mpss))
        return accel

    def _waiting_place(self, stream: Stream) -> float:
        """Return where the ego's centre waits for a stream that goes first."""
        route, before_m = self.start.route, stream.hold_m - _ZONE_MARGIN_M
        if route.origin_kind == "driveway" and "stop_line" in route.landmarks:
            return min(before_m, route.landmarks["stop_line"] - 0.5 * self.start.length_m - _LINE_MARGIN_M)
        return min(before_m, route.landmarks.get("turn_start", before_m) - _ZONE_MARGIN_M)

    def _accepts_gap(
        self, approach: Approach, other: VehicleState, s_m: float, speed_mps: float, *, standing: bool
    ) -> bool:
        """Decide whether to go before a vehicle that has the right of way, and remember it."""
        if self._line_m is not None:
            return False  # the stop comes first, and the gap is judged from standstill
        if standing:
            return approach.accepted  # it has only just stopped: no new decision until it has stood for a while
        stream, traits = approach.stream, self.traits
        top_mps = max(self.profile.at(stream.ego_in_m), 1.0)
        pull_mpss = _GAP_ACCEL * traits.accel_mpss
        out_s = travel_time(stream.ego_out_m - s_m, speed_mps, pull_mpss, top_mps)
        needed_s = out_s + _CLEARANCE_S
        if stream.merges:
            # Whoever comes from behind must have room to slow down to us.
            slower_mps = max(0.0, other.speed_mps - top_mps)
            needed_s += _MERGE_CLEARANCE_S + slower_mps * slower_mps / (4.0 * max(other.speed_mps, 1.0))
        needed_s = max(needed_s, traits.critical_gap_s) - (_KEEP_DECISION_S if approach.accepted else 0.0)
        assert approach.foot.s_m is not None
        arrival_s = _arrival_s(other, stream.in_m - approach.foot.s_m)
        leaves_s = (stream.out_m - approach.foot.s_m) / other.speed_mps
        in_s = travel_time(stream.ego_in_m - s_m, speed_mps, traits.accel_mpss, top_mps)
        approach.accepted = arrival_s > needed_s
        # Behind one that passes it sets off when that one is through the middle, not when it is seen coming.
        passing = approach.foot.s_m > 0.5 * (stream.in_m + stream.out_m)
        return approach.accepted or (passing and leaves_s + _CLEARANCE_S < in_s)

    def _in_the_way(self, approach: Approach, other: VehicleState, s_m: float, speed_mps: float) -> bool:
        """Return whether a vehicle will be in the conflict zone when the ego is."""
        stream, traits = approach.stream, self.traits
        assert approach.foot.s_m is not None
        in_m, out_m = stream.in_m - approach.foot.s_m, stream.out_m - approach.foot.s_m
        in_s, out_s = _arrival_s(other, in_m), _arrival_s(other, out_m)
        if in_s > _HORIZON_S or (in_m > 0.0 and not _will_enter(other, in_m, in_s, stream.ego_yields)):
            return False
        top_mps = max(self.profile.at(stream.ego_in_m), 1.0)
        ego_in_s = travel_time(stream.ego_in_m - s_m, speed_mps, traits.accel_mpss, top_mps)
        ego_out_s = travel_time(stream.ego_out_m - s_m, speed_mps, _GAP_ACCEL * traits.accel_mpss, top_mps)
        first, last = ego_out_s + _CLEARANCE_S < in_s, out_s + _CLEARANCE_S < ego_in_s
        return not first and not last


def _arrival_s(other: VehicleState, distance_m: float) -> float:
    """Return when another vehicle will have covered a distance: one that speeds up goes on doing so for a while."""
    speed_mps = max(other.speed_mps, 0.1)
    if other.accel_mps2 <= _PULLS_OUT_MPSS or distance_m <= 0.0:
        return distance_m / speed_mps
    return travel_time(distance_m, speed_mps, other.accel_mps2, speed_mps + _SPEEDS_UP_S * other.accel_mps2)


def _will_enter(other: VehicleState, in_m: float, in_s: float, has_priority: bool) -> bool:
    """Return whether a vehicle that is about to reach the conflict zone will go in rather than stop before it."""
    if has_priority:
        return other.accel_mps2 >= 0.0 or needed_brake(other.speed_mps, in_m) > -other.accel_mps2
    sets_off = other.accel_mps2 > _SETS_OFF_MPSS and in_s < _SETS_OFF_S
    return sets_off or needed_brake(other.speed_mps, in_m) > _WONT_STOP_MPSS


def wanted_speeds(traits: Traits, start: EgoStart) -> SpeedProfile:
    """Return the speeds that a driver wants along its route."""
    return speed_profile(
        start,
        factor=traits.limit_factor,
        desired_mps=traits.desired_mps,
        lateral_mpss=traits.lateral_mpss,
        brake_mpss=traits.brake_mpss,
    )
