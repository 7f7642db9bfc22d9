"""Finds sentences that say of themselves that they change nothing: "It has rained, which makes no difference".

What enters: the text. What leaves: where such sentences stand, and thanks and greetings. One that tells what a vehicle
does, or holds an amount, is none of them.
"""

from __future__ import annotations

import re

from scenewright.errors import Span

_SENTENCE = re.compile(r"[^.!?\n]+[.!?]?")
_CHANGES_NOTHING = re.compile(
    r"\b(?:(?:plays?|takes?|has|have|is|are) no part|no part of the test|(?:makes?|made) no difference"
    r"|nothing to do with (?:the|this|it)|of no (?:account|importance)|(?:is|are) irrelevant|do(?:es)? not matter"
    r"|(?:nobody|no one|no other (?:vehicle|car)|nothing) else (?:is|on)"
    r"|no other (?:vehicle|car|road user|traffic)s? (?:is|are))\b",
    re.IGNORECASE,
)
# "The test is passed if there is no contact.": a verdict, not what happens
_VERDICT = re.compile(
    r"^\s*(?:the |a |this )?(?:test|run|case|scenario) (?:is|counts as|shall be|should be|will be) "
    r"(?:a )?(?:pass|passed|failed|successful|ok|okay) (?:if|when|as long as) "
    r"(?:there is |there are |we see )?no (?:contact|collision|crash|accident|touch)s?(?: occurs| happens)?\s*[.!]?$",
    re.IGNORECASE,
)
# "Order: not specified."
_UNSPECIFIED = re.compile(
    r"^\s*(?:[a-z]+ ){0,3}[a-z]+ ?(?::|is|are)(?: (?:is|are|left))? ?(?:not specified|unspecified|not prescribed"
    r"|free|none|n/a|irrelevant)"
    r"\s*[.;]?$",
    re.IGNORECASE,
)
# "The point of the test is whether the AV commits too early.": what the test is for
_PURPOSE = re.compile(
    r"^\s*(?:the|our) (?:point|purpose|aim|idea|question|interest|goal|focus)\b.*\b(?:whether|how)\b", re.I
)
# "Many thanks in advance!", "Sorry for my English.", "I hope that makes sense"
_POLITE = re.compile(
    r"^\W*(?:(?:many |a lot of |with )?(?:thanks|thank you|thx|cheers|regards|best regards|kind regards|sincerely"
    r"|sorry|apologies|excuse (?:me|my)|hello|hi|hey|dear|good (?:morning|afternoon|day)|not sure (?:if|whether)"
    r"|i hope|hope (?:this|that|it)|let me know|that's (?:all|it)|that is (?:all|it)|just (?:asking|checking)"
    r"|fight over"
    r"|many thanks|please (?:note|find|forgive)))\b",
    re.IGNORECASE,
)
# "TODO: ask about the antenna.": what the author has to do, not what happens
_NOTE_TO_SELF = re.compile(r"^\s*(?:TODO|NB|PS|FYI):", re.IGNORECASE)
_NAMES = re.compile(
    r"\d|\b(?:ego|av|sut|vut|sv|hero|npc|pov|vehicles?|cars?|van|bus|truck|lorry|brak|accelerat|slow|stop|turn"
    r"|when|until"
    r"|unless|except|if|but|nobody|no one|way|yield|priority|wait|let|goes|drives?|pass"
    r"|driveway|road)",
    re.IGNORECASE,
)
_ABOUT = re.compile(
    r"\d|\b(?:hero|npc|pov|target|van|car|bus|truck|lorry|brak|accelerat|slow|stop|yield|until|when|east|west"
    r"|north|south"
    r"|left|right|straight|driveway|road|before|after)",
    re.IGNORECASE,
)
_TELLS = re.compile(
    r"\d|\b(?:ego|av|sut|hero|npc|pov|under test|our (?:car|vehicle)|brak|accelerat|slow|stop|turn|yield|pass|cross"
    r"|until|when|if|(?:east|west|north|south)|left|right|straight|driveway|conflict|before|after)",
    re.IGNORECASE,
)


def disclaimers(text: str) -> list[Span]:
    """Return where sentences stand that say that they change nothing."""
    return [
        Span(*found.span())
        for found in _SENTENCE.finditer(text)
        if _VERDICT.search(found.group())
        or (_UNSPECIFIED.search(found.group()) and not _NAMES.search(found.group()))
        or (_PURPOSE.search(found.group()) and not _ABOUT.search(found.group()))
        or ((note := _NOTE_TO_SELF.search(found.group())) and not _NAMES.search(found.group(), note.end()))
        or ((polite := _POLITE.search(found.group())) and not _NAMES.search(found.group(), polite.end()))
        or (_CHANGES_NOTHING.search(found.group()) and not _TELLS.search(found.group()))
    ]
