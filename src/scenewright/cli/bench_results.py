"""`bench show`, `diff`, `replay`, `rejudge` and `report`: what is done with the results of an experiment.

What enters: result folders. What leaves: tables, a run directory, a report, and exit statuses. Results are not changed.
"""

from __future__ import annotations

import shlex
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli import INTERRUPTED
from scenewright.cli.bench_run import CORES, Workers
from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson
from scenewright.errors import InputError, Place

if TYPE_CHECKING:
    from scenewright.orchestrate import Request, Result
    from scenewright.study.store import CaseRecord, Results

ResultFolder = Annotated[
    Path, typer.Argument(metavar="DIR", help="A result folder, as `scenewright bench` leaves it.", show_default=False)
]


def show(directory: ResultFolder, as_json: AsJson = False) -> None:
    """Print the tables of an experiment, finished or not."""
    with told(as_json):
        from scenewright.cli.bench_tables import print_summary
        from scenewright.study.store import read_results
        from scenewright.study.summary import summary

        results = read_results(directory)
        if as_json:
            print_json({"settings": results.settings, **summary(results.records())})
        else:
            print_summary(stdout(), results)


def diff(
    then: Annotated[Path, typer.Argument(metavar="THEN", help="The earlier results.", show_default=False)],
    now: Annotated[Path, typer.Argument(metavar="NOW", help="The later results.", show_default=False)],
    fail_on_regression: Annotated[
        bool,
        typer.Option(
            "--fail-on-regression",
            help="Exit with 1 where more successes were lost than won, beyond chance (5 %).",
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
        from scenewright.orchestrate import EXIT_STATUS
        from scenewright.study.benchmark import benchmark_row
        from scenewright.study.cases import carry_out_case, case_of_record, keep_run
        from scenewright.study.store import read_results

        results = read_results(directory)
        record = _record(results, case)
        folder = claim(out, f"{record.case}.scene")
        try:
            again, request, result = carry_out_case(
                case_of_record(record, results.settings["takes"], directory), benchmark_row(record.row)
            )
            if result.run is not None and result.verdict is not None:
                keep_run(folder.path, request, result, page=True)
                result.run_directory = folder.path
        finally:
            folder.give_back()
        _tell_replayed(record, again, request, result, as_json)
        raise typer.Exit(EXIT_STATUS[result.status])


def _record(results: Results, case: str) -> CaseRecord:
    records = {record.case: record for record in results.records()}
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
    from scenewright.orchestrate import EXIT_STATUS

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


def rejudge(directory: ResultFolder, workers: Workers = CORES, as_json: AsJson = False) -> None:
    """Judge every kept run again from its files; exit with 1 where anything differs from the record."""
    with told(as_json):
        from rich.progress import track

        from scenewright.study.rejudge import kept_runs, rejudge, successes_without_files
        from scenewright.study.store import read_results

        results = read_results(directory)
        kept, console = kept_runs(results), stderr()
        judged = list(
            track(rejudge(kept, workers), "judging", len(kept), console=console, disable=not console.is_terminal)
        )
        odd = sorted((each for each in judged if each.differences), key=lambda each: each.case)
        successes = sum(each.success for each in judged)
        lost = len(successes_without_files(results))
        if as_json:
            differ = {each.case: list(each.differences) for each in odd}
            print_json({"judged": len(judged), "successes": successes, "not_kept": lost, "differ": differ})
        else:
            out = stdout()
            for each in odd:
                out.print(f"{each.case}: {'; '.join(each.differences)}", soft_wrap=True)
            out.print(f"{len(judged)} kept runs judged again, {successes} of them successes; {len(odd)} differ")
            if lost:
                out.print(f"{lost} more successes were not kept (see --keep), so they cannot be judged again")
        raise typer.Exit(1 if odd else 0)


def report(
    directory: ResultFolder,
    out: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Where to write. Default: report in DIR.", show_default=False)
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Measure little beside the results that are there.")] = False,
    workers: Workers = CORES,
    as_json: AsJson = False,
) -> None:
    """Write figures, tables and a page of an experiment; what it lacks is measured, once, and kept."""
    with told(as_json):
        page = make_report(directory, out if out is not None else directory / "report", workers, quick)
        if as_json:
            print_json({"page": str(page)})
        else:
            stdout().print(str(page), soft_wrap=True)


def make_report(directory: Path, out: Path, workers: int, quick: bool) -> Path:
    """Write a report, with signs of life; interrupted, it says how to go on."""
    from scenewright.cli.bench_progress import stages_shown
    from scenewright.study.report import write_report

    try:
        with stages_shown(stderr()) as progress:
            return write_report(directory, out, quick=quick, progress=progress, workers=workers)
    except KeyboardInterrupt:
        words = shlex.join(["scenewright", "bench", "report", str(directory), *(["--quick"] if quick else [])])
        stderr().print(f"interrupted; results and what was measured are kept; to go on: {words}", soft_wrap=True)
        raise typer.Exit(INTERRUPTED) from None
