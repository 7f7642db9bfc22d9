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
from scenewright.roads.turns import TurnSpan

# (time_s, s_m, speed_mps, accel_mpss) of one past step.
EgoSample = tuple[float, float, float, float]

# A driver stops with the bumper at the line, and takes a turn at this lateral acceleration.
_BUMPER_M = 2.6
_LATERAL_MPSS = 2.5
# A bend is looked at so often, which is less than half a car; what is straighter (1/m) asks nobody to slow down.
_BEND_STEP_M, _STRAIGHT = 2.0, 1e-3
# An acceleration that changes by more than this from one step to the next is another intention, not a twitch.
_JUMP_MPSS = 1.0
# For how many steps a jump has to last: of 58 first takes that missed 2 more are met with two of them than with one.
JUMP_STEPS = 2
# Who has gained this much a second over the last second is speeding up on purpose.
_LATELY_S, _SPEEDS_UP_MPSS = 1.0, 0.6
_STEP_S, _MOST_STEPS = 0.5, 20
_SHORTEST_S = 1e-3  # a stretch that lasts less is none
# An acceleration that changes by this much (m/s^2) at every step is no sign of what comes; how it is forgotten (s).
_UNSTEADY_MPSS, _UNSTEADY_FOR_S, _FORGETS_S, _FORGOTTEN_S = 0.03, 0.5, 1.0, 3.0
_FEWEST_CHANGES, _FORGET_STEP_S = 10, 0.25
# A foot that has hardly turned, and made so many steps to one side, is on its way; how many of them tell how fast, and
# for how long that counts (s); chosen, and what it gains is told in docs/evaluation.md.
_FEW_TURNS, _FEWEST_ONE_WAY, _RECENT, _MOVES_S = 2, 3, 5, 0.5
# Below this share of what people drive there it crawls.
_CRAWLS = 0.25


def since_jump(accels_mpss: Sequence[float]) -> Sequence[float]:
    """Return those of the last accelerations (m/s^2), the newest first, that tell how the ego drives now.

    It has changed its mind where it was even before and is even since, for `JUMP_STEPS` at least; one that jitters has
    not, and what lasts for a step only may be a twitch.
    """
    if jumped(accels_mpss, 1):
        return accels_mpss[1:]
    count = next((k for k in range(JUMP_STEPS, len(accels_mpss)) if jumped(accels_mpss, k)), len(accels_mpss))
    return accels_mpss[:count]


def jumped(accels_mpss: Sequence[float], count: int) -> bool:
    """Whether the last `count` of some accelerations (m/s^2), the newest first, came after a jump."""
    after, before = accels_mpss[:count], accels_mpss[count:]
    if not before or max(max(after) - min(after), max(before) - min(before)) > _JUMP_MPSS:
        return False
    return min(abs(min(after) - max(before)), abs(max(after) - min(before))) > _JUMP_MPSS


def lately(history: Sequence[EgoSample], for_s: float, most: int = 12) -> list[float]:
    """Return the accelerations (m/s^2) of the last moments, the newest first."""
    last_s = history[-1][0]
    return [sample[3] for sample in reversed(history[-most:]) if sample[0] >= last_s - for_s]


