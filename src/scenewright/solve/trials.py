"""What a planner tries, in order: from natural motion that meets the trigger exactly to anything that comes near it.

What enters: nothing. What leaves: `Trial`s. It tries none of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.program.manner import Manner
from scenewright.solve.limits import (
    CLOSE,
    CLOSE_QUICK,
    COASTING,
    COUNTER,
    COUNTER_QUICK,
    FIRM,
    FIRM_QUICK,
    GENTLE,
    GENTLE_QUICK,
    HASTE,
    STEADY,
    URGENT,
    WHOLE,
    WHOLE_QUICK,
    Style,
)


@dataclass(frozen=True, slots=True)
class Trial:
    """One way to try: how to move, and how far off the trigger may be (in tight tolerances)."""

    style: Style
    tolerance: Fraction = Fraction(0)


COAST = (Trial(COASTING), Trial(COASTING, Fraction(1, 2)))
# Where the ego may make haste: to its place and wait there, or at least never far from it.
_READY = Trial(replace(COUNTER, ready=True))
_READY_QUICK = Trial(replace(COUNTER_QUICK, outcome_margin_s=0.3, ready=True))
EXACT = tuple(Trial(style) for style in (GENTLE, FIRM, WHOLE, COUNTER, CLOSE))
# Where the prediction denies the outcome, the hero does the most it can for it: the ego may still give way.
_QUICK = tuple(Trial(style) for style in (GENTLE_QUICK, FIRM_QUICK, WHOLE_QUICK, COUNTER_QUICK, CLOSE_QUICK))
# Before a gentler way that the prediction promises no more than just: the same haste, as much of it as there is.
_JUST_QUICK = tuple(Trial(replace(trial.style, outcome_margin_s=0.3)) for trial in _QUICK)
_IN_HASTE = tuple(Trial(replace(HASTE, outcome_margin_s=margin_s, clear=False)) for margin_s in (0.7, 0.5, 0.3))
_FOR_OUTCOME = tuple(
    Trial(replace(HASTE, outcome_margin_s=-late_s, clear=False))
    for late_s in (-0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0)
)
_WITHOUT_OUTCOME = (
    *(Trial(replace(style, outcome=False, acc_mpss=(2.5, 4.0))) for style in (FIRM_QUICK, COUNTER_QUICK)),
    *(Trial(replace(style, outcome=False)) for style in (FIRM, COUNTER)),
)
# How far beyond the least miss that arithmetic gives the solver is asked: as ``factor * miss + rest``.
_BEYOND = ((1.05, 0.03), (1.3, 0.15), (2.0, 0.6))
_FREE = replace(CLOSE, outcome=False)
_UNSETTLED = replace(URGENT, outcome=False)
_WORST, _STILL_GOOD = 100.0, 0.45
_OFF = (
    *(Trial(_FREE, Fraction(tolerance)) for tolerance in ("0.9", "2", "4")),
    *(Trial(_UNSETTLED, Fraction(tolerance)) for tolerance in ("0", "0.9", "2", "4", "16")),
)


def trials(outcome: bool) -> tuple[Trial, ...]:
    """Return what to try at the start and for what meets the trigger exactly; with an outcome that first."""
    return (*_QUICK, *_JUST_QUICK, *_IN_HASTE, *EXACT, *_FOR_OUTCOME, *_WITHOUT_OUTCOME) if outcome else EXACT


def hasty(outcome: bool) -> tuple[Trial, ...]:
    """Return what to try first where the ego may make haste.

    Who is to be first waits where it can still be fast at its trigger, and so loses no time after it.
    """
    return (_READY_QUICK, _READY) if outcome else (_READY,)


def relaxed(held: Style, least: Callable[[Style], float]) -> tuple[Trial, ...]:
    """Return what to try where nothing meets the trigger exactly, the nearest first.

    A hero that is settled but a little off is worth more than one that is exact and begins early.

    Parameters
    ----------
    held
        The style of the plan that is held: what follows the trigger stays as it is there, where that is possible.
    least
        Returns the least miss (tight tolerances) that a style can have.
    """
    quick = replace(CLOSE_QUICK, outcome=held.outcome, outcome_margin_s=held.outcome_margin_s, clear=held.clear)
    free = replace(_FREE, acc_mpss=held.acc_mpss)
    ways = (quick, free) if held.outcome else (free,)
    miss = least(_FREE)
    nearest = [_trial(way, factor * miss + rest) for factor, rest in _BEYOND for way in ways]
    if miss < _STILL_GOOD:
        nearest.append(_trial(_FREE, _STILL_GOOD))  # settled and a little off beats exact and begun too early
    unsettled = [_trial(_UNSETTLED, factor * least(_UNSETTLED) + rest) for factor, rest in _BEYOND[:2]]
    return (*nearest, *unsettled, _trial(_UNSETTLED, _WORST))


def off() -> tuple[Trial, ...]:
    """Return what to try where nothing meets the trigger exactly and nobody can tell how near it gets."""
    return _OFF


def _trial(style: Style, tolerance: float) -> Trial:
    return Trial(style, Fraction(round(min(tolerance, _WORST), 2)).limit_denominator(100))


def kept_to(manner: Manner, trials: Iterable[Trial]) -> tuple[Trial, ...]:
    """Return the same trials for a program of that manner."""
    return tuple(replace(trial, style=trial.style.kept_to(manner)) for trial in trials)


def opening(trials: tuple[Trial, ...], by_mps: Iterable[float]) -> tuple[Trial, ...]:
    """Return the same trials for one that the ego follows, drawing away from it at its trigger, the fastest first."""
    return tuple(replace(trial, style=replace(trial.style, opening_mps=mps)) for mps in by_mps for trial in trials)


def first_trials(outcome: bool) -> tuple[Trial, ...]:
    """Return what only a first plan may try: one steady speed all the way to the trigger."""
    steady = replace(STEADY, dec_mpss=(1.8, 3.0), stop_s=(0.5, 0.8)) if outcome else STEADY
    brisk = replace(steady, dec_mpss=FIRM.dec_mpss, acc_mpss=FIRM.acc_mpss, natural_speed=False)
    return Trial(steady), Trial(brisk)
