"""How soon somebody can be past a bend, from wherever it is and however fast: what a proof may rest on.

What enters: events, and what is asked. What leaves: linear formulas that every legal motion satisfies. The fastest
drive from one state is plain arithmetic; as a function of the state its least time is told by planes below it. They
refute at once what no solver found from the laws at moments within the bend.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import product

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import Named, compare
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.witness import bends
from scenewright.units import pin

Array = NDArray[np.float64]
# How many places and speeds somebody may begin from are looked at, of which every so many-th has a plane, and how far
# apart the places of a drive are (m).
_STARTS, _EVERY, _STEP_M = 241, 40, 0.25
# Rounding of curves, and of times (s).
_SURELY, _ROUNDED_S = 0.999, 1e-3


def past_bends(events: Events, actor: int, within: Mapping[int, tuple[Fraction, Fraction]]) -> Iterator[Named]:
    """Yield how much later than at any moment before the sharpest bend of its route an actor is past it.

    `within` says between which places (m) it is at each instant.
    """
    places_m, sharpness = bends(events.scene.routes[actor])
    peak_m, times, most_mpss = places_m[np.argmax(sharpness)], events.times, events.limits[actor].lateral_max_mpss
    if most_mpss >= sharpness.max() * float(events.law_of(actor).speed_high) ** 2:
        return
    words = f"{events.scene.program.actor(actor).name} takes bends at {most_mpss:.3g} m/s^2 sideways at most"
    for (early, (first_m, last_m)), (late, (there_m, _)) in product(within.items(), repeat=2):
        if last_m < peak_m < there_m:
            state = events.state(actor, early)
            for per_m, per_mps, rest_s in _planes(events, actor, float(first_m), float(last_m), float(there_m)):
                least_s = state.place * pin(per_m) + state.speed * pin(per_mps) + pin(rest_s)
                yield Named(compare(">=", times[late] - times[early], least_s), words)


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
