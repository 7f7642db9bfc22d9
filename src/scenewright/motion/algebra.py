"""Numbers and symbols under one set of operators, so that motion is written once for both.

What enters: exact rationals, floats and names of unknowns. What leaves: values that add, multiply and compare; with
symbols the result is SMT-LIB text. Constants fold, so a formula over known numbers is a number. It knows nothing of
motion.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

# Pinned measurements carry at most this many decimals: exact solvers pay for every digit (0.1 mm, 0.1 mm/s).
_PINNED_DECIMALS = 4


def pin(value: float | Fraction) -> Fraction:
    """Round a measured number to the rational that a solver is given. The only place where rounding happens."""
    return Fraction(round(float(value) * 10**_PINNED_DECIMALS), 10**_PINNED_DECIMALS)


class Symbol:
    """An expression over unknowns, kept as SMT-LIB text. Supports ``+ - *`` and division by constants."""

    __slots__ = ("text",)

    def __init__(self, text: str) -> None:
        self.text = text

    def __add__(self, other: Value) -> Value:
        return self if _is_zero(other) else Symbol(f"(+ {self.text} {smt(other)})")

    def __radd__(self, other: Value) -> Value:
        return self if _is_zero(other) else Symbol(f"(+ {smt(other)} {self.text})")

    def __sub__(self, other: Value) -> Value:
        return self if _is_zero(other) else Symbol(f"(- {self.text} {smt(other)})")

    def __rsub__(self, other: Value) -> Value:
        return Symbol(f"(- {self.text})") if _is_zero(other) else Symbol(f"(- {smt(other)} {self.text})")

    def __mul__(self, other: Value) -> Value:
        if not isinstance(other, Symbol):
            if other == 0:
                return Fraction(0)
            if other == 1:
                return self
        return Symbol(f"(* {smt(other)} {self.text})")

    __rmul__ = __mul__

    def __neg__(self) -> Value:
        return Symbol(f"(- {self.text})")

    def __repr__(self) -> str:
        return f"Symbol({self.text})"


Value = Fraction | int | Symbol
Condition = bool | str


def smt(value: Value | float) -> str:
    """Return `value` as an SMT-LIB real term."""
    if isinstance(value, Symbol):
        return value.text
    number = value if isinstance(value, Fraction) else Fraction(value)
    size = abs(number)
    text = f"{size.numerator}.0" if size.denominator == 1 else f"(/ {size.numerator}.0 {size.denominator}.0)"
    return f"(- {text})" if number < 0 else text


def compare(operator: str, left: Value, right: Value) -> Condition:
    """Return ``left operator right`` as a truth value where both are known, else as SMT-LIB text."""
    if isinstance(left, Symbol) or isinstance(right, Symbol):
        return f"({'=' if operator == '==' else operator} {smt(left)} {smt(right)})"
    match operator:
        case "==":
            return left == right
        case "<=":
            return left <= right
        case ">=":
            return left >= right
        case "<":
            return left < right
        case _:
            return left > right


def conjunction(conditions: Iterable[Condition]) -> Condition:
    """Return the conjunction; true where there is nothing to hold."""
    return _joined("and", conditions, absorbing=False)


def disjunction(conditions: Iterable[Condition]) -> Condition:
    """Return the disjunction; false where there is nothing to choose from."""
    return _joined("or", conditions, absorbing=True)


def negation(condition: Condition) -> Condition:
    """Return the negation."""
    return not condition if isinstance(condition, bool) else f"(not {condition})"


def select(condition: Condition, then: Value, otherwise: Value) -> Value:
    """Return `then` where `condition` holds, else `otherwise` (the ``If`` of the paper's algorithm 2)."""
    if isinstance(condition, bool):
        return then if condition else otherwise
    return Symbol(f"(ite {condition} {smt(then)} {smt(otherwise)})")


def _joined(word: str, conditions: Iterable[Condition], absorbing: bool) -> Condition:
    texts: list[str] = []
    for condition in conditions:
        if isinstance(condition, bool):
            if condition is absorbing:
                return absorbing
        else:
            texts.append(condition)
    if not texts:
        return not absorbing
    return texts[0] if len(texts) == 1 else f"({word} {' '.join(texts)})"


def _is_zero(value: Value) -> bool:
    return not isinstance(value, Symbol) and value == 0
