"""The file provider: each request is a file, its reply another, so that any process or person can be the model.

What enters: calls. What leaves: ``KEY.request.json`` in a folder, written in one step, and the text of
``KEY.reply.json`` or ``KEY.reply.txt`` once somebody has put it there. No reply is ever written here.
"""

from __future__ import annotations

import hashlib
import json
import os
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from scenewright.errors import OutputError, Place, TranslationError
from scenewright.language.model.exchange import LONGEST_REPLY, Answer, Call, GaveUpError, estimated_usage, key_of
from scenewright.language.model.prompt import PROMPT_VERSION

SCHEMA_VERSION = 2
_LOOK_EVERY_S = 0.2


class NoReplyYetError(GaveUpError):
    """A request lies in the folder, and its reply does not."""


@dataclass(frozen=True, slots=True)
class FilesModel:
    """Whoever answers by files in `folder`; waits `wait_s` (s) for each reply."""

    folder: Path
    wait_s: float = 0.0
    name: str = "files"

    @property
    def settings(self) -> Mapping[str, Any]:
        """Return what the key of a request depends on beside its messages: nothing."""
        return {}

    def reply(self, call: Call) -> Answer:
        """Leave the request in the folder, and read its reply.

        Raises
        ------
        NoReplyYetError
            Where it is not there in time; the request stays, and the same call finds the reply later.
        """
        key = key_of(self, call)
        request = self.folder / f"{key}.request.json"
        places = (self.folder / f"{key}.reply.json", self.folder / f"{key}.reply.txt")
        # The instructions are the same for all texts on a map: whoever answers many reads them once, here.
        instructions = next((each.content for each in call.messages if each.role == "system"), "")
        shared = self.folder / f"{hashlib.sha256(instructions.encode()).hexdigest()[:12]}.instructions.md"
        if not shared.exists():
            write_text_whole(shared, instructions)
        more = {"instructions_file": shared.name, "reply_schema": call.schema, "reply_file": places[0].name}
        write_whole(request, {**as_data(call, key), **more})
        until = time.monotonic() + self.wait_s
        while True:
            text = next((text for text in map(read_bounded, places) if text is not None), None)
            if text is not None:
                return Answer(text, estimated_usage(call, text))
            left = until - time.monotonic()
            if left <= 0:
                raise NoReplyYetError(
                    f"there is no reply yet to request {key}",
                    place=Place(str(request)),
                    expected=f"the reply, as JSON in {places[0].name} or as a model's own text in {places[1].name}",
                    fix="write the reply beside the request and run the same command again, "
                    "or wait for it with --reply-wait SECONDS",
                )
            time.sleep(min(_LOOK_EVERY_S, left))


def as_data(call: Call, key: str) -> dict[str, Any]:
    """Return a call as it stands in files."""
    return {
        "schema_version": SCHEMA_VERSION,
        "key": key,
        "prompt_version": PROMPT_VERSION,
        "attempt": call.attempt,
        "map": call.map_name,
        "description": call.description,
        "messages": [asdict(message) for message in call.messages],
    }


def read_bounded(path: Path, longest: int = 4 * LONGEST_REPLY) -> str | None:
    """Return the text of a file, its first `longest` bytes and one more; None where there is none, or nothing in it."""
    try:
        with path.open("rb") as file:
            raw = file.read(longest + 1)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        found = error.strerror or str(error)
        message = "a reply cannot be read"
        raise TranslationError(message, place=Place(str(path)), found=found, fix="make it readable") from None
    return raw.decode("utf-8", errors="replace") if raw.strip() else None


def write_whole(path: Path, data: object) -> None:
    """Write `data` as JSON in one step; raises OutputError where it cannot be written."""
    write_text_whole(path, json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def write_text_whole(path: Path, text: str) -> None:
    """Write a text in one step, so that nobody ever reads half of it; raises OutputError where it cannot be written."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_text(text, encoding="utf-8", errors="replace")
        os.replace(temporary, path)
    except OSError as error:
        message, found = "an exchange with the model cannot be written", error.strerror or str(error)
        fix = "choose a folder that can be written"
        raise OutputError(message, place=Place(str(path)), found=found, fix=fix) from None
