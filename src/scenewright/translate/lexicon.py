"""The words that the offline translator knows, read from its tables, with their inflected forms.

What enters: the tables beside this module, `lexicon.toml` first. What leaves: tags for sequences of words, numbers in
words, unit spellings. It holds no grammar: which tag counts in a sentence is decided by `clauses`.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from itertools import product

from scenewright.translate.numerals import WORDS

FILES = ("lexicon.toml", "lexicon_routes.toml", "lexicon_triggers.toml", "lexicon_spoken.toml")
VOWELS = "aeiou"
SLOT = "~"
SLOT_WORDS = (("the",), ("its",), ("his",), ("her",), ("their",), ("my",), ("our",), ("your",), ())
_ALTERNATIVES = re.compile(r"\(([^()]*)\)")
FORM_NAMES = ("base", "s", "ing", "ed")


@dataclass(frozen=True, slots=True)
class Lexicon:
    """All known phrases.

    Attributes
    ----------
    entries
        Tags by phrase (tuple of lower-case words); a tag is a class with a value, verbs carry their forms too.
    units
        Unit symbol by spelling.
    numbers
        Value by number word.
    words
        Every single word that occurs in some phrase or unit.
    longest
        Words in the longest phrase.
    """

    entries: Mapping[tuple[str, ...], Mapping[str, str]]
    forms: Mapping[tuple[str, ...], frozenset[str]]
    units: Mapping[str, str]
    numbers: Mapping[str, int]
    words: frozenset[str]
    longest: int

    def lookup(self, words: Sequence[str], start: int) -> tuple[int, Mapping[str, str], frozenset[str]]:
        """Return how many words from `start` the longest known phrase takes (0: none), its tags and verb forms."""
        for length in range(min(self.longest, len(words) - start), 0, -1):
            key = tuple(words[start : start + length])
            if key in self.entries:
                return length, self.entries[key], self.forms.get(key, frozenset())
        return 0, {}, frozenset()


@lru_cache(maxsize=1)
def load_lexicon() -> Lexicon:
    """Read the table once and inflect its verbs."""
    table = _tables()
    entries: dict[tuple[str, ...], dict[str, str]] = {}
    forms: dict[tuple[str, ...], set[str]] = {}
    units = {spelling: symbol for symbol, spellings in table.pop("unit").items() for spelling in spellings}
    irregular = table.pop("irregular")
    numbers = {word: int(value) for value, words in table.pop("number").items() for word in words}
    for tag, values in table.items():
        for value, phrases in values.items():
            for phrase in (each for written in phrases for each in alternatives(written)):
                if tag != "verb":
                    entries.setdefault(tuple(phrase.split()), {})[tag] = value
                    continue
                for form, words in inflect(phrase, irregular):
                    entries.setdefault(words, {})["verb"] = value
                    forms.setdefault(words, set()).add(form)
    longest = max(len(words) for words in entries)
    single = {word for phrase in entries for word in phrase}
    single |= {word for spelling in units for word in spelling.split()} | set(numbers) | WORDS
    frozen = {words: frozenset(names) for words, names in forms.items()}
    return Lexicon(entries, frozen, units, numbers, frozenset(single), longest)


def _tables() -> dict[str, dict[str, list[str]]]:
    """Read all tables of words; what several say of one class is joined."""
    joined: dict[str, dict[str, list[str]]] = {}
    for name in FILES:
        text = files("scenewright.translate").joinpath(name).read_text(encoding="utf-8")
        for tag, values in tomllib.loads(text).items():
            for value, phrases in values.items():
                joined.setdefault(tag, {}).setdefault(value, []).extend(phrases)
    return joined


def alternatives(phrase: str) -> list[str]:
    """Return every phrase that one with alternatives in parentheses stands for; an empty one may be left out.

    >>> alternatives("at the (very|) moment (when|that)")
    ['at the very moment when', 'at the very moment that', 'at the moment when', 'at the moment that']
    """
    parts = _ALTERNATIVES.split(phrase)
    choices = [part.split("|") if index % 2 else [part] for index, part in enumerate(parts)]
    return [" ".join("".join(each).split()) for each in product(*choices)]


def inflect(phrase: str, irregular: Mapping[str, Sequence[str]]) -> list[tuple[str, tuple[str, ...]]]:
    """Return the forms of a verb phrase, inflected by its first word or the one marked with a star.

    >>> inflect("slow down", {})[1]
    ('s', ('slows', 'down'))
    """
    words = phrase.split()
    at = next((index for index, word in enumerate(words) if word.endswith("*")), 0)
    head = words[at].rstrip("*")
    groups = irregular.get(head) or (head, _third(head), _gerund(head), _past(head))
    return [
        (name, each)
        for name, forms in zip(FORM_NAMES, groups, strict=True)
        for form in forms.split()
        for each in _filled((*words[:at], form, *words[at + 1 :]))
    ]


def _filled(words: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Return a phrase with every article or possessive that can stand for its slot."""
    if SLOT not in words:
        return [words]
    at = words.index(SLOT)
    return [(*words[:at], *slot, *words[at + 1 :]) for slot in SLOT_WORDS]


def _third(verb: str) -> str:
    if verb.endswith(("s", "sh", "ch", "x")):
        return verb + "es"
    return verb[:-1] + "ies" if verb.endswith("y") and verb[-2] not in VOWELS else verb + "s"


def _gerund(verb: str) -> str:
    return verb[:-1] + "ing" if verb.endswith("e") and not verb.endswith("ee") else verb + "ing"


def _past(verb: str) -> str:
    if verb.endswith("e"):
        return verb + "d"
    return verb[:-1] + "ied" if verb.endswith("y") and verb[-2] not in VOWELS else verb + "ed"
