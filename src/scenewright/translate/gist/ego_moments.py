"""Reads the moments of the ego that the hero is held against: "before it turns", "once it has passed the point".

What enters: words with clauses, the deeds found so far. What leaves: deeds of the ego, ``before``, ``after`` and
``let_reach``, each with the place on the ego's way that it means.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.clauses import BOUNDS
from scenewright.translate.gist.words import Clause, Deed, Words

_HARMLESS = ("much", "own", "anything", "initiation", "onset", "commencement", "'d", "\u2019d")


@dataclass(slots=True)
class EgoMoments:
    """Reads moments of the ego into the deeds of a text."""

    words: Words
    deeds: list[Deed]

    def is_perfect(self, clause: Clause) -> bool:
        """Whether something is over: "has passed"."""
        have = any(self.words.word(at) in ("we have", "i have") for at in clause.inside)
        return have or self.words.where(clause.inside, "auxiliary", "have") is not None

    def is_bound(self, clause: Clause) -> bool:
        """Whether a clause tells a moment of the ego: "before it turns", "by the time it does"."""
        verbs = self.words.verbs(clause.inside)
        by_then = self.words.word(clause.start - 1) == "by the time" and not self.words.has(clause.inside, "quantity")
        which = self.words.word(clause.start - 1) == "after which" and bool(verbs & {"begin", "turn", "pass"})
        return clause.link in BOUNDS or by_then or which or self._releases(clause)

    def is_after_hero(self, clause: Clause) -> bool:
        """Whether "after the van has passed" follows what the ego does only then."""
        index = self.words.clauses.index(clause)
        before = self.words.clauses[index - 1] if index else clause
        verbs = self.words.verbs(clause.inside) - ({"turn"} if self.words.has(clause.inside, "event_noun") else set())
        passed = verbs in ({"pass"}, {"complete"}, {"do_so"}) and clause.subject == HERO_ID and clause.named
        begins = self.words.verbs(before.inside) & {"begin", "turn", "pull_out", "pass", "reach", "enter"}
        own = before.subject == EGO_ID and before.sentence == clause.sentence
        last = {word for at in (before.end - 1, before.end) for word in self.words.word(at).split()}
        denied = self.words.has(before.inside, "negation")
        until = self.words.word(clause.start - 2) == "until"
        only = ("only" in last and not denied) or (denied and until)  # "does not begin until after the van has passed"
        told = self.words.has(clause.inside, "quantity") or self.words.has(before.inside, "quantity")
        after = clause.link == "after" and only
        not_before = clause.link in ("before", "until") and denied and self.is_perfect(clause)
        return (after or not_before) and passed and own and bool(begins) and not told

    def is_not_yet(self, clause: Clause) -> bool:
        """Whether "and the ego should not have started its turn by then" says that the hero was first."""
        passed = any(
            each.kind in ("pass", "complete") and each.actor == HERO_ID and each.clause.sentence == clause.sentence
            for each in self.deeds
        )
        own = clause.subject == EGO_ID and clause.named and self.words.has(clause.inside, "negation", "expected")
        words = {word for at in clause.inside for word in self.words.word(at).split()}
        told = self.words.has(clause.inside, "quantity")
        perfect = self.is_perfect(clause) and bool(self.words.verbs(clause.inside) & {"begin", "turn"})
        return passed and own and perfect and bool(words & {"not", "n't"}) and not told

    def is_next(self, clause: Clause) -> bool:
        """Whether "After that, the ego starts its turn" or "only after that" says that the hero has passed by then."""
        own = [each for each in self.deeds if each.actor == HERO_ID]
        passed = bool(own) and own[-1].kind in ("pass", "complete") and own[-1].clause.sentence >= clause.sentence - 1
        told = self.words.has(clause.inside, "quantity", "negation")
        closed = self.words.tag(clause.end, "link") == "then" and self.words.has([clause.end + 1], "end", "comma")
        named = clause.subject == EGO_ID and clause.named and passed and not told
        return named and (clause.link == "then" or closed) and self.next_place(clause) is not None

    def check_told_when(self, clause: Clause) -> None:
        """Refuse "and somehow do we start our turn" after the hero has passed: some order, not known which."""
        passed = any(each.kind in ("pass", "complete") and each.actor == HERO_ID for each in self.deeds)
        own = clause.subject == EGO_ID and clause.named and not self.words.has(clause.inside, "quantity", "negation")
        if passed and own and {"begin", "turn"} <= self.words.verbs(clause.inside):
            raise self.words.refuse("it is not clear when the ego does this", self.words.span(clause), "before, after")

    def next_place(self, clause: Clause) -> str | None:
        """Return what the ego does after the hero: it begins its turn, or passes the conflict point."""
        verbs = self.words.verbs(clause.inside)
        if "begin" in verbs and (verbs & {"turn"} or self.words.has(clause.inside, "event_noun")):
            return "turn_start"
        mark = self.words.where(clause.inside, "landmark", "conflict_point")
        there = [at for at in clause.inside if self.words.word(at) in ("it", "there", "that point", "the same point")]
        if mark is None and there and self.words.referred(there[-1]) == "conflict_point":
            mark = there[-1]  # "and only after that does the ego get to it"
        return "conflict_point" if verbs & {"pass", "reach"} and mark is not None else None

    def is_allowed(self, clause: Clause) -> bool:
        """Whether the ego is let go in a sentence of its own: "The ego is allowed to complete its turn. Then ..."."""
        allowed = any("allowed" in self.words.word(at).split() for at in clause.inside)
        done = self.words.verbs(clause.inside) & {"complete", "pass"}
        return allowed and clause.subject == EGO_ID and clause.named and bool(done)

    def _releases(self, clause: Clause) -> bool:
        """Whether "once the ego has completed its turn" is a moment of the ego that the hero waits for."""
        done = self.words.verbs(clause.inside) & {"complete", "pass"}
        told = self.words.has(clause.inside, "quantity")
        of_ego = clause.link == "when" and clause.subject == EGO_ID
        return of_ego and self.is_perfect(clause) and bool(done) and not told

    def read(self, clause: Clause) -> bool:
        """Read "before the ego begins to turn", "until it has passed the conflict point", "before us"."""
        verbs = self.words.verbs(clause.inside)
        if clause.subject != EGO_ID or (not clause.named and verbs & {"brake", "stop", "accelerate", "wait"}):
            return False
        known = {
            "do_so",
            "begin",
            "turn",
            "pull_out",
            "complete",
            "pass",
            "reach",
            "enter",
            "go",
            "make",
            "come",
            "drive",
            "cut_in_front",
        }
        yet = any("yet" in self.words.word(at).split() for at in clause.inside)
        if (
            verbs - known
            or (self.words.has(clause.inside, "negation") and not yet)
            or (self.words.has(clause.inside, "stop_noun"))
        ):
            raise self.words.refuse("this is no moment of the ego that can be compared", self.words.span(clause))
        if (strange := self._strange(clause)) is not None:
            raise self.words.refuse(
                "it is not clear which moment of the ego this is", self.words.tokens[strange].span, "a known place"
            )
        if clause.link == "until" and self.words.word(clause.start - 2) == "not":
            self.words.used.add(clause.start - 2)  # "not until the ego has passed does it move"
        first = clause.link == "before" or self.words.word(clause.start - 1) in ("by the time", "after which")
        kind = "before" if first else "let_reach" if clause.link == "let" else "after"
        self.words.used |= set(range(clause.start - 1, clause.end))
        span = self.words.span(clause)
        self.deeds.append(Deed(kind, clause.start, clause, span, self.place(clause, verbs), EGO_ID))
        return True

    def _strange(self, clause: Clause) -> int | None:
        """Return where something stands that is not known: "before the ego passes the bus shelter"."""
        words = self.words
        for at in clause.inside:
            free = "unknown" in words.tags(at) and at not in words.names.actors and not words.word(at).endswith("ly")
            beside = at + 1 in words.names.actors or words.has([at + 1], "unknown", "landmark", "event_noun")
            if free and not beside and words.word(at) not in _HARMLESS:
                return at
        return None

    def _names_turn(self, clause: Clause, verbs: set[str]) -> bool:
        noun = self.words.where(clause.inside, "event_noun", "turn") is not None
        ours = self.words.word(clause.end - 1) in ("ours", "mine", "its own") and any(
            d.kind == "complete" for d in self.deeds
        )
        return (
            noun or ours or bool(verbs & {"turn", "pull_out"}) or "own" in " ".join(map(self.words.word, clause.inside))
        )

    def place(self, clause: Clause, verbs: set[str]) -> str:
        """Return the place on the ego's way that a moment means; ``same`` for that of the hero."""
        mark = self.words.where(clause.inside, "landmark")
        if "complete" in verbs:
            return "turn_end"
        if "enter" in verbs and mark is None and self.words.where(clause.inside, "event_noun", "turn") is not None:
            return "turn_start"  # "before the ego goes into its turn"
        turns = (
            verbs & {"turn", "pull_out", "begin"} or self.words.where(clause.inside, "event_noun", "turn") is not None
        )
        own = "turn" in verbs or self.words.where(clause.inside, "event_noun", "turn") is not None
        if {"begin", "turn", "pass"} <= verbs:
            raise self.words.refuse("it is not clear which moment of the ego this is", self.words.span(clause))
        if "begin" in verbs and "reach" in verbs and mark is None and own:
            return "turn_start"  # "before the ego gets to begin its turn"
        if (
            "begin" in verbs
            and "turn" not in verbs
            and own
            and mark is not None
            and not self.words.has([mark - 1, mark - 2], "preposition")
        ):
            raise self.words.refuse("it is not clear which moment of the ego this is", self.words.span(clause))
        strange = any("unknown" in self.words.tags(at) for at in clause.inside) or self.words.has(clause.inside, "area")
        if "enter" in verbs and mark is None and strange:
            raise self.words.refuse("it is not clear which moment of the ego this is", self.words.span(clause))
        if verbs & {"pass", "reach", "enter"} or (mark is not None and "turn" not in verbs):
            return self.words.tags(mark)["landmark"] if mark is not None else "conflict_point"
        if turns and not self._names_turn(clause, verbs):
            raise self.words.refuse("it is not said what the ego begins", self.words.span(clause))
        if turns:
            yet = any("yet" in self.words.word(at).split() for at in clause.inside)
            return "turn_end" if self.is_perfect(clause) and "begin" not in verbs and not yet else "turn_start"
        return "conflict_point" if self.words.has(clause.inside, "back_reference", "mark_noun") else "same"
