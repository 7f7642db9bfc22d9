"""The experiment: which cases there are, which are done, and the rest run, recorded one by one.

What enters: a `Plan` and a result folder. What leaves: records in the folder's store; a stopped or killed experiment
goes on where it was. Nothing is counted here, and nothing is printed.
"""

from __future__ import annotations

import os
import platform
import subprocess
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import scenewright
from scenewright.errors import InputError, OutputError, Place
from scenewright.study.cases import OURS, BenchCase, blank_record, program_file, run_bench_case, seed_of
from scenewright.study.lines import LineLog
from scenewright.study.store import (
    LINES_FILE,
    PROGRAMS,
    SCHEMA_VERSION,
    SETTINGS_FILE,
    CaseRecord,
    compact,
    locked,
    read_records,
    read_settings,
    write_settings,
)
from scenewright.study.workers import Crash, each_done

FULL_EGOS = ("constant", "idm", "dawdler", "staller", "stop-and-go", "noisy")
_PACKAGES = ("z3-solver", "daqp", "numpy", "scipy", "pyarrow", "matplotlib")


@dataclass(frozen=True, slots=True)
class Plan:
    """What to run: every combination of rows, egos, draws and methods; with it the same, so is what comes of it.

    Raises
    ------
    InputError, PolicyError
        From `check`, where a row, an ego or a method does not exist.
    """

    rows: tuple[int, ...]
    egos: tuple[str, ...]
    draws: int
    methods: tuple[str, ...]
    seed: int = 0
    takes: int = 3

    def check(self) -> None:
        """Make sure that all there is to run exists."""
        from scenewright.drive.loading import load_policy
        from scenewright.study.benchmark import benchmark_rows
        from scenewright.study.rivals import check_method

        known = {row.id for row in benchmark_rows()}
        for row in self.rows:
            if row not in known:
                raise InputError(
                    f"the benchmark has no row {row}",
                    found=str(row),
                    expected=f"{min(known)} to {max(known)}",
                    fix="--rows 1-4,20, or --rows all",
                )
        for ego in self.egos:
            load_policy(ego)
        for method in self.methods:
            check_method(method)

    def cases(self, folder: Path) -> list[BenchCase]:
        """Return all cases, all of one draw before the next; runs of our method keep their files."""
        from scenewright.study.benchmark import benchmark_row, draw_row

        cases = []
        for draw in range(self.draws):
            for row in self.rows:
                drawn = tuple(draw_row(benchmark_row(row), draw, self.seed).items())
                own = seed_of(row, draw, self.seed)
                cases += [
                    BenchCase(row, ego, draw, method, own, drawn, self.takes, folder, method == OURS)
                    for ego in self.egos
                    for method in self.methods
                ]
        return cases

    def as_dict(self) -> dict[str, Any]:
        """Return the plan as plain data, as JSON has it."""
        return {name: list(value) if isinstance(value, tuple) else value for name, value in asdict(self).items()}


# One row in four: every interaction, both kinds of trigger, and heroes from every side.
_QUICK_ROWS = (1, 4, 7, 12, 15, 17, 20, 26, 29, 32, 37, 42, 49, 55, 60, 63, 66, 74, 78, 80)
_QUICK_EGOS = ("constant", "idm", "staller", "stop-and-go")
# A sample is a whole run: its method by its own default would take half of the time of all others together.
_DEAR = {"rejection": "rejection:10"}
# A run takes it 4 s and more: a full experiment would take half a day.
_SLOW = ("smt",)


def preset(name: str) -> Plan:
    """Return what ``quick``, ``full`` or a choice of one's own (any other name) starts from."""
    from scenewright.study.benchmark import benchmark_rows
    from scenewright.study.rivals import METHODS

    methods = tuple(_DEAR.get(method, method) for method in METHODS if method not in _SLOW)
    if name == "quick":
        return Plan(_QUICK_ROWS, _QUICK_EGOS, 1, methods)
    every = tuple(row.id for row in benchmark_rows())
    return Plan(every, FULL_EGOS, 3, methods) if name == "full" else Plan(every, FULL_EGOS, 1, (OURS,))


@dataclass(slots=True)
class Progress:
    """How far an experiment has come; given to whoever shows it after every case."""

    total: int
    done: int
    successes: int
    errors: int
    new: int = 0


