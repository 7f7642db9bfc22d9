"""What stays the same all through a request: the ego's promises, how it is foreseen, and values of parameters."""

from __future__ import annotations

import pytest

from scenewright.errors import ScenewrightError
from scenewright.orchestrate import orchestrate
from scenewright.plan.prediction import ConstantSpeed
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.request import Request
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.simulate.loop import Rates
from scenewright.simulate.world import World
from scenewright.solve.feasibility import EgoBounds
from stories import STORIES

OPEN = "parameters:\n- far_m in [20, 40]\n\n" + STORIES["yields, distance"].replace(
    "conflict_point - 30", "conflict_point - far_m"
)


def world(ego: str, text: str = STORIES["yields, distance"], rates: Rates | None = None) -> World:
    return World(ground(parse_program(text), load_map("t_intersection")), ego, 0, rates or Rates())


def test_a_promise_bounds_the_ego() -> None:
    steady = world("constant").ego_bounds
    assert steady.holds_speed
    assert not world("idm").ego_bounds.holds_speed
    assert world("idm").ego_bounds.accel_max_mpss < EgoBounds().accel_max_mpss


FAST = STORIES["yields, distance"] + "A0v(t0) == 13\n"


@pytest.mark.parametrize("ego", ["constant:speed_mps=8", "idm:speed_mps=8"])
def test_an_ego_that_is_told_to_start_faster_than_it_would_drive_slows_down(ego: str) -> None:
    bounds = world(ego, FAST).ego_bounds
    assert (bounds.speed_max_mps, bounds.holds_speed) == (13.0, False)
    assert bounds.brake_max_mpss >= 2.0
    assert world(ego, FAST).choose_and_check().answer == "feasible"
    assert orchestrate(Request(FAST, ego=ego, explain="nothing")).status == "success"


@pytest.mark.parametrize("bound", ["A0v(t0) >= 13", "A0v(t0) > 13", "A0v(t0) >= 13\nA0v(t0) <= 14"])
@pytest.mark.parametrize("ego", ["constant:speed_mps=8", "idm:speed_mps=8"])
def test_likewise_where_a_bound_has_it_start_faster(ego: str, bound: str) -> None:
    text = FAST.replace("A0v(t0) == 13", bound)
    assert world(ego, text).choose_and_check().answer == "feasible"
    assert world(ego, FAST.replace("== 13", ">= 5")).ego_bounds == world(ego).ego_bounds


def test_one_that_starts_as_it_drives_promises_what_it_did() -> None:
    assert world("constant:speed_mps=13", FAST).ego_bounds == EgoBounds(13.0, 0.0, 0.0, True)
    assert world("constant", FAST).ego_bounds == world("constant").ego_bounds


@pytest.mark.parametrize(
    ("ego", "rates", "steady"),
    [("constant", Rates(), True), ("idm", Rates(), False), ("idm", Rates(replan_s=None), True)],
    ids=["holds its speed", "may change it", "nobody looks again"],
)
def test_who_is_sure_to_hold_its_speed_is_foreseen_so(ego: str, rates: Rates, steady: bool) -> None:
    assert isinstance(world(ego, rates=rates).predictor, ConstantSpeed) is steady


def test_open_parameters_get_values_within_their_ranges_and_the_scene_has_them_then() -> None:
    made = world("idm", OPEN)
    assert made.scene.open_parameters()
    assert made.choose_and_check().answer == "feasible"
    assert not made.scene.open_parameters()
    assert 20 <= made.scene.parameters["far_m"] <= 40


def test_limits_are_those_of_each_route() -> None:
    made = world("constant")
    assert set(made.limits) == set(made.scene.routes)
    assert made.limits[1].turn_speed_max_mps < made.limits[EGO].turn_speed_max_mps, "the hero turns"


@pytest.mark.parametrize("what", ["ego", "predictor", "simulator"])
def test_what_is_not_there_is_refused(what: str) -> None:
    scene = world("constant").scene
    asked = {"ego": "constant"} | {what: "nobody"}
    with pytest.raises(ScenewrightError):
        World(scene, asked.pop("ego"), 0, Rates(), **asked)
