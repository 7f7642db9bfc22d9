"""Says what is wrong with a text that is not a program: where, what stood there, what could have.

What enters: the parser's own exception and the text. What leaves: a `ProgramError`. It parses nothing itself.
"""

from __future__ import annotations

from typing import cast

from lark.exceptions import UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken

from scenewright.errors import Place, ProgramError, Span

_TERMINAL_NAMES = {
    "STATE": "a state such as A1x(t1)",
    "NAME": "a name",
    "NUMBER": "a number",
    "ACTOR": "an actor such as A1",
    "_NL": "the end of the line",
    "COMPARATOR": "one of == <= >= < >",
    "LPAR": "'('",
    "RPAR": "')'",
    "LSQB": "'['",
    "RSQB": "']'",
    "COMMA": "','",
    "HEADING": "a heading N, E, S or W",
    "INTEGER": "a whole number",
    "UNIT": "a unit",
    "LABEL": "a label such as c1:",
    "DERIVED": "gap, tta, ttc or headway",
    "TEMPORAL": "always, never or eventually",
    "$END": "the end of the text",
    "COLON": "':'",
    "STRING": "a quoted text",
}


def syntax_error(error: UnexpectedInput, text: str, name: str) -> ProgramError:
    """Return the error for a text that the parser gave up on."""
    position = cast("int | None", error.pos_in_stream)
    start = len(text.rstrip()) if position is None or position < 0 else position
    accepted: set[str] = set()
    width = 1
    if isinstance(error, UnexpectedToken):
        accepted = set(error.accepts or error.expected)
        if error.token.type == "$END":
            start = len(text.rstrip())
        elif error.token.type != "_NL":
            width = max(1, len(str(error.token)))
    elif isinstance(error, UnexpectedCharacters):
        accepted = set(error.allowed or ())
    elif isinstance(error, UnexpectedEOF):
        accepted = set(error.expected)
    line_end = text.find("\n", start)
    found = text[start : start + width].strip() or "the end of the line"
    expected = sorted(_TERMINAL_NAMES.get(item, item.lower()) for item in accepted)
    return ProgramError(
        "this is not a program",
        place=Place(name, text, Span(start, min(start + width, line_end if line_end > start else start + width))),
        found=repr(found) if found != "the end of the line" else found,
        expected=", ".join(expected[:8]) or None,
        fix="compare with a working program: 'scenewright translate \"...\"' prints one",
    )
