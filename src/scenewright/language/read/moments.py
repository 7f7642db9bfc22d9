"""What is so at a moment, and which moment an event is: clauses become conditions, and moments are found again.

What enters: clauses, and the narrative so far. What leaves: conditions and numbers of moments. It decides nothing about
what anybody does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.language import story as st
from scenewright.language.read.chunks import Chunk
from scenewright.language.read.facts import Clause
from scenewright.language.read.items import Item, Segment, items_of
from scenewright.language.read.narrative import Narrative, standstill
from scenewright.program.types import EGO

ORDERS = ("before", "after", "no later than")
HOW: dict[str, st.How] = {"always": "always", "never": "never", "at some time": "at some time"}


@dataclass(slots=True)
class Moments:
    """The moments of one sentence."""

    narrative: Narrative
    chunks: list[Chunk]
    quote: st.Quote

    def refuse(self, message: str, fix: str | None = None) -> None:
        """Raise the error that says what of the sentence could not be read."""
        self.narrative.refuse(message, self.quote, fix)

    def conditions(self, items: Sequence[Item], *taken: str) -> list[st.Condition]:
        """Return what a list says is so; `taken` are attributes of its clauses that something else takes."""
        for item in items:
            if not isinstance(item, Clause):
                continue
            if item.notes & {"wanted", "relative"}:
                self.tell_way(item)
            for each in item.relations:  # "when the ego is behind the hero"
                if each.kind in ("ahead", "behind") and item.subject is not None:
                    rear, front = (item.subject, each.of) if each.kind == "behind" else (each.of, item.subject)
                    zero = st.Amount(Fraction(0), "m")
                    item.measures.append(st.Measure(rear, st.Quantity.GAP, ">", zero, other=front, quote=each.quote))
            item.relations = [each for each in item.relations if each.kind not in ("ahead", "behind")]
            if item.facts.get("turn", "straight") == "straight" and not item.relations:
                self.tell_way(item)
            if item.says_more_than("measures", *taken):
                self.narrative.refuse("this is no condition", item.quote)
        lists = [item.measures if isinstance(item, Clause) else [item] for item in items]
        return [condition for each in lists for condition in each]

    def moment(self, items: Sequence[Item], until: int | None = None) -> int:
        """Return the moment that a list of clauses tells, known or new; `until` is whose deed ends then."""
        story = self.narrative
        for item in items:
            if isinstance(item, Clause):  # what is reached is so when it is
                item.flags -= {"falls"}
                if until is not None and (item.deed, item.subject) == ("stop", until):  # "until it comes to a stop"
                    item.deed, item.measures = None, [standstill(until), *item.measures]
        events = [item for item in items if isinstance(item, Clause) and item.deed is not None]
        conditions = self.conditions([item for item in items if item not in events], "times")
        if not conditions and not any(each.deed or each.times for each in items if isinstance(each, Clause)):
            self.refuse("it is not said what is so then")  # "when the ego does"
        known = {self.event(item) for item in events}
        if len(known) > 1:
            self.refuse("two moments are told as one")
        moment = next(iter(known), story.moment_with(conditions))
        moment = story.moment(quote=self.quote) if moment is None else moment
        story.add(moment, conditions)
        for item in items:
            if isinstance(item, Clause) and item not in events and item.times:
                self.timed(moment, item)
        return moment

    def timed(self, moment: int, clause: Clause) -> None:
        """Take "5 s after the start"."""
        if clause.times.keys() != {"after the start"}:
            self.refuse("it is not clear what lasts so long")
        op, time = clause.times["after the start"]
        if op == "==" and moment not in self.narrative.times:
            self.narrative.times[moment] = time
        else:
            self.narrative.orders.append(st.Order(st.START, moment, op, time, self.quote))

    def event(self, clause: Clause) -> int:
        """Return the moment of an event: a deed begins or ends, or something comes to be so."""
        story = self.narrative
        if clause.deed is not None:
            doing = story.doing_of(clause)
            if doing is None or clause.says_more_than("deed", "phase", "ordinal", "times"):
                story.refuse("nothing was told of this deed before", clause.quote)
            if clause.phase != "finishes" and clause.deed != "stop":
                return doing.begins
            if doing.ends is None:
                doing.ends = story.moment()
            return doing.ends
        if clause.measures and "event" in clause.notes:  # "begins its turn into the driveway"
            self.tell_way(clause)
        if not clause.measures or clause.says_more_than("measures", "times"):
            story.refuse("this is no event", clause.quote)
        for number, own in enumerate(story.conditions):
            if number != st.START and any(measure in own for measure in clause.measures):
                story.add(number, clause.measures)
                return number
        if clause.subject == EGO:
            story.ego.append(story.moment(clause.measures, clause.quote))
            return story.ego[-1]
        return self._end_of_a_deed(clause)

    def _end_of_a_deed(self, clause: Clause) -> int:
        """Return a new moment at which somebody's deed ends: the last one, or driving on after it."""
        story = self.narrative
        if clause.subject is None or not all(st.is_event(each) for each in clause.measures):
            story.refuse("this is no event of anything that was told", clause.quote)
        doing = story.last(clause.subject)
        if doing is None or doing.ends is not None:
            doing = story.begin(clause.subject, st.Verb.DRIVE, None, {"then"} if doing else set(), clause.quote)
        doing.ends = story.moment(clause.measures, clause.quote)
        return doing.ends

    def tell_way(self, clause: Clause) -> None:
        """Take what a clause says of somebody's way, and leave the rest."""
        if not (clause.facts or clause.relations or clause.flags & {"way", "headed"}):
            return
        if clause.subject is None:
            self.narrative.refuse("it is not clear whose way this is", clause.quote)
        self.narrative.tell_way(clause.subject, clause.facts, clause.quote)
        self.narrative.relate(clause.subject, *clause.relations)
        is_led = "headed" in clause.flags or "then" in clause.facts
        if clause.notes & {"drives", "goes"} or ("heading" in clause.facts and not is_led):
            self.narrative.driving.add(clause.subject)
        clause.facts, clause.relations, clause.flags = {}, [], clause.flags - {"way", "headed"}

    def same_event(self, moment: int, actor: int) -> int:
        """Return the moment at which somebody comes to where another one comes at `moment`."""
        events = [each for each in self.narrative.conditions[moment] if st.is_event(each)]
        if len(events) != 1:
            self.refuse("it is not clear before or after what")
        measure = replace(events[0], actor=actor)
        return self.event(Clause(self.quote, actor, measures=[measure]))

    def event_of(self, chunks: list[Chunk]) -> int:
        """Return the moment of the one event that chunks tell."""
        items = items_of(self.narrative, chunks)
        if len(items) != 1 or not isinstance(items[0], Clause) or items[0].times:
            self.narrative.refuse("this is not one event", self.quote)
        return self.event(items[0])

    def point(self, chunks: list[Chunk]) -> st.Point:
        """Return what "2 s before the hero begins to brake" tells."""
        offset, earlier = None, False
        if len(chunks) > 1 and chunks[0].kind == "amount" and chunks[1].value in ("before", "after"):
            offset, earlier = chunks[0].amount, chunks[1].value == "before"
            chunks = chunks[2:]
        if [chunk.value for chunk in chunks] == ["the start"]:
            return st.Point(st.START, offset, earlier)
        return st.Point(self.event_of(chunks), offset, earlier)

    def orders(self, moment: int, rest: list[Segment], actor: int | None = None) -> None:
        """Take what comes before or after a moment, which is not a new event of the `actor` whose deed it is."""
        for segment in rest:
            if segment.link not in ORDERS:
                self.refuse("it is not clear before or after what")
            count = len(self.narrative.doings)
            other = self.event_of(segment.chunks) if segment.rival is None else self.same_event(moment, segment.rival)
            if actor is not None and any(each.actor == actor for each in self.narrative.doings[count:]):
                self.refuse("nothing was told of this event before")
            first, second = (other, moment) if segment.link == "after" else (moment, other)
            plain: tuple[st.Operator, None] = (">=" if segment.link == "no later than" else ">", None)
            op, margin = segment.margin or plain
            self.narrative.orders.append(st.Order(first, second, op, margin, self.quote))

    def hold(self, how: Chunk) -> None:
        """Read ``From ... until ..., always: ...``."""
        at = self.chunks.index(how)
        until = next((index for index, each in enumerate(self.chunks) if each.value == "until"), at)
        if until == at or self.chunks[0].value != "from":
            self.refuse(f"'{how.text}' needs a time from which and until which", "From the start until ..., never: ...")
        start = self.point(self.chunks[1:until])
        end = self.point([each for each in self.chunks[until + 1 : at] if each.kind != "comma"])
        conditions = self.conditions(
            items_of(self.narrative, [each for each in self.chunks[at + 1 :] if each.text != ":"])
        )
        if len(conditions) != 1:
            self.refuse("one condition holds all the while", "write a sentence for each")
        self.narrative.holds.append(st.Hold(HOW[how.value], start, end, conditions[0], self.quote))

    def ego_order(self) -> None:
        """Read ``In the ego's order: ..., then ...``."""
        events: list[list[Chunk]] = [[]]
        for chunk in self.chunks[1:]:
            if chunk.value == "then":
                events.append([])
            elif chunk.kind not in ("comma", "nothing"):
                events[-1].append(chunk)
        self.narrative.ego_order([self.event_of(chunks) for chunks in events if chunks])
