"""A text as typed chunks with the people of a reply in it: who is spoken of at a place of it, and which place is meant.

What enters: a text and the words by which it names each actor. What leaves: sets of what is possible, empty where the
words do not tell. Words that nobody knows are no fault: they only leave more open.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.errors import Span
from scenewright.language.model.schema import locate
from scenewright.language.read.chunks import Chunk, sentences

_CUTS = ("comma", "joint", "link")  # what parts one thing that is said from another
_COLOURS = ("unknown", "harmless", "relation", "heading", "turn")  # what may stand before a name and belong to it
_PREDICATES = ("be", "state", "event", "phase", "deed", "turn", "mood", "order", "kept")
_WHOLE = ("place", "amount", "area", "standstill")  # what needs nobody after it
_NOT_OF_WHOM = ("before", "behind", "after", "than")


def people(*chunks: Chunk) -> set[int]:
    """Return whom names stand for."""
    return {int(number) for each in chunks if each.kind == "who" for number in each.value.split()}


def _lies_in(chunk: Chunk, span: Span) -> bool:
    return span.start <= chunk.start + len("the ") * (chunk.kind == "place") and chunk.end <= span.end


def is_head(own: Sequence[Chunk], at: int) -> bool:
    """Whether a name or "it" is whom a clause speaks of: it stands at its beginning."""
    if own[at].kind != "who" and (own[at].kind, own[at].value) != ("pronoun", "it"):
        return False
    before = at - 1
    while before >= 0 and own[before].kind in _COLOURS:
        before -= 1
    follows = own[at + 1].kind if at + 1 < len(own) else ""
    if before >= 0 and own[before].kind == "side":
        return own[before].value in ("before", "after", "with") and follows in (*_PREDICATES, "amount")
    return before < 0 or own[before].kind in (*_CUTS, *_WHOLE) or follows in _PREDICATES


@dataclass(slots=True)
class Heard:
    """The chunks of a text by sentence; a name of somebody is of kind ``who``, its value the numbers of whose it is."""

    text: str
    called: Mapping[int, tuple[str, ...]]
    said: list[list[Chunk]] = field(init=False)

    def __post_init__(self) -> None:
        named: dict[tuple[int, int], set[int]] = {}
        for number, own in self.called.items():
            for span in (span for words in own for span in locate(words, self.text)):
                named.setdefault((span.start, span.end), set()).add(number)
        taken: list[Chunk] = []
        for start, end in sorted(named, key=lambda each: each[0] - each[1]):  # the longest first
            if not any(start < other.end and other.start < end for other in taken):
                value = " ".join(map(str, sorted(named[start, end])))
                taken.append(Chunk("who", value, start, end, self.text[start:end]))
        self.said = []
        for plain in sentences(self.text) or [[Chunk("unknown", "", 0, len(self.text), self.text)]]:
            chunks = [each for chunk in plain for each in (*chunk.traits, chunk)]
            own_names = [each for each in taken if each.end >= chunks[0].start and each.start < chunks[-1].end]
            kept = [chunk for chunk in chunks if chunk.kind not in ("actor", "name", "unknown")
                    or not any(each.start < chunk.end and chunk.start < each.end for each in own_names)]  # fmt: skip
            self.said.append(sorted([*kept, *own_names], key=lambda chunk: (chunk.start, -chunk.end)))

    def within(self, span: Span) -> list[Chunk]:
        """Return the chunks that lie in a stretch, whether or not it begins with their article."""
        return [each for own in self.said for each in own if _lies_in(each, span)]

    def sentence(self, at: int) -> tuple[int, list[Chunk], int]:
        """Return the number and the chunks of the sentence at a place of the text, and which chunk is there."""
        number = next((number for number, own in enumerate(self.said) if at < own[-1].end), len(self.said) - 1)
        own = self.said[number]
        return number, own, next((index for index, each in enumerate(own) if each.end > at), len(own) - 1)

    def clause(self, at: int, span: Span) -> list[Chunk]:
        """Return the chunks of a stretch that are of the same clause as a place in it."""
        _, own, index = self.sentence(at)
        parts = [place for place, each in enumerate(own) if each.kind == "link" or is_head(own, place)]
        start = max((place for place in parts if place <= index), default=0)
        end = min((place for place in parts if place > index), default=len(own))
        return [each for each in own[start:end] if _lies_in(each, span)]

    def subjects(self, at: int) -> tuple[set[int], int | None]:
        """Return who may be spoken of at a place, and where the "it" is that stands for it."""
        number, own, index = self.sentence(at)
        beside = next((each for each in own[index + 1 :] if each.kind not in _COLOURS), None)
        if own[index].kind in _COLOURS and beside and beside.kind == "who":
            return people(beside), None  # "a westbound truck"
        start = max((place + 1 for place in range(index) if own[place].kind in _CUTS), default=0)
        end = next((place for place in range(index, len(own)) if own[place].kind in _CUTS), len(own))
        heads = [place for place in range(len(own)) if is_head(own, place)]
        names = [place for place, each in enumerate(own) if each.kind == "who"]
        behind = [place for place in names if index <= place < end and place and own[place - 1].kind == "side"
                  and own[place - 1].value not in _NOT_OF_WHOM
                  and (own[max(place - 2, 0)].kind != "place" or own[place - 1].value == "for")]  # fmt: skip
        beside_it = own[index].amount and index - 1 in names and (index < 2 or own[index - 2].kind != "side")
        for found in (  # from the nearest to the farthest; "3 s for the ego" names it behind
            [index - 1] if beside_it else [],  # "sees the hero 20 m before the stop line"
            [place for place in heads if start <= place <= index][-1:],
            [place for place in names if start <= place <= index][-1:] or behind[:1],
            [place for place in heads if place <= index][-1:],
            [place for place in names if place <= index][-1:],
            [place for place in heads if place > index][:1],
        ):
            if found and own[found[0]].kind == "who":
                return people(own[found[0]]), None
            if found:
                return people(*own[: found[0]]) | self._before(number), own[found[0]].start
        return self._before(number), None

    def _before(self, sentence: int) -> set[int]:
        """Return everybody of the nearest sentence before that names anybody."""
        return next(filter(None, (people(*own) for own in reversed(self.said[:sentence]))), set())

    def places(self, at: int) -> set[str]:
        """Return the places that an amount may be counted to: those of its own clause, else the nearest after it."""
        _, own, index = self.sentence(at)
        heads = [place for place in range(len(own)) if is_head(own, place)]
        start = max((place for place in heads if place < index), default=0)
        end = min((place for place in heads if place > index), default=len(own))
        near = _nearest(own[index + 1 : end]) | _nearest(own[start:index][::-1])
        return near or _nearest(own[index + 1 :], over=True) or _nearest(own[:index][::-1], over=True)


def _nearest(chunks: Iterable[Chunk], over: bool = False) -> set[str]:
    """Return the first place in `chunks`; `over` other amounts too."""
    for each in chunks:
        if each.kind == "place":
            return {each.value}
        if each.amount is not None and each.amount.dimension in ("length", "time") and not over:
            break
    return set()
