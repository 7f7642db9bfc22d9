"""The built-in simulator by itself: heroes exactly on their motion, the ego where its policy drives it."""

from __future__ import annotations

import pytest

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.motion.profile import Profile, chain
from scenewright.program.types import EGO
from scenewright.simulate.builtin import BuiltIn
from scenewright.simulate.port import Start, on_route
from scenewright.testing import check_simulator
from stories import STORIES, Stage

HERO = 1


class Brakes:
    """A policy that brakes, and keeps what it was shown."""

    shown: Observation

    def reset(self, start: EgoStart) -> None:
        pass

    def step(self, observation: Observation, dt_s: float) -> float:
        self.shown = observation
        return -3.0


POLICY = Brakes()
MOTION = Profile(chain(0.0, 30.0, 8.0, [(9.0, 1.0, 0)]))


@pytest.fixture
def start() -> Start:
    stage = Stage(STORIES["yields, distance"], POLICY)
    return Start.of(stage.scene, stage.ego, (100.0, 0.5), {HERO: MOTION})


@pytest.fixture
def begun(start: Start) -> BuiltIn:
    simulator = BuiltIn()
    simulator.reset(start, 0.1)
    return simulator


@pytest.mark.parametrize("step_s", [0.02, 0.05, 0.1])
def test_it_keeps_the_contract(step_s: float) -> None:
    check_simulator(BuiltIn, step_s)


def test_everybody_is_at_the_start(begun: BuiltIn, start: Start) -> None:
    assert begun.observe() == (0.0, start.first)


def test_heroes_are_exactly_on_the_motion_told_last(begun: BuiltIn, start: Start) -> None:
    route = start.scene.routes[HERO]
    for step in range(1, 31):
        begun.apply({HERO: MOTION})
        begun.step()
        assert begun.observe().actors[HERO] == on_route(route, MOTION.state(round(0.1 * step, 9)))
    begun.apply({HERO: Profile(chain(3.0, *MOTION.state(3.0)[:2], [(5.0, -2.0, 0)]))})
    assert begun.observe().actors[HERO].accel_mps2 == -2.0, "what changes is seen at once"


def test_the_ego_sees_where_heroes_are_and_brakes_to_a_stand(begun: BuiltIn) -> None:
    for _ in range(3):
        begun.apply({HERO: MOTION})
        (other,) = POLICY.shown.others
        hero = begun.observe().actors[HERO]
        assert (other.x_m, other.y_m, other.heading_rad, other.speed_mps, other.accel_mps2) == hero[:5]
        begun.step()
    ego = begun.observe().actors[EGO]
    # From 0.5 to 0.2 m/s in the first step, to a stand in the second.
    assert (ego.s_m, ego.speed_mps) == (pytest.approx(100.0 + 0.1 * (0.35 + 0.1)), 0.0)
