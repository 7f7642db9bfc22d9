"""Says in plain words what a text says in an idiom, before it is cut into tokens.

What enters: the text. What leaves: the text, every character of the rest in its place: "No sooner is the ego 9 m from
it than the van brakes" is "When the ego ...", "the point where their paths cross" is "the conflict point", "car A" is
the ego where that is said.
"""

from __future__ import annotations

import re

_WAYS = r"(?:paths|ways|lanes|routes|tracks|trajectories|courses)"
_MEET = r"(?:cross|meet|merge|intersect|join|conflict|(?:come|run) together)"
_CROSSING = re.compile(
    r"(?:(?:point|spot|place) (?:where|at which|in which)|(?<=from )where|(?<=short of )where) "
    rf"(?:their|the|the two|both|our|its|your|these|two) (?:two )?{_WAYS} {_MEET}\b",
    re.IGNORECASE,
)
# "No sooner is the ego 9 m from the line than the van brakes"
_NO_SOONER = re.compile(r"\bNo sooner((?: \w+)(?:(?!\bthan\b|[;!?]|\.\s).)*?)\bthan\b", re.IGNORECASE)
_WAIT_UNTIL = re.compile(r"(?<=[.!?;] )Wait until\b")
# "Once two conditions hold at the same time, ..."
_HOLD = re.compile(
    r"\b(?:once|when|as soon as) (?:the following |these |both |two |the )?(?:two )?conditions? "
    r"(?:holds?|(?:are|is) (?:met|fulfilled|true|satisfied|given))"
    r"(?: (?:together|at the same time|simultaneously|at once))?(?:,|:| -)?(?: namely(?: that)?,?)?",
    re.IGNORECASE,
)
_THAT_IS = re.compile(r", that is,")
_LETTERED = re.compile(r"\b(?:car|vehicle|actor|agent|driver) ([A-D]|\d)\b", re.IGNORECASE)
_IS_EGO = r"\b(?:car|vehicle|actor|agent|driver) {}(?:,? which is|,? being| is|,|:| =)?\s*\(?(?:the |our )?(?:{})\b"
_EGOS = r"ego|(?:car|vehicle|one) (?:under test|being tested)|AV|SUT|subject vehicle|test (?:car|vehicle)"


def without_idioms(text: str) -> str:
    """Return the text in plain words."""
    text = _HOLD.sub(lambda found: _padded("When", found), text)
    text = _WAIT_UNTIL.sub(lambda found: _padded("When", found), text)
    text = _NO_SOONER.sub(lambda found: "When".ljust(9) + found.group(1) + ",".ljust(4), text)
    text = _THAT_IS.sub(lambda found: _padded(",", found), text)
    if names := letters(text):
        text = _LETTERED.sub(lambda found: _padded(names[found.group(1).upper()], found), text)
    return _CROSSING.sub(lambda found: _padded("conflict point", found), text)


def letters(text: str) -> dict[str, str]:
    """Return who "car A" and "car B" are, where one of two is said to be the ego."""
    found = list(dict.fromkeys(each.group(1).upper() for each in _LETTERED.finditer(text)))
    egos = [each for each in found if re.search(_IS_EGO.format(each, _EGOS), text, re.IGNORECASE)]
    if len(found) != 2 or len(egos) != 1:
        return {}
    return {each: "ego" if each == egos[0] else "hero" for each in found}


def _padded(words: str, found: re.Match[str]) -> str:
    return words.ljust(len(found.group()))
