"""On which side of the ego a hero keeps that shares its lane.

What enters: a scene and its linear conditions. What leaves: for a hero whose trigger speaks of the distance between the
two, whether it is the one ahead.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scenewright.program.structure import Structure
from scenewright.program.types import EGO, Actor
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition

# Places that lie further apart than this tell who is ahead: a car and as much room as is kept from the ego.
_TELLING_M = VEHICLE_LENGTH_M + 1.5
# A difference of places may depend on speeds too: what people drive in town tells the side.
_TYPICAL_MPS = 10.0


@dataclass(frozen=True, slots=True)
class Clearance:
    """Whether the hero is ahead, what to add to its arc length to compare it with the ego's (m).

    And whether the trigger speaks of the distance itself, and from where on the hero is on that lane (m).
    """

    ahead: bool
    offset_m: float
    of_distance: bool = True
    since_m: float = 0.0

    @classmethod
    def of(
        cls, scene: Scene, structure: Structure, conditions: Sequence[LinearCondition], hero: Actor
    ) -> Clearance | None:
        """Return it for a hero whose trigger, or else whose start, tells where both are on their lane, else None.

        Nobody drives through anybody, so whoever is ahead at one moment is so all along.
        """
        conflict = scene.conflict(EGO, hero.id)
        if conflict is None or conflict.kind == "crossing":
            return None
        follows = conflict.kind == "following"
        since_m = 0.0 if follows else conflict.s_b_m
        start = frozenset((actor.id, actor.sketch.knots[0]) for actor in scene.program.actors)
        trigger, offset_m = structure.triggers.get(hero.id, frozenset()), scene.offset_m(EGO, hero.id)
        for instant in (trigger, start):
            told = [condition for condition in conditions if condition.moments <= instant]
            for condition in told:
                if set(condition.weights) != {EGO, hero.id}:
                    continue
                gap_m = _gap_m(condition, hero.id, offset_m)
                if gap_m:  # that one is ahead at all, a bound of 0, says nothing of the distance
                    return cls(gap_m > 0.0, offset_m, instant == trigger, since_m)
            places_m = {
                actor: -condition.constant / metre
                for condition in told
                for actor, (metre, second) in condition.weights.items()
                if len(condition.weights) == 1 and metre and not second
            }
            if follows and {EGO, hero.id} <= set(places_m):
                gap_m = places_m[hero.id] + offset_m - places_m[EGO]
                if abs(gap_m) >= _TELLING_M:
                    return cls(gap_m > 0.0, offset_m, of_distance=False)
        return None


def _gap_m(condition: LinearCondition, hero: int, offset_m: float) -> float | None:
    """Return how far ahead of the ego (m) the hero is where `condition` holds; None where it is about another thing."""
    hero_metre, hero_speed = condition.weights[hero]
    ego_metre, ego_speed = condition.weights[EGO]
    if hero_metre == 0.0 or abs(hero_metre + ego_metre) > 1e-9:
        return None
    rest = condition.constant + (hero_speed + ego_speed) * _TYPICAL_MPS - hero_metre * offset_m
    return -rest / hero_metre
