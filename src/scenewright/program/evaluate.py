"""Evaluates terms and formulas of a program on given motions: the independent check of every solution.

What enters: a resolved expression (see `resolve`) and a `World` that knows states, knots, landmarks, parameters. What
leaves: numbers, and for formulas the margin by which they hold. It shares no code with the lowering to solver formulas.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Protocol

from scenewright.program import expressions as ex
from scenewright.program.types import Program

_TEMPORAL_STEP_S = 0.02
_MOST_INSTANTS = 20_000  # of an interval; a longer one is looked at more coarsely
# Speeds are looked at right at the ends of a stretch; rates a hair inside, where no rounded duration leaves a sliver.
_EDGE_S, _EDGE_OF_RATES_S = 1e-7, 1e-4
_SAME = 1e-6  # what is nearer than this (SI) is the same


class Places(Protocol):
    """What is known of the places of a program on a map, as of a scene. Lengths in m."""

    @property
    def program(self) -> Program:
        """What is evaluated."""

    def landmark_m(self, actor: int, name: str, other: int | None) -> float:
        """Return the arc length of a landmark on the route of `actor`."""

    def offset_m(self, actor: int, other: int) -> float:
        """Return what to add to the arc length of `other` to compare it with that of `actor`."""


class World(Protocol):
    """What the values of a program's terms are taken from. Lengths in m, times in s.

    Attributes
    ----------
    parameters
        SI values by name.
    between_m
        How much of a gap between two actors' centres their bodies take up.
    """

    parameters: Mapping[str, float]
    between_m: float

    @property
    def scene(self) -> Places:
        """The program on its map."""

    def state(self, actor: int, order: ex.Order, time_s: float) -> float:
        """Return position, speed or acceleration of `actor` at an instant."""

    def knot_time_s(self, actor: int, knot: str) -> float:
        """Return when `actor` passes `knot`; infinite where it never does."""

    def changes_s(self) -> Sequence[float]:
        """Return the instants at which some motion changes, where that is known: bounds are looked at there, too."""


def landmark_owner(compare: ex.Compare) -> int | None:
    """Return the one actor whose position `compare` speaks of, or None where there is none or more than one."""
    owners = {node.actor for node in ex.walk(compare) if isinstance(node, ex.State) and node.order == 0}
    if not owners:
        owners = {node.actor for node in ex.walk(compare) if isinstance(node, ex.State)}
    return owners.pop() if len(owners) == 1 else None


def difference(compare: ex.Compare, world: World, now_s: float | None = None) -> float:
    """Return left minus right (SI), NaN-free: a comparison with an undefined value gives infinity."""
    left = term_value(compare.left, world, now_s)
    right = term_value(compare.right, world, now_s)
    if math.isinf(left) and math.isinf(right) and left == right:
        return 0.0
    return left - right


def violation(formula: ex.Formula, world: World, now_s: float | None = None, denied: bool = False) -> float:
    """Return by how much `formula` is violated (SI of its comparison); zero or less where it holds.

    With `denied` it is its contrary that is to hold. A place, speed or rate of a whole piece is looked at all through
    the piece; so is a stretch of time. That two values are *not* the same is violated without end where they are.
    """
    match formula:
        case ex.Compare():
            piece = ex.piece_of(formula)
            if piece is not None:
                return _throughout(formula, piece, world, denied)
            return _compared(formula, world, now_s, denied)
        case ex.Logic(operator="not", operands=operands):
            return violation(operands[0], world, now_s, not denied)
        case ex.Logic(operator="implies", operands=(left, right)):
            parts = [violation(left, world, now_s, not denied), violation(right, world, now_s, denied)]
            return max(parts) if denied else min(parts)
        case ex.Logic(operator=operator, operands=operands):
            parts = [violation(operand, world, now_s, denied) for operand in operands]
            return max(parts) if (operator == "and") != denied else min(parts)
        case ex.Temporal(operator=operator, start=start, end=end, body=body):
            first, last = term_value(start, world, now_s), term_value(end, world, now_s)
            if not (math.isfinite(first) and math.isfinite(last)):
                return math.inf  # an interval that never begins or ends was not kept to
            lasting = (operator != "eventually") != denied
            if last < max(0.0, first):
                return -math.inf if lasting else math.inf  # nothing is asked of no time, and nothing happens in it
            instants = _instants(max(0.0, first), last, world, body)
            values = [violation(body, world, time_s, (operator == "never") != denied) for time_s in instants]
            return max(values) if lasting else min(values)
        case _:
            raise TypeError(f"not a formula: {formula!r}")


def moments_of_worst(formula: ex.Formula, world: World, least: float = 1e-3) -> list[tuple[ex.Temporal, float]]:
    """Return for each stretch of time in `formula` that is to be kept all along when (s) it is broken most."""
    found = []
    for node in ex.walk(formula):
        if not isinstance(node, ex.Temporal) or node.operator == "eventually":
            continue
        first, last = term_value(node.start, world), term_value(node.end, world)
        if math.isfinite(first) and math.isfinite(last) and last >= max(0.0, first):
            instants = _instants(max(0.0, first), last, world, node.body)
            values = [violation(node.body, world, time_s, node.operator == "never") for time_s in instants]
            worst = max(range(len(values)), key=values.__getitem__)
            if values[worst] > least:
                found.append((node, instants[worst]))
    return found


def _compared(formula: ex.Compare, world: World, now_s: float | None, denied: bool) -> float:
    apart = difference(formula, world, now_s)
    match formula.operator:
        case "==":
            return (math.inf if abs(apart) <= _SAME else -abs(apart)) if denied else abs(apart)
        case "<=" | "<":
            return -apart if denied else apart
        case _:
            return apart if denied else -apart


def _throughout(formula: ex.Compare, state: ex.State, world: World, denied: bool) -> float:
    assert isinstance(state.at, ex.PieceRef)
    ends = world.scene.program.actor(state.actor).sketch.piece_ends(state.at.name)
    first, last = (world.knot_time_s(state.actor, knot) for knot in ends)
    if not (math.isfinite(first) and math.isfinite(last)):
        return math.inf
    bare = ex.at_each_moment(formula, state)
    values = [_compared(bare, world, time_s, denied) for time_s in _instants(first, last, world, bare)]
    return min(values) if denied else max(values)


def _instants(first_s: float, last_s: float, world: World, body: ex.Formula) -> list[float]:
    """Return the instants at which a condition over ``[first_s, last_s]`` is looked at.

    A hair inside: at its very ends an interval between two knots touches the pieces before and after it, whose
    acceleration is another.
    """
    of_rates = any(isinstance(node, ex.State) and node.order == 2 for node in ex.walk(body))
    edge_s = _EDGE_OF_RATES_S if of_rates else _EDGE_S
    if last_s <= first_s + 2 * edge_s:
        return [first_s]
    begin, end = first_s + edge_s, last_s - edge_s
    count = min(max(2, math.ceil((end - begin) / _TEMPORAL_STEP_S) + 1), _MOST_INSTANTS)
    found = [begin + (end - begin) * i / (count - 1) for i in range(count)]
    return found + [time_s for time_s in world.changes_s() if begin < time_s < end]


def term_value(term: ex.Term, world: World, now_s: float | None = None) -> float:
    """Return the SI value of `term`; `now_s` is the moment inside a temporal operator."""
    match term:
        case ex.Number(value=value):
            return float(value)
        case ex.ParameterRef(name=name):
            return world.parameters[name]
        case ex.Landmark():
            return _landmark_m(term, world)
        case ex.Elapsed(actor=actor, knot=knot):
            return world.knot_time_s(actor, knot)
        case ex.State(actor=actor, order=order, at=at):
            return world.state(actor, order, moment_s(at, actor, world, now_s)) + _shift_m(term, world)
        case ex.Derived():
            return _derived(term, world, now_s)
        case ex.Negate(operand=operand):
            return -term_value(operand, world, now_s)
        case ex.Arithmetic(operator=operator, left=left_term, right=right_term):
            return _apply(operator, term_value(left_term, world, now_s), term_value(right_term, world, now_s))
        case _:
            raise TypeError(f"not a term: {term!r}")


def moment_s(at: ex.At, actor: int, world: World, now_s: float | None) -> float:
    """Return the time (s) that a moment stands for."""
    match at:
        case ex.Knot(name=name):
            return world.knot_time_s(actor, name)
        case ex.Elapsed(actor=other, knot=knot):
            return world.knot_time_s(other, knot)
        case ex.Number(value=value):
            return float(value)
        case None if now_s is not None:
            return now_s
        case _:
            raise ValueError("a state without a moment stands only inside always, never or eventually")


def _derived(term: ex.Derived, world: World, now_s: float | None) -> float:
    time_s = moment_s(term.at, term.actor, world, now_s)
    position = world.state(term.actor, 0, time_s)
    speed = world.state(term.actor, 1, time_s)
    if isinstance(term.target, ex.Landmark):
        return _ratio(_landmark_m(term.target, world) - position, speed)
    gap = world.state(term.target, 0, time_s) + world.scene.offset_m(term.actor, term.target) - position
    if term.kind == "gap":
        return gap
    body = world.between_m
    if term.kind == "freespace":
        return gap - body
    if term.kind == "headway":
        return _ratio(gap - body, speed)
    closing = speed - world.state(term.target, 1, time_s)
    return _ratio(abs(gap) - body, closing if gap >= 0 else -closing)


def _landmark_m(mark: ex.Landmark, world: World) -> float:
    if mark.actor is None:
        raise ValueError(f"landmark {mark.name} belongs to no one")
    return world.scene.landmark_m(mark.actor, mark.name, mark.other) + _shift_m(mark, world)


def _shift_m(place: ex.State | ex.Landmark, world: World) -> float:
    """Return what brings a place to the route that it is meant along."""
    if place.frame is None or place.actor is None:
        return 0.0
    return world.scene.offset_m(place.frame, place.actor)


def _ratio(numerator: float, denominator: float) -> float:
    return numerator / denominator if denominator > 1e-9 else math.inf


def _apply(operator: str, left: float, right: float) -> float:
    if operator == "+":
        return left + right
    if operator == "-":
        return left - right
    if operator == "*":
        return left * right
    return left / right if right else math.inf
