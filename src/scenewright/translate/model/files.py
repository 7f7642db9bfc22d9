"""Exchanges as files: somebody who answers by files, and exchanges that are kept and said again.

What enters: calls. What leaves: one JSON file for each request, named by the key of its call, and beside it the text of
its reply, each written in one step. Keys and addresses never come here.
"""

from __future__ import annotations

import hashlib
import json
import os
import time
from dataclasses import asdict
from pathlib import Path

from scenewright.errors import OutputError, Place, TranslationError
from scenewright.translate.model.exchange import LONGEST_REPLY, Answer, Call, GaveUpError, Model, key_of
from scenewright.translate.model.prompt import PROMPT_VERSION

SCHEMA_VERSION = 3
_LOOK_EVERY_S = 0.2


class NoReplyYetError(GaveUpError):
    """A request lies in the folder, and its reply does not."""


def answering_by_files(folder: Path, wait_s: float = 0.0) -> Model:
    """Return whoever answers by files in `folder`, and waits `wait_s` (s) for each reply.

    It leaves ``KEY.request.json``, and reads ``KEY.reply.json`` or ``KEY.reply.txt``. Raises `NoReplyYetError` where
    neither is there in time; the same call finds the reply later.
    """

    def reply(call: Call) -> Answer:
        key = _leave(folder, "files", call)
        until = time.monotonic() + wait_s
        while (text := _reply(folder, key)) is None:
            if (left := until - time.monotonic()) <= 0:
                place = Place(str(folder / f"{key}.request.json"))
                either = f"the reply, as JSON in {key}.reply.json or as a model's own text in {key}.reply.txt"
                fix = "write it there and run the same command again, or wait for it with --reply-wait SECONDS"
                raise NoReplyYetError(f"there is no reply yet to request {key}", place=place, expected=either, fix=fix)
            time.sleep(min(_LOOK_EVERY_S, left))
        return Answer(text)

    return Model("files", reply)


def recording(model: Model, folder: Path) -> Model:
    """Return `model` with its exchanges kept in `folder`, as files of the same form."""

    def reply(call: Call) -> Answer:
        answer = model.reply(call)
        _write(folder / f"{_leave(folder, model.name, call)}.reply.txt", answer.text)
        return answer

    return Model(model.name, reply)


def replayed(name: str, folder: Path) -> Model:
    """Return a model that says again what `folder` holds of `name`, and nothing else; it asks nobody."""

    def reply(call: Call) -> Answer:
        if (text := _reply(folder, key_of(name, call))) is not None:
            return Answer(text)
        expected = f"a record of {name} for this text, map and prompt (version {PROMPT_VERSION})"
        message, fix = "this exchange was not recorded", "record it once with --record DIR in place of --replay DIR"
        raise TranslationError(message, place=Place(str(folder)), expected=expected, fix=fix)

    return Model(name, reply)


def _leave(folder: Path, model: str, call: Call) -> str:
    """Write a request with all that whoever answers needs; return the key that it is kept under."""
    key = key_of(model, call)
    # The instructions are the same for all texts on a map: whoever answers many reads them once, here.
    instructions = next((each.content for each in call.messages if each.role == "system"), "")
    shared = f"{hashlib.sha256(instructions.encode()).hexdigest()[:12]}.instructions.md"
    _write(folder / shared, instructions)
    request = {"schema_version": SCHEMA_VERSION, "key": key, "prompt_version": PROMPT_VERSION, "model": model,
               "attempt": call.attempt, "map": call.map_name, "description": call.description,
               "messages": [asdict(message) for message in call.messages], "instructions_file": shared,
               "reply_schema": call.schema, "reply_file": f"{key}.reply.json"}  # fmt: skip
    _write(folder / f"{key}.request.json", json.dumps(request, indent=2, ensure_ascii=False) + "\n")
    return key


def _reply(folder: Path, key: str) -> str | None:
    """Return the reply that lies in a folder, its first bytes where it is too long; None where there is none."""
    for path in (folder / f"{key}.reply.json", folder / f"{key}.reply.txt"):
        try:
            with path.open("rb") as file:
                raw = file.read(4 * LONGEST_REPLY + 1)
        except (FileNotFoundError, NotADirectoryError):
            continue
        except OSError as error:
            message, place = "a reply cannot be read", Place(str(path))
            raise TranslationError(message, place=place, found=str(error), fix="make it readable") from None
        if raw.strip():
            return raw.decode("utf-8", errors="replace")
    return None


def _write(path: Path, text: str) -> None:
    """Write a file in one step, so that nobody reads half of it; raises OutputError where that fails."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_text(text, encoding="utf-8", errors="replace")
        os.replace(temporary, path)
    except OSError as error:
        message, fix = "an exchange with the model cannot be written", "choose a folder that can be written"
        raise OutputError(message, place=Place(str(path)), found=str(error), fix=fix) from None
