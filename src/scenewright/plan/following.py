"""Foresees an ego that follows a hero: what the hero is about to do is part of what the ego will do.

What enters: a prediction that leaves the hero out, the ego's past, the hero's motion. What leaves: a prediction with
it. The follower is the intelligent driver model's (Treiber, Hennecke and Helbing 2000) with textbook parameters, put
right by how the ego has driven lately; one that is seen not to heed who drives ahead is taken not to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import Protocol

from scenewright.drive.speeds import following_accel
from scenewright.motion.profile import Profile, chain
from scenewright.plan.prediction import EgoSample
from scenewright.roads.bodies import VEHICLE_LENGTH_M

_HEADWAY_S, _STANDSTILL_M, _ACCEL_MPSS, _BRAKE_MPSS = 1.3, 2.0, 1.5, 2.0
_HARDEST_MPSS = 8.0
# A hero that takes less than this off the ego's acceleration is too far ahead to matter yet.
_NOTABLE_MPSS = 0.15
# Over how long a past it is judged whether the ego heeds the hero, and for how long its own way lasts (s).
_JUDGED_S, _LATELY_S, _OWN_WAY_S = 1.0, 0.4, 1.0
_LARGEST_OWN_MPSS = 1.5
# Headways that people keep, in how many halvings one is told from another, and below which speed it is not (m/s).
_HEADWAYS_S, _HALVINGS, _CRAWLS_MPS = (0.8, 2.5), 5, 1.0
# Accelerations further apart than this tell one who heeds from one who does not.
_TELLING_MPSS = 0.3
_FINE_STEP_S, _FINE_FOR_S, _COARSE_STEP_S, _HORIZON_S = 0.1, 4.0, 0.4, 20.0


class Moving(Protocol):
    """A motion along a route."""

    def state(self, time_s: float, /) -> tuple[float, float, float]:
        """Return place (m), speed (m/s) and acceleration (m/s^2) at a time."""
        ...


@dataclass(frozen=True, slots=True)
class Leader:
    """A hero that drives ahead of the ego on its lane.

    Attributes
    ----------
    motion
        Its past and planned motion.
    offset_m
        What to add to its arc length to compare it with the ego's.
    """

    motion: Moving
    offset_m: float

    def ahead(self, time_s: float, s_m: float) -> tuple[float, float]:
        """Return the room (m) between the bumpers for an ego at `s_m`, and the leader's speed (m/s)."""
        place_m, speed_mps, _ = self.motion.state(time_s)
        return place_m + self.offset_m - s_m - VEHICLE_LENGTH_M, speed_mps


def foresee_follower(base: Profile, history: Sequence[EgoSample], leader: Leader, cruise_mps: float) -> Profile:
    """Return how the ego goes on behind `leader`; `base` where it does not, or is not near enough.

    Parameters
    ----------
    base
        How it would go on alone.
    history
        Its states up to now.
    cruise_mps
        How fast people drive there.
    """
    time_s, start_m, start_mps, _ = history[-1]
    cruise_mps = max(cruise_mps, 1.02 * start_mps)
    room_m, _ = leader.ahead(time_s, start_m)
    if room_m <= 0.0 or not _heeds(history, leader, cruise_mps):
        return base
    s_m, speed_mps = start_m, start_mps
    own_mpss, headway_s = 0.0, _HEADWAY_S
    engaged = -_interaction(time_s, s_m, speed_mps, leader) > _NOTABLE_MPSS
    if engaged:
        headway_s = _own_headway_s(history, leader, cruise_mps)
        own_mpss = _own_way(history, leader, cruise_mps, headway_s)
    moves: list[tuple[float, float, int]] = []
    elapsed = 0.0
    while elapsed < _HORIZON_S:
        step_s = _FINE_STEP_S if elapsed < _FINE_FOR_S else _COARSE_STEP_S
        now_s = time_s + elapsed
        model = _modelled(now_s, s_m, speed_mps, leader, cruise_mps, headway_s)
        alone = base.state(now_s)[2]
        if engaged:
            accel = model + own_mpss * (elapsed < _OWN_WAY_S)
            if elapsed >= _OWN_WAY_S and alone < -_TELLING_MPSS:
                accel = min(accel, alone)  # it slows for its turn or its stop line
        else:
            accel = min(alone, model)
            engaged = model < alone
        accel = max(accel, -_HARDEST_MPSS, -speed_mps / step_s)
        moves.append((step_s, accel, 0))
        s_m += (speed_mps + 0.5 * accel * step_s) * step_s
        speed_mps = max(0.0, speed_mps + accel * step_s)
        elapsed += step_s
    return Profile(chain(time_s, start_m, start_mps, moves))


