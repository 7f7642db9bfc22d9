"""The expressions a program is made of: states of actors, landmarks, arithmetic, comparisons, logic over time.

What enters: nothing. What leaves: frozen nodes that compare by meaning (source spans are carried, not compared).
Nodes hold no behaviour; parsing, printing, checking, lowering and evaluating live elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, Literal

from scenewright.errors import Span
from scenewright.units import Dimension

Order = Literal[0, 1, 2]
ORDER_LETTERS = ("x", "v", "a")
ComparisonOperator = Literal["==", "<=", ">=", "<", ">"]
# What says the same with its sides exchanged; what says the contrary (of an equality that is two, either way).
FLIPPED: dict[ComparisonOperator, ComparisonOperator] = {"==": "==", "<=": ">=", ">=": "<=", "<": ">", ">": "<"}
CONTRARY: dict[ComparisonOperator, ComparisonOperator] = {"<=": ">", ">=": "<", "<": ">=", ">": "<="}
LANDMARKS = (
    "stop_line",
    "conflict_point",
    "intersection",
    "turn",
    "turn_start",
    "turn_end",
    "junction_start",
    "junction_end",
    "route_end",
)
CONFLICT_LANDMARKS = ("conflict_point", "intersection", "turn")


def _span() -> Span | None:
    return field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Number:
    """A literal in SI units, exact. `dimension` is that of the unit it was written with, if any."""

    value: Fraction
    span: Span | None = _span()
    dimension: Dimension | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ParameterRef:
    """The value of a parameter of the program."""

    name: str
    span: Span | None = _span()


@dataclass(frozen=True, slots=True)
class Landmark:
    """A named arc length (m) on an actor's route.

    `actor` None means the actor whose position it is compared with; `other` names the second actor of a conflict point
    where there are more than two. Resolving fills in both; `written` is then what the user wrote, and is printed.
    With a `frame` the place is meant along the route of that actor instead, on the lanes that both drive on.
    """

    name: str
    actor: int | None = None
    other: int | None = None
    span: Span | None = _span()
    frame: int | None = None
    written: str | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Knot:
    """A knot of the actor whose state is asked for."""

    name: str


@dataclass(frozen=True, slots=True)
class PieceRef:
    """A whole piece of the actor's sketch, such as ``dec`` or, where there are several, ``dec2``."""

    name: str


@dataclass(frozen=True, slots=True)
class Elapsed:
    """The time (s) from the start of the scenario to a knot of an actor: ``A1(t1)``."""

    actor: int
    knot: str
    span: Span | None = _span()


# A moment: a knot of the same actor, a knot of another actor, a concrete time, a piece, or (None) the moment of
# evaluation.
At = Knot | PieceRef | Elapsed | Number | None


@dataclass(frozen=True, slots=True)
class State:
    """Position (order 0, m), speed (1, m/s) or acceleration (2, m/s^2) of an actor along its route.

    With a `frame` the position is meant along the route of that actor instead, on the lanes that both drive on.
    """

    actor: int
    order: Order
    at: At
    span: Span | None = _span()
    frame: int | None = None


DerivedKind = Literal["gap", "freespace", "tta", "ttc", "headway"]


@dataclass(frozen=True, slots=True)
class Derived:
    """A quantity computed from states at one moment.

    ``gap(A0, A1, t)``: how far A1 is ahead of A0 (m, between reference points). ``freespace(A0, A1, t)``: what lies
    between their bodies then (m). ``tta(A0, landmark, t)``: distance over speed (s). ``ttc(A0, A1, t)``: what lies
    between their bodies over the closing speed (s). ``headway(A0, A1, t)``: the same over A0's speed (s).
    The moment is a knot of the first actor, another actor's knot, or a time.
    """

    kind: DerivedKind
    actor: int
    target: int | Landmark
    at: At
    span: Span | None = _span()


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """Sum, difference, product or quotient."""

    operator: Literal["+", "-", "*", "/"]
    left: Term
    right: Term
    span: Span | None = _span()


@dataclass(frozen=True, slots=True)
class Negate:
    """The negative of a term."""

    operand: Term
    span: Span | None = _span()


Term = Number | ParameterRef | Landmark | Elapsed | State | Derived | Arithmetic | Negate


@dataclass(frozen=True, slots=True)
class Compare:
    """A comparison of two terms of the same dimension."""

    operator: ComparisonOperator
    left: Term
    right: Term
    span: Span | None = _span()


@dataclass(frozen=True, slots=True)
class Logic:
    """``and``, ``or``, ``not`` (one operand) or ``implies`` (two)."""

    operator: Literal["and", "or", "not", "implies"]
    operands: tuple[Formula, ...]
    span: Span | None = _span()


@dataclass(frozen=True, slots=True)
class Temporal:
    """``always``, ``never`` or ``eventually`` within ``[start, end]``; states in the body have no moment of their own.

    A state without a moment is that of the instant at which the body is looked at.
    """

    operator: Literal["always", "never", "eventually"]
    start: Term
    end: Term
    body: Formula
    span: Span | None = _span()


Formula = Compare | Logic | Temporal
Node = Term | Formula


def children(node: Node) -> tuple[Node, ...]:
    """Return the direct sub-expressions of `node`, left to right."""
    match node:
        case Arithmetic(left=left, right=right) | Compare(left=left, right=right):
            return (left, right)
        case Negate(operand=operand):
            return (operand,)
        case Logic(operands=operands):
            return operands
        case Temporal(start=start, end=end, body=body):
            return (start, end, body)
        case State(at=Elapsed() as at) | Derived(at=Elapsed() as at, target=int()):
            return (at,)
        case Derived(target=Landmark() as target, at=at):
            return (target, at) if isinstance(at, Elapsed) else (target,)
        case _:
            return ()


def walk(node: Node) -> Iterator[Node]:
    """Yield `node` and everything below it, depth first, left to right."""
    waiting = [node]
    while waiting:
        node = waiting.pop()
        yield node
        waiting.extend(reversed(children(node)))


def node_ids(root_id: str, node: Node) -> Iterator[tuple[str, Node]]:
    """Yield every node with a stable id: the constraint's id and the path of child numbers to it (``c3.0.1``)."""
    yield root_id, node
    for index, child in enumerate(children(node)):
        yield from node_ids(f"{root_id}.{index}", child)


def piece_of(formula: Formula) -> State | None:
    """Return the state in a comparison that is asked of a whole piece."""
    if not isinstance(formula, Compare):
        return None
    return next((n for n in walk(formula) if isinstance(n, State) and isinstance(n.at, PieceRef)), None)


def at_each_moment(formula: Compare, state: State) -> Compare:
    """Return what a comparison asks at each moment of a piece, where it asks it of a state in the whole piece."""
    found: Compare = exchanged(formula, lambda node: node == state, replace(state, at=None))
    return found


def exchanged(node: Any, goes: Callable[[Node], bool], other: Term) -> Any:
    """Return a term or formula with `other` in place of each term that goes; it is not looked for in edges of time."""
    if goes(node):
        return other
    match node:
        case Arithmetic(left=left, right=right) | Compare(left=left, right=right):
            return replace(node, left=exchanged(left, goes, other), right=exchanged(right, goes, other))
        case Negate(operand=operand):
            return replace(node, operand=exchanged(operand, goes, other))
        case Logic(operands=operands):
            return replace(node, operands=tuple(exchanged(each, goes, other) for each in operands))
        case Temporal(body=body):
            return replace(node, body=exchanged(body, goes, other))
    return node
