"""Evaluates SMT-LIB terms exactly: a second reading of what the motion algebra writes, apart from any solver."""

from __future__ import annotations

import itertools
import operator
import re
from collections.abc import Mapping
from fractions import Fraction
from functools import reduce

_TOKEN = re.compile(r"[()]|[^\s()]+")
_ARITHMETIC = {"+": operator.add, "*": operator.mul, "/": operator.truediv}
_COMPARE = {"=": operator.eq, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}

Expression = str | list["Expression"]


def read(text: str) -> Expression:
    """Return the nested lists that `text` stands for."""
    stack: list[list[Expression]] = [[]]
    for token in _TOKEN.findall(text):
        if token == "(":
            stack.append([])
        elif token == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(token)
    ((expression,),) = stack
    return expression


def value(text: str | Expression, known: Mapping[str, Fraction]) -> Fraction | bool:
    """Return the value of a term or condition with `known` values of its unknowns."""
    expression = read(text) if isinstance(text, str) else text
    if isinstance(expression, str):
        return known[expression] if expression in known else Fraction(expression)
    head, *rest = expression
    assert isinstance(head, str)
    if head == "ite":
        return _of(rest[1] if _of(rest[0], known) else rest[2], known)
    if head in ("and", "or"):
        return (all if head == "and" else any)(_of(part, known) for part in rest)
    if head == "not":
        return not _of(rest[0], known)
    values = [_of(part, known) for part in rest]
    if head == "-":
        return -values[0] if len(values) == 1 else reduce(operator.sub, values)
    if head in _COMPARE:
        return all(_COMPARE[head](a, b) for a, b in itertools.pairwise(values))
    return reduce(_ARITHMETIC[head], values)


def _of(expression: Expression, known: Mapping[str, Fraction]) -> Fraction | bool:
    if isinstance(expression, str):
        return known[expression] if expression in known else Fraction(expression)
    return value(expression, known)
