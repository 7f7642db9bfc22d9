"""Gives what is told beside a vehicle a clause of its own: "which starts 30 m before it", "whose speed is 12 m/s".

What enters: tokens. What leaves: tokens in which it stands with a verb and a subject that the reader of clauses knows.
It adds no amount and drops none; what it is not sure of it leaves as it was, to be refused.
"""

from __future__ import annotations

from dataclasses import replace

from scenewright.errors import Span
from scenewright.translate.notes import begins, sentence_end
from scenewright.translate.tokens import Token

_NAMES = frozenset(("ego", "hero", "noun"))
_NAMED = frozenset(("ego", "hero", "noun", "determiner", "actor_adjective", "heading"))
_SPEEDS = ("initial speeds", "starting speeds", "start speeds", "the initial speeds", "the starting speeds", "speeds")
_PLACED = ("relation", "preposition")


def related(tokens: list[Token]) -> list[Token]:
    """Return the tokens with what is told beside a vehicle in clauses."""
    return _speeds(_speed_too(_whose(_which_starts(_with_starting(tokens)))))


def _which_starts(tokens: list[Token]) -> list[Token]:
    """Let "the ego, which starts 30 m before the stop line" be a place of the ego's, and no onset."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        words = token.text.lower().split()
        starts = len(words) == 2 and words[0] in ("which", "that", "who") and words[1] in ("starts", "begins")
        amount = tokens[at + 1].quantity if at + 1 < len(tokens) else None
        named = at > 1 and bool((tokens[at - 1].tags.keys() | tokens[at - 2].tags.keys()) & _NAMES)
        if not (starts and named and amount is not None and amount.dimension == "length"):
            read.append(token)
            continue
        middle = token.span.start + len(words[0])
        read.append(Token(words[0], Span(token.span.start, middle), {"link": "that"}))
        read.append(Token(words[1], Span(middle + 1, token.span.end), {"verb": "begin"}, frozenset(("s",))))
    return read


def _whose(tokens: list[Token]) -> list[Token]:
    """Let "the ego, whose initial speed is 36 km/h" be "the ego, with an initial speed of 36 km/h"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        measure = at + 1
        while measure < len(tokens) and "starting" in tokens[measure].tags:
            measure += 1
        told = tokens[at].text.lower() == "whose" and measure + 2 < len(tokens)
        told = told and tokens[measure].tags.get("measure") == "speed" and "be" in tokens[measure + 1].tags
        amount = tokens[measure + 2].quantity if told else None
        if amount is None or amount.dimension != "speed" or not _names_before(tokens, at):
            read.append(tokens[at])
            at += 1
            continue
        read.append(Token("with", tokens[at].span, {"preposition": "with"}))
        read += [*tokens[at + 1 : measure + 1], Token("of", tokens[measure + 1].span, {"preposition": "of"})]
        at = measure + 2
    return read


def _names_before(tokens: list[Token], at: int) -> bool:
    """Whether a vehicle stands right before a position, with or without a comma."""
    before = tokens[max(0, at - 2) : at]
    return bool(before) and bool(
        before[-1].tags.keys() & _NAMES or ("comma" in before[-1].tags and before[0].tags.keys() & _NAMES)
    )


def _with_starting(tokens: list[Token]) -> list[Token]:
    """Let "With the ego starting 40 m behind the stop line, a van comes" be "The ego starts 40 m behind it, ..."."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        if not begins(tokens, at) or token.text.lower() != "with":
            read.append(token)
            continue
        end = at + 1
        while tokens[end].tags.keys() & _NAMED:
            end += 1
        starts = tokens[end].text.lower() in ("starting", "beginning", "setting out", "starting out", "starting off")
        acts = any(each.tags.get("verb") in ("brake", "stop", "accelerate", "yield", "pass") for each in
                   tokens[at : sentence_end(tokens, at)])  # fmt: skip
        if end == at + 1 or not starts or tokens[end + 1].quantity is None or acts:
            read.append(token)
            continue
        verb = replace(tokens[end], text="starts", tags={"verb": "begin"}, forms=frozenset(("s",)))
        return [*read, *tokens[at + 1 : end], verb, *_with_starting(tokens[end + 1 :])]
    return read


def _speed_too(tokens: list[Token]) -> list[Token]:
    """Let "its distance to it amounts to 95 m and its speed to 12 m/s" be "... and its speed is 12 m/s"."""
    read = list(tokens)
    gapped = False
    for at, token in enumerate(tokens[:-1]):
        gapped = (gapped or token.text.lower() in ("amounts to", "amount to", "comes to", "is set to")) and (
            "end" not in token.tags
        )
        owned = at > 1 and "measure" in tokens[at - 1].tags and token.text.lower() == "to"
        if gapped and owned and tokens[at + 1].quantity is not None:
            read[at] = replace(token, text="is", tags={"be": "be"}, forms=frozenset())
    return read


def _speeds(tokens: list[Token]) -> list[Token]:
    """Let "Initial speeds are 50 km/h for the ego and 40 km/h for the hero" be a sentence about each."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        dealt = _dealt_speeds(tokens, at) if begins(tokens, at) else None
        if dealt is None:
            read.append(tokens[at])
            at += 1
            continue
        told, at = dealt
        read += told
    return read


def _dealt_speeds(tokens: list[Token], at: int) -> tuple[list[Token], int] | None:
    """Read "Initial speeds are A for X and B for Y": the sentences, and the position after it."""
    start = at
    at += "determiner" in tokens[at].tags
    at += "starting" in tokens[at].tags
    if tokens[at].text.lower() not in _SPEEDS or not tokens[at + 1].tags.keys() & {"be", "colon"}:
        return None
    at += 2
    shares: list[tuple[Token, list[Token]]] = []
    while len(shares) < 2:
        amount, name = tokens[at], at + 2
        if amount.quantity is None or amount.quantity.dimension != "speed":
            return None
        if tokens[at + 1].text.lower() not in ("for", "of"):
            return None
        end = name
        while tokens[end].tags.keys() & _NAMED:
            end += 1
        if not any(each.tags.keys() & _NAMES for each in tokens[name:end]):
            return None
        shares.append((amount, tokens[name:end]))
        at = end + (len(shares) < 2 and ("comma" in tokens[end].tags or tokens[end].tags.get("link") == "and"))
    if "end" not in tokens[at].tags:
        return None
    front = Span(tokens[start].span.start, tokens[start].span.start)
    told: list[Token] = []
    for amount, named in shares:
        told += [Token("initially", front, {"adverb": "initially"}), Token(",", front, {"comma": ","}), *named]
        told += [Token("drives", front, {"verb": "drive"}, frozenset(("s",)))]
        told += [Token("at", amount.span, {"preposition": "at"}), amount]
        told += [Token(".", Span(amount.span.end, amount.span.end), {"end": "."})] if len(told) < 10 else []
    return told[:-1] if "end" in told[-1].tags else told, at
