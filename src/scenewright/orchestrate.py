"""The whole way, from a text to a judged run. The file to read first.

    description --translate--> program --ground on a map--> scene --check--> feasible, or a proof that it cannot happen
        --plan--> first plan --simulate, re-solve each tick--> trace --judge--> verdict --> page
        where it missed: --explain--> its cause, and what would do

What enters: a `Request`. What leaves: a `Result` and, where something was driven, a run directory.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, get_args

from scenewright.errors import InputError, PolicyError, ScenewrightError, SimulatorError
from scenewright.explain.approach import approach_of
from scenewright.judge.tolerance import LOOSE, TIGHT, dimension_of
from scenewright.judge.tolerance import Tolerance as Tolerances
from scenewright.motion.limits import Limits
from scenewright.program.check import check_values
from scenewright.program.printer import print_program
from scenewright.request import Report, Request, Result, Stages, Stop, Take
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.simulate.loop import Rates
from scenewright.simulate.port import SIMULATORS
from scenewright.simulate.world import World
from scenewright.solve.holding import not_held
from scenewright.translate.sources import read_scenario, text_of

if TYPE_CHECKING:
    from scenewright.judge.case import Case
    from scenewright.plan.planner import Attempt
    from scenewright.program.types import Program
    from scenewright.simulate.ego_start import EgoFirstState
    from scenewright.simulate.loop import HeroDriver, Run
    from scenewright.solve.proofs.witness import Witness
    from scenewright.translate.understand import Understanding


def orchestrate(
    request: Request,
    report: Report | None = None,
    progress: Callable[[float], None] | None = None,
    until: Stop = "end",
) -> Result:
    """Carry out `request`.

    What the first plan breaks of the program, with the ego as foreseen, ends it before anything is driven.

    Parameters
    ----------
    report
        Called with the name of each stage as it begins.
    progress
        Called with the simulated time (s) as the run goes on.
    until
        The last stage to carry out. After ``check`` or ``plan`` the status is ``success`` where that stage succeeded;
        after ``check`` the witness is judged and written where there is a folder for it.

    Raises
    ------
    ScenewrightError
        Where the input is wrong; every subclass says what and how to mend it.
    """
    if until not in get_args(Stop):
        raise InputError("there is no such stage", found=repr(until), expected=", ".join(map(repr, get_args(Stop))))
    stages = Stages(report)
    world, result, answer = begin(request, stages)
    if answer == "infeasible":
        return result
    if until == "check":
        result.status = "success" if answer == "feasible" else "gave up"
        if request.out is not None and result.feasibility is not None and result.feasibility.witness is not None:
            _write_witness(request.out, request, result, world, result.feasibility.witness, stages)
        return result
    planned = _plan(request, result, world, stages)
    if planned is None or until == "plan":
        return result
    try:
        with SIMULATORS.closing(world.simulator):
            _drive(request, result, world, planned, stages, progress)
            result = _rehearse(request, result, world, stages, progress)
    except (PolicyError, SimulatorError) as error:
        if result.run is None or result.verdict is None:
            raise
        # What was driven is kept: a later take could not begin, or the simulator did not close.
        result.status, result.run.status, result.run.fault = "failed", "failed", error
    if result.status == "failure" and request.explain != "nothing":
        try:
            _explain(request, result, world, stages)
        except KeyboardInterrupt:
            result.status = "interrupted"
    if request.out is not None:
        with stages("write"):
            write_result(request.out, request, result, world, stages.seconds)
        result.run_directory = request.out
    return result


def begin(request: Request, stages: Stages) -> tuple[World, Result, str]:
    """Set everything up and ask whether it can happen; return world, answer, and the result for one that cannot."""
    world, understanding = set_up(request, stages)
    with stages("check"):
        feasibility = world.choose_and_check(explain=request.explain != "nothing")
    result = Result("infeasible", world.scene, understanding, feasibility, timings_s=stages.seconds)
    return world, result, feasibility.answer


def _plan(
    request: Request, result: Result, world: World, stages: Stages
) -> tuple[HeroDriver, EgoFirstState, Attempt] | None:
    """Return who drives the heroes, from which start and first plan on; None where that gives something up."""
    from scenewright.simulate.beginning import first_plan, first_plan_of_smt  # `check` has no use for planners

    result.status = "gave up"
    with stages("plan"):
        planned = first_plan_of_smt(world) if request.planner == "smt" else first_plan(world)
        assert planned is not None
    if isinstance(planned, str):
        result.no_plan = planned
        return None
    result.attempt, result.scene = planned[2], world.scene
    motions, holds_speed = result.attempt.plan.profiles, world.ego_bounds.holds_speed
    result.not_held = tuple(not_held(world.scene, motions, dimension_of, LOOSE.of, ego_promised=holds_speed))
    if result.not_held:
        return None
    result.status = "success"
    return planned


def _write_witness(
    directory: Path, request: Request, result: Result, world: World, witness: Witness, stages: Stages
) -> None:
    """Write the motion that shows that it can happen as a run, judged as any run is."""
    from scenewright.judge.judgement import judge
    from scenewright.simulate.witnessed import run_of_witness

    result.run = run_of_witness(world.scene, world.limits, witness)
    with stages("judge"):
        result.verdict = judge(case_of(world.scene, result.run, world.limits))
    with stages("write"):
        write_result(directory, request, result, world, stages.seconds)
    result.run_directory = directory


def _drive(
    request: Request,
    result: Result,
    world: World,
    planned: tuple[HeroDriver, EgoFirstState, Attempt],
    stages: Stages,
    progress: Callable[[float], None] | None,
) -> None:
    """Carry out one take from its first second, and judge it."""
    from scenewright.simulate.loop import simulate
    from scenewright.simulate.port import Start

    planner, start, result.attempt = planned
    result.scene = world.scene
    with stages("simulate"):
        begin_at = Start.of(world.scene, world.ego, (start.s_m, start.speed_mps), planner.plan.profiles)
        result.run = simulate(world.simulator, begin_at, planner, world.rates, progress)
    judge_run(request, result, world, stages)


def _rehearse(
    request: Request, first: Result, world: World, stages: Stages, progress: Callable[[float], None] | None
) -> Result:
    """Take a run again, knowing how this ego drove, until one is as good as was asked for; return the best one.

    Every take is a whole closed-loop run that is judged as the first is. What an ego does that answers the hero is not
    known from a drive in which the hero drove otherwise: from the third take on the hero comes more slowly, too.
    """
    from scenewright.simulate.beginning import first_plan, is_timed_by_ego
    from scenewright.simulate.hindsight import drive_profile
    from scenewright.takes import how_next, is_enough, worth

    last = best = first
    for take in range(2, 1 + (request.takes if request.planner == "convex" else 1)):
        learns_nothing = request.mode == "open" or world.ego_bounds.holds_speed
        if learns_nothing or last.status not in ("success", "failure") or last.run is None or is_enough(request, last):
            break
        drive = drive_profile(last.run.trace.actors[world.scene.program.ego.name])
        began_mps = math.inf if is_timed_by_ego(world) else drive.state(0.0)[1]
        try:
            with stages("plan"):
                ways = (first_plan(world, drive, *wanted) for wanted in how_next(last, take, began_mps))
                planned = next((each for each in ways if each is not None), None)
        except KeyboardInterrupt:  # what was driven is kept
            last = replace(last, status="interrupted")
            break
        if planned is None:
            break  # nothing to drive, however the take begins
        last = replace(first, take=take, takes=last.takes, hindsight=None)
        _drive(request, last, world, planned, stages, progress)
        if last.status in ("success", "failure"):
            best = max(best, last, key=partial(worth, request))
    world.choose(best.scene.parameters)
    if best.run is not None and best.verdict is not None:
        best.run.findings += approach_of(best.scene, best.run.trace, best.verdict.facts).unnatural
    return replace(best, takes=last.takes, status=last.status if last.status == "interrupted" else best.status)


def _tolerance(request: Request) -> Tolerances:
    return TIGHT if request.tolerance == "tight" else LOOSE


def _explain(request: Request, result: Result, world: World, stages: Stages) -> None:
    """Put into the verdict why the run missed and, where that is asked for, what would do."""
    from scenewright.explain.cause import cause_of
    from scenewright.explain.ways_out import ways_out

    assert result.run is not None
    assert result.verdict is not None
    with stages("explain"):
        cause = cause_of(world, result.run, result.verdict, _tolerance(request), result.hindsight)
        result.verdict = replace(result.verdict, cause=cause)
    if request.explain == "ways out":
        with stages("ways out"):
            found, tried = ways_out(
                world.scene, result.verdict, _tolerance(request), partial(_happens, request), stages.say
            )
        result.verdict = replace(result.verdict, cause=replace(cause, would_do=found, tried=tried))


def _happens(
    request: Request, program: Program, parameters: Mapping[str, float], progress: Callable[[float], None]
) -> bool:
    """Whether another program, or one with other parameters, is a success in its first take.

    What was left open stays open: whoever takes the number is not to be told others, too.
    """
    values = {**request.parameters, **parameters}
    other = replace(request, source=print_program(program), parameters=values, out=None, takes=1, explain="nothing")
    try:
        tried = orchestrate(other, progress=progress)
    except ScenewrightError:
        return False  # a value that is out of range, say
    if tried.status == "interrupted":
        raise KeyboardInterrupt
    return tried.status == "success"


def set_up(request: Request, stages: Stages) -> tuple[World, Understanding | None]:
    """Read the source, put it on its map, and load the policy; nothing that is wrong with them is found out late."""
    if request.out is not None:
        from scenewright.simulate.record import prepare_directory

        prepare_directory(request.out)
    with stages("translate"):
        program, understanding = read_scenario(
            request.source, request.translator, request.map_name, request.translation
        )
    with stages("ground"):
        scene = ground(program, load_map(request.map_name or program.map_name), request.parameters)
        text, name = text_of(request.source) if understanding is None else (None, program.name)
        check_values(program, scene.parameters, text, name)
    rates = Rates(replan_s=None if request.mode == "open" else 1.0 / request.replan_hz)
    ego, seed, predictor = request.ego, request.seed, request.predictor
    world = World(scene, ego, seed, rates, predictor, request.solver, request.simulator)
    return world, understanding


# -- what is left behind --------------------------------------------------------------------------------------------
def judge_run(request: Request, result: Result, world: World, stages: Stages, hindsight: bool = True) -> None:
    """Judge the run; where it missed, ask whether the ego left any room (if `hindsight` is asked for)."""
    from scenewright.judge.judgement import judge

    run = result.run
    assert run is not None
    with stages("judge"):
        result.verdict = judge(case_of(world.scene, run, world.limits))
    holds = result.verdict.holds_at(_tolerance(request))
    result.status = "success" if holds else "failure"
    if run.status != "finished":
        result.status = "interrupted" if run.status == "interrupted" else "failed"
    elif hindsight and not holds and request.explain != "nothing":
        from scenewright.simulate.hindsight import ego_left_no_room

        try:
            with stages("hindsight"):
                result.hindsight = ego_left_no_room(world.scene, world.structure, world.limits, run.trace)
        except KeyboardInterrupt:  # what was driven is kept
            result.status = "interrupted"
    if run.status == "finished":
        result.takes = (*result.takes, Take(result.verdict, result.hindsight, run.trace))


def write_result(
    directory: Path,
    request: Request,
    result: Result,
    world: World,
    timings_s: Mapping[str, float],
    page: bool = True,
) -> None:
    """Write the run directory, with its page or without."""
    from scenewright.judge.files import write_verdict
    from scenewright.simulate.record import write_run
    from scenewright.studio.page import write_page

    assert result.run is not None
    assert result.verdict is not None
    driven = bool(result.attempt)  # a witness is nobody's driving
    ego = (world.policy.name, world.policy.options) if driven else ("none", {})
    if driven and world.simulator.capabilities.drives_ego:
        ego = f"{request.simulator}'s own", {}
    rates = world.rates if driven else Rates(replan_s=None)
    circumstances = {
        "seed": request.seed,
        "take": result.take,
        "mode": request.mode if driven else "witness",
        "tolerance": request.tolerance,
        "simulator": request.simulator if driven else "none",
        "planner": request.planner if driven else "none",
        "ego": {"name": ego[0], "options": dict(ego[1])},
        "rates": {
            "simulation_hz": round(1 / rates.step_s, 6),
            "replan_hz": round(1 / rates.replan_s, 6) if rates.replan_s else 0,
        },
        "timings": {name: round(seconds, 6) for name, seconds in timings_s.items()},
    }
    given, understanding = request.parameters, result.understanding
    write_run(directory, world.scene, result.run, world.limits, circumstances, given, understanding)
    write_verdict(result.verdict, directory / "verdict.json")
    if page:
        write_page(directory)


def case_of(scene: Scene, run: Run, limits: Mapping[int, Limits]) -> Case:
    """Return what the judge may see of a run: program, values, facts of the map, and the trace."""
    from scenewright.judge import case
    from scenewright.roads.conflicts import shared_offset_m

    actors = scene.program.actors
    pairs = [(a, b) for a in actors for b in actors if a.id < b.id]
    return case.Case(
        program=scene.program,
        parameters={name: float(value) for name, value in scene.parameters.items()},
        landmarks={actor.name: scene.named_landmarks_m(actor.id) for actor in actors},
        shared_offset_m={(a.name, b.name): shared_offset_m(scene.routes[a.id], scene.routes[b.id]) for a, b in pairs},
        trace=run.trace,
        vehicles={actor.name: case.Box(VEHICLE_LENGTH_M, VEHICLE_WIDTH_M) for actor in actors},
        limits={
            hero.name: case.Limits(
                limits[hero.id].speed_max_mps,
                -limits[hero.id].brake_max_mpss,
                limits[hero.id].accel_max_mpss,
                limits[hero.id].lateral_max_mpss,
            )
            for hero in scene.program.heroes
        },
        expected_headings={actor.name: scene.routes[actor.id].headings for actor in actors},
        paths={actor.name: scene.routes[actor.id].path for actor in actors},
    )
