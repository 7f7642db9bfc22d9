"""The tables of the experiment: aims, rates by group, takes, every failure with what was measured, proofs.

What enters: records. What leaves: tables. Each counts every record of the methods that it is about exactly once (per
line of grouping), so that its columns of cases add up to the store's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from pathlib import Path
from statistics import median

from scenewright.errors import ScenewrightError
from scenewright.study.cases import judge_kept
from scenewright.study.causes import CAUSES, INFEASIBLE, NEVER_MET, NO_ROOM, NOT_OURS
from scenewright.study.report.tables import Table, Value
from scenewright.study.store import CaseRecord
from scenewright.study.summary import LEVEL_NAMES, Rate, Tally, grouped, percent, tally
from scenewright.units import SI_SYMBOL

_COUNTS = {
    "cases": "cases",
    "proven_infeasible": "proven infeasible",
    "ego_never_met": "ego never met it",
    "counted": "counted",
}
_RATES = {
    "first_tight": "tight, first take",
    "first_loose": "loose, first take",
    "best_tight": "tight, best of N",
    "best_loose": "loose, best of N",
}
_WHERE = {"row": "row", "interaction": "interaction", "trigger": "trigger", "ego": "ego", "draw": "draw"}
_FIRST_TIGHT, _BEST_TIGHT, _FIRST_LOOSE, _ROW, _EGO, _GAIN = 0.97, 0.99, 0.99, 0.85, 0.90, 0.23
_EPSILON = 1e-9


# -- rates ----------------------------------------------------------------------------------------------------------
def rates_table(name: str, records: Sequence[CaseRecord], by: Sequence[str]) -> Table:
    """Return one line a group of records that agree in what `by` names: cases, what is left out of rates, rates."""
    groups = grouped(records, lambda record: tuple(getattr(record, each) for each in by))
    rows = tuple((*key, *_counts_and_rates(tally(own))) for key, own in groups.items())
    return Table(name, f"Success by {', '.join(by)}", {**{each: each for each in by}, **_COUNTS, **_RATES}, rows)


def _counts_and_rates(found: Tally) -> tuple[Value, ...]:
    best = found.causes["best"]
    rates = [found.rate(which, level) for which in ("first", "best") for level in ("tight", "loose")]
    return found.cases, best[INFEASIBLE], best[NEVER_MET], found.rated, *rates


def methods_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a method: rates, other causes (best of N), and how often judge and criteria differ."""
    present = {record.cause for record in records}
    others = [cause for cause in (*CAUSES, *sorted(present - set(CAUSES))) if cause in present - {"success", *NOT_OURS}]
    rows: list[tuple[Value, ...]] = []
    for method, own in grouped(records, lambda record: record.method).items():
        found = tally(own)
        counts = (found.causes["best"][cause] for cause in others)
        wall = median(record.wall_s for record in own)
        rows.append((method, *_counts_and_rates(found), found.rate_where_let, *counts, found.disagreements, wall))
    columns = {
        "method": "method",
        **_COUNTS,
        **_RATES,
        "best_tight_where_ego_let_it": "tight, best of N, where the ego let it",
        **{cause.replace(" ", "_"): cause for cause in others},
        "disagreements": "judge and criteria differ",
        "wall_s_p50": "wall time a case, p50 (s)",
    }
    return Table("methods", "Every method over the same cases", columns, tuple(rows))


def tolerance_table(records: Sequence[CaseRecord]) -> Table:
    """Return one line a method and level of tolerance."""
    tallies = {method: tally(own) for method, own in grouped(records, lambda record: record.method).items()}
    rows = [
        (method, level, found.rate("first", level), found.rate("best", level))
        for method, found in tallies.items()
        for level in LEVEL_NAMES
    ]
    columns = {"method": "method", "tolerance": "tolerance", "first": "first take", "best": "best of N"}
    return Table("tolerance", "Success over tolerance", columns, tuple(rows))


def takes_table(own: Sequence[CaseRecord]) -> Table:
    """Return one line an ego: whether the first take succeeded at tight tolerance, or else which was kept."""
    over = [record for record in own if record.cause not in NOT_OURS]
    most = max((record.takes for record in over), default=1)
    rows: list[tuple[Value, ...]] = []
    for ego, cases in (*grouped(over, lambda record: record.ego).items(), ("all", over)):
        won = [_take_of_success(record) for record in cases]
        rows.append((ego, len(cases), *(won.count(take) for take in range(1, most + 1)), won.count(None)))
    takes = {f"take_{take}": f"success in take {take}" for take in range(1, most + 1)}
    columns = {"ego": "ego", "counted": "counted", **takes, "none": "no success"}
    return Table(
        "takes",
        "Success at tight tolerance, ours: in the first take, else in the one that was kept",
        columns,
        tuple(rows),
    )


def _take_of_success(record: CaseRecord) -> int | None:
    if record.first_tight:
        return 1
    return max(2, record.take) if record.best_tight else None


