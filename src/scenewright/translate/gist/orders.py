"""Finds who is first: the hero with the goal of its last phase, or the ego at a moment of its own.

What enters: words, moments, deeds, and the phases of the hero as they are found. What leaves: the order, or what the
hero lets the ego do, in the facts; an event for each.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise

from scenewright.translate.events import EGO_ID, HERO_ID, Event
from scenewright.translate.facts import Facts, Order
from scenewright.translate.gist.moments import MomentReader
from scenewright.translate.gist.words import Deed, Words

GOES = ("accelerate", "pass", "complete", "keep", "go")


@dataclass(slots=True)
class OrderReader:
    """Reads the order of one text; the facts hold the phases that it orders."""

    words: Words
    moments: MomentReader
    deeds: list[Deed]
    facts: Facts = field(default_factory=Facts)
    events: list[Event] = field(default_factory=list)

    @property
    def trigger_sentence(self) -> int:
        """The sentence in which the trigger is told."""
        return min(made.clause.sentence for made in self.moments.of("trigger"))

    def read_order(self, goes: list[Deed]) -> None:
        """Find who is first, or what the hero lets the ego do, from what the hero does and the moments of the ego."""
        acted = {deed.clause.sentence for deed in self.deeds if deed.actor == HERO_ID and deed.kind != "turn"}
        moments = [deed for deed in self.deeds if deed.kind in ("before", "after")]
        early = [d for d in moments if d.clause.sentence < self.trigger_sentence and d.clause.sentence not in acted]
        moments = [d for d in moments if d not in early]
        later = [d for d in moments if d.clause.sentence >= self.trigger_sentence]
        if later:  # "It stops for us and resumes after we are gone. ..." tells in short what follows
            kinds = {(d.kind, d.landmark) for d in later}
            moments = [d for d in moments if d in later or (d.landmark != "same" and (d.kind, d.landmark) not in kinds)]
        early = [deed for deed in early if self._acts_from(deed)]  # not "the hero, the ego after it"
        if early and not moments:
            raise self.words.refuse("it is not clear what this orders", self.words.span(early[0].clause))
        lets = [deed for deed in self.deeds if deed.kind == "let_reach" and not self._is_purpose(deed)]
        lets = [deed for deed in lets if deed.clause.sentence >= self.trigger_sentence] or lets  # not what sums it up
        moments = moments or self._first(goes)
        if lets and any(deed.kind == "before" for deed in moments):
            raise self.words.refuse("the hero lets the ego go and also comes first", lets[0].span)
        if lets and not moments:
            self._let(lets[0])
        previous: Deed | None = None
        for deed in moments:
            self._one_order(deed, previous)
            previous = deed

    def _acts_from(self, deed: Deed) -> bool:
        """Whether a verb follows in the sentence."""
        sentence = self.words.sentence(deed.clause)
        return bool(self.words.verbs(range(deed.clause.start, sentence[-1].end)))

    def _is_purpose(self, deed: Deed) -> bool:
        """Whether it is only said what for: "To let the ego make its turn, a car stops. It brakes when ..."."""
        to = self.words.word(deed.clause.start - 2) == "to"
        goes = (d for d in self.deeds if d.actor == HERO_ID and d.kind in GOES and d.at > deed.at)
        own = [d for d in goes if d.clause.sentence == deed.clause.sentence and d.clause.link == "then"]
        if any(self.words.word(d.clause.start - 1).startswith("only") for d in own):
            return False  # "stops to let the ego complete its turn and only then carries on"
        return to and deed.clause.sentence < self.trigger_sentence

    def _let(self, deed: Deed) -> None:
        event = Event("pass", EGO_ID, deed.span, deed.clause.sentence)
        self.events.append(event)
        if self.facts.phases[-1].kind != "dec":
            self.facts.order = Order(False, deed.landmark or "conflict_point", event, at_start=True)
        elif deed.landmark == "turn_start":  # "to let the ego turn" tells what for, "to let it make its turn" all of it
            whole = "make" in self.words.verbs(deed.clause.inside)
            self.facts.let_goal = ("turn_end", event) if whole else None
        elif deed.landmark is not None:
            self.facts.let_goal = deed.landmark, event

    def _one_order(self, deed: Deed, previous: Deed | None) -> None:
        phase, known = self.facts.phases[-1], self.facts.order
        landmark = deed.landmark or "conflict_point"
        if landmark == "same":
            landmark = phase.goal or "conflict_point"
        if landmark == "turn_end" and deed.landmark == "same":
            raise self.words.refuse("it is not clear which moment of the ego this is", deed.span)
        first = deed.kind == "before"
        if phase.kind == "dec" and not (first and landmark == "turn_start" and phase.place and self._stopped_by(deed)):
            raise self.words.refuse("a stop cannot be ordered against the ego", deed.span)
        again = previous is not None and previous.kind == deed.kind and "same" in (deed.landmark, previous.landmark)
        if known is not None and again and deed.landmark == "turn_start" and previous is not None and first:
            known = self.facts.order = None  # "ahead of the ego, and it has passed it before the ego begins to turn"
        if known is not None and again:
            return  # "ahead of the ego, that is, before the ego does"
        if known is not None:
            raise self.words.refuse("two orders are told", deed.span)
        event = Event("pass", EGO_ID, deed.span, deed.clause.sentence)
        self.events.append(event)
        reached = phase.goal_event is not None and phase.goal_event.sentence == deed.clause.sentence
        waits = any(self._only_waits(each) for each in self.deeds)
        reached = reached and not waits  # "It waits. It sets off and passes the point only after the ego has turned"
        at_end = (
            first
            or deed.landmark == "same"
            or (reached and phase.goal_event is not None and phase.goal_event.span.start < deed.span.start)
        )
        margin = next((m for m in self.moments.of("deed") if m.kind == "margin" and m.clause.end == deed.at - 1), None)
        self.facts.order = Order(first, landmark, event, at_start=not at_end)
        if margin is not None:
            if not at_end:
                raise self.words.refuse("it is not clear between which moments this time is", margin.span)
            bound = margin.bound
            self.facts.order = replace(self.facts.order, margin=margin.quantity, margin_bound=bound)
        if phase.goal is None and first and phase.kind != "dec":
            phase.goal, phase.goal_event = "conflict_point", event

    def _only_waits(self, deed: Deed) -> bool:
        """Whether the hero waits, and not for a time that is told."""
        waits = deed.kind == "wait" and deed.actor == HERO_ID and self.words.word(deed.at).startswith("wait")
        return waits and not self.words.has(deed.clause.inside, "quantity")

    def _stopped_by(self, moment: Deed) -> bool:
        """Whether the hero is said to stand by then: "it has come to a stop before the ego begins to turn"."""
        own = [deed for deed in self.deeds if deed.actor == HERO_ID and deed.at < moment.at]
        return bool(own) and own[-1].kind == "stop" and own[-1].clause.sentence == moment.clause.sentence

    def _first(self, goes: list[Deed]) -> list[Deed]:
        """Read "gets to the conflict point first"."""
        for deed in goes:
            at = self.words.where(deed.clause.inside, "adverb", "first")
            if at is not None:
                return [Deed("before", at, deed.clause, self.words.tokens[at].span, "same", EGO_ID)]
        for clause, following in pairwise(self.words.clauses):  # "Order: hero first, then ego"
            at = self.words.where(clause.inside, "adverb", "first")
            alone = at is not None and not self.words.has(clause.inside, "verb", "be", "quantity")
            other = following.named and following.subject == EGO_ID and following.sentence == clause.sentence
            if alone and at is not None and goes and clause.named and clause.subject == HERO_ID and other:
                return [Deed("before", at, clause, self.words.tokens[at].span, "same", EGO_ID)]
        return []
