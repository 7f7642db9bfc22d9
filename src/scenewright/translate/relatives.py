"""Gives what is told beside a vehicle a clause of its own: "which starts 30 m before it", "whose speed is 12 m/s".

What enters: tokens. What leaves: tokens in which it stands with a verb and a subject that the reader of clauses knows.
It adds no amount and drops none; what it is not sure of it leaves as it was, to be refused.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from scenewright.errors import Span
from scenewright.translate.notes import begins, sentence_end
from scenewright.translate.tokens import Token

_NAMES = frozenset(("ego", "hero", "noun"))
_NAMED = frozenset(("ego", "hero", "noun", "determiner", "actor_adjective", "heading"))
_SPEEDS = ("initial speeds", "starting speeds", "start speeds", "the initial speeds", "the starting speeds", "speeds")
_BEGUN = ("initial", "start")
_TO = ("to", "from", "at", "until")


def related(tokens: list[Token]) -> list[Token]:
    """Return the tokens with what is told beside a vehicle in clauses."""
    return _speeds(_speed_too(_whose_place(_whose(_which_starts(_with_starting(tokens))))))


def _which_starts(tokens: list[Token]) -> list[Token]:
    """Let "the ego, which starts 30 m before the stop line" be a place of the ego's, and no onset."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        words = token.text.lower().split()
        starts = len(words) == 2 and words[0] in ("which", "that", "who") and words[1] in ("starts", "begins")
        amount = tokens[at + 1].quantity if at + 1 < len(tokens) else None
        named = at > 1 and bool((tokens[at - 1].tags.keys() | tokens[at - 2].tags.keys()) & _NAMES)
        if not (starts and named and amount is not None and amount.dimension == "length"):
            read.append(token)
            continue
        middle = token.span.start + len(words[0])
        read.append(Token(words[0], Span(token.span.start, middle), {"link": "that"}))
        read.append(Token(words[1], Span(middle + 1, token.span.end), {"verb": "begin"}, frozenset(("s",))))
    return read


def _whose(tokens: list[Token]) -> list[Token]:
    """Let "the ego, whose initial speed is 36 km/h" be "the ego, with an initial speed of 36 km/h"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        measure = at + 1
        while measure < len(tokens) and "starting" in tokens[measure].tags:
            measure += 1
        told = tokens[at].text.lower() == "whose" and measure + 2 < len(tokens)
        told = told and tokens[measure].tags.get("measure") == "speed" and "be" in tokens[measure + 1].tags
        amount = tokens[measure + 2].quantity if told else None
        if amount is None or amount.dimension != "speed" or not _names_one_before(tokens, at):
            read.append(tokens[at])
            at += 1
            continue
        read.append(Token("with", tokens[at].span, {"preposition": "with"}))
        read += [*tokens[at + 1 : measure + 1], Token("of", tokens[measure + 1].span, {"preposition": "of"})]
        at = measure + 2
    return read


def _whose_place(tokens: list[Token]) -> list[Token]:
    """Let "whose initial distance to the intersection is 80 m" be "which is initially 80 m from the intersection"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        end = _place_of_whose(tokens, at) if tokens[at].text.lower() == "whose" else None
        if end is None:
            read.append(tokens[at])
            at += 1
            continue
        stretch = tokens[at:end]
        be = next(each for each in stretch if "be" in each.tags)
        to = next(index for index, each in enumerate(stretch) if each.text.lower() in _TO)
        place = stretch[to + 1 : stretch.index(be)]
        begun = "starting" in stretch[1].tags or stretch[1].text.lower().startswith(("initial ", "start"))
        read.append(Token("which", stretch[0].span, {"link": "that"}))
        read.append(be)
        initially = Token("initially", stretch[1].span, {"adverb": "initially"})
        read += [initially] if begun else [each for each in stretch if each.tags.get("adverb") == "initially"]
        read.append(stretch[-1])
        read.append(Token("from", stretch[to].span, {"relation": "from", "preposition": "out"}))
        read += place
        at = end
    return read


def _place_of_whose(tokens: list[Token], at: int) -> int | None:
    """Return the position after "whose initial distance to the intersection is 80 m", or None."""
    if not _names_before(tokens, at) and not _names_one_before(tokens, at):
        return None
    at += 1 + ("starting" in tokens[at + 1].tags)
    if tokens[at].tags.get("measure") not in ("length", "time") or tokens[at + 1].text.lower() not in _TO:
        return None
    at += 2 + bool(tokens[at + 2].tags.keys() & {"determiner", "possessive"})
    if "landmark" not in tokens[at].tags or "be" not in tokens[at + 1].tags:
        return None
    at += 2 + (tokens[at + 2].tags.get("adverb") == "initially")
    amount = tokens[at].quantity
    return at + 1 if amount is not None and amount.dimension in ("length", "time") else None


def _names_before(tokens: list[Token], at: int) -> bool:
    """Whether a vehicle stands right before a position, with or without a comma."""
    end = at - (at > 0 and "comma" in tokens[at - 1].tags)
    return end > 0 and bool(tokens[end - 1].tags.keys() & _NAMES)


def _names_one_before(tokens: list[Token], at: int) -> bool:
    """Whether the sentence has named one vehicle so far and nothing else that could own: "A car on the road, whose"."""
    names = at
    while names and not begins(tokens, names):
        names -= 1
    told = [bool(token.tags.keys() & _NAMES) for token in tokens[names:at]]
    others = any(token.tags.keys() & {"pronoun", "possessive", "pair"} for token in tokens[names:at])
    return not others and sum(now and not before for before, now in pairwise([False, *told])) == 1


