"""What a plan is to meet, as one problem: the program lowered once, over motions that can be driven.

What enters: a scene, and at each tick a `Situation`. What leaves: unknowns, and for values of them residuals (what is
to be as small as can be) and rows (what is to be at most zero), with derivatives. Constraints are those that proofs
and witnesses are about, lowered by the same code.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.profile import Profile
from scenewright.plan.preferences import PREFERENCES, Preferences
from scenewright.plan.shooting import Leg, Moment, Shot, Start, shoot
from scenewright.program.structure import Structure, actors_of
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.roads.routes import Route
from scenewright.solve.limits import Limits
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.narrowing import Narrowing
from scenewright.solve.proofs.polynomials import Atom, Polynomial
from scenewright.solve.proofs.search import Search, _choose

Array = NDArray[np.float64]
EgoStates = Callable[[float], tuple[float, float, float]]

_TIGHT = {"time": 0.1, "place": 0.5, "speed": 0.25, "rate": 0.25, "other": 1.0}
_CELL_S, _MOST_CELLS, _AFTER_S = 0.6, 12, 3.0
_AROUND_M, _STEP_M = 3.0, 0.5
_STILL_MPS = 0.1
_MOVES_MPS = 0.7
_SOONEST_S, _LEAST_S = 0.02, 0.05
_OUT_OF_WAY_M = 0.5
_APART_M = VEHICLE_LENGTH_M + 1.5
_ANY = float("inf")


@dataclass(frozen=True, slots=True)
class Answer:
    """How an ego that follows a hero answers what that does, to first order, at the hero's trigger.

    For each metre by which the hero is further on than in the motion that the ego was foreseen with, the ego is
    `place` metres further on and `speed_mps` faster.
    """

    motion: Profile
    place: float
    speed_mps: float


@dataclass(frozen=True, slots=True)
class Situation:
    """What a plan starts from.

    Attributes
    ----------
    time_s, ego
        Now; the ego's states, past and foreseen, by time.
    knots_s
        Times of moments that are known: passed, or foreseen of the ego alone.
    expected_s
        First guesses of the times of others.
    heroes
        For each hero that drives already: from when on it can still be planned, in which piece, and its motion.
    planned_s
        When triggers are to come of which both decide when they do.
    sure
        Whether the ego will drive as foreseen, as its policy promises.
    answers
        For each hero that the ego follows, how.
    guesses
        Motions that first plans start from.
    settled_s
        From when on a hero, as it has driven, is settled for long enough for its trigger.
    waits
        Heroes of whose trigger the ego decides when it comes.
    apart
        For each hero on the ego's lane: 1 where it keeps ahead, -1 behind; what to add to its arc length there (m).
    """

    time_s: float
    ego: EgoStates
    knots_s: Mapping[int, float]
    expected_s: Mapping[int, float]
    heroes: Mapping[int, tuple[float, int, Profile]] = field(default_factory=dict)
    planned_s: Mapping[int, float] = field(default_factory=dict)
    sure: bool = False
    answers: Mapping[int, Answer] = field(default_factory=dict)
    apart: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    waits: frozenset[int] = frozenset()
    settled_s: Mapping[int, float] = field(default_factory=dict)
    guesses: Mapping[int, Profile] = field(default_factory=dict)


class Program:
    """A scene's constraints, lowered once for all plans of a run."""

    def __init__(self, scene: Scene, structure: Structure, limits: Mapping[int, Limits]) -> None:
        self.scene, self.structure, self.limits = scene, structure, limits
        self.events = Events(scene, limits, EgoBounds())
        self.lowering = Lowering(self.events)
        mine = [c for c in scene.program.constraints if actors_of(c.formula) != {EGO}]
        lowered = self.lowering.lower(tuple(mine))
        formulas = [each.formula for each in lowered] + [formula for formula, _ in self.events.rules]
        self.narrowings: list[Narrowing] = list(self.lowering.narrowings)
        self.search = Search(self.events, formulas, self.narrowings)
        self.times = [_number(time) for time in self.events.times]
        scale = [_TIGHT[unknown.kind] for unknown in self.events.unknowns]
        self.scale = np.array([*scale, 0.0])
        self.caps = {hero.id: _caps(scene.routes[hero.id], limits[hero.id]) for hero in scene.program.heroes}
        self.zones: dict[int, float] = {}
        for hero in scene.program.heroes:
            conflict = scene.conflict(EGO, hero.id)
            if conflict is not None and conflict.kind != "following":
                self.zones[hero.id] = conflict.zone_b_m[0] - _OUT_OF_WAY_M
        self.quotients = _quotients(self.events, self.search._index)
        only_times = np.array([unknown.kind == "time" for unknown in self.events.unknowns])
        self.orders = [
            all(key == () or (len(key) == 1 and only_times[key[0]]) for key in atom.left.terms)
            for atom in self.search._index
        ]

    def knot(self, actor: int, name: str) -> int:
        """Return the instant of a knot."""
        return self.events.knot(actor, name)

    def trigger(self, hero: int) -> int | None:
        """Return the instant of a hero's trigger; None where it has none."""
        name = self.structure.trigger_knot(hero)
        return None if name is None else self.knot(hero, name)


