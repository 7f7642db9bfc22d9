"""Nothing is believed that its own words do not say: holds what a reply claims against the stretches that it quotes.

What enters: a `Claim` and the text. What leaves: a `TranslationError` with every fault, for the model. Who, ways,
deeds, orders and what holds are checked here, amounts and measures in `measured`; and whether all of the text was used.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from scenewright.errors import Span, TranslationError
from scenewright.language import story as st
from scenewright.language.compile import COMPASS, amounts_of
from scenewright.language.model.amounts import spoken_of
from scenewright.language.model.heard import Heard, people
from scenewright.language.model.measured import STANDS, Measured
from scenewright.language.model.schema import Claim, locate
from scenewright.language.phrases import COMPASS_WORDS, DOES
from scenewright.language.read.chunks import Chunk
from scenewright.program.types import EGO

_SHOWN = 8
_DOES = {"stop": st.Verb.BRAKE, "stands": st.Verb.STAND, "drives": st.Verb.DRIVE}
_HOW = {
    "never": re.compile(r"(?i)\b(?:never|not|no|without|nor|avoid\w*)\b|n't"),
    "always": re.compile(
        r"(?i)\b(?:always|all|throughout|whole|entire|while|during|keep\w*|hold\w*|stay\w*|until|constant)\b"
    ),
    "at some time": re.compile(r"(?i)\b(?:some|once|eventually|ever)\b"),
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
        spans = [span for words in self.claim.called[actor.id] for span in locate(words, self.text)]
        plain = [each for span in spans for own in Heard(span.excerpt(self.text), {}).said for each in own]
        known = {each.value for each in plain if each.kind == "actor"}
        if (actor.id != EGO and "ego" in known) or (actor.id == EGO and "hero" in known):
            yield f"'{actor.quote.text}' is {'not ' if actor.id == EGO else ''}under test, not {actor.name}"
        elif actor.kind not in known and known - {"ego", "hero", "car"}:
            yield f"{actor.name} is no {actor.kind}: the text calls it {', '.join(sorted(known))}"
        elif actor.kind != "car" and actor.kind not in known:
            yield from self.silent(actor.quote, f"does not say that {actor.name} is a {actor.kind}", actor.kind)
        if actor.way != st.Way():
            yield from self._way(actor, actor.way, self.claim.ways.get(actor.id))
        for relation in actor.relations:
            yield from self._relation(actor.id, relation)

    def _way(self, actor: st.Actor, way: st.Way, quote: st.Quote | None) -> Iterator[str]:
        if quote is None:
            yield f"no words are quoted for the way of {actor.name}"
            return
        said = self.heard.within(quote.span)
        own = [each for each in said if actor.id in self.heard.subjects(each.start)[0]]
        heads = [self._heading(each) for each in own if each.kind == "heading"]
        turns = [each.value for each in own if each.kind == "turn"]
        behind = {two.start: one.value for one, two in pairwise(said)}
        areas = [(each.value, behind.get(each.start)) for each in own if each.kind == "area"]
        if way.headings and list(way.headings) != heads:
            yield f"'{quote.text}' does not say {', then '.join(way.headings)} of {actor.name}"
        for slot, told in (
            ("heading", heads[:1]),
            ("destination_heading", heads[1:] or heads),
            ("turn", turns),
            ("origin", [area for area, side in areas if side != "into"]),
            ("destination", [area for area, side in areas if side not in ("from", "of")]),
        ):
            value = getattr(way, slot)
            word = COMPASS_WORDS.get(value, value)
            if value is None or value in told:
                continue
            fault = f"does not say {slot} '{word}' of {actor.name}"
            if told or any(each.kind == slot.removeprefix("destination_") for each in said):
                yield f"'{quote.text}' {fault}"
            elif slot != "turn" or not re.search(rf"(?i)\b{word}", quote.text):
                yield from self.silent(quote, fault, word)

    def _heading(self, chunk: Chunk) -> str:
        """Return where somebody heads; who comes from the east heads west."""
        if re.search(r"(?i)\bfrom (?:the )?$", self.text[: chunk.start]):
            return COMPASS[(COMPASS.index(chunk.value) + 2) % 4]
        return chunk.value

    def _relation(self, actor: int, relation: st.Relation) -> Iterator[str]:
        quote = relation.quote
        if quote is None:
            yield f"no words are quoted for '{relation.kind}' of {self.name(actor)}"
            return
        said = self.heard.within(quote.span)
        own = [each.start for each in said if each.kind in ("relation", "side") and each.value == relation.kind]
        other = [each.text for each in said if each.kind == "relation" and each.value != relation.kind]
        if own:
            yield from self.subject(actor, quote, own, f"'{relation.kind}'", relation.of)
        elif other:
            yield f"'{quote.text}' says {' and '.join(other)}, not {relation.kind}"
        else:
            yield from self.silent(quote, f"does not say that {self.name(actor)} is {relation.kind}", relation.kind)

    # -- moments, deeds, orders, holds --------------------------------------------------------------------------------
    def _time(self, number: int, moment: st.Moment) -> Iterator[str]:
        """Check that a moment's time is told with its conditions or deeds: "when" one begins, "until" it ends."""
        yield from self.amount(moment.time)
        quote = moment.time.quote if moment.time else None
        if quote is None:
            return
        story, (sentence, own, index) = self.claim.story, self.heard.sentence(quote.start)
        link = next((each.value for each in reversed(own[:index]) if each.kind == "link"), "")
        bounds = [(each.quote, (each.begins if link != "until" else -1, each.ends if link != "when" else -1))
                  for each in story.deeds]  # fmt: skip
        told = [each for each, at in bounds if number in at]
        told += [each.quote for condition in moment.conditions for each in st.atoms(condition)]
        told += [each.quote for each in story.orders if number in (each.first, each.second)]
        near = {self.heard.sentence(each.start)[0] for each in told if each}
        if near and sentence not in near:
            yield f"'{quote.text}' is not told with what is so then: say it as an order from start"

    def _deed(self, deed: st.Deed) -> Iterator[str]:
        for measure in deed.throughout:
            yield from self.measure(measure)
            if measure.actor != deed.actor:
                yield f"`throughout` of a deed of {self.name(deed.actor)} is of {self.name(measure.actor)}: use `holds`"
        quote, others = deed.quote, [each for each in self.claim.story.deeds_of(deed.actor) if each != deed]
        if quote is None:
            yield f"no words are quoted for '{deed.verb}' of {self.name(deed.actor)}"
            return
        said = self.heard.within(quote.span)
        own = [each.start for each in said if _verb(each) == deed.verb]
        stopped = any(each.ends == deed.begins and each.verb == st.Verb.BRAKE for each in others)
        if deed.verb != st.Verb.DRIVE and any((each.verb, each.quote) == (deed.verb, quote) for each in others):
            yield f"'{quote.text}' is one deed, not two"
        if own:
            yield from self.subject(deed.actor, quote, own, f"'{deed.verb}'")
        elif deed.verb == st.Verb.DRIVE:  # what somebody does until its first deed, and after its last
            names = [each.start for each in said if each.kind == "who"]
            yield from self.subject(deed.actor, quote, [quote.start, *names], "a deed")
        elif deed.verb in set(st.Verb) and not (deed.verb == st.Verb.STAND and stopped and STANDS.search(quote.text)):
            verbs = [each.text for each in said if _verb(each)]  # a verb of no program is refused by its name
            if verbs:
                yield f"'{quote.text}' says {' and '.join(verbs)}, not '{deed.verb}'"
            else:
                yield from self.silent(quote, f"does not say '{deed.verb}'", deed.verb, *DOES[deed.verb])

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
        fits = turned = 0
        for mark in ("#", ""):  # who it is tells more than the other words
            if fits == turned:
                fits = sum(word.startswith(mark) for word in (early & first) | (late & second))
                turned = sum(word.startswith(mark) for word in (early & second) | (late & first))
        if turned > fits:
            yield f"'{quote.text}' says it in the other order"
        elif not fits:
            yield from self.silent(quote, "does not say which moment is first", "before", "after", "first")

    def _words_of(self, moment: int) -> set[str]:
        """Return who and what a moment is about, as words that may be used to speak of it."""
        story = self.claim.story
        deeds = [each for each in story.deeds if moment in (each.begins, each.ends)]
        conditions = [each for condition in story.moments[moment].conditions for each in st.atoms(condition)]
        who = {deed.actor for deed in deeds} | {each for condition in conditions for each in st.people_in(condition)}
        told = [each.quote.text for each in conditions if each.quote]
        told += [
            " ".join(DOES.get(deed.verb, (deed.verb,))) for deed in deeds if deed.begins == moment or not conditions
        ]
        return {f"#{each}" for each in who} | set(re.findall(r"\w+", " ".join(told).lower()))

    def _told_first(self, quote: st.Quote) -> tuple[set[str], set[str]]:
        """Return who and what is first and second by the words for an order; empty sets where there are none."""
        said = self.heard.within(quote.span)
        for place, each in enumerate(said):
            if each.kind == "order":  # "goes first", "lets it go first"
                who = [other for other in said[:place] if other.kind in ("who", "pronoun")][-1:]
                first = {word for word in self._spoken(who) if word[0] == "#"}
                return first, {f"#{actor.id}" for actor in self.claim.story.actors if first} - first
            follows = said[place + 1].kind if place + 1 < len(said) else ""
            if each.value in _FIRST and follows in ("who", "pronoun"):
                ends = (
                    number
                    for number, other in enumerate(said)
                    if number > place + 1 and other.kind in ("comma", "pronoun")
                )
                end = next(ends, len(said)) if place < 2 else len(said)
                inner, outer = self._spoken(said[place + 1 : end]), self._spoken([*said[:place], *said[end:]])
                if not any(word[0] == "#" for word in outer):
                    outer |= {f"#{who}" for who in self.heard.subjects(quote.start)[0]}
                return (outer, inner) if _FIRST[each.value] else (inner, outer)
        return set(), set()

    def _spoken(self, chunks: Sequence[Chunk]) -> set[str]:
        found = {f"#{who}" for who in people(*chunks)}
        found |= {f"#{self.by_pronoun[each.start]}" for each in chunks if each.start in self.by_pronoun}
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
        elif not _HOW[hold.how].search(quote.text):
            yield from self.silent(quote, f"does not say '{hold.how}'", hold.how)
        elif hold.how != "never" and re.search(r"(?i)\bnever\b", quote.text):
            yield f"'{quote.text}' says never"

    # -- all of the text ----------------------------------------------------------------------------------------------
    def _used_up(self) -> Iterator[str]:
        story = self.claim.story
        amounts = [each.quote for each in amounts_of(story) if each.quote]
        owned = " ".join(said for _, said in self.claim.owned)
        asides = [quote.span for quote in story.asides]
        told = asides + [span for span, _ in self.claim.owned if span]
        names = [*(word for own in self.claim.called.values() for word in own),
                 *(lane for actor in story.actors for lane in actor.way.lanes),
                 *(parameter.name for parameter in story.parameters)]  # fmt: skip
        named = [span for name in names for span in locate(name, self.text)]
        measures = [
            each.quote for moment in story.moments for condition in moment.conditions for each in st.atoms(condition)
        ]
        measures += [each.quote for deed in story.deeds for each in deed.throughout]
        events: list[st.Order | st.Hold] = [*story.orders, *story.holds]
        ordered = [each.quote.span for each in events if each.quote]
        longer = [*ordered, *(deed.quote.span for deed in story.deeds if deed.quote)]
        for span in spoken_of(self.text):
            word = span.excerpt(self.text)
            again = _covered(span, longer) and any(self.text.startswith(quote.text, span.start) for quote in amounts)
            used = _covered(span, [*told, *named, *(quote.span for quote in amounts)]) or again
            own = self.heard.sentence(span.start)[1]
            declares = any(each.name in self.text[own[0].start : own[-1].end] for each in story.parameters)
            if not (used or declares or re.search(rf"(?<![\w.]){re.escape(word)}(?![\w]|\.\d)", owned)):
                yield f"'{self.text[span.start : span.end + 12].strip()}' of the text is in no amount and no aside"
        spans = [*self.claim.read, *told, *named, *longer, *(quote.span for quote in measures if quote)]
        for own in self.heard.said:
            whole = Span(own[0].start, own[-1].end)
            if len(own) > 1 and not any(each.start < whole.end and whole.start < each.end for each in spans):
                yield f"no reading and no slot tells of '{whole.excerpt(self.text)}'"
            for place, each in enumerate(own):
                quoted = [deed.quote.span for deed in story.deeds if deed.quote and deed.verb == _verb(each)]
                used = each.kind != "deed" or _covered(Span(each.start, each.end), [*quoted, *asides])
                # "It begins to brake 2 s after ...": an order speaks of a deed that is told elsewhere.
                event = own[max(place - 1, 0)].kind == "phase" and _covered(Span(each.start, each.end), ordered)
                if not (used or event or self._is_background(own, place)):
                    where = whole.excerpt(self.text)
                    yield f"'{each.text}' in '{where}' is in the words of no such deed and no aside"

    def _is_background(self, own: list[Chunk], place: int) -> bool:
        """Whether a deed is told as a moment or a wish, or of the ego."""
        for each in reversed(own[:place]):
            if each.kind in ("mood", "negation") or (each.kind == "link" and each.value != "then"):
                return True
            if (each.kind, each.value) in (("phase", "finishes"), ("side", "before"), ("side", "after")):
                return True
            if each.kind == "comma":
                break
        return EGO in self.heard.subjects(own[place].start)[0]


def _verb(chunk: Chunk) -> str | None:
    """Return the deed that a chunk speaks of."""
    if chunk.kind in ("deed", "state"):
        return _DOES.get(chunk.value, chunk.value)
    return st.Verb.DRIVE if chunk.kind in ("event", "order") else None


def _covered(span: Span, by: Sequence[Span]) -> bool:
    return any(each.start <= span.start and span.end <= each.end for each in by)
