"""The paper's motion as a question for an SMT solver: everybody has one rate of acceleration in each piece.

What enters: a scene, bounds, and at a tick what has happened so far. What leaves: unknowns and formulas, and from their
values the motions of everybody. What the program asks is lowered by the code that proofs and witnesses rest on. It asks
no solver.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from scenewright.algebra.polynomials import (
    FALSE,
    TRUE,
    ZERO,
    All,
    Atom,
    Formula,
    Named,
    Polynomial,
    Unknown,
    atom,
    atoms,
    compare,
    every,
    polynomial,
    some,
)
from scenewright.motion.limits import MOVING_MPS, ROOM, Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.plan.situation import States
from scenewright.program import expressions as ex
from scenewright.program.types import EGO, Actor, Constraint, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.roads.turns import TurnSpan
from scenewright.solve.proofs.events import EgoBounds, Events, State
from scenewright.solve.proofs.forms import compared_dimension
from scenewright.solve.proofs.lowering import Lowering
from scenewright.units import pin

# What happened is told in 0.1 mm: an equality of that and of what comes may be off by so many tight tolerances.
ROUNDED = Fraction(1, 100)
_HAPPENED = 1e-2  # what comparisons of nothing but what happened may be off by (SI)
_OF_TURN = 0.98  # of the speed that a turn allows: how tight it is was looked at every 0.5 m only
_PULLS = {PieceKind.DEC, PieceKind.ACC}


@dataclass(frozen=True, slots=True)
class Past:
    """What has happened by a time (s): when moments were, and everybody's states by time."""

    time_s: float
    moments_s: Mapping[int, float]
    states: Mapping[int, States]


@dataclass(frozen=True, slots=True)
class _Leg:
    """A piece of an actor's way: between which moments, at which rate, and from which moment on it is even."""

    actor: int
    piece: int
    kind: PieceKind
    first: int
    last: int
    rate: Polynomial
    even_from: int | None = None

    def parts(self, begins: int) -> list[tuple[int, int, Polynomial]]:
        """Return from when to when it has which rate, where it is only looked at from a moment on."""
        if self.even_from is None:
            return [(begins, self.last, self.rate)]
        return [(begins, self.even_from, self.rate), (self.even_from, self.last, polynomial(ZERO))]


@dataclass(frozen=True, slots=True)
class Question:
    """What a solver is asked; what is known already, by number, and which moments have passed."""

    unknowns: Sequence[Unknown]
    formulas: Sequence[Named]
    known: Mapping[int, Fraction]
    passed: frozenset[int]
    broken: tuple[str, ...] = ()  # constraints of which what happened has broken a part: nobody can mend it

    def values(self, found: Sequence[float]) -> list[float]:
        """Return all values, where a solver found some."""
        return [float(self.known.get(number, value)) for number, value in enumerate(found)]


