"""Runs one method on one request: the same check, the same first state of the ego, the same judge for every method.

What enters: a method's name and a `Request`. What leaves: a `Result`. How a rival drives its hero is told in the other
modules of this package.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from scenewright.errors import InputError
from scenewright.orchestrate import (
    Request,
    Result,
    Stages,
    World,
    first_plan,
    judge_run,
    orchestrate,
    predictor_for,
    set_up,
    write_result,
)
from scenewright.simulate.ego_start import EgoFirstState
from scenewright.simulate.heroes import HeroDriver
from scenewright.simulate.loop import Rates, simulate
from scenewright.simulate.replanner import Replanner
from scenewright.solve.plan import Plan
from scenewright.study.rivals import METHODS
from scenewright.study.rivals.script import Script, write_scripts
from scenewright.study.rivals.scripted import ScriptedHeroes


@dataclass(frozen=True, slots=True)
class Staging:
    """All that a rival may start from: the world, the first plan, and where the ego starts."""

    request: Request
    world: World
    stages: Stages
    replanner: Replanner
    start: EgoFirstState
    plan: Plan

    def scripts(self) -> dict[int, Script]:
        """Return what an author writes from the first plan."""
        world = self.world
        return write_scripts(world.scene, world.structure, world.limits, self.replanner.conditions, self.plan)

    def drive(self, result: Result, heroes: HeroDriver, replan_s: float | None = None) -> None:
        """Drive once with `heroes`, from the ego's first state on, and judge it; hindsight is left out: it is dear."""
        world = self.world
        world.rates = Rates(world.rates.step_s, replan_s)
        with self.stages("simulate"):
            world.ego.reset(self.start.s_m, self.start.speed_mps)
            result.run = simulate(world.scene, world.ego, heroes, world.rates)
        judge_run(self.request, result, world, self.stages, hindsight=False)


def run(method: str, request: Request) -> Result:
    """Carry out `request` by `method`; see `scenewright.study.rivals.run_method`."""
    name = method.partition(":")[0]
    if name == "scenewright":
        return orchestrate(request)
    if name == "open-loop":
        return orchestrate(replace(request, mode="open"))
    if name not in _RIVALS:
        raise InputError("there is no such method", found=method, expected=", ".join(METHODS))
    return _staged(request, method, _RIVALS[name])


def _staged(request: Request, method: str, drive: Callable[[Staging, Result], Result]) -> Result:
    stages = Stages(None)
    request = replace(request, mode="closed")
    world, translation = set_up(request, stages)
    with stages("check"):
        feasibility = world.choose_and_check()
    result = Result("infeasible", world.scene, translation, feasibility, timings_s=stages.seconds)
    if feasibility.answer == "infeasible":
        return result
    with stages("plan"):
        replanner, start, result.attempt = first_plan(world, request, predictor_for(world, request))
    if result.attempt.plan is None:
        result.status = "gave up"
        return result
    result = drive(Staging(request, world, stages, replanner, start, result.attempt.plan), result)
    if result.run is not None:
        result.run.findings.append(f"The hero was driven by the rival method {method}, not by Scenewright.")
        if request.out is not None:
            write_result(request.out, request, result, world, stages.seconds)
            result.run_directory = request.out
    return result


def _trigger_action(staging: Staging, result: Result) -> Result:
    world = staging.world
    heroes = ScriptedHeroes(world.structure, staging.scripts(), staging.plan, world.rates.step_s)
    staging.drive(result, heroes)
    return result


_RIVALS: dict[str, Callable[[Staging, Result], Result]] = {"trigger-action": _trigger_action}
