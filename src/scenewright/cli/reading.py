"""`translate` and `solve`: what a description means, and how it could be made to happen, without driving.

What enters: the options of a command. What leaves: a program or a plan, for people or as JSON.
"""

from __future__ import annotations

import functools
import json
import os
import sys
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import SOURCE, AsJson, MapName, Translator
from scenewright.cli.running import carry_out, data_without_a_run, tell_map_notes, tell_no_plan
from scenewright.cli.translators import Asked, impossibility, with_asked, with_translator
from scenewright.errors import InputError, OutputError, Place, ScenewrightError
from scenewright.translate.model.settings import TranslatorSettings

if TYPE_CHECKING:
    from rich.console import Console

    from scenewright.program.types import Program
    from scenewright.translate.translation import Translation

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
    translator: Translator = "offline",
    out: ProgramFile = None,
    as_json: AsJson = False,
    show_prompt: Annotated[
        bool, typer.Option("--show-prompt", help="Print what a model would be told, and ask nobody.")
    ] = False,
    *,
    settings: TranslatorSettings,
) -> None:
    """Turn a description into a program, and say how each clause was understood."""
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

        proof = functools.partial(impossibility, map_name=map_name)
        program, translation = read_scenario(source, translator, map_name, replace(settings, verify=proof))
        text = print_program(program)
        sentences = _read_back(program, map_name)
        if out is not None:
            _write(out, text)
        if as_json:
            print_json(_translation_data(text, sentences, translation))
            return
        console = stdout()
        if out is None:
            console.print(text, soft_wrap=True)
        _tell_translation(console, sentences, translation)
        if out is not None:
            console.print(f"program written to {out}", soft_wrap=True)


def _show_prompt(source: str | None, map_name: str | None) -> None:
    """Print the messages that begin a translation by a model, word by word."""
    from scenewright.program.types import DEFAULT_MAP
    from scenewright.roads.load import load_map
    from scenewright.translate.model.prompt import PROMPT_VERSION, fingerprint, opening
    from scenewright.translate.sources import text_of

    road_map = load_map(map_name or DEFAULT_MAP)
    text = "(your description)" if source is None else text_of(source)[0]
    sys.stdout.write(f"prompt version {PROMPT_VERSION} ({fingerprint(road_map)})\n")
    for message in opening(road_map, text):
        sys.stdout.write(f"\n----- {message.role} -----\n{message.content}\n")
    sys.stdout.flush()


def _read_back(program: Program, map_name: str | None) -> tuple[str, ...]:
    """Return the program in plain English, on its map where it fits there."""
    from scenewright.roads.grounding import ground
    from scenewright.roads.load import load_map
    from scenewright.translate.reading_back import read_back

    try:
        return read_back(program, ground(program, load_map(map_name or program.map_name)))
    except ScenewrightError:  # a program on a map that is not here: what it says by itself is readable all the same
        return read_back(program)


def _translation_data(text: str, sentences: tuple[str, ...], translation: Translation | None) -> dict[str, object]:
    """Return a translation as plain data."""
    from scenewright.translate.model.translation import ModelTranslation
    from scenewright.translate.translation import explain

    rows = explain(translation) if translation else []
    keys = ("words", "understood", "constraints")
    data: dict[str, object] = {
        "program": text,
        "readings": [dict(zip(keys, row, strict=True)) for row in rows],
        "assumptions": list(translation.assumptions) if translation else [],
        "reading_back": list(sentences),
    }
    if isinstance(translation, ModelTranslation):
        data |= {
            "questions": [asdict(question) for question in translation.questions],
            "disagreements": list(translation.disagreements),
            "impossible": translation.impossible,
            "translator": translation.translator,
            "prompt": translation.prompt,
            "usage": asdict(translation.usage),
            "calls": [asdict(each) for each in translation.calls],
        }
    return data


def _tell_translation(console: Console, sentences: tuple[str, ...], translation: Translation | None) -> None:
    """Print how a description was understood, the program read back, and every doubt."""
    from scenewright.cli import tables
    from scenewright.translate.model.translation import ModelTranslation

    if translation is not None:
        console.print(tables.clauses(translation))
    console.print("read back, it says:", style="bold")
    for sentence in sentences:
        console.print(f"  {sentence}", soft_wrap=True)
    if translation is None:
        return
    if translation.assumptions:
        console.print()
    for assumption in translation.assumptions:
        console.print(f"assumed: {assumption}", soft_wrap=True)
    if isinstance(translation, ModelTranslation):
        for each in translation.disagreements:
            console.print(f"doubt: {each}", soft_wrap=True, style="yellow")
        if translation.impossible is not None:
            console.print(f"doubt: this cannot happen. {translation.impossible}", soft_wrap=True, style="yellow")
        who = f"{translation.translator}, prompt {translation.prompt}"
        console.print(f"\n{who}: {translation.tokens()}", soft_wrap=True)


@with_asked
def solve(asked: Asked, out: PlanFile = None, as_json: AsJson = False) -> None:
    """Plan the scenario for an ego that keeps its speed, and print the plan; nothing is driven."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.orchestrate import EXIT_STATUS

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
            stdout().print(tables.facts([*rows, ("style", plan.style)]))
            stdout().print(tables.knots(result.scene, plan))
        if not as_json:
            tell_no_plan(stderr(), result)
            tell_map_notes(stderr(), result)
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
