"""Nothing is believed that its own words do not say: holds what a reply claims against the stretches that it quotes.

What enters: a `Claim` and the text. What leaves: a `TranslationError` with every fault, for the model. Who, ways,
deeds, orders and what holds are checked here, amounts and measures in `heard`; and whether all of the text was used.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence, Set
from itertools import chain, takewhile
from typing import Any

from scenewright.errors import Span, TranslationError
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.compile import COMPASS
from scenewright.translate.model.heard import STANDS, Heard, Measured, lies_in, meaning, meets, people, words_in
from scenewright.translate.model.schema import Claim, locate
from scenewright.translate.phrases import COMPASS_WORDS, DOES
from scenewright.translate.read.chunks import Chunk

_SHOWN = 8  # faults that go back at once: more are not mended at once either
# Whether what stands before such a word is earlier than what follows it.
_FIRST = {"before": True, "no later than": True, "ahead": True, "after": False, "when": False, "until": False}

Said = Set[int | str]  # who is spoken of, by number, and words


def check_evidence(claim: Claim, text: str) -> None:
    """Raise TranslationError, with every fault in it, where the words do not say what a reply claims of them."""
    faults = list(dict.fromkeys(_Evidence(claim, text, Heard(text, claim.called)).faults()))
    if faults:
        raise TranslationError(
            "the story and the words that it quotes do not match",
            found="; ".join(faults[:_SHOWN]) + ("; ..." if len(faults) > _SHOWN else ""),
            expected="slots that their own words say; what they do not say stands in assumptions, with these words",
        )


class _Evidence(Measured):
    def faults(self) -> Iterator[str]:
        """Yield what the words say against the story, and what of them it leaves out."""
        story = self.claim.story
        for actor in story.actors:
            yield from self._actor(actor)
            yield from self._way(actor, self.claim.ways.get(actor.id))
        for number, moment in enumerate(story.moments):
            yield from self._time(number, moment)
        checks: dict[Any, tuple[str, Callable[[Any, st.Quote], Iterator[str]]]] = {
            st.Amount: ("unit", self.amount), st.Measure: ("quantity", self.measure), st.Deed: ("verb", self._deed),
            st.Order: ("op", self._order), st.Hold: ("how", self._hold),
        }  # fmt: skip
        for kind, (slot, check) in checks.items():
            for part in st.within(story, kind):
                none = f"no words are quoted for the {kind.__name__} '{getattr(part, slot)}'"
                yield from check(part, part.quote) if part.quote else [none]
        yield from self._used_up()

    # -- who ----------------------------------------------------------------------------------------------------------
    def _actor(self, actor: st.Actor) -> Iterator[str]:
        if actor.quote is None and not (actor.id == EGO and EGO in people(*chain(*self.heard.said))):  # "we"
            yield f"nothing in `called` says how the text names {actor.name}"
        plain = [each for name in self.claim.called[actor.id] for own in Heard(name, {}).said for each in own]
        known = {"ego" if each.kind == "who" else each.value for each in plain if each.kind in ("who", "actor")}
        kinds = known - {"ego", "hero", "car"}
        if ("hero" if actor.id == EGO else "ego") in known:
            yield f"{actor.name} is {'not ' if actor.id == EGO else ''}under test: {self.claim.called[actor.id]}"
        elif kinds and actor.kind not in known:
            yield f"{actor.name} is no {actor.kind}: the text calls it {', '.join(sorted(kinds))}"
        for each in actor.relations:
            if each.quote is None:
                yield f"no words are quoted for '{each.kind}' of {actor.name}"
                continue
            said = self.heard.within(each.quote.span)
            turned = {"ahead": "behind", "behind": "ahead"}.get(each.kind)
            if any((one.kind, one.value) == ("side", turned) for one in said):  # who follows has the other ahead
                yield from self.says(each.quote, said, turned or "", each.of, other=actor.id)
                continue
            own = [one for one in said if one.kind == "relation" or (one.kind, one.value) == ("side", each.kind)]
            own = [one for one in own if one.value == each.kind or one.value != "same way"]
            yield from self.says(each.quote, own, each.kind, actor.id, other=each.of)

    def _way(self, actor: st.Actor, quote: st.Quote | None) -> Iterator[str]:
        way = actor.way
        if quote is None:
            if way != st.Way():
                yield f"no words are quoted for the way of {actor.name}"
            return
        said = self.heard.within(quote.span)
        headings = [each for each in said if each.kind == "heading"]
        own = [self._heading(each) for each in headings]
        for told, known in ((way.headings, own), ((way.heading,), own[:1]), ((way.destination_heading,), own[-1:])):
            if any(told) and list(told) != known:
                word = ", then ".join(COMPASS_WORDS[each or ""] for each in told)
                fault = f"does not say that {actor.name} heads {word}"
                yield from [f"'{quote.text}' {fault}"] if headings else self.silent(quote, fault, word)
        turns = [each for each in said if each.kind == "turn"]
        if way.turn and (turns or way.turn not in quote.text.lower()):  # "left into the driveway"
            yield from self.says(quote, turns, way.turn, actor.id)
        for value in filter(None, (way.origin, way.destination)):
            yield from self.says(quote, [each for each in said if each.kind == "area"], value, actor.id)

    def _heading(self, chunk: Chunk) -> str:
        """Return where somebody heads; who comes from the east heads west."""
        if re.search(r"(?i)\bfrom (?:the )?$", self.text[: chunk.start]):
            return COMPASS[(COMPASS.index(chunk.value) + 2) % 4]
        return chunk.value

    # -- moments, deeds, orders, holds --------------------------------------------------------------------------------
    def _told_at(self, number: int, link: str = "") -> Iterator[tuple[set[int], st.Quote | None]]:
        """Yield who does or is something at a moment, with the words for it; "when" a deed begins, "until" it ends."""
        moment = self.claim.story.moments[number]
        for each in st.within(moment.conditions, st.Measure):
            yield st.people_in(each), each.quote
        for deed in self.claim.story.deeds:
            if number == deed.begins or (number == deed.ends and link == "until"):
                yield {deed.actor}, deed.quote if link != "until" or number == deed.ends else None
            elif number == deed.ends:
                yield {deed.actor}, deed.quote if not moment.conditions and link != "when" else None

    def _time(self, number: int, moment: st.Moment) -> Iterator[str]:
        """Check that a moment's time is told with what is so then."""
        quote = moment.time.quote if moment.time else None
        if quote is not None:
            sentence, own, index = self.heard.sentence(quote.start)
            link = next((each.value for each in reversed(own[:index]) if each.kind == "link"), "")
            near = {self.heard.sentence(words.start)[0] for _, words in self._told_at(number, link) if words}
            if near and sentence not in near:
                yield f"'{quote.text}' is not told with what is so then: say it as an order from start"

    def _deed(self, deed: st.Deed, quote: st.Quote) -> Iterator[str]:
        said, others = self.heard.within(quote.span), self.claim.story.deeds_of(deed.actor)
        verbs = [each for each in said if each.kind in ("deed", "state", "event", "order")]
        stopped = any(each.ends == deed.begins and each.verb == st.Verb.BRAKE for each in others)
        if deed.verb == st.Verb.DRIVE and all(meaning(each) != deed.verb for each in verbs):
            # What somebody does until its first deed, and after its last, is said with who it is.
            names = [each.start for each in said if each.kind == "who"]
            yield from self.subject(deed.actor, quote, [quote.start, *names])
        elif deed.verb in set(st.Verb) and not (deed.verb == st.Verb.STAND and stopped and STANDS.search(quote.text)):
            yield from self.says(quote, verbs, deed.verb, deed.actor, *DOES[deed.verb])

    def _order(self, order: st.Order, quote: st.Quote) -> Iterator[str]:
        story = self.claim.story
        if order.margin is not None:
            yield from self.bound(order.op, quote, order.margin)
        for knots in (story.knots_of(actor.id) for actor in story.actors):
            if order.first in knots and order.second in knots:
                if knots.index(order.first) >= knots.index(order.second):
                    yield f"somebody comes through the second moment of '{quote.text}' before the first"
                return
        if order.first == st.START:
            return
        first, second = self._words_of(order.first), self._words_of(order.second)
        early, late = self._told_first(quote)
        first, second, early, late = first - second, second - first, early - late, late - early
        fits, turned = _weight((early & first) | (late & second)), _weight((early & second) | (late & first))
        if turned > fits:
            yield f"'{quote.text}' says it in the other order"
        elif not fits:
            yield from self.silent(quote, "does not say which moment is first", "before", "after", "first")

    def _words_of(self, moment: int) -> Said:
        """Return who and what a moment is about, as words that may be used to speak of it."""
        told = list(self._told_at(moment))
        return words_in(*(quote.text for _, quote in told if quote)).union(*(who for who, _ in told))

    def _told_first(self, quote: st.Quote) -> tuple[Said, Said]:
        """Return who and what is first and second by the words for an order; empty sets where there are none."""
        said = self.heard.within(quote.span)
        for place, each in enumerate(said):
            follows = said[place + 1].kind if place + 1 < len(said) else ""
            if each.kind == "order":  # "goes first", "lets it go first"
                first = self._people([other for other in said[:place] if other.kind in ("who", "pronoun")][-1:])
                return first, {actor.id for actor in self.claim.story.actors if first} - first
            if each.value in _FIRST and follows in ("who", "pronoun"):
                ends = {"comma", "pronoun", "does"}  # "only after the ego has passed does the hero ..."
                cuts = [at for at in range(place + 2, len(said)) if {said[at].kind, said[at].text} & ends]
                end = cuts[0] if cuts and place < 2 else len(said)  # "Once the ego is through, ..."
                inner, outer = said[place + 1 : end], [*said[:place], *said[end:]]
                after = self._people(inner) | words_in(*(other.text for other in inner))
                others = self._people(outer) or self.heard.subjects(quote.start)
                before = others | words_in(*(other.text for other in outer))
                denied = place > 0 and said[place - 1].kind == "negation"  # "not before"
                return (before, after) if _FIRST[each.value] is not denied else (after, before)
        return set(), set()

    def _people(self, chunks: Sequence[Chunk]) -> set[int]:
        its = (self.heard.subjects(each.start) for each in chunks if each.kind == "pronoun")
        return people(*chunks).union(*its)

    def _hold(self, hold: st.Hold, quote: st.Quote) -> Iterator[str]:
        starts = [point.offset.quote.start for point in (hold.start, hold.end) if point.offset and point.offset.quote]
        if starts != sorted(starts):
            yield f"'{quote.text}' does not tell the times of `start` and `end` in this order"

    # -- all of the text ----------------------------------------------------------------------------------------------
    def _used_up(self) -> Iterator[str]:
        story = self.claim.story
        told = [*(quote.span for quote in story.asides), *(span for span, _ in self.claim.owned if span)]
        names = [*chain(*self.claim.called.values()), *chain(*(actor.way.lanes for actor in story.actors))]
        named = [span for name in names for span in locate(name, self.text)]
        amounts, ordered = self._spans(st.Amount), [*self._spans(st.Order), *self._spans(st.Hold)]
        deeds = [(deed.verb, deed.quote.span) for deed in story.deeds if deed.quote]
        declared = [span for each in story.parameters for span in locate(each.name, self.text)]
        declared_in = {self.heard.sentence(span.start)[0] for span in declared}
        for each in (chunk for own in self.heard.said for chunk in own if chunk.kind in ("amount", "no unit")):
            used = lies_in(each.start, each.end, [*told, *named]) or meets(each.start, each.end, amounts)
            again = any(self.text.startswith(span.excerpt(self.text), each.start) for span in amounts)
            if not (used or again or self.heard.sentence(each.start)[0] in declared_in):
                yield f"'{each.text}' of the text is in no amount and no aside"
        spans = [*self.claim.read, *told, *named, *(quote.span for quote in st.within(story, st.Quote))]
        for own in self.heard.said:
            where = self.text[own[0].start : own[-1].end]
            if len(own) > 1 and not meets(own[0].start, own[-1].end, spans):
                yield f"no reading and no slot tells of '{where}'"
            for place, chunk in enumerate(own):
                quotes = [*told, *ordered, *(span for verb, span in deeds if verb == meaning(chunk))]
                used = chunk.kind != "deed" or lies_in(chunk.start, chunk.end, quotes)
                if not (used or self._is_background(own, place)):
                    yield f"'{chunk.text}' in '{where}' is in the words of no such deed and no aside"

    def _spans(self, kind: Any) -> list[Span]:
        """Return the stretches that parts of a kind quote."""
        return [each.quote.span for each in st.within(self.claim.story, kind) if each.quote]

    def _is_background(self, own: list[Chunk], place: int) -> bool:
        """Whether a deed is told as a moment or a wish, or of the ego."""
        before = takewhile(lambda each: each.kind != "comma", reversed(own[:place]))
        told = any(each.kind in ("mood", "negation", "link") and each.value != "then" for each in before)
        return told or EGO in self.heard.subjects(own[place].start)


def _weight(said: Said) -> int:
    """Return how much words tell that two ways of saying have in common: who it is tells more than all others."""
    return sum(100 if isinstance(each, int) else 1 for each in said)
