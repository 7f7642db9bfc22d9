"""Lowers a program's constraints to formulas over the states of actors at moments: every form that can be written.

What enters: `Events` and the constraints. What leaves: for each constraint a formula that every motion satisfies which
the judge would accept (what a proof may rest on), and what a plan owes besides: rates that last, narrower laws. What is
of too high a degree is named; a proof may leave it out, a plan may not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import product

from scenewright.algebra.polynomials import (
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
from scenewright.program import expressions as ex
from scenewright.program.types import EGO, Constraint
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.forms import TIGHT, actors_at, asserted, compared_dimension, free_actors
from scenewright.solve.proofs.narrowing import Narrowing, narrowings_of
from scenewright.solve.proofs.order import least_value
from scenewright.units import pin

MEAN_RATE = "the rate of a piece is by how much the speed changes in it, over how long it lasts"
RATE_LASTS_S = Fraction(1, 20)  # a rate at a moment is that of so much motion from there on


@dataclass(frozen=True, slots=True)
class Case:
    """A value as a quotient, where `given` holds. `endless` where it is longer than any time if it has no value."""

    top: Polynomial
    below: Polynomial
    given: Formula = TRUE
    endless: bool = False


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
                self.narrowings += (replace(each, origin=constraint.id) for each in narrowings_of(self, formula))
        return [self._lowered(*each) for each in zip(constraints, formulas, strict=True)]

    def _lowered(self, constraint: Constraint, formula: ex.Formula) -> Named:
        try:
            return Named(self.formula(formula, None), constraint.id)
        except TooHigh as why:
            return Named(TRUE, constraint.id, refused=str(why))

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
        top, below = self.plain(term)
        if not below.constant:
            raise TooHigh("it is of a stretch of time that begins or ends at a quotient of unknowns")
        return top if below.constant == 1 else top * (1 / below.constant)

    def plain(self, term: ex.Term) -> tuple[Polynomial, Polynomial]:
        """Return a term in which nobody's order matters as numerator and denominator."""
        cases = self.term(term, None)
        return cases[0].top, cases[0].below

    def _instant(self, at: ex.At | ex.Term, owner: int = EGO) -> int:
        """Return the instant that a knot of its owner, or a term for a time, stands for."""
        match at:
            case ex.Knot(name=name):
                return self.events.knot(owner, name)
            case ex.Elapsed(actor=actor, knot=knot):
                return self.events.knot(actor, knot)
            case None | ex.PieceRef():
                raise TypeError(f"not a moment: {at!r}")
        return self.events.moment(self._time(at), "told")

    # -- formulas -----------------------------------------------------------------------------------------------------
    def formula(self, formula: ex.Formula, now: int | None) -> Formula:
        """Return `formula` over the states of moments; `now` is the instant at which a body is looked at."""
        match formula:
            case ex.Compare():
                return self._compare(formula, now)
            case ex.Logic(operator="and", operands=operands):
                return every([self.formula(operand, now) for operand in operands])
            case ex.Logic(operator="or", operands=operands):
                return some([self.formula(operand, now) for operand in operands])
            case ex.Temporal(operator="always", body=body):
                held, early = self._always(*self.stretch_of(formula), body), self.ends_early(formula)
                return held if early is None else some([compare("<", early, ZERO), held])
            case ex.Temporal(operator="eventually", body=body):
                happens, early = self._eventually(*self.stretch_of(formula), body), self.ends_early(formula)
                return happens if early is None else every([compare(">=", early, ZERO), happens])
            case _:
                raise TypeError(f"not an asserted formula: {formula!r}")

    def _compare(self, formula: ex.Compare, now: int | None) -> Formula:
        pairs = product(self.term(formula.left, now), self.term(formula.right, now))
        return some([every([a.given, b.given, self._related(formula, a, b)]) for a, b in pairs])

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
                if term.operator != "/":
                    return cases
                if isinstance(term.right, ex.State) and term.right.order == 1:
                    return [replace(case, endless=True) for case in cases]
                return list(_either_sign(cases))
            case _:
                raise TypeError(f"not a term: {term!r}")

    def _arithmetic(self, term: ex.Arithmetic, left: Case, right: Case) -> Case:
        given, endless = every([left.given, right.given]), left.endless or right.endless
        if term.operator in ("+", "-"):
            other = right.top if term.operator == "+" else -right.top
            if left.below.terms == right.below.terms:
                top, below = left.top + other, left.below
            else:
                top, below = left.top * right.below + other * left.below, left.below * right.below
            return Case(top, below, given, endless)
        if term.operator == "*":
            return Case(left.top * right.top, left.below * right.below, given, endless)
        top, below = left.top * right.below, left.below * right.top
        size = below.constant
        if size is not None and size < 0:
            top, below = -top, -below
        return Case(top, below, given, endless)

    def _derived(self, term: ex.Derived, now: int | None) -> list[Case]:
        """Return a distance of two, or a quotient of one and a speed; all but a gap are between bodies."""
        events, scene = self.events, self.events.scene
        instant = now if term.at is None else self._instant(term.at, term.actor)
        assert instant is not None
        mine = events.state(term.actor, instant)
        if isinstance(term.target, ex.Landmark):
            return [Case(self._landmark(term.target) - mine.place, mine.speed, endless=True)]
        other = events.state(term.target, instant)
        gap = other.place + pin(scene.offset_m(term.actor, term.target)) - mine.place
        if term.kind == "gap":
            return [_case(gap)]
        body = pin(VEHICLE_LENGTH_M)
        if term.kind == "freespace":
            return [_case(gap - body)]
        if term.kind == "headway":
            return [Case(gap - body, mine.speed, endless=True)]
        closing = mine.speed - other.speed
        return [
            Case(gap - body, closing, compare(">=", gap, ZERO), endless=True),
            Case(-gap - body, -closing, compare("<", gap, ZERO), endless=True),
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
        if case.below.constant is not None:
            yield case
            continue
        for top, below in ((case.top, case.below), (-case.top, -case.below)):
            yield Case(top, below, every([case.given, compare(">=", below, ZERO)]), endless=True)


def _related(operator: str, left: Case, right: Case) -> Formula:
    """Return a comparison of two quotients. One that stands is endlessly far off in time."""
    conditions = [compare(">", case.below, ZERO) for case in (left, right) if case.below.constant != 1]
    held = every([*conditions, compare(operator, left.top * right.below, right.top * left.below)])
    if operator in (">", ">=") and left.endless:
        return some([compare("<=", left.below, ZERO), held])
    if operator in ("<", "<=") and right.endless:
        return some([compare("<=", right.below, ZERO), held])
    return held
