"""Where and how fast the ego starts: what the program says, and for the rest what its policy would hold by itself.

What enters: the program's conditions on the ego's first state, and the policy. What leaves: candidates, best first. A
start that the policy would not hold begins the run with a transient that nobody foresaw.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from scenewright.errors import PolicyError
from scenewright.motion.limits import MOVING_MPS, Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.program.structure import Structure
from scenewright.program.types import EGO, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.simulate.vehicles import EgoVehicle
from scenewright.solve.arrival import LinearCondition, ego_begins_between, knot_between_s

_RUN_UP_M = 90.0
# Before it comes to its first place, where the program does not say when that is, but no longer than heroes take for
# their ways to their triggers, nor shorter than the second number; chosen.
_LEAD_S, _LEAST_LEAD_S = 8.0, 1.0
_ROUNDING_S = 1e-6
# Of a start, until an ego comes to its place when it is told to. Measured: where the road is straight one is exact;
# chosen for bends.
SHIFTS = 4
_STEP_S, _MOST_STEPS = 0.05, 2400
# How long an ego is driven alone at most (s), and how finely that is kept; chosen: what is later is planned later.
_ALONE_S, _STRETCH_S = 40.0, 0.1
_SLOWEST_MPS = 0.5
# Of the natural speed, for an ego whose speed the orchestrator may choose: natural first.
_SLOWER_SHARES = (0.6, 0.35, 0.15)
_SPEED_SHARES = (1.0, 0.85, 0.7, 0.55, 0.42, 0.32, 0.24, 0.18, 0.13, 0.1, 0.08, 1.2, 1.35, 1.5)


@dataclass(frozen=True, slots=True)
class EgoFirstState:
    """A first state of the ego, with the acceleration that it has there when it drives by itself.

    A last resort is only for when no other state leads to a plan.
    """

    s_m: float
    speed_mps: float
    accel_mpss: float = 0.0
    last_resort: bool = False


def _within(value: float, bounds: tuple[float, float]) -> float:
    return min(max(value, bounds[0]), bounds[1])


class _Way:
    """What the program says of the ego's way: where it begins and how fast, None where that is free.

    And where it is to come to, first things first, or where it is to be if nothing is told (`middle_m`). It begins
    `lead_s` before the first of these: as given, but for what the program says; `is_told` where it says just how long.
    """

    def __init__(self, scene: Scene, conditions: tuple[LinearCondition, ...], lead_s: float) -> None:
        sketch, landmarks = scene.program.ego.sketch, scene.landmarks_m[EGO]
        first = EGO, sketch.knots[0]
        placed = [c for c in conditions if set(c.weights) == {EGO} and c.weights[EGO][0]]

        def order(condition: LinearCondition) -> int:
            own = (sketch.knot_index(name) for who, name in condition.moments if who == EGO)
            return min(own, default=len(sketch.knots))  # what is of a hero's knot comes behind all of the ego's

        self._places_m, self._speeds_mps = ego_begins_between(scene)
        self.begins = next((c for c in placed if c.moments == {first}), None)
        self.speed_mps = told_speed_mps(scene, conditions)
        self.later = sorted((c for c in placed if first not in c.moments), key=order)
        least_s, most_s = knot_between_s(scene, min(self.later[0].moments)) if self.later else (0.0, math.inf)
        self.lead_s, self.is_told = min(max(lead_s, least_s), most_s), most_s - least_s < _ROUNDING_S
        ends_m = landmarks["route_end"]
        meets_m = landmarks.get("intersection", ends_m)
        # Two that never part on a road without a junction meet where it ends, and there is no room there for anything.
        self.middle_m = meets_m if meets_m < ends_m else 0.5 * ends_m

    def start_m(self, speed_mps: float) -> float:
        """Return where an ego of this speed starts: as the program says, else so that it comes to its place in time."""
        if self.begins is not None:
            return self.begins.place_m(EGO, speed_mps)
        there_m = self.later[0].place_m(EGO, speed_mps) if self.later else self.middle_m
        return _within(max(1.0, there_m - self.lead_s * speed_mps), self._places_m)

    def allowed_mps(self, speed_mps: float) -> float:
        """Return the nearest speed with which it may begin."""
        return _within(speed_mps, self._speeds_mps)

    def on_time(self, ego: EgoVehicle, start: EgoFirstState) -> EgoFirstState:
        """Return a start from which the policy, alone on the road, comes to its place when the program says."""
        if self.begins is not None or not self.later or not self.is_told:
            return start
        for _ in range(SHIFTS):
            there_m, speed_mps, _ = drives_alone(ego, start, _STEP_S, self.lead_s).state(self.lead_s)
            start = replace(start, s_m=max(0.0, start.s_m + self.later[0].place_m(EGO, speed_mps) - there_m))
        return start

    def is_past_something(self, start: EgoFirstState) -> bool:
        """Whether the ego would begin beyond a place, or nearer in time to one, that it is to come to later."""
        return any(c.value({EGO: (start.s_m, start.speed_mps)}) / c.weights[EGO][0] > 0.0 for c in self.later)


def told_speed_mps(scene: Scene, conditions: tuple[LinearCondition, ...]) -> float | None:
    """Return how fast the ego is at first where a number of the program says it."""
    first = {(EGO, scene.program.ego.sketch.knots[0])}
    told = (c for c in conditions if set(c.weights) == {EGO} and not c.weights[EGO][0] and c.moments == first)
    return next((-c.constant / c.weights[EGO][1] for c in told), None)


def drives_alone(ego: EgoVehicle, start: EgoFirstState, step_s: float, until_s: float = _ALONE_S) -> Profile:
    """Return how the policy drives from a start to the end of its road with nobody else there, if it does not fail."""
    ego.reset(start.s_m, start.speed_mps)
    segments, steps = list[Segment](), max(1, round(_STRETCH_S / step_s))
    with suppress(PolicyError):  # the run itself will tell
        for now_s in np.arange(0.0, until_s, steps * step_s).tolist():
            before, lasts_s = ego.state, min(steps * step_s, until_s - now_s)
            if before.s_m >= ego.route.path.length_m:
                break
            for step in range(steps):
                ego.advance(ego.decide(now_s + step * step_s, (), step_s), lasts_s / steps)
            accel_mpss = (ego.state.speed_mps - before.speed_mps) / lasts_s
            segments.append(Segment(now_s, lasts_s, before.s_m, before.speed_mps, accel_mpss))
    ended_s = segments[-1].end_s if segments else 0.0
    return Profile((*segments, Segment(ended_s, 0.0, ego.state.s_m, ego.state.speed_mps, 0.0)))


def usual_lead_s(
    scene: Scene, structure: Structure, limits: Mapping[int, Limits], conditions: tuple[LinearCondition, ...]
) -> float:
    """Return how long before it comes to its first place an ego begins: no hero has to wait until it sets off.

    A hero whose way to its trigger, from where it begins or its road does, is short would stand or creep on it; one
    that is told to begin far from it takes its time.
    """
    lead_s, least_s = _LEAD_S, _LEAST_LEAD_S
    for hero in scene.program.heroes:
        instant, sketch = structure.triggers.get(hero.id, frozenset()), hero.sketch
        own = [c for c in conditions if set(c.weights) == {hero.id}]
        placed = [c for c in own if c.weights[hero.id][0]]
        there = next((c for c in placed if c.moments <= instant), None)
        name = structure.trigger_knot(hero.id)
        if there is None or name is None or PieceKind.STOP in sketch.pieces[: sketch.knot_index(name)]:
            continue
        at_first = frozenset({(hero.id, sketch.knots[0])})
        told_mps = (-c.constant / c.weights[hero.id][1] for c in own if c not in placed and c.moments == at_first)
        speed_mps = max(MOVING_MPS, next(told_mps, limits[hero.id].natural_turn_speed_mps))
        begins = next((c for c in placed if c.moments == at_first), None)
        way_m = there.place_m(hero.id, speed_mps) - (0.0 if begins is None else begins.place_m(hero.id, speed_mps))
        lead_s = min(lead_s, way_m / speed_mps)
        if begins is not None:
            least_s = max(least_s, way_m / limits[hero.id].natural_approach_speed_mps)
    return max(least_s, lead_s)


def ego_starts(
    scene: Scene,
    ego: EgoVehicle,
    limits: Limits,
    conditions: tuple[LinearCondition, ...],
    lead_s: float = _LEAD_S,
) -> Iterator[EgoFirstState]:
    """Yield first states that meet the program's conditions at the ego's first knot.

    Where the policy leaves its speed to the orchestrator (``constant``), natural speeds first. Else what the policy
    holds by itself, then slower states by choice, from which it will speed up. At last the first that is nearer in time
    to a place than it is to be later: it may slow down. It begins `lead_s` before its first place, where the program
    does not say (see `usual_lead_s`).
    """
    way, past = _Way(scene, conditions, lead_s), list[EgoFirstState]()
    for start in (way.on_time(ego, start) for start in _possible_starts(ego, limits, way)):
        if way.is_past_something(start):
            past.append(replace(start, last_resort=True))
        else:
            yield start
    yield from past[:1]


def _possible_starts(ego: EgoVehicle, limits: Limits, way: _Way) -> Iterator[EgoFirstState]:
    """Yield states that meet the conditions at the ego's first knot, wherever that leads."""

    def driven(speed_mps: float) -> EgoFirstState:
        """Return the state of one that drives on from there by itself."""
        s_m = way.start_m(speed_mps)
        return EgoFirstState(s_m, speed_mps, _first_acceleration(ego, s_m, speed_mps))

    if way.speed_mps is not None:
        yield driven(way.speed_mps)
        return
    guess = way.start_m(limits.natural_turn_speed_mps)
    preferred = ego.policy.preferred_speed_mps(ego.start_at(max(0.0, guess), limits.natural_approach_speed_mps))
    holds_speed = ego.policy.envelope is not None and ego.policy.envelope.holds_speed
    if preferred is None and holds_speed:
        fastest = min(limits.turn_speed_max_mps, limits.approach_speed_max_mps)
        natural_mps = limits.natural_turn_speed_mps
        speeds_mps = (max(min(share * natural_mps, fastest), MOVING_MPS) for share in _SPEED_SHARES)
        for speed in dict.fromkeys(map(way.allowed_mps, speeds_mps)):
            yield EgoFirstState(way.start_m(speed), speed)
        return
    steady = _steady(ego, way, preferred or limits.natural_approach_speed_mps)
    if (speed := way.allowed_mps(steady.speed_mps)) != steady.speed_mps:
        yield driven(speed)
    else:  # a policy with moods begins a run in its first one, whatever mood it arrived in
        yield replace(steady, accel_mpss=_first_acceleration(ego, steady.s_m, speed))
    slower_mps = () if holds_speed else (max(share * speed, MOVING_MPS) for share in _SLOWER_SHARES)
    for slower in dict.fromkeys(map(way.allowed_mps, slower_mps)):  # one that holds its speed has one of its own
        if slower < speed:
            yield driven(slower)


