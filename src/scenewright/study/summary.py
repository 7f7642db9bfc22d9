"""Counts records of an experiment: rates for the first take and for the best of all, causes, disagreements.

What enters: records. What leaves: a `Tally` a group, and plain data. Every rate says what it was counted among: proven
infeasible cases and cases whose ego never met the condition are left out and shown beside it, never hidden.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from scenewright.study.causes import EGO_DENIED, NOT_OURS
from scenewright.study.store import CaseRecord

LEVEL_NAMES = ("fine", "tight", "loose", "coarse")
TAKES = ("first", "best")


@dataclass(slots=True)
class Tally:
    """What came of a group of cases.

    Attributes
    ----------
    causes
        Number of cases by cause; by ``first`` (take) and ``best`` (of all takes).
    hits
        Number of successes by (``first`` or ``best``, level of tolerance), among those that `rated` counts.
    """

    name: str
    cases: int = 0
    causes: dict[str, Counter[str]] = field(default_factory=lambda: {which: Counter() for which in TAKES})
    hits: Counter[tuple[str, str]] = field(default_factory=Counter)
    disagreements: int = 0

    def add(self, record: CaseRecord) -> None:
        """Count one more case."""
        self.cases += 1
        self.disagreements += record.criteria_disagree
        self.causes["first"][record.first_cause] += 1
        self.causes["best"][record.cause] += 1
        if record.cause not in NOT_OURS:
            self.hits.update((which, level) for which in TAKES for level in LEVEL_NAMES if record.holds(which, level))

    @property
    def rated(self) -> int:
        """Among how many cases rates count, those of the first take and those of all alike."""
        return self._without(NOT_OURS)

    def rate(self, which: str, level: str) -> float | None:
        """Return the share of successes; None where there is nothing to count among."""
        return self.hits[which, level] / self.rated if self.rated else None

    @property
    def rate_where_let(self) -> float | None:
        """Return the share of tight successes, best take, among the cases in which the ego left room for one."""
        among = self._without(("proven infeasible", *EGO_DENIED))
        return self.hits["best", "tight"] / among if among else None

    def _without(self, causes: Sequence[str]) -> int:
        return self.cases - sum(self.causes["best"][cause] for cause in causes)

    def as_dict(self) -> dict[str, Any]:
        """Return the tally as plain data."""
        return {
            "name": self.name,
            "cases": self.cases,
            "rated": self.rated,
            **{
                which: {
                    **{level: self.rate(which, level) for level in LEVEL_NAMES},
                    "causes": dict(self.causes[which]),
                }
                for which in TAKES
            },
            "tight_where_ego_left_room": self.rate_where_let,
            "disagreements": self.disagreements,
        }


def tally_by(records: Iterable[CaseRecord], key: Callable[[CaseRecord], str], total: str = "all") -> list[Tally]:
    """Return a tally for each value of `key`, in order of first appearance, and one for all (no `total`: none)."""
    groups: dict[str, Tally] = {}
    everything = Tally(total)
    for record in records:
        name = key(record)
        groups.setdefault(name, Tally(name)).add(record)
        everything.add(record)
    return [*groups.values(), everything] if total else list(groups.values())


def failures(records: Iterable[CaseRecord]) -> list[CaseRecord]:
    """Return the cases that are neither a success nor somebody else's doing."""
    return [record for record in records if record.cause != "success" and record.cause not in NOT_OURS]


def disagreements(records: Iterable[CaseRecord]) -> list[CaseRecord]:
    """Return the cases in which the judge and the row's own criteria differ at the tight tolerance."""
    return [record for record in records if record.criteria_disagree]


def summary(records: Sequence[CaseRecord]) -> dict[str, Any]:
    """Return all tables of a set of results as plain data: by method, and for each method by ego, family and row."""
    methods = dict.fromkeys(record.method for record in records)
    return {
        "cases": len(records),
        "by_method": [tally.as_dict() for tally in tally_by(records, lambda r: r.method, total="")],
        "methods": {
            method: {
                "by_ego": _plain(own, lambda r: r.ego),
                "by_family": _plain(own, lambda r: r.family),
                "by_row": _plain(own, lambda r: str(r.row)),
            }
            for method in methods
            for own in [[record for record in records if record.method == method]]
        },
        "failures": [_told(record) for record in failures(records)],
        "disagreements": [_told(record) for record in disagreements(records)],
    }


def _plain(records: Sequence[CaseRecord], key: Callable[[CaseRecord], str]) -> list[dict[str, Any]]:
    return [tally.as_dict() for tally in tally_by(records, key)]


def _told(record: CaseRecord) -> dict[str, Any]:
    return {
        "case": record.case,
        "cause": record.cause,
        "failed_conditions": record.failed_conditions,
        "message": record.message,
        "command": record.command,
    }
