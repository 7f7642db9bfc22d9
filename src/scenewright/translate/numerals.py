"""Numbers in words: "twelve", "a hundred and twenty", "two and a half", "a dozen", "half a", "one point five".

What enters: lower-case words and a position. What leaves: the number and how many words it took. Units are read by
`tokens`; vague amounts ("a couple of", "several") are no numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

FRACTIONS = {
    ("half", "a"): Fraction(1, 2),
    ("half", "an"): Fraction(1, 2),
    ("a", "half"): Fraction(1, 2),
    ("one", "half"): Fraction(1, 2),
    ("a", "quarter", "of", "a"): Fraction(1, 4),
    ("a", "quarter"): Fraction(1, 4),
    ("three", "quarters", "of", "a"): Fraction(3, 4),
    ("a", "third", "of", "a"): Fraction(1, 3),
}
TAILS = {
    ("and", "a", "half"): Fraction(1, 2),
    ("and", "one", "half"): Fraction(1, 2),
    ("and", "a", "quarter"): Fraction(1, 4),
    ("and", "three", "quarters"): Fraction(3, 4),
}
MULTIPLES = {("a", "dozen"): 12, ("one", "dozen"): 12, ("a", "hundred"): 100, ("a", "score"): 20, ("two", "dozen"): 24}

WORDS = frozenset(word for table in (FRACTIONS, TAILS, MULTIPLES) for phrase in table for word in phrase)


def number_in_words(words: Sequence[str], start: int, values: Mapping[str, int]) -> tuple[Fraction, int] | None:
    """Return the number that begins at `start` and how many words it takes, or None.

    >>> number_in_words("two and a half seconds".split(), 0, {"two": 2})
    (Fraction(5, 2), 4)
    """
    if tuple(words[start : start + 2]) == ("a", "hundred") and "hundred" in values:
        rest, used = _whole(["one", *words[start + 1 :]], 0, {**values, "one": 1})
        return Fraction(rest), used
    for table in (FRACTIONS, MULTIPLES):
        for phrase, value in table.items():
            if tuple(words[start : start + len(phrase)]) == phrase:
                return Fraction(value), len(phrase)
    whole, used = _whole(words, start, values)
    if not used:
        return None
    at = start + used
    if at + 1 < len(words) and words[at] == "point" and words[at + 1] in values:
        digits = ""
        while at + 1 < len(words) and values.get(words[at + 1], 10) < 10:
            digits += str(values[words[at + 1]])
            at += 1
        return Fraction(f"{whole}.{digits}") if digits else Fraction(whole), at + 1 - start
    for phrase, part in TAILS.items():
        if tuple(words[at : at + len(phrase)]) == phrase:
            return whole + part, used + len(phrase)
    return Fraction(whole), used


def tail(words: Sequence[str], start: int) -> tuple[Fraction, int] | None:
    """Return what "and a half" after a unit adds ("a second and a half"), and its length."""
    for phrase, part in TAILS.items():
        if tuple(words[start : start + len(phrase)]) == phrase:
            return part, len(phrase)
    return None


def _whole(words: Sequence[str], start: int, values: Mapping[str, int]) -> tuple[int, int]:
    """Read "one hundred and twenty five"; return the number and the words it took (0: none)."""
    total, at = 0, start
    open_below = 10**6  # a following part must be smaller than this
    while at < len(words):
        step = 1
        if words[at] == "and" and total >= 100 and at + 1 < len(words) and words[at + 1] in values:
            at, step = at + 1, 2
        if words[at] == "hundred" and 0 < total < 10:
            total, open_below = total * 100, 100
        elif words[at] in values and values[words[at]] < open_below and (values[words[at]] or at == start):
            value = values[words[at]]
            total += value
            open_below = 10 if value >= 20 and value % 10 == 0 and value < 100 else 0
            if value == 100:
                open_below = 100
        else:
            at -= step - 1
            break
        at += 1
        if open_below == 0 and not (at < len(words) and words[at] == "hundred" and total < 10):
            break
    return total, at - start
