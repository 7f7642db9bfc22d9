"""What the method is held to, beside what was measured.

What enters: records and the table of open against closed loop. What leaves: a table, one line an aim. Where a smaller
experiment was run, the same aims are stated over its cases.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from scenewright.study.report.counting import Rate, percent, rate
from scenewright.study.report.records import OURS, grouped
from scenewright.study.report.tables import Column, Table, Value
from scenewright.study.store import CaseRecord

_FIRST_TIGHT, _BEST_TIGHT, _FIRST_LOOSE, _ROW, _EGO, _GAIN = 0.97, 0.99, 0.99, 0.85, 0.90, 0.23
_EPSILON = 1e-9


def aims_table(records: Sequence[CaseRecord], loops: Table) -> Table:
    """Return the aims with what was measured and whether they are met."""
    own = [record for record in records if record.method == OURS]
    rows = [
        _over_all("success at tight tolerance, first take", _FIRST_TIGHT, rate(own, "first")),
        _over_all("success at tight tolerance, best of N", _BEST_TIGHT, rate(own, "best")),
        _over_all("success at loose tolerance, first take", _FIRST_LOOSE, rate(own, "first", "loose")),
        _worst("worst row, tight, best of N", _ROW, own, lambda record: f"row {record.row}"),
        _worst("worst ego, tight, best of N", _EGO, own, lambda record: record.ego),
        *_gains(loops),
    ]
    columns = (
        Column("aim", "aim"),
        Column("at_least", "at least"),
        Column("measured", "measured"),
        Column("over", "over"),
        Column("met", "met"),
    )
    return Table("aims", "Aims and what was measured, ours", columns, tuple(rows))


def _over_all(name: str, least: float, found: Rate) -> tuple[Value, ...]:
    return name, percent(least), str(found), f"{found.total} cases", _met(found.value, least)


def _worst(
    name: str, least: float, records: Sequence[CaseRecord], key: Callable[[CaseRecord], str]
) -> tuple[Value, ...]:
    rates = {group: rate(cases, "best") for group, cases in grouped(records, key).items()}
    shares = {group: found.value for group, found in rates.items() if found.value is not None}
    if not shares:
        return name, percent(least), "–", "no case counted", "–"
    group = min(shares, key=lambda each: shares[each])
    cases = f"{rates[group].successes} of {rates[group].total} cases"
    return name, percent(least), f"{rates[group]} ({group})", cases, _met(shares[group], least)


def _gains(loops: Table) -> list[tuple[Value, ...]]:
    shares: dict[str, dict[str, float]] = {}
    for line in loops.records():
        if line["tight"] is not None:
            shares.setdefault(line["scene"], {})[line["mode"]] = line["tight"]
    gains = {scene: by["closed"] - by["open"] for scene, by in shares.items() if len(by) == 2}
    overall = gains.pop("all", None)
    if overall is None:
        return []
    counted = f"{max(int(str(value)) for value in loops.column('counted'))} cases a loop"
    worst = min(gains, key=lambda scene: gains[scene])
    first = (
        "closed loop over open loop, four scenarios, tight",
        f"{100 * _GAIN:.0f} points",
        f"{100 * overall:+.0f} points",
    )
    second = ("the same, worst scenario", "0 points", f"{100 * gains[worst]:+.0f} points ({worst.replace('_', ' ')})")
    return [
        (*first, counted, _met(overall, _GAIN)),
        (*second, f"{len(gains)} scenarios", _met(gains[worst], 0.0)),
    ]


def _met(share: float | None, least: float) -> str:
    if share is None:
        return "–"
    return "yes" if share >= least - _EPSILON else "no"
