"""Whoever has nothing more to do holds its speed, and brakes for bends and to keep clear of who goes first.

What enters: motions that no plan changes any more, meetings, and how fast bends may be driven. What leaves: the same
motion, or one that brakes from now on, as evenly and as little as that takes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from scenewright.motion.limits import BRAKE_MAX_MPSS
from scenewright.motion.profile import Profile, Segment
from scenewright.plan.asked import Caps
from scenewright.plan.pairs import Meeting, passes_s
from scenewright.plan.preferences import Preferences
from scenewright.roads.bodies import VEHICLE_LENGTH_M

_LEAST_ROOM_M = 0.05  # who has no more room than this brakes at once, as if it had so much, and no harder than cars can


def goes_on(
    hero: int,
    motions: Mapping[int, Profile],
    meetings: Sequence[Meeting],
    time_s: float,
    wanted: Preferences,
    caps: Caps,
) -> Profile:
    """Return how a hero goes on: it begins to brake where later it would take more than what is comfortable."""
    motion = motions[hero]
    s_m, speed_mps, accel = motion.state(time_s)
    needs = [*_needs(hero, motions, meetings, time_s, wanted), *_bends(caps, s_m, speed_mps, wanted)]
    rate, change_mps = max(needs, default=(0.0, 0.0))
    if accel == 0.0 and rate < wanted.accel_mpss:
        return motion
    driven = motion.until(time_s)
    last = driven[-1]
    if last.end_s < time_s:
        last = Segment(last.end_s, time_s - last.end_s, last.end_s_m, last.end_speed_mps, 0.0, last.piece)
        driven.append(last)
    if rate > 0.0:
        rate = max(rate, -accel)  # once begun it is not eased, so that it ends
        driven.append(Segment(time_s, change_mps / rate, last.end_s_m, speed_mps, -rate, last.piece))
    return Profile(tuple(driven), motion.knot_times_s)


def _bends(caps: Caps, s_m: float, speed_mps: float, wanted: Preferences) -> Iterator[tuple[float, float]]:
    """Yield at which even rates (m/s^2) it has to brake for bends, and by how much (m/s): harder only where it must."""
    room_m = np.maximum(caps.places - s_m, _LEAST_ROOM_M)
    for fastest, hardest_mpss in ((caps.comfortable, wanted.braking_mpss), (caps.most, BRAKE_MAX_MPSS)):
        rates = np.where(caps.places >= s_m, 0.5 * (speed_mps**2 - fastest**2) / room_m, 0.0)
        worst = int(np.argmax(rates))
        if rates[worst] > 0.0:
            yield min(float(rates[worst]), hardest_mpss), speed_mps - float(fastest[worst])


def _needs(
    hero: int, motions: Mapping[int, Profile], meetings: Sequence[Meeting], time_s: float, wanted: Preferences
) -> Iterator[tuple[float, float]]:
    """Yield at which even rates (m/s^2) the hero has to brake for whom goes first, and by how much (m/s)."""
    s_m, speed_mps, _ = motions[hero].state(time_s)
    for meeting in meetings:
        if meeting.second != hero:
            continue
        first = motions[meeting.first]
        first_m, first_mps, first_mpss = first.state(time_s)
        room_m, change_mps, besides_mpss = float("inf"), 0.0, 0.0
        if meeting.zones_m is not None and first_m < (out_m := meeting.zones_m[0][1] + wanted.clear_m):
            before_m = meeting.zones_m[1][0] - wanted.clear_m - s_m
            if before_m >= -wanted.clear_m and speed_mps * (passes_s(first, out_m) - time_s) > before_m:
                room_m, change_mps = before_m, speed_mps
        elif meeting.lane_m is not None and first_m < meeting.lane_m[0][1] and s_m < meeting.lane_m[1][1]:
            room_m = first_m - meeting.offset_m - s_m - VEHICLE_LENGTH_M - wanted.clear_in_lane_m
            change_mps = speed_mps - first_mps
            if 2.0 * max(room_m, _LEAST_ROOM_M) * -first_mpss < first_mps * change_mps:  # met while it still moves
                besides_mpss = max(0.0, -first_mpss)
            elif first_mpss < 0.0:  # it may come to stand
                room_m, change_mps = room_m - 0.5 * first_mps**2 / first_mpss, speed_mps
        if change_mps > 0.0:
            rate = besides_mpss + 0.5 * change_mps**2 / max(room_m, _LEAST_ROOM_M)
            yield min(max(rate, wanted.accel_mpss if room_m <= _LEAST_ROOM_M else 0.0), BRAKE_MAX_MPSS), change_mps
