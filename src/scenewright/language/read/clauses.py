"""Reads one clause: chunks attach to each other by type and dimension, and what carries meaning must be used up.

What enters: the chunks of a clause, and who its people are. What leaves: a `Clause` with what is said of its subject,
or an `UnknownWordsError` with the words that nothing could be made of. Order decides only what is nearest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Protocol

from scenewright.errors import UnknownWordsError
from scenewright.language.compile import COMPASS
from scenewright.language.read.chunks import Chunk
from scenewright.language.story import Amount, Measure, Operator, Place, Quantity, Quote
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.program.types import EGO

_OPERATORS: dict[str, Operator] = {"==": "==", ">=": ">=", "<=": "<=", ">": ">", "<": "<"}
_BARE: dict[str, Operator] = {
    "at": "==", "to": "==", "at or past": ">=", "past": ">", "at or before": "<=", "before": "<", "behind": "<",
}  # fmt: skip
_TO_PLACE = ("before", "behind", "from", "to", "ahead", "of")
_CONFLICTS = ("conflict_point", "intersection", "turn")


class People(Protocol):
    """Who is meant by a chunk."""

    def who(self, chunk: Chunk) -> int:
        """Return the number of the actor that a mention means."""
        ...

    def whom(self, chunk: Chunk, subject: int | None) -> int:
        """Return the one that "it" means who is not the subject."""
        ...

    def where(self, chunk: Chunk) -> Place:
        """Return the place that "it" means."""
        ...

    def went(self, place: Place) -> None:
        """Note that a place was spoken of."""
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
    """

    quote: Quote
    subject: int | None = None
    deed: str | None = None
    phase: str | None = None
    ordinal: int = 0
    measures: list[Measure] = field(default_factory=list)
    rate: Measure | None = None
    times: dict[str, tuple[Operator, Amount]] = field(default_factory=dict)
    facts: dict[str, str] = field(default_factory=dict)
    flags: set[str] = field(default_factory=set)
    relations: list[tuple[str, int, Quote]] = field(default_factory=list)  # of its way to that of another
    waiting: list[tuple[Operator, Chunk]] = field(default_factory=list)  # amounts without a target
    target: tuple[str, Chunk] | None = None  # the last side and place or actor


@dataclass(slots=True)
class _Target:
    at: int
    side: str
    chunk: Chunk
    place: Place | None
    other: int | None
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
    return _Reader(list(chunks), people).read(neighbour, subject)