@dataclass(slots=True)
class OneRate:
    """The motions of one scene, as in the paper's equations 1 and 2, with speeds that do not jump.

    A `go` before a `dec` or an `acc` is even for as long as the program's manner calls settled.
    """

    scene: Scene
    limits: Mapping[int, Limits]
    ego: EgoBounds
    events: Events = field(init=False)
    refused: tuple[Named, ...] = field(init=False)
    now: int = field(init=False)
    _lowering: Lowering = field(init=False)
    _legs: dict[int, list[_Leg]] = field(init=False)
    _asked: dict[Fraction, list[Named]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self.events = Events(self.scene, self.limits, self.ego)
        self._lowering = Lowering(self.events)
        self._lowering.lower(self.scene.program.constraints)  # makes all moments
        self._legs = {actor.id: list(self._laid_out(actor)) for actor in self.scene.program.actors}
        self.now = self.events.instant("now")
        for actor in self.scene.program.actors:
            self.events.state(actor.id, self.now)
        lowered = self._lowering.lower(self.scene.program.constraints)
        self.refused = tuple(each for each in lowered if each.refused)
        self._asked[ZERO] = lowered

    def _laid_out(self, actor: Actor) -> Iterator[_Leg]:
        manner, kinds = self.scene.program.manner.stricter(ROOM), actor.sketch.pieces
        knots = [self.events.knot(actor.id, name) for name in actor.sketch.knots]
        for number, (kind, (first, last)) in enumerate(zip(kinds, pairwise(knots), strict=True)):
            law = self.events.law_of_piece(actor.id, kind)
            low, high = law.rate_low, law.rate_high
            if actor.id != EGO:
                high = min(high, -manner.begins_mpss) if kind is PieceKind.DEC else high
                low = max(low, manner.begins_mpss) if kind is PieceKind.ACC else low
            even = None
            if actor.id != EGO and kind is PieceKind.GO and set(kinds[number + 1 : number + 2]) & _PULLS:
                even = self.events.instant(f"settled{actor.id}_{number}")
                self.events.state(actor.id, even)
            rate = self.events.new(f"rate{actor.id}_{number}", low, high, "rate")
            yield _Leg(actor.id, number, kind, first, last, rate, even)

    # -- what is asked ------------------------------------------------------------------------------------------------
    def asked(self, tolerance: Fraction) -> list[Named]:
        """Return the program's constraints, the reactive ones weakened on either side by so many tight tolerances.

        With a tolerance that is not zero equalities but those of a speed give way by what rounding makes of the past.
        """
        if tolerance not in self._asked:
            found = list[Named]()
            for constraint in self.scene.program.constraints:
                rounded = ZERO if compared_dimension(constraint.formula) == "speed" else ROUNDED
                self._lowering.slack = max(tolerance, ROUNDED) if self._is_reactive(constraint) else rounded
                found += self._lowering.lower((constraint,))
            self._asked[tolerance] = found
        return self._asked[tolerance]

    def _is_reactive(self, constraint: Constraint) -> bool:
        """Whether it is about somebody's place at a knot on the way, as the paper's closed-loop pass has it."""
        for node in ex.walk(constraint.formula):
            if isinstance(node, ex.Derived) or (isinstance(node, ex.State) and node.order == 0):
                knots = self.scene.program.actor(node.actor).sketch.knots[1:-1]
                if not isinstance(node.at, ex.Knot) or node.at.name in knots:
                    return True
        return False

    def first(self, ego: tuple[float, float], *, even: bool) -> Question:
        """Return what is asked of a first plan, from the ego's place (m) and speed (m/s), with nothing weakened.

        With `even` the ego holds its speed, else it may have any rate in each piece.
        """
        events, known = self.events, self._own(self.now, 0.0, {EGO: ego})
        known |= _told(events.state(EGO, events.start), ego)
        same = []
        for hero in self.scene.program.heroes:
            here, there = events.state(hero.id, self.now), events.state(hero.id, events.start)
            same += [compare("==", here.place, there.place), compare("==", here.speed, there.speed)]
            marks = self.scene.landmarks_m[hero.id]
            if "turn_end" in marks:  # whoever is past most of a turn shows no longer where it came from
                same.append(compare("<=", there.place, pin(0.5 * (marks["turn_start"] + marks["turn_end"]))))
        return self._question(ZERO, known, frozenset({events.start}), [*same, *self._held(even)])

    def again(self, past: Past, tolerance: Fraction, *, even: bool) -> Question:
        """Return what is asked of the rest, after what has happened."""
        known = self._own(self.now, past.time_s, {a: states(past.time_s)[:2] for a, states in past.states.items()})
        passed = set(self._passed(past))
        for instant in passed:
            at_s = float(self.events.times[instant].constant or 0) or past.moments_s.get(instant, 0.0)
            states = {a: past.states[a](at_s)[:2] for a in past.states if (a, instant) in self.events.states}
            known |= self._own(instant, at_s, states)
            for (actor, at), rate in self._lowering.rates.items():
                if at == instant and at_s < past.time_s:
                    known |= _equal(rate, past.states[actor](at_s)[2])
        return self._question(max(tolerance, ROUNDED), known, frozenset(passed), self._held(even))

    def _held(self, even: bool) -> list[Formula]:
        return [compare("==", leg.rate, ZERO) for leg in self._legs[EGO]] if even else []

    def _passed(self, past: Past) -> Iterator[int]:
        """Yield the moments that have passed; one that is told by another only once that one has."""
        own = {leg.even_from for legs in self._legs.values() for leg in legs} | {self.now}
        early = {k for k, at_s in past.moments_s.items() if at_s <= past.time_s and k not in own}
        gone = {key for k in early if k not in self.events.defined for key in self.events.times[k].terms}
        for instant, time in enumerate(self.events.times):
            constant, told_by = time.constant, self.events.defined.get(instant)
            if constant is not None:
                happened = float(constant) <= past.time_s
            else:
                happened = instant in early and (told_by is None or all(key in gone for key in told_by.terms if key))
            if happened:
                yield instant

    def _own(self, instant: int, at_s: float, states: Mapping[int, Sequence[float]]) -> dict[int, Fraction]:
        known = _equal(self.events.times[instant], at_s)
        for actor, state in states.items():
            known |= _told(self.events.state(actor, instant), state)
        return known

    def _question(
        self, tolerance: Fraction, known: Mapping[int, Fraction], passed: frozenset[int], more: Sequence[Formula]
    ) -> Question:
        named = [*self.asked(tolerance), *self.events.rules]
        named += [Named(formula, "how everybody begins") for formula in more]
        for actor in self.scene.program.actors:
            named += [Named(held, f"how {actor.name} may move") for held in self._motion(actor, known, passed)]
        rest, broken = [], []
        for each in named:
            parts = each.formula.parts if isinstance(each.formula, All) else (each.formula,)
            for part in parts:
                left = _left(part, known)
                if left == FALSE and _numbers_in(*(found.left for found in atoms(part))) <= known.keys():
                    broken.append(each.origin)  # it has happened, and is nobody's to mend
                elif left != TRUE:
                    rest.append(Named(left, each.origin))
        return Question(self.events.unknowns, rest, known, passed, tuple(dict.fromkeys(broken)))

    # -- how everybody may move ---------------------------------------------------------------------------------------
    def _motion(self, actor: Actor, known: Mapping[int, Fraction], passed: frozenset[int]) -> Iterator[Formula]:
        """Yield what the way that is left is to be."""
        events, parts, begins = self.events, list[tuple[int, int, Polynomial]](), self.now
        for leg in self._legs[actor.id]:
            if leg.last in passed:
                continue
            parts += leg.parts(begins)
            if actor.id != EGO:
                yield from self._kept(leg, begins)
            begins = leg.last
        for early, late, rate in parts:
            yield from self._driven(actor.id, early, late, rate)
            yield compare("<=", events.times[early], events.times[late])
        if actor.id != EGO and (turn := TurnSpan.of(self.scene.routes[actor.id])) is not None:
            yield from self._slow_in_turn(actor.id, turn, parts, begins)
        own = {self.now, *(instant for part in parts for instant in part[:2])}
        for instant in events.instants_of(actor.id):
            state = events.state(actor.id, instant)
            if instant not in own and not _numbers_in(state.place, state.speed) <= known.keys():
                yield self._somewhere(actor.id, instant, parts, begins)
        for (owner, instant), rate in self._lowering.rates.items():
            if owner == actor.id and not _numbers_in(rate) <= known.keys():
                yield self._rate_at(instant, rate, parts)

    def _kept(self, leg: _Leg, begins: int) -> Iterator[Formula]:
        """Yield what the program's manner and a piece's kind ask of a hero; it is even so long before it pulls."""
        times, manner = self.events.times, self.scene.program.manner.stricter(ROOM)
        lasts, ends = times[leg.last] - times[leg.first], self.events.state(leg.actor, leg.last).speed
        match leg.kind:
            case PieceKind.STOP:
                yield compare(">=", lasts, manner.stands_s)
                yield compare("==", ends, ZERO)
            case PieceKind.DEC | PieceKind.ACC:
                yield compare(">=", lasts, manner.begins_s)
            case _ if leg.even_from is not None:
                yield compare(">=", ends, pin(MOVING_MPS))
                yield compare(">=", lasts, manner.settled_s)
                late = [  # from now on, where it is less than so long until then
                    compare("==", times[leg.even_from], times[begins]),
                    compare("<=", times[leg.last] - times[begins], manner.settled_s),
                ]
                yield some([compare("==", times[leg.last] - times[leg.even_from], manner.settled_s), every(late)])

    def _driven(self, actor: int, early: int, late: int, rate: Polynomial) -> Iterator[Formula]:
        """Yield the equations of motion at one rate."""
        events = self.events
        a, b, lasts = events.state(actor, early), events.state(actor, late), events.times[late] - events.times[early]
        yield compare("==", b.speed - a.speed, rate * lasts)
        yield compare("==", (b.place - a.place) * 2, (a.speed + b.speed) * lasts)

    def _somewhere(self, actor: int, instant: int, parts: Sequence[tuple[int, int, Polynomial]], last: int) -> Formula:
        """Return an actor's state at a moment that is none of its own: the paper's algorithm 2.

        A moment before now that has not happened yet is on the piece in hand, carried back.
        """
        times, choices = self.events.times, []
        for number, (early, late, rate) in enumerate(parts):
            within = [compare("<=", times[instant], times[late])]
            within += [compare(">=", times[instant], times[early])] if number else []
            choices.append(every([*within, *self._driven(actor, early, instant, rate)]))
        after = [compare(">=", times[instant], times[last])] if parts else []
        choices.append(every([*after, *self._driven(actor, last, instant, polynomial(ZERO))]))
        return some(choices)

    def _rate_at(self, instant: int, rate: Polynomial, parts: Sequence[tuple[int, int, Polynomial]]) -> Formula:
        """Return that a rate at a moment is that of what begins there; at the end of all pieces of what ends."""
        times, choices = self.events.times, []
        for number, (early, late, own) in enumerate(parts):
            if early == instant or (late == instant and number == len(parts) - 1):
                return compare("==", rate, own)
            within = [compare("<=", times[early], times[instant]), compare("<", times[instant], times[late])]
            choices.append(every([*within, compare("==", rate, own)]))
        after = [compare(">=", times[instant], times[parts[-1][1]])] if parts else []
        return some([*choices, every([*after, compare("==", rate, ZERO)])])

    def _slow_in_turn(
        self, actor: int, turn: TurnSpan, parts: Sequence[tuple[int, int, Polynomial]], last: int
    ) -> Iterator[Formula]:
        """Yield that nobody is faster in its turn than it can be: at both ends of it, and at moments between."""
        most, start, end = pin(_OF_TURN * self.limits[actor].turn_speed_max_mps), pin(turn.start_m), pin(turn.end_m)
        for early, late, rate in parts:
            a, b = self.events.state(actor, early), self.events.state(actor, late)
            yield some([compare("<=", b.place, start), compare(">", b.place, end), compare("<=", b.speed, most)])
            for place in (start, end):
                squared = a.speed * a.speed + rate * (place - a.place) * 2
                outside = [compare(">=", a.place, place), compare("<=", b.place, place)]
                yield some([*outside, compare("<=", squared, most * most)])
        then = self.events.state(actor, last)
        yield some([compare(">", then.place, end), compare("<=", then.speed, most)])

    # -- back ---------------------------------------------------------------------------------------------------------
    def moments_s(self, values: Sequence[float]) -> dict[int, float]:
        """Return when every moment is."""
        return {instant: time.value(values) for instant, time in enumerate(self.events.times)}

    def profile(self, actor: Actor, question: Question, values: Sequence[float], driven: Profile | None) -> Profile:
        """Return an actor's motion from now on, after what it drove."""
        times = self.moments_s(values)
        now_s = times[self.now]
        if driven is None:
            here = self.events.state(actor.id, self.now)
            s_m, speed, past = here.place.value(values), here.speed.value(values), list[Segment]()
        else:
            s_m, speed, _ = driven.state(now_s)
            past = driven.until(now_s)
        at_s = now_s
        for leg in self._legs[actor.id]:
            for _, late, rate in () if leg.last in question.passed else leg.parts(self.now):
                lasts, accel = times[late] - at_s, rate.value(values)
                if lasts <= 1e-9:
                    continue
                if leg.kind is PieceKind.STOP and actor.id != EGO:
                    speed = 0.0
                past.append(Segment(at_s, lasts, s_m, speed, accel, leg.piece))
                at_s, s_m, speed = past[-1].end_s, past[-1].end_s_m, past[-1].end_speed_mps
        if not past or past[-1].end_s < now_s:
            past.append(Segment(now_s, 0.0, s_m, speed, 0.0, len(self._legs[actor.id]) - 1))
        knots = {name: times[self.events.knot(actor.id, name)] for name in actor.sketch.knots}
        return Profile(tuple(past), knots)


# -- what is known --------------------------------------------------------------------------------------------------
def _equal(value: Polynomial, number: float) -> dict[int, Fraction]:
    return {} if value.constant is not None else {value.number: pin(number)}


def _told(state: State, values: Sequence[float]) -> dict[int, Fraction]:
    return {**_equal(state.place, values[0]), **_equal(state.speed, max(0.0, values[1]))}


def _numbers_in(*values: Polynomial) -> set[int]:
    return {number for value in values for key in value.terms for number in key}


def _left(formula: Formula, known: Mapping[int, Fraction]) -> Formula:
    """Return what is left of a formula once some unknowns are known; what was measured holds where it nearly does."""
    if isinstance(formula, Atom):
        left = _put(formula.left, known)
        value = left.constant
        if value is None or not _numbers_in(formula.left):
            return atom(left, formula.relation)
        return TRUE if (abs(value) if formula.relation == "==" else value) <= _HAPPENED else FALSE
    parts = [_left(part, known) for part in formula.parts]
    return every(parts) if isinstance(formula, All) else some(parts)


def _put(value: Polynomial, known: Mapping[int, Fraction]) -> Polynomial:
    terms: dict[tuple[int, ...], Fraction] = {}
    for key, factor in value.terms.items():
        for number in key:
            factor *= known.get(number, 1)
        rest = tuple(number for number in key if number not in known)
        terms[rest] = terms.get(rest, ZERO) + factor
    return Polynomial({key: factor for key, factor in terms.items() if factor})
