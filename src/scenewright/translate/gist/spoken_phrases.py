"""Turns of phrase of people who tell a colleague rather than write a specification, with plain words for them.

What enters: nothing. What leaves: `SPOKEN_PHRASES`, patterns with what to say instead, in their order: "rolls to a
stop" is "comes to a stop", "for the ego remain 2 s to" is "the ego is 2 s from". Hardly anything that is said instead
is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, EGO, Rules

# "the tested vehicle, named ego, is", "the vehicle under test, referred to as the ego, is"
_NAMED = re.compile(
    r", (?:(?:which is |who is )?(?:here )?(?:named|called|referred to(?: here)? as|known as|denoted|termed|labelled)|"
    r"henceforth|hereafter|hereinafter|from now on) (?:the |our |as )?(ego|hero)(?: vehicle| car)?(?=[,.;])",
    re.IGNORECASE,
)
# "Somebody, call him the hero, is just leaving by the driveway"
_CALL_HIM = re.compile(
    r"\b(?:somebody|someone|another (?:car|driver|vehicle)|a (?:car|driver|vehicle|second car)), (?:let['\u2019]s )?"
    r"call (?:him|her|it|them) the hero,",
    re.IGNORECASE,
)
_ROLLS_TO_STOP = re.compile(
    r"\b(roll|glid|coast|draw|eas)(s|ing|es|e)? to (?=(?:a|an|its) (?:complete |full )?(?:stop|halt|standstill)\b(?! "
    r"line))",
    re.IGNORECASE,
)
_KEEPS_IT = re.compile(
    r",? (?:which (?:it|he|she|the [\w-]+) (?:maintains|keeps(?: up)?|holds|sustains)|and (?:maintains|keeps|holds) "
    r"(?:it|this|that)(?: up)?) (until|till)\b",
    re.IGNORECASE,
)
_AND_NOT_BEFORE = re.compile(r", (?:and )?not (?:before|earlier|sooner)(?: than that)?,", re.IGNORECASE)
_IGNORES_PRIORITY = re.compile(
    r"\b(?:disregards?|ignores?|violates?|neglects?|flouts?) (the [\w-]+|[A-Z]+)['\u2019]s (?:priority|right of way"
    r"|precedence)\b",
    re.IGNORECASE,
)
_FREE_WAY = re.compile(r", leaving (?:the|its) (?:way|road|path) (?:free|clear|open)(?=[,.;])", re.IGNORECASE)
_WAITS_FOR_NOBODY = re.compile(
    r"\bdecides (?:that )?(?:it|he|she) (?:isn['\u2019]t|is not|won['\u2019]t|will not) "
    r"(?:wait|waiting|yield|yielding) (?:for|to) (?:anybody|anyone|us|the ego)\b",
    re.IGNORECASE,
)
_RIGHT = re.compile(
    r"(?P<before>[\w']+ |[,;:.] |^)(?P<right>[Rr]ight) "
    r"(?=(?:when|as|behind|across|after|away|at (?:that|this|the) (?:moment|instant|time))\b)"
)
# "brakes right when", but not "swings right when"
_BEFORE_JUST = frozenset(
    ["brake", "brakes", "braking", "stop", "stops", "stopping", "decelerate", "decelerates", "accelerate",
     "accelerates", "act", "acts", "start", "starts", "begin", "begins", "and", "point", "line", "speed"]
)  # fmt: skip
_REMAIN = re.compile(
    rf"\bfor ((?:the |our )?[\w-]+) (?:there )?(?:remains?|(?:is|are) left) ({AMOUNT})(?: left)? to\b", re.IGNORECASE
)
_ONE_OF_THEM = re.compile(
    r"(?<=: )one (?=[A-Z]{2,}\b|truck|van|lorry|car|bus|taxi)|\b[Aa] single (?=(?:\w+bound )?\w+)"
)
_AT_REST_WHEN = re.compile(
    r"\bis (?:at rest|stationary|standing|stopped) (?:when|with) "
    rf"({AMOUNT}) (?:remain|are left|remaining|left) (?:between (?:it|him|her) and|to) "
    r"(?=the |its )",
    re.IGNORECASE,
)
_GETS_TO_ZERO = re.compile(
    r"\bbrakes? down to zero, which is reached ((?:[\w.-]+ ){1,3})(short of|before|from) ", re.IGNORECASE
)
_BY_STOPPING = re.compile(r"\b(?:and )?makes room for ((?:the )?[\w-]+) by stopping\b", re.IGNORECASE)
_STAYS_WITH_IT = re.compile(r",? (?:and|but) (?:it )?(?:doesn['\u2019]t|does not) turn anywhere\b", re.IGNORECASE)
_FAR_FROM = re.compile(r", far from (?:slowing(?: down)?|braking|yielding|stopping),", re.IGNORECASE)
_CHANGE_OF_HEART = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:Then comes|There follows|But then comes) (?:the|a) change of (?:heart|mind):", re.IGNORECASE
)
_NOT_FOR_GOOD = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:But )?(?:not|never) (?:for good|for long|for ever|forever): ", re.IGNORECASE
)
_DOES_NOT_STAY = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:But )?(?:it|he|she) (?:doesn['\u2019]t|does not|won['\u2019]t) (?:stay (?:put|there"
    r"|like that)"
    r"|leave it at that),? ?(?:though|however)?[,:;] ",
    re.IGNORECASE,
)
_LIKE_IT_WANTS = re.compile(
    r", (?:like|as if|as though) (?:it|he|she) (?:wants|wanted|meant|means|were|was going|is going) to let "
    r"(?:the \w+|us|it) (?:out|in|go|pass)(?=[.,;])",
    re.IGNORECASE,
)
_ITS_WAY_GOES = re.compile(r"\b(?:its|his|her) way (?:goes|leads|is) to the (?=left|right)", re.IGNORECASE)
_GOAL = re.compile(r"\bwith the (?:goal|aim|intention|wish|plan|purpose) (?:to|of) (turn|driv|go)", re.IGNORECASE)
_HAS_GOAL = re.compile(r"\bhas the (?:goal|aim|intention|wish|plan|desire) to (?=turn|drive|go|make)", re.IGNORECASE)
_BEGINS_TEST = re.compile(
    r"\b(begins|starts) the (?:test|run|scenario|simulation) (?=on |at |in |from |with |[\d.]+ )", re.IGNORECASE
)
_SECOND_ONE = re.compile(
    r"\bthe second(?: one)?(?= (?:is|brakes|stops|slows|accelerates|has|comes|passes|starts|begins)\b)", re.I
)
_A_SECOND = re.compile(r"\ba second (?:vehicle|car|driver|motorist)\b", re.IGNORECASE)

# "initial_ego_s left until it reaches the intersection", "with 7 seconds remaining before it arrives at the line"
_LEFT_UNTIL = re.compile(
    rf"\b({AMOUNT}) (?:left|remaining|to go) (?:until|before|till) (?:it|he|she|the ego|the hero) "
    r"(?:reaches|arrives at|gets to|comes to) (?=(?:the|its) (?:stop line|intersection|conflict point)\b)",
    re.IGNORECASE,
)
_BEGINS_WHEN_AT = re.compile(
    r"\b(begins|starts) (?=(?:the (?:test|run) )?(?:on|in|at|from)\b)((?:[^.;,]|\.\d)*(?:, \w+,?)?) "
    rf"when (?:it|he|she) is (?={AMOUNT})",
    re.IGNORECASE,
)
_TIMES_TO_REACH = re.compile(
    rf"\b(the [\w-]+|[A-Z]+)['\u2019]s (?:time|distance) to (?:reach |arrive at |get to )?"
    rf"(the (?:conflict point|stop line|intersection)) is ({AMOUNT}),? and (the [\w-]+|[A-Z]+)['\u2019]s "
    rf"(?:time|distance) to (?:reach |arrive at |get to )?it is ({AMOUNT})(?=[,.;])",
    re.IGNORECASE,
)
_IS_IN_FRONT = re.compile(
    r", which is the (?:vehicle|car|one) (?:in front|ahead|in the lead|further ahead),", re.IGNORECASE
)
_ITSELF = re.compile(r"\b(road|driveway|street|lane) itself\b", re.IGNORECASE)
_AFTER_BEGINNING = re.compile(
    rf"\bafter (?:having )?(?:begun|started|beginning|starting|set out|setting out) (?={AMOUNT})", re.IGNORECASE
)
_FIRST_OF_ALL = re.compile(r"\b(Hero|POV|NPC|Target|The hero), (?:1st|first|step 1):", re.IGNORECASE)
_SECOND_OF_ALL = re.compile(r"\b(Hero|POV|NPC|Target|The hero), (?:2nd|second|step 2):", re.IGNORECASE)
_JOINS_STORY = re.compile(
    r"\bwhen we (?:join(?: the (?:story|scene|action))?|tune in|come in|pick up the story|meet (?:it|him|them)|"
    r"first see it|look on),? (?=(?:it|the \w+) is\b)",
    re.IGNORECASE,
)
_DISTANCE_BEFORE = re.compile(r"\b(distance) before (?=the |its )", re.IGNORECASE)
_UNDER_TEST_IS = re.compile(r"(?:(?<=[.!?]\s)|(?<=\n)|^)Under test is (?:an?|the|our) (?=[a-z])", re.IGNORECASE)
_IN_MIND = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)(Left|Right|Straight)\b([^:.;]*): (?:that['\u2019]s|that is|this is) (?:what|the "
    r"(?:wish|plan|aim|intention|goal) of) ((?:an?|the|our) [\w ]+?)(?: has in mind| wants| has planned| "
    r"intends)?(?=[,.])"
)
_CUTS_ACROSS = re.compile(
    r"\b(?:To get there,? )?it (?:must|has to|needs to|will) (?:cut across|cross|merge into|join) the (?:path|way"
    r"|lane) "
    r"of (?=an? )",
    re.IGNORECASE,
)
_ITS_BOWS = re.compile(r"\bacross (its|our|the ego['\u2019]s|their) (?:bows?|nose|bonnet|front|path)\b", re.IGNORECASE)
_DECENT = re.compile(
    r",? but (?:it |he |she )?(?:does|do) the (?:decent|polite|right|kind|sensible) thing(?::|;| and)?", re.IGNORECASE
)
_MADE_TURN = re.compile(
    r"\b(?:ma(?:ke|kes) (?:its|their|his|her) turn),? and (?:it|they|he|she) (?:has|have) (?:finished|completed) it "
    r"(?=before)",
    re.IGNORECASE,
)
_IS_DISTANCE = re.compile(
    rf"(?:(?<=[.!?]\s)|^)({AMOUNT}) is (the [\w-]+['\u2019]s (?:initial |starting )?(?:distance|time) (?:from|to) "
    r"the (?:intersection|stop line|conflict point))",
    re.IGNORECASE,
)
_LET_COME = re.compile(
    rf"(?:(?<=[.!?]\s)|^)Let ((?:the |our )?{EGO}|it) (?:come|get|advance|drive|approach|go) to ({AMOUNT})",
    re.IGNORECASE,
)
_THAT_IS_WHEN = re.compile(r"\b(?:that|this)(?:['\u2019]s| is) (?:when|the moment)\b", re.IGNORECASE)
_NOW_ACTS = re.compile(r"(?<=[a-z]): now (?=(?:the|it|he|she)\b)")
_RESOLVES = re.compile(r"\bresolves (?=(?:not )?to\b)", re.IGNORECASE)
_ONTO_BRAKES = re.compile(r"\bgoes onto the brakes\b", re.IGNORECASE)
_OWN_IS = re.compile(r"['\u2019]s own (?=is )")
_BEFORE_AGAIN = re.compile(
    r"\b((?:allow|let)s (?:the \w+|it|us) (?:to )?(?:complete its turn|pass(?: the conflict point)?|go)) before "
    r"(?:setting|moving|starting|driving) (?:off|on)(?: again)?(?: to (pass|cross)| and (?:passing|crossing))",
    re.IGNORECASE,
)
_AFTER_STOPPED = re.compile(
    r"\b((?:[\d.]+|[a-z]+) (?:s|seconds?)) after (?:it|he|she|the \w+) (?:has |had )?(?:stopped|come to a (?:stop|halt)"
    r"|halted),? (?=(?:it|he|she|the \w+) )",
    re.IGNORECASE,
)
_BECAUSE_WANTS = re.compile(r"\bbecause (?:it|he|she) (?=wants to|is to|is going to|intends to)", re.IGNORECASE)
_APPROACHES_ROAD = re.compile(r"\bapproach(es|ing) the (?:main )?road (?:on|along) (?=the |a )", re.IGNORECASE)
_AMOUNT_OF = re.compile(
    rf"\b({AMOUNT}) \((the \w+|\w+) (?:to|from) (the (?:stop line|conflict point|intersection))\)", re.IGNORECASE
)
_CONSISTS_OF = re.compile(
    r"\b(?:the )?oncoming traffic,? (?:which consists|consisting|that consists) of (?:a|one) (?:single )?",
    re.IGNORECASE,
)
_NO_MOOD = re.compile(
    r"\b(?:is|are) (?:in no mood|not (?:willing|prepared|inclined)|unwilling) to (wait|yield|give way)\b", re.IGNORECASE
)

# "GVT: at a standstill at the stop line"
_LISTED_STANDING = re.compile(
    r"(?<=: )(?:at (?:a )?standstill|stationary|at rest|standing(?: still)?|stopped|parked) (?=at (?:the|its) stop "
    r"line\b)",
    re.IGNORECASE,
)

_EACH_OF_THEM = re.compile(r"\beach of (?:them|the two|these two)\b(?= (?:intends|wants|plans|means|is|will)\b)", re.I)
_THRU = re.compile(r"\b(?:gets|goes|drives|passes) thru\b", re.IGNORECASE)
_WE_THE_EGO = re.compile(
    r"\b(we|I), (?:the|being the|who are the) ego,(?= (?:are|am|were|want|drive|come"
    r"|turn)\b)",
    re.I,
)
# "gives way: on the brakes, and stationary 11 m before the conflict point"
_ON_THE_BRAKES = re.compile(
    r"(?<=[:,]) on the brakes,? and (?:stationary|stopped|at rest|standing) (?=[\d.]+ |[a-z]+ (?:m|met|ft|feet|y)"
    r"|\w+_m\b)",
    re.IGNORECASE,
)

# "Hero 1) brakes to a stop 2) then accelerates"
_NUMBERED = re.compile(r" \(?1\) ([^\n.;]{3,90}?),? \(?2\) (then |and then )?(?=[a-z])")


def _right(found: re.Match[str]) -> str:
    """Return "brakes right when" as "brakes when", but leave "swings right when"."""
    before = found["before"]
    if before.strip().isalpha() and before.strip().lower() not in _BEFORE_JUST:
        return found.group()
    return before if before.strip() not in ("", ".") else before + "Just "


def _other(found: re.Match[str]) -> str:
    """Return "the second one" as "the other", where "a second vehicle" was brought in."""
    return "the other" if _A_SECOND.search(found.string[: found.start()]) else found.group()


def _again(found: re.Match[str]) -> str:
    """Return "lets it go before setting off again to pass" as "lets it go, then sets off and passes"."""
    return f"{found.group(1)}, then it goes and passes"


def _when_at(found: re.Match[str]) -> str:
    """Return "Let it come to 20 m" as "When it is 20 m", where nothing after it says so: "That's when ..."."""
    rest = found.string[found.end() : found.end() + 200]
    return found.group() if _THAT_IS_WHEN.search(rest) else f"When {found.group(1)} is {found.group(2)}"


def _approaches(found: re.Match[str]) -> str:
    """Return "approaches the main road on" as "is on"."""
    return "is on " if found.group(1).lower() == "es" else "being on "


def _comes(found: re.Match[str]) -> str:
    """Return "rolling to a stop" as "coming to a stop"."""
    return "coming to " if found.group(2).lower() == "ing" else "comes to "


def _goal(found: re.Match[str]) -> str:
    """Return "with the goal to turn" as "and is to turn", "with the aim of turning" as "turning"."""
    return f"wanting to {found.group(1)}" if " to " in found.group() else found.group(1)


# In this order: what one rule leaves, the next may read.
SPOKEN_PHRASES: Rules = (
    (_NAMED, r", the \1"),
    (_CALL_HIM, "the hero"),
    (_ROLLS_TO_STOP, _comes),
    (_KEEPS_IT, r" \1"),
    (_AND_NOT_BEFORE, ","),
    (_IGNORES_PRIORITY, r"won't yield to \1"),
    (_FREE_WAY, ""),
    (_WAITS_FOR_NOBODY, "won't wait"),
    (_RIGHT, _right),
    (_REMAIN, r"\1 is \2 from"),
    (_ONE_OF_THEM, "a "),
    (_AT_REST_WHEN, r"stops \1 from "),
    (_GETS_TO_ZERO, r"brakes and stops \1\2 "),
    (_BY_STOPPING, r"yields to \1, stopping"),
    (_STAYS_WITH_IT, ", going straight"),
    (_FAR_FROM, ""),
    (_CHANGE_OF_HEART, "Then"),
    (_NOT_FOR_GOOD, "Then "),
    (_DOES_NOT_STAY, "Then "),
    (_LIKE_IT_WANTS, ""),
    (_ITS_WAY_GOES, "it turns "),
    (_HAS_GOAL, "wants to "),
    (_GOAL, _goal),
    (_CONSISTS_OF, "an oncoming "),
    (_NO_MOOD, r"won't \1"),
    (_SECOND_ONE, _other),
    (_LEFT_UNTIL, r"\1 from "),
    (_BEGINS_WHEN_AT, r"\1 \2 "),
    (_TIMES_TO_REACH, r"\1 is \3 and \4 \5 from \2"),
    (_IS_IN_FRONT, ", which is ahead,"),
    (_ITSELF, r"\1"),
    (_AFTER_BEGINNING, "starting "),
    (_FIRST_OF_ALL, r"\1"),
    (_SECOND_OF_ALL, r"Then \1"),
    (_JOINS_STORY, "at first "),
    (_DISTANCE_BEFORE, r"\1 to "),
    (_UNDER_TEST_IS, "The ego is a "),
    (_IN_MIND, r"\3 turns \1\2"),
    (_CUTS_ACROSS, "there is "),
    (_ITS_BOWS, r"across \1 way"),
    (_DECENT, "."),
    (_MADE_TURN, "complete the turn "),
    (_IS_DISTANCE, r"\2 is \1"),
    (_LET_COME, _when_at),
    (_NOW_ACTS, ", "),
    (_RESOLVES, "decides "),
    (_ONTO_BRAKES, "brakes"),
    (_OWN_IS, " "),
    (_BEFORE_AGAIN, _again),
    (_AFTER_STOPPED, r"After \1 "),
    (_BECAUSE_WANTS, "and "),
    (_APPROACHES_ROAD, _approaches),
    (_AMOUNT_OF, r"\2 \1 from \3"),
    (_BEGINS_TEST, r"\1 "),
    (_LISTED_STANDING, "stands "),
    (_EACH_OF_THEM, "both"),
    (_THRU, "passes"),
    (_WE_THE_EGO, r"\1"),
    (_ON_THE_BRAKES, " stops "),
    (_NUMBERED, r" \1, \2"),
)
