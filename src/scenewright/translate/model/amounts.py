"""Amounts in words: which numbers, units and parameters a text speaks of, and what they can be read as.

What enters: words. What leaves: stretches with their readings, by the numbers and the units of the vocabulary.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from scenewright.errors import Span
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.translate.read.chunks import vocabulary
from scenewright.units import unit_of_name

_OF_A = re.compile(r"(?:\s+of)?\s+an?(?=\s)")  # "half a second"


@dataclass(frozen=True, slots=True)
class Spoken:
    """A number or a parameter that a text speaks of; what it can be read as, with the unit where one follows."""

    span: Span
    values: frozenset[Fraction | str]
    unit: str | None


@cache
def _numerals() -> dict[str, Fraction]:
    return {
        **vocabulary().numbers,
        "half": Fraction(1, 2),
        "quarter": Fraction(1, 4),
        "a": Fraction(),
        "an": Fraction(),
    }


@cache
def _pattern() -> re.Pattern[str]:
    word = rf"(?:{'|'.join(_numerals())}|hundred)"
    return re.compile(
        r"(?P<digits>(?<![\w.^/])-?(?:\d+(?:[.,]\d+|/[1-9]\d*)*)?[¼½¾]?(?<=[\d¼½¾]))|(?P<name>(?<!\w)[A-Za-z]\w*_\w+)"
        rf"|(?P<near>(?i:\b(?:just|right) before\b))|(?P<words>(?i:\b{word}(?:[\s-]+(?:and[\s-]+)?{word})*\b))"
    )


def spoken_in(text: str) -> Iterator[Spoken]:
    """Yield the amounts of `text`; words for a number only where a unit follows.

    Examples
    --------
    >>> [(max(each.values), each.unit) for each in spoken_in("twenty-five metres, then 1.5 m/s²")]
    [(Fraction(25, 1), 'm'), (Fraction(3, 2), 'm/s^2')]
    """
    units = vocabulary().units
    for match in _pattern().finditer(text):
        of = _OF_A.match(text, match.end())
        follows = vocabulary().unit_pattern.match(text, of.end() if of else match.end())
        unit = (units.get(follows[1]) or units.get(follows[1].lower())) if follows else None
        values = set[Fraction | str]()
        if match["name"] and (own := unit_of_name(match[0])):
            values, unit = {match[0]}, own.symbol
        elif match["near"]:
            values, unit = {Fraction(JUST_BEFORE_M)}, "m"
        elif match["words"] and unit:
            values = {_value(re.findall("[a-z]+", match[0].lower()))}
        elif match["digits"]:
            plain, share = re.sub("[¼½¾]", "", match[0]), match[0][-1]
            readings = {plain.replace(",", "."), plain.replace(",", "")}  # a decimal comma, or one between thousands
            more = Fraction(0) if share.isascii() else Fraction(unicodedata.numeric(share))
            values = {Fraction(each or 0) + more for each in readings if each.count(".") < 2 and each.count("/") < 2}
        if values:
            yield Spoken(Span(*match.span()), frozenset(values), unit)


def _value(words: list[str]) -> Fraction:
    total = Fraction(0)
    for word in words:
        total = max(total, Fraction(1)) * 100 if word == "hundred" else total + _numerals().get(word, 0)
    return total if set(words) - {"a", "an"} else Fraction(1)
