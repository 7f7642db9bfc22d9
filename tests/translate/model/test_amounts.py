"""Amounts in words."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.translate.model.amounts import spoken_in


@pytest.mark.parametrize(
    ("words", "value", "unit"),
    [
        ("25 m", "25", "m"), ("sixty feet", "60", "ft"), ("sixty-five metres", "65", "m"), ("1.5 m/s²", "3/2", "m/s^2"),
        ("half a second", "1/2", "s"), ("two and a half seconds", "5/2", "s"), ("a hundred and twenty m", "120", "m"),
        ("2½ s", "5/2", "s"), ("½ s", "1/2", "s"), ("1,200 m", "1200", "m"), ("2,5 s", "5/2", "s"),
        ("30-mph", "30", "mph"), ("50 kilometres per hour", "50", "km/h"), ("-3 m/s^2", "-3", "m/s^2"),
        ("4 metres per second squared", "4", "m/s^2"), ("10/3 min", "10/3", "min"), ("just before", "5", "m"),
        ("a second", "1", "s"),
    ],
)  # fmt: skip
def test_numbers_and_units_in_many_words(words: str, value: str, unit: str) -> None:
    (said,) = spoken_in(words)
    assert Fraction(value) in said.values
    assert said.unit == unit


def test_parameters_numbers_without_units_and_nothing() -> None:
    assert [(set(each.values), each.unit) for each in spoken_in("{hero_gap_m}")] == [({"hero_gap_m"}, "m")]
    assert [(set(each.values), each.unit) for each in spoken_in("about 20")] == [({Fraction(20)}, None)]
    assert list(spoken_in("brakes")) == []


def test_every_number_and_parameter_that_a_text_speaks_of() -> None:
    text = "A van, 20 m away, does 3 m/s^2 for two seconds past gap_m; one of them is car2 and snake_case is none."
    assert [each.span.excerpt(text) for each in spoken_in(text)] == ["20", "3", "two", "gap_m"]
