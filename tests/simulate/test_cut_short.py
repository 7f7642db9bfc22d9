"""Runs that end early: by a policy's fault or the user's wish, what was driven is kept, readable and judged."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from misbehaving import LATE_S

from scenewright.errors import PolicyError
from scenewright.judge.files import judge_run_directory
from scenewright.judge.tolerance import LOOSE
from scenewright.orchestrate import orchestrate
from scenewright.request import EXIT_STATUS, Request, Result
from scenewright.trace.files import read_trace
from stories import STORIES

FILES = {
    "manifest.json", "program.scene", "params.json", "plan.json", "trace.parquet", "replans.parquet", "verdict.json",
    "index.html",
}  # fmt: skip


def run(ego: str, out: Path | None = None, story: str = "yields, distance") -> Result:
    return orchestrate(Request(STORIES[story], ego=ego, out=out, replan_hz=2.0))


def check_kept(out: Path, until_s: float) -> None:
    assert {path.name for path in out.iterdir()} == FILES
    trace = read_trace(out / "trace.parquet")
    assert set(trace.actors) == {"ego", "hero"}
    assert trace.duration_s == pytest.approx(until_s)
    assert all(np.all(np.isfinite(actor.s_m)) for actor in trace.actors.values())
    verdict = judge_run_directory(out)
    assert json.loads((out / "verdict.json").read_text(encoding="utf-8")) == verdict.as_dict()
    assert not verdict.holds_at(LOOSE), "the trigger had not come yet"


@pytest.mark.parametrize(
    ("policy", "found"),
    [
        ("Raises", "ZeroDivisionError: no more fuel"),
        ("ReturnsNaN", "nan"),
        ("ReturnsNothing", "None"),
        ("Teleports", "40.00 m from where the ego was"),
    ],
)
def test_fault_of_the_policy_fails_the_run_and_keeps_it(tmp_path: Path, policy: str, found: str) -> None:
    result = run(f"misbehaving:{policy}", tmp_path / "run")
    assert (result.status, EXIT_STATUS[result.status]) == ("failed", 2)
    assert result.run is not None
    assert (result.run.status, type(result.run.fault)) == ("failed", PolicyError)
    assert result.hindsight is None
    check_kept(tmp_path / "run", LATE_S - 0.02)
    manifest = json.loads((tmp_path / "run" / "manifest.json").read_text(encoding="utf-8"))
    assert manifest["status"] == "failed"
    assert found in manifest["fault"]
    assert f"misbehaving:{policy}" in manifest["fault"]
    assert "3.00 s" in manifest["fault"]


def test_ego_that_drifts_off_is_stopped_where_it_left_its_route(tmp_path: Path) -> None:
    result = run("misbehaving:LeavesItsRoute", tmp_path / "run")
    assert result.run is not None
    assert "left its route" in str(result.run.fault)
    beside_m = read_trace(tmp_path / "run" / "trace.parquet").actors["ego"].d_m
    assert 4.0 < np.max(np.abs(beside_m)) <= 5.0


def test_interrupted_run_is_kept_and_can_be_judged(tmp_path: Path) -> None:
    result = run("misbehaving:IsInterrupted", tmp_path / "run")
    assert (result.status, EXIT_STATUS[result.status]) == ("interrupted", 130)
    assert result.run_directory == tmp_path / "run"
    check_kept(tmp_path / "run", LATE_S - 0.02)
    manifest = json.loads((tmp_path / "run" / "manifest.json").read_text(encoding="utf-8"))
    assert (manifest["status"], manifest["fault"]) == ("interrupted", None)


@pytest.mark.parametrize(("policy", "error"), [("Raises", PolicyError), ("IsInterrupted", KeyboardInterrupt)])
def test_where_nothing_was_driven_nothing_is_kept(tmp_path: Path, policy: str, error: type[BaseException]) -> None:
    with pytest.raises(error):
        run(f"misbehaving:{policy}:after_s=0.0", tmp_path / "run")
    assert list((tmp_path / "run").iterdir()) == []


def test_fault_after_the_trigger_leaves_what_held_standing(tmp_path: Path) -> None:
    result = run("misbehaving:Raises:after_s=6.0", tmp_path / "run")
    assert result.run is not None
    assert result.run.last_plan.profiles[1].knot_times_s["t1"] < 6.0
    verdict = judge_run_directory(tmp_path / "run")
    assert {c.kind for c in verdict.conditions if c.kind == "trigger" and c.holds_at(LOOSE)} == {"trigger"}
    assert result.status == "failed"


def test_ego_with_a_vehicle_model_of_its_own_takes_part() -> None:
    result = run("misbehaving:Drives")
    assert result.status == "success"
    assert result.run is not None
    ego = result.run.trace.actors["ego"]
    assert np.allclose(ego.speed_mps, 9.0)
    assert np.allclose(np.diff(ego.s_m), 9.0 * 0.02, atol=1e-4)
