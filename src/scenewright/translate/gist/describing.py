"""Tells deeds from what only describes: "a slow car", "goes west", "needs 3 s to reach the line", "the ego passes by".

What enters: words with clauses, and where a verb stands. What leaves: whether it tells nothing that happens.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import EGO_ID
from scenewright.translate.gist.words import Clause, Words

TURNS = ("turn", "pull_out")


@dataclass(slots=True)
class Describing:
    """Answers for one text whether a verb tells a deed."""

    words: Words

    def only_describes(self, verb: str, at: int, clause: Clause) -> bool:
        """Whether a verb tells no deed here: "a slow car", "goes west", "needs 3 s to reach the line", "its turn"."""
        token, words = self.words.tokens[at], self.words
        if at + 1 in words.names.actors and ("actor_adjective" in token.tags or "ing" in token.forms):
            return True
        if verb in TURNS and self._is_meant(at):
            return True  # "The hero was about to turn left", told after what it did
        if verb in TURNS and (self.is_noun(at) or self._is_on_its_way(at, clause) or self._is_predicate(at, clause)):
            return True
        if verb in ("go", "drive", "keep") and (self._tells_way(at, clause) or self._leads_on(at, clause)):
            return True
        if verb == "wait" and clause.subject == EGO_ID and words.word(at + 1) == "to":
            return True  # "the ego, which is waiting to turn left"
        ways = ("way", "road", "path", "junction", "lane")
        if words.word(at) == "clear" and words.word(at - 1).split()[-1:] and words.word(at - 1).split()[-1] in ways:
            return True  # "leaving the way clear"
        first = at == clause.start and (not at or words.has([at - 1], "end"))
        if first and token.forms == {"base"} and words.tag(at + 1, "preposition") == "for":
            return True  # "Race for the driveway:"
        if (
            verb == "pass"
            and "ing" in token.forms
            and words.has([at - 1], "determiner")
            and words.has([at + 1], "unknown")
        ):
            return True  # "a crossing conflict"
        past = words.where(range(at + 1, at + 3), "area", "driveway") is not None
        if verb == "pass" and past and clause.subject == EGO_ID:
            return True  # "the ego passes the driveway, driving east along the road"
        path = words.where(range(at + 1, at + 4), "area", "lane") is not None
        if verb == "pass" and path and clause.subject == EGO_ID:
            return True  # "the ego has to cross the path of a lorry"
        by = verb == "pass" and words.tag(at + 1, "preposition") in ("by", "on")
        by = by or (verb == "pass" and words.has([at + 1, at + 2], "landmark") and self._is_crossed(at))
        beside = at + 1 + words.has([at + 1], "comma")
        by = by or (verb == "pass" and "heading" in words.tags(beside))  # "is passing through eastbound"
        if (by or words.word(at).endswith(" by")) and clause.subject == EGO_ID:
            return True  # "the ego, meanwhile, is passing by on the road"
        if verb in ("yield", "not_yield") and "ing" in token.forms and words.has([at - 1], "determiner"):
            return True  # "the yielding set"
        will = words.has(range(at - 2, at), "auxiliary", "wanting")
        into = words.has(range(at + 1, min(at + 4, clause.end)), "area")
        if verb == "enter" and will and clause.subject == EGO_ID:
            return True  # "the driveway that the ego is to enter"
        if verb == "enter" and into and (will or clause.both or clause.subject == EGO_ID):
            return True  # "both are going to enter the driveway"
        if "left_over" in token.tags and words.has(range(at - 2, at), "quantity"):
            return True  # "6 m remain"
        if verb == "reach":
            state = clause.subject == EGO_ID or self.landmark(at, clause) is None
            amount = next((i for i in range(at - 1, at - 6, -1) if "quantity" in words.tags(i)), at)
            return state or any(words.word(i) in ("to", "from", "before") for i in range(amount, at))
        return False

    def _is_on_its_way(self, at: int, clause: Clause) -> bool:
        """Whether a turn is what a vehicle comes for: "a bus, coming eastbound to turn left into the driveway"."""
        ways = ("come", "drive", "approach", "go", "pull_out", "leave")
        last = next((i for i in range(at - 2, clause.start - 1, -1) if "verb" in self.words.tags(i)), None)
        comes = last is not None and self.words.tag(last, "verb") in ways and "ing" in self.words.tokens[last].forms
        return self.words.word(at - 1) == "to" and comes

    def _is_meant(self, at: int) -> bool:
        """Whether a turn is what a vehicle was about to make."""
        about = self.words.word(at - 1) in ("was about to", "were about to", "is about to", "are about to")
        about = about or self.words.word(at - 1) == "would"
        was = self.words.word(at - 1) == "to" and self.words.word(at - 2) in ("was", "were", "was going", "were going")
        wanted = self.words.word(at - 1) == "to" and self.words.word(at - 2) in ("wanted", "meant", "intended")
        return about or was or wanted

    def _is_predicate(self, at: int, clause: Clause) -> bool:
        """Whether a turn tells which vehicle it is: "the hero is a car coming out of the driveway"."""
        name = at - 1
        first = self.words.skip(name - 1, frozenset(("actor_adjective", "heading", "determiner")), -1)
        named = name in self.words.names.actors and "ing" in self.words.tokens[at].forms
        return named and first > clause.start and "be" in self.words.tags(first)

    def _is_crossed(self, at: int) -> bool:
        """Whether this is "crosses the T-junction straight ahead"."""
        mark = next((i for i in (at + 1, at + 2) if "landmark" in self.words.tags(i)), at)
        crossed = self.words.tag(mark, "landmark") == "intersection" and "direction" in self.words.tags(mark + 1)
        if crossed:
            self.words.used.add(mark)
        return crossed

    def _leads_on(self, at: int, clause: Clause) -> bool:
        """Whether this is "proceeds to slow down"."""
        return self.words.word(at + 1) == "to" and at + 2 < clause.end and "verb" in self.words.tags(at + 2)

    def is_noun(self, at: int) -> bool:
        """Whether this is "the turn", of which another verb tells more: "completes its turn"."""
        before = self.words.tags(at - 1)
        named = before.keys() & {"determiner", "possessive", "direction", "genitive"} and "verb" not in before
        joint = next((i for i in range(at - 1, at - 5, -1) if self.words.has([i], "link", "frame_link")), at - 5)
        return bool(named) and "begin" not in self.words.verbs(range(joint + 1, at))

    def _tells_way(self, at: int, clause: Clause) -> bool:
        for ahead in range(at + 1, min(at + 5, clause.end)):
            if self.words.has([ahead], "heading", "direction") or self.words.tag(ahead, "area") in ("road", "driveway"):
                return True
            if self.words.has([ahead], "quantity", "landmark"):
                return False
        return False

    def is_done(self, at: int) -> bool:
        """Whether this is "gets its whole turn done"."""
        back = at - 1
        while "unknown" in self.words.tags(back) or "direction" in self.words.tags(back):
            back -= 1
        ahead = at + 1
        while self.words.has([ahead], "be", "auxiliary") or self.words.word(ahead) == "to":
            ahead += 1  # "the taxi's turn is to be over"
        done = {self.words.word(at + 1), self.words.word(at + 2), self.words.word(ahead)} & {
            "done",
            "finished",
            "behind it",
            "behind them",
            "behind him",
            "behind her",
            "over",
            "is over",
        }
        behind = self.words.word(at + 1) == "behind" and self.words.word(at + 2) in ("it", "them", "him", "her")
        has = self.words.word(back - 1) in ("has", "have", "gets", "get", "had", "got", "having", "getting")
        owned = self.words.has([back], "possessive", "genitive") or (has and "determiner" in self.words.tags(back))
        return owned and (bool(done) or behind)

    def landmark(self, at: int, clause: Clause) -> str | None:
        """Return what a deed is done to: the place after it, or before it in "the point is passed by the van"."""
        for ahead in range(at + 1, clause.end):
            if "landmark" in self.words.tags(ahead):
                return self._use(ahead)
            if self.words.has([ahead], "back_reference", "mark_noun"):
                return self.words.referred(ahead)
            if "quantity" in self.words.tags(ahead):
                return None
        before = range(clause.start, at)
        back = self.words.where(before, "landmark") if self.words.has(before, "be") else None
        return self._use(back) if back is not None else None

    def _use(self, at: int) -> str:
        self.words.used.add(at)
        return self.words.tags(at)["landmark"]
