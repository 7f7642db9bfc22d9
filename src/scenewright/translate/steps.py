"""Says steps as sentences: "Given ... And ... When ... And ... Then ... And ...", each on a line of its own.

What enters: the text. What leaves: the text, every other character in its place. What follows "When" and its "And" is
one moment; without that a second line would tell of the start.
"""

from __future__ import annotations

import re

from scenewright.translate.tokens import END_OF_SENTENCE

_STEP = re.compile(
    r"^([ \t]*(?:[-*] )?)(Given|GIVEN|When|WHEN|Then|THEN|And|AND|But|BUT|As soon as|Once|If|The moment|(?:Exactly"
    r"|Just) when"
    r"|At the (?:very |exact )?moment (?:when|at which))\b:?[ \t]*",
    re.MULTILINE,
)
_WHOLE = re.compile(r",[^\n]*[.!?;]\s*\Z")
_STOP = re.compile(r"[.,;]\s*\Z")


def in_sentences(text: str) -> str:
    r"""Return the text with its steps as sentences; any other text as it is.

    >>> in_sentences("Given A\nAnd B\nWhen C\nAnd D\nThen E\nAnd F")
    '      A\x0b    B\x0bWhen C and D,     E\x0b    F'
    """
    steps = list(_STEP.finditer(text))
    words = [step.group(2).capitalize() for step in steps]
    words = [word if word in ("Given", "Then", "And", "But") else "When" for word in words]
    if not {"When", "Then"} <= set(words) or words[0] not in ("Given", "When"):
        return text
    parts, done, kind, asked = [], 0, "", 0
    for step, word in zip(steps, words, strict=True):
        line = step.start() - 1
        if kind == "When" and word != "When":
            if _WHOLE.search(text[asked:line]):
                kind = ""  # "When it is 8 m away, the van brakes." is no step
                continue
            said = " and " if word in ("And", "But") else ", "
            rest = _STOP.sub(lambda end: " " * len(end.group()), text[done:line])
            parts += [rest, said.ljust(step.end() - line)]
        elif word in ("When", "Then") or (not kind and word != "Given"):
            parts += [_ended(text[done : step.start()]), step.group()]
        else:
            parts += [_ended(text[done : step.start()]), " " * len(step.group())]
        kind = kind if word in ("And", "But") else word
        asked = step.end() if word == "When" else asked
        done = step.end()
    return "".join([*parts, text[done:]])


def _ended(lines: str) -> str:
    """Return lines with the end of a sentence in place of the end of the last one, where it has no stop of its own."""
    told = lines.rstrip()
    return lines[:-1] + END_OF_SENTENCE if told and told[-1] not in ".,;:!?" else lines
