"""The story: one typed frame between language and program, filled by a model or by the offline reader.

What enters: nothing. What leaves: frozen data that says who there is, which moments matter, what holds at them,
who does what between them, and in which order. It knows no program, no map and no words; what the program language
does not know (a kind of road user, a deed) may stand in it and is refused by name when it is compiled.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from enum import StrEnum
from fractions import Fraction
from itertools import combinations
from typing import Literal, TypeGuard, TypeVar

from scenewright.errors import Span
from scenewright.program.manner import USUAL, Manner
from scenewright.program.types import DEFAULT_MAP, EGO, Parameter
from scenewright.units import UNITS, Dimension

T = TypeVar("T")
Operator = Literal["==", "<=", ">=", "<", ">"]
How = Literal["always", "never", "at some time"]
START = 0  # the first moment of every story


@dataclass(frozen=True, slots=True)
class Quote:
    """The stretch of text that something came from."""

    start: int
    end: int
    text: str

    @property
    def span(self) -> Span:
        """The same as a span of the text."""
        return Span(self.start, self.end)


@dataclass(frozen=True, slots=True)
class Amount:
    """A number with its unit as it was written, or a parameter by its name (whose unit is that of the name)."""

    value: Fraction | None
    unit: str
    name: str | None = None
    quote: Quote | None = field(default=None, compare=False, repr=False)

    @property
    def dimension(self) -> Dimension:
        """What it is an amount of."""
        return UNITS[self.unit].dimension

    @property
    def si(self) -> Fraction | None:
        """The number in SI units; None for a parameter."""
        return None if self.value is None else self.value * UNITS[self.unit].si_factor


class Quantity(StrEnum):
    """What a measure measures, in the words for it."""

    PLACE = "place"  # before or past a place of its route, in metres
    ARRIVAL = "time to arrival"  # at a place
    SPEED = "speed"
    RATE = "acceleration"
    GAP = "gap"  # how far `other` is ahead
    FREE_SPACE = "bumper-to-bumper gap"  # likewise, between the bodies
    HEADWAY = "headway"
    COLLISION = "time to collision"


BETWEEN = (Quantity.GAP, Quantity.FREE_SPACE, Quantity.HEADWAY, Quantity.COLLISION)  # of who is behind, to who is ahead


@dataclass(frozen=True, slots=True)
class Place:
    """A landmark; `of` None means of whoever is measured, `partner` None the usual one of a conflict point."""

    name: str
    of: int | None = None
    partner: int | None = None


@dataclass(frozen=True, slots=True)
class Measure:
    """One thing that is so: the atom of every condition.

    A place without an amount: ``==`` at it, ``>=`` has reached it, ``>`` is past it, ``<`` is before it. An `opposite`
    amount is counted the other way: past a place, not before it; slower than `other`, not faster; slowing.
    """

    actor: int
    quantity: Quantity
    op: Operator
    amount: Amount | None = None
    place: Place | None = None
    other: int | None = (
        None  # whom a distance, a headway or a time to collision is to; with whose speed one is compared
    )
    opposite: bool = False
    quote: Quote | None = field(default=None, compare=False, repr=False)

    @property
    def left(self) -> Fraction | None:
        """How far it is to its place, in metres, less than none past it; None where that is not told exactly."""
        if (self.quantity, self.op) != (Quantity.PLACE, "=="):
            return None
        far = Fraction(0) if self.amount is None else self.amount.si
        return -far if far is not None and self.opposite else far


@dataclass(frozen=True, slots=True)
class Compound:
    """Conditions joined: one of several (``or``), the contrary of one (``not``), or one that asks for another (``if``).

    ``and`` stands inside the others only: side by side, conditions all hold.
    """

    joint: Literal["and", "or", "not", "if"]
    parts: tuple[Condition, ...]
    quote: Quote | None = field(default=None, compare=False, repr=False)


Condition = Measure | Compound


@dataclass(frozen=True, slots=True)
class Way:
    """Partial facts of how somebody drives; the map answers with the routes that fit.

    `headings` (all of them, in order) and `lanes` stand alone: each is a whole way by itself.
    """

    origin: str | None = None
    heading: str | None = None
    turn: str | None = None
    destination: str | None = None
    destination_heading: str | None = None
    headings: tuple[str, ...] = ()
    lanes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Actor:
    """Somebody on the road; number 0 is under test, all others are orchestrated."""

    id: int
    name: str
    way: Way = Way()
    kind: str = "car"
    relations: tuple[Relation, ...] = ()
    quote: Quote | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Relation:
    """How somebody's way lies to another's: ahead, behind, oncoming, from the left, from the right."""

    kind: str
    of: int
    quote: Quote | None = field(default=None, compare=False, repr=False)


class Verb(StrEnum):
    """The deeds that the program language knows."""

    DRIVE = "drive on"
    SPEED_UP = "speed up"
    BRAKE = "brake"
    STAND = "stand still"


@dataclass(frozen=True, slots=True)
class Moment:
    """An instant that matters: the start, when somebody begins or ends a deed, or when something comes to be so.

    `time` counts from the start, where it is fixed.
    """

    conditions: tuple[Condition, ...] = ()
    time: Amount | None = None
    quote: Quote | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Deed:
    """What an orchestrated actor does from one moment (by its number) to another, and what holds all the while.

    `verb` is a word of `Verb`, or another that nothing compiles.
    """

    actor: int
    verb: str
    begins: int
    ends: int
    throughout: tuple[Measure, ...] = ()
    quote: Quote | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Order:
    """The time from the `first` moment to the `second` is ``op margin``; without a margin it is ``> 0`` or ``>= 0``."""

    first: int
    second: int
    op: Operator = ">"
    margin: Amount | None = None
    quote: Quote | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Point:
    """A moment, or some time after it, or before it (`earlier`)."""

    moment: int
    offset: Amount | None = None
    earlier: bool = False


@dataclass(frozen=True, slots=True)
class Hold:
    """A condition that holds always, never or at some time between two points."""

    how: How
    start: Point
    end: Point
    condition: Condition
    quote: Quote | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Question:
    """Something that is empty or has two readings.

    `slot` is its key in a file of answers. Where there is a default it was taken; without one nothing is compiled.
    """

    slot: str
    text: str
    alternatives: tuple[str, ...]
    default: int | None = 0
    quote: Quote | None = field(default=None, compare=False, repr=False)

    def with_default(self) -> str:
        """Return the question with what was taken, and what else it could be, as a sentence."""
        if self.default is None:
            return f"{self.text} It is open: {' / '.join(self.alternatives)}."
        others = [each for number, each in enumerate(self.alternatives) if number != self.default]
        could = f" It could also be: {'; '.join(others)}." if others else ""
        return f"{self.text} Taken: {self.alternatives[self.default]}.{could}"


@dataclass(frozen=True, slots=True)
class Story:
    """A whole scenario as it is told.

    `asides`, `assumptions` and `questions` are what was set aside, taken for granted and left open in reading; they are
    no part of the meaning.
    """

    actors: tuple[Actor, ...]
    moments: tuple[Moment, ...] = (Moment(),)  # by number; 0 is the start
    ego: tuple[int, ...] = ()  # the moments that the ego comes through one after the other, other than the start
    deeds: tuple[Deed, ...] = ()
    orders: tuple[Order, ...] = ()
    holds: tuple[Hold, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    manner: Manner = USUAL
    map_name: str = DEFAULT_MAP
    title: str | None = None
    asides: tuple[Quote, ...] = field(default=(), compare=False)
    assumptions: tuple[str, ...] = field(default=(), compare=False)
    questions: tuple[Question, ...] = field(default=(), compare=False)

    @property
    def heroes(self) -> tuple[Actor, ...]:
        """Everybody who is orchestrated."""
        return tuple(actor for actor in self.actors if actor.id != EGO)

    @property
    def told(self) -> list[Sequence[Condition]]:
        """What is so together, as far as it is told."""
        return told_in(self.moments, self.orders, (each.throughout for each in self.deeds), self.holds)

    def deeds_of(self, actor: int) -> tuple[Deed, ...]:
        """Return what somebody does, in the order of doing."""
        own = {deed.begins: deed for deed in self.deeds if deed.actor == actor}
        chain: list[Deed] = []
        at = START
        while (deed := own.pop(at, None)) is not None:
            chain.append(deed)
            at = deed.ends
        return tuple(chain)

    def knots_of(self, actor: int) -> tuple[int, ...]:
        """Return the moments that somebody comes through, in order, the start included."""
        if actor == EGO:
            return (START, *self.ego)
        return (START, *(deed.ends for deed in self.deeds_of(actor)))

    def owners(self, moment: int) -> tuple[int, ...]:
        """Return who comes through a moment, in order of number."""
        return tuple(actor.id for actor in self.actors if moment in self.knots_of(actor.id))


def within(thing: object, kind: type[T]) -> Iterator[T]:
    """Yield what of a kind there is in a part of a story, as it stands there: measures, amounts, quotes."""
    if isinstance(thing, kind):
        yield thing
        return
    inside = thing if isinstance(thing, tuple) else ()
    for each in (getattr(thing, own.name) for own in fields(thing)) if is_dataclass(thing) else inside:
        yield from within(each, kind)


def standstill(actor: int) -> Measure:
    """Return that somebody stands."""
    return Measure(actor, Quantity.SPEED, "==", Amount(Fraction(0), "m/s"))


def in_line(who: int, relation: Relation) -> Measure | None:
    """Return that somebody is ahead of another, or behind it, as a gap; None where the relation is another one."""
    if relation.kind not in ("ahead", "behind"):
        return None
    rear, front = (who, relation.of) if relation.kind == "behind" else (relation.of, who)
    return Measure(rear, Quantity.GAP, ">", Amount(Fraction(0), "m"), other=front, quote=relation.quote)


def not_beyond(measure: Measure) -> Measure | None:
    """Return what "at most 5 m before the stop line" says besides: that it is not past it; None of other measures."""
    if measure.place is None or measure.amount is None or measure.op not in ("<", "<="):
        return None
    return Measure(measure.actor, Quantity.PLACE, ">=" if measure.opposite else "<=", None, measure.place)


def is_event(each: Condition) -> TypeGuard[Measure]:
    """Whether a condition is that somebody comes to a place: nobody drives backwards, so it happens once."""
    return isinstance(each, Measure) and (each.quantity, each.op, each.amount) == (Quantity.PLACE, "==", None)


def people_in(condition: Condition) -> set[int]:
    """Return whom a condition speaks of."""
    places = {who for place in within(condition, Place) for who in (place.of, place.partner)}
    measured = {who for each in within(condition, Measure) for who in (each.actor, each.other)}
    return {who for who in places | measured if who is not None}


def told_in(
    moments: Sequence[Moment], orders: Iterable[Order], held: Iterable[Sequence[Condition]], holds: Iterable[Hold]
) -> list[Sequence[Condition]]:
    """Return what is told to be so together: at one moment, all the while, and where who passes a place is first."""
    found = [*(each.conditions for each in moments), *held, *([each.condition] for each in holds)]
    for order in (each for each in orders if each.op in ("==", ">", ">=")):
        first, second = (filter(is_event, moments[at].conditions) for at in (order.first, order.second))
        found.append([*first, *(replace(each, amount=Amount(Fraction(1), "m")) for each in second)])  # before it still
    return found


def rears(one: Actor, other: Actor, told: Iterable[Sequence[Condition]]) -> list[int]:
    """Return who of two is told to be behind: by how they lie to each other, then by each list of conditions.

    These say it by a distance or a time between both, or by how far each is from one place of a road that both are on.
    """
    pair, found, compared = {one.id, other.id}, list[int](), False
    for who, each in ((actor.id, each) for actor in (one, other) for each in actor.relations):
        compared |= each.kind == "same way" and each.of in pair
        found += [who if each.kind == "behind" else each.of] * (each.kind in ("ahead", "behind") and each.of in pair)
    roads = [each.heading or "".join(each.headings[:1]) or each.origin for each in (one.way, other.way)]
    known = [each for each in roads if each not in (None, "road")]  # who is beside another is on its road
    for conditions in told:
        measures = [each for each in conditions if isinstance(each, Measure)]
        found += [each.actor for each in measures if each.quantity in BETWEEN and {each.actor, each.other} == pair]
        compared |= bool(found)
        on_one = len({*known}) < 2 and (compared or len(known) == 2)
        places = [each for each in measures if on_one and each.actor in pair and each.left is not None]
        for first, then in combinations(places, 2):
            if first.place == then.place and first.actor != then.actor and first.left != then.left:
                found.append(max(first, then, key=lambda each: each.left or 0).actor)
    return found


def comes_through(story: Story, told: Iterable[int], keeps: Callable[[int], bool]) -> tuple[int, ...]:
    """Return which moments, as they were `told`, the ego comes through where nothing more is said of it.

    Those that ask something of it, and those that are nobody's and have no time. Of one that nobody else comes through
    after the ego's last it is open whether it comes after that: `keeps` says so.
    """
    ways = [story.knots_of(hero.id) for hero in story.heroes]
    found: list[int] = []
    for moment in told:
        here, own = story.moments[moment], [way for way in ways if moment in way]
        is_asked = any(EGO in people_in(each) for each in here.conditions) if own else here.time is None
        follows = not (own and found) or any(found[-1] in way[: way.index(moment)] for way in own)
        if moment != START and is_asked and (follows or keeps(moment)):
            found.append(moment)
    return tuple(found)


def arranged(story: Story) -> Story:
    """Return an equal story in the one order that is compared.

    Moments are numbered along the deeds of each hero, then along the ego's way, then as they stand; deeds stand by
    actor, conditions and orders by their text.
    """
    seen = [START]
    for actor in (*(hero.id for hero in story.heroes), EGO):
        seen += [moment for moment in story.knots_of(actor) if moment not in seen]
    seen += [number for number in range(len(story.moments)) if number not in seen]
    new = {old: number for number, old in enumerate(seen)}
    moments = [story.moments[old] for old in seen]
    orders = [replace(order, first=new[order.first], second=new[order.second]) for order in story.orders]
    for order in tuple(orders):  # "It begins 5 s after the start" gives the moment its time
        if order.first == START and order.op == "==" and moments[order.second].time is None:
            moments[order.second] = replace(moments[order.second], time=order.margin)
            orders.remove(order)

    def point(each: Point) -> Point:
        return replace(each, moment=new[each.moment])

    def in_order(parts: Iterable[T]) -> tuple[T, ...]:
        return tuple(sorted(parts, key=repr))

    deeds = (
        replace(deed, begins=new[deed.begins], ends=new[deed.ends], throughout=in_order(deed.throughout))
        for deed in story.deeds
    )
    return replace(
        story,
        moments=tuple(replace(each, conditions=in_order(each.conditions)) for each in moments),
        ego=tuple(new[old] for old in story.ego),
        deeds=tuple(sorted(deeds, key=lambda deed: (deed.actor, deed.begins))),
        orders=in_order(orders),
        holds=in_order(replace(hold, start=point(hold.start), end=point(hold.end)) for hold in story.holds),
        parameters=tuple(sorted(story.parameters, key=lambda each: each.name)),
    )
