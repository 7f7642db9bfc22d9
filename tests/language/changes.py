"""Changes of what a text means, made automatically: one word, number or name exchanged for another of its kind."""

from __future__ import annotations

import re
from collections.abc import Iterator

# Words whose exchange turns the meaning; each is tried at every place where it stands, in both directions.
PAIRS = (
    ("before", "past"), ("before the ego", "after the ego"), ("before the hero", "after the hero"),
    ("at least", "at most"), ("more than", "less than"), ("left", "right"),
    ("north", "south"), ("west", "east"), ("stop line", "conflict point"),
    ("faster", "slower"), ("always", "never"), ("begins to", "finishes"),
    ("brakes", "speeds up"), ("brake", "speed up"), ("the ego", "the hero"),
    ("acceleration", "deceleration"), ("headway", "time to collision"), ("driveway", "road"),
    (" and ", " or "), ("either", "both"), (" until ", " when "),
    ("second time", "third time"),
)  # fmt: skip
UNITS = (("m", "ft"), ("s", "min"), ("m/s", "km/h"), ("m/s^2", "g"))


def changes(text: str) -> Iterator[tuple[str, str]]:
    """Yield what was changed and the changed text."""
    for one, other in PAIRS:
        for old, new in ((one, other), (other, one)):
            for match in re.finditer(rf"(?<![\w']){re.escape(old)}(?![\w'])", text):
                yield f"{old} -> {new} at {match.start()}", text[: match.start()] + new + text[match.end() :]
    for match in re.finditer(r"(?<![\w./-])(\d+)(?![\w./])(?= (m|s|m/s|m/s\^2|ft|g|min|km/h)\b)", text):
        yield f"{match[1]} + 1 at {match.start()}", f"{text[: match.start()]}{int(match[1]) + 1}{text[match.end() :]}"
    for one, other in UNITS:
        for match in re.finditer(rf"(?<=\d ){re.escape(one)}(?![\w/^])", text):
            yield f"{one} -> {other} at {match.start()}", text[: match.start()] + other + text[match.end() :]
    for match in re.finditer(r"\b(brakes|stands|drives|begins|passes|speeds|is (?=at|\d))\b", text):
        yield f"not {match[1]} at {match.start()}", f"{text[: match.start()]}not {text[match.start() :]}"
