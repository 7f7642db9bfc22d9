"""Finds whom a text declares to be the ego: "The blue car is the one under test", "Let V0 be the vehicle under test".

What enters: the text. What leaves: the text with "ego" and "hero" in place of the names that it brings in, every other
character where it was. A name is replaced only where the text itself says whose it is.
"""

from __future__ import annotations

import re

_TESTED = (
    r"(?:the (?:one|vehicle|car|unit|truck) (?:under test|under assessment|under evaluation|we(?: are|['\u2019]re)? "
    r"test(?:ing)?"
    r"|being tested|being evaluated|of interest|to be tested)|(?:our|the) (?:test (?:car|vehicle)|tested (?:car"
    r"|vehicle)|(?:car|vehicle) "
    r"(?:under test|being tested|we test)|ego(?: vehicle| car)?)|what we(?: are|['\u2019]re)? test(?:ing)?|under test"
    r"|our (?:autonomous|automated|self-driving) (?:car|vehicle))"
)
_OTHER = r"(?:the (?:other (?:vehicle|car|driver|one)|hero(?: vehicle)?))"
_BEGINS = r"(?:(?<=[.!?;]\s)|(?<=\n)|^)"
_GENERIC = frozenset(["car", "vehicle", "one", "driver", "party", "object", "unit", "participant", "road user"])
_KNOWN = re.compile(
    r"\b(?:ego|hero|AV|SUT|VUT|ADS|under test|test|other|same|left|right|it|this|that|trigger|question|purpose|idea"
    r"|first"
    r"|second|front|rear|behind|ahead|lead|leader|following|follower|predecessor|your|you|my|own|driveway|road|lane|street|line|point|intersection"
    r"|junction|start|beginning|moment|time|end|in|on|along|from|at|to)\b|\d|['\u2019]s\b",
    re.IGNORECASE,
)
# "The blue car is the one under test.", "A school bus is what we are testing."
_IS_TESTED = re.compile(
    rf"{_BEGINS}(?:the|our|my|an?) ((?:[\w'\u2019-]+ ){{0,2}}[\w'\u2019-]+),? (?:and )?(?:it )?is {_TESTED}"
    r"(?=[.,;]| and the [\w ]+ is not\b)",
    re.IGNORECASE,
)
# "The item under test is a minibus."
_TESTED_IS = re.compile(
    rf"{_BEGINS}the (?:item|object|unit|thing|vehicle|car|system) under test is (?:an?|the|our) ((?:[\w-]+ "
    rf"){{0,2}}[\w-]+)(?=[.;])",
    re.IGNORECASE,
)
# "The candidate vehicle, i.e. the one under assessment, is", "Number 1, the tested car, is"
_APART = re.compile(
    rf"{_BEGINS}((?:the|our|my) (?:[\w'\u2019-]+ ){{0,3}}[\w'\u2019-]+), (?:which is |who is |i\.e\.,? |that "
    rf"is,? |being |namely )?"
    rf"{_TESTED},",
    re.IGNORECASE,
)
_IS_NOT = re.compile(rf"({_TESTED})(?:,| and|,? but) (?:the )?[\w ]{{1,20}} is not(?=[.;])", re.IGNORECASE)
# "The ego, hereafter E,", "Our car (call it Bluebird)", "The ego (she)"
_CALLED = re.compile(
    r"\b(?P<who>the ego(?: vehicle)?|the hero(?: vehicle)?|our car|the (?:AV|SUT)|the other (?:car|vehicle|driver"
    r"|one)|an? [\w]+"
    r"(?: [\w]+)?),? ?(?:\((?:call it |called |here(?:after|inafter) |named )?(?P<short>she|he|[A-Z][a-z]+|[A-Z]"
    r"|first (?:vehicle|car)"
    r"|second (?:vehicle|car))\)|,? (?:hereafter|hereinafter|henceforth|called) (?P<name>[A-Z]\w*),)",
    re.IGNORECASE,
)
_LET_BE = re.compile(rf"{_BEGINS}Let (\w+) be {_TESTED},? and (?:let )?(\w+) (?:be )?{_OTHER}[.;]", re.IGNORECASE)
_FIRST_IS = re.compile(
    r", the (first|second)(?: one)?(?: of (?:which|these|them))? (?:is|being) (?:the )?ego\b", re.IGNORECASE
)
_SITS_IN = re.compile(rf"{_BEGINS}([A-Z][a-z]+) (is|sits|drives) in the (?:car|vehicle) under test\b,?")
# "the one in the driveway", "the vehicle on the road"
_PLACED = re.compile(
    r"\bthe (?:one|vehicle|car) (in|on) the (driveway|road)\b(?! (?:that|which|who|wants|is going|comes))",
    re.IGNORECASE,
)
_EGO_THERE = re.compile(
    r"(?:^|[.;] |\n)(?:the |our )?(?:ego|AV|SUT|VUT|car under test|vehicle under test|test vehicle|test car)(?: "
    r"vehicle| car)?\b"
    r"(?:(?!\b(?:want|onto|join|end|turn|enter|into))[^.;]){0,60}?"
    r"\b(?:in|on|down|out of|leav\w+|exit\w*|along) the (driveway|road)\b",
    re.IGNORECASE,
)
_SUCH_ONE = re.compile(r"\bthe ([a-z][\w-]+) one\b")
_BOUND_ONE = re.compile(r"\bthe (east|west)bound (?:one|vehicle|car)\b", re.IGNORECASE)


