"""Steps over a first sentence that only sums up what the rest tells: "A car yields first and then goes after all.".

What enters: a description that no reader understands as a whole. What leaves: where such a sentence stands, and a
refusal where it says anything that the program of the rest does not. The rest has to be complete without it.
"""

from __future__ import annotations

import re

from scenewright.errors import Place, ScenewrightError, Span, TranslationError
from scenewright.program.types import EGO, HeadingsRoute, PieceKind, Program
from scenewright.roads import RoadMap, Route, all_routes
from scenewright.translate.events import HERO_ID
from scenewright.translate.gist.clauses import cut
from scenewright.translate.gist.dangers import refuse_dangers
from scenewright.translate.gist.layout import laid_out
from scenewright.translate.gist.names import find_names
from scenewright.translate.gist.objects import is_object
from scenewright.translate.gist.subjects import give_subjects
from scenewright.translate.gist.ways import WayReader
from scenewright.translate.gist.wishes import fits
from scenewright.translate.gist.words import Clause, Words
from scenewright.translate.tokens import Token

_FIRST = re.compile(
    r"(?:\s*(?:hello|hi|hey|dear)\b[^\n.!?]{0,30}[,!]?[ \t]*\n)?\s*"
    r"(?P<said>[^.!?;\n]{12,240}[.!?])(?=\s+\S)",
    re.IGNORECASE,
)
# What somebody says of the test: words that are not known change nothing there.
_FRAME = re.compile(
    r"(?:(?:hi|hello|hey|so|ok|okay|well|right|now|dear|good (?:morning|day|evening))\b[\w ]{0,12},? )?(?:"
    r"the (?:happy|normal|nominal|standard|usual|classic|nice|easy|worst|hard) (?:path|case)\b"
    r"|(?:(?:legal|marketing|sales|management|safety|homologation|validation|planning|everybody) |(?:my|our|the|a) "
    r"(?:customer|client|boss|manager|supervisor|team|professor|colleague|lead|committee|board) )"
    r"(?:has |have )?(?:asked|told|wants|wanted|needs)\b"
    r"|(?:i|we)(?: would|['\u2019]d| am|['\u2019]m| are)? (?:like|want|need|remember|recall|try|trying|looking"
    r"|testing)\b"
    r"|(?:i|we) (?:keep|kept|get|got|had|have had|see|saw|often|always|sometimes)\b"
    r"|as an? [\w ]+,? (?:i|we) (?:want|need|would like)\b"
    r"|(?:need|want|wanted|needed|looking for|request|reproduce|replay|recreate|repro)\b"
    r"|(?:what|how|who|will|would|can|does|do|is|are|watch|picture|imagine|expect|never trust|beware|meet)\b"
    r"|(?:this|it|that|the (?:test|scenario|case|idea|situation|thing))(?: one| test| scenario| case| time)? "
    r"(?:is|was|checks|covers|tests|concerns|deals|failed|happened|comes|came)\b"
    r"|(?:the )?(?:validation |test |safety |main )?(?:objective|purpose|goal|aim|motivation|background|hazard"
    r"|rationale"
    r"|concern|worry|risk|threat|issue|failure|summary|title|subject|story|context|idea|point|coverage gap)\b"
    r")",
    re.IGNORECASE,
)
_HERE = re.compile(r"^(?:here|this time|so|now),? ", re.IGNORECASE)
# How the ego should cope is for its own driving policy to decide.
_ASKS = re.compile(
    r"\b(?:how|whether|if|see that|so that) (?:the |our |an? )?(?:ego|AV|ADS|SUT|VUT|vehicle under test|planner"
    r"|policy|we)\b"
)
_WHAT_HAPPENS = re.compile(r"\bwhat happens (?:when|if)\b", re.IGNORECASE)
_STEPPED_OVER = ("lateral manoeuvres", "people and bicycles", "more than one other actor")
_BINDING = ("when", "before", "after", "until")
_KINDS = {
    "let": "dec",
    "brake": "dec",
    "stop": "dec",
    "yield": "dec",
    "wait": "dec",
    "accelerate": "go",
    "not_yield": "go",
}
_KINDS |= {"beat": "go", "complete": "go", "pass": "go"}
_NEAR = 4
# "The ego drives east." tells a way; "An eastbound car yields first" may sum it up.
_DEFINITE = re.compile(
    r"(?:the|our|my|its|his|this|that|it|he|she|we|they|i|both|ego|hero|npc|pov|sut|vut|av|adversary|target)\b",
    re.IGNORECASE,
)


def find_lead(text: str, name: str) -> Span | None:
    """Return where a first sentence stands that may only sum up what follows; None where it tells more."""
    found = _FIRST.match(text)
    if found is None:
        return None
    said = found["said"]
    try:
        tokens = laid_out(" " * found.start("said") + said, name)
    except TranslationError:  # nothing is left of it: "You know that driveway?"
        return None
    plain = _ASKS.split(_WHAT_HAPPENS.sub("", said))[0].replace("after all", "")
    framed = _FRAME.match(said) is not None or not any(_is_finite(token) for token in tokens)
    if not framed and (
        _DEFINITE.match(_HERE.sub("", said)) or re.search(r"\b(?:no|nor|none|never)\b", said, re.IGNORECASE)
    ):
        return None
    if any(_tells(tokens, at, framed=framed) for at in range(len(tokens))):
        return None
    if said.endswith("?") and re.search(r"\b(?:nobody|no one|none|never|neither|nothing)\b", said, re.IGNORECASE):
        return None
    if said.endswith("?"):
        plain = re.sub(r"\bif\b", "", plain)  # "What would it do if somebody pulled out?"
    if re.search(r"\b(?:only|except|unless|until|before|after|when|if|once|or|but not)\b", plain, re.IGNORECASE):
        return None
    try:
        known = [token for token in tokens if token.tags.get("unsupported") not in _STEPPED_OVER]
        refuse_dangers(Words(text[: found.end()], name, known))
    except TranslationError:
        return None
    return Span(*found.span("said"))


