"""Which cause a missed run has: one, and that from evidence.

What enters: a world, what was driven in it, how it was judged, and the proof against the ego's drive if there is one.
What leaves: a `Cause`. It changes no verdict.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property

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
from scenewright.explain.in_way import InWay, hero_in_way
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
    miss = _Miss(world, run, verdict, [each for each in verdict.conditions if not each.holds_at(tolerance)], proof)
    for shown in (_of_the_ego, _of_the_order, _of_the_start, _of_the_end):
        if (cause := shown(miss)) is not None:
            return cause
    return _of_the_drive(miss)


@dataclass(frozen=True)
class _Miss:
    """A run, what it missed, the proof against the ego's drive if there is one, and what more than one cause asks."""

    world: World
    run: Run
    verdict: Verdict
    missed: Sequence[Condition]
    proof: Feasibility | None

    @property
    def program(self) -> Program:
        return self.world.scene.program

    @cached_property
    def failed(self) -> list[Constraint]:
        """The constraints of the program that were missed; the other conditions are owed by any run."""
        asked = {constraint.id: constraint for constraint in self.program.constraints}
        return [asked[condition.id] for condition in self.missed if condition.id in asked]

    @cached_property
    def in_way(self) -> InWay | None:
        return hero_in_way(self.world, self.run)

    @cached_property
    def crash_s(self) -> float | None:
        """When what is missed is a crash: when that was."""
        crashed = (each.measured for each in self.missed if each.id in _CLEAR and each.measured is not None)
        return min(crashed, default=None)

    @cached_property
    def hit(self) -> Collision | None:
        return self.verdict.aftermath.collision if self.crash_s is not None else None

    @cached_property
    def hero(self) -> Actor:
        """The hero that what failed speaks of, else one that crashed, else the first."""
        spoken_of = {actor for constraint in self.failed for actor in actors_of(constraint.formula)}
        heroes, crashed = list(self.program.heroes), self.hit.actors if self.hit is not None else ()
        named = [hero for hero in heroes if hero.id in spoken_of] or [hero for hero in heroes if hero.name in crashed]
        return (named or heroes)[0]

    @cached_property
    def ended(self) -> Finding | None:
        return cut_short(self.world, self.run, self.hero)

    @cached_property
    def unreached(self) -> list[Condition]:
        """What is missed that is of moments which the run did not come to."""
        return never_came(self.world, self.verdict, self.missed)

    @property
    def last_knot_s(self) -> float:
        """When the hero has done all, by the last plan."""
        return max(self.run.last_plan.profiles[self.hero.id].knot_times_s.values())

    @property
    def acted_s(self) -> float:
        knots_s = self.run.last_plan.profiles[self.hero.id].knot_times_s
        return knots_s.get(self.world.structure.trigger_knot(self.hero.id) or "", self.run.trace.duration_s)


def _of_the_ego(miss: _Miss) -> Cause | None:
    world, run, verdict, missed, in_way = miss.world, miss.run, miss.verdict, miss.missed, miss.in_way
    never_there = ego_never_there(world, verdict)
    stood = ego_stood(world, run, verdict, missed, never_there)
    whole = stood if stood is not None and (never_there or len(stood.never_came) == len(missed)) else None
    # It may have slowed down for the same hero before: what it stands before is where it is to be.
    before = whole is not None and (in_way is None or in_way.due_s < whole.found.evidence["since_s"])
    if whole is not None and whole.kind == "plan" and before:
        return _cause("plan", whole.found)
    # What it did not come to for one who stands in its way is not in its hands.
    kept_from = stood.never_came if stood is not None and stood.kind == "plan" else ()
    in_hand = [each for each in missed if each not in kept_from]
    ego = never_there or (whole.found if whole is not None else _denied(miss.program, in_hand, miss.failed, miss.proof))
    if in_way is not None and (ego or any(condition.id == "no_collision" for condition in missed)):
        return _cause("way", Finding(f"{in_way}; what it did then is no finding about it", asdict(in_way)))
    ego = ego or crashed_between_triggers(verdict, {hero.name: hero for hero in miss.program.heroes})
    return None if ego is None else _cause("ego", ego)


