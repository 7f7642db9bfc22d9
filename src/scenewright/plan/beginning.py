"""How a run begins: the ego's first state and the heroes' first plan, chosen together.

What enters: a `World` and how the ego is foreseen. What leaves: the best first plan over the ego's possible starts.
"""

from __future__ import annotations

import math
from dataclasses import replace

from scenewright.plan.planner import ConvexPlanner
from scenewright.program.types import EGO
from scenewright.simulate.ego_start import EgoFirstState, ego_starts
from scenewright.simulate.prediction import Predictor
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.feasibility import check_feasibility
from scenewright.solve.planner import Attempt

# A plan that misses no more than this (tight tolerances) does what was asked.
_GOOD = 0.2


def first_plan(
    world: World, predictor: Predictor, slower_than_mps: float = math.inf, pace: float = 1.0
) -> tuple[ConvexPlanner, EgoFirstState, Attempt] | None:
    """Choose the ego's first state and plan from it; where several states may be chosen, the first that plans well."""
    limits = {actor: own if actor == EGO else own.at_pace(pace) for actor, own in world.limits.items()}
    conditions = linear_conditions(world.scene, world.structure)
    best: tuple[ConvexPlanner, EgoFirstState, Attempt] | None = None
    starts = list(ego_starts(world.scene, world.ego, world.limits[EGO], conditions))
    for start in [*starts, None]:
        if start is None:
            if best is not None and not _rank(best[2])[0]:
                break
            bounds = replace(world.ego_bounds, holds_speed=True)
            found = check_feasibility(world.scene, world.structure, world.limits, bounds, explain=False)
            if found.ego_start is None:
                break
            start = EgoFirstState(*found.ego_start, last_resort=True)
        if start.speed_mps >= slower_than_mps:
            continue
        planner = ConvexPlanner(world.scene, world.structure, limits, predictor, conditions)
        attempt = planner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        if best is None or _rank(attempt) < _rank(best[2]):
            best = planner, start, attempt
        if _rank(best[2]) == (False, False, 0):
            break
    return best


def _rank(attempt: Attempt) -> tuple[bool, bool, int]:
    """Return how a first plan compares with others: it does what was asked, promises the outcome, misses little."""
    assert attempt.plan is not None
    bad = attempt.plan.tolerance > _GOOD
    return bad, not attempt.promises_outcome, round(attempt.plan.tolerance / _GOOD) if bad else 0
