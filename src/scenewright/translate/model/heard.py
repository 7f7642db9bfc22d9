"""A text as typed chunks with the people of a reply in it: who is spoken of at a place of it, and which place is meant.

What enters: a text and the words by which it names each actor. What leaves: sets of what is possible, empty where the
words do not tell. Words that nobody knows are no fault: they only leave more open.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from scenewright.errors import Span
from scenewright.program.types import EGO
from scenewright.translate.model.schema import locate
from scenewright.translate.read.chunks import Chunk, sentences

_PREDICATES = ("be", "state", "event", "phase", "deed", "turn", "mood", "order", "kept", "amount")


def people(*chunks: Chunk) -> set[int]:
    """Return whom names stand for."""
    return {int(number) for each in chunks if each.kind == "who" for number in each.value.split()}


def lies_in(start: int, end: int, spans: Sequence[Span]) -> bool:
    """Whether a stretch lies in one of `spans`."""
    return any(each.start <= start and end <= each.end for each in spans)


def meets(start: int, end: int, spans: Sequence[Span | Chunk]) -> bool:
    """Whether a stretch has something in common with one of `spans`."""
    return any(each.start < end and start < each.end for each in spans)


def words_in(*texts: str) -> set[str]:
    """Return the words of texts, whatever their case."""
    return set(re.findall(r"\w+", " ".join(texts).lower()))


def _is_head(own: Sequence[Chunk], at: int) -> bool:
    """Whether a name or "it" is whom a clause speaks of: what it does or is follows."""
    if own[at].kind != "who" and (own[at].kind, own[at].value) != ("pronoun", "it"):
        return False
    return at + 1 < len(own) and own[at + 1].kind in _PREDICATES


@dataclass(slots=True)
class Heard:
    """The chunks of a text by sentence; a name of somebody is of kind ``who``, its value the numbers of whose it is."""

    text: str
    called: Mapping[int, Sequence[str]]
    said: list[list[Chunk]] = field(init=False)

    def __post_init__(self) -> None:
        named: dict[tuple[int, int], set[int]] = {}
        for number, own in self.called.items():
            for span in (span for words in own for span in locate(words, self.text)):
                named.setdefault((span.start, span.end), set()).add(number)
        taken: list[Chunk] = []
        for start, end in sorted(named, key=lambda each: each[0] - each[1]):  # the longest first
            if not meets(start, end, taken):
                value = " ".join(map(str, sorted(named[start, end])))
                taken.append(Chunk("who", value, start, end, self.text[start:end]))
        self.said = []
        for plain in sentences(self.text) or [[Chunk("unknown", "", 0, len(self.text), self.text)]]:
            chunks = [each for chunk in plain for each in (*chunk.traits, chunk)]
            own_names = [each for each in taken if each.end >= chunks[0].start and each.start < chunks[-1].end]
            chunks = [replace(each, kind="who", value=str(EGO)) if each.value == "ego" else each for each in chunks]
            kept = [chunk for chunk in chunks if chunk.kind not in ("who", "actor", "name", "unknown")
                    or not meets(chunk.start, chunk.end, own_names)]  # fmt: skip
            self.said.append(sorted([*kept, *own_names], key=lambda chunk: (chunk.start, -chunk.end)))

    def within(self, span: Span) -> list[Chunk]:
        """Return the chunks that lie in a stretch."""
        return [each for own in self.said for each in own if lies_in(each.start, each.end, [span])]

    def named(self, span: Span) -> set[int]:
        """Return of whom a stretch is by its own words: of all where it says "both", or of the only one it names."""
        own = self.within(span)
        if any(each.kind == "pair" for each in own):
            return set(self.called)
        return who if len(who := people(*own)) == 1 else set()

    def sentence(self, at: int) -> tuple[int, list[Chunk], int]:
        """Return the number and the chunks of the sentence at a place of the text, and which chunk is there."""
        number = next((number for number, own in enumerate(self.said) if at < own[-1].end), len(self.said) - 1)
        own = self.said[number]
        return number, own, next((index for index, each in enumerate(own) if each.end > at), len(own) - 1)

    def clause(self, at: int) -> list[Chunk]:
        """Return the chunks at a place of the text from whom it speaks of to whom it speaks of next."""
        _, own, index = self.sentence(at)
        parts = [place for place, each in enumerate(own) if each.kind == "link" or _is_head(own, place)]
        start = max((place for place in parts if place <= index), default=0)
        return own[start : min((place for place in parts if place > index), default=len(own))]

    def place(self, at: int) -> str | None:
        """Return the place that an amount is counted to: the nearest, in its own clause and after it where there is."""
        (_, own, _), near = self.sentence(at), self.clause(at)
        places = [each for each in own if each.kind == "place"]
        places.sort(key=lambda each: (each not in near, each.start < at, abs(each.start - at)))
        return places[0].value if places else None

    def subjects(self, at: int) -> set[int]:
        """Return who may be spoken of at a place: who is named last before it, else next after it."""
        number, own, index = self.sentence(at)
        named = (place for place, each in enumerate(own) if each.kind == "who" or _is_head(own, place))
        found = min(named, key=lambda place: (place > index, abs(place - index)), default=0)
        if own[found].kind == "who":
            return people(own[found])
        # "It", or nobody: those named before in the sentence, and in those before, back to one that begins with a name.
        earlier = set[int]()
        for before in reversed(self.said[:number]):
            earlier |= people(*before)
            if next((each.kind for each in before if each.kind in ("who", "pronoun")), "") == "who":
                break
        return people(*own[:found]) | earlier
