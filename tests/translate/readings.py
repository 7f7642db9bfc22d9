"""What a person reads in a text, and what the reader made of it: shared by the tests of the reader and its tool."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from scenewright.errors import ScenewrightError
from scenewright.program.printer import print_expression
from scenewright.program.types import Program
from scenewright.study.benchmark import benchmark_rows
from scenewright.translate.compile import compile_story
from scenewright.translate.understand import understand

HERE = Path(__file__).resolve().parent / "read"
DEV = Path(__file__).resolve().parents[2].parent / "shared" / "paper" / "descriptions-dev.json"
# Follows from who is said to drive ahead, and from two who act at one moment.
IMPLIED = {"gap(A0, A1, t0) > 0", "A0(t1) == A1(t1)"}
FILLED = {
    "DL": "The ego is on the driveway and wants to turn left. The hero travels west along the road. ",
    "W": "When the ego is 12 m behind the stop line and the hero is 20 m behind the conflict point, ",
}


@dataclass(frozen=True)
class Expected:
    """Routes, the hero's pieces, and every constraint but what is implied."""

    ego: str
    hero: str
    pieces: str
    constraints: frozenset[str]


@dataclass(frozen=True)
class Reading:
    """How a text was answered: taken, asked (with a default or without) or refused; and what was made of it."""

    kind: str
    program: Program | None
    told: tuple[str, ...] = ()  # questions and asides, or the message

    @property
    def meaning(self) -> tuple[object, ...]:
        """Everything that a change of meaning must change."""
        if self.program is None:
            return (self.kind,)
        formulas = frozenset(print_expression(each.formula) for each in self.program.constraints)
        actors = tuple((actor.route, str(actor.sketch)) for actor in self.program.actors)
        return (self.kind, self.program.map_name, actors, formulas, self.told)


def reading_of(text: str) -> Reading:
    try:
        story = understand(text)
        story = getattr(story, "story", story)
        program = compile_story(story, text)
    except ScenewrightError as error:
        kind = "asked" if "leaves something open" in error.message else "refused"
        return Reading(kind, None, tuple(filter(None, (error.message, error.found, error.expected, error.fix))))
    told = tuple(each.text for each in story.questions)
    return Reading("default" if story.questions else "taken", program, told)


def formulas(reading: Reading) -> frozenset[str]:
    """Return the constraints of a text that is read, as tests write them."""
    assert reading.program is not None, reading
    return written(print_expression(each.formula) for each in reading.program.constraints)


def written(formulas: Iterable[str]) -> frozenset[str]:
    """Return constraints in one form, without what is implied."""
    turned = (re.sub(r"^(A\d\(t\d\)) < (A\d\(t\d\))$", r"\2 > \1", each) for each in formulas)
    return frozenset(turned) - IMPLIED


def is_right(reading: Reading, expected: Expected) -> bool:
    """Whether a person reads the same; setting off again may be a `go` or an `acc`."""
    program = reading.program
    if program is None or len(program.actors) != 2:
        return False
    routes = ["".join(getattr(actor.route, "headings", ())) for actor in program.actors]
    pieces = " ".join(program.actors[1].sketch.pieces).replace("acc", "go")
    formulas = (print_expression(constraint.formula) for constraint in program.constraints)
    wanted = (expected.ego, expected.hero, expected.pieces.replace("acc", "go"), written(expected.constraints))
    return (*routes, pieces, written(formulas)) == wanted


def paraphrases() -> list[tuple[str, Expected]]:
    cases = tomllib.loads((HERE / "paraphrases.toml").read_text(encoding="utf-8"))["case"]
    return [(case["text"], Expected(case["ego"], case["hero"], case["pieces"], frozenset(case["constraints"])))
            for case in cases]  # fmt: skip


def to_refuse() -> list[str]:
    texts = tomllib.loads((HERE / "refusals.toml").read_text(encoding="utf-8"))["texts"]
    return [text.format(**FILLED) for text in texts]


def of_the_paper() -> dict[int, str]:
    """Return the paper's texts by row; nothing where they are not beside the clone."""
    found = json.loads(DEV.read_text(encoding="utf-8")) if DEV.is_file() else []
    return {entry["id"]: entry["text"] for entry in found}


def all_texts() -> list[str]:
    """Return every text that somebody wrote."""
    rows = [row.description for row in benchmark_rows()]
    return [*of_the_paper().values(), *rows, *(text for text, _ in paraphrases())]