@dataclass(frozen=True, slots=True)
class Foot:
    """What the ego's foot does: it holds, is on its way, or trembles.

    Attributes
    ----------
    accel_mpss
        Its mean acceleration of the last moments, since that last jumped.
    change_mpsss
        How that changes, where it is on its way: it goes on for a while, ever more slowly.
    trembles
        Whether it changes to and fro at every step: what it does now is ever less of a sign of what comes.
    """

    accel_mpss: float
    change_mpsss: float = 0.0
    trembles: bool = False

    @classmethod
    def of(cls, history: Sequence[EgoSample], average_s: float) -> Foot:
        """Read it from the ego's last moments."""
        recent = since_jump(lately(history, average_s))
        mean = sum(recent) / len(recent)
        accel = 0.0 if abs(mean) < 0.02 else max(-9.0, min(5.0, mean))
        values = since_jump(lately(history, _UNSTEADY_FOR_S, 60))
        changes = [after - before for after, before in pairwise(values)]
        sizes = sorted(abs(change) for change in changes)
        if sum(1 for after, before in pairwise(changes) if after * before < 0.0) > _FEW_TURNS:
            return cls(accel, trembles=len(sizes) >= _FEWEST_CHANGES and sizes[len(sizes) // 2] > _UNSTEADY_MPSS)
        one_way = next((k for k, each in enumerate(changes) if each * changes[0] <= 0.0), len(changes))
        if one_way < _FEWEST_ONE_WAY:
            return cls(accel)
        lasted = min(one_way, _RECENT)
        change = (values[0] - values[lasted]) / (history[-1][0] - history[-1 - lasted][0])
        return cls(values[0], change)

    def goes_on(self, after_s: float, for_s: float, hold_s: float, other_mpss: float = 0.0) -> float:
        """Return the acceleration, on average, in a while that begins later.

        Parameters
        ----------
        hold_s
            How long a foot that does not tremble goes on.
        other_mpss
            What it does then.
        """
        middle_s = after_s + 0.5 * for_s
        if self.trembles:
            return other_mpss + (self.accel_mpss - other_mpss) * math.exp(-middle_s / _FORGETS_S)
        if after_s >= hold_s:
            return other_mpss
        return self.accel_mpss + self.change_mpsss * _MOVES_S * (1.0 - math.exp(-middle_s / _MOVES_S))


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
        foot = Foot.of(history, self.average_s)
        accel = foot.accel_mpss
        moves: list[tuple[float, float, int]] = []
        held = self.held(foot, self.pull(history) > 0.0)
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

    def held(self, foot: Foot, pulls: bool) -> list[tuple[float, float, int]]:
        """Return how the ego goes on before it goes on evenly; one that speeds up on purpose does not forget that."""
        step_s = _FORGET_STEP_S
        if foot.trembles and not pulls:
            lasts = round(_FORGOTTEN_S / step_s)
        elif foot.change_mpsss:
            lasts = round(self.hold_s / step_s)
        else:
            return [(self.hold_s, foot.accel_mpss, 0)]
        return [(step_s, foot.goes_on(k * step_s, step_s, self.hold_s), 0) for k in range(lasts)]

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
        return self.restart_mpss if slow and Foot.of(history, self.average_s).accel_mpss > -_SPEEDS_UP_MPSS else 0.0

    def pulled(self, pull_mpss: float, speed_mps: float) -> float:
        """Return the acceleration (m/s^2) at a speed, of one that pulls like that from standstill."""
        return max(0.0, pull_mpss * (1.0 - (speed_mps / (self.cruise_mps or 1.0)) ** 4))


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
        How it slows down: it begins to where it has to brake like that.
    disregard_mpss
        One that would have to brake harder than this, and does not brake at all, does not mean to.
    """

    places: tuple[tuple[float, float], ...]
    base: ConstantAcceleration = ConstantAcceleration()
    gentle_mpss: float = 1.7
    disregard_mpss: float = 2.8
    step_s: float = 0.2
    horizon_s: float = 20.0

    @classmethod
    def on(cls, route: Route, cruise_mps: float | None = None) -> RoadAware:
        """Return the predictor for an ego on `route`, where people drive at `cruise_mps`."""
        places: list[tuple[float, float]] = []
        if route.origin_kind == "driveway" and "stop_line" in route.landmarks:
            places.append((route.landmarks["stop_line"] - _BUMPER_M, 0.0))
        turn = TurnSpan.of(route)
        if turn is not None:
            steps = int((turn.end_m - turn.start_m) / _BEND_STEP_M)
            along = [turn.start_m + k * _BEND_STEP_M for k in range(steps + 1)]
            bends = [(s_m, abs(route.path.curvature(s_m))) for s_m in along]
            places += [(s_m, math.sqrt(_LATERAL_MPSS / bend)) for s_m, bend in bends if bend > _STRAIGHT]
        return cls(tuple(places), ConstantAcceleration(cruise_mps=cruise_mps))

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the motion step by step; without a place ahead that matters, that of `base`."""
        time_s, s_m, speed, accel = history[-1]
        if speed < 0.3:
            return self.base.predict(history)
        ahead = [place for place in self.places if self._means_to(place, s_m, speed, accel)]
        if not ahead:
            return self.base.predict(history)
        foot, pull = Foot.of(history, self.base.average_s), self.base.pull(history)
        moves: list[tuple[float, float, int]] = []
        elapsed = 0.0
        while elapsed < self.horizon_s:
            lasts = self.step_s
            wanted = foot.goes_on(elapsed, lasts, self.base.hold_s, self.base.pulled(pull, speed))
            needed = max((self._needed(place, s_m, speed) for place in ahead), default=0.0)
            if needed > self.gentle_mpss:
                wanted = min(wanted, -needed) if elapsed < self.base.hold_s and foot.accel_mpss < 0.0 else -needed
            else:
                lasts = min([lasts, *(self._until_needed(place, s_m, speed, wanted) for place in ahead)])
            if speed + wanted * lasts <= 0.05 or self._comes_to_stop(ahead, s_m, speed):
                return self._stopping(time_s, history[-1], moves, speed, min(wanted, -self.gentle_mpss))
            moves.append((lasts, wanted, 0))
            s_m += (speed + 0.5 * wanted * lasts) * lasts
            speed += wanted * lasts
            elapsed += lasts
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

    def _until_needed(self, place: tuple[float, float], s_m: float, speed: float, accel: float) -> float:
        """Return how long it goes on with an acceleration until it begins to brake for a place (s)."""
        room_m = 2.0 * self.gentle_mpss * (place[0] - s_m) - speed * speed + place[1] * place[1]
        closing = self.gentle_mpss + accel
        way_m = 0.5 * room_m / closing if closing > 0.0 else math.inf
        root = speed * speed + 2.0 * accel * way_m
        if way_m > speed * self.step_s + accel or root <= 0.0:
            return self.step_s
        return max(_SHORTEST_S, 2.0 * way_m / (speed + math.sqrt(root)))

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
