"""Changes good texts: into others that mean the same, that mean something else, or that have to be refused.

What enters: an example, and `changes.toml`. What leaves: another example. Without it the network believes every text
that looks like a scenario, and sees no single word.
"""

from __future__ import annotations

import itertools
import random
import re
from dataclasses import dataclass, field, replace
from typing import Any

from lessons import PIECES, WAYS, Example, Lesson

from scenewright.translate.learned.pieces import cut

RENAMED, CLAIMED = 0.15, 0.08  # of the texts


@dataclass
class Changer:
    """Makes of a good text one with other names in it or with a claim that fits, or one that has to be refused."""

    changes: dict[str, Any]
    lesson: Lesson
    chance: random.Random
    vocabulary: dict[str, int] = field(init=False)
    pieces: dict[str, list[int]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self.vocabulary = {piece: at for at, piece in enumerate(self.lesson.vocabulary)}

    def better(self, good: Example) -> Example:
        """Return it with other names, or with a claim that fits, or as it is."""
        kind = self.chance.random()
        if kind < RENAMED:
            return self._renamed(good)
        if kind < RENAMED + CLAIMED and good.sayable:
            claims, _ = self._claims(good)
            # At either end: between two sentences it would change whom "it" means.
            at = self.chance.choice([1, len(good.numbers) - 1])
            return self._inserted(good, at, self._cut(self.chance.choice(claims))) if claims else good
        return good

    def worse(self, good: Example) -> Example | None:
        """Return it with something in it that no program can say or that contradicts it, or without its trigger."""
        stops = self._stops(good)
        kind = self.chance.random()
        if not stops or not good.sayable:
            return None
        if kind < 0.25:
            changed: Example | None = self._put_in(good, self.chance.choice(self.changes["sentences"]))
        elif kind < 0.5:
            at = self.chance.choice(stops)
            changed = self._inserted(good, at, self._cut(self.chance.choice(self.changes["tails"])))
        elif kind < 0.6:
            changed = self._without_trigger(good, stops)
        elif kind < 0.75:
            changed = self._without_amount(good)
        else:
            _, claims = self._claims(good)
            changed = self._put_in(good, self.chance.choice(claims)) if claims else None
        return None if changed is None else Example(good.id, changed.numbers)

    def other(self, good: Example) -> Example | None:
        """Return it with one word exchanged for another on which its meaning hangs: it does not mean the same."""
        if not good.sayable:
            return None
        found = []
        for said, instead in self.changes["exchanged"]:
            if {said, instead} == {"ego", "hero"} and good.ego == good.hero:
                continue  # one behind the other: whose way is told does not matter
            one, other = self._cut(said), self._cut(instead)
            starts = (at for at in range(1, len(good.numbers) - len(one)) if good.numbers[at : at + len(one)] == one)
            found.append([(at, one, other) for at in starts if not self._names_a_place(good, at)])
        found = [each for each in found if each]
        if not found:
            return None
        at, one, other = self.chance.choice(self.chance.choice(found))
        more = len(other) - len(one)
        numbers = good.numbers[:at] + other + good.numbers[at + len(one) :]
        if len(numbers) > PIECES:
            return None
        return replace(good, numbers=numbers, marks=[mark + more * (mark > at) for mark in good.marks], denied=True)

    def _names_a_place(self, text: Example, at: int) -> bool:
        """Whether it is the road of "side road", which is the same place as the driveway."""
        return text.numbers[at - 1] in {self.vocabulary[word] for word in ("side", "access", "exit", "minor")}

    def _cut(self, said: str) -> list[int]:
        if said not in self.pieces:
            self.pieces[said] = list(cut(said, [], self.vocabulary).numbers[1:-1])
        return self.pieces[said]

    def _stops(self, text: Example) -> list[int]:
        return [at for at, number in enumerate(text.numbers) if number == self.vocabulary["."] and at > 8]

    def _put_in(self, text: Example, sentence: str) -> Example:
        """Put a sentence before the text or after one of its sentences."""
        at = self.chance.choice([0, *self._stops(text)]) + 1
        return self._inserted(text, at, self._cut(sentence))

    def _inserted(self, text: Example, at: int, more: list[int]) -> Example:
        if len(text.numbers) + len(more) > PIECES:
            return text
        numbers = text.numbers[:at] + more + text.numbers[at:]
        return replace(text, numbers=numbers, marks=[mark + len(more) * (mark >= at) for mark in text.marks])

    def _claims(self, text: Example) -> tuple[list[str], list[str]]:
        """Return claims that fit a text, and claims that contradict it."""
        right, wrong = [], []
        if not {self.vocabulary["ego"], self.vocabulary["hero"]} <= set(text.numbers):
            return right, wrong  # they have other names
        stories = self.changes["stories"]
        if kind := story_kind(self.lesson.stories[text.story]):
            right += stories[kind]["said"]
            wrong += [said for other in stories[kind]["never"] for said in stories[other]["said"]]
        for who, way in (("ego", text.ego), ("hero", text.hero)):
            for written, said in self.changes["ways"].items():
                named = [each.replace("WHO", who) for each in said]
                (right if written == ", ".join(WAYS[way]) else wrong).extend(named)
        return right, wrong

    def _renamed(self, text: Example) -> Example:
        names = {who: self._cut(self.chance.choice(self.changes[f"{who}_names"])) for who in ("ego", "hero")}
        others = {self.vocabulary[who]: instead for who, instead in names.items()}
        if not set(others) <= set(text.numbers):
            return text
        each = [others.get(number, [number]) for number in text.numbers]
        if sum(map(len, each)) > PIECES:
            return text
        starts = list(itertools.accumulate((len(number) for number in each), initial=0))
        return replace(
            text, numbers=[n for number in each for n in number], marks=[starts[mark] for mark in text.marks]
        )

    def _without_amount(self, text: Example) -> Example | None:
        mark = self.chance.choice(text.marks)
        instead = self._cut(self.chance.choice(self.changes["no_amounts"]))
        return replace(text, numbers=text.numbers[:mark] + instead + text.numbers[mark + 1 :])

    def _without_trigger(self, text: Example, stops: list[int]) -> Example | None:
        parts = self.lesson.parts
        when = {mark for mark, each in zip(text.marks, text.parts, strict=True) if any("t1)" in parts[p] for p in each)}
        sentences = list(zip([0, *stops], [*stops, len(text.numbers) - 1], strict=True))
        told = [(a, b) for a, b in sentences if any(a < mark <= b for mark in when)]
        if len(told) != 1 or len(sentences) < 3:
            return None
        a, b = told[0]
        return replace(text, numbers=text.numbers[: a + 1] + text.numbers[b + 1 :])


def story_kind(story: tuple[str, ...]) -> str | None:
    """Return what a story is in sum, as `changes.toml` calls it."""
    sketch, order = story[0], [each for each in story if re.match(r"A1\(t\d\) [<>] A0", each)]
    if "stop, t3, acc" in sketch and order:
        return "stops_and_goes_first" if "<" in order[0] else "lets_ego"
    if sketch.endswith("dec, t2") and not order and "A1v(t2) == 0" in story:
        return "stops"
    return "first" if order and "<" in order[0] and "dec" not in sketch else None
