"""Foresees the ego: a part that can be changed, since a trigger is met as well as the ego is foreseen.

What enters: the ego's states up to now. What leaves: a `Profile` from now on. A predictor sees only what happened; it
knows no policy.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise, takewhile
from typing import Protocol

import numpy as np

from scenewright.errors import InputError
from scenewright.motion.limits import Signs
from scenewright.motion.profile import Profile, chain
from scenewright.roads.routes import Route
from scenewright.roads.turns import TurnSpan

# (time_s, s_m, speed_mps, accel_mpss) of one past step.
EgoSample = tuple[float, float, float, float]

# How long an acceleration goes on (s): what is further off is anybody's guess, and an even speed is as good as any.
GOES_ON_S = 1.0
# It is seen over the first (s): where it changes one way all the while it goes on to, ever more slowly, as if for the
# second (s), but for what changes faster than the third (m/s^3): that is a twitch, or another intention. Each measured
# against others (docs/evaluation.md).
_SEEN_S, _CHANGES_FOR_S, _TWITCH_MPSSS = 0.1001, 0.5, 3.0
# Whoever has gained so much a second over the last second (m/s^2) is speeding up on purpose, ever more gently, to what
# people drive there. Measured: without, of 120 first takes 3 fewer are met, and 4 fewer finely.
_ON_PURPOSE_MPSS, _LATELY_S, _HARDEST_PULL_MPSS, _AS_FAST = 0.6, 1.0, 3.0, 0.98
# The steps in which the future is looked into for 20 s, when they begin and how long they last (s): finer ones first.
STEPS_S = (*((round(0.1 * k, 1), 0.1) for k in range(40)), *((round(4.0 + 0.4 * k, 1), 0.4) for k in range(40)))
# A driver stops with the bumper at the line, and takes a turn at this lateral acceleration.
_BUMPER_M, _LATERAL_MPSS = 2.6, 2.5
# A bend is looked at so often, which is less than half a car; what is straighter (1/m) asks nobody to slow down.
_BEND_STEP_M, _STRAIGHT = 2.0, 1e-3
# How people slow down: they begin to where they have to brake like that. One that would have to brake harder than the
# second, and does not brake at all, does not mean to: a speeder is believed late, not never.
_GENTLE_MPSS, _DISREGARD_MPSS, _BRAKES_MPSS, _NO_WAY_M = 1.7, 2.8, 0.5, 1e-6
# One that stands goes on standing for so long, counted anew at every moment. Nobody stands for ever: a hero that
# believed so would give up its place; and one that did not wait would creep past it. Then it sets off to this speed.
_STANDS_S, _SETS_OFF_MPSS, _SETS_OFF_TO_MPS, _STANDS_MPS = 1.5, 1.2, 5.0, 0.05
# A drive is looked at so often (s) for the first seconds, then that often: enough for what is planned again by then.
_FINE_S, _FINE_STEP_S, _COARSE_S = 4.0, 0.1, 0.4
_FINELY_S = np.arange(0.0, _FINE_S, _FINE_STEP_S)
_STANDING_MPS = 0.3  # who is slower stands; chosen
_ALIKE_MPS = 1.0  # who is faster or slower by more than that drives otherwise; chosen
_OTHERWISE_S = 2.0  # after which one that is a little faster or slower than it was there drives as it did; chosen


class Predictor(Protocol):
    """Foresees the ego's motion along its route."""

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the motion from the last sample on; `history` is not empty and in time order."""
        ...


@dataclass(frozen=True, slots=True)
class ConstantSpeed:
    """The ego goes on as fast as it is."""

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return motion at the last speed."""
        time_s, s_m, speed_mps, _ = history[-1]
        return Profile(chain(time_s, s_m, speed_mps, [(1.0, 0.0, 0)]))


