"""The words of the teller for the parts of a story: people, places, amounts, conditions and ways.

What enters: parts of a story. What leaves: phrases of the controlled English, which `read` reads back to the same
parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from scenewright.errors import TranslationError
from scenewright.language.story import (
    Amount,
    Compound,
    Condition,
    Measure,
    Operator,
    Place,
    Quantity,
    Story,
    Verb,
    Way,
    people_in,
)
from scenewright.program.types import EGO
from scenewright.units import format_fraction

BOUNDS: dict[Operator, str] = {"==": "", ">=": "at least ", "<=": "at most ", ">": "more than ", "<": "less than "}
PLACES = {
    "stop_line": "stop line",
    "conflict_point": "conflict point",
    "intersection": "intersection",
    "turn": "turn",
    "turn_start": "start of the turn",
    "turn_end": "end of the turn",
    "junction_start": "start of the junction",
    "junction_end": "end of the junction",
    "route_end": "end of the route",
}
PLAIN_NAMES = ("ego", "hero", "car", "truck", "van", "bus", "taxi")  # told as they are; other names in quotes
COMPASS_WORDS = {"N": "north", "E": "east", "S": "south", "W": "west"}
# Verb: as somebody does it, as it begins, as it ends.
DOES: dict[str, tuple[str, str, str]] = {
    Verb.DRIVE: ("drives on", "drive on", "driving on"),
    Verb.SPEED_UP: ("speeds up", "speed up", "speeding up"),
    Verb.BRAKE: ("brakes", "brake", "braking"),
    Verb.STAND: ("stands still", "stand still", "standing still"),
}
ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
_WITHOUT_AMOUNT: dict[Operator, str] = {
    "==": "is at",
    ">=": "is at or past",
    ">": "is past",
    "<=": "is at or before",
    "<": "is before",
}
_AS_FAST: dict[Operator, str] = {
    "==": "as fast as",
    ">=": "at least as fast as",
    ">": "faster than",
    "<=": "at most as fast as",
    "<": "slower than",
}


def untold(what: str) -> TranslationError:
    """Return the error for a story that the controlled English has no words for."""
    return TranslationError(f"there are no words yet for {what}", fix="write it as a program: see docs/program.md")


def amount(of: Amount) -> str:
    """Return an amount as it was written."""
    return of.name if of.value is None or of.name else f"{format_fraction(of.value)} {of.unit}"  # type: ignore[return-value]


def bounded(op: Operator, of: Amount) -> str:
    """Return an amount with its bound: ``at least 12 m``."""
    return BOUNDS[op] + amount(of)


def listed(phrases: Sequence[str]) -> str:
    """Return phrases joined as one list: ``a, b and c``."""
    return phrases[0] if len(phrases) == 1 else f"{', '.join(phrases[:-1])} and {phrases[-1]}"


def sentence(text: str) -> str:
    """Return `text` as a sentence."""
    return f"{text[0].upper()}{text[1:]}."


@dataclass(frozen=True, slots=True)
class Phrases:
    """The phrases for one story, whose actors have names."""

    story: Story

    def name(self, actor: int) -> str:
        """Return what somebody is called: ``the ego``, or with the name in quotes ``the car 'blue'``."""
        found = next(each for each in self.story.actors if each.id == actor)
        return f"the {found.name}" if found.name in PLAIN_NAMES else f"the {found.kind} '{found.name}'"

    def place(self, place: Place) -> str:
        """Return a place; whose it is where that is somebody else, with whom where that is not the usual one."""
        text = f"the {PLACES[place.name]}"
        text += "" if place.of is None else f" of {self.name(place.of)}"
        return text + ("" if place.partner is None else f" with {self.name(place.partner)}")

    def clauses(self, conditions: Sequence[Condition], it: int | None = None, passing: bool = True) -> list[str]:
        """Return a clause for each condition; who stands at a place is said in one. `it` is who is called so."""
        conditions = sorted(conditions, key=lambda each: not isinstance(each, Measure) or each.actor != it)
        taken: set[int] = set()
        found = []
        for number, condition in enumerate(conditions):
            if number in taken:
                continue
            partner = None
            if isinstance(condition, Measure) and _stands(condition):
                partner = next((index for index, other in enumerate(conditions)
                                if index not in taken and _is_where(other, condition.actor)), None)  # fmt: skip
            if isinstance(condition, Measure) and any(
                _is_where(condition, each.actor) for each in conditions if isinstance(each, Measure) and _stands(each)
            ):
                continue  # told where it stands
            if partner is None or not isinstance(condition, Measure):
                found.append(self.clause(condition, it, passing))
                continue
            taken.add(partner)
            where = self.predicate(conditions[partner]).removeprefix("is ")  # type: ignore[arg-type]
            found.append(f"{self._subject(condition.actor, it)} stands {where}")
        return found

    def clause(self, condition: Condition, it: int | None = None, passing: bool = False) -> str:
        """Return one condition as a clause; `passing` says that it is an event: ``the ego passes the stop line``."""
        if isinstance(condition, Measure):
            return f"{self._subject(condition.actor, it)} {self.predicate(condition, passing)}"
        parts = [self._part(part, condition.joint, it) for part in condition.parts]
        if condition.joint == "not":
            return f"it is not so that {parts[0]}"
        if condition.joint == "if":
            return f"if {parts[0]} then {parts[1]}"
        return f"either {' or '.join(parts)}" if condition.joint == "or" else f"both {' and '.join(parts)}"

    def _part(self, part: Condition, joint: str, it: int | None) -> str:
        """Return a part of a compound: the English has no brackets, so there is only so much inside another."""
        if isinstance(part, Compound):
            inner = [each for each in part.parts if isinstance(each, Compound)]
            fits = {"not": {"or", "and", "if"}, "and": {"or", "if", "not"}, "or": {"if", "not"}, "if": set[str]()}
            flat = all(each.joint == "not" and isinstance(each.parts[0], Measure) for each in inner)
            if joint not in fits[part.joint] or (inner and (part.joint == "not" or not flat)):
                raise untold("conditions inside conditions of conditions")
            if part.joint == "not" and isinstance(part.parts[0], Compound):
                raise untold("conditions inside conditions of conditions")
        return self.clause(part, it)

    def _subject(self, actor: int, it: int | None) -> str:
        return "it" if actor == it else self.name(actor)

    def predicate(self, measure: Measure, passing: bool = False) -> str:
        """Return what a measure says of its actor."""
        bound = "" if measure.amount is None else bounded(measure.op, measure.amount)
        match measure.quantity:
            case Quantity.PLACE if measure.place is not None:
                return self._where(measure, measure.place, bound, passing)
            case Quantity.ARRIVAL if measure.place is not None:
                return f"is {bound} from {self.place(measure.place)}"
            case Quantity.SPEED if measure.other is not None:
                whom = self.name(measure.other)
                if measure.amount is None:
                    return f"drives {_AS_FAST[measure.op]} {whom}"
                return f"drives {bound} {'slower' if measure.opposite else 'faster'} than {whom}"
            case Quantity.SPEED:
                if _stands(measure):
                    return "stands"
                return f"drives at {bound}" if measure.op == "==" else f"drives at a speed of {bound}"
            case Quantity.RATE:
                return f"has {'a deceleration' if measure.opposite else 'an acceleration'} of {bound}"
            case Quantity.GAP if measure.other is not None:
                return f"is {bound} behind {self.name(measure.other)}"
            case Quantity.HEADWAY if measure.other is not None:
                return f"has a headway of {bound} to {self.name(measure.other)}"
            case Quantity.COLLISION if measure.other is not None:
                return f"has a time to collision of {bound} with {self.name(measure.other)}"
        raise untold(f"a {measure.quantity} to nothing")

    def _where(self, measure: Measure, place: Place, bound: str, passing: bool) -> str:
        if bound:
            return f"is {bound} {'past' if measure.opposite else 'before'} {self.place(place)}"
        if measure.op == "==" and place == Place("turn_start"):
            return "begins to turn"
        if measure.op == "==" and place == Place("turn_end"):
            return "completes its turn"
        return f"{'passes' if passing and measure.op == '==' else _WITHOUT_AMOUNT[measure.op]} {self.place(place)}"

    def way(self, way: Way) -> str:
        """Return how somebody drives."""
        if way.lanes:
            return f"follows the lanes {', '.join(way.lanes)}"
        if way.headings:
            return f"is headed {', then '.join(COMPASS_WORDS[each] for each in way.headings)}"
        parts = []
        if way.origin:
            parts.append(f"comes from the {way.origin}")
        if way.heading:
            parts.append(f"is headed {COMPASS_WORDS[way.heading]}")
        if way.turn or way.destination:
            turn = (
                "goes on" if way.turn is None else "goes straight on" if way.turn == "straight" else f"turns {way.turn}"
            )
            parts.append(turn + (f" into the {way.destination}" if way.destination else ""))
        if way.destination_heading:
            parts.append(f"is then headed {COMPASS_WORDS[way.destination_heading]}")
        return listed(parts) if parts else "has an open way"


def speaks_of_ego(conditions: Sequence[Condition]) -> bool:
    """Whether something is asked of the ego."""
    return any(EGO in people_in(condition) for condition in conditions)


def _stands(measure: Measure) -> bool:
    zero = measure.amount == Amount(Fraction(0), "m/s") and measure.other is None
    return zero and measure.quantity is Quantity.SPEED and measure.op == "=="


def _is_where(condition: Condition, actor: int) -> bool:
    """Whether a condition puts somebody at one place, which is not an event of its turn."""
    if not isinstance(condition, Measure) or condition.quantity is not Quantity.PLACE or condition.op != "==":
        return False
    turns = condition.amount is None and condition.place in (Place("turn_start"), Place("turn_end"))
    return condition.actor == actor and not turns
