"""Whether a run ended before all that was asked for had come, and what it waited for.

What enters: what was driven, how it was judged, and what missed. What leaves: a `Finding`, or None.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from scenewright.explain.evidence import Finding
from scenewright.judge.verdict import Condition, Verdict
from scenewright.program.structure import knots_of
from scenewright.program.types import EGO, Actor, Constraint
from scenewright.roads.conflicts import conflicts
from scenewright.simulate.ending import LONGEST_RUN_S, ROUTE_END_M, STANDS_MPS
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.translate.phrases import called


def never_came(world: World, verdict: Verdict, missed: Sequence[Condition]) -> bool:
    """Whether all that was missed is of moments that the run did not come to."""
    names = {actor.id: actor.name for actor in world.scene.program.actors}
    asked: Mapping[str, Constraint] = {each.id: each for each in world.scene.program.constraints}
    times_s = verdict.facts["knot_times_s"]

    def is_open(condition: Condition) -> bool:
        if condition.id not in asked:
            return condition.measured is None
        knots = knots_of(asked[condition.id].formula)
        return any(math.isinf(times_s[names[actor]].get(knot, math.inf)) for actor, knot in knots)

    return bool(missed) and all(map(is_open, missed))


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
    ego = run.trace.actors[world.scene.program.ego.name]
    moved_s = float(ego.time_s[ego.speed_mps > STANDS_MPS].max(initial=0.0))
    where = f" before {' and '.join(map(called, blocking))}, who stood in its way" if blocking else ""
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


def _in_way_at_end(world: World, run: Run) -> Iterator[str]:
    """Yield heroes who stand, when the run ends, where the ego has yet to pass: one body could touch the other."""
    states = run.trace.actors
    ego_m = float(states[world.scene.program.ego.name].s_m[-1])
    for hero in world.scene.program.heroes:
        own = states[hero.name]
        ways = world.scene.routes[EGO], world.scene.routes[hero.id]
        zones = [(each.zone_a_m, each.zone_b_m) for each in conflicts(*ways)]
        in_zone = (ego_m < theirs[1] and low <= own.s_m[-1] <= high for theirs, (low, high) in zones)
        if own.speed_mps[-1] <= STANDS_MPS and any(in_zone):
            yield hero.name
