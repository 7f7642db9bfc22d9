"""The closed loop: ticks whoever drives the heroes, steps a simulator, records what it observes.

What enters: a simulator, a start, whoever drives the heroes, and rates. What leaves: a `Run` with the trace, the plans
and every re-solve. It judges nothing, and of a simulator it knows the port only. A run that is cut short, by the user
or by a policy or a simulator that fails, keeps what it had.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot, isfinite
from typing import TYPE_CHECKING

import numpy as np

from scenewright.errors import PolicyError, ScenewrightError, SimulatorError
from scenewright.program import expressions as ex
from scenewright.program.evaluate import term_value
from scenewright.program.structure import actors_of, knots_of, read_structure
from scenewright.program.types import EGO, Program
from scenewright.roads.grounding import Scene
from scenewright.simulate.port import SIMULATORS, Simulator, Snapshot, Start
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.events import LONGEST_S
from scenewright.trace.model import ActorTrace, Trace

if TYPE_CHECKING:
    from scenewright.motion.profile import Profile
    from scenewright.plan.planner import Replan
    from scenewright.simulate.heroes import HeroDriver
    from scenewright.solve.plan import Plan

DEFAULT_STEP_S = 0.02
DEFAULT_REPLAN_S = 0.1
LONGEST_RUN_S = float(LONGEST_S)  # what comes later is refuted before anything is driven
_AFTER_HEROES_S = 2.0
_SEEN_S = 0.5  # beyond what a stand has to last, for it to be seen to
_WAIT_FOR_EGO_S = 10.0
_STALLED_S, STANDS_MPS = 20.0, 0.1
_MOVES_MPS = 0.5
ROUTE_END_M = 3.0  # who is so near to the end of its road has come to it
_NOTED_M = 0.01  # what a finding with two decimals can say
_Told = tuple[float, Mapping[int, str]]  # the latest time that a program tells (s); whose trigger speaks of the ego
_DRIVES_EGO = "The simulator drove the ego by itself; the policy of --ego only told how it would start."


@dataclass(frozen=True, slots=True)
class Rates:
    """Time step of the simulation and time between re-solves (s); None for the second is open loop."""

    step_s: float = DEFAULT_STEP_S
    replan_s: float | None = DEFAULT_REPLAN_S


@dataclass(slots=True)
class Run:
    """What came of one simulation.

    Attributes
    ----------
    status
        ``finished``, ``interrupted`` (by the user) or ``failed`` (by the policy or the simulator, see `fault`).
    """

    trace: Trace
    first_plan: Plan
    last_plan: Plan
    replans: list[Replan]
    status: str
    fault: ScenewrightError | None = None
    ego_knots_s: dict[str, float] = field(default_factory=dict)
    findings: list[str] = field(default_factory=list)


def simulate(
    simulator: Simulator,
    start: Start,
    heroes: HeroDriver,
    rates: Rates,
    progress: Callable[[float], None] | None = None,
) -> Run:
    """Drive from `start` and the first plan of `heroes` on.

    Parameters
    ----------
    progress
        Called with the simulated time (s) at every re-solve.
    """
    scene, first_plan, log = start.scene, heroes.plan, list[Snapshot]()
    steps_a_tick = max(1, round(rates.replan_s / rates.step_s)) if rates.replan_s else 0
    status, fault, step, astray_m, ego_moved_s = "finished", None, 0, 0.0, 0.0
    values = {name: float(value) for name, value in scene.parameters.items()}
    told, meets = _told_s(scene.program), _meets_ego(scene.program)
    with SIMULATORS.blamed(simulator):
        simulator.reset(start, rates.step_s)
        now = simulator.observe()
    try:
        while True:
            if steps_a_tick and step and step % steps_a_tick == 0:
                heroes.tick(now.time_s)
                if progress is not None:
                    progress(now.time_s)
            motions = {hero.id: heroes.plan.profiles[hero.id] for hero in scene.program.heroes}
            with SIMULATORS.blamed(simulator):
                simulator.apply(motions)
                now = simulator.observe()
            log.append(now)
            for hero, motion in motions.items():
                there = now.actors[hero]
                astray_m = max(astray_m, hypot(there.s_m - motion.state(now.time_s)[0], there.d_m))
            world = PlanWorld(scene, heroes.plan.profiles, values)
            told_s = max((at_s for time in told if isfinite(at_s := term_value(time, world))), default=0.0)
            if _is_over(scene, motions, now, (told_s, meets), ego_moved_s):
                break
            with SIMULATORS.blamed(simulator):
                simulator.step()
                now = simulator.observe()
            step += 1
            ego = now.actors[EGO]
            if ego.speed_mps > STANDS_MPS:
                ego_moved_s = now.time_s
            heroes.observe((now.time_s, ego.s_m, ego.speed_mps, ego.accel_mps2))
    except KeyboardInterrupt:
        if not log:
            raise  # nothing was driven, so nothing is kept
        status = "interrupted"
    except (PolicyError, SimulatorError) as error:
        if not log:
            raise
        status, fault = "failed", error
    findings = [_DRIVES_EGO] if simulator.capabilities.drives_ego else list(start.ego.policy.findings)
    if astray_m >= _NOTED_M:
        findings.append(f"In this simulator heroes were up to {astray_m:.2f} m from where they were to be.")
    trace, knots_s = _trace(scene, log), dict(heroes.ego_knots_s)
    return Run(trace, first_plan, heroes.plan, heroes.records, status, fault, knots_s, findings)


def _trace(scene: Scene, log: Sequence[Snapshot]) -> Trace:
    """Return what happened, from everybody at the beginning of each step, of which there must be one."""
    time_s, actors = np.array([now.time_s for now in log]), {}
    for actor in scene.program.actors:
        # Each quantity contiguous: traces are asked for single states very often.
        columns = np.ascontiguousarray(np.array([now.actors[actor.id] for now in log], dtype=np.float64).T)
        actors[actor.name] = ActorTrace(time_s, *columns)
    return Trace(actors)


def _told_s(program: Program) -> list[ex.Term]:
    """Return the times that a program tells by the clock, or as so long after a moment."""
    nodes = [node for constraint in program.constraints for node in ex.walk(constraint.formula)]
    told: list[object] = [node.at for node in nodes if isinstance(node, ex.State | ex.Derived)]
    told += [edge for node in nodes if isinstance(node, ex.Temporal) for edge in (node.start, node.end)]
    return [time for time in told if isinstance(time, ex.Number | ex.Arithmetic)]


def _is_over(scene: Scene, motions: Mapping[int, Profile], now: Snapshot, told: _Told, ego_moved_s: float) -> bool:
    """Whether all that the program tells of has happened, or will not happen any more.

    An ego that has not moved for long is not waited for, nor one at the end of its road, where no hero meets it.
    """
    time_s, ego, route, (clock_s, meets) = now.time_s, now.actors[EGO], scene.routes[EGO], told
    end_m = route.landmarks["route_end"]
    at_end = ego.s_m >= end_m - ROUTE_END_M
    waits = any(motions[hero].knot_times_s.get(knot, 0.0) > time_s for hero, knot in meets.items())
    if time_s >= LONGEST_RUN_S or time_s - ego_moved_s > _STALLED_S or (at_end and waits):
        return True
    # Whoever is at the end of its route does nothing more that a program asks for; others may.
    ends_m = {hero: scene.routes[hero].landmarks["route_end"] for hero in motions}
    going = [motion for hero, motion in motions.items() if now.actors[hero].s_m < ends_m[hero]]
    last_knot_s = max((max(profile.knot_times_s.values()) for profile in going), default=-_WAIT_FOR_EGO_S)
    stands_s = float(scene.program.manner.stands_s) + _SEEN_S
    if time_s < max(clock_s, last_knot_s + max(_AFTER_HEROES_S, stands_s)):
        return False
    if time_s < last_knot_s + _WAIT_FOR_EGO_S and _any_turning(scene, now):
        return False
    passed = at_end or ego.s_m > route.landmarks.get("junction_end", end_m) + 5.0
    return passed or time_s >= last_knot_s + _WAIT_FOR_EGO_S


def _meets_ego(program: Program) -> dict[int, str]:
    """Return the trigger knot of each hero whose trigger speaks of the ego."""
    structure = read_structure(program)
    return {
        hero: structure.trigger_knot(hero) or ""
        for hero, instant in structure.triggers.items()
        if any(EGO in actors_of(c.formula) for c in program.constraints if set(knots_of(c.formula)) <= instant)
    }


def _any_turning(scene: Scene, now: Snapshot) -> bool:
    """Whether a hero is on its way through the junction: which way it went is part of the story."""
    for hero in scene.program.heroes:
        places, there = scene.routes[hero.id].landmarks, now.actors[hero.id]
        inside = "junction_end" in places and places["junction_start"] < there.s_m < places["junction_end"]
        if inside and there.speed_mps > _MOVES_MPS:
            return True
    return False
