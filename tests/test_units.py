"""Units: exact factors, and what a parameter's name says."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.units import PLAUSIBLE_RANGE, UNITS, decimal_fraction, format_fraction, unit_of_name


@pytest.mark.parametrize(
    ("symbol", "si"),
    [
        ("ft", "0.3048"),
        ("yd", "0.9144"),
        ("mi", "1609.344"),
        ("mph", "0.44704"),
        ("km/h", "5/18"),
        ("ms", "1/1000"),
        ("min", "60"),
        ("g", "9.80665"),
        ("ft/s^2", "0.3048"),
    ],
)
def test_factors_are_exact(symbol: str, si: str) -> None:
    assert UNITS[symbol].si_factor == Fraction(si)


@pytest.mark.parametrize(
    ("name", "symbol"),
    [
        ("gap_m", "m"),
        ("wait_s", "s"),
        ("hero_deceleration_mpss", "m/s^2"),
        ("rate_mps2", "m/s^2"),
        ("speed_mps", "m/s"),
        ("speed_mph", "mph"),
        ("speed_kmph", "km/h"),
        ("speed_kph", "km/h"),
        ("speed_kmh", "km/h"),
        ("gap_ft", "ft"),
        ("mpss", None),
        ("distance", None),
        ("atoms", None),
    ],
)
def test_units_of_names(name: str, symbol: str | None) -> None:
    unit = unit_of_name(name)
    assert (unit.symbol if unit else None) == symbol


def test_every_dimension_has_a_plausible_range() -> None:
    assert {unit.dimension for unit in UNITS.values()} == set(PLAUSIBLE_RANGE)
    assert all(low < high for low, high in PLAUSIBLE_RANGE.values())


@given(st.fractions())
def test_a_formatted_fraction_reads_back(value: Fraction) -> None:
    assert Fraction(format_fraction(value)) == value


@given(st.decimals(-1000, 1000, places=6))
def test_decimals_are_written_without_a_fraction_bar(value: object) -> None:
    assert "/" not in format_fraction(Fraction(str(value)))
    assert "E" not in format_fraction(Fraction(str(value)))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_float_is_the_decimal_that_it_prints_as(value: float) -> None:
    assert float(decimal_fraction(value)) == value
    assert decimal_fraction(0.1) == Fraction(1, 10)
