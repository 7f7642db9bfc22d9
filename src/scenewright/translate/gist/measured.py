"""What an amount measures, by a measure or by what lies where: "the gap has fallen to 12 m", "the line is 8 m ahead".

What enters: words with clauses, and an amount. What leaves: the amount with what it measures, or nothing told.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Span
from scenewright.translate.events import Relation
from scenewright.translate.facts import Bound
from scenewright.translate.gist.owners import measure_of, owner_of, told_by_for, told_for
from scenewright.translate.gist.places import SKIPPED, PlaceFinder
from scenewright.translate.gist.words import Clause, Words
from scenewright.translate.tokens import Quantity

_BESIDE = frozenset(("determiner", "actor_adjective", "possessive", "unknown"))


@dataclass(slots=True)
class Measured:
    """An amount with what it measures.

    Attributes
    ----------
    kind
        ``place`` (a distance or a time to a landmark), ``gap`` (between the two, as a distance or a time), ``ttc``,
        ``speed``, ``rate``, ``duration``, ``margin`` (by how much one is first), ``clock`` (since the start), or
        ``open`` where nothing around it says it.
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
class MeasureReader:
    """Reads what the words around an amount say of it.

    Attributes
    ----------
    lying
        The last place that itself was said to lie somewhere: "the stop line is 6 s away".
    """

    words: Words
    found: list[Measured] = field(default_factory=list)
    places: PlaceFinder = field(init=False)
    lying: Measured | None = None

    def __post_init__(self) -> None:
        self.places = PlaceFinder(self.words)

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
        other = words.where(ahead, "quantity", "length", "time")
        like = other is not None and words.word(other - 1) == "of"
        like = like and other is not None and (words.word(other - 2) in ("one", "that", "distance"))
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
        away = self.words.tag(made.at + 1, "relation") in ("from", "ahead") or self.words.word(made.at + 1) == "distant"
        if away and made.clause.link == "that" and self._lies_which(made):
            return True
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

    def _lies_which(self, made: Measured) -> bool:
        """Read "the intersection, which is 7 s away", "the stop line, from which it is 4 s away"."""
        words, clause = self.words, made.clause
        which = clause.start - 1
        away = words.word(which - 1) == "from"
        mark = which - 1 - away
        mark -= words.has([mark], "comma")
        if words.word(which) not in ("which", "that"):
            return False
        back = self.words.where(range(mark, max(-1, mark - 4), -1), "landmark")
        plain = ("determiner", "area", "preposition", "landmark")
        if back is None or not all(words.has([at], *plain) for at in range(back, mark + 1)):
            return False
        told = range(clause.start, made.at)
        if words.has(told, "quantity", "landmark", "verb") or not words.has(told, "be", "auxiliary"):
            return False
        if away != (words.named(told) is not None or any(at in words.names.pronouns for at in told)):
            return False
        if self.places.place_at(made.at + 2) is not None:
            return False
        named = words.named(told)
        if named is None:
            named = next((each.subject for each in words.clauses if back in each.inside), None)
        made.kind, made.landmark = "place", words.tags(back)["landmark"]
        made.actor = named if named is not None else clause.subject
        words.used |= {made.at, back, which - 1}
        return True

    def _separates(self, made: Measured, at: int) -> None:
        """Read "9 m separate the ego from the van" and "28 m separate the ego from the conflict point"."""
        made.kind = "gap"
        self.words.used |= set(range(made.at, at + 1))
        name = self.words.skip(at + 1 + (self.words.word(at + 1) in ("the second", "the first")), _BESIDE)
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
        """Find who is behind: "the ego follows the van with a time gap of 2 s", "its headway to the van is 2 s"."""
        for at in made.clause.inside:
            to = at + 1 if self.words.word(at + 1) != "of" else self.words.skip(at + 2, _BESIDE) + 1
            timed = made.quantity is not None and made.quantity.dimension == "time"
            if not timed or "measure" not in self.words.tags(at) or self.words.word(to) != "to":
                continue
            name = self.words.skip(to + 1, _BESIDE)
            if (ahead := self.words.names.actors.get(name)) is not None:
                behind = self.words.tag(name + 1, "relation") == "behind"  # "a time gap to the ego behind it"
                made.actor = ahead if behind else 1 - ahead
        if self.words.where(made.clause.inside, "verb", "follow") is not None:
            made.actor = made.clause.subject
