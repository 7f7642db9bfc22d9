"""Lowers a program's constraints to formulas over the states of actors at moments: every form that can be written.

What enters: `Events` and the constraints. What leaves: for each a formula that every motion satisfies which the judge
would accept, and narrower laws. What is of too high a degree is named; a proof may leave it out, a plan may not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import product

from scenewright.algebra.polynomials import (
    FALSE,
    ONE,
    TRUE,
    ZERO,
    Formula,
    Named,
    Polynomial,
    TooHigh,
    compare,
    every,
    polynomial,
    some,
)
from scenewright.motion.laws import ANY, Law
from scenewright.program import expressions as ex
from scenewright.program.types import EGO, Constraint
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.solve.proofs.events import Events, Narrowing
from scenewright.solve.proofs.forms import TIGHT, actors_at, asserted, compared_dimension, free_actors
from scenewright.solve.proofs.order import least_value
from scenewright.units import pin

MEAN_RATE = "the rate of a piece is by how much the speed changes in it, over how long it lasts"
_RATE_ROOM_MPSS = Fraction(1, 1000)  # for numbers that were rounded; half of what a witness may be off
RATE_LASTS_S = Fraction(1, 20)  # a rate at a moment is that of so much motion from there on


@dataclass(frozen=True, slots=True)
class Case:
    """A value as a quotient, where `given` holds: longer than any time where it has none."""

    top: Polynomial
    below: Polynomial
    given: Formula = TRUE


@dataclass(slots=True)
class Lowering:
    """Lowers the constraints of one scene over its events.

    `slack` is how many tight tolerances an equality may be off: against one drive all counts that a judge lets pass.
    """

    events: Events
    slack: Fraction = ZERO
    narrowings: list[Narrowing] = field(default_factory=list)
    rates: dict[tuple[int, int], Polynomial] = field(default_factory=dict)  # of what begins, by actor and instant
    means: dict[tuple[int, int, int], Polynomial] = field(default_factory=dict)  # of pieces, by actor and ends
    happens: dict[tuple[int, int, ex.Formula], int] = field(default_factory=dict)  # moments, by ends and what is then

    def lower(self, constraints: tuple[Constraint, ...]) -> list[Named]:
        """Return every constraint as a formula. All moments are made first: an `always` is about all that there are.

        May be asked again when there are more moments.
        """
        self.narrowings.clear()
        formulas = [asserted(constraint.formula, self.events.scene.program) for constraint in constraints]
        for constraint, formula in zip(constraints, formulas, strict=True):
            with suppress(TooHigh):  # told below
                self._make_moments(formula)
                self.narrowings += (replace(each, origin=constraint.id) for each in self.narrowings_of(formula))
        found = list[Named]()
        for constraint, formula in zip(constraints, formulas, strict=True):
            try:
                found.append(Named(self.formula(formula, None), constraint.id))
            except TooHigh as why:
                found.append(Named(TRUE, constraint.id, refused=str(why)))
        return found

    # -- moments ------------------------------------------------------------------------------------------------------
    def _make_moments(self, formula: ex.Formula) -> None:
        """Give every actor a state at each moment that `formula` speaks of."""
        for node in ex.walk(formula):
            if isinstance(node, ex.State | ex.Derived) and node.at is not None and not isinstance(node.at, ex.PieceRef):
                for actor in actors_at(node):
                    self.events.state(actor, self._instant(node.at, node.actor))
            if isinstance(node, ex.Temporal):
                for instant in self.stretch_of(node):
                    for actor in free_actors(node.body):
                        self.events.state(actor, instant)

    def stretch_of(self, formula: ex.Temporal) -> tuple[int, int]:
        """Return the instants at which a stretch of time begins and ends."""
        return self._instant(formula.start), self._instant(formula.end)

    def ends_early(self, formula: ex.Temporal) -> Polynomial | None:
        """Return when a stretch of time ends that may end before the start: there is nothing of it then."""
        ends = self._time(formula.end)
        return None if least_value(ends, self.events.unknowns) >= 0 else ends

    def _time(self, term: ex.Term) -> Polynomial:
        case, *_ = self.term(term, None)
        if not case.below.constant:
            raise TooHigh("it is of a stretch of time that begins or ends at a quotient of unknowns")
        return case.top * (1 / case.below.constant)

    def _instant(self, at: ex.At | ex.Term, owner: int = EGO) -> int:
        """Return the instant that a knot of its owner, or a term for a time, stands for."""
        match at:
            case ex.Knot(name=name):
                return self.events.knot(owner, name)
            case None | ex.PieceRef():
                raise TypeError(f"not a moment: {at!r}")
        return self.events.moment(self._time(at))

    # -- formulas -----------------------------------------------------------------------------------------------------
    def formula(self, formula: ex.Formula, now: int | None) -> Formula:
        """Return `formula` over the states of moments; `now` is the instant at which a body is looked at."""
        match formula:
            case ex.Compare(left=left, right=right):
                pairs = product(self.term(left, now), self.term(right, now))
                return some([every([a.given, b.given, self._related(formula, a, b)]) for a, b in pairs])
            case ex.Logic(operator="and", operands=operands):
                return every([self.formula(operand, now) for operand in operands])
            case ex.Logic(operator="or", operands=operands):
                return some([self.formula(operand, now) for operand in operands])
            case ex.Temporal(operator=("always" | "eventually") as operator, body=body):
                ends, early = self.stretch_of(formula), self.ends_early(formula) or ZERO
                if operator == "always":
                    return some([compare("<", early, ZERO), self._always(*ends, body)])
                return every([compare(">=", early, ZERO), self._eventually(*ends, body)])
            case _:
                raise TypeError(f"not an asserted formula: {formula!r}")

    def _related(self, formula: ex.Compare, left: Case, right: Case) -> Formula:
        if formula.operator != "==" or not self.slack:
            return _related(formula.operator, left, right)
        room = TIGHT[compared_dimension(formula)] * self.slack * right.below
        most, least = replace(right, top=right.top + room), replace(right, top=right.top - room)
        return every([_related("<=", left, most), _related(">=", left, least)])

    def term(self, term: ex.Term, now: int | None) -> list[Case]:
        """Return a term as quotients; more than one where it depends on who is ahead."""
        events = self.events
        match term:
            case ex.Number(value=value):
                return [_case(value)]
            case ex.ParameterRef(name=name):
                return [_case(events.parameters[name])]
            case ex.Landmark():
                return [_case(self._landmark(term))]
            case ex.Elapsed(actor=actor, knot=knot):
                return [_case(events.times[events.knot(actor, knot)])]
            case ex.State(actor=actor, order=2, at=ex.PieceRef(name=piece)):
                return [_case(self._piece_rate(actor, piece))]
            case ex.State(actor=actor, order=order, at=at):
                instant = now if at is None else self._instant(at, actor)
                assert instant is not None
                if order == 2:
                    return [_case(self._rate_at(actor, instant))]
                state = events.state(actor, instant)
                return [_case(state.place + self._shift(term) if order == 0 else state.speed)]
            case ex.Derived():
                return self._derived(term, now)
            case ex.Negate(operand=operand):
                return [replace(case, top=-case.top) for case in self.term(operand, now)]
            case ex.Arithmetic():
                pairs = product(self.term(term.left, now), self.term(term.right, now))
                cases = [self._arithmetic(term, *pair) for pair in pairs]
                if term.operator != "/" or (isinstance(term.right, ex.State) and term.right.order == 1):
                    return cases
                return list(_either_sign(cases))
            case _:
                raise TypeError(f"not a term: {term!r}")

    def _arithmetic(self, term: ex.Arithmetic, left: Case, right: Case) -> Case:
        given = every([left.given, right.given])
        if term.operator in ("+", "-"):
            other = right.top if term.operator == "+" else -right.top
            if left.below.terms == right.below.terms:
                top, below = left.top + other, left.below
            else:
                top, below = left.top * right.below + other * left.below, left.below * right.below
            return Case(top, below, given)
        if term.operator == "*":
            return Case(left.top * right.top, left.below * right.below, given)
        return Case(left.top * right.below, left.below * right.top, given)

    def _derived(self, term: ex.Derived, now: int | None) -> list[Case]:
        """Return a distance of two, or a quotient of one and a speed; all but a gap are between bodies."""
        events, scene = self.events, self.events.scene
        instant = now if term.at is None else self._instant(term.at, term.actor)
        assert instant is not None
        mine = events.state(term.actor, instant)
        if isinstance(term.target, ex.Landmark):
            return [Case(self._landmark(term.target) - mine.place, mine.speed)]
        other = events.state(term.target, instant)
        gap = other.place + pin(scene.offset_m(term.actor, term.target)) - mine.place
        if term.kind == "gap":
            return [_case(gap)]
        body = pin(VEHICLE_LENGTH_M)
        if term.kind == "freespace":
            return [_case(gap - body)]
        if term.kind == "headway":
            return [Case(gap - body, mine.speed)]
        closing = mine.speed - other.speed
        return [
            Case(gap - body, closing, compare(">=", gap, ZERO)),
            Case(-gap - body, -closing, compare("<", gap, ZERO)),
        ]

    def _landmark(self, mark: ex.Landmark) -> Polynomial:
        if mark.actor is None:
            raise ValueError(f"landmark {mark.name} belongs to no one")
        return polynomial(pin(self.events.scene.landmark_m(mark.actor, mark.name, mark.other)) + self._shift(mark))

    def _shift(self, place: ex.State | ex.Landmark) -> Fraction:
        """Return what brings a place to the route that it is meant along (m)."""
        if place.frame is None or place.actor is None:
            return ZERO
        return pin(self.events.scene.offset_m(place.frame, place.actor))

    # -- rates --------------------------------------------------------------------------------------------------------
    def _piece_rate(self, actor: int, piece: str) -> Polynomial:
        """Return the mean rate of a piece: whatever it does, its speeds at both ends say so much."""
        first, last = self.piece_ends(actor, piece)
        key = (actor, first, last)
        if key not in self.means:
            law = self.events.law_of(actor)
            rate = self.means[key] = self.events.new(f"r{actor}_{piece}", law.rate_low, law.rate_high, "rate")
            lasts = self.events.times[last] - self.events.times[first]
            change = self.events.state(actor, last).speed - self.events.state(actor, first).speed
            self.events.rules.append(Named(compare("==", rate * lasts, change), MEAN_RATE))
        return self.means[key]

    def _rate_at(self, actor: int, instant: int) -> Polynomial:
        """Return the rate of what begins at an instant; a plan owes it for a moment, a proof takes it from the law."""
        key = (actor, instant)
        if key not in self.rates:
            law = self.events.law_of(actor)
            self.rates[key] = self.events.new(f"a{actor}_{instant}", law.rate_low, law.rate_high, "rate")
        return self.rates[key]

    def piece_ends(self, actor: int, piece: str) -> tuple[int, int]:
        """Return the instants at which a piece begins and ends."""
        begins, ends = self.events.scene.program.actor(actor).sketch.piece_ends(piece)
        return self.events.knot(actor, begins), self.events.knot(actor, ends)

    # -- narrower laws ------------------------------------------------------------------------------------------------
    def narrowings_of(self, formula: ex.Formula) -> Iterator[Narrowing]:
        """Yield the laws that bounds on a speed or a rate over a stretch of time make narrower.

        What is past a place or else bounded, is bounded up to there. Other forms are held at moments alone.
        """
        match formula:
            case ex.Logic(operator="and", operands=operands):
                for operand in operands:
                    yield from self.narrowings_of(operand)
            case ex.Temporal(operator="always", body=ex.Logic(operator="and", operands=operands)):
                for operand in operands:
                    yield from self.narrowings_of(replace(formula, body=operand))
            case ex.Temporal(operator="always", body=body):
                past, then = body.operands if isinstance(body, ex.Logic) and len(body.operands) == 2 else (None, body)
                early, law, place = self.ends_early(formula), self._law_of(then), self._place_of(past) if past else None
                if law is None or (early is not None and early.constant is not None):  # it was over before the start
                    return
                (actor, bound), ends = law, self.stretch_of(formula)
                proven = bound if early is None else None
                if past is None:
                    yield Narrowing(actor, *ends, bound, proven, said=body)
                elif place and place[0] == actor:
                    made = self.events.at_place(*place[:2])
                    yield Narrowing(actor, *ends, bound, proven, made, *place[1:])
            case ex.Compare() if (node := ex.piece_of(formula)) is not None and isinstance(node.at, ex.PieceRef):
                ends = self.piece_ends(node.actor, node.at.name)
                if formula.operator == "==":  # a rate that is one number is one all through
                    yield Narrowing(node.actor, *ends, ANY, even=True)
                if law := self._law_of(ex.at_each_moment(formula, node)):
                    yield Narrowing(law[0], *ends, law[1])

    def _law_of(self, body: ex.Formula) -> tuple[int, Law] | None:
        """Return whose law a body bounds and how, where it compares a speed or a rate with a number."""
        match body:
            case ex.Compare(operator, ex.State(order=(1 | 2) as order, at=None, actor=actor), right):
                pass
            case ex.Compare(operator, right, ex.State(order=(1 | 2) as order, at=None, actor=actor)):
                operator = ex.FLIPPED[operator]
            case _:
                return None
        if (bound := self._constant(right)) is None:
            return None
        room, name = (_RATE_ROOM_MPSS, "rate") if order == 2 else (ZERO, "speed")
        bounds = {} if operator in ("<", "<=") else {f"{name}_low": bound - room}
        bounds |= {} if operator in (">", ">=") else {f"{name}_high": bound + room}
        return actor, replace(ANY, **bounds)

    def _place_of(self, formula: ex.Formula) -> tuple[int, Fraction, bool] | None:
        """Return actor and place (m) of "is past a place" (True) or "is before it"; None for anything else."""
        match formula:
            case ex.Compare("<=" | "<" | ">=" | ">", ex.State(order=0, at=None, actor=actor), place):
                found = self._constant(place)
                return None if found is None else (actor, found, formula.operator in (">", ">="))
        return None

    def _constant(self, term: ex.Term) -> Fraction | None:
        """Return the value of a term in which nobody moves; None for one in which somebody does, or that has none."""
        if any(isinstance(node, ex.State | ex.Derived | ex.Elapsed) for node in ex.walk(term)):
            return None
        case, *_ = self.term(term, None)
        top, below = case.top.constant, case.below.constant
        return top / below if top is not None and below else None

    # -- stretches of time --------------------------------------------------------------------------------------------
    def _always(self, first: int, last: int, body: ex.Formula) -> Formula:
        """Return what `always` says at every moment that all in its body have a state at, unless a law says it all."""
        if isinstance(body, ex.Logic) and body.operator == "and":
            return every([self._always(first, last, part) for part in body.operands])
        rates = any(isinstance(node, ex.State) and node.order == 2 and node.at is None for node in ex.walk(body))
        if rates and any((each.first, each.last, each.said) == (first, last, body) for each in self.narrowings):
            return TRUE
        times, actors = self.events.times, free_actors(body)
        if not actors:  # about moments of their own: it does not matter when it is looked at
            return some([compare(">", times[first], times[last]), self.formula(body, first)])
        parts = []
        for instant in sorted(set.intersection(*(set(self.events.instants_of(actor)) for actor in actors))):
            if rates and instant == last:  # the rate of what begins there comes after it
                continue
            outside = [compare(">", times[first], times[last])]
            if instant not in (first, last):
                after = compare(">=" if rates else ">", times[instant], times[last])
                outside = [compare("<", times[instant], times[first]), after]
            parts.append(some([*outside, self.formula(body, instant)]))
        return every(parts)

    def _eventually(self, first: int, last: int, body: ex.Formula) -> Formula:
        """Return that at some moment, which is to be found, the body holds."""
        events, key = self.events, (first, last, body)
        if key not in self.happens:
            self.happens[key] = events.instant("eventually")
        made = self.happens[key]
        for actor in free_actors(body):
            events.state(actor, made)
        times = events.times
        within = [compare("<=", times[first], times[made]), compare("<=", times[made], times[last])]
        return every([*within, self.formula(body, made)])


def _case(value: Polynomial | Fraction) -> Case:
    return Case(polynomial(value), polynomial(ONE))


def _either_sign(quotients: Iterable[Case]) -> Iterator[Case]:
    """Yield quotients as they are, and the other way round: a divisor may be less than nothing, or nothing."""
    for case in quotients:
        for top, below in ((case.top, case.below), (-case.top, -case.below)):
            given = every([case.given, compare(">=", below, ZERO)])
            if given != FALSE:
                yield Case(top, below, given)


def _related(operator: str, left: Case, right: Case) -> Formula:
    """Return a comparison of two quotients. One that stands is endlessly far off in time."""
    conditions = [compare(">", case.below, ZERO) for case in (left, right)]
    held = every([*conditions, compare(operator, left.top * right.below, right.top * left.below)])
    if operator == "==":
        return held
    return some([compare("<=", (left if operator in (">", ">=") else right).below, ZERO), held])
