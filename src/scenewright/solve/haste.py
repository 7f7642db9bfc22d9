"""How soon a hero can have done, at the earliest, what comes after its trigger: by arithmetic, without a solver.

What enters: a hero's sketch with the places that the program gives, a style. What leaves: a time that no motion within
that style beats.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

from scenewright.program.expressions import Compare, Elapsed
from scenewright.program.structure import Role, Structure
from scenewright.program.types import EGO, Actor, PieceKind, Program
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.limits import Limits, Style
from scenewright.solve.stretches import rate_is_given


@dataclass(frozen=True, slots=True)
class Errand:
    """What a hero does from its trigger on until it is to be somewhere before the ego is.

    Attributes
    ----------
    pieces
        ``(kind, way_m)`` in order: how far each piece leads, None where the program does not say.
    ego_knot
        The ego's knot that it is to be before.
    """

    pieces: tuple[tuple[PieceKind, float | None], ...]
    ego_knot: str

    @classmethod
    def of(
        cls, program: Program, structure: Structure, conditions: tuple[LinearCondition, ...], hero: Actor
    ) -> Errand | None:
        """Return the errand of a hero that is to be first, None for any other and for one whose rates are given."""
        trigger = structure.trigger_knot(hero.id)
        order = next(
            (
                constraint.formula
                for constraint in program.constraints
                if structure.roles[constraint.id] is Role.OUTCOME and _is_order(constraint.formula, hero.id)
            ),
            None,
        )
        if trigger is None or order is None:
            return None
        assert isinstance(order, Compare)
        assert isinstance(order.left, Elapsed)
        assert isinstance(order.right, Elapsed)
        knots = hero.sketch.knots
        first, last = knots.index(trigger), knots.index(order.left.knot)
        if last <= first or any(rate_is_given(program, hero, piece) for piece in range(first, last)):
            return None
        places = [_place_m(structure, conditions, hero, knot) for knot in knots[first : last + 1]]
        for k, piece in enumerate(hero.sketch.pieces[first:last]):
            if piece is PieceKind.STOP and places[k + 1] is None:
                places[k + 1] = places[k]
        ways = [None if a is None or b is None else b - a for a, b in pairwise(places)]
        return cls(tuple(zip(hero.sketch.pieces[first:last], ways, strict=True)), order.right.knot)

    def least_s(self, style: Style, limits: Limits) -> float:
        """Return the shortest time (s) that the errand takes in `style`, never more than any motion in it takes."""
        fastest = max(style.top_speeds_mps(limits)[0], style.top_speed_after_mps(limits))
        cruise = min(style.top_speeds_mps(limits))
        total_s, standing = 0.0, False
        for k, (kind, way_m) in enumerate(self.pieces):
            stops = k + 1 < len(self.pieces) and self.pieces[k + 1][0] is PieceKind.STOP
            if kind is PieceKind.STOP:
                total_s += style.stop_s[0]
            elif way_m is not None and way_m > 0.0:
                if kind is PieceKind.DEC and stops:
                    total_s += max(2.0 * way_m / fastest, math.sqrt(2.0 * way_m / style.dec_mpss[1]))
                elif kind is PieceKind.ACC and standing:
                    total_s += _from_a_stand_s(way_m, style.acc_mpss[1], cruise)
                else:
                    total_s += way_m / fastest
            standing = kind is PieceKind.STOP
        return total_s


def _from_a_stand_s(way_m: float, accel_mpss: float, top_mps: float) -> float:
    """Return how long (s) it takes to speed up from a stand, and to drive on at `top_mps` once that is reached."""
    if 2.0 * accel_mpss * way_m <= top_mps * top_mps:
        return math.sqrt(2.0 * way_m / accel_mpss)
    return way_m / top_mps + 0.5 * top_mps / accel_mpss


def _is_order(formula: object, hero: int) -> bool:
    return (
        isinstance(formula, Compare)
        and formula.operator in ("<", "<=")
        and isinstance(formula.left, Elapsed)
        and isinstance(formula.right, Elapsed)
        and formula.left.actor == hero
        and formula.right.actor == EGO
    )


def _place_m(structure: Structure, conditions: tuple[LinearCondition, ...], hero: Actor, knot: str) -> float | None:
    """Return where the program puts `hero` at `knot`, None where that depends on its speed or is not said."""
    for condition in conditions:
        weights: Mapping[int, tuple[float, float]] = condition.weights
        if set(weights) != {hero.id} or weights[hero.id][0] == 0.0 or weights[hero.id][1] != 0.0:
            continue
        if any(structure.same_moment(hero.id, key) == knot for key in condition.moments):
            return -condition.constant / weights[hero.id][0]
    return None
