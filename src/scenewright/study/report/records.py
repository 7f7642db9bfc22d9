"""What figures and tables ask of a case, and the order in which they show methods and egos.

What enters: records of the store. What leaves: single quantities of them, groups, names in order. Nothing is counted.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Hashable, Iterable
from typing import Any, TypeVar

from scenewright.study.rivals import METHODS
from scenewright.study.store import CaseRecord

OURS = "scenewright"
LEVEL_TEXT = ("0.1 m\n0.02 s", "0.5 m\n0.1 s", "2 m\n0.5 s", "5 m\n1 s")
_EGOS = ("constant", "idm", "dawdler", "speeder", "delayed", "noisy", "stop-and-go", "staller")
Key = TypeVar("Key", bound=Hashable)


def trigger_error(record: CaseRecord) -> float | None:
    """Return the larger of both sides' errors at the trigger, in m or s as stated; None where it was not judged."""
    sides = (record.ego_trigger_error, record.hero_trigger_error)
    known = [abs(side) for side in sides if side is not None]
    return max(known) if known else None


def parameter_values(record: CaseRecord) -> dict[str, Any]:
    """Return the drawn parameters by name, each in the unit of its name."""
    return dict(json.loads(record.parameters)) if record.parameters else {}


def first_success(record: CaseRecord) -> int | None:
    """Return the take in which a case first succeeded at tight tolerance; None where none did."""
    if record.first_tight:
        return 1
    return max(2, record.take) if record.best_tight else None


def grouped(records: Iterable[CaseRecord], key: Callable[[CaseRecord], Key]) -> dict[Key, list[CaseRecord]]:
    """Return the records by key, keys in the order in which they occur."""
    groups: dict[Key, list[CaseRecord]] = {}
    for record in records:
        groups.setdefault(key(record), []).append(record)
    return groups


def methods_of(records: Iterable[CaseRecord]) -> list[str]:
    """Return the methods that occur, ours first."""
    return in_order(tuple(METHODS), {record.method for record in records})


def egos_of(records: Iterable[CaseRecord]) -> list[str]:
    """Return the egos that occur, calm ones first."""
    return in_order(_EGOS, {record.ego for record in records})


def in_order(order: tuple[str, ...], present: set[str]) -> list[str]:
    """Return the names present: those with a place in `order` there, the others after them by name."""
    return [name for name in order if name in present] + sorted(present - set(order))
