"""Planning problems of every kind, as the planner poses them: first plans, and ticks on the way."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from scenewright.motion.limits import Signs, limits_on
from scenewright.plan.asked import Asked
from scenewright.plan.planner import Planner
from scenewright.plan.prediction import Driver
from scenewright.plan.problem import Problem
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.arrival import linear_conditions
from stories import STORIES

Array = NDArray[np.float64]
HERO = 1
EGO_S_M, EGO_MPS = 180.0, 9.0
WAITS_TWICE = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, stop, t1, go, t2, dec, t3]

Constraints:
A0(t1) == A1(t2)
A0x(t1) == conflict_point - 25
A1x(t2) == conflict_point - 18
A1x(t3) == conflict_point - 6
A1v(t3) == 0
A1v(3.5) >= 2
"""
AT_TIMES = (
    STORIES["yields, distance"] + "A1v(2.0) == 4\nA1v(A0(t2)) == 0\nA1x(1.5) <= conflict_point - 25\nA1a(t1) <= -1\n"
)
LEFT_OPEN = (
    STORIES["yields, distance"]
    .replace("intersection - 90", "intersection - begins_m")
    .replace("point - 30", "point - ego_m")
    .replace("point - 18", "point - hero_m")
)
PROGRAMS = {**STORIES, "waits twice": WAITS_TWICE, "at times": AT_TIMES, "left open": LEFT_OPEN}
TABLE = [(name, at_s) for name in PROGRAMS for at_s in (0.0, 1.2)]
every_problem = pytest.mark.parametrize(("name", "at_s"), TABLE)


def scene_of(text: str) -> Scene:
    program = parse_program(text)
    return ground(program, load_map(program.map_name), {})


def asked_of(scene: Scene) -> Asked:
    limits = {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}
    return Asked(scene, read_structure(scene.program), limits)


def planner_of(scene: Scene) -> Planner:
    """Return a planner that has not begun."""
    structure = read_structure(scene.program)
    limits = {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}
    predictor = Driver.on(scene.routes[EGO], Signs.of(scene.routes[EGO], scene.road_map))
    return Planner(scene, structure, limits, predictor, linear_conditions(scene, structure))


@cache
def begun(text: str, s_m: float = EGO_S_M, speed_mps: float = EGO_MPS) -> Planner:
    """Return a planner with a first plan. It is shared by tests: they look at it only."""
    planner = planner_of(scene_of(text))
    planner.begin((0.0, s_m, speed_mps, 0.0))
    return planner


@cache
def problem_of(text: str, at_s: float = 0.0, s_m: float = EGO_S_M) -> Problem:
    """Return the problem of a first plan, or that of a tick with the ego a metre further on than foreseen."""
    planner = planner_of(scene_of(text))
    planner.begin((0.0, s_m, EGO_MPS, 0.0))
    if not at_s:
        situation = planner._first_situation(planner.plan.profiles[EGO], planner.plan.profiles)
        return Problem(planner._asked, situation)
    ego = planner.plan.profiles[EGO]
    for k in range(1, round(at_s / 0.02) + 1):
        s_m, speed_mps, accel_mpss = ego.state(0.02 * k)
        planner.observe((round(0.02 * k, 9), s_m + 0.02 * k / at_s, speed_mps, accel_mpss))
    situation, _ = planner._situation(at_s, planner._ego.foreseen(planner.plan.profiles))
    return Problem(planner._asked, situation)


def near(problem: Problem, seed: int, share: float = 0.15) -> Array:
    """Return values at random around first ones."""
    chance = np.random.default_rng(seed)
    return problem.ordered(problem.guess + share * problem.step * chance.uniform(-1.0, 1.0, problem.size))


def driven_on(planner: Planner, from_s: float, to_s: float, faster_mps: float = 0.0, mpss: float = 0.0) -> float:
    """Let the ego drive on, somewhat faster than foreseen at first; return its speed."""
    _, s_m, speed_mps, _ = planner._ego.samples[-1]
    speed_mps += faster_mps
    for k in range(1, round((to_s - from_s) / 0.02) + 1):
        s_m += (speed_mps + 0.01 * mpss) * 0.02
        speed_mps += 0.02 * mpss
        planner.observe((round(from_s + 0.02 * k, 9), s_m, speed_mps, mpss))
    return speed_mps
