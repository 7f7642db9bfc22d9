"""Arguments and options that several commands share, with their help, checks and shell completion.

What enters: words from the command line. What leaves: values a `Request` takes. Nothing is read from files here but the
names that completion offers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from scenewright.errors import ParameterError
from scenewright.units import decimal_fraction

if TYPE_CHECKING:
    from scenewright.plugins import Kind

_NUMBER = re.compile(r"[-+]?[\d_]*\.?[\d_]+(e[-+]?\d+)?", re.IGNORECASE)
Mode = Literal["closed", "open"]
Tolerance = Literal["tight", "loose"]
Level = Literal["fine", "tight", "loose", "coarse"]
PlannerName = Literal["convex", "smt"]
FailOn = Literal["collision"]


def parameters_of(items: Sequence[str] | None) -> dict[str, str]:
    """Return parameter values by name from ``NAME=VALUE`` words; whether they are numbers is checked with the program.

    Raises
    ------
    ParameterError
        Where a word has no value, or a name is given twice.
    """
    values: dict[str, str] = {}
    for item in items or ():
        name, equals, value = (part.strip() for part in item.partition("="))
        if not (name and equals and value):
            raise ParameterError(
                "a parameter is given without a value" if name else "a value is given without a parameter",
                found=repr(item),
                expected="NAME=VALUE, the value in the unit that the name ends in",
                fix=f"-p {name or 'ego_distance_m'}=12.5",
            )
        if name in values:
            raise ParameterError(
                f"parameter {name} is given twice", found=f"{values[name]} and {value}", fix="give it once"
            )
        values[name] = _within_reason(name, value)
    return values


def _within_reason(name: str, value: str) -> str:
    """Return a value as it was typed; what is a number, but an endless one, is refused before it is worked out."""
    try:
        decimal_fraction(value)
    except ValueError as error:
        if _NUMBER.fullmatch(value):
            raise ParameterError(
                f"no scenario has a number of the size of parameter {name}",
                found=value,
                expected=str(error),
                fix=f"-p {name}=12.5",
            ) from None
    except ZeroDivisionError:
        raise ParameterError(f"parameter {name} is divided by zero", found=value, fix=f"-p {name}=12.5") from None
    return value


# -- completion -----------------------------------------------------------------------------------------------------
def complete_source(incomplete: str) -> list[str]:
    """Offer files that may hold a description or a program."""
    return _paths(incomplete, (".scene", ".txt"))


def complete_map(incomplete: str) -> list[str]:
    """Offer the shipped maps, and files that can be read."""
    from scenewright.roads.load import shipped_maps
    from scenewright.roads.readers import endings

    return [name for name in shipped_maps() if name.startswith(incomplete)] + _paths(incomplete, endings())


def complete_ego(incomplete: str) -> list[tuple[str, str]]:
    """Offer the policies that can be named, each with its line."""
    from scenewright.drive.loading import policy_descriptions

    return [(name, line) for name, line in policy_descriptions().items() if name.startswith(incomplete)]


def complete_translator(incomplete: str) -> list[str]:
    """Offer the translators; the name of a model is the user's to know."""
    names = ("auto", "offline", "openai:", "anthropic:", "google:", "openai-compatible:", "files:")
    return [name for name in names if name.startswith(incomplete)]


def complete_solver(incomplete: str) -> list[str]:
    """Offer the solvers that refute and miss nothing."""
    from scenewright.solve.proofs.refuters import SOLVERS

    return _complete(SOLVERS, incomplete)


def complete_simulator(incomplete: str) -> list[str]:
    """Offer the simulators that miss nothing."""
    from scenewright.simulate.port import SIMULATORS

    return _complete(SIMULATORS, incomplete)


def _complete(kind: Kind[Any], incomplete: str) -> list[str]:
    return [name for name, missing in kind.known().items() if missing is None and name.startswith(incomplete)]


def complete_run_directory(incomplete: str) -> list[str]:
    """Offer run directories here and under `runs`."""
    found = [path.parent for folder in (Path(), Path("runs")) for path in sorted(folder.glob("*/manifest.json"))]
    return [str(path) for path in found if str(path).startswith(incomplete)]


