"""Finds the amounts of a text, where the network sees all of them.

What enters: a description. What leaves: its amounts, or None where one has no unit ("and the hero 20"): the network
would drop a part of what is said. Also the clauses around them, and which may be told of both vehicles.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from scenewright.errors import ScenewrightError, Span
from scenewright.translate.tokens import Quantity, tokenise

_GOES_ON = re.compile(r"\W*(?:from|before|short|behind|ahead|to|away|off|past|for|of|shy|and|until)\b", re.IGNORECASE)
_COUNTED = re.compile(r" [a-z]+")
_NUMBERED = re.compile(
    r"\b(?:step|case|clause|test|scenario|phase|section|no\.?|number|item|variant|part) ?$", re.IGNORECASE
)
_LISTED = re.compile(r"[.:)](?=\s)")
_OF_BOTH = re.compile(r"\b(?:both|each)\b", re.IGNORECASE)
_CLAUSE_END = re.compile(r"[,;:.!?](?=\s|$)|\n")
_SENTENCE_END = re.compile(r"[.!?](?=\s|$)|\n\s*\n")


def amounts_of(text: str, name: str) -> list[Quantity] | None:
    """Return all amounts of a text in its order; None where one is not clear."""
    try:
        tokens = tokenise(text, name)
    except ScenewrightError:
        return None
    if any("bare_number" in token.tags and not _counts(token.span, text) for token in tokens):
        return None
    return [token.quantity for token in tokens if token.quantity is not None]


def clause_around(span: Span, text: str) -> Span:
    """Return the clause that an amount stands in."""
    clause = next((each for each in _stretches(text, _CLAUSE_END) if each.start <= span.start < each.end), span)
    return clause.union(span).trimmed(text)


def sentences(text: str) -> Iterator[Span]:
    """Yield where the sentences of a text stand."""
    return _stretches(text, _SENTENCE_END)


def may_be_of_both(amount: Quantity, amounts: Sequence[Quantity], text: str) -> bool:
    """Whether an amount may be told of both vehicles: "both are 30 m from it"."""
    clause = clause_around(amount.span, text)
    alone = sum(clause.start <= each.span.start < clause.end for each in amounts) == 1
    return alone and _OF_BOTH.search(clause.excerpt(text)) is not None


def _counts(span: Span, text: str) -> bool:
    """Whether a number without a unit counts or numbers something: "two cars", "Step 3:"; not "and the hero 20"."""
    if span.excerpt(text).lower() in ("one", "two"):
        return not _GOES_ON.match(text, span.end)
    if span.excerpt(text)[0].isdigit():
        return _NUMBERED.search(text, 0, span.start) is not None or _LISTED.match(text, span.end) is not None
    return _COUNTED.match(text, span.end) is not None and not _GOES_ON.match(text, span.end)


def _stretches(text: str, end: re.Pattern[str]) -> Iterator[Span]:
    start = 0
    for found in end.finditer(text):
        yield Span(start, found.end())
        start = found.end()
    yield Span(start, len(text))
