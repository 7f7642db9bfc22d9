"""What a vehicle can do, and what it would do of itself: bounds in steps from natural to its whole authority.

What enters: a route and its speed limits. What leaves: `Limits` (never exceeded) and `Style`s (how gently to try
first).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.motion.algebra import pin
from scenewright.motion.laws import Law
from scenewright.program.manner import USUAL, Manner
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route
from scenewright.solve.turns import tightest_curvature

ACCEL_MAX_MPSS = 4.0
BRAKE_MAX_MPSS = 8.0
LATERAL_MAX_MPSS = 6.0
SPEED_OVER_LIMIT = 1.3
DEFAULT_SPEED_LIMIT_MPS = 50 / 3.6
_SLOWEST_TOP_MPS = 8.0
_SLOWEST_PACE_MPS = 4.0
# Slower than this, "begins to brake" cannot be seen and "drives" is not driving.
MOVING_MPS = 1.0
_ROUNDING_S = 1e-3
# What a motion that is planned keeps of each number of the program's manner on the safe side: the judge sees samples.
ROOM = Fraction(1, 10)
# How one brakes that is to wait on its way.
WAIT_BRAKE_MPSS = 3.0


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
        Anywhere, on the way to the trigger, and in a turn (lateral acceleration at the tightest curve).
    natural_speed_mps, natural_approach_speed_mps, natural_turn_speed_mps
        What a driver would choose in the same places.
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

    def law(self) -> Law:
        """Return the law of motion that these bounds are, in numbers for a solver."""
        return Law(-pin(self.brake_max_mpss), pin(self.accel_max_mpss), Fraction(0), pin(self.speed_max_mps))

    def at_pace(self, share: float) -> Limits:
        """Return the same limits for one that comes to its trigger no faster than a share of what it may."""
        return replace(
            self,
            approach_speed_max_mps=max(_SLOWEST_PACE_MPS, share * self.approach_speed_max_mps),
            natural_approach_speed_mps=max(_SLOWEST_PACE_MPS, share * self.natural_approach_speed_mps),
        )


@dataclass(frozen=True, slots=True)
class Wait:
    """How one drives up to a place, stands there, and sets off in time for its trigger.

    Attributes
    ----------
    speed_up_s, hold_s, brake_s
        What it does on the way to that place, at most.
    place_m, room_m
        Where it stands: as near as it can and still be fast enough at its trigger; how far beside that it may be.
    go_s
        How long before its trigger it sets off.
    """

    speed_up_s: float
    hold_s: float
    brake_s: float
    place_m: float
    room_m: float
    go_s: float

    @property
    def shortest_s(self) -> float:
        """How long all of it takes without any time to stand, and a little for rounding (s)."""
        return self.speed_up_s + self.hold_s + self.brake_s + self.go_s + _ROUNDING_S


@dataclass(frozen=True, slots=True)
class Style:
    """How an actor may move in one attempt at a plan; each list of attempts goes from natural to whole authority.

    Attributes
    ----------
    approach_accel_mpss, approach_brake_mpss
        While it works its way to the trigger.
    steps
        Stretches of constant acceleration before the trigger; the last is a settled one where `settle` is set.
    counter_mpss, early_mpss, settle_s
        In a settled stretch: how hard it may do the opposite of what begins at the trigger, and the same; how long it
        is. Longer than what is asked for, where there is time: the trigger may come a little sooner than planned.
    wait
        How one waits on its way that would otherwise only creep; None for one that does not.
    dec_mpss, acc_mpss, stop_s
        Ranges of braking, accelerating and standing pieces; one that speeds up and then drives on takes the upper rate.
    trigger_speed_mps
        Smallest speed at the trigger.
    natural_speed
        Whether speeds stay at what a driver would choose.
    outcome
        Whether the prediction of the ego must already promise the outcome (who goes first); without it the actor does
        what it can and the ego decides.
    outcome_margin_s
        By how much the prediction must promise it; less than nothing asks for the best that can be done.
    clear
        Whether the first to pass must also be out of the way of the second.
    ready, waiting_place_m, sets_off_s
        Whether it stays near enough for an ego that makes haste all of a sudden, and far enough for one that stops; the
        place that it does not go beyond then, until it has to: so long before its trigger.
    out_of_way
        Whether one that is timed at its trigger is not in the ego's way there yet.
    seen_s
        How long it brakes or speeds up at least, once that is what was asked for: less is hardly seen to have begun.
    opening_mps
        For one that the ego follows: by how much it is faster at its trigger than the ego; None for no matter. Where
        the distance hardly changes, nobody can tell when it is the one that was asked for; and a distance that shrinks
        makes the ego brake, so that it may never come.
    """

    name: str
    approach_accel_mpss: float
    approach_brake_mpss: float
    steps: int
    settle: bool
    dec_mpss: tuple[float, float]
    acc_mpss: tuple[float, float]
    stop_s: tuple[float, float]
    trigger_speed_mps: float
    natural_speed: bool
    outcome: bool = True
    outcome_margin_s: float = 0.3
    clear: bool = True
    counter_mpss: float = float(USUAL.stricter(ROOM).settled_mpss)
    early_mpss: float = float(calm_mpss(USUAL))
    settle_s: float = 0.75
    wait: Wait | None = None
    seen_s: float = 0.6
    opening_mps: float | None = None
    out_of_way: bool = True
    ready: bool = False
    waiting_place_m: float | None = None
    sets_off_s: float = 0.0

    def kept_to(self, manner: Manner) -> Style:
        """Return the style for a program of that manner: what is asked for comes before what is preferred."""
        kept = manner.stricter(ROOM)
        begins_mpss, longer_s = float(kept.begins_mpss), max(0.0, float(kept.stands_s) - self.stop_s[0])
        return replace(
            self,
            counter_mpss=max(self.counter_mpss, float(kept.settled_mpss)),
            early_mpss=float(calm_mpss(manner)),
            settle_s=max(self.settle_s, float(kept.settled_s)),
            seen_s=max(self.seen_s, float(kept.begins_s)),
            dec_mpss=(max(self.dec_mpss[0], begins_mpss), max(self.dec_mpss[1], begins_mpss)),
            acc_mpss=(max(self.acc_mpss[0], begins_mpss), max(self.acc_mpss[1], begins_mpss)),
            stop_s=(self.stop_s[0] + longer_s, self.stop_s[1] + longer_s),
        )

    def top_speeds_mps(self, limits: Limits) -> tuple[float, float]:
        """Return the top speed on the way to the trigger and in a turn, for an actor within `limits`."""
        if self.natural_speed:
            return limits.natural_approach_speed_mps, limits.natural_turn_speed_mps
        return limits.approach_speed_max_mps, limits.turn_speed_max_mps

    def top_speed_after_mps(self, limits: Limits) -> float:
        """Return the top speed once the trigger has come: the road that is turned into may be the faster one."""
        return limits.natural_speed_mps if self.natural_speed else limits.speed_max_mps


STEADY = Style("steady", 0.0, 0.0, 1, True, (1.2, 2.4), (1.2, 2.5), (0.6, 1.2), 2.0, True)
# Where the moment is free and holding the speed leads to one: only rounding is made up for.
COASTING = Style("steady", 0.02, 0.02, 1, True, (0.6, 8.0), (0.8, 4.0), (0.5, 3.0), MOVING_MPS, False)
GENTLE = Style("gentle", 1.0, 1.2, 2, True, (0.9, 4.0), (1.0, 2.5), (0.6, 1.5), 1.5, True)
FIRM = Style("firm", 2.5, 3.0, 3, True, (0.7, 6.0), (0.8, 3.5), (0.5, 3.0), MOVING_MPS, False)
WHOLE = Style("whole", ACCEL_MAX_MPSS, BRAKE_MAX_MPSS, 5, True, (0.6, 8.0), (0.6, 4.0), (0.5, 90.0), MOVING_MPS, False)
URGENT = Style(
    "urgent", ACCEL_MAX_MPSS, 8.0, 4, False, (0.6, 8.0), (0.6, 4.0), (0.5, 90.0), MOVING_MPS, False, seen_s=0.0,
    out_of_way=False,
)  # fmt: skip
# Who is about to brake may still speed up, and the other way round: nothing that was asked for has begun by that.
COUNTER = replace(WHOLE, counter_mpss=6.0, trigger_speed_mps=0.5)
# As little as can just be seen, before the trigger and after it: the manner says how little that is.
CLOSE = replace(COUNTER, settle_s=0.0, seen_s=0.0, dec_mpss=(0.0, 8.0), out_of_way=False)

# Where the hero is to be first, whatever the ego does: it loses no time after its trigger.
GENTLE_QUICK = replace(GENTLE, dec_mpss=(1.8, 4.0), acc_mpss=(1.0, 3.5), stop_s=(0.5, 0.6), outcome_margin_s=1.5)
FIRM_QUICK = replace(FIRM, dec_mpss=(2.0, 6.0), acc_mpss=(0.8, 4.0), stop_s=(0.5, 0.6), outcome_margin_s=1.0)
HASTE = replace(FIRM, dec_mpss=(2.0, 8.0), acc_mpss=(0.8, 4.0), stop_s=(0.0, 0.17), seen_s=0.0)
WHOLE_QUICK = replace(WHOLE, dec_mpss=(2.0, 8.0), stop_s=(0.5, 0.6), outcome_margin_s=0.7)
COUNTER_QUICK = replace(WHOLE_QUICK, counter_mpss=COUNTER.counter_mpss, trigger_speed_mps=COUNTER.trigger_speed_mps)
CLOSE_QUICK = replace(COUNTER_QUICK, settle_s=CLOSE.settle_s, seen_s=CLOSE.seen_s, out_of_way=False)


def limits_on(route: Route, road_map: RoadMap) -> Limits:
    """Return the limits of a vehicle on `route`: from the speed limits along it and the tightest curve of its turn."""
    signs = [road_map.lanes[lane].speed_limit_mps or DEFAULT_SPEED_LIMIT_MPS for lane in route.lanes]
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
