"""The story while it is being read: who is known, which moments, who does what, in the order in which it is told.

What enters: what sentences say, one after the other, and lines with a label. What leaves: a `Story`. What a text leaves
out by custom (who brakes comes to a standstill, who stops and goes on has stood in between) is put in here, and told.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import takewhile

from scenewright.errors import UnknownWordsError
from scenewright.program.manner import USUAL, Manner, manner_of, unit_of
from scenewright.program.types import DEFAULT_MAP, EGO, Parameter
from scenewright.translate import story as st
from scenewright.translate.compile import DRIVEN
from scenewright.translate.phrases import ORDINALS
from scenewright.translate.read.attach import line_up
from scenewright.translate.read.cast import Cast
from scenewright.translate.read.clauses import Clause
from scenewright.units import UNITS, Unit, unit_of_name

COURTESIES = {"yields", "insists"}
REFRAINS = {"no stop", "no brake"}
CHANGES = (st.Verb.BRAKE, st.Verb.SPEED_UP)  # what nobody is at from the start, or on and on, unless that is said
# Slower than at a walk is as good as standing: who does not stop is this fast at least. Chosen.
_WALK = st.Amount(Fraction(1), "m/s")
_LINE = re.compile(r"^(Title:|Map:|Manner:|Parameter) (.*)$", re.MULTILINE)
_NUMBER = r"(-?\d+(?:[./]\d+)?)(?: ?([A-Za-z][A-Za-z/^0-9]*))?"
_VALUE = re.compile(rf"(\w+) is (?:open|{_NUMBER})(?:, from {_NUMBER} to {_NUMBER})?\.")


@dataclass(slots=True)
class Doing:
    """A deed that is being told; it is open while its end is not known."""

    actor: int
    verb: str
    begins: int
    ends: int | None = None
    throughout: list[st.Measure] = field(default_factory=list)
    quote: st.Quote | None = None
    lasts: list[tuple[st.Operator, st.Amount]] = field(default_factory=list)  # how long
    rests: bool = False  # no end is told: by custom it comes to a standstill
    reached: list[st.Measure] = field(default_factory=list)  # what is so at its end, whichever that is
    turns: bool = False  # it is told as a turn


@dataclass(slots=True)
class Narrative(Cast):
    """The story so far."""

    moments: list[st.Moment] = field(default_factory=lambda: [st.Moment()])
    ego: tuple[int, ...] | None = None  # the moments that it comes through, where a text lists them
    later: set[int] = field(default_factory=set)  # moments that a text tells with "then" or "later"
    doings: list[Doing] = field(default_factory=list)
    orders: list[st.Order] = field(default_factory=list)
    holds: list[st.Hold] = field(default_factory=list)
    afterwards: list[Callable[[], None]] = field(default_factory=list)  # what is read once all else is told
    pending: int | None = None  # a moment that the last sentence told, at which nobody does anything yet
    since: int | None = None  # a moment that was told after the last deed, and waits for nothing
    awaits: st.Quote | None = None  # the sentence that told nothing but a moment: what happens then must follow
    kept: list[tuple[int, st.Quote]] = field(default_factory=list)  # who keeps the speed that it has at the start
    courtesies: list[tuple[int | None, str, st.Quote]] = field(default_factory=list)  # who yields, or does not
    # Who does not do what, and whether that is so from the start.
    refrains: list[tuple[int | None, str, st.Quote, bool]] = field(default_factory=list)
    parameters: list[Parameter] = field(default_factory=list)
    manner: Manner = USUAL
    map_name: str = DEFAULT_MAP
    title: str | None = None
    asides: list[st.Quote] = field(default_factory=list)

    @property
    def told(self) -> list[Sequence[st.Condition]]:
        """What is so together, as far as it was told."""
        return st.told_in(self.moments, self.orders, (each.throughout for each in self.doings), self.holds)

    def story(self) -> st.Story:
        """Return the story; deeds that are still open end at moments of their own."""
        self.actor(EGO)  # refuses a text that does not name it
        self.pending = None
        self.settle()
        for actor, quote in self.kept:
            self._keep(actor, quote)
        for who, courtesy, quote in self.courtesies:
            self._check(who, courtesy, quote)
        for each in self.refrains:
            self._refrain(*each)
        for doing in self.doings:
            self.finish(doing)
            assert doing.ends is not None
            self.add(doing.ends, doing.reached)
            self.orders += [st.Order(doing.begins, doing.ends, *each, doing.quote) for each in doing.lasts]
        story = st.Story(
            tuple(self.actors[number] for number in sorted(self.actors)),
            tuple(self.moments),
            (),
            tuple(st.Deed(each.actor, each.verb, each.begins, each.ends or st.START, tuple(each.throughout), each.quote)
                  for each in self.doings),
            tuple(dict.fromkeys(self.orders)), tuple(self.holds), tuple(self.parameters), self.manner, self.map_name,
            self.title, tuple(self.asides), tuple(self.assumptions),
        )  # fmt: skip
        ego = st.comes_through(story, range(len(story.moments)), self._ego_comes) if self.ego is None else self.ego
        return replace(story, ego=ego, questions=tuple(self.questions))

    def _ego_comes(self, moment: int) -> bool:
        """Ask whether the ego comes through a moment after those told before, unless a word said that it does."""
        if moment in self.later:
            return True
        quote = self.moments[moment].quote or self.quote
        later, either = "it comes after the ego's moments that were told before", "it may come before or after them"
        return not self.is_first("ego", "How does this moment lie to the ego's others", [either, later], quote)

    def settle(self) -> None:
        """Refuse a moment of which it was to be said what happens then, and was not."""
        if self.awaits is not None and self.pending is None:
            self.refuse("it is not said what happens then", self.awaits, "say it in the next sentence")

    def _check(self, who: int | None, courtesy: str, quote: st.Quote) -> None:
        """Refuse a courtesy that no deed bears out; whom no program drives is refused by name."""
        if who is not None and self.actor(who).kind not in DRIVEN:
            return
        own = [doing for doing in self.doings if who in (None, doing.actor)]
        stops = any(doing.verb in (st.Verb.BRAKE, st.Verb.STAND) for doing in own)
        if not own or stops is not (courtesy == "yields"):
            self.refuse("it is not said what is done to yield, or instead", quote, "say where it stops or passes")
        ends = [each for doing in own if doing.ends is not None for each in self.moments[doing.ends].conditions]
        places = {each.place.name for each in ends if isinstance(each, st.Measure) and each.place}
        stands = any(st.standstill(doing.actor) in ends or (doing.rests and doing.ends is None) for doing in own)
        if "conflict_point" not in places and not stands:
            self.assumptions.append(f"'{quote.text}' asks for nothing of who passes first: say that besides")

    def _refrain(self, who: int | None, what: str, quote: st.Quote, always: bool) -> None:
        """Let somebody not brake, or not stop, in all that it does: from its first moment on, or always."""
        own = [doing for doing in self.doings if doing.actor == who]
        own = [doing for doing in own if always or doing.begins != st.START] or own
        if who is None or not own:
            self.refuse("it is not said what is done instead", quote, "say it, as in 'drives on without braking'")
        for doing in own:
            stands = doing.verb == st.Verb.STAND or st.standstill(who) in self.moments[self.finish(doing)].conditions
            if stands or (doing.verb == st.Verb.BRAKE and what == "no brake"):
                self.refuse("this is told, and the contrary", quote, "leave one of them out, or say to which speed")
            if doing.verb == st.Verb.SPEED_UP:
                continue
            if what == "no brake" or self.is_at_rest(doing):
                doing.throughout.append(replace(steady(who, quote), op=">="))
            else:
                doing.throughout.append(st.Measure(who, st.Quantity.SPEED, ">=", _WALK, quote=quote))
                self.assumptions.append(f"{self.actor(who).name} drives at 1 m/s at least where it does not stop")

    def finish(self, doing: Doing) -> int:
        """Return the moment at which a deed ends; one that is open is given a moment of its own."""
        if doing.ends is None:
            doing.ends = self.new_moment([st.standstill(doing.actor)] if doing.rests else [])
            rests = f"{self.actor(doing.actor).name} brakes to a standstill"
            self.assumptions += [rests] * (doing.rests and rests not in self.assumptions)
        return doing.ends

    def _keep(self, actor: int, quote: st.Quote) -> None:
        """Let somebody keep its first speed while it drives on: until its first other deed, if it has one."""
        first = next((doing for doing in self.doings if doing.actor == actor), None)
        if first is None or first.verb != st.Verb.DRIVE or first.begins != st.START:
            if actor == EGO or first is not None:
                self.refuse("it is not clear until when a speed is kept", quote)
            first = self.begin(actor, st.Verb.DRIVE, None, set())
        start = (each for each in self.moments[st.START].conditions if isinstance(each, st.Measure))
        its_speed = (actor, st.Quantity.SPEED, "==", None)
        speeds = [each for each in start if (each.actor, each.quantity, each.op, each.other) == its_speed]
        kept = speeds[0] if len(speeds) == 1 else steady(actor, quote)
        deeds = (doing for doing in self.doings if doing.actor == actor)
        for doing in takewhile(lambda each: each.verb == st.Verb.DRIVE, deeds):  # "goes first" is no change of speed
            doing.throughout += [] if doing.throughout else [kept]

    def new_moment(self, conditions: Sequence[st.Condition] = ()) -> int:
        """Add a moment and return its number."""
        self.moments.append(st.Moment(tuple(conditions), None, self.quote))
        return len(self.moments) - 1

    def add(self, moment: int, conditions: Sequence[st.Condition]) -> None:
        """Let more be so at a moment."""
        told = self.moments[moment]
        self.moments[moment] = replace(told, conditions=tuple(dict.fromkeys((*told.conditions, *conditions))))

    def moment_with(self, conditions: Sequence[st.Condition], one: bool = False) -> int | None:
        """Return the moment that is known by an event among these conditions, by any `one` of them, or by all."""
        for number, moment in enumerate(self.moments[1:], start=1):
            own = moment.conditions
            if (own and [*own] == conditions) or any(each in own and (one or st.is_event(each)) for each in conditions):
                return number
        return None

    def conditions(self, items: Sequence[Clause], *taken: str) -> list[st.Condition]:
        """Return what a list says is so; `taken` are attributes of its clauses that something else takes."""
        for item in items:
            line_up(item)
            wish = item.notes & {"wanted", "relative"}
            fast = all(each.quantity is st.Quantity.SPEED for each in item.measures)
            words = item.quote.text.lower().split()  # "when the ego, leaving the driveway, is ..."
            beside = not {"is", "are"} & {*words} and any(each.endswith("ing") for each in words)
            if item.facts and fast and not (wish or beside or item.joined or item.flags):  # "when the ego leaves it"
                self.refuse("this is no condition", item.quote, "say where it is then, or what it passes")
            if wish or not (item.turns or item.relations):
                self.tell(item)
            meant = {"wanted", "event"} <= item.notes  # "is about to pass it": then it has not
            if meant or item.says_more_than("measures", "joined", *taken):
                self.refuse("this is no condition", item.quote)
        return [condition for item in items for condition in item.conditions]

    def moment(self, items: Sequence[Clause], until: int | None = None) -> int:
        """Return the moment that a list of clauses tells, known or new; `until` is whose deed ends then."""
        for item in items:
            if "drives" in item.notes and not item.says_more_than():
                self.refuse("it is not said what is so then", item.quote)  # "is 20 m behind it and moving"
            item.flags -= {"falls"}  # what is reached is so when it is
            if "then" in item.notes:  # "until the ego is 20 m before it and then passes it"
                self.refuse("it is not clear who does this then", item.quote, "say it in a sentence of its own")
            if item.is_event and "has" in item.notes:  # "once the ego has passed it": then, or sooner
                item.measures = [replace(each, op=">=") for each in item.measures]
            if item.deed == "stop" and item.subject in {until, EGO} - {None}:  # the ego has no deeds
                item.deed, item.measures = None, [st.standstill(item.subject or EGO), *item.measures]
        events = [item for item in items if item.deed is not None]
        conditions = self.conditions([item for item in items if item not in events], "times")
        if not conditions and not any(each.deed or each.times for each in items):
            self.refuse("it is not said what is so then")  # "when the ego does"
        known = {self.event(item) for item in events}
        if len(known) > 1:
            self.refuse("two moments are told as one")
        moment = next(iter(known), self.moment_with(conditions))
        moment = self.new_moment() if moment is None else moment
        self.add(moment, conditions)
        for item in items:
            if item not in events and item.times:
                self.timed(moment, item)
        return moment

    def timed(self, moment: int, clause: Clause) -> None:
        """Take "5 s after the start"."""
        if clause.times.keys() != {"after the start"}:
            self.refuse("it is not clear what lasts so long", clause.quote)
        for op, time in clause.times["after the start"]:
            if op == "==" and self.moments[moment].time is None:
                self.moments[moment] = replace(self.moments[moment], time=time)
            else:
                self.orders.append(st.Order(st.START, moment, op, time, self.quote))

    def event(self, clause: Clause) -> int:
        """Return the moment of an event: a deed begins or ends, or something comes to be so."""
        if clause.deed is not None:
            doing = self.doing_of(clause)
            if doing is None or clause.says_more_than("deed", "phase", "ordinal", "times"):
                self.refuse("nothing was told of this deed before", clause.quote)
            if clause.phase != "finishes" and clause.deed != "stop" and "has" not in clause.notes:
                return doing.begins
            return self.finish(doing)
        if not clause.measures or clause.says_more_than("measures", "times"):
            self.refuse("this is no event", clause.quote)
        moment = self.moment_with(clause.measures, one=True)
        if moment is not None:
            self.add(moment, clause.measures)
            return moment
        if clause.subject != EGO:
            self.refuse("nothing was told of this event before", clause.quote, "say what is done until then")
        return self.new_moment(clause.measures)

    def ego_first(self, quote: st.Quote) -> None:
        """Let nobody else be past the conflict point when the ego passes it."""
        if len(self.heroes) != 1 or not self.doings:
            self.refuse("it is not said who does what for that", quote, "say what the other one does")
        self.quote, there = quote, st.Place("conflict_point")
        passes = self.ego_passes(there)
        self.add(passes, [st.Measure(self.heroes[0].id, st.Quantity.PLACE, "<", None, there, quote=quote)])
        self.later.add(passes)

    def ego_passes(self, there: st.Place) -> int:
        """Return the moment at which the ego passes a place."""
        passes = st.Measure(EGO, st.Quantity.PLACE, "==", None, there, quote=self.quote)
        return self.event(Clause(self.quote, EGO, measures=[passes]))

    def tell(self, clause: Clause) -> None:
        """Take what a clause says of somebody's way, and leave the rest."""
        if not (clause.facts or clause.relations or clause.flags & {"way", "headed"}):
            return
        if clause.subject is None:
            self.refuse("it is not clear whose way this is", clause.quote)
        self.tell_way(clause.subject, clause.facts)
        self.relate(clause.subject, *clause.relations)
        clause.facts, clause.relations, clause.flags = {}, [], clause.flags - {"way", "headed"}

    def last_of(self, actor: int | None) -> Doing | None:
        """Return what somebody does last so far."""
        return next((each for each in reversed(self.doings) if each.actor == actor), None)

    def is_owned(self, moment: int) -> bool:
        """Whether somebody begins or ends a deed at a moment."""
        return any(moment in (doing.begins, doing.ends) for doing in self.doings)

    def is_at_rest(self, doing: Doing) -> bool:
        """Whether somebody stands where it begins a deed."""
        stood = any((each.actor, each.verb, each.ends) == (doing.actor, st.Verb.STAND, doing.begins)
                    for each in self.doings)  # fmt: skip
        return stood or st.standstill(doing.actor) in self.moments[doing.begins].conditions

    def passes_nothing(self, actor: int, items: Sequence[Clause], said: set[str]) -> None:
        """Refuse an event of who stands: that is of somebody else."""
        if passes := [each.quote for each in items if each.subject == actor and said <= each.notes]:
            self.refuse("who stands passes nothing", passes[0], "say who it is that does")

    def begin(self, actor: int, verb: str, moment: int | None, leads: set[str]) -> Doing:
        """Let somebody begin a deed at a moment, or where the last one ended."""
        if actor == EGO:
            self.refuse("the ego is driven by the policy under test: say what the others do")
        self.acting.add(actor)
        before, self.since = self.last_of(actor), None
        if before is None:
            moment = self.new_moment() if moment is None and "then" in leads else moment
            if moment is not None and moment != st.START:
                waits = verb != st.Verb.BRAKE and st.standstill(actor) in self.moments[st.START].conditions
                first = st.Verb.STAND if waits else st.Verb.DRIVE
                self.doings.append(Doing(actor, first, st.START, moment, quote=self.quote))
                self.assumptions += [f"{self.actor(actor).name} stands still until then"] * waits
            begins = st.START if moment is None else moment
        elif before.ends is None and not (before.rests or (before.lasts and moment and before.verb in CHANGES)):
            begins = before.ends = self.new_moment() if moment is None else moment
        else:
            begins = self._go_on(before, verb, moment, leads)
        self.doings.append(Doing(actor, verb, begins, quote=self.quote))
        return self.doings[-1]

    def _go_on(self, before: Doing, verb: str, moment: int | None, leads: set[str]) -> int:
        """Return where a deed begins after one whose end is known; what lies between is standing or driving on."""
        # Who stands neither brakes nor passes anything.
        is_open = before.rests and before.ends is None and (verb == st.Verb.BRAKE or "passes" in leads)
        if is_open:
            ways, asked = ["for a while", "to a standstill"], f"How far does {self.actor(before.actor).name} brake"
            before.rests = not self.is_first("rests", asked, ways, before.quote or self.quote)
        ended = self.finish(before)
        stands = st.standstill(before.actor) in self.moments[ended].conditions
        sets_off = verb in (st.Verb.DRIVE, st.Verb.SPEED_UP) and before.verb != st.Verb.STAND
        waits = stands and sets_off and "at once" not in leads
        waits |= verb == before.verb and bool(leads & {"again", "later"})  # "it brakes to 5 m/s. Later it brakes ..."
        waits |= "apart" in leads and not (stands and verb == st.Verb.STAND)
        if moment == ended or (moment is None and not waits):
            return ended
        if stands and verb == st.Verb.BRAKE and not is_open:
            self.refuse("who stands does not brake", fix="say what it does in between, or who brakes")
        between = Doing(before.actor, st.Verb.STAND if stands else st.Verb.DRIVE, ended, quote=before.quote)
        between.ends = self.new_moment() if moment is None else moment
        self.doings.append(between)
        does = "stands still" if stands else "drives on"
        self.assumptions.append(f"{self.actor(before.actor).name} {does} in between")
        return between.ends

    def doing_of(self, clause: Clause) -> Doing | None:
        """Return the deed that an event speaks of: ``the hero begins to brake for the second time``."""
        verb = st.Verb.BRAKE if clause.deed == "stop" else clause.deed
        same = [each for each in self.doings if each.actor == clause.subject and each.verb == verb]
        if clause.phase == "finishes" or clause.ordinal:
            return same[clause.ordinal] if clause.ordinal < len(same) else None
        later = [each for each in same if each.begins != st.START]
        begun = later or [each for each in same if each.verb != st.Verb.DRIVE]
        if len(begun) < 2 or clause.phase is not None:  # none where it was not told to drive on
            return next(iter(begun), None)
        ways = [f"for the {ORDINALS[same.index(each)]} time" for each in begun]
        asked, last = f"Which time is meant: {clause.quote.text}", len(ways) - 1
        return begun[ways.index(self.ask(f"time {clause.quote.start}", asked, ways, last, clause.quote))]


