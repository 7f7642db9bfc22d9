"""Reads measures: "the ego's distance to the stop line is 12 m", "the gap between them is 18 m", "at 4 s TTA of ego".

What enters: the reader's state at some token. What leaves: events with the place, the time to collision or the speed
that was measured. A measure whose vehicle or place is not said is not read, and so refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from scenewright.translate.events import EGO_ID, HERO_ID, Place, Relation
from scenewright.translate.tokens import Quantity
from scenewright.translate.verbs import VerbReader


@dataclass(slots=True)
class Measured:
    """A measure as far as it was read: what, whose, to what, how much."""

    start: int
    end: int
    kind: str
    actor: int | None = None
    target: str | int | None = None
    between: tuple[int, int] | None = None
    relation: Relation = "from"
    quantity: Quantity | None = None
    of_pair: bool = False  # "the gap" needs no vehicles named: there are only two


@dataclass(slots=True)
class MeasureReader(VerbReader):
    """Reads measures, one or several that share a place."""

    def _measure(self) -> bool:
        at, link = self.at, None
        if self.phrases.tag(at, "preposition") in ("at", "with") or self.phrases.tokens[at].text.lower() == "with":
            if self.current is not None and not self.links:
                return False
            at, link = at + 1, "when"
        again = self.links == ["and"] and self.measured_last == len(self.events)
        first = self._measured_at(at, amount_first=link is not None or "when" in self.links or again)
        if first is None or (link is not None and first.kind not in ("length", "time", "headway", "ttc")):
            return False
        found = [first]
        while found[-1].target is None and found[-1].actor is not None and first.kind in ("length", "time"):
            after = found[-1].end
            joined = self.phrases.tag(after, "link") == "and" or self.phrases.tag(after, "comma") is not None
            following = self._measured_at(after + 1, amount_first=True) if joined else None
            if following is None or following.kind != first.kind:
                break
            found.append(following)
        for each in found:
            if each.target is None and isinstance(found[-1].target, str):
                each.target, each.relation = found[-1].target, found[-1].relation
        if any(not self._complete_measure(each) for each in found):
            return False
        if link is not None and "when" not in self.links:
            self.links.append(link)
        for each in found:
            self._open_measure(each)
            self.links = ["and"]
        self.links = []
        self.measured_last = len(self.events)
        return True

    # -- reading one ------------------------------------------------------------------------------------------------
    def _measured_at(self, start: int, *, amount_first: bool) -> Measured | None:
        if amount_first and (found := self._amount_then_measure(start)):
            return found
        owner = self.phrases.possessor(start)
        at = owner[1] if owner else self.phrases.skip_determiner(start)
        actor = owner[0] if owner else None
        if actor is None and (phrase := self.phrases.noun_phrase(at)) and self.phrases.tag(phrase.end, "measure"):
            actor, at = self.phrases.resolve(phrase), phrase.end  # "ego speed is 10 m/s"
        kind = self.phrases.tag(at, "measure")
        of_one = self.phrases.tokens[start].text.lower() == "that" and self.phrases.tag(start + 1, "preposition") in (
            "of",
            "out",
        )
        at = start if of_one else at
        if kind is None and of_one and self.measured_last == len(self.events):
            kind = self.last_kind  # "... is 12 m and that of the hero to the conflict point is 20 m"
        if kind is None:
            return None
        self.last_kind = kind
        measured = Measured(start, at + 1, kind, actor)
        measured.of_pair = self._tells_of_both(at)
        if not self._qualify(measured, 1):
            return None
        at = measured.end
        of = self.phrases.tag(at, "preposition") == "of" and (actor is not None or measured.target is not None)
        if self.phrases.tokens[at].tags.keys() & {"be", "falls", "colon"} or of:
            at = self.phrases.skip_hedges(at + 1)
        measured.quantity = self.phrases.tokens[at].quantity
        return self._with_amount(measured, at)

    def _amount_then_measure(self, start: int) -> Measured | None:
        """Read "4 s TTA of the ego" and "a distance of 25 m between the two"."""
        at = self.phrases.skip_hedges(self.phrases.skip_determiner(start))
        quantity, kind = self.phrases.tokens[at].quantity, self.phrases.tag(at + 1, "measure")
        if quantity is not None and kind is not None:
            found = Measured(start, at + 2, kind, quantity=quantity)
            found.of_pair = self._tells_of_both(at + 1)
        elif quantity is not None and self.phrases.tag(self._after_remain(at), "preposition") == "between":
            if quantity.dimension not in ("length", "time"):  # "with 16 m between the two"
                return None
            at = self._after_remain(at) - 1
            found = Measured(
                start, at + 1, "length" if quantity.dimension == "length" else "headway", quantity=quantity
            )
        elif measured := self.phrases.measured(start):
            kind, quantity, end = measured
            found = Measured(start, end, kind, quantity=quantity)
            found.of_pair = self._tells_of_both(self.phrases.skip_determiner(start))
        else:
            return None
        return self._with_amount(found, found.end - 1)

    def _tells_of_both(self, at: int) -> bool:
        """Whether a measure is one of two vehicles, even where none is named: "the gap", "the headway"."""
        words = self.phrases.tokens[at].text.lower()
        return any(word in words for word in ("gap", "headway", "thw", "spacing", "following", "separation"))

    def _after_remain(self, at: int) -> int:
        """Return the position after "12 m" or "12 m remain"."""
        return (
            at + 2 if self.phrases.tokens[at + 1].text.lower() in ("remain", "remains", "left", "are left") else at + 1
        )

    def _with_amount(self, measured: Measured, at: int) -> Measured | None:
        if measured.quantity is None:
            return None
        self.phrases.check_measure(measured.kind, measured.quantity)
        measured.end = at + 1
        self._qualify(measured, 0)
        return measured

    def _qualify(self, measured: Measured, bare: int) -> bool:
        """Read "between the ego and the stop line", "of the ego", "to it", as many as there are."""
        while True:
            at = measured.end
            if self.phrases.tag(at, "preposition") == "between" and measured.actor is None and measured.target is None:
                if not self._between(measured):
                    return False
            elif self._whose_or_what(measured, at):
                continue
            elif bare and measured.actor is None and self._whose(measured, at):  # "TTA ego 4 s"
                if self.phrases.tokens[measured.end].quantity is None:
                    return False
            else:
                return True

    def _whose_or_what(self, measured: Measured, at: int) -> bool:
        """Read "of the ego" and "to the stop line"."""
        preposition, relation = self.phrases.tag(at, "preposition"), self.phrases.tag(at, "relation")
        if preposition in ("of", "out", "for") and measured.actor is None and self._whose(measured, at + 1):
            return True
        aims = (
            preposition in ("to", "at", "out", "with") or relation is not None or self.phrases.tag(at, "link") == "to"
        )
        return aims and measured.target is None and self._to_what(measured, at, relation)

    def _whose(self, measured: Measured, at: int) -> bool:
        phrase = self.phrases.noun_phrase(at)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        measured.actor, measured.end = self.phrases.resolve(phrase), phrase.end
        return True

    def _to_what(self, measured: Measured, at: int, relation: str | None) -> bool:
        subject = self.phrases.subject
        if measured.actor is not None:
            self.phrases.subject = measured.actor  # "the hero's distance to its stop line"
        found = self.phrases.landmark(at + 1)
        self.phrases.subject = subject
        if found:
            measured.target, measured.end = ("turn_start" if found[0] == "mouth" else found[0]), found[1]
            if found[2] is not None:
                if measured.actor is not None and found[2] != measured.actor:
                    raise self.phrases.refuse("this is another vehicle's place", self.phrases.span(at + 1, found[1]))
                measured.actor = found[2]
        elif (phrase := self.phrases.noun_phrase(at + 1)) is not None and phrase.kind != "pronoun":
            measured.target, measured.end = self.phrases.resolve(phrase), phrase.end
        else:
            return False
        if relation in ("past", "ahead", "behind", "before"):
            measured.relation = cast(Relation, relation)
        return True

    def _between(self, measured: Measured) -> bool:
        at = measured.end + 1
        if self.phrases.tag(at, "pair"):
            measured.actor, measured.target, measured.end = EGO_ID, HERO_ID, at + 1
        else:
            first = self.phrases.noun_phrase(at)
            if first is None or self.phrases.tag(first.end, "link") != "and":
                return False
            measured.actor = self.phrases.resolve(first)
            if (second := self.phrases.noun_phrase(first.end + 1)) is not None:
                measured.target, measured.end = self.phrases.resolve(second), second.end
            elif found := self.phrases.landmark(first.end + 1):
                measured.target, measured.end = found[0], found[1]
            else:
                return False
        if isinstance(measured.target, int):
            measured.between = (measured.actor, measured.target)
        return True

    # -- what it gives ----------------------------------------------------------------------------------------------
    def _complete_measure(self, measured: Measured) -> bool:
        if measured.target is None and measured.actor is None and measured.of_pair:  # "when the gap is 12 m"
            measured.actor, measured.target = EGO_ID, HERO_ID
        if isinstance(measured.target, int) and measured.actor is None:
            measured.actor = 1 - measured.target
        both = measured.kind == "headway" or measured.of_pair
        if measured.actor is not None and measured.target is None and both and measured.kind != "ttc":
            measured.target = 1 - measured.actor  # "the ego's headway is 2 s"
        if measured.kind == "ttc" and measured.actor is None and self.subject is None:
            measured.actor = EGO_ID  # "when the TTC is 3 s": there are only two vehicles
        if measured.actor is None:
            if self.current is None and self.subject_span is None and isinstance(measured.target, str):
                raise self.phrases.refuse(
                    "it is not said whose distance this is",
                    self.phrases.span(measured.start, measured.end),
                    "the ego's or the hero's",
                    "name the vehicle",
                )
            measured.actor = self.subject
        if measured.actor is None:
            return False
        return measured.kind in ("ttc", "speed") or (measured.kind != "rate" and measured.target is not None)

    def _open_measure(self, measured: Measured) -> None:
        assert measured.actor is not None
        assert measured.quantity is not None
        self._set_subject(measured.actor, None)
        self.at = measured.start
        event = self._open("ttc" if measured.kind == "ttc" else "be", measured.start)
        if measured.kind == "ttc":
            event.ttc, event.between = measured.quantity, measured.between
        elif measured.kind == "speed":
            event.speed = measured.quantity
        else:
            assert measured.target is not None
            span = self.phrases.span(measured.start, measured.end)
            event.places.append(Place(measured.relation, measured.target, measured.quantity, span))
            event.between = measured.between
        self.at = measured.end
        self._grow()
