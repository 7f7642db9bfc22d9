"""Parts a text that was dictated or typed in one breath: "... going straight on and when the ego is 20 m from it ...".

What enters: the text. What leaves: the text, every character in its place, with the end of a sentence where a moment is
told and where the other vehicle is brought in. A text with sentences of its own is left as it is.
"""

from __future__ import annotations

import re

from scenewright.translate.tokens import END_OF_SENTENCE

_SHORTEST = 160
_ENDS = re.compile(r"[.!?;:\n](?=\s*\S)|,|\b(?:full stop|period|comma)\b", re.IGNORECASE)
_JOINS = r"(?:(?:and|then|so|now|okay|ok) )*"
_WHO = r"(?:the |our |my )?(?:ego|we|it|av|sut|vut|test (?:car|vehicle)|car|hero|pov)\b"
_MOMENT = re.compile(rf" (?={_JOINS}(?:when|once|as soon as|the moment) {_WHO})", re.IGNORECASE)
_BROUGHT_IN = re.compile(
    rf" (?={_JOINS}(?:there(?:['\u2019]s| is) (?:a|an|the|another) |(?:the |a )?(?:hero|pov|other (?:car|vehicle))"
    r"(?:['\u2019]s| is| comes| drives| wants) ))",
    re.IGNORECASE,
)


def parted(text: str) -> str:
    """Return a text of one long sentence in several; any other text as it is.

    >>> told = "the ego drives west straight on " + "and on " * 20
    >>> parted(f"{told}then there's a van when the ego is 9 m from it").count(END_OF_SENTENCE)
    2
    """
    if len(text) < _SHORTEST or _ENDS.search(re.sub(r"\d[.,:]\d", "000", text)):
        return text
    moment = next((found for found in _MOMENT.finditer(text) if found.start() > _SHORTEST // 4), None)
    if moment is None:
        return text
    brought = _BROUGHT_IN.search(text, _SHORTEST // 8, moment.start())
    for found in filter(None, (moment, brought)):
        text = text[: found.start()] + END_OF_SENTENCE + text[found.end() :]
    return text
