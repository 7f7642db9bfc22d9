"""What of many things clashes: those that cannot be left out.

What enters: things that clash together, and a way to ask whether some of them still do. What leaves: fewer of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

Item = TypeVar("Item")


def needed(items: Sequence[Item], clash: Callable[[list[Item]], bool]) -> list[Item]:
    """Return what of `items` is needed for a clash: all but what is found superfluous."""
    kept = list(items)
    for item in items:
        fewer = [other for other in kept if other is not item]
        if clash(fewer):
            kept = fewer
    return kept
