"""Tells, after a run that missed, whether any hero could have met all conditions against the ego as it drove.

What enters: the scene and the trace. What leaves: a finding with its evidence, or None. It tells what the ego denied
from what the orchestrator failed to do; it changes no verdict.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.program.structure import Structure, knots_of
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import TIGHT_TIME_S, LinearCondition, linear_conditions, tight_of
from scenewright.solve.feasibility import Feasibility, Question, check_feasibility
from scenewright.trace.model import ActorTrace, Trace

_STRETCH_S = 0.1
# An ego that is at its side for longer than this many moments leaves room for doubt.
_MOST_MOMENTS = 150


def ego_left_no_room(
    scene: Scene, structure: Structure, limits: Mapping[int, Limits], trace: Trace
) -> Feasibility | None:
    """Return the proof that against this drive of the ego no hero within `limits` could meet all conditions.

    The ego may be at its side of the trigger more than once, or for a while: every such moment is refuted, or nothing
    is claimed. Nor is it where another moment of the ego's hangs on heroes: with another hero it is another. None where
    there is no such proof, or where the ego never came to its side, which the judge tells.
    """
    motion = drive_profile(trace.actors[scene.program.ego.name])
    conditions = [c for c in linear_conditions(scene, structure) if set(c.weights) == {EGO} and c.weights[EGO][0]]
    names, trigger = scene.program.ego.sketch.knots, structure.trigger_knot(EGO) or ""
    side = next((c for c in conditions if c.moments == {(EGO, trigger)}), None)
    told = {key for c in conditions for key in c.moments} | {(EGO, names[0])}
    asked = {key for c in scene.program.constraints for key in knots_of(c.formula) if key[0] == EGO}
    if side is None or asked - told:
        return None
    moments = _moments_at(side, motion, trace.duration_s)
    if not 0 < len(moments) <= _MOST_MOMENTS:
        return None
    proof, bending = None, frozenset(hero.id for hero in scene.program.heroes)
    for moment_s in moments:
        knots = _ego_knots(conditions, motion, {names[0]: 0.0, trigger: moment_s}, names, trace.duration_s)
        drive = Profile(motion.segments, knots)
        question = Question(scene, structure, limits, drive=drive, bending=bending)
        found = check_feasibility(question, explain=proof is None)
        if found.answer != "infeasible":
            return None
        proof = proof or found
    # One that names no constraint rests on the order of the ego's knots alone.
    return proof if proof is not None and any(clash.formula for clash in proof.clashes) else None


def _moments_at(side: LinearCondition, motion: Profile, end_s: float) -> list[float]:
    """Return moments that stand for all at which the ego is within the tight tolerance of its side.

    A proof allows the trigger to be off by a tight tolerance in time to either side of a moment: twice that apart, they
    leave nothing out. The crossings themselves are among them.
    """
    since_s, motions, moments = 0.0, {EGO: motion}, list[float]()
    while (crossing := side.first_time(motions, since_s)) is not None and crossing <= end_s:
        moments.append(crossing)
        since_s = crossing + TIGHT_TIME_S
    for time_s in np.arange(0.0, end_s + 1e-9, TIGHT_TIME_S).tolist():
        state = motion.state(time_s)
        if abs(side.value({EGO: state})) <= tight_of(side, state[1]):
            moments.append(time_s)
    return sorted(moments)


def _ego_knots(
    conditions: Sequence[LinearCondition],
    motion: Profile,
    told_s: Mapping[str, float],
    names: Sequence[str],
    end_s: float,
) -> dict[str, float]:
    """Return when the ego passed all its knots, had it passed some then; long after the end where it never did."""
    knots, since_s = dict(told_s), 0.0
    for name in names:
        condition = next((c for c in conditions if c.moments == {(EGO, name)}), None)
        if name not in knots and condition is not None:
            time_s = condition.first_time({EGO: motion}, since_s)
            if time_s is not None and time_s <= end_s:
                knots[name] = time_s
        since_s = max(since_s, knots.get(name, 0.0))
    return dict.fromkeys(names, end_s + 60.0) | knots


def drive_profile(actor: ActorTrace) -> Profile:
    """Return what an actor drove as a profile with stretches of a tenth of a second."""
    times = np.arange(0.0, float(actor.time_s[-1]) + 1e-9, _STRETCH_S).tolist()
    segments = [Segment(0.0, 0.0, float(actor.s_m[0]), float(actor.speed_mps[0]), 0.0)] if len(times) < 2 else []
    for begin, end in pairwise(times):
        v0, v1 = actor.speed(begin), actor.speed(end)
        segments.append(Segment(begin, end - begin, actor.position(begin), v0, (v1 - v0) / (end - begin)))
    return Profile(tuple(segments))
