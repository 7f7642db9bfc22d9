"""Changes of what a text means, made automatically: one word, number or name exchanged for another of its kind.

Roles, orders, sides, bounds, deeds, places, numbers, units and people; something denied, and something put in that no
program can say.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

# Words whose exchange turns the meaning; each is tried at every place where it stands, in both directions.
PAIRS = (
    ("before", "past"), ("before the ego", "after the ego"), ("before the hero", "after the hero"),
    ("at least", "at most"), ("more than", "less than"), ("left", "right"), ("within", "beyond"),
    ("north", "south"), ("west", "east"), ("westbound", "eastbound"), ("stop line", "conflict point"),
    ("faster", "slower"), ("always", "never"), ("begins to", "finishes"), ("earlier", "later"), ("first", "second"),
    ("brakes", "speeds up"), ("brake", "speed up"), ("the ego", "the hero"), ("ahead", "behind"), ("front", "rear"),
    ("acceleration", "deceleration"), ("headway", "time to collision"), ("driveway", "road"), ("short of", "past"),
    (" and ", " or "), ("either", "both"), (" until ", " when "), ("decelerate", "accelerate"), ("oncoming", "lead"),
    ("second time", "third time"), ("stops", "accelerates"), ("before", "after"),
    ("begins to turn", "completes its turn"),
)  # fmt: skip
UNITS = (("m", "ft"), ("s", "min"), ("m/s", "km/h"), ("m/s^2", "g"), ("metres", "feet"), ("km/h", "mph"))
EGO = r"(?:ego(?: vehicle| car)?|AV|SUT|VUT|(?:test|subject|automated) vehicle|vehicle under test|automated vehicle)"
HERO = (
    r"(?:hero(?: vehicle)?|NPC|POV|challenger|(?:other|target|lead|oncoming) (?:car|vehicle)|truck|van|bus|lorry|taxi|"
    r"pickup|sedan)"
)
DEEDS = r"\b(brakes|stands|drives|begins|passes|speeds|decelerates|accelerates|stops|turns|completes|is (?=at|\d))\b"
UNSAYABLE = ("twice", "on the phone", "after stopping briefly", "with its hazard lights on", "if it rains")


def changes(text: str) -> Iterator[tuple[str, str]]:
    """Yield what was changed and the changed text."""

    def at(match: re.Match[str], new: str) -> tuple[str, str]:
        return f"{match[0]} -> {new} at {match.start()}", text[: match.start()] + new + text[match.end() :]

    for one, other in PAIRS:
        for old, new in ((one, other), (other, one)):
            for match in re.finditer(rf"(?<![\w'-]){re.escape(old)}(?![\w'-])", text):
                yield at(match, new)
    for match in re.finditer(
        r"(?<![\w./-])(\d+)(?![\w./])(?= ?(m|s|m/s|m/s\^2|ft|g|min|km/h|mph|metres|feet|yards)\b)", text
    ):
        yield at(match, str(int(match[1]) + 1))
    for match in re.finditer(r"\b[a-z]+(?:_[a-z]+)+(?=_(?:m|s|mps|mpss)\b)", text):
        if text.count(match[0]) > 1 or "'" not in text:
            yield at(match, match[0] + "_x")
    for one, other in UNITS:
        for match in re.finditer(rf"(?<=\d ){re.escape(one)}(?![\w/^])", text):
            yield at(match, other)
    for match in re.finditer(DEEDS, text):
        yield f"not {match[1]} at {match.start()}", f"{text[: match.start()]}not {text[match.start() :]}"
        if "is" not in match[0]:
            for put_in in UNSAYABLE:
                yield f"{match[0]} {put_in} at {match.start()}", f"{text[: match.end()]} {put_in}{text[match.end() :]}"
    for one, others in ((EGO, HERO), (HERO, EGO)):
        other = re.search(rf"\b{others}\b", text)
        for match in re.finditer(rf"\b{one}\b(?! ')", text):
            if other is not None and "'" not in text:
                yield at(match, other[0])
            yield at(match, "cyclist")
