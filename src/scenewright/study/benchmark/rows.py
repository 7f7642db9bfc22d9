"""The 80 rows: facts of the paper's taxonomy, and for each a gold program and descriptions in words of our own.

What enters: the files beside this one. What leaves: `BenchmarkRow` objects. It draws no parameters and judges nothing.
"""

from __future__ import annotations

import csv
import re
import tomllib
from collections.abc import Mapping
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
    descriptions
        At least three, whose meaning is the gold program.
    standing_for
        For each description what it says in the place of a parameter of the gold program: a quantity (``"40 ft"``), or
        the name of the same parameter in another unit. What is not in it goes by the gold program's name.
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
    descriptions: tuple[str, ...]
    standing_for: tuple[Mapping[str, str], ...] = ()
    note: str = ""

    @property
    def program(self) -> Program:
        """The gold program."""
        return _program(self.id, self.program_text)

    def program_text_of(self, description: int) -> str:
        """Return the gold program of one description: with its quantities, and under its own names of parameters."""
        text = self.program_text
        for name, stands in self.standing_for[description].items():
            if stands[0].isdigit():
                text = text.replace(f"- {name}\n", "", 1)
            text = re.sub(rf"\b{name}\b", stands, text)
        return text.replace("parameters:\n\n", "")


@cache
def benchmark_rows() -> tuple[BenchmarkRow, ...]:
    """Return all rows, by id."""
    data = _data()
    notes = tomllib.loads((data / "notes.toml").read_text(encoding="utf-8"))
    texts = _descriptions(data)
    with (data / "taxonomy.csv").open(encoding="utf-8") as table:
        return tuple(
            BenchmarkRow(
                id=(number := int(facts.pop("id"))),
                **facts,
                program_text=(data / "programs" / f"{number:02d}.scene").read_text(encoding="utf-8"),
                descriptions=tuple(text for text, _ in texts[number]),
                standing_for=tuple(stands for _, stands in texts[number]),
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


def _descriptions(data: Traversable) -> dict[int, list[tuple[str, Mapping[str, str]]]]:
    found: dict[int, list[tuple[str, Mapping[str, str]]]] = {}
    for file in sorted((data / "descriptions").iterdir(), key=lambda each: each.name):
        if file.name.endswith(".toml"):
            for entry in tomllib.loads(file.read_text(encoding="utf-8"))["description"]:
                told = (" ".join(entry["text"].split()), entry.get("with", {}))
                found.setdefault(entry["row"], []).append(told)
    return found


@cache
def _program(number: int, text: str) -> Program:
    return parse_program(text, f"benchmark row {number}")
