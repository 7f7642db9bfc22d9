"""`run`: a sentence in, a judged run out; and the carrying out that `check` and `solve` share.

What enters: the options of the command. What leaves: a run directory, a report or JSON, and an exit status.
"""

from __future__ import annotations

import math
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.directories import claim
from scenewright.cli.faults import error_data, tell, told
from scenewright.cli.options import (
    AimOption,
    AsJson,
    FailOn,
    FailOnOption,
    ModeOption,
    PlannerOption,
    Simulator,
    ToleranceOption,
)
from scenewright.cli.translators import Asked, with_asked
from scenewright.cli.translators import ask as on_terminal

if TYPE_CHECKING:
    from rich.console import Console

    from scenewright.judge.verdict import Verdict
    from scenewright.request import Request, Result, Stop
    from scenewright.translate.story import Question

_SAYS = {
    "translate": "reading the description",
    "ground": "putting it on the map",
    "check": "asking whether it can happen at all",
    "plan": "planning",
    "simulate": "driving",
    "judge": "judging",
    "hindsight": "asking whether the ego left room",
    "explain": "asking why it missed",
    "ways out": "trying what would do",
    "write": "writing the run directory",
}
_UNBROKEN = ("judge", "write")


@with_asked
def run(
    asked: Asked,
    mode: ModeOption = "closed",
    tolerance: ToleranceOption = "tight",
    fail_on: FailOnOption = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Makes random choices of the ego repeatable.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="DIR", help="Where to write. Default: a new runs/NUMBER-NAME.", show_default=False
        ),
    ] = None,
    replan_hz: Annotated[
        float, typer.Option("--replan-hz", min=0.1, max=50.0, help="Plans of the heroes in a simulated second.")
    ] = 10.0,
    takes: Annotated[
        int,
        typer.Option(min=1, max=20, help="At most so many runs; a later one knows how the ego drove in the last."),
    ] = 3,
    aim: AimOption = None,
    predictor: Annotated[
        str, typer.Option(help="How the ego is predicted: road (slows for turns and lines), acceleration or speed.")
    ] = "road",
    ways_out: Annotated[
        bool, typer.Option("--ways-out/--no-ways-out", help="After a miss, look for numbers with which it happens.")
    ] = True,
    simulator: Simulator = "builtin",
    planner: PlannerOption = "convex",
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Print nothing but where the run is.")] = False,
    open_page: Annotated[bool, typer.Option("--open", help="Open the run's page in the browser afterwards.")] = False,
) -> None:
    """Drive a description around a driving policy in closed loop, and judge whether it happened."""
    with told(as_json):
        request = asked.request(
            mode=mode,
            tolerance=tolerance,
            seed=seed,
            replan_hz=replan_hz,
            predictor=predictor,
            takes=takes,
            aim=aim,
            explain="ways out" if ways_out else "cause",
            simulator=simulator,
            planner=planner,
        )
        folder = claim(out, asked.source)
        request = replace(request, out=folder.path)
        try:
            result = carry_out(request, quiet=quiet or as_json)
        finally:
            folder.give_back()
        status = _tell(request, result, fail_on, as_json, quiet)
        if open_page and result.run_directory is not None:
            from scenewright.cli.looking import open_in_browser

            open_in_browser(result.run_directory / "index.html", stderr())
        raise typer.Exit(status)


def carry_out(request: Request, until: Stop = "end", quiet: bool = False) -> Result:
    """Orchestrate, with signs of life; what a policy prints goes to stderr, and Ctrl-C gets through to us."""
    from scenewright.cli.terminal import SignsOfLife
    from scenewright.orchestrate import orchestrate

    with (
        SignsOfLife(stderr(), not quiet) as signs,
        _interruptible() as shield,
        redirect_stdout(sys.stderr),
    ):

        def ask(question: Question) -> str:
            with signs.silent():
                return on_terminal(question)

        def report(stage: str) -> None:
            if stage in _UNBROKEN:
                shield.up()
            else:
                shield.down()
            signs.say(_SAYS.get(stage, stage))

        def progress(time_s: float) -> None:
            signs.say(f"driving: {time_s:.1f} s of the run")

        if request.translation.ask is not None:
            request = replace(request, translation=replace(request.translation, ask=ask))
        return orchestrate(request, report, progress, until)


@contextmanager
def _interruptible() -> Iterator[_Shield]:
    """Let Ctrl-C through while something is being worked out, and not while its results are being written."""
    shield = _Shield()
    try:
        yield shield
    finally:
        shield.down(raises=False)  # all is done: what was asked for meanwhile is no longer needed


