"""Reads what stands beside a verb: amounts, places, areas, headings, directions.

What enters: the reader's state at some token. What leaves: True where an adjunct was read and put into its event.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.translate.directions import DirectionReader
from scenewright.translate.events import Event
from scenewright.translate.reader import TURNS
from scenewright.translate.tokens import Quantity


@dataclass(slots=True)
class AdjunctReader(DirectionReader):
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

    def _particle(self) -> bool:
        """Step over "along" in "comes along westbound", "forward" in "creeps forward", "by" in "passes by west"."""
        passing = self.current is not None and self.current.verb == "pass" and self.current.landmark is None
        by = self.phrases.tokens[self.at].text.lower() == "by" and self.phrases.heading(self.at + 1) is not None
        if passing and by and self.current is not None and not self.links:
            self.current.verb = "drive"
            self.at += 1
            return True
        emphatic = self.phrases.tokens[self.at].text.lower() in ("itself", "himself", "herself")
        if emphatic and self.at and self.phrases.tokens[self.at - 1].tags.keys() & {"landmark", "noun", "hero"}:
            self.at += 1  # "the conflict point itself"
            return True
        announces = self.phrases.tokens[self.at].text.lower() == "as follows" and self.current is not None
        if announces and not self.links and self._tag("end", 1):
            self.at += 1  # "gives way to it as follows."
            return True
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
        words = [each.text.lower() for each in self.phrases.tokens[max(0, self.at - 1) : end]]
        if slot == "speed" and any(each.startswith(("initial", "starting", "beginning")) for each in words):
            host.initial = True  # "straight on, starting at 50 km/h, when the ego has ..."
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
        if way := self._tag("way"):
            host = self._host()
            if host is None:
                return False
            span = self.phrases.tokens[self.at].span
            begin, end = way.split()
            host.headings.append((begin, span))
            host.ends.append((end, span))
            self.phrases.assume(f"'{self.phrases.tokens[self.at].text}' tells headings: first {begin}, then {end}")
            self.at += 1
            self._grow()
            return True
        facing = self.phrases.tokens[self.at].text.lower() == "facing"
        if facing and (faced := self.phrases.area_noun(self.at + 1, "towards")) and faced[0].kind == "road":
            host = self._host() if faced[0].heading is None else None
            if host is None:
                return False
            host.areas.append(replace(faced[0], role="from", kind="driveway"))  # who faces the road is not on it
            self.at = faced[1]
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
        event = self.current
        moves = event is not None and (
            event.verb in ("drive", "lane_follow", "go", "keep") or (event.verb == "be" and bool(event.headings))
        )
        if beyond and moves and self.current is not None:
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
        ended = self.phrases.tokens[self.at - 1].text.lower().endswith(" through") and on_its_way
        if ended and (found := self.phrases.landmark(self.at)) and found[0] == "intersection" and found[2] is None:
            self.at = found[1]  # the verb is "continues straight through"
            self._grow()
            return True
        if self._as_far_as():
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

    def _as_far_as(self) -> bool:
        """Read "accelerates up to the conflict point" as two verbs."""
        far = self._tag("as_far_as") or self._tag("link") in ("until", "to") or self._tag("preposition") == "to"
        if not far or self.current is None or self.links or self.current.verb not in ("accelerate", "go", "keep"):
            return False
        found = self.phrases.landmark(self.at + 1)
        if found is None or found[3]:
            return False
        self.links.append("to")
        event = self._open("reach", self.at)
        event.landmark = "turn_start" if found[0] == "mouth" else found[0]
        self.at = found[1]
        self._grow()
        return True

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
