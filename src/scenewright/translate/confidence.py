"""How sure the reading of a clause is: from its words alone, inferred, by a default, or with a word corrected.

What enters: the words of a clause and what was assumed. What leaves: a number from 0 to 1 with its meaning. It is a
scale of kinds, not a measured probability: a clause is as sure as the least sure step of its reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum


@dataclass(frozen=True, slots=True)
class Confidence:
    """A degree and what it means."""

    value: float
    meaning: str


class Basis(Enum):
    """What a reading rests on, from the surest kind to the least sure."""

    EXACT = Confidence(1.0, "every word is known and nothing was added")
    INFERRED = Confidence(0.9, "something left unsaid was taken from the map or from the words before")
    DEFAULT = Confidence(0.8, "something left unsaid was filled in by a convention")
    FACTS = Confidence(0.7, "the facts were picked out of a free text; what tells none was set aside")
    CORRECTED = Confidence(0.6, "a misspelt word was corrected")
    GUESSED = Confidence(0.5, "an unknown word was taken for a description that changes nothing")
    LIKENESS = Confidence(0.4, "read by likeness to descriptions whose meaning is known")


_KINDS = (
    (re.compile(r"is read as '"), Basis.CORRECTED),
    (re.compile(r"is taken for a description"), Basis.GUESSED),
    (re.compile(r"inferred from the map|no turn of it was mentioned|is measured from|is the hero:"), Basis.INFERRED),
)
_QUOTED = re.compile(r"'((?:[^']|(?<=\w)'(?=\w))+)'")
_ABOUT = re.compile(r"^(?:the )?(ego|hero)(?::| goes straight on)")


def basis_of(words: str, actor: str | None, tells_route: bool, assumptions: Iterable[str]) -> Basis:
    """Return the least sure kind among the assumptions that are about a clause.

    Parameters
    ----------
    words
        The clause.
    actor
        Whose clause it is.
    tells_route
        Whether it decides a route.
    assumptions
        All of the translation's; one is about this clause if it quotes it, or is about the route that it tells.
    """
    found = [Basis.EXACT]
    for assumption in assumptions:
        kind = next((basis for pattern, basis in _KINDS if pattern.search(assumption)), Basis.DEFAULT)
        about = _ABOUT.match(assumption)
        quoted = _QUOTED.match(assumption)
        if about is not None:
            concerned = tells_route and about.group(1) == actor
        else:
            concerned = quoted is not None and _contains(words, quoted.group(1))
        if concerned:
            found.append(kind)
    return min(found, key=lambda basis: basis.value.value)


def _contains(clause: str, words: str) -> bool:
    plain = " ".join(clause.split()).lower()
    return re.search(rf"(?<!\w){re.escape(' '.join(words.split()).lower())}(?!\w)", plain) is not None
