"""Nothing is believed that its own words do not say: holds what a reply claims against the stretches that it quotes.

What enters: a `Claim` and the text. What leaves: faults, as sentences for the model. The words either contradict a slot,
which is always a fault, or are silent about it; then an assumption or a question that quotes them must own to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from scenewright.errors import Span, TranslationError
from scenewright.language import story as st
from scenewright.language.compile import COMPASS
from scenewright.language.model.amounts import read_amounts, spoken_of
from scenewright.language.model.heard import Heard, people
from scenewright.language.model.schema import Claim, locate
from scenewright.language.phrases import BOUNDS, COMPASS_WORDS, DOES, PLACES
from scenewright.language.read.chunks import Chunk
from scenewright.program.types import EGO
from scenewright.units import UNITS, format_fraction

_SHOWN = 8
_LOWER = re.compile(r"(?i)at least|no less|not less|more|over|above|exceed|beyond|minimum|faster|further|greater")
_UPPER = re.compile(r"(?i)at most|no more|up to|less|under|below|within|maximum|slower|closer|nearer|limit")
_BARE: dict[str, st.Operator] = {"past": ">", "at or past": ">=", "at or before": "<=", "before": "<"}
_DOES = {"stop": st.Verb.BRAKE, "stands": st.Verb.STAND, "drives": st.Verb.DRIVE}
_STANDS = re.compile(r"(?i)\b(?:st[oa]\w*|halt\w*|rests?|stood|wait\w*|parked|zero|0)\b")
_HOW = {
    "never": re.compile(r"(?i)\b(?:never|not|no|without|nor|avoid\w*)\b|n't"),
    "always": re.compile(r"(?i)\b(?:always|all|throughout|whole|entire|while|during|keep\w*|hold\w*|stay\w*|until|constant)\b"),
    "at some time": re.compile(r"(?i)\b(?:some|once|eventually|ever)\b"),
}
_WORD = re.compile(r"\w+")
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


@dataclass(slots=True)
class _Evidence:
    claim: Claim
    text: str
    heard: Heard = field(init=False)
    by_pronoun: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.heard = Heard(self.text, self.claim.called)

    def faults(self) -> Iterator[str]:
        story = self.claim.story
        for actor in story.actors:
            yield from self._actor(actor)
        for moment in story.moments:
            yield from self._amount(moment.time)
            for condition in moment.conditions:
                yield from self._condition(condition)
        for deed in story.deeds:
            yield from self._deed(deed)
        for order in story.orders:
            yield from self._order(order)
        for hold in story.holds:
            yield from self._hold(hold)
        yield from self._used_up()

    def _name(self, actor: int) -> str:
        return self.claim.story.actors[actor].name

    def _names(self, actor: int) -> tuple[str, ...]:
        return (self._name(actor), *self.claim.called[actor])

    def _silent(self, quote: st.Quote, fault: str, *about: str) -> Iterator[str]:
        """Yield a fault of silence, where no assumption and no question on these words owns to it by one of `about`."""
        for span, said in self.claim.owned:
            if span and span.start < quote.end and quote.start < span.end:
                if any(re.search(rf"(?i)(?<![\w.]){re.escape(word)}", said) for word in about):
                    return
        yield f"{fault}; if it is meant so, an assumption that quotes these words says '{about[0]}'"

    # -- who ----------------------------------------------------------------------------------------------------------
    def _actor(self, actor: st.Actor) -> Iterator[str]:
        if actor.quote is None:
            yield f"nothing in `called` says how the text names {actor.name}"
            return
        known = {each.value for words in self.claim.called[actor.id] for span in locate(words, self.text)
                 for each in self._plain(span) if each.kind == "actor"}  # fmt: skip
        if (actor.id != EGO and "ego" in known) or (actor.id == EGO and "hero" in known):
            yield f"'{actor.quote.text}' is {'not ' if actor.id == EGO else ''}under test, not {actor.name}"
        elif actor.kind not in known and known - {"ego", "hero", "car"}:
            yield f"{actor.name} is no {actor.kind}: the text calls it {', '.join(sorted(known))}"
        elif actor.kind != "car" and actor.kind not in known:
            yield from self._silent(actor.quote, f"no word for {actor.name} says that it is a {actor.kind}", actor.kind)
        yield from self._way(actor)
        for relation in actor.relations:
            yield from self._relation(actor.id, relation)

    def _plain(self, span: Span) -> list[Chunk]:
        return [each for own in Heard(span.excerpt(self.text), {}).said for each in own]

    def _way(self, actor: st.Actor) -> Iterator[str]:
        way, quote = actor.way, self.claim.ways.get(actor.id)
        if way == st.Way():
            return
        if quote is None:
            yield f"no words are quoted for the way of {actor.name}"
            return
        said = self.heard.within(quote.span)
        headings = [*filter(None, (way.heading, way.destination_heading)), *way.headings]
        for kind, values in (("heading", headings), ("turn", [way.turn]), ("area", [way.origin, way.destination])):
            for value in filter(None, values):
                own = [each for each in said if each.kind == kind and self._heads(each) == value]
                word = COMPASS_WORDS.get(value, value)
                if not own and (kind == "heading" or not re.search(rf"(?i)\b{word}", quote.text)):
                    others = [each.text for each in said if each.kind == kind]
                    fault = f"'{quote.text}' does not say '{word}' of {actor.name}"
                    if kind == "area" or not others:
                        yield from self._silent(quote, fault, word)
                    else:
                        yield f"{fault}, but {' and '.join(others)}"
                elif own:
                    yield from self._subject(actor.id, quote, [each.start for each in own], f"'{own[0].text}'")
        if way.turn == "straight" and any(each.kind == "turn" and each.value in ("left", "right") for each in said):
            yield f"'{quote.text}' speaks of a turn, and {actor.name} goes straight on"

    def _heads(self, chunk: Chunk) -> str:
        """Return what a chunk says; who comes from the east heads west."""
        if chunk.kind == "heading" and re.search(r"(?i)\bfrom (?:the )?$", self.text[: chunk.start]):
            return COMPASS[(COMPASS.index(chunk.value) + 2) % 4]
        return chunk.value

    def _relation(self, actor: int, relation: st.Relation) -> Iterator[str]:
        quote = relation.quote
        if quote is None:
            yield f"no words are quoted for '{relation.kind}' of {self._name(actor)}"
            return
        found = [each for each in self.heard.within(quote.span) if each.kind in ("relation", "side")]
        own = [each.start for each in found if each.value == relation.kind]
        other = [each.text for each in found if each.kind == "relation" and each.value != relation.kind]
        if own:
            yield from self._subject(actor, quote, own, f"'{relation.kind}'", relation.of)
        elif other:
            yield f"'{quote.text}' says {' and '.join(other)}, not {relation.kind}"
        else:
            yield from self._silent(quote, f"'{quote.text}' does not say that {self._name(actor)} is {relation.kind}", relation.kind)

    def _subject(
        self, actor: int, quote: st.Quote, places: Sequence[int], what: str, other: int | None = None
    ) -> Iterator[str]:
        """Yield a fault where nobody of those who may be spoken of at `places` is `actor` (or `other`, if two are)."""
        known: set[int] = set()
        for at in places:
            found, pronoun = self.heard.subjects(at)
            known |= found
            if pronoun is not None and other is None and len(places) == 1:
                if self.by_pronoun.setdefault(pronoun, actor) != actor:
                    names = f"{self._name(actor)} and {self._name(self.by_pronoun[pronoun])}"
                    yield f"'it' in '{quote.text}' cannot be both {names}"
        if other is not None:
            known |= {who for each in self.heard.within(quote.span) if each.kind == "who" for who in people(each)}
        if not known:
            yield from self._silent(quote, f"nobody of `called` is named for '{quote.text}'", *self._names(actor))
        elif other is not None and known == {other}:
            yield from self._silent(quote, f"'{quote.text}' does not name {self._name(actor)}", *self._names(actor))
        elif actor not in known:
            told = " or ".join(self._name(each) for each in sorted(known))
            yield f"{what} in '{quote.text}' is said of {told}, not of {self._name(actor)}"

    # -- amounts and measures -----------------------------------------------------------------------------------------
    def _amount(self, amount: st.Amount | None) -> Iterator[str]:
        if amount is None:
            return
        told = amount.name or f"{amount.value} {amount.unit}"
        if amount.quote is None:
            yield f"no words are quoted for {told}"
            return
        read = read_amounts(amount.quote.text)
        if amount.name is not None:
            if amount.name not in {value for value, _ in read}:
                yield f"'{amount.quote.text}' is not {told}"
            return
        assert amount.value is not None
        numbers = [(value, unit) for value, unit in read if not isinstance(value, str)]
        if any(abs(value) == abs(amount.value) and unit == amount.unit for value, unit in numbers):
            return
        sizes = [abs(value * UNITS[unit].si_factor) for value, unit in numbers if unit]
        if (amount.si is not None and abs(amount.si) in sizes and amount.dimension == UNITS[numbers[0][1] or "m"].dimension):
            return
        if amount.value == 0 and amount.dimension == "speed" and _STANDS.search(amount.quote.text):
            return
        if read and not any(abs(value) == abs(amount.value) and unit is None for value, unit in numbers):
            yield f"'{amount.quote.text}' is not {told}"
        else:
            yield from self._silent(amount.quote, f"'{amount.quote.text}' does not say {told}", format_fraction(amount.value), "standstill", "stop", "stand")

    def _condition(self, condition: st.Condition) -> Iterator[str]:
        for each in st.atoms(condition):
            yield from self._measure(each)

    def _measure(self, measure: st.Measure) -> Iterator[str]:
        quote, amount, name = measure.quote, measure.amount, self._name(measure.actor)
        yield from self._amount(amount)
        if quote is None:
            yield f"no words are quoted for the {measure.quantity} of {name}"
            return
        at = amount.quote.start if amount is not None and amount.quote is not None else None
        said = self.heard.clause(quote.start if at is None else at, quote.span)
        if measure.place is not None:
            yield from self._place(measure, measure.place, quote, at)
        elif at is not None or measure.other is not None:
            start = quote.start if at is None else at
            yield from self._subject(measure.actor, quote, [start], f"the {measure.quantity}", measure.other)
        if measure.other is not None:
            yield from self._other(measure, measure.other, quote, said)
        for kind, word in ((st.Quantity.COLLISION, "time to collision"), (st.Quantity.ARRIVAL, "time to arrival")):
            speaks = any((each.kind, each.value) == ("quantity", word) for each in said)
            if speaks and measure.quantity is not kind and amount is not None and amount.dimension == "time":
                yield from self._silent(quote, f"'{quote.text}' speaks of a {word}, not of a {measure.quantity}", measure.quantity)
        if measure.quantity is st.Quantity.COLLISION and not any(each.value == "time to collision" for each in said):
            yield from self._silent(quote, f"'{quote.text}' speaks of no time to collision", "time to collision")
        if measure.quantity is st.Quantity.RATE and amount is not None:
            kinds = [each.value for each in said if each.kind in ("quantity", "deed")]
            slows = {each for each in kinds if each in ("deceleration", "acceleration")} or set(kinds)
            slows &= {"brake", "stop", "deceleration", "speed up", "acceleration"}
            if slows and measure.opposite is not bool(slows & {"brake", "stop", "deceleration"}) and (amount.value or 1) > 0:
                yield f"'{quote.text}' speaks of {' and '.join(sorted(slows))}; `opposite` is true for slowing alone"
        if amount is not None:
            yield from self._bound(measure.op, quote, amount)

    def _place(self, measure: st.Measure, place: st.Place, quote: st.Quote, at: int | None) -> Iterator[str]:
        said = self.heard.within(quote.span)
        own = [each for each in said if each.kind == "place"]
        turns = [each for each in said if each.kind == "event" and each.value == place.name]
        marks = [each.start for each in own if each.value == place.name] + [each.start for each in turns]
        if marks:  # "before the ego passes it"
            marks += [two.start for one, two in zip(said, said[1:], strict=False)
                      if one.kind == "event" and two.kind == "pronoun" and two.start > marks[0]]  # fmt: skip
        told, name = PLACES[place.name], self._name(measure.actor)
        if not marks:
            if own and place.name in ("stop_line", "conflict_point", "intersection", "turn", *(each.value for each in own)):
                yield f"'{quote.text}' speaks of {' and '.join(each.text for each in own)}, not of the {told}"
            else:
                yield from self._silent(quote, f"'{quote.text}' does not name the {told}: quote on to where it is named", told)
                if at is None:
                    yield from self._silent(quote, f"'{quote.text}' does not say it of {name}", *self._names(measure.actor))
        elif at is not None and self.heard.places(at) and place.name not in self.heard.places(at) and not turns:
            known = " or ".join(PLACES[each] for each in sorted(self.heard.places(at)))
            yield f"the amount in '{quote.text}' is counted to the {known}, not to the {told}"
        if at is not None or marks:
            yield from self._subject(measure.actor, quote, marks if at is None else [at], f"the {measure.quantity}")
        said = self.heard.clause(at if at is not None else marks[0] if marks else quote.start, quote.span)
        named = self._behind(said, place.name, "of")
        for slot, whom, words in (("of", place.of, named), ("partner", place.partner, self._behind(said, place.name, "with"))):
            if words and (whom if whom is not None else measure.actor if slot == "of" else None) not in words | {None}:
                yield f"'{quote.text}' names {self._name(min(words))} for the {told} (`{slot}`)"
            elif whom is not None and not words and whom not in {who for each in said if each.kind == "who" for who in people(each)}:
                yield f"'{quote.text}' does not name {self._name(whom)} (`{slot}` of the {told})"
        if at is None:
            yield from self._bare(measure, quote, said)
        else:
            pairs = zip(self.heard.within(quote.span), self.heard.within(quote.span)[1:], strict=False)
            side = next((one.value for one, two in pairs if one.start > at and two.kind == "place" == two.kind), "")
            if measure.opposite is not (side in ("past", "after")):
                yield f"'{quote.text}' says '{side or 'nothing'}' of the {told}: `opposite` is true for past it alone"

    def _behind(self, said: list[Chunk], place: str, side: str) -> set[int]:
        """Return who is named behind a place: ``the stop line of the hero``."""
        for one, link, who in zip(said, said[1:], said[2:], strict=False):
            if (one.kind, one.value, link.kind, link.value, who.kind) == ("place", place, "side", side, "who"):
                return people(who)
        return set()

    def _bare(self, measure: st.Measure, quote: st.Quote, said: list[Chunk]) -> Iterator[str]:
        """Check how a place without an amount compares: at it, before it, past it."""
        sides = [each.value for each, place in zip(said, said[1:], strict=False) if each.kind == "side" and place.kind == "place"]
        stands = any(each.kind == "be" for each in said) and not any(each.kind == "event" for each in said)
        known = {_BARE[each] for each in sides if each in _BARE}
        if measure.op != "==" and measure.op not in known and not re.search(r"(?i)past|beyond|reach|behind|through", quote.text):
            yield f"'{quote.text}' says that it is at the place: `op` is =="
        elif known and stands and measure.op not in known:
            yield f"'{quote.text}' says that it is {' or '.join(sides)} the place: `op` is {' or '.join(known)}"

    def _other(self, measure: st.Measure, other: int, quote: st.Quote, said: list[Chunk]) -> Iterator[str]:
        named = {who for each in said if each.kind == "who" for who in people(each)}
        has_pronoun = any(each.kind == "pronoun" for each in said)
        if other not in named and not has_pronoun and other not in self.heard.subjects(quote.start)[0]:
            yield from self._silent(quote, f"'{quote.text}' does not name {self._name(other)}", *self._names(other))
        turned = f"'{quote.text}' says it of {self._name(other)} and {self._name(measure.actor)} the other way round"
        for place, each in enumerate(said[:-1]):
            before = [who for who in said[:place] if who.kind in ("who", "pronoun")][-1:]
            if each.value not in ("ahead", "behind", "to", "with", "than", "as fast as") or not before:
                continue
            rear, front = (said[place + 1], before[0]) if each.value == "ahead" else (before[0], said[place + 1])
            known = [(slot, people(who)) for slot, who in ((measure.actor, rear), (other, front)) if who.kind == "who"]
            if any(slot not in who and {measure.actor, other} & who for slot, who in known):
                yield turned
        ahead = {(actor.id, each.of) for actor in self.claim.story.actors for each in actor.relations if each.kind == "ahead"}
        if measure.quantity in (st.Quantity.GAP, st.Quantity.HEADWAY) and (measure.actor, other) in ahead and not len(named) > 1:
            yield f"{self._name(measure.actor)} is ahead: the one behind measures the {measure.quantity}"
        fast = [each.value for each in said if each.kind == "factor"]
        if measure.quantity is st.Quantity.SPEED and fast:
            slower = fast[-1] == "slower"
            wrong = measure.op not in ((">", ">=") if fast[-1] == "faster" else ("<", "<=") if slower else ("==", ">=", "<="))
            if wrong if measure.amount is None else measure.opposite is not slower:
                yield f"'{quote.text}' says {fast[-1]}"

    def _bound(self, op: st.Operator, quote: st.Quote, amount: st.Amount) -> Iterator[str]:
        """Check a bound: a word for it before the amount, or after it."""
        if amount.quote is None:
            return
        near = Span(max(quote.start, amount.quote.start - 40), min(quote.end, amount.quote.end + 12))
        bounds = [each for each in self.heard.within(near) if each.kind == "bound"]
        told = next((each.value for each in reversed(bounds) if 0 <= amount.quote.start - each.end < 4), None)
        allowed = {"<": ("<", "<=", "=="), None: None}.get(told, (told,)) if told else None
        words = near.excerpt(self.text)
        if allowed is not None and op not in allowed:
            yield f"'{words}' says {told}, not {op}"
        elif allowed is None and op != "==":
            if not (_LOWER if op in (">", ">=") else _UPPER).search(words):
                about = BOUNDS[op].strip()
                yield from self._silent(quote, f"'{words}' is no bound ({op}) but the amount itself (==)", about)

    # -- deeds, orders, holds -----------------------------------------------------------------------------------------
    def _deed(self, deed: st.Deed) -> Iterator[str]:
        for measure in deed.throughout:
            yield from self._measure(measure)
        quote = deed.quote
        if quote is None:
            yield f"no words are quoted for '{deed.verb}' of {self._name(deed.actor)}"
            return
        said = [each for each in self.heard.within(quote.span) if _verb(each)]
        own = [each.start for each in said if _verb(each) == deed.verb]
        same = [each for each in self.claim.story.deeds_of(deed.actor) if each.verb == deed.verb != st.Verb.DRIVE]
        if any(each.begins == deed.ends and each.quote == quote for each in same):
            yield f"'{quote.text}' is one deed, not two"
        if own:
            yield from self._subject(deed.actor, quote, own, f"'{deed.verb}'")
        elif deed.verb == st.Verb.STAND and _STANDS.search(quote.text) and self._stopped(deed):
            return
        elif deed.verb != st.Verb.DRIVE and said:
            yield f"'{quote.text}' says {' and '.join(each.text for each in said)}, not '{deed.verb}'"
        elif deed.verb != st.Verb.DRIVE:  # what somebody does until its first deed, and after its last
            yield from self._silent(quote, f"'{quote.text}' does not say '{deed.verb}'", deed.verb, *DOES.get(deed.verb, ()))

    def _stopped(self, deed: st.Deed) -> bool:
        """Whether somebody has just come to a standstill."""
        return any(each.ends == deed.begins and each.verb == st.Verb.BRAKE for each in self.claim.story.deeds_of(deed.actor))

    def _words_of(self, moment: int) -> set[str]:
        """Return who and what a moment is about, as words that may be used to speak of it."""
        story = self.claim.story
        deeds = [(deed, DOES.get(deed.verb, (deed.verb,))) for deed in story.deeds if moment in (deed.begins, deed.ends)]
        conditions = [each for condition in story.moments[moment].conditions for each in st.atoms(condition)]
        people = {deed.actor for deed, _ in deeds} | {who for each in conditions for who in st.people_in(each)}
        told = [each.quote.text for each in conditions if each.quote]
        told += [" ".join(words) for deed, words in deeds if deed.begins == moment or not conditions]
        return {f"#{who}" for who in people} | set(_WORD.findall(" ".join(told).lower()))

    def _order(self, order: st.Order) -> Iterator[str]:
        yield from self._amount(order.margin)
        story, quote = self.claim.story, order.quote
        if quote is None:
            yield "no words are quoted for an order"
            return
        if order.margin is not None:
            yield from self._bound(order.op, quote, order.margin)
        for actor in story.actors:
            knots = story.knots_of(actor.id)
            if order.first in knots and order.second in knots:
                if knots.index(order.first) >= knots.index(order.second):
                    yield f"{actor.name} comes through the second moment of '{quote.text}' before the first"
                return
        if order.first == st.START:
            return
        first, second = self._words_of(order.first), self._words_of(order.second)
        early, late = self._told_first(quote)
        first, second, early, late = first - second, second - first, early - late, late - early
        fits, turned = len(early & first) + len(late & second), len(early & second) + len(late & first)
        if turned > fits:
            yield f"'{quote.text}' says it in the other order"
        elif not fits:
            yield from self._silent(quote, f"'{quote.text}' does not say which of the moments is first", "before", "after", "first")

    def _told_first(self, quote: st.Quote) -> tuple[set[str], set[str]]:
        """Return who and what is first and second by the words for an order; empty sets where there are none."""
        said = self.heard.within(quote.span)
        for place, each in enumerate(said):
            if each.kind == "order":  # "goes first", "lets it go first"
                who = [other for other in said[:place] if other.kind in ("who", "pronoun")][-1:]
                first = {word for word in self._spoken(who) if word[0] == "#"}
                return first, {f"#{actor.id}" for actor in self.claim.story.actors if first} - first
            follows = said[place + 1] if place + 1 < len(said) else None
            if each.kind in ("side", "link") and each.value in _FIRST and follows and follows.kind in ("who", "pronoun"):
                comma = (number for number in range(place, len(said)) if place == 0 and said[number].kind == "comma")
                end = next(comma, len(said))
                inner, outer = self._spoken(said[place + 1 : end]), self._spoken([*said[:place], *said[end:]])
                if not any(word[0] == "#" for word in outer):
                    outer |= {f"#{who}" for who in self.heard.subjects(quote.start)[0]}
                return (outer, inner) if _FIRST[each.value] else (inner, outer)
        return set(), set()

    def _spoken(self, chunks: Sequence[Chunk]) -> set[str]:
        found = {f"#{who}" for each in chunks if each.kind == "who" for who in people(each)}
        found |= {f"#{self.by_pronoun[each.start]}" for each in chunks if each.start in self.by_pronoun}
        return found | {word for each in chunks for word in _WORD.findall(each.text.lower())}

    def _hold(self, hold: st.Hold) -> Iterator[str]:
        yield from self._condition(hold.condition)
        for point in (hold.start, hold.end):
            yield from self._amount(point.offset)
        if hold.quote is None:
            yield f"no words are quoted for what holds {hold.how}"
        elif not _HOW[hold.how].search(hold.quote.text):
            yield from self._silent(hold.quote, f"'{hold.quote.text}' does not say '{hold.how}'", hold.how)
        elif hold.how != "never" and re.search(r"(?i)\bnever\b", hold.quote.text):
            yield f"'{hold.quote.text}' says never"

    # -- all of the text ----------------------------------------------------------------------------------------------
    def _used_up(self) -> Iterator[str]:
        story, owned = self.claim.story, " ".join(said for _, said in self.claim.owned)
        used = [quote.span for quote in story.asides] + [span for span, _ in self.claim.owned if span]
        quotes = list(_quotes(story))
        amounts = used + [each.quote.span for each in _amounts(story) if each.quote]
        names = [span for own in self.claim.called.values() for words in own for span in locate(words, self.text)]
        names += [span for name in {each.name for each in story.parameters} for span in locate(name, self.text)]
        names += [span for actor in story.actors for lane in actor.way.lanes for span in locate(lane, self.text)]
        declared = {parameter.name for parameter in story.parameters}
        said = {each.quote.text for each in _amounts(story) if each.quote}
        again = [part.quote.span for part in (*story.deeds, *story.orders, *story.holds) if part.quote]
        for span in spoken_of(self.text):
            word = span.excerpt(self.text)
            named = re.search(rf"(?<![\w.]){re.escape(word)}(?![\w]|\.\d)", owned)
            repeated = _covered(span, again) and any(self.text.startswith(each, span.start) for each in said)
            if not _covered(span, amounts + names) and not named and not repeated:
                own = self.heard.sentence(span.start)[1]
                if not any(name in Span(own[0].start, own[-1].end).excerpt(self.text) for name in declared):
                    yield f"'{self.text[span.start : span.end + 12].strip()}' of the text is in no amount and no aside"
        deeds = [(deed.quote.span, deed.verb) for deed in story.deeds if deed.quote]
        for own in self.heard.said:
            whole = Span(own[0].start, own[-1].end)
            if len(own) > 1 and not _covered(whole, [*self.claim.read, *used, *quotes, *names], any_part=True):
                yield f"no reading and no slot tells of '{whole.excerpt(self.text)}'"
            for place, each in enumerate(own):
                own_to = any(span and _covered(each_span(each), [span]) and each.text in said for span, said in self.claim.owned)
                aside = own_to or _covered(each_span(each), [quote.span for quote in story.asides])
                if each.kind == "deed" and not self._is_background(own, place) and not aside:
                    if not any(span.start <= each.start < span.end and verb == _verb(each) for span, verb in deeds):
                        yield f"'{each.text}' in '{whole.excerpt(self.text)}' is in the words of no such deed"

    def _is_background(self, own: list[Chunk], place: int) -> bool:
        """Whether a deed is told as a moment or a wish, or of the ego, or again."""
        for each in reversed(own[:place]):
            if each.kind in ("mood", "negation") or (each.kind == "link" and each.value != "then"):
                return True
            if (each.kind, each.value) == ("phase", "finishes"):
                return True
            if each.kind == "side" and each.value in ("before", "after"):
                return True
            if each.kind == "comma":
                break
        return EGO in self.heard.subjects(own[place].start)[0]


def _verb(chunk: Chunk) -> str | None:
    """Return the deed that a chunk speaks of."""
    if chunk.kind in ("deed", "state"):
        return _DOES.get(chunk.value, chunk.value)
    return st.Verb.DRIVE if chunk.kind in ("event", "order") else None


def each_span(chunk: Chunk) -> Span:
    """Return where a chunk lies."""
    return Span(chunk.start, chunk.end)


def _covered(span: Span, by: Sequence[Span], any_part: bool = False) -> bool:
    return any(each.start < span.end and span.start < each.end if any_part
               else each.start <= span.start and span.end <= each.end for each in by)  # fmt: skip


def _amounts(story: st.Story) -> list[st.Amount]:
    from scenewright.language.compile import amounts_of

    return amounts_of(story)


def _quotes(story: st.Story) -> Iterator[Span]:
    for moment in story.moments:
        for condition in moment.conditions:
            yield from (each.quote.span for each in st.atoms(condition) if each.quote)
    for deed in story.deeds:
        yield from (each.quote.span for each in deed.throughout if each.quote)
    for part in (*story.deeds, *story.orders, *story.holds, *story.actors):
        if part.quote:
            yield part.quote.span