class _Shield:
    """Makes Ctrl-C wait while what was kept is judged and written."""

    def __init__(self) -> None:
        self._before: signal._HANDLER = None
        self._asked = False

    def up(self) -> None:
        """Let nothing through; where this is not the main thread no signal arrives anyway."""
        if self._before is None:
            with suppress(ValueError):
                self._before = signal.signal(signal.SIGINT, self._remember)

    def down(self, *, raises: bool = True) -> None:
        """Put back whatever handled the signal before; what came meanwhile comes now, if it is still wanted."""
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
            self._before = None
        asked, self._asked = self._asked, False
        if asked and raises:
            raise KeyboardInterrupt

    def _remember(self, _number: int, _frame: FrameType | None) -> None:
        self._asked = True


# -- telling --------------------------------------------------------------------------------------------------------
def _tell(request: Request, result: Result, fail_on: FailOn | None, as_json: bool, quiet: bool) -> int:
    """Print what came of a run and return the exit status."""
    from scenewright.request import EXIT_STATUS

    status = EXIT_STATUS[result.status]
    if status == 0 and fails_on(result.verdict, fail_on):
        status = EXIT_STATUS["failure"]
    fault = result.run.fault if result.run is not None else None
    if as_json:
        print_json(result_data(request, result, status))
    elif quiet:
        if result.run_directory is not None:
            sys.stdout.write(f"{result.run_directory}\n")
    elif result.verdict is not None:
        report_run(stdout(), request, result)
        tell_fails_on(stdout(), status, result.status == "success")
    if result.run is None and not as_json:
        tell_no_plan(stderr(), result)
        tell_notes(stderr(), result)
    if fault is not None:
        tell(fault)
    if result.status == "interrupted":
        stderr().print(f"interrupted; what was driven until then is kept in {result.run_directory}", soft_wrap=True)
    return status


def fails_on(verdict: Verdict | None, fail_on: FailOn | None) -> bool:
    """Whether what came of a run is to end in status 1, though it happened as described."""
    return fail_on == "collision" and verdict is not None and verdict.aftermath.collision is not None


def tell_fails_on(console: Console, status: int, success: bool) -> None:
    """Say why what happened as described ends in another status than that of a success."""
    if success and status:
        console.print(f"Exit status {status}: a collision is to count (--fail-on collision).", soft_wrap=True)


def result_data(request: Request, result: Result, status: int) -> dict[str, object]:
    """Return what came of a request as plain data."""
    from scenewright.cli.tables import parameter_data, understanding_data

    fault = result.run.fault if result.run is not None else None
    directory = result.run_directory
    infeasible = result.status == "infeasible" and result.feasibility is not None
    return {
        **(error_data(fault, status) if fault is not None else {"error": None}),
        "status": result.status,
        "exit_status": status,
        "run_directory": str(directory) if directory is not None else None,
        "page": str(directory / "index.html") if directory is not None else None,
        "tolerance": request.tolerance,
        "parameters": parameter_data(result.scene, request.parameters),
        "understanding": understanding_data(result.scene.program, result.understanding),
        "notes": [*result.scene.notes, *result.scene.road_map.notes],
        "verdict": result.verdict.as_dict() if result.verdict is not None else None,
        "findings": list(result.run.findings) if result.run is not None else [],
        "feasibility": result.feasibility.as_dict() if result.feasibility is not None else None,
        "explanation": result.feasibility.explain() if infeasible and result.feasibility else None,
        "tried": tried(result),
    }


def data_without_a_run(request: Request, result: Result, status: int) -> dict[str, object]:
    """Return what came of a request that was not to be driven."""
    of_runs = ("run_directory", "page", "tolerance", "verdict", "findings")
    return {key: value for key, value in result_data(request, result, status).items() if key not in of_runs}


def tell_no_plan(console: Console, result: Result) -> None:
    """Say why nothing was driven: a proof that it cannot happen, or what was tried in vain."""
    if result.status == "infeasible" and result.feasibility is not None:
        console.print(result.feasibility.explain(), soft_wrap=True)
    elif result.no_plan:
        console.print(f"Nothing was driven: {result.no_plan}", soft_wrap=True, markup=False)
    elif result.status == "gave up" and result.attempt is None:
        console.print(f"Undecided: {tried(result)}", soft_wrap=True)
    elif result.not_held:
        console.print("The planner cannot hold these yet, so nothing was driven:", soft_wrap=True)
        for each in result.not_held:
            console.print(f"  - {each}", soft_wrap=True, markup=False)
        console.print("`scenewright check` tells whether it can happen.", soft_wrap=True)


