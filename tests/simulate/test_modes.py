"""Open and closed loop on the four descriptions with which the paper compares the two.

Where ways cross there is no time to collision as they stand: the second speaks of the ego's time to arrival instead.
"""

from __future__ import annotations

from functools import cache

import pytest

from scenewright.judge.tolerance import TIGHT
from scenewright.orchestrate import orchestrate
from scenewright.request import Mode, Request, Result
from stories import HERO

ROAD = (
    "Ego is lane-following straight along the road at 9m/s. There is a driveway 100m in front of the ego that merges "
    "into the ego's lane. "
)
PAPER = {
    "lead turns": ROAD
    + "There is a lead vehicle that is initially driving at 8m/s. When the lead vehicle is 20m ahead "
    "of the ego, it turns right into the driveway and gradually comes to a stop.",
    "oncoming turns": ROAD
    + "There is a car in the oncoming lane driving straight. When the ego is 3s from the conflict "
    "point, the car should turn left across the ego's path and into the driveway.",
    "turns into path": ROAD + "There is a car on the driveway that turns right into the ego's lane when the ego is "
    "about 4s away from the driveway. After turning right, the car starts lane-following straight at 8m/s.",
    "turns across path": ROAD + "There is a car on the driveway that turns left across the ego's path onto the ego's "
    "oncoming lane when the ego is about 4s away from the driveway.",
}


@cache
def run(name: str, mode: Mode, ego: str = "dawdler") -> Result:
    return orchestrate(Request(PAPER[name], ego=ego, mode=mode, seed=1, takes=1, explain="nothing", replan_hz=2.0))


def off_at_trigger(result: Result) -> float:
    """Return how far off the worst condition of the trigger is, in tight tolerances."""
    assert result.verdict is not None
    return max(c.normalised_error(TIGHT) for c in result.verdict.conditions if c.kind == "trigger")


@pytest.mark.parametrize("name", PAPER)
def test_open_loop_is_carried_out_as_it_was_first_planned(name: str) -> None:
    result = run(name, "open")
    assert result.run is not None
    assert [record.time_s for record in result.run.replans] == [0.0]
    assert result.run.last_plan is result.run.first_plan
    hero = result.run.trace.actors[result.scene.program.actor(HERO).name]
    planned = result.run.first_plan.profiles[HERO]
    assert [planned.state(time_s)[0] for time_s in hero.time_s] == hero.s_m.tolist()


@pytest.mark.parametrize("name", PAPER)
def test_open_loop_does_where_the_ego_does_what_was_planned_for(name: str) -> None:
    assert run(name, "open", "constant").status == "success"


@pytest.mark.parametrize("name", PAPER)
def test_closed_loop_comes_nearer_than_open_loop(name: str) -> None:
    assert off_at_trigger(run(name, "closed")) < off_at_trigger(run(name, "open"))


def test_closed_loop_succeeds_where_open_loop_does_not() -> None:
    closed, opened = ([run(name, mode).status for name in PAPER] for mode in ("closed", "open"))
    assert opened.count("success") == 0
    assert closed.count("success") >= 3
