"""`bench`: how often it works, why it does not, and how long it takes; run, shown, compared, judged again, reported.

What enters: which cases, or result folders. What leaves: a result folder, tables for people, JSON for programs. An
experiment that was stopped goes on when the same is typed again with the same `--out`.
"""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli import INTERRUPTED
from scenewright.cli.bench_options import (
    CORES,
    MOST_SEED,
    ResultFolder,
    Workers,
    command_typed,
    egos_of,
    given_options,
    methods_of,
    rows_of,
)
from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import tell, told
from scenewright.cli.options import AsJson
from scenewright.errors import InputError, MissingExtraError, Place

if TYPE_CHECKING:
    from scenewright.request import Request, Result
    from scenewright.study.experiment import Experiment, Progress
    from scenewright.study.store import CaseRecord, Results

RESULTS = Path("results")
_SMALL = "scenewright bench --rows 17,20 --egos idm"
_MAKES = f"{_SMALL} --out results/small"


def _examples(*commands: str) -> str:
    """Return the text below a command's help; each example stands on lines of its own."""
    return "\n\n".join(["[bold]Examples[/bold]", *commands])


app = typer.Typer(rich_markup_mode="rich")


@app.callback(
    invoke_without_command=True,
    epilog=_examples(_MAKES, f"{_SMALL} --methods open-loop")
    + "\n\n[bold]Exit status[/bold]\n\n0 all cases are done, whatever came of them; 2 the input is wrong; "
    "130 interrupted: type the same again to go on",
)
def experiment(
    context: typer.Context,
    quick: Annotated[bool, typer.Option("--quick", help="A spread of the benchmark in about two minutes.")] = False,
    full: Annotated[
        bool, typer.Option("--full", help="All 80 rows, 3 draws, 6 egos, every method but smt, and a report.")
    ] = (False),
    rows: Annotated[str, typer.Option(metavar="1-4,20|all", help="Rows of the benchmark.", show_default=False)] = "",
    egos: Annotated[
        str, typer.Option(metavar="NAMES|all", help="Egos, commas between; all built-in ones.", show_default=False)
    ] = "",
    draws: Annotated[int | None, typer.Option(min=1, help="Parameter draws a row.", show_default=False)] = None,
    methods: Annotated[
        str, typer.Option(metavar="NAMES|all", help="scenewright and its rivals, commas between.", show_default=False)
    ] = "",
    takes: Annotated[int, typer.Option(min=1, max=20, help="Takes a case may have.")] = 3,
    seed: Annotated[int, typer.Option(min=0, max=MOST_SEED, help="Seed of draws, egos and methods.")] = 0,
    workers: Workers = CORES,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Result folder. Default: a new results/NUMBER-NAME.", show_default=False),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Measure how often it works, why it does not, how it compares with other methods, and how long it takes.

    With --quick, --full or a choice of rows, egos, draws and methods it runs the benchmark of 80. After an
    interruption the same words with the same --out go on.
    """
    given = given_options(context)
    if context.invoked_subcommand is not None:
        if given:
            raise typer.BadParameter(f"{next(iter(given))} does not go with `bench {context.invoked_subcommand}`")
        return
    if not given:
        typer.echo(context.get_help())
        raise typer.Exit
    with told(as_json):
        if quick and full:
            raise InputError("the experiment cannot be both", found="--quick --full", fix="leave one of them out")
        from scenewright.cli.directories import next_free
        from scenewright.study.experiment import Experiment, Plan, preset

        name = "quick" if quick else "full" if full else "bench"
        base = preset(name)
        plan = Plan(
            rows_of(rows) or base.rows,
            egos_of(egos) or base.egos,
            draws or base.draws,
            methods_of(methods) or base.methods,
            seed,
            takes,
        )
        plan.check()
        folder = out if out is not None else next_free(RESULTS, name).path
        _carry_out(Experiment(plan, folder, command_typed(given, folder)), workers, as_json, full)


def _carry_out(made: Experiment, workers: int, as_json: bool, report: bool) -> None:
    """Run the experiment, show how far it is, and say what came of it."""
    from scenewright.cli.bench_progress import shown, stoppable

    with stoppable() as stop, shown(stderr()) as show:

        def progress(so_far: Progress) -> None:
            errors = f", {so_far.errors} errors" if so_far.errors else ""
            show("cases", so_far.done, so_far.total, f"{so_far.successes} successes{errors}")

        try:
            finished = made.run(workers, progress, stop)
        except KeyboardInterrupt:  # the second one; what is done is kept all the same
            finished = False
    if not finished:
        _tell_interrupted(made, as_json)
        raise typer.Exit(INTERRUPTED)
    page = None
    if report:
        try:
            page = _make_report(made.folder, workers, quick=False)
        except MissingExtraError as error:  # the cases are there all the same
            tell(error)
    ended = {"status": "finished", "results": str(made.folder), "report": str(page) if page else None}
    _tell_results(made.folder, as_json, ended)
    if page is not None and not as_json:
        stdout().print(f"page     {page}", soft_wrap=True)


def _tell_results(folder: Path, as_json: bool, besides: Mapping[str, object]) -> None:
    from scenewright.cli.bench_tables import print_summary
    from scenewright.study.store import read_results
    from scenewright.study.summary import summary

    results = read_results(folder)
    if as_json:
        print_json({**besides, "settings": results.settings, **summary(results.records)})
    else:
        print_summary(stdout(), results)


def _tell_interrupted(made: Experiment, as_json: bool) -> None:
    progress = made.progress
    if as_json:
        data = {"status": "interrupted", "exit_status": INTERRUPTED, "results": str(made.folder)}
        print_json({**data, "done": progress.done, "cases": progress.total, "resume": made.command})
    console = stderr()
    console.print(f"interrupted after {progress.done} of {progress.total} cases, which are kept in {made.folder}")
    console.print(f"to go on: {made.command}", soft_wrap=True)


# -- results --------------------------------------------------------------------------------------------------------
@app.command(epilog=_examples(_MAKES, "scenewright bench show results/small"))
def show(directory: ResultFolder, as_json: AsJson = False) -> None:
    """Print the tables of an experiment, finished or not."""
    with told(as_json):
        _tell_results(directory, as_json, {})


@app.command(
    epilog=_examples(
        _MAKES,
        f"{_SMALL} --takes 1 --out results/other",
        "scenewright bench diff results/small results/other",
    )
)
def diff(
    then: Annotated[Path, typer.Argument(metavar="THEN", help="The earlier results.", show_default=False)],
    now: Annotated[Path, typer.Argument(metavar="NOW", help="The later results.", show_default=False)],
    fail_on_regression: Annotated[
        bool,
        typer.Option(
            "--fail-on-regression", help="Exit with 1 where more successes were lost than won, beyond chance (5 %)."
        ),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Tell what got better or worse between two experiments, case by case."""
    with told(as_json):
        from scenewright.cli.bench_tables import print_comparison
        from scenewright.study.compare import compare
        from scenewright.study.store import read_results

        comparison = compare(read_results(then), read_results(now))
        if as_json:
            print_json(comparison.as_dict())
        else:
            print_comparison(stdout(), comparison)
        raise typer.Exit(1 if fail_on_regression and comparison.regressed else 0)


@app.command(epilog=_examples(_MAKES, "scenewright bench replay results/small 17-idm-0-scenewright"))
def replay(
    directory: ResultFolder,
    case: Annotated[str, typer.Argument(metavar="CASE", help="Its name, such as 20-idm-0-open-loop.")],
    out: Annotated[
        Path | None,
        typer.Option(metavar="RUN", help="Where to write. Default: a new runs/NUMBER-NAME.", show_default=False),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Run one case again, by its own method, and write its run with a page to look at."""
    with told(as_json):
        from scenewright.cli.directories import claim
        from scenewright.request import EXIT_STATUS
        from scenewright.study.benchmark import benchmark_row
        from scenewright.study.cases import carry_out_case, case_of_record, keep_run
        from scenewright.study.store import read_results

        results = read_results(directory)
        record = _record(results, case)
        folder = claim(out, f"{record.case}.scene")
        try:
            asked = case_of_record(record, results.settings["takes"], directory)
            again, request, result = carry_out_case(asked, benchmark_row(record.row))
            if result.run is not None and result.verdict is not None:
                keep_run(folder.path, request, result, page=True)
                result.run_directory = folder.path
        finally:
            folder.give_back()
        _tell_replayed(record, again, request, result, as_json)
        raise typer.Exit(EXIT_STATUS[result.status])


def _record(results: Results, case: str) -> CaseRecord:
    records = {record.case: record for record in results.records}
    if case not in records:
        close = get_close_matches(case, records, n=1)
        raise InputError(
            "there is no such case in these results",
            place=Place(str(results.directory)),
            found=case,
            expected=f"one of {len(records)}, such as {next(iter(records), 'none')}",
            fix=f"did you mean {close[0]}?" if close else "`scenewright bench show DIR --json` lists failures by name",
        )
    return records[case]


def _tell_replayed(record: CaseRecord, again: CaseRecord, request: Request, result: Result, as_json: bool) -> None:
    from scenewright.cli.running import report_run, result_data, tell_no_plan
    from scenewright.request import EXIT_STATUS

    same = (record.cause, record.kept, record.take) == (again.cause, again.kept, again.take)
    if as_json:
        data = result_data(request, result, EXIT_STATUS[result.status])
        print_json({**data, "case": record.case, "cause": again.cause, "cause_recorded": record.cause, "same": same})
        return
    console = stdout()
    if result.verdict is not None:
        report_run(console, request, result)
    else:
        tell_no_plan(stderr(), result)
    odd = [name for name in again.failed_conditions if name.startswith("criterion")]
    if odd:
        console.print(f"The row's own criteria fail: {', '.join(odd)}.")
    end = "as recorded" if same else f"where the record says: {record.cause}"
    console.print(f"{record.case}: {again.cause}, {end}")


@app.command(epilog=_examples(_MAKES, "scenewright bench rejudge results/small"))
def rejudge(directory: ResultFolder, workers: Workers = CORES, as_json: AsJson = False) -> None:
    """Judge every kept run again from its files; exit with 1 where anything differs from the record."""
    with told(as_json):
        from scenewright.cli.bench_progress import tracked
        from scenewright.study.rejudge import kept_runs, rejudge
        from scenewright.study.store import read_results

        results = read_results(directory)
        kept = kept_runs(results)
        judged = tracked(stderr(), "judging", rejudge(kept, workers), len(kept))
        differ = {
            run.record.case: list(found) for run, found in sorted(judged, key=lambda each: each[0].record.case) if found
        }
        successes = sum("tight" in run.record.kept for run in kept)
        lost = sum(record.best_tight and record.directory is None for record in results.records)
        if as_json:
            print_json({"judged": len(kept), "successes": successes, "not_kept": lost, "differ": differ})
        else:
            for case, found in differ.items():
                stdout().print(f"{case}: {'; '.join(found)}", soft_wrap=True)
            stdout().print(f"{len(kept)} kept runs judged again, {successes} of them successes; {len(differ)} differ")
            if lost:
                stdout().print(f"{lost} more successes, of rivals, were not kept: they cannot be judged again")
        raise typer.Exit(1 if differ else 0)


@app.command(epilog=_examples(_MAKES, "scenewright bench report results/small --quick"))
def report(
    directory: ResultFolder,
    quick: Annotated[bool, typer.Option("--quick", help="Measure little beside the results that are there.")] = False,
    workers: Workers = CORES,
    as_json: AsJson = False,
) -> None:
    """Write figures, tables and a page of an experiment; what it lacks is measured, once, and kept."""
    with told(as_json):
        page = _make_report(directory, workers, quick)
        if as_json:
            print_json({"page": str(page)})
        else:
            stdout().print(str(page), soft_wrap=True)


def _make_report(directory: Path, workers: int, quick: bool) -> Path:
    """Write a report, with signs of life; interrupted, it says how to go on."""
    from scenewright.cli.bench_progress import shown
    from scenewright.study.report.report import write_report

    try:
        with shown(stderr()) as show:
            return write_report(
                directory,
                quick=quick,
                workers=workers,
                progress=lambda stage, done, total: show(stage, done, total, ""),
            )
    except KeyboardInterrupt:
        words = shlex.join(["scenewright", "bench", "report", str(directory), *(["--quick"] if quick else [])])
        stderr().print(f"interrupted; results and what was measured are kept; to go on: {words}", soft_wrap=True)
        raise typer.Exit(INTERRUPTED) from None


# -- smaller measurements -------------------------------------------------------------------------------------------
@app.command(
    epilog=_examples(
        "scenewright bench success examples --egos idm --draws 1",
        "scenewright bench success texts.json --egos constant,idm,dawdler --draws 5 --out outcomes.jsonl",
    )
)
def success(
    source: Annotated[Path, typer.Argument(help='A JSON list of {"id", "text"}, a folder of .txt files, or one.')],
    egos: Annotated[str, typer.Option(help="Ego policies, with commas between.")] = "constant,idm,dawdler",
    draws: Annotated[int, typer.Option(min=1, help="Parameter draws a description.")] = 5,
    takes: Annotated[int, typer.Option(min=1, help="Takes a case may have; 1 for the first take alone.")] = 3,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the draws and of the egos.")] = 0,
    workers: Workers = CORES,
    out: Annotated[Path | None, typer.Option(help="Write every outcome to this file, as JSON lines.")] = None,
    as_json: AsJson = False,
) -> None:
    """Run descriptions against egos with drawn parameters; count successes, and failures by cause."""
    with told(as_json):
        from scenewright.cli.bench_progress import tracked
        from scenewright.cli.bench_tables import outcome_data, outcome_tallies, print_outcomes
        from scenewright.study.evaluation import in_order, make_cases, read_descriptions, run_cases, write_outcomes

        cases = make_cases(read_descriptions(source), egos_of(egos), draws, seed, takes)
        if out is not None:  # what cannot be written is told before anything is run
            out.parent.mkdir(parents=True, exist_ok=True)
            out.open("a").close()
        outcomes = in_order(tracked(stderr(), "cases", run_cases(cases, workers), len(cases)), cases)
        if out is not None:
            write_outcomes(outcomes, out)
        if as_json:
            print_json({by: [outcome_data(each) for each in all_] for by, all_ in outcome_tallies(outcomes).items()})
        else:
            print_outcomes(stdout(), outcomes)


@app.command(epilog=_examples("scenewright bench timing --seeds 1"))
def timing(
    seeds: Annotated[int, typer.Option(min=1, help="Seeds a scenario and ego.")] = 3,
    as_json: AsJson = False,
) -> None:
    """Time re-solves with one hero, everything counted: foresee, build, solve, read back, check."""
    with told(as_json):
        from scenewright.study.timing import time_resolves

        measured = time_resolves(range(seeds))
        times = {f"p{percent}_ms": measured.percentile_ms(percent) for percent in (50, 90, 99)}
        times["max_ms"] = measured.percentile_ms(100)
        if as_json:
            counts = {"runs": measured.runs, "ticks": measured.ticks, "solver_asked": len(measured.tick_ms)}
            print_json({**counts, **times, "busiest_run_s_in_20_s": measured.busy_s_in_20_s})
            return
        console = stdout()
        console.print(f"{measured.runs} runs, {measured.ticks} ticks, solver asked at {len(measured.tick_ms)}")
        for name, value in times.items():
            console.print(f"  re-solve {name.removesuffix('_ms'):>4}: {value:6.1f} ms")
        console.print(f"  busiest run: {measured.busy_s_in_20_s:.2f} s of one core in 20 s")
