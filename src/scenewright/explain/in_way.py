"""Whether the ego slowed down for a hero that was in its way: what it does then says nothing about it.

What enters: a world and what was driven in it. What leaves: an `InWay` with its evidence, or None. Whether it slowed down
for somebody is found by driving it again from the same start, alone on its road.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from scenewright.errors import PolicyError
from scenewright.judge.tolerance import TIGHT, FloatArray
from scenewright.program.types import EGO
from scenewright.roads.bodies import CAR
from scenewright.roads.zones import boxes_touch
from scenewright.simulate.world import World
from scenewright.trace.model import ActorTrace, Trace

# As far ahead as times to collision are looked for (`judge.boxes`): what an ego alone would come to in this time (s).
_REACH_S = 8.0
_LOOKED_AT_S, _ALONG_M = 0.1, 0.5


@dataclass(frozen=True, slots=True)
class InWay:
    """A hero was in the ego's way, and the ego slower there than it is alone.

    Attributes
    ----------
    from_s, to_s
        When the ego was slower with the hero in its way, first and last.
    time_s, ego_m, ego_mps, alone_mps
        The instant at which it was slower by most; where and how fast it was then, and how fast it is there alone.
    ahead_m
        How far along its route the ego then was from touching the hero.
    """

    hero: str
    from_s: float
    to_s: float
    time_s: float
    ego_m: float
    ego_mps: float
    alone_mps: float
    ahead_m: float

    def evidence(self) -> dict[str, Any]:
        """Return the numbers by name."""
        return asdict(self)

    def __str__(self) -> str:
        return (
            f"{self.hero} was in the ego's way before the trigger, and the ego slowed down for it: at {self.time_s:.1f} s, "
            f"{self.ahead_m:.1f} m short of it, the ego drove {self.ego_mps:.1f} m/s where it drives "
            f"{self.alone_mps:.1f} m/s alone on its road"
        )


def hero_in_way(world: World, trace: Trace, until_s: float) -> InWay | None:
    """Return the hero for which the ego slowed down most before `until_s` while it was in its way; None for nobody.

    In its way is who stands or drives where the ego's body comes on its route, alone, within the next seconds.
    """
    ego = trace.actors[world.scene.program.ego.name]
    times = np.arange(float(ego.time_s[0]), until_s, _LOOKED_AT_S)
    place, speed = (np.interp(times, ego.time_s, values) for values in (ego.s_m, ego.speed_mps))
    touched = {
        hero.name: _touched_m(world, trace.actors[hero.name], times, place) for hero in world.scene.program.heroes
    }
    if not any(np.isfinite(ahead).any() for ahead in touched.values()):
        return None
    alone = _drive_alone(world, float(place[0]), float(speed[0]), trace.duration_s)
    if alone is None:
        return None
    then_s, there_m, there_mps = alone
    expected = np.interp(place, there_m, there_mps)
    slower = expected - speed
    worst: tuple[float, InWay] | None = None
    for name, ahead_m in touched.items():
        comes_s = np.interp(ahead_m, there_m, then_s, right=np.inf) - np.interp(place, there_m, then_s)
        found = np.flatnonzero((comes_s <= _REACH_S) & (slower > TIGHT.speed_mps))
        if not len(found):
            continue
        k = int(found[np.argmax(slower[found])])
        if worst is None or slower[k] > worst[0]:
            worst = float(slower[k]), InWay(
                name, float(times[found[0]]), float(times[found[-1]]), float(times[k]),
                float(place[k]), float(speed[k]), float(expected[k]), float(ahead_m[k] - place[k]),
            )  # fmt: skip
    return None if worst is None else worst[1]


def _touched_m(world: World, hero: ActorTrace, times: FloatArray, ego_m: FloatArray) -> FloatArray:
    """Return the first arc length ahead of the ego at which it would touch a hero as that is; infinite for none."""
    path = world.scene.routes[EGO].path
    along = np.arange(0.0, path.length_m, _ALONG_M)
    heading = np.unwrap(hero.heading_rad)
    poses = np.stack([np.interp(times, hero.time_s, values) for values in (hero.x_m, hero.y_m, heading)], axis=1)
    touch = boxes_touch(path.poses(along), poses, CAR, CAR) & (along[:, None] >= ego_m[None, :])
    return np.where(touch.any(axis=0), along[touch.argmax(axis=0)], np.inf)


def _drive_alone(
    world: World, s_m: float, speed_mps: float, for_s: float
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Return when the ego is where and how fast, alone on its road; None where it does not drive so."""
    ego, step_s = world.ego, world.rates.step_s
    states = [(0.0, s_m, speed_mps)]
    try:
        ego.reset(s_m, speed_mps)
        for step in range(round(for_s / step_s)):
            ego.advance(ego.decide(round(step * step_s, 9), (), step_s), step_s)
            states.append((round((step + 1) * step_s, 9), ego.s_m, ego.speed_mps))
            if ego.s_m >= ego.route.path.length_m - 3.0:
                break
    except PolicyError:
        return None
    time_s, place, speed = np.array(states).T
    return time_s, place, speed
