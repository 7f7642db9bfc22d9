"""Compares two sets of results case by case: what got better, what got worse, and whether that can be chance.

What enters: two sets of results, the earlier first. What leaves: a `Comparison`. Only cases that both hold and that
were drawn alike are compared; the others are named.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import comb
from typing import Any

from scenewright.study.store import CaseRecord, Results
from scenewright.study.summary import Tally, tally_by

SIGNIFICANT = 0.05
Pair = tuple[CaseRecord, CaseRecord]


@dataclass(frozen=True, slots=True)
class Comparison:
    """What changed between two sets of results.

    Attributes
    ----------
    pairs
        The same case then and now.
    only_then, only_now
        Keys of cases that one of the two lacks.
    drawn_otherwise
        Keys that both hold, with other parameters or another seed: not compared.
    """

    pairs: tuple[Pair, ...]
    only_then: tuple[str, ...]
    only_now: tuple[str, ...]
    drawn_otherwise: tuple[str, ...]

    @property
    def lost(self) -> list[Pair]:
        """Cases that were a success and are none any more."""
        return [(then, now) for then, now in self.pairs if then.cause == "success" != now.cause]

    @property
    def won(self) -> list[Pair]:
        """Cases that are a success and were none."""
        return [(then, now) for then, now in self.pairs if now.cause == "success" != then.cause]

    @property
    def other_cause(self) -> list[Pair]:
        """Cases that were no success and are none, for another cause."""
        changed = [(then, now) for then, now in self.pairs if then.cause != now.cause]
        return [pair for pair in changed if "success" not in (pair[0].cause, pair[1].cause)]

    @property
    def chance(self) -> float:
        """How likely so many more cases would be lost than won if nothing had got worse (exact sign test)."""
        lost, changed = len(self.lost), len(self.lost) + len(self.won)
        return float(sum(comb(changed, k) for k in range(lost, changed + 1)) / 2**changed)

    @property
    def regressed(self) -> bool:
        """Whether more cases were lost than chance explains; fewer than five lost and none won always can be chance."""
        return len(self.lost) > len(self.won) and self.chance < SIGNIFICANT

    def tallies(self, key: Callable[[CaseRecord], str], total: str = "all") -> list[tuple[Tally, Tally]]:
        """Return then and now for each group."""
        then = tally_by((pair[0] for pair in self.pairs), key, total)
        now = {tally.name: tally for tally in tally_by((pair[1] for pair in self.pairs), key, total)}
        return [(tally, now[tally.name]) for tally in then]

    def as_dict(self) -> dict[str, Any]:
        """Return the comparison as plain data."""
        return {
            "compared": len(self.pairs),
            "only_then": list(self.only_then),
            "only_now": list(self.only_now),
            "drawn_otherwise": list(self.drawn_otherwise),
            "lost": [_change(pair) for pair in self.lost],
            "won": [_change(pair) for pair in self.won],
            "other_cause": [_change(pair) for pair in self.other_cause],
            "chance": self.chance,
            "regressed": self.regressed,
            **{
                f"by_{name}": [
                    {"name": then.name, "then": then.as_dict(), "now": now.as_dict()} for then, now in self.tallies(key)
                ]
                for name, key in GROUPS.items()
            },
        }


GROUPS: dict[str, Callable[[CaseRecord], str]] = {
    "method": lambda record: record.method,
    "ego": lambda record: record.ego,
    "row": lambda record: str(record.row),
}


def compare(then: Results, now: Results) -> Comparison:
    """Compare two sets of results."""
    before = {record.case: record for record in then.records}
    after = {record.case: record for record in now.records}
    both = [key for key in before if key in after]
    alike = [key for key in both if _drawn_alike(before[key], after[key])]
    return Comparison(
        tuple((before[key], after[key]) for key in alike),
        tuple(key for key in before if key not in after),
        tuple(key for key in after if key not in before),
        tuple(key for key in both if key not in set(alike)),
    )


def _drawn_alike(then: CaseRecord, now: CaseRecord) -> bool:
    return (then.parameters, then.seed, then.ego) == (now.parameters, now.seed, now.ego)


def _change(pair: Pair) -> dict[str, Any]:
    then, now = pair
    return {
        "case": now.case,
        "then": then.cause,
        "now": now.cause,
        "failed_conditions": now.failed_conditions or then.failed_conditions,
        "command": now.command,
    }


def moved(pairs: Sequence[tuple[Tally, Tally]]) -> list[tuple[Tally, Tally]]:
    """Return the groups in which something changed."""
    return [(then, now) for then, now in pairs if then.hits != now.hits or then.rated != now.rated]
