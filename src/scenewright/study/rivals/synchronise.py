"""A hero whose speed is set so that it arrives when the ego does: OpenSCENARIO's SynchronizeAction.

What enters: scripts, and the ego's place and speed after every step. What leaves: motions. The two places are the
script's, where the first plan has ego and hero at the trigger: an author turns a time to arrival into a place at the
speed that he expects. The ego is taken to go on as fast as it is; nothing else is foreseen.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from scenewright.motion.profile import Profile, Segment
from scenewright.plan.prediction import EgoSample
from scenewright.program.structure import Structure
from scenewright.solve.plan import Plan
from scenewright.study.rivals.script import Script, top_speed_mps
from scenewright.study.rivals.scripted import ScriptedHeroes

# The action's targetTolerance: so near its place the hero counts as being there.
_TOLERANCE_M = 0.25
# Its final speed is held for this long before the place: the standard's TargetTimeSteadyState.
_STEADY_S = 0.5
# Shorter than this there is nothing left to set.
_SHORTEST_S = 0.1
_STANDING_MPS = 1e-3


class SynchronisedHeroes(ScriptedHeroes):
    """Scripted heroes whose approach is a SynchronizeAction with final speed and steady state.

    At every step the speed changes as the cubic motion wants that leads, from where the hero is, to its place at the
    final speed (the script's speed at the trigger) at the moment when the ego gets to its own at its present speed.
    Where that motion would have to reverse or go too fast, the hero simply takes the mean speed that it needs.
    """

    def __init__(self, structure: Structure, scripts: Mapping[int, Script], first: Plan, step_s: float) -> None:
        near = {
            hero: replace(script, group=replace(script.group, within_m=_TOLERANCE_M))
            for hero, script in scripts.items()
        }
        super().__init__(structure, near, first, step_s)

    def approach(self, script: Script, motion: Profile, ego: EgoSample) -> Profile:
        """Return the next step, at the acceleration that brings the hero to its place in time."""
        time_s, ego_m, ego_mps, _ = ego
        s_m, speed, _ = motion.state(time_s)
        left_s = (script.ego_place_m - ego_m) / max(ego_mps, _STANDING_MPS)
        wanted = self._wanted(script, script.own_place_m - s_m, speed, left_s)
        limits = script.limits
        top = min(limits.approach_speed_max_mps, top_speed_mps(limits, script.turn, s_m + speed * self.step_s))
        wanted = min(limits.accel_max_mpss, (top - speed) / self.step_s, wanted)
        accel = max(-limits.brake_max_mpss, -speed / self.step_s, wanted)
        return Profile((Segment(time_s, self.step_s, s_m, speed, accel),), motion.knot_times_s)

    def _wanted(self, script: Script, left_m: float, speed: float, left_s: float) -> float:
        """Return the acceleration (m/s^2) for `left_m` in `left_s`; 0 where one of the two is at its place."""
        final = script.trigger_speed_mps
        rest_s, rest_m = left_s - _STEADY_S, left_m - _STEADY_S * final
        if left_m <= 0.0 or rest_s < _SHORTEST_S:
            return 0.0
        accel = 6.0 * rest_m / rest_s**2 - (4.0 * speed + 2.0 * final) / rest_s
        jerk = (2.0 * (final - speed) / rest_s - 2.0 * accel) / rest_s
        if jerk and 0.0 < -accel / jerk < rest_s:
            extreme = speed - accel * accel / (2.0 * jerk)
            if not 0.0 <= extreme <= script.limits.approach_speed_max_mps:
                return (left_m / left_s - speed) / self.step_s
        return accel
