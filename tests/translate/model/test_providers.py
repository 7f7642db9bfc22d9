"""Every way in which a real server fails, against one on this machine: a message that helps, and nothing half done."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from talk import (
    GOOD,
    KEY,
    TEXT,
    Act,
    Server,
    breaks_off,
    breaks_off_in_a_stream,
    drips,
    fails,
    is_silent,
    says,
)

from scenewright.errors import InputError, MissingExtraError, ScenewrightError, TranslationError
from scenewright.roads.load import load_map
from scenewright.translate.model.choose import model_named
from scenewright.translate.model.exchange import GaveUpError, TranslatorSettings
from scenewright.translate.model.translator import understand_by_model
from scenewright.translate.understand import Understanding

MAP = load_map("t_intersection")


@pytest.fixture(autouse=True)
def in_a_hurry(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("openai._base_client.INITIAL_RETRY_DELAY", 0.01)


def translate(
    server: Server, *acts: Act, who: str = "openai-compatible:tiny", text: str = TEXT, **options: Any
) -> Understanding:
    server.does(*acts)
    settings = TranslatorSettings(**{"base_url": server.address, "timeout_s": 20.0, **options})
    return told_by(who, settings, text)


def told_by(who: str, settings: TranslatorSettings | None = None, text: str = TEXT) -> Understanding:
    settings = settings or TranslatorSettings()
    model = model_named(who, settings)
    assert model is not None
    return understand_by_model(text, MAP, "mine", model, settings)


def fault_of(server: Server, *acts: Act, **options: Any) -> ScenewrightError:
    with pytest.raises(ScenewrightError) as caught:
        translate(server, *acts, **options)
    told = str(caught.value)
    assert KEY not in told
    assert caught.value.fix, "every message says what to do"
    assert caught.value.__cause__ is None, "no traceback of a library hangs on it, which could hold a header"
    assert caught.value.__context__ is None or caught.value.__suppress_context__
    return caught.value


def test_reply_of_a_server_becomes_a_program(server: Server) -> None:
    translation = translate(server, says())
    assert [deed.verb for deed in translation.story.deeds] == ["drive on", "brake"]
    assert "1 call, 7000 tokens in and 300 out" in translation.notes[-1]
    assert server.asked[0]["model"] == "tiny"
    assert [message["role"] for message in server.asked[0]["messages"]] == ["system", "user"]
    assert "tools" not in server.asked[0], "a model gets no tool to call"


def test_tokens_that_a_server_does_not_count_are_not_told(server: Server) -> None:
    assert translate(server, says(usage=None)).notes[-1].endswith(": 1 call")


def anthropic_says(text: str) -> Act:
    data = {
        "id": "m1",
        "type": "message",
        "role": "assistant",
        "model": "c",
        "content": [{"type": "text", "text": text}],
        "stop_reason": "end_turn",
        "stop_sequence": None,
        "usage": {"input_tokens": 11, "output_tokens": 5},
    }
    return lambda handler: handler.answer(200, json.dumps(data).encode())


def google_says(text: str) -> Act:
    data = {
        "candidates": [{"content": {"role": "model", "parts": [{"text": text}]}, "finishReason": "STOP", "index": 0}],
        "usageMetadata": {"promptTokenCount": 11, "candidatesTokenCount": 5, "totalTokenCount": 16},
        "modelVersion": "g",
    }
    return lambda handler: handler.answer(200, json.dumps(data).encode())


@pytest.mark.parametrize(
    ("provider", "speaks", "path"),
    [
        ("openai", says, "/v1/chat/completions"),
        ("openai-compatible", says, "/v1/chat/completions"),
        ("anthropic", anthropic_says, "/v1/messages"),
        ("google", google_says, "/v1beta/models/some:generateContent"),
    ],
)
def test_every_provider_speaks_its_own_protocol(
    server: Server, provider: str, speaks: Callable[[str], Act], path: str
) -> None:
    root = server.address if provider.startswith("openai") else server.address.removesuffix("/v1")
    translation = translate(server, speaks(GOOD), who=f"{provider}:some", base_url=root)
    assert len(translation.story.deeds) == 2
    assert server.paths == [path]
    assert translation.translator == f"{provider}:some"
    assert f"and {300 if speaks is says else 5} out" in translation.notes[-1]
    # Headers carry the key, and nothing else does.
    assert KEY in json.dumps(server.headers)
    assert KEY not in json.dumps(server.asked) + server.paths[0]


def test_busy_server_is_waited_for_as_long_as_it_asks(server: Server) -> None:
    started = time.monotonic()
    translate(server, fails(429, retry_after="1"), says())
    assert time.monotonic() - started >= 1.0
    assert len(server.asked) == 2


def test_busy_server_is_not_waited_for_beyond_the_time_allowed(server: Server) -> None:
    started = time.monotonic()
    for wait_s, told in (("3600", "busy"), ("30", "did not answer in time")):
        fault = fault_of(server, fails(429, "too many", retry_after=wait_s), timeout_s=1.0)
        assert isinstance(fault, GaveUpError)
        assert fault.exit_status == 4
        assert told in fault.message
    assert time.monotonic() - started < 10.0


@pytest.mark.parametrize("header", ["soon", "nan", "-5", "Thu, 01 Jan 1970 00:00:00 GMT"])
def test_odd_retry_after_does_no_harm(server: Server, header: str) -> None:
    translate(server, fails(429, retry_after=header), says())
    assert len(server.asked) == 2


@pytest.mark.parametrize("status", [500, 502, 503, 529])
def test_server_at_fault_is_tried_again_then_told(server: Server, status: int) -> None:
    translate(server, fails(status), says())
    server.asked.clear()
    fault = fault_of(server, fails(status, "out of memory"))
    assert isinstance(fault, GaveUpError)
    assert f"HTTP {status}" in str(fault)
    assert "out of memory" in str(fault)
    assert len(server.asked) == 3


def test_wrong_key(server: Server) -> None:
    fault = fault_of(server, fails(401, f"Incorrect API key provided: {KEY}"), who="openai:some")
    assert fault.exit_status == 2
    assert "does not accept the key" in fault.message
    assert "OPENAI_API_KEY" in str(fault.fix)
    assert len(server.asked) == 1


def test_unknown_model(server: Server) -> None:
    fault = fault_of(server, fails(404, "the model tiny does not exist"))
    assert fault.exit_status == 2
    assert "knows no openai-compatible:tiny" in fault.message
    assert "the model tiny does not exist" in str(fault.found)


def test_request_that_is_not_taken(server: Server) -> None:
    assert "does not take the request" in fault_of(server, fails(400, "context too long")).message


@pytest.mark.parametrize("act", [breaks_off, breaks_off_in_a_stream])
def test_reply_that_breaks_off(server: Server, act: Act) -> None:
    assert len(translate(server, act, says()).story.deeds) == 2
    fault = fault_of(server, act)
    assert isinstance(fault, GaveUpError)
    assert "broke off" in fault.message


@pytest.mark.parametrize("act", [is_silent, drips])
def test_server_that_does_not_get_done(server: Server, act: Act) -> None:
    started = time.monotonic()
    fault = fault_of(server, act, timeout_s=0.8)
    assert isinstance(fault, GaveUpError)
    assert "did not answer in time" in fault.message
    assert time.monotonic() - started < 3.0


def test_nobody_listens(server: Server) -> None:
    fault = fault_of(server, base_url="http://127.0.0.1:9/v1")
    assert isinstance(fault, GaveUpError)
    assert "out of reach" in fault.message


def test_long_reply_within_the_bounds_of_http_goes_back_to_the_model(server: Server) -> None:
    translation = translate(server, says("{" + "x" * 500_000), says())
    assert ": 2 calls" in translation.notes[-1]
    returned = server.asked[1]["messages"][2]["content"]
    assert len(returned) <= 20_000, "what goes back is cut: a flood is not paid for twice"


@pytest.mark.parametrize("body", [b"<html>a login page</html>", b"{}", b"[1, 2", b"null", b"\xff\xfe"])
def test_response_that_is_no_response(server: Server, body: bytes) -> None:
    fault = fault_of(server, lambda handler: handler.answer(200, body))
    assert "is no reply" in fault.message


def test_invalid_json_is_sent_back_and_mended(server: Server) -> None:
    translation = translate(server, says('{"story": {"actors": '), says())
    assert ": 2 calls" in translation.notes[-1]
    last = server.asked[1]["messages"][-1]["content"]
    assert "Your reply was refused" in last
    assert "no JSON object that can be read" in last


def test_model_is_asked_for_the_form_at_temperature_zero(server: Server) -> None:
    translate(server, says())
    assert server.asked[0]["response_format"]["type"] == "json_schema"
    assert server.asked[0]["temperature"] == 0


@pytest.mark.parametrize(
    ("who", "speaks", "kept"),
    [
        ("anthropic:claude-sonnet-4-5", anthropic_says, ("output_config", "format")),
        ("google:gemini-2.5-pro", google_says, ("generationConfig", "responseJsonSchema")),
    ],
)
def test_form_is_asked_for_in_the_dialect_of_the_provider(
    server: Server, who: str, speaks: Callable[[str], Act], kept: tuple[str, str]
) -> None:
    translate(server, speaks(GOOD), who=who, base_url=server.address.removesuffix("/v1"))
    assert "additionalProperties" in json.dumps(server.asked[0][kept[0]][kept[1]])
    if who.startswith("anthropic"):
        assert server.asked[0]["system"][-1]["cache_control"]["type"] == "ephemeral", "the prompt is kept by the server"


def test_server_that_takes_no_schema_is_asked_without(server: Server) -> None:
    assert len(translate(server, fails(400, "response_format is not supported"), says()).story.deeds) == 2
    assert "response_format" not in server.asked[1]


def test_reply_cut_off_at_the_limit_of_tokens_is_sent_back(server: Server) -> None:
    assert ": 2 calls" in translate(server, says(GOOD[:200], finish="length"), says()).notes[-1]
    assert "too long, or cut off" in server.asked[1]["messages"][-1]["content"]
    fault = fault_of(server, says(GOOD[:200], finish="length"), repairs=0, max_tokens=123)
    assert "cut off" in str(fault.found)
    assert server.asked[-1].get("max_completion_tokens", server.asked[-1].get("max_tokens")) == 123


@pytest.mark.parametrize(
    "act", [says(None, refusal="I cannot help with crashes."), says("I cannot help.", finish="content_filter")]
)
def test_refusal_of_the_provider(server: Server, act: Act) -> None:
    fault = fault_of(server, act)
    assert "declined to answer" in fault.message
    assert "I cannot help" in str(fault.found)
    assert len(server.asked) == 1


def test_refusal_in_prose_ends_after_the_repairs(server: Server) -> None:
    fault = fault_of(server, says("I'm sorry, but I can't do that."), repairs=2)
    assert "gave no story that holds: 3 calls" in fault.message
    assert "I'm sorry, but I can't do that." in str(fault.found)
    assert len(server.asked) == 3


def test_call_of_a_tool_has_no_effect(server: Server, tmp_path: Path) -> None:
    call = {
        "id": "c",
        "type": "function",
        "function": {"name": "shell", "arguments": f'{{"cmd": "touch {tmp_path}/x"}}'},
    }
    translation = translate(server, says(None, tool_calls=[call], finish="tool_calls"), says())
    assert ": 2 calls" in translation.notes[-1]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("address", ["tiny", "ftp://host/v1", "http://", "http://host:x/v1", "http://[::1/v1"])
def test_address_that_is_none(address: str) -> None:
    with pytest.raises(InputError, match="no address"):
        told_by("openai-compatible:tiny", TranslatorSettings(base_url=address))


def test_address_with_a_password_is_refused_without_saying_it() -> None:
    settings = TranslatorSettings(base_url=f"http://me:{KEY}@host/v1")
    with pytest.raises(InputError) as caught:
        told_by("openai-compatible:tiny", settings)
    assert "must not hold a key" in caught.value.message
    assert KEY not in str(caught.value)


def test_missing_address_and_address_from_the_environment(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match="no address") as caught:
        told_by("openai-compatible:tiny")
    assert "SCENEWRIGHT_BASE_URL" in str(caught.value.fix)
    server.does(says())
    monkeypatch.setenv("SCENEWRIGHT_BASE_URL", server.address)
    assert told_by("openai-compatible:tiny").story.deeds


def test_missing_library_is_told_with_how_to_get_it(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("pydantic_ai.direct", "pydantic_ai.models.openai", "pydantic_ai.messages"):
        monkeypatch.setitem(__import__("sys").modules, name, None)
    fault = fault_of(server, says())
    assert isinstance(fault, MissingExtraError)
    assert 'pip install "scenewright[models]"' in str(fault)


def test_inside_an_event_loop_too(server: Server) -> None:
    import asyncio

    async def notebook() -> Understanding:
        return translate(server, says())

    assert len(asyncio.run(notebook()).story.deeds) == 2


def test_names_of_translators() -> None:
    for name in ("openai", "openai:", "files:", "google: "):
        with pytest.raises(InputError, match="without a model"):
            told_by(name)
    with pytest.raises(InputError, match="no translator gpt"):
        told_by("gpt:5")
    with pytest.raises(InputError, match="either recorded or replayed"):
        told_by("openai:x", TranslatorSettings(record=Path("a"), replay=Path("b")))


def test_empty_and_endless_descriptions_ask_nobody(server: Server) -> None:
    for text in ("   ", "ego " * 60000):
        with pytest.raises(TranslationError):
            translate(server, says(), text=text)
    assert not server.asked
