"""Turns of phrase of reports and of verbose writers: nouns for what vehicles do, remarks about the text itself.

What enters: nothing. What leaves: `REPORT_PHRASES`, patterns with what to say instead, in their order: "commences an
acceleration that lets it pass" is "accelerates to pass". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, EGO, PRIORITY, WHO, Rules

_ONE = r"(?:the )?(?:ego|hero|AV|SUT|VUT|POV|NPC)(?: vehicle)?"
_PLACE = r"the (?:conflict point|stop line|intersection)"
# "the distance by which the ego trails the hero has shrunk to 12 m"
_BY_WHICH = re.compile(
    rf"\bthe (distance|gap|time) by which ({WHO}) (?:follows|trails|is behind|lags behind) ({WHO}) (?=has|is"
    rf"|falls|drops)",
    re.IGNORECASE,
)
_HAVING_BEGUN = re.compile(rf"\bHaving (?:begun|started|set out) (?={AMOUNT})")
_OF_SCENARIO = re.compile(
    r"\b(vehicles|cars|actors) (?:of|in) (?:this|the) (?:scenario|test|scene|case)(?= (?:are|come|drive|want|travel"
    r"|go))",
    re.I,
)
_CONTINUING = re.compile(
    r",? (?:and )?(?:continuing|continues)(?: to (?:do so|brake|decelerate)| braking| this| so)? "
    r"until (?=(?:it|he|she) (?:is|has|stands|comes))",
    re.IGNORECASE,
)
_AN_ACCELERATION = re.compile(
    r"\b(?:commences|begins|starts|initiates|undertakes|performs) an acceleration(?:,? (?:that|which) (?:lets|allows"
    r"|enables) it (?:to )?| in order to | so as to )",
    re.IGNORECASE,
)
_ALLOWS_IT = re.compile(
    r"(?<=accelerat)(e|es|ing), which (?:allows|lets|enables|permits) (?:it|him|her) (?:to )?", re.IGNORECASE
)
_FINDS = re.compile(rf"\b(?:at|from) the (?:instant|moment|point) (?:that|which) finds ({WHO}) ", re.IGNORECASE)
_NOT_STOP_BRAKING = re.compile(
    r"\b(?:does not|doesn['\u2019]t) (?:stop|cease|finish) (?:braking|decelerating|slowing down) (?:before|until) "
    r"(?=(?:it|he|she) (?:has|is|stands))",
    re.IGNORECASE,
)
_NO_OTHER = re.compile(
    r"\bhas no (?:other )?(?:intention|plan|aim|wish|desire) (?:other )?than to\b|\bhas no plan but to\b", re.IGNORECASE
)
_SCENARIO_STARTS = re.compile(
    rf",? and (?:the|our) (?:scenario|test|run|simulation|recording|film|clip|video|footage|story|clock) (?:starts"
    rf"|begins) (?:when|with) (?:it|him|her)(?: is)? "
    rf"(?={AMOUNT})",
    re.IGNORECASE,
)
_KEEP_SIMPLE = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n))(?:Nothing else,? )?(?:(?:please|just) )*keep it (?:simple|short)[.!]|"
    r"(?:(?<=[.!?]\s)|(?<=\n))(?:Please )?let (?:me|us) know (?:when|if|whether|once|how) [^.!?\d]{1,60}[.!?]",
    re.IGNORECASE,
)
_POLICY_SWITCHES = re.compile(
    rf"(?:(?<=[.!?]\s)|^)(?:The )?(?!{EGO}\b)[\w-]+(?:['\u2019]s)? (?:policy|behaviou?r|mode|controller) "
    r"(?:switches|changes) when\b"
)
_AFTER_SWITCH = re.compile(r"(?:(?<=[.!?]\s)|^)After the (?:switch|change|switching|transition),", re.IGNORECASE)
_LET_EGO = re.compile(rf"\bwe (?:let|make|have) the {EGO} (?=follow|drive|turn|come|approach|go|leave)", re.IGNORECASE)
_CLOSING_TO = re.compile(rf"\bclos(?:ing|es) (?:in )?to ({AMOUNT} behind)\b", re.IGNORECASE)
_SO_THAT_AFTER = re.compile(
    r", so that it (?:would|will) (?:afterwards|then|subsequently) (?:drive|travel|go|head) on the road\b",
    re.IGNORECASE,
)
_NOT_ON_BUT = re.compile(r"\b(is|are) not (?:on|in) the (?:road|driveway) but (?=(?:on|in) the)", re.IGNORECASE)
_PASSAGE_OF_SAME = re.compile(
    rf"\b(?:before|prior to|ahead of) the passage (?:of|through) (?:the same|that|this|the conflict) point by ({WHO})",
    re.IGNORECASE,
)
# "Upon the attainment by the ego of a distance of 35 ft from the stop line"
_ATTAINMENT = re.compile(
    rf"\b(?:upon|at|on) (?:the )?attainment by ({WHO}) of (?:a |the )?(?:distance|time to arrival|time) of "
    rf"({AMOUNT}) ",
    re.IGNORECASE,
)
_HAS_OBJECTIVE = re.compile(
    r"\b(?:has|have) (?:the |as its )?(?:objective|purpose|task) (?:of|to make|to perform|:) ?(?=a (?:left|right) "
    r"turn\b)",
    re.IGNORECASE,
)
_PASSED_BY = re.compile(
    rf"\bbefore ({WHO}) (?:begins|starts) (?:its turn|to turn),? the conflict point (?:has been|is|will have been) "
    rf"passed by ({WHO})(?: car| vehicle)?(?=[.,;])",
    re.IGNORECASE,
)
_APPROACHED_TO = re.compile(
    rf"\bhas approached (the (?:conflict point|stop line|intersection)) to ({AMOUNT})(?= and|,| while)", re.IGNORECASE
)
_BY_A_TURN = re.compile(
    r"(?:(?<=[.!?;]\s)|^)By (a (?:left|right) turn) (the [\w-]+|it) (?:is to|will|is about to|wants to|intends to) ",
    re.IGNORECASE,
)
_LEFT_FOR_IT = re.compile(
    rf"\b(?:only )?({AMOUNT}) (?:are|is|remain|remains) left for (it|him|her|{WHO}) (?:to|until) (the (?:stop line"
    r"|conflict point))",
    re.IGNORECASE,
)
_SQUEEZES = re.compile(
    r"\b(?:squeezes|scoots|whizzes|sails|rolls) (?:through|past|across) (?=the conflict point)", re.I
)
_ONE_UNDER_TEST = re.compile(r"\b(ours|mine|that car|this car|the latter), (?:which is )?the one under test,", re.I)
_WE_ASSESS = re.compile(
    r"\b(vehicle|car|van|taxi|shuttle|truck|bus|lorry|hatchback|robotaxi) (?:that |which )?(?:we|I)(?: are"
    r"|['\u2019]re)? "
    r"(?:evaluat|assess|examin|judg|validat)(?:ing|e)?\b",
    re.IGNORECASE,
)
_HIS_OWN = re.compile(r"\b(his|her) own (?=car|vehicle|van)", re.IGNORECASE)
_HIMSELF = re.compile(r"\b(he|she|it) (?:himself|herself|itself) (?=is\b)", re.IGNORECASE)


_ARM = r"(?:arm|leg|branch|approach|end|side)(?: of the (?:(?:main )?road|junction|intersection))?\b"
_FROM_ARM = re.compile(rf"\bfrom the (west|east|north|south)(?:ern)? {_ARM}", re.IGNORECASE)
_TO_ARM = re.compile(
    rf"\b(to|into|towards?) the (west|east)ern (?:{_ARM}|one\b)(?! (?:is|has|comes|brakes|stops))",
    re.IGNORECASE,
)
_WAY_OF = re.compile(
    r"^(\W*(?:the )?(?:ego|hero|other (?:car|vehicle)|AV|SUT|POV|NPC))['\u2019]s (?:way|route|path|journey"
    r"|itinerary) ?:",
    re.IGNORECASE | re.MULTILINE,
)


_SEPARATE = re.compile(
    rf"\b({AMOUNT}) separates? ({WHO}) from ((?:the|its) (?:stop line|conflict point|intersection)) and ({AMOUNT}) "
    rf"(?:separates? )?"
    rf"({WHO}) from ((?:the|its) (?:stop line|conflict point|intersection))",
    re.IGNORECASE,
)


# "the cab's time to reach the conflict point is 3.5 s"
_TIME_TO_REACH = re.compile(
    rf"\b(the [\w-]+|[A-Z]+)['\u2019]s time to (?:reach|arrive at|get to) (the (?:stop line|conflict point"
    rf"|intersection)) is ({AMOUNT})",
    re.IGNORECASE,
)
_THRU = re.compile(r"(?<=, )thru (?=(?:the )?(?:CP|conflict point)\b)", re.IGNORECASE)
_GIVES_UP_TURN = re.compile(
    r"\bgives up (?:its|his|her) (?:turn|right) for (?:the moment|now|a while)\b", re.IGNORECASE
)
_SO_IT_SEEMS = re.compile(r", or so (?:it|he|she|the \w+) (?:seems|thinks|believes|appears):?", re.IGNORECASE)
_SUPPOSED_TO = re.compile(r"\b(an?|the) car (?:that|which) is supposed to (?=turn|go|drive)", re.IGNORECASE)

# "The ego and, ahead of it in the same lane, the hero are westbound"
_AND_AHEAD = re.compile(
    r"\b(the [\w-]+(?: vehicle)?) and, (ahead of|in front of|behind) it(?: in (?:the same|its) lane)?, (the "
    r"[\w-]+(?: vehicle)?)"
    r" are\b",
    re.IGNORECASE,
)
_IS_ONCOMING = re.compile(
    r"(?<= )(is|are|am|being) the oncoming (?:car|vehicle|one|party|driver)(?=[,.;])",
    re.IGNORECASE,
)

# "i.e. to enter the same eastbound lane" after a turn
_IE_TO_ENTER = re.compile(
    r", (?:i\.e\.,?|that is,?|namely) to (?:enter|join|merge into) (?:the )?(?:same )?(\w+bound) (?:lane"
    r"|road)(?=[.,;])",
    re.IGNORECASE,
)
_TURNING_BY = re.compile(
    r"\b(?:by|via|through) (?:making |means of )?an? (left|right) turn (?=onto|into|out|from the (?:road|driveway))",
    re.IGNORECASE,
)
_THAT_OF_EACH = re.compile(
    rf"{BEGINS}Two (left|right) turns (?:cross|meet|conflict|merge|are involved|take place)(?: here)?: that of "
    rf"({_ONE}),? "
    rf"([^.;:\d]*?),? and that of ({_ONE}),? (?=[^.;:\d]+\.)",
    re.IGNORECASE,
)
_BRAKING_OF = re.compile(
    rf"{BEGINS}(?:The |A )?(?:braking|deceleration) of ({_ONE})(, at [^,;:]*?,)? (?:is|gets) (?:initiated|started"
    rf"|triggered|begun) "
    r"(?=when|once|as soon as|as the|at the moment)",
    re.IGNORECASE,
)
_SAID_ONE = re.compile(rf"{BEGINS}Said (?=hero|ego|vehicle|van|car|POV|NPC|SUT|AV)")
_SIMULATOR_PLACES = re.compile(
    rf"{BEGINS}The (?:simulator|simulation|scenario|test) (?:shall|must|should|is to) (?:place|put|position|spawn"
    rf"|start) ({_ONE}) ",
    re.IGNORECASE,
)
_AND_ROUTES = re.compile(r"(?<=[\w,]) and (?:shall )?route it (?=left|right|straight)", re.IGNORECASE)
_IT_ROUTES = re.compile(
    rf"({_ONE}) it (?:shall|must|should|is to) (?:route|send|drive|lead) (?=left|right|straight"
    rf"|west|east)",
    re.IGNORECASE,
)
_REMAINING_OF_EACH = re.compile(
    rf"\bwhen ({AMOUNT}|\w+_\w+) and ({AMOUNT}|\w+_\w+) are the (?:remaining )?(?:distances|times)(?: to arrival)? "
    rf"of ({_ONE}) (?:to|from|at) "
    rf"({_PLACE}) and of ({_ONE}) (?:to|from|at) ({_PLACE})(?:,? respectively)?",
    re.IGNORECASE,
)
_FOUND_FIRST = re.compile(r"\bis first found (?=[\w.]+ )", re.IGNORECASE)
_TURN_IN_QUESTION = re.compile(
    rf"({_ONE}) ((?:begins|starts) (?:to turn|its turn|turning))\. (?:The turn in question|That turn|This turn) is "
    rf"an? (?=left|right)",
    re.IGNORECASE,
)
_TWO_ARE = re.compile(
    rf"\b(?:the two|both)(?: vehicles| cars)? are ({AMOUNT} from {_PLACE}) \(({_ONE})\) and ({AMOUNT} from "
    rf"{_PLACE}) \(({_ONE})\)",
    re.IGNORECASE,
)
_EACH_OF_TWO = re.compile(r"\beach of (?:the|these) two(?: vehicles| cars)? is\b", re.IGNORECASE)
_DEPARTURE = re.compile(
    r"\b(?:A )?departure from (?:this|that|the) (?:stop|halt|standstill)(?:,? with acceleration,?| under "
    r"acceleration)? follows\b",
    re.IGNORECASE,
)
_COMPLETION = re.compile(
    rf"\bcompletion of ({_ONE})['\u2019]s turn (?:takes place|occurs|happens) (?=before)",
    re.IGNORECASE,
)
_STANDS_UNTIL = re.compile(
    rf"{BEGINS}(?:It|He|She) (?:stands|waits|remains|stays)(?: there| still)? until ((?:[^.;\d]|\.\d)*\d[^;]*?); "
    rf"(?:at|from) (?:that|this) "
    r"(?:instant|moment|time|point) (?:it|he|she) (?=(?:moves|sets|pulls|drives|starts|goes|accelerates))",
    re.IGNORECASE,
)
_NOT_TO_ENTER = re.compile(
    rf"({_ONE}) (?:is not|does not intend|does not want|is not going) to (?:enter|join|pull onto) the road yet:",
    re.IGNORECASE,
)
_TURN_IS_CROSSED = re.compile(
    rf"{BEGINS}({_ONE})['\u2019]s (left|right) turn ((?:from|into) [^.;:\d]*?) is (?:crossed|met|cut) by (?=an? )",
    re.IGNORECASE,
)
_ACCELERATE_HERO = re.compile(rf"{BEGINS}Accelerate ({_ONE}) (?=when|once|as soon as)", re.IGNORECASE)
_SWITCHES_TO = re.compile(r"\bswitches (?:over )?to (braking|accelerating|coasting)\b", re.IGNORECASE)
_SETS_NOT_OFF = re.compile(
    r"\b(it|he|she) (?:doesn['\u2019]t|does not|won['\u2019]t|will not) (?:set off|move off|start|move|go)(?: again"
    r"| on)? until "
    rf"((?:the|our) [\w-]+(?: (?:car|vehicle))?|it|we|{_ONE}) (has|have) ",
    re.IGNORECASE,
)
_WHAT_I_TEACH = re.compile(
    r"\bdoes what (?:I|we) (?:teach|preach|like|expect|want|asked for|recommend)(?: \w+)?: "
    r"(brake)s?\b",
    re.IGNORECASE,
)

_RIGHT_NOW = re.compile(r"\bright (?=now\b|away\b)", re.IGNORECASE)
_STAYS_IN_LANE = re.compile(r"\bstaying in ((?:its|his|her|the) (?:\w+bound )?lane)\b", re.IGNORECASE)
_ITS_PATH = re.compile(rf"{BEGINS}({_ONE})['\u2019]s (?:path|route|course|way|itinerary): ", re.IGNORECASE)
_TESTING_A = re.compile(
    r"\b(?:you|we|they)(?:['\u2019]re| are) testing (?:a|the) (car|vehicle|van) (?:that|which) "
    r"",
    re.IGNORECASE,
)

_SEPARATE_FROM = re.compile(
    rf"{BEGINS}({AMOUNT}) separates? ({_ONE}), which is ([^.;,\d]*), from (?={_PLACE})",
    re.IGNORECASE,
)
_IT_IS_INTENDED = re.compile(
    rf"{BEGINS}It is the (?:intention|plan|aim|goal|task) of ({_ONE})((?:, [^.;]*?,)?) to (?=turn|go|drive|continue"
    rf"|follow|head)",
    re.IGNORECASE,
)
_LEADS_TO_STOP = re.compile(
    r"(?:\b(it) (?:leads|results|ends|finishes|culminates)|, which (?:finishes|culminates)) (?:to|in|with|at) "
    r"(?=an? (?:complete |full )?(?:stop|standstill|halt)\b)",
    re.IGNORECASE,
)
_RENEWED = re.compile(
    rf"\bA (?:renewed|second|new|subsequent) acceleration (?:then )?(?:takes|carries|brings) ({_ONE}|it) (?:past"
    rf"|through|over|across) "
    r"(?=the conflict point)",
    re.IGNORECASE,
)
_FOLLOWS_TO = re.compile(
    r"\b((?:left|right)(?: turn)?) and (?:then )?follows? the road to the (east|west|north"
    r"|south)\b",
    re.IGNORECASE,
)
_WITHOUT_CARING = re.compile(
    rf",? without (?:caring|bothering|worrying) about the (?=(?:\w+bound )?{EGO}, (?:who|which)\b)", re.IGNORECASE
)
_RESPECTS = re.compile(rf"\brespects (?:our|its|the {EGO}['\u2019]s) {PRIORITY}(?=[:,.])", re.IGNORECASE)


# In this order: what one rule leaves, the next may read.
REPORT_PHRASES: Rules = (
    (_SEPARATE, r"\2 is \1 from \3 and \5 \4 from \6"),
    (_FROM_ARM, r"from the \1"),
    (_TO_ARM, r"\1 the \2"),
    (_WAY_OF, r"\1:"),
    (_THRU, "past "),
    (_GIVES_UP_TURN, "yields"),
    (_SO_IT_SEEMS, ","),
    (_SUPPOSED_TO, r"\1 car that wants to "),
    (_TIME_TO_REACH, r"\1 is \3 from \2"),
    (_BY_WHICH, r"the \1 from \2 to \3 "),
    (_HAVING_BEGUN, "Starting "),
    (_OF_SCENARIO, r"\1"),
    (_CONTINUING, " until "),
    (_AN_ACCELERATION, "accelerates to "),
    (_ALLOWS_IT, r"\1 to "),
    (_FINDS, r"when \1 is "),
    (_NOT_STOP_BRAKING, "brakes until "),
    (_NO_OTHER, "wants to"),
    (_SCENARIO_STARTS, ", initially "),
    (_KEEP_SIMPLE, ""),
    (_POLICY_SWITCHES, "When"),
    (_AFTER_SWITCH, "Then"),
    (_LET_EGO, "the ego is to "),
    (_CLOSING_TO, r"being \1"),
    (_SO_THAT_AFTER, " onto the road"),
    (_NOT_ON_BUT, r"\1 "),
    (_PASSAGE_OF_SAME, r"before \1 passes it"),
    (_ATTAINMENT, r"when \1 is \2 "),
    (_HAS_OBJECTIVE, "makes "),
    (_PASSED_BY, r"\2 passes the conflict point before \1 begins its turn"),
    (_APPROACHED_TO, r"is \2 from \1"),
    (_BY_A_TURN, r"\2 makes \1 to "),
    (_LEFT_FOR_IT, r"\2 is \1 from \3"),
    (_SQUEEZES, "passes "),
    (_WE_ASSESS, r"\1 we test"),
    (_HIS_OWN, r"\1 "),
    (_HIMSELF, r"\1 "),
    (_ONE_UNDER_TEST, "the ego"),
    (_AND_AHEAD, r"\3 is \2 \1; both are"),
    (_IS_ONCOMING, r"\1 oncoming"),
    (_IE_TO_ENTER, r", \1"),
    (_TURNING_BY, r"turning \1 "),
    (_THAT_OF_EACH, r"\2 turns \1 \3; \4 turns \1 "),
    (_BRAKING_OF, lambda found: f"{found[1]} brakes{(found[2] or '').strip(',')} "),
    (_SAID_ONE, "The "),
    (_SIMULATOR_PLACES, r"\1 is "),
    (_AND_ROUTES, " and goes "),
    (_IT_ROUTES, r"\1 goes "),
    (_REMAINING_OF_EACH, r"When \3 is \1 from \4 and \5 \2 from \6"),
    (_FOUND_FIRST, "is first "),
    (_TURN_IN_QUESTION, r"\1 \2. \1's turn is a "),
    (_TWO_ARE, r"\2 is \1 and \4 \3"),
    (_EACH_OF_TWO, "both are"),
    (_DEPARTURE, "It then accelerates"),
    (_COMPLETION, r"\1 completes its turn "),
    (_STANDS_UNTIL, r"When \1, the hero "),
    (_NOT_TO_ENTER, r"\1 yields:"),
    (_TURN_IS_CROSSED, r"\1 turns \2 \3. There is "),
    (_ACCELERATE_HERO, r"\1 accelerates "),
    (_SWITCHES_TO, r"starts \1"),
    (_SETS_NOT_OFF, r"\1 waits until \2 \3 "),
    (_WHAT_I_TEACH, r"\1s"),
    (_RIGHT_NOW, ""),
    (_STAYS_IN_LANE, r"driving in \1"),
    (_ITS_PATH, r"\1: "),
    (_TESTING_A, r"the test \1 "),
    (_SEPARATE_FROM, r"\2 is \3, \1 from "),
    (_IT_IS_INTENDED, r"\1\2 wants to "),
    (_LEADS_TO_STOP, lambda found: "it makes " if found[1] else " to "),
    (_RENEWED, r"\1 then accelerates and passes "),
    (_FOLLOWS_TO, r"\1, heading \2"),
    (_WITHOUT_CARING, " and won't yield. The "),
    (_RESPECTS, "yields"),
)
