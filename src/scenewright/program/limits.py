"""How large a program may be: every limit in one place, and the check of a text before it is parsed.

What enters: a text, or a program that came from none. What leaves: nothing, or a `ProgramError` that says where a limit
is passed. The limits are far above what people write; below them every later stage is quick and never recurses
too deeply. The table in `docs/program.md` is this one.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from scenewright.errors import Place, ProgramError, Span, TranslationError
from scenewright.program.expressions import Node, children
from scenewright.program.types import Program
from scenewright.units import DIGITS, LARGEST_EXPONENT

TEXT_CHARACTERS = 1_000_000
ACTORS = 100
KNOTS = 100  # of one actor
PARAMETERS = 500
MANNER_LINES = 50
CONSTRAINTS = 2_000
LINE_PARTS = 1_000  # words, numbers and signs of one line
DESCRIPTION_CHARACTERS = 5_000  # what is to be understood, not what a program quotes
DEPTH = 100  # of parentheses, of `not`, of a sum's terms: how many steps lead from a constraint to its innermost part
NAME_CHARACTERS = 100

# Texts in quotes and comments are one part each, however long; an open quote takes all that is left.
_PARTS = re.compile(
    r'"[^"\\]*+(?:\\.[^"\\]*+)*+"?|#[^\n]*+|(?P<line>\n)|(?P<number>\d++(?:\.\d++)?(?:[eE][-+]?\d++)?)'
    r"|(?P<name>[^\W\d]\w*+)|(?P<open>[(\[])|(?P<close>[)\]])|(?P<sign>[^\s])",
    re.DOTALL,
)
_NO_CHARACTER = re.compile("[\ud800-\udfff]")
_DIGITS = re.compile(r"\d+")
_NESTING = frozenset({"not", "just", "implies"})


class _Section(NamedTuple):
    """A part of the text, by the word that its head begins with; each of its lines counts."""

    what: str
    most: int


_SECTIONS = {
    "parameters": _Section("parameters", PARAMETERS + 1),  # the head's own line counts too
    "manner": _Section("lines of the manner", MANNER_LINES + 1),
    "constraints": _Section("constraints", CONSTRAINTS + 1),
}


def check_text(text: str, name: str) -> None:
    """Raise `ProgramError` where a text passes a limit; one pass, whatever the text is."""
    if len(text) > TEXT_CHARACTERS:
        raise too_much("the text", "characters", len(text), TEXT_CHARACTERS, Place(name))
    _check_characters(text, name)
    _Scan(text, name).run()


def check_description(text: str, name: str) -> None:
    """Raise `TranslationError` where a description is empty, or more than anybody could mean by one scenario."""
    if not text.strip():
        fix = "for example: The ego drives west. An oncoming hero turns left. When the ego is 25 m before the conflict "
        raise TranslationError(
            "the description is empty",
            place=Place(name),
            expected="a few sentences that say who drives where, and what happens when",
            fix=f"{fix}point, the hero brakes to a stop.",
        )
    _check_characters(text, name)
    for whose, what, count, most in (
        ("the description", "characters", len(text), DESCRIPTION_CHARACTERS),
        ("a number of the description", "digits", max(map(len, _DIGITS.findall(text)), default=0), DIGITS),
    ):
        if count > most:
            raise TranslationError(
                f"{whose} has too many {what}",
                place=Place(name),
                found=f"{count:,}",
                expected=f"at most {most:,}",
                fix="describe one scenario; a program (.scene) may be longer",
            )


def _check_characters(text: str, name: str) -> None:
    stray = _NO_CHARACTER.search(text)
    if stray is not None:
        raise ProgramError(
            "the text holds something that is not a character",
            place=Place(name, text, Span(*stray.span())),
            found=f"code {ord(stray[0]):#06x}",
            expected="a text in UTF-8",
            fix="save the file as text in UTF-8",
        )


class _Scan:
    """Counts what a text is made of, part by part."""

    def __init__(self, text: str, name: str) -> None:
        self.text = text
        self.name = name
        self.section: _Section | None = None
        self.lines: dict[str, int] = {}
        self.parts = self.open = self.nested = 0
        self.after_value = False  # whether a minus would be a difference: nothing is nested in one

    def run(self) -> None:
        for part in _PARTS.finditer(self.text):
            if part.lastgroup == "line":
                self.parts = self.open = self.nested = 0
                self.after_value = False
            elif part.lastgroup is not None:
                self._take(part)

    def _take(self, part: re.Match[str]) -> None:
        kind, said = part.lastgroup, part[0]
        self.parts += 1
        if self.parts == 1:
            self._begin_line(part)
        if self.parts > LINE_PARTS:
            raise self._too_much("the line", "words, numbers and signs", None, LINE_PARTS, part, "make it several")
        if kind == "number":
            self._check_number(part)
        elif kind == "name" and len(said) > NAME_CHARACTERS:
            raise self._too_much("the name", "characters", len(said), NAME_CHARACTERS, part, "shorten it")
        if kind == "open":
            self.open += 1
        elif kind == "close":
            self.open = max(0, self.open - 1)
        elif said in _NESTING or (said == "-" and not self.after_value):
            self.nested += 1
        if self.open + self.nested > DEPTH:
            raise self._too_much("the line", "levels of nesting", None, DEPTH, part, "say it in several constraints")
        ends_value = kind in ("name", "number", "close") and said not in _NESTING
        self.after_value = ends_value or said == "."  # as within the id of a lane, 1.0.-1

    def _begin_line(self, part: re.Match[str]) -> None:
        word = part[0].lower()
        if word in _SECTIONS and self.section is not _SECTIONS["constraints"]:  # which come last; it is a label there
            self.section = _SECTIONS[word]
        elif word == "actor":
            self.section = None
            self._count("actors", ACTORS, part)
        if self.section is not None:
            self._count(self.section.what, self.section.most, part)

    def _count(self, what: str, most: int, part: re.Match[str]) -> None:
        self.lines[what] = self.lines.get(what, 0) + 1
        if self.lines[what] > most:
            limit = most if what == "actors" else most - 1
            raise self._too_much("the program", what, None, limit, part, "split it into several programs")

    def _check_number(self, part: re.Match[str]) -> None:
        mantissa, _, exponent = part[0].lower().partition("e")
        if len(mantissa) > DIGITS + 1:  # and a point
            raise self._too_much("the number", "digits", len(mantissa), DIGITS, part, "round it")
        if len(exponent) > 4 or abs(int(exponent or 0)) > LARGEST_EXPONENT:
            raise ProgramError(
                "no scenario has a number of this size",
                place=self._place(part),
                found=part[0] if len(exponent) <= DIGITS else f"an exponent of {len(exponent)} digits",
                expected=f"an exponent from -{LARGEST_EXPONENT} to {LARGEST_EXPONENT}",
                fix="correct the number",
            )

    def _place(self, part: re.Match[str]) -> Place:
        return Place(self.name, self.text, Span(*part.span()))

    def _too_much(
        self, whose: str, what: str, found: int | None, most: int, part: re.Match[str], fix: str
    ) -> ProgramError:
        return too_much(whose, what, found, most, self._place(part), fix)


def check_size(program: Program, name: str = "program") -> None:
    """Raise `ProgramError` where a program that may have come from no text passes a limit."""
    sizes = [
        ("the program", "actors", len(program.actors), ACTORS),
        ("the program", "parameters", len(program.parameters), PARAMETERS),
        ("the program", "constraints", len(program.constraints), CONSTRAINTS),
        *((f"the sketch of {actor.name}", "knots", len(actor.sketch.knots), KNOTS) for actor in program.actors),
    ]
    for whose, what, count, most in sizes:
        if count > most:
            raise too_much(whose, what, count, most, Place(name))


def check_depth(node: Node, place: Place) -> None:
    """Raise `ProgramError` where an expression is nested too deeply for what is to read it; this here is a loop."""
    level: list[Node] = [node]
    for _ in range(DEPTH):
        level = [child for each in level for child in children(each)]
        if not level:
            return
    raise too_much("the constraint", "levels of nesting", None, DEPTH, place, "say it in several constraints")


def too_much(
    whose: str, what: str, found: int | None, most: int, place: Place, fix: str = "say it with less"
) -> ProgramError:
    """Return the error for a limit that is passed."""
    return ProgramError(
        f"{whose} has too many {what}",
        place=place,
        found=f"{found:,}" if found is not None else f"more than {most:,}",
        expected=f"at most {most:,}",
        fix=fix,
    )
