"""Who is meant: names, nouns and pronouns of a description resolved to the ego or the one other vehicle.

What enters: noun phrases in reading order. What leaves: actor ids, or a refusal where a phrase could mean either.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Place, Span, TranslationError
from scenewright.translate.events import EGO_ID, HERO_ID


@dataclass(slots=True)
class NounPhrase:
    """An actor as it was written; `Phrases.resolve` says who it is."""

    end: int
    kind: str  # ego, hero, noun, latter or pronoun
    noun: str | None
    determiner: str | None
    adjectives: set[str]
    heading: str | None
    span: Span


@dataclass(slots=True)
class Referents:
    """The actors mentioned so far."""

    text: str
    name: str
    nouns: dict[int, set[str]] = field(default_factory=dict)
    by_indefinite: bool = False
    assumptions: list[str] = field(default_factory=list)

    def ego(self, noun: str | None) -> int:
        """Note a mention of the ego, perhaps with a noun ("ego vehicle")."""
        self.nouns.setdefault(EGO_ID, set()).update({noun} if noun else ())
        return EGO_ID

    def hero(self, noun: str | None) -> int:
        """Note a mention of the hero by its own name."""
        self.nouns.setdefault(HERO_ID, set()).update({noun} if noun else ())
        return HERO_ID

    def by_noun(self, noun: str, determiner: str | None, adjectives: set[str], span: Span) -> int:
        """Resolve "a car", "the truck", "another vehicle", "the oncoming car"."""
        known = self.nouns.get(HERO_ID)
        if determiner in ("indefinite", "another"):
            one_more = (
                self.by_indefinite or determiner == "another" or "other" in adjectives or noun not in (known or ())
            )
            if known is not None and one_more:
                raise self._refuse(
                    "there is more than one other vehicle here",
                    span,
                    "the ego and one other vehicle",
                    "call the other vehicle 'the hero' after its first mention",
                )
            self.by_indefinite = True
            return self.hero(noun)
        if adjectives & {"other", "lead", "oncoming"} or known is None:
            if known is None and not adjectives and determiner == "definite" and self.nouns.get(EGO_ID, set()) & {noun}:
                raise self._ambiguous(span)
            return self.hero(noun)
        if noun in known or noun in ("vehicle", "car", "actor", "agent"):
            if noun in self.nouns.get(EGO_ID, set()) and not self.by_indefinite and noun not in known:
                raise self._ambiguous(span)
            return HERO_ID
        raise self._refuse(
            f"'{span.excerpt(self.text)}' was not mentioned before",
            span,
            f"the ego or the {sorted(known)[0] if known else 'hero'}",
            "use one name for the other vehicle throughout",
        )

    def _ambiguous(self, span: Span) -> TranslationError:
        return self._refuse(
            f"'{span.excerpt(self.text)}' could be either vehicle",
            span,
            "the ego or the hero",
            "write 'the ego' or 'the hero'",
        )

    def _refuse(self, message: str, span: Span, expected: str, fix: str) -> TranslationError:
        return TranslationError(
            message, place=Place(self.name, self.text, span), found=span.excerpt(self.text), expected=expected, fix=fix
        )
