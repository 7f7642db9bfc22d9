"""What is certain of the order of moments, and between which values unknowns are, as far as that can be read off.

What enters: events, and formulas that hold. What leaves: how much later each moment is at least than another; ranges.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import ZERO, Atom, Formula, Polynomial, Unknown, conjuncts
from scenewright.program.magnitudes import LONGEST_S
from scenewright.solve.proofs.events import Events

Array = NDArray[np.float64]
_PASSES = 2  # over all comparisons, to see between which places somebody is: enough for one that rests on another


def linear_of(formulas: Iterable[Formula]) -> list[Atom]:
    """Return the linear comparisons that hold in every case."""
    return [part for part in conjuncts(formulas) if isinstance(part, Atom) and part.left.degree == 1]


# -- ranges -----------------------------------------------------------------------------------------------------------
def tightened(unknowns: Sequence[Unknown], formulas: Iterable[Formula], passes: int = 1) -> list[Unknown]:
    """Return the unknowns with the ranges that linear comparisons leave."""
    found = list(unknowns)
    linear = linear_of(formulas)
    for _ in range(passes):
        for part in linear:
            _narrow(part.left, found)
            if part.relation == "==":
                _narrow(-part.left, found)
    return found


def _narrow(left: Polynomial, found: list[Unknown]) -> None:
    """Narrow the ranges of unknowns by ``left <= 0``."""
    least = least_value(left, found)
    for number, factor in [(key[0], factor) for key, factor in left.terms.items() if key]:
        each = found[number]
        bound = (each.low if factor > 0 else each.high) - least / factor
        if factor > 0 and bound < each.high:
            found[number] = replace(each, high=bound)
        elif factor < 0 and bound > each.low:
            found[number] = replace(each, low=bound)


def least_value(left: Polynomial, unknowns: Sequence[Unknown]) -> Fraction:
    """Return the least that a linear polynomial can be."""
    least = left.terms.get((), ZERO)
    for key, factor in left.terms.items():
        if key:
            least += factor * (unknowns[key[0]].low if factor > 0 else unknowns[key[0]].high)
    return least


# -- order ------------------------------------------------------------------------------------------------------------
def least_differences(events: Events, formulas: Iterable[Formula] = ()) -> Array:
    """Return a matrix of how much later (s) each instant (column) is at least than another (row).

    Comparisons of two times say it, and so do places that are known. Where that contradicts itself only what holds
    without them is in it: the contradiction is for a proof.
    """
    linear = linear_of(formulas)
    least = _closed(events, [*_told(events, linear), *_by_places(events, linear)])
    return least if not np.any(np.diag(least) > 1e-9) else _closed(events, [])


def _closed(events: Events, ahead: Iterable[tuple[int, int, Fraction]]) -> Array:
    constants = {
        number: float(known) for number, time in enumerate(events.times) if (known := time.constant) is not None
    }
    least = np.full((len(events.times),) * 2, -max(float(LONGEST_S), *constants.values()))
    np.fill_diagonal(least, 0.0)
    least[events.start, :] = 0.0
    for first, second, least_s in [*((*pair, ZERO) for pair in events.ahead), *ahead]:
        least[first, second] = max(least[first, second], float(least_s))
    for first, second in permutations(constants, 2):
        least[first, second] = constants[second] - constants[first]
    return closed(least)


def closed(least: Array) -> Array:
    """Return what least differences come to one after another."""
    for middle in range(len(least)):
        np.maximum(least, least[:, middle, None] + least[None, middle, :], out=least)
    return least


def _told(events: Events, linear: Iterable[Atom]) -> Iterator[tuple[int, int, Fraction]]:
    """Yield what is said of two times, or of one that is counted from the start."""
    instants = {time.number: instant for instant, time in enumerate(events.times) if time.constant is None}
    for part in linear:
        factors = {instants.get(key[0]): factor for key, factor in part.left.terms.items() if key}
        if len(factors) == 1:
            factors[events.start] = -next(iter(factors.values()))
        (early, _), (late, size) = sorted(factors.items(), key=lambda item: item[1])[:: len(factors) - 1]
        if early is None or late is None or len(factors) > 2 or sum(factors.values()) != 0:
            continue
        most_s = -part.left.terms.get((), ZERO) / size
        yield late, early, -most_s
        if part.relation == "==":
            yield early, late, most_s


def _by_places(events: Events, linear: Sequence[Atom]) -> Iterator[tuple[int, int, Fraction]]:
    """Yield what follows from where everybody is: nobody drives backwards, nor faster than it can."""
    within = places_within(events, linear)
    passing = {(actor, made) for (actor, _), made in events.places.items()}
    known = {key: ends for key, ends in within.items() if key not in passing}
    for (actor, place), made in events.places.items():
        before = [k for (owner, k), (_, high) in known.items() if owner == actor and high < place]
        after = [k for (owner, k), (low, _) in known.items() if owner == actor and low > place]
        if before and after:
            known[actor, made] = place, place
        yield from ((knot, made, ZERO) for knot in before)  # the end where it is never passed
        yield from ((made, knot, ZERO) for knot in after)  # the start where it was passed before
    for (actor, first), (_, most) in known.items():
        fastest = events.law_of(actor).speed_high
        for (other, second), (least, _) in known.items():
            if actor == other and most < least:
                # One that never moves comes nowhere: the laws refute that, whatever the order.
                yield first, second, (least - most) / fastest if fastest else ZERO


def places_within(events: Events, formulas: Iterable[Formula]) -> dict[tuple[int, int], tuple[Fraction, Fraction]]:
    """Return between which places (m) everybody is at each instant, as far as linear comparisons say it."""
    found = tightened(events.unknowns, formulas, _PASSES)
    ranges = {key: found[state.place.number] for key, state in events.states.items() if state.place.constant is None}
    return {key: (each.low, each.high) for key, each in ranges.items()}
