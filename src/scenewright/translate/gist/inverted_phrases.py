"""Turns of phrase that put the deed or the way first, as a noun or in the passive, and whoever does it after.

What enters: nothing. What leaves: `INVERTED_PHRASES`, patterns with what to say instead, in their order: "a right turn
is planned for it" is "it plans a right turn", "a complete stop is made by it" is "it comes to a complete stop".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, Rules

_WHO = r"(?:it|the ego(?: vehicle)?|the hero(?: vehicle)?|the other (?:vehicle|car))"
_TURN = r"(?:left|right) turn"
_AIM = r"(?:goal|aim|intention|plan|wish|objective)"
# "A right turn onto the road, to travel westbound, is planned for it", "A left turn is wanted by the hero"
_TURN_PLANNED = re.compile(
    rf"{BEGINS}[Aa] ({_TURN}[^.;:]{{0,80}}?),? is (?:planned|intended|foreseen|wanted|desired|made) (?:for|by) "
    rf"({_WHO})\b"
)
_TURN_PLANNED_WHICH = re.compile(
    rf"{BEGINS}[Aa] ({_TURN}[^.;:]{{0,80}}?),? is (?:planned|intended|foreseen|wanted|desired) (?:for|by) ({_WHO}), "
    r"(which|who) ([^,.;\d]{3,60})(?=\.)"
)
_TURN_IS_GOAL = re.compile(rf"{BEGINS}[Aa] ({_TURN}[^,.;:]{{0,60}}) is the {_AIM} of ({_WHO})\b")
_GOAL_IS_TURN = re.compile(rf"{BEGINS}[Tt]he {_AIM} of ({_WHO})((?:, [^,.;:]{{3,60}},)?) is (?=an? {_TURN}\b)")
_TURN_IS_ONE = re.compile(rf"{BEGINS}[Tt]he turn of ({_WHO}) is a (left|right) one,?")
_HAS_BEFORE_IT = re.compile(
    rf"\bhas (an? {_TURN}) (?:before|ahead of|in front of) (?:it|him|her)(?:,? after which (?:it|he|she) will "
    rf"be)?",
    re.IGNORECASE,
)
_BEGUN_BY = re.compile(
    rf"\b(?:a|the) (deceleration|acceleration|braking) is (?:begun|started|initiated|commenced) by ({_WHO})\b",
    re.IGNORECASE,
)
_MADE_BY = re.compile(
    rf"\b(a (?:complete |full )?(?:stop|standstill|halt)) is (?:made|reached|come to) by "
    rf"({_WHO})\b",
    re.IGNORECASE,
)
_TAKES_TO_STOP = re.compile(
    r"\b(?:and )?takes (?:it|him|her) to (?=a (?:complete |full )?(?:stop|standstill"
    r"|halt)\b)",
    re.IGNORECASE,
)
_CONTINUES_TO_STOP = re.compile(
    r"\band continues(?: this| so| braking| decelerating)? (?=(?:to|until) a (?:complete |full )?(?:stop|standstill"
    r"|halt)\b)",
    re.IGNORECASE,
)
_STOP_TO_BE = re.compile(
    rf"\b(stop|standstill|halt),? (?:which is to be|which is|made|to be made|to be reached) (?:at )?(?={AMOUNT} "
    rf"(?:behind|before|short|from|ahead))",
    re.IGNORECASE,
)
_PLACE_OF_STOP = re.compile(rf"{BEGINS}The place (?:of|for) (?:the|its|this) (?:stop|standstill|halt) is (?={AMOUNT})")
_TURN_IS_COMPLETED = re.compile(
    r"(?:; |, |\bsuch that |\bso that )(its|his|her) turn is (?:completed|complete|finished|over|done) "
    r"(?=before\b)",
    re.IGNORECASE,
)
_IS_BEHIND_IT = re.compile(
    r"\b(?:so that|such that) the conflict point is behind (?:it|him|her) (?=before\b)", re.IGNORECASE
)
_DECIDED_BY = re.compile(
    rf"\bthe (?:matter|case|situation|order|question) is (?:decided|settled|resolved) by "
    rf"({_WHO}), which\b",
    re.IGNORECASE,
)
_YIELDING_BY = re.compile(
    rf"{BEGINS}[Yy]ielding is (?:done|left to|practised)(?: here)?(?: by)? (a hero(?: vehicle)?|a second "
    rf"(?:vehicle|car)) (?:that|which) "
)
_SHOULD_IT_BE = re.compile(rf"{BEGINS}Should ({_WHO}) be (?={AMOUNT})")
_WHEN_IT_STARTS = re.compile(
    rf"{BEGINS}When (it|the ego) (?:starts|begins), ({AMOUNT} (?:from|before) (?:the|its) (?:intersection|stop "
    rf"line|conflict point)), "
    r"(?:it|the ego) (?:already )?(?=intends|wants|plans|is)"
)
_LIES_AHEAD = re.compile(
    rf"\b({AMOUNT}) (?:ahead|in front) of (?:it|him|her|the ego) (?:lies|is) (the (?:intersection|stop line))",
    re.IGNORECASE,
)
_ON_THE_MOVE = re.compile(r"\b(?:it is on the move again|it gets going again), accelerating (?=to\b)", re.IGNORECASE)
_SUBJECT_OF_TEST = re.compile(
    rf"{BEGINS}(?:The )?[Ss]ubject of (?:the|this|our) (?:evaluation|test|study|assessment) is (?:the|an?) "
    r"(?:vehicle|car) (?:that|which) "
)
_OF_THAT_TRAFFIC = re.compile(r"\b(The ego) (?:belongs to|is part of) (?:that|this|the same) traffic: it\b")
_ENTERS_SCENE = re.compile(
    r"\benters the (?:scene|scenario|test|picture) (?:at|with) (?=[\d.]+ ?(?:m/s|km/h|kph|mph)\b|\w+_(?:mps|kmph"
    r"|kmh|mph)\b)",
    re.IGNORECASE,
)
_WANTS_SOONER = re.compile(r",? and wants (?:it|this|to do so) (?:sooner|first|earlier)(?=[.;])", re.IGNORECASE)


def _comes_to(found: re.Match[str]) -> str:
    """Return "and takes it to" as "and comes to", "takes it to" as "comes to"."""
    return "and comes to " if found.group().lower().startswith("and ") else "comes to "


# In this order: what one rule leaves, the next may read.
INVERTED_PHRASES: Rules = (
    (_TURN_PLANNED_WHICH, r"\2, \3 \4, wants a \1"),
    (_TURN_PLANNED, r"\2 wants to make a \1"),
    (_TURN_IS_GOAL, r"\2 wants to make a \1"),
    (_GOAL_IS_TURN, r"\1\2 wants to make "),
    (_TURN_IS_ONE, r"\1 turns \2"),
    (_HAS_BEFORE_IT, r"makes \1"),
    (_BEGUN_BY, r"\2 begins \1"),
    (_MADE_BY, r"\2 comes to \1"),
    (_TAKES_TO_STOP, _comes_to),
    (_CONTINUES_TO_STOP, ""),
    (_STOP_TO_BE, r"\1 "),
    (_PLACE_OF_STOP, "It stops "),
    (_TURN_IS_COMPLETED, r", completing \1 turn "),
    (_IS_BEHIND_IT, "so that it passes the conflict point "),
    (_DECIDED_BY, r"\1"),
    (_YIELDING_BY, r"There is \1 that yields. It "),
    (_SHOULD_IT_BE, r"If \1 is "),
    (_WHEN_IT_STARTS, r"It starts \2 and "),
    (_LIES_AHEAD, r"\1 before \2"),
    (_ON_THE_MOVE, "it accelerates "),
    (_SUBJECT_OF_TEST, "The subject vehicle "),
    (_OF_THAT_TRAFFIC, r"\1"),
    (_ENTERS_SCENE, "starts at "),
    (_WANTS_SOONER, ", without yielding"),
)
