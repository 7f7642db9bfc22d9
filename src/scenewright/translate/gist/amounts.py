"""Reads every amount of a text: what it measures, of whom, up to which place.

What enters: words with clauses. What leaves: one `Measured` for each amount, and for each place without one ("just
before the stop line"). At which moment of the story it holds is decided by `moments`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.measured import Measured, MeasureReader
from scenewright.translate.gist.owners import measure_of, measure_word, owner_of, told_for
from scenewright.translate.gist.places import SKIPPED
from scenewright.translate.gist.words import Clause

WHOSE_SPEED = "it is not said whose speed this is"
_BESIDE = frozenset(("determiner", "actor_adjective", "possessive", "unknown"))
_STANDS = frozenset(("stop", "wait", "sit"))


@dataclass(slots=True)
class AmountReader(MeasureReader):
    """Reads amounts in their order."""

    def read(self) -> list[Measured]:
        """Return all amounts and all places without one, each with what stands around it."""
        for clause in self.words.clauses:
            for at in clause.inside:
                if self.words.tokens[at].quantity is not None:
                    self.found += self._of_each(self._measured(at, clause))
                elif (bare := self._bare_place(at, clause)) is not None:
                    self.found.append(bare)
        return self.found

    def _of_each(self, made: Measured) -> list[Measured]:
        """Return an amount once for each vehicle where it is told of both: "both at 15 m/s"."""
        quantities = [self.words.tokens[at].quantity for at in made.clause.inside]
        alike = [each for each in quantities if each and made.quantity and each.dimension == made.quantity.dimension]
        alone = len(alike) == 1 and (made.kind == "speed" or sum(each is not None for each in quantities) == 1)
        beside = made.at - 1 in self.words.names.actors and self.words.has([made.at - 2], "determiner")
        alone = alone and not beside  # "They start with the ego 85 m from it"
        if made.clause.both and alone and made.kind in ("speed", "place") and not made.target:
            return [replace(made, actor=EGO_ID), replace(made, actor=HERO_ID)]
        return [made]

    def _measured(self, at: int, clause: Clause) -> Measured:
        quantity = self.words.tokens[at].quantity
        assert quantity is not None
        made = Measured("open", quantity, at, clause, self.words.tokens[at].span)
        if quantity.dimension == "speed":
            self._speed(made)
        elif quantity.dimension == "acceleration":
            if self.words.where(range(max(clause.start, at - 3), at), "measure", "speed") is not None:
                raise self.words.refuse("a speed cannot be in acceleration units", made.span)
            made.kind, made.actor = "rate", HERO_ID
        else:
            self._length_or_time(made)
        return made

    def _speed(self, made: Measured) -> None:
        made.kind, made.actor = "speed", owner_of(self.words, made.at, made.clause)
        told_for(self.words, made, made.at + 1)
        at, beside = made.at - 1, False  # "behind a van doing 12 m/s", "a slower car (10 m/s)"
        while self._leads_to_speed(at):
            beside |= "comma" in self.words.tags(at) or "ing" in self.words.tokens[at].forms
            at -= 1
        if beside:
            made.actor = self.words.names.actors.get(at, made.actor)
        made.target = self._is_target(made.at, made.clause)
        self._check_owner(made)

    def _check_owner(self, made: Measured) -> None:
        """Refuse "The two go west. The initial speed is 20 m/s.": it may be that of either, or of both."""
        words, clause = self.words, made.clause
        spoken = any(at in words.names.pronouns or at in words.names.actors for at in clause.inside) or clause.both
        earlier = words.clauses[: words.clauses.index(clause)]
        before = next((each for each in reversed(earlier) if each.named or each.both), None)
        plain = words.where(range(clause.start, made.at), "measure", "speed") is not None and not clause.labels
        if plain and not spoken and before is not None and before.both:
            raise words.refuse(WHOSE_SPEED, made.span)

    def _leads_to_speed(self, at: int) -> bool:
        filler = self.words.has([at], "adverb", "comma") or self.words.tag(at, "preposition") in ("at", "with")
        return at >= 0 and (filler or "ing" in self.words.tokens[at].forms)

    def _is_clock(self, made: Measured) -> bool:
        """Whether this is "5 s clock": the time since the start."""
        shown = self.words.word(made.at + 1) == "clock"
        if shown:
            self.words.used |= {made.at, made.at + 1}
        return shown and made.quantity is not None and made.quantity.dimension == "time"

    def _check_became(self, made: Measured) -> None:
        """Refuse "at the time when it has become 2 s": what "it" is was told in another sentence."""
        words = self.words
        became = words.word(made.at - 1).split()[-1:] in (["become"], ["becomes"], ["became"])
        if became and not words.has(made.clause.inside, "measure", "landmark", "relation"):
            raise words.refuse("it is not clear what this measures", made.span)

    def _length_or_time(self, made: Measured) -> None:
        if self._is_same_as_before(made):
            return
        if self._is_clock(made):
            made.kind, made.actor = "clock", HERO_ID
            return
        self._check_became(made)
        timed = made.quantity is not None and made.quantity.dimension == "time" and made.at == made.clause.end - 1
        if timed and self.words.tag(made.at + 1, "link") in ("before", "after"):
            made.kind, made.actor = "margin", HERO_ID  # "passes the conflict point 1 s before the ego does"
            return
        measure = measure_word(self.words, made.at, made.clause)
        if measure is None and self.words.word(made.at + 1) == "of":  # "1.8 s of headway separate the two"
            measure = "headway" if self.words.tag(made.at + 2, "measure") == "headway" else None
            measure = "ttc" if self.words.tag(made.at + 2, "measure") == "ttc" else measure
        if measure in ("headway", "ttc"):
            self._check_two(made)
        if measure == "ttc" and self.words.word(made.at + 1) == "of":
            made.kind = "ttc"
            return
        if measure == "headway":
            made.kind = "gap"
            self._who_follows(made)
            return
        if measure == "ttc":
            self._collision_time(made)
            return
        if self._is_measure_of(made):
            return
        rests = self.words.tag(made.at + 1, "preposition") in ("at", "of")
        at = self.words.skip(made.at + 2, SKIPPED)
        if rests and self.words.has([at], "stop_noun") and made.quantity and made.quantity.dimension == "time":
            made.kind, made.actor = "duration", HERO_ID  # "after one second at rest"
            self.words.used.add(made.at - 1)
            return
        if (
            self._lies(made)
            or self._before_reaching(made)
            or self._to_place(made)
            or self._to_vehicle(made)
            or self._around(made, measure)
        ):
            return
        if made.quantity is not None and made.quantity.dimension == "time" and self._lasts(made):
            made.kind, made.actor = "duration", HERO_ID
            return
        if self._is_that_gap(made):
            made.kind = "gap"
            return
        made.actor = owner_of(self.words, made.at, made.clause)
        told_for(self.words, made, made.at + 1)

    def _is_same_as_before(self, made: Measured) -> bool:
        """Read "once that time has dropped to 3 s": what was measured last, of whom it was measured."""
        words, quantity = self.words, made.quantity
        stretch = range(made.clause.start, made.at)
        if not stretch or words.word(stretch[0]) not in ("that", "this") or quantity is None:
            return False
        plain = ("measure", "falls", "be", "auxiliary", "adverb", "unknown", "determiner", "preposition")
        if not all(words.tags(at).keys() & set(plain) for at in stretch) or words.named(stretch) is not None:
            return False
        alike = [
            each for each in self.found if each.quantity is not None and each.quantity.dimension == quantity.dimension
        ]
        if not alike or alike[-1].kind not in ("place", "gap"):
            return False
        made.kind, made.landmark, made.actor = alike[-1].kind, alike[-1].landmark, alike[-1].actor
        return True

    def _is_measure_of(self, made: Measured) -> bool:
        """Read "4 s is its time to the stop line", "8 s for its time to arrival at the intersection"."""
        words, clause = self.words, made.clause
        opens = made.at == clause.start and "be" in words.tags(made.at + 1)
        told = range(made.at + 1, min(made.at + 5, clause.end))
        measure = words.where(told, "measure", "length", "time")
        if not (opens or words.word(made.at + 1) == "for") or measure is None:
            return False
        mark = words.where(range(measure, min(measure + 5, clause.end)), "landmark")
        if mark is None or words.has(range(measure, mark), "quantity"):
            return False
        named = words.named(range(made.at + 1, measure))
        made.kind, made.landmark = "place", words.tags(mark)["landmark"]
        made.actor = named if named is not None else clause.subject
        words.used |= {made.at, mark}
        return True

    def _is_that_gap(self, made: Measured) -> bool:
        """Whether "it" is the gap spoken of: "The gap shrinks, and when it is 15 m the van brakes"."""
        it = self.words.word(made.clause.start) == "it" and "be" in self.words.tags(made.clause.start + 1)
        at = self.words.clauses.index(made.clause)
        before = self.words.clauses[at - 1] if at else made.clause
        spoken = [i for i in before.inside if "determiner" not in self.words.tags(i)][:1]
        gap = self.words.has(spoken, "measure") and self.words.tag(spoken[0], "measure") == "length"
        told = self.words.has(before.inside, "quantity", "landmark", "ego", "hero", "noun")
        return it and gap and not told and before.sentence == made.clause.sentence

    # -- up to a place ------------------------------------------------------------------------------------------------
    def _collision_time(self, made: Measured) -> None:
        """Read a time to collision: between the two, or of one "at the conflict point", which is a time to arrival."""
        place = None if self._to_place(made) else self._place_in(made)
        if place is not None:
            made.kind, made.landmark = "place", place
            made.actor = owner_of(self.words, made.at, made.clause)
            told_for(self.words, made, made.at + 1)
        elif made.kind != "place":
            made.kind = "ttc"

    def _check_two(self, made: Measured) -> None:
        """Refuse a time between a vehicle and itself."""
        named = [self.words.names.actors[i] for i in made.clause.inside if i in self.words.names.actors]
        if len(named) > 1 and len(set(named)) == 1:
            raise self.words.refuse("a vehicle has no distance to itself", self.words.span(made.clause))

    def _to_place(self, made: Measured) -> bool:
        """Read "40 m before the stop line" and "3 s left for the ego to reach its conflict point"."""
        if self.words.word(made.at + 1) == "from there":
            made.kind, made.landmark, made.actor = "place", "last", owner_of(self.words, made.at, made.clause)
            return True
        at, told = self.places.of_whom(made.at + 1)
        relation = self.places.relation_at(at)
        place = self.places.place_at(relation[1]) if relation is not None else None
        if relation is None or place is None:
            first = self.words.skip(relation[1], SKIPPED) if relation is not None else -1
            if relation is not None and self.places.is_strange(first):
                raise self.words.refuse(
                    "it is not clear up to where this is measured", made.span.union(self.words.tokens[first].span)
                )
            return False
        stretch = range(made.at + 1, place[1])
        beside = "pronoun" in self.words.tags(place[1] - 1) and self.places.lies_beside(stretch)
        if beside and not self._alike_behind(made):
            return False  # "25 m behind it" is behind the vehicle
        made.span = made.span.union(self.words.tokens[place[1] - 1].span)
        owner = owner_of(self.words, made.at, made.clause)
        whose = self.words.named(range(relation[1], place[1]))
        if whose is not None and owner is not None and whose != owner:
            raise self.words.refuse("a distance is measured along a vehicle's own way", made.span)
        self.words.used |= {made.at, *stretch}
        made.kind, made.landmark, made.vague = "place", place[0], place[2]
        made.relation = relation[0]
        made.actor = told if told is not None else owner
        told_for(self.words, made, place[1])
        return True

    def _alike_behind(self, made: Measured) -> bool:
        """Whether it follows "behind the conflict point": "the ego is 9 m behind that point and it 20 m behind it"."""
        told = [i for i in self.words.sentence_at(made.at) if i < made.at]
        last = next((i for i in reversed(told) if self.words.has([i], "landmark")), None)
        if last is None or self.words.tags(last)["landmark"] != "conflict_point":
            return False
        behind = self.words.where(range(max(0, last - 3), last), "relation", "behind")
        return behind is not None and any("quantity" in self.words.tags(i) for i in range(max(0, behind - 2), behind))

    def _before_reaching(self, made: Measured) -> bool:
        """Read "Three seconds before the ego would reach the stop line"."""
        timed = made.quantity is not None and made.quantity.dimension == "time"
        link = made.at + 1
        while self.words.has([link], "left_over", "be") or self.words.word(link) in ("remain", "remains", "more"):
            link += 1
        name = self.words.skip(link + 1, _BESIDE | {"heading"})
        named = name in self.words.names.actors or name in self.words.names.pronouns
        if not timed or self.words.word(link) not in ("before", "until") or not named:
            return False
        verb = name + 1
        while self.words.has([verb], "auxiliary", "adverb"):
            verb += 1
        if self.words.tag(verb, "verb") != "reach":
            return False
        place = self.places.place_at(verb + 1)
        if place is None and self.words.word(verb).endswith(" there"):
            place = "last", verb + 1, False
        if place is None:
            return False
        own = self.words.names.actors.get(name, owner_of(self.words, made.at, made.clause))
        made.kind, made.landmark, made.actor = "place", place[0], own
        self.words.used |= set(range(made.at, place[1]))
        return True

    # -- up to the other vehicle, or by a measure ------------------------------------------------------------------
    def _to_vehicle(self, made: Measured) -> bool:
        """Read "12 m behind the hero" and "2 s ahead of it"."""
        at, relation = made.at + 1, None
        if self.words.word(made.at - 1).endswith("within") and self.words.tag(at, "preposition") == "of":
            relation = "from"  # "has come to within 20 yards of the van"
        while self.words.has([at], "relation", "adverb", "left_over") or self.words.tag(at, "preposition") == "of":
            relation = self.words.tag(at, "relation") or relation
            at += 1
        if relation is None and self.words.tag(at - 1, "preposition") == "of" and self._each_other(at):
            relation = "from"  # "within 25 m of each other"
        if relation == "from" and self._each_other(at):
            made.kind = "gap"
            return True
        if relation not in ("behind", "ahead", "from"):
            return False
        at = self.words.skip(at, _BESIDE)
        other = self.words.names.actors.get(at)
        named = self.words.named(range(made.at - 1, made.clause.start - 1, -1))
        if other is not None and other == named and made.clause.named:
            raise self.words.refuse("a vehicle has no distance to itself", made.span)
        owner = owner_of(self.words, made.at, made.clause)
        if other is None and (at not in self.words.names.pronouns or owner is None) and relation == "from":
            return False
        if other is None and owner is not None:
            other = 1 - owner
        if other is None:
            return False
        made.kind = "gap"
        made.actor = None if relation == "from" else (1 - other if relation == "behind" else other)
        return True

    # -- speeds, times to wait, places without an amount ---------------------------------------------------------------
    def _is_target(self, at: int, clause: Clause) -> bool:
        """Whether a speed is reached: "slows down to 5 m/s"."""
        near = range(max(clause.start, at - 6), at)
        if self.words.has(near, "measure") and not self.words.has(near, "verb"):
            return self.words.has(near, "falls")
        before = [self.words.word(i) for i in range(at - 3, at)]
        to = any(each in ("to", "down to", "until", "is") for each in before)
        changes = bool(self.words.verbs(range(clause.start, at)) & {"brake", "accelerate"})
        verbs = [self.words.tag(i, "verb") for i in range(clause.start, at) if self.words.tag(i, "verb")]
        if changes and not to and "at" in before and verbs[-1] == "pass":
            return True  # "accelerates so that it passes the conflict point at 9 m/s"
        if changes and not to and "at" in before:
            raise self.words.refuse("it is not clear what this speed means", self.words.tokens[at].span, "to 5 m/s")
        fallen = self.words.has([at - 1], "falls") and clause.link != "when"  # "so that it is down to 3 m/s"
        return "down to" in before or changes or fallen

    def _is_goal(self, at: int, end: int) -> bool:
        """Whether a vehicle is at a place before the other one: that is who comes first there."""
        following = self.words.clauses[-1]
        for each in self.words.clauses:
            if each.start == end + 1:
                following = each
        named = self.words.named(following.inside) == EGO_ID
        return self.words.has([at - 1], "be") and following.start == end + 1 and following.link == "before" and named

    def _lasts(self, made: Measured) -> bool:
        """Whether a time is how long the hero stands: "stands there for 2 s", "2 s later"."""
        before = range(made.clause.start, made.at)
        told = [i for i in before if "left_over" not in self.words.tags(i)]  # not "4 s remain for the van and 3 s"
        stands = bool(self.words.verbs(told) & _STANDS) or self.words.has(before, "stop_noun")
        lasts = "for" in (self.words.word(made.at - 1), self.words.word(made.at - 2))
        return stands or lasts or self.words.word(made.at + 1) == "later"

    def _bare_place(self, at: int, clause: Clause) -> Measured | None:
        """Read "just before the stop line" and "at the stop line"."""
        just = self.words.tag(at, "adverb") == "just" and self.words.tag(at + 1, "relation") == "before"
        here = self.words.tag(at, "preposition") == "at" or self.words.word(at) == "on"
        place = self.places.place_at(at + 2 if just else at + 1) if just or here else None
        if place is None or place[2] or (here and self.words.has(range(max(clause.start, at - 2), at), "quantity")):
            return None
        before = range(clause.start, at)
        if self._is_goal(at, place[1]):
            return None  # "accelerates to be at the conflict point before the ego"
        if clause.link in ("before", "after", "until") and clause.subject == EGO_ID:
            return None  # "before we are at the conflict point"
        measured = any(measure_of(self.words, i) in ("length", "time", "own") for i in before)
        if measured or (here and place[0] not in ("stop_line", "conflict_point")):
            return None
        self.words.used |= set(range(at, place[1]))
        span = self.words.tokens[at].span.union(self.words.tokens[place[1] - 1].span)
        made = Measured("place", None, at, clause, span, owner_of(self.words, at, clause), place[0])
        made.relation = "just_before" if just else "at"
        return made
