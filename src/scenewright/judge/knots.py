"""When each knot of the program was, as the trace shows it.

What enters: a `Case`. What leaves: `Measured`: a time for every knot, a span for every piece, the triggers. The times
that a planner wrote down play no part. Knots that are one moment for several actors are searched for in continuous
time; the others follow from what the program says of them, else from where one piece visibly gives way to the next.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.formulas import miss_of
from scenewright.judge.instants import Minimum, first_crossing, minima, stretches
from scenewright.judge.phases import BRAKING, SPEEDING_UP, Phase, Sign, move_off_after, phase_at, rest_after
from scenewright.judge.terms import Moments, Span, sides
from scenewright.judge.tolerance import LOOSE, TIGHT, FloatArray, Values, normalised
from scenewright.program.expressions import (
    Compare,
    Derived,
    Elapsed,
    Formula,
    Knot,
    Logic,
    PieceRef,
    State,
    Temporal,
    walk,
)
from scenewright.program.structure import KnotKey, actors_of, knots_of, synchronised
from scenewright.program.types import EGO, PieceKind

SIGN_OF: dict[PieceKind, Sign] = {PieceKind.DEC: BRAKING, PieceKind.ACC: SPEEDING_UP}
Group = frozenset[KnotKey]
Tie = Literal["fixed", "visible", "free"]
_TIE = 1e-3
_ROUNDING_MPS = 0.005  # speeds that differ by less are the same
_LOOK_S = 0.25  # shorter than any phase
_NEAR_S = 1.0  # within tolerances a moment is no point
_EXACTLY = 0.1  # of a tight tolerance: what holds so well holds, whatever tolerances there are
_PASSES = 3  # a knot may be defined by another actor's, which may be defined by a third


@dataclass(frozen=True, slots=True)
class Measured:
    """What the trace shows.

    Attributes
    ----------
    moments
        Times of knots (infinite: never reached; absent: nothing defines it) and spans of pieces.
    triggers
        Time (s) of each hero's trigger, by hero id; infinite where it has no best instant at all.
    onsets
        The braking or speeding up that begins at each hero's trigger, by hero id; None where there is none.
    free
        Knots that neither a place nor anything visible ties to a moment, those that are one moment together.
    visible
        Knots that are where one piece visibly gives way to the next, which may be seen more than once.
    """

    moments: Moments
    triggers: dict[int, float]
    onsets: dict[int, Phase | None]
    free: tuple[Group, ...] = ()
    visible: tuple[Group, ...] = ()


def measure(case: Case, told: Mapping[KnotKey, float]) -> Measured:
    """Find the times of all knots, of which some are told."""
    knots = dict(told)
    ties: dict[KnotKey, Tie] = dict.fromkeys(told, "fixed")
    for attempt in range(_PASSES):
        _fill(case, knots, ties, last_attempt=attempt == _PASSES - 1)
    triggers: dict[int, float] = {}
    onsets: dict[int, Phase | None] = {}
    for hero in case.structure.triggers:
        knot = case.structure.trigger_knot(hero)
        triggers[hero] = knots.get((hero, knot or ""), np.inf)
        onsets[hero] = onset_after(case, hero, knot or "", triggers[hero])
    together = [group for group in _groups(case) if not group & told.keys()]
    keys = {(actor.id, knot): "free" for actor in case.program.actors for knot in actor.sketch.knots} | ties
    alone = [(frozenset({key}), tie) for key, tie in keys.items() if not any(key in group for group in together)]
    free, visible = (tuple(group for group, tie in alone if tie == wanted) for wanted in ("free", "visible"))
    return Measured(Moments(knots, _spans(case, knots, onsets)), triggers, onsets, (*together, *free), visible)


def best_instants(case: Case) -> tuple[dict[KnotKey, float], dict[Group, list[Span]]]:
    """Return when the knots were of which the program says that they are one moment, and what holds at it.

    With them come those of them for which another moment does as well, and when all of these were.
    """
    found = {(actor.id, actor.sketch.knots[0]): case.start_s for actor in case.program.actors}
    several: dict[Group, list[Span]] = {}
    for group in _groups(case):
        at_start = not group.isdisjoint(found)  # everybody's first moment is there
        if (chosen := (case.start_s, []) if at_start else _best_instant(case, group, found)) is not None:
            found.update(dict.fromkeys(group, chosen[0]))
            several[group] = chosen[1]
    return found, {group: moments for group, moments in several.items() if moments}


def conjuncts(formula: Formula) -> Iterator[Formula]:
    """Yield the parts that must all hold."""
    if isinstance(formula, Logic) and formula.operator == "and":
        for operand in formula.operands:
            yield from conjuncts(operand)
    else:
        yield formula


def sides_of(case: Case, group: Group, known: set[KnotKey]) -> list[Formula]:
    """Return what the program says of an instant, given the knots whose times are known."""
    found = []
    for constraint in case.program.constraints:
        for part in conjuncts(constraint.formula):
            keys = set(knots_of(part))
            nodes = list(walk(part))
            by_piece = any(isinstance(n, State) and isinstance(n.at, PieceRef) for n in nodes)
            order = any(isinstance(n, Elapsed) and (n.actor, n.knot) in keys - group for n in nodes)
            temporal = any(isinstance(n, Temporal) for n in nodes)
            apart = by_piece or order or temporal or bool(list(synchronised(part)))
            if keys & group and keys <= group | known and not apart:
                found.append(part)
    return found


def onset_after(case: Case, hero: int, knot: str, moment_s: float) -> Phase | None:
    """Return the phase that begins the piece after a knot, where that piece is braking or speeding up."""
    sketch = case.program.actor(hero).sketch
    if knot not in sketch.knots[:-1] or not np.isfinite(moment_s):
        return None
    sign = SIGN_OF.get(sketch.pieces[sketch.knot_index(knot)])
    return None if sign is None else phase_at(case.timelines[hero], moment_s, sign, case.program.manner)


def _groups(case: Case) -> list[Group]:
    groups: list[set[KnotKey]] = [set(instant) for instant in case.structure.triggers.values()]
    for constraint in case.program.constraints:
        for pair in synchronised(constraint.formula):
            touching = [group for group in groups if group & set(pair)]
            groups = [group for group in groups if group not in touching] + [set(pair).union(*touching)]
    triggers = set(case.structure.triggers.values())
    return sorted({frozenset(group) for group in groups}, key=lambda group: (group not in triggers, sorted(group)))


def between(
    case: Case, group: Group, knots: Mapping[KnotKey, Values], free: Group = frozenset(), follows: Group = frozenset()
) -> tuple[float, float]:
    """Return from when to when a group of knots may have come: after and before what is known of the same sketches.

    Parameters
    ----------
    free
        Knots that may have come at other times than these.
    follows
        Knots that, where they come later, come later still if the group does.
    """
    low, high = case.start_s, case.end_s
    for actor, knot in group:
        names = case.program.actor(actor).sketch.knots
        for index, other in enumerate(names):
            time_s = float(np.max(knots.get((actor, other), np.inf)))
            if other == knot or (actor, other) in free or not np.isfinite(time_s):
                continue
            if index < names.index(knot):
                low = max(low, time_s)
            elif (actor, other) not in follows:
                high = min(high, time_s)
    return low, high


def _best_instant(case: Case, group: Group, knots: dict[KnotKey, float]) -> tuple[float, list[Span]] | None:
    """Return the instant at which what the program says of it holds best, and all at which it does if others do too."""
    parts = sides_of(case, group, set(knots))
    low, high = between(case, group, knots)
    grid = case.timelines[0].instants(low, max(low, high), parts=2)

    def score(time_s: FloatArray) -> FloatArray:
        moments = Moments({**knots, **dict.fromkeys(group, time_s)})
        errors = [np.broadcast_to(normalised(miss_of(case, part, moments), TIGHT), time_s.shape) for part in judged]
        # Where one side stays equally bad for long, the others say which instant is meant; the weight is too small to
        # move a minimum of the worse side.
        return np.asarray(np.max(errors, axis=0) + _TIE * np.mean(errors, axis=0), dtype=np.float64)

    judged = [part for part in parts if _can_be_judged(case, part, knots, group)]
    if not judged:
        return None
    found = minima(score, grid)
    if not found:
        return np.inf, []
    chosen = _likeliest(case, group, judged, found)
    misses, off_s = score(grid), np.abs(grid - chosen)
    elsewhere = ((misses <= 1) & (off_s > _NEAR_S)) | ((misses <= _EXACTLY) & (off_s > TIGHT.time_s))
    return chosen, _moments(grid, misses, found) if np.any(elsewhere) else []


def _moments(grid: FloatArray, misses: FloatArray, found: list[Minimum]) -> list[Span]:
    """Return when a moment may have been that may have been more than once.

    That is where what is said of it holds best, and all the time that it holds exactly, or within tolerances for long.
    """
    moments = [(minimum.time_s, minimum.time_s) for minimum in found]
    for most, lasts_s in ((_EXACTLY, 0.0), (1.0, _NEAR_S)):
        for first, last in stretches(misses <= most):
            begins_s, ends_s = float(grid[max(first - 1, 0)]), float(grid[min(last + 1, len(grid) - 1)])
            best_s = float(grid[first + int(np.argmin(misses[first : last + 1]))])
            if max(best_s - begins_s, ends_s - best_s) > lasts_s:
                moments.append((begins_s, ends_s))
    return moments


def _likeliest(case: Case, group: Group, judged: list[Formula], found: list[Minimum]) -> float:
    if not any(isinstance(part, Compare) and part.operator == "==" for part in judged):
        # "while ..." holds over stretches: the piece that follows shows which instant of them was meant.
        return min(found, key=lambda m: (m.score > 1, m.score if m.score > 1 else 0.0, m.time_s)).time_s
    good = [minimum for minimum in found if minimum.score <= 1] or found[:1]
    # The program says that there is such an instant, not that it is the first: of several good ones take the one that
    # was acted upon.
    return min(good, key=lambda minimum: _unlikeliness(case, group, minimum)).time_s


def _can_be_judged(case: Case, part: Formula, knots: Mapping[KnotKey, Values], group: Group) -> bool:
    try:
        miss_of(case, part, Moments({**knots, **dict.fromkeys(group, case.start_s)}))
    except CannotJudge:
        return False
    return True


def _unlikeliness(case: Case, group: Group, minimum: Minimum) -> tuple[float, float]:
    score = minimum.score
    for actor, knot in group:
        sketch = case.program.actor(actor).sketch
        if actor and knot in sketch.knots[:-1] and sketch.pieces[sketch.knot_index(knot)] in SIGN_OF:
            phase = onset_after(case, actor, knot, minimum.time_s)
            late = abs(phase.start_s - minimum.time_s) / TIGHT.time_s if phase else np.inf
            score += min(late, 100.0)
    return score, minimum.time_s


def _fill(case: Case, knots: dict[KnotKey, float], ties: dict[KnotKey, Tie], last_attempt: bool) -> None:
    """Put in the times of knots in the order of the sketch, and what ties them to these."""
    for actor in (*case.program.heroes, case.program.ego):
        previous = case.start_s
        for index, knot in enumerate(actor.sketch.knots):
            key = (actor.id, knot)
            if key not in knots:
                time_s, tie = _time_of(case, key, index, previous, knots)
                if time_s is None and last_attempt and index == len(actor.sketch.knots) - 1:
                    time_s = case.end_s
                if time_s is None:
                    if last_attempt:
                        continue
                    break  # what follows must wait for another actor's knots
                knots[key], ties[key] = time_s, tie
            previous = max(previous, knots[key])


def _time_of(
    case: Case, key: KnotKey, index: int, previous: float, knots: dict[KnotKey, float]
) -> tuple[float | None, Tie]:
    """Return when a knot was, if anything tells, and what ties it to that."""
    pieces = case.program.actor(key[0]).sketch.pieces
    visible = None if key[0] == EGO else _visible_time(case, key, index, previous)
    stood = index > 0 and pieces[index - 1] is PieceKind.STOP
    if not (stood and visible is not None and np.isfinite(visible)):  # all the time that it stands it is at one place
        begins_s = visible if pieces[index : index + 1] and pieces[index] in SIGN_OF else None
        if (found := _defined_time(case, key, previous, knots, begins_s)) is not None:
            return found
        if visible is None:
            time_s = _stated_time(case, key, knots)
            return time_s, "free" if time_s is None else "fixed"
    return visible, "free" if stood and index == len(pieces) else "visible"  # it may stand for longer than it has to


def _equalities(case: Case, key: KnotKey, known: set[KnotKey]) -> Iterator[Compare]:
    for constraint in case.program.constraints:
        for part in conjuncts(constraint.formula):
            if isinstance(part, Compare) and part.operator == "==":
                keys = set(knots_of(part))
                if key in keys and keys <= known | {key}:
                    yield part


def _level(case: Case, part: Compare, key: KnotKey, knots: Mapping[KnotKey, Values], time_s: FloatArray) -> FloatArray:
    left, right = sides(case, part, Moments({**knots, key: time_s}))
    level = np.asarray(left, dtype=np.float64) - right
    return np.broadcast_to(np.where(np.isnan(level), np.inf, level), time_s.shape)


def _defined_time(
    case: Case, key: KnotKey, after_s: float, knots: dict[KnotKey, float], begins_s: float | None
) -> tuple[float, Tie] | None:
    """Return the time of a knot from what the program says of the actor's state there; None where it says nothing.

    A speed or a time to arrival may be had more than once, so they do not tie it: where braking or speeding up visibly
    begins next, it is at first taken to be there, at `begins_s`.
    """
    if not np.isfinite(after_s):
        return np.inf, "fixed"
    if demands_standstill(case, key, knots):
        return _rest_time(case, key, after_s), _tie_of_standstill(case, key)
    parts = []
    for part in _equalities(case, key, set(knots)):
        orders = {_order_at(n, key) for n in walk(part)} - {None, 2}
        if orders and _can_be_judged(case, part, knots, frozenset({key})):
            relative = any(isinstance(node, Derived) for node in walk(part))
            parts.append(((orders == {1}, len(actors_of(part)), relative), part))
    if not parts:
        return None
    # A place defines a moment better than a speed, and one of its own better than how far it is from another.
    (only_speed, *_), part = min(parts, key=lambda item: item[0])
    if only_speed:
        if begins_s is not None and np.isfinite(begins_s):
            return begins_s, "free"
        return _reached_speed(case, part, key, after_s, knots), "free"
    time_s = _place_time(case, part, key, after_s, knots)
    if any(isinstance(node, Derived) for node in walk(part)):  # it may turn just before
        return time_s if np.isfinite(time_s) else _nearest_time(case, part, key, after_s, knots), "free"
    if np.isfinite(time_s):
        return time_s, "fixed"
    nearest = np.abs(_level(case, part, key, knots, np.array([case.end_s])))  # who stops just short of it is there
    return time_s, "fixed" if nearest[0] > TIGHT.length_m else "free"


def _order_at(node: object, key: KnotKey) -> int | None:
    match node:
        case State(actor=actor, order=order, at=Knot(name=knot)) if (actor, knot) == key:
            return order
        case State(order=order, at=Elapsed(actor=actor, knot=knot)) if (actor, knot) == key:
            return order
        case Derived(actor=actor, at=Knot(name=knot)) if (actor, knot) == key:
            return 0
        case Derived(at=Elapsed(actor=actor, knot=knot)) if (actor, knot) == key:
            return 0
        case _:
            return None


def demands_standstill(case: Case, key: KnotKey, knots: Mapping[KnotKey, Values]) -> bool:
    """Whether the actor's speed is to be zero at a knot: it stands from there on, or a constraint says so."""
    sketch = case.program.actor(key[0]).sketch
    stands = PieceKind.STOP in sketch.pieces[sketch.knot_index(key[1]) :][:1]
    return stands or any(_is_standstill(case, part, key, knots) for part in _equalities(case, key, set(knots)))


