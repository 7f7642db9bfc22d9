"""`bench --quick`, `--full` or any part: the benchmark of 80 run against egos, by our method and its rivals.

What enters: which cases. What leaves: a result folder, a progress bar, tables. An experiment that was stopped goes on
when the same is typed again with the same `--out`.
"""

from __future__ import annotations

import os
import re
import shlex
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from scenewright.cli import INTERRUPTED
from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson
from scenewright.errors import InputError, MissingExtraError

if TYPE_CHECKING:
    from scenewright.study.experiment import Experiment, Plan

RESULTS = Path("results")
CORES = os.cpu_count() or 1
Keep = Literal["all", "ours", "none"]

Workers = Annotated[
    int, typer.Option("--workers", min=0, help="Processes; by default one a core, 0 for none beside this one.")
]


def experiment(
    context: typer.Context,
    quick: Annotated[bool, typer.Option("--quick", help="A spread of the benchmark in about two minutes.")] = False,
    full: Annotated[bool, typer.Option("--full", help="All 80 rows, 3 draws, 6 egos, all methods, and a report.")] = (
        False
    ),
    rows: Annotated[str, typer.Option(metavar="1-4,20|all", help="Rows of the benchmark.", show_default=False)] = "",
    egos: Annotated[
        str, typer.Option(metavar="NAMES|all", help="Egos, commas between; all built-in ones.", show_default=False)
    ] = "",
    draws: Annotated[int, typer.Option(min=1, help="Parameter draws a row.", show_default=False)] = 1,
    methods: Annotated[
        str, typer.Option(metavar="NAMES|all", help="scenewright and its rivals, commas between.", show_default=False)
    ] = "",
    takes: Annotated[int, typer.Option(min=1, max=20, help="Takes a case may have.")] = 3,
    seed: Annotated[int, typer.Option(min=0, help="Seed of draws, egos and methods.")] = 0,
    keep: Annotated[Keep, typer.Option(help="Whose runs keep their files, to be judged again.")] = "ours",
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
    given = _given(context)
    if context.invoked_subcommand is not None:
        if given:
            raise typer.BadParameter(f"{given[0]} does not go with `bench {context.invoked_subcommand}`")
        return
    if not given:
        typer.echo(context.get_help())
        raise typer.Exit
    with told(as_json):
        if quick and full:
            raise InputError("the experiment cannot be both", found="--quick --full", fix="leave one of them out")
        from scenewright.study.experiment import Experiment

        name = "quick" if quick else "full" if full else "bench"
        chosen = {"rows": rows, "egos": egos, "methods": methods, "draws": draws if "--draws" in given else None}
        plan = _plan(name, chosen, seed, takes, keep)
        plan.check()
        folder = out if out is not None else _new_folder(name)
        made = Experiment(plan, folder, _typed(context, folder))
        _carry_out(made, workers, as_json, report=full)


def _plan(name: str, chosen: dict[str, str | int | None], seed: int, takes: int, keep: Keep) -> Plan:
    from scenewright.study.experiment import Plan, preset

    base = preset(name)
    return Plan(
        rows=rows_of(str(chosen["rows"])) or base.rows,
        egos=egos_of(str(chosen["egos"])) or base.egos,
        draws=int(chosen["draws"] or base.draws),
        methods=methods_of(str(chosen["methods"])) or base.methods,
        seed=seed,
        takes=takes,
        keep=keep,
    )


def _carry_out(made: Experiment, workers: int, as_json: bool, report: bool) -> None:
    """Run the experiment, show how far it is, and say what came of it."""
    from scenewright.cli.bench_progress import shown, stoppable
    from scenewright.cli.bench_tables import print_summary
    from scenewright.study.store import read_results
    from scenewright.study.summary import summary

    with stoppable() as stop, shown(stderr()) as show:
        finished = made.run(workers, show, stop)
    if not finished:
        _tell_interrupted(made, as_json)
        raise typer.Exit(INTERRUPTED)
    page = _report(made.folder, workers) if report else None
    results = read_results(made.folder)
    if as_json:
        data = {"status": "finished", "results": str(made.folder), "report": str(page) if page else None}
        print_json({**data, "settings": results.settings, **summary(results.records())})
        return
    print_summary(stdout(), results)
    if page is not None:
        stdout().print(f"page     {page}", soft_wrap=True)


def _report(folder: Path, workers: int) -> Path | None:
    """Write the report; where that cannot be, say so: the cases are there all the same."""
    from scenewright.cli.bench_results import make_report
    from scenewright.cli.faults import tell

    try:
        return make_report(folder, folder / "report", workers, quick=False)
    except MissingExtraError as error:
        tell(error)
        return None


def _tell_interrupted(made: Experiment, as_json: bool) -> None:
    progress = made.progress
    if as_json:
        data = {"status": "interrupted", "exit_status": INTERRUPTED, "results": str(made.folder)}
        print_json({**data, "done": progress.done, "cases": progress.total, "resume": made.command})
    console = stderr()
    console.print(f"interrupted after {progress.done} of {progress.total} cases, which are kept in {made.folder}")
    console.print(f"to go on: {made.command}", soft_wrap=True)


# -- what was typed -------------------------------------------------------------------------------------------------
def rows_of(text: str) -> tuple[int, ...]:
    """Return row numbers from ``1-4,20`` or ``all``; nothing where nothing was said.

    Raises
    ------
    InputError
        Where a part is neither a number nor a range.

    Examples
    --------
    >>> rows_of("1-3,20")
    (1, 2, 3, 20)
    """
    if text.strip() == "all":
        from scenewright.study.benchmark import benchmark_rows

        return tuple(row.id for row in benchmark_rows())
    found: dict[int, None] = {}
    for part in filter(None, (piece.strip() for piece in text.split(","))):
        match = re.fullmatch(r"(\d{1,4})(?:\s*-\s*(\d{1,4}))?", part)
        if match is None or int(match[2] or match[1]) < int(match[1]):
            raise InputError("these are no rows", found=repr(part), expected="numbers and ranges", fix="--rows 1-4,20")
        found.update(dict.fromkeys(range(int(match[1]), int(match[2] or match[1]) + 1)))
    return tuple(found)


def egos_of(text: str) -> tuple[str, ...]:
    """Return egos from ``idm,constant:speed_mps=12,keep=1`` or ``all``; a comma within options parts no egos.

    >>> egos_of("idm,own.py:Ego:a=1,b=2,noisy")
    ('idm', 'own.py:Ego:a=1,b=2', 'noisy')
    """
    if text.strip() == "all":
        from scenewright.drive.loading import BUILT_IN

        return tuple(BUILT_IN)
    found: list[str] = []
    for part in filter(None, (piece.strip() for piece in text.split(","))):
        if found and "=" in part and ":" not in part:
            found[-1] += f",{part}"
        else:
            found.append(part)
    return tuple(dict.fromkeys(found))


def methods_of(text: str) -> tuple[str, ...]:
    """Return methods by name from a list with commas, or ``all``."""
    if text.strip() == "all":
        from scenewright.study.rivals import METHODS

        return tuple(METHODS)
    return tuple(dict.fromkeys(filter(None, (piece.strip() for piece in text.split(",")))))


def _given(context: typer.Context) -> list[str]:
    """Return the options that were typed."""
    return [
        parameter.opts[0]
        for parameter in context.command.params
        if parameter.name and getattr(context.get_parameter_source(parameter.name), "name", "") == "COMMANDLINE"
    ]


def _typed(context: typer.Context, folder: Path) -> str:
    """Return the command that was typed, with its result folder, so that it can be typed again."""
    given, words = _given(context), ["scenewright", "bench"]
    for parameter in context.command.params:
        option, value = parameter.opts[0], context.params.get(parameter.name or "")
        if option in given and option != "--out":
            words += [option] if value is True else [option, str(value)]
    return shlex.join([*words, "--out", str(folder)])


def _new_folder(name: str) -> Path:
    """Make the next free results/NUMBER-NAME."""
    RESULTS.mkdir(exist_ok=True)
    taken = [int(match[1]) for path in RESULTS.iterdir() if (match := re.match(r"(\d{1,9})-", path.name))]
    number = 1 + max(taken, default=0)
    while True:
        with suppress(FileExistsError):
            folder = RESULTS / f"{number:03d}-{name}"
            folder.mkdir()
            return folder
        number += 1
