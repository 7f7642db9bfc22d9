"""Times of whole re-plans, as they occurred in the experiment.

What enters: times. What leaves: a table of percentiles. Times compare within one machine only.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from scenewright.study.report.tables import Table

PERCENTILES = (50, 90, 99)
TICK_MS = 100.0  # between two re-plans
_COLUMNS = {**{f"p{percent}_ms": f"p{percent} (ms)" for percent in PERCENTILES}, "max_ms": "max (ms)"}


def ticks_table(times_ms: Sequence[float]) -> Table:
    """Return percentiles of whole re-plans as they occurred in the experiment."""
    late = sum(ms > TICK_MS for ms in times_ms)
    columns = {"ticks": "ticks", **_COLUMNS, "late": f"over {TICK_MS:g} ms"}
    title = "Time of one re-plan in the experiment, everything counted, ours"
    return Table("tick_times", title, columns, ((len(times_ms), *_percentiles(times_ms), late),))


def _percentiles(times: Sequence[float]) -> tuple[Any, ...]:
    if not times:
        return tuple(None for _ in range(len(PERCENTILES) + 1))
    values = np.asarray(times, dtype=np.float64)
    return (*(float(np.percentile(values, percent)) for percent in PERCENTILES), float(values.max()))
