"""Tells whether a name is what somebody does something to, and not who does it; and who is told of as seen.

What enters: words with names. What leaves: whether the name at a token is an object: "for the ego", "follows the van".
"""

from __future__ import annotations

from scenewright.translate.gist.words import Clause, Words

SEES = (
    "sees",
    "spots",
    "notices",
    "watches",
    "saw",
    "spotted",
    "noticed",
    "see",
    "seeing",
    "finds",
    "found",
    "meets",
    "met",
    "encounters",
    "faces",
    "observes",
)
_STAGES = ("let", "have", "make", "place", "put")
_CLOSES = ("link", "comma", "end", "preposition")
SHARES = ("shares", "share", "sharing", "shared")
_BESIDE = frozenset(("determiner", "actor_adjective", "possessive", "heading", "hero", "noun", "unknown", "direction"))
_OBJECT_OF = frozenset(("to", "of", "for", "by", "between", "across", "into", "in", "on", "at", "out"))
_TAKES_OBJECT = frozenset(
    ["follow", "yield", "approach", "pass", "lead", "not_yield", "cut_in_front", "beat", "come_towards", "enter",
     "attitude", "get_within", "hit", "reach"]
)  # fmt: skip


def is_object(words: Words, at: int) -> bool:
    """Whether the name at `at` stands after a preposition, or as the object of a verb."""
    following = words.tags(at + 1)
    if at - 1 in words.names.actors and words.has([at - 1], "ego"):
        return is_object(words, at - 1)  # "for the ADS car"
    if "genitive" in following and words.where((at + 1, at + 2), "area", "lane") is not None:
        return True  # "crosses the ego's lane"
    back = _before_name(words, at)
    beside = words.word(back) in ("ahead of", "in front of") and words.has([at + 1], *_CLOSES) and back > 0
    if beside and words.has([back - 1], "comma", "be", "adverb", "area"):
        return True  # "is in the driveway as well, ahead of the AV and 30 m upstream of the line"
    if _is_owner(words, back, at) or words.word(back - 1) in ("consists", "consist", "consisting"):
        return False  # "Traffic consists of one van"
    if 0 < back < at and "ing" in words.tokens[back].forms and "determiner" in words.tags(back - 1):
        return words.word(back - 2) == "of"  # "the presence of a yielding van", but not "the entering car"
    if words.word(back) in SEES and "ing" in words.tokens[min(at + 1, len(words.tokens) - 1)].forms:
        return False  # "sees the ego driving west"
    if back < 0:
        return False
    tags, verb = words.tags(back), words.tag(back, "verb")
    if verb in _TAKES_OBJECT and verb != "reach":
        return True
    preposition = tags.get("preposition")
    if following.keys() & {"measure", "quantity"} and preposition in ("at", "with", "of", "to"):
        return preposition in ("of", "to") and "measure" not in following  # "at ego time to arrival 4 s"
    linked = tags.get("link")
    if tags.get("relation") in ("ahead", "behind") and words.has([at + 1], "be") and words.has([at + 2], "determiner"):
        return True  # "Ahead of us is another car"
    if linked in ("before", "after") and words.tag(back - 1, "quantity") == "time" and _acts(words, at):
        return False  # "1 s before the ego passes it"
    if linked not in (None, "to", "by") and words.tag(back - 1, "quantity") not in ("length", "time"):
        return False
    if (tags.keys() & {"relation", "separates"} and linked != "when") or preposition in _OBJECT_OF:
        return True
    if words.word(back) == "with" and any(words.word(i) in SHARES for i in range(max(0, back - 6), back)):
        return True  # "It shares the lane with the ego"
    if "opposed" in tags and words.named(range(words.sentence_at(at).start, back)) is not None:
        return True  # "a left turn of the ego against an eastbound van"
    if verb == "let":  # "lets the ego pass", but not the imperative "let the ego drive"
        stages = words.word(words.sentence_at(back).start) in _STAGES  # "Let A ..., and let B"
        link = words.word(back - 1).split()[-1:]
        told = (
            link in (["to"], ["by"])
            or (link == ["and"] and not stages)
            or words.has([back - 1], "negation", "auxiliary")
        )
        return told or bool(words.tokens[back].forms & {"s", "ing"})
    return verb in _TAKES_OBJECT


def _acts(words: Words, at: int) -> bool:
    """Whether a vehicle is followed by what it does."""
    finite = "verb" in words.tags(at + 1) and "ing" not in words.tokens[min(at + 1, len(words.tokens) - 1)].forms
    return finite or words.has([at + 1], "auxiliary", "be")


def _is_owner(words: Words, of: int, at: int) -> bool:
    """Whether a name is the owner of what a clause begins with: "The route of the van is", "The driver of the bus"."""
    if words.word(of) != "of" or not words.has([at + 1], "be", "verb", "auxiliary"):
        return False
    first = of - 2 if "determiner" in words.tags(of - 2) else of - 1
    return first == 0 or words.has([first - 1], "end", "comma", "link")


def _before_name(words: Words, at: int) -> int:
    """Return where the words before a name, its article and its adjectives, end."""
    back = at - 1
    article = False
    while back >= 0 and back not in words.names.actors and back not in words.names.pronouns:
        tags = words.tags(back)
        ordinal = words.word(back) in ("first", "second", "last") and words.has([back - 1], "determiner")
        if ordinal:
            back -= 1  # "behind the first car"
            continue
        if not tags.keys() & _BESIDE or (article and "unknown" in tags):
            break  # "in this episode the ego": the ego is no object of "in"
        article |= "determiner" in tags
        if tags.keys() & {"relation", "preposition", "verb", "link"} and not tags.keys() & {
            "determiner",
            "actor_adjective",
        }:
            break
        back -= 1
    return back


def seen(words: Words, index: int) -> int | None:
    """Return whom "westbound and going straight" is about after "A van sees the AV coming along the road"."""
    for back in range(index, 1, -1):
        clause, before, sees = words.clauses[back], words.clauses[back - 1], words.clauses[back - 2]
        if is_finite(words, clause) or clause.link not in ("main", "and") or before.sentence != clause.sentence:
            return None
        if before.named and words.word(sees.end - 1) in SEES and sees.sentence == clause.sentence:
            return None if is_finite(words, before) else before.subject
    return None


def is_finite(words: Words, clause: Clause) -> bool:
    """Whether somebody does or is something in a clause: "goes", but not "going"."""
    finite = any("verb" in words.tags(at) and "s" in words.tokens[at].forms for at in clause.inside)
    return finite or words.has(clause.inside, "be", "auxiliary")
