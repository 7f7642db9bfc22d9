"""Finds what an abbreviation stands for that a text brings in for a vehicle: "an interacting vehicle (IV)".

What enters: the text. What leaves: the text with an abbreviation that everybody knows in its place ("AV", "OV"), every
other character where it was.
"""

from __future__ import annotations

import re

_EGOS = (
    r"(?:ego(?: vehicle| car)?|subject|(?:(?:automated|autonomous|robotic|self-driving) )?(?:car|vehicle|one) "
    r"(?:under test|being tested)|AV|ADS|SUT|VUT|"
    r"(?:subject|test|tested|host|own) (?:car|vehicle))"
)
# "An interacting vehicle (IV)"
_BROUGHT_IN = re.compile(
    r"\b((?:[a-z-]+ ){0,3}(?:vehicle|car|agent|actor|user|driver|party|test|target|van|truck)) \((?-i:([A-Z]{2,4}))\)",
    re.I,
)
_KNOWN = frozenset(
    ["UUT", "EUT", "DUT", "HAV", "ADS", "CAV", "AV", "OV", "SV", "POV", "NPC", "EGO", "VUT", "SUT", "GVT", "TTC", "TTA"]
)


def without_short_names(text: str) -> str:
    """Return the text in which an abbreviation that it brings in for a vehicle is one that everybody knows.

    >>> without_short_names("An interacting vehicle (IV) goes west. The IV brakes.")
    'An interacting vehicle      goes west. The OV brakes.'
    """
    for found in _BROUGHT_IN.finditer(text):
        brought = re.compile(rf" \\({found.group(2)}\\)")
        text = brought.sub(lambda each: " " * len(each.group()), text, count=1)
        short = found.group(2)
        ego = re.search(rf"{_EGOS}$|(?:under test|of interest)$", found.group(1), re.I) is not None
        if short in _KNOWN:
            continue
        name = {2: "AV" if ego else "OV", 3: "ego" if ego else "POV", 4: "ego " if ego else "hero"}[len(short)]
        first = re.compile(rf" \({short}\)")
        text = first.sub(lambda each: " " * len(each.group()), text, count=1)
        text = re.sub(rf"\b{short}\b", name, text)
    return text
