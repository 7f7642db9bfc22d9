"""Exchanges kept in a folder and taken from it again: runs can be repeated without a network, and tests need none.

What enters: calls and answers. What leaves: one JSON file for each exchange, named by the key of the call, written in
one step. Keys of providers and addresses of servers never come here.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from scenewright.errors import Place, TranslationError
from scenewright.translate.model.exchange import Answer, Call, Model, Usage, key_of
from scenewright.translate.model.files import read_bounded, write_whole
from scenewright.translate.model.prompt import PROMPT_VERSION

SCHEMA_VERSION = 1
_LONGEST_RECORD = 4_000_000  # bytes: all that was said, more than once where replies were sent back


class _Usage(BaseModel):
    calls: int = 1
    input_tokens: int = 0
    output_tokens: int = 0
    estimated: bool = False


class _Record(BaseModel):
    key: str
    reply: str
    usage: _Usage = _Usage()


@dataclass(frozen=True, slots=True)
class Recording:
    """A model whose exchanges are kept in `folder`."""

    model: Model
    folder: Path

    @property
    def name(self) -> str:
        """Return the name of the model that answers."""
        return self.model.name

    @property
    def settings(self) -> Mapping[str, Any]:
        """Return the settings of the model that answers."""
        return self.model.settings

    def reply(self, call: Call) -> Answer:
        """Return the model's answer, and keep it with the call."""
        answer = self.model.reply(call)
        key = key_of(self.model, call)
        data = {
            "schema_version": SCHEMA_VERSION,
            "key": key,
            "model": self.name,
            "settings": dict(self.settings),
            "prompt_version": PROMPT_VERSION,
            "attempt": call.attempt,
            "map": call.map_name,
            "description": call.description,
            "messages": [asdict(message) for message in call.messages],
            "reply": answer.text,
            "usage": asdict(answer.usage),
        }
        write_whole(self.folder / f"{key}.json", data)
        return answer


@dataclass(frozen=True, slots=True)
class Replayed:
    """A model that says again what `folder` holds of it, and nothing else; it asks nobody."""

    name: str
    settings: Mapping[str, Any]
    folder: Path

    def reply(self, call: Call) -> Answer:
        """Return what was answered when this call was recorded.

        Raises
        ------
        TranslationError
            Where this call was not recorded, or its record is broken.
        """
        key = key_of(self, call)
        path = self.folder / f"{key}.json"
        text = read_bounded(path, _LONGEST_RECORD)
        if text is None:
            raise TranslationError(
                "this exchange was not recorded",
                place=Place(str(self.folder)),
                found=f"no {path.name}",
                expected=f"a record of {self.name} for this description, map and prompt (version {PROMPT_VERSION})",
                fix="record it once with --record DIR in place of --replay DIR",
            )
        try:
            record = _Record.model_validate(json.loads(text))
        except (ValidationError, ValueError, RecursionError):
            raise TranslationError(
                "a record cannot be read", place=Place(str(path)), fix="record it again with --record DIR"
            ) from None
        return Answer(record.reply, Usage(**record.usage.model_dump()))
