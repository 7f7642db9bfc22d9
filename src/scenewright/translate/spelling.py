"""Finds the one known word that a misspelt word stands for, or says which ones are near.

What enters: a word and the vocabulary. What leaves: the correction where exactly one is near enough, else suggestions.
A slip is two letters exchanged, a letter doubled or undoubled, a vowel for another, and in long words one letter wrong,
missing or too many: what a short word would stand for is never guessed (`sings` is not `swings`).
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from functools import lru_cache

# Words of their own, one letter from words that are known.
_NO_SLIPS = frozenset(
    ["planner", "planners", "loader", "worries", "singing", "tired", "compete", "competes", "competing", "thinks",
     "contest", "product", "products", "rising", "saying", "drafts", "fro", "possible", "comfortable", "sings",
     "arises", "arise", "policy", "learner", "reader", "later", "sight", "light", "night", "tern",
     "letter", "letters", "matter", "better", "litter"]
)  # fmt: skip
VOWELS = frozenset("aeiouy")
_LONG = 7
_VERY_LONG = 10


@lru_cache(maxsize=4096)
def correction(word: str, vocabulary: frozenset[str]) -> str | None:
    """Return the word of the vocabulary that `word` is a slip of, or None where there is none or more than one.

    >>> correction("braek", frozenset({"brake", "break"})) is None
    True
    >>> correction("intersecton", frozenset({"intersection", "into"}))
    'intersection'
    """
    if len(word) < 3 or not word.isalpha() or word in _NO_SLIPS:
        return None
    near = {each for each in _alike(word, vocabulary) if _is_slip(word, each)}
    if len(near) > 1:  # forms of one word are told apart by the better fit; different words are not
        best = {each for each in near if _exchanged(word, each)} or near
        near = best
    return near.pop() if len(near) == 1 else None


@lru_cache(maxsize=4096)
def suggestions(word: str, vocabulary: frozenset[str]) -> tuple[str, ...]:
    """Return known words that look like `word`, best first."""
    word = word.lower()
    lengths = range(len(word) - 3, len(word) + 4)
    alike = [each for length in lengths for each in _by_length(vocabulary).get(length, ()) if each[0] == word[0]]
    return tuple(each for each in difflib.get_close_matches(word, sorted(alike), n=2, cutoff=0.8) if each != word)


@lru_cache(maxsize=4)
def _by_length(vocabulary: frozenset[str]) -> dict[int, list[str]]:
    found: dict[int, list[str]] = {}
    for each in vocabulary:
        found.setdefault(len(each), []).append(each)
    return found


def _alike(word: str, vocabulary: frozenset[str]) -> Iterator[str]:
    """Yield known words that it may be a slip of: one slip leaves the beginning of a word as it is, or its end."""
    lengths, begins, ends = _by_length(vocabulary), word[:2], word[-2:]
    for each in lengths.get(len(word), ()):
        # In the shortest words there is no room for that, in the longest two vowels may be wrong.
        if not 4 < len(word) < _VERY_LONG - 1 or each[:2] == begins or each[-2:] == ends:
            yield each
    for length in (len(word) - 1, len(word) + 1):
        yield from (each for each in lengths.get(length, ()) if each[:2] == begins or each[-2:] == ends)
    for length in (len(word) - 2, len(word) + 2):
        if length >= _VERY_LONG:
            yield from (each for each in lengths.get(length, ()) if each[:2] == begins)


def _is_slip(word: str, known: str) -> bool:
    if len(known) < 3:
        return False
    if _exchanged(word, known):
        return True
    if len(word) < 4:
        return False
    if len(word) == len(known):
        wrong = [(a, b) for a, b in zip(word, known, strict=True) if a != b]
        if len(wrong) == 1:
            a, b = wrong[0]
            return len(known) >= _LONG or (len(known) >= _LONG - 1 and a in VOWELS and b in VOWELS)
        vowels = all(a in VOWELS and b in VOWELS for a, b in wrong)
        return len(wrong) == 2 and len(known) >= _VERY_LONG - 1 and vowels
    if abs(len(word) - len(known)) == 1:
        longer, shorter = (word, known) if len(word) > len(known) else (known, word)
        for at in range(len(longer)):
            if longer[:at] + longer[at + 1 :] == shorter:
                doubled = (at and longer[at] == longer[at - 1]) or longer[at : at + 1] == longer[at + 1 : at + 2]
                return bool(doubled) or (len(known) >= _LONG and at > 0)
    if len(known) >= _VERY_LONG and word[:2] == known[:2]:
        return difflib.SequenceMatcher(None, word, known).ratio() >= 0.9
    return False


def _exchanged(word: str, known: str) -> bool:
    """Whether two neighbouring letters changed places."""
    if len(word) != len(known) or word == known:
        return False
    at = next(index for index in range(len(word)) if word[index] != known[index])
    return word[:at] + word[at + 1 : at + 2] + word[at] + word[at + 2 :] == known
