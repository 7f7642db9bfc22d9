"""Reads how what the hero does turns out: what it lets the ego do, what it does not do until later, where it arrives.

What enters: events of main clauses. What leaves: phases, the ego's moment and the order in `Facts`.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.actions import GOALS, ActionReader
from scenewright.translate.events import EGO_ID, HERO_ID, Event, Place
from scenewright.translate.facts import Order, Phase

_STARTS = ("go", "drive", "accelerate", "keep", "pull_out", "turn", "complete", "pass")
_MOMENTS = ("turn_end", "conflict_point", "intersection", "junction_end")


@dataclass(slots=True)
class OutcomeReader(ActionReader):
    """Collects outcomes."""

    # -- what the ego is let do -------------------------------------------------------------------------------------
    def _is_let(self, event: Event) -> bool:
        """Read "so that the ego can complete its turn" after a stop of the hero: the ego's moment is its aim."""
        phase = self.facts.phases[-1] if self.facts.phases else None
        if phase is None or phase.kind != "dec" or not (phase.to_stop or phase.to_speed) or event.mode != "main":
            return False
        if event.verb not in GOALS or event.negated or event.begins or event.areas or event.places:
            return False
        beside = any(each.actor == HERO_ID and each.mode == "main" for each in self.sentence)
        if "modal" not in event.notes and (not beside or "then" in event.links):
            return False  # "The ego then passes" tells the ego what to do
        if event.than_actor is not None or event.after_actor is not None or event.speed:
            return False
        if event.verb == "pass" and event.landmark is None:
            self._note(event, "the hero gives way")
            return True
        if event.span.excerpt(self.text).lower().startswith(("it ", "he ", "she ")):
            return False  # who is meant is too unsure
        landmark = self._ego_landmark(event)
        if landmark not in _MOMENTS:
            return False
        self._tell_route(event)
        self._let_reach(landmark, event)
        return True

    def _let_go_first(self) -> None:
        """Let a hero that "lets the ego pass, then continues" go on only when the ego has passed."""
        let = [event for phase in self.facts.phases for event in phase.events if "let" in event.notes]
        aim = self.facts.let_goal
        if aim is not None:
            let.append(aim[1])
        order = self.facts.order
        if aim is not None and order is not None and (order.hero_first or order.ego_landmark != aim[0]):
            raise self._refuse(
                "two different moments of the ego are asked for",
                aim[1].span,
                f"one, as in '{order.event.span.excerpt(self.text)}'",
            )
        kinds = [phase.kind for phase in self.facts.phases]
        if let and order is None and kinds in (["dec", "acc"], ["dec", "go"]):
            self._set_order(Order(False, aim[0] if aim else "conflict_point", let[0], at_start=True))

    # -- what does not happen yet -----------------------------------------------------------------------------------
    def _holds(self, event: Event) -> bool:
        """Read "does not move again until the ego has passed": it stands until then, and then goes."""
        phase = self.facts.phases[-1] if self.facts.phases else None
        plain = not (event.places or event.rate or event.speed or event.to_speed or event.areas)
        if event.actor != HERO_ID or event.verb not in _STARTS or phase is None or phase.kind != "dec" or not plain:
            return False
        at = self.sentence.index(event) + 1
        bound = self.sentence[at] if at < len(self.sentence) else None
        if bound is None or bound.actor != EGO_ID or bound.mode not in ("until", "before"):
            return False
        if phase.to_speed is not None or bound.negated:
            return False
        bound.mode = "until"
        phase.to_stop = True
        self.facts.held = event
        self._note(event, "the hero stands until then")
        return True

    def _go_when_released(self) -> None:
        """Let a hero that does not go "until the ego has passed" go then, where no more is said of it."""
        held = self.facts.held
        if held is None or not self.pending_release or self.facts.phases[-1].kind != "dec":
            return
        goal = "turn_end" if held.verb in ("complete", "turn") else held.landmark
        phase = Phase("acc", [held], goal=goal, goal_event=held if goal else None)
        self.facts.phases.append(phase)
        self.facts.assumptions.append(f"'{held.span.excerpt(self.text)}': it goes on after that")
        self._apply_release(phase)

    def _rests(self, event: Event) -> bool:
        """Read "after standing there for 2 s": how long the stop lasts."""
        phase = self.facts.phases[-1] if self.facts.phases else None
        rests = event.verb in ("wait", "stop") and not (event.places or event.rate or event.areas or event.speed)
        if event.actor != HERO_ID or not rests or phase is None or phase.kind != "dec" or not phase.to_stop:
            return False
        if event.duration is None:
            return False
        if phase.wait is not None:
            raise self._refuse("two times of waiting are given", event.span)
        phase.wait = event.duration
        phase.events.append(event)
        self._note(event, "the hero stands still")
        return True

    # -- where it arrives, and how ----------------------------------------------------------------------------------
    def _arrives(self, event: Event) -> bool:
        """Read "is at the conflict point before the ego reaches it" after an action as reaching that place."""
        last = self.facts.phases[-1] if self.facts.phases else None
        if event.actor != HERO_ID or event.verb not in ("be", "sit", "drive") or last is None or event.initial:
            return False
        place = event.places[0] if len(event.places) == 1 else None
        if place is None or place.relation != "at" or not isinstance(place.target, str) or place.vague:
            return False
        ordered = event.than_actor is not None or event.after_actor is not None or event.first
        at = self.sentence.index(event) + 1
        bound = at < len(self.sentence) and self.sentence[at].mode in ("before", "after")
        if event.mode != "main" or last.kind == "dec" or not (ordered or bound or event.speed is not None):
            return False
        event.verb, event.landmark, event.places = "reach", place.target, []
        return True

    def _slow_until(self, event: Event) -> bool:
        """Read "brakes until its speed is 3 m/s"."""
        phase = self.facts.phases[-1] if self.facts.phases else None
        only_speed = event.verb in ("be", "drive", "go") and event.speed is not None and not (event.places or event.ttc)
        if event.actor != HERO_ID or not only_speed or phase is None or phase.kind not in ("dec", "acc"):
            return False
        if phase.to_speed is not None or phase.to_stop:
            return False
        phase.to_speed, event.speed = event.speed, None
        phase.events.append(event)
        return True

    def _slow_by_then(self, event: Event) -> bool:
        """Read "slows to 2 m/s by the time it is at the conflict point": where it has that speed."""
        phase = self.facts.phases[-1] if self.facts.phases else None
        if event.actor != HERO_ID or "by_then" not in event.links or phase is None or event.negated:
            return False
        if phase.kind != "dec" or phase.to_speed is None or phase.place is not None:
            return False
        place = event.places[0] if len(event.places) == 1 and event.verb in ("be", "sit") else None
        if place is None and event.verb in ("reach", "pass") and event.landmark is not None and not event.places:
            place = Place("at", event.landmark, None, event.span)
        if place is None or not isinstance(place.target, str) or event.speed is not None:
            return False
        phase.place, phase.place_event = place, event
        phase.events.append(event)
        return True

    def _slow_when_there(self, events: list[Event]) -> bool:
        """Read "By the time it is 10 m from the conflict point its speed is down to 5 m/s" after it began to brake."""
        phase = self.facts.phases[-1] if self.facts.phases else None
        if phase is None or len(events) != 2 or not {"by_then", "when"} <= set(events[0].links):
            return False
        there, slow = events
        free = phase.kind == "dec" and not phase.to_stop and phase.to_speed is None and phase.place is None
        told = there.actor == slow.actor == HERO_ID and "and" not in slow.links and not (there.negated or slow.negated)
        speed = slow.speed if slow.verb in ("be", "drive", "go") else slow.to_speed if slow.verb == "brake" else None
        held = slow.places or slow.rate or slow.areas or slow.duration or there.speed or slow.than_actor is not None
        if not free or not told or speed is None or held or slow.to_stop or slow.after_actor is not None:
            return False
        place = there.places[0] if len(there.places) == 1 and there.verb in ("be", "sit", "reach") else None
        if place is None and there.verb in ("reach", "pass") and there.landmark is not None and not there.places:
            place = Place("at", there.landmark, None, there.span)
        if place is None or not isinstance(place.target, str):
            return False
        phase.to_speed, slow.speed, slow.to_speed = speed, None, None
        phase.place, phase.place_event = place, there
        phase.events += events
        return True

    def _keeps_its_speed(self) -> None:
        """Let a hero that passes "without speeding up" drive on at will; refuse it where it is said to speed up."""
        steady = self.facts.steady
        if steady is None:
            return
        last = self.facts.phases[-1] if self.facts.phases else None
        if last is not None and last.kind == "dec" and len(self.facts.phases) == 1:
            return  # "does not speed up but brakes"
        sped = last is not None and any(
            event.verb == "accelerate" or (event.verb == "go" and event.span.start > steady.span.start)
            for event in last.events
        )
        if (
            last is None
            or last.kind not in ("acc", "go")
            or sped
            or last.rate is not None
            or len(self.facts.phases) > 1
        ):
            raise self._refuse(
                "nothing that the hero does fits this", steady.span, "a hero that passes the conflict point"
            )
        last.kind = "go"
        self.facts.assumptions = [each for each in self.facts.assumptions if "may speed up" not in each]
