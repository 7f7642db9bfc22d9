"""Gives notes without verbs their meaning: "right turn out", "Gap 12 m -> hero brakes", "30 m and 26 m respectively".

What enters: tokens. What leaves: tokens in which such a note stands as the sentence that the reader of clauses knows.
It adds no amount and drops none; what it is not sure of it leaves as it was, to be refused.
"""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction

from scenewright.errors import Span
from scenewright.program.expressions import Number
from scenewright.translate.lexicon import load_lexicon
from scenewright.translate.numerals import number_in_words
from scenewright.translate.tokens import Quantity, Token
from scenewright.units import UNITS

_NAMES = frozenset(("ego", "hero", "noun"))
_NAMED = frozenset((*_NAMES, "determiner", "actor_adjective", "heading", "genitive", "pronoun"))
_ARROWS = ("->", "-->", "=>", "→", "⇒")
_DEEDS = ("brake", "stop", "yield", "accelerate", "go", "pass", "complete", "keep", "turn", "come")
_DONE = ("completed", "finished", "done", "complete")
_TURNS = {"RT": "right", "LT": "left"}
_AFTER_OUT = ("comma", "end", "colon")


def noted(tokens: list[Token]) -> list[Token]:
    """Return the tokens with notes as sentences."""
    tokens = _turned_out(_drives_in(_leads(_stop_noted(abbreviated(tokens)))))
    return _turn_completed(_respectively(same_unit(_arrows(_through(tokens)))))


def begins(tokens: list[Token], at: int) -> bool:
    """Whether a sentence begins at a position."""
    return at == 0 or "end" in tokens[at - 1].tags


def sentence_end(tokens: list[Token], at: int) -> int:
    """Return the position of the stop that ends the sentence."""
    while "end" not in tokens[at].tags:
        at += 1
    return at


def abbreviated(tokens: list[Token]) -> list[Token]:
    """Let "RT" and "LT" in capitals be turns and "@" be "at", as in tickets."""
    read: list[Token] = []
    for token in tokens:
        direction = _TURNS.get(token.text) if "unknown" in token.tags else None
        if direction is not None:
            read.append(replace(token, tags={"direction": direction}))
            read.append(replace(token, tags={"event_noun": "turn", "verb": "turn"}, forms=frozenset(("base",))))
        elif token.text == "@":
            read.append(replace(token, text="at", tags={"preposition": "at"}))
        else:
            read.append(token)
    return read


def _stop_noted(tokens: list[Token]) -> list[Token]:
    """Let "Hero: full stop 2 m before it" and "Reaction: full stop" be "stops", and ", no stop" be "does not stop"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        noun = "stop_noun" in token.tags and "end" not in token.tags and at > 1
        headed = noun and "colon" in tokens[at - 1].tags and tokens[at - 1].text == ":"
        if headed and tokens[at - 2].tags.keys() & {"hero", "noun"}:
            read.append(replace(token, tags={"verb": "stop"}, forms=frozenset(("s",))))
        elif headed and tokens[at - 2].tags.get("label") == "main":
            read.append(replace(token, tags={"verb": "stop"}, forms=frozenset(("base",))))
        elif noun and tokens[at - 1].text.lower() == "no" and "comma" in tokens[at - 2].tags:
            read[-1] = replace(tokens[at - 1], tags={"negation": "not"})
            read.append(replace(token, tags={"verb": "stop"}, forms=frozenset(("s",))))
        else:
            read.append(token)
    return read


def _leads(tokens: list[Token]) -> list[Token]:
    """Let "Lead car ahead" be a car and no command to lead one."""
    read = list(tokens)
    for at, token in enumerate(tokens[:-1]):
        adjective = "actor_adjective" in token.tags and "verb" in token.tags and "noun" in tokens[at + 1].tags
        if token.text.lower() == "lead" and adjective and begins(tokens, at):
            tags = {key: tag for key, tag in token.tags.items() if key != "verb"}
            read[at] = replace(token, tags=tags, forms=frozenset())
    return read


def _drives_in(tokens: list[Token]) -> list[Token]:
    """Let "both drive in direction west" be a verb and its preposition, and no "drive-in"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        named = at == 0 or tokens[at - 1].tags.keys() & {"determiner", "area_adjective", "possessive", "preposition"}
        if token.text.lower() != "drive in" or named:
            read.append(token)
            continue
        middle = token.span.start + len("drive")
        read.append(Token("drive", Span(token.span.start, middle), {"verb": "drive"}, frozenset(("base",))))
        read.append(Token("in", Span(middle + 1, token.span.end), {"preposition": "in"}))
    return read