def with_declared(text: str) -> str:
    """Return the text in which what it declares to be the ego is called so.

    >>> with_declared("The blue car is the one under test. It goes west. The blue one is 9 m from it.")
    'The ego      is the one under test. It goes west. The ego      is 9 m from it.'
    """
    text = _IS_NOT.sub(lambda found: found.group(1).ljust(len(found.group())), text)
    for pattern in (_IS_TESTED, _TESTED_IS):
        for found in list(pattern.finditer(text)):
            text = _named(text, found.group(1))
    for found in list(_APART.finditer(text)):
        name = re.sub(r"^(?:the|our|my) ", "", found.group(1), flags=re.IGNORECASE)
        if not _KNOWN.search(name) and name.lower() not in _GENERIC:
            rest = found.group()[len(found.group(1)) :]
            text = text.replace(found.group(), found.group(1) + " " * len(rest), 1)
            text = _named(text, name)
    text = _with_letters(_with_short(_with_nouns(text)))
    return _with_bound(_with_placed(text))


def _with_nouns(text: str) -> str:
    """Return the text with "the manned one" as "the manned vehicle" where that was spoken of before."""
    for found in list(_SUCH_ONE.finditer(text)):
        kind = found.group(1)
        noun = re.search(
            rf"\b{re.escape(kind)} (vehicle|car|truck|van|driver|bus)\b", text[: found.start()], re.IGNORECASE
        )
        if noun is not None and not _KNOWN.search(kind):
            text = text.replace(found.group(), f"the {kind} {noun.group(1)}")
    return text


def _named(text: str, name: str) -> str:
    """Return the text with a name, also without what sets it apart, as the ego's."""
    if _KNOWN.search(name):
        return text
    words = name.split()
    alike = [re.escape(name)]
    if len(words) > 1 and words[-1].lower() in ("car", "vehicle", "truck", "van", "bus"):
        alike.append(re.escape(" ".join(words[:-1])) + " one")
    elif len(words) > 1 and words[-1].lower() not in _GENERIC:
        alike.append(re.escape(words[-1]))
    if len(words) == 1 and words[0].lower() in _GENERIC:
        return text
    pattern = rf"\b((?:the|our|my|an?|this|that) )(?:{'|'.join(alike)})\b(['\u2019]s\b)?(?! (?:and|or) )"

    def the_ego(found: re.Match[str]) -> str:
        return _fitted(found, f"{_article(found.group(1))}ego{found.group(2) or ''}")

    text = re.sub(pattern, the_ego, text, flags=re.IGNORECASE)
    if not name.islower() or len(words) > 1:  # "My cue: robot car 5 m from it"
        bare = re.compile(rf"(?<![\w-]){re.escape(name)}(['\u2019]s)?(?![\w-])")
        text = bare.sub(lambda found: _fitted(found, f"ego{found.group(1) or ''}"), text)
    return text


