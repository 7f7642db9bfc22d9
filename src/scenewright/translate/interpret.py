"""Turns events into facts, sentence by sentence; refuses contradictions, negations and what no one can orchestrate.

What enters: events with modes. What leaves: `Facts`. It knows no map and builds no formulas.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby, pairwise

from scenewright.errors import Span
from scenewright.translate.actions import EDGE, GOALS, SLOWING, SPEEDING, ActionReader
from scenewright.translate.events import EGO_ID, HERO_ID, Event, Place
from scenewright.translate.facts import Condition, Facts, LaneRelation, Order, Phase

INSTANT = ("brake", "accelerate", "yield")
TELLING = ("be", "sit", "drive", "approach", "lane_follow", "turn", "pull_out", "leave", "wait", "go")


@dataclass(slots=True)
class Interpreter(ActionReader):
    """Decides what every event is for."""

    def run(self, events: list[Event], described: list[tuple[str, int, Span]]) -> Facts:
        """Read all events, and what adjectives say of the actors ("the oncoming car", "the westbound hero")."""
        for word, actor, span in described:
            mention = Event("be", actor, span, -1)
            if word in ("lead", "oncoming"):
                self.facts.relations.append(LaneRelation(word, actor, mention))
            elif word in ("turns_left", "turns_right"):
                self._wish(actor, "turn", word.removeprefix("turns_"), mention)
            elif word == "rear":
                kind, who = ("ego_leads", EGO_ID) if actor == HERO_ID else ("lead", HERO_ID)
                self.facts.relations.append(LaneRelation(kind, who, mention))
            else:
                self._wish(actor, "origin_heading", word, mention)
        for _, group in groupby(events, key=lambda event: event.sentence):
            self._sentence(list(group))
        refused = self.facts.not_yielding
        if not self.facts.phases and refused is not None and refused.verb == "yield":
            self.facts.phases.append(Phase("acc", [refused], goal="conflict_point", goal_event=refused))
            self.facts.assumptions.append("a hero that does not yield may speed up to pass the conflict point")
        self._let_go_first()
        for left in [self.pending_before, *self.pending_release]:
            if left is not None:
                raise self._refuse("it is not said what the hero does then", left.span, "an action of the hero")
        return self.facts

    def _let_go_first(self) -> None:
        """Let a hero that "lets the ego pass, then continues" go on only when the ego has passed."""
        let = [event for phase in self.facts.phases for event in phase.events if "let" in event.notes]
        if (
            let
            and self.facts.order is None
            and [phase.kind for phase in self.facts.phases]
            in (
                ["dec", "acc"],
                ["dec", "go"],
            )
        ):
            self._set_order(Order(False, "conflict_point", let[0], at_start=True))

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
        self._join_conditions(events)
        conditions = [e for e in events if e.mode == "when" and not self._is_marker(e)]
        self._conditions(conditions, events)
        reacts = bool(conditions)
        for event in events:
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
        held = event.places or event.areas or event.headings or event.rate or event.speed or event.duration
        if held or event.mode != "main" or event.to_speed or event.landmark:
            raise self._refuse(f"'{event.span.excerpt(self.text)}' has no meaning here", event.span)
        self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}' changes nothing of what is orchestrated")
        self._note(event, "nothing to orchestrate")

    @staticmethod
    def _settle(events: list[Event]) -> None:
        """Let "with both driving west" tell; let "the ego is 30 m from it when the hero brakes" be the condition."""
        for event in events:
            tells = event.verb in ("be", "drive", "lane_follow") and not (event.places or event.speed or event.ttc)
            if "with" in event.links and event.mode == "when" and tells:
                event.mode = "main"
        acts = [e for e in events if e.mode == "when" and e.actor == HERO_ID and e.verb in INSTANT and not e.places]
        acts = acts or [e for e in events if e.mode == "when" and e.actor == HERO_ID and e.verb in ("brake", "stop")]
        conditions = [event for event in events if event.mode == "when"]
        states = [e for e in events if e.mode == "main" and (e.places or e.ttc) and e.verb in ("be", "sit", "ttc")]
        if not acts or conditions[0] is not acts[0] or events.index(acts[0]) == 0:
            return
        before = [e for e in events[: events.index(acts[0])] if not e.wanted or e.places]
        relative = [e for e in events if "that" in e.links and e in states and e.actor == acts[0].actor]
        if any(each not in states or each.initial for each in before) or not (
            acts[0].links[:1] == ["when"] or any("when" in e.links for e in relative)
        ):
            return
        for event in (*before, *relative):
            event.mode = "when"
        for event in conditions:
            event.mode = "main"

    def _join_conditions(self, events: list[Event]) -> None:
        """Let "the hero is 20 m behind the conflict point when the ego is ..." tell of one moment."""
        conditions = [event for event in events if event.mode == "when" and not self._is_marker(event)]
        if not conditions:
            return
        for event, following in pairwise([*events, None]):
            if event is None:
                break
            told = event.mode == "main" and event.verb in ("be", "sit", "drive", "approach", "ttc")
            if not told or event.initial or event.negated:
                continue
            if following is not None and following.links == ["when"] and (event.places or event.speed or event.ttc):
                event.mode = "when"
            elif event.places:
                raise self._refuse(
                    "it is not clear whether this holds at the start or at the trigger",
                    event.span,
                    "'initially', or the words inside the 'when' clause",
                )

    @staticmethod
    def _give_subjects(events: list[Event]) -> None:
        """Let "After turning right, the car ..." take the subject of the clause that follows."""
        for index, event in enumerate(events):
            fronted = event.actor is None and event.mode == "main" and len(events) > 1 and events[1].explicit
            if event.gerund and (event.mode in ("after", "before") or fronted) and index == 0:
                following = next((e for e in events[1:] if e.mode == "main" or fronted), None)
                if following is not None:
                    event.actor = following.actor

    @staticmethod
    def _is_marker(event: Event) -> bool:
        """Whether a condition only names the end of what the hero does anyway: "once it has stopped"."""
        return event.actor == HERO_ID and event.verb in ("stop", "wait") and not event.places

    def _marker(self, event: Event) -> None:
        if not self.facts.phases or self.facts.phases[-1].kind not in ("dec", "turn"):
            raise self._refuse("nothing was said before that this could refer to", event.span)
        self._note(event, "after the hero has done so")

    def _conditions(self, conditions: list[Event], events: list[Event]) -> None:
        for event in events:
            if "within" in event.notes and (
                event.mode != "when" or len([e for e in events if "within" in e.notes]) > 1
            ):
                raise self._refuse(
                    "this gives a bound, not a value",
                    event.span,
                    "an exact distance, or one 'gets within' after 'when'",
                )
        if not conditions:
            return
        heroes = [e for e in events if e.mode == "main" and e.actor == HERO_ID]
        releases = self.facts.trigger and self.facts.phases and heroes and heroes[0].verb in (*SPEEDING, *GOALS, "keep")
        if releases:
            self._release(conditions)
            return
        if self.facts.trigger:
            raise self._refuse(
                "there is a second trigger", conditions[0].span, "one trigger", "join the conditions with 'and'"
            )
        for event in conditions:
            if event.negated:
                raise self._refuse(
                    "a negated condition has no moment", event.span, "where the vehicles are when it begins"
                )
            found = self._conditions_of(event)
            for each in found:
                self._no_second_place(each, self.facts.trigger)
                self.facts.trigger.append(each)
            if not found:
                raise self._refuse(
                    "this condition has no place, time or speed",
                    event.span,
                    "such as 'the ego is 12 m behind the stop line'",
                )
            self._tell_route(event)

    def _conditions_of(self, event: Event) -> list[Condition]:
        actor = event.actor
        assert actor is not None
        ordered = event.first or event.than_actor is not None or event.after_actor is not None
        if event.rate or event.to_speed or event.duration or ordered:
            raise self._refuse("this cannot be a condition", event.span, "a place, a time or a speed")
        if event.verb == "wait" and event.places:
            self._stand(event)
        found = [Condition(actor, event, place=place) for place in event.places]
        if event.ttc:
            found.append(Condition(actor, event, ttc=event.ttc))
        if event.speed:
            found.append(Condition(actor, event, speed=event.speed))
        if event.verb in ("pass", "reach", "enter", "leave") and event.landmark:
            landmark = EDGE.get((event.verb, event.landmark), event.landmark)
            found.append(Condition(actor, event, place=Place("at", landmark, None, event.span)))
        elif event.verb in ("turn", "complete") and event.direction is None and not event.areas:
            landmark = "turn_end" if event.verb == "complete" else "turn_start"
            found.append(Condition(actor, event, place=Place("at", landmark, None, event.span)))
        elif event.verb == "reach" and found:
            pass  # "reaches a point 12 m behind the stop line"
        elif event.verb not in ("be", "sit", "drive", "approach", "ttc", "wait", "lane_follow"):
            raise self._refuse(f"'{event.span.excerpt(self.text)}' is not a moment that can be waited for", event.span)
        if event.verb == "approach" and not found:
            return []
        return found

    def _release(self, conditions: list[Event]) -> None:
        for event in conditions:
            if event.actor != EGO_ID or self.pending_release:
                raise self._refuse("there is a second trigger", event.span, "one trigger")
            self._tell_route(event)
            self.pending_release.append(event)

    def _before(self, event: Event) -> None:
        if (
            event.actor == HERO_ID
            and event.verb in (*SPEEDING, *GOALS)
            and self.facts.phases
            and not (event.explicit or event.resumed)
        ):
            self._action(event)  # "stops before accelerating"
            return
        if event.actor != EGO_ID:
            raise self._refuse(
                "the hero's own moment is no bound here",
                event.span,
                "a moment of the ego",
                "say how far before, in metres",
            )
        self._tell_route(event)
        if not self.facts.phases:
            self.pending_before = event
            return
        self._check_order_phase(event)
        self._set_order(Order(True, self._ego_landmark(event), event))

    def _until(self, event: Event) -> None:
        if event.actor == HERO_ID and event.verb in ("stop", "wait") and self.facts.phases:
            self._action(event)
        elif event.actor == EGO_ID and self.facts.phases and self.facts.phases[-1].kind == "dec":
            self.pending_release.append(event)
        else:
            raise self._refuse("this 'until' could not be understood", event.span, "until it has stopped")

    def _check_order_phase(self, event: Event) -> None:
        if self.facts.phases[-1].kind == "dec":
            raise self._refuse(
                "a stop cannot be ordered before the ego",
                event.span,
                "the hero passes the conflict point before the ego",
                "say what the hero passes first",
            )

    def _after(self, event: Event, events: list[Event]) -> None:
        if event.actor == HERO_ID and event.verb in SLOWING:
            if event.places or event.rate:
                self._action(event)
            else:
                self._marker(event)
        elif event.actor == HERO_ID and event.verb in ("turn", "complete") and self.facts.phases:
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
            if phase is not None and phase.kind != "dec":
                self._apply_release(phase, at_start=phase.goal_event not in events)
        else:
            raise self._refuse("it is not clear what comes after this", event.span)

    @staticmethod
    def _ego_main(events: list[Event]) -> Event | None:
        return next((e for e in events if e.actor == EGO_ID and e.mode == "main" and not e.negated), None)

    def _negated(self, event: Event) -> None:
        plain = not (event.places or event.rate or event.speed or event.to_speed or event.landmark or event.areas)
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
        if event.actor == EGO_ID:
            self._ego(event)
        elif self._is_action(event, reacts):
            self._action(event)
        elif event.verb in TELLING:
            self._tell(event)
        else:
            raise self._refuse(f"'{event.span.excerpt(self.text)}' has no meaning here", event.span)

    def _is_action(self, event: Event, reacts: bool) -> bool:
        if event.wanted or event.initial:
            return event.verb in (*SLOWING, "accelerate")
        if event.verb in (*SLOWING, "accelerate", "keep", "pass", "complete", "reach", "enter"):
            return True
        if event.verb == "go":
            return reacts or not (event.direction or event.headings or event.areas)
        later = bool(self.facts.phases) and bool({"then", "then_label"} & set(event.links))
        if event.verb in ("turn", "pull_out"):
            return (reacts and not self._told_before(event)) or later
        if event.verb == "leave":
            return event.landmark is not None
        turned = bool(self.facts.phases) and self.facts.phases[-1].kind == "turn"
        if event.verb in ("lane_follow", "drive"):
            return turned and (event.speed is not None) and (later or event.begins or reacts)
        if event.verb == "wait":
            return bool(self.facts.phases) or (reacts and bool(event.places) and not event.gerund)
        return False

    def _told_before(self, event: Event) -> bool:
        """Whether this is told on the way to a "when" clause that has a reaction of its own after it."""
        rest = self.sentence[self.sentence.index(event) + 1 :]
        condition = next((e for e in rest if e.mode == "when"), None)
        if condition is None or not {"comma", "and"} & set(condition.links):
            return False
        after = rest[rest.index(condition) :]
        return any(e.mode == "main" and e.actor == HERO_ID and e.verb in (*SLOWING, *SPEEDING, *GOALS) for e in after)

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

    def _ego(self, event: Event) -> None:
        allowed = event.verb in TELLING and not (event.rate or event.to_speed or event.duration or event.to_stop)
        ordered = event.verb in ("turn", "pass", "reach", "complete", "enter", "leave") and not event.areas
        other = event.than_actor if event.than_actor is not None else event.after_actor
        if ordered and other == HERO_ID and not event.negated and self._ego_in_order(event):
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
