"""Counts what came of cases: rates for the first take and for the best of all, causes, disagreements.

What enters: records of cases, or anything else that says its cause. What leaves: a `Tally` a group, and plain data. One
rule for command and report: proven infeasible cases and cases whose ego never met the condition are left out of rates
and shown beside them, never hidden.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import asdict, dataclass, field
from itertools import chain
from typing import Any, Protocol, TypeVar

from scenewright.study.causes import EGO_DENIED, INFEASIBLE, NOT_OURS
from scenewright.study.naturalness import Naturalness, naturalness
from scenewright.study.store import CaseRecord

LEVEL_NAMES = ("fine", "tight", "loose", "coarse")
TAKES = ("first", "best")


class Counted(Protocol):
    """What a tally asks of a case."""

    @property
    def cause(self) -> str:
        """Of `causes.CAUSES`, within all takes."""

    @property
    def first_cause(self) -> str:
        """The same for the first take alone."""

    @property
    def criteria_disagree(self) -> bool:
        """Whether judge and criteria differ."""

    def holds(self, which: str, level: str) -> bool:
        """Whether it is a success at a level of tolerance: `which` is ``first`` or ``best``."""


C = TypeVar("C", bound=Counted)
K = TypeVar("K", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Rate:
    """So many successes out of so many cases."""

    successes: int
    total: int

    @property
    def value(self) -> float | None:
        """The share, 0 to 1; None where there are no cases."""
        return self.successes / self.total if self.total else None

    @property
    def interval(self) -> tuple[float, float] | None:
        """Wilson's interval for the share, 95 %; None where there are no cases.

        Examples
        --------
        >>> [round(bound, 3) for bound in Rate(10, 10).interval]
        [0.722, 1.0]
        """
        if not self.total:
            return None
        z, share = 1.959964, self.successes / self.total
        scale = 1.0 + z * z / self.total
        middle = (share + z * z / (2 * self.total)) / scale
        half = z * math.sqrt(share * (1 - share) / self.total + z * z / (4 * self.total**2)) / scale
        return max(0.0, middle - half), min(1.0, middle + half)

    def __str__(self) -> str:
        return "-" if self.value is None else percent(self.value)


def percent(share: float) -> str:
    """Return a share as people read it; 100 % and 0 % only where they are exact.

    >>> percent(0.9996), percent(1.0), percent(0.974)
    ('99.9 %', '100 %', '97.4 %')
    """
    if share in (0.0, 1.0):
        return f"{100 * share:.0f} %"
    return f"{min(99.9, max(0.1, 100 * share)):.1f} %"


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

    def add(self, case: Counted) -> None:
        """Count one more case."""
        self.cases += 1
        self.disagreements += case.criteria_disagree
        self.causes["first"][case.first_cause] += 1
        self.causes["best"][case.cause] += 1
        if case.cause not in NOT_OURS:
            self.hits.update((which, level) for which in TAKES for level in LEVEL_NAMES if case.holds(which, level))

    @property
    def rated(self) -> int:
        """Among how many cases rates count, those of the first take and those of all alike."""
        return self._without(NOT_OURS)

    def rate(self, which: str, level: str = "tight") -> Rate:
        """Return the successes of the first or the best take at a level of tolerance, among those that count."""
        return Rate(self.hits[which, level], self.rated)

    def rate_without(self, *causes: str) -> Rate:
        """Return the tight successes, best take, among the cases that fell under none of these causes."""
        return Rate(self.hits["best", "tight"], self._without(causes))

    @property
    def rate_where_let(self) -> Rate:
        """The tight successes, best take, among the cases in which the ego left room for one."""
        return self.rate_without(INFEASIBLE, *EGO_DENIED)

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
                    **{level: self.rate(which, level).value for level in LEVEL_NAMES},
                    "causes": dict(self.causes[which]),
                }
                for which in TAKES
            },
            "tight_where_ego_left_room": self.rate_where_let.value,
            "disagreements": self.disagreements,
        }


def tally(cases: Iterable[Counted], name: str = "all") -> Tally:
    """Return the tally of all cases together."""
    made = Tally(name)
    for case in cases:
        made.add(case)
    return made


def tally_by(cases: Iterable[C], key: Callable[[C], str], total: str = "all") -> list[Tally]:
    """Return a tally for each value of `key`, in order of first appearance, and one for all (no `total`: none)."""
    groups = grouped(cases, key)
    tallies = [tally(group, name) for name, group in groups.items()]
    return [*tallies, tally(chain(*groups.values()), total)] if total else tallies


def grouped(cases: Iterable[C], key: Callable[[C], K]) -> dict[K, list[C]]:
    """Return the cases by key, in order of first appearance."""
    groups: dict[K, list[C]] = {}
    for case in cases:
        groups.setdefault(key(case), []).append(case)
    return groups


def failures(records: Iterable[CaseRecord]) -> list[CaseRecord]:
    """Return the cases that are neither a success nor somebody else's doing."""
    return [record for record in records if record.cause != "success" and record.cause not in NOT_OURS]


def disagreements(records: Iterable[CaseRecord]) -> list[CaseRecord]:
    """Return the cases in which the judge and the row's own criteria differ at the tight tolerance."""
    return [record for record in records if record.criteria_disagree]


def naturalness_by(records: Iterable[CaseRecord], key: Callable[[CaseRecord], str]) -> dict[str, Naturalness]:
    """Return how natural the successes of each group are up to their triggers."""
    groups = grouped((record for record in records if record.cause == "success"), key)
    return {name: naturalness(group) for name, group in groups.items()}


def summary(records: Sequence[CaseRecord]) -> dict[str, Any]:
    """Return all tables of a set of results as plain data: by method, and for each method by ego, family and row."""
    keys: dict[str, Callable[[CaseRecord], str]] = {
        "by_ego": lambda record: record.ego,
        "by_family": lambda record: record.family,
        "by_row": lambda record: str(record.row),
    }
    own = grouped(records, lambda record: record.method)
    return {
        "cases": len(records),
        "by_method": [tally(some, method).as_dict() for method, some in own.items()],
        "methods": {
            method: {name: [each.as_dict() for each in tally_by(some, key)] for name, key in keys.items()}
            for method, some in own.items()
        },
        "natural": {
            method: {name: asdict(each) for name, each in naturalness_by(some, lambda r: r.ego).items()}
            | {"all": asdict(naturalness(r for r in some if r.cause == "success"))}
            for method, some in own.items()
        },
        "failures": [_told(record) for record in failures(records)],
        "disagreements": [_told(record) for record in disagreements(records)],
    }


def _told(record: CaseRecord) -> dict[str, Any]:
    names = ("case", "cause", "failed_conditions", "message", "command")
    return {name: getattr(record, name) for name in names}
