"""Takes the lines with a label in front: title, map, manner and parameters.

What enters: a text and the narrative. What leaves: the text with those lines blanked, so that offsets stay as they are.
"""

from __future__ import annotations

import re
from fractions import Fraction

from scenewright.errors import UnknownWordsError
from scenewright.program.manner import manner_of, unit_of
from scenewright.program.types import Parameter
from scenewright.translate.read.narrative import Narrative
from scenewright.units import UNITS, Unit, unit_of_name

_LINE = re.compile(r"^(Title:|Map:|Manner:|Parameter) (.*)$", re.MULTILINE)
_NUMBER = r"(-?\d+(?:[./]\d+)?)(?: ?([A-Za-z][A-Za-z/^0-9]*))?"
_VALUE = re.compile(rf"(\w+) is (?:open|{_NUMBER})(?:, from {_NUMBER} to {_NUMBER})?\.")


def take_labels(text: str, narrative: Narrative) -> str:
    """Give labelled lines to `narrative` and return the text without them."""
    manner: list[tuple[str, Fraction, None]] = []

    def take(match: re.Match[str]) -> str:
        (label, said), value = match.groups(), _VALUE.fullmatch(match[2])
        if label == "Title:":
            narrative.title = said
        elif label == "Map:":
            narrative.map_name = said
        elif value is None or (label == "Manner:" and value[2] is None):
            return match[0]
        elif label == "Manner:":
            manner.append((value[1], _in(unit_of(value[1]), value, 2) or Fraction(0), None))
        else:
            unit = unit_of_name(value[1])
            if unit is None:
                fix = "end its name in _m, _s, _mps or _mpss"
                raise UnknownWordsError(f"parameter {value[1]} has no unit", found=match[0], fix=fix)
            told, low, high = (each and each / unit.si_factor for at in (2, 4, 6) for each in [_in(unit, value, at)])
            narrative.parameters.append(Parameter(value[1], told, low, high))
        return " " * len(match[0])

    text = _LINE.sub(take, text)
    if manner:
        narrative.manner = manner_of(manner)
    return text


def _in(unit: Unit, match: re.Match[str], at: int) -> Fraction | None:
    """Return an amount in SI units, which is one of `unit` where no other is told; None where it is open."""
    told = UNITS.get(match[at + 1] or unit.symbol)
    if told is None or told.dimension != unit.dimension:
        raise UnknownWordsError(f"'{match[at + 1]}' is no unit of {unit.dimension}", found=match[0])
    return None if match[at] is None else Fraction(match[at]) * told.si_factor
