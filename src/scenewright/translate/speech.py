"""Gives spoken English its written order: "there's this van", "Along comes a bus", "... : that's when the van brakes".

What enters: tokens. What leaves: tokens in the order and with the classes of a written sentence. It adds no amount and
drops none, and drops no verb; what it is not sure of it leaves as it was, to be refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from scenewright.errors import Span
from scenewright.translate.notes import begins, sentence_end
from scenewright.translate.tokens import Token

_NAMED = frozenset(("ego", "hero", "noun", "determiner", "actor_adjective", "heading"))
_NAMES = frozenset(("ego", "hero", "noun"))
_ACTS = ("brake", "stop", "yield", "accelerate", "pass", "complete", "keep", "not_yield", "beat", "reach")
_IS = frozenset(("be", "genitive"))
_BESIDE = ("just as", "just when", "right as", "right when", "as", "just at the moment when")
_OPENERS = ("right", "ok", "okay", "well", "now", "alright")
_ORDERS = ("along", "up", "here", "then along", "and along")


def spoken(tokens: list[Token]) -> list[Token]:
    """Return the tokens of spoken English as those of written English."""
    tokens = _in_which(_there_drives(_has_still(_sides(_told_twice(tokens)))))
    return _beside(_turn_first(_along_comes(_just_does(_that_is_when(_this_one(tokens))))))


def _told_twice(tokens: list[Token]) -> list[Token]:
    """Let "The van, it's in the driveway" be "The van is in the driveway", and drop "Right," in front of a text."""
    read: list[Token] = []
    at = 2 if len(tokens) > 2 and tokens[0].text.lower() in _OPENERS and "comma" in tokens[1].tags else 0
    while at < len(tokens):
        end = _name_end(tokens, at) if begins(tokens, at) else None
        again = end is not None and "comma" in tokens[end].tags and "pronoun" in tokens[end + 1].tags
        finite = (
            again
            and end is not None
            and (bool(tokens[end + 2].tags.keys() & {*_IS, "auxiliary"}) or "s" in tokens[end + 2].forms)
        )
        if not finite or end is None:
            read.append(tokens[at])
            at += 1
            continue
        read += tokens[at:end]
        at = end + 2
    return read


def _sides(tokens: list[Token]) -> list[Token]:
    """Let "turns to the right side" be "turns to the right"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        sided = at > 2 and token.text.lower() == "side" and tokens[at - 1].tags.get("direction") in ("left", "right")
        if not (sided and "determiner" in tokens[at - 2].tags and tokens[at - 3].text.lower() == "to"):
            read.append(token)
    return read


def _has_still(tokens: list[Token]) -> list[Token]:
    """Let "has still a distance of 40 m" be "has a distance of 40 m"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        has = at > 0 and tokens[at - 1].tags.get("auxiliary") == "have" and at + 1 < len(tokens)
        told = has and (
            tokens[at + 1].quantity is not None or bool(tokens[at + 1].tags.keys() & {"determiner", "measure"})
        )
        if not (told and token.text.lower() in ("still", "only", "just", "got")):
            read.append(token)
    return read


def _there_drives(tokens: list[Token]) -> list[Token]:
    """Let "There a truck is driving west" be "A truck is driving west": there is on the road told before."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        fresh = begins(tokens, at) and token.tags.get("link") == "there"  # "There the van stops" tells of a place
        fresh = fresh and tokens[at + 1].tags.get("determiner") == "indefinite"
        end = _name_end(tokens, at + 1) if fresh else None
        drives = end is not None and bool(tokens[end].tags.keys() & {"be", "auxiliary"} or "s" in tokens[end].forms)
        if not drives:
            read.append(token)
    return read


