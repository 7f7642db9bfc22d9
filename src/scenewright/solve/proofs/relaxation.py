"""What a refutation rests on: formulas that every legal motion of the scenario satisfies.

What enters: events and lowered constraints. What leaves: named formulas. Leaving some out makes a proof harder to find,
never false; so nothing is assumed here that a legal motion could break: no comfort, no manner, no turn before it is
known to lie within the scenario.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.laws import Law, reach
from scenewright.program.types import EGO
from scenewright.solve.proofs.events import Events, Stretch
from scenewright.solve.proofs.narrowing import Narrowing
from scenewright.solve.proofs.order import least_differences, places_within
from scenewright.solve.proofs.polynomials import (
    FALSE,
    TRUE,
    ZERO,
    Formula,
    Named,
    atom,
    compare,
    every,
    some,
)
from scenewright.translate.phrases import does

_CERTAIN = 1e-9


def relaxation(events: Events, narrowings: Sequence[Narrowing], constraints: Sequence[Named]) -> list[Named]:
    """Return all that must hold of any motion; of `narrowings` what is proven of them."""
    found = [*constraints, *events.rules]
    formulas = [each.formula for each in constraints]
    least, within = least_differences(events, formulas), places_within(events, formulas)
    narrowings = [each for each in narrowings if not each.up_to_place or _begins_before(each, within)]
    found += _order_of_knots(events)
    for actor in events.scene.program.actors:
        if not (actor.is_ego and events.drive is not None):  # how it drove is a fact
            found += _motion(events, narrowings, actor.id, least)
    return [each for each in found if each.formula != TRUE]


def _begins_before(narrowing: Narrowing, within: Mapping[tuple[int, int], tuple[Fraction, Fraction]]) -> bool:
    """Whether what holds up to a place begins before it for certain: else it may hold of no time at all."""
    begins = within.get((narrowing.actor, narrowing.first))
    return begins is not None and begins[1] < narrowing.place_m


def _order_of_knots(events: Events) -> Iterator[Named]:
    for actor in events.scene.program.actors:
        knots = [events.knot(actor.id, name) for name in actor.sketch.knots]
        for early, late in pairwise(knots):
            formula = compare("<=", events.times[early], events.times[late])
            yield Named(formula, f"the knots of {actor.name} come one after another")


def _motion(events: Events, narrowings: Sequence[Narrowing], actor: int, least: NDArray[np.float64]) -> Iterator[Named]:
    """Yield the law of the stretch between each two moments of an actor that may lie in one."""
    name = events.scene.program.actor(actor).name
    instants = events.instants_of(actor)
    for stretch in events.stretches[actor]:
        origin = f"while {name} {does(stretch.kind)}, it {stretch.law.words()}"
        if actor == EGO:
            origin = events.ego.words(name)
        inside = [instant for instant in instants if _possibly_inside(stretch, instant, least)]
        for early in inside:
            for late in inside:
                if early == late or least[late, early] > _CERTAIN:
                    continue
                if _parted(inside, early, late, least):
                    continue
                law, besides = _narrowed(narrowings, actor, stretch.law, early, late, least)
                yield Named(_between(events, actor, stretch, early, late, law, least), origin, besides)


def _possibly_inside(stretch: Stretch, instant: int, least: NDArray[np.float64]) -> bool:
    """Whether an instant is not certain to be before or after a stretch."""
    before = least[instant, stretch.first] > _CERTAIN
    after = stretch.last is not None and least[stretch.last, instant] > _CERTAIN
    return not before and not after


def _parted(inside: list[int], early: int, late: int, least: NDArray[np.float64]) -> bool:
    """Whether a third moment lies between for certain: where both are in the stretch the laws on either side say it."""
    for middle in inside:
        if middle in (early, late):
            continue
        if least[early, middle] >= 0 and least[middle, late] >= 0:
            tied = least[middle, early] >= 0 or least[late, middle] >= 0
            if not tied or middle < max(early, late):
                return True
    return False


def _narrowed(
    narrowings: Sequence[Narrowing], actor: int, law: Law, early: int, late: int, least: NDArray[np.float64]
) -> tuple[Law, tuple[str, ...]]:
    """Return the law between two moments, made narrower by what holds between them for certain, and who says so."""
    origins = []
    for narrowing in narrowings:
        if narrowing.actor != actor or narrowing.proven is None:
            continue
        begun = all(least[instant, early] >= 0 for instant in narrowing.begins())
        if begun and all(least[late, instant] >= 0 for instant in narrowing.ends()):
            law = law.meet(narrowing.proven)
            origins.append(narrowing.origin)
    return law, tuple(dict.fromkeys(origins))


def _between(
    events: Events, actor: int, stretch: Stretch, early: int, late: int, law: Law, least: NDArray[np.float64]
) -> Formula:
    """Return the reach of a law between two moments, unless they come the other way round or lie outside."""
    times, unless = events.times, []
    for instant in (early, late):
        if least[stretch.first, instant] < 0:
            unless.append(compare("<", times[instant], times[stretch.first]))
        if stretch.last is not None and least[instant, stretch.last] < 0:
            unless.append(compare(">", times[instant], times[stretch.last]))
    if least[early, late] < 0:
        unless.append(compare("<", times[late], times[early]))
    return some([*unless, reach_formula(events, actor, early, late, law)])


def reach_formula(events: Events, actor: int, early: int, late: int, law: Law) -> Formula:
    """Return the exact conditions on the states at two moments between which an actor obeys `law`."""
    a, b = events.state(actor, early), events.state(actor, late)
    lasts = events.times[late] - events.times[early]
    found = reach(law, a.speed, b.speed, lasts, b.place - a.place)
    if found.impossible:
        return FALSE
    caps: list[Formula] = []
    free = events.law_of(actor)
    for speed in (a.speed, b.speed):
        if law.speed_high < free.speed_high:
            caps.append(compare("<=", speed, law.speed_high))
        if law.speed_low > ZERO:
            caps.append(compare(">=", speed, law.speed_low))
    return every(
        [
            *caps,
            *(atom(row, "<=") for row in found.rows),
            *(atom(row, "==") for row in found.equal),
            *(some([atom(one, "<="), atom(other, "<=")]) for one, other in found.choices),
        ]
    )
