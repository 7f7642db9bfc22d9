"""One exchange with a model: the messages that go out, the text that comes back, the key both are kept under, settings.

What enters: messages, options. What leaves: data classes, among them whoever answers. Nothing is sent here.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from scenewright.errors import TranslationError

if TYPE_CHECKING:
    from scenewright.translate.story import Question

DEFAULT_REPAIRS = 3
DEFAULT_TIMEOUT_S = 120.0
DEFAULT_MAX_TOKENS = 16_000  # a reply takes one to three thousand; models that think before they write count that too
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


@dataclass(frozen=True, slots=True)
class TranslatorSettings:
    """How to translate; the offline reader knows `strict`, `ask` and `answers` alone."""

    base_url: str | None = None  # of an OpenAI-compatible server, or of a proxy of a provider
    repairs: int = DEFAULT_REPAIRS  # how often a reply that does not hold goes back to the model
    strict: bool = False  # refuse a text that leaves something open, instead of taking a default
    record: Path | None = None  # folder in which exchanges are kept
    replay: Path | None = None  # folder from which replies are taken, without asking anybody
    timeout_s: float = DEFAULT_TIMEOUT_S  # for one reply, waits that a busy server asks for included
    reply_wait_s: float = 0.0  # for a reply file of ``files:DIR``; with 0 the call gives up and leaves the request
    max_tokens: int = DEFAULT_MAX_TOKENS  # that one reply may hold
    ask: Callable[[Question], str] | None = None  # the user's choice; None where nobody can be asked
    answers: Mapping[str, str] = field(default_factory=dict)  # that were given before, by the slot of their question
    second_opinion: bool = False  # let a second call judge the story that was told
    say: Callable[[str], None] | None = None  # told what is being waited for
