"""Turns of phrase of those who write formally: nouns for deeds, passives, who is told beside an amount.

What enters: nothing. What leaves: `FORMAL_PHRASES`, patterns with what to say instead, in their order: "the stop is
complete 7 m short of it" is "it stops 7 m short of it". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, PRIORITY, Rules

_ONE = r"(?:the )?(?:ego|hero|AV|SUT|VUT|POV|NPC)(?: vehicle)?"
_EGO = r"(?:the )?(?:ego|AV|SUT|VUT)(?: vehicle)?"
_HERO = r"(?:the (?:hero|POV|NPC)(?: vehicle)?|it|he|she)"
_PLACE = r"the (?:conflict point|stop line|intersection)"
# "The moment that counts is when", "The decisive instant is when"
_DECISIVE = re.compile(
    rf"{BEGINS}The (?:moment|instant|point in time) (?:that (?:counts|matters)|to look for|in question) is "
    rf"(?:when|the one at which|that at which) |{BEGINS}The (?:decisive|crucial|relevant|critical) (?:moment|instant) "
    rf"is when ",
    re.IGNORECASE,
)
_MAKES_IT = re.compile(rf"{BEGINS}What makes ({_HERO}) (yield|brake|stop|react) is that ", re.IGNORECASE)
# "16 m are left between the ego and the stop line"
_LEFT_BETWEEN = re.compile(rf"\b({AMOUNT}) (?:are|is) left (?=between)", re.IGNORECASE)
_TWO_MEET = re.compile(
    rf"{BEGINS}Two (left|right)[- ]turn(?:er|ing)s?(?: cars| vehicles| drivers)? meet\.", re.IGNORECASE
)
# "The gap to the hero decreases, and when it is 25 m"
_GAP_SHRINKS = re.compile(
    rf"{BEGINS}The (gap|distance|headway|time gap)(?: to the hero| between (?:them|the two))? (?:decreases|shrinks"
    rf"|closes"
    r"|falls|diminishes|gets smaller),? and (when|once|as soon as) it (?=is |has )",
    re.IGNORECASE,
)
# "and before the ego begins to turn the hero has passed the conflict point"
_BEFORE_FRONTED = re.compile(
    rf"\band (before {_EGO} [^,.;\d]*?),? (?:the hero|it|he|she) has (passed|crossed) (the conflict point|it)\b",
    re.IGNORECASE,
)
_PLACE_FRONTED = re.compile(rf"{BEGINS}From ({_PLACE}) ({_ONE}) is (?:still )?({AMOUNT}) away\b", re.IGNORECASE)
# "The ego does not begin to turn until after that.", "Ego begins its turn after the hero has done so."
_ONLY_AFTER = re.compile(
    rf"\. {_EGO} (?:(?:does not|doesn['\u2019]t|will not|cannot) (?:begin|start) (?:to turn|its turn) (?:until "
    rf")?(?:after"
    rf"|before) (?:that|this)|(?:begins|starts) (?:its turn|to turn) (?:only )?after (?:that|this|{_HERO} has done "
    rf"so))\.",
    re.IGNORECASE,
)
_KEEPS_LANE = re.compile(
    r"\b(?:is not going to|will not|does not(?: intend to| want to)?|is not to) leave (?:its|his|her|the) lane\b",
    re.IGNORECASE,
)
_FOR_WHICH_IT_CROSSES = re.compile(
    r",? (?:for|in|with) which (?:it|he|she) (?:must|has to|will|needs to|is to) cross (?:the (?:ego"
    r"|hero)['\u2019]s|our"
    r"|its) (?:lane|path|way)(?=[.,;])",
    re.IGNORECASE,
)
_HAS_TO_CROSS = re.compile(
    rf"(\b(?:that|which) is [^.;:]{{0,80}}?turn left into the driveway) has to cross the (?:lane|path|way) of ({_EGO}),"
    r" which",
    re.IGNORECASE,
)
_STOP_COMPLETE = re.compile(
    rf"\b(?:its|the|this|his) (?:full |complete )?stop (?:is complete|takes place|is reached) (?={AMOUNT}|just before)",
    re.IGNORECASE,
)
_SO_THAT_IT_MAY = re.compile(
    rf",? (?:so|in order) that ({_EGO}) (?:may|can|could|might) (turn (?:left|right) (?:from|out of) the driveway)",
    re.IGNORECASE,
)
_COURSE = re.compile(rf"\b({_ONE}['\u2019]s) course is (?=straight|a (?:left|right) turn)", re.IGNORECASE)
# "the distance to the conflict point is 25 m for the ego and 21 m for the hero"
_FOR_EACH = re.compile(
    rf"\b(?:the|its|their) (?:distances?|times?(?: to arrival)?)(?: that remains?)? (?:from|to) ({_PLACE}) "
    rf"(?:equals?|is"
    rf"|are|amounts? to|measures?) ({AMOUNT}) (?:in the case of|for) ({_ONE}) and (?:to )?({AMOUNT}) (?:in the case of"
    rf"|for) ({_ONE})",
    re.IGNORECASE,
)
_FOR_EACH_APART = re.compile(
    rf"\bthe (?:distance|time) that remains to ({_PLACE}) is ({AMOUNT}) for ({_ONE}) and the (?:distance|time) that "
    rf"remains to ({_PLACE}) is ({AMOUNT}) for ({_ONE})",
    re.IGNORECASE,
)
_OWN_AMOUNTS_TO = re.compile(
    rf"\b(the ego['\u2019]s (?:distance|time)) to ({_PLACE}) amounts to ({AMOUNT}) and its own (?:distance|time) to "
    rf"({_PLACE}) to ({AMOUNT})",
    re.IGNORECASE,
)
_IS_MAINTAINED = re.compile(r"\band is (?:maintained|kept up|held) for (?=[\d.]+ |\w+_s\b)", re.IGNORECASE)
_IN_MOTION_AGAIN = re.compile(r"\bis set in motion again\b", re.IGNORECASE)
_PATHS_INTERSECT = re.compile(
    rf"{BEGINS}The (?:paths|ways|routes) of (?:the )?two vehicles (?:intersect|cross|meet|merge|conflict):", re.I
)
_OPPOSITE_AIM = re.compile(r"\bhas the (?:opposite|same|contrary) (?:intention|aim|plan), namely to\b", re.IGNORECASE)
_FOR_IT_DOES = re.compile(r", for ((?:it|he|she|the hero) (?:accelerates|brakes|decelerates))\b", re.IGNORECASE)
_FROM_THE_INSTANT = re.compile(
    r"\b(accelerates|brakes|decelerates) from the (?:instant|moment) (?:at which|when|that)\b", re.IGNORECASE
)

# "Whilst the road is followed westbound by a hero, a right turn is intended by the ego"
_IS_FOLLOWED = re.compile(
    r"(?:(?<=[.!?;]\s)|^)(?:(?:Whilst|While) )?the (road|lane) is followed ((?:straight on )?(?:east|west)bound"
    r"|straight "
    r"on) by (an? hero|the hero|an? [\w-]+|the ego)(,|\.)",
    re.IGNORECASE,
)
_MOVES_NO_MORE = re.compile(
    r"\b(?:does not move|is not moving|moves not|['\u2019]s not moving) any ?more\b",
    re.IGNORECASE,
)
_TURNING_IS_TASK = re.compile(
    rf"{BEGINS}Turning (left|right) ([^.;:]{{0,60}}?) is the (?:task|goal|plan|aim|intention|job) of ({_ONE})\.", re.I
)

_EQUAL_TO = re.compile(rf"\bequal to (?={AMOUNT})", re.IGNORECASE)
_DESTINED = re.compile(r"\b(?:is|be|are) destined to (?=turn|go|drive|continue)", re.IGNORECASE)
# "Initial position of the ego: 60 m before the intersection; of the hero: 20 m before the stop line"
_AND_OF = re.compile(rf"; of (the [\w ]{{3,25}}?): (?={AMOUNT})", re.IGNORECASE)
_OTHER_SENSE = re.compile(r"\bin the opposite sense\b", re.IGNORECASE)
_JUDGES_GAP = re.compile(
    r"\bjudges the gap (?:to be |as )?too (?:short|small|tight)(?: and|[:,] (?:it|he|she)) (?=\w+s\b)", re.IGNORECASE
)

_WITHOUT_LEAVING = re.compile(r"\bwithout leaving (?:its|his|her|the) lane\b", re.IGNORECASE)
_WHAT_IT_DOES = re.compile(
    rf"{BEGINS}What ({_HERO}) does (?:then|next) is (?:to )?(accelerate|brake|decelerate)\b", re.IGNORECASE
)
# "When both vehicles are near the conflict point, namely the ego 12 m and the hero 20 m behind it"
_NAMELY = re.compile(
    rf"\b(when|once|as soon as) (?:both(?: vehicles| cars)?|they|the two) are (?:near|close to) ({_PLACE}), namely "
    rf"({_ONE}) "
    rf"({AMOUNT}) and ({_ONE}) ({AMOUNT}) (behind|before|from) (?:it|that point)",
    re.IGNORECASE,
)
_STARTING_PLACE = re.compile(r"\bhas the driveway(?: exit)? as its (?:starting place|origin|start)\b", re.IGNORECASE)
_TARGET_ROAD = re.compile(
    r",? and the (?:east|west)bound road as its (?:target|destination|goal), for which it (?:must|has to) "
    r"(turn (?:left|right))",
    re.IGNORECASE,
)
_STOPS_THERE = re.compile(
    rf"{BEGINS}At ({AMOUNT} (?:behind|before|short of|from) {_PLACE}) ({_HERO}) (?:makes|comes to|reaches) a "
    r"(?:complete |full )?(?:stop|halt|standstill)\b",
    re.IGNORECASE,
)
_HEADS_FOR_LINE = re.compile(
    rf"\bis (?:heading|making|driving) for the stop line of the driveway and is ({AMOUNT}) from it\b", re.IGNORECASE
)
# "Being 3 s from it when the ego is 4 s from it, the hero yields from that moment on"
_BEING_WHEN = re.compile(
    rf"{BEGINS}Being ({AMOUNT} from {_PLACE}) when ({_EGO} is {AMOUNT} from {_PLACE}), (the hero(?: vehicle)?) "
    rf"(yields|brakes"
    r"|decelerates|accelerates)(?: from (?:that moment|then|there) on)?\b",
    re.IGNORECASE,
)
_ACHIEVED = re.compile(r"\. (?:This|That) is (?:achieved|done|accomplished|completed) (?=before\b)", re.IGNORECASE)
_FIRST_PHASE = re.compile(rf"{BEGINS}In the first phase, which (?:starts|begins) (?=when\b)", re.IGNORECASE)
_NEXT_PHASE = re.compile(
    rf"{BEGINS}In the (?:second|next|last|final) phase,? (?=it |he |she |the hero )",
    re.IGNORECASE,
)
_UNTIL_IT_TURNS = re.compile(r"\buntil (?:it|he|she) (?=turns (?:left|right) (?:into|onto)\b)", re.IGNORECASE)
_CAUSES = re.compile(
    rf"{BEGINS}({_EGO}) reaching ([^.;]*?),? (?:causes|makes|leads) ({_HERO}) to (?:begin|start) (decelerating"
    r"|accelerating|braking)\b",
    re.IGNORECASE,
)
_BEFORE_GOING = re.compile(
    r"\b(stops (?:completely )?[^.;]*?) before (it|he|she) begins to accelerate again\b", re.IGNORECASE
)
_PLANNED_FROM_DRIVEWAY = re.compile(
    rf"{BEGINS}From the driveway, a ((?:left|right) turn[^.;:]{{0,60}}?) is (?:planned|intended|wanted) (?:for|by) "
    rf"({_ONE})\b",
    re.IGNORECASE,
)
_IF_IT_HOLDS = re.compile(r"\b(if|when|once) it (?:holds|is true|is the case) that ", re.IGNORECASE)
_TIME_TO_REACT = re.compile(rf"{BEGINS}The (?:time|moment) at which {_HERO} reacts is when ", re.IGNORECASE)
_PASSING_PRECEDES = re.compile(
    rf"\. Its (?:passing|passage) of {_PLACE} precedes the beginning of the (?:ego|AV|SUT)['\u2019]s turn\.",
    re.IGNORECASE,
)

# "it brakes; what sets this off is the ego getting within 8 m of it"
_SET_OFF_BY = re.compile(
    rf"[;,] (?:and )?what (?:sets (?:this|it|that) off|triggers (?:this|it|that)|causes (?:this|it|that)) is "
    rf"({_EGO}|{_HERO}) "
    r"(?:getting|coming) (?=within|to )",
    re.IGNORECASE,
)
_LIES_AHEAD_OF_EACH = re.compile(
    rf"\b({_PLACE}) (?:lies|is) ({AMOUNT}) (?:ahead|in front) of ({_ONE}) and ({AMOUNT}) (?:ahead|in front) of "
    rf"({_ONE})\b",
    re.IGNORECASE,
)
_ARRIVES_ON = re.compile(r"\barrives on the road (?=heading|going|travelling|traveling)", re.IGNORECASE)
_BEGINS_WITH = re.compile(
    rf"{BEGINS}The (?:test|run|scenario|simulation) (?:begins|starts) with ({_ONE}) ({AMOUNT}) (?=from|before|short "
    rf"of)",
    re.IGNORECASE,
)

# "the driver of the ego vehicle": whoever drives it goes where it goes
_DRIVER_OF = re.compile(
    rf"\bthe (?:human )?(?:driver|operator) (?:of|behind the wheel of|in|at the wheel of) ({_ONE})\b(?!['\u2019])",
    re.IGNORECASE,
)
_HAVING_STOOD = re.compile(
    r"\bafter having (?:stood|stopped|waited|halted|come to (?:a|rest) ?(?:stop|halt|standstill)?)(?: there| still)?,? "
    rf"(?={_HERO} )",
    re.IGNORECASE,
)
_AT_END_OF_TURN = re.compile(
    r"\bis (?:at the end of|through|done with|finished with) (?:its|his|her) turn(?= before\b)",
    re.IGNORECASE,
)
_OBLIGES_IT = re.compile(
    r",? which (?:would|should|does|ought to)? ?(?:obliges?|requires?|forces?|compels?) (?:it|him|her) to (?:wait|yield"
    r"|give way),? but (?:it|he|she) does not(?: do so)?(?=[.;])",
    re.IGNORECASE,
)
_REMAIN_FROM = re.compile(
    rf"\b({AMOUNT}) (?:remains?|(?:is|are) left) from ({_ONE}) to ({_PLACE}),? and ({AMOUNT}) from ({_ONE}) to "
    rf"(?={_PLACE})",
    re.IGNORECASE,
)
_AT_THE_TRIGGER = re.compile(rf"{BEGINS}At the (?:trigger|triggering) (?:instant|moment|time|point),? ", re.IGNORECASE)
_INTENDED_BY_BOTH = re.compile(
    rf"{BEGINS}(Left|Right) turns are (?:intended|planned|made|performed|wanted) by both(?: vehicles)?[,:] by ({_ONE}) "
    rf"((?:from|into) [^.;,\d]*?),? and by ({_ONE}) (?=from |into )",
    re.IGNORECASE,
)
_IS_THE_POSITION = re.compile(
    rf"{BEGINS}({AMOUNT} (?:before|from|short of|away from) {_PLACE}) is the (?:initial|starting|first) (?:position"
    rf"|place"
    rf"|location) of ({_ONE})\b",
    re.IGNORECASE,
)
_UNTIL_ARRIVAL = re.compile(
    rf"\bhas ({AMOUNT}) (?:left )?(?:until|to|before) (?:its )?arrival at (?={_PLACE})",
    re.IGNORECASE,
)
_WE_LET = re.compile(
    rf"(?<!could )(?<!can )(?<!shall )(?<!should )(?<!may )\b(?:we|you|one) (?:let|have|make|lets|has|makes) "
    rf"(?!both\b)({_ONE}) (?!at\b)(?=[a-z]+[ .,])",
    re.IGNORECASE,
)
_WE_HAVE_AT = re.compile(rf"\b(?:we|you) have ({_ONE}) (?:at )?(?={AMOUNT})", re.IGNORECASE)
# "Left into the driveway: this is the course of the hero", "A left turn is assigned to the hero"
_THIS_IS_ITS_COURSE = re.compile(
    rf"{BEGINS}([^.:;]+?): (?:this|that|such) is the (?:course|route|way|path|plan|task) of ({_ONE})\b", re.IGNORECASE
)
_IS_ASSIGNED = re.compile(
    rf"{BEGINS}(?:an? )?([^.:;,\d]+?) is (?:assigned|given|allotted|allocated|attributed) to ({_ONE})(?=[,.])",
    re.IGNORECASE,
)
_IS_REPRESENTED = re.compile(
    rf"{BEGINS}((?:East|West|North|South)bound [^.:;,\d]+?) is (?:represented|played|embodied|provided) by "
    rf"({_ONE})(?=[,.])",
    re.IGNORECASE,
)
_DISTANCE_IN_TIME = re.compile(
    r",? at an initial (?:distance|separation)(?: in time| in space)? of (?=[\w.]+)",
    re.IGNORECASE,
)
_BEFORE_FOR_EACH = re.compile(
    rf"{BEGINS}({AMOUNT}) before ({_PLACE}) for ({_ONE}),? and(?: at the same (?:time|moment|instant))?,? ({AMOUNT}) "
    rf"before (?:it|({_PLACE})) for ({_ONE}), ",
    re.IGNORECASE,
)
_STRAIGHT_MEETS = re.compile(r", meets (?:an?|the) (?=(?:\w+bound )?(?:ego|AV|SUT|VUT)\b)", re.IGNORECASE)
_DOES_SO_BEFORE = re.compile(
    rf"[;,:] (?:it|he|she) (?:will do|does|is going to do) (?:so|this|that) in front of (?=({_EGO}), "
    rf"(?:who|which)\b)",
    re.IGNORECASE,
)
_UPON_FULFILMENT = re.compile(
    r"\b(?:up)?on (?:the )?fulfil(?:l)?ment of (?:the|this|that)(?: trigger(?:ing)?)? conditions?,? ", re.IGNORECASE
)
_LEG = re.compile(r"\b(?:approach|junction|intersection) leg\b|(?<=driveway) leg\b", re.IGNORECASE)
_NO_PRIORITY = re.compile(
    rf"(?:(?<=[;.]) |, (?:and|but|so) )(?:it|he|she|(?:the )?hero) (?:does not have|has no|lacks|doesn['\u2019]t "
    rf"have) (?:the |any )?{PRIORITY}"
    r"(?=[.;])",
    re.IGNORECASE,
)
_VIOLATES = re.compile(
    rf"\b(?:then )?(?:violates|infringes|breaches|disregards|ignores) (?:the|our|{_EGO}['\u2019]s) {PRIORITY}[:,] "
    rf"(?=(?:it|he|she) )",
    re.IGNORECASE,
)
_TO_THE_POINT = re.compile(r"(?<=accelerates) (?:up )?to the conflict point(?=\.)", re.IGNORECASE)
_IS_STARTED = re.compile(r"\bwhen it is started(?=[.,;])", re.IGNORECASE)
_VALUE_OF = re.compile(r"\bthe value of (\w+_\w+) is (?=\d)", re.IGNORECASE)
_SO_THAT_IT_STANDS = re.compile(r"\bin this (?:manner|way|fashion),? (?=(?:it|he|she|the hero) yields)", re.IGNORECASE)


def _before(found: re.Match[str]) -> str:
    """Return "and before the ego turns the hero has passed it" as "and passes it before the ego turns"."""
    verb = "passes" if found.group(2).lower() == "passed" else "crosses"
    return f"and {verb} {found.group(3)} {found.group(1)}"


def _each_before(found: re.Match[str]) -> str:
    """Return "When the ego is 5 s from the one place and the hero 3 s from the other, "."""
    first, place, ego, second, other, hero = found.groups()
    return f"When {ego} is {first} from {place} and {hero} {second} from {other or place}, "


# In this order: what one rule leaves, the next may read.
FORMAL_PHRASES: Rules = (
    (_DECISIVE, "The trigger is that "),
    (_MAKES_IT, r"\1 \2s when "),
    (_LEFT_BETWEEN, r"\1 remain "),
    (_TWO_MEET, r"Both turn \1."),
    (_GAP_SHRINKS, r"\2 the \1 "),
    (_BEFORE_FRONTED, _before),
    (_PLACE_FRONTED, r"\2 is \3 from \1"),
    (_ONLY_AFTER, " before the ego begins to turn."),
    (_KEEPS_LANE, "stays in its lane"),
    (_FOR_WHICH_IT_CROSSES, ""),
    (_HAS_TO_CROSS, r"\1 meets \2, which"),
    (_STOP_COMPLETE, "it stops "),
    (_SO_THAT_IT_MAY, r". \1 will \2"),
    (_COURSE, r"\1 route is "),
    (_FOR_EACH, r"\3 is \2 and \5 \4 from \1"),
    (_FOR_EACH_APART, r"\3 is \2 from \1 and \6 \5 from \4"),
    (_OWN_AMOUNTS_TO, r"the ego is \3 from \2 and it is \5 from \4"),
    (_IS_MAINTAINED, "for "),
    (_IN_MOTION_AGAIN, "drives on"),
    (_PATHS_INTERSECT, ""),
    (_OPPOSITE_AIM, "wants to"),
    (_FOR_IT_DOES, r"; \1"),
    (_FROM_THE_INSTANT, r"\1 when"),
    (_IS_FOLLOWED, r"\3 follows the \1 \2."),
    (_MOVES_NO_MORE, "stops"),
    (_TURNING_IS_TASK, r"\3 is turning \1 \2."),
    (_EQUAL_TO, ""),
    (_DESTINED, "will "),
    (_AND_OF, r"; \1 : "),
    (_OTHER_SENSE, "the other way"),
    (_JUDGES_GAP, ""),
    (_WITHOUT_LEAVING, "in its lane"),
    (_WHAT_IT_DOES, r"\1 \2s"),
    (_NAMELY, r"\1 \3 is \4 and \5 is \6 \7 \2"),
    (_STARTING_PLACE, "comes from the driveway"),
    (_TARGET_ROAD, r" and will \1"),
    (_STOPS_THERE, r"\2 stops \1"),
    (_HEADS_FOR_LINE, r"is in the driveway, \1 from the stop line"),
    (_BEING_WHEN, r"When \2 and \3 is \1, it \4"),
    (_ACHIEVED, " "),
    (_FIRST_PHASE, ""),
    (_NEXT_PHASE, "Then "),
    (_UNTIL_IT_TURNS, "and "),
    (_CAUSES, r"When \1 reaches \2, \3 begins \4"),
    (_BEFORE_GOING, r"\1; then \2 accelerates"),
    (_PLANNED_FROM_DRIVEWAY, r"\2, in the driveway, wants a \1"),
    (_IF_IT_HOLDS, r"\1 "),
    (_TIME_TO_REACT, "The trigger is that "),
    (_PASSING_PRECEDES, ". It passes the conflict point before the ego begins to turn."),
    (_SET_OFF_BY, r" when \1 gets "),
    (_LIES_AHEAD_OF_EACH, r"\3 is \2 and \5 \4 from \1"),
    (_ARRIVES_ON, "is on the road "),
    (_BEGINS_WITH, r"Initially \1 is \2 "),
    (_DRIVER_OF, r"\1"),
    (_HAVING_STOOD, "Then "),
    (_AT_END_OF_TURN, "completes its turn"),
    (_OBLIGES_IT, " and won't yield"),
    (_REMAIN_FROM, r"\2 is \1 from \3 and \5 \4 from "),
    (_AT_THE_TRIGGER, "When "),
    (_INTENDED_BY_BOTH, r"\2 turns \1 \3; \4 turns \1 "),
    (_IS_THE_POSITION, r"Initially \2 is \1"),
    (_UNTIL_ARRIVAL, r"is \1 from "),
    (_WE_HAVE_AT, r"\1 is "),
    (_WE_LET, r"\1 is to "),
    (_THIS_IS_ITS_COURSE, r"\2 is \1"),
    (_IS_ASSIGNED, r"\2: \1"),
    (_IS_REPRESENTED, r"\2: \1"),
    (_DISTANCE_IN_TIME, ", initially "),
    (_BEFORE_FOR_EACH, _each_before),
    (_STRAIGHT_MEETS, ". The "),
    (_DOES_SO_BEFORE, ". "),
    (_UPON_FULFILMENT, "Then "),
    (_LEG, ""),
    (_NO_PRIORITY, ""),
    (_VIOLATES, ""),
    (_TO_THE_POINT, ""),
    (_IS_STARTED, "initially"),
    (_VALUE_OF, r"\1 = "),
    (_SO_THAT_IT_STANDS, ""),
)
