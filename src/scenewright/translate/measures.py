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

_OF_BOTH = ("gap", "headway", "thw", "spacing", "following", "separation", "inter vehic", "intervehic")
_ACTS = ("brake", "stop", "accelerate", "yield", "go")
_REMAIN = ("remain", "remains", "remaining", "left", "are left")


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
    initial: bool = False  # "the initial distance"
    of_pair: bool = False  # "the gap" needs no vehicles named: there are only two


@dataclass(slots=True)
class MeasureReader(VerbReader):
    """Reads measures, one or several that share a place."""

    def _measure(self) -> bool:
        at, link = self.at, None
        if self.phrases.tag(at, "preposition") in ("at", "with") or self.phrases.tokens[at].text.lower() == "with":
            late = self.current is not None and not self.links
            if (late and not self._gap_after_deed(at + 1)) or self._first_distance():
                return False
            at, link = at + 1, "when"
        again = "and" in self.links and set(self.links) <= {"and", "comma"} and self.measured_last == len(self.events)
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
        if len(found) == 1:
            self._aim_as_before(first)
        if any(not self._complete_measure(each) for each in found):
            return False
        link = link or self._told_by_falling(found)
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
        if owner and self.phrases.tokens[start].text.lower().endswith(" own") and actor == EGO_ID:
            acts = [e for e in self.events if e.sentence == self.sentence and e.actor == HERO_ID]
            actor = (
                HERO_ID if acts and acts[0].verb in _ACTS else actor
            )  # "it brakes as ... (its own distance is 19 m)"
        if actor is None and (phrase := self.phrases.noun_phrase(at)) and self.phrases.tag(phrase.end, "measure"):
            actor, at = self.phrases.resolve(phrase), phrase.end  # "ego speed is 10 m/s"
        starts = self.phrases.tag(at, "starting") is not None and self.phrases.tag(at + 1, "measure") is not None
        at += starts
        kind = self.phrases.tag(at, "measure")
        of_one = self.phrases.tokens[start].text.lower() == "that" and self.phrases.tag(start + 1, "preposition") in (
            "of",
            "out",
        )
        of_again = self.phrases.tag(start, "preposition") == "of" and self.measured_last == len(self.events) > 0
        if of_again and kind is None and self.phrases.noun_phrase(start + 1) is not None:
            kind, at = self.last_kind, start - 1  # "distance of the ego to ... 4 m, of the hero to ... 30 m"
        at = start if of_one else at
        led = self._led_by_vehicle(start) if kind is None and owner is None else None
        if led is not None:
            kind, actor = self.phrases.tag(led[2], "measure"), led[0]
            at = led[2]
        if kind is None and of_one and self.measured_last == len(self.events):
            kind = self.last_kind  # "... is 12 m and that of the hero to the conflict point is 20 m"
        if kind is None:
            return None
        self.last_kind = kind
        measured = Measured(start, at + 1, kind, actor)
        measured.initial = starts
        measured.target = led[1] if led is not None else None
        if self.phrases.tokens[measured.end].text == "(" and actor is None and not self._in_brackets(measured):
            return None
        measured.of_pair = self._tells_of_both(at)
        if not self._qualify(measured, 1):
            return None
        at = measured.end
        if self.phrases.tag(at, "link") == "moment" or self.phrases.tag(at, "label") == "when":  # "at the trigger: 2 s"
            if "when" not in self.links:
                self.links.append("when")
            at += 1
        of = self.phrases.tag(at, "preposition") in ("of", "at") and (actor is not None or measured.target is not None)
        if self.phrases.tokens[at].tags.keys() & {"be", "falls", "colon"} or of:
            at = self.phrases.skip_hedges(at + 1 + (self.phrases.tokens[at + 1].text.lower() == "down to"))
        measured.quantity = self.phrases.tokens[at].quantity
        return self._with_amount(measured, at)

    def _amount_then_measure(self, start: int) -> Measured | None:
        """Read "4 s TTA of the ego" and "a distance of 25 m between the two"."""
        if self.phrases.tag(start, "preposition") == "of" and self.measured_last == len(self.events):
            start += 1  # "... and of 30 m between the hero and the conflict point"
        at = self.phrases.skip_hedges(self.phrases.skip_determiner(start))
        if (parted := self._separated(start, at)) is not None:
            return parted
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

    def _separated(self, start: int, at: int) -> Measured | None:
        """Read "9 m separate the ego from the hero" and "9 m lie between them"."""
        quantity = self.phrases.tokens[at].quantity
        if quantity is None or quantity.dimension not in ("length", "time"):
            return None
        if self.phrases.tag(at + 1, "separates") is None:
            return None
        found = Measured(start, at + 1, "length" if quantity.dimension == "length" else "headway", quantity=quantity)
        if self.phrases.tag(at + 2, "pair"):
            found.actor, found.target, found.end = EGO_ID, HERO_ID, at + 3
            found.between = (EGO_ID, HERO_ID)
            return found
        one = self.phrases.noun_phrase(at + 2)
        if one is None or one.kind == "pronoun":
            return None
        joined = self.phrases.tokens[one.end].text.lower() in ("from", "and")
        if joined and (mark := self._landmark_of(self.phrases.resolve(one), one.end + 1)) is not None:
            found.actor, (found.target, found.end) = self.phrases.resolve(one), mark
            found.kind = "length" if quantity.dimension == "length" else "time"
            return found
        two = self.phrases.noun_phrase(one.end + 1) if joined else None
        if two is None:
            return None
        found.actor = self.phrases.resolve(one)
        found.target = 1 - found.actor if two.kind == "pronoun" else self.phrases.resolve(two)
        found.between, found.end = (found.actor, found.target), two.end
        return found

    def _landmark_of(self, actor: int, at: int) -> tuple[str, int] | None:
        """Read a landmark of a vehicle ("its stop line"); its name and the position after it."""
        subject, self.phrases.subject = self.phrases.subject, actor
        found = self.phrases.landmark(at)
        self.phrases.subject = subject
        if found is None or found[2] not in (None, actor):
            return None
        return "turn_start" if found[0] == "mouth" else found[0], found[1]

    def _gap_after_deed(self, at: int) -> bool:
        """Whether "at a gap of 9 m" after a deed is the moment at which it begins, and no place to stop."""
        event = self.current
        if event is None or event.actor == EGO_ID or event.places:
            return False
        words = event.span.excerpt(self.phrases.text).lower()
        sudden = any(word in words for word in ("emergency", "perform", "begin", "start"))
        if event.verb not in ("brake", "accelerate") and not (event.verb == "stop" and sudden):
            return False
        at = self.phrases.skip_determiner(at)
        return self.phrases.tag(at, "measure") in ("headway", "ttc") or (
            self.phrases.tag(at, "measure") == "length" and self._tells_of_both(at)
        )

    def _led_by_vehicle(self, at: int) -> tuple[int, str, int] | None:
        """Read "ego-to-stop-line" in front of "distance"; the vehicle, the place and the position of the measure."""
        phrase = self.phrases.noun_phrase(at)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tokens[phrase.end].text.lower() != "to":
            return None
        name = self.phrases.tag(phrase.end + 1, "landmark")
        if name is None or self.phrases.tag(phrase.end + 2, "measure") not in ("length", "time"):
            return None
        return self.phrases.resolve(phrase), name, phrase.end + 2

    def _in_brackets(self, measured: Measured) -> bool:
        """Read "(ego, stop line)" after "TTA"."""
        phrase = self.phrases.noun_phrase(measured.end + 1)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "comma") is None:
            return False
        actor = self.phrases.resolve(phrase)
        mark = self._landmark_of(actor, phrase.end + 1)
        if mark is None or self.phrases.tokens[mark[1]].text != ")":
            return False
        measured.actor, measured.target, measured.end = actor, mark[0], mark[1] + 1
        return True

    def _aim_as_before(self, measured: Measured) -> None:
        """Let "its own distance is 19 m" be to the place that the other vehicle was just compared with."""
        words = self.phrases.tokens[measured.start].text.lower()
        last = self.events[-1] if self.events else None
        if not words.endswith(" own") or measured.target is not None or last is None or measured.kind == "speed":
            return
        shared = last.sentence == self.sentence and len(last.places) == 1 and last.actor != measured.actor
        if shared and isinstance(last.places[0].target, str) and last.places[0].target != "stop_line":
            measured.target = last.places[0].target

    def _told_by_falling(self, found: list[Measured]) -> str | None:
        """Return "when" for "The gap falls to 9 m: the hero brakes", where a sentence begins with what falls."""
        begins = self.current is None and self.subject_span is None and not self.links and self.label is None
        fresh = not any(event.sentence == self.sentence for event in self.events)
        falls = any(self.phrases.tag(at, "falls") for at in range(found[0].start, found[0].end))
        gap = isinstance(found[0].target, int)
        return "when" if begins and fresh and falls and gap else None

    def _tells_of_both(self, at: int) -> bool:
        """Whether a measure is one of two vehicles, even where none is named: "the gap", "the headway"."""
        words = self.phrases.tokens[at].text.lower().replace("-", " ")
        return any(word in words for word in _OF_BOTH)

    def _after_remain(self, at: int) -> int:
        """Return the position after "12 m" or "12 m remain"."""
        return (
            at + 2 + (self.phrases.tag(at + 1, "be") is not None)
            if self.phrases.tokens[at + 1 + (self.phrases.tag(at + 1, "be") is not None)].text.lower() in _REMAIN
            else at + 1
        )

    def _with_amount(self, measured: Measured, at: int) -> Measured | None:
        if measured.quantity is None:
            return None
        self.phrases.check_measure(measured.kind, measured.quantity)
        measured.end = at + 1
        self._qualify(measured, 0)
        bracket = measured.target is None and self.phrases.tokens[measured.end].text == "("
        if bracket and measured.actor is not None and measured.kind in ("length", "time"):
            mark = self._landmark_of(measured.actor, measured.end + 1)
            if mark is not None and self.phrases.tokens[mark[1]].text == ")":  # "ego TTA 6 s (stop line)"
                measured.target, measured.end = mark[0], mark[1] + 1
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
            elif bare and self.phrases.tag(at, "landmark") and measured.target is None:  # "ego TTA conflict point 4 s"
                if not self._to_what(measured, at - 1, None):
                    return False
            elif bare and measured.actor is None and self._whose(measured, at):  # "TTA ego 4 s", "gap ego to hero"
                to = self.phrases.tag(measured.end, "preposition") == "to" or (
                    self.phrases.tag(measured.end, "link") in ("to", "and")
                )
                amount = self.phrases.tokens[measured.end].quantity is not None
                if not (amount or to or self.phrases.tokens[measured.end].tags.keys() & {"be", "colon", "falls"}):
                    return False
            else:
                return True

    def _whose_or_what(self, measured: Measured, at: int) -> bool:
        """Read "of the ego" and "to the stop line"."""
        preposition, relation = self.phrases.tag(at, "preposition"), self.phrases.tag(at, "relation")
        if preposition in ("of", "out", "for") and measured.actor is None and self._whose(measured, at + 1):
            return True
        aims = (
            preposition in ("to", "at", "out", "with")
            or relation is not None
            or self.phrases.tag(at, "link") in ("to", "until")
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
        elif (phrase := self.phrases.noun_phrase(at + 1)) is not None and phrase.kind == "pronoun":
            apart = measured.kind == "headway" or measured.of_pair or self.phrases.last_landmark is None
            if measured.actor is None or not apart:
                return False
            measured.target, measured.end = 1 - measured.actor, phrase.end  # "the ego's headway to it"
        elif phrase is not None:
            if measured.kind == "headway" and self.phrases.tokens[at].text.lower() == "to":
                measured.relation = "behind"  # whoever has a headway to another one is behind it
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
        if measured.kind == "ttc" and measured.actor is None:
            measured.actor = EGO_ID  # "when the TTC is 3 s": there are only two vehicles
        if measured.actor is None:
            told = "speed" if measured.kind == "speed" else "distance" if isinstance(measured.target, str) else None
            if self.current is None and self.subject_span is None and told is not None:
                raise self.phrases.refuse(
                    f"it is not said whose {told} this is",
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
        event.initial |= measured.initial
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
