"""Runs descriptions against egos with drawn parameters, and says under which cause each of them falls.

What enters: descriptions, egos, a number of draws, a seed. What leaves: one `Outcome` a case, for `summary` to count.
Every case is a whole run through `orchestrate`, judged as a user's run is; nothing is left out.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from scenewright.drive.loading import load_policy
from scenewright.errors import InputError, Place, ScenewrightError
from scenewright.orchestrate import orchestrate
from scenewright.request import Request, Result
from scenewright.study.causes import cause_of
from scenewright.study.draws import draw_parameters
from scenewright.study.workers import Crash, each_done
from scenewright.translate.sources import read_scenario
from scenewright.translate.understand import OFFLINE


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
    takes: int = 3

    def command(self) -> str:
        """Return the command that runs this case again."""
        words = ["scenewright", "run", self.description.text]
        for name, value in self.parameters.items():
            words += ["-p", f"{name}={value}"]
        words += ["--ego", self.ego, "--seed", str(self.seed), "--translator", OFFLINE]
        words += [] if self.takes == 3 else ["--takes", str(self.takes)]
        return shlex.join(words)


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a case; tallies count it as they count records of the benchmark."""

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

    @property
    def first_cause(self) -> str:
        """The cause: of several takes the one that was kept counts."""
        return self.cause

    @property
    def criteria_disagree(self) -> bool:
        """No: but for the judge there is nobody to disagree."""
        return False

    def holds(self, which: str, level: str) -> bool:
        """Whether it is a success; whether it is one at other levels than the tight one is not kept."""
        return level == "tight" and self.cause == "success"


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
        raise InputError("there are no descriptions here", place=Place(str(path)), expected="at least one")
    ids = [description.id for description in found]
    if twice := next((each for each in ids if ids.count(each) > 1), None):
        raise InputError("two descriptions have one id", place=Place(str(path)), found=twice, fix="give each its own")
    return found


def _described_in(file: Path) -> Description:
    try:
        return Description(file.stem, file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError("the file cannot be read as text", place=Place(str(file)), found=str(error)) from None


def make_cases(
    descriptions: Sequence[Description], egos: Sequence[str], draws: int, seed: int, takes: int = 3
) -> list[Case]:
    """Return every combination; a draw is the same for all egos. What does not exist is refused."""
    for ego in egos:
        load_policy(ego)
    cases = []
    for number, description in enumerate(descriptions):
        try:
            program, _ = read_scenario(description.text, OFFLINE)
        except ScenewrightError as error:
            error.place = error.place and replace(error.place, name=description.id)
            raise
        for draw in range(draws):
            parameters = draw_parameters(program.parameters, (seed, number, draw))
            cases += [Case(description, ego, draw, seed + draw, parameters, takes) for ego in egos]
    return cases


def run_cases(cases: Sequence[Case], workers: int) -> Iterator[Outcome]:
    """Run the cases on `workers` processes (0: in this one), and yield their outcomes as each is done."""
    for case, result in each_done(run_case, cases, workers):
        yield _outcome(case, "error", message=result.message) if isinstance(result, Crash) else result


def run_case(case: Case) -> Outcome:
    """Run one case and say what came of it."""
    request = Request(
        case.description.text, case.parameters, ego=case.ego, seed=case.seed, takes=case.takes, translator=OFFLINE
    )
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
    run = result.run if result is not None else None
    return Outcome(
        case.description.id,
        case.ego,
        case.draw,
        cause,
        failed,
        tuple(record.wall_s for record in run.replans if record.backend) if run is not None else (),
        run.trace.duration_s if run is not None else 0.0,
        case.command(),
        message,
        case.parameters,
        result.take if result is not None else 1,
    )


def in_order(outcomes: Iterable[Outcome], cases: Sequence[Case]) -> list[Outcome]:
    """Return outcomes in the order of their cases."""
    places = {(case.description.id, case.ego, case.draw): place for place, case in enumerate(cases)}
    return sorted(outcomes, key=lambda each: places[each.description, each.ego, each.draw])


def write_outcomes(outcomes: Sequence[Outcome], path: Path) -> None:
    """Write outcomes as JSON lines."""
    lines = [json.dumps(asdict(outcome), ensure_ascii=False) for outcome in outcomes]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
