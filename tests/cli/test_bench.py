"""`bench` on the command line: killed and gone on with, replayed, judged again, compared, asked for what is missing."""

from __future__ import annotations

import contextlib
import json
import os
import shlex
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest
import typer
from test_help import examples_of
from typer.testing import CliRunner

from scenewright.cli.bench import app
from scenewright.study.lines import LineLog
from scenewright.study.store import LINES_FILE, CaseRecord, read_results, write_settings
from scenewright.trace.files import read_trace, write_trace
from scenewright.trace.model import Trace
from stories import replan_seldom

Command = Callable[..., Any]
Start = Callable[..., "subprocess.Popen[str]"]
SMALL = ("bench", "--rows", "16-17", "--egos", "constant,idm", "--draws", "1")
HERE = (*SMALL, "--out", "here", "--workers")
KEYS = [f"{row}-{ego}-0-scenewright" for row in (16, 17) for ego in ("constant", "idm")]


@pytest.fixture(scope="module")
def experiment(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the results of a small experiment, carried out once for all tests that look at them."""
    folder = tmp_path_factory.mktemp("experiment")
    with contextlib.chdir(folder), pytest.MonkeyPatch.context() as patch:
        replan_seldom(patch)
        assert CliRunner().invoke(app, [*HERE[1:], "0"]).exit_code == 0
    return folder / "here"


@pytest.fixture
def done(folder: Path, experiment: Path) -> list[CaseRecord]:
    """Return the records of a small experiment whose results are in the folder `here`."""
    shutil.copytree(experiment, "here")
    return read_results("here").records


def lines_of(folder: str) -> int:
    path = Path(folder, "cases.jsonl")
    return path.read_bytes().count(b"\n") if path.exists() else 0


def wait_for_cases(folder: str, count: int, running: subprocess.Popen[str]) -> None:
    for _ in range(6000):
        if lines_of(folder) >= count:
            return
        assert running.poll() is None, running.communicate()
        time.sleep(0.01)
    pytest.fail("the experiment never came that far")


def children_of(process: int) -> list[int]:
    tasks = Path(f"/proc/{process}/task/{process}/children")
    return [int(number) for number in tasks.read_text().split()] if tasks.exists() else []


def gone(process: int) -> bool:
    stat = Path(f"/proc/{process}/stat")
    return not stat.exists() or stat.read_text().rpartition(")")[2].split()[0] == "Z"


# -- ended too soon -------------------------------------------------------------------------------------------------
def test_killed_experiment_loses_nothing_and_counts_nothing_twice(process: Start, command: Command) -> None:
    running = process(*HERE, "1")
    wait_for_cases("here", 1, running)
    workers = children_of(running.pid)
    assert workers
    os.kill(running.pid, signal.SIGKILL)
    running.communicate(timeout=60)
    for _ in range(500):
        if all(gone(worker) for worker in workers):
            break
        time.sleep(0.01)
    assert all(gone(worker) for worker in workers), "workers outlive their experiment"
    with Path("here/cases.jsonl").open("ab") as file:
        file.write(b'{"case": "17-idm-0-sc')
    before = {record.case: record for record in read_results("here").records}
    assert 1 <= len(before) <= len(KEYS)
    assert not Path("here/cases.parquet").exists()
    assert command(*HERE, 0).exit_code == 0
    after = read_results("here").records
    assert [record.case for record in after] == KEYS
    assert all(before.get(record.case, record) == record for record in after), "what was done was not done again"
    assert not Path("here/cases.jsonl").exists()


@pytest.mark.usefixtures("in_one_process")
def test_experiment_that_is_interrupted_twice_says_what_is_kept(process: Start, command: Command) -> None:
    running = process(*HERE, "1")
    wait_for_cases("here", 1, running)
    running.send_signal(signal.SIGINT)
    running.send_signal(signal.SIGINT)
    _, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert f"of {len(KEYS)} cases, which are kept in here" in err
    assert "nothing was written" not in err
    assert "so far: it is not finished" in command("bench", "show", "here").stdout


@pytest.mark.usefixtures("in_one_process")
def test_interrupted_experiment_says_how_to_go_on(process: Start, command: Command) -> None:
    running = process(*HERE, "1", "--json")
    wait_for_cases("here", 1, running)
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "Traceback" not in err
    data = json.loads(out)
    assert (data["status"], data["exit_status"], data["cases"]) == ("interrupted", 130, len(KEYS))
    assert len(read_results("here").records) == data["done"] < len(KEYS)
    assert f"to go on: {data['resume']}" in err
    words = shlex.split(data["resume"])
    assert words[0] == "scenewright"
    assert command(*words[1:]).exit_code == 0
    assert [record.case for record in read_results("here").records] == KEYS


def test_policy_that_ends_its_process_costs_its_own_cases_only(command: Command, policy: Callable[[str], str]) -> None:
    ego = policy("if observation.others: __import__('os')._exit(9)\nreturn 0.0")
    result = command(
        "bench", "--rows", "16", "--egos", f"{ego},constant", "--draws", "1", "--out", "here", "--workers", 1
    )
    assert result.exit_code == 0
    broken, sound = read_results("here").records
    assert (broken.cause, broken.message) == ("error", "its process died (exit status 9)")
    assert sound.cause == "success"
    assert "error" in result.stdout


def test_policy_that_prints_does_not_get_into_json(command: Command, policy: Callable[[str], str]) -> None:
    ego = policy("print('hello')\nreturn 0.0")
    result = command("bench", "--rows", "16", "--egos", ego, "--draws", "1", "--out", "here", "--json", "--workers", 1)
    assert json.loads(result.stdout)["cases"] == 1


# -- afterwards -----------------------------------------------------------------------------------------------------
def test_results_tell_what_was_asked_and_what_came_of_it(command: Command, done: list[CaseRecord]) -> None:
    assert [record.case for record in done] == KEYS
    settings = read_results("here").settings
    assert settings["command"] == "scenewright bench --rows 16-17 --egos constant,idm --draws 1 --workers 0 --out here"
    data = json.loads(command("bench", "show", "here", "--json").stdout)
    assert data["by_method"][0]["cases"] == len(KEYS)
    assert [row["name"] for row in data["methods"]["scenewright"]["by_ego"]] == ["constant", "idm", "all"]
    shown = command("bench", "show", "here")
    assert shown.exit_code == 0
    assert "constant" in shown.stdout
    assert Path("here/programs/row_16.scene").is_file()


def test_new_folder_every_time_where_none_is_named(command: Command) -> None:
    for number in (1, 2):
        assert command(*SMALL, "--rows", "16", "--egos", "constant", "--workers", 0).exit_code == 0
        assert Path(f"results/{number:03d}-bench/cases.parquet").exists()


def test_replay_runs_a_case_again_and_shows_it(command: Command, done: list[CaseRecord]) -> None:
    for record in done[:2]:
        result = command("bench", "replay", "here", record.case, "--out", f"again/{record.case}", "--json")
        assert result.exit_code == {"success": 0, "infeasible": 3}.get(record.status, 1)
        data = json.loads(result.stdout)
        assert (data["same"], data["cause"]) == (True, record.cause)
        assert data["run_directory"] == f"again/{record.case}"
        assert Path(data["page"]).is_file()
    assert "as recorded" in command("bench", "replay", "here", done[0].case).stdout
    assert read_results("here").records == done


def test_every_success_is_one_again_when_judged_from_its_files(command: Command, done: list[CaseRecord]) -> None:
    successes = [record for record in done if record.best_tight]
    assert successes
    result = command("bench", "rejudge", "here", "--workers", 0, "--json")
    assert result.exit_code == 0
    assert json.loads(result.stdout) == {
        "judged": sum(record.directory is not None for record in done),
        "successes": len(successes),
        "not_kept": 0,
        "differ": {},
    }


def test_kept_run_that_was_tampered_with_is_found(command: Command, done: list[CaseRecord]) -> None:
    record = next(record for record in done if record.best_tight and record.directory)
    path = Path("here", record.directory or "", "trace.parquet")
    trace = read_trace(path)
    hero = trace.actors["hero"]
    write_trace(Trace({**trace.actors, "hero": replace(hero, s_m=hero.s_m + 3.0)}), path)
    result = command("bench", "rejudge", "here", "--workers", 0)
    assert result.exit_code == 1
    assert record.case in result.stdout
    path.unlink()
    assert command("bench", "rejudge", "here", "--workers", 0).exit_code == 1


def test_diff_tells_what_turned_and_fails_where_asked(command: Command, done: list[CaseRecord]) -> None:
    settings = read_results("here").settings
    for folder, cause in (("good", "success"), ("bad", "missed")):
        Path(folder).mkdir()
        write_settings(Path(folder), settings)
        log = LineLog(Path(folder, LINES_FILE))
        for number in range(6):
            tight = cause == "success"
            made = replace(done[0], case=f"x-{number}", cause=cause, first_cause=cause, best_tight=tight)
            log.append(asdict(made))
        log.close()
    assert command("bench", "diff", "here", "here", "--fail-on-regression").exit_code == 0
    assert command("bench", "diff", "good", "bad").exit_code == 0
    worse = command("bench", "diff", "good", "bad", "--fail-on-regression")
    assert worse.exit_code == 1
    assert "success -> missed" in worse.stdout
    assert done[0].command in worse.stdout
    better = command("bench", "diff", "bad", "good", "--fail-on-regression", "--json")
    assert better.exit_code == 0
    assert len(json.loads(better.stdout)["won"]) == 6
    other = json.loads(command("bench", "diff", "here", "good", "--json").stdout)
    assert (len(other["only_then"]), len(other["only_now"]), other["compared"]) == (len(KEYS), 6, 0)


# -- wrong input ----------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--rows", "81"), "no row 81"),
        (("--rows", "4-1"), "'4-1'"),
        (("--rows", "four"), "'four'"),
        (("--rows", ","), "nothing is named here"),
        (("--rows", "1", "--egos", " ,"), "nothing is named here"),
        (("--rows", "1", "--methods", "rejection:x"), "no such number of samples"),
        (("--rows", "1", "--egos", "nobody"), "nobody"),
        (("--rows", "1", "--egos", "constant:speed_mps=fast"), "speed_mps"),
        (("--rows", "1", "--methods", "guessing"), "guessing"),
        (("--quick", "--full"), "--quick --full"),
        (("show", "nowhere"), "nowhere"),
        (("diff", "nowhere", "nowhere"), "nowhere"),
        (("rejudge", "nowhere"), "nowhere"),
        (("report", "nowhere"), "nowhere"),
        (("replay", "nowhere", "01-idm-0-scenewright"), "nowhere"),
    ],
)
def test_wrong_input_is_told_in_the_house_form(command: Command, words: tuple[str, ...], named: str) -> None:
    result = command("bench", *words)
    assert result.exit_code == 2
    assert result.stderr.startswith("error: ")
    assert named in result.stderr
    assert "found:" in result.stderr or "expected:" in result.stderr
    assert list(Path().iterdir()) == [], "nothing is left behind"
    data = json.loads(command("bench", *words, "--json").stdout)
    assert (data["status"], data["exit_status"]) == ("error", 2)


def test_a_seed_that_no_record_can_keep_is_refused(command: Command, folder: Path) -> None:
    assert command("bench", "--rows", "1", "--seed", str(2**64), "--out", "here").exit_code == 2
    assert not Path("here").exists()


def test_descriptions_are_not_run_for_a_file_that_cannot_be_written(command: Command, folder: Path) -> None:
    Path("text.txt").write_text("The ego drives west. An oncoming hero turns left.", encoding="utf-8")
    Path("file").write_text("", encoding="utf-8")
    result = command("bench", "success", "text.txt", "--workers", "0", "--out", "file/outcomes.jsonl")
    assert result.exit_code == 2
    assert "the system refused something" in result.stderr
    assert "cases:" not in result.stderr, "nothing was run"
    assert command("bench", "success", "text.txt", "--seed", "-1").exit_code == 2


def test_unknown_case_is_told_with_the_nearest(command: Command, done: list[CaseRecord]) -> None:
    result = command("bench", "replay", "here", "16-constant-1-scenewright")
    assert result.exit_code == 2
    assert "did you mean 16-constant-0-scenewright?" in result.stderr


def test_options_of_the_experiment_do_not_go_with_a_command(command: Command) -> None:
    assert command("bench", "--quick", "show", "here").exit_code == 2


# -- help -----------------------------------------------------------------------------------------------------------
COMMANDS = [info.callback.__name__ for info in app.registered_commands if info.callback]


def test_without_options_it_shows_its_help(command: Command) -> None:
    assert command("bench").stdout == command("bench", "--help").stdout


@pytest.mark.usefixtures("in_one_process")
def test_examples_in_help_run_as_they_stand(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("scenewright.takes.how_next", lambda *_: ())  # nothing is taken again
    done = set()
    for name in ("", *(name for name in COMMANDS if name not in ("success", "timing", "report"))):
        examples = examples_of(command("bench", *filter(None, [name]), "--help").stdout)
        assert examples, name
        for example in examples:
            if example in done:  # the commands that read results share the example that makes them
                continue
            done.add(example)
            result = command(*shlex.split(example)[1:])
            assert result.exit_code == 0, f"{example}\n{result.stdout}{result.stderr}"


def test_every_command_has_a_word_on_each_of_its_options() -> None:
    group = typer.main.get_command(app)
    for name, each in {"bench": group, **group.commands}.items():  # type: ignore[attr-defined]
        assert each.help, name
        for parameter in each.params:
            assert getattr(parameter, "help", None), f"{name}: {parameter.name}"
