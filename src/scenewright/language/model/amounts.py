"""Amounts in words: which numbers, units and parameters a stretch of text can be read as.

What enters: words. What leaves: amounts, by the units of the vocabulary; and where a text speaks of numbers at all.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from fractions import Fraction

from scenewright.errors import Span
from scenewright.language.read.chunks import vocabulary
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.units import unit_of_name

_ONES = (
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen "
    "eighteen nineteen"
)
_TENS = "twenty thirty forty fifty sixty seventy eighty ninety"
_NUMERALS = {word: Fraction(number) for number, word in enumerate(_ONES.split())}
_NUMERALS |= {word: Fraction(10 * tens) for tens, word in enumerate(_TENS.split(), start=2)}
_NUMERALS |= {"half": Fraction(1, 2), "quarter": Fraction(1, 4), "couple": Fraction(2)}
_WORD = rf"(?:{'|'.join(_NUMERALS)}|hundred|point|an?)"
_RUN = re.compile(rf"(?i)\b{_WORD}(?:[\s-]+(?:and[\s-]+)?{_WORD})*\b")
_NUMBER = re.compile(r"(?<![\w.^/])-?\d+(?:[.,]\d+|/[1-9]\d*)*")
_PARAMETER = re.compile(r"(?<!\w)[A-Za-z]\w*_\w+")
_SHARE = re.compile(r"(\d*)\s?([¼½¾⅓⅔])")
_SPELLED = {
    r"met(?:re|er)s? per second (?:squared|per second)": "m/s^2", r"met(?:re|er)s? (?:per|a) second": "m/s",
    r"kilomet(?:re|er)s? (?:per|an) hour": "km/h", r"miles? (?:per|an) hour": "mph",
}  # fmt: skip


def read_amounts(words: str) -> set[tuple[Fraction | str, str | None]]:
    """Return what `words` can be read as: numbers and parameters, each with its unit where one follows.

    Examples
    --------
    >>> read_amounts("twenty-five metres") == {(Fraction(25), "m"), (Fraction(5), "m")}
    True
    """
    found: set[tuple[Fraction | str, str | None]] = set()
    for match in _PARAMETER.finditer(words):
        if unit := unit_of_name(match[0]):
            found.add((match[0], unit.symbol))
    if re.search(r"(?i)\b(?:just|right) before\b", words):
        found.add((JUST_BEFORE_M, "m"))
    for match in _SHARE.finditer(words):
        share = Fraction(unicodedata.numeric(match[2])).limit_denominator(4)
        found.add((Fraction(match[1] or 0) + share, _unit_at(words[match.end() :])))
    for match in _NUMBER.finditer(words):  # a comma is a decimal one, or one between thousands
        readings = {match[0].replace(",", "."), match[0].replace(",", "")}
        plain = [each for each in readings if each.count(".") < 2 and each.count("/") < 2]
        found |= {(Fraction(each), _unit_at(words[match.end() :])) for each in plain}
    for match in _RUN.finditer(words):
        said = re.findall(r"[a-z]+", match[0].lower())
        found |= {(_value(said[first:]), _unit_at(words[match.end() :])) for first in range(len(said))}
    return found


def _unit_at(rest: str) -> str | None:
    """Return the unit that `rest` begins with."""
    rest = re.sub(r"(?i)^\W*(?:of (?:an? )?|an? )?", "", rest)
    for spelled, unit in _SPELLED.items():
        if re.match(rf"(?i){spelled}\b", rest):
            return unit
    match = re.match(r"[^\s,;:!?()}]+", rest)
    said, known = match[0].rstrip(".'") if match else "", vocabulary().units
    return known.get(said) or known.get(said.lower())


def _value(words: list[str]) -> Fraction:
    total, share = Fraction(0), None
    for word in words:
        if word == "point":
            share = Fraction(1, 10)
        elif word == "hundred":
            total = (total or Fraction(1)) * 100
        elif share is not None:
            total, share = total + _NUMERALS.get(word, Fraction(0)) * share, share / 10
        else:
            total += _NUMERALS.get(word, Fraction(0))
    return total if any(word not in ("a", "an", "and") for word in words) else Fraction(1)


def spoken_of(text: str) -> Iterator[Span]:
    """Yield where `text` speaks of a number or a parameter: all of them must be used."""
    for match in re.finditer(rf"{_PARAMETER.pattern}|{_NUMBER.pattern}|{_SHARE.pattern}", text):
        if not match[0][0].isalpha() or unit_of_name(match[0]):
            yield Span(*match.span())
    for match in _RUN.finditer(text):
        if match[0].lower() not in ("a", "an") and _unit_at(text[match.end() :]):
            yield Span(*match.span())
