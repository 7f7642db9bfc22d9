"""Exchanges as files: requests that anybody can answer, records that repeat a run, and never half of one."""

from __future__ import annotations

import json
import sys
import threading
from pathlib import Path
from typing import Any

import pytest
from talk import GOOD, TEXT, Said, reply_to

from scenewright.errors import OutputError, ScenewrightError, TranslationError
from scenewright.roads.load import load_map
from scenewright.translate.model.choose import model_named
from scenewright.translate.model.exchange import Call, GaveUpError, Message, TranslatorSettings, key_of
from scenewright.translate.model.files import NoReplyYetError, answering_by_files, recording, replayed
from scenewright.translate.model.prompt import PROMPT_VERSION
from scenewright.translate.model.translator import understand_by_model
from scenewright.translate.understand import Understanding

MAP = load_map("t_intersection")


def translate(folder: Path, text: str = TEXT, **options: Any) -> Understanding:
    settings = TranslatorSettings(**options)
    model = model_named(f"files:{folder}", settings)
    assert model is not None
    return understand_by_model(text, MAP, "mine", model, settings)


def requests_in(folder: Path) -> list[dict[str, Any]]:
    found = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.request.json"))]
    return sorted(found, key=lambda each: int(each["attempt"]))


# -- files:DIR ------------------------------------------------------------------------------------------------------
def test_request_says_all_that_somebody_needs_to_answer(tmp_path: Path) -> None:
    with pytest.raises(NoReplyYetError) as caught:
        translate(tmp_path / "new folder")
    assert caught.value.exit_status == 4
    (request,) = requests_in(tmp_path / "new folder")
    assert request["description"] == TEXT
    assert (request["attempt"], request["map"], request["prompt_version"]) == (1, "t_intersection", PROMPT_VERSION)
    assert [message["role"] for message in request["messages"]] == ["system", "user"]
    assert TEXT in request["messages"][1]["content"]
    shared = tmp_path / "new folder" / request["instructions_file"]
    assert shared.read_text(encoding="utf-8") == request["messages"][0]["content"]
    assert request["reply_schema"]["properties"]["refusal"]
    assert request["reply_file"] in str(caught.value.expected)
    assert "run the same command again" in str(caught.value.fix)


def test_many_requests_in_one_go_and_all_replies_in_the_next(tmp_path: Path) -> None:
    texts = [TEXT, TEXT.replace("12 m", "13 m"), TEXT.replace("12 m", "14 m")]
    for text in texts:
        with pytest.raises(NoReplyYetError):
            translate(tmp_path, text)
    assert len(requests_in(tmp_path)) == 3
    for request in requests_in(tmp_path):
        metres = request["description"].split(" m short")[0].split()[-1]
        reply = json.dumps(reply_to(request["description"])).replace("12 m", f"{metres} m")
        (tmp_path / request["reply_file"]).write_text(reply.replace('"12"', f'"{metres}"'), encoding="utf-8")
    assert all(translate(tmp_path, text).notes[-1].endswith(": 1 call") for text in texts)
    assert len(requests_in(tmp_path)) == 3


def test_wrong_reply_leads_to_a_second_request_that_tells_the_fault(tmp_path: Path) -> None:
    with pytest.raises(NoReplyYetError):
        translate(tmp_path)
    (first,) = requests_in(tmp_path)
    (tmp_path / f"{first['key']}.reply.txt").write_text("Sure! Here is the program: Actor 0", encoding="utf-8")
    with pytest.raises(NoReplyYetError):
        translate(tmp_path)
    second = requests_in(tmp_path)[1]
    assert (second["attempt"], len(second["messages"])) == (2, 4)
    assert "no JSON object" in second["messages"][3]["content"]
    (tmp_path / second["reply_file"]).write_text(GOOD, encoding="utf-8")
    assert translate(tmp_path).notes[-1].endswith(": 2 calls")


def test_waiting_process_takes_a_reply_that_comes_later(tmp_path: Path) -> None:
    def somebody() -> None:
        while not (found := requests_in_progress(tmp_path)):
            pass
        reply = tmp_path / found[0]["reply_file"]
        reply.write_text("", encoding="utf-8")  # an editor that has opened the file: nothing in it yet
        partial = tmp_path / "later"
        partial.write_text(GOOD, encoding="utf-8")
        partial.replace(reply)

    thread = threading.Thread(target=somebody)
    thread.start()
    assert translate(tmp_path, reply_wait_s=30.0).story.deeds
    thread.join()


