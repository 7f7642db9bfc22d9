"""The options of every command that may translate a description, and the asking of open questions on the terminal.

What enters: words from a command line. What leaves: what is `Asked`, and `TranslatorSettings` with the means to ask the
user, which the translator does not import itself.
"""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from scenewright.cli.options import Ego, MapName, Parameters, Source, Translator, parameters_of
from scenewright.translate.model.exchange import (
    DEFAULT_MAX_TOKENS,
    DEFAULT_REPAIRS,
    DEFAULT_TIMEOUT_S,
    TranslatorSettings,
)

if TYPE_CHECKING:
    from scenewright.request import Request
    from scenewright.translate.story import Question

_PANEL = "Translation"
T = TypeVar("T")


def _given(name: str, made: Callable[..., Any]) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Return what gives a command the options of `made`: the command gets what these say as `name`."""
    options = inspect.signature(made, eval_str=True).parameters

    def give(command: Callable[..., T]) -> Callable[..., T]:
        own = inspect.signature(command, eval_str=True).parameters

        @functools.wraps(command)
        def wrapped(**values: Any) -> T:
            chosen = {each: values.pop(each) for each in options}
            return command(**values, **{name: made(**chosen)})

        parameters = [each for each in (*options.values(), *own.values()) if each.name != name]
        keyword = [each.replace(kind=inspect.Parameter.KEYWORD_ONLY) for each in parameters]
        wrapped.__signature__ = inspect.Signature(keyword)  # type: ignore[attr-defined]
        wrapped.__annotations__ = {each.name: each.annotation for each in parameters}
        return wrapped

    return give


_option = functools.partial(typer.Option, rich_help_panel=_PANEL)


def _settings(
    answers: Annotated[
        Path | None,
        _option(
            "--answers",
            metavar="FILE",
            help="Answers to what the description leaves open: a JSON object, as a run keeps it in answers.json.",
            show_default=False,
        ),
    ] = None,
    strict: Annotated[
        bool,
        _option("--strict", help="Refuse a description that leaves something open, even where there is a default."),
    ] = False,
    second_opinion: Annotated[
        bool,
        _option("--second-opinion", help="Let the model judge, blind, whether what was understood is what was said."),
    ] = False,
    base_url: Annotated[
        str | None,
        _option(
            "--base-url",
            metavar="URL",
            help="Address of an OpenAI-compatible server. Default: SCENEWRIGHT_BASE_URL.",
            show_default=False,
        ),
    ] = None,
    repairs: Annotated[
        int, _option(min=0, max=20, help="How often a reply that does not hold goes back to the model.")
    ] = DEFAULT_REPAIRS,
    timeout_s: Annotated[
        float,
        _option("--timeout", metavar="SECONDS", min=0.1, max=3600.0, help="How long one reply of a model may take."),
    ] = DEFAULT_TIMEOUT_S,
    max_tokens: Annotated[
        int, _option(min=100, max=1_000_000, help="What one reply of a model may hold, its thinking included.")
    ] = DEFAULT_MAX_TOKENS,
    reply_wait_s: Annotated[
        float,
        _option(
            "--reply-wait", metavar="SECONDS", min=0.0, max=1e6, help="How long to wait for a reply file of files:DIR."
        ),
    ] = 0.0,
    record: Annotated[
        Path | None,
        _option("--record", metavar="DIR", help="Keep every exchange with the model.", show_default=False),
    ] = None,
    replay: Annotated[
        Path | None,
        _option("--replay", metavar="DIR", help="Take replies from kept exchanges; ask nobody.", show_default=False),
    ] = None,
) -> TranslatorSettings:
    """Return the settings that these options say."""
    from scenewright.translate.understand import read_answers

    return TranslatorSettings(
        base_url=base_url,
        repairs=repairs,
        strict=strict,
        record=record,
        replay=replay,
        timeout_s=timeout_s,
        reply_wait_s=reply_wait_s,
        max_tokens=max_tokens,
        ask=ask if not strict and sys.stdin.isatty() and sys.stderr.isatty() else None,
        answers=read_answers(answers) if answers is not None else {},
        second_opinion=second_opinion,
        say=_say if sys.stderr.isatty() else None,
    )


with_translator = _given("settings", _settings)


@dataclass(frozen=True, slots=True)
class Asked:
    """What a command is to carry out, as it was typed."""

    source: str
    parameter: list[str] | None
    map_name: str | None
    ego: str
    translator: str
    settings: TranslatorSettings

    def request(self, **more: Any) -> Request:
        """Return the request, with what a command adds to it; raises `ParameterError` where a value is none."""
        from scenewright.request import Request

        values = parameters_of(self.parameter)
        return Request(
            self.source, values, self.map_name, self.ego, translator=self.translator, translation=self.settings, **more
        )


@with_translator
def _asked(
    source: Source,
    parameter: Parameters = None,
    map_name: MapName = None,
    ego: Ego = "idm",
    translator: Translator = "auto",
    *,
    settings: TranslatorSettings,
) -> Asked:
    return Asked(source, parameter, map_name, ego, translator, settings)


with_asked = _given("asked", _asked)


def ask(question: Question) -> str:
    """Put a question on stderr, and return the alternative that the user chooses, by number.

    An empty line, or the end of the input, takes the default.

    Raises
    ------
    OpenQuestionsError
        At the end of the input where there is no default.
    """
    from scenewright.translate.understand import OpenQuestionsError

    words = f'  ("{question.quote.text}")' if question.quote else ""
    lines = [f"\n{question.text}{words}"]
    lines += [f"  {number}  {each}" for number, each in enumerate(question.alternatives, start=1)]
    sys.stderr.write("\n".join(lines) + "\n")
    while True:
        sys.stderr.write("number: " if question.default is None else f"number [{question.default + 1}]: ")
        sys.stderr.flush()
        line = sys.stdin.readline()
        answer = line.strip()
        if not answer and question.default is not None:
            return question.alternatives[question.default]
        if not line:
            raise OpenQuestionsError([question])
        if answer in question.alternatives:
            return answer
        if answer.isdecimal() and 1 <= int(answer) <= len(question.alternatives):
            return question.alternatives[int(answer) - 1]
        sys.stderr.write(f"a number from 1 to {len(question.alternatives)}\n")


def _say(text: str) -> None:
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()
