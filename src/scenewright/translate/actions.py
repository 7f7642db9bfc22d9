"""Reads what the hero does from its trigger on, phase by phase, and who comes first.

What enters: events that are actions. What leaves: phases and the order in `Facts`; contradictions are refused.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.descriptions import DescriptionReader
from scenewright.translate.events import HERO_ID, Event, Place, goes_on
from scenewright.translate.facts import Condition, LaneRelation, Order, Phase

SLOWING = ("brake", "stop", "yield")
SPEEDING = ("accelerate", "go")
GOALS = ("pass", "reach", "complete", "enter", "leave")
EDGE = {("enter", "intersection"): "junction_start", ("leave", "intersection"): "junction_end"}


@dataclass(slots=True)
class ActionReader(DescriptionReader):
    """Collects what the hero does."""

    def _action(self, event: Event) -> None:
        if event.verb in SLOWING:
            phase = self._slowing(event)
        elif event.verb in (*SPEEDING, "keep"):
            phase = self._speeding(event)
        elif event.verb in GOALS:
            phase = self._goal(event)
        elif event.verb in ("turn", "pull_out"):
            phase = self._turning(event)
        elif event.verb == "wait":
            if not self.facts.phases:  # "when ..., the car waits just before the stop line": it comes to a stop there
                self.facts.phases.append(Phase("dec", []))
                self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}': the hero stops there")
            phase = self._waiting(event)
        else:
            phase = self.facts.phases[-1]
            if phase.to_speed is not None:
                raise self._refuse("two target speeds are given", event.span)
            phase.to_speed, event.speed = event.speed, None
            for heading in [h for h, _ in event.headings] + [area.heading for area in event.areas if area.heading]:
                self._wish(HERO_ID, "destination_heading", heading, event)
            for area in event.areas:
                self._wish(HERO_ID, "destination_kind", "driveway" if area.kind == "driveway" else "road", event)
            phase.events.append(event)
        self._check_spent(event, phase)
        for relation in event.relations:
            self.facts.relations.append(LaneRelation(relation[0], relation[1], event))
        if self.pending_before is not None and phase.kind != "dec":
            before, self.pending_before = self.pending_before, None
            self._set_order(Order(True, self._ego_landmark(before), before))
        if phase.kind == "acc" or phase.kind == "go":
            self._apply_release(phase)
        self._beats(event, phase)
        if event.in_front and self.facts.order is None and phase.kind in ("acc", "go", "turn"):
            assumed = f"'{event.span.excerpt(self.text)}': the hero passes the conflict point before the ego does"
            self.facts.assumptions.append(assumed)
            if phase.goal is None:
                phase.goal, phase.goal_event, phase.goal_assumed = "conflict_point", event, assumed
            self.facts.order, self.order_assumed = Order(True, "conflict_point", event), True

    def _slowing(self, event: Event) -> Phase:
        if self._tells_when(event):
            self.facts.phases[0].events.append(event)
            return self.facts.phases[0]
        if self.facts.phases and self.facts.phases[-1].kind != "dec" and self.facts.phases[-1].kind != "turn":
            raise self._refuse("the hero cannot slow down after it has gone", event.span, "slow down first, then go")
        merge = bool(self.facts.phases) and self.facts.phases[-1].kind == "dec"
        if not merge:
            self.facts.phases.append(Phase("dec", []))
        phase = self.facts.phases[-1]
        if phase.to_stop and "then" in event.links:
            raise self._refuse("the hero has stopped already", event.span, "what it does after its stop")
        phase.events.append(event)
        phase.to_stop |= event.to_stop or event.verb in ("stop", "yield")
        if event.duration is not None and (event.to_stop or event.verb == "stop") and phase.wait is None:
            phase.wait, event.duration = event.duration, None  # "stops there for 3 s"
        phase.yields |= event.verb == "yield"
        if "let" in event.notes and event.landmark is not None:
            self._let_reach(event.landmark, event)
        if event.verb == "yield" and not event.places and not event.rate and "as_if" in event.links:
            self._note(event, "the hero gives way")
        for place in event.places:
            begins_there = event.begins and event.verb == "brake" and not event.to_stop and place.amount is not None
            if begins_there and isinstance(place.target, str):  # "starts to brake 15 m before the conflict point"
                self._begins_at(event, place)
                continue
            if phase.place is not None and _differ(phase.place, place):
                raise self._refuse(
                    "two different places to stop are given",
                    place.span,
                    phase.place.span.excerpt(self.text),
                    "give one",
                )
            phase.place, phase.place_event = place, event
        if event.rate is not None:
            if phase.rate is not None and phase.rate.term != event.rate.term:
                raise self._refuse("two different rates are given", event.rate.span)
            phase.rate, phase.rate_event = event.rate, event
        if event.to_speed is not None:
            if event.to_stop:
                raise self._refuse("a stop and a speed to slow down to contradict each other", event.to_speed.span)
            phase.to_speed = event.to_speed
        return phase

    def _begins_at(self, event: Event, place: Place) -> None:
        """Let the place at which the hero begins to brake be its place at the trigger."""
        condition = Condition(HERO_ID, event, place=place)
        if len(self.facts.phases) > 1:
            raise self._refuse("there is a second trigger", place.span, "one trigger")
        self._no_second_place(condition, self.facts.trigger)
        self.facts.trigger.append(condition)

    def _tells_when(self, event: Event) -> bool:
        """Whether "The van begins to brake when ..." only tells when what was told before begins."""
        here = [id(each) for each in self.sentence]
        told_now = bool(self.facts.trigger) and all(id(each.event) in here for each in self.facts.trigger)
        plain = not (event.places or event.rate or event.to_speed or event.to_stop or event.duration or event.to_actor)
        kinds = [phase.kind for phase in self.facts.phases]
        return told_now and plain and event.verb == "brake" and kinds in (["dec", "acc"], ["dec", "go"])

    def _let_reach(self, landmark: str, event: Event) -> None:
        """Note the moment of the ego that the hero lets it reach."""
        known = self.facts.let_goal
        if known is not None and known[0] != landmark:
            raise self._refuse("two different moments of the ego are asked for", event.span)
        self.facts.let_goal = known or (landmark, event)
        self._note(event, f"the hero lets the ego reach its {landmark.replace('_', ' ')}")

    def _speeding(self, event: Event) -> Phase:
        last = self.facts.phases[-1] if self.facts.phases else None
        moves = last is None and self.facts.standing is None
        on = event.verb == "go" and moves and goes_on(event.span.excerpt(self.text))
        kind = "go" if event.verb == "keep" or on else "acc"
        if event.verb == "accelerate" and last is not None and last.kind == "go" and self._only_goes_on(last):
            last.kind = "acc"  # "drives on, accelerating"
        if last is not None and last.kind == "turn" and self._after_the_turn(event, last):
            last.to_speed, last.events = event.to_speed or last.to_speed, [*last.events, event]
            return last
        if event.verb == "accelerate" and last is not None and last.kind == "go":
            raise self._refuse("the hero cannot keep its speed and speed up", event.span)
        if last is not None and last.kind == "turn" and event.to_speed is not None and self._turned_before(event):
            last.to_speed = event.to_speed  # "After completing its turn it speeds up to 10 m/s"
            last.events.append(event)
            return last
        if last is not None and last.kind == "turn" and kind == "acc" and last.to_speed is None:
            last.kind = "acc"  # "pulls out, accelerating to complete its turn"
            if last.goal is None:
                assumed = f"'{last.events[0].span.excerpt(self.text)}' is done when the turn is complete"
                self.facts.assumptions.append(assumed)
                last.goal, last.goal_event, last.goal_assumed = "turn_end", last.events[0], assumed
        sped = last is not None and any(each.verb in ("accelerate", "go") for each in last.events)
        if last is not None and last.kind == "acc" and kind == "go" and len(self.facts.phases) == 1:
            if sped or last.rate is not None:
                raise self._refuse("the hero cannot speed up and keep its speed", event.span)
            last.kind = "go"  # "passes the conflict point first, keeping its speed"
        if last is not None and last.kind in ("acc", "go"):
            phase = last
        else:
            phase = Phase("go" if kind == "go" else "acc", [])
            self.facts.phases.append(phase)
            if event.verb == "go" and len(self.facts.phases) == 1:
                self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}' lets the hero speed up")
        phase.events.append(event)
        if event.places:
            raise self._refuse(
                "a place does not belong to speeding up", event.places[0].span, fix="say 'to pass the conflict point'"
            )
        if event.rate is not None:
            phase.rate, phase.rate_event = event.rate, event
        if event.to_speed is not None:
            phase.to_speed = event.to_speed
        return phase

    def _only_goes_on(self, phase: Phase) -> bool:
        """Whether nothing says that the hero keeps its speed: it only "drives on"."""
        return all(each.verb == "go" for each in phase.events) and self.facts.phases == [phase]

    def _turned_before(self, event: Event) -> bool:
        """Whether the hero has turned when this begins: "then", "after its turn"."""
        after = [e for e in self.sentence if e.mode in ("after", "when") and e.actor == HERO_ID]
        return "then" in event.links or any(e.verb in ("complete", "turn") for e in after)

    def _after_the_turn(self, event: Event, turn: Phase) -> bool:
        """Whether this is the drive after the turn: "after completing the turn it speeds up and drives on"."""
        told = any(
            each.actor == HERO_ID and each.verb in ("turn", "complete") and ("after" in each.links or each.perfect)
            for each in self.sentence
        )
        if event.rate is not None or event.places:
            return False
        if event.to_speed is not None:
            return (told or "then" in event.links) and turn.to_speed is None
        return event.verb in ("go", "keep") and turn.to_speed is not None

    def _goal(self, event: Event) -> Phase:
        last = self.facts.phases[-1] if self.facts.phases else None
        slowed_there = last is not None and last.kind == "dec" and last.to_speed is not None and last.place is not None
        if last is not None and slowed_there and last.place and last.place.target == event.landmark:
            last.events.append(event)  # "slows to 2 m/s by the conflict point, and it gets there after the ego"
            last.goal = event.landmark
            return last
        if last is not None and self._slows_there(event, last):
            return last
        if last is not None and last.kind in ("acc", "go", "turn"):
            phase = last
        else:
            phase = Phase("acc", [])
            self.facts.phases.append(phase)
            if last is None:
                self.facts.assumptions.append(f"the hero may speed up to do so: '{event.span.excerpt(self.text)}'")
        if last is not None and last.kind == "dec" and "to" in event.links:
            raise self._refuse("the hero cannot slow down to do this", event.span, "accelerates to pass ...")
        phase.events.append(event)
        if event.speed is not None and event.verb in ("pass", "reach") and phase.to_speed is None:
            phase.to_speed, event.speed = event.speed, None  # "reaches the conflict point at 12 m/s"
        if event.verb == "complete":
            goal = "turn_end"
            self._until_it_turns(event)
            self._tell_route(event)
        elif event.landmark is None:
            if len(event.places) == 1 and event.places[0].relation == "at" and isinstance(event.places[0].target, str):
                goal = event.places[0].target
            elif event.verb == "pass" and not event.places:
                phase.goal_assumed = f"'{event.span.excerpt(self.text)}': it passes the conflict point"
                self.facts.assumptions.append(phase.goal_assumed)
                goal = phase.goal or "conflict_point"
            else:
                raise self._refuse("it is not said what the hero passes", event.span, "the conflict point")
        else:
            goal = EDGE.get((event.verb, event.landmark), event.landmark)
            if event.places:
                raise self._refuse("two places are given", event.places[0].span)
        if phase.goal_assumed is not None and phase.goal not in (None, goal):
            self._set_order_goal(phase, goal)
        if phase.goal is not None and phase.goal != goal:
            raise self._refuse("two different places to pass are given", event.span)
        if phase.kind == "turn" and goal != "turn_end" and phase.events[0].verb == "pull_out":
            phase.kind = "acc"  # "accelerates out of the driveway and passes the conflict point"
        phase.goal, phase.goal_event = goal, event
        return phase

    def _slows_there(self, event: Event, last: Phase) -> bool:
        """Read "decelerates. It arrives at the conflict point with a speed of 15 mph": where it is how slow."""
        free = last.kind == "dec" and not last.to_stop and last.to_speed is None and last.place is None
        if not free or event.speed is None or event.verb not in ("pass", "reach") or "then" in event.links:
            return False
        places = list(event.places)
        if event.landmark is not None:
            places.append(Place("at", event.landmark, None, event.span))
        if len(places) != 1 or not isinstance(places[0].target, str):
            return False
        last.to_speed, event.speed = event.speed, None
        last.place, last.place_event = places[0], event
        last.events.append(event)
        if places[0].relation == "at":
            last.goal, last.goal_event = places[0].target, event
        return True

    def _set_order_goal(self, phase: Phase, goal: str) -> None:
        """Forget where the hero comes first by default: it is said now ("goes first and completes its turn")."""
        self.facts.assumptions = [each for each in self.facts.assumptions if each != phase.goal_assumed]
        phase.goal, phase.goal_event, phase.goal_assumed = goal, None, None
        self.order_assumed = self.facts.order is not None

    def _until_it_turns(self, event: Event) -> None:
        """Let a hero that "drives straight" at first turn later: that was its motion, not its intent."""
        wishes = self.facts.wishes[HERO_ID]
        said = wishes.get("turn")
        if said is None or said.value != "straight" or said.event.wanted or event.direction is None:
            return
        for key in ("turn", "destination_kind", "destination_heading"):
            if key in wishes and wishes[key].event is said.event:
                del wishes[key]
        self.facts.assumptions.append(f"'{said.event.span.excerpt(self.text)}' holds until the hero turns")

    def _turning(self, event: Event) -> Phase:
        self._until_it_turns(event)
        self._tell_route(event)
        last = self.facts.phases[-1] if self.facts.phases else None
        if event.places or event.rate or event.to_speed:
            raise self._refuse("a turn takes no place or rate of its own", event.span)
        pulled_out = last is not None and last.kind == "turn" and last.events[-1].verb == "pull_out"
        if last is not None and pulled_out and event.verb == "turn" and "then" not in event.links:
            last.events.append(event)  # "pulls out and turns right"
            return last
        if last is not None and last.kind == "acc" and last.goal == "turn_start":
            last.kind, last.goal = "turn", None  # "arrives at the mouth of the driveway and turns left"
            self.facts.assumptions = [each for each in self.facts.assumptions if "may speed up" not in each]
            last.events.append(event)
            return last
        if last is not None and last.kind in ("acc", "go") and last.goal is None:
            assumed = f"'{event.span.excerpt(self.text)}' is done when the turn is complete"
            self.facts.assumptions.append(assumed)
            last.goal, last.goal_event, last.goal_assumed = "turn_end", event, assumed
            last.events.append(event)
            return last
        if last is not None and last.kind == "dec" and last.to_stop:  # "stops, then pulls out and turns right"
            assumed = f"'{event.span.excerpt(self.text)}' is done when the turn is complete"
            self.facts.assumptions.append(assumed)
            self.facts.phases.append(Phase("acc", [event], goal="turn_end", goal_event=event, goal_assumed=assumed))
            return self.facts.phases[-1]
        if last is not None:
            raise self._refuse("a turn cannot follow this", event.span)
        phase = Phase("turn", [event])
        self.facts.phases.append(phase)
        return phase

    def _waiting(self, event: Event) -> Phase:
        phase = self.facts.phases[-1]
        if phase.kind != "dec":
            raise self._refuse("the hero can wait only after it has stopped", event.span)
        for place in event.places:
            if phase.place is not None and _differ(phase.place, place):
                raise self._refuse("two different places to stop are given", place.span)
            phase.place, phase.place_event = place, event
        if phase.to_speed is not None:
            raise self._refuse("a hero that slows to a speed does not stand", event.span, "a stop, or a speed")
        phase.to_stop = True
        if event.duration is not None:
            if phase.wait is not None and phase.wait.term != event.duration.term:
                raise self._refuse("two times of waiting are given", event.span)
            phase.wait = event.duration
        phase.events.append(event)
        self._note(event, "the hero stands still")
        return phase

    def _ego_landmark(self, event: Event) -> str:
        at = event.places[0] if len(event.places) == 1 else None
        if event.verb == "be" and at is not None and at.relation == "at" and isinstance(at.target, str):
            return at.target  # "before the ego is at the conflict point"
        if event.verb in ("reach", "pass") and event.landmark is None and not event.places:
            self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}': at the conflict point")
            return "conflict_point"
        if event.verb in ("pass", "reach", "enter", "leave") and event.landmark:
            return EDGE.get((event.verb, event.landmark), event.landmark)
        if event.verb in ("turn", "pull_out", "complete") and not event.places:
            if event.verb == "complete" or (event.perfect and not event.begins):
                return "turn_end"  # "until the ego has turned"
            if not event.begins:
                self.facts.assumptions.append(
                    f"'{event.span.excerpt(self.text)}' is the moment at which the ego begins to turn"
                )
            return "turn_start"
        raise self._refuse(
            f"'{event.span.excerpt(self.text)}' is not a moment of the ego that can be compared",
            event.span,
            "the ego passes the conflict point, begins to turn, or completes its turn",
        )

    def _set_order(self, order: Order) -> None:
        if self.order_assumed and self.facts.order is not None and self.facts.order.hero_first == order.hero_first:
            self.facts.order, self.order_assumed = None, False
        if self.facts.order is not None and (self.facts.order.ego_landmark, self.facts.order.hero_first) != (
            order.ego_landmark,
            order.hero_first,
        ):
            raise self._refuse("two different orders are asked for", order.event.span)
        self.facts.order = self.facts.order or order
        told = [event for phase in self.facts.phases for event in phase.events if "as_if" not in event.links]
        if order.hero_first and any("let" in event.notes for event in told):
            raise self._refuse("the hero lets the ego go and also comes first", order.event.span)
        who = "the hero comes first" if order.hero_first else "the ego comes first"
        self._note(order.event, f"{who}; the ego's moment is {order.ego_landmark.replace('_', ' ')}")

    def _apply_release(self, phase: Phase, *, at_start: bool = True) -> None:
        if not self.pending_release:
            return
        event = self.pending_release.pop()
        if phase.kind == "dec" or self.facts.phases[0] is phase:
            raise self._refuse("the hero cannot wait for this before its trigger", event.span)
        self._set_order(Order(False, self._ego_landmark(event), event, at_start=at_start))

    def _beats(self, event: Event, phase: Phase) -> None:
        """Read "goes first", "passes the conflict point before the ego" and "... after the ego"."""
        if event.after_actor is not None:
            self._comes_second(event, phase)
            return
        if not event.first and event.than_actor is None:
            return
        if event.than_actor == HERO_ID:
            raise self._refuse("the hero cannot come before itself", event.span)
        if phase.goal in ("turn_end", "turn_start") or phase.kind == "turn" or (phase.kind == "dec" and not phase.goal):
            raise self._refuse(
                "it is not clear which moment of the ego this is before",
                event.span,
                "before the ego passes the conflict point",
            )
        goal = phase.goal or "conflict_point"
        assumed = f"'{event.span.excerpt(self.text)}': the hero passes the {goal.replace('_', ' ')} before the ego does"
        self.facts.assumptions.append(assumed)
        phase.goal_assumed = assumed if phase.goal is None else phase.goal_assumed
        phase.goal, phase.goal_event = goal, phase.goal_event or event
        self._set_order(Order(True, goal, event))
        self.order_assumed = phase.goal_assumed is not None

    def _comes_second(self, event: Event, phase: Phase) -> None:
        """Read "passes the conflict point after the ego" and "goes after the ego"."""
        if event.after_actor == HERO_ID:
            raise self._refuse("the hero cannot come after itself", event.span)
        if phase.kind == "turn" or (phase.kind == "dec" and not phase.goal):
            raise self._refuse("it is not clear which moment of the ego this is after", event.span)
        starts = (
            event.verb in SPEEDING and phase.goal is None and [p.kind for p in self.facts.phases] == ["dec", phase.kind]
        )
        goal = phase.goal or "conflict_point"
        self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}': the ego passes the conflict point first")
        if phase.goal is None and not starts:
            phase.goal, phase.goal_event = goal, event
        self._set_order(Order(False, "conflict_point", event, at_start=starts))

    def _check_spent(self, event: Event, phase: Phase) -> None:
        """Refuse what an action says but no phase holds."""
        if event.speed is not None or (event.duration is not None and event.verb != "wait"):
            raise self._refuse("this amount does not belong to what the hero does", event.span)
        if event.to_stop and phase.kind != "dec":
            raise self._refuse("the hero cannot stop here", event.span)
        if event.verb not in ("turn", "pull_out", "lane_follow", "drive", "complete"):
            for area in event.areas:
                self._tell_area(HERO_ID, area, event, True)
            for heading, span in event.headings:
                if span.start <= event.span.start:
                    self._wish(HERO_ID, "origin_heading", heading, event)
                else:
                    raise self._refuse("a heading does not belong to what the hero does", span)


def _differ(first: Place, second: Place) -> bool:
    amounts = [place.amount.term if place.amount else None for place in (first, second)]
    return (first.target, first.relation, amounts[0]) != (second.target, second.relation, amounts[1])
