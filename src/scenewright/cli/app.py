"""The commands by name, each with examples that work as they stand.

What enters: nothing. What leaves: `app`. Another group of commands joins by `app.add_typer`.
"""

from __future__ import annotations

from typing import Annotated

import typer

from scenewright import __version__
from scenewright.cli import bench, checking, faults, listing, looking, models, reading, running, telling

SENTENCE = (
    "The ego drives westbound. An oncoming hero turns left into the driveway. When the ego is 25 m before the "
    "conflict point and the hero is 15 m before the conflict point, the hero brakes to a stop 8 m before the "
    "conflict point."
)

app = typer.Typer(
    name="scenewright",
    help="A sentence in, a judged closed-loop traffic test out.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
)


def _examples(*commands: str) -> str:
    """Return the text below a command's help; each example stands on lines of its own."""
    return "\n\n".join(["[bold]Examples[/bold]", *(command.replace("[", r"\[") for command in commands)])


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"scenewright {__version__}")
        raise typer.Exit


_STATUS = (
    "\n\n[bold]Exit status[/bold]\n\n0 it happened as described, 1 it did not, 2 the input is wrong, "
    "3 proven impossible, 4 gave up, 130 interrupted"
)


@app.callback(epilog=_examples(f'scenewright run "{SENTENCE}"') + _STATUS)
def _all(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show a traceback where Scenewright itself is at fault.")] = (
        False
    ),
) -> None:
    faults.debug.set(debug)


_TRANSLATE = f'scenewright translate "{SENTENCE}" --out first.scene'
_RUN = "scenewright run first.scene --out runs/first"

app.command(
    epilog=_examples(
        f'scenewright run "{SENTENCE}" --out runs/first', f"{_TRANSLATE}", "scenewright run first.scene --ego dawdler"
    )
    + _STATUS
)(running.run)
_BY_A_MODEL = (
    "\n\n[bold]Exit status[/bold]\n\n0 understood; 2 refused, or something must be answered; 4 no reply of a model\n\n"
    "[bold]What a text leaves open[/bold]\n\n"
    "You are asked on the terminal; elsewhere defaults are taken and told, or answers come from a file:\n\n"
    "scenewright translate FILE --answers answers.json\n\n"
    "[bold]By a language model[/bold]\n\n"
    "scenewright translate FILE --translator openai:NAME\n\n"
    "scenewright translate FILE --translator openai-compatible:NAME --base-url http://127.0.0.1:8000/v1\n\n"
    "scenewright translate FILE --translator files:DIR"
)
app.command(
    epilog=_examples(
        f'scenewright translate "{SENTENCE}"',
        _TRANSLATE,
        "scenewright translate first.scene --code",
        "scenewright translate --show-prompt",
    )
    + _BY_A_MODEL
)(reading.translate)
app.command(epilog=_examples(_TRANSLATE, "scenewright tell first.scene"))(telling.tell)
app.command(
    epilog=_examples(
        _TRANSLATE,
        "scenewright check first.scene --ego constant:speed_mps=12",
        "scenewright check first.scene --out witness",
        "scenewright check first.scene --solver cvc5",
    )
    + "\n\n[bold]Exit status[/bold]\n\n0 it can happen, 2 the input is wrong, 3 proven impossible, 4 undecided"
)(checking.check)
app.command(epilog=_examples(_TRANSLATE, "scenewright solve first.scene --out plan.json"))(reading.solve)
app.command(epilog=_examples(_TRANSLATE, _RUN, "scenewright judge runs/first --tolerance loose"))(looking.judge)
app.command(epilog=_examples("scenewright maps", "scenewright maps t_intersection"))(listing.maps)
app.command(epilog=_examples("scenewright egos", "scenewright egos --json"))(listing.egos)
app.command(epilog=_examples("scenewright models", "scenewright models --json"))(models.models)
app.command(epilog=_examples("scenewright simulators", "scenewright simulators --json"))(listing.simulators)
app.command(epilog=_examples("scenewright solvers", "scenewright solvers --json"))(listing.solvers)
app.command(epilog=_examples(_TRANSLATE, _RUN, "scenewright view runs/first --no-browser"))(looking.view)
app.add_typer(bench.app, name="bench")
