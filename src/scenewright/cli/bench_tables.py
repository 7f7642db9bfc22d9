"""What people read of an experiment: rates, causes, failures with the command that runs each again.

What enters: results, comparisons, outcomes. What leaves: lines on a console. Nothing is counted here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from rich.text import Text

from scenewright.cli.tables import table
from scenewright.study.causes import CAUSES, INFEASIBLE, NEVER_MET, NO_ROOM
from scenewright.study.summary import TAKES, Tally, disagreements, failures, naturalness_by, tally, tally_by

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from scenewright.study.compare import Comparison, Pair
    from scenewright.study.evaluation import Outcome
    from scenewright.study.naturalness import Naturalness
    from scenewright.study.store import CaseRecord, Results

_SHOWN = 12
_HEADINGS = {INFEASIBLE: "not\npossible", NEVER_MET: "never\nmet", NO_ROOM: "no\nroom", "loose only": "loose\nonly"}
_WEAK = 0.85
Cells = Mapping[str, Callable[[Tally], str]]
_RATES = {f"{level}\n{which}": (which, level) for level in ("tight", "loose") for which in TAKES}


def tally_table(by: str, tallies: Sequence[Tally], cells: Cells) -> Table:
    """Return a table with a line a tally: its name, and what each of `cells` says of it."""
    made = table(by, *cells, right=tuple(cells))
    for each in tallies:
        made.add_row(each.name, *(cell(each) for cell in cells.values()))
    return made


def _rate_cells() -> Cells:
    """Return success rates, with what they are counted among."""

    def rate(which: str, level: str) -> Callable[[Tally], str]:
        return lambda each: str(each.rate(which, level))

    return {
        "cases": lambda each: str(each.cases),
        _HEADINGS[INFEASIBLE]: lambda each: str(each.causes["best"][INFEASIBLE] or ""),
        _HEADINGS[NEVER_MET]: lambda each: str(each.causes["best"][NEVER_MET] or ""),
        "rated": lambda each: str(each.rated),
        **{name: rate(*what) for name, what in _RATES.items()},
        "ego\nlet it": lambda each: str(each.rate_where_let),
    }


def _cause_cells(tallies: Sequence[Tally]) -> Cells:
    """Return how many cases fell under which cause in the best take; in brackets the first take where it differs."""

    def count(cause: str) -> Callable[[Tally], str]:
        def cell(each: Tally) -> str:
            best, first = each.causes["best"][cause], each.causes["first"][cause]
            return f"{best} ({first})" if best != first else str(best or "")

        return cell

    used = [cause for cause in CAUSES if any(each.causes[which][cause] for each in tallies for which in TAKES)]
    return {_HEADINGS.get(cause, cause): count(cause) for cause in used}


# -- an experiment --------------------------------------------------------------------------------------------------
def print_summary(console: Console, results: Results) -> None:
    """Print the tables of an experiment."""
    records = results.records
    by_method = tally_by(records, lambda r: r.method, total="")
    so_far = "" if "finished" in results.settings else " so far: it is not finished"
    console.print(
        f"{len(records)} cases{so_far}; takes: the first, and the best of at most {results.settings.get('takes', 1)}"
    )
    console.print("rates leave out what is proven infeasible, and egos that never met the condition")
    console.print("ego let it: tight, best take, without the cases in which the ego left no room\n")
    lead = by_method[0].name if by_method else ""
    if len(by_method) > 1:
        console.print(tally_table("method", by_method, _rate_cells()))
        console.print(tally_table("method", by_method, _cause_cells(by_method)))
        console.print(f"of {lead}:", style="bold")
    own = [record for record in records if record.method == lead]
    by_ego = tally_by(own, lambda r: r.ego)
    by_family = tally_by(own, lambda r: r.family.removeprefix("Hero "), total="")
    console.print(tally_table("ego", by_ego, _rate_cells()))
    console.print(tally_table("hero, trigger", by_family, _rate_cells()))
    console.print(tally_table("ego", by_ego, _cause_cells(by_ego)))
    _print_weak_rows(console, own)
    _print_natural(console, records)
    missed = failures(own)
    told = [(f"{each.cause} ({', '.join(each.failed_conditions) or each.message})", each) for each in missed]
    _print_cases(console, "failures, each with what runs it again", told)
    odd = disagreements(records)
    if odd:
        names = ", ".join(record.case for record in odd[:_SHOWN]) + (", ..." if len(odd) > _SHOWN else "")
        console.print(f"judge and criteria disagree in {len(odd)} cases: {names}\n", soft_wrap=True)
    console.print(f"results  {results.directory}", soft_wrap=True)
    console.print(f"report   scenewright bench report {results.directory}", soft_wrap=True)


def _print_natural(console: Console, records: Sequence[CaseRecord]) -> None:
    """Print how heroes drove up to their triggers in the successes of each method, for the first one by ego too."""
    by_method = naturalness_by(records, lambda r: r.method)
    lead = next(iter(by_method), None)
    by_ego = naturalness_by((r for r in records if r.method == lead), lambda r: r.ego)
    cells: dict[str, Callable[[Naturalness], str]] = {
        "successes": lambda each: str(each.runs),
        "harsh\nreversals": lambda each: _told(each.reversing, 100, " %"),
        "stand on\nthe way": lambda each: _told(each.standing, 100, " %"),
        "jerk p95\nm/s^3": lambda each: _told(each.jerk_p95_mpsss),
        "accel. p95\nm/s^2": lambda each: _told(each.accel_p95_mpss),
        "pace at\ntrigger": lambda each: _told(each.pace_median, 100, " %"),
    }
    made = table("up to the trigger", *cells, right=tuple(cells))
    for name, each in (*by_ego.items(), *by_method.items()):
        made.add_row(name, *(cell(each) for cell in cells.values()))
    console.print(made)


def _told(value: float | None, scale: float = 1.0, unit: str = "") -> str:
    return "" if value is None else f"{scale * value:.1f}{unit}"


def _print_weak_rows(console: Console, records: Sequence[CaseRecord]) -> None:
    rates = {each.name: each.rate("best") for each in tally_by(records, lambda r: str(r.row), total="")}
    shares = {name: rate.value for name, rate in rates.items() if rate.value is not None and rate.value < _WEAK}
    if shares:
        told = ", ".join(f"{name} ({rates[name]})" for name in sorted(shares, key=lambda each: shares[each]))
        console.print(f"rows under {100 * _WEAK:.0f} %, best take: {told}\n")


def _print_cases(console: Console, title: str, told: Sequence[tuple[str, CaseRecord]]) -> None:
    """Print cases, each with what is to be said of it and the command that runs it again."""
    if not told:
        return
    console.print(f"{len(told)} {title}", style="bold")
    for what, record in told[:_SHOWN]:
        console.print(f"{record.case}: {what}", soft_wrap=True)
        console.print(f"  {record.command}", soft_wrap=True)
    if len(told) > _SHOWN:
        console.print(f"... and {len(told) - _SHOWN} more; --json lists all")
    console.print()


# -- comparisons ----------------------------------------------------------------------------------------------------
def print_comparison(console: Console, comparison: Comparison) -> None:
    """Print what changed between two sets of results."""
    from scenewright.study.compare import GROUPS, moved

    console.print(f"{len(comparison.pairs)} cases compared{_left_out(comparison)}\n")
    for by, key in GROUPS.items():
        pairs = comparison.tallies(key, total="all" if by == "method" else "")
        changed = moved(pairs) if by == "row" else pairs
        if changed and (by != "method" or len(pairs) > 1):
            console.print(_then_now(by, changed))
    lost, won = comparison.lost, comparison.won
    _print_cases(console, "lost: successes that are none any more", [_turned(pair) for pair in lost])
    _print_cases(console, "won: successes that were none", [_turned(pair) for pair in won])
    other = [_turned(pair) for pair in comparison.other_cause]
    _print_cases(console, "failed then and now, for another cause", other)
    if comparison.regressed:
        told = f"worse: {len(lost)} lost, {len(won)} won; chance {comparison.chance:.2g}"
        console.print(told, style="bold red")
    elif lost or won:
        console.print(f"{len(lost)} lost, {len(won)} won")
    elif not other:
        console.print("no case came out differently")


def _left_out(comparison: Comparison) -> str:
    parts = [
        (len(comparison.only_then), "only in the first"),
        (len(comparison.only_now), "only in the second"),
        (len(comparison.drawn_otherwise), "drawn otherwise, so not compared"),
    ]
    told = ", ".join(f"{count} {what}" for count, what in parts if count)
    return f"; {told}" if told else ""


def _then_now(by: str, pairs: Sequence[tuple[Tally, Tally]]) -> Table:
    made = table(by, "cases", *_RATES, right=("cases", *_RATES))
    for then, now in pairs:
        made.add_row(then.name, str(then.cases), *(_change(then, now, *what) for what in _RATES.values()))
    return made


def _change(then: Tally, now: Tally, which: str, level: str) -> Text:
    before, after = then.rate(which, level), now.rate(which, level)
    if before.value == after.value:
        return Text(str(after))
    better = (after.value or 0.0) > (before.value or 0.0)
    return Text(f"{before} -> {after}", style="green" if better else "red")


def _turned(pair: Pair) -> tuple[str, CaseRecord]:
    then, now = pair
    failed = ", ".join((now if now.cause != "success" else then).failed_conditions)
    return f"{then.cause} -> {now.cause}" + (f" ({failed})" if failed else ""), now


# -- descriptions ---------------------------------------------------------------------------------------------------
def outcome_tallies(outcomes: Sequence[Outcome]) -> dict[str, list[Tally]]:
    """Return what came of descriptions by ego, and by description."""
    return {
        "ego": tally_by(outcomes, lambda each: each.ego),
        "description": tally_by(outcomes, lambda each: each.description),
    }


def outcome_data(each: Tally) -> dict[str, object]:
    """Return one line of the tables of descriptions as plain data."""
    return {
        "name": each.name,
        "total": each.cases,
        **each.causes["best"],
        "tight": each.rate_without(INFEASIBLE).value,
        "tight_where_ego_let_it": each.rate_where_let.value,
    }


def print_outcomes(console: Console, outcomes: Sequence[Outcome]) -> None:
    """Print the tables of descriptions, and every failure with its values."""
    cases: Cells = {"cases": lambda each: str(each.cases)}
    shares: Cells = {
        "tight, of not\nproven infeasible": lambda each: str(each.rate_without(INFEASIBLE)),
        "tight, where\nthe ego let it": lambda each: str(each.rate_where_let),
    }
    for by, tallies in outcome_tallies(outcomes).items():
        console.print(tally_table(by, tallies, {**cases, **_cause_cells([tally(outcomes)]), **shares}))
    for outcome in outcomes:
        if outcome.cause not in ("success", INFEASIBLE):
            what = ", ".join(outcome.failed_conditions) or outcome.message
            console.print(f"{outcome.description}, {outcome.ego}, draw {outcome.draw}: {outcome.cause} ({what})")
            console.print(f"  {outcome.command}", soft_wrap=True)
