"""How a description is to be translated: which answers are known, who can be asked, how long a model may take.

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
DEFAULT_MAX_TOKENS = 8000  # a reply takes some hundreds; models that think before they write count that too


@dataclass(frozen=True, slots=True)
class TranslatorSettings:
    """How to translate."""

    base_url: str | None = None
    repairs: int = DEFAULT_REPAIRS
    strict: bool = False
    record: Path | None = None
    replay: Path | None = None
    timeout_s: float = DEFAULT_TIMEOUT_S
    reply_wait_s: float = 0.0
    max_tokens: int = DEFAULT_MAX_TOKENS
    ask: Callable[[Question], str | None] | None = None
    answers: Mapping[str, str] = field(default_factory=dict)
    second_opinion: bool = False
    verify: Callable[[Program], str | None] | None = None
    say: Callable[[str], None] | None = None
