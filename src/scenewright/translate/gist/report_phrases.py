"""Turns of phrase of reports and of verbose writers: nouns for what vehicles do, remarks about the text itself.

What enters: nothing. What leaves: `REPORT_PHRASES`, patterns with what to say instead, in their order: "commences an
acceleration that lets it pass" is "accelerates to pass". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, EGO, WHO, Rules

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
)