def steady(actor: int, quote: st.Quote) -> st.Measure:
    """Return that somebody keeps its speed, whichever that is."""
    return st.Measure(actor, st.Quantity.RATE, "==", st.Amount(Fraction(0), "m/s^2"), quote=quote)


# -- lines with a label in front ------------------------------------------------------------------------------------
def take_labels(text: str, narrative: Narrative) -> str:
    """Give title, map, manner and parameters to `narrative`; return the text with their lines blank: offsets stay."""
    manner: list[tuple[str, Fraction, None]] = []
    seen = set[str]()

    def take(match: re.Match[str]) -> str:
        (label, said), value = match.groups(), _VALUE.fullmatch(match[2])
        named = label if value is None or label in ("Title:", "Map:") else f"{label} {value[1]}"
        if named in seen:
            raise UnknownWordsError("one thing is told twice", found=match[0], fix="leave one of them out")
        if label == "Title:":
            narrative.title = said
        elif label == "Map:":
            narrative.map_name = said
        elif value is None or (label == "Manner:" and value[2] is None):
            return match[0]
        elif label == "Manner:":
            manner.append((value[1], _in(unit_of(value[1]), value, 2) or Fraction(0), None))
        else:
            unit = unit_of_name(value[1])
            if unit is None:
                fix = "end its name in _m, _s, _mps or _mpss"
                raise UnknownWordsError(f"parameter {value[1]} has no unit", found=match[0], fix=fix)
            told, low, high = (each and each / unit.si_factor for at in (2, 4, 6) for each in [_in(unit, value, at)])
            narrative.parameters.append(Parameter(value[1], told, low, high))
        seen.add(named)
        return " " * len(match[0])

    text = _LINE.sub(take, text)
    if manner:
        narrative.manner = manner_of(manner)
    return text


def _in(unit: Unit, match: re.Match[str], at: int) -> Fraction | None:
    """Return an amount in SI units, which is one of `unit` where no other is told; None where it is open."""
    told = UNITS.get(match[at + 1] or unit.symbol)
    if told is None or told.dimension != unit.dimension:
        raise UnknownWordsError(f"'{match[at + 1]}' is no unit of {unit.dimension}", found=match[0])
    return None if match[at] is None else Fraction(match[at]) * told.si_factor
