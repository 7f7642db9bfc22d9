"""What has to hold all through a stretch of time is decided before it begins: of alternatives, that which can hold.

What enters: a scene, and a motion that shows that it can happen. What leaves: the scene with such alternatives decided
as they are in that motion, for a planner. Alternatives that speak of moments alone stay open until these come. Whoever
has no trigger, and all the while has to be somewhere beside others, is not done before that is over.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from scenewright.plan.triggers import beside_others
from scenewright.program import expressions as ex
from scenewright.program.evaluate import violation
from scenewright.program.structure import knots_of, read_structure
from scenewright.program.types import Constraint, Program
from scenewright.roads.grounding import Scene
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.forms import asserted
from scenewright.solve.proofs.witness import Witness


def planned_for(scene: Scene, witness: Witness | None) -> Scene:
    """Return the scene as heroes are planned in it."""
    scene = scene if witness is None else decided(scene, witness)
    beside = beside_others(scene.program, read_structure(scene.program))
    over = (Constraint(f"until_{hero}", _is_over(scene.program, hero, ends)) for hero, ends in beside.items())
    return scene.besides(*over)


def _is_over(program: Program, hero: int, ends: tuple[ex.Term, ...]) -> ex.Formula:
    """Return that a hero's last knot is when the last of some ends has come; later only where the program tells it."""
    last = program.actor(hero).sketch.knots[-1]
    later = [ex.Arithmetic("-", ex.Elapsed(hero, last), end) for end in ends]
    not_before, then = ([ex.Compare(sign, each, ex.Number(Fraction(0))) for each in later] for sign in (">=", "=="))
    if any((hero, last) in knots_of(each.formula) for each in program.constraints):
        return ex.Logic("and", tuple(not_before))
    which = range(len(ends))
    return ex.Logic(
        "or", tuple(ex.Logic("and", tuple(then[k] if k == n else not_before[k] for k in which)) for n in which)
    )


def decided(scene: Scene, witness: Witness) -> Scene:
    """Return the scene in which of alternatives that last there is the one that holds best in a motion."""
    world, program = PlanWorld(scene, witness.profiles, witness.parameters), scene.program
    constraints = []
    for each in program.constraints:
        formula = asserted(each.formula, program)
        chosen = _decided(formula, world)
        constraints.append(each if chosen == formula else replace(each, formula=chosen))
    return replace(scene, program=replace(program, constraints=tuple(constraints)))


def _decided(formula: ex.Formula, world: PlanWorld) -> ex.Formula:
    match formula:
        case ex.Logic(operator="or", operands=operands) if any(map(_lasts, operands)):
            return _decided(min(operands, key=lambda each: violation(each, world)), world)
        case ex.Logic(operands=operands):
            return replace(formula, operands=tuple(_decided(each, world) for each in operands))
    return formula


def _lasts(formula: ex.Formula) -> bool:
    """Whether a formula is of a stretch of time, or of a whole piece."""
    return any(
        isinstance(node, ex.Temporal) or (isinstance(node, ex.State) and isinstance(node.at, ex.PieceRef))
        for node in ex.walk(formula)
    )
