"""Turns of phrase of briefings and test plans: who is told to drive, questions with their answers, labels in short.

What enters: nothing. What leaves: `BRIEFING_PHRASES`, patterns with what to say instead, in their order: "Where are
they at first?" is "At first:". Nothing that is said instead is longer.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, EGO, PRIORITY, Rules

_ONE = r"(?:the )?(?:ego|hero|AV|SUT|VUT|POV|NPC|EUT|DUT)(?: vehicle)?"
_PLACE = r"the (?:conflict point|stop line|intersection)"
_NAMED = r"(?!at\b|it\b|them\b|both\b)(?:the |our |its )?[\w-]+(?: (?:car|vehicle|under test))?"
# "You are in the car under test", "You = the SUT": then "you" is who "we" is elsewhere
_TESTED = rf"(?:the (?:car|vehicle|one) (?:under test|being tested)|the (?:tested|test) (?:car|vehicle)|(?:the )?{EGO})"
_YOU_ARE_IT = re.compile(
    r"\byou(?: (?:are|drive|sit)|['\u2019]re|r car is| ?=| \()?(?: in| driving|(?: [^.;:\d()]{0,40}?)? (?:sitting"
    r"|sit) in"
    rf"|(?: [^.;:\d()]{{0,30}}?) in| (?:at|behind) the wheel of)? ?\b{_TESTED}\b(?!['\u2019])"
    rf"|\byour (?:\w+ ){{0,2}}(?:car|vehicle)(?: is|,)? {_TESTED}\b(?!['\u2019])",
    re.IGNORECASE,
)
_YOU = re.compile(
    r"\b(?:you|yourself)\b(?! (?:see|know|need|want to test|can|could|may|might|would|should|please|have to test))",
    re.IGNORECASE,
)
_AFTER = re.compile(r"\b((?:across|towards?|behind|in front of|past|lets?|for|of) )you\b", re.IGNORECASE)
_YOUR = re.compile(r"\byour(s)?\b", re.IGNORECASE)
_WE = re.compile(r"\b(?:we|us|our|I|my|me)\b")

# "Begin its braking when ...; finish it at a standstill 5 m before": "it" is the braking, not the turn
_FINISH_IT = re.compile(
    r"\b(?:finish|conclude|complete) (?:it|this|the braking|its braking|the deceleration) (?:at|in|with) (?=an? "
    r"(?:complete |full )?"
    r"(?:standstill|stop|halt))",
    re.IGNORECASE,
)
_END_IT = re.compile(
    rf"\b(?:end|finish) (?:it|this|the braking|its braking) with ({_ONE}) (?:stationary|at rest|stopped"
    rf"|standing)(?= )",
    re.IGNORECASE,
)
_MAKE_IT = re.compile(rf"{BEGINS}Make ({_ONE}) (?=an? )", re.IGNORECASE)
_GIVE_CUE = re.compile(
    rf"{BEGINS}Give {_ONE} (?:its|the) (?:cue|signal|trigger) when ([^.;]*(?:\.\d[^.;]*)*)\. (?:On|At|Upon) (?:its"
    rf"|the|that|this) "
    rf"(?:cue|signal|trigger),? ",
    re.IGNORECASE,
)
_LET_GO_AGAIN = re.compile(
    r"\b(?:let|have|make) it (?:go|set off|drive off|move off) again,? (?:speeding up|accelerating|with "
    r"acceleration)(?=[,.])",
    re.IGNORECASE,
)
_HAVE_IT_PASS = re.compile(r"(?<= and) have it (pass|cross|clear) (?=the conflict point)", re.IGNORECASE)
_ASKED_OF = re.compile(
    rf"{BEGINS}(?:Q: )?(?:What (?:does|about|is) ({_ONE})(?: do(?:ing)?)?|And ({_ONE})|How does ({_ONE}) (?:behave"
    rf"|move|drive))\? (?:A: )?(?:It|He|She) (?=[a-z]+s\b)",
    re.IGNORECASE,
)
_ASKED_WHEN = re.compile(rf"{BEGINS}Q: [^?\d]{{3,60}}\? A: ", re.IGNORECASE)
_STRAY_ASKED = re.compile(rf"{BEGINS}(?:How|And then|Then what|With what result)\? (?:A: )?(?=[A-Z])")
_AND_UPON_IT = re.compile(
    rf"{BEGINS}((?:[^.:;?\d]|\.\d)*\d(?:[^.:;?]|\.\d)*?): (?:that|this) is (?:the|my|our) (?:trigger|cue|signal),? "
    rf"and (?:up)?on it,? ",
    re.IGNORECASE,
)
_PLACE_AHEAD = re.compile(
    rf"\b(?:the )?(conflict point|stop line|intersection) ({AMOUNT}) (?:ahead"
    rf"|away)(?=[,.;])",
    re.IGNORECASE,
)

_AT_THAT_LINE = re.compile(r"\bat (?:that|this) (?=(?:stop )?line\b|conflict point\b|intersection\b)", re.IGNORECASE)
_STARTING_STATE = re.compile(
    rf"{BEGINS}([^.:;]+): (?:that|this) is the (?:starting|initial|first|opening) (?:state|situation|position"
    rf"|condition) of ({_ONE})\b",
    re.IGNORECASE,
)
_THEIR_TIMES = re.compile(
    rf"\btheir (?:times(?: to arrival)?|distances) are ({AMOUNT}) \(([\w-]+), to ({_PLACE})\) and ({AMOUNT}) "
    rf"\(([\w-]+), to ({_PLACE})\)",
    re.IGNORECASE,
)
_BEGIN_WITH_WHEN = re.compile(
    rf"{BEGINS}To begin with, (?=when [^.]*\d[^.]*, [^.]* (?:brakes|accelerates|stops"
    rf"|begins|starts)\b)",
    re.IGNORECASE,
)
_PLANNERS_CAR = re.compile(r"\bthe (?:planner|stack|policy|AI)['\u2019]s (car|vehicle)\b", re.IGNORECASE)


def we_for_you(text: str) -> str:
    """Return the text with "we" in place of "you" where that is who drives the ego, and nobody else speaks.

    >>> we_for_you("You are in the car under test. You turn left.")
    'we  are in the car under test. we  turn left.'
    """
    if not _YOU_ARE_IT.search(text) or _WE.search(text):
        return text
    text = _AFTER.sub(lambda found: (found[1] + "us").ljust(len(found.group())), text)
    text = _YOU.sub(lambda found: "we".ljust(len(found.group())), text)
    return _YOUR.sub(lambda found: ("ours" if found[1] else "our").ljust(len(found.group())), text)


_WHO_IS_TESTED = re.compile(
    rf"{BEGINS}(?:Who|What|Which (?:car|vehicle)) is (?:under test|the ego|being tested)\? (The|An?) ([\w-]+)(?=[,.;])",
    re.IGNORECASE,
)
_WHO_IS_OTHER = re.compile(
    rf"{BEGINS}(?:Who|What) is (?:the )?(?:opponent|other(?: one| car| vehicle)?|hero|adversary|NPC|POV)\? (?=An? )",
    re.IGNORECASE,
)
_WHERE_IS_IT = re.compile(
    rf"{BEGINS}Where (?:is|does) (the [\w-]+) (?:at first|at the start|initially|to begin with|start|begin)\? "
    r"(?:It|He|She) (?:is|starts|begins) ",
    re.IGNORECASE,
)
_WHERE_AT_FIRST = re.compile(
    rf"{BEGINS}Where (?:are|is|do|does) [^.?!\d]{{0,30}}?(?:at first|at the start|initially|to begin with|start"
    rf"|begin)\? "
    r"(?!It\b|He\b|She\b)",
    re.IGNORECASE,
)
_WHEN_DOES = re.compile(rf"{BEGINS}When (?:does|do|will|is) [^.?!\d]{{1,40}}\? (?:When |With )", re.IGNORECASE)
_WHAT_THEN = re.compile(
    rf"{BEGINS}(?:And )?What (?:then|next|happens (?:then|next)|does (?:it|he|she|the [\w-]+) do(?: then| next)?)\? ",
    re.IGNORECASE,
)
_UNTIL_BOTH = re.compile(
    rf"{BEGINS}(?:Let|Have) (?:both|them|the two|both (?:cars|vehicles)) (?:drive|run|go|roll)(?: on)? until ",
    re.IGNORECASE,
)
_THAT_IS_TRIGGER = re.compile(
    rf"{BEGINS}((?:[^.:;?\d]|\.\d)*\d(?:[^.:;?]|\.\d)*?)(?:: that(?:['\u2019]s| is) (?:the|my|our) (?:trigger|cue"
    rf"|signal)|, and (?:that"
    rf"|this) is the trigger)(?=\.)",
    re.IGNORECASE,
)
# "before ego (from the driveway, left turn) begins to turn"
_BRACKET_BETWEEN = re.compile(
    rf"\b((?:before|after|once|until|when) {_ONE}) (\([^()\d]*\)) ((?:begins|starts|gets|passes|reaches|has|turns"
    rf"|goes)\b[^.;,()]*)",
    re.IGNORECASE,
)
_AND_ITSELF = re.compile(
    rf" with ({_NAMED} {AMOUNT} (?:from|before|short of) {_PLACE}) and itself (?={AMOUNT})", re.IGNORECASE
)
_HAVE_PRIORITY = re.compile(rf"\blets? (?:it|us|them|{_ONE}) have (?:the |its )?{PRIORITY}\b", re.IGNORECASE)
_THROUGH_TRAFFIC = re.compile(r", through traffic(?=[,.;])", re.IGNORECASE)
_GO_RIGHT_AT = re.compile(
    r"\bgo(es|ing|)? (left|right) at the (?:end|bottom|mouth)(?: of (?:it|the driveway))?",
    re.IGNORECASE,
)
_TURN_AHEAD = re.compile(r"(?<=turn) (\(\w+\) )?ahead(?=[.,;])", re.IGNORECASE)
_BRAKING_WITH = re.compile(rf"{BEGINS}(?:Its )?Braking (?:starts|begins|sets in) with ", re.IGNORECASE)
_UPON = re.compile(rf"{BEGINS}Upon (?={_ONE} TT[AC] )", re.IGNORECASE)
_VERSUS = re.compile(rf"(?<=\)) (?:vs|versus)\.? (?={_ONE}\b)", re.IGNORECASE)
_CONDITION = re.compile(r"^([ \t]*(?:[-*] )?)(?:cond|trig)(?: ?= ?|: )", re.IGNORECASE | re.MULTILINE)
_ACT = re.compile(r"^([ \t]*(?:[-*] )?)(?:act|action) ?= ?", re.IGNORECASE | re.MULTILINE)
_SEQUENCE = re.compile(rf"({_ONE}) SEQ(?:UENCE)?(?=:)", re.IGNORECASE)
_IS_PLACED = re.compile(rf"{BEGINS}(?:Stage|Put|Place|Position|Spawn) ({_NAMED}) (?={AMOUNT}|on |in )", re.IGNORECASE)
# "For the re-creation let ego start 7.5 s from it", "Please replicate in sim with our car as the ego"
_FOR_THE_SAKE = re.compile(
    r"\bFor the (?:re-?creation|test|simulation|replay|run|reconstruction),? let (?=[\w ]+ (?:start|begin)\b)"
)
_REPLICATE = re.compile(
    rf"{BEGINS}(?:Please )?(?:replicate|recreate|re-create|reproduce|rebuild|build|replay)(?: (?:this|it|that))? in "
    rf"(?:the )?"
    r"(?:sim|simulation|simulator)(?: with (our (?:car|vehicle) )as the ego, (?=starting ))?",
    re.IGNORECASE,
)

_WHAT_DOES_IT = re.compile(
    rf"{BEGINS}What does (the (?:hero|ego)(?: vehicle)?) do\? It (?=drives|goes|is|travels|comes|wants|follows)",
    re.IGNORECASE,
)


# In this order: what one rule leaves, the next may read.
BRIEFING_PHRASES: Rules = (
    (_WHO_IS_TESTED, r"\1 \2 is under test"),
    (_WHO_IS_OTHER, "There is "),
    (_WHERE_IS_IT, r"At first \1 is "),
    (_WHERE_AT_FIRST, "At first: "),
    (_WHEN_DOES, "When "),
    (_WHAT_DOES_IT, r"\1 "),
    (_WHAT_THEN, ""),
    (_UNTIL_BOTH, "When "),
    (_THAT_IS_TRIGGER, r"When \1"),
    (_BRACKET_BETWEEN, r"\1 \3 \2"),
    (_AND_ITSELF, r" when \1 and it "),
    (_HAVE_PRIORITY, "yields"),
    (_THROUGH_TRAFFIC, ", straight on"),
    (_GO_RIGHT_AT, r"turn\1 \2"),
    (_TURN_AHEAD, r" \1"),
    (_BRAKING_WITH, "It brakes when "),
    (_UPON, "When "),
    (_VERSUS, "; "),
    (_CONDITION, r"\1when "),
    (_ACT, r"\1then "),
    (_SEQUENCE, r"\1"),
    (_IS_PLACED, r"\1 is "),
    (_FOR_THE_SAKE, ""),
    (_REPLICATE, lambda found: "we are " if found[1] else ""),
    (_FINISH_IT, "It makes "),
    (_END_IT, r"\1 stops"),
    (_MAKE_IT, r"\1 is "),
    (_GIVE_CUE, r"When \1, "),
    (_LET_GO_AGAIN, "it accelerates"),
    (_HAVE_IT_PASS, lambda found: f" {found[1]}{'es' if found[1].endswith('s') else 's'} "),
    (_ASKED_OF, lambda found: f"{found[1] or found[2] or found[3]} "),
    (_ASKED_WHEN, ""),
    (_STRAY_ASKED, ""),
    (_AND_UPON_IT, r"When \1, "),
    (_PLACE_AHEAD, r"\2 from \1"),
    (_AT_THAT_LINE, "at the "),
    (_STARTING_STATE, r"Initially \2 is \1"),
    (_THEIR_TIMES, r"\2 is \1 from \3 and \5 \4 from \6"),
    (_BEGIN_WITH_WHEN, ""),
    (_PLANNERS_CAR, r"the test \1"),
)
