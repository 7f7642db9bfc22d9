"""Turns of phrase for a time since the start, which is a trigger of its own: "five seconds after the start".

What enters: nothing. What leaves: `CLOCK_PHRASES`, patterns with what to say instead, "5 s clock": never longer,
so that every word keeps its place.
"""

from __future__ import annotations

import re

from scenewright.translate.gist.rewriting import Rules

_TIME = r"(?:[\d.]+ ?(?:s|sec|seconds?|ms)\b|[a-z]+(?: and a half)? seconds?\b|\w+_s\b)"
_RUN = r"(?:run|test|scenario|simulation|recording|clip|experiment|trial|exercise)"
_SINCE = (
    rf"(?:(?:(?:have |has )?(?:elapsed|passed|gone by) )?(?:after|since|from) (?:the |its )?(?:very )?(?:start"
    rf"|beginning)"
    rf"(?: of (?:the |this )?{_RUN})?|into (?:the |this )?{_RUN})(?! of\b)"
)
_BEGINS = r"(?:(?<=[.!?;]\s)|(?<=\n)|^)"
# "Five seconds after the start the van hits the brakes", "3 s into the run, it"
_FIRST = re.compile(
    rf"{_BEGINS}(?:At |Exactly )?({_TIME}) {_SINCE},? (?=the |our |it |he |she |[A-Z]{{2,}})",
    re.IGNORECASE,
)
# "Trigger: 4.0 s after start."
_KEYED = re.compile(rf"(?<=: )({_TIME}) {_SINCE}(?=[.;]|\s*(?:\n|\Z))", re.IGNORECASE)
# "When 2.5 s have elapsed since the start"
_WHEN = re.compile(rf"\b(when|once|as soon as) ({_TIME}) {_SINCE}", re.IGNORECASE)
# "the van brakes 5 s after the start"
_LAST = re.compile(
    rf"\b(brakes|accelerates|begins to \w+|starts to \w+|starts \w+ing|sets off|pulls away) "
    rf"({_TIME}) {_SINCE}(?=[.,;]| and\b)",
    re.I,
)


# In this order: what one rule leaves, the next may read.
CLOCK_PHRASES: Rules = (
    (_FIRST, r"\1 clock, "),
    (_KEYED, r"\1 clock"),
    (_WHEN, r"\1 \2 clock"),
    (_LAST, r"\1 \2 clock"),
)