def _paths(incomplete: str, suffixes: tuple[str, ...]) -> list[str]:
    folder, slash, start = incomplete.rpartition("/")
    try:
        here = sorted(Path(f"{folder}{slash}" or ".").iterdir())
    except OSError:
        return []
    fits = [path for path in here if path.name.startswith(start) and not path.name.startswith(".")]
    return [
        f"{folder}{slash}{path.name}" + ("/" if path.is_dir() else "")
        for path in fits
        if path.is_dir() or path.suffix in suffixes
    ]


# -- arguments and options ------------------------------------------------------------------------------------------
def argument(metavar: str, help: str, complete: Callable[[str], Sequence[Any]]) -> Any:
    """Return an argument that the shell completes."""
    return typer.Argument(metavar=metavar, help=help, autocompletion=complete, show_default=False)


SOURCE = argument(
    '"TEXT"|FILE',
    "A description in quotes, or a file: a description (.txt) or a program (.scene).",
    complete_source,
)
Source = Annotated[str, SOURCE]
RunDirectory = Annotated[
    Path, argument("DIR", "A run directory, as `scenewright run` leaves it.", complete_run_directory)
]
Parameters = Annotated[
    list[str] | None,
    typer.Option(
        "-p",
        "--parameter",
        metavar="NAME=VALUE",
        help="Set a parameter, in the unit that its name ends in; may be repeated.",
        show_default=False,
    ),
]
_MAP_HELP = "A shipped map or an OpenDRIVE file. Default: the program's own; t_intersection for a description."
MapName = Annotated[
    str | None,
    typer.Option("--map", metavar="NAME|FILE", help=_MAP_HELP, autocompletion=complete_map, show_default=False),
]
_EGO_HELP = "The driving policy under test: a built-in one, or module:Class or file.py:Class for your own."
Ego = Annotated[str, typer.Option("--ego", metavar="NAME[:k=v,...]", help=_EGO_HELP, autocompletion=complete_ego)]
_TRANSLATOR_HELP = (
    "What reads a description: auto (the model that is configured, else offline; see `scenewright models`), offline, "
    "openai:NAME, anthropic:NAME, google:NAME, openai-compatible:NAME (with --base-url), or files:DIR."
)
Translator = Annotated[
    str, typer.Option("--translator", metavar="NAME", help=_TRANSLATOR_HELP, autocompletion=complete_translator)
]
_SOLVER_HELP = "What proves that something cannot happen; `scenewright solvers` lists what there is."
Solver = Annotated[str, typer.Option("--solver", metavar="NAME", help=_SOLVER_HELP, autocompletion=complete_solver)]
_SIMULATOR_HELP = "The simulator to drive in; `scenewright simulators` lists what there is."
Simulator = Annotated[
    str, typer.Option("--simulator", metavar="NAME", help=_SIMULATOR_HELP, autocompletion=complete_simulator)
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object on stdout and nothing else there.")]
ModeOption = Annotated[
    Mode, typer.Option("--mode", help="Plan again while the ego drives (closed), or carry out the first plan (open).")
]
PlannerOption = Annotated[
    PlannerName,
    typer.Option(
        "--planner",
        help="What plans the heroes: convex optimisation, or an SMT solver at every tick, as in the paper "
        "(`run examples/demo.txt --ego constant --planner smt`).",
    ),
]
ToleranceOption = Annotated[
    Tolerance, typer.Option("--tolerance", help="Which tolerance decides whether the run is a success.")
]
AimOption = Annotated[
    Level | None,
    typer.Option(
        "--aim",
        help="Drive again until a take holds at this tolerance, naturally driven. Default: that of --tolerance.",
        show_default=False,
    ),
]
FailOnOption = Annotated[
    FailOn | None,
    typer.Option(
        "--fail-on",
        help="End in status 1 also where it happened as described, but this came of it.",
        show_default=False,
    ),
]
