"""Regroups words whose neighbours show another reading: "is going to start to brake", "at which moment the ego is".

What enters: tokens. What leaves: tokens in plainer words that mean the same. It drops nothing that tells of a place,
an amount or an action.
"""

from __future__ import annotations

from scenewright.errors import Span
from scenewright.translate.tokens import Token

_NEARS = frozenset(("closed", "closes", "close", "come", "comes", "got", "drawn", "moved", "advanced"))
_AT_WHICH = ("at which moment", "at which point", "at which time", "at which instant")
_CLEFTS = ("has in mind", "wants", "wants to do", "intends", "intends to do", "plans", "plans to do", "is planning")
_STAYS = ("stays", "stay", "staying", "remains", "remain", "remaining", "keeps", "continues")
_LINED = ("one behind the other", "one after the other", "in single file")
_DEEDS = ("brake", "stop", "accelerate", "yield", "go", "turn", "pass", "complete", "wait", "keep", "pull_out")


def regrouped(tokens: list[Token]) -> list[Token]:
    """Return the tokens in plainer words where their neighbours show what is meant."""
    for regroup in (
        _to_start,
        _closed_to_within,
        _at_which,
        _drivers,
        _what_is_wanted,
        _in_line,
        _nobody_yields,
        _stays_on_it,
        _that_is_to_say,
    ):
        tokens = regroup(tokens)
    return tokens


def _that_is_to_say(tokens: list[Token]) -> list[Token]:
    """Step over ", which is to say," in front of a place that says again where a turn ends."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        words = " ".join(token.text.lower() for token in tokens[at : at + 3])
        after = tokens[at + 3].tags if at + 3 < len(tokens) else {}
        again = words in ("which is to say", "that is to say") and after.get("preposition") == "into"
        if again and read and "comma" in read[-1].tags:
            at += 3
            continue
        read.append(tokens[at])
        at += 1
    return read


def _stays_on_it(tokens: list[Token]) -> list[Token]:
    """Let "drives west on the road and stays on it" be "... stays on the road", where that was named last."""
    read: list[Token] = []
    at, area = 0, ""
    while at < len(tokens):
        area = "" if "end" in tokens[at].tags else tokens[at].tags.get("area", area)
        words = [token.text.lower() for token in tokens[at : at + 3]]
        if area != "road" or words[1:] != ["on", "it"] or words[0] not in _STAYS or not _ends(tokens, at + 3):
            read.append(tokens[at])
            at += 1
            continue
        span = tokens[at].span.union(tokens[at + 2].span)
        read.append(Token(" ".join(words), span, {"verb": "lane_follow"}, tokens[at].forms))
        at += 3
    return read


def _ends(tokens: list[Token], at: int) -> bool:
    return at >= len(tokens) or bool(tokens[at].tags.keys() & {"end", "comma", "link"})


def _nobody_yields(tokens: list[Token]) -> list[Token]:
    """Mark "nobody gives way", so that a remark with it is held against what is told."""
    read: list[Token] = []
    for token in tokens:
        nobody = bool(read) and read[-1].text.lower() in ("nobody", "no one", "neither")
        if nobody and token.tags.get("verb") == "yield" and "s" in token.forms:
            span = read[-1].span.union(token.span)
            text = f"{read[-1].text} {token.text}"
            read[-1] = Token(text, span, {"unknown": text, "nobody_yields": "x"})
        else:
            read.append(token)
    return read


def _what_is_wanted(tokens: list[Token]) -> list[Token]:
    """Let "what its driver has in mind is to turn left" and "what it wants is to turn left" be "it wants to ..."."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        end = _cleft_end(tokens, at) if tokens[at].text.lower() == "what" else None
        if end is None:
            read.append(tokens[at])
            at += 1
            continue
        named, span = tokens[at + 1], tokens[at].span.union(tokens[end - 1].span)
        driver = tokens[at + 2].text.lower() == "driver"
        who = Token("it", named.span, {"pronoun": "it"}) if driver else named
        read += tokens[at + 1 : at + 3] if "determiner" in named.tags and not driver else [who]
        read.append(Token("wants", span, {"verb": "want"}, frozenset(("s",))))
        read.append(Token("to", tokens[end - 1].span, {"link": "to", "preposition": "to"}))
        at = end
    return read


def _cleft_end(tokens: list[Token], at: int) -> int | None:
    """Return the position of the verb after "what its driver has in mind is to", or None."""
    who = tokens[at + 1].tags.keys()
    named = at + 2 if "pronoun" in who else at + 3 if who & {"determiner", "possessive"} else None
    if named is None or (named == at + 3 and not tokens[at + 2].tags.keys() & {"noun", "hero", "ego"}):
        return None
    words = " ".join(token.text.lower() for token in tokens[named : named + 6])
    for wants in _CLEFTS:
        for linked in ("is to", "is"):
            if words.startswith(f"{wants} {linked} ") and (end := _after_words(tokens, named, f"{wants} {linked}")):
                end += tokens[end].text.lower() == "to"
                return end if "verb" in tokens[end].tags and "base" in tokens[end].forms else None
    return None


