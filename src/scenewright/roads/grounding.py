"""Puts a program on a map: routes for its actors, arc lengths for its landmarks, numbers for its parameters.

What enters: a `Program`, a `RoadMap`, values for parameters. What leaves: a `Scene`, all that later stages need to know
of the map. It raises where the map lacks a route or a landmark; it decides nothing about motion.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from fractions import Fraction

from scenewright.errors import MapError, ParameterError, Place
from scenewright.program.expressions import (
    CONFLICT_LANDMARKS,
    Compare,
    Derived,
    Landmark,
    Negate,
    Node,
    ParameterRef,
    PieceRef,
    State,
    walk,
)
from scenewright.program.resolve import resolve, usual_partner
from scenewright.program.types import Actor, Constraint, HeadingsRoute, LanesRoute, Parameter, Program, RouteSpec
from scenewright.roads.conflicts import Conflict, find_conflict, shared_offset_m
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route, RouteQuery, find_route
from scenewright.units import decimal_fraction


@dataclass(frozen=True, slots=True)
class Scene:
    """A program on a map.

    Attributes
    ----------
    program
        With every landmark's actor and partner, and the frame of every comparison (see `program.resolve`).
    routes
        By actor id.
    landmarks_m
        Arc lengths by actor id and name; conflict names are those with the actor's usual partner (the ego, or for the
        ego the first hero).
    parameters
        SI values by name; an open parameter is absent.
    """

    program: Program
    road_map: RoadMap
    routes: Mapping[int, Route]
    landmarks_m: Mapping[int, Mapping[str, float]]
    parameters: Mapping[str, Fraction]
    notes: tuple[str, ...] = ()

    def landmark_m(self, actor: int, name: str, other: int | None = None) -> float:
        """Return a landmark's arc length (m) on the route of `actor`; raises MapError where there is none."""
        known = self.landmarks_m[actor]
        if other is not None and name in CONFLICT_LANDMARKS:
            known = _meeting_places(self.routes[actor], self.routes[other])
        if name not in known:
            raise _no_landmark(self.program, actor, name, other, self.landmarks_m[actor])
        return known[name]

    def named_landmarks_m(self, actor: int) -> dict[str, float]:
        """Return the landmarks of `actor`; those with others than its usual partner as ``turn(hero2)``."""
        places = dict(self.landmarks_m[actor])
        for other in self.program.actors:
            if other.id not in (actor, usual_partner(self.program, actor)):
                met = _meeting_places(self.routes[actor], self.routes[other.id])
                places |= {f"{name}({other.name})": s_m for name, s_m in met.items()}
        return places

    def offset_m(self, actor: int, other: int) -> float:
        """Return what to add to the arc length of `other` to compare it with that of `actor`.

        Raises
        ------
        MapError
            Where the two never share a lane.
        """
        if actor == other:
            return 0.0
        offset = shared_offset_m(self.routes[actor], self.routes[other])
        if offset is None:
            a, b = self.program.actor(actor), self.program.actor(other)
            raise MapError(
                f"the distance between {a.name} and {b.name} is not defined: their routes share no lane",
                place=Place(self.road_map.name),
                found=f"{self.routes[actor]} and {self.routes[other]}",
                fix="measure each distance to the conflict point instead",
            )
        return offset

    def conflict(self, actor: int, other: int) -> Conflict | None:
        """Return the conflict of two actors' routes, or None where they never meet."""
        return find_conflict(self.routes[actor], self.routes[other])

    def besides(self, *more: Constraint) -> Scene:
        """Return the scene of the program that asks for this, too."""
        return replace(self, program=replace(self.program, constraints=(*self.program.constraints, *more)))

    def open_parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters without a value: the solver chooses them."""
        return tuple(p for p in self.program.parameters if p.name not in self.parameters)


def ground(program: Program, road_map: RoadMap, values: Mapping[str, float | str | Fraction] | None = None) -> Scene:
    """Put `program` on `road_map` with parameter `values` (in the unit of each name).

    Raises
    ------
    MapError
        Where a route or a landmark is not to be had on this map.
    ParameterError
        For an unknown parameter, one that is not a finite number, or one out of its range.
    """
    program = resolve(program)
    routes = {actor.id: _route(actor, road_map) for actor in program.actors}
    parameters = parameter_values(program, values or {})
    program, parameters, notes = _signed_decelerations(program, parameters)
    landmarks = {actor.id: _landmarks(program, actor, routes) for actor in program.actors}
    scene = Scene(program, road_map, routes, landmarks, parameters, (*notes, *_without_effect(program)))
    for constraint in program.constraints:
        for node in walk(constraint.formula):
            _check_node(scene, node)
    return scene


def parameter_values(program: Program, values: Mapping[str, float | str | Fraction]) -> dict[str, Fraction]:
    """Return the SI value of every parameter that is given here or in the program."""
    known = {parameter.name: parameter for parameter in program.parameters}
    for name in values:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            raise ParameterError(
                f"there is no parameter {name}",
                found=name,
                expected=", ".join(known) or "a scenario with parameters (this one has none)",
                fix=f"did you mean {near[0]}?" if near else None,
            )
    result: dict[str, Fraction] = {}
    for parameter in known.values():
        value = _number(parameter.name, values[parameter.name]) if parameter.name in values else parameter.value
        if value is None:
            continue
        low, high = parameter.bounds()
        if not low <= value <= high:
            raise ParameterError(
                f"parameter {parameter.name} is out of range",
                found=f"{float(value):g} {parameter.unit.symbol}",
                expected=f"{float(low):g} to {float(high):g} {parameter.unit.symbol}",
            )
        result[parameter.name] = value * parameter.unit.si_factor
    return result


def _number(name: str, value: float | str | Fraction) -> Fraction:
    try:
        if isinstance(value, Fraction):
            return value
        if not math.isfinite(float(value)):
            raise ValueError
        return decimal_fraction(value)
    except (TypeError, ValueError):
        raise ParameterError(
            f"parameter {name} is not a number", found=str(value), expected="a finite number", fix=f"-p {name}=12.5"
        ) from None


def query_of(route: RouteSpec) -> RouteQuery:
    """Return what a program asks of an actor's route, as `find_route` takes it."""
    match route:
        case HeadingsRoute(headings=headings):
            return {"headings": headings}
        case LanesRoute(lanes=lanes):
            return {"lanes": lanes}
    return {
        "origin_kind": route.origin,
        "turn": route.turn,
        "destination_kind": route.destination,
        "origin_heading": route.origin_heading,
        "destination_heading": route.destination_heading,
    }


