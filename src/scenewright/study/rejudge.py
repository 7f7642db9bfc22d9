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
from scenewright.study.cases import judge_kept
from scenewright.study.store import CaseRecord, Results
from scenewright.study.workers import Crash, each_done


@dataclass(frozen=True, slots=True)
class Kept:
    """A run whose files were kept: where they are, and what its record says of it."""

    record: CaseRecord
    directory: Path


def kept_runs(results: Results) -> list[Kept]:
    """Return the runs whose files were kept."""
    return [Kept(each, results.directory / each.directory) for each in results.records if each.directory is not None]


def rejudge(kept: list[Kept], workers: int) -> Iterator[tuple[Kept, tuple[str, ...]]]:
    """Judge kept runs again, each yielded as it is done with what differs from its record."""
    for run, outcome in each_done(differences, kept, workers):
        yield run, (outcome.message,) if isinstance(outcome, Crash) else outcome


def differences(kept: Kept) -> tuple[str, ...]:
    """Judge one kept run again, hold its row's criteria against it, and return what differs from its record."""
    from scenewright.judge.files import VERDICT_FILE

    try:
        judged = judge_kept(kept.record.row, kept.directory)
        stored = json.loads((kept.directory / VERDICT_FILE).read_text(encoding="utf-8"))
    except ScenewrightError as error:
        return (error.message,)
    except (OSError, ValueError) as error:
        return (f"{VERDICT_FILE} cannot be read: {error}",)
    found = []
    if judged.levels != tuple(kept.record.kept):
        found.append(f"holds at {_named(judged.levels)} now, at {_named(kept.record.kept)} as recorded")
    again = json.loads(json.dumps(judged.verdict.as_dict()))
    found += [
        f"{VERDICT_FILE} says otherwise under {name}"
        for name in ("success", "conditions")
        if again[name] != stored.get(name)
    ]
    return tuple(found)


def _named(levels: tuple[str, ...] | list[str]) -> str:
    return ", ".join(levels) or "no tolerance"
