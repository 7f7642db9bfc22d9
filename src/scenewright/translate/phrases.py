"""Reads phrases at a position of the token list: noun phrases, places, areas, headings, measures. No clause structure.

What enters: tagged tokens and a position. What leaves: what the phrase says and the position after it, or None.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import cast

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.translate.events import SAY_IT_ALONE, Area, Place, Relation
from scenewright.translate.references import NounPhrase, Referents
from scenewright.translate.tokens import Quantity, Token

OPPOSITE = {"N": "S", "S": "N", "E": "W", "W": "E"}
MEASURE_DIMENSION = {
    "length": "length",
    "time": "time",
    "headway": "time",
    "ttc": "time",
    "speed": "speed",
    "rate": "acceleration",
}


@dataclass(slots=True)
class Phrases:
    """Phrase readers over one token list."""

    text: str
    name: str
    tokens: list[Token]
    refs: Referents
    last_landmark: str | None = None
    subject: int | None = None
    assumptions: list[str] = field(default_factory=list)
    described: list[tuple[str, int, Span]] = field(
        default_factory=list
    )  # ("oncoming", actor, span), ("W", actor, span)

    # -- helpers ----------------------------------------------------------------------------------------------------
    def tag(self, at: int, tag: str) -> str | None:
        """Return the value of `tag` for the token at `at`, or None."""
        return self.tokens[at].tags.get(tag) if at < len(self.tokens) else None

    def verb(self, at: int, *values: str) -> str | None:
        """Return the verb at `at` if it is one of `values` (any, where none are given)."""
        verb = self.tag(at, "verb")
        return verb if verb and (not values or verb in values) else None

    def span(self, start: int, end: int) -> Span:
        """Return the stretch of text of tokens ``[start, end)``."""
        return self.tokens[start].span.union(self.tokens[max(start, end - 1)].span)

    def refuse(self, message: str, span: Span, expected: str | None = None, fix: str | None = None) -> TranslationError:
        """Build the error for a stretch of the description."""
        return TranslationError(
            message,
            place=ErrorPlace(self.name, self.text, span),
            found=span.excerpt(self.text),
            expected=expected,
            fix=fix or (None if expected else SAY_IT_ALONE),
        )

    def skip_determiner(self, at: int) -> int:
        """Step over an article; "another" in front of a place is no article."""
        return at + 1 if self.tag(at, "determiner") not in (None, "another") else at

    # -- actors -----------------------------------------------------------------------------------------------------
    def noun_phrase(self, at: int) -> NounPhrase | None:
        """Read an actor's noun phrase without deciding who it is."""
        start, adjectives, heading = at, set[str](), None
        determiner = self.tag(at, "determiner")
        at += determiner is not None
        while True:
            if value := self.tag(at, "actor_adjective"):
                adjectives.add(value)
            elif (value := self.tag(at, "heading")) and heading is None:
                heading = value
            else:
                break
            at += 1
        if self.tag(at, "pronoun") and at == start:
            return NounPhrase(at + 1, "pronoun", None, None, adjectives, None, self.span(start, at + 1))
        for kind in ("ego", "hero"):
            if self.tag(at, kind):
                noun = self.tag(at + 1, "noun")
                words = self.tokens[at].text.lower().split()
                end = at + 1 + (noun is not None)
                last = words[-1] if words[-1] in ("car", "vehicle", "actor", "agent") else None
                return NounPhrase(end, kind, noun or last, determiner, adjectives, heading, self.span(start, end))
        noun = self.tag(at, "noun")
        if noun is None:
            return None
        if noun in ("driver", "motorist") and self.tag(at + 1, "preposition") in ("of", "in"):
            inner = self.noun_phrase(at + 2)
            if inner is not None and inner.kind != "pronoun":  # "the driver of the van"
                return replace(inner, span=self.span(start, inner.end))
        return NounPhrase(at + 1, "noun", noun, determiner, adjectives, heading, self.span(start, at + 1))

    def resolve(self, phrase: NounPhrase) -> int:
        """Say who `phrase` is, and keep what its adjectives say."""
        actor = self._who(phrase)
        self.described += [(each, actor, phrase.span) for each in sorted(phrase.adjectives & {"lead", "oncoming"})]
        if phrase.heading is not None:
            self.described.append((phrase.heading, actor, phrase.span))
        return actor

    def _who(self, phrase: NounPhrase) -> int:
        mentioned = {"ego": 0, "hero": 1}.get(phrase.kind) in self.refs.nouns
        if (phrase.kind == "ego" and phrase.determiner == "another") or (phrase.determiner == "another" and mentioned):
            raise self.refuse("there is more than one such vehicle here", phrase.span, "the ego and one other vehicle")
        if phrase.kind == "ego":
            return self.refs.ego(phrase.noun)
        if phrase.kind == "hero":
            return self.refs.hero(phrase.noun)
        if phrase.kind == "pronoun":
            if self.subject is None:
                raise self.refuse("it is not clear who this is", phrase.span, "the ego or the hero", "name the vehicle")
            return self.subject
        return self.refs.by_noun(phrase.noun or "", phrase.determiner, phrase.adjectives, phrase.span)

    def possessor(self, at: int) -> tuple[int, int] | None:
        """Read "its" or "the ego's"; return the actor and the position after it."""
        if self.tag(at, "possessive"):
            if self.subject is None:
                raise self.refuse("it is not clear whose this is", self.tokens[at].span, fix="name the vehicle")
            return self.subject, at + 1
        phrase = self.noun_phrase(at)
        if phrase and phrase.kind != "pronoun" and self.tag(phrase.end, "genitive") is not None:
            if self.short_be(phrase.end):
                return None
            return self.resolve(phrase), phrase.end + 1
        return None

    def short_be(self, at: int) -> bool:
        """Whether "'s" stands for "is" here: "the truck's 60 feet ahead", "the ego's heading west"."""
        if self.tag(at, "genitive") is None or at + 2 >= len(self.tokens):
            return False
        after = self.tokens[at + 1]
        if after.quantity is not None:
            return self.tag(at + 2, "measure") is None and self.tag(at + 2, "adverb") is None
        if self.tag(at + 1, "event_noun") or self.tag(at + 1, "measure"):
            return False
        finite = "ing" in after.forms or after.text.lower() in ("headed", "about")
        return finite or self.tag(at + 1, "preposition") is not None

    # -- places -----------------------------------------------------------------------------------------------------
    def landmark(self, at: int) -> tuple[str, int, int | None, bool] | None:
        """Read a landmark: name, position after it, whose it is, and whether a driveway stands for it."""
        owner = self.possessor(at)
        whose, at = owner if owner else (None, self.skip_determiner(at))
        if name := self.tag(at, "landmark"):
            self.last_landmark = name
            end = at + 1
            if name == "stop_line" and self.tag(end, "preposition") == "of":  # "the stop line of the driveway"
                after = self.skip_determiner(end + 1)
                end = after + 1 if self.tag(after, "area") == "driveway" else end
            return name, end, whose, False
        if self.tag(at, "mouth"):
            after = self.skip_determiner(at + 1 + (self.tag(at + 1, "preposition") == "of"))
            after += self.tag(after, "side") is not None
            if self.tag(after, "area") == "driveway" and after > at + 1:
                return "mouth", after + 1, whose, False
            return None
        at += self.tag(at, "side") is not None
        if self.tag(at, "area") == "driveway":
            end = at + 1
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
            elif self.tag(at, "adverb") in ("exact", "just") and self.tag(at + 1, "preposition") == "at":
                at += 1
        relation, at = self._relation(at, amount is not None)
        if relation is None:
            return None
        if just:
            relation = "just_before"
        return self._place_target(start, at, relation, amount)

    def _amount(self, at: int) -> tuple[int, Quantity | None]:
        """Step over "at a distance of about" to a length or a time."""
        if self.tag(at, "preposition") in ("at", "with", "in", "on"):
            at += 1
        if (measured := self.measured(at)) is not None and measured[0] in ("length", "time", "headway"):
            return measured[2], measured[1]
        at = self.skip_hedges(at)
        quantity = self.tokens[at].quantity if at < len(self.tokens) else None
        if quantity is None or quantity.dimension not in ("length", "time"):
            return at, None
        return at + 1, quantity

    def measured(self, at: int) -> tuple[str, Quantity, int] | None:
        """Read "a rate of 3 m/s^2", "a distance of 12 m": measure, amount, position after it."""
        at = self.skip_determiner(at)
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
        if (has_amount and preposition in ("to", "of")) or (has_amount and self.tag(at, "link") == "to"):
            return "from", at + 1
        if has_amount and preposition == "out" and self.tokens[at].text.lower() == "from":
            return "from", at + 1
        if not has_amount and preposition in ("at", "on") and not self.tokens[at].text.lower().startswith("along"):
            return "at", at + 1
        return None, at

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
                name = "turn_start"
            return Place(relation, name, amount, self.span(start, end), whose, vague), end
        if relation in ("at", "just_before"):
            return None
        phrase = self.noun_phrase(at)
        if phrase is None:
            if amount is not None and relation in ("ahead", "behind") and self.subject is not None:
                return Place(relation, 1 - self.subject, amount, self.span(start, at)), at  # "12 m ahead"
            alone = self.tokens[at - 1].text.lower() in ("ahead", "in front", "behind")
            if alone and amount is None and self.subject is not None and self._ends_here(at):  # "is ahead at 8 m/s"
                return Place(relation, 1 - self.subject, None, self.span(start, at)), at
            return None
        if phrase.kind == "pronoun":
            return self._pronoun_target(start, phrase, relation, amount)
        if amount is None and relation not in ("behind", "ahead"):
            return None
        return Place(relation, self.resolve(phrase), amount, self.span(start, phrase.end)), phrase.end

    def _ends_here(self, at: int) -> bool:
        tags = self.tokens[at].tags.keys()
        return bool(tags & {"end", "comma", "preposition", "link"}) and self.tag(at, "preposition") != "of"

    def _pronoun_target(
        self, start: int, phrase: NounPhrase, relation: Relation, amount: Quantity | None
    ) -> tuple[Place, int]:
        """Read "5 m before it" (the last place named) and "ahead of it" (the other vehicle)."""
        span = self.span(start, phrase.end)
        words = span.excerpt(self.text)
        if relation == "before" and self.last_landmark and amount is not None:
            self.assume(f"'{words}' is measured from the {self.last_landmark.replace('_', ' ')}")
            return Place(relation, self.last_landmark, amount, span), phrase.end
        if relation in ("behind", "ahead") and self.subject is not None and (amount is None or not self.last_landmark):
            return Place(relation, 1 - self.subject, amount, span), phrase.end
        raise self.refuse("it is not clear what this refers to", phrase.span, fix="name the vehicle or the place")

    def assume(self, sentence: str) -> None:
        """Note something that was inferred."""
        if sentence not in self.assumptions:
            self.assumptions.append(sentence)

    def skip_hedges(self, at: int) -> int:
        """Step over "exactly" and "about"; the latter is noted."""
        while (hedge := self.tag(at, "adverb")) in ("about", "exact", "just"):
            if hedge == "about":
                self.assume(f"'{self.tokens[at].text} {self.tokens[at + 1].text}' is read as that very amount")
            at += 1
        return at

    # -- areas and headings -----------------------------------------------------------------------------------------
    def area(self, at: int) -> tuple[Area, int] | None:
        """Read an area with its preposition: ``onto the road travelling westbound``, ``across the ego's path``."""
        roles = {"on": "on", "in": "on", "at": "on", "into": "into", "to": "into", "out": "from", "across": "across"}
        preposition = self.tag(at, "preposition")
        if preposition not in roles:
            return None
        found = self.area_noun(at + 1, roles[preposition])
        if found is None:
            return None
        area, end = found
        if preposition == "at" and area.kind != "driveway":
            return None
        return area, end

    def area_noun(self, at: int, role: str) -> tuple[Area, int] | None:
        """Read the noun of an area with what describes it."""
        start = at
        owner = self.possessor(at)
        whose, at = owner if owner else (None, self.skip_determiner(at))
        heading = side = None
        oncoming = False
        while True:
            if self.tag(at, "heading"):
                heading = self.tag(at, "heading")
            elif self.tag(at, "side"):
                side = self.tag(at, "side")
            elif self.tag(at, "actor_adjective") == "oncoming":
                oncoming = True
            elif self.tag(at, "same") and whose is None and self.subject is not None:
                whose = 1 - self.subject
            else:
                break
            at += 1
        kind = self.tag(at, "area")
        if kind is None:
            return None
        end = at + 1
        if self.tag(at - 1, "same"):
            if kind != "lane":
                return None
            if self.tag(end, "preposition") == "as" and (phrase := self.noun_phrase(end + 1)):
                end = phrase.end
                whose = self.resolve(phrase)
        wanted_by = None
        if kind == "lane" and (wanted := self._wanted_lane(end)):
            wanted_by, end = wanted
        if (after := self.heading(end)) and not after[2]:
            if heading and heading != after[0]:
                raise self.refuse("two headings contradict each other", self.span(start, after[1]))
            heading, end = after[0], after[1]
        span = self.span(start, end)
        return Area(cast("object", role), cast("object", kind), span, heading, side, whose, oncoming, wanted_by), end  # type: ignore[arg-type]

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
        if (self.verb(at, "drive", "go") and "ing" in self.tokens[at].forms) or self.tag(at, "bound_word"):
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
