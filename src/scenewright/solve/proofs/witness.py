"""Makes a motion of what a search found, and looks whether it is one: the only thing that is called feasible.

What enters: values of all unknowns. What leaves: a profile for each actor, and what is amiss with them. It shares no
code with the lowering, so a wrong lowering is found out here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.laws import Law, realise
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.program.evaluate import violation
from scenewright.program.structure import Structure, placed_at
from scenewright.program.types import EGO
from scenewright.roads.bodies import CAR, Body
from scenewright.roads.grounding import Scene
from scenewright.roads.routes import Route
from scenewright.roads.zones import overlap
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.search import Search

Array = NDArray[np.float64]
_TOLERANCE = 2e-3  # mm, ms, mm/s: twice what a search is exact to
_STEP_S = 0.05
_OFTEN_S = 0.02  # two that meet head on come 0.5 m nearer meanwhile
_BEND_STEP_M = 0.25
_RATE_SLACK = 1e-2
_SHORTEST_S = 1e-4  # in so short a time a rounded speed makes any rate


@dataclass(frozen=True, slots=True)
class Broken:
    """Something amiss: a constraint's id, ``law``, ``turn`` or ``apart``; whose, when (s), how much (SI); from whom."""

    what: str
    actor: int
    time_s: float
    by: float
    other: int = EGO


@dataclass(frozen=True, slots=True)
class Witness:
    """A motion of everybody with which all that was asked for happens."""

    profiles: Mapping[int, Profile]
    parameters: Mapping[str, float]
    times_s: Mapping[int, float]
    end_s: float


def realised(events: Events, search: Search, point: Array) -> Witness:
    """Return the motion that the values at `point` stand for."""
    times = {number: time.value(point) for number, time in enumerate(events.times)}
    profiles = {each.id: _profile(events, search, point, each.id, times) for each in events.scene.program.actors}
    parameters = {name: value.value(point) for name, value in events.parameters.items()}
    return Witness(profiles, parameters, times, max(times[k] for _, k in events.states))


def _profile(events: Events, search: Search, point: Array, actor: int, times: Mapping[int, float]) -> Profile:
    order, laws = search.way_of(point, actor)
    knots = {name: times[events.knot(actor, name)] for name in events.scene.program.actor(actor).sketch.knots}
    pieces = sorted(knots.values())
    states = ((times[k], events.state(actor, k)) for k in order)
    ends = [(time_s, state.place.value(point), state.speed.value(point)) for time_s, state in states]
    segments: list[Segment] = []
    for law, ((now, place, speed), (then, end, after)) in zip(laws, pairwise(ends), strict=True):
        piece = max(0, min(sum(t <= now + 1e-9 for t in pieces) - 1, len(pieces) - 2))
        for duration, rate in realise(law, speed, after, then - now, end - place):
            if duration < _SHORTEST_S:
                rate = min(max(rate, float(law.rate_low)), float(law.rate_high))
            if duration > 1e-12:
                made = Segment(now, duration, place, speed, rate, piece)
                segments.append(made)
                now, place, speed = made.end_s, made.end_s_m, made.end_speed_mps
    return Profile(tuple(segments or [Segment(0.0, 0.0, *ends[0][1:], 0.0)]), knots)


def broken(
    scene: Scene, structure: Structure, limits: Mapping[int, Limits], ego: EgoBounds, witness: Witness
) -> list[Broken]:
    """Return all that is amiss with a motion."""
    world = PlanWorld(scene, witness.profiles, witness.parameters)
    found = [
        Broken(constraint.id, EGO, math.nan, by)
        for constraint in scene.program.constraints
        if not (by := violation(constraint.formula, world)) <= _TOLERANCE
    ]
    for actor, profile in witness.profiles.items():
        found += _unlawful(actor, profile, ego.law() if actor == EGO else limits[actor].law())
    times = np.arange(0.0, witness.end_s + _STEP_S, _STEP_S)
    states = {actor: np.array([each.state(float(t)) for t in times]) for actor, each in witness.profiles.items()}
    for hero in scene.program.heroes:
        during = times <= witness.profiles[hero.id].end_s
        found += _too_fast(scene, limits[hero.id], hero.id, times[during], states[hero.id][during])
    return found + _touching(scene, structure, witness, times, states)


