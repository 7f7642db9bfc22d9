"""The command with a model: what it prints and returns, what it leaves behind when it is stopped."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from talk import GOOD, KEY, PROGRAM, TEXT, Server, fails, is_silent, reply_to, says
from typer.testing import CliRunner

from scenewright.cli import translators
from scenewright.cli.app import app
from scenewright.program.text import parse_program
from scenewright.translate.model.prompt import PROMPT_VERSION
from scenewright.translate.model.settings import Question

QUESTION = {"question": "Which way?", "alternatives": ["straight on", "right"], "default": "straight on", "words": ""}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def call(*words: str, server: Server | None = None) -> Any:
    model = ["--translator", "openai-compatible:tiny", "--base-url", server.address] if server is not None else []
    return CliRunner().invoke(app, [*words, *model])


def test_translate_tells_readings_what_it_says_and_what_it_took(server: Server) -> None:
    server.does(says(json.dumps(reply_to(questions=[QUESTION]))))
    result = call("translate", TEXT, server=server)
    assert result.exit_code == 0
    for words in (
        "A1x(t2) == conflict_point - 5",
        "read back, it says:",
        "The moment that counts: the ego is 12 m before its stop line and the hero is 20 m before the conflict point.",
        "assumed: Which way? Taken: straight on. It could also be: right.",
        f"openai-compatible:tiny, prompt {PROMPT_VERSION} (",
        "1 call, 7000 tokens in and 300 out, as the provider counts",
    ):
        assert words in result.stdout


def test_translate_as_json(server: Server) -> None:
    server.does(says(json.dumps(reply_to(questions=[QUESTION]))))
    data = json.loads(call("translate", TEXT, "--json", server=server).stdout)
    assert len(parse_program(data["program"]).constraints) == 5
    assert data["questions"] == [QUESTION]
    assert data["usage"] == {"calls": 1, "input_tokens": 7000, "output_tokens": 300, "estimated": False}
    assert (data["translator"], data["disagreements"], data["impossible"]) == ("openai-compatible:tiny", [], None)
    assert data["reading_back"][0].startswith("The ego comes out of the driveway")


def test_disagreement_with_the_offline_translator_is_shown(server: Server) -> None:
    server.does(says(json.dumps(reply_to(PROGRAM.replace("12 m", "20  m").replace("- 20 m", "- 12 m")))))
    result = call("translate", TEXT, server=server)
    assert "doubt: only the offline translator understood A0x(t1) == stop_line - 12" in result.stdout


def test_impossible_scenario_is_shown_with_its_proof(server: Server) -> None:
    text = TEXT.replace("20 m short", "5.5 m short") + " At that moment the truck drives at 50 km/h."
    program = PROGRAM.replace("- 20 m", "- 5.5 m") + "A1v(t1) == 50 km/h\n"
    sentences = text.split(". ")
    readings = [(sentences[0], []), (sentences[1], []), (sentences[2], ["c1", "c2", "c3", "c4", "c5"])]
    server.does(says(json.dumps(reply_to(program, [*readings, (sentences[3], ["c6"])]))))
    result = call("translate", text, server=server)
    assert result.exit_code == 0
    assert "doubt: this cannot happen." in result.stdout


def test_strict_refuses_what_is_left_open(server: Server) -> None:
    server.does(says(json.dumps(reply_to(questions=[QUESTION]))))
    result = call("translate", TEXT, "--strict", "--out", "a.scene", server=server)
    assert result.exit_code == 2
    assert "Which way? (straight on / right)" in result.stderr
    assert not Path("a.scene").exists()


def test_strict_offline_refuses_assumptions_but_not_conventions() -> None:
    assert call("translate", TEXT, "--strict").exit_code == 2
    plain = (
        "Ego is on the driveway exit and wants to turn right onto the road travelling westbound. The hero follows its "
        "lane along the road travelling westbound. When the ego is 12 m behind the stop line and the hero is 20 m "
        "behind the conflict point, the hero brakes to a stop just before the conflict point."
    )
    assert call("translate", plain, "--strict").exit_code == 0


def test_prompt_is_shown_with_and_without_a_description() -> None:
    result = call("translate", "--show-prompt")
    assert result.exit_code == 0
    assert result.stdout.startswith(f"prompt version {PROMPT_VERSION} (")
    for words in ("----- system -----", "# 6. The map", "(your description)", "Actor 0 (ego):"):
        assert words in result.stdout
    assert TEXT in call("translate", TEXT, "--show-prompt", "--translator", "openai:x").stdout
    assert call("translate").exit_code == 2


def test_files_are_exchanged_over_two_calls() -> None:
    first = call("translate", TEXT, "--translator", "files:exchange", "--out", "a.scene")
    assert first.exit_code == 4
    assert "there is no reply yet" in first.stderr
    assert not Path("a.scene").exists()
    (request,) = Path("exchange").glob("*.request.json")
    Path("exchange", json.loads(request.read_text(encoding="utf-8"))["reply_file"]).write_text(GOOD, encoding="utf-8")
    assert call("translate", TEXT, "--translator", "files:exchange", "--out", "a.scene").exit_code == 0
    assert call("check", "a.scene").exit_code == 0


def test_run_is_recorded_replayed_and_noted(server: Server) -> None:
    server.does(says())
    kept = ["--translator", "openai-compatible:tiny", "--ego", "constant", "--takes", "1"]
    result = call("run", TEXT, *kept, "--base-url", server.address, "--record", "kept", "--out", "one")
    assert Path("one/manifest.json").is_file(), result.output
    again = call("run", TEXT, *kept, "--replay", "kept", "--out", "two")
    assert Path("two/manifest.json").is_file(), again.output
    assert len(server.asked) == 1
    assert Path("one/trace.parquet").read_bytes() == Path("two/trace.parquet").read_bytes()
    manifest = json.loads(Path("one/manifest.json").read_text(encoding="utf-8"))
    assert manifest["translator"] == "openai-compatible:tiny"
    (note,) = [note for note in manifest["notes"] if note.startswith("translated by")]
    assert f"with prompt {PROMPT_VERSION} (" in note
    assert "7000 tokens in and 300 out" in note


@pytest.mark.parametrize("name", ["check", "solve"])
def test_other_commands_take_a_translator_too(server: Server, name: str) -> None:
    server.does(says())
    result = call(name, TEXT, "--json", server=server)
    assert result.exit_code == 0, result.output
    server.does(fails(404))
    assert call(name, TEXT, server=server).exit_code == 2


def test_server_that_fails_leaves_nothing_and_says_what_to_do(server: Server) -> None:
    server.does(fails(500, retry_after="9999"))
    result = call("translate", TEXT, "--out", "a.scene", "--record", "kept", "--json", server=server)
    assert result.exit_code == 4
    assert json.loads(result.stdout)["error"]["fix"].startswith("run it again later")
    assert not list(Path().iterdir())


# -- asking ---------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("typed", "answer"), [("2\n", "b"), ("\n", "a"), ("", "a"), ("7\nx\n0\n2\n", "b"), ("1\n", "a")]
)
def test_user_answers_by_number(monkeypatch: pytest.MonkeyPatch, typed: str, answer: str) -> None:
    written = io.StringIO()
    monkeypatch.setattr(sys, "stdin", io.StringIO(typed))
    monkeypatch.setattr(sys, "stderr", written)
    assert translators._ask(Question("Which?", ("a", "b"), "a", "the car")) == answer
    assert "Which? ('the car')\n  1  a\n  2  b\nnumber [1]: " in written.getvalue()


def test_question_is_asked_on_a_terminal_and_the_answer_counts(server: Server) -> None:
    pty = pytest.importorskip("pty")
    answered = PROGRAM.replace("- W\n", "- W, N\n").replace("conflict_point", "A1.junction_start")
    server.does(says(json.dumps(reply_to(questions=[QUESTION]))), says(json.dumps(reply_to(answered))))
    ours, theirs = pty.openpty()
    words = ["translate", TEXT, "--ask", "--json", "--translator", "openai:some", "--base-url", server.address]
    process = subprocess.Popen(
        [sys.executable, "-m", "scenewright", *words],
        stdin=theirs,
        stderr=theirs,
        stdout=subprocess.PIPE,
        text=True,
    )
    os.close(theirs)
    shown = b""
    while b"number [1]: " not in shown:
        shown += os.read(ours, 1000)
    os.write(ours, b"2\n")
    data = json.loads(process.communicate(timeout=60)[0])
    os.close(ours)
    assert b"Which way?" in shown
    assert data["assumptions"] == ["Which way? You answered: right."]
    assert "- W, N" in data["program"]


def test_without_a_terminal_nobody_is_asked(server: Server) -> None:
    server.does(says(json.dumps(reply_to(questions=[QUESTION]))))
    result = call("translate", TEXT, "--ask", server=server)
    assert result.exit_code == 0
    assert "no terminal to ask on" in result.stderr
    assert "assumed: Which way?" in result.stdout


# -- being stopped --------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_process_that_is_stopped_leaves_no_half_program(server: Server, folder: Path, by: signal.Signals) -> None:
    server.does(is_silent)
    Path("a.scene").write_text("as it was", encoding="utf-8")
    words = ["translate", TEXT, "--out", "a.scene", "--record", "kept", "--translator", "openai-compatible:tiny"]
    process = subprocess.Popen(
        [sys.executable, "-m", "scenewright", *words, "--base-url", server.address],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "SCENEWRIGHT_API_KEY": KEY},
    )
    until = time.monotonic() + 60.0
    while not server.asked and time.monotonic() < until:
        time.sleep(0.02)
    process.send_signal(by)
    said = process.communicate(timeout=30)[1]
    assert process.returncode == (130 if by is signal.SIGINT else -by)
    if by is signal.SIGINT:
        assert said == "interrupted; nothing was written\n"
    assert sorted(path.name for path in folder.iterdir()) == ["a.scene"]
    assert Path("a.scene").read_text(encoding="utf-8") == "as it was"
