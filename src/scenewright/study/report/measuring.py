"""Measurements that the report makes itself: done once, kept beside the results, gone on with after a kill.

What enters: jobs as plain data, and the function that does one. What leaves: one plain record a job, from the cache
where the same code has done the same job before. What a job measures is told in other modules.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import scenewright
from scenewright.errors import OutputError, Place
from scenewright.study.lines import LineLog, read_lines
from scenewright.study.workers import Crash, each_done

FOLDER = "extras"
Job = Mapping[str, Any]
Measured = dict[str, Any]
# Called with the name of a stage, how much of it is done, and how much there is.
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True)
class Bench:
    """Where measurements are kept and how they are run.

    Attributes
    ----------
    folder
        The folder of the results; measurements lie in its folder `extras`.
    workers
        Processes; 0 does everything in this one.
    """

    folder: Path
    workers: int = 0
    progress: Progress | None = None

    def measure(self, name: str, work: Callable[[Job], Measured], jobs: Sequence[Job]) -> list[Measured]:
        """Return the record of each job, in order; what is in the cache is not done again.

        A job that raises leaves a record whose ``error`` says what; it is done again next time.
        """
        path = self.folder / FOLDER / f"{name}.jsonl"
        kept = _kept(path)
        found = {key: kept[key] for key in map(_key, jobs) if key in kept}
        left = [job for job in jobs if _key(job) not in found]
        log = _opened(path)
        try:
            self._tell(name, len(found), len(jobs))
            # Started processes cost seconds; a handful of jobs is done sooner without.
            workers = 0 if len(left) < 2 * self.workers else self.workers
            for job, record in each_done(work, left, workers):
                if isinstance(record, Crash):
                    found[_key(job)] = {**job, "error": record.message}
                else:
                    found[_key(job)] = {**job, **record}
                    log.append({"code": code_digest(), "key": _key(job), "record": found[_key(job)]})
                self._tell(name, len(found), len(jobs))
        finally:
            log.close()
        return [found[_key(job)] for job in jobs]

    def _tell(self, name: str, done: int, total: int) -> None:
        if self.progress is not None:
            self.progress(name, done, total)


def _key(job: Job) -> str:
    return json.dumps(job, sort_keys=True, ensure_ascii=False)


def _kept(path: Path) -> dict[str, Measured]:
    """Return what this code has measured before, by key; what other code has measured counts no more."""
    records: dict[str, Measured] = {}
    for line in read_lines(path):
        with suppress(ValueError, KeyError, TypeError):  # measured again
            entry = json.loads(line)
            if entry["code"] == code_digest():
                records[entry["key"]] = entry["record"]
    return records


def _opened(path: Path) -> LineLog:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        return LineLog(path)
    except OSError as error:
        found = error.strerror or str(error)
        raise OutputError("measurements cannot be kept", place=Place(str(path)), found=found) from None


@cache
def code_digest() -> str:
    """Return a digest of all code and data of this package."""
    digest, package = hashlib.sha256(), Path(scenewright.__file__).parent
    for path in sorted(package.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            digest.update(path.relative_to(package).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]
