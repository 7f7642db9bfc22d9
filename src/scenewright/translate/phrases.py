"""The words of the teller for the parts of a story: people, places, amounts, conditions and ways.

What enters: parts of a story. What leaves: phrases of the controlled English, which `read` reads back to the same
parts.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeGuard

from scenewright.errors import TranslationError
from scenewright.program.expressions import LANDMARKS, Node
from scenewright.program.printer import print_expression
from scenewright.program.types import EGO, PieceKind
from scenewright.translate import story as st
from scenewright.translate.compile import PIECES
from scenewright.units import format_fraction

BOUNDS: dict[st.Operator, str] = {"==": "", ">=": "at least ", "<=": "at most ", ">": "more than ", "<": "less than "}
PLACES = {name: re.sub(r"(\w+)_(start|end)", r"\2 of the \1", name).replace("_", " ") for name in LANDMARKS}
TURNING = {st.Place("turn_start"): "begins to turn", st.Place("turn_end"): "completes its turn"}
PLAIN_NAMES = ("ego", "hero", "car", "truck", "van", "bus", "taxi")  # told as they are; other names in quotes
COMPASS_WORDS = {"N": "north", "E": "east", "S": "south", "W": "west"}
# Verb: as somebody does it, as it begins, as it ends: "brakes", "brake", "braking".
DOES: dict[str, tuple[str, str, str]] = {
    verb: (re.sub(r"^\w+", r"\g<0>s", verb), str(verb), re.sub(r"^(\w+?)e?\b", r"\1ing", verb)) for verb in st.Verb
}
NO_GAP = st.Amount(Fraction(0), "m")
ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
SIDES: dict[st.Operator, str] = {"==": "at", ">=": "at or past", ">": "past", "<=": "at or before", "<": "before"}


def does(piece: PieceKind, before: int = 0) -> str:
    """Return what somebody does in a piece of a sketch, after so many of its kind: ``brakes for the second time``."""
    verb = DOES[next(verb for verb, kind in PIECES.items() if kind is piece)][0]
    return f"{verb} for the {ORDINALS[before]} time" if 0 < before < len(ORDINALS) else verb


_BY_HAND = "write it as a program: see docs/program.md"
# What to do about words that are not understood: there is a sentence for everything, and models read the others.
OTHERWISE = "say it in plainer words, as in docs/english.md, or let a model read it: --translator PROVIDER:NAME"


def untold(what: str, fix: str = _BY_HAND, of: Node | None = None) -> TranslationError:
    """Return the error for what a story, or the controlled English, has no words for; `of` a program."""
    found = None if of is None else print_expression(of)
    return TranslationError(f"{what} cannot be told in words yet", found=found, fix=fix)


def amount(of: st.Amount) -> str:
    """Return an amount as it was written."""
    return of.name or f"{format_fraction(of.value or Fraction(0))} {of.unit}"


def bounded(op: st.Operator, of: st.Amount) -> str:
    """Return an amount with its bound: ``at least 12 m``."""
    return BOUNDS[op] + amount(of)


def listed(phrases: Sequence[str]) -> str:
    """Return phrases joined as one list: ``a, b and c``."""
    return phrases[0] if len(phrases) == 1 else f"{', '.join(phrases[:-1])} and {phrases[-1]}"


def sentence(text: str) -> str:
    """Return `text` as a sentence."""
    return f"{text[0].upper()}{text[1:]}."


def called(name: str, kind: str = "car") -> str:
    """Return what somebody of a name is called: ``the ego``, or with the name in quotes ``the car 'blue'``."""
    return f"the {name}" if name in PLAIN_NAMES else f"the {kind} '{name}'"


@dataclass(slots=True)
class Phrases:
    """The phrases for one story, whose actors have names."""

    story: st.Story

    def name(self, actor: int) -> str:
        """Return what somebody is called."""
        found = next(each for each in self.story.actors if each.id == actor)
        return called(found.name, found.kind)

    def place(self, place: st.Place, actor: int | None = None) -> str:
        """Return a place of somebody, whose it is where that is somebody else, with whom where it may be unclear."""
        partner = self._partner(place, actor)
        text = f"the {PLACES[place.name]}" + ("" if place.of is None else f" of {self.name(place.of)}")
        return text + ("" if partner is None else f" with {self.name(partner)}")

    def _partner(self, place: st.Place, actor: int | None) -> int | None:
        """Return with whom a place is told: the ego's conflict point with its usual partner too, beside others."""
        owner = actor if place.of is None else place.of
        is_open = (place.name, owner) == ("conflict_point", EGO) and len(self.story.heroes) > 1
        return self.story.heroes[0].id if place.partner is None and is_open else place.partner

    def _told_partners(self, condition: st.Condition) -> set[int]:
        """Return with whom the places of a condition are told to be."""
        found = {self._partner(each.place, each.actor) for each in st.within(condition, st.Measure) if each.place}
        return {each for each in found if each is not None}

    def clauses(self, conditions: Sequence[st.Condition], it: int | None = None, passing: bool = True) -> list[str]:
        """Return a clause for each condition; who stands at a place is said in one. `it` is who is called so."""
        conditions = sorted(conditions, key=lambda each: not isinstance(each, st.Measure) or each.actor != it)
        places: dict[st.Condition, st.Measure] = {}  # where somebody stands, by the condition that it does
        for each in conditions:
            if isinstance(each, st.Measure) and each == st.standstill(each.actor):
                free = [where for where in conditions if _is_where(where, each.actor) and where not in places.values()]
                places.update({each: free[0]} if free else {})
        near = {each: st.not_beyond(each) for each in conditions if isinstance(each, st.Measure)}
        within = {each for each, other in near.items() if other in conditions}  # "at most 5 m before" says both
        told = {*places.values(), *(near[each] for each in within)}
        found, spoken = [], set[int]()
        for each in conditions:
            if each in told:
                continue
            # Whoever alone has been spoken of is "it" from then on.
            known = each.actor if it is None and isinstance(each, st.Measure) and spoken == {each.actor} else it
            spoken |= st.people_in(each) | self._told_partners(each)
            clause = self.clause(each, known, passing and each not in places, each in within)
            where = f" {self.predicate(places[each]).removeprefix('is ')}" if each in places else ""
            found.append(clause + where)
        return found

    def clause(
        self, condition: st.Condition, it: int | None = None, passing: bool = False, within: bool = False
    ) -> str:
        """Return one condition as a clause; `passing` says that it is an event: ``the ego passes the stop line``.

        A bound `within` which somebody is on its side of a place is told without that it may be beyond that.
        """
        if isinstance(condition, st.Measure):
            subject = "it" if condition.actor == it else self.name(condition.actor)
            is_open = not within and st.not_beyond(condition) is not None
            beyond = f" or {'before' if condition.opposite else 'past'} it" if is_open else ""
            return f"{subject} {self.predicate(condition, passing)}{beyond}"
        parts = [self._part(part, condition.joint, it) for part in condition.parts]
        if condition.joint == "not":
            return f"it is not so that {parts[0]}"
        if condition.joint == "if":
            return f"if {parts[0]} then {parts[1]}"
        return f"either {' or '.join(parts)}" if condition.joint == "or" else f"both {' and '.join(parts)}"

    def _part(self, part: st.Condition, joint: str, it: int | None) -> str:
        """Return a part of a compound: the English has no brackets, so there is only so much inside another."""
        if isinstance(part, st.Compound):
            inner = [each for each in part.parts if isinstance(each, st.Compound)]
            fits = {"not": {"or", "and", "if"}, "and": {"or", "if", "not"}, "or": {"if", "not"}, "if": set[str]()}
            flat = all(each.joint == "not" and isinstance(each.parts[0], st.Measure) for each in inner)
            if joint not in fits[part.joint] or (inner and (part.joint == "not" or not flat)):
                raise untold("conditions inside conditions of conditions")
        return self.clause(part, it)

    def predicate(self, measure: st.Measure, passing: bool = False) -> str:
        """Return what a measure says of its actor."""
        bound = "" if measure.amount is None else bounded(measure.op, measure.amount)
        match measure.quantity:
            case st.Quantity.PLACE if measure.place is not None:
                return self._where(measure, measure.place, bound, passing)
            case st.Quantity.ARRIVAL if measure.place is not None:
                return f"is {bound} from {self.place(measure.place, measure.actor)}"
            case st.Quantity.SPEED if measure.other is not None:
                whom = self.name(measure.other)
                if measure.amount is None:
                    fast = {">": "faster than", "<": "slower than"}.get(measure.op, f"{BOUNDS[measure.op]}as fast as")
                    return f"drives {fast} {whom}"
                return f"drives {bound} {'slower' if measure.opposite else 'faster'} than {whom}"
            case st.Quantity.SPEED:
                if measure == st.standstill(measure.actor):
                    return "stands"
                return f"drives at {bound}" if measure.op == "==" else f"drives at a speed of {bound}"
            case st.Quantity.RATE:
                return f"has {'a deceleration' if measure.opposite else 'an acceleration'} of {bound}"
            case st.Quantity.GAP if measure.other is not None:
                bound = "" if (measure.op, measure.amount) == (">", NO_GAP) else f"{bound} "
                return f"is {bound}behind {self.name(measure.other)}"
            case st.Quantity.FREE_SPACE | st.Quantity.HEADWAY if measure.other is not None:
                return f"has a {measure.quantity} of {bound} {self._beside(measure, 'to')} {self.name(measure.other)}"
            case st.Quantity.COLLISION if measure.other is not None:
                return f"has a time to collision of {bound} {self._beside(measure, 'with')} {self.name(measure.other)}"
        raise untold(f"a {measure.quantity} to nothing")

    def _beside(self, measure: st.Measure, side: str) -> str:
        """Return the side on which somebody has a headway: "behind" where the other is told to be that, too."""
        people = {each.id: each for each in self.story.actors}
        told = st.rears(people[measure.actor], people[measure.other or EGO], self.story.told)
        return "behind" if measure.other in told else side

    def _where(self, measure: st.Measure, place: st.Place, bound: str, passing: bool) -> str:
        if bound:
            return f"is {bound} {'past' if measure.opposite else 'before'} {self.place(place, measure.actor)}"
        if measure.op == "==" and place in TURNING:
            return TURNING[place]
        does = "passes" if passing and measure.op == "==" else f"is {SIDES[measure.op]}"
        return f"{does} {self.place(place, measure.actor)}"

    def way(self, way: st.Way) -> str:
        """Return how somebody drives."""
        if way.lanes:
            return f"follows the lanes {', '.join(way.lanes)}"
        if way.headings:
            return f"is headed {', then '.join(COMPASS_WORDS[each] for each in way.headings)}"
        onward = {None: "goes on", "straight": "goes straight on"}.get(way.turn, f"turns {way.turn}")
        into = f"{onward} into the {way.destination}" if way.destination else onward if way.turn else None
        parts = (
            way.origin and f"comes from the {way.origin}",
            way.heading and f"is headed {COMPASS_WORDS[way.heading]}",
            into,
            way.destination_heading and f"is then headed {COMPASS_WORDS[way.destination_heading]}",
        )
        return listed([each for each in parts if each] or ["has an open way"])


def _is_where(condition: st.Condition, actor: int) -> TypeGuard[st.Measure]:
    """Whether a condition puts somebody at one place, which is not an event of its turn."""
    if not isinstance(condition, st.Measure) or (condition.amount is None and condition.place in TURNING):
        return False
    return (condition.actor, condition.quantity, condition.op) == (actor, st.Quantity.PLACE, "==")
