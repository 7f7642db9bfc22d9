"""Triggers that come some time after the ego was somewhere: "two seconds after it passes the sign".

What enters: a scene. What leaves: for a hero's trigger the ego's earlier knot and the time from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from scenewright.motion.algebra import Symbol, Value
from scenewright.motion.sketched import Ratio
from scenewright.program.expressions import Compare, Elapsed, walk
from scenewright.program.structure import Structure
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.lowering import Lowering, NotYet


@dataclass(frozen=True, slots=True)
class Lag:
    """The trigger comes `after_s` (s) after the ego passes its `knot`."""

    knot: str
    after_s: float

    @classmethod
    def of(cls, scene: Scene, structure: Structure, hero: int) -> Lag | None:
        """Return it for a hero whose trigger is told by the time since an earlier knot of the ego, else None."""
        own = {knot for actor, knot in structure.triggers.get(hero, frozenset()) if actor == EGO}
        for constraint in scene.program.constraints:
            formula = constraint.formula
            if not isinstance(formula, Compare) or formula.operator != "==":
                continue
            times = [node for node in walk(formula) if isinstance(node, Elapsed)]
            knots = {time.knot for time in times}
            if any(time.actor != EGO for time in times) or len(knots) != 2 or len(knots & own) != 1:
                continue
            earlier, later = next(iter(knots - own)), next(iter(knots & own))
            values = [_off(scene, structure, formula, {earlier: a, later: b}) for a, b in ((0, 0), (1, 0), (0, 1))]
            if values[0] is None or values[1] is None or values[2] is None:
                continue
            per_earlier, per_later = values[1] - values[0], values[2] - values[0]
            if per_later and per_earlier == -per_later:
                return cls(earlier, float(-values[0] / per_later))
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


def _off(scene: Scene, structure: Structure, formula: Compare, times_s: Mapping[str, int]) -> Fraction | None:
    lowering = Lowering(scene, structure, {EGO: _Clock(times_s)}, scene.parameters)
    try:
        (left, left_under), (right, right_under) = lowering.term(formula.left, None), lowering.term(formula.right, None)
    except (NotYet, KeyError):
        return None
    value = left * right_under - right * left_under
    return None if isinstance(value, Symbol) else Fraction(value)
