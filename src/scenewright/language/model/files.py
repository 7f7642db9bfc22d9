"""Exchanges as files: somebody who answers by files, and exchanges that are kept and said again.

What enters: calls. What leaves: one JSON file for each request or record, named by the key of its call and written in
one step, and the text of a reply that somebody has put beside its request. Keys and addresses never come here.
"""

from __future__ import annotations

import hashlib
import json
import os
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from scenewright.errors import OutputError, Place, TranslationError
from scenewright.language.model.exchange import LONGEST_REPLY, Answer, Call, GaveUpError, Model, estimated_usage, key_of
from scenewright.language.model.prompt import PROMPT_VERSION

SCHEMA_VERSION = 2
_LOOK_EVERY_S = 0.2
_LONGEST_RECORD = 4_000_000  # bytes: all that was said, more than once where replies were sent back


class NoReplyYetError(GaveUpError):
    """A request lies in the folder, and its reply does not."""


@dataclass(frozen=True, slots=True)
class FilesModel:
    """Whoever answers by files in `folder`; waits `wait_s` (s) for each reply."""

    folder: Path
    wait_s: float = 0.0
    name: str = "files"

    def reply(self, call: Call) -> Answer:
        """Leave ``KEY.request.json``, and read ``KEY.reply.json`` or ``KEY.reply.txt``.

        Raises `NoReplyYetError` where neither is there in time; the same call finds the reply later.
        """
        key = key_of(self, call)
        request = self.folder / f"{key}.request.json"
        places = (self.folder / f"{key}.reply.json", self.folder / f"{key}.reply.txt")
        # The instructions are the same for all texts on a map: whoever answers many reads them once, here.
        instructions = next((each.content for each in call.messages if each.role == "system"), "")
        shared = self.folder / f"{hashlib.sha256(instructions.encode()).hexdigest()[:12]}.instructions.md"
        _write(shared, instructions)
        more = {"instructions_file": shared.name, "reply_schema": call.schema, "reply_file": places[0].name}
        write_whole(request, {**_as_data(call, key), **more})
        until = time.monotonic() + self.wait_s
        while (text := next(filter(None, map(_read, places)), None)) is None:
            if (left := until - time.monotonic()) <= 0:
                either = f"the reply, as JSON in {places[0].name} or as a model's own text in {places[1].name}"
                fix = "write it there and run the same command again, or wait for it with --reply-wait SECONDS"
                message = f"there is no reply yet to request {key}"
                raise NoReplyYetError(message, place=Place(str(request)), expected=either, fix=fix)
            time.sleep(min(_LOOK_EVERY_S, left))
        return Answer(text, estimated_usage(call, text))


@dataclass(frozen=True, slots=True)
class Recording:
    """A model whose exchanges are kept in `folder`."""

    model: Model
    folder: Path

    @property
    def name(self) -> str:
        """Return the name of the model that answers."""
        return self.model.name

    def reply(self, call: Call) -> Answer:
        """Return the model's answer, and keep it with the call."""
        answer, key = self.model.reply(call), key_of(self.model, call)
        write_whole(self.folder / f"{key}.json", {**_as_data(call, key), "model": self.name, "answer": asdict(answer)})
        return answer


@dataclass(frozen=True, slots=True)
class Replayed:
    """A model that says again what `folder` holds of it, and nothing else; it asks nobody."""

    name: str
    folder: Path

    def reply(self, call: Call) -> Answer:
        """Return what was answered when this call was recorded; raises TranslationError where it was not."""
        path, fix = self.folder / f"{key_of(self, call)}.json", "record it with --record DIR in place of --replay DIR"
        if (text := _read(path, _LONGEST_RECORD)) is None:
            expected = f"a record of {self.name} for this text, map and prompt (version {PROMPT_VERSION})"
            raise TranslationError("this exchange was not recorded", place=Place(str(path)), expected=expected, fix=fix)
        try:
            return TypeAdapter(Answer).validate_python(json.loads(text)["answer"])
        except (ValueError, KeyError, TypeError, RecursionError):  # pydantic's own is a ValueError
            raise TranslationError("a record cannot be read", place=Place(str(path)), fix=fix) from None


def _as_data(call: Call, key: str) -> dict[str, Any]:
    """Return a call as it stands in files."""
    version = {"schema_version": SCHEMA_VERSION, "key": key, "prompt_version": PROMPT_VERSION}
    said = {"description": call.description, "messages": [asdict(message) for message in call.messages]}
    return {**version, "attempt": call.attempt, "map": call.map_name, **said}


def _read(path: Path, longest: int = 4 * LONGEST_REPLY) -> str | None:
    """Return the text of a file, its first `longest` bytes and one more; None where there is none, or nothing in it."""
    try:
        with path.open("rb") as file:
            raw = file.read(longest + 1)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        place, found = Place(str(path)), str(error)
        raise TranslationError("a reply cannot be read", place=place, found=found, fix="make it readable") from None
    return raw.decode("utf-8", errors="replace") if raw.strip() else None


def write_whole(path: Path, data: object) -> None:
    """Write `data` as JSON in one step, so that nobody reads half of it; raises OutputError where that fails."""
    _write(path, json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def _write(path: Path, text: str) -> None:
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_text(text, encoding="utf-8", errors="replace")
        os.replace(temporary, path)
    except OSError as error:
        message, fix = "an exchange with the model cannot be written", "choose a folder that can be written"
        raise OutputError(message, place=Place(str(path)), found=str(error), fix=fix) from None
