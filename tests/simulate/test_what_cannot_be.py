"""What cannot happen is proven and not driven; what an ego denied is told apart from what was missed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from scenewright.orchestrate import EXIT_STATUS, Request, Stages, orchestrate, set_up
from scenewright.simulate.hindsight import drive_profile, ego_left_no_room
from scenewright.solve.feasibility import check_feasibility
from stories import HERO, STORIES, Scripted, Stage, driven

TOO_FAST = STORIES["yields, distance"].replace(
    "A1x(t2) == conflict_point - 6", "fast: A1v(t1) == 14\nstops: A1x(t2) == conflict_point - 17"
)


@pytest.mark.parametrize("ego", ["constant", "idm", "speeder"])
def test_impossible_scenario_is_proven_and_not_driven(ego: str, tmp_path: Path) -> None:
    result = orchestrate(Request(TOO_FAST, ego=ego, out=tmp_path / "run"))
    assert (result.status, EXIT_STATUS[result.status]) == ("infeasible", 3)
    assert (result.attempt, result.run, result.verdict, result.run_directory) == (None, None, None, None)
    assert list((tmp_path / "run").iterdir()) == []
    assert result.feasibility is not None
    named = {clash.id for clash in result.feasibility.clashes}
    assert {"fast"} <= named, "14 m/s is more than the hero's turn admits"
    assert not named & {"c1"}, "where the ego starts has nothing to do with it"
    assert "A1v(t1) == 14" in result.feasibility.explain()


def answer(text: str) -> str:
    """Return whether it can happen, without asking why not."""
    world, _ = set_up(Request(text, ego="idm"), Stages(None))
    return check_feasibility(world.scene, world.structure, world.limits, world.ego_bounds, explain=False).answer


def test_every_suggestion_makes_it_possible() -> None:
    text = STORIES["yields, distance"].replace("conflict_point - 6", "conflict_point - 17.6\nA1v(t1) == 4")
    result = orchestrate(Request(text, ego="idm"))
    assert result.feasibility is not None
    assert len(result.feasibility.suggestions) == 3
    for suggestion in result.feasibility.suggestions:
        number, formula = suggestion.what.split(" in ")
        assert float(number) == suggestion.value
        assert formula in text
        mended = text.replace(formula, f"{formula.removesuffix(number)}{suggestion.nearest}")
        assert answer(mended) == "feasible"
        further = suggestion.nearest + 0.05 * (suggestion.value - suggestion.nearest)
        short = text.replace(formula, f"{formula.removesuffix(number)}{further:.4f}")
        assert answer(short) == "infeasible"


def rushing(at_s: float) -> Scripted:
    return Scripted(lambda time_s, speed_mps: 7.0 if time_s > at_s and speed_mps < 20.0 else 0.0)


def test_ego_that_rushes_off_left_no_room() -> None:
    trigger_s = None
    proofs = []
    for _ in range(2):
        stage = Stage(STORIES["stops and goes"], rushing(np.inf if trigger_s is None else trigger_s + 0.1))
        stop_line_m = stage.scene.landmarks_m[0]["stop_line"]
        assert stage.begin(stop_line_m - 50.0, 3.0).is_good
        run = stage.run()
        trigger_s = run.last_plan.profiles[HERO].knot_times_s["t1"]
        proofs.append(ego_left_no_room(stage.scene, stage.structure, stage.limits, run.trace))
    assert proofs[0] is None, "the ego that goes on at 3 m/s leaves plenty"
    assert proofs[1] is not None
    named = [str(clash) for clash in proofs[1].clashes]
    assert any("A1(t4) < A0(t2)" in clash for clash in named)


def test_ego_that_never_comes_to_its_place_is_the_judges_finding() -> None:
    stage = Stage(STORIES["stops and goes"], Scripted(lambda time_s, speed_mps: -2.0 if time_s > 3.0 else 0.0))
    assert stage.begin(stage.scene.landmarks_m[0]["stop_line"] - 50.0, 6.0).is_good
    run = stage.run()
    assert run.trace.actors["ego"].s_m[-1] < stage.scene.landmarks_m[0]["stop_line"] - 14.0
    assert ego_left_no_room(stage.scene, stage.structure, stage.limits, run.trace) is None


def test_hindsight_reaches_the_result_of_a_whole_run() -> None:
    result = driven("stops and goes", "speeder", takes=1)
    assert result.status == "failure"
    assert result.hindsight is not None
    assert result.hindsight.answer == "infeasible"
    assert result.verdict is not None
    assert result.verdict.cause is not None
    assert result.verdict.cause.kind == "ego"


def test_drive_is_read_back_from_its_trace() -> None:
    stage = Stage(STORIES["yields, distance"], Scripted(lambda time_s, speed_mps: np.sin(time_s)))
    assert stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 9.0).is_good
    ego = stage.run().trace.actors["ego"]
    profile = drive_profile(ego)
    for index in range(0, len(ego.time_s) - 10, 7):
        s_m, speed_mps, _ = profile.state(float(ego.time_s[index]))
        assert s_m == pytest.approx(ego.s_m[index], abs=0.005)
        assert speed_mps == pytest.approx(ego.speed_mps[index], abs=0.02)
