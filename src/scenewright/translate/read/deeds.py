"""Reads what somebody does: when it begins, what is so then and all through it, where it ends, how long it lasts.

What enters: the clause of a deed, and what its sentence says of when it is. What leaves: a deed of the narrative. What
a clause leaves out by custom (who turns does so from the beginning of its turn to its end) is put in here.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.read.acts import shares_of
from scenewright.translate.read.clauses import Clause, agree, is_upper
from scenewright.translate.read.items import ORDERS, Segment, items_of
from scenewright.translate.read.leads import Leads, moment_led_to, told_before
from scenewright.translate.read.narrative import CHANGES, Doing, Narrative, steady
from scenewright.translate.read.points import put_in_order

_VERBS = {"stop": st.Verb.BRAKE, "turn": st.Verb.DRIVE, "go first": st.Verb.DRIVE}


def read_deed(story: Narrative, led: Leads, clause: Clause, when: list[Clause] | None, rest: list[Segment]) -> None:
    """Take what somebody does: at the moment `when`, else as the words in front lead to it; `rest` dates it."""
    if clause.subject is not None and clause.subject != EGO:
        story.tell(clause)
    more = clause.says_more_than("deed", "phase", "measures", "rates", "times", "flags", "begins")
    if clause.subject is None or clause.deed is None or more or clause.flags & {"first", "way", "start", "falls"}:
        story.refuse("it is not clear what is done here")
    if clause.phase == "finishes" or "after the start" in clause.times:
        story.refuse("nothing was told of this deed before")
    if "at it" in clause.notes:  # "when ..., the car has braked to a stop"
        fix = "say what is so then, and before that what it did until then"
        story.refuse("what began before cannot be told so", clause.quote, fix)
    if sum(each.link == "until" for each in rest) > 1:
        story.refuse("two ends of one deed are told")
    if turned := led.own.partition("turn ")[2]:  # "after turning left, it ..."
        story.tell_way(clause.subject, {"turn": turned})
    if led.is_of_last and clause.phase == "begins" and not clause.says_more_than("deed", "phase"):
        last = story.last_of(clause.subject)  # "It brakes to a stop. It begins to brake when ..."
        if last is not None and last.verb == clause.deed and "again" not in led.words:
            story.refuse("this was told before", clause.quote, "say in that sentence when it begins")
    _Deed(story, led, clause, clause.subject, clause.deed, when, rest).read()


@dataclass(slots=True)
class _Deed:
    """A deed while it is read."""

    story: Narrative
    led: Leads
    clause: Clause
    actor: int
    deed: str
    when: list[Clause] | None
    rest: list[Segment]
    begins: list[st.Measure] = field(default_factory=list)  # what its clause says of its beginning,
    held: list[st.Measure] = field(default_factory=list)  # of all of it,
    ends: list[st.Measure] = field(default_factory=list)  # and of its end
    again: Doing | None = None  # the deed that is told once more
    is_event: bool = False  # that it ends is what is told: "it passes the stop line"
    dates_begin: bool = False  # what comes before or after it does so to its beginning,
    dates_end: bool = False  # or to its end

    def read(self) -> None:
        story, clause, led = self.story, self.clause, self.led
        if self.when is None and led.pending is not None:
            story.awaits = None
        elif self.when is None and not led.words:
            self.again = told_before(story, clause)
        self.begins, self.held, self.ends = shares_of(story, clause)
        last = story.last_of(self.actor)
        if led.own.startswith("turn") and (last is None or not last.turns):
            self.begins.append(replace(self._at("turn_end"), op=">="))
        moment = self._moment()
        if "kept" in clause.flags and not self.held:  # "continues at a constant speed"
            if self.deed != st.Verb.DRIVE:
                story.refuse("it is not clear what is kept here")
            self.held.append(steady(self.actor, clause.quote))
        # "It brakes 15 m before the stop line", or what it did before: this says when it begins.
        is_placed = bool(self.begins) and self.deed != st.Verb.STAND
        self._put_in_places(moment)
        self.is_event = "event" in clause.notes
        ways = ("some time after that", "at that moment")  # "when the ego stands, the van passes the stop line"
        passes = self.ends and self.is_event and self.when is not None and not self.rest
        if passes and not story.is_first("event", "When is this", ways, clause.quote):
            self.begins, self.ends = [*self.begins, *self.ends], []
        self._find_what_is_dated()
        doing = self._begin(moment, is_placed)
        self._fill(doing)
        self._end(doing, next((each for each in self.rest if each.link == "until"), None))
        self._put_in_order(doing)
        if clause.rests and "for" in clause.times:  # "stops for 3 s"
            if self.deed != "stop":
                story.refuse("it is not clear what lasts so long")
            story.begin(self.actor, st.Verb.STAND, None, set()).lasts += dict.fromkeys(clause.times["for"])

    @property
    def verb(self) -> str:
        return _VERBS.get(self.deed, self.deed)

    def _moment(self) -> int | None:
        """Return the moment at which it begins; None where that is the end of the deed before."""
        story, clause, led = self.story, self.clause, self.led
        if self.when is not None:
            if led.delay is not None:  # "2 s later it brakes when ..."
                story.refuse("it is told to begin at two times", clause.quote, "say one of them")
            led.pending = led.moment_of(story, self.when)
        for delay in clause.times.pop("later", ()):  # "brakes 1 s later"
            if led.delay is not None:
                story.refuse("it is not clear what is so much later", clause.quote)
            led.delay = delay
        if self.again is None and (led.delay is not None or led.pending is None):
            is_tied = bool(self.begins) or any(each.link in ORDERS for each in self.rest)
            moment = moment_led_to(story, clause, led, is_tied)
            led.delay, led.own = None, ""
            return moment
        if led.own:  # "when the ego is 20 m behind it after braking, ..."
            story.refuse("it is not clear after what this is done", clause.quote)
        return led.pending

    def _put_in_places(self, moment: int | None) -> None:
        """Let who turns do so from the beginning of its turn to its end, and who goes first pass the conflict point."""
        story = self.story
        if self.deed == "turn":
            told = [*(() if moment is None else story.moments[moment].conditions)]
            start = story.moments[st.START].conditions
            told += start if st.standstill(self.actor) in start else ()  # it turns from where it stands
            stood = story.last_of(self.actor)
            since = () if stood is None else (stood.begins, stood.ends)[stood.verb != st.Verb.STAND :]
            told += [each for at in since if at is not None for each in story.moments[at].conditions]
            # Where it is told where it is then, it turns later.
            if not any(isinstance(each, st.Measure) and each.actor == self.actor and each.place for each in told):
                self.begins.append(self._at("turn_start"))
            self.ends = self.ends or [self._at("turn_end")]  # "turns left and passes the conflict point"
        elif self.deed == "go first":
            self.ends.append(self._at("conflict_point"))

    def _find_what_is_dated(self) -> None:
        """Find out whether what dates it is of when it begins, "begins to brake to a stop 2 s before ...", or ends."""
        dating = [each for each in self.rest if each.link in ORDERS and not each.is_first]
        turns = self.deed == "turn" and self.when is not None  # "when ..., it turns left after the ego has passed it"
        dated = [each.link for each in dating if each.margins or (turns and each.link == "after")]
        if "after" in dated and self.deed == st.Verb.STAND:
            fix = "say 'until ... after', or when it begins"
            self.story.refuse("it is not clear what lasts so long", self.clause.quote, fix)
        self.dates_begin = self.clause.phase == "begins"
        # "When ..., it brakes to a stop within 2 s after ...": the moment says when it begins, this when it has.
        self.dates_end = self.when is not None and bool(self.ends)
        whole = self.deed == "turn" or (bool(self.ends) and not self.is_event and self.led.pending is None)
        if dated and whole and not self.dates_begin:  # "brakes to a stop 2 s after ..."
            ways, is_later = ("when that begins", "when that is over"), dated[0] != "after" or self.deed == "turn"
            self.dates_begin = self.story.is_first("dated", "When is this", ways, self.clause.quote, int(is_later))
            self.dates_end, self.is_event = not self.dates_begin, self.is_event and not self.dates_begin

    def _is_of_beginning(self, dating: Segment) -> bool:
        """Whether what stands in front dates what is done, or this its beginning; a mere event has none."""
        if self.is_event and not (dating.is_first and "does" in self.clause.notes):
            return False
        return self.dates_begin or dating.is_first or (dating.link == "after" and not self.dates_end)

    def _begin(self, moment: int | None, is_placed: bool) -> Doing:
        """Begin it in the narrative; `is_placed` where its own clause says where it begins."""
        story, clause = self.story, self.clause
        verb, sets_off = self.verb, "sets off" in clause.notes
        orders = [each for each in self.rest if each.link in ORDERS]
        orders = [each for each in orders if not self.is_event or self._is_of_beginning(each)]
        led = self.led.words | ({"passes"} if verb == st.Verb.DRIVE and "event" in clause.notes else set())
        # Where this says when it begins, and not what it did before.
        if is_placed or any(self._is_of_beginning(each) or (each.margins and not self.ends) for each in orders):
            if "start" in led:  # "At the start, it brakes 15 m before the stop line"
                story.refuse("it is told to begin at the start, and at another time", clause.quote, "say one of them")
            led |= {"then", "apart"}
        led |= {"then"} if orders and verb in CHANGES and "start" not in led else set()  # not from the start
        if sets_off and story.last_of(self.actor) is None:
            story.add(st.START, [st.standstill(self.actor)])
            _agree(story.moments[st.START].conditions, clause.quote)
        doing = self.again or story.begin(self.actor, verb, moment, led)
        if story.is_at_rest(doing):  # "it brakes to a stop. When it passes it, ..."
            story.passes_nothing(self.actor, self.when or (), {"event"})
        elif sets_off:
            story.refuse("it was not told that it stands", clause.quote, "say so, or that it drives on")
        doing.turns |= self.deed == "turn"
        story.subject = self.actor
        return doing

    def _fill(self, doing: Doing) -> None:
        """Let be so at its beginning and all through it what its clause says, and last so long."""
        story, clause, held = self.story, self.clause, self.held
        if self.begins:
            _agree((*story.moments[doing.begins].conditions, *self.begins), clause.quote)
            story.add(doing.begins, self.begins)
        if self.verb == st.Verb.DRIVE and story.is_at_rest(doing):  # no speed from rest on is held: it is reached
            if "kept" in clause.flags:
                story.refuse("who stands has no speed to keep", clause.quote, "say until when it speeds up")
            reached = [each for each in held if is_upper(each) is not True]
            first = f"{story.actor(doing.actor).name} stands when it sets off: it comes to its speed by the end of that"
            story.assumptions += [first] * bool(reached)
            held, doing.reached = [each for each in held if each not in reached], reached
        doing.throughout += [each for each in dict.fromkeys((*held, *clause.rates)) if each not in doing.throughout]
        if self.again is not None:
            agree(doing.throughout, clause.quote)
        if "to" in clause.flags and "for" in clause.times and self.deed in CHANGES:  # "brakes to 5 m/s for 4 s"
            story.refuse("it is not clear what lasts so long", clause.quote, "say 'in', or that it keeps that speed")
        lasts = (*([] if clause.rests else clause.times.get("for", ())), *clause.times.get("in", ()))
        doing.lasts += dict.fromkeys(lasts)
        agree((st.Measure(self.actor, st.Quantity.ARRIVAL, *each) for each in doing.lasts), clause.quote)
        if "while" in clause.flags and self.ends:
            story.refuse("it is not clear when this ends")

    def _end(self, doing: Doing, until: Segment | None) -> None:
        """End it as its clause says, at the moment until which it is told to last, or both."""
        story, clause, ends, told = self.story, self.clause, self.ends, list[st.Condition]((*self.ends, *doing.reached))
        foreign = until is not None and bool(ends) and bool(until.chunks) and until.chunks[0].kind in ("actor", "name")
        if until is not None and (doing.ends is not None or (foreign and not until.side)):
            story.refuse("two ends of one deed are told", clause.quote)
        if until is not None and until.side:  # "until 1 s after the ego passes it"
            doing.ends = story.new_moment(ends)
            put_in_order(story, doing.ends, [Segment(until.side, until.chunks, until.margins)])
        elif until is not None:
            story.doer = doing.actor
            items = items_of(story, until.chunks)
            story.doer = None
            doing.ends = story.moment(items, doing.actor)
            if doing.verb == st.Verb.STAND:  # "it waits until it has passed it"
                story.passes_nothing(doing.actor, items, {"event", "has"})
            if any((each.actor, each.begins) == (doing.actor, doing.ends) for each in story.doings):
                story.refuse("this is over before it begins", clause.quote, "say it in front of what is done then")
            told += story.moments[doing.ends].conditions if told else ()  # "speeds up to 5 m/s until it is at 6 m/s"
            story.add(doing.ends, ends)
        elif ends and doing.ends is not None:  # it is told once more
            told += story.moments[doing.ends].conditions
            story.add(doing.ends, ends)
        elif ends:
            doing.ends = story.new_moment(ends)
        doing.rests = doing.verb == st.Verb.BRAKE and "while" not in clause.flags and not doing.lasts
        _agree(told, clause.quote)

    def _put_in_order(self, doing: Doing) -> None:
        """Take what its beginning or its end comes before or after."""
        story = self.story
        if self.deed == "go first":  # it passes before the ego does
            with_whom = None if self.actor == story.heroes[0].id else self.actor  # a bare one is that with the first
            passes = story.ego_passes(st.Place("conflict_point", None, with_whom))
            story.orders.append(st.Order(doing.ends or st.START, passes, ">", None, story.quote))
        at_end = self.again is not None and self.deed == "stop"
        for each in self.rest:
            if each.link == "until":  # "... until it passes the conflict point 1 s before the ego"
                at_end = True
                continue
            late = at_end or not (self._is_of_beginning(each) or not self.ends)
            late = late and (doing.ends is not None or doing.rests)
            put_in_order(story, story.finish(doing) if late else doing.begins, [each])

    def _at(self, place: str) -> st.Measure:
        return st.Measure(self.actor, st.Quantity.PLACE, "==", None, st.Place(place), quote=self.story.quote)


def _agree(conditions: Iterable[st.Condition], quote: st.Quote) -> None:
    agree((each for each in conditions if isinstance(each, st.Measure)), quote)
