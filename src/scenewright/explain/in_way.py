"""Whether the ego slowed down for a hero: what it does then says nothing about it, for the hero was in its way.

What enters: a world and what was driven in it. What leaves: an `InWay` with its evidence, or None. Whether it slowed
down for somebody is found by driving it again from the same start, with nobody on its road but heroes that are where
they are to be: nothing else is different there. A hero is that from its trigger on, from when the ego has come where it
is to be the later one, and from when the program keeps it near the ego: what the ego does then answers the test.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from scenewright.errors import PolicyError
from scenewright.judge.tolerance import TIGHT, FloatArray
from scenewright.plan.asked import Asked
from scenewright.program.expressions import Compare, Derived, Elapsed, Formula, walk
from scenewright.program.types import EGO
from scenewright.simulate.ending import ROUTE_END_M
from scenewright.simulate.loop import Run
from scenewright.simulate.vehicles import seen
from scenewright.simulate.world import World
from scenewright.solve.proofs.forms import lasting_places
from scenewright.trace.model import COLUMNS, ActorState
from scenewright.translate.phrases import called


@dataclass(frozen=True, slots=True)
class InWay:
    """The ego was slower than it is without those who were not to be in its way yet.

    Attributes
    ----------
    hero
        The nearest of these when it began, of those ahead if there are any.
    since_s, due_s
        From when on; and from when on the hero was where it is to be.
    time_s, apart_m, ego_mps, alone_mps
        The instant at which it was slower by most; how far from the hero and how fast it was then, and how fast it is
        without, at that place or at that moment, whichever is slower: bends and whims slow it down then, too.
    """

    hero: str
    since_s: float
    due_s: float
    time_s: float
    apart_m: float
    ego_mps: float
    alone_mps: float

    def __str__(self) -> str:
        return (
            f"the ego slowed down for {called(self.hero)} before that was to be in its way, from {self.since_s:.1f} s "
            f"on: at {self.time_s:.1f} s, {self.apart_m:.0f} m away, it drove {self.ego_mps:.1f} m/s, and drives "
            f"{self.alone_mps:.1f} m/s where that is not there"
        )


def hero_in_way(world: World, run: Run) -> InWay | None:
    """Return the hero for which the ego slowed down while that was not to be there; None for nobody."""
    trace, due_s = run.trace, _due_s(world, run)
    until_s = min(max(due_s.values()), trace.duration_s)
    ego = trace.actors[world.scene.program.ego.name]
    without = _drive_without(world, run, due_s, until_s)
    if without is None:
        return None
    place_m, speed_mps = without
    then_mps = np.append(speed_mps, np.full(len(ego.s_m), np.inf))[: len(ego.s_m)]
    expected = np.minimum(np.interp(ego.s_m, place_m, speed_mps), then_mps)
    slower = np.where(ego.time_s < until_s, expected - ego.speed_mps, 0.0)
    last = min(len(place_m), int(np.searchsorted(ego.time_s, until_s, side="right"))) - 1
    further_m, faster_mps = place_m[last] - ego.s_m[last], speed_mps[last] - ego.speed_mps[last]
    kept_back = further_m > TIGHT.length_m or faster_mps > TIGHT.speed_mps  # else it is where it would be anyway
    if not kept_back or slower.max() <= TIGHT.speed_mps:
        return None
    worst, since = int(slower.argmax()), int(np.argmax(slower > TIGHT.speed_mps))
    apart_m, ahead_m = dict[str, FloatArray](), dict[str, float]()
    for hero in world.scene.program.heroes:
        if due_s[hero.id] > ego.time_s[since]:
            there = trace.actors[hero.name]
            x_m, y_m, heading = there.x_m - ego.x_m, there.y_m - ego.y_m, float(ego.heading_rad[since])
            apart_m[hero.name] = np.hypot(x_m, y_m)
            ahead_m[hero.name] = float(x_m[since] * np.cos(heading) + y_m[since] * np.sin(heading))
    name = min(apart_m, key=lambda name: (ahead_m[name] < 0.0, float(apart_m[name][since])))
    hero_due_s = next(due_s[hero.id] for hero in world.scene.program.heroes if hero.name == name)
    return InWay(
        name, float(ego.time_s[since]), hero_due_s, float(ego.time_s[worst]), float(apart_m[name][worst]),
        float(ego.speed_mps[worst]), float(expected[worst]),
    )  # fmt: skip


def comes_alone_m(world: World, run: Run) -> float | None:
    """Return how far the ego comes in the time of a run with nobody on its road; None where it cannot drive so."""
    nobody_s = {hero.id: np.inf for hero in world.scene.program.heroes}
    alone = _drive_without(world, run, nobody_s, run.trace.duration_s)
    return None if alone is None else float(alone[0][-1])


def _due_s(world: World, run: Run) -> dict[int, float]:
    """Return from when on (s) each hero is where it is to be."""
    plans, program = run.last_plan.profiles, world.scene.program
    second_to = Asked(world.scene, world.structure, world.limits).second_to
    due_s = dict[int, float]()
    for hero in program.heroes:
        acts_at = world.structure.trigger_knot(hero.id) or hero.sketch.knots[1]
        begun_s = plans[hero.id].knot_times_s.get(acts_at, 0.0)
        came_s = run.ego_knots_s.get(second_to[hero.id], run.trace.duration_s) if hero.id in second_to else 0.0
        due_s[hero.id] = max(begun_s, came_s)
    for stretch in lasting_places(program):
        if isinstance(begin := stretch.start, Elapsed):
            since_s = plans[begin.actor].knot_times_s.get(begin.knot, run.trace.duration_s)
            due_s |= {hero: min(since_s, due_s[hero]) for hero in _kept_near(stretch.body) if hero in due_s}
    return due_s


def _kept_near(body: Formula) -> Iterator[int]:
    """Yield who is to be no further than something from the ego: a distance that may grow puts nobody in its way."""
    for part in (part for part in walk(body) if isinstance(part, Compare)):
        left_is_more = part.operator in (">", ">=")
        less = [part.left, part.right] if part.operator == "==" else [part.right if left_is_more else part.left]
        for far in less:
            if isinstance(far, Derived) and isinstance(far.target, int) and EGO in (far.actor, far.target):
                yield from (far.actor, far.target)


def _drive_without(
    world: World, run: Run, due_s: Mapping[int, float], for_s: float
) -> tuple[FloatArray, FloatArray] | None:
    """Return where the ego is how fast with those alone who are due; None where it cannot drive so."""
    ego, step_s, traces = world.ego, world.rates.step_s, run.trace.actors
    if world.simulator.capabilities.drives_ego:
        return None
    first = traces[world.scene.program.ego.name]
    states = [(float(first.s_m[0]), float(first.speed_mps[0]))]
    columns = {
        hero.id: np.stack([getattr(traces[hero.name], name) for name in COLUMNS], axis=1)
        for hero in world.scene.program.heroes
    }
    try:
        ego.reset(*states[0])
        for step in range(round(for_s / step_s)):
            time_s = round(step * step_s, 9)
            there = {hero: ActorState(*rows[step].tolist()) for hero, rows in columns.items() if due_s[hero] <= time_s}
            ego.advance(ego.decide(time_s, seen(world.scene, there), step_s), step_s)
            states.append((ego.state.s_m, ego.state.speed_mps))
            if ego.state.s_m >= ego.route.path.length_m - ROUTE_END_M:
                break
    except PolicyError:
        return None
    place, speed = np.array(states).T
    return place, speed
