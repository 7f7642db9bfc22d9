"""Numbers and parameters of a description and of a program, compared: none may get lost, none may come from nowhere.

What enters: a description, a program, the assumptions that account for a difference. What leaves: faults as sentences.
It compares sizes only; what a number is used for is for people to check in the reading-back.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from fractions import Fraction

from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.program.expressions import Number, walk
from scenewright.program.types import Program
from scenewright.units import UNITS, unit_of_name

_PARAMETER = re.compile(r"(?<![A-Za-z0-9_])[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)+(?![A-Za-z0-9_])")
_NUMBER = re.compile(r"(?<![\w.,/])(\d{1,9}(?:[.,]\d{1,9})?)")
_WORDS = {
    "m": "m|met(?:er|re)s?", "km": "km|kilomet(?:er|re)s?", "cm": "cm|centimet(?:er|re)s?", "ft": "ft|feet|foot",
    "yd": "yds?|yards?", "mi": "mi|miles?", "s": "s|secs?|seconds?", "ms": "ms|milliseconds?", "min": "min|minutes?",
    "m/s": "m/s|mps|met(?:er|re)s? per second", "km/h": "km/h|kph|kmh|kmph|kilomet(?:er|re)s? (?:per|an) hour",
    "mph": "mph|miles? (?:per|an) hour", "ft/s": "ft/s|fps|f(?:ee|oo)t per second", "g": "g",
    "m/s^2": r"m/s\^?2|m/s²|mps2|mpss|met(?:er|re)s? per second squared", "ft/s^2": r"ft/s\^?2|ft/s²",
}  # fmt: skip
_AMOUNT = re.compile(
    _NUMBER.pattern + r"[\s-]{0,3}(?:" + "|".join(sorted(_WORDS.values(), key=len, reverse=True)) + r")(?![\w/^])",
    re.IGNORECASE,
)
_UNITS_IN_WORDS = (
    "zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve",
    "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen",
)  # fmt: skip
_TENS_IN_WORDS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
_NUMERALS = {
    **{word: Fraction(value) for value, word in enumerate(_UNITS_IN_WORDS)},
    **{word: Fraction(10 * value) for value, word in enumerate(_TENS_IN_WORDS, start=2)},
    **{"hundred": Fraction(100), "half": Fraction(1, 2), "quarter": Fraction(1, 4), "dozen": Fraction(12)},
    **{"a": Fraction(1), "an": Fraction(1), "couple": Fraction(2), "once": Fraction(1), "twice": Fraction(2)},
}
_JOINTS = ("and", "point")
_QUOTIENT = re.compile(r"(?<![\w.,/])(\d{1,4})\s?/\s?(\d{1,4})(?![\w/])")
_NEAR = Fraction(1, 200)


def amount_faults(description: str, program: Program, accounts: Iterable[str]) -> Iterator[str]:
    """Yield what of the amounts of `description` is missing in `program`, and what in it is not in the description.

    Parameters
    ----------
    accounts
        Assumptions and questions: an amount that one of them names is accounted for.
    """
    told = " ".join(accounts)
    written = [node.value for c in program.constraints for node in walk(c.formula) if isinstance(node, Number)]
    written += [p.value * p.unit.si_factor for p in program.parameters if p.value is not None]
    named = {parameter.name for parameter in program.parameters}
    yield from _parameter_faults(description, named, told)
    # A number may be part of a calculation; where the program has none of its size, it must be accounted for.
    for match in _AMOUNT.finditer(description):
        found = any(_same(size, value) for size in _sizes(match[1]) for value in written)
        if not found and not _mentions(told, match[1]):
            yield f"'{match[0].strip()}' of the description is neither in the program nor in an assumption"
    known = [JUST_BEFORE_M, Fraction(0), *_known_sizes(description)]
    for value in dict.fromkeys(written):
        if not any(_same(size, value) for size in known) and not _accounted(told, value):
            yield f"the number {float(value):g} of the program is neither in the description nor in an assumption"


def _parameter_faults(description: str, named: set[str], told: str) -> Iterator[str]:
    said = {match[0] for match in _PARAMETER.finditer(description) if unit_of_name(match[0]) is not None}
    for name in sorted(said - named):
        if not _mentions(told, name):
            yield f"the parameter {name} of the description is neither in the program nor in an assumption"
    for name in sorted(named - said):
        if not _mentions(told, name):
            yield f"the parameter {name} of the program is neither in the description nor in an assumption"


def _mentions(told: str, word: str) -> bool:
    return re.search(rf"(?<![\w.]){re.escape(word)}(?![\w]|\.\d)", told) is not None


def _accounted(told: str, value: Fraction) -> bool:
    return any(_same(size, value) for match in _NUMBER.finditer(told) for size in _sizes(match[1]))


def _known_sizes(description: str) -> Iterator[Fraction]:
    """Yield every size that some number of the description could stand for, in any unit."""
    for match in _NUMBER.finditer(description):
        yield from _sizes(match[1])
    values = [Fraction(int(over), int(under)) for over, under in _QUOTIENT.findall(description) if int(under)]
    for whole, sign in re.findall(r"(\d{0,6})\s?([½¼¾⅓⅔])", description):
        values.append(Fraction(whole or 0) + Fraction(unicodedata.numeric(sign)).limit_denominator(4))
    values += _in_words(re.findall(r"[a-z]+", description.lower()))
    yield from (value * unit.si_factor for value in dict.fromkeys(values) for unit in UNITS.values())


def _in_words(words: list[str]) -> Iterator[Fraction]:
    """Yield what numbers in words come to: "a hundred and twenty", "three point five", "one and a half"."""
    run: list[str] = []
    for word in [*words, ""]:
        if word in _NUMERALS or word in _JOINTS:
            run.append(word)
            continue
        for first in range(len(run)):
            for last in range(first + 1, min(len(run), first + 8) + 1):
                yield _value_in_words(run[first:last])
        run = []


def _value_in_words(words: list[str]) -> Fraction:
    total, digits = Fraction(0), None
    counted = [word for word in words if word not in ("a", "an", "and")]
    if not counted:
        return Fraction(1)
    for word in counted:
        value = _NUMERALS.get(word, Fraction(0))
        if word == "point":
            digits = Fraction(1, 10)
        elif digits is not None:
            total, digits = total + value * digits, digits / 10
        elif word == "hundred":
            total = (total or Fraction(1)) * 100
        else:
            total += value
    return total


def _sizes(digits: str) -> list[Fraction]:
    """Return what `digits` may come to in SI units: a comma is a decimal one, or one between thousands."""
    readings = {Fraction(digits.replace(",", "."))}
    if re.fullmatch(r"\d{1,3},\d{3}", digits):
        readings.add(Fraction(digits.replace(",", "")))
    return [value * unit.si_factor for value in readings for unit in UNITS.values()]


def _same(one: Fraction, other: Fraction) -> bool:
    return abs(abs(one) - abs(other)) <= _NEAR * max(abs(one), abs(other))