def _of_the_order(miss: _Miss) -> Cause | None:
    orders = [constraint for constraint in miss.failed if orders_with_ego(constraint)]
    if not orders or len(orders) < len(miss.missed):
        return None
    late = came_too_late(miss.world, miss.run, miss.verdict, orders[0])
    return None if late is None else _cause("order", late)


def _of_the_start(miss: _Miss) -> Cause | None:
    start = next((each for each in miss.missed if each.id == "start"), None)
    initial = [each for each in miss.missed if each.kind == "initial"]
    begun = start or (initial[0] if len(initial) == len(miss.missed) else None)
    return None if begun is None else _cause("plan", _begun_so(miss.run, begun))


def _of_the_end(miss: _Miss) -> Cause | None:
    # Where the ego has no part in a trigger that lies beyond the end, it was in nobody's hands.
    of_trigger = {who for who, _ in miss.world.structure.triggers.get(miss.hero.id, ())}
    waits = miss.acted_s > miss.run.trace.duration_s and EGO not in of_trigger
    whole = waits or len(miss.unreached) == len(miss.missed)
    return _cause("plan", miss.ended) if miss.ended is not None and whole else None


def _of_the_drive(miss: _Miss) -> Cause:
    """Return what of limits, foresight and plans came between the last plan that would have done and the miss."""
    world, run, failed, hero, in_way = miss.world, miss.run, miss.failed, miss.hero, miss.in_way
    last_s, crash_s = min(miss.last_knot_s, run.trace.duration_s), miss.crash_s
    # What is asked of both after the trigger is missed by how the ego then drives; all else by what came to be at it.
    later = len(failed) == len(miss.missed) and all(world.structure.roles[each.id] is Role.OUTCOME for each in failed)
    until_s = last_s if later else min(miss.acted_s, run.trace.duration_s)
    if crash_s is not None and crash_s < until_s:  # what comes after a crash mends and explains nothing
        until_s, later = crash_s, True
    # What was to last and was broken no later plan mends, however good the rest of it is.
    lasting = any(isinstance(node, Temporal) for each in failed for node in walk(each.formula))
    worst = max((tick for tick in run.replans if tick.time_s < until_s), key=lambda tick: tick.tolerance, default=None)
    good = last_good(run, worst.time_s if lasting and worst is not None and worst.tolerance > GOOD else until_s)
    otherwise = good and foreseen_otherwise(world, run, good, until_s, hero, at_trigger=not later)
    # Where no plan ever did it, what stands against it may lie in what was to follow.
    to_s = until_s if good or crash_s is not None else last_s
    limit = limit_reached(world, run, hero, good.time_s if good else 0.0, to_s) if failed else None
    if limit is not None and otherwise:
        why = in_way or f"the ego drove otherwise than foreseen from {otherwise.evidence['since_s']:.1f} s on"
        return _cause("authority", Finding(f"{limit.text}, and {why}", {**otherwise.evidence, **limit.evidence}))
    if limit is not None:
        return _cause("authority", limit)
    left = otherwise or (miss.ended if miss.unreached else None) or _planned_so(miss, until_s)
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


def _planned_so(miss: _Miss, until_s: float) -> Finding:
    """Return what is left: it was planned so, though nothing stood against it."""
    run, hero, first = miss.run, miss.hero, miss.missed[0]
    planned = [tick for tick in run.replans if tick.foreseen is not None and tick.time_s < until_s]
    last, off = planned[-1] if planned else run.replans[0], first.off_by and f" by {first.off_by}"
    evidence = {"hero": hero.name, "time_s": last.time_s, "missed": last.tolerance, "misses": first.id}
    if not miss.failed or last.tolerance <= 1.0:
        but = "" if last.tolerance <= GOOD else f" but for {last.tolerance:.1f} tight tolerances"
        return Finding(
            f"the last plan, of {last.time_s:.1f} s, does all that was asked of {called(hero.name)}{but}, as far as it "
            f'was foreseen; what came of it misses "{first.text}"' + (f": {miss.hit.in_words()}" if miss.hit else off),
            evidence,
        )
    return Finding(
        f"no plan was found that does all that was asked of {called(hero.name)}, though for most of the time it was "
        f"within its limits: the last one, of {last.time_s:.1f} s, missed by {last.tolerance:.1f} tight tolerances, "
        f'and what came of it misses "{first.text}"{off}',
        evidence,
    )
