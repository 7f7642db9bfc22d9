"""Takes apart phrases that the lexicon knows whole where their neighbours show two parts: "is going to start to brake".

What enters: tokens. What leaves: tokens in which such a phrase is two words again. It drops nothing.
"""

from __future__ import annotations

from scenewright.errors import Span
from scenewright.translate.tokens import Token


def regrouped(tokens: list[Token]) -> list[Token]:
    """Return the tokens with phrases taken apart that are two words where they stand."""
    return _to_start(tokens)


def _to_start(tokens: list[Token]) -> list[Token]:
    """Let "to start" be a verb in "is going to start to brake" and "wants to start turning", and no moment."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        following = tokens[at + 1 : at + 3]
        verb = bool(following) and "ing" in following[0].forms and "verb" in following[0].tags
        to_verb = len(following) > 1 and following[0].text.lower() == "to" and "verb" in following[1].tags
        if token.text.lower() != "to start" or not (verb or to_verb):
            read.append(token)
            continue
        middle = token.span.start + len("to")
        read.append(Token("to", Span(token.span.start, middle), {"link": "to", "preposition": "to"}))
        span = Span(middle + 1, token.span.end)
        read.append(Token("start", span, {"verb": "begin"}, frozenset(("base",))))
    return read
