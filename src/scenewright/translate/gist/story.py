"""Puts what was found together to one story: states at the start and at the trigger, what the hero does, who is first.

What enters: words, amounts with their moments, deeds. What leaves: `Facts`, as the strict reader makes them, and an
event for each fact, which says where it stands.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Literal

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID, Event, Place, Relation, goes_on
from scenewright.translate.facts import Condition, Facts, Phase
from scenewright.translate.gist.clauses import BOUNDS
from scenewright.translate.gist.measured import Measured
from scenewright.translate.gist.orders import GOES, OrderReader
from scenewright.translate.gist.owners import is_nobodys
from scenewright.translate.gist.words import Deed

STOP_AND_SPEED = "a stop and a speed are told"
_SLOWS = ("brake", "stop")
_MOVES = (*_SLOWS, "accelerate")
# What the ego may do of itself: nobody tells it to, and it changes nothing of what is orchestrated.
_EGO_MAY = ("before", "after", "let_reach", "go", "turn", "let", "keep", "yield")
_OUGHT = re.compile(
    r"\b(?:should|ought|supposed|must|has to|have to|had to|would|could|might|although|though|instead|not|n't|never"
    r"|no|without|far from|fail\w*|disregard\w*|ignor\w*|neglect\w*|refus\w*|den(?:y|ies|ied))\b",
    re.IGNORECASE,
)
# "a speed that it holds unchanged from the first to the last second of the run"
_ALL_THE_TIME = re.compile(
    r"\bspeed\b[^.;\n]{0,20}\b(?:hold|keep|maintain)s?\b(?:(?!lane)[^.;\n]){0,40}\b(?:throughout|all (?:the time"
    r"|through|along)"
    r"|from (?:the )?(?:first|beginning|start) to (?:the )?(?:last|end)|the whole (?:run|time|test))\b",
    re.IGNORECASE,
)
_ORDERED = re.compile(r"\b(?:is to|must|shall|has to|needs to|should)\b", re.IGNORECASE)
_STANDS = re.compile(r"\b(?:stand|stood|stationary|stopped|standstill|still|rest|idl)", re.IGNORECASE)


@dataclass(slots=True)
class StoryTeller(OrderReader):
    """Makes facts of what was found."""

    def tell(self) -> Facts:
        """Return the facts.

        Raises
        ------
        TranslationError
            Where they contradict each other, or make no whole story.
        """
        self._check_clock()
        self.deeds = [self._at_first(deed) for deed in self.deeds]
        for made in (*self.moments.of("start"), *self.moments.of("trigger")):
            self._state(made)
        for deed in self.deeds:
            first = self.words.where(deed.clause.inside, "adverb", "initially") is not None
            waits = deed.kind == "wait" and (first or deed.clause.sentence < self.trigger_sentence)
            if deed.actor == EGO_ID and waits and self._stands_at_first(deed):
                raise self.words.refuse("an ego that stands at the start is not supported", deed.span)
            if deed.actor == EGO_ID and (deed.kind not in _EGO_MAY or self._is_ordered(deed)) and not waits:
                message = "the ego cannot be told what to do: the driving policy under test drives it"
                raise self.words.refuse(message, deed.span)
        self._refuse_loose_moments()
        self._standing()
        told = [deed for deed in self.deeds if deed.actor == HERO_ID and self._counts(deed)]
        slows = [deed for deed in told if deed.kind in _SLOWS]
        if slows and not any(deed.kind in GOES for deed in told):
            told = sorted([*told, *self._told_early()], key=lambda deed: deed.at)
        told = self._without_result(told)
        if slows:  # "brakes and keeps at it until it stands"
            told = [deed for deed in told if deed.clause.link == "then" or not self._only_keeps(deed)]
        self._check(told)
        goes = [deed for deed in told if deed.kind in GOES]
        denies = [deed for deed in told if deed.kind == "not_yield"]
        if denies and not slows:
            self.facts.not_yielding = Event("yield", HERO_ID, denies[0].span, denies[0].clause.sentence)
        if slows:
            self._slow(slows, waits=any(deed.kind == "wait" for deed in told))
        if goes or (denies and not slows):
            self._go(goes, denies, after_stop=bool(slows))
        self.read_order(goes)
        self._check_first()
        return self.facts

    def _at_first(self, deed: Deed) -> Deed:
        """Return "its speed is zero at first", told before the trigger, as a wait."""
        early = deed.kind == "stop" and deed.actor == HERO_ID and deed.clause.sentence < self.trigger_sentence
        first = self.words.where(deed.clause.inside, "adverb", "initially") is not None
        told = early and (first or "start" in deed.clause.labels) and not self._has_stop_verb(deed)
        return replace(deed, kind="wait") if told else deed

    def _has_stop_verb(self, deed: Deed) -> bool:
        """Whether somebody is told to stop or to brake, not to be stopped."""
        return bool(self.words.verbs(deed.clause.inside) & {"stop", "brake", "yield"})

    def _check_clock(self) -> None:
        """Refuse what is told of another sentence beside "5 s after the start": it may be of another moment."""
        told = self.moments.of("trigger")
        clocks = {made.clause.sentence for made in told if made.kind == "clock"}
        beside = next((made for made in told if clocks and made.clause.sentence not in clocks), None)
        if beside is not None:
            raise self.words.refuse("it is not clear at which moment this holds", beside.span)

    def _stands_at_first(self, deed: Deed) -> bool:
        """Whether the ego is said to stand at a place, not only to be there or to be about to turn."""
        told = self.words.span(deed.clause).excerpt(self.words.text)
        placed = self.words.where(deed.clause.inside, "landmark", "stop_line") is not None
        return placed and not self.words.has(deed.clause.inside, "quantity") and _STANDS.search(told) is not None

    def _check_first(self) -> None:
        """Refuse "The ego gets past the point first ..." where the hero is told to be."""
        for clause in self.words.clauses:
            passes = self.words.verbs(clause.inside) & {"pass", "go", "reach", "complete"}
            first = self.words.where(clause.inside, "adverb", "first")
            ego = clause.subject == EGO_ID and clause.named and clause.link in ("main", "and", "colon")
            if ego and passes and first is not None and self.facts.order is not None and self.facts.order.hero_first:
                raise self.words.refuse("each vehicle is said to be first", self.words.span(clause))

    def _refuse_loose_moments(self) -> None:
        """Refuse "... then the ego begins its turn", told after what the hero does, where it orders nothing."""
        acts = [d.at for d in self.deeds if d.actor == HERO_ID and d.kind in ("pass", "complete", "accelerate")]
        for deed in self.deeds:
            named = deed.clause.named or "who" in deed.clause.labels
            loose = deed.actor == EGO_ID and deed.kind == "turn" and named
            loose = loose and (self.moments.begins(deed) or self._between_deeds(deed))
            late = deed.clause.sentence >= self.trigger_sentence
            late = late and (self._between_deeds(deed) or any(at < deed.at for at in acts))
            if loose and late and deed.clause.link != "that":
                raise self.words.refuse("it is not clear what this orders", self.words.span(deed.clause))

    def _is_ordered(self, deed: Deed) -> bool:
        """Whether "As soon as the hero has stopped, the ego is to give up its turn" tells the ego what to do."""
        clause = deed.clause
        if clause.sentence < self.trigger_sentence or clause.link not in ("main", "then") or not clause.named:
            return False
        ordered = _ORDERED.search(self.words.span(clause).excerpt(self.words.text)) is not None
        earlier = [each for each in self.words.sentence(clause) if each.start < clause.start and each.link == "when"]
        return ordered and any(each.subject == HERO_ID for each in earlier) and deed.kind not in ("before", "after")

    def _between_deeds(self, deed: Deed) -> bool:
        """Whether "the ego turns" is told after the hero has stopped and before it goes on."""
        own = [each for each in self.deeds if each.actor == HERO_ID]
        stopped = any(each.kind in (*_SLOWS, "wait") and each.at < deed.at for each in own)
        goes = any(each.kind in GOES and each.at > deed.at for each in own)
        return stopped and goes and deed.clause.link == "main" and deed.clause.sentence > self.trigger_sentence

    # -- states -------------------------------------------------------------------------------------------------------
    def _state(self, made: Measured) -> None:
        start = self.moments.moments[made.at] == "start"
        beside = [each for each in self.moments.of("trigger") if each is not made and each.actor == made.actor]
        waits = any(deed.clause is made.clause and deed.kind in ("wait", "stop") for deed in self.deeds)
        loose = made.relation in ("just_before", "past")
        if made.quantity is None and loose and not waits and (start or beside):
            raise self.words.refuse("it is not clear at which moment this holds", made.span)
        if made.quantity is None and (start or beside):
            return  # "stands at the stop line" at first, "at the stop line" beside an amount
        condition = self._condition(made)
        known = self.facts.initial if start else self.facts.trigger
        for old in known:
            alike = (old.place is None, old.ttc is None) == (condition.place is None, condition.ttc is None)
            if old.actor == condition.actor and alike:
                raise self.words.refuse("two amounts are told of one vehicle at one moment", made.span)
        known.append(condition)
        self.events.append(condition.event)

    def _condition(self, made: Measured) -> Condition:
        if made.kind == "place" and is_nobodys(self.words, made.at, made.clause):
            raise self.words.refuse("it is not said whose distance this is", made.span)
        if made.kind == "open":
            raise self.words.refuse("it is not clear what this measures", made.span, "a place: 12 m from the stop line")
        if made.kind in ("gap", "ttc") or made.actor is None:
            return self._between(made)
        event = Event("be", made.actor, made.span, made.clause.sentence)
        if made.kind == "speed":
            return Condition(made.actor, event, speed=made.quantity)
        if made.kind == "clock":
            return Condition(made.actor, event, clock=made.quantity)
        assert made.landmark is not None
        if made.landmark == "last":
            raise self.words.refuse("it is not clear which place this is", made.span)
        place = Place(made.relation, made.landmark, made.quantity, made.span, vague=made.vague)
        return Condition(made.actor, event, place)

    def _between(self, made: Measured) -> Condition:
        """Return a condition between the two vehicles."""
        if made.kind == "ttc":
            return Condition(EGO_ID, Event("ttc", EGO_ID, made.span, made.clause.sentence), ttc=made.quantity)
        if made.kind != "gap":
            raise self.words.refuse("it is not clear whose amount this is", made.span)
        rear = made.actor if made.actor is not None else EGO_ID
        relation: Relation = "from" if made.actor is None else "behind"
        event = Event("be", rear, made.span, made.clause.sentence)
        return Condition(rear, event, Place(relation, 1 - rear, made.quantity, made.span))

    def _standing(self) -> None:
        """Read "a taxi is standing at the stop line" before the trigger: it waits there until then."""
        for deed in self.deeds:
            first = deed.kind == "wait" and deed.actor == HERO_ID and self._is_before(deed)
            if first and (_STANDS.search(deed.span.excerpt(self.words.text)) or self._waits_at_line(deed)):
                self.facts.standing = self.facts.standing or self._event(deed)
            elif first and not self._tells_where(deed) and not self._slows_later():
                raise self.words.refuse("it is not said where the hero waits", deed.span)

    def _waits_at_line(self, deed: Deed) -> bool:
        """Whether a vehicle "waits at the stop line", told before the trigger."""
        at = self.words.where(range(deed.at, deed.clause.end), "landmark", "stop_line")
        told = self.words.has(deed.clause.inside, "quantity") or deed.clause.sentence >= self.trigger_sentence
        return at is not None and not told and self.words.tag(at - 2, "preposition") == "at" and not self._slows_later()

    def _slows_later(self) -> bool:
        """Whether the hero comes to a stop from its trigger on, so that it does not stand before."""
        later = (d for d in self.deeds if d.actor == HERO_ID and d.clause.sentence >= self.trigger_sentence)
        return any(d.kind in _SLOWS for d in later)

    def _is_before(self, deed: Deed) -> bool:
        """Whether a deed is told before the trigger, or of whom: "a car that is standing at the line sets off when"."""
        if deed.clause.sentence < self.trigger_sentence:
            return True
        first = min(made.at for made in self.moments.of("trigger"))
        been = any("been" in self.words.word(at).split() for at in range(deed.clause.start, deed.at + 1))
        relative = deed.clause.link == "that" and (deed.at < first or been)  # "which has been standing at the line"
        stands = bool(_STANDS.search(deed.span.excerpt(self.words.text)))
        return relative and stands and not any(d.actor == HERO_ID and d.kind in _SLOWS for d in self.deeds)

    def _tells_where(self, deed: Deed) -> bool:
        """Whether a wait only says where a vehicle is or what it is about to do: "waits on the driveway to turn"."""
        sentence = self.words.sentence(deed.clause)
        where = ("area", "landmark", "direction", "quantity", "heading")
        return any(self.words.has(each.inside, *where) for each in sentence)

    # -- what the hero does -------------------------------------------------------------------------------------------
    def _counts(self, deed: Deed) -> bool:
        """Whether a deed belongs to what the hero does from its trigger on."""
        clause, here = deed.clause, self.trigger_sentence
        if clause.link == "when" and deed.kind not in ("brake", "accelerate"):
            return False
        if deed.kind in ("brake", "accelerate", "not_yield", "not_stop", "complete"):
            return True
        if deed.kind == "yield":
            return False
        if deed.kind == "pass" and deed.landmark is None:
            lane = self.words.where(range(deed.at, clause.end), "area", "lane") is not None
            if lane or clause.sentence < here:
                return False  # "crosses the ego's lane"
        if deed.kind in ("stop", "pass"):
            return clause.sentence >= here or clause.link != "that"
        if deed.kind == "turn" and clause.link == "that" and not self.moments.begins(deed):
            return False  # "a tractor that has been making its way out of the driveway"
        if deed.kind == "keep" or (deed.kind == "turn" and self.moments.begins(deed)):
            return clause.sentence >= here
        first = min(made.at for made in self.moments.of("trigger"))
        return clause.sentence > here or (clause.sentence == here and clause.start > first)

    def _told_early(self) -> list[Deed]:
        """Return how the hero goes on where it is told before the trigger: "It stops, drives on. It brakes when"."""
        own = [d for d in self.deeds if d.actor == HERO_ID and d.clause.sentence < self.trigger_sentence]
        stops = [d for d in own if d.kind == "stop"]
        return [
            d
            for d in own
            if d.kind in ("go", "pass", "complete", "accelerate")
            and any(each.clause.sentence == d.clause.sentence and each.at < d.at for each in stops)
            and not self._counts(d)
        ]

    def _without_result(self, told: list[Deed]) -> list[Deed]:
        """Leave out "The hero passes it first. When ...", where it is told again after what comes before."""
        slows = [deed for deed in told if deed.kind in _SLOWS]
        early = [d for d in told if d.kind in ("pass", "complete") and d.clause.sentence < self.trigger_sentence]
        again = {d.kind for d in told if slows and d.at > slows[0].at}
        result = [d for d in early if slows and d.at < slows[0].at and d.kind in again and d.clause.link != "that"]
        return [deed for deed in told if deed not in result]

    def _only_keeps(self, deed: Deed) -> bool:
        return deed.kind in ("keep", "go") and deed.span.excerpt(self.words.text).lower().startswith(("keep", "kept"))

    def _check(self, told: list[Deed]) -> None:
        """Refuse what contradicts itself or is no story."""
        always = _ALL_THE_TIME.search(self.words.text)
        if always is not None and any(deed.kind in _MOVES for deed in told):
            raise self.words.refuse("a speed that is held all the time cannot change", Span(*always.span()))
        kinds = {deed.kind for deed in told}
        slows = [deed for deed in told if deed.kind in _SLOWS]
        goes = [deed for deed in told if deed.kind in GOES]
        first = next((deed.at for deed in told if deed.kind in ("stop", "wait")), -1)
        between = [
            d for d in told if d.kind == "go" and slows and slows[0].at < d.at < first and slows[0].kind == "brake"
        ]
        if between:
            raise self.words.refuse("the hero is said to drive on before it has stopped", between[0].span)
        waits = next((deed for deed in told if deed.kind == "wait"), None)
        if waits is not None and not slows:
            raise self.words.refuse("it is not said how the hero comes to stand here", waits.span, "brakes to a stop")
        if not (slows or goes or "not_yield" in kinds):
            raise self.words.refuse("it is not said what the hero does", None, "brakes, stops, accelerates, passes")
        if slows and goes and goes[0].at < slows[0].at:
            raise self.words.refuse("it is not clear in which order this happens", goes[0].span)
        again = next((deed for deed in slows if self._brakes_again(deed, slows, goes)), None)
        if again is not None:
            raise self.words.refuse("the hero has stopped already", again.span)
        slowed = not kinds & {"stop", "wait"} and any(made.kind == "speed" for made in self.moments.of("deed"))
        if slows and kinds & ({"not_yield"} if slowed else {"not_yield", "not_stop"}):
            raise self.words.refuse("the hero is said to stop and not to stop", slows[0].span)
        yields = next((d for d in self.deeds if d.kind == "yield" and d.actor == HERO_ID), None)
        modal = yields is not None and _OUGHT.search(self.words.span(yields.clause).excerpt(self.words.text))
        if yields is not None and goes and not slows and not modal and yields.clause.link in ("main", "and", "colon"):
            raise self.words.refuse("the hero is said to yield and to go first", yields.span)
        last = max(made.at for made in self.moments.of("trigger"))
        kept = next((deed for deed in told if deed.kind == "keep" and deed.at > last), None)
        if kept is not None and slows and kept.at < slows[0].at and slows[0].clause.sentence == kept.clause.sentence:
            raise self.words.refuse("the hero is said to keep its speed and to brake", kept.span)
        if {"keep", "accelerate"} <= kinds:
            raise self.words.refuse("the hero is said to speed up and not to", goes[0].span)
        turn = next((deed for deed in told if deed.kind == "turn"), None)
        if (
            turn is not None
            and not self._turns_whole(told)
            and (self.moments.begins(turn) or not kinds & {"complete", "pass"})
        ):
            raise self.words.refuse("it is not clear up to where the hero turns", turn.span)
        self._check_turns()

    def _turns_whole(self, deeds: list[Deed]) -> bool:
        """Whether nothing is told but that the hero begins its turn and completes it."""
        told = [deed for deed in deeds if deed.actor == HERO_ID and self._counts(deed)]
        kinds = {deed.kind for deed in told} - {"not_yield", "not_stop"}
        return kinds == {"turn", "complete"} and any(d.kind == "turn" and self.moments.begins(d) for d in told)

    def _brakes_again(self, deed: Deed, slows: list[Deed], goes: list[Deed]) -> bool:
        """Whether the hero brakes after its stop, on its way: "stops, then brakes to pass the conflict point"."""
        first = min(
            made.at for made in self.moments.of("trigger")
        )  # what is told before it tells in short what follows
        stopped = any(
            each.kind in ("stop", "wait") and first < each.at < deed.at for each in self.deeds if each.actor == HERO_ID
        )
        goal = any(each.at > deed.at and each.kind != "accelerate" for each in goes)
        goal = goal and (
            deed.clause.link == "then" or deed.clause.sentence != self.trigger_sentence or self._shared(deed, goes)
        )
        finite = bool(self.words.tokens[deed.at].forms & {"s", "base"})
        return deed.kind == "brake" and stopped and goal and finite and not self.moments.begins(deed)

    def _shared(self, deed: Deed, goes: list[Deed]) -> bool:
        return any(each.clause.sentence == deed.clause.sentence and each.at > deed.at for each in goes)

    def _check_turns(self) -> None:
        """Refuse "goes, all the way round its turn": a turn that no verb begins or completes."""
        for clause in self.words.clauses:
            bound = clause.link in (*BOUNDS, "when")
            if clause.sentence < self.trigger_sentence or clause.subject != HERO_ID or bound:
                continue
            for at in clause.inside:
                back = at - 1 - ("direction" in self.words.tags(at - 1))
                owned = self.words.tag(at, "event_noun") == "turn" and self.words.has([back], "possessive")
                own = [deed for deed in self.deeds if at in deed.clause.inside]
                done = any(deed.kind in ("complete", "turn", "before", "after", "let_reach") for deed in own)
                if owned and not done:
                    raise self.words.refuse("it is not clear up to where the hero goes", self.words.tokens[at].span)

    def _slow(self, slows: list[Deed], *, waits: bool) -> None:
        phase, speed_at = Phase("dec", [self._event(slows[0])]), 0
        phase.to_stop = waits or any(deed.kind == "stop" for deed in slows)
        for made in self.moments.of("deed"):
            if made.kind == "place":
                self._stop_place(phase, made)
            elif made.kind == "duration":
                phase.wait, phase.wait_bound = made.quantity, made.bound
            elif made.kind == "rate" and self._deed_of(made, (*_MOVES, "go")) in _SLOWS:
                phase.rate, phase.rate_event = made.quantity, self._event_at(made)
            elif made.kind == "speed" and self._deed_of(made, (*_MOVES, "pass", "go")) in _SLOWS:
                phase.to_speed, speed_at = made.quantity, made.at
        if phase.to_speed is not None and phase.to_stop:
            stopped = any(deed.kind == "stop" and deed.at < speed_at for deed in slows)
            raise self.words.refuse(STOP_AND_SPEED if stopped else "a speed and a stop are told", phase.to_speed.span)
        self.facts.phases.append(phase)

    def _stop_place(self, phase: Phase, made: Measured) -> None:
        assert made.landmark is not None
        if made.landmark == "last":
            raise self.words.refuse("it is not clear which place this is", made.span)
        if phase.place is not None and made.quantity is None and made.relation != "just_before":
            return
        if phase.place is not None and (phase.place.amount is not None or phase.place.relation == "just_before"):
            raise self.words.refuse("two places to stop are told", made.span)
        phase.place = Place(made.relation, made.landmark, made.quantity, made.span, vague=made.vague)
        phase.place_event = self._event_at(made)

    def _go(self, goes: list[Deed], denies: list[Deed], *, after_stop: bool) -> None:
        keeps = any(deed.kind == "keep" for deed in goes) or self._only_goes_on(goes)
        keeps = keeps and not after_stop and self.facts.standing is None
        kind: Literal["go", "turn", "acc"] = "go" if keeps else "acc"
        kind = "turn" if self._turns_whole(self.deeds) else kind
        phase = Phase(kind, [self._event((goes or denies)[0])])
        told = [deed for deed in goes if deed.kind in ("pass", "complete")]
        explicit = [deed for deed in told if deed.kind == "complete" or deed.landmark is not None]
        goal = next(reversed(explicit or told), None)  # "turns in front of traffic" tells no place of its own
        if goal is not None:
            phase.goal = "turn_end" if goal.kind == "complete" else goal.landmark or "conflict_point"
            phase.goal_event = self._event(goal)
        for made in self.moments.of("deed"):
            of = self._deed_of(made, (*_MOVES, "pass", "go") if made.kind == "speed" else (*_MOVES, "go"))
            own = not after_stop or of not in _SLOWS
            if made.kind == "rate" and own:
                phase.rate, phase.rate_event = made.quantity, self._event_at(made)
            elif made.kind == "speed" and own:
                if self.facts.standing is not None and not made.target:
                    raise self.words.refuse("the hero is said to stand, and to drive at a speed", made.span)
                phase.to_speed = made.quantity
            elif made.kind in ("duration", "place") and not after_stop and not self._stands_at(made):
                raise self.words.refuse("this amount does not belong to what the hero does", made.span)
        goals = {deed.landmark for deed in goes if deed.kind == "pass" and deed.landmark is not None}
        if len(goals) > 1:
            raise self.words.refuse("two goals are told", phase.events[0].span)
        if phase.goal == "stop_line":
            raise self.words.refuse("a stop line is no goal", phase.events[0].span)
        self.facts.phases.append(phase)

    def _only_goes_on(self, goes: list[Deed]) -> bool:
        """Whether the hero "drives on", and neither sets off nor speeds up."""
        told = [deed for deed in goes if deed.kind in ("go", "accelerate")]
        return bool(told) and all(deed.kind == "go" and goes_on(self.words.tokens[deed.at].text) for deed in told)

    def _stands_at(self, made: Measured) -> bool:
        return self.facts.standing is not None and made.quantity is None and made.landmark == "stop_line"

    def _deed_of(self, made: Measured, kinds: tuple[str, ...]) -> str | None:
        """Return the deed that an amount belongs to: the one told last before it."""
        near = [deed for deed in self.deeds if deed.actor == HERO_ID and deed.kind in kinds]
        same = [deed for deed in near if deed.clause.sentence == made.clause.sentence]
        chosen = [deed for deed in same if deed.at < made.at][-1:] or same[:1] or near[:1]
        return chosen[0].kind if chosen else None

    # -- helpers ------------------------------------------------------------------------------------------------------
    def _event(self, deed: Deed) -> Event:
        event = Event(deed.kind, HERO_ID, self.words.span(deed.clause), deed.clause.sentence)
        self.facts.understood[id(event)] = ["what the hero does"]
        self.events.append(event)
        return event

    def _event_at(self, made: Measured) -> Event:
        event = Event("be", HERO_ID, made.span, made.clause.sentence)
        self.events.append(event)
        return event