def _turned_out(tokens: list[Token]) -> list[Token]:
    """Let "right turn out" and "goes left, out onto the road" be a turn out of the driveway."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        after = tokens[at + 1] if at + 1 < len(tokens) else token
        before = read[-1] if read else token
        if before.tags.get("comma") == "," and len(read) > 1 and after.tags.get("preposition") == "into":
            before = read[-2]
        turned = before.tags.get("event_noun") == "turn" or before.tags.get("direction") in ("left", "right")
        turned = turned or before.tags.get("verb") == "turn"
        closes = bool(after.tags.keys() & {*_AFTER_OUT}) or after.tags.get("preposition") == "into"
        closes = closes or after.tags.get("link") in ("and", "when", "then")
        if token.text.lower() != "out" or not turned or not closes:
            read.append(token)
            continue
        if read[-1] is not before:
            read.pop()
        read.append(Token("out of", token.span, {"preposition": "out"}))
        read.append(Token("the", token.span, {"determiner": "definite"}))
        read.append(Token("driveway", token.span, {"area": "driveway"}))
    return read


def _through(tokens: list[Token]) -> list[Token]:
    """Let "Hero: westbound through traffic" and "POV: westbound through vehicle" be "Hero: westbound, straight"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        words = tokens[at].text.lower()
        plain = words == "through" and tokens[at + 1].text.lower() in ("traffic", "vehicle", "car")
        end = at + 2 if plain else at + 1
        noted_so = (plain or tokens[at].tags.get("noun") == "through_one") and _after_name(tokens, at)
        if not noted_so or not tokens[end].tags.keys() & {"end", "comma"}:
            read.append(tokens[at])
            at += 1
            continue
        read.append(Token(",", Span(tokens[at].span.start, tokens[at].span.start), {"comma": ","}))
        read.append(replace(tokens[at], tags={"direction": "straight"}, forms=frozenset()))
        at = end
    return read


def _after_name(tokens: list[Token], at: int) -> bool:
    """Whether "Hero: westbound" stands in front of a position and nothing else of its sentence."""
    if at < 3 or "heading" not in tokens[at - 1].tags or "colon" not in tokens[at - 2].tags:
        return False
    return bool(tokens[at - 3].tags.keys() & {"ego", "hero"})


