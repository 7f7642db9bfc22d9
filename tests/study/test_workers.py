"""Workers: nothing is lost, whatever a task does to its process."""

from __future__ import annotations

import math
import operator
import os
import signal
import time

import pytest

from scenewright.errors import SolverError
from scenewright.study.workers import Crash, each_done


@pytest.mark.parametrize("workers", [0, 1, 3])
def test_every_item_comes_back_once_with_its_result(workers: int) -> None:
    done = list(each_done(math.factorial, range(20), workers))
    assert sorted(done) == [(n, math.factorial(n)) for n in range(20)]


@pytest.mark.parametrize("workers", [0, 2])
def test_what_a_task_raises_is_told_and_the_others_go_on(workers: int) -> None:
    done = dict(each_done(math.sqrt, [4.0, -1.0, 9.0], workers))
    assert (done[4.0], done[9.0]) == (2.0, 3.0)
    assert done[-1.0] == Crash("ValueError: math domain error")


def test_exit_is_not_the_end() -> None:
    assert dict(each_done(operator.call, [exit_now], 0))[exit_now] == Crash("SystemExit: 3")


def exit_now() -> None:
    raise SystemExit(3)


def test_process_that_dies_costs_its_own_item_only() -> None:
    done = list(each_done(os._exit, [7, 7, 7, 7], 2))
    assert done == [(7, Crash("its process died (exit status 7)"))] * 4


def test_process_that_is_killed_says_by_what() -> None:
    done = dict(each_done(signal.raise_signal, [int(signal.SIGKILL), 0], 1))
    assert done[int(signal.SIGKILL)] == Crash("its process died (SIGKILL)")
    assert isinstance(done[0], Crash) or done[0] is None


def test_hanging_task_is_ended() -> None:
    done = dict(each_done(time.sleep, [60.0, 0.0], 1, limit_s=1.0))
    assert done == {60.0: Crash("it took longer than 1 s"), 0.0: None}


def test_stop_drops_what_is_under_way() -> None:
    began = time.monotonic()
    assert list(each_done(time.sleep, [60.0, 60.0], 2, stop=lambda: time.monotonic() - began > 0.5)) == []
    assert time.monotonic() - began < 30.0


def test_process_that_cannot_start_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scenewright.study.workers._serve", os._exit)  # its arguments do not fit: it dies at once
    with pytest.raises(SolverError, match="could not start"):
        list(each_done(math.sqrt, [4.0], 1))
