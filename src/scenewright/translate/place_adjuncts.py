"""Reads places beside a verb: "12 m behind the stop line", places that two vehicles share, where a vehicle stops.

What enters: the reader's state at some token. What leaves: True where a place was read and put into its event.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.translate.events import Area, Event, Place
from scenewright.translate.reader import TURNS
from scenewright.translate.sides import SideReader
from scenewright.translate.tokens import Quantity

_DOES = ("brake", "stop", "accelerate", "yield", "go", "wait", "pass", "reach", "complete", "react")


@dataclass(slots=True)
class PlaceAdjunctReader(SideReader):
    """Puts places into the event that they belong to."""

    def _each_its_own(self) -> bool:
        """Step over "respectively" where each of two vehicles has been given one place of its own."""
        if self._tag("respectively") is None or len(self.events) < 2:
            return False
        one, two = self.events[-2:]
        apart = one.sentence == two.sentence == self.sentence and one.actor != two.actor
        if not apart or one.both or two.both or len(one.places) != 1 or len(two.places) != 1:
            return False
        self.links = [link for link in self.links if link != "comma"]
        self.at += 1
        return True

    def _shared_place(self) -> bool:
        """Read a bare amount whose place another vehicle names: "the ego is 35 m and the hero 20 m from it"."""
        amount = self.phrases.tokens[self.at].quantity
        if amount is None or amount.dimension not in ("length", "time"):
            return False
        end = self.at + 1 + self._is_away(self.at + 1)
        after = self.phrases.tokens[end].tags
        ends = bool(after.keys() & {"end", "comma", "colon"}) or after.get("link") == "and"
        shared = (self._place_before() or self._place_after(end)) if ends else None
        if shared is None or not isinstance(shared.target, str) or shared.of_whom is not None:
            return False
        own_line = shared.target == "stop_line" and not self._both_in_driveway()
        if own_line and not self._says_respectively(self.at):  # each has its own, or none: nothing that two can share
            return False
        if shared.amount is None or shared.amount.dimension != amount.dimension:
            return False
        host = self._host()
        if host is None or host.verb not in ("be", "sit"):
            return False
        host.places.append(replace(shared, amount=amount, span=amount.span))
        if end > self.at + 1:
            words = self.phrases.span(self.at, end).excerpt(self.phrases.text)
            self.phrases.assume(f"'{words}' is measured from the {shared.target.replace('_', ' ')}")
        self.at = end
        self._grow()
        return True

    def _is_away(self, at: int) -> bool:
        """Whether "away" or "out" stands behind an amount whose place was named: "... and the van's 25 m away"."""
        return self.phrases.tokens[at].text.lower() in ("away", "out", "off")

    def _both_in_driveway(self) -> bool:
        """Whether both were told to be in the driveway, or to come out of it: they have one stop line."""
        told: set[int | None] = set()
        for event in self.events:
            into = event.verb in TURNS
            if any(a.kind == "driveway" and (a.role == "from" or (a.role == "on" and not into)) for a in event.areas):
                told |= {0, 1} if event.both else {event.actor}
        return {0, 1} <= told

    def _place_before(self) -> Place | None:
        """Return the place that the vehicle before is compared with: "the ego is 35 m from it and the hero 20 m"."""
        told = self.events
        if self.current is not None and told and told[-1] is self.current and self._is_bare(self.current):
            told = told[:-1]  # "... and the hero is 20 m away"
        last = told[-1] if told else None
        opened = self.subject_span is None and told is self.events
        if last is None or last.sentence != self.sentence or opened or last.actor == self.subject:
            return None
        return last.places[0] if last.verb in ("be", "sit") and len(last.places) == 1 else None

    def _is_bare(self, event: Event) -> bool:
        """Whether nothing but "the hero is" has been read of an event."""
        return (
            event.verb == "be" and event.explicit and not (event.places or event.areas or event.headings or self.links)
        )

    def _place_after(self, at: int) -> Place | None:
        """Return the place that follows for the other vehicle: "... 35 m and the hero 20 m from it"."""
        at += self.phrases.tag(at, "comma") is not None
        at += self.phrases.tag(at, "link") == "and"
        phrase = self.phrases.noun_phrase(at)
        if phrase is None or (phrase.kind == "pronoun" and self.phrases.tag(phrase.end, "be") is None):
            return None
        at = phrase.end + (self.phrases.tag(phrase.end, "be") is not None)
        found = self.phrases.place(at) if self.phrases.tokens[at].quantity is not None else None
        return found[0] if found else None

    def _stop_adjunct(self) -> bool:
        end = self._stop_noun_at(self.at)
        bare = self.at + 1 if self.links == ["comma"] and self.subject_span is None and self._tag("stop_noun") else None
        if end is None and bare is not None and self._closes_at(bare):
            end, self.links = bare, []  # "brakes, 0.5 g, full stop", "brakes, full stop 5 m short of it"
        if end is None or self.current is None or self.current.verb not in ("brake", "stop"):
            return False
        self.current.to_stop = True
        self.at = end
        self._grow()
        return True

    def _closes_at(self, at: int) -> bool:
        """Whether a note ends at `at`, or goes on with where: "full stop 5 m short of it", "standstill at the line"."""
        amount = self.phrases.tokens[at].quantity
        placed = (
            amount is not None and amount.dimension == "length" and self.phrases.tag(at + 1, "relation") is not None
        )
        placed = placed or (self.phrases.tag(at, "preposition") == "at" and self.phrases.place(at) is not None)
        return placed or bool(self.phrases.tokens[at].tags.keys() & {"end", "comma"})

    def _place_adjunct(self) -> bool:
        passing = self.current is not None and self.current.verb in ("pass", "complete", "reach", "enter")
        if passing and self._tag("link") == "before" and self.phrases.tokens[self.at].quantity is None:
            return False
        turns = self.current is not None and self.current.verb in TURNS and self.current.direction is None
        if turns and self.phrases.tokens[self.at].text.lower() == "right":
            return False  # "turns right at the junction"
        found = self.phrases.place(self.at)
        if found is None:
            return False
        place, end = found
        if self.links[-2:] == ["and", "comma"] and self.subject_span is None:
            return self._place_of_next(place, end)
        host = self._host()
        if host is None:
            return False
        host.initial |= self._starts_with(self.at + 1)
        if (
            second := self._respective(end)
        ) is not None:  # "... from the conflict point and the stop line respectively"
            place, end = replace(place, target=second[0]), second[1]
        cuts = place.relation == "ahead" and isinstance(place.target, int) and place.amount is None
        if cuts and place.target == host.actor:
            raise self.phrases.refuse("a vehicle is not in front of itself", place.span, "the other vehicle")
        if cuts and host.verb in ("turn", "pull_out", "pass", "leave"):
            host.in_front = True  # "turns right out of the driveway in front of the ego"
            self.at = end
            self._grow()
            return True
        host.places.append(place)
        if place.target == "stop_line" and self.phrases.tag(end - 1, "area") == "driveway":
            host.areas.append(Area("on", "driveway", place.span))  # "at the stop line of the driveway"
        self.at = end
        self._grow()
        return True

    def _place_of_next(self, place: Place, end: int) -> bool:
        """Read "drives east and, at the junction, turns left": the place of the turn that follows."""
        at_junction = place.relation == "at" and place.target in ("intersection", "turn", "turn_start")
        turns = (
            self.phrases.tag(end, "comma") is not None and self.phrases.verb(end + 1, "turn", "pull_out") is not None
        )
        if not at_junction or not turns:
            return False
        self.links.pop()
        self.at = end + 1
        return True

    def _first_distance(self) -> bool:
        """Whether ", at a distance of 30 m from it" tells of the start: nothing acts in its sentence."""
        told = ("be", "sit", "drive", "lane_follow", "approach")
        if self.current is None or self.current.verb not in told or self.links != ["comma"] or self.subject_span:
            return False
        found = self.phrases.place(self.at) if self._tag("preposition") == "at" else None
        if found is None or not isinstance(found[0].target, str) or not self._only_tells(found[1]):
            return False
        closes = self.phrases.tokens[found[1]].tags.keys() & {"end", "comma", "link"}
        here = [event for event in self.events if event.sentence == self.sentence]
        return bool(closes) and all(event.verb in (*told, "turn") and "when" not in event.links for event in here)

    def _only_tells(self, at: int) -> bool:
        """Whether the rest of the sentence has no action and no moment: "... and will turn left onto the road"."""
        while self.phrases.tag(at, "end") is None:
            area = self.phrases.area(at + 1) or self.phrases.area_noun(at + 1, "on")
            goes_on = self.phrases.verb(at, "go") is not None and area is not None  # "continues on the road"
            goes_on = goes_on or "ing" in self.phrases.tokens[at].forms  # "the road going east"
            timed = self.phrases.tag(at, "link") in ("when", "then", "until", "before", "after")
            if timed or (self.phrases.verb(at, *_DOES) and not goes_on):
                return False
            at += 1
        return True

    def _starts_with(self, at: int) -> bool:
        """Whether an amount is said to be the one at the start: "an initial distance of 30 m"."""
        return self.phrases.tag(self.phrases.skip_determiner(at), "starting") is not None

    def _respective(self, at: int) -> tuple[str, int] | None:
        """Read "and the stop line(,) respectively" after the first of two places; the second one and what follows."""
        if self.phrases.tag(at, "link") != "and":
            return None
        found = self.phrases.landmark(at + 1)
        if found is None:
            return None
        end = found[1] + (self.phrases.tag(found[1], "comma") is not None)
        if self.phrases.tokens[end].text.lower() != "respectively":
            return None
        return found[0], end + 1

    def _shared_arrival(self, event: Event, amount: Quantity) -> bool:
        """Read "... would reach the stop line in 3 s and the hero the conflict point in 4 s" without a verb."""
        before = self.events[-2] if len(self.events) > 1 else None
        if before is None or before.sentence != event.sentence or amount.dimension != "time" or event.verb != "be":
            return False
        arrives = any(place.amount is not None and place.amount.dimension == "time" for place in before.places)
        return arrives and self._arrives_in(event, amount)

    def _arrives_in(self, event: Event, amount: Quantity) -> bool:
        place = event.places[-1] if len(event.places) == 1 else None
        if place is None or place.relation != "at" or place.amount is not None:
            return False
        span = self.phrases.span(self.at, self.at + 2)
        event.places[-1] = replace(place, relation="from", amount=amount, span=place.span.union(span))
        self.at += 2
        self._grow()
        return True

    def _reached_in(self) -> bool:
        """Read "will reach the stop line in 3 s" as a time to arrival."""
        event, amount = self.current, self.phrases.tokens[self.at + 1].quantity
        if event is None or self.links or self.phrases.tokens[self.at].text.lower() != "in" or amount is None:
            return False
        if self._shared_arrival(event, amount):
            return True
        if event.verb == "be" and len(event.places) == 1 and event.places[0].relation == "at":
            return amount.dimension == "time" and self._arrives_in(event, amount)  # "will be at the stop line in 3 s"
        if event.verb != "reach" or event.landmark is None or amount.dimension != "time" or event.places:
            return False
        event.places.append(Place("from", event.landmark, amount, self.phrases.span(self.at, self.at + 2)))
        event.verb, event.landmark = "be", None
        self.at += 2
        self._grow()
        return True
