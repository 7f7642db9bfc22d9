"""Finds the trigger of a text that has no "when": "The ego gets to 12 m from the line. At that moment the van brakes".

What enters: words, deeds, the amounts whose moment no word decides. What leaves: those of them that are the trigger.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.measured import Measured
from scenewright.translate.gist.words import Clause, Deed, Words

_TRIGGERS = ("trigger", "triggers", "triggered", "triggering", "cue", "event", "signal", "condition")
_ACTS = ("brake", "accelerate", "stop")


@dataclass(slots=True)
class BareTriggers:
    """Finds it in one text.

    Attributes
    ----------
    opens
        Amounts whose moment is open, in the order of the text.
    started
        Whether it is said where the ego is at first.
    """

    words: Words
    deeds: Sequence[Deed]
    opens: list[Measured]
    started: bool

    def find(self) -> list[Measured]:
        """Return the amounts of the trigger; none where there is none."""
        gaps = [made for made in self.opens if made.kind in ("gap", "ttc")]
        if told := self._called():
            return told
        if len(gaps) == 1:
            return gaps
        if told := self._named() or self._come_there():
            return told
        then = next((each for each in self.words.clauses if each.link == "moment" or self._from_then_on(each)), None)
        if then is None:
            return self._before_a_colon() or self._just_before_the_deed()
        return list({made.actor: made for made in self.opens if made.at < then.start}.values())

    def _from_then_on(self, clause: Clause) -> bool:
        """Whether "From then on the van brakes" follows where both are."""
        link = self.words.word(clause.start - 1)
        told = link in ("from then on", "from there on", "from that moment on", "from that moment")
        acts = any(d.clause is clause and d.actor == HERO_ID and d.kind in _ACTS for d in self.deeds)
        return clause.link == "then" and told and acts

    def _called(self) -> list[Measured]:
        """Read "The AV is 3 s from the line, the van 3 s from the point. That is the trigger."."""
        for clause in self.words.clauses:
            near = [made for made in self.opens if 0 <= clause.sentence - made.clause.sentence <= 1]
            if "trigger" in clause.labels and not near:
                raise self.words.refuse("it is not known what this is", self.words.span(clause))
            this = self.words.word(clause.start) in ("this", "that") or self.words.word(clause.start - 1) in (
                "this",
                "that",
            )
            named = self.words.where(clause.inside, "label", "when") is not None or clause.link == "when"
            told = self.words.has(clause.inside, "quantity")
            before = [made for made in self.opens if self._just_before(made, clause)]
            if before and {made.actor for made in before} != {EGO_ID, HERO_ID} and before[0].kind == "place":
                earlier = [each for each in self.opens if each.clause.sentence == clause.sentence - 2]
                before = [*(each for each in earlier if each.actor != before[0].actor), *before]
            own = [each for each in self.opens if each.clause.sentence == clause.sentence and each.at < clause.start]
            if this and named and (own or before) and not told and len(clause.inside) <= 4:
                return own or before
            alone = self.words.word(clause.start) in ("this", "that") or "be" in self.words.tags(clause.start)
            if this and named and alone and not told and len(clause.inside) <= 4 and clause.link != "when":
                raise self.words.refuse("it is not known what this is", self.words.span(clause))
            if this and (own or before) and self._is_when(clause):
                return own or before
        return []

    def _just_before(self, made: Measured, clause: Clause) -> bool:
        """Whether an amount stands in the sentence before; a semicolon only parts one."""
        parted = (
            made.clause.sentence == clause.sentence - 2 and self.words.word(self.words.sentence_at(made.at).stop) == ";"
        )
        return made.clause.sentence == clause.sentence - 1 or parted

    def _is_when(self, clause: Clause) -> bool:
        """Whether this is the "That is" of "That is when the van brakes"."""
        following = next((each for each in self.words.clauses if each.start > clause.start), clause)
        acts = any(d.clause is following and d.actor == HERO_ID for d in self.deeds)
        told = self.words.has(following.inside, "quantity")
        alone = len(clause.inside) <= 2 and self.words.has(clause.inside, "be")
        return alone and following.link == "when" and following.start == clause.end + 1 and acts and not told

    def _named(self) -> list[Measured]:
        """Read "A pair of times is the trigger, namely 3 s for the ego and 2 s for the van to the conflict point"."""
        for made in self.opens:
            sentence = self.words.sentence_at(made.at)
            called = any(self.words.word(at).split()[-1] in _TRIGGERS for at in sentence if self.words.word(at))
            own = [each for each in self.opens if each.at in sentence]
            acts = any(d.at in sentence and d.actor == HERO_ID for d in self.deeds)
            both = {each.actor for each in own} == {EGO_ID, HERO_ID} and len(own) == 2
            if called and both and not acts and all(each.kind == "place" for each in own):
                return own
        return []

    def _come_there(self) -> list[Measured]:
        """Read "The AV gets to 25 ft from the line, the van is 60 ft from the point, and it just goes for it"."""
        for made in self.opens:
            sentence = self.words.sentence_at(made.at)
            comes = "reach" in self.words.verbs(range(made.clause.start, made.at)) and made.clause.link == "main"
            own = [each for each in self.opens if each.at in sentence and each.kind == "place"]
            acts = [d for d in self.deeds if d.at in sentence and d.actor == HERO_ID and d.kind in _ACTS]
            if comes and acts and acts[0].at > own[-1].at and made is own[0] and made.actor == EGO_ID:
                return own
        return []

    def _before_a_colon(self) -> list[Measured]:
        """Read "Ego 45 m from the conflict point: the car sets off" and "Cond: ego 12 m, van 30 m from it"."""
        if len({made.clause.sentence for made in self.opens}) != 1:
            return []
        colons = [each for each in self.words.sentence(self.opens[0].clause) if each.link == "colon"]
        after = any(each.start > self.opens[-1].at for each in colons)
        before = any(each.start <= self.opens[0].at for each in colons)
        both = {made.actor for made in self.opens} >= {EGO_ID, HERO_ID}
        return self.opens if after or (before and both) else []

    def _just_before_the_deed(self) -> list[Measured]:
        """Read "At first it is 9 s from it. ... The AV is 3 s from the line. The van is 5 s from the point. It brakes".

        Both have to be told where they are, last of all before the hero acts, and the ego where it was at first.
        """
        acts = [
            d for d in self.deeds if d.actor == HERO_ID and d.kind in (*_ACTS, "not_yield") and d.clause.link != "that"
        ]
        if not acts:
            return []
        told = [made for made in self.opens if made.at < acts[0].at][-2:]
        if {made.actor for made in told} != {EGO_ID, HERO_ID} or any(made.kind != "place" for made in told):
            return []
        sentences = [told[0].clause.sentence, told[1].clause.sentence, acts[0].clause.sentence]
        near = all(self._follows(here, then) for here, then in pairwise(sentences))
        comes = bool(self.words.verbs(range(told[0].clause.start, told[0].at)) & {"reach", "get_within"})
        earlier = any(made.actor == EGO_ID and made.at < told[0].at for made in self.opens)
        return told if near and (comes or earlier or self.started) else []

    def _follows(self, here: int, then: int) -> bool:
        """Whether nothing that is known stands between two sentences."""
        between = [each for each in self.words.clauses if here < each.sentence < then]
        return not any(each.named or self.words.has(each.inside, "quantity", "landmark", "verb") for each in between)
