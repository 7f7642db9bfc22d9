"""Reads how a clause brings in what it is about: "there is a car ...", "the ego's intent is to ...".

What enters: the reader's state at the beginning of a clause. What leaves: True where such an opening was read.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import Event, Place
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
        at = after
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

    def _intention(self) -> bool:
        """Read "the ego's intent is to ..."."""
        owner = self.phrases.possessor(self.at)
        is_to = owner is not None and self.phrases.tokens[owner[1] + 1].text.lower() in ("is to", "was to")
        if owner and self.phrases.tag(owner[1], "aspect") and self.phrases.tag(owner[1] + 1, "be"):
            if self.phrases.place(owner[1] + 2) is None:
                return False
            self._check_subject_used()
            self._set_subject(owner[0], self.phrases.span(self.at, owner[1] + 1))  # "the ego's position is 12 m before"
            self.current, self.at = None, owner[1] + 1
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
        return True
