"""How a run begins: the ego's first state and the heroes' first plan, chosen together.

What enters: a `World` and how the ego is foreseen. What leaves: the best first plan over the ego's possible starts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from scenewright.program.evaluate import violation
from scenewright.program.expressions import Compare
from scenewright.program.structure import Role, read_structure
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.simulate.ego_start import EgoFirstState, ego_starts
from scenewright.simulate.prediction import Predictor
from scenewright.simulate.replanner import Replanner
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.feasibility import check_feasibility
from scenewright.solve.plan import PlanWorld
from scenewright.solve.planner import Attempt, Planner

_GENTLENESS = {"steady": 5, "gentle": 4, "firm": 3, "whole": 2, "urgent": 1}
_PROMISED, _GOOD = 10, 13
_NOTABLY_S = 0.12


def first_plan(
    world: World, predictor: Predictor, slower_than_mps: float = math.inf, pace: float = 1.0
) -> tuple[Replanner, EgoFirstState, Attempt] | None:
    """Choose the ego's first state and plan from it; where several states may be chosen, the first that plans well.

    None where the ego cannot start slower than it must.

    Parameters
    ----------
    pace
        The share of their speed at which heroes come to their triggers.
    """
    import os

    if os.environ.get("SCENEWRIGHT_PLANNER") == "convex":
        from scenewright.plan.beginning import first_plan as convex

        return convex(world, predictor, slower_than_mps, pace)  # type: ignore[return-value]
    limits = {actor: own if actor == EGO else own.at_pace(pace) for actor, own in world.limits.items()}
    conditions = linear_conditions(world.scene, world.structure)
    best: tuple[Replanner, EgoFirstState, Attempt] | None = None
    for start in chain(ego_starts(world.scene, world.ego, world.limits[EGO], conditions), _solved_start(world)):
        if start.last_resort and not _is_last_hope(world, best):
            break
        if start.by_choice and best is not None and _quality(best[2]) > _PROMISED:
            break
        if start.speed_mps >= slower_than_mps:
            continue
        planner = Planner(world.scene, world.structure, limits, world.backend, conditions, world.budget_s)
        replanner = Replanner(world.scene, world.structure, planner, predictor, conditions)
        attempt = replanner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        if best is None or _is_better(world.scene, attempt, best[2]):
            best = (replanner, start, attempt)
        if _quality(attempt) >= _GOOD:
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


def _is_last_hope(world: World, best: tuple[Replanner, EgoFirstState, Attempt] | None) -> bool:
    """Whether a start that only arithmetic speaks for is worth a try: a promise, where the ego holds its speed."""
    if best is None or best[2].plan is None:
        return True
    return world.ego_bounds.holds_speed and _quality(best[2]) < _PROMISED


def _solved_start(world: World) -> Iterator[EgoFirstState]:
    """Yield, once all others have failed, the first state in which an ego that holds its speed makes it possible."""
    bounds = replace(world.ego_bounds, holds_speed=True)
    found = check_feasibility(world.scene, world.structure, world.limits, bounds, explain=False)
    if found.ego_start is not None:
        yield EgoFirstState(*found.ego_start, last_resort=True)


def _quality(attempt: Attempt) -> int:
    """Rank a first plan: one that promises the outcome before one that does not, then the gentler one."""
    if attempt.plan is None:
        return 0
    promised = _PROMISED if attempt.status == "sat" and attempt.promises_outcome else 0
    return promised + _GENTLENESS[attempt.plan.style]


def _is_better(scene: Scene, attempt: Attempt, other: Attempt) -> bool:
    """Whether a first plan is better than another; of two that do not promise the outcome, the less late."""
    if attempt.plan is not None and other.plan is not None and max(_quality(attempt), _quality(other)) < _PROMISED:
        late_s, other_late_s = lateness_s(scene, attempt), lateness_s(scene, other)
        if abs(late_s - other_late_s) > _NOTABLY_S:
            return late_s < other_late_s
    return _quality(attempt) > _quality(other)


def lateness_s(scene: Scene, attempt: Attempt) -> float:
    """Return by how much a plan, with the ego as predicted, misses who is to be where before whom (s)."""
    assert attempt.plan is not None
    world = PlanWorld(scene, attempt.plan.profiles, attempt.plan.parameters)
    roles = read_structure(scene.program).roles
    orders = [
        constraint.formula
        for constraint in scene.program.constraints
        if roles[constraint.id] is Role.OUTCOME and isinstance(constraint.formula, Compare)
        if constraint.formula.operator != "=="
    ]
    misses = [violation(formula, world) for formula in orders]
    return max((miss for miss in misses if math.isfinite(miss)), default=0.0)
