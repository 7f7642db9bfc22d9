"""`translate`, `check` and `solve`: what a description means, whether it can happen, and how, without driving.

What enters: the options of a command. What leaves: a program, an answer or a plan, for people or as JSON.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson, Ego, MapName, Parameters, Source, Translator, parameters_of
from scenewright.cli.running import carry_out, result_data, tell_no_plan
from scenewright.errors import OutputError, Place

if TYPE_CHECKING:
    from scenewright.orchestrate import Request, Result

ProgramFile = Annotated[
    Path | None,
    typer.Option("--out", metavar="FILE", help="Write the program (.scene) to a file.", show_default=False),
]
PlanFile = Annotated[
    Path | None,
    typer.Option("--out", metavar="FILE", help="Write the plan to a file, as plan.json.", show_default=False),
]


def translate(
    source: Source,
    map_name: MapName = None,
    translator: Translator = "offline",
    out: ProgramFile = None,
    as_json: AsJson = False,
) -> None:
    """Turn a description into a program, and say how each clause was understood."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.program.printer import print_program
        from scenewright.translate.offline import explain
        from scenewright.translate.sources import read_scenario

        program, translation = read_scenario(source, translator, map_name)
        text = print_program(program)
        if out is not None:
            _write(out, text)
        if as_json:
            rows = explain(translation) if translation else []
            keys = ("words", "understood", "constraints")
            readings = [dict(zip(keys, row, strict=True)) for row in rows]
            assumptions = list(translation.assumptions) if translation else []
            print_json({"program": text, "readings": readings, "assumptions": assumptions})
            return
        console = stdout()
        if out is None:
            console.print(text, soft_wrap=True)
        if translation is not None:
            console.print(tables.clauses(translation))
            for assumption in translation.assumptions:
                console.print(f"assumed: {assumption}")
        if out is not None:
            console.print(f"program written to {out}", soft_wrap=True)


def check(
    source: Source,
    parameter: Parameters = None,
    map_name: MapName = None,
    ego: Ego = "idm",
    translator: Translator = "offline",
    as_json: AsJson = False,
) -> None:
    """Say whether a scenario can happen at all, and if not, what clashes and what would help."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.orchestrate import EXIT_STATUS, Request

        request = Request(source, parameters_of(parameter), map_name, ego, translator=translator)
        result = carry_out(request, until="check", quiet=as_json)
        status = EXIT_STATUS[result.status]
        if as_json:
            print_json(_without_a_run(request, result, status))
        else:
            stdout().print(tables.understood(result.scene))
            rows = tables.parameters(result.scene, request.parameters)
            if rows:
                stdout().print(tables.facts(rows))
            if result.status == "success":
                stdout().print("\nNothing speaks against it: no limit of motion or of the map rules it out.")
            tell_no_plan(stdout(), result)
        raise typer.Exit(status)


def solve(
    source: Source,
    parameter: Parameters = None,
    map_name: MapName = None,
    ego: Ego = "idm",
    translator: Translator = "offline",
    out: PlanFile = None,
    as_json: AsJson = False,
) -> None:
    """Plan the scenario for an ego that keeps its speed, and print the plan; nothing is driven."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.orchestrate import EXIT_STATUS, Request

        request = Request(source, parameters_of(parameter), map_name, ego, mode="open", translator=translator)
        result = carry_out(request, until="plan", quiet=as_json)
        status = EXIT_STATUS[result.status]
        plan = result.attempt.plan if result.attempt is not None else None
        data = plan.as_dict(result.scene) if plan is not None else None
        if out is not None and data is not None:
            _write(out, json.dumps(data, indent=2, allow_nan=False) + "\n")
        if as_json:
            print_json({**_without_a_run(request, result, status), "plan": data})
        elif plan is not None:
            rows = tables.parameters(result.scene, request.parameters)
            stdout().print(tables.facts([*rows, ("manner", plan.manner)]))
            stdout().print(tables.knots(result.scene, plan))
        if not as_json:
            tell_no_plan(stderr(), result)
        raise typer.Exit(status)


def _without_a_run(request: Request, result: Result, status: int) -> dict[str, object]:
    """Return what came of a request that was not to be driven."""
    of_runs = ("run_directory", "page", "tolerance", "verdict", "findings")
    return {key: value for key, value in result_data(request, result, status).items() if key not in of_runs}


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OutputError(
            "the file cannot be written",
            place=Place(str(path)),
            found=error.strerror or str(error),
            fix="choose another file with --out FILE",
        ) from None
