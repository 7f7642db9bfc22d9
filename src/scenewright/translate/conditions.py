"""Turns what holds at one moment (a place, a speed, a distance between the vehicles) into constraints.

What enters: `Facts` and the two routes. What leaves: constraints, each with the clause it came from. What the hero does
is decided by `assemble`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.program.expressions import (
    Arithmetic,
    Compare,
    Derived,
    DerivedKind,
    Elapsed,
    Formula,
    Knot,
    Landmark,
    Number,
    Order,
    State,
    Term,
)
from scenewright.program.types import Constraint
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, SAY_IT_ALONE, Event, Place
from scenewright.translate.facts import Condition, Facts
from scenewright.translate.itineraries import Itineraries

_POSITION: Order = 0
_SPEED: Order = 1
_ACCELERATION: Order = 2


@dataclass(slots=True)
class ConditionAssembler:
    """Collects constraints."""

    facts: Facts
    routes: Itineraries
    text: str
    name: str
    constraints: list[Constraint] = field(default_factory=list)
    ids: dict[int, list[str]] = field(default_factory=dict)  # by id() of the event
    assumptions: list[str] = field(default_factory=list)

    # -- helpers ----------------------------------------------------------------------------------------------------
    def _refuse(
        self, message: str, span: Span, expected: str | None = None, fix: str | None = None
    ) -> TranslationError:
        return TranslationError(
            message,
            place=ErrorPlace(self.name, self.text, span),
            found=span.excerpt(self.text),
            expected=expected,
            fix=fix or (None if expected else SAY_IT_ALONE),
        )

    def _add(self, formula: Formula, *events: Event) -> None:
        identifier = f"c{len(self.constraints) + 1}"
        span = events[0].span if events else None
        for event in events:
            span = span.union(event.span) if span else event.span
            self.ids.setdefault(id(event), []).append(identifier)
        self.constraints.append(
            Constraint(identifier, formula, span and span.trimmed(self.text).whole_words(self.text))
        )

    def _landmark(self, name: str, actor: int, span: Span) -> Landmark:
        verb = {"turn_start": "begins", "turn_end": "completes"}.get(name)
        if verb and self.routes.of(actor).turn == "straight":
            raise self._refuse(
                f"the {ACTOR_NAMES[actor]} does not turn, so it never {verb} a turn",
                span,
                "a moment on its own way, such as passing the conflict point",
                "say 'passes the conflict point'",
            )
        return Landmark(name, span=span)

    # -- conditions -------------------------------------------------------------------------------------------------
    def _condition(self, condition: Condition, knot: str) -> Formula:
        actor = condition.actor
        if condition.speed is not None:
            return Compare("==", State(actor, _SPEED, Knot(knot)), condition.speed.term)
        if condition.ttc is not None:
            return self._collision_time(condition, knot)
        if condition.clock is not None:
            return Compare("==", Elapsed(actor, knot), condition.clock.term)
        place = condition.place
        assert place is not None
        if isinstance(place.target, int):
            return self._gap(place, actor, place.target, knot)
        return self._at(place, actor, knot)

    def _collision_time(self, condition: Condition, knot: str) -> Formula:
        assert condition.ttc is not None
        if self.routes.share_approach():
            rear = HERO_ID if any(each.kind == "ego_leads" for each in self.facts.relations) else EGO_ID
            return Compare("==", Derived("ttc", rear, 1 - rear, Knot(knot)), condition.ttc.term)
        whose = ACTOR_NAMES[condition.actor]
        self.assumptions.append(
            f"the time to collision of vehicles that meet is the {whose}'s time to arrival at the conflict point"
        )
        aim = Landmark("conflict_point", span=condition.event.span)
        return Compare("==", Derived("tta", condition.actor, aim, Knot(knot)), condition.ttc.term)

    def _at(self, place: Place, actor: int, knot: str) -> Formula:
        assert isinstance(place.target, str)
        if place.of_whom is not None and place.of_whom != actor:
            raise self._refuse(
                "a distance is measured along a vehicle's own way", place.span, f"a place of the {ACTOR_NAMES[actor]}"
            )
        name = place.target
        of_turn = "turn" in place.span.excerpt(self.text).lower()  # "the start of its turn" is no mouth
        if name == "turn_start" and self.routes.of(actor).turn == "straight" and not of_turn:
            name = "turn"  # the mouth of the driveway, for somebody who drives past it
        if place.vague:
            self._assume("the driveway as a place is where it meets the road ('turn')")
        landmark = self._landmark(name, actor, place.span)
        if place.amount is not None and place.amount.dimension == "time":
            if place.relation == "past":
                raise self._refuse("a time past a place is not supported", place.span, "a time before it")
            return Compare("==", Derived("tta", actor, landmark, Knot(knot)), place.amount.term)
        position = State(actor, _POSITION, Knot(knot))
        return Compare("==", position, self._offset(landmark, place))

    def _offset(self, landmark: Landmark, place: Place) -> Term:
        if place.relation == "at":
            return landmark
        if place.relation == "just_before":
            self._assume("'just before' is 5 m before")
            return Arithmetic("-", landmark, Number(JUST_BEFORE_M))
        assert place.amount is not None
        if place.amount.dimension != "length":
            raise self._refuse("a place to stop is given by a distance", place.span, "metres or feet")
        if place.relation == "ahead":
            self._assume(f"'{place.span.excerpt(self.text)}' is before that place, as seen by who comes near it")
        return Arithmetic("+" if place.relation == "past" else "-", landmark, place.amount.term)

    def _assume(self, sentence: str) -> None:
        if sentence not in self.assumptions:
            self.assumptions.append(sentence)

    def _gap(self, place: Place, actor: int, other: int, knot: str) -> Formula:
        if place.amount is None:
            raise self._refuse("it is not said how far the two vehicles are apart", place.span, "12 m behind the hero")
        if actor == other:
            raise self._refuse("a vehicle has no distance to itself", place.span)
        if place.relation in ("behind", "ahead"):
            rear = actor if place.relation == "behind" else other
        elif place.relation == "before":
            rear = actor
        elif place.relation == "from":
            rear = self._rear(place)
        else:
            raise self._refuse("it is not clear which vehicle is in front", place.span, "behind or ahead of")
        if any(each.kind in ("lead", "ego_leads") and each.actor == rear for each in self.facts.relations):
            raise self._refuse("the vehicle in the lead cannot be the one behind", place.span)
        kind: DerivedKind = "gap" if place.amount.dimension == "length" else "headway"
        return Compare("==", Derived(kind, rear, 1 - rear, Knot(knot)), place.amount.term)

    def _rear(self, place: Place) -> int:
        """Return who is behind where a distance does not say it: as told elsewhere, else the ego."""
        told = set()
        for each in (*self.facts.initial, *self.facts.trigger):
            if each.place is not None and isinstance(each.place.target, int) and each.place.relation != "from":
                told.add(each.actor if each.place.relation in ("behind", "before") else each.place.target)
        for relation in self.facts.relations:
            if relation.kind in ("lead", "ego_leads"):
                told.add(1 - relation.actor)
        if len(told) > 1:
            raise self._refuse("it is not clear which vehicle is in front", place.span, "behind or ahead of")
        if not told:
            self._assume(f"'{place.span.excerpt(self.text)}': the ego is the one behind")
        return told.pop() if told else EGO_ID
