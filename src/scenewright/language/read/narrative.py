"""The story while it is being read: who is known, which moments, who does what, in the order in which it is told.

What enters: what sentences say, one after the other. What leaves: a `Story`. It reads no words; what a text leaves out
by custom (who brakes comes to a standstill, who stops and goes on has stood in between) is put in here, and told.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from scenewright.errors import UnknownWordsError
from scenewright.language import story as st
from scenewright.language.phrases import speaks_of_ego
from scenewright.language.read.cast import Cast
from scenewright.language.read.facts import Clause
from scenewright.program.manner import USUAL, Manner
from scenewright.program.types import DEFAULT_MAP, EGO, Parameter

COURTESIES = {"yields", "insists", "lets"}
MOVING = (st.Verb.DRIVE, st.Verb.SPEED_UP)


@dataclass(slots=True)
class Doing:
    """A deed that is being told; it is open while its end is not known."""

    actor: int
    verb: str
    begins: int
    ends: int | None = None
    throughout: list[st.Measure] = field(default_factory=list)
    quote: st.Quote | None = None
    duration: tuple[st.Operator, st.Amount] | None = None


@dataclass(slots=True)
class Narrative(Cast):
    """The story so far."""

    conditions: list[list[st.Condition]] = field(default_factory=lambda: [[]])  # by moment
    times: dict[int, st.Amount] = field(default_factory=dict)
    quotes: dict[int, st.Quote] = field(default_factory=dict)
    ego: list[int] = field(default_factory=list)
    doings: list[Doing] = field(default_factory=list)
    orders: list[st.Order] = field(default_factory=list)
    holds: list[st.Hold] = field(default_factory=list)
    pending: int | None = None  # a moment that the last sentence told, at which nobody does anything yet
    kept: list[tuple[int, st.Quote]] = field(default_factory=list)  # who keeps the speed that it has at the start
    courtesies: list[tuple[int | None, str, st.Quote]] = field(default_factory=list)  # who yields, or does not
    parameters: list[Parameter] = field(default_factory=list)
    manner: Manner = USUAL
    map_name: str = DEFAULT_MAP
    title: str | None = None
    asides: list[st.Quote] = field(default_factory=list)

    def story(self) -> st.Story:
        """Return the story; deeds that are still open end at moments of their own."""
        if not any(actor.id == EGO for actor in self.actors):
            raise UnknownWordsError("the text does not say who is under test", fix="call it the ego")
        for actor, quote in self.kept:
            self._keep(actor, quote)
        for who, courtesy, quote in self.courtesies:
            self._check(who, courtesy, quote)
        self.go_straight()
        for doing in self.doings:
            if doing.ends is None:
                doing.ends = self.moment()
            if doing.duration is not None:
                self.orders.append(st.Order(doing.begins, doing.ends, *doing.duration, doing.quote))
        return st.Story(
            tuple(sorted(self.actors, key=lambda actor: actor.id)),
            tuple(st.Moment(tuple(own), self.times.get(number), self.quotes.get(number))
                  for number, own in enumerate(self.conditions)),
            tuple(self.ego),
            tuple(st.Deed(each.actor, each.verb, each.begins, each.ends or st.START, tuple(each.throughout), each.quote)
                  for each in self.doings),
            tuple(self.orders),
            tuple(self.holds),
            tuple(self.parameters),
            self.manner,
            self.map_name,
            self.title,
            tuple(self.asides),
            tuple(self.assumptions),
            tuple(self.questions),
        )  # fmt: skip

    def _check(self, who: int | None, courtesy: str, quote: st.Quote) -> None:
        """Refuse a courtesy that no deed bears out; who lets the ego go first goes on after it has passed."""
        own = [doing for doing in self.doings if who in (None, doing.actor)]
        stops = [number for number, doing in enumerate(own) if doing.verb in (st.Verb.BRAKE, st.Verb.STAND)]
        borne_out = bool(self.orders) if courtesy == "first" else bool(stops) is (courtesy != "insists")
        if not own or not borne_out:
            self.refuse("it is not said what is done to yield, or instead", quote, "say where it stops or passes")
        if courtesy == "lets" and stops[-1] + 1 < len(own):
            passes = st.Measure(EGO, st.Quantity.PLACE, "==", None, st.Place("conflict_point"), quote=quote)
            moment = self.moment_with([passes])
            if moment is None:
                moment = self.moment([passes], quote)
                self.ego.append(moment)
            self.orders.append(st.Order(moment, own[stops[-1] + 1].begins, ">", None, quote))

    def _keep(self, actor: int, quote: st.Quote) -> None:
        """Let somebody keep its first speed until its first deed, throughout where it has none."""
        first = next((doing for doing in self.doings if doing.actor == actor), None)
        if first is None or first.verb != st.Verb.DRIVE or first.begins != st.START:
            if actor == EGO or first is not None:
                self.refuse("it is not clear until when a speed is kept", quote)
            first = self.begin(actor, st.Verb.DRIVE, None, set(), quote)
        speeds = [each for each in self.conditions[st.START] if isinstance(each, st.Measure) and each.actor == actor
                  and (each.quantity, each.op, each.other) == (st.Quantity.SPEED, "==", None)]  # fmt: skip
        steady = st.Measure(actor, st.Quantity.RATE, "==", st.Amount(Fraction(0), "m/s^2"), quote=quote)
        first.throughout.append(speeds[0] if len(speeds) == 1 else steady)

    def moment(self, conditions: Sequence[st.Condition] = (), quote: st.Quote | None = None) -> int:
        """Add a moment and return its number."""
        self.conditions.append(list(conditions))
        if quote is not None:
            self.quotes[len(self.conditions) - 1] = quote
        return len(self.conditions) - 1

    def add(self, moment: int, conditions: Sequence[st.Condition]) -> None:
        """Let more be so at a moment."""
        self.conditions[moment] += [each for each in conditions if each not in self.conditions[moment]]

    def moment_with(self, conditions: Sequence[st.Condition]) -> int | None:
        """Return the moment that is known by one of these conditions, as an event, or by all of them."""
        for number, own in enumerate(self.conditions):
            if number != st.START and own and list(own) == list(conditions):
                return number
        events = [each for each in conditions if st.is_event(each)]
        for number, own in enumerate(self.conditions):
            if number != st.START and any(each in own for each in events):
                return number
        return None

    def is_owned(self, moment: int) -> bool:
        """Whether somebody begins or ends a deed at a moment."""
        return any(moment in (doing.begins, doing.ends) for doing in self.doings)

    def ego_comes(self, moment: int, quote: st.Quote) -> None:
        """Note that the ego comes through a moment that asks something of it, after those that were told before."""
        owned = self.is_owned(moment)
        timed = moment in self.times and not owned
        if moment in self.ego or moment == st.START or timed or not speaks_of_ego(self.conditions[moment]):
            return
        if owned and self.ego and not self._follows(self.ego[-1], moment):
            later, either = "it comes after the ego's moments that were told before", "it may come before or after them"
            asked = f"How does this moment lie to the ego's others: {quote.text}"
            if self.ask(f"ego {quote.start}", asked, [either, later], 0, quote) == either:
                return
        self.ego.append(moment)

    def ego_order(self, moments: list[int]) -> None:
        """Take the moments that the ego comes through, as a text lists them: nothing is open about them."""
        self.ego = moments
        self.questions = [each for each in self.questions if not each.slot.startswith("ego ")]

    def _follows(self, earlier: int, later: int) -> bool:
        for actor in self.actors:
            knots = {each for doing in self.doings if doing.actor == actor.id for each in (doing.begins, doing.ends)}
            if {earlier, later} <= knots:
                return True
        return False

    def last(self, actor: int) -> Doing | None:
        """Return what somebody was told to do last."""
        return next((doing for doing in reversed(self.doings) if doing.actor == actor), None)

    def begin(self, actor: int, verb: str, moment: int | None, leads: set[str], quote: st.Quote) -> Doing:
        """Let somebody begin a deed at a moment, or where the last one ended."""
        if actor == EGO:
            self.refuse("the ego is driven by the policy under test: say what the others do", quote)
        before = self.last(actor)
        if before is None:
            moment = self.moment() if moment is None and "then" in leads else moment
            if moment is not None and moment != st.START:
                waits = verb != st.Verb.BRAKE and standstill(actor) in self.conditions[st.START]
                first = st.Verb.STAND if waits else st.Verb.DRIVE
                self.doings.append(Doing(actor, first, st.START, moment, quote=quote))
                self.assumptions += [f"{self.actor(actor).name} stands still until then"] * waits
            begins = st.START if moment is None else moment
        elif before.ends is None:
            begins = before.ends = self.moment() if moment is None else moment
        else:
            begins = self._go_on(before, verb, moment, leads)
        self.doings.append(Doing(actor, verb, begins, quote=quote))
        return self.doings[-1]

    def _go_on(self, before: Doing, verb: str, moment: int | None, leads: set[str]) -> int:
        """Return where a deed begins after one whose end is known; what lies between is standing or driving on."""
        assert before.ends is not None
        stands = standstill(before.actor) in self.conditions[before.ends]
        if moment is None and not (
            stands and verb in MOVING and "at once" not in leads and before.verb != st.Verb.STAND
        ):
            return before.ends
        if moment == before.ends:
            return moment
        between = Doing(before.actor, st.Verb.STAND if stands else st.Verb.DRIVE, before.ends, quote=before.quote)
        between.ends = self.moment() if moment is None else moment
        self.doings.append(between)
        self.assumptions.append(
            f"{self.actor(before.actor).name} {'stands still' if stands else 'drives on'} in between"
        )
        return between.ends

    def doing_of(self, clause: Clause) -> Doing | None:
        """Return the deed that an event speaks of: ``the hero begins to brake for the second time``."""
        verb = st.Verb.BRAKE if clause.deed == "stop" else clause.deed
        same = [each for each in self.doings if each.actor == clause.subject and each.verb == verb]
        return same[clause.ordinal] if clause.ordinal < len(same) else None


def standstill(actor: int) -> st.Measure:
    """Return that somebody stands."""
    return st.Measure(actor, st.Quantity.SPEED, "==", st.Amount(Fraction(0), "m/s"))
