"""Divides what is left of a hero's sketch into stretches of one acceleration each.

What enters: a sketch, a `Situation`, a `Style`. What leaves: stretches, in order. Where the instant of the trigger is
given, those on the way to it have known durations, which keeps the problem linear. It bounds nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.motion.algebra import pin
from scenewright.program.expressions import Compare, Formula, PieceRef, State, walk
from scenewright.program.structure import Structure
from scenewright.program.types import Actor, PieceKind, Program
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.limits import COASTING, Limits, Style, Wait
from scenewright.solve.situation import Situation

_WALKING_MPS = 2.0
# How long a first step may be, and must be, that leaves one who drives the time to stop; who stops sooner stands.
_QUICK_S, _SHORTEST_QUICK_S, _STANDS_S = Fraction(3, 2), Fraction(1, 5), Fraction(1, 100)
_SHORTEST_S = Fraction(1, 20)
_OF_TIME_TO_ARRIVAL = Fraction(2, 3)


@dataclass(frozen=True, slots=True)
class Stretch:
    """A stretch of constant acceleration: its piece, its duration if known, the knot at its end if there is one."""

    piece: int
    duration_s: Fraction | None
    end_knot: str | None
    approach: bool = False
    settled: bool = False
    waiting: bool = False
    place_m: tuple[float, float] | None = None
    to_top: bool = False
    cruise: bool = False


@dataclass(frozen=True, slots=True)
class Division:
    """How one hero's motion is divided, in one style.

    Attributes
    ----------
    limits
        Those of the hero.
    conditions
        The scene's linear conditions (see `solve.arrival.linear_conditions`).
    """

    program: Program
    structure: Structure
    limits: Limits
    situation: Situation
    style: Style
    conditions: tuple[LinearCondition, ...]

    def stretches(self, hero: Actor) -> list[Stretch]:
        """Return the stretches of what is left of the hero's sketch, in order."""
        state = self.situation.heroes.get(hero.id)
        sketch = hero.sketch
        first = state.piece if state else 0
        trigger = self.structure.trigger_knot(hero.id)
        trigger_index = sketch.knots.index(trigger) if trigger in sketch.knots else 0
        found: list[Stretch] = []
        for piece in range(first, len(sketch.pieces)):
            knot = sketch.knots[piece + 1]
            approach = piece < trigger_index and sketch.pieces[piece] is PieceKind.GO
            planned = self.situation.trigger_s.get(hero.id)
            if approach and piece + 1 == trigger_index and piece == first and planned is not None:
                speed_mps = state.speed_mps if state else 0.0
                found += timed_approach(self.style, piece, pin(planned) - pin(self.situation.time_s), knot, speed_mps)
            elif approach:
                found += [Stretch(piece, None, None, True), Stretch(piece, None, knot, True, True)]
            elif sketch.pieces[piece] is PieceKind.ACC and self._cruises(hero, piece):
                found += [Stretch(piece, None, None, to_top=True), Stretch(piece, None, knot, cruise=True)]
            else:
                found.append(Stretch(piece, None, knot))
        return found

    def _cruises(self, hero: Actor, piece: int) -> bool:
        """Whether an accelerating piece is long enough to get to the top speed and drive on at it.

        Nobody speeds up for ever; and with the speed at its end known the problem stays easy.
        """
        knots = hero.sketch.knots
        end = self._place_of(hero, knots[piece + 1])
        begin = next(
            (place for k in range(piece, 0, -1) if (place := self._place_of(hero, knots[k])) is not None), None
        )
        if end is None or begin is None or rate_is_given(self.program, hero, piece):
            return False
        top = min(self.style.top_speeds_mps(self.limits))
        start_mps = 0.0 if piece and hero.sketch.pieces[piece - 1] is PieceKind.STOP else self.style.trigger_speed_mps
        return (top * top - start_mps * start_mps) / (2 * self.style.acc_mpss[1]) < end - begin

    def _place_of(self, hero: Actor, knot: str) -> float | None:
        """Return where the program puts `hero` at `knot`: exactly, or for a time to arrival at walking pace."""
        for condition in self.conditions:
            if set(condition.weights) != {hero.id} or condition.weights[hero.id][0] == 0.0:
                continue
            if any(self.structure.same_moment(hero.id, key) == knot for key in condition.moments):
                per_metre, per_speed = condition.weights[hero.id]
                return -(condition.constant + per_speed * _WALKING_MPS) / per_metre
        return None


def timed_approach(style: Style, piece: int, rest_s: Fraction, knot: str, speed_mps: float = 0.0) -> list[Stretch]:
    """Divide the time that is left before the trigger into steps, the last one settled where that is asked for.

    Parameters
    ----------
    speed_mps
        Of the hero now: the first step leaves it the time to come to a stand and no more.
    """
    stops_s = pin(speed_mps / style.approach_brake_mpss) if style.approach_brake_mpss else Fraction(0)
    if style.wait is not None and rest_s > pin(style.wait.shortest_s):
        return _waiting_approach(style.wait, pin(style.settle_s), piece, rest_s, knot)
    steps, settle = style.steps, style.settle
    if rest_s <= 0:
        return []
    if steps == 1 or rest_s < Fraction(1, 5):
        return [Stretch(piece, rest_s, knot, True, settle)]
    if not settle:
        return _divided(piece, rest_s, steps, knot, stops_s)
    settle_s = pin(style.settle_s)
    if rest_s <= settle_s * Fraction(11, 10):
        return [Stretch(piece, rest_s, knot, True, True)]
    hold_s = max(settle_s, rest_s * Fraction(2, 5)) if steps == 2 else settle_s
    return [*_divided(piece, rest_s - hold_s, steps - 1, None, stops_s), Stretch(piece, hold_s, knot, True, True)]