def _in_which(tokens: list[Token]) -> list[Token]:
    """Let "at the moment, in which the ego is 12 m from it" be "when the ego is 12 m from it"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        read.append(tokens[at])
        told = tokens[at].tags.get("link") == "when" and at + 2 < len(tokens) and "comma" in tokens[at + 1].tags
        named = told and tokens[at + 2].text.lower() in ("in which", "at which", "when", "where")
        at += 3 if named else 1
    return read


def _this_one(tokens: list[Token]) -> list[Token]:
    """Let "there's this van" be "there is a van": spoken English points at what it brings in."""
    read: list[Token] = []
    for at, token in enumerate(tokens[:-1]):
        after = tokens[at + 1].tags
        brings = at > 1 and tokens[at - 2].tags.get("link") == "there" and tokens[at - 1].tags.keys() & _IS
        named = after.keys() & {"noun", "hero", "actor_adjective"}
        next_there = after.get("link") == "there" and bool(tokens[min(at + 2, len(tokens) - 1)].tags.keys() & _IS)
        if begins(tokens, at) and _links(token.tags) and next_there:
            continue  # "Then there's a van": told next, and not later
        if token.tags.get("link") == "then" and next_there and not any(_links_when(each) for each in tokens[:at]):
            read.append(replace(token, tags={"link": "and"}))  # ", and then there's a van"
            continue
        pointed = brings and named and token.text.lower() == "this"
        read.append(replace(token, tags={"determiner": "indefinite"}) if pointed else token)
    return [*read, tokens[-1]]


def _links_when(token: Token) -> bool:
    return token.tags.get("link") == "when" or token.tags.get("label") == "when"


def _that_is_when(tokens: list[Token]) -> list[Token]:
    """Let "The ego is 4 s from it: that's when the van brakes" be "When the ego is 4 s from it, the van brakes"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        start = _moment_before(tokens, at, read) if tokens[at].text.lower() == "that" else None
        if start is None:
            read.append(tokens[at])
            at += 1
            continue
        if read[-1].tags.get("link") == "and":
            read.pop()
        if read[-1].tags.keys() & {"end", "colon"}:
            read[-1] = replace(read[-1], tags={"comma": ","})
        if "frame" in read[start].tags:  # "Say the ego is 4 s from it: that's when ..."
            del read[start]
        front = Span(read[start].span.start, read[start].span.start)
        if not _links_when(read[start]):
            read.insert(start, Token("when", front, {"link": "when"}))
        at += 3
    return read


def _moment_before(tokens: list[Token], at: int, read: list[Token]) -> int | None:
    """Return where the sentence begins that "that's when" points back to: one that tells amounts and no deed."""
    told = at + 2 < len(tokens) and bool(tokens[at + 1].tags.keys() & {"be", "genitive"})
    told = told and tokens[at + 2].tags.get("link") == "when"
    joined = bool(read) and read[-1].tags.get("link") == "and"
    if not told or not read or not (joined or read[-1].tags.keys() & {"end", "colon", "comma"}):
        return None
    start = len(read) - 1 - joined
    while start > 0 and "end" not in read[start - 1].tags:
        start -= 1
    before = read[start : len(read) - 1 - joined]
    amounts = [token for token in before if token.quantity is not None]
    linked = any(token.tags.get("link") in ("when", "before", "after", "until", "then") for token in before[1:])
    acts = any(token.tags.get("verb") in _ACTS for token in before) or any(
        "label" in token.tags for token in before[1:]
    )
    fits = amounts and all(each.quantity and each.quantity.dimension in ("length", "time") for each in amounts)
    return start if fits and not linked and not acts else None


def _just_does(tokens: list[Token]) -> list[Token]:
    """Let "just follows the road" and "is just following the road" be what it does, without "just"."""
    read: list[Token] = []
    for at, token in enumerate(tokens[:-1]):
        after = tokens[at + 1]
        verb = "verb" in after.tags and bool(after.forms & {"ing", "s", "base"}) and "event_noun" not in after.tags
        relation = after.tags.get("relation") in ("ahead", "behind") and begins(tokens, at)
        denied = at > 0 and "negation" in tokens[at - 1].tags  # "does not just brake" does more
        if token.text.lower() in ("just", "simply", "merely") and verb and not denied:
            continue
        if token.tags.get("adverb") == "just" and relation:  # "Directly in front of the ego drives a van"
            continue
        read.append(token)
    return [*read, tokens[-1]]


