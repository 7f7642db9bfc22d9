"""Sets aside what a text says of its own purpose: "This scenario evaluates how the ego responds to a late brake".

What enters: a description. What leaves: the description without such sentences and tails, every other character in its
place, and where they stood. One that holds an amount, a moment, a condition or a way is left where it is; one that
names what cannot be orchestrated is refused.
"""

from __future__ import annotations

import re
from itertools import pairwise

from scenewright.errors import Place, Span, TranslationError
from scenewright.translate.commentary import denied
from scenewright.translate.gist.dangers import refuse_dangers
from scenewright.translate.gist.words import Words
from scenewright.translate.headlines import untold
from scenewright.translate.itineraries import Itineraries
from scenewright.translate.tokens import Token, tokenise

_THIS = (
    r"(?:(?:this|the|such an?|our) (?:(?:test|driving|traffic|whole|overall|resulting) )?(?:scenario|test(?:"
    r" case)?|case"
    r"|situation|interaction|set-?up|configuration|encounter|exercise|arrangement|sequence|constellation)|this|it all)"
)
_ADVERBS = r"(?:(?:thus|thereby|therefore|also|specifically|effectively|deliberately|primarily|essentially|really) )*"
_FINITE = (
    r"(?:evaluates|assesses|tests|checks|examines|probes|challenges|creates|investigates|stresses|verifies"
    r"|exercises|explores"
    r"|highlights|illustrates|captures|represents|poses|produces|provokes|shows how|studies|measures|focuses on"
    r"|simulates"
    r"|is (?:designed|meant|intended|supposed|used) to (?:evaluate|assess|test|check|examine|probe|challenge|show|see"
    r"|verify|provoke|create|reveal|find out)|(?:aims|serves|helps) (?:to|at) \w+)"
)
_ING = (
    r"(?:creating|testing|challenging|evaluating|assessing|probing|producing|provoking|posing|presenting|exercising"
    r"|stressing|highlighting)"
)
_REST = r"(?:(?!\b(?:when|unless|until|once|after|before|while|then|provided|second time|twice)\b|\d)[^.;!?\n]){3,160}?"
_CLOSING = r"(?:(?!\b(?:unless|provided|only if|second time|twice|must|shall)\b|\d)[^.;!?\n]){3,200}"
# What stands last may tell again what it is all about: "The situation represents a driver who hesitates, then turns".
_LAST = re.compile(rf"(?:(?<=[.!?]\s)|(?<=\n)){_THIS} {_ADVERBS}{_FINITE}\b{_CLOSING}[.!]\s*\Z", re.IGNORECASE)
# "Scenario: courteous lorry" above steps is a title
_TITLE = re.compile(r"\A\s*(?:Scenario|Feature|Example)\b[^:\n]{0,20}:[^\n]+(?=\n\s*(?:Given|When)\b)", re.IGNORECASE)
_PURPOSE = re.compile(
    rf"(?:(?P<sentence>(?:(?<=[.!?]\s)|(?<=\n)|^){_THIS} {_ADVERBS}{_FINITE}\b{_REST}[.!])"
    rf"|(?P<tail>,? (?:(?:which|and) {_ADVERBS}{_FINITE}|(?<=, ){_ADVERBS}{_ING}|(?:thus|thereby|effectively)"
    rf" {_ING})\b{_REST})"
    r"(?=[.!;](?:\s|$)|$))(?=\s|[.!;]|$)",
    re.IGNORECASE,
)
# "To evaluate false-positive braking, we let the ego follow its lane"
_AIM = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)To (?:evaluate|test|assess|check|study|examine|investigate|measure|probe) "
    r"[^,.;:\d\n]{1,60},(?= (?:we|the|an?|our) )"
)
# "It shall be demonstrated that the ego does not panic.", "The ego's reaction to a late brake is under test."
_SHOWN = re.compile(
    r"(?:(?<=[.!?]\s)|(?<=\n)|^)(?:(?:Here,? )?(?:we|I) (?:seek|want|look for|need) (?:evidence|proof|confirmation) "
    r"that\b|It (?:shall|is to|should|must|has to) be (?:demonstrated|shown|verified|proven"
    r"|checked"
    r"|tested|established|confirmed) (?:that|whether|how) (?:the )?(?:ego|AV|SUT|VUT)\b"
    rf"|The (?:ego|AV|SUT|VUT)['\u2019]s (?:reaction|response|behaviou?r) to (?=[^.]* (?:is|are) (?:under test|tested"
    r"|assessed|of interest|at issue|examined)\.))"
    rf"{_REST}\.(?=\s)",
    re.IGNORECASE,
)
_OF_EGO = re.compile(
    r"\b(?:how|whether|if|that|for) (?:the |our )?(?:ego|AV|ADS|SUT|VUT|vehicle under test|planner|policy|system)\b"
    r"|\b(?:confuse|surprise|upset|disturb|impress|bother)s? (?:the |our )?(?:ego|AV|SUT|VUT|system|planner|policy)\b"
)


