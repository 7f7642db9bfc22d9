"""Reads phrases at a position of the token list: noun phrases, places, areas, headings, measures. No clause structure.

What enters: tagged tokens and a position. What leaves: what the phrase says and the position after it, or None.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

from scenewright.translate.events import Area, AreaKind, AreaRole, Place, Relation
from scenewright.translate.noun_phrases import NounPhrases
from scenewright.translate.references import NounPhrase
from scenewright.translate.tokens import Quantity

OPPOSITE = {"N": "S", "S": "N", "E": "W", "W": "E"}
_SPOTS = ("point", "position", "spot", "location", "mark")
MEASURE_DIMENSION = {
    "length": "length",
    "time": "time",
    "headway": "time",
    "ttc": "time",
    "speed": "speed",
    "rate": "acceleration",
}


@dataclass(slots=True)
class Phrases(NounPhrases):
    """Phrase readers over one token list."""

    # -- places -----------------------------------------------------------------------------------------------------
    def landmark(self, at: int) -> tuple[str, int, int | None, bool] | None:
        """Read a landmark: name, position after it, whose it is, and whether a driveway stands for it."""
        owner = self.possessor(at)
        whose, at = owner if owner else (None, self.skip_determiner(at))
        if self.tag(at, "same") and self.tag(at + 1, "landmark"):
            at += 1
        name = self.tag(at, "landmark")
        last = self.last_landmark if self.tokens[at + 1].quantity is None else None
        if name is None and self.tag(at, "back_reference") and last and self.tag(at - 1, "determiner") == "definite":
            self.assume(f"'{self.tokens[at].text}' is the {last.replace('_', ' ')}")
            name = last
        if name is not None:
            end = at + 1
            if self.tag(end, "genitive") is not None and not self.short_be(end):  # "the T-junction's main road"
                return None
            self.last_landmark = name
            if self.tag(end, "preposition") in ("of", "on", "at", "in"):  # "the stop line of the driveway"
                after = self.skip_determiner(end + 1)
                wanted = "driveway" if name == "stop_line" else "road"
                end = after + 1 if self.tag(after, "area") == wanted and whose is None else end
            return name, end, whose, False
        if self.tag(at, "mouth") and self.tag(at - 1, "possessive") and self.last_area is not None:
            return "mouth", at + 1, None, False  # "goes down the driveway and turns right at its end"
        if self.tag(at, "mouth"):
            after = self.skip_determiner(at + 1 + (self.tag(at + 1, "preposition") == "of"))
            after += self.tag(after, "side") is not None
            if self.tag(after, "area") == "driveway" and after > at + 1:
                return "mouth", after + 1, whose, False
            return None
        at += self.tag(at, "side") is not None or self.tag(at, "same") is not None
        if self.tag(at, "area") == "driveway":
            end, self.last_area = at + 1, "driveway"
            if self.tag(end, "mouth"):
                return "mouth", end + 1, whose, False
            return "turn", end, whose, True
        return None

    def place(self, at: int) -> tuple[Place, int] | None:
        """Read a place: ``12 m behind the stop line``, ``just before it``, ``at the stop line``."""
        start = at
        at, amount = self._amount(at)
        just = False
        if amount is None:
            at = start
            if self.tag(at, "adverb") == "just" and self.tag(at + 1, "relation") in ("before", "behind"):
                just, at = True, at + 1
            elif self.tag(at, "adverb") in ("exact", "just") and (
                self.tag(at + 1, "preposition") == "at" or self.tag(at + 1, "relation") == "ahead"
            ):
                at += 1
        arrives = amount is not None and amount.dimension == "time" and self.tag(at, "preposition") == "at"
        relation, at = ("from", at + 1) if arrives else self._relation(at, amount is not None)
        if relation is None:
            return None
        if just:
            relation = "just_before"
        return self._place_target(start, at, relation, amount)

    def _amount(self, at: int) -> tuple[int, Quantity | None]:
        """Step over "at a distance of about" to a length or a time."""
        out = self.tokens[at].text.lower() == "from" and self._is_point(at + 1)
        if self.tag(at, "preposition") in ("at", "with", "in", "on") or out:
            at += 1
            at += self._is_point(at)
            at += self.tag(at, "determiner") == "definite" and self.tokens[at + 1].quantity is not None
            at += self.tag(at, "adverb") == "filler" and self.tokens[at].text.lower().split()[-1] in _SPOTS
            if self.tag(at, "measure") in ("time", "length") and self.tokens[at + 1].quantity is not None:
                return at + 2, self.tokens[at + 1].quantity  # "at TTA 3 s to the stop line"
        elif self.tag(at, "preposition") == "to" and self.tokens[at + 1].quantity is not None:
            at += 1  # "and the van [comes] to 8 m from the stop line"
        if (measured := self.measured(at)) is not None and measured[0] in ("length", "time", "headway"):
            return measured[2], measured[1]
        at += self.tag(at, "determiner") == "definite" and self.tag(at + 2, "mark_noun") is not None
        at = self.skip_hedges(at)
        quantity = self.tokens[at].quantity if at < len(self.tokens) else None
        if quantity is None or quantity.dimension not in ("length", "time"):
            return at, None
        return at + 1, quantity

    def _is_point(self, at: int) -> bool:
        """Whether "a point" stands in front of an amount: "at a point 30 m before the stop line"."""
        named = self.tag(at, "adverb") == "filler" and self.tokens[at].text.lower().startswith(("a ", "the "))
        return named and self.tokens[at + 1].quantity is not None

    def measured(self, at: int) -> tuple[str, Quantity, int] | None:
        """Read "a rate of 3 m/s^2", "a distance of 12 m": measure, amount, position after it."""
        at = self.skip_hedges(self.skip_determiner(at)) if self.tag(at, "adverb") != "just" else at
        at += self.tag(at, "starting") is not None and self.tag(at + 1, "measure") is not None
        measure = self.tag(at, "measure")
        if measure is None or self.tag(at + 1, "preposition") != "of":
            return None
        at += 2
        at = self.skip_hedges(at)
        quantity = self.tokens[at].quantity
        if quantity is None:
            return None
        self.check_measure(measure, quantity)
        return measure, quantity, at + 1

    def check_measure(self, measure: str, quantity: Quantity) -> None:
        """Refuse "a distance of 5 s"."""
        expected = MEASURE_DIMENSION[measure]
        gap_in_time = measure == "length" and quantity.dimension == "time"
        if quantity.dimension != expected and not gap_in_time:
            raise self.refuse(
                f"a {measure if measure != 'rate' else 'rate of acceleration'} cannot be in {quantity.dimension} units",
                quantity.span,
                f"an amount of {expected}",
            )
        if gap_in_time:
            raise self.refuse("a distance cannot be a time", quantity.span, "metres or feet", "write 'time to arrival'")

    def _relation(self, at: int, has_amount: bool) -> tuple[Relation | None, int]:
        reaching = has_amount and self.verb(at + 1, "reach") is not None
        if reaching and (self.tag(at, "link") == "to" or self.tag(at, "preposition") == "to"):
            return "from", at + 2  # "3 s to reach the stop line"
        if reaching and self.tag(at, "relation") in ("before", "from") and "ing" in self.tokens[at + 1].forms:
            return "before", at + 2  # "5 m before reaching the conflict point", "3 s from reaching it"
        at = self._after_mark(at) if has_amount else at
        relation = self.tag(at, "relation")
        if relation:
            at += 1
            if has_amount and relation == "from" and self.tag(at, "relation") in ("from", "before"):  # "away before"
                at += 1
            return cast(Relation, relation), at
        if has_amount and self.tag(at, "direction") == "left":  # "has 12 m left before the stop line"
            at += 1
            if self.tag(at, "relation") == "before" or self.tag(at, "link") in ("to", "until"):
                return "from", at + 1
            return None, at
        preposition = self.tag(at, "preposition")
        second = not has_amount and self.tokens[at].text.lower() == "second" and self.tag(at - 1, "be") is not None
        if second and self.tokens[at + 1].tags.keys() & {"end", "comma", "colon"}:
            return "behind", at + 1  # "our vehicle is second:"
        timed = has_amount and preposition == "at" and self.tag(at - 2, "preposition") == "of"
        if timed and self.tokens[at - 1].tags.get("quantity") == "time":
            return "from", at + 1  # "a time to arrival of 9 s at the conflict point"
        if (has_amount and preposition in ("to", "of")) or (has_amount and self.tag(at, "link") == "to"):
            return "from", at + 1
        if has_amount and preposition == "out" and self.tokens[at].text.lower() == "from":
            return "from", at + 1
        as_far_as = self.tag(at, "as_far_as") is not None or self.tag(at, "link") == "until"
        if has_amount and as_far_as and self._names_a_landmark(at + 1):
            return "from", at + 1  # "has 12 m until the stop line", "has 12 m up to it"
        if not has_amount and preposition in ("at", "on") and not self.tokens[at].text.lower().startswith("along"):
            return "at", at + 1
        return None, at

    def _names_a_landmark(self, at: int) -> bool:
        at += bool(self.tokens[at].tags.keys() & {"determiner", "possessive"})
        return self.tag(at, "landmark") is not None

    def _after_mark(self, at: int) -> int:
        """Step over "mark" in "the 24 m mark before the conflict point"."""
        return at + 1 if self.tag(at, "mark_noun") and self.tag(at + 1, "relation") else at

    def _place_target(
        self, start: int, at: int, relation: Relation, amount: Quantity | None
    ) -> tuple[Place, int] | None:
        if found := self.landmark(at):
            name, end, whose, vague = found
            if relation == "at" and vague:  # "on the driveway" is an area
                return None
            if amount is None and relation not in ("at", "just_before"):
                return None
            if name == "mouth":
                name, vague = "turn", True
            return Place(relation, name, amount, self.span(start, end), whose, vague), end
        if relation in ("at", "just_before"):
            return None
        phrase = self.noun_phrase(at)
        if phrase is None:
            if amount is not None and relation in ("ahead", "behind") and self.subject is not None:
                return Place(relation, 1 - self.subject, amount, self.span(start, at)), at  # "12 m ahead"
            words = self.tokens[at - 1].text.lower()
            alone = words in ("second", "ahead", "in front", "behind") or not words.endswith(("of", "behind", "ahead"))
            if alone and amount is None and self.subject is not None and self._ends_here(at):  # "is ahead at 8 m/s"
                return Place(relation, 1 - self.subject, None, self.span(start, at)), at
            return None
        if (
            phrase.kind == "pronoun"
            and relation in ("past", "from", "before")
            and amount is None
            and self._finite_after(phrase)
        ):
            return None  # "after it has stopped, ...", "till it stops", "slows down before it stops"
        if phrase.kind == "pronoun":
            return self._pronoun_target(start, phrase, relation, amount)
        if amount is None and relation not in ("behind", "ahead"):
            return None
        by = self.tokens[phrase.end + 1].quantity if self.tag(phrase.end, "preposition") == "by" else None
        if amount is None and by is not None and by.dimension == "length":  # "is ahead of the ego by 15 m"
            return Place(relation, self.resolve(phrase), by, self.span(start, phrase.end + 2)), phrase.end + 2
        return Place(relation, self.resolve(phrase), amount, self.span(start, phrase.end)), phrase.end

    def _finite_after(self, phrase: NounPhrase) -> bool:
        token = self.tokens[phrase.end]
        return bool(token.tags.keys() & {"be", "auxiliary"} or token.forms & {"s"})

    def _ends_here(self, at: int) -> bool:
        tags = self.tokens[at].tags.keys()
        return bool(tags & {"end", "comma", "colon", "preposition", "link"}) and self.tag(at, "preposition") != "of"

    def _pronoun_target(
        self, start: int, phrase: NounPhrase, relation: Relation, amount: Quantity | None
    ) -> tuple[Place, int]:
        """Read "5 m before it" (the last place named) and "ahead of it" (the other vehicle)."""
        span = self.span(start, phrase.end)
        words = span.excerpt(self.text)
        ahead = {"behind": 1 - self.subject, "ahead": self.subject}.get(relation) if self.subject is not None else None
        if amount is not None and ahead is not None and ahead == self.leader and self.subject is not None:
            return Place(relation, 1 - self.subject, amount, span), phrase.end  # "... and the ego is 25 m behind it"
        if relation in ("before", "from") and self.last_landmark and amount is not None:
            self.assume(f"'{words}' is measured from the {self.last_landmark.replace('_', ' ')}")
            return Place(relation, self.last_landmark, amount, span), phrase.end
        spoken_of = self.subject is not None and self.leader == 1 - self.subject and not self.last_landmark
        if relation == "from" and amount is not None and spoken_of and self.subject is not None:
            return Place("from", 1 - self.subject, amount, span), phrase.end  # "... as soon as the ego is 10 m from it"
        if relation in ("behind", "ahead") and self.subject is not None and (amount is None or not self.last_landmark):
            return Place(relation, 1 - self.subject, amount, span), phrase.end
        only = self.last_landmark is None and self.last_area != "driveway"  # no place was named that "it" could be
        if relation == "from" and only and self.subject is not None and amount is not None:
            self.assume(f"'{words}' is measured from the other vehicle")
            return Place(relation, 1 - self.subject, amount, span), phrase.end
        raise self.refuse("it is not clear what this refers to", phrase.span, fix="name the vehicle or the place")

    # -- areas and headings -----------------------------------------------------------------------------------------
    def area(self, at: int) -> tuple[Area, int] | None:
        """Read an area with its preposition: ``onto the road travelling westbound``, ``across the ego's path``."""
        roles = {"on": "on", "in": "on", "at": "on", "into": "into", "to": "into", "out": "from", "across": "across"}
        preposition = self.tag(at, "preposition")
        if preposition not in roles:
            return None
        found = self.area_noun(at + 1, roles[preposition])
        if found is None and preposition == "into" and self.tag(at + 1, "pronoun") and self.last_area is not None:
            span = self.span(at, at + 2)
            if self.last_into not in (None, self.last_area):
                raise self.refuse("it is not clear what this refers to", span, "the road or the driveway", "name it")
            self.assume(f"'{span.excerpt(self.text)}' is the {self.last_area}")
            return Area("into", cast("AreaKind", self.last_area), span), at + 2
        if found is None:
            return None
        area, end = found
        if self.tokens[at].text.lower() in ("towards", "toward"):
            area = replace(area, role="towards")
        if preposition == "at" and area.kind == "lane":
            return None
        if area.role == "into" and area.kind != "lane":
            self.last_into = area.kind
        return area, end

    def area_noun(self, at: int, role: str) -> tuple[Area, int] | None:
        """Read the noun of an area with what describes it."""
        start = at
        owner = self.possessor(at)
        whose, at = owner if owner else (None, self.skip_determiner(at))
        if role == "across" and owner and self.tag(start, "possessive"):
            whose = 1 - owner[0]  # "turns left across its path": nobody crosses its own
        heading = side = None
        oncoming = False
        if self.tag(at, "landmark") == "intersection" and self.tag(at + 1, "genitive") is not None:
            at += 2  # "the T-junction's main road"
        while True:
            if self.tag(at, "heading"):
                heading = self.tag(at, "heading")
            elif self.tag(at, "side"):
                side = self.tag(at, "side")
            elif self.tag(at, "actor_adjective") == "oncoming":
                oncoming = True
            elif self.tag(at, "area_adjective") or self.tag(at, "actor_adjective") == "plain" or self._straight(at):
                pass
            elif self.tag(at, "same") and whose is None and self.subject is not None:
                whose = 1 - self.subject
            else:
                break
            at += 1
        kind = self.tag(at, "area")
        if kind is None:
            return None
        end = at + 1
        if kind != "lane":
            self.last_area = kind
        if self.tag(at - 1, "same") and kind != "lane":
            whose = None
        elif (
            self.tag(at - 1, "same") and self.tag(end, "preposition") == "as" and (phrase := self.noun_phrase(end + 1))
        ):
            end = phrase.end
            whose = self.resolve(phrase)
        crossroads = self.skip_determiner(end + 1)
        of_junction = (
            self.tag(end, "preposition") in ("of", "at") and self.tag(crossroads, "landmark") == "intersection"
        )
        if of_junction and self.tag(crossroads + 1, "genitive") is None and role != "across":
            end = crossroads + 1  # "the minor road of a T-junction"
        if kind == "lane" and whose is None and self.tag(end, "preposition") == "of":
            phrase = self.noun_phrase(end + 1)
            if phrase is not None and phrase.kind != "pronoun":  # "across the path of the ego"
                whose, end = self.resolve(phrase), phrase.end
        road = self.skip_determiner(end + 1)
        if kind == "lane" and self.tag(end, "preposition") in ("of", "on") and self.tag(road, "area") == "road":
            end = road + 1  # "the westbound lane of the road"
        if kind == "lane" and whose is None and (used := self._used_lane(end)):
            whose, end = used
        wanted_by = None
        if kind == "lane" and (wanted := self._wanted_lane(end)):
            wanted_by, end = wanted
        inner = self.tag(end + 1, "heading") if self.tokens[end].text == "(" else None
        if inner is not None and self.tokens[end + 2].text == ")" and heading in (None, inner):
            heading, end = inner, end + 3  # "the main road (eastbound)"
        if (after := self.heading(end)) and not after[2]:
            if heading and heading != after[0]:
                raise self.refuse("two headings contradict each other", self.span(start, after[1]))
            heading, end = after[0], after[1]
        span = self.span(start, end)
        known_role, known_kind = cast("AreaRole", role), cast("AreaKind", kind)
        return Area(known_role, known_kind, span, heading, side, whose, oncoming, wanted_by), end

    def _straight(self, at: int) -> bool:
        """Whether "straight" only describes a road: "on a straight road"."""
        return self.tag(at, "direction") == "straight" and self.tag(at + 1, "area") is not None

    def _used_lane(self, at: int) -> tuple[int, int] | None:
        """Read "that the ego is using" and "which the ego drives in"; return who does and the position after it."""
        phrase = self.noun_phrase(at + 1) if self.tag(at, "link") == "that" else None
        if phrase is None or phrase.kind == "pronoun":
            return None
        at = phrase.end + (self.tag(phrase.end, "be") is not None)
        words, into = self.tokens[at].text.lower().split(), self.tag(at + 1, "preposition") in ("in", "on")
        if self.verb(at, "drive") is None or not (into or words[0].startswith(("us", "occup"))):
            return None
        end = at + 1 + into
        closed = self.tokens[end].tags.keys() & {"end", "comma"} or self.tag(end, "link") == "and"
        return (self.resolve(phrase), end) if closed else None

    def _wanted_lane(self, at: int) -> tuple[int, int] | None:
        """Read "that the ego wants to turn into"; return who wants it and the position after it."""
        phrase = self.noun_phrase(at + 1)
        if phrase is None or self.tag(at, "link") != "that" or not self.verb(phrase.end, "want"):
            return None
        turns = self.tag(phrase.end + 1, "link") == "to" and self.verb(phrase.end + 2, "turn", "pull_out")
        if not turns or self.tag(phrase.end + 3, "preposition") != "into":
            return None
        return self.resolve(phrase), phrase.end + 4

    def heading(self, at: int) -> tuple[str, int, bool] | None:
        """Read a heading: ``travelling westbound``, ``in the westbound direction``; True last for "from the east"."""
        start = at
        headed = self.tokens[at].text.lower() == "headed"
        if (self.verb(at, "drive", "go") and "ing" in self.tokens[at].forms) or self.tag(at, "bound_word") or headed:
            at += 1
        came_from = self.tag(at, "preposition") == "out" and self.tokens[at].text.lower() == "from"
        if came_from or self.tag(at, "preposition") in ("to", "in", "on"):
            at = self.skip_determiner(at + 1)
            at += self.tag(at, "direction_noun") is not None and not came_from  # "in direction west"
        else:
            at = self.skip_determiner(at) if self.tag(at + 2, "direction_noun") else at
        value = self.tag(at, "heading")
        if value is None:
            return None
        if self.tag(at + 1, "area") or (self.noun_phrase(start) is not None):
            return None
        at += 1
        if self.tag(at, "direction_noun"):
            at += 1
        return (OPPOSITE[value] if came_from else value), at, came_from
