"""How successes are counted: which cases a rate is over, and the rates themselves.

What enters: records. What leaves: counts and rates with their confidence interval. One rule for every method, table and
figure; it is stated in `RULES`, which the report prints.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from scenewright.study.causes import NOT_OURS
from scenewright.study.store import CaseRecord

Which = Literal["first", "best"]
INFEASIBLE = "proven infeasible"
NEVER_MET = "ego never met the condition"
NO_ROOM = "ego left no room"
RULES = (
    "A case is one row of the benchmark, one ego, one draw of parameters, one method. Every method gets the same "
    "cases, egos, seeds and judge.",
    "A success holds for the judge (which reads program and trace) and for the row's own criteria (which read the "
    "taxonomy and the trace). One of them alone does not count.",
    "Rates leave out two causes, and only these: proven infeasible (the solver proved that no ego within its promises "
    "and no hero within its limits can do it; nothing is driven) and ego never met the condition (the trace shows that "
    "the ego never came within the tight tolerance of its own side of the trigger). Both are listed with evidence.",
    "First take: planned with prediction alone. Best of N: a case that missed is driven again, knowing how this ego "
    "drove; each take is a whole closed-loop run, judged alike. Both rates are over the same cases.",
    "Cases in which the ego left no room (proven against the ego as it drove) count as failures in every rate, unless "
    "the column says where the ego let it.",
    "Tight is 0.5 m, 0.1 s, 0.25 m/s, 0.25 m/s²; loose is 2 m, 0.5 s, 1 m/s, 1 m/s². Fine is 0.1 m, 0.02 s; coarse is "
    "5 m, 1 s. Intervals are Wilson's, 95 %.",
)


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
        return "–" if self.value is None else percent(self.value)


def percent(share: float) -> str:
    """Return a share as text: 100 % and 0 % only where they are exact.

    Examples
    --------
    >>> percent(1.0), percent(0.9996), percent(0.974)
    ('100 %', '99.9 %', '97.4 %')
    """
    if share in (0.0, 1.0):
        return f"{share:.0%}".replace("%", " %")
    return f"{min(99.9, max(0.1, 100 * share)):.1f} %"


def counted(records: Iterable[CaseRecord], without: Sequence[str] = NOT_OURS) -> list[CaseRecord]:
    """Return the records that a rate is over."""
    return [record for record in records if record.cause not in without]


def rate(records: Iterable[CaseRecord], which: Which, level: str = "tight", without: Sequence[str] = NOT_OURS) -> Rate:
    """Return how often it worked, in the first or the best take, at a level of tolerance."""
    over = counted(records, without)
    held = sum(record.holds(which, level) for record in over)
    return Rate(held, len(over))


def causes(records: Iterable[CaseRecord], which: Which = "best") -> Counter[str]:
    """Return how many cases fell under which cause."""
    return Counter(record.cause if which == "best" else record.first_cause for record in records)