def take_purposes(text: str, name: str) -> tuple[str, tuple[Span, ...]]:
    """Return the text without what it says of its purpose, and where that stood.

    Raises
    ------
    TranslationError
        Where it names what cannot be orchestrated.
    """
    last, title = _LAST.search(text), _TITLE.match(text)
    spans = []
    inside = _PURPOSE.finditer(text, title.end() if title else 0, last.start() if last else len(text))
    for found in filter(None, (title, *_AIM.finditer(text), *_SHOWN.finditer(text), *inside, last)):
        tokens = tokenise(" " * found.start() + found.group(), name)
        told = {"quantity"} if found in (title, last) else {"heading", "area", "quantity"}
        if found.re is _SHOWN:
            told.discard("area")  # "a vehicle in the driveway that gives way": checked against the routes
        if any(token.tags.keys() & told for token in tokens):
            continue  # it tells where somebody drives
        if not _OF_EGO.search(found.group()) and any("negation" in token.tags for token in tokens):
            continue  # it tells what somebody does not do
        harmless = ("lateral manoeuvres", "more than one other actor")  # "a driver who cuts in", "oncoming traffic"
        refuse_dangers(Words(text, name, [each for each in tokens if each.tags.get("unsupported") not in harmless]))
        spans.append(Span(*found.span()))
    for span in spans:
        text = text[: span.start] + " " * (span.end - span.start) + text[span.end :]
    return text, tuple(spans)


def check_purpose(span: Span, text: str, name: str, routes: Itineraries, deeds: set[str]) -> None:
    """Refuse a purpose that tells a way which neither vehicle goes, or what the hero does not do.

    Raises
    ------
    TranslationError
        With the word.
    """
    tokens = tokenise(" " * span.start + span.excerpt(text), name)
    word = denied(tokens, [(route.turn, *route.headings) for route in (routes.ego, routes.hero)])
    word = word or _elsewhere(tokens, routes)
    word = word or untold(_of_another(tokens) if _OF_EGO.search(span.excerpt(text)) else tokens, deeds)
    if word is not None:
        raise TranslationError(
            f"'{word.text}' is part of a purpose, and nothing in the description is like it",
            place=Place(name, text, word.span),
            found=" ".join(span.excerpt(text).split()),
            expected=f"what fits {routes.ego} or {routes.hero}, and what the hero does",
            fix="say in a sentence of its own who does this",
        )


def _elsewhere(tokens: list[Token], routes: Itineraries) -> Token | None:
    """Return the word for a driveway where nobody comes from one or goes to one."""
    kinds = {route.origin_kind for route in (routes.ego, routes.hero)}
    for before, token in pairwise(tokens):
        if before.text.lower() in ("into", "enters", "entering"):
            kinds |= {route.destination_kind for route in (routes.ego, routes.hero)}
        if token.tags.get("area") == "driveway" and "driveway" not in kinds:
            return token
    return None


def _of_another(tokens: list[Token]) -> list[Token]:
    """Return what is said of somebody the ego meets: "does not yield", in "the ego copes with a hero that does ..."."""
    for noun, token in pairwise(tokens):
        if noun.tags.keys() & {"noun", "hero", "area"} and token.text.lower() in ("that", "who", "which"):
            return tokens[tokens.index(token) :]
    return []
