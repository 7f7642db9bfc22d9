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
NUMERALS = {word: Fraction(number) for number, word in enumerate(_ONES.split())}
NUMERALS |= {word: Fraction(10 * tens) for tens, word in enumerate(_TENS.split(), start=2)}
_PARTS = {"half": Fraction(1, 2), "quarter": Fraction(1, 4)}
_JOINED = ("a", "an", "and", "of", "point", "hundred", "couple", *_PARTS)
_NUMBER = re.compile(r"(?<![\w.^/])-?\d+(?:[.,]\d+|/[1-9]\d*)*")
_PARAMETER = re.compile(r"(?<!\w)[A-Za-z]\w*_\w+")
_SHARES = re.compile(r"(\d*)\s?([¼½¾⅓⅔])")


def read_amounts(words: str) -> set[tuple[Fraction | str, str | None]]:
    """Return what `words` can be read as: numbers and parameters, each with its unit where one follows.

    Examples
    --------
    >>> sorted(map(str, read_amounts("twenty-five metres")))
    ["(Fraction(25, 1), 'm')"]
    """
    known = vocabulary().units
    low = _SHARES.sub(lambda each: f"{each[1] or 0}.{str(unicodedata.numeric(each[2]))[2:6]}", words)
    found: set[tuple[Fraction | str, str | None]] = set()
    for match in _PARAMETER.finditer(low):
        if unit := unit_of_name(match[0]):
            found.add((match[0], unit.symbol))
    if re.search(r"\b(?:just|right) before\b", low):
        found.add((JUST_BEFORE_M, "m"))
    for match in _NUMBER.finditer(low):
        unit_said = _unit_at(low[match.end() :], known)
        readings = {match[0].replace(",", "."), match[0].replace(",", "")}
        found |= {(Fraction(each), unit_said) for each in readings if each.count(".") < 2 and each.count("/") < 2}
    for value, end in _in_words(low):
        found.add((value, _unit_at(low[end:], known)))
    return found


def _unit_at(rest: str, known: dict[str, str]) -> str | None:
    """Return the unit that `rest` begins with."""
    squared = re.sub(r"(?i)\bmet(?:re|er)s? per second (?:squared|per second)", "m/s^2", rest.lstrip(" -\u202f\u00a0'"))
    plain = re.sub(r"(?i)\bmet(?:re|er)s? (?:per|a) second", "m/s", squared)
    plain = re.sub(r"(?i)\bmiles (?:per|an) hour", "mph", re.sub(r"(?i)\bkilomet(?:re|er)s (?:per|an) hour", "km/h", plain))
    match = re.match(r"(?:of an? )?([^\s,;:!?()]+)", plain)
    said = match[1].rstrip(".'") if match else ""
    return known.get(said) or known.get(said.lower())


def _in_words(text: str) -> Iterator[tuple[Fraction, int]]:
    """Yield numbers in words with where they end: "a hundred and twenty", "three point five", "two and a half"."""
    run: list[re.Match[str]] = []
    for match in [*re.finditer(r"[A-Za-z]+", text), None]:
        if match and match[0].lower() in (*NUMERALS, *_JOINED):
            run.append(match)
            continue
        while run and run[-1][0].lower() in ("of", "and"):
            run.pop()
        words = [each[0].lower() for each in run]
        for first in range(len(words)):
            if (value := _value(words[first:])) is not None:
                yield value, run[-1].end()
        run = []


def _value(words: list[str]) -> Fraction | None:
    total, share, counted = Fraction(0), None, False
    for word in words:
        if word in ("a", "an", "and", "of"):
            continue
        counted = True
        if word == "point":
            share = Fraction(1, 10)
        elif word == "hundred":
            total = (total or Fraction(1)) * 100
        elif word == "couple":
            total += 2
        elif share is not None:
            total, share = total + NUMERALS.get(word, Fraction(0)) * share, share / 10
        else:
            total += NUMERALS.get(word, Fraction(0)) + _PARTS.get(word, Fraction(0))
    return total if counted else Fraction(1) if words[:1] in (["a"], ["an"]) and len(words) == 1 else None


def spoken_of(text: str) -> Iterator[Span]:
    """Yield where `text` speaks of a number or a parameter: all of them must be used."""
    for match in re.finditer(rf"{_PARAMETER.pattern}|{_NUMBER.pattern}|{_SHARES.pattern}", text):
        if not match[0][0].isalpha() or unit_of_name(match[0]):
            yield Span(*match.span())
    known = vocabulary().units
    for match in re.finditer(rf"(?i)\b(?:{'|'.join((*NUMERALS, 'hundred', 'half'))})\b", text):
        if _unit_at(text[match.end() :], known):
            yield Span(*match.span())
