"""Holds amounts and measures against the words that they quote: value, unit, who, where, bound and side.

What enters: parts of a `Claim`. What leaves: faults, as sentences for the model. Words either contradict a slot, which
is always a fault, or are silent about it; then an assumption or a question that quotes them must own to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from scenewright.errors import Span
from scenewright.language import story as st
from scenewright.language.model.amounts import read_amounts
from scenewright.language.model.heard import Heard, people
from scenewright.language.model.schema import Claim
from scenewright.language.phrases import BOUNDS, PLACES
from scenewright.language.read.chunks import Chunk
from scenewright.units import UNITS, format_fraction

STANDS = re.compile(r"(?i)\b(?:st[oa]\w*|halt\w*|rests?|stood|wait\w*|parked|zero|0)\b")
_NEGATED = re.compile(r"(?i)\b(?:not|never|no|n't)\b (?:\w+ ){0,2}?(?:exceed\w*|more|over|above|beyond|faster)")
_LOWER = re.compile(
    r"(?i)at least|no less|not less|more|over|above|exceed|beyond|minimum|faster|further|greater|sooner|earlier"
)
_UPPER = re.compile(r"(?i)at most|no more|up to|less|under|below|within|maximum|slower|closer|nearer|limit|later")
_BARE: dict[str, st.Operator] = {"past": ">", "at or past": ">=", "at or before": "<=", "before": "<"}
_FAST = {"faster": (">", ">="), "slower": ("<", "<="), "as fast as": ("==", ">=", "<=")}
_SLOWING = {"brake": True, "stop": True, "deceleration": True, "speed up": False, "acceleration": False}
_NEAR = 40  # characters before an amount in which its bound stands: "must not get there sooner than"


@dataclass(slots=True)
class Measured:
    """What is known while a claim is checked; `by_pronoun` holds whom each "it" was taken for."""

    claim: Claim
    text: str
    heard: Heard = field(init=False)
    by_pronoun: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.heard = Heard(self.text, self.claim.called)

    def name(self, actor: int) -> str:
        """Return what the reply calls somebody."""
        return self.claim.story.actors[actor].name

    def names(self, actor: int) -> tuple[str, ...]:
        """Return every word for somebody."""
        return (self.name(actor), *self.claim.called[actor])

    def silent(self, quote: st.Quote, fault: str, *about: str) -> Iterator[str]:
        """Yield a fault of silence, where no assumption and no question on these words owns to it by one of `about`."""
        for span, said in self.claim.owned:
            near = span is not None and span.start < quote.end and quote.start < span.end
            if near and any(re.search(rf"(?i)(?<![\w.]){re.escape(word)}", said) for word in about):
                return
        yield f"'{quote.text}' {fault}; if it is meant so, an assumption that quotes these words says '{about[0]}'"

    def subject(
        self, actor: int, quote: st.Quote, places: Sequence[int], what: str, other: int | None = None
    ) -> Iterator[str]:
        """Yield a fault where nobody of those who may be spoken of at `places` is `actor` (or `other`, if two are)."""
        known: set[int] = set()
        for at in places:
            found, pronoun = self.heard.subjects(at)
            known |= found
            stands = pronoun is not None and other is None and len(places) == 1
            before = self.by_pronoun.setdefault(pronoun, actor) if pronoun is not None and stands else actor
            if before != actor:
                yield f"'it' in '{quote.text}' cannot be both {self.name(actor)} and {self.name(before)}"
        known |= people(*self.heard.within(quote.span)) if other is not None else set()
        if not known or known == {other}:
            yield from self.silent(quote, f"names nobody of `called` that is {self.name(actor)}", *self.names(actor))
        elif actor not in known:
            told = " or ".join(map(self.name, sorted(known)))
            yield f"{what} in '{quote.text}' is said of {told}, not of {self.name(actor)}"

    # -- amounts ------------------------------------------------------------------------------------------------------
    def amount(self, amount: st.Amount | None) -> Iterator[str]:
        """Check that the words of an amount are its number and its unit."""
        if amount is None:
            return
        told = amount.name or f"{format_fraction(amount.value or 0)} {amount.unit}"  # type: ignore[arg-type]
        if amount.quote is None:
            yield f"no words are quoted for {told}"
            return
        read = read_amounts(amount.quote.text)
        numbers = [(abs(value), unit) for value, unit in read if not isinstance(value, str)]
        sizes = [(value * UNITS[unit].si_factor, UNITS[unit].dimension) for value, unit in numbers if unit]
        if amount.name is not None:
            if amount.name not in {value for value, _ in read}:
                yield f"'{amount.quote.text}' is not {told}"
        elif amount.value is None or amount.si is None or (abs(amount.si), amount.dimension) in sizes:
            return
        elif not (amount.value == 0 and amount.dimension == "speed" and STANDS.search(amount.quote.text)):
            if read and (abs(amount.value), None) not in numbers:
                yield f"'{amount.quote.text}' is not {told}"
            else:
                about = (format_fraction(amount.value), "standstill", "stop", "stand")
                yield from self.silent(amount.quote, f"does not say {told}", *about)

    def bound(self, op: st.Operator, quote: st.Quote, amount: st.Amount) -> Iterator[str]:
        """Check a bound: the words for it stand before the amount."""
        if amount.quote is None:
            return
        near = Span(max(quote.start, amount.quote.start - _NEAR), min(quote.end, amount.quote.end + 12))
        words = near.excerpt(self.text)
        bounds = ["==" if each.value == "falls" else each.value for each in self.heard.within(near)
                  if each.kind == "bound" and 0 <= amount.quote.start - each.end < 4]  # fmt: skip
        if bounds and op != bounds[-1]:
            yield f"'{words}' says {bounds[-1]}, not {op}"
        said = (_LOWER if op in (">", ">=") else _UPPER).search(_NEGATED.sub("at most", words))
        if not bounds and op != "==" and not said:
            yield from self.silent(quote, f"has no bound ({op}) but the amount itself (==)", BOUNDS[op].strip())

    # -- measures -----------------------------------------------------------------------------------------------------
    def condition(self, condition: st.Condition) -> Iterator[str]:
        """Check every measure of a condition."""
        for each in st.atoms(condition):
            yield from self.measure(each)

    def measure(self, measure: st.Measure) -> Iterator[str]:
        """Check one measure: its amount, who and where, how it compares."""
        quote, amount = measure.quote, measure.amount
        yield from self.amount(amount)
        if quote is None:
            yield f"no words are quoted for the {measure.quantity} of {self.name(measure.actor)}"
            return
        at = amount.quote.start if amount is not None and amount.quote is not None else None
        said = self.heard.clause(quote.start if at is None else at, quote.span)
        if measure.place is not None:
            yield from self._place(measure, measure.place, quote, at)
        elif at is not None or measure.other is not None:
            places = [quote.start if at is None else at]
            yield from self.subject(measure.actor, quote, places, f"the {measure.quantity}", measure.other)
        if measure.other is not None:
            yield from self._other(measure, measure.other, quote, said)
        times = [each.value for each in said if each.value in (st.Quantity.COLLISION, st.Quantity.ARRIVAL)]
        meant = measure.quantity in times or (not times and measure.quantity is not st.Quantity.COLLISION)
        if not meant and amount is not None and amount.dimension == "time":
            yield from self.silent(quote, f"does not speak of a {measure.quantity}", measure.quantity)
        if measure.quantity is st.Quantity.RATE:
            kinds = [each.value for each in said if each.kind in ("quantity", "deed") and each.value in _SLOWING]
            kinds = [each for each in kinds if each.endswith("celeration")] or kinds
            positive = amount is None or amount.value is None or amount.value > 0
            if kinds and positive and measure.opposite not in {_SLOWING[each] for each in kinds}:
                yield f"'{quote.text}' speaks of {kinds[0]}; `opposite` is true for slowing alone"
        if amount is not None:
            yield from self.bound(measure.op, quote, amount)

    def _place(self, measure: st.Measure, place: st.Place, quote: st.Quote, at: int | None) -> Iterator[str]:
        said, told, name = self.heard.within(quote.span), PLACES[place.name], self.name(measure.actor)
        own = [each for each in said if each.kind == "place"]
        marks = [each.start for each in said if each.value == place.name and each.kind in ("place", "event")]
        if marks:  # "before the ego passes it"
            marks += [two.start for one, two in pairwise(said)
                      if (one.kind, two.kind) == ("event", "pronoun") and two.start > marks[0]]  # fmt: skip
        elif own:
            yield f"'{quote.text}' speaks of {' and '.join(each.text for each in own)}, not of the {told}"
        else:
            yield from self.silent(quote, f"does not name the {told}: quote on to where it is named", told)
            if at is None:
                yield from self.silent(quote, f"does not say it of {name}", *self.names(measure.actor))
        counted = self.heard.places(at) if at is not None and own else set()
        if counted and place.name not in counted and marks:
            known = " or ".join(PLACES[each] for each in sorted(counted))
            yield f"the amount in '{quote.text}' is counted to the {known}, not to the {told}"
        if at is not None or marks:
            yield from self.subject(measure.actor, quote, marks if at is None else [at], f"the {measure.quantity}")
        near = self.heard.clause(at if at is not None else marks[0] if marks else quote.start, quote.span)
        for slot, whom, side in (("of", place.of, "of"), ("partner", place.partner, "with")):
            words = next((people(who) for one, link, who in zip(near, near[1:], near[2:], strict=False)
                          if one.kind == "place" and link.value == side), set[int]())  # fmt: skip
            expected = measure.actor if slot == "of" and whom is None else whom
            if words and expected is not None and expected not in words:
                yield f"'{quote.text}' names {self.name(min(words))} for the {told} (`{slot}`)"
            elif whom is not None and not words and whom not in people(*near):
                yield f"'{quote.text}' does not name {self.name(whom)} (`{slot}` of the {told})"
        sides = [one.value for one, two in pairwise(said) if two.kind == "place" and one.start > (at or 0)]
        if at is None:
            yield from self._bare(measure, quote, near)
        elif measure.opposite is not (sides[:1] in (["past"], ["after"])):
            yield f"'{quote.text}' says '{''.join(sides[:1])}' of the {told}: `opposite` is true for past it alone"

    def _bare(self, measure: st.Measure, quote: st.Quote, said: list[Chunk]) -> Iterator[str]:
        """Check how a place without an amount compares: at it, before it, past it."""
        known = {_BARE[one.value] for one, two in pairwise(said) if two.kind == "place" and one.value in _BARE}
        kinds = {each.kind for each in said}
        loose = "event" not in kinds and re.search(r"(?i)past|beyond|reached|through|not yet", quote.text)
        if measure.op != "==" and measure.op not in known and not loose:
            yield f"'{quote.text}' says that it is at the place: `op` is =="
        elif known and "be" in kinds and "event" not in kinds and measure.op not in known:
            yield f"'{quote.text}' is not at the place: `op` is {' or '.join(known)}"

    def _other(self, measure: st.Measure, other: int, quote: st.Quote, said: list[Chunk]) -> Iterator[str]:
        whole = self.heard.within(quote.span)
        if other not in people(*whole) | self.heard.subjects(quote.start)[0] and all(
            each.kind != "pronoun" for each in whole
        ):
            yield from self.silent(quote, f"does not name {self.name(other)}", *self.names(other))
        fast, told = measure.quantity is st.Quantity.SPEED, False
        for place, each in enumerate(said[:-1]):
            one, two = (
                next((who for who in said[:place][::-1] if who.kind in ("who", "pronoun")), None),
                said[place + 1],
            )
            sides = ("than", "as fast as") if fast else ("ahead", "behind", "to", "with")
            if each.value not in sides or one is None or two.kind not in ("who", "pronoun"):
                continue
            told, pair = True, (two, one) if each.value == "ahead" else (one, two)
            if any(slot not in people(who) and {measure.actor, other} & people(who)
                   for slot, who in zip((measure.actor, other), pair, strict=True)):  # fmt: skip
                yield f"'{quote.text}' says it of {self.name(other)} and {self.name(measure.actor)} the other way round"
        relations = {(actor.id, each.kind, each.of) for actor in self.claim.story.actors for each in actor.relations}
        if measure.quantity in (st.Quantity.GAP, st.Quantity.HEADWAY) and not told:
            if {(measure.actor, "ahead", other), (other, "behind", measure.actor)} & relations:
                yield f"{self.name(measure.actor)} is ahead: the one behind measures the {measure.quantity}"
            elif not {(measure.actor, "behind", other), (other, "ahead", measure.actor)} & relations:
                yield from self.silent(quote, "does not say who is in front", "behind", "ahead", "in front")
        factor = next((each.value for each in said if each.kind == "factor"), None)
        if fast and factor is None and measure.op != "==":
            yield from self.silent(quote, f"says no {BOUNDS[measure.op].strip()}", "faster", "slower")
        elif fast and factor is not None:
            opposed = measure.opposite is not (factor == "slower")
            if measure.op not in _FAST[factor] if measure.amount is None else opposed:
                yield f"'{quote.text}' says {factor}"
