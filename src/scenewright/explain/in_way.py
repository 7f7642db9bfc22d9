"""Whether the ego slowed down for a hero: what it does then says nothing about it, for the hero was in its way.

What enters: a world and what was driven in it. What leaves: an `InWay` with its evidence, or None. Whether it slowed
down for somebody is found by driving it again from the same start, alone on its road: nothing else is different there.
From its trigger on, or from when the ego has come where a hero is to be the later one, that is where it is to be, and
what the ego does is an answer to the test.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scenewright.errors import PolicyError
from scenewright.judge.tolerance import TIGHT, FloatArray
from scenewright.plan.asked import Asked
from scenewright.simulate.ending import ROUTE_END_M
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from scenewright.translate.phrases import called


@dataclass(frozen=True, slots=True)
class InWay:
    """The ego was slower than it is alone.

    Attributes
    ----------
    hero
        The nearest one when it began, of those ahead if there are any.
    since_s
        From when on.
    time_s, apart_m, ego_mps, alone_mps
        The instant at which it was slower by most; how far from the hero and how fast it was then, and how fast it is
        alone, at that place or at that moment, whichever is slower: bends and whims slow it down alone, too.
    """

    hero: str
    since_s: float
    time_s: float
    apart_m: float
    ego_mps: float
    alone_mps: float

    def __str__(self) -> str:
        when = f"at {self.time_s:.1f} s, {self.apart_m:.0f} m away"
        return (
            f"the ego slowed down for {called(self.hero)} before that was to be in its way: {when}, it drove "
            f"{self.ego_mps:.1f} m/s, and drives {self.alone_mps:.1f} m/s where it is alone"
        )


def hero_in_way(world: World, run: Run) -> InWay | None:
    """Return the hero for which the ego slowed down while none was to be there; None for nobody.

    That is before the last trigger was acted upon, and where a hero is to come later than the ego until that has come.
    """
    trace, plans, triggers = run.trace, run.last_plan.profiles, world.structure.trigger_knot
    begun_s = [plans[hero.id].knot_times_s.get(triggers(hero.id) or "", 0.0) for hero in world.scene.program.heroes]
    second_to = Asked(world.scene, world.structure, world.limits).second_to.values()
    came_s = [run.ego_knots_s.get(knot, trace.duration_s) for knot in second_to]
    until_s = min(max([*begun_s, *came_s]), trace.duration_s)
    ego = trace.actors[world.scene.program.ego.name]
    alone = _drive_alone(world, float(ego.s_m[0]), float(ego.speed_mps[0]), until_s)
    if alone is None:
        return None
    place_m, speed_mps = alone
    then_mps = np.append(speed_mps, np.full(len(ego.s_m), np.inf))[: len(ego.s_m)]
    expected = np.minimum(np.interp(ego.s_m, place_m, speed_mps), then_mps)
    slower = np.where(ego.time_s < until_s, expected - ego.speed_mps, 0.0)
    if slower.max() <= TIGHT.speed_mps:
        return None
    worst, since = int(slower.argmax()), int(np.argmax(slower > TIGHT.speed_mps))
    apart_m, ahead_m = dict[str, FloatArray](), dict[str, float]()
    for hero in world.scene.program.heroes:
        there = trace.actors[hero.name]
        x_m, y_m, heading = there.x_m - ego.x_m, there.y_m - ego.y_m, float(ego.heading_rad[since])
        apart_m[hero.name] = np.hypot(x_m, y_m)
        ahead_m[hero.name] = float(x_m[since] * np.cos(heading) + y_m[since] * np.sin(heading))
    name = min(apart_m, key=lambda name: (ahead_m[name] < 0.0, float(apart_m[name][since])))
    return InWay(
        name, float(ego.time_s[since]), float(ego.time_s[worst]), float(apart_m[name][worst]),
        float(ego.speed_mps[worst]), float(expected[worst]),
    )  # fmt: skip


def _drive_alone(world: World, s_m: float, speed_mps: float, for_s: float) -> tuple[FloatArray, FloatArray] | None:
    """Return where the ego is how fast, alone on its road; None where it cannot drive so."""
    ego, step_s = world.ego, world.rates.step_s
    if world.simulator.capabilities.drives_ego:
        return None
    states = [(s_m, speed_mps)]
    try:
        ego.reset(s_m, speed_mps)
        for step in range(round(for_s / step_s)):
            ego.advance(ego.decide(round(step * step_s, 9), (), step_s), step_s)
            states.append((ego.state.s_m, ego.state.speed_mps))
            if ego.state.s_m >= ego.route.path.length_m - ROUTE_END_M:
                break
    except PolicyError:
        return None
    place, speed = np.array(states).T
    return place, speed
