"""Finds who "car A", "V2" and "Party B" are, where a text says which of two such names is the ego.

What enters: the text. What leaves: the text with plain names in their place ("AV", "OV", "ego", "hero"), every other
character where it was; and single letters with whom they stand for, which `layout` names where they act.
"""

from __future__ import annotations

import re

from scenewright.translate.declared import with_declared

_KINDS = (
    r"(?:car|vehicle|actor|agent|driver|party|participant|player|unit|body|object|machine|traffic participant"
    r"|road user)"
)
_LETTERED = re.compile(rf"\b(?:the )?{_KINDS} ([A-HP-TX-Z]|\d|one|two)\b(?! ?(?:m|s|ft|yd|km/h|mph)\b)", re.IGNORECASE)
_NUMBERED = re.compile(r"\b(?!T\d)([A-Z][A-Za-z]{0,3}[-_]?\d)\b(?!\s*=\s*\d)")
_EGOS = (
    r"(?:ego(?: vehicle| car)?|subject|(?:(?:automated|autonomous|robotic|self-driving) )?(?:car|vehicle|one) "
    r"(?:under test|being tested)|AV|ADS|SUT|VUT|"
    r"(?:subject|test|tested|host|own) (?:car|vehicle))"
)
# "The exiting vehicle, which is the ego, ...", "Rear car = vehicle under test"
_CALLED = re.compile(
    r"\b((?:[a-z]+ing |[a-z]+-turning |rear |front |first |second |lead |white |black |red |blue |green |gr[ae]y "
    r"|silver "
    r"|yellow |orange |brown |dark |older |newer |smaller |larger )(?:vehicle|car))"
    rf"(?:,? which is (?:the |our )?|,? being (?:the |our )?| ?= ?(?:the |our )?| \((?:the |our )?|, (?:the |our"
    rf" )(?=[\w ]+,)){_EGOS}\b",
    re.IGNORECASE,
)
# "An interacting vehicle (IV)"
_BROUGHT_IN = re.compile(
    r"\b((?:[a-z-]+ ){0,3}(?:vehicle|car|agent|actor|user|driver|party|test|target|van|truck)) \((?-i:([A-Z]{2,4}))\)",
    re.I,
)
# "Traffic (one car): ..."
_TRAFFIC = re.compile(r"\btraffic( \((?:one|a single|a|1) (?:other )?(?:car|vehicle|van|truck|lorry)\))", re.IGNORECASE)
_IS = r"(?:['\u2019]s|,? which is|,? being| is|,|:| =|)\s*\(?(?:the |our )?"


def without_aliases(text: str) -> str:
    """Return the text in which numbered and lettered vehicles have plain names.

    >>> without_aliases("V1 (vehicle under test) goes west. V2 turns left. V2 brakes.")
    'AV                      goes west. OV turns left. OV brakes.'
    """
    text = with_declared(without_short_names(text))
    if found := _TRAFFIC.search(text):
        text = text[: found.start(1)] + " " * len(found.group(1)) + text[found.end(1) :]
        text = re.sub(r"\btraffic\b", "target ", text, flags=re.IGNORECASE)
    for name in {found.group(1).lower() for found in _CALLED.finditer(text)}:
        if name not in ("oncoming vehicle", "oncoming car"):
            alike = rf"\b(?:{re.escape(name)}|{re.escape(name.split()[0])} one)\b"
            text = re.sub(alike, lambda found: _padded("ego", found), text, flags=re.IGNORECASE)
    if names := letters(text):
        text = _defined(text, _LETTERED, {name: name for name in names})
        text = _LETTERED.sub(lambda found: _padded(names[found.group(1).upper()], found), text)
    numbered = list(dict.fromkeys(found.group(1) for found in _NUMBERED.finditer(text)))
    egos = [each for each in numbered if _is_ego(re.escape(each), text)]
    if len(numbered) != 2 or len(egos) != 1:
        return text
    text = _defined(text, _NUMBERED, {name: name for name in numbered})
    return _NUMBERED.sub(lambda found: _padded("AV" if found.group(1) == egos[0] else "OV", found), text)


def without_short_names(text: str) -> str:
    """Return the text in which an abbreviation that it brings in for a vehicle is one that everybody knows.

    >>> without_short_names("An interacting vehicle (IV) goes west. The IV brakes.")
    'An interacting vehicle      goes west. The OV brakes.'
    """
    for found in _BROUGHT_IN.finditer(text):
        brought = re.compile(rf" \\({found.group(2)}\\)")
        text = brought.sub(lambda each: " " * len(each.group()), text, count=1)
        short, ego = (
            found.group(2),
            re.search(rf"{_EGOS}$|(?:under test|of interest)$", found.group(1), re.I) is not None,
        )
        if short in (
            "UUT",
            "EUT",
            "DUT",
            "HAV",
            "ADS",
            "CAV",
            "AV",
            "OV",
            "SV",
            "POV",
            "NPC",
            "EGO",
            "VUT",
            "SUT",
            "GVT",
            "TTC",
            "TTA",
            "CP",
            "SL",
        ):
            continue
        name = {2: "AV" if ego else "OV", 3: "ego" if ego else "POV", 4: "ego " if ego else "hero"}[len(short)]
        first = re.compile(rf" \({short}\)")
        text = first.sub(lambda each: " " * len(each.group()), text, count=1)
        text = re.sub(rf"\b{short}\b", name, text)
    return text


def letters(text: str) -> dict[str, str]:
    """Return who "car A" and "car B" are, where one of two is said to be the ego."""
    found = list(dict.fromkeys(each.group(1).upper() for each in _LETTERED.finditer(text)))
    egos = [each for each in found if _is_ego(f"{_KINDS} {each}", text)]
    if len(found) != 2 or len(egos) != 1:
        return {}
    return {each: "ego" if each == egos[0] else "hero" for each in found}


def _is_ego(name: str, text: str) -> bool:
    """Whether a name is said to be the ego: "V1 (vehicle under test)", "the vehicle under test (V1)"."""
    tested = rf"\b{name}(?: is|,| \() ?(?:the one )?(?:under test|being tested)\b"
    said = rf"\b{name}{_IS}{_EGOS}\b|\b{_EGOS},? (?:\(|is |called |which is )(?:the )?{name}\b|{tested}"
    return re.search(said, text, re.IGNORECASE) is not None


def _defined(text: str, pattern: re.Pattern[str], names: dict[str, str]) -> str:
    """Return the text without what says who a name is: "V1 (vehicle under test)" is "V1", "the van (V2)" the van."""
    brackets = re.compile(rf"(?<=\w) \({pattern.pattern}\)", pattern.flags)
    text = brackets.sub(lambda found: " " * len(found.group()) if found.group(1) in names else found.group(), text)
    after = re.compile(rf"({pattern.pattern})(?: \((?:the |our )?{_EGOS}\)|, (?:the |our ){_EGOS},)", re.IGNORECASE)
    return after.sub(lambda found: found.group(1).ljust(len(found.group())), text)


def _padded(words: str, found: re.Match[str]) -> str:
    return words.ljust(len(found.group()))
