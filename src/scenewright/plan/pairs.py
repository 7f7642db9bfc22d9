"""Heroes keep clear of each other: who goes first wherever the ways of two of them meet, and the rows for that.

What enters: a scene, motions, and motions as functions of unknowns. What leaves: meetings, each with who goes first,
and bounds. Nobody drives backwards, so of a stretch that two must not both be in this says all: at some moment the one
is out of it, and the other not yet in. That moment is an unknown of the plan. In one lane the gap is looked at often.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.limits import ROOM
from scenewright.motion.profile import Profile
from scenewright.plan.preferences import Preferences
from scenewright.plan.rows import Columns, Rows
from scenewright.plan.shooting import Shot
from scenewright.program.structure import Structure, placed_at
from scenewright.program.types import EGO
from scenewright.roads.bodies import CAR, VEHICLE_LENGTH_M, Body
from scenewright.roads.conflicts import conflicts, shared_stretches
from scenewright.roads.grounding import Scene
from scenewright.roads.zones import Zone, overlap

Array = NDArray[np.float64]
Along = tuple[Array, Array, Array]

# How often the gap in a lane is looked at: between two looks even an emergency stop takes 0.25 m of it at most.
LOOK_S = 0.4
# For how long after the last plan of anybody: then everybody holds its speed, and runs are over.
AFTER_S = 8.0
_NEVER = np.inf


@dataclass(frozen=True, slots=True)
class Meeting:
    """Where the ways of two heroes meet, of whom `first` goes first.

    They must not both be in the stretches `zones_m` of their ways; None where they share a lane from the start. On each
    way they share one from where to where `lane_m` says; None where they only cross. There `offset_m` is added to the
    second's arc length to compare it with the first's.
    """

    first: int
    second: int
    zones_m: tuple[Zone, Zone] | None
    lane_m: tuple[Zone, Zone] | None = None
    offset_m: float = 0.0

    def turned(self) -> Meeting:
        """Return the same with the other going first."""
        zones, lane = (None if each is None else (each[1], each[0]) for each in (self.zones_m, self.lane_m))
        return Meeting(self.second, self.first, zones, lane, -self.offset_m)

    def has_begun(self, first_m: float, second_m: float) -> bool:
        """Whether the first is in the lane that they share, and the second behind it."""
        return self.lane_m is not None and first_m >= max(self.lane_m[0][0], second_m + self.offset_m)

    def late_s(self, motions: Mapping[int, Profile]) -> float:
        """Return for how long (s) both would be in the stretch if the first went first, or how far it is behind (m)."""
        if self.zones_m is not None:
            left_s = passes_s(motions[self.first], self.zones_m[0][1])
            enters_s = passes_s(motions[self.second], self.zones_m[1][0])
            return 0.0 if enters_s == _NEVER else max(0.0, left_s - enters_s)
        assert self.lane_m is not None
        ends_s = max(motion.end_s for motion in (motions[self.first], motions[self.second]))
        s_m, other_m = (
            np.array([motions[hero].state(float(t))[0] for t in np.arange(0.0, ends_s + LOOK_S, LOOK_S)])
            for hero in (self.first, self.second)
        )
        both = (s_m < self.lane_m[0][1]) & (other_m < self.lane_m[1][1])
        return float(np.mean(other_m + self.offset_m - s_m, where=both)) if both.any() else 0.0


def passes_s(motion: Profile, place_m: float) -> float:
    """Return when a motion has come to a place; never is a time too."""
    if motion.state(motion.start_s)[0] >= place_m:
        return motion.start_s
    found = motion.time_at(place_m)
    return _NEVER if found is None else found


# -- who meets whom ---------------------------------------------------------------------------------------------------
def meetings_of(scene: Scene) -> tuple[Meeting, ...]:
    """Return every meeting of two heroes of a scene; who goes first in it is not decided."""
    heroes = [hero.id for hero in scene.program.heroes]
    return tuple(meeting for a, b in combinations(heroes, 2) for meeting in _meetings(scene, a, b))


def behind_ego(scene: Scene, hero: int) -> tuple[Meeting, ...]:
    """Return where on a lane a hero may come behind the ego."""
    return tuple(replace(each, zones_m=None) for each in _meetings(scene, EGO, hero) if each.lane_m is not None)


def _meetings(scene: Scene, a: int, b: int) -> Iterator[Meeting]:
    routes = scene.routes[a], scene.routes[b]
    clear_m = float(scene.program.manner.stricter(ROOM).clear_m)  # as far as that from a body is in its way
    grown = Body(CAR.length_m + clear_m, CAR.width_m + clear_m)
    found = conflicts(*routes, grown, grown)
    for stretch in shared_stretches(*routes):
        ends = [c for c in found if c.kind == "following" and (c.s_a_m, c.s_b_m) == stretch.end]
        until = (ends[0].zone_a_m[1], ends[0].zone_b_m[1]) if ends and stretch.goes_on else (_NEVER, _NEVER)
        begins = next((c for c in found if c.kind == "merging" and (c.s_a_m, c.s_b_m) == stretch.begin), None)
        zones = None if begins is None else (begins.zone_a_m, begins.zone_b_m)
        since = stretch.begin if zones is None else (zones[0][1], zones[1][1])
        lane = (since[0], until[0]), (since[1], until[1])
        yield Meeting(a, b, zones, lane, stretch.begin[0] - stretch.begin[1])
    for conflict in found:
        if conflict.kind == "crossing":
            yield Meeting(a, b, (conflict.zone_a_m, conflict.zone_b_m))


def in_order(
    meetings: Sequence[Meeting], scene: Scene, structure: Structure, motions: Mapping[int, Profile]
) -> tuple[Meeting, ...]:
    """Return the meetings in the order in which they are nearest to happening clear of each other as motions are.

    Without those of heroes that the program wants in each other.
    """
    in_contact = {frozenset(pair) for pair in _contacts(scene, structure, motions)}
    return tuple(
        min(meeting, meeting.turned(), key=lambda each: each.late_s(motions))
        for meeting in meetings
        if {meeting.first, meeting.second} not in in_contact
    )


def needed(meetings: Sequence[Meeting]) -> tuple[Meeting, ...]:
    """Return the meetings that do not follow from others.

    Of two on one way, who keeps clear of the nearer one in the order keeps clear of the other one too.
    """
    told = set(meetings)
    follows = [meeting for meeting in meetings if meeting.zones_m is None]
    others = {meeting for meeting in meetings for one in follows if _follows_from(meeting, one, told)}
    return tuple(meeting for meeting in meetings if meeting not in others)


def _follows_from(meeting: Meeting, one: Meeting, told: set[Meeting]) -> bool:
    """Whether a meeting follows from that of two on one way, and another of the same stretches."""
    if one.first == meeting.first:
        return replace(meeting, first=one.second) in told
    return one.second == meeting.second and replace(meeting, second=one.first) in told


def _contacts(scene: Scene, structure: Structure, motions: Mapping[int, Profile]) -> Iterator[tuple[int, int]]:
    """Yield heroes that touch at a moment at which the program says of both where they are."""
    for instant in {*structure.instants, *structure.triggers.values()}:
        placed = {
            actor: name for actor, name in instant if actor in placed_at(scene.program, instant) and actor in motions
        }
        for a, b in combinations(sorted(placed), 2):
            pose_a, pose_b = (
                scene.routes[actor].path.poses(np.array([_place_m(motions[actor], name)]))
                for actor, name in ((a, placed[a]), (b, placed[b]))
            )
            if overlap(pose_a, pose_b, CAR, CAR)[0]:
                yield a, b


def _place_m(motion: Profile, knot: str) -> float:
    """Return where a motion is at a knot; an even one, of which no more is known, ends at its trigger."""
    return motion.state(motion.knot_times_s.get(knot, motion.end_s))[0]


# -- rows -------------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Way:
    """A hero's motion: what it drives, if it does, and from some time on what is planned, by unknowns `columns`."""

    motion: Profile | None
    shot: Shot | None = None
    columns: Columns = field(default_factory=lambda: np.zeros(0, dtype=np.intp))

    def along(self, times: Array) -> Along:
        """Return places and speeds at times, and how the places depend on its unknowns, shape (times, unknowns)."""
        s, v, d_s = np.zeros(len(times)), np.zeros(len(times)), np.zeros((len(times), len(self.columns)))
        planned = np.zeros(len(times), dtype=bool)
        if self.shot is not None:
            planned = times >= self.shot.time[0] - 1e-9
            s[planned], v[planned], _, d_s[planned], _ = self.shot.along(times[planned])
        if self.motion is not None:
            for k in np.flatnonzero(~planned):
                s[k], v[k], _ = self.motion.state(float(times[k]))
        return s, v, d_s