@dataclass(frozen=True, slots=True)
class Driver:
    """The ego accelerates for a moment as it does now; it slows down where people do; who stops sets off again.

    One that speeds up on purpose goes on to what `signs` say that people drive there, as the intelligent driver model's
    free road has it. `places` are ``(s_m, speed_mps)`` where it slows down to what; none where nothing is known.
    """

    signs: Signs
    places: tuple[tuple[float, float], ...] = ()

    @classmethod
    def on(cls, route: Route, signs: Signs) -> Driver:
        """Return the predictor for an ego on `route`, which slows for its turn and stops at its stop line."""
        places: list[tuple[float, float]] = []
        if route.origin_kind == "driveway" and "stop_line" in route.landmarks:
            places.append((route.landmarks["stop_line"] - _BUMPER_M, 0.0))
        turn = TurnSpan.of(route)
        if turn is not None:
            steps = int((turn.end_m - turn.start_m) / _BEND_STEP_M)
            along = [turn.start_m + k * _BEND_STEP_M for k in range(steps + 1)]
            bends = [(s_m, abs(route.path.curvature(s_m))) for s_m in along]
            places += [(s_m, math.sqrt(_LATERAL_MPSS / bend)) for s_m, bend in bends if bend > _STRAIGHT]
        return cls(signs, tuple(places))

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the motion step by step, until it comes to a stand and has set off again."""
        time_s, s_m, speed_mps, now_mpss = history[-1]
        start, moves = (time_s, s_m, speed_mps), list[tuple[float, float, int]]()
        ahead = [place for place in self.places if _means_to(place, s_m, speed_mps, now_mpss)]
        (accel_mpss, change_mpsss), pull_mpss = _foot(history), self._pull_mpss(history)
        for elapsed_s, lasts_s in STEPS_S:
            turned = 1.0 - math.exp(-(elapsed_s + 0.5 * lasts_s) / _CHANGES_FOR_S)
            accel = accel_mpss + change_mpsss * _CHANGES_FOR_S * turned
            if elapsed_s >= GOES_ON_S:
                accel = pull_mpss * max(0.0, 1.0 - (speed_mps / self.signs.at_mps(s_m)) ** 4)
            ahead = [place for place in ahead if place[0] > s_m]
            if elapsed_s >= GOES_ON_S and not (ahead or pull_mpss):
                break  # it holds its speed
            accel = _slowing(ahead, (s_m, speed_mps), accel, lasts_s) if ahead else accel
            if speed_mps + accel * lasts_s <= _STANDS_MPS:
                moves += [(speed_mps / -accel, accel, 0)] if accel < 0.0 else []
                moves += [(_STANDS_S, 0.0, 0), (_SETS_OFF_TO_MPS / _SETS_OFF_MPSS, _SETS_OFF_MPSS, 0)]
                break
            moves.append((lasts_s, accel, 0))
            s_m, speed_mps = s_m + (speed_mps + 0.5 * accel * lasts_s) * lasts_s, speed_mps + accel * lasts_s
        return Profile(chain(*start, moves))

    def _pull_mpss(self, history: Sequence[EgoSample]) -> float:
        """Return the acceleration from standstill of one that speeds up on purpose, fitted to what is seen; else 0."""
        time_s, s_m, speed_mps, now_mpss = history[-1]
        cruise_mps = self.signs.at_mps(s_m)
        before = next((sample for sample in reversed(history) if sample[0] <= time_s - _LATELY_S), history[0])
        gained = (speed_mps - before[2]) / (time_s - before[0]) if time_s > before[0] else now_mpss
        if min(gained, now_mpss) < _ON_PURPOSE_MPSS or speed_mps >= _AS_FAST * cruise_mps:
            return 0.0
        return min(_HARDEST_PULL_MPSS, gained / (1.0 - (speed_mps / cruise_mps) ** 4))


def _foot(history: Sequence[EgoSample]) -> tuple[float, float]:
    """Return how the ego accelerates (m/s^2), and how that changes (m/s^3) where it changes one way and slowly."""
    now_s, _, _, now_mpss = history[-1]
    lately = list(takewhile(lambda sample: sample[0] >= now_s - _SEEN_S, reversed(history)))
    steps = [after[3] - before[3] for after, before in pairwise(lately)]
    if steps and (min(steps) > 0.0 or max(steps) < 0.0):
        change = (now_mpss - lately[-1][3]) / (now_s - lately[-1][0])
        if abs(change) <= _TWITCH_MPSSS:
            return now_mpss, change
    return sum(sample[3] for sample in lately) / len(lately), 0.0


def _means_to(place: tuple[float, float], s_m: float, speed_mps: float, accel: float) -> bool:
    """Whether it is going to slow down for a place."""
    if place[0] <= s_m or speed_mps <= place[1]:
        return False
    return accel < -_BRAKES_MPSS or _needed_mpss([place], s_m, speed_mps) < _DISREGARD_MPSS


def _slowing(places: Sequence[tuple[float, float]], state: tuple[float, float], accel: float, lasts_s: float) -> float:
    """Return the mean acceleration in a step in which it may begin to brake for a place; `accel` is that before."""
    needed = _needed_mpss(places, *state)
    if needed > _GENTLE_MPSS:
        return min(accel, -needed)
    s_m, speed_mps = state
    then = _needed_mpss(places, s_m + (speed_mps + 0.5 * accel * lasts_s) * lasts_s, speed_mps + accel * lasts_s)
    late = (then - _GENTLE_MPSS) / (then - needed) if then > _GENTLE_MPSS else 0.0
    return accel + late * (min(accel, -_GENTLE_MPSS) - accel)


def _needed_mpss(places: Sequence[tuple[float, float]], s_m: float, speed_mps: float) -> float:
    """Return the deceleration that leads to the speed of every place ahead."""
    needed = 0.0
    for place_m, most_mps in places:
        if speed_mps > most_mps and place_m > s_m + _NO_WAY_M:
            needed = max(needed, (speed_mps**2 - most_mps**2) / (2.0 * (place_m - s_m)))
    return needed


@dataclass(frozen=True, slots=True)
class Rehearsed:
    """The ego soon goes on as it did when it was last where it is now.

    How it drove is `drive`. Where it is elsewhere, or faster or slower by too much, `base` is believed.
    """

    drive: Profile
    base: Predictor

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the rest of the drive from where the ego is, beginning with the speed that it has."""
        time_s, s_m, speed_mps, _ = history[-1]
        then_s = self._when(history)
        if then_s is None or abs(self.drive.state(then_s)[1] - speed_mps) > _ALIKE_MPS:
            return self.base.predict(history)
        at_s = np.concatenate([_FINELY_S, np.arange(_FINE_S, self.drive.end_s - then_s, _COARSE_S)])
        then = np.array([self.drive.state(then_s + soon_s)[1] for soon_s in at_s])
        speeds = np.maximum(0.0, then + (speed_mps - then[0]) * np.maximum(0.0, 1.0 - at_s / _OTHERWISE_S))
        accels = np.diff(speeds) / np.diff(at_s)
        moves = [(lasts_s, accel, 0) for lasts_s, accel in zip(np.diff(at_s).tolist(), accels.tolist(), strict=True)]
        return Profile(chain(time_s, s_m, speed_mps, moves))

    def repeats(self, again: Profile) -> bool:
        """Whether another drive is alike all along: how one that decides anew each time drove tells nothing."""
        times_s = np.arange(0.0, self.drive.end_s, _COARSE_S).tolist()
        return all(abs(self.drive.state(t)[1] - again.state(t)[1]) <= _ALIKE_MPS for t in times_s)

    def _when(self, history: Sequence[EgoSample]) -> float | None:
        """Return the moment of the drive that is like now: as long at this place as the ego has been by now."""
        time_s, s_m, speed_mps, _ = history[-1]
        if speed_mps >= _STANDING_MPS:
            when_s = self.drive.time_at(s_m)
            return when_s if when_s is not None and when_s <= self.drive.end_s else None
        place_m = s_m - 0.05
        came_s = next((sample[0] for sample in history if sample[1] >= place_m), time_s)
        arrived_s = self.drive.time_at(place_m)
        if arrived_s is None or arrived_s + time_s - came_s > self.drive.end_s:
            return None
        return arrived_s + time_s - came_s


def predictor_called(name: str, route: Route, signs: Signs) -> Predictor:
    """Return a predictor by its name, for an ego on `route`, where people drive as `signs` say.

    Raises
    ------
    InputError
        Where there is none of that name.
    """
    makers: dict[str, Callable[[], Predictor]] = {
        "road": lambda: Driver.on(route, signs),
        "acceleration": lambda: Driver(signs),
        "speed": ConstantSpeed,
    }
    if name not in makers:
        raise InputError("there is no such predictor", found=name, expected=", ".join(makers))
    return makers[name]()
