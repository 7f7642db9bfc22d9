"""How fast a bend can be driven, and how soon somebody can be past it, from wherever it is and however fast.

What enters: events, and what is asked. What leaves: formulas. How long the fastest drive from one state takes is plain
arithmetic; as a function of the state it is told by planes below it, which refute at once what no solver found without.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import Formula, Named, compare, some
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.order import places_within
from scenewright.solve.proofs.witness import bends
from scenewright.units import pin

Array = NDArray[np.float64]
# How many places and speeds somebody may begin from are looked at, of which every so many-th has a plane, and how far
# apart the places of a drive are (m); chosen: a plane is below the least time whatever they are.
_STARTS, _EVERY, _STEP_M = 241, 40, 0.25
# Rounding of curves, of places and speeds in them, and of times (s).
_SURELY, _ROUNDED_S = 0.999, 1e-3
# Of how sharp a bend is where it is sharpest: each has its part of the bend; chosen.
SHARES = (0.985, 0.8, 0.6, 0.4, 0.2)


def in_bend(events: Events, actor: int, peak: int, *, planned: bool) -> Iterator[Named]:
    """Yield how fast each part of the bend around one place of a route may be driven, at each moment of an actor.

    For proofs the least bend of a part counts, so that every legal motion keeps to it; where it is `planned` a sharper
    one, so that what keeps to it is legal.
    """
    sharpness, most_mpss = bends(events.scene.routes[actor])[1], events.limits[actor].lateral_max_mpss
    for sharper, share in pairwise((1.0, *SHARES)):
        counts = (sharper if planned else share) * float(sharpness[peak])
        if most_mpss >= counts * float(events.law_of(actor).speed_high) ** 2:
            break
        first_m, last_m = ends_of_bend(events, actor, peak, share)
        most = pin(math.sqrt(most_mpss / counts) * (_SURELY if planned else 1 / _SURELY))
        for state in (events.state(actor, instant) for instant in events.instants_of(actor)):
            elsewhere = [compare("<", state.place, first_m), compare(">", state.place, last_m)]
            yield Named(some([*elsewhere, compare("<=", state.speed, most)]), _words(events, actor))


def bound_in_bend(events: Events, actor: int, asked: Sequence[Formula]) -> None:
    """Say for proofs how fast the sharpest bend of a route can be driven, and how soon one can be past it.

    One who surely drives through it, by what is `asked`, has a moment there.
    """
    places_m, sharpness = bends(events.scene.routes[actor])
    peak, times, top_mps = int(np.argmax(sharpness)), events.times, float(events.law_of(actor).speed_high)
    within = {instant: ends for (owner, instant), ends in places_within(events, asked).items() if owner == actor}
    through = [(a, b) for a, b in product(within, repeat=2) if within[a][1] < places_m[peak] < within[b][0]]
    if events.limits[actor].lateral_max_mpss < sharpness[peak] * top_mps**2:
        for early, late in through:
            state = events.state(actor, early)
            for per_m, per_mps, rest_s in _planes(events, actor, *map(float, (*within[early], within[late][0]))):
                least_s = state.place * pin(per_m) + state.speed * pin(per_mps) + pin(rest_s)
                events.rules.append(Named(compare(">=", times[late] - times[early], least_s), _words(events, actor)))
    if through:
        events.at_place(actor, pin(float(places_m[peak])))
    events.rules += in_bend(events, actor, peak, planned=False)


def _words(events: Events, actor: int) -> str:
    most_mpss = events.limits[actor].lateral_max_mpss
    return f"{events.scene.program.actor(actor).name} takes bends at {most_mpss:.3g} m/s^2 sideways at most"


def around(sharpness: Array, place: int, share: float) -> range:
    """Return the places around one at which a route bends by at least a share of what it does there."""
    softer = np.flatnonzero(sharpness < share * sharpness[place])
    begin, end = softer[softer < place].max(initial=-1) + 1, softer[softer > place].min(initial=len(sharpness))
    return range(int(begin), int(end))


def ends_of_bend(events: Events, actor: int, peak: int, share: float) -> tuple[Fraction, Fraction]:
    """Return where (m) the part of a bend begins and ends in which it is at least a share as sharp as at its peak."""
    places_m, sharpness = bends(events.scene.routes[actor])
    part = around(sharpness, peak, share)
    return pin(float(places_m[part[0]])), pin(float(places_m[part[-1]]))


def _planes(
    events: Events, actor: int, first_m: float, last_m: float, there_m: float
) -> Iterator[tuple[float, float, float]]:
    """Yield planes below the least time (s) to a place, from places between two others, over place and speed.

    Who starts further on, and faster, is there sooner: so long it takes at least from anywhere before.
    """
    begins_m = np.linspace(first_m, last_m, _STARTS)[:, None]
    speeds_mps = np.linspace(0.0, float(events.law_of(actor).speed_high), _STARTS)[None, :]
    least_s = _least_s(events, actor, begins_m, speeds_mps, there_m)
    least_s[:-1, :-1], least_s[-1, :-1], least_s[:-1, -1] = least_s[1:, 1:], least_s[-1, 1:], least_s[1:, -1]
    slopes = [
        np.gradient(least_s, axis=axis) / max(np.ptp(values) / (_STARTS - 1), _ROUNDED_S)
        for axis, values in enumerate((begins_m, speeds_mps))
    ]
    some = range(0, _STARTS, _EVERY)
    for per_m, per_mps in {tuple(round(float(slope[at]), 4) for slope in slopes) for at in product(some, repeat=2)}:
        yield per_m, per_mps, float(np.min(least_s - per_m * begins_m - per_mps * speeds_mps)) - _ROUNDED_S


def _least_s(events: Events, actor: int, begins_m: Array, speeds_mps: Array, there_m: float) -> Array:
    """Return the time (s) of the fastest drive to a place, from places and speeds; who is too fast slows down at once.

    It gains speed until it meets the fastest that anybody can be; from there on all drive alike. What is in front of
    the last place to begin from is left out.
    """
    law, (places_m, sharpness) = events.law_of(actor), bends(events.scene.routes[actor])
    gains, brakes = 2.0 * float(law.rate_high), -2.0 * float(law.rate_low)
    along_m = np.append(np.arange(begins_m.min(), there_m, _STEP_M), there_m)
    bend = np.minimum(np.minimum(sharpness, np.roll(sharpness, 1)), np.roll(sharpness, -1))
    squares = events.limits[actor].lateral_max_mpss / np.maximum(np.interp(along_m, places_m, bend), 1e-9) / _SURELY
    squares = np.minimum(np.where(along_m > begins_m.max(), squares, np.inf), float(law.speed_high) ** 2)
    squares = np.minimum.accumulate((squares + brakes * along_m)[::-1])[::-1] - brakes * along_m
    left = np.minimum.accumulate(squares - gains * along_m)  # what one that meets it there has before it gains
    top_mps = np.sqrt(left + gains * along_m)
    rest_s = np.append(0.0, np.cumsum((2.0 * np.diff(along_m) / (top_mps[1:] + top_mps[:-1]))[::-1]))[::-1]
    speeds_mps = np.minimum(speeds_mps, np.interp(begins_m, along_m, top_mps))
    free = speeds_mps**2 - gains * begins_m
    meets = np.minimum(np.searchsorted(-left, -free), len(along_m) - 1)
    gaining_s = (np.sqrt(free + gains * along_m[meets]) - speeds_mps) / (0.5 * gains)
    return np.asarray(gaining_s + rest_s[meets])
