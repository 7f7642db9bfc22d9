"""Reads sentences: gives what each clause says to the narrative, by the links between them.

What enters: a text, and answers to questions. What leaves: a `Story` with what was set aside, assumed and asked; or an
error that quotes the words that nothing could be made of.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from typing import NoReturn

from scenewright.errors import Place as Where
from scenewright.errors import Span, TranslationError
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.read import items as cut
from scenewright.translate.read import leads
from scenewright.translate.read.acts import acts_of, lasting, let_stand, unknown_to_programs
from scenewright.translate.read.chunks import Chunk, sentences
from scenewright.translate.read.clauses import PEOPLE, Clause
from scenewright.translate.read.deeds import read_deed
from scenewright.translate.read.narrative import Narrative, take_labels
from scenewright.translate.read.points import HOW, event_of, put_in_order, read_ego_order, read_hold

_SAYS_NOTHING = {"unknown", "comma", "harmless", "again", "be", "joint", "quality", "name", "mood", "other"}
_COMMENT = {*_SAYS_NOTHING, "comment", "actor", "relative", "yields", "insists", "refrains", "order", "side", "link"}
_AT_ONCE = {"then", "at once", "same time"}


def read(text: str, answers: Mapping[str, str] | None = None, name: str = "description") -> st.Story:
    """Return the story that `text` tells; what `answers` does not answer, by slot, takes its default and is noted."""
    narrative = Narrative(text, answers or {})
    told = sentences(take_labels(text, narrative))
    names_ego = any((chunk.kind, chunk.value) == ("actor", "ego") for chunks in told for chunk in chunks)
    for chunks in told:
        narrative.quote = st.Quote(chunks[0].start, chunks[-1].end, text[chunks[0].start : chunks[-1].end])
        narrative.assumptions += [f"'{chunk.text}' is read with '{word}'" for chunk in chunks for word in chunk.slips]
        kinds = {chunk.kind for chunk in chunks}
        first = next((chunk.value for chunk in chunks if chunk.kind in ("actor", "name")), "ego")
        if kinds <= _SAYS_NOTHING or ("comment" in kinds and kinds <= _COMMENT and first == "ego"):
            narrative.asides.append(narrative.quote)
            continue
        chunks = [chunk for chunk in chunks if chunk.kind not in ("harmless", "again")]
        try:
            for part in cut.parts_of(chunks):
                sentence = _Sentence(narrative, part, leads.Leads([], {"again"} & kinds, pending=narrative.pending))
                narrative.pending = None
                sentence.read()
            narrative.settle()
        except TranslationError as error:
            if (unknown := unknown_to_programs(chunks)) is None and narrative.is_open:
                continue  # that is asked about first
            error = unknown or error
            error.place = error.place or Where(name, text, narrative.quote.span)
            raise error from None
    try:
        for each in narrative.afterwards:
            each()
        story, later = narrative.story(), narrative.told_later()
        return read(text, {**narrative.answers, **later}, name) if later else story
    except TranslationError as error:
        if narrative.is_open and names_ego:
            return st.Story((), questions=tuple(narrative.questions))  # that is asked about first
        at = text.find(error.found or text)
        error.place = error.place or Where(name, text, Span(at, at + len(error.found or text)))
        raise


@dataclass(slots=True)
class _Sentence:
    story: Narrative
    chunks: list[Chunk]
    led: leads.Leads
    lasting: list[st.Condition] = field(default_factory=list)  # what is so as long as it is done

    def read(self) -> None:
        self.story.mentioned, self.story.meant, self.story.doer = [], [], None
        self.chunks = cut.plainly(self.story.known_words(self.chunks))
        self.story.named = [chunk for chunk in self.chunks if chunk.kind in PEOPLE]
        how = next((chunk for chunk in self.chunks if chunk.kind == "link" and chunk.value in HOW), None)
        if self.chunks and self.chunks[0].kind == "ego's order":
            read_ego_order(self.story, self.chunks)
        elif how is not None:
            read_hold(self.story, self.chunks, how)
        elif self.chunks:
            self.led = replace(leads.leads_of(self.story, self.chunks, self.led.words), pending=self.led.pending)
            self.chunks = self.led.chunks
            known, is_later = len(self.story.moments), bool(self.led.words & {"then", "later"})
            self._cut()
            if self.led.delay is not None:
                self.story.refuse("it is not clear what is so much later", fix="say who does what then")
            self.story.later |= {*range(known, len(self.story.moments))} if is_later else set()

    def _cut(self) -> None:
        """Cut the sentence into what happens, the moment at which it does, and the rest."""
        story, (main, *rest) = self.story, cut.segments_of(self.chunks, bool(self.led.words))
        if not main.chunks and rest and rest[0].link in ("before", "after", "until"):
            rest[0].chunks, main.chunks = cut.parted(rest[0].chunks)  # "2 s after ..., the hero brakes"
            rest[0].is_first = True
            if any(each.kind == "place" for each in rest[0].chunks):  # which "it" may mean, and is read later
                story.place = None
        later = next((each for each in rest if each.link == "when"), None)
        rest = [each for each in rest if each is not later]
        when, is_while, known = None, False, len(story.doings)
        if later is not None and not main.chunks:  # the moment stands in front, and is read first
            when, is_while, later = self._front(later, main), later.lasts, None
        if rest and rest[0].is_first:  # "after it has stopped, the truck ..."
            rest[0].chunks = story.settled(rest[0].chunks, main.chunks)
        if cut.wishes_otherwise(main.chunks):
            story.refuse("it is not clear what is done, and what is only meant to be")
        tail = self._tail(main.chunks, later, rest)
        main.chunks, during = cut.during_of([*main.chunks, *tail])
        items = cut.items_of(story, main.chunks, story.subject)
        is_more = when and any(each.kind in ("amount", "bound", "side") for each in main.chunks[:1])
        if is_more and not any("said" in each.notes or each.flags for each in items):
            story.refuse("it is not clear of whom this is", items[0].quote)  # "Trigger: the ego is at it, 5 m/s"
        if during:
            if when and sum(each.deed is not None for each in items) > 1:
                story.refuse("it is not clear how long this is so", fix="say it of one deed, in a sentence of its own")
            told, is_while = cut.items_of(story, during), True
            when, self.lasting = [*(when or ()), *told], [*self.lasting, *leads.all_the_while(story, told)]
        if later is not None:
            when = [*(when or ()), *leads.told_moment(story, later)]
        self.led.is_of_last = (later is not None or bool(during)) and not tail
        self._main(items, when, rest)
        deeds = sum(each.deed is not None for each in items)
        if (is_while and known == len(story.doings)) or (self.lasting and deeds > 1):
            story.refuse("it is not clear how long this is so")
        for each in self.lasting:
            start, end = st.Point(story.doings[-1].begins), st.Point(story.finish(story.doings[-1]))
            story.holds.append(st.Hold("always", start, end, each, story.quote))

    def _front(self, moment: cut.Segment, main: cut.Segment) -> list[Clause]:
        """Return what is so at a moment that stands in front of what happens."""
        if any(chunk.kind in ("comma", "deed") for chunk in moment.chunks):
            moment.chunks, main.chunks = cut.parted(moment.chunks)
        moment.chunks = self.story.settled(moment.chunks, main.chunks)
        when = leads.told_moment(self.story, moment)
        self.lasting = leads.all_the_while(self.story, when) if moment.lasts else []
        return when

    def _tail(self, main: list[Chunk], moment: cut.Segment | None, rest: list[cut.Segment]) -> list[Chunk]:
        """Take what is done besides off a moment that stands behind what is done."""
        deeds, tail = [each for each in main if each.kind in ("deed", "state")], list[Chunk]()
        if moment is not None and deeds:
            moment.chunks, tail = cut.tail_of(moment.chunks)
        does_more = any(cut.goes_on_in(each.chunks) for each in rest if each.link == "until" and deeds)
        if does_more or (tail and (len(deeds) > 1 or not leads.is_of_who_acts(self.story, main, tail))):
            self.story.refuse("it is not clear who does this, or when", fix="say it in a sentence of its own")
        return tail

    def _main(self, items: list[Clause], when: list[Clause] | None, rest: list[cut.Segment]) -> None:
        """Give the narrative deeds, a moment, an order of two, what is so until a moment, or facts."""
        story, until = self.story, any(each.link == "until" for each in rest)
        if any("stays" in each.notes for each in (*items, *(when or ()))) and (not until or any(i.deed for i in items)):
            story.refuse("it is not said until when this is so", fix="say it: 'stays 20 m ahead of it until it brakes'")
        items = [each for each in items if each.says_more_than()] or items[:1]
        does = any("shall" in each.notes and not each.says_more_than() for each in items)  # "so does the hero"
        if when is not None and any(each.subject is not None and not each.says_more_than() for each in items):
            story.refuse("nothing is said here", items[0].quote)  # "when ..., the hero is, too"
        items = acts_of(story, items, self._happens(items, when, rest))
        if not items and when is None:
            if rest or does or (self.led.words & _AT_ONCE and story.named):
                story.refuse("it is not said what is done")
            return
        items, when = self._parted(items, when)
        first = items[0] if items else Clause(story.quote)
        tells_time = any(each.link in cut.ORDERS for each in rest) or "after the start" in first.times
        self._let_be_done(first, until, tells_time)
        # "The hero begins to brake 2 s after ..." speaks of a deed that was told before.
        known = first.phase and story.doing_of(first) is not None and when is None and not self.led.words
        if first.deed and len(items) > 1:
            self._several(items, when, rest)
        elif first.deed and not (known and tells_time):
            read_deed(story, self.led, first, when, rest)
        elif when is not None:
            self._moment(items, when, rest)
        elif tells_time:
            if len(items) > 1:
                story.refuse("only one event is before or after another")
            moment = story.event(first)
            if first.times:
                story.timed(moment, first)
            put_in_order(story, moment, rest)
        elif len(rest) == 1 and until and not self.led.words:
            self._until(items, rest[0])
        elif rest:
            story.refuse("it is not clear when this is so")
        else:
            self._facts(items)

    def _happens(self, items: list[Clause], when: list[Clause] | None, rest: list[cut.Segment]) -> bool:
        """Whether a turn, a speed or an event that is told is done then."""
        if any(each.times for each in when or ()) and all(each.deed is None for each in items):
            return False  # "5 s after the start, the hero drives at 8 m/s" tells what is so
        is_led = bool(self.led.words & _AT_ONCE) or when is not None or self.led.pending is not None
        return is_led or (any(each.is_first for each in rest) and not items[0].is_event)  # that may be a known one

    def _parted(self, items: list[Clause], when: list[Clause] | None) -> tuple[list[Clause], list[Clause] | None]:
        """Part what is so in front of a deed from what is done: it is so at the moment, or at the start."""
        acts = next((at for at, each in enumerate(items) if each.deed), 0)
        if acts and "then" in items[acts].notes:
            self.story.refuse("it is not clear when this is done", items[acts].quote, "say it in a sentence of its own")
        if when is None or any(each.is_event for each in items[:acts]):
            return items, when
        states, items, ways = items[:acts], items[acts:], ("at the start", "at that moment")
        early = any(each.conditions for each in states) and self.led.is_of_last and not self.story.doings
        if early and self.story.is_first("state", "When is this", ways, states[0].quote):
            self._facts(states)  # "a van is 50 m ahead and brakes when ..."
            return items, when
        return items, [*when, *states]  # "when ..., the hero is 20 m before it and brakes"

    def _let_be_done(self, first: Clause, until: bool, tells_time: bool) -> None:
        """Let what is told to last, to end a deed, or to come before or after something be a deed."""
        story, last = self.story, self.story.last_of(first.subject)
        if until and not any(cut.is_beside(each) for each in first.measures):
            lasting(first)  # "drives 20 m ahead of the ego until ..." is so, and nothing that it does
        if last is not None and last.rests and last.ends is None:  # "it brakes at 2 m/s^2. It stands 10 m before ..."
            let_stand(first, "stop")
        is_new = first.subject != EGO and first.is_event and story.moment_with(first.measures, one=True) is None
        if tells_time and story.doings and is_new:
            first.deed = st.Verb.DRIVE  # "... It passes the conflict point before the ego"

    def _several(self, items: list[Clause], when: list[Clause] | None, rest: list[cut.Segment]) -> None:
        """Take one deed after the other: "it brakes to a stop, waits for 3 s and drives on"."""
        story, ways = self.story, ("the last of these deeds", "the first of them")
        who, both = {each.subject for each in items}, "both" in items[0].notes
        one = len(who) == 1 and all(each.deed for each in items) and not both
        before = any(each.is_first and each.link == "before" for each in rest)  # the first of them, or all of them
        late = (self.led.is_of_last or before) and one
        late = late and story.is_first("last", "What begins then", ways, story.quote)
        until = any(each.is_first and each.link == "until" for each in rest) and len(who) > 1 and not both
        if until or (both and self.led.is_of_last and len(items) > len(who)):
            story.refuse("it is not clear who does what then", fix="say it of each, in a sentence of its own")
        then, when, begun = when, None if late else when, set[int | None]()
        # What stands in front dates the first of them, what stands behind the last; of both, where it is told of both.
        fronts = [each for each in rest if each.is_first and not (late and each.link == "before")]
        for at, (item, following) in enumerate(zip_longest(items, items[1:])):
            is_first, is_last = not at, following is None
            if "both" in item.notes:
                is_first = item.subject not in begun
                is_last = all(each.subject != item.subject for each in items[at + 1 :])
            own = [each for each in rest if (is_first if each in fronts else is_last)]
            self._main([item], then if late and following is None else when, own)
            begun |= {item.subject} if item.deed else set()
            if following is not None and not following.deed and following.measures:
                acts = [each.deed for each in items[at + 2 : at + 3] if each.subject == following.subject]
                if not any(acts) or following.subject in begun:  # not "... and the car is 20 m before it and brakes"
                    story.refuse("it is not clear when this is so", following.quote)  # "... and the car at 6 m/s"
            if following is not None and self._goes_on(item, following, begun, when is None and then is not None):
                when = None
            elif following is not None and when is None and following.subject != item.subject:
                self.led.words = {"same time"}  # "then one brakes and another speeds up"

    def _goes_on(self, item: Clause, following: Clause, begun: set[int | None], is_over: bool) -> bool:
        """Whether a deed comes after that before it; `is_over` where what was told of when they are is."""
        story, same = self.story, following.subject == item.subject
        if same and (item.deed, item.phase) == ("turn", "begins"):
            story.refuse("it is not clear whether it completes its turn", item.quote)
        if same and "same time" in following.notes:
            story.refuse("two deeds at one time are told of one")
        two = "both" in following.notes and following.quote.end == item.quote.end
        then_too = not two and ("then" in following.notes or "later" in following.times)
        if then_too or following.subject in begun:  # who did something goes on from there, whatever others do
            self.led.words, self.led.pending = {"then"}, None
            own = story.last_of(following.subject)
            if own is not None and not same and ("both" in following.notes or not then_too):
                self.led.own = own.verb
            return True
        if is_over and not (
            two or "same time" in following.notes
        ):  # "when ..., the car brakes and waits and the truck speeds up"
            story.refuse("it is not clear when this is done", following.quote, "say it in a sentence of its own")
        return False

    def _moment(self, items: list[Clause], when: list[Clause], rest: list[cut.Segment]) -> None:
        """Take a moment, what else is so at it, and its order: what is done at it may still follow."""
        story = self.story
        if items and items[0].subject == EGO and items[0].is_event and not any(each.times for each in when):
            story.refuse("the ego is driven by the policy under test", fix="say what the others do then")
        moment = self.led.moment_of(story, when)
        if (story.moments[moment].time is None or not items) and not story.is_owned(moment):
            story.settle()
            story.pending, story.awaits = moment, None if items or rest else story.quote
        elif not story.is_owned(moment):
            story.since = moment
        story.add(moment, story.conditions(items))
        story.subject = next((each.subject for each in reversed(items) if each.subject is not None), story.subject)
        put_in_order(story, moment, rest)

    def _until(self, items: list[Clause], until: cut.Segment) -> None:
        """Take what is so all the while until a moment: "The truck is at least 20 m ahead until it brakes"."""
        story, conditions = self.story, self.story.conditions(items)
        comes = any(map(st.is_event, conditions))  # "until ..., it passes the stop line": that is not so all the while
        if not conditions or comes or (until.margins and [op for op, _ in until.margins] != ["=="]):
            story.refuse("it is not clear when this is so")
        quote, doer, before = story.quote, items[-1].subject, story.doings[-1] if story.doings else None
        offset = next((amount for _, amount in until.margins), None)

        def hold() -> None:
            story.quote, story.doer = quote, doer
            end = event_of(story, until.chunks)
            start, begins = st.START, {doing.begins for doing in story.doings}
            if before is not None and end not in begins:
                ways = ["from the start", "from when that is over which was told before"]
                if not story.is_first("until", "From when is this so", ways, quote):
                    start = story.finish(before)
            point = st.Point(end, offset, until.side == "before")
            story.holds += [st.Hold("always", st.Point(start), point, each, quote) for each in conditions]

        if any((chunk.kind, chunk.value) == ("actor", "ego") for chunk in until.chunks[:1]):
            hold()  # its moments come in the order in which they are told
        else:
            story.afterwards.append(hold)  # what is done then may be told later

    def _facts(self, items: list[Clause]) -> None:
        """Take what is so at the start, all the while, later, or of somebody's way."""
        story, words, pending = self.story, self.led.words, self.led.pending
        for item in items:
            self._tell(item)
        conditions = story.conditions(items)
        measures = [each for each in conditions if isinstance(each, st.Measure)]
        if not conditions or "start" in words:
            story.pending = pending  # what happens then is still to come
        if not conditions:
            if all(each.subject is None for each in items):
                story.refuse("nothing is said here")
        elif "meanwhile" in words and any("pass" in each.notes for each in items):
            self._when_unclear()  # what comes to be so is not so all the while
        elif "meanwhile" in words and story.doings and len(measures) == len(conditions):
            story.doings[-1].throughout += measures
        elif "then" in words and story.doings and {each.subject for each in items} == {EGO}:
            story.since = leads.moment_led_to(story, items[0], self.led, False)  # "Then the ego ..."
            story.add(story.since or st.START, conditions)
            self.led.delay = None
        elif "later" in words:
            story.since = story.new_moment(conditions)
        elif "same time" in words and (at := leads.same_time(story, words) if pending is None else pending) is not None:
            story.add(at, conditions)
            story.pending = pending
        elif "start" in words or not (story.doings or pending is not None or words - {"meanwhile"}):
            rates = any(each.quantity is st.Quantity.RATE for each in measures)
            comes = any({"event", "comes"} & each.notes and each.measures for each in items)
            if "start" not in words and (rates or comes):  # "its deceleration is 3 m/s^2"
                self._when_unclear()  # "the hero crosses the stop line at 5 m/s", "drives to it", "turns at 5 m/s"
            story.add(st.START, conditions)
        else:
            self._when_unclear()

    def _tell(self, item: Clause) -> None:
        """Take what is said of somebody's way, of a speed that it keeps, and what is told to be so at the start."""
        story, later = self.story, self.led.words & {"then", "later", "same time", "meanwhile"}
        sides = {each.kind for each in item.relations} & {"ahead", "behind"}
        acts = any(doing.actor == item.subject for doing in story.doings)
        told = bool(item.facts) and acts and story.actor(item.subject or EGO).way != st.Way()  # "It drives west"
        turns = [*item.facts] == ["turn"] and item.turns
        if told or (acts and turns) or (later and (sides or (item.facts and story.doings))):
            self._when_unclear()  # which way one goes, and on whose side it is, is told of the start alone
        story.tell(item)
        if item.subject is not None:
            story.subject = None if "both" in item.notes else item.subject
            if "kept" in item.flags and acts:  # "brakes and keeps its speed"
                story.refuse("it is not clear when a speed is kept", item.quote, "say it before what is done")
            story.kept += [(item.subject, item.quote)] * ("kept" in item.flags)
            item.flags -= {"kept"}
        if "start" in item.flags:
            item.flags -= {"start"}
            story.add(st.START, story.conditions([item]))
            item.measures = []

    def _when_unclear(self) -> NoReturn:
        fix = "begin it with 'At the start,' or 'Later,', or say it of a deed: 'drives on until ...'"
        self.story.refuse("it is not clear when this is so", fix=fix)
