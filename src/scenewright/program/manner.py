"""The manner of a program: the numbers that say what "begins visibly", "is settled", "stands", "clear of" mean.

What enters: nothing, or numbers of a program's own. What leaves: a `Manner`, which the judge reads and planners keep
to, with some room. It knows no motion: how a trace is measured is the judge's matter. The table in `docs/program.md`
is this one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from difflib import get_close_matches
from fractions import Fraction
from typing import NamedTuple

from scenewright.errors import Place, ProgramError
from scenewright.units import Unit, format_fraction, unit_of_name


@dataclass(frozen=True, slots=True)
class Manner:
    """What the words mean that a sketch speaks in, as exact numbers in SI units; `NUMBERS` says what each is.

    Examples
    --------
    >>> Manner(stands_s=Fraction(1)).settled_s
    Fraction(1, 2)
    """

    # As hard as a settled driver may still correct: what is weaker could not be told from that.
    begins_mpss: Fraction = Fraction(1, 2)
    # Three times the tight tolerance of a time: a shorter twitch tells nothing of what the driver is about to do.
    begins_s: Fraction = Fraction(3, 10)
    # Less than half the tight tolerance of an acceleration: a car does as much when nobody acts.
    faint_mpss: Fraction = Fraction(1, 10)
    # Twice the tight tolerance of an acceleration: who holds a speed corrects it by about as much.
    settled_mpss: Fraction = Fraction(1, 2)
    # Five times the tight tolerance of a time: long enough for a beginning to be seen against it.
    settled_s: Fraction = Fraction(1, 2)
    # Less than half the tight tolerance of a speed: slower than anything that rolls on.
    stands_mps: Fraction = Fraction(1, 10)
    # Three times the tight tolerance of a time: who touches zero in passing has not come to a standstill.
    stands_s: Fraction = Fraction(3, 10)
    # Three times the tight tolerance of a time: no car changes its acceleration at once.
    ramp_s: Fraction = Fraction(3, 10)
    # Who does not touch is clear.
    clear_m: Fraction = Fraction(0)

    def stricter(self, share: Fraction) -> Manner:
        """Return the manner with each number a `share` of it on the safe side: who keeps to that keeps to this."""
        return replace(self, **{name: getattr(self, name) * (1 + of.stricter * share) for name, of in NUMBERS.items()})

    def check(self, place: Place | None = None) -> None:
        """Raise `ProgramError` where a number is none that its words could mean."""
        for name in NUMBERS:
            _check_number(name, getattr(self, name), place)


USUAL = Manner()


class _Number(NamedTuple):
    """What a number of the manner says, between which values (SI), and on which side of it one is safe."""

    meaning: str
    low: Fraction
    high: Fraction
    stricter: int


def _at_least(meaning: str, low: str, high: str) -> _Number:
    return _Number(meaning, Fraction(low), Fraction(high), 1)


def _at_most(meaning: str, low: str, high: str) -> _Number:
    return _Number(meaning, Fraction(low), Fraction(high), -1)


NUMBERS = {
    "begins_mpss": _at_least(
        "begins to brake or speed up: by more than this, or than half of what it comes to where that is less",
        "0.2",
        "3",
    ),
    "begins_s": _at_least("and goes on for so long, or until it stands: a shorter one is passed over", "0.1", "2"),
    "faint_mpss": _at_most("what is weaker is no braking and no speeding up at all", "0.01", "0.2"),
    "settled_mpss": _at_most("is settled: does by no more than this what it is about to begin", "0.1", "3"),
    "settled_s": _at_least("for so long before it begins", "0.1", "5"),
    "stands_mps": _at_most("stands: is slower than this; moves off: is faster", "0.02", "0.5"),
    "stands_s": _at_least("and stays so for so long, or to the end of the run", "0.1", "60"),
    "ramp_s": _at_most("has a rate throughout: but for so long where it begins and where it ends", "0.1", "2"),
    "clear_m": _at_least("is clear of another: is more than this from it, from body to body", "0", "5"),
}


def manner_of(numbers: Iterable[tuple[str, Fraction, Place | None]]) -> Manner:
    """Return the manner in which the numbers given (SI) stand for the usual ones; the places are for messages.

    Raises
    ------
    ProgramError
        For a name that a manner does not have, a number out of its range, or one that is given twice.
    """
    values: dict[str, Fraction] = {}
    for name, value, place in numbers:
        _check_number(name, value, place)
        if name in values:
            raise ProgramError(f"{name} of the manner is given twice", place=place, found=name, fix="remove one")
        values[name] = value
    return Manner(**values)


def unit_of(name: str, place: Place | None = None) -> Unit:
    """Return the unit of a number of the manner; raises `ProgramError` where there is no such number."""
    unit = unit_of_name(name)
    if name not in NUMBERS or unit is None:
        near = get_close_matches(name, NUMBERS, n=1)
        raise ProgramError(
            f"a manner has no number {name}",
            place=place,
            found=name,
            expected=", ".join(NUMBERS),
            fix=f"did you mean {near[0]}?" if near else None,
        )
    return unit


def _check_number(name: str, value: Fraction, place: Place | None) -> None:
    unit = unit_of(name, place)
    low, high = NUMBERS[name].low, NUMBERS[name].high
    if not low <= value <= high:
        raise ProgramError(
            f"{name} of the manner is out of range",
            place=place,
            found=f"{format_fraction(value)} {unit.symbol}",
            expected=f"{format_fraction(low)} to {format_fraction(high)} {unit.symbol}",
            fix=f"leave it out for the usual {format_fraction(getattr(USUAL, name))} {unit.symbol}",
        )
