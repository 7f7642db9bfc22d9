"""Times: of translating the benchmark's descriptions, and of the solver by number of constraints and answer.

What enters: how many rows and egos to take. What leaves: one record a translation and a solver call, and tables of
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
from scenewright.study.report.tables import Column, Table, Value

PERCENTILES = (50, 90, 99)
# What the orchestrator calls the stages in which it asks the solver; what is asked while it simulates are re-solves.
STAGES = {"check": "feasibility", "plan": "first plan", "simulate": "re-solve", "hindsight": "hindsight"}
_BIN = 10


@dataclass(frozen=True, slots=True)
class TimesSize:
    """Every `row_step`-th row of the benchmark, these egos, so many readings of each description."""

    row_step: int
    egos: tuple[str, ...]
    repeats: int


# Interactions alternate with period 4 over the rows: an odd step meets all of them.
QUICK = TimesSize(9, ("noisy",), 1)
FULL = TimesSize(3, ("idm", "noisy"), 3)


# -- translation ----------------------------------------------------------------------------------------------------
def measure_translations(bench: Bench, size: TimesSize) -> list[Measured]:
    """Translate every description of every `row_step`-th row."""
    from scenewright.study.benchmark import benchmark_rows

    jobs = [
        {"row": row.id, "description": text, "repeats": size.repeats}
        for row in benchmark_rows()[:: size.row_step]
        for text in row.descriptions
    ]
    return bench.measure("translations", time_translation, jobs, timed=True)


def time_translation(job: Job) -> Measured:
    """Translate one description and return the times; one warm-up before, so that imports are not counted.

    A description that the translator refuses has its reason in place of times.
    """
    from scenewright.errors import ScenewrightError
    from scenewright.translate.sources import read_scenario

    text = job["description"]
    try:
        read_scenario(text)
    except ScenewrightError as error:
        return {"words": len(text.split()), "refused": error.message}
    times = []
    for _ in range(job["repeats"]):
        started = time.perf_counter()
        read_scenario(text)
        times.append(1000.0 * (time.perf_counter() - started))
    return {"words": len(text.split()), "ms": times}


def translations_table(records: Sequence[Measured]) -> Table:
    """Return percentiles over all readings, by length of the description and for all."""
    done = [record for record in records if "ms" in record]
    groups = {
        "up to 50 words": [r for r in done if r["words"] <= 50],
        "51 to 80 words": [r for r in done if 50 < r["words"] <= 80],
        "more than 80 words": [r for r in done if r["words"] > 80],
        "all": done,
    }
    rows = []
    for name, own in groups.items():
        if own or name == "all":
            readings = [ms for record in own for ms in record["ms"]]
            rows.append((name, len(own), len(records) - len(done) if name == "all" else None, *_percentiles(readings)))
    columns = (
        Column("length", "descriptions of"),
        Column("descriptions", "descriptions", "count"),
        Column("refused", "refused", "count"),
        *_columns(),
    )
    return Table("translation_times", "Time to translate one description, offline translator", columns, tuple(rows))


# -- solver ---------------------------------------------------------------------------------------------------------
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


def measure_solver(bench: Bench, size: TimesSize, seed: int) -> list[Measured]:
    """Orchestrate every `row_step`-th row with each ego, and return what the solver was asked, call by call."""
    from scenewright.study.benchmark import benchmark_rows, draw_row

    jobs = [
        {
            "row": row.id,
            "program": row.program_text,
            "parameters": draw_row(row, 0, seed),
            "ego": ego,
            "seed": seed,
        }
        for row in benchmark_rows()[:: size.row_step]
        for ego in size.egos
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
    """Return percentiles of solver time by stage, answer and number of constraints."""
    rows: list[tuple[Value, ...]] = []
    for stage in STAGES.values():
        for answer in sorted({call["answer"] for call in calls if call["stage"] == stage}):
            own = [call for call in calls if (call["stage"], call["answer"]) == (stage, answer)]
            for low in sorted({bin_of(call["constraints"]) for call in own}):
                times = [call["ms"] for call in own if bin_of(call["constraints"]) == low]
                rows.append((stage, answer, f"{low} to {low + _BIN - 1}", len(times), *_percentiles(times)))
            rows.append((stage, answer, "all", len(own), *_percentiles([call["ms"] for call in own])))
    columns = (
        Column("stage", "asked for"),
        Column("answer", "answer"),
        Column("constraints", "constraints"),
        Column("calls", "calls", "count"),
        *_columns(),
    )
    return Table("solver_times", "Time of one solver call by number of constraints", columns, tuple(rows))


def bin_of(constraints: int) -> int:
    """Return the lower edge of the bin that a number of constraints falls into."""
    return constraints // _BIN * _BIN


def ticks_table(times_ms: Sequence[float], ticks_over_100_ms: int) -> Table:
    """Return percentiles of whole re-plans as they occurred in the experiment."""
    row = (len(times_ms), *_percentiles(times_ms), ticks_over_100_ms)
    columns = (Column("ticks", "ticks", "count"), *_columns(), Column("late", "over 100 ms", "count"))
    title = "Time of one re-plan in the experiment, everything counted, ours"
    return Table("tick_times", title, columns, (row,))


def _columns() -> tuple[Column, ...]:
    names = [(f"p{percent}_ms", f"p{percent} (ms)") for percent in PERCENTILES]
    return tuple(Column(name, heading, "number") for name, heading in (*names, ("max_ms", "max (ms)")))


def _percentiles(times: Sequence[float]) -> tuple[Any, ...]:
    if not times:
        return tuple(None for _ in range(len(PERCENTILES) + 1))
    values = np.asarray(times, dtype=np.float64)
    return (*(float(np.percentile(values, percent)) for percent in PERCENTILES), float(values.max()))
