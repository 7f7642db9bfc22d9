"""Which model `auto` stands for."""

from __future__ import annotations

from pathlib import Path

import pytest
from talk import Server, says

from scenewright.errors import InputError, TranslationError
from scenewright.translate.model.choose import Configured, configured, model_named, settings_file, tried
from scenewright.translate.model.exchange import Call, Model, TranslatorSettings
from scenewright.translate.model.files import NoReplyYetError
from scenewright.translate.model.providers import ServedModel


def keep(text: str) -> Path:
    path = settings_file()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def server_of(model: Model | None) -> ServedModel:
    """Return the served model whose replies are those of `model`."""
    assert model is not None
    served = getattr(model.reply, "__self__", None)
    assert isinstance(served, ServedModel)
    return served


def test_nothing_configured_is_offline() -> None:
    assert configured() == Configured("offline", "nothing is configured")
    assert model_named("auto", TranslatorSettings()) is None
    assert model_named("offline", TranslatorSettings()) is None


def test_environment_comes_before_the_settings_file(monkeypatch: pytest.MonkeyPatch) -> None:
    path = keep('translator = "openai-compatible:tiny"\nbase_url = "http://127.0.0.1:1/v1"\n')
    assert configured() == Configured("openai-compatible:tiny", str(path), "http://127.0.0.1:1/v1")
    assert server_of(model_named("auto", TranslatorSettings())).base_url == "http://127.0.0.1:1/v1"
    monkeypatch.setenv("SCENEWRIGHT_TRANSLATOR", "files:here")
    monkeypatch.setenv("SCENEWRIGHT_BASE_URL", "http://127.0.0.1:2/v1")
    assert configured() == Configured("files:here", "SCENEWRIGHT_TRANSLATOR", "http://127.0.0.1:2/v1")
    by_files = model_named("auto", TranslatorSettings())
    assert by_files is not None
    assert by_files.name == "files"


def test_address_of_the_settings_is_that_of_no_other_provider() -> None:
    keep('base_url = "http://127.0.0.1:1/v1"\n')
    assert server_of(model_named("openai:some", TranslatorSettings())).base_url is None


@pytest.mark.parametrize("text", ["translator = ", 'api_key = "x"', "translator = 3", "\x00"])
def test_settings_file_that_is_none_is_told(text: str) -> None:
    path = keep(text)
    with pytest.raises(InputError, match="settings file") as caught:
        configured()
    assert str(caught.value.place) == str(path)


def test_records_stand_before_the_model(tmp_path: Path) -> None:
    """A record is kept beside the exchange itself; what is replayed leaves nothing and asks nobody."""
    call, folder, name = Call((), "a", 1, "m"), tmp_path / "a", f"files:{tmp_path / 'x'}"
    replay = model_named(name, TranslatorSettings(replay=folder))
    assert replay is not None
    with pytest.raises(TranslationError, match="not recorded"):
        replay.reply(call)
    assert not list(tmp_path.iterdir())
    record = model_named(name, TranslatorSettings(record=folder))
    assert record is not None
    with pytest.raises(NoReplyYetError):
        record.reply(call)
    (request,) = (tmp_path / "x").glob("*.request.json")
    request.with_name(request.name.replace("request.json", "reply.txt")).write_text("ready", encoding="utf-8")
    assert record.reply(call).text == replay.reply(call).text == "ready"


@pytest.mark.parametrize(("platform", "part"), [("darwin", "Application Support"), ("linux", "scenewright")])
def test_settings_file_lies_where_the_platform_keeps_such(
    monkeypatch: pytest.MonkeyPatch, platform: str, part: str
) -> None:
    monkeypatch.setattr("sys.platform", platform)
    assert part in str(settings_file())


def test_one_call_tries_the_model(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    server.does(says("ready"))
    monkeypatch.setenv("SCENEWRIGHT_BASE_URL", server.address)
    answer = tried(Configured("openai-compatible:tiny", "test"))
    assert answer is not None
    assert answer.text == "ready"
    assert "response_format" not in server.asked[0]
    assert tried(Configured("files:x", "test")) is None
    assert tried(Configured("offline", "test")) is None
