"""The options of every command that may translate a description, and what a model translator gets from above.

What enters: words from a command line. What leaves: what is `Asked`, and `TranslatorSettings` with the means to ask the
user, to ask the solver and to compare meanings, none of which the translator imports itself.
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
from scenewright.translate.model.settings import (
    DEFAULT_MAX_TOKENS,
    DEFAULT_REPAIRS,
    DEFAULT_TIMEOUT_S,
    Question,
    TranslatorSettings,
)

if TYPE_CHECKING:
    from scenewright.orchestrate import Request
    from scenewright.program.types import Program

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
    strict: Annotated[bool, _option("--strict", help="Refuse a description that leaves something open.")] = False,
    ask: Annotated[bool, _option("--ask", help="Ask on the terminal about what is left open.")] = False,
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
    can_ask = ask and sys.stdin.isatty() and sys.stderr.isatty()
    if ask and not can_ask:
        _say("there is no terminal to ask on: defaults are taken, and listed")
    return TranslatorSettings(
        base_url=base_url,
        repairs=repairs,
        strict=strict,
        record=record,
        replay=replay,
        timeout_s=timeout_s,
        reply_wait_s=reply_wait_s,
        max_tokens=max_tokens,
        ask=_ask if can_ask else None,
        compare=differences_in_meaning,
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
        from scenewright.orchestrate import Request

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
    translator: Translator = "offline",
    *,
    settings: TranslatorSettings,
) -> Asked:
    return Asked(source, parameter, map_name, ego, translator, settings)


with_asked = _given("asked", _asked)


def impossibility(program: Program, map_name: str | None, ego: str = "idm") -> str | None:
    """Return the proof that `program` cannot happen; None where nothing speaks against it."""
    from scenewright.orchestrate import Request, orchestrate
    from scenewright.program.printer import print_program

    result = orchestrate(Request(print_program(program), map_name=map_name, ego=ego), until="check")
    if result.status != "infeasible" or result.feasibility is None:
        return None
    return result.feasibility.explain()


def differences_in_meaning(offline: Program, other: Program) -> list[str]:
    """Return how the program of a model differs in meaning from that of the offline translator, in sentences."""
    from scenewright.study.meaning import differences

    words = {"lost: ": "only the offline translator understood ", "added: ": "only the model understood "}
    found = []
    for each in differences(offline, other):
        start = next((start for start in words if each.startswith(start)), "")
        told = words.get(start, "the model differs from the offline translator: ")
        found.append(told + each.removeprefix(start))
    return found


def _ask(question: Question) -> str:
    """Put a question on stderr, and return the alternative that the user chooses; its default for an empty line."""
    lines = [f"\n{question.question}" + (f" ('{question.words}')" if question.words else "")]
    lines += [f"  {number}  {each}" for number, each in enumerate(question.alternatives, start=1)]
    default = question.alternatives.index(question.default) + 1
    sys.stderr.write("\n".join(lines) + "\n")
    while True:
        sys.stderr.write(f"number [{default}]: ")
        sys.stderr.flush()
        line = sys.stdin.readline()
        answer = line.strip()
        if not answer:  # an empty line, or the end of the input
            return question.default
        if answer.isdecimal() and 1 <= int(answer) <= len(question.alternatives):
            return question.alternatives[int(answer) - 1]
        sys.stderr.write(f"a number from 1 to {len(question.alternatives)}\n")


def _say(text: str) -> None:
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()
