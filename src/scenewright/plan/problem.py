"""One plan as one problem: for any values of its unknowns what they cost and what they miss.

What enters: what is asked, and a `Situation`. What leaves: residuals and rows for `solving`. What is unknown, and which
motions values stand for, is told elsewhere (see `unknowns`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scenewright.plan.asked import TIGHT, number_of
from scenewright.plan.pairs import PairRows, Way
from scenewright.plan.rows import FIRM, HeroRows, Rows
from scenewright.plan.shooting import Shot
from scenewright.plan.unknowns import Unknowns
from scenewright.program.types import EGO

Array = NDArray[np.float64]

DAMPING = 0.02  # of a longest step, in every step: what nothing else decides stays as it is
_NEAR_M = 12.0  # who is further apart in a lane is not looked at in a tick, of which steps are short; chosen


@dataclass(frozen=True, slots=True)
class Missed:
    """What is missed most: of what is asked of heroes, in tight tolerances; by whom is to be first, in seconds."""

    by: float = 0.0
    late_s: float = -np.inf


class Problem(Unknowns):
    """What values of the unknowns of one plan cost, and what they miss."""

    def rows(self, z: Array) -> tuple[Rows, Rows, Missed]:
        """Return residuals, rows that are to be at most zero, and what is missed."""
        shots = self.shots(z)
        costs, bounds = Rows(), Rows()
        missed = self._add_asked(z, shots, costs, bounds)
        for instant, planned_s in self.now.planned_s.items():
            moment = self.moments[instant]
            if moment.unknown is not None:
                costs.add(moment.value(z) - planned_s, moment.slope(self.size), self.asked.wanted.punctual_weight)
        for number, everyday in self.asked.everyday.items():
            unknown, weight = self._others[number], self.asked.wanted.everyday_weight / max(1.0, abs(everyday))
            costs.add(z[unknown] - everyday, np.eye(self.size)[unknown], weight)
        for first, second in pairwise(self._ego_moments):  # heroes' are apart by what pieces last
            slope = first.slope(self.size) - second.slope(self.size)
            if np.any(slope):
                bounds.add(first.value(z) - second.value(z), slope, FIRM * self.asked.wanted.price)
        for hero, shot in shots.items():
            actor, own = self.asked.scene.program.actor(hero), self._own[hero]
            costs.by = bounds.by = own.columns if len(own.columns) < self.size else None
            HeroRows(self.asked, self.now, actor, shot, own.moments, self._nodes[hero], costs, bounds).add_all()
        if self._meetings:
            missed = replace(missed, by=max(missed.by, self._pairs(z, shots).add(bounds)))
        return costs, bounds, missed

    def dearest(self, z: Array) -> tuple[float, set[int]]:
        """Return by how much the two heroes that are worst too near each other are so (m^2), and who they are."""
        return self._pairs(z, self.shots(z)).dearest()

    def _pairs(self, z: Array, shots: Mapping[int, Shot]) -> PairRows:
        ways = {}
        for hero in self.asked.scene.program.heroes:
            drive, shot = self.now.heroes.get(hero.id), shots.get(hero.id)
            motion = None if drive is None else drive.motion
            ways[hero.id] = Way(motion) if shot is None else Way(motion, shot, self._own[hero.id].columns)
        near_m = _NEAR_M if self.now.heroes else np.inf
        return PairRows(self._meetings, ways, self._looks, self._driven, self.asked.wanted, z, near_m)

    def _add_asked(self, z: Array, shots: Mapping[int, Shot], costs: Rows, bounds: Rows) -> Missed:
        wanted, tight_s = self.asked.wanted, TIGHT["time"]
        by, late_s = 0.0, -np.inf
        for row in self.asked.rows(*self._point(z, shots)):
            if not np.any(row.slope):  # nothing that is still to be planned changes it: at first, another start may
                by = by if self.now.heroes else max(by, abs(row.level) if row.equal else row.level)
                continue
            if row.order:
                # In a forecast nothing is sure: who is to be first is to be it by some time, and at a lower price by
                # more. Where it denies that, what is in the hero's own hands is not spoilt for it.
                most = wanted.sure_order_most if self.now.sure else wanted.order_most
                bounds.add(row.level + 1.0, row.slope, wanted.price, most)
                bounds.add(tight_s * row.level + wanted.order_s, tight_s * row.slope, wanted.order_price)
                late_s = max(late_s, tight_s * row.level)
                continue
            by = max(by, abs(row.level) if row.equal else row.level)
            rows = costs if row.equal else bounds
            of_start = np.count_nonzero(row.slope) == np.count_nonzero(row.slope[self._begins])
            rows.add(row.level + row.spare, row.slope, (FIRM if of_start else 1.0) * wanted.price)
        return Missed(by, late_s)

    def _point(self, z: Array, shots: Mapping[int, Shot]) -> tuple[Array, Array]:
        """Return the values of all unknowns of what is asked, a one behind them, and their derivatives."""
        asked = self.asked
        point, slopes = np.zeros(asked.size + 1), np.zeros((asked.size + 1, self.size))
        point[-1] = 1.0
        for number, moment in zip(asked.times, self.moments, strict=True):
            if number is not None:
                point[number], slopes[number] = moment.value(z), moment.slope(self.size)
        for (actor, instant), state in asked.events.states.items():
            place, speed = number_of(state.place), number_of(state.speed)
            if place is not None and speed is not None:
                found = self._state(actor, instant, z, shots)
                point[place], point[speed], slopes[place], slopes[speed] = found
        for (actor, instant), rate in asked.lowering.rates.items():
            number = number_of(rate)
            if number is not None:
                point[number], slopes[number] = self._rate(actor, instant, z, shots)
        for number, unknown in self._others.items():
            point[number], slopes[number, unknown] = z[unknown], 1.0
        return point, slopes

    def _state(
        self, actor: int, instant: int, z: Array, shots: Mapping[int, Shot]
    ) -> tuple[float, float, Array, Array]:
        moment = self.moments[instant]
        time_s, d_time = moment.value(z), moment.slope(self.size)
        if actor == EGO:
            return self._ego_state(instant, z, shots)
        drive = self.now.heroes.get(actor)
        if actor not in shots and drive is not None:
            s_m, speed_mps, accel = drive.motion.state(time_s)
            return s_m, speed_mps, speed_mps * d_time, accel * d_time
        leg = self._nodes[actor].get(instant)
        if leg is not None:
            return self._of_all(actor, shots[actor].at_node(shots[actor].first_node[leg]))
        if drive is not None and time_s <= drive.begin_s:
            s_m, speed_mps, _ = drive.motion.state(time_s)
            return s_m, speed_mps, np.zeros(self.size), np.zeros(self.size)
        return self._of_all(actor, shots[actor].at(time_s, d_time[self._own[actor].columns]))

    def _of_all(self, hero: int, state: tuple[float, float, Array, Array]) -> tuple[float, float, Array, Array]:
        """Return a hero's state with slopes by all unknowns."""
        d_s, d_v = np.zeros(self.size), np.zeros(self.size)
        d_s[self._own[hero].columns], d_v[self._own[hero].columns] = state[2:]
        return *state[:2], d_s, d_v

    def _ego_state(self, instant: int, z: Array, shots: Mapping[int, Shot]) -> tuple[float, float, Array, Array]:
        """Return the ego's state as foreseen, and as it would answer heroes that do otherwise than then."""
        moment = self.moments[instant]
        time_s, d_time = moment.value(z), moment.slope(self.size)
        s_m, speed_mps, accel = self.now.ego(time_s)
        d_s, d_v = speed_mps * d_time, accel * d_time
        for hero, answer in self.now.answers.items():
            if time_s <= self.now.time_s or instant != self.asked.trigger(hero):
                continue
            place_m, hero_mps, d_place, d_hero = self._state(hero, instant, z, shots)
            then_m, then_mps, then_mpss = answer.then(time_s)
            further_m, d_further = place_m - then_m, d_place - then_mps * d_time
            if answer.per_mps is not None:
                faster_mps, since_s = hero_mps - then_mps, time_s - self.now.time_s
                d_faster = d_hero - then_mpss * d_time
                further_m -= faster_mps * since_s
                d_further = d_further - since_s * d_faster - faster_mps * d_time
                s_m, d_s = s_m + answer.per_mps[0] * faster_mps, d_s + answer.per_mps[0] * d_faster
                speed_mps, d_v = speed_mps + answer.per_mps[1] * faster_mps, d_v + answer.per_mps[1] * d_faster
            s_m, d_s = s_m + answer.per_metre[0] * further_m, d_s + answer.per_metre[0] * d_further
            speed_mps, d_v = speed_mps + answer.per_metre[1] * further_m, d_v + answer.per_metre[1] * d_further
        return s_m, speed_mps, d_s, d_v

    def _rate(self, actor: int, instant: int, z: Array, shots: Mapping[int, Shot]) -> tuple[float, Array]:
        time_s = self.moments[instant].value(z)
        if actor == EGO:
            return self.now.ego(time_s)[2], np.zeros(self.size)
        drive = self.now.heroes.get(actor)
        if drive is not None and (time_s < drive.begin_s or actor not in shots):
            return drive.motion.state(time_s)[2], np.zeros(self.size)
        last = self.asked.knot(actor, self.asked.scene.program.actor(actor).sketch.knots[-1])
        rate, own_slope = shots[actor].rate_at(time_s, before=instant == last)
        slope = np.zeros(self.size)
        slope[self._own[actor].columns] = own_slope
        return rate, slope
