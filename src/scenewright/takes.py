"""Takes: a simulation can be run again. Which one is good enough, which is best, and how the next one begins.

What enters: what was asked for, and what came of takes. What leaves: choices. Nothing is driven here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from scenewright.explain.approach import approach_of
from scenewright.judge.tolerance import LEVELS, LOOSE
from scenewright.judge.verdict import Condition
from scenewright.request import Request, Result

# A hero that came later than this (s) is helped by an ego that starts at less than this share of its first speed.
_MUCH_TOO_LATE_S, _MUCH_SLOWER = 1.0, 0.5
# The shares of its speed at which a hero comes that two takes have missed, in turn. Measured, in a take that knows the
# first one, of 78 cases that missed: with 0.43 16 are met, with 0.55 and 0.7 20 and 21; the others chosen.
_PACES = (0.6, 0.85, 0.43)


def is_enough(request: Request, result: Result) -> bool:
    """Whether no take could be worth more."""
    return worth(request, result) == (len(_levels(request)), True)


def worth(request: Request, result: Result) -> tuple[int, bool]:
    """Return at how many tolerances from the one aimed at on a take holds, and whether its heroes drove naturally."""
    verdict, run = result.verdict, result.run
    assert verdict is not None
    assert run is not None
    held = sum(verdict.holds_at(LEVELS[level]) for level in _levels(request))
    return held, not approach_of(result.scene, run.trace, verdict.facts).unnatural


def how_next(result: Result, take: int, began_mps: float) -> Iterable[tuple[float, float, bool]]:
    """Return how the next take may begin, in the order in which it is tried.

    Parameters
    ----------
    result
        Of the take before.
    take
        The number of the next one.
    began_mps
        How fast the ego began; infinite where one that begins slower is no help.

    Returns
    -------
    Iterable
        How slow the ego has to start at least (m/s), the share of its speed at which heroes come, and whether values
        that were left open are to be others.
    """
    missed = _missed(result)
    only_outcome = {condition.kind for condition in missed} == {"outcome"}
    pace = _PACES[take % len(_PACES)] if take > 2 and result.status == "failure" and not only_outcome else 1.0
    slower_than_mps = math.inf
    if only_outcome:  # a slower ego leaves more time for it; where it was far from enough, much slower
        late_s = max(condition.error or 0.0 for condition in missed)
        slower_than_mps = began_mps if late_s < _MUCH_TOO_LATE_S else _MUCH_SLOWER * began_mps
    return dict.fromkeys([(slower_than_mps, pace, bool(missed)), (math.inf, 1.0, bool(missed))])


def _levels(request: Request) -> list[str]:
    """Return the tolerances that count, finest first."""
    levels = list(LEVELS)
    return levels[levels.index(request.aim or request.tolerance) :]


def _missed(result: Result) -> list[Condition]:
    """Return the conditions that a take missed even at the loose tolerance."""
    assert result.verdict is not None
    return [condition for condition in result.verdict.conditions if not condition.holds_at(LOOSE)]
