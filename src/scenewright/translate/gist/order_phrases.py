"""Turns of phrase for who is first: "has the conflict point behind it before", "the ego turns only once it has passed".

What enters: nothing. What leaves: `ORDER_PHRASES`, patterns with what to say instead, in their order: whatever is
told of both is "the hero passes the conflict point before the ego begins to turn".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import BEGINS, Rules

_EGO = r"(?:the ego(?: vehicle)?|ego|the AV|the SUT|our car)"
_HERO = (
    r"(?:the hero(?: vehicle)?|hero|it|he|she|the other (?:vehicle|car)"
    r"|the (?!ego|av\b|sut\b|vut\b|conflict|stop|inter|drive|road|lane|same|test|trigger|moment|time|distance|gap|turn"
    r"|vehicle|car)[\w-]+)"
)
_TURNS = r"(?:to turn|its turn|turning|the turn|its own turn)"
_POINT = r"(?:the conflict point|it|that point|there)"
_BEGINS_TURN = rf"(?:begins|starts|commences) {_TURNS}"
_PASSED = r"(?:has passed|passes|is past|has crossed|has cleared|has gone through|is through|is beyond)"

# "the ego begins to turn only once the hero has passed the conflict point, and not before"
_ONLY_ONCE_PASSED = re.compile(
    rf"\b({_EGO}) (?:then )?{_BEGINS_TURN} (?:only )?(?:when|once|after|later than) ({_HERO}) {_PASSED} ({_POINT})"
    r"(?:,? and not (?:before|earlier|sooner))?(?=[.,;]|$)",
    re.IGNORECASE,
)
_NOT_UNTIL_PASSED = re.compile(
    rf"\b(?:{_EGO} (?:does not|doesn['\u2019]t) (?:begin|start) {_TURNS}|{_EGO}['\u2019]s turn (?:does not"
    rf"|doesn['\u2019]t) "
    rf"(?:begin|start)) (?:until|before) ({_HERO}) {_PASSED} ({_POINT})(?=[.,;]|$)",
    re.IGNORECASE,
)
_NOT_UNTIL_DOES = re.compile(
    rf"\bnot until ({_HERO}) {_PASSED} ({_POINT}) does {_EGO} (?:begin|start) {_TURNS}", re.IGNORECASE
)
_AFTER_PASSING = re.compile(
    rf"\bit is (?:only )?after ({_HERO})['\u2019]s passing of ({_POINT}) that {_EGO} {_BEGINS_TURN}", re.IGNORECASE
)
_AFTER_THIS_THAT = re.compile(
    rf"\bit is (?:only )?(?:after (?:this|that)|then|afterwards) that (?={_EGO} (?:begins|starts))", re.IGNORECASE
)
_NOT_YET_TURNING = re.compile(
    rf"\b(?:ahead of {_EGO}, which has|(?:at a time when|while|when|with) {_EGO} (?:has|having)) (?:still |yet "
    rf")?not (?:yet )?"
    rf"(?:begun|started) {_TURNS}(?: yet)?",
    re.IGNORECASE,
)
_PAST_WHEN = re.compile(
    rf"\b(?:is|be|gets|has got) (?:already )?(?:past|through|beyond) ({_POINT}) (?:when|as|at the moment when) {_EGO} "
    rf"{_BEGINS_TURN}",
    re.IGNORECASE,
)
_PASSED_WHEN = re.compile(
    rf"\b(?:has|will have) (?:already )?passed ({_POINT}) (?:when|by the time|at the moment when) {_EGO} "
    rf"{_BEGINS_TURN}",
    re.IGNORECASE,
)
_WHEN_ALREADY = re.compile(
    rf"{BEGINS}(?:When|By the time|At the (?:time|moment|instant)(?: when| at which| that)?) {_EGO} (?:then "
    rf"|eventually "
    rf"|finally )?{_BEGINS_TURN}, ({_HERO}) (?:has|will have) (?:already |long )?(?:passed|crossed|cleared|gone "
    rf"through) "
    rf"({_POINT})",
    re.IGNORECASE,
)
_WHEN_BEHIND = re.compile(
    rf"{BEGINS}(?:When|By the time|At the (?:time|moment|instant)(?: when| at which| that)?) {_EGO} (?:then )?"
    rf"{_BEGINS_TURN}, ({_POINT}) (?:already )?(?:lies|is) (?:already )?behind ({_HERO})",
    re.IGNORECASE,
)
_BEHIND_IT = re.compile(r"\bhas (the conflict point|that point) behind (?:it|itself|him|her) before\b", re.IGNORECASE)
_IS_BEHIND_IT = re.compile(r"\b(the conflict point|that point) is behind (it|him|her|the hero) before\b", re.IGNORECASE)
_TAKES_POINT = re.compile(
    r"\b(?:takes|claims|secures|wins) (the conflict point)(?: for itself)?(?= first\b| before\b|,| ahead)",
    re.IGNORECASE,
)
_TO_CLAIM = re.compile(
    r" (?:in order |so as )?to (?:claim|win|take|secure|grab) (?:the conflict point|the race(?: to the conflict point)?"
    r"|the right of way|the gap)(?: for itself)?(?=[,.;]| and (?:it )?(?:passes|crosses|goes))",
    re.IGNORECASE,
)
_SUCCEEDS = re.compile(
    r",? (?:and )?(?:it|he|she) (?:succeeds|manages|makes it|does)[:;] (?=it |he |she )", re.IGNORECASE
)
_NOT_WHAT_IT_DOES = re.compile(rf"\b(?:Yielding|Giving way) is not what ({_HERO}) does\b", re.IGNORECASE)
_NO_WILLINGNESS = re.compile(
    r"\bshows no (?:willingness|intention|readiness|inclination|sign) (?:to yield|of yielding|to give way|of giving "
    r"way)",
    re.IGNORECASE,
)
_DOES_IT_YIELD = re.compile(
    rf",? does ({_HERO}) (?:yield|give way|stop|wait|brake)(?: (?:to|for) {_EGO})?\? No[,:.;] (?:instead,? )?it ",
    re.IGNORECASE,
)
_THINKS = re.compile(r"\bthinks [\"\u201c'\u2018][^\"\u201d]*[\"\u201d'\u2019],? (?:and )?(?=[a-z]+s\b)")
_NO_YIELDING = re.compile(
    rf"{BEGINS}No yielding (?:from|by) ({_HERO})[,:;] (?:just|only|but) acceleration\b", re.IGNORECASE
)
_OVER_YIELDING = re.compile(
    r"\b(?:opts for|chooses|prefers) (?:acceleration|accelerating|speed) (?:over|to|instead of|rather than) (?:yielding"
    r"|braking|waiting|giving way)",
    re.IGNORECASE,
)
_AVOIDS = re.compile(
    r",? (?:and )?(?:so|thus|thereby) avoid(?:s|ing) (?:having to )?(?:yield|yielding|giving way|give way|wait|waiting)"
    r"(?=[:,;.])",
    re.IGNORECASE,
)
_DECLINES = re.compile(
    r"\b(?:declines|omits|neglects|scorns|refuses|chooses not|decides not|opts not|is not going) to (?=yield|give way)",
    re.IGNORECASE,
)
_TURN_BEGINNING = re.compile(
    rf"\b(?:in advance of|ahead of|prior to|before|earlier than) (?:{_EGO})['\u2019]s turn(?:ing)?(?: (?:beginning"
    rf"|starting"
    r"|commencing|getting under way|being started|being begun))",
    re.IGNORECASE,
)
_IN_ADVANCE = re.compile(r"\bin advance of (?=the |our |it\b)", re.IGNORECASE)
_WAITED_FOR_TURN = re.compile(
    rf"\b(having waited|wait|waits|waiting)( there)? for ({_EGO})['\u2019]s turn to (?:be (?:over|completed?"
    rf"|finished|done)"
    r"|end|finish)",
    re.IGNORECASE,
)
_HAS_DONE_SO = re.compile(rf"\b(until|once|after) ({_EGO}|it) has done (?:so|this|that)\b", re.IGNORECASE)
_THEN_TURNED = re.compile(rf"\b({_EGO}) turns; (?:the|its) turn (?:completed|over|done|finished|made),", re.IGNORECASE)
_HEADED_FIRST = re.compile(
    rf"{BEGINS}In this (?:test|case|one|scenario) the hero goes first and {_EGO} second: ", re.IGNORECASE
)
_EGO_ONLY_AFTER = re.compile(
    rf"{BEGINS}({_EGO}): (begins to turn|begins its turn|starts to turn) only after that", re.IGNORECASE
)

_FINISHES_TURNING = re.compile(
    r"\b(finishes|completes|finish|complete) turning(?: left| right)?(?= |[.,;])", re.IGNORECASE
)
_TURN_ENDS = re.compile(
    r"\b(the hero(?: vehicle)?)['\u2019]s turn (?:ends|is over|finishes|is complete(?:d)?|is finished|is done|comes "
    r"to its end)\b",
    re.IGNORECASE,
)
_EGO_PASSES_WAITING = re.compile(
    rf"\bwaits[;,.] ({_EGO}) passes ({_POINT})[;,.] (?:and )?(?:then )?(?:after that,? )?(?={_HERO} )", re.IGNORECASE
)
_EGO_PASSES_WHILE = re.compile(
    rf"{BEGINS}(?:Then )?({_EGO}) passes ({_POINT})(?: first)?,? (?:while ({_HERO}) waits|with ({_HERO}) waiting),? "
    rf"(?:and )?"
    rf"(?:after that |then |afterwards )?(?={_HERO} )",
    re.IGNORECASE,
)
_HAVING_PASSED = re.compile(rf"{BEGINS}({_EGO}) having (passed|cleared|crossed) ", re.IGNORECASE)
_WAITS_FOR_PASSAGE = re.compile(
    rf"\bwaits for ({_EGO})['\u2019]s (?:passage|passing) (?:of|through|past) ({_POINT})", re.IGNORECASE
)
_AFTER_PASSAGE = re.compile(
    rf"\b(?:after|following|upon) ({_EGO})['\u2019]s (?:passage|passing) (?:of|through|past) ({_POINT})", re.IGNORECASE
)
_LEFT_BEHIND = re.compile(rf"\b({_EGO}) has left ({_POINT}) behind(?: it)?\b", re.IGNORECASE)
_NOT_ON_UNTIL = re.compile(
    rf",? and (?:it )?does not (drive on|go on|move off|set off|move on|continue|start again) (?:until|before) "
    rf"({_EGO} has "
    r"(?:[^.;,]|\.\d)*)(?=[.;,]|$)",
    re.IGNORECASE,
)
_EGO_PAST = re.compile(rf"{BEGINS}({_EGO}) past (the conflict point): ", re.IGNORECASE)
_ENDS_TURN = re.compile(r"\b(ends) (its turn)\b", re.IGNORECASE)
_TURN_COMPLETE_BEFORE = re.compile(r", its (?:own )?turn (?:complete[d]?|done|finished) (?=before )", re.IGNORECASE)
_PASSES_AFTERWARDS = re.compile(
    rf"\bahead of {_EGO}, which (?:passes|crosses) ({_POINT}) (?:afterwards|later|only then|after it|only after that)",
    re.IGNORECASE,
)
_INTO_TURN_AND = re.compile(
    r"\baccelerates into (?:its|the) (?:left |right )?turn(?:,)? and (completes|finishes) it\b", re.IGNORECASE
)
_CARRIES_OUT_TURN = re.compile(
    r"\b(?:carries out|makes|performs|takes) its turn,? which (?:it|he) (completes|finishes)\b", re.IGNORECASE
)
_BEFORE_PASSAGE = re.compile(
    rf"\bbefore ({_EGO})['\u2019]s (?:passage|passing) (?:of|through|past) ({_POINT})",
    re.IGNORECASE,
)
_TO_BEAT = re.compile(
    rf",? (?:(?:decides|tries|wants) )?to (?:beat|get ahead of|be ahead of|go ahead of|be faster than) {_EGO}(?:,? "
    rf"and it does)?[:;]"
    r" (?=it )",
    re.IGNORECASE,
)
_ALREADY_COMPLETE = re.compile(
    rf",? (?:so |so that )?when ({_EGO}) (?:passes|reaches) ({_POINT}), (?:the hero['\u2019]s|its) turn is already "
    rf"(?:complete[d]?"
    r"|over|done|finished)",
    re.IGNORECASE,
)
_ON_THE_CONTRARY = re.compile(
    rf"\b(?:does not|doesn['\u2019]t) (?:just |simply )?(?:slow down|brake|stop|yield|give way)(?: (?:to let|for|so "
    rf"that) {_EGO}"
    r"(?: can)?(?: pass| go| turn)?)?[;:,.] (?:(?:on the contrary|instead|rather|quite the opposite|far from it),? "
    r")?(?:it|he) "
    r"(?=accelerates|speeds|brakes at)",
    re.IGNORECASE,
)
# "until the completion of the ego's turn", "with the ego's turn completed"
_COMPLETION = re.compile(
    rf"\b(until|till|up to|after|upon|once|on|with) (?:the )?(?:completion|end|finish|completing) of "
    rf"(?:{_EGO})['\u2019]s "
    r"turn(?:ing(?: manoeuvre| maneuver)?)?",
    re.IGNORECASE,
)
_TURN_OVER = re.compile(
    rf"\b(with|once|after) (?:{_EGO})['\u2019]s turn (?:being |having been |has been |is )?(?:completed?|over|done"
    rf"|finished)\b",
    re.IGNORECASE,
)
_TURN_IS_OVER = re.compile(
    r"\b(until|once|after) (?:the|that|this) turn (?:has been|is) (?:completed?|over|done|finished)\b", re.IGNORECASE
)
_FOR_WHICH_WAITS = re.compile(
    r", for which (?:it|he|she) (?:has been waiting|waits|has waited|was waiting)(?: there)?(?=,)", re.IGNORECASE
)
_WAITS_OUT = re.compile(rf"\bwaits out (?:{_EGO})['\u2019]s turn(?: to its end)?", re.IGNORECASE)
_FOR_COMPLETION = re.compile(
    rf"\bwaits (there )?(?:for (?:one thing(?: only)?: )?)?the completion of (?:{_EGO})['\u2019]s turn\b", re.IGNORECASE
)
_THAT_DONE = re.compile(rf"{BEGINS}(?:That|This) done, (?=it |the |he )", re.IGNORECASE)
_LEAVING_TO_COMPLETE = re.compile(rf"\bleaving ({_EGO}) to (complete|finish|make) (its turn)(?: first)?", re.IGNORECASE)
_AS_LONG_AS_NOT = re.compile(rf"\bas long as ({_EGO}) has not (completed|passed|finished) ", re.IGNORECASE)
_AS_LONG_AS_TAKES = re.compile(
    rf"\bfor as long as it takes ({_EGO}) to (complete|finish) its turn|\bfor as long as ({_EGO}) takes to "
    rf"(complete|finish) "
    r"its turn",
    re.IGNORECASE,
)
_COMPLETES_AND_THEN = re.compile(rf"(?<=waits\.) {_EGO} (?:completes|finishes) its turn,? and then\b", re.IGNORECASE)
_HEROS_TURN_TO_GO = re.compile(r"\bit is the hero['\u2019]s turn(?: to (?:go|drive|move))?[:,;] ?", re.IGNORECASE)
_BEFORE_IT_GOES = re.compile(
    rf"{BEGINS}Before (?:it|the hero) (accelerates|sets off|drives on|goes on|moves off)( again)?((?: and [^,.]*)?), "
    r"((?:it|the hero) (?:waits|stands)(?:[^.;]|\.\d)*)(?=[.;]|$)",
    re.IGNORECASE,
)
_WE_THEN_WANT = re.compile(r"\b(?:We|I) (?:then|next|afterwards) want (it|him|the hero) to (?=[a-z]+)", re.IGNORECASE)
_INTERRUPTS = re.compile(
    r"\b(?:interrupts|suspends|breaks off) its (?:drive|journey|travel|approach)[:;] (?:it|he|she) ", re.IGNORECASE
)
_THINGS_HAPPEN = re.compile(
    r",? (?:two|three|several) (?:things|steps|events) (?:happen|follow|take place)(?: one after the other| in "
    r"(?:order|sequence"
    r"|succession))?:",
    re.IGNORECASE,
)
_IN_PHASES = re.compile(
    r"\b(?:reacts|acts|proceeds|responds) in (?:two|three|several) (?:phases|steps|stages|parts): (?:it|he|she) ",
    re.IGNORECASE,
)
_ORDER_OF_EVENTS = re.compile(
    r"\b(?:the )?(?:order|sequence) of events(?: from then on)? is(?: this| as follows)?: ?", re.IGNORECASE
)
_LISTED_LAST = re.compile(
    rf"\bpasses (the conflict point), (?:and )?(?:then )?({_EGO}) (begins to turn|begins its turn|starts to "
    rf"turn)(?=[.;]|$)",
    re.IGNORECASE,
)
_LISTED_WAIT = re.compile(rf"\bwaits( there)?, ({_EGO}) completes its turn, (?=hero|the hero|it )", re.IGNORECASE)
_LETS_BEFORE_DRIVING = re.compile(
    rf"{BEGINS}(?:The hero|It) lets {_EGO} (?:turn|go|pass)(?: first)? before (?:driving on|going on|continuing"
    rf"|proceeding"
    r"|moving on): (?=when |once |as soon as )",
    re.IGNORECASE,
)
_CUE_TO_GO = re.compile(
    rf"{BEGINS}The completion of (?:{_EGO})['\u2019]s turn is (?:its|the hero['\u2019]s) (?:cue|signal|sign) to "
    rf"(?:stop "
    r"waiting(?: there)?, )?(accelerate) and (pass|complete|cross)\b",
    re.IGNORECASE,
)
_NOT_LET_BUT = re.compile(
    rf"\bdoes not let (?:{_EGO}|it|us) (?:turn|go|pass)(?: first)?(?:, though,|,)? but (?=accelerates|sets|drives"
    rf"|goes|moves)",
    re.IGNORECASE,
)
_PASSED_BY = re.compile(rf"{BEGINS}The conflict point is then passed by the accelerating hero\b", re.IGNORECASE)
_ACCELERATED_AND_PASSED = re.compile(
    rf"{BEGINS}By the time {_EGO} {_BEGINS_TURN}, ({_HERO}) has (?:then )?accelerated(?: again)? and passed ({_POINT})",
    re.IGNORECASE,
)


def _hero_first(found: re.Match[str]) -> str:
    """Return "The ego begins to turn once the hero has passed it" from the hero's side."""
    hero, point = found.groups()[-2:]
    said = f"{hero} passes {point} before the ego begins to turn"
    return said[0].upper() + said[1:] if found.group()[0].isupper() else said


