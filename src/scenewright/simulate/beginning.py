"""How a run begins: the ego's first state and the heroes' first plan, chosen together.

What enters: a `World` and how the ego is foreseen. What leaves: the best first plan over the ego's possible starts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from scenewright.plan.planner import GOOD, Attempt, Planner
from scenewright.plan.prediction import Predictor
from scenewright.program.types import EGO
from scenewright.simulate.ego_start import EgoFirstState, ego_starts
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.feasibility import check_feasibility


def first_plan(
    world: World, predictor: Predictor, slower_than_mps: float = math.inf, pace: float = 1.0
) -> tuple[Planner, EgoFirstState, Attempt] | None:
    """Choose the ego's first state and plan from it; where several states may be chosen, the first that plans well.

    None where the ego cannot start slower than it must.

    Parameters
    ----------
    pace
        The share of their speed at which heroes come to their triggers.
    """
    limits = {actor: own if actor == EGO else own.at_pace(pace) for actor, own in world.limits.items()}
    conditions = linear_conditions(world.scene, world.structure)
    best: tuple[Planner, EgoFirstState, Attempt] | None = None
    for start in _starts(world):
        if start.last_resort and best is not None and best[2].is_good:
            break
        if start.speed_mps >= slower_than_mps:
            continue
        planner = Planner(world.scene, world.structure, limits, predictor, conditions)
        attempt = planner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        if best is None or _rank(attempt) < _rank(best[2]):
            best = planner, start, attempt
        if attempt.is_good and attempt.promises_outcome:
            break
    return best


def is_timed_by_ego(world: World) -> bool:
    """Whether a trigger waits for the ego to be some time from a place: one that is still speeding up is there sooner.

    An ego that starts slower then leaves less time for what follows, not more.
    """
    triggers = {key for instant in world.structure.triggers.values() for key in instant}
    return any(
        EGO in condition.weights and condition.weights[EGO][1] != 0.0 and condition.moments & triggers
        for condition in linear_conditions(world.scene, world.structure)
    )


def _starts(world: World) -> Iterator[EgoFirstState]:
    """Yield what the policy would hold, and at last the first state in which an ego that holds its speed makes it."""
    yield from ego_starts(world.scene, world.ego, world.limits[EGO], linear_conditions(world.scene, world.structure))
    bounds = replace(world.ego_bounds, holds_speed=True)
    found = check_feasibility(world.scene, world.structure, world.limits, bounds, explain=False)
    if found.ego_start is not None:
        yield EgoFirstState(*found.ego_start, last_resort=True)


def _rank(attempt: Attempt) -> tuple[bool, bool, int]:
    """Return how a first plan compares with others: it does what was asked, promises the outcome, misses little."""
    missed = 0 if attempt.is_good else round(attempt.missed.by / GOOD)
    return not attempt.is_good, not attempt.promises_outcome, missed
