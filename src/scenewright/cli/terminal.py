"""What is shown with rich: consoles that leave a closed pipe to others, and signs of life on a terminal.

What enters: files to write to, names of stages. What leaves: characters. Imported only where something is shown.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any, Self

from rich.console import Console
from rich.status import Status

PLAIN_WIDTH = 100
_PATIENCE_S = 1.0


class QuietConsole(Console):
    """A console that leaves a closed pipe to whoever can end the command."""

    def on_broken_pipe(self) -> None:
        """Hand the broken pipe on instead of ending the process here."""
        raise BrokenPipeError


def console_on(file: Any) -> QuietConsole:
    """Return a console: as wide as the terminal, or of one width where there is none."""
    reconfigure = getattr(file, "reconfigure", None)
    if reconfigure is not None:
        reconfigure(errors="backslashreplace")  # a description in any script goes through on any terminal
    width = None if file.isatty() or os.environ.get("COLUMNS") else PLAIN_WIDTH
    return QuietConsole(file=file, highlight=False, markup=False, width=width)


class SignsOfLife:
    """Says on a terminal what is going on, once it takes longer than a second."""

    def __init__(self, console: Console, wanted: bool = True) -> None:
        self._console = console
        self._wanted = wanted and console.is_terminal
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

    @contextmanager
    def silent(self) -> Iterator[None]:
        """Leave the terminal to a question for as long as it is asked."""
        with self._lock:
            if self._status is not None:
                self._status.stop()
            yield
            if self._status is not None:
                self._status.start()

    def _show(self) -> None:
        with self._lock:
            if self._wanted:
                self._status = self._console.status(self._text)
                self._status.start()
