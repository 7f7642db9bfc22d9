"""Reads deeds without a finite verb of their own: "the braking of the van begins", "brake the van at 3 m/s^2".

What enters: the reader's state at such words. What leaves: an event of whoever does it, as a verb would give.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.courtesies import RELEASED, SLOWS, CourtesyReader
from scenewright.translate.events import HERO_ID, Event

_COMMANDED = ("brake", "stop", "accelerate", "come")


@dataclass(slots=True)
class DeedReader(CourtesyReader):
    """Reads nominalised and commanded actions, and what is done for somebody's sake."""

    # -- nouns for actions ------------------------------------------------------------------------------------------
    def _deed(self) -> bool:
        """Read "the braking of the van" and "its deceleration" as the subject of "begins", "is 3 m/s^2", "ends"."""
        if self.subject_span is not None or (self.current is not None and not self.links) or self.flags:
            return False
        accompanies = self.phrases.tokens[self.at].text.lower() == "with" and self.links == ["comma"]
        found = self._deed_at(self.at + accompanies)
        if found is None:
            return False
        verb, actor, end = found
        start = self.at
        self._set_subject(actor, self.phrases.span(start, end))
        event = self._open(verb, start)
        event.notes.append("deed")
        self.at = end
        self._grow()
        return True

    def _deed_at(self, at: int) -> tuple[str, int, int] | None:
        """Return the verb that a noun stands for, who does it, and the position after both."""
        if self.phrases.tag(at, "possessive") and self.phrases.subject is None:
            return None
        owner = self.phrases.possessor(at)
        actor, at = owner if owner else (None, self.phrases.skip_determiner(at))
        while self.phrases.tag(at, "actor_adjective") == "plain" or self.phrases.tag(at, "adverb") in (
            "hard",
            "gently",
        ):
            at += 1
        verb = self._noun_of_action(at)
        if verb is None:
            return None
        end = at + 1
        if (
            actor is None
            and self.phrases.tag(end, "preposition") in ("of", "by")
            and (phrase := self.phrases.noun_phrase(end + 1))
        ):
            actor, end = self.phrases.resolve(phrase), phrase.end
        if actor is None:
            actor = self._who_did(verb)
        return (verb, actor, end) if actor is not None and self._is_predicated(end) else None

    def _noun_of_action(self, at: int) -> str | None:
        token = self.phrases.tokens[at]
        noun, words = token.tags.get("event_noun"), token.text.lower()
        if noun in ("brake", "accelerate"):
            return noun
        if token.tags.get("measure") == "rate" and ("decel" in words or "brak" in words):
            return "brake"
        if token.tags.get("measure") == "rate" and "accel" in words:
            return "accelerate"
        verb = token.tags.get("verb")
        return verb if verb in ("brake", "stop", "accelerate") and token.forms == {"ing"} else None

    def _who_did(self, verb: str) -> int | None:
        """Return who was said to do this before: "The van brakes ... The braking ends at a standstill"."""
        done = [e for e in self.events if e.actor is not None and (e.verb == verb or {e.verb, verb} <= set(SLOWS))]
        if not done and any(event.actor == HERO_ID for event in self.events):
            return HERO_ID  # the ego's deeds are for its own driving policy to decide
        return done[-1].actor if done else None

    def _is_predicated(self, at: int) -> bool:
        """Whether "(, at 3 m/s^2 and to a standstill,) begins / is / ends" follows."""
        while True:
            token = self.phrases.tokens[at]
            tags = token.tags
            if tags.keys() & {"be", "deed_ends", "deed_begins"} or tags.get("verb") == "begin":
                return True
            begins = tags.get("link") == "when" and token.text.lower().startswith(("begin", "start"))
            noted = "colon" in tags and self.phrases.tokens[at + 1].quantity is not None
            if tags.get("auxiliary") == "will" or begins or noted:
                return True
            rate = token.quantity is not None and token.quantity.dimension in ("acceleration", "speed")
            joins = tags.keys() & {"comma", "stop_noun", "determiner", "measure"} or tags.get("link") in ("and", "to")
            if not (rate or joins or tags.get("preposition") in ("at", "with", "to", "of")):
                return False
            at += 1

    def _deed_predicate(self) -> bool:
        """Read what is said of a deed: "begins", "is to be commanded", "is 3 m/s^2", "ends at a standstill"."""
        event = self.current
        relative = (
            self._tag("link") == "that" and event is not None and event.verb == "brake" and self._ends_deed(self.at + 1)
        )
        if event is None or ("deed" not in event.notes and not relative) or self.subject_span is not None:
            return False
        if set(self.links) - {"comma", "and"} or self.flags:
            return False
        at = self.at + relative
        noted = self.phrases.tokens[at + 1].quantity if self._tag("colon") else None
        if noted is not None and noted.dimension == "acceleration":
            self.links, self.at = [], at + 1  # "Deceleration: 3 m/s^2"
            return True
        while self.phrases.tokens[at].tags.keys() & {"be", "auxiliary"} and not self._ends_deed(at):
            at += 1
        while self.phrases.tag(at, "adverb"):
            at += 1
        at_rate = at > self.at and self.phrases.tag(at, "preposition") in ("at", "of")
        rate = self.phrases.tokens[at + at_rate].quantity if at > self.at else None
        if rate is not None and rate.dimension == "acceleration":
            end = at
        elif self.phrases.verb(at, "begin") or self.phrases.tag(at, "deed_begins"):
            end, event.begins = at + 1, True
        elif self._ends_deed(at):
            stop = self._stop_after(at + 1)
            until = self.phrases.tag(at + 1, "link") == "until"
            if stop is None and not until:
                return False
            event.to_stop |= stop is not None
            end = stop if stop is not None else at + 1
        elif at > self.at and (stop := self._stop_after(at)) is not None:
            event.to_stop, end = True, stop  # "its deceleration is to a standstill"
        else:
            return False
        self.links = []
        self.at = end
        self._grow()
        return True

    def _ends_deed(self, at: int) -> bool:
        return self.phrases.tag(at, "deed_ends") is not None

    def _stop_after(self, at: int) -> int | None:
        """Return the position after "at a standstill", "in a full stop", "to rest"; None where none is there."""
        linked = self.phrases.tag(at, "preposition") in ("at", "in", "with", "to", "into")
        if not linked and self.phrases.tag(at, "link") not in ("to", "until", "and"):
            return None
        at = self.phrases.skip_determiner(at + 1)
        return at + 1 if self.phrases.tag(at, "stop_noun") else None

    def _noted_deed(self) -> bool:
        """Read "Van: emergency stop, 7 m/s^2" and "Van response: deceleration of 3 m/s^2 down to 5 m/s"."""
        noted = self.phrases.tokens[max(0, self.at - 1)].tags.keys() & {"colon"} or "then_label" in self.links
        if not noted or self.subject is None or self.flags or (self.current is not None and not self.links):
            return False
        at = self.phrases.skip_determiner(self.at)
        stops = self.phrases.tag(at, "stop_noun") is not None
        verb = "stop" if stops else self._noun_of_action(at)
        if verb is None or self._is_predicated(at + 1):
            return False
        rated = self.phrases.tag(at, "measure") == "rate" and self.phrases.measured(at) is not None
        event = self._open(verb, self.at)
        event.to_stop = stops
        self.at = at + (not rated)
        self._grow()
        return True

    def _expected_deed(self) -> bool:
        """Step over "yielding is expected from the van": what it does is said beside it."""
        if self.subject_span is not None or (self.current is not None and not self.links) or self.flags:
            return False
        token = self.phrases.tokens[self.at]
        expected = self.phrases.tokens[self.at + 1].text.lower() == "is expected"
        at = self.at + 2
        if not expected and self.phrases.tag(self.at + 1, "be"):
            expected, at = self.phrases.tag(self.at + 2, "demanded") is not None, self.at + 3
        if not expected or "ing" not in token.forms or self.phrases.verb(self.at, *SLOWS) is None:
            return False
        phrase = (
            self.phrases.noun_phrase(at + 1) if self.phrases.tag(at, "preposition") in ("of", "out", "by") else None
        )
        if phrase is None:
            return False
        start = self.at
        self._set_subject(self.phrases.resolve(phrase), self.phrases.span(start, phrase.end))
        self._open("attitude", start)
        self.at = phrase.end
        return True

    def _no_deed(self) -> bool:
        """Read "no yielding by the van" and "there is no yielding" as what it does not do."""
        if self.subject_span is not None or (self.current is not None and not self.links) or self.flags:
            return False
        at = self.at
        if self._tag("link") == "there" and self.phrases.tag(at + 1, "be"):
            at += 2
        at += self.phrases.tokens[at].text.lower() == "with"
        verb = self.phrases.verb(at + 1, "yield", "brake", "stop")
        if (
            self.phrases.tokens[at].text.lower() != "no"
            or verb is None
            or "ing" not in self.phrases.tokens[at + 1].forms
        ):
            return False
        start, end, actor = self.at, at + 2, HERO_ID
        if self.phrases.tag(end, "preposition") in ("of", "by", "out") or self.phrases.tag(end, "link") == "by":
            phrase = self.phrases.noun_phrase(end + 1)
            if phrase is None:
                return False
            actor, end = self.phrases.resolve(phrase), phrase.end
        elif not any(event.actor == HERO_ID for event in self.events):
            return False
        self._set_subject(actor, self.phrases.span(start, end))
        self.flags.add("negated")
        self._open(verb, start)
        self.at = end
        self._grow()
        return True

    def _place_before_clause(self) -> bool:
        """Read "at the conflict point" in front of "it is doing 40 mph"."""
        if self.subject_span is not None or (self.current is not None and not self.links) or self.flags:
            return False
        found = self.phrases.place(self.at) if self._tag("preposition") == "at" else None
        if found is None or found[0].relation != "at" or not any(event.actor == HERO_ID for event in self.events):
            return False
        after = found[1] + (self.phrases.tag(found[1], "comma") is not None)
        phrase = self.phrases.noun_phrase(after)
        if phrase is None or self.place_first is not None:
            return False
        state = self.phrases.tag(phrase.end, "be") or self.phrases.verb(phrase.end, "drive", "wait")
        if not state and self.phrases.tokens[phrase.end].text.lower() not in ("does", "has"):
            return False  # whether it brakes there or stops there is unsure
        self.place_first = found[0]
        self.at = after
        return True

    def _state_of_turn(self) -> bool:
        """Read "the ego's turn is complete", "its turn is finished" and "the turn of the ego begins"."""
        if self.subject_span is not None or (self.current is not None and not self.links) or self.flags:
            return False
        start, at = self.at, self.at
        if self.phrases.tag(at, "possessive"):
            owner = (self.phrases.subject, at + 1) if self.phrases.subject is not None else None
        else:
            owner = self.phrases.possessor(at)
        at = owner[1] if owner else self.phrases.skip_determiner(at)
        at += self.phrases.tag(at, "direction") is not None
        if self.phrases.tag(at, "event_noun") != "turn":
            return False
        actor, end = owner[0] if owner else None, at + 1
        if (
            actor is None
            and self.phrases.tag(end, "preposition") == "of"
            and (phrase := self.phrases.noun_phrase(end + 1))
        ):
            actor, end = self.phrases.resolve(phrase), phrase.end
        turned = [e.actor for e in self.events if e.verb in ("turn", "pull_out", "complete") and e.actor is not None]
        if actor is None and turned and turned[-1] == HERO_ID and self._tag("determiner"):
            actor = HERO_ID  # "A van turns left. The turn begins when ..."
        after = end
        while self.phrases.tokens[after].tags.keys() & {"be", "auxiliary", "adverb"}:
            after += 1
        begins = after == end and self.phrases.verb(after, "begin") and self.phrases.tokens[after].forms & {"s", "ed"}
        done = self.phrases.verb(after, "complete") or self.phrases.tokens[after].text.lower() == "done"
        if actor is None or not (begins or (done and after > end)):
            return False
        self._set_subject(actor, self.phrases.span(start, end))
        event = self._open("turn" if begins else "complete", start)
        event.begins = bool(begins)
        self.at = after + 1
        self._grow()
        return True

    def _after_a_while(self) -> bool:
        """Read "after 3 s", "3 s later" and "after a stop of 3 s" as how long a stop lasts."""
        if self.subject_span is not None or (self.current is not None and not self.links) or self.flags:
            return False
        at = self.at
        after = self._tag("link") == "after" or self._tag("relation") == "past"
        at = self.phrases.skip_determiner(at + 1) if after else at
        if self.phrases.tag(at, "stop_noun") or self.phrases.tokens[at].text.lower() in ("wait", "pause"):
            at += 1 + (self.phrases.tag(at + 1, "preposition") == "of")
        at = self.phrases.skip_hedges(at)
        if at + 1 >= len(self.phrases.tokens):
            return False
        quantity, later = self.phrases.tokens[at].quantity, self.phrases.tokens[at + 1].text.lower()
        if quantity is None or quantity.dimension != "time" or not (after or later in ("later", "afterwards")):
            return False
        end = at + 1 + (later in ("later", "afterwards"))
        end += self.phrases.tag(end, "stop_noun") is not None
        end += self.phrases.tag(end, "comma") is not None
        stopped = [e for e in self.events if e.actor == HERO_ID and e.verb in (*SLOWS, "wait")]
        if not stopped or self.phrases.place(at) is not None:
            return False
        subject, links = self.subject, [link for link in self.links if link not in ("and", "then")]
        event = Event("wait", HERO_ID, self.phrases.span(self.at, end), self.sentence, [*links, "after"])
        event.duration = quantity
        self.events.append(event)
        self.current, self.links, self.subject = event, ["comma"], subject
        self.at = end
        return True

    # -- commands ---------------------------------------------------------------------------------------------------
    def _command(self) -> bool:
        """Read "Brake the van at 3 m/s^2" and "bring the truck to a standstill" as what that vehicle does."""
        token = self.phrases.tokens[self.at]
        fresh = self.current is None or self.links == ["comma"]
        verb = self.phrases.verb(self.at, *_COMMANDED)
        if verb is None or "base" not in token.forms or not fresh or self.subject_span is not None or self.flags:
            return False
        phrase = self.phrases.noun_phrase(self.at + 1)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        stop = self._stop_noun_at(phrase.end)
        if verb == "come" and (stop is None or token.text.lower() != "bring"):
            return False
        start, links = self.at, self.links
        self._take_subject(phrase)
        self.links = links
        event = self._open("stop" if verb == "come" else verb, start)
        event.to_stop = verb in ("come", "stop")
        self.at = stop if verb == "come" and stop is not None else phrase.end
        self._grow()
        return True

    # -- "does so", "reacts with" -----------------------------------------------------------------------------------
    def _does_so(self, start: int) -> bool:
        """Read "does so until it stands": the deed told last, gone on with."""
        if "negation" in self.phrases.tokens[start + 1].tags:
            self.at += 1  # "and does so without yielding"
            return True
        told = [e for e in self.events if e.actor == self.subject and "that" not in e.links and e.verb in SLOWS]
        if not told or told[-1] is not self._last_deed():
            return False
        event = self._open("brake", start)
        event.notes.append("again")
        self.at = start + 1
        self._grow()
        return True

    def _last_deed(self) -> Event | None:
        deeds = [e for e in self.events if e.actor == self.subject and e.verb in (*SLOWS, *RELEASED, "wait")]
        return deeds[-1] if deeds else None

    def _reacts_with(self, start: int) -> bool:
        """Read "reacts with a deceleration of 3 m/s^2" and "responds with hard braking"."""
        if self._tag("preposition", 1) not in ("with", "by"):
            return False
        measured = self.phrases.measured(start + 2)
        rated = measured is not None and measured[0] == "rate" and "accel" not in self._rate_words(start + 2).split()[0]
        if rated:
            self._open("brake", start)
            self.at = start + 1
            return True
        if (after := self._brake_noun(start, start + 2)) is None:
            return False
        self.at = after
        self._grow()
        return True

    def _rate_words(self, at: int) -> str:
        at = self.phrases.skip_hedges(self.phrases.skip_determiner(at))
        return self.phrases.tokens[at].text.lower()
