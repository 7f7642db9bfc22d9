"""How a model is asked: how often, how long, and what is done about open questions.

What enters: options. What leaves: frozen values. Nothing is checked or imported here, so that the command starts fast.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scenewright.translate.story import Question

DEFAULT_REPAIRS = 3
DEFAULT_TIMEOUT_S = 120.0
DEFAULT_MAX_TOKENS = 16_000  # a reply takes one to three thousand; models that think before they write count that too


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
