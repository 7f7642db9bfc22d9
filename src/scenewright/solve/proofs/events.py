"""The moments of a scenario, and everybody's state there, as unknowns: what proofs and searches are about.

What enters: a scene, who is bounded how, and what is asked for as constraints are lowered. What leaves: instants with
their times, states of actors at instants, the law on every piece of an actor's way. It holds no constraint.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from scenewright.algebra.polynomials import (
    ZERO,
    Named,
    Polynomial,
    Unknown,
    compare,
    every,
    polynomial,
    some,
    unknown,
)
from scenewright.motion.laws import Law
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile
from scenewright.program import expressions as ex
from scenewright.program.magnitudes import LONGEST_S
from scenewright.program.structure import read_structure
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.translate.phrases import does
from scenewright.units import pin


@dataclass(frozen=True, slots=True)
class EgoBounds:
    """What is taken for granted of the ego. The defaults hold for any road vehicle."""

    speed_max_mps: float = 60.0
    accel_max_mpss: float = 8.0
    brake_max_mpss: float = 12.0
    holds_speed: bool = False

    def law(self) -> Law:
        """Return the law of the ego's motion."""
        rates = (ZERO, ZERO) if self.holds_speed else (-pin(self.brake_max_mpss), pin(self.accel_max_mpss))
        return Law(*rates, ZERO, pin(self.speed_max_mps))

    def words(self, name: str) -> str:
        """Say what a proof takes for granted of the ego."""
        if self.holds_speed:
            return f"{name} holds its speed, as its policy promises"
        source = "any road vehicle" if self == EgoBounds() else "its policy promises"
        return f"{name} {self.law().words()}, as {source}"


@dataclass(frozen=True, slots=True)
class State:
    """Where an actor is and how fast at an instant."""

    place: Polynomial
    speed: Polynomial


@dataclass(frozen=True, slots=True)
class Narrowing:
    """A narrower law for an actor between two instants: that of a piece, or what a constraint makes of it.

    A plan keeps to its `law`. What every legal motion keeps to is `proven`, if anything: that the rate of a piece lasts
    all through it is for plans, what is proven of a piece is proven of its mean rate.
    """

    actor: int
    first: int
    last: int
    law: Law
    proven: Law | None = None
    place: int | None = None  # the moment at a place that it holds from, or up to, within first and last
    place_m: Fraction = ZERO
    up_to_place: bool = False
    even: bool = False  # whether a plan keeps to one rate between each two moments
    origin: str = ""  # the constraint that it comes from, by id; of a piece what it is, in words
    said: ex.Formula | None = None  # what it makes superfluous between its ends

    def begins(self) -> tuple[int, ...]:
        """Return the moments of which the latest is its beginning."""
        return (self.first,) if self.place is None or self.up_to_place else (self.first, self.place)

    def ends(self) -> tuple[int, ...]:
        """Return the moments of which the earliest is its end."""
        return (self.last, self.place) if self.place is not None and self.up_to_place else (self.last,)


