"""Reads sentences: cuts them into clauses at links, and gives what each clause says to the narrative.

What enters: a text, and answers to questions. What leaves: a `Story` with what was set aside, assumed and asked; or an
error that quotes the words that nothing could be made of.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from scenewright.errors import Place as Where
from scenewright.errors import TranslationError, UnknownWordsError
from scenewright.language.read.chunks import Chunk, nearest_words, sentences, word_as
from scenewright.language.read.clauses import Clause, read_clause
from scenewright.language.read.labels import take_labels
from scenewright.language.read.narrative import Doing, Narrative, standstill
from scenewright.language.story import (
    START,
    Compound,
    Condition,
    Hold,
    Measure,
    Operator,
    Order,
    Place,
    Point,
    Quantity,
    Quote,
    Relation,
    Story,
    Verb,
    is_event,
)
from scenewright.program.types import EGO

_LEADS = ("then", "at once", "later", "meanwhile", "start")
_LINKS = ("when", "until", "no later than", "from")
_HOW: dict[str, Literal["always", "never", "at some time"]] = {
    "always": "always", "never": "never", "at some time": "at some time",
}  # fmt: skip
_PREDICATES = (
    "be",
    "state",
    "event",
    "phase",
    "deed",
    "turn",
    "mood",
    "heading",
    "origin",
    "quantity",
    "amount",
    "lanes",
)
_PEOPLE = ("actor", "name", "pronoun")
Item = Clause | Compound


def read(text: str, answers: Mapping[str, str] | None = None, name: str = "description") -> Story:
    """Return the story that `text` tells.

    Parameters
    ----------
    answers
        Alternatives chosen, by the slot of their question; what is not answered takes its default and is noted.
    name
        What to call the text in messages.

    Raises
    ------
    TranslationError
        Where words of the domain are left over, or what they say cannot be.
    """
    narrative = Narrative(answers or {})
    rest = take_labels(text, narrative)
    for chunks in sentences(rest):
        quote = Quote(chunks[0].start, chunks[-1].end, text[chunks[0].start : chunks[-1].end])
        if all(chunk.kind in ("unknown", "comma", "harmless", "be", "joint", "pronoun") for chunk in chunks):
            narrative.asides.append(quote)
            continue
        sentence = _Sentence(narrative, chunks, quote)
        try:
            sentence.read()
        except TranslationError as error:
            if sentence.is_open:
                continue
            if error.place is None:
                error.place = Where(name, text, quote.span)
            raise
    return narrative.story()


@dataclass(slots=True)
class _Segment:
    """A stretch of a sentence behind one link; `margin` is an amount of time that stood before the link."""

    link: str
    chunks: list[Chunk] = field(default_factory=list)
    margin: tuple[Operator, Chunk] | None = None


@dataclass(slots=True)
class _Sentence:
    narrative: Narrative
    chunks: list[Chunk]
    quote: Quote
    leads: set[str] = field(default_factory=set)
    is_open: bool = False  # a word in it must be asked about first

    def read(self) -> None:
        story = self.narrative
        story.mentioned, story.doer = [], None
        self._ask_about_words()
        if self.chunks[0].kind == "ego's order":
            self._ego_order()
            return
        how = next((chunk for chunk in self.chunks if chunk.kind == "link" and chunk.value in _HOW), None)
        if how is not None:
            self._hold(how)
            return
        self._take_leads()
        segments = _segments(self.chunks)
        if not segments[0].chunks and len(segments) > 1 and segments[1].link == "when":
            when: _Segment | None = segments[1]
            main = self._main_of(segments[1])
            segments = segments[2:]
        else:
            main = segments.pop(0)
            when = next((each for each in segments if each.link == "when"), None)
            segments = [each for each in segments if each is not when]
        if when is None:
            self._main(self._items(main.chunks, story.subject), None, segments)
        elif when.chunks and when.chunks[0].start < main.chunks[0].start:
            told = self._items(when.chunks)
            self._main(self._items(main.chunks, story.subject), told, segments)
        else:
            items = self._items(main.chunks, story.subject)
            self._main(items, self._items(when.chunks), segments)

    def _ask_about_words(self) -> None:
        """Put the nearest word of the domain in for an unknown one, or set it aside: whoever wrote it says which."""
        known = []
        for chunk in self.chunks:
            if chunk.kind == "unknown":
                near = nearest_words(chunk.text)
                meant = [f"it means '{word}'" for word in near]
                asked = f"What is '{chunk.text}'?"
                answer = self.narrative.ask(f"word {chunk.start}", asked, [*meant, "set it aside"], None, chunk.quote)
                self.is_open |= not answer
                if answer in meant:
                    known.append(word_as(chunk, near[meant.index(answer)]))
            else:
                known.append(chunk)
        self.chunks = known

    def _take_leads(self) -> None:
        """Take the words that say when a sentence is, at its front or behind its subject: ``then``, ``initially``."""
        kept: list[Chunk] = []
        for chunk in self.chunks:
            behind = kept[-1].kind if kept else "front"
            if chunk.kind == "comma" and not kept:
                continue
            inside = (
                ("front",) if any(each.value == "if" for each in self.chunks) else ("front", "be", "actor", "pronoun")
            )
            if chunk.kind == "link" and chunk.value in _LEADS and behind in inside:
                self.leads.add(chunk.value)
            else:
                kept.append(chunk)
        self.chunks = kept

    def _main_of(self, when: _Segment) -> _Segment:
        """Cut the main clause off a "when" that begins the sentence: behind the first comma with a deed, or the last."""
        commas = [index for index, chunk in enumerate(when.chunks) if chunk.kind == "comma"]
        if not commas:
            self.narrative.refuse("it is not clear where the moment ends and what happens begins", self.quote,
                                  "put a comma between them")  # fmt: skip
        ends = [*commas[1:], len(when.chunks)]
        acts = (start for start, end in zip(commas, ends, strict=True)
                if any(chunk.kind in ("deed", "order") for chunk in when.chunks[start:end]))  # fmt: skip
        cut = next(acts, commas[-1])
        main = _Segment("main", when.chunks[cut + 1 :])
        when.chunks = when.chunks[:cut]
        return main

    # -- conditions ---------------------------------------------------------------------------------------------------
    def _items(self, chunks: Sequence[Chunk], subject: int | None = None) -> list[Item]:
        """Return the clauses of a list, and conditions that are joined in other ways."""
        return _Items(self.narrative, list(chunks), subject).all()

    def _conditions(self, items: Sequence[Item]) -> list[Condition]:
        found: list[Condition] = []
        for item in items:
            if isinstance(item, Compound):
                found.append(item)
                continue
            if item.waiting or item.facts or item.rate or item.relations:
                self.narrative.refuse("this is no condition", item.quote)
            found += item.measures
        return found

    def _moment(self, items: Sequence[Item], quote: Quote) -> int:
        """Return the moment that a list of clauses tells: one that is known, or a new one."""
        story = self.narrative
        clauses = [item for item in items if isinstance(item, Clause)]
        events = [item for item in clauses if item.deed is not None]
        conditions = self._conditions([item for item in items if item not in events])
        known = [self._event(item) for item in events]
        moment = known[0] if known else story.moment_with(conditions)
        if any(other != moment for other in known):
            story.refuse("two moments are told as one", quote)
        if moment is None:
            moment = story.moment(quote=quote)
        story.add(moment, conditions)
        for item in clauses:
            if "after the start" in item.times:
                op, time = item.times["after the start"]
                if op != "==":
                    story.orders.append(Order(START, moment, op, time, item.quote))
                else:
                    story.times[moment] = time
        return moment

    def _event(self, clause: Clause) -> int:
        """Return the moment of an event: a deed begins or ends, or something comes to be so."""
        story = self.narrative
        if clause.deed is not None:
            doing = story.doing_of(clause)
            if doing is None:
                story.refuse("nothing was told of this deed before", clause.quote)
            if clause.phase == "finishes" or clause.deed == "stop":
                if doing.ends is None:
                    doing.ends = story.moment()
                return doing.ends
            return doing.begins
        for measure in clause.measures:
            for number, own in enumerate(story.conditions):
                if measure in own and number != START:
                    return number
        if not clause.measures:
            story.refuse("this is no event", clause.quote)
        return self._new_event(clause)

    def _new_event(self, clause: Clause) -> int:
        """Return a new moment: the ego comes to it after all others; somebody else ends a deed at it."""
        story = self.narrative
        if clause.subject == EGO:
            moment = story.moment(clause.measures, clause.quote)
            story.ego.append(moment)
            return moment
        doing = story.last(clause.subject) if clause.subject is not None else None
        if doing is None or doing.ends is not None:
            if clause.subject is None or not all(is_event(each) for each in clause.measures):
                story.refuse("this is no event of anything that was told", clause.quote)
            doing = story.begin(clause.subject, Verb.DRIVE, None, {"then"}, clause.quote)
        doing.ends = story.moment(clause.measures, clause.quote)
        return doing.ends

    # -- main clauses -------------------------------------------------------------------------------------------------
    def _main(self, items: list[Item], when: list[Item] | None, rest: list[_Segment]) -> None:
        story = self.narrative
        deed = next((item for item in items if isinstance(item, Clause) and item.deed is not None), None)
        timed = (
            deed is not None and not when and any(each.link in ("before", "after", "no later than") for each in rest)
        )
        after_start = deed is not None and "after the start" in deed.times
        known = deed is not None and deed.phase is not None and story.doing_of(deed) is not None
        if deed is items[0] and len(items) > 1:
            self._one_after_another(items, when, rest)
        elif deed is not None and not (known and not when and not self.leads and (timed or after_start)):
            self._deed(deed, items, when, rest)
        elif any(isinstance(item, Clause) and "first" in item.flags for item in items):
            self._goes_first(items, when)
        elif when is not None:
            moment = self._moment(when, self.quote)
            story.add(moment, self._conditions(items))
            story.ego_comes(moment, self.quote)
            self._orders(moment, rest)
        elif rest or after_start or _tells_a_time(items):
            clause = items[0]
            if len(items) != 1 or isinstance(clause, Compound):
                story.refuse("only one event is before or after another", self.quote)
            moment = self._event(clause)
            if "after the start" in clause.times:
                op, margin = clause.times["after the start"]
                story.orders.append(Order(START, moment, op, margin, self.quote))
            self._orders(moment, rest)
        else:
            self._facts(items)

    def _one_after_another(self, items: list[Item], when: list[Item] | None, rest: list[_Segment]) -> None:
        """Take "it brakes to a stop, waits for 3 s and drives on": what follows the sentence is of the last deed."""
        for number, item in enumerate(items):
            following = items[number + 1] if number + 1 < len(items) else None
            if isinstance(item, Clause) and isinstance(following, Clause):
                following.subject = item.subject if following.subject is None else following.subject
                if (item.deed, following.deed) == (Verb.BRAKE, "stop") and item.subject == following.subject:
                    _join(item, following)
                    continue
            self._main([item], when, rest if following is None else [])
            self.leads, when = {"then"}, None

    def _goes_first(self, items: list[Item], when: list[Item] | None) -> None:
        """Take "it goes first": whoever it is passes the conflict point before the ego does."""
        story = self.narrative
        (clause, *more) = items
        if more or when is not None or isinstance(clause, Compound) or clause.measures or clause.subject in (None, EGO):
            story.refuse("it is not clear who goes first", self.quote)
        assert clause.subject is not None
        moments = []
        for actor in (clause.subject, EGO):
            there = Measure(actor, Quantity.PLACE, "==", None, Place("conflict_point"), quote=self.quote)
            moments.append(self._event(replace(clause, subject=actor, measures=[there], deed=None)))
        story.orders.append(Order(moments[0], moments[1], ">", None, self.quote))

    def _facts(self, items: list[Item]) -> None:
        """Take what is so at the start, all the while, later, or of somebody's way."""
        story = self.narrative
        clauses = [item for item in items if isinstance(item, Clause)]
        for clause in clauses:
            if clause.facts or clause.relations or "way" in clause.flags:
                self._way(clause)
            story.subject = clause.subject
        conditions = self._conditions(
            [item if isinstance(item, Compound) else replace(item, facts={}, relations=[]) for item in items]
        )
        if not conditions:
            if not any(clause.facts or clause.flags or clause.subject is not None for clause in clauses):
                story.refuse("nothing is said here", self.quote)
        elif "meanwhile" in self.leads:
            self._meanwhile(conditions)
        elif "later" in self.leads:
            moment = story.moment(conditions, self.quote)
            story.ego.append(moment)
        elif "start" in self.leads or not story.doings:
            story.add(START, conditions)
        else:
            story.refuse("it is not clear when this is so", self.quote, "begin it with 'At the start,' or 'Later,'")

    def _meanwhile(self, conditions: list[Condition]) -> None:
        if not self.narrative.doings or not all(isinstance(each, Measure) for each in conditions):
            self.narrative.refuse("it is not clear while what this is so", self.quote)
        told = self.narrative.doings[-1]
        told.throughout += [each for each in conditions if isinstance(each, Measure)]

    def _way(self, clause: Clause) -> None:
        story = self.narrative
        if clause.subject is None:
            story.refuse("it is not clear whose way this is", clause.quote)
        actor = story.actor(clause.subject)
        facts = {
            name: value for name, value in clause.facts.items() if name not in ("then headed", "lanes", "headings")
        }
        lanes = tuple(each.strip() for each in clause.facts.get("lanes", "").split(",") if each.strip())
        headings = tuple(clause.facts.get("headings", ""))
        if facts.get("turn") == "on":
            del facts["turn"]
        for name, value in facts.items():
            if getattr(actor.way, name) not in (None, value):
                story.refuse(f"two things are said of the way of {actor.name}", clause.quote)
        way = replace(actor.way, **facts)  # type: ignore[arg-type]
        way = replace(way, lanes=lanes or way.lanes, headings=headings or way.headings)
        relations = [Relation(kind, of, quote) for kind, of, quote in clause.relations]
        if any(each.of == actor.id for each in relations):
            story.refuse("it is not clear to whose way this one lies so", clause.quote)
        story.put(replace(actor, way=way, relations=(*actor.relations, *relations)))

    # -- deeds --------------------------------------------------------------------------------------------------------
    def _deed(self, clause: Clause, items: list[Item], when: list[Item] | None, rest: list[_Segment]) -> None:
        story = self.narrative
        if clause.subject is None or clause.facts or clause.waiting or len(items) > 1:
            story.refuse("it is not clear who does this", self.quote)
        moment = None if when is None else self._moment(when, self.quote)
        verb = Verb.BRAKE if clause.deed == "stop" else clause.deed
        assert verb is not None
        doing = story.begin(clause.subject, verb, moment, self.leads, self.quote)
        story.subject = clause.subject
        if moment is not None:
            story.ego_comes(moment, self.quote)
        if clause.rate is not None:
            doing.throughout.append(clause.rate)
        ends = self._ends(clause, doing)
        until = next((each for each in rest if each.link == "until"), None)
        self._end(doing, clause, ends, until)
        doing.duration = clause.times.get("for")
        self._orders(doing.ends if ends and doing.ends is not None else doing.begins,
                     [each for each in rest if each is not until])  # fmt: skip

    def _ends(self, clause: Clause, doing: Doing) -> list[Condition]:
        """Return what is so where a deed ends, by its own clause; what is so where it begins goes there."""
        story = self.narrative
        comes_to_rest = "standstill" in clause.flags or clause.deed == "stop"
        ends: list[Condition] = [standstill(doing.actor)] if comes_to_rest else []
        for measure in clause.measures:
            if measure.quantity is Quantity.SPEED and "to speed" not in clause.flags:
                if clause.deed != Verb.DRIVE:
                    story.refuse("it is not clear when it is so fast", clause.quote)
                doing.throughout.append(measure)
            elif comes_to_rest or is_event(measure) or measure.quantity is Quantity.SPEED:
                ends.append(measure)
            else:
                story.add(doing.begins, [measure])
        return ends

    def _end(self, doing: Doing, clause: Clause, ends: list[Condition], until: _Segment | None) -> None:
        story = self.narrative
        if until is not None:
            story.doer = doing.actor
            items = self._items(until.chunks)
            story.doer = None
            doing.ends = self._moment(items, self.quote)
            story.add(doing.ends, ends)
        elif ends:
            doing.ends = story.moment(ends, self.quote)
        elif doing.verb == Verb.BRAKE and "while" not in clause.flags and "for" not in clause.times:
            doing.ends = story.moment([standstill(doing.actor)], self.quote)
            story.assumptions.append(f"{story.actor(doing.actor).name} brakes to a standstill")
        if doing.ends is not None:
            story.ego_comes(doing.ends, self.quote)

    # -- orders and holds ---------------------------------------------------------------------------------------------
    def _orders(self, moment: int, rest: list[_Segment]) -> None:
        story = self.narrative
        for segment in rest:
            items = self._items(segment.chunks)
            clause = items[0] if items else None
            if (
                len(items) != 1
                or not isinstance(clause, Clause)
                or segment.link not in ("before", "after", "no later than")
            ):
                story.refuse("it is not clear before or after what", self.quote)
            other = self._event(clause)
            first, second = (other, moment) if segment.link == "after" else (moment, other)
            if segment.margin is None:
                op: Operator = ">=" if segment.link == "no later than" else ">"
                story.orders.append(Order(first, second, op, None, self.quote))
            else:
                op, amount = segment.margin
                story.orders.append(Order(first, second, op, amount.amount, self.quote))

    def _hold(self, how: Chunk) -> None:
        """Read ``From ... until ..., always: ...``."""
        story = self.narrative
        at = self.chunks.index(how)
        until = next((index for index, each in enumerate(self.chunks) if each.value == "until"), None)
        first = self.chunks[0]
        if until is None or until > at or first.value != "from":
            story.refuse(f"'{how.text}' needs a time from which and until which", self.quote,
                         "From the start until the hero begins to brake, never: ...")  # fmt: skip
        start = self._point(self.chunks[1:until])
        end = self._point([each for each in self.chunks[until + 1 : at] if each.kind != "comma"])
        items = self._items([each for each in self.chunks[at + 1 :] if each.kind != "comma" or each.text == ","])
        conditions = self._conditions(items)
        if len(conditions) != 1:
            story.refuse("one condition holds all the while", self.quote, "write a sentence for each")
        story.holds.append(Hold(_HOW[how.value], start, end, conditions[0], self.quote))

    def _ego_order(self) -> None:
        """Read ``In the ego's order: ..., then ...``."""
        events: list[list[Chunk]] = [[]]
        for chunk in self.chunks[1:]:
            if chunk.value == "then":
                events.append([])
            elif chunk.kind not in ("comma", "nothing"):
                events[-1].append(chunk)
        self.narrative.ego_order([self._event_of(chunks) for chunks in events if chunks])

    def _event_of(self, chunks: list[Chunk]) -> int:
        (item, *more) = self._items(chunks)
        if more or isinstance(item, Compound):
            self.narrative.refuse("this is not one event", self.quote)
        return self._event(item)

    def _point(self, chunks: list[Chunk]) -> Point:
        offset, earlier = None, False
        if len(chunks) > 1 and chunks[0].kind == "amount" and chunks[1].value in ("before", "after"):
            offset, earlier = chunks[0].amount, chunks[1].value == "before"
            chunks = chunks[2:]
        if [chunk.value for chunk in chunks] == ["the start"]:
            return Point(START, offset, earlier)
        return Point(self._event_of(chunks), offset, earlier)


