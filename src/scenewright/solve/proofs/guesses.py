"""First guesses for a search: when moments are and where everybody is then, as far as the constraints tell at a glance.

What enters: events and constraints lowered over them. What leaves: a value for each unknown. A guess need not be
possible: the search mends it. Later guesses are drawn, not made.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scenewright.solve.proofs.events import Events, Unknown
from scenewright.solve.proofs.order import tightened, told_values
from scenewright.solve.proofs.polynomials import Formula
from scenewright.solve.proofs.witness import Witness

Array = NDArray[np.float64]
_SPEED_MPS, _GAP_S, _LATER_S = 8.0, 3.0, 4.0


def first_guess(events: Events, formulas: Iterable[Formula], generator: np.random.Generator | None) -> Array:
    """Return a guess; without a generator the plain one: everybody drives at one speed from place to place."""
    ranges = tightened(events.unknowns, formulas)
    told = told_values(ranges)
    speed = _SPEED_MPS if generator is None else float(generator.uniform(3.0, 13.0))
    point = np.array([0.5 * float(each.low + each.high) if each.kind == "other" else 0.0 for each in events.unknowns])
    for number, value in told.items():
        point[number] = value
    times = _times(events, ranges, told, point, speed, generator)
    for actor in events.scene.program.actors:
        instants = sorted(events.instants_of(actor.id), key=times.__getitem__)
        anchors = [
            (times[k], told[number]) for k in instants if (number := events.state(actor.id, k).place.number) in told
        ] or [(times[instants[0]], max(5.0, events.scene.landmarks_m[actor.id].get("stop_line", 80.0) - 60.0))]
        for instant in instants:
            state = events.state(actor.id, instant)
            place, own = state.place.number, state.speed.number
            if place not in told:
                time_s, place_m = min(anchors, key=lambda anchor: abs(anchor[0] - times[instant]))
                point[place] = place_m + speed * (times[instant] - time_s)
            if own not in told:
                point[own] = speed
    return point


def _times(
    events: Events,
    ranges: Sequence[Unknown],
    told: Mapping[int, float],
    point: Array,
    speed: float,
    generator: np.random.Generator | None,
) -> dict[int, float]:
    """Guess when each moment is, within its range, and put it into `point`."""
    times = {number: float(value) for number, time in enumerate(events.times) if (value := time.constant) is not None}

    def put(instant: int, time_s: float) -> None:
        number = events.times[instant].number
        times[instant] = point[number] = min(max(time_s, float(ranges[number].low)), float(ranges[number].high))

    for actor in events.scene.program.actors:
        knots = [events.knot(actor.id, name) for name in actor.sketch.knots]
        now = 0.0
        for before, knot in zip([knots[0], *knots], knots, strict=False):
            if knot in times:
                now = max(now, times[knot])
                continue
            here, there = (told.get(events.state(actor.id, k).place.number) for k in (before, knot))
            later = _GAP_S if generator is None else float(generator.uniform(1.0, 6.0))
            now += later if here is None or there is None else max(0.5, (there - here) / speed)
            put(knot, now)
            now = times[knot]
    for instant, defined in events.defined.items():
        put(instant, max(0.0, defined.value(point)))
    for instant in range(len(events.times)):
        if instant not in times:
            put(instant, _within_a_piece(events, instant, times, generator))
    return times


def _within_a_piece(
    events: Events, instant: int, times: Mapping[int, float], generator: np.random.Generator | None
) -> float:
    """Guess a moment of which only who it is about is known: within some piece of theirs."""
    actors = [actor for actor, k in events.states if k == instant]
    if not actors or generator is None:
        return _LATER_S
    sketch = events.scene.program.actor(actors[0]).sketch
    knots = sorted({times[events.knot(actors[0], name)] for name in sketch.knots})
    number = int(generator.integers(max(1, len(knots) - 1)))
    return float(generator.uniform(knots[number], knots[number + 1])) if len(knots) > 1 else _LATER_S


def carried_over(events: Events, point: Array, witness: Witness) -> Array:
    """Return `point` for events that have grown since: states at the new moments are those of the motions found."""
    grown = np.append(point, np.zeros(len(events.unknowns) - len(point)))
    passed = {instant: witness.profiles[actor].time_at(float(p)) for (actor, p), instant in events.places.items()}
    for instant, time in enumerate(events.times):
        if time.constant is None and (number := time.number) >= len(point):
            defined, time_s = events.defined.get(instant), passed.get(instant)
            grown[number] = max(0.0, defined.value(grown)) if defined else min(time_s or witness.end_s, witness.end_s)
    for (actor, instant), state in events.states.items():
        if (number := state.place.number) >= len(point):
            place, speed, _ = witness.profiles[actor].state(events.times[instant].value(grown))
            grown[number], grown[state.speed.number] = place, speed
    return grown
