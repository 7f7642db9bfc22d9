"""Whether a run ended before all that was asked for had come, and what it waited for.

What enters: what was driven, how it was judged, and what missed. What leaves: a `Finding`, or None.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scenewright.explain.evidence import Finding
from scenewright.explain.in_way import comes_alone_m
from scenewright.judge.tolerance import TIGHT
from scenewright.judge.verdict import CauseKind, Condition, Verdict
from scenewright.program.structure import knots_of
from scenewright.program.types import EGO, Actor, Constraint
from scenewright.roads.bodies import VEHICLE_WIDTH_M
from scenewright.roads.conflicts import conflicts
from scenewright.simulate.ending import LONGEST_RUN_S, ROUTE_END_M, STANDS_MPS
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.trace.model import ActorTrace
from scenewright.translate.lines import in_words
from scenewright.translate.phrases import called


def never_came(world: World, verdict: Verdict, missed: Sequence[Condition]) -> list[Condition]:
    """Return what was missed that is of moments which the run did not come to."""
    asked = {each.id: each for each in world.scene.program.constraints}

    def is_open(condition: Condition) -> bool:
        if condition.id not in asked:
            return condition.measured is None
        return bool(_not_come_to(world, verdict, asked[condition.id]))

    return [condition for condition in missed if is_open(condition)]


def _not_come_to(world: World, verdict: Verdict, constraint: Constraint) -> set[int]:
    """Return whose moments of a constraint the run did not come to."""
    program, times_s = world.scene.program, verdict.facts["knot_times_s"]
    return {
        actor
        for actor, knot in knots_of(constraint.formula)
        if math.isinf(times_s[program.actor(actor).name].get(knot, math.inf))
    }


@dataclass(frozen=True, slots=True)
class Stood:
    """How the ego stood for good, which kind of cause that is, and what it never came to for it."""

    kind: CauseKind
    found: Finding
    never_came: Sequence[Condition]


def ego_stood(
    world: World, run: Run, verdict: Verdict, missed: Sequence[Condition], never_there: Finding | None
) -> Stood | None:
    """Return how the ego stood for good, where moments are missed that it did not come to, or its side of a trigger.

    That it stands before one who is in its way is nobody's doing. It is its own where nobody is, and where it does
    with nobody on its road.
    """
    asked = {each.id: each for each in world.scene.program.constraints}
    side = never_there.evidence["condition"] if never_there is not None else None
    open_ = [
        each
        for each in missed
        if each.id in asked and (each.id == side or EGO in _not_come_to(world, verdict, asked[each.id]))
    ]
    ego = run.trace.actors[world.scene.program.ego.name]
    since_s = _stood_from_s(ego)
    if not open_ or ego.speed_mps[-1] > STANDS_MPS:
        return None
    alone_m, blocking = comes_alone_m(world, run), list(_in_way_at_end(world, run))
    alike = alone_m is not None and alone_m <= ego.s_m[-1] + TIGHT.length_m
    hit = verdict.aftermath.collision
    if hit is not None and hit.time_s < since_s and not alike:  # what comes after it explains nothing
        return None
    its_own = alike or not blocking
    of_itself = "as it does alone on its road" if alike else "though nobody stood in its way"
    how = of_itself if its_own else _before(blocking)
    told = in_words(world.scene.program, asked[open_[0].id])
    evidence = {"in_its_way": [] if alike else blocking, "since_s": since_s}
    if its_own:
        evidence |= {"condition": open_[0].id, "proof": [open_[0].text]}
    found = Finding(f'the ego stood from {since_s:.1f} s on, {how}: "{told}" never came', evidence)
    return Stood("ego" if its_own else "plan", found, open_)


def cut_short(world: World, run: Run, hero: Actor) -> Finding | None:
    """Return what ended the run before a hero had done all that it was to do; None where it had."""
    acts_s, end_s = max(run.last_plan.profiles[hero.id].knot_times_s.values()), run.trace.duration_s
    if acts_s <= end_s:
        return None
    at_end = [
        called(actor.name)
        for actor in (world.scene.program.ego, hero)
        if run.trace.actors[actor.name].s_m[-1] >= world.scene.routes[actor.id].landmarks["route_end"] - ROUTE_END_M
    ]
    who, blocking = called(hero.name), list(_in_way_at_end(world, run))
    moved_s = _stood_from_s(run.trace.actors[world.scene.program.ego.name])
    where = f" {_before(blocking)}" if blocking else ""
    stood = f"the ego stood from {moved_s:.1f} s on{where}, and the run ended" if moved_s < end_s else "the run ended"
    why = f"{at_end[0]} came to the end of its road" if at_end and end_s < LONGEST_RUN_S else stood
    then = "it" if at_end[:1] == [who] else who
    return Finding(
        f"{why} at {end_s:.1f} s, before {then} was to have done all of it at {acts_s:.1f} s",
        {
            "hero": hero.name, "end_s": end_s, "planned_s": acts_s, "at_the_end_of_its_road": bool(at_end),
            "in_its_way": blocking,
        },
    )  # fmt: skip


def _stood_from_s(ego: ActorTrace) -> float:
    return float(ego.time_s[ego.speed_mps > STANDS_MPS].max(initial=0.0))


def _before(blocking: Sequence[str]) -> str:
    return f"before {' and '.join(map(called, blocking))}, who stood in its way"


def _in_way_at_end(world: World, run: Run) -> Iterator[str]:
    """Yield heroes who stand, when the run ends, where the ego has yet to pass: one body could touch the other.

    Where nobody stands in a crossing it is the next one on its way.
    """
    states, way = run.trace.actors, world.scene.routes[EGO]
    ego_m, ahead = float(states[world.scene.program.ego.name].s_m[-1]), dict[str, float]()
    crossed = False
    for hero in world.scene.program.heroes:
        own = states[hero.name]
        if own.speed_mps[-1] > STANDS_MPS:
            continue
        places = conflicts(way, world.scene.routes[hero.id])
        zones = [(each.zone_a_m, each.zone_b_m) for each in places if each.kind != "following"]
        if any(ego_m < theirs[1] and low <= own.s_m[-1] <= high for theirs, (low, high) in zones):
            crossed = True
            yield hero.name
        there_m, beside_m, _ = way.path.to_frenet(own.x_m[-1], own.y_m[-1], own.heading_rad[-1])
        if there_m > ego_m and abs(beside_m) < VEHICLE_WIDTH_M:
            ahead[hero.name] = there_m
    if ahead and not crossed:
        yield min(ahead, key=lambda name: ahead[name])
