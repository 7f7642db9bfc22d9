"""Runs descriptions against egos with drawn parameters, and counts what came of it: how often, and why not.

What enters: descriptions, egos, a number of draws, a seed. What leaves: one `Outcome` a case and tables over them.
Every case is a whole run through `orchestrate`, judged as a user's run is; nothing is left out.
"""

from __future__ import annotations

import json
import shlex
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

from scenewright.errors import InputError, Place, ScenewrightError
from scenewright.orchestrate import Mode, Request, Result, orchestrate
from scenewright.study.causes import cause_of
from scenewright.study.draws import RANGES, draw_parameters
from scenewright.study.workers import Crash, each_done
from scenewright.translate.sources import read_scenario


@dataclass(frozen=True, slots=True)
class Description:
    """One text to run."""

    id: str
    text: str


@dataclass(frozen=True, slots=True)
class Case:
    """One run: a description, an ego, a draw of parameters."""

    description: Description
    ego: str
    draw: int
    seed: int
    parameters: dict[str, float]
    mode: str = "closed"
    takes: int = 3

    def command(self) -> str:
        """Return the command that runs this case again."""
        words = ["scenewright", "run", self.description.text]
        for name, value in self.parameters.items():
            words += ["-p", f"{name}={value}"]
        words += ["--ego", self.ego, "--seed", str(self.seed)]
        words += [] if self.mode == "closed" else ["--mode", self.mode]
        words += [] if self.takes == 3 else ["--takes", str(self.takes)]
        return shlex.join(words)


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a case."""

    description: str
    ego: str
    draw: int
    cause: str
    failed_conditions: tuple[str, ...]
    solve_seconds: tuple[float, ...]
    simulated_s: float
    command: str
    message: str = ""
    parameters: dict[str, float] = field(default_factory=dict)
    take: int = 1


def read_descriptions(path: Path) -> list[Description]:
    """Read descriptions from a JSON list of ``{"id", "text"}``, a folder of `.txt` files, or one such file.

    Raises
    ------
    InputError
        Where there are none.
    """
    if path.is_dir():
        found = [_described_in(file) for file in sorted(path.glob("*.txt"))]
    elif path.suffix == ".json" and path.is_file():
        try:
            rows = json.loads(path.read_text(encoding="utf-8"))
            found = [Description(str(row["id"]), str(row["text"])) for row in rows]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise InputError(
                "these are no descriptions",
                place=Place(str(path)),
                found=str(error),
                expected='a list of {"id", "text"}',
            ) from None
    elif path.is_file():
        found = [_described_in(path)]
    else:
        raise InputError("there are no descriptions here", place=Place(str(path)), expected="a .json, .txt or a folder")
    if not found:
        raise InputError("there are no descriptions here", place=Place(str(path)), expected="at least one .txt file")
    return found


def _described_in(file: Path) -> Description:
    try:
        return Description(file.stem, file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError("the file cannot be read as text", place=Place(str(file)), found=str(error)) from None


def make_cases(
    descriptions: Sequence[Description],
    egos: Sequence[str],
    draws: int,
    seed: int,
    ranges: str = "everyday",
    mode: str = "closed",
    takes: int = 3,
) -> list[Case]:
    """Return every combination; a draw is the same for all egos."""
    cases = []
    for number, description in enumerate(descriptions):
        program, _ = read_scenario(description.text)
        for draw in range(draws):
            parameters = draw_parameters(program.parameters, (seed, number, draw), RANGES[ranges])
            cases += [Case(description, ego, draw, seed + draw, parameters, mode, takes) for ego in egos]
    return cases


def run_cases(cases: Sequence[Case], workers: int, done: Callable[[Outcome], None] | None = None) -> Iterator[Outcome]:
    """Run the cases and yield their outcomes in order, on `workers` processes (1: in this one)."""
    ended: dict[int, Outcome] = {}
    awaited = 0
    for (number, case), result in each_done(_run_numbered, list(enumerate(cases)), workers if workers > 1 else 0):
        outcome = _outcome(case, "error", message=result.message) if isinstance(result, Crash) else result
        if done is not None:
            done(outcome)
        ended[number] = outcome
        while awaited in ended:
            yield ended.pop(awaited)
            awaited += 1


def _run_numbered(numbered: tuple[int, Case]) -> Outcome:
    return run_case(numbered[1])


def run_case(case: Case) -> Outcome:
    """Run one case and say what came of it."""
    text = case.description.text
    mode: Mode = "open" if case.mode == "open" else "closed"
    request = Request(text, case.parameters, ego=case.ego, seed=case.seed, mode=mode, takes=case.takes)
    try:
        result = orchestrate(request)
    except ScenewrightError as error:
        return _outcome(case, "error", message=error.message)
    if result.run is not None and result.run.fault is not None:
        return _outcome(case, "error", result=result, message=result.run.fault.message)
    failed: tuple[str, ...] = ()
    if result.verdict is not None:
        from scenewright.judge.tolerance import TIGHT

        failed = tuple(condition.id for condition in result.verdict.conditions if not condition.holds_at(TIGHT))
    return _outcome(case, cause_of(result), failed, result)


def _outcome(
    case: Case, cause: str, failed: tuple[str, ...] = (), result: Result | None = None, message: str = ""
) -> Outcome:
    seconds: tuple[float, ...] = ()
    simulated = 0.0
    if result is not None and result.run is not None:
        seconds = tuple(record.wall_s for record in result.run.replans if record.backend)
        simulated = result.run.trace.duration_s
    return Outcome(
        case.description.id,
        case.ego,
        case.draw,
        cause,
        failed,
        seconds,
        simulated,
        case.command(),
        message,
        case.parameters,
        result.take if result is not None else 1,
    )


@dataclass(frozen=True, slots=True)
class Row:
    """One line of a table: how many cases fell under which cause."""

    name: str
    counts: Counter[str]

    @property
    def total(self) -> int:
        """Number of cases."""
        return sum(self.counts.values())

    def rate(self, causes: Sequence[str], without: Sequence[str]) -> float | None:
        """Return the share of `causes` among all cases but those `without`; None where none are left."""
        left = self.total - sum(self.counts[cause] for cause in without)
        return sum(self.counts[cause] for cause in causes) / left if left else None


def tabulate(outcomes: Sequence[Outcome], by: str) -> list[Row]:
    """Return one row a value of the outcome's attribute `by`, and one for all."""
    groups: dict[str, Counter[str]] = {}
    for outcome in outcomes:
        groups.setdefault(getattr(outcome, by), Counter())[outcome.cause] += 1
    rows = [Row(name, counts) for name, counts in groups.items()]
    return [*rows, Row("all", Counter(outcome.cause for outcome in outcomes))]


def write_outcomes(outcomes: Sequence[Outcome], path: Path) -> None:
    """Write outcomes as JSON lines."""
    lines = [json.dumps(asdict(outcome), ensure_ascii=False) for outcome in outcomes]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
