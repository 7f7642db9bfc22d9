"""Tells, after a run that missed, whether any hero could have met all conditions against the ego as it drove.

What enters: the scene and the trace. What leaves: a finding with its evidence, or None. It tells what the ego denied
from what the orchestrator failed to do; it changes no verdict.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from scenewright.motion.profile import Profile, Segment
from scenewright.program.structure import Structure
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.feasibility import EgoDrive, Feasibility, check_feasibility
from scenewright.solve.limits import Limits
from scenewright.solve.problem import Backend
from scenewright.trace.model import ActorTrace, Trace

_STRETCH_S = 0.1


def ego_left_no_room(
    scene: Scene, structure: Structure, limits: Mapping[int, Limits], backend: Backend, trace: Trace
) -> Feasibility | None:
    """Return the proof that against this drive of the ego no hero within `limits` could meet all conditions.

    None where there is no such proof, or where the ego never came to its side of the trigger, which the judge tells.
    """
    motion = drive_profile(trace.actors[scene.program.ego.name])
    knots: dict[str, float] = {scene.program.ego.sketch.knots[0]: 0.0}
    conditions = [c for c in linear_conditions(scene, structure) if set(c.weights) == {EGO} and c.weights[EGO][0]]
    trigger = structure.trigger_knot(EGO)
    for knot in scene.program.ego.sketch.knots[1:]:
        condition = next((c for c in conditions if c.moments == {(EGO, knot)}), None)
        if condition is None:
            continue
        time_s = condition.first_time({EGO: motion}, max(knots.values()))
        if time_s is not None and time_s <= trace.duration_s:
            knots[knot] = time_s
    if trigger is None or trigger not in knots:
        return None
    never_s = trace.duration_s + 60.0
    for knot in scene.program.ego.sketch.knots:
        knots.setdefault(knot, never_s)
    found = check_feasibility(scene, structure, limits, backend, drive=EgoDrive(motion, knots))
    return found if found.answer == "infeasible" else None


def drive_profile(actor: ActorTrace) -> Profile:
    """Return what an actor drove as a profile with stretches of a tenth of a second."""
    ends = np.arange(0.0, float(actor.time_s[-1]) + 1e-9, _STRETCH_S)
    segments = []
    for begin, end in pairwise(ends):
        duration = float(end - begin)
        v0, v1 = actor.speed(float(begin)), actor.speed(float(end))
        segments.append(Segment(float(begin), duration, actor.position(float(begin)), v0, (v1 - v0) / duration))
    if not segments:
        segments.append(Segment(0.0, 0.0, float(actor.s_m[0]), float(actor.speed_mps[0]), 0.0))
    return Profile(tuple(segments))
