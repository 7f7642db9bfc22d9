"""Turns a witness into a run: judged, written and looked at like one that was driven.

What enters: a scene and the motion of everybody that shows that it can happen. What leaves: a `Run`; nobody's policy
took part in it, and nothing was solved again.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile
from scenewright.plan.afterwards import goes_on
from scenewright.plan.asked import Caps, caps_of
from scenewright.plan.pairs import passes_s
from scenewright.plan.preferences import Preferences
from scenewright.roads.bodies import CAR
from scenewright.roads.grounding import Scene
from scenewright.roads.routes import Route
from scenewright.roads.zones import overlap
from scenewright.simulate.loop import DEFAULT_STEP_S, Run
from scenewright.solve.plan import Plan
from scenewright.solve.proofs.witness import Witness
from scenewright.trace.model import ActorTrace, FloatArray, Trace

_AFTERWARDS_S = 2.0  # what follows the last moment that matters, to be looked at
_ON_STEP_S = 0.1


def run_of_witness(scene: Scene, limits: Mapping[int, Limits], witness: Witness) -> Run:
    """Return a run in which everybody, the ego too, moves as in `witness`, until a little after its last moment."""
    until_s = max(witness.end_s + _AFTERWARDS_S, 2 * DEFAULT_STEP_S)
    profiles = dict(witness.profiles)
    ends_s = []
    for hero in scene.program.heroes:
        caps = caps_of(scene.routes[hero.id], scene.road_map, limits[hero.id], Preferences().lateral_mpss)
        profiles[hero.id], end_s = _driven_on(caps, profiles[hero.id], until_s)
        ends_s.append(end_s)
    ends_s += [passes_s(motion, scene.routes[actor].landmarks["route_end"]) for actor, motion in profiles.items()]
    until_s = _apart_until(scene, profiles, witness.end_s, max(min(until_s, *ends_s), witness.end_s))
    time_s = DEFAULT_STEP_S * np.arange(int(np.ceil(until_s / DEFAULT_STEP_S - 1e-9)) + 1, dtype=np.float64)
    actors = {actor.name: _trace(scene.routes[actor.id], profiles[actor.id], time_s) for actor in scene.program.actors}
    plan = Plan(profiles, parameters=witness.parameters)
    knots_s = dict(witness.profiles[scene.program.ego.id].knot_times_s)
    return Run(Trace(actors), plan, plan, [], "finished", ego_knots_s=knots_s)


def _driven_on(caps: Caps, motion: Profile, until_s: float) -> tuple[Profile, float]:
    """Return a motion that goes on after its last moment as any hero does then, and until when.

    It ends where it would be too fast for a bend that comes too soon.
    """
    now, wanted = motion.end_s, Preferences()
    while now < until_s and motion.state(now)[1] <= np.interp(motion.state(now)[0], caps.places, caps.most):
        motion, now = goes_on(0, {0: motion}, (), now, wanted, caps), now + _ON_STEP_S
    return motion, now


def _apart_until(scene: Scene, profiles: Mapping[int, Profile], from_s: float, until_s: float) -> float:
    """Return until when nobody touches anybody after the last moment: what comes then is nobody's doing."""
    times = np.arange(from_s, until_s, DEFAULT_STEP_S)
    boxes = {}
    for actor, profile in profiles.items():
        s_m = np.array([profile.state(float(t))[0] for t in times])
        boxes[actor] = scene.routes[actor].path.poses(s_m) if len(times) else np.zeros((0, 3))
    touch = [np.flatnonzero(overlap(a, b, CAR, CAR)) for a, b in combinations(boxes.values(), 2)]
    first = min((int(found[0]) for found in touch if len(found)), default=None)
    return until_s if first is None else float(times[max(0, first - 2)])  # a trace ends up to a step later


def _trace(route: Route, profile: Profile, time_s: FloatArray) -> ActorTrace:
    s_m, speed_mps, accel_mpss = np.array([profile.state(float(t)) for t in time_s]).T.copy()
    x_m, y_m, heading_rad = route.path.poses(s_m).T[:3].copy()
    return ActorTrace(time_s, x_m, y_m, heading_rad, speed_mps, accel_mpss, s_m, np.zeros(len(time_s)))
