"""Takes the chunks of one clause: whom it is about, what is done, what is said of a way, amounts and what they go to.

What enters: the chunks of a clause, and who its people are. What leaves: a `Clause` with what is said of its subject,
or an `UnknownWordsError` with the words that nothing could be made of. Order decides only what is nearest.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace

from scenewright.errors import UnknownWordsError
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.compile import COMPASS, counted_down
from scenewright.translate.phrases import OTHERWISE, amount
from scenewright.translate.read.cast import Cast
from scenewright.translate.read.chunks import Chunk
from scenewright.units import Dimension

IT = -1  # the subject, in a measure of a clause that is still being read
PEOPLE = ("actor", "name", "pronoun", "relative")
OPERATORS: dict[str, st.Operator] = {"==": "==", ">=": ">=", "<=": "<=", ">": ">", "<": "<"}
# Verbs that may have an amount: "reaches a point 12 m before".
_REACHES = ("reach", "get", "got", "come", "came", "arriv")
_CONFLICT = st.Place("turn")  # where a driveway joins a road
_SIDES = ("before", "behind", "from", "to", "ahead", "past")  # of a place that an amount is counted to
_WHERE = tuple(("side", side) for side in (*_SIDES, "at"))
_OF_AMOUNTS = ("amount", "bound", "quantity", "kept", "no unit")
_AFTER = {  # what may stand behind a side that says no more than that it belongs there: "to pass it", "at a speed of"
    "to": (*_OF_AMOUNTS, "event", "turn", "deed", "state", "phase", "mood"), "at": _OF_AMOUNTS, "of": _OF_AMOUNTS,
    "for": _OF_AMOUNTS, "in": _OF_AMOUNTS, "with": (*_OF_AMOUNTS, "turn", "deed"), "by": ("turn", "deed"),
}  # fmt: skip
_DIMENSIONS: dict[str, Dimension] = {
    "speed": "speed", "gap": "length", "bumper-to-bumper gap": "length", "headway": "time", "time to collision": "time",
    "time to arrival": "time", "rate": "acceleration", "acceleration": "acceleration", "deceleration": "acceleration",
}  # fmt: skip
_FOLLOWS = ("follow", "trail", "tail", "lead", "drive", "drove")
_INITIAL = (("at", "link", "start"), ("with", "link", "start"))  # "with an initial speed of"


@dataclass(slots=True)
class Clause:
    """What one clause says.

    Amounts are gathered in lists, so that none takes the place of another; `agree` refuses those that do not fit.

    `flags` are: ``standstill``, ``while`` (the end is open), ``to`` a speed, ``to there`` a place, ``first``,
    ``start``, ``kept`` (its speed), ``way`` (it is open), ``falls`` (an amount that is reached), ``yields``,
    ``insists``, ``no stop``, ``no brake``.
    """

    quote: st.Quote
    subject: int | None = None
    deed: str | None = None
    phase: str | None = None
    ordinal: int = 0
    measures: list[st.Measure] = field(default_factory=list)
    begins: list[st.Measure] = field(default_factory=list)  # what is so where its deed begins
    joined: list[st.Compound] = field(default_factory=list)  # by "either", "both", "if": of whomever they are
    rates: list[st.Measure] = field(default_factory=list)
    times: dict[str, list[tuple[st.Operator, st.Amount]]] = field(default_factory=dict)
    facts: dict[str, str] = field(default_factory=dict)
    flags: set[str] = field(default_factory=set)
    relations: list[st.Relation] = field(default_factory=list)
    # How it is said, which is no meaning by itself: as an ``event``, as ``wanted``; that it has a verb (``said``), of a
    # deed (``does``), is of two (``both``), began before (``at it``), names a ``distance``, or a place ``between``.
    notes: set[str] = field(default_factory=set)

    def says_more_than(self, *expected: str) -> bool:
        """Whether anything but these attributes is filled: what carries meaning must be used up."""
        known = {*expected, "quote", "subject", "notes"}
        return any(getattr(self, each.name) for each in fields(self) if each.name not in known)

    @property
    def conditions(self) -> list[st.Condition]:
        """All that it says is so."""
        return [*self.measures, *self.joined]

    @property
    def rests(self) -> bool:
        """Whether what is done ends in a standstill."""
        return self.deed == "stop" or "standstill" in self.flags

    @property
    def turns(self) -> bool:
        """Whether its way is told to turn."""
        return self.facts.get("turn", "straight") != "straight"

    @property
    def is_event(self) -> bool:
        """Whether it says that its subject comes to a place, and nothing else."""
        told = self.says_more_than("measures") or not self.measures or "event" not in self.notes
        return not told and all(st.is_event(each) for each in self.measures)

    def agree(self) -> None:
        """Refuse two amounts for one thing."""
        agree((*self.measures, *self.rates), self.quote)
        agree(self.begins, self.quote)
        for several in self.times.values():
            agree((st.Measure(IT, st.Quantity.ARRIVAL, *each) for each in several), self.quote)


def agree(measures: Iterable[st.Measure], quote: st.Quote) -> None:
    """Refuse, in the words of `quote`, two amounts for one thing, unless they are a lower and an upper bound of it."""
    known: dict[object, list[st.Measure]] = {}
    for each in measures:
        same = known.setdefault((each.actor, each.quantity, each.place, each.other), [])
        for other in same:
            if each != other and {is_upper(each), is_upper(other)} != {True, False}:
                both = " and ".join(amount(one.amount) if one.amount else f"{one.quote and one.quote.text}"
                                    for one in (other, each))  # fmt: skip
                fix = "say one of them, or at least how much and at most how much"
                raise UnknownWordsError(f"two amounts for one thing: {both}", found=quote.text, fix=fix)
        same.append(each)


def is_upper(measure: st.Measure) -> bool | None:
    """Whether a measure bounds its quantity from above, or from below; None where it is exact."""
    down = counted_down(measure.quantity, measure.opposite) and measure.amount is not None
    return None if measure.op == "==" else (measure.op in ("<", "<=")) is not down


@dataclass(slots=True)
class Target:
    """What an amount may be counted to: a place or somebody, with the side that it lies on; "it" is neither yet."""

    at: int
    side: str
    chunk: Chunk
    place: st.Place | None = None
    other: int | None = None
    used: bool = False


@dataclass(slots=True)
class Taken:
    """A clause while it is read: what was found in it, in order; `at` is the last chunk that was taken."""

    chunks: list[Chunk]
    people: Cast
    subject: int | None = None  # of whom it is where it names nobody
    at: int = 0
    clause: Clause = field(init=False)
    amounts: list[tuple[int, st.Operator, Chunk]] = field(default_factory=list)
    last: Target | None = None  # what the last amount is counted to
    ranges: set[int] = field(default_factory=set)  # amounts that end a range: counted to what the one before is
    beyond: dict[int, Chunk] = field(default_factory=dict)  # by amount: that it may be on the other side, too
    targets: list[Target] = field(default_factory=list)
    states: set[str] = field(default_factory=set)
    quantities: dict[str, str] = field(default_factory=dict)  # that are named, by what they are amounts of
    subject_at: int = 0
    deed_at: int = -1
    stands_at: int = -1  # where it is said to what it does it: to a standstill, to a speed, to a place
    pair: tuple[int, int] | None = None  # between whom a gap is

    def __post_init__(self) -> None:
        start, end = self.chunks[0].start, self.chunks[-1].end
        self.clause = Clause(st.Quote(start, end, self.people.text[start:end]))

    def take(self, chunk: Chunk) -> None:
        """Take the chunk at `at`, and those behind it that belong to it."""
        clause, value, reaches = self.clause, chunk.value, bool(self.states & {"pass", "reach"})
        either = self.people.either(self.subject)
        match chunk.kind:
            case "pronoun" if (value, self.peek()[0]) == ("its", "quantity") and clause.subject is None and either:
                clause.subject = self.people.who(chunk, is_either=True)
            case "pronoun" if value == "it" and reaches:
                self.targets.append(Target(self.at, "at", chunk, self.people.where(chunk)))
            case _ if self._says_no_more(chunk):
                pass
            case "relative" if "deed" in (self.peek()[0], self.peek(2)[0]):
                raise self.left_over(chunk)  # "which was braking" is no deed of the moment
            case "relative" if clause.subject is not None and self.at == self.subject_at + 1:
                clause.notes.add("relative")
            case "actor" | "pronoun" | "name" | "relative" if clause.subject is None:
                kinds = {each.kind for each in self.chunks}
                acts = "deed" in kinds or ("turn" in kinds and "mood" not in kinds)
                either &= not acts or self.subject in self.people.acting
                clause.subject, self.subject_at = self.people.who(chunk, acts, either), self.at
                clause.notes |= {"relative"} if chunk.kind == "relative" else set()
            case "quality" if chunk.text.lower() == "first" and self.peek()[0] in ("deed", "phase"):
                pass  # what it does first is told first
            case "quality" if self.peek(-1)[0] != "be" or chunk.words == "first":  # "the truck is red", not "5 m heavy"
                raise self.left_over(chunk)
            case "be" | "possessive" | "quality":
                clause.notes |= {value} & {"has", "stays"}
                clause.notes |= {"at it"} if chunk.kind == "be" and self._is_at_it(value) else set()
            case "mood":
                clause.notes.add(value)
            case "amount" | "no unit":
                self._amount(chunk)
            case "near":
                just = st.Amount(JUST_BEFORE_M, "m", None, chunk.quote)
                self.amounts.append((self.at, "==", replace(chunk, amount=just)))
                self._target(value)
            case "side":
                self._side(chunk)
            case "beyond" if self.amounts:
                self.beyond[self.amounts[-1][0]] = chunk
            case "place" if reaches or self.peek()[0] in ("be", "event"):
                self.at -= 1
                self._target("at")
            case "area" if value == "driveway" and (reaches or (clause.subject is None and self.peek(2)[1] == "ahead")):
                self.targets.append(Target(self.at, "at", chunk, _CONFLICT))
            case "deed" if clause.deed is None:
                clause.deed, self.deed_at = value, self.at
                rests = chunk.words.endswith((" off", " away", " out")) or chunk.words.startswith(("start", "resum"))
                clause.notes |= {"does", *(["sets off"] if rests and value == st.Verb.DRIVE else [])}
            case "from rest" if clause.phase == "begins" or clause.deed in (st.Verb.DRIVE, st.Verb.SPEED_UP):
                clause.notes.add("sets off")
            case "phase" if clause.phase is None:
                clause.phase = value
            case "ordinal" if all(each.kind != "ordinal" for each in self.chunks[: self.at]):
                clause.ordinal = int(value)
            case "refrains" if self.peek()[0] in ("amount", "near") or self.peek() in _WHERE:
                raise self.left_over(self.chunks[self.at + 1])  # "without stopping at the junction": it is there or not
            case "standstill" | "open" | "kept" | "order" | "yields" | "insists" | "refrains":
                clause.flags.add(value)
                self.stands_at = self.at if chunk.kind == "standstill" else self.stands_at
            case "link" if value == "start":
                clause.flags.add("start")
            case "relation" if value in ("ahead", "behind") and self.peek(-1)[0] == "amount":
                self.targets.append(Target(self.at, value, chunk))
            case "relation":
                clause.relations.append(st.Relation(value, EGO, chunk.quote))
            case "state" | "event":
                may = value == "pass" and (chunk.text.lower().startswith(_REACHES) or chunk.text.endswith(" point"))
                self.states.add("reach" if may else value)
                clause.notes |= {"event", value} if chunk.kind == "event" else {value}
            case "quantity" if self.quantities.get(_DIMENSIONS[value], "rate") in ("rate", value):
                self.quantities[_DIMENSIONS[value]] = value
            case "factor" if value == "as fast as" or self.peek() == ("side", "than"):
                self._factor(chunk)
            case "joins" if self.targets and all(e.value == "ego" for e in self.chunks[self.at :] if e.kind == "actor"):
                self.at = len(self.chunks)
            case "turn" | "heading" | "origin" | "then_headed" | "area" | "lanes":
                self.way(chunk)
            case _:
                raise self.left_over(chunk)

    def _is_at_it(self, value: str) -> bool:
        """Whether what follows "is" or "has" began before: "has braked", "has been driving", "is braking"."""
        following = self.chunks[min(self.at + 1, len(self.chunks) - 1)]
        did = following.kind in ("deed", "event", "state") or following.words == "been"
        changes = following.value in (st.Verb.BRAKE, st.Verb.SPEED_UP)
        return did if value == "has" else value == "is" and changes and following.words.split()[0].endswith("ing")

    def _may_be_of_another(self) -> bool:
        """Whether this is said right behind somebody else, and no way of driving says whose it is."""
        moves = self.clause.deed is not None or "drives" in self.states
        moves |= any(each.kind == "side" and each.words.startswith(_FOLLOWS) for each in self.chunks)  # "follows it"
        kinds = ("side", "bound", "amount", "quantity")
        at = next((at for at in range(self.at - 1, 0, -1) if self.chunks[at].kind not in kinds), 0)
        is_other = self.chunks[at].kind in ("actor", "name") and at not in (self.subject_at, self.at - 1)
        fast, own = self.chunks[self.at].dimension == "speed", self.clause.subject is not None
        apart = not fast and "," in self.people.text[self.chunks[at].end : self.chunks[self.at].start]
        return is_other and not (moves or apart) and (own or self.subject is not None)

    def _says_no_more(self, chunk: Chunk) -> bool:
        """Whether a chunk is taken with its neighbours, or says here what they say."""
        following, before = self.peek()[0], self.chunks[self.at - 1] if self.at else chunk
        match chunk.kind:
            case "pronoun":
                return chunk.value == "its"
            case "bound":  # "drops to less than 12 m", not "at least about 12 m"
                bounds = following in ("amount", "no unit", "near") or self.peek()[1] == "as fast as"
                return chunk.value == "falls" if following == "bound" else bounds
            case "link":  # "north, then south"
                return chunk.value == "then" and before.kind == following == "heading"
        is_and = (chunk.kind, chunk.value) == ("joint", "and")
        both = before.kind == "amount" and self.peek()[1] in OPERATORS  # "at least 4 m/s^2 and at most 6 m/s^2"
        return is_and and (both or following == "side")  # "across it and into the driveway"

    def bound(self) -> st.Operator:
        """Return the bound in front of the amount at `at`; one that is only reached is told, a vague one is asked."""
        kind, value = self.peek(-1)
        if kind != "bound":
            return "=="
        amount = self.chunks[self.at]
        self.clause.flags |= {value} & {"falls"}
        onto = self.clause.deed == st.Verb.DRIVE and self.chunks[self.at - 1].words == "up to"
        if onto and amount.dimension == "length":
            self.clause.flags.add("to there")  # "drives on up to 5 m before it"
            return "=="
        if value == "about":
            told = f"{self.chunks[self.at - 1].text} {amount.text}"
            exact: dict[str, st.Operator] = {f"exactly {amount.text}": "==", f"at most {amount.text}": "<=",
                                             f"at least {amount.text}": ">="}  # fmt: skip
            return exact[self.people.ask(f"vague {amount.start}", f"How much is '{told}'?", [*exact], 0, amount.quote)]
        return OPERATORS.get(value, "==")

    def _amount(self, chunk: Chunk) -> None:
        fast = chunk.dimension == "speed"
        if fast and self._may_be_of_another():
            raise self.left_over(chunk)  # "slower than the ego at 15 m/s"
        turns = any(each.kind == "turn" and each.value != "straight" for each in self.chunks[: self.at])
        self.clause.notes |= {"comes"} if fast and turns and not {"drives", "goes"} & self.states else set()
        op, amount = self.bound(), chunk.amount
        lead = self.peek(-2 if self.peek(-1)[0] == "bound" else -1)
        if amount is None:
            raise self.left_over(chunk)
        led = [each for each in ("for", "in")
               if lead == ("side", each) or (lead == ("joint", "and") and each in self.clause.times)]  # fmt: skip
        within = "in" in led or (self.peek(-1)[1] == "falls" and self.peek()[0] != "side")
        lasts = "for" in led or (lead == ("deed", st.Verb.STAND) and self.peek()[0] != "side")  # "waits 2 s"
        kinds = {  # of times, each with how many words behind belong to it
            "for": (lasts, 0), "in": (within and self.clause.deed is not None, 0),  # "stops in 4 s", "within 4 s"
            "later": (self.peek() == ("link", "later"), 1),  # "brakes 1 s later", and not "in 4 s, later ..."
            "after the start": ((self.peek(1)[1], self.peek(2)[1]) == ("after", "the start"), 2),
        }  # fmt: skip
        kind = next((each for each, (fits, _) in kinds.items() if fits), "")
        if kind and amount.dimension == "time":
            op = "<=" if kind == "in" and self.peek(-1)[1] == "falls" else op
            self.clause.flags -= {"falls"} if kind == "in" else set()
            self.clause.times.setdefault(kind, []).append((op, amount))
            self.at += kinds[kind][1]
        else:
            both = [self.peek(back)[0] for back in (-1, -2, -3)] == ["bound", "joint", "amount"]
            self.ranges |= {self.at} if both else set()  # "at least 20 m and at most 25 m before it"
            self.amounts.append((self.at, op, chunk))

    def _side(self, chunk: Chunk) -> None:
        side, (kind, value) = chunk.value, self.peek()
        is_fast = self.at > 0 and self.chunks[self.at - 1].dimension == "speed"
        if is_fast and side in _SIDES and (kind == "place" or (kind in PEOPLE and side not in ("ahead", "behind"))):
            raise self.left_over(chunk)  # "12 m/s before the stop line"
        if side in ("across", "to") and kind in PEOPLE and (side == "across" or "yields" in self.clause.flags):
            self.at += 1  # "turns left across the ego's path", "yields to the ego"
            own = self.subject if self.clause.subject is None else self.clause.subject
            if self.people.who(self.chunks[self.at]) == own:
                raise self.left_over(chunk)
            self.at += 2 if (self.peek()[0], self.peek(2)[0]) == ("possessive", "thing") else 0
        elif side == "between" or (side == "of" and kind in PEOPLE and self.peek(-1)[0] == "quantity"):
            self._between(chunk)
        elif kind in ("place", *PEOPLE):
            self._target(side)
        elif (kind, value) == ("area", "driveway") and side in _SIDES and self.peek(-1)[0] == "amount":
            self.targets.append(Target(self.at, side, self.step(), _CONFLICT))
        elif (side, kind) == ("from", "amount") and self.clause.deed is not None:  # "brakes from 13 m/s to 8 m/s"
            if (told := self.step()).dimension != "speed":
                raise self.left_over(chunk)
            self.clause.begins.append(st.Measure(IT, st.Quantity.SPEED, "==", told.amount, quote=chunk.quote))
        elif side == "to" and self.clause.deed and (kind in ("amount", "bound") or value in ("speed", *st.BETWEEN)):
            self.clause.flags.add("to there" if self._is_far() else "to")
            self.stands_at = max(self.stands_at, self.at)
        elif side == "to" and kind == "amount" and self.clause.phase is None and (not self.amounts or self._is_far()):
            raise self.left_over(chunk)  # "but only to 10 m/s", "drives at 5 m/s to 10 m before it"
        elif not (self.road(side) or kind in _AFTER.get(side, ()) or (side, kind, value) in _INITIAL):
            raise self.left_over(chunk)

    def _is_far(self) -> bool:
        """Whether the next amount is one of a place: how far, or how long, from there."""
        told = (each.dimension for each in self.chunks[self.at + 1 : self.at + 5] if each.dimension)
        return next(told, "") in ("length", "time")

    def _between(self, chunk: Chunk) -> None:
        """Take "between them", "between the ego and the hero", "of the ego and the hero", or "of the ego" alone."""
        if self.pair is not None:
            raise self.left_over(chunk)
        self.at += 1
        if self.peek(0)[0] == "pair":
            self.pair = self.people.pair(self.chunks[self.at])
            return
        both = [self.peek(ahead)[0] in PEOPLE for ahead in (0, 2)] == [True, True] and self.peek()[1] == "and"
        if not both and (chunk.value != "of" or self.clause.subject is not None):
            raise self.left_over(chunk)
        one = self.people.who(self.chunks[self.at])
        if both:
            self.pair = one, self.people.who(self.step(2))
        else:
            self.clause.subject, self.subject_at = one, self.at

    def _target(self, side: str) -> None:
        """Take the place or the actor after a side, with whose the place is and with whom."""
        at = self.at
        self.at += 2 if self.peek()[1] == "its" else 1
        if self.at >= len(self.chunks):
            raise self.left_over(self.chunks[at])
        target = Target(at, side, chunk := self.chunks[self.at])
        self.targets.append(target)
        if chunk.kind == "pronoun":  # who somebody is ahead of or behind, else the place that was spoken of last
            target.place = None if side in ("ahead", "behind") else self.people.where(chunk)
        elif chunk.kind == "place":
            if self._may_be_of_another():
                raise self.left_over(chunk)  # "20 m behind the van at the stop line"
            target.place = self._place(chunk)
        else:
            who = self.people.who(chunk)
            if self.peek()[0] == "possessive" and self.peek(2)[0] == "place":
                target.place = replace(self._place(self.step(2)), of=who)
            elif self.peek()[0] == "possessive" and "area" in (self.peek(2)[0], self.peek(3)[0]):
                if self.peek(2)[0] != "area" and self.peek(2)[1] != "oncoming":
                    raise self.left_over(chunk)
                self.area(self.step(2 if self.peek(2)[0] == "area" else 3), side)  # "into the ego's lane"
                self.targets.remove(target)
            else:
                target.other = who

    def _place(self, chunk: Chunk) -> st.Place:
        place = st.Place(chunk.value)
        for side in ("of", "with"):
            named = self.peek()[1] == side and self.peek(2)[0] in ("actor", "name")
            if named and (side == "of" or chunk.value in ("conflict_point", "intersection", "turn")):
                person = self.people.who(self.step(2))
                place = replace(place, of=person) if side == "of" else replace(place, partner=person)
        self.people.place = place
        return place

    def _factor(self, chunk: Chunk) -> None:
        """Take "2 m/s faster than the ego", "at least as fast as the ego"."""
        op, amount = self.bound(), None
        if chunk.value != "as fast as":
            op = ">" if chunk.value == "faster" else "<"
            apart = "," in self.people.text[self.chunks[self.at - 1].end : chunk.start]  # "at 15 m/s, faster than it"
            if self.amounts and self.amounts[-1][0] == self.at - 1 and not apart:
                _, op, told = self.amounts.pop()
                amount = told.amount
            self.at += 1
        if self.peek()[0] not in ("actor", "name"):
            raise self.left_over(chunk)
        other = self.people.who(self.step())
        slower = chunk.value == "slower" and amount is not None
        self.measure(chunk, st.Measure(IT, st.Quantity.SPEED, op, amount, other=other, opposite=slower))

    def measure(self, chunk: Chunk, measure: st.Measure) -> None:
        """Add a measure with the words that it came from."""
        self.clause.measures.append(replace(measure, quote=chunk.quote))

    def peek(self, ahead: int = 1) -> tuple[str, str]:
        """Return kind and value of a chunk from here; nothing where there is none."""
        at = self.at + ahead
        return (self.chunks[at].kind, self.chunks[at].value) if 0 <= at < len(self.chunks) else ("", "")

    def step(self, by: int = 1) -> Chunk:
        """Go on to a chunk behind this one, and return it."""
        self.at += by
        return self.chunks[self.at]

    def left_over(self, chunk: Chunk) -> UnknownWordsError:
        """Return the error that names a chunk that nothing was made of."""
        expected = "a number with a unit, such as 12 m" if chunk.kind == "no unit" else None
        message, found = f"'{chunk.text}' could not be understood here", self.clause.quote.text
        return UnknownWordsError(message, found=found, expected=expected, fix=OTHERWISE)

    def way(self, chunk: Chunk) -> None:
        """Take a chunk that says how somebody drives, with what belongs to it."""
        facts, before = self.clause.facts, self.peek(-1)[1]
        if chunk.kind == "heading" and before == "then" and self.peek(-2)[0] == "heading":
            facts["headings"] = facts.get("headings", facts.pop("heading", "")) + chunk.value  # "north, then south"
        elif chunk.kind == "heading":
            self.headed(chunk)
        elif chunk.kind == "area":
            self.area(chunk)
        elif chunk.kind == "origin" and self.road("from"):
            self.clause.notes.add("origin")
        elif chunk.kind == "origin" or (chunk.kind == "then_headed" and self.peek()[0] != "heading"):
            raise self.left_over(chunk)
        elif (chunk.words[:3] == "to " and "origin" not in facts) or before == ("to" if self.clause.deed else "has"):
            raise self.left_over(chunk)  # not "is to the left", "brakes to turn right" or "has just turned right"
        else:
            if chunk.text.lower().split()[0] in ("turning", "making", "taking"):
                self.clause.notes.add("wanted")
            self.fact("then" if chunk.kind == "then_headed" else chunk.kind, chunk)

    def road(self, side: str) -> bool:
        """Take the road, the lane or the direction behind a side, where one is: "from the east", "into the road"."""
        kind = self.peek()[0]
        is_lane = (kind, self.peek(2)[0]) == ("heading", "area")  # "the westbound lane" is no direction to come from
        if is_lane and side in ("from", "into", "to", "at") and self.chunks[self.at + 1].text.lower().endswith("bound"):
            self.fact("destination_heading" if side == "into" else "heading", self.step())
            self.area(self.step(), side)
        elif kind == "heading" and side in ("to", "from"):  # who comes from the east is headed west
            self.headed(self.step(), back=side == "from")
        elif kind == "area" and side in ("at", "into", "from"):
            self.area(self.step(), side)
        else:
            return False
        return True

    def headed(self, chunk: Chunk, back: bool = False) -> None:
        """Take a heading, of the way before or after its turn; `back` is where somebody comes from."""
        later = "then" in self.clause.facts or self.clause.turns
        if back:
            chunk = replace(chunk, value=COMPASS[(COMPASS.index(chunk.value) + 2) % 4])
        self.fact("destination_heading" if later and not back else "heading", chunk)

    def area(self, chunk: Chunk, side: str = "") -> None:
        """Take a road, from which or into which somebody drives; who approaches one does not come from there."""
        before = self.chunks[self.at - 1].words if self.at else ""
        if (before.endswith("off") and "turn" not in self.clause.facts) or (not side and before[:8] == "approach"):
            raise self.left_over(chunk)
        self.clause.notes |= {"area"} if self.clause.deed not in (None, st.Verb.DRIVE) else set()  # "stops in it"
        self.fact("destination" if side == "into" or (self.clause.turns and side != "from") else "origin", chunk)

    def fact(self, name: str, chunk: Chunk) -> None:
        """Take one fact of a way; two that differ are left over."""
        if self.clause.facts.setdefault(name, chunk.value) != chunk.value:
            raise self.left_over(chunk)
