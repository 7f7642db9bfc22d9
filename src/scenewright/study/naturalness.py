"""How natural the approaches of many runs are.

What enters: what `explain.approach` tells of each run, or a record that keeps it. What leaves: shares, percentiles and
a median. Nothing here decides whether a run is a success.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np


class Approached(Protocol):
    """Anything that tells of an approach as `Approach` does."""

    @property
    def reverses(self) -> bool: ...  # noqa: D102

    @property
    def stands(self) -> bool: ...  # noqa: D102

    @property
    def jerks_mpsss(self) -> list[float]: ...  # noqa: D102

    @property
    def accels_mpss(self) -> list[float]: ...  # noqa: D102

    @property
    def pace(self) -> float | None: ...  # noqa: D102


@dataclass(frozen=True, slots=True)
class Naturalness:
    """How natural the approaches of many runs are; None where there is nothing to tell."""

    runs: int
    reversing: float | None
    standing: float | None
    jerk_p95_mpsss: float | None
    accel_p95_mpss: float | None
    pace_median: float | None


def naturalness(approaches: Iterable[Approached]) -> Naturalness:
    """Return shares of runs, 95th percentiles over all moments, and the median pace at the trigger."""
    runs = list(approaches)
    jerks = [jerk for each in runs for jerk in each.jerks_mpsss]
    accels = [accel for each in runs for accel in each.accels_mpss]
    paces = [each.pace for each in runs if each.pace is not None]
    return Naturalness(
        len(runs),
        float(np.mean([each.reverses for each in runs])) if runs else None,
        float(np.mean([each.stands for each in runs])) if runs else None,
        float(np.percentile(jerks, 95)) if jerks else None,
        float(np.percentile(accels, 95)) if accels else None,
        float(np.median(paces)) if paces else None,
    )
