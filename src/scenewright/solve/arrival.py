"""When motions meet a condition: the instant at which the ego, as predicted, is where a trigger wants it.

What enters: equalities that speak of actors' states at one moment. What leaves: conditions that are linear in
positions and speeds, and when given motions meet them first.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from scenewright.algebra.polynomials import ZERO, Polynomial, atoms
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile
from scenewright.program.expressions import Compare
from scenewright.program.structure import KnotKey, Structure, knots_of
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.forms import TIGHT
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.order import least_differences, tightened

HORIZON_S = 90.0
_ANYBODY = Limits(60.0, 60.0, 60.0, 60.0, 60.0, 60.0)
TIGHT_LENGTH_M = float(TIGHT["length"])
TIGHT_TIME_S = float(TIGHT["time"])


@dataclass(frozen=True, slots=True)
class LinearCondition:
    """``constant + sum of per_metre * position + per_speed * speed == 0`` over some actors, at one moment.

    `moments` are the knots that the constraint speaks of; `weights` are ``(per_metre, per_speed)`` by actor id.
    """

    constraint_id: str
    moments: frozenset[KnotKey]
    constant: float
    weights: Mapping[int, tuple[float, float]]

    def value(self, states: Mapping[int, Sequence[float]]) -> float:
        """Return the left side, given position, speed and so on of every actor in it."""
        return self._sum(self.constant, states)

    def _sum(self, total: float, values: Mapping[int, Sequence[float]]) -> float:
        for actor, (per_metre, per_speed) in self.weights.items():
            total += per_metre * values[actor][0] + per_speed * values[actor][1]
        return total

    def place_m(self, actor: int, speed_mps: float) -> float:
        """Return where `actor`, which it is about alone, is to be at a speed."""
        per_metre, per_speed = self.weights[actor]
        return -(self.constant + per_speed * speed_mps) / per_metre

    def first_time(self, profiles: Mapping[int, Profile], after_s: float) -> float | None:
        """Return the first instant from `after_s` on at which the motions meet the condition.

        None where that is not before the horizon, after the last of them ends.
        """
        motions = {actor: profiles[actor] for actor in self.weights}
        changes = {t for p in motions.values() for s in p.segments for t in (s.start_s, s.end_s) if t > after_s}
        breaks = [after_s, *sorted(changes)]
        for begin, end in pairwise([*breaks, breaks[-1] + HORIZON_S]):
            # At the break itself rounding may still tell the acceleration that ends there; in the middle is no doubt.
            middle = 0.5 * (begin + end)
            states = {a: (*motion.state(begin)[:2], motion.state(middle)[2]) for a, motion in motions.items()}
            elapsed = self._root(end - begin, states)
            if elapsed is not None:
                return begin + elapsed
        return None

    def _root(self, duration_s: float, states: Mapping[int, tuple[float, float, float]]) -> float | None:
        """Return when it is met first from given states on, within a time in which nobody's acceleration changes."""
        c, b = self.value(states), self._sum(0.0, {actor: state[1:] for actor, state in states.items()})
        a = 0.5 * self._sum(0.0, {actor: (state[2], 0.0) for actor, state in states.items()})
        if abs(c) < 1e-9:
            return 0.0
        if abs(a) < 1e-12:
            roots = [-c / b] if abs(b) > 1e-12 else []
        else:
            inside = b * b - 4 * a * c
            if inside < 0:
                return None
            q = -0.5 * (b + math.copysign(math.sqrt(inside), b))
            roots = [q / a] + ([c / q] if q else [])
        fitting = [root for root in roots if -1e-9 <= root <= duration_s + 1e-9]
        return max(0.0, min(fitting)) if fitting else None


