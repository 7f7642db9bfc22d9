"""Takes: they go on until one is as good as was asked for, and natural; the best is kept."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.explain.approach import approach_of
from scenewright.judge.tolerance import LEVELS
from scenewright.orchestrate import orchestrate
from scenewright.request import Request, Result
from scenewright.takes import how_next, is_enough, worth
from stories import STORIES

pytestmark = pytest.mark.usefixtures("replanned_seldom")


class Halts:
    """An ego that halts for some seconds in the middle of nowhere, but where it is alone."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        if observation.others and 2.0 < observation.time_s < 8.0:
            return -4.0 if observation.ego.speed_mps > 0.1 else 0.0
        return 2.0 if observation.ego.speed_mps < 10.0 else 0.0


ASKED = Request(STORIES["goes first, distance"], ego=f"{__name__}:Halts")


@cache
def as_asked() -> Result:
    """Return the run, made once for all tests that look at it."""
    return orchestrate(ASKED)


def unnatural(result: Result) -> list[str]:
    assert result.run is not None
    assert result.verdict is not None
    return approach_of(result.scene, result.run.trace, result.verdict.facts).unnatural


def test_a_success_that_nobody_would_drive_so_is_taken_again() -> None:
    first = orchestrate(replace(ASKED, takes=1))
    assert first.status == "success"
    assert unnatural(first)
    assert first.run is not None
    assert set(unnatural(first)) <= set(first.run.findings), "what is left of it is told"
    best = as_asked()
    assert (best.status, unnatural(best)) == ("success", [])
    assert best.take == len(best.takes) > 1
    assert worth(ASKED, best) > worth(ASKED, first)
    assert is_enough(ASKED, best)
    assert not is_enough(ASKED, first)


def test_an_aim_beyond_what_decides_changes_takes_and_no_verdict() -> None:
    aimed = orchestrate(replace(ASKED, aim="fine"))
    assert aimed.status == as_asked().status == "success"
    assert len(aimed.takes) >= len(as_asked().takes)
    held = [sum(take.verdict.holds_at(level) for level in LEVELS.values()) for take in aimed.takes]
    assert held[aimed.take - 1] == max(held)


@pytest.mark.parametrize(("late_s", "begins_mps"), [(0.6, 8.0), (2.0, 4.0)])
def test_whoever_only_came_late_has_an_ego_that_begins_slower(late_s: float, begins_mps: float) -> None:
    result = orchestrate(Request(STORIES["goes first, distance"], takes=1))
    assert result.verdict is not None
    late = next(each for each in result.verdict.conditions if each.kind == "outcome")
    conditions = tuple(
        replace(each, error=late_s, miss=None) if each is late else each for each in result.verdict.conditions
    )
    result.verdict, result.status = replace(result.verdict, conditions=conditions), "failure"
    assert next(iter(how_next(result, 2, 8.0))) == (begins_mps, 1.0, True)
