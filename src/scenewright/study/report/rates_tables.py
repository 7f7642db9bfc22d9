"""The tables of rates: by method, family, ego, row, tolerance and take.

What enters: records. What leaves: tables. Every table counts every record of the methods it is about exactly once (per
line of grouping), so its columns of cases add up to the store's.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import median

from scenewright.study.causes import NOT_OURS
from scenewright.study.report.counting import (
    INFEASIBLE,
    NEVER_MET,
    NO_ROOM,
    causes,
    counted,
    rate,
)
from scenewright.study.report.records import OURS, egos_of, first_success, grouped, methods_of
from scenewright.study.report.tables import Column, Table, Value
from scenewright.study.store import CaseRecord
from scenewright.study.summary import LEVEL_NAMES

_CASES = (
    Column("cases", "cases", "count"),
    Column("proven_infeasible", "proven infeasible", "count"),
    Column("ego_never_met", "ego never met it", "count"),
    Column("counted", "counted", "count"),
)
_RATES = (
    Column("first_tight", "tight, first take", "rate"),
    Column("first_loose", "loose, first take", "rate"),
    Column("best_tight", "tight, best of N", "rate"),
    Column("best_loose", "loose, best of N", "rate"),
)


def _cases(records: Sequence[CaseRecord]) -> tuple[Value, ...]:
    by = causes(records)
    return len(records), by[INFEASIBLE], by[NEVER_MET], len(counted(records))


def _rates(records: Sequence[CaseRecord]) -> tuple[Value, ...]:
    return tuple(rate(records, which, level) for which in ("first", "best") for level in ("tight", "loose"))


def methods_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a method, over all its cases."""
    by = grouped(records, lambda record: record.method)
    rows: list[tuple[Value, ...]] = []
    for method in methods_of(records):
        own = by[method]
        let = rate(own, "best", without=(*NOT_OURS, NO_ROOM))
        feasible = rate(own, "first", without=(INFEASIBLE,))
        wall = median(record.wall_s for record in own)
        rows.append((method, *_cases(own), *_rates(own), feasible, let, wall))
    columns = (
        Column("method", "method"),
        *_CASES,
        *_RATES,
        Column("first_tight_of_feasible", "tight, first take, of all not proven infeasible", "rate"),
        Column("best_tight_where_ego_let_it", "tight, best of N, where the ego let it", "rate"),
        Column("wall_s_p50", "wall time a case, p50 (s)", "number"),
    )
    return Table("methods", "Every method over the same cases", columns, tuple(rows))


def families_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line an interaction, kind of trigger and method."""
    key = lambda record: (record.interaction, record.trigger, record.method)  # noqa: E731
    columns = (Column("interaction", "interaction"), Column("trigger", "trigger"), Column("method", "method"))
    return _by("families", "Success by family and kind of trigger", records, key, columns)


def egos_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line an ego and method."""
    order = egos_of(records)
    ranked = sorted(records, key=lambda record: order.index(record.ego))
    columns = (Column("ego", "ego"), Column("method", "method"))
    return _by("egos", "Success by ego and method", ranked, lambda record: (record.ego, record.method), columns)


def rows_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a row of the benchmark, for our method alone."""
    own = [record for record in records if record.method == OURS]
    columns = (
        Column("row", "row", "count"),
        Column("interaction", "interaction"),
        Column("trigger", "trigger"),
    )
    key = lambda record: (record.row, record.interaction, record.trigger)  # noqa: E731
    return _by("rows", "Success by row of the benchmark, ours", own, key, columns)


def _by(
    name: str,
    title: str,
    records: Sequence[CaseRecord],
    key: Callable[[CaseRecord], tuple[str | int, ...]],
    columns: tuple[Column, ...],
) -> Table:
    order = methods_of(records)
    groups = grouped(records, key)
    keys = list(groups)
    if columns[-1].name == "method":
        rank = {group: i for i, group in enumerate(dict.fromkeys(k[:-1] for k in keys))}
        keys.sort(key=lambda k: (rank[k[:-1]], order.index(str(k[-1]))))
    rows = tuple((*k, *_cases(groups[k]), *_rates(groups[k])) for k in keys)
    return Table(name, title, (*columns, *_CASES, *_RATES), rows)


def outcomes_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a row of the benchmark and ego, for our method: how many draws fell under which cause."""
    own = [record for record in records if record.method == OURS]
    present = sorted({record.cause for record in own} | {record.first_cause for record in own})
    rows: list[tuple[Value, ...]] = []
    for (row, ego), cell in grouped(own, lambda record: (record.row, record.ego)).items():
        by = causes(cell)
        rows.append((row, ego, len(cell), *(by[cause] for cause in present)))
    columns = (
        Column("row", "row", "count"),
        Column("ego", "ego"),
        Column("cases", "cases", "count"),
        *(Column(cause.replace(" ", "_"), cause, "count") for cause in present),
    )
    return Table("outcomes", "Outcome by row and ego, ours, best of N", columns, tuple(rows))


def tolerance_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a method and level of tolerance."""
    by = grouped(records, lambda record: record.method)
    rows = [
        (method, level, rate(by[method], "first", level), rate(by[method], "best", level))
        for method in methods_of(records)
        for level in LEVEL_NAMES
    ]
    columns = (
        Column("method", "method"),
        Column("tolerance", "tolerance"),
        Column("first", "first take", "rate"),
        Column("best", "best of N", "rate"),
    )
    return Table("tolerance", "Success over tolerance", columns, tuple(rows))


def takes_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line an ego: with which take our method first succeeded at tight tolerance."""
    own = counted(record for record in records if record.method == OURS)
    most = max((record.takes for record in own), default=1)
    by = grouped(own, lambda record: record.ego)
    rows: list[tuple[Value, ...]] = []
    for ego in (*egos_of(own), "all"):
        cases = own if ego == "all" else by[ego]
        won = [first_success(record) for record in cases]
        rows.append((ego, len(cases), *(won.count(take) for take in range(1, most + 1)), won.count(None)))
    columns = (
        Column("ego", "ego"),
        Column("counted", "counted", "count"),
        *(Column(f"take_{take}", f"success in take {take}", "count") for take in range(1, most + 1)),
        Column("none", "no success", "count"),
    )
    return Table("takes", "First success at tight tolerance by take, ours", columns, tuple(rows))
