"""Reads what one vehicle does for the sake of the other: "lets the ego complete its turn", "waits for it to pass".

What enters: the reader's state at such a verb. What leaves: an event of giving way or waiting, with what it is for.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import HERO_ID, Event
from scenewright.translate.verb_groups import VerbGroupReader

SLOWS = ("brake", "stop", "yield")
RELEASED = ("pass", "go", "turn", "pull_out", "complete", "enter", "reach", "leave", "drive", "accelerate", "keep")


@dataclass(slots=True)
class CourtesyReader(VerbGroupReader):
    """Reads courtesies."""

    def _let(self, start: int) -> bool:
        """Read "lets the ego go first", "allows the ego to complete its turn" as yielding, with what it lets happen."""
        passive = "be" in self.flags and "ed" in self.phrases.tokens[start].forms
        phrase = None if passive else self.phrases.noun_phrase(start + 1)
        through = start + 1 if phrase is None and not passive and self._tag("let_particle", 1) else None
        if through is not None:
            phrase = self.phrases.noun_phrase(through + 1)  # "lets through the ego"
        at = phrase.end if phrase is not None else start + 1
        if phrase is None and not (passive and self.subject is not None):
            return False
        particle = self.phrases.tag(at, "let_particle") is not None
        at += particle
        particle = particle or through is not None
        chance = self.phrases.skip_determiner(at)
        if self.phrases.tag(chance, "chance") and self.phrases.tag(chance + 1, "link") == "to":
            at = chance + 1  # "gives the ego the chance to complete its turn"
        elif self.phrases.verb(start, "let") is None or self.phrases.tokens[start].text.lower().startswith(
            ("giv", "gav")
        ):
            return False
        if self.phrases.tag(at, "link") == "to" or self.phrases.tag(at, "preposition") == "to":
            at += self.phrases.verb(at + 1, *RELEASED, "make") is not None
        verb = self.phrases.verb(at, *RELEASED)
        verb = verb or ("make" if self.phrases.verb(at, "make") and self._whole_turn(at) else None)
        if verb is None and not particle:
            return False
        if phrase is None:
            self._set_subject(1 - (self.subject or 0), self.subject_span)
        event = self._open("yield", start)
        event.notes += [] if "as_if" in event.links else ["let"]  # "as if to let the ego go first" lets nobody go
        if phrase is None:
            event.to_actor = 1 - (event.actor or 0)
        elif phrase.kind == "pronoun" and event.actor is not None:
            event.to_actor = 1 - event.actor
        else:
            event.to_actor = self.phrases.resolve(phrase)
        self.at = at + (verb is not None)
        if particle or verb is not None:
            self._what_it_lets(event, verb, at)
        if self._tag("adverb") == "first":
            self.at += 1
        self._grow()
        return True

    def _what_it_lets(self, event: Event, verb: str | None, at: int) -> None:
        """Read "complete its turn" and "pass the conflict point": the moment of the other one that it is to reach."""
        if verb in ("complete", "make") and (end := self._whole_turn(at)) is not None:
            event.landmark, self.at = "turn_end", end
        elif verb == "complete" and self.phrases.verb(at + 1, "turn") and "ing" in self.phrases.tokens[at + 1].forms:
            event.landmark, self.at = "turn_end", at + 2
        else:
            past = self._tag("through") is not None or self._tag("relation") == "past"
            found = self.phrases.landmark(self.at + past)
            if found is not None:
                event.landmark, self.at = found[0], found[1]

    def _whole_turn(self, at: int) -> int | None:
        """Return the position after "complete its left turn", "make the turn"; None where no turn is there."""
        at += 1
        owner = (at, at + 1) if self.phrases.tag(at, "possessive") else self.phrases.possessor(at)
        at = owner[1] if owner is not None else self.phrases.skip_determiner(at)
        at += self.phrases.tag(at, "direction") is not None
        return at + 1 if self.phrases.tag(at, "event_noun") == "turn" else None

    def _this_lets(self) -> bool:
        """Read "This" in "This lets the ego complete its turn": what the other vehicle was said to do."""
        word = self.phrases.tokens[self.at].text.lower()
        at = self.at + 1
        while self.phrases.tokens[at].tags.keys() & {"adverb", "auxiliary"}:
            at += 1
        if word not in ("this", "that", "its stop") or self.phrases.verb(at, "let") is None or self.subject_span:
            return False
        if self.current is not None and not self.links:
            return False
        done = [event for event in self.events if event.actor == HERO_ID and event.verb in SLOWS]
        if not done:
            return False
        self._set_subject(HERO_ID, self.phrases.tokens[self.at].span)
        self.current = None
        self.at += 1
        return True

    def _waits_for(self, start: int) -> bool:
        """Read "waits for the ego to complete its turn" as waiting until it has."""
        phrase = self.phrases.noun_phrase(start + 2) if self.phrases.tag(start + 1, "preposition") == "for" else None
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "link") != "to":
            return False
        if self.phrases.verb(phrase.end + 1, *RELEASED, "make") is None:
            return False
        event = self._open("wait", start)
        event.gerund = "ing" in self.phrases.tokens[start].forms
        self.links = ["until"]
        self._take_subject(phrase)
        self.at = phrase.end + 1
        return True

    def _stops_all_the_same(self, at: int) -> bool:
        """Whether what is done beside "instead of yielding" is to stop: "instead of yielding, the hero brakes"."""
        if self.current is not None and not self.links:
            return self.current.verb in SLOWS
        while "end" not in self.phrases.tokens[at].tags and self.phrases.verb(at) in (None, "begin"):
            at += 1
        return self.phrases.verb(at, *SLOWS) is not None

    def _instead(self) -> bool:
        """Step over "instead of waiting for the ego": what is done follows."""
        if self.phrases.tokens[self.at].text.lower() not in ("instead of", "rather than"):
            return False
        refused = self.phrases.verb(self.at + 1, "wait", "yield", "stop", "brake")
        if refused is None or "ing" not in self.phrases.tokens[self.at + 1].forms:
            return False
        end = self.at + 2
        linked = self.phrases.tag(end, "preposition") in ("for", "to")
        whom = linked or self.phrases.tokens[end - 1].text.lower().endswith(" to")
        phrase = self.phrases.noun_phrase(end + linked) if whom else None
        end = phrase.end if phrase is not None else end
        begins = self.phrases.noun_phrase(end) is not None and (self.current is None or bool(self.links))
        if (
            not begins
            and not self.phrases.tokens[end].tags.keys() & {"comma", "end"}
            and (self.phrases.tag(end, "link") not in ("and", "then"))
        ):
            return False
        if refused in ("wait", "yield") and self._stops_all_the_same(end):
            return False
        span = self.phrases.span(self.at, end)
        self.phrases.assume(
            f"'{span.excerpt(self.phrases.text)}' says what it does not do; what it does is said beside it"
        )
        if refused == "yield" and self.current is not None and self.current.actor is not None and not self.links:
            event = Event("yield", self.current.actor, span, self.sentence, ["that"], negated=True)
            self.events.append(event)
        self.at = end
        return True
