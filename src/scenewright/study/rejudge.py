"""Judges every kept run of a result folder again, from its files alone, and compares with what was recorded.

What enters: a result folder. What leaves: for each kept run what differs, nothing where all is the same. No file is
changed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from scenewright.errors import ScenewrightError
from scenewright.study.cases import judge_again
from scenewright.study.store import CaseRecord, Results
from scenewright.study.workers import Crash, each_done


@dataclass(frozen=True, slots=True)
class Kept:
    """A kept run and what its record says of it."""

    case: str
    row: int
    directory: Path
    levels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Rejudged:
    """What judging a run again gave: at which levels it holds, and in what it differs from the record."""

    case: str
    success: bool
    differences: tuple[str, ...]


def kept_runs(results: Results) -> list[Kept]:
    """Return the runs whose files were kept."""
    return [
        Kept(record.case, record.row, results.directory / record.directory, tuple(record.kept))
        for record in results.records()
        if record.directory is not None
    ]


def successes_without_files(results: Results) -> list[CaseRecord]:
    """Return successes that cannot be judged again, because their runs were not kept."""
    return [record for record in results.records() if record.best_tight and record.directory is None]


def rejudge(kept: list[Kept], workers: int) -> Iterator[Rejudged]:
    """Judge kept runs again, each yielded as it is done."""
    for run, outcome in each_done(rejudge_one, kept, workers):
        if isinstance(outcome, Crash):
            yield Rejudged(run.case, "tight" in run.levels, (outcome.message,))
        else:
            yield outcome


def rejudge_one(kept: Kept) -> Rejudged:
    """Judge one kept run again, and hold its row's criteria against it again."""
    from scenewright.judge.files import VERDICT_FILE, read_case
    from scenewright.judge.judgement import judge
    from scenewright.study.benchmark import benchmark_row

    try:
        case = read_case(kept.directory)
        verdict = judge(case)
        stored = json.loads((kept.directory / VERDICT_FILE).read_text(encoding="utf-8"))
        levels = judge_again(benchmark_row(kept.row), case, verdict)
    except ScenewrightError as error:
        return Rejudged(kept.case, "tight" in kept.levels, (error.message,))
    except (OSError, ValueError) as error:
        return Rejudged(kept.case, "tight" in kept.levels, (f"{VERDICT_FILE} cannot be read: {error}",))
    differences = []
    if levels != kept.levels:
        differences.append(f"holds at {_named(levels)} now, at {_named(kept.levels)} as recorded")
    again = json.loads(json.dumps(verdict.as_dict()))
    for name in ("success", "conditions"):
        if again[name] != stored.get(name):
            differences.append(f"{VERDICT_FILE} says otherwise under {name}")
    return Rejudged(kept.case, "tight" in kept.levels, tuple(differences))


def _named(levels: tuple[str, ...]) -> str:
    return ", ".join(levels) or "no tolerance"
