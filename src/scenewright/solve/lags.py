"""Triggers that come some time after the start, or after the ego was somewhere: "two seconds after it passes the sign".

What enters: a scene. What leaves: for a hero's trigger the ego's earlier knot, or the start, and the time from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from scenewright.motion.algebra import Symbol, Value
from scenewright.motion.sketched import Ratio
from scenewright.program.expressions import Compare, Elapsed, walk
from scenewright.program.structure import KnotKey, Structure
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.lowering import Lowering, NotYet


@dataclass(frozen=True, slots=True)
class Lag:
    """The trigger comes `after_s` (s) after the ego passes its `knot`, or after the start where that is None."""

    knot: str | None
    after_s: float

    @classmethod
    def of(cls, scene: Scene, structure: Structure, hero: int) -> Lag | None:
        """Return it where the trigger is told by the time since the start or an earlier knot of the ego, else None."""
        own = structure.triggers.get(hero, frozenset())
        starts = set(structure.starts.items())
        for constraint in scene.program.constraints:
            formula = constraint.formula
            if not isinstance(formula, Compare) or formula.operator != "==":
                continue
            keys = {(node.actor, node.knot) for node in walk(formula) if isinstance(node, Elapsed)}
            later, earlier = keys & own, keys - own
            since_start = earlier <= starts
            if len(later) != 1 or len(earlier) > 1 or not (since_start or {actor for actor, _ in keys} == {EGO}):
                continue
            end, begin = next(iter(later)), next(iter(earlier), None)
            values = [_off(scene, structure, formula, {end: a, begin: b}) for a, b in ((0, 0), (1, 0), (0, 1))]
            if values[0] is None or values[1] is None or values[2] is None:
                continue
            per_later, per_earlier = values[1] - values[0], values[2] - values[0]
            if per_later and per_earlier == (0 if begin is None else -per_later):
                knot = None if since_start or begin is None else begin[1]
                return cls(knot, float(-values[0] / per_later))
        return None


class _Clock:
    """A motion of which only the times of its knots are known."""

    def __init__(self, times_s: Mapping[str, int]) -> None:
        self._times_s = times_s

    def time(self, knot: str) -> Value | None:
        known = self._times_s.get(knot)
        return None if known is None else Fraction(known)

    def at_knot(self, knot: str, order: int) -> Ratio | None:
        return None

    def at_time(self, time: Value, order: int) -> Value | None:
        return None

    def on_piece(self, piece: int, order: int) -> Ratio | None:
        return None


def _off(
    scene: Scene, structure: Structure, formula: Compare, times_s: Mapping[KnotKey | None, int]
) -> Fraction | None:
    keys = [key for key in times_s if key is not None]
    clocks = {actor: _Clock({knot: times_s[actor, knot] for who, knot in keys if who == actor}) for actor, _ in keys}
    lowering = Lowering(scene, structure, clocks, scene.parameters)
    try:
        (left, left_under), (right, right_under) = lowering.term(formula.left), lowering.term(formula.right)
    except (NotYet, KeyError):
        return None
    value = left * right_under - right * left_under
    return None if isinstance(value, Symbol) else Fraction(value)
