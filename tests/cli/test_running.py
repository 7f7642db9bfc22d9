"""Ctrl-C: it waits while what was driven is written, is never lost, and keeps what was driven whenever it comes."""

from __future__ import annotations

import io
import os
import signal
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from scenewright.cli.running import _Shield, report_verdict
from scenewright.judge.aftermath import Aftermath
from scenewright.judge.verdict import Verdict, bounded
from scenewright.orchestrate import orchestrate
from scenewright.request import EXIT_STATUS, Request
from stories import STORIES


def test_what_comes_behind_the_shield_comes_when_it_is_lowered() -> None:
    shield, before = _Shield(), signal.getsignal(signal.SIGINT)
    shield.up()
    os.kill(os.getpid(), signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        shield.down()
    assert signal.getsignal(signal.SIGINT) is before
    shield.up()
    shield.down()  # it comes once


def test_at_the_very_end_it_is_no_longer_needed() -> None:
    shield = _Shield()
    shield.up()
    os.kill(os.getpid(), signal.SIGINT)
    shield.down(raises=False)
    shield.up()
    shield.down()


@pytest.mark.parametrize(
    ("where", "takes"),
    [
        ("scenewright.simulate.beginning.first_plan", 2),
        ("scenewright.explain.cause.cause_of", 1),
        ("scenewright.simulate.hindsight.ego_left_no_room", 2),
    ],
)
def test_after_the_first_take_it_keeps_what_was_driven(
    where: str, takes: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module, _, name = where.rpartition(".")
    real, calls = getattr(import_module(module), name), []

    def interrupted(*given: Any) -> Any:
        calls.append(given)
        if name == "first_plan" and len(calls) == 1:
            return real(*given)
        raise KeyboardInterrupt

    # A proof takes longer than the run; here it is of no matter whether there is one.
    monkeypatch.setattr("scenewright.simulate.hindsight.ego_left_no_room", lambda *_: None)
    monkeypatch.setattr(where, interrupted)
    result = orchestrate(Request(STORIES["goes first, distance"], ego="speeder", takes=takes, out=tmp_path / "run"))
    assert (result.status, EXIT_STATUS[result.status]) == ("interrupted", 130)
    assert result.verdict is not None
    assert (tmp_path / "run" / "trace.parquet").is_file()


@pytest.mark.parametrize(
    ("times", "came", "told"),
    [
        ({"hero": 4.0}, {"hero": True}, "The trigger came at 4.00 s."),
        ({"hero": 4.0}, {"hero": False}, "The trigger never came; it was nearest at 4.00 s."),
        ({"a": 4.0, "b": 5.0}, {"a": True, "b": True}, "The triggers came at 4.00 s (a), 5.00 s (b)."),
        (
            {"a": 4.0, "b": 5.0},
            {"a": True, "b": False},
            "The trigger came at 4.00 s (a). The trigger of b never came; it was nearest at 5.00 s.",
        ),
        ({"hero": float("inf")}, {"hero": False}, "No trigger came."),
    ],
)
def test_a_trigger_that_never_came_is_not_told_as_one_that_did(
    times: dict[str, float], came: dict[str, bool], told: str
) -> None:
    calm = Aftermath(None, 3.0, None, None, 0.0, 0.0, None, 20.0)
    verdict = Verdict((), calm, {"trigger_time_s": times, "trigger_came": came})
    console = Console(record=True, width=100, file=io.StringIO())
    report_verdict(console, verdict, "tight")
    assert told in console.export_text()


def test_that_the_ego_never_came_to_one_trigger_does_not_hide_that_another_came() -> None:
    calm = Aftermath(None, 3.0, None, None, 0.0, 0.0, None, 20.0)
    facts = {"trigger_time_s": {"a": 4.0, "b": 5.0}, "trigger_came": {"a": True, "b": False}}
    console = Console(record=True, width=200, file=io.StringIO())
    report_verdict(console, Verdict((), calm, {**facts, "ego_never_met_condition": True}), "tight")
    told = console.export_text()
    assert "The trigger came at 4.00 s (a). The trigger of b never came; it was nearest at 5.00 s." in told
    assert "The ego never came within the tight tolerance of its side of one of them." in told


@pytest.mark.parametrize(
    ("missed", "status", "told"),
    [
        (1, "finished", "Failure: 1 of 3 conditions misses the tight tolerance."),
        (2, "finished", "Failure: 2 of 3 conditions miss the tight tolerance."),
        (1, "interrupted", "The run was interrupted; as far as it got, 1 condition misses the tight tolerance."),
        (0, "interrupted", "The run was interrupted; as far as it got, 0 conditions miss the tight tolerance."),
    ],
)
def test_one_condition_misses_and_several_miss(missed: int, status: str, told: str) -> None:
    conditions = tuple(
        bounded(str(k), "safety", "it holds", required=0.0, measured=0.0, error=float(k < missed), dimension="length")
        for k in range(3)
    )
    calm = Aftermath(None, 3.0, None, None, 0.0, 0.0, None, 20.0)
    console = Console(record=True, width=100, file=io.StringIO())
    report_verdict(console, Verdict(conditions, calm, {}), "tight", status)
    assert told in console.export_text()


def test_of_a_program_without_a_trigger_none_is_told() -> None:
    verdict = Verdict((), Aftermath(None, 3.0, None, None, 0.0, 0.0, None, 20.0), {"trigger_time_s": {}})
    console = Console(record=True, width=100, file=io.StringIO())
    report_verdict(console, verdict, "tight")
    assert "rigger came" not in console.export_text()
