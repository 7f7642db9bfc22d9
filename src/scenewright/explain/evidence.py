"""What a missed run shows: how far the ego was off what was foreseen, which limits a hero reached, who came too late.

What enters: a world, what was driven in it, and how it was judged. What leaves: findings, each with its numbers and its
words, or None. Which of them is the cause is decided in `cause`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from scenewright.judge.tolerance import TIGHT, FloatArray
from scenewright.judge.verdict import Verdict
from scenewright.plan.planner import GOOD, Replan
from scenewright.program.expressions import Compare, Elapsed
from scenewright.program.printer import print_expression
from scenewright.program.types import EGO, Actor, Constraint, PieceKind
from scenewright.roads.routes import Route
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.limits import Limits, calm_mpss
from scenewright.trace.model import ActorTrace

# Plans keep a few percent of room to limits (`plan.asked`, `solve.limits.ROOM`): from here on one is made use of.
_REACHED = 0.9
_LOOKED_AT_S, _ON_STEP_M = 0.1, 0.5


@dataclass(frozen=True, slots=True)
class Finding:
    """What was found: its words and its numbers."""

    text: str
    evidence: Mapping[str, Any]


# -- prediction -----------------------------------------------------------------------------------------------------
def last_good(run: Run, until_s: float) -> Replan | None:
    """Return the last plan before `until_s` that did what was asked, with the ego as it was foreseen."""
    good = [tick for tick in run.replans if tick.foreseen and tick.time_s < until_s and tick.tolerance <= GOOD]
    return good[-1] if good else None


def foreseen_otherwise(
    world: World, run: Run, tick: Replan, hero: Actor, until_s: float, *, at_trigger: bool
) -> Finding | None:
    """Return by how much the ego was off what the plan of `tick` foresaw; None for no more than the tight tolerance.

    What counts is the instant `until_s`; with `at_trigger` the one at which the trigger was to come by that plan.
    """
    ego, foreseen = run.trace.actors[world.scene.program.ego.name], tick.foreseen
    assert foreseen is not None
    knot = world.structure.trigger_knot(EGO)
    if at_trigger and knot is not None:
        until_s = foreseen.knot_times_s.get(knot, until_s)
    then_s = min(until_s, run.trace.duration_s)
    seen_m, seen_mps, _ = foreseen.state(then_s)
    drove_m, drove_mps = ego.position(then_s), ego.speed(then_s)
    off_m, off_mps = drove_m - seen_m, drove_mps - seen_mps
    if not _is_off((seen_m, seen_mps, 0.0), ego, then_s):
        return None
    times = np.arange(tick.time_s, then_s + 1e-9, _LOOKED_AT_S)
    left = (t for t in times.tolist() if _is_off(foreseen.state(t), ego, t))
    since_s = next(left, then_s)
    side = "further on" if off_m > 0 else "further back"
    by = f"{abs(off_m):.1f} m {side}" + (f" and {abs(off_mps):.1f} m/s {'faster' if off_mps > 0 else 'slower'}")
    text = (
        f"The ego did not drive as foreseen: the plan of {tick.time_s:.1f} s would have done, but at {then_s:.1f} s the ego "
        f"was {by} than it foresaw; from {since_s:.1f} s on it was off by more than the tight tolerance"
    )
    return Finding(
        text,
        {
            "hero": hero.name, "planned_s": tick.time_s, "time_s": then_s, "since_s": since_s,
            "foreseen_m": seen_m, "drove_m": drove_m, "off_m": off_m,
            "foreseen_mps": seen_mps, "drove_mps": drove_mps, "off_mps": off_mps,
        },
    )  # fmt: skip


def _is_off(foreseen: tuple[float, float, float], ego: ActorTrace, time_s: float) -> bool:
    off_m, off_mps = ego.position(time_s) - foreseen[0], ego.speed(time_s) - foreseen[1]
    return abs(off_m) > TIGHT.length_m or abs(off_mps) > TIGHT.speed_mps


# -- authority ------------------------------------------------------------------------------------------------------
def limit_reached(world: World, run: Run, hero: Actor, from_s: float, to_s: float) -> Finding | None:
    """Return which limit of its motion a hero was at for the longest time between two instants; None for none.

    What lasts less than a tick is not answered by anybody, and does not count.
    """
    states, limits, route = run.trace.actors[hero.name], world.limits[hero.id], world.scene.routes[hero.id]
    bends = np.abs([route.path.curvature(float(s)) for s in states.s_m])
    reached = {
        "braking": (-states.accel_mps2, limits.brake_max_mpss, "m/s^2"),
        "acceleration": (states.accel_mps2, limits.accel_max_mpss, "m/s^2"),
        "speed": (states.speed_mps, limits.speed_max_mps, "m/s"),
        "lateral acceleration in the bend": (states.speed_mps**2 * bends, limits.lateral_max_mpss, "m/s^2"),
    }
    found = [_at_limit(hero, name, states.time_s, *each, from_s, to_s) for name, each in reached.items()]
    lasting = [each for each in found if each is not None and each.evidence["for_s"] >= (world.rates.replan_s or 0.0)]
    return max(lasting, key=lambda each: float(each.evidence["for_s"]), default=None)


def settled_limit_reached(world: World, run: Run, hero: Actor, trigger_s: float) -> Finding | None:
    """Return how hard a hero did what was to begin at its trigger while it was to be settled, where it could no more."""
    knot, manner, states = (
        world.structure.trigger_knot(hero.id),
        world.scene.program.manner,
        run.trace.actors[hero.name],
    )
    if knot is None or knot == hero.sketch.knots[-1]:
        return None
    sense = {PieceKind.ACC: 1.0, PieceKind.DEC: -1.0}.get(hero.sketch.pieces[hero.sketch.knot_index(knot)])
    if sense is None:
        return None
    name, pull, most = "manner, settled before its trigger", sense * states.accel_mps2, float(calm_mpss(manner))
    return _at_limit(
        hero, name, states.time_s, pull, most, "m/s^2", trigger_s - float(manner.settled_s), trigger_s - _LOOKED_AT_S
    )


def _at_limit(
    hero: Actor, name: str, times: FloatArray, values: FloatArray, most: float, unit: str, from_s: float, to_s: float
) -> Finding | None:
    at = np.flatnonzero((times >= from_s) & (times <= to_s) & (values >= _REACHED * most))
    if not len(at):
        return None
    worst = int(at[np.argmax(values[at])])
    for_s = float(len(at) * (times[-1] - times[0]) / max(1, len(times) - 1))
    text = (
        f"{hero.name} was at the limit of its {name} ({most:.3g} {unit}) and could do no more: it came to "
        f"{values[worst]:.2f} {unit} at {times[worst]:.1f} s"
    )
    return Finding(
        text,
        {
            "hero": hero.name, "limit": name, "most": most, "unit": unit, "reached": float(values[worst]),
            "reached_s": float(times[worst]), "from_s": float(times[at[0]]), "to_s": float(times[at[-1]]), "for_s": for_s,
        },
    )  # fmt: skip


# -- order ----------------------------------------------------------------------------------------------------------
def orders_with_ego(constraint: Constraint) -> tuple[Elapsed, Elapsed] | None:
    """Return who is to be first and who second in a constraint that compares a hero's moment with one of the ego's."""
    formula = constraint.formula
    if not isinstance(formula, Compare) or formula.operator not in ("<", "<=", ">", ">="):
        return None
    first, second = formula.left, formula.right
    if not (isinstance(first, Elapsed) and isinstance(second, Elapsed) and EGO in (first.actor, second.actor)):
        return None
    if formula.operator in (">", ">="):
        first, second = second, first
    return None if first.actor == second.actor else (first, second)


def came_too_late(world: World, run: Run, verdict: Verdict, constraint: Constraint) -> Finding | None:
    """Return by how much a hero that was to be before the ego came too late, and until when it still could have."""
    order = orders_with_ego(constraint)
    if order is None or order[0].actor == EGO:
        return None
    program, times = world.scene.program, verdict.facts["knot_times_s"]
    hero = program.actor(order[0].actor)
    hero_s, ego_s = (_finite(times[program.actor(each.actor).name].get(each.knot)) for each in order)
    if ego_s is None:
        return None
    states = run.trace.actors[hero.name]
    place_m = _place_m(world, (hero.id, order[0].knot)) if hero_s is None else states.position(hero_s)
    safe_s = None if place_m is None else _latest_safe_s(world, hero.id, states, place_m, ego_s)
    late = "never came" if hero_s is None else f"came {hero_s - ego_s:.1f} s after the ego"
    still = (
        "speeding up as hard as it can, it never could have been first" if safe_s is None
        else f"speeding up as hard as it can, it could have been first until {safe_s:.1f} s"
    )  # fmt: skip
    words = program.words_of(constraint) or print_expression(constraint.formula)
    return Finding(
        f"{hero.name} was to be first ({words}) and {late}; {still}",
        {
            "hero": hero.name, "hero_s": hero_s, "ego_s": ego_s, "late_s": None if hero_s is None else hero_s - ego_s,
            "place_m": place_m, "latest_safe_s": safe_s,
        },
    )  # fmt: skip


def _finite(value: Any) -> float | None:
    return float(value) if value is not None and np.isfinite(value) else None


def _place_m(world: World, moment: tuple[int, str]) -> float | None:
    """Return where the program says that an actor is at one of its knots."""
    for condition in linear_conditions(world.scene, world.structure):
        if condition.moments == {moment} and set(condition.weights) == {moment[0]}:
            per_metre, per_speed = condition.weights[moment[0]]
            if per_metre and not per_speed:
                return -condition.constant / per_metre
    return None


def _latest_safe_s(world: World, hero: int, states: ActorTrace, place_m: float, before_s: float) -> float | None:
    """Return until when a hero, at the limits of its motion from then on, still was at a place before an instant."""
    route, limits = world.scene.routes[hero], world.limits[hero]
    for time_s in np.arange(before_s, -1e-9, -_LOOKED_AT_S).tolist():
        if time_s + flat_out_s(route, limits, states.position(time_s), states.speed(time_s), place_m) < before_s:
            return float(time_s)
    return None


def flat_out_s(route: Route, limits: Limits, s_m: float, speed_mps: float, place_m: float) -> float:
    """Return how long it takes to a place at the limits of speed, acceleration and bends; 0 for who is past it."""
    if place_m <= s_m:
        return 0.0
    places = np.linspace(s_m, place_m, 2 + int((place_m - s_m) / _ON_STEP_M))
    step_m = float(places[1] - places[0])
    bends = np.maximum([abs(route.path.curvature(float(s))) for s in places], 1e-6)
    cap = np.minimum(limits.lateral_max_mpss / bends, limits.speed_max_mps**2)  # of the square of the speed
    braking = 2.0 * limits.brake_max_mpss * step_m * np.arange(len(places))
    cap = np.minimum.accumulate((cap + braking)[::-1])[::-1] - braking
    squared = np.empty(len(places))
    squared[0] = speed_mps**2
    for k in range(1, len(places)):
        squared[k] = min(cap[k], squared[k - 1] + 2.0 * limits.accel_max_mpss * step_m)
    speeds = np.sqrt(squared)
    return float(np.sum(2.0 * step_m / (speeds[1:] + speeds[:-1])))