def tell_notes(console: Console, result: Result) -> None:
    """Say what was assumed, and what is not on the map as its file has it: it may be why nothing was driven."""
    for what, notes in (("assumed", result.scene.notes), ("map", result.scene.road_map.notes)):
        for note in notes:
            console.print(f"{what}: {note}", soft_wrap=True, markup=False)


def tried(result: Result) -> str | None:
    """Return what was tried before giving up; None where nothing was given up."""
    if result.status != "gave up":
        return None
    if result.not_held:
        return "the planner cannot hold yet: " + "; ".join(map(str, result.not_held))
    return result.no_plan or (result.feasibility.reason if result.feasibility is not None else None)


def report_run(console: Console, request: Request, result: Result) -> None:
    """Print what was understood, the verdict, and how to look at the run."""
    from scenewright.cli import tables

    verdict = result.verdict
    assert verdict is not None
    tables.tell_understood(console, result.scene.program, result.understanding)
    report_verdict(console, verdict, request.tolerance, result.run.status if result.run else "finished")
    rows = tables.parameters(result.scene, request.parameters)
    if len(result.takes) > 1:
        rows.append(
            ("take", f"{result.take}, the best of {len(result.takes)}; a later one knows how the ego drove before")
        )
    rows += [("assumed", text) for text in result.scene.notes]
    rows += [("map", text) for text in result.scene.road_map.notes]
    rows += [("finding", text) for text in (result.run.findings if result.run else ())]
    if rows:
        console.print()
        console.print(tables.facts(rows))
    directory = result.run_directory
    if directory is not None:
        console.print()
        console.print(f"page  {directory / 'index.html'}", soft_wrap=True)
        console.print(f"look  scenewright view {directory}", soft_wrap=True)


def report_verdict(console: Console, verdict: Verdict, tolerance: str, status: str = "finished") -> None:
    """Print the conditions and the headline; `status` says whether the run came to its end."""
    from rich.text import Text

    from scenewright.cli import tables

    console.print(tables.verdict(verdict))
    console.print(tables.routine(verdict))
    missed = len(tables.missed(verdict, tolerance))
    if status != "finished":
        end = "was interrupted" if status == "interrupted" else "ended in a fault"
        headline = f"The run {end}; as far as it got, {_miss(missed)} the {tolerance} tolerance."
    elif missed:
        headline = f"Failure: {_miss(missed, f' of {len(verdict.conditions)}')} the {tolerance} tolerance."
    else:
        headline = f"Success: it happened as described, within the {tolerance} tolerance."
    console.print(Text.assemble(tables.mark(not missed and status == "finished"), " ", (headline, "bold")))
    console.print(tables.aftermath(verdict), soft_wrap=True)
    if status == "finished" and verdict.facts.get("trigger_time_s"):  # a program need not have one
        console.print(_trigger(verdict), soft_wrap=True)
    for line in tables.cause(verdict):
        console.print(line, soft_wrap=True)


def _miss(count: int, of_all: str = "") -> str:
    one = count == 1
    return f"{count}{of_all} condition{'' if one and not of_all else 's'} miss{'es' if one else ''}"


def _trigger(verdict: Verdict) -> str:
    facts = verdict.facts
    came, told = facts.get("trigger_came") or {}, (facts.get("trigger_time_s") or {}).items()
    times = {hero: time_s for hero, time_s in told if time_s is not None and math.isfinite(time_s)}
    met = {hero: time_s for hero, time_s in times.items() if came.get(hero, True)}
    several, ego_never = len(times) > 1, facts.get("ego_never_met_condition")
    if ego_never and not several:
        return "The ego never came within the tight tolerance of its side of the trigger."
    lines = [
        f"The trigger{f' of {hero}' if several else ''} never came; it was nearest at {time_s:.2f} s."
        for hero, time_s in times.items()
        if hero not in met
    ]
    if several and met:
        moments = ", ".join(f"{time_s:.2f} s ({hero})" for hero, time_s in met.items())
        lines.insert(0, f"The trigger{'s' if len(met) > 1 else ''} came at {moments}.")
    elif met:
        lines = [f"The trigger came at {time_s:.2f} s." for time_s in met.values()]
    if ego_never:
        lines.append("The ego never came within the tight tolerance of its side of one of them.")
    return " ".join(lines) or "No trigger came."
