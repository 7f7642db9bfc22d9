"""Cuts a text into tokens with an end after each line of notes, tables and lists, but not where prose is wrapped.

What enters: the text. What leaves: tokens. Lines are ends where they are short or begin with a label; the bars of a
table part clauses; keys joined by underscores are read as words; a word that was corrected to a vehicle is left as it
was written.
"""

from __future__ import annotations

import re
from dataclasses import replace

from scenewright.errors import Span
from scenewright.translate.aliases import letters
from scenewright.translate.gist.disclaimers import disclaimers
from scenewright.translate.gist.idioms import without_idioms
from scenewright.translate.notes import abbreviated, same_unit
from scenewright.translate.tokens import Token, tokenise
from scenewright.units import unit_of_name

_KEY = re.compile(
    r"^[ \t]*[A-Za-z]+(?:_[A-Za-z0-9]+)+(?=[ \t]*:)|(?<=:)[ \t]*[A-Za-z]+(?:_[A-Za-z0-9]+)+[ \t]*$", re.MULTILINE
)
_WRAPPED_AT = 70
_BOLD = re.compile(r"\*\*|__(?=\S)|(?<=\S)__")
# "Trigger - ego 3 s from it" at the beginning of a line
_DASHED = re.compile(r"^([ \t]*(?:[-*] )?[A-Za-z][\w ()]{0,30}?) ([-\u2013\u2014])(?= )", re.MULTILINE)
_HASH = re.compile(r"^[ \t]*#{1,6}(?= )", re.MULTILINE)
_PLUS = re.compile(r"(?<= )[+&](?= )")


def laid_out(text: str, name: str) -> list[Token]:
    """Return the tokens of a text, with its lines and bars as ends and commas."""
    tokens = tokenise(_plain(text), name)
    if re.search(r"\bmotor ?(?:bike|cycle)", text, re.IGNORECASE):
        tokens = [
            replace(token, tags={"noun": "motorcycle"}) if token.text.lower() == "bike" else token for token in tokens
        ]
    tokens = _named_by_letter(_makes(abbreviated(tokens)), letters(text))
    tokens = _without_short_names([_bar(_as_written(token)) for token in tokens])
    return same_unit(_with_lines(_is(_nought(tokens)), text))


def _plain(text: str) -> str:
    """Return the text with keys such as "ego_route" as words, without marks; every character keeps its place."""
    text = _BOLD.sub("  ", text)
    text = _HASH.sub(lambda found: " " * len(found.group()), text)
    for span in disclaimers(text):
        text = text[: span.start] + " " * (span.end - span.start) + text[span.end :]
    if "\n" in text.strip():
        text = _DASHED.sub(r"\1 :", text)
    text = _PLUS.sub(",", text)
    text = without_idioms(text)
    spaced = _KEY.sub(
        lambda found: found.group() if unit_of_name(found.group().strip()) else found.group().replace("_", " "), text
    )
    return re.sub(r"-{2,}", lambda found: " " * len(found.group()), spaced) if "|" in text else spaced


def _makes(tokens: list[Token]) -> list[Token]:
    """Return the tokens with "a white Transit" as a word that is not known, and no verb."""
    makes = set()
    for at, token in enumerate(tokens):
        back = at - 1
        while back > 0 and "actor_adjective" in tokens[back].tags and "verb" not in tokens[back].tags:
            back -= 1
        if _is_capital(token) and back >= 0 and "determiner" in tokens[back].tags:
            makes.add(token.text)
    return [replace(each, tags={"unknown": each.text}) if each.text in makes else each for each in tokens]


def _is_capital(token: Token) -> bool:
    """Whether a verb is written like a name."""
    return token.text[:1].isupper() and token.text[1:].islower() and "verb" in token.tags


def _named_by_letter(tokens: list[Token], names: dict[str, str]) -> list[Token]:
    """Return the tokens with "A" and "B" as vehicles where they do something: "when A is 19 m from it"."""
    return [
        replace(token, tags={names[token.text]: names[token.text]})
        if token.text in names
        and at + 1 < len(tokens)
        and (tokens[at + 1].tags.keys() & {"be", "auxiliary", "quantity", "genitive"} or "s" in tokens[at + 1].forms)
        else token
        for at, token in enumerate(tokens)
    ]


def _as_written(token: Token) -> Token:
    """Return a word as it was written where it was corrected to a vehicle: "loader" is no slip of "leader"."""
    if token.slips and token.tags.keys() & {"noun", "hero", "ego", "actor_adjective", "unsupported"}:
        return replace(token, text=token.slips[0][0], tags={"unknown": token.slips[0][0]}, slips=())
    return token


def _is(tokens: list[Token]) -> list[Token]:
    """Return the tokens with "the Chevy's 11 m from it" as "is 11 m"."""
    return [
        replace(token, tags={"be": "be"})
        if "genitive" in token.tags
        and at + 1 < len(tokens)
        and (tokens[at + 1].quantity is not None or "determiner" in tokens[at + 1].tags)
        else token
        for at, token in enumerate(tokens)
    ]


def _nought(tokens: list[Token]) -> list[Token]:
    """Return the tokens with "brakes to 0" and "stays at 0" as a stop."""
    return [
        replace(token, tags={"stop_noun": "stop"})
        if token.text == "0" and "bare_number" in token.tags and at and tokens[at - 1].text.lower() in ("to", "at")
        else token
        for at, token in enumerate(tokens)
    ]


def _bar(token: Token) -> Token:
    return replace(token, tags={"comma": "|"}) if token.text == "|" else token


def _without_short_names(tokens: list[Token]) -> list[Token]:
    """Leave "(CP)" out after "conflict point", and "(TTC)" after "time to collision": they say the same."""
    kept: list[Token] = []
    skip = 0
    for at, token in enumerate(tokens):
        inside = tokens[at + 1] if at + 2 < len(tokens) and tokens[at + 2].text == ")" else None
        same = kept and inside is not None and token.text == "(" and _means_same(kept[-1], inside)
        skip = 3 if same else skip
        if skip:
            skip -= 1
        else:
            kept.append(token)
    return kept


def _means_same(first: Token, second: Token) -> bool:
    return any(key in first.tags and first.tags[key] == second.tags.get(key) for key in ("measure", "landmark", "ego"))


def _with_lines(tokens: list[Token], text: str) -> list[Token]:
    lines = text.strip().split("\n")
    wrapped = len(lines) > 1 and all(len(line) >= _WRAPPED_AT for line in lines[:-1])
    if wrapped or len(lines) < 2:
        return tokens
    read: list[Token] = []
    for token in tokens:
        if read and "end" not in read[-1].tags and "end" not in token.tags:
            between = text[read[-1].span.end : token.span.start]
            if "\n" in between:
                at = read[-1].span.end + between.index("\n")
                read.append(Token("\n", Span(at, at + 1), {"end": "\n"}))
        read.append(token)
    return read
