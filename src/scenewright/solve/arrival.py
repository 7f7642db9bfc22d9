"""When a motion meets a condition: the instant at which the ego, as predicted, is where a trigger wants it.

What enters: comparisons that speak of one actor at one knot. What leaves: conditions that are linear in its position and
speed, and the first time a profile meets them, exactly within each stretch of constant acceleration.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from scenewright.motion.algebra import Symbol, Value
from scenewright.motion.profile import Profile, Segment
from scenewright.motion.sketched import ONE, Ratio
from scenewright.program.evaluate import landmark_owner
from scenewright.program.expressions import Compare, Derived, Elapsed, Knot, State, walk
from scenewright.program.structure import knots_of
from scenewright.roads.grounding import Scene
from scenewright.solve.lowering import Lowering, NotYet

_HORIZON_S = 90.0


@dataclass(frozen=True, slots=True)
class PlaceCondition:
    """``constant + per_metre * position + per_speed * speed == 0``, for one actor at one of its knots."""

    constraint_id: str
    actor: int
    knot: str
    constant: float
    per_metre: float
    per_speed: float

    def value(self, s_m: float, speed_mps: float) -> float:
        """Return the left side for a state."""
        return self.constant + self.per_metre * s_m + self.per_speed * speed_mps

    def first_time(self, profile: Profile, after_s: float) -> float | None:
        """Return the first instant from `after_s` on at which `profile` meets the condition, or None within the horizon."""
        rest = profile.cut(after_s)
        last = rest.segments[-1]
        held = Segment(last.end_s, _HORIZON_S, last.end_s_m, last.end_speed_mps, 0.0)
        for segment in (*rest.segments, held):
            elapsed = self._root(segment)
            if elapsed is not None:
                return segment.start_s + elapsed
        return None

    def _root(self, segment: Segment) -> float | None:
        c = self.value(segment.s_m, segment.speed_mps)
        b = self.per_metre * segment.speed_mps + self.per_speed * segment.accel_mpss
        a = 0.5 * self.per_metre * segment.accel_mpss
        if abs(c) < 1e-9:
            return 0.0
        if abs(a) < 1e-12:
            roots = [-c / b] if abs(b) > 1e-12 else []
        else:
            inside = b * b - 4 * a * c
            if inside < 0:
                return None
            root = math.sqrt(inside)
            q = -0.5 * (b + math.copysign(root, b))
            roots = [q / a] + ([c / q] if q else [])
        fitting = [r for r in roots if -1e-9 <= r <= segment.duration_s + 1e-9]
        return max(0.0, min(fitting)) if fitting else None


class _Probe:
    """A motion that is in one given state at every knot: probing with three states tells a linear condition's coefficients."""

    def __init__(self, s_m: int, speed_mps: int) -> None:
        self._states = (Fraction(s_m), Fraction(speed_mps), Fraction(0))

    def time(self, knot: str) -> Value | None:
        return None

    def at_knot(self, knot: str, order: int) -> Ratio | None:
        return self._states[order], ONE

    def at_time(self, time: Value, order: int) -> Value | None:
        return None

    def on_piece(self, piece: int, order: int) -> Ratio | None:
        return None


def place_conditions(scene: Scene, actor: int) -> tuple[PlaceCondition, ...]:
    """Return the equalities that speak of `actor` alone at one knot and are linear in its position and speed."""
    found: list[PlaceCondition] = []
    for constraint in scene.program.constraints:
        formula = constraint.formula
        if not isinstance(formula, Compare) or formula.operator != "==" or not _only_speaks_of(formula, actor):
            continue
        knots = set(knots_of(formula))
        if len(knots) != 1:
            continue
        probed = [_probe(scene, formula, actor, *state) for state in ((0, 0), (1, 0), (0, 1), (1, 1))]
        values = [float(value) for value in probed if value is not None]
        if len(values) < len(probed):
            continue
        origin, metre, speed, both = values
        if abs(both - (metre + speed - origin)) > 1e-9 or metre == origin:
            continue
        knot = knots.pop()[1]
        found.append(PlaceCondition(constraint.id, actor, knot, origin, metre - origin, speed - origin))
    return tuple(found)


def _only_speaks_of(formula: Compare, actor: int) -> bool:
    for node in walk(formula):
        if isinstance(node, Elapsed):
            return False
        if isinstance(node, State | Derived):
            if node.actor != actor or not isinstance(node.at, Knot):
                return False
            if isinstance(node, Derived) and isinstance(node.target, int):
                return False
    return True


def _probe(scene: Scene, formula: Compare, actor: int, s_m: int, speed_mps: int) -> Fraction | int | None:
    lowering = Lowering(scene, {actor: _Probe(s_m, speed_mps)}, scene.parameters)
    try:
        owner = landmark_owner(formula)
        left_num, left_den = lowering.term(formula.left, owner)
        right_num, right_den = lowering.term(formula.right, owner)
        value = left_num * right_den - right_num * left_den
    except (NotYet, KeyError):
        return None
    return None if isinstance(value, Symbol) else value
