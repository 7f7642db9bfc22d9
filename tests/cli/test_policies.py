"""Policies that misbehave: status 2, the policy named, and what was driven until then kept."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from scenewright.cli.app import SENTENCE

Command = Callable[..., Any]
Policy = Callable[[str], str]

BODIES = {
    "raises": ("raise ValueError('boom')", "ValueError: boom"),
    "NaN": ("return math.nan", "nan"),
    "text": ("return 'fast'", "'fast'"),
    "teleports": (
        "ego = observation.ego\nreturn EgoMotion(ego.x_m + 50.0, ego.y_m, ego.heading_rad, ego.speed_mps)",
        "50.00 m from where the ego was",
    ),
    "ends the process": ("sys.exit(0)", "SystemExit: 0"),
}


@pytest.mark.parametrize("name", BODIES)
def test_fault_from_the_start(command: Command, policy: Policy, folder: Path, name: str) -> None:
    body, found = BODIES[name]
    result = command("run", SENTENCE, "--ego", policy(body), "--out", "here")
    assert result.exit_code == 2
    assert found in result.stderr
    assert "policy_of_a_user" in result.stderr
    assert not (folder / "here").exists()


@pytest.mark.parametrize("name", ["raises", "NaN", "teleports"])
def test_fault_on_the_way_keeps_what_was_driven(command: Command, policy: Policy, name: str) -> None:
    body, found = BODIES[name]
    late = "\n".join("    " + line for line in body.splitlines())
    ego = policy(f"if observation.others and observation.time_s > 2.0:\n{late}\nreturn 0.0")
    result = command("run", SENTENCE, "--ego", ego, "--out", "here")
    assert result.exit_code == 2
    assert found in result.stderr
    assert json.loads(Path("here/manifest.json").read_text(encoding="utf-8"))["status"] == "failed"
    assert "ended in a fault" in result.stdout
    assert command("judge", "here").exit_code == 1
    assert command("view", "here", "--no-browser").exit_code == 0


def test_fault_on_the_way_as_json(command: Command, policy: Policy) -> None:
    ego = policy("if observation.others and observation.time_s > 2.0: raise ValueError('boom')\nreturn 0.0")
    result = command("run", SENTENCE, "--ego", ego, "--json")
    data = json.loads(result.stdout)
    assert (data["status"], data["exit_status"], result.exit_code) == ("failed", 2, 2)
    assert "boom" in data["error"]["found"]
    assert Path(data["run_directory"], "trace.parquet").is_file()
