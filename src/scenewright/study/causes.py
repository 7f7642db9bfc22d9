"""Under which cause a result is counted: what was asked for, what the text or the ego denied, and what we missed.

What enters: a `Result`, or how single takes were judged. What leaves: one of `CAUSES`. Nothing is judged here.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scenewright.request import Result

INFEASIBLE = "proven infeasible"
NEVER_MET = "ego never met the condition"
NO_ROOM = "ego left no room"
# In the order in which tables show them: what was asked for, then the text's and the ego's doing, then ours.
CAUSES = (
    "success",
    "loose only",
    INFEASIBLE,
    NEVER_MET,
    NO_ROOM,
    "missed",
    "gave up",
    "error",
)
# What no orchestrator can be blamed for: rates leave these out of what they count among.
NOT_OURS = (INFEASIBLE, NEVER_MET)
# What the ego denied by the way it drove; evidence about one drive, so rates state it beside the first.
EGO_DENIED = (NEVER_MET, NO_ROOM)
# Of several takes a case is counted under the first of these: our own misses before what the ego denied.
_ACROSS_TAKES = ("success", "loose only", "missed", NO_ROOM, NEVER_MET)


def cause_of(result: Result) -> str:
    """Return which of `CAUSES` a result falls under by its verdict alone."""
    from scenewright.judge.tolerance import LOOSE, TIGHT

    if result.status == "infeasible":
        return INFEASIBLE
    if result.verdict is None:
        return "gave up"
    return cause_of_take(
        tight=result.verdict.holds_at(TIGHT),
        loose=result.verdict.holds_at(LOOSE),
        never_met=bool(result.verdict.facts.get("ego_never_met_condition")),
        no_room=result.hindsight is not None,
    )


def cause_of_take(*, tight: bool, loose: bool, never_met: bool, no_room: bool) -> str:
    """Return which of `CAUSES` one judged take falls under."""
    if tight:
        return "success"
    if never_met:
        return NEVER_MET
    if no_room:
        return NO_ROOM
    return "loose only" if loose else "missed"


def cause_across(causes: Sequence[str]) -> str:
    """Return the cause under which several takes are counted together.

    >>> cause_across(["ego left no room", "missed"])
    'missed'
    """
    return min(causes, key=_ACROSS_TAKES.index)