def _join(brakes: Clause, stops: Clause) -> None:
    """Let "brakes at 3 m/s^2 and stops at its stop line" be one deed."""
    stops.rate = stops.rate or brakes.rate
    stops.measures = [*brakes.measures, *stops.measures]
    stops.times = {**brakes.times, **stops.times}


def _tells_a_time(items: list[Item]) -> bool:
    return any(isinstance(item, Clause) and "after the start" in item.times for item in items)


def _segments(chunks: list[Chunk]) -> list[_Segment]:
    """Cut a sentence at its links; "before" and "after" are links where a clause follows, not a place."""
    found = [_Segment("main")]
    for index, chunk in enumerate(chunks):
        following = chunks[index + 1] if index + 1 < len(chunks) else None
        orders = chunk.kind == "side" and chunk.value in ("before", "after")
        if orders and following is not None and following.kind in _PEOPLE and _is_clause(chunks[index + 1 :]):
            margin = _margin(found[-1])
            found.append(_Segment(chunk.value, margin=margin))
        elif chunk.kind == "link" and chunk.value in _LINKS:
            found.append(_Segment(chunk.value))
        else:
            found[-1].chunks.append(chunk)
    for segment in found:
        while segment.chunks and segment.chunks[-1].kind == "comma" and segment.link != "when":
            segment.chunks.pop()
    return found