def linear_conditions(scene: Scene, structure: Structure, *, with_bounds: bool = False) -> tuple[LinearCondition, ...]:
    """Return the program's equalities over states at one moment that are linear in positions and speeds.

    Of a bound, where these are asked for too, it is where it begins to hold.
    """
    lowering, start = _lowering(scene), frozenset(structure.starts.items())
    found: list[LinearCondition] = []
    for constraint in scene.program.constraints:
        formula = constraint.formula
        if not isinstance(formula, Compare) or not (with_bounds or formula.operator == "=="):
            continue
        moments = frozenset(knots_of(formula))
        if not moments or not (
            len(moments) == 1 or any(moments <= instant for instant in (start, *structure.instants))
        ):
            continue
        (lowered,) = lowering.lower((replace(constraint, formula=replace(formula, operator="==")),))
        equality = next((atom.left for atom in atoms(lowered.formula) if atom.relation == "=="), Polynomial({}))
        if weights := _weights(lowering.events, equality):
            constant = float(equality.terms.get((), ZERO))
            found.append(LinearCondition(constraint.id, moments, constant, weights))
    return tuple(found)


def _lowering(scene: Scene) -> Lowering:
    return Lowering(Events(scene, {actor.id: _ANYBODY for actor in scene.program.actors}, EgoBounds()))


def of_ego(conditions: Iterable[LinearCondition], structure: Structure) -> Iterator[LinearCondition]:
    """Yield the conditions on the ego alone, and those that are where the program places all others at that moment.

    Each is of the ego's own knots at that moment where it has any.
    """
    conditions = tuple(conditions)
    instants = (frozenset(structure.starts.items()), *structure.instants)
    moment_of = {key: instant for instant in instants for key in instant}

    def moment(condition: LinearCondition) -> frozenset[KnotKey]:
        return frozenset(key for own in condition.moments for key in moment_of.get(own, {own}))

    for condition in conditions:
        alone = condition
        for placed in conditions:
            actor = next(iter(placed.weights))
            told = len(placed.weights) == 1 and not placed.weights[actor][1] and moment(placed) == moment(condition)
            if told and actor != EGO and alone.weights.get(actor, (0.0, 1.0))[1] == 0.0:
                constant = alone.constant + alone.weights[actor][0] * placed.place_m(actor, 0.0)
                rest = {other: weight for other, weight in alone.weights.items() if other != actor}
                alone = replace(alone, constant=constant, weights=rest)
        if set(alone.weights) == {EGO}:
            own = frozenset(key for key in moment(condition) if key[0] == EGO)
            yield replace(alone, moments=own or alone.moments)


def knot_between_s(scene: Scene, key: KnotKey) -> tuple[float, float]:
    """Return how long after the start a knot comes at least, and at most, as far as times are told."""
    lowering = _lowering(scene)
    events = lowering.events
    formulas = [each.formula for each in lowering.lower(scene.program.constraints)]
    least, begins, knot = least_differences(events, formulas), events.start, events.knot(*key)
    return float(least[begins, knot]), -float(least[knot, begins])


def ego_begins_between(scene: Scene) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return between which places (m) the ego begins, and how fast at least and at most, as far as bounds tell."""
    lowering = _lowering(scene)
    events = lowering.events
    state = events.state(EGO, events.start)
    formulas = [each.formula for each in lowering.lower(scene.program.constraints)]
    ranges = tightened(events.unknowns, formulas)
    place, speed = (ranges[each.number] for each in (state.place, state.speed))
    laws = [each.law for each in lowering.narrowings if each.actor == EGO and each.begins() == (events.start,)]
    least, most = [speed.low, *(law.speed_low for law in laws)], [speed.high, *(law.speed_high for law in laws)]
    return (float(place.low), float(place.high)), (float(max(least)), float(min(most)))


def _weights(events: Events, left: Polynomial) -> dict[int, tuple[float, float]]:
    """Return what a polynomial weighs each actor's position and speed with; nothing where it is not linear in them."""
    weights, rest = dict[int, tuple[float, float]](), left.terms.keys() - {()}
    for (actor, _), state in events.states.items():
        parts = state.place.terms.keys() & rest, state.speed.terms.keys() & rest
        if any(parts):
            rest -= parts[0] | parts[1]
            per_metre, per_speed = (float(sum(left.terms[key] for key in part)) for part in parts)
            weights[actor] = per_metre, per_speed
    return {} if rest else weights


def tight_of(condition: LinearCondition, speed_mps: float) -> float:
    """Return one tight tolerance in the condition's own terms: a time to arrival is multiplied by the speed in them."""
    per_metre, per_speed = condition.weights[EGO]
    return TIGHT_TIME_S * max(speed_mps, 0.05) if per_speed else TIGHT_LENGTH_M * abs(per_metre)
