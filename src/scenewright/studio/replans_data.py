"""The re-solves of a run as rows and a summary for the page.

What enters: a run directory. What leaves: plain data, or None where the run has no `replans.parquet`.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

Json = dict[str, Any]
REPLANS_FILE = "replans.parquet"


def read_replans(run_dir: Path, missing: list[str]) -> Json | None:
    """Return ``{"rows": [...], "summary": {...}}``; wall times are in milliseconds.

    Parameters
    ----------
    run_dir
        The run directory.
    missing
        A sentence is appended where the file is not there or cannot be read.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = run_dir / REPLANS_FILE
    if not path.is_file():
        missing.append(f"{REPLANS_FILE} is missing: the re-solves cannot be shown")
        return None
    try:
        table = pq.read_table(path).to_pylist()
    except (pa.ArrowInvalid, OSError):
        missing.append(f"{REPLANS_FILE} cannot be read: the re-solves cannot be shown")
        return None
    rows = [
        {
            "time": _number(row.get("time_s"), 3),
            "wall_ms": _number(row.get("wall_s"), 6, 1000.0),
            "status": _word(row.get("status")) or "unknown",
            "backend": _word(row.get("backend")),
            "tolerance": _number(row.get("tolerance"), 2),
            "reason": _word(row.get("reason")),
        }
        for row in table
    ]
    return {"rows": rows, "summary": _summary(rows)}


def _summary(rows: list[Json]) -> Json:
    # Where nothing is solved any more no backend was asked: looking that up takes no time that a solve would.
    wall = np.array([row["wall_ms"] for row in rows if row["backend"] and row["wall_ms"] is not None])
    counts: dict[str, int] = {}
    for row in rows:
        counts[row["status"]] = counts.get(row["status"], 0) + 1
    summary: Json = {
        "count": len(rows),
        "solved": int(wall.size),
        "statuses": dict(sorted(counts.items(), key=lambda item: -item[1])),
    }
    if wall.size:
        p50, p99, most = np.percentile(wall, [50, 99, 100])
        summary |= {"p50_ms": round(float(p50), 2), "p99_ms": round(float(p99), 2), "max_ms": round(float(most), 2)}
    return summary


def _number(value: object, digits: int, factor: float = 1.0) -> float | None:
    if not isinstance(value, int | float) or not math.isfinite(value):
        return None
    return round(float(value) * factor, digits - 3 if factor != 1.0 else digits)


def _word(value: object) -> str:
    return "" if value is None or (isinstance(value, float) and math.isnan(value)) else str(value)
