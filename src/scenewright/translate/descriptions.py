"""Reads what is told of a vehicle: where it comes from and goes to, where and how fast it is at the start.

What enters: events of main clauses without action. What leaves: wishes, lane relations and first conditions in `Facts`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, SAY_IT_ALONE, Area, Event, Place
from scenewright.translate.facts import Condition, Facts, LaneRelation, Said, WishKey

OPPOSITE = {"N": "S", "S": "N", "E": "W", "W": "E"}
ACTING = ("brake", "stop", "yield", "accelerate", "keep", "pass", "complete")


_STRAIGHT_ACROSS = re.compile(r"\bstraight (?:ahead|on)\b", re.IGNORECASE)


@dataclass(slots=True)
class DescriptionReader:
    """Collects what is told."""

    text: str
    name: str
    facts: Facts = field(default_factory=Facts)
    sentence: list[Event] = field(default_factory=list)
    pending_before: Event | None = None
    pending_release: list[Event] = field(default_factory=list)
    order_assumed: bool = False  # the order's moment is a default that later words may replace

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

    def _note(self, event: Event, understood: str) -> None:
        self.facts.understood.setdefault(id(event), []).append(understood)

    def _wish(self, actor: int, key: WishKey, value: str, event: Event) -> None:
        known = self.facts.wishes[actor].get(key)
        if known is not None and known.value != value:
            subject = f"the {ACTOR_NAMES[actor]}'s {key.replace('_', ' ')}"
            raise self._refuse(
                f"two things are said about {subject}: {known.value} and {value}",
                event.span,
                f"{known.value}, as in '{known.event.span.excerpt(self.text)}'",
                "say one of them",
            )
        self.facts.wishes[actor].setdefault(key, Said(value, event))

    def _tell(self, event: Event) -> None:
        if (
            event.rate
            or event.to_speed
            or event.duration
            or event.first
            or event.than_actor is not None
            or event.after_actor is not None
            or (event.landmark and event.verb != "approach")
        ):
            raise self._refuse(f"'{event.span.excerpt(self.text)}' has no meaning here", event.span)
        actor = event.actor
        assert actor is not None
        route = event.verb in ("turn", "pull_out", "leave", "drive", "lane_follow", "go") and not event.places
        if "then" in event.links and not (route and not self.facts.phases and not self.facts.trigger):
            raise self._refuse("this comes 'then', but nothing happens in it", event.span, "an action of the hero")
        self._tell_route(event)
        if event.in_front and event.actor == HERO_ID:
            self.facts.relations.append(LaneRelation("across_or_into", HERO_ID, event))
        if event.verb == "approach" and event.landmark == "stop_line":
            self._wish(actor, "origin_kind", "driveway", event)
        elif event.verb == "approach" and event.landmark is not None:
            self._note(event, f"it drives towards the {event.landmark.replace('_', ' ')}")
        for place in event.places:
            if event.verb in ("turn", "pull_out") and place.relation in ("at", "just_before"):
                if place.target not in ("intersection", "turn_start", "turn"):
                    raise self._refuse("a turn takes no place of its own", place.span, "where the vehicle turns into")
                self._note(event, "it turns where the roads meet")
            elif self._straight_at(event, place):
                self._note(event, "it drives straight on where the roads meet")
            elif isinstance(place.target, int) and place.amount is None:
                self._lead(place, actor, event)
            else:
                self._start(Condition(actor, event, place=place))
        if event.speed is not None:
            self._start(Condition(actor, event, speed=event.speed))
        if event.ttc is not None:
            raise self._refuse(
                "a time to collision belongs into the trigger", event.span, fix="say 'when the time to collision ...'"
            )
        waits = event.verb == "wait" and self._waits_to(event)
        if waits and (event.actor == EGO_ID or "wait" in event.span.excerpt(self.text).lower()):
            said = "whether the ego stands is for its own driving policy to decide"
            said = said if event.actor == EGO_ID else "it is about to; nothing is said of a stand"
            self.facts.assumptions.append(f"'{event.span.excerpt(self.text)}': {said}")
        elif event.verb == "wait":
            self._stand(event)

    @staticmethod
    def _straight_at(event: Event, place: Place) -> bool:
        """Whether "straight on at the junction" tells of a way and not of a first place."""
        moves = event.verb == "lane_follow" or (event.verb in ("drive", "go") and event.direction == "straight")
        there = place.relation == "at" and place.target in ("intersection", "turn", "turn_start")
        return moves and there and not event.initial

    def _waits_to(self, event: Event) -> bool:
        """Whether the ego "waits on the driveway to turn right": it is about to, and nothing is said of a start."""
        at = self.sentence.index(event)
        following = self.sentence[at + 1] if at + 1 < len(self.sentence) else None
        return following is not None and following.links == ["to"] and following.actor == event.actor

    def _stand(self, event: Event) -> None:
        if event.actor != HERO_ID or event.speed is not None or event.wanted:
            raise self._refuse(
                "an ego that stands at the start is not supported", event.span, "an ego that drives towards its goal"
            )
        self.facts.standing = self.facts.standing or event
        self._note(event, "the hero stands still until the trigger")

    def _start(self, condition: Condition) -> None:
        index = next((at for at, event in enumerate(self.sentence) if event is condition.event), 0)
        acted = [e for e in self.sentence[:index] if e.actor == HERO_ID and e.mode == "main" and e.verb in ACTING]
        if any(not event.wanted and not event.negated for event in acted):
            raise self._refuse(
                "it is not clear whether this holds at the start or after what the hero does",
                condition.event.span,
                "'initially', or a place to stop right after 'stops'",
            )
        self._no_second_place(condition, self.facts.initial)
        self.facts.initial.append(condition)

    def _no_second_place(self, new: Condition, known: list[Condition]) -> None:
        """Refuse a second position at the same landmark, or a second speed, of an actor at one moment."""
        for old in known:
            same_kind = (old.place is None) == (new.place is None) and (old.speed is None) == (new.speed is None)
            same_target = old.place is None or new.place is None or old.place.target == new.place.target
            if old.actor == new.actor and same_kind and same_target:
                moment = "the start" if known is self.facts.initial else "the trigger"
                raise self._refuse(
                    f"two things are said about the {ACTOR_NAMES[new.actor]} at {moment}",
                    new.event.span,
                    f"one, as in '{old.event.span.excerpt(self.text)}'",
                    "say 'initially' for where it starts",
                )

    def _lead(self, place: Place, actor: int, event: Event) -> None:
        kind = {"ahead": "lead", "behind": "lead"}.get(place.relation)
        if kind is None:
            raise self._refuse("it is not said how far", place.span, "a distance")
        self.facts.mentioned.add(int(place.target))
        self.facts.relations.append(LaneRelation("lead", HERO_ID, event))
        ahead = actor if place.relation == "ahead" else 1 - actor
        if ahead != HERO_ID:
            self.facts.relations[-1] = LaneRelation("ego_leads", EGO_ID, event)
        self._note(event, f"the {ACTOR_NAMES[ahead]} is ahead in the same lane")

    def _tell_route(self, event: Event) -> None:
        actor = event.actor
        assert actor is not None
        turning = event.verb in ("turn", "pull_out", "complete")
        if "no turn" in event.notes:
            self._wish(actor, "turn", "straight", event)
        if self._until_a_turn(event):
            pass  # "follows the road and turns left into the driveway"
        elif event.verb == "lane_follow" or (event.verb == "go" and event.direction == "straight"):
            self._wish(actor, "turn", "straight", event)
        elif event.verb in ("turn", "complete", "pull_out", "leave") and event.direction is not None:
            self._wish(actor, "turn", event.direction, event)
        elif event.verb == "drive" and event.direction == "straight" and actor == EGO_ID:
            self._wish(actor, "turn", "straight", event)
        elif event.verb in ("drive", "go") and event.direction in ("left", "right"):
            self._wish(actor, "turn", event.direction, event)
        for area in event.areas:
            self._tell_area(actor, area, event, turning)
        joins = event.verb == "pull_out" and any(area.role == "into" and area.kind == "road" for area in event.areas)
        if joins and "origin_kind" not in self.facts.wishes[actor]:
            self._wish(actor, "origin_kind", "driveway", event)  # "joins the road": it was not there before
        for heading, _ in event.ends:
            self._wish(actor, "destination_heading", heading, event)
        for heading, span in event.headings:
            if self.text[span.start : span.end].lower().startswith(("from", "out of")):
                self._wish(actor, "origin_heading", heading, event)
                continue
            before_verb = bool(event.areas) is False and span.start < event.span.start
            turned = [
                each
                for each in self.sentence
                if each.actor == actor
                and each.verb in ("turn", "pull_out", "leave")
                and not (
                    "that" in each.links and each.verb == "turn" and "that" not in event.links and not event.wanted
                )  # "a van that is to turn right drives west"
            ]
            if (
                event.verb in ("drive", "go")
                and turned
                and not any(area.role == "into" and area.kind == "driveway" for area in turned[0].areas)
                and turned[0].span.start < event.span.start
                and event is not turned[0]
            ):
                self._wish(actor, "destination_heading", heading, event)  # "leaves the driveway and heads east"
                continue
            ends = turning and span.start > event.span.start and not before_verb
            self._wish(actor, "destination_heading" if ends else "origin_heading", heading, event)
            if event.verb == "lane_follow" and not self._until_a_turn(event):
                self._wish(actor, "destination_heading", heading, event)
        for kind, who, _ in event.relations:
            self.facts.relations.append(LaneRelation(kind, who, event))

    def _until_a_turn(self, event: Event) -> bool:
        """Whether a vehicle follows a road only as far as the turn that the same sentence tells."""
        words = f" {event.span.excerpt(self.text).lower()}"
        if event.verb != "lane_follow" or not any(f" follow{end} " in words for end in ("", "s", "ing")):
            return False
        at = next((index for index, each in enumerate(self.sentence) if each is event), len(self.sentence))
        return any(
            each.actor == event.actor and each.verb in ("turn", "leave") and each.direction not in (None, "straight")
            for each in self.sentence[at + 1 :]
        )

    def _tell_area(self, actor: int, area: Area, event: Event, turning: bool) -> None:
        role = area.role
        if role == "across" and area.lane_of == actor:
            raise self._refuse("a vehicle does not cross its own way", area.span, "the other vehicle's path")
        if role == "across" and _STRAIGHT_ACROSS.search(event.span.excerpt(self.text)):
            raise self._refuse("it is not clear where the hero leaves the road", area.span, "left or right")
        if role == "across":
            self.facts.relations.append(LaneRelation("across", actor, event))
            return
        end = "destination" if role == "into" or (turning and role == "on") else "origin"
        if role == "towards" or (event.verb == "approach" and role == "into"):
            self._note(event, f"it drives towards the {area.kind}")
            return
        if event.verb == "drive" and role == "into":
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
        if event.verb == "lane_follow" and area.kind == "road" and not self._until_a_turn(event):
            self._wish(actor, "destination_kind", "road", event)
        if area.wanted_by is not None:
            self.facts.relations.append(LaneRelation("in_wanted_lane", actor, event))
        if area.oncoming:
            self.facts.relations.append(LaneRelation(f"oncoming_{end}", actor, event))
        elif area.lane_of is not None and area.lane_of != actor:
            self.facts.relations.append(LaneRelation(f"lane_{end}", actor, event))
