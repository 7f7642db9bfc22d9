"""Keys: where they come from, and that they are nowhere else, whatever happens."""

from __future__ import annotations

import sys
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from talk import GOOD, KEY, TEXT, Server, fails, says
from typer.testing import CliRunner

from scenewright.cli.app import app
from scenewright.errors import InputError
from scenewright.translate.model.keys import key_for, scrubbed

RUN = ["--ego", "constant", "--takes", "1"]


def ring(monkeypatch: pytest.MonkeyPatch, get: Callable[[str, str], str | None]) -> None:
    module = types.ModuleType("keyring")
    module.get_password = get  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "keyring", module)


def test_key_comes_from_the_environment_then_from_a_keyring(monkeypatch: pytest.MonkeyPatch) -> None:
    ring(monkeypatch, lambda service, name: f"{service}/{name}/kept")
    assert key_for("openai") == KEY
    monkeypatch.delenv("OPENAI_API_KEY")
    assert key_for("openai") == "scenewright/openai/kept"
    assert scrubbed("the key scenewright/openai/kept is wrong") == "the key [key] is wrong"


def test_missing_key_says_where_it_may_be(monkeypatch: pytest.MonkeyPatch) -> None:
    def locked(service: str, name: str) -> str | None:
        raise RuntimeError("the keyring is locked")

    ring(monkeypatch, locked)
    for provider, variable in (("openai", "OPENAI_API_KEY"), ("google", "GEMINI_API_KEY")):
        for name in ("OPENAI_API_KEY", "GOOGLE_API_KEY", "GEMINI_API_KEY"):
            monkeypatch.delenv(name, raising=False)
        with pytest.raises(InputError, match=f"no key for {provider}") as caught:
            key_for(provider)
        assert variable in str(caught.value.expected)
        assert "--translator offline" in str(caught.value.fix)


def test_key_of_a_provider_never_goes_to_another_server(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "sk-of-openai-only")
    monkeypatch.delenv("SCENEWRIGHT_API_KEY")
    monkeypatch.setitem(sys.modules, "keyring", None)
    server.does(says())
    result = call("translate", TEXT, "--translator", "openai-compatible:tiny", "--base-url", server.address)
    assert result.exit_code == 0, result.output
    assert "sk-of-openai-only" not in str(server.headers)


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("bad key sk-abcDEF123456", "bad key [key]"),
        ("Authorization: Bearer abc.def-123", "Authorization: [key]"),
        ("AIzaSyA1234567890123456789012345", "[key]"),
        ("the task-force is at the ask-me desk", "the task-force is at the ask-me desk"),
    ],
)
def test_what_looks_like_a_key_is_not_told(text: str, kept: str) -> None:
    assert scrubbed(text) == kept


def call(*words: str) -> Any:
    return CliRunner().invoke(app, list(words))


def everything_in(folder: Path) -> bytes:
    return b"".join(path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file())


@pytest.mark.parametrize("who", ["openai:some", "openai-compatible:tiny"])
def test_key_is_in_nothing_that_is_written_or_said(
    server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, who: str
) -> None:
    """A whole run, a repair, records, and every failure, with a server that says the key whenever it can."""
    monkeypatch.chdir(tmp_path)
    common = ["--translator", who, "--base-url", server.address, "--record", "records", "--debug"]
    server.does(says(f"your key is {KEY}"), says(GOOD.replace('"assumptions": []', f'"assumptions": ["key {KEY}"]')))
    outputs = [call("run", TEXT, *RUN, "--out", "run", *common[:-1]).output]
    assert len(server.asked) == 2
    assert KEY in str(server.headers)
    server.asked.clear()
    server.does(says())
    outputs.append(call("translate", TEXT, "--out", "a.scene", "--json", *common[:-1]).output)
    for status in (400, 401, 403, 404, 429, 500):
        server.asked.clear()
        server.does(fails(status, f"Authorization: Bearer {KEY} key {KEY}" + "x" * 300 + KEY, retry_after="9999"))
        outputs.append(call("translate", TEXT, "--json", *common[:-1]).output)
        outputs.append(call(*common[-1:], "translate", TEXT, *common[:-1]).output)
    assert all("[key]" in output or index < 2 for index, output in enumerate(outputs))
    assert (tmp_path / "run" / "manifest.json").is_file()
    assert len(list((tmp_path / "records").iterdir())) == 2
    assert KEY.encode() not in everything_in(tmp_path)
    assert KEY not in "".join(outputs)
