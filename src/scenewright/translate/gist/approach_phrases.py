"""Turns of phrase for how far somebody has to go: "the line, from which it is 30 m away", "with 8 s left until it".

What enters: nothing. What leaves: `APPROACH_PHRASES`, patterns with what to say instead, in their order: "approaches
the intersection with 8 s remaining" is "is 8 s from the intersection". Hardly anything that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, Rules
from scenewright.translate.tokens import tokenise

_PLACE = r"(?:the (?:stop line|intersection|conflict point))"
_START = r"(?:initially|at first)"
_WOULD = r"(?:would|will)(?: otherwise| then)?"
_GO_TO = r"(?:arrive at|reach|get to|come to)"
_SUBJECT = r"(?:[Tt]he|[Oo]ur|[Aa]n?) [\w-]+(?: (?:vehicle|car))?|Ego|Hero"
# "three and a half seconds (3.5 s)": said twice
_SAID_TWICE = re.compile(
    r"\b((?:an? )?[A-Za-z]+(?:[ -](?:and|a|an|half|point|[a-z]+)){0,5}) ?\((\d+(?:\.\d+)? ?(?:m|s|ft|yd|m/s|km/h"
    r"|mph))\)"
)
# "approaches the stop line, from which it is initially 30 m away"
_FROM_WHICH = re.compile(
    rf", from which (?:it|he|she) is (({_START}|still) )?({AMOUNT}) (?:away|off|distant)\b",
    re.IGNORECASE,
)
_WOULD_REACH = re.compile(rf", which (?:it|he|she) {_WOULD} {_GO_TO} in ({AMOUNT})(?=,| and)", re.IGNORECASE)
_AT_DISTANCE = re.compile(
    rf"\b(towards {_PLACE}|approaches {_PLACE})((?: \w+)?,? {_START},?) at a (?:distance|time to arrival) of "
    rf"({AMOUNT})(?=,| and|\.)",
    re.IGNORECASE,
)
_FROM_DISTANCE = re.compile(rf"\bfrom a distance of ({AMOUNT})(?= and| to |,|\.)", re.IGNORECASE)
_WITH_REMAINING = re.compile(
    rf"\bapproaches ({_PLACE}) ((?:\w+ ){{0,3}})with ({AMOUNT}) (?:remaining|left|to go)\b", re.IGNORECASE
)
# "With 8 s left until it would arrive at the intersection, the ego is"
_LEFT_FIRST = re.compile(
    rf"(?:(?<=[.!?]\s)|^)(?:With )?({AMOUNT}) (?:(?:left|remaining|to go) )?(?:until|before|till) (?:it|he|she)(?: "
    rf"{_WOULD} {_GO_TO}"
    rf"| (?:arrives at|reaches|gets to|comes to)) ({_PLACE}), ({_SUBJECT}) (?=is|drives|travels|comes|approaches"
    rf"|goes|wants)",
    re.IGNORECASE,
)
_LEAVING = re.compile(
    rf", leaving ({AMOUNT}) +(?:of (?:space|room|road) )?(?:between (?:itself|it|himself|herself) and|to|before) "
    rf"(?={_PLACE})",
    re.IGNORECASE,
)
_BEFORE_REACHING = re.compile(rf"\b({AMOUNT}) before (?:reaching|getting to|arriving at) (?={_PLACE})", re.IGNORECASE)
_WHERE_IT_STARTS = re.compile(rf", where (?:it|he|she) (?:starts|begins) (?={AMOUNT})", re.IGNORECASE)
# "Once the two are, respectively, 20 m from the conflict point (the ego) and 9 m from the stop line (the hero)"
_RESPECTIVELY = re.compile(
    rf"\b(?:the two|both|they|the two vehicles) (?:are|have come to),? (?:respectively,? )?({AMOUNT} (?:from|behind"
    rf"|before)) ({_PLACE}) "
    rf"\((the \w+(?: vehicle)?)\) and ({AMOUNT} (?:from|behind|before)) ({_PLACE}) \((the \w+(?: vehicle)?)\)",
    re.IGNORECASE,
)
# "In front of it, 25 m from the same stop line, a hero vehicle has"
_IN_FRONT_FIRST = re.compile(
    rf"(?:(?<=[.!?]\s)|^)(In front|Ahead) of (it|the ego), ({AMOUNT} [^,.;]*?(?:line|intersection|point)), (?:there "
    rf"is )?"
    rf"((?:an?|the) [\w-]+(?: [\w-]+)?) (?=has|wants|intends|is|with)",
    re.IGNORECASE,
)


def _once(found: re.Match[str]) -> str:
    """Return "three and a half seconds (3.5 s)" without what stands in brackets, where it is the same."""
    said = [token.quantity for token in tokenise(found.group(1), "") if token.quantity is not None]
    again = [token.quantity for token in tokenise(found.group(2), "") if token.quantity is not None]
    same = len(said) == len(again) == 1 and said[0].term == again[0].term and said[0].dimension == again[0].dimension
    return found.group(1) if same else found.group()


def _behind_front(found: re.Match[str]) -> str:
    """Return "In front of it, 25 m from the line, a hero" as "A hero, 25 m from the line, is in front of it"."""
    ahead, ego, where, who = found.groups()
    rest = "" if found.string[found.end() :].startswith("with") else "and "
    return f"{who[0].upper()}{who[1:]}, {where}, is {ahead.lower()} of {ego} {rest}"


# In this order: what one rule leaves, the next may read.
APPROACH_PHRASES: Rules = (
    (_SAID_TWICE, _once),
    (_FROM_WHICH, r", \1\3 from it"),
    (_WOULD_REACH, r", \1 from it"),
    (_AT_DISTANCE, r"\1\2 \3 from it"),
    (_FROM_DISTANCE, r"from \1 away"),
    (_WITH_REMAINING, r"is \3 from \1 \2"),
    (_LEFT_FIRST, r"\3, \1 from \2, "),
    (_LEAVING, r" \1 before "),
    (_BEFORE_REACHING, r"\1 before "),
    (_WHERE_IT_STARTS, ", starting "),
    (_RESPECTIVELY, r"\3 is \1 \2 and \6 \4 \5"),
    (_IN_FRONT_FIRST, _behind_front),
)
