"""Cuts a description into word pieces for the network, with one mark in place of each amount.

What enters: a text and its amounts. What leaves: piece numbers, the position of each mark, and where in the text every
piece stands. The pieces are those of BERT's uncased vocabulary; a value is not seen, only of what kind it is.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scenewright.errors import Span
from scenewright.program.expressions import ParameterRef
from scenewright.translate.tokens import Quantity

_WORD = re.compile(r"[^\W_]+|[^\w\s]|_")
_DIMENSIONS = ("length", "time", "speed", "acceleration")
_FIRST, _LAST, _STRANGE = "[CLS]", "[SEP]", "[UNK]"


@dataclass(frozen=True, slots=True)
class Pieces:
    """A text as the network sees it.

    Attributes
    ----------
    numbers
        A number for each piece, its place in the vocabulary.
    marks
        The position of each amount, in the order of the text.
    spans
        Where in the text each piece stands; empty for the first and the last, which stand nowhere.
    """

    numbers: tuple[int, ...]
    marks: tuple[int, ...]
    spans: tuple[Span, ...]


def cut(text: str, amounts: Sequence[Quantity], vocabulary: Mapping[str, int]) -> Pieces:
    """Cut `text`; `amounts` are what it holds, in its order."""
    numbers, marks, spans = [vocabulary[_FIRST]], [], [Span(0, 0)]
    at = 0
    for amount in amounts:
        _words(text, at, amount.span.start, vocabulary, numbers, spans)
        marks.append(len(numbers))
        numbers.append(vocabulary[mark_of(amount)])
        spans.append(amount.span)
        if isinstance(amount.term, ParameterRef):  # its name says what it is
            for word in amount.term.name.lower().split("_"):
                found = _pieces(word, vocabulary)
                numbers += found
                spans += [amount.span] * len(found)
        at = amount.span.end
    _words(text, at, len(text), vocabulary, numbers, spans)
    return Pieces((*numbers, vocabulary[_LAST]), tuple(marks), (*spans, Span(len(text), len(text))))


def mark_of(amount: Quantity) -> str:
    """Return the piece that stands for an amount: one of BERT's unused ones for each dimension, two kinds of each."""
    named = isinstance(amount.term, ParameterRef)
    return f"[unused{1 + _DIMENSIONS.index(amount.dimension) + named * len(_DIMENSIONS)}]"


def _words(
    text: str, start: int, end: int, vocabulary: Mapping[str, int], numbers: list[int], spans: list[Span]
) -> None:
    for word in _WORD.finditer(text, start, end):
        decomposed = unicodedata.normalize("NFD", word.group().lower())
        found = _pieces("".join(c for c in decomposed if not unicodedata.combining(c)), vocabulary)
        numbers += found
        spans += [Span(*word.span())] * len(found)


def _pieces(word: str, vocabulary: Mapping[str, int]) -> list[int]:
    """Cut a word into the longest pieces that are known, from its beginning."""
    found, at = [], 0
    while at < len(word):
        ends = range(len(word), at, -1)
        known = (end for end in ends if ("##" if at else "") + word[at:end] in vocabulary)
        end = next(known, None)
        if end is None:
            return [vocabulary[_STRANGE]]
        found.append(vocabulary[("##" if at else "") + word[at:end]])
        at = end
    return found