def _unlawful(actor: int, profile: Profile, law: Law) -> list[Broken]:
    """Return where a motion jumps, or does what nobody like that can do."""
    for segment in profile.segments:
        if not law.admits(segment.speed_mps, [(segment.duration_s, segment.accel_mpss)], slack=_RATE_SLACK):
            return [Broken("law", actor, segment.start_s, abs(segment.accel_mpss))]
    for before, after in pairwise(profile.segments):
        jump = max(abs(after.s_m - before.end_s_m), abs(after.speed_mps - before.end_speed_mps))
        if jump > _TOLERANCE:
            return [Broken("law", actor, after.start_s, jump)]
    return []


def _too_fast(scene: Scene, limits: Limits, actor: int, times: Array, states: Array) -> list[Broken]:
    often = np.arange(times[0], times[-1], _OFTEN_S)
    place, speed = (np.interp(often, times, states[:, order]) for order in (0, 1))
    sideways = speed**2 * np.interp(place, *bends(scene.routes[actor]))
    worst = int(np.argmax(sideways)) if len(often) else 0
    over = float(sideways[worst]) - limits.lateral_max_mpss if len(often) else 0.0
    return [Broken("turn", actor, float(often[worst]), over)] if over > 1e-3 else []


@lru_cache(maxsize=256)
def bends(route: Route) -> tuple[Array, Array]:
    """Return places (m) along a route, and how much it bends there (1/m)."""
    places = np.arange(0.0, route.path.length_m, _BEND_STEP_M)
    return places, np.abs(route.path.curvatures(places))


def _touching(
    scene: Scene, structure: Structure, witness: Witness, times: Array, states: Mapping[int, Array]
) -> list[Broken]:
    """Return pairs whose boxes touch before the last trigger."""
    found, triggers = [], []
    for hero in scene.program.heroes:  # who has no trigger may touch nobody at all
        knot = structure.trigger_knot(hero.id)
        triggers.append(witness.end_s if knot is None else witness.profiles[hero.id].knot_times_s.get(knot, 0.0))
    until = max(triggers, default=witness.end_s)
    often = np.append(np.arange(0.0, until, _OFTEN_S), until)
    clear_m = float(scene.program.manner.clear_m)
    boxes, body = {}, Body(CAR.length_m + clear_m, CAR.width_m + clear_m)
    for actor in scene.program.actors:
        places = np.interp(often, times, states[actor.id][:, 0])
        boxes[actor.id] = scene.routes[actor.id].path.poses(places)
    for a, b in combinations(sorted(boxes), 2):
        touch = overlap(boxes[a], boxes[b], body, body)
        if touch.any() and not _asked_for(scene, structure, witness, (a, b), often[touch]):
            apart = np.hypot(*(boxes[a] - boxes[b]).T[:2])
            deepest = int(np.argmin(np.where(touch, apart, np.inf)))
            found.append(Broken("apart", b, float(often[deepest]), 1.0, a))
    return found


def _asked_for(scene: Scene, structure: Structure, witness: Witness, pair: tuple[int, int], touching_s: Array) -> bool:
    """Whether a trigger puts two into each other, and they touch but once before it, and at it still."""
    for trigger in structure.triggers.values():
        if set(pair) <= placed_at(scene.program, trigger):
            owner, knot = min(trigger)
            until = witness.profiles[owner].knot_times_s.get(knot, math.inf)
            before = touching_s[touching_s <= until]
            if len(before) and before[-1] > until - _OFTEN_S and np.all(np.diff(before) < 1.5 * _OFTEN_S):
                return True
    return False