def _is_standstill(case: Case, part: Compare, key: KnotKey, knots: Mapping[KnotKey, Values]) -> bool:
    if {_order_at(n, key) for n in walk(part)} - {None} != {1}:
        return False
    timeline = case.timelines[key[0]]
    # Equal to the speed at all of these: it is the speed.
    sample = timeline.time_s[:: max(1, len(timeline.time_s) // 64)]
    try:
        level = _level(case, part, key, knots, sample)
    except CannotJudge:
        return False
    return bool(np.allclose(np.abs(level), np.abs(timeline.speed(sample)), atol=1e-9))


def _rest_time(case: Case, key: KnotKey, after_s: float) -> float:
    """Return when a demanded standstill began, or where there is none, when the actor was slowest."""
    timeline = case.timelines[key[0]]
    if (rest := rest_after(timeline, after_s, case.program.manner)) is not None:
        return rest.start_s
    return float((later := timeline.instants(after_s, timeline.end_s))[np.argmin(timeline.speed(later))])


def _tie_of_standstill(case: Case, key: KnotKey) -> Tie:
    """Return what ties a knot to the beginning of a standstill: who brakes to one is there when it stands."""
    index = (sketch := case.program.actor(key[0]).sketch).knot_index(key[1])
    if index > 0 and sketch.pieces[index - 1] in SIGN_OF:
        return "fixed"
    # Who moves as it likes may have stood before, and may stand for longer than the moment.
    return "visible" if sketch.pieces[index : index + 1] == (PieceKind.STOP,) else "free"


def _reached_speed(case: Case, part: Compare, key: KnotKey, after_s: float, knots: dict[KnotKey, float]) -> float:
    later = case.program.actor(key[0]).sketch.knots[case.program.actor(key[0]).sketch.knot_index(key[1]) + 1 :]
    before_s = min((knots.get((key[0], knot), np.inf) for knot in later), default=np.inf)
    grid = _while(case, key, case.timelines[key[0]].instants(after_s, min(before_s, case.end_s)))
    # A speed that is approached and never quite met is judged where it was met best, from the first time on.
    off_mps = np.abs(_level(case, part, key, knots, grid))
    first = int(np.argmax(off_mps <= np.min(off_mps) + _ROUNDING_MPS))
    reached = first_crossing(lambda t: _level(case, part, key, knots, t), grid[: first + 2])
    return float(grid[first]) if reached is None else reached


def _while(case: Case, key: KnotKey, times: FloatArray) -> FloatArray:
    """Return those of some times before which an actor plainly does the contrary of the piece that ends at a knot.

    A speed that is not quite met there may be met later, in another piece.
    """
    sketch = case.program.actor(key[0]).sketch
    sign = SIGN_OF.get(sketch.pieces[sketch.knot_index(key[1]) - 1])
    if sign is None or key[1] == sketch.knots[0]:
        return times
    speeds = sign * case.timelines[key[0]].speed(times)
    contrary = np.maximum.accumulate(speeds) - speeds > TIGHT.speed_mps
    return times[: int(np.argmax(contrary))] if contrary.any() else times


def _place_time(case: Case, part: Compare, key: KnotKey, after_s: float, knots: dict[KnotKey, float]) -> float:
    timeline = case.timelines[key[0]]
    for start_s, end_s in ((after_s, case.end_s), (case.start_s, after_s)):  # the second: already past it
        reached = first_crossing(lambda t: _level(case, part, key, knots, t), timeline.instants(start_s, end_s))
        if reached is not None:
            return reached
    return case.start_s if _was_past(case, part, key, knots) else np.inf


def _nearest_time(case: Case, part: Compare, key: KnotKey, after_s: float, knots: dict[KnotKey, float]) -> float:
    """Return when a comparison was met best, at the loose tolerance at least."""

    def miss(time_s: FloatArray) -> FloatArray:
        missed = normalised(miss_of(case, part, Moments({**knots, key: time_s})), LOOSE)
        return np.asarray(np.broadcast_to(missed, time_s.shape), dtype=np.float64)

    found = minima(miss, case.timelines[key[0]].instants(after_s, case.end_s))
    return found[0].time_s if found and found[0].score <= 1 else np.inf


def _was_past(case: Case, part: Compare, key: KnotKey, knots: dict[KnotKey, float]) -> bool:
    """Whether the actor was past a place when the run began: what it passed unseen, it passed before all else."""
    if any(isinstance(node, Derived) for node in walk(part)):
        return False
    first, last = _level(case, part, key, knots, np.array([case.start_s, case.end_s]))
    return bool(first * (last - first) > 0.0)  # nobody reverses, so the level moves one way


def _visible_time(case: Case, key: KnotKey, index: int, after_s: float) -> float | None:
    """Return when the piece before a knot visibly gave way to the next."""
    sketch, timeline = case.program.actor(key[0]).sketch, case.timelines[key[0]]
    manner = case.program.manner
    if not np.isfinite(after_s):
        return np.inf
    before = sketch.pieces[index - 1]
    after = sketch.pieces[index] if index < len(sketch.pieces) else None
    if after == before or (before, after) == (PieceKind.STOP, PieceKind.DEC):
        return None  # nothing shows where one gives way to the other
    if before is PieceKind.STOP:
        moved = move_off_after(timeline, after_s, manner)
        return np.inf if moved is None else moved
    if after is PieceKind.STOP:
        rest = rest_after(timeline, after_s, manner)
        return np.inf if rest is None else rest.start_s
    if after in SIGN_OF:
        phase = phase_at(timeline, after_s, SIGN_OF[after], manner)
        return np.inf if phase is None else phase.start_s
    if before in SIGN_OF:
        phase = phase_at(timeline, after_s, SIGN_OF[before], manner)
        return None if phase is None else phase.end_s
    return None


def visible_times(case: Case, key: KnotKey, low_s: float, high_s: float) -> list[float]:
    """Return all moments between two at which the piece before a knot may visibly have given way to the next."""
    if key[0] == EGO:
        return []
    index = case.program.actor(key[0]).sketch.knot_index(key[1])
    found = set()
    for look_s in np.arange(low_s, high_s, _LOOK_S).tolist():
        time_s = _visible_time(case, key, index, look_s)
        # Who stands already when it is looked for does not begin to.
        if time_s is not None and low_s <= time_s <= high_s and (time_s > look_s or look_s == low_s):
            found.add(time_s)
    return sorted(found)


def _stated_time(case: Case, key: KnotKey, knots: dict[KnotKey, float]) -> float | None:
    grid = np.array([case.start_s, case.end_s])
    for part in _equalities(case, key, set(knots)):
        if any(isinstance(n, Elapsed) and (n.actor, n.knot) == key for n in (part.left, part.right, *walk(part))):
            try:
                level = _level(case, part, key, knots, grid)
            except CannotJudge:
                continue
            if not np.all(np.isfinite(level)):
                return np.inf
            reached = first_crossing(lambda t, part=part: _level(case, part, key, knots, t), grid)  # type: ignore[misc]
            return np.inf if reached is None else reached
    return None


def _spans(case: Case, knots: dict[KnotKey, float], onsets: dict[int, Phase | None]) -> dict[tuple[int, int], Span]:
    spans = {}
    for actor in case.program.actors:
        for index in range(len(actor.sketch.pieces)):
            start = knots.get((actor.id, actor.sketch.knots[index]), np.inf)
            end = knots.get((actor.id, actor.sketch.knots[index + 1]), np.inf)
            phase = onsets.get(actor.id)
            if phase is not None and actor.sketch.knots[index] == case.structure.trigger_knot(actor.id):
                start = phase.start_s  # how hard it brakes is measured over the braking, when it began is judged apart
            if np.isfinite(start):
                spans[actor.id, index] = (start, max(start, min(end, case.end_s)))
    return spans