@dataclass(frozen=True, slots=True)
class PairRows:
    """The bounds of all meetings, for values `z` of all unknowns.

    Each of the `meetings` is there with the unknown moment at which the first is out and the second not yet in; None
    where the first never is, so that the second is to stay out. Lanes are looked at at `times`, of which the last is
    the end of all plans, but not where there is more room than `near_m`. `driven` tells of ways that nothing can change
    where these are then, as `Way.along` does.
    """

    meetings: Sequence[tuple[Meeting, int | None]]
    ways: Mapping[int, Way]
    times: Array
    driven: Mapping[int, Along]
    wanted: Preferences
    z: Array
    near_m: float

    def add(self, bounds: Rows) -> float:
        """Add all bounds; return the largest share of a margin that is missing: from 1 on boxes may touch."""
        worst = 0.0
        for _, short_m, slopes, columns, margin_m in self._all():
            bounds.by = columns
            if len(columns):  # who only carries out what was planned enters where it enters
                bounds.add_all(short_m, slopes, self.wanted.clear_price)
            worst = max(worst, float(short_m.max()) / margin_m)
        bounds.by = None
        return worst

    def dearest(self) -> tuple[float, set[int]]:
        """Return by how much the worst two are too near, in squares summed (m^2), and who they are."""
        costs = np.zeros(len(self.meetings))
        for number, short_m, *_ in self._all():
            costs[number] += np.sum(np.maximum(short_m, 0.0) ** 2)
        if not len(costs):
            return 0.0, set()
        worst, _ = self.meetings[int(np.argmax(costs))]
        return float(np.max(costs)), {worst.first, worst.second}

    def _all(self) -> Iterator[tuple[int, Array, Array, Columns, float]]:
        """Yield bounds: of which meeting, what is missing (m), its slopes by which unknowns, and the margin (m)."""
        moments: dict[int, list[int]] = {hero: [] for hero in self.ways}
        for meeting, moment in self.meetings:
            if moment is not None:
                moments[meeting.first].append(moment)
                moments[meeting.second].append(moment)
        looked, between = {}, {}
        for hero, way in self.ways.items():
            known, at = self.driven.get(hero), self.z[moments[hero]]
            s, v, d_s = way.along(at if known is not None else np.append(self.times, at))
            count = 0 if known is not None else len(self.times)
            looked[hero] = known or (s[:count], v[:count], d_s[:count])
            between[hero] = zip(s[count:], v[count:], d_s[count:], strict=True)
        for number, (meeting, moment) in enumerate(self.meetings):
            if meeting.zones_m is not None:
                out_m, in_m = meeting.zones_m[0][1] + self.wanted.clear_m, meeting.zones_m[1][0] - self.wanted.clear_m
                for hero, sense, place_m in ((meeting.first, -1.0, out_m), (meeting.second, 1.0, in_m)):
                    columns = self.ways[hero].columns
                    if moment is not None:
                        s, v, d_s = next(between[hero])
                        slope, columns = np.append(d_s, v), np.append(columns, moment)
                    elif hero == meeting.second:
                        s, slope = looked[hero][0][-1], looked[hero][2][-1]
                    else:
                        continue
                    yield number, np.array([sense * (s - place_m)]), sense * slope[None], columns, self.wanted.clear_m
            if meeting.lane_m is not None:
                short_m, slopes, columns = self._in_lane(meeting, looked[meeting.first], looked[meeting.second])
                if len(short_m):
                    yield number, short_m, slopes, columns, self.wanted.clear_in_lane_m

    def _in_lane(self, meeting: Meeting, first: Along, second: Along) -> tuple[Array, Array, Columns]:
        """Return what is missing between two in their common lane (m), or until the first has left it, if that is less.

        Wherever that is near. It counts as there for one look more: between two looks the other comes nearer.
        """
        assert meeting.lane_m is not None
        (since_m, until_m), (_, other_until_m) = meeting.lane_m
        (s, v, d_s), (other, _, d_other) = first, second
        short_m = self.wanted.clear_in_lane_m + VEHICLE_LENGTH_M - (s - meeting.offset_m - other)
        stays_m = until_m + LOOK_S * v - s
        d_other, short_m = d_other * (short_m < stays_m)[:, None], np.minimum(short_m, stays_m)
        near = (s >= since_m) & (other < other_until_m) & (short_m > -self.near_m)
        columns = np.concatenate([self.ways[meeting.first].columns, self.ways[meeting.second].columns])
        return short_m[near], np.hstack([-d_s[near], d_other[near]]), columns
