"""Times: of the solver by number of constraints and answer, and of whole re-plans.

What enters: which rows and egos to take. What leaves: one record a solver call, and tables of
percentiles. Everything runs in this process, one thing at a time; times compare within one machine only.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from scenewright.solve.problem import Backend, Problem, Result, Satisfiable, Unsatisfiable
from scenewright.study.report.measuring import Bench, Job, Measured
from scenewright.study.report.tables import Table

PERCENTILES = (50, 90, 99)
# What the orchestrator calls the stages in which it asks the solver; what is asked while it simulates are re-solves.
STAGES = {"plan": "first plan", "simulate": "re-solve"}
TICK_MS = 100.0  # between two re-plans
_COLUMNS = {**{f"p{percent}_ms": f"p{percent} (ms)" for percent in PERCENTILES}, "max_ms": "max (ms)"}


@dataclass(slots=True)
class RecordingBackend:
    """A solver that asks another, and notes how large each problem was, how long it took and what the answer was."""

    inner: Backend
    stage: str = ""
    calls: list[Measured] = field(default_factory=list)
    name: str = field(init=False)

    def __post_init__(self) -> None:
        self.name = self.inner.name

    def solve(self, problem: Problem, timeout_s: float, want_core: bool = False, effort: int | None = None) -> Result:
        """Ask the inner solver; its answer is returned as it is."""
        started = time.perf_counter()
        result = self.inner.solve(problem, timeout_s, want_core, effort)
        wall_ms = 1000.0 * (time.perf_counter() - started)
        answers: dict[type, str] = {Satisfiable: "sat", Unsatisfiable: "unsat"}
        call = {
            "stage": STAGES.get(self.stage, self.stage),
            "constraints": len(problem.assertions),
            "unknowns": len(problem.unknowns),
            "answer": answers.get(type(result), "unknown") + (" with core" if want_core else ""),
            "ms": wall_ms,
        }
        self.calls.append(call)
        return result

    def enter(self, stage: str) -> None:
        """Note the stage that what follows belongs to."""
        self.stage = stage


def measure_solver(bench: Bench, egos: Sequence[str], row_step: int, seed: int) -> list[Measured]:
    """Orchestrate every `row_step`-th row with each ego, and return what the solver was asked, call by call.

    Interactions alternate with period 4 over the rows: an odd step meets all of them.
    """
    from scenewright.study.benchmark import benchmark_rows, draw_row

    jobs = [
        {
            "row": row.id,
            "program": row.program_text,
            "parameters": draw_row(row, 0, seed),
            "ego": ego,
            "seed": seed,
        }
        for row in benchmark_rows()[::row_step]
        for ego in egos
    ]
    records = bench.measure("solver", time_solver, jobs, timed=True)
    return [{"row": r["row"], "ego": r["ego"], **call} for r in records for call in r.get("calls", ())]


def time_solver(job: Job) -> Measured:
    """Orchestrate once, first take only, with a solver that is watched."""
    from scenewright.orchestrate import Request, orchestrate
    from scenewright.solve.backends.z3_backend import Z3Backend

    backend = RecordingBackend(Z3Backend())
    request = Request(job["program"], job["parameters"], ego=job["ego"], seed=job["seed"], takes=1)
    orchestrate(request, report=backend.enter, backend=backend)
    return {"calls": backend.calls}


def solver_table(calls: Sequence[Measured]) -> Table:
    """Return percentiles of solver time by what was asked for and the answer."""
    rank = {stage: place for place, stage in enumerate(STAGES.values())}
    kinds = sorted({(call["stage"], call["answer"]) for call in calls}, key=lambda kind: (rank.get(kind[0], 9), kind))
    rows = []
    for kind in kinds:
        times = [call["ms"] for call in calls if (call["stage"], call["answer"]) == kind]
        rows.append((*kind, len(times), *_percentiles(times)))
    columns = {"stage": "asked for", "answer": "answer", "calls": "calls", **_COLUMNS}
    return Table("solver_times", "Time of one solver call by answer", columns, tuple(rows))


def ticks_table(times_ms: Sequence[float]) -> Table:
    """Return percentiles of whole re-plans as they occurred in the experiment."""
    late = sum(ms > TICK_MS for ms in times_ms)
    columns = {"ticks": "ticks", **_COLUMNS, "late": f"over {TICK_MS:g} ms"}
    title = "Time of one re-plan in the experiment, everything counted, ours"
    return Table("tick_times", title, columns, ((len(times_ms), *_percentiles(times_ms), late),))


def _percentiles(times: Sequence[float]) -> tuple[Any, ...]:
    if not times:
        return tuple(None for _ in range(len(PERCENTILES) + 1))
    values = np.asarray(times, dtype=np.float64)
    return (*(float(np.percentile(values, percent)) for percent in PERCENTILES), float(values.max()))
