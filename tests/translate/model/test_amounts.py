"""Amounts in words."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.translate.model.amounts import read_amounts


@pytest.mark.parametrize(
    ("words", "value", "unit"),
    [
        ("25 m", "25", "m"), ("sixty feet", "60", "ft"), ("sixty-five metres", "65", "m"), ("1.5 m/s²", "3/2", "m/s^2"),
        ("half a second", "1/2", "s"), ("two and a half seconds", "5/2", "s"), ("a hundred and twenty m", "120", "m"),
        ("2½ s", "5/2", "s"), ("½ s", "1/2", "s"), ("1,200 m", "1200", "m"), ("2,5 s", "5/2", "s"),
        ("30-mph", "30", "mph"), ("50 kilometres per hour", "50", "km/h"), ("-3 m/s^2", "3", "m/s^2"),
        ("4 metres per second squared", "4", "m/s^2"), ("10/3 min", "10/3", "min"), ("just before", "5", "m"),
        ("a second", "1", "s"),
    ],
)  # fmt: skip
def test_numbers_and_units_in_many_words(words: str, value: str, unit: str) -> None:
    assert (Fraction(value), unit) in read_amounts(words)


def test_parameters_numbers_without_units_and_nothing() -> None:
    assert set(read_amounts("{hero_gap_m}")) == {("hero_gap_m", "m")}
    assert set(read_amounts("about 20")) == {(Fraction(20), None)}
    assert list(read_amounts("brakes")) == []
    assert (Fraction(4), "m/s") not in read_amounts("4 metres per second squared")
