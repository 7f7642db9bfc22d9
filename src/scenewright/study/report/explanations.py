"""What the causes of outcomes mean, in words and in colours.

What enters: a cause, a record. What leaves: its explanation and its colour.
"""

from __future__ import annotations

from scenewright.study.report.records import in_order
from scenewright.study.store import CaseRecord

# In the order in which tables and legends show them. Colours follow Okabe and Ito: told apart by the colour-blind too.
LATER = "success in a later take"
CAUSES: dict[str, tuple[str, str]] = {
    "success": ("#0072b2", "Judge and criteria hold at tight tolerance."),
    "loose only": ("#f0e442", "Every condition holds at loose tolerance, one or more miss the tight one. Ours."),
    "missed": ("#d55e00", "A condition misses the loose tolerance, and nothing proves that it had to. Ours."),
    "gave up": ("#1a1a1a", "No first plan was found in time, and no proof that there is none. Ours."),
    "error": ("#cc79a7", "The run was cut short by a fault; the message says which."),
    "ego left no room": (
        "#009e73",
        "Proven afterwards: against the ego as it drove, no hero within its limits could have met all conditions, "
        "even with the tight tolerance given away. Counted as a failure.",
    ),
    "ego never met the condition": (
        "#e69f00",
        "The trace shows that the ego never came within the tight tolerance of its side of the trigger. Not counted.",
    ),
    "proven infeasible": (
        "#b8bec6",
        "Proven before the run: no ego within its promises and no hero within its limits can do it. Nothing is driven, "
        "not counted; the proof is listed.",
    ),
}
LATER_COLOUR = "#7fc4ee"
UNKNOWN_COLOUR = "#999999"


def colour_of(cause: str) -> str:
    """Return the colour that figures and page give a cause."""
    if cause == LATER:
        return LATER_COLOUR
    return CAUSES[cause][0] if cause in CAUSES else UNKNOWN_COLOUR


def meaning_of(cause: str) -> str:
    """Return what a cause means."""
    return CAUSES[cause][1] if cause in CAUSES else ""


def ordered_causes(present: set[str]) -> list[str]:
    """Return the causes that occur, in the order of tables."""
    return in_order(tuple(CAUSES), present)


def shown_cause(record: CaseRecord) -> str:
    """Return the cause, with successes told apart by whether the first take was one."""
    if record.cause == "success" and not record.first_tight:
        return LATER
    return record.cause
