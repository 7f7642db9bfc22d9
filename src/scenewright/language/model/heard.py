"""A text as typed chunks with the people of a reply in it: who is spoken of at a place of it, and which place is meant.

What enters: a text and the words by which it names each actor. What leaves: sets of what is possible; an empty one where
the words do not tell. Words that nobody knows are no fault: they only leave more open.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.errors import Span
from scenewright.language.model.schema import locate
from scenewright.language.read.chunks import Chunk, sentences

_NAMES = ("actor", "name", "unknown", "pronoun")
_CUTS = ("comma", "joint", "link")  # what parts one thing that is said from another
_COLOURS = ("unknown", "harmless", "relation", "heading", "turn")  # what may stand before a name and belong to it
_PREDICATES = ("be", "state", "event", "phase", "deed", "turn", "mood", "order", "kept")
_NOT_OF_WHOM = ("before", "behind", "after", "than")


@dataclass(slots=True)
class Heard:
    """The chunks of a text by sentence; a name of somebody is of kind ``who``, its value the number."""

    text: str
    called: Mapping[int, tuple[str, ...]]
    said: list[list[Chunk]] = field(init=False)

    def __post_init__(self) -> None:
        names = [
            (span, number) for number, own in self.called.items() for words in own for span in locate(words, self.text)
        ]
        names.sort(key=lambda each: each[0].start - each[0].end)  # the longest first
        taken: list[tuple[Span, set[int]]] = []
        for span, number in names:
            same = next((each for each in taken if each[0] == span), None)
            if same:
                same[1].add(number)
            elif not any(span.start < other.end and other.start < span.end for other, _ in taken):
                taken.append((span, {number}))
        people = [
            Chunk("who", " ".join(map(str, sorted(numbers))), span.start, span.end, span.excerpt(self.text))
            for span, numbers in taken
        ]
        self.said = []
        for chunks in sentences(self.text):
            start, end = chunks[0].start, chunks[-1].end
            own = [each for each in people if start <= each.end and each.start < end]
            kept = [chunk for chunk in chunks if chunk.kind not in _NAMES
                    or not any(each.start < chunk.end and chunk.start < each.end for each in own)
                    or (chunk.kind == "pronoun" and chunk.value != "it")]  # fmt: skip
            self.said.append(sorted([*kept, *own], key=lambda chunk: (chunk.start, -chunk.end)))

    def within(self, span: Span) -> list[Chunk]:
        """Return the chunks that lie in a stretch."""
        return [each for own in self.said for each in own if span.start <= each.start and each.end <= span.end]

    def clause(self, at: int, span: Span) -> list[Chunk]:
        """Return the chunks of a stretch that are of the same clause as a place in it."""
        _, own = self.sentence(at)
        parts = [place for place, each in enumerate(own) if self._is_head(own, place) or each.kind == "link"]
        index = next((place for place, each in enumerate(own) if each.end > at), len(own))
        start = max((place for place in parts if place <= index), default=0)
        end = min((place for place in parts if place > index), default=len(own))
        return [each for each in own[start:end] if span.start <= each.start and each.end <= span.end]

    def sentence(self, at: int) -> tuple[int, list[Chunk]]:
        """Return the number and the chunks of the sentence that holds a place of the text."""
        for number, own in enumerate(self.said):
            if at < own[-1].end:
                return number, own
        return len(self.said) - 1, self.said[-1] if self.said else []

    def subjects(self, at: int) -> tuple[set[int], int | None]:
        """Return who may be spoken of at a place, and where the pronoun is that stands for it."""
        number, own = self.sentence(at)
        index = next((place for place, each in enumerate(own) if each.end > at), len(own))
        beside = next((each for each in own[index + 1 :] if each.kind not in _COLOURS), None)
        if index < len(own) and own[index].kind in _COLOURS and beside and beside.kind == "who":
            return people(beside), None  # "a westbound truck"
        start = max((place + 1 for place in range(index) if own[place].kind in _CUTS), default=0)
        end = next((place for place in range(index, len(own)) if own[place].kind in _CUTS), len(own))
        for first, last in ((start, index + 1), (0, start)):
            heads = [place for place in range(first, min(last, len(own))) if self._is_head(own, place)]
            if heads:
                return self._meant(number, own, heads[-1])
            loose = [place for place in range(first, min(last, len(own))) if own[place].kind == "who"]
            if first or last == index + 1:
                loose = loose or [place for place in range(index, end) if self._is_of_whom(own, place)][:1]
            if loose:
                return people(own[loose[-1]]), None
        heads = [place for place in range(index, len(own)) if self._is_head(own, place)]
        if heads:  # "after waiting for 3 s it drives on"
            return self._meant(number, own, heads[0])
        return self._before(number), None

    def _meant(self, number: int, own: Sequence[Chunk], place: int) -> tuple[set[int], int | None]:
        """Return whom a name or "it" may mean."""
        if own[place].kind == "who":
            return people(own[place]), None
        return self._union([each for each in own[:place] if each.kind == "who"]) | self._before(number), own[place].start

    def _is_head(self, own: Sequence[Chunk], place: int) -> bool:
        """Whether a name or "it" is whom a clause speaks of: it stands at its beginning."""
        if own[place].kind != "who" and (own[place].kind, own[place].value) != ("pronoun", "it"):
            return False
        before = place - 1
        while before >= 0 and own[before].kind in _COLOURS:
            before -= 1
        if before < 0 or own[before].kind in _CUTS:
            return True
        follows = own[place + 1].kind if place + 1 < len(own) else ""
        if own[before].kind == "side":
            return own[before].value in ("before", "after", "with") and follows in (*_PREDICATES, "amount")
        return follows in _PREDICATES

    def _is_of_whom(self, own: Sequence[Chunk], place: int) -> bool:
        """Whether a name stands behind what is said of it: ``3 s for the ego``."""
        if own[place].kind != "who" or place == 0 or own[place - 1].kind != "side":
            return False
        return own[place - 1].value not in _NOT_OF_WHOM and (place < 2 or own[place - 2].kind != "place")

    def _union(self, chunks: Sequence[Chunk]) -> set[int]:
        return set[int]().union(*(people(each) for each in chunks))

    def _before(self, sentence: int) -> set[int]:
        """Return everybody of the nearest sentence before that names anybody."""
        for own in reversed(self.said[:sentence]):
            if any(each.kind == "who" for each in own):
                return self._union([each for each in own if each.kind == "who"])
        return set()

    def places(self, at: int) -> set[str]:
        """Return the places that an amount may be counted to: those of its own clause, else the nearest after it."""
        _, own = self.sentence(at)
        index = next((place for place, each in enumerate(own) if each.end > at), len(own))
        heads = [place for place in range(len(own)) if self._is_head(own, place)]
        start = max((place for place in heads if place < index), default=0)
        end = min((place for place in heads if place > index), default=len(own))
        after = self._nearest(own[index + 1 : end])
        before = self._nearest(own[start:index][::-1])
        return after | before or self._nearest(own[index + 1 :], True) or self._nearest(own[:index][::-1], True)

    def _nearest(self, chunks: Sequence[Chunk], over: bool = False) -> set[str]:
        """Return the first place in `chunks`; `over` other amounts too."""
        for each in chunks:
            if each.kind == "place":
                return {each.value}
            counted = each.amount is not None and each.amount.dimension in ("length", "time")
            if counted and not over:
                break
        return set()


def people(chunk: Chunk) -> set[int]:
    """Return whom a name stands for."""
    return {int(number) for number in chunk.value.split()}