def _after_words(tokens: list[Token], at: int, words: str) -> int | None:
    """Return the position after the tokens that make up `words`, or None where one of them goes on."""
    read = ""
    while len(read) < len(words):
        read, at = f"{read} {tokens[at].text.lower()}".strip(), at + 1
    return at if read == words else None


def _in_line(tokens: list[Token]) -> list[Token]:
    """Let "one behind the other: first the hero, then the ego" be "...: the hero in front, the ego behind"."""
    read: list[Token] = []
    at, lined = 0, False
    while at < len(tokens):
        lined = (lined or tokens[at].text.lower() in _LINED) and "end" not in tokens[at].tags
        found = _first_and_then(tokens, at) if lined and tokens[at].text.lower() == "first" else None
        if found is None:
            read.append(tokens[at])
            at += 1
            continue
        first, then, end = found
        read += [*first, Token("in front", tokens[at].span, {"relation": "ahead"})]
        read += [Token(",", tokens[at].span, {"comma": ","}), *then]
        read.append(Token("behind", tokens[at].span, {"relation": "behind"}))
        at = end
    return read


def _first_and_then(tokens: list[Token], at: int) -> tuple[list[Token], list[Token], int] | None:
    """Read "first the hero(,) (and) then the ego" up to the end of its sentence: both names, and where it ends."""
    begin = at + 1
    middle = _named(tokens, begin)
    after = middle
    while tokens[after].tags.keys() & {"comma"} or tokens[after].text.lower() == "and":
        after += 1
    if middle == begin or tokens[after].text.lower() not in ("then", "and then"):
        return None
    end = _named(tokens, after + 1)
    closed = end > after + 1 and "end" in tokens[end].tags
    return (tokens[begin:middle], tokens[after + 1 : end], end) if closed else None


def _named(tokens: list[Token], at: int) -> int:
    """Return the position after a plain name of a vehicle."""
    at += "determiner" in tokens[at].tags
    return at + 1 if tokens[at].tags.keys() & {"ego", "hero", "noun"} else at


def _closed_to_within(tokens: list[Token]) -> list[Token]:
    """Let "has closed to within 20 m of it" be "gets within 20 m of it"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        before = read[-1] if read else None
        amount = tokens[at + 1].quantity if at + 1 < len(tokens) else None
        nears = before is not None and "falls" in before.tags and set(before.text.lower().split()) & _NEARS
        if before is None or token.text.lower() != "within" or amount is None or not nears:
            read.append(token)
            continue
        span = before.span.union(token.span)
        read[-1] = Token(f"{before.text} within", span, {"verb": "get_within"}, frozenset(("s",)))
    return read


def _at_which(tokens: list[Token]) -> list[Token]:
    """Let "when it is 10 m from it, at which moment the ego is 75 m from it" be "when ..., and the ego is ..."."""
    read = list(tokens)
    for at, token in enumerate(tokens):
        if token.text.lower() in _AT_WHICH and _moment_goes_on(tokens, at):
            read[at] = Token(token.text, token.span, {"link": "and"})
    return read


def _moment_goes_on(tokens: list[Token], at: int) -> bool:
    """Whether a state with an amount stands on both sides: in the clause of a "when" before, and after."""
    back = at - 1
    while back >= 0 and "end" not in tokens[back].tags and tokens[back].tags.get("link") != "when":
        if tokens[back].tags.get("verb") in _DEEDS:
            return False
        back -= 1
    told = back >= 0 and tokens[back].tags.get("link") == "when"
    told = told and any(token.quantity is not None for token in tokens[back:at])
    ahead, placed = at + 1, False
    while not tokens[ahead].tags.keys() & {"end", "comma"}:
        if tokens[ahead].tags.get("verb") in _DEEDS:
            return False
        amount = tokens[ahead].quantity
        placed |= amount is not None and amount.dimension in ("length", "time")
        ahead += 1
    return told and placed


def _drivers(tokens: list[Token]) -> list[Token]:
    """Let "a car, its driver intending to turn left" be "a car, intending to turn left": the driver is the car."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        joined = tokens[at].text.lower() == "with"
        words = tokens[at + joined : at + joined + 3]
        driver = len(words) == 3 and words[1].text.lower() == "driver"
        driver = driver and bool(words[0].tags.keys() & {"possessive", "determiner"})
        wants = driver and words[2].tags.get("verb") == "want" and "ing" in words[2].forms
        if wants and read and "comma" in read[-1].tags:
            at += 2 + joined
        read.append(tokens[at])
        at += 1
    return read


def _to_start(tokens: list[Token]) -> list[Token]:
    """Let "to start" be a verb in "is going to start to brake" and "wants to start turning", and no moment."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        following = tokens[at + 1 : at + 3]
        verb = bool(following) and "ing" in following[0].forms and "verb" in following[0].tags
        to_verb = len(following) > 1 and following[0].text.lower() == "to" and "verb" in following[1].tags
        if token.text.lower() != "to start" or not (verb or to_verb):
            read.append(token)
            continue
        middle = token.span.start + len("to")
        read.append(Token("to", Span(token.span.start, middle), {"link": "to", "preposition": "to"}))
        span = Span(middle + 1, token.span.end)
        read.append(Token("start", span, {"verb": "begin"}, frozenset(("base",))))
    return read
