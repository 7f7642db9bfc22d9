"""The tokens of one text, with who is named in them, its clauses, and which tokens have told their part.

What enters: tokens, names, clauses. What leaves: short questions about them, for all readers of the gist. It reads no
fact itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from scenewright.errors import Place, Span, TranslationError
from scenewright.translate.events import HERO_ID
from scenewright.translate.tokens import Token

_NOTHING: Mapping[str, str] = {}
# What the other vehicle does, or what somebody else must not do.
DEEDS = frozenset(
    ["brake", "stop", "accelerate", "pass", "complete", "yield", "not_yield", "turn", "pull_out", "wait", "reach",
     "enter"]
)  # fmt: skip
FIX = "say it in a sentence of its own, or in other words; nothing is guessed"


@dataclass(slots=True)
class Names:
    """Who each token stands for.

    Attributes
    ----------
    actors
        Actor by index of the naming token.
    pronouns
        Indices of "it", "its", "he", ... : who is meant follows from the clause.
    both
        Indices of words for both vehicles.
    relative
        What a name says by itself, by its index: ``lead`` in "the one in front", ``left`` in "the left turner".
    kinds
        Kinds of vehicle that the hero is called: more than one kind is more than one vehicle.
    spoken
        Whether the ego is only "I" and "we", so that "it" is the other vehicle.
    driven
        Whether somebody is said to drive the ego: "my pupil drives the car under test".
    guessed
        A word that is not known and was taken for the other vehicle.
    unclear
        Where a name may be either vehicle's: "our car ... the car".
    """

    actors: dict[int, int] = field(default_factory=dict)
    pronouns: set[int] = field(default_factory=set)
    both: set[int] = field(default_factory=set)
    relative: dict[int, str] = field(default_factory=dict)
    kinds: set[str] = field(default_factory=set)
    spoken: bool = False
    driven: bool = False
    guessed: str | None = None
    unclear: int | None = None


@dataclass(slots=True)
class Clause:
    """A stretch of tokens that says one thing.

    Attributes
    ----------
    link
        What ties it to the text: ``main``, ``and``, ``colon``, ``when``, ``then``, ``moment``, ``before``, ``after``,
        ``until``, ``that``.
    subject
        The actor that it is about, where known; `named` in this very clause, or carried over.
    both, pair
        Whether it is about both vehicles; whether it names both as its subject.
    aside
        Whether it is about something else: "the courtesy did not last".
    labels
        What stands in front of it: ``start``, ``trigger``, ``deed``, ``who``, ``none``.
    """

    start: int
    end: int
    sentence: int
    link: str = "main"
    subject: int | None = None
    named: bool = False
    both: bool = False
    aside: bool = False
    pair: bool = False
    labels: list[str] = field(default_factory=list)

    @property
    def inside(self) -> range:
        """The indices of its tokens."""
        return range(self.start, self.end)


@dataclass(frozen=True, slots=True)
class Deed:
    """One thing that a vehicle does, or a moment of the ego.

    Attributes
    ----------
    kind
        ``brake``, ``stop``, ``wait``, ``accelerate``, ``go``, ``keep`` (its speed), ``pass``, ``complete`` (its turn),
        ``turn``, ``yield``, ``not_yield``, ``not_stop``, ``let``; of the ego ``before``, ``after``, ``let_reach``.
    landmark
        What is passed; ``same`` for "before the ego does".
    """

    kind: str
    at: int
    clause: Clause
    span: Span
    landmark: str | None = None
    actor: int = HERO_ID


@dataclass(slots=True)
class Words:
    """One text, and what was found out about it so far."""

    text: str
    name: str
    tokens: list[Token]
    names: Names = field(default_factory=Names)
    clauses: list[Clause] = field(default_factory=list)
    used: set[int] = field(default_factory=set)

    def tags(self, at: int) -> Mapping[str, str]:
        """Return the tags of a token; none outside of the text."""
        return self.tokens[at].tags if 0 <= at < len(self.tokens) else _NOTHING

    def tag(self, at: int, key: str) -> str | None:
        """Return one tag of a token."""
        return self.tags(at).get(key)

    def word(self, at: int) -> str:
        """Return a token in lower case; nothing outside of the text."""
        return self.tokens[at].text.lower() if 0 <= at < len(self.tokens) else ""

    def has(self, stretch: Iterable[int], *keys: str) -> bool:
        """Whether a token of the stretch has one of these tags."""
        wanted = frozenset(keys)
        return any(not wanted.isdisjoint(self.tags(at)) for at in stretch)

    def where(self, stretch: Iterable[int], key: str, *values: str) -> int | None:
        """Return the first token of the stretch whose tag has one of the values (any value where none is given)."""
        return next(
            (at for at in stretch if key in self.tags(at) and (not values or self.tags(at)[key] in values)), None
        )

    def verbs(self, stretch: Iterable[int]) -> set[str]:
        """Return the verbs of a stretch."""
        return {self.tags(at)["verb"] for at in stretch if "verb" in self.tags(at)}

    def named(self, stretch: Iterable[int]) -> int | None:
        """Return the actor that is named first in a stretch."""
        return next((self.names.actors[at] for at in stretch if at in self.names.actors), None)

    def in_brackets(self, at: int) -> tuple[int, int] | None:
        """Return where brackets end that hold nothing but a name, and whose: "(the other car)"."""
        if self.word(at) != "(":
            return None
        end = next((i for i in range(at + 2, at + 6) if self.word(i) == ")"), None)
        if end is None or end - 1 not in self.names.actors or self.has(range(at + 1, end), "quantity", "verb"):
            return None
        return end + 1, self.names.actors[end - 1]

    def skip(self, at: int, keys: frozenset[str], step: int = 1) -> int:
        """Step over tokens that have one of these tags and name nobody; return where the others begin."""
        while 0 <= at < len(self.tokens) and self.tags(at).keys() & keys:
            if at in self.names.actors or at in self.names.pronouns:
                break
            at += step
        return at

    def landmark_before(self, at: int) -> int | None:
        """Return where the last landmark before a token stands: what "that point" means."""
        return self.where(range(at - 1, -1, -1), "landmark")

    def referred(self, at: int) -> str | None:
        """Return what "that line", "the point", "there" mean: the landmark of that kind, else the one named last."""
        back = self.landmark_before(at)
        if back is None:
            return None
        kinds = {"line": "stop_line", "point": "conflict_point"}
        meant = kinds.get(self.word(at).split()[-1]) if self.word(at) else None
        named = {self.tags(i)["landmark"] for i in range(at) if "landmark" in self.tags(i)}
        return meant if meant in named else self.tags(back)["landmark"]

    def sentence_at(self, at: int) -> range:
        """Return the tokens of the sentence around a token, without what ends it."""
        first = next((i + 1 for i in range(at - 1, -1, -1) if "end" in self.tags(i)), 0)
        return range(first, next((i for i in range(at, len(self.tokens)) if "end" in self.tags(i)), len(self.tokens)))

    def who_begins(self, clause: Clause) -> int | None:
        """Return what begins in a clause that says nothing else: "The test begins", "We start"."""
        told = [at for at in clause.inside if "determiner" not in self.tags(at)]
        begins = len(told) == 2 and (self.tag(told[1], "verb") == "begin" or self.word(told[1]) in ("opens", "opened"))
        return told[0] if begins else None

    def sentence(self, clause: Clause) -> list[Clause]:
        """Return the clauses of the same sentence."""
        return [each for each in self.clauses if each.sentence == clause.sentence]

    def span(self, clause: Clause) -> Span:
        """Return where a clause stands in the text."""
        return self.tokens[clause.start].span.union(self.tokens[clause.end - 1].span)

    def refuse(self, message: str, span: Span | None = None, expected: str | None = None) -> TranslationError:
        """Return the error for a stretch of the text, or for all of it."""
        place = span or Span(0, len(self.text))
        found = " ".join(place.excerpt(self.text).split())[:80]
        return TranslationError(
            message, place=Place(self.name, self.text, place), found=found, expected=expected, fix=FIX
        )
