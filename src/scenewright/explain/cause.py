"""Which cause a missed run has: one, and that from evidence.

What enters: a world, what was driven in it, how it was judged, and the proof against the ego's drive if there is one.
What leaves: a `Cause`. It changes no verdict.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import asdict

from scenewright.explain.cut_short import cut_short, ego_stood, never_came
from scenewright.explain.evidence import (
    Finding,
    came_too_late,
    crashed_between_triggers,
    ego_never_there,
    foreseen_otherwise,
    last_good,
    limit_reached,
    orders_with_ego,
)
from scenewright.explain.in_way import hero_in_way
from scenewright.judge.aftermath import Collision
from scenewright.judge.tolerance import Tolerance
from scenewright.judge.verdict import Cause, CauseKind, Condition, Verdict
from scenewright.plan.planner import GOOD
from scenewright.program.expressions import Compare, Elapsed, Temporal, walk
from scenewright.program.structure import Role, actors_of, knots_of, read_structure
from scenewright.program.types import EGO, Actor, Constraint, Program
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.solve.feasibility import Feasibility
from scenewright.translate.lines import in_words
from scenewright.translate.phrases import called

_CLEAR = ("no_collision", "heroes_apart")  # conditions that are missed at the moment of a crash


def cause_of(world: World, run: Run, verdict: Verdict, tolerance: Tolerance, proof: Feasibility | None) -> Cause:
    """Return why a run missed at `tolerance`: the first of these that the evidence shows.

    1. *ego*: it never came to its side of the trigger, no hero could have done it against its drive (`proof`), a
       condition on it alone, or one that it owes in any run, failed, or it crashed with a hero after that one's trigger
       and before another's. Where it slowed down for a hero, that is in the *way*, and it is never the ego's doing; nor
       is a crash before the trigger.
    2. *order*: all was well but who came first.
    3. *authority*: from the last plan on that would have done, a hero was at limits of its motion for most of a piece.
       That stands against what was asked of places, speeds and times, not against what any run owes.
    4. *prediction*: the ego did not drive as that plan foresaw.
    5. *plan*: none of these; so it was planned. A run that fails by how it begins, or by nothing but what lies beyond
       its end, is of this kind before all that came of it.
    """
    missed = [condition for condition in verdict.conditions if not condition.holds_at(tolerance)]
    asked = {constraint.id: constraint for constraint in world.scene.program.constraints}
    failed = [asked[condition.id] for condition in missed if condition.id in asked]
    in_way, never_there = hero_in_way(world, run), ego_never_there(world, verdict)
    stood = ego_stood(world, run, verdict, missed, never_there)
    whole = stood if stood is not None and (never_there or len(stood.never_came) == len(missed)) else None
    # It may have slowed down for the same hero before: what it stands before is where it is to be.
    if (
        whole is not None
        and whole.kind == "plan"
        and (in_way is None or in_way.due_s < whole.found.evidence["since_s"])
    ):
        return _cause("plan", whole.found)
    # What it did not come to for one who stands in its way is not in its hands.
    kept_from = stood.never_came if stood is not None and stood.kind == "plan" else ()
    in_hand = [each for each in missed if each not in kept_from]
    ego = never_there or (whole.found if whole is not None else _denied(world.scene.program, in_hand, failed, proof))
    if in_way is not None and (ego or any(condition.id == "no_collision" for condition in missed)):
        return _cause("way", Finding(_capital(f"{in_way}; what it did then is no finding about it"), asdict(in_way)))
    if ego is not None:
        return _cause("ego", ego)
    names = {hero.name: hero for hero in world.scene.program.heroes}
    if (crashed := crashed_between_triggers(verdict, names)) is not None:
        return _cause("ego", crashed)
    late = [came_too_late(world, run, verdict, constraint) for constraint in failed if orders_with_ego(constraint)]
    if late and len(late) == len(missed) and late[0] is not None:
        return _cause("order", late[0])
    begun = [each for each in missed if each.id == "start"] or [each for each in missed if each.kind == "initial"]
    if begun and (begun[0].id == "start" or len(begun) == len(missed)):
        return _cause("plan", _begun_so(run, begun[0]))
    crash_s = min((each.measured for each in missed if each.id in _CLEAR and each.measured is not None), default=None)
    hit = verdict.aftermath.collision if crash_s is not None else None
    hero = _hero(world.scene.program, failed, hit.actors if hit is not None else ())
    ended = cut_short(world, run, hero)
    knots_s = run.last_plan.profiles[hero.id].knot_times_s
    acted_s = knots_s.get(world.structure.trigger_knot(hero.id) or "", run.trace.duration_s)
    # Where the ego has no part in a trigger that lies beyond the end, it was in nobody's hands.
    waits = acted_s > run.trace.duration_s and EGO not in {who for who, _ in world.structure.triggers.get(hero.id, ())}
    open_ = never_came(world, verdict, missed)
    if ended is not None and (waits or len(open_) == len(missed)):
        return _cause("plan", ended)
    # What is asked of both after the trigger is missed by how the ego then drives; all else by what came to be at it.
    later = len(failed) == len(missed) and all(world.structure.roles[each.id] is Role.OUTCOME for each in failed)
    until_s = min(max(knots_s.values()) if later else acted_s, run.trace.duration_s)
    if crash_s is not None and crash_s < until_s:  # what comes after a crash mends and explains nothing
        until_s, later = crash_s, True
    # What was to last and was broken no later plan mends, however good the rest of it is.
    lasting = any(isinstance(node, Temporal) for each in failed for node in walk(each.formula))
    worst = max((tick for tick in run.replans if tick.time_s < until_s), key=lambda tick: tick.tolerance, default=None)
    good = last_good(run, worst.time_s if lasting and worst is not None and worst.tolerance > GOOD else until_s)
    otherwise = good and foreseen_otherwise(world, run, good, until_s, hero, at_trigger=not later)
    # Where no plan ever did it, what stands against it may lie in what was to follow.
    to_s = until_s if good or crash_s is not None else min(max(knots_s.values()), run.trace.duration_s)
    limit = limit_reached(world, run, hero, good.time_s if good else 0.0, to_s) if failed else None
    if limit is not None and otherwise:
        why = in_way or f"the ego drove otherwise than foreseen from {otherwise.evidence['since_s']:.1f} s on"
        return _cause("authority", Finding(f"{limit.text}, and {why}", {**otherwise.evidence, **limit.evidence}))
    if limit is not None:
        return _cause("authority", limit)
    left = otherwise or (ended if open_ else None) or _planned_so(run, hero, until_s, missed, hit, does_all=not failed)
    if in_way is not None:
        left = Finding(f"{left.text}; {in_way}", {**left.evidence, "in_way": asdict(in_way)})
    return _cause("prediction" if otherwise else "plan", left)


def _cause(kind: CauseKind, found: Finding) -> Cause:
    return Cause(kind, f"{_capital(found.text)}.", found.evidence)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _denied(
    program: Program, missed: Sequence[Condition], failed: Sequence[Constraint], proof: Feasibility | None
) -> Finding | None:
    """Return what the ego did that no hero could have mended, with what shows it."""
    alone = {constraint.id: constraint for constraint in failed if actors_of(constraint.formula) == {EGO}}
    # A moment of both at which heroes miss their side too is nearest to either side: it tells nothing of one alone.
    theirs = {key for constraint in failed if constraint.id not in alone for key in knots_of(constraint.formula)}
    instants = read_structure(program).instants
    of_both = {key for instant in instants if instant & theirs for key in instant}
    # When a moment of both comes is in a hero's hands, too: "so long after the ego was there" is of the ego's moments.
    shared = {key for instant in instants if any(actor != EGO for actor, _ in instant) for key in instant}
    if proof is not None:
        clashes = [clash for clash in proof.clashes if clash.formula is not None]
        told = ", ".join(dict.fromkeys(f'"{clash.words or clash.told}"' for clash in clashes))
        return Finding(
            f"against the way the ego drove, no hero within the laws of motion could have met all of {told}",
            {"proof": [str(clash) for clash in proof.clashes]},
        )
    for condition in missed:
        if condition.owed_by == program.ego.name and condition.miss is not None:
            return Finding(
                f'the ego did not do what it owes in any run: "{condition.text}" is off by {condition.off_by}',
                {"condition": condition.id, "proof": [str(condition.text)], "off": condition.error},
            )
    for condition in missed:
        # Where it starts, and when a trigger comes, is not in its hands alone.
        if condition.id not in alone or condition.kind in ("initial", "trigger"):
            continue
        formula = alone[condition.id].formula
        times = walk(formula) if isinstance(formula, Compare) else ()
        timed = any(isinstance(node, Elapsed) and (node.actor, node.knot) in shared for node in times)
        if not timed and of_both.isdisjoint(knots_of(formula)):
            words, told = in_words(program, alone[condition.id]), condition.off_by
            off = "off" if condition.unit or condition.required is not None else "off_tolerances"
            return Finding(
                f'the ego alone decides on "{words}", and did not do it' + (told and f", off by {told}"),
                {"condition": condition.id, "proof": [str(condition.text)], off: condition.error},
            )
    return None


def _hero(program: Program, failed: Sequence[Constraint], crashed: Collection[str]) -> Actor:
    """Return the hero that what failed speaks of, else one that crashed, else the first."""
    spoken_of = {actor for constraint in failed for actor in actors_of(constraint.formula)}
    heroes = list(program.heroes)
    named = [hero for hero in heroes if hero.id in spoken_of] or [hero for hero in heroes if hero.name in crashed]
    return (named or heroes)[0]


def _begun_so(run: Run, condition: Condition) -> Finding:
    """Return what the first plan gave up of how the run was to begin."""
    evidence = {"misses": condition.id, "measured": condition.measured, "missed": run.replans[0].tolerance}
    if condition.id == "start":
        return Finding(
            f"no plan was found that begins well and does all that was asked: somebody begins so near to another that "
            f"it brakes with {condition.measured or 0.0:.1f} m/s^2 at once",
            evidence,
        )
    off = condition.off_by and f" by {condition.off_by}"
    return Finding(f'no first plan was found that does all that was asked: it misses "{condition.text}"{off}', evidence)


def _planned_so(
    run: Run, hero: Actor, until_s: float, missed: Sequence[Condition], hit: Collision | None, *, does_all: bool
) -> Finding:
    """Return what is left: it was planned so, though nothing stood against it.

    Parameters
    ----------
    does_all
        Whether all that the program asks for came about: what was missed is owed by any run.
    """
    planned = [tick for tick in run.replans if tick.foreseen is not None and tick.time_s < until_s]
    last, off = planned[-1] if planned else run.replans[0], missed[0].off_by and f" by {missed[0].off_by}"
    if does_all or last.tolerance <= GOOD:
        return Finding(
            f"the last plan, of {last.time_s:.1f} s, does all that was asked of {called(hero.name)}, as far as it was "
            f'foreseen; what came of it misses "{missed[0].text}"' + (f": {hit.in_words()}" if hit else ""),
            {"hero": hero.name, "time_s": last.time_s, "missed": last.tolerance, "misses": missed[0].id},
        )
    return Finding(
        f"no plan was found that does all that was asked of {called(hero.name)}, though for most of the time it was "
        f"within its limits: the last one, of {last.time_s:.1f} s, missed by {last.tolerance:.1f} tight tolerances, "
        f'and what came of it misses "{missed[0].text}"{off}',
        {"hero": hero.name, "time_s": last.time_s, "missed": last.tolerance, "misses": missed[0].id},
    )
