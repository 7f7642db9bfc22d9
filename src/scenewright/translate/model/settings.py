"""How a description is to be translated: which model is asked, how often, and what is done about open questions.

What enters: options. What leaves: frozen values. Nothing is checked or imported here, so that the command starts fast.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scenewright.program.types import Program

DEFAULT_REPAIRS = 3
DEFAULT_TIMEOUT_S = 120.0
DEFAULT_MAX_TOKENS = 8000  # a reply takes some hundreds; models that think before they write count that too


@dataclass(frozen=True, slots=True)
class Question:
    """Something that a description leaves open and that matters.

    Attributes
    ----------
    question
        What is open.
    alternatives
        What it could mean, at least two.
    default
        The alternative that the program takes.
    words
        The words of the description that leave it open; empty where it is about something unsaid.
    """

    question: str
    alternatives: tuple[str, ...]
    default: str
    words: str = ""

    def as_assumption(self) -> str:
        """Return the sentence to list where nobody was asked."""
        others = "; ".join(each for each in self.alternatives if each != self.default)
        return f"{self.question} Taken: {self.default}. It could also be: {others}."


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
        Refuse a description that leaves something open, instead of taking a default.
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
    verify
        Says why a program cannot happen, None where nothing speaks against it; for programs without open parameters.
    compare
        Says how a second program differs in meaning from a first.
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
    verify: Callable[[Program], str | None] | None = None
    compare: Callable[[Program, Program], list[str]] | None = None
    say: Callable[[str], None] | None = None
