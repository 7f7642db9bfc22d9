"""Where output goes: text for people, JSON for programs, and signs of life on a terminal.

What enters: texts and tables. What leaves: characters on stdout and stderr that the terminal at hand can show.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from types import TracebackType
from typing import Any, Self

from rich.console import Console
from rich.status import Status

PLAIN_WIDTH = 100
_PATIENCE_S = 1.0


class _Quiet(Console):
    """A console that leaves a closed pipe to whoever can end the command."""

    def on_broken_pipe(self) -> None:
        """Hand the broken pipe on instead of ending the process here."""
        raise BrokenPipeError


def stdout() -> Console:
    """Return a console on what is stdout now; as wide as the terminal, or of one width where there is none."""
    return _console(sys.stdout)


def stderr() -> Console:
    """Return a console on what is stderr now."""
    return _console(sys.stderr)


def _console(file: Any) -> Console:
    reconfigure = getattr(file, "reconfigure", None)
    if reconfigure is not None:
        reconfigure(errors="backslashreplace")  # a description in any script goes through on any terminal
    width = None if file.isatty() or os.environ.get("COLUMNS") else PLAIN_WIDTH
    return _Quiet(file=file, highlight=False, markup=False, width=width)


def marks() -> tuple[str, str]:
    """Return how to say yes and no, told apart by more than colour; words where the terminal has no such signs."""
    encoding = (getattr(sys.stdout, "encoding", None) or "ascii").lower()
    return ("✓", "✗") if encoding.startswith("utf") else ("yes", "NO")


def print_json(data: object) -> None:
    """Write one JSON value to stdout, and nothing else."""
    sys.stdout.write(json.dumps(data, indent=2, allow_nan=False) + "\n")
    sys.stdout.flush()


def drop_output() -> None:
    """Send what is still to be written nowhere: the reader of our pipe has gone."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class SignsOfLife:
    """Says on stderr what is going on, once it takes longer than a second, and only on a terminal."""

    def __init__(self, wanted: bool = True) -> None:
        self._console = stderr()
        self._wanted = wanted and self._console.is_terminal
        self._status: Status | None = None
        self._text = "starting"
        self._lock = threading.Lock()
        self._timer = threading.Timer(_PATIENCE_S, self._show)
        self._timer.daemon = True

    def __enter__(self) -> Self:
        if self._wanted:
            self._timer.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._timer.cancel()
        with self._lock:
            self._wanted = False
            if self._status is not None:
                self._status.stop()

    def say(self, text: str) -> None:
        """Note what is going on now."""
        self._text = text
        if self._status is not None:
            self._status.update(text)

    def _show(self) -> None:
        with self._lock:
            if self._wanted:
                self._status = self._console.status(self._text)
                self._status.start()
