"""Reads what points back: "it" after a clause about the ego, "there", "for which", an arrival that is compared later.

What enters: the reader's state at such a word. What leaves: who or what is meant; nothing where that is unsure.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import EGO_ID, HERO_ID, Event
from scenewright.translate.objects import ObjectReader
from scenewright.translate.references import NounPhrase


@dataclass(slots=True)
class AnaphoraReader(ObjectReader):
    """Reads back references between clauses."""

    def _only_later(self, at: int) -> bool:
        """Whether "only" stands before a verb whose clause says when: "only moves on once the ego has passed"."""
        if not self.phrases.tokens[at].tags.keys() & {"verb", "auxiliary"}:
            return False
        while not self.phrases.tokens[at].tags.keys() & {"end", "comma"}:
            if self.phrases.tag(at, "link") in ("when", "after"):
                return True
            at += 1
        return False

    def _rests_there(self, at: int) -> bool:
        """Whether "there" begins a clause about a standstill: "There it waits until the ego has passed"."""
        if self.current is not None and not self.links:
            return False
        at += self.phrases.tag(at, "comma") is not None
        phrase = self.phrases.noun_phrase(at)
        stopped = any(event.verb in ("stop", "brake", "yield") for event in self.events)
        if phrase is None:
            return stopped and self.subject is not None and self.phrases.verb(at, "wait") is not None
        return stopped and self.phrases.verb(phrase.end, "wait") is not None

    def _for_which(self) -> bool:
        """Step over "for which" in "makes a stop 1 m before it, for which it starts braking when ..."."""
        if (
            self.phrases.tokens[self.at].text.lower() != "for"
            or self.phrases.tokens[self.at + 1].text.lower() != "which"
        ):
            return False
        if self.current is None or self.current.verb not in ("stop", "brake", "yield") or "comma" not in self.links:
            return False
        self.links.append("and")
        self.at += 2
        return True

    def _means_the_hero(self, phrase: NounPhrase) -> bool:
        """Whether "it" is the hero: who acts beside the ego, or after a clause about the ego."""
        here = [event for event in self.events if event.sentence == self.sentence]
        if self._only_the_hero_can(phrase, here) or self._placed_beside_the_ego(phrase, here):
            return True
        return self._hero_after_the_ego(phrase, here)

    def _may_be_either(self, phrase: NounPhrase) -> bool:
        """Whether "it" has a place right after a gap: "when the ego is 15 m behind the hero and it is 25 m ..."."""
        before = self.events[-1] if self.events else None
        if before is None or before.sentence != self.sentence or not before.explicit:
            return False
        apart = any(isinstance(place.target, int) and place.amount for place in before.places)
        return (
            apart and self.phrases.tag(phrase.end, "be") is not None and self.phrases.place(phrase.end + 1) is not None
        )

    def _placed_beside_the_ego(self, phrase: NounPhrase, here: list[Event]) -> bool:
        """Whether "it" is who acts, in "it brakes once the ego is 20 m and it is 12 m from ...": each has one place."""
        if self.subject != EGO_ID or not here or set(self.links) - {"and", "comma"} or "and" not in self.links:
            return False
        acts = here[0].actor == HERO_ID and here[0].verb in ("brake", "accelerate", "stop", "yield", "go")
        placed = here[-1].actor == EGO_ID and here[-1].explicit and bool(here[-1].places) and len(here) > 1
        amount = self.phrases.tokens[phrase.end + 1].quantity
        told = self.phrases.tag(phrase.end, "be") is not None and amount is not None
        return acts and placed and told and amount is not None and amount.dimension in ("length", "time")

    def _only_the_hero_can(self, phrase: NounPhrase, here: list[Event]) -> bool:
        """Whether "it" brakes or speeds up after a clause that named both: nobody tells the ego to do so."""
        if self.subject != EGO_ID or self.pronouns > 2 or not {"comma", "then", "and"} & set(self.links):
            return False
        told = [event for event in here if event.actor == HERO_ID and (event.explicit or event.verb == "attitude")]
        named = len(told) > self.pronouns - 1  # by a name, and not only by another "it"
        before = self.main_subject == HERO_ID and bool(told) and told[0] is here[0]  # by a name in the sentence before
        named = named or (before and len(told) == self.pronouns - 1 and self._fits_the_hero(told[0]))
        if self._at_the_egos_place(phrase.end, here):
            return False
        at = phrase.end
        while self.phrases.tokens[at].tags.keys() & {"auxiliary", "adverb"} or self.phrases.verb(at, "begin"):
            at += 1 + (self.phrases.tag(at + 1, "link") == "to")
        token = self.phrases.tokens[at]
        return named and self.phrases.verb(at, "brake", "accelerate") is not None and bool(token.forms & {"s", "base"})

    def _fits_the_hero(self, placed: Event) -> bool:
        """Whether "it is 12 m from the stop line" can be the hero's place: it was told to come out of the driveway."""
        line = any(place.target == "stop_line" for place in placed.places)
        areas = [area.kind for event in self.events if event.actor == HERO_ID for area in event.areas]
        return not line or "driveway" in areas

    def _at_the_egos_place(self, at: int, here: list[Event]) -> bool:
        """Whether it acts at a stop line that only the ego was said to be near: then the ego could be meant."""
        near = {event.actor for event in here for place in event.places if place.target == "stop_line"}
        line = False
        while self.phrases.tag(at, "end") is None:
            line |= self.phrases.tag(at, "landmark") == "stop_line"
            at += 1
        return line and near == {EGO_ID}

    def _acts_beside_asides(self, main: list[Event]) -> bool:
        """Whether the hero acts, and of the ego an aside of its moment is told: "..., driving west, is 45 m ..."."""
        acts = [
            event for event in main if event.actor == HERO_ID and event.verb in ("brake", "accelerate", "stop", "go")
        ]
        after = main[main.index(acts[-1]) + 1 :] if acts else []
        timed = any(e.sentence == self.sentence and "when" in e.links for e in self.events)
        return timed and bool(after) and all(e.actor == EGO_ID and "that" in e.links for e in after)

    def _hero_after_the_ego(self, phrase: NounPhrase, here: list[Event]) -> bool:
        """Whether "it" after a clause about the ego is the hero: "After the ego has passed, it goes"."""
        if self.subject != EGO_ID or not here:
            return False
        at = phrase.end
        while self.phrases.tokens[at].tags.keys() & {"auxiliary", "adverb"} or self.phrases.verb(at, "begin"):
            at += 1 + (self.phrases.tag(at + 1, "link") == "to")
        if self._goes_on_with_the_hero(here, at):
            return True
        if self.main_subject != HERO_ID or "comma" not in self.links:
            return False
        subordinate = all(set(event.links) & {"when", "after", "and", "comma"} and event.explicit for event in here)
        named = all(event.actor == EGO_ID for event in here)
        released = bool(here) and here[-1].verb in ("pass", "complete", "leave", "turn", "pull_out")
        stood = here[0].sentence and any(e.verb == "wait" and e.actor == HERO_ID for e in self.events)
        acts = (released or stood) and self.phrases.verb(at, "accelerate", "go", "keep") is not None
        return bool(subordinate and named and acts and self.pronouns == 1)

    def _goes_on_with_the_hero(self, here: list[Event], at: int) -> bool:
        """Whether a clause about what the hero does goes on after the ego's moment: "waits until ..., then it goes"."""
        begun = next((event for event in here if event.actor is not None), here[0])
        bounds = {"when", "until", "before", "after"}
        if begun.actor != HERO_ID or bounds & set(begun.links) or "that" in begun.links:
            return False
        if not {"comma", "then"} & set(self.links) or bounds & set(self.links):
            return False
        inside = False
        for event in here:
            yielded = event.actor == EGO_ID and event.verb in ("pass", "complete", "turn", "leave")
            inside = (
                bool(bounds & set(event.links))
                or yielded
                or (inside and event.actor == EGO_ID)
                or (inside and not {"comma", "then"} & set(event.links))
            )
            if event.actor == EGO_ID and not inside:
                return False
        acts = (
            "brake",
            "stop",
            "yield",
            "wait",
            "accelerate",
            "go",
            "keep",
            "pass",
            "complete",
            "turn",
            "come",
            "reach",
        )
        return self.phrases.verb(at, *acts) is not None

    def _arrival(self, compared: bool) -> None:
        """Let "is at the conflict point" be an arrival where it is compared: "... before the ego is"."""
        event = self.current
        place = event.places[0] if event is not None and len(event.places) == 1 else None
        if event is None or place is None or not compared or event.verb not in ("be", "sit") or "when" in event.links:
            return
        if place.relation == "at" and isinstance(place.target, str) and not place.vague:
            event.verb, event.landmark, event.places = "reach", place.target, []
