"""Where output goes: text for people, JSON for programs.

What enters: what is to be said. What leaves: characters on stdout and stderr. rich is imported only where it is used:
the command, its completion and its JSON start without it.
"""

from __future__ import annotations

import json
import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console


def stdout() -> Console:
    """Return a console on what is stdout now."""
    from scenewright.cli.terminal import console_on

    return console_on(sys.stdout)


def stderr() -> Console:
    """Return a console on what is stderr now."""
    from scenewright.cli.terminal import console_on

    return console_on(sys.stderr)


def marks() -> tuple[str, str]:
    """Return how to say yes and no, told apart by more than colour; words where the terminal has no such signs."""
    encoding = (getattr(sys.stdout, "encoding", None) or "ascii").lower()
    return ("✓", "✗") if encoding.startswith("utf") else ("yes", "NO")


def print_json(data: object) -> None:
    """Write one JSON value to stdout, and nothing else."""
    sys.stdout.write(json.dumps(data, indent=2, allow_nan=False) + "\n")
    sys.stdout.flush()


def drop_output() -> None:
    """Send what is still to be written nowhere: whoever read it has gone, or it cannot be written."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):  # stdout is no file of the system's: nothing is left to be written to one
        return
