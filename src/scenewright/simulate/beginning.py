"""How a run begins: the ego's first state and the heroes' first plan, chosen together.

What enters: a `World` and how the ego is foreseen. What leaves: the best first plan over the ego's possible starts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from scenewright.motion.profile import Profile
from scenewright.plan.planner import GOOD, Attempt, Planner
from scenewright.plan.prediction import Predictor
from scenewright.program.types import EGO
from scenewright.simulate.ego_start import EgoFirstState, ego_starts
from scenewright.simulate.heroes import HeroDriver
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.feasibility import check_feasibility

_SHIFTS = 4  # of a start, until an ego that slows down for a bend is where it is to be


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
    for start in _starts(world, predictor):
        # An ego that does not hold its speed may still let come about what no plan promises.
        promised = best is not None and (best[2].promises_outcome or not world.ego_bounds.holds_speed)
        if start.last_resort and best is not None and best[2].is_good and promised:
            break
        if start.speed_mps >= slower_than_mps:
            continue
        planner = Planner(world.planned, world.structure, limits, predictor, conditions)
        attempt = planner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        if best is None or _rank(attempt) < _rank(best[2]):
            best = planner, start, attempt
        if attempt.is_good and attempt.promises_outcome:
            break
    return best


def first_plan_of_smt(world: World) -> tuple[HeroDriver, EgoFirstState, Attempt] | str:
    """Plan by an SMT solver from the first of the ego's possible starts that it finds a plan from; else say why not."""
    from scenewright.plan.smt import SmtPlanner

    why = ""
    for start in _starts(world, world.predictor):
        planner = SmtPlanner(world.scene, world.limits, world.ego_bounds)
        if planner.refused:
            return f"the SMT planner cannot take {planner.refused}"
        attempt = planner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        if attempt is not None:
            return planner, start, attempt
        why = planner.why
    return f"the SMT planner found no first plan, wherever the ego starts; from the last start: {why}"


def is_timed_by_ego(world: World) -> bool:
    """Whether a trigger waits for the ego to be some time from a place: one that is still speeding up is there sooner.

    An ego that starts slower then leaves less time for what follows, not more.
    """
    triggers = {key for instant in world.structure.triggers.values() for key in instant}
    return any(
        EGO in condition.weights and condition.weights[EGO][1] != 0.0 and condition.moments & triggers
        for condition in linear_conditions(world.scene, world.structure)
    )


def _starts(world: World, predictor: Predictor) -> Iterator[EgoFirstState]:
    """Yield what the policy would hold, and at last the first state in which an ego that holds its speed makes it."""
    conditions = linear_conditions(world.scene, world.structure)
    yield from ego_starts(world.scene, world.ego, world.limits[EGO], conditions)
    bounds = replace(world.ego_bounds, holds_speed=True)
    found = check_feasibility(world.scene, world.structure, world.limits, bounds, explain=False)
    if found.witness is None:
        return
    motion = found.witness.profiles[EGO]
    start = EgoFirstState(*motion.state(0.0)[:2], last_resort=True)
    yield start
    first = {(EGO, world.scene.program.ego.sketch.knots[0])}
    if not any(each.moments == first and each.weights[EGO][0] for each in conditions):
        yield _on_time(start, motion, world, predictor)


def _on_time(start: EgoFirstState, motion: Profile, world: World, predictor: Predictor) -> EgoFirstState:
    """Return a start from which an ego that does not hold its speed is where `motion` is when triggers come there."""
    knots = [name for instant in world.structure.triggers.values() for actor, name in instant if actor == EGO]
    for name in knots[:1]:
        then_s = motion.knot_times_s[name]
        for _ in range(_SHIFTS):
            foreseen = predictor.predict([(0.0, start.s_m, start.speed_mps, start.accel_mpss)])
            late_m = motion.state(then_s)[0] - foreseen.state(then_s)[0]
            start = replace(start, s_m=max(0.0, start.s_m + late_m))
    return start


def _rank(attempt: Attempt) -> tuple[bool, float, float]:
    """Return how a first plan compares with others: it does what was asked, is hardly late, misses little."""
    missed = 0.0 if attempt.is_good else round(attempt.missed.by / GOOD)
    return not attempt.is_good, round(max(0.0, attempt.missed.late_s), 1), missed
