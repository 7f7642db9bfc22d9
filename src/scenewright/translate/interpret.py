"""Turns events into facts, sentence by sentence; refuses contradictions, negations and what no one can orchestrate.

What enters: events with modes. What leaves: `Facts`. It knows no map and builds no formulas.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import groupby

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, Event, Place
from scenewright.translate.facts import Condition, Facts, LaneRelation, Order, Phase, Said, WishKey

SLOWING = ("brake", "stop", "yield")
SPEEDING = ("accelerate", "go")
GOALS = ("pass", "reach", "complete", "enter", "leave")
TELLING = ("be", "sit", "drive", "approach", "lane_follow", "turn", "pull_out", "leave", "wait", "go")
EDGE = {("enter", "intersection"): "junction_start", ("leave", "intersection"): "junction_end"}


@dataclass(slots=True)
class Interpreter:
    """Collects facts from events."""

    text: str
    name: str
    facts: Facts = field(default_factory=Facts)
    pending_before: Event | None = None
    pending_release: list[Event] = field(default_factory=list)

    def run(self, events: list[Event]) -> Facts:
        """Read all events."""
        for _, group in groupby(events, key=lambda event: event.sentence):
            self._sentence(list(group))
        if self.pending_before is not None:
            raise self._refuse("it is not said what comes before this", self.pending_before.span)
        return self.facts

    # -- helpers ----------------------------------------------------------------------------------------------------
    def _refuse(
        self, message: str, span: Span, expected: str | None = None, fix: str | None = None
    ) -> TranslationError:
        return TranslationError(
            message,
            place=ErrorPlace(self.name, self.text, span),
            found=span.excerpt(self.text),
            expected=expected,
            fix=fix,
        )

    def _note(self, event: Event, understood: str) -> None:
        self.facts.understood.setdefault(id(event), []).append(understood)

    def _wish(self, actor: int, key: WishKey, value: str, event: Event) -> None:
        known = self.facts.wishes[actor].get(key)
        if known is not None and known.value != value:
            raise self._refuse(
                f"two things are said about the {ACTOR_NAMES[actor]}'s {key.replace('_', ' ')}: {known.value} and {value}",
                event.span,
                f"{known.value}, as in '{known.event.span.excerpt(self.text)}'",
                "say one of them",
            )
        self.facts.wishes[actor].setdefault(key, Said(value, event))

    # -- sentences --------------------------------------------------------------------------------------------------
    def _sentence(self, events: list[Event]) -> None:
        self._give_subjects(events)
        for event in events:
            if event.actor is None:
                raise self._refuse(
                    "it is not said who does this", event.span, "the ego or the hero", "name the vehicle"
                )
            self.facts.mentioned.add(event.actor)
        conditions = [e for e in events if e.mode == "when" and not self._is_marker(e)]
        self._conditions(conditions, events)
        reacts = bool(conditions)
        for event in events:
            if event.negated:
                self._negated(event)
            elif event.mode == "when":
                if self._is_marker(event):
                    self._marker(event)
            elif event.mode == "before":
                self._before(event)
            elif event.mode == "after":
                self._after(event, events)
            else:
                self._main(event, reacts)

    @staticmethod
    def _give_subjects(events: list[Event]) -> None:
        """Let "After turning right, the car ..." take the subject of the clause that follows."""
        for index, event in enumerate(events):
            if event.gerund and event.mode in ("after", "before") and index == 0:
                following = next((e for e in events[1:] if e.mode == "main"), None)
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

    # -- conditions -------------------------------------------------------------------------------------------------
    def _conditions(self, conditions: list[Event], events: list[Event]) -> None:
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
            if not found:
                raise self._refuse(
                    "this condition has no place, time or speed",
                    event.span,
                    "such as 'the ego is 12 m behind the stop line'",
                )
            self.facts.trigger += found
            self._tell_route(event)

    def _conditions_of(self, event: Event) -> list[Condition]:
        actor = event.actor
        assert actor is not None
        if event.rate or event.to_speed or event.duration or event.first or event.than_actor is not None:
            raise self._refuse("this cannot be a condition", event.span, "a place, a time or a speed")
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
        elif event.verb not in ("be", "sit", "drive", "approach", "ttc", "wait", "lane_follow"):
            raise self._refuse(f"'{event.span.excerpt(self.text)}' is not a moment that can be waited for", event.span)
        if event.verb == "approach" and not found:
            return []
        return found

    def _release(self, conditions: list[Event]) -> None:
        for event in conditions:
            if event.actor != EGO_ID or self.pending_release:
                raise self._refuse("there is a second trigger", event.span, "one trigger")
            self.pending_release.append(event)

    # -- order ------------------------------------------------------------------------------------------------------
    def _ego_landmark(self, event: Event) -> str:
        if event.verb in ("pass", "reach", "enter", "leave") and event.landmark:
            return EDGE.get((event.verb, event.landmark), event.landmark)
        if event.verb in ("turn", "pull_out", "complete") and not event.places:
            if event.verb == "complete":
                return "turn_end"
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
        if self.facts.order is not None and (self.facts.order.ego_landmark, self.facts.order.hero_first) != (
            order.ego_landmark,
            order.hero_first,
        ):
            raise self._refuse("two different orders are asked for", order.event.span)
        self.facts.order = self.facts.order or order
        who = "the hero comes first" if order.hero_first else "the ego comes first"
        self._note(order.event, f"{who}; the ego's moment is {order.ego_landmark.replace('_', ' ')}")

    def _before(self, event: Event) -> None:
        if event.actor == HERO_ID and event.verb in (*SPEEDING, *GOALS) and self.facts.phases:
            self._action(event)  # "stops before accelerating"
            return
        if event.actor != EGO_ID:
            raise self._refuse(
                "the hero's own moment is no bound here",
                event.span,
                "a moment of the ego",
                "say how far before, in metres",
            )
        if not self.facts.phases:
            self.pending_before = event
            return
        self._check_order_phase(event)
        self._set_order(Order(True, self._ego_landmark(event), event))

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
            self.pending_release.append(event)
            if self.facts.phases and self.facts.phases[-1].kind != "dec":
                self._apply_release(self.facts.phases[-1])
        else:
            raise self._refuse("it is not clear what comes after this", event.span)

    @staticmethod
    def _ego_main(events: list[Event]) -> Event | None:
        return next((e for e in events if e.actor == EGO_ID and e.mode == "main" and not e.negated), None)

    def _apply_release(self, phase: Phase) -> None:
        if not self.pending_release:
            return
        event = self.pending_release.pop()
        if phase.kind == "dec" or self.facts.phases[0] is phase:
            raise self._refuse("the hero cannot wait for this before its trigger", event.span)
        self._set_order(Order(False, self._ego_landmark(event), event, at_start=True))

    # -- main clauses -----------------------------------------------------------------------------------------------
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
            return event.direction is None or reacts
        later = bool(self.facts.phases) and bool({"then", "then_label"} & set(event.links))
        if event.verb in ("turn", "pull_out"):
            return reacts or later
        if event.verb == "leave":
            return event.landmark is not None
        turned = bool(self.facts.phases) and self.facts.phases[-1].kind == "turn"
        if event.verb in ("lane_follow", "drive"):
            return turned and (event.speed is not None) and (later or event.begins or reacts)
        if event.verb == "wait":
            return bool(self.facts.phases)
        return False

    def _ego(self, event: Event) -> None:
        allowed = event.verb in TELLING and not (event.rate or event.to_speed or event.duration or event.to_stop)
        ordered = event.verb in ("turn", "pass", "reach", "complete", "enter", "leave")
        if ordered and "only" in event.links or ordered and event.verb != "turn":
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

    # -- descriptions -----------------------------------------------------------------------------------------------
    def _tell(self, event: Event) -> None:
        if (
            event.rate
            or event.to_speed
            or event.duration
            or event.first
            or event.than_actor is not None
            or event.landmark
        ):
            raise self._refuse(f"'{event.span.excerpt(self.text)}' has no meaning here", event.span)
        actor = event.actor
        assert actor is not None
        if "then" in event.links:
            raise self._refuse("this comes 'then', but nothing happens in it", event.span, "an action of the hero")
        self._tell_route(event)
        for place in event.places:
            if isinstance(place.target, int) and place.amount is None:
                self._lead(place, actor, event)
            else:
                self.facts.initial.append(Condition(actor, event, place=place))
        if event.speed is not None:
            self.facts.initial.append(Condition(actor, event, speed=event.speed))
        if event.ttc is not None:
            raise self._refuse(
                "a time to collision belongs into the trigger", event.span, fix="say 'when the time to collision ...'"
            )
        if event.verb == "wait":
            raise self._refuse(
                "a vehicle that stands at the start is not supported", event.span, "a vehicle that drives"
            )

    def _lead(self, place: Place, actor: int, event: Event) -> None:
        kind = {"ahead": "lead", "behind": "lead"}.get(place.relation)
        if kind is None:
            raise self._refuse("it is not said how far", place.span, "a distance")
        self.facts.relations.append(LaneRelation("lead", HERO_ID, event))
        ahead = actor if place.relation == "ahead" else 1 - actor
        if ahead != HERO_ID:
            self.facts.relations[-1] = LaneRelation("same_lane", actor, event)
        self._note(event, f"the {ACTOR_NAMES[ahead]} is ahead in the same lane")

    def _tell_route(self, event: Event) -> None:
        actor = event.actor
        assert actor is not None
        turning = event.verb in ("turn", "pull_out", "complete")
        if event.verb == "lane_follow" or (event.verb == "go" and event.direction == "straight"):
            self._wish(actor, "turn", "straight", event)
        elif event.verb in ("turn", "complete") and event.direction is not None:
            self._wish(actor, "turn", event.direction, event)
        elif event.verb == "drive" and event.direction == "straight" and actor == EGO_ID:
            self._wish(actor, "turn", "straight", event)
        for area in event.areas:
            self._tell_area(actor, area, event, turning)
        for heading, span in event.headings:
            before_verb = bool(event.areas) is False and span.start < event.span.start
            ends = turning and span.start > event.span.start and not before_verb
            self._wish(actor, "destination_heading" if ends else "origin_heading", heading, event)
            if event.verb == "lane_follow":
                self._wish(actor, "destination_heading", heading, event)
        for kind, who, _ in event.relations:
            self.facts.relations.append(LaneRelation(kind, who, event))

    def _tell_area(self, actor: int, area: object, event: Event, turning: bool) -> None:
        from scenewright.translate.events import Area

        assert isinstance(area, Area)
        role = area.role
        if role == "across":
            self.facts.relations.append(LaneRelation("across", actor, event))
            return
        end = "destination" if role == "into" or (turning and role == "on") else "origin"
        if event.verb in ("drive", "approach") and role == "into":
            raise self._refuse("it is not clear whether this is a turn", area.span, "turns left or turns right")
        if area.kind != "lane":
            self._wish(actor, "destination_kind" if end == "destination" else "origin_kind", area.kind, event)
        else:
            self._wish(actor, "destination_kind" if end == "destination" else "origin_kind", "road", event)
        heading = area.heading
        if area.side is not None and area.kind == "driveway":
            opposite = {"N": "S", "S": "N", "E": "W", "W": "E"}
            heading = area.side if end == "destination" else opposite[area.side]
        if heading is not None:
            self._wish(actor, "destination_heading" if end == "destination" else "origin_heading", heading, event)
        if event.verb == "lane_follow" and area.kind == "road":
            self._wish(actor, "destination_kind", "road", event)
        if area.wanted_by is not None:
            self.facts.relations.append(LaneRelation("in_wanted_lane", actor, event))
        if area.oncoming:
            self.facts.relations.append(LaneRelation(f"oncoming_{end}", actor, event))
        elif area.lane_of is not None and area.lane_of != actor:
            self.facts.relations.append(LaneRelation(f"lane_{end}", actor, event))

    # -- the hero's actions -----------------------------------------------------------------------------------------
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

    def _slowing(self, event: Event) -> Phase:
        if self.facts.phases and self.facts.phases[-1].kind != "dec" and self.facts.phases[-1].kind != "turn":
            raise self._refuse("the hero cannot slow down after it has gone", event.span, "slow down first, then go")
        merge = bool(self.facts.phases) and self.facts.phases[-1].kind == "dec"
        if not merge:
            self.facts.phases.append(Phase("dec", []))
        phase = self.facts.phases[-1]
        phase.events.append(event)
        phase.to_stop |= event.to_stop or event.verb in ("stop", "yield")
        phase.yields |= event.verb == "yield"
        if event.verb == "yield" and not event.places and not event.rate and "as_if" in event.links:
            self._note(event, "the hero gives way")
        for place in event.places:
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

    def _speeding(self, event: Event) -> Phase:
        kind = "go" if event.verb == "keep" else "acc"
        last = self.facts.phases[-1] if self.facts.phases else None
        if event.verb == "accelerate" and last is not None and last.kind == "go":
            raise self._refuse("the hero cannot keep its speed and speed up", event.span)
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

    def _goal(self, event: Event) -> Phase:
        last = self.facts.phases[-1] if self.facts.phases else None
        if last is not None and last.kind in ("acc", "go", "turn"):
            phase = last
        else:
            phase = Phase("acc", [])
            self.facts.phases.append(phase)
            if last is None:
                self.facts.assumptions.append(f"the hero may speed up to do so: '{event.span.excerpt(self.text)}'")
        phase.events.append(event)
        if event.verb == "complete":
            goal = "turn_end"
            self._until_it_turns(event)
            self._tell_route(event)
        elif event.landmark is None:
            if len(event.places) == 1 and event.places[0].relation == "at" and isinstance(event.places[0].target, str):
                goal = event.places[0].target
            else:
                raise self._refuse("it is not said what the hero passes", event.span, "the conflict point")
        else:
            goal = EDGE.get((event.verb, event.landmark), event.landmark)
            if event.places:
                raise self._refuse("two places are given", event.places[0].span)
        if phase.goal is not None and phase.goal != goal:
            raise self._refuse("two different places to pass are given", event.span)
        phase.goal, phase.goal_event = goal, event
        return phase

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
        if last is not None and last.kind == "acc" and last.goal == "turn_start":
            last.kind, last.goal = "turn", None  # "arrives at the mouth of the driveway and turns left"
            self.facts.assumptions = [each for each in self.facts.assumptions if "may speed up" not in each]
            last.events.append(event)
            return last
        if last is not None and last.kind in ("acc", "go") and last.goal is None:
            self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}' is done when the turn is complete")
            last.goal, last.goal_event = "turn_end", event
            last.events.append(event)
            return last
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
        phase.to_stop = True
        if event.duration is not None:
            phase.wait = event.duration
        phase.events.append(event)
        self._note(event, "the hero stands still")
        return phase

    def _beats(self, event: Event, phase: Phase) -> None:
        """Read "goes first" and "passes the conflict point before the ego"."""
        if not event.first and event.than_actor is None:
            return
        if event.than_actor == HERO_ID:
            raise self._refuse("the hero cannot come before itself", event.span)
        if phase.goal in ("turn_end", "turn_start") or phase.kind in ("dec", "turn"):
            raise self._refuse(
                "it is not clear which moment of the ego this is before",
                event.span,
                "before the ego passes the conflict point",
            )
        goal = phase.goal or "conflict_point"
        self.facts.assumptions.append(
            f"'{event.span.excerpt(self.text)}': the hero passes the {goal.replace('_', ' ')} before the ego does"
        )
        phase.goal, phase.goal_event = goal, phase.goal_event or event
        self._set_order(Order(True, goal, event))


def _differ(first: Place, second: Place) -> bool:
    amounts = [place.amount.term if place.amount else None for place in (first, second)]
    return (first.target, first.relation, amounts[0]) != (second.target, second.relation, amounts[1])
