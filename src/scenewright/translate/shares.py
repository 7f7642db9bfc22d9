"""Reads amounts that are dealt out to both vehicles: "with 25 m left for the ego and 35 m for the hero, each to it".

What enters: the reader's state where a moment is told. What leaves: one event for each vehicle with its own place. A
list that does not give each vehicle one amount and one place is not read here.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

from scenewright.translate.events import Place, Relation
from scenewright.translate.measures import MeasureReader
from scenewright.translate.tokens import Quantity

_DEALS = ("for", "to", "of", "by")
_KEPT = ("behind", "ahead", "past")


@dataclass(frozen=True, slots=True)
class Aim:
    """Where an amount is measured to: a landmark, on which side of it, and the position after it."""

    target: str
    relation: Relation
    end: int
    of_whom: int | None = None


@dataclass(frozen=True, slots=True)
class Share:
    """One vehicle's amount as far as it was read."""

    actor: int
    amount: Quantity
    aim: Aim | None
    end: int
    dealt: bool  # the amount comes first: "25 m for the ego"


@dataclass(slots=True)
class ShareReader(MeasureReader):
    """Reads lists of amounts."""

    def _shares(self) -> bool:
        """Read "at 2 s for the ego and 2.8 s for the hero, both with respect to the conflict point"."""
        at, told = self.at, "when" in self.links or self.label == "when"
        deals = self.phrases.tag(at, "preposition") in ("at", "with") or self.phrases.tokens[at].text.lower() == "with"
        begun = at + (self.phrases.tag(at, "determiner") is not None)
        at = begun if self.phrases.tag(begun, "starting") is not None else at  # "The initial distances ... are"
        starts = "initial" in self.flags or self.phrases.tag(at, "starting") is not None
        if not (told or deals or starts) or self.subject_span is not None:
            return False
        at += self.phrases.tag(at, "starting") is not None
        if not deals and self.current is not None and not self.links:
            return False
        at += deals
        bracket = self.phrases.tokens[at].text == "("
        kept = self._remembered()
        noted = deals or bracket or self.label == "when" or self._says_at(at)
        found = self._listed(at + bracket, plain=noted)
        if found is None or (bracket and self.phrases.tokens[found[1]].text != ")"):
            self._recall(kept)
            return False
        shares, end = found
        if starts:
            self.flags.add("initial")
        self._deal(shares, end + bracket, trailing=self.current is not None and not self.links and deals)
        return True

    def _remembered(self) -> tuple[object, ...]:
        """Return what naming a vehicle or a place changes, so that a list that does not end as one leaves no trace."""
        phrases = self.phrases
        nouns = {actor: set(names) for actor, names in phrases.refs.nouns.items()}
        lists = len(phrases.described), len(phrases.assumptions)
        return nouns, phrases.refs.by_indefinite, phrases.last_landmark, phrases.last_named, lists

    def _recall(self, kept: tuple[object, ...]) -> None:
        phrases = self.phrases
        nouns, by_indefinite, landmark, named, lists = kept
        phrases.refs.nouns = cast("dict[int, set[str]]", nouns)
        phrases.refs.by_indefinite = bool(by_indefinite)
        phrases.last_landmark = cast("str | None", landmark)
        phrases.last_named = cast("tuple[int, int] | None", named)
        described, assumed = cast("tuple[int, int]", lists)
        del phrases.described[described:], phrases.assumptions[assumed:]

    def _deal(self, shares: list[Share], end: int, *, trailing: bool) -> None:
        """Give each vehicle an event with its place; after a verb the clause goes on with who was spoken of."""
        start, spoken_of = self.at, self.subject
        self.links = [link for link in self.links if link != "comma"]
        initial = "initial" in self.flags
        self.links += [] if "when" in self.links or initial else ["when"]
        for share in shares:
            assert share.aim is not None
            self._set_subject(share.actor, None)
            self.at = start
            event = self._open("be", start)
            event.initial = initial
            span = self.phrases.span(start, end)
            event.places.append(Place(share.aim.relation, share.aim.target, share.amount, span, share.aim.of_whom))
            self.at = end
            self._grow()
            self.links = ["and"]
        self.links = []
        self.measured_last = len(self.events)
        if trailing and spoken_of is not None:
            self._set_subject(spoken_of, None)

    # -- reading ----------------------------------------------------------------------------------------------------
    def _listed(self, at: int, *, plain: bool) -> tuple[list[Share], int] | None:
        """Read a list of two shares with the place before, inside or after it."""
        head, at, order = self._share_head(at)
        if not order and self._says_respectively(at):
            return None
        shares: list[Share] = []
        while len(shares) < 2:
            share = self._share(at, order[len(shares)] if order else None)
            if share is None:
                return None
            shares.append(share)
            at = share.end
            if len(shares) < 2:
                at = self._next_share(at)
        if shares[0].actor == shares[1].actor or shares[0].amount.dimension != shares[1].amount.dimension:
            return None
        if (told := self._tails(at, shares)) is not None:
            return told
        tail = self._tail(at)
        first = shares[0].aim if all(share.dealt for share in shares) else None
        shared = head or tail or shares[1].aim or first
        own = shares[0].aim is not None and shares[1].aim is not None
        apart = shared is not None and (shared.target == "stop_line" or shared.of_whom is not None)
        if shared is None or (not own and apart and not self._both_in_driveway()):
            return None  # each vehicle has a stop line of its own, or none
        if not (head or order or any(share.dealt for share in shares)) and (own or not plain):
            return None  # "the ego is 12 m from the stop line and ...": read clause by clause
        if own and (tail or head):
            return None
        ended = tail.end if tail else at
        return [replace(share, aim=share.aim or shared) for share in shares], ended

    def _says_at(self, at: int) -> bool:
        """Whether a vehicle stands at an amount without a verb: "once ego at 40 m and van at 12 m to it"."""
        phrase = self.phrases.noun_phrase(at)
        named = phrase is not None and phrase.kind != "pronoun" and self.phrases.tag(phrase.end, "preposition") == "at"
        return phrase is not None and named and self.phrases.tokens[phrase.end + 1].quantity is not None

    def _share_head(self, at: int) -> tuple[Aim | None, int, list[int]]:
        """Read "their distances to the conflict point are" and "the distances of the ego and the hero to it are"."""
        start = at
        at += self.phrases.tag(at, "possessive") is not None or self.phrases.tag(at, "determiner") is not None
        if self.phrases.tag(at, "pair") and self.phrases.tag(at + 1, "genitive") is not None:
            at += 2
        several = self.phrases.tag(at, "measures")
        if several is None and self.phrases.tag(at, "measure") not in ("length", "time"):
            return None, start, []
        at += 1
        order: list[int] = []
        if several and self.phrases.tag(at, "preposition") in ("of", "out", "for", "between"):
            names = self._names(at + 1)
            order, at = names or ([], at)
        aim = self._aim(at)
        at = aim.end if aim else at
        is_told = self.phrases.tokens[at].tags.keys() & {"be", "colon"} and (
            self.phrases.tokens[self.phrases.skip_hedges(at + 1)].quantity is not None
        )
        if aim is None and not order and not is_told and not (several and self.phrases.tag(at, "preposition") == "of"):
            return None, start, []
        at += self.phrases.tag(at, "auxiliary") is not None
        if (
            self.phrases.tokens[at].tags.keys() & {"be", "falls", "colon"}
            or self.phrases.tag(at, "preposition") == "of"
        ):
            at += 1
        return aim, at, order

    def _names(self, at: int) -> tuple[list[int], int] | None:
        first = self.phrases.noun_phrase(at)
        if first is None or first.kind == "pronoun" or self.phrases.tag(first.end, "link") != "and":
            return None
        second = self.phrases.noun_phrase(first.end + 1)
        if second is None or second.kind == "pronoun":
            return None
        return [self.phrases.resolve(first), self.phrases.resolve(second)], second.end

    def _next_share(self, at: int) -> int:
        at += self.phrases.tag(at, "comma") is not None
        at += self.phrases.tag(at, "link") == "and" or self.phrases.tokens[at].text.lower() == "with"
        return at

    def _share(self, at: int, whose: int | None) -> Share | None:
        """Read "35 m left for the hero", "the hero at 35 m", "35 m (hero to the conflict point)"."""
        start = at
        at += self.phrases.tag(at, "preposition") in ("of", "at")
        if (amount := self._share_amount(at)) is not None:
            return self._amount_first(amount[0], amount[1], whose)
        named = self._share_actor(start)
        if named is None:
            return None
        actor, at = named
        at += self.phrases.tag(at, "comma") is not None and self.phrases.tokens[at].text != "("
        at += self.phrases.tag(at, "measure") in ("length", "time") and self.phrases.tokens[at + 1].quantity is not None
        at += bool(self.phrases.tokens[at].tags.keys() & {"be"}) or self.phrases.tag(at, "auxiliary") == "have"
        at += self.phrases.tag(at, "preposition") == "at"
        amount = self._share_amount(at)
        if amount is None:
            return None
        aim = self._aim(amount[1], actor)
        return Share(actor, amount[0], aim, aim.end if aim else amount[1], dealt=False)

    def _amount_first(self, amount: Quantity, at: int, whose: int | None) -> Share | None:
        if whose is not None:
            return Share(whose, amount, None, at, dealt=True)
        before = self._aim(at)
        at = before.end if before else at
        bracket = self.phrases.tokens[at].text == "("
        if not bracket and self.phrases.tag(at, "preposition") not in _DEALS and self.phrases.tag(at, "link") != "to":
            return None
        named = self._share_actor(at + 1)
        if named is None:
            return None
        actor, at = named
        after = self._aim(at, actor) if before is None else None
        if before is not None and before.of_whom not in (None, actor):
            return None
        at = after.end if after else at
        if bracket:
            if self.phrases.tokens[at].text != ")":
                return None
            at += 1
        if bracket and before is None and after is None:
            after = self._aim(at, actor)
            shared_later = after is not None and self.phrases.tag(self._next_share(after.end), "quantity") is None
            after = None if shared_later else after
            at = after.end if after else at
        return Share(actor, amount, before or after, at, dealt=True)

    def _share_amount(self, at: int) -> tuple[Quantity, int] | None:
        """Read "25 m", "a distance of 25 m", "25 m left"; the amount and the position after it."""
        measured = self.phrases.measured(at)
        if measured is not None and measured[0] in ("length", "time"):
            amount, at = measured[1], measured[2]
        else:
            at = self.phrases.skip_hedges(at)
            quantity = self.phrases.tokens[at].quantity
            if quantity is None or quantity.dimension not in ("length", "time"):
                return None
            amount, at = quantity, at + 1
            at += self.phrases.tag(at, "measure") in ("length", "time")  # "2 s TTA"
        if self.phrases.tokens[at].text.lower() == "to" and self.phrases.tokens[at + 1].text.lower() == "go":
            return amount, at + 2
        at += self.phrases.tag(at, "be") is not None and self.phrases.tag(at + 1, "left_over") is not None
        if self.phrases.tag(at, "left_over") and self._aim(at) is None:
            at += 1
        return amount, at

    def _share_actor(self, at: int) -> tuple[int, int] | None:
        phrase = self.phrases.noun_phrase(at)
        if phrase is None or self.phrases.tag(phrase.end, "genitive") is not None:
            return None
        if phrase.kind == "pronoun":
            return None if self.subject is None else (self.subject, phrase.end)
        end = phrase.end + (self.phrases.tokens[phrase.end].text.lower() in ("itself", "himself", "herself"))
        return self.phrases.resolve(phrase), end

    def _aim(self, at: int, whose: int | None = None) -> Aim | None:
        """Read "to the conflict point", "from its stop line", "short of it" where a landmark is named."""
        if self.phrases.tokens[at].text == "(":
            inner = self._aim(at + 1, whose)
            closed = inner is not None and self.phrases.tokens[inner.end].text == ")"
            return replace(inner, end=inner.end + 1) if inner is not None and closed else None
        relation, preposition = self.phrases.tag(at, "relation"), self.phrases.tag(at, "preposition")
        link = self.phrases.tag(at, "link")
        aims = relation or preposition in ("to", "at", "out", "of") or link in ("to", "until", "before")
        if not aims:
            return None
        at += 1 + (relation is not None and self.phrases.tag(at + 1, "relation") == "from")
        subject, last = self.phrases.subject, self.phrases.last_landmark
        if whose is not None:
            self.phrases.subject = whose
        if self.phrases.tag(at, "possessive") and self.phrases.subject is None:
            return None
        found = self.phrases.landmark(at)
        self.phrases.subject = subject
        if found is None:
            self.phrases.last_landmark = last
            return None
        if whose is not None and found[2] not in (None, whose):
            return None
        name = "turn_start" if found[0] == "mouth" else found[0]
        kept = cast(Relation, relation) if relation in _KEPT else "from"
        return Aim(name, kept, found[1], found[2])

    def _tails(self, at: int, shares: list[Share]) -> tuple[list[Share], int] | None:
        """Read ", measured to the stop line for the ego and to the conflict point for the van"."""
        if any(share.aim is not None for share in shares):
            return None
        at += self.phrases.tag(at, "comma") is not None
        while self.phrases.tag(at, "measured_word"):
            at += 1
        aims: dict[int, Aim] = {}
        for _ in shares:
            aim = self._aim(at)
            named = (
                self._share_actor(aim.end + 1) if aim and self.phrases.tag(aim.end, "preposition") == "for" else None
            )
            if aim is None or named is None or aim.of_whom is not None:
                return None
            aims[named[0]] = aim
            end, at = named[1], self._next_share(named[1])
        if len(aims) != len(shares):
            return None
        return [replace(share, aim=aims[share.actor]) for share in shares], end

    def _tail(self, at: int) -> Aim | None:
        """Read ", each measured to the conflict point"."""
        at += self.phrases.tag(at, "comma") is not None and self.phrases.tokens[at].text not in ("(", ")")
        while self.phrases.tag(at, "measured_word"):
            at += 1
        return self._aim(at)
