"""Reads verbs that carry another word: begins to, wants to, fails to, makes a left turn, lets the ego pass.

What enters: the reader's state at such a verb. What leaves: True where it was read with what it carries, or it only
colours the next verb.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.adjuncts import AdjunctReader
from scenewright.translate.tokens import Token


@dataclass(slots=True)
class VerbGroupReader(AdjunctReader):
    """Reads light verbs."""

    def _light(self, verb: str, token: Token) -> bool:
        """Read verbs that only colour the next one: begins to, wants to, fails to."""
        if self.passive_object == "its turn" and "ed" in token.forms and verb in ("begin", "complete", "make"):
            self.passive_object = None
            event = self._open("complete" if verb == "complete" else "turn", self.at)
            event.begins, event.actor = verb == "begin", None
            self.at += 1
            self._grow()
            return True
        following = self.phrases.tokens[self.at + 1]
        to_verb = self._tag("link", 1) == "to" and self.phrases.tag(self.at + 2, "verb") is not None
        if verb == "need" and token.text.lower().endswith(" to") and "base" in following.forms:
            self.flags.add("modal")  # "has to turn left"
            self.at += 1
            return True
        if (after := self._goes_on_to(verb, token)) is not None:
            self.flags.add("modal")  # "proceeds to brake", "will continue following its lane"
            self.at = after
            return True
        if to_verb and "be" in self.flags and token.text.lower() == "going":
            self.flags.add("wanted")  # "is also going to turn left"
            self.at += 2
            return True
        reacts = verb == "react" and self._tag("link", 1) == "by" and "ing" in self.phrases.tokens[self.at + 2].forms
        if reacts or (verb == "react" and "ing" in following.forms):
            self.flags.add("modal")  # "reacts by braking", "ends up standing"
            self.at += 1 + reacts
            return True
        flag = {"begin": "begins", "want": "wanted", "need": "modal", "fail": "negated", "wait": "wanted"}.get(verb)
        if flag and to_verb:
            if flag == "negated":
                self._negate(token.span)
            self.flags.add(flag)
            self.at += 2
            return True
        going = verb == "want" and token.text.lower().endswith("going")
        if going and following.quantity is not None and following.quantity.dimension == "speed":
            self._open("drive", self.at)  # "is going 8 m/s"
            self.at += 1
            return True
        way = self._tag("direction", 1)
        if going and (way or self.phrases.heading(self.at + 1) or self.phrases.area(self.at + 1)):
            self._open("go" if way in ("left", "right") else "drive", self.at)  # "was going west", "is going straight"
            self.at += 1
            return True
        if verb == "begin" and "ing" in following.forms:
            self.flags.add("begins")
            self.at += 1
            return True
        if verb in ("begin", "want", "make", "complete", "use") and self._turn_noun(verb):
            return True
        turned = any(event.verb == "turn" and event.actor == self.subject for event in self.events)
        if verb == "complete" and turned and self.phrases.tokens[self.at + 1].text.lower() == "it":
            self._open("complete", self.at)  # "starts its turn and has completed it before ..."
            self.at += 2
            self._grow()
            return True
        if verb == "complete" and self.phrases.verb(self.at + 1, "turn") and "ing" in following.forms:
            self._open("complete", self.at)  # "finishes turning"
            self.at += 2
            self._grow()
            return True
        if verb in ("begin", "make") and (after := self._brake_noun(self.at, self.at + 1)):
            self.at = after
            self._grow()
            return True
        if verb == "want" and not going and self.phrases.tag(self.at + 1, "link") != "to" and self._wanted_area():
            return True
        described = (
            self.current is not None and set(self.links) <= {"comma", "and"} and self._state_follows(self.at + 1)
        )
        if verb == "begin" and "determiner" in following.tags and self.phrases.tag(self.at + 2, "frame_noun"):
            place = self.phrases.place(self.at + 3)  # "begins the test 45 m before the stop line"
            if place is not None and self.current is None:
                self.flags.add("initial")
                self._open("be", self.at)
                self.at += 3
                return True
        placed = verb == "begin" and bool(set(self.links) & {"comma", "and"}) and not set(self.links) & {"when", "then"}
        placed = placed and following.quantity is not None and self.phrases.place(self.at + 1) is not None
        if (
            verb == "begin"
            and (self.current is None or placed or described)
            and not self.flags - {"initial", "be", "modal"}
        ):
            self.flags.add("initial")
            event = self._open("be", self.at)
            event.gerund = "ing" in token.forms
            self.at += 1
            return True
        return False

    def _goes_on_as_wanted(self, verb: str, token: Token) -> bool:
        """Whether "travel" goes on with what is wanted: "a car that is to turn left onto the road and travel east"."""
        turn = self.current is not None and self.current.verb in ("turn", "pull_out")
        turn = turn and self.current is not None and (self.current.wanted or "modal" in self.current.notes)
        plain = verb == "drive" and self.links == ["and"] and self.subject_span is None and not self.flags
        return turn and plain and "base" in token.forms and "s" not in token.forms

    def _goes_on_to(self, verb: str, token: Token) -> int | None:
        """Return the position of the verb that "proceeds to" and "continues" only lead over to; None where none is."""
        if verb != "go" or not token.text.lower().startswith(("proceed", "go on", "goes on", "continu")):
            return None
        at = self.at + 1
        if "ing" in self.phrases.tokens[at].forms:
            return at if self.phrases.verb(at, "lane_follow") else None
        led = self.phrases.verb(at + 1, "brake", "stop", "accelerate", "turn", "lane_follow")
        return at + 1 if self.phrases.tag(at, "link") == "to" and led else None

    def _state_follows(self, at: int) -> bool:
        """Whether a first place or speed follows: "a van, left turn, starts 80 m before the intersection"."""
        told = ("be", "sit", "drive", "lane_follow", "turn", "pull_out", "leave", "approach", "go")
        if self.current is None or self.current.verb not in told or "when" in self.current.links:
            return False
        at += self.phrases.tag(at, "preposition") in ("at", "with")
        at = self.phrases.skip_hedges(at)
        return self.phrases.tokens[at].quantity is not None or self.phrases.measured(at) is not None

    def _wanted_area(self) -> bool:
        """Read "wants out of the driveway" and "wants the driveway"."""
        found = self.phrases.area(self.at + 1) or self.phrases.area_noun(self.at + 1, "into")
        if found is None or found[0].role not in ("from", "into"):
            return False
        event = self._open("pull_out" if found[0].role == "from" else "turn", self.at)
        event.wanted = True
        event.areas.append(found[0])
        self.at = found[1]
        self._grow()
        return True

    def _turn_noun(self, verb: str) -> bool:
        """Read "makes a left turn", "begins its turn", "completes the left turn"."""
        start, at = self.at, self.at + 1
        at += verb == "want" and self.phrases.tag(at, "preposition") in ("on", "for")
        owner = self.phrases.possessor(at)
        if owner is not None:
            if owner[0] != self.subject:
                return False
            at = owner[1]
        else:
            at = self.phrases.skip_determiner(at)
        while self.phrases.tag(at, "actor_adjective") == "plain":
            at += 1  # "an unprotected left turn"
        direction = self.phrases.tag(at, "direction")
        at += direction is not None
        noun = self.phrases.tag(at, "event_noun")
        if noun is None and self.phrases.verb(at, "pull_out") and self.phrases.tokens[at].text.lower() == "turn out of":
            area = self.phrases.area_noun(at + 1, "from")  # "makes a left turn out of the driveway"
            if area is None:
                return False
            event = self._open("turn", start)
            event.direction, event.wanted = direction, event.wanted or verb == "want"
            event.areas.append(area[0])
            self.at = area[1]
            self._grow()
            return True
        ends = bool(self.phrases.tokens[at].tags.keys() & {"end", "comma"})
        if noun is None and verb == "want" and direction in ("left", "right") and ends:  # "wants left"
            event = self._open("turn", start)
            event.wanted, event.direction = True, direction
            self.at = at
            self._grow()
            return True
        if noun != "turn" and not (verb == "make" and direction in ("left", "right")):
            return False
        if noun is not None:
            at += 1
        if verb == "begin":
            self.flags.add("begins")
        if verb == "want":
            self.flags.add("wanted")
        event = self._open("complete" if verb == "complete" else "turn", start)
        event.direction = direction
        self.at = at
        self._grow()
        return True

    def _brake_noun(self, start: int, at: int) -> int | None:
        """Read "performs an emergency braking" and "makes an emergency stop"; return the position after it."""
        at = self.phrases.skip_determiner(at) + (self.phrases.tag(at, "possessive") is not None)
        while self.phrases.tag(at, "actor_adjective") == "plain" or self.phrases.tag(at, "adverb") in (
            "hard",
            "gently",
        ):
            at += 1
        rate = self.phrases.tokens[at].quantity
        at += rate is not None and rate.dimension == "acceleration"
        noun = self.phrases.tag(at, "event_noun")
        stops = self.phrases.tag(at, "stop_noun") is not None
        if noun != "brake" and not stops:
            return None
        event = self._open("stop" if stops else "brake", start)
        event.to_stop = stops
        if rate is not None and rate.dimension == "acceleration":
            event.rate = rate  # "performs a 4 m/s^2 braking"
        return at + 1
