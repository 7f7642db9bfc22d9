"""Spreads a task over processes so that nothing is lost: not by a crash, not by a hang, not by a kill of the parent.

What enters: a function that can be pickled, items, a number of processes. What leaves: each item with what the function
returned, or with how its process ended, in the order in which they are done. Nothing is written anywhere.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, Generic, TypeVar

from scenewright.errors import SolverError

T = TypeVar("T")
R = TypeVar("R")

_POLL_S = 0.25
_READY = "ready"
_ITEMS_A_PROCESS = 400  # solvers leave memory behind; a fresh process now and then costs little


@dataclass(frozen=True, slots=True)
class Crash:
    """How a task ended that did not return: what it raised, or how its process died."""

    message: str


def each_done(
    task: Callable[[T], R],
    items: Sequence[T],
    workers: int,
    stop: Callable[[], bool] = lambda: False,
    limit_s: float = 600.0,
) -> Iterator[tuple[T, R | Crash]]:
    """Do `task` on every item and yield each item with its result as soon as it is there.

    Parameters
    ----------
    workers
        Processes; 0 does everything in this one, without protection against crashes.
    stop
        Asked a few times a second; once it says yes, running tasks are dropped and no more is yielded.
    limit_s
        Wall time after which a task counts as crashed.

    Raises
    ------
    SolverError
        If a process cannot even start.
    """
    if workers == 0:
        for item in items:
            if stop():
                return
            yield item, _attempt(task, item)
        return
    pool = _Pool(task, min(workers, len(items)), limit_s)
    try:
        yield from pool.run(items, stop)
    finally:
        pool.close()


def _attempt(task: Callable[[T], R], item: T) -> R | Crash:
    try:
        return task(item)
    except (Exception, SystemExit) as error:  # what a task does is its own; the others go on
        return Crash((f"{type(error).__name__}: {error}".splitlines() or ["unknown"])[0])


class _Pool(Generic[T, R]):
    """Processes, each with a pipe of its own and at most one item under way."""

    def __init__(self, task: Callable[[T], R], size: int, limit_s: float) -> None:
        # Started afresh, not forked: a child of this process would inherit the other children's pipes and threads.
        self._context = multiprocessing.get_context("spawn")
        self._task = task
        self._limit_s = limit_s
        self._workers: list[_Worker[T]] = [self._start() for _ in range(size)]

    def run(self, items: Sequence[T], stop: Callable[[], bool]) -> Iterator[tuple[T, R | Crash]]:
        """Hand out the items and yield them as they come back."""
        left = list(reversed(items))
        while (left or any(worker.busy for worker in self._workers)) and not stop():
            for worker in self._workers:
                if left and worker.ready and not worker.busy:
                    worker.give(left.pop())
            wait([thing for worker in self._workers for thing in worker.waits_for], _POLL_S)
            for place, worker in enumerate(self._workers):
                ended = worker.collect(self._limit_s)
                if ended is not None:
                    yield ended
                if not worker.usable:
                    worker.end()
                    self._workers[place] = self._start()

    def _start(self) -> _Worker[T]:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(target=_serve, args=(theirs, self._task), daemon=True)
        process.start()
        theirs.close()
        return _Worker(process, ours)

    def close(self) -> None:
        """End all processes, whatever they are doing."""
        for worker in self._workers:
            worker.end()


class _Worker(Generic[T]):
    """One process, seen from the parent."""

    def __init__(self, process: BaseProcess, connection: Connection[Any, Any]) -> None:
        self._process = process
        self._connection = connection
        self._item: T | None = None
        self._since = time.monotonic()
        self._given = 0
        self.busy = False
        self.ready = False
        self.usable = True

    @property
    def waits_for(self) -> tuple[Connection[Any, Any] | int, ...]:
        """What becomes ready when there is news of this process."""
        return self._connection, self._process.sentinel

    def give(self, item: T) -> None:
        """Hand out an item; where the process has died meanwhile, `collect` will say so."""
        self._item, self._since, self.busy = item, time.monotonic(), True
        self._given += 1
        try:
            self._connection.send(item)
        except OSError:
            return

    def collect(self, limit_s: float) -> tuple[T, Any] | None:
        """Return the item under way with its result where it has ended, one way or the other."""
        try:
            while self._connection.poll():
                word, value = self._connection.recv()
                if word == _READY:
                    self.ready = True
                    continue
                self.usable = self._given < _ITEMS_A_PROCESS
                return self._ended(value)
        except (EOFError, OSError):
            return self._died()
        if not self._process.is_alive() and not self._connection.poll():
            return self._died()
        if self.busy and time.monotonic() - self._since > limit_s:
            self.usable = False
            return self._ended(Crash(f"it took longer than {limit_s:g} s"))
        return None

    def _died(self) -> tuple[T, Any] | None:
        self._process.join(timeout=5.0)
        self.usable = False
        if not self.ready:
            raise SolverError(
                "a process to run cases in could not start",
                found=f"exit status {self._process.exitcode}",
                fix="try --workers 0, which runs everything in one process",
            )
        return self._ended(Crash(f"its process died ({_how(self._process.exitcode)})")) if self.busy else None

    def _ended(self, value: Any) -> tuple[T, Any]:
        assert self._item is not None
        item, self.busy = self._item, False
        return item, value

    def end(self) -> None:
        """End the process now."""
        self._connection.close()
        self._process.kill()
        self._process.join()


def _how(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        return signal.Signals(-exit_code).name
    return f"exit status {exit_code}"


# -- in the child ---------------------------------------------------------------------------------------------------
def _serve(connection: Connection[Any, Any], task: Callable[[Any], Any]) -> None:
    """Do what comes through the pipe until nothing comes any more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the whole group; the parent decides what it means
    os.dup2(2, 1)  # whatever a policy prints must not get between the parent's own output
    threading.Thread(target=_end_with_parent, daemon=True).start()
    connection.send((_READY, None))
    while True:
        try:
            item = connection.recv()
        except (EOFError, OSError):
            return
        connection.send(("done", _attempt(task, item)))


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
