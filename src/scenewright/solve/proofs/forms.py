"""What a formula is like: what it speaks of, how it falls into parts, and which tight tolerance it is compared with.

What enters: formulas of a program. What leaves: their parts, or the same said without denials. It lowers nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.program.types import Program
from scenewright.units import Dimension

# The tight tolerances of the contract, exact, by what is compared (m, s, m/s, m/s^2).
TIGHT: dict[Dimension, Fraction] = {
    "length": Fraction(1, 2),
    "time": Fraction(1, 10),
    "speed": Fraction(1, 4),
    "acceleration": Fraction(1, 4),
}
_OF_ORDER: tuple[Dimension, ...] = ("length", "speed", "acceleration")
_OF_DERIVED: dict[str, Dimension] = {
    "gap": "length", "freespace": "length", "tta": "time", "ttc": "time", "headway": "time",
}  # fmt: skip


def asserted(formula: ex.Formula, program: Program, denied: bool = False) -> ex.Formula:
    """Return a formula, or its contrary, as `and`, `or`, `always` and `eventually` of comparisons and nothing else.

    A place or a speed of a piece is one that is always so between its ends; the rate of a piece stays one.
    """
    match formula:
        case ex.Logic(operator="not", operands=(inner,)):
            return asserted(inner, program, not denied)
        case ex.Logic(operator=operator, operands=operands):
            contrary = [denied != (operator == "implies" and number == 0) for number in range(len(operands))]
            parts = (asserted(part, program, each) for part, each in zip(operands, contrary, strict=True))
            return ex.Logic("and" if (operator == "and") != denied else "or", tuple(parts))
        case ex.Temporal(operator=operator, body=body):
            lasting = (operator != "eventually") != denied
            body = asserted(body, program, (operator == "never") != denied)
            return replace(formula, operator="always" if lasting else "eventually", body=body)
        case ex.Compare() if (node := ex.piece_of(formula)) is not None and node.order != 2:
            assert isinstance(node.at, ex.PieceRef)
            ends = program.actor(node.actor).sketch.piece_ends(node.at.name)
            first, last = (ex.Elapsed(node.actor, knot) for knot in ends)
            body = ex.at_each_moment(formula, node)
            return asserted(ex.Temporal("always", first, last, body), program, denied)
        case ex.Compare(operator="==") if denied:
            return ex.Logic("or", (replace(formula, operator="<"), replace(formula, operator=">")))
        case ex.Compare() if denied:
            return replace(formula, operator=ex.CONTRARY[formula.operator])
    return formula


def lasting_places(program: Program) -> Iterator[ex.Temporal]:
    """Yield what a program says that always holds for some time, and not of speeds and rates alone."""
    for node in (node for each in program.constraints for node in ex.walk(asserted(each.formula, program))):
        if isinstance(node, ex.Temporal) and node.operator == "always":
            free = (each for each in ex.walk(node.body) if isinstance(each, ex.State | ex.Derived) and each.at is None)
            if any(isinstance(each, ex.Derived) or each.order == 0 for each in free):
                yield node


def free_actors(body: ex.Formula) -> set[int]:
    """Return whose state a body speaks of at the moment at which it is looked at."""
    free = (node for node in ex.walk(body) if isinstance(node, ex.State | ex.Derived) and node.at is None)
    return {actor for node in free for actor in actors_at(node)}


def actors_at(node: ex.State | ex.Derived) -> tuple[int, ...]:
    """Return whose state it is: one actor's, or two."""
    if isinstance(node, ex.Derived) and isinstance(node.target, int):
        return node.actor, node.target
    return (node.actor,)


def compared_dimension(formula: ex.Node) -> Dimension:
    """Return the dimension of what a comparison compares, told from the first state or derived quantity in it."""
    for node in ex.walk(formula):
        if isinstance(node, ex.State):
            return _OF_ORDER[node.order]
        if isinstance(node, ex.Derived):
            return _OF_DERIVED[node.kind]
    return "time"