def _done(found: re.Match[str]) -> str:
    """Return "until the ego has done so" with what was told of it last."""
    before = found.string[: found.start()].lower()
    turned, passed = before.rfind(" its turn"), max(before.rfind("ego pass"), before.rfind("ego go"))
    if max(turned, passed) < 0:
        return found.group()
    done = "has completed its turn" if turned > passed else "has passed"
    return f"{found.group(1)} {found.group(2)} {done}"


def _waits_until(found: re.Match[str]) -> str:
    verb = "after waiting" if found.group(1).lower() == "having waited" else found.group(1)
    verb = verb.capitalize() if found.group(1)[0].isupper() else verb
    return f"{verb}{found.group(2) or ''} until {found.group(3)} has completed its turn"


def _once_completed(found: re.Match[str]) -> str:
    """Return "up to the end of the ego's turn", "with the ego's turn completed" with a verb."""
    until = found.group(1).lower() in ("until", "till", "up to")
    said = f"{'until' if until else 'after'} the ego has completed its turn"
    return said[0].upper() + said[1:] if found.group()[0].isupper() else said


def _turn_of_ego(found: re.Match[str]) -> str:
    """Return "once the turn is complete" as that of the ego where it was let turn just before."""
    before = found.string[max(0, found.start() - 320) : found.start()].lower()
    own = re.search(
        r"(?:lets?|letting|waits? for) the ego(?: vehicle)? (?:to )?(?:turn|make|complete|finish|go)", before
    )
    return _once_completed(found) if own else found.group()


