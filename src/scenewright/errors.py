"""The error family and the form every message takes: where, what was found, what was expected, one fix.

What enters: facts about a fault. What leaves: exceptions that carry an exit status and print themselves for people.
Unsatisfiable, timed-out and unknown problems are results (see `scenewright.solve`), never exceptions.
"""

from __future__ import annotations

import traceback
from dataclasses import dataclass

_LONGEST_PART = 2_000  # characters of one part of a message


def _within_word(pair: str) -> bool:
    """Whether two characters next to each other belong to one word."""
    return all(char.isalnum() or char == "_" for char in pair)


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a source text, as character offsets ``[start, end)``."""

    start: int
    end: int

    def excerpt(self, text: str) -> str:
        """Return the characters of `text` that this span covers."""
        return text[self.start : self.end]

    def trimmed(self, text: str) -> Span:
        """Return the span without the spaces and commas that it begins and ends with."""
        said = self.excerpt(text)
        return Span(self.start + len(said) - len(said.lstrip(" ,\n")), self.end - len(said) + len(said.rstrip(" ,\n")))

    def whole_words(self, text: str) -> Span:
        """Return the span grown to whole words, where it begins or ends within one.

        >>> Span(5, 7).whole_words("two words here")
        Span(start=4, end=9)
        """
        start, end = self.start, self.end
        while 0 < start < len(text) and _within_word(text[start - 1 : start + 1]):
            start -= 1
        while 0 < end < len(text) and _within_word(text[end - 1 : end + 1]):
            end += 1
        return Span(start, end)

    def line_column(self, text: str) -> tuple[int, int]:
        """Return the 1-based line and column at which the span starts in `text`."""
        before = text[: self.start]
        return before.count("\n") + 1, self.start - (before.rfind("\n") + 1) + 1

    def union(self, other: Span) -> Span:
        """Return the smallest span that covers both."""
        return Span(min(self.start, other.start), max(self.end, other.end))


@dataclass(frozen=True, slots=True)
class Place:
    """Where in which text or file a fault lies; `span` and `text` give line, column and excerpt."""

    name: str
    text: str | None = None
    span: Span | None = None
    line: int | None = None

    def __str__(self) -> str:
        if self.text is not None and self.span is not None:
            line, column = self.span.line_column(self.text)
            return f"{self.name}:{line}:{column}"
        return self.name if self.line is None else f"{self.name}:{self.line}"

    def excerpt(self) -> str | None:
        """Return the source line with the faulty stretch underlined, or None where no text is known."""
        if self.text is None or self.span is None:
            return None
        line, column = self.span.line_column(self.text)
        lines = self.text.splitlines() or [""]
        source = lines[min(line, len(lines)) - 1]
        width = max(1, min(self.span.end - self.span.start, len(source) - column + 1))
        first = max(0, column - 1 - 60)  # a description is often one very long line: show the part around the fault
        shown = source[first : first + 120]
        return f"    {shown}\n    {' ' * (column - 1 - first)}{'^' * min(width, 120)}"


def _in_short(said: str) -> str:
    """Return what was said, without its middle where it is too long for a message: whatever was found may be quoted."""
    if len(said) <= _LONGEST_PART:
        return said
    kept = _LONGEST_PART // 2
    return f"{said[:kept]} ... ({len(said) - 2 * kept:,} characters more) ... {said[-kept:]}"


def told_by(error: BaseException) -> str:
    """Return an exception of somebody else's code in a line: what it is, what it says, and the line that raised it."""
    last = next(reversed(traceback.extract_tb(error.__traceback__)), None)
    line = f" (line {last.lineno} of {last.filename.rsplit('/', 1)[-1]}: {last.line})" if last else ""
    try:
        says = str(error).strip()
    except Exception:  # somebody else's as well
        says = ""
    return f"{type(error).__name__}: {(says.splitlines() or ['no message'])[0]}{line}"


def shown_as(value: object) -> str:
    """Return a value of somebody else's as a message shows it."""
    try:
        return repr(value)
    except Exception:  # its own repr() may do anything, and a whole number may have too many digits
        return f"a {type(value).__name__}"


class ScenewrightError(Exception):
    """Root of all errors that a user can cause or mend.

    Parameters
    ----------
    message
        What is wrong, in one sentence.
    place
        Where, if known.
    found, expected, fix
        What stood there, what could have stood there, and one thing to do about it.
    """

    exit_status = 2

    def __init__(
        self,
        message: str,
        *,
        place: Place | None = None,
        found: str | None = None,
        expected: str | None = None,
        fix: str | None = None,
    ) -> None:
        super().__init__(_in_short(message))
        self.message = _in_short(message)
        self.place = place
        self.found = _in_short(found) if found else found
        self.expected = _in_short(expected) if expected else expected
        self.fix = fix

    def __str__(self) -> str:
        lines = [f"{self.place}: {self.message}" if self.place else self.message]
        excerpt = self.place.excerpt() if self.place else None
        if excerpt:
            lines.append(excerpt)
        for label, value in (("found", self.found), ("expected", self.expected), ("fix", self.fix)):
            if value:
                lines.append(f"  {label + ':':<10}{value}")
        return "\n".join(lines)

    def as_dict(self) -> dict[str, object]:
        """Return the error as plain data, for ``--json``."""
        return {
            "error": type(self).__name__,
            "message": self.message,
            "where": str(self.place) if self.place else None,
            "found": self.found,
            "expected": self.expected,
            "fix": self.fix,
        }


class InputError(ScenewrightError):
    """A command-line value, file or folder is wrong."""


class ProgramError(ScenewrightError):
    """A program does not parse or does not make sense."""


class ParameterError(ScenewrightError):
    """A parameter is unknown, not a number, or out of range."""


class TranslationError(ScenewrightError):
    """A description could not be understood, in whole or in part."""


class UnknownWordsError(TranslationError):
    """Words, or a turn of phrase, are not known; nothing is known to be wrong with them."""


class MapError(ScenewrightError):
    """A map file is missing, broken, or lacks what the scenario needs."""


class PolicyError(ScenewrightError):
    """An ego policy could not be loaded, raised, or returned something that is not a motion."""


class SimulatorError(ScenewrightError):
    """A simulator could not be loaded, or failed while it drove."""


class OutputError(ScenewrightError):
    """A result could not be written."""


class MissingExtraError(ScenewrightError):
    """An optional part is not installed; the message names the pip command."""

    def __init__(self, part: str, extra: str, package: str = "scenewright") -> None:
        super().__init__(f"{part} is not installed", fix=f'pip install "{package}[{extra}]"')


class SolverError(ScenewrightError):
    """A solver, or a process that works for us, broke its own contract or failed."""

    exit_status = 4
