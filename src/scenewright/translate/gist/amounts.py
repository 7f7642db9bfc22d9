"""Reads every amount of a text: what it measures, of whom, up to which place.

What enters: tokens, names, clauses. What leaves: one `Measured` for each amount, and places named without one ("just before
the stop line"). Which moment of the story an amount belongs to is decided by `story`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID, Relation
from scenewright.translate.gist.clauses import Clause, is_object
from scenewright.translate.gist.names import Names
from scenewright.translate.tokens import Quantity, Token

_SKIPPED = frozenset(("determiner", "possessive", "area_adjective", "adverb", "left_over", "starting", "measured_word"))
STOPS = ("stop", "wait", "sit")


@dataclass(slots=True)
class Measured:
    """An amount with what it measures.

    Attributes
    ----------
    kind
        ``place`` (a distance or a time to a landmark), ``gap`` (between the two, as a distance or a time), ``ttc``,
        ``speed``, ``rate``, ``duration``, or ``open`` where nothing around it says it.
    actor
        Whose it is; for a gap, who is behind, where that is said.
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
    target: bool = False  # a speed that is reached, not had


@dataclass(slots=True)
class AmountReader:
    """Reads amounts in their order."""

    tokens: list[Token]
    names: Names
    clauses: list[Clause]
    used: set[int] = field(default_factory=set)
    unplaced: list[Span] = field(default_factory=list)  # amounts up to something that was not understood

    def read(self) -> list[Measured]:
        """Return all amounts and all places without one."""
        found: list[Measured] = []
        for clause in self.clauses:
            for at in range(clause.start, clause.end):
                token = self.tokens[at]
                if token.quantity is not None:
                    found += self._of_each(self._measured(at, clause))
                elif (bare := self._bare_place(at, clause)) is not None:
                    found.append(bare)
        self._back_references(found)
        self._respectively(found)
        self._shared_places(found)
        self._in_order(found)
        return found

    def _of_each(self, made: Measured) -> list[Measured]:
        """Return an amount once for each vehicle where it is told of both: "both at 15 m/s"."""
        clause = made.clause
        alone = sum(self.tokens[at].quantity is not None for at in range(clause.start, clause.end)) == 1
        if clause.both and alone and made.kind in ("speed", "place") and not made.target:
            return [replace(made, actor=EGO_ID), replace(made, actor=HERO_ID)]
        return [made]

    # -- one amount ---------------------------------------------------------------------------------------------------
    def _measured(self, at: int, clause: Clause) -> Measured:
        token = self.tokens[at]
        assert token.quantity is not None
        made = Measured("open", token.quantity, at, clause, token.span)
        dimension = token.quantity.dimension
        if dimension == "speed":
            made.kind, made.actor = "speed", self._owner(at, clause)
            self._told_for(made, at + 1)
            self._right_after(made)
            made.target = self._is_target(at, clause)
            return made
        if dimension == "acceleration":
            made.kind, made.actor = "rate", HERO_ID
            return made
        measure = self._measure_before(at, clause)
        if measure in ("ttc", "headway"):
            made.kind = "ttc" if measure == "ttc" else "gap"
            if measure == "headway":
                self._gap_owner(made)
            if measure != "ttc" or not self._to_place(made):
                return made
        if self._to_place(made) or self._to_vehicle(made):
            return made
        if self._around(made, measure):
            return made
        later = at + 1 < len(self.tokens) and self.tokens[at + 1].text.lower() == "later"
        if dimension == "time" and (later or self._lasts(at, clause)):
            made.kind, made.actor = "duration", HERO_ID
            return made
        made.actor = self._owner(at, clause)
        self._told_for(made, at + 1)
        return made

    def _to_place(self, made: Measured) -> bool:
        """Read "40 m before the stop line" and "3 s to go to its conflict point"."""
        at, told = self._of_whom(made.at + 1)
        relation = self._relation_at(at)
        if relation is None:
            return False
        place = self.place_at(relation[1])
        if place is None:
            first = self._skip(relation[1])
            if first < len(self.tokens) and "unknown" in self.tokens[first].tags:
                self.unplaced.append(made.span.union(self.tokens[first].span))
            return False
        if self.tokens[place[1] - 1].tags.get("pronoun") == "it" and any(
            self.tokens[i].tags.get("relation") in ("behind", "ahead") for i in range(made.at + 1, place[1])
        ):
            return False
        if self._of_other(made, relation[1], place[1]):
            self.unplaced.append(made.span.union(self.tokens[place[1] - 1].span))
        self.used |= set(range(made.at, place[1]))
        made.kind, made.landmark, made.vague = "place", place[0], place[2]
        made.relation = relation[0]
        made.actor = told if told is not None else self._owner(made.at, made.clause)
        made.span = made.span.union(self.tokens[place[1] - 1].span)
        self._told_for(made, place[1])
        return True

    def _of_whom(self, at: int) -> tuple[int, int | None]:
        """Step over "left for the ego" in "12 m left for the ego to its stop line"."""
        ahead = at
        while ahead < len(self.tokens) and self.tokens[ahead].tags.keys() & {"left_over", "measure"} and "relation" not in self.tokens[ahead].tags:
            ahead += 1
        if ahead < len(self.tokens) and self.tokens[ahead].tags.get("preposition") in ("for", "to", "of"):
            name = ahead + 1
            while name < len(self.tokens) and self.tokens[name].tags.keys() & {"determiner", "actor_adjective", "heading"} and name not in self.names.actors:
                name += 1
            if name in self.names.actors and name + 1 < len(self.tokens) and self._relation_at(name + 1):
                return name + 1, self.names.actors[name]
        return at, None

    def _skip(self, at: int) -> int:
        while at < len(self.tokens) and self.tokens[at].tags.keys() & _SKIPPED:
            at += 1
        return at

    def _of_other(self, made: Measured, start: int, end: int) -> bool:
        """Whether the place belongs to the other vehicle: "the ego is 12 m from the hero's stop line"."""
        owner = self._owner(made.at, made.clause)
        named = [self.names.actors[at] for at in range(start, end) if at in self.names.actors]
        return bool(named) and owner is not None and named[0] != owner

    def _relation_at(self, at: int) -> tuple[Relation, int] | None:
        """Return how an amount lies to what follows, and where that begins."""
        seen: Relation | None = None
        while at < len(self.tokens):
            tags = self.tokens[at].tags
            if "relation" in tags:
                seen = "past" if tags["relation"] == "past" else seen or _relation(tags["relation"])
            elif self.tokens[at].text.lower() == "at that" or tags.get("preposition") in ("to", "at", "out", "of") and seen is None:
                seen = "from"
            elif tags.get("preposition") in ("to", "at", "of") or tags.keys() & {"left_over", "measured_word"}:
                pass
            elif tags.get("adverb") in ("filler", "exact", "about"):
                pass
            elif seen is None and tags.get("link") in ("to", "until"):
                seen = "from"
            elif tags.get("verb") in ("go", "drive", "pass", "reach") and at and self.tokens[at - 1].text.lower() in ("to", "from"):
                pass
            else:
                break
            at += 1
        return (seen, at) if seen is not None else None

    def place_at(self, at: int) -> tuple[str, int, bool] | None:
        """Return the landmark at `at`, the index after it, and whether it is only an area's mouth."""
        first = at
        while at < len(self.tokens) and self.tokens[at].tags.keys() & _SKIPPED and "landmark" not in self.tokens[at].tags:
            at += 1
        if at >= len(self.tokens):
            return None
        tags = self.tokens[at].tags
        if "landmark" in tags:
            return tags["landmark"], at + 1, False
        if "back_reference" in tags or ("mark_noun" in tags and at > first):
            return "last", at + 1, False
        if tags.get("area") == "driveway":
            return "turn", at + 1, True
        if tags.get("pronoun") == "it" and at == first and self._named_in_sentence(at):
            return "last", at + 1, False
        return None

    def _named_in_sentence(self, at: int) -> bool:
        """Whether a landmark was named before in this sentence, with no amount of its own between: "65 feet from it"."""
        for back in range(at - 1, -1, -1):
            tags = self.tokens[back].tags
            if "end" in tags:
                return False
            if "landmark" in tags:
                return True
        return False

    def _to_vehicle(self, made: Measured) -> bool:
        """Read "12 m behind the hero" and "2 s ahead of it"."""
        at = made.at + 1
        relation: str | None = None
        while at < len(self.tokens) and (
            self.tokens[at].tags.keys() & {"relation", "adverb", "left_over"} or self.tokens[at].tags.get("preposition") == "of"
        ):
            relation = self.tokens[at].tags.get("relation", relation)
            at += 1
        if relation not in ("behind", "ahead", "from"):
            return False
        while at < len(self.tokens) and self.tokens[at].tags.keys() & {"determiner", "actor_adjective", "possessive", "unknown"} and at not in self.names.actors:
            at += 1
        other = self.names.actors.get(at)
        if other is None and at not in self.names.pronouns and relation == "from":
            return False
        owner = self._owner(made.at, made.clause)
        if other is None and owner is not None:
            other = 1 - owner
        if other is None:
            return False
        made.kind = "gap"
        made.actor = None if relation == "from" else (1 - other if relation == "behind" else other)
        return True

    def _around(self, made: Measured, measure: str | None) -> bool:
        """Read "the gap has fallen to 12 m", "9 m separate the two", "the distance between it and the line is 30 m"."""
        near = self.tokens[made.clause.start : made.clause.end]
        after = self.tokens[made.at + 1 : made.at + 3]
        if any("separates" in each.tags for each in after):
            made.kind = "gap"
            self.used |= set(range(made.at, made.at + 3))
            return True
        between = next((i for i in range(made.clause.start, made.clause.end) if self.tokens[i].tags.get("preposition") == "between"), None)
        if measure is None and between is None:
            return False
        place = self._place_in(made.clause, made.at)
        if place is not None:
            made.kind, made.landmark, made.vague = "place", place[0], place[1]
            made.actor = self._owner(made.at, made.clause)
            self._told_for(made, made.at + 1)
            return True
        if measure in ("length", "headway") or between is not None:
            made.kind = "gap"
            self._gap_owner(made)
            return True
        del near
        return False

    def _place_in(self, clause: Clause, before: int) -> tuple[str, bool] | None:
        """Return the landmark that a measure names: "its distance to the stop line is 12 m"."""
        following = next((i for i in range(before + 1, clause.end) if "quantity" in self.tokens[i].tags), clause.end)
        between = next((i for i in range(before, following) if self.tokens[i].tags.get("preposition") == "between"), following)
        for at in range(between, following):
            if "landmark" in self.tokens[at].tags:
                self.used |= {at, before}
                return self.tokens[at].tags["landmark"], False
        for at in range(before - 1, clause.start - 1, -1):
            tags = self.tokens[at].tags
            if "quantity" in tags:
                return None
            if "landmark" in tags:
                self.used |= {at, before}
                return tags["landmark"], False
            if "back_reference" in tags:
                return "last", False
        return None

    def _measure_before(self, at: int, clause: Clause) -> str | None:
        for back in range(at - 1, clause.start - 1, -1):
            tags = self.tokens[back].tags
            for key in ("measure", "measures"):
                if back + 1 < at and self.tokens[back].text.lower() == "that" and self.tokens[back + 1].tags.get("preposition") in ("out", "of"):
                    return "length"
                if key in tags and tags[key] in ("length", "time", "ttc", "headway"):
                    return tags[key]
            if "quantity" in tags:
                break
        return None

    def _gap_owner(self, made: Measured) -> None:
        """Find who is behind: "the ego follows the van with a time gap of 2 s"."""
        for at in range(made.clause.start, made.clause.end):
            if self.tokens[at].tags.get("verb") == "follow" and made.clause.subject is not None:
                made.actor = made.clause.subject
                return

    def _told_for(self, made: Measured, at: int) -> None:
        """Read "3 s for the ego and 2 s for the van"."""
        for ahead in range(made.at + 1, min(len(self.tokens), max(at, made.at + 1) + 4)):
            tags = self.tokens[ahead].tags
            if "quantity" in tags or tags.keys() & {"end"}:
                return
            open_to = tags.get("preposition") == "to" and made.kind == "open"
            if tags.get("preposition") == "for" or open_to or (tags.get("preposition") == "of" and ahead <= made.at + 2):
                for name in range(ahead + 1, min(ahead + 5, len(self.tokens))):
                    if name in self.names.actors:
                        made.actor = self.names.actors[name]
                        return
                return

    # -- whose it is --------------------------------------------------------------------------------------------------
    def _owner(self, at: int, clause: Clause) -> int | None:
        """Return the vehicle named last before an amount in its sentence, if not as an object, else the clause's."""
        if (told := self._measured_of(at, clause)) is not None:
            return told
        for back in range(at - 1, clause.start - 1, -1):
            if back in self.names.actors and not is_object(self.tokens, back, self.names):
                return self.names.actors[back]
            if "quantity" in self.tokens[back].tags:
                break
        if (told := self._measured_of(at, clause)) is not None:
            return told
        between = [back for back in range(clause.start, at) if self.tokens[back].tags.get("preposition") == "between"]
        ahead = next((a for a in range(at + 1, clause.end) if "quantity" in self.tokens[a].tags), clause.end)
        after = [a for a in range(at, ahead) if self.tokens[a].tags.get("preposition") == "between"]
        for mark in [*after, *between]:
            for name in range(mark + 1, min(mark + 5, len(self.tokens))):
                if name in self.names.actors:
                    return self.names.actors[name]
        return clause.subject

    def _right_after(self, made: Measured) -> None:
        """Read "behind a van doing 12 m/s" and "a slower car (10 m/s)": the speed of who is named just before."""
        at = made.at - 1
        while at >= 0 and (
            self.tokens[at].tags.keys() & {"adverb", "comma"} or "ing" in self.tokens[at].forms or self.tokens[at].tags.get("preposition") in ("at", "with")
        ):
            at -= 1
        if at in self.names.actors:
            made.actor = self.names.actors[at]

    def _measured_of(self, at: int, clause: Clause) -> int | None:
        """Return whose a measure is: "the time to arrival of the hero", "the distance from the ego to the line"."""
        for back in range(at - 1, clause.start - 1, -1):
            if "quantity" in self.tokens[back].tags:
                break
            that = self.tokens[back].text.lower() == "that" and self.tokens[back + 1].tags.get("preposition") in ("out", "of")
            if that or self.tokens[back].tags.keys() & {"measure", "measures"}:
                for name in range(back + 1, at):
                    if name in self.names.actors:
                        return self.names.actors[name]
                before = next((b for b in range(back - 1, max(-1, back - 3), -1) if b in self.names.actors), None)
                return self.names.actors[before] if before is not None else None
        return None

    def _is_target(self, at: int, clause: Clause) -> bool:
        near = self.tokens[max(clause.start, at - 6) : at]
        if any("measure" in each.tags for each in near) and not any("verb" in each.tags for each in near):
            return any(each.tags.get("preposition") == "to" and "falls" in each.tags for each in near)
        down = any(each.text.lower() == "down to" for each in near[-2:])
        return down or any(self.tokens[b].tags.get("verb") in ("brake", "accelerate") for b in range(clause.start, at))

    def _lasts(self, at: int, clause: Clause) -> bool:
        """Whether a time is how long the hero stands."""
        before = self.tokens[clause.start : at]
        stands = any(each.tags.get("verb") in STOPS or "stop_noun" in each.tags for each in before)
        return stands or any(each.text.lower() == "for" for each in before[-2:])

    # -- places without an amount, and shared ones --------------------------------------------------------------------
    def _bare_place(self, at: int, clause: Clause) -> Measured | None:
        """Read "just before the stop line" and "at the stop line"."""
        token = self.tokens[at]
        just = token.tags.get("adverb") == "just" and at + 1 < clause.end and self.tokens[at + 1].tags.get("relation") == "before"
        here = token.tags.get("preposition") == "at" or token.text.lower() == "on"
        if not just and not here:
            return None
        place = self.place_at(at + 2 if just else at + 1)
        if place is None or place[2] or (here and any("quantity" in t.tags for t in self.tokens[max(clause.start, at - 2) : at])):
            return None
        if any((t.tags.get("measures") or t.tags.get("measure")) in ("length", "time") for t in self.tokens[clause.start : at]):
            return None
        if here and place[0] not in ("stop_line", "conflict_point"):
            return None
        self.used |= set(range(at, place[1]))
        made = Measured("place", None, at, clause, token.span.union(self.tokens[place[1] - 1].span))
        made.landmark, made.relation = place[0], "just_before" if just else "at"
        made.actor = self._owner(at, clause)
        return made

    def _back_references(self, found: list[Measured]) -> None:
        """Let "that point" be the landmark named last."""
        for made in found:
            if made.landmark != "last":
                continue
            for back in range(made.at - 1, -1, -1):
                if "landmark" in self.tokens[back].tags:
                    made.landmark = self.tokens[back].tags["landmark"]
                    self.used.add(back)
                    break

    def _respectively(self, found: list[Measured]) -> None:
        """Read "15 m and 6 m away from the conflict point and the stop line, respectively"."""
        for at, token in enumerate(self.tokens):
            if "respectively" not in token.tags:
                continue
            first = at
            while first > 0 and "end" not in self.tokens[first - 1].tags:
                first -= 1
            own = [m for m in found if first <= m.at < at and m.quantity is not None][-2:]
            if len(own) < 2:
                continue
            marks = [i for i in range(own[1].at, at) if "landmark" in self.tokens[i].tags]
            if len(marks) == 2:
                for made, mark in zip(own, marks, strict=True):
                    made.kind, made.landmark, made.vague = "place", self.tokens[mark].tags["landmark"], False
                    self.used.add(mark)
            if marks:
                self.used.add(at)

    def _shared_places(self, found: list[Measured]) -> None:
        """Let "the ego 40 m and the hero 20 m from the conflict point" tell the place of both."""
        for first, second in zip(found, found[1:], strict=False):
            if first.kind != "open" or first.quantity is None or first.clause.sentence != second.clause.sentence:
                continue
            same = second.quantity is not None and first.quantity.dimension == second.quantity.dimension
            if same and second.kind == "place":
                first.kind, first.landmark, first.relation, first.vague = "place", second.landmark, second.relation, second.vague
        for first, second in zip(found, found[1:], strict=False):
            if second.kind != "open" or second.quantity is None or first.clause.sentence != second.clause.sentence:
                continue
            same = first.quantity is not None and first.quantity.dimension == second.quantity.dimension
            if same and first.kind == "place" and second.actor is not None and first.actor is not None:
                told = [each for each in (first, second)]
                self._told_for(second, second.at + 1)
                if told[0].actor != told[1].actor:
                    second.kind, second.landmark, second.relation, second.vague = "place", first.landmark, first.relation, first.vague


    def _in_order(self, found: list[Measured]) -> None:
        """Let "the ego and the hero are 12 m and 30 m from it" tell of each in order."""
        for clause in self.clauses:
            own = [made for made in found if made.clause.sentence == clause.sentence and clause.start <= made.at]
            own = [made for made in own if made.kind == "place" and made.quantity is not None][:2]
            if len(own) < 2 or own[0].clause is not own[1].clause or own[0].clause is not clause:
                continue
            first = next(c.start for c in self.clauses if c.sentence == clause.sentence)
            named = [at for at in range(first, own[0].at) if at in self.names.actors]
            between = [at for at in range(own[0].at, own[1].at) if at in self.names.actors]
            marks = {own[0].landmark, own[1].landmark}
            if len(marks) > 1:
                continue
            if len(named) >= 2 and not between and self.names.actors[named[-1]] != self.names.actors[named[-2]]:
                self.used |= {
                    at for at in range(own[1].at, len(self.tokens)) if "respectively" in self.tokens[at].tags
                } & set(range(own[1].at, own[1].at + 9))
                own[0].actor, own[1].actor = self.names.actors[named[-2]], self.names.actors[named[-1]]


def _relation(value: str) -> Relation:
    return "past" if value == "past" else "before"


