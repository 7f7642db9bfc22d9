"""Signs of life of what takes long: a bar on a terminal, lines elsewhere; and Ctrl-C as a wish to stop.

What enters: how far it is. What leaves: characters on stderr. Nothing is run here.
"""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from types import FrameType

    from rich.console import Console
    from rich.progress import TaskID

T = TypeVar("T")
# Called with the name of what is done, how much of it is done, how much there is, and what else is to be said.
Show = Callable[[str, int, int, str], None]
_SAY_EVERY_S = 30.0


@contextmanager
def stoppable() -> Iterator[Callable[[], bool]]:
    """Let the first Ctrl-C ask for an end; the second one ends at once."""
    asked = False

    def ask(_number: int, _frame: FrameType | None) -> None:
        nonlocal asked
        asked = True
        signal.signal(signal.SIGINT, signal.default_int_handler)

    before = None
    with suppress(ValueError):  # not the main thread: no signal arrives
        before = signal.signal(signal.SIGINT, ask)
    try:
        yield lambda: asked
    finally:
        if before is not None:
            signal.signal(signal.SIGINT, before)


@contextmanager
def shown(console: Console) -> Iterator[Show]:
    """Show how far things are: a bar each on a terminal; elsewhere a line for each as it begins, then now and then."""
    if not console.is_terminal:
        yield _lines(console)
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[note]}"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console) as bar:
        tasks: dict[str, TaskID] = {}

        def show(stage: str, done: int, total: int, note: str = "") -> None:
            if stage not in tasks:
                tasks[stage] = bar.add_task(stage, note="")
            bar.update(tasks[stage], total=total, completed=done, note=note)

        yield show


def _lines(console: Console) -> Show:
    said_at: dict[str, float] = {}

    def show(stage: str, done: int, total: int, note: str = "") -> None:
        if time.monotonic() - said_at.get(stage, float("-inf")) >= _SAY_EVERY_S:
            said_at[stage] = time.monotonic()
            console.print(f"{stage}: {done} of {total}" + (f", {note}" if note else ""))

    return show


def tracked(console: Console, stage: str, items: Iterable[T], total: int) -> list[T]:
    """Return the items as a list, and show how many there are so far."""
    found: list[T] = []
    with shown(console) as show:
        show(stage, 0, total, "")
        for item in items:
            found.append(item)
            show(stage, len(found), total, "")
    return found
