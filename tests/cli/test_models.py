"""`scenewright models`: what is found, one call, what to set; never a key."""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from http.server import ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

sys.path.insert(0, str(Path(__file__).parents[1] / "translate" / "model"))

from talk import KEY, Handler, Server, fails, says

from scenewright.cli.app import app


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    http.daemon_threads, http.block_on_close = True, False
    state = Server(f"http://127.0.0.1:{http.server_address[1]}/v1")
    http.state = state  # type: ignore[attr-defined]
    thread = threading.Thread(target=http.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
    thread.start()
    monkeypatch.setenv("SCENEWRIGHT_BASE_URL", state.address)
    yield state
    http.shutdown()
    http.server_close()
    thread.join()


@pytest.fixture(autouse=True)
def no_settings(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.delenv("SCENEWRIGHT_TRANSLATOR", raising=False)
    monkeypatch.setenv("SCENEWRIGHT_API_KEY", KEY)


def models(*options: str) -> Any:
    return CliRunner().invoke(app, ["models", *options])


def test_nothing_configured_says_what_to_set() -> None:
    result = models()
    assert result.exit_code == 0
    assert "SCENEWRIGHT_TRANSLATOR=PROVIDER:NAME" in result.output
    assert "settings.toml" in result.output
    assert json.loads(models("--json").stdout)["translator"] == "offline"


def test_model_that_answers(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    server.does(says("ready"))
    monkeypatch.setenv("SCENEWRIGHT_TRANSLATOR", "openai-compatible:tiny")
    result = models("--json")
    assert result.exit_code == 0
    told = json.loads(result.stdout)
    assert (told["translator"], told["from"]) == ("openai-compatible:tiny", "SCENEWRIGHT_TRANSLATOR")
    assert told["one call"].startswith("1 call, 7000 tokens in")
    shown = models()
    assert "SCENEWRIGHT_API_KEY" in shown.output
    assert KEY not in shown.output + result.output


def test_model_that_does_not_answer(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SCENEWRIGHT_TRANSLATOR", "openai-compatible:tiny")
    server.does(fails(401, f"wrong key {KEY}"))
    result = models()
    assert result.exit_code == 2
    assert "does not accept the key" in result.output
    assert KEY not in result.output
    monkeypatch.setenv("SCENEWRIGHT_BASE_URL", "http://127.0.0.1:9/v1")
    assert models().exit_code == 4


def test_files_are_not_tried(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SCENEWRIGHT_TRANSLATOR", f"files:{tmp_path / 'exchange'}")
    result = models()
    assert result.exit_code == 0
    assert "not tried" in result.output
    assert not (tmp_path / "exchange").exists()
