"""Turns of phrase for how somebody conducts himself: "with no regard for the ego", "whose courtesy does not last".

What enters: nothing. What leaves: `CONDUCT_PHRASES`, patterns with what to say instead, in their order: what only
colours a deed that is told is left out, "The hesitation begins when ...: the hero brakes" is "When ..., the hero
brakes".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, PRIORITY, Rules

_RIGHTS = (
    rf"(?:(?:the )?(?:(?:east|west)bound )?(?:ego|AV|SUT)(?: vehicle)?(?:['\u2019]s (?:{PRIORITY}))?|(?:the |its )?"
    rf"{PRIORITY}(?: of the ego)?|others?|anyone|anybody|anything|us|other traffic|the (?:traffic )?rules)"
)
_NOBODY = r"(?:the ego|it|us|anyone|anybody)"
_YIELD = r"(?:yield|give way|wait|stop|brake|let (?:the ego|it|us) (?:go|pass|in|out)(?: first)?)"
_YIELDING = rf"(?:yielding|waiting|giving way|stopping|braking|slowing down)(?: (?:to|for) {_NOBODY})?"
_DISREGARD = (
    r"(?:(?:with no|without(?: any| the slightest)?|with (?:little|scant)|in (?:full |complete )?(?:dis)?regard of)"
    r" ?(?:regard|respect|consideration|concern|thought)? ?(?:for|to|of)?|heedless of|careless of|disregarding|ignoring"
    r"|unconcerned about|showing no (?:regard|consideration) for)"
)
_REGARDLESS_FIRST = re.compile(
    rf"{BEGINS}(?:Heedless of|Careless of|Disregarding|Ignoring|Unconcerned about|(?:With no|Without(?: any)?|With "
    rf"little) "
    rf"(?:regard|respect|consideration|concern) for) {_RIGHTS}, (?=the hero|it |he |she |an? )",
    re.IGNORECASE,
)
_REGARDLESS = re.compile(rf",? {_DISREGARD} {_RIGHTS}(?=,|[.;:]| and\b)", re.IGNORECASE)
_SPEEDS_UP = re.compile(r"\baccelerat|\bspeed(?:s|ing)? up|\bsped up|\bsteps? on|\bgains? speed", re.IGNORECASE)
_UNWILLING = re.compile(
    rf"\b(?:is )?(?:unwilling|not willing|not prepared|not inclined|disinclined) to {_YIELD}\b", re.IGNORECASE
)
# "the hero, which acknowledges that the ego has priority, brakes"
_KNOWS_RIGHT = re.compile(
    r", (?:which|who) (?:acknowledges|recogni[sz]es|respects|accepts|knows|is aware|understands|honou?rs|observes)"
    rf"(?: that| of)? [^,.;\d]*?(?:{PRIORITY}|wait|yield|give way)[^,.;\d]{{0,20}},(?= (?:brakes|slows|stops"
    rf"|decelerates"
    r"|begins|starts|comes))",
    re.IGNORECASE,
)
_WILLING = re.compile(
    rf", (?:which|who) is (?:willing|prepared|ready|happy|inclined) to {_YIELD},(?= (?:brakes|slows|stops|decelerates"
    r"|begins|starts|comes))",
    re.IGNORECASE,
)
_DOES_NOT_LAST = re.compile(
    rf"(?:{BEGINS}(?:But |However, )?|, but )(?:its|his|her|the|this|that) (?:courtesy|patience|politeness"
    rf"|hesitation|kindness"
    r"|restraint|generosity|consideration|caution|good manners) (?:does not|doesn['\u2019]t|did not|do not) (?:last"
    r"|hold)(?: long)?(?: though|, though|, however)?[:;]",
    re.IGNORECASE,
)
_ALTHOUGH = re.compile(
    rf"{BEGINS}(?:Although|Though|Even though) (?:it|he|she|the hero) [^,.;\d]*?(?:{PRIORITY}|first|keep going)"
    r"[^,.;\d]*, (?=(?:the hero|it|he|she)(?: vehicle)? (?:brakes|slows|stops|decelerates|begins|starts|yields))",
    re.IGNORECASE,
)
_ALTHOUGH_AFTER = re.compile(
    rf",? (?:although|though|even though) (?:it|he|she) (?:would have to|ought to|is supposed to|should|has to"
    rf"|must) {_YIELD}"
    rf"(?: (?:to|for) {_NOBODY})?(?=[.;])",
    re.IGNORECASE,
)
_POLICY = re.compile(
    r"\b(?:follows|adopts|executes|applies|uses|shows|displays) (?:an?|its) (?:[\w-]+ )?(?:policy|strategy|behaviou?r"
    r"|manoeuvre|maneuver|style)(?:, (?:i\.e\.,?|that is,?|namely,?)|[:;]) (?:it|he|she) ",
    re.IGNORECASE,
)
_DO_SO = re.compile(
    r"\b(It|He|She|The hero) (?:starts|begins) (?:to do|doing) (?:so|this|that) (?=at |when |once |as soon as |with "
    r"|\d)"
)
_BY_DOING_SO = re.compile(
    rf"{BEGINS}(?:By|In) (?:doing so|doing this|this way|that way|so doing),? (?=it |he |she |the )", re.IGNORECASE
)
_INSTEAD = re.compile(
    rf",? (?:instead of|rather than) {_YIELDING},(?= (?:accelerates|speeds|begins to accelerate|starts to "
    rf"accelerate|steps"
    r"|begins accelerating|starts accelerating))",
    re.IGNORECASE,
)
_WITHOUT_CROSSING = re.compile(
    r"(?<=[a-z]),? without (?:having )?(?:cross(?:ed|ing)|pass(?:ed|ing)|touch(?:ed|ing)|go(?:ne|ing) (?:over"
    r"|beyond|past)"
    r"|overrunning|driv(?:en|ing) over) (?:it|that line|the line)(?=[.;,])",
    re.IGNORECASE,
)
_OF_STANDING = re.compile(
    rf"\bafter ({AMOUNT}) (?:of )?(?:standing|waiting|standstill|at rest|at a standstill)(?: still| there)?(?= |[.,;])",
    re.IGNORECASE,
)
_IN_DETAIL = re.compile(
    rf"{BEGINS}(?:In detail|More (?:exactly|precisely|specifically)|In concrete terms|Concretely|Specifically|To be "
    rf"(?:exact"
    r"|precise|specific)|In practice|In other words|Put differently|To put it (?:simply|differently)|That is to say"
    r"|In this (?:particular )?(?:one|variant|instance)),? (?=[a-z])",
    re.IGNORECASE,
)
_OF_ITS_OWN = re.compile(r"\b(turn) of (?:its|his|her) own\b", re.IGNORECASE)
_OUTCOME = re.compile(
    rf"{BEGINS}(?:The|Our) (?:outcome|result|behaviou?r|order|thing)(?: that)? (?:we (?:are after|want(?: to see)?"
    rf"|look for)"
    r"|wanted|desired|sought) is (?:that )?",
    re.IGNORECASE,
)
# "The hero plays an impatient driver. It is on the driveway"
_PLAYS = re.compile(
    rf"{BEGINS}(?:In this (?:one|case|test|run),? |Here,? |This time,? )?(the hero(?: vehicle)?) (?:plays|acts as"
    rf"|impersonates"
    r"|portrays|represents) (?:the (?:part|role) of )?an? (?:[\w-]+ ){0,2}(?:driver|motorist|character|road user)[.:;] "
    r"(?:it|he|she) ",
    re.IGNORECASE,
)
_BEHAVES = re.compile(
    rf"{BEGINS}(?:In this (?:one|case|test|run),? |Here,? |This time,? )?(the hero(?: vehicle)?) (?:behaves|drives"
    rf"|acts) "
    r"(?:well|badly|correctly|properly|politely|nicely|aggressively|selfishly|rudely|considerately|courteously"
    r"|cautiously"
    r"|assertively)[.:;] (?:it|he|she) ",
    re.IGNORECASE,
)
_ONLY_TO = re.compile(
    r",? only to (accelerate|set off|drive on|go on|start|move off|pull away)( again)?(,? and (?:then )?)?"
    r"(complete|pass|cross|finish|clear|go)?\b",
    re.IGNORECASE,
)
_NOTHING_BUT = re.compile(
    r"\b(?:Nothing|No more|Nothing more|Nothing else) (?:but|than) (follow|keep|driv|go)ing([^,.;]*?) is (?:asked"
    r"|required"
    r"|expected|demanded|wanted) of (the ego|it)",
    re.IGNORECASE,
)
_COMES_TRIGGER = re.compile(
    rf"{BEGINS}(?:Later|Then|Next|Now|Here|And then|And now),? (?:comes|follows|occurs) the (?:trigger|cue|signal)[:.]",
    re.IGNORECASE,
)
# "The hesitation begins when ...: the hero brakes": what begins is told after the colon
_BEGINS_WHEN = re.compile(
    rf"{BEGINS}(?:The|Its|This|His) (?:(?!brak|decel|accel|slow|test|run|scen|sim|hero|ego|ride|driv|rec|vid|trial"
    rf"|obs|epis"
    r"|exp)[\w-]+ ){1,3}(?:starts|begins|sets in|occurs|unfolds|arises|happens|kicks in|comes"
    r"|is released|is triggered|is initiated|is set off) (when|once|as soon as) "
    r"([^:;]*?): (?=the hero|it |he |she )",
    re.IGNORECASE,
)


def _where_it_speeds_up(found: re.Match[str]) -> str:
    """Leave out what only colours that somebody speeds up; where nobody does, it may say that he does not yield."""
    return "" if _SPEEDS_UP.search(found.string) else found.group()


def _begins_to(found: re.Match[str]) -> str:
    """Return "It starts to do so" as what was told last: "It starts to brake"."""
    told = re.findall(r"\b(brak|decelerat|slow|accelerat|speed)", found.string[: found.start()].lower())
    deed = {"brak": "brake", "decelerat": "brake", "slow": "brake"}.get(told[-1], "accelerate") if told else "do so"
    return f"{found.group(1)} begins to {deed} "


def _then_does(found: re.Match[str]) -> str:
    """Return ", only to accelerate again and pass" as ", then accelerates again and passes"."""
    verb = found.group(1).split()
    first = " ".join([verb[0] + ("es" if verb[0] == "go" else "s"), *verb[1:]])
    second = found.group(4)
    second = f"{second}{'es' if second.lower() in ('pass', 'cross', 'finish', 'go') else 's'}" if second else ""
    return f", then {first}{found.group(2) or ''}{found.group(3) or ''}{second}"


def _does_only(found: re.Match[str]) -> str:
    """Return "Nothing but following its lane is asked of the ego" as "The ego follows its lane"."""
    verb = {"follow": "follows", "keep": "keeps", "driv": "drives", "go": "goes"}[found.group(1).lower()]
    who = found.group(3)
    return f"{who[0].upper()}{who[1:]} {verb}{found.group(2)}"


# In this order: what one rule leaves, the next may read.
CONDUCT_PHRASES: Rules = (
    (_REGARDLESS_FIRST, _where_it_speeds_up),
    (_REGARDLESS, _where_it_speeds_up),
    (_UNWILLING, "not yielding"),
    (_KNOWS_RIGHT, ""),
    (_WILLING, ""),
    (_DOES_NOT_LAST, lambda found: ", then" if found.group().startswith(",") else "Then"),
    (_ALTHOUGH, ""),
    (_ALTHOUGH_AFTER, ""),
    (_POLICY, ""),
    (_DO_SO, _begins_to),
    (_BY_DOING_SO, ""),
    (_INSTEAD, ""),
    (_WITHOUT_CROSSING, ""),
    (_OF_STANDING, r"after waiting \1"),
    (_IN_DETAIL, ""),
    (_OF_ITS_OWN, r"\1"),
    (_OUTCOME, ""),
    (_PLAYS, r"\1 "),
    (_BEHAVES, r"\1 "),
    (_ONLY_TO, _then_does),
    (_NOTHING_BUT, _does_only),
    (_COMES_TRIGGER, "Trigger:"),
    (_BEGINS_WHEN, r"\1 \2, "),
)
