"""The 80 rows: facts of the paper's taxonomy, and for each a gold program and a description in words of our own.

What enters: the files beside this one. What leaves: `BenchmarkRow` objects. It draws no parameters and judges nothing.
"""

from __future__ import annotations

import csv
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

from scenewright.program.text import parse_program
from scenewright.program.types import Program


@dataclass(frozen=True, slots=True)
class BenchmarkRow:
    """One row.

    Attributes
    ----------
    ego_state, ego_intent, hero_state, hero_intent, interaction, trigger
        What the taxonomy says, in its own words, such as ``"Westbound"``, ``"Lane follow"``, ``"Hero yields"``,
        ``"Distance"``.
    program_text
        The gold program, as the text of a `.scene` file.
    description
        The same in words, under the same names of parameters.
    note
        Where the taxonomy and a known text of the row disagree, or where the program needed a decision.
    """

    id: int
    ego_state: str
    ego_intent: str
    hero_state: str
    hero_intent: str
    interaction: str
    trigger: str
    program_text: str
    description: str
    note: str = ""

    @property
    def program(self) -> Program:
        """The gold program."""
        return _program(self.id, self.program_text)


@cache
def benchmark_rows() -> tuple[BenchmarkRow, ...]:
    """Return all rows, by id."""
    data = _data()
    notes = tomllib.loads((data / "notes.toml").read_text(encoding="utf-8"))
    texts = tomllib.loads((data / "descriptions.toml").read_text(encoding="utf-8"))
    with (data / "taxonomy.csv").open(encoding="utf-8") as table:
        return tuple(
            BenchmarkRow(
                id=(number := int(facts.pop("id"))),
                **facts,
                program_text=(data / "programs" / f"{number:02d}.scene").read_text(encoding="utf-8"),
                description=" ".join(texts[str(number)]["text"].split()),
                note=notes.get(str(number), ""),
            )
            for facts in csv.DictReader(table)
        )


def benchmark_row(id: int) -> BenchmarkRow:
    """Return one row; raises KeyError where there is none of this id."""
    for row in benchmark_rows():
        if row.id == id:
            return row
    raise KeyError(id)


def _data() -> Traversable:
    return files("scenewright.study.benchmark") / "data"


@cache
def _program(number: int, text: str) -> Program:
    return parse_program(text, f"benchmark row {number}")
