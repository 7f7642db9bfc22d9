"""The moments of a scenario, and everybody's state there, as unknowns: what proofs and searches are about.

What enters: a scene, who is bounded how, and what is asked for as constraints are lowered: a knot, a concrete time, a
moment of somebody else. What leaves: instants with their times, states of actors at instants, the law on every
stretch of an actor's way, and what is certain of the order of instants. It holds no constraint of the program.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.laws import Law
from scenewright.motion.profile import Profile
from scenewright.program.structure import synchronised
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import Limits
from scenewright.solve.proofs.polynomials import (
    ZERO,
    All,
    Atom,
    Formula,
    Polynomial,
    compare,
    every,
    polynomial,
    some,
    unknown,
)
from scenewright.units import pin

LONGEST_S = Fraction(120)
_PASSES = 2  # over all comparisons, to see between which places somebody is: enough for one that rests on another


@dataclass(frozen=True, slots=True)
class EgoBounds:
    """What is taken for granted of the ego. The defaults hold for any road vehicle."""

    speed_max_mps: float = 60.0
    accel_max_mpss: float = 8.0
    brake_max_mpss: float = 12.0
    holds_speed: bool = False

    def law(self) -> Law:
        """Return the law of the ego's motion."""
        top = pin(self.speed_max_mps)
        if self.holds_speed:
            return Law(ZERO, ZERO, ZERO, top)
        return Law(-pin(self.brake_max_mpss), pin(self.accel_max_mpss), ZERO, top)

    def words(self, name: str) -> str:
        """Say what a proof takes for granted of the ego."""
        if self.holds_speed:
            return f"{name} holds its speed, as its policy promises"
        source = "any road vehicle" if self == EgoBounds() else "its policy promises"
        return f"{name} {self.law().words()}, as {source}"


@dataclass(frozen=True, slots=True)
class EgoDrive:
    """How the ego really drove, and when it passed its knots: to ask whether any hero could have done better."""

    motion: Profile
    knot_times_s: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Unknown:
    """A real number to be found; its kind is ``time``, ``place``, ``speed``, ``rate`` or ``other``."""

    name: str
    low: Fraction
    high: Fraction
    kind: str


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of an actor's way under one law, between two instants; `last` None: for ever."""

    law: Law
    first: int
    last: int | None
    kind: PieceKind


@dataclass(frozen=True, slots=True)
class State:
    """Where an actor is and how fast at an instant."""

    place: Polynomial
    speed: Polynomial


