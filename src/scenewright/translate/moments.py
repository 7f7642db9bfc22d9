"""Finds the moment at which the hero reacts: which events of a sentence are its conditions.

What enters: the events of a sentence with their modes. What leaves: conditions in `Facts`; two moments are refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from scenewright.translate.actions import EDGE, GOALS, SLOWING, SPEEDING
from scenewright.translate.events import EGO_ID, HERO_ID, Event, Place
from scenewright.translate.facts import Condition
from scenewright.translate.outcomes import OutcomeReader

INSTANT = ("brake", "accelerate", "yield")
TELLING = ("be", "sit", "drive", "approach", "lane_follow", "turn", "pull_out", "leave", "wait", "go")


@dataclass(slots=True)
class MomentReader(OutcomeReader):
    """Collects the conditions of the trigger."""

    @staticmethod
    def _settle(events: list[Event]) -> None:
        """Let "with both driving west" tell; let "the ego is 30 m from it when the hero brakes" be the condition."""
        accompanied = False
        for event in events:
            placed = any(isinstance(place.target, str) or place.amount for place in event.places)
            tells = event.verb in ("be", "drive", "lane_follow", "turn", "pull_out", "leave") and not (
                placed or event.speed or event.ttc
            )
            accompanied = "with" in event.links or (accompanied and event.links == ["and"])
            if accompanied and event.mode == "when" and tells:
                event.mode = "main"  # "with the van in front and the ego behind it"
        acts = [e for e in events if e.mode == "when" and e.actor == HERO_ID and e.verb in INSTANT and not e.places]
        acts = acts or [e for e in events if e.mode == "when" and e.actor == HERO_ID and e.verb in ("brake", "stop")]
        conditions = [event for event in events if event.mode == "when"]
        states = [e for e in events if e.mode == "main" and (e.places or e.ttc) and e.verb in ("be", "sit", "ttc")]
        every = [e for e in conditions if (e.places or e.ttc) and e.verb in ("be", "sit", "ttc")]
        if acts and events[0] is acts[0] and len(every) + 1 == len(events) > 2 and acts[0].begins:
            acts[0].mode = "main"
            return
        if acts and len(conditions) == 1 and events[0] is acts[0] and acts[0].verb in INSTANT:
            rest = events[1:]
            if rest and all(each in states and not each.initial for each in rest) and not acts[0].to_speed:
                for event in rest:
                    event.mode = "when"  # "When the hero starts to brake, it is 30 m from the conflict point"
                acts[0].mode = "main"
            return
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

    def _one_moment(self, events: list[Event]) -> None:
        """Refuse "When A, the hero goes when B": two moments in one sentence."""
        self._later_moments(events)
        groups, inside = 0, False
        for event in events:
            condition = event.mode == "when" and not self._is_marker(event)
            acts = event.mode == "main" and event.actor == HERO_ID and event.verb in (*SLOWING, *SPEEDING, *GOALS)
            if condition and not inside:
                groups, inside = groups + 1, True
                if groups > 1:
                    raise self._refuse("there is a second trigger", event.span, "one trigger", "join them with 'and'")
            elif acts:
                inside = False

    def _later_moments(self, events: list[Event]) -> None:
        """Let "stops ... and moves on once the ego has passed" be bound by the ego, and no second trigger."""
        slowed = bool(self.facts.phases)
        for before, event in pairwise(events):
            slowed |= before.mode == "main" and before.actor == HERO_ID and before.verb in SLOWING
            goes = before.mode == "main" and before.actor == HERO_ID and before.verb in (*SPEEDING, *GOALS, "keep")
            bound = event.mode == "when" and event.actor == EGO_ID and event.verb in GOALS and event.links == ["when"]
            triggered = bool(self.facts.trigger) or any(e.mode == "when" for e in events[: events.index(event)])
            if slowed and goes and bound and triggered and not event.places and not event.negated:
                event.mode = "after"

    def _join_conditions(self, events: list[Event]) -> None:
        """Let "the hero is 20 m behind the conflict point when the ego is ..." tell of one moment."""
        conditions = [event for event in events if event.mode == "when" and not self._is_marker(event)]
        if not conditions:
            return
        self._relative_conditions(events)
        for event, following in pairwise([*events, None]):
            if event is None:
                break
            told = event.mode == "main" and event.verb in (*TELLING, "ttc") and "that" not in event.links
            placed = any(isinstance(place.target, str) or place.amount is not None for place in event.places)
            told = told and not self._is_action(event, True) and (placed or not event.places)
            if not told or event.initial or event.negated:
                continue
            if following is not None and following.links == ["when"] and (event.places or event.speed or event.ttc):
                event.mode = "when"
            elif self._said_in_passing(event, following, conditions):
                event.mode = "when"  # "When the ego is there, the hero, 30 m from the conflict point, brakes"
            elif event.places:
                raise self._refuse(
                    "it is not clear whether this holds at the start or at the trigger",
                    event.span,
                    "'initially', or the words inside the 'when' clause",
                )

    def _relative_conditions(self, events: list[Event]) -> None:
        """Let relative clauses beside a trigger tell of it; refuse those in the past."""
        for event in filter(self._told_relatively, events):
            if {"was", "were"} & set(event.span.excerpt(self.text).lower().split()):
                raise self._refuse(
                    "it is not clear whether this was so at the start or is so at the trigger",
                    event.span,
                    "'is', or 'was initially'",
                )
            event.mode = "when"

    @staticmethod
    def _told_relatively(event: Event) -> bool:
        """Whether "the car, which is 11 m behind it (at that moment), brakes" tells of the moment of its sentence."""
        amounts = [place for place in event.places if place.amount is not None or isinstance(place.target, str)]
        fast = event.speed is not None and not (event.areas or event.headings)  # with a way it is told of the start
        states = event.verb in ("be", "sit", "ttc", "drive", "approach") and bool(amounts or event.ttc or fast)
        plain = event.mode == "main" and not (event.initial or event.negated or event.wanted)
        return "that" in event.links and states and plain

    @staticmethod
    def _said_in_passing(event: Event, following: Event | None, conditions: list[Event]) -> bool:
        """Whether a place of the vehicle that then acts is told between its name and its verb, once the moment is."""
        elsewhere = any(each.actor == event.actor and each.places for each in conditions)
        acts = following is not None and following.resumed and following.verb in (*SLOWING, *SPEEDING)
        acts = acts and following is not None and following.actor == event.actor
        return acts and event.actor == HERO_ID and not elsewhere and len(event.places) == 1 and not event.speed

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
            if "within" in event.notes and event.mode != "when":
                raise self._refuse(
                    "this gives a bound, not a value",
                    event.span,
                    "an exact distance, or one 'gets within' after 'when'",
                )
            if "within" in event.notes:
                said = f"'{event.span.excerpt(self.text)}' is the moment at which it is at that very distance"
                self.facts.assumptions.append(said)
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
        self._one_place_each(conditions[-1])

    def _one_place_each(self, last: Event) -> None:
        """Refuse a moment at which one vehicle has two places and the other has none: one of them is the other's."""
        placed = [each for each in self.facts.trigger if each.place is not None]
        marks = {each.actor: [e for e in placed if e.actor == each.actor] for each in placed}
        if len(marks) == 1 and len(placed) > 1 and all(isinstance(e.place and e.place.target, str) for e in placed):
            raise self._refuse(
                "one vehicle is said to be at two places, and the other at none",
                last.span,
                "one place for each vehicle",
                "name the vehicle that each distance is of",
            )

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
        elif event.verb in ("reach", "pass") and found:
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

    def _is_action(self, event: Event, reacts: bool) -> bool:
        if event.wanted or event.initial:
            return event.verb in (*SLOWING, "accelerate")
        if event.verb in (*SLOWING, "accelerate", "keep", "pass", "complete", "reach", "enter"):
            return True
        if event.verb == "go":
            return reacts or not (event.direction or event.headings or event.areas)
        if event.gerund and event.verb in ("turn", "pull_out") and not self.facts.phases and self._acts_after(event):
            return False  # "a coupe in the driveway, turning right, brakes when ..."
        later = bool(self.facts.phases) and bool({"then", "then_label"} & set(event.links))
        if event.verb in ("turn", "pull_out"):
            return (reacts and not self._told_before(event)) or later
        if event.verb == "leave":
            return event.landmark is not None
        turned = bool(self.facts.phases) and self.facts.phases[-1].kind == "turn"
        if event.verb in ("lane_follow", "drive"):
            return turned and (event.speed is not None) and (later or event.begins or reacts)
        if event.verb == "wait":
            return bool(self.facts.phases) or (reacts and not event.gerund and self._comes_to_wait(event))
        return False

    def _acts_after(self, event: Event) -> bool:
        """Whether the same vehicle brakes, stops or yields right after this, in the same sentence."""
        at = next(index for index, each in enumerate(self.sentence) if each is event)
        following = self.sentence[at + 1] if at + 1 < len(self.sentence) else None
        return following is not None and following.actor == event.actor and following.verb in SLOWING

    def _comes_to_wait(self, event: Event) -> bool:
        """Whether "waits" is what the hero does at its moment, and no state that it is in all along."""
        before = self.sentence[: self.sentence.index(event)]
        reaction = any(each.mode == "when" for each in before) and not event.areas
        return bool(event.places) or (reaction and "that" not in event.links)

    def _told_before(self, event: Event) -> bool:
        """Whether this is told on the way to a "when" clause that has a reaction of its own after it."""
        rest = self.sentence[self.sentence.index(event) + 1 :]
        condition = next((e for e in rest if e.mode == "when"), None)
        if condition is None or not {"comma", "and"} & set(condition.links):
            return False
        after = rest[rest.index(condition) :]
        return any(e.mode == "main" and e.actor == HERO_ID and e.verb in (*SLOWING, *SPEEDING, *GOALS) for e in after)
