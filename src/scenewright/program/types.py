"""The scenario as typed data: parameters, actors with routes and motion sketches, constraints.

What enters: nothing. What leaves: the one representation that translators make and everything else reads.
It knows no map (routes are specifications, landmarks are names) and no solver.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction
from typing import Literal

from scenewright.errors import Span
from scenewright.program.expressions import Formula
from scenewright.program.manner import USUAL, Manner
from scenewright.units import PLAUSIBLE_RANGE, Unit, unit_of_name

EGO = 0
DEFAULT_MAP = "t_intersection"
Turn = Literal["left", "right", "straight"]
AreaKind = Literal["road", "driveway"]


class PieceKind(StrEnum):
    """What an actor does between two knots: hold its speed, speed up, slow down, stand still."""

    GO = "go"
    ACC = "acc"
    DEC = "dec"
    STOP = "stop"


@dataclass(frozen=True, slots=True)
class Sketch:
    """Knots and the pieces between them: ``[t0, go, t1, dec, t2]`` has three knots and two pieces."""

    knots: tuple[str, ...]
    pieces: tuple[PieceKind, ...]

    def __post_init__(self) -> None:
        if len(self.knots) != len(self.pieces) + 1:
            raise ValueError("a sketch has one knot more than pieces")

    def knot_index(self, name: str) -> int:
        """Return the position of knot `name`; raises KeyError where there is none."""
        if name not in self.knots:
            raise KeyError(name)
        return self.knots.index(name)

    def piece_names(self) -> tuple[str, ...]:
        """Return a unique name for each piece: its kind, with an ordinal where the kind occurs more than once."""
        names = []
        for index, kind in enumerate(self.pieces):
            ordinal = self.pieces[: index + 1].count(kind)
            names.append(str(kind) if self.pieces.count(kind) == 1 else f"{kind}{ordinal}")
        return tuple(names)

    def piece_index(self, name: str) -> int:
        """Return the position of the piece called `name` (``dec``, ``go2``); a bare kind means its first piece."""
        names = self.piece_names()
        if name in names:
            return names.index(name)
        if f"{name}1" in names:
            return names.index(f"{name}1")
        raise KeyError(name)

    def piece_ends(self, name: str) -> tuple[str, str]:
        """Return the knots at which a piece begins and ends."""
        index = self.piece_index(name)
        return self.knots[index], self.knots[index + 1]


@dataclass(frozen=True, slots=True)
class HeadingsRoute:
    """A route by the cardinal directions it is headed in: ``S, W`` comes out of a northern driveway and turns right."""

    headings: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class LanesRoute:
    """A route by lane ids of a map."""

    lanes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class IntentRoute:
    """A route by what the driver wants, to be grounded on a map: from where, which turn, into what."""

    origin: AreaKind | None = None
    turn: Turn | None = None
    destination: AreaKind | None = None
    origin_heading: str | None = None
    destination_heading: str | None = None


RouteSpec = HeadingsRoute | LanesRoute | IntentRoute


@dataclass(frozen=True, slots=True)
class Actor:
    """One vehicle. Actor 0 is the ego, which the driving policy under test controls."""

    id: int
    name: str
    route: RouteSpec
    sketch: Sketch
    span: Span | None = field(default=None, compare=False, repr=False)

    @property
    def is_ego(self) -> bool:
        """Whether the policy under test drives this actor."""
        return self.id == EGO


@dataclass(frozen=True, slots=True)
class Parameter:
    """A named quantity. Without a value it is open: the solver chooses within `low..high` (in the unit of its name)."""

    name: str
    value: Fraction | None = None
    low: Fraction | None = None
    high: Fraction | None = None
    span: Span | None = field(default=None, compare=False, repr=False)

    @property
    def unit(self) -> Unit:
        """The unit that the name ends in; raises KeyError for a name without one (the checker reports those)."""
        unit = unit_of_name(self.name)
        if unit is None:
            raise KeyError(self.name)
        return unit

    def bounds(self) -> tuple[Fraction, Fraction]:
        """Return the allowed range in the parameter's own unit: declared, or what is plausible for its dimension."""
        low, high = (bound / self.unit.si_factor for bound in PLAUSIBLE_RANGE[self.unit.dimension])
        return (low if self.low is None else self.low, high if self.high is None else self.high)


@dataclass(frozen=True, slots=True)
class Constraint:
    """One thing that must hold; `source` points into the program's description, `span` into the text parsed."""

    id: str
    formula: Formula
    source: Span | None = None
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Program:
    """A scenario."""

    name: str
    actors: tuple[Actor, ...]
    constraints: tuple[Constraint, ...]
    parameters: tuple[Parameter, ...] = ()
    map_name: str = DEFAULT_MAP
    description: str | None = None
    manner: Manner = USUAL
    heroes: tuple[Actor, ...] = field(init=False, compare=False, repr=False)  # the actors that are orchestrated

    def __post_init__(self) -> None:
        # Asked for at every step of a simulation.
        object.__setattr__(self, "heroes", tuple(actor for actor in self.actors if not actor.is_ego))

    def actor(self, actor_id: int) -> Actor:
        """Return the actor with this id; raises KeyError where there is none."""
        for actor in self.actors:
            if actor.id == actor_id:
                return actor
        raise KeyError(actor_id)

    @property
    def ego(self) -> Actor:
        """The actor that the policy under test drives."""
        return self.actor(EGO)

    def constraint(self, constraint_id: str) -> Constraint:
        """Return the constraint with this id; raises KeyError where there is none."""
        for constraint in self.constraints:
            if constraint.id == constraint_id:
                return constraint
        raise KeyError(constraint_id)

    def words_of(self, constraint: Constraint) -> str | None:
        """Return the stretch of the description that `constraint` came from, on one line, or None."""
        if self.description is None or constraint.source is None:
            return None
        return " ".join(constraint.source.excerpt(self.description).split())
