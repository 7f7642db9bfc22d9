"""Whether a first plan holds what the program asks for: what it breaks is told by name before anything is driven.

What enters: a scene, and the motions of everybody, the ego's as foreseen. What leaves: the constraints that these
motions break, and by how much. It knows no planner, and looks with the program's own evaluator.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from scenewright.motion.profile import Profile
from scenewright.program import expressions as ex
from scenewright.program.evaluate import term_value, violation
from scenewright.program.structure import KnotKey, actors_of, knots_of, read_structure
from scenewright.program.types import EGO, Constraint, Program
from scenewright.roads.grounding import Scene
from scenewright.solve.feasibility import Clash, clash
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.forms import free_actors
from scenewright.units import SI_SYMBOL, Dimension

_ROUNDED = 1e-2  # what a plan may be off by where no tolerance is given for what is compared


@dataclass(frozen=True, slots=True)
class NotHeld:
    """A constraint that a plan breaks, and by how much: in `unit`, infinite where no number says it."""

    constraint: Constraint
    told: Clash
    by: float
    unit: str

    def __str__(self) -> str:
        off = f", off by {self.by:.3g} {self.unit}".rstrip() if math.isfinite(self.by) else ""
        whose = "; the ego is nobody's to hold to it" if actors_of(self.constraint.formula) == {EGO} else ""
        return f"{self.told}{off}{whose}"


def not_held(
    scene: Scene,
    profiles: Mapping[int, Profile],
    dimension_of: Callable[[ex.Compare], Dimension | None],
    allowed: Callable[[Dimension | None], float],
    *,
    ego_promised: bool = True,
) -> Iterator[NotHeld]:
    """Yield the constraints that motions break by more than is `allowed` of the dimension of what they compare.

    Who comes before the ego is not asked about: it may still give way. Nor is what speaks of a knot of the ego that
    nobody foresees, or that nothing but its own state there tells, or of how the ego and another are to each other at
    a trigger, or for some time: the run brings that about. What is the ego's alone is asked of one that has promised to
    drive as foreseen: what any other does instead is seen by driving.
    """
    triggers = read_structure(scene.program).triggers.values()
    parameters = {name: float(value) for name, value in scene.parameters.items()}
    ego, world = profiles[EGO], PlanWorld(scene, profiles, parameters)
    passed = Profile(ego.segments, ego.knot_times_s | dict(_passed_s(scene, ego, world)))
    world.profiles = {**profiles, EGO: passed}
    open_knots = {(EGO, name) for name in scene.program.ego.sketch.knots[1:]} - _told(scene.program)
    for constraint in scene.program.constraints:
        actors, knots = actors_of(constraint.formula), set(knots_of(constraint.formula))
        if actors == {EGO} and (not ego_promised or knots & open_knots):
            continue
        if knots and actors > {EGO} and any(knots <= instant for instant in triggers):
            continue
        for part in _asked(constraint.formula):
            if any(actor == EGO and math.isinf(world.knot_time_s(EGO, knot)) for actor, knot in knots_of(part)):
                continue
            by = violation(part, world)
            dimensions = {dimension_of(node) for node in ex.walk(part) if isinstance(node, ex.Compare)}
            if not by <= max(_ROUNDED, *map(allowed, dimensions)):
                dimension = dimensions.pop() if len(dimensions) == 1 else None
                unit = SI_SYMBOL[dimension] if dimension else ""
                yield NotHeld(constraint, clash(scene.program, constraint.id), by, unit)
                break


def _told(program: Program) -> set[KnotKey]:
    """Return the knots of which the program says where the ego is there, or when they come.

    Where a hero is to be at a moment does not tell when that is, nor that it is another's moment of which nothing does.
    """
    formulas = (each.formula for each in program.constraints)
    equal = [formula for formula in formulas if isinstance(formula, ex.Compare) and formula.operator == "=="]
    told: set[KnotKey] = {(actor.id, actor.sketch.knots[0]) for actor in program.actors}
    timed: list[set[KnotKey]] = []
    for formula in equal:
        nodes = list(ex.walk(formula))
        placed = {(node.actor, node.order) for node in nodes if isinstance(node, ex.State)}
        if (EGO, 0) in placed or any(isinstance(node, ex.Derived) for node in nodes):
            told.update(knots_of(formula))
        elif not placed:
            timed.append(set(knots_of(formula)))
    while more := next((knots for knots in timed if len(knots - told) == 1), None):
        told |= more
    return told


def _passed_s(scene: Scene, ego: Profile, world: PlanWorld) -> Iterator[tuple[str, float]]:
    """Yield when the ego passes each knot that the program puts at a place: a plan need not know of all of them."""
    for constraint in scene.program.constraints:
        match constraint.formula:
            case ex.Compare("==", ex.State(actor=0, order=0, at=ex.Knot(name=knot), frame=None), place) if not any(
                isinstance(node, ex.State | ex.Derived | ex.Elapsed) for node in ex.walk(place)
            ):
                time_s = ego.time_at(term_value(place, world))
                if time_s is not None:
                    yield knot, time_s


def _asked(formula: ex.Formula) -> Iterator[ex.Formula]:
    """Yield the parts that all must hold, without those that a run brings about."""
    if isinstance(formula, ex.Logic) and formula.operator == "and":
        for operand in formula.operands:
            yield from _asked(operand)
    elif not any(_is_order(node) or _lasts_beside_ego(node) for node in ex.walk(formula)):
        yield formula


def _is_order(node: ex.Node) -> bool:
    """Whether it says of moments, the ego's among them, that one comes before another."""
    if not isinstance(node, ex.Compare) or node.operator == "==" or EGO not in actors_of(node):
        return False
    return not any(isinstance(each, ex.State | ex.Derived) for each in ex.walk(node))


def _lasts_beside_ego(node: ex.Node) -> bool:
    """Whether it says how the ego and another are to each other for some time."""
    return isinstance(node, ex.Temporal) and node.operator != "eventually" and {EGO} < free_actors(node.body)
