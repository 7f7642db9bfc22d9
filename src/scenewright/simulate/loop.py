"""The built-in simulator: steps the ego's policy and the heroes' motions, ticks their driver, records what happened.

What enters: a scene, a policy, whoever drives the heroes, and rates. What leaves: a `Run` with the trace, the plans and
every re-solve. It judges nothing. A run that is cut short, by the user or by a policy that fails, keeps what it had.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from scenewright.drive.protocol import VehicleState
from scenewright.errors import PolicyError
from scenewright.plan.planner import Replan
from scenewright.program.types import EGO
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.grounding import Scene
from scenewright.simulate.heroes import HeroDriver
from scenewright.simulate.vehicles import EgoVehicle
from scenewright.solve.plan import Plan
from scenewright.trace.model import ActorTrace, FloatArray, Trace

DEFAULT_STEP_S = 0.02
DEFAULT_REPLAN_S = 0.1
LONGEST_RUN_S = 90.0
_AFTER_HEROES_S = 2.0
_WAIT_FOR_EGO_S = 10.0
_STALLED_S = 20.0
_MOVES_MPS = 0.5

HeroMotion = tuple[float, float, float]  # arc length (m), speed (m/s), acceleration (m/s^2)


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
        ``finished``, ``interrupted`` (by the user) or ``failed`` (by the policy, see `fault`).
    """

    trace: Trace
    first_plan: Plan
    last_plan: Plan
    replans: list[Replan]
    status: str
    fault: PolicyError | None = None
    ego_knots_s: dict[str, float] = field(default_factory=dict)
    findings: list[str] = field(default_factory=list)


def simulate(
    scene: Scene,
    ego: EgoVehicle,
    heroes: HeroDriver,
    rates: Rates,
    progress: Callable[[float], None] | None = None,
) -> Run:
    """Drive the scene from the first plan of `heroes` on, with `ego` already at its first state.

    Parameters
    ----------
    progress
        Called with the simulated time (s) at every re-solve.
    """
    first_plan, log = heroes.plan, _Log(scene)
    steps_a_tick = max(1, round(rates.replan_s / rates.step_s)) if rates.replan_s else 0
    status, fault, step = "finished", None, 0
    try:
        while True:
            time_s = round(step * rates.step_s, 9)
            if steps_a_tick and step and (step % steps_a_tick == 0 or heroes.is_alarmed):
                heroes.tick(time_s)
                if progress is not None:
                    progress(time_s)
            states = {hero.id: heroes.plan.profiles[hero.id].state(time_s) for hero in scene.program.heroes}
            action = ego.decide(time_s, _seen(scene, states), rates.step_s)
            log.add(time_s, ego, states)
            if _is_over(scene, heroes, ego, states, time_s):
                break
            ego.advance(action, rates.step_s)
            step += 1
            heroes.observe((round(step * rates.step_s, 9), ego.s_m, ego.speed_mps, ego.accel_mpss))
    except KeyboardInterrupt:
        if not log.steps:
            raise  # nothing was driven, so nothing is kept
        status = "interrupted"
    except PolicyError as error:
        if not log.steps:
            raise
        status, fault = "failed", error
    knots, findings = dict(heroes.ego_knots_s), list(ego.policy.findings)
    return Run(log.trace(), first_plan, heroes.plan, heroes.records, status, fault, knots, findings)


def _seen(scene: Scene, states: Mapping[int, HeroMotion]) -> tuple[VehicleState, ...]:
    """Return the heroes as the ego sees them: where they are, not where they are going."""
    seen = []
    for hero in scene.program.heroes:
        s_m, speed, accel = states[hero.id]
        x_m, y_m, heading = scene.routes[hero.id].path.pose(s_m)
        seen.append(
            VehicleState(
                hero.name, x_m, y_m, heading, speed, accel, VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, s_m=None, route=None
            )
        )
    return tuple(seen)


class _Log:
    """What happened, step by step. A step that was interrupted while it was written down is left out of the trace."""

    def __init__(self, scene: Scene) -> None:
        self._times: list[float] = []
        self._scene = scene
        self._rows: dict[int, list[tuple[float, ...]]] = {actor.id: [] for actor in scene.program.actors}

    def add(self, time_s: float, ego: EgoVehicle, states: Mapping[int, HeroMotion]) -> None:
        """Write down the state of everybody at the beginning of a step."""
        self._times.append(time_s)
        self._rows[EGO].append((ego.s_m, ego.d_m, *ego.pose, ego.speed_mps, ego.accel_mpss))
        for hero, state in states.items():
            self._rows[hero].append(state)

    @property
    def steps(self) -> int:
        """Number of complete steps."""
        return min(len(self._times), *(len(rows) for rows in self._rows.values()))

    def trace(self) -> Trace:
        """Return all complete steps, of which there must be one."""
        count = self.steps
        time_s, program = np.asarray(self._times[:count]), self._scene.program
        s_m, d_m, x_m, y_m, heading, speed, accel = self._columns(EGO, count)
        actors = {program.ego.name: ActorTrace(time_s, x_m, y_m, heading, speed, accel, s_m, d_m)}
        for hero in program.heroes:
            s_m, speed, accel = self._columns(hero.id, count)
            x_m, y_m, heading = self._scene.routes[hero.id].path.poses(s_m).T[:3]
            actors[hero.name] = ActorTrace(time_s, x_m, y_m, heading, speed, accel, s_m, np.zeros(count))
        return Trace(actors)

    def _columns(self, actor: int, count: int) -> FloatArray:
        """Return one row of numbers a quantity, each contiguous: traces are asked for single states very often."""
        return np.ascontiguousarray(np.asarray(self._rows[actor][:count]).T)


def _is_over(
    scene: Scene, heroes: HeroDriver, ego: EgoVehicle, states: Mapping[int, HeroMotion], time_s: float
) -> bool:
    """Whether all that the program tells of has happened, or will not happen any more."""
    if time_s >= LONGEST_RUN_S:
        return True
    end_m = ego.route.landmarks["route_end"]
    if ego.s_m >= end_m - 3.0:
        return True
    # Whoever is at the end of its route does nothing more that a program asks for; others may.
    going = [heroes.plan.profiles[hero] for hero in states if not _is_at_end(scene, hero, states)]
    last_knot_s = max((max(profile.knot_times_s.values()) for profile in going), default=-_WAIT_FOR_EGO_S)
    if time_s < last_knot_s + _AFTER_HEROES_S:
        return _stalled(heroes, time_s)
    if time_s < last_knot_s + _WAIT_FOR_EGO_S and _any_turning(scene, states):
        return False
    passed = ego.s_m > ego.route.landmarks.get("junction_end", end_m) + 5.0
    return passed or time_s >= last_knot_s + _WAIT_FOR_EGO_S


def _is_at_end(scene: Scene, hero: int, states: Mapping[int, HeroMotion]) -> bool:
    return states[hero][0] >= scene.routes[hero].landmarks["route_end"] - 3.0


def _any_turning(scene: Scene, states: Mapping[int, HeroMotion]) -> bool:
    """Whether a hero is on its way through the junction: which way it went is part of the story."""
    for hero, (s_m, speed_mps, _) in states.items():
        places = scene.routes[hero].landmarks
        end_m = places.get("junction_end")
        if end_m is not None and speed_mps > _MOVES_MPS and places.get("junction_start", end_m) < s_m < end_m:
            return True
    return False


def _stalled(heroes: HeroDriver, time_s: float) -> bool:
    """Whether the ego has stood so long that waiting for it makes no sense."""
    return heroes.ego_stood_s(time_s) > _STALLED_S
