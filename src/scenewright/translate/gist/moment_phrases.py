"""Turns of phrase for amounts and moments: whose they are, and that they are the trigger.

What enters: nothing. What leaves: `MOMENT_PHRASES`, patterns with what to say instead, in their order: "in response to
the van being 9 m from it" is "when the van is 9 m from it". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, WHO, Rules

_THEN_BEING = re.compile(r"\bat (?:that|this) (?:moment|time|instant|point) being (?=[\d.]+ )", re.IGNORECASE)
_TRIGGER_FOR = re.compile(
    r"(?:(?<=[.!?;]\s)|(?<=\n)|^)(?:The )?(?:trigger|cue|signal|condition) for (?:its|his|this|(?:the|that)(?:"
    r" [\w-]+['\u2019]s)?)"
    r" (?:braking|stop|acceleration|action|manoeuvre|maneuver|reaction|deceleration)(?: of the [\w-]+)?(?=:)",
    re.IGNORECASE,
)
_ARRIVAL_OFF = re.compile(
    r"\barrival at (the [a-z ]+?) (is )?((?:[\d.]+|[a-z-]+) (?:s|seconds?)) (?:off|away|ahead)\b", re.IGNORECASE
)
_TRAILS_BY = re.compile(rf"\b(?:is )?(?:trails|trailing|follows) (it|the [\w-]+) by ({AMOUNT})", re.IGNORECASE)
_SWITCHING = re.compile(
    r"\b(?:switching|the switch|the change) (?:takes place|occurs|happens) (?=when |with |at |once |as soon as )",
    re.IGNORECASE,
)
_SWITCHED = re.compile(r"\bat the (?:switching|triggering|critical) (?:instant|moment|time)\b", re.IGNORECASE)
# "the ego is 4 s and the van 2 s away, the former from the conflict point and the latter from its stop line"
_FORMER_FROM = re.compile(
    r"(?: away| off| out)?,? the (?:former|first)(?: one)? from ((?:the|its|his) (?:conflict point|stop line)),?"
    r" and the "
    r"(?:latter|second)(?: one)? from ((?:the|its|his) (?:conflict point|stop line))",
    re.IGNORECASE,
)
# "On the VUT being 22 m from it"
_ON_BEING = re.compile(r"\b[Oo]n (the [\w-]+|[A-Z]+) being (?=[\d.]+ |\w+_(?:m|s)\b)")
_OF_TRAVEL = re.compile(
    r"\b(seconds?|s) of (?:travel|driving|travelling)(?: time)?(?= (?:separate|lie|remain|are|is)\b)", re.I
)
# "Given the ego on the road, and given a hero in the driveway: when ..., then ..."
_GIVEN_AND_GIVEN = re.compile(
    r"(?:(?<=[.!?]\s)|^)Given (?:that )?((?:[^.;:]|\.\d)*?),? and given (?:that )?((?:[^.;:]|\.\d)*?)(?::|,) when "
    r"(?=the |both |it )"
)
_TEMPORAL = re.compile(r"\b(?:temporal|time) distance(?= of (?:[\d.]+ ?s\b|[a-z-]+ seconds|\w+_s\b))", re.IGNORECASE)
_APPROACHES_FROM = re.compile(
    r"\bapproach(es|ing) (the (?:stop line|intersection|conflict point))((?: (?!from\b)\w+){0,4}?) from "
    r"([\d.]+ ?\w+|\w+_(?:m|s|ft)) away\b",
    re.IGNORECASE,
)
_WHEN_WE_START = re.compile(r"\bwhen we (?:start|begin),? (?=(?:it|the \w+) is\b)", re.IGNORECASE)
_AFTER_A_START = re.compile(r"\bafter a start (?=[\d.]+ |\w+_(?:m|s|ft)\b)", re.IGNORECASE)
_FOR_WHOM_IT_IS = re.compile(
    r"(?<!; )\b[Ff]or ((?:the |our )?[\w-]+(?: vehicle)?) it is (?:still |only )?"
    r"(?=(?:[\d.]+|[a-z]+(?: and a half)?) (?:m|s|ft|yd|met(?:er|re)s|seconds|feet|yards)\b|\w+_(?:m|s|ft)\b)"
)
# "Being 8 s from the intersection, the ego comes ..."
_FRONTED = re.compile(
    r"(?:(?<=[.!?]\s)|^)Being ((?:[^.;]|\.\d)*?(?:\d|_(?:m|s|ft)\b|(?:seconds?|metres?|meters?|feet|yards?)\b)"
    r"(?:[^,.;]|\.\d)*), ((?:the|our) (?:[\w-]+ )?(?:vehicle under test|ego|hero|vehicle|car|van|truck|AV|SUT|VUT)"
    r"(?: vehicle)?|Ego|Hero)(?= )"
)
_FRONTED_VERB = re.compile(
    r"(?:(?<=[.!?]\s)|^)((?:Wanting|Intending|Wishing|Planning|Meaning|Leading|Following|Tailing|Trailing"
    r"|Preceding) [^,.;]*), "
    r"((?:the|our|an?|another) (?:[\w-]+ )?(?:vehicle under test|ego|hero|vehicle|car|van|truck|AV|SUT|VUT)(?: "
    r"vehicle)?|Ego"
    r"|Hero)(?= )"
)
_GAP_WITH_WHICH = re.compile(
    r"\b(time gap|gap|distance|headway) (?:with|at|by) which ((?:the )?[\w-]+(?: vehicle| car)?) (?:follows|is "
    r"behind|trails)"
    r" ((?:the )?[\w-]+(?: vehicle| car)?) (is|becoming|falls to|has become|has fallen to|has dropped to|drops to)\b",
    re.IGNORECASE,
)
_REMAINING_TO = re.compile(
    r"\bremaining (?:to|for) ((?:the )?[\w-]+) before (the (?:stop line|conflict point|intersection))", re.IGNORECASE
)
_THAT_OF = re.compile(r"; for (the [\w-]+) it is (?=[\d.]+ |\w+_(?:m|s|ft)\b)")
_IN_RESPONSE = re.compile(
    r"\b[Ii]n (?:response|reaction) to ((?:the |an? )?[\w-]+(?: [\w-]+){0,3}?) (?:being|getting|coming|reaching) "
    r"(?=(?:at a (?:distance|time to arrival) of )?[\d.]+ |\w+_(?:m|s|ft)\b|at a )"
)
_WHAT_SETS_OFF = re.compile(
    r"(?:(?<=[.!?]\s)|^)What (?:gets it going|sets (?:it|this|him) off|triggers (?:it|this|the [\w-]+)|starts (?:it "
    r"all|it|this|things)) is "
    r"((?:the|our) [\w-]+(?: vehicle| car)?) being (?=[\d.]+ |\w+_(?:m|s|ft)\b)",
)
_GIVEN_INLINE = re.compile(
    r"\bGiven (?:that )?((?:the |an? )[^.;]*?), when (?=(?:the|it|both|an?) )([^.;]*?), then (?=(?:the|it) )"
)
_PROVIDED_THEN = re.compile(
    r",? (?:provided|on condition|as long as) (?:that )?((?:the [\w ]+?|[A-Z]+|it|he|we|they) (?:is|are) (?:then )?"
    r"(?:[\d.]+ ?\w+|\w+_(?:m|ft|s)) (?:away )?(?:from|before|short of) [\w ]+?),? "
    r"at (?:that|this|the same) (?:moment|time|instant|point)",
    re.IGNORECASE,
)
_TTA_FROM = re.compile(r"(?<=\d s) (?:TTA|TTC|time to arrival) (?=(?:from|to) (?:the|its) )")

# "When X_m is the distance the ego still has to the conflict point"
_IS_THE_TIME = re.compile(
    rf"\b({AMOUNT}) is the (?:time|distance) (?:that |which )?({WHO}|(?:the )?\w+) (?:still )?(?:needs|has|requires)"
    r"(?: left| to go)? (?:to|until|to reach) (?=(?:the|its) )",
    re.IGNORECASE,
)
# "When the conflict point is 9 m ahead of ego and 12 m ahead of hero"
_AHEAD_OF_BOTH = re.compile(
    rf"\b(the (?:conflict point|stop line)) is ({AMOUNT}) (?:ahead of|in front of|away from) ((?:the )?[\w-]+) and "
    rf"({AMOUNT}) (?:ahead of|in front of|away from) ((?:the )?[\w-]+)",
    re.IGNORECASE,
)
# "where there remain 35 m to the ego until the conflict point, and 6 m to the hero until the stop line"
_REMAIN_TO = re.compile(
    rf"\bthere (?:remains?|(?:is|are) left) ({AMOUNT}) (?:to|for) ({WHO}) (?:until|to|before) (the [a-z]+ (?:point"
    rf"|line)|the "
    rf"intersection),? and ({AMOUNT}) (?:to|for) ({WHO}) (?:until|to|before) (?=the [a-z]+ (?:point|line)|the "
    rf"intersection)",
    re.IGNORECASE,
)
_WHEN_WE_LOOK = re.compile(
    r"\bwhen (?:we|you) (?:start|begin) (?:to look|looking|watching|to watch|observing|to observe)(?: at it)?,? "
    r"(?=it |the )",
    re.IGNORECASE,
)
_FIRST_FRAME = re.compile(
    r"\b[Ii]n the (?:very )?(?:first|opening|initial) (?:frame|shot|picture|image|instant|moment)(?: of (?:the|our) "
    r"\w+)?,? "
    r"(?=(?:we|it|the|our) )"
)
_TIME_ONWARDS = re.compile(r"\bfrom the (time|moment|instant) (?:onwards?|on) (?=when |at which |that )", re.IGNORECASE)
_STARTS_BRAKING = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n))(?:Start|Begin|Beginning|Onset) of (?:the )?braking: ?(?=ego"
    r"|hero|the )"
)
_ENDS_BRAKING = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n))End of (?:the )?braking: ?(?:the )?hero (?:is )?(?:at rest|stationary|at a standstill"
    r"|standing) "
)
_IS_OVER = re.compile(
    r",? and (?:it )?(?:is over|ends|is finished|is completed|is complete|finishes) (?:when|once|with) ((?:the|its) "
    r"[\w-]+|it) "
    r"(?:is )?(?:stationary|at a standstill|at rest|standing|stopped)\b",
    re.IGNORECASE,
)
_NOW_AWAY = re.compile(rf"(?<=, )now (?={AMOUNT} (?:from|before|short of))")

_TIME_FOR_AND = re.compile(
    r"\b([Aa]t|[Ww]ith) ((?:[\d.]+|[a-z]+(?: and a half)?)) (s|m|ft|yd|seconds|metres|meters|feet|yards) from (the "
    r"(?:conflict "
    r"point|stop line)) for ((?:the )?[\w-]+) and ((?:[\d.]+|[a-z]+(?: and a half)?)) for ((?:the )?[\w-]+)(?=,)"
)

_HINGES = re.compile(
    r"\b(?:It|Everything|All) (?:all )?(?:hinges|depends|turns) on (?:one|this|a single) (?:moment|instant"
    r"|point)(?: in time)?:"
)

# "a mere 110 cm", "has reduced itself to 1.8 s"
_A_MERE = re.compile(r"\ba (?:mere|measly|paltry|scant|meagre|whole|full) (?=[\d.]+ ?[a-z]|\w+_(?:m|s|ft)\b)", re.I)
_REDUCED_TO = re.compile(
    r"\b(?:has|have|is|are) (?:reduced|decreased|shortened|shrunk|diminished)(?: itself)? to (?=[\d.]+ |\w+_(?:m|s"
    r"|ft)\b)",
    re.IGNORECASE,
)
_GETS_GOING = re.compile(
    r"\bwhen (?:things|everything|it all|the action) (?:get|kick)s? (?:going|off|started|under ?way)\b", re.IGNORECASE
)
# "We close up till we're 20 m behind it, and that's when it brakes"
_UNTIL_AND_THEN = re.compile(
    r"(?:(?<=[.!?]\s)|^)(?:We|It|The ego|Our car)\b(?:(?! and )[^.;,\d])*? (?:until|till) ((?:we|it|the ego|our car)\b"
    r"(?:[^.;]|\.\d)*?)[,;] ((?:[^.;]|\.\d)*?,? )?and (?:that|this)(?:['\u2019]s| is) (?:exactly |just |precisely "
    r")?when ",
)
_AS_LONG_AS_NEEDED = re.compile(
    r"\b(?:for )?as long as (the ego|it|we|the AV|the SUT) (?:needs?|takes?|requires?) to complete (its|our|the) "
    r"turn\b",
    re.IGNORECASE,
)
_WHEN_DONE = re.compile(
    r"(?<=turn)(,? and|\.) (?:when|once|after) (?:we['\u2019]re|we are|it is|it['\u2019]s|that['\u2019]s|that is"
    r"|this is"
    r"|the ego is) (?:done|finished|through|completed|over), ",
    re.IGNORECASE,
)
_MAINTAINED = re.compile(r", which (?:it|he|she) (?:maintains|keeps(?: up)?|holds|sustains) (?=until\b)", re.IGNORECASE)
# "At 4 s (ego to conflict point) and 2 s (hero to stop line):"
_IN_BRACKETS = re.compile(
    rf"({AMOUNT}) \((ego|hero|SUT|POV|AV|NPC) (?:to|from) (?:the )?(conflict point|stop line)\)", re.IGNORECASE
)
_POSITION = re.compile(r"\binit(?:ial)? pos(?:ition)?:? (?=[\d.]+ |\w+_(?:m|s|ft)\b)", re.IGNORECASE)
_THEN_WITH = re.compile(r"(?:(?<=[.!?]\s)|^)(?:And )?[Tt]hen,? with (?=(?:our|the|us|it|him) )")


def _unfronted(found: re.Match[str]) -> str:
    """Return "Being 8 s from it, the ego comes" as "The ego, 8 s from it, comes"."""
    who = found.group(2)
    return f"{who[0].upper()}{who[1:]}, {found.group(1)},"


def _unfronted_verb(found: re.Match[str]) -> str:
    """Return "Wanting to turn left, the ego is" as "The ego, wanting to turn left, is"."""
    who, said = found.group(2), found.group(1)
    said = f"{who[0].upper()}{who[1:]} {said[0].lower()}{said[1:]},"
    return said if len(said) <= len(found.group()) else found.group()


def _is_away(found: re.Match[str]) -> str:
    """Return "approaches the stop line from 8 s away" as "is 8 s from the stop line"."""
    verb = "is" if found.group(1).lower() == "es" else "being"
    return f"{verb} {found.group(4)} from {found.group(2)}{found.group(3)}"


def _until_then(found: re.Match[str]) -> str:
    """Return "We close up until we're 20 m behind it, and that's when" as "When we're 20 m behind it,"."""
    more = f" and {found.group(2).rstrip(', ')}" if found.group(2) else ""
    return f"When {found.group(1)}{more}, "


# In this order: what one rule leaves, the next may read.
MOMENT_PHRASES: Rules = (
    (_THEN_BEING, "being "),
    (_TRIGGER_FOR, "Trigger"),
    (_ARRIVAL_OFF, r"time to \1 \2\3"),
    (_TRAILS_BY, r"is \2 behind \1"),
    (_SWITCHING, "the trigger is "),
    (_SWITCHED, "at the trigger"),
    (_FORMER_FROM, r" away from \1 and \2, respectively"),
    (_ON_BEING, r"When \1 is "),
    (_OF_TRAVEL, r"\1"),
    (_GIVEN_AND_GIVEN, r"\1. \2. When "),
    (_TEMPORAL, "distance"),
    (_APPROACHES_FROM, _is_away),
    (_WHEN_WE_START, "initially "),
    (_AFTER_A_START, "starting "),
    (_FOR_WHOM_IT_IS, r"\1 has "),
    (_FRONTED, _unfronted),
    (_FRONTED_VERB, _unfronted_verb),
    (_GAP_WITH_WHICH, r"\1 from \2 to \3 \4"),
    (_REMAINING_TO, r"remaining for \1 to \2"),
    (_THAT_OF, r";that of \1 is "),
    (_IN_RESPONSE, r"When \1 is "),
    (_WHAT_SETS_OFF, r"When \1 is "),
    (_GIVEN_INLINE, r"\1. When \2, "),
    (_PROVIDED_THEN, r" and \1"),
    (_TTA_FROM, ""),
    (_IS_THE_TIME, r"\2 is \1 from "),
    (_AHEAD_OF_BOTH, r"\3 is \2 and \5 \4 from \1"),
    (_REMAIN_TO, r"\2 is \1 from \3 and \5 \4 from "),
    (_WHEN_WE_LOOK, "initially "),
    (_FIRST_FRAME, "At first "),
    (_TIME_ONWARDS, r"from the \1 "),
    (_STARTS_BRAKING, "Hero brakes when "),
    (_ENDS_BRAKING, "Hero stops "),
    (_IS_OVER, r" until \1 is at rest"),
    (_NOW_AWAY, "at first "),
    (_TIME_FOR_AND, r"When \5 is \2 \3 and \7 \6 \3 from \4"),
    (_HINGES, "Trigger:"),
    (_A_MERE, ""),
    (_REDUCED_TO, "falls to "),
    (_GETS_GOING, "at the start"),
    (_UNTIL_AND_THEN, _until_then),
    (_AS_LONG_AS_NEEDED, r"until \1 completes \2 turn"),
    (_WHEN_DONE, r"\1 then "),
    (_MAINTAINED, " "),
    (_IN_BRACKETS, r"\2 \1 from \3"),
    (_POSITION, "initially "),
    (_THEN_WITH, "With "),
)
