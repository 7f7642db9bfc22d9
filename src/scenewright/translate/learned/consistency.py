"""Holds a reading against the words that no reading may contradict: places beside amounts, turns, headings, denials.

What enters: the tokens of a text and what the network makes of it. What leaves: the part of each amount, with the place
that the text names, or None where a word says otherwise. The network looks at the whole of a text, and is sure of a
frequent story even where a single word of it was exchanged.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from scenewright.translate.tokens import Token

_LANDMARK = re.compile(r"\b(?:stop_line|conflict_point|intersection|turn)\b")
_MEETING = ("conflict_point", "intersection", "turn")  # one place, where the ways of the two vehicles meet
_AHEAD = 7  # tokens from an amount to its place: "12 m short of the driveway's stop line"
_NOT_A_TURN = re.compile(
    r"\b(?:from|on|to|at)\s+(?:(?:its|the|his|her|our|my|your|their|whose|\w+['’]s)\s+)?(?:own\s+)?(?:left|right)\b"
    r"|\b(?:left|right)[- ](?:of\s+way|away|after|before|now|then|when|as|at|behind|in\s+front|hand|to\s+(?:the|it))\b"
    r"|\b(?:has|have|had|is|are|be|what|all|distance|time|metres?|meters?|seconds?|feet|yards|ft|m|s)\s+left\b"
    r"|\bleft\s+(?:to|until|for|before|open|the\s+(?:driveway|road))\b|\b(?:all|is|was|that['’]s)\s+right\b",
    re.IGNORECASE,
)
_HEADING = re.compile(r"\b(east|west|north|south)(?:bound|wards?)\b", re.IGNORECASE)
_TURN = re.compile(r"\b(left|right)\b", re.IGNORECASE)
# "is not on the road", "does not want to turn", "never begins to brake": what the network takes for its opposite.
_DENIED = re.compile(
    r"(?:\b(?:not|never)|n['’]t)\W+(?:(?:yet|really|going|to|be|been)\W+)*"
    r"(?:want|wish|plan|begin|start|commenc|approach|travel|driv|head|com(?:e|es|ing)\b|reach|gets?\b|oncoming|\d"
    r"|(?:west|east|north|south)|(?:on|in|at|from|within|behind|ahead|past|short)\b(?! (?:its|his|her|any)\b))",
    re.IGNORECASE,
)


def parts_named(tokens: Sequence[Token], parts: Sequence[str]) -> list[str] | None:
    """Return the part of each amount, at the place that stands beside it; None where that is another place."""
    at_amounts = [at for at, token in enumerate(tokens) if token.quantity is not None]
    named = [_with_place(tokens, at, part) for at, part in zip(at_amounts, parts, strict=True)]
    return None if None in named else [part for part in named if part is not None]


def fits_words(text: str, ways: Sequence[Sequence[str]]) -> bool:
    """Whether every turn and heading that is told is somebody's, and nothing is denied but what may be.

    Parameters
    ----------
    ways
        The turn and the headings of each vehicle: ``("left", "S", "E")``.
    """
    known = {each for way in ways for each in way}
    turns = {found.group().lower() for found in _TURN.finditer(_NOT_A_TURN.sub(" ", text))}
    headings = {found.group(1)[0].upper() for found in _HEADING.finditer(text)}
    return turns | headings <= known and _DENIED.search(text) is None


def _with_place(tokens: Sequence[Token], at: int, part: str) -> str | None:
    found = _LANDMARK.search(part)
    if found is None:
        return part
    for token in tokens[at + 1 : at + 1 + _AHEAD]:
        if token.quantity is not None or token.tags.keys() & {"end", "comma", "colon"} or _links(token):
            return part
        if token.tags.get("relation") == "past" and " - #" in part:
            return None
        if place := token.tags.get("landmark"):
            if place in _MEETING and found.group() in _MEETING:
                return part[: found.start()] + place + part[found.end() :]
            return part if place == found.group() else None
    return part


def _links(token: Token) -> bool:
    return "link" in token.tags and "relation" not in token.tags
