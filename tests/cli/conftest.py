"""What the command's tests share: a clean folder, the command in this process, the command in a process of its own."""

from __future__ import annotations

import itertools
import os
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from typer.main import get_command
from typer.testing import CliRunner

from scenewright.cli.app import app
from scenewright.study import evaluation, experiment, rejudge
from scenewright.study import workers as workers_module
from scenewright.study.report import measuring

# `sentences` is a helper of these tests alone; import mode `importlib` does not put their folder on the path.
sys.path.insert(0, str(Path(__file__).parent))

_numbers = itertools.count()
# As in a process of its own, the command is made of its functions once: it takes as long as many a command.
made_of = cache(get_command)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Every test works in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("COLUMNS", raising=False)
    return tmp_path


@pytest.fixture(autouse=True)
def runs_planned_seldom(replanned_seldom: None) -> None:
    """What becomes of a run is the matter of other tests."""


@pytest.fixture
def command(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Any]:
    """Return the command, called in this process with words; the result has exit_code, stdout and stderr."""
    monkeypatch.setattr("typer.testing._get_command", made_of)
    return lambda *words: CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def process() -> Callable[..., subprocess.Popen[str]]:
    """Return the command, started in a process of its own."""

    def start(*words: str, **settings: Any) -> subprocess.Popen[str]:
        environment = {**os.environ, "PYTHONUNBUFFERED": "1", **settings.pop("env", {})}
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.DEVNULL, **settings}
        return subprocess.Popen([sys.executable, "-m", "scenewright", *words], text=True, env=environment, **pipes)

    return start


@pytest.fixture
def policy(folder: Path) -> Callable[[str], str]:
    """Return a maker of policies: it takes the body of `step` and returns what --ego is to be."""

    def write(body: str) -> str:
        name = f"policy_of_a_user_{next(_numbers)}"  # a module is imported once a process
        lines = "\n".join("        " + line for line in body.splitlines())
        text = (
            "import math, sys, time\nfrom scenewright.drive.protocol import EgoMotion\n\n\nclass Own:\n"
            f"    def reset(self, start): pass\n\n    def step(self, observation, dt_s):\n{lines}\n"
        )
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
        return f"{name}:Own"

    return write


@pytest.fixture
def in_one_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let cases run in this process whatever `--workers` says: where a case takes less than a process to start."""

    def each_done(task: Any, items: Any, workers: int, *settings: Any) -> Any:
        return workers_module.each_done(task, items, 0, *settings)

    for module in (evaluation, experiment, measuring, rejudge):
        monkeypatch.setattr(module, "each_done", each_done)
