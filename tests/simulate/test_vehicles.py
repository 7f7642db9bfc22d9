"""The ego as its policy drives it: where accelerations and motions take it, and what it is shown."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoMotion, EgoStart, Observation
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.simulate.port import on_route
from scenewright.simulate.vehicles import EgoVehicle, seen
from stories import HERO, STORIES

STEP_S = 0.02
SCENE: Scene = ground(parse_program(STORIES["yields, distance"]), load_map("t_intersection"))


class Does:
    """Does what it is told, and keeps what it is shown."""

    def __init__(self, *actions: float | EgoMotion) -> None:
        self.actions, self.shown, self.start = list(actions), list[Observation](), None

    def reset(self, start: EgoStart) -> None:
        self.start = start

    def step(self, observation: Observation, dt_s: float) -> float | EgoMotion:
        self.shown.append(observation)
        return self.actions[(len(self.shown) - 1) % len(self.actions)]


def driven(policy: Does, speed_mps: float, steps: int) -> EgoVehicle:
    ego = EgoVehicle(GuardedPolicy(policy, "does"), SCENE.routes[EGO], SCENE.road_map, seed=7)
    ego.reset(100.0, speed_mps)
    for step in range(steps):
        ego.advance(ego.decide(step * STEP_S, (), STEP_S), STEP_S)
    return ego


@given(st.floats(0.0, 20.0), st.floats(-8.0, 4.0))
def test_an_acceleration_is_integrated_exactly_and_nobody_rolls_back(speed_mps: float, accel_mpss: float) -> None:
    ego, lasts_s = driven(Does(accel_mpss), speed_mps, 100), 2.0
    stands_s = -speed_mps / accel_mpss if accel_mpss < 0.0 else math.inf
    moves_s = min(lasts_s, stands_s)
    assert ego.state.speed_mps == pytest.approx(max(0.0, speed_mps + accel_mpss * lasts_s), abs=1e-9)
    # In the step in which it comes to stand it brakes more gently, to stand at its end.
    room_m = 0.5 * abs(accel_mpss) * STEP_S**2 if stands_s < lasts_s else 0.0
    way_m = speed_mps * moves_s + 0.5 * accel_mpss * moves_s**2
    assert -1e-6 <= ego.state.s_m - 100.0 - way_m <= room_m + 1e-6


def test_a_motion_of_its_own_puts_it_there() -> None:
    x_m, y_m, heading_rad = SCENE.routes[EGO].path.to_cartesian(101.0, 0.5)
    ego = driven(Does(EgoMotion(x_m, y_m, heading_rad, 9.0)), 8.0, 1)
    assert (ego.state.s_m, ego.state.d_m) == (pytest.approx(101.0, abs=1e-6), pytest.approx(0.5, abs=1e-6))
    assert (ego.state.speed_mps, ego.state.accel_mps2) == (9.0, pytest.approx(1.0 / STEP_S))


@pytest.mark.parametrize("s_m", [101.0, SCENE.routes[EGO].path.length_m])
def test_beside_its_line_an_acceleration_takes_it_on_and_not_back_onto_the_line(s_m: float) -> None:
    x_m, y_m, heading_rad = SCENE.routes[EGO].path.to_cartesian(s_m, 0.5)
    ego = EgoVehicle(GuardedPolicy(Does(0.0), "does"), SCENE.routes[EGO], SCENE.road_map, seed=7)
    ego.reset(s_m, 9.0)
    ego.advance(EgoMotion(x_m, y_m, heading_rad, 9.0), STEP_S)
    ego.advance(ego.decide(STEP_S, (), STEP_S), STEP_S)
    assert ego.state.d_m == pytest.approx(0.5, abs=1e-6)
    assert math.hypot(ego.state.x_m - x_m, ego.state.y_m - y_m) == pytest.approx(9.0 * STEP_S, rel=1e-3)


def test_it_is_told_where_it_starts_and_shown_itself_with_its_route() -> None:
    policy = Does(0.0)
    driven(policy, 6.0, 3)
    assert policy.start is not None
    assert (policy.start.s_m, policy.start.speed_mps, policy.start.seed) == (100.0, 6.0, 7)
    shown = policy.shown[-1].ego
    assert (shown.route, shown.s_m) == (SCENE.routes[EGO], pytest.approx(100.0 + 6.0 * 2 * STEP_S))


def test_others_are_shown_without_where_they_are_going() -> None:
    state = on_route(SCENE.routes[HERO], (50.0, 7.0, -1.0))
    (other,) = seen(SCENE, {HERO: state})
    assert (other.s_m, other.route) == (None, None)
    assert (other.x_m, other.y_m, other.speed_mps, other.accel_mps2) == (state.x_m, state.y_m, 7.0, -1.0)


def test_beyond_its_road_it_drives_straight_on_unasked() -> None:
    policy = Does(-1.0)
    ego = EgoVehicle(GuardedPolicy(policy, "does"), SCENE.routes[EGO], SCENE.road_map, seed=7)
    end_m = SCENE.routes[EGO].path.length_m
    ego.reset(end_m + 5.0, 8.0)
    ego.advance(ego.decide(0.0, (), STEP_S), STEP_S)
    assert not policy.shown
    assert (ego.state.speed_mps, ego.state.accel_mps2) == (8.0, 0.0)
    assert ego.state.s_m == pytest.approx(end_m + 5.0 + 8.0 * STEP_S)
