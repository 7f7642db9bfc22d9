"""Amounts in words: what a stretch of text can be read as, by the reader's own numbers and units.

What enters: words. What leaves: numbers and parameters with their units.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.translate.read.chunks import sentences, vocabulary

_SHARES = {"half": ".5", "quarter": ".25", "¼": ".25", "½": ".5", "¾": ".75"}


def read_amounts(words: str) -> Iterator[tuple[Fraction | str, str | None]]:
    """Yield the numbers (without their signs) and parameters that words can be read as, each with its unit.

    Examples
    --------
    >>> [(value, unit) for value, unit in read_amounts("twenty-five metres")]
    [(Fraction(25, 1), 'm')]
    """
    plain = _in_digits(words)
    for reading in {plain.replace(",", "."), plain.replace(",", "")}:  # a decimal comma, or one between thousands
        for chunk in (chunk for sentence in sentences(reading) for chunk in sentence):
            if chunk.amount is not None:
                yield chunk.amount.name or abs(chunk.amount.value or Fraction(0)), chunk.amount.unit
            elif chunk.kind == "no unit" and chunk.value[-1].isdigit():
                yield abs(Fraction(chunk.value)), None
            elif chunk.kind == "near":
                yield Fraction(JUST_BEFORE_M), "m"


def _in_digits(words: str) -> str:
    """Return words with their numbers in digits: "two and a half seconds" as "2.5 seconds"."""
    known = {**{word: str(number) for word, number in vocabulary().numbers.items()}, **_SHARES, "hundred": "100"}
    word = rf"(?:\b(?:{'|'.join(known)})\b|[¼½¾])"

    def value(match: re.Match[str]) -> str:
        total = Fraction(0)
        for said in re.findall(rf"(?i)\d+|{word}", match[0]):
            size = Fraction(known.get(said.lower(), said))
            total = max(total, Fraction(1)) * 100 if said.lower() == "hundred" else total + size
        return f"{float(total):g}"

    run = rf"(?i)(?:\ban? )?(?:\d+|{word})(?:(?:[\s-]|\band\b|\ban?\b)*{word})+|[¼½¾]|\b(?:half|quarter)\b"
    said = re.sub(run, value, words)
    return re.sub(r"(?i)(?<=\d) (?:of )?an? (?=\w)|^an? (?=\w+$)", lambda at: " " if at.start() else "1 ", said)
