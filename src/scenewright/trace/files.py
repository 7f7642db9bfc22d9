"""Reads and writes `trace.parquet`: one row per step and actor, columns as in the outside contract.

What enters: a `Trace`, or a path. What leaves: a file, or a `Trace`. The same trace gives the same bytes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from scenewright.errors import InputError, Place
from scenewright.trace.model import COLUMNS, ActorTrace, Trace

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


def read_trace(path: Path) -> Trace:
    """Read a trace file.

    Raises
    ------
    InputError
        Where the file is missing, is not Parquet, or lacks a column.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

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
    actor_column = np.asarray(table.column("actor").to_pylist())
    actors: dict[str, ActorTrace] = {}
    for name in dict.fromkeys(actor_column.tolist()):
        rows = actor_column == name
        values = {c: table.column(c).to_numpy().astype(np.float64)[rows] for c in ("time_s", *COLUMNS)}
        order = np.argsort(values["time_s"], kind="stable")
        actors[str(name)] = ActorTrace(**{key: value[order] for key, value in values.items()})
    if not actors:
        raise InputError("the trace is empty", place=Place(str(path)))
    return Trace(actors)
