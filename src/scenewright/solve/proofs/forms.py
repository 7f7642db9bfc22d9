"""What a formula is like: what it speaks of, and how it falls into parts.

What enters: formulas of a program. What leaves: their parts. It knows no scene and lowers nothing.
"""

from __future__ import annotations

from collections.abc import Iterator

from scenewright.program import expressions as ex


def bare_rate(body: ex.Formula) -> ex.State | None:
    """Return the rate that a body compares with something else, where that is all it says."""
    if isinstance(body, ex.Logic) and body.operator == "not":
        inner = body.operands[0]
        return bare_rate(inner) if isinstance(inner, ex.Compare) and inner.operator != "==" else None
    if not isinstance(body, ex.Compare):
        return None
    for side, other in ((body.left, body.right), (body.right, body.left)):
        if isinstance(side, ex.State) and side.order == 2 and side.at is None:
            plain = not any(isinstance(node, ex.State | ex.Derived) for node in ex.walk(other))
            return side if plain else None
    return None


def kept(formula: ex.Temporal) -> ex.Formula:
    """Return what holds all along where something always or never does."""
    return formula.body if formula.operator == "always" else ex.Logic("not", (formula.body,))


def conjuncts(body: ex.Formula) -> tuple[ex.Formula, ...] | None:
    """Return the parts of a body that each hold all along; None where it is not made of such."""
    match body:
        case ex.Logic(operator="and", operands=operands):
            return operands
        case ex.Logic(operator="not", operands=(ex.Logic(operator="or", operands=operands),)):
            return tuple(ex.Logic("not", (operand,)) for operand in operands)
        case ex.Logic(operator="not", operands=(ex.Logic(operator="not", operands=(inner,)),)):
            return (inner,)
        case _:
            return None


def free_actors(body: ex.Formula) -> set[int]:
    """Return whose state a body speaks of at the moment at which it is looked at."""
    return {actor for node in free_states(body) for actor in actors_at(node)}


def free_states(body: ex.Node) -> Iterator[ex.State | ex.Derived]:
    """Yield the states in a body that have no moment of their own."""
    return (node for node in ex.walk(body) if isinstance(node, ex.State | ex.Derived) and node.at is None)


def actors_at(node: ex.State | ex.Derived) -> tuple[int, ...]:
    """Return whose state it is: one actor's, or two."""
    if isinstance(node, ex.Derived) and isinstance(node.target, int):
        return node.actor, node.target
    return (node.actor,)
