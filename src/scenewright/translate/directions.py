"""Reads which way a vehicle goes: "oncoming", "to the left", "for a left turn", "no turn".

What enters: the reader's state at such words. What leaves: True where they were put into an event, or opened one.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.parentheses import ParenthesisReader
from scenewright.translate.reader import TURNS


@dataclass(slots=True)
class DirectionReader(ParenthesisReader):
    """Reads directions."""

    def _oncoming(self) -> bool:
        """Read "is oncoming" and "in the opposite direction"."""
        event = self.current
        if event is None and self.subject_span is not None and self._tag("actor_adjective") == "oncoming":
            event = self._host()  # "GVT oncoming."
        other_way = self._tag("oncoming_way") is not None or (
            self._tag("preposition") in ("in", "out")
            and self.phrases.tag(self.phrases.skip_determiner(self.at + 1), "actor_adjective") == "oncoming"
        )
        if event is None and self.subject_span is not None and other_way:
            event = self._host()  # "a car from the opposite direction turns left"
            self.reduced = event
        if event is None or event.actor is None or self.links:
            return False
        if self._tag("oncoming_way") and event.verb in ("be", "drive", "approach"):  # "coming the other way"
            event.relations.append(("oncoming", event.actor, self.phrases.tokens[self.at].span))
            self.at += 1
            to = self._tag("preposition") in ("to", "of", "as", "out")
            whose = self.phrases.noun_phrase(self.at + 1) if to else None
            if whose is not None and whose.kind != "pronoun" and self.phrases.resolve(whose) != event.actor:
                self.at = whose.end  # "in the opposite direction to the ego"
            self._grow()
            return True
        if self._tag("preposition") in ("in", "out"):  # "in the opposite direction", "from the opposite direction"
            at = self.phrases.skip_determiner(self.at + 1)
            if self.phrases.tag(at, "actor_adjective") == "oncoming" and self.phrases.tag(at + 1, "direction_noun"):
                event.relations.append(("oncoming", event.actor, self.phrases.span(self.at, at + 2)))
                self.at = at + 2
                other = (
                    self.phrases.noun_phrase(self.at + 1) if self._tag("preposition") in ("to", "of", "as") else None
                )
                if other is not None and other.kind != "pronoun" and self.phrases.resolve(other) != event.actor:
                    self.at = other.end  # "in the opposite direction to the ego"
                self._grow()
                return True
        if event.verb != "be":
            return False
        if self._tag("actor_adjective") != "oncoming" or self.phrases.noun_phrase(self.at) is not None:
            return False
        event.relations.append(("oncoming", event.actor, self.phrases.tokens[self.at].span))
        self.at += 1
        self._grow()
        return True

    def _direction(self) -> bool:
        at = self.at
        if self.phrases.tag(at, "preposition") == "to":
            at = self.phrases.skip_determiner(at + 1)
        elif self._carries_a_turn(at) and self._turn_after(at + 1):
            at = self.phrases.skip_determiner(at + 1)  # "leaves the driveway with a left turn"
            host = self.current
            carries = ("leave", "pull_out", "turn", "drive")
            if host is not None and host.verb in carries and host.direction is None and not self.links:
                host.direction = self.phrases.tag(at, "direction")
                self.at = at + 2
                self._grow()
                return True
            return self._turn_beside(at)
        elif self.phrases.tag(at, "determiner") and self.phrases.tag(at + 2, "event_noun") == "turn":
            at += 1
        direction = self.phrases.tag(at, "direction")
        if direction is None:
            return False
        if self.phrases.tag(at + 1, "event_noun") == "turn":  # "left turn" without a verb
            if self.current is not None and not self.links:
                return False
            event = self._open("turn", at)
            event.wanted, event.direction = True, direction
            self.at = at + 2
            self._grow()
            return True
        if direction != "straight" and self._bare_turn(at):
            return True
        named = self.current is None and self.subject_span is not None and self.links == ["comma"]
        if direction == "straight" and named:
            self.links = []
            self._open("be", at)  # "Oncoming SUV, no turn."
        if self.links == ["and"] and at > self.at and self.current is not None and self.current.verb in TURNS:
            self.links = []  # "wants out of the driveway and to the right"
        host = self.current
        if (
            host is not None
            and host.verb in ("be", "drive", "go", "lane_follow")
            and direction == "straight"
            and self.links == ["comma"]
        ):
            self.links = []  # "Ego: westbound, straight"
        allowed: tuple[str, ...] = TURNS if direction != "straight" else ("drive", "lane_follow", "go", "be")
        if direction != "straight" and at > self.at:  # "leaves the driveway to the left"
            allowed = (*TURNS, "leave", "drive", "go")
        elif direction != "straight" and host is not None and host.verb == "leave":
            allowed = (*TURNS, "leave")  # "exits the driveway rightwards"
        elif direction != "straight" and host is not None and host.verb == "go":
            allowed = (*TURNS, "go")
        if host is None or host.verb not in allowed or host.direction is not None or self.links:
            return False
        host.direction = direction
        if "turn" in self.phrases.tokens[at].text.lower():  # "no turn", "without turning"
            host.notes.append("no turn")
        self.at = at + 1
        through = self.phrases.landmark(self.at) if self.phrases.tokens[at].text.lower().endswith("through") else None
        if through is not None and through[0] == "intersection" and through[2] is None:
            self.at = through[1]  # "travels west, straight through the junction"
        on_area = (
            self.phrases.area_noun(self.at, "on") if self.phrases.tokens[at].text.lower().endswith(" on") else None
        )
        if on_area is not None:  # "straight on the main road"
            host.areas.append(on_area[0])
            self.at = on_area[1]
        self._grow()
        return True

    def _bare_turn(self, at: int) -> bool:
        """Read "Ego: driveway, left" and "(left into the driveway)": a turn without its verb."""
        follows = self.phrases.tokens[at + 1].tags
        ends = bool(follows.keys() & {"comma", "end"}) or follows.get("preposition") in ("into", "out")
        alone = self.subject_span is not None or (self.current is not None and self.links == ["comma"])
        if at != self.at or not ends or not alone or self.subject is None or self.pair:
            return False
        if self.current is not None and self.links == ["comma"] and self.current.verb in (*TURNS, "leave"):
            return False
        event = self._open("turn", at)
        event.wanted, event.direction = True, self.phrases.tag(at, "direction")
        self.at = at + 1
        self._grow()
        return True

    def _carries_a_turn(self, at: int) -> bool:
        """Whether "with", "by means of", "for" stand here, in front of "a left turn"."""
        words = self.phrases.tokens[at].text.lower()
        return words in ("with", "by", "for", "in", "via") or self.phrases.tag(at, "preposition") == "with"

    def _turn_beside(self, at: int) -> bool:
        """Read "approaches from the driveway for a left turn": what a vehicle is about to do."""
        told = ("approach", "be", "sit", "wait", "go", "drive", "reach", "want", "lane_follow")
        if self.subject is None or (self.current is not None and self.current.verb not in told):
            return False
        if self.current is None and self.subject_span is None:
            return False
        self.links = [link for link in self.links if link != "comma"] or ["and"]
        event = self._open("turn", at)
        event.wanted, event.direction = True, self.phrases.tag(at, "direction")
        self.at = at + 2
        self._grow()
        return True

    def _turn_after(self, at: int) -> bool:
        at = self.phrases.skip_determiner(at)
        return self.phrases.tag(at, "direction") is not None and self.phrases.tag(at + 1, "event_noun") == "turn"
