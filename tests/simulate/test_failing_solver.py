"""A solver that fails: the last plan goes on, the record says how far off it is, and a car drives it to its end."""

from __future__ import annotations

from itertools import count
from typing import Any

import daqp
import numpy as np
import pytest

from scenewright.drive.hostile import Noisy
from scenewright.orchestrate import orchestrate
from scenewright.request import Request
from stories import HERO, STORIES, Stage

STORY = STORIES["yields, distance"]


def failing(monkeypatch: pytest.MonkeyPatch, every: int = 1) -> None:
    """Let the solver fail always, or at all but one of so many calls."""
    honest, calls = daqp.solve, count()

    def solve(*words: Any, **settings: Any) -> Any:
        x, cost, flag, told = honest(*words, **settings)
        return (x, cost, flag, told) if every > 1 and next(calls) % every == 0 else (x, cost, -1, told)

    monkeypatch.setattr(daqp, "solve", solve)


def on_stage() -> Stage:
    """An ego whose unsteady foot makes re-solving necessary at almost every tick."""
    stage = Stage(STORY, Noisy(sigma_mpss=0.8), seed=3)
    assert stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 12.0).is_good
    return stage


def test_the_last_plan_goes_on_where_nothing_better_is_ever_found(monkeypatch: pytest.MonkeyPatch) -> None:
    stage = on_stage()
    failing(monkeypatch)
    run = stage.run()
    assert run.status == "finished"
    hero = run.trace.actors["hero"]
    trigger_s = min(plan.profiles[HERO].knot_times_s["t1"] for plan in stage.plans)
    until = hero.time_s < trigger_s - 2.0
    planned = [run.first_plan.profiles[HERO].state(float(t))[0] for t in hero.time_s[until]]
    assert hero.s_m[until] == pytest.approx(np.array(planned), abs=3.0), "at another time, but as it was planned"
    assert np.all(np.diff(hero.speed_mps) <= 4.0 * 0.02 + 1e-6)
    assert np.all(np.diff(hero.speed_mps) >= -8.0 * 0.02 - 1e-6)
    assert any(record.status == "relaxed" for record in run.replans), "what is missed is told"


def test_one_that_fails_now_and_then_is_listened_to_when_it_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    stage = on_stage()
    failing(monkeypatch, every=3)
    run = stage.run()
    solved = [record for record in run.replans if record.status != "frozen"]
    assert len(solved) > 20
    assert solved[-1].tolerance < 2.0


@pytest.mark.usefixtures("searched_less")
def test_gives_up_and_drives_nothing_where_no_plan_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    failing(monkeypatch)
    result = orchestrate(Request(STORY, ego="idm"))
    assert result.status == "gave up"
    assert result.feasibility is not None
    assert result.feasibility.answer == "undecided"
    assert (result.run, result.verdict, result.run_directory) == (None, None, None)
    assert result.not_held
