"""Predicts the ego: a part that can be changed, since a trigger is met as well as the ego is foreseen.

What enters: the ego's states up to now. What leaves: a `Profile` from now on. A predictor sees only what happened; it
knows no policy.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

from scenewright.errors import InputError
from scenewright.motion.profile import Profile, chain
from scenewright.roads.routes import Route
from scenewright.solve.turns import TurnSpan, tightest_curvature

# (time_s, s_m, speed_mps, accel_mpss) of one past step.
EgoSample = tuple[float, float, float, float]

# A driver stops with the bumper at the line, and takes a turn at this lateral acceleration.
_BUMPER_M = 2.6
_LATERAL_MPSS = 2.5
# An acceleration that changes by more than this from one step to the next is another intention, not a twitch.
_JUMP_MPSS = 1.0
# Who has gained this much a second over the last second is speeding up on purpose.
_LATELY_S, _SPEEDS_UP_MPSS = 1.0, 0.6
_STEP_S, _MOST_STEPS = 0.5, 20
# An acceleration that changes by this much (m/s^2) at every step is no sign of what comes; how it is forgotten (s).
_UNSTEADY_MPSS, _UNSTEADY_FOR_S, _FORGETS_S, _FORGOTTEN_S = 0.03, 0.5, 1.0, 3.0
_FEWEST_CHANGES, _FORGET_STEP_S = 10, 0.25
# Below this share of what people drive there it crawls.
_CRAWLS = 0.25


def since_jump(accels_mpss: Sequence[float]) -> int:
    """Return how many of the last accelerations (m/s^2), the newest first, came after a jump; all where there is none.

    The ego has changed its mind where it was even before and is even since; one that jitters has not.
    """
    return next((k for k in range(1, len(accels_mpss)) if jumped(accels_mpss, k)), len(accels_mpss))


def jumped(accels_mpss: Sequence[float], count: int = 1) -> bool:
    """Whether the last `count` of some accelerations (m/s^2), the newest first, came after a jump."""
    after, before = accels_mpss[:count], accels_mpss[count:]
    if not before or max(max(after) - min(after), max(before) - min(before)) > _JUMP_MPSS:
        return False
    return min(abs(min(after) - max(before)), abs(max(after) - min(before))) > _JUMP_MPSS


def lately(history: Sequence[EgoSample], for_s: float, most: int = 12) -> list[float]:
    """Return the accelerations (m/s^2) of the last moments, the newest first."""
    last_s = history[-1][0]
    return [sample[3] for sample in reversed(history[-most:]) if sample[0] >= last_s - for_s]


def is_unsteady(history: Sequence[EgoSample]) -> bool:
    """Whether the ego's acceleration changes at every step: its foot trembles, or is on its way to something else."""
    values = lately(history, _UNSTEADY_FOR_S, 60)
    changes = sorted(abs(after - before) for after, before in pairwise(values))
    return len(changes) >= _FEWEST_CHANGES and changes[len(changes) // 2] > _UNSTEADY_MPSS


def fading(after_s: float, for_s: float) -> float:
    """Return the share of an unsteady acceleration that is left, on average, in a while that begins later."""
    return math.exp(-(after_s + 0.5 * for_s) / _FORGETS_S)


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
class ConstantAcceleration:
    """The ego keeps its acceleration for a while, then its speed; one that stops sets off again.

    Attributes
    ----------
    hold_s
        How long the acceleration lasts.
    average_s
        Over how long a past the acceleration is averaged: policies jitter.
    standstill_s
        How long one that stands goes on standing, counted anew at every moment. Nobody stands for ever: a hero that
        believed so would give up its place; and one that did not wait would creep past it.
    restart_mpss, restart_speed_mps
        How it sets off.
    cruise_mps
        Whoever has been speeding up for a second is on the way to this speed, ever more gently.
    """

    hold_s: float = 1.0
    average_s: float = 0.1
    standstill_s: float = 1.5
    restart_mpss: float = 1.2
    restart_speed_mps: float = 5.0
    cruise_mps: float | None = None

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return motion with the recent acceleration for `hold_s`, then at constant speed."""
        time_s, s_m, speed_mps, _ = history[-1]
        accel = self.recent_acceleration(history)
        moves: list[tuple[float, float, int]] = []
        held = self.held(history, accel)
        end_speed = max(0.0, speed_mps + sum(duration_s * held_mpss for duration_s, held_mpss, _ in held))
        if end_speed > 0.3:
            moves += held
            moves += self.speeding_up(history, end_speed)
        else:
            if speed_mps > 0.05 and accel < -0.05:
                moves.append((speed_mps / -accel, accel, 0))
            moves.append((self.standstill_s, 0.0, 0))
            moves.append((self.restart_speed_mps / self.restart_mpss, self.restart_mpss, 0))
        return Profile(chain(time_s, s_m, speed_mps if speed_mps > 0.05 else 0.0, moves))

    def held(self, history: Sequence[EgoSample], accel_mpss: float) -> list[tuple[float, float, int]]:
        """Return for how long an acceleration is kept: for a while, or ever less of it where the foot is unsteady."""
        if not is_unsteady(history) or self.pull(history):
            return [(self.hold_s, accel_mpss, 0)]
        steps = round(_FORGOTTEN_S / _FORGET_STEP_S)
        return [(_FORGET_STEP_S, accel_mpss * fading(k * _FORGET_STEP_S, _FORGET_STEP_S), 0) for k in range(steps)]

    def speeding_up(self, history: Sequence[EgoSample], speed_mps: float) -> list[tuple[float, float, int]]:
        """Return how one that has been speeding up for a while goes on to `cruise_mps` from a speed below it."""
        pull = self.pull(history) or self._from_a_crawl(history)
        moves: list[tuple[float, float, int]] = []
        while pull and speed_mps < 0.98 * (self.cruise_mps or 0.0) and len(moves) < _MOST_STEPS:
            moves.append((_STEP_S, self.pulled(pull, speed_mps), 0))
            speed_mps += _STEP_S * moves[-1][1]
        return moves

    def pull(self, history: Sequence[EgoSample]) -> float:
        """Return the acceleration from standstill (m/s^2) of one on its way to `cruise_mps`; 0 where none is seen.

        The intelligent driver model's free road, without knowing its parameters: fitted to what is seen now.
        """
        time_s, _, speed_mps, accel = history[-1]
        lately = [sample for sample in history[-60:] if sample[0] >= time_s - _LATELY_S]
        if len(lately) > 1:
            accel = (speed_mps - lately[0][2]) / (time_s - lately[0][0])
        if self.cruise_mps is None or accel < _SPEEDS_UP_MPSS or speed_mps >= 0.98 * self.cruise_mps:
            return 0.0
        return min(3.0, accel / (1.0 - (speed_mps / self.cruise_mps) ** 4))

    def _from_a_crawl(self, history: Sequence[EgoSample]) -> float:
        """Return how one that crawls will pull: nobody crawls for ever, and a hero that believed so would stay away."""
        slow = self.cruise_mps is not None and history[-1][2] < _CRAWLS * self.cruise_mps
        return self.restart_mpss if slow and self.recent_acceleration(history) > -_SPEEDS_UP_MPSS else 0.0

    def pulled(self, pull_mpss: float, speed_mps: float) -> float:
        """Return the acceleration (m/s^2) at a speed, of one that pulls like that from standstill."""
        return max(0.0, pull_mpss * (1.0 - (speed_mps / (self.cruise_mps or 1.0)) ** 4))

    def recent_acceleration(self, history: Sequence[EgoSample]) -> float:
        """Return the mean acceleration (m/s^2) of the last moments, since it last jumped."""
        values = lately(history, self.average_s)
        values = values[: since_jump(values)]
        mean = sum(values) / len(values)
        return 0.0 if abs(mean) < 0.02 else max(-9.0, min(5.0, mean))


@dataclass(frozen=True, slots=True)
class RoadAware:
    """The ego drives as `ConstantAcceleration` says, and slows for its turn and stops at its stop line as people do.

    Whoever is too near and too fast to do so gently, and does not brake, is taken not to: a speeder is believed late,
    not never.

    Attributes
    ----------
    places
        ``(s_m, speed_mps)``: where it slows down to what.
    base
        What it does otherwise.
    gentle_mpss
        How it slows down.
    disregard_mpss
        One that would have to brake harder than this, and does not brake at all, does not mean to.
    """

    places: tuple[tuple[float, float], ...]
    base: ConstantAcceleration = ConstantAcceleration()
    gentle_mpss: float = 1.8
    disregard_mpss: float = 2.8
    step_s: float = 0.2
    horizon_s: float = 20.0

    @classmethod
    def on(cls, route: Route, cruise_mps: float | None = None) -> RoadAware:
        """Return the predictor for an ego on `route`, where people drive at `cruise_mps`."""
        places: list[tuple[float, float]] = []
        if route.origin_kind == "driveway" and "stop_line" in route.landmarks:
            places.append((route.landmarks["stop_line"] - _BUMPER_M, 0.0))
        turn, curvature = TurnSpan.of(route), tightest_curvature(route)
        if turn is not None and curvature > 1e-3:
            places.append((turn.start_m + 0.25 * (turn.end_m - turn.start_m), math.sqrt(_LATERAL_MPSS / curvature)))
        return cls(tuple(places), ConstantAcceleration(cruise_mps=cruise_mps))

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the motion step by step; without a place ahead that matters, that of `base`."""
        time_s, s_m, speed, accel = history[-1]
        if speed < 0.3:
            return self.base.predict(history)
        ahead = [place for place in self.places if self._means_to(place, s_m, speed, accel)]
        if not ahead:
            return self.base.predict(history)
        first, pull = self.base.recent_acceleration(history), self.base.pull(history)
        unsteady = is_unsteady(history)
        moves: list[tuple[float, float, int]] = []
        elapsed = 0.0
        while elapsed < self.horizon_s:
            wanted = self.base.pulled(pull, speed)
            if unsteady:
                wanted += (first - wanted) * fading(elapsed, self.step_s)
            elif elapsed < self.base.hold_s:
                wanted = first
            needed = max((self._needed(place, s_m, speed) for place in ahead), default=0.0)
            if needed > 0.85 * self.gentle_mpss:
                wanted = min(wanted, -needed) if elapsed < self.base.hold_s and first < 0 else -needed
            if speed + wanted * self.step_s <= 0.05 or self._comes_to_stop(ahead, s_m, speed):
                return self._stopping(time_s, history[-1], moves, speed, min(wanted, -self.gentle_mpss))
            moves.append((self.step_s, wanted, 0))
            s_m += (speed + 0.5 * wanted * self.step_s) * self.step_s
            speed += wanted * self.step_s
            elapsed += self.step_s
            ahead = [place for place in ahead if place[0] > s_m]
        return Profile(chain(time_s, history[-1][1], history[-1][2], moves))

    def _comes_to_stop(self, ahead: list[tuple[float, float]], s_m: float, speed: float) -> bool:
        """Whether the next step leads to a place where it stops; steps of finite length would carry it past that."""
        return any(place[1] == 0.0 and place[0] - s_m <= speed * self.step_s for place in ahead)

    def _stopping(
        self,
        time_s: float,
        start: EgoSample,
        moves: list[tuple[float, float, int]],
        speed: float,
        accel: float,
    ) -> Profile:
        """Return a motion that comes to a stand, waits, and sets off again."""
        moves.append((speed / -accel, accel, 0))
        base = self.base
        moves += [
            (base.standstill_s, 0.0, 0),
            (base.restart_speed_mps / base.restart_mpss, base.restart_mpss, 0),
        ]
        return Profile(chain(time_s, start[1], start[2], moves))

    def _means_to(self, place: tuple[float, float], s_m: float, speed: float, accel: float) -> bool:
        if place[0] <= s_m or speed <= place[1]:
            return False
        return accel < -0.5 or self._needed(place, s_m, speed) < self.disregard_mpss

    @staticmethod
    def _needed(place: tuple[float, float], s_m: float, speed: float) -> float:
        """Return the deceleration (m/s^2) that leads to the place's speed at the place."""
        distance = place[0] - s_m
        rise = speed * speed - place[1] * place[1]
        return rise / (2.0 * distance) if distance > 0.05 and rise > 0 else 0.0


def predictor_called(name: str, route: Route, cruise_mps: float | None = None) -> Predictor:
    """Return a predictor by its name, for an ego on `route`, where people drive at `cruise_mps`.

    Raises
    ------
    InputError
        Where there is none of that name.
    """
    makers: dict[str, Callable[[], Predictor]] = {
        "road": lambda: RoadAware.on(route, cruise_mps),
        "acceleration": ConstantAcceleration,
        "speed": ConstantSpeed,
    }
    if name not in makers:
        raise InputError("there is no such predictor", found=name, expected=", ".join(makers))
    return makers[name]()
