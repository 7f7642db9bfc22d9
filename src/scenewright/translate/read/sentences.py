"""Reads sentences: gives what each clause says to the narrative, by the links between them.

What enters: a text, and answers to questions. What leaves: a `Story` with what was set aside, assumed and asked; or an
error that quotes the words that nothing could be made of.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from typing import NoReturn

from scenewright.errors import Place as Where
from scenewright.errors import Span, TranslationError
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.read import items as cut
from scenewright.translate.read import leads
from scenewright.translate.read.acts import acts_of, lasting, shares_of, unknown_to_programs
from scenewright.translate.read.chunks import Chunk, sentences
from scenewright.translate.read.clauses import PEOPLE, Clause, agree, is_upper
from scenewright.translate.read.narrative import CHANGES, Doing, Narrative, steady, take_labels
from scenewright.translate.read.points import HOW, event_of, put_in_order, read_ego_order, read_hold

_SAYS_NOTHING = {"unknown", "comma", "harmless", "again", "be", "joint", "quality", "name", "mood", "other"}
_COMMENT = {*_SAYS_NOTHING, "comment", "actor", "relative", "yields", "insists", "refrains", "order", "side", "link"}


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
                sentence = _Sentence(narrative, part, narrative.pending, leads.Leads([], {"again"} & kinds))
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
    pending: int | None  # a moment that was told just before, and nobody did anything at it
    led: leads.Leads
    moment: int | None = None  # that it tells
    lasting: list[st.Condition] = field(default_factory=list)  # what is so as long as it is done
    is_of_last: bool = False  # its moment stands behind what is done: it is of the last deed

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
            self.led = leads.leads_of(self.story, self.chunks, self.led.words)
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
            if any(chunk.kind in ("comma", "deed") for chunk in later.chunks):
                later.chunks, main.chunks = cut.parted(later.chunks)
            later.chunks = story.settled(later.chunks, main.chunks)
            when, is_while, later = leads.told_moment(story, later), later.lasts, None
            self.lasting = leads.all_the_while(story, when) if is_while else []
        if rest and rest[0].is_first:  # "after it has stopped, the truck ..."
            rest[0].chunks = story.settled(rest[0].chunks, main.chunks)
        if cut.wishes_otherwise(main.chunks):
            story.refuse("it is not clear what is done, and what is only meant to be")
        told_deeds = [each for each in main.chunks if each.kind in ("deed", "state")]
        tail: list[Chunk] = []
        if later is not None and told_deeds:
            later.chunks, tail = cut.tail_of(later.chunks)
        does_more = any(cut.goes_on_in(each.chunks) for each in rest if each.link == "until" and told_deeds)
        if does_more or (tail and (len(told_deeds) > 1 or not leads.is_of_who_acts(story, main.chunks, tail))):
            story.refuse("it is not clear who does this, or when", fix="say it in a sentence of its own")
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
        self.is_of_last = (later is not None or bool(during)) and not tail
        self._main(items, when, rest)
        deeds = sum(each.deed is not None for each in items)
        if (is_while and known == len(story.doings)) or (self.lasting and deeds > 1):
            story.refuse("it is not clear how long this is so")
        if self.lasting:
            deed = story.doings[-1]
            start, end = st.Point(deed.begins), st.Point(story.finish(deed))
            story.holds += [st.Hold("always", start, end, each, story.quote) for each in self.lasting]

    def _main(self, items: list[Clause], when: list[Clause] | None, rest: list[cut.Segment]) -> None:
        story = self.story
        until = any(each.link == "until" for each in rest)
        if any("stays" in each.notes for each in (*items, *(when or ()))) and (not until or any(i.deed for i in items)):
            story.refuse("it is not said until when this is so", fix="say it: 'stays 20 m ahead of it until it brakes'")
        items = [each for each in items if each.says_more_than()] or items[:1]
        does = any("shall" in each.notes and not each.says_more_than() for each in items)  # "so does the hero"
        if when is not None and any(each.subject is not None and not each.says_more_than() for each in items):
            story.refuse("nothing is said here", items[0].quote)  # "when ..., the hero is, too"
        timed = any(each.times for each in when or ())
        is_led = bool(self.led.words & {"then", "at once", "same time"})
        items = acts_of(story, items, (is_led or when is not None or self.pending is not None) and not timed)
        if not items and when is None:
            if rest or does or (is_led and story.named):
                story.refuse("it is not said what is done")
            return
        acts = next((at for at, each in enumerate(items) if each.deed), 0)
        if acts and "then" in items[acts].notes:
            story.refuse("it is not clear when this is done", items[acts].quote, "say it in a sentence of its own")
        if when is not None and not any(each.is_event for each in items[:acts]):
            states, items, ways = items[:acts], items[acts:], ("at the start", "at that moment")
            early = any(each.conditions for each in states) and self.is_of_last and not story.doings
            if early and story.is_first("state", "When is this", ways, states[0].quote):
                self._facts(states)  # "a van is 50 m ahead and brakes when ..."
            else:  # "when ..., the hero is 20 m before it and brakes"
                when = [*when, *states]
        first = items[0] if items else Clause(story.quote)
        if until and not any(cut.is_beside(each) for each in first.measures):
            lasting(first)  # "drives 20 m ahead of the ego until ..." is so, and nothing that it does
        last = leads.last_of(story, first.subject)
        if first.deed is None and last is not None and last.rests and last.ends is None:
            stands = st.standstill(last.actor)
            if stands in first.measures:  # "it brakes at 2 m/s^2. It stands 10 m before ..."
                first.deed, first.measures = "stop", [each for each in first.measures if each != stands]
        tells_time = any(each.link in cut.ORDERS for each in rest) or "after the start" in first.times
        is_new = first.subject != EGO and first.is_event and story.moment_with(first.measures, one=True) is None
        if tells_time and story.doings and is_new:
            first.deed = st.Verb.DRIVE  # "... It passes the conflict point before the ego"
        # "The hero begins to brake 2 s after ..." speaks of a deed that was told before.
        known = first.phase and story.doing_of(first) is not None and when is None and not self.led.words
        if first.deed and len(items) > 1:  # "it brakes to a stop, waits for 3 s and drives on"
            alone = len({each.subject for each in items}) == 1 and all(each.deed for each in items)
            one, ways = alone and "both" not in items[0].notes, ("the last of these deeds", "the first of them")
            late = self.is_of_last and one and story.is_first("last", "What begins then", ways, story.quote)
            then, when = when, None if late else when
            for item, following in zip_longest(items, items[1:]):
                when = then if late and following is None else when
                self._main([item], when, [] if following and "both" not in item.notes else rest)
                if following is None:
                    continue
                if (item.deed, item.phase) == ("turn", "begins") and following.subject == item.subject:
                    story.refuse("it is not clear whether it completes its turn", item.quote)
                if "same time" in following.notes and following.subject == item.subject:
                    story.refuse("two deeds at one time are told of one")
                follows = following.subject == item.subject and item.deed is not None
                bare = following is items[-1] or "said" not in following.notes
                if bare and not following.deed and following.measures:
                    story.refuse("it is not clear when this is so", following.quote)  # "... and the car at 6 m/s"
                if follows or "then" in following.notes or ("later" in following.times and "both" not in item.notes):
                    self.led.words, when, self.pending = {"then"}, None, None
                elif when is None and following.subject != item.subject:  # "then one brakes and another speeds up"
                    self.led.words = {"same time"}
        elif first.deed and not (known and tells_time):
            self._deed(first, when, rest)
        elif when is not None:
            if first.subject == EGO and first.is_event and not timed:
                story.refuse("the ego is driven by the policy under test", fix="say what the others do then")
            moment = self._moment(when)
            if (story.moments[moment].time is None or not items) and not story.is_owned(moment):
                story.settle()
                story.pending, story.awaits = moment, None if items or rest else story.quote
            elif not story.is_owned(moment):
                story.since = moment
            story.add(moment, story.conditions(items))
            story.subject = next((each.subject for each in reversed(items) if each.subject is not None), story.subject)
            put_in_order(story, moment, rest)
        elif tells_time:
            if len(items) > 1:
                story.refuse("only one event is before or after another")
            moment = story.event(first)
            if first.times:
                story.timed(moment, first)
            put_in_order(story, moment, rest)
        elif len(rest) == 1 and rest[0].link == "until" and not self.led.words:
            self._until(items, rest[0])
        elif rest:
            story.refuse("it is not clear when this is so")
        else:
            self._facts(items)

    def _until(self, items: list[Clause], until: cut.Segment) -> None:
        """Take what is so all the while until a moment: "The truck is at least 20 m ahead until it brakes"."""
        story, conditions = self.story, self.story.conditions(items)
        if not conditions or (until.margins and [op for op, _ in until.margins] != ["=="]):
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

    def _moment(self, when: list[Clause]) -> int:
        """Return the moment that a sentence tells: one, for all that is said of it."""
        if self.moment is None:
            self.moment = self.story.moment(when)
        return self.moment

    def _facts(self, items: list[Clause]) -> None:
        """Take what is so at the start, all the while, later, or of somebody's way."""
        story, words = self.story, self.led.words
        later = words & {"then", "later", "same time", "meanwhile"}
        for item in items:
            sides = {each.kind for each in item.relations} & {"ahead", "behind"}
            acts = any(doing.actor == item.subject for doing in story.doings)
            turns = [*item.facts] == ["turn"] and item.facts["turn"] != "straight"
            told = bool(item.facts) and acts and story.actor(item.subject or EGO).way != st.Way()  # "It drives west"
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
        conditions = story.conditions(items)
        measures = [each for each in conditions if isinstance(each, st.Measure)]
        if not conditions or "start" in words:
            story.pending = self.pending  # what happens then is still to come
        if not conditions:
            if all(each.subject is None for each in items):
                story.refuse("nothing is said here")
        elif "meanwhile" in words and any("pass" in each.notes for each in items):
            self._when_unclear()  # what comes to be so is not so all the while
        elif "meanwhile" in words and story.doings and len(measures) == len(conditions):
            story.doings[-1].throughout += measures
        elif "then" in words and story.doings and {each.subject for each in items} == {EGO}:
            story.since = leads.moment_led_to(story, items[0], self.led, self.pending, False)  # "Then the ego ..."
            story.add(story.since or st.START, conditions)
            self.led.delay = None
        elif "later" in words:
            story.since = story.new_moment(conditions)
        elif "same time" in words and (at := leads.same_time(story, self.pending, words)) is not None:
            story.add(at, conditions)
            story.pending = self.pending
        elif "start" in words or not (story.doings or self.pending is not None or words - {"meanwhile"}):
            rates = any(each.quantity is st.Quantity.RATE for each in measures)
            comes = any({"event", "comes"} & each.notes and each.measures for each in items)
            if "start" not in words and (rates or comes):  # "its deceleration is 3 m/s^2"
                self._when_unclear()  # "the hero crosses the stop line at 5 m/s", "drives to it", "turns at 5 m/s"
            story.add(st.START, conditions)
        else:
            self._when_unclear()

    def _when_unclear(self) -> NoReturn:
        fix = "begin it with 'At the start,' or 'Later,', or say it of a deed: 'drives on until ...'"
        self.story.refuse("it is not clear when this is so", fix=fix)

    def _deed(self, clause: Clause, when: list[Clause] | None, rest: list[cut.Segment]) -> None:
        story = self.story
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
        if turned := self.led.own.partition("turn ")[2]:  # "after turning left, it ..."
            story.tell_way(clause.subject, {"turn": turned})
        if self.is_of_last and clause.phase == "begins" and not clause.says_more_than("deed", "phase"):
            last = leads.last_of(story, clause.subject)  # "It brakes to a stop. It begins to brake when ..."
            if last is not None and last.verb == clause.deed and "again" not in self.led.words:
                story.refuse("this was told before", clause.quote, "say in that sentence when it begins")
        story.awaits = None if when is None and self.pending is not None else story.awaits
        is_plain = when is None and self.pending is None and not self.led.words
        again = leads.told_before(story, clause) if is_plain else None
        begins, held, ends = shares_of(story, clause)
        own = leads.last_of(story, clause.subject)
        if self.led.own.startswith("turn") and (own is None or not own.turns):
            begins.append(replace(self._at(clause.subject, "turn_end"), op=">="))
        is_tied = bool(begins) or any(each.link in cut.ORDERS for each in rest)
        moment: int | None
        pending = self.pending if when is None else self._moment(when)
        for delay in clause.times.pop("later", ()):  # "brakes 1 s later"
            if self.led.delay is not None:
                story.refuse("it is not clear what is so much later", clause.quote)
            self.led.delay = delay
        if again is not None or (self.led.delay is None and pending is not None):
            if self.led.own:  # "when the ego is 20 m behind it after braking, ..."
                story.refuse("it is not clear after what this is done", clause.quote)
            moment = pending
        else:
            moment = leads.moment_led_to(story, clause, self.led, pending, is_tied)
            self.led.delay, self.led.own = None, ""
        if "kept" in clause.flags and not held:  # "continues at a constant speed"
            if clause.deed != st.Verb.DRIVE:
                story.refuse("it is not clear what is kept here")
            held.append(steady(clause.subject, clause.quote))
        drives_on = bool(begins) and clause.deed != st.Verb.STAND  # "it brakes 15 m before the stop line"
        if clause.deed == "turn":
            start, told = story.moments[st.START].conditions, () if moment is None else story.moments[moment].conditions
            told = (*told, *start) if st.standstill(clause.subject) in start else told  # it turns from where it stands
            stood = next((each for each in reversed(story.doings) if each.actor == clause.subject), None)
            since = () if stood is None else (stood.begins, stood.ends)[stood.verb != st.Verb.STAND :]
            told = (*told, *(each for at in since if at is not None for each in story.moments[at].conditions))
            # Where it is told where it is then, it turns later.
            if not any(isinstance(each, st.Measure) and each.actor == clause.subject and each.place for each in told):
                begins.append(self._at(clause.subject, "turn_start"))
            ends = ends or [self._at(clause.subject, "turn_end")]  # "turns left and passes the conflict point"
        elif clause.deed == "go first":
            ends.append(self._at(clause.subject, "conflict_point"))
        is_event = "event" in clause.notes
        if ends and is_event and when is not None and not rest:  # "when the ego stands, the van passes the stop line"
            ways = ("some time after that", "at that moment")
            if not story.is_first("event", "When is this", ways, clause.quote):
                begins, ends = [*begins, *ends], []
        begun = clause.phase == "begins"  # "begins to brake to a stop 2 s before ..."
        # "When ..., it brakes to a stop within 2 s after ...": the moment says when it begins, this when it has.
        is_end = when is not None and bool(ends or clause.deed == "stop")
        turns = clause.deed == "turn" and when is not None  # "when ..., it turns left after the ego has passed it"
        dated = [each.link for each in rest if each.link in cut.ORDERS and not each.is_first
                 and (each.margins or (turns and each.link == "after"))]  # fmt: skip
        if "after" in dated and clause.deed == st.Verb.STAND:
            story.refuse("it is not clear what lasts so long", clause.quote, "say 'until ... after', or when it begins")
        whole = clause.deed == "turn" or (bool(ends) and not is_event and pending is None)
        if dated and whole and not begun:  # "brakes to a stop 2 s after ..."
            ways, is_later = ("when that begins", "when that is over"), dated[0] != "after" or clause.deed == "turn"
            begun = story.is_first("dated", "When is this", ways, clause.quote, int(is_later))
            is_end, is_event = not begun, is_event and not begun
        orders = [each for each in rest if each.link in cut.ORDERS and not is_event]
        fronts = [each for each in orders if begun or each.is_first
                  or (not is_end and (each.link == "after" or (each.margins and not ends)))]  # fmt: skip
        verb = {"stop": st.Verb.BRAKE, "turn": st.Verb.DRIVE, "go first": st.Verb.DRIVE}.get(clause.deed, clause.deed)
        led = self.led.words | ({"passes"} if verb == st.Verb.DRIVE and "event" in clause.notes else set())
        led |= {"then", "apart"} if drives_on or fronts else set()  # this says when it begins, not what it did before
        led |= {"then"} if orders and verb in CHANGES and "start" not in led else set()  # not from the start
        if "sets off" in clause.notes and leads.last_of(story, clause.subject) is None:
            story.add(st.START, [st.standstill(clause.subject)])
            agree(_measures(story.moments[st.START].conditions), clause.quote)
        doing = again or story.begin(clause.subject, verb, moment, led)
        if "sets off" in clause.notes and not story.is_at_rest(doing):
            story.refuse("it was not told that it stands", clause.quote, "say so, or that it drives on")
        if story.is_at_rest(doing):  # "it brakes to a stop. When it passes it, ..."
            story.passes_nothing(doing.actor, when or (), {"event"})
        doing.turns |= clause.deed == "turn"
        story.subject = clause.subject
        if begins:
            agree(_measures((*story.moments[doing.begins].conditions, *begins)), clause.quote)
            story.add(doing.begins, begins)
        if verb == st.Verb.DRIVE and story.is_at_rest(doing):  # no speed from rest on is held: it is reached
            if "kept" in clause.flags:
                story.refuse("who stands has no speed to keep", clause.quote, "say until when it speeds up")
            reached = [each for each in held if is_upper(each) is not True]
            first = f"{story.actor(doing.actor).name} stands when it sets off: it comes to its speed by the end of that"
            story.assumptions += [first] * bool(reached)
            held, doing.reached = [each for each in held if each not in reached], reached
        doing.throughout += [each for each in dict.fromkeys((*held, *clause.rates)) if each not in doing.throughout]
        if again is not None:
            agree(doing.throughout, clause.quote)
        rests = clause.deed == "stop" or "standstill" in clause.flags
        if {"to"} & clause.flags and "for" in clause.times and clause.deed in CHANGES:  # "brakes to 5 m/s for 4 s"
            story.refuse("it is not clear what lasts so long", clause.quote, "say 'in', or that it keeps that speed")
        lasts = (*([] if rests else clause.times.get("for", ())), *clause.times.get("in", ()))
        doing.lasts += dict.fromkeys(lasts)
        if "while" in clause.flags and ends:
            story.refuse("it is not clear when this ends")
        self._end(doing, clause, ends, next((each for each in rest if each.link == "until"), None))
        if clause.deed == "go first":  # it passes before the ego does
            there = self._at(EGO, "conflict_point")
            if len(story.heroes) > 1 and clause.subject != story.heroes[0].id:  # a bare one is that with the first
                there = replace(there, place=st.Place("conflict_point", None, clause.subject))
            passes = story.event(Clause(story.quote, EGO, measures=[there]))
            story.orders.append(st.Order(doing.ends or st.START, passes, ">", None, story.quote))
        until, at_end = False, is_event or (again is not None and clause.deed == "stop")
        for each in rest:
            if each.link == "until":  # "... until it passes the conflict point 1 s before the ego"
                until = True
                continue
            late = at_end or until or not (each.is_first or begun or (each.link == "after" and not is_end) or not ends)
            late = late and (doing.ends is not None or doing.rests)
            put_in_order(story, story.finish(doing) if late else doing.begins, [each])
        if rests and "for" in clause.times:  # "stops for 3 s"
            if clause.deed != "stop":
                story.refuse("it is not clear what lasts so long")
            story.begin(clause.subject, st.Verb.STAND, None, set()).lasts += dict.fromkeys(clause.times["for"])

    def _at(self, actor: int, place: str) -> st.Measure:
        return st.Measure(actor, st.Quantity.PLACE, "==", None, st.Place(place), quote=self.story.quote)

    def _end(self, doing: Doing, clause: Clause, ends: Sequence[st.Condition], until: cut.Segment | None) -> None:
        story, told = self.story, [*ends, *doing.reached]
        foreign = until is not None and bool(ends) and bool(until.chunks) and until.chunks[0].kind in ("actor", "name")
        if until is not None and (doing.ends is not None or (foreign and not until.side)):
            story.refuse("two ends of one deed are told", clause.quote)
        if until is not None and until.side:  # "until 1 s after the ego passes it"
            doing.ends = story.new_moment(ends)
            put_in_order(story, doing.ends, [cut.Segment(until.side, until.chunks, until.margins)])
        elif until is not None:
            story.doer = doing.actor
            items = cut.items_of(story, until.chunks)
            story.doer = None
            doing.ends = story.moment(items, doing.actor)
            if doing.verb == st.Verb.STAND:  # "it waits until it has passed it"
                story.passes_nothing(doing.actor, items, {"event", "has"})
            if any((each.actor, each.begins) == (doing.actor, doing.ends) for each in story.doings[:-1]):
                story.refuse("this is over before it begins", clause.quote, "say it in front of what is done then")
            told += story.moments[doing.ends].conditions if told else ()  # "speeds up to 5 m/s until it is at 6 m/s"
            story.add(doing.ends, ends)
        elif ends and doing.ends is not None:  # it is told once more
            told += story.moments[doing.ends].conditions
            story.add(doing.ends, ends)
        elif ends:
            doing.ends = story.new_moment(ends)
        doing.rests = doing.verb == st.Verb.BRAKE and "while" not in clause.flags and not doing.lasts
        agree(_measures(told), clause.quote)


def _measures(conditions: Iterable[st.Condition]) -> Iterator[st.Measure]:
    return (each for each in conditions if isinstance(each, st.Measure))
