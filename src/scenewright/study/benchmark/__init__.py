"""The benchmark of 80: facts of the paper's taxonomy, gold programs, descriptions, seeded draws, success criteria.

Names are imported on first use, so that importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scenewright.study.benchmark.criteria import Criterion, criteria_hold, criteria_of
    from scenewright.study.benchmark.draws import draw_row
    from scenewright.study.benchmark.rows import BenchmarkRow, benchmark_row, benchmark_rows

_HOME = {
    "BenchmarkRow": "rows",
    "Criterion": "criteria",
    "benchmark_row": "rows",
    "benchmark_rows": "rows",
    "criteria_hold": "criteria",
    "criteria_of": "criteria",
    "draw_row": "draws",
}

__all__ = [
    "BenchmarkRow",
    "Criterion",
    "benchmark_row",
    "benchmark_rows",
    "criteria_hold",
    "criteria_of",
    "draw_row",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
