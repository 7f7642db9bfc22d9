"""Tells a story in plain English: people and their ways first, then the moment, then what happens, one line each.

What enters: a `Story`. What leaves: sentences of the controlled English, which `read` reads back to the same story,
with the quotes of what each tells, or a `TranslationError` for the little that has no words yet. It decides nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

from scenewright.program.manner import NUMBERS, unit_of
from scenewright.program.types import DEFAULT_MAP, EGO, Parameter
from scenewright.translate import story as st
from scenewright.translate.phrases import DOES, ORDINALS, Phrases, amount, bounded, listed, sentence, untold
from scenewright.units import SI_SYMBOL, format_fraction

_LASTING = (st.Verb.DRIVE, st.Verb.STAND)  # deeds that need no end to be told
_SLOWING: dict[str, bool] = {st.Verb.BRAKE: True, st.Verb.SPEED_UP: False}  # deeds that are told with their rate
# How much later at most, of what may be earlier, too.
_CLOSE: dict[st.Operator, str] = {"<=": "no later than ", "<": "earlier than "}

Told = tuple[str, tuple[st.Quote, ...]]  # a sentence, and the quotes of what it tells


def tell(story: st.Story) -> list[str]:
    """Return `story` as sentences, one a line; raises `TranslationError` for what there are no words for."""
    return [text for text, _ in Teller(st.arranged(story)).lines()]


@dataclass(slots=True)
class Teller(Phrases):
    """Tells one story, sentence by sentence."""

    told: list[Told] = field(default_factory=list)
    known: list[int] = field(default_factory=lambda: [st.START])  # moments that have been told
    durations: set[st.Order] = field(default_factory=set)
    fresh: list[int] = field(default_factory=list)  # moments of which the joined conditions have not been told
    begun: list[st.Deed] = field(default_factory=list)  # deeds that have been told
    ended: list[st.Deed] = field(default_factory=list)  # those of which a reader knows when they end
    is_apart: bool = False  # a moment that is nobody's was told after the last deed

    def lines(self) -> list[Told]:
        """Return all sentences."""
        story = self.story
        self._head()
        for each in story.actors:
            self._say(sentence(f"{self.name(each.id)} {self.way(each.way)}"), each)
        if any(actor.relations for actor in story.actors):
            raise untold("how one way lies to another: choose the ways first")
        for parameter in story.parameters:
            self._parameter(parameter)
        self._start()
        for moment in self._in_time():
            if not any(moment in (deed.begins, deed.ends) for deed in story.deeds):
                self._pure(moment)
            for deed in story.deeds:
                if deed.begins == moment:
                    self._deed(deed)
        near = {order: twin for order in story.orders if (twin := self._twin(order)) is not None}
        for order in story.orders:
            if order not in self.durations and order not in near.values():
                self._say(sentence(self.order(order, order in near)), order)
                for moment in (order.first, order.second):
                    self._introduce(moment)
        for hold in story.holds:
            self._say(sentence(self.hold(hold)), hold)
        if st.comes_through(story, self.known, lambda moment: moment not in story.ego) != story.ego:
            events = [self.event(moment) for moment in story.ego] or ["nothing"]
            self._say(f"In the ego's order: {', then '.join(events)}.")
        return self.told

    def _say(self, text: str, *told: object) -> None:
        quotes = dict.fromkeys(st.within(told, st.Quote))
        self.told.append((text, tuple(sorted(quotes, key=lambda quote: quote.start))))

    def _head(self) -> None:
        story = self.story
        for label, text in (("Title", story.title), ("Map", None if story.map_name == DEFAULT_MAP else story.map_name)):
            if text is not None:
                if text != " ".join(text.split()) or not text:
                    raise untold(f"a {label.lower()} of this form")
                self._say(f"{label}: {text}")
        names = [actor.name for actor in story.actors]
        if "'" in "".join(names) or names[0] != "ego" or [actor.id for actor in story.actors] != [*range(len(names))]:
            raise untold("actors of these names")
        for name in NUMBERS:
            value = getattr(story.manner, name)
            if value != getattr(type(story.manner)(), name):
                self._say(f"Manner: {name} is {format_fraction(value)} {SI_SYMBOL[unit_of(name).dimension]}.")

    def _parameter(self, parameter: Parameter) -> None:
        unit = parameter.unit.symbol
        text = f"{parameter.name} is "
        text += "open" if parameter.value is None else f"{format_fraction(parameter.value)} {unit}"
        if parameter.low is not None or parameter.high is not None:
            low, high = (format_fraction(bound) for bound in parameter.bounds())
            text += f", from {low} {unit} to {high} {unit}"
        self._say(f"Parameter {text}.")

    def _start(self) -> None:
        conditions = self.story.moments[st.START].conditions
        simple = [each for each in conditions if isinstance(each, st.Measure)]
        for actor in self.story.actors:
            own = [each for each in simple if each.actor == actor.id]
            if own:
                self._say(f"At the start, {listed(self.clauses(own, passing=False))}.", *own)
        for each in conditions:
            if each not in simple:
                self._say(f"At the start, {self.clause(each)}.", each)

    def _in_time(self) -> list[int]:
        """Return the moments in an order that agrees with everybody's own, the smallest number first."""
        before = [pair for actor in self.story.actors for pair in pairwise(self.story.knots_of(actor.id))]
        order: list[int] = []
        left = [*range(len(self.story.moments))]
        while left:
            free = (each for each in left if not any(later == each and earlier in left for earlier, later in before))
            if (found := next(free, None)) is None:
                raise untold("moments that come before each other")
            order.append(found)
            left.remove(found)
        return order

    def _pure(self, moment: int) -> None:
        """Tell a moment at which nobody begins or ends a deed."""
        conditions, time = self.story.moments[moment].conditions, self.story.moments[moment].time
        if moment == st.START or self._is_left_to_an_order(moment):
            return
        is_nobodys = not conditions or (time is None and moment not in self.story.ego)
        if is_nobodys or any(isinstance(each, st.Compound) for each in conditions):
            raise untold("a moment that is nobody's")
        when = "Later" if time is None else f"When it is {amount(time)} after the start"
        self._say(f"{when}, {listed(self.clauses(conditions))}.", *conditions)
        self._introduce(moment)
        self.is_apart = True

    def _is_left_to_an_order(self, moment: int) -> bool:
        """Whether a moment is the ego's last and one event, and an order speaks of it."""
        conditions = self.story.moments[moment].conditions
        last = self.story.ego[-1:] == (moment,) and self.story.moments[moment].time is None and len(conditions) == 1
        pairs = [{order.first, order.second} for order in self.story.orders]
        its_own = last and st.is_event(conditions[0]) and conditions[0].actor == EGO
        return its_own and any(moment in pair and st.START not in pair for pair in pairs)

    def _introduce(self, moment: int) -> None:
        """Note that a moment has been told."""
        if moment in self.known:
            return
        conditions = self.story.moments[moment].conditions
        for other in self.known[1:]:
            same = set(conditions) & set(self.story.moments[other].conditions)
            if any(st.is_event(each) for each in same) or (conditions and same == set(conditions)):
                raise untold("two moments at which the same is so")
        self.known.append(moment)
        self.fresh.append(moment)

    def _items(self, moment: int, it: int | None = None) -> list[str]:
        """Return what is so at a moment, as clauses; only its name where it has been told."""
        if moment in self.known:
            return [self.event(moment)]
        found = self.story.moments[moment]
        simple = [each for each in found.conditions if isinstance(each, st.Measure)]
        time = [] if found.time is None else [f"it is {amount(found.time)} after the start"]
        return time + self.clauses(simple, it)

    def _compounds(self) -> None:
        for moment in self.fresh:
            for each in self.story.moments[moment].conditions:
                if isinstance(each, st.Compound):
                    self._say(f"When {self.event(moment)}, {self.clause(each)}.", each)
        self.fresh.clear()

    def _deed(self, deed: st.Deed) -> None:
        chain = self.story.deeds_of(deed.actor)
        index = chain.index(deed)
        waits = deed.verb in _LASTING and deed != chain[-1]  # its end is told with what follows
        lead, begins = self._begin(deed, chain, index)
        slowing = _SLOWING.get(deed.verb)
        rates = (each for each in deed.throughout if each.quantity is st.Quantity.RATE and each.opposite is slowing)
        rate = next(rates, None)
        held = [each for each in deed.throughout if each is not rate]
        duration = next((each for each in self.story.orders if (each.first, each.second) == (deed.begins, deed.ends)
                         and each.margin is not None and each not in self.durations), None)  # fmt: skip
        plain = waits and deed.verb == st.Verb.DRIVE and not held and duration is None
        plain &= st.standstill(deed.actor) not in self.story.moments[st.START].conditions
        if index == 0 and plain and self._items(deed.ends):
            return  # "When ..., the hero begins to brake" says it
        self.is_apart = False
        self.begun += [each for each in chain[: index + 1] if each not in self.begun]
        self.ended += chain[:index] if waits else chain[: index + 1]
        self._introduce(deed.begins)
        does, begin, _ = DOES[deed.verb]
        text = f"{lead}{self.name(deed.actor)} {f'begins to {begin}' if begins else does}"
        if rate is not None and rate.amount is not None:
            text += f" {'at' if rate.op == '==' else 'with'} {bounded(rate.op, rate.amount)}"
        if duration is not None and duration.margin is not None:
            self.durations.add(duration)
            text += f" for {bounded(duration.op, duration.margin)}"
        told = [*self.story.moments[deed.begins].conditions] if begins else []
        if not waits:
            until = self._items(deed.ends, deed.actor)
            if not until and any(each.ends == deed.ends for each in self.begun if each.actor != deed.actor):
                until = [self.event(deed.ends)]
            lasts = duration is not None or deed.verb in _LASTING
            text += f" until {listed(until)}" if until else "" if lasts else " for a while"
            self._introduce(deed.ends)
            told += self.story.moments[deed.ends].conditions
        self._say(sentence(text), deed, *told)
        for each in held:
            self._say(f"Meanwhile, {self.clause(each)}.", each)
        self._compounds()

    def _begin(self, deed: st.Deed, chain: tuple[st.Deed, ...], index: int) -> tuple[str, bool]:
        """Return the words before the subject, and whether the deed is told as one that begins: ``When ..., ``."""
        if index == 0:
            return ("At the start, " if deed.verb in (st.Verb.BRAKE, st.Verb.SPEED_UP) else ""), False
        before, at_once = chain[index - 1], False
        if before.verb in _LASTING:
            if items := self._items(deed.begins):
                return f"When {listed(items)}, ", True
        else:
            moving = deed.verb in (st.Verb.DRIVE, st.Verb.SPEED_UP)
            at_once = moving and st.standstill(deed.actor) in self.story.moments[deed.begins].conditions
        # "Then" after what another one does would be an order.
        follows = self.begun[-1].actor == deed.actor and not self.is_apart
        return ("Then " if follows else f"After {DOES[before.verb][2]}, ") + "at once " * at_once, False

    def event(self, moment: int) -> str:
        """Return the words that a moment is known by."""
        conditions = self.story.moments[moment].conditions
        elsewhere = {each for number, other in enumerate(self.story.moments) if number != moment
                     for each in other.conditions}  # fmt: skip
        own = [each for each in conditions if isinstance(each, st.Measure) and each not in elsewhere]
        for measure in own:
            if st.is_event(measure):
                return self.clause(measure, passing=st.standstill(measure.actor) not in conditions)
        for deed in self.begun:
            if deed.begins == moment and moment != st.START:
                return f"{self.name(deed.actor)} begins to {DOES[deed.verb][1]}{self.which_time(deed)}"
        for deed in self.begun:
            if deed.ends == moment and (deed in self.ended or moment not in self.known):
                self.ended.append(deed)
                return f"{self.name(deed.actor)} finishes {DOES[deed.verb][2]}{self.which_time(deed)}"
        if not own:
            raise untold("a moment that nothing tells from others")
        return self.clause(own[0])

    def which_time(self, deed: st.Deed) -> str:
        """Return which time somebody does a deed, where it is not the first."""
        number = [each for each in self.story.deeds_of(deed.actor) if each.verb == deed.verb].index(deed)
        if number >= len(ORDINALS):
            raise untold("so many deeds of one kind")
        return "" if number == 0 else f" for the {ORDINALS[number]} time"

    def _twin(self, order: st.Order) -> st.Order | None:
        """Return the order that "at most 2 s after" tells with this one: it is not before it, either."""
        is_near = order.first != st.START and order.op in _CLOSE and order.margin is not None
        twins = (each for each in self.story.orders if (each.first, each.second, each.op, each.margin)
                 == (order.first, order.second, ">=", None))  # fmt: skip
        return next(twins, None) if is_near and order not in self.durations else None

    def order(self, order: st.Order, is_near: bool = False) -> str:
        """Return the order of two moments as a clause; `is_near`: the second is not before the first, either."""
        if st.START in (order.first, order.second):
            if order.first != st.START or order.margin is None:
                raise untold("what comes before the start")
            return f"{self.event(order.second)} {bounded(order.op, order.margin)} after the start"
        if order.margin is not None:
            one_side = order.op in _CLOSE and not is_near
            margin = _CLOSE[order.op] + amount(order.margin) if one_side else bounded(order.op, order.margin)
            return f"{self.event(order.second)} {margin} after {self.event(order.first)}"
        link = "before" if order.op == ">" else "no later than"
        return f"{self.event(order.first)} {link} {self.event(order.second)}"

    def hold(self, hold: st.Hold) -> str:
        """Return what holds over an interval as a clause."""
        start, end = self._point(hold.start, False), self._point(hold.end, True)
        return f"from {start} until {end}, {hold.how}: {self.clause(hold.condition)}"

    def _point(self, point: st.Point, is_end: bool) -> str:
        event = "the start" if point.moment == st.START else self.event(point.moment)
        if point.offset is None:
            return event if is_end or point.moment == st.START else f"when {event}"
        return f"{amount(point.offset)} {'before' if point.earlier else 'after'} {event}"