def _route(actor: Actor, road_map: RoadMap) -> Route:
    try:
        return find_route(road_map, **query_of(actor.route))
    except MapError as error:
        error.message = f"{actor.name} (A{actor.id}): {error.message}"
        error.args = (error.message,)
        raise


def _landmarks(program: Program, actor: Actor, routes: Mapping[int, Route]) -> dict[str, float]:
    partner = usual_partner(program, actor.id)
    met = _meeting_places(routes[actor.id], routes[partner]) if partner is not None and partner in routes else {}
    return {**routes[actor.id].landmarks, **met}


def _meeting_places(route: Route, other: Route) -> dict[str, float]:
    """Return the landmarks that depend on another route: the conflict; without one, where the junction begins."""
    conflict = find_conflict(route, other)
    if conflict is not None:
        return dict.fromkeys(CONFLICT_LANDMARKS, conflict.s_a_m)
    if "junction_start" in route.landmarks:
        return dict.fromkeys(("intersection", "turn"), route.landmarks["junction_start"])
    return {}


def _check_node(scene: Scene, node: Node) -> None:
    """Look up whatever `node` needs of the map; raises MapError where it is not to be had."""
    if isinstance(node, Landmark) and node.actor is not None:
        scene.landmark_m(node.actor, node.name, node.other)
    if isinstance(node, State | Landmark) and node.frame is not None and node.actor is not None:
        scene.offset_m(node.frame, node.actor)
    if isinstance(node, Derived) and isinstance(node.target, int):
        scene.offset_m(node.actor, node.target)


def _signed_decelerations(
    program: Program, parameters: dict[str, Fraction]
) -> tuple[Program, dict[str, Fraction], tuple[str, ...]]:
    """Give a deceleration parameter the sign that its comparison needs: people write both ``3`` and ``-3``."""
    result, notes, declared = dict(parameters), [], {each.name: each for each in program.parameters}
    for constraint in program.constraints:
        formula = constraint.formula
        if not (isinstance(formula, Compare) and isinstance(formula.left, State) and formula.left.order == 2):
            continue
        if not (isinstance(formula.left.at, PieceRef) and formula.left.at.name.startswith("dec")):
            continue
        right = formula.right
        sign = 1 if isinstance(right, Negate) else -1
        reference = right.operand if isinstance(right, Negate) else right
        if not isinstance(reference, ParameterRef):
            continue
        own = declared[reference.name]
        low, high = own.bounds()
        if own.low is not None and max(sign * low, sign * high) <= 0 != low + high:
            value = None if own.value is None else -own.value
            declared[own.name] = replace(own, value=value, low=-high, high=-low)
            if own.name not in result:
                read = f"{-float(high):g} to {-float(low):g} {own.unit.symbol}"
                notes.append(f"{own.name} is a deceleration: read as {read}")
        if reference.name in result and result[reference.name] != (wanted := sign * abs(result[reference.name])):
            notes.append(f"{reference.name} is a deceleration: read as {float(wanted):g} m/s^2")
            result[reference.name] = wanted
    return replace(program, parameters=tuple(declared.values())), result, tuple(notes)


def _without_effect(program: Program) -> list[str]:
    """Say of parameters that no constraint speaks of that they do nothing: their name may be mistyped there."""
    used = {node.name for each in program.constraints for node in walk(each.formula) if isinstance(node, ParameterRef)}
    idle = [parameter.name for parameter in program.parameters if parameter.name not in used]
    return [f"no constraint speaks of the parameter {name}: it has no effect" for name in idle]


def _no_landmark(
    program: Program, actor: int, name: str, other: int | None, there_are: Mapping[str, float]
) -> MapError:
    meets = other is not None and name in CONFLICT_LANDMARKS
    why = f": it never meets that of {program.actor(other).name}" if meets and other is not None else ""
    return MapError(
        f"{program.actor(actor).name}'s route has no {name.replace('_', ' ')}{why}",
        place=Place(program.map_name),
        found=name,
        expected=", ".join(sorted(there_are)),
        fix="choose one of these landmarks, or routes that meet" if meets else "choose one of these landmarks",
    )
