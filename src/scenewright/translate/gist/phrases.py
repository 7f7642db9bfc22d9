"""Turns of phrase for what vehicles do, for who yields and for what begins when, with plain words for them.

What enters: nothing. What leaves: `PHRASES`, patterns with what to say instead, in their order: "applies a deceleration
of" is "brakes at", "after the standstill it" is "then it". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import Rules

# "East is the direction of the ego"
_DIRECTION_OF = re.compile(
    r"\b((?:North|East|South|West)(?:ward|bound)?) is the (?:direction|heading|course) of (the [\w-]+|[A-Z][\w-]*)",
    re.I,
)
_FOR_THAT_STOP = re.compile(
    r"(?:(?<=ing)|(?<=brake)|(?<=slow down)) for (?:that|this|the|its) (?:stop|halt"
    r"|standstill)(?= )",
    re.IGNORECASE,
)
_NOT_UNTIL_THEN = re.compile(
    r"\b(?:not until (?:then|that(?: moment)?)|only (?:later|after) than that|only later(?: on)?) (?=do(?:es)? "
    r"|will |shall )",
    re.IGNORECASE,
)
# "By the time we start turning they've already gone past it"
_BY_THE_TIME = re.compile(
    r"\b(by the time (?:we|it|he|she|the [\w-]+) [^,.;\d]{5,40}?) (they|it|he|she|the [\w-]+)('ve|'s| have| has) "
    r"already ",
    re.IGNORECASE,
)
_FIRST_BY = re.compile(
    r"\b(?:is|are|being) (?:passed|reached|crossed) first by (the [\w-]+|[A-Z]+),? and (?:only )?(?:then|afterwards"
    r"|after that|later|second)(?: on)? by (the [\w-]+|[A-Z]+)\b",
    re.IGNORECASE,
)
_BRINGS_TURN = re.compile(r"\bbring(s|ing)? (its|his|her|the) turn to (?:an end|completion|its end)\b", re.IGNORECASE)
_ANY_TURNING = re.compile(r"\bbefore (?:any|the) turning of (the [\w-]+|[A-Z]+) (begins|starts)\b", re.IGNORECASE)
# "until, just before the stop line, it is at rest"
_UNTIL_THERE = re.compile(r"\buntil, ([^,.;]{3,50}), ((?:it|he|she|the [\w-]+) [^,.;]+)(?=[.,;])", re.IGNORECASE)
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
_THAT_IS_WHERE = re.compile(r": (?:that|this|there) is where (?=the |our |we )", re.IGNORECASE)
_NOTHING_UNTIL = re.compile(r"(?:(?<=[.!?]\s)|(?<=\n)|^)Nothing (?:happens|changes) until\b", re.IGNORECASE)
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
_ON_THE_CLOCK = re.compile(
    r"\b(?:with|having|showing) ([\d.]+ ?(?:km/h|kph|mph|m/s)) on the (?:clock|dial|speedometer|speedo)\b",
    re.IGNORECASE,
)
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
_AFTER_STOP = re.compile(
    r"(?:(?<=[.!?;:]\s)|^)After (?:the|this|that|its|an?) (?:complete |full |short |brief )?(?:standstill|stop"
    r"|halt|rest|pause|wait),? "
    r"(?=it |he |she |the |[A-Z])",
)
_BRAKES_OF = re.compile(r"\bapply (?:the )?brakes of (?=the )", re.IGNORECASE)

_LETS_UP = re.compile(
    r"\b(?:doesn['\u2019]t|does not|won['\u2019]t) (?:let up|ease off|let off|stop braking|release the brakes?) "
    r"until\b",
    re.IGNORECASE,
)
_LET_IN = re.compile(
    r"\b(?:won['\u2019]t|will not|does not|doesn['\u2019]t|do not|don['\u2019]t|refuses to) let (us|the ego|the AV"
    r"|it|him|me)"
    r" (?:in|out|into the lane|go first|go|through)\b",
    re.IGNORECASE,
)
_END_UP_IN = re.compile(r"\b(?:end|finish) up in (?=the driveway)", re.IGNORECASE)
# "We get to 18 m behind it, and that's when it brakes"
_THAT_IS_WHEN = re.compile(
    r"(?:(?<=[.!?;]\s)|^)((?:The|Our|We|I|It|A)\b(?:[^.;!?]|\.\d)*?),? and (?:that|this|it)(?:['\u2019]s| is) "
    r"(?:exactly |precisely |just )?(?:when|the (?:moment|instant|point)(?: when| that| at which)?) ",
)
_GOES_ON_BRAKES = re.compile(r"\bgo(?P<s>es)? (?:(?:hard )?on|for) the brakes?\b", re.IGNORECASE)
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
_MAKES_STOP = re.compile(r"\bmakes? (?:a )?full stop\b", re.IGNORECASE)
_IE_EGO = re.compile(
    r"\b(ego|AV|SUT|VUT|(?:vehicle|car) (?:under test|we test|being tested)|test (?:vehicle|car)), "
    r"(?:i\.e\.|that is|in other words|which is),? (?:the |our )?"
    r"(?:ego|AV|SUT|VUT|(?:vehicle|car) (?:under test|we test|being tested)|test (?:vehicle|car)),",
    re.IGNORECASE,
)
_END_POSITION = re.compile(
    r"^(\W*(?:the )?(?:hero|npc|pov|target|other car|other vehicle|vehicle)) (?:end|final|stop|stopping|rest) "
    r"(?:position|place|point|location)[ \t]*:",
    re.IGNORECASE | re.MULTILINE,
)

_DESCENDS = re.compile(r"\bdescend(s|ing)? the driveway\b", re.IGNORECASE)
_FIRST_AND_AFTER = re.compile(r", (the [\w-]+|Hero|Ego) first and (the [\w-]+|Hero|Ego) after it\b", re.IGNORECASE)


_NOT_YIELDING_THUS = re.compile(
    r"(\bbefore (?:the \w+|it|we) [^,.;]*), (?:thereby |thus |thereby thus )not (?:yielding|giving way)"
    r"(?: to (?:the \w+|it|us))?(?=[.;])",
    re.IGNORECASE,
)
_IN_FRONT_OF_US = re.compile(
    r" and (?:turns|pulls out|drives|goes) (?:out )?(?:right )?in front of (?:us|it|the \w+)(?=: it "
    r"[^.]*\bbefore\b)",
    re.IGNORECASE,
)

_ORDER_AT = re.compile(r"\bOrder: (?:the )?([\w-]+) at the conflict point before\b")
_YIELDS_THEN_GOES = re.compile(
    r"(?<=: )(the [\w-]+) yields,? (?:and )?then goes[;:] it (?=brakes|slows|decelerates"
    r"|stops)",
    re.I,
)

_RIGHT_BEHIND = re.compile(
    r"\b(follow(?:s|ing|ed)?) (?:right|close|closely|directly|just|straight) behind\b", re.IGNORECASE
)

_PREPARES_TURN = re.compile(r"\bprepares (?:for )?(?:its|his|her|the) turn: (?:it|he|she) ", re.IGNORECASE)
_AS_ITS_GOAL = re.compile(
    r",? with (a (?:left|right) turn[^,.;]{0,50}?) as (?:its|his|her|the) (?:goal|aim|intention|plan|target),",
    re.IGNORECASE,
)
_DROPS_ANCHOR = re.compile(
    r"\b(?:drops|throws out|throws) (?:the |its |his |her )?anchors?\b|\bstands on the anchors\b", re.IGNORECASE
)
_FROM_BOUND = re.compile(r"\b(?:coming )?from the (east|west)bound direction\b", re.IGNORECASE)
_BOUND_DIRECTION = re.compile(r"\bin (?:the )?(east|west)bound direction\b", re.IGNORECASE)
# "another 4 s to reach the conflict point at its present speed"; "passes it at its present speed" is no remark
_AT_ITS_SPEED = re.compile(
    r"\b(reach the (?:conflict point|stop line|intersection)) at (?:its|his|her) (?:own|present|current|momentary)"
    r"(?: speed)?(?=[ ,.;])",
    re.IGNORECASE,
)
_PASSES_AT_ITS_SPEED = re.compile(
    r"\b(passes|crosses) (the conflict point) at (its|his|her) (?:own |present |current |same )speed\b", re.IGNORECASE
)
_I_WOULD_LET = re.compile(r"(?:(?<=[.!?;]\s)|^)(?:I|We)(?:['\u2019]d| would) (?:then )?let (?=the )", re.IGNORECASE)
_STAYS_STOPPED = re.compile(r"\bstays (stopped|standing)\b", re.IGNORECASE)

_ARRIVES_THERE = re.compile(r"\bthere arrives (?=the |an? )", re.IGNORECASE)

_WITHOUT_TURN = re.compile(
    r", (?:which|that) (?:it|he|she) (?:is going to|will|wants to|intends to|is to|crosses|passes)(?: (?:cross"
    r"|pass)(?: over)?)?"
    r"(?: straight)? without turning\b",
    re.IGNORECASE,
)
_PURSUES_TURN = re.compile(r"\b(?:pursues|carries out|undertakes) (?=a (?:left|right) turn\b)", re.IGNORECASE)
_THAT_LEADS = re.compile(
    r"\b(turn) (?:that|which) (?:leads|takes|brings|carries) (?:it|him|her) (?=(?:\w+bound "
    r")?(?:onto|into|on to))",
    re.I,
)
_ONE_IN_FRONT = re.compile(
    r"\bThe (?:vehicle|car|one) (?:immediately |directly |right |just )?(in front|ahead) of (it|the ego) is the "
    r"hero(?: vehicle| car)?\b",
)
_IS_SUSTAINED = re.compile(
    r",? (?:and (?:it|this|that) |which )is (?:sustained|maintained|kept up|held|continued) (?=until\b)", re.IGNORECASE
)
_REACHES_STOP = re.compile(
    r"\breaches (?=a (?:complete |full |total )?(?:standstill|stop|halt)\b(?! line))",
    re.IGNORECASE,
)
_ROUTE_LEADS = re.compile(
    r"\b(?:its|his|her|whose) (?:intended |planned |own )?(?:route|way|path|journey) (?:leads|takes it|goes|runs"
    r"|turns) (?=left|right)",
    re.IGNORECASE,
)
_TRAFFIC_OF_ONE = re.compile(
    r"\b(east|west)bound traffic(?: on the road)? consists of (?:a|one|just one|only one) (?:single )?(?:vehicle"
    r"|car),(?: namely)? the hero,?",
    re.IGNORECASE,
)
_ROAD_WITH = re.compile(
    r"(?:(?<=[.!?]\s)|^)On (?:a|the) road with an? (?:driveway|junction|exit|side road), (?=the "
    r"|an? |our )"
)
_FINISHES_STANDING = re.compile(
    r"\b(?:finishes|ends up|ends) at a (?:complete )?(?:standstill|stop)(?: line)?,? "
    r"(?=[\d.]+ |\w+_(?:m|ft|yd)\b|[a-z]+ (?:m|ft))",
    re.I,
)
_DONE_WITH_TURN = re.compile(r"\bis (?:done|finished|through) with (its|his|her|the) turn\b", re.IGNORECASE)
_TO_BE_DONE = re.compile(r"\bto be (?:done|finished|through) with (its|his|her|the) turn\b", re.IGNORECASE)
_GOES_BY = re.compile(r"\bgoes (?:by|past|beyond) (?=the conflict point\b)", re.IGNORECASE)


def _wont_yield(found: re.Match[str]) -> str:
    """Return "doesn't let us in" as "won't yield to us", "won't let us in" as "won't yield"."""
    said = f"won't yield to {found.group(1)}"
    return said if len(said) <= len(found.group()) else "won't yield"


def _when(found: re.Match[str]) -> str:
    """Return "We get to 18 m behind it, and that's when it" as "When we get to 18 m behind it, it"."""
    said = found.group(1)
    return f"When {said[0].lower() if said.split()[0] != 'I' else said[0]}{said[1:]}, "


def _completes_turn(found: re.Match[str]) -> str:
    """Return "clears its own turn" as "completes its turn"."""
    return f"complete{found.group(1) or ''} its turn"


def _leaves(found: re.Match[str]) -> str:
    """Return "descending the driveway" as "leaving the driveway"."""
    ending = (found.group(1) or "").lower()
    return {"ing": "leaving", "s": "leaves"}.get(ending, "leave") + " the driveway"


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
PHRASES: Rules = (
    (_DIRECTION_OF, r"\2 drives \1"),
    (_NOT_UNTIL_THEN, "only then "),
    (_BY_THE_TIME, r"\1, \2\3 "),
    (_FIRST_BY, r"is passed by \1 before \2"),
    (_BRINGS_TURN, _completes),
    (_ANY_TURNING, r"before \1 \2 to turn"),
    (_UNTIL_THERE, r"until \2 \1"),
    (_COMPLETE_STOP, r"comes to a \2"),
    (_ONCE_STANDING, "Then "),
    (_UPON, "on "),
    (_ROLLIN, r"\1ing"),
    (_NOT_BEFORE_THEN, "and only then"),
    (_MANAGES, _manages),
    (_NO_TURN_IN_MIND, "not turning"),
    (_YOU_START, "Place "),
    (_ENDS_STANDING, "ends in a stop"),
    (_THAT_IS_WHERE, " is where "),
    (_NOTHING_UNTIL, "When"),
    (_APPLIES, _at_rate),
    (_SHOWS, _acts),
    (_ENTERS_PHASE, _at_rate),
    (_END_STATE, _comes_to_rest),
    (_COMPLETION, "it completes its turn before "),
    (_PRIOR_PASSAGE, r"before \1 passes the "),
    (_NOT_BEFORE_IS, r"Once \1, \2 accelerates"),
    (_RIGHT_ON, "keeps "),
    (_FOR_THAT_STOP, ""),
    (_ON_THE_CLOCK, r"at \1"),
    (_BY_WHICH, ", and "),
    (_CONCEDED, _yields),
    (_IN_MIND, r"making \1"),
    (_ORDER_IS, r"\1 passes the conflict point before \2 does"),
    (_AFTER_STOP, "Then "),
    (_BRAKES_OF, "brake "),
    (_RIGHT_BEHIND, r"\1 behind"),
    (_ORDER_AT, r"\1 passes the conflict point before"),
    (_YIELDS_THEN_GOES, r"\1 "),
    (_NOT_YIELDING_THUS, r"\1"),
    (_IN_FRONT_OF_US, ""),
    (_DESCENDS, _leaves),
    (_FIRST_AND_AFTER, r", \1 ahead of \2"),
    (_END_POSITION, r"\1 stops"),
    (_PRIORITY_OF, "won't yield to "),
    (_WAIVES, _waives),
    (_FORCES_WAY, "won't yield to "),
    (_FORM_OF, _alone_there),
    (_STAYS_ON_IT, ", going straight"),
    (_NIPS, "goes past "),
    (_WOULD_LIKE, "wanted to "),
    (_IT_IS_WHO, r"\1 "),
    (_MAKES_STOP, "stop"),
    (_IE_EGO, r"\1"),
    (_FIRST_PAST, r"passes \1 first"),
    (_THERE_IT_STANDS, r"\2 stops \1"),
    (_CLEARS_TURN, _completes_turn),
    (_THAT_IS_WHEN, _when),
    (_GOES_ON_BRAKES, _brakes),
    (_LETS_UP, "brakes until"),
    (_LET_IN, _wont_yield),
    (_END_UP_IN, "go into "),
    (_PREPARES_TURN, ""),
    (_AS_ITS_GOAL, r" making \1,"),
    (_DROPS_ANCHOR, "brakes"),
    (_FROM_BOUND, r"travelling \1bound"),
    (_BOUND_DIRECTION, r"\1bound"),
    (_AT_ITS_SPEED, r"\1"),
    (_PASSES_AT_ITS_SPEED, r"keeps \3 speed and \1 \2"),
    (_I_WOULD_LET, "Let "),
    (_STAYS_STOPPED, "stands"),
    (_ARRIVES_THERE, "there comes "),
    (_WITHOUT_TURN, ", going straight"),
    (_PURSUES_TURN, "makes "),
    (_THAT_LEADS, r"\1 "),
    (_ONE_IN_FRONT, r"The hero is \1 of \2"),
    (_IS_SUSTAINED, " "),
    (_REACHES_STOP, "makes "),
    (_ROUTE_LEADS, "it turns "),
    (_TRAFFIC_OF_ONE, r"the hero is \1bound on the road,"),
    (_ROAD_WITH, "On the road, "),
    (_FINISHES_STANDING, "stops "),
    (_DONE_WITH_TURN, r"completes \1 turn"),
    (_TO_BE_DONE, r"to complete \1 turn"),
    (_GOES_BY, "passes "),
)
