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

from pydantic import TypeAdapter, ValidationError
from typing_extensions import TypedDict

from scenewright.errors import Place, TranslationError
from scenewright.language.model.exchange import Answer, Call, Model, Usage, key_of
from scenewright.language.model.files import as_data, read_bounded, write_whole
from scenewright.language.model.prompt import PROMPT_VERSION

_LONGEST_RECORD = 4_000_000  # bytes: all that was said, more than once where replies were sent back


class _Record(TypedDict):
    reply: str
    usage: Usage


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
        said = {"model": self.name, "settings": dict(self.settings), "reply": answer.text, "usage": asdict(answer.usage)}
        write_whole(self.folder / f"{key}.json", {**as_data(call, key), **said})
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
        path = self.folder / f"{key_of(self, call)}.json"
        text = read_bounded(path, _LONGEST_RECORD)
        if text is None:
            raise TranslationError(
                "this exchange was not recorded",
                place=Place(str(self.folder)),
                found=f"no {path.name}",
                expected=f"a record of {self.name} for this text, map and prompt (version {PROMPT_VERSION})",
                fix="record it once with --record DIR in place of --replay DIR",
            )
        try:
            record = TypeAdapter(_Record).validate_python(json.loads(text))
        except (ValidationError, ValueError, RecursionError):
            fix = "record it again with --record DIR"
            raise TranslationError("a record cannot be read", place=Place(str(path)), fix=fix) from None
        return Answer(record["reply"], record["usage"])
