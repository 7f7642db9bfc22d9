"""The reader that knows rules: a description of the paper's kind becomes a program, clause by clause.

What enters: a description and a map. What leaves: a `Translation`: the program, how every clause was read, and what had
to be assumed. The grammar of clauses has to understand every word; free prose is refused.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from scenewright.errors import Place, Span, TranslationError
from scenewright.program.expressions import Number, ParameterRef, walk
from scenewright.program.structure import Role, read_structure
from scenewright.program.types import Program
from scenewright.roads import find_conflict
from scenewright.translate.aliases import without_short_names
from scenewright.translate.assemble import Assembler
from scenewright.translate.clauses import ClauseReader
from scenewright.translate.commentary import denied, without_commentary
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, Event
from scenewright.translate.facts import Facts
from scenewright.translate.fronting import unfronted
from scenewright.translate.geometry import is_remark
from scenewright.translate.headlines import untold
from scenewright.translate.interpret import Interpreter
from scenewright.translate.itineraries import Itineraries, choose_routes
from scenewright.translate.layout import lay_out
from scenewright.translate.notes import noted
from scenewright.translate.phrases import Phrases
from scenewright.translate.references import Referents
from scenewright.translate.relatives import related
from scenewright.translate.rewording import reworded
from scenewright.translate.run_ons import parted
from scenewright.translate.speech import spoken
from scenewright.translate.steps import in_sentences
from scenewright.translate.tokens import Token, refuse_unknown, tokenise
from scenewright.translate.translation import ROLES, Reading, Translation
from scenewright.translate.unsayable import refuse_unplaced_stop

_AT_ONCE = re.compile(
    r"\b(?:at|in) the (?:very )?same (?:moment|time|instant|second)|\buses? (?:that|this) (?:very )?moment"
    r"|\bsimultaneously\b|\bconcurrently\b",
    re.IGNORECASE,
)

_SAME_WAY = re.compile(
    r"\b(?:(?:come|drive|travel)(?:s|ing)? along (?:the|a) road (?:the same way|in the same direction)"
    r"|one behind the other|in single file)\b",
    re.IGNORECASE,
)
_AT_TRIGGER = re.compile(r"\b(?:at|on|upon) (?:the )?trigger\b", re.IGNORECASE)

# "turns right, and the van does so too": nothing says whether that is its turn, too
_TURNS_TOO = re.compile(
    r"\bturn\w*\b[^.;]{0,90}?\b(?:does (?:so )?too|does so(?! by)|so (?:does|is|will)|likewise|ditto|follows suit"
    r"|just like|(?:ego|hero|car|van|vehicle|truck|lorry|other) too)\b",
    re.IGNORECASE,
)

# A heading with keys under it, further in: whose heading that is, the grammar of clauses does not know.
_NESTED = re.compile(r"^([ \t]*)\S[^\n:]*:[ \t]*\n(?:\1[ \t]+[^\n:]+:[^\n]+\n?){2,}", re.MULTILINE)

if TYPE_CHECKING:
    from scenewright.roads import RoadMap


def read_by_rules(text: str, road_map: RoadMap, name: str) -> Translation:
    """Translate clause by clause; every word has to be understood.

    Raises
    ------
    TranslationError
        Where the text is not understood, where it contradicts itself, and where it leaves a choice open.
    """
    if nested := _NESTED.search(text):
        span = Span(*nested.span())
        raise TranslationError(
            "keys that stand further in, under a heading, are not read",
            place=Place(name, text, span),
            found=span.excerpt(text).strip().splitlines()[0],
            expected="sentences, or one line for each vehicle",
            fix="say in sentences what the heading is about",
        )
    return _refuse_turning_too(_by_grammar(text, road_map, name), text, name)


def _by_grammar(text: str, road_map: RoadMap, name: str) -> Translation:
    """Translate clause by clause; every word has to be understood."""
    rest = without_short_names(in_sentences(parted(text)))
    tokens = unfronted(reworded(related(spoken(noted(tokenise(rest, name))))))
    tokens, comments = without_commentary(tokens)
    tokens, titles = lay_out(tokens)
    refuse_unknown(tokens, text, name)
    referents = Referents(text, name)
    phrases = Phrases(text, name, tokens, referents)
    skipped = [(words, words[0].span.union(words[-1].span)) for words in (*comments, *titles)]
    _assume_what_was_read(phrases, skipped)
    events = ClauseReader(phrases).read()
    facts = Interpreter(text, name).run(events, phrases.described)
    _complete(facts, text, name)
    _deeds_done(facts, phrases, text, name)
    routes = choose_routes(facts, road_map, text, name)
    for stretch, span in skipped:
        _check_skipped(stretch, span, facts, routes, Place(name, text, span))
    return _assembled(facts, routes, events, tokens, tuple(phrases.assumptions), road_map.name, text, name)


def _refuse_turning_too(read: Translation, text: str, name: str) -> Translation:
    """Refuse words that may tell the turn of a vehicle by that of the other: "turns right, and the van does so too"."""
    assumed = any("no turn of it was mentioned" in each for each in read.assumptions)
    if assumed and (too := _TURNS_TOO.search(text)):
        span = Span(*too.span())
        raise TranslationError(
            "it is not clear whether both vehicles turn",
            place=Place(name, text, span),
            found=span.excerpt(text),
            expected="where each of the two vehicles turns",
            fix="say it of each: 'the hero turns right'",
        )
    return read


def _assume_what_was_read(phrases: Phrases, skipped: list[tuple[list[Token], Span]]) -> None:
    for _, span in sorted(skipped, key=lambda each: each[1].start):
        words = " ".join(span.excerpt(phrases.text).split())
        phrases.assume(f"'{words}' comments on the test; nothing in it is orchestrated")
    for token in phrases.tokens:
        if "guess" in token.tags:
            phrases.assume(f"'{token.text}' is taken for a description that changes nothing")
        if "unit_before" in token.tags:
            phrases.assume(f"'{token.text}' has the unit of the amount before it")
        for written, read in token.slips:
            phrases.assume(f"'{written}' is read as '{read}'")


def _check_skipped(stretch: list[Token], span: Span, facts: Facts, routes: Itineraries, place: Place) -> None:
    """Refuse a title or a comment that says what the rest does not say, or what is not so."""
    text = place.text or ""
    found = " ".join(span.excerpt(text).split())
    if word := denied(stretch, [(route.turn, *route.headings) for route in (routes.ego, routes.hero)]):
        raise TranslationError(
            f"'{word.text}' was stepped over as a title or a comment, but neither vehicle does this",
            place=place,
            found=found,
            expected=f"what fits {routes.ego} or {routes.hero}",
            fix="say in a sentence of its own who does this",
        )
    if word := untold(stretch, _deeds(facts)):
        raise TranslationError(
            f"'{word.text}' was stepped over as a title, but it is not told again",
            place=place,
            found=found,
            expected="a sentence that says when the hero does this",
            fix="tell it in a sentence of its own",
        )
    if is_remark(stretch) and find_conflict(routes.ego, routes.hero) is None:
        raise TranslationError(
            "it is said that the ways of the two vehicles meet, but they do not",
            place=place,
            found=found,
            expected=f"what fits {routes.ego} and {routes.hero}",
            fix="check the turns and the directions of travel",
        )


def _assembled(
    facts: Facts,
    routes: Itineraries,
    events: list[Event],
    tokens: list[Token],
    assumed: tuple[str, ...],
    map_name: str,
    text: str,
    name: str,
) -> Translation:
    """Build the program, and say what every event came to."""
    if (same := _SAME_WAY.search(text)) and routes.ego.headings[0] != routes.hero.headings[0]:
        raise TranslationError(
            "the two vehicles do not come the same way",
            place=Place(name, text, Span(*same.span())),
            found=same.group(),
            expected=f"what fits {routes.ego} and {routes.hero}",
            fix="check the turns and the directions of travel",
        )
    refuse_unplaced_stop([each.place is not None for each in facts.phases if each.to_stop], text, name)
    assembler = Assembler(facts, routes, text, name)
    program = assembler.program(map_name)
    _all_amounts_used(program, tokens, text, name)
    assumptions = tuple(dict.fromkeys((*assumed, *facts.assumptions, *routes.assumptions, *assembler.assumptions)))
    roles = read_structure(program).roles
    readings = (_reading(event, facts, routes, assembler, roles, text) for event in events)
    return Translation(program, tuple(readings), assumptions)


def _deeds(facts: Facts) -> set[str]:
    """Return what the hero is told to do: "dec" (slow down), "stop", "go"."""
    deeds = {"go" if phase.kind in ("acc", "go", "turn") else "dec" for phase in facts.phases}
    return deeds | ({"stop"} if any(phase.to_stop for phase in facts.phases) else set())


def _complete(facts: Facts, text: str, name: str) -> None:
    place = Place(name, text, Span(0, len(text)))
    for actor in (EGO_ID, HERO_ID):
        if actor not in facts.mentioned:
            what = "no ego" if actor == EGO_ID else "no other vehicle"
            raise TranslationError(
                f"there is {what} in the description",
                place=place,
                found=text[:60],
                expected="the ego (the vehicle under test) and one hero (the other vehicle)",
                fix="say where each of them is and what it wants",
            )
    if not facts.phases:
        raise TranslationError(
            "there is no interaction: it is not said what the hero does",
            place=place,
            found=text[:60],
            expected="a hero that brakes, stops, accelerates or turns when something happens",
            fix="add for example 'the hero brakes to a stop 5 m behind the conflict point'",
        )
    slowing = [phase for phase in facts.phases if phase.kind == "dec"]
    goes_on = len(facts.phases) > 1 and slowing and slowing[0].to_speed is not None and not slowing[0].to_stop
    _refuse_at_once(facts, text, name)
    if facts.not_yielding is not None and slowing and not (goes_on and facts.not_yielding.verb == "stop"):
        event = facts.not_yielding
        raise TranslationError(
            "the hero is said to stop and not to stop",
            place=Place(name, text, event.span),
            found=event.span.excerpt(text),
            expected=slowing[0].events[0].span.excerpt(text),
            fix="say one of them",
        )


def _refuse_at_once(facts: Facts, text: str, name: str) -> None:
    """Refuse "brakes and at the same moment accelerates"."""
    if {phase.kind for phase in facts.phases} >= {"dec", "acc"} and len(_AT_TRIGGER.findall(text)) > 1:
        again = list(_AT_TRIGGER.finditer(text))[-1]
        raise TranslationError(
            "the hero is said to slow down and to speed up at one time",
            place=Place(name, text, Span(*again.span())),
            found=again.group(),
            expected="one after the other",
            fix="say which comes first",
        )
    for first, second in itertools.pairwise(facts.phases):
        span = first.events[0].span.union((second.goal_event or second.events[-1]).span)
        if {first.kind, second.kind} >= {"dec", "acc"} and (found := _AT_ONCE.search(span.excerpt(text))):
            raise TranslationError(
                "the hero is said to slow down and to speed up at one time",
                place=Place(name, text, span),
                found=found.group(),
                expected="one after the other",
                fix="say which comes first",
            )


def _deeds_done(facts: Facts, phrases: Phrases, text: str, name: str) -> None:
    """Refuse "its braking begins when ..." where the hero does not brake."""
    for kinds, span in phrases.onsets:
        if not any(phase.kind in kinds for phase in facts.phases):
            raise TranslationError(
                "something begins here that the hero is not said to do",
                place=Place(name, text, span),
                found=span.excerpt(text),
                expected="the beginning of what the hero does",
                fix="say in a sentence what the hero does",
            )


def _all_amounts_used(program: Program, tokens: list[Token], text: str, name: str) -> None:
    """Refuse a text with a number or a parameter that no constraint holds: a last guard against dropping a clause."""
    used = {
        node.span
        for constraint in program.constraints
        for node in walk(constraint.formula)
        if isinstance(node, Number | ParameterRef)
    }
    for token in tokens:
        if token.quantity is not None and token.quantity.term.span not in used and token.quantity.span not in used:
            raise TranslationError(
                f"'{token.text}' was read but could not be used",
                place=Place(name, text, token.span),
                found=token.text,
                expected="a place, time, speed or rate that fits the clause",
                fix="say it in a sentence of its own",
            )


def _reading(
    event: Event, facts: Facts, routes: Itineraries, assembler: Assembler, roles: Mapping[str, Role], text: str
) -> Reading:
    ids = tuple(dict.fromkeys(assembler.ids.get(id(event), ())))
    parts = list(
        dict.fromkeys([*(ROLES[roles[identifier]] for identifier in ids), *facts.understood.get(id(event), ())])
    )
    tells_route = any(said.event is event for wishes in facts.wishes.values() for said in wishes.values())
    if (tells_route or not parts) and event.actor is not None:
        parts.append(f"the {ACTOR_NAMES[event.actor]}'s route: {routes.of(event.actor)}")
    span = event.span.whole_words(text)  # where words were put in another order it may begin within one
    return Reading(span, span.excerpt(text), "; ".join(parts), ids)
