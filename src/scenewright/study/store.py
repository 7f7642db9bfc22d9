"""The store of an experiment: one record a case, appended as each is done, kept as Parquet in the end.

What enters: records and settings. What leaves: files in a result folder, and `Results` read back from it. Nothing is
run here.

While an experiment runs, `cases.jsonl` grows by one line a case; a last line that was torn by a kill is dropped. When
it ends or is interrupted, all go into `cases.parquet` in one step. Readers take both together, each case once.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scenewright.errors import InputError, OutputError, Place
from scenewright.study.lines import read_lines

if TYPE_CHECKING:
    import pyarrow as pa

SCHEMA_VERSION = 1
SETTINGS_FILE = "settings.json"
PARQUET_FILE = "cases.parquet"
LINES_FILE = "cases.jsonl"
LOCK_FILE = ".lock"
RUNS = "runs"
PROGRAMS = "programs"


@dataclass(frozen=True, slots=True)
class CaseRecord:
    """What came of one case.

    Attributes
    ----------
    case
        The key: row, ego, draw and method.
    parameters
        JSON text; values in each parameter's own unit.
    cause, first_cause
        Of `causes.CAUSES`, within all takes and in the first.
    take, takes
        Which take was kept, and how many were driven.
    best_*, first_*
        Whether judge and criteria both hold at that tolerance: in any take, and in the first.
    kept
        The tolerances at which they hold in the take that was kept.
    criteria_disagree
        Whether judge and criteria differ at the tight tolerance in any take.
    failed_conditions
        Of the kept take at the tight tolerance: ids of the judge's conditions, and of criteria as ``criterion ID``.
    proof
        The clashing constraints, where it is proven infeasible or the ego left no room.
    solve_ms
        Ticks at which the solver was asked, everything counted.
    directory
        Where its run is kept, relative to the result folder.
    reverses, stands, jerks_mpsss, accels_mpss, pace
        How the hero drove up to its trigger in the kept take, as in `approach.Approach`.
    """

    case: str
    row: int
    ego: str
    draw: int
    seed: int
    method: str
    interaction: str
    trigger: str
    ego_state: str
    ego_intent: str
    hero_state: str
    hero_intent: str
    parameters: str
    command: str
    status: str = "error"
    cause: str = "error"
    first_cause: str = "error"
    take: int = 1
    takes: int = 0
    best_fine: bool = False
    best_tight: bool = False
    best_loose: bool = False
    best_coarse: bool = False
    first_fine: bool = False
    first_tight: bool = False
    first_loose: bool = False
    first_coarse: bool = False
    kept: list[str] = field(default_factory=list)
    criteria_disagree: bool = False
    failed_conditions: list[str] = field(default_factory=list)
    proof: str | None = None
    simulated_s: float = 0.0
    wall_s: float = 0.0
    solve_ms: list[float] = field(default_factory=list)
    message: str = ""
    directory: str | None = None
    reverses: bool = False
    stands: bool = False
    jerks_mpsss: list[float] = field(default_factory=list)
    accels_mpss: list[float] = field(default_factory=list)
    pace: float | None = None

    @property
    def family(self) -> str:
        """What the hero does, and how its trigger is stated."""
        return f"{self.interaction}, {self.trigger.lower()}"

    def holds(self, which: str, level: str) -> bool:
        """Whether it is a success at a level: `which` is ``first`` or ``best``."""
        return bool(getattr(self, f"{which}_{level}"))


@dataclass(frozen=True, slots=True)
class Results:
    """What a result folder holds."""

    directory: Path
    settings: dict[str, Any]
    records: tuple[CaseRecord, ...]

    @property
    def table(self) -> pa.Table:
        """The records as an Arrow table, which DuckDB, polars and pandas query as it is."""
        return as_table(self.records)


def read_results(directory: Path | str) -> Results:
    """Read a result folder, finished or not.

    Raises
    ------
    InputError
        Where it is none, or a file in it cannot be read.
    """
    folder = Path(directory)
    settings = read_settings(folder)
    return Results(folder, settings, tuple(sorted(read_records(folder).values(), key=_order_of(settings))))


def _order_of(settings: Mapping[str, Any]) -> Callable[[CaseRecord], tuple[int, ...]]:
    """Return the order in which methods, rows, egos were asked for; what was not asked for comes last."""
    places = {
        name: {each: place for place, each in enumerate(settings.get(name, ()))} for name in ("methods", "rows", "egos")
    }

    def order(record: CaseRecord) -> tuple[int, ...]:
        asked = (("methods", record.method), ("rows", record.row), ("egos", record.ego))
        return (*(places[name].get(value, len(places[name])) for name, value in asked), record.draw)

    return order


def read_settings(folder: Path) -> dict[str, Any]:
    """Return what an experiment was asked to do; raises InputError where the folder holds none."""
    path = folder / SETTINGS_FILE
    try:
        settings = json.loads(path.read_text(encoding="utf-8"))
        version = settings["schema_version"]
    except FileNotFoundError:
        raise InputError(
            "there are no results of an experiment here",
            place=Place(str(folder)),
            expected=f"a folder with {SETTINGS_FILE}, as `scenewright bench` leaves it",
        ) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError("the settings cannot be read", place=Place(str(path)), found=str(error)) from None
    if version != SCHEMA_VERSION:
        raise InputError(
            "the results have another schema version",
            place=Place(str(path)),
            found=str(version),
            expected=str(SCHEMA_VERSION),
        )
    return dict(settings)


def read_records(folder: Path) -> dict[str, CaseRecord]:
    """Return all records by key, each once, whether they have been put into Parquet yet or not."""
    records = {record.case: record for record in _from_parquet(folder / PARQUET_FILE)}
    records.update({record.case: record for record in _from_lines(folder / LINES_FILE)})
    return records


def _from_parquet(path: Path) -> Iterator[CaseRecord]:
    if not path.exists():
        return
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        yield from [_record(row) for row in pq.read_table(path).to_pylist()]
    except (pa.ArrowInvalid, OSError, TypeError) as error:
        raise InputError(
            "the results cannot be read", place=Place(str(path)), found=str(error).split("\n")[0]
        ) from None


def _record(row: Mapping[str, Any]) -> CaseRecord:
    """Return a record; what earlier versions kept besides is left out."""
    return CaseRecord(**{name: value for name, value in row.items() if name in CaseRecord.__slots__})


def _from_lines(path: Path) -> Iterator[CaseRecord]:
    for number, line in enumerate(read_lines(path), start=1):
        try:
            yield _record(json.loads(line))
        except (ValueError, TypeError) as error:
            place = Place(str(path), line=number)
            raise InputError("this is not the record of a case", place=place, found=str(error)) from None


def compact(folder: Path) -> None:
    """Put all records into `cases.parquet` in one step, and drop the lines that it then holds."""
    import pyarrow.parquet as pq

    temporary = folder / f".{PARQUET_FILE}.part"
    pq.write_table(read_results(folder).table, temporary, compression="zstd")
    os.replace(temporary, folder / PARQUET_FILE)
    (folder / LINES_FILE).unlink(missing_ok=True)


def write_settings(folder: Path, settings: Mapping[str, Any]) -> None:
    """Write `settings.json` in one step."""
    temporary = folder / f".{SETTINGS_FILE}.part"
    temporary.write_text(json.dumps(settings, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    os.replace(temporary, folder / SETTINGS_FILE)


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep others from writing to a result folder; the lock goes with the process, however that ends."""
    import fcntl

    with (folder / LOCK_FILE).open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise OutputError(
                "another experiment is writing to this folder",
                place=Place(str(folder)),
                fix="wait until it has ended, or choose another folder with --out DIR",
            ) from None
        yield


def as_table(records: Iterable[CaseRecord]) -> pa.Table:
    """Return records as an Arrow table whose columns have the same types whatever they hold."""
    import pyarrow as pa

    types: dict[str, pa.DataType] = {
        "str": pa.string(),
        "str | None": pa.string(),
        "int": pa.int64(),
        "bool": pa.bool_(),
        "float": pa.float64(),
        "float | None": pa.float64(),
        "list[str]": pa.list_(pa.string()),
        "list[float]": pa.list_(pa.float64()),
    }
    schema = pa.schema([pa.field(each.name, types[str(each.type)]) for each in fields(CaseRecord)])
    return pa.Table.from_pylist([asdict(record) for record in records], schema=schema)