def _arrows(tokens: list[Token]) -> list[Token]:
    """Let "Gap 12 m -> hero brakes" be "Trigger: gap 12 m. Hero brakes"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        read.append(token)
        if token.text not in _ARROWS or "colon" not in token.tags:
            continue
        start = at
        while not begins(tokens, start):
            start -= 1
        condition, told = tokens[start:at], tokens[at + 1 : sentence_end(tokens, at)]
        if not _is_condition(condition) or not any(each.tags.get("verb") in _DEEDS for each in told):
            continue
        front = Span(condition[0].span.start, condition[0].span.start)
        read[-1] = replace(token, tags={"end": token.text})
        label = [Token("trigger", front, {"label": "when"}), Token(":", front, {"colon": ":"})]
        read[len(read) - 1 - len(condition) : len(read) - 1 - len(condition)] = label
    return read


def _is_condition(tokens: list[Token]) -> bool:
    """Whether a note tells amounts and no deed: "ego at 24 m, hero at 40 m to the conflict point"."""
    amounts = [token.quantity for token in tokens if token.quantity is not None]
    told = any(token.tags.keys() & {"label", "colon", "be", "auxiliary"} for token in tokens)
    deeds = any("verb" in token.tags and not token.tags.keys() & {"event_noun", "noun"} for token in tokens)
    linked = any(token.tags.get("link") not in (None, "and", "to") for token in tokens)
    fits = bool(amounts) and all(amount.dimension in ("length", "time") for amount in amounts)
    return fits and not (told or deeds or linked)


def same_unit(tokens: list[Token]) -> list[Token]:
    """Let "the ego has five seconds left to it and the hero four" be "... and the hero four seconds"."""
    read = list(tokens)
    last: Token | None = None
    for at, token in enumerate(tokens[:-1]):
        if "end" in token.tags:
            last = None
        last = token if token.quantity is not None else last
        back = at - 1
        while back > 0 and tokens[back].text.lower() in ("has", "got", "has got", "'s", "\u2019s", "is", "'s got"):
            back -= 1
        named = back >= 0 and bool(tokens[back].tags.keys() & {*_NAMES, "pronoun"})
        closes = bool(tokens[at + 1].tags.keys() & {"comma", "end", "colon"})
        closes = closes or (named and tokens[at + 1].text.lower() in ("to", "from") and _leads_to_place(tokens, at + 2))
        ahead = at + 2 + ("determiner" in tokens[min(at + 2, len(tokens) - 1)].tags)
        whose = (
            tokens[at + 1].text.lower() == "for" and ahead < len(tokens) and bool(tokens[ahead].tags.keys() & _NAMES)
        )
        whose = whose and bool(tokens[at - 1].tags.keys() & {"comma", "link"})  # "and four for the hero"
        if "bare_number" not in token.tags or last is None or last.quantity is None:
            continue
        if not ((named and closes) or whose):
            continue
        factor, value = _factor(last), _value(token.text)
        if factor is None or value is None or last.quantity.dimension not in ("length", "time"):
            continue
        quantity = Quantity(Number(value * factor, token.span), last.quantity.dimension, token.span)
        tags = {"quantity": last.quantity.dimension, "unit_before": "x"}
        read[at] = replace(token, tags=tags, quantity=quantity)
    return read


def _leads_to_place(tokens: list[Token], at: int) -> bool:
    """Whether a place stands here: "and he has got 30 to the conflict point"."""
    while at < len(tokens) and "determiner" in tokens[at].tags:
        at += 1
    return at < len(tokens) and "landmark" in tokens[at].tags


def _factor(token: Token) -> Fraction | None:
    """Return what the unit at the end of an amount is worth: 0.3048 for "12 feet"."""
    found = re.search(r"[^\W\d]+$", token.text)
    symbol = load_lexicon().units.get(found.group().lower()) if found else None
    return UNITS[symbol].si_factor if symbol is not None else None


def _value(text: str) -> Fraction | None:
    """Return the number that is written in digits or in words."""
    if re.fullmatch(r"\d+(?:\.\d+)?", text):
        return Fraction(text)
    words = text.lower().split()
    found = number_in_words(words, 0, load_lexicon().numbers)
    return found[0] if found is not None and found[1] == len(words) else None


def _respectively(tokens: list[Token]) -> list[Token]:
    """Let "are 30 m and 26 m, respectively, from the conflict point" be "... from the conflict point respectively"."""
    read = list(tokens)
    for at, token in enumerate(tokens[:-1]):
        if "respectively" not in token.tags:
            continue
        start, after = _parted(tokens, at)
        amounts = after if tokens[after].quantity is not None else start - 3
        dealt = amounts >= 0 and tokens[amounts].quantity is not None and tokens[amounts + 2].quantity is not None
        place = amounts + 3 if amounts == after else after
        if not dealt or tokens[amounts + 1].tags.get("link") != "and" or "relation" not in tokens[place].tags:
            continue
        end = place
        while not tokens[end].tags.keys() & {"comma", "end", "colon"}:
            end += 1
        if any(each.quantity is not None or "verb" in each.tags for each in tokens[place:end]):
            continue
        read[start:end] = [*tokens[after:end], token]
        return [*read[: start + end - after + 1], *_respectively(tokens[end:])]
    return read


def _parted(tokens: list[Token], at: int) -> tuple[int, int]:
    """Return the stretch of "respectively" with the commas around it."""
    between = "comma" in tokens[at - 1].tags and "comma" in tokens[at + 1].tags
    return (at - 1, at + 2) if at and between else (at, at + 1)


def _turn_completed(tokens: list[Token]) -> list[Token]:
    """Let "then accelerates, turn completed before ego passes it" be "..., completes its turn before ..."."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        token = tokens[at]
        noun = at + 2 < len(tokens) and at > 0 and token.text.lower() == "turn" and "event_noun" in token.tags
        parted = noun and bool(tokens[at - 1].tags.keys() & {"comma", "colon"})
        done = parted and tokens[at + 1].text.lower() in _DONE and tokens[at + 2].tags.get("link") == "before"
        if not done:
            read.append(token)
            at += 1
            continue
        read.append(Token("completes", tokens[at + 1].span, {"verb": "complete"}, frozenset(("s",))))
        read += [Token("its", Span(token.span.start, token.span.start), {"possessive": "its"}), token]
        at += 2
    return read
