"""What the words of a text say: who is spoken of at a place of it, and whether amounts and measures are as they claim.

What enters: a text with the words by which it names each actor, and parts of a `Claim`. What leaves: who is possible,
and faults, as sentences for the model. Words either contradict a slot, which is always a fault, or are silent about it:
then an assumption or a question that quotes them must own to it. Words that nobody knows only leave more open.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise

from scenewright.errors import Span
from scenewright.program.arithmetic import JUST_BEFORE_M
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.model.schema import Claim, locate
from scenewright.translate.phrases import BOUNDS, PLACES
from scenewright.translate.phrases import amount as phrase_of
from scenewright.translate.read.chunks import Chunk, sentences, vocabulary
from scenewright.translate.read.items import ONE_SIDE

STANDS = re.compile(r"(?i)\b(?:st[oa]\w*|halt\w*|rests?|wait\w*|parked|zero)\b")
_BARE: dict[str, st.Operator] = {"past": ">", "at or past": ">=", "at or before": "<=", "before": "<"}
_FAST = {"faster": (">", ">="), "slower": ("<", "<="), "as fast as": ("==", ">=", "<=")}
_SLOWING = {"brake": True, "stop": True, "deceleration": True, "speed up": False, "acceleration": False}
_SHARES = {"half": ".5", "quarter": ".25", "¼": ".25", "½": ".5", "¾": ".75"}
_OF_TURNS = {"begins": "turn_start", "finishes": "turn_end"}
_DOES = {"stop": st.Verb.BRAKE, "stands": st.Verb.STAND, "drives": st.Verb.DRIVE}
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
    is_name = own[at].kind == "who" or (own[at].kind, own[at].value) == ("pronoun", "it")
    return is_name and at + 1 < len(own) and own[at + 1].kind in _PREDICATES


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


# -- what a claim is held against -----------------------------------------------------------------------------------
def meaning(chunk: Chunk) -> str:
    """Return the deed that a chunk speaks of, else its value."""
    return st.Verb.DRIVE if chunk.kind in ("event", "order") else _DOES.get(chunk.value, chunk.value)


@dataclass(slots=True)
class Measured:
    """What is known while a claim is checked."""

    claim: Claim
    text: str
    heard: Heard

    def name(self, actor: int) -> str:
        """Return what the reply calls somebody."""
        return self.claim.story.actors[actor].name

    def silent(self, quote: st.Quote, fault: str, *about: str) -> Iterator[str]:
        """Yield a fault of silence, where no assumption and no question on these words owns to it by one of `about`."""
        for span, said in self.claim.owned:
            near = span is not None and span.start < quote.end and quote.start < span.end
            if near and any(re.search(rf"(?i)(?<![\w.]){re.escape(word)}", said) for word in about):
                return
        yield f"'{quote.text}' {fault}; if it is meant so, an assumption that quotes these words says '{about[0]}'"

    def subject(self, actor: int, quote: st.Quote, places: Sequence[int], other: int | None = None) -> Iterator[str]:
        """Yield a fault where `actor` is none of those who are spoken of at `places`; of two, named anywhere."""
        if other is None and actor in self.heard.named(quote.span):
            return
        known = {each for at in places for each in self.heard.subjects(at)}
        known |= people(*self.heard.within(quote.span)) if other is not None else set()
        if not known or known == {other}:
            names = self.name(actor), *self.claim.called[actor]
            yield from self.silent(quote, f"names nobody of `called` that is {self.name(actor)}", *names)
        elif actor not in known:
            told = " or ".join(map(self.name, sorted(known)))
            yield f"what '{quote.text}' says is said of {told}, not of {self.name(actor)}"

    def says(
        self, quote: st.Quote, said: Sequence[Chunk], value: str, actor: int, *more: str, other: int | None = None
    ) -> Iterator[str]:
        """Check that one of the chunks that tell of such a thing says `value`, and says it of somebody."""
        if own := [each.start for each in said if value in (each.value, meaning(each))]:
            yield from self.subject(actor, quote, own, other)
        elif said:
            yield f"'{quote.text}' says {' and '.join(each.text for each in said)}, not '{more[-1] if more else value}'"
        else:
            yield from self.silent(quote, f"does not say '{value}' of {self.name(actor)}", *more, value)

    # -- amounts ------------------------------------------------------------------------------------------------------
    def amount(self, amount: st.Amount, quote: st.Quote) -> Iterator[str]:
        """Check that the words of an amount are its number and its unit."""
        value, told = amount.name or abs(amount.value or 0), phrase_of(amount)
        read, stands = list(read_amounts(quote.text)), value == 0 and amount.dimension == "speed"
        if (value, amount.unit) in read:
            return
        if amount.name or (read and (value, None) not in read):
            yield f"'{quote.text}' is not {told}"
        elif not (stands and STANDS.search(quote.text)):
            about = ("stop", "stand") if stands else (told.split()[0],)
            yield from self.silent(quote, f"does not say {told}", told, *about)

    def bound(self, op: st.Operator, quote: st.Quote, amount: st.Amount) -> Iterator[str]:
        """Check a bound: the words for it stand before the amount."""
        at = amount.quote.start if amount.quote else quote.start
        said = self.heard.within(quote.span)
        before = [
            first for first, second in pairwise(said) if second.kind == "amount" and second.start <= at < second.end
        ]
        bounds = ["==" if each.value in ("falls", "about") else each.value for each in said
                  if each.kind == "bound" and (each in before or 0 <= at - each.end < 4)]  # fmt: skip
        sides = [each.value for each in said if each.kind == "side" and each.start > at] or [""]
        bounds += [ONE_SIDE[key] for each in said if (key := (each.value, sides[0])) in ONE_SIDE and at > each.start]
        if bounds and any(each.kind == "negation" for each in said):  # "must not exceed"
            bounds = [{">": "<=", "<": ">=", ">=": "<", "<=": ">"}.get(bounds[-1], bounds[-1])]
        within = op == "<=" and any(each.value == "falls" for each in said)  # "within 2 s" of how long it takes
        if bounds and op != bounds[-1] and not within:
            yield from self.silent(quote, f"says {bounds[-1]}, not {op}", op)
        elif op not in ("==", *bounds) and all(each.kind not in ("negation", "factor") for each in said):
            yield from self.silent(quote, f"has no bound ({op}) but the amount itself (==)", BOUNDS[op].strip())

    # -- measures -----------------------------------------------------------------------------------------------------
    def measure(self, measure: st.Measure, quote: st.Quote) -> Iterator[str]:
        """Check one measure: who and where, how it compares."""
        amount = measure.amount
        at = amount.quote.start if amount is not None and amount.quote is not None else None
        near, whole = self.heard.clause(quote.start if at is None else at), self.heard.within(quote.span)
        said = [each for each in whole if each in near]
        if measure.place is not None:
            yield from self._place(measure, measure.place, quote, at)
        elif at is not None or measure.other is not None:
            yield from self.subject(measure.actor, quote, [quote.start if at is None else at], measure.other)
        if measure.other is not None:
            yield from self._other(measure, measure.other, quote, said)
        times = [each.value for each in said if each.value in (st.Quantity.COLLISION, st.Quantity.ARRIVAL)]
        meant = measure.quantity in times or (not times and measure.quantity is not st.Quantity.COLLISION)
        if not meant and amount is not None and amount.dimension == "time":
            yield from self.silent(quote, f"does not speak of a {measure.quantity}", measure.quantity)
        if measure.quantity is st.Quantity.RATE:
            kinds = [each.value for each in said if each.kind in ("quantity", "deed") and each.value in _SLOWING]
            if kinds and measure.opposite not in {_SLOWING[each] for each in kinds}:
                yield f"'{quote.text}' speaks of {kinds[0]}; `opposite` is true for slowing alone"
        if amount is not None:
            yield from self.bound(measure.op, quote, amount)

    def _place(self, measure: st.Measure, place: st.Place, quote: st.Quote, at: int | None) -> Iterator[str]:
        """Check a place: that it is named, by whom it is passed, and on which side of it somebody is."""
        said, told = self.heard.within(quote.span), PLACES[place.name]
        marks = [each.start for each in said if each.value == place.name]
        plain = [each for each in said if each.kind not in ("pronoun", "possessive", "unknown")]  # "past its stop line"
        marks += [one.start for one, two in pairwise(plain) if two.kind == "turn" or two.value == "turn"
                  if _OF_TURNS.get(one.value) == place.name]  # "begins its left turn" # fmt: skip
        if not marks:
            yield from self.silent(quote, f"does not name the {told}: quote on to where it is named", told)
        elif at is not None and self.heard.place(at) not in (None, place.name):
            yield f"the amount in '{quote.text}' is not counted to the {told}"
        yield from self.subject(measure.actor, quote, [at] if at is not None else marks)
        sides = [one.value for one, two in pairwise(plain) if two.kind == "place" and one.start > (at or 0)]
        known = {_BARE[each] for each in sides if each in _BARE}
        if at is not None and measure.opposite is not (sides[:1] in (["past"], ["after"])):
            yield f"'{quote.text}' says '{''.join(sides[:1])}' of the {told}: `opposite` is true for past it alone"
        elif at is None and measure.op not in ("==", *known):
            yield from self.silent(quote, "says that it is at the place: `op` is ==", BOUNDS[measure.op].strip())

    def _other(self, measure: st.Measure, other: int, quote: st.Quote, said: list[Chunk]) -> Iterator[str]:
        """Check whom somebody is measured to, and which of both is in front, or faster."""
        fast, pair = measure.quantity is st.Quantity.SPEED, {measure.actor, other}
        for place, each in enumerate(said[:-1]):
            one = next((who for who in reversed(said[:place]) if who.kind == "who"), each)
            if each.value in (("than", "as fast as") if fast else ("ahead", "behind", "to", "with")):
                sides = people(one), people(said[place + 1])
                actors = (other, measure.actor) if each.value == "ahead" else (measure.actor, other)
                if any(who not in known and known & pair for who, known in zip(actors, sides, strict=True)):
                    yield f"'{quote.text}' says it of {self.name(other)} and {self.name(measure.actor)} the other way"
        start, told = self.claim.story.moments[st.START].conditions, {each.value for each in said}
        if not (fast or measure in start or told & {"ahead", "behind", "to", "with"}):  # "the gap"
            behind, ahead = (self.claim.story.actors[who] for who in (measure.actor, other))
            if (rears := st.rears(behind, ahead, [start])) and measure.actor not in rears:
                fault = f"does not say that {behind.name} is behind {ahead.name}, as it was not at the start"
                yield from self.silent(quote, fault, "behind")
        factor = next((each.value for each in said if each.kind == "factor"), "")
        if fast and (factor or measure.op != "=="):
            opposed = measure.opposite is not (factor == "slower")
            if measure.op not in _FAST.get(factor, ()) if measure.amount is None else factor and opposed:
                yield from self.silent(quote, f"says {factor or 'neither faster nor slower'}", "faster", "slower")


# -- amounts in words -----------------------------------------------------------------------------------------------
def read_amounts(words: str) -> Iterator[tuple[Fraction | str, str | None]]:
    """Yield the numbers (without their signs) and parameters that words can be read as, each with its unit.

    Examples
    --------
    >>> [(value, unit) for value, unit in read_amounts("twenty-five metres")]
    [(Fraction(25, 1), 'm')]
    """
    plain = _in_digits(words)
    for reading in {plain.replace(",", "."), plain.replace(",", "")}:  # a decimal comma, or one between thousands
        for chunk in (chunk for sentence in sentences(reading) for chunk in sentence):
            if chunk.amount is not None:
                yield chunk.amount.name or abs(chunk.amount.value or Fraction(0)), chunk.amount.unit
            elif chunk.kind == "no unit" and chunk.value[-1].isdigit():
                yield abs(Fraction(chunk.value)), None
            elif chunk.kind == "near":
                yield Fraction(JUST_BEFORE_M), "m"


def _in_digits(words: str) -> str:
    """Return words with their numbers in digits: "two and a half seconds" as "2.5 seconds"."""
    known = {**{word: str(number) for word, number in vocabulary().numbers.items()}, **_SHARES, "hundred": "100"}
    word = rf"(?:\b(?:{'|'.join(known)})\b|[¼½¾])"

    def value(match: re.Match[str]) -> str:
        total = Fraction(0)
        for said in re.findall(rf"(?i)\d+|{word}", match[0]):
            size = Fraction(known.get(said.lower(), said))
            total = max(total, Fraction(1)) * 100 if said.lower() == "hundred" else total + size
        return f"{float(total):g}"

    run = rf"(?i)(?:\ban? )?(?:\d+|{word})(?:(?:[\s-]|\band\b|\ban?\b)*{word})+|[¼½¾]|\b(?:half|quarter)\b"
    said = re.sub(run, value, words)
    return re.sub(r"(?i)(?<=\d) (?:of )?an? (?=\w)|^an? (?=\w+$)", lambda at: " " if at.start() else "1 ", said)
