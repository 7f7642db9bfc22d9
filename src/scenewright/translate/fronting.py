"""Puts back what stands before its owner: "Travelling eastbound on the road, the hero ..." tells of the hero.

What enters: tokens. What leaves: the same tokens, the words in front behind the vehicle that they tell of. It drops no
word but the one that only announces a place ("the point 30 m before it").
"""

from __future__ import annotations

from scenewright.translate.tokens import Token

_DRIVES = ("drive", "go", "lane_follow", "come", "approach")
_OF_A_WAY = frozenset(
    ("heading", "preposition", "determiner", "area", "area_adjective", "direction", "adverb", "oncoming_way")
)  # fmt: skip
_OF_A_VEHICLE = frozenset(("determiner", "actor_adjective", "ego", "hero", "noun"))


def unfronted(tokens: list[Token]) -> list[Token]:
    """Return the tokens in the order of owner and what is told of it."""
    return _participles(_announced(tokens))


def _participles(tokens: list[Token]) -> list[Token]:
    """Let "Driving eastbound, the hero turns left." be "The hero, driving eastbound, turns left."."""
    read = list(tokens)
    at = 0
    while at < len(read):
        begins = at == 0 or "end" in read[at - 1].tags
        comma = _way_told(read, at) if begins else None
        end = comma + 1 if comma is not None else at
        while comma is not None and end < len(read) and read[end].tags.keys() & _OF_A_VEHICLE:
            end += 1
        named = comma is not None and any(t.tags.keys() & {"ego", "hero", "noun"} for t in read[comma + 1 : end])
        if comma is not None and named and read[end].tags.keys() & {"verb", "be", "auxiliary"}:
            way, owner = read[at:comma], read[comma + 1 : end]
            read[at:end] = [*owner, read[comma], *way, read[comma]]
        at += 1
    return read


def _way_told(tokens: list[Token], at: int) -> int | None:
    """Return the position of the comma after "Travelling eastbound on the road", None where more is told than a way."""
    if tokens[at].tags.get("verb") not in _DRIVES or "ing" not in tokens[at].forms:
        return None
    end = at + 1
    while end < len(tokens) and (tokens[end].tags.keys() & _OF_A_WAY or _is_speed(tokens[end])):
        end += 1
    return end if end > at + 1 and end < len(tokens) and "comma" in tokens[end].tags else None


def _is_speed(token: Token) -> bool:
    return token.quantity is not None and token.quantity.dimension == "speed"


def _announced(tokens: list[Token]) -> list[Token]:
    """Let "has reached the point 30 m before it" be "has reached 30 m before it"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        measured = at + 1 < len(tokens) and tokens[at + 1].quantity is not None
        if measured and token.text.lower() in ("point", "place", "spot") and read and "determiner" in read[-1].tags:
            read.pop()
        elif measured and token.text.lower() in ("the point", "a point", "the place", "the spot"):
            continue
        else:
            read.append(token)
    return read
