"""Reads what stands around a clause: requests ("create a scenario in which"), fronted places, appositions, "both".

What enters: the reader's state at the beginning of a clause. What leaves: True where such words were read; what they
say of a vehicle goes into an event of its own. Words that ask for a scenario say nothing about it and give no event.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, replace

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID, Area, Event, Place
from scenewright.translate.measures import MeasureReader
from scenewright.translate.references import NounPhrase


@dataclass(slots=True)
class FrameReader(MeasureReader):
    """Reads the surroundings of clauses."""

    fronted: list[Area | tuple[str, Span]] | None = None

    def _frame(self) -> bool:
        """Step over words that ask for what follows."""
        kind = self._tag("frame")
        begins = self.subject_span is None and (self.current is None or set(self.links) & {"comma", "and", "then"})
        if not begins or self.fronted:
            return False
        if kind in ("that", "role") and self.current is None:
            self.at += 1
            return True
        if kind == "as" and self.current is None and not self.links:
            self.links.append("when" if self._amount_before_comma() else "and")
            self.at += 1
            return True
        if (kind is None or kind == "wish") and (after := self._frame_noun(self.at + (kind is not None))):
            self.at = after
            return True
        if kind in ("build", "let") and (after := self._frame_noun(self.at + 1)):
            self.at = after
            return True
        told = kind == "wish" or (kind == "let" and "and" not in self.links)
        if told and (phrase := self.phrases.noun_phrase(self.at + 1)) and phrase.kind != "pronoun":
            self.at += 1
            self._take_subject(phrase)
            if kind == "wish" and self._tag("link") == "to":
                self.at += 1
            return True
        return False

    def _amount_before_comma(self) -> bool:
        at = self.at
        while not self.phrases.tokens[at].tags.keys() & {"comma", "end"}:
            if self.phrases.tokens[at].quantity is not None:
                return True
            at += 1
        return False

    def _frame_noun(self, at: int) -> int | None:
        """Return the position after "a scenario in which", or None."""
        at = self.phrases.skip_determiner(at)
        if self.phrases.tag(at, "frame_noun") is None:
            return None
        if self.phrases.tag(at + 1, "frame_link") or self.phrases.tag(at + 1, "colon"):
            return at + 2
        return None

    def _front(self) -> bool:
        """Read a place in front of its clause: "On the driveway, the ego ...", "from the east, a bus ..."."""
        if self.current is not None or self.subject_span is not None or self.links or self.label or self.fronted:
            return False
        if any(event.sentence == self.sentence for event in self.events):
            return False
        if not {"preposition", "from_side", "heading"} & self.phrases.tokens[self.at].tags.keys() and (
            self._tag("relation") not in ("ahead", "behind")
        ):
            return False
        if (site := self._junction(self.at)) is not None:
            self.at = site
            return True
        if self._tag("relation") in ("ahead", "behind") and self._fronted_relation():
            return True
        if self._tag("from_side") and self._fronted_side():
            return True
        if (area := self.phrases.area(self.at)) and area[0].lane_of is None:
            found: Area | tuple[str, Span] = area[0]
            end = area[1]
        elif heading := self.phrases.heading(self.at):
            if (also := self.phrases.area(heading[1])) and also[0].lane_of is None and also[0].heading is None:
                heading = heading[0], also[1], heading[2]  # "Eastbound on the main road, the AV ..."
                if also[0].kind != "road":
                    return False
            found, end = (heading[0], self.phrases.span(self.at, heading[1])), heading[1]
        else:
            return False
        after = end + (self.phrases.tag(end, "comma") is not None)
        if self.phrases.tag(after, "link") == "there" and (be := self._there_is(after)) is not None:
            phrase = self.phrases.noun_phrase(be)
            if phrase is None or phrase.kind == "pronoun":
                return False
            self.at = be
            self._take_subject(phrase)
            self._aside(found)
            self.subject_span = None
            return True
        inverted = self.phrases.verb(after, "come", "drive", "pull_out") is not None
        phrase = self.phrases.noun_phrase(after + inverted)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        self.at = after + inverted
        self._take_subject(phrase)
        self._aside(found)
        if inverted:
            self.subject_span = None
        return True

    def _there_is(self, at: int) -> int | None:
        """Return the position after "there is", "there should be"."""
        at += 1
        at += self.phrases.tag(at, "auxiliary") == "will"
        if self.phrases.tag(at, "be") or self.phrases.tag(at, "genitive") or self.phrases.verb(at, "exist"):
            return at + 1
        return None

    def _fronted_side(self) -> bool:
        """Read "From the right, a car ..." and "From the left comes a truck"."""
        start = self.at
        after = start + 1 + (self.phrases.tag(start + 1, "comma") is not None)
        area = self.phrases.area(after)
        if area is not None:
            after = area[1] + (self.phrases.tag(area[1], "comma") is not None)
        inverted = self.phrases.verb(after, "come", "drive", "approach") is not None
        phrase = self.phrases.noun_phrase(after + inverted)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        self.at = after + inverted
        self._take_subject(phrase)
        subject_span, end = self.subject_span, self.at
        event = self._open("drive", start)
        self.at = start
        if not self._side():
            return False
        if area is not None:
            event.areas.append(area[0])
        self.at = end
        self.subject_span = None if inverted else subject_span
        return True

    def _fronted_relation(self) -> bool:
        """Read "Ahead of it, a car ..." and "In front of the ego drives a truck"."""
        relation = self._tag("relation")
        other = self.phrases.noun_phrase(self.at + 1)
        if other is None or (other.kind == "pronoun" and self.phrases.subject is None):
            return False
        lane = self.phrases.area(other.end)  # "ahead of it in the same lane"
        end = lane[1] if lane is not None and lane[0].kind == "lane" and lane[0].heading is None else other.end
        after = end + (self.phrases.tag(end, "comma") is not None)
        inverted = self.phrases.verb(after, "come", "drive") is not None or self.phrases.tag(after, "be") is not None
        phrase = self.phrases.noun_phrase(after + inverted)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        start, whose = self.at, self.phrases.resolve(other)
        self.at = after + inverted
        self._take_subject(phrase)
        if self.subject == whose:
            raise self.phrases.refuse("a vehicle has no relation to itself", other.span)
        subject_span = self.subject_span
        event = self._open("be", start)
        place = Place("ahead" if relation == "ahead" else "behind", whose, None, self.phrases.span(start, other.end))
        event.places.append(place)
        self.subject_span = None if inverted else subject_span
        return True

    def _junction(self, at: int) -> int | None:
        """Return the position after "at the T-junction," in a sentence that only tells of a turn there."""
        found = self.phrases.landmark(at + 1) if self.phrases.tag(at, "preposition") == "at" else None
        if found is None or found[0] != "intersection" or found[2] is not None:
            return None
        verbs, end = set[str | None](), found[1]
        while self.phrases.tag(end, "end") is None:
            verbs.add(self.phrases.verb(end))
            if self.phrases.tokens[end].quantity or self.phrases.tag(end, "link") in ("when", "before", "after"):
                return None
            end += 1
        told = verbs <= {None, "turn", "pull_out", "drive", "want", "come", "be"} and verbs & {"turn", "pull_out"}
        return found[1] + (self.phrases.tag(found[1], "comma") is not None) if told else None

    def _aside(self, found: Area | tuple[str, Span]) -> None:
        """Say it of the subject in an event of its own; the subject's clause goes on."""
        subject_span = self.subject_span
        event = self._open("be", self.at - 1)
        if isinstance(found, Area):
            event.areas.append(found)
            event.span = event.span.union(found.span)
        else:
            event.headings.append(found)
            event.span = event.span.union(found[1])
        self.subject_span = subject_span

    # -- both vehicles ----------------------------------------------------------------------------------------------
    def _both(self) -> bool:
        """Read "both vehicles" and "the ego and the hero" as the subject of one clause."""
        if self.subject_span is not None or (self.current is not None and not self.links):
            return False
        at = self.at
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
        at += self.phrases.tag(at, "be") is not None
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
        second = self.phrases.noun_phrase(first.end + 1)
        if second is None or second.kind == "pronoun" or self.phrases.tag(second.end, "genitive") is not None:
            return None
        if self.phrases.tokens[first.end].text.lower() != "and":
            return None
        if self.phrases.resolve(first) == self.phrases.resolve(second):
            raise self.phrases.refuse("these are the same vehicle", self.phrases.span(at, second.end))
        return second.end

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

    # -- appositions ------------------------------------------------------------------------------------------------
    def _apposition(self) -> bool:
        """Read "the NPC, a bus, ..."."""
        if self.subject_span is None or self.subject is None or self.links[-1:] != ["comma"] or self.pair:
            return False
        phrase: NounPhrase | None = self.phrases.noun_phrase(self.at)
        if phrase is None or phrase.kind != "noun" or phrase.determiner != "indefinite" or phrase.heading:
            return False
        if self.phrases.tag(phrase.end, "comma") is None or phrase.adjectives - {"plain"}:
            return False
        refs = self.phrases.refs
        _ = refs.ego(phrase.noun) if self.subject == EGO_ID else refs.hero(phrase.noun)
        self.links.pop()
        self.subject_span = self.subject_span.union(phrase.span)
        self.at = phrase.end + 1
        return True
