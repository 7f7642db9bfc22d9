"""Reads vehicles and places as objects and as subjects of a passive: "yields to the ego", "the turn is begun".

What enters: the reader's state at such a phrase. What leaves: True where it was put into an event.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import HERO_ID, Place, Relation
from scenewright.translate.openings import OpeningReader
from scenewright.translate.references import NounPhrase


@dataclass(slots=True)
class ObjectReader(OpeningReader):
    """Reads objects."""

    def _agent(self, phrase: NounPhrase) -> bool:
        """Read "by the hero" after a passive."""
        event = self.current
        if event is None or event.actor is not None:
            return False
        self._set_subject(self.phrases.resolve(phrase), None)
        event.actor = self.subject
        self.at = phrase.end
        self._grow()
        return True

    def _passive_follows(self, at: int) -> bool:
        found = self._passive_object_at(at)
        return found is not None and bool(self.phrases.tag(found[1], "be") or self.phrases.tag(found[1], "auxiliary"))

    def _passive_object_at(self, at: int) -> tuple[str, int] | None:
        """Read what can be passed or begun: "the conflict point", "the turn"; its name and the position after it."""
        if found := self.phrases.landmark(at):
            return ("turn_start" if found[0] == "mouth" else found[0]), found[1]
        at = self.phrases.skip_determiner(at) + (self.phrases.tag(at, "possessive") is not None)
        at += self.phrases.tag(at, "direction") is not None
        return ("its turn", at + 1) if self.phrases.tag(at, "event_noun") == "turn" else None

    def _place_subject(self) -> bool:
        """Read "the stop line is 12 m ahead of the ego"."""
        found = self.phrases.landmark(self.at)
        if found is None or found[2] is not None:
            return False
        if self.phrases.tag(found[1], "be") is None and self.phrases.verb(found[1], "sit") is None:
            return False
        place = self.phrases.place(found[1] + 1)
        if place is None:
            place = self._away_for(found[1] + 1)
        if place is None or place[0].relation not in ("ahead", "from") or not isinstance(place[0].target, int):
            return False
        if place[0].amount is None or (self.current is not None and not self.links):
            return False
        start = self.at
        self._check_subject_used()
        landmark = "turn_start" if found[0] == "mouth" else found[0]
        for each, end in [place, *self._ahead_of_another(place)]:
            assert isinstance(each.target, int)
            self._set_subject(each.target, self.phrases.span(start, end))
            self.at = start
            event = self._open("be", start)
            event.places.append(Place("before", landmark, each.amount, each.span, vague=found[3]))
            self.at, self.links = end, ["and"]
            self._grow()
        self.links = []
        return True

    def _ahead_of_another(self, first: tuple[Place, int]) -> list[tuple[Place, int]]:
        """Read "... and 30 m ahead of the hero" after "the conflict point is 15 m ahead of the ego"."""
        at = first[1]
        if self.phrases.tag(at, "link") != "and" or self.phrases.tokens[at + 1].quantity is None:
            return []
        second = self._away_for(at + 1) or self.phrases.place(at + 1)
        if second is None or not isinstance(second[0].target, int) or second[0].target == first[0].target:
            return []
        return [second] if second[0].relation in ("ahead", "from") else []

    def _away_for(self, at: int) -> tuple[Place, int] | None:
        """Read "12 m away for the ego"."""
        amount = self.phrases.tokens[at].quantity
        if amount is None or self.phrases.tag(at + 1, "relation") != "from":
            return None
        phrase = self.phrases.noun_phrase(at + 3) if self.phrases.tag(at + 2, "preposition") == "for" else None
        if phrase is None or phrase.kind == "pronoun":
            return None
        return Place("from", self.phrases.resolve(phrase), amount, self.phrases.span(at, phrase.end)), phrase.end

    def _passive_subject(self) -> bool:
        if self._place_subject():
            return True
        if not self._passive_follows(self.at) or (self.current is not None and not self.links):
            return False
        found = self._passive_object_at(self.at)
        if found is None:
            return False
        self._check_subject_used()
        self.passive_object = found[0]
        self.subject = self.phrases.subject = None
        self.subject_span = self.phrases.span(self.at, found[1])
        self.at = found[1]
        self.current = None
        return True

    def _is_lead(self, phrase: NounPhrase) -> bool:
        """Read "the hero is the lead vehicle"."""
        event = self.current
        if event is None or event.verb != "be" or phrase.kind != "noun" or event.actor is None or event.places:
            return False
        if phrase.determiner != "definite" or not phrase.adjectives & {"lead", "rear"}:
            return False
        relation: Relation = "ahead" if "lead" in phrase.adjectives else "behind"
        event.places.append(Place(relation, 1 - event.actor, None, phrase.span))
        self.at = phrase.end
        self._grow()
        return True

    def _is_named(self, phrase: NounPhrase) -> bool:
        """Read "the left-turner is the SUT", "the SUT is the left-turner", "the ego is a left-turner"."""
        event = self.current
        if event is None or event.verb != "be" or event.actor is None or self.links or event.places:
            return False
        turner = phrase.noun in ("left_turner", "right_turner")
        if turner and phrase.kind == "noun" and event.direction is None:
            event.verb, event.wanted = "turn", True
            event.direction = (phrase.noun or "").removesuffix("_turner")
            self.phrases.refs.nouns.setdefault(event.actor, set()).add(phrase.noun or "")
        elif phrase.kind not in ("ego", "hero") or self.phrases.resolve(phrase) != event.actor:
            return False
        self.phrases.last_named = event.actor, phrase.end
        self.at = phrase.end
        self._grow()
        return True

    def _object(self, phrase: NounPhrase) -> bool:
        """Read an actor as an object or predicate: "yields to the ego", "follows the hero", "is an oncoming car"."""
        if self._is_lead(phrase) or self._is_named(phrase):
            return True
        event = self.current
        if event is not None and event.verb == "be" and phrase.kind == "noun" and phrase.determiner == "indefinite":
            if event.actor != HERO_ID or event.places or event.areas:
                return False
            self.phrases.refs.hero(phrase.noun)
            event.relations += [(each, HERO_ID, phrase.span) for each in phrase.adjectives & {"lead", "oncoming"}]
            self.at = phrase.end
            self._grow()
            return True
        if event is not None and event.verb == "follow" and not event.places:
            event.verb = "drive"
            pronoun = phrase.kind == "pronoun" and event.actor is not None
            other = 1 - (event.actor or 0) if pronoun else self.phrases.resolve(phrase)
            if other == event.actor:
                return False
            by, amount = self.phrases.tag(phrase.end, "preposition"), self.phrases.tokens[phrase.end + 1].quantity
            held = amount if by == "by" and amount is not None and amount.dimension in ("length", "time") else None
            event.places.append(Place("behind", other, held, phrase.span))
            self.at = phrase.end + (2 if held is not None else 0)
            self._grow()
            return True
        amount = self.phrases.tokens[phrase.end + 1].quantity
        near = (
            self.phrases.tag(phrase.end, "preposition") == "to" and amount is not None and amount.dimension == "length"
        )
        if event is not None and event.verb == "approach" and near and event.actor is not None and not event.places:
            other = 1 - event.actor if phrase.kind == "pronoun" else self.phrases.resolve(phrase)
            if other == event.actor:
                return False
            event.places.append(Place("from", other, amount, phrase.span))  # "has approached the hero to 15 m"
            self.at = phrase.end + 2
            self._grow()
            return True
        from_behind = self.phrases.tag(phrase.end, "from_behind") is not None
        if event is not None and event.verb == "approach" and (phrase.adjectives & {"lead", "oncoming"} or from_behind):
            other = self.phrases.resolve(phrase)
            if other == event.actor or event.places or event.landmark:
                return False
            if "lead" in phrase.adjectives or from_behind:
                event.verb = "drive"
                event.places.append(Place("behind", other, None, phrase.span))
            self.at = phrase.end + from_behind
            self._grow()
            return True
        if event is None or event.verb != "yield" or event.to_actor is not None:
            return False
        pronoun = phrase.kind == "pronoun" and event.actor is not None
        event.to_actor = 1 - (event.actor or 0) if pronoun else self.phrases.resolve(phrase)
        self.at = phrase.end
        self._grow()
        return True
