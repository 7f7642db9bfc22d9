"""One condition for every constraint of the program. Nothing is skipped: what cannot be measured fails and says why.

What enters: a `Case` and what was measured. What leaves: conditions with required and measured values.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

import numpy as np

from scenewright.judge.case import CannotJudge, Case, NotReached
from scenewright.judge.formulas import error_of, held_over, instants_of_piece, is_order, looked_at, miss_of
from scenewright.judge.knots import Measured
from scenewright.judge.terms import Moments, sides
from scenewright.judge.tolerance import TIGHT, Leaf, Values, dimension_of, normalised, only_dimension, unit_symbol
from scenewright.judge.verdict import Condition, Kind, unjudged
from scenewright.program.expressions import (
    CONTRARY,
    Arithmetic,
    Compare,
    Formula,
    Knot,
    Landmark,
    Logic,
    Number,
    PieceRef,
    State,
    Temporal,
    Term,
    piece_of,
    walk,
)
from scenewright.program.structure import Role, knots_of
from scenewright.program.types import EGO, Constraint
from scenewright.translate.lines import told_constraints

_KINDS: dict[Role, Kind] = {
    Role.INITIAL: "initial",
    Role.TRIGGER: "trigger",
    Role.INTERACTION: "interaction",
    Role.OUTCOME: "outcome",
}

Judged = dict[tuple[object, ...], Condition]


def program_conditions(case: Case, measured: Measured, judged: Judged | None = None) -> list[Condition]:
    """Judge every constraint of the program, in its order.

    Parameters
    ----------
    judged
        What was judged of this case before, by what it rests on: who tries many moments keeps it from one to the next.
    """
    told, known = told_constraints(case.program), {} if judged is None else judged
    conditions = []
    for constraint in case.program.constraints:
        key = (constraint.id, *_rests_on(measured.moments, constraint.formula))
        if key not in known:
            known[key] = _judge(case, measured, constraint, told[constraint.id])
        conditions.append(known[key])
    return conditions


def _rests_on(moments: Moments, formula: Formula) -> Iterator[object]:
    """Yield when the knots were that a formula speaks of, and the pieces of those of whose pieces it does."""
    yield from (moments.knots.get(key) for key in knots_of(formula))
    actors = {node.actor for node in walk(formula) if isinstance(node, State) and isinstance(node.at, PieceRef)}
    yield from (each for each in moments.spans.items() if each[0][0] in actors)


def _judge(case: Case, measured: Measured, constraint: Constraint, text: str) -> Condition:
    kind = _KINDS[case.structure.roles[constraint.id]]
    formula = constraint.formula
    try:
        if isinstance(formula, Compare):
            return _comparison(case, measured.moments, constraint.id, kind, text, formula)
        return _compound(case, measured.moments, constraint.id, kind, text, formula)
    except NotReached as reason:
        return _not_reached(case, measured, constraint, kind, text, reason)
    except CannotJudge as reason:
        return unjudged(constraint.id, kind, text, str(reason))


def _compound(case: Case, moments: Moments, name: str, kind: Kind, text: str, formula: Logic | Temporal) -> Condition:
    """Judge what several things, or one for some time, have to be; of the latter what decides it is told."""
    required, value = None, None
    if isinstance(formula, Temporal):
        instants = looked_at(case, formula, moments)
        miss = held_over(case, formula, moments, instants)
        if isinstance(formula.body, Compare) and len(instants):
            required, value = _deciding(case, formula, formula.body, replace(moments, now=instants))
    else:
        miss = miss_of(case, formula, moments)
    dimension = only_dimension(miss)
    error = float(normalised(miss, TIGHT)) * (TIGHT.of(dimension) if dimension else 1.0)
    if dimension is None:
        return Condition(name, kind, f"{text} (error in tight tolerances)", None, None, error, "", miss)
    return Condition(name, kind, text, required, value, error, unit_symbol(dimension), miss)


def _deciding(
    case: Case, formula: Temporal, body: Compare, moments: Moments
) -> tuple[float, float] | tuple[None, None]:
    """Return required and measured value of a comparison where it holds least, or best, over some time."""
    if formula.operator == "never":
        if body.operator == "==":
            return None, None
        body = replace(body, operator=CONTRARY[body.operator])
    return _stated(case, body, *sides(case, body, moments), best=formula.operator == "eventually")


def _comparison(case: Case, moments: Moments, name: str, kind: Kind, text: str, compare: Compare) -> Condition:
    miss = miss_of(case, compare, moments)
    inside = instants_of_piece(case, compare, moments)
    if inside is not None:
        moments = replace(moments, now=inside)
    left, right = sides(case, compare, moments)
    unit = unit_symbol(dimension_of(compare))
    required, value = _stated(case, compare, left, right)
    if inside is None and piece_of(compare) is not None and max(np.ndim(left), np.ndim(right)):
        ramp_s = float(case.program.manner.ramp_s)
        text += f" (on the whole, and all through it but for {ramp_s:g} s at either end)"
    if is_order(compare):
        margin = float(np.subtract(right, left)) * (1.0 if compare.operator == "<" else -1.0)
        note = f"{text} (margin; at least 0)"
        if np.isnan(margin):
            return unjudged(name, kind, text, "neither of the two ever happened")
        return Condition(name, kind, note, 0.0, margin, max(0.0, -margin), unit, miss)
    error = value - required
    if compare.operator != "==":
        dimension = dimension_of(compare)
        worst = error_of(compare.operator, left, right)
        error = float(normalised(miss, TIGHT)) * TIGHT.of(dimension) if dimension else float(np.max(worst))
    return Condition(name, kind, text, required, value, error, unit, miss)


def _stated(case: Case, compare: Compare, left: Values, right: Values, best: bool = False) -> tuple[float, float]:
    """Return required and measured value as people would state them, at the worst (or best) instant of several."""
    required, value = np.broadcast_arrays(np.asarray(right, dtype=float), np.asarray(left, dtype=float))
    over = np.abs(value - required) if compare.operator == "==" else value - required
    least = (compare.operator in (">", ">=")) != best
    worst = np.unravel_index(np.argmin(over) if least else np.argmax(over), over.shape)
    if not _is_measured(compare.left) and _is_measured(compare.right):
        required, value = value, required
    required, value = required[worst], value[worst]
    match compare:
        # "12 m short of the stop line" is a distance; the arc length it comes to tells nobody anything.
        case Compare(_, State(order=0, actor=actor), Arithmetic(("-" | "+") as sign) as place) | Compare(
            _, Arithmetic(("-" | "+") as sign) as place, State(order=0, actor=actor)
        ):
            beyond_m = _beyond_a_landmark(case, place, actor)
            if beyond_m is not None:
                side = float(np.sign(beyond_m)) or (1.0 if sign == "+" else -1.0)
                return side * beyond_m, side * (beyond_m + float(value) - float(required))
    return float(required), float(value)


def _beyond_a_landmark(case: Case, place: Term, actor: int) -> float | None:
    """Return how far (m) a place lies beyond the landmark of an actor that it is told from; None for any other."""
    match place:
        case Landmark(actor=owner):
            return 0.0 if owner in (None, actor) else None
        case Arithmetic(("-" | "+") as sign, nearer, distance):
            first_m, by_m = _beyond_a_landmark(case, nearer, actor), _constant(case, distance)
            return None if first_m is None or by_m is None else first_m + (by_m if sign == "+" else -by_m)
    return None


def _constant(case: Case, term: Term) -> float | None:
    if _is_measured(term):
        return None
    try:
        return float(sides(case, Compare("==", term, Number(Fraction(0))), Moments({}))[0])
    except CannotJudge:
        return None


def _is_measured(term: Term) -> bool:
    return any(not isinstance(node, Number | Landmark) and _has_moment(node) for node in walk(term))


def _has_moment(node: object) -> bool:
    return hasattr(node, "at") or hasattr(node, "knot")


def _not_reached(
    case: Case, measured: Measured, constraint: Constraint, kind: Kind, text: str, reason: NotReached
) -> Condition:
    """Judge a constraint at a knot that was never reached: for a place, how near the actor came."""
    formula = constraint.formula
    if not isinstance(formula, Compare) or formula.operator != "==":
        return unjudged(constraint.id, kind, text, str(reason))
    late = {key: case.end_s if not np.all(np.isfinite(time)) else time for key, time in measured.moments.knots.items()}
    try:
        left, right = sides(case, formula, Moments(late, measured.moments.spans))
    except CannotJudge as other:
        return unjudged(constraint.id, kind, text, str(other))
    required, value = _stated(case, formula, left, right)
    unit = unit_symbol(dimension_of(formula))
    if reason.actor_id == EGO and _only_names_a_moment(formula):
        note = f"{text} (names a moment only, which the ego never came to; at the end of the run it was here)"
        return Condition(constraint.id, kind, note, None, value, None, unit, Leaf(0.0, None))
    note = f"{text} ({reason}; this is the end of the run)"
    miss = Leaf(abs(value - required), dimension_of(formula))
    return Condition(constraint.id, kind, note, required, value, value - required, unit, miss)


def _only_names_a_moment(formula: Compare) -> bool:
    state = formula.left
    at_knot = isinstance(state, State) and state.order == 0 and state.actor == EGO and isinstance(state.at, Knot)
    return at_knot and not _is_measured(formula.right) and len(set(knots_of(formula))) == 1
