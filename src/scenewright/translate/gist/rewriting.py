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
    source, runs, depth, at = pattern.pattern, [""], 0, 0
    while at < len(source):
        char = source[at]
        if char == "[":
            at = source.index("]", at + (3 if source[at + 1] == "^" else 2))
        elif char in "()":
            depth += 1 if char == "(" else -1
        elif depth == 0 and char == "|":
            return ""
        plain = depth == 0 and (char.isalpha() or char == " ")
        if plain and source[at + 1 : at + 2] not in tuple("?*{"):
            runs[-1] += char
        else:
            runs.append("")
        at += 2 if char == "\\" else 1
    return max(runs, key=len).lower()
