"""The smoothest way to a trigger: of all that begin and end alike, the one that accelerates least.

What enters: the stretches that a solver divided the way into, and the motion that it found. What leaves: accelerations,
or nothing where the smoothest way would break a bound. A model that satisfies is arbitrary, and solvers like corners: a
hero that speeds up and brakes by turns looks like nobody, and uses up what it may need for the ego's next whim.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

_SLACK_MPS, _SLACK_MPSS = 1e-6, 1e-9


@dataclass(frozen=True, slots=True)
class Leg:
    """A stretch of constant acceleration: how long it lasts (s), and between which bounds it may accelerate (m/s^2)."""

    duration_s: float
    least_mpss: float
    most_mpss: float


def smoothed(
    moves: Sequence[tuple[float, float, int]],
    bounds_mpss: Sequence[tuple[float, float]],
    speed_mps: float,
    top_mps: float,
) -> list[tuple[float, float, int]]:
    """Return ``(duration_s, accel_mpss, piece)`` with the first moves, as many as there are bounds, the smoothest."""
    legs = [Leg(move[0], *bounds) for move, bounds in zip(moves, bounds_mpss, strict=False)]
    accels = smoothest(legs, speed_mps, top_mps, [accel for _, accel, _ in moves[: len(legs)]])
    smooth = [(duration_s, accel, piece) for (duration_s, _, piece), accel in zip(moves, accels, strict=False)]
    return [*smooth, *moves[len(legs) :]]


def smoothest(legs: Sequence[Leg], speed_mps: float, top_mps: float, accels_mpss: Sequence[float]) -> list[float]:
    """Return accelerations (m/s^2) with the least sum of squares over time that come as far, and to the same speed.

    Parameters
    ----------
    legs
        The stretches, in order.
    speed_mps, top_mps
        At the beginning; at most, anywhere.
    accels_mpss
        Those of the motion known, which are returned where no smoother one is found within the bounds.
    """
    accels = list(accels_mpss)
    ends = _times(legs)
    remaining = [ends[-1] - 0.5 * (before + after) for before, after in pairwise(ends)]
    fixed: dict[int, float] = {}
    while len(legs) - len(fixed) >= 2:
        found = _least_squares(legs, remaining, accels, fixed)
        if found is None:
            return accels
        beyond = {
            k: min(max(found[k], leg.least_mpss), leg.most_mpss)
            for k, leg in enumerate(legs)
            if not leg.least_mpss - _SLACK_MPSS <= found[k] <= leg.most_mpss + _SLACK_MPSS
        }
        if not beyond:
            return found if _keeps_to_speeds(legs, speed_mps, top_mps, found) else accels
        fixed |= beyond
    return accels


def _times(legs: Sequence[Leg]) -> list[float]:
    times = [0.0]
    for leg in legs:
        times.append(times[-1] + leg.duration_s)
    return times


def _least_squares(
    legs: Sequence[Leg], remaining_s: Sequence[float], accels: Sequence[float], fixed: dict[int, float]
) -> list[float] | None:
    """Return what meets both sums, of speed gained and of way gained by it, with least squares; some legs are fixed.

    It is linear in the time that remains: acceleration ``a + b r``, with Lagrange multipliers a and b.
    """
    free = [k for k in range(len(legs)) if k not in fixed]
    gain = sum(leg.duration_s * accel for leg, accel in zip(legs, accels, strict=True))
    way = sum(leg.duration_s * r * accel for leg, r, accel in zip(legs, remaining_s, accels, strict=True))
    gain -= sum(legs[k].duration_s * accel for k, accel in fixed.items())
    way -= sum(legs[k].duration_s * remaining_s[k] * accel for k, accel in fixed.items())
    whole = sum(legs[k].duration_s for k in free)
    first = sum(legs[k].duration_s * remaining_s[k] for k in free)
    second = sum(legs[k].duration_s * remaining_s[k] ** 2 for k in free)
    determinant = whole * second - first * first
    if determinant < 1e-9:
        return None
    level = (gain * second - way * first) / determinant
    slope = (way * whole - gain * first) / determinant
    return [fixed.get(k, level + slope * remaining_s[k]) for k in range(len(legs))]


def _keeps_to_speeds(legs: Sequence[Leg], speed_mps: float, top_mps: float, accels: Sequence[float]) -> bool:
    for leg, accel in zip(legs, accels, strict=True):
        speed_mps += leg.duration_s * accel
        if not -_SLACK_MPS <= speed_mps <= top_mps + _SLACK_MPS:
            return False
    return True
