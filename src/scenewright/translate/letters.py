"""Knows the parts of a letter that say nothing of the scenario: "Hi Jonas,", "Thanks!", "Best, Tom", a plain request.

What enters: tokens and the position at which a sentence begins. What leaves: the position after such a part, or None.
A part with an amount, a place or a vehicle is none; what is stepped over is reported by the translation.
"""

from __future__ import annotations

from scenewright.translate.tokens import Token

_GREETINGS = ("hi", "hello", "hey", "dear", "hi there", "hello there", "good morning", "good afternoon")
_GREETED = frozenset(("all", "team", "everyone", "everybody", "folks", "colleagues", "there", "both", "again", "and"))
_CLOSINGS = ("thanks", "thank", "thx", "best", "regards", "cheers", "kind", "many", "sincerely", "yours", "greetings",
             "warm", "all the best")  # fmt: skip
_CLOSING_WORDS = frozenset(
    ["thanks", "thank", "thx", "best", "regards", "cheers", "kind", "many", "sincerely", "yours", "greetings", "warm",
     "in", "advance", "a", "lot", "very", "much", "so", "you", "and", "for", "your", "help", "all", "the", "wishes",
     "this", "from"]
)  # fmt: skip
_REQUEST_WORDS = frozenset(
    ["please", "we", "you", "have", "get", "do", "make", "write", "give", "send", "me", "us", "a", "one", "something",
     "this", "like", "where", "in", "which", "case", "test", "scenario", "for", "another", "also", "too", "with"]
)  # fmt: skip
_SAYS = frozenset(("ego", "hero", "noun", "quantity", "bare_number", "area", "landmark", "heading", "measure"))
_LONGEST_NAME, _LONGEST_CLOSING, _LONGEST_REQUEST = 3, 9, 14
_ASKS = ("can", "could", "would", "may", "shall", "please", "can we", "could we", "can you", "could you", "would you",
         "can you please", "could you please", "would you please")  # fmt: skip


def letter_end(tokens: list[Token], at: int) -> int | None:
    """Return the position after a greeting, a closing or a plain request that begins a sentence at `at`, or None."""
    return _greeting_end(tokens, at) or _closing_end(tokens, at) or _request_end(tokens, at)


def _is_name(token: Token) -> bool:
    named = token.text.lower() in _GREETED or (token.text[:1].isupper() and token.text.isalpha())
    return named and not token.tags.keys() & _SAYS


def _greeting_end(tokens: list[Token], at: int) -> int | None:
    """Read "Hi Jonas," and "Dear all,"."""
    if tokens[at].text.lower() not in _GREETINGS:
        return None
    end = at + 1
    while end < len(tokens) and end - at <= _LONGEST_NAME and _is_name(tokens[end]):
        end += 1
    closed = end < len(tokens) and tokens[end].tags.keys() & {"comma", "end"}
    return end if end > at + 1 and closed else None


def _closing_end(tokens: list[Token], at: int) -> int | None:
    """Read "Thanks!", "Many thanks for your help", "Best regards, Tom"."""
    if tokens[at].text.lower() not in _CLOSINGS:
        return None
    end = at
    while "end" not in tokens[end].tags:
        token = tokens[end]
        plain = all(word in _CLOSING_WORDS for word in token.text.lower().split()) or "comma" in token.tags
        if end - at > _LONGEST_CLOSING or not (plain or _is_name(token)):
            return None
        end += 1
    return end


def _request_end(tokens: list[Token], at: int) -> int | None:
    """Read "can we have one where nobody gives way?": it asks for a test and says nothing else."""
    if tokens[at].text.lower() not in _ASKS:
        return None
    end = at + 1
    while "end" not in tokens[end].tags:
        token = tokens[end]
        asks = all(word in _REQUEST_WORDS for word in token.text.lower().split())
        if end - at > _LONGEST_REQUEST or not (asks or "nobody_yields" in token.tags):
            return None
        end += 1
    return end if "?" in tokens[end].text else None