@dataclass(slots=True)
class Events:
    """The unknowns of one scene. Instants, states and rates are made when they are first asked for."""

    scene: Scene
    limits: Mapping[int, Limits]
    ego: EgoBounds
    drive: Profile | None = None  # how the ego really drove: to ask whether any hero could have done better
    freed: Mapping[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    unknowns: list[Unknown] = field(default_factory=list)
    times: list[Polynomial] = field(default_factory=lambda: [polynomial(ZERO)])  # of instants; the first is the start
    states: dict[tuple[int, int], State] = field(default_factory=dict)
    pieces: list[Narrowing] = field(default_factory=list)  # those in which somebody does not move freely
    rules: list[Named] = field(default_factory=list)
    parameters: dict[str, Polynomial] = field(default_factory=dict)
    start: int = 0
    defined: dict[int, Polynomial] = field(default_factory=dict)
    places: dict[tuple[int, Fraction], int] = field(default_factory=dict)  # when an actor passes one
    ahead: dict[tuple[int, int], None] = field(default_factory=dict)  # instants, the earlier first
    _knots: dict[tuple[int, str], int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, value in self.scene.parameters.items():
            self.parameters[name] = polynomial(value)
        for parameter in self.scene.open_parameters():
            low, high = (bound * parameter.unit.si_factor for bound in parameter.bounds())
            self.parameters[parameter.name] = self.new(f"p_{parameter.name}", low, high, "other")
        for name, (low, high) in self.freed.items():
            self.parameters[name] = self.new(f"p_{name}", low, high, "other")
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
        return len(self.times) - 1

    def moment(self, time: Polynomial) -> int:
        """Return the instant of a time, which may depend on others; the start where it would be before it."""
        if (constant := time.constant) is not None:
            time = polynomial(max(ZERO, constant))
        for number, known in (*enumerate(self.times), *self.defined.items()):
            if known.terms == time.terms:
                return number
        if constant is not None:
            self.times.append(time)
            return len(self.times) - 1
        made = self.instant("told")
        self.defined[made] = time
        mine = self.times[made]
        words = "an interval begins and ends when it is said to"
        self.rules.append(Named(compare(">=", mine, time), words))
        self.rules.append(Named(some([compare("<=", mine, time), compare("<=", mine, ZERO)]), words))
        return made

    def at_place(self, actor: int, place_m: Fraction) -> int:
        """Return when an actor is at a place: the start if it is past it then, the end if it never is."""
        key = (actor, place_m)
        if key in self.places:
            return self.places[key]
        others = self.instants_of(actor)
        made = self.places[key] = self.instant(f"place{actor}")
        state, now = self.state(actor, made), self.times[made]
        there = compare("==", state.place, place_m)
        past = every([compare("<=", now, ZERO), compare(">=", state.place, place_m)])
        never = every([compare("<=", state.place, place_m), *(compare("<=", self.times[k], now) for k in others)])
        self.rules.append(Named(some([there, past, never]), "whoever drives passes one place after another"))
        return made

    def knot(self, actor: int, name: str) -> int:
        """Return the instant of an actor's knot."""
        return self._knots[actor, name]

    def state(self, actor: int, instant: int) -> State:
        """Return the state of an actor at an instant."""
        key = (actor, instant)
        if key not in self.states:
            if actor == EGO and self.drive is not None and (known := self.times[instant].constant) is not None:
                place, speed, _ = self.drive.state(float(known))
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
        return self.ego.law() if actor == EGO else self.limits[actor].law()

    # -- pieces -------------------------------------------------------------------------------------------------------
    def _name_knots(self) -> None:
        """Give every knot its instant: the first ones are the start, synchronised ones are one."""
        program = self.scene.program
        driven_s = self.drive.knot_times_s if self.drive is not None else {}
        starts = {(actor.id, actor.sketch.knots[0]) for actor in program.actors}
        instants = [group | starts if group & starts else group for group in read_structure(program).instants]
        for actor in program.actors:
            for knot in actor.sketch.knots:
                key = (actor.id, knot)
                if key not in self._knots:
                    group = next((group for group in [*instants, starts] if key in group), {key})
                    told_s = [driven_s[name] for owner, name in group if owner == EGO and name in driven_s]
                    if group >= starts or told_s:
                        made = self.start if group >= starts else self.moment(polynomial(pin(told_s[0])))
                    else:
                        made = self.instant(f"{actor.name}_{knot}")
                    self._knots |= dict.fromkeys(group, made)

    def _lay_out(self, actor: Actor) -> None:
        """Put a law on each piece of an actor's way in which it does not move freely."""
        knots = [self.knot(actor.id, name) for name in actor.sketch.knots]
        pieces = actor.sketch.pieces
        for index, ((first, last), kind) in enumerate(zip(pairwise(knots), pieces, strict=True)):
            self.order(first, last)
            law = self.law_of_piece(actor.id, kind)
            if law != self.law_of(actor.id):
                origin = f"while {actor.name} {does(kind, pieces[:index].count(kind))}, it {law.words()}"
                self.pieces.append(Narrowing(actor.id, first, last, law, law, origin=origin))
        for instant in dict.fromkeys(knots):
            self.state(actor.id, instant)

    def law_of_piece(self, actor: int, kind: PieceKind) -> Law:
        """Return the law of a kind of piece: a `go` is free, braking and speeding up are one-sided, a `stop` stands."""
        free = self.law_of(actor)
        if actor == EGO or kind is PieceKind.GO:
            return free
        low = free.rate_low if kind is PieceKind.DEC else ZERO
        high = free.rate_high if kind is PieceKind.ACC else ZERO
        return Law(low, high, ZERO, ZERO if kind is PieceKind.STOP else free.speed_high)

    def order(self, first: int, second: int) -> None:
        """Note that `second` does not come before `first`."""
        self.ahead[first, second] = None
