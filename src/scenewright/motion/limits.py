"""What a vehicle can do, and what it would do of itself.

What enters: a route and its speed limits. What leaves: `Limits`, which no plan exceeds, and the room that a plan keeps
of the program's manner.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, fields, replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.laws import Law
from scenewright.motion.profile import Profile
from scenewright.program.manner import Manner
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route
from scenewright.roads.turns import tightest_curvature
from scenewright.units import pin

FloatArray = NDArray[np.float64]

ACCEL_MAX_MPSS = 4.0
BRAKE_MAX_MPSS = 8.0
LATERAL_MAX_MPSS = 6.0
SPEED_OVER_LIMIT = 1.3
DEFAULT_SPEED_LIMIT_MPS = 50 / 3.6
_SLOWEST_TOP_MPS = 8.0
_SLOWEST_PACE_MPS = 4.0
_EVENLY_MPSS = 2.0  # from one limit to the next; between the usual braking and speeding up
# Slower than this, "begins to brake" cannot be seen and "drives" is not driving.
MOVING_MPS = 1.0
# What a motion that is planned keeps of each number of the program's manner on the safe side: the judge sees samples.
ROOM = Fraction(1, 10)


def calm_mpss(manner: Manner) -> Fraction:
    """Return how hard (m/s^2) one who is settled may do what is about to begin, so that it is seen to begin only then.

    What begins is seen from half of what it comes to, where that is little.
    """
    return min(manner.stricter(ROOM).settled_mpss, manner.begins_mpss / 2)


@dataclass(frozen=True, slots=True)
class Limits:
    """Bounds on an actor's motion that no plan exceeds.

    Attributes
    ----------
    speed_max_mps, approach_speed_max_mps, turn_speed_max_mps
        Anywhere, on the first lane, and in a turn (lateral acceleration at the tightest curve).
    natural_speed_mps, natural_approach_speed_mps, natural_turn_speed_mps
        What a driver would choose in the same places.
    pace
        The share of what is natural at which it comes to its trigger.
    """

    speed_max_mps: float
    approach_speed_max_mps: float
    turn_speed_max_mps: float
    natural_speed_mps: float
    natural_approach_speed_mps: float
    natural_turn_speed_mps: float
    accel_max_mpss: float = ACCEL_MAX_MPSS
    brake_max_mpss: float = BRAKE_MAX_MPSS
    lateral_max_mpss: float = LATERAL_MAX_MPSS
    pace: float = 1.0

    def law(self) -> Law:
        """Return the law of motion that these bounds are, in numbers for a solver."""
        return Law(-pin(self.brake_max_mpss), pin(self.accel_max_mpss), Fraction(0), pin(self.speed_max_mps))

    def no_faster(self, most_mps: float) -> Limits:
        """Return the same limits for one that never drives faster than so."""
        speeds = (each.name for each in fields(self) if each.name.endswith("_mps"))
        return replace(self, **{name: min(getattr(self, name), most_mps) for name in speeds})

    def at_pace(self, share: float) -> Limits:
        """Return the same limits for one that comes to its trigger no faster than a share of what it may."""
        natural_mps = max(_SLOWEST_PACE_MPS, share * self.natural_approach_speed_mps)
        return replace(self, natural_approach_speed_mps=natural_mps, pace=share)

    def before_trigger_mps(self, posted_mps: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return how fast (m/s) it comes to its trigger at most, and as is natural, where so much is posted."""
        most = np.maximum(SPEED_OVER_LIMIT * posted_mps, _SLOWEST_TOP_MPS)
        return np.maximum(_SLOWEST_PACE_MPS, self.pace * most), np.maximum(_SLOWEST_PACE_MPS, self.pace * posted_mps)


@dataclass(frozen=True, slots=True)
class Signs:
    """Speed limits (m/s) along a route, each from a place (m) on."""

    starts_m: tuple[float, ...]
    limits_mps: tuple[float, ...]

    @classmethod
    def of(cls, route: Route, road_map: RoadMap) -> Signs:
        """Return those of the lanes of a route."""
        lanes = (road_map.lanes[lane] for lane in route.lanes)
        return cls(route.lane_starts_m, tuple(lane.speed_limit_mps or DEFAULT_SPEED_LIMIT_MPS for lane in lanes))

    def at_mps(self, s_m: float) -> float:
        """Return the limit at a place."""
        return self.limits_mps[max(bisect_right(self.starts_m, s_m) - 1, 0)]

    def up_to(self, count: int) -> Signs:
        """Return the first ones only: whoever does something else before it comes to the next has not heeded it yet."""
        return Signs(self.starts_m[:count], self.limits_mps[:count])

    def as_driven(self, motion: Profile) -> Signs:
        """Return the speeds that a driver with such a motion aims at: limits times the largest share it comes to."""
        share = max(segment.end_speed_mps / self.at_mps(segment.end_s_m) for segment in motion.segments)
        return Signs(self.starts_m, tuple(max(MOVING_MPS, share * limit_mps) for limit_mps in self.limits_mps))

    def evenly_mps(self, s_m: FloatArray) -> FloatArray:
        """Return how fast one who heeds them drives at places, who gets slower and faster evenly."""
        starts_m, limits_mps = np.array(self.starts_m), np.array(self.limits_mps)
        away_m = np.maximum(np.maximum(starts_m - s_m[:, None], s_m[:, None] - np.append(starts_m[1:], np.inf)), 0.0)
        return np.asarray(np.sqrt(np.min(limits_mps**2 + 2.0 * _EVENLY_MPSS * away_m, axis=1)))


def limits_on(route: Route, road_map: RoadMap) -> Limits:
    """Return the limits of a vehicle on `route`: from the speed limits along it and the tightest curve of its turn."""
    signs = Signs.of(route, road_map).limits_mps
    approach, fastest = signs[0], max(signs)
    tightest = tightest_curvature(route)
    turn = (LATERAL_MAX_MPSS / tightest) ** 0.5 if tightest > 1e-3 else float("inf")
    comfortable = (2.5 / tightest) ** 0.5 if tightest > 1e-3 else float("inf")
    approach_max = max(SPEED_OVER_LIMIT * approach, _SLOWEST_TOP_MPS)
    return Limits(
        speed_max_mps=max(SPEED_OVER_LIMIT * fastest, _SLOWEST_TOP_MPS),
        approach_speed_max_mps=approach_max,
        turn_speed_max_mps=min(turn, approach_max),
        natural_speed_mps=fastest,
        natural_approach_speed_mps=approach,
        natural_turn_speed_mps=min(comfortable, approach),
    )