def _waits_then(found: re.Match[str]) -> str:
    verb = found.group(1).split()
    verb[0] += "es" if verb[0] == "go" else "s"
    return f" and waits until {found.group(2)}, then it {' '.join(verb)}"


def _goes_after(found: re.Match[str]) -> str:
    waits = found.group(4)
    return f"{waits[0].upper()}{waits[1:]}, then it {found.group(1)}{found.group(2) or ''}{found.group(3)}"


def _until_completed(found: re.Match[str]) -> str:
    return f"until {next(each for each in found.groups() if each)} completes its turn"


# In this order: what one rule leaves, the next may read.
ORDER_PHRASES: Rules = (
    (_EGO_ONLY_AFTER, r"Only after that \1 \2"),
    (_HEADED_FIRST, ""),
    (_ONLY_ONCE_PASSED, _hero_first),
    (_NOT_UNTIL_PASSED, _hero_first),
    (_NOT_UNTIL_DOES, _hero_first),
    (_AFTER_PASSING, _hero_first),
    (_AFTER_THIS_THAT, "only after that "),
    (_NOT_YET_TURNING, "before the ego begins to turn"),
    (_PAST_WHEN, r"passes \1 before the ego begins to turn"),
    (_PASSED_WHEN, r"passes \1 before the ego begins to turn"),
    (_WHEN_ALREADY, r"\1 passes \2 before the ego begins to turn"),
    (_WHEN_BEHIND, r"\2 passes \1 before the ego begins to turn"),
    (_BEHIND_IT, r"passes \1 before"),
    (_IS_BEHIND_IT, r"\2 passes \1 before"),
    (_TO_CLAIM, ""),
    (_TAKES_POINT, r"passes \1"),
    (_SUCCEEDS, ", "),
    (_NOT_WHAT_IT_DOES, r"\1 does not yield"),
    (_NO_WILLINGNESS, "does not yield"),
    (_DOES_IT_YIELD, r", \1 does not yield: it "),
    (_THINKS, ""),
    (_NO_YIELDING, r"\1 does not yield but accelerates"),
    (_OVER_YIELDING, "accelerates"),
    (_AVOIDS, ""),
    (_DECLINES, "does not "),
    (_TURN_BEGINNING, "before the ego begins its turn"),
    (_IN_ADVANCE, "before "),
    (_WAITED_FOR_TURN, _waits_until),
    (_HAS_DONE_SO, _done),
    (_ENDS_TURN, r"completes \2"),
    (_TURN_COMPLETE_BEFORE, ", and completes its turn "),
    (_PASSES_AFTERWARDS, r"before the ego passes \1"),
    (_INTO_TURN_AND, r"accelerates and \1 its turn"),
    (_CARRIES_OUT_TURN, r"\1 its turn"),
    (_BEFORE_PASSAGE, r"before \1 passes \2"),
    (_TO_BEAT, ";"),
    (_ALREADY_COMPLETE, r" and completes its turn before \1 passes \2"),
    (_ON_THE_CONTRARY, ""),
    (_EGO_PASSES_WAITING, r"waits until \1 has passed \2; "),
    (_EGO_PASSES_WHILE, lambda found: f"The hero waits until {found.group(1)} has passed {found.group(2)}, then "),
    (_HAVING_PASSED, r"After \1 has \2 "),
    (_WAITS_FOR_PASSAGE, r"waits until \1 has passed \2"),
    (_AFTER_PASSAGE, r"after \1 has passed \2"),
    (_LEFT_BEHIND, r"\1 has passed \2"),
    (_NOT_ON_UNTIL, _waits_then),
    (_EGO_PAST, r"Once \1 has passed \2, "),
    (_FINISHES_TURNING, r"\1 its turn"),
    (_TURN_ENDS, r"\1 completes its turn"),
    (_CUE_TO_GO, r"After the ego has completed its turn, it \1s and \2es"),
    (_FOR_COMPLETION, r"waits \1until the ego has completed its turn"),
    (_COMPLETION, _once_completed),
    (_TURN_OVER, _once_completed),
    (_TURN_IS_OVER, _turn_of_ego),
    (_FOR_WHICH_WAITS, ""),
    (_WAITS_OUT, "waits until the ego has completed its turn"),
    (_THAT_DONE, "Then "),
    (_LEAVING_TO_COMPLETE, r"letting \1 \2 \3"),
    (_AS_LONG_AS_NOT, r"until \1 has \2 "),
    (_AS_LONG_AS_TAKES, _until_completed),
    (_COMPLETES_AND_THEN, " After the ego has completed its turn,"),
    (_HEROS_TURN_TO_GO, ""),
    (_BEFORE_IT_GOES, _goes_after),
    (_WE_THEN_WANT, r"Then \1 shall "),
    (_INTERRUPTS, ""),
    (_THINGS_HAPPEN, ","),
    (_IN_PHASES, ""),
    (_ORDER_OF_EVENTS, ""),
    (_LISTED_LAST, r"passes \1 before \2 \3"),
    (_LISTED_WAIT, r"waits\1 until \2 completes its turn, "),
    (_LETS_BEFORE_DRIVING, ""),
    (_NOT_LET_BUT, "then "),
    (_PASSED_BY, "The hero then accelerates and passes the conflict point"),
    (_ACCELERATED_AND_PASSED, r"\1 accelerates and passes \2 before the ego begins to turn"),
    (_THEN_TURNED, r"until \1 has completed its turn;"),
)
