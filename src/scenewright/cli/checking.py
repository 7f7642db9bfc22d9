"""`check`: whether scenarios can happen at all, each by a witness, by a proof, or undecided.

What enters: the options of the command. What leaves: one answer for each source, for people or as JSON, and witnesses
as run directories.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli.console import print_json, stdout
from scenewright.cli.directories import Claim, claim, next_free, slug
from scenewright.cli.faults import error_data, tell, told
from scenewright.cli.options import AsJson, Solver
from scenewright.cli.running import carry_out, data_without_a_run, tell_no_plan, tell_notes
from scenewright.cli.translators import Asked, with_asked
from scenewright.errors import ScenewrightError

if TYPE_CHECKING:
    from scenewright.request import Request, Result

More = Annotated[
    list[str] | None,
    typer.Argument(metavar="[FILE]...", help="More of them: one line for each is printed.", show_default=False),
]
WitnessFolder = Annotated[
    Path | None,
    typer.Option(
        "--out",
        metavar="DIR",
        help="Write the witness as a run directory, to be judged and looked at; with several sources one each, in DIR.",
        show_default=False,
    ),
]
_WORDS = {"success": "feasible", "infeasible": "infeasible", "gave up": "undecided"}
_WORST_FIRST = (2, 3, 4, 0)


@with_asked
def check(
    asked: Asked, more: More = None, out: WitnessFolder = None, solver: Solver = "z3", as_json: AsJson = False
) -> None:
    """Say whether a scenario can happen at all: show a motion in which it does, or prove that none exists."""
    with told(as_json):
        if more:
            each = [replace(asked, source=source) for source in (asked.source, *more)]
            status = _check_each(each, out, solver, as_json)
        else:
            status = _check_one(asked, out, solver, as_json)
        raise typer.Exit(status)


def _check_one(asked: Asked, out: Path | None, solver: str, as_json: bool) -> int:
    """Check one source, tell all about it, and return the exit status."""
    from scenewright.cli import tables

    folder = claim(out, asked.source) if out is not None else None
    request, result, status = _carry_out(asked, folder, solver, as_json)
    if as_json:
        print_json(_data(request, result, status))
        return status
    console = stdout()
    tables.tell_understood(console, result.scene.program, result.understanding)
    rows = tables.parameters(result.scene, request.parameters)
    if rows:
        console.print(tables.facts(rows))
    if result.status == "success":
        console.print("\nThis can happen: there is a motion of everybody in which all of it does.")
        for missed in _missed(result):
            console.print(f"As a run that motion is judged a failure: {missed}", markup=False, highlight=False)
    if result.run_directory is not None:
        console.print(f"page  {result.run_directory / 'index.html'}", soft_wrap=True)
    tell_no_plan(console, result)
    tell_notes(console, result)
    return status


def _check_each(all_asked: Sequence[Asked], out: Path | None, solver: str, as_json: bool) -> int:
    """Check one source after another, a line each; what is wrong with one does not keep the others from their turn."""
    found: list[dict[str, object]] = []
    statuses: set[int] = set()
    for asked in all_asked:
        folder = next_free(out, slug(asked.source)) if out is not None else None
        try:
            request, result, status = _carry_out(asked, folder, solver, as_json)
        except ScenewrightError as error:
            status = error.exit_status
            found.append({"source": asked.source, **error_data(error, status)})
            tell(error)
            line = ["refused", asked.source]
        else:
            found.append({"source": asked.source, **_data(request, result, status)})
            line = [_WORDS[result.status], asked.source, *_in_short(result)]
        statuses.add(status)
        if not as_json:
            stdout().print("  ".join([f"{line[0]:10}", *line[1:]]), soft_wrap=True, markup=False, highlight=False)
    worst = next((status for status in _WORST_FIRST if status in statuses), max(statuses))
    if as_json:
        print_json({"exit_status": worst, "checks": found})
    return worst


def _carry_out(asked: Asked, folder: Claim | None, solver: str, quiet: bool) -> tuple[Request, Result, int]:
    from scenewright.request import EXIT_STATUS

    try:
        request = asked.request(out=folder.path if folder is not None else None, solver=solver)
        result = carry_out(request, until="check", quiet=quiet)
    finally:
        if folder is not None:
            folder.give_back()
    return request, result, EXIT_STATUS[result.status]


def _data(request: Request, result: Result, status: int) -> dict[str, object]:
    data = data_without_a_run(request, result, status)
    if result.run_directory is not None:
        data |= {"run_directory": str(result.run_directory), "verdict": result.verdict and result.verdict.as_dict()}
    return data


def _in_short(result: Result) -> list[str]:
    """Say in a few words what clashes, why it is undecided, or where the witness is."""
    if result.run_directory is not None:
        return [str(result.run_directory), *(f"judged a failure: {missed}" for missed in _missed(result))]
    found = result.feasibility
    if found is None or found.answer == "feasible":
        return []
    return [found.reason or "; ".join(clash.told or clash.id for clash in found.clashes)]


def _missed(result: Result) -> list[str]:
    """Return what a run owes that the motion which shows that it can happen does not do, if it is judged."""
    from scenewright.judge.tolerance import TIGHT

    judged = result.verdict.conditions if result.verdict is not None else ()
    return [str(condition.text) for condition in judged if not condition.holds_at(TIGHT)]
