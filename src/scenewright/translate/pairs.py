"""Reads what is said of both vehicles at once: "both are eastbound", "the ego and, behind it, a van", "and so does it".

What enters: the reader's state at the beginning of such a clause. What leaves: True where it was read; what is told of
both is told of each when the sentence ends.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, replace

from scenewright.translate.events import EGO_ID, HERO_ID, Event, Place
from scenewright.translate.shares import ShareReader


@dataclass(slots=True)
class PairReader(ShareReader):
    """Reads pairs."""

    def _likewise(self) -> bool:
        """Read "and so does the ego" and "as does the ego": it goes the same way."""
        at = self.at
        if self.phrases.tokens[at].text.lower() not in ("so", "and so", "as") or self.current is None:
            return False
        if self.phrases.tag(at + 1, "auxiliary") is None and self.phrases.tag(at + 1, "be") is None:
            return False
        phrase = self.phrases.noun_phrase(at + 2)
        if phrase is None or phrase.kind == "pronoun":
            return False
        if not self.phrases.tokens[phrase.end].tags.keys() & {"end", "comma"}:
            return False
        same = self.current
        told = same.verb in ("turn", "pull_out", "leave", "drive", "lane_follow") and same.mode == "main"
        if not told or same.places or same.speed or same.relations or same.negated or "when" in same.links:
            return False
        actor = self.phrases.resolve(phrase)
        if actor == same.actor:
            return False
        also = deepcopy(same)
        also.actor, also.links, also.span = actor, ["and"], self.phrases.span(at, phrase.end)
        also.explicit = True
        self.events.append(also)
        self._set_subject(actor, None)
        self.links, self.at, self.current = [], phrase.end, also
        return True

    def _both(self) -> bool:
        """Read "both vehicles" and "the ego and the hero" as the subject of one clause."""
        if self.subject_span is not None or (self.current is not None and not self.links):
            return False
        at = self.at
        both = self.phrases.tokens[at].text.lower() == "both"
        if both and (named := self.phrases.noun_phrase(at + 1)) and self.phrases.tokens[named.end].text == "(":
            self.at += 1  # "both the ego (westbound) and the hero (eastbound) ..."
            return True
        if self.phrases.tokens[at].text.lower() == "both" and (pair := self._two_names(at + 1)) is not None:
            end = pair
        elif self._tag("pair"):
            end = at + 1
        else:
            pair = self._two_names(at)
            if pair is None:
                return False
            end = pair + (self.phrases.tag(pair, "pair") is not None)
        if self.phrases.tag(end, "genitive") is not None:
            return False
        if self._respectively(at, end):
            return True
        self._set_subject(EGO_ID, self.phrases.span(at, end))
        self.phrases.subject = None
        self.pair, self.at, self.current = True, end, None
        return True

    def _respectively(self, start: int, at: int) -> bool:
        """Read "the ego and the hero are 12 m and 20 m from the stop line and the conflict point, respectively"."""
        at += self.phrases.tag(at, "be") is not None or self.phrases.tag(at, "auxiliary") == "have"
        first = self.phrases.tokens[at].quantity
        if first is None or not self._says_respectively(at):
            return False
        places: list[Place] = []
        if self.phrases.tag(at + 1, "link") == "and" and self.phrases.tokens[at + 2].quantity is not None:
            found = self.phrases.place(at + 2)
            if found is None:
                return False
            second = self.phrases.landmark(found[1] + 1) if self.phrases.tag(found[1], "link") == "and" else None
            places = [replace(found[0], amount=first), found[0]]
            end = found[1]
            if second is not None:
                places[1], end = replace(places[1], target=second[0]), second[1]
        elif found := self.phrases.place(at):
            after = self.phrases.place(found[1] + 1) if self.phrases.tag(found[1], "link") == "and" else None
            if after is None:
                return False
            places, end = [found[0], after[0]], after[1]
        else:
            return False
        names = [self.phrases.noun_phrase(start + (self.phrases.tokens[start].text.lower() == "both"))]
        if names[0] is None or names[0].kind == "pronoun":
            return False
        order = self.phrases.resolve(names[0])
        links = self.links
        for actor, place in ((order, places[0]), (1 - order, places[1])):
            self.links = links
            self._set_subject(actor, self.phrases.span(start, end))
            self._open("be", start).places.append(place)
            links = ["and"]
        self.at = end + (self.phrases.tag(end, "comma") is not None) + 1
        return True

    def _two_names(self, at: int) -> int | None:
        first = self.phrases.noun_phrase(at)
        if first is None or self.phrases.tag(first.end, "link") != "and" or first.kind == "pronoun":
            return None
        relation, after = self._relation_between(first.end + 1)
        second = self.phrases.noun_phrase(after)
        if second is None or second.kind == "pronoun" or self.phrases.tag(second.end, "genitive") is not None:
            return None
        if self.phrases.tokens[first.end].text.lower() != "and":
            return None
        if relation is not None:
            self.phrases.resolve(first)
            described = "lead" if relation == "ahead" else "rear"  # "a wagon and, behind it, the ego drive east"
            self.phrases.described.append((described, self.phrases.resolve(second), second.span))
            return second.end
        beside = self.phrases.tag(second.end, "relation")
        it = self.phrases.tokens[second.end + 1].text.lower() == "it"
        if beside in ("ahead", "behind", "before") and it:  # "the ego and a van in front of it"
            self.phrases.resolve(first)
            described = "rear" if beside == "behind" else "lead"
            self.phrases.described.append((described, self.phrases.resolve(second), second.span))
            return second.end + 2
        if self.phrases.resolve(first) == self.phrases.resolve(second):
            raise self.phrases.refuse("these are the same vehicle", self.phrases.span(at, second.end))
        return second.end

    def _relation_between(self, at: int) -> tuple[str | None, int]:
        """Read ", behind it," between two names; return the relation and the position after it."""
        begin = at + (self.phrases.tag(at, "comma") is not None)
        relation = self.phrases.tag(begin, "relation")
        pronoun = self.phrases.tag(begin + 1, "pronoun") is not None
        if relation not in ("ahead", "behind") or not pronoun:
            return None, at
        return relation, begin + 2 + (self.phrases.tag(begin + 2, "comma") is not None)

    def _spread(self) -> None:
        """Tell of the hero too what the sentence tells of both."""
        spread: list[Event] = []
        for event in self.events:
            spread.append(event)
            if event.both:
                event.both = False
                other = deepcopy(event)
                other.actor = HERO_ID
                spread.append(other)
        self.events = spread
