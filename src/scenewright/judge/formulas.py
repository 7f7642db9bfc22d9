"""By how much a formula is missed in a trace.

What enters: a formula and measured moments. What leaves: a `Miss`. Temporal operators are looked at on all samples,
between them, and closer around the worst (or best) instant.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.instants import sharpen
from scenewright.judge.terms import Moments, divisor, piece_span, sides
from scenewright.judge.tolerance import (
    TIGHT,
    Every,
    FloatArray,
    Leaf,
    Miss,
    Some,
    Sometime,
    Throughout,
    Values,
    dimension_of,
    dimension_of_dividend,
    normalised,
)
from scenewright.program.expressions import Compare, Elapsed, Formula, Logic, PieceRef, State, Temporal, piece_of, walk

_ROUNDING_S = 1e-6  # moments that are nearer than this are one
_OPPOSITE = {"<=": ">", ">=": "<", "<": ">=", ">": "<="}


def miss_of(case: Case, formula: Formula, moments: Moments, negated: bool = False) -> Miss:
    """Return by how much `formula` (or, negated, its opposite) is missed.

    Raises
    ------
    CannotJudge
        If a part of it cannot be measured.
    """
    match formula:
        case Compare():
            return _compare(case, formula, moments, negated)
        case Logic(operator="not", operands=operands):
            return miss_of(case, operands[0], moments, not negated)
        case Logic(operator="implies", operands=(left, right)):
            parts = (miss_of(case, left, moments, not negated), miss_of(case, right, moments, negated))
            return Every(parts) if negated else Some(parts)
        case Logic(operator=operator, operands=operands):
            return _join(case, operands, moments, negated, every=(operator == "and") != negated)
        case Temporal():
            return held_over(case, formula, moments, looked_at(case, formula, moments, negated), negated)


def _join(case: Case, operands: tuple[Formula, ...], moments: Moments, negated: bool, every: bool) -> Miss:
    parts: list[Miss] = []
    reason: CannotJudge | None = None
    for operand in operands:
        try:
            parts.append(miss_of(case, operand, moments, negated))
        except CannotJudge as error:
            reason = error
    # One alternative that holds is enough even where another cannot be measured; all of several cannot be had that way.
    if reason is not None and (every or not parts):
        raise reason
    return Every(tuple(parts)) if every else Some(tuple(parts))


def error_of(operator: str, left: Values, right: Values) -> FloatArray:
    """Return by how much ``left operator right`` fails; 0 where it holds, infinite where it has no value."""
    with np.errstate(invalid="ignore"):
        difference = np.asarray(left, dtype=np.float64) - right
    match operator:
        case "==":
            error = np.abs(difference)
        case "<=" | "<":
            error = np.maximum(difference, 0.0)
        case _:
            error = np.maximum(-difference, 0.0)
    return np.where(np.isnan(error), np.inf, error)


def is_order(compare: Compare) -> bool:
    """Whether this is an order of two events: no tolerance makes "before" out of "after"."""
    return compare.operator in ("<", ">") and isinstance(compare.left, Elapsed) and isinstance(compare.right, Elapsed)


def instants_of_piece(case: Case, compare: Compare, moments: Moments) -> FloatArray | None:
    """Return the instants of the piece that a position or speed is asked of throughout; None for all other states."""
    for node in walk(compare):
        if isinstance(node, State) and isinstance(node.at, PieceRef) and node.order < 2:
            return case.timelines[node.actor].instants(*piece_span(case, moments, node.actor, node.at))
    return None


def _compare(case: Case, compare: Compare, moments: Moments, negated: bool) -> Miss:
    if piece_of(compare) is None:
        return _leaf(case, compare, moments, negated)
    inside = instants_of_piece(case, compare, moments)
    leaf = _leaf(case, compare, moments if inside is None else replace(moments, now=inside), negated)
    return Sometime(leaf) if negated else Throughout(leaf)


def _leaf(case: Case, compare: Compare, moments: Moments, negated: bool) -> Leaf:
    left, right = sides(case, compare, moments)
    dimension = None if is_order(compare) else dimension_of(compare)
    if negated and compare.operator == "==":
        return Leaf(np.where(error_of("==", left, right) > 0, 0.0, np.inf), dimension)
    operator = _OPPOSITE[compare.operator] if negated else compare.operator
    error = error_of(operator, left, right)
    if dimension is None and not is_order(compare) and (by := divisor(case, compare, moments)) is not None:
        # A quotient without a unit has no tolerance of its own: it is what is divided that may be off by one.
        return Leaf(error * np.abs(by), dimension_of_dividend(compare))
    return Leaf(error, dimension)


def held_over(case: Case, formula: Temporal, moments: Moments, instants: FloatArray, negated: bool = False) -> Miss:
    """Return by how much the body of a formula is missed where it is `looked_at`."""
    lasting, body_negated = (formula.operator != "eventually") != negated, (formula.operator == "never") != negated
    if not len(instants):  # what holds always holds, what holds sometime does not
        return Leaf(0.0 if lasting else np.inf, None)
    part = miss_of(case, formula.body, replace(moments, now=instants), body_negated)
    return Throughout(part) if lasting else Sometime(part)


def looked_at(case: Case, formula: Temporal, moments: Moments, negated: bool = False) -> FloatArray:
    """Return the instants of a stretch of time at which its body is looked at, the worst or the best one among them.

    Raises
    ------
    CannotJudge
        If the run did not last for it.
    """
    if any(isinstance(node, Temporal) for node in walk(formula.body)):
        raise CannotJudge("one temporal operator inside another")
    start, end = sides(case, Compare("<=", formula.start, formula.end), moments)
    start_s, end_s = case.start_s + max(0.0, float(start)), case.start_s + float(end)
    if not np.isfinite(start_s) or start_s > case.end_s:
        raise CannotJudge("the run ended before the stretch of time began")
    lasting, body_negated = (formula.operator != "eventually") != negated, (formula.operator == "never") != negated
    if end_s < start_s - _ROUNDING_S:
        return np.array([])
    end_s = max(start_s, end_s)
    if lasting and np.isfinite(end_s) and end_s > case.end_s + TIGHT.time_s:
        raise CannotJudge(f"the run ended {end_s - case.end_s:.2f} s before the stretch of time did")

    def body(time_s: FloatArray) -> Miss:
        return miss_of(case, formula.body, replace(moments, now=time_s), body_negated)

    steps = lasting and any(isinstance(node, State) and node.order == 2 for node in walk(formula.body))
    if steps and end_s - start_s > 4 * TIGHT.time_s:
        # Accelerations step at knots, and knots are met within a time tolerance: the ends are not held against anybody.
        start_s, end_s = start_s + TIGHT.time_s, end_s - TIGHT.time_s
    coarse = case.timelines[0].instants(start_s, end_s)
    return np.union1d(coarse, sharpen(_scorer(body, -1.0 if lasting else 1.0), coarse))


def _scorer(body: Callable[[FloatArray], Miss], sign: float) -> Callable[[FloatArray], FloatArray]:
    def score(time_s: FloatArray) -> FloatArray:
        return sign * np.broadcast_to(np.asarray(normalised(body(time_s), TIGHT), dtype=np.float64), time_s.shape)

    return score