@dataclass(slots=True)
class Experiment:
    """A plan in a result folder.

    Attributes
    ----------
    command
        What was typed, for the settings and to resume.
    """

    plan: Plan
    folder: Path
    command: str
    progress: Progress = field(init=False, default_factory=lambda: Progress(0, 0, 0, 0))

    def run(
        self,
        workers: int,
        shown: Callable[[Progress], None] = lambda _: None,
        stop: Callable[[], bool] = lambda: False,
    ) -> bool:
        """Run what is not done yet and return whether all is done now.

        Raises
        ------
        InputError, OutputError
            Where the folder holds something else, or is being written to by another experiment.
        """
        self.plan.check()
        _prepare(self.folder)
        with locked(self.folder):
            settings = self._settle(workers)
            cases = self.plan.cases(self.folder)
            self._write_programs()
            records = read_records(self.folder)
            left = [case for case in cases if case.key not in records]
            wins = sum(record.best_tight for record in records.values())
            errors = sum(record.cause == "error" for record in records.values())
            self.progress = Progress(len(cases), len(cases) - len(left), wins, errors)
            shown(self.progress)
            if left:
                self._run_cases(left, workers, shown, stop)
            finished = self.progress.done == len(cases)
            if left:
                compact(self.folder)
            if finished and "finished" not in settings:
                write_settings(self.folder, {**settings, "finished": _now()})
            return finished

    def _run_cases(
        self, left: Sequence[BenchCase], workers: int, shown: Callable[[Progress], None], stop: Callable[[], bool]
    ) -> None:
        log, progress = LineLog(self.folder / LINES_FILE), self.progress
        try:
            for case, outcome in each_done(run_bench_case, left, workers, stop):
                record = _crashed(case, outcome) if isinstance(outcome, Crash) else outcome
                log.append(asdict(record))
                progress.done += 1
                progress.new += 1
                progress.successes += record.best_tight
                progress.errors += record.cause == "error"
                shown(progress)
        finally:
            log.close()

    def _settle(self, workers: int) -> dict[str, Any]:
        """Write the settings of a new experiment, or make sure that these are the ones to go on with."""
        if not (self.folder / SETTINGS_FILE).exists():
            new = {
                "schema_version": SCHEMA_VERSION,
                "command": self.command,
                **self.plan.as_dict(),
                **circumstances(),
                "workers": workers,
                "started": _now(),
            }
            write_settings(self.folder, new)
            return new
        settings, asked = read_settings(self.folder), self.plan.as_dict()
        for name in asked:
            if settings.get(name) != asked[name]:
                raise InputError(
                    f"the folder holds an experiment with other {name}",
                    place=Place(str(self.folder)),
                    found=f"{asked[name]} now",
                    expected=f"{settings.get(name)}, to go on with it",
                    fix="give the same options as then, or another folder with --out DIR",
                )
        now = {"version": scenewright.__version__, "revision": revision()}
        if "finished" not in settings and any(settings[name] != value for name, value in now.items()):
            settings.setdefault("resumed_with", []).append(now)
            write_settings(self.folder, settings)
        return settings

    def _write_programs(self) -> None:
        from scenewright.study.benchmark import benchmark_row

        (self.folder / PROGRAMS).mkdir(exist_ok=True)
        for row in self.plan.rows:
            (self.folder / program_file(row)).write_text(benchmark_row(row).program_text, encoding="utf-8")


def _crashed(case: BenchCase, crash: Crash) -> CaseRecord:
    from scenewright.study.benchmark import benchmark_row

    return blank_record(case, benchmark_row(case.row), message=crash.message)


def _prepare(folder: Path) -> None:
    """Make the folder; one that holds something else is left alone."""
    fix = "choose another folder with --out DIR"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        strange = next((each.name for each in folder.iterdir() if not each.name.startswith(".")), None)
    except OSError as error:
        found = error.strerror or str(error)
        raise OutputError("the result folder cannot be made", place=Place(str(folder)), found=found, fix=fix) from None
    if strange is not None and not (folder / SETTINGS_FILE).exists():
        raise OutputError(
            "the result folder holds something that is no experiment",
            place=Place(str(folder)),
            found=strange,
            expected="a new or empty folder, or that of an experiment to go on with",
            fix=fix,
        )


# -- circumstances --------------------------------------------------------------------------------------------------
def circumstances() -> dict[str, Any]:
    """Return what results and times depend on: versions, revision, processor, system."""
    return {
        "version": scenewright.__version__,
        "revision": revision(),
        "packages": _versions(),
        "machine": {
            "cpu": _cpu(),
            "cores": os.cpu_count(),
            "system": platform.platform(),
            "python": platform.python_version(),
        },
    }


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())


def revision() -> str | None:
    """Return the revision of the source where it is a git checkout, marked where it was changed; None elsewhere."""
    package = Path(scenewright.__file__).parent
    git = ["git", "-C", str(package)]
    try:
        tracked = subprocess.run([*git, "ls-files", "--error-unmatch", "__init__.py"], capture_output=True, check=False)
        if tracked.returncode != 0:
            return None
        described = [*git, "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"]
        found = subprocess.run(described, capture_output=True, check=False, text=True)
    except OSError:
        return None
    return found.stdout.strip() or None


def _versions() -> dict[str, str]:
    found = {}
    for name in _PACKAGES:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
