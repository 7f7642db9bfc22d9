"""The benchmark of 80: facts of the paper's taxonomy, gold programs, descriptions, seeded draws, success criteria."""

from scenewright.study.benchmark.criteria import Criterion, criteria_hold, criteria_of
from scenewright.study.benchmark.draws import draw_row
from scenewright.study.benchmark.rows import BenchmarkRow, benchmark_row, benchmark_rows

__all__ = [
    "BenchmarkRow",
    "Criterion",
    "benchmark_row",
    "benchmark_rows",
    "criteria_hold",
    "criteria_of",
    "draw_row",
]
