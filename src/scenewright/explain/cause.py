"""Which cause a missed run has: one, and that from evidence.

What enters: a world, what was driven in it, how it was judged, the proof against the ego's drive if there is one, and a
hero that was in its way. What leaves: a `Cause`. It changes no verdict.
"""

from __future__ import annotations

from collections.abc import Sequence

from scenewright.explain.evidence import (
    Finding,
    came_too_late,
    foreseen_otherwise,
    last_good,
    limit_reached,
    orders_with_ego,
)
from scenewright.explain.in_way import InWay
from scenewright.judge.tolerance import Tolerance
from scenewright.judge.verdict import Cause, CauseKind, Condition, Verdict
from scenewright.program.printer import print_expression
from scenewright.program.structure import Role, actors_of, knots_of
from scenewright.program.types import EGO, Actor, Constraint
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.solve.feasibility import Feasibility


def cause_of(
    world: World, run: Run, verdict: Verdict, tolerance: Tolerance, proof: Feasibility | None, in_way: InWay | None
) -> Cause:
    """Return why a run missed at `tolerance`.

    The first of these that the evidence shows:

    1. what failed was the ego's: it never came to its side of the trigger, no hero could have done it against its drive
       (`proof`), or a condition on it alone failed. Where it slowed down for a hero in its way, that is the cause.
    2. all was well but who came first: *order*.
    3. there was a plan that would have done, and the ego did not drive as it foresaw: *prediction*.
    4. a hero was at one of its limits: *authority*.
    5. none of these: the *plan* itself.
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
    late_only = all(world.structure.roles[each.id] not in (Role.INITIAL, Role.TRIGGER) for each in failed)
    until_s = max(run.last_plan.profiles[hero.id].knot_times_s.values()) if late_only else trigger_s
    good = last_good(run, until_s)
    otherwise = good and foreseen_otherwise(world, run, good, hero, until_s if late_only else None)
    if otherwise is not None:
        if in_way is not None:
            return Cause("way", f"{in_way}.", in_way.evidence())
        return _cause("prediction", otherwise)
    limit = limit_reached(world, run, hero, good.time_s if good else 0.0, until_s)
    if limit is not None:
        return _cause("authority", limit)
    return _planned_so(run, hero, until_s)


def _cause(kind: CauseKind, found: Finding) -> Cause:
    return Cause(kind, f"{found.text}.", found.evidence)


def _ego_did(
    world: World, verdict: Verdict, missed: Sequence[Condition], failed: Sequence[Constraint], proof: Feasibility | None
) -> Finding | None:
    """Return what the ego did that no hero could have mended."""
    for side in verdict.facts["closest"]:
        if side["who"] == "ego" and not side["met"]:
            near = "" if side["error"] is None else (
                f": it came no nearer than {side['error']:.2f} {side['unit']}".rstrip() + f", at {side['time_s']:.1f} s"
            )  # fmt: skip
            return Finding(
                f"The ego never came to its side of the trigger ({side['side']}){near}; no hero can make it",
                {"condition": side["side"], "off": side["error"], "unit": side["unit"], "time_s": side["time_s"]},
            )
    at_triggers = {key for instant in world.structure.triggers.values() for key in instant}
    for constraint in failed:
        alone = actors_of(constraint.formula) == {EGO} and not set(knots_of(constraint.formula)) & at_triggers
        if alone and world.structure.roles[constraint.id] is not Role.INITIAL:
            condition = next(each for each in missed if each.id == constraint.id)
            words = world.scene.program.words_of(constraint) or print_expression(constraint.formula)
            unit = f" {condition.unit}" if condition.unit else ""
            was = "" if condition.measured is None else f": it was {condition.measured:.2f}{unit}"
            return Finding(
                f"The ego alone decides on what was missed ({words}){was}; no hero controls that",
                {
                    "condition": constraint.id,
                    "required": condition.required,
                    "measured": condition.measured,
                    "unit": condition.unit,
                },
            )
    if proof is None:
        return None
    clashes = [str(clash) for clash in proof.clashes]
    told = "; ".join(clash.formula or clash.id for clash in proof.clashes)
    return Finding(
        "The ego left no room: against the way it drove no hero within the laws of motion could have met all conditions. "
        f"These clash: {told}",
        {"clashes": clashes, "trigger_s": dict(verdict.facts["trigger_time_s"])},
    )


def _hero(world: World, failed: Sequence[Constraint]) -> Actor:
    """Return the hero that what failed speaks of, else the first."""
    heroes = world.scene.program.heroes
    spoken_of = set().union(*(actors_of(constraint.formula) for constraint in failed)) if failed else set()
    return next((hero for hero in heroes if hero.id in spoken_of), next(iter(heroes)))


def _planned_so(run: Run, hero: Actor, until_s: float) -> Cause:
    planned = [tick for tick in run.replans if tick.foreseen is not None and tick.time_s < until_s]
    last = planned[-1] if planned else None
    missed = "" if last is None else f"; the last plan, of {last.time_s:.1f} s, missed {last.tolerance:.1f} tight tolerances"
    text = f"No plan did all that was asked of {hero.name}, though it reached no limit and the ego drove as foreseen{missed}"
    evidence = {"hero": hero.name} | ({} if last is None else {"time_s": last.time_s, "missed": last.tolerance})
    return Cause("plan", f"{text}.", evidence)
