"""Holds a reply against grammar, checker, map and description; what does not hold goes back in house form.

What enters: a `Reply`, the description, the map. What leaves: the program and how the description was read, or the
first kind of fault found. Nothing that a model wrote is carried out; whether it can happen at all is asked elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from scenewright.errors import Place, ProgramError, Span, TranslationError
from scenewright.program.check import check_program
from scenewright.program.evaluate import landmark_owner
from scenewright.program.expressions import Compare, Derived, Landmark, walk
from scenewright.program.manner import USUAL
from scenewright.program.printer import print_expression
from scenewright.program.structure import actors_of, synchronised
from scenewright.program.text import parse_program
from scenewright.program.types import Constraint, Program
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.model import RoadMap
from scenewright.translate.model.amounts import amount_faults
from scenewright.translate.model.reply import LONGEST_PROGRAM, Reply
from scenewright.translate.translation import Reading

MOST_LINES = 300
DEEPEST = 30
MOST_OPERATORS = 40
_OPERATOR = re.compile(r"[-+*/]|\b(?:and|or|not|implies)\b")
_QUOTED = re.compile(r'"(?:\\.|[^"\\])*"', re.DOTALL)
_MONSTER = re.compile(r"\d{16}|\d[eE][-+]?\d{3}")
_SENTENCE_END = re.compile(r"(?<=[.!?;])\s+|\n+")
_SHOWN_FAULTS = 8
_OF_TURNS = ("turn_start", "turn_end")


@dataclass(frozen=True, slots=True)
class Verified:
    """What a reply says, once it holds."""

    program: Program
    readings: tuple[Reading, ...]


def verify(reply: Reply, description: str, name: str, road_map: RoadMap) -> Verified:
    """Return what `reply` says.

    Raises
    ------
    ProgramError, MapError, ParameterError
        Where its program does not parse, make sense or fit the map.
    TranslationError
        Where it leaves out part of the description, or says something that is not in it.
    """
    text = reply.program or ""
    program = _parsed(text)
    # Name, map, description and manner are ours to say: a reply could name any file as its map, or let anything pass.
    program = replace(program, name=name, map_name=road_map.name, description=description, manner=USUAL)
    check_program(program, text)
    _no_turn_on_straight_routes(ground(program, road_map))
    readings = tuple(_located(reply, description))
    faults = [*_account_faults(reply, program, description, readings)]
    if faults:
        raise TranslationError(
            "the program and the description do not match",
            found="; ".join(faults[:_SHOWN_FAULTS]) + ("; ..." if len(faults) > _SHOWN_FAULTS else ""),
            expected="the whole description in the program and its readings, and nothing else",
        )
    return Verified(_with_sources(program, readings), readings)


def _parsed(text: str) -> Program:
    """Parse what a model wrote, within bounds: a text of a few lines can be made to take for ever."""
    deepest = depth = 0
    for character in text:
        depth += (character in "([") - (character in ")]")
        deepest = max(deepest, depth)
    monster = _MONSTER.search(text)
    longest = max((len(_OPERATOR.findall(line)) for line in _QUOTED.sub("", text).splitlines()), default=0)
    fault = (
        f"{len(text)} characters" if len(text) > LONGEST_PROGRAM
        else f"{text.count(chr(10))} lines" if text.count("\n") > MOST_LINES
        else f"parentheses {deepest} deep" if deepest > DEEPEST
        else f"a line with {longest} operators" if longest > MOST_OPERATORS
        else f"the number {monster[0]}..." if monster
        else None
    )  # fmt: skip
    if fault:
        expected = (
            f"at most {LONGEST_PROGRAM} characters, {MOST_LINES} lines, {MOST_OPERATORS} operators a line, parentheses "
            f"{DEEPEST} deep, sane numbers"
        )
        raise ProgramError("the program is beyond all bounds", found=fault, expected=expected)
    return parse_program(text)


def _no_turn_on_straight_routes(scene: Scene) -> None:
    """Refuse a turn of a vehicle that goes straight on: its landmarks have a number there, but no meaning."""
    for constraint in scene.program.constraints:
        for compare in (node for node in walk(constraint.formula) if isinstance(node, Compare)):
            aims = {id(node.target): node.actor for node in walk(compare) if isinstance(node, Derived)}
            for mark in (node for node in walk(compare) if isinstance(node, Landmark)):
                owner = mark.actor if mark.actor is not None else aims.get(id(mark), landmark_owner(compare))
                if mark.name in _OF_TURNS and owner is not None and scene.routes[owner].turn == "straight":
                    raise ProgramError(
                        f"{scene.program.actor(owner).name} (A{owner}) does not turn",
                        place=Place("program"),
                        found=f"{constraint.id}: {print_expression(constraint.formula)}",
                        expected="a moment on its own way, such as its conflict_point",
                    )


# -- readings -------------------------------------------------------------------------------------------------------
def _located(reply: Reply, description: str) -> Iterator[Reading]:
    """Yield the readings with the places of their words; words that stand there twice are read in order."""
    said: dict[str, int] = {}
    for reading in reply.readings:
        places = locate_all(reading.words, description)
        if places:
            number = said.get(reading.words, 0)
            said[reading.words] = number + 1
            span = places[min(number, len(places) - 1)]
            yield Reading(span, span.excerpt(description), reading.understood, tuple(reading.constraints))


def locate_all(words: str, text: str) -> list[Span]:
    """Return every place where `words` stand in `text`."""
    places: list[Span] = []
    start = 0
    while (span := locate(words, text, start)) is not None:
        places.append(span)
        start = span.end
    return places


def locate(words: str, text: str, start: int = 0) -> Span | None:
    """Return where `words` stand in `text`, whatever the case, spaces and signs between them; None where they do not.

    Examples
    --------
    >>> locate("the  ego, stops", "When the ego stops")
    Span(start=5, end=18)
    """
    found: Span | None = None
    for part in re.split(r"\.\.\.|…", words):
        tokens = re.findall(r"\w+", part)
        if not tokens:
            continue
        pattern = r"(?<!\w)" + r"[^\w]{1,8}".join(re.escape(token) for token in tokens) + r"(?!\w)"
        match = re.compile(pattern, re.IGNORECASE).search(text, found.end if found else start)
        if match is None:
            return None
        span = Span(match.start(), match.end())
        found = span if found is None else found.union(span)
    return found


def _account_faults(reply: Reply, program: Program, description: str, readings: tuple[Reading, ...]) -> Iterator[str]:
    questions = [f"{q.question} {q.default} {q.words}" for q in reply.questions]
    accounts = [*reply.assumptions, *questions]
    covered: list[Span] = []
    for said in reply.readings:
        places = locate_all(said.words, description)
        covered += places
        if not places:
            yield f"the words of a reading are not in the description: '{said.words[:80]}'"
    for span in _sentences(description):
        if not any(each.start < span.end and span.start < each.end for each in covered):
            yield f"no reading tells of '{span.excerpt(description).strip()[:80]}'"
    known = {constraint.id for constraint in program.constraints}
    named = {identifier for reading in readings for identifier in reading.constraint_ids}
    for identifier in sorted(named - known):
        yield f"a reading names {identifier}, but the constraints are c1 to c{len(known)}"
    for constraint in program.constraints:
        said_so = constraint.id in named or any(re.search(rf"\b{constraint.id}\b", each) for each in accounts)
        if not said_so and next(synchronised(constraint.formula), None) is None:
            yield f"no reading and no assumption says where {constraint.id} comes from"
    spoken_of = set().union(*(actors_of(constraint.formula) for constraint in program.constraints), {0})
    for hero in program.heroes:
        if hero.id not in spoken_of:
            yield f"nothing is said of {hero.name} (A{hero.id}): no constraint speaks of it"
    yield from amount_faults(description, program, accounts)


def _sentences(description: str) -> Iterator[Span]:
    """Yield the sentences that have at least two words."""
    start = 0
    ends = [(match.start(), match.end()) for match in _SENTENCE_END.finditer(description)]
    for stop, following in [*ends, (len(description), len(description))]:
        if len(re.findall(r"\w+", description[start:stop])) > 1:
            yield Span(start, stop)
        start = following


def _with_sources(program: Program, readings: tuple[Reading, ...]) -> Program:
    """Let every constraint point at the words that it came from."""
    return replace(program, constraints=tuple(_with_source(each, readings) for each in program.constraints))


def _with_source(constraint: Constraint, readings: tuple[Reading, ...]) -> Constraint:
    source: Span | None = None
    for reading in readings:
        if constraint.id in reading.constraint_ids:
            source = reading.span if source is None else source.union(reading.span)
    return replace(constraint, source=source)


def place_of(words: str, description: str, name: str) -> Place:
    """Return the place of `words` in the description; the description as a whole where they are not in it."""
    span = locate(words, description) if words else None
    return Place(name, description, span or Span(0, len(description)))
