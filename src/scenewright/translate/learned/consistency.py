"""Holds a reading against the words that no reading may contradict: places, turns, ways, denials, bounds, doubts.

What enters: the tokens of a text and what the network makes of it. What leaves: the part of each amount, with the place
that the text names, or None where a word says otherwise. The network looks at the whole of a text, and is sure of a
frequent story even where a single word of it was exchanged.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from scenewright.errors import Span
from scenewright.translate.tokens import Token

BOTH = " & "  # joins two constraints that one amount is told for: "both are 30 m from it"

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
# "comes from the west", "approaches from the western end"
_ORIGIN = re.compile(
    r"\b(?:com(?:es?|ing)|came|approach(?:es|ing|ed)?|arriv(?:es|ing|ed)|enters?|heads? in|rolls? in|drives? in)\s"
    r"(?:in |up |along |on |down |over |(?:the |a )?(?:main )?(?:road|street) )*"
    r"from the (east|west|north|south)(?:ern end)?\b",
    re.IGNORECASE,
)
_OPPOSITE = {"e": "W", "w": "E", "n": "S", "s": "N"}
# Collisions, amounts that are none, and what the author does not know.
_BEYOND_IT = re.compile(
    r"\b(?:strikes|rams|collides|crashes into)\b"
    r"|\b(?:close|near) to (?:the|its|his|her) (?:stop line|conflict point|intersection|junction)\b"
    r"|\b(?:can|could|do|did|does)(?:n['’]t|not| not|['’]t) (?:\w+ )?(?:remember|recall|know|tell)\b"
    r"|\bnot (?:sure|certain|known|specified)\b|\bun(?:sure|known|specified|decided|clear)\b|\bleft open\b|\bforgot",
    re.IGNORECASE,
)
_SPEEDS_UP_TO_A_STOP = re.compile(
    r"(?<!instead of )(?<!rather than )\b(?:accelerat(?:es|e|ing)|speed(?:s|ing)? up)\s"
    r"(?:(?!(?:brak|slow|com|ha[sd]|get|decelerat|before|until)\w*\s)[^\s,;.]+\s|\d+\.\d+\s|,\s){0,7}?(?:to|until)\s"
    r"(?:(?:a|an|it|he|she)\s)?(?:(?:complete|full|dead|final)\s)?"
    r"(?:standstill|halt|stop\b(?!\s(?:line|bar))|stands\b|stops\b|rest\b)",
    re.IGNORECASE,
)
_BOUND_BEFORE = re.compile(
    r"\b(?:at (?:the )?(?:very )?(?:least|most)"
    r"|(?:no|not) (?:more|less|fewer|later|sooner|earlier|closer|nearer|further|farther)(?: away)? than"
    r"|(?:more|greater|faster|slower|further|farther) than|(?:min|max)(?:imum)?\.?(?: distance| speed| gap)?(?: of)?"
    r"|top speed of|exceed(?:s|ing)?)\W*$",
    re.IGNORECASE,
)
_BOUND_AFTER = re.compile(
    r"\W*(?:or (?:so|above|below|faster|slower|closer|nearer|further|farther)|and more|(?:min|max)(?:imum)?)\b"
    r"|(?:(?! and )[^,.;:\n]){0,40}?\b(?:or (?:more|less)|at (?:the )?(?:least|most))\b(?! \d)",
    re.IGNORECASE,
)


def parts_named(tokens: Sequence[Token], parts: Sequence[str]) -> list[str] | None:
    """Return the part of each amount, at the place that stands beside it; None where that is another place."""
    at_amounts = [at for at, token in enumerate(tokens) if token.quantity is not None]
    named = []
    for at, part in zip(at_amounts, parts, strict=True):
        each = [_with_place(tokens, at, one) for one in part.split(BOTH)]
        if None in each or _up_to_nothing(tokens, at):
            return None
        named.append(BOTH.join(one for one in each if one is not None))
    return named


def fits_words(text: str, ways: Sequence[Sequence[str]]) -> bool:
    """Whether every turn, heading and origin that is told is somebody's, and nothing is told that cannot be.

    Parameters
    ----------
    ways
        The turn and the headings of each vehicle: ``("left", "S", "E")``.
    """
    known = {each for way in ways for each in way}
    turns = {found.group().lower() for found in _TURN.finditer(_NOT_A_TURN.sub(" ", text))}
    headings = {found.group(1)[0].upper() for found in _HEADING.finditer(text)}
    if any(pattern.search(text) for pattern in (_DENIED, _SPEEDS_UP_TO_A_STOP, _BEYOND_IT)):
        return False
    begins = {way[1] for way in ways}
    if not {_OPPOSITE[found.group(1)[0].lower()] for found in _ORIGIN.finditer(text)} <= begins:
        return False
    return turns | headings <= known


def bounded(text: str, amount: Span) -> bool:
    """Whether an amount is a bound or a rough one, and no value: "at least 12 m", "12 m or more", "12 m or so"."""
    begin = max(0, amount.start - 24)
    return bool(_BOUND_BEFORE.search(text, begin, amount.start) or _BOUND_AFTER.match(text, amount.end))


def _up_to_nothing(tokens: Sequence[Token], at: int) -> bool:
    """Whether an amount is told up to something that nobody knows: "7 m from the tree"."""
    rest = [token for token in tokens[at + 1 : at + 1 + _AHEAD] if "determiner" not in token.tags]
    if not rest or "relation" not in rest[0].tags:
        return False
    head = next((i for i, token in enumerate(rest[1:], 1) if "unknown" not in token.tags), len(rest))
    return head > 1 and (head == len(rest) or not rest[head].tags.keys() & {"landmark", "hero", "ego", "vehicle"})


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