@dataclass(slots=True)
class _Reader:
    chunks: list[Chunk]
    people: People
    at: int = 0
    clause: Clause = field(init=False)
    amounts: list[tuple[int, Operator, Chunk, str]] = field(default_factory=list)  # with the factor after it
    targets: list[_Target] = field(default_factory=list)
    quantity: str | None = None

    def read(self, neighbour: Clause | None, subject: int | None) -> Clause:
        first, last = self.chunks[0], self.chunks[-1]
        text = " ".join(chunk.text for chunk in self.chunks)
        self.clause = Clause(Quote(first.start, last.end, text))
        while self.at < len(self.chunks):
            self._take(self.chunks[self.at])
            self.at += 1
        if self.clause.subject is None:
            self.clause.subject = subject
        self._attach(neighbour)
        return self.clause

    def _peek(self, ahead: int = 1) -> Chunk | None:
        return self.chunks[self.at + ahead] if self.at + ahead < len(self.chunks) else None

    def _left_over(self, chunk: Chunk) -> UnknownWordsError:
        return UnknownWordsError(
            f"'{chunk.text}' could not be understood here",
            found=self.clause.quote.text,
            expected="a number with a unit, such as 12 m" if chunk.kind == "no unit" else None,
            fix="say it as `scenewright tell` would",
        )

    def _take(self, chunk: Chunk) -> None:
        clause, value = self.clause, chunk.value
        match chunk.kind:
            case "pronoun" if value == "it" and self._has_event("pass"):
                self.targets.append(_Target(self.at, "at", chunk, self.people.where(chunk), None))
            case "actor" | "pronoun" | "name":
                self._person(chunk)
            case "be" | "mood" | "harmless" | "comma":
                pass
            case "possessive" if isinstance(self._peek(), Chunk):
                pass
            case "bound":
                following = self._peek()
                if following is None or (following.kind != "amount" and following.value != "as fast as"):
                    raise self._left_over(chunk)
            case "amount":
                self._amount(chunk)
            case "near":
                just = Amount(JUST_BEFORE_M, "m", None, chunk.quote)
                self.amounts.append((self.at, "==", replace(chunk, amount=just), ""))
                self._target("before")
            case "side":
                self._side(chunk)
            case "place" if self._has_event("pass"):
                self.at -= 1
                self._target("at")
            case "deed" if clause.deed is None:
                clause.deed = value
            case "phase" if clause.phase is None:
                clause.phase = value
            case "ordinal":
                clause.ordinal = int(value)
            case "standstill":
                clause.flags.add("standstill")
            case "relation":
                clause.relations.append((value, EGO, chunk.quote))
            case "state" | "event" | "open" | "order":
                clause.flags.add(value)
            case "quantity" if self.quantity in (None, "rate", value):
                self.quantity = value
            case "factor" if value == "as fast as" or self._peek_is("side", "than"):
                self._factor(chunk)
            case "link" if value == "then" and self._is_between("heading"):
                pass
            case "turn" | "heading" | "origin" | "then_headed" | "area" | "lanes":
                self._way(chunk)
            case _:
                raise self._left_over(chunk)

    def _peek_is(self, kind: str, value: str) -> bool:
        following = self._peek()
        return following is not None and (following.kind, following.value) == (kind, value)

    def _is_between(self, kind: str) -> bool:
        following = self._peek()
        return (
            self.at > 0 and self.chunks[self.at - 1].kind == kind and following is not None and following.kind == kind
        )

    def _has_event(self, name: str) -> bool:
        return name in self.clause.flags

    def _person(self, chunk: Chunk) -> None:
        if chunk.value == "its":
            return
        if self.clause.subject is not None:
            raise self._left_over(chunk)
        named = self._named(chunk)
        self.clause.subject = self.people.who(named)

    def _named(self, chunk: Chunk) -> Chunk:
        """Return a mention together with the name in quotes after it."""
        following = self._peek()
        if chunk.kind == "actor" and following is not None and following.kind == "name":
            self.at += 1
            return replace(following, kind=f"name of {chunk.value}")
        return chunk

    def _amount(self, chunk: Chunk) -> None:
        before = self.chunks[self.at - 1] if self.at else None
        op: Operator = "=="
        if before is not None and before.kind == "bound":
            op = _OPERATORS.get(before.value, "==")
        lead = self.at - (2 if before is not None and before.kind == "bound" else 1)
        after = self._peek(1), self._peek(2)
        assert chunk.amount is not None
        if chunk.amount.dimension == "time" and lead >= 0 and self.chunks[lead].value == "for":
            self.clause.times["for"] = (op, chunk.amount)
        elif (
            after[0] is not None
            and after[0].value == "after"
            and after[1] is not None
            and after[1].value == "the start"
        ):
            self.clause.times["after the start"] = (op, chunk.amount)
            self.at += 2
        else:
            self.amounts.append((self.at, op, chunk, ""))

    def _side(self, chunk: Chunk) -> None:
        following = self._peek()
        if following is None:
            raise self._left_over(chunk)
        if following.kind in ("place", "actor", "name", "pronoun"):
            self._target(chunk.value)
        elif chunk.value == "to" and following.kind == "event":
            pass  # "speeds up to pass the conflict point"
        elif following.kind == "area" and chunk.value in ("at", "into", "from"):
            self._area(chunk.value, following)
        elif chunk.value in ("at", "of", "for", "to", "with") and following.kind in ("amount", "bound", "quantity"):
            if chunk.value == "to":
                self.clause.flags.add("to")
        else:
            raise self._left_over(chunk)

    def _target(self, side: str) -> None:
        """Take the place or the actor after a side, with whose the place is and with whom."""
        at = self.at
        self.at += 1
        chunk = self.chunks[self.at]
        if chunk.value == "its" and self._peek() is not None:
            self.at += 1
            chunk = self.chunks[self.at]
        if chunk.kind == "pronoun":
            self._it(at, side, chunk)
        elif chunk.kind == "place":
            place = self._whose(chunk)
            self.targets.append(_Target(at, side, chunk, place, None))
        else:
            named = self._named(chunk)
            owned = self._peek()
            self.at += 1
            if owned is not None and owned.kind == "possessive" and self._peek() is not None:
                self.at += 1
                owner = self.people.who(named)
                place = replace(self._whose(self.chunks[self.at]), of=owner)
                self.targets.append(_Target(at, side, chunk, place, None))
            else:
                self.at -= 1
                self.targets.append(_Target(at, side, chunk, None, self.people.who(named)))

    def _it(self, at: int, side: str, chunk: Chunk) -> None:
        """Take "it" after a side: who somebody is ahead of or behind, else the place that was spoken of last."""
        if side in ("ahead", "behind"):
            self.targets.append(_Target(at, side, chunk, None, self.people.whom(chunk, self.clause.subject)))
        else:
            self.targets.append(_Target(at, side, chunk, self.people.where(chunk), None))

    def _whose(self, chunk: Chunk) -> Place:
        if chunk.kind != "place":
            raise self._left_over(chunk)
        of = partner = None
        for side in ("of", "with"):
            link, who = self._peek(1), self._peek(2)
            if link is None or link.value != side or who is None or who.kind not in ("actor", "name"):
                continue
            if side == "with" and chunk.value not in _CONFLICTS:
                continue
            self.at += 2
            person = self.people.who(self._named(self.chunks[self.at]))
            of, partner = (person, partner) if side == "of" else (of, person)
        place = Place(chunk.value, of, partner)
        self.people.went(place)
        return place

    def _factor(self, chunk: Chunk) -> None:
        previous = self.amounts[-1] if self.amounts and self.amounts[-1][0] == self.at - 1 else None
        before = self.chunks[self.at - 1] if self.at else None
        ahead = 1 if chunk.value == "as fast as" else 2
        who = self._peek(ahead)
        if who is None or who.kind not in ("actor", "name"):
            raise self._left_over(chunk)
        self.at += ahead
        other = self.people.who(self._named(self.chunks[self.at]))
        amount, op = None, _OPERATORS["=="]
        if chunk.value == "as fast as":
            op = _OPERATORS.get(before.value, "==") if before is not None and before.kind == "bound" else "=="
        elif previous is not None:
            self.amounts.pop()
            op, amount = previous[1], previous[2].amount
        else:
            op = ">" if chunk.value == "faster" else "<"
        slower = chunk.value == "slower" and amount is not None
        self._measure(Quantity.SPEED, op, amount, other=other, opposite=slower, quote=chunk.quote)

    # -- ways ---------------------------------------------------------------------------------------------------------
    def _way(self, chunk: Chunk) -> None:
        facts, value = self.clause.facts, chunk.value
        match chunk.kind:
            case "turn":
                self._fact("turn", value, chunk)
            case "lanes":
                self._fact("lanes", value, chunk)
            case "heading":
                later = "then headed" in facts or ("turn" in facts and facts["turn"] != "straight")
                named = "destination_heading" if later else "heading"
                before = self.chunks[self.at - 2] if self.at > 1 else None
                if before is not None and before.kind == "heading":  # "north, then south"
                    facts["headings"] = facts.get("headings", facts.pop("heading", "")) + value
                else:
                    self._fact(named, value, chunk)
            case "then_headed":
                facts["then headed"] = ""
            case "origin":
                following = self._peek()
                if following is None or following.kind not in ("area", "heading"):
                    raise self._left_over(chunk)
                self.at += 1
                if following.kind == "heading":  # who comes from the east is headed west
                    opposite = COMPASS[(COMPASS.index(following.value) + 2) % 4]
                    self._fact("heading", opposite, following)
                else:
                    self._fact("origin", following.value, following)
            case _:
                self._area("", chunk)

    def _area(self, side: str, chunk: Chunk) -> None:
        if side in ("at", "into", "from"):
            self.at += 1
        facts = self.clause.facts
        onward = side == "into" or ("turn" in facts and facts["turn"] != "straight")
        self._fact("destination" if onward else "origin", chunk.value, chunk)

    def _fact(self, name: str, value: str, chunk: Chunk) -> None:
        if self.clause.facts.get(name, value) != value:
            raise self._left_over(chunk)
        self.clause.facts[name] = value

    # -- measures -----------------------------------------------------------------------------------------------------
    def _measure(
        self,
        quantity: Quantity,
        op: Operator,
        amount: Amount | None,
        place: Place | None = None,
        other: int | None = None,
        opposite: bool = False,
        quote: Quote | None = None,
        actor: int | None = None,
    ) -> None:
        who = self.clause.subject if actor is None else actor
        if who is None:
            raise self._left_over(self.chunks[0])
        if place is not None and place.of == who:
            place = replace(place, of=None)
        self.clause.measures.append(Measure(who, quantity, op, amount, place, other, opposite, quote))

    def _attach(self, neighbour: Clause | None) -> None:
        clause = self.clause
        if "stands" in clause.flags or (clause.deed is not None and clause.deed == "stop"):
            zero = Amount(Fraction(0), "m/s")
            if "stands" in clause.flags:
                self._measure(Quantity.SPEED, "==", zero, quote=clause.quote)
        for name in ("turn_start", "turn_end"):
            if name in clause.flags:
                self._measure(Quantity.PLACE, "==", None, Place(name), quote=clause.quote)
        for at, op, chunk, _ in self.amounts:
            self._place_amount(at, op, chunk, neighbour)
        for target in self.targets:
            if target.used:
                continue
            if target.other is not None and target.side in ("ahead", "behind") and clause.deed is None:
                clause.relations.append((target.side, target.other, target.chunk.quote))
                continue
            if target.place is None or target.side not in _BARE:
                raise self._left_over(target.chunk)
            self._measure(Quantity.PLACE, _BARE[target.side], None, target.place, quote=target.chunk.quote)
        if self._has_event("pass") and not any(each.quantity is Quantity.PLACE for each in clause.measures):
            raise self._left_over(self.chunks[-1])

    def _place_amount(self, at: int, op: Operator, chunk: Chunk, neighbour: Clause | None) -> None:
        amount, clause = chunk.amount, self.clause
        assert amount is not None
        quote = chunk.quote
        if amount.dimension == "speed":
            if "to" in clause.flags and clause.deed is not None:
                clause.flags.add("to speed")
            self._measure(Quantity.SPEED, op, amount, quote=quote)
            return
        if amount.dimension == "acceleration":
            slowing = self.quantity == "deceleration" or clause.deed == "brake"
            clause.flags.add("rate")
            self._measure(Quantity.RATE, op, amount, opposite=slowing, quote=quote)
            if clause.deed is not None:
                clause.rate = clause.measures.pop()
            return
        target = self._nearest(at)
        if target is None and neighbour is not None and neighbour.target is not None:
            side, borrowed = neighbour.target
            if borrowed.kind == "place":
                target = _Target(at, side, borrowed, Place(borrowed.value), None)
        if target is None:
            clause.waiting.append((op, chunk))
            return
        target.used = True
        clause.target = (target.side, target.chunk)
        self._to_target(target, op, amount, quote)

    def _nearest(self, at: int) -> _Target | None:
        """Return the nearest target after an amount that is free, else the nearest before it."""
        free = [target for target in self.targets if not target.used]
        return next((each for each in free if each.at > at), free[-1] if free else None)

    def _to_target(self, target: _Target, op: Operator, amount: Amount, quote: Quote) -> None:
        is_time = amount.dimension == "time"
        if target.place is not None:
            if target.side in ("past", "after") and not is_time:
                self._measure(Quantity.PLACE, op, amount, target.place, opposite=True, quote=quote)
            elif target.side in _TO_PLACE or (target.side == "at" and self.quantity == "time to arrival"):
                quantity = Quantity.ARRIVAL if is_time else Quantity.PLACE
                self._measure(quantity, op, amount, target.place, quote=quote)
            else:
                raise self._left_over(target.chunk)
            return
        other, side, asked = target.other, target.side, self.quantity
        if asked == "time to collision" and is_time and side in ("with", "to"):
            self._measure(Quantity.COLLISION, op, amount, other=other, quote=quote)
        elif is_time and ((asked == "headway" and side in ("to", "behind")) or (asked is None and side == "behind")):
            self._measure(Quantity.HEADWAY, op, amount, other=other, quote=quote)
        elif not is_time and side == "behind" and asked in (None, "gap"):
            self._measure(Quantity.GAP, op, amount, other=other, quote=quote)
        elif not is_time and side == "ahead" and asked in (None, "gap"):
            self._measure(Quantity.GAP, op, amount, other=self.clause.subject, actor=other, quote=quote)
        else:
            raise self._left_over(target.chunk)
