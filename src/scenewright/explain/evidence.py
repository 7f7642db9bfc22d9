"""What a missed run shows: how far the ego was off what was foreseen, which limits a hero reached, who came too late.

What enters: a world, what was driven in it, and how it was judged. What leaves: findings, each with its numbers and its
words, or None. Which of them is the cause is decided in `cause`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.motion.limits import Limits
from scenewright.plan.planner import GOOD, Replan
from scenewright.program.expressions import Compare, Elapsed
from scenewright.program.types import EGO, Actor, Constraint
from scenewright.roads.routes import Route
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.trace.model import ActorTrace
from scenewright.translate.lines import in_words, told_constraints
from scenewright.translate.phrases import called

# Plans keep a few percent of room to limits (`plan.asked`, `solve.limits.ROOM`): from here on one is made use of.
_REACHED = 0.9
_LOOKED_AT_S, _ON_STEP_M = 0.1, 0.5


@dataclass(frozen=True, slots=True)
class Finding:
    """What was found: its words and its numbers."""

    text: str
    evidence: Mapping[str, Any]


# -- the ego --------------------------------------------------------------------------------------------------------
def ego_never_there(world: World, verdict: Verdict) -> Finding | None:
    """Return how near the ego came to its side of the trigger, where it never came to all of it at once."""
    program = world.scene.program
    told = told_constraints(program)
    asked = {told[constraint.id]: constraint for constraint in program.constraints}
    for side in verdict.facts["closest"]:
        if side["who"] == "ego" and not side["met"]:
            constraint = asked.get(side["side"])
            words = in_words(program, constraint) if constraint else side["side"]
            off = None if side["error"] is None else f"off by {side['error']:.2f} {side['unit']}".rstrip()
            return _never(words, off, side["time_s"], {"condition": constraint and constraint.id, "off": side["error"]})
    return None


def _never(words: str, off: str | None, time_s: float | None, evidence: Mapping[str, Any]) -> Finding:
    near = "" if off is None or time_s is None else f": it was nearest at {time_s:.1f} s, {off}"
    return Finding(
        f'the ego never came to its side of the trigger ("{words}"){near}',
        {**evidence, "time_s": time_s, "proof": [f"{words}{near}"]},
    )


def crashed_between_triggers(verdict: Verdict, heroes: Mapping[str, Actor]) -> Finding | None:
    """Return how the ego crashed with a hero whose trigger had come, before that of another; None where it did not."""
    hit, held = verdict.aftermath.collision, verdict.condition("no_collision").holds_at(LOOSE)
    name = next((actor for actor in hit.actors if actor in heroes), None) if hit is not None and not held else None
    if hit is None or name is None or not verdict.facts["trigger_came"].get(name):
        return None
    came_s = verdict.facts["trigger_time_s"][name]
    if hit.time_s < came_s:
        return None
    words = f"{hit.in_words()}, {hit.time_s - came_s:.1f} s after the trigger of {called(name)}"
    return Finding(
        f"{words}: what was to come at a later trigger is of no account then",
        {"hero": name, "time_s": hit.time_s, "trigger_s": came_s, "proof": [words]},
    )


# -- prediction -----------------------------------------------------------------------------------------------------
def last_good(run: Run, until_s: float) -> Replan | None:
    """Return the last plan before `until_s` that did what was asked, with the ego as it was foreseen."""
    good = [tick for tick in run.replans if tick.foreseen and tick.time_s < until_s and tick.tolerance <= GOOD]
    return good[-1] if good else None


def foreseen_otherwise(
    world: World, run: Run, tick: Replan, until_s: float, hero: Actor, *, at_trigger: bool
) -> Finding | None:
    """Return by how much the ego was off what the plan of `tick` foresaw; None for no more than the tight tolerance.

    What counts is the instant `until_s`; with `at_trigger` that is when the trigger of `hero` was acted upon, and what
    counts is the instant at which it was to come by that plan, and when that is.
    """
    ego, foreseen = run.trace.actors[world.scene.program.ego.name], tick.foreseen
    assert foreseen is not None
    knot = next((knot for actor, knot in world.structure.triggers.get(hero.id, ()) if actor == EGO), "")
    planned_s = foreseen.knot_times_s.get(knot, until_s) if at_trigger else until_s
    off_s, then_s = until_s - planned_s, min(planned_s, run.trace.duration_s)
    seen_m, seen_mps, _ = foreseen.state(then_s)
    drove_m, drove_mps = ego.position(then_s), ego.speed(then_s)
    off_m, off_mps = drove_m - seen_m, drove_mps - seen_mps
    if not _is_off((seen_m, seen_mps, 0.0), ego, then_s) and (planned_s > then_s or abs(off_s) <= TIGHT.time_s):
        return None
    times = np.arange(tick.time_s, then_s + 1e-9, _LOOKED_AT_S)
    left = (t for t in times.tolist() if _is_off(foreseen.state(t), ego, t))
    since_s = next(left, then_s)
    acted = f", and {called(hero.name)} acted {abs(off_s):.1f} s {'later' if off_s > 0 else 'sooner'}"
    never = f", and {called(hero.name)} had yet to act {off_s:.1f} s later, when the run ended"
    if off_s < 0.0:
        never = f", and the run ended {-off_s:.1f} s before {called(hero.name)} was to act"
    came = "" if abs(off_s) <= TIGHT.time_s else acted if until_s < run.trace.duration_s else never
    text = (
        f"the ego did not drive as foreseen: at {then_s:.1f} s it was {abs(off_m):.1f} m further "
        f"{'on' if off_m > 0 else 'back'} and {abs(off_mps):.1f} m/s {'faster' if off_mps > 0 else 'slower'} than in "
        f"the plan of {tick.time_s:.1f} s, which would have done{came}; it was off from {since_s:.1f} s on"
    )
    return Finding(
        text,
        {
            "planned_s": tick.time_s, "off_s": off_s, "time_s": then_s, "since_s": since_s,
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

    It counts where the hero was at limits for most of a piece, or of what of it lies between the two: whoever is
    within them for longer could have done more. What lasts less than a tick is not answered by anybody.
    """
    states, limits, route = run.trace.actors[hero.name], world.limits[hero.id], world.scene.routes[hero.id]
    bends = np.abs(route.path.curvatures(states.s_m))
    reached = {
        "braking": (-states.accel_mps2, limits.brake_max_mpss, "m/s^2"),
        "acceleration": (states.accel_mps2, limits.accel_max_mpss, "m/s^2"),
        "speed": (states.speed_mps, limits.speed_max_mps, "m/s"),
        "lateral acceleration in the bend": (states.speed_mps**2 * bends, limits.lateral_max_mpss, "m/s^2"),
    }
    within = (states.time_s >= from_s) & (states.time_s <= to_s)
    at_limit = {name: values >= _REACHED * most for name, (values, most, _) in reached.items()}
    knots_s = np.sort([*run.last_plan.profiles[hero.id].knot_times_s.values()])
    piece = np.where(within, np.searchsorted(knots_s, states.time_s, side="right"), -1)
    limited = np.any([*at_limit.values()], axis=0)
    most_of = [each for each in set(piece[within].tolist()) if limited[piece == each].mean() > 0.5]
    found = {name: np.flatnonzero(np.isin(piece, most_of) & there) for name, there in at_limit.items()}
    name = max(found, key=lambda name: len(found[name]))
    for_s = len(found[name]) * world.rates.step_s
    if for_s < (world.rates.replan_s or world.rates.step_s):
        return None
    values, most, unit = reached[name]
    worst = int(found[name][np.argmax(values[found[name]])])
    at_s = float(states.time_s[worst])
    text = (
        f"{called(hero.name)} could do no more: at {at_s:.1f} s it was at the limit of its {name} ({most:.3g} {unit})"
    )
    evidence = {"hero": hero.name, "limit": name, "most": most, "unit": unit, "time_s": at_s, "for_s": for_s}
    return Finding(text, {**evidence, "reached": float(values[worst])})


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
    states, trigger_s = run.trace.actors[hero.name], verdict.facts["trigger_time_s"].get(hero.name)
    safe_s, late = None, "never came"
    if hero_s is not None:
        safe_s = _latest_safe_s(world, hero.id, states, states.position(hero_s), ego_s)
        came = "" if trigger_s is None else f"its trigger came at {trigger_s:.1f} s, and "
        until = "never have been first" if safe_s is None else f"have been first until {safe_s:.1f} s"
        late = f"came {hero_s - ego_s:.1f} s after the ego: {came}at full acceleration it could {until}"
    words = in_words(program, constraint)
    return Finding(
        f'{called(hero.name)} was to be first ("{words}") and {late}',
        {
            "hero": hero.name, "hero_s": hero_s, "ego_s": ego_s, "late_s": None if hero_s is None else hero_s - ego_s,
            "latest_safe_s": safe_s, "trigger_s": trigger_s,
        },
    )  # fmt: skip


def _finite(value: Any) -> float | None:
    return float(value) if value is not None and np.isfinite(value) else None


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
    bends = np.maximum(np.abs(route.path.curvatures(places)), 1e-6)
    cap = np.minimum(limits.lateral_max_mpss / bends, limits.speed_max_mps**2)  # of the square of the speed
    braking = 2.0 * limits.brake_max_mpss * step_m * np.arange(len(places))
    cap = np.minimum.accumulate((cap + braking)[::-1])[::-1] - braking
    squared = np.empty(len(places))
    squared[0] = speed_mps**2
    for k in range(1, len(places)):
        squared[k] = min(cap[k], squared[k - 1] + 2.0 * limits.accel_max_mpss * step_m)
    speeds = np.sqrt(squared)
    return float(np.sum(2.0 * step_m / (speeds[1:] + speeds[:-1])))
