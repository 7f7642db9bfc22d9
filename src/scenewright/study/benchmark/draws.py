"""Draws parameters for a row of the benchmark: seeded, repeatable, from ranges that a table in a file gives.

What enters: a row, the number of the draw, a seed. What leaves: a value for each parameter of the row's program, in the
unit of its name. Nothing is rejected: a draw that cannot happen is for the solver to prove.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np

from scenewright.study.benchmark.rows import BenchmarkRow


@dataclass(frozen=True, slots=True)
class Range:
    """What one parameter is drawn from, in the unit of its name; empty `rows` and `interaction` fit every row."""

    parameter: str
    low: float
    high: float
    beyond: tuple[str, ...] = ()
    interaction: str = ""
    rows: tuple[int, ...] = ()

    def fits(self, row: BenchmarkRow, parameter: str) -> bool:
        """Whether this is a range for a parameter of a row."""
        return (
            parameter == self.parameter
            and self.interaction in ("", row.interaction)
            and (not self.rows or row.id in self.rows)
        )


@cache
def ranges() -> tuple[Range, ...]:
    """Return all ranges, in the order in which they are tried."""
    text = (files("scenewright.study.benchmark") / "data" / "ranges.toml").read_text(encoding="utf-8")
    return tuple(
        Range(
            parameter=entry["parameter"],
            low=float(entry["low"]),
            high=float(entry["high"]),
            beyond=tuple(entry.get("beyond", ())),
            interaction=entry.get("interaction", ""),
            rows=tuple(entry.get("rows", ())),
        )
        for entry in tomllib.loads(text)["range"]
    )


def range_of(row: BenchmarkRow, parameter: str) -> Range:
    """Return what a parameter of a row is drawn from.

    Raises
    ------
    KeyError
        If the table has no range for it.
    """
    for entry in ranges():
        if entry.fits(row, parameter):
            return entry
    raise KeyError(f"row {row.id} has no range for {parameter}")


def draw_row(row: BenchmarkRow, draw: int, seed: int) -> dict[str, float]:
    """Return a value for each parameter of a row, in the unit of its name, rounded to two decimals.

    The same row, draw and seed give the same values, for every ego and every method.

    Examples
    --------
    >>> from scenewright.study.benchmark import benchmark_row
    >>> row = benchmark_row(16)
    >>> draw_row(row, 0, 7) == draw_row(row, 0, 7)
    True
    """
    generator = np.random.default_rng([seed, row.id, draw])
    names = [parameter.name for parameter in row.program.parameters]
    shares = dict(zip(names, generator.uniform(size=len(names)).tolist(), strict=True))
    values: dict[str, float] = {}

    def value(name: str) -> float:
        if name not in values:
            drawn = range_of(row, name)
            own = drawn.low + shares[name] * (drawn.high - drawn.low)
            values[name] = round(own + sum(value(other) for other in drawn.beyond), 2)
        return values[name]

    return {name: value(name) for name in names}
