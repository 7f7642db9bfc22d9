"""The command with a model that answers by files: named, configured, and told who it was."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from sentences import SENTENCE

from scenewright.translate.model.prompt import examples

Command = Callable[..., Any]


@pytest.fixture
def text() -> str:
    """Return a text whose reply lies in the folder `exchange`."""
    return next(text for text, reply in examples() if reply.get("story"))


def answered(command: Command, text: str, *words: str) -> None:
    """Leave the request, and put the reply of the worked example beside it."""
    assert command("translate", text, *words).exit_code == 4
    (request,) = Path("exchange").glob("*.request.json")
    reply = dict(examples())[text]
    request.with_name(json.loads(request.read_text(encoding="utf-8"))["reply_file"]).write_text(json.dumps(reply))


def test_a_reply_by_files_is_told_as_any_text_is(command: Command, text: str) -> None:
    named = ("--translator", "files:exchange")
    answered(command, text, *named)
    result = command("translate", text, *named)
    assert result.exit_code == 0, result.stderr
    assert "understood by files" in " ".join(result.stdout.split())
    data = json.loads(command("translate", text, *named, "--json").stdout)
    assert data["translator"] == "files"
    assert all(line["words"] for line in data["understood"])
    assert "prompt" in " ".join(data["notes"])
    assert command("run", text, *named, "--out", "here", "--quiet").exit_code in (0, 1, 3, 4)


def test_the_default_is_the_model_that_is_configured(
    command: Command, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SCENEWRIGHT_TRANSLATOR", "files:exchange")
    answered(command, text)
    assert "understood by files" in " ".join(command("translate", text).stdout.split())
    assert "understood offline" in command("translate", SENTENCE, "--translator", "offline").stdout


def test_what_is_configured_is_shown(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "offline" in command("models").stdout
    monkeypatch.setenv("SCENEWRIGHT_TRANSLATOR", "files:exchange")
    assert json.loads(command("models", "--json").stdout)["translator"] == "files:exchange"