def _interaction(time_s: float, s_m: float, speed_mps: float, leader: Leader, headway_s: float = _HEADWAY_S) -> float:
    room_m, leader_mps = leader.ahead(time_s, s_m)
    return following_accel(
        speed_mps,
        room_m,
        leader_mps,
        accel_mpss=_ACCEL_MPSS,
        brake_mpss=_BRAKE_MPSS,
        headway_s=headway_s,
        standstill_m=_STANDSTILL_M,
    )


def _free(speed_mps: float, cruise_mps: float) -> float:
    return _ACCEL_MPSS * (1.0 - (speed_mps / cruise_mps) ** 4)


def _modelled(
    time_s: float, s_m: float, speed_mps: float, leader: Leader, cruise_mps: float, headway_s: float = _HEADWAY_S
) -> float:
    accel = _free(speed_mps, cruise_mps) + _interaction(time_s, s_m, speed_mps, leader, headway_s)
    return max(-_HARDEST_MPSS, accel)


def _lately(history: Sequence[EgoSample], for_s: float) -> list[EgoSample]:
    since_s = history[-1][0] - for_s
    return list(takewhile(lambda sample: sample[0] >= since_s, reversed(history)))


def _heeds(history: Sequence[EgoSample], leader: Leader, cruise_mps: float) -> bool:
    """Whether the ego's last second speaks for a follower rather than for one alone, or one that just holds on."""
    samples = _lately(history, _JUDGED_S)[::5]
    if history[-1][0] - samples[-1][0] < 0.5 * _JUDGED_S:
        return True
    seen = sum(sample[3] for sample in samples) / len(samples)
    alone = sum(_free(sample[2], cruise_mps) for sample in samples) / len(samples)
    behind = sum(_modelled(*sample[:3], leader, cruise_mps) for sample in samples) / len(samples)
    if alone - behind < _TELLING_MPSS:
        return True
    others = (alone, 0.0) if behind < -_TELLING_MPSS else (alone,)
    return all(abs(seen - behind) <= abs(seen - other) for other in others)


def _own_headway_s(history: Sequence[EgoSample], leader: Leader, cruise_mps: float) -> float:
    """Return the headway (s) that the ego seems to keep: with it the model drives as the ego has driven lately."""
    samples = [sample for sample in _lately(history, _JUDGED_S) if sample[0] > 0.0][::5]
    if not samples or history[-1][2] < _CRAWLS_MPS:
        return _HEADWAY_S
    seen = sum(sample[3] for sample in samples) / len(samples)
    low, high = _HEADWAYS_S
    for _ in range(_HALVINGS):  # the longer the headway, the less it accelerates
        middle = 0.5 * (low + high)
        modelled = sum(_modelled(*sample[:3], leader, cruise_mps, middle) for sample in samples) / len(samples)
        low, high = (middle, high) if modelled > seen else (low, middle)
    return 0.5 * (low + high)


def _own_way(history: Sequence[EgoSample], leader: Leader, cruise_mps: float, headway_s: float) -> float:
    """Return by how much the ego has lately accelerated more than the model does (m/s^2)."""
    samples = [sample for sample in _lately(history, _LATELY_S) if sample[0] > 0.0]
    if not samples:
        return 0.0
    more = sum(sample[3] - _modelled(*sample[:3], leader, cruise_mps, headway_s) for sample in samples) / len(samples)
    return max(-_LARGEST_OWN_MPSS, min(_LARGEST_OWN_MPSS, more))
