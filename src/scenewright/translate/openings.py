"""Reads how a clause brings in what it is about: "there is a car ...", "the ego's intent is to ...".

What enters: the reader's state at the beginning of a clause. What leaves: True where such an opening was read.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import Area, Event, Place
from scenewright.translate.frames import FrameReader


@dataclass(slots=True)
class OpeningReader(FrameReader):
    """Reads openings."""

    def _existence(self) -> bool:
        """Read "there is a hero vehicle ..." and "there is a driveway 100 m in front of the ego"."""
        if self._tag("link") != "there":
            return False
        after = self._there_is(self.at)
        if after is None:
            return False
        at = after + (self.phrases.tag(after, "adverb") == "filler")
        measured = self.phrases.measured(at)
        if (
            self.phrases.tokens[at].quantity is not None or (measured and measured[0] != "speed")
        ) and self.links:  # "when there are 12 m between ..."
            self.at = at
            return True
        found = self.phrases.landmark(at)
        if found is not None:
            return self._landmark_ahead(found[0], at, found[1])
        phrase = self.phrases.noun_phrase(at)
        if phrase is None:
            return False
        self.at = at
        self._take_subject(phrase)
        self._open("be", self.at - 1)
        return True

    def _landmark_ahead(self, name: str, at: int, end: int) -> bool:
        start = self.at
        place = self.phrases.place(end)
        if place is None or place[0].relation not in ("ahead", "from") or not isinstance(place[0].target, int):
            return False
        ahead, end = place
        event = Event("be", int(ahead.target), self.phrases.span(start, end), self.sentence, self.links, initial=True)
        landmark = "turn_start" if name == "mouth" else name
        event.places.append(Place("before", landmark, ahead.amount, ahead.span, vague=name == "turn"))
        self.events.append(event)
        self.links, self.at, self.current, self.subject = [], end, event, None
        if self._tag("link") == "that" and self.phrases.verb(end + 1, "pull_out"):  # "that merges into the ego's lane"
            area = self.phrases.area(end + 2)
            if area and area[0].lane_of is not None:
                event.relations.append(("driveway_joins", area[0].lane_of, self.phrases.span(end, area[1])))
                self.at = area[1]
                self._grow()
        return True

    def _nominal_turn(self) -> bool:
        """Read "Unprotected left turn out of the driveway by the AV against a westbound van"."""
        if self.current is not None or self.subject_span is not None or self.links or self.label or self.fronted:
            return False
        start = self.at
        at = self.phrases.skip_determiner(start)
        while self.phrases.tag(at, "actor_adjective") == "plain":
            at += 1
        direction = self.phrases.tag(at, "direction")
        if direction not in ("left", "right"):
            return False
        at += 1 + (self.phrases.tag(at + 1, "event_noun") == "turn")
        areas: list[Area] = []
        actor: int | None = None
        while "end" not in self.phrases.tokens[at].tags:
            token = self.phrases.tokens[at]
            if (area := self.phrases.area(at)) is not None and area[0].lane_of is None:
                areas.append(area[0])
                at = area[1]
            elif actor is None and token.text.lower() in ("by", "of", "for"):
                phrase = self.phrases.noun_phrase(at + 1)
                if phrase is None or phrase.kind == "pronoun":
                    return False
                actor, at = self.phrases.resolve(phrase), phrase.end
            else:
                break
        if actor is None:
            return False
        against = self.phrases.tokens[at].text.lower() in ("against", "versus", "vs", "before", "with")
        other = self.phrases.noun_phrase(at + 1) if against else None
        if not self.phrases.tokens[at].tags.keys() & {"end", "comma"} and (other is None or other.kind == "pronoun"):
            return False
        self._set_subject(actor, self.phrases.span(start, at))
        event = self._open("turn", start)
        event.wanted, event.direction, event.areas = True, direction, areas
        self.at = at
        self._grow()
        if other is not None:
            self.at += 1
            self._take_subject(other)
            self._open("be", self.at - 1)
        return True

    def _intention(self) -> bool:
        """Read "the ego's intent is to ..."."""
        owner = self.phrases.possessor(self.at)
        is_to = owner is not None and self.phrases.tokens[owner[1] + 1].text.lower() in ("is to", "was to")
        way = owner is not None and self._way_told(owner[1])
        if owner and self.phrases.tag(owner[1], "aspect") and self.phrases.tag(owner[1] + 1, "be") and not way:
            if self.phrases.place(owner[1] + 2) is None:
                return False
            self._check_subject_used()
            self._set_subject(owner[0], self.phrases.span(self.at, owner[1] + 1))  # "the ego's position is 12 m before"
            self.current, self.at = None, owner[1] + 1
            if self.phrases.tag(owner[1], "aspect") == "start":
                self.flags.add("initial")
            return True
        noted = owner is not None and self.phrases.tag(owner[1] + 1, "colon") is not None
        if owner and noted and (self.phrases.tag(owner[1], "aspect") or self.phrases.tag(owner[1], "intent_noun")):
            self._check_subject_used()
            self._set_subject(owner[0], self.phrases.span(self.at, owner[1] + 1))  # "The ego's route: eastbound, left"
            self.links.append("comma")
            self.current, self.at = None, owner[1] + 2
            return True
        if owner and self.phrases.tag(owner[1], "intent_noun") and (self.phrases.tag(owner[1] + 1, "be") or is_to):
            return self._intent(owner[0], owner[1] + 2)
        return False

    def _intent(self, actor: int, at: int) -> bool:
        self._set_subject(actor, self.phrases.span(self.at, at))
        self.flags.add("wanted")
        if self.phrases.tag(at, "link") == "to":
            at += 1
        self.at = at
        if self._way_told(at - 2):
            at = self.phrases.skip_determiner(at)
            direction = self.phrases.tag(at, "direction")
            event = self._open("lane_follow" if direction == "straight" else "turn", self.at)
            event.wanted, event.direction = True, direction
            self.at = at + 1 + (direction != "straight")
            self._grow()
        return True

    def _way_told(self, at: int) -> bool:
        """Whether "route is straight on" or "route is a left turn" stands at `at`."""
        if not (self.phrases.tag(at, "intent_noun") and self.phrases.tag(at + 1, "be")):
            return False
        after = self.phrases.skip_determiner(at + 2)
        direction = self.phrases.tag(after, "direction")
        turns = direction in ("left", "right") and self.phrases.tag(after + 1, "event_noun") == "turn"
        straight = direction == "straight" and after == at + 2
        return turns or straight