def requests_in_progress(folder: Path) -> list[dict[str, Any]]:
    return requests_in(folder)


def test_key_depends_on_what_is_asked_and_not_on_the_folder(tmp_path: Path) -> None:
    call = Call((Message("user", "a"),), "a", 1, "m")
    for folder in (tmp_path / "x", tmp_path / "y"):
        with pytest.raises(NoReplyYetError):
            answering_by_files(folder).reply(call)
    assert {path.name for path in tmp_path.rglob("*.request.json")} == {f"{key_of('files', call)}.request.json"}
    assert key_of("files", call) != key_of("files", Call((Message("user", "b"),), "a", 1, "m"))


def test_reply_that_cannot_be_read_and_folder_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(NoReplyYetError):
        translate(tmp_path)
    (request,) = requests_in(tmp_path)
    (tmp_path / request["reply_file"]).mkdir()
    with pytest.raises(TranslationError, match="cannot be read"):
        translate(tmp_path)
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match="cannot be written"):
        translate(tmp_path / "file" / "below")


def test_reply_of_ten_megabytes_in_a_file_is_a_reply_that_does_not_hold(tmp_path: Path) -> None:
    with pytest.raises(NoReplyYetError):
        translate(tmp_path)
    (request,) = requests_in(tmp_path)
    (tmp_path / request["reply_file"]).write_bytes(b"{" + b"x" * 10_000_000)
    with pytest.raises(TranslationError, match="gave no story") as caught:
        translate(tmp_path, repairs=0)
    assert "too long" in str(caught.value.found)


# -- --record and --replay ------------------------------------------------------------------------------------------
def record_of(folder: Path, *texts: str) -> Understanding:
    model = recording(Said([*texts]), folder)
    return understand_by_model(TEXT, MAP, "mine", model, TranslatorSettings())


def said_again(folder: Path, name: str = "said:so") -> Understanding:
    return understand_by_model(TEXT, MAP, "mine", replayed(name, folder), TranslatorSettings())


def test_what_was_recorded_is_said_again(tmp_path: Path) -> None:
    first = record_of(tmp_path, "nothing", GOOD)
    assert len(list(tmp_path.glob("*.reply.txt"))) == 2
    assert said_again(tmp_path) == first


def test_other_model_other_record(tmp_path: Path) -> None:
    record_of(tmp_path, GOOD)
    with pytest.raises(TranslationError, match="was not recorded") as caught:
        said_again(tmp_path, "another:one")
    assert "--record" in str(caught.value.fix)
    assert not isinstance(caught.value, GaveUpError)


def test_record_has_the_form_of_an_exchange_by_files(tmp_path: Path) -> None:
    record_of(tmp_path, GOOD)
    (request,) = requests_in(tmp_path)
    assert (tmp_path / f"{request['key']}.reply.txt").read_text(encoding="utf-8") == GOOD
    (tmp_path / f"{request['key']}.reply.txt").write_text(" ", encoding="utf-8")
    with pytest.raises(TranslationError, match="was not recorded"):
        said_again(tmp_path)


def test_replay_needs_neither_key_nor_library_nor_address(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    name = "openai-compatible:tiny"
    understand_by_model(TEXT, MAP, "mine", recording(Said([GOOD], name=name), tmp_path), TranslatorSettings())
    monkeypatch.delenv("SCENEWRIGHT_API_KEY")
    for module in ("pydantic_ai", "openai"):
        monkeypatch.setitem(sys.modules, module, None)
    settings = TranslatorSettings(replay=tmp_path)
    model = model_named(name, settings)
    assert model is not None
    assert understand_by_model(TEXT, MAP, "mine", model, settings).story.deeds


def test_failed_exchange_leaves_no_record(tmp_path: Path) -> None:
    class Silent(Said):
        def reply(self, call: Call) -> Any:
            raise GaveUpError("silence")

    with pytest.raises(ScenewrightError, match="silence"):
        understand_by_model(TEXT, MAP, "mine", recording(Silent([]), tmp_path), TranslatorSettings())
    assert not list(tmp_path.iterdir())
