"""The tables of what did not succeed: causes, every remaining failure, proofs, disagreements.

What enters: records. What leaves: tables, each line of which can be run again by the command in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from scenewright.study.report.counting import INFEASIBLE, causes
from scenewright.study.report.evidence import evidence
from scenewright.study.report.explanations import meaning_of, ordered_causes
from scenewright.study.report.records import OURS, grouped, methods_of, parameter_values
from scenewright.study.report.tables import Column, Table
from scenewright.study.store import CaseRecord

_WHERE = (
    Column("row", "row", "count"),
    Column("interaction", "interaction"),
    Column("trigger", "trigger"),
    Column("ego", "ego"),
    Column("draw", "draw", "count"),
)
# The command holds them too.
_PARAMETERS = Column("parameters", "parameters", shown=False)
_COMMAND = Column("command", "run it again", "command")


def causes_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a method and cause: how many cases fell under it, in the first take and in the best."""
    rows = []
    by = grouped(records, lambda record: record.method)
    for method in methods_of(records):
        best, first = causes(by[method]), causes(by[method], "first")
        for cause in ordered_causes(set(best) | set(first)):
            rows.append((method, cause, first[cause], best[cause], meaning_of(cause)))
    columns = (
        Column("method", "method"),
        Column("cause", "cause"),
        Column("first", "first take", "count"),
        Column("best", "best of N", "count"),
        Column("meaning", "what it means"),
    )
    return Table("causes", "Outcomes by cause", columns, tuple(rows))


def failures_table(records: Sequence[CaseRecord], folder: Path) -> Table:
    """Return every case of our method that is neither a success nor proven infeasible, with what was measured.

    `folder` is that of the results: where runs were kept in it, required and measured values are read from them.
    """
    failed = [r for r in records if r.method == OURS and r.cause not in ("success", INFEASIBLE)]
    order = ordered_causes({record.cause for record in failed})
    failed.sort(key=lambda record: (order.index(record.cause), record.row, record.ego, record.draw))
    rows = [
        (
            record.cause,
            *_where(record),
            record.takes,
            record.ego_trigger_error,
            record.hero_trigger_error,
            evidence(record, folder),
            _values(record),
            record.command,
        )
        for record in failed
    ]
    columns = (
        Column("cause", "cause"),
        *_WHERE,
        Column("takes", "takes", "count"),
        Column("ego_trigger_error", "ego off at trigger (m or s)", "number", shown=False),
        Column("hero_trigger_error", "hero off at trigger (m or s)", "number", shown=False),
        Column("evidence", "measured"),
        _PARAMETERS,
        _COMMAND,
    )
    return Table("failures", "Every remaining failure, ours", columns, tuple(rows))


def proofs_table(records: Sequence[CaseRecord]) -> Table:
    """Return every draw that is proven infeasible, with the proof; the proof is the same for every method."""
    proven = [record for record in records if record.cause == INFEASIBLE]
    by = grouped(proven, lambda record: (record.row, record.ego, record.draw))
    rows = [
        (*_where(same[0]), len(same), next((r.proof for r in same if r.proof), ""), _values(same[0]), same[0].command)
        for same in by.values()
    ]
    columns = (
        *_WHERE,
        Column("methods", "methods", "count"),
        Column("proof", "what clashes"),
        _PARAMETERS,
        _COMMAND,
    )
    return Table("infeasible", "Draws proven infeasible", columns, tuple(rows))


def disagreements_table(records: Sequence[CaseRecord]) -> Table:
    """Return every case, of any method, in which judge and criteria differ at tight tolerance."""
    rows = [
        (record.method, *_where(record), record.cause, ", ".join(record.failed_conditions), record.command)
        for record in records
        if record.criteria_disagree
    ]
    columns = (
        Column("method", "method"),
        *_WHERE,
        Column("cause", "cause"),
        Column("failed_conditions", "failed conditions"),
        _COMMAND,
    )
    return Table("disagreements", "Cases in which judge and criteria differ", columns, tuple(rows))


def _where(record: CaseRecord) -> tuple[int, str, str, str, int]:
    return record.row, record.interaction, record.trigger, record.ego, record.draw


def _values(record: CaseRecord) -> str:
    return " ".join(f"{name}={value:g}" for name, value in parameter_values(record).items())
