"""Reads one clause: chunks attach to each other by type and dimension, and what carries meaning must be used up.

What enters: the chunks of a clause, and who its people are. What leaves: a `Clause` with what is said of its subject,
or an `UnknownWordsError` with the words that nothing could be made of. Order decides only what is nearest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from fractions import Fraction
from typing import Protocol

from scenewright.errors import UnknownWordsError
from scenewright.language import story as st
from scenewright.language.compile import COMPASS
from scenewright.language.read.chunks import Chunk
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.program.types import EGO

PEOPLE = ("actor", "name", "pronoun")
_OPERATORS: dict[str, st.Operator] = {"==": "==", ">=": ">=", "<=": "<=", ">": ">", "<": "<"}
_BARE: dict[str, st.Operator] = {  # a side and a place, without an amount
    "at": "==", "to": "==", "at or past": ">=", "past": ">", "at or before": "<=", "before": "<", "behind": "<",
}  # fmt: skip
_TO_PLACE = ("before", "behind", "from", "to", "ahead", "of")
_CONFLICTS = ("conflict_point", "intersection", "turn")
# What is asked for, and the side on which the other actor stands: the quantity, by whether the amount is a time.
_TO_ACTOR = {
    (None, "behind", False): st.Quantity.GAP, ("gap", "behind", False): st.Quantity.GAP,
    (None, "ahead", False): st.Quantity.GAP, ("gap", "ahead", False): st.Quantity.GAP,
    (None, "behind", True): st.Quantity.HEADWAY, ("headway", "behind", True): st.Quantity.HEADWAY,
    ("headway", "to", True): st.Quantity.HEADWAY, ("time to collision", "with", True): st.Quantity.COLLISION,
    ("time to collision", "to", True): st.Quantity.COLLISION,
}  # fmt: skip


class People(Protocol):
    """Who, and which place, is meant in `text`; `place` was spoken of last."""

    text: str
    place: st.Place | None

    def who(self, chunk: Chunk) -> int:
        """Return the number of the actor that a mention means."""
        ...

    def whom(self, chunk: Chunk, subject: int | None) -> int:
        """Return the one that "it" means who is not the subject."""
        ...

    def where(self, chunk: Chunk) -> st.Place:
        """Return the place that "it" means."""
        ...


@dataclass(slots=True)
class Clause:
    """What one clause says.

    Attributes
    ----------
    measures
        What is so of the subject: places, speeds, gaps, events.
    rate
        How hard it brakes or speeds up, where it does so in this clause.
    times
        Amounts of time that say when, or for how long: ``for 3 s``, ``5 s after the start``.
    facts
        Of its way: ``heading``, ``turn``, ``origin``, ...
    flags
        What else it says: ``standstill``, ``while`` (the end is open), ``to`` a speed, ``first``,
        ``kept`` (its speed), ``way`` (it is open).
    waiting, target
        Amounts without a place, and the last place that an amount was counted to, for a neighbour.
    """

    quote: st.Quote
    subject: int | None = None
    deed: str | None = None
    phase: str | None = None
    ordinal: int = 0
    measures: list[st.Measure] = field(default_factory=list)
    rate: st.Measure | None = None
    times: dict[str, tuple[st.Operator, st.Amount]] = field(default_factory=dict)
    facts: dict[str, str] = field(default_factory=dict)
    flags: set[str] = field(default_factory=set)
    relations: list[st.Relation] = field(default_factory=list)
    waiting: list[Chunk] = field(default_factory=list)
    target: tuple[str, st.Place] | None = None

    def says_more_than(self, *expected: str) -> bool:
        """Whether anything but these attributes is filled: what carries meaning must be used up."""
        known = {*expected, "quote", "subject", "target"}
        return any(getattr(self, each.name) for each in fields(self) if each.name not in known)


@dataclass(slots=True)
class _Target:
    at: int
    side: str
    chunk: Chunk
    place: st.Place | None = None
    other: int | None = None
    used: bool = False


def read_clause(
    chunks: Sequence[Chunk], people: People, neighbour: Clause | None = None, subject: int | None = None
) -> Clause:
    """Return what `chunks` say of whom they name, else of `subject`; a lone amount takes the place of its neighbour.

    Raises
    ------
    UnknownWordsError
        Where something that carries meaning is left over.
    """
    reader = _Reader(list(chunks), people)
    while reader.at < len(reader.chunks):
        reader.take(reader.chunks[reader.at])
        reader.at += 1
    reader.attach(neighbour, subject)
    return reader.clause


@dataclass(slots=True)
class _Reader:
    """Takes one chunk after the other; `at` is the last one taken."""

    chunks: list[Chunk]
    people: People
    at: int = 0
    clause: Clause = field(init=False)
    amounts: list[tuple[int, st.Operator, Chunk]] = field(default_factory=list)
    targets: list[_Target] = field(default_factory=list)
    states: set[str] = field(default_factory=set)
    quantity: str | None = None

    def __post_init__(self) -> None:
        start, end = self.chunks[0].start, self.chunks[-1].end
        self.clause = Clause(st.Quote(start, end, self.people.text[start:end]))

    def _peek(self, ahead: int = 1) -> tuple[str, str]:
        """Return kind and value of a chunk from here; nothing where there is none."""
        at = self.at + ahead
        return (self.chunks[at].kind, self.chunks[at].value) if 0 <= at < len(self.chunks) else ("", "")

    def _left_over(self, chunk: Chunk) -> UnknownWordsError:
        expected = "a number with a unit, such as 12 m" if chunk.kind == "no unit" else None
        return UnknownWordsError(
            f"'{chunk.text}' could not be understood here",
            found=self.clause.quote.text,
            expected=expected,
            fix="say it as `scenewright tell` would",
        )

    def take(self, chunk: Chunk) -> None:
        """Take the chunk at `at`, and those behind it that belong to it."""
        clause, value = self.clause, chunk.value
        match chunk.kind:
            case "pronoun" if value == "it" and "pass" in self.states:
                self.targets.append(_Target(self.at, "at", chunk, self.people.where(chunk)))
            case "pronoun" if value == "its":
                pass
            case "actor" | "pronoun" | "name" if clause.subject is None:
                clause.subject = self.people.who(self._named(chunk))
            case "be" | "mood" | "harmless" | "possessive":
                pass
            case "bound" if self._peek()[0] == "amount" or self._peek()[1] == "as fast as":
                pass
            case "amount":
                self._amount(chunk)
            case "near":
                just = st.Amount(JUST_BEFORE_M, "m", None, chunk.quote)
                self.amounts.append((self.at, "==", replace(chunk, amount=just)))
                self._target("before")
            case "side":
                self._side(chunk)
            case "place" if "pass" in self.states:
                self.at -= 1
                self._target("at")
            case "deed" if clause.deed is None:
                clause.deed = value
            case "phase" if clause.phase is None:
                clause.phase = value
            case "ordinal":
                clause.ordinal = int(value)
            case "standstill" | "open" | "order" | "kept":
                clause.flags.add("standstill" if chunk.kind == "standstill" else value)
            case "relation":
                clause.relations.append(st.Relation(value, EGO, chunk.quote))
            case "state" | "event":
                self.states.add(value)
            case "quantity" if self.quantity in (None, "rate", value):
                self.quantity = value
            case "factor" if value == "as fast as" or self._peek() == ("side", "than"):
                self._factor(chunk)
            case "link" if value == "then" and self._peek(-1)[0] == self._peek()[0] == "heading":
                pass
            case "turn" | "heading" | "origin" | "then_headed" | "area" | "lanes":
                self._way(chunk)
            case _:
                raise self._left_over(chunk)

    def _named(self, chunk: Chunk) -> Chunk:
        """Return a mention together with the name in quotes after it."""
        if chunk.kind == "actor" and self._peek()[0] == "name":
            self.at += 1
            return replace(self.chunks[self.at], kind=f"name of {chunk.value}")
        return chunk

    def _bound(self) -> st.Operator:
        kind, value = self._peek(-1)
        return _OPERATORS.get(value, "==") if kind == "bound" else "=="

    def _amount(self, chunk: Chunk) -> None:
        op, amount = self._bound(), chunk.amount
        assert amount is not None
        lead = self._peek(-2 if self._peek(-1)[0] == "bound" else -1)
        if amount.dimension == "time" and lead == ("side", "for"):
            self.clause.times["for"] = (op, amount)
        elif (self._peek(1)[1], self._peek(2)[1]) == ("after", "the start"):
            self.clause.times["after the start"] = (op, amount)
            self.at += 2
        else:
            self.amounts.append((self.at, op, chunk))

    def _side(self, chunk: Chunk) -> None:
        side, (kind, _) = chunk.value, self._peek()
        if kind in ("place", *PEOPLE):
            self._target(side)
        elif kind == "area" and side in ("at", "into", "from"):
            self.at += 1
            self._area(self.chunks[self.at], onward=side == "into")
        elif side == "to" and kind == "amount" and self.clause.deed is not None:
            self.clause.flags.add("to")
        elif not (
            (side == "to" and kind == "event")  # "speeds up to pass the conflict point"
            or (side in ("at", "of", "for", "to", "with") and kind in ("amount", "bound", "quantity", "kept"))
        ):
            raise self._left_over(chunk)

    def _target(self, side: str) -> None:
        """Take the place or the actor after a side, with whose the place is and with whom."""
        at = self.at
        self.at += 2 if self._peek()[1] == "its" else 1
        if self.at >= len(self.chunks):
            raise self._left_over(self.chunks[at])
        chunk = self.chunks[self.at]
        if chunk.kind == "pronoun":  # who somebody is ahead of or behind, else the place that was spoken of last
            if side in ("ahead", "behind"):
                whom = self.people.whom(chunk, self.clause.subject)
                self.targets.append(_Target(at, side, chunk, other=whom))
            else:
                self.targets.append(_Target(at, side, chunk, self.people.where(chunk)))
        elif chunk.kind == "place":
            self.targets.append(_Target(at, side, chunk, self._place(chunk)))
        else:
            who = self.people.who(self._named(chunk))
            if self._peek()[0] == "possessive" and self._peek(2)[0] == "place":
                self.at += 2
                place = replace(self._place(self.chunks[self.at]), of=who)
                self.targets.append(_Target(at, side, chunk, place))
            else:
                self.targets.append(_Target(at, side, chunk, other=who))

    def _place(self, chunk: Chunk) -> st.Place:
        place = st.Place(chunk.value)
        for side in ("of", "with"):
            if self._peek()[1] != side or self._peek(2)[0] not in ("actor", "name"):
                continue
            if side == "of" or chunk.value in _CONFLICTS:
                self.at += 2
                person = self.people.who(self._named(self.chunks[self.at]))
                place = replace(place, of=person) if side == "of" else replace(place, partner=person)
        self.people.place = place
        return place

    def _factor(self, chunk: Chunk) -> None:
        """Take "2 m/s faster than the ego", "at least as fast as the ego"."""
        op, amount = self._bound(), None
        if chunk.value != "as fast as":
            op = ">" if chunk.value == "faster" else "<"
            if self.amounts and self.amounts[-1][0] == self.at - 1:
                _, op, before = self.amounts.pop()
                amount = before.amount
            self.at += 1
        if self._peek()[0] not in ("actor", "name"):
            raise self._left_over(chunk)
        self.at += 1
        other = self.people.who(self._named(self.chunks[self.at]))
        slower = chunk.value == "slower" and amount is not None
        self._measure(chunk, st.Measure(EGO, st.Quantity.SPEED, op, amount, other=other, opposite=slower))

    # -- ways ---------------------------------------------------------------------------------------------------------
    def _way(self, chunk: Chunk) -> None:
        facts, value = self.clause.facts, chunk.value
        if chunk.kind == "heading" and self._peek(-2)[0] == "heading":  # "north, then south"
            facts["headings"] = facts.get("headings", facts.pop("heading", "")) + value
        elif chunk.kind == "heading":
            later = "then" in facts or facts.get("turn", "straight") != "straight"
            self._fact("destination_heading" if later else "heading", chunk)
        elif chunk.kind == "area":
            self._area(chunk)
        elif chunk.kind == "origin" and self._peek()[0] in ("area", "heading"):
            self.at += 1
            following = self.chunks[self.at]
            if following.kind == "heading":  # who comes from the east is headed west
                opposite = COMPASS[(COMPASS.index(following.value) + 2) % 4]
                self._fact("heading", replace(following, value=opposite))
            else:
                self._fact("origin", following)
        elif chunk.kind == "origin":
            raise self._left_over(chunk)
        else:
            self._fact("then" if chunk.kind == "then_headed" else chunk.kind, chunk)

    def _area(self, chunk: Chunk, onward: bool = False) -> None:
        turned = self.clause.facts.get("turn", "straight") != "straight" and self._peek(-1) != ("side", "from")
        self._fact("destination" if onward or turned else "origin", chunk)

    def _fact(self, name: str, chunk: Chunk) -> None:
        if self.clause.facts.setdefault(name, chunk.value) != chunk.value:
            raise self._left_over(chunk)

    # -- measures -----------------------------------------------------------------------------------------------------
    def _measure(self, chunk: Chunk, measure: st.Measure) -> None:
        """Add a measure of the subject, whoever it was made for."""
        who, place = self.clause.subject, measure.place
        if who is None:
            raise self._left_over(self.chunks[0])
        place = replace(place, of=None) if place is not None and place.of == who else place
        self.clause.measures.append(replace(measure, actor=who, place=place, quote=chunk.quote))

    def attach(self, neighbour: Clause | None, subject: int | None) -> None:
        """Give amounts their targets, and make measures of what stands alone."""
        clause, last = self.clause, self.chunks[-1]
        if clause.subject is None:
            clause.subject = subject
        if "stands" in self.states:
            self._measure(last, st.Measure(EGO, st.Quantity.SPEED, "==", st.Amount(Fraction(0), "m/s")))
        for name in ("turn_start", "turn_end"):
            if name in self.states:
                self._measure(last, st.Measure(EGO, st.Quantity.PLACE, "==", None, st.Place(name)))
        for at, op, chunk in self.amounts:
            self._give(at, op, chunk, neighbour)
        for target in self.targets:
            if target.used:
                continue
            if target.other is not None and target.side in ("ahead", "behind") and clause.deed is None:
                clause.relations.append(st.Relation(target.side, target.other, target.chunk.quote))
            elif target.place is not None and target.side in _BARE:
                op = _BARE[target.side]
                self._measure(target.chunk, st.Measure(EGO, st.Quantity.PLACE, op, None, target.place))
            else:
                raise self._left_over(target.chunk)
        if "pass" in self.states and not any(each.quantity is st.Quantity.PLACE for each in clause.measures):
            raise self._left_over(last)

    def _give(self, at: int, op: st.Operator, chunk: Chunk, neighbour: Clause | None) -> None:
        """Make a measure of an amount, with the nearest free target after it, else before it, else its neighbour's."""
        amount, clause = chunk.amount, self.clause
        assert amount is not None
        if amount.dimension == "speed":
            self._measure(chunk, st.Measure(EGO, st.Quantity.SPEED, op, amount))
        elif amount.dimension == "acceleration":
            slowing = self.quantity == "deceleration" or clause.deed == "brake"
            self._measure(chunk, st.Measure(EGO, st.Quantity.RATE, op, amount, opposite=slowing))
            if clause.deed is not None:
                clause.rate = clause.measures.pop()
        else:
            free = [target for target in self.targets if not target.used]
            target = next((each for each in free if each.at > at), free[-1] if free else None)
            if target is None and neighbour is not None and neighbour.target is not None:
                target = _Target(at, neighbour.target[0], chunk, neighbour.target[1])
            if target is None:
                clause.waiting.append(chunk)
                return
            target.used = True
            self._to_target(target, op, amount, chunk)

    def _to_target(self, target: _Target, op: st.Operator, amount: st.Amount, chunk: Chunk) -> None:
        is_time, side, place = amount.dimension == "time", target.side, target.place
        past = side in ("past", "after") and not is_time
        if place is not None:
            self.clause.target = (side, place)
            quantity = st.Quantity.ARRIVAL if is_time else st.Quantity.PLACE
            if not (past or side in _TO_PLACE or (side == "at" and self.quantity == "time to arrival")):
                raise self._left_over(target.chunk)
            self._measure(chunk, st.Measure(EGO, quantity, op, amount, place, opposite=past))
            return
        asked = _TO_ACTOR.get((self.quantity, side, is_time))
        if asked is None or target.other is None:
            raise self._left_over(target.chunk)
        self._measure(chunk, st.Measure(EGO, asked, op, amount, other=target.other))
        if side == "ahead":  # the other one is behind
            ahead = self.clause.measures.pop()
            self.clause.measures.append(replace(ahead, actor=target.other, other=ahead.actor))
