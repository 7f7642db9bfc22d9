"""Foresees an ego that follows a hero: what the hero is about to do is part of what the ego will do.

What enters: a prediction that leaves the hero out, the ego's past, the hero's motion. What leaves: a prediction with
it. The follower is the intelligent driver model's (Treiber, Hennecke and Helbing 2000) with textbook parameters and
the headway that the ego has kept lately; for a moment it goes on to do otherwise by as much as it does now.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import takewhile

from scenewright.drive.speeds import following_accel
from scenewright.motion.profile import Profile, chain
from scenewright.plan.prediction import GOES_ON_S, STEPS_S, EgoSample
from scenewright.roads.bodies import VEHICLE_LENGTH_M

_STANDSTILL_M, _ACCEL_MPSS, _BRAKE_MPSS, _HARDEST_MPSS = 2.0, 1.5, 2.0, 8.0
# A hero that takes less than this off the ego's acceleration is too far ahead to matter yet.
_NOTABLE_MPSS = 0.15
# The headway that people keep; within which bounds, over how long a past and in how many halvings one's own is found,
# and below which speed it is not (m/s). Narrower bounds were measured, and foresee less well (docs/evaluation.md).
_HEADWAY_S, _HEADWAYS_S, _JUDGED_S, _HALVINGS, _CRAWLS_MPS = 1.3, (0.2, 6.0), 1.0, 7, 1.0
# Who brakes harder than this by itself slows for its turn or its stop line, whoever is ahead.
_OWN_REASONS_MPSS = 0.3
_follows = partial(following_accel, accel_mpss=_ACCEL_MPSS, brake_mpss=_BRAKE_MPSS, standstill_m=_STANDSTILL_M)


@dataclass(frozen=True, slots=True)
class Leader:
    """A hero that drives ahead of the ego on its lane, as planned, or otherwise from a time on.

    `motion` is its past and planned one; `offset_m` is added to its arc length to compare it with the ego's. From a
    time on it is so much further on (m), so much faster (m/s), and faster by so much each second (m/s^2).
    """

    motion: Profile
    offset_m: float
    from_s: float = 0.0
    further_m: float = 0.0
    faster_mps: float = 0.0
    ever_faster_mpss: float = 0.0

    def state(self, time_s: float) -> tuple[float, float]:
        """Return its place on the ego's way (m) and its speed (m/s) at a time."""
        s_m, speed_mps, _ = self.motion.state(time_s)
        since, more = max(0.0, time_s - self.from_s), self.ever_faster_mpss
        s_m += self.further_m + (self.faster_mps + 0.5 * more * since) * since
        return s_m + self.offset_m, speed_mps + self.faster_mps + more * since

    def ahead(self, time_s: float, s_m: float) -> tuple[float, float]:
        """Return the room (m) between the bumpers for an ego at `s_m`, and the leader's speed (m/s)."""
        place_m, speed_mps = self.state(time_s)
        return place_m - s_m - VEHICLE_LENGTH_M, speed_mps


def foresee_follower(base: Profile, history: Sequence[EgoSample], leader: Leader, cruise_mps: float) -> Profile:
    """Return how the ego goes on behind `leader`; where it is not behind it `base`, how it would go on alone.

    `history` are its states up to now, `cruise_mps` is how fast people drive there.
    """
    time_s, start_m, start_mps, now_mpss = history[-1]
    cruise_mps = max(cruise_mps, 1.02 * start_mps)
    if leader.ahead(time_s, start_m)[0] <= 0.0:
        return base
    s_m, speed_mps = start_m, start_mps
    own_mpss, headway_s = 0.0, _HEADWAY_S
    engaged = -_interaction(time_s, s_m, speed_mps, leader, headway_s) > _NOTABLE_MPSS
    if engaged:
        headway_s = _own_headway_s(history, leader, cruise_mps)
        if time_s > 0.0:  # it has been seen to drive
            own_mpss = now_mpss - _modelled(time_s, s_m, speed_mps, leader, cruise_mps, headway_s)
    moves: list[tuple[float, float, int]] = []
    for elapsed_s, lasts_s in STEPS_S:
        then_s = time_s + elapsed_s
        model = _modelled(then_s, s_m, speed_mps, leader, cruise_mps, headway_s)
        alone = base.state(then_s)[2]
        if not engaged:
            accel, engaged = min(alone, model), model < alone
        elif elapsed_s < GOES_ON_S:
            accel = model + own_mpss
        else:
            accel = min(model, alone) if alone < -_OWN_REASONS_MPSS else model
        accel = max(accel, -_HARDEST_MPSS, -speed_mps / lasts_s)
        moves.append((lasts_s, accel, 0))
        s_m += (speed_mps + 0.5 * accel * lasts_s) * lasts_s
        speed_mps = max(0.0, speed_mps + accel * lasts_s)
    return Profile(chain(time_s, start_m, start_mps, moves))


def _interaction(time_s: float, s_m: float, speed_mps: float, leader: Leader, headway_s: float) -> float:
    return _follows(speed_mps, *leader.ahead(time_s, s_m), headway_s=headway_s)


def _modelled(
    time_s: float, s_m: float, speed_mps: float, leader: Leader, cruise_mps: float, headway_s: float
) -> float:
    free_mpss = _ACCEL_MPSS * (1.0 - (speed_mps / cruise_mps) ** 4)
    return max(-_HARDEST_MPSS, free_mpss + _interaction(time_s, s_m, speed_mps, leader, headway_s))


def _own_headway_s(history: Sequence[EgoSample], leader: Leader, cruise_mps: float) -> float:
    """Return the headway (s) that the ego seems to keep: with it the model drives as the ego has driven lately."""
    since_s = max(history[-1][0] - _JUDGED_S, 1e-9)  # at zero it only begins
    samples = list(takewhile(lambda sample: sample[0] >= since_s, reversed(history)))[::5]
    if not samples or history[-1][2] < _CRAWLS_MPS:
        return _HEADWAY_S
    seen = sum(sample[3] for sample in samples) / len(samples)
    low, high = _HEADWAYS_S
    for _ in range(_HALVINGS):  # the longer the headway, the less it accelerates
        middle = 0.5 * (low + high)
        modelled = sum(_modelled(*sample[:3], leader, cruise_mps, middle) for sample in samples) / len(samples)
        low, high = (middle, high) if modelled > seen else (low, middle)
    return 0.5 * (low + high)
