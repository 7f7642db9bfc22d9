"""One exchange with a model: the messages that go out, the text that comes back, and the key both are kept under.

What enters: messages. What leaves: data classes, among them whoever answers. Nothing is sent here.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from scenewright.errors import TranslationError

CUT_OFF = "[cut off by the limit of tokens]"  # what stands at the end of a reply that came to no end
LONGEST_REPLY = 100_000  # characters; a whole reply of a model is some thousands


class GaveUpError(TranslationError):
    """No reply came, and trying again later may bring one: a busy or silent server, a reply not yet written."""

    exit_status = 4


@dataclass(frozen=True, slots=True)
class Message:
    """What one side says."""

    role: Literal["system", "user", "assistant"]
    content: str


@dataclass(frozen=True, slots=True)
class Call:
    """One request: all that has been said so far of a text, which try it is, and the JSON schema of the reply."""

    messages: tuple[Message, ...]
    description: str
    attempt: int
    map_name: str
    schema: Mapping[str, Any] = field(default_factory=dict, compare=False)


@dataclass(frozen=True, slots=True)
class Usage:
    """What was read and written, in tokens, where the provider says."""

    calls: int = 1
    input_tokens: int = 0
    output_tokens: int = 0

    def __add__(self, other: Usage) -> Usage:
        tokens = self.input_tokens + other.input_tokens, self.output_tokens + other.output_tokens
        return Usage(self.calls + other.calls, *tokens)

    def __str__(self) -> str:
        calls = "1 call" if self.calls == 1 else f"{self.calls} calls"
        return calls + (f", {self.input_tokens} tokens in and {self.output_tokens} out" if self.input_tokens else "")


@dataclass(frozen=True, slots=True)
class Answer:
    """What a model said to one call."""

    text: str
    usage: Usage = Usage()


@dataclass(frozen=True, slots=True)
class Model:
    """Whoever answers: a provider's server, a person with an editor, a recording."""

    name: str  # what the user calls it, such as ``openai:NAME``; never a key or an address
    reply: Callable[[Call], Answer]  # raises TranslationError where none is to be had


def key_of(model: str, call: Call) -> str:
    """Return what an exchange is kept under: the same messages to the same model share it."""
    said = [[message.role, message.content] for message in call.messages]
    data = json.dumps([model, said], ensure_ascii=False)
    return hashlib.sha256(data.encode("utf-8", "surrogatepass")).hexdigest()[:24]
