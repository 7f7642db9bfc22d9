"""What a refutation rests on: formulas that every legal motion of the scenario satisfies.

What enters: events and lowered constraints. What leaves: named formulas. Leaving some out makes a proof harder to find,
never false; so nothing is assumed here that a legal motion could break.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import pairwise, permutations

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import FALSE, TRUE, ZERO, Formula, Named, atom, compare, every, some
from scenewright.motion.laws import Law, reach
from scenewright.program.types import EGO
from scenewright.solve.proofs.events import Events, Narrowing
from scenewright.solve.proofs.forms import TIGHT
from scenewright.solve.proofs.order import least_differences, places_within

EVEN_RATE = "a rate that is told of a piece lasts all through it, but for a moment at either end"
_CERTAIN = 1e-9


def relaxation(events: Events, narrowings: Sequence[Narrowing], constraints: Sequence[Named]) -> list[Named]:
    """Return all that must hold of any motion; of `narrowings` what is proven of them."""
    found = [*constraints, *events.rules]
    formulas = [each.formula for each in constraints]
    least, within = least_differences(events, formulas), places_within(events, formulas)
    # What holds up to a place may hold of no time at all, unless it begins before that for certain.
    latest = ((each, within.get((each.actor, each.first), (ZERO, each.place_m))[1]) for each in narrowings)
    narrowings = [each for each, latest_m in latest if not each.up_to_place or latest_m < each.place_m]
    for actor in events.scene.program.actors:
        times = [events.times[events.knot(actor.id, name)] for name in actor.sketch.knots]
        words = f"the knots of {actor.name} come one after another"
        found += [Named(compare("<=", early, late), words) for early, late in pairwise(times)]
    found += [_evenly(events, each) for each in narrowings if each.even]
    for actor in events.scene.program.actors:
        if not (actor.is_ego and events.drive is not None):  # how it drove is a fact
            found += _motion(events, narrowings, actor.id, least)
    return [each for each in found if each.formula != TRUE]


def _evenly(events: Events, piece: Narrowing) -> Named:
    """Return how far somebody comes at one rate, as the judge looks at that: nearly what both speeds tell.

    Every part as long as a ramp, from the first ramp's end on, has that rate but for a tight tolerance. So by the end
    of the first such part nobody is further off the even speed than two ramps at the law's rates lead, on average one
    and a half; from part to part no more than the tolerance comes on top. The same holds backwards from the end.
    A piece of less than three ramps, of which the mean alone is looked at, is within that, too.
    """
    a, b = events.state(piece.actor, piece.first), events.state(piece.actor, piece.last)
    ends, lasts = (piece.actor, piece.first, piece.last), events.times[piece.last] - events.times[piece.first]
    own = (each.law for each in events.pieces if (each.actor, each.first, each.last) == ends)
    law = next(own, events.law_of(piece.actor))
    off, change = (b.place - a.place) * 2 - (a.speed + b.speed) * lasts, b.speed - a.speed
    roughly, ramps_s = lasts * lasts * TIGHT["acceleration"], 3 * events.scene.program.manner.ramp_s
    most = [room * ramps_s + roughly for room in (change - lasts * law.rate_low, lasts * law.rate_high - change)]
    held = every([compare("<=", one, each) for each in most for one in (off, -off)])
    return Named(held, EVEN_RATE, (piece.origin,))


def _motion(events: Events, narrowings: Sequence[Narrowing], actor: int, least: NDArray[np.float64]) -> Iterator[Named]:
    """Yield the law between each two moments of an actor that may be neighbours, also in each piece they may lie in."""
    name, free = events.scene.program.actor(actor).name, events.law_of(actor)
    moves = events.ego.words(name) if actor == EGO else f"{name} {free.words()}"
    bounded = [each for each in (*events.pieces, *narrowings) if each.actor == actor and each.proven is not None]
    instants, times = events.instants_of(actor), events.times
    for early, late in permutations(instants, 2):
        if least[late, early] > _CERTAIN or _parted(instants, early, late, least):
            continue
        certain = [each for each in bounded if _within(each, early, late, least)]
        law = reduce(Law.meet, (each.proven for each in certain if each.proven), free)
        origin = next((each.origin for each in certain if each in events.pieces), moves)
        besides = tuple(dict.fromkeys(each.origin for each in certain if each.origin != origin))
        reversed_ = [] if least[early, late] >= 0 else [compare("<", times[late], times[early])]
        yield Named(some([*reversed_, reach_formula(events, actor, early, late, law)]), origin, besides)
        for piece in (each for each in events.pieces if each.actor == actor) if origin == moves else ():
            if not any(_outside(piece, instant, least) for instant in (early, late)):
                ends = ("<", times[piece.first]), (">", times[piece.last])
                elsewhere = [compare(side, times[k], end) for k in (early, late) for side, end in ends]
                held = reach_formula(events, actor, early, late, law.meet(piece.law))
                yield Named(some([*elsewhere, *reversed_, held]), piece.origin, besides)


def _within(narrowing: Narrowing, early: int, late: int, least: NDArray[np.float64]) -> bool:
    """Whether two moments certainly lie in what is narrower."""
    begun = all(least[instant, early] >= 0 for instant in narrowing.begins())
    return begun and all(least[late, instant] >= 0 for instant in narrowing.ends())


def _outside(piece: Narrowing, instant: int, least: NDArray[np.float64]) -> bool:
    """Whether an instant is certain to be before or after a piece."""
    return bool(least[instant, piece.first] > _CERTAIN or least[piece.last, instant] > _CERTAIN)


def _parted(instants: list[int], early: int, late: int, least: NDArray[np.float64]) -> bool:
    """Whether a third moment lies between for certain: the laws on either side say it."""
    for middle in instants:
        if middle in (early, late):
            continue
        if least[early, middle] >= 0 and least[middle, late] >= 0:
            tied = least[middle, early] >= 0 or least[late, middle] >= 0
            if not tied or middle < max(early, late):
                return True
    return False


def reach_formula(events: Events, actor: int, early: int, late: int, law: Law) -> Formula:
    """Return the exact conditions on the states at two moments between which an actor obeys `law`."""
    a, b = events.state(actor, early), events.state(actor, late)
    lasts = events.times[late] - events.times[early]
    found = reach(law, a.speed, b.speed, lasts, b.place - a.place)
    if found.impossible:
        return FALSE
    speeds, is_capped = (a.speed, b.speed), law.speed_high < events.law_of(actor).speed_high
    caps = [compare("<=", speed, law.speed_high) for speed in speeds if is_capped]
    caps += [compare(">=", speed, law.speed_low) for speed in speeds if law.speed_low > ZERO]
    return every(
        [
            *caps,
            *(atom(row, "<=") for row in found.rows),
            *(atom(row, "==") for row in found.equal),
            *(some([atom(one, "<="), atom(other, "<=")]) for one, other in found.choices),
        ]
    )
