"""Runs one method on one request: the same check, the same first state of the ego, the same judge for every method.

What enters: a method's name and a `Request`. What leaves: a `Result`. How a rival drives its hero is told in the other
modules of this package.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from scenewright.drive.loading import load_policy
from scenewright.errors import InputError
from scenewright.judge.tolerance import LOOSE, dimension_of
from scenewright.orchestrate import begin, judge_run, orchestrate, write_result
from scenewright.plan.planner import Planner
from scenewright.request import Request, Result, Stages
from scenewright.simulate.beginning import first_plan
from scenewright.simulate.ego_start import EgoFirstState
from scenewright.simulate.loop import HeroDriver, Rates, simulate
from scenewright.simulate.port import SIMULATORS, Start
from scenewright.simulate.world import World
from scenewright.solve.holding import not_held
from scenewright.solve.plan import Plan
from scenewright.study.rivals import METHODS, request_of
from scenewright.study.rivals.follower import FollowingHeroes
from scenewright.study.rivals.rejection import sampled_scripts
from scenewright.study.rivals.script import Script, write_scripts
from scenewright.study.rivals.scripted import ScriptedHeroes
from scenewright.study.rivals.synchronise import SynchronisedHeroes
from scenewright.study.rivals.waypoints import SteadyFollower, WaypointDriver

DEFAULT_SAMPLES = 20


@dataclass(frozen=True, slots=True)
class Staging:
    """All that a rival may start from: the world, the first plan, where the ego starts, and what follows its name."""

    request: Request
    world: World
    stages: Stages
    planner: Planner
    start: EgoFirstState
    plan: Plan
    option: str

    def engine(self, scripts: Mapping[int, Script]) -> ScriptedHeroes:
        """Return heroes that carry out scripts."""
        return ScriptedHeroes(self.world.structure, scripts, self.plan, self.world.rates.step_s)

    def scripts(self) -> dict[int, Script]:
        """Return what an author writes from the first plan."""
        world = self.world
        return write_scripts(world.scene, world.structure, world.limits, self.planner.conditions, self.plan)

    def drive(self, result: Result, heroes: HeroDriver) -> None:
        """Drive once with `heroes`, from the ego's first state on, and judge it; hindsight is left out: it is dear."""
        world = self.world
        world.rates = Rates(world.rates.step_s, replan_s=None)
        with self.stages("simulate"):
            first = Start.of(world.scene, world.ego, (self.start.s_m, self.start.speed_mps), heroes.plan.profiles)
            result.run = simulate(world.simulator, first, heroes, world.rates)
        judge_run(self.request, result, world, self.stages, hindsight=False)


def run(method: str, request: Request) -> Result:
    """Carry out `request` by `method`; see `scenewright.study.rivals.run_method`."""
    check(method)
    name, _, option = method.partition(":")
    if name not in _RIVALS:
        return orchestrate(request_of(method, request))
    return _staged(request, method, option, _RIVALS[name])


def check(method: str) -> None:
    """Raise an error where there is no such method, or where it takes no such option."""
    name, colon, option = method.partition(":")
    if name not in METHODS:
        raise InputError(
            "there is no such method", found=method, expected=", ".join(METHODS), fix="--methods scenewright"
        )
    if colon and name not in _OPTIONS:
        raise InputError(f"the method {name!r} takes no option", found=method, expected=name, fix="leave it out")
    if colon:
        _OPTIONS[name](option)


def _staged(
    request: Request,
    method: str,
    option: str,
    drive: Callable[[Staging, Result], Result],
) -> Result:
    stages = Stages(None)
    request = replace(request, mode="closed")
    world, result, answer = begin(request, stages)
    if answer == "infeasible":
        return result
    with stages("plan"):
        planned = first_plan(world)
        assert planned is not None  # only a later take may ask for a start that there is none of
        planner, start, result.attempt = planned
    plan = result.attempt.plan
    result.not_held = tuple(
        not_held(world.scene, plan.profiles, dimension_of, LOOSE.of, ego_promised=world.ego_bounds.holds_speed)
    )
    if result.not_held:  # who starts from it would miss as much, whatever the method
        result.status = "gave up"
        return result
    with SIMULATORS.closing(world.simulator):
        result = drive(Staging(request, world, stages, planner, start, plan, option), result)
    if result.run is not None:
        result.run.findings.append(f"The hero was driven by the rival method {method}, not by Scenewright.")
        if request.out is not None:
            write_result(request.out, request, result, world, stages.seconds)
            result.run_directory = request.out
    return result


def _trigger_action(staging: Staging, result: Result) -> Result:
    staging.drive(result, staging.engine(staging.scripts()))
    return result


def _synchronise(staging: Staging, result: Result) -> Result:
    world = staging.world
    staging.drive(result, SynchronisedHeroes(world.structure, staging.scripts(), staging.plan, world.rates.step_s))
    return result


def _rejection(staging: Staging, result: Result) -> Result:
    """Drive samples until one succeeds; keep that one, else the nearest within the loose tolerance, else the first."""
    count = _sample_count(staging.option)
    generator = np.random.default_rng(staging.request.seed)
    scripts = sampled_scripts(staging.planner.conditions, staging.scripts(), generator)
    kept, nearest, takes = result, math.inf, result.takes
    for number, sample in enumerate(islice(scripts, count), start=1):
        driven = replace(result, take=number, takes=takes)
        staging.drive(driven, staging.engine(sample))
        takes = driven.takes
        miss = _miss(driven) if driven.status == "failure" else 0.0
        if number == 1 or miss < nearest:
            kept, nearest = driven, miss if miss <= 1.0 else 1.0
        if driven.status != "failure":
            break
    return replace(kept, takes=takes)


def _miss(result: Result) -> float:
    """Return the worst error of a run in loose tolerances."""
    from scenewright.judge.tolerance import LOOSE

    assert result.verdict is not None
    return max((condition.normalised_error(LOOSE) for condition in result.verdict.conditions), default=0.0)


def _sample_count(option: str) -> int:
    if not option:
        return DEFAULT_SAMPLES
    if not option.isdecimal() or int(option) < 1:
        raise InputError("there is no such number of samples", found=option, expected="rejection:N, N at least 1")
    return int(option)


def _follower(staging: Staging, result: Result) -> Result:
    """Follow waypoints; each hero has a driver model of its own."""
    world = staging.world
    drivers = {hero.id: _driver(staging.option) for hero in world.scene.program.heroes}
    heroes = FollowingHeroes(staging.planner, world.limits, drivers, world.rates.step_s, staging.request.seed)
    staging.drive(result, heroes)
    return result


def _driver(option: str) -> WaypointDriver:
    """Return our driver model, or one of the user's: found and built as ego policies of the user's are."""
    if not option:
        return SteadyFollower()
    driver: object = load_policy(option).policy
    assert isinstance(driver, WaypointDriver)  # both have the same two methods
    return driver


_RIVALS: dict[str, Callable[[Staging, Result], Result]] = {
    "trigger-action": _trigger_action,
    "synchronise": _synchronise,
    "rejection": _rejection,
    "follower": _follower,
}
_OPTIONS: dict[str, Callable[[str], object]] = {"rejection": _sample_count, "follower": _driver}
