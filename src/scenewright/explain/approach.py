"""How heroes drive up to their triggers: whether that is driving at all, whoever planned it.

What enters: the trace of a run, its scene, and the facts of its verdict. What leaves: an `Approach`, from places and
speeds alone, the same for every method. Nothing here decides whether a run is a success.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from scenewright.motion.limits import Signs
from scenewright.program.structure import standstills
from scenewright.program.types import PieceKind
from scenewright.translate.phrases import called

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from scenewright.program.types import Actor
    from scenewright.roads.grounding import Scene
    from scenewright.trace.model import ActorTrace, Trace

# What is called harsh: beyond this to one side and to the other within so long. Passengers call 1 m/s^2 a change.
_HARSH_MPSS, _WITHIN_S = 1.0, 1.5
_EVERY_S = 0.1  # what is shorter is no jerk that anybody feels, and a step of another's controller
_STANDS_MPS, _STANDS_S = 0.1, 0.5
_COMFORTABLE_MPSS = 2.5  # sideways
_BRAKES_MPSS = 3.0  # what is hard to brake at in traffic, for how fast one may come to what follows


@dataclass(frozen=True, slots=True)
class Approach:
    """The heroes of one run before their triggers.

    Attributes
    ----------
    reverses
        Whether one turned from more than 1 m/s^2 to one side to more than 1 m/s^2 to the other within 1.5 s.
    stands
        Whether one stood for half a second where the program has it stand nowhere before its trigger.
    jerks_mpsss, accels_mpss
        Their sizes, every 0.1 s.
    unnatural
        What people would not do, in words that say who did it.
    pace
        At the trigger, of the speed that the road allows and what the hero then did leaves (braking at 3 m/s^2 to its
        state at the next knot); the least of all heroes, None without a trigger.
    """

    reverses: bool = False
    stands: bool = False
    jerks_mpsss: list[float] = field(default_factory=list)
    accels_mpss: list[float] = field(default_factory=list)
    pace: float | None = None
    unnatural: list[str] = field(default_factory=list)


def approach_of(scene: Scene, trace: Trace, facts: Mapping[str, Any]) -> Approach:
    """Look at every hero until its trigger, by the times that a verdict's facts tell; one without is not looked at."""
    found = []
    for hero in scene.program.heroes:
        trigger_s = facts["trigger_time_s"].get(hero.name)
        if trigger_s is not None and np.isfinite(trigger_s):
            times = facts["knot_times_s"][hero.name].values()
            next_s = min([trace.duration_s, *(time_s for time_s in times if time_s > trigger_s)])
            count = sum(time_s < trigger_s for time_s in times)
            stands = standstills(scene.program, hero.id) & {*hero.sketch.knots[: count + 1]}
            may_stand = PieceKind.STOP in hero.sketch.pieces[:count] or bool(stands)
            found.append(_of_hero(scene, hero, trace.actors[hero.name], trigger_s, next_s, may_stand=may_stand))
    paces = [each.pace for each in found if each.pace is not None]
    return Approach(
        any(each.reverses for each in found),
        any(each.stands for each in found),
        [jerk for each in found for jerk in each.jerks_mpsss],
        [accel for each in found for accel in each.accels_mpss],
        min(paces, default=None),
        [told for each in found for told in each.unnatural],
    )


def _of_hero(
    scene: Scene, hero: Actor, driven: ActorTrace, trigger_s: float, next_s: float, *, may_stand: bool
) -> Approach:
    times = np.arange(driven.time_s[0], trigger_s, _EVERY_S)
    speeds = np.interp(times, driven.time_s, driven.speed_mps)
    accels = np.diff(speeds) / _EVERY_S
    s_m, speed_mps = (np.interp([trigger_s, next_s], driven.time_s, row) for row in (driven.s_m, driven.speed_mps))
    route = scene.routes[hero.id]
    curve_mps = (_COMFORTABLE_MPSS / max(abs(route.path.curvature(float(s_m[0]))), 1e-6)) ** 0.5
    limit_mps = min(Signs.of(route, scene.road_map).at_mps(float(s_m[0])), curve_mps)
    allowed_mps = min(limit_mps, float(np.sqrt(speed_mps[1] ** 2 + 2 * _BRAKES_MPSS * max(0.0, s_m[1] - s_m[0]))))
    reverses = _reverses(accels)
    stands = not may_stand and _longest(speeds < _STANDS_MPS) * _EVERY_S >= _STANDS_S
    harshly = "braked and sped up, or the other way round, harshly within 1.5 s (by more than 1 m/s^2 each)"
    told = {harshly: reverses, "stood for half a second or more, though no text has it stand": stands}
    return Approach(
        reverses,
        stands,
        [round(float(jerk), 3) for jerk in np.abs(np.diff(accels)) / _EVERY_S],
        [round(float(accel), 3) for accel in np.abs(accels)],
        float(speed_mps[0]) / allowed_mps if allowed_mps > 0.0 else None,
        [f"Before its trigger {called(hero.name)} {what}." for what, is_so in told.items() if is_so],
    )


def _reverses(accels: NDArray[np.float64]) -> bool:
    within = round(_WITHIN_S / _EVERY_S)
    signs = np.where(np.abs(accels) > _HARSH_MPSS, np.sign(accels), 0.0)
    return any(signs[k] * signs[k + lag] < 0 for lag in range(1, within + 1) for k in range(len(signs) - lag))


def _longest(held: NDArray[np.bool_]) -> int:
    """Return the most samples in a row that hold."""
    longest = run = 0
    for each in held:
        run = run + 1 if each else 0
        longest = max(longest, run)
    return longest
