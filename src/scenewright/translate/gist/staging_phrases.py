"""Turns of phrase of somebody who stages a scene: "Give the ego a left turn", "Make the hero an assertive car".

What enters: nothing. What leaves: `STAGING_PHRASES`, patterns with what to say instead, in their order: who is to do
what is told as what he does, and what sets it off as a moment.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, Rules

_HERO = (
    r"(?:the hero(?: vehicle)?|the other (?:vehicle|car)|it|he|that (?:car|vehicle)"
    r"|the (?!ego|stop|conflict)[\w-]+(?: car)?)"
)
_EGO = r"(?:the ego(?: vehicle)?|our (?:test )?car|the AV|the SUT)"
_PLACE = r"(?:the|its) (?:stop line|conflict point|intersection)"

_LIKE_A_RUN = re.compile(
    rf"{BEGINS}(?:I['\u2019]d|We['\u2019]d|I would|We would) like (?:to see |to have )?an? (?:run|test|case"
    rf"|scenario) in which ",
    re.IGNORECASE,
)
_GIVE_TURN = re.compile(rf"{BEGINS}Give ({_EGO}|the hero) a (left|right) turn\b", re.IGNORECASE)
_GIVE_AMOUNT = re.compile(
    rf"{BEGINS}Give ({_EGO}|the hero) ({AMOUNT}) to ({_PLACE})(?: to start with| at first| initially| at the "
    rf"start)?",
    re.IGNORECASE,
)
_PLAYS_HERO = re.compile(
    r"\b(?:put|place|have) (an? (?:[\w-]+ ){0,3}(?:car|vehicle|van|truck))((?: on| in) the \w+)? to (?:play|be) the "
    r"hero\b",
    re.IGNORECASE,
)
_MAKE_HERO = re.compile(rf"{BEGINS}Make the (hero|ego) (an? )", re.IGNORECASE)
_TRY_TURN = re.compile(rf"\blet ({_EGO}) (?:try|make|attempt) (?=a (?:left|right) turn)", re.IGNORECASE)
_IT_IS_WHEN = re.compile(rf"{BEGINS}It is (?:only )?when ((?:[^.;]|\.\d)*?) that (?={_HERO} |the hero)", re.IGNORECASE)
_NOBODY_YIELDS = re.compile(
    rf"{BEGINS}Nobody (?:gives way|yields|stops|waits)[:.] (?=at |when |the |it |once )",
    re.IGNORECASE,
)
_IN_BRACKETS_BOTH = re.compile(
    rf"{BEGINS}An? (?:car|vehicle) (turning [^().]*?) \((hero|ego)\) and (?:a|another) (?:car|vehicle) (turning "
    rf"[^().]*?) \((hero|ego)\) "
    r"have (?:crossing|conflicting|intersecting) (?:paths|ways)(?: here)?\.",
    re.IGNORECASE,
)
_SHOULD_BE = re.compile(
    rf"{BEGINS}Should ({_EGO}|the hero|it) be (?=[\d.]+ |\w+_(?:m|s|ft)\b|[a-z]+ (?:m|s))",
    re.IGNORECASE,
)
_SETS_OFF = re.compile(
    rf"{BEGINS}What (?:sets off|triggers|starts|causes|initiates) ({_HERO})['\u2019]s (braking|deceleration"
    rf"|acceleration|stop) is "
    r"(?:the combination of )?two (?:distances|times|conditions|amounts): ",
    re.IGNORECASE,
)
_AFTER_ITS_WAIT = re.compile(
    r"\bafter (?:its|the|this|that) ([a-z]+|[\d.]+)[ -](second|s) (?:wait|stop|pause|standstill|halt)\b", re.IGNORECASE
)
_TO_DO_SO = re.compile(
    rf"{BEGINS}(?:To (?:do so|this end|that end)|For this(?: purpose)?|To achieve this), (?=it "
    rf"|the )",
    re.IGNORECASE,
)
_LEAVES_RIGHT = re.compile(
    rf"\b(?:leaves|cedes|hands|grants) the right of way to (?={_EGO})|\bleaves the right of way(?=[.;,])", re.IGNORECASE
)
_REQUIREMENT = re.compile(rf"[;,] (?:and )?the requirement is that ({_HERO}) (pass|complete|cross)\b", re.IGNORECASE)
# "when it is 16 m, and the ego 24 m, from the conflict point": commas around the second
_COMMAS_AROUND = re.compile(
    rf"(?<=is )({AMOUNT}), and ({_EGO}|{_HERO}) ({AMOUNT}), (?=(?:away )?(?:from|before|short of) )", re.IGNORECASE
)
_NEEDS_ANOTHER = re.compile(
    rf"\bneeds another ({AMOUNT}),? and ({_EGO}|{_HERO}) another ({AMOUNT}),? (?:to|until|for) (?={_PLACE})",
    re.IGNORECASE,
)
_REGARD_WHICH = re.compile(
    rf"{BEGINS}(?:Without (?:any )?regard for|With no regard for|In spite of|Ignoring|Regardless of) ({_EGO}), "
    rf"which (is|drives|goes)"
    r"((?:[^.;]|\.\d)*?), (an? [\w-]+|the hero) (?=pulls|comes|leaves|emerges|turns|drives)",
    re.IGNORECASE,
)
_THAT_LANE = re.compile(r"\b(along|onto|into) (?:that|this|the same|the said) lane\b", re.IGNORECASE)
_FIRST_SEEN = re.compile(
    r"\bis first (?:seen|observed|spotted|placed|noticed|encountered|detected|picked up)(?= |,)", re.IGNORECASE
)
_LET_BRAKING = re.compile(
    rf"{BEGINS}(?:let|have) (?:the )?braking begin with ((?:[^.;]|\.\d)*?) and end in (an? (?:full |complete "
    rf")?(?:stop|standstill|halt))",
    re.IGNORECASE,
)
_ONLY_TO_GO = re.compile(
    rf",? only to (?:drive off|go|move off|set off|pull away)(?: again)? before ({_EGO}) can (?:make use of it|go"
    rf"|take advantage of it)",
    re.IGNORECASE,
)
_AT_DISTANCES = re.compile(
    rf"\bat (?:distances|times(?: to arrival)?) of ({AMOUNT}) \(([\w -]+)\) and ({AMOUNT}) \(([\w -]+)\) (?:from|to"
    rf"|at) ({_PLACE})",
    re.IGNORECASE,
)
_NOT_SECOND = re.compile(
    r"(?: and|,) (?:won['\u2019]t|will not|does not want to|doesn['\u2019]t want to) be second(?=[:,;])", re.IGNORECASE
)
_GETTING_TO = re.compile(
    rf"{BEGINS}((?:{_EGO})|ours) getting to ({AMOUNT}) from ({_PLACE}) and (the other(?: one| car| vehicle)?|the "
    rf"hero) to ({AMOUNT}) from "
    rf"({_PLACE}) is the (?:cue|signal|trigger) for (?:the other (?:car|vehicle|one)|the hero|it) to (slow down"
    rf"|brake|accelerate)",
    re.IGNORECASE,
)
_TRIGGERED_BY = re.compile(
    rf"{BEGINS}Triggered by ({_EGO}) (?:reaching|being|getting to) ({AMOUNT} (?:from|before|short of) {_PLACE}),? "
    rf"(?:with|and) ",
    re.IGNORECASE,
)
_TWO_TURNS = re.compile(
    rf"{BEGINS}Two (left|right) turns (?:conflict|meet|cross|collide)(?: in this \w+| here)?, the ego['\u2019]s "
    rf"([^,.]*?) and the "
    r"hero['\u2019]s ([^,.]*)\.",
    re.IGNORECASE,
)
_TURN_FOR_EGO = re.compile(
    r"\ba (left|right) turn ([^,;.]*?) for the ego and straight-on (east|west)bound driving for the hero", re.IGNORECASE
)
_HAS_TRIGGER = re.compile(
    rf"{BEGINS}This (?:one|case|test|scenario) has a (?:time|distance)-based trigger, ", re.IGNORECASE
)
_AT_TIME_TO = re.compile(
    rf"{BEGINS}At a (?:time to arrival|distance|time) of ({AMOUNT}) (?:at|from|to) ({_PLACE}), ({_EGO})['\u2019]s "
    rf"(?:time to "
    rf"arrival|distance|time) (?:at|to|from) ({_PLACE}) being ({AMOUNT}), {_HERO} (?=just |drives|brakes"
    rf"|accelerates|speeds|slows|begins"
    r"|starts)",
    re.IGNORECASE,
)
_ARRIVAL_AWAY = re.compile(
    rf"\b(its own|its|the hero['\u2019]s|the ego['\u2019]s) arrival at ({_PLACE}) (?:is )?({AMOUNT}) (?:away"
    rf"|off)\b",
    re.IGNORECASE,
)
_STOP_TAKES_PLACE = re.compile(
    rf"{BEGINS}The (?:stop|halt|standstill) (?:takes place|is made|happens|occurs|is) (?={AMOUNT} (?:before|short "
    rf"of|from)|just before)",
    re.IGNORECASE,
)
_STARTS_AT_WITH = re.compile(
    rf"\b(starts|begins) at ({AMOUNT}) from ({_PLACE}),? (?:simultaneously with|with|at the same time as) ({_EGO}) "
    rf"being ({AMOUNT}) from "
    rf"({_PLACE})",
    re.IGNORECASE,
)
_INSTEAD_OF_TURNING = re.compile(
    r"\b(gives way|yields|waits|stops) instead of turning (left|right) (into the driveway|onto the road)(?: at once"
    r"| right away"
    r"| immediately)?",
    re.IGNORECASE,
)
# "a van that wants to turn left into the driveway brakes": the end of the relative clause is not marked
_THAT_TURNS = re.compile(
    r"\b((?:an?|the) (?:[\w-]+ ){0,2}(?:car|van|truck|vehicle|hero|driver|minibus|bus|taxi|lorry|one)) (?:that"
    r"|which|who)(?: is| was"
    r"|['\u2019]s)? (wants to|going to|about to|intends to|plans to) (turn (?:left|right)(?: (?:in|on)to the "
    r"(?:same )?(?:driveway|road))?) "
    r"(?=brakes|stops|slows|starts|begins|accelerates|comes to|decelerates|yields|speeds|braking)",
    re.IGNORECASE,
)
_BEING_FROM = re.compile(
    rf"{BEGINS}Being ({AMOUNT}) from ({_PLACE}), with ({_EGO}) ({AMOUNT}) from ({_PLACE}|it), (?:the hero|it) ",
    re.IGNORECASE,
)
_WHAT_EGO_DOES = re.compile(
    rf"{BEGINS}What (the (?:ego|hero)) (?:does|has to do|wants to do) is (turn|go|drive"
    rf"|keep) ",
    re.IGNORECASE,
)
_AN_INITIAL = re.compile(rf"\bfrom an initial (?={AMOUNT} (?:before|from|short of))", re.IGNORECASE)
_GOES_AHEAD_AFTER_ALL = re.compile(rf"\b(goes|drives|pulls) (?:off |out )?ahead of {_EGO} after all\b", re.IGNORECASE)
_CONFRONTED = re.compile(
    rf"\b(?:it|{_EGO}) is (?:confronted|faced) with (the hero(?: vehicle)?) (brak|slow)ing\b",
    re.IGNORECASE,
)
_NOT_INTERFERE = re.compile(
    rf"(?:,| and) does not (?:interfere with|disturb|impede|obstruct|bother|hinder) (?={_EGO})", re.IGNORECASE
)
_TURNING_IS_WHAT = re.compile(
    rf"{BEGINS}Turning (left|right) is what ({_HERO}|{_EGO}) (?:intends|wants|plans|has in mind|is going to do)\b",
    re.IGNORECASE,
)
_DEFINED_BY_TWO = re.compile(
    rf"{BEGINS}The moment at which (it|the hero) begins to (brake|accelerate) is (?:defined|given|determined) by "
    rf"two (?:arrival "
    rf"times|distances|times), ({AMOUNT}) for ({_EGO}|the hero) (?:at|to|from) ({_PLACE}) and ({AMOUNT}) for "
    rf"({_EGO}|the hero) (?:at|to"
    rf"|from) ({_PLACE})",
    re.IGNORECASE,
)
_DOES_AT = re.compile(
    rf"\b((?:its driver|the hero|it|{_HERO}) accelerates) at ({AMOUNT}) from ({_PLACE}), at which (?:time|moment"
    rf"|point) ({_EGO}) is "
    rf"({AMOUNT}) from ({_PLACE})",
    re.IGNORECASE,
)
_GAINS_LEAD = re.compile(r"\bgains the (?:lead|advantage|upper hand) by accelerating\b", re.IGNORECASE)
_PLACE_OF_STOP = re.compile(
    rf"{BEGINS}The (?:place|point|spot) where (it|the hero) (?:comes to a (?:stop|halt)|stops|comes to rest|halts) "
    rf"is ",
    re.IGNORECASE,
)
_PASSAGE_PRECEDES = re.compile(
    rf"{BEGINS}The hero['\u2019]s passage of (the conflict point) (?:must |shall |has to )?precedes? the "
    rf"ego['\u2019]s(?=[.;])",
    re.IGNORECASE,
)
_HOLD_UNTIL = re.compile(rf"\bhold(?:s)? until (?={_EGO} has )", re.IGNORECASE)
_CRUISE_UNTIL = re.compile(
    rf"\b(?:cruise|drive on|proceed|keep going|go on) until ({_EGO} (?:is|has|gets)(?:[^;.]|\.\d)*?)[;,] then ",
    re.IGNORECASE,
)
_AND_AFTER_HALT = re.compile(
    r"\band after (?:the|this|that) (?:halt|stop|standstill|wait|pause),? (?=it |he |the hero )", re.IGNORECASE
)
_HAS_TURN_DONE = re.compile(r"\bhas its turn (?:completed|done|finished) (?=before )", re.IGNORECASE)
_TWO_TURNERS = re.compile(
    rf"{BEGINS}(?:Imagine|Consider|Picture|Take|Think of) two (?:left|right)[ -]turners(?: whose (?:paths|ways"
    rf"|routes) (?:cross"
    r"|meet|conflict))?\.",
    re.IGNORECASE,
)
_START_OF_EVENT = re.compile(
    rf"{BEGINS}(?:Start|Beginning|Onset) of (?:the )?(?:event|interaction|manoeuvre|conflict|action|challenge"
    rf"|reaction)(?: is)?:",
    re.IGNORECASE,
)
_STARTS_WITH_BOTH = re.compile(
    rf"{BEGINS}The (?:challenge|event|interaction|conflict|hazard|critical phase|action|encounter) (?:starts|begins"
    rf"|sets in) with "
    rf"((?:{_EGO}) {AMOUNT}(?:[^.]|\.\d)*)\. From (?:there|then|that moment|that point)(?: on)?,? ",
    re.IGNORECASE,
)
_ASSERTS_ITSELF = re.compile(
    r"\b(?:asserts itself|closes the gap|stands its ground|plays it safe|behaves by the book|does the right "
    r"thing)[:;] (?:it|he) ",
    re.IGNORECASE,
)
_HOLDS_TILL = re.compile(r",? and (?:I |we )?holds? (?:it|that|this|them) (?=(?:till|until) )", re.IGNORECASE)
_BEHIND_ME = re.compile(r"(?<=behind me) (?=I (?:brake|stop|accelerate|slow|begin|start|hit)\b)")
_WHOSE_ROUTE = re.compile(r"\bwhose (?:route|path|way) (?=turns|goes|leads|runs|continues)", re.IGNORECASE)
_WITHOUT_GRANTING = re.compile(
    rf",? without (?:granting|giving|leaving|conceding) (?:{_EGO}|it|us) (?:its |the |any )?(?:priority|right of "
    rf"way|precedence|way)\b",
    re.IGNORECASE,
)
_HENCE_MUST = re.compile(
    r",? (?:hence|so it|and so|and therefore|and thus|and hence|therefore) (?:it )?(?:must|has to) (?:give way"
    r"|yield|wait)(?=[.,;])",
    re.IGNORECASE,
)
_BY_THE_BOOK = re.compile(rf"{BEGINS}(?:It|The hero) behaves by the book: ", re.IGNORECASE)
_TIMES_COINCIDE = re.compile(
    r"\bwhen two (?:times(?: to arrival)?|distances) coincide, namely (?=[\d.]+ |\w+_(?:m|s|ft)\b)", re.IGNORECASE
)
_ONSET_IS = re.compile(
    rf"{BEGINS}(?:Interaction )?onset is (?:defined as )?(?:the )?(?:joint )?(?:event|moment|instant) that ((?:[^.]"
    rf"|\.\d)*)\. From "
    r"onset(?: on)?,? ",
    re.IGNORECASE,
)
_DOES_NOTHING_BUT = re.compile(r"\bdoes nothing but (follow|keep|drive|stay)\b", re.IGNORECASE)
_TOWARDS_COMES = re.compile(r"\b(Towards (?:it|the ego)) comes, (east|west)bound, an? (?=[\w ]+ that )", re.IGNORECASE)
_ENDS_WITH = re.compile(
    r",? and ends with (?:the [\w-]+(?: [\w-]+)?|it) (?:stationary|at rest|stopped|at a standstill) (?=just before"
    r"|[\d.]+ |\w+_)",
    re.IGNORECASE,
)
_WHICH_IS_LABEL = re.compile(
    r", which is (?:the|a) (?:label|outcome|behaviou?r|quantity|metric|result) (?:that|which) [^.;,\d]*(?=[.;])",
    re.IGNORECASE,
)
_BEING_PROMPTS = re.compile(
    rf"{BEGINS}Being ({AMOUNT}) from ({_PLACE}) with ({_EGO}) ({AMOUNT}) from ({_PLACE}|it) (?:prompts|causes"
    rf"|makes) the hero (?:to )?"
    r"(brake|accelerate)\b",
    re.IGNORECASE,
)
_GAP_CAUSES = re.compile(
    rf"{BEGINS}An? (time headway|headway|time gap|gap|distance) of ({AMOUNT})( between (?:[\w ]+?))? (?:causes"
    rf"|makes|prompts|leads) (the "
    r"hero) (?:to )?(brake|decelerate)\b",
    re.IGNORECASE,
)
_HAVING_STOPPED_AT = re.compile(
    rf"{BEGINS}Having (?:stopped|halted|come to (?:a (?:full |complete )?(?:stop|halt)|rest)) ((?:{AMOUNT} "
    rf"(?:before|short of|from)|just "
    rf"before) {_PLACE}), (it|the hero) ",
    re.IGNORECASE,
)
_NO_MANOEUVRE_BUT = re.compile(
    r"\bplans no (?:manoeuvre|maneuver|turn) (?:other than|but|except) (?=following|keeping|staying)", re.IGNORECASE
)
_YIELDS_THEN_GOES = re.compile(
    rf"{BEGINS}Interaction: (?:the )?hero yields,? (?:and )?then goes\. (?=It )", re.IGNORECASE
)
_UNTIL_ARRIVAL = re.compile(
    rf"({AMOUNT}) (?:are|is) left until (the [\w-]+)['\u2019]s arrival at ({_PLACE}) and ({AMOUNT}) until (the "
    rf"[\w-]+)['\u2019]s(?=,)",
    re.IGNORECASE,
)
_TURN_MADE_BY = re.compile(
    r"\ba (left|right) turn ([^,;.]*?)(,? (?:east|west)bound,?)? is to be made by (the (?:ego|hero))\b", re.IGNORECASE
)
_ONE_THAT_REMAINS = re.compile(r"\bthe one that remains (?=for )", re.IGNORECASE)
_WINDS_UP = re.compile(
    r"\b(?:winds|ends|finishes) (?:up )?(?:stopped|standing|stationary|at rest)(?: at)? (?=[\d.]+ |\w+_(?:m|ft)\b"
    r"|just before)",
    re.IGNORECASE,
)
_ALTHOUGH_COULD = re.compile(
    r", (?:although|though|even though) (?:it|he|she) (?:could|might|should|ought to) (?:yield|stop|wait|give way"
    r"|brake),",
    re.IGNORECASE,
)
_CHANGES_MODE = re.compile(
    r"\b(?:transitions|switches|changes|goes|shifts) (?:in)?to (?:an? |its )?[\w-]+ (?:mode|policy|behaviou?r"
    r"|profile|state)[:;] (?:it|he) ",
    re.IGNORECASE,
)
_LET_RESUME = re.compile(r"\bWe then let (it|the hero) (?:resume|go on|continue) by accelerating\b", re.IGNORECASE)


def _parted(found: re.Match[str]) -> str:
    who, wants, turns = found.groups()
    wants = f"is {wants}" if wants.lower() in ("going to", "about to") else wants
    return f"{who}, which {wants} {turns}, "


def _both_turn(found: re.Match[str]) -> str:
    first, who, second, other = found.groups()
    return f"The {who.lower()} is {first}. The {other.lower()} is {second}."


def _lane_said(found: re.Match[str]) -> str:
    """Return "along that lane" with its direction, where one was told."""
    told = re.findall(r"\b(east|west)bound (?:lane|side|traffic)", found.string[: found.start()], re.IGNORECASE)
    return f"{found.group(1)} the {told[-1].lower()}bound lane" if told else found.group()


def _does_when(found: re.Match[str]) -> str:
    deed = {"braking": "brakes", "deceleration": "brakes", "acceleration": "accelerates", "stop": "brakes"}
    hero = found.group(1)
    return f"{hero[0].upper()}{hero[1:]} {deed[found.group(2).lower()]} when "


def _is_away(found: re.Match[str]) -> str:
    who = {"its own": "it", "its": "it", "the hero's": "the hero", "the ego's": "the ego"}
    said = found.group(1).lower().replace("\u2019", "'")
    return f"{who[said]} is {found.group(3)} from {found.group(2)}"


def _own_and_ego(found: re.Match[str]) -> str:
    amount, place, ego, other, there = found.groups()
    return f"When the hero is {amount} from {place} and {ego} is {other} from {there}, the hero "


def _ego_last(found: re.Match[str]) -> str:
    amount, place, ego, there, other = found.groups()
    return f"When the hero is {amount} from {place} and {ego} is {other} from {there}, the hero "


def _own_prompts(found: re.Match[str]) -> str:
    amount, place, ego, other, there, deed = found.groups()
    return f"When the hero is {amount} from {place} and {ego} is {other} from {there}, the hero {deed}s"


def _stops_then(found: re.Match[str]) -> str:
    place, hero = found.groups()
    return f"{hero[0].upper()}{hero[1:]} stops {place}. Then it "


def _by_two(found: re.Match[str]) -> str:
    hero, deed, first, who, place, second, other, there = found.groups()
    return (
        f"{hero[0].upper()}{hero[1:]} {deed}s when {who} is {first} from {place} and {other} is {second} from {there}"
    )


def _cue_to(found: re.Match[str]) -> str:
    ego, first, place, hero, second, there, deed = found.groups()
    verb = {"slow down": "slows down", "brake": "brakes", "accelerate": "accelerates"}[deed.lower()]
    return f"When {ego.lower()} is {first} from {place} and {hero} {second} from {there}, {hero} {verb}"


def _does_when_at(found: re.Match[str]) -> str:
    does, first, place, ego, second, there = found.groups()
    return f"{does} when the hero is {first} from {place} and {ego} is {second} from {there}"


def _begins_when(found: re.Match[str]) -> str:
    verb, first, place, ego, second, there = found.groups()
    return f"{verb} when the hero is {first} from {place} and {ego} is {second} from {there}"


# In this order: what one rule leaves, the next may read.
STAGING_PHRASES: Rules = (
    (_COMMAS_AROUND, r"\1 and \2 \3 "),
    (_NEEDS_ANOTHER, r"is \1 and \2 \3 from "),
    (_LIKE_A_RUN, ""),
    (_GIVE_TURN, r"\1 makes a \2 turn"),
    (_GIVE_AMOUNT, r"\1 is initially \2 from \3"),
    (_PLAYS_HERO, r"\1, the hero, is\2"),
    (_MAKE_HERO, r"The \1 is \2"),
    (_TRY_TURN, r"\1 makes "),
    (_IT_IS_WHEN, r"When \1, "),
    (_NOBODY_YIELDS, ""),
    (_IN_BRACKETS_BOTH, _both_turn),
    (_SHOULD_BE, r"When \1 is "),
    (_SETS_OFF, _does_when),
    (_AFTER_ITS_WAIT, r"after waiting \1 \2s"),
    (_TO_DO_SO, ""),
    (_LEAVES_RIGHT, "yields to "),
    (_REQUIREMENT, r" and \1 \2es"),
    (_REGARD_WHICH, r"\1 \2\3. \4 "),
    (_THAT_LANE, _lane_said),
    (_FIRST_SEEN, "is initially"),
    (_LET_BRAKING, r"With \1, the hero brakes to \2"),
    (_ONLY_TO_GO, ""),
    (_AT_DISTANCES, r"with \2 \1 and \4 \3 from \5"),
    (_NOT_SECOND, ""),
    (_GETTING_TO, _cue_to),
    (_TRIGGERED_BY, r"With \1 \2 and "),
    (_TWO_TURNS, r"The ego makes a \1 turn \2. The hero makes a \1 turn \3."),
    (_HAS_TRIGGER, ""),
    (_TURN_FOR_EGO, r"the ego makes a \1 turn \2, and the hero drives \3bound straight on"),
    (_AT_TIME_TO, _ego_last),
    (_ARRIVAL_AWAY, _is_away),
    (_STOP_TAKES_PLACE, "It stops "),
    (_STARTS_AT_WITH, _begins_when),
    (_INSTEAD_OF_TURNING, r"yields and wants to turn \2 \3"),
    (_THAT_TURNS, _parted),
    (_BEING_FROM, _own_and_ego),
    (_WHAT_EGO_DOES, r"\1 \2s "),
    (_AN_INITIAL, "initially "),
    (_GOES_AHEAD_AFTER_ALL, r"\1 on after all"),
    (_CONFRONTED, lambda found: f"{found.group(1)} {'brakes' if found.group(2) == 'brak' else 'slows'}"),
    (_NOT_INTERFERE, ", yielding to "),
    (_TURNING_IS_WHAT, r"\2 wants to turn \1"),
    (_DEFINED_BY_TWO, _by_two),
    (_DOES_AT, _does_when_at),
    (_GAINS_LEAD, "accelerates"),
    (_BEING_PROMPTS, _own_prompts),
    (_GAP_CAUSES, r"When the \1\3 is \2, \4 \5s"),
    (_HAVING_STOPPED_AT, _stops_then),
    (_NO_MANOEUVRE_BUT, "is "),
    (_YIELDS_THEN_GOES, "Hero: "),
    (_UNTIL_ARRIVAL, r"\2 is \1 and \5 \4 from \3"),
    (_TURN_MADE_BY, r"\4 is to make a \1 turn \2\3"),
    (_ONE_THAT_REMAINS, "the time that remains "),
    (_WINDS_UP, "stops "),
    (_ALTHOUGH_COULD, ""),
    (_CHANGES_MODE, ""),
    (_LET_RESUME, r"Then \1 accelerates"),
    (_HOLD_UNTIL, "wait until "),
    (_CRUISE_UNTIL, r"when \1, "),
    (_AND_AFTER_HALT, "and then "),
    (_HAS_TURN_DONE, "completes its turn "),
    (_TWO_TURNERS, ""),
    (_START_OF_EVENT, "Trigger:"),
    (_STARTS_WITH_BOTH, r"With \1, "),
    (_BY_THE_BOOK, ""),
    (_ASSERTS_ITSELF, ""),
    (_HOLDS_TILL, " "),
    (_BEHIND_ME, ", "),
    (_WHOSE_ROUTE, "which "),
    (_WITHOUT_GRANTING, ""),
    (_HENCE_MUST, ""),
    (_TIMES_COINCIDE, "when "),
    (_ONSET_IS, r"When \1, "),
    (_DOES_NOTHING_BUT, r"\1s"),
    (_TOWARDS_COMES, r"\1 comes an \2bound "),
    (_ENDS_WITH, ", and it stops "),
    (_WHICH_IS_LABEL, ""),
    (_PLACE_OF_STOP, r"\1 stops "),
    (_PASSAGE_PRECEDES, r"The hero passes \1 before the ego does"),
)
