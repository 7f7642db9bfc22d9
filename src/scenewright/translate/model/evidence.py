"""Nothing is believed that its own words do not say: holds what a reply claims against the stretches that it quotes.

What enters: a `Claim` and the text. What leaves: a `TranslationError` with every fault, for the model. Who, ways,
deeds, orders and what holds are checked here, amounts and measures in `measured`; and whether all of the text was used.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from scenewright.errors import TranslationError
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.compile import COMPASS, amounts_of
from scenewright.translate.model.heard import Heard, lies_in, people
from scenewright.translate.model.measured import STANDS, Measured, meaning
from scenewright.translate.model.schema import Claim, locate
from scenewright.translate.phrases import COMPASS_WORDS, DOES
from scenewright.translate.read.chunks import Chunk

_SHOWN = 8  # faults that go back at once: more are not mended at once either
_HOW = {
    "never": r"(?i)\b(?:never|not|no|without|nor|avoid\w*)\b|n't",
    "always": r"(?i)\b(?:always|all|throughout|whole|entire|while|during|keep\w*|hold\w*|stay\w*|until|constant)\b",
    "at some time": r"(?i)\b(?:some|once|eventually|ever)\b",
}
# Whether what stands before such a word is earlier than what follows it.
_FIRST = {"before": True, "no later than": True, "ahead": True, "after": False, "when": False, "until": False}


def check_evidence(claim: Claim, text: str) -> None:
    """Raise TranslationError, with every fault in it, where the words do not say what a reply claims of them."""
    faults = list(dict.fromkeys(_Evidence(claim, text).faults()))
    if faults:
        raise TranslationError(
            "the story and the words that it quotes do not match",
            found="; ".join(faults[:_SHOWN]) + ("; ..." if len(faults) > _SHOWN else ""),
            expected="slots that their own words say; what they do not say stands in assumptions, with these words",
        )


class _Evidence(Measured):
    def faults(self) -> Iterator[str]:
        story = self.claim.story
        for actor in story.actors:
            yield from self._actor(actor)
            yield from self._way(actor, self.claim.ways.get(actor.id))
        for number, moment in enumerate(story.moments):
            yield from self._time(number, moment)
            for condition in moment.conditions:
                yield from self.condition(condition)
        for deed in story.deeds:
            yield from self._deed(deed)
        for order in story.orders:
            yield from self._order(order)
        for hold in story.holds:
            yield from self._hold(hold)
        yield from self._used_up()

    # -- who ----------------------------------------------------------------------------------------------------------
    def _actor(self, actor: st.Actor) -> Iterator[str]:
        if actor.quote is None:
            yield f"nothing in `called` says how the text names {actor.name}"
            return
        plain = [each for name in self.claim.called[actor.id] for own in Heard(name, {}).said for each in own]
        known = {each.value for each in plain if each.kind == "actor"}
        kinds = known - {"ego", "hero", "car"}
        if ("hero" if actor.id == EGO else "ego") in known:
            yield f"'{actor.quote.text}' is {'not ' if actor.id == EGO else ''}under test, not {actor.name}"
        elif kinds and actor.kind not in known:
            yield f"{actor.name} is no {actor.kind}: the text calls it {', '.join(sorted(kinds))}"
        elif actor.kind not in (*known, "car"):
            yield from self.silent(actor.quote, f"does not say that {actor.name} is a {actor.kind}", actor.kind)
        for each in actor.relations:
            if each.quote is None:
                yield f"no words are quoted for '{each.kind}' of {actor.name}"
                continue
            said = self.heard.within(each.quote.span)
            own = [
                chunk for chunk in said if chunk.kind == "relation" or (chunk.kind, chunk.value) == ("side", each.kind)
            ]
            yield from self.says(each.quote, own, each.kind, actor.id, other=each.of)

    def _way(self, actor: st.Actor, quote: st.Quote | None) -> Iterator[str]:
        way = actor.way
        if quote is None:
            if way != st.Way():
                yield f"no words are quoted for the way of {actor.name}"
            return
        said = self.heard.within(quote.span)
        headings = [each for each in said if each.kind == "heading"]
        own = [self._heading(each) for each in headings if actor.id in self.heard.subjects(each.start)]
        for told, known in ((way.headings, own), ((way.heading,), own[:1]), ((way.destination_heading,), own[-1:])):
            if any(told) and list(told) != known:
                word = ", then ".join(COMPASS_WORDS[each or ""] for each in told)
                fault = f"does not say that {actor.name} heads {word}"
                yield from [f"'{quote.text}' {fault}"] if headings else self.silent(quote, fault, word)
        turns = [each for each in said if each.kind == "turn"]
        if way.turn and (turns or way.turn not in quote.text.lower()):  # "left into the driveway"
            yield from self.says(quote, turns, way.turn, actor.id)
        areas = [(one.value, two) for one, two in pairwise([Chunk("", "", 0, 0, ""), *said]) if two.kind == "area"]
        for value, sides in ((way.origin, ("into",)), (way.destination, ("from", "of"))):
            if value:
                yield from self.says(quote, [each for side, each in areas if side not in sides], value, actor.id)

    def _heading(self, chunk: Chunk) -> str:
        """Return where somebody heads; who comes from the east heads west."""
        if re.search(r"(?i)\bfrom (?:the )?$", self.text[: chunk.start]):
            return COMPASS[(COMPASS.index(chunk.value) + 2) % 4]
        return chunk.value

    # -- moments, deeds, orders, holds --------------------------------------------------------------------------------
    def _told_at(self, number: int, link: str = "") -> Iterator[tuple[set[int], st.Quote | None]]:
        """Yield who does or is something at a moment, with the words for it; "when" a deed begins, "until" it ends."""
        moment = self.claim.story.moments[number]
        for each in (atom for condition in moment.conditions for atom in st.atoms(condition)):
            yield st.people_in(each), each.quote
        for deed in self.claim.story.deeds:
            if number == deed.begins or (number == deed.ends and link == "until"):
                yield {deed.actor}, deed.quote if link != "until" or number == deed.ends else None
            elif number == deed.ends:
                yield {deed.actor}, deed.quote if not moment.conditions and link != "when" else None

    def _time(self, number: int, moment: st.Moment) -> Iterator[str]:
        """Check that a moment's time is told with what is so then."""
        yield from self.amount(moment.time)
        quote = moment.time.quote if moment.time else None
        if quote is not None:
            sentence, own, index = self.heard.sentence(quote.start)
            link = next((each.value for each in reversed(own[:index]) if each.kind == "link"), "")
            near = {self.heard.sentence(words.start)[0] for _, words in self._told_at(number, link) if words}
            if near and sentence not in near:
                yield f"'{quote.text}' is not told with what is so then: say it as an order from start"

    def _deed(self, deed: st.Deed) -> Iterator[str]:
        for measure in deed.throughout:
            yield from self.measure(measure)
            if measure.actor != deed.actor:
                yield f"`throughout` of a deed of {self.name(deed.actor)} is of {self.name(measure.actor)}: use `holds`"
        quote, others = deed.quote, self.claim.story.deeds_of(deed.actor)
        if quote is None:
            yield f"no words are quoted for '{deed.verb}' of {self.name(deed.actor)}"
            return
        said = self.heard.within(quote.span)
        verbs = [each for each in said if each.kind in ("deed", "state", "event", "order")]
        stopped = any(each.ends == deed.begins and each.verb == st.Verb.BRAKE for each in others)
        if deed.verb == st.Verb.DRIVE and all(meaning(each) != deed.verb for each in verbs):
            # What somebody does until its first deed, and after its last, is said with who it is.
            names = [each.start for each in said if each.kind == "who"]
            yield from self.subject(deed.actor, quote, [quote.start, *names])
        elif deed.verb in set(st.Verb) and not (deed.verb == st.Verb.STAND and stopped and STANDS.search(quote.text)):
            yield from self.says(quote, verbs, deed.verb, deed.actor, *DOES[deed.verb])

    def _order(self, order: st.Order) -> Iterator[str]:
        yield from self.amount(order.margin)
        story, quote = self.claim.story, order.quote
        if quote is None:
            yield "no words are quoted for an order"
            return
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

    def _words_of(self, moment: int) -> set[str]:
        """Return who and what a moment is about, as words that may be used to speak of it."""
        told = list(self._told_at(moment))
        who = {f"#{each}" for people_of, _ in told for each in people_of}
        return who | {word for _, quote in told if quote for word in re.findall(r"\w+", quote.text.lower())}

    def _told_first(self, quote: st.Quote) -> tuple[set[str], set[str]]:
        """Return who and what is first and second by the words for an order; empty sets where there are none."""
        said = self.heard.within(quote.span)
        for place, each in enumerate(said):
            follows = said[place + 1].kind if place + 1 < len(said) else ""
            if each.kind == "order":  # "goes first", "lets it go first"
                who = [other for other in said[:place] if other.kind in ("who", "pronoun")][-1:]
                first = {word for word in self._spoken(who) if word[0] == "#"}
                return first, {f"#{actor.id}" for actor in self.claim.story.actors if first} - first
            if each.value in _FIRST and follows in ("who", "pronoun"):
                ends = [
                    number
                    for number, other in enumerate(said)
                    if number > place + 1 and other.kind in ("comma", "pronoun")
                ]
                end = ends[0] if ends and place < 2 else len(said)  # "Once the ego is through, ..."
                inner, outer = self._spoken(said[place + 1 : end]), self._spoken([*said[:place], *said[end:]])
                if not any(word[0] == "#" for word in outer):
                    outer |= {f"#{who}" for who in self.heard.subjects(quote.start)}
                return (outer, inner) if _FIRST[each.value] else (inner, outer)
        return set(), set()

    def _spoken(self, chunks: Sequence[Chunk]) -> set[str]:
        its = [self.heard.subjects(each.start) for each in chunks if each.kind == "pronoun"]
        found = {f"#{who}" for who in people(*chunks).union(*its)}
        return found | {word for each in chunks for word in re.findall(r"\w+", each.text.lower())}

    def _hold(self, hold: st.Hold) -> Iterator[str]:
        yield from self.condition(hold.condition)
        offsets = [point.offset for point in (hold.start, hold.end) if point.offset]
        for offset in offsets:
            yield from self.amount(offset)
        quote, starts = hold.quote, [each.quote.start for each in offsets if each.quote]
        if quote is None:
            yield f"no words are quoted for what holds {hold.how}"
        elif starts != sorted(starts) or not all(quote.start <= at < quote.end for at in starts):
            yield f"'{quote.text}' does not tell the times of `start` and `end` in this order"
        elif not re.search(_HOW[hold.how], quote.text) or (hold.how != "never" and "never" in quote.text.lower()):
            yield from self.silent(quote, f"does not say '{hold.how}'", hold.how)

    # -- all of the text ----------------------------------------------------------------------------------------------
    def _used_up(self) -> Iterator[str]:
        story = self.claim.story
        amounts = [each.quote for each in amounts_of(story) if each.quote]
        told = [*(quote.span for quote in story.asides), *(span for span, _ in self.claim.owned if span)]
        names = [word for own in self.claim.called.values() for word in own]
        names += [lane for actor in story.actors for lane in actor.way.lanes]
        named = [span for name in names for span in locate(name, self.text)]
        events: list[st.Order | st.Hold] = [*story.orders, *story.holds]
        ordered = [each.quote.span for each in events if each.quote]
        deeds = [(deed.verb, deed.quote.span) for deed in story.deeds if deed.quote]
        longer = [*ordered, *(span for _, span in deeds)]
        declared = [
            self.heard.sentence(span.start)[0] for each in story.parameters for span in locate(each.name, self.text)
        ]
        for each in (chunk for own in self.heard.said for chunk in own if chunk.kind in ("amount", "no unit")):
            again = lies_in(each.start, each.end, longer) and any(
                self.text.startswith(quote.text, each.start) for quote in amounts
            )
            used = again or lies_in(each.start, each.end, [*told, *named])
            used = used or any(quote.start < each.end and each.start < quote.end for quote in amounts)
            owned = any(
                re.search(rf"(?<![\w.]){re.escape(each.text)}(?!\w|\.\d)", said) for _, said in self.claim.owned
            )
            if not (used or owned or self.heard.sentence(each.start)[0] in declared):
                yield f"'{each.text}' of the text is in no amount and no aside"
        quotes = [quote.span for number in range(len(story.moments)) for _, quote in self._told_at(number) if quote]
        spans = [*self.claim.read, *told, *named, *longer, *quotes]
        for own in self.heard.said:
            where = self.text[own[0].start : own[-1].end]
            if len(own) > 1 and not any(each.start < own[-1].end and own[0].start < each.end for each in spans):
                yield f"no reading and no slot tells of '{where}'"
            for place, chunk in enumerate(own):
                quotes = [*told, *(span for verb, span in deeds if verb == meaning(chunk))]
                # "It begins to brake 2 s after ...": an order speaks of a deed that is told elsewhere.
                quotes += ordered if own[max(place - 1, 0)].kind == "phase" else []
                used = chunk.kind != "deed" or lies_in(chunk.start, chunk.end, quotes)
                if not (used or self._is_background(own, place)):
                    yield f"'{chunk.text}' in '{where}' is in the words of no such deed and no aside"

    def _is_background(self, own: list[Chunk], place: int) -> bool:
        """Whether a deed is told as a moment or a wish, or of the ego."""
        for each in reversed(own[:place]):
            if each.kind in ("mood", "negation") or (each.kind == "link" and each.value != "then"):
                return True
            if each.value in ("finishes", "before", "after"):
                return True
            if each.kind == "comma":
                break
        return EGO in self.heard.subjects(own[place].start)


def _weight(words: set[str]) -> int:
    """Return how much words tell that two ways of saying have in common: who it is tells more than all others."""
    return sum(100 if word[0] == "#" else 1 for word in words)
