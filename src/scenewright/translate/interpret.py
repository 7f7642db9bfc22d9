"""Turns events into facts, sentence by sentence; refuses contradictions, negations and what no one can orchestrate.

What enters: events with modes. What leaves: `Facts`. It knows no map and builds no formulas.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import groupby

from scenewright.errors import Span
from scenewright.translate.actions import GOALS, SLOWING, SPEEDING
from scenewright.translate.events import EGO_ID, HERO_ID, Event
from scenewright.translate.facts import Facts, LaneRelation, Order, Phase
from scenewright.translate.moments import TELLING, MomentReader

_SINCE_BEFORE = re.compile(r"\b(?:has|had|have) been (?:standing|waiting|stationary|stopped|sitting)\b", re.IGNORECASE)
_NAMED_TRIGGER = re.compile(r"trigger|activation|\b(?:start|beginning|onset) of (?:the|its)", re.IGNORECASE)


@dataclass(slots=True)
class Interpreter(MomentReader):
    """Decides what every event is for."""

    def run(self, events: list[Event], described: list[tuple[str, int, Span]]) -> Facts:
        """Read all events, and what adjectives say of the actors ("the oncoming car", "the westbound hero")."""
        for word, actor, span in described:
            mention = Event("be", actor, span, -1)
            if word in ("lead", "oncoming"):
                self.facts.relations.append(LaneRelation(word, actor, mention))
            elif word in ("turns_left", "turns_right"):
                self._wish(actor, "turn", word.removeprefix("turns_"), mention)
            elif word == "standing":
                self._stand(Event("wait", actor, span, -1))
            elif word == "rear":
                kind, who = ("ego_leads", EGO_ID) if actor == HERO_ID else ("lead", HERO_ID)
                self.facts.relations.append(LaneRelation(kind, who, mention))
            else:
                self._wish(actor, "origin_heading", word, mention)
        self._stopped_at_first(events)
        sentences = [list(group) for _, group in groupby(events, key=lambda event: event.sentence)]
        for sentence in self._moments_told_before(sentences):
            self._sentence(sentence)
        refused = self.facts.not_yielding
        if not self.facts.phases and refused is not None and refused.verb == "yield":
            self.facts.phases.append(Phase("acc", [refused], goal="conflict_point", goal_event=refused))
            self.facts.assumptions.append("a hero that does not yield may speed up to pass the conflict point")
        self._go_when_released()
        self._keeps_its_speed()
        self._let_go_first()
        for left in [self.pending_before, *self.pending_release]:
            if left is not None:
                raise self._refuse("it is not said what the hero does then", left.span, "an action of the hero")
        return self.facts

    def _stopped_at_first(self, events: list[Event]) -> None:
        """Let "a van is there, stopped at the stop line" be one that stands there, where it never brakes."""
        if any(event.actor == HERO_ID and event.verb == "brake" for event in events):
            return
        for event in events:
            if event.mode == "when":
                return
            said = event.span.excerpt(self.text).lower()
            if event.actor == HERO_ID and event.verb == "stop" and said.startswith("stopped"):
                event.verb = "wait"

    def _moments_told_before(self, sentences: list[list[Event]]) -> list[list[Event]]:
        """Let "The ego gets to 12 m before the line. At that moment the hero brakes" be one sentence."""
        joined: list[list[Event]] = []
        for sentence in sentences:
            before = joined[-1] if joined else []
            placed = [event for event in before if event.places or event.ttc]
            free = all(
                event.mode == "main"
                and not event.initial
                and event.verb in ("be", "sit", "reach", "drive", "approach", "ttc")
                for event in placed
            )
            since = before[-1].span.end if before else 0
            named = _NAMED_TRIGGER.search(self.text[since : sentence[0].span.start]) is not None
            told = [event for event in sentence if event.mode == "main" and not event.initial]
            stated = all(e.verb in ("be", "sit") and e.places and isinstance(e.places[0].target, str) for e in told)
            asked = any(event.mode == "when" for every in sentences for event in every)
            if "moment" in sentence[0].links and stated and len(told) == len(sentence) and not asked and named:
                for event in sentence:
                    event.mode = "when"  # "At the trigger the ego is 45 m from its stop line"
                sentence[0].links.remove("moment")
            if "moment" in sentence[0].links and placed and free and not any(e.mode == "when" for e in before):
                for event in placed:
                    event.mode = "when"
                joined[-1] = before + sentence
            else:
                joined.append(sentence)
            for event in sentence:
                event.links = ["then" if link == "moment" else link for link in event.links]
        return joined

    def _sentence(self, events: list[Event]) -> None:
        self.sentence = events
        self._settle(events)
        self._give_subjects(events)
        for event in events:
            if event.actor is None:
                raise self._refuse(
                    "it is not said who does this", event.span, "the ego or the hero", "name the vehicle"
                )
            if event.to_actor == event.actor or any(place.target == event.actor for place in event.places):
                raise self._refuse("a vehicle is no measure of itself", event.span, "the other vehicle")
            self.facts.mentioned.add(event.actor)
        if self._slow_when_there(events):
            return
        self._one_moment(events)
        self._join_conditions(events)
        conditions = [e for e in events if e.mode == "when" and not self._is_marker(e)]
        self._conditions(conditions, events)
        reacts = bool(conditions)
        for event in events:
            stood = event.verb in ("wait", "stop", "sit") and event.actor == HERO_ID
            if stood and conditions and _SINCE_BEFORE.search(event.span.excerpt(self.text)):
                raise self._refuse("this was so before the moment", event.span, "stands at the stop line at first")
            if "steady" in event.notes and event.mode != "main":
                raise self._refuse("a constant speed is no moment", event.span)
            if event.verb == "attitude":
                self._attitude(event)
            elif event.negated:
                self._negated(event)
            elif event.mode == "when":
                if self._is_marker(event):
                    self._marker(event)
            elif event.mode == "until":
                self._until(event)
            elif event.mode == "before":
                self._before(event)
            elif event.mode == "after":
                self._after(event, events)
            else:
                self._main(event, reacts)

    def _attitude(self, event: Event) -> None:
        held = event.places or event.rate or event.speed or event.duration
        if held or event.mode != "main" or event.to_speed or event.landmark:
            raise self._refuse(f"'{event.span.excerpt(self.text)}' has no meaning here", event.span)
        self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}' changes nothing of what is orchestrated")
        self._note(event, "nothing to orchestrate")
        self._tell_route(event)

    def _before(self, event: Event) -> None:
        if self._goes_on_to_turn(event):
            self._tell_route(event)
            return
        if (
            event.actor == HERO_ID
            and event.verb in (*SPEEDING, *GOALS)
            and self.facts.phases
            and (not (event.explicit or event.resumed) or self._waits_before(event))
        ):
            self._action(event)  # "stops before accelerating"
            return
        slows = bool(self.facts.phases) and self.facts.phases[-1].kind == "dec" and not self.facts.phases[-1].to_stop
        if event.actor == HERO_ID and event.verb == "stop" and slows:
            self._action(event)  # "slows down before it stops 5 m before the conflict point"
            return
        if self._slow_by_then(event):
            return
        if event.actor != EGO_ID:
            raise self._refuse(
                "the hero's own moment is no bound here",
                event.span,
                "a moment of the ego",
                "say how far before, in metres",
            )
        self._tell_route(event)
        first = self.sentence[0] is event and any(
            e.mode == "main" and e.actor == HERO_ID and e.verb in (*SPEEDING, *GOALS) for e in self.sentence
        )
        if not self.facts.phases or (first and self.facts.phases[-1].kind == "dec"):
            self.pending_before = event
            return
        self._check_order_phase(event)
        self._set_order(Order(True, self._ego_landmark(event), event))

    def _waits_before(self, event: Event) -> bool:
        """Whether "it waits for 2 s before it accelerates" tells in order what the hero does."""
        waits = self.sentence[0]
        waited = waits.verb == "wait" and waits.mode == "main" and waits.duration is not None
        return waited and waits.actor == HERO_ID and self.sentence[1] is event and self.facts.phases[-1].kind == "dec"

    def _until(self, event: Event) -> None:
        if self._slow_until(event):
            return
        if event.actor == HERO_ID and event.verb in ("stop", "wait") and self.facts.phases:
            self._action(event)
        elif event.actor == EGO_ID and self.facts.phases and self.facts.phases[-1].kind == "dec":
            self.pending_release.append(event)
        else:
            raise self._refuse("this 'until' could not be understood", event.span, "until it has stopped")

    def _check_order_phase(self, event: Event) -> None:
        if self.facts.phases[-1].kind == "dec" and self.facts.phases[-1].goal is None:
            raise self._refuse(
                "a stop cannot be ordered before the ego",
                event.span,
                "the hero passes the conflict point before the ego",
                "say what the hero passes first",
            )

    def _after(self, event: Event, events: list[Event]) -> None:
        if self._rests(event):
            return
        if event.actor == HERO_ID and event.verb in SLOWING:
            if event.places or event.rate:
                self._action(event)
            else:
                self._marker(event)
        elif event.actor == HERO_ID and event.verb in ("turn", "complete") and self.facts.phases and not self._runs():
            self._tell_route(event)
            self._marker(event)
        elif event.actor == HERO_ID and self.facts.order is not None:
            self._note(event, "the hero comes first")
        elif event.actor == HERO_ID and self._ego_main(events) is not None:
            self._action(event)
            self._set_order(Order(True, self._ego_landmark(self._ego_main(events) or event), event))
        elif event.actor == EGO_ID and not self.pending_release:
            self._tell_route(event)
            self.pending_release.append(event)
            phase = self.facts.phases[-1] if self.facts.phases else None
            if phase is not None and phase.kind == "dec" and phase.goal is not None and phase.goal_event in events:
                self.pending_release.pop()  # "arrives there at 5 m/s after the ego has passed it"
                self._set_order(Order(False, self._ego_landmark(event), event))
            elif phase is not None and phase.kind != "dec":
                told = [each for every in self.facts.phases for each in every.events]
                waits = any(each.verb == "wait" and each.duration is None and self._says_wait(each) for each in told)
                self._apply_release(phase, at_start=waits or phase.goal_event not in events)
        else:
            raise self._refuse("it is not clear what comes after this", event.span)

    def _says_wait(self, event: Event) -> bool:
        return "wait" in event.span.excerpt(self.text).lower()

    def _runs(self) -> bool:
        """Whether the hero is on its way to a goal of which the ego's moment is told: "the ego passes after it"."""
        ego = self._ego_main(self.sentence)
        return self.facts.phases[-1].kind in ("acc", "go") and ego is not None and ego.verb in GOALS

    @staticmethod
    def _ego_main(events: list[Event]) -> Event | None:
        return next((e for e in events if e.actor == EGO_ID and e.mode == "main" and not e.negated), None)

    def _negated(self, event: Event) -> None:
        straight = event.verb == "turn" and event.direction is None and not (event.areas or event.places)
        if straight and event.mode == "main" and event.actor is not None and not self.facts.phases:
            self._wish(event.actor, "turn", "straight", event)
            return
        if self._holds(event):
            return
        plain = not (event.places or event.rate or event.speed or event.to_speed or event.areas)
        if event.actor == HERO_ID and event.verb == "accelerate" and plain and event.mode == "main":
            self.facts.steady = event
            self._note(event, "the hero does not speed up")
            return
        plain = plain and (event.landmark is None or "let" in event.notes)
        if event.actor == HERO_ID and event.verb in (*SLOWING, "wait") and plain and event.mode == "main":
            self.facts.not_yielding = self.facts.not_yielding or event
            self._note(event, "the hero does not stop for the ego")
            return
        raise self._refuse(
            "a negation like this cannot be orchestrated",
            event.span,
            "what the vehicles do",
            "say what happens instead",
        )

    def _main(self, event: Event, reacts: bool) -> None:
        way = event.headings or event.areas or event.direction == "straight"
        if event.verb == "keep" and way and not self.facts.phases and not reacts:
            event.verb = "drive"  # "the van keeps going west"
        self._drive_past(event, reacts)
        arrives = self._arrives(event)
        if "steady" in event.notes:
            passes = event.actor == HERO_ID and event.verb in GOALS and (reacts or self.facts.trigger)
            if not passes:
                raise self._refuse("a constant speed is supported only on the way past the ego", event.span)
            self.facts.steady = event
        if event.actor == EGO_ID:
            self._ego(event)
        elif arrives or self._is_action(event, reacts):
            self._action(event)
        elif event.verb in TELLING:
            self._tell(event)
        else:
            raise self._refuse(f"'{event.span.excerpt(self.text)}' has no meaning here", event.span)

    def _ego_in_order(self, event: Event) -> bool:
        """Read "the ego passes the conflict point before the hero": who comes first, told from the ego's side."""
        landmark = self._ego_landmark(event)
        phases = self.facts.phases
        if landmark != "conflict_point" or not phases or event.places or event.speed:
            return False
        if phases[-1].kind == "dec" and event.after_actor is None:
            phases.append(Phase("acc", [event], goal="conflict_point", goal_event=event))
            said = f"'{event.span.excerpt(self.text)}': the hero goes on after the ego has passed"
            self.facts.assumptions.append(said)
        if phases[-1].kind not in ("acc", "go"):
            return False
        phases[-1].goal = phases[-1].goal or "conflict_point"
        self._set_order(Order(event.than_actor is None, "conflict_point", event, at_start=phases[-1].events == [event]))
        return True

    def _drive_past(self, event: Event, reacts: bool) -> None:
        """Let a vehicle that "passes the driveway" before anything happens drive straight on."""
        first = not reacts and not self.facts.phases and "then" not in event.links and not event.negated
        beside = event.verb == "pass" and event.landmark == "turn" and not event.places
        if first and beside and event.than_actor is None and event.after_actor is None and not event.first:
            event.verb, event.landmark, event.direction = "drive", None, "straight"

    def _goes_on_to_turn(self, event: Event) -> bool:
        """Whether "before turning left into the driveway" only tells where a drive ends."""
        at = next(index for index, each in enumerate(self.sentence) if each is event)
        told = any(
            each.actor == event.actor and each.verb in ("drive", "lane_follow", "approach", "be", "go")
            for each in self.sentence[:at]
        )
        acts = any(each.verb in (*SLOWING, *SPEEDING, *GOALS) and each.actor == HERO_ID for each in self.sentence)
        return told and not acts and event.gerund and event.verb == "turn" and not self.facts.phases

    def _ego(self, event: Event) -> None:
        across = event.verb == "pass" and event.landmark == "intersection" and not self.facts.phases
        if across and "then" not in event.links and event.than_actor is None:  # "the ego crosses the T-junction"
            event.verb, event.landmark = "lane_follow", None
        if event.verb == "keep" and (event.headings or event.areas):
            event.verb = "drive"  # "the ego keeps driving west"
        allowed = event.verb in TELLING and not (event.rate or event.to_speed or event.duration or event.to_stop)
        ordered = event.verb in ("turn", "pass", "reach", "complete", "enter", "leave") and not event.areas
        other = event.than_actor if event.than_actor is not None else event.after_actor
        if ordered and other == HERO_ID and not event.negated and self._ego_in_order(event):
            return
        goes = bool(self.facts.phases) and self.facts.phases[-1].kind in ("acc", "go")
        if ordered and goes and "then" in event.links and not event.negated and event.mode == "main":
            self._set_order(Order(True, self._ego_landmark(event), event))  # "..., after which the ego begins to turn"
            return
        if self._is_let(event):
            return
        timed = (ordered and event.verb != "turn") or (event.begins and event.verb == "turn")
        if timed and not any(each.mode == "after" and each.actor == HERO_ID for each in self.sentence):
            raise self._refuse(
                "the ego cannot be told when to do this: the driving policy under test drives it",
                event.span,
                "what the ego wants, or its moment in an order ('before the ego begins to turn')",
            )
        if (ordered and "only" in event.links) or (ordered and event.verb != "turn"):
            self._note(event, "the ego's moment in the order")
            return
        if not allowed:
            raise self._refuse(
                "the ego cannot be told to do this: the driving policy under test drives it",
                event.span,
                "where the ego is and where it wants to go",
                "let the hero act, or leave this out",
            )
        if event.begins and event.verb == "turn":
            self._note(event, "the ego's moment in the order")
            return
        self._tell(event)
