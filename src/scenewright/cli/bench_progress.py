"""Signs of life of an experiment: a bar on a terminal, lines elsewhere; and Ctrl-C as a wish to stop.

What enters: how far it is. What leaves: characters on stderr. Nothing is run here.
"""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

    from rich.console import Console
    from rich.progress import TaskID

    from scenewright.study.experiment import Progress

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
def shown(console: Console) -> Iterator[Callable[[Progress], None]]:
    """Show how far the experiment is: a bar on a terminal, a line now and then elsewhere."""
    if not console.is_terminal:
        yield _lines(console)
        return
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    columns = (
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[said]},"),
        TimeElapsedColumn(),
        TextColumn("gone,"),
        TimeRemainingColumn(),
        TextColumn("to go"),
    )
    with Bar(*columns, console=console) as bar:
        task, rate = bar.add_task("cases", said=""), _rate()

        def show(progress: Progress) -> None:
            said = f"{rate(progress)}, {_successes(progress)}"
            bar.update(task, total=progress.total, completed=progress.done, said=said)

        yield show


def _lines(console: Console) -> Callable[[Progress], None]:
    said_at, rate = time.monotonic(), _rate()

    def show(progress: Progress) -> None:
        nonlocal said_at
        pace = rate(progress)
        if time.monotonic() - said_at >= _SAY_EVERY_S:
            said_at = time.monotonic()
            console.print(f"{progress.done} of {progress.total} cases, {pace}, {_successes(progress)}")

    return show


def _rate() -> Callable[[Progress], str]:
    began = time.monotonic()
    return lambda progress: f"{progress.new / max(time.monotonic() - began, 1e-6):.1f} a second"


def _successes(progress: Progress) -> str:
    errors = f", {progress.errors} errors" if progress.errors else ""
    return f"{progress.successes} successes{errors}"


@contextmanager
def stages_shown(console: Console) -> Iterator[Callable[[str, int, int], None]]:
    """Show the stages of a report: a bar each on a terminal, a line each elsewhere."""
    if not console.is_terminal:
        said: set[str] = set()

        def tell(stage: str, _done: int, _total: int) -> None:
            if stage not in said:
                said.add(stage)
                console.print(f"report: {stage}")

        yield tell
        return
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn
    from rich.progress import Progress as Bar

    with Bar(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), console=console) as bar:
        tasks: dict[str, TaskID] = {}

        def show(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                tasks[stage] = bar.add_task(stage)
            bar.update(tasks[stage], total=total, completed=done)

        yield show
