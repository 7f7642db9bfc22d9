"""Reads noun phrases that name an actor, at a position of the token list, and says who is meant.

What enters: tagged tokens and a position. What leaves: the noun phrase or its actor and the position after it, or None.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.translate.events import SAY_IT_ALONE
from scenewright.translate.references import NounPhrase, Referents
from scenewright.translate.tokens import Token

_ONES = {"left_turner": "turns_left", "right_turner": "turns_right", "front_one": "lead", "rear_one": "rear"}


@dataclass(slots=True)
class NounPhrases:
    """Readers of actors over one token list."""

    text: str
    name: str
    tokens: list[Token]
    refs: Referents
    last_landmark: str | None = None
    last_area: str | None = None
    last_into: str | None = None  # the last one that a vehicle goes into
    last_named: tuple[int, int] | None = None  # an actor, and the position after its name
    subject: int | None = None
    leader: int | None = None  # who was told to be ahead, where a clause before in the sentence speaks of the other one
    assumptions: list[str] = field(default_factory=list)
    onsets: list[tuple[tuple[str, ...], Span]] = field(default_factory=list)  # kinds of phase that a deed named can be
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

    def refuse(
        self,
        message: str,
        span: Span,
        expected: str | None = None,
        fix: str | None = None,
        kind: type[TranslationError] = TranslationError,
    ) -> TranslationError:
        """Build the error for a stretch of the description."""
        return kind(
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
        """Read an actor's noun phrase, with what stands right after its noun, without deciding who it is."""
        phrase = self._plain_noun_phrase(at)
        if phrase is None or phrase.kind == "pronoun":
            return phrase
        phrase = self._named_again(phrase)
        if self.tokens[phrase.end].text.lower() in ("itself", "himself", "herself"):  # "while the van itself is ..."
            phrase = replace(phrase, end=phrase.end + 1)
        where = self.tag(phrase.end, "relation")
        alone = self.tokens[phrase.end].text.lower() in ("ahead", "in front", "behind") if where else False
        if where == "ahead" and not alone and phrase.kind == "noun":
            phrase = self._ahead_of(phrase)
        after = self.tokens[phrase.end + 1].tags.keys() if alone else set()
        finite = bool(after & {"be", "auxiliary", "genitive", "negation", "falls"}) or (
            "verb" in after and not self.tokens[phrase.end + 1].forms & {"ing"}
        )
        before = self.tokens[at - 1].tags.keys() if at else set()
        closes = (
            bool(after & {"comma", "end"})
            and bool(before & {"relation", "preposition"} and "link" not in before)
            and where == "ahead"
        )
        if alone and where and (finite or closes) and (phrase.determiner == "definite" or phrase.kind == "hero"):
            adjectives = phrase.adjectives | {"lead" if where == "ahead" else "rear"}  # "the car in front brakes"
            phrase = replace(phrase, end=phrase.end + 1, adjectives=adjectives)
        return replace(phrase, span=self.span(at, phrase.end))

    def _ahead_of(self, phrase: NounPhrase) -> NounPhrase:
        """Read "the car ahead of it brakes", where what follows shows that this is the whole name."""
        other = self._plain_noun_phrase(phrase.end + 1)
        if other is None or other.kind not in ("pronoun", "ego"):
            return phrase
        after = self.tokens[other.end]
        if not (after.tags.keys() & {"be", "auxiliary", "negation"} or after.forms & {"s", "base", "ed"}):
            return phrase
        if other.kind == "ego":
            self.resolve(other)
        return replace(phrase, end=other.end, adjectives=phrase.adjectives | {"lead"})

    def _named_again(self, phrase: NounPhrase) -> NounPhrase:
        """Read "the subject vehicle (SV)" and "a van (the hero)" as one name."""
        at = phrase.end
        if self.tokens[at].text != "(":
            return phrase
        other = self._plain_noun_phrase(at + 1)
        if other is None or other.kind == "pronoun" or self.tokens[other.end].text != ")":
            return phrase
        if "ego" in (phrase.kind, other.kind) and phrase.kind != other.kind:
            if "hero" in (phrase.kind, other.kind):
                return phrase
            noun = phrase.noun if phrase.kind == "noun" else other.noun
            return replace(phrase, end=other.end + 1, kind="ego", noun=noun)
        if "hero" in (phrase.kind, other.kind):
            noun = phrase.noun if phrase.kind == "noun" else other.noun
            return replace(phrase, end=other.end + 1, kind="hero", noun=noun, adjectives=phrase.adjectives)
        return phrase

    def _plain_noun_phrase(self, at: int) -> NounPhrase | None:
        start, adjectives, heading = at, set[str](), None
        if self.tag(at, "latter") is not None:
            return NounPhrase(at + 1, "latter", None, "definite", adjectives, None, self.span(start, at + 1))
        determiner = self.tag(at, "determiner")
        at += determiner is not None
        while True:
            if (value := self.tag(at, "actor_adjective")) and not self._is_noun_here(at):
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
        if self.tag(at, "latter") and determiner == "definite" and self.last_named is not None:
            return NounPhrase(
                at + 1, self.tag(at, "latter") or "", None, determiner, adjectives, None, self.span(start, at + 1)
            )
        noun = self.tag(at, "noun")
        if noun is None:
            return self._lead_alone(start, at, determiner, adjectives, heading)
        if noun in _ONES:
            adjectives.add(_ONES[noun])
        if self.tag(at + 1, "noun") in ("driver", "motorist"):  # "the pickup driver"
            at += 1
        if determiner == "our":
            return NounPhrase(at + 1, "ego", noun, determiner, adjectives, heading, self.span(start, at + 1))
        if noun in ("driver", "motorist") and self.tag(at + 1, "preposition") in ("of", "in"):
            inner = self._plain_noun_phrase(at + 2)
            if inner is not None and inner.kind != "pronoun":  # "the driver of the van"
                return replace(inner, span=self.span(start, inner.end))
        return NounPhrase(at + 1, "noun", noun, determiner, adjectives, heading, self.span(start, at + 1))

    def _lead_alone(
        self, start: int, at: int, determiner: str | None, adjectives: set[str], heading: str | None
    ) -> NounPhrase | None:
        """Read "the lead brakes" and "ego and lead": the lead vehicle."""
        last = self.tokens[at - 1].text.lower() if at > start else ""
        after = self.tokens[at].tags.keys() & {"colon", "be", "auxiliary", "genitive", "comma", "end", "preposition"}
        if last != "lead" or not (after or self.tokens[at].forms & {"s"} or "link" in self.tokens[at].tags):
            return None
        return NounPhrase(at, "noun", "vehicle", determiner, adjectives, heading, self.span(start, at))

    def _is_noun_here(self, at: int) -> bool:
        """Whether a word that can be an adjective ("the target", "the target vehicle") names the actor itself."""
        names = {"ego", "hero", "noun"}
        if not self.tokens[at].tags.keys() & names:
            return False
        return not self.tokens[at + 1].tags.keys() & (names | {"actor_adjective"})

    def resolve(self, phrase: NounPhrase) -> int:
        """Say who `phrase` is, and keep what its adjectives say."""
        known = set(self.refs.nouns)
        actor = self._who(phrase)
        self.last_named = actor, phrase.end
        if phrase.noun in ("left_turner", "right_turner"):
            self.refs.nouns.setdefault(actor, set()).add(phrase.noun)
        self.described += [
            (each, actor, phrase.span)
            for each in sorted(phrase.adjectives & {"lead", "oncoming", "rear", "turns_left", "turns_right"})
        ]
        if "standing" in phrase.adjectives and (phrase.determiner == "indefinite" or actor not in known):
            self.described.append(("standing", actor, phrase.span))
        if phrase.heading is not None:
            self.described.append((phrase.heading, actor, phrase.span))
        return actor

    def _who(self, phrase: NounPhrase) -> int:
        mentioned = {"ego": 0, "hero": 1}.get(phrase.kind) in self.refs.nouns
        if (phrase.kind == "ego" and phrase.determiner == "another") or (phrase.determiner == "another" and mentioned):
            raise self.refuse("there is more than one such vehicle here", phrase.span, "the ego and one other vehicle")
        if phrase.kind in ("latter", "former"):
            return self._one_of_two(phrase)
        if phrase.kind == "ego":
            return self.refs.ego(phrase.noun)
        if phrase.kind == "hero":
            return self.refs.hero(phrase.noun)
        if phrase.kind == "pronoun":
            if self.subject is None:
                raise self.refuse("it is not clear who this is", phrase.span, "the ego or the hero", "name the vehicle")
            return self.subject
        if phrase.kind == "noun" and self._is_the_ego(phrase):
            return self.refs.ego(phrase.noun)
        return self.refs.by_noun(phrase.noun or "", phrase.determiner, phrase.adjectives, phrase.span)

    def _is_the_ego(self, phrase: NounPhrase) -> bool:
        """Whether "the left-turner" is the ego: "The left-turner is the SUT", or it was called so before."""
        if phrase.determiner in ("indefinite", "another", None):
            return False
        if phrase.noun not in _ONES and (1 in self.refs.nouns or 0 in self.refs.nouns):
            return False
        mine, theirs = (self.refs.nouns.get(actor, set()) for actor in (0, 1))
        if phrase.noun in mine and phrase.noun not in theirs:
            return True
        named = self._plain_noun_phrase(phrase.end + 1) if self.tag(phrase.end, "be") else None
        return named is not None and named.kind == "ego"

    def _one_of_two(self, phrase: NounPhrase) -> int:
        """Say who "the latter" is: the vehicle named last, where both have been named."""
        if len(self.refs.nouns) < 2 or self.last_named is None:
            raise self.refuse("it is not clear who this is", phrase.span, "the ego or the hero", "name the vehicle")
        last = self.last_named[0]
        return last if phrase.kind == "latter" else 1 - last

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
