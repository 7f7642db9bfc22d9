"""Tells whether an amount is told of the start: "at first", "begins 40 m before", "its initial distance".

What enters: words, amounts and deeds, and the moments of the amounts told before. What leaves: yes or no for an amount.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from scenewright.translate.gist.measured import Measured
from scenewright.translate.gist.subjects import RUNS
from scenewright.translate.gist.words import Clause, Deed, Words

Moment = Literal["start", "trigger", "deed", "open"]
_SET = ("released", "spawned", "initialised", "initialized", "dropped")
_SETS_OUT = ("set out", "sets out", "started out", "starts out", "has set out", "had set out")
# "its speed at the start of the test", "its starting speed"
FROM_START = re.compile(
    r"\b(?:at|from|in|since) (?:the |its )?(?:very )?(?:start|beginning|outset|commencement)\b|\bstarting (?:speed"
    r"|velocity)"
)
START_POINT = re.compile(r"\bstart(?:ing)? (?:point|position|place|spot|location)\b")


@dataclass(slots=True)
class Starts:
    """Knows what is told of the start of one text's story; `moments` is filled in by who asks."""

    words: Words
    measured: list[Measured]
    deeds: list[Deed]
    moments: dict[int, Moment]

    def holds(self, made: Measured) -> bool:
        """Whether an amount is told of the start: "at first", "begins 40 m before", "its initial distance"."""
        clause, words = made.clause, self.words
        told = words.span(clause).excerpt(words.text).lower()
        if "start" in clause.labels or words.has(clause.inside, "starting"):
            return True
        if words.where(clause.inside, "adverb", "initially") is not None:
            return True
        index = words.clauses.index(clause)
        if index and words.word(clause.start - 1) == "with" and self._opens(words.clauses[index - 1], clause):
            return True  # "The scenario opens with the ego 9 s from the intersection."
        where = next((at for at in range(made.at, clause.end) if words.word(at) == "where"), None)
        if where is not None and words.verbs(range(where, clause.end)) == {"begin"}:
            return True  # "80 m before the intersection is where the ego begins"
        if words.where(clause.inside, "aspect", "start") is not None or any(
            words.word(at) in _SET or (words.word(at) in ("set", "sets") and "up" in told.split())
            for at in clause.inside
        ):
            return True
        if words.word(clause.start) in ("place", "put", "start", "spawn", "position") and "sit" not in words.verbs(
            clause.inside
        ):
            return True  # "its starting position", "was released 80 m before it"
        for at in range(max(clause.start, made.at - 5), made.at):
            between = [
                i for i in range(at + 1, made.at) if "frame_noun" not in words.tags(i) and words.word(i) not in RUNS
            ]  # "starts the run 9 s from it"
            acts = any(d.clause is clause and d.at < made.at and d.kind in ("brake", "accelerate") for d in self.deeds)
            told_last = words.clauses[index - 1] if index else clause
            done = any(d.clause is told_last and d.kind in ("brake", "stop", "accelerate") for d in self.deeds)
            goes_on = done and told_last.sentence == clause.sentence and "ing" in words.tokens[at].forms
            if words.tag(at, "verb") == "begin" and goes_on:
                return False  # "it brakes to a halt, beginning 28 m before that point"
            if words.tag(at, "verb") == "begin" and not words.verbs(between) and not acts:
                return True
        if words.has(clause.inside, "measure", "landmark") and re.search(
            r"\bfirst (?:position|place|distance|spot|location)\b", told
        ):
            return True
        if "initial" in told or "speed at first" in told or START_POINT.search(told):
            return True
        if made.kind == "speed" and (FROM_START.search(told) or self._goes_on_with_speeds(made)):
            return True
        if any(words.word(at) in _SETS_OUT for at in range(clause.start, made.at)):
            return True  # "The ego set out 30 m short of the line"
        at = words.clauses.index(clause)
        before = words.clauses[at - 1] if at else None
        if before is None or before.sentence != clause.sentence:
            return False
        if "start" in before.labels and clause.link == "and" and not clause.named:
            return True  # "when the recording started it was 120 m before it and its speed was 55 km/h"
        opened = words.tag(before.start, "adverb") == "initially" and clause.link == "and" and not clause.named
        if opened and not any(d.clause.sentence == clause.sentence and d.kind in ("brake", "stop") for d in self.deeds):
            return True  # "At first the ego drives at 30 mph and is 8 s from it"
        alone = all(words.tag(i, "adverb") == "initially" or "determiner" in words.tags(i) for i in before.inside)
        plain = [i for i in range(clause.start, made.at) if "actor_adjective" not in words.tags(i)]
        verbless = not words.has(plain, "verb", "be")  # "and the lead vehicle 22 m from it"
        moving = words.verbs(plain) <= {"drive", "go", "come"} and "ing" in words.tokens[clause.start].forms
        verbless = verbless or (made.kind == "speed" and moving)  # "... 62 m from it and travelling at 12 m/s"
        told_before = [each for each in self.measured if each.clause is before and self.moments.get(each.at) == "start"]
        same = any(each.actor == made.actor for each in told_before) and clause.link == "and"
        verbless = verbless or (
            made.kind == "speed" and same and not words.verbs(plain) - {"drive", "go", "come", "make"}
        )
        earlier = bool(told_before)
        own = clause.named or made.kind == "speed" or words.verbs(before.inside) == {"begin"}
        return alone or (earlier and verbless and own and clause.link in ("and", "main"))

    def _goes_on_with_speeds(self, made: Measured) -> bool:
        """Whether this is the second of "The initial speeds are 36 km/h (ego) and 28 km/h (hero)"."""
        sentence = self.words.sentence(made.clause)
        told = [each for each in self.measured if each.clause in sentence and each is not made]
        alike = all(each.kind == "speed" and self.moments.get(each.at) == "start" for each in told)
        return bool(told) and alike and not self.words.verbs(range(told[-1].at, made.at))

    def _opens(self, before: Clause, clause: Clause) -> bool:
        """Whether nothing is said but "The test begins", "The scene opens"."""
        begins = self.words.who_begins(before)
        told = [self.words.word(at) for at in before.inside]
        verbs = {self.words.tag(at, "verb") for at in before.inside if self.words.word(at) not in RUNS} - {None}
        run = verbs == {"begin"} and bool(set(told) & {*RUNS, "this", "everything", "we", "i"})
        run = run and self.words.named(i for i in before.inside if told[0] not in ("we", "i")) is None
        if run and before.sentence == clause.sentence and not self.words.has(before.inside, "quantity"):
            return True  # "We begin each run with the ego 5 s from it", "All this starts with ..."
        own = begins is not None and self.words.has([begins], "frame_noun", "frame")
        return before.sentence == clause.sentence and own
