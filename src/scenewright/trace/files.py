"""Reads and writes `trace.parquet`: one row per step and actor, columns as in the outside contract.

What enters: a `Trace`, or a path. What leaves: a file, or a `Trace`. The same trace gives the same bytes.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from scenewright.errors import InputError, Place
from scenewright.trace.model import COLUMNS, ActorTrace, FloatArray, Trace

if TYPE_CHECKING:
    from pyarrow import ChunkedArray

TRACE_FILE = "trace.parquet"


def write_trace(trace: Trace, path: Path) -> None:
    """Write `trace` as Parquet, rows ordered by step, then actor."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    names = list(trace.actors)
    steps = len(trace.time_s)
    columns: dict[str, object] = {
        "step": np.repeat(np.arange(steps, dtype=np.int64), len(names)),
        "time_s": np.repeat(trace.time_s, len(names)),
        "actor": pa.array(names * steps, type=pa.string()),
    }
    for column in COLUMNS:
        columns[column] = np.stack([getattr(actor, column) for actor in trace.actors.values()], axis=1).ravel()
    pq.write_table(pa.table(columns), path, compression="zstd")


def read_trace(path: Path | str) -> Trace:
    """Read a trace file.

    Raises
    ------
    InputError
        Where the file is missing, is not Parquet, or lacks a column or a step.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = Path(path)
    if not path.is_file():
        raise InputError(
            "there is no trace here", place=Place(str(path)), expected="a run directory with trace.parquet"
        )
    try:
        table = pq.read_table(path)
    except (pa.ArrowInvalid, OSError) as error:
        raise InputError("the trace cannot be read", place=Place(str(path)), found=str(error).split("\n")[0]) from None
    missing = {"step", "time_s", "actor", *COLUMNS} - set(table.column_names)
    if missing:
        raise InputError(
            "the trace lacks columns", place=Place(str(path)), found=", ".join(sorted(missing)) + " missing"
        )
    numbers = {column: _numbers(table.column(column), column, path) for column in ("time_s", *COLUMNS)}
    actor_column = np.asarray(table.column("actor").to_pylist(), dtype=object)
    step = _numbers(table.column("step"), "step", path)
    actors, steps = dict[str, ActorTrace](), dict[str, FloatArray]()
    for name in dict.fromkeys(actor_column.tolist()):
        rows = actor_column == name
        order = np.argsort(numbers["time_s"][rows], kind="stable")
        actors[str(name)] = ActorTrace(**{column: values[rows][order] for column, values in numbers.items()})
        steps[str(name)] = step[rows][order]
    if not actors:
        raise InputError("the trace is empty", place=Place(str(path)))
    axes = [actor.time_s for actor in actors.values()]
    if any(not np.array_equal(axis, axes[0]) for axis in axes) or not np.all(np.diff(axes[0]) > 0):
        raise InputError(
            "the actors of the trace are not all sampled once at the same instants",
            place=Place(str(path)),
            found=", ".join(f"{name}: {len(actor.time_s)} samples" for name, actor in actors.items()),
            expected="one row per step and actor",
        )
    for name, numbered in steps.items():
        _check_none_is_missing(name, numbered, path)
    return Trace(actors)


def _check_none_is_missing(actor: str, steps: FloatArray, path: Path) -> None:
    """Refuse a trace with a hole: it would pass for one long step in which nothing happened."""
    astray = np.flatnonzero(steps != np.arange(len(steps)))
    if len(astray):
        raise InputError(
            "the trace lacks a step",
            place=Place(str(path)),
            found=f"step {steps[astray[0]]:g} of {actor} where step {astray[0]} should be",
            expected="one row per step and actor, the first step being 0",
        )


def _numbers(column: ChunkedArray[Any], name: str, path: Path) -> FloatArray:
    """Return a column as floats; a column of texts or with gaps is told by what it holds."""
    import pyarrow as pa

    if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type)) or column.null_count:
        found = f"{column.null_count} gaps" if column.null_count else f"values of type {column.type}"
        raise InputError(f"a value of {name} is not a number", place=Place(str(path)), found=found)
    return np.asarray(column.to_numpy(), dtype=np.float64)
