"""Lines with a label in front."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.errors import ProgramError, UnknownWordsError
from scenewright.translate.read.labels import take_labels
from scenewright.translate.read.narrative import Narrative


def test_labels_are_taken_and_offsets_stay() -> None:
    limit = "Parameter limit_kmph is 10 m/s, from 5 km/h to 50 km/h."
    text = f"Title: a. b\nMap: town\nManner: stands_s is 2000 ms.\n{limit}\nThe ego"
    narrative = Narrative(text)
    rest = take_labels(text, narrative)
    assert len(rest) == len(text)
    assert rest.replace(".", " ").split() == ["The", "ego"]
    assert (narrative.title, narrative.map_name, narrative.manner.stands_s) == ("a. b", "town", 2)
    (parameter,) = narrative.parameters
    assert (parameter.value, parameter.low, parameter.high) == (Fraction(36), 5, 50)


@pytest.mark.parametrize("line", ["Parameter gap is 3 m.", "Parameter gap_m is 3 s.", "Manner: stands_s is 900 s."])
def test_labels_that_make_no_sense(line: str) -> None:
    with pytest.raises((UnknownWordsError, ProgramError)):
        take_labels(line, Narrative(line))