def _article(said: str) -> str:
    return "The " if said[0].isupper() else "the "


def _replaced(pattern: re.Pattern[str], words: str, text: str) -> str:
    return pattern.sub(lambda found: _fitted(found, words), text)


def _fitted(found: re.Match[str], words: str) -> str:
    return words.ljust(len(found.group()))


def _with_short(text: str) -> str:
    """Return the text with "hereafter E", "(call it Bluebird)" and "(she)" resolved."""
    for found in list(_CALLED.finditer(text)):
        short = found["short"] or found["name"]
        ego = re.search(r"\b(?:ego|our|AV|SUT)\b", found["who"], re.IGNORECASE) is not None
        plain = short.lower() in ("she", "he") or short.lower().startswith(("first", "second"))
        if not plain and (
            not short[0].isupper() or (short.isupper() and len(short) > 1) or short.lower() in ("ego", "hero")
        ):
            continue
        if plain and not short.islower():
            continue
        text = text.replace(found.group(), found["who"].ljust(len(found.group())), 1)
        article = r"(?:the )?" if short.lower().startswith(("first", "second")) else ""
        who = "the ego" if ego else "the hero"
        flags = re.IGNORECASE if plain else re.NOFLAG
        pattern = re.compile(rf"(?<![\w-]){article}{re.escape(short)}(?![\w'\u2019-])", flags)
        at = found.start() + len(found["who"])
        text = text[:at] + _replaced(pattern, who, text[at:])
    return text


def _with_letters(text: str) -> str:
    """Return the text with "Let V0 be the vehicle under test and V1 the other vehicle" and the like resolved."""
    for found in list(_LET_BE.finditer(text)):
        text = text.replace(found.group(), " " * len(found.group()), 1)
        for short, who in zip(found.groups(), ("the ego", "the hero"), strict=True):
            text = re.sub(rf"\b{re.escape(short)}\b", who, text)
    for found in list(_SITS_IN.finditer(text)):
        name = found.group(1)
        if name.lower() not in ("he", "she", "it", "who", "somebody", "someone"):
            text = text.replace(found.group(), f"The ego {'drives' if found.group(2) == 'drives' else 'is'}", 1)
            text = re.sub(rf"\b{name}\b", "The ego", text)
    if told := _FIRST_IS.search(text):
        first = told.group(1).lower()
        other = "second" if first == "first" else "first"
        text = text[: told.start()] + " " * len(told.group()) + text[told.end() :]
        for word, who in ((first, "the ego"), (other, "the hero")):
            ordinal = re.compile(rf"\bthe {word}(?: vehicle| car| one)?\b(?! (?:time|run|test))", re.IGNORECASE)
            text = _replaced(ordinal, who, text)
    return text


def _with_placed(text: str) -> str:
    """Return the text with "the one in the driveway" as whoever was said to be there."""
    where = _EGO_THERE.search(text)
    first = _PLACED.search(text)
    if where is None or first is None or first.start() < where.start():
        return text
    own = where.group(1).lower()

    def named(found: re.Match[str]) -> str:
        return _fitted(found, "the ego" if found.group(2).lower() == own else "the hero")

    return text[: where.end()] + _PLACED.sub(named, text[where.end() :])


def _with_bound(text: str) -> str:
    """Return the text with "the westbound one" as the hero where only the hero was said to go west."""
    sentences = re.split(r"(?<=[.;])\s", text)
    for found in list(_BOUND_ONE.finditer(text)):
        way = found.group(1).lower()
        told = [each for each in sentences if re.search(rf"\b{way}(?:bound|ward|wards)?\b", each, re.IGNORECASE)]
        told = [each for each in told if not _BOUND_ONE.search(each)]
        egos = [
            bool(re.match(r"\W*(?:the |our )?(?:ego|AV|SUT|VUT|vehicle under test|car under test)\b", each, re.I))
            for each in told
        ]
        if len(told) == 1 and len(egos) == 1 and not re.search(r"\band\b.*\bego\b", told[0]):
            text = text.replace(found.group(), _fitted(found, "the ego" if egos[0] else "the hero"), 1)
    return text
