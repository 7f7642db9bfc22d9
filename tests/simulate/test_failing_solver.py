"""Solvers that refuse, lie or dawdle: the last plan goes on, the record says so, and nothing unchecked is driven."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from stories import HERO, PATIENT_S, STORIES, Stage

from scenewright.drive.hostile import Noisy
from scenewright.orchestrate import Request, orchestrate
from scenewright.simulate.loop import Run
from scenewright.solve import planner
from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.solve.problem import Problem, Result, Satisfiable, Unknown, Unsatisfiable

STORY = STORIES["yields, distance"]
GOES_ON = "last plan goes on"


@dataclass
class Manipulated:
    """The real solver, whose answers are replaced from its first answer after `armed` on, `times` times over."""

    replace: Callable[[Result], Result]
    times: float = np.inf
    armed: bool = False
    calls: int = 0
    name: str = "manipulated"
    honest: Z3Backend = field(default_factory=Z3Backend)

    def solve(self, problem: Problem, timeout_s: float, want_core: bool = False, effort: int | None = None) -> Result:
        result = self.honest.solve(problem, timeout_s, want_core, effort)
        if not self.armed:
            return result
        self.calls += 1
        return self.replace(result) if self.calls <= self.times else result


def on_stage(backend: Manipulated, budget_s: float = PATIENT_S) -> Stage:
    """An ego whose unsteady foot makes re-solving necessary at almost every tick."""
    stage = Stage(STORY, Noisy(sigma_mpss=0.8), seed=3, backend=backend, budget_s=budget_s)
    assert stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 12.0).plan is not None
    backend.armed = True
    return stage


def refused(run: Run) -> list[int]:
    return [k for k, record in enumerate(run.replans) if record.status.endswith(GOES_ON)]


def faster(result: Result) -> Result:
    """Make a model wrong: the hero is much faster at the end of its first stretch than it was found to be."""
    if not isinstance(result, Satisfiable) or "a1v1" not in result.model:
        return result
    return Satisfiable({**result.model, "a1v1": result.model["a1v1"] + Fraction(12)})


@pytest.mark.parametrize(
    ("answer", "status", "reason"),
    [
        (Unsatisfiable(()), "unsat", "cannot meet the trigger"),
        (Unknown("timeout"), "timeout|unsat", "too hard a question|no motion within the limits"),
        (Unknown("incomplete"), "unsat", "incomplete"),
    ],
)
def test_last_plan_goes_on_while_there_is_no_answer(answer: Result, status: str, reason: str) -> None:
    # A question that is too hard ends its tick, others are followed by more.
    backend = Manipulated(lambda _: answer, times=8 if status.startswith("timeout") else 30)
    stage = on_stage(backend)
    run = stage.run()
    without = refused(run)
    assert run.status == "finished"
    assert len(without) >= 5
    for k in without:
        assert stage.plans[k] is stage.plans[k - 1]
        if run.replans[k].reason == "failed a moment ago":  # after some failures in a row not every tick is tried
            continue
        assert re.fullmatch(f"({status}), {GOES_ON}", run.replans[k].status)
        assert run.replans[k].backend == "manipulated"
        assert re.search(reason, run.replans[k].reason)
    asked = [k for k in without if run.replans[k].backend]
    assert len(asked) >= 6
    assert max(b - a for a, b in pairwise(asked)) <= 3
    solved = [record for record in run.replans[without[-1] + 1 :] if record.backend]
    assert solved, "once it answers again it is listened to"
    assert all(record.status in ("sat", "relaxed") for record in solved)


def test_first_plan_is_carried_out_to_its_end_where_nothing_else_is_ever_found() -> None:
    stage = on_stage(Manipulated(lambda _: Unsatisfiable(())))
    run = stage.run()
    assert run.last_plan is run.first_plan
    hero = run.trace.actors["hero"]
    planned = [run.first_plan.profiles[HERO].state(time_s)[0] for time_s in hero.time_s]
    assert np.array_equal(hero.s_m, planned)


def test_wrong_model_is_refused_by_the_check() -> None:
    backend = Manipulated(faster)
    stage = on_stage(backend)
    run = stage.run()
    assert backend.calls > 0
    assert run.last_plan is run.first_plan
    assert any("the model fails its check: " in run.replans[k].reason for k in refused(run))


def test_wrong_model_is_never_a_first_plan() -> None:
    backend = Manipulated(faster, armed=True)
    stage = Stage(STORY, Noisy(), backend=backend)
    attempt = stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 12.0)
    assert attempt.plan is None
    assert "the model fails its check: " in attempt.reason


class Clock:
    """A clock that runs only when it is told to."""

    def __init__(self) -> None:
        self.now_s = 0.0

    def perf_counter(self) -> float:
        return self.now_s


def test_budget_ends_a_resolve_and_the_run_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr(planner, "time", clock)

    def slowly(result: Result) -> Result:
        clock.now_s += 0.2
        return Unsatisfiable(())

    backend = Manipulated(slowly, times=8)
    stage = on_stage(backend, budget_s=0.3)
    run = stage.run()
    assert run.status == "finished"
    timed_out = [record for record in run.replans if record.status == f"timeout, {GOES_ON}"]
    assert len(timed_out) == 4, "the second try of 0.2 s begins within 0.3 s, the third does not"
    assert {record.reason for record in timed_out} == {"time budget"}
    assert any(record.status in ("sat", "relaxed") for record in run.replans[1:])


def test_solver_is_told_how_much_time_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, told = Clock(), []
    monkeypatch.setattr(planner, "time", clock)

    class Strict(Z3Backend):
        def solve(
            self, problem: Problem, timeout_s: float, want_core: bool = False, effort: int | None = None
        ) -> Result:
            told.append(timeout_s)
            clock.now_s += 0.1
            return Unknown("timeout")

    stage = Stage(STORY, Noisy(), backend=Strict())
    attempt = stage.replanner.planner.replan(
        stage.replanner._situations(0.0, stage.replanner.predictor.predict([(0.0, 60.0, 10.0, 0.0)]), {"t0": 0.0}, {})
    )
    assert attempt.plan is None
    assert told
    assert told == pytest.approx([PATIENT_S - 0.1 * k for k in range(len(told))])


def test_gives_up_and_drives_nothing_where_no_plan_is_found(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def never(self: Z3Backend, problem: Problem, timeout_s: float, *more: object, **options: object) -> Result:
        return Unknown("incomplete")

    monkeypatch.setattr(Z3Backend, "solve", never)
    result = orchestrate(Request(STORY, ego="idm", out=tmp_path / "run", budget_s=PATIENT_S))
    assert result.status == "gave up"
    assert result.feasibility is not None
    assert result.feasibility.answer == "feasible"
    assert (result.run, result.verdict, result.run_directory) == (None, None, None)
    assert result.attempt is not None
    assert (result.attempt.plan, result.attempt.reason) == (None, "incomplete")
    assert list((tmp_path / "run").iterdir()) == []
