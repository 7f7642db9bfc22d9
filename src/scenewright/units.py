"""Units that people write, and their SI value; units that parameter names carry.

What enters: unit words and parameter names. What leaves: exact factors, dimensions and default ranges.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

Dimension = Literal["length", "time", "speed", "acceleration"]

SI_SYMBOL: dict[Dimension, str] = {"length": "m", "time": "s", "speed": "m/s", "acceleration": "m/s^2"}

# Exact factors: the international foot and mile are defined in metres.
_FOOT = Fraction(3048, 10000)
_MILE = Fraction(1609344, 1000)
_HOUR = Fraction(3600)
_STANDARD_GRAVITY = Fraction(980665, 100000)


@dataclass(frozen=True, slots=True)
class Unit:
    """One unit: its dimension and how many SI units it is worth, exactly."""

    symbol: str
    dimension: Dimension
    si_factor: Fraction


_BASE = (
    Unit("m", "length", Fraction(1)),
    Unit("cm", "length", Fraction(1, 100)),
    Unit("km", "length", Fraction(1000)),
    Unit("ft", "length", _FOOT),
    Unit("yd", "length", 3 * _FOOT),
    Unit("mi", "length", _MILE),
    Unit("s", "time", Fraction(1)),
    Unit("ms", "time", Fraction(1, 1000)),
    Unit("min", "time", Fraction(60)),
    Unit("m/s", "speed", Fraction(1)),
    Unit("km/h", "speed", Fraction(1000) / _HOUR),
    Unit("mph", "speed", _MILE / _HOUR),
    Unit("ft/s", "speed", _FOOT),
    Unit("m/s^2", "acceleration", Fraction(1)),
    Unit("ft/s^2", "acceleration", _FOOT),
    Unit("g", "acceleration", _STANDARD_GRAVITY),
)
UNITS: dict[str, Unit] = {unit.symbol: unit for unit in _BASE}

# Longest suffix first, so that `_mpss` is not read as `_s`.
_NAME_SUFFIXES: tuple[tuple[str, str], ...] = (
    ("_mpss", "m/s^2"),
    ("_mps2", "m/s^2"),
    ("_kmph", "km/h"),
    ("_kph", "km/h"),
    ("_kmh", "km/h"),
    ("_mph", "mph"),
    ("_mps", "m/s"),
    ("_ft", "ft"),
    ("_m", "m"),
    ("_s", "s"),
)
UNIT_SUFFIXES = "_m, _s, _mps or _mpss (or _ft, _mph, _kmph)"  # as a message tells them

# Of a number as it is written, above and below the line of a fraction, and of its value in SI units. No scenario has
# more, and exact arithmetic stays quick.
DIGITS = 40
LARGEST_EXPONENT = 30
_LARGEST_FLOAT_EXPONENT = 400
LARGEST_SI = Fraction(10**9)
SMALLEST_SI = 1 / LARGEST_SI  # other than zero

# What a parameter may be at all, by dimension (SI). Wide on purpose: a value outside is a typing mistake.
PLAUSIBLE_RANGE: dict[Dimension, tuple[Fraction, Fraction]] = {
    "length": (Fraction(0), Fraction(1000)),
    "time": (Fraction(0), Fraction(120)),
    "speed": (Fraction(0), Fraction(60)),
    "acceleration": (Fraction(-12), Fraction(12)),
}


def unit_of_name(name: str) -> Unit | None:
    """Return the unit that a snake-case parameter name ends in, or None.

    >>> unit_of_name("hero_deceleration_mpss").symbol
    'm/s^2'
    """
    for suffix, symbol in _NAME_SUFFIXES:
        if name.endswith(suffix):
            return UNITS[symbol]
    return None


def decimal_fraction(value: float | int | str | Fraction) -> Fraction:
    """Return the rational that the shortest decimal form of `value` stands for.

    Raises
    ------
    ValueError
        For what is no decimal number, or one of more digits than any quantity has, or beyond every float: its exact
        value could fill the memory.

    Examples
    --------
    >>> decimal_fraction(0.1)
    Fraction(1, 10)
    """
    if isinstance(value, Fraction):
        return value
    mantissa, _, exponent = str(value).strip().lower().partition("e")
    if len(mantissa) > DIGITS + 2 or len(exponent) > 5 or abs(int(exponent or 0)) > _LARGEST_FLOAT_EXPONENT:
        raise ValueError(f"a number of at most {DIGITS} digits")
    return Fraction(str(value))


def is_size_of_a_scenario(value: Fraction) -> bool:
    """Whether a number (SI) is neither so large, so small nor so long that no scenario has it."""
    is_short = max(abs(value.numerator), value.denominator) < 10**DIGITS
    return is_short and (not value or SMALLEST_SI <= abs(value) <= LARGEST_SI)


def size_of_a_scenario() -> str:
    """Return what `is_size_of_a_scenario` asks for, in words."""
    sizes = f"{float(SMALLEST_SI):g} to {float(LARGEST_SI):g}"
    return f"0, or a size from {sizes} in SI units, in at most {DIGITS} digits"


def format_fraction(value: Fraction) -> str:
    """Return `value` as a decimal where it has a short one, else as ``p/q``; `Fraction` reads both back exactly."""
    denominator = value.denominator
    twos = fives = 0
    while denominator % 2 == 0:
        denominator //= 2
        twos += 1
    while denominator % 5 == 0:
        denominator //= 5
        fives += 1
    if denominator != 1:
        return f"{value.numerator}/{value.denominator}"
    digits = max(twos, fives)
    if digits > DIGITS:
        return f"{value.numerator}/{value.denominator}"
    if digits == 0:
        return str(value.numerator)
    scaled = abs(value.numerator) * 10**digits // value.denominator
    text = str(scaled).rjust(digits + 1, "0")
    return f"{'-' if value < 0 else ''}{text[:-digits]}.{text[-digits:]}"


def in_tenths(value: float) -> str:
    """Return a size to a tenth, and to its first digit where it is less: a hair's breadth is not to read as a touch.

    >>> in_tenths(2.345), in_tenths(0.0437), in_tenths(0.0)
    ('2.3', '0.04', '0.0')
    """
    return f"{value:.1g}" if 0.0 < abs(value) < 0.1 else f"{value:.1f}"


_PINNED_DECIMALS = 4


def pin(value: float | Fraction) -> Fraction:
    """Round a measured number to the rational that a solver is given (0.1 mm, 0.1 mm/s): the one place of rounding."""
    if isinstance(value, Fraction):
        return value
    return Fraction(round(float(value) * 10**_PINNED_DECIMALS), 10**_PINNED_DECIMALS)
