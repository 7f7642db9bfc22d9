"""Who shares a lane with the ego stays out of it: on which side of it a hero is to be at its trigger, and before.

What enters: a scene and its linear conditions. What leaves: how far a hero must be from the ego, on one side of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from scenewright.motion.algebra import Condition, Value, compare, pin
from scenewright.motion.profile import Profile
from scenewright.program.expressions import Derived, Node, walk
from scenewright.program.structure import Role, Structure
from scenewright.program.types import EGO, Actor
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition, hero_side

# A vehicle's length, and some room between the bumpers.
APART_M = VEHICLE_LENGTH_M + 1.5
# How far before the place where the two could touch a hero is out of the ego's way.
OUT_OF_WAY_M = 0.5
# A difference of places may depend on speeds too: what people drive in town tells the side.
_TYPICAL_MPS = 10.0


@dataclass(frozen=True, slots=True)
class Clearance:
    """How far a hero keeps from the ego that it shares a lane with.

    Attributes
    ----------
    ahead
        Whether the hero is the one in front.
    offset_m
        What to add to the hero's arc length to compare it with the ego's.
    closing
        Whether the distance has to shrink at the trigger, as a time to collision says.
    """

    ahead: bool
    offset_m: float
    closing: bool = False

    @classmethod
    def of(
        cls, scene: Scene, structure: Structure, conditions: tuple[LinearCondition, ...], hero: Actor
    ) -> Clearance | None:
        """Return it for a hero whose trigger speaks of the distance between the two on their lane, else None."""
        conflict = scene.conflict(EGO, hero.id)
        if conflict is None or conflict.kind != "following":
            return None
        offset_m = scene.offset_m(EGO, hero.id)
        instant = structure.triggers.get(hero.id, frozenset())
        formulas = {constraint.id: constraint.formula for constraint in scene.program.constraints}
        for condition in conditions:
            if set(condition.weights) != {EGO, hero.id} or not condition.moments <= instant:
                continue
            distance = _distance(formulas[condition.constraint_id])
            if distance is not None:
                return cls(distance.actor == EGO, offset_m, distance.kind == "ttc")
            gap_m = _gap_m(condition, hero.id, offset_m)
            if gap_m is not None:
                return cls(gap_m > 0.0, offset_m)
        return None

    def gap_m(self, ego: Profile, time_s: float, s_m: float) -> float:
        """Return how far apart (m) the two are at a time, negative where they are on the wrong sides."""
        gap_m = s_m + self.offset_m - ego.state(time_s)[0]
        return gap_m if self.ahead else -gap_m

    def condition(self, ego: Profile, time_s: float, s_m: Value, apart_m: float = APART_M) -> Condition:
        """Return that the hero, at `s_m`, is far enough from the ego at a time."""
        sign = 1 if self.ahead else -1
        least = pin(apart_m) + sign * pin(ego.state(time_s)[0] - self.offset_m)
        return compare(">=", sign * s_m, least)

    def is_kept(self, ego: Profile, time_s: float, s_m: Fraction | float) -> bool:
        """Whether the hero is far enough from the ego."""
        return self.gap_m(ego, time_s, float(s_m)) >= APART_M


def out_of_way_mps(scene: Scene, structure: Structure, conditions: tuple[LinearCondition, ...], hero: Actor) -> float:
    """Return from which speed on (m/s) a hero that is timed at its trigger is not in the ego's way there; 0 for any.

    Who is two seconds from a place is the nearer to it the slower it is, and an ego that is to pass first stops for a
    hero in its way. Where the program says who is to be first the hero has to hurry.
    """
    side, conflict = hero_side(conditions, structure, hero.id), scene.conflict(EGO, hero.id)
    if side is None or conflict is None or conflict.kind == "following" or not all(side.weights[hero.id]):
        return 0.0
    if Role.OUTCOME in structure.roles.values():
        return 0.0
    per_metre, per_speed = side.weights[hero.id]
    reaches_m = -side.constant / per_metre - (conflict.zone_b_m[0] - OUT_OF_WAY_M)
    return max(0.0, reaches_m * per_metre / per_speed) if per_metre * per_speed > 0.0 else 0.0


def _distance(formula: Node) -> Derived | None:
    """Return the gap, headway or time to collision that a formula speaks of; its first actor is the one behind."""
    found = (node for node in walk(formula) if isinstance(node, Derived) and isinstance(node.target, int))
    return next(found, None)


def _gap_m(condition: LinearCondition, hero: int, offset_m: float) -> float | None:
    """Return how far ahead of the ego (m) the hero is where `condition` holds; None where it is about another thing."""
    hero_metre, hero_speed = condition.weights[hero]
    ego_metre, ego_speed = condition.weights[EGO]
    if hero_metre == 0.0 or abs(hero_metre + ego_metre) > 1e-9:
        return None
    rest = condition.constant + (hero_speed + ego_speed) * _TYPICAL_MPS - hero_metre * offset_m
    return -rest / hero_metre
