"""What the tables of turns of phrase share: their type, and patterns for amounts and for who is spoken of.

What enters: nothing. What leaves: `Rules`, and pieces of patterns, to be used without regard to case.
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
