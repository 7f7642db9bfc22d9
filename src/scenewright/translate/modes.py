"""Decides which events of a sentence are told, which are conditions ("when") and which are bounds ("before", "after").

What enters: the events of one sentence with their links. What leaves: the same events with their modes set.
"""

from __future__ import annotations

from scenewright.translate.events import Event

STATIVE = ("be", "sit", "ttc", "drive", "approach", "wait")


def resolve_modes(events: list[Event]) -> None:
    """Decide for the events of one sentence which are conditions, which are bounds in order, and which are told."""
    previous: Event | None = None
    outer: str | None = None  # the mode of the clause that a relative clause interrupts
    for event in events:
        links = set(event.links)
        opening = (
            "when" if "when" in links else "before" if "before" in links else "after" if "after" in links else None
        )
        if "until" in links:
            opening = "until"
        if "that" in links:
            outer = opening or (previous.mode if previous is not None else "main")
            event.mode = "main"
        elif outer is not None and not event.explicit and links == {"and"}:
            event.mode = "main"
        elif outer is not None and not event.explicit and links <= {"comma"} and opening is None:
            event.mode, outer = outer, None
        elif opening is not None:
            event.mode = opening
        elif previous is not None and _stays_condition(previous, event, links):
            event.mode = previous.mode
        else:
            event.mode = "main"
        previous = event


def _stays_condition(previous: Event, event: Event, links: set[str]) -> bool:
    if "then" in links or "then_label" in links:
        return False
    if not links or links <= {"to"}:
        return previous.mode in ("when", "before", "after", "until") and event.actor == previous.actor
    if previous.mode != "when":
        return False
    if event.verb in STATIVE:
        return bool(event.places or event.ttc or event.speed)
    return event.verb in ("reach", "pass", "enter") and links == {"and"}