@dataclass(slots=True)
class Events:
    """The unknowns of one scene. Instants, states and rates are made when they are first asked for."""

    scene: Scene
    limits: Mapping[int, Limits]
    ego: EgoBounds
    drive: EgoDrive | None = None
    freed: Mapping[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    unknowns: list[Unknown] = field(default_factory=list)
    times: list[Polynomial] = field(default_factory=list)
    states: dict[tuple[int, int], State] = field(default_factory=dict)
    stretches: dict[int, list[Stretch]] = field(default_factory=dict)
    rules: list[tuple[Formula, str]] = field(default_factory=list)
    parameters: dict[str, Polynomial] = field(default_factory=dict)
    start: int = 0
    defined: dict[int, Polynomial] = field(default_factory=dict)
    _knots: dict[tuple[int, str], int] = field(default_factory=dict)
    _clock: dict[Fraction, int] = field(default_factory=dict)
    _places: dict[tuple[int, Fraction], int] = field(default_factory=dict)
    _ahead: dict[tuple[int, int], Fraction] = field(default_factory=dict)
    _learned: dict[tuple[int, int], Fraction] = field(default_factory=dict)
    _within: dict[tuple[int, int], tuple[Fraction, Fraction]] = field(default_factory=dict)  # learned of places (m)
    _instant_of: dict[tuple[int, ...], int] = field(default_factory=dict)  # by its unknown

    def __post_init__(self) -> None:
        for name, value in self.scene.parameters.items():
            self.parameters[name] = polynomial(value)
        for parameter in self.scene.open_parameters():
            low, high = (bound * parameter.unit.si_factor for bound in parameter.bounds())
            self.parameters[parameter.name] = self.new(f"p_{parameter.name}", low, high, "other")
        for name, (low, high) in self.freed.items():
            self.parameters[name] = self.new(f"p_{name}", low, high, "other")
        self.start = self.clock(ZERO)
        self._name_knots()
        for actor in self.scene.program.actors:
            self._lay_out(actor)

    # -- unknowns -----------------------------------------------------------------------------------------------------
    def new(self, name: str, low: Fraction, high: Fraction, kind: str) -> Polynomial:
        """Return a new unknown."""
        self.unknowns.append(Unknown(name, low, high, kind))
        return unknown(len(self.unknowns) - 1)

    def instant(self, name: str) -> int:
        """Return a new instant, at a time that is to be found."""
        self.times.append(self.new(f"T_{name}", ZERO, LONGEST_S, "time"))
        self._instant_of[(len(self.unknowns) - 1,)] = len(self.times) - 1
        return len(self.times) - 1

    def clock(self, time_s: Fraction) -> int:
        """Return the instant of a concrete time."""
        if time_s not in self._clock:
            self.times.append(polynomial(time_s))
            self._clock[time_s] = len(self.times) - 1
        return self._clock[time_s]

    def moment(self, time: Polynomial, name: str) -> int:
        """Return the instant of a time that depends on others; the start where it would be before it."""
        constant = time.constant
        if constant is not None:
            return self.clock(max(ZERO, constant))
        for number, known in (*enumerate(self.times), *self.defined.items()):
            if known.terms == time.terms:
                return number
        made = self.instant(name)
        self.defined[made] = time
        mine = self.times[made]
        self.rules.append((compare(">=", mine, time), "an interval begins and ends when it is said to"))
        self.rules.append((some([compare("<=", mine, time), compare("<=", mine, ZERO)]), self.rules[-1][1]))
        return made

    def at_place(self, actor: int, place_m: Fraction) -> int:
        """Return when an actor is at a place: the start if it is past it then, the end if it never is."""
        key = (actor, place_m)
        if key in self._places:
            return self._places[key]
        others = self.instants_of(actor)
        made = self._places[key] = self.instant(f"place{actor}")
        state, now = self.state(actor, made), self.times[made]
        there = compare("==", state.place, place_m)
        past = every([compare("<=", now, ZERO), compare(">=", state.place, place_m)])
        never = every([compare("<=", state.place, place_m), *(compare("<=", self.times[k], now) for k in others)])
        self.rules.append((some([there, past, never]), "whoever drives passes one place after another"))
        return made

    def knot(self, actor: int, name: str) -> int:
        """Return the instant of an actor's knot."""
        return self._knots[actor, name]

    def state(self, actor: int, instant: int) -> State:
        """Return the state of an actor at an instant."""
        key = (actor, instant)
        if key not in self.states:
            if actor == EGO and self.drive is not None and (known := self.times[instant].constant) is not None:
                place, speed, _ = self.drive.motion.state(float(known))
                self.states[key] = State(polynomial(pin(place)), polynomial(pin(speed)))
                return self.states[key]
            law = self.law_of(actor)
            end = pin(self.scene.routes[actor].landmarks["route_end"])
            self.states[key] = State(
                self.new(f"x{actor}_{instant}", ZERO, end, "place"),
                self.new(f"v{actor}_{instant}", ZERO, law.speed_high, "speed"),
            )
        return self.states[key]

    def instants_of(self, actor: int) -> list[int]:
        """Return the instants at which an actor has a state."""
        return [instant for owner, instant in self.states if owner == actor]

    def law_of(self, actor: int) -> Law:
        """Return the law of an actor that moves freely."""
        if actor == EGO:
            return self.ego.law()
        return self.limits[actor].law()

    # -- pieces -------------------------------------------------------------------------------------------------------
    def _name_knots(self) -> None:
        """Give every knot its instant: the first ones are the start, synchronised ones are one."""
        program = self.scene.program
        groups = {(actor.id, knot): {(actor.id, knot)} for actor in program.actors for knot in actor.sketch.knots}
        pairs = [((actor.id, actor.sketch.knots[0]), (EGO, program.ego.sketch.knots[0])) for actor in program.actors]
        for constraint in program.constraints:
            pairs += list(synchronised(constraint.formula))
        for left, right in pairs:
            joined = groups[left] | groups[right]
            for key in joined:
                groups[key] = joined
        starts = groups[EGO, program.ego.sketch.knots[0]]
        for actor in program.actors:
            for knot in actor.sketch.knots:
                key = (actor.id, knot)
                if key in self._knots:
                    continue
                made = self.start if key in starts else self._driven(groups[key])
                made = self.instant(f"{actor.name}_{knot}") if made is None else made
                for each in groups[key]:
                    self._knots[each] = made

    def _driven(self, keys: set[tuple[int, str]]) -> int | None:
        """Return the instant of knots of which the ego's drive tells the time; None where it does not."""
        known = self.drive.knot_times_s if self.drive is not None else {}
        found = [known[name] for actor, name in keys if actor == EGO and name in known]
        return self.clock(pin(found[0])) if found else None

    def _lay_out(self, actor: Actor) -> None:
        """Put a law on each stretch of an actor's way; neighbours under one law are one stretch."""
        knots = [self.knot(actor.id, name) for name in actor.sketch.knots]
        found: list[Stretch] = []
        for piece, kind in enumerate(actor.sketch.pieces):
            law = self.law_of_piece(actor.id, kind)
            self.order(knots[piece], knots[piece + 1])
            if found and found[-1].law == law:
                found[-1] = Stretch(law, found[-1].first, knots[piece + 1], found[-1].kind)
            else:
                found.append(Stretch(law, knots[piece], knots[piece + 1], kind))
        free = self.law_of(actor.id)
        if found[-1].law == free:
            found[-1] = Stretch(free, found[-1].first, None, found[-1].kind)
        else:
            found.append(Stretch(free, knots[-1], None, PieceKind.GO))
        self.stretches[actor.id] = found
        for instant in dict.fromkeys(knots):
            self.state(actor.id, instant)

    def law_of_piece(self, actor: int, kind: PieceKind) -> Law:
        """Return the law of a kind of piece: a `go` is free, braking and speeding up are one-sided, a `stop` stands."""
        free = self.law_of(actor)
        if actor == EGO:
            return free
        match kind:
            case PieceKind.DEC:
                return Law(free.rate_low, ZERO, ZERO, free.speed_high)
            case PieceKind.ACC:
                return Law(ZERO, free.rate_high, ZERO, free.speed_high)
            case PieceKind.STOP:
                return Law(ZERO, ZERO, ZERO, ZERO)
            case _:
                return free

    # -- order --------------------------------------------------------------------------------------------------------
    def order(self, first: int, second: int, least_s: Fraction = ZERO) -> None:
        """Note that `second` comes at least `least_s` after `first`."""
        if first != second:
            key = (first, second)
            self._ahead[key] = max(least_s, self._ahead.get(key, least_s))

    def least_differences(self) -> NDArray[np.float64]:
        """Return a matrix of how much later (s) each instant (column) is at least than another (row).

        Where what was learned contradicts itself only what holds by itself is in it: the contradiction is for a proof.
        """
        both = dict(self._ahead)
        for key, value in self._learned.items():
            both[key] = max(value, both.get(key, value))
        least = self._closed(both)
        return least if not np.any(np.diag(least) > 1e-9) else self._closed(self._ahead)

    def _closed(self, ahead: Mapping[tuple[int, int], Fraction]) -> NDArray[np.float64]:
        count = len(self.times)
        constants = [(number, known) for number, time in enumerate(self.times) if (known := time.constant) is not None]
        least = np.full((count, count), -float(max(LONGEST_S, *(known for _, known in constants))))
        np.fill_diagonal(least, 0.0)
        least[self.start, :] = 0.0
        least[self.start, self.start] = 0.0
        for (first, second), value in ahead.items():
            least[first, second] = max(least[first, second], float(value))
        for first, a in constants:
            for second, b in constants:
                least[first, second] = float(b - a)
        for middle in range(count):
            np.maximum(least, least[:, middle, None] + least[None, middle, :], out=least)
        return least

    def learn_from(self, formulas: Iterable[Formula]) -> None:
        """Note what comparisons of two times, and places that are known, say of the order of instants."""
        linear = [part for part in conjuncts(formulas) if part.left.degree == 1]
        for part in linear:
            if (found := self.difference(part.left)) is not None:
                early, late, most_s = found
                self._note(late, early, -most_s)
                if part.relation == "==":
                    self._note(early, late, most_s)
        self._within = where = self._places_within(linear)
        for (actor, place), made in self._places.items():
            before, after = self._knots_about(actor, place)
            if before and after:
                where[actor, made] = place, place
            for knot in before:  # the end where it is never passed
                self._note(knot, made, ZERO)
            for knot in after:  # the start where it was passed before
                self._note(made, knot, ZERO)
        for (actor, first), (_, most) in where.items():
            for (other, second), (least, _) in where.items():
                if actor == other and most < least:
                    fastest = self.law_of(actor).speed_high
                    # One that never moves comes nowhere: the laws refute that, whatever the order.
                    self._note(first, second, (least - most) / fastest if fastest else ZERO)

    def surely_passes(self, actor: int, place_m: Fraction) -> bool:
        """Whether what was learned says that an actor begins before a place and comes past it."""
        return all(self._knots_about(actor, place_m))

    def _knots_about(self, actor: int, place_m: Fraction) -> tuple[list[int], list[int]]:
        """Return the instants of an actor's knots that are certain to be before a place (m), and past it."""
        knots = {instant for (owner, _), instant in self._knots.items() if owner == actor} & {
            instant for owner, instant in self._within if owner == actor
        }
        before = [knot for knot in knots if self._within[actor, knot][1] < place_m]
        return before, [knot for knot in knots if self._within[actor, knot][0] > place_m]

    def _places_within(self, linear: Sequence[Atom]) -> dict[tuple[int, int], tuple[Fraction, Fraction]]:
        """Return between which places (m) everybody is at each instant, by linear comparisons and who comes when."""
        within = [[each.low, each.high] for each in self.unknowns]
        told = [part.left for part in linear] + [-part.left for part in linear if part.relation == "=="]
        own = {
            where: next(iter(state.place.terms))[0]
            for where, state in self.states.items()
            if state.place.constant is None
        }
        later = [
            (own[a, first], own[a, second])
            for a, first in own
            for first_, second in self._ahead
            if first_ == first and (a, second) in own
        ]
        still = [
            (own[a, each.first], own[a, each.last])
            for a, found in self.stretches.items()
            for each in found
            if each.law.speed_high == 0 and each.last is not None
        ]
        for _ in range(_PASSES):
            for left in told:
                _narrow(left, within)
            for first, second in (*later, *still):
                within[second][0] = max(within[second][0], within[first][0])
                within[first][1] = min(within[first][1], within[second][1])
            for first, second in still:
                within[second][1] = min(within[second][1], within[first][1])
                within[first][0] = max(within[first][0], within[second][0])
        made = {(actor, instant) for (actor, _), instant in self._places.items()}
        return {where: (within[n][0], within[n][1]) for where, n in own.items() if where not in made}

    def impossible(self, part: Formula, least: NDArray[np.float64]) -> bool:
        """Whether something contradicts what is certain of the order of instants."""
        if not isinstance(part, Atom) or part.relation == "==" or part.left.degree != 1:
            return False
        found = self.difference(part.left)
        if found is None:
            return False
        early, late, most_s = found
        return bool(least[early, late] > float(most_s) - (1e-9 if part.relation == "<" else -1e-9))

    def difference(self, left: Polynomial) -> tuple[int, int, Fraction] | None:
        """Return `early`, `late` and `most_s` where ``left <= 0`` says that ``late - early <= most_s``."""
        parts = [(self._instant_of[key], factor) for key, factor in left.terms.items() if key in self._instant_of]
        size = abs(parts[0][1]) if parts else ZERO
        if not 1 <= len(parts) <= 2 or len(parts) + (() in left.terms) != len(left.terms):
            return None
        if len(parts) == 1:
            parts.append((self.start, -parts[0][1]))
        (a, sign), (b, other) = parts
        if sign + other != 0:
            return None
        late, early = (a, b) if sign > 0 else (b, a)
        return early, late, -left.terms.get((), ZERO) / size

    def _note(self, first: int, second: int, least_s: Fraction) -> None:
        self._learned[first, second] = max(least_s, self._learned.get((first, second), least_s))


def conjuncts(formulas: Iterable[Formula]) -> Iterator[Atom]:
    """Yield what is compared in every case."""
    for part in formulas:
        if isinstance(part, All):
            yield from conjuncts(part.parts)
        elif isinstance(part, Atom):
            yield part


def _narrow(left: Polynomial, within: list[list[Fraction]]) -> None:
    """Narrow the ranges of unknowns by ``left <= 0``, a linear polynomial."""
    terms = [(key[0], factor) for key, factor in left.terms.items() if key]
    least = left.terms.get((), ZERO) + sum(f * within[n][0 if f > 0 else 1] for n, f in terms)
    for number, factor in terms:
        low, high = within[number]
        rest = least - factor * (low if factor > 0 else high)
        if factor > 0:
            within[number][1] = min(high, -rest / factor)
        else:
            within[number][0] = max(low, -rest / factor)
