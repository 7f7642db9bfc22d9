"""Measures translators: how often a text is read right, refused, or read wrong without a word.

What enters: texts with what they mean (a program, or that they are to be refused), and a translator. What leaves: one
`Reading` a text. Meanings are compared, not layouts; where two programs are written differently the solver decides.
"""

from __future__ import annotations

import time
import tomllib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

from scenewright.errors import InputError, Place, ProgramError, ScenewrightError
from scenewright.program.text import parse_program
from scenewright.program.types import Program

if TYPE_CHECKING:
    from scenewright.solve.problem import Backend

Outcome = Literal[
    "right", "refused", "silently wrong", "rightly refused", "rightly asked", "wrongly accepted", "unanswered"
]
OUTCOMES: tuple[Outcome, ...] = (
    "right",
    "refused",
    "silently wrong",
    "rightly refused",
    "rightly asked",
    "wrongly accepted",
    "unanswered",
)
# What is as it should be.
GOOD: tuple[Outcome, ...] = ("right", "rightly refused", "rightly asked")
# A text that is to be refused for one of these may as well be asked about: with the answer it is whole.
_DOUBTS = ("ambiguous", "vague amount", "no unit")


class Asking(NamedTuple):
    """A translator's answer: the program, and what it asks because the text leaves it open."""

    program: Program
    questions: tuple[str, ...] = ()


Translate = Callable[[str], Asking]


@dataclass(frozen=True, slots=True)
class GoldText:
    """A text and the right response to it.

    Attributes
    ----------
    program
        The text of a program that means the same; None where the text is to be refused.
    refusal
        Why it is to be refused: ``contradictory``, ``impossible``, ``off-topic``, ``foreign language``, ... With a
        program too, either is right: the text asks for more than every translator has to know.
    group
        What kind of text it is, to count by.
    """

    id: str
    text: str
    program: str | None
    refusal: str | None = None
    group: str = ""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a translator made of one text.

    Attributes
    ----------
    notes
        How the meaning differs, or the words of the refusal.
    """

    text: GoldText
    outcome: Outcome
    notes: tuple[str, ...]
    seconds: float


def shipped_texts() -> list[GoldText]:
    """Return the set that the project ships."""
    folder = files("scenewright.study") / "translation_set"
    found: list[GoldText] = []
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if entry.name.endswith(".toml"):
            found += _parsed(entry.read_text(encoding="utf-8"), entry.name)
    return found


def read_texts(path: Path) -> list[GoldText]:
    """Read gold texts from a TOML file of ``[[text]]`` tables: ``id``, ``text`` and ``program`` or ``refuse``, or both.

    Raises
    ------
    InputError
        Where it cannot be read, or a text lacks something.
    """
    try:
        return _parsed(path.read_text(encoding="utf-8"), str(path))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError("the file cannot be read as text", place=Place(str(path)), found=str(error)) from None


def _parsed(content: str, name: str) -> list[GoldText]:
    expected = "[[text]] tables with id, text, and program or refuse, or both where either is right"
    try:
        rows = tomllib.loads(content)["text"]
        found = [
            GoldText(
                str(row["id"]), str(row["text"]), row.get("program"), row.get("refuse"), str(row.get("group", name))
            )
            for row in rows
        ]
    except (tomllib.TOMLDecodeError, KeyError, TypeError) as error:
        raise InputError("these are no gold texts", place=Place(name), found=str(error), expected=expected) from None
    for text in found:
        if text.program is None and text.refusal is None:
            raise InputError(f"text {text.id} is no gold text", place=Place(name), found="neither", expected=expected)
    return found


def measure(texts: Iterable[GoldText], translate: Translate, backend: Backend | None = None) -> Iterator[Reading]:
    """Translate every text and hold what comes out against its meaning.

    Parameters
    ----------
    translate
        Returns the program that a text stands for with its questions, or raises a `ScenewrightError`.
    """
    for text in texts:
        started = time.perf_counter()
        try:
            answer = translate(text.text)
        except ScenewrightError as error:
            seconds = time.perf_counter() - started
            yield Reading(text, _refused(text, error), (_words(error),), seconds)
            continue
        seconds = time.perf_counter() - started
        if answer.questions and text.refusal in _DOUBTS:
            yield Reading(text, "rightly asked", answer.questions, seconds)
            continue
        yield _compared(text, answer.program, seconds, backend)


def _refused(text: GoldText, error: ScenewrightError) -> Outcome:
    if error.exit_status not in (2, 3):
        return "unanswered"
    return "refused" if text.refusal is None else "rightly refused"


def _words(error: ScenewrightError) -> str:
    return error.message + (f": {error.found}" if error.found else "")


def _compared(text: GoldText, program: Program, seconds: float, backend: Backend | None) -> Reading:
    from scenewright.study.meaning import differences

    if text.program is None:
        denial = _denied_later(program)
        outcome: Outcome = "rightly refused" if denial else "wrongly accepted"
        return Reading(text, outcome, (denial or f"to be refused: {text.refusal}",), seconds)
    try:
        asked = parse_program(text.program, text.id)
    except ProgramError as error:
        raise InputError(f"the gold program of {text.id} does not parse", found=str(error)) from error
    found = differences(asked, program, backend)
    return Reading(text, "silently wrong" if found else "right", tuple(found), seconds)


def _denied_later(program: Program) -> str | None:
    """Return what the map or the solver says against a program: what cannot be is refused there."""
    from scenewright.program.structure import read_structure
    from scenewright.roads.grounding import ground
    from scenewright.roads.load import load_map
    from scenewright.solve.backends.z3_backend import Z3Backend
    from scenewright.solve.feasibility import check_feasibility
    from scenewright.solve.limits import limits_on

    try:
        scene = ground(program, load_map(program.map_name), {})
    except ScenewrightError as error:
        return error.message
    limits = {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}
    answer = check_feasibility(scene, read_structure(program), limits, Z3Backend(), explain=False).answer
    return "proven infeasible" if answer == "infeasible" else None


@dataclass(frozen=True, slots=True)
class Tally:
    """How many texts of one group came out how."""

    group: str
    counts: Counter[str]

    @property
    def total(self) -> int:
        """Number of texts."""
        return sum(self.counts.values())

    def share(self, *outcomes: Outcome) -> float:
        """Return the share of `outcomes` among all texts."""
        return sum(self.counts[outcome] for outcome in outcomes) / self.total if self.total else 0.0


def tally(readings: Sequence[Reading]) -> list[Tally]:
    """Return one tally a group, in order of appearance, and one for all."""
    groups: dict[str, Counter[str]] = {}
    for reading in readings:
        groups.setdefault(reading.text.group, Counter())[reading.outcome] += 1
    every: Counter[str] = Counter(reading.outcome for reading in readings)
    return [*(Tally(name, counts) for name, counts in groups.items()), Tally("all", every)]
