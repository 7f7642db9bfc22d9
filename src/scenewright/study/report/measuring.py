"""Measurements that the report makes itself: done once, kept beside the results, gone on with after a kill.

What enters: jobs as plain data, and the function that does one. What leaves: one plain record a job, from the cache
where the same code has done the same job before. What a job measures is told in other modules.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from scenewright.errors import OutputError, Place
from scenewright.study.workers import Crash, each_done

FOLDER = "extras"
Job = Mapping[str, Any]
Measured = dict[str, Any]
# Called with the name of a stage, how much of it is done, and how much there is.
Progress = Callable[[str, int, int], None]
# What these hold changes no measurement, but for the modules of this package that make them.
_OF_NO_EFFECT = ("cli", "studio", "study/report", "study/store.py", "study/compare.py", "study/experiment.py")
_MEASURING = tuple(f"study/report/{name}.py" for name in ("precision", "loops", "times"))


@dataclass(frozen=True, slots=True)
class Bench:
    """Where measurements are kept and how they are run.

    Attributes
    ----------
    folder
        The folder of the results; measurements lie in its folder `extras`.
    workers
        Processes; 0 does everything in this one. Measurements of time never use more than this one.
    """

    folder: Path
    workers: int = 0
    progress: Progress | None = None

    def measure(
        self, name: str, work: Callable[[Job], Measured], jobs: Sequence[Job], *, timed: bool = False
    ) -> list[Measured]:
        """Return the record of each job, in order; what is in the cache is not done again.

        A job that raises leaves a record whose ``error`` says what; it is done again next time.
        """
        kept = _Kept(self.folder / FOLDER / f"{name}.jsonl")
        found = {key: kept.records[key] for key in map(_key, jobs) if key in kept.records}
        left = [job for job in jobs if _key(job) not in found]
        self._tell(name, len(found), len(jobs))
        # Started processes cost seconds; a handful of jobs is done sooner without.
        workers = 0 if timed or len(left) < 2 * self.workers else self.workers
        for job, record in each_done(work, left, workers):
            if isinstance(record, Crash):
                found[_key(job)] = {**job, "error": record.message}
            else:
                found[_key(job)] = {**job, **record}
                kept.append(_key(job), found[_key(job)])
            self._tell(name, len(found), len(jobs))
        return [found[_key(job)] for job in jobs]

    def _tell(self, name: str, done: int, total: int) -> None:
        if self.progress is not None:
            self.progress(name, done, total)


def _key(job: Job) -> str:
    return json.dumps(job, sort_keys=True, ensure_ascii=False)


class _Kept:
    """A file of records, one a line; those that other code has measured are forgotten."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.records: dict[str, Measured] = {}
        if path.exists():
            for line in path.read_bytes().split(b"\n")[:-1]:  # what follows the last line break was torn by a kill
                self._take(line)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            # Written anew, so that a torn line and what has become invalid are gone before the next is appended.
            temporary = path.with_suffix(".part")
            temporary.write_text("".join(self._line(*item) for item in self.records.items()), encoding="utf-8")
            os.replace(temporary, path)
        except OSError as error:
            raise OutputError(
                "measurements cannot be kept", place=Place(str(path)), found=error.strerror or str(error)
            ) from None

    def _take(self, line: bytes) -> None:
        try:
            entry = json.loads(line)
            if entry["code"] == code_digest():
                self.records[entry["key"]] = entry["record"]
        except (ValueError, KeyError, TypeError):
            return  # measured again

    def append(self, key: str, record: Measured) -> None:
        """Keep one more record."""
        self.records[key] = record
        with self._path.open("a", encoding="utf-8") as file:
            file.write(self._line(key, record))

    @staticmethod
    def _line(key: str, record: Measured) -> str:
        entry = {"code": code_digest(), "key": key, "record": record}
        return json.dumps(entry, ensure_ascii=False, allow_nan=False) + "\n"


@cache
def code_digest() -> str:
    """Return a digest of all code and data of this package that measurements depend on."""
    digest = hashlib.sha256()

    def add(place: Traversable, name: str) -> None:
        if place.is_dir():
            if not place.name.startswith("__"):
                for each in sorted(place.iterdir(), key=lambda entry: entry.name):
                    add(each, f"{name}/{each.name}" if name else each.name)
        elif name in _MEASURING or not name.startswith(_OF_NO_EFFECT):
            digest.update(name.encode() + b"\0" + place.read_bytes() + b"\0")

    add(files("scenewright"), "")
    return digest.hexdigest()[:16]
