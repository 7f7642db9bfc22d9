"""Reads what stands beside a verb: amounts, places, areas, headings, directions.

What enters: the reader's state at some token. What leaves: True where an adjunct was read and put into its event.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.translate.events import EGO_ID, Area, Event, Place
from scenewright.translate.reader import TURNS, ReaderState
from scenewright.translate.tokens import Quantity


@dataclass(slots=True)
class AdjunctReader(ReaderState):
    """Puts adjuncts into the event that they belong to."""

    def _adjunct(self) -> bool:
        return (
            self._particle()
            or self._shared_place()
            or self._amount_adjunct()
            or self._stop_adjunct()
            or self._place_adjunct()
            or self._through()
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

    def _shared_place(self) -> bool:
        """Read a bare amount whose place another vehicle names: "the ego is 35 m and the hero 20 m from it"."""
        amount = self.phrases.tokens[self.at].quantity
        if amount is None or amount.dimension not in ("length", "time"):
            return False
        after = self.phrases.tokens[self.at + 1].tags
        ends = "end" in after or "comma" in after or after.get("link") == "and"
        shared = (self._place_before() or self._place_after(self.at + 1)) if ends else None
        if shared is None or not isinstance(shared.target, str) or shared.of_whom is not None:
            return False
        if (
            shared.target == "stop_line" and not self._respectively_follows()
        ):  # each vehicle has its own, or none: nothing that two can share
            return False
        if shared.amount is None or shared.amount.dimension != amount.dimension:
            return False
        host = self._host()
        if host is None or host.verb not in ("be", "sit"):
            return False
        host.places.append(replace(shared, amount=amount, span=amount.span))
        self.at += 1
        self._grow()
        return True

    def _respectively_follows(self) -> bool:
        at = self.at
        while "end" not in self.phrases.tokens[at].tags:
            if self.phrases.tokens[at].text.lower() == "respectively":
                return True
            at += 1
        return False

    def _place_before(self) -> Place | None:
        """Return the place that the vehicle before is compared with: "the ego is 35 m from it and the hero 20 m"."""
        last = self.events[-1] if self.events else None
        if last is None or last.sentence != self.sentence or self.subject_span is None or last.actor == self.subject:
            return None
        return last.places[0] if last.verb in ("be", "sit") and len(last.places) == 1 else None

    def _place_after(self, at: int) -> Place | None:
        """Return the place that follows for the other vehicle: "... 35 m and the hero 20 m from it"."""
        at += self.phrases.tag(at, "comma") is not None
        at += self.phrases.tag(at, "link") == "and"
        phrase = self.phrases.noun_phrase(at)
        if phrase is None or phrase.kind == "pronoun":
            return None
        at = phrase.end + (self.phrases.tag(phrase.end, "be") is not None)
        found = self.phrases.place(at) if self.phrases.tokens[at].quantity is not None else None
        return found[0] if found else None

    def _stop_adjunct(self) -> bool:
        end = self._stop_noun_at(self.at)
        if end is None or self.current is None or self.current.verb not in ("brake", "stop"):
            return False
        self.current.to_stop = True
        self.at = end
        self._grow()
        return True

    def _place_adjunct(self) -> bool:
        passing = self.current is not None and self.current.verb in ("pass", "complete")
        if passing and self._tag("link") == "before" and self.phrases.tokens[self.at].quantity is None:
            return False
        found = self.phrases.place(self.at)
        if found is None:
            return False
        place, end = found
        host = self._host()
        if host is None:
            return False
        if (
            second := self._respective(end)
        ) is not None:  # "... from the conflict point and the stop line respectively"
            place, end = replace(place, target=second[0]), second[1]
        host.places.append(place)
        if place.target == "stop_line" and self.phrases.tag(end - 1, "area") == "driveway":
            host.areas.append(Area("on", "driveway", place.span))  # "at the stop line of the driveway"
        self.at = end
        self._grow()
        return True

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
            and self.current.verb in ("leave", "pull_out")
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

    def _role_of(self, event: Event) -> str:
        """Whether a vehicle comes out of what stands after its verb, or goes into it: "joins the road"."""
        words = event.span.excerpt(self.phrases.text).lower().split()
        return "into" if any(word.startswith(("join", "merg")) for word in words) else "from"

    def _host_of_heading(self, end: int) -> Event | None:
        if self.links and self.current is not None and self.current.verb in TURNS and "comma" in self.links:
            gerund = "ing" in self.phrases.tokens[self.at].forms
            if gerund and self.links == ["comma"]:  # "turns left, heading east"
                self.links = []
                return self.current
        return self._host()

    def _through(self) -> bool:
        """Read "accelerates through the conflict point" as two verbs."""
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

    def _from_whose_side(self, at: int) -> tuple[str, int] | None:
        """Read "from the AV's left [side]"; return the side and the position after it."""
        if self.phrases.tag(at, "preposition") not in ("out", "on", "to"):
            return None
        phrase = self.phrases.noun_phrase(at + 1)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is None:
            return None
        direction = self.phrases.tag(phrase.end + 1, "direction")
        if direction not in ("left", "right"):
            return None
        end = phrase.end + 2 + (self.phrases.tag(phrase.end + 2, "side_noun") is not None)
        return f"from_{direction}" if self.phrases.tag(at, "preposition") == "out" else f"on_{direction}", end

    def _side(self) -> bool:
        """Read "from the ego's left" and "on its right": where a vehicle comes from, as the other one sees it."""
        side, end = self._tag("from_side"), self.at + 1
        if side is None and (found := self._from_whose_side(self.at)):
            side, end = found
        host = self.current or (self._host() if side is not None and self.subject_span is not None else None)
        if side is None or host is None or host.actor is None or (self.links and self.subject_span is None):
            return False
        if self.links and host is self.current:
            host = self._host()
        if host is None or host.actor is None:
            return False
        if self.phrases.tag(end, "preposition") == "of":
            phrase = self.phrases.noun_phrase(end + 1)
            if phrase is None or (phrase.kind != "pronoun" and self.phrases.resolve(phrase) == host.actor):
                return False
            end = phrase.end
        side_of = host.actor
        if side.startswith("on_") and host.areas and host.areas[-1].kind == "driveway":
            named = self.phrases.last_named
            if named is not None and self.phrases.tokens[self.at].text.lower().startswith(("on", "to", "at")):
                whose = self._from_whose_side(self.at)
                side_of = named[0] if whose is not None else host.actor
            if host.areas[-1].role == "into":
                relation = f"driveway_{side.rpartition('_')[2]}"
                host.relations.append((relation, side_of, self.phrases.span(self.at, end)))
                self.at = end
                self._grow()
                return True
        on_driveway = any(area.kind == "driveway" for area in host.areas)
        seen_by_itself = side.startswith("on_") and on_driveway and host.actor == EGO_ID
        if seen_by_itself or (side.startswith("on_") and not on_driveway and host.verb != "pull_out"):
            return False
        host.relations.append((f"from_{side.rpartition('_')[2]}", host.actor, self.phrases.span(self.at, end)))
        self.at = end
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
        if host is not None and host.verb == "be" and direction == "straight" and self.links == ["comma"]:
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
