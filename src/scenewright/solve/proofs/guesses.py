"""First guesses for a search: when moments are and where everybody is then, as far as the constraints tell at a glance.

What enters: events and constraints lowered over them. What leaves: a value for each unknown, which the search mends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import Atom, Formula, Unknown, conjuncts
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.order import tightened
from scenewright.solve.proofs.witness import Witness

Array = NDArray[np.float64]
# Between which everybody's speed lies, and how long pieces last; where somebody begins of whom no place is told.
# Chosen, as what is usual in town: a guess need not be possible.
_SPEED_MPS, _LASTS_S, _BEFORE_STOP_LINE_M = (3.0, 13.0), (1.0, 5.0), 60.0


def first_guess(events: Events, formulas: Sequence[Formula], generator: np.random.Generator | None) -> Array:
    """Return a guess, without a generator the plain one: everybody drives at one speed, past places that are told.

    Who is told no place is where it is told to be beside others.
    """
    ranges = tightened(events.unknowns, formulas)
    told = {number: 0.5 * float(each.low + each.high) for number, each in enumerate(ranges) if each.low == each.high}
    draw = (lambda low, high: 0.5 * (low + high)) if generator is None else generator.uniform
    speed = draw(*_SPEED_MPS)
    point = np.array([0.5 * float(each.low + each.high) if each.kind == "other" else 0.0 for each in events.unknowns])
    point[list(told)] = list(told.values())
    times = _times(events, ranges, point, speed, draw)
    point[[n for state in events.states.values() if (n := state.speed.number) not in told]] = speed
    places: dict[int, dict[int, float]] = {actor: {} for actor in events.scene.routes}  # of whom, and when (s)
    for (actor, instant), state in events.states.items():
        places[actor][state.place.number] = times[instant]
    anchors = {who: {at_s: told[n] for n, at_s in own.items() if n in told} for who, own in places.items()}
    told = told | {n: each for n, each in enumerate(point.tolist()) if events.unknowns[n].kind != "place"}
    equal = [part for part in conjuncts(formulas) if isinstance(part, Atom) and part.relation == "=="]
    for actor in sorted(anchors, key=lambda actor: not anchors[actor]):
        beside = anchors[actor] or _beside(places[actor], equal, told)
        if not beside:
            stop_line = events.scene.landmarks_m[actor].get("stop_line", 80.0)
            beside = {min(places[actor].values()): max(5.0, stop_line - _BEFORE_STOP_LINE_M)}
        for number, now_s in places[actor].items():
            if number not in told:
                since_s = min(beside, key=lambda at_s: abs(at_s - now_s))
                point[number] = beside[since_s] + speed * (now_s - since_s)
                told[number] = point[number]
    return point


def _beside(places: Mapping[int, float], equal: Iterable[Atom], told: Mapping[int, float]) -> dict[float, float]:
    """Return where somebody is at moments (s) of which a comparison with what is `told` says it."""
    found = dict[float, float]()
    for part in equal:
        free = {number for key in part.left.terms for number in key} - told.keys()
        if len(free) == 1 and (number := free.pop()) in places:
            at_zero, at_one = (part.left.value({**told, number: place_m}) for place_m in (0.0, 1.0))
            if at_one != at_zero:
                found[places[number]] = at_zero / (at_zero - at_one)
    return found


def _times(
    events: Events, ranges: Sequence[Unknown], point: Array, speed: float, draw: Callable[[float, float], float]
) -> dict[int, float]:
    """Guess when each moment is, within its range, and put it into `point`."""
    times = {number: float(value) for number, time in enumerate(events.times) if (value := time.constant) is not None}

    def put(instant: int, time_s: float) -> None:
        number = events.times[instant].number
        times[instant] = point[number] = min(max(time_s, float(ranges[number].low)), float(ranges[number].high))

    for actor in events.scene.program.actors:
        now, here_m = 0.0, 0.0
        for knot in (events.knot(actor.id, name) for name in actor.sketch.knots):
            there_m = float(point[events.state(actor.id, knot).place.number])  # zero where it is not told
            if knot not in times:
                put(knot, now + (max(0.5, (there_m - here_m) / speed) if here_m and there_m else draw(*_LASTS_S)))
            now, here_m = times[knot], there_m
    for instant, defined in events.defined.items():
        put(instant, max(0.0, defined.value(point)))
    last = max(times.values())
    for instant in range(len(events.times)):
        if instant not in times:
            put(instant, draw(0.0, last))
    return times


def carried_over(events: Events, point: Array, witness: Witness) -> Array:
    """Return `point` for events that have grown since: states at the new moments are those of the motions found."""
    grown = np.append(point, np.zeros(len(events.unknowns) - len(point)))
    for instant, time in enumerate(events.times):
        if time.constant is None and (number := time.number) >= len(point):
            defined = events.defined.get(instant)
            grown[number] = max(0.0, defined.value(grown)) if defined else witness.end_s
    for (actor, instant), state in events.states.items():
        if (number := state.place.number) >= len(point):
            place, speed, _ = witness.profiles[actor].state(events.times[instant].value(grown))
            grown[number], grown[state.speed.number] = place, speed
    return grown
