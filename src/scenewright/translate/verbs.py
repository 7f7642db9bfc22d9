"""Reads verbs that open an event.

What enters: the reader's state at some token. What leaves: True where a verb was read.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.commentary import tells_way
from scenewright.translate.deeds import DeedReader
from scenewright.translate.events import HERO_ID, Area, Event, Place
from scenewright.translate.reader import MOVES
from scenewright.translate.references import NounPhrase
from scenewright.translate.tokens import Token

_GAPS = frozenset(("gap", "distance", "headway", "spacing"))


@dataclass(slots=True)
class VerbReader(DeedReader):
    """Opens events."""

    def _verb(self) -> bool:
        """Read one verb, or one word of a verb group."""
        token = self.phrases.tokens[self.at]
        flags = len(self.flags)
        read = self._verb_word(token)
        if len(self.flags) > flags and self.opening is None:
            self.opening = token.span
        return read

    def _verb_word(self, token: Token) -> bool:
        if self._instead():
            return True
        if "negation" in token.tags:
            self._negate(token.span)
            self.at += 1
            return True
        if self._has_amount():
            return True
        if "wanting" in token.tags:  # "with the intention of turning left"
            self.flags.add("wanted")
            self.links += ["and"] if self.current is not None and not self.links else []
            self.at += 1 + (self._tag("link", 1) == "to")
            return True
        if "expected" in token.tags and tells_way(self.phrases.tokens[self.at : self.at + 6]):
            self.flags.add("wanted")  # "is expected to turn left"
            self.at += 1
            return True
        ready = "ready" in token.tags and self._tag("link", 1) == "to" and self.phrases.verb(self.at + 2) is not None
        if ready and (self.current is not None or self.subject_span is not None):
            self.flags.add("wanted")
            self.links += ["and"] if self.current is not None and not self.links else []
            self.at += 2
            return True
        if token.tags.get("auxiliary") == "do" and "comma" in [*self.links, "comma"] and self._inverted():
            self.links += [] if "comma" in self.links else ["comma"]
            self.at += 1  # "Only after that does the hero drive on"
            return True
        if token.tags.get("verb") == "make" and (after := self._brake_noun(self.at, self.at + 1)):
            self.at = after  # "does an emergency braking"
            self._grow()
            return True
        if "auxiliary" in token.tags:
            self.flags.add({"have": "perfect"}.get(token.tags["auxiliary"], "modal"))
            self.at += 1
            return True
        if ("be" in token.tags or self._contracted_be(token)) and "verb" not in token.tags:
            self.flags.add("be")
            self.at += 1 + (self.pair and self._tag("pair", 1) is not None)  # "are both"
            self.at += self.phrases.tokens[self.at].text.lower() == "itself"
            if self._tag("ready") and self._tag("link", 1) == "to" and self.phrases.verb(self.at + 2):
                self.flags.add("wanted")  # "is ready to turn left"
                self.at += 2
                return True
            there = self._tag("link") == "there" and self.phrases.last_landmark is not None
            ordered = self._tag("link", 1) in ("before", "after") or self._tag("adverb", 1) == "first"
            ordered = ordered or (self.links[-1:] == ["before"] and self._tag("end", 1) is not None)
            if there and ordered:
                self._open("reach", self.at - 1).landmark = self.phrases.last_landmark  # "is there before the ego"
                self.at += 1
                self._grow()
                return True
            if not (self.phrases.tokens[self.at].tags.keys() & {"verb", "negation", "adverb", "auxiliary"}):
                self._open("be", self.at - 1)
            return True
        verb = token.tags.get("verb")
        if "falls" in token.tags and self.subject_span is not None and self.phrases.tokens[self.at + 1].quantity:
            if set(token.text.lower().split()) & _GAPS:
                event = self._open("be", self.at)  # "the ego has closed the gap to 9 m"
                amount = self.phrases.tokens[self.at + 1].quantity
                if amount is None or event.actor is None or amount.dimension not in ("length", "time"):
                    return False
                event.places.append(Place("behind", 1 - event.actor, amount, token.span))
                self.at += 2
                return True
            self._open("reach", self.at)  # "the ego has closed to 25 m behind the van"
            self.at += 1
            return True
        if verb is None:
            return False
        return self._light(verb, token) or self._main_verb(verb, token)

    def _needs_time(self) -> bool:
        """Read "needs another 3 s to reach the stop line" as a time to arrival."""
        if self._tag("verb") != "need":
            return False
        at = self.at + 1 + (self._tag("determiner", 1) == "another")
        quantity = self.phrases.tokens[at].quantity
        if quantity is None or quantity.dimension != "time" or self.phrases.place(at) is None:
            return False
        self._open("be", self.at)
        self.at = at
        return True

    def _inverted(self) -> bool:
        phrase = self.phrases.noun_phrase(self.at + 1)
        return phrase is not None and "base" in self.phrases.tokens[phrase.end].forms and self.subject_span is None

    def _contracted_be(self, token: Token) -> bool:
        if "genitive" not in token.tags or self.at == 0:
            return False
        return self.phrases.tag(self.at - 1, "pronoun") is not None or self.phrases.short_be(self.at)

    def _has_amount(self) -> bool:
        """Whether "has" is a full verb here: "has 12 m to go to the stop line", "has a speed of 8 m/s"."""
        if self._tag("auxiliary") != "have":
            return self._needs_time()
        after = self.phrases.tokens[self.at + 1]
        if after.quantity is not None or self.phrases.measured(self.at + 1) is not None:
            if self._starts_with(self.at + 1):
                self.flags.add("initial")  # "has an initial distance of 30 m to the stop line"
            self._open("be", self.at)
            self.at += 1
            return True
        return False

    def _main_verb(self, verb: str, token: Token) -> bool:
        start = self.at
        placed = self.current is not None and self.current.places and self.current.places[-1].amount is None
        if "ing" in token.forms and not self.links and placed and self._turn_to_object():
            self.links.append("that")  # "behind a van doing 12 m/s"
        if verb == "let" or (verb == "leave" and self._let(start)):
            return verb == "leave" or self._let(start)
        if verb == "wait" and self._waits_for(start):
            return True
        if verb == "do_so":
            return self._does_so(start)
        if verb == "react" and self._reacts_with(start):
            return True
        hesitates = verb == "wait" and token.text.lower().startswith("hesitat") and self._tag("colon", 1) is not None
        if verb in ("attitude", "react") or hesitates:  # "is to hesitate: when ..., it brakes": how is told then
            return self._attitude(start)
        stopping = self.current is not None and self.current.verb in ("stop", "brake", "yield")
        if verb == "leave" and "ing" in token.forms and stopping and self.phrases.tokens[self.at + 1].quantity:
            self.links = []  # "brakes to a stop, leaving 5 m to the conflict point"
            self.at += 1
            return True
        if verb == "reach" and token.text.lower().startswith("arriv") and self._tag("preposition", 1) == "out":
            verb = "drive"  # "arrives from the driveway"
        if verb == "reach" and token.text.lower().startswith("arriv") and self.phrases.heading(self.at + 1):
            verb = "drive"  # "arrives eastbound", "arrives from the east"
        if verb == "pass" and self.phrases.tokens[self.at + 1].text.lower() == "along":
            verb = "drive"  # "passes along the road"
        passive = "be" in self.flags and "ed" in token.forms
        by = self._tag("link", 1) == "by" or self._tag("preposition", 1) == "by"
        if verb == "yield" and passive and by and self._given_way(start):
            return True
        if verb in ("follow", "lead") and "ed" in token.forms and by and self.current is not None and not self.flags:
            self.links = [link for link in self.links if link != "comma"]
            return self._led(verb, start)  # "is westbound, followed by the ego"
        if verb in ("lead", "not_yield", "beat", "get_within", "pretend", "come_towards", "cut_in_front") and not (
            verb == "lead" and passive
        ):
            return self._special(verb, start)
        end = self.at + 1
        if verb in ("make", "begin") and (after := self._brake_noun(start, end)):
            self.at = after
            self._grow()
            return True
        goes = verb == "make" or (verb == "go" and self.current is None)
        if goes and (quantity := self.phrases.tokens[end].quantity) and quantity.dimension == "speed":
            self._open("drive", start)  # "doing 35 mph"
            self.at = end
            return True
        if verb in ("begin", "want", "need", "fail", "make", "use"):
            return False
        if verb == "wait" and self.phrases.tag(end, "preposition") == "for" and self.phrases.noun_phrase(end + 1):
            verb, end = "yield", end + 1  # "waits for the ego"
        follows = verb in ("go", "lane_follow", "drive")
        if follows and token.text.lower().endswith(" on") and (area := self.phrases.area_noun(end, "on")):
            event = self._open("lane_follow" if verb == "lane_follow" else "drive", start)  # "drives on the main road"
            event.areas.append(area[0])
            self.at = area[1]
            self._grow()
            return True
        if verb in ("follow", "lead") and "be" in self.flags and "ed" in token.forms and "ing" not in token.forms:
            return self._led(verb, start)
        if verb == "come":
            stop = self._stop_noun_at(end)
            gets = token.text.lower().startswith(("get", "got")) and self.phrases.tokens[end].quantity is not None
            if stop is None and self._place_to(end):
                verb, end = "reach", end + 1
            elif stop is None and gets and self.phrases.place(end) is not None:
                verb = "reach"  # "gets 7 m behind the hero"
            elif stop is None:
                if self._tag("verb") == "come" and (
                    self.phrases.heading(end)
                    or self.phrases.area(end)
                    or self.phrases.tag(end, "oncoming_way")
                    or self.phrases.tag(end, "from_side")
                    or self.phrases.tokens[end].text.lower() == "along"
                    or self.phrases.tag(end, "direction") == "straight"
                    or self._ends_clause(end)
                    or self._from_whose_side(end)
                ):
                    verb = "drive"
                else:
                    return False
            else:
                verb, end = "stop", stop
        if verb in ("complete", "exist"):
            return False
        if verb == "follow" and (behind := self.phrases.place(end)) is not None and behind[0].relation == "behind":
            verb = "drive"  # "follows behind the ego", "trails 20 m behind it"
        if verb == "follow" and self.subject is not None and (self._ends_clause(end) or self._held_at(end)):
            event = self._open("drive", start)
            event.places.append(Place("behind", 1 - self.subject, None, self.phrases.tokens[start].span))
            self.at = end
            return True
        unlinked = self.current is not None and not self.links and self.subject_span is None
        goes_on = self.reduced is not None or self._after_a_relative_clause(token)
        goes_on = goes_on or (self.current is not None and "that" in self.current.links)
        if unlinked and not goes_on and self.current and self.current.verb != "be" and "ing" not in token.forms:
            return False  # two finite verbs without a link: "makes a left go"
        passive = "be" in self.flags and "ed" in token.forms and "ing" not in token.forms
        if passive and verb in MOVES and self.passive_object is None:
            return False
        if self.passive_object is not None and (verb not in MOVES or self.passive_object == "its turn"):
            return False
        infinitive = self._goes_on_as_wanted(verb, token)
        event = self._open(verb, start)
        event.gerund = "ing" in token.forms
        event.wanted |= infinitive
        if event.landmark is None and verb in MOVES:
            end = self._object_place(event, end)
        if verb == "stop":
            event.to_stop = True
        self.at = end
        self._grow()
        return True

    def _held_at(self, at: int) -> bool:
        """Whether "at a headway of 2 s" stands after "follows": there is only one vehicle to follow."""
        held = self.phrases.tag(at, "preposition") in ("at", "with") or self.phrases.tokens[at].text.lower() == "with"
        measured = self.phrases.measured(at + 1) if held else None
        kept = measured is not None and measured[0] in ("headway", "length")
        return kept and measured is not None and self.phrases.tag(measured[2], "relation") is None

    def _given_way(self, start: int) -> bool:
        """Read "is not given priority by a car": the car does (not) yield to the vehicle of the clause."""
        phrase = self.phrases.noun_phrase(start + 2)
        if phrase is None or phrase.kind == "pronoun" or self.subject is None or self.subject == HERO_ID:
            return False
        whom = self.subject
        self._set_subject(self.phrases.resolve(phrase), phrase.span)
        event = self._open("yield", start)
        event.to_actor, self.at = whom, phrase.end
        return event.actor != whom

    def _after_a_relative_clause(self, token: Token) -> bool:
        """Whether a finite verb goes on with its subject: "a van that is to turn right drives west"."""
        here = [event for event in self.events if event.sentence == self.sentence]
        told = bool(here) and all("that" in event.links or event.links == ["to"] for event in here)
        return told and here[-1].actor == self.subject and "s" in token.forms and not self.flags

    def _attitude(self, start: int) -> bool:
        """Read "sees the AV" and "panics": nothing that can be orchestrated, so it is only noted."""
        event = self._open("attitude", start)
        self.at += 1
        phrase = self.phrases.noun_phrase(self.at)
        if phrase is not None and self.phrases.tag(phrase.end, "genitive") is None:
            self.phrases.resolve(phrase)
            self.at = phrase.end
        elif event.actor is not None and self.phrases.tag(self.phrases.skip_determiner(self.at), "measure") == "length":
            self.at = self.phrases.skip_determiner(self.at) + 1
        place = self.phrases.place(self.at) if self.pair else None
        if place is not None and place[0].relation == "at" and place[0].target in ("intersection", "conflict_point"):
            self.at = place[1]  # "the two meet at the junction"
        self._grow()
        return True

    def _special(self, verb: str, start: int) -> bool:
        """Read verbs that say how two vehicles relate, or that no one gives way."""
        phrase = self.phrases.noun_phrase(self.at + 1)
        if verb == "get_within":  # the moment at which it does is the one at that very distance
            found = self.phrases.place(self.at + 1)
            if found is None or found[0].relation != "from" or found[0].amount is None:
                return False
            event = self._open("reach", start)
            event.notes.append("within")
            event.places.append(found[0])
            self.at = found[1]
            self._grow()
            return True
        if verb == "pretend":
            if self._tag("link", 1) != "to" or self.phrases.verb(self.at + 2, "yield", "stop") is None:
                return False
            self.links.append("as_if")
            self.at += 2
            return True
        if verb == "not_yield":
            self._negate(self.phrases.tokens[start].span)
            event = self._open("yield", start)
            self.at += 1
            if phrase is not None and phrase.kind != "pronoun" and self.phrases.tag(phrase.end, "genitive") is None:
                event.to_actor, self.at = self.phrases.resolve(phrase), phrase.end
            self._grow()
            return True
        if verb == "come_towards" and phrase is None:
            event = self._open("approach", start)
            self.at += 1
            if area := self.phrases.area_noun(self.at, "on"):
                event.notes.append("towards")
                self.at = area[1]  # "drives towards the road"
                self._grow()
            return True
        if phrase is None and verb == "lead" and self.subject is not None and self._ends_clause(self.at + 1):
            event = self._open("drive", start)  # "the hero leads, the ego follows"
            event.places.append(Place("ahead", 1 - self.subject, None, self.phrases.tokens[start].span))
            self.at += 1
            return True
        if verb == "cut_in_front" and phrase is not None and self.subject is not None:
            return self._cuts(start, phrase)
        if phrase is None or self.subject is None or self._may_mean_a_place(verb, start, phrase):
            return False
        other = 1 - self.subject if phrase.kind == "pronoun" else self.phrases.resolve(phrase)
        if other == self.subject:
            raise self.phrases.refuse("a vehicle has no relation to itself", phrase.span)
        if verb == "beat":
            return self._beat(start, other, phrase.end)
        event = self._open("drive", start)
        if verb == "lead":
            event.places.append(Place("ahead", other, None, phrase.span))
        else:
            event.relations.append(("oncoming", HERO_ID, phrase.span))
        self.at = phrase.end
        self._grow()
        return True

    def _may_mean_a_place(self, verb: str, start: int, phrase: NounPhrase) -> bool:
        """Whether "it" can be a place named before; not in "drives ahead of it" and "is in front of it in its lane"."""
        if phrase.kind != "pronoun" or self.phrases.last_landmark is None:
            return False
        lane = self.phrases.area(phrase.end)
        drives = self.phrases.tokens[start].text.lower().split()[0] not in ("is", "are", "was", "be", "being")
        return verb != "lead" or not (drives or (lane is not None and lane[0].kind == "lane"))

    def _place_to(self, at: int) -> bool:
        """Whether "to 33 m from the conflict point" follows, as in "comes to ..."."""
        to = self.phrases.tag(at, "preposition") == "to" or self.phrases.tag(at, "link") == "to"
        return to and self.phrases.tokens[at + 1].quantity is not None and self.phrases.place(at + 1) is not None

    def _ends_clause(self, at: int) -> bool:
        tags = self.phrases.tokens[at].tags
        return bool(tags.keys() & {"end", "comma"}) or tags.get("link") in ("and", "then")

    def _cuts(self, start: int, phrase: NounPhrase) -> bool:
        """Read "pulls out in front of the ego": it comes first where their ways meet."""
        subject = self.subject or 0
        other = 1 - subject if phrase.kind == "pronoun" else self.phrases.resolve(phrase)
        if other == subject:
            raise self.phrases.refuse("a vehicle has no relation to itself", phrase.span)
        words = self.phrases.tokens[start].text.lower().split()
        verb = "pull_out" if "out" in words or words[0].startswith("emerg") else "turn"
        event = self._open("pass" if words[0].startswith(("cross", "pass")) else verb, start)
        if event.verb == "pass":
            event.landmark = "conflict_point"
        event.in_front = True
        self.at = phrase.end
        self._grow()
        return True

    def _led(self, verb: str, start: int) -> bool:
        """Read "is followed by the ego" and "is led by a truck"."""
        phrase = self.phrases.noun_phrase(self.at + 2) if self._tag("link", 1) == "by" else None
        phrase = phrase or (self.phrases.noun_phrase(self.at + 2) if self._tag("preposition", 1) == "by" else None)
        if phrase is None or phrase.kind == "pronoun" or self.subject is None:
            return False
        other = self.phrases.resolve(phrase)
        if other == self.subject:
            raise self.phrases.refuse("a vehicle has no relation to itself", phrase.span)
        event = self._open("drive", start)
        event.places.append(Place("ahead" if verb == "follow" else "behind", other, None, phrase.span))
        self.at = phrase.end
        self._grow()
        return True

    def _beat(self, start: int, other: int, at: int) -> bool:
        """Read "beats the ego to the conflict point"."""
        to = self.phrases.tag(at, "preposition") == "to" or self.phrases.tag(at, "link") == "to"
        found = self.phrases.landmark(at + 1) if to else None
        if found is None and self.current is not None and self.links == ["to"]:
            self.current.than_actor, self.links, self.at = other, [], at  # "speeds up to beat the AV"
            self._grow()
            return True
        event = self._open("pass", start)
        event.landmark, event.than_actor = found[0] if found else "conflict_point", other
        self.at = found[1] if found else at
        self._grow()
        return True

    def _object_place(self, event: Event, at: int) -> int:
        if self.phrases.tokens[at - 1].text.lower().endswith(" there"):  # "gets there"
            event.landmark = self.phrases.last_landmark
            return at
        found = self.phrases.landmark(at)
        if found is not None and event.verb == "leave" and found[3]:
            return at  # "leaves the driveway": an area, read as an adjunct
        if (found is None or found[3]) and event.verb == "enter" and (area := self.phrases.area_noun(at, "into")):
            event.verb = "turn"  # "enters the driveway", "enters the main road"
            event.areas.append(area[0])
            return area[1]
        left = event.verb == "leave" and self.phrases.tokens[at].text.lower() == "it"
        if left and self.phrases.last_area == "driveway":
            event.areas.append(Area("from", "driveway", self.phrases.tokens[at].span))
            return at + 1  # "..., a car leaves it"
        if found is None and event.verb == "pass" and (area := self.phrases.area_noun(at, "across")):
            event.verb = "drive"  # "crosses the ego's path"
            event.areas.append(area[0])
            return area[1]
        if found is None and event.verb in ("reach", "pass") and self.phrases.tag(at, "preposition") in ("at", "in"):
            found = self.phrases.landmark(at + 1)
        if (
            found is None
            and self.phrases.tag(at, "pronoun")
            and self.phrases.last_landmark
            and event.verb != "approach"
        ):
            event.landmark = self.phrases.last_landmark
            return at + 1
        if found is None and event.verb == "approach" and (area := self.phrases.area_noun(at, "on")):
            event.notes.append("towards")
            return area[1]
        if found is None:
            return at
        event.landmark = "turn_start" if found[0] == "mouth" else found[0]
        if found[2] is not None and found[2] != event.actor:
            raise self.phrases.refuse("this is another vehicle's place", self.phrases.span(at, found[1]))
        return found[1]
