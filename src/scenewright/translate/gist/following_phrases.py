"""Turns of phrase for one vehicle behind the other: "a 15 m gap", "what the ego has in front of it is the hero".

What enters: nothing. What leaves: `FOLLOWING_PHRASES`, patterns with what to say instead, in their order: "in the
same lane as the ego, ahead of it" is "ahead of the ego in the same lane", "a 1.5 s time gap" is "a time gap of 1.5
s".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, Rules

_EGO = r"(?:the ego(?: vehicle)?|ego)"
_HERO = r"(?:the hero(?: vehicle)?|the other (?:vehicle|car)|the (?:car|vehicle|one) (?:in front|ahead))"
_LANE = r"(?:the same|its|the ego['\u2019]s(?: own)?|that) lane(?: as the ego)?(?: (?:of|in|on) the (?:driveway|road))?"
_AHEAD = r"(?:ahead|in front)"
_GAP = r"(?:time gap|gap|time headway|headway|distance|following distance|spacing)"
_RATE = r"(?:[\d.]+ ?(?:m/s\^2|m/s\u00b2|m/s2|g|ft/s\^2)|\w+_mpss)"
_SHORT = r"(?:[\d.]+|[a-z]+)[ -](?:m|met(?:re|er)s?|ft|foot|feet|yd|yards?|s|seconds?)"

_IN_LANE_AHEAD = re.compile(rf"\b(?:also )?in {_LANE},? (?:and )?({_AHEAD} of) (it|{_EGO})\b", re.IGNORECASE)
_AHEAD_IN_LANE = re.compile(rf"\b({_AHEAD} of {_EGO}) in {_LANE}", re.IGNORECASE)
_SAME_AS_EGO = re.compile(rf"\bin the same lane as {_EGO}\b", re.IGNORECASE)
_LIKE_EGO = re.compile(
    rf"(\b(?:left|right|straight)\b[^.;]{{0,40}}?),? (?:as for|(?:again |just )?like|as with) "
    rf"{_EGO}(?:['\u2019]s)?(?=[.;]|,(?! (?:which|who|that|whose)\b))"
    rf"|(?<=left|ight) as {_EGO} (?:will|does|is going to)(?=[.,;])",
    re.IGNORECASE,
)
_AS_WELL_NAMELY = re.compile(r"\b(?:as well|too), namely (?=in |on )", re.IGNORECASE)
_NOT_ONLY = re.compile(rf"{BEGINS}Not only {_EGO} but also ({_HERO}) ", re.IGNORECASE)
_ONE_AHEAD = re.compile(
    rf"\b({_HERO}) is the (?:one|vehicle|car) ({_AHEAD})(?: of (?:it|{_EGO}))?(?:,? in the same lane)?(?=[.,;])",
    re.IGNORECASE,
)
_SAME_SITUATION = re.compile(rf"\bin the same situation as {_EGO},? (?:that is|i\.e\.|namely),? ", re.IGNORECASE)
_EXCEPT_AHEAD = re.compile(
    rf",? except that (?:it|he) is ({_AHEAD}) of {_EGO}|,? only ({_AHEAD}) of {_EGO}", re.IGNORECASE
)
_NOT_ALONE = re.compile(
    rf"{BEGINS}({_EGO}) is not alone(?: in its lane)?(?: (?:of|in|on) the (?:driveway|road))?[,:;] ?(?:because |for "
    rf"|since )?"
    rf"(?={_HERO}|{_AHEAD})",
    re.IGNORECASE,
)
_FRONT_IS_HERO = re.compile(
    rf"{BEGINS}The (?:vehicle|car|one) ({_AHEAD})(?: of (?:it|{_EGO}))?(?:,? in {_LANE},?)? is (the hero(?: "
    rf"vehicle)?)\b",
    re.IGNORECASE,
)
_WHICH_EGO_FOLLOWS = re.compile(
    rf"\b({_HERO}),? (?:which|whom|that) {_EGO} (?:is following|follows)(?: in {_LANE})?,? ", re.IGNORECASE
)
_HAS_AHEAD = re.compile(rf"{BEGINS}({_EGO}) has ({_HERO}) ({_AHEAD}) of it(?: in its lane)?(?=[,.])", re.IGNORECASE)
_WHAT_IS_AHEAD = re.compile(
    rf"{BEGINS}What ({_EGO}) has ({_AHEAD}) of it((?: on its way)?(?: \w+bound| east| west)?(?: along the road)?)"
    rf"(?: in its lane)? is ({_HERO}|an? [\w-]+)",
    re.IGNORECASE,
)
_HAS_IN_MIND = re.compile(
    rf"\bwhat ({_HERO}|it) (?:has in mind|plans|intends) is (a (?:left|right) turn)", re.IGNORECASE
)
_UNLIKE = re.compile(rf",? unlike (?:it|{_EGO}),(?= is| wants| will| does)", re.IGNORECASE)
_WITH_AMOUNT_FIRST = re.compile(rf"\b(a|an) ({_SHORT}) ({_GAP}|time to arrival|TTA)\b", re.IGNORECASE)
_FOLLOWING_AT = re.compile(
    rf"\b(?:is )?following ({_HERO}|it) at (?:an? )?({AMOUNT})(?! ?(?:per|/))(?=[.,;]| and| when|$)", re.IGNORECASE
)
_THAT_IS_GAP = re.compile(
    rf"{BEGINS}({AMOUNT}): (?:that|this) is the ({_GAP}) between the two when (?={_HERO})", re.IGNORECASE
)
_GAP_TRIGGERS = re.compile(
    rf"{BEGINS}An? ({_GAP}) of ({AMOUNT})( (?:from|between)[^.;]*?)? triggers (?:a|the) ({_RATE}) (?:braking"
    rf"|deceleration"
    rf"|stop) of ({_HERO}) to (?:a )?standstill",
    re.IGNORECASE,
)
_EGO_BACK = re.compile(rf"{BEGINS}({_EGO}) ({AMOUNT}) (?:back|behind), (?={_HERO}|on )", re.IGNORECASE)
_APART = re.compile(r"\bthe two(?: vehicles| cars)? are ((?:[\d.]+ ?|[a-z]+ )(?:s|seconds?)) apart\b", re.IGNORECASE)
_TO_STANDSTILL_WITH = re.compile(
    rf"\bgoes to a (?:standstill|stop) (?:with|at) ({_RATE})(?: of (?:braking|deceleration))?", re.IGNORECASE
)
_ITS_BRAKING = re.compile(rf"\b(?:begins?|starts?) (?:its|a) ({_RATE}) (?:braking|deceleration)\b", re.IGNORECASE)
_OF_BRAKING = re.compile(rf"\bwith ({_RATE}) of (?:braking|deceleration)\b", re.IGNORECASE)
_DEPENDS_ON = re.compile(
    rf"{BEGINS}The hero['\u2019]s (?:braking|reaction|response) (?:depends on|is tied to|is linked to|hinges on) "
    rf"(?:the|its) "
    rf"{_GAP}[:.] ",
    re.IGNORECASE,
)
_OFF_THE_BRAKES = re.compile(
    r",? and (?:it )?does not (?:come off|release|let go of|take its foot off) the brakes? (?=until\b)", re.IGNORECASE
)
_MEASURED_FROM = re.compile(rf"\b({_GAP}), measured (?:from|between|to)[^,.;\d]*,", re.IGNORECASE)

_ALSO_TURNS = re.compile(r"\balso (?=turns? (?:left|right)\b)", re.IGNORECASE)


def _ahead(found: re.Match[str]) -> str:
    return f" and {found.group(1) or found.group(2)} of the ego in the same lane"


def _told_alike(found: re.Match[str]) -> str:
    return found.group(1) or ""


# In this order: what one rule leaves, the next may read.
FOLLOWING_PHRASES: Rules = (
    (_IN_LANE_AHEAD, r"\1 \2 in the same lane"),
    (_AHEAD_IN_LANE, r"\1 in the same lane"),
    (_SAME_AS_EGO, "in the same lane"),
    (_LIKE_EGO, _told_alike),
    (_AS_WELL_NAMELY, ""),
    (_NOT_ONLY, r"\1 "),
    (_ONE_AHEAD, r"\1 is \2 of the ego in the same lane"),
    (_SAME_SITUATION, ""),
    (_EXCEPT_AHEAD, _ahead),
    (_NOT_ALONE, ""),
    (_FRONT_IS_HERO, r"\2 is \1 of the ego in the same lane"),
    (_WHICH_EGO_FOLLOWS, r"\1, ahead of the ego in the same lane, "),
    (_HAS_AHEAD, r"\2 is \3 of the ego in the same lane"),
    (_WHAT_IS_AHEAD, r"\2 of \1\3 is \4"),
    (_HAS_IN_MIND, r"\1 wants to make \2"),
    (_UNLIKE, ""),
    (_WITH_AMOUNT_FIRST, r"a \3 of \2"),
    (_FOLLOWING_AT, r"is \2 behind \1"),
    (_THAT_IS_GAP, r"When the \2 between the two is \1, "),
    (_GAP_TRIGGERS, r"When the \1\3 is \2, \5 brakes at \4 to a standstill"),
    (_EGO_BACK, r"With \1 \2 behind, "),
    (_APART, r"the time gap between the two is \1"),
    (_TO_STANDSTILL_WITH, r"brakes to a standstill at \1"),
    (_ITS_BRAKING, r"brakes at \1"),
    (_OF_BRAKING, r"at \1"),
    (_DEPENDS_ON, ""),
    (_OFF_THE_BRAKES, " "),
    (_MEASURED_FROM, r"\1"),
    (_ALSO_TURNS, ""),
)
