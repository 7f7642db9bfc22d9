"""Which cause a missed run has: one, and that from evidence.

What enters: a world, what was driven in it, how it was judged, the proof against the ego's drive if there is one, and a
hero that was in its way. What leaves: a `Cause`. It changes no verdict.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from scenewright.explain.evidence import (
    Finding,
    came_too_late,
    foreseen_otherwise,
    last_good,
    limit_reached,
    orders_with_ego,
    settled_limit_reached,
)
from scenewright.explain.in_way import InWay
from scenewright.judge.tolerance import TIGHT, Tolerance
from scenewright.judge.verdict import Cause, CauseKind, Condition, Verdict
from scenewright.plan.clearance import Clearance
from scenewright.plan.planner import Replan
from scenewright.program.printer import print_expression
from scenewright.program.structure import Role, actors_of, knots_of
from scenewright.program.types import EGO, Actor, Constraint
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.feasibility import Feasibility
from scenewright.solve.tolerances import compared_dimension
from scenewright.units import SI_SYMBOL


def cause_of(
    world: World, run: Run, verdict: Verdict, tolerance: Tolerance, proof: Feasibility | None, in_way: InWay | None
) -> Cause:
    """Return why a run missed at `tolerance`.

    The first of these that the evidence shows:

    1. what failed was the ego's: it never came to its side of the trigger, no hero could have done it against its drive
       (`proof`), or a condition on it alone failed. Where it slowed down for a hero in its way, that is the cause.
    2. all was well but who came first: *order*.
    3. from the last plan on that would have done, a hero was at a limit of its motion: *authority*.
    4. the ego did not drive as that plan foresaw: *prediction*.
    5. a hero did as much as it may while it is to be settled: *authority*, too.
    6. none of these: the *plan* itself.
    """
    missed = [condition for condition in verdict.conditions if not condition.holds_at(tolerance)]
    asked = {constraint.id: constraint for constraint in world.scene.program.constraints}
    failed = [asked[condition.id] for condition in missed if condition.id in asked]
    ego = _ego_did(world, verdict, missed, failed, proof)
    hit = any(condition.id == "no_collision" for condition in missed)
    if in_way is not None and (ego is not None or hit):
        return Cause("way", f"{in_way}.", in_way.evidence())
    if ego is not None:
        return _cause("ego", ego)
    late = [came_too_late(world, run, verdict, constraint) for constraint in failed if orders_with_ego(constraint)]
    if late and len(late) == len(missed) and late[0] is not None:
        return _cause("order", late[0])
    hero = _hero(world, failed)
    trigger_s = verdict.facts["trigger_time_s"].get(hero.name) or run.trace.duration_s
    # What is asked of both after the trigger is missed by how the ego then drives; all else by what came to be at it.
    later = len(failed) == len(missed) and all(world.structure.roles[each.id] is Role.OUTCOME for each in failed)
    until_s = max(run.last_plan.profiles[hero.id].knot_times_s.values()) if later else trigger_s
    good = last_good(run, until_s)
    otherwise = good and foreseen_otherwise(world, run, good, hero, until_s, at_trigger=not later)
    if otherwise is not None and in_way is not None and not _leads(world, in_way.hero):
        return Cause("way", f"{in_way}.", in_way.evidence())
    limit = limit_reached(world, run, hero, good.time_s if good else 0.0, until_s)
    if limit is not None and otherwise is not None:
        both = Finding(f"{limit.text}. {otherwise.text}", {**otherwise.evidence, **limit.evidence})
        return _cause("authority", both)
    if limit is not None:
        return _cause("authority", limit)
    if otherwise is not None:
        return _cause("prediction", otherwise)
    settled = settled_limit_reached(world, run, hero, until_s)
    return _planned_so(run, hero, until_s, good) if settled is None else _cause("authority", settled)


def _leads(world: World, name: str) -> bool:
    """Whether the program has a hero drive ahead of the ego on its lane."""
    hero = next(hero for hero in world.scene.program.heroes if hero.name == name)
    clearance = Clearance.of(world.scene, world.structure, linear_conditions(world.scene, world.structure), hero)
    return clearance is not None and clearance.ahead


def _cause(kind: CauseKind, found: Finding) -> Cause:
    return Cause(kind, f"{found.text}.", found.evidence)


def _ego_did(
    world: World, verdict: Verdict, missed: Sequence[Condition], failed: Sequence[Constraint], proof: Feasibility | None
) -> Finding | None:
    """Return what the ego did that no hero could have mended."""
    program = world.scene.program
    ids = {print_expression(constraint.formula): constraint.id for constraint in program.constraints}
    for side in verdict.facts["closest"]:
        if side["who"] == "ego" and not side["met"]:
            off, unit = side["error"], side["unit"]
            near = (
                ""
                if off is None
                else f": it came no nearer than {off:.2f} {unit}".rstrip() + f", at {side['time_s']:.1f} s"
            )
            return Finding(
                f"The ego never came to its side of the trigger ({side['side']}){near}; no hero can make it",
                {"condition": ids.get(side["side"]), "off": off, "unit": unit, "time_s": side["time_s"]},
            )
    at_triggers = {key for instant in world.structure.triggers.values() for key in instant}
    for constraint in failed:
        alone = actors_of(constraint.formula) == {EGO} and not set(knots_of(constraint.formula)) & at_triggers
        if alone and world.structure.roles[constraint.id] is not Role.INITIAL:
            condition = next(each for each in missed if each.id == constraint.id)
            return _ego_alone(condition, program.words_of(constraint), constraint)
    if proof is None:
        return None
    told = "; ".join(clash.formula or clash.id for clash in proof.clashes)
    return Finding(
        "The ego left no room: against the way it drove no hero within the laws of motion could have met all conditions. "
        f"These clash: {told}",
        {"clashes": [str(clash) for clash in proof.clashes], "trigger_s": dict(verdict.facts["trigger_time_s"])},
    )


def _ego_alone(condition: Condition, words: str | None, constraint: Constraint) -> Finding:
    dimension = compared_dimension(constraint.formula)
    off = condition.normalised_error(TIGHT) * TIGHT.of(dimension)
    known = condition.miss is not None and math.isfinite(off)
    by = f": it was off by {off:.2f} {SI_SYMBOL[dimension]}" if known else ""
    was = "" if condition.measured is None else f", {condition.measured:.2f} {condition.unit} instead".rstrip()
    return Finding(
        f"The ego alone decides on what was missed ({words or print_expression(constraint.formula)}){by}{was}; no hero "
        "controls that",
        {
            "condition": condition.id, "required": condition.required, "measured": condition.measured,
            "off": off if known else None, "unit": SI_SYMBOL[dimension],
        },
    )  # fmt: skip


def _hero(world: World, failed: Sequence[Constraint]) -> Actor:
    """Return the hero that what failed speaks of, else the first."""
    heroes = world.scene.program.heroes
    spoken_of = set().union(*(actors_of(constraint.formula) for constraint in failed)) if failed else set()
    return next((hero for hero in heroes if hero.id in spoken_of), next(iter(heroes)))


def _planned_so(run: Run, hero: Actor, until_s: float, good: Replan | None) -> Cause:
    """Return what is left: it was planned so, though nothing stood against it."""
    ticks = [tick for tick in run.replans if tick.foreseen is not None and tick.time_s < until_s]
    evidence: dict[str, Any] = {"hero": hero.name}
    if good is not None and ticks[-1] is good:
        text = f"The plan of {good.time_s:.1f} s was to do all that was asked and the ego drove as it foresaw, but it missed"
    else:
        text = f"No plan did all that was asked of {hero.name}, though it was at no limit of its motion"
    if ticks:
        text += f"; the last plan, of {ticks[-1].time_s:.1f} s, missed {ticks[-1].tolerance:.1f} tight tolerances"
        evidence |= {"time_s": ticks[-1].time_s, "missed": ticks[-1].tolerance}
    return Cause("plan", f"{text}.", evidence)
