"""Reads every amount of a text: what it measures, of whom, up to which place.

What enters: words with clauses. What leaves: one `Measured` for each amount, and for each place without one ("just
before the stop line"). At which moment of the story it holds is decided by `moments`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID, Relation
from scenewright.translate.facts import Bound
from scenewright.translate.gist.owners import measure_of, measure_word, owner_of, told_by_for, told_for
from scenewright.translate.gist.places import SKIPPED, PlaceFinder
from scenewright.translate.gist.words import Clause, Words
from scenewright.translate.tokens import Quantity

_BESIDE = frozenset(("determiner", "actor_adjective", "possessive", "unknown"))
_STANDS = frozenset(("stop", "wait", "sit"))


@dataclass(slots=True)
class Measured:
    """An amount with what it measures.

    Attributes
    ----------
    kind
        ``place`` (a distance or a time to a landmark), ``gap`` (between the two, as a distance or a time), ``ttc``,
        ``speed``, ``rate``, ``duration``, ``margin`` (by how much one is first), or ``open`` where nothing around it
        says it.
    quantity
        None for a place without one.
    actor
        Whose it is; for a gap who is behind, where that is said.
    landmark, relation, vague
        The place; `vague` where "the driveway" stands for it. ``last`` is the landmark named before.
    target
        Whether a speed is reached, not had.
    bound
        Whether it is the least or the most: "for at least 2 s".
    """

    kind: str
    quantity: Quantity | None
    at: int
    clause: Clause
    span: Span
    actor: int | None = None
    landmark: str | None = None
    relation: Relation = "before"
    vague: bool = False
    target: bool = False
    bound: Bound = "=="


@dataclass(slots=True)
class AmountReader:
    """Reads amounts in their order."""

    words: Words
    found: list[Measured] = field(default_factory=list)
    places: PlaceFinder = field(init=False)
    lying: Measured | None = None  # the last place that itself was said to lie somewhere: "the stop line is 6 s away"

    def __post_init__(self) -> None:
        self.places = PlaceFinder(self.words)

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
        alone = sum(self.words.tokens[at].quantity is not None for at in made.clause.inside) == 1
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

    def _leads_to_speed(self, at: int) -> bool:
        filler = self.words.has([at], "adverb", "comma") or self.words.tag(at, "preposition") in ("at", "with")
        return at >= 0 and (filler or "ing" in self.words.tokens[at].forms)

    def _length_or_time(self, made: Measured) -> None:
        if self._is_same_as_before(made):
            return
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
        if "pronoun" in self.words.tags(place[1] - 1) and self.places.lies_beside(stretch):
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

    def _before_reaching(self, made: Measured) -> bool:
        """Read "Three seconds before the ego would reach the stop line"."""
        timed = made.quantity is not None and made.quantity.dimension == "time"
        link = made.at + 1
        while self.words.has([link], "left_over") or self.words.word(link) in ("remain", "remains", "more"):
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

    def _each_other(self, at: int) -> bool:
        """Whether "each other" stands here."""
        return self.words.word(at) in ("each other", "one another") or (
            self.words.word(at) == "each" and self.words.word(at + 1) == "other"
        )

    def _around(self, made: Measured, measure: str | None) -> bool:
        """Read "the gap has fallen to 12 m", "9 m separate the two", "the distance between it and the line is 30 m"."""
        separates = self.words.where(range(made.at + 1, made.at + 3), "separates")
        if separates is not None:
            self._separates(made, separates)
            return True
        between = self.words.where(made.clause.inside, "preposition", "between")
        if measure is None and between is None and self._arrives_in(made):
            return True
        if measure is None and between is None:
            return False
        place = self._place_in(made) or self._approached(made, measure)
        if place is None and measure is not None:
            self._check_known_place(made)
        if place is not None:
            made.kind, made.landmark = "place", place
            made.actor = owner_of(self.words, made.at, made.clause)
            told_for(self.words, made, made.at + 1)
            return True
        if measure == "length" and between is None and self._is_told_of_next(made):
            return False  # "at a distance of 21 m, and the hero at one of 26 m, from the conflict point"
        if measure == "length" or between is not None:
            made.kind = "gap"
            self._who_follows(made)
            return True
        return False

    def _approached(self, made: Measured, measure: str | None) -> str | None:
        """Return what is approached, in "approaches the intersection, with an initial time to arrival of 6 s"."""
        at = self.words.clauses.index(made.clause)
        before = self.words.clauses[at - 1] if at else made.clause
        alone = measure == "time" and before.sentence == made.clause.sentence and made.clause.subject == before.subject
        mark = self.words.where(before.inside, "landmark")
        comes = "approach" in self.words.verbs(before.inside) and not self.words.has(before.inside, "quantity")
        if not (alone and comes and mark is not None and not made.clause.named):
            return None
        self.words.used |= {made.at, mark}
        return self.words.tags(mark)["landmark"]

    def _arrives_in(self, made: Measured) -> bool:
        """Read "would arrive at the stop line in 2.5 s"."""
        timed = made.quantity is not None and made.quantity.dimension == "time"
        acts = self.words.verbs(made.clause.inside) & {"stop", "brake", "wait", "accelerate"}
        if not timed or self.words.word(made.at - 1) != "in" or acts:
            return False
        place = self._place_in(made)
        if place is None:
            return False
        made.kind, made.landmark, made.actor = "place", place, owner_of(self.words, made.at, made.clause)
        return True

    def _is_told_of_next(self, made: Measured) -> bool:
        """Whether the place comes with the other vehicle's amount: "at a distance of 21 m, and the hero at one of"."""
        words = self.words
        of = [words.word(made.at - i) for i in (3, 2, 1)] == ["a", "distance", "of"]
        ahead = range(made.at + 1, min(made.at + 10, len(words.tokens)))
        other = words.where(ahead, "quantity", "length")
        like = other is not None and words.word(other - 1) == "of" and words.word(other - 2) in ("one", "that")
        return of and like and words.named(ahead) is not None

    def _check_known_place(self, made: Measured) -> None:
        """Refuse "the time to the turn line is 2 s": a measure up to what is no known place and no vehicle."""
        told = [at for at in range(made.clause.start, made.at) if "quantity" in self.words.tags(at)]
        for at in range(told[-1] if told else made.clause.start, made.at):
            to = self.words.tag(at, "preposition") == "to" or self.words.tag(at, "link") == "until"
            if to and "measure" in self.words.tags(at - 1) and self.places.is_strange(self.words.skip(at + 1, SKIPPED)):
                raise self.words.refuse("it is not clear up to where this is measured", self.words.span(made.clause))

    def _lies(self, made: Measured) -> bool:
        """Read "the intersection is 6.8 s away" and "the intersection lies 82 m ahead of it"."""
        before = range(made.clause.start, made.at)
        away = self.words.tag(made.at + 1, "relation") in ("from", "ahead")
        it = self.words.word(made.clause.start) == "it" and self.words.named(before) is None
        if it and away and self.lying is not None and self.lying.clause.sentence == made.clause.sentence - 1:
            place = self.places.place_at(made.at + 2)
            if place is None and self.words.named(range(made.at, made.clause.end)) is None:
                made.kind, made.landmark, made.actor = "place", self.lying.landmark, self.lying.actor
                return True  # "The stop line is 6 s away. When it is only 2 s away ..."
        joint = next((i for i in reversed(before) if self.words.has([i], "quantity") or self.words.word(i) == "and"), 0)
        joined = self.words.word(joint) == "and" and self.words.has(range(made.clause.start, joint), "quantity")
        if joined:  # "the conflict point is 38 m ahead of us and the stop line 11 m ahead of the van"
            before = range(joint + 1, made.at)
        mark = self.words.where(before, "landmark")
        said = next((i for i in before if self.words.word(i) in ("the intersection is", "the junction is")), None)
        elliptic = (made.clause.link == "and" or joined) and self.words.tag(made.at + 1, "relation") == "ahead"
        stands = elliptic or self.words.has(before, "be") or "sit" in self.words.verbs(before) or said is not None
        measured = any(measure_of(self.words, at) is not None for at in before)
        if (mark is None and said is None) or not away or not stands or measured or self.words.has(before, "quantity"):
            return False
        place = self.places.place_at(made.at + 2)
        name = next((i for i in before if i in self.words.names.actors), None)
        if name is not None and told_by_for(self.words, name, made.clause):  # "For the ego the stop line is 6 s away."
            made.actor, before = self.words.names.actors[name], range(name + 1, made.at)
        if self.words.named(before) is not None or (place is not None and place[0] != "last"):
            return False
        named = self.words.named(range(made.at + 1, min(made.at + 5, made.clause.end)))
        made.kind, made.landmark = "place", self.words.tags(mark)["landmark"] if mark is not None else "intersection"
        made.actor = named if named is not None else made.actor if made.actor is not None else made.clause.subject
        self.words.used |= {made.at, mark if mark is not None else made.at}
        self.lying = made
        return True

    def _separates(self, made: Measured, at: int) -> None:
        """Read "9 m separate the ego from the van" and "28 m separate the ego from the conflict point"."""
        made.kind = "gap"
        self.words.used |= set(range(made.at, at + 1))
        name = self.words.skip(at + 1, _BESIDE)
        relation = self.places.relation_at(name + 1) if name in self.words.names.actors else None
        known = name in self.words.names.actors or name in self.words.names.pronouns
        pair = known and self.words.word(name + 1) == "and"
        if pair:
            relation = "before", name + 2  # "70 m lie between the ego and the intersection"
        if name in self.words.names.pronouns and not pair:  # "60 yd separate it from the conflict point"
            relation = self.places.relation_at(name + 1)
        place = self.places.place_at(relation[1]) if relation is not None else None
        if place is not None:
            actor = self.words.names.actors.get(name, made.clause.subject)
            made.kind, made.landmark, made.actor = "place", place[0], actor
            self.words.used |= set(range(at, place[1]))

    def _place_in(self, made: Measured) -> str | None:
        """Return the landmark that a measure names: "its distance to the stop line is 12 m"."""
        clause, words = made.clause, self.words
        following = next((i for i in range(made.at + 1, clause.end) if "quantity" in words.tags(i)), clause.end)
        between = words.where(range(made.at, following), "preposition", "between")
        ahead = words.where(range(between, following), "landmark") if between is not None else None
        if ahead is not None:
            words.used |= {ahead, made.at}
            return words.tags(ahead)["landmark"]
        for at in range(made.at - 1, clause.start - 1, -1):
            if "quantity" in words.tags(at):
                return None
            if "landmark" in words.tags(at):
                words.used |= {at, made.at}
                return words.tags(at)["landmark"]
            if "back_reference" in words.tags(at):
                return "last"
        return None

    def _who_follows(self, made: Measured) -> None:
        """Find who is behind: "the ego follows the van with a time gap of 2 s"."""
        if self.words.where(made.clause.inside, "verb", "follow") is not None:
            made.actor = made.clause.subject

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
        stands = bool(self.words.verbs(before) & _STANDS) or self.words.has(before, "stop_noun")
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
