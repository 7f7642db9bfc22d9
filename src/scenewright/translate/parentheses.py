"""Reads what stands in parentheses behind a vehicle: "the ego (13 m/s)", "a pickup (going straight)".

What enters: the reader's state at an opening parenthesis. What leaves: True where what is in it was read, or was moved
to a sentence of its own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.translate.events import EGO_ID, Event
from scenewright.translate.place_adjuncts import PlaceAdjunctReader
from scenewright.translate.reader import TURNS
from scenewright.translate.tokens import Token


@dataclass(slots=True)
class ParenthesisReader(PlaceAdjunctReader):
    """Reads parentheses."""

    def _parenthesis(self) -> bool:
        """Read "the ego (13 m/s)" and "the hero (westbound)": said of the vehicle that was named just before."""
        if self.phrases.tokens[self.at].text != "(":
            return False
        return (not self._of_a_pair() and self._short_parenthesis()) or self._told_in_parentheses()

    def _of_a_pair(self) -> bool:
        """Whether "and" follows a parenthesis beside a subject: "the ego (westbound) and the hero ..."."""
        at = self.at
        while "end" not in self.phrases.tokens[at].tags and self.phrases.tokens[at].text != ")":
            at += 1
        named = self.phrases.last_named is not None and self.phrases.last_named[1] == self.at
        return named and self.subject_span is not None and self.phrases.tokens[at + 1].text.lower() == "and"

    def _told_in_parentheses(self) -> bool:
        """Move "(turns left onto the road)" to a sentence of its own right after this one, about the same vehicle."""
        tokens, opening = self.phrases.tokens, self.phrases.tokens[self.at]
        close = next((at for at in range(self.at, len(tokens)) if tokens[at].text == ")"), None)
        named = self.phrases.last_named
        actor = named[0] if named is not None and named[1] == self.at else self.subject
        if close is None or actor is None or (self.subject_span is None and self.current is None):
            return False
        inner = tokens[self.at + 1 : close]
        speaks = bool(inner) and not any(token.tags.keys() & {"end", "link", "measure", "label"} for token in inner[:1])
        for token in inner:
            amount = token.quantity is not None and token.quantity.dimension != "speed"
            if amount or token.tags.keys() & {"end", "colon"} or token.tags.get("link") in ("when", "until", "after"):
                return False
        beside_turn = self.current is not None and self.current.verb in TURNS and "heading" in inner[0].tags
        if (
            not speaks
            or beside_turn
            or any("when" in event.links for event in self.events if event.sentence == self.sentence)
        ):
            return False
        after = close + 1
        while "end" not in tokens[after].tags:
            after += 1
        paired = self._of_a_pair()
        if self.subject_span is not None and tokens[close + 1].tags.keys() & {"comma", "end"}:
            self._open("be", self.at - 1)  # "Actors: ego (turns left), NPC (eastbound)": all is said in parentheses
        inner = inner[1:] if inner[0].text.lower() in ("it", "he", "she", "which", "who") else inner
        name = "ego" if actor == EGO_ID else "hero"
        if not inner:
            return False  # "()"
        finite = bool(inner[0].forms & {"s"}) or bool(inner[0].tags.keys() & {"be", "auxiliary"})
        told = [Token(name, opening.span, {name: name})]
        told += [] if finite else [Token(":", opening.span, {"colon": ":"})]
        closing = tokens[close].span
        ended = tokens[after]
        if ended.tags["end"] == "text":
            tokens[after:after] = [Token(".", closing, {"end": "."}), *told, *inner, Token(".", closing, {"end": "."})]
        else:
            tokens[after + 1 : after + 1] = [*told, *inner, Token(".", closing, {"end": "."})]
        del tokens[self.at : close + 1]
        if paired and self.subject_span is not None:  # both names are read again, as one subject
            begin = self.subject_span.start
            self.at = next(at for at, token in enumerate(tokens) if token.span.start == begin)
            if tokens[self.at].tags.get("determiner") == "indefinite":
                tokens[self.at] = replace(tokens[self.at], tags={"determiner": "definite"})
            self.subject_span = None
        return True

    def _short_parenthesis(self) -> bool:
        """Read speeds, headings and turns in parentheses."""
        if self.phrases.last_named is None or self.phrases.last_named[1] != self.at:
            return False
        actor = self.phrases.last_named[0]
        event = Event("be", actor, self.phrases.tokens[self.at - 1].span, self.sentence, ["that"])
        at, turns = self.at + 1, list[Event]()
        while self.phrases.tokens[at].text != ")":
            quantity, heading = self.phrases.tokens[at].quantity, self.phrases.heading(at)
            if quantity is not None and quantity.dimension == "speed" and event.speed is None:
                event.speed, at = quantity, at + 1
            elif heading is not None:
                event.headings.append((heading[0], self.phrases.span(at, heading[1])))
                at = heading[1]
            elif self.phrases.tag(at, "direction") == "straight" and event.direction is None:
                event.notes += ["no turn"] if "turn" in self.phrases.tokens[at].text.lower() else []
                event.direction, at = "straight", at + 1
            elif self.phrases.tag(at, "direction") and self.phrases.tag(at + 1, "event_noun") == "turn":
                turn = Event("turn", actor, self.phrases.span(at, at + 2), self.sentence, ["that"], wanted=True)
                turn.direction = self.phrases.tag(at, "direction")
                turns.append(turn)
                at += 2
            elif area := (self.phrases.area(at) or self.phrases.area_noun(at, "on")):
                event.areas.append(area[0])
                at = area[1]
            elif self.phrases.tag(at, "comma") is not None or self.phrases.tag(at, "preposition") == "at":
                at += 1
            else:
                return False
        event.span = self.phrases.span(self.at - 1, at + 1)
        self.events += [*turns, event]
        self.at = at + 1
        return True
