"""Turns of phrase that deal out amounts to both vehicles at once: "with 5 m left for the ego to the line and 18 m for".

What enters: nothing. What leaves: `ALLOTTING_PHRASES`, patterns with what to say instead, in their order: "25 m
separate the ego, and 36 m the van, from the conflict point" is "the ego is 25 m and the van 36 m from the conflict
point".
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import BEGINS, Rules

# An amount that is no bound: what stands before "at least 40 m" must not be left behind
_EXACT = "".join(
    rf"(?<!{word} )"
    for word in ("least", "most", "than", "under", "over", "below", "above", "within", "about", "around", "to")
)
_AMOUNT = _EXACT + (
    r"(?:(?:[\d.]+ ?|an? (?:mere )?|(?:only )?[a-z-]+ (?:and (?:a half|a quarter) )?)"
    r"(?:m|met(?:re|er)s?|ft|feet|foot|yd|yards?|s|seconds?|ms|milliseconds)\b|\w+_(?:m|s|ft|yd)\b)"
)
_WHO = (
    r"(?:(?:the|our|my|an?) (?!stop|conflict|inter|time)[\w-]+(?: (?!stop|conflict|remain|still|is|has|will|would)"
    r"[\w-]+)?(?: under test)?|it|us|him|her|[A-Z]{2,}|(?:[Ee]go|[Hh]ero))"
)
_PLACE = r"(?:(?:the|its|that|his|her) (?:stop line|line|conflict point|point|intersection|junction)|it)"
_LEFT = r"(?:(?:is|are) )?(?:left|remain(?:s|ing)?|to go)"
_TO = (
    r"(?:to(?: reach)?|until(?: (?:it (?:is at|reaches|arrives at)|arrival at|reaching))?|up to|with respect to"
    r"|from|before|short of)"
)
_AND = r"(?:,? and|,? while|, with|,)"

# "when 25 m separate the ego, and 36 m the van, from the conflict point"
_SEPARATE = re.compile(
    rf"({_AMOUNT}) separates? ({_WHO}),?{_AND} ({_AMOUNT}) (?:separates? )?({_WHO}),? from ({_PLACE})", re.IGNORECASE
)
_SEPARATE_FIRST = re.compile(
    rf"({_AMOUNT}) separates? ({_WHO}) from ({_PLACE}),?{_AND} ({_AMOUNT}) ({_WHO})(?= *,)", re.IGNORECASE
)
_SEPARATE_EACH = re.compile(
    rf"({_AMOUNT}) separates? ({_WHO}) from ({_PLACE}),?{_AND} ({_AMOUNT}) ({_WHO}) from (?={_PLACE})", re.IGNORECASE
)
# "separate it from the line and 60 ft separate the ego from that point"
_SEPARATE_ONE = re.compile(rf"({_AMOUNT}) (?:still )?separates? ({_WHO}) from (?={_PLACE})", re.IGNORECASE)
# "with 5 m left for the ego to the stop line and 18 m for the van to the conflict point"
_LEFT_FOR_EACH = re.compile(
    rf"(?P<with>\bwith |\bwhen |\bonce |\bas soon as )(?:there (?:is|are) )?(?P<first>{_AMOUNT})(?: {_LEFT})? "
    rf"(?:for|to) "
    rf"(?P<who>{_WHO}) {_TO} "
    rf"(?P<place>{_PLACE}),?{_AND} (?P<second>{_AMOUNT})(?: {_LEFT})? (?:for|to) (?P<other>{_WHO}) {_TO} "
    rf"(?P<there>{_PLACE})",
    re.IGNORECASE,
)
_LEFT_FOR_BOTH = re.compile(
    rf"(?P<with>\bwith |\bwhen |\bonce |\bas soon as )(?:to (?P<to>{_WHO}) )?(?:there )?(?:{_LEFT} "
    rf")?(?P<first>{_AMOUNT})"
    rf"(?: {_LEFT})?(?: (?:for|to) (?P<who>{_WHO}))?,?{_AND} (?:to (?P<too>{_WHO}) )?(?P<second>{_AMOUNT})(?: {_LEFT})?"
    rf"(?: (?:for|to) (?P<other>{_WHO}))?,? {_TO} (?P<place>{_PLACE})",
    re.IGNORECASE,
)
# "At 3 s from the stop line for the ego and 4 s from the conflict point for the van,"
_AT_FOR = re.compile(
    rf"\b(?:at|given|from) ({_AMOUNT}) (?:from|to|before|short of) ({_PLACE}) (?:for|in the case of) ({_WHO}),?{_AND} "
    rf"({_AMOUNT}) (?:from|to|before|short of) ({_PLACE}) (?:for|in the case of) ({_WHO})(?= *[,:.])",
    re.IGNORECASE,
)
# "At a time to arrival of 2 s (ego, stop line) and 3.5 s (hero, conflict point),"
_IN_BRACKETS = re.compile(
    rf"\b(?:at|with) (?:an? |times |distances? )?[a-z -]*?of ({_AMOUNT}) \(({_WHO}), (?:the |its )?(stop line|conflict "
    rf"point)\),?{_AND} ({_AMOUNT}) \(({_WHO}), (?:the |its )?(stop line|conflict point)\)",
    re.IGNORECASE,
)
_WHO_IN_BRACKETS = re.compile(
    rf"\b(?:at|with) (?:an? |times |distances? )?[a-z -]*?of ({_AMOUNT}) (?:from|to|before) ({_PLACE}) \(([\w ]+)\),?"
    rf"{_AND} ({_AMOUNT}) (?:from|to|before) ({_PLACE}) \(([\w ]+)\)",
    re.IGNORECASE,
)
_DROPPED_TO = re.compile(
    rf"\bthe (?:times|distances)(?: to arrival| remaining)? (?:have (?:dropped|fallen|shrunk|decreased) to|are|become) "
    rf"({_AMOUNT}) \(({_WHO}), (?:the )?(stop line|conflict point)\),?{_AND} ({_AMOUNT}) \(({_WHO}), (?:the )?(stop "
    rf"line"
    rf"|conflict point)\)",
    re.IGNORECASE,
)
# "With a_s and b_s to go to the conflict point for the ego and the hero respectively,"
_FOR_RESPECTIVELY = re.compile(
    rf"\b(with|at) ({_AMOUNT}) and ({_AMOUNT})(?: {_LEFT})? (?:to|from|until|before) ({_PLACE}) for ({_WHO}) and "
    rf"({_WHO})"
    r",? respectively",
    re.IGNORECASE,
)
# "begins at ego and left-turner distances of 33 m and 20 m to the conflict point, respectively,"
_DISTANCES_OF = re.compile(
    rf"\bat ((?:the )?[\w-]+) and ((?:the )?[\w-]+) (?:distances|times) of ({_AMOUNT}) and ({_AMOUNT}) (?:to|from) "
    rf"({_PLACE}),? respectively",
    re.IGNORECASE,
)
# "Once 40 m remain between the westbound ego, which drives straight on, and the conflict point,"
_REMAIN_BETWEEN = re.compile(
    rf"\b(?:only )?({_AMOUNT})(?: still)? (?:remains?|(?:is|are) left|lies?) between (the [\w-]+(?: [\w-]+)?)(, "
    rf"(?:which|who) [^,]*,)? "
    rf"and ({_PLACE})\b(?!,? and {_AMOUNT} between)",
    re.IGNORECASE,
)
# "two seconds before it would reach the stop line", "3 s before our car would be at the line"
_BEFORE_IT_WOULD_WHEN = re.compile(
    rf"(?:(?<=[.!?]\s)|^)({_AMOUNT}) before ({_WHO}) (?:would|will|is due to)(?: otherwise)? (?:reach|be at|arrive at"
    rf"|get to|come to) ({_PLACE}),? (?:and )?(?:when|while|as) ",
    re.IGNORECASE,
)
_BEFORE_IT_WOULD_BE = re.compile(
    rf"{BEGINS}({_AMOUNT}) before it would (?:reach|be at|arrive at|get to|come to) ({_PLACE}), (?=the |an? |our )",
    re.IGNORECASE,
)
_BEFORE_IT_WOULD = re.compile(
    rf"\b({_AMOUNT}) before (?!it )({_WHO}) (?:would|will|is due to)(?: otherwise)? (?:reach|be at|arrive at|get to"
    rf"|come to) "
    rf"({_PLACE})",
    re.IGNORECASE,
)
# "Four seconds: that is what the ego, driving west, has left until the conflict point."
_THAT_IS_LEFT = re.compile(
    rf"(?:(?<=[.!?]\s)|^)({_AMOUNT}): (?:that|this) is (?:what|how far|all) ({_WHO}(?: (?:in|on) the \w+)?)(, "
    rf"[^.]*?,)? (?:has (?:left )?|is )"
    rf"(?:left )?(?:until|to|from) ({_PLACE})",
    re.IGNORECASE,
)
# "In terms of time to the stop line, they begin at 8 s (ego) and 4 s (hero)"
_IN_TERMS_OF = re.compile(
    rf"\bIn terms of (?:time|distance) to ({_PLACE}), (?:they|both|the two) (begin|start|are) at ({_AMOUNT}) "
    rf"\(({_WHO})\) "
    rf"and ({_AMOUNT}) \(({_WHO})\)",
    re.IGNORECASE,
)
# "when 3 s is the time the ego still needs to the conflict point and 2 s the time the hero still needs to the line"
_TIME_NEEDED = re.compile(
    rf"({_AMOUNT}) (?:is )?the (?:time|distance) (?:that )?({_WHO}) (?:still )?(?:needs|has(?: left)?) to ({_PLACE})",
    re.IGNORECASE,
)
_NEEDS_YET = re.compile(rf"\b(needs?) (?:yet|still) ({_AMOUNT}) to ({_PLACE})", re.IGNORECASE)

# "30 m from the conflict point, when the ego is 12 m from the line, the hero brakes"
_MY_PLACE_FIRST = re.compile(
    rf"{BEGINS}({_AMOUNT}) (?:from|before|short of|ahead of) ({_PLACE}), (?:when|while|as) ((?:the|our) "
    rf"(?!hero)[\w-]+(?: "
    rf"vehicle)?) is ({_AMOUNT}) (?:from|before|short of) ({_PLACE}), (the (?!ego)[\w-]+(?: vehicle)?|it) (?=brakes"
    rf"|accelerates"
    r"|begins|starts|slows|decelerates)",
    re.IGNORECASE,
)
# "The hero brakes at 30 m from the conflict point, at which time the ego is 12 m from the line, and stops"
_BRAKES_AT = re.compile(
    rf"\b(the (?!ego)[\w-]+(?: vehicle)?) (brakes|accelerates) (?:at )?({_AMOUNT}) (?:from|before|ahead of|short "
    rf"of) ({_PLACE}), "
    rf"(?:at which (?:time|moment|point)|when|while|with) ((?:the|our) (?!hero)[\w-]+(?: vehicle)?) (?:is |being "
    rf")?({_AMOUNT}) "
    rf"(?:from|before|ahead of|short of) ({_PLACE}), and (?=stops|passes|comes)",
    re.IGNORECASE,
)
_ARRIVAL_TRIGGERS = re.compile(
    rf"{BEGINS}The arrival of ({_WHO}) at ({_AMOUNT}) (?:from|before|short of) ({_PLACE}), with ({_WHO}) (?:being "
    rf")?at ({_AMOUNT}) "
    rf"(?:from|before|short of) ({_PLACE}),? (?:triggers|prompts|causes) (?:the [\w-]+)(?:, which|,? to)? ",
    re.IGNORECASE,
)
_FOR_EACH_FIRST = re.compile(
    rf"{BEGINS}({_AMOUNT}) (?:from|to|before|short of) ({_PLACE}) for ({_WHO}),?{_AND} ({_AMOUNT}) (?:from|to"
    rf"|before|short of) "
    rf"({_PLACE}) for ({_WHO}): (?:this|that) is when ",
    re.IGNORECASE,
)
# "The ego gets to a point 12 m from the line; this is when the hero brakes"
_THIS_IS_WHEN = re.compile(
    rf"{BEGINS}((?:The|Our|We|I)\b(?:[^.;:]|\.\d)*?{_AMOUNT}(?:[^.;:]|\.\d)*?)[;:] (?:this|that) is (?:when|the "
    rf"moment when"
    r"|the instant when) ",
)
_ON_ITS_WAY = re.compile(
    rf"\b({_WHO}), (?:on its way|on the way|coming up|driving up|heading|rolling) (?:to|towards?) (the (?:stop line"
    rf"|conflict "
    rf"point)), (is|has)((?: only)? {_AMOUNT})( left)? (?:from|to) (?:it|that)(?=[,.;]| and)",
    re.IGNORECASE,
)
_CONDITION_FOR = re.compile(
    rf"{BEGINS}The (?:condition|cue|trigger|signal) for (the (?!ego)[\w-]+(?: vehicle)?) to (brake|accelerate) is "
    rf"(that )?"
    r"((?:[^.;]|\.\d)*?)(?=[.;](?: |$))",
    re.IGNORECASE,
)
_INSTANT_T = re.compile(r"\b(instant|moment|time) t[01]? (?=at which|when)", re.IGNORECASE)
_WHAT_IT_HAS_LEFT = re.compile(rf"({_AMOUNT}) (?:is |are )?what ({_WHO}) has left to ({_PLACE})", re.IGNORECASE)
_DRIVES_UNTIL_IT = re.compile(
    rf"{BEGINS}({_WHO}) (?:drives on|continues|keeps going|carries on|proceeds) until it is ({_AMOUNT} (?:from"
    rf"|before|short of) "
    rf"{_PLACE}), (?:at which (?:point|moment)|whereupon|when) (?=the )",
    re.IGNORECASE,
)
_MORE_TO_TRAVEL = re.compile(
    rf"\bhas (?:(?:another |a further )({_AMOUNT})|({_AMOUNT}) (?:more|to travel|to drive|left))(?: to (?:travel"
    rf"|drive))? "
    rf"(?:before|until|to reach) (?:it (?:gets to|reaches|arrives at) )?(?={_PLACE})",
    re.IGNORECASE,
)
_WOULD_BE_LATER = re.compile(
    rf"\b(?:would|will|could|can|is going to|is to|is due to) (?:then )?(?:be at|reach|arrive at|get to|come to) "
    rf"({_PLACE}) "
    rf"(?:in )?({_AMOUNT})(?: later| from now)?(?=[,.;]| and)",
    re.IGNORECASE,
)
_OF_DRIVING = re.compile(
    rf"({_AMOUNT}) of (?:driving|travel|travelling|motion|approach|drive)(?: time)?(?: away)? (?=from|before)",
    re.IGNORECASE,
)
_SECOND_DRIVE = re.compile(
    r"\ban? ([\d.]+|[a-z]+)[ -](second|metre|meter|m|s)s? (?:drive|ride) (?:away )?(?=from)", re.IGNORECASE
)
_MARK = re.compile(r"\bthe ([\d.]+|[a-z]+)[ -](second|metre|meter|m|s)s? mark (?=before|from)", re.IGNORECASE)
_EXPRESSED_IN = re.compile(
    r", (?:in|as an?|expressed (?:in|as)|measured (?:in|as)|in terms of) (?:a )?(?:time(?:s)?(?: to arrival)?"
    r"|seconds|TTA|travel "
    r"time|distance|metres),",
    re.IGNORECASE,
)
_COUNTDOWN = re.compile(
    r"['\u2019]s (?:countdown|estimated time(?: of arrival)?|remaining travel time) (?=to|at|for)", re.IGNORECASE
)
_STANDS_AT = re.compile(
    rf"\b((?:countdown|time|TTA|distance|gap|headway|clock|display)\b[^.,;]{{0,60}}?) (?:stands at|reads|shows) "
    rf"(?={_AMOUNT})",
    re.IGNORECASE,
)
_ON_THE_CLOCK = re.compile(
    rf"\b(with|at) ({_AMOUNT}) on the clock for ({_WHO}) to (?:reach|get to) ({_PLACE}) and ({_AMOUNT}) (?:on the "
    rf"clock )?for "
    rf"({_WHO}) to (?:reach|get to) ({_PLACE})",
    re.IGNORECASE,
)
_UNTIL_IS_AT = re.compile(
    rf"\bwith ({_AMOUNT}) (?:still )?(?:to go |left )?until ({_WHO}) (?:is at|reaches|arrives at) ({_PLACE})",
    re.IGNORECASE,
)


def _of_each(found: re.Match[str]) -> str:
    """Return "When the hero is 30 m from it and the ego 12 m from the line, the hero"."""
    first, place, ego, second, there, hero = found.groups()
    return f"When {hero} is {first} from {place} and {ego} is {second} from {there}, {hero} "


def _when_both(found: re.Match[str]) -> str:
    hero, deed, first, place, ego, second, there = found.groups()
    return f"{hero} {deed} when {hero} is {first} from {place} and {ego} is {second} from {there}, and "


def _arriving(found: re.Match[str]) -> str:
    first, amount, place, second, other, there = found.groups()
    return f"When {first} is {amount} from {place} and {second} is {other} from {there}, the hero "


def _when_for_each(found: re.Match[str]) -> str:
    first, place, who, second, there, other = found.groups()
    return f"When {who} is {first} from {place} and {other} is {second} from {there}, "


def _joined_when(found: re.Match[str]) -> str:
    said = found.group(1)
    return f"When {said[0].lower() if not said.startswith('I ') else said[0]}{said[1:].replace(' when ', ' and ')}, "


def _does_when(found: re.Match[str]) -> str:
    hero, deed, that, told = found.groups()
    return f"{hero[0].upper()}{hero[1:]} {deed}s {'when' if that else 'with'} {told}"


def _on_the_clock(found: re.Match[str]) -> str:
    link, first, who, place, second, other, there = found.groups()
    return f"{link} {who} {first} from {place} and {other} {second} from {there}"


def _is_from(found: re.Match[str]) -> str:
    """Return "for the ego 5 m left to the line and 18 m for the van to the point" with who is where."""
    link = "with " if found["with"].lower() == "with " else found["with"]
    be = "" if link == "with " else "is "
    return (
        f"{_cased(link, found['with'])}{found['who']} {be}{found['first']} from {found['place']} and {found['other']} "
        f"{found['second']} from {found['there']}"
    )


def _both_are_from(found: re.Match[str]) -> str:
    """Return "when 75 ft are left for the ego and 65 ft for the hero to the point" with who is where."""
    first, second = found["who"] or found["to"], found["other"] or found["too"]
    if first is None or second is None:
        return found.group()
    be = "" if found["with"].lower() == "with " else "is "
    return f"{found['with']}{first} {be}{found['first']} and {second} {found['second']} from {found['place']}"


def _cased(words: str, like: str) -> str:
    return words[0].upper() + words[1:] if like[0].isupper() else words


def _with(found: re.Match[str]) -> str:
    """Return "At 3 s from the line for the ego and ..." as "With the ego 3 s from the line and ..."."""
    first, place, who, second, there, other = found.groups()
    begins = re.search(r"(?:^|[.!?;:,\n])\s*$", found.string[: found.start()])
    if not begins:
        return f"when {who} is {first} from {place} and {other} is {second} from {there}"
    return _cased(f"with {who} {first} from {place} and {other} {second} from {there}", found.group())


def _with_brackets(found: re.Match[str]) -> str:
    first, who, place, second, other, there = found.groups()
    return _cased(f"with {who} {first} from the {place} and {other} {second} from the {there}", found.group())


def _with_those(found: re.Match[str]) -> str:
    first, who, place, second, other, there = found.groups()
    return f"{who} is {first} from the {place} and {other} {second} from the {there}"


# In this order: what one rule leaves, the next may read.
ALLOTTING_PHRASES: Rules = (
    (_EXPRESSED_IN, ""),
    (_COUNTDOWN, "'s time "),
    (_STANDS_AT, r"\1 is "),
    (_INSTANT_T, r"\1 "),
    (_SECOND_DRIVE, r"\1 \2s "),
    (_MARK, r"\1 \2s "),
    (_OF_DRIVING, r"\1 "),
    (_ON_ITS_WAY, r"\1 \3\4\5 from \2"),
    (_MY_PLACE_FIRST, _of_each),
    (_BRAKES_AT, _when_both),
    (_ARRIVAL_TRIGGERS, _arriving),
    (_FOR_EACH_FIRST, _when_for_each),
    (_WHAT_IT_HAS_LEFT, r"\2 is \1 from \3"),
    (_DRIVES_UNTIL_IT, r"When \1 is \2, "),
    (_THIS_IS_WHEN, _joined_when),
    (_CONDITION_FOR, _does_when),
    (_ON_THE_CLOCK, _on_the_clock),
    (_UNTIL_IS_AT, r"with \2 \1 from \3"),
    (_WOULD_BE_LATER, r"is \2 from \1"),
    (_MORE_TO_TRAVEL, lambda found: f"is {found.group(1) or found.group(2)} from "),
    (_SEPARATE, r"\2 is \1 and \4 \3 from \5"),
    (_SEPARATE_FIRST, r"\2 is \1 and \5 \4 from \3"),
    (_SEPARATE_EACH, r"\2 is \1 from \3 and \5 is \4 from "),
    (_SEPARATE_ONE, r"\2 is \1 from "),
    (_THAT_IS_LEFT, r"\2\3 is \1 from \4"),
    (_TIME_NEEDED, r"\2 is \1 from \3"),
    (_NEEDS_YET, r"\1 \2 to \3"),
    (_LEFT_FOR_EACH, _is_from),
    (_LEFT_FOR_BOTH, _both_are_from),
    (_AT_FOR, _with),
    (_IN_BRACKETS, _with_brackets),
    (_WHO_IN_BRACKETS, _with),
    (_DROPPED_TO, _with_those),
    (_FOR_RESPECTIVELY, r"\1 \5 \2 and \6 \3 from \4"),
    (_DISTANCES_OF, r"with \1 \3 and \2 \4 from \5"),
    (_REMAIN_BETWEEN, r"\2\3 is \1 from \4"),
    (_BEFORE_IT_WOULD_WHEN, r"When \2 is \1 from \3 and "),
    (_BEFORE_IT_WOULD_BE, r"\1 from \2, "),
    (_BEFORE_IT_WOULD, r"\2 is \1 from \3"),
    (_IN_TERMS_OF, r"\4 and \6 \2 \3 and \5 from \1"),
)
