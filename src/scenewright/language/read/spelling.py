"""Slips of the pen: a long word of the domain with one slip is corrected and told, others are asked about.

What enters: a word that nobody knows. What leaves: the word that it is taken for, or the words that it may mean. A real
word of general English is never corrected: those that look like a word of the domain stand in `words.toml`.
"""

from __future__ import annotations

from difflib import get_close_matches

LONG = 8  # letters; of shorter words too many differ from another word by one letter


def corrected(word: str, known: frozenset[str], lookalikes: frozenset[str]) -> str | None:
    """Return the one long word of `known` that `word` is but for one slip; None where it may be a word of its own.

    Examples
    --------
    >>> corrected("intersecton", frozenset({"intersection"}), frozenset())
    'intersection'
    """
    if word in known or word in lookalikes or len(word) < LONG - 1:
        return None
    found = [each for each in known if len(each) >= LONG and _is_slip(word, each)]
    return found[0] if len(found) == 1 else None


def nearest(word: str, known: frozenset[str]) -> list[str]:
    """Return the words of `known` that are spelled most like `word`."""
    return get_close_matches(word.lower(), sorted(known), n=2, cutoff=0.7)


def _is_slip(one: str, other: str) -> bool:
    """Whether one letter is left out, put in or changed, or two neighbours are exchanged."""
    same = next((at for at, pair in enumerate(zip(one, other, strict=False)) if pair[0] != pair[1]), None)
    if same is None:
        return abs(len(one) - len(other)) == 1
    left, right = one[same:], other[same:]
    exchanged = left[:2] == right[1::-1] and left[2:] == right[2:]
    return exchanged or left[1:] == right or left == right[1:] or left[1:] == right[1:]
