"""Cuts sentences at their links, and lists of conditions into clauses.

What enters: the chunks of a sentence, or of a stretch of it. What leaves: segments, and items: clauses, or conditions
that are joined by "either", "both", "if" and "it is not so that".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise, takewhile
from typing import Literal

from scenewright.errors import UnknownWordsError
from scenewright.translate import story as st
from scenewright.translate.read.attach import line_up, read_clause
from scenewright.translate.read.cast import Cast
from scenewright.translate.read.chunks import Chunk
from scenewright.translate.read.clauses import OPERATORS, PEOPLE, Clause

ORDERS = ("before", "after", "no later than", "earlier than", "no earlier than")
_AT_ONCE = ("as soon as", "the moment", "the instant")
LINKS = ("when", "until", "from", *ORDERS[2:])
# "No later than 2 s after" and "... before": one side is held, where "at most 2 s after" is after it, too.
ONE_SIDE: dict[tuple[str, str], st.Operator] = {
    ("no later than", "after"): "<=", ("earlier than", "after"): "<",
    ("no later than", "before"): ">=", ("earlier than", "before"): ">",
    ("no earlier than", "after"): ">=", ("no earlier than", "before"): "<=",
}  # fmt: skip
_LINKED = {"that", "which", "who", "heading", "headed"}
Margin = tuple[st.Operator, st.Amount | None]
_PREDICATES = {
    "be", "state", "event", "phase", "deed", "turn", "mood", "heading", "origin", "quantity", "amount", "lanes",
}  # fmt: skip
_BEGINS_A_CLAUSE = {
    *PEOPLE, "be", "joint", "phase", "deed", "state", "event", "origin", "turn", "mood", "then_headed", "pair",
    "kept", "order", "yields", "insists", "refrains", "open", "quantity",
}  # fmt: skip
_ACTS = ("deed", "order", "yields", "insists", "refrains")
_FRONTED = ("side", "turn", "state", "origin", "heading", "area")
_JOINTS: dict[str, tuple[Literal["and", "or", "if"], str]] = {  # what a word makes of its parts, and what parts them
    "either": ("or", "or"),
    "both": ("and", "and"),
    "if": ("if", "then"),
}


@dataclass(slots=True)
class Segment:
    """A stretch of a sentence behind one link; `margins` are amounts of time that stood before the link."""

    link: str
    chunks: list[Chunk] = field(default_factory=list)
    margins: list[Margin] = field(default_factory=list)
    is_first: bool = False  # it stands in front of what happens
    lasts: bool = False  # it is so as long as something is done: "While ..."
    side: str = ""  # on which side of a moment it is until which something lasts: "until 1 s after the ego ..."
    is_sharp: bool = False  # it is told to be at once: "as soon as ..."


def parts_of(chunks: list[Chunk]) -> list[list[Chunk]]:
    """Cut a sentence with two moments, or in which something lasts until one, and then something else is done."""
    for at in range(1, len(chunks)):
        before = [chunk.value for chunk in chunks[max(at - 2, 0) : at]]
        acts = any(chunk.kind == "deed" for chunk in chunks[:at])
        if (chunks[at].kind, chunks[at].value) == ("link", "when") and acts and before == [",", "and"]:
            return [chunks[: at - 2], *parts_of(chunks[at:])]
    links = [chunk.value.partition(" ")[0] if chunk.kind == "link" else "" for chunk in chunks]
    until = links.index("until") if "until" in links else len(links)
    if "then" not in links[until:] or any(chunk.value == "if" or chunk.kind == "ego's order" for chunk in chunks):
        return [chunks]
    then = links.index("then", until)
    if all(chunk.kind != "comma" for chunk in chunks[max(until, then - 2) : then]):
        return [chunks]  # "until the ego has passed it and then turns": who does is not clear
    return [chunks[:then], *parts_of(chunks[then:])]


def segments_of(chunks: list[Chunk], is_led: bool = False) -> list[Segment]:
    """Cut a sentence at its links; "before" and "after" are links where a clause follows, not a place.

    "With the ego 12 m from ..., the hero ..." and "If ..., then ..." tell a moment, unless something leads them.
    """
    found = [Segment("main")]
    opens = [(chunk.kind, chunk.value) for chunk in chunks[:2]] + [("", "")] * 2
    fronted = opens[0] == ("side", "with") and opens[1][0] in PEOPLE  # "With the ego 12 m from ...", "At a gap of 12 m"
    fronted |= opens[0] in (("side", "with"), ("side", "at")) and opens[1][0] == "quantity"
    lasts = opens[0] == ("joint", "and") and chunks[0].text.lower() == "while"
    timed = [chunk.value for chunk in chunks[1:4] if chunk.kind in ("side", "link")][:2] == ["after", "the start"]
    if timed and opens[0][0] in ("amount", "bound"):  # "5 s after the start, the hero ..."
        found.append(Segment("when"))
    elif (fronted or lasts or opens[0] == ("joint", "if")) and not is_led:
        found, chunks = [*found, Segment("when", lasts=lasts)], chunks[1:]
    for index, chunk in enumerate(chunks):
        told = found[-2 if found[-1].link in ORDERS[2:] else -1].chunks
        if chunk.kind == "side" and chunk.value in ORDERS[:2] and _is_clause(chunks[index + 1 :], told):
            margins = _margins(found[-1].chunks)
            one_side = ONE_SIDE.get((found[-1].link, chunk.value))
            if found[-1].chunks or not margins or found[-1].link in ("main", "when"):
                found.append(Segment(chunk.value, margins=margins))
            elif found[-1].link == "until":
                found[-1].margins, found[-1].side = margins, chunk.value
            elif one_side is not None and [op for op, _ in margins] == ["=="]:
                found[-1] = Segment(chunk.value, margins=[(one_side, margins[0][1])])
            else:
                raise UnknownWordsError("it is not clear how much before or after this is", found=chunk.text)
        elif chunk.kind == "link" and chunk.value in LINKS:
            found.append(Segment(chunk.value, is_sharp=chunk.words in _AT_ONCE))
        else:
            found[-1].chunks.append(chunk)
    for before, segment in pairwise(found):  # "it passes the stop line before the ego (does)"
        if segment.link in ("before", "after") and all(chunk.kind in (*PEOPLE, "mood") for chunk in segment.chunks):
            event = max((at for at, chunk in enumerate(before.chunks) if chunk.kind == "event"), default=None)
            if event is None:  # "brakes before the truck does"
                named = " ".join(chunk.text for chunk in segment.chunks)
                raise UnknownWordsError("it is not clear what is done then", found=named, fix="say what, with its verb")
            segment.chunks = [*segment.chunks[:1], *before.chunks[event:]]
    for segment in found:
        while segment.chunks and segment.chunks[-1].value in (",", "and", "==") and segment.link != "when":
            segment.chunks.pop()
    return found


def _is_clause(chunks: Sequence[Chunk], before: Sequence[Chunk]) -> bool:
    """Whether somebody does or is something here, or is named alone: who does what whoever was told of before does."""
    kinds = [chunk.kind for chunk in takewhile(lambda each: each.kind not in ("link", "comma", "joint"), chunks)]
    if not kinds or kinds[0] not in PEOPLE:
        return False
    does_the_same = kinds[1:] in ([], ["mood"]) and any(chunk.kind == "event" for chunk in before)
    return does_the_same or any(kind in _PREDICATES for kind in takewhile(lambda kind: kind != "possessive", kinds))


def margins_of(found: Sequence[Margin]) -> list[Margin]:
    """Return how much later something is: what is at most 2 s after something is not before it, either."""
    return [*found, (">=", None)] if found and all(op in ("<", "<=") for op, _ in found) else [*found]


def _margins(chunks: list[Chunk]) -> list[Margin]:
    """Take amounts of time off the end of a segment: ``the ego turns at least 2 s | after ...``."""
    found: list[Margin] = []
    while chunks and (amount := chunks[-1].amount) is not None and amount.dimension == "time":
        last = chunks.pop()
        lead = chunks.pop() if chunks and chunks[-1].kind == "bound" else None
        bound = "==" if lead is None else lead.value
        if lead is not None and bound not in (*OPERATORS, "falls"):  # "about 2 s after"
            told, fix = f"{lead.text} {last.text}", "say exactly how much, or at least or at most how much"
            raise UnknownWordsError("it is not clear how much before or after this is", found=told, fix=fix)
        found.insert(0, (OPERATORS["<=" if bound == "falls" else bound], amount))
        if not chunks or chunks[-1].value != "and":
            break
        chunks.pop()
    return margins_of(found)


def parted(chunks: list[Chunk]) -> tuple[list[Chunk], list[Chunk]]:
    """Part a moment from what happens at it: at the first comma before a deed, else at the last."""
    commas, is_aside = list[int](), False
    for index, chunk in enumerate(chunks[:-1]):
        if chunk.kind == "comma":
            following, was_aside = chunks[index + 1].kind, is_aside
            is_aside = following == "relative"
            if not is_aside and (not was_aside or following in PEOPLE):  # "the ego, which turns left, is 10 m ..."
                commas.append(index)
    people = (at for at in range(1, len(chunks) - 1) if chunks[at].kind in PEOPLE and chunks[at + 1].kind == "deed"
              and (not commas or (at < commas[0] and chunks[at - 1].kind in ("place", "amount"))))  # fmt: skip
    if begins := next(people, 0):  # "once the gap is 25 m the truck brakes"
        return chunks[:begins], chunks[begins:]
    if not commas:
        raise UnknownWordsError("it is not clear where the moment ends", fix="put a comma before what happens")
    parts = [chunks[start + 1 : end] for start, end in zip(commas, [*commas[1:], len(chunks)], strict=True)]
    timed = chunks[commas[0] - 1].value == "the start" and all(each.kind not in _ACTS for each in chunks)
    cut = commas[0 if timed else _who_acts(parts)]  # all that is so "5 s after the start"
    main = chunks[cut + 1 :]
    return chunks[:cut], main[1:] if main and main[0].value == "then" else main


def plainly(chunks: list[Chunk]) -> list[Chunk]:
    """Return chunks as they are meant beside each other: "stopped" is standing, "down to 3 m/s" to that speed."""
    found = list[Chunk]()
    for number, chunk in enumerate(chunks):
        last, following = chunks[max(number - 1, 0)].kind, next(iter(chunks[number + 1 :]), chunk)
        fast = following.dimension == "speed"
        rests = following.kind in PEOPLE or last == "comma" or chunks[number - 1].value == "is"  # "a stopped bus"
        if chunk.words == "stopped" and rests:  # "the car, stopped 5 m before it", "is still stopped"
            found.append(replace(chunk, kind="state", value="stands"))
        elif chunk.words in ("through", "across") and (last, following.value) == ("turn", "intersection"):
            found.append(replace(chunk, value="at"))  # "goes straight through the intersection"
        elif chunk.value == "behind" and last == "amount" and following.kind not in (*PEOPLE, "place", "area"):
            found.append(replace(chunk, kind="relation"))  # "follows it 20 m behind"
        elif chunk.value == "behind" and following.kind == "amount" and following.dimension in ("length", "time"):
            found.append(replace(chunk, kind="state", value="drives"))  # "follows 20 m behind the ego"
        elif chunk.words == "down to" and fast and any(each.kind == "deed" for each in found):
            found.append(replace(chunk, kind="side", value="to"))
        elif chunk.kind != "kept" or following.value not in ("acceleration", "deceleration", "rate"):
            found.append(chunk)  # "at a constant rate": one number is one all through
    return found


def goes_on_in(chunks: Sequence[Chunk]) -> bool:
    """Whether in what tells a moment something else is done, by nobody that is named: "until ... and stops"."""
    return any(_does_more(*each) for each in pairwise(chunks))


def _does_more(chunk: Chunk, following: Chunk) -> bool:
    does = following.kind in ("deed", "event", "standstill") and not following.value.startswith("turn_")
    return (chunk.kind == "comma" or chunk.value == "and") and does


def tail_of(chunks: list[Chunk]) -> tuple[list[Chunk], list[Chunk]]:
    """Part a moment behind a deed from what is done besides: "brakes when the ego is ... and stops 5 m before ..."."""
    for at, (chunk, following) in enumerate(pairwise(chunks)):
        dimension = following.dimension
        named = following.kind == "quantity" and following.value in ("rate", "deceleration", "acceleration")
        besides = at > 0 and chunks[at - 1].kind == "comma"
        how = chunk.kind == "side" and chunk.value in ("at", "with") and (named or dimension == "acceleration")
        if (how and named and not besides) or (chunk.kind == "comma" and dimension == "length"):
            told = " ".join(each.text for each in chunks[at:])
            raise UnknownWordsError("it is not clear of whom this is", found=told, fix="say it in front of the moment")
        fast = chunk.kind == "side" and dimension == "speed"
        if fast and chunk.value == "at" and all(each.kind not in ("state", "deed", "quantity") for each in chunks[:at]):
            raise UnknownWordsError("it is not clear who is so fast", found=following.text, fix="say it with its verb")
        rests = (chunk.value, following.value) == ("and", "stands")
        if how or rests or (fast and chunk.value == "to") or _does_more(chunk, following):
            return chunks[:at], chunks[at:]
    return chunks, []


def wishes_otherwise(chunks: Sequence[Chunk]) -> bool:
    """Whether something is meant to be done, but something else is done: "wants to brake but speeds up"."""
    but = next((at for at, chunk in enumerate(chunks) if chunk.kind == "joint" and chunk.text.lower() == "but"), 0)
    meant = any(chunk.kind == "mood" for chunk in chunks[:but])
    return meant and all(any(chunk.kind == "deed" for chunk in part) for part in (chunks[:but], chunks[but:]))


def _who_acts(parts: Sequence[Sequence[Chunk]]) -> int:
    """Return which of the parts between commas begins what happens: it begins with who does it, if anybody is named."""
    acts = [number for number, part in enumerate(parts) if _does(part, *parts[number + 1 : number + 2])]
    names = [number for number, part in enumerate(parts) if _is_named(part)]
    first = next(iter(acts), [len(parts) - 1, *names][-1])  # "..., the van passes the stop line, driving at 5 m/s"
    before = takewhile(lambda each: each.kind not in _ACTS, parts[first])
    if not acts or any(each.kind in PEOPLE for each in before):
        return first
    earlier = [each for each in names if each < first]  # "the car, 30 m before the conflict point, brakes"
    later = [each for each in names if each > first and each in acts]  # "when the car, ..., brakes, the truck ..."
    return next(iter((*earlier[-1:], *later)), first)


def _does(part: Sequence[Chunk], following: Sequence[Chunk] = ()) -> bool:
    """Whether a part tells what is done: what comes to be so is, where it is told what is done after it."""
    then = next((each for each in following if each.value != "and"), None)
    is_before = then is not None and then.value == "then" and _is_named(part)
    return any(each.kind in _ACTS or (is_before and each.kind in ("event", "turn")) for each in part)


def _is_named(part: Sequence[Chunk]) -> bool:
    """Whether a part begins with somebody."""
    opens = next((each for each in part if each.value not in ("and", "then")), None)
    return opens is not None and opens.kind in PEOPLE


def during_of(chunks: list[Chunk]) -> tuple[list[Chunk], list[Chunk]]:
    """Part what is done from what is so while it is: "brakes to 5 m/s while the ego drives at 10 m/s or more"."""
    for at, chunk in enumerate(chunks):
        during = chunks[at + 1 :]
        acts = any(each.kind in _ACTS for each in chunks[:at]), any(each.kind in (*_ACTS, "kept") for each in during)
        if chunk.kind == "joint" and chunk.text.lower() == "while" and acts == (True, False):
            return chunks[:at], during
    return chunks, []


def items_of(people: Cast, chunks: Sequence[Chunk], subject: int | None = None) -> list[Clause]:
    """Return the clauses of a list, and its joined conditions; `subject` is that of a clause that names none."""
    parser = _Items(people, list(chunks), subject)
    found: list[Clause] = []
    while parser.at < len(parser.chunks):
        if parser.chunks[parser.at].kind == "comma" or parser.is_joint("and") or parser.is_beside():
            parser.at += 1
        elif (lead := next((each for each in ("then", "same time") if parser.is_joint(each)), None)) is not None:
            parser.led.add(lead)
            parser.at += 1
        else:
            both = [parser.one(()), *parser.others]
            for item in both:
                item.notes |= parser.led
            found += [*both[1:], both[0]]
            parser.led, parser.others = set(), []
    for item, following in pairwise(found):  # "the ego, a bus and a van drive west"
        if item.subject != following.subject and not item.says_more_than():
            people.refuse("nothing is said here", item.quote, "say it of each")
    for item in found[1:][-1:]:  # "the car brakes, as does the truck"
        if item.subject not in (None, *(each.subject for each in found[:-1])) and not item.says_more_than():
            people.refuse("nothing is said here", item.quote, "say it of each")
    return found


def is_beside(measure: st.Measure) -> bool:
    """Whether it is of where somebody is beside another, and so no way of driving."""
    return measure.other is not None and measure.quantity is not st.Quantity.SPEED


@dataclass(slots=True)
class _Items:
    people: Cast
    chunks: list[Chunk]
    subject: int | None
    at: int = 0
    before: Clause | None = None
    led: set[str] = field(default_factory=set)  # the words in front of the next clause that say when it is
    turned: set[int | None] = field(default_factory=set)  # who turns, as was said
    both: list[Chunk] = field(default_factory=list)  # of whom a clause is said that is said of two
    others: list[Clause] = field(default_factory=list)  # what the last clause says of the others of them

    def is_joint(self, value: str) -> bool:
        chunk = self.chunks[self.at] if self.at < len(self.chunks) else None
        if chunk is None or chunk.kind not in ("joint", "link"):
            return False
        # "After stopping, ..."; "after turning" says more than "then".
        after = chunk.value.startswith(f"{value} ") and "turn" not in chunk.value
        return chunk.value == value or (after and [each.kind for each in self.chunks[self.at + 1 :][:1]] == ["comma"])

    def one(self, inside: tuple[str, ...]) -> Clause:
        """Return the item that begins here; `inside` are the words that end it."""
        while self.at < len(self.chunks) and self.chunks[self.at].kind == "comma":
            self.at += 1
        if self.at >= len(self.chunks):
            self.people.refuse("a condition is missing", fix="say what is so")
        chunk = self.chunks[self.at]
        kinds = [each.kind for each in self.chunks[self.at + 1 : self.at + 4]] + [""] * 3
        joins = chunk.value == "both" and kinds[0] in PEOPLE
        if joins and kinds[2] in PEOPLE and self.chunks[self.at + 2].value == "and":  # "both the ego and the hero"
            self.at += 1
        elif joins or (chunk.kind == "joint" and chunk.value in (*_JOINTS, "not so")):
            return self._joined(chunk, inside)
        return self._clause(inside)

    def _joined(self, chunk: Chunk, inside: tuple[str, ...]) -> Clause:
        self.at += 1
        if chunk.value == "not so":
            return Clause(chunk.quote, joined=[st.Compound("not", (self._part(inside),), chunk.quote)])
        joint, link = _JOINTS[chunk.value]
        parts = [self._part((*inside, link))]
        while self.is_joint(link):
            self.at += 1
            parts.append(self._part((*inside, link)))
        if len(parts) < 2 or (joint == "if" and len(parts) > 2):
            self.people.refuse(f"'{chunk.text}' needs '{link}'", chunk.quote, "say what it joins")
        return Clause(chunk.quote, joined=[st.Compound(joint, tuple(parts), chunk.quote)])

    def _part(self, inside: tuple[str, ...]) -> st.Condition:
        item = self.one(inside)
        if self.others:
            self.people.refuse("this is said of two at once", item.quote, "say it of each")
        line_up(item)
        if not item.conditions or item.says_more_than("measures", "joined"):
            self.people.refuse("this is no condition", item.quote, "say what is so")
        one, several = item.conditions[0], tuple(item.conditions)
        return one if len(several) == 1 else st.Compound("and", several, item.quote)

    def _clause(self, inside: tuple[str, ...]) -> Clause:
        subjects = self._subjects()
        start = self.at
        if [each.kind for each in self.chunks[max(start - 2, 0) : start + 1]] == ["pronoun", "comma", "relative"]:
            self.people.refuse("it is not clear of whom this is", self.chunks[start].quote, "say who")
        while self.at < len(self.chunks):
            chunk = self.chunks[self.at]
            parts = chunk.kind == "comma" or (chunk.kind == "joint" and chunk.value in ("and", "or"))
            before = [each.value for each in self.chunks[max(self.at - 3, start) : self.at - 1]]
            between = before[-1:] == ["between"] or (before[-1:] == ["of"] and before[0] in st.BETWEEN)
            between &= self.chunks[self.at - 1].kind in PEOPLE
            closes = any(self.is_joint(link) for link in inside) or self.is_beside()
            if self.at > start + 1 and self._is_of_another():  # "40 m behind a van that stands": the van stands
                who = [replace(chunk, kind="relative", traits=())]
                self.chunks[self.at : self.at + (chunk.kind == "relative")] = who
                break
            fronted = self._is_fronted(start)
            if self.at > start and (closes or (parts and not (between or fronted) and self._begins(self.at + 1))):
                break
            self.at += 1
        own = [chunk for chunk in self.chunks[start : self.at] if chunk.kind != "comma"]
        if [each.kind for each in own if each.kind not in ("be", "bound")] in ([who, "amount"] for who in PEOPLE):
            own += self._to_come(own[-1])
        if [chunk.value for chunk in own[:2]] == ["it", "is"] and own[-1].value == "the start":
            own = own[2:]  # nobody: "it is 5 s after the start"
        if subjects or (own and own[0].kind in PEOPLE):
            self.both = subjects
        for each in self.both[:-1]:
            self.others.append(self._read([each, *own]))
        self.before = self._read([*self.both[-1:], *own])
        for clause in (*self.others, self.before):
            clause.notes |= {"both"} if self.both else set()
        beside = [(of.actor, of.other) for each in (*self.others, self.before) for of in each.measures if is_beside(of)]
        if self.both and any((other, one) in beside for one, other in beside):  # "both drive with a headway of 2 s"
            self.people.refuse("it is not said whose this is to whom", own[0].quote, "say it of the one behind")
        if any(each.subject == self.before.subject for each in self.others):
            self.people.refuse("one and the same is named twice", self.before.quote)
        return self.before

    def _to_come(self, last: Chunk) -> Sequence[Chunk]:
        """Return what the next clause counts its amount to: "the ego is 3 s and the hero 4 s from it"."""
        following = [each for each in self.chunks[self.at :] if each.kind not in ("be", "bound")]
        kinds = [each.kind for each in following[1:4]]
        same = [each.dimension for each in following[2:3]] == [last.dimension]
        if not same or following[0].value != "and" or kinds[0] not in PEOPLE or kinds[1:] != ["amount", "side"]:
            return []
        return [*takewhile(lambda each: each.kind not in ("comma", "joint", "link"), following[3:])]

    def _read(self, own: list[Chunk]) -> Clause:
        clause = read_clause(own, self.people, self.subject if self.before is None else self.before.subject)
        if clause.turns:
            self.turned.add(clause.subject)
        elif clause.subject in self.turned and "heading" in clause.facts and "headed" not in clause.flags:
            heading = clause.facts.pop("heading")  # "turns left out of it and goes east"
            if clause.facts.setdefault("destination_heading", heading) != heading:
                self.people.refuse("two headings are told", clause.quote)
        return clause

    def _is_of_another(self) -> bool:
        """Whether it is said here what somebody does who was named beside whom the clause is of."""
        before, chunk = self.chunks[self.at - 1], self.chunks[self.at]
        linked = chunk.kind == "relative" or (chunk.kind == "state" and chunk.text.endswith("ing"))
        linked |= bool(_LINKED & {*self.people.text[before.end : chunk.start].lower().split()})
        if linked and before.kind == "pronoun":
            self.people.refuse("it is not clear of whom this is", chunk.quote, "say it in a sentence of its own")
        return linked and before.kind in ("actor", "name")

    def is_beside(self) -> bool:
        """Whether it is said here how somebody else is: "with the ego 20 m behind it"."""
        opens, *following = self.chunks[self.at : self.at + 4]
        far = [each.kind for each in following] in ([who, "amount", "side"] for who in PEOPLE)
        return far and following[1].dimension == "length" and (opens.kind, opens.value) == ("side", "with")

    def _is_fronted(self, start: int) -> bool:
        """Whether what stands before this comma is of whom is named after it: "Behind it, the ego drives"."""
        opens = start == 0 and not any(chunk.kind in PEOPLE for chunk in self.chunks[:1])
        named = self.at + 1 < len(self.chunks) and self.chunks[self.at + 1].kind in PEOPLE
        return opens and named and self.chunks[self.at].kind == "comma" and self.chunks[0].kind in _FRONTED

    def _subjects(self) -> list[Chunk]:
        """Take the two whom a clause is about: "both", "the ego and the hero"."""
        chunks = self.chunks[self.at : self.at + 4]
        if chunks[0].kind == "pair":
            self.at += 1
            return [replace(chunks[0], kind="name", value=self.people.actor(each).name, traits=())
                    for each in self.people.pair(chunks[0])]  # fmt: skip
        kinds = [chunk.kind for chunk in chunks]
        if len(chunks) == 4 and kinds[0] in PEOPLE and kinds[2] in PEOPLE and chunks[1].value == "and":
            self.at += 3 + (self.chunks[self.at + 3].kind == "pair")  # "the ego and the truck both drive west"
            return [chunks[0], chunks[2]]
        return []

    def _begins(self, at: int) -> bool:
        """Whether a clause begins here."""
        skipped = (("joint", "and"), ("link", "then"), ("link", "same"), ("comma", ","))
        while at < len(self.chunks) and (self.chunks[at].kind, self.chunks[at].value.split(" ")[0]) in skipped:
            at += 1
        at += 2 * ([each.value for each in self.chunks[at + 1 : at + 2]] == ["later"])  # "and 1 s later it speeds up"
        return at < len(self.chunks) and self.chunks[at].kind in _BEGINS_A_CLAUSE