# -- aims -----------------------------------------------------------------------------------------------------------
def aims_table(own: Sequence[CaseRecord], loops: Table) -> Table:
    """Return what our method is held to, what was measured, and whether it is met; over the cases that there are."""
    all_cases = tally(own)
    rows = [
        _over_all("success at tight tolerance, first take", _FIRST_TIGHT, all_cases.rate("first")),
        _over_all("success at tight tolerance, best of N", _BEST_TIGHT, all_cases.rate("best")),
        _over_all("success at loose tolerance, first take", _FIRST_LOOSE, all_cases.rate("first", "loose")),
        _worst("worst row, tight, best of N", _ROW, own, lambda record: f"row {record.row}"),
        _worst("worst ego, tight, best of N", _EGO, own, lambda record: record.ego),
        *_gains(loops),
    ]
    columns = {"aim": "aim", "at_least": "at least", "measured": "measured", "over": "over", "met": "met"}
    return Table("aims", "What ours is held to.", columns, tuple(rows))


def _over_all(name: str, least: float, found: Rate) -> tuple[Value, ...]:
    bounds = found.interval
    interval = "" if bounds is None else f" (95 %: {100 * bounds[0]:.1f} to {100 * bounds[1]:.1f} %)"
    return name, percent(least), f"{found}{interval}", f"{found.successes} of {found.total}", _met(found.value, least)


def _worst(
    name: str, least: float, records: Sequence[CaseRecord], key: Callable[[CaseRecord], str]
) -> tuple[Value, ...]:
    rates = {group: tally(cases).rate("best") for group, cases in grouped(records, key).items()}
    shares = {group: found.value for group, found in rates.items() if found.value is not None}
    if not shares:
        return name, percent(least), "-", "no case counted", "-"
    group = min(shares, key=lambda each: shares[each])
    found = rates[group]
    return name, percent(least), f"{found} ({group})", f"{found.successes} of {found.total}", _met(found.value, least)


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
    first = ("closed loop over open loop, four scenarios, tight", f"{100 * _GAIN:.0f} points")
    second = f"{100 * gains[worst]:+.0f} points ({worst.replace('_', ' ')})"
    return [
        (*first, f"{100 * overall:+.0f} points", counted, _met(overall, _GAIN)),
        ("the same, worst scenario", "0 points", second, f"{len(gains)} scenarios", _met(gains[worst], 0.0)),
    ]


def _met(share: float | None, least: float) -> str:
    if share is None:
        return "-"
    return "yes" if share >= least - _EPSILON else "no"


# -- what did not succeed -------------------------------------------------------------------------------------------
def failures_table(own: Sequence[CaseRecord], folder: Path) -> Table:
    """Return every case that is neither a success nor proven infeasible, with what was measured.

    `folder` is that of the results: where runs were kept in it, required and measured values are read from them.
    """
    failed = [record for record in own if record.cause not in ("success", INFEASIBLE)]
    failed.sort(key=lambda r: (CAUSES.index(r.cause) if r.cause in CAUSES else len(CAUSES), r.row, r.ego, r.draw))
    rows = tuple((r.cause, *_where(r), r.takes, evidence(r, folder), r.command) for r in failed)
    columns = {
        "cause": "cause",
        **_WHERE,
        "takes": "takes",
        "evidence": "measured",
        "command": "run it again",
    }
    none = "Every case of our method succeeded or is proven infeasible." if own else "No case is of our method."
    return Table("failures", "Every remaining failure, ours", columns, rows, none)


def proofs_table(records: Sequence[CaseRecord]) -> Table:
    """Return every draw that is proven infeasible, with the proof; the proof is the same for every method."""
    proven = [record for record in records if record.cause == INFEASIBLE]
    key: Callable[[CaseRecord], Hashable] = lambda record: (record.row, record.ego, record.draw)  # noqa: E731
    rows = tuple(
        (*_where(first), next((r.proof for r in same if r.proof), ""), first.command)
        for same in grouped(proven, key).values()
        for first in same[:1]
    )
    columns = {**_WHERE, "proof": "what clashes", "command": "run it again"}
    return Table("infeasible", "Draws proven infeasible", columns, rows, "No draw is proven infeasible.")


def _where(record: CaseRecord) -> tuple[int, str, str, str, int]:
    return record.row, record.interaction, record.trigger, record.ego, record.draw


def evidence(record: CaseRecord, folder: Path) -> str:
    """Return what is known about a case that did not succeed, one thing a line."""
    parts = _measured(record, folder)
    if not parts and record.failed_conditions:
        parts.append("failed: " + ", ".join(record.failed_conditions))
    if record.criteria_disagree:
        parts.append("judge and criteria disagree in a take")
    if record.proof and record.cause == NO_ROOM:
        parts.append("proof: " + "; ".join(record.proof.splitlines()))
    if record.message:
        parts.append(record.message)
    return "\n".join(parts)


def _measured(record: CaseRecord, folder: Path) -> list[str]:
    """Return required and measured values of all that failed in the kept run; nothing where none was kept."""
    if record.directory is None or not (folder / record.directory).is_dir():
        return []
    try:
        conditions, criteria = judge_kept(record.row, folder / record.directory).failed
    except ScenewrightError as error:
        return [f"the kept run cannot be judged again: {error.message}"]
    told = [_stated(each.text, each.required, each.measured, each.unit) for each in conditions]
    for each in criteria:
        unit = SI_SYMBOL[each.dimension] if each.dimension is not None else ""
        told.append("criterion: " + _stated(each.text, each.required, each.measured, unit))
    return told


def _stated(text: str, required: float | None, measured: float | None, unit: str) -> str:
    unit = f" {unit}" if unit else ""
    wanted = "" if required is None else f"required {required:.2f}{unit}, "
    never = measured is None or not math.isfinite(measured)
    return f"{text} ({wanted}{'never came about' if never else f'measured {measured:.2f}{unit}'})"