def _with_starting(tokens: list[Token]) -> list[Token]:
    """Let "With the ego starting 40 m behind the stop line, a van comes" be "The ego starts 40 m behind it, ..."."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        if not begins(tokens, at) or token.text.lower() != "with":
            read.append(token)
            continue
        end = at + 1
        while tokens[end].tags.keys() & _NAMED:
            end += 1
        starts = tokens[end].text.lower() in ("starting", "beginning", "setting out", "starting out", "starting off")
        acts = any(each.tags.get("verb") in ("brake", "stop", "accelerate", "yield", "pass") for each in
                   tokens[at : sentence_end(tokens, at)])  # fmt: skip
        if end == at + 1 or not starts or tokens[end + 1].quantity is None or acts:
            read.append(token)
            continue
        verb = replace(tokens[end], text="starts", tags={"verb": "begin"}, forms=frozenset(("s",)))
        return [*read, *tokens[at + 1 : end], verb, *_with_starting(tokens[end + 1 :])]
    return read


def _speed_too(tokens: list[Token]) -> list[Token]:
    """Let "its distance to it amounts to 95 m and its speed to 12 m/s" be "... and its speed is 12 m/s"."""
    read = list(tokens)
    gapped = False
    for at, token in enumerate(tokens[:-1]):
        gapped = (gapped or token.text.lower() in ("amounts to", "amount to", "comes to", "is set to")) and (
            "end" not in token.tags
        )
        owned = at > 1 and "measure" in tokens[at - 1].tags and token.text.lower() == "to"
        if gapped and owned and tokens[at + 1].quantity is not None:
            read[at] = replace(token, text="is", tags={"be": "be"}, forms=frozenset())
    return read


def _speeds(tokens: list[Token]) -> list[Token]:
    """Let "Initial speeds are 50 km/h for the ego and 40 km/h for the hero" be a sentence about each."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        dealt = _dealt_speeds(tokens, at) if begins(tokens, at) else None
        if dealt is None:
            read.append(tokens[at])
            at += 1
            continue
        told, at = dealt
        read += told
    return read


def _dealt_speeds(tokens: list[Token], at: int) -> tuple[list[Token], int] | None:
    """Read "Initial speeds are A for X and B for Y": the sentences, and the position after it."""
    start = at
    at += "determiner" in tokens[at].tags
    begun = "starting" in tokens[at].tags
    at += begun
    said = tokens[at].text.lower()
    if said not in _SPEEDS and not (tokens[at].tags.get("measure") == "speed" and (begun or said.startswith(_BEGUN))):
        return None
    found = _names_then_speeds(tokens, at + 1) or _speeds_for_names(tokens, at + 1)
    if found is None or "end" not in tokens[found[1]].tags:
        return None
    shares, at = found
    front = Span(tokens[start].span.start, tokens[start].span.start)
    told: list[Token] = []
    for amount, named in shares:
        told += [Token(".", front, {"end": "."})] if told else []
        told += [Token("initially", front, {"adverb": "initially"}), Token(",", front, {"comma": ","}), *named]
        told += [Token("drives", front, {"verb": "drive"}, frozenset(("s",)))]
        told += [Token("at", amount.span, {"preposition": "at"}), amount]
    return told, at


def _speeds_for_names(tokens: list[Token], at: int) -> tuple[list[tuple[Token, list[Token]]], int] | None:
    """Read "are 50 km/h for the ego and 40 km/h for the hero"."""
    if not tokens[at].tags.keys() & {"be", "colon"}:
        return None
    at += 1
    shares: list[tuple[Token, list[Token]]] = []
    while len(shares) < 2:
        amount = tokens[at]
        if not _is_speed(amount) or tokens[at + 1].text.lower() not in ("for", "of"):
            return None
        end = _name_end(tokens, at + 2)
        if end is None:
            return None
        shares.append((amount, tokens[at + 2 : end]))
        at = end + (len(shares) < 2 and _is_joint(tokens[end]))
    return shares, at


def _names_then_speeds(tokens: list[Token], at: int) -> tuple[list[tuple[Token, list[Token]]], int] | None:
    """Read "of the ego and the hero are 50 km/h and 40 km/h"."""
    if tokens[at].text.lower() not in ("of", "for"):
        return None
    first = _name_end(tokens, at + 1)
    second = _name_end(tokens, first + 1) if first is not None and _is_joint(tokens[first]) else None
    if first is None or second is None or "be" not in tokens[second].tags or len(tokens) < second + 5:
        return None
    one, joint, two = tokens[second + 1 : second + 4]
    if not (_is_speed(one) and _is_joint(joint) and _is_speed(two)):
        return None
    end = second + 4
    end += "comma" in tokens[end].tags and "respectively" in tokens[end + 1].tags
    end += "respectively" in tokens[end].tags
    return [(one, tokens[at + 1 : first]), (two, tokens[first + 1 : second])], end


def _is_speed(token: Token) -> bool:
    return token.quantity is not None and token.quantity.dimension == "speed"


def _is_joint(token: Token) -> bool:
    return "comma" in token.tags or token.tags.get("link") == "and"


def _name_end(tokens: list[Token], at: int) -> int | None:
    """Return the position after "the hero", "a red van"; None where no vehicle is named."""
    end = at
    while tokens[end].tags.keys() & _NAMED:
        end += 1
    return end if any(each.tags.keys() & _NAMES for each in tokens[at:end]) else None
