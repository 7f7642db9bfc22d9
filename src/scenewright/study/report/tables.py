"""Tables as data: columns that say what they hold, rows, and the files that they are written to.

What enters: columns and rows. What leaves: CSV and JSON. The counting is done elsewhere.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from scenewright.study.report.counting import Rate

# A rate is written as three columns: share, successes, cases. A command is one that a shell takes as it stands.
Kind = Literal["text", "count", "rate", "number", "command"]
Value = str | int | float | bool | Rate | None


@dataclass(frozen=True, slots=True)
class Column:
    """A column: the name that programs use, the heading that people read (with its unit), and what it holds.

    One that is not `shown` is in the files but not on the page.
    """

    name: str
    heading: str
    kind: Kind = "text"
    digits: int = 2
    shown: bool = True


@dataclass(frozen=True, slots=True)
class Table:
    """A table of the report."""

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Value, ...], ...]

    def __post_init__(self) -> None:
        if any(len(row) != len(self.columns) for row in self.rows):
            raise ValueError(f"table {self.name}: every row has a value for every column")

    def column(self, name: str) -> list[Value]:
        """Return the values of a column; raises KeyError where there is none."""
        for index, column in enumerate(self.columns):
            if column.name == name:
                return [row[index] for row in self.rows]
        raise KeyError(name)

    def records(self) -> list[dict[str, Any]]:
        """Return one plain dictionary a row, as it is written to files."""
        return [_flat(self.columns, row) for row in self.rows]


def _flat(columns: tuple[Column, ...], row: tuple[Value, ...]) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for column, value in zip(columns, row, strict=True):
        if column.kind == "rate":
            rate = value if isinstance(value, Rate) else Rate(0, 0)
            flat[column.name] = None if rate.value is None else round(rate.value, 6)
            flat[f"{column.name}_successes"] = rate.successes
            flat[f"{column.name}_cases"] = rate.total
        else:
            flat[column.name] = None if isinstance(value, float) and not math.isfinite(value) else value
    return flat


def write_table(table: Table, folder: Path, provenance: Mapping[str, Any]) -> tuple[Path, Path]:
    """Write a table as ``NAME.csv`` and ``NAME.json``; the JSON also says where the figures come from.

    Returns
    -------
    tuple[Path, Path]
        The two files.
    """
    rows = table.records()
    names = list(_flat(table.columns, tuple(None for _ in table.columns)))
    csv_path, json_path = folder / f"{table.name}.csv", folder / f"{table.name}.json"
    with csv_path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, names, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    data = {
        "name": table.name,
        "title": table.title,
        "columns": {column.name: column.heading for column in table.columns},
        "provenance": dict(provenance),
        "rows": rows,
    }
    json_path.write_text(json.dumps(data, indent=1, ensure_ascii=False, default=str) + "\n", encoding="utf-8")
    return csv_path, json_path
