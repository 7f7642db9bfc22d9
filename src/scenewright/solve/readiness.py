"""A hero that is ready: in time if the ego suddenly makes haste, and not too far on if it stops.

What enters: a situation, a style, where a hero is at some moment on its way to its trigger. What leaves: linear
conditions.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from scenewright.motion.algebra import Condition, Symbol, compare, pin
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.limits import Style
from scenewright.solve.situation import Situation

# How a hero follows an ego that makes haste: not at once, and with some reserve.
_REACTION_S, _HASTE_MPSS = 0.1, 3.2
# How it stops short of its place, and at which speeds the way that this takes is exact.
_STOPS_MPSS, _CHORDS_MPS = 5.0, (0, 3, 6, 10, 15, 22)


def readiness(
    situation: Situation,
    style: Style,
    side: LinearCondition | None,
    hero: int,
    now_s: float,
    position: Symbol,
    speed: Symbol,
) -> Iterator[tuple[Condition, str]]:
    """Yield what it takes to be ready at `now_s`, with why; nothing where the style does not ask for it.

    Parameters
    ----------
    side
        The hero's side of its trigger.
    position, speed
        Of the hero at `now_s`.
    """
    earliest = situation.earliest_s.get(hero)
    if style.waiting_place_m is None or not earliest or side is None:
        return
    arrival_s = float(np.interp(now_s, [pair[0] for pair in earliest], [pair[1] for pair in earliest]))
    rest = pin(max(0.0, arrival_s - now_s - _REACTION_S))
    per_metre, per_speed = (pin(abs(weight)) for weight in side.weights[hero])
    sign = 1 if side.weights[hero][0] > 0 else -1
    rate = pin(_HASTE_MPSS)
    place = position + speed * rest + rate * rest * rest / 2
    value = sign * pin(side.constant) + per_metre * place + per_speed * (speed + rate * rest)
    yield compare(">=", value, 0), "is ready for an ego in haste"
    if now_s > situation.trigger_s[hero] - style.sets_off_s:
        return  # it is on its way, whatever happens
    # The way to a stand, by chords of the square of the speed.
    latest = pin(style.waiting_place_m)
    for low, high in pairwise(_CHORDS_MPS):
        stop = ((low + high) * speed - low * high) * pin(0.5 / _STOPS_MPSS)
        yield compare("<=", position + stop, latest), "is ready for an ego that stops"
