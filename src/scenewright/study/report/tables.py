"""Tables as data: columns that say what they hold, rows, and the file that they are written to.

What enters: columns and rows. What leaves: CSV. The counting is done elsewhere.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scenewright.study.summary import Rate

Value = str | int | float | Rate | None


@dataclass(frozen=True, slots=True)
class Table:
    """A table of the report.

    Attributes
    ----------
    columns
        For each column the name that programs use, and the heading that people read, with its unit. A rate is written
        as three columns: share, successes, cases.
    empty
        What is said where there are no rows.
    """

    name: str
    title: str
    columns: dict[str, str]
    rows: tuple[tuple[Value, ...], ...]
    empty: str = "None."

    def __post_init__(self) -> None:
        if any(len(row) != len(self.columns) for row in self.rows):
            raise ValueError(f"table {self.name}: every row has a value for every column")

    def column(self, name: str) -> list[Value]:
        """Return the values of a column."""
        index = list(self.columns).index(name)
        return [row[index] for row in self.rows]

    def records(self) -> list[dict[str, Any]]:
        """Return one plain dictionary a row, as it is written to the file."""
        return [_flat(zip(self.columns, row, strict=True)) for row in self.rows]


def _flat(cells: Iterable[tuple[str, Value]]) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in cells:
        if isinstance(value, Rate):
            flat[name] = None if value.value is None else round(value.value, 6)
            flat |= {f"{name}_successes": value.successes, f"{name}_cases": value.total}
        else:
            flat[name] = None if isinstance(value, float) and not math.isfinite(value) else value
    return flat


def write_table(table: Table, folder: Path) -> Path:
    """Write a table as ``NAME.csv``."""
    records, path = table.records(), folder / f"{table.name}.csv"
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(records[0]) if records else list(table.columns), lineterminator="\n")
        writer.writeheader()
        writer.writerows(records)
    return path
