"""`bench`: how often it works, why it does not, and how long it takes; the commands below `scenewright bench` by name.

What enters: options. What leaves: tables for people, JSON for programs, results in a folder. The experiment itself is
in `bench_run`, what reads its results in `bench_results`; here are the two smaller measurements too.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli import bench_results, bench_run, bench_translate
from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson

if TYPE_CHECKING:
    from rich.table import Table

    from scenewright.study.evaluation import Outcome, Row

app = typer.Typer(rich_markup_mode="rich")
_SMALL = "scenewright bench --rows 17,20 --egos idm"


def _examples(*commands: str) -> str:
    """Return the text below a command's help; each example stands on lines of its own."""
    return "\n\n".join(["[bold]Examples[/bold]", *commands])


app.callback(
    invoke_without_command=True,
    epilog=_examples(f"{_SMALL} --out results/small", f"{_SMALL} --methods open-loop")
    + "\n\n[bold]Exit status[/bold]\n\n0 all cases are done, whatever came of them; 2 the input is wrong; "
    "130 interrupted: type the same again to go on",
)(bench_run.experiment)
_EXAMPLES: dict[Callable[..., None], tuple[str, ...]] = {
    bench_results.show: ("scenewright bench show results/small",),
    bench_results.diff: (
        f"{_SMALL} --takes 1 --out results/other",
        "scenewright bench diff results/small results/other",
    ),
    bench_results.replay: ("scenewright bench replay results/small 17-idm-0-scenewright",),
    bench_results.rejudge: ("scenewright bench rejudge results/small",),
    bench_results.report: ("scenewright bench report results/small --quick",),
}
for _command, _lines in _EXAMPLES.items():
    app.command(epilog=_examples(f"{_SMALL} --out results/small", *_lines))(_command)


app.command(
    epilog=_examples(
        "scenewright bench translate --group taxonomy",
        "scenewright bench translate --show",
    )
)(bench_translate.translate)


@app.command(
    epilog="[bold]Examples[/bold]\n\nscenewright bench success examples --egos idm --draws 1\n\n"
    "scenewright bench success texts.json --egos constant,idm,dawdler --draws 5 --out outcomes.jsonl"
)
def success(
    source: Annotated[Path, typer.Argument(help='A JSON list of {"id", "text"}, a folder of .txt files, or one.')],
    egos: Annotated[str, typer.Option(help="Ego policies, with commas between.")] = "constant,idm,dawdler",
    draws: Annotated[int, typer.Option(min=1, help="Parameter draws a description.")] = 5,
    seed: Annotated[int, typer.Option(help="Seed of the draws and of the egos.")] = 0,
    ranges: Annotated[str, typer.Option(help="Ranges to draw from: everyday, demanding or wide.")] = "everyday",
    mode: Annotated[str, typer.Option(help="closed or open loop.")] = "closed",
    takes: Annotated[int, typer.Option(min=1, help="Takes a case may have; 1 for the first take alone.")] = 3,
    workers: Annotated[int, typer.Option(min=1, help="Processes; by default one a core.")] = os.cpu_count() or 1,
    out: Annotated[Path | None, typer.Option(help="Write every outcome to this file, as JSON lines.")] = None,
    as_json: AsJson = False,
) -> None:
    """Run descriptions against egos with drawn parameters; count successes, and failures by cause."""
    with told(as_json):
        from scenewright.errors import InputError
        from scenewright.study.draws import RANGES
        from scenewright.study.evaluation import make_cases, read_descriptions, run_cases, tabulate, write_outcomes

        if ranges not in RANGES:
            raise InputError("there are no such ranges", found=ranges, expected=", ".join(RANGES))
        if mode not in ("closed", "open"):
            raise InputError("there is no such mode", found=mode, expected="closed or open")
        cases = make_cases(read_descriptions(source), egos.split(","), draws, seed, ranges, mode, takes)
        outcomes = _with_progress(run_cases(cases, workers), len(cases))
        if out is not None:
            write_outcomes(outcomes, out)
        tables = {by: tabulate(outcomes, by) for by in ("ego", "description")}
        if as_json:
            print_json({by: [_plain(row) for row in rows] for by, rows in tables.items()})
            return
        for by, rows in tables.items():
            stdout().print(_table(by, rows))
        _print_failures(outcomes)


@app.command(epilog="[bold]Examples[/bold]\n\nscenewright bench timing --seeds 1")
def timing(
    seeds: Annotated[int, typer.Option(min=1, help="Seeds a scenario and ego.")] = 3,
    replan_hz: Annotated[float, typer.Option(min=0.1, help="Re-solves a second.")] = 10.0,
    as_json: AsJson = False,
) -> None:
    """Time re-solves with one hero, everything counted: foresee, build, solve, read back, check."""
    with told(as_json):
        from scenewright.study.timing import time_resolves

        measured = time_resolves(range(seeds), replan_hz)
        data = {
            "runs": measured.runs,
            "ticks": measured.ticks,
            "solver_asked": len(measured.tick_ms),
            "p50_ms": measured.percentile_ms(50),
            "p90_ms": measured.percentile_ms(90),
            "p99_ms": measured.percentile_ms(99),
            "max_ms": measured.percentile_ms(100),
            "busiest_run_s_in_20_s": measured.busy_s_in_20_s,
        }
        if as_json:
            print_json(data)
            return
        console = stdout()
        console.print(f"{measured.runs} runs, {measured.ticks} ticks, solver asked at {len(measured.tick_ms)}")
        for name in ("p50_ms", "p90_ms", "p99_ms", "max_ms"):
            console.print(f"  re-solve {name.removesuffix('_ms'):>4}: {data[name]:6.1f} ms")
        console.print(f"  busiest run: {measured.busy_s_in_20_s:.2f} s of one core in 20 s")


def _with_progress(outcomes: Iterator[Outcome], total: int) -> list[Outcome]:
    from rich.progress import track

    console = stderr()
    shown = track(outcomes, total=total, description="running", console=console, disable=not console.is_terminal)
    return list(shown)


def _rates(row: Row) -> tuple[float | None, float | None]:
    """Return the share at tight tolerance: of what is not proven infeasible, and of what the ego let happen."""
    denied = ("proven infeasible", "ego never met the condition", "ego left no room")
    return row.rate(("success",), ("proven infeasible",)), row.rate(("success",), denied)


def _plain(row: Row) -> dict[str, object]:
    feasible, let = _rates(row)
    return {"name": row.name, "total": row.total, **row.counts, "tight": feasible, "tight_where_ego_let_it": let}


def _table(by: str, rows: Sequence[Row]) -> Table:
    from rich.table import Table

    from scenewright.study.causes import CAUSES

    used = [cause for cause in CAUSES if any(row.counts[cause] for row in rows)]
    table = Table(by, "cases", *used, "tight, of not proven infeasible", "tight, where the ego let it")
    for row in rows:
        rates = ["-" if rate is None else f"{100 * rate:.0f} %" for rate in _rates(row)]
        table.add_row(row.name, str(row.total), *(str(row.counts[cause] or "") for cause in used), *rates)
    return table


def _print_failures(outcomes: Sequence[Outcome]) -> None:
    console = stdout()
    for outcome in outcomes:
        if outcome.cause in ("success", "proven infeasible"):
            continue
        what = ", ".join(outcome.failed_conditions) or outcome.message
        values = " ".join(f"{name}={value}" for name, value in outcome.parameters.items())
        console.print(
            f"{outcome.description}, {outcome.ego}, draw {outcome.draw}: {outcome.cause} ({what})  [{values}]",
            soft_wrap=True,
        )
