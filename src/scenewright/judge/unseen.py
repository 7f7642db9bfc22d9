"""Knots that a trace does not show: moments are looked for at which what the program says of them holds.

What enters: a `Case`. What leaves: `Measured`. A scenario happened if there are moments, in the order of the sketches,
at which all holds that was asked for. So a knot that neither a place nor anything visible ties to a moment may have
been any, and one that something visible ties to it may be wherever that is seen. It is moved only where more holds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.conditions import Judged, program_conditions
from scenewright.judge.formulas import miss_of
from scenewright.judge.instants import minima
from scenewright.judge.interaction import interaction_conditions
from scenewright.judge.knots import Group, Measured, best_instants, between, conjuncts, measure, visible_times
from scenewright.judge.terms import Moments, Span
from scenewright.judge.tolerance import LOOSE, TIGHT, FloatArray, normalised
from scenewright.program.expressions import Compare, PieceRef, State, walk
from scenewright.program.structure import KnotKey, knots_of
from scenewright.program.types import EGO

_PASSES = 2  # a knot may be tied to another that is unseen, too
_TRIED = 48  # moments between two knots, beside those at which one comparison holds best
_AMONG_S = 0.05  # how far apart instants are among which those are looked for; they are found exactly


class Amiss(NamedTuple):
    """What does not hold: how many conditions at the loose tolerance, and which at the tight one."""

    loose: int
    tight: tuple[str, ...]


def measured_at_best(case: Case) -> Measured:
    """Find the times of all knots; of those that are not tied to one moment the ones with which most holds."""
    told, several = best_instants(case)
    first = found = measure(case, told)
    free = (*several, *first.free)
    loose = (*first.visible, *free)
    judged: Judged = {}
    amiss = _amiss(case, found, judged) if loose else Amiss(0, ())
    for group in loose * _PASSES:
        if not _concerned(case, amiss, group):
            continue
        follows = frozenset[KnotKey]().union(*first.visible) - told.keys()
        others = frozenset[KnotKey]().union(*free)
        low, high = between(case, group, found.moments.knots, others, follows)
        for time_s in _candidates(case, found, group, low, high, group in first.visible, several.get(group)):
            if not _concerned(case, amiss, group):
                break
            other_told = {**told, **dict.fromkeys(group, time_s)}
            other = measure(case, other_told)
            less = _amiss(case, other, judged)
            if less.loose <= amiss.loose and len(less.tight) < len(amiss.tight):
                told, found, amiss = other_told, other, less
    return found


def _amiss(case: Case, measured: Measured, judged: Judged) -> Amiss:
    conditions = [*program_conditions(case, measured, judged), *interaction_conditions(case, measured)]
    tight = tuple(each.id for each in conditions if not each.holds_at(TIGHT))
    return Amiss(sum(not each.holds_at(LOOSE) for each in conditions), tight)


def _concerned(case: Case, amiss: Amiss, group: Group) -> bool:
    """Whether anything that does not hold speaks of a group of knots, or of a piece that begins or ends at one."""
    actors = {actor for actor, _ in group}
    formulas = {constraint.id: constraint.formula for constraint in case.program.constraints}
    for name in amiss.tight:
        formula = formulas.get(name)
        if formula is None:  # what a sketch says of a hero
            if actors - {EGO}:
                return True
        elif group & set(knots_of(formula)) or any(
            isinstance(node, State) and isinstance(node.at, PieceRef) and node.actor in actors for node in walk(formula)
        ):
            return True
    return False


def _candidates(
    case: Case,
    measured: Measured,
    group: Group,
    low: float,
    high: float,
    visible: bool,
    among: Sequence[Span] | None,
) -> Iterable[float]:
    """Return moments between two, likely ones first; `among` are those that what is said of the moment leaves."""
    if not high > low:
        return ()
    seen = [time_s for key in group for time_s in visible_times(case, key, low, high)]
    if visible:
        return seen
    likely = _best_of_each(case, measured.moments.knots, group, low, high)
    all_s = dict.fromkeys([*seen, *likely, *np.linspace(low, high, _TRIED).tolist()])
    if among is None:
        return all_s
    bests = [first for first, last in among if first == last and low <= first <= high]
    return dict.fromkeys([*bests, *(t for t in all_s if any(first <= t <= last for first, last in among))])


def _best_of_each(
    case: Case, knots: Mapping[KnotKey, float | FloatArray], group: Group, low: float, high: float
) -> Iterator[float]:
    """Yield moments at which one comparison that speaks of a group of knots holds best."""
    grid = np.linspace(low, high, max(2, int((high - low) / _AMONG_S) + 1))
    for constraint in case.program.constraints:
        for part in conjuncts(constraint.formula):
            if not isinstance(part, Compare) or not group & set(knots_of(part)):
                continue

            def score(time_s: FloatArray, part: Compare = part) -> FloatArray:
                miss = miss_of(case, part, Moments({**knots, **dict.fromkeys(group, time_s)}))
                return np.broadcast_to(np.asarray(normalised(miss, TIGHT), dtype=np.float64), time_s.shape)

            try:
                yield from (minimum.time_s for minimum in minima(score, grid))
            except CannotJudge:
                continue
