"""Reads what stands around a clause: requests ("create a scenario in which"), fronted places, appositions, "both".

What enters: the reader's state at the beginning of a clause. What leaves: True where such words were read; what they
say of a vehicle goes into an event of its own. Words that ask for a scenario say nothing about it and give no event.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID, Area, Place
from scenewright.translate.pairs import PairReader
from scenewright.translate.references import NounPhrase


@dataclass(slots=True)
class FrameReader(PairReader):
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
        told = kind == "wish" or (kind == "let" and not {"and", "as_if", "to"} & set(self.links))
        phrase = self.phrases.noun_phrase(self.at + 1) if told else None
        named = phrase is not None and (phrase.kind != "pronoun" or self._told_to(phrase))
        if told and phrase is not None and named:
            self.at += 1
            self._take_subject(phrase)
            if kind == "wish" and self._tag("link") == "to":
                self.at += 1
            return True
        return False

    def _told_to(self, phrase: NounPhrase) -> bool:
        """Whether "it" is told to act: "Let it begin to brake"."""
        return self.main_subject == HERO_ID and "base" in self.phrases.tokens[phrase.end].forms and self.current is None

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
        joined = self.current is not None and self.links in (["comma", "and"], ["and"], ["comma"])
        if self.subject_span is not None or self.label or self.fronted:
            return False
        if joined and not any("when" in event.links for event in self.events if event.sentence == self.sentence):
            return self._front_joined()
        if self.current is not None or self.links:
            return False
        if any(event.sentence == self.sentence for event in self.events):
            return False
        if self._fronted_start():
            return True
        if not {"preposition", "from_side", "heading", "oncoming_way"} & self.phrases.tokens[self.at].tags.keys() and (
            self._tag("relation") not in ("ahead", "behind")
        ):
            return False
        if self._fronted_speed():
            return True
        if (site := self._junction(self.at)) is not None:
            if not self.events:
                self.phrases.last_landmark = None  # it sets the scene: "it" in what follows is a vehicle
            self.at = site
            return True
        if self._tag("relation") in ("ahead", "behind") and self._fronted_relation():
            return True
        if self._tag("from_side") and self._fronted_side():
            return True
        if self._tag("oncoming_way") and self._fronted_way():
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

    def _front_joined(self) -> bool:
        """Read ", and behind it a motorcycle also turns right" and "and on the road a bus drives west"."""
        relation = self._tag("relation") in ("ahead", "behind")
        at = self.at + 1
        if relation and (other := self.phrases.noun_phrase(at)) is not None:
            at = other.end
        elif (area := self.phrases.area(self.at)) is not None and area[0].lane_of is None:
            at = area[1]
        else:
            return False
        at += self.phrases.tag(at, "comma") is not None
        phrase = self.phrases.noun_phrase(at)
        if phrase is None or phrase.kind == "pronoun":
            return False
        after = phrase.end + (self.phrases.tag(phrase.end, "adverb") is not None)
        token = self.phrases.tokens[after]
        verbless = relation and (bool(token.tags.keys() & {"end", "comma"}) or self.phrases.area(after) is not None)
        if not (verbless or token.tags.keys() & {"be", "auxiliary"} or token.forms & {"s"}):
            return False
        links, self.links = self.links, []
        if relation and self._fronted_relation():
            self.subject_span = None if verbless else self.subject_span  # ", and in front of it a van."
            return True
        if not relation and area is not None:
            self.at = at
            self._take_subject(phrase)
            self._aside(area[0])
            return True
        self.links = links
        return False

    def _there_is(self, at: int) -> int | None:
        """Return the position after "there is", "there should be"."""
        at += 1
        at += self.phrases.tag(at, "auxiliary") == "will"
        if self.phrases.tag(at, "be") or self.phrases.tag(at, "genitive") or self.phrases.verb(at, "exist"):
            return at + 1
        return None

    def _fronted_speed(self) -> bool:
        """Read "With an initial speed of 55 km/h the ego goes west"."""
        if self._tag("preposition") not in ("with", "at"):
            return False
        measured = self.phrases.measured(self.at + 1)
        at = self.phrases.skip_hedges(self.at + 1)
        amount, end = (measured[1], measured[2]) if measured is not None else (self.phrases.tokens[at].quantity, at + 1)
        if amount is None or amount.dimension != "speed":
            return False
        end += self.phrases.tag(end, "comma") is not None
        phrase = self.phrases.noun_phrase(end)
        drives = phrase is not None and self.phrases.verb(phrase.end, "drive", "go", "lane_follow", "approach", "come")
        if phrase is None or phrase.kind == "pronoun" or not drives:
            return False
        start, self.at = self.at, end
        self._take_subject(phrase)
        subject_span = self.subject_span
        self._open("be", start).speed = amount
        self.subject_span = subject_span
        return True

    def _fronted_start(self) -> bool:
        """Read "On the road, 110 m before the intersection, the ego travels west": where it is at the start."""
        at, start = self.at, self.at
        out = self.phrases.tokens[at].text.lower() == "from"
        area = None if out else self.phrases.area(at)
        if area is not None:
            at = area[1] + (self.phrases.tag(area[1], "comma") is not None)
        found = self.phrases.place(at + out)
        if found is None or found[0].amount is None or not isinstance(found[0].target, str):
            return False
        if found[0].amount.dimension != "length" or (area is not None and area[0].lane_of is not None):
            return False
        end = found[1] + (self.phrases.tag(found[1], "comma") is not None)
        phrase = self.phrases.noun_phrase(end)
        if phrase is None or phrase.kind == "pronoun" or not self._only_travels(phrase.end, at_speed=not out):
            return False
        if any("when" in event.links or event.mode == "when" for event in self.events):
            return False
        self.at = end
        self._take_subject(phrase)
        subject_span = self.subject_span
        event = self._open("be", start)
        event.initial = True
        event.places.append(found[0])
        if area is not None:
            event.areas.append(area[0])
        event.span = event.span.union(found[0].span)
        self.subject_span = subject_span
        return True

    def _only_travels(self, at: int, *, at_speed: bool) -> bool:
        """Whether the clause at `at` tells how a vehicle travels, and its sentence of no action and no moment."""
        first = at + (self.phrases.tokens[at].tags.keys() & {"be"} != set())
        if self.phrases.verb(first, "drive", "lane_follow", "approach") is None:
            return False
        while self.phrases.tag(at, "end") is None:
            token = self.phrases.tokens[at]
            told = {None, "drive", "lane_follow", "approach", "turn", "pull_out", "want"}
            timed = token.tags.get("link") in ("when", "before", "after", "until", "only")
            if token.tags.get("verb") not in told or timed or token.tags.keys() & {"negation", "colon"}:
                return False
            if token.quantity is not None and not (at_speed and token.quantity.dimension == "speed"):
                return False
            at += 1
        return True

    def _subject_after_front(self) -> tuple[NounPhrase, tuple[Area, int] | None, bool] | None:
        """Take the subject behind a fronted word, with an area before it and whether its verb comes first."""
        after = self.at + 1 + (self.phrases.tag(self.at + 1, "comma") is not None)
        area = self.phrases.area(after)
        if area is not None:
            after = area[1] + (self.phrases.tag(area[1], "comma") is not None)
        inverted = self.phrases.verb(after, "come", "drive", "approach") is not None
        phrase = self.phrases.noun_phrase(after + inverted)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is not None:
            return None
        self.at = after + inverted
        self._take_subject(phrase)
        return phrase, area, inverted

    def _fronted_side(self) -> bool:
        """Read "From the right, a car ..." and "From the left comes a truck"."""
        start = self.at
        found = self._subject_after_front()
        if found is None:
            return False
        phrase, area, inverted = found
        subject_span, end = self.subject_span, self.at
        event = self._open("drive", start)
        self.at = start
        side = self._tag("from_side") or ""
        if side.startswith("on_"):  # "To its left, a van approaches"
            if inverted or self.subject is None or not self.phrases.verb(phrase.end, "come", "approach"):
                return False
            event.relations.append((f"from_{side.removeprefix('on_')}", self.subject, self.phrases.tokens[start].span))
        elif not self._side():
            return False
        if area is not None:
            event.areas.append(area[0])
        self.at = end
        self.subject_span = None if inverted else subject_span
        return True

    def _fronted_way(self) -> bool:
        """Read "From the other direction comes a hero" and "In the opposite direction, a car ..."."""
        start = self.at
        found = self._subject_after_front()
        if found is None:
            return False
        _, area, inverted = found
        if self.subject is None:
            return False
        subject_span = self.subject_span
        event = self._open("drive", start)
        event.relations.append(("oncoming", self.subject, self.phrases.tokens[start].span))
        if area is not None:
            event.areas.append(area[0])
        self.subject_span = None if inverted else subject_span
        return True

    def _fronted_relation(self) -> bool:
        """Read "Ahead of it, a car ..." and "In front of the ego drives a truck"."""
        relation = self._tag("relation")
        other = self.phrases.noun_phrase(self.at + 1)
        if other is None or (other.kind == "pronoun" and self.phrases.subject is None):
            return False
        begin = other.end + (self.phrases.tag(other.end, "comma") is not None)
        spoken_of = self.phrases.subject
        if other.kind in ("ego", "hero"):
            self.phrases.subject = self.phrases.resolve(other)  # "ahead of the ego, in its lane, ..."
        lane = self.phrases.area(begin)  # "ahead of it in the same lane", "ahead of it, on the driveway,"
        self.phrases.subject = spoken_of
        if lane is not None and (lane[0].role != "on" or lane[0].heading is not None):
            lane = None
        end = lane[1] if lane is not None else other.end
        after = end + (self.phrases.tag(end, "comma") is not None)
        inverted = self.phrases.verb(after, "come", "drive") is not None or self.phrases.tag(after, "be") is not None
        there = self._there_is(after) if self.phrases.tag(after, "link") == "there" else None
        if there is not None:  # "in front of it there is a car"
            inverted, after = True, there - 1
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
        if lane is not None and lane[0].kind != "lane":
            event.areas.append(lane[0])
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

    def _apposition(self) -> bool:
        """Read "the NPC, a bus, ..."."""
        if self.subject_span is None or self.subject is None or self.links[-1:] != ["comma"] or self.pair:
            return False
        phrase: NounPhrase | None = self.phrases.noun_phrase(self.at)
        if phrase is not None and phrase.kind in ("ego", "hero") and "comma" in self.phrases.tokens[phrase.end].tags:
            if self.phrases.resolve(phrase) != self.subject:  # "the front one, the hero, turns right"
                return False
            self.links.pop()
            self.at = phrase.end + 1
            return True
        noted = "colon" in self.phrases.tokens[self.at - 1].tags and phrase is not None and phrase.determiner is None
        if phrase is None or phrase.kind != "noun" or phrase.heading:
            return False
        if phrase.determiner != "indefinite" and not noted and phrase.noun not in ("front_one", "rear_one"):
            return False
        if phrase.noun in ("front_one", "rear_one"):  # "the hero, the front one, turns left"
            self.phrases.described += [
                (each, self.subject, phrase.span) for each in phrase.adjectives & {"lead", "rear"}
            ]
            phrase.adjectives.clear()
        if self.phrases.tag(phrase.end, "comma") is None or phrase.adjectives - {"plain"}:
            return False
        refs = self.phrases.refs
        _ = refs.ego(phrase.noun) if self.subject == EGO_ID else refs.hero(phrase.noun)
        if not noted:  # "lead: sedan, same lane": notes go on after a comma
            self.links.pop()
        self.subject_span = self.subject_span.union(phrase.span)
        self.at = phrase.end + 1
        return True
