"""Builds the canonical program from facts and routes, and keeps which clause each constraint came from.

What enters: `Facts`, the two routes, the description. What leaves: a `Program` and the constraint ids of every event.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import TranslationError
from scenewright.program.arithmetic import JUST_BEFORE_M, negate
from scenewright.program.expressions import (
    Arithmetic,
    Compare,
    Elapsed,
    Knot,
    Landmark,
    Number,
    Order,
    ParameterRef,
    PieceRef,
    State,
    Term,
    walk,
)
from scenewright.program.types import Actor, HeadingsRoute, Parameter, PieceKind, Program, Sketch
from scenewright.translate.conditions import ConditionAssembler
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, Event, Place
from scenewright.translate.facts import Condition, Phase
from scenewright.translate.tokens import Quantity

_POSITION: Order = 0
_SPEED: Order = 1
_ACCELERATION: Order = 2
_IN_HASTE = re.compile(r"\b(?:accelerat|dash|dart|rac|rush|shoot|speed|bolt|burst|hurr)", re.IGNORECASE)


@dataclass(slots=True)
class Assembler(ConditionAssembler):
    """Collects constraints in canonical order: initial, trigger, interaction, outcome."""

    def program(self, map_name: str) -> Program:
        """Build the program."""
        for condition in sorted(self.facts.initial, key=_canonical):
            self._add(self._condition(condition, "t0"), condition.event)
        self._check_speeds()
        self._check_passing()
        sketch = self._interaction()
        if self.facts.let_goal is not None and self.facts.order is None:
            landmark, event = self.facts.let_goal
            aim = self._landmark(landmark, EGO_ID, event.span)
            self._add(Compare("==", State(EGO_ID, _POSITION, Knot("t2")), aim), event)
        ego_sketch = Sketch(("t0", "t1", "t2"), (PieceKind.GO, PieceKind.GO))
        actors = tuple(
            Actor(actor, ACTOR_NAMES[actor], HeadingsRoute(self.routes.of(actor).headings), each)
            for actor, each in ((EGO_ID, ego_sketch), (HERO_ID, sketch))
        )
        names = [n.name for c in self.constraints for n in walk(c.formula) if isinstance(n, ParameterRef)]
        parameters = tuple(Parameter(name) for name in dict.fromkeys(names))
        return Program(self.name, actors, tuple(self.constraints), parameters, map_name, self.text)

    def _check_speeds(self) -> None:
        """Refuse "at 45 km/h ... decelerates to 60 km/h": one of the two speeds is a slip."""
        first = next((c.speed for c in self.facts.initial if c.actor == HERO_ID and c.speed is not None), None)
        for phase in self.facts.phases[:1]:
            if first is None or phase.to_speed is None or phase.kind not in ("dec", "acc"):
                continue
            begins, ends = first.term, phase.to_speed.term
            if not (isinstance(begins, Number) and isinstance(ends, Number)):
                continue
            if (begins.value <= ends.value) if phase.kind == "dec" else (begins.value >= ends.value):
                does = "slows down" if phase.kind == "dec" else "speeds up"
                raise self._refuse(f"who {does} does not get to this speed from that", phase.to_speed.span)

    def _check_passing(self) -> None:
        """Refuse a hero that follows the ego all the way and is somewhere before it."""
        follows = next((each for each in self.facts.relations if each.kind == "ego_leads"), None)
        order, same = self.facts.order, self.routes.ego.headings == self.routes.hero.headings
        if follows is not None and order is not None and order.hero_first and same:
            raise self._refuse("who follows in one lane is never first", order.event.span)

    # -- the interaction --------------------------------------------------------------------------------------------
    def _trigger(self) -> None:
        trigger = self.facts.trigger
        events = list({id(c.event): c.event for c in trigger}.values())
        self._add(Compare("==", Elapsed(EGO_ID, "t1"), Elapsed(HERO_ID, "t1")), *events)
        for condition in sorted(trigger, key=_canonical):
            self._add(self._condition(condition, "t1"), condition.event)

    def _interaction(self) -> Sketch:
        phases = self.facts.phases
        kinds = [phase.kind for phase in phases]
        if not self.facts.trigger:
            return self._untriggered(phases)
        if self.facts.standing is not None:
            self._stands_somewhere(self.facts.standing)
        self._trigger()
        if self.facts.standing is not None:
            return self._from_standstill(self.facts.standing, phases)
        if kinds == ["dec"]:
            self._slow(phases[0], "t2")
            if phases[0].goal is not None or (phases[0].to_stop and self.facts.order is not None):
                self._order("t2")
            return _sketch("go dec")
        if kinds in (["dec", "acc"], ["dec", "go"]):
            return self._stop_and_go(phases)
        if kinds in (["acc"], ["go"]):
            self._run(phases[0], "t2", "acc" if kinds == ["acc"] else "go")
            return _sketch("go acc" if kinds == ["acc"] else "go go")
        if kinds[0] == "turn" and kinds in (["turn"], ["turn", "dec"]):
            return self._turning(phases)
        raise self._refuse("this sequence of actions is not supported", phases[0].events[0].span)

    def _stands_somewhere(self, standing: Event) -> None:
        """Put a hero that "waits on the driveway" at its stop line."""
        if any(c.actor == HERO_ID and c.place is not None for c in (*self.facts.initial, *self.facts.trigger)):
            return
        if self.routes.of(HERO_ID).origin_kind != "driveway":
            raise self._refuse("it is not said where the hero stands", standing.span, "12 m before the conflict point")
        self._assume(f"'{standing.span.excerpt(self.text)}': it stands at its stop line")
        place = Landmark("stop_line", span=standing.span)
        self._add(Compare("==", State(HERO_ID, _POSITION, Knot("t0")), place), standing)

    def _from_standstill(self, standing: Event, phases: list[Phase]) -> Sketch:
        """Build the script of a hero that waits for its trigger and then goes."""
        event, phase = phases[0].events[0], phases[0]
        possible = phase.kind == "acc" or (phase.kind == "turn" and phase.to_speed is None)
        if len(phases) > 1 or not possible:
            raise self._refuse(
                "a hero that stands at the start can only go, speed up, turn or pass then",
                event.span,
                "that it turns, or accelerates to pass the conflict point",
            )
        placed = [c for c in (*self.facts.initial, *self.facts.trigger) if c.actor == HERO_ID]
        if any(c.speed is not None for c in placed) or len(placed) > 1:
            raise self._refuse("a hero that stands has one place and no speed", placed[-1].event.span)
        self._add(Compare("==", State(HERO_ID, _SPEED, PieceRef("stop")), Number(Fraction(0))), standing)
        if phase.kind == "turn":
            aim = self._landmark("turn_end", HERO_ID, event.span)
            self._add(Compare("==", State(HERO_ID, _POSITION, Knot("t2")), aim), *phase.events)
            self._order("t2")
        else:
            self._run(phase, "t2", "acc")
        return _sketch("stop acc")

    def _slow(self, phase: Phase, knot: str) -> None:
        event = phase.events[0]
        if phase.rate is not None:
            self._add(
                Compare("==", State(HERO_ID, _ACCELERATION, PieceRef("dec")), _slower(phase.rate)),
                phase.rate_event or event,
            )
        if phase.place is not None:
            self._stop_place(phase.place, phase.place_event or event, knot)
        elif phase.yields and phase.rate is None and phase.to_speed is None:
            raise self._refuse(
                "it is not said where the hero stops to yield", event.span, "such as '5 m behind the conflict point'"
            )
        if phase.to_speed is not None:
            self._add(Compare("==", State(HERO_ID, _SPEED, Knot(knot)), phase.to_speed.term), event)
            return
        if not phase.to_stop:
            if phase.place is not None:
                raise self._refuse(
                    "it is not clear whether the hero begins to brake there or comes to rest there",
                    phase.place.span,
                    "a stop, as in 'brakes to a stop 5 m behind the conflict point'",
                    "put where it begins to brake into the 'when' clause",
                )
            if phase.rate is None:
                raise self._refuse(
                    "it is not said how far the hero slows down", event.span, "to a stop, to a speed, or at a rate"
                )
            self._assume("the hero slows down to a standstill: no other speed was said")
        elif phase.rate is None and phase.place is None:
            self._assume("no rate and no place to stop was said: the solver chooses them")
        self._add(Compare("==", State(HERO_ID, _SPEED, Knot(knot)), Number(Fraction(0))), *phase.events)

    def _stop_place(self, place: Place, event: Event, knot: str) -> None:
        if isinstance(place.target, int):
            if place.amount is None or place.relation not in ("behind", "ahead", "before"):
                raise self._refuse("it is not said how far from the ego the hero stops", place.span)
            raise self._refuse("a stop relative to the ego is not supported", place.span, "a distance to a landmark")
        if place.amount is not None and place.amount.dimension != "length":
            raise self._refuse("a place to stop is given by a distance", place.span, "metres or feet")
        self._add(self._at(place, HERO_ID, knot), event)

    def _run(self, phase: Phase, knot: str, piece: str) -> None:
        event = phase.events[0]
        if phase.rate is not None:
            if piece == "go":
                raise self._refuse("a hero that keeps its speed has no rate", event.span)
            self._add(
                Compare("==", State(HERO_ID, _ACCELERATION, PieceRef("acc")), _faster(phase.rate)),
                phase.rate_event or event,
            )
        goal, goal_event = phase.goal, phase.goal_event or event
        if goal is None and phase.to_speed is None:
            goal = "conflict_point"
            self._assume("the hero goes on to pass the conflict point")
        if goal is not None:
            aim = self._landmark(goal, HERO_ID, goal_event.span)
            self._add(Compare("==", State(HERO_ID, _POSITION, Knot(knot)), aim), goal_event)
        if phase.to_speed is not None:
            self._add(Compare("==", State(HERO_ID, _SPEED, Knot(knot)), phase.to_speed.term), event)
        self._order(knot)

    def _order(self, hero_knot: str, start_knot: str | None = None) -> None:
        order = self.facts.order
        if order is None:
            refused = self.facts.not_yielding
            if refused is None or refused.verb != "yield":
                return
            self._assume("not yielding means that the hero passes the conflict point before the ego does")
            name, event, hero_first, at_start = "conflict_point", refused, True, False
        else:
            name, event, hero_first, at_start = order.ego_landmark, order.event, order.hero_first, order.at_start
        aim = self._landmark(name, EGO_ID, event.span)
        self._add(Compare("==", State(EGO_ID, _POSITION, Knot("t2")), aim), event)
        knot = start_knot if at_start and start_knot is not None else hero_knot
        hero, ego = Elapsed(HERO_ID, knot), Elapsed(EGO_ID, "t2")
        if order is None or order.margin is None or order.margin_bound == "<=":
            self._add(Compare("<" if hero_first else ">", hero, ego), event)
        if order is not None and order.margin is not None:
            ahead = Arithmetic("-", ego, hero) if hero_first else Arithmetic("-", hero, ego)
            self._add(Compare(order.margin_bound, ahead, order.margin.term), event)

    def _slow_and_go_on(self, phases: list[Phase]) -> Sketch | None:
        """Build the sketch of a hero that slows to a speed and goes on at will, "without stopping", to its goal."""
        slow, run = phases
        sped = run.rate is not None or run.to_speed is not None or any(e.verb == "accelerate" for e in run.events)
        refused = self.facts.not_yielding
        unstopped = run.kind == "go" or (refused is not None and refused.verb == "stop")
        at_start = self.facts.order is not None and self.facts.order.at_start
        if slow.to_speed is None or slow.to_stop or slow.wait is not None or sped or not unstopped or at_start:
            return None
        if run.goal is None:
            return None
        self._slow(slow, "t2")
        self._run(run, "t3", "go")
        return _sketch("go dec go")

    def _stop_and_go(self, phases: list[Phase]) -> Sketch:
        if (sketch := self._slow_and_go_on(phases)) is not None:
            return sketch
        if phases[0].to_speed is not None:
            raise self._refuse(
                "the hero slows down but does not stop before it goes", phases[0].events[0].span, "a stop"
            )
        self._slow(phases[0], "t2")
        event = phases[0].events[0]
        self._add(Compare("==", State(HERO_ID, _SPEED, PieceRef("stop")), Number(Fraction(0))), event)
        if phases[0].wait is not None:
            waited = Arithmetic("-", Elapsed(HERO_ID, "t3"), Elapsed(HERO_ID, "t2"))
            self._add(Compare(phases[0].wait_bound, waited, phases[0].wait.term), phases[0].events[-1])
        order = self.facts.order
        if order is not None and order.at_start:
            self._goal_without_order(phases[1])
            self._order("t4", "t3")
        else:
            self._run(phases[1], "t4", "acc")
        return _sketch("go dec stop acc")

    def _goal_without_order(self, phase: Phase) -> None:
        order, self.facts.order = self.facts.order, None
        self._run(phase, "t4", "acc")
        self.facts.order = order

    def _turning(self, phases: list[Phase]) -> Sketch:
        turn, slow = phases[0], phases[1] if len(phases) > 1 else None
        event = turn.events[0]
        placed = any(
            c.actor == HERO_ID and c.place is not None and isinstance(c.place.target, str) for c in self.facts.trigger
        )
        if slow is not None:
            if not placed:
                self._add(
                    Compare("==", State(HERO_ID, _POSITION, Knot("t1")), Landmark("turn", span=event.span)),
                    *turn.events,
                )
            self._slow(slow, "t2")
            return _sketch("go dec")
        if not placed:
            self._add(
                Compare("==", State(HERO_ID, _POSITION, Knot("t1")), self._landmark("turn_start", HERO_ID, event.span)),
                *turn.events,
            )
        self._add(
            Compare("==", State(HERO_ID, _POSITION, Knot("t2")), self._landmark("turn_end", HERO_ID, event.span)),
            *turn.events,
        )
        self._order("t2")
        if turn.to_speed is None:
            return _sketch("go acc" if turn.goal is not None and self._hurries(turn, placed) else "go go")
        # The speed is that of the drive after the turn: it is reached on the road, not in the curve.
        self._add(Compare("==", State(HERO_ID, _SPEED, Knot("t3")), turn.to_speed.term), turn.events[-1])
        return _sketch("go go acc go")

    def _hurries(self, turn: Phase, placed: bool) -> bool:
        """Whether a hero that is to complete its turn speeds up: it darts out, or pulls out from a place given."""
        out = [event for event in turn.events if event.verb == "pull_out"]
        return any(placed or _IN_HASTE.search(event.span.excerpt(self.text)) for event in out)

    # -- without a trigger ------------------------------------------------------------------------------------------
    def _untriggered(self, phases: list[Phase]) -> Sketch:
        """Build the hero's script from the start: it slows from a given speed to a stop at a place, then goes again."""
        speeds = [c for c in self.facts.initial if c.actor == HERO_ID and c.speed is not None]
        slow = phases[0]
        complete = (
            [p.kind for p in phases] == ["dec", "acc"] and speeds and slow.rate is not None and slow.place is not None
        )
        if not complete:
            raise TranslationError(
                "there is no trigger: it is not said when the hero reacts",
                place=ErrorPlace(self.name, self.text, slow.events[0].span),
                found=slow.events[0].span.excerpt(self.text),
                expected="a clause with 'when'",
                fix="add for example 'when the ego is 12 m behind the stop line'",
            )
        waits_at = self._where_the_ego_waits()
        self._slow(slow, "t1")
        event = slow.events[0]
        self._add(Compare("==", State(HERO_ID, _SPEED, PieceRef("stop")), Number(Fraction(0))), event)
        self._add(Compare("==", State(EGO_ID, _POSITION, Knot("t1")), waits_at), event)
        self._add(Compare("==", Elapsed(EGO_ID, "t1"), Elapsed(HERO_ID, "t1")), event)
        self._add(Compare(">", Elapsed(HERO_ID, "t2"), Elapsed(EGO_ID, "t1")), *phases[1].events)
        if phases[1].goal is not None or phases[1].to_speed is None or self.facts.order is not None:
            raise self._refuse("without a trigger only a speed to go back to is supported", phases[1].events[0].span)
        self._add(Compare("==", State(HERO_ID, _SPEED, Knot("t3")), phases[1].to_speed.term), *phases[1].events)
        return _sketch("dec stop acc")

    def _where_the_ego_waits(self) -> Term:
        """Return where the ego is when an untriggered hero has stopped: where it decides, before the ways meet."""
        name = "stop_line" if self.routes.ego.origin_kind == "driveway" else "junction_start"
        self._assume(
            "no trigger was given: the hero slows down from the start, and the ego is 5 m before its "
            f"{'stop line' if name == 'stop_line' else 'junction'} when the hero has stopped"
        )
        return Arithmetic("-", Landmark(name), Number(JUST_BEFORE_M))


def _sketch(pieces: str) -> Sketch:
    kinds = tuple(PieceKind(piece) for piece in pieces.split())
    return Sketch(tuple(f"t{index}" for index in range(len(kinds) + 1)), kinds)


def _canonical(condition: Condition) -> tuple[int, int, str]:
    rank = 0 if condition.place is not None else 1 if condition.ttc is not None else 2
    return condition.actor, rank, str(condition.place.target) if condition.place else ""


def _slower(rate: Quantity) -> Term:
    """Return the signed deceleration; people give its size, or say it negative."""
    if isinstance(rate.term, Number) and rate.term.value < 0:
        return rate.term
    return negate(rate.term, rate.span)


def _faster(rate: Quantity) -> Term:
    return rate.term
