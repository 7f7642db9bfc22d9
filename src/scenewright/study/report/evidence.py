"""What was measured in a case that did not succeed, condition by condition.

What enters: a record and the folder of its results. What leaves: text. Where the run was kept, its files
are judged again and required and measured values stated; else what the record says.
"""

from __future__ import annotations

import math
from pathlib import Path

from scenewright.errors import ScenewrightError
from scenewright.study.store import CaseRecord
from scenewright.units import SI_SYMBOL


def evidence(record: CaseRecord, folder: Path) -> str:
    """Return what is known about a case that did not succeed, one thing a line."""
    parts = _measured(record, folder) or ["failed: " + ", ".join(record.failed_conditions)] * bool(
        record.failed_conditions
    )
    if record.criteria_disagree:
        parts.append("judge and criteria disagree in a take")
    if record.proof and record.cause == "ego left no room":
        parts.append("proof: " + "; ".join(record.proof.splitlines()))
    if record.message:
        parts.append(record.message)
    return "\n".join(parts)


def _measured(record: CaseRecord, folder: Path) -> list[str]:
    """Return required and measured values of all that failed in the kept run; nothing where none was kept."""
    if record.directory is None or not (folder / record.directory).is_dir():
        return []
    from scenewright.judge.files import read_case
    from scenewright.judge.judgement import judge
    from scenewright.judge.tolerance import TIGHT
    from scenewright.roads.load import load_map
    from scenewright.study.benchmark import benchmark_row, criteria_of

    row = benchmark_row(record.row)
    try:
        case = read_case(folder / record.directory)
        failed = [c for c in judge(case).conditions if not c.holds_at(TIGHT)]
        criteria = criteria_of(row, case.parameters, case.trace, load_map(row.program.map_name))
    except ScenewrightError as error:
        return [f"the kept run cannot be judged again: {error.message}"]
    told = [_stated(c.text, c.required, c.measured, c.unit) for c in failed]
    broken = [criterion for criterion in criteria if not criterion.holds_at(TIGHT)]
    for criterion in broken:
        unit = SI_SYMBOL[criterion.dimension] if criterion.dimension is not None else ""
        told.append("criterion: " + _stated(criterion.text, criterion.required, criterion.measured, unit))
    return told


def _stated(text: str, required: float | None, measured: float | None, unit: str) -> str:
    unit = f" {unit}" if unit else ""
    wanted = "" if required is None else f"required {required:.2f}{unit}, "
    if measured is None or not math.isfinite(measured):
        found = "never came about"
    else:
        found = f"measured {measured:.2f}{unit}"
    return f"{text} ({wanted}{found})"
