"""The command as a process: what a start loads, Ctrl-C, a closed pipe, terminals without signs, --debug anywhere."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from scenewright import cli
from scenewright.cli.app import SENTENCE

Start = Callable[..., "subprocess.Popen[str]"]
HEAVY = {"numpy", "z3", "scipy", "shapely", "pyarrow", "matplotlib", "lark", "lxml"}


@pytest.mark.parametrize("words", [["--help"], ["--version"], ["run", "--help"]])
def test_start_loads_nothing_heavy(words: list[str]) -> None:
    code = (
        "import sys\nfrom scenewright.cli import main\n"
        f"try: main({words!r})\nexcept SystemExit: pass\nprint('LOADED', *sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert sorted(HEAVY & set(done.stdout.partition("LOADED")[2].split())) == []


def test_interrupted_run_is_kept_and_can_be_judged_and_viewed(
    process: Start, command: Callable[..., Any], policy: Callable[[str], str]
) -> None:
    ego = policy(
        "if observation.others:\n    time.sleep(0.02)\n    if observation.time_s > 1.0: open('driving', 'w').close()\n"
        "return 0.0"
    )
    running = process("run", SENTENCE, "--ego", ego, "--out", "here", "--json")
    wait_for(Path("driving"), running)
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "kept in here" in err
    assert "Traceback" not in err
    data = json.loads(out)
    assert (data["status"], data["exit_status"]) == ("interrupted", 130)
    assert json.loads(Path("here/manifest.json").read_text(encoding="utf-8"))["status"] == "interrupted"
    judged = command("judge", "here")
    assert judged.exit_code == 1
    assert "interrupted" in judged.stdout
    assert command("view", "here", "--no-browser").exit_code == 0


def test_interrupted_before_anything_is_driven(process: Start, policy: Callable[[str], str]) -> None:
    ego = policy("open('alone', 'w').close()\ntime.sleep(0.02)\nreturn 0.0")
    running = process("run", SENTENCE, "--ego", ego, "--out", "here")
    wait_for(Path("alone"), running)
    running.send_signal(signal.SIGINT)
    _, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "nothing was written" in err
    assert "Traceback" not in err
    assert not Path("here").exists()


def wait_for(path: Path, running: subprocess.Popen[str]) -> None:
    for _ in range(3000):
        if path.exists():
            return
        assert running.poll() is None, running.communicate()
        time.sleep(0.01)
    pytest.fail("the run never came that far")


@pytest.mark.parametrize("words", [["maps", "t_intersection"], ["egos", "--json"], ["run", SENTENCE]])
def test_closed_pipe_is_no_fault(process: Start, words: list[str]) -> None:
    running = process(*words)
    assert running.stdout is not None
    assert running.stderr is not None
    running.stdout.close()
    err = running.stderr.read()
    running.stderr.close()
    assert running.wait(timeout=60) == cli.BROKEN_PIPE
    assert err == ""


def test_output_without_unicode_still_says_yes_and_no(process: Start) -> None:
    done = process("run", SENTENCE, env={"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"})
    out, err = done.communicate(timeout=60)
    assert done.returncode == 0, err
    assert "yes" in out
    assert out.isascii()


def test_debug_may_stand_anywhere_before_the_end_of_options() -> None:
    assert cli._debug_first(["maps", "x", "--debug"]) == ["--debug", "maps", "x"]
    assert cli._debug_first(["maps", "--", "--debug"]) == ["maps", "--", "--debug"]


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["run", "--json"], "Missing argument"),
        (["run", "x", "--takes", "zero", "--json"], "--takes"),
        (["nonsense", "--json"], "No such command"),
    ],
)
def test_what_is_typed_wrong_is_told_to_programs_too(process: Start, words: list[str], part: str) -> None:
    running = process(*words)
    out, err = running.communicate(timeout=60)
    data = json.loads(out)
    assert running.returncode == data["exit_status"] == 2
    assert data["error"]["error"] == "UsageError"
    assert part in data["error"]["message"]
    assert "Usage:" in err
