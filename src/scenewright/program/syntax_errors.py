"""Says what is wrong with a text that is not a program: where, what stood there, what could have.

What enters: the parser's own exception and the text. What leaves: a `ProgramError`. It parses nothing itself.
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import cast

from lark.exceptions import UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken

from scenewright.errors import Place, ProgramError, Span
from scenewright.program.expressions import LANDMARKS
from scenewright.units import UNITS, unit_of_name

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
    "LANE_ID": "a lane such as 1.0.-1",
    "AREA": "driveway or road",
    "TURN": "left, right or straight",
    "DOT": "'.'",
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
# What people write where a program has something else: what stands where the parser stops, and the mend.
_MENDS = [
    (re.compile(written), mend)
    for written, mend in (
        (r"[−–—]", "write minus as '-'"),
        (r"≤|=<", "write '<='"),
        (r"≥|=>", "write '>='"),
        (r"!=|≠|!", "write 'not', as in not (A1v(t1) == 5)"),
        (r"=", "write '==' in a constraint, and '=' in front of the value of a parameter"),
        (r"&&?", "write 'and'"),
        (r"\|\|?", "write 'or'"),
        (r"(?<=-)>|→", "write 'implies'"),
        (r"[×·]", "write '*'"),
        (r"÷", "write '/'"),
        (r"²", "write '^2', as in m/s^2"),
        (r"[“”„‘’']", "write quotes as '\"'"),
        (r"(?<=/)/", "begin a comment with '#'"),
        (r"(?<=\d),(?=\d)", "write a decimal point: '.'"),
        (r"(?<=\d)\.|\.(?=\d)", "write digits on both sides of a decimal point"),
        (r"\+", "leave the sign away where a number is not negative"),
        (r";", "begin a new line for each constraint"),
        (r"[^\S\n\t ]|[\u200b\ufeff]", "write a plain space, or a plain end of line"),
    )
]
_UNIT = re.compile(r"[^\s,()\[\]]+")
_HAS_MORE = re.compile(rf"A\d+[xva]?|{'|'.join(LANDMARKS)}")  # words behind which something may stand, if not this
_LAST_WORD = re.compile(r"(?<![\w.])([^\W\d]\w*)[ \t]*$")
_WORDS = ("always", "never", "eventually", "gap", "freespace", "tta", "ttc", "headway")
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
    found = text[start : start + width].strip("\n") or end
    if isinstance(error, UnexpectedToken) and error.token.type == "NAME" and "UNIT" in accepted:
        return _no_unit(name, text, start)
    word = _LAST_WORD.search(text[:start])
    if word and not _HAS_MORE.fullmatch(word[1]) and found in ("(", "[", ".") and "COMPARATOR" in accepted:
        return _no_state(Place(name, text, Span(*word.span(1))), word[1])
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
    mend = next((mend for written, mend in _MENDS if written.match(text, at)), None)
    return mend or "compare with a working program: 'scenewright translate --code \"...\"' prints one"


def _no_unit(name: str, text: str, at: int) -> ProgramError:
    """Return the error for a word right behind a number: it is none of the units."""
    word = _UNIT.match(text, at)
    assert word is not None
    found, place = word[0], Place(name, text, Span(*word.span()))
    meant = UNITS.get(found.lower()) or unit_of_name(f"_{found.lower()}")
    return ProgramError(
        f"'{found}' is not a unit",
        place=place,
        found=found,
        expected=", ".join(UNITS),
        fix=f"did you mean {meant.symbol}?" if meant else "write one of these units, or none for SI units",
    )


def _no_state(place: Place, found: str) -> ProgramError:
    """Return the error for a word in front of a bracket or a point that can have none there."""
    actor = re.fullmatch(r"[aA](\d+)([xvaXVA]?)", found)
    near = [f"A{actor[1]}{actor[2].lower()}"] if actor else get_close_matches(found.lower(), _WORDS, n=1)
    names = ("STATE", "ACTOR", "DERIVED", "TEMPORAL")
    return ProgramError(
        f"nothing is called '{found}' here",
        place=place,
        found=found,
        expected=", ".join(_TERMINAL_NAMES[each] for each in names),
        fix=f"did you mean {near[0]}?" if near else "call actors by their numbers: A0, A1",
    )
