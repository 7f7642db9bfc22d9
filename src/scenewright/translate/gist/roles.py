"""Tells what sides and areas are to a vehicle: "right" may be a turn, a driveway may be left, entered or passed.

What enters: words with clauses, and where a side or an area stands. What leaves: its part, or None where there is none.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.gist.words import Clause, Words

_AREA_WORDS = frozenset(("determiner", "possessive", "area_adjective", "same", "side", "adverb", "unknown"))
_LEAVING = ("leave", "pull_out")
_WAY_VERBS = frozenset(
    ["turn", "pull_out", "go", "drive", "make", "come", "want", "keep", "leave", "enter", "begin", "complete",
     "lane_follow", "sit", "wait", "let", "need", "approach"]
)  # fmt: skip
_TURN_AFTER = ("go", "pull_out", "drive", "make", "come", "want")
_BEFORE_TURN = frozenset(
    ["determiner", "possessive", "comma", "colon", "end", "link", "area", "heading", "preposition", "wanting",
     "unknown", "be", "ready", "bound_word"]
)  # fmt: skip
_AFTER_TURN = frozenset(
    ["end", "comma", "heading", "preposition", "link", "event_noun", "verb", "area", "unknown", "colon", "adverb",
     "pronoun", "relation", "pair", "auxiliary", "be", "negation", "side_noun"]
)  # fmt: skip


@dataclass(slots=True)
class Roles:
    """Answers for one text."""

    words: Words

    def is_no_turn(self, at: int) -> bool:
        """Whether this is "right in front of", "right of way", "right at the line", "30 m left to it", "left to go"."""
        before, after = self.words.tags(at - 1), self.words.tags(at + 1)
        just = self.words.tag(at, "adverb") == "just"
        left_over = "left_over" in self.words.tags(at)
        opens = self.words.word(at) == "right" and "comma" in after and (not before or "end" in before)
        here = self.words.word(at) == "right" and self.words.word(at + 1) in ("there", "then", "here", "where")
        if opens or (here and before.get("verb") != "turn"):
            return True  # "Right, so the ego ...", "Right there it brakes"
        if before.get("verb") == "turn" and not left_over:
            return False  # "turns right at the end of it"
        if "determiner" in before and self.words.word(at + 1) in ("thing", "decision", "moment", "time", "order"):
            return True  # "does the right thing"
        if after.get("relation") in ("ahead", "behind") or (just and after.get("preposition") in ("of", "at")):
            return True
        if "genitive" in before and "link" in after:
            return True
        if just and before.get("verb") in ("brake", "stop", "come"):
            return True  # "slows right down"
        if just and "relation" in after and (before.keys() & {"noun", "hero", "ego", "stop_noun"}):
            return True
        measured = self.words.where(range(at - 4, at), "quantity") is not None
        if "quantity" in before or (left_over and measured and before.keys() & {"landmark", "back_reference"}):
            return True
        return left_over and after.get("preposition") == "to" and not before.keys() & {"link", "verb"}

    def is_turn(self, at: int) -> bool:
        """Whether this is "turns left", "a left turn", "left onto the road"."""
        back = at - 1
        while self.words.tag(back, "adverb") == "filler":
            back -= 1  # "turns likewise left"
        before, after = self.words.tags(back), self.words.tags(at + 1)
        others = [tags["verb"] for tags in (before, after) if "verb" in tags and tags["verb"] not in _WAY_VERBS]
        if others or "stop_noun" in after:
            return False  # "wants to stop right onto the road"
        near = (after.get("verb"), after.get("event_noun"), before.get("verb"), before.get("event_noun"))
        turns = "turn" in near or before.get("verb") in _TURN_AFTER or not before
        return (turns or bool(before.keys() & _BEFORE_TURN)) and (not after or bool(after.keys() & _AFTER_TURN))

    def driveway_before(self, at: int) -> bool:
        """Whether the driveway was the area named last: "comes out of it"."""
        back = self.words.where(range(at - 1, -1, -1), "area")
        if back is None or self.words.tags(back)["area"] != "driveway":
            return False
        first = self.words.skip(back - 1, _AREA_WORDS, -1)
        left = self.words.word(first) in ("from", "out of") and self.words.where(range(first), "area", "road")
        return not (left and self.words.verbs(range(at - 2, at)) & {"enter"})  # "nears the road from it, to enter it"

    def role(self, at: int, clause: Clause) -> str | None:
        """Return how a vehicle is to do with an area: "into", "from", "on", "past"; None where it is only spoken of."""
        back = at - 1
        while self.words.tags(back).keys() & _AREA_WORDS:
            if "determiner" not in self.words.tags(back) and self.words.has([back], "verb", "preposition", "link"):
                break
            back -= 1
        tags, word = self.words.tags(back), self.words.word(back)
        verb, preposition = tags.get("verb"), tags.get("preposition")
        before = self.words.verbs(range(max(clause.start, back - 2), back))
        turned = "turn" in before or (self._turned(back, clause) and not self._comes(back, clause))
        bound = preposition == "to" and self.words.word(back - 1).endswith("way")  # "on its way to the driveway"
        if word == "after" and "be" in self.words.tags(back - 1):
            return "into"
        aimed = {self.words.word(i) for i in range(at + 2, at + 4)} & {"destination", "goal", "target", "aim"}
        if self.words.word(at + 1) == "as" and aimed:
            return "into"  # "has the driveway as its destination"
        if word in ("->", "-->", "=>", "\u2192", "\u21d2") and self.words.has([back - 1], "direction", "event_noun"):
            return "into"  # "eastbound -> left turn -> driveway"
        if word == "(" and self.words.word(at + 1) == ")" and self.words.has([back - 1], "direction", "event_noun"):
            return None  # "turn: left (driveway)" may be into it or out of it
        if preposition == "into" or verb in ("enter", "want") or word.split()[-1:] in (["for"], ["onto"]) or bound:
            return "into"
        if preposition == "in" and self.words.tag(at, "area") == "driveway" and "turn" in before:
            return None  # "turns left in the driveway" may be into it or out of it
        if preposition == "in" and self.words.word(back - 1) == "go" and self.words.word(back - 2) == "to":
            return "into"  # "wants to go in the driveway"
        if word == "up" and self.words.tag(at, "area") == "driveway" and (turned or self._turned(back - 1, clause)):
            return "into"  # "turns left, up the driveway"
        if preposition in ("on", "in") and (before & {"enter"} or (turned and self.words.tag(at, "area") == "road")):
            return "into"  # "enters in the driveway", "turns left on the road"
        if verb == "pull_out" and word.startswith(("join", "merg")):
            return "into"
        if (preposition == "out" or "relation" in tags) and self.words.has([back - 1], "quantity"):
            return None  # "66 m from the driveway"
        told = {self.words.word(i) for i in range(clause.start, back)}
        if (
            "be" in tags
            and told & {"destination", "goal", "target", "aim"}
            and self.words.tag(at, "area") == "driveway"
        ):
            return "into"  # "its destination is the driveway"
        sided = self.words.has(range(at + 2, at + 4), "direction", "heading")  # "leaves the driveway to the left"
        if verb == "leave" and self.words.tag(at + 1, "preposition") in ("to", "for") and not sided:
            return None  # "leaves the driveway to us"
        if preposition == "out" or verb in _LEAVING or word in ("from", "down") or "out of" in word:
            return "from"
        if preposition == "by" and self.words.verbs(clause.inside) & {"leave"}:
            return "from"  # "leave by the driveway"
        if tags.get("relation") == "past" or verb == "pass":
            return "past"
        if preposition == "of" and self.words.has([back - 1], "mouth", "landmark"):
            mouth = "landmark" not in self.words.tags(back - 1)
            beyond = self.words.where(range(back - 3, back), "relation", "past") is not None
            if mouth and (beyond or "pass" in self.words.verbs(range(back - 3, back))):
                return "past"  # "carries on past the mouth of the driveway"
            if mouth and self.words.has(range(back - 5, back), "quantity"):
                return None  # "55 m from the mouth of the driveway"
            return "on"  # "at the end of the driveway"
        keeps = preposition == "to" and before & {"drive", "keep"} and self.words.tag(at, "area") == "driveway"
        if keeps or verb in ("lane_follow", "follow"):
            return "on"
        if word.endswith(" on") and verb in ("go", "drive", "keep"):
            return "on"  # "drives on the road"
        goal = {"destination", "goal", "target", "aim"} & {
            self.words.word(i) for i in range(max(0, back - 2), back + 1)
        }
        if goal and (clause.both or self.is_title(clause)):  # "Two vehicles with one destination, the driveway."
            return "into" if clause.both else None
        begins = back < clause.start or bool(tags.keys() & {"comma", "end", "colon"})
        if "relation" in tags or not (preposition in ("on", "in", "with") or begins):
            return None
        if back > clause.start and "unknown" in self.words.tags(back - 1) and back - 1 not in self.words.names.actors:
            return None  # "lives up that driveway"
        verbs = self.words.verbs(range(at, clause.end))
        if begins and "be" in self.words.tags(at + 1) and not verbs & {"enter", "leave"}:
            return None  # "for which the driveway is of no interest"
        if self.words.has(range(at, clause.end), "be") and verbs & {"enter", "leave"}:
            return "into" if "enter" in verbs else "from"  # "the driveway is entered by a van"
        return "into" if turned and self.words.tag(at, "area") == "road" else "on"

    def _turned(self, at: int, clause: Clause) -> bool:
        """Whether a turn of the same vehicle was told before in the sentence: "turns left to drive along the road"."""
        stretch = [
            i
            for each in self.words.sentence(clause)
            if each.start <= clause.start and each.subject == clause.subject
            for i in range(each.start, min(each.end, at))
        ]
        if any(self.words.tag(i, "area") == "driveway" and self._goes_into(i) for i in stretch):
            return False  # "wanting to turn left into the driveway, drives east on the road": that comes before
        sided = any(self.words.word(i) in ("left to", "right to") for i in stretch)
        own = [  # not "from the ego's left", "from our left"
            i
            for i in stretch
            if "genitive" not in self.words.tags(i - 1) and self.words.word(i - 1) not in ("our", "your", "my")
        ]
        return sided or self.words.where(own, "direction", "left", "right") is not None

    def _goes_into(self, area: int) -> bool:
        """Whether an area is told to be gone into: "into the driveway"."""
        return self.words.tag(self.words.skip(area - 1, _AREA_WORDS, -1), "preposition") == "into"

    def _comes(self, at: int, clause: Clause) -> bool:
        """Whether a vehicle is on its way where an area follows: "a left turn, coming eastbound on the road"."""
        last = next((i for i in range(at - 1, clause.start - 1, -1) if "verb" in self.words.tags(i)), None)
        ways = ("come", "drive", "go", "approach")
        if last is None or self.words.tag(last, "verb") not in ways:
            return False
        return "ing" in self.words.tokens[last].forms or self.words.tag(last, "verb") == "approach"

    def road_before(self, at: int) -> bool:
        """Whether the road was spoken of last: "is on the road and follows it"."""
        back = self.words.where(range(at - 1, -1, -1), "area")
        between = range(back + 1, at) if back is not None else range(0)
        named = self.words.named(between)
        return back is not None and self.words.tags(back)["area"] == "road" and named is None

    def is_title(self, clause: Clause) -> bool:
        """Whether nobody is named in the sentence, or nobody was so far."""
        names = self.words.names
        named = {*names.actors, *names.pronouns}
        inside = any(at in named for each in self.words.sentence(clause) for at in each.inside)
        return not inside or not any(at < clause.end for at in names.actors)
