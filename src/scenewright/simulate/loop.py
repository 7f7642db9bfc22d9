"""The closed loop: ticks whoever drives the heroes, steps a simulator, records what it observes.

What enters: a simulator, a start, whoever drives the heroes, and rates. What leaves: a `Run` with the trace, the plans
and every re-solve. It judges nothing, and of a simulator it knows the port only. A run that is cut short, by the user
or by a policy or a simulator that fails, keeps what it had.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from math import hypot
from typing import TYPE_CHECKING, Protocol

import numpy as np

from scenewright.errors import PolicyError, ScenewrightError, SimulatorError
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.simulate.ending import Ending
from scenewright.simulate.port import Simulator, Snapshot, Start, shown
from scenewright.trace.model import ActorTrace, Trace

if TYPE_CHECKING:
    from scenewright.plan.planner import Replan
    from scenewright.plan.prediction import EgoSample
    from scenewright.solve.plan import Plan

DEFAULT_STEP_S = 0.02
DEFAULT_REPLAN_S = 0.1
_EXACT = 1e-6  # so much of a tick is rounding
_NOTED_M = 0.01  # what a finding with two decimals can say
_DRIVES_EGO = "The simulator drove the ego by itself; the policy of --ego only told how it would start."


@dataclass(frozen=True, slots=True)
class Rates:
    """Time step of the simulation and time between re-solves (s); None for the second is open loop."""

    step_s: float = DEFAULT_STEP_S
    replan_s: float | None = DEFAULT_REPLAN_S


class HeroDriver(Protocol):
    """Whoever drives every hero of a scene through one run: the orchestrator's planner, or a rival of it."""

    @property
    def plan(self) -> Plan:
        """The motions in force: each tells its hero's state from now on, and its knots as far as they are known.

        The simulator asks for it anew at every step, so a driver may put another in its place at any time.
        """

    @property
    def ego_knots_s(self) -> dict[str, float]:
        """When the ego passed its knots."""

    @property
    def records(self) -> list[Replan]:
        """What each tick came to."""

    def tick(self, time_s: float) -> Replan:
        """Solve again where that is needed; called at the re-solve rate of the run, but not at its very beginning."""

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state; called after every step, before the heroes' states at its end are asked for."""


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
    ticks_a_step = rates.step_s / rates.replan_s if rates.replan_s else 0.0
    status, fault, step, astray_m = "finished", None, 0, 0.0
    ending = Ending(scene)
    now = shown(simulator, partial(simulator.reset, start, rates.step_s), start)
    # To look for garbage among all that there is takes as long as several ticks.
    if frozen := not gc.get_freeze_count():
        gc.freeze()
    try:
        while True:
            if int(step * ticks_a_step + _EXACT) > int((step - 1) * ticks_a_step + _EXACT) and step:
                heroes.tick(now.time_s)
                if progress is not None:
                    progress(now.time_s)
            motions = {hero.id: heroes.plan.profiles[hero.id] for hero in scene.program.heroes}
            now = shown(simulator, partial(simulator.apply, motions), start)
            log.append(now)
            for hero, motion in motions.items():
                there = now.actors[hero]
                astray_m = max(astray_m, hypot(there.s_m - motion.state(now.time_s)[0], there.d_m))
            if ending.is_now(heroes.plan.profiles, now):
                break
            now = shown(simulator, simulator.step, start, now.time_s)
            step += 1
            ego = now.actors[EGO]
            heroes.observe((now.time_s, ego.s_m, ego.speed_mps, ego.accel_mps2))
    except (KeyboardInterrupt, PolicyError, SimulatorError) as error:
        if not log:
            raise  # nothing was driven, so nothing is kept
        fault = error if isinstance(error, ScenewrightError) else None
        status = "failed" if fault is not None else "interrupted"
    finally:
        if frozen:
            gc.unfreeze()
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
