"""Reads what stands beside a verb: amounts, places, areas, headings, directions.

What enters: the reader's state at some token. What leaves: True where an adjunct was read and put into its event.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.translate.events import Event
from scenewright.translate.place_adjuncts import PlaceAdjunctReader
from scenewright.translate.reader import TURNS
from scenewright.translate.tokens import Quantity


@dataclass(slots=True)
class AdjunctReader(PlaceAdjunctReader):
    """Puts adjuncts into the event that they belong to."""

    def _adjunct(self) -> bool:
        return (
            self._each_its_own()
            or self._particle()
            or self._shared_place()
            or self._amount_adjunct()
            or self._stop_adjunct()
            or self._place_adjunct()
            or self._through()
            or self._for_whom()
            or self._reached_in()
            or self._side()
            or self._oncoming()
            or self._way_adjunct()
        )

    def _parenthesis(self) -> bool:
        """Read "the ego (13 m/s)" and "the hero (westbound)": said of the vehicle that was named just before."""
        if self.phrases.tokens[self.at].text != "(" or self.phrases.last_named is None:
            return False
        actor, end = self.phrases.last_named
        if end != self.at:
            return False
        event = Event("be", actor, self.phrases.tokens[self.at - 1].span, self.sentence, ["that"])
        at = self.at + 1
        while self.phrases.tokens[at].text != ")":
            quantity, heading = self.phrases.tokens[at].quantity, self.phrases.heading(at)
            if quantity is not None and quantity.dimension == "speed" and event.speed is None:
                event.speed, at = quantity, at + 1
            elif heading is not None:
                event.headings.append((heading[0], self.phrases.span(at, heading[1])))
                at = heading[1]
            elif self.phrases.tag(at, "direction") and self.phrases.tag(at + 1, "event_noun") == "turn":
                turn = Event("turn", actor, self.phrases.span(at, at + 2), self.sentence, ["that"], wanted=True)
                turn.direction = self.phrases.tag(at, "direction")
                self.events.append(turn)
                at += 2
            elif area := (self.phrases.area(at) or self.phrases.area_noun(at, "on")):
                event.areas.append(area[0])
                at = area[1]
            elif self.phrases.tag(at, "comma") is not None or self.phrases.tag(at, "preposition") == "at":
                at += 1
            else:
                return False
        event.span = self.phrases.span(self.at - 1, at + 1)
        self.events.append(event)
        self.at = at + 1
        return True

    def _particle(self) -> bool:
        """Step over "along" in "comes along westbound", "forward" in "creeps forward"."""
        if self.current is None or self.current.verb not in ("drive", "approach", "pull_out") or self.links:
            return False
        word, after = self.phrases.tokens[self.at].text.lower(), self.phrases.tokens[self.at + 1].tags
        if word not in ("along", "forward", "forwards", "on", "down", "up") or after.keys() & {"determiner", "area"}:
            return False
        if self.phrases.area(self.at) or self.phrases.heading(self.at) or self.phrases.place(self.at):
            return False
        self.at += 1
        self._grow()
        return True

    def _amount_adjunct(self) -> bool:
        at = self.at
        preposition = self.phrases.tag(at, "preposition")
        if preposition in ("at", "with", "to", "for", "by", "of") or self.phrases.tag(at, "link") == "to":
            at += 1
        quantity: Quantity | None
        measured = self.phrases.measured(at)
        behind = self.current is not None and self.current.places and self.current.places[-1].relation == "behind"
        if measured is not None and measured[0] in ("headway", "length") and behind and not self.links:
            place = self.current.places[-1] if self.current else None
            if self.current is not None and place is not None and place.amount is None:
                self.current.places[-1] = replace(place, amount=measured[1])  # "follows at a headway of 2 s"
                self.at = measured[2]
                self._grow()
                return True
        if measured is not None and measured[0] in ("rate", "speed"):
            quantity, end = measured[1], measured[2]
        else:
            at = self.phrases.skip_hedges(at)
            quantity, end = self.phrases.tokens[at].quantity, at + 1
        waits = self.current is not None and self.current.verb == "wait" and not self.links
        timed = preposition == "for" or (waits and quantity is not None and quantity.dimension == "time")
        if quantity is None or (quantity.dimension in ("length", "time") and not timed):
            return False
        if waits and preposition != "for" and self.phrases.place(self.at):
            return False
        if quantity.dimension == "acceleration" and self.phrases.tag(end, "measure") == "rate":
            end += 1  # "with 4 m/s^2 deceleration"
        if quantity.dimension == "speed" and self.phrases.tag(end, "measure") == "speed":
            end += 1
        host = self._host()
        if host is None:
            return False
        to = preposition == "to" or self.phrases.tokens[self.at].text.lower() == "to"
        slot = {"speed": "to_speed" if to else "speed", "acceleration": "rate", "time": "duration"}.get(
            quantity.dimension
        )
        if slot is None or getattr(host, slot) is not None:
            return False
        setattr(host, slot, quantity)
        self.at = end
        self._grow()
        return True

    def _way_adjunct(self) -> bool:
        """Read areas, headings, directions and what a vehicle drives towards."""
        towards = self._tag("preposition") == "to" and self.current is not None and self.current.verb == "drive"
        if towards and self.current is not None and not self.links and self.current.landmark is None:
            found = self.phrases.landmark(self.at + 1)
            if found is not None and found[2] in (None, self.current.actor):
                self.current.verb = "approach"
                if found[3]:
                    self.phrases.assume(
                        f"'{self.phrases.span(self.at, found[1]).excerpt(self.phrases.text)}' is no turn"
                    )
                else:
                    self.current.landmark = "turn_start" if found[0] == "mouth" else found[0]
                self.at = found[1]
                self._grow()
                return True
        if area := self.phrases.area(self.at):
            host = self._host()
            if host is None:
                return False
            host.areas.append(area[0])
            self.at = area[1]
            self._grow()
            return True
        if (
            self.current is not None
            and (self.current.verb in ("leave", "pull_out") or self._uses())
            and (area := self.phrases.area_noun(self.at, self._role_of(self.current)))
        ):
            self.current.areas.append(area[0])
            self.at = area[1]
            self._grow()
            return True
        if heading := self.phrases.heading(self.at):
            host = self._host_of_heading(heading[1])
            if host is None:
                return False
            host.headings.append((heading[0], self.phrases.span(self.at, heading[1])))
            self.at = heading[1]
            self._grow()
            return True
        return self._direction()

    def _uses(self) -> bool:
        """Whether a verb takes its lane without a preposition: "uses the westbound lane"."""
        before = self.phrases.tokens[self.at - 1]
        return before.tags.get("verb") == "drive" and before.text.lower().split()[0].startswith(
            ("us", "occup", "keep", "kept", "stick")
        )

    def _role_of(self, event: Event) -> str:
        """Whether a vehicle comes out of what stands after its verb, or goes into it: "joins the road"."""
        words = event.span.excerpt(self.phrases.text).lower().split()
        if self._uses():
            return "on"
        return "into" if any(word.startswith(("join", "merg")) for word in words) else "from"

    def _host_of_heading(self, end: int) -> Event | None:
        if self.links and self.current is not None and self.current.verb in TURNS and "comma" in self.links:
            gerund = "ing" in self.phrases.tokens[self.at].forms
            if gerund and self.links == ["comma"]:  # "turns left, heading east"
                self.links = []
                return self.current
        return self._host()

    def _for_whom(self) -> bool:
        """Read "stops for the ego"."""
        event = self.current
        if (
            event is None
            or self.links
            or self._tag("preposition") != "for"
            or event.verb not in ("stop", "brake", "yield")
        ):
            return False
        phrase = self.phrases.noun_phrase(self.at + 1)
        if phrase is None or event.to_actor is not None or event.actor is None:
            return False
        event.to_actor = 1 - event.actor if phrase.kind == "pronoun" else self.phrases.resolve(phrase)
        self.at = phrase.end
        self._grow()
        return True

    def _through(self) -> bool:
        """Read "accelerates through the conflict point" as two verbs."""
        beyond = self._tag("relation") == "past" and self.current is not None and not self.links
        if beyond and self.current is not None and self.current.verb in ("drive", "lane_follow", "go"):
            found = self.phrases.landmark(self.at + 1)
            if found is not None and found[3]:  # "drives straight past a driveway"
                self.current.direction = self.current.direction or "straight"
                self.at = found[1]
                self._grow()
                return True
        on_its_way = self.current is not None and self.current.verb in ("drive", "lane_follow", "go") and not self.links
        if on_its_way and self._tag("through") is not None and not self.flags:
            found = self.phrases.landmark(self.at + 1)
            if found is not None and found[0] == "intersection" and found[2] is None:
                self.at = found[1]  # "continues straight through the T-junction"
                self._grow()
                return True
        past = self._tag("through") is not None or self._tag("relation") == "past"
        if not past or self.current is None or self.current.verb not in ("accelerate", "go", "keep", "drive"):
            return False
        found = self.phrases.landmark(self.at + 1)
        if found is None:
            return False
        self.links.append("to")
        event = self._open("pass", self.at)
        event.landmark = "turn_start" if found[0] == "mouth" else found[0]
        self.at = found[1]
        self._grow()
        return True

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
        elif self.phrases.tokens[at].text.lower() in ("with", "by", "for", "in") and self._turn_after(at + 1):
            at = self.phrases.skip_determiner(at + 1)  # "leaves the driveway with a left turn"
            host = self.current
            if host is not None and host.verb in ("leave", "pull_out", "turn", "drive") and host.direction is None:
                host.direction = self.phrases.tag(at, "direction")
                self.at = at + 2
                self._grow()
                return True
            return False
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
        host = self.current
        if (
            host is not None
            and host.verb in ("be", "drive", "go")
            and direction == "straight"
            and self.links == ["comma"]
        ):
            self.links = []  # "Ego: westbound, straight"
        allowed: tuple[str, ...] = TURNS if direction != "straight" else ("drive", "lane_follow", "go", "be")
        if direction != "straight" and at > self.at:  # "leaves the driveway to the left"
            allowed = (*TURNS, "leave", "drive", "go")
        elif direction != "straight" and host is not None and host.verb == "go":
            allowed = (*TURNS, "go")
        if host is None or host.verb not in allowed or host.direction is not None or self.links:
            return False
        host.direction = direction
        self.at = at + 1
        on_area = (
            self.phrases.area_noun(self.at, "on") if self.phrases.tokens[at].text.lower().endswith(" on") else None
        )
        if on_area is not None:  # "straight on the main road"
            host.areas.append(on_area[0])
            self.at = on_area[1]
        self._grow()
        return True

    def _turn_after(self, at: int) -> bool:
        at = self.phrases.skip_determiner(at)
        return self.phrases.tag(at, "direction") is not None and self.phrases.tag(at + 1, "event_noun") == "turn"

    def _bare(self) -> bool:
        """Read telegraphic notes: "Ego: driveway, left turn, eastbound"."""
        if self.label in ("none", "start") and self.subject is None and self._tag("landmark") == "intersection":
            self.at += 1  # "Scenario: T-junction, ..."
            return True
        if "comma" not in self.links or self.subject is None:
            return False
        area = self.phrases.area_noun(self.at, "on")
        if area is None:
            return False
        host = self._host()
        if host is None:
            return False
        host.areas.append(area[0])
        self.at = area[1]
        self._grow()
        return True
