"""Stretches of a text as people would quote them: whole clauses, each once.

What enters: a text, and spans or quotes of it that may be as short as an amount. What leaves: spans and words.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from scenewright.errors import Span
from scenewright.translate.story import Quote

_BOUNDARY = re.compile(  # of a clause
    r"[.;!?,](?=\s|$)|\n\s*\n|\n\s*[-*]\s|\b(?:and|but|when|while|until|then|as soon as|(?<!at )once)\b", re.IGNORECASE
)


def clause_around(text: str, span: Span) -> Span:
    """Return the clause that `span` stands in: people quote "the ego is 25 m before the stop line", not "25 m".

    >>> text = "When the ego is 25 m before the stop line, the hero brakes."
    >>> clause_around(text, Span(16, 20)).excerpt(text)
    'the ego is 25 m before the stop line'
    """
    begins = [match.end() for match in _BOUNDARY.finditer(text, 0, span.start)]
    after = _BOUNDARY.search(text, span.end)
    return Span(begins[-1] if begins else 0, after.start() if after else len(text)).trimmed(text)


def words_of(quotes: Sequence[Quote], text: str) -> str:
    """Return the clauses of `text` that quotes stand in, each stretch once."""
    found: list[Span] = []
    for span in sorted((clause_around(text, quote.span) for quote in quotes), key=lambda span: span.start):
        if found and not re.search(r"\w", text[found[-1].end : span.start]):  # they meet, or one lies in the other
            found[-1] = found[-1].union(span)
        else:
            found.append(span)
    return " ... ".join(" ".join(span.excerpt(text).split()) for span in found)
