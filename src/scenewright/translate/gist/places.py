"""Finds places in a text: how an amount lies to what follows it, and which landmark that is.

What enters: words, and where an amount stands. What leaves: relations and landmarks with where they end.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import HERO_ID, Relation
from scenewright.translate.gist.words import Words

SKIPPED = frozenset(("determiner", "possessive", "area_adjective", "adverb", "left_over", "starting", "measured_word"))
_BESIDE = frozenset(("determiner", "actor_adjective", "possessive", "unknown"))
_TO_VERBS = ("go", "drive", "pass", "reach")


@dataclass(slots=True)
class PlaceFinder:
    """Finds places behind the amounts of one text."""

    words: Words

    def is_strange(self, at: int) -> bool:
        """Whether an amount is measured up to something that is no known place and no vehicle."""
        names = self.words.names
        if at in names.actors or at in names.pronouns or at in names.both or at >= len(self.words.tokens):
            return False
        goes_on = ("end", "comma", "colon", "link", "quantity", "preposition", "relation", "actor_adjective", "be")
        return not self.words.has([at], *goes_on)

    def lies_beside(self, stretch: range) -> bool:
        """Whether "behind" or "ahead" is said."""
        return self.words.where(stretch, "relation", "behind", "ahead") is not None

    def of_whom(self, at: int) -> tuple[int, int | None]:
        """Step over "left for the ego" in "12 m left for the ego to its stop line"."""
        names = self.words.names.actors
        if (bracket := self.words.in_brackets(at)) is not None:
            return bracket  # "20 m (cab) away from it"
        ahead = at
        while (
            self.words.has([ahead], "left_over", "measure")
            or self.words.tag(ahead, "verb") == "go"
            or (self.words.word(ahead) == "to" and self.words.tag(ahead + 1, "verb") == "go")
            or (self.words.has([ahead], "be") and self.words.has([ahead + 1], "left_over"))
        ):
            ahead += 1
        if self.words.tag(ahead, "preposition") in ("for", "to", "of"):
            name = self.words.skip(ahead + 1, _BESIDE | {"heading"})
            if name in names and self.relation_at(name + 1) is not None:
                return name + 1, names[name]
        name = self.words.skip(at + 1, _BESIDE | {"heading"})
        if self.words.word(at) == "from" and name in names and self.words.tag(name + 1, "link") == "to":
            return name + 1, names[name]  # "when it is 12 m from the ego to the conflict point"
        if self.words.word(at) == "from" and self.words.word(at + 1) == "him" and self.words.word(at + 2) == "to":
            return at + 2, HERO_ID
        return at, None

    def relation_at(self, at: int) -> tuple[Relation, int] | None:
        """Return how an amount lies to what follows, and where that begins."""
        seen: Relation | None = None
        parted = self.words.has([at], "comma") and "relation" in self.words.tags(at + 1)
        at += parted  # "19 m, before the conflict point"
        while at < len(self.words.tokens):
            tags, word = self.words.tags(at), self.words.word(at)
            preposition = tags.get("preposition")
            if word == "behind" and self.words.tag(at + 1, "preposition") == "of":
                return None
            if word == "after" and seen is None and self.words.tag(at - 1, "quantity") == "length":
                seen = "past"  # "stops 3 m after the stop line"
            elif "relation" in tags:
                seen = "past" if tags["relation"] == "past" else seen or "before"
            elif self._leads_to(at) or (preposition == "out" and seen is None):
                seen = seen or "from"
            elif preposition == "for" and seen is None and self._is_mark(at + 1):
                seen = "from"  # "needs 3 s more for the conflict point"
            elif not self._passes(at, seen):
                break
            at += 1
        return (seen, at) if seen is not None else None

    def _is_mark(self, at: int) -> bool:
        """Whether a place follows that is no area."""
        at = self.words.skip(at, SKIPPED)
        return self.words.has([at], "landmark")

    def _leads_to(self, at: int) -> bool:
        tags = self.words.tags(at)
        linked = tags.get("link") in ("to", "until") or tags.get("preposition") in ("to", "at", "of")
        return linked or self.words.word(at) in ("at that", "up to")

    def _passes(self, at: int, seen: Relation | None) -> bool:
        """Whether a word between an amount and its place only fills: "are left to", "from reaching"."""
        tags = self.words.tags(at)
        fills = (
            self.words.word(at) == "more"
            or "left_over" in tags
            or "measured_word" in tags
            or tags.get("adverb") in ("filler", "exact", "about")
        )
        to_go = tags.get("verb") in _TO_VERBS and self.words.word(at - 1) in ("to", "from")
        left = seen is None and "be" in tags and self.words.has([at + 1], "left_over", "relation")
        return fills or to_go or left

    def place_at(self, at: int) -> tuple[str, int, bool] | None:
        """Return the landmark at `at`, the index after it, and whether it is only the mouth of the driveway."""
        first = at
        while "landmark" not in self.words.tags(at) and (
            self.words.tags(at).keys() & SKIPPED or (self.words.word(at) == "your" and at == first)
        ):
            at += 1
        line = at + 1 + ("genitive" in self.words.tags(at + 1))
        if self.words.tag(at, "area") == "driveway" and self.words.tag(line, "landmark") == "stop_line":
            at = line  # "12 m from the driveway's stop line"
        tags = self.words.tags(at)
        if "landmark" in tags:
            return tags["landmark"], at + 1, False
        if "back_reference" in tags or ("mark_noun" in tags and at > first):
            return self.words.referred(at) or "last", at + 1, False
        if self.words.word(at) == "same" and at > first and self.words.has([at + 1], "comma", "end", "link"):
            return "last", at + 1, False  # "2.3 s from the same"
        if self.words.word(at) == "there" or (
            "latter" in tags and self.words.word(at - 1) in ("short of", "before", "upstream of")
        ):
            return "last", at + 1, False
        if "mouth" in tags and self.words.word(at + 1) == "of":
            mouth = self.place_at(at + 2)
            return mouth if mouth is not None and mouth[0] == "turn" else None
        if tags.get("area") == "driveway":
            return "turn", at + 1, True
        if tags.get("pronoun") == "it" and at == first and self._named_in_sentence(at):
            return "last", at + 1, False
        return None

    def _named_in_sentence(self, at: int) -> bool:
        """Whether a landmark was named before in this sentence: "80 feet from the stop line; ... 65 feet from it"."""
        back = at - 1
        while back >= 0 and ("end" not in self.words.tags(back) or self.words.word(back) == ";"):
            if "landmark" in self.words.tags(back):
                return True
            back -= 1
        return False