def _is_clause(chunks: Sequence[Chunk]) -> bool:
    """Whether somebody does or is something here, before the next link."""
    for chunk in chunks[1:]:
        if chunk.kind in _PREDICATES:
            return True
        if chunk.kind in ("link", "comma", "joint", "possessive"):
            return False
    return False


def _margin(segment: _Segment) -> tuple[Operator, Chunk] | None:
    """Take an amount of time off the end of a segment: ``the ego turns at least 2 s | after ...``."""
    chunks = segment.chunks
    if not chunks or chunks[-1].amount is None or chunks[-1].amount.dimension != "time":
        return None
    amount = chunks.pop()
    op: Operator = "=="
    if chunks and chunks[-1].kind == "bound":
        op = chunks.pop().value  # type: ignore[assignment]
    return op, amount


@dataclass(slots=True)
class _Items:
    """Parses a list of conditions: ``a, b and c``, ``either a or b``, ``if a then b``, ``it is not so that a``."""

    narrative: Narrative
    chunks: list[Chunk]
    subject: int | None  # of a clause that names none
    at: int = 0
    before: Clause | None = None
    read: list[list[Chunk]] = field(default_factory=list)  # the chunks of each

    def all(self) -> list[Item]:
        found: list[Item] = []
        while self.at < len(self.chunks):
            if self.chunks[self.at].kind == "comma" or self._is_joint("and"):
                self.at += 1
                continue
            start = self.at
            found.append(self._one(()))
            self.read.append([chunk for chunk in self.chunks[start : self.at] if chunk.kind != "comma"])
        for index, item in enumerate(found):
            if isinstance(item, Clause) and item.waiting:
                after = found[index + 1] if index + 1 < len(found) else None
                found[index] = read_clause(
                    self.read[index], self.narrative, after if isinstance(after, Clause) else None
                )
        return found

    def _is_joint(self, value: str) -> bool:
        if self.at >= len(self.chunks):
            return False
        chunk = self.chunks[self.at]
        return chunk.value == value and chunk.kind in ("joint", "link")

    def _one(self, inside: tuple[str, ...]) -> Item:
        chunk = self.chunks[self.at] if self.at < len(self.chunks) else None
        if chunk is None:
            raise UnknownWordsError("a condition is missing", fix="say what is so")
        if chunk.kind == "joint" and chunk.value in ("either", "both", "not so", "if"):
            self.at += 1
            if chunk.value == "not so":
                return Compound("not", (self._part(inside),), chunk.quote)
            link = {"either": "or", "both": "and", "if": "then"}[chunk.value]
            inside = (*inside, link)
            parts = [self._part(inside)]
            while self._is_joint(link):
                self.at += 1
                parts.append(self._part(inside))
            joint: Literal["and", "or", "if"] = (
                "or" if chunk.value == "either" else "and" if chunk.value == "both" else "if"
            )
            return Compound(joint, tuple(parts), chunk.quote)
        return self._clause(inside)

    def _part(self, inside: tuple[str, ...]) -> Condition:
        item = self._one(inside)
        if isinstance(item, Compound):
            return item
        if len(item.measures) == 1 and not item.facts and not item.deed:
            return item.measures[0]
        if len(item.measures) > 1 and not item.facts and not item.deed:
            return Compound("and", tuple(item.measures), item.quote)
        raise UnknownWordsError("this is no condition", found=item.quote.text, fix="say what is so")

    def _clause(self, inside: tuple[str, ...]) -> Clause:
        start = self.at
        while self.at < len(self.chunks):
            chunk = self.chunks[self.at]
            ends = chunk.kind == "comma" or (chunk.kind == "joint" and chunk.value in ("and", "or"))
            if self.at > start and (
                (ends and self._begins(self.at + 1)) or any(self._is_joint(link) for link in inside)
            ):
                break
            self.at += 1
        own = [chunk for chunk in self.chunks[start : self.at] if chunk.kind != "comma"]
        if [chunk.value for chunk in own[:2]] == ["it", "is"] and own[-1].value == "the start":
            own = own[2:]  # nobody: "it is 5 s after the start"
        subject = self.subject if self.before is None else self.before.subject
        self.before = read_clause(own, self.narrative, self.before, subject)
        return self.before

    def _begins(self, at: int) -> bool:
        """Whether a clause begins here."""
        while at < len(self.chunks) and (self.chunks[at].kind == "comma" or self.chunks[at].value == "and"):
            at += 1
        kinds = (*_PEOPLE, "be", "joint", "phase", "deed", "state", "event", "origin", "turn", "mood", "then_headed")
        return at < len(self.chunks) and self.chunks[at].kind in kinds
