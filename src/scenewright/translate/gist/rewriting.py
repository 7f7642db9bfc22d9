"""What the tables of turns of phrase share: their type, and patterns for amounts and for who is spoken of.

What enters: nothing. What leaves: `Rules`, and pieces of patterns, to be used without regard to case; and what every
match of a pattern holds, by which most texts are known not to match without searching them.
"""

from __future__ import annotations

import re
from collections.abc import Callable

# Patterns with what to say instead, in their order: what one rule leaves, the next may read.
Rules = tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...]

# "20 m", "fifteen feet", "initial_ego_m"
AMOUNT = r"(?:(?:[\d.]+ ?|[a-z-]+ )(?:m|met(?:re|er)s?|ft|feet|foot|yd|yards?|s|seconds?)\b|\w+_(?:m|s|ft|yd)\b)"
WHO = r"(?:(?:the|our) [\w-]+(?: vehicle| car| under test)?|it|he|she|[A-Z]{2,})"
EGO = r"(?:ego(?: vehicle| car)?|AV|SUT|VUT|ADS|DUT|EUT)"
PRIORITY = r"(?:priority|precedence|right of way|right-of-way)"
BEGINS = r"(?:(?<=[.!?;]\s)|^)"  # of a sentence


def needed(pattern: re.Pattern[str]) -> str:
    r"""Return the longest run of letters and blanks that every match of a pattern holds, in lower case; it may be "".

    Only what stands outside of groups and is not optional counts.

    >>> needed(re.compile(r"\b(?:the|our) Van[s]? is parked(?: there)?"))
    ' is parked'
    """
    return _scanned(pattern.pattern)[0]


def held(pattern: re.Pattern[str]) -> tuple[str, ...]:
    r"""Return runs of letters and blanks of which every match of a pattern holds at least one, in lower case.

    >>> held(re.compile(r"\d of (?:driving|travel(?:ling)?)(?= from)"))
    ('driving', 'travel')
    """
    run, groups = _scanned(pattern.pattern)
    if len(run) >= _TELLING:
        return (run,)
    best: tuple[str, ...] = (run,)
    for group in groups:
        runs = tuple(_scanned(alternative)[0] for alternative in _alternatives(group))
        if min(map(len, runs)) > max(_SHORT, min(map(len, best))) and len(runs) <= _MANY:
            best = runs
    return best


_TELLING, _SHORT, _MANY = 8, 3, 12


def _scanned(source: str) -> tuple[str, list[str]]:
    """Return the longest run outside of groups, and the groups that every match goes through."""
    runs, groups, depth, at, opened = [""], [], 0, 0, 0
    while at < len(source):
        char, step = source[at], 2 if source[at] == "\\" else 1
        if char == "[":
            at = source.index("]", at + (3 if source[at + 1 : at + 2] == "^" else 2))
        elif char == "(":
            opened = at if depth == 0 else opened
            depth += 1
        elif char == ")":
            depth -= 1
            optional = source[at + 1 : at + 2] in ("?", "*", "{")
            inside = source[opened + 1 : at]
            if depth == 0 and not optional and not inside.startswith(("?=", "?!", "?<=", "?<!", "?(")):
                groups.append(re.sub(r"^\?(?::|P<\w+>|-?[a-z]+:)", "", inside))
        elif depth == 0 and char == "|":
            return "", []
        plain = depth == 0 and (char.isalpha() or char == " ")
        if plain and source[at + 1 : at + 2] not in ("?", "*", "{"):
            runs[-1] += char
        else:
            runs.append("")
        at += step
    return max(runs, key=len).lower(), groups


def _alternatives(group: str) -> list[str]:
    """Return what stands between the bars of a group, not of the groups in it."""
    parts, depth, at, begin = [], 0, 0, 0
    while at < len(group):
        char = group[at]
        if char == "[":
            at = group.index("]", at + (3 if group[at + 1 : at + 2] == "^" else 2))
        elif char in "()":
            depth += 1 if char == "(" else -1
        elif char == "|" and depth == 0:
            parts.append(group[begin:at])
            begin = at + 1
        at += 2 if char == "\\" else 1
    return [*parts, group[begin:]]
