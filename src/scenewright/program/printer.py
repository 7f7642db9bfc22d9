"""Prints a program in its text form; `text.parse_program` reads it back to equal data.

What enters: a `Program` or one of its expressions. What leaves: text. It decides nothing.
"""

from __future__ import annotations

import re

from scenewright.program import expressions as ex
from scenewright.program.manner import NUMBERS
from scenewright.program.types import (
    Actor,
    Constraint,
    HeadingsRoute,
    IntentRoute,
    LanesRoute,
    Parameter,
    Program,
    RouteSpec,
)
from scenewright.units import format_fraction

_NAME = r"[A-Za-z_][A-Za-z0-9_]*"  # any other stands in quotes
_PRECEDENCE = {"implies": 1, "or": 2, "and": 3, "not": 4, "compare": 5, "+": 6, "-": 6, "*": 7, "/": 7, "neg": 8}


def print_program(program: Program) -> str:
    """Return the text form of `program`; parsing it gives an equal program."""
    lines = [f'scenario "{_escape(program.name)}"', f'map "{_escape(program.map_name)}"']
    if program.description is not None:
        lines += ["description:", f'"{_escape(program.description)}"']
    if program.parameters:
        lines += ["", "parameters:"]
        lines += [_parameter(parameter) for parameter in program.parameters]
    lines += ["", "manner:"]
    lines += [f"- {name} = {format_fraction(getattr(program.manner, name))}" for name in NUMBERS]
    for actor in program.actors:
        lines += ["", *_actor(actor)]
    lines += ["", "Constraints:"]
    lines += [_constraint(constraint, f"c{index}") for index, constraint in enumerate(program.constraints, start=1)]
    return "\n".join(lines) + "\n"


def print_expression(node: ex.Node) -> str:
    """Return the text form of one formula or term."""
    match node:
        case ex.Number(value=value):
            return format_fraction(value)
        case ex.ParameterRef(name=name):
            return name
        case ex.Landmark(written=str() as written):
            return written
        case ex.Landmark(name=name, actor=actor, other=other):
            prefix = "" if actor is None else f"A{actor}."
            return f"{prefix}{name}" + ("" if other is None else f"(A{other})")
        case ex.Elapsed(actor=actor, knot=knot):
            return f"A{actor}({knot})"
        case ex.State(actor=actor, order=order, at=at):
            return f"A{actor}{ex.ORDER_LETTERS[order]}" + ("" if at is None else f"({_moment(at)})")
        case ex.Derived(kind=kind, actor=actor, target=target, at=at):
            aim = f"A{target}" if isinstance(target, int) else print_expression(target)
            return f"{kind}(A{actor}, {aim}" + ("" if at is None else f", {_moment(at)}") + ")"
        case ex.Arithmetic(operator=operator, left=left, right=right):
            rank = _PRECEDENCE[operator]
            return f"{_wrap(left, rank)} {operator} {_wrap(right, rank + 1)}"
        case ex.Negate(operand=operand):
            return f"-{_wrap(operand, _PRECEDENCE['neg'])}"
        case ex.Compare(operator=operator, left=left, right=right):
            return f"{print_expression(left)} {operator} {print_expression(right)}"
        case ex.Logic(operator="not", operands=operands):
            return f"not {_wrap(operands[0], _PRECEDENCE['not'])}"
        case ex.Logic(operator=operator, operands=operands):
            rank = _PRECEDENCE[operator]
            return f" {operator} ".join(_wrap(operand, rank + 1) for operand in operands)
        case ex.Temporal(operator=operator, start=start, end=end, body=body):
            return f"{operator}[{print_expression(start)}, {print_expression(end)}]({print_expression(body)})"


def print_route(route: RouteSpec) -> str:
    """Return the text form of a route specification."""
    match route:
        case HeadingsRoute(headings=headings):
            return ", ".join(headings)
        case LanesRoute(lanes=lanes):
            return "lanes " + ", ".join(lanes)
        case IntentRoute():
            origin = f" {route.origin}" if route.origin else ""
            origin += f" headed {route.origin_heading}" if route.origin_heading else ""
            aim = f" {route.turn}" if route.turn else ""
            aim += f" into {route.destination}" if route.destination else ""
            aim += f" headed {route.destination_heading}" if route.destination_heading else ""
            return f"from{origin}" + (f",{aim}" if aim else "")


def _wrap(node: ex.Node, at_least: int) -> str:
    text = print_expression(node)
    return text if _rank(node) >= at_least else f"({text})"


def _rank(node: ex.Node) -> int:
    match node:
        case ex.Arithmetic(operator=operator):
            return _PRECEDENCE[operator]
        case ex.Negate():
            return _PRECEDENCE["neg"]
        case ex.Compare():
            return _PRECEDENCE["compare"]
        case ex.Logic(operator=operator):
            return _PRECEDENCE[operator]
        case ex.Number(value=value) if value.denominator != 1 and "/" in format_fraction(value):
            return _PRECEDENCE["/"]
        case _:
            return 9


def _moment(at: ex.At) -> str:
    match at:
        case ex.Knot(name=name) | ex.PieceRef(name=name):
            return name
        case None:
            return ""
        case _:
            return print_expression(at)


def _parameter(parameter: Parameter) -> str:
    text = f"- {parameter.name}"
    if parameter.value is not None:
        text += f" = {format_fraction(parameter.value)}"
    if parameter.low is not None or parameter.high is not None:
        low, high = parameter.bounds()
        text += f" in [{format_fraction(low)}, {format_fraction(high)}]"
    return text


def _actor(actor: Actor) -> list[str]:
    steps = [actor.sketch.knots[0]]
    for piece, knot in zip(actor.sketch.pieces, actor.sketch.knots[1:], strict=True):
        steps += [str(piece), knot]
    name = actor.name if re.fullmatch(_NAME, actor.name) else f'"{_escape(actor.name)}"'
    return [f"Actor {actor.id} ({name}):", f"- {print_route(actor.route)}", f"- [{', '.join(steps)}]"]


def _constraint(constraint: Constraint, automatic_id: str) -> str:
    label = "" if constraint.id == automatic_id else f"{constraint.id}: "
    source = "" if constraint.source is None else f"  @{constraint.source.start}..{constraint.source.end}"
    return f"{label}{print_expression(constraint.formula)}{source}"


def _escape(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


__all__ = ["print_expression", "print_program", "print_route"]
