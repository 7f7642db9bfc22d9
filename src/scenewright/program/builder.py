"""Programs written by hand in Python: the same typed data as the text form gives.

What enters: actors, parameters and conditions, as a user writes them down. What leaves: a `Program`. A fault is raised
at the line that makes it. It knows no map, and runs nothing.

    scene = Scenario("oncoming left turner yields", map="t_intersection")
    ego = scene.ego("W", sketch="t0 go t1 go t2")
    hero = scene.actor("hero", "E", "N", sketch="t0 go t1 dec t2")
    scene.require(ego.tta(stop_line, "t1") == 3.0)
    scene.require(hero.a("dec") == -3.0)
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

from scenewright.errors import ProgramError, Span
from scenewright.program.check import check_constraint, check_program
from scenewright.program.expressions import ParameterRef
from scenewright.program.manner import USUAL, manner_of
from scenewright.program.printer import print_program
from scenewright.program.quantities import (
    Computed,
    Condition,
    Place,
    Quantity,
    Vehicle,
    always,
    conflict_point,
    eventually,
    exact,
    formula_of,
    intersection,
    junction_end,
    junction_start,
    just_before,
    never,
    route_end,
    si,
    stop_line,
    turn,
    turn_end,
    turn_start,
)
from scenewright.program.types import (
    DEFAULT_MAP,
    EGO,
    Actor,
    Constraint,
    HeadingsRoute,
    LanesRoute,
    Parameter,
    PieceKind,
    Program,
    RouteSpec,
    Sketch,
)
from scenewright.units import UNIT_SUFFIXES, unit_of_name

__all__ = [
    "Condition",
    "Place",
    "Quantity",
    "Scenario",
    "Vehicle",
    "always",
    "conflict_point",
    "eventually",
    "intersection",
    "junction_end",
    "junction_start",
    "just_before",
    "never",
    "route_end",
    "si",
    "stop_line",
    "turn",
    "turn_end",
    "turn_start",
]

Figure = float | Fraction | Decimal

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


class Scenario:
    """A scenario under construction.

    Parameters
    ----------
    name
        What it is called.
    map
        Name or file of the map that it is for.
    description
        The text that it stands for, if there is one; `require` can then say which words a condition comes from.

    Examples
    --------
    >>> scene = Scenario("cut-in brake")
    >>> ego = scene.ego("W", sketch="t0 go t1 go t2")
    >>> hero = scene.actor("hero", "W", sketch="t0 go t1 dec t2")
    >>> scene.require(ego.gap_to(hero, "t1") == 18)
    'c1'
    """

    def __init__(self, name: str, map: str = DEFAULT_MAP, description: str | None = None) -> None:
        self._name = name
        self._map = map
        self._description = description
        self._actors: list[Actor] = []
        self._parameters: list[Parameter] = []
        self._constraints: list[Constraint] = []
        self._manner = USUAL

    def ego(
        self,
        *headings: str,
        sketch: str | Sketch = "t0 go t1 go t2",
        lanes: Sequence[str] | None = None,
        route: RouteSpec | None = None,
        name: str = "ego",
    ) -> Vehicle:
        """Add the vehicle under test; see `actor`."""
        return self._add_actor(EGO, name, headings, lanes, route, sketch)

    def actor(
        self,
        name: str,
        *headings: str,
        sketch: str | Sketch,
        lanes: Sequence[str] | None = None,
        route: RouteSpec | None = None,
    ) -> Vehicle:
        """Add a vehicle that is orchestrated.

        Parameters
        ----------
        name
            A name of its own.
        headings
            Its route as the cardinal directions it is headed in, such as ``"E", "N"``.
        sketch
            Knots and pieces in turn, ``"t0 go t1 dec t2"``.
        lanes, route
            The route by ids of the map's lanes, or as any other specification, instead of headings.

        Raises
        ------
        ProgramError
            For a name taken, no route or two, or a sketch that is none.
        """
        return self._add_actor(
            1 + sum(not actor.is_ego for actor in self._actors), name, headings, lanes, route, sketch
        )

    def parameter(
        self, name: str, value: Figure | None = None, *, low: Figure | None = None, high: Figure | None = None
    ) -> Quantity:
        """Add a parameter, in the unit that its name ends in; without a value the solver chooses one in ``low..high``.

        Raises
        ------
        ProgramError
            For a name without a unit, a name taken, an empty range, or a value out of it.
        """
        if unit_of_name(name) is None or not _NAME.fullmatch(name):
            raise ProgramError(
                f"parameter {name} has no unit", found=name, expected=f"a name that ends in {UNIT_SUFFIXES}"
            )
        if any(parameter.name == name for parameter in self._parameters):
            raise ProgramError(f"parameter {name} is declared twice", found=name)
        parameter = Parameter(name, _exact_or_none(value), _exact_or_none(low), _exact_or_none(high))
        least, most = parameter.bounds()
        if least > most:
            raise ProgramError(f"the range of {name} is empty", found=f"[{float(least):g}, {float(most):g}]")
        if value is not None and not least <= exact(value) <= most:
            expected = f"{float(least):g} to {float(most):g}"
            raise ProgramError(f"parameter {name} is out of range", found=str(value), expected=expected)
        if low is not None or high is not None:
            parameter = replace(parameter, low=least, high=most)  # the text form has both ends or none
        self._parameters.append(parameter)
        return Computed(ParameterRef(name))

    def manner(self, **numbers: Figure) -> None:
        """Say what "begins", "settled" and "stands" mean here, in SI units (see `Manner`).

        What was said before stays; what is never said is as usual.

        Raises
        ------
        ProgramError
            For a name that a manner does not have, or a number out of its range.
        """
        said = {name: exact(value) for name, value in numbers.items()}
        manner_of((name, value, None) for name, value in said.items())
        self._manner = replace(self._manner, **said)

    def require(self, condition: Condition, id: str | None = None, words: str | None = None) -> str:
        """Require `condition` and return its id.

        Parameters
        ----------
        id
            What to call it in messages and verdicts; ``c1``, ``c2``, ... by themselves.
        words
            The stretch of the description that it comes from.

        Raises
        ------
        ProgramError
            Where it makes no sense: unlike things compared, an unknown actor or parameter, an id taken.
        """
        automatic = f"c{len(self._constraints) + 1}"
        name = automatic if id is None else id
        if any(constraint.id == name for constraint in self._constraints):
            raise ProgramError(f"two conditions are called {name}", found=name, fix="give the conditions other ids")
        if not _NAME.fullmatch(name):
            raise ProgramError("this is not an id", found=name, expected="letters, digits and underscores")
        constraint = Constraint(name, formula_of(condition), self._source(words))
        check_constraint(self._draft(()), constraint, name=self._name)
        self._constraints.append(constraint)
        return name

    def program(self) -> Program:
        """Return the program, checked as a whole.

        Raises
        ------
        ProgramError
            Where it has no ego, nobody else, or says something that the text form cannot.
        """
        from scenewright.program.text import parse_program

        program = self._draft(tuple(self._constraints))
        check_program(program, name=self._name)
        if parse_program(print_program(program), self._name) != program:
            raise ProgramError("this program has no text form", fix="use plain names for actors and lanes")
        return program

    def text(self) -> str:
        """Return the text form of the program, as in a `.scene` file."""
        return print_program(self.program())

    def _draft(self, constraints: tuple[Constraint, ...]) -> Program:
        actors = tuple(sorted(self._actors, key=lambda actor: actor.id))
        parameters = tuple(self._parameters)
        return Program(self._name, actors, constraints, parameters, self._map, self._description, self._manner)

    def _add_actor(
        self,
        actor_id: int,
        name: str,
        headings: tuple[str, ...],
        lanes: Sequence[str] | None,
        route: RouteSpec | None,
        sketch: str | Sketch,
    ) -> Vehicle:
        if any(actor.id == actor_id or actor.name == name for actor in self._actors):
            raise ProgramError(f"there is already an actor {name}", found=name)
        if not _NAME.fullmatch(name):
            raise ProgramError("this is not a name", found=name, expected="letters, digits and underscores")
        actor = Actor(actor_id, name, _route(headings, lanes, route), _sketch(sketch))
        self._actors.append(actor)
        return Vehicle(actor)

    def _source(self, words: str | None) -> Span | None:
        if words is None:
            return None
        start = -1 if self._description is None else self._description.find(words)
        if start < 0:
            raise ProgramError("these words are not in the description", found=words, expected=self._description)
        return Span(start, start + len(words))


def _exact_or_none(value: Figure | None) -> Fraction | None:
    return None if value is None else exact(value)


def _route(headings: tuple[str, ...], lanes: Sequence[str] | None, route: RouteSpec | None) -> RouteSpec:
    ways: list[RouteSpec] = [] if route is None else [route]
    if headings:
        if not set(headings) <= set("NESW"):
            raise ProgramError(
                "this is not a heading", found=", ".join(headings), expected="N, E, S or W, each by itself"
            )
        ways.append(HeadingsRoute(headings))
    if isinstance(lanes, str):
        raise ProgramError("lanes are a list of ids", found=lanes, expected=f"a list, such as [{lanes!r}]")
    if lanes:
        ways.append(LanesRoute(tuple(lanes)))
    if len(ways) != 1:
        raise ProgramError(
            "an actor has one route", found=f"{len(ways)} of them", expected="headings, lanes or a route"
        )
    return ways[0]


def _sketch(sketch: str | Sketch) -> Sketch:
    if isinstance(sketch, Sketch):
        return sketch
    names = str(sketch).strip("[] ").replace(",", " ").split()
    knots, pieces = tuple(names[0::2]), names[1::2]
    kinds = {str(kind) for kind in PieceKind}
    shaped = len(names) % 2 == 1 and set(pieces) <= kinds and len(set(knots)) == len(knots)
    if not shaped or any(knot.rstrip("0123456789") in kinds or not _NAME.fullmatch(knot) for knot in knots):
        raise ProgramError(
            "this is not a motion sketch",
            found=str(sketch),
            expected="knots and pieces (go, acc, dec, stop) in turn, such as 't0 go t1 dec t2'",
        )
    return Sketch(knots, tuple(PieceKind(piece) for piece in pieces))
