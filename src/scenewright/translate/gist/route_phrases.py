"""Turns of phrase for where a vehicle is and goes: "with the line 40 m ahead", "its route takes it left".

What enters: nothing. What leaves: `ROUTE_PHRASES`, patterns with what to say instead, in their order: "goes straight on
rather than turning into the driveway" is "goes straight on", "has the stop line 40 m ahead of it" is "is 40 m from it".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, Rules

_WHO = r"(?:the (?:ego|hero)(?: vehicle)?|ego|hero|it)"
_PLACE = r"(?:stop line|conflict point|intersection)"
_AHEAD = r"(?:ahead|away|in front)"
_OF_IT = r"(?: of (?:it|him|her|itself))?"

_HAS_LINE_AHEAD = re.compile(
    rf"\b(?:has|having) the ({_PLACE}) ({AMOUNT}) {_AHEAD}{_OF_IT}(?=[,.;]| at | initially| when| and)", re.IGNORECASE
)
_WHICH_HAS_LINE = re.compile(rf"\bwhich initially has the ({_PLACE}) ({AMOUNT}) {_AHEAD}{_OF_IT}", re.IGNORECASE)
_WITH_LINE_AHEAD = re.compile(
    rf",? (?:so that|with) the ({_PLACE}) (?:is |being |lying |still )?({AMOUNT}) {_AHEAD}{_OF_IT}(?=[,.;]| and)",
    re.IGNORECASE,
)
_WITH_LINE_FIRST = re.compile(
    rf"{BEGINS}With the ({_PLACE}) (?:still )?({AMOUNT}) {_AHEAD}, (?={_WHO} (?:starts|begins|is))", re.IGNORECASE
)
_LINE_IN_FRONT_OF = re.compile(
    rf"\bthe ({_PLACE}) ({AMOUNT}) {_AHEAD} of ({_WHO}) and the ({_PLACE}) ({AMOUNT}) {_AHEAD} of ({_WHO})",
    re.IGNORECASE,
)
_BEFORE_ANYTHING = re.compile(rf"{BEGINS}Before anything (?:else )?(?:happens|moves|begins),? ", re.IGNORECASE)
_BEFORE_IT_REACHES = re.compile(
    rf"\b({AMOUNT}) before (?:it|he|she) (?:reaches|arrives at|gets to|comes to) (?=(?:the|its) {_PLACE})",
    re.IGNORECASE,
)
_PATH_LEADS = re.compile(
    rf"\b({_WHO})['\u2019]s (?:path|route|way|journey) (?:leads|takes it|runs|goes) (?=out of|left|right|along|down"
    rf"|straight)",
    re.IGNORECASE,
)
_ASSIGNED_ROUTE = re.compile(
    r"\b(?:has been|is|was) (?:assigned|given) an? (?:route|path|task|course) (?:that|which) (?:takes|leads|brings) "
    r"it (?=left"
    r"|right|straight)",
    re.IGNORECASE,
)
_START_DISTANCE = re.compile(
    rf"{BEGINS}The (?:distance|gap) between (?:its|the ego['\u2019]s) start(?:ing)? ?(?:point|position|place)? and "
    rf"(the "
    rf"{_PLACE}) (?:amounts to|is|comes to) ({AMOUNT})",
    re.IGNORECASE,
)
_HEADING_AFTER = re.compile(
    r"\b(?:its|the ego['\u2019]s|the hero['\u2019]s) heading after (?:the|its|that) turn is (east|west|north|south)",
    re.IGNORECASE,
)
_IS_TURNER = re.compile(r"\bis (?:also )?an? (left|right)[ -]turner\b", re.IGNORECASE)
_RATHER_THAN_TURNING = re.compile(
    r",? (?:rather than|instead of|without) turning (?:off )?(?:into|onto|to) (?:the driveway|it)\b(?=[.,;]| and)",
    re.IGNORECASE,
)
_ROAD_EGO_WANTS = re.compile(
    rf"\b(the (?:road|driveway)),? (?:that|which|onto which|into which)? ?{_WHO} (?:wants|is going|intends|is about"
    rf"|has|plans"
    r"|is coming|comes) (?:to )?(?:turn onto|turn into|turn|join|enter|drive onto|out of)(?=[,.;])",
    re.IGNORECASE,
)
_WHERE_IT_JOINS = re.compile(
    r",? (?:at the point |there )?where the driveway (?:joins|meets|branches off|enters)(?: it| the road)?(?=[.,;])",
    re.IGNORECASE,
)
_UNTIL_BRANCHES = re.compile(
    r"\buntil (?:it|the hero|the ego) (?:branches|turns|bends|swings) (?:off )?(left|right) (?=into the driveway)",
    re.IGNORECASE,
)
_NOT_STRAIGHT_BUT = re.compile(
    r"\b(?:does not want to go straight(?: on)? but to turn|is not going straight(?: on)? but (?:is )?going to turn"
    r"|does not "
    r"go straight(?: on)? but turns)\b",
    re.IGNORECASE,
)
_AS_FOR = re.compile(rf"{BEGINS}As for (the hero|the ego), it ", re.IGNORECASE)
_WHERE_IT_IS_HEADED = re.compile(
    rf"\bthe driveway is where {_WHO} is (?:headed|going|heading|bound),? by (?:way|means) of (a (?:left|right) turn)",
    re.IGNORECASE,
)
_BY_CONTRAST = re.compile(r", (?:by|in) contrast,|, on the other hand,", re.IGNORECASE)
_ROUTE_EQUALS = re.compile(
    r"\b(?:(?:route|manoeuvre)\s+(?:= ?)?|turn ?= ?)(left|right)(?=;| into| onto| turn|,|\.)", re.IGNORECASE
)
_FROM_BOUND = re.compile(
    r"\b((?:the )?(?:ego|hero)(?: vehicle)?),? (?:coming )?from (east|west)bound,? (?=turns? (?:left|right)|goes"
    r"|wants)",
    re.IGNORECASE,
)
_SAME_FOR_BOTH = re.compile(
    rf"{BEGINS}(?:the )?same driveway for both(?: of them| vehicles| cars)?(?: again| this time| here)?[:,.] ",
    re.IGNORECASE,
)
_PLAN_OF = re.compile(
    r"\bthe (?:plan|intention|aim|goal|task|wish|manoeuvre) of (the (?:ego|hero)(?: vehicle)?)(, [^;.]*?,)? is to "
    r"(?=[a-z])",
    re.IGNORECASE,
)
_ON_THE_ROAD_THEN = re.compile(
    r"\b((?:will|to|then|and|is going to|should|shall) (?:then )?(?:head|go|drive|travel|continue|proceed)s? "
    r"(?:east|west)) (?:on|along) "
    r"the road\b",
    re.IGNORECASE,
)
_SAME_AS_EGO = re.compile(
    r"\b(the same (?:driveway|road|lane|direction|way|turn)) as (?:the )?ego(?: vehicle)?(?=[.,;]| and)", re.IGNORECASE
)
_HEADED_FOR = re.compile(
    r"\bthe driveway (?:that |which )?(?:the ego|it) (?:is headed for|wants to (?:enter|turn into)|is going to "
    r"(?:enter|turn"
    r" into))(?=[.,;]| and)",
    re.IGNORECASE,
)
_TURNING_IS_AIM = re.compile(
    rf"{BEGINS}(?:Turning|Going) (left|right) ([^.,;]*?) is the (?:intention|aim|plan|goal|wish) of (the (?:hero"
    rf"|ego))\b",
    re.IGNORECASE,
)
_OPPOSITE = re.compile(r", opposite (?:to )?the ego,", re.IGNORECASE)
_NOT_STRAIGHT = re.compile(
    r"\b(?:doesn['\u2019]t|does not) (?:go|drive) straight(?: on)? but (?=wants|turns|is going|intends)", re.IGNORECASE
)
# "Hero and ego share a destination: the driveway", "share a destination, the driveway, which the ego enters by"
_SHARE_DESTINATION = re.compile(
    r"\b(?:share|have) (?:a|the same|one) (?:destination|goal|target)[,:;] (?:namely )?the driveway(?=[,.;])",
    re.IGNORECASE,
)


def _goes_on_road(found: re.Match[str]) -> str:
    """Return "comes out of the driveway and will head east on the road" without the road that it comes onto."""
    sentence = re.split(r"[.;]\s", found.string[: found.start()])[-1].lower()
    leaves = re.search(r"\b(?:from|out of|leav\w+|in|down|exit\w*) the driveway", sentence)
    return found.group(1) if leaves and not re.search(r"\b(?:while|whereas|hero|other)\b", sentence) else found.group()


def _two_lines(found: re.Match[str]) -> str:
    place, first, who, there, second, other = found.groups()
    return f"{who} {first} from the {place} and {other} {second} from the {there}"


# In this order: what one rule leaves, the next may read.
ROUTE_PHRASES: Rules = (
    (_WHICH_HAS_LINE, r"which is initially \2 from the \1"),
    (_HAS_LINE_AHEAD, r"is \2 from the \1"),
    (_LINE_IN_FRONT_OF, _two_lines),
    (_WITH_LINE_FIRST, r"\2 from the \1, "),
    (_WITH_LINE_AHEAD, r" \2 from the \1"),
    (_BEFORE_ANYTHING, "Initially "),
    (_BEFORE_IT_REACHES, r"\1 before "),
    (_PATH_LEADS, r"\1 goes "),
    (_ASSIGNED_ROUTE, "goes "),
    (_START_DISTANCE, r"It starts \2 from \1"),
    (_HEADING_AFTER, r"it then heads \1"),
    (_IS_TURNER, r"turns \1"),
    (_RATHER_THAN_TURNING, ", straight on"),
    (_ROAD_EGO_WANTS, r"\1"),
    (_WHERE_IT_JOINS, ""),
    (_UNTIL_BRANCHES, r"and then turns \1 "),
    (_NOT_STRAIGHT_BUT, "wants to turn"),
    (_AS_FOR, r"\1 "),
    (_WHERE_IT_IS_HEADED, r"it makes \1 into the driveway"),
    (_BY_CONTRAST, ""),
    (_ROUTE_EQUALS, r"turns \1"),
    (_FROM_BOUND, r"\1 drives \2bound and "),
    (_PLAN_OF, r"\1\2 wants to "),
    (_ON_THE_ROAD_THEN, _goes_on_road),
    (_SAME_AS_EGO, r"\1"),
    (_HEADED_FOR, "the same driveway"),
    (_TURNING_IS_AIM, r"\3 wants to turn \1 \2"),
    (_OPPOSITE, ","),
    (_NOT_STRAIGHT, ""),
    (_SAME_FOR_BOTH, ""),
    (_SHARE_DESTINATION, "both go into the driveway"),
)
