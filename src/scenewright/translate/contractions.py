"""Says what "'s" stands for: "it's about to turn" is "it is about to turn", "the ego's gone past it" is "has gone".

What enters: the word in front of it and the words behind it. What leaves: "is" or "has" where that is certain, else
None; then it is a genitive, or is left to the reader of clauses.
"""

from __future__ import annotations

from scenewright.translate.lexicon import Lexicon

_HAS_OR_IS = frozenset(["to", "held", "found", "tested", "evaluated", "forced", "expected", "placed", "being"])
_PRONOUNS = frozenset(["it", "he", "she", "there", "who", "what", "that", "here", "which"])
_AFTER_IS = frozenset(["not", "there", "still", "already", "at"])
_AFTER_HAS = frozenset(["gone", "passed", "come", "got", "reached", "been", "cleared", "crossed", "begun", "left"])


def short_verb(before: str, following: list[str], lexicon: Lexicon) -> str | None:
    """Return what "'s" stands for where it is certain: "it's not", "the ego's about to", "it's gone past"."""
    if following[0] in _AFTER_HAS and (before in _PRONOUNS or following[0] != "left"):
        return "has"
    participle = "ed" in lexicon.forms.get((following[0],), ())
    if (before in _PRONOUNS and not participle) or following[0] in _AFTER_IS:
        return "is"
    known = lexicon.lookup(["is", *following], 0)[0] > 1
    return "is" if known and following[0] not in _HAS_OR_IS else None
