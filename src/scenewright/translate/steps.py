"""Says steps as sentences: "Given ... And ... When ... And ... Then ... And ...", each on a line of its own.

What enters: the text. What leaves: the text, every other character in its place. What follows "When" and its "And" is
one moment; without that a second line would tell of the start.
"""

from __future__ import annotations

import re

_STEP = re.compile(r"^([ \t]*(?:[-*] )?)(Given|When|Then|And|But)\b:?[ \t]*", re.MULTILINE | re.IGNORECASE)
_TITLE = re.compile(r"\s*(?:Scenario|Feature|Background|Example)\b[^:]*:", re.IGNORECASE)


def in_sentences(text: str) -> str:
    r"""Return the text with its steps as sentences; any other text as it is.

    >>> in_sentences("Given A\nAnd B\nWhen C\nAnd D\nThen E\nAnd F")
    '      A\n    B\nWhen C and D,     E\n    F'
    """
    steps = list(_STEP.finditer(text))
    words = [step.group(2).capitalize() for step in steps]
    lines = [line for line in text.splitlines() if line.strip()]
    told = {"When", "Then"} <= set(words) and words[0] in ("Given", "When")
    if not told or not all(_STEP.match(line) or _TITLE.match(line) for line in lines):
        return text
    parts, done, kind = [], 0, ""
    for step, word in zip(steps, words, strict=True):
        joins = kind == "When" and word in ("And", "But", "Then")
        kind = kind if word in ("And", "But") else word
        line = text.rfind("\n", 0, step.start() + 1)
        if joins and line >= done:
            said = " and " if word in ("And", "But") else ", "
            parts += [text[done:line], said.ljust(step.end() - line)]
        elif word == "When":
            continue
        else:
            parts += [text[done : step.start()], " " * (step.end() - step.start())]
        done = step.end()
    return "".join([*parts, text[done:]])
