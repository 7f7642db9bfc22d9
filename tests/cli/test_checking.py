"""`check`: one answer for each source, the worst one's exit status, witnesses to look at."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from sentences import IMPOSSIBLE, SENTENCE

from scenarios import BRAKES
from scenewright.solve.proofs.refuters import SOLVERS

Command = Callable[..., Any]
# What would do is told by `run` in test_run.py, and by `check` in the documentation.
pytestmark = pytest.mark.usefixtures("nothing_proposed")


def test_one_line_for_each(command: Command, folder: Path) -> None:
    Path("good.txt").write_text(SENTENCE, encoding="utf-8")
    Path("bad.txt").write_text(IMPOSSIBLE, encoding="utf-8")
    result = command("check", "good.txt", "bad.txt")
    assert result.exit_code == 3
    good, bad = result.stdout.strip().splitlines()
    assert good.split() == ["feasible", "good.txt"]
    assert bad.startswith("infeasible  bad.txt  the hero ")  # in words: a description has no names for what it asks
    assert command("check", "good.txt", "good.txt").exit_code == 0


def test_what_was_assumed_is_told(command: Command, folder: Path) -> None:
    Path("idle.scene").write_text("parameters:\n- idle_m = 3\n" + BRAKES.text, encoding="utf-8")
    result = command("check", "idle.scene")
    assert result.exit_code == 0
    assert "assumed: no constraint speaks of the parameter idle_m" in result.stdout


def test_a_wrong_file_does_not_keep_the_others_from_their_turn(command: Command, folder: Path) -> None:
    Path("good.txt").write_text(SENTENCE, encoding="utf-8")
    result = command("check", "nowhere.scene", "good.txt")
    assert result.exit_code == 2
    assert "feasible    good.txt" in result.stdout
    assert "nowhere.scene" in result.stderr
    data = json.loads(command("check", "nowhere.scene", "good.txt", "--json").stdout)
    assert data["exit_status"] == 2
    assert [each["source"] for each in data["checks"]] == ["nowhere.scene", "good.txt"]
    assert data["checks"][0]["error"]["message"]
    assert data["checks"][1]["feasibility"]["answer"] == "feasible"


def test_a_witness_is_a_run_directory(command: Command, folder: Path) -> None:
    result = command("check", SENTENCE, "--out", "witness")
    assert result.exit_code == 0
    assert "witness/index.html" in result.stdout
    assert command("judge", "witness").exit_code == 0
    data = json.loads(command("check", SENTENCE, "--out", "again", "--json").stdout)
    assert data["verdict"]["success"]["tight"]
    assert Path(data["run_directory"], "trace.parquet").is_file()


def test_where_a_witness_is_no_success_as_a_run_it_says_why(command: Command, folder: Path) -> None:
    """A time to collision that is met while it rises, say: a proof does not ask how it came to be."""
    actors = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (lead):\n- W\n- [t0, go, t1, dec, t2]\n\n"
    asked = "Constraints:\nA0(t1) == A1(t1)\nttc(A0, A1, t1) == 3 s\nA1a(dec) == -3\nA1v(t2) == 0\n"
    Path("rises.scene").write_text(actors + asked, encoding="utf-8")
    for sources in (["rises.scene"], ["rises.scene", "rises.scene"]):
        result = command("check", *sources, "--out", "witness")
        missed = [line for line in result.stdout.replace("\n", " ").split("judged a failure: ")[1:] if line]
        assert result.exit_code == 0
        assert sum("it had not been shorter before" in line for line in missed) == len(sources)


def test_what_cannot_happen_has_no_witness(command: Command, folder: Path) -> None:
    assert command("check", IMPOSSIBLE, "--out", "witness").exit_code == 3
    assert list(folder.iterdir()) == []


def test_each_witness_has_a_folder(command: Command, folder: Path) -> None:
    Path("good.txt").write_text(SENTENCE, encoding="utf-8")
    Path("bad.txt").write_text(IMPOSSIBLE, encoding="utf-8")
    assert command("check", "good.txt", "bad.txt", "good.txt", "--out", "witnesses").exit_code == 3
    assert sorted(path.name for path in Path("witnesses").iterdir()) == ["001-good", "002-good"]


def test_another_solver_refutes_what_the_first_does(command: Command, folder: Path) -> None:
    missing = SOLVERS.known()["cvc5"]
    if missing is not None:
        pytest.skip(str(missing))
    result = command("check", IMPOSSIBLE, "--solver", "cvc5")
    assert result.exit_code == 3
    assert "These clash" in result.stdout


def test_a_numeric_solver_proves_nothing_and_is_named(command: Command, folder: Path) -> None:
    missing = SOLVERS.known()["scip"]
    if missing is not None:
        pytest.skip(str(missing))
    result = command("check", IMPOSSIBLE, "--solver", "scip")
    assert result.exit_code == 4
    assert "scip finds it impossible" in result.stdout
    assert "no proof" in result.stdout
    assert command("check", SENTENCE, "--solver", "scip").exit_code == 0


def test_solvers_are_listed_and_others_refused(command: Command, folder: Path) -> None:
    text = command("solvers").stdout
    assert all(name in text for name in SOLVERS.known())
    assert json.loads(command("solvers", "--json").stdout)["z3"].startswith("exact")
    refused = command("check", SENTENCE, "--solver", "z4")
    assert refused.exit_code == 2
    assert "there is no such solver" in refused.stderr
