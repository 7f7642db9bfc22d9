"""Turns of phrase for braking and stopping, and for what it waits for: "goes on until its speed is zero".

What enters: nothing. What leaves: `HALTING_PHRASES`, patterns with what to say instead, in their order: "does not
brake until ...; then it brakes" is "When ..., it brakes", "a deceleration of 3 m/s^2 is applied to the hero" is "it
brakes at".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import AMOUNT, BEGINS, PRIORITY, Rules

_HERO = (
    r"(?:the hero(?: vehicle)?|hero|the other (?:vehicle|car)|the (?:car|vehicle|one) (?:in front|ahead)"
    r"|the (?!ego|av\b|sut\b|vut\b|conflict|stop|inter|drive|road|lane|same|test|trigger|moment|time|distance|gap|turn"
    r"|vehicle|car|brak|decel|speed)[\w-]+)"
)
_RATE = r"(?:[\d.]+ ?(?:m/s\^2|m/s\u00b2|m/s2|g|ft/s\^2)|\w+_mpss)"
_STOPPED = (
    r"(?:has (?:stopped|come to (?:a )?(?:full |complete )?(?:stop|rest|standstill|halt))|stands still|is at rest"
    r"|stands"
    r"|is stationary|is at a standstill)"
)
_WHICH_MOMENT = r"(?:at which (?:moment|point|instant|time)|whereupon|upon which|and then|when)"

_NOT_UNTIL_THEN = re.compile(
    rf"\b({_HERO}|it) does not (?:start to |begin to )?(?:brake|slow down|react|do anything) (?:until|before) "
    rf"([^;:]+?)[;,:.] "
    r"(?:but |and |it )?(?:then|at that moment|at which point|whereupon|when that is the case),? (?:it )?(?=brakes"
    r"|slows|decelerates|stops)",
    re.IGNORECASE,
)
_NOT_UNTIL_DOES = re.compile(
    rf"{BEGINS}(?:Not until|Only when|Only once) ([^,;]*?),? and (?:exactly|only|precisely|not before) then,? does "
    rf"({_HERO}|it) (begin|start)\b",
    re.IGNORECASE,
)
_GOES_UNTIL = re.compile(
    rf"\b({_HERO}|it) (?:continues|carries on(?: driving)?|keeps (?:driving|going)|keeps on(?: driving)?|drives on"
    rf"|proceeds) until ([^,;]+?), {_WHICH_MOMENT} (?:it|{_HERO}) (?!does\b)",
    re.IGNORECASE,
)
_WE_WAIT_UNTIL = re.compile(
    rf"{BEGINS}We (?:wait|let (?:things|them|the two(?: vehicles)?|both)(?: drive| run| go on| go)?) until "
    rf"([^,;]+?),? and "
    rf"then (?:we )?(?=have {_HERO}|let {_HERO}|make {_HERO}|{_HERO} is to )",
    re.IGNORECASE,
)
# "What makes the hero brake is the ego being 2 s from the line and the hero itself being 3 s from the point."
_WHAT_MAKES = re.compile(
    rf"{BEGINS}What (?:makes ({_HERO})|causes ({_HERO}) to|prompts ({_HERO}) to) (brake|accelerate) is ([^.;]*?being"
    r"(?:[^.;]|\.\d)*?)(?=[.;](?: |$))",
    re.IGNORECASE,
)
_WHERE_IT_IS = re.compile(
    rf"\buntil (?:it|he|she|the hero) {_STOPPED},? (?:at which point|when|where|and then|with) (?:it|he|she|the "
    rf"hero) (?:is|"
    r"stands|being)\b",
    re.IGNORECASE,
)
_GIVES_UP_RIGHT = re.compile(
    rf"\b(?:surrenders|gives up|forgoes|waives|cedes|relinquishes|renounces|yields up) (?:its|the) {PRIORITY}\b",
    re.IGNORECASE,
)
_LEAVES_FREE = re.compile(
    r"\b(?:leaves|keeps) (?:the conflict point|the way|the junction|the road) (?:free|clear|open) for (?:the ego|it"
    r"|us)",
    re.IGNORECASE,
)
_DOES_NOT_REACH = re.compile(
    rf",? (?:and )?does not (?:reach|enter|get to|drive onto|cross) (the conflict point) but (stops|comes to a "
    rf"(?:stop|halt)) "
    rf"({AMOUNT}) (?:before|short of) it\b",
    re.IGNORECASE,
)
_RATHER_THAN_GOING = re.compile(
    r"(?<=brakes)(?:,)? (?:rather than|instead of) (?:continuing|going on|driving on|proceeding|carrying on),?",
    re.IGNORECASE,
)
_NO_LONGER_GOES = re.compile(
    r"\bno longer (?:keeps going|continues|drives on|carries on) but (?=brakes|slows|stops)", re.IGNORECASE
)
_STOP_WHICH = re.compile(
    r"\b(stop|halt|standstill), which (?:it|he|she) (?:makes|completes|finishes|achieves|performs)\b", re.IGNORECASE
)
_BEGINS_STOP = re.compile(
    r"\bbegins (?:its|a) stop, which (?:it|he|she) (?:makes|completes|reaches|finishes|achieves)\b", re.IGNORECASE
)
_RATHER_THAN_INSISTING = re.compile(
    rf"\b(?:rather than|instead of) (?:insisting on|asserting|claiming|exercising|taking|using) (?:its|the) "
    rf"{PRIORITY},? ?",
    re.IGNORECASE,
)
_YOU_SEE = re.compile(
    rf"\byou (?:will |can |shall )?(?:see|observe|watch|find) ({_HERO}|it) (?=brake\b|stop\b|slow\b|accelerate\b)",
    re.IGNORECASE,
)
_GOES_ON_BRAKING = re.compile(
    r",? and (?:goes on|carries on|continues|keeps on|keeps at it|continues like this)(?: doing (?:so|this|that)| "
    r"braking"
    r"| to brake| with it)? (?=until (?:it|its|he|his|v|the hero|standstill|a standstill)\b)",
    re.IGNORECASE,
)
_THIS_LASTS = re.compile(
    r",? and (?:this|it|that) (?:lasts|continues|goes on|keeps (?:on )?doing (?:this|so)|persists) (?=until\b)",
    re.IGNORECASE,
)
_NO_LONGER_MOVES = re.compile(
    r"\buntil (?:it|he|she|the hero) (?:is no longer (?:in motion|moving|rolling)|no longer moves)\b", re.IGNORECASE
)
_SPEED_NONE = re.compile(
    r"\buntil (?:its|the|his) (?:speed|velocity) (?:has reached|reaches|has dropped to|has fallen to|is down to) "
    r"(?:0 ?(?:m/s|km/h|mph)?|zero)(?![\w.])",
    re.IGNORECASE,
)
_IS_APPLIED = re.compile(
    rf"\ba (?:constant |steady )?deceleration of ({_RATE}) is (?:applied to|imposed on|commanded of|given to) "
    rf"({_HERO}|it)"
    r"(?: and (?:maintained|held|kept up|sustained))?",
    re.IGNORECASE,
)
_IS_THE_CUE = re.compile(
    rf"{BEGINS}(?:A|The) ((?:[^.;]|\.\d)*?) is (?:the|its) (?:cue|signal|trigger|sign) for ({_HERO}|it) to brake, "
    rf"which it "
    r"does (?=with|at)",
    re.IGNORECASE,
)
_HAVING_IS_CUE = re.compile(
    rf"{BEGINS}Having ((?:[^.;]|\.\d)*?) is (?:the|its) (?:cue|signal|trigger|sign) for ({_HERO}) to brake, which "
    rf"it does "
    r"(?=with|at)",
    re.IGNORECASE,
)
_LETTING_UP = re.compile(
    r",?(?: and)? (?:without|not) (?:letting up|easing off|letting off|coming off (?:the brakes?|it)) (?=until\b)",
    re.IGNORECASE,
)
_ASKED_WHEN = re.compile(
    rf"{BEGINS}When does ({_HERO}) (brake|accelerate|stop)\? (When|At|Once|As soon as|With) ((?:[^.?]|\.\d)*?)\. "
    rf"How(?: hard)?\? ",
    re.IGNORECASE,
)
_HOW_FAR = re.compile(
    rf"{BEGINS}(?:How far (?:away|off|apart)|Where) are (?:they|the two)[^?]{{0,40}}?when ({_HERO}) (brakes"
    rf"|accelerates)\?",
    re.IGNORECASE,
)
_HOLDS_COMMAND = re.compile(
    r",? and (?:hold|keep up|maintain) (?:the|this|that) (?:command|deceleration|braking) (?=until\b)", re.IGNORECASE
)
_BRAKING_ENDS = re.compile(
    rf",? and (?:the|its) (?:braking|deceleration) ends with (?:{_HERO}|it) (?:at rest|stationary|stopped|standing)",
    re.IGNORECASE,
)
_START_OF_BRAKING = re.compile(
    rf"{BEGINS}(?:Start|Onset|Beginning) of (?:the )?hero['\u2019]s (braking|deceleration|acceleration)(?: is| at)?:",
    re.IGNORECASE,
)

_STILL = r"(?:stationary|motionless|stopped|at rest|at a standstill|immobile)"
_AT_LINE = r"(?:right )?at (?:the |its )?stop line"
_FROM_STANDSTILL = re.compile(
    rf"\b(?:starts|begins) from (?:a )?(?:standstill|rest) ({_AT_LINE})(?=[.;])", re.IGNORECASE
)
_IS_STILL = re.compile(rf"\b(?:is|was) ((?:initially |at first )?){_STILL} (?={_AT_LINE})", re.IGNORECASE)
_STILL_AT_FIRST = re.compile(
    rf"\b({_HERO}),? (?:initially|at first) (?:standing|{_STILL}) ({_AT_LINE})(?:,|(?= (?:accelerates|sets|starts"
    rf"|moves|goes)))",
    re.IGNORECASE,
)
_STILL_THERE = re.compile(rf"\b({_HERO}) (?:initially )?{_STILL} ({_AT_LINE})", re.IGNORECASE)
_ZERO_SPEED_THERE = re.compile(
    rf"\bis ({_AT_LINE}) (?:with|at) (?:zero speed|(?:a )?speed (?:of )?zero|no speed)\b", re.IGNORECASE
)
_SPEED_ZERO_FIRST = re.compile(
    rf"\b({_HERO})['\u2019]s speed is (?:initially )?zero(?: at first| initially| in the beginning)?,? and it is "
    rf"({_AT_LINE})",
    re.IGNORECASE,
)
_STOPS_DRIVING = re.compile(
    r"\bstops (?:driving on|driving|going on|going|rolling|travelling)\b(?= |[.,:;])", re.IGNORECASE
)
_THEN_GOES = (
    r"(?:[.;,] (?:and )?(?:then (?:it|the hero)|it then|the hero then|at (?:that|which) (?:moment|point|time"
    r"|instant),? (?:it|the "
    r"hero)|whereupon it|then))"
)
# "The hero waits at the stop line until the ego is 40 m from the conflict point. Then it sets off"
_WAITS_UNTIL_NEAR = re.compile(
    rf"\b({_HERO}|it) (?:just |simply )?(?:waits|stands|stays|remains(?: stationary| standing)?|is held|sits|does "
    rf"not move|is kept)"
    rf"(?: standing| stationary)? ((?:at|from) (?:the |its )?stop line) until (the ego (?:is|has|gets"
    rf"|comes)(?:[^.,;]|\.\d)*)"
    rf"{_THEN_GOES} ",
    re.IGNORECASE,
)
_UNTIL_NEAR_STANDS = re.compile(
    rf"{BEGINS}Until (the ego (?:is|has|gets|comes)(?:[^.,;]|\.\d)*), ({_HERO}) (?:waits|stands|stays|sits) "
    rf"({_AT_LINE})"
    rf"{_THEN_GOES} ",
    re.IGNORECASE,
)
_HOLD_UNTIL_NEAR = re.compile(
    rf"{BEGINS}(?:Hold|Keep) ({_HERO})(?: standing| stationary| waiting)? ({_AT_LINE}) until (the ego (?:is|has"
    rf"|gets|comes)"
    r"(?:[^.,;]|\.\d)*)[.;,] (?:Then release it,? so that it|At that moment,? (?:the hero|it)|Then (?:it|the hero)) ",
    re.IGNORECASE,
)
_HALTED_THERE = re.compile(
    rf"\b(?:is|has|was) (?:halted|parked|stopped|found standing|held) (?={_AT_LINE})", re.IGNORECASE
)
_SPEED_FALLS = re.compile(
    rf"\b(?:the speed of ({_HERO}|it)|({_HERO})['\u2019]s speed|(?<=: )its speed) (?:falls|drops|is reduced"
    rf"|decreases|goes down|is "
    r"brought down|is lowered) to (?=[\d.]+ |\w+_mps)",
    re.IGNORECASE,
)
_SPEED_DOWN = re.compile(
    r"\b(?:performs a speed reduction|brings its speed down|takes its speed down|drops|reduces|bring its speed "
    r"down) to "
    r"(?=[\d.]+ ?(?:m/s|km/h|mph)|\w+_mps)",
    re.IGNORECASE,
)
_REDUCTION_BEGINS = re.compile(
    rf"\ba (?:reduction of ({_HERO})['\u2019]s speed|slowdown) to ([\d.]+ ?(?:m/s|km/h|mph)|\w+_mps) (?:begins"
    rf"|starts|sets in|is "
    rf"carried out by ({_HERO}))",
    re.IGNORECASE,
)
_UNTIL_AT_SPEED = re.compile(
    r",? (?:and (?:it )?(?:does so|goes on|continues(?: to do so| doing so)?) )?until (?:it is (?:down to"
    r"|travelling at|driving at"
    r"|doing|at)|its speed is(?: down to)?) (?=[\d.]+ ?(?:m/s|km/h|mph)|\w+_mps)",
    re.IGNORECASE,
)
_UNTIL_REACHED = re.compile(
    r"(?:\. It continues to do so|,? and (?:does so|goes on|continues)|,)? until ([\d.]+ ?(?:m/s|km/h|mph)|\w+_mps) "
    r"(?:is|are) "
    r"reached",
    re.IGNORECASE,
)
_AFTER_COMING_TO_REST = re.compile(
    rf"{BEGINS}({AMOUNT}) after (?:coming to (?:rest|a stop)|stopping|it has (?:stopped|come to rest)|having "
    rf"stopped|the stop), "
    r"(?=it |the hero )",
    re.IGNORECASE,
)
_UNTIL_ELAPSED = re.compile(
    rf"\b(remains|stays|stands|waits)(?: there)? until ({AMOUNT}) have (?:elapsed|passed|gone by),? (?:at which "
    rf"point|and then"
    r"|whereupon|when) ",
    re.IGNORECASE,
)
_WHEN_ELAPSED = re.compile(
    rf"\b(?:when|once|after) ({AMOUNT}) have (?:passed|elapsed|gone by), (?=it |the hero )", re.IGNORECASE
)
_SPENDS = re.compile(rf"\bspends ({AMOUNT}) (?:standing|waiting|at rest|at a standstill)(?: there)?", re.IGNORECASE)
_SHORT_STOP = re.compile(
    rf"\bmakes? an? ([\d.]+|[a-z]+)[ -](s|seconds?) stop ({AMOUNT} (?:before|short of|from) (?:the conflict point"
    rf"|the stop line))",
    re.IGNORECASE,
)
_OF_STANDSTILL = re.compile(r"\b(?:a|an) ([\d.]+|[a-z]+)[ -](s|seconds?) (standstill|stop|pause|halt)\b", re.IGNORECASE)
_BEGINNING_AT = re.compile(
    rf", (?:beginning|starting)(?: to (?:do so|brake|slow(?: down)?))? ({AMOUNT} (?:before|from|short of) (?:the "
    rf"conflict point"
    r"|the stop line|that point|that line|it)),? (?:at the same time as|at the moment when|when|while|as) (?=the )",
    re.IGNORECASE,
)
_HAPPENS_TO_BE = re.compile(
    r"\bhappens to be (?=[\d.]+ |\w+_(?:m|s|ft)\b|at |only |[a-z]+ (?:m|s)\w*\b)", re.IGNORECASE
)
_ON_ACCELERATOR = re.compile(
    r"\b(?:goes|gets|steps) (?:back )?(?:on|onto) the (?:accelerator|gas|throttle)(?: pedal| again)?\b", re.IGNORECASE
)
_STOP_BY_BRAKING = re.compile(
    r"\bperforms an? (?:full |complete )?stop,? (?:made |reached )?by braking,?", re.IGNORECASE
)


def _stands_then(found: re.Match[str]) -> str:
    """Return "waits at the line until the ego is near. Then it" as what is so at first and a moment."""
    hero, place, near = found.groups()
    place = place.replace("from", "at")
    hero = f"{hero[0].upper()}{hero[1:]}" if found.group()[0].isupper() else hero
    return f"{hero} stands {place} at first. When {near}, {'the hero' if hero.lower() == 'it' else hero.lower()} "


def _then_stood(found: re.Match[str]) -> str:
    near, hero, place = found.groups()
    return f"{hero[0].upper()}{hero[1:]} stands {place} at first. When {near}, {hero} "


def _slows_to(found: re.Match[str]) -> str:
    return f"{found.group(1) or found.group(2) or 'it'} slows down to "


def _reduced(found: re.Match[str]) -> str:
    return f"{found.group(1) or found.group(3)} slows down to {found.group(2)}"


def _when_does(found: re.Match[str]) -> str:
    """Return "When does the hero brake? At a gap of 15 m. How? At 3 m/s^2" as one sentence."""
    hero, deed, when, told = found.groups()
    return f"{when} {told}, {hero} {deed}s "


def _with_being(found: re.Match[str]) -> str:
    hero = next(each for each in found.groups()[:3] if each is not None)
    return f"With {found.group(5)}, {hero} {found.group(4)}s"


# In this order: what one rule leaves, the next may read.
HALTING_PHRASES: Rules = (
    (_NOT_UNTIL_THEN, r"When \2, \1 "),
    (_NOT_UNTIL_DOES, r"When \1, \2 \3s"),
    (_GOES_UNTIL, r"When \2, \1 "),
    (_WE_WAIT_UNTIL, r"When \1, "),
    (_WHAT_MAKES, _with_being),
    (_WHERE_IT_IS, "and stops"),
    (_GIVES_UP_RIGHT, "yields"),
    (_LEAVES_FREE, "yields"),
    (_DOES_NOT_REACH, r" and \2 \3 before \1"),
    (_RATHER_THAN_GOING, ""),
    (_NO_LONGER_GOES, ""),
    (_BEGINS_STOP, "brakes to a stop"),
    (_STOP_WHICH, r"\1"),
    (_RATHER_THAN_INSISTING, ""),
    (_YOU_SEE, r"let \1 "),
    (_GOES_ON_BRAKING, " "),
    (_THIS_LASTS, " "),
    (_NO_LONGER_MOVES, "until it stands still"),
    (_SPEED_NONE, "until it stands still"),
    (_IS_APPLIED, r"\2 brakes at \1"),
    (_IS_THE_CUE, r"At a \1, \2 brakes "),
    (_HAVING_IS_CUE, r"With \1, \2 brakes "),
    (_LETTING_UP, " "),
    (_ASKED_WHEN, _when_does),
    (_HOW_FAR, r"\1 \2 when"),
    (_HOLDS_COMMAND, " "),
    (_BRAKING_ENDS, " until it stands still"),
    (_START_OF_BRAKING, "Trigger:"),
    (_FROM_STANDSTILL, r"stands \1 at first"),
    (_IS_STILL, r"stands \1"),
    (_STILL_AT_FIRST, r"\1, which stands \2 at first,"),
    (_STILL_THERE, r"\1 stands \2"),
    (_ZERO_SPEED_THERE, r"stands \1"),
    (_SPEED_ZERO_FIRST, r"\1 stands \2 at first"),
    (_STOPS_DRIVING, "stops"),
    (_WAITS_UNTIL_NEAR, _stands_then),
    (_UNTIL_NEAR_STANDS, _then_stood),
    (_HOLD_UNTIL_NEAR, _stands_then),
    (_HALTED_THERE, "stands "),
    (_SPEED_FALLS, _slows_to),
    (_SPEED_DOWN, "slows down to "),
    (_REDUCTION_BEGINS, _reduced),
    (_UNTIL_AT_SPEED, " to "),
    (_UNTIL_REACHED, r" to \1"),
    (_AFTER_COMING_TO_REST, r"After waiting \1, "),
    (_UNTIL_ELAPSED, r"waits \2, then "),
    (_WHEN_ELAPSED, r"after waiting \1, "),
    (_SPENDS, r"stands there for \1"),
    (_SHORT_STOP, r"stops \3 and waits \1 \2 there"),
    (_OF_STANDSTILL, r"a \3 of \1 \2"),
    (_BEGINNING_AT, r"; it begins to brake \1 when "),
    (_HAPPENS_TO_BE, "is "),
    (_ON_ACCELERATOR, "accelerates"),
    (_STOP_BY_BRAKING, "brakes to a stop"),
)
