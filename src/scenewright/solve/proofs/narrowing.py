"""Narrower laws: what bounds on a speed or a rate over a stretch of time make of the law of motion there.

What enters: a lowering, for its moments, and a constraint. What leaves: `Narrowing`s. Forms that are none of these are
held at moments alone, by the lowering itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from scenewright.algebra.polynomials import ZERO
from scenewright.motion.laws import ANY, Law
from scenewright.program import expressions as ex

if TYPE_CHECKING:
    from scenewright.solve.proofs.lowering import Lowering

_RATE_ROOM_MPSS = Fraction(1, 1000)  # for numbers that were rounded; half of what a witness may be off


@dataclass(frozen=True, slots=True)
class Narrowing:
    """A narrower law for an actor between two instants: that of a piece, or what a constraint makes of it.

    Attributes
    ----------
    law
        What a plan keeps to.
    proven
        What every legal motion keeps to, where that is less: that the rate of a piece lasts all through it is for
        plans, what is proven of a piece is proven of its mean rate.
    """

    actor: int
    first: int
    last: int
    law: Law
    proven: Law | None = None
    place: int | None = None  # the moment at a place that it holds from, or up to, within first and last
    place_m: Fraction = ZERO
    up_to_place: bool = False
    even: bool = False  # whether a plan keeps to one rate between each two moments
    origin: str = ""  # the constraint that it comes from, by id; of a piece what it is, in words
    said: ex.Formula | None = None  # what it makes superfluous between its ends

    def begins(self) -> tuple[int, ...]:
        """Return the moments of which the latest is its beginning."""
        return (self.first,) if self.place is None or self.up_to_place else (self.first, self.place)

    def ends(self) -> tuple[int, ...]:
        """Return the moments of which the earliest is its end."""
        return (self.last, self.place) if self.place is not None and self.up_to_place else (self.last,)


def narrowings_of(lowering: Lowering, formula: ex.Formula) -> Iterator[Narrowing]:
    """Yield the laws that bounds on a speed or a rate over a stretch of time make narrower.

    What is past a place or else bounded, is bounded up to there.
    """
    match formula:
        case ex.Logic(operator="and", operands=operands):
            for operand in operands:
                yield from narrowings_of(lowering, operand)
        case ex.Temporal() if (early := lowering.ends_early(formula)) is not None and early.constant is not None:
            return  # it was over when the run began
        case ex.Temporal(operator="always", body=ex.Logic(operator="and", operands=operands)):
            for operand in operands:
                yield from narrowings_of(lowering, replace(formula, body=operand))
        case ex.Temporal(operator="always", body=ex.Logic(operator="or", operands=(past, then))):
            place, law = _place_of(lowering, past), _law_of(lowering, then)
            if place is not None and law is not None and law[0] == place[0]:
                made = lowering.events.at_place(*place[:2])
                proven = law[1] if lowering.ends_early(formula) is None else None
                yield Narrowing(law[0], *lowering.stretch_of(formula), law[1], proven, made, *place[1:])
        case ex.Temporal(operator="always", body=body) if law := _law_of(lowering, body):
            proven = law[1] if lowering.ends_early(formula) is None else None
            yield Narrowing(law[0], *lowering.stretch_of(formula), law[1], proven, said=body)
        case ex.Compare() if (node := ex.piece_of(formula)) is not None and isinstance(node.at, ex.PieceRef):
            ends = lowering.piece_ends(node.actor, node.at.name)
            if formula.operator == "==":  # a rate that is one number is one all through
                yield Narrowing(node.actor, *ends, ANY, even=True)
            if law := _law_of(lowering, ex.at_each_moment(formula, node)):
                yield Narrowing(law[0], *ends, law[1])


def _law_of(lowering: Lowering, body: ex.Formula) -> tuple[int, Law] | None:
    """Return whose law a body bounds and how, where it compares a speed or a rate with a number."""
    match body:
        case ex.Compare(left=ex.State(order=(1 | 2) as order, at=None, actor=actor), right=right):
            operator: str = body.operator
        case ex.Compare(left=right, right=ex.State(order=(1 | 2) as order, at=None, actor=actor)):
            operator = ex.FLIPPED[body.operator]
        case _:
            return None
    if (bound := _constant(lowering, right)) is None:
        return None
    room = _RATE_ROOM_MPSS if order == 2 else ZERO
    name = "rate" if order == 2 else "speed"
    bounds = {}
    if operator in (">", ">=", "=="):
        bounds[f"{name}_low"] = bound - room
    if operator in ("<", "<=", "=="):
        bounds[f"{name}_high"] = bound + room
    return actor, replace(ANY, **bounds)


def _place_of(lowering: Lowering, formula: ex.Formula) -> tuple[int, Fraction, bool] | None:
    """Return actor and place (m) of "is past a place" (True) or "is before it"; None for anything else."""
    match formula:
        case ex.Compare("<=" | "<" | ">=" | ">", ex.State(order=0, at=None, actor=actor), place):
            found = _constant(lowering, place)
            return None if found is None else (actor, found, formula.operator in (">", ">="))
    return None


def _constant(lowering: Lowering, term: ex.Term) -> Fraction | None:
    if any(isinstance(node, ex.State | ex.Derived | ex.Elapsed) for node in ex.walk(term)):
        return None
    top, below = lowering.plain(term)
    if top.constant is None or not below.constant:
        return None
    return top.constant / below.constant
