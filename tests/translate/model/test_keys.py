"""Keys: where they come from, and that they are nowhere else, whatever happens."""

from __future__ import annotations

import json
import sys
import types
from collections.abc import Callable
from pathlib import Path

import pytest
from talk import KEY, TEXT, Server, fails, reply_to, says

from scenewright.errors import InputError, ScenewrightError
from scenewright.roads.load import load_map
from scenewright.translate.model.choose import key_for, model_named, scrubbed
from scenewright.translate.model.exchange import TranslatorSettings
from scenewright.translate.model.translator import understand_by_model


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


def everything_in(folder: Path) -> bytes:
    return b"".join(path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file())


def asked(server: Server, who: str, folder: Path) -> str:
    """Return all that a user would see of a translation that is recorded."""
    said: list[str] = []
    settings = TranslatorSettings(base_url=server.address, record=folder, say=said.append)
    model = model_named(who, settings)
    assert model is not None
    try:
        told = understand_by_model(TEXT, load_map("t_intersection"), "mine", model, settings)
    except ScenewrightError as error:
        return f"{said} {error} {error.as_dict()}"
    return f"{said} {told}"


def test_key_of_a_provider_never_goes_to_another_server(
    server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "sk-of-openai-only")
    monkeypatch.delenv("SCENEWRIGHT_API_KEY")
    monkeypatch.setitem(sys.modules, "keyring", None)
    server.does(says())
    assert "truck" in asked(server, "openai-compatible:tiny", tmp_path)
    assert "sk-of-openai-only" not in str(server.headers)


@pytest.mark.parametrize("who", ["openai:some", "openai-compatible:tiny"])
def test_key_is_in_nothing_that_is_written_or_said(server: Server, tmp_path: Path, who: str) -> None:
    """A repair, records, and every failure, with a server that says the key whenever it can."""
    told = {"words": "to a stop", "says": f"key {KEY}"}
    server.does(says(f"your key is {KEY}"), says(json.dumps(reply_to(assumptions=[told]))))
    outputs = [asked(server, who, tmp_path)]
    assert len(server.asked) == 2
    assert KEY in str(server.headers)
    for status in (400, 401, 403, 404, 429, 500):
        server.asked.clear()
        server.does(fails(status, f"Authorization: Bearer {KEY} key {KEY}" + "x" * 300 + KEY, retry_after="9999"))
        outputs.append(asked(server, who, tmp_path))
    assert all("[key]" in output for output in outputs)
    assert len(list(tmp_path.glob("*.reply.txt"))) == 2
    assert KEY.encode() not in everything_in(tmp_path)
    assert KEY not in "".join(outputs)
