"""Who is spoken of: people by name, kind and what describes them, pronouns, and questions where two fit.

What enters: mentions, one after the other. What leaves: numbers of actors. It knows no moments and no deeds.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any, NoReturn

from scenewright.errors import UnknownWordsError
from scenewright.program.expressions import CONFLICT_LANDMARKS
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.phrases import OTHERWISE
from scenewright.translate.read.chunks import MARKS, Chunk, nearest_words, word_as

_MARKS = {each.lower() for each in MARKS}
_FURTHER = {"second", "third", "fourth", *_MARKS - {"1", "a"}}
NEW, BEHIND = "somebody new", "Who drives behind?"
FIRST = 1  # the number of the first hero, with whom the ego's conflict point is where nothing says so
_ANY_KIND = ("vehicle", "driver", "motorist")
ASIDE, CAR = "set it aside", "a car of that name"


@dataclass(slots=True)
class Cast:
    """Everybody so far, and who and what was spoken of last."""

    text: str
    answers: Mapping[str, str] = field(default_factory=dict)
    actors: dict[int, st.Actor] = field(default_factory=dict)
    known_by: dict[int, set[str]] = field(default_factory=dict)  # the words that somebody was described with
    assumptions: list[str] = field(default_factory=list)
    questions: list[st.Question] = field(default_factory=list)
    mentioned: list[int] = field(default_factory=list)  # in this sentence
    meant: list[int] = field(default_factory=list)  # by "ahead of it" in this sentence
    named: list[Chunk] = field(default_factory=list)  # the words for people that are still to come in it, too
    subject: int | None = None  # of the last main clause
    place: st.Place | None = None  # that was spoken of last
    acting: set[int] = field(default_factory=set)  # who does something, as far as it was told
    doer: int | None = None  # whose deed it is, while what ends it is read
    quote: st.Quote = field(default_factory=lambda: st.Quote(0, 0, ""))  # the sentence that is being read
    # Who is behind whom, by words that do not say it: what is told elsewhere was taken.
    inferred: dict[st.Quote, tuple[int, int]] = field(default_factory=dict)

    def who(self, chunk: Chunk, acts: bool = False, is_either: bool = False) -> int:
        """Return the number of whoever is mentioned, or is new. Who `acts` is not the ego; "it" may be `is_either`."""
        if chunk.kind == "relative" and self.mentioned:
            return self.mentioned[-1]
        actor = self._it(chunk, acts, is_either) if chunk.kind in ("pronoun", "relative") else self._named(chunk)
        self.mentioned.append(actor)
        for trait in chunk.traits:
            if trait.kind == "relation":
                self.relate(actor, st.Relation(trait.value, EGO, trait.quote))
            elif trait.kind in ("heading", "turn"):
                self.tell_way(actor, {trait.kind: trait.value})
        return actor

    def either(self, subject: int | None) -> bool:
        """Whether "it" may be of whom the moment in front is, or of the `subject` that was spoken of before that."""
        return bool(self.mentioned) and subject not in (None, self.mentioned[-1])

    def settled(self, chunks: list[Chunk], following: Sequence[Chunk]) -> list[Chunk]:
        """Return a fronted clause with who its "it" is: whom the last sentence was of, or who is named next."""
        words = [each.value for each in chunks]
        if self.subject is None or words[:1] != ["it"] or "the start" in words:  # "it is 5 s after the start"
            return chunks
        known = [each for each in following[:1] if each.kind in ("actor", "name") and not each.is_new]
        both = any(each.kind == "pronoun" and before.value in ("ahead", "behind") for before, each in pairwise(chunks))
        others = [each for each in self.actors if both and each != self.subject]  # "it is 10 m behind it"
        people: list[int | None] = [*dict.fromkeys([*others, *(self._named(each) for each in known), self.subject])]
        actor = self.actor(self._one_of(people, "Who is 'it'?", len(people) - 1, chunks[0].quote) or 0)
        return [replace(chunks[0], kind="name", value=actor.name), *chunks[1:]]

    def whom(self, quote: st.Quote, subject: int | None) -> int:
        """Return the only one who is meant and is not the subject: of the sentence, else of all."""
        others = {*self.mentioned, *self.meant} - {subject} or set(self.actors) - {subject}
        if len(others) != 1:
            self.refuse("it is not clear who is meant", quote)
        return others.pop()

    def where(self, chunk: Chunk) -> st.Place:
        """Return the place that "it" means: the one that was spoken of last, with whose it was."""
        if self.place is None:
            self.refuse("it is not clear which place is meant", chunk.quote)
        return self.place

    def seen_by(self, place: st.Place, subject: int | None) -> st.Place:
        """Return the place that "it" is of somebody: where two ways meet it is of both."""
        owner, usual = place.of, FIRST if place.of == EGO else EGO
        if owner in (None, subject) or place.name not in CONFLICT_LANDMARKS:
            return place
        is_its = subject == (usual if place.partner is None else place.partner)
        return st.Place(place.name, None, owner if is_its and owner != EGO else None)

    def partner(self, told: int | None, quote: st.Quote) -> int | None:
        """Return with whom the ego's conflict point is, None for the first hero: as told, else as named nearby."""
        if told is None:
            near: dict[int, tuple[int, str]] = {}
            for chunk in self.named:
                for number in self._fitting(chunk):
                    name = self.actors[number].name if number in self.actors else chunk.text
                    near[number] = min(near.get(number, (len(self.text), name)), (abs(chunk.start - quote.start), name))
            if not near and self.subject not in (None, EGO) and any(each.kind == "pronoun" for each in self.named):
                near = {self.subject or EGO: (0, "")}
            some = sorted(near, key=near.__getitem__) or sorted(each.id for each in self.heroes)
            names = [near[each][1] if each in near else self.actors[each].name for each in some]
            if len(some) > 1:
                asked = f"The conflict point with whom is meant: {self.quote.text}"
                answer = self.ask(f"conflict point {quote.start}", asked, names, 0, quote)
                told = some[names.index(answer)]
            elif some:
                told = some[0]
        return None if told == FIRST else told

    def _fitting(self, chunk: Chunk) -> list[int]:
        """Return which heroes a mention may mean; one that nobody was told of yet has the next number."""
        if chunk.kind == "name":
            return [each.id for each in self.heroes if each.name == chunk.value]
        if chunk.kind != "actor" or chunk.value == "ego":
            return []
        words = {each.text.lower() for each in chunk.traits if each.kind == "quality"}
        found = [each.id for each in self.heroes if self._fits(each, chunk, words)]
        return found or [max(self.actors, default=0) + 1]

    def pair(self, chunk: Chunk) -> tuple[int, int]:
        """Return the ego and the only other one, whom "both" and "they" mean."""
        if len(self.heroes) != 1 or EGO not in self.actors:
            self.refuse(f"it is not clear who '{chunk.text}' are", chunk.quote, "name them")
        return EGO, self.heroes[0].id

    def rear(self, one: int, other: int, quote: st.Quote) -> int:
        """Return who of two drives behind the other: as was said, else the first; asked unless all says the same."""
        if one == other:
            self.refuse("one and the same is named twice", quote)
        before = [rear for rear, front in self.inferred.values() if {rear, front} == {one, other}]
        told, both = self.told_rears(one, other) or before[-1:], [one, other]
        rear = [one, *told][-1]
        if len({*told}) != 1:
            rear = self._one_of([*both], BEHIND, both.index(rear), quote) or 0
        self.inferred[quote] = rear, one + other - rear
        return rear

    def told_rears(self, one: int, other: int) -> list[int]:
        """Return who of two was said to be behind the other, each time that it was; what was inferred says nothing."""
        told = ([each for each in some if all(not each.quote or each.quote.start not in range(own.start, own.end)
                 for own in self.inferred)] for some in self.told)  # fmt: skip
        return st.rears(self.actor(one), self.actor(other), told)

    def told_later(self) -> dict[str, str]:
        """Return the answers that a text gives after it was asked who drives behind."""
        asked = {each.slot for each in self.questions if each.text == BEHIND} - self.answers.keys()
        told = {f"who {quote.start}": self.told_rears(*pair) for quote, pair in self.inferred.items()}
        return {slot: self.actor(some[0]).name for slot, some in told.items() if slot in asked and len({*some}) == 1}

    @property
    def told(self) -> list[Sequence[st.Condition]]:
        """What is so together, as far as it was told: nothing that people alone would know."""
        return []

    def _it(self, chunk: Chunk, acts: bool, is_either: bool) -> int:
        if self.doer is not None:
            return self.doer
        named, last = list(dict.fromkeys(self.mentioned)), [] if self.subject is None else [self.subject]
        found = [*(each for each in last if each not in named), *named] if is_either else named or last
        if acts and EGO in found:  # which is driven by the policy under test
            found = [each for each in named if each != EGO] or [each.id for each in self.heroes] or found
        if not found:
            self.refuse("it is not clear who is meant", chunk.quote)
        return self._one_of([*found], "Who is 'it'?", len(found) - 1, chunk.quote) or 0

    def _one_of(self, people: list[int | None], asked: str, default: int | None, quote: st.Quote) -> int | None:
        """Return the one of some people, None for somebody new; several are asked about."""
        names = [NEW if each is None else self.actor(each).name for each in people]
        told = self.ask(f"who {quote.start}", asked, names, default, quote) if len(people) > 1 else ""
        return people[names.index(told)] if told else [None, *people][-1]

    def _named(self, chunk: Chunk) -> int:
        if chunk.kind != "actor":
            return self._called(chunk, chunk.value, chunk.traits[0].value if chunk.traits else "car")
        if chunk.value == "ego":
            self.known_by.setdefault(EGO, set()).update(chunk.text.lower().split())
            return self._called(chunk, "ego", "car")
        words = {each.text.lower() for each in chunk.traits if each.kind == "quality"}
        fitting = [each for each in self.heroes if self._fits(each, chunk, words)]
        if not chunk.is_new and any(each.kind == "other" for each in chunk.traits):  # not who was spoken of last
            fitting = [each for each in fitting if each.id != self.subject] or fitting
        same = [each for each in fitting if each.quote is not None and each.quote.text.lower() == chunk.text.lower()]
        fitting = [each for each in same if not self.known_by[each.id]] or fitting  # "the car" beside "a red car"
        fitting = [each for each in fitting if words and words <= self.known_by[each.id]] or fitting
        another = chunk.is_new and (bool(words & _FURTHER) or any(each.kind == "other" for each in chunk.traits))
        some: list[int | None] = [] if another else [each.id for each in fitting]
        if not some and not chunk.is_new and chunk.text.lower() in self.known_by.get(EGO, ()):
            some = [EGO, None]  # "our car ... the car": the ego, or another one?
        some += [None] * (chunk.is_new and bool(some))  # "a car ... a car"
        number = self._one_of(some, f"Who is '{chunk.text}'?", None, chunk.quote)
        if number is None:
            number = self._called(chunk, self._free_name(chunk.value, words), chunk.value)
        self.known_by.setdefault(number, set()).update(words, {chunk.value} if words & _MARKS else ())
        return number

    def _fits(self, actor: st.Actor, chunk: Chunk, words: set[str]) -> bool:
        """Whether a mention may mean somebody that is known: of its kind, or "the car" where there is only one."""
        kind = "car" if chunk.value == "hero" else chunk.value
        said = re.findall(r"\w+", self.text[: min(each.start for each in (chunk, *chunk.traits))].lower())[-1:]
        is_only = (len(self.heroes) == 1 and {*said} & {"the", "this", "that", "its"}) or chunk.words in _ANY_KIND
        general = chunk.value == "car" and (is_only or any(each.kind == "other" for each in chunk.traits))
        named = chunk.value in (actor.name, *self.known_by.get(actor.id, ()))
        named |= actor.kind == kind and chunk.value != "hero"
        strange = words - self.known_by.get(actor.id, set())
        differs = strange and (self.known_by.get(actor.id) or strange & _FURTHER)
        return (named or (general and not chunk.is_new)) and not differs

    def _free_name(self, name: str, words: set[str]) -> str:
        """Return a name that nobody has: that of its kind, with what describes it, with a number."""
        taken = {each.name for each in self.actors.values()}
        numerals = sorted(words & _MARKS)
        described = " ".join((*sorted(words - _MARKS), name, *numerals))
        numbered = (f"{described} {number}" for number in range(2, len(taken) + 3))
        return next(each for each in (*([] if numerals else [name]), described, *numbered) if each not in taken)

    def _called(self, chunk: Chunk, name: str, kind: str) -> int:
        for actor in self.actors.values():
            if actor.name == name:
                return actor.id
        number = EGO if name == "ego" and chunk.kind == "actor" else max(self.actors, default=0) + 1
        kind = "car" if kind in ("hero", "ego") else kind
        self.actors[number] = st.Actor(number, name, st.Way(), kind, (), chunk.quote)
        self.known_by.setdefault(number, set())
        return number

    @property
    def heroes(self) -> list[st.Actor]:
        """Everybody but the ego."""
        return [actor for number, actor in self.actors.items() if number != EGO]

    def actor(self, number: int) -> st.Actor:
        """Return somebody by number; the ego may not have been named yet."""
        if number not in self.actors:
            raise UnknownWordsError("the text does not say who is under test", fix="call it the ego")
        return self.actors[number]

    def tell_way(self, number: int, facts: Mapping[str, str], turns_then: bool = False) -> None:
        """Add facts of somebody's way; who went straight until then may turn at a moment."""
        actor = self.actor(number)
        way = replace(actor.way, turn=None) if turns_then and actor.way.turn == "straight" else actor.way
        for name, value in facts.items():
            if name == "then" or (name, value) == ("turn", "on"):
                continue
            whole = {"headings": tuple(value), "lanes": tuple(value.split(", "))}.get(name, value)
            if getattr(way, name) not in (None, (), whole):
                self.refuse(f"two things are said of the way of {actor.name}")
            fact: dict[str, Any] = {name: whole}
            way = replace(way, **fact)
        self.actors[number] = replace(actor, way=way)

    def relate(self, number: int, *relations: st.Relation) -> None:
        """Add how somebody's way lies to another's."""
        actor = self.actor(number)
        if any(each.of == number for each in relations):
            self.refuse("it is not clear whose way this is", relations[0].quote)
        self.actors[number] = replace(actor, relations=tuple(dict.fromkeys((*actor.relations, *relations))))

    def ask(self, slot: str, text: str, alternatives: list[str], default: int | None, quote: st.Quote) -> str:
        """Return the answer to a question; its default, or nothing, where it is noted as open."""
        answer = self.answers.get(slot, "")
        if answer in alternatives:
            return answer
        if all(each.slot != slot for each in self.questions):
            self.questions.append(st.Question(slot, text, tuple(alternatives), default, quote))
        return "" if default is None else alternatives[default]

    def is_first(self, slot: str, asked: str, ways: Sequence[str], quote: st.Quote, default: int = 0) -> bool:
        """Ask which of two ways the words of `quote` are meant: whether it is the first."""
        return self.ask(f"{slot} {quote.start}", f"{asked}: {quote.text}", [*ways], default, quote) == ways[0]

    @property
    def is_open(self) -> bool:
        """Whether something must be asked first, such as what a word means."""
        return any(each.default is None for each in self.questions)

    def known_words(self, chunks: Sequence[Chunk]) -> list[Chunk]:
        """Ask what unknown words mean: return the chunks with those that are answered."""
        known = list[Chunk]()
        for chunk in chunks:
            if chunk.kind == "share":  # what changes a number is never set aside
                self.refuse(f"'{chunk.text}' could not be understood here")
            if chunk.kind != "unknown":
                known.append(chunk)
                continue
            if not any(map(str.isalpha, chunk.text)):  # "20 ± 2 m": nobody is called so, and it may well say something
                self.refuse(f"'{chunk.text}' could not be understood here")
            meant = {f"it means '{word}'": word for word in nearest_words(chunk.text)}
            slot, asked = f"word {chunk.text.lower()}", f"What is '{chunk.text}'?"
            answer = self.ask(slot, asked, [*meant, CAR, ASIDE], None, chunk.quote)
            if answer in meant:
                known.append(word_as(chunk, meant[answer]))
            elif answer == CAR:
                known.append(replace(chunk, kind="name"))
        return known

    def refuse(self, message: str, quote: st.Quote | None = None, fix: str = OTHERWISE) -> NoReturn:
        """Raise the error that says what could not be read, of the sentence where nothing nearer is known."""
        raise UnknownWordsError(message, found=(quote or self.quote).text, fix=fix)
