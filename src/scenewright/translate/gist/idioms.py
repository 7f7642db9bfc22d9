"""Says in plain words what a text says in an idiom, before it is cut into tokens.

What enters: the text. What leaves: the text, every character of the rest in its place: "No sooner is the ego 9 m from
it than the van brakes" is "When the ego ...", "the point where their paths cross" is "the conflict point", "car A" is
the ego where that is said.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from scenewright.translate.aliases import without_aliases
from scenewright.translate.gist.allotting_phrases import ALLOTTING_PHRASES
from scenewright.translate.gist.approach_phrases import APPROACH_PHRASES
from scenewright.translate.gist.asides import ASIDES
from scenewright.translate.gist.briefing_phrases import BRIEFING_PHRASES, we_for_you
from scenewright.translate.gist.clock_phrases import CLOCK_PHRASES
from scenewright.translate.gist.conduct_phrases import CONDUCT_PHRASES
from scenewright.translate.gist.following_phrases import FOLLOWING_PHRASES
from scenewright.translate.gist.formal_phrases import FORMAL_PHRASES
from scenewright.translate.gist.halting_phrases import HALTING_PHRASES
from scenewright.translate.gist.inverted_phrases import INVERTED_PHRASES
from scenewright.translate.gist.moment_phrases import MOMENT_PHRASES
from scenewright.translate.gist.order_phrases import ORDER_PHRASES
from scenewright.translate.gist.phrases import PHRASES
from scenewright.translate.gist.report_phrases import REPORT_PHRASES
from scenewright.translate.gist.rewriting import Rules, held
from scenewright.translate.gist.route_phrases import ROUTE_PHRASES
from scenewright.translate.gist.spoken_phrases import SPOKEN_PHRASES
from scenewright.translate.gist.staging_phrases import STAGING_PHRASES
from scenewright.translate.gist.test_marks import TEST_MARKS
from scenewright.translate.gist.yielding_phrases import YIELDING_PHRASES

_WAYS = r"(?:paths|ways|lanes|routes|tracks|trajectories|courses)"
_MEET = r"(?:cross|meet|merge|intersect|join|conflict|(?:come|run) together)"
_CROSSING = re.compile(
    r"(?:(?:point|spot|place|bit) (?:where|at which|in which)|(?<=from )where|(?<=short of )where|(?<=to )where"
    r"|(?<=of )where) "
    rf"(?:their|the|the two|both|our|its|your|these|two) (?:two )?{_WAYS} (?:would |will )?{_MEET}\b"
    r"|(?:(?:point|spot|place|bit) (?:where|at which)|(?<=from )where) (?:they|the two|both)(?:['\u2019]d| would| "
    r"will)? (?:meet|cross"
    r"|collide|merge)\b",
    re.IGNORECASE,
)
_ITS_WAY_MEETS = re.compile(
    r"\b(?:point|spot|place) (?:where|at which) (?:its|his|her|the [\w-]+['\u2019]s) (?:way|path|lane|route|course) "
    r"(?:would |will )?(?:meets?|cross(?:es)?|joins?|intersects?|merges? with) (?:that of the [\w-]+|the"
    r" [\w-]+['\u2019]s"
    r"|its|ours|that of the (?:vehicle|car) under test)(?: (?:way|path|lane|route|course))?\b",
    re.IGNORECASE,
)
# "No sooner is the ego 9 m from the line than the van brakes"
_NO_SOONER = re.compile(r"\bNo sooner((?: \w+)(?:(?!\bthan\b|[;!?]|\.\s).)*?)\bthan\b", re.IGNORECASE)
_CROSSING_OF = re.compile(
    rf"\b(?:crossing|meeting|intersection)(?: point)? of (?:the|their|our|its|your|both|the two) (?:two )?{_WAYS}\b",
    re.IGNORECASE,
)
_WAIT_UNTIL = re.compile(r"(?:(?<=[.!?;] )|(?<=\d[.)] ))Wait until\b")
# "Once two conditions hold at the same time, ..."
_HOLD = re.compile(
    r"\b(?:once|when|as soon as|the (?:instant|moment)) (?:(?:both|all|of|the|these|two|three|following) )*"
    r"(?:conditions?|things|requirements) "
    r"(?:holds?|(?:are|is) (?:met|fulfilled|true|satisfied|given))"
    r"(?: (?:together|at (?:the same|one|a single) (?:time|moment|instant)|simultaneously|at once))?(?:,|:| -)?"
    r"(?: namely(?: that)?,?)?",
    re.IGNORECASE,
)
# "Triggering event. The ego is ..." is a heading that ends like a sentence
_HEADED = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)((?:(?:initial|starting|start|triggering|trigger) )?"
    r"(?:conditions?|events?|states?|situation|trigger|setup|set-up|start|scene|outcome|end)"
    r"|(?:[A-Za-z]+ )?(?:response|reaction|behaviou?r|action))\.(?=\s+[A-Z])",
    re.IGNORECASE,
)
_EQUALS = re.compile(
    r"\b(turn|route|direction|heading|lane|goal|maneuver|manoeuvre)\s*=+(?=\s*[A-Za-z])", re.IGNORECASE
)
_IS_EQUAL = re.compile(r"(?<= )==(?= )")
_DIGITS = {
    word: digit
    for digit, word in enumerate(["one", "two", "three", "four", "five", "six", "seven", "eight", "nine"], 1)
}
_TENTHS = re.compile(rf"\b({'|'.join(_DIGITS)}|\d) tenths? of an? (second|g)\b", re.IGNORECASE)
_AHEAD_OF_MOMENT = re.compile(
    r"\bahead of the (?:moment|time|instant|point)(?: (?:when|at which|that|where))?\b", re.IGNORECASE
)
# "the ego would hit the van in 3 s": the time to collision
_WOULD_HIT = re.compile(
    r"\bwould (hit|run into|collide with|crash into|drive into|bump into)((?: [\w-]+){1,4}?) in (?=[\d.]+ ?s\b"
    r"|\w+ seconds?\b)",
    re.IGNORECASE,
)
# "..., I hope that makes sense", "and stops, like it should": what changes nothing
_TAILS = re.compile(
    r",? (?:(?:and )?(?:i|we) hope (?:that|this|it) (?:makes sense|is clear|helps)|if (?:that|this) makes sense"
    r"|(?:just )?(?:as|like) (?:it|he|she|they|one|you) (?:should|ought to|would expect|might expect|must)"
    r"|or anything(?: like (?:that|this))?|(?:which|and that,?) i (?:think|believe|suppose"
    r"|guess)[^.,;!?]*"
    r"|as (?:is )?(?:expected|required|prescribed)|if (?:that|this) is (?:possible|ok|okay)|nae bother"
    r"|no bother)(?=\s*[.,;!?)]|\s*$)",
    re.IGNORECASE,
)
_VERDICT = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n))[A-Z][a-z]+(?: [a-z]+){0,3},? (?:i|we|they) call (?:that|this|it)\s*(?=[.!])", re.I
)
_I_THINK = re.compile(r"(?<![\w-])(?:i think (?=this|that)|so yeah),? ?", re.IGNORECASE)
# "The response of the van to the trigger is to brake"
_RESPONSE = re.compile(
    r"\bthe (?:response|reaction|answer) of (the [\w-]+|[A-Z]\w+) to (?:the trigger|this|that|it) is to\b",
    re.IGNORECASE,
)
# "The trigger is the conjunction of two conditions, namely that the ego ..."
_CONJUNCTION = re.compile(
    r"\bthe trigger (?:is|consists of) (?:the (?:conjunction|combination"
    r"|coincidence) of )?(?:the following )?two conditions"
    r"(?:,|:)? ?(?:namely )?(?:that )?(?=the |an? |[A-Z])",
    re.IGNORECASE,
)
# "Is it 2 s away from the line, then the van brakes" is a condition in German
_IS_IT = re.compile(r"(?:(?<=[.!?]\s)|^)Is (?=(?:it|he|she|the [a-z]+) (?:[^.?!]|\.\d)*\bthen\b)")
# "NPC1" where there is no second one
_FIRST_ONE = re.compile(r"\b(NPC|Target|Hero|Actor|Agent|POV|Adversary|Opponent|TV)[_-]?1\b(?![.\d])", re.IGNORECASE)
_SECOND_ONE = re.compile(r"\b(?:NPC|Target|Hero|Actor|Agent|POV|Adversary|Opponent|TV)[_-]?2\b(?![.\d])", re.IGNORECASE)
_ENUMERATED = re.compile(r"(?<=[ ,;])\((?:i{1,3}|iv|[a-d]|[1-4])\) ")
_PART_OF = re.compile(r"\bthe (?:centre|center|middle) of (?=the )", re.IGNORECASE)
_TURNS_ON = re.compile(r"\b(turn(?:s|ing|ed)?) on (?=the (?:left|right)\b)", re.IGNORECASE)
_AFTER_COMMA = re.compile(r"(?<=[.!?]\s)After,|\band after,|(?<=, )after,")
_BEFORE_OF = re.compile(r"\bbefore of (?=the )")
_WAIT_FOR = re.compile(r"(?:(?<=[.!?;:]\s)|(?<=\d\.\s))Wait (?:for|until) ((?:the )?\w+) to be\b")
_CHAT = re.compile(r",? ?\b(?:lol|haha|btw|tbh|imo|imho)\b,?", re.IGNORECASE)
_SAID_POINT = re.compile(r"\bthe said (?=point|line|place|spot)", re.IGNORECASE)
# "TTA(ego, stop line) = 2.5 s"
_FUNCTION = re.compile(
    r"\b(tta|time|distance|dist)\((?:the )?([\w ]+?)(?:,| to) ?(?:the |its )?(stop line|conflict point|intersection)\)",
    re.IGNORECASE,
)
_MORE = re.compile(r"\b([\d.]+|[a-z]+) more (seconds?|metres?|meters?|feet|yards)\b", re.IGNORECASE)
_AND_TENTHS = re.compile(rf"\b(\d+) (seconds?) and (\d|{'|'.join(_DIGITS)}) tenths?\b", re.IGNORECASE)
_FOUND_TO_BE = re.compile(r"\b(?:is|are) found to be\b", re.IGNORECASE)
_CENTRES = re.compile(r",? measured (?:centre|center) to (?:centre|center),?", re.IGNORECASE)
_TO_A_CRAWL = re.compile(r"\bto a (?:crawl|walking pace) of (?=[\d.])", re.IGNORECASE)
_BOTH_HOLD = re.compile(
    r" \((?:both|all)(?: of (?:them|these))? (?:must|shall|have to|should|need to)? ?(?:hold|apply|be true|be met)\)",
    re.I,
)
_SPEED_NOUGHT = re.compile(
    r"\bspeed (?:is )?(?:0|zero)(?: m/s| km/h)? at\b(?! (?:first|the (?:start|beginning|outset)))", re.IGNORECASE
)
_TO_SPEED_NOUGHT = re.compile(
    r"\bto (?:a )?(?:speed|velocity) (?:of )?(?:0|zero)(?! ?\.)(?: m/s| km/h)?(?=[\s,.;])", re.IGNORECASE
)
_DEFINED_AS = re.compile(r" :=(?= )")
_TURN_OF = re.compile(
    r"\b(?:before|prior to) the (?:beginning|start|onset|commencement) of the turn (?:of"
    r"|by) ((?:the )?[\w ]+?)(?=[.,;]|$)",
    re.I,
)
_CONDITION_HOLDS = re.compile(
    r"\b(?:once|when|as soon as) (?:the|this|that) (?:precondition|condition|guard|trigger|event) "
    r"(?:holds|becomes true|is true|is met|is fulfilled|is satisfied|occurs|fires)(?=,)",
    re.IGNORECASE,
)
_UNTIL_NOUGHT = re.compile(r"\buntil v ?= ?0\b")
_MOTION_ENDS = re.compile(r"\b(?:its|his|her) (?:motion|movement|ride|drive) ends\b", re.IGNORECASE)
_BEFORE_THAT = re.compile(r"\bbefore that (?=(?:the|our|it|he|she) )", re.IGNORECASE)
_TO_NOUGHT = re.compile(
    r"\bto (?:v ?= ?0(?: ?(?:km/h|mph|m/s|kph))?|0 ?(?:km/h|mph|m/s|kph))(?![\w/]|\.\d)", re.IGNORECASE
)
# "When both are met, the van brakes": what was told before is the trigger
_BOTH_MET = re.compile(
    r"\b(?:when|once|as soon as|if) (?:both|these|all|both of (?:these|them)|(?:the|these|both|all) (?:two )?conditions"
    r"|\(1\) and \(2\)|\(a\) and \(b\))(?: of them)? (?:(?:are|have been|become) (?:satisfied|met|true|fulfilled"
    r"|given|reached)|hold)"
    r"(?: (?:together|at (?:the )?same time|simultaneously|at once))?(?=[, ])",
    re.IGNORECASE,
)
_PLACED = re.compile(r"[\d_](?:m|s|ft|yd| ?[a-z]+)? (?:from|before|short of|away|off|to|behind)\b")
# "The hero's passage of the conflict point precedes the beginning of the ego's turn"
_WHO = r"(?:its|his|her|(?:the )?[\w-]+(?: vehicle| car)?['\u2019]s)"
_WHOM = r"(?:(?:the )?[\w-]+(?: vehicle| car)?)"
_PRECEDES = re.compile(
    rf"\b(?:(?P<passer>{_WHO}) passage (?:of|through|across|past) the conflict point"
    rf"|the passage of (?P<passing>{_WHOM}) (?:through|across|past|over) the conflict point"
    rf"|the completion of (?P<turner>{_WHO}) turn) (?:precedes|comes before|takes place before|occurs before"
    rf"|is before) "
    rf"(?:the (?:beginning|start|onset|commencement) of (?P<beginner>{_WHO}) turn|that of (?P<other>{_WHOM})"
    rf"|(?P<later>{_WHO}) passage (?:of|through|across|past) the conflict point"
    rf"|the passage of (?P<latter>{_WHOM}) (?:through|across|past|over) the conflict point)",
    re.IGNORECASE,
)
_AFTER_THIS = re.compile(
    r"\b(complete[sd]?|finishe?[sd]?) (after (?:this|that)|then|afterwards) ((?:its|his|her|the) turn)\b", re.I
)
_UNDERSCORE = re.compile(r"\b(ego|hero|npc|target|other|opponent|lead)_(vehicle|car|actor|agent)\b", re.IGNORECASE)
_THAT_IS = re.compile(r", that is,")
_WHERE_CROSS = re.compile(
    rf"(?<=conflict point),? where (?:their|the|the two|both|two) (?:two )?{_WAYS} (?:would |will )?{_MEET}",
    re.IGNORECASE,
)


def without_idioms(text: str) -> str:
    """Return the text in plain words."""
    text = we_for_you(without_aliases(text))
    lowered = text.lower()
    for runs, pattern, words in _INDEXED:
        if not any(run in lowered for run in runs):
            continue
        changed = pattern.sub(partial(_said, words), text)
        if changed != text:
            text, lowered = changed, changed.lower()
    return text


def _said(words: str | Callable[[re.Match[str]], str], found: re.Match[str]) -> str:
    """Return what stands in place of an idiom, as long as it."""
    said = found.expand(words) if isinstance(words, str) else words(found)
    return said.ljust(len(found.group()))


def _comes_before(found: re.Match[str]) -> str:
    """Return "the hero passes the conflict point before the ego begins its turn" for its nouns."""

    def owner(said: str) -> str:
        return {"its": "it", "his": "he", "her": "she"}.get(said.lower()) or re.sub(r"['\u2019]s$", "", said)

    first = found["passer"] or found["passing"] or found["turner"]
    does = "completes its turn" if found["turner"] else "passes the conflict point"
    if found["beginner"]:
        second = f"{owner(found['beginner'])} begins its turn"
    elif found["other"]:
        second = found["other"]
    else:
        second = f"{owner(found['later'] or found['latter'])} passes the conflict point"
    said = f"{owner(first)} {does} before {second}"
    return said if len(said) <= len(found.group()) else found.group()


def _then_or_when(found: re.Match[str]) -> str:
    """Return "When" where the conditions follow, else "At that time": they were told before."""
    rest = re.split(r"[.;!?](?:\s|$)", found.string[found.end() :], maxsplit=1)[0]
    first = re.split(r",| (?:brakes|stops|accelerates|slows|decelerates)", rest.lstrip(", "), maxsplit=1)[0]
    return found.group() if _PLACED.search(first) else "at that time"


def _seconds_and_tenths(found: re.Match[str]) -> str:
    """Return "3 seconds and 4 tenths" as "3.4 s"."""
    digit = _DIGITS.get(found.group(3).lower()) or found.group(3)
    return f"{found.group(1)}.{digit} s"


def _in_tenths(found: re.Match[str]) -> str:
    """Return "nine tenths of a second" as "0.9 s"."""
    digit = _DIGITS.get(found.group(1).lower()) or found.group(1)
    return f"0.{digit} {'g' if found.group(2).lower() == 'g' else 's'}"


def _collision_time(found: re.Match[str]) -> str:
    """Return "would hit the van in" as "'s TTC to the van is"."""
    return f"'s TTC to{found.group(2)} is "


def _alone(found: re.Match[str]) -> str:
    """Return "NPC1" as "NPC" where there is no second one."""
    return found.group() if _SECOND_ONE.search(found.string) else found.group(1)


def _stop(found: re.Match[str]) -> str:
    """Return "to 0 km/h" as a stop, in words that fit in its place."""
    return "to a stop" if len(found.group()) > 8 else "to zero"


# In this order: what one rule leaves, the next may read.
_RULES: Rules = (
    (_PRECEDES, _comes_before),
    (_BOTH_MET, _then_or_when),
    (_HOLD, "When"),
    (_WAIT_UNTIL, "When"),
    (_NO_SOONER, r"When     \1,   "),
    (_THAT_IS, ","),
    (_HEADED, r"\1:"),
    (_EQUALS, r"\1"),
    (_IS_EQUAL, "= "),
    (_TENTHS, _in_tenths),
    (_AHEAD_OF_MOMENT, "before"),
    (_WOULD_HIT, _collision_time),
    (_TAILS, ""),
    (_VERDICT, ""),
    (_I_THINK, ""),
    (_RESPONSE, r"\1 then shall"),
    (_CONJUNCTION, "When"),
    (_FIRST_ONE, _alone),
    (_ENUMERATED, ""),
    (_PART_OF, ""),
    (_TURNS_ON, r"\1 to "),
    (_AFTER_COMMA, "then"),
    (_BEFORE_OF, "before"),
    (_WAIT_FOR, r"When \1 is"),
    (_CHAT, ""),
    (_SAID_POINT, "that"),
    (_FUNCTION, r"\1 \2 \3"),
    (_MORE, r"\1 \2 more"),
    (_AND_TENTHS, _seconds_and_tenths),
    (_FOUND_TO_BE, "is"),
    (_CENTRES, ""),
    (_TO_A_CRAWL, "to"),
    (_BOTH_HOLD, ""),
    (_SPEED_NOUGHT, "stop at"),
    (_TO_SPEED_NOUGHT, "to zero"),
    (_DEFINED_AS, " : "),
    (_TURN_OF, r"before \1 begins its turn"),
    (_CONDITION_HOLDS, "at that time"),
    (_UNTIL_NOUGHT, "to zero"),
    (_MOTION_ENDS, "it stops"),
    (_BEFORE_THAT, "before"),
    (_TO_NOUGHT, _stop),
    (_IS_IT, "If "),
    (_AFTER_THIS, r"\1 \3"),
    (_UNDERSCORE, r"\1 \2"),
    *TEST_MARKS,
    *CLOCK_PHRASES,
    *ASIDES,
    *BRIEFING_PHRASES,
    *FORMAL_PHRASES,
    *INVERTED_PHRASES,
    *STAGING_PHRASES,
    *ALLOTTING_PHRASES,
    *CONDUCT_PHRASES,
    *FOLLOWING_PHRASES,
    *ROUTE_PHRASES,
    *ORDER_PHRASES,
    *HALTING_PHRASES,
    *APPROACH_PHRASES,
    *MOMENT_PHRASES,
    *SPOKEN_PHRASES,
    *REPORT_PHRASES,
    *YIELDING_PHRASES,
    *PHRASES,
    (_WHERE_CROSS, ""),
    (_ITS_WAY_MEETS, "conflict point"),
    (_CROSSING_OF, "conflict point"),
    (_CROSSING, "conflict point"),
)
_INDEXED = tuple((held(pattern), pattern, words) for pattern, words in _RULES)
