"""Speeds along a route, and the accelerations that keep to them: plain arithmetic for the driver models.

What enters: a route with its lanes' limits, distances and speeds. What leaves: a speed for every place, accelerations
in m/s^2, travel times. It knows nothing of right of way or of who the others are.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from scenewright.drive.protocol import EgoStart

_STEP_M = 0.5
_STRAIGHT_PER_M = 1e-4
_LOOK_AHEAD_S = 0.5
_HALT_M, _HALT_MPS = 0.3, 0.3
_NO_DISTANCE_M = 0.05


@dataclass(frozen=True, slots=True)
class SpeedProfile:
    """The speed a driver wants at every place of a route, falling early enough to brake comfortably.

    Attributes
    ----------
    speeds_mps
        The speed at every half metre from the start of the route.
    max_mps
        The largest of them.
    """

    speeds_mps: tuple[float, ...]
    max_mps: float

    def at(self, s_m: float) -> float:
        """Return the wanted speed in m/s; before and behind the route that of its ends."""
        index = int(s_m / _STEP_M)
        last = len(self.speeds_mps) - 1
        return self.speeds_mps[0 if index < 0 else last if index > last else index]


def speed_profile(
    start: EgoStart, *, factor: float, desired_mps: float | None, lateral_mpss: float, brake_mpss: float
) -> SpeedProfile:
    """Return the speeds on a route from lane limits and curves.

    Parameters
    ----------
    start
        Names the route, its map, and the limit where a lane has none.
    factor
        What the driver makes of a limit: 1 keeps to it.
    desired_mps
        The driver's own limit, or None.
    lateral_mpss
        The lateral acceleration a driver accepts in a curve, in m/s^2.
    brake_mpss
        How hard it brakes ahead of a slower place, positive, in m/s^2.
    """
    path, lanes = start.route.path, start.road_map.lanes
    limits_mps = np.array([lanes[name].speed_limit_mps or start.speed_limit_mps for name in start.route.lanes])
    s_m = _STEP_M * np.arange(int(path.length_m / _STEP_M) + 2, dtype=float)
    limit_mps = factor * limits_mps[np.searchsorted(start.route.lane_starts_m[1:], s_m, side="right")]
    # A driver in a hurry accepts more in a curve too, in proportion.
    bend_mps = np.sqrt(factor * lateral_mpss / np.maximum(np.abs(path.curvatures(s_m)), _STRAIGHT_PER_M))
    speeds_mps = np.minimum(np.minimum(limit_mps, inf if desired_mps is None else desired_mps), bend_mps).tolist()
    for index in range(len(speeds_mps) - 2, -1, -1):
        speeds_mps[index] = min(speeds_mps[index], sqrt(speeds_mps[index + 1] ** 2 + 2.0 * brake_mpss * _STEP_M))
    return SpeedProfile(tuple(speeds_mps), max(speeds_mps))


def free_accel(speed_mps: float, s_m: float, profile: SpeedProfile, accel_mpss: float, brake_mpss: float) -> float:
    """Return the acceleration of a driver alone: the intelligent driver model's, and down along the profile."""
    wanted_mps = profile.at(s_m)
    ahead = (profile.at(s_m + speed_mps * _LOOK_AHEAD_S) - speed_mps) / _LOOK_AHEAD_S
    if speed_mps >= wanted_mps:
        return max(-brake_mpss, min(ahead, (wanted_mps - speed_mps) / _LOOK_AHEAD_S))
    ratio = speed_mps / wanted_mps
    return min(accel_mpss * (1.0 - ratio * ratio * ratio * ratio), max(-brake_mpss, ahead))


def following_accel(
    speed_mps: float,
    gap_m: float,
    leader_mps: float,
    *,
    accel_mpss: float,
    brake_mpss: float,
    headway_s: float,
    standstill_m: float,
) -> float:
    """Return what the leader adds to the free acceleration (the intelligent driver model's interaction term), <= 0."""
    closing_mps = speed_mps - leader_mps
    wanted_m = standstill_m + max(
        0.0, speed_mps * headway_s + speed_mps * closing_mps / (2.0 * sqrt(accel_mpss * brake_mpss))
    )
    ratio = wanted_m / max(gap_m, _NO_DISTANCE_M)
    return -accel_mpss * ratio * ratio


def stopping_accel(speed_mps: float, distance_m: float, brake_mpss: float) -> float:
    """Return the largest acceleration with which a driver still stops within a distance, comfortably where it can."""
    if distance_m <= _HALT_M and speed_mps <= _HALT_MPS:
        return -1.0  # stands, or comes to stand: no creeping over the last centimetres
    needed_mpss = needed_brake(speed_mps, distance_m)
    if needed_mpss >= brake_mpss:
        return -needed_mpss
    ahead_m = distance_m - speed_mps * _LOOK_AHEAD_S
    wanted_mps = sqrt(2.0 * brake_mpss * ahead_m) if ahead_m > 0.0 else 0.0
    return max(-brake_mpss, (wanted_mps - speed_mps) / _LOOK_AHEAD_S)


def needed_brake(speed_mps: float, distance_m: float) -> float:
    """Return the constant deceleration that stops within a distance, positive, in m/s^2."""
    return speed_mps * speed_mps / (2.0 * max(distance_m, _NO_DISTANCE_M))


def travel_time(distance_m: float, speed_mps: float, accel_mpss: float, top_mps: float) -> float:
    """Return how long a distance takes, accelerating to a top speed first; 0 for what lies behind.

    Examples
    --------
    >>> travel_time(16.0, 0.0, 2.0, 10.0)
    4.0
    >>> travel_time(30.0, 10.0, 2.0, 10.0)
    3.0
    """
    if distance_m <= 0.0:
        return 0.0
    if speed_mps >= top_mps:
        return distance_m / max(speed_mps, 0.1)
    ramp_m = (top_mps * top_mps - speed_mps * speed_mps) / (2.0 * accel_mpss)
    if distance_m <= ramp_m:
        return (sqrt(speed_mps * speed_mps + 2.0 * accel_mpss * distance_m) - speed_mps) / accel_mpss
    return (top_mps - speed_mps) / accel_mpss + (distance_m - ramp_m) / top_mps
