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
    interrupted: tuple[set[str], Event | None] = (set(), None)  # the clause that "waiting on the driveway" interrupts
    for event in events:
        links = set(event.links)
        if event.resumed:
            event.mode = _mode_of(event, *interrupted)
            previous, outer = event, None
            continue
        interrupted = (links - {"that"}, previous)
        opening = _opening(links)
        if "that" in links:
            outer = opening or (previous.mode if previous is not None and "and" in links else "main")
            if outer == "when" and opening is None and event.explicit and "then" in links:
                outer = "main"
            event.mode = "main"
            if previous is not None:
                continue  # what follows goes on from the clause that this one interrupts
        elif outer is not None and not event.explicit and links == {"and"}:
            event.mode = "main"
        elif outer is not None and not event.explicit and links <= {"comma"} and opening is None:
            event.mode, outer = outer, None
            event.resumed = True
        elif opening is not None:
            event.mode = opening
        elif previous is not None and _stays_condition(previous, event, links):
            event.mode = previous.mode
            if event.verb == "wait" and event.explicit and "and" not in links and _is_placed(event.actor, events):
                event.mode = "main"  # where it is was said already: "..., the car waits just before the stop line"
        else:
            event.mode = "main"
        previous = event


def _is_placed(actor: int | None, events: list[Event]) -> bool:
    return any(event.actor == actor and event.mode == "when" and event.places for event in events)


def _opening(links: set[str]) -> str | None:
    if "until" in links:
        return "until"
    return next((mode for mode in ("when", "before", "after") if mode in links), None)


def _mode_of(event: Event, links: set[str], previous: Event | None) -> str:
    """Decide for a verb whose subject was described in between, as if it stood right after its subject."""
    if opening := _opening(links):
        return opening
    return previous.mode if previous is not None and _stays_condition(previous, event, links) else "main"


def _stays_condition(previous: Event, event: Event, links: set[str]) -> bool:
    if links & {"then", "then_label", "moment", "back"}:
        return False
    if not links or links <= {"to"}:
        return previous.mode in ("when", "before", "after", "until") and event.actor == previous.actor
    if previous.mode != "when":
        return False
    if event.verb in STATIVE:
        return bool(event.places or event.ttc or event.speed)
    if event.verb == "reach" and event.explicit and event.places and "and" in links:
        return True  # "..., and, at the same time, the hero reaches a point 20 m before it"
    return event.verb in ("reach", "pass", "enter") and links == {"and"}
