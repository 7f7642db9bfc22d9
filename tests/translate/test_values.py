"""What a text says its parameters are becomes their value or their range, or is refused where it stands."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.errors import TranslationError
from scenewright.program.types import Parameter
from scenewright.translate.offline import translate_offline
from scenewright.translate.values import take_values

WAYS = (
    "The ego is on the driveway, 60 m before the stop line, and turns right onto the road, westbound. The hero is "
    "ahead "
    "of it on the driveway and takes the same right turn."
)
DEED = "When the ego is gap_m behind the hero, the hero brakes with rate_mpss to a standstill."
TEXT = f"{WAYS} {DEED}"


def parameters(text: str) -> dict[str, Parameter]:
    return {each.name: each for each in translate_offline(text).program.parameters}


@pytest.mark.parametrize(
    "told",
    [
        "{} gap_m = 12 and rate_mpss = 3.5.",
        "{} The value of gap_m is 12 m. The value of rate_mpss is 3.5 m/s^2.",
        "{} Here gap_m is 12 m, and rate_mpss is 3.5.",
        "{} (with gap_m = 12, rate_mpss = 3.5)",
        "With gap_m = 12 m and rate_mpss = 3.5, the following is tested. {}",
        "{}\n\nParameters:\n- gap_m: 12 m\n- rate_mpss: 3.5 m/s^2\n",
        "{}\ngap_m = 12 m\nrate_mpss = 3.5",
    ],
)
def test_values(told: str) -> None:
    found = parameters(told.format(TEXT))
    assert (found["gap_m"].value, found["rate_mpss"].value) == (12, Fraction("3.5"))


def test_values_beside_their_names() -> None:
    text = TEXT.replace("gap_m", "gap_m (= 12 m)").replace("rate_mpss", "rate_mpss = 3.5 m/s^2")
    found = parameters(text)
    assert (found["gap_m"].value, found["rate_mpss"].value) == (12, Fraction("3.5"))


def test_the_program_is_the_same_but_for_the_values() -> None:
    plain, told = translate_offline(TEXT), translate_offline(f"{TEXT} gap_m = 12, rate_mpss = 3.5.")
    assert [each.formula for each in plain.program.constraints] == [each.formula for each in told.program.constraints]
    assert told.program.description == f"{TEXT} gap_m = 12, rate_mpss = 3.5."
    assert {"gap_m is 12 m", "rate_mpss is 3.5 m/s^2"} <= {each.understood for each in told.readings}


@pytest.mark.parametrize(
    "told",
    [
        "gap_m lies between 10 m and 20 m.",
        "gap_m ranges from 10 to 20 m.",
        "gap_m in [10, 20].",
        "gap_m varies from 10 m to 20 m.",
    ],
)
def test_ranges(told: str) -> None:
    found = parameters(f"{TEXT} {told}")["gap_m"]
    assert (found.value, found.low, found.high) == (None, 10, 20)


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ("gap_m = 12 s.", "is in m"),
        ("gap_m = -12.", "cannot be negative"),
        ("gap_m = 12. gap_m = 14.", "two values"),
        ("gap_m is between 20 m and 10 m.", "empty"),
        ("gap_m is 12 m or 14 m.", ""),
        ("gap_m is not 12 m.", ""),
        ("gap_m is 12 m in the first run.", ""),
        ("gap_m is drawn at random between 10 m and 20 m.", "chance"),
        ("other_m = 12.", "other_m"),
    ],
)
def test_what_is_no_value(told: str, message: str) -> None:
    with pytest.raises(TranslationError) as raised:
        translate_offline(f"{TEXT} {told}")
    assert message in str(raised.value)
    assert raised.value.place is not None
    assert raised.value.place.text == f"{TEXT} {told}"


@given(st.integers(0, 999), st.sampled_from(["m", "ft", "yd"]), st.sampled_from(["=", "is", "equals", "is set to"]))
def test_the_rest_keeps_its_place(value: int, unit: str, joint: str) -> None:
    tail = f" gap_m {joint} {value} {unit}."
    rest, (found,) = take_values(DEED + tail, "x")
    assert rest == DEED + " " * len(tail)
    factors = {"m": Fraction(1), "ft": Fraction("0.3048"), "yd": Fraction("0.9144")}
    assert found.value == value * factors[unit]
    assert found.span.excerpt(DEED + tail) == tail.strip(" .")
