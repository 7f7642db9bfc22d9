"""Takes the lines with a label in front: title, map, manner and parameters.

What enters: a text and the narrative. What leaves: the text with those lines blanked, so that offsets stay as they are.
"""

from __future__ import annotations

import re
from fractions import Fraction

from scenewright.errors import UnknownWordsError
from scenewright.language.read.narrative import Narrative
from scenewright.program.manner import manner_of, unit_of
from scenewright.program.types import Parameter
from scenewright.units import UNITS, Dimension, unit_of_name

_LINE = re.compile(r"^(Title|Map): (.*)$", re.MULTILINE)
_NUMBER = r"(-?\d+(?:[./]\d+)?)(?: ?([A-Za-z][A-Za-z/^0-9]*))?"
_MANNER = re.compile(rf"^Manner: (\w+) is {_NUMBER}\.$", re.MULTILINE)
_RANGE = rf",? ?from {_NUMBER} to {_NUMBER}"
_PARAMETER = re.compile(rf"^Parameter (\w+) is (?:open|{_NUMBER})?(?:{_RANGE})?\.$", re.MULTILINE)


def take_labels(text: str, narrative: Narrative) -> str:
    """Give labelled lines to `narrative` and return the text without them."""
    manner: list[tuple[str, Fraction, None]] = []

    def line(match: re.Match[str]) -> str:
        if match[1] == "Title":
            narrative.title = match[2]
        else:
            narrative.map_name = match[2]
        return " " * len(match[0])

    def of_manner(match: re.Match[str]) -> str:
        manner.append((match[1], _in(unit_of(match[1]).dimension, match[2], match[3]), None))
        return " " * len(match[0])

    def parameter(match: re.Match[str]) -> str:
        unit = unit_of_name(match[1])
        if unit is None:
            raise UnknownWordsError(f"parameter {match[1]} has no unit", fix="end its name in _m, _s, _mps or _mpss")
        value, low, high = (
            None if match[at] is None else _in(unit.dimension, match[at], match[at + 1] or unit.symbol) / unit.si_factor
            for at in (2, 4, 6)
        )
        narrative.parameters.append(Parameter(match[1], value, low, high))
        return " " * len(match[0])

    for pattern, taken in ((_LINE, line), (_MANNER, of_manner), (_PARAMETER, parameter)):
        text = pattern.sub(taken, text)
    if manner:
        narrative.manner = manner_of(manner)
    return text


def _in(dimension: Dimension, number: str, symbol: str) -> Fraction:
    """Return an amount in SI units."""
    unit = UNITS.get(symbol)
    if unit is None or unit.dimension != dimension:
        raise UnknownWordsError(f"'{symbol}' is no unit of {dimension}", found=f"{number} {symbol}")
    return Fraction(number) * unit.si_factor
