"""Turns of phrase for what vehicles do, for who yields and for what begins when, with plain words for them.

What enters: nothing. What leaves: `PHRASES`, patterns with what to say instead, in their order: "applies a deceleration
of" is "brakes at", "after the standstill it" is "then it". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re
from collections.abc import Callable

# "East is the direction of the ego"
_DIRECTION_OF = re.compile(
    r"\b((?:North|East|South|West)(?:ward|bound)?) is the (?:direction|heading|course) of (the [\w-]+|[A-Z][\w-]*)",
    re.I,
)
_NO_NOTICE = re.compile(
    r"\b(?:takes? no (?:notice|account|heed) of|pays? no (?:attention|heed|regard) to|shows? no regard for) "
    r"(?=the |it\b|us\b|me\b|[A-Z])",
    re.IGNORECASE,
)
_FOR_THAT_STOP = re.compile(
    r"(?:(?<=ing)|(?<=brake)|(?<=slow down)) for (?:that|this|the|its) (?:stop|halt"
    r"|standstill)(?= )",
    re.IGNORECASE,
)
_DENIES = re.compile(
    r"\b(?:denies|refuses|denied|refused) (the [\w-]+(?: vehicle| car)?|us|it|[A-Z]{2,}) (?:the |its )?"
    r"(?:right of way|right-of-way|priority|precedence)\b",
    re.IGNORECASE,
)
_THEN_BEING = re.compile(r"\bat (?:that|this) (?:moment|time|instant|point) being (?=[\d.]+ )", re.IGNORECASE)
_KEEP_RIGHT = re.compile(
    r",? so (?:that )?(we|the ego|the (?:vehicle|car) under test|the AV|the SUT) (?:keeps?|has|have|get to keep"
    r"|retains?) "
    r"(?:the |its |our )?(?:right of way|priority|precedence)(?=[.,;]|$)",
    re.IGNORECASE,
)
_NOT_UNTIL_THEN = re.compile(r"\bnot until (?:then|that(?: moment)?) (?=do(?:es)? |will |shall )", re.IGNORECASE)
_FIRST_BY = re.compile(
    r"\b(?:is|are|being) (?:passed|reached|crossed) first by (the [\w-]+|[A-Z]+),? and (?:only )?(?:then|afterwards"
    r"|after that|later|second)(?: on)? by (the [\w-]+|[A-Z]+)\b",
    re.IGNORECASE,
)
_BRINGS_TURN = re.compile(r"\bbring(s|ing)? (its|his|her|the) turn to (?:an end|completion|its end)\b", re.IGNORECASE)
_ANY_TURNING = re.compile(r"\bbefore (?:any|the) turning of (the [\w-]+|[A-Z]+) (begins|starts)\b", re.IGNORECASE)
# "until, just before the stop line, it is at rest"
_UNTIL_THERE = re.compile(r"\buntil, ([^,.;]{3,50}), ((?:it|he|she|the [\w-]+) [^,.;]+)(?=[.,;])", re.IGNORECASE)
_TAKES_RIGHT = re.compile(
    r"\btaking (?:the |its )?(?:right of way|priority|precedence) (?:away )?from (?=the |it\b|us\b|[A-Z])",
    re.IGNORECASE,
)
_COMPLETE_STOP = re.compile(
    r"\b(?:arriv|com|get)(?:es|ing|s|e|ed)? at (?:the|a|its) (complete |full )?(stop|halt|standstill)\b(?! line)", re.I
)
_ONCE_STANDING = re.compile(
    r"(?:(?<=[.!?;]\s)|(?<=, )|^)Once (?:stationary|stopped|at rest|at a standstill|halted|standing(?: still)?), ?"
    r"(?=it |he |she |the )",
    re.IGNORECASE,
)
_UPON = re.compile(
    r"\b[Uu]pon (?=(?:the|a|this|that|its?) ?(?:same |main |selfsame )?(?:road|driveway|lane|street)\b|it\b)"
)
_MEANS_NOT = re.compile(
    r", (?:which means|meaning|i\.e\.|that is to say) that (?:it|he|she) does not (yield|give way)\b", re.I
)
_NOT_BEFORE_THEN = re.compile(r"\band not before (?:then|that)(?: does (it|he|she))?(?= [a-z]+)", re.IGNORECASE)
_MANAGES = re.compile(
    r"\b(It|He|She|The hero) (?:manages|does|achieves|accomplishes) (?:this|that|so|it) by (accelerating|braking)\b",
    re.I,
)
_NO_TURN_IN_MIND = re.compile(r"\bwith no turn in mind\b", re.IGNORECASE)
_ROLLIN = re.compile(r"\b([A-Za-z]{2,})in['\u2019](?=[\s,.;])")
_YOU_START = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)(?:You|We|I) (?:start|place|put|spawn|position) (?=(?:the|our) (?!test|run"
    r"|scenario|scene|clock|drive)[\w-]+\b)",
    re.IGNORECASE,
)
_ENDS_STANDING = re.compile(
    r"\bends with (?:it|the [\w-]+) (?:stationary|stopped|at rest|standing(?: still)?|at a standstill)\b", re.IGNORECASE
)
_TRIGGER_FOR = re.compile(
    r"(?:(?<=[.!?;]\s)|(?<=\n)|^)(?:The )?(?:trigger|cue|signal|condition) for (?:its|his|this|(?:the|that)(?:"
    r" [\w-]+['\u2019]s)?)"
    r" (?:braking|stop|acceleration|action|manoeuvre|maneuver|reaction|deceleration)(?: of the [\w-]+)?(?=:)",
    re.IGNORECASE,
)
_ARRIVAL_OFF = re.compile(
    r"\barrival at (the [a-z ]+?) (is )?((?:[\d.]+|[a-z-]+) (?:s|seconds?)) (?:off|away|ahead)\b", re.IGNORECASE
)
_THAT_IS_WHERE = re.compile(r": (?:that|this|there) is where (?=the |our |we )", re.IGNORECASE)
_NOTHING_UNTIL = re.compile(r"(?:(?<=[.!?]\s)|(?<=\n)|^)Nothing (?:happens|changes) until\b", re.IGNORECASE)
_TRAILS_BY = re.compile(
    r"\b(?:trails|follows) (it|the [\w-]+) by ((?:[\d.]+|[a-z-]+) (?:m|metres?|meters?|ft|feet|yards?|yd|s"
    r"|seconds?))\b",
    re.I,
)
_APPLIES = re.compile(
    r"\bappl(?:ies|y) an? (?:constant |steady |uniform )?(deceleration|acceleration) of (?=[\d.]|\w+_mpss)",
    re.IGNORECASE,
)
_SHOWS = re.compile(
    r"\b((?:he|she|it|the [\w-]+)) shows (?:no |some |great |little )?(?:courtesy|patience|consideration|respect"
    r"|restraint)"
    r"(?: and |: (?=(?:he|she|it|the )\b))",
    re.IGNORECASE,
)
_SWITCHING = re.compile(
    r"\b(?:switching|the switch|the change) (?:takes place|occurs|happens) (?=when |with |at |once |as soon as )",
    re.IGNORECASE,
)
_SWITCHED = re.compile(r"\bat the (?:switching|triggering|critical) (?:instant|moment|time)\b", re.IGNORECASE)
_ENTERS_PHASE = re.compile(r"\benters (?:its|the|an?) (braking|deceleration|acceleration) phase\b", re.IGNORECASE)
_END_STATE = re.compile(
    r", the (?:terminal|final|end) state of which is (?:zero speed|(?:a )?standstill)\b|\bsettles (?:at|to|in) (?:a )?"
    r"(?:standstill|rest|zero speed)\b",
    re.IGNORECASE,
)
_COMPLETION = re.compile(
    r"\bthe completion of (?:its|his|her) turn (?:occurs|happens|takes place|comes) (?:strictly )?before (?=the "
    r"|our |we )",
    re.IGNORECASE,
)
# "completes its turn prior to the passage of the subject vehicle through the conflict point"
_PRIOR_PASSAGE = re.compile(
    r"\b(?:prior to|before) the passage of (the [\w-]+(?: vehicle| car)?|[A-Z]+) (?:through|across|over|past) the "
    r"(?=conflict point\b)",
    re.IGNORECASE,
)
_NOT_BEFORE_IS = re.compile(
    r"(?:(?<=[.!?;]\s)|^)Not (?:before|until) ([^.;]*?(?:passed|completed)[^.;]*?) (?:is|does) (the [\w-]+|it) "
    r"(?:accelerated|accelerate)\b",
)
_RIGHT_ON = re.compile(r"\bkeeps right on (?=going|driving|rolling|coming)", re.IGNORECASE)
# "the ego is 4 s and the van 2 s away, the former from the conflict point and the latter from its stop line"
_FORMER_FROM = re.compile(
    r"(?: away| off| out)?,? the (?:former|first)(?: one)? from ((?:the|its|his) (?:conflict point|stop line)),?"
    r" and the "
    r"(?:latter|second)(?: one)? from ((?:the|its|his) (?:conflict point|stop line))",
    re.IGNORECASE,
)
_ON_THE_CLOCK = re.compile(
    r"\b(?:with|having|showing) ([\d.]+ ?(?:km/h|kph|mph|m/s)) on the (?:clock|dial|speedometer|speedo)\b",
    re.IGNORECASE,
)
# "On the VUT being 22 m from it"
_ON_BEING = re.compile(r"\b[Oo]n (the [\w-]+|[A-Z]+) being (?=[\d.]+ |\w+_(?:m|s)\b)")
_BY_WHICH = re.compile(r", by which (?=(?:the [\w-]+|[A-Z]+) is brought\b)")
# "precedence being conceded to the VUT", "right of way not being given"
_CONCEDED = re.compile(
    r", (?:and )?(?:thus |thereby )?(?:(?:the )?(?:precedence|priority|(?:right of )?way))(?: thereby| thus)?"
    r"(?P<denied> not)?(?: thereby| thus)? (?:thereby |thus )?being (?:conceded|given|granted|yielded|ceded|accorded)"
    r"(?P<whom> to (?:the [\w-]+|[A-Z]+|it|us))?(?= by\b|[,.;]|$)",
    re.IGNORECASE,
)
_IN_MIND = re.compile(r"\bwith (a (?:left|right) turn\b[^,.;]*?) in mind\b", re.IGNORECASE)
# "The order at the conflict point is NPC first, AV second"
_ORDER_IS = re.compile(
    r"\bThe order at the conflict point (?:is|shall be|must be)(?::| that)? ((?:the )?[\w-]+) first(?:,| and)(?: and)?"
    r"(?: then)? ((?:the )?[\w-]+)(?: second| next| last| after it)?(?=[.,;]|$)",
    re.IGNORECASE,
)
_OF_TRAVEL = re.compile(
    r"\b(seconds?|s) of (?:travel|driving|travelling)(?: time)?(?= (?:separate|lie|remain|are|is)\b)", re.I
)
_AFTER_STOP = re.compile(
    r"(?:(?<=[.!?;:]\s)|^)After (?:the|this|that|its|an?) (?:complete |full |short |brief )?(?:standstill|stop"
    r"|halt|rest|pause|wait),? "
    r"(?=it |he |she |the |[A-Z])",
)
_BRAKES_OF = re.compile(r"\bapply (?:the )?brakes of (?=the )", re.IGNORECASE)

_PROVIDED_THEN = re.compile(
    r",? (?:provided|on condition|as long as) (?:that )?((?:the [\w ]+?|[A-Z]+|it|he|we|they) (?:is|are) (?:then )?"
    r"(?:[\d.]+ ?\w+|\w+_(?:m|ft|s)) (?:away )?(?:from|before|short of) [\w ]+?),? "
    r"at (?:that|this|the same) (?:moment|time|instant|point)",
    re.IGNORECASE,
)
_LETS_UP = re.compile(
    r"\b(?:doesn['\u2019]t|does not|won['\u2019]t) (?:let up|ease off|let off|stop braking|release the brakes?) "
    r"until\b",
    re.IGNORECASE,
)
_TTA_FROM = re.compile(r"(?<=\d s) (?:TTA|TTC|time to arrival) (?=(?:from|to) (?:the|its) )")
_TRAILS_NAMED = re.compile(r"\b(?:trails|follows) (it|the [\w-]+) by (\w+_(?:m|ft|s))\b", re.IGNORECASE)
_LET_IN = re.compile(
    r"\b(?:won['\u2019]t|will not|does not|doesn['\u2019]t|do not|don['\u2019]t|refuses to) let (us|the ego|the AV"
    r"|it|him|me)"
    r" (?:in|out|into the lane|go first|go|through)\b",
    re.IGNORECASE,
)
_END_UP_IN = re.compile(r"\bend up in (?=the driveway)", re.IGNORECASE)
# "We get to 18 m behind it, and that's when it brakes"
_THAT_IS_WHEN = re.compile(
    r"(?:(?<=[.!?;]\s)|^)((?:The|Our|We|I|It|A)\b(?:[^.;!?]|\.\d)*?),? and (?:that|this|it)(?:['\u2019]s| is) "
    r"(?:exactly |precisely |just )?(?:when|the (?:moment|instant|point)(?: when| that| at which)?) ",
)
_GOES_ON_BRAKES = re.compile(r"\bgo(?P<s>es)? (?:hard )?on the brakes?\b", re.IGNORECASE)
_IN_RESPONSE = re.compile(
    r"\b[Ii]n (?:response|reaction) to ((?:the |an? )?[\w-]+(?: [\w-]+){0,3}?) (?:being|getting|coming|reaching) "
    r"(?=(?:at a (?:distance|time to arrival) of )?[\d.]+ |\w+_(?:m|s|ft)\b|at a )"
)
_PRIORITY_OF = re.compile(
    r"\b(?:disregard|ignore|violate|neglect|take|infringe)s? (?:the )?(?:priority|right of way|right-of-way"
    r"|precedence) (?:of|from)"
    r" (?=the |our |us\b|[A-Z])",
    re.IGNORECASE,
)
_WAIVES = re.compile(
    r"\b(?:waives|forgoes|renounces|gives up|cedes) (?:its|his|her|the) (?:priority|right of way|right-of-way"
    r"|precedence) "
    r"(?:by (brak|stopp|decelerat)ing|and (?=brakes|stops|decelerates|slows))",
    re.IGNORECASE,
)
_FORCES_WAY = re.compile(r"\bforces its way (?:in front of|past|ahead of) (?=the |us\b|our )", re.IGNORECASE)
_FORM_OF = re.compile(
    r"\b(?:[Tt]here is )?(?:(west|east)bound )?traffic(?: on the road)?(?: comes)? in the form of (?:a single|one|a) ",
)
_STAYS_ON_IT = re.compile(
    r",? and (?:stays|stayed|remains|remained|keeps|kept) (?:on|to) (?:it|that road|the road)(?=[.,;])"
)
_NIPS = re.compile(r"\b(?:nips|slips|darts|zips|whips) past (?=the conflict point|it\b)", re.IGNORECASE)
_WOULD_LIKE = re.compile(r"\bwould have liked to (?=turn|go|drive)", re.IGNORECASE)
_IT_IS_WHO = re.compile(
    r"\b(?:this time )?it is ((?:our|the) [\w-]+(?: vehicle| car)?) (?:that|which|who) (?=\w+s\b)", re.IGNORECASE
)
_WHAT_SETS_OFF = re.compile(
    r"(?:(?<=[.!?]\s)|^)What (?:gets it going|sets (?:it|this|him) off|triggers (?:it|this|the [\w-]+)|starts (?:it "
    r"all|it|this|things)) is "
    r"((?:the|our) [\w-]+(?: vehicle| car)?) being (?=[\d.]+ |\w+_(?:m|s|ft)\b)",
)
_MAKES_STOP = re.compile(r"\bmakes? (?:a )?full stop\b", re.IGNORECASE)
_IE_EGO = re.compile(
    r"\b(ego|AV|SUT|VUT|(?:vehicle|car) (?:under test|we test|being tested)|test (?:vehicle|car)), "
    r"(?:i\.e\.|that is|in other words|which is),? (?:the |our )?"
    r"(?:ego|AV|SUT|VUT|(?:vehicle|car) (?:under test|we test|being tested)|test (?:vehicle|car)),",
    re.IGNORECASE,
)
_GIVEN_INLINE = re.compile(
    r"\bGiven (?:that )?((?:the |an? )[^.;]*?), when (?=(?:the|it|both|an?) )([^.;]*?), then (?=(?:the|it) )"
)
_THAT_OF = re.compile(r"; for (the [\w-]+) it is (?=[\d.]+ |\w+_(?:m|s|ft)\b)")
_END_POSITION = re.compile(
    r"^(\W*(?:the )?(?:hero|npc|pov|target|other car|other vehicle|vehicle)) (?:end|final|stop|stopping|rest) "
    r"(?:position|place|point|location)[ \t]*:",
    re.IGNORECASE | re.MULTILINE,
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
    r"((?:the|our) (?:[\w-]+ )?(?:vehicle under test|ego|hero|vehicle|car|van|truck|AV|SUT|VUT)(?: vehicle)?|Ego"
    r"|Hero)(?= )"
)
_DESCENDS = re.compile(r"\bdescend(s|ing)? the driveway\b", re.IGNORECASE)
_GAP_WITH_WHICH = re.compile(
    r"\b(time gap|gap|distance|headway) (?:with|at|by) which ((?:the )?[\w-]+(?: vehicle| car)?) (?:follows|is "
    r"behind|trails)"
    r" ((?:the )?[\w-]+(?: vehicle| car)?) (is|becoming|falls to|has become|has fallen to|has dropped to|drops to)\b",
    re.IGNORECASE,
)
_REMAINING_TO = re.compile(
    r"\bremaining (?:to|for) ((?:the )?[\w-]+) before (the (?:stop line|conflict point|intersection))", re.IGNORECASE
)
_FIRST_AND_AFTER = re.compile(r", (the [\w-]+|Hero|Ego) first and (the [\w-]+|Hero|Ego) after it\b", re.IGNORECASE)

_FOR_WHOM_IT_IS = re.compile(
    r"(?<!; )\b[Ff]or ((?:the |our )?[\w-]+(?: vehicle)?) it is (?:still |only )?"
    r"(?=(?:[\d.]+|[a-z]+(?: and a half)?) (?:m|s|ft|yd|met(?:er|re)s|seconds|feet|yards)\b|\w+_(?:m|s|ft)\b)"
)

_APPROACHES_FROM = re.compile(
    r"\bapproach(es|ing) (the (?:stop line|intersection|conflict point))((?: (?!from\b)\w+){0,4}?) from "
    r"([\d.]+ ?\w+|\w+_(?:m|s|ft)) away\b",
    re.IGNORECASE,
)
_NOT_YIELDING_THUS = re.compile(
    r"(\bbefore (?:the \w+|it|we) [^,.;]*), (?:thereby |thus |thereby thus )not (?:yielding|giving way)"
    r"(?: to (?:the \w+|it|us))?(?=[.;])",
    re.IGNORECASE,
)
_WHEN_WE_START = re.compile(r"\bwhen we (?:start|begin),? (?=(?:it|the \w+) is\b)", re.IGNORECASE)
_AFTER_A_START = re.compile(r"\bafter a start (?=[\d.]+ |\w+_(?:m|s|ft)\b)", re.IGNORECASE)
_IN_FRONT_OF_US = re.compile(
    r" and (?:turns|pulls out|drives|goes) (?:out )?(?:right )?in front of (?:us|it|the \w+)(?=: it "
    r"[^.]*\bbefore\b)",
    re.IGNORECASE,
)


def _when(found: re.Match[str]) -> str:
    """Return "We get to 18 m behind it, and that's when it" as "When we get to 18 m behind it, it"."""
    said = found.group(1)
    return f"When {said[0].lower() if said.split()[0] != 'I' else said[0]}{said[1:]}, "


def _completes_turn(found: re.Match[str]) -> str:
    """Return "clears its own turn" as "completes its turn"."""
    return f"complete{found.group(1) or ''} its turn"


def _unfronted(found: re.Match[str]) -> str:
    """Return "Being 8 s from it, the ego comes" as "The ego, 8 s from it, comes"."""
    who = found.group(2)
    return f"{who[0].upper()}{who[1:]}, {found.group(1)},"


def _unfronted_verb(found: re.Match[str]) -> str:
    """Return "Wanting to turn left, the ego is" as "The ego, wanting to turn left, is"."""
    who, said = found.group(2), found.group(1)
    said = f"{who[0].upper()}{who[1:]} {said[0].lower()}{said[1:]},"
    return said if len(said) <= len(found.group()) else found.group()


def _leaves(found: re.Match[str]) -> str:
    """Return "descending the driveway" as "leaving the driveway"."""
    ending = (found.group(1) or "").lower()
    return {"ing": "leaving", "s": "leaves"}.get(ending, "leave") + " the driveway"


def _is_away(found: re.Match[str]) -> str:
    """Return "approaches the stop line from 8 s away" as "is 8 s from the stop line"."""
    verb = "is" if found.group(1).lower() == "es" else "being"
    return f"{verb} {found.group(4)} from {found.group(2)}{found.group(3)}"


def _waives(found: re.Match[str]) -> str:
    """Return "waives its priority by braking" as "brakes"."""
    return {"brak": "brakes", "stopp": "stops", "decelerat": "decelerates"}.get(found.group(1) or "", "")


def _alone_there(found: re.Match[str]) -> str:
    """Return "there is westbound traffic in the form of a single hero" as "there is a westbound hero"."""
    there = "There is a " if found.group().lower().startswith("there is") else "A "
    return f"{there}{found.group(1)}bound " if found.group(1) else there


def _brakes(found: re.Match[str]) -> str:
    """Return "goes on the brakes" as "brakes"."""
    return "brakes" if found["s"] else "brake"


_FIRST_PAST = re.compile(
    r"\b(?:is to be|must be|shall be|has to be|should be|is) (?:the )?first(?: one| vehicle| car| of the two)? "
    r"(?:past|through|across|over|to pass|to cross) (the conflict point|it|that point)(?=[.,;]|$| and\b)",
    re.IGNORECASE,
)
# "Ten metres before the conflict point it should be standing"
_THERE_IT_STANDS = re.compile(
    r"(?:(?<=[.!?;:]\s)|(?<=, and )|^)((?:[A-Z]?[\w-]+ ){1,3}(?:before|short of|from|in front of) "
    r"(?:the|its) (?:conflict point|stop line|intersection)),? (it|he|she|the [\w-]+) (?:should|shall|must|is to"
    r"|will|has to) "
    r"(?:be (?:standing|stationary|stopped|at a standstill|at rest)|stand|have stopped|have come to a (?:stop|halt"
    r"|standstill|rest))\b",
    re.IGNORECASE,
)
_CLEARS_TURN = re.compile(r"\bclear(s)? (?:its|his|her) own turn\b", re.IGNORECASE)


def _completes(found: re.Match[str]) -> str:
    """Return "brings its turn to an end" as "completes its turn"."""
    ending = {"": "e", "s": "es"}.get((found.group(1) or "").lower(), "ing")
    return f"complet{ending} {found.group(2)} turn"


def _manages(found: re.Match[str]) -> str:
    """Return "It manages this by braking" as "It brakes"."""
    return f"{found.group(1)} {'accelerates' if found.group(2).lower().startswith('acc') else 'brakes'}"


def _at_rate(found: re.Match[str]) -> str:
    """Return "applies a deceleration of" as "brakes at", "enters its braking phase" as "brakes"."""
    said = "accelerates" if found.group(1).lower() == "acceleration" else "brakes"
    return f"{said} at " if found.group().endswith("of ") else said


def _acts(found: re.Match[str]) -> str:
    """Return "he shows courtesy and brakes" as "he brakes", "he shows courtesy: he brakes" too."""
    return f"{found.group(1)} " if found.group().endswith("and ") else ""


def _comes_to_rest(found: re.Match[str]) -> str:
    """Return ", the final state of which is standstill" as " and stops", "settles at standstill" as "stops"."""
    return " and stops" if found.group().startswith(",") else "stops"


def _yields(found: re.Match[str]) -> str:
    """Return "precedence being conceded to the ego" as "yielding to the ego"."""
    return f", {'not yielding' if found['denied'] else 'yielding'}{found['whom'] or ''}"


# In this order: what one rule leaves, the next may read.
PHRASES: tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...] = (
    (_DIRECTION_OF, r"\2 drives \1"),
    (_NO_NOTICE, "won't yield to "),
    (_THEN_BEING, "being "),
    (_KEEP_RIGHT, r", yielding to \1"),
    (_NOT_UNTIL_THEN, "only then "),
    (_FIRST_BY, r"is passed by \1 before \2"),
    (_BRINGS_TURN, _completes),
    (_ANY_TURNING, r"before \1 \2 to turn"),
    (_UNTIL_THERE, r"until \2 \1"),
    (_TAKES_RIGHT, "not yielding to "),
    (_COMPLETE_STOP, r"comes to a \2"),
    (_ONCE_STANDING, "Then "),
    (_UPON, "on "),
    (_ROLLIN, r"\1ing"),
    (_MEANS_NOT, ", not yielding"),
    (_NOT_BEFORE_THEN, "and only then"),
    (_MANAGES, _manages),
    (_NO_TURN_IN_MIND, "not turning"),
    (_YOU_START, "Place "),
    (_ENDS_STANDING, "ends in a stop"),
    (_TRIGGER_FOR, "Trigger"),
    (_ARRIVAL_OFF, r"time to \1 \2\3"),
    (_THAT_IS_WHERE, " is where "),
    (_NOTHING_UNTIL, "When"),
    (_TRAILS_BY, r"is \2 behind \1"),
    (_APPLIES, _at_rate),
    (_SHOWS, _acts),
    (_SWITCHING, "the trigger is "),
    (_SWITCHED, "at the trigger"),
    (_ENTERS_PHASE, _at_rate),
    (_END_STATE, _comes_to_rest),
    (_COMPLETION, "it completes its turn before "),
    (_PRIOR_PASSAGE, r"before \1 passes the "),
    (_NOT_BEFORE_IS, r"Once \1, \2 accelerates"),
    (_RIGHT_ON, "keeps "),
    (_FORMER_FROM, r" away from \1 and \2, respectively"),
    (_FOR_THAT_STOP, ""),
    (_DENIES, r"won't yield to \1"),
    (_ON_THE_CLOCK, r"at \1"),
    (_ON_BEING, r"When \1 is "),
    (_BY_WHICH, ", and "),
    (_CONCEDED, _yields),
    (_IN_MIND, r"making \1"),
    (_ORDER_IS, r"\1 passes the conflict point before \2 does"),
    (_OF_TRAVEL, r"\1"),
    (_AFTER_STOP, "Then "),
    (_BRAKES_OF, "brake "),
    (_APPROACHES_FROM, _is_away),
    (_NOT_YIELDING_THUS, r"\1"),
    (_WHEN_WE_START, "initially "),
    (_AFTER_A_START, "starting "),
    (_IN_FRONT_OF_US, ""),
    (_FOR_WHOM_IT_IS, r"\1 has "),
    (_FRONTED, _unfronted),
    (_FRONTED_VERB, _unfronted_verb),
    (_DESCENDS, _leaves),
    (_GAP_WITH_WHICH, r"\1 from \2 to \3 \4"),
    (_REMAINING_TO, r"remaining for \1 to \2"),
    (_FIRST_AND_AFTER, r", \1 ahead of \2"),
    (_THAT_OF, r";that of \1 is "),
    (_END_POSITION, r"\1 stops"),
    (_IN_RESPONSE, r"When \1 is "),
    (_PRIORITY_OF, "won't yield to "),
    (_WAIVES, _waives),
    (_FORCES_WAY, "won't yield to "),
    (_FORM_OF, _alone_there),
    (_STAYS_ON_IT, ", going straight"),
    (_NIPS, "goes past "),
    (_WOULD_LIKE, "wanted to "),
    (_IT_IS_WHO, r"\1 "),
    (_WHAT_SETS_OFF, r"When \1 is "),
    (_MAKES_STOP, "stop"),
    (_IE_EGO, r"\1"),
    (_GIVEN_INLINE, r"\1. When \2, "),
    (_FIRST_PAST, r"passes \1 first"),
    (_THERE_IT_STANDS, r"\2 stops \1"),
    (_CLEARS_TURN, _completes_turn),
    (_THAT_IS_WHEN, _when),
    (_GOES_ON_BRAKES, _brakes),
    (_PROVIDED_THEN, r" and \1"),
    (_LETS_UP, "brakes until"),
    (_TTA_FROM, ""),
    (_TRAILS_NAMED, r"is \2 behind \1"),
    (_LET_IN, r"won't yield to \1"),
    (_END_UP_IN, "drive into "),
)