def _waiting_approach(wait: Wait, settle_s: Fraction, piece: int, rest_s: Fraction, knot: str) -> list[Stretch]:
    """Divide the way of one that waits: up to its place, standing there, and off in time."""
    way_s = [pin(duration_s) for duration_s in (wait.speed_up_s, wait.hold_s, wait.brake_s)]
    go_s = pin(wait.go_s)
    stand_s = rest_s - go_s - sum(way_s)
    found = [Stretch(piece, duration_s, None, True) for duration_s in way_s if duration_s]
    if found:
        found[-1] = replace(found[-1], waiting=True, place_m=(wait.place_m - wait.room_m, wait.place_m + wait.room_m))
    found.append(Stretch(piece, stand_s, None, True, waiting=True))
    if go_s <= settle_s:
        return [*found, Stretch(piece, go_s, knot, True, True)]
    return [*found, *_even(piece, go_s - settle_s, 2, None), Stretch(piece, settle_s, knot, True, True)]


def following_piece(hero: Actor, piece: int) -> PieceKind:
    """Return what the hero does after a piece of its sketch; it drives on after the last."""
    pieces = hero.sketch.pieces
    return pieces[piece + 1] if piece + 1 < len(pieces) else PieceKind.GO


def approach_rates(style: Style, stretch: Stretch, following: PieceKind) -> tuple[Fraction, Fraction]:
    """Return how hard (m/s^2) the hero may speed up and brake in a stretch on the way to its trigger.

    Before its trigger it settles. The gentlest shapes hold their speed; the others do not begin early what `following`
    is to begin, and do the opposite no harder than the style says: who is about to brake may still speed up.
    """
    up, down = pin(style.approach_accel_mpss), pin(style.approach_brake_mpss)
    if not stretch.settled:
        return up, down
    if style.steps <= 2:
        return (up, down) if style.approach_accel_mpss == COASTING.approach_accel_mpss else (Fraction(0), Fraction(0))
    early, counter = pin(style.early_mpss), pin(style.counter_mpss)
    if following is PieceKind.DEC:
        return min(up, counter), min(down, early)
    if following is PieceKind.ACC:
        return min(up, early), min(down, counter)
    return min(up, early), min(down, early)


def shortest_s(
    style: Style, hero: Actor, piece: int, trigger_knot: str | None, side: LinearCondition | None
) -> Fraction:
    """Return how long a piece must last at least: long enough to be seen where it is what was asked for.

    Parameters
    ----------
    side
        The hero's side of its trigger, if it has one of its own.
    """
    if hero.sketch.pieces[piece] not in (PieceKind.DEC, PieceKind.ACC) or not style.settle:
        return _SHORTEST_S
    if side is not None and hero.sketch.knots[piece] == trigger_knot and all(side.weights[hero.id]):
        # Who is half a second from a place and speeds up is there before that.
        away_s = pin(side.weights[hero.id][1] / side.weights[hero.id][0])
        return min(pin(style.seen_s), max(_SHORTEST_S, away_s * _OF_TIME_TO_ARRIVAL))
    return pin(style.seen_s)


def trigger_speed_mps(style: Style, hero: Actor, piece: int, timed: bool, out_of_way_mps: float = 0.0) -> float:
    """Return the smallest speed (m/s) at the trigger that ends `piece`.

    One that is to speed up may wait at its place and set off when the moment comes, unless the program times it there
    (`timed`), as a time to arrival does: then it cannot stand.
    """
    waits = following_piece(hero, piece) is PieceKind.ACC and not style.natural_speed and not timed
    return 0.0 if waits else max(style.trigger_speed_mps, out_of_way_mps if style.out_of_way else 0.0)


def _divided(piece: int, rest_s: Fraction, steps: int, knot: str | None, stops_s: Fraction) -> list[Stretch]:
    """Divide evenly, but where that takes long let the first step be a quick one: who has to stop can do it at once."""
    quick_s = min(max(stops_s, _SHORTEST_QUICK_S), _QUICK_S) if stops_s > _STANDS_S else _QUICK_S
    if steps < 3 or rest_s <= steps * quick_s:
        return _even(piece, rest_s, steps, knot)
    return [Stretch(piece, quick_s, None, True), *_even(piece, rest_s - quick_s, steps - 1, knot)]


def _even(piece: int, rest_s: Fraction, steps: int, knot: str | None) -> list[Stretch]:
    part = rest_s / steps
    return [Stretch(piece, part, knot if k == steps - 1 else None, True) for k in range(steps)]


def rate_is_given(program: Program, hero: Actor, piece: int) -> bool:
    """Whether the program gives the acceleration of a piece of the hero's sketch."""
    for constraint in program.constraints:
        for node in walk(constraint.formula):
            if not (isinstance(node, State) and node.actor == hero.id and node.order == 2):
                continue
            if not isinstance(node.at, PieceRef) or not _is_equality(constraint.formula):
                continue
            if hero.sketch.piece_index(node.at.name) == piece:
                return True
    return False


def _is_equality(formula: Formula) -> bool:
    return isinstance(formula, Compare) and formula.operator == "=="
