"""`translate` and `solve`: what a description means, and how it could be made to happen, without driving.

What enters: the options of a command. What leaves: a program or a plan, for people or as JSON.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import SOURCE, AsJson, MapName, Translator
from scenewright.cli.running import carry_out, data_without_a_run, tell_no_plan, tell_notes
from scenewright.cli.translators import Asked, with_asked, with_translator
from scenewright.errors import InputError, OutputError, Place
from scenewright.translate.model.exchange import TranslatorSettings

ProgramFile = Annotated[
    Path | None,
    typer.Option("--out", metavar="FILE", help="Write the program (.scene) to a file.", show_default=False),
]
PlanFile = Annotated[
    Path | None,
    typer.Option("--out", metavar="FILE", help="Write the plan to a file, as plan.json.", show_default=False),
]


@with_translator
def translate(
    source: Annotated[str | None, SOURCE] = None,
    map_name: MapName = None,
    translator: Translator = "auto",
    out: ProgramFile = None,
    code: Annotated[bool, typer.Option("--code", help="Print the program itself, and nothing else.")] = False,
    as_json: AsJson = False,
    show_prompt: Annotated[
        bool, typer.Option("--show-prompt", help="Print what a model would be told, and ask nobody.")
    ] = False,
    *,
    settings: TranslatorSettings,
) -> None:
    """Say in plain English what was understood of a description, or what a program says; --code gives the program."""
    with told(as_json):
        if show_prompt:
            _show_prompt(source, map_name)
            return
        if source is None:
            raise InputError(
                "there is no description", expected='"TEXT"|FILE', fix='scenewright translate "The ego drives ..."'
            )
        from scenewright.program.printer import print_program
        from scenewright.translate.sources import read_scenario

        program, understanding = read_scenario(source, translator, map_name, settings)
        text = print_program(program)
        if out is not None:
            _write(out, text)
        if as_json:
            from scenewright.cli.tables import understanding_data

            print_json({"program": text, **understanding_data(program, understanding)})
        elif code:
            sys.stdout.write(text)
        else:
            from scenewright.cli.tables import tell_understood

            tell_understood(stdout(), program, understanding)
        if out is not None and not (as_json or code):
            stdout().print(f"program written to {out}", soft_wrap=True)


def _show_prompt(source: str | None, map_name: str | None) -> None:
    """Print the messages that begin a translation by a model, word by word."""
    from scenewright.program.types import DEFAULT_MAP
    from scenewright.roads.load import load_map
    from scenewright.translate.model.prompt import fingerprint, opening
    from scenewright.translate.sources import text_of

    road_map = load_map(map_name or DEFAULT_MAP)
    text = "(your description)" if source is None else text_of(source)[0]
    sys.stdout.write(f"prompt version {fingerprint(road_map)}\n")
    for message in opening(road_map, text):
        sys.stdout.write(f"\n----- {message.role} -----\n{message.content}\n")
    sys.stdout.flush()


@with_asked
def solve(asked: Asked, out: PlanFile = None, as_json: AsJson = False) -> None:
    """Plan the scenario for an ego that keeps its speed, and print the plan; nothing is driven."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.request import EXIT_STATUS

        request = asked.request(mode="open")
        result = carry_out(request, until="plan", quiet=as_json)
        status = EXIT_STATUS[result.status]
        plan = result.attempt.plan if result.attempt is not None else None
        data = plan.as_dict(result.scene) if plan is not None else None
        if out is not None and data is not None:
            _write(out, json.dumps(data, indent=2, allow_nan=False) + "\n")
        if as_json:
            print_json({**data_without_a_run(request, result, status), "plan": data})
        elif plan is not None:
            rows = tables.parameters(result.scene, request.parameters)
            stdout().print(tables.facts([*rows, ("tolerance missed", f"{plan.tolerance:.2f}")]))
            stdout().print(tables.knots(result.scene, plan))
        if not as_json:
            tell_no_plan(stderr(), result)
            tell_notes(stderr(), result)
        raise typer.Exit(status)


def _write(path: Path, text: str) -> None:
    """Write a file in one step: it is there as a whole, or as it was before."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        if path.exists() and not path.is_file():  # a device or a pipe is not to be replaced
            path.write_text(text, encoding="utf-8")
            return
        temporary.write_text(text, encoding="utf-8")
        os.replace(temporary, path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise OutputError(
            "the file cannot be written",
            place=Place(str(path)),
            found=error.strerror or str(error),
            fix="choose another file with --out FILE",
        ) from None