def _along_comes(tokens: list[Token]) -> list[Token]:
    """Let "Along comes the hero from the left" be "The hero comes along from the left"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        fresh = begins(tokens, at) or tokens[at - 1].tags.keys() & {"comma"} or _links(tokens[at - 1].tags)
        comes = at + 1 < len(tokens) and tokens[at + 1].tags.get("verb") in ("come", "drive")
        comes = comes and "s" in tokens[at + 1].forms
        end = _name_end(tokens, at + 2) if fresh and comes and tokens[at].text.lower() in _ORDERS else None
        if end is None:
            read.append(tokens[at])
            at += 1
            continue
        read += [*tokens[at + 2 : end], tokens[at + 1]]
        at = end
    return read


def _links(tags: Mapping[str, str]) -> bool:
    return tags.get("link") in ("and", "then")


def _name_end(tokens: list[Token], at: int) -> int | None:
    """Return the position after "the hero", "a red van"; None where no vehicle is named."""
    start = at
    while tokens[at].tags.keys() & _NAMED and "end" not in tokens[at].tags:
        at += 1
        if tokens[at - 1].tags.keys() & _NAMES and not tokens[at].tags.keys() & _NAMES:
            break
    return at if at > start and tokens[at - 1].tags.keys() & _NAMES and "genitive" not in tokens[at].tags else None


def _turn_first(tokens: list[Token]) -> list[Token]:
    """Let "By a left turn, the ego wants to enter the road" be "The ego wants to enter the road by a left turn"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        comma = _turn_in_front(tokens, at)
        if comma is None:
            read.append(tokens[at])
            at += 1
            continue
        end = comma + 1
        while not tokens[end].tags.keys() & {"comma", "end", "colon"} and not _links(tokens[end].tags):
            end += 1
        clause = tokens[comma + 1 : end]
        turned = any("direction" in token.tags or token.quantity is not None for token in clause)
        read += tokens[at:end] if turned else [*clause, *tokens[at:comma]]
        at = end
    return read


def _turn_in_front(tokens: list[Token], at: int) -> int | None:
    """Return the position of the comma after "By a left turn," at the beginning of a sentence, or None."""
    if not begins(tokens, at) or tokens[at].text.lower() not in ("by", "with", "by means of", "via", "in"):
        return None
    end = at + 1 + ("determiner" in tokens[at + 1].tags)
    turn = tokens[end].tags.get("direction") in ("left", "right") and "event_noun" in tokens[end + 1].tags
    turns = end == at + 1 and tokens[end].tags.get("verb") == "turn" and "ing" in tokens[end].forms
    turn = turn or (turns and tokens[end + 1].tags.get("direction") in ("left", "right"))  # "By turning left,"
    comma = turn and "comma" in tokens[end + 2].tags and _name_end(tokens, end + 3) is not None
    return end + 2 if comma else None


def _beside(tokens: list[Token]) -> list[Token]:
    """Let "wants to join the road, just as the ego is coming along it" tell of both, where no amount makes a moment."""
    read = list(tokens)
    for at, token in enumerate(tokens):
        if token.text.lower() not in _BESIDE or token.tags.get("link") != "when" or begins(tokens, at):
            continue
        start = at
        while not begins(tokens, start):
            start -= 1
        sentence = tokens[start : sentence_end(tokens, at)]
        told = any(each.quantity is not None or each.tags.get("verb") in _ACTS for each in sentence)
        linked = any(
            each.tags.get("link") in ("when", "before", "until", "after") for each in sentence if each is not token
        )
        if not told and not linked and not any("negation" in each.tags for each in sentence):
            read[at] = replace(token, tags={"link": "and"})
    return read