@dataclass(slots=True)
class Rows:
    """Values and derivatives: residuals, and what is to be at most zero; both in units of cost."""

    values: list[float] = field(default_factory=list)
    slopes: list[Array] = field(default_factory=list)
    firm: list[bool] = field(default_factory=list)  # broken only where nothing else can be done
    most: list[float] = field(default_factory=list)  # from which value on the cost grows evenly, not with the square

    def add(self, value: float, slope: Array, weight: float = 1.0, firm: bool = False, most: float = _ANY) -> None:
        """Add one row."""
        self.values.append(weight * value)
        self.slopes.append(weight * slope)
        self.firm.append(firm)
        self.most.append(most)

    def beyond(self, value: float, slope: Array, weight: float) -> None:
        """Add what is unpleasant only where it is greater than zero."""
        if value > 0.0:
            self.add(value, slope, weight)


class Problem:
    """One plan's unknowns, for one situation."""

    def __init__(self, program: Program, situation: Situation, wanted: Preferences = PREFERENCES) -> None:
        self.program, self.now, self.wanted = program, situation, wanted
        self.low: list[float] = []
        self.high: list[float] = []
        self.step: list[float] = []
        self.guess: list[float] = []
        self.starts: dict[int, Start] = {}
        self.legs: dict[int, list[Leg]] = {}
        self.nodes: dict[tuple[int, int], tuple[int, int]] = {}  # actor, instant: number of leg that begins there
        events = program.events
        self._moments = [self._moment(instant) for instant in range(len(events.times))]
        for hero in program.scene.program.heroes:
            self._lay_out(hero)
        self._others: dict[int, int] = {}
        known = {number for number in program.times if number is not None}
        for state in events.states.values():
            known |= {number for number in (_number(state.place), _number(state.speed)) if number is not None}
        known |= {number for rate in program.lowering.rates.values() if (number := _number(rate)) is not None}
        for number, unknown in enumerate(events.unknowns):
            if number not in known:
                self._others[number] = self._new(0.0, float(unknown.low), float(unknown.high), 4.0)
        self.size = len(self.guess)

    def _new(self, guess: float, low: float, high: float, step: float) -> int:
        self.guess.append(min(max(guess, low), high))
        self.low.append(low)
        self.high.append(high)
        self.step.append(step)
        return len(self.guess) - 1

    def _moment(self, instant: int) -> Moment:
        constant = self.program.events.times[instant].constant
        if constant is not None:
            return Moment(float(constant))
        if instant in self.now.knots_s:
            return Moment(self.now.knots_s[instant])
        guess = self.now.expected_s.get(instant, self.now.time_s + 5.0)
        soonest = self.now.time_s + _SOONEST_S if self.now.heroes else 0.0
        return Moment(0.0, self._new(guess, max(soonest, self.now.settled_s.get(instant, 0.0)), 200.0, 0.6))

    def _lay_out(self, hero: Actor) -> None:
        """Make a hero's legs from now on, with first guesses of what it does in them."""
        program, sketch = self.program, hero.sketch
        knots = [self._moments[program.knot(hero.id, name)] for name in sketch.knots]
        z = np.array(self.guess)
        if hero.id in self.now.heroes:
            begin_s, piece, profile = self.now.heroes[hero.id]
            s_m, speed_mps, _ = profile.state(begin_s)
            self.starts[hero.id] = Start(s_m, speed_mps)
            begin = Moment(begin_s)
        else:
            profile, piece, begin = self.now.guesses[hero.id], 0, knots[0]
            place_m, speed_mps, _ = profile.state(0.0)
            end = program.scene.routes[hero.id].landmarks["route_end"]
            self.starts[hero.id] = Start(place=self._new(place_m, 0.0, end, 40.0), speed=self._new(speed_mps, 0.0, 60.0, 5.0))
        legs: list[Leg] = []
        for number in range(piece, len(sketch.pieces)):
            first = begin if number == piece else knots[number]
            self.nodes[hero.id, program.knot(hero.id, sketch.knots[number])] = (len(legs), 0)
            legs += self._piece(hero, number, first, knots[number + 1], z, profile)
        self.nodes[hero.id, program.knot(hero.id, sketch.knots[-1])] = (len(legs), 0)
        if hero.id in self.now.heroes and piece < len(sketch.pieces):
            self.nodes.pop((hero.id, program.knot(hero.id, sketch.knots[piece])), None)
        last = knots[-1] if piece < len(sketch.pieces) else begin
        stands = sketch.pieces[-1] is PieceKind.STOP
        after = Moment(last.constant_s + _AFTER_S, last.unknown)
        legs.append(self._leg(hero.id, len(sketch.pieces) - 1, PieceKind.STOP if stands else PieceKind.GO, last, after, z, profile))
        self.legs[hero.id] = legs

    def _piece(self, hero: Actor, number: int, first: Moment, last: Moment, z: Array, profile: Profile | None) -> list[Leg]:
        """Return the legs of one piece: two where it is to be settled at its end."""
        kind, trigger = hero.sketch.pieces[number], self.program.trigger(hero.id)
        at_trigger = trigger is not None and self.program.knot(hero.id, hero.sketch.knots[number + 1]) == trigger
        settled_s = self.wanted.settled_s
        if kind is PieceKind.GO and at_trigger and last.value(z) - first.value(z) > settled_s + 0.4:
            between = Moment(last.constant_s - settled_s, last.unknown)
            if last.unknown is not None and first.unknown is None:
                self.low[last.unknown] = max(self.low[last.unknown], first.constant_s + settled_s + _LEAST_S)
            coming = self._leg(hero.id, number, kind, first, between, z, profile)
            settled = self._leg(hero.id, number, kind, between, last, z, profile, coming.accels[-1])
            return [coming, settled]
        return [self._leg(hero.id, number, kind, first, last, z, profile)]

    def _leg(
        self, hero: int, piece: int, kind: PieceKind, first: Moment, last: Moment, z: Array,
        profile: Profile | None, joined: int | None = None,
    ) -> Leg:  # fmt: skip
        lasts_s = last.value(z) - first.value(z)
        before_s = self._as_planned(hero, piece, first, last, z, profile)
        cells = min(max(2, round(lasts_s / _CELL_S)), _MOST_CELLS) if kind is not PieceKind.STOP else 1
        if kind is PieceKind.STOP:
            return Leg(piece, kind, first, last, cells, ())
        limits, wanted = self.program.limits[hero], self.wanted
        low, high, guess = -limits.brake_max_mpss, limits.accel_max_mpss, 0.0
        if kind is PieceKind.DEC:
            high, guess = -wanted.least_rate_mpss, -wanted.braking_mpss
        elif kind is PieceKind.ACC:
            low, guess = wanted.least_rate_mpss, wanted.speeding_up_mpss
        accels = [] if joined is None else [joined]
        for k in range(len(accels), cells + 1):
            if profile is not None and before_s[0] < before_s[1]:
                inside_s = 1e-6 if k == 0 else -1e-6 if k == cells else 0.0
                guess = profile.state(before_s[0] + (before_s[1] - before_s[0]) * k / cells + inside_s)[2]
            accels.append(self._new(guess, low, high, 3.0))
        return Leg(piece, kind, first, last, cells, tuple(accels))

    def _as_planned(
        self, hero: int, piece: int, first: Moment, last: Moment, z: Array, profile: Profile | None
    ) -> tuple[float, float]:
        """Return when the plan in force does what a leg is to do: guesses keep to their places within pieces."""
        if profile is None or len(profile.knot_times_s) < 2:
            return 0.0, 0.0
        actor = self.program.scene.program.actor(hero)
        begin_s = self.now.heroes[hero][0] if hero in self.now.heroes else 0.0
        knots = [max(begin_s, profile.knot_times_s[name]) for name in actor.sketch.knots]
        now = [max(begin_s, self._moments[self.program.knot(hero, name)].value(z)) for name in actor.sketch.knots]
        if first.value(z) >= now[-1] - 1e-9:
            return knots[-1], max(profile.end_s, knots[-1])
        whole, old = now[piece + 1] - now[piece], knots[piece + 1] - knots[piece]
        shares = [(moment.value(z) - now[piece]) / max(whole, 1e-9) for moment in (first, last)]
        return knots[piece] + shares[0] * old, knots[piece] + shares[1] * old

    # -- values -------------------------------------------------------------------------------------------------------
    def ordered(self, z: Array) -> Array:
        """Return values within their bounds in which every hero's knots come one after another."""
        z = np.clip(z, self.low, self.high)
        for hero in self.program.scene.program.heroes:
            latest = -_ANY
            for name in hero.sketch.knots:
                moment = self._moments[self.program.knot(hero.id, name)]
                if moment.unknown is not None:
                    z[moment.unknown] = max(z[moment.unknown], latest + _LEAST_S - moment.constant_s)
                latest = max(latest, moment.value(z))
        return z

    def shots(self, z: Array) -> dict[int, Shot]:
        """Return everybody's motion."""
        return {hero: shoot(legs, self.starts[hero], z) for hero, legs in self.legs.items()}

    def _points(self, z: Array, shots: Mapping[int, Shot]) -> tuple[Array, Array]:
        """Return the values of all unknowns of the lowered program, a one behind them, and their derivatives."""
        program, events = self.program, self.program.events
        count = len(events.unknowns)
        point, slopes = np.zeros(count + 1), np.zeros((count + 1, self.size))
        point[-1] = 1.0
        times, d_times = [], []
        for instant, number in enumerate(program.times):
            moment = self._moments[instant]
            d_time = np.zeros(self.size)
            if moment.unknown is not None:
                d_time[moment.unknown] = 1.0
            times.append(moment.value(z))
            d_times.append(d_time)
            if number is not None:
                point[number], slopes[number] = times[-1], d_time
        for (actor, instant), state in events.states.items():
            place, speed = _number(state.place), _number(state.speed)
            if place is None or speed is None:
                continue
            point[place], point[speed], slopes[place], slopes[speed] = self._state(
                actor, instant, times[instant], d_times[instant], shots
            )
        for (actor, instant), rate in program.lowering.rates.items():
            number = _number(rate)
            if number is not None:
                point[number], slopes[number] = self._rate(actor, instant, times[instant], shots)
        for number, unknown in self._others.items():
            point[number] = z[unknown]
            slopes[number, unknown] = 1.0
        return point, slopes

    def _state(
        self, actor: int, instant: int, time_s: float, d_time: Array, shots: Mapping[int, Shot]
    ) -> tuple[float, float, Array, Array]:
        if actor == EGO:
            s_m, speed_mps, accel = self.now.ego(time_s)
            d_s, d_v = speed_mps * d_time, accel * d_time
            for hero, answer in self.now.answers.items():
                if time_s <= self.now.time_s or instant != self.program.trigger(hero):
                    continue
                place, _, d_place, _ = self._state(hero, instant, time_s, d_time, shots)
                then_m, then_mps, _ = answer.motion.state(time_s)
                further_m, d_further = place - then_m, d_place - then_mps * d_time
                s_m, d_s = s_m + answer.place * further_m, d_s + answer.place * d_further
                speed_mps, d_v = speed_mps + answer.speed_mps * further_m, d_v + answer.speed_mps * d_further
            return s_m, speed_mps, d_s, d_v
        shot = shots[actor]
        leg = self.nodes.get((actor, instant))
        if leg is not None:
            return shot.at_node(shot.first_node[leg[0]])
        if actor in self.now.heroes and time_s <= self.now.heroes[actor][0]:
            s_m, speed_mps, _ = self.now.heroes[actor][2].state(time_s)
            return s_m, speed_mps, np.zeros(self.size), np.zeros(self.size)
        return shot.at(time_s, d_time)

    def _rate(self, actor: int, instant: int, time_s: float, shots: Mapping[int, Shot]) -> tuple[float, Array]:
        if actor == EGO:
            return self.now.ego(time_s)[2], np.zeros(self.size)
        if actor in self.now.heroes and time_s < self.now.heroes[actor][0]:
            return self.now.heroes[actor][2].state(time_s)[2], np.zeros(self.size)
        sketch = self.program.scene.program.actor(actor).sketch
        before = instant == self.program.knot(actor, sketch.knots[-1])
        return shots[actor].rate_at(time_s, before)

    def rows(self, z: Array) -> tuple[Rows, Rows, tuple[float, float]]:
        """Return residuals, soft rows, and what is missed most: of what heroes do (tight tolerances), of orders (s)."""
        shots = self.shots(z)
        costs, bounds = Rows(), Rows()
        missed = self._asked(z, shots, costs, bounds)
        self._punctual(z, costs)
        for hero in self.program.scene.program.heroes:
            self._comfort(hero, shots[hero.id], costs)
            self._limits(hero, shots[hero.id], bounds, costs)
            self._manner(hero, shots[hero.id], bounds, costs)
            self._narrowed(hero, shots[hero.id], bounds)
            self._keep_apart(hero, shots[hero.id], bounds)
        return costs, bounds, missed

    def _asked(self, z: Array, shots: Mapping[int, Shot], costs: Rows, bounds: Rows) -> tuple[float, float]:
        program, price = self.program, self.wanted.price
        point, slopes = self._points(z, shots)
        compiled = program.search._compiled
        values, gradients = compiled.values(point), compiled.gradients(point)
        norms = np.maximum(np.sqrt(((gradients * program.scale) ** 2).sum(axis=1)), 1e-9)
        for k, place, speed in program.quotients:
            norms[k] = _TIGHT["time"] * max(float(point[speed]), _MOVES_MPS) * max(abs(float(gradients[k, place])), 1e-9)
        levels = values / norms
        errors = np.where(compiled.equal, np.abs(levels), levels)
        chosen: list[int] = []
        for tree in program.search._trees:
            _choose(tree, errors, chosen)
        missed = late_s = 0.0
        for k in dict.fromkeys(chosen):
            slope = gradients[k] @ slopes / norms[k]
            if not np.any(slope) and not compiled.equal[k] and levels[k] <= 0:
                continue
            if program.orders[k] and not compiled.equal[k]:
                # In a forecast nothing is sure: who is to be first is to be it by some time, and at a lower price by
                # more. Where it denies that, what is in the hero's own hands is not spoilt for it.
                late_s = max(late_s, 0.1 * float(levels[k]))
                bounds.add(float(levels[k]) + 1.0, slope, price, most=_ANY if self.now.sure else self.wanted.order_most)
                bounds.add(0.1 * float(levels[k]) + self.wanted.order_s, 0.1 * slope, self.wanted.order_price)
                continue
            missed = max(missed, float(errors[k])) if np.any(slope) else missed
            if compiled.equal[k]:
                costs.add(float(levels[k]), slope, price)
                continue
            bounds.add(float(levels[k]), slope, price)
        return missed, late_s

    def _punctual(self, z: Array, costs: Rows) -> None:
        """Add that a trigger of which both decide when it comes does so when it was planned to."""
        for instant, planned_s in self.now.planned_s.items():
            moment = self._moments[instant]
            if moment.unknown is not None:
                slope = np.zeros(self.size)
                slope[moment.unknown] = 1.0
                costs.add(moment.value(z) - planned_s, slope, self.wanted.punctual)

    def _comfort(self, hero: Actor, shot: Shot, costs: Rows) -> None:
        """Add what is unpleasant: jerk, and acceleration that nobody asked for."""
        wanted = self.wanted
        usual = {PieceKind.DEC: -wanted.braking_mpss, PieceKind.ACC: wanted.speeding_up_mpss}
        for number, leg in enumerate(shot.legs):
            if number == len(shot.legs) - 1 and leg.kind is PieceKind.GO and shot.v[shot.first_node[number]] > 1.0:
                # Whoever drives on afterwards does so as people do there.
                costs.add(float(shot.v[-1]) - 0.8 * self.program.limits[hero.id].natural_approach_speed_mps, shot.d_v[-1], 0.1)
            if not leg.accels:
                continue
            aim = usual.get(leg.kind, 0.0)
            for k, (one, other) in enumerate(pairwise(leg.accels)):
                node = shot.first_node[number] + k
                lasts = max(float(shot.time[node + 1] - shot.time[node]), 0.02)
                slope = np.zeros(self.size)
                slope[one], slope[other] = -1.0, 1.0
                costs.add(float(shot.z[other] - shot.z[one]), slope, 1.0 / (lasts**0.5 * wanted.jerk_mpsss))
                slope = np.zeros(self.size)
                slope[one] = slope[other] = 0.5
                mean = 0.5 * float(shot.z[one] + shot.z[other])
                costs.add(mean - aim, slope, lasts**0.5 / wanted.accel_mpss)

    def _limits(self, hero: Actor, shot: Shot, bounds: Rows, costs: Rows) -> None:
        """Add what no motion exceeds: nobody drives backwards, or faster than road and bends allow."""
        limits, price = self.program.limits[hero.id], self.wanted.price
        places, hard, soft = self.program.caps[hero.id]
        natural = limits.natural_approach_speed_mps
        for node in range(1, len(shot.time)):
            s, v, d_s, d_v = shot.at_node(node)
            bounds.add(-v, -d_v, price / 0.05, firm=True)
            cap, slope = _interpolated(s, places, hard)
            bounds.add(v - cap, d_v - slope * d_s, price / 0.05, firm=True)
            cap, slope = _interpolated(s, places, soft)
            costs.beyond(v - cap, d_v - slope * d_s, 0.7)
            costs.beyond(v - natural, d_v, 0.5)

    def _manner(self, hero: Actor, shot: Shot, bounds: Rows, costs: Rows) -> None:
        """Add what makes pieces be seen for what they are, and how long they usually last."""
        wanted, price = self.wanted, self.wanted.price
        trigger = self.program.trigger(hero.id)
        at_trigger = self.nodes.get((hero.id, trigger)) if trigger is not None else None
        z, legs = shot.z, shot.legs
        for number, leg in enumerate(legs[:-1]):
            if leg.kind is PieceKind.STOP:
                _, v, _, d_v = shot.at_node(shot.first_node[number])
                costs.add(v, d_v, price / _STILL_MPS)
            self._lasting(hero, leg, z, bounds, costs, stands=number + 1 < len(legs) - 1 and legs[number + 1].kind is PieceKind.STOP)
        if at_trigger is None or at_trigger[0] >= len(legs) - 1:
            return
        begins = legs[at_trigger[0]]
        sense = {PieceKind.DEC: -1.0, PieceKind.ACC: 1.0}.get(begins.kind, 0.0)
        node = shot.first_node[at_trigger[0]]
        _, v, _, d_v = shot.at_node(node)
        natural = 0.8 * self.program.limits[hero.id].natural_approach_speed_mps
        if node and begins.kind is not PieceKind.STOP:
            costs.add(v - natural, d_v, 0.15)
            bounds.add(wanted.slowest_mps - v, -d_v, wanted.slowest_price)
            bounds.add(_MOVES_MPS - v, -d_v, price / 0.25)
        if not sense:
            return
        lasts = max(float(shot.time[node + 1] - shot.time[node]), 1e-3)
        for k, accel in enumerate(begins.accels):
            if k * lasts < wanted.beginning_s:
                slope = np.zeros(self.size)
                slope[accel] = -sense
                bounds.add(wanted.beginning_mpss - sense * float(z[accel]), slope, price / 0.25)
        before = legs[at_trigger[0] - 1] if at_trigger[0] else None
        if before is not None and before.kind is PieceKind.GO:
            for k, accel in enumerate(before.accels):
                at_s = before.first.value(z) + k * (before.last.value(z) - before.first.value(z)) / before.cells
                if at_s > before.last.value(z) - wanted.settled_s - 1e-6:
                    slope = np.zeros(self.size)
                    slope[accel] = sense
                    bounds.add(sense * float(z[accel]) - wanted.settled_mpss, slope, price / 0.25)

    def _lasting(self, hero: Actor, leg: Leg, z: Array, bounds: Rows, costs: Rows, stands: bool) -> None:
        wanted = self.wanted
        first, last = (
            self._moments[self.program.knot(hero.id, hero.sketch.knots[leg.piece + k])] for k in (0, 1)
        )
        lasts = last.value(z) - first.value(z)
        slope = np.zeros(self.size)
        if last.unknown is not None:
            slope[last.unknown] += 1.0
        if first.unknown is not None:
            slope[first.unknown] -= 1.0
        if not np.any(slope):
            return
        shortest = wanted.shortest_stand_s if leg.kind is PieceKind.STOP else wanted.shortest_s
        bounds.add(shortest - lasts, -slope, wanted.price / 0.1, firm=True)
        if leg.first.unknown is None and leg.last.unknown is not None:
            bounds.add(self.now.time_s + _SOONEST_S - last.value(z), -slope, wanted.price / 0.1, firm=True)
        if leg.kind is PieceKind.STOP:
            costs.add(lasts - wanted.stands_s, slope, 1.0)
        elif not stands and self.program.knot(hero.id, hero.sketch.knots[leg.piece + 1]) != self.program.trigger(hero.id):
            costs.add(lasts - wanted.lasts_s, slope, 0.3)

    def _keep_apart(self, hero: Actor, shot: Shot, bounds: Rows) -> None:
        """Add that until its trigger a hero is not in the ego's way, and can wait for it."""
        instant, wanted = self.program.trigger(hero.id), self.wanted
        reached = self.nodes.get((hero.id, instant)) if instant is not None else None
        if reached is None:
            return
        last = shot.first_node[reached[0]]
        if hero.id in self.now.apart:
            self._stay_on_side(hero, shot, last, bounds)
        zone_m = self.program.zones.get(hero.id)
        until_s = float(shot.time[last])
        s_T, v_T, d_s_T, d_v_T = shot.at_node(last)
        runs_up_m, d_runs_up = v_T**2 / (2.0 * wanted.sets_off_mpss), v_T / wanted.sets_off_mpss * d_v_T
        first = 1 if hero.id in self.now.heroes else 0
        for node in range(first, last + 1):
            s_m, v, d_s, d_v = shot.at_node(node)
            if zone_m is not None and s_m < zone_m + 2.0:
                bounds.add(s_m - zone_m, d_s, wanted.out_of_way_price, most=wanted.out_of_way_most)
            if hero.id in self.now.waits and until_s - shot.time[node] > v_T / wanted.sets_off_mpss + wanted.waits_s:
                beyond_m = s_m + v**2 / (2.0 * wanted.waits_mpss) + runs_up_m - s_T
                bounds.add(beyond_m, d_s + v / wanted.waits_mpss * d_v + d_runs_up - d_s_T, wanted.waits_price)

    def _stay_on_side(self, hero: Actor, shot: Shot, last: int, bounds: Rows) -> None:
        """Add that a hero on the ego's lane leaves room between the two, and that their distance changes plainly."""
        side, offset_m = self.now.apart[hero.id]
        for node in range(1 if hero.id in self.now.heroes else 0, last + 1):
            time_s = float(shot.time[node])
            s_m, _, d_s, _ = shot.at_node(node)
            ego_m, ego_mps, _ = self.now.ego(time_s)
            room_m = side * (s_m + offset_m - ego_m) - _APART_M
            bounds.add(-room_m, -side * (d_s - ego_mps * shot.d_time[node]), self.wanted.price)
        s_m, v, d_s, d_v = shot.at_node(last)
        time_s = float(shot.time[last])
        ego_m, ego_mps, ego_mpss = self.now.ego(time_s)
        now_m = side * (float(shot.s[0]) - self.now.ego(float(shot.time[0]))[0])
        opens = 1.0 if side * (s_m - ego_m) > now_m else -1.0
        rate, d_rate = side * (v - ego_mps), side * (d_v - ego_mpss * shot.d_time[last])
        bounds.add(self.wanted.plain_mps - opens * rate, -opens * d_rate, self.wanted.plain_price)

    def _narrowed(self, hero: Actor, shot: Shot, bounds: Rows) -> None:
        """Add narrower laws, which constraints make of stretches of time."""
        price = self.wanted.price
        for narrowing in self.program.narrowings:
            if narrowing.actor != hero.id:
                continue
            begin = max(self._moments[k].value(shot.z) for k in narrowing.begins())
            end = min(self._moments[k].value(shot.z) for k in narrowing.ends())
            law = narrowing.law
            for number, leg in enumerate(shot.legs):
                for k in range(leg.cells + 1):
                    node = shot.first_node[number] + k
                    if not begin - 1e-6 <= shot.time[node] <= end + 1e-6:
                        continue
                    _, v, _, d_v = shot.at_node(node)
                    if law.speed_high < 900:
                        bounds.add(v - float(law.speed_high), d_v, price / 0.25)
                    if law.speed_low > -900:
                        bounds.add(float(law.speed_low) - v, -d_v, price / 0.25)
                    inside = begin - 1e-6 <= shot.time[shot.first_node[number]] and shot.time[shot.first_node[number + 1]] <= end + 1e-6
                    if not leg.accels or not (inside or begin + 1e-6 < shot.time[node] < end - 1e-6):
                        continue
                    slope = np.zeros(self.size)
                    slope[leg.accels[k]] = 1.0
                    accel = float(shot.z[leg.accels[k]])
                    if law.rate_high < 900:
                        bounds.add(accel - float(law.rate_high), slope, price / 0.25)
                    if law.rate_low > -900:
                        bounds.add(float(law.rate_low) - accel, -slope, price / 0.25)


