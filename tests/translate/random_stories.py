"""Random stories over all constructs, any number of actors, units and parameters: what round trips are tried on."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from scenewright.errors import TranslationError
from scenewright.program.magnitudes import LONGEST_S
from scenewright.program.manner import USUAL, manner_of
from scenewright.program.types import DEFAULT_MAP, EGO, Parameter
from scenewright.translate.phrases import PLACES
from scenewright.translate.story import (
    START,
    Actor,
    Amount,
    Compound,
    Condition,
    Deed,
    Hold,
    Measure,
    Moment,
    Operator,
    Order,
    Place,
    Point,
    Quantity,
    Story,
    Verb,
    Way,
    arranged,
)  # fmt: skip
from scenewright.translate.tell import tell
from scenewright.units import SI_SYMBOL, UNITS, Dimension, unit_of_name

OPERATORS: tuple[Operator, ...] = ("==", "==", "==", "<=", ">=", "<", ">")
PARAMETERS: dict[Dimension, tuple[str, ...]] = {
    "length": ("gap_m", "distance_to_line_m", "way_ft"), "time": ("tta_s", "delay_s"),
    "speed": ("first_speed_mps", "limit_kmph"), "acceleration": ("rate_mpss",),
}  # fmt: skip
NAMES = ("hero", "truck", "van", "bus", "taxi", "blue_car", "other", "hero2", "the", "A1")
OF: dict[Quantity, Dimension] = {
    Quantity.PLACE: "length", Quantity.GAP: "length", Quantity.FREE_SPACE: "length", Quantity.SPEED: "speed",
    Quantity.RATE: "acceleration",
    Quantity.ARRIVAL: "time", Quantity.HEADWAY: "time", Quantity.COLLISION: "time",
}  # fmt: skip


class Teller:
    """Makes one random story; `si` keeps amounts in SI units, as programs have them."""

    def __init__(self, seed: int, si: bool) -> None:
        self.random = random.Random(seed)
        self.si = si
        self.actors: list[int] = []

    def story(self) -> Story:
        pick = self.random
        names = ["ego", *pick.sample(NAMES, pick.choice((1, 1, 1, 2, 3, 5)))]
        self.actors = list(range(len(names)))
        kinds = {name: name for name in ("truck", "van", "bus", "taxi")}
        actors = tuple(Actor(each, name, self.way(), kinds.get(name, "car")) for each, name in enumerate(names))
        count = pick.randint(1, 2) + sum(pick.random() < 0.5 for _ in names) + pick.randint(0, 2)
        chains = {actor: sorted(pick.sample(range(1, count + 1), pick.randint(1, count))) for actor in self.actors[1:]}
        ego = sorted(pick.sample(range(1, count + 1), pick.randint(0, count)))
        deeds = [
            Deed(actor, verb := pick.choice(tuple(Verb)), begins, ends, self.throughout(actor, verb))
            for actor, chain in chains.items()
            for begins, ends in zip((START, *chain), chain, strict=False)
        ]
        owned = {moment for chain in chains.values() for moment in chain}
        moments = [Moment(self.conditions(pick.randint(0, 2)))]
        for number in range(1, count + 1):
            timed = number not in owned and number not in ego
            time = self.amount("time", parameter=not timed) if timed or pick.random() < 0.1 else None
            nobody = number not in owned
            moments.append(Moment(self.conditions(pick.choice((int(nobody), 1, 1, 2, 3)), simple=nobody), time))
        # A program knows a moment that is nobody's by its time alone.
        named = [number for number in range(count + 1) if not self.si or number in (START, *owned, *ego)]
        orders, holds = self.orders(named), tuple(self.hold(named) for _ in range(pick.choice((0, 0, 0, 1, 2))))
        manner = manner_of([("stands_s", Fraction(2), None)]) if pick.random() < 0.1 else USUAL
        title = pick.choice((None, None, "left turn, yields", "a 'title'; with marks."))
        map_name = pick.choice((DEFAULT_MAP, DEFAULT_MAP, "maps/town 7.xodr"))
        parts = (actors, tuple(moments), tuple(ego), tuple(deeds), orders, holds, self.parameters())
        return arranged(Story(*parts, manner, map_name, title))

    def way(self) -> Way:
        pick = self.random
        style = pick.random()
        if style < 0.1:
            return Way(lanes=("1.0.-1", "14.0.-1", "a_2.-3")[: pick.randint(1, 3)])
        if style < 0.2:
            return Way(headings=tuple(pick.choice("NESW") for _ in range(3)))
        if style < 0.6:
            return Way(heading=pick.choice("NESW"), turn=pick.choice(("left", "right", "straight")))
        heading = pick.choice((None, *"NESW"))
        turn = pick.choice((None, "left", "right", "straight"))
        origin, destination = pick.choice((None, "road", "driveway")), pick.choice((None, "road", "driveway"))
        return Way(origin, heading, turn, destination, pick.choice((None, *"NESW")))

    def amount(self, dimension: Dimension, parameter: bool = True, zero: bool = False) -> Amount:
        pick = self.random
        if parameter and pick.random() < 0.25:
            name = pick.choice(PARAMETERS[dimension])
            unit = unit_of_name(name)
            assert unit is not None
            return Amount(None, unit.symbol, name)
        symbols = [SI_SYMBOL[dimension]] if self.si else [each for each in UNITS if UNITS[each].dimension == dimension]
        divisor = pick.choice((1, 1, 2, 10) if self.si else (1, 1, 2, 10, 3))
        value = Fraction(pick.randint(0 if zero else 1, 400), divisor)
        symbol = pick.choice(symbols)
        while dimension == "time" and value * UNITS[symbol].si_factor > LONGEST_S:
            value /= 10
        return Amount(value, symbol)

    def measure(self, actor: int | None = None, alone: bool = False) -> Measure:
        pick = self.random
        who = pick.choice(self.actors) if actor is None else actor
        quantity = pick.choice((Quantity.PLACE, Quantity.SPEED, Quantity.RATE) if alone else tuple(Quantity))
        op = pick.choice(OPERATORS)
        amount = self.amount(OF[quantity], zero=quantity is Quantity.SPEED)
        others = [each for each in self.actors if each != who]
        match quantity:
            case Quantity.PLACE | Quantity.ARRIVAL:
                place = Place(pick.choice(tuple(PLACES)))
                if pick.random() < 0.2 and len(others) > 1 and place.name in ("conflict_point", "intersection", "turn"):
                    usual = 1 if who == EGO else EGO
                    place = Place(place.name, None, pick.choice([each for each in others if each != usual]))
                elif pick.random() < 0.2:
                    place = Place(place.name, pick.choice(others))
                if quantity is Quantity.ARRIVAL:
                    return Measure(who, quantity, op, amount, place)
                if pick.random() < 0.4:
                    return Measure(who, quantity, op, None, place)
                return Measure(who, quantity, op, amount, place, opposite=pick.random() < 0.3)
            case Quantity.SPEED if not alone and pick.random() < 0.3:
                slower = pick.choice((None, False, True))
                if slower is None or amount.value == 0:
                    return Measure(who, quantity, op, None, other=pick.choice(others))
                return Measure(who, quantity, op, amount, other=pick.choice(others), opposite=slower)
            case Quantity.RATE:
                return Measure(who, quantity, op, amount, opposite=pick.random() < 0.5)
            case Quantity.SPEED:
                return Measure(who, quantity, op, amount)
        return Measure(who, quantity, op, amount, other=pick.choice(others))

    def throughout(self, actor: int, verb: Verb) -> tuple[Measure, ...]:
        found = [self.measure(actor, alone=True) for _ in range(self.random.choice((0, 0, 0, 1, 2)))]
        if verb in (Verb.BRAKE, Verb.SPEED_UP):  # whose rates have their sign
            found = [replace(m, opposite=verb is Verb.BRAKE) if m.quantity is Quantity.RATE else m for m in found]
        standing = [each for each in found if each.op == "==" and each.amount is not None and each.amount.value == 0]
        return tuple(dict.fromkeys(each for each in found if each not in standing))  # a deed of its own says that

    def conditions(self, count: int, simple: bool = False) -> tuple[Condition, ...]:
        found: list[Condition] = [self.measure() for _ in range(count)]
        if count and not simple and self.random.random() < 0.1:
            found.append(self.compound())
        return tuple(dict.fromkeys(found))

    def compound(self) -> Compound:
        pick = self.random
        first, second, third = (self.measure() for _ in range(3))
        return pick.choice(
            (
                Compound("or", (first, second)),
                Compound("or", (first, second, third)),
                Compound("or", (first, Compound("and", (second, third)))),
                Compound("or", (Compound("not", (first,)), second)),
                Compound("not", (first,)),
                Compound("not", (Compound("or", (first, second)),)),
                Compound("if", (first, second)),
                Compound("if", (Compound("and", (first, third)), Compound("or", (second, third)))),
            )
        )

    def orders(self, named: list[int]) -> tuple[Order, ...]:
        pick, found = self.random, []
        for _ in range(pick.choice((0, 0, 1, 2))):
            first, second = pick.sample(named, 2) if len(named) > 1 else (START, START)
            if first == second or second == START:
                continue
            if pick.random() < 0.5 or first == START:
                found.append(Order(first, second, pick.choice(OPERATORS), self.amount("time")))
            else:
                found.append(Order(first, second, pick.choice((">", ">="))))
        return tuple(dict.fromkeys(found))

    def hold(self, named: list[int]) -> Hold:
        pick = self.random
        start, end = self.point(named), self.point(named)
        condition = pick.choice((self.measure(), self.measure(), self.compound(),
                                 Compound("and", (self.measure(), self.measure()))))  # fmt: skip
        return Hold(pick.choice(("always", "never", "at some time")), start, end, condition)

    def point(self, named: list[int]) -> Point:
        moment = self.random.choice(named)
        if self.random.random() < 0.6:
            return Point(moment)
        return Point(moment, self.amount("time"), moment != START and self.random.random() < 0.5)

    def parameters(self) -> tuple[Parameter, ...]:
        if self.random.random() < 0.7:
            return ()
        pick = self.random
        value = pick.choice((None, Fraction(5, 2)))
        return (pick.choice((Parameter("gap_m", Fraction(20)), Parameter("rate_mpss", value, Fraction(1), Fraction(4)),
                             Parameter("unused_mps"))),)  # fmt: skip


def random_story(seed: int, si: bool = False) -> Story:
    """Return the story of a seed."""
    return Teller(seed, si).story()


def told_stories(count: int) -> Iterator[tuple[Story, list[str]]]:
    """Yield the stories of the first seeds that there are words for, with what is told of them."""
    for seed in range(count):
        story = random_story(seed)
        with suppress(TranslationError):
            yield story, tell(story)
