"""How a hero leads an ego that follows it to where a trigger comes about: what the ego makes of it is part of the plan.

What enters: how the ego would go on alone, its past, the hero's state, and the condition on both. What leaves: instants
at which the condition comes true, each with what the ego does by then. It plans no motion of the hero; a solver does.

Against an ego that is taken to go on as it is, a hero that is too far ahead slows down; one that is followed would have
to speed up, where the ego keeps its distance in time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scenewright.motion.profile import Profile, chain
from scenewright.program.types import EGO
from scenewright.simulate.following import Leader, foresee_follower
from scenewright.simulate.prediction import EgoSample
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.limits import MOVING_MPS
from scenewright.solve.situation import HeroState

# By how much (m/s) and how hard (m/s^2) a hero changes its speed to lead the ego.
_CHANGES_MPS, _CHANGE_MPSS = (0.0, 0.7, 1.5, 2.5, 4.0, 6.0, -0.7, -1.5, -2.5, -4.0), 1.5
# How long it holds its new speed before the trigger may come, in times it is to be settled for; at most (s).
_SETTLED_TIMES, _LONGEST_S = 1.2, 12.0


@dataclass(frozen=True, slots=True)
class Led:
    """An instant at which a trigger that both decide comes, and the ego's motion that leads to it."""

    instant_s: float
    ego: Profile


def ways_to_lead(
    hero: int,
    state: HeroState,
    condition: LinearCondition,
    alone: Profile,
    history: Sequence[EgoSample],
    *,
    offset_m: float,
    top_mps: float,
    cruise_mps: float,
    settled_s: float,
) -> list[Led]:
    """Return when `condition` comes true if the hero changes its speed evenly and holds it, the soonest first.

    Parameters
    ----------
    hero
        Its id; the ego follows it.
    condition
        On both, at the hero's trigger.
    alone, history
        How the ego would go on without the hero, and its states up to now.
    offset_m
        What to add to the hero's arc length to compare it with the ego's.
    top_mps, cruise_mps
        How fast the hero may be; how fast people drive where the ego does.
    settled_s
        For how long a hero is to be settled before its trigger.
    """
    past = [segment for segment in state.history.segments if segment.start_s < state.time_s - 1e-9]
    found: list[Led] = []
    for change_mps in _CHANGES_MPS:
        if not MOVING_MPS <= state.speed_mps + change_mps <= top_mps:
            continue
        moves = [(_LONGEST_S, 0.0, state.piece)]
        if change_mps:
            moves.insert(0, (abs(change_mps) / _CHANGE_MPSS, math.copysign(_CHANGE_MPSS, change_mps), state.piece))
        motion = Profile(chain(state.time_s, state.s_m, state.speed_mps, moves))
        leader = Leader(Profile((*past, *motion.segments)), offset_m)
        ego = foresee_follower(alone, history, leader, cruise_mps)
        from_s = motion.segments[-1].start_s + _SETTLED_TIMES * settled_s
        instant_s = condition.first_time({EGO: ego, hero: motion}, from_s)
        if instant_s is not None and instant_s < from_s + _LONGEST_S:
            found.append(Led(instant_s, ego))
    return sorted(found, key=lambda led: led.instant_s)
