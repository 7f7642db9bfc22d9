"""Reads limits that hold for a while: "from the trigger until it has stopped, its speed never exceeds 8 m/s".

What enters: a description. What leaves: the description without such sentences and clauses, every other character in
its place, and a `Limit` for each. Whose limit it is is found by its words; when it holds, by a few plain windows.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from scenewright.errors import Place, Span, TranslationError
from scenewright.program.arithmetic import negate
from scenewright.program.expressions import Compare, Elapsed, Formula, Knot, PieceRef, State, Temporal
from scenewright.program.types import PieceKind, Sketch
from scenewright.translate.events import HERO_ID
from scenewright.translate.tokens import Quantity, tokenise

Moment = Literal["start", "trigger", "stop", "end"]

_SPEED = r"(?:[\d.]+ ?(?:m/s|km/h|mph|kph|mps)(?![²^\w])|\w+_(?:mps|kmh|kph|kmph|mph)\b)"
_RATE = r"(?:[\d.]+ ?(?:m/s²|m/s\^2|m/s2|mpss|g)(?!\w)|\w+_mpss\b)"
_OWNER = r"(?:its|his|her|the|the [\w-]+(?: [\w-]+)?['’]s|[A-Z]\w+['’]s)"
_SUBJECT = (
    rf"(?:{_OWNER} (?:speed|velocity|deceleration)|the (?:speed|velocity"
    rf"|deceleration) of (?:the )?[\w-]+(?: vehicle| car)?"
    r"|the magnitude of its deceleration|it|he|she|the [\w-]+(?: vehicle| car)?|[A-Z]{2,4})"
)
_NOT = (
    r"(?:(?:must|shall|should|may|does|do|did|will|can|is|was)(?: not|n['’]t)(?: ever)?(?: to)?"
    r"|(?:must|shall|should|may|will|is) never|never)"
)
_ABOVE = (
    r"(?:exceeds?|exceeded|goes? (?:over|above|faster than)|drives? faster than|(?:be |is )?(?:higher|faster"
    r"|greater|more) than"
    r"|rises? above|(?:be |is )?above)"
)
_ABOVE_BARE = (
    r"(?:exceed|go (?:over|above|faster than)|drive faster than|be (?:higher|faster|greater|more|above) ?(?:than)?)"
)
_BELOW = (
    r"(?:stays?|remains?|keeps?|be|is|to stay|to remain) (?:at or )?(?:below|under|at most|no (?:more|higher"
    r"|faster) than"
    r"|not (?:more|higher|faster) than|limited to)"
)
_WINDOW = (
    r"(?:from|between|at every|during|throughout|until|up to|while|at all times|at any|on the way"
    r"|all the way|at the moment)"
)
_LIMIT = re.compile(
    rf"(?P<joint>(?:^|(?<=[.;!?]\s)|(?<=\n)|, and |, | and )(?:(?:limit(?:ation)?|constraint|restriction) ?[:=]"
    rf" ?)?)(?P<before>{_WINDOW}\b[^.;!?\n]*?,? )?"
    rf"(?:(?P<who>{_SUBJECT}) (?:{_NOT} {_ABOVE}|{_BELOW})|(?P<bare>stays|keeps|remains) (?:at or )?(?:below|under)"
    r"|(?P<braking>(?:please )?(?:it |he |she |the [\w-]+ )?(?:never )?brak(?:ing|es)|decelerat(?:ing|es)|with a "
    r"deceleration(?: of)?)"
    r" (?:not|no|never) (?:harder|stronger|more|greater|higher) than"
    rf"|(?P<no>at no (?:moment|time|point|instant)) (?P<during>[^.;!?\n]*? )?(?:does|shall|may|must|did|should|is)"
    rf" (?P<whom>{_SUBJECT}) {_ABOVE_BARE}) (?P<amount>{_SPEED}|{_RATE})"
    rf"(?P<after>(?: {_WINDOW}\b[^.;!?\n]*?)?)(?=[.;!?](?:\s|$)|, |$|\n)",
    re.IGNORECASE,
)
_HIM = r"(?:it|he|she|the [\w-]+(?: vehicle| car)?)"
_BEGUN = (
    rf"(?:{_HIM} (?:starts?|begins?) (?:to (?:brake|accelerate|slow down|slow|decelerate|speed up)|braking"
    rf"|accelerating))"
)
_STOPPED = (
    rf"(?:(?:the |a |its |this |that )?(?:standstill|complete stop|full stop|stop|halt)"
    rf"|{_HIM} (?:stops|stands|has stopped"
    rf"|is at rest|is stopped"
    r"|has come to (?:a |an )?(?:complete |full )?(?:stop|halt|standstill|rest)|comes to (?:a )?(?:stop|halt"
    r"|standstill|rest)))"
)
_AT_GOAL = (
    rf"(?:(?:the )?conflict point|{_HIM} (?:passes|reaches|has passed|is at|gets to|is past"
    rf"|has reached) (?:the conflict point|it)"
    rf"|the end of (?:its|the) turn|{_HIM} (?:has )?(?:completed|completes|finished|finishes) (?:its|the) turn|the end)"
)
_ANY = r"(?:at (?:any|all) (?:time|times|moment|point)|throughout|ever)"
_TRIGGER = (
    r"(?:the (?:trigger(?: event)?|event|onset|cue)|then|there|that (?:moment|instant)|this (?:moment|instant)|the "
    r"moment " + _BEGUN + ")"
)
_START = r"(?:the (?:start|beginning|outset)(?: of the (?:test|run|scenario))?)"
_TOLD: tuple[tuple[str, tuple[Moment, Moment]], ...] = (
    (
        rf"(?:from|between) {_TRIGGER}(?: on)?(?:,? (?:until|to|up to|and) (?:the moment )?{_STOPPED})",
        ("trigger", "stop"),
    ),
    (
        rf"(?:from|between) {_TRIGGER}(?: on)?(?:,? (?:until|to|up to|and) (?:the moment )?{_AT_GOAL})",
        ("trigger", "end"),
    ),
    (rf"(?:from|between) {_START}(?:,? (?:until|to|up to|and) (?:the moment )?{_STOPPED})", ("start", "stop")),
    (rf"(?:from|between) {_START}(?:,? (?:until|to|up to|and) (?:the moment )?{_AT_GOAL})", ("start", "end")),
    (rf"(?:from|between) {_START}(?:,? (?:until|to|up to|and) (?:{_BEGUN}|the trigger))", ("start", "trigger")),
    (rf"(?:until|up to) (?:{_BEGUN}|the trigger)", ("start", "trigger")),
    (rf"(?:all the way|on the way) to {_AT_GOAL}", ("trigger", "end")),
    (rf"(?:from {_TRIGGER}(?: on)?)", ("trigger", "end")),
    (
        rf"while {_HIM} (?:brakes|is braking|decelerates)|(?:{_ANY} )?(?:during|of|in|while) (?:the |its )?"
        r"(?:braking|deceleration|slowing down)",
        ("trigger", "stop"),
    ),
    (_ANY, ("start", "end")),
)
_WINDOWS = tuple(
    (re.compile(rf"^(?:at every (?:moment|instant) )?(?:{pattern}),?(?: {_ANY})?$", re.IGNORECASE), window)
    for pattern, window in _TOLD
)
_ASKS = re.compile(r"\s*(?:when|once|as soon as|at the (?:moment|instant)|the moment|if)\b", re.IGNORECASE)
_ASKED = re.compile(r"\b(?:when|once|as soon as|if|moment|instant|until|while)\b", re.IGNORECASE)
_AT_PASSING = re.compile(
    rf"^at the moment (?:when|at which) {_HIM} (?:passes|reaches|is at) (?:the conflict point|it),?$", re.IGNORECASE
)


@dataclass(frozen=True, slots=True)
class Limit:
    """What the hero keeps below for a while.

    Attributes
    ----------
    quantity
        A speed, or the size of a deceleration.
    window
        From when to when; None for the last moment of what the hero does.
    span
        Where it stands.
    who
        Where its owner stands; a pronoun where `named` is False.
    """

    quantity: Quantity
    window: tuple[Moment, Moment] | None
    span: Span
    who: Span
    named: bool


def take_limits(text: str, name: str) -> tuple[str, tuple[Limit, ...]]:
    """Return the text without its limits, and these; one whose window is not understood is left where it is."""
    limits = []
    for found in _LIMIT.finditer(text):
        told = (found["before"] or found["during"] or "", found["after"])
        window = _window(" ".join(each.strip().rstrip(",") for each in told).strip())
        asked = found["joint"].strip() and _ASKED.search(re.split(r"[.;!?]\s", text[: found.start()])[-1])
        if window is False or (asked and not any(told)):
            continue  # "when the ego is 12 m from it and the van's speed is at most 8 m/s" is a condition
        amount = Span(*found.span("amount"))
        token = next(each for each in tokenise(" " * amount.start + found["amount"], name) if each.quantity is not None)
        assert token.quantity is not None
        subject = next((key for key in ("who", "whom", "bare") if found[key]), "bare" if found["bare"] else "braking")
        who = "it" if subject in ("bare", "braking") else found[subject].lower()
        named = not re.match(
            r"(?:its|his|her|it|he|she|the magnitude of its|the (?:speed|velocity|deceleration)$)\b", who
        )
        start = found.start() + len(found["joint"])
        limits.append(Limit(token.quantity, window, Span(start, found.end()), Span(*found.span(subject)), named))
        whole = not found["joint"].strip() and text[found.end() : found.end() + 1] in (".", ";", "!")
        end = found.end() + whole  # a whole sentence goes with its full stop
        text = text[: found.start()] + " " * (end - found.start()) + text[end:]
    return text, tuple(limits)


def owner_of_limit(limit: Limit, text: str, named: dict[int, int]) -> int | None:
    """Return whose limit it is: who is named in it, else who is named first in its sentence or the one before.

    `named` holds the actor of each place in the text where one is named.
    """
    own = [actor for at, actor in named.items() if limit.who.start <= at < limit.who.end]
    if own or limit.named:
        return own[0] if own else None
    inside = [actor for at, actor in named.items() if limit.span.start <= at < limit.who.start]
    if inside:
        return inside[0]
    if limit.quantity.dimension == "acceleration":
        return HERO_ID  # nobody tells the ego to brake
    end = limit.span.start
    for _ in range(2):
        before = text[:end].rstrip().rstrip(".;!?")
        start = max(before.rfind(". "), before.rfind("; "), before.rfind("\n"), -1) + 1
        told = [actor for at, actor in sorted(named.items()) if start <= at < limit.span.start]
        if told and _ASKS.match(text[start : limit.span.start]):
            return HERO_ID if HERO_ID in told else told[0]  # "When the ego is ..., the hero brakes. Its speed ..."
        if told:
            return told[0]
        end = start
    return None


def limit_formula(limit: Limit, sketch: Sketch) -> Formula:
    """Return what a limit says of a hero with this sketch.

    Raises
    ------
    ValueError
        Where the hero does not do what the limit is about.
    """
    if limit.quantity.dimension == "acceleration":
        if PieceKind.DEC not in sketch.pieces:
            raise ValueError("the hero does not brake")
        return Compare(">=", State(HERO_ID, 2, PieceRef("dec")), negate(limit.quantity.term, limit.quantity.span))
    if limit.window is None:
        return Compare("<=", State(HERO_ID, 1, Knot(sketch.knots[-1])), limit.quantity.term)
    start, end = (_knot(each, sketch) for each in limit.window)
    body = Compare("<=", State(HERO_ID, 1, None), limit.quantity.term)
    return Temporal("always", Elapsed(HERO_ID, start), Elapsed(HERO_ID, end), body)


def _knot(moment: Moment, sketch: Sketch) -> str:
    if moment == "start":
        return "t0"
    if moment == "trigger":
        return "t1"
    if moment == "end":
        return sketch.knots[-1]
    if PieceKind.DEC not in sketch.pieces:
        raise ValueError("the hero does not stop")
    return sketch.knots[sketch.pieces.index(PieceKind.DEC) + 1]


def _window(said: str) -> tuple[Moment, Moment] | Literal[False] | None:
    """Return the window that words tell; False where they are not understood."""
    if not said:
        return "start", "end"
    if _AT_PASSING.match(said):
        return None
    return next((window for pattern, window in _WINDOWS if pattern.match(said)), False)


def refuse_limit(limit: Limit, why: str, text: str, name: str) -> TranslationError:
    """Return the error for a limit that cannot be kept."""
    return TranslationError(
        f"this limit cannot be orchestrated: {why}",
        place=Place(name, text, limit.span),
        found=" ".join(limit.span.excerpt(text).split()),
        expected="a limit on the speed or the deceleration of the other vehicle, while it does something",
    )
