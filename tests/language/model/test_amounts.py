"""Amounts in words."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.language.model.amounts import read_amounts, spoken_of


@pytest.mark.parametrize(
    ("words", "value", "unit"),
    [
        ("25 m", "25", "m"), ("sixty feet", "60", "ft"), ("sixty-five metres", "65", "m"), ("1.5 m/s²", "3/2", "m/s^2"),
        ("half a second", "1/2", "s"), ("two and a half seconds", "5/2", "s"), ("a hundred and twenty m", "120", "m"),
        ("three point five s", "7/2", "s"), ("2½ s", "5/2", "s"), ("1,200 m", "1200", "m"), ("2,5 s", "5/2", "s"),
        ("30-mph", "30", "mph"), ("50 kilometres per hour", "50", "km/h"), ("-3 m/s^2", "-3", "m/s^2"),
        ("4 metres per second squared", "4", "m/s^2"), ("10/3 min", "10/3", "min"), ("just before", "5", "m"),
        ("a second", "1", "s"), ("a couple of seconds", "2", "s"),
    ],
)  # fmt: skip
def test_numbers_and_units_in_many_words(words: str, value: str, unit: str) -> None:
    assert (Fraction(value), unit) in read_amounts(words)


def test_parameters_numbers_without_units_and_nothing() -> None:
    assert read_amounts("{hero_gap_m}") == {("hero_gap_m", "m")}
    assert read_amounts("about 20") == {(Fraction(20), None)}
    assert read_amounts("brakes") == set()
    assert (Fraction(4), "m/s") not in read_amounts("4 metres per second squared")


def test_every_number_and_parameter_that_a_text_speaks_of() -> None:
    text = "A van, 20 m away, does 3 m/s^2 for two seconds past gap_m; one of them is car2 and snake_case is none."
    assert [span.excerpt(text) for span in spoken_of(text)] == ["20", "gap_m", "3", "two"] or sorted(
        span.excerpt(text) for span in spoken_of(text)
    ) == ["20", "3", "gap_m", "two"]
