"""The paper's own loop: it plans, answers the ego, gives way by tolerances, and says what it cannot do."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from situations import HERO

from scenarios import YIELDS, limits_of
from scenewright.orchestrate import orchestrate
from scenewright.plan import smt
from scenewright.plan.smt import SmtPlanner
from scenewright.program.types import EGO
from scenewright.request import Request, Result
from scenewright.solve.proofs.events import EgoBounds

SENTENCE = (
    "The ego is on the road, 120 m behind the intersection. When the ego is 30 m before the conflict point and an "
    "oncoming car that wants to turn left is 15 m before the conflict point, the oncoming car brakes to a complete "
    "stop 8 m before the conflict point."
)


def driven(out: Path | None = None, **settings: object) -> Result:
    return orchestrate(replace(Request(SENTENCE, ego="constant", planner="smt", out=out), **settings))  # type: ignore[arg-type]


def test_a_sentence_is_driven_as_described_and_again_to_the_byte(tmp_path: Path) -> None:
    results = [driven(tmp_path / name) for name in ("a", "b")]
    assert [result.status for result in results] == ["success", "success"]
    sums = [hashlib.sha256((tmp_path / name / "trace.parquet").read_bytes()).hexdigest() for name in ("a", "b")]
    assert sums[0] == sums[1]
    assert '"planner": "smt"' in (tmp_path / "a" / "manifest.json").read_text(encoding="utf-8")
    assert results[0].run is not None
    assert {record.backend for record in results[0].run.replans} == {"z3", ""}  # asked at every tick until all is over


def test_no_first_plan_is_an_answer_with_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(smt, "WORK_PER_S", 1)
    result = driven()
    assert (result.status, result.run, result.attempt) == ("gave up", None, None)
    assert "z3 gave up" in result.no_plan


def test_a_first_plan_that_cannot_be_names_what_clashes() -> None:
    planner = planner_of(YIELDS.text + "\nA1(t2) <= 0.1 s")
    assert planner.begin((0.0, 180.0, 9.0, 0.0)) is None
    assert "the hero finishes braking at most 0.1 s after the start" in planner.why


# -- tolerances -------------------------------------------------------------------------------------------------------
def planner_of(text: str, ego: EgoBounds | None = None) -> SmtPlanner:
    scene = replace(YIELDS, text=text).scene()
    return SmtPlanner(scene, limits_of(scene), ego or EgoBounds())


def test_an_ego_off_its_drive_costs_tolerance_and_not_the_plan() -> None:
    planner = planner_of(YIELDS.text, EgoBounds(accel_max_mpss=0.1, brake_max_mpss=0.1))
    assert planner.begin((0.0, 180.0, 9.0, 0.0)) is not None
    trigger_s = planner.plan.profiles[HERO].knot_times_s["t1"]
    now_s = trigger_s - 0.3
    for ahead_m, status in ((0.0, "sat"), (1.0, "relaxed"), (30.0, "unsat")):
        before = planner.plan
        planner.observe((now_s, 180.0 + 9.0 * now_s + ahead_m, 9.0, 0.0))
        record = planner.tick(now_s)
        assert record.status == status, record
        assert (record.tolerance > 0) == (status != "sat")
        if status == "relaxed":
            assert record.reason.startswith("refuted at 0")
        if status == "unsat":
            assert planner.plan is before  # what is in force goes on
        assert (record.foreseen is None) == (status == "unsat")  # and foresaw nothing now


# -- what it does not take --------------------------------------------------------------------------------------------
def test_what_cannot_be_lowered_is_refused_by_name() -> None:
    product = "A1x(t1) * A1v(t1) * A1v(t2) == 0"
    source = f"{YIELDS.text}\n{product}\n"
    result = orchestrate(Request(source, YIELDS.parameters, ego="constant", planner="smt"))
    assert (result.status, result.run) == ("gave up", None)
    assert f"cannot take {product} (it multiplies" in result.no_plan


def test_it_is_loaded_only_where_it_is_asked_for() -> None:
    code = "import sys, scenewright.study.rivals.methods\nprint('scenewright.plan.smt' in sys.modules)"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "False"


def test_the_ego_passes_its_knots_when_the_plan_says() -> None:
    planner = planner_of(YIELDS.text)
    planner.begin((0.0, 180.0, 9.0, 0.0))
    planner.observe((60.0, 300.0, 0.0, 0.0))
    assert planner.ego_knots_s == dict(planner.plan.profiles[EGO].knot_times_s)
