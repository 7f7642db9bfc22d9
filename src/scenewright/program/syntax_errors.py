"""Says what is wrong with a text that is not a program: where, what stood there, what could have.

What enters: the parser's own exception and the text. What leaves: a `ProgramError`. It parses nothing itself.
"""

from __future__ import annotations

import re
from typing import cast

from lark.exceptions import UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken

from scenewright.errors import Place, ProgramError, Span
from scenewright.program.expressions import LANDMARKS

# In the order of how much they help: a message shows the first few of what is possible.
_TERMINAL_NAMES = {
    "_NL": "the end of the line",
    "STATE": "a state such as A1x(t1)",
    "COMPARATOR": "one of == <= >= < >",
    "NUMBER": "a number",
    "NAME": "a name",
    "UNIT": "a unit",
    "RPAR": "')'",
    "RSQB": "']'",
    "COMMA": "','",
    "COLON": "':'",
    "LPAR": "'('",
    "LSQB": "'['",
    "ACTOR": "an actor such as A1",
    "DERIVED": "gap, freespace, tta, ttc or headway",
    "TEMPORAL": "always, never or eventually",
    "HEADING": "a heading N, E, S or W",
    "INTEGER": "a whole number",
    "STRING": "a quoted text",
    "LABEL": "a label such as c1:",
    "$END": "the end of the text",
    "PLUS": "'+'",
    "MINUS": "'-'",
    "TIMES": "'*'",
    "DIVIDE": "'/'",
    "EQUAL": "'='",
    "AT": "'@'",
    "DOTS": "'..'",
    "ACTOR_HEAD": "'Actor 0:'",
    "ACTOR_HEAD_SMALL": "'Actor 0:'",
    "PARAMETERS_HEAD": "'parameters:'",
    "PARAMETERS_HEAD_SMALL": "'parameters:'",
    "MANNER_HEAD": "'manner:'",
    "MANNER_HEAD_SMALL": "'manner:'",
    "CONSTRAINTS_HEAD": "'Constraints:'",
    "CONSTRAINTS_HEAD_SMALL": "'Constraints:'",
}
_SHOWN = 8
_PARTNER = re.compile(rf"\b({'|'.join(LANDMARKS)})(?=\((A\d+)\))")  # a landmark with somebody, and not whose


def syntax_error(error: UnexpectedInput, text: str, name: str) -> ProgramError:
    """Return the error for a text that the parser gave up on."""
    position = cast("int | None", error.pos_in_stream)
    start = len(text.rstrip()) if position is None or position < 0 else position
    accepted: set[str] = set()
    width, end = 1, "the end of the line"
    if isinstance(error, UnexpectedToken):
        accepted = set(error.accepts or error.expected)
        if error.token.type == "$END":
            start, end = len(text.rstrip()), "the end of the text"
        elif error.token.type != "_NL":
            width = max(1, len(str(error.token)))
    elif isinstance(error, UnexpectedCharacters):
        accepted = set(error.allowed or ())
    elif isinstance(error, UnexpectedEOF):
        accepted = set(error.expected)
    line_end = text.find("\n", start)
    found = text[start : start + width].strip() or end
    if not text[:start].rsplit("\n", maxsplit=1)[-1].strip():
        accepted.discard("_NL")  # an empty line would do no harm, and no good
    rank = {terminal: number for number, terminal in enumerate(_TERMINAL_NAMES)}
    helpful = sorted(accepted, key=lambda terminal: (rank.get(terminal, len(rank)), terminal))
    expected = list(dict.fromkeys(_TERMINAL_NAMES.get(terminal, terminal.lower()) for terminal in helpful))
    return ProgramError(
        "this is not a program",
        place=Place(name, text, Span(start, min(start + width, line_end if line_end > start else start + width))),
        found=repr(found) if found != end else found,
        expected=", ".join(expected[:_SHOWN]) or None,
        fix=_fix(text, start),
    )


def _fix(text: str, at: int) -> str:
    """Say what to do about what stands at an offset."""
    for whose in _PARTNER.finditer(text):
        if whose.end() == at:
            return f"say whose it is, too: A1.{whose[1]}({whose[2]}) where it is that of actor 1"
    return "compare with a working program: 'scenewright translate \"...\"' prints one"