def _steady(ego: EgoVehicle, way: _Way, speed_mps: float) -> EgoFirstState:
    """Let the policy drive alone towards where it is to start and take the state in which it gets there."""
    target = way.start_m(speed_mps)
    there = way.begins or LinearCondition("", frozenset(), -target, {EGO: (1.0, 0.0)})
    per_metre, per_speed = there.weights[EGO]
    run_up = min(3 * _RUN_UP_M if per_speed else _RUN_UP_M, target - 1.0)

    def states() -> Iterator[tuple[float, float]]:
        """Yield, step by step, its speed and a number that turns from negative to positive when it comes there."""
        ego.reset(target - run_up, speed_mps)
        for step in range(_MOST_STEPS):
            now = ego.state
            yield now.speed_mps, math.copysign(1.0, per_metre) * there.value({EGO: (now.s_m, now.speed_mps)})
            ego.advance(ego.decide(step * _STEP_S, (), _STEP_S), _STEP_S)

    for (last_mps, before), (now_mps, after) in pairwise(states()) if run_up >= 1.0 else ():
        if before < 0.0 <= after:
            speed = last_mps - before / (after - before) * (now_mps - last_mps)
            if speed < _SLOWEST_MPS:
                break
            return EgoFirstState(there.place_m(EGO, speed), speed)
    return EgoFirstState(target, speed_mps)


def _first_acceleration(ego: EgoVehicle, s_m: float, speed_mps: float) -> float:
    """Return what the policy does first from a state (m/s^2), alone on the road."""
    ego.reset(s_m, speed_mps)
    ego.decide(0.0, (), _STEP_S)
    return ego.state.accel_mps2
