"""How a model is asked: how often, how long, and what is done about open questions.

What enters: options. What leaves: frozen values. Nothing is checked or imported here, so that the command starts fast.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scenewright.language.story import Question
    from scenewright.program.types import Program

DEFAULT_REPAIRS = 3
DEFAULT_TIMEOUT_S = 120.0
DEFAULT_MAX_TOKENS = 16_000  # a reply takes one to three thousand; models that think before they write count that too


@dataclass(frozen=True, slots=True)
class TranslatorSettings:
    """How to translate.

    Attributes
    ----------
    base_url
        Address of an OpenAI-compatible server, or of a proxy of a provider; None for the provider's own.
    repairs
        How often a reply that does not hold goes back to the model.
    strict
        Refuse a text that leaves something open, instead of taking a default.
    record, replay
        Folder in which exchanges are kept; folder from which replies are taken, without asking anybody.
    timeout_s
        How long (s) one reply may take, waits that a busy server asks for included.
    reply_wait_s
        How long (s) to wait for a reply file of ``files:DIR``; with 0 the request is left there and the call gives up.
    max_tokens
        What one reply may hold at most.
    ask
        Returns the user's choice among a question's alternatives; None where nobody can be asked.
    answers
        Alternatives that were chosen before, by the slot of their question.
    second_opinion
        Let a second call judge whether the story that was told says what the text says.
    verify
        Says why a program cannot happen, None where nothing speaks against it.
    say
        Told what is being waited for.
    """

    base_url: str | None = None
    repairs: int = DEFAULT_REPAIRS
    strict: bool = False
    record: Path | None = None
    replay: Path | None = None
    timeout_s: float = DEFAULT_TIMEOUT_S
    reply_wait_s: float = 0.0
    max_tokens: int = DEFAULT_MAX_TOKENS
    ask: Callable[[Question], str] | None = None
    answers: Mapping[str, str] = field(default_factory=dict)
    second_opinion: bool = False
    verify: Callable[[Program], str | None] | None = None
    say: Callable[[str], None] | None = None