def _number(value: Polynomial) -> int | None:
    """Return which unknown a polynomial is; None for a number."""
    if value.constant is not None:
        return None
    return next(iter(value.terms))[0]


def _quotients(events: Events, index: Sequence[Atom]) -> list[tuple[int, int, int]]:
    """Return atoms that compare times, a place over a speed: their numbers, with those of the place and the speed."""
    found = []
    for number, atom in enumerate(index):
        kinds: dict[str, int] = {}
        for key in atom.left.terms:
            for unknown in key:
                kinds.setdefault(events.unknowns[unknown].kind, unknown)
        if "place" in kinds and "speed" in kinds:
            found.append((number, kinds["place"], kinds["speed"]))
    return found


def _interpolated(s_m: float, places: Array, caps: Array) -> tuple[float, float]:
    """Return the cap (m/s) at a place, and how it changes from there (1/s)."""
    around = np.interp([s_m - 0.5, s_m, s_m + 0.5], places, caps)
    return float(around[1]), float(around[2] - around[0])


def _caps(route: Route, limits: Limits) -> tuple[Array, Array, Array]:
    """Return places (m) and the speeds (m/s) that bends allow there: at most, and in comfort."""
    places = np.arange(0.0, route.path.length_m + _STEP_M, _STEP_M)
    bends = np.array([abs(route.path.curvature(float(s))) for s in places])
    around = round(_AROUND_M / _STEP_M)
    padded = np.pad(bends, around, mode="edge")
    sharpest = np.max([padded[k : k + len(bends)] for k in range(2 * around + 1)], axis=0)
    sharpest, top = np.maximum(sharpest, 1e-6), 0.97 * limits.speed_max_mps
    return (
        places,
        np.minimum(np.sqrt(0.97 * limits.lateral_max_mpss / sharpest), top),
        np.minimum(np.sqrt(PREFERENCES.lateral_mpss / sharpest), top),
    )


def steps_and_bounds(problem: Problem) -> tuple[Array, Array, Array]:
    """Return the longest steps, and the least and greatest values of all unknowns."""
    return np.array(problem.step), np.array(problem.low), np.array(problem.high)


__all__: Sequence[str] = ["Problem", "Program", "Rows", "Situation", "steps_and_bounds"]
