"""What is typed after `bench`: arguments that its commands share, and lists of rows, egos and methods in words.

What enters: words from the command line. What leaves: values for a `Plan`, and the command that types them again.
"""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path
from typing import Annotated

import typer

from scenewright.errors import InputError

CORES = os.cpu_count() or 1
MOST_SEED = 2**62  # records keep the seed of a case, this one with its draw and row added, in 64 bits
Workers = Annotated[
    int, typer.Option("--workers", min=0, help="Processes; by default one a core, 0 for none beside this one.")
]
ResultFolder = Annotated[
    Path, typer.Argument(metavar="DIR", help="A result folder, as `scenewright bench` leaves it.", show_default=False)
]


def _parts(text: str) -> list[str]:
    """Return what stands between commas; a comma within options parts nothing."""
    found: list[str] = []
    for part in filter(None, (piece.strip() for piece in text.split(","))):
        if found and "=" in part and ":" not in part:
            found[-1] += f",{part}"
        else:
            found.append(part)
    if text and not found:
        raise InputError("nothing is named here", found=repr(text), fix="name something, or leave the option out")
    return list(dict.fromkeys(found))


def rows_of(text: str) -> tuple[int, ...]:
    """Return row numbers from ``1-4,20`` or ``all``; nothing where nothing was said.

    Raises
    ------
    InputError
        Where a part is neither a number nor a range, or there is none.

    Examples
    --------
    >>> rows_of("1-3,20")
    (1, 2, 3, 20)
    """
    if text.strip() == "all":
        from scenewright.study.benchmark import benchmark_rows

        return tuple(row.id for row in benchmark_rows())
    found: dict[int, None] = {}
    for part in _parts(text):
        match = re.fullmatch(r"(\d{1,4})(?:\s*-\s*(\d{1,4}))?", part)
        if match is None or int(match[2] or match[1]) < int(match[1]):
            raise InputError("these are no rows", found=repr(part), expected="numbers and ranges", fix="--rows 1-4,20")
        found.update(dict.fromkeys(range(int(match[1]), int(match[2] or match[1]) + 1)))
    return tuple(found)


def egos_of(text: str) -> tuple[str, ...]:
    """Return egos from ``idm,constant:speed_mps=12,keep=1`` or ``all``.

    >>> egos_of("idm,own.py:Ego:a=1,b=2,noisy")
    ('idm', 'own.py:Ego:a=1,b=2', 'noisy')
    """
    if text.strip() == "all":
        from scenewright.drive.loading import BUILT_IN

        return tuple(BUILT_IN)
    return tuple(_parts(text))


def methods_of(text: str) -> tuple[str, ...]:
    """Return methods by name from a list with commas, or ``all``."""
    from scenewright.study.rivals import METHODS

    return tuple(METHODS) if text.strip() == "all" else tuple(_parts(text))


def given_options(context: typer.Context) -> dict[str, object]:
    """Return the options that were typed, by name."""
    return {
        parameter.opts[0]: context.params[parameter.name]
        for parameter in context.command.params
        if parameter.name and getattr(context.get_parameter_source(parameter.name), "name", "") == "COMMANDLINE"
    }


def command_typed(given: dict[str, object], folder: Path) -> str:
    """Return the command that was typed, with its result folder, so that it can be typed again."""
    words = ["scenewright", "bench"]
    for option, value in given.items():
        if option != "--out":
            words += [option] if value is True else [option, str(value)]
    return shlex.join([*words, "--out", str(folder)])
