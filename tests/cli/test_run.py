"""`run`: a success with all its files, what it prints, where it writes, and the exit status of each end."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from sentences import IMPOSSIBLE, OPEN_SENTENCE, SENTENCE

from forms import PROBE, UNPLANNED

Command = Callable[..., Any]
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
FILES = {
    "manifest.json", "program.scene", "params.json", "plan.json", "trace.parquet", "replans.parquet", "verdict.json",
    "answers.json",
    "description.txt",
    "index.html",
}  # fmt: skip


def listed(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_success_writes_every_file_and_says_what_happened(command: Command, folder: Path) -> None:
    result = command("run", SENTENCE, "--out", "here")
    assert result.exit_code == 0, result.stderr
    assert listed(folder / "here") == FILES
    assert "Success" in result.stdout
    told = " ".join(result.stdout.split())
    assert "the hero begins to brake until it stands 8 m" in told
    assert not re.search(r"\bA\d+[xva(.]|==|<=|>=|\bt\d\b|\bdec\b", told), "no letters of the program language"
    assert "here/index.html" in result.stdout
    assert "scenewright view here" in result.stdout
    assert "understood offline" in told
    assert "✓" in result.stdout
    assert result.stderr == ""


def test_json_is_one_object_and_all_there_is_on_stdout(command: Command, policy: Callable[[str], str]) -> None:
    ego = policy("print('a policy that talks')\nreturn 0.0")
    result = command("run", OPEN_SENTENCE, "-p", "ego_gap_m=30", "--ego", ego, "--json")
    data = json.loads(result.stdout)
    assert (data["status"], data["exit_status"], result.exit_code) == ("success", 0, 0)
    assert data["verdict"]["success"] == {"tight": True, "loose": True}
    assert data["parameters"] == {"ego_gap_m": {"value": 30.0, "unit": "m", "source": "given"}}
    assert Path(data["page"]).is_file()
    assert data["error"] is None
    assert "a policy that talks" in result.stderr


def test_open_parameter_is_chosen_and_reported(command: Command) -> None:
    result = command("run", OPEN_SENTENCE)
    assert result.exit_code == 0, result.stderr
    assert "ego_gap_m" in result.stdout
    assert "chosen: you left it open" in result.stdout


def test_quiet_prints_only_where_the_run_is(command: Command) -> None:
    result = command("run", SENTENCE, "--quiet")
    assert Path(result.stdout.strip(), "index.html").is_file()
    assert result.stderr == ""


def test_runs_are_numbered_and_named(command: Command, folder: Path) -> None:
    (folder / "left turn.txt").write_text(SENTENCE, encoding="utf-8")
    (folder / "runs").mkdir()
    (folder / "runs" / "041-old").mkdir()
    for _ in range(2):
        assert command("run", "left turn.txt", "--quiet").exit_code == 0
    assert listed(folder / "runs") == {"041-old", "042-left-turn", "043-left-turn"}


def test_earlier_run_is_overwritten_and_other_files_stay(command: Command, folder: Path) -> None:
    assert command("run", SENTENCE, "--out", "here").exit_code == 0
    (folder / "here" / "my notes.txt").write_text("keep", encoding="utf-8")
    (folder / "here" / "verdict.json").write_text("{}", encoding="utf-8")
    assert command("run", SENTENCE, "--out", "here").exit_code == 0
    assert listed(folder / "here") == FILES | {"my notes.txt"}
    assert json.loads((folder / "here" / "verdict.json").read_text(encoding="utf-8"))["success"]["tight"]


def test_folder_with_something_else_is_refused_untouched(command: Command, folder: Path) -> None:
    (folder / "thesis").mkdir()
    (folder / "thesis" / "index.html").write_text("mine", encoding="utf-8")
    result = command("run", SENTENCE, "--out", "thesis")
    assert result.exit_code == 2
    assert "index.html" in result.stderr
    assert (folder / "thesis" / "index.html").read_text(encoding="utf-8") == "mine"
    assert listed(folder / "thesis") == {"index.html"}


def test_infeasible_is_explained_and_leaves_no_folder(command: Command, folder: Path) -> None:
    result = command("run", IMPOSSIBLE)
    assert result.exit_code == 3
    assert "This cannot happen" in result.stderr
    assert "It would be possible with" in result.stderr
    assert "km/h instead of 200 km/h" in result.stderr
    assert listed(folder) == set()


def test_infeasible_as_json(command: Command) -> None:
    result = command("run", IMPOSSIBLE, "--json")
    data = json.loads(result.stdout)
    assert (data["status"], data["exit_status"], result.exit_code) == ("infeasible", 3, 3)
    assert data["run_directory"] is None
    assert "This cannot happen" in data["explanation"]
    assert data["feasibility"]["suggestions"]


def test_failure_has_status_one_and_names_what_missed(command: Command, policy: Callable[[str], str]) -> None:
    # It floors the pedal and brakes in turn, so hard that nobody can meet it at a place and time.
    ego = policy("return 7.0 if int(observation.time_s / 0.9) % 2 else -9.0")
    result = command("run", SENTENCE, "--ego", ego, "--mode", "open", "--out", "here")
    assert result.exit_code == 1
    assert "Failure" in result.stdout
    assert "✗" in result.stdout
    assert not json.loads(Path("here/verdict.json").read_text(encoding="utf-8"))["success"]["tight"]


def test_a_collision_is_told_beside_the_success_and_can_fail_the_run(
    command: Command, policy: Callable[[str], str]
) -> None:
    """The hero brakes to a stop ahead of an ego that never brakes: that is what was asked for, and a crash."""
    ego = policy("return 0.0")
    words = ("run", EXAMPLES / "brakes_ahead.txt", "--ego", ego, "--out", "here")
    result = command(*words)
    assert result.exit_code == 0, result.stderr
    success, came = result.stdout.index("Success"), result.stdout.index("What came of it: the ego hit the hero at ")
    assert success < came
    assert "until then the ego did not brake; the run goes on as if they had not touched" in result.stdout
    assert "no collision" not in result.stdout
    kept = json.loads(Path("here/verdict.json").read_text(encoding="utf-8"))["aftermath"]
    assert kept["collision"]["actors"] == ["ego", "hero"]

    failed, judged = (command(*again, "--fail-on", "collision", "--json") for again in (words, ("judge", "here")))
    assert (failed.exit_code, judged.exit_code) == (1, 1)
    data = json.loads(failed.stdout)
    assert (data["status"], data["exit_status"]) == ("success", 1)
    assert data["verdict"]["aftermath"] == kept
    assert command("judge", "here").exit_code == 0
    why = "Exit status 1: a collision is to count (--fail-on collision)."
    assert why in command("judge", "here", "--fail-on", "collision").stdout
    assert why in command(*words, "--fail-on", "collision").stdout
    assert why not in result.stdout


def test_a_near_miss_is_told_and_is_no_collision(command: Command) -> None:
    result = command("run", SENTENCE, "--out", "here", "--fail-on", "collision")
    assert result.exit_code == 0, result.stderr
    assert "What came of it: no collision; closest " in result.stdout
    assert command("judge", "here", "--fail-on", "collision").exit_code == 0
    assert command("run", SENTENCE, "--fail-on", "rain").exit_code == 2


@pytest.mark.usefixtures("searched_less")
def test_gives_up_with_what_the_planner_cannot_hold(command: Command, tmp_path: Path) -> None:
    program = tmp_path / "not_to_be_held.scene"
    program.write_text(UNPLANNED, encoding="utf-8")
    result = command("run", program, "--ego", "constant")
    assert result.exit_code == 4
    assert "cannot hold" in result.stderr
    data = json.loads(command("run", program, "--ego", "constant", "--json").stdout)
    assert (data["status"], data["exit_status"]) == ("gave up", 4)
    assert PROBE in data["tried"]


def test_gives_up_where_the_smt_planner_finds_nothing(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scenewright.plan.smt.WORK_PER_S", 1)
    result = command("run", SENTENCE, "--planner", "smt")
    assert result.exit_code == 4
    assert "Nothing was driven: the SMT planner found no first plan" in result.stderr
    assert "z3 gave up" in json.loads(command("run", SENTENCE, "--planner", "smt", "--json").stdout)["tried"]
    assert command("run", SENTENCE, "--planner", "paper").exit_code == 2


def test_same_inputs_and_seed_give_the_same_trace(command: Command) -> None:
    for out in ("a", "b"):
        assert command("run", SENTENCE, "--ego", "noisy", "--seed", "7", "--out", out, "--quiet").exit_code in (0, 1)
    assert Path("a/trace.parquet").read_bytes() == Path("b/trace.parquet").read_bytes()


def test_simulators_are_listed_and_others_refused(command: Command, folder: Path) -> None:
    assert "drives the policy of --ego" in command("simulators").stdout
    assert json.loads(command("simulators", "--json").stdout)["builtin"].endswith("repeatable")
    refused = command("run", SENTENCE, "--simulator", "none", "--out", "here")
    assert refused.exit_code == 2
    assert "no such simulator" in refused.stderr
    assert "builtin" in refused.stderr