def _is_finite(token: Token) -> bool:
    acts = "verb" in token.tags and bool(token.forms & {"s", "base"}) and "event_noun" not in token.tags
    return bool(token.tags.keys() & {"be", "auxiliary"}) or acts


def _tells(tokens: list[Token], at: int, *, framed: bool) -> bool:
    """Whether a word binds more than a summary may: an amount, a condition, a denial, what is not known."""
    token = tokens[at]
    if token.quantity is not None or token.tags.keys() & {"quantity", "bare_number", "bound"}:
        return True
    if token.tags.get("link") in _BINDING and token.text.lower() not in ("when", "if"):
        return True
    if "unknown" in token.tags:
        return not framed and not token.text.lower().endswith("ly")
    if "negation" in token.tags:
        harmless = framed and not any("verb" in each.tags for each in tokens[at + 1 : at + _NEAR])
        return _denied(tokens, at) is None and not harmless
    return "unsupported" in token.tags and token.tags["unsupported"] not in _STEPPED_OVER


def _denied(tokens: list[Token], at: int) -> int | None:
    """Return the verb that a negation denies, where that is to yield, to stop or to slow down."""
    ahead = range(at + 1, min(at + _NEAR, len(tokens)))
    return next((i for i in ahead if tokens[i].tags.get("verb") in ("yield", "brake", "stop", "let", "wait")), None)


def check_lead(span: Span, text: str, name: str, program: Program, road_map: RoadMap) -> str:
    """Return what is assumed of a first sentence that sums up a program; refuse one that says something else.

    Raises
    ------
    TranslationError
        With the word that nothing in the program is like.
    """
    said = " ".join(span.excerpt(text).split())
    words = Words(text[: span.end], name, laid_out(" " * span.start + span.excerpt(text), name))
    strange = _strange(words, _routes(program, road_map), _deeds(program), of_ego=_ASKS.search(said) is not None)
    if strange is not None:
        raise TranslationError(
            "the first sentence says something that nothing after it is like",
            place=Place(name, text, strange),
            found=said,
            expected="a summary of what the rest tells",
            fix="leave it out, or say in a sentence of its own who does this",
        )
    return f"'{said}' sums up what follows; nothing is taken from it"


def _routes(program: Program, road_map: RoadMap) -> dict[int, Route]:
    by_headings = {route.headings: route for route in all_routes(road_map)}
    found = {}
    for actor in program.actors:
        assert isinstance(actor.route, HeadingsRoute)  # as the offline translator writes them
        found[actor.id] = by_headings[actor.route.headings]
    return found


def _deeds(program: Program) -> set[str]:
    """Return what the hero does: "dec" (slows down or stops), "go"."""
    pieces = next(actor.sketch.pieces for actor in program.actors if actor.id != EGO)
    ordered = any(" < " in str(constraint.formula) for constraint in program.constraints)
    slows = PieceKind.DEC in pieces
    goes = PieceKind.ACC in pieces or ordered or not slows
    return ({"dec"} if slows else set()) | ({"go"} if goes else set())


def _acts_itself(words: Words, clause: Clause) -> bool:
    """Whether a clause has a verb, and its subject is named: not "an eastbound turn against a van", "cuts us off"."""
    names = [at for at in clause.inside if at in words.names.actors]
    finite = any(_is_finite(words.tokens[at]) for at in clause.inside)
    return clause.named and finite and bool(names) and not is_object(words, names[0])


def _strange(words: Words, routes: dict[int, Route], deeds: set[str], *, of_ego: bool) -> Span | None:
    """Return where a sentence tells a way that nobody goes, or what the hero does not do."""
    whole = Span(words.tokens[0].span.start, words.tokens[-1].span.end)
    try:
        words.names = find_names(words.tokens)
        words.clauses = cut(words)
        give_subjects(words)
        reader = WayReader(words)
        reader.read()
    except ScenewrightError:
        return whole
    named = {at for clause in words.clauses if _acts_itself(words, clause) for at in clause.inside}
    for way in (*reader.ways, *reader.titles):
        able = [routes[way.actor]] if way.actor is not None and way.at in named else routes.values()
        if not any(fits(route, way) for route in able):
            return way.span
    for at, token in enumerate(words.tokens):
        kind = _KINDS.get(token.tags.get("verb", ""))
        denied = any(
            "negation" in words.tags(i) and _denied(words.tokens, i) == at for i in range(max(0, at - _NEAR), at)
        )
        denied = denied or words.word(at - 1) in ("without", "instead of")
        denied = denied or "fail" in words.verbs(range(max(0, at - 2), at))
        kind = "go" if denied else kind
        subject = next((clause.subject for clause in words.clauses if at in clause.inside), HERO_ID)
        if kind is not None and kind not in deeds and not (of_ego and subject != HERO_ID):
            return token.span
    return None
