"""Reads sentences: gives what each clause says to the narrative, by the links between them.

What enters: a text, and answers to questions. What leaves: a `Story` with what was set aside, assumed and asked; or an
error that quotes the words that nothing could be made of.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from scenewright.errors import Place as Where
from scenewright.errors import TranslationError
from scenewright.language import story as st
from scenewright.language.read.chunks import Chunk, sentences
from scenewright.language.read.clauses import PEOPLE
from scenewright.language.read.facts import Clause
from scenewright.language.read.items import Item, Segment, is_told_twice, items_of, parted, segments_of
from scenewright.language.read.labels import take_labels
from scenewright.language.read.moments import HOW, ORDERS, Moments
from scenewright.language.read.narrative import COURTESIES, Doing, Narrative, standstill
from scenewright.program.types import EGO

_LEADS = ("then", "then left", "then right", "at once", "later", "meanwhile", "start")
_SAYS_NOTHING = {"unknown", "comma", "harmless", "be", "joint", "quality", "name", "mood", "other"}
_COMMENT = {*_SAYS_NOTHING, "comment", "actor", "relative", "yields", "insists", "order", "side", "link"}


def read(text: str, answers: Mapping[str, str] | None = None, name: str = "description") -> st.Story:
    """Return the story that `text` tells.

    Parameters
    ----------
    answers
        Alternatives chosen, by the slot of their question; what is not answered takes its default and is noted.

    Raises
    ------
    TranslationError
        Where words of the domain are left over, or what they say cannot be.
    """
    narrative = Narrative(text, answers or {})
    for chunks in sentences(take_labels(text, narrative)):
        quote = st.Quote(chunks[0].start, chunks[-1].end, text[chunks[0].start : chunks[-1].end])
        narrative.assumptions += [f"'{chunk.text}' is read with '{word}'" for chunk in chunks for word in chunk.slips]
        kinds = {chunk.kind for chunk in chunks}
        if kinds <= _SAYS_NOTHING or _comments(narrative, chunks):
            narrative.asides.append(quote)
            continue
        chunks = [chunk for chunk in chunks if chunk.kind != "harmless"]
        sentence = _Sentence(narrative, chunks, quote, narrative.pending)
        narrative.pending = None
        try:
            sentence.read()
        except TranslationError as error:
            if sentence.is_open:
                continue  # it is asked about first
            error.place = error.place or Where(name, text, quote.span)
            raise
    return narrative.story()


def _comments(narrative: Narrative, chunks: list[Chunk]) -> bool:
    """Whether a sentence says what is tested; who yields in it, or goes first, is checked against what is told."""
    people = [chunk.value for chunk in chunks if chunk.kind in ("actor", "name")]
    kinds = {chunk.kind for chunk in chunks}
    if "comment" not in kinds or people[:1] not in ([], ["ego"]) or not kinds <= _COMMENT:
        return False
    narrative.courtesies += [(None, each.value, each.quote) for each in chunks
                             if each.kind in ("yields", "insists", "order")]  # fmt: skip
    return True


@dataclass(slots=True)
class _Sentence(Moments):
    pending: int | None = None  # a moment that was told just before, and nobody did anything at it
    leads: set[str] = field(default_factory=set)
    turned: str = ""
    is_open: bool = False  # a word in it must be asked about first

    def read(self) -> None:
        story = self.narrative
        story.mentioned, story.doer = [], None
        self.chunks, self.is_open = story.known_words(self.chunks)
        how = next((chunk for chunk in self.chunks if chunk.kind == "link" and chunk.value in HOW), None)
        if not self.chunks:
            return
        if self.chunks[0].kind == "ego's order":
            self.ego_order()
        elif how is not None:
            self.hold(how)
        else:
            self._take_leads()
            self._cut()

    def _take_leads(self) -> None:
        """Take the words that say when a sentence is, at its front or behind its subject: ``then``, ``initially``."""
        joined = any(chunk.value == "if" for chunk in self.chunks)  # its "then" is another
        kept: list[Chunk] = []
        for chunk in self.chunks:
            free = not kept or (not joined and kept[-1].kind in ("be", "mood", *PEOPLE) and chunk.value != "start")
            if chunk.kind == "link" and chunk.value in _LEADS and free:
                lead, _, self.turned = chunk.value.partition("then ")
                self.leads.add(lead or "then")
            elif kept or chunk.kind != "comma":
                kept.append(chunk)
        self.chunks = kept

    def _cut(self) -> None:
        """Cut the sentence into what happens, the moment at which it does, and the rest."""
        story, segments = self.narrative, segments_of(self.chunks, bool(self.leads))
        if not segments[0].chunks and len(segments) > 1 and segments[1].link in ("before", "after"):
            segments[1].chunks, segments[0].chunks = parted(segments[1].chunks)  # "2 s after ..., the hero brakes"
        if not segments[0].chunks and len(segments) > 1 and segments[1].link == "when":
            first, main = segments[1].chunks, list[Chunk]()
            if any(chunk.kind in ("comma", "deed") for chunk in first):
                first, main = parted(first)
            when: list[Item] | None = items_of(story, first)
            self._main(items_of(story, main, story.subject), when, segments[2:])
        else:
            items = items_of(story, segments[0].chunks, story.subject)
            later = [each for each in segments if each.link == "when"]
            when = items_of(story, later[0].chunks) if later else None
            self._main(items, when, [each for each in segments[1:] if each not in later[:1]])

    def _main(self, items: list[Item], when: list[Item] | None, rest: list[Segment]) -> None:
        story = self.narrative
        items = [each for each in items if isinstance(each, st.Compound) or each.says_more_than()] or items[:1]
        does = any(isinstance(each, Clause) and "shall" in each.notes and not each.says_more_than() for each in items)
        timed = any(isinstance(each, Clause) and each.times for each in when or ())
        is_told = when is not None or self.pending is not None or bool(self.leads & {"then", "at once"})
        items = self._acts(items, is_told and not timed)
        if not items and when is None:
            if rest or does:  # "so does the hero"
                self.refuse("it is not said what is done")
            return
        clause = next((each for each in items[:1] if isinstance(each, Clause)), None)
        is_deed = clause is not None and clause.deed is not None
        tells_time = any(each.link in ORDERS for each in rest)
        tells_time |= clause is not None and ("after the start" in clause.times or clause.rival is not None)
        # "The hero begins to brake 2 s after ..." speaks of a deed that was told before.
        known = is_deed and clause is not None and clause.phase and story.doing_of(clause) is not None
        if is_deed and len(items) > 1:
            self._one_after_another(items, when, rest)
        elif is_deed and clause is not None and not (known and when is None and not self.leads and tells_time):
            self._deed(clause, when, rest)
        elif clause is not None and "first" in clause.flags and len(items) == 1 and not rest:
            self._goes_first(clause, when)
        elif when is not None:
            if clause is not None and clause.subject == EGO and clause.is_event and not timed:
                self.refuse("the ego is driven by the policy under test", "say what the others do then")
            moment = self.moment(when)
            if moment not in story.times and not story.is_owned(moment):
                story.pending = moment
            story.add(moment, self.conditions(items))
            story.ego_comes(moment, self.quote)
            self.orders(moment, rest)
        elif tells_time:
            if clause is None or len(items) > 1:
                self.refuse("only one event is before or after another")
                return
            if clause.rival is not None:
                rest, clause.rival = [*rest, Segment(clause.rival[0], rival=clause.rival[1])], None
            moment = self.event(clause)
            if clause.times:
                self.timed(moment, clause)
            self.orders(moment, rest)
        else:
            self._facts(items, rest)

    def _acts(self, items: list[Item], happens: bool) -> list[Item]:
        """Return what is done and what is so: a turn, a speed that is kept or an event is a deed where it `happens`.

        What only says why (yields, does not give way) is kept to be checked; a deed and the event at its end are one.
        """
        found: list[Item] = []
        for item in items:
            if not isinstance(item, Clause):
                found.append(item)
                continue
            for courtesy in item.flags & COURTESIES:
                self.narrative.courtesies.append((item.subject, courtesy, item.quote))
            item.flags -= COURTESIES
            is_hero = happens and item.deed is None and item.subject not in (None, EGO)
            turn = item.facts.get("turn", "")
            acts = any(isinstance(each, Clause) and each.deed is not None for each in items)
            meant = "wanted" in item.notes or ("relative" in item.notes and acts)
            if is_hero and turn in ("left", "right") and not meant:
                self.narrative.tell_way(item.subject or EGO, item.facts, item.quote, turns_then=True)
                item.facts, item.deed = {}, "turn"
            elif is_hero and "kept" in item.flags and not item.measures:
                item.deed = st.Verb.DRIVE
            elif item.phase == "begins" and item.deed is None and item.measures:
                item.phase = None
                if is_hero and item.measures[0].quantity is st.Quantity.SPEED:  # "starts driving at 8 m/s"
                    item.deed, item.flags = st.Verb.DRIVE, item.flags | {"to"}
                    item.facts = {} if turn == "straight" else item.facts
                else:  # "starts 40 m before the stop line"
                    item.flags.add("start")
            if acts:
                self.tell_way(item)
            before = found[-1] if found else None
            ends = isinstance(before, Clause) and before.subject == item.subject and before.deed not in (None, "stop")
            if ends and isinstance(before, Clause) and item.is_event and not before.measures:
                before.measures, before.notes = item.measures, before.notes | item.notes
                before.rival = item.rival
            elif item.says_more_than():
                if is_hero and item.is_event:
                    item.deed = st.Verb.DRIVE
                found.append(item)
        return found

    def _one_after_another(self, items: list[Item], when: list[Item] | None, rest: list[Segment]) -> None:
        """Take "it brakes to a stop, waits for 3 s and drives on": what follows the sentence is of the last deed."""
        for number, item in enumerate(items):
            following = items[number + 1] if number + 1 < len(items) else None
            if is_told_twice(item, following) and isinstance(item, Clause) and isinstance(following, Clause):
                following.rate = following.rate or item.rate
                following.measures = [*item.measures, *following.measures]
                following.times = {**item.times, **following.times}
                continue
            self._main([item], when, rest if following is None else [])
            if isinstance(following, Clause) and isinstance(item, Clause) and following.subject == item.subject:
                self.leads, when, self.pending = {"then"}, None, None

    def _goes_first(self, clause: Clause, when: list[Item] | None) -> None:
        """Take "it goes first": whoever it is passes the conflict point before the ego does."""
        if clause.subject in (None, EGO) or clause.says_more_than("flags"):
            self.refuse("it is not clear who goes first")
        actor, place = clause.subject or EGO, st.Place("conflict_point")
        moment = self.pending if when is None else self.moment(when)
        if moment is not None:
            self.narrative.begin(actor, st.Verb.DRIVE, moment, self.leads, self.quote)
            self.narrative.ego_comes(moment, self.quote)
        there = [st.Measure(each, st.Quantity.PLACE, "==", None, place) for each in (actor, EGO)]
        first, second = (self.event(Clause(self.quote, each.actor, measures=[each])) for each in there)
        self.narrative.orders.append(st.Order(first, second, ">", None, self.quote))

    def _facts(self, items: list[Item], rest: list[Segment]) -> None:
        """Take what is so at the start, all the while, later, or of somebody's way."""
        story = self.narrative
        says = False
        for item in items:
            if isinstance(item, Clause):
                says |= item.subject is not None
                self.tell_way(item)
                if "kept" in item.flags and item.subject is not None:
                    story.kept.append((item.subject, item.quote))
                story.subject = item.subject
                item.flags -= {"kept"}
                if "start" in item.flags:
                    item.flags -= {"start"}
                    story.add(st.START, self.conditions([item]))
                    item.measures = []
        conditions = self.conditions(items)
        measures = [each for each in conditions if isinstance(each, st.Measure)]
        if rest:
            self.refuse("it is not clear when this is so")
        elif not conditions:
            if not says:
                self.refuse("nothing is said here")
        elif "meanwhile" in self.leads and story.doings and len(measures) == len(conditions):
            story.doings[-1].throughout += measures
        elif "later" in self.leads:
            story.ego.append(story.moment(conditions, self.quote))
        elif "start" in self.leads or not (story.doings or self.leads - {"meanwhile"}):
            story.add(st.START, conditions)
        else:
            self.refuse("it is not clear when this is so", "begin it with 'At the start,' or 'Later,'")

    def _deed(self, clause: Clause, when: list[Item] | None, rest: list[Segment]) -> None:
        story = self.narrative
        if clause.subject is not None and clause.subject != EGO:
            self.tell_way(clause)
        told = clause.says_more_than("deed", "phase", "measures", "rate", "times", "flags", "rival")
        if clause.subject is None or clause.deed is None or told or clause.flags & {"first", "way", "start", "falls"}:
            story.refuse("it is not clear what is done here", self.quote)
        if clause.phase == "finishes" or "after the start" in clause.times:
            self.refuse("nothing was told of this deed before")
        if self.turned:  # "after turning left, it ..."
            story.tell_way(clause.subject, {"turn": self.turned}, self.quote)
        waited = self._waited_for(clause.subject, when)
        moment = self.pending if when is None else None if waited is not None else self.moment(when)
        begins, held, ends = self._shares(clause)
        if clause.deed == "turn" and not self._is_somewhere(clause.subject, moment):
            begins.append(_at(clause, "turn_start"))
        drives_on = bool(begins) and clause.deed not in (st.Verb.STAND, "turn")  # "it brakes 15 m before the stop line"
        follows = "event" not in clause.notes and any(
            each.link == "after" or (each.link in ORDERS and each.margin is not None and not ends) for each in rest
        )
        if drives_on or waited is not None or follows:
            self.leads.add("then")
        verb = {"stop": st.Verb.BRAKE, "turn": st.Verb.DRIVE}.get(clause.deed, clause.deed)
        doing = story.begin(clause.subject, verb, moment, self.leads, self.quote)
        if waited is not None:
            story.orders.append(st.Order(waited, doing.begins, ">", None, self.quote))
        story.subject = clause.subject
        story.add(doing.begins, begins)
        story.ego_comes(doing.begins, self.quote)
        doing.throughout += [*held, *([clause.rate] if clause.rate else [])]
        rests = clause.deed == "stop" or "standstill" in clause.flags
        doing.duration = None if rests else clause.times.get("for")
        if "while" in clause.flags and ends:
            self.refuse("it is not clear when this ends")
        if clause.rival is not None and ends:
            rest = [*rest, Segment(clause.rival[0], rival=clause.rival[1])]
        self._end(doing, clause, ends, next((each for each in rest if each.link == "until"), None))
        for each in rest:
            early = (each.link == "after" and "event" not in clause.notes) or not ends or doing.ends is None
            if each.link != "until":
                self.orders(doing.begins if early else doing.ends or st.START, [each], doing.actor)
        if rests and "for" in clause.times and clause.deed != "stop":
            self.refuse("it is not clear what lasts so long")
        if rests and "for" in clause.times:  # "it stops at the stop line for 3 s"
            story.begin(doing.actor, st.Verb.STAND, None, {"then"}, self.quote).duration = clause.times["for"]

    def _waited_for(self, actor: int, when: list[Item] | None) -> int | None:
        """Return the event of the ego that somebody who stands waits for: "once the ego has passed, it drives on"."""
        doing, first = self.narrative.last(actor), when[0] if when else None
        if doing is None or not isinstance(first, Clause) or len(when or []) != 1 or "has" not in first.notes:
            return None
        rests = doing.verb == st.Verb.STAND or (
            doing.ends is not None and standstill(actor) in self.narrative.conditions[doing.ends]
        )
        return self.event(first) if rests and first.is_event and first.subject == EGO else None

    def _is_somewhere(self, actor: int, moment: int | None) -> bool:
        """Whether it is told where somebody is at a moment: then its turn, told for that moment, comes later."""
        told = [] if moment is None else self.narrative.conditions[moment]
        return any(isinstance(each, st.Measure) and each.actor == actor and each.place is not None for each in told)

    def _shares(self, clause: Clause) -> tuple[list[st.Measure], list[st.Measure], list[st.Measure]]:
        """Return what a deed's own clause says of its beginning, of the deed throughout, and of its end."""
        rests = clause.deed == "stop" or "standstill" in clause.flags
        begins, held, ends = list[st.Measure](), list[st.Measure](), [standstill(clause.subject or EGO)][: int(rests)]
        if clause.deed == "turn":
            ends.append(_at(clause, "turn_end"))
        if "kept" in clause.flags and all(each.quantity is not st.Quantity.SPEED for each in clause.measures):
            zero = st.Amount(Fraction(0), "m/s^2")
            held.append(st.Measure(clause.subject or EGO, st.Quantity.RATE, "==", zero, quote=clause.quote))
        for measure in clause.measures:
            fast = measure.quantity is st.Quantity.SPEED
            if rests and measure.quantity is st.Quantity.ARRIVAL:
                self.refuse("who stands has no time to arrival", "say where it stands, in metres")
            if fast and "to" not in clause.flags and clause.deed != st.Verb.DRIVE:
                self.refuse("it is not clear when it is so fast")
            stays = clause.deed == st.Verb.STAND or not (rests or fast or st.is_event(measure))
            (held if fast and "to" not in clause.flags else begins if stays else ends).append(measure)
        return begins, held, ends

    def _end(self, doing: Doing, clause: Clause, ends: Sequence[st.Condition], until: Segment | None) -> None:
        story = self.narrative
        if until is not None:
            story.doer = doing.actor
            items = items_of(story, until.chunks)
            story.doer = None
            waited = self._waited_for(doing.actor, items) if doing.verb == st.Verb.STAND else None
            if waited is None:
                doing.ends = self.moment(items, doing.actor)
            else:  # "it waits until the ego has passed the conflict point"
                doing.ends = story.moment()
                story.orders.append(st.Order(waited, doing.ends, ">", None, self.quote))
            story.add(doing.ends, ends)
        elif ends:
            doing.ends = story.moment(ends, self.quote)
        elif doing.verb == st.Verb.BRAKE and "while" not in clause.flags and doing.duration is None:
            doing.ends = story.moment([standstill(doing.actor)], self.quote)
            story.assumptions.append(f"{story.actor(doing.actor).name} brakes to a standstill")
        if doing.ends is not None:
            story.ego_comes(doing.ends, self.quote)


def _at(clause: Clause, place: str) -> st.Measure:
    return st.Measure(clause.subject or EGO, st.Quantity.PLACE, "==", None, st.Place(place), quote=clause.quote)
