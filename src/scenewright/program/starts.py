"""Which starts nobody would choose, and who is asked to begin so all the same.

What enters: a program. What leaves: numbers, and whether it says how near two begin. Where that is left open, whoever
plans keeps away from such a start, and the judge holds it against a run.
"""

from __future__ import annotations

from scenewright.program.expressions import Compare, Derived, Node, State, walk
from scenewright.program.structure import Role, Structure
from scenewright.program.types import Program

# What most drivers find comfortable (AASHTO, A Policy on Geometric Design of Highways and Streets, 3.2.2: 11.2 ft/s^2).
HARD_MPSS = 3.4
AT_ONCE_S = 1.0  # how soon after the start hard braking is because of it: who sees a reason later has had time to react
TAILGATES_S = 1.0  # half of what drivers are told to keep, and about what is fined in Germany (BKatV, 12: 0.9 s)


def kept_m(speed_mps: float, closing_mps: float) -> float:
    """Return how much room (m) nobody gives up by choice: a second's way, or one to react and then brake evenly."""
    return max(TAILGATES_S * speed_mps, TAILGATES_S * closing_mps + closing_mps**2 / (2.0 * HARD_MPSS))


def says_how_near(program: Program, structure: Structure, actor: int, other: int) -> bool:
    """Whether a program says how near two begin: in time, or in metres and how fast the first is."""
    asked: list[Node] = []
    for constraint in program.constraints:
        if structure.roles[constraint.id] is Role.INITIAL and isinstance(constraint.formula, Compare):
            asked += walk(constraint.formula) if constraint.formula.operator == "==" else ()
    derived = [node for node in asked if isinstance(node, Derived)]
    apart = {node.kind for node in derived if {node.actor, node.target} == {actor, other}}
    timed = {node.actor for node in derived if node.kind == "tta"}
    placed = {node.actor for node in asked if isinstance(node, State) and node.order == 0}
    in_time = bool(apart & {"headway", "ttc"}) or {actor, other} <= timed
    is_fast = any(isinstance(node, State) and (node.actor, node.order) == (actor, 1) for node in asked)
    return in_time or (is_fast and (bool(apart & {"gap", "freespace"}) or {actor, other} <= placed))
