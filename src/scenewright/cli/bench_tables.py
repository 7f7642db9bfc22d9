"""What people read of an experiment: rates, causes, failures with the command that runs each again.

What enters: results and comparisons. What leaves: lines on a console. Nothing is counted here.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.text import Text

from scenewright.cli.tables import table
from scenewright.study.causes import CAUSES
from scenewright.study.summary import Tally, disagreements, failures, tally_by

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from scenewright.study.compare import Comparison, Pair
    from scenewright.study.store import CaseRecord, Results

_SHOWN = 12
_CAUSES = {
    "proven infeasible": "not\npossible",
    "ego never met the condition": "never\nmet",
    "ego left no room": "no\nroom",
    "loose only": "loose\nonly",
}
_WEAK = 0.85
_RATES = (("tight\nfirst", "first", "tight"), ("tight\nbest", "best", "tight"))
_LOOSE = (("loose\nfirst", "first", "loose"), ("loose\nbest", "best", "loose"))


def print_summary(console: Console, results: Results) -> None:
    """Print the tables of an experiment."""
    records = results.records()
    methods = dict.fromkeys(record.method for record in records)
    takes = results.settings.get("takes", 1)
    console.print(f"{len(records)} cases; takes: the first, and the best of at most {takes}")
    console.print("rates leave out what is proven infeasible, and egos that never met the condition")
    console.print("ego let it: tight, best take, without the cases in which the ego left no room\n")
    if len(methods) > 1:
        console.print(rates("method", tally_by(records, lambda r: r.method, total="")))
        console.print(causes("method", tally_by(records, lambda r: r.method, total="")))
    lead = next(iter(methods), "")
    own = [record for record in records if record.method == lead]
    if len(methods) > 1:
        console.print(f"of {lead}:", style="bold")
    console.print(rates("ego", tally_by(own, lambda r: r.ego)))
    console.print(rates("hero, trigger", tally_by(own, lambda r: r.family.removeprefix("Hero "), total="")))
    console.print(causes("ego", tally_by(own, lambda r: r.ego)))
    _print_weak_rows(console, own)
    _print_failures(console, own)
    _print_disagreements(console, records)
    console.print(f"results  {results.directory}", soft_wrap=True)
    console.print(f"report   scenewright bench report {results.directory}", soft_wrap=True)


def rates(by: str, tallies: Sequence[Tally]) -> Table:
    """Return success rates, with what they are counted among."""
    numbers = (
        "cases",
        "not\npossible",
        "never\nmet",
        "rated",
        *(name for name, _, _ in (*_RATES, *_LOOSE)),
        "ego\nlet it",
    )
    made = table(by, *numbers, right=numbers)
    for tally in tallies:
        best = tally.causes["best"]
        made.add_row(
            tally.name,
            str(tally.cases),
            str(best["proven infeasible"] or ""),
            str(best["ego never met the condition"] or ""),
            str(tally.rated),
            *(percent(tally.rate(which, level)) for _, which, level in (*_RATES, *_LOOSE)),
            percent(tally.rate_where_let),
        )
    return made


def causes(by: str, tallies: Sequence[Tally]) -> Table:
    """Return how many cases fell under which cause in the best take; in brackets the first take where it differs."""
    used = [cause for cause in CAUSES if any(tally.causes[which][cause] for tally in tallies for which in tally.causes)]
    columns = [_CAUSES.get(cause, cause) for cause in used]
    made = table(by, *columns, right=columns)
    for tally in tallies:
        cells = []
        for cause in used:
            best, first = tally.causes["best"][cause], tally.causes["first"][cause]
            cells.append(f"{best} ({first})" if best != first else str(best or ""))
        made.add_row(tally.name, *cells)
    return made


def percent(share: float | None) -> str:
    """Return a share as people read it; 100 % and 0 % only where they are exact.

    >>> percent(0.9996), percent(1.0), percent(None)
    ('99.9 %', '100 %', '-')
    """
    if share is None:
        return "-"
    if share in (0.0, 1.0):
        return f"{100 * share:.0f} %"
    return f"{min(99.9, max(0.1, 100 * share)):.1f} %"


def _print_weak_rows(console: Console, records: Sequence[CaseRecord]) -> None:
    weak = [
        (share, tally)
        for tally in tally_by(records, lambda r: str(r.row), total="")
        if (share := tally.rate("best", "tight")) is not None and share < _WEAK
    ]
    if weak:
        told = ", ".join(f"{tally.name} ({percent(share)})" for share, tally in sorted(weak, key=lambda each: each[0]))
        console.print(f"rows under {100 * _WEAK:.0f} %, best take: {told}\n")


def _print_failures(console: Console, records: Sequence[CaseRecord]) -> None:
    missed = failures(records)
    if not missed:
        return
    console.print(f"failures: {len(missed)}, each with what runs it again", style="bold")
    for record in missed[:_SHOWN]:
        what = ", ".join(record.failed_conditions) or record.message
        console.print(f"{record.case}: {record.cause} ({what})", soft_wrap=True)
        console.print(f"  {record.command}", soft_wrap=True)
    if len(missed) > _SHOWN:
        console.print(f"... and {len(missed) - _SHOWN} more; --json lists all")
    console.print()


def _print_disagreements(console: Console, records: Sequence[CaseRecord]) -> None:
    odd = disagreements(records)
    if odd:
        told = ", ".join(record.case for record in odd[:_SHOWN]) + (", ..." if len(odd) > _SHOWN else "")
        console.print(f"judge and criteria disagree in {len(odd)} cases: {told}\n", soft_wrap=True)


# -- comparisons ----------------------------------------------------------------------------------------------------
def print_comparison(console: Console, comparison: Comparison) -> None:
    """Print what changed between two sets of results."""
    from scenewright.study.compare import GROUPS, moved

    console.print(f"{len(comparison.pairs)} cases compared{_left_out(comparison)}\n")
    for by, key in GROUPS.items():
        pairs = comparison.tallies(key, total="all" if by == "method" else "")
        shown = moved(pairs) if by == "row" else pairs
        if shown and (by != "method" or len(pairs) > 1):
            console.print(_then_now(by, shown))
    _print_changes(console, "lost: successes that are none any more", comparison.lost)
    _print_changes(console, "won: successes that were none", comparison.won)
    _print_changes(console, "failed then and now, for another cause", comparison.other_cause)
    if not (comparison.lost or comparison.won or comparison.other_cause):
        console.print("no case came out differently")
    elif comparison.regressed:
        console.print(
            f"worse: {len(comparison.lost)} lost, {len(comparison.won)} won; chance {comparison.chance:.2g}",
            style="bold red",
        )
    elif comparison.lost or comparison.won:
        console.print(f"{len(comparison.lost)} lost, {len(comparison.won)} won")


def _left_out(comparison: Comparison) -> str:
    parts = [
        (len(comparison.only_then), "only in the first"),
        (len(comparison.only_now), "only in the second"),
        (len(comparison.drawn_otherwise), "drawn otherwise, so not compared"),
    ]
    told = ", ".join(f"{count} {what}" for count, what in parts if count)
    return f"; {told}" if told else ""


def _then_now(by: str, pairs: Sequence[tuple[Tally, Tally]]) -> Table:
    numbers = ("cases", *(name for name, _, _ in (*_RATES, *_LOOSE[:1])))
    made = table(by, *numbers, right=numbers)
    for then, now in pairs:
        cells = [_change(then, now, which, level) for _, which, level in (*_RATES, *_LOOSE[:1])]
        made.add_row(then.name, str(then.cases), *cells)
    return made


def _change(then: Tally, now: Tally, which: str, level: str) -> Text:
    before, after = then.rate(which, level), now.rate(which, level)
    if before == after:
        return Text(percent(after))
    better = (after or 0.0) > (before or 0.0)
    return Text(f"{percent(before)} -> {percent(after)}", style="green" if better else "red")


def _print_changes(console: Console, title: str, pairs: Sequence[Pair]) -> None:
    if not pairs:
        return
    console.print(f"{len(pairs)} {title}", style="bold")
    for then, now in pairs[:_SHOWN]:
        failed = ", ".join((now if now.cause != "success" else then).failed_conditions)
        console.print(f"{now.case}: {then.cause} -> {now.cause}" + (f" ({failed})" if failed else ""), soft_wrap=True)
        console.print(f"  {now.command}", soft_wrap=True)
    if len(pairs) > _SHOWN:
        console.print(f"... and {len(pairs) - _SHOWN} more; --json lists all")
    console.print()
