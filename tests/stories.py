"""Scenarios of every kind as programs with their numbers, and ways to drive them with what a test puts in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import pytest

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoPolicy, EgoStart, Observation
from scenewright.motion.limits import Limits, Signs, limits_on
from scenewright.orchestrate import orchestrate
from scenewright.plan.planner import Attempt, Planner
from scenewright.plan.prediction import Driver, Predictor
from scenewright.program.structure import Structure, read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.request import Mode, Request, Result
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.simulate.builtin import BuiltIn
from scenewright.simulate.loop import Rates, Run, simulate
from scenewright.simulate.port import Start
from scenewright.simulate.vehicles import EgoVehicle
from scenewright.solve.arrival import LinearCondition, linear_conditions
from scenewright.solve.plan import Plan

HERO = 1
STEP_S, TICK_S = 0.02, 0.1


def program(hero_route: str, hero_sketch: str, constraints: str, ego_route: str = "W") -> str:
    return (
        f"Actor 0 (ego):\n- {ego_route}\n- [t0, go, t1, go, t2]\n\n"
        f"Actor 1 (hero):\n- {hero_route}\n- [{hero_sketch}]\n\nConstraints:\n{constraints.strip()}\n"
    )


YIELDS_DISTANCE = program(
    "E, N",
    "t0, go, t1, dec, t2",
    """
A0x(t0) == intersection - 90
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 18
A1x(t2) == conflict_point - 6
A1v(t2) == 0
""",
)
YIELDS_TIME = program(
    "S, W",
    "t0, go, t1, dec, t2",
    """
tta(A0, intersection, t0) == 9
A0(t1) == A1(t1)
tta(A0, conflict_point, t1) == 4
tta(A1, stop_line, t1) == 2
A1x(t2) == just before stop_line
A1v(t2) == 0
""",
)
STOPS_AND_GOES = program(
    "W",
    "t0, go, t1, dec, t2, stop, t3, acc, t4",
    """
A0x(t0) == stop_line - 50
A0(t1) == A1(t1)
A0x(t1) == stop_line - 14
A1x(t1) == conflict_point - 22
A1x(t2) == conflict_point - 6
A1v(t2) == 0
A1v(stop) == 0
A1x(t4) == conflict_point
A0x(t2) == turn_start
A1(t4) < A0(t2)
""",
    ego_route="S, W",
)
GOES_FIRST_DISTANCE = program(
    "E, N",
    "t0, go, t1, acc, t2",
    """
A0x(t0) == intersection - 80
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 40
A1x(t1) == conflict_point - 14
A1x(t2) == turn_end
A0x(t2) == conflict_point
A1(t2) < A0(t2)
""",
)
GOES_FIRST_TIME = program(
    "W",
    "t0, go, t1, acc, t2",
    """
tta(A0, stop_line, t0) == 8
A0(t1) == A1(t1)
tta(A0, stop_line, t1) == 3.5
tta(A1, conflict_point, t1) == 2.5
A1x(t2) == conflict_point
A0x(t2) == turn_start
A1(t2) < A0(t2)
""",
    ego_route="S, W",
)
BRAKES_GAP = program(
    "W",
    "t0, go, t1, dec, t2",
    """
A0x(t0) == intersection - 120
A0(t1) == A1(t1)
gap(A0, A1, t1) == 20
A1a(dec) == -3
A1v(t2) == 0
""",
)
# Its trigger tells no distance, so the ego is foreseen as if alone: it would drive into who stops ahead.
STOPS_AHEAD = program(
    "W",
    "t0, dec, t1, stop, t2, acc, t3",
    """
gap(A0, A1, t0) == 15 m
A0v(t0) == 14
A1v(t0) == 14
A1a(dec) == -6
A1v(t1) == 0
A1(t2) - A1(t1) == 3
A1v(t3) == 5
A0(t1) == A1(t2)
""",
)
STORIES = {
    "yields, distance": YIELDS_DISTANCE,
    "yields, time": YIELDS_TIME,
    "stops and goes": STOPS_AND_GOES,
    "goes first, distance": GOES_FIRST_DISTANCE,
    "goes first, time": GOES_FIRST_TIME,
    "brakes at a rate": BRAKES_GAP,
}


def driven(
    story: str, ego: str, seed: int = 0, mode: Mode = "closed", takes: int = 3, replan_hz: float = 10.0
) -> Result:
    """Return a whole run, made once for all tests that look at it, however they ask for it."""
    return _driven(story, ego, seed, mode, takes, replan_hz)


@cache
def _driven(story: str, ego: str, seed: int, mode: Mode, takes: int, replan_hz: float) -> Result:
    return orchestrate(Request(STORIES[story], ego=ego, seed=seed, mode=mode, takes=takes, replan_hz=replan_hz))


def replan_seldom(patch: pytest.MonkeyPatch) -> None:
    """Let runs from now on make plans anew twice a second, however often they are asked to."""

    def rates(replan_s: float | None) -> Rates:
        return Rates(replan_s=None if replan_s is None else max(0.5, replan_s))

    patch.setattr("scenewright.orchestrate.Rates", rates)


@dataclass
class Scripted:
    """An ego without a promise: `accel` gives its acceleration (m/s^2) from the time and its speed."""

    accel: Callable[[float, float], float]

    def reset(self, start: EgoStart) -> None:
        pass

    def step(self, observation: Observation, dt_s: float) -> float:
        return self.accel(observation.time_s, observation.ego.speed_mps)


class Stage:
    """A story on its map, with the ego's policy and predictor of a test's choice."""

    def __init__(self, text: str, policy: EgoPolicy, *, seed: int = 0, predictor: Predictor | None = None) -> None:
        parsed = parse_program(text, "story")
        self.scene: Scene = ground(parsed, load_map(parsed.map_name), {})
        self.structure: Structure = read_structure(parsed)
        self.limits: dict[int, Limits] = {i: limits_on(r, self.scene.road_map) for i, r in self.scene.routes.items()}
        self.conditions: tuple[LinearCondition, ...] = linear_conditions(self.scene, self.structure)
        self.ego = EgoVehicle(GuardedPolicy(policy, "ego"), self.scene.routes[EGO], self.scene.road_map, seed)
        predictor = predictor or Driver.on(
            self.scene.routes[EGO], Signs.of(self.scene.routes[EGO], self.scene.road_map)
        )
        self.planner = Planner(self.scene, self.structure, self.limits, predictor, self.conditions)
        self.plans: list[Plan] = []
        self.first = (0.0, 0.0)

    def begin(self, s_m: float, speed_mps: float) -> Attempt:
        self.first = (s_m, speed_mps)
        return self.planner.begin((0.0, s_m, speed_mps, 0.0))

    def run(self, tick_s: float = TICK_S) -> Run:
        """Drive; `plans` holds the plan in force after every tick, the first one at the front."""
        self.plans = [self.planner.plan]
        return simulate(
            BuiltIn(),
            Start.of(self.scene, self.ego, self.first, self.planner.plan.profiles),
            self.planner,
            Rates(STEP_S, tick_s),
            lambda _: self.plans.append(self.planner.plan),
        )
