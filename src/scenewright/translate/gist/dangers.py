"""Refuses what cannot be orchestrated, before anything is read: dangerous words and phrases, numbers without a unit.

What enters: words. What leaves: nothing, or a refusal that names them.
"""

from __future__ import annotations

import re

from scenewright.errors import Span
from scenewright.translate.gist.words import DEEDS, Words

# Limits that hold for a while, and what did not or will not happen: no reader of facts can tell what follows.
_DANGERS = frozenset(
    ["exceed", "exceeds", "exceeded", "exceeding", "higher", "lower", "maximum", "minimum", "max", "min", "limit",
     "limited", "cap", "capped", "predicts", "predicted", "says", "said",
     "backing", "backwards", "backward", "reversing", "supposedly", "allegedly", "hypothetically",
     "vanishes", "disappears", "flyover", "overpass", "underpass", "viaduct", "tunnel"]
)  # fmt: skip
_NO_VEHICLES = frozenset(
    ["experiment", "test", "case", "run", "trial", "scenario", "variant", "example", "exercise", "situation", "time",
     "page"]
)  # fmt: skip
# "at the end of its turn", but not "before the beginning of the turn of the ego", which is an order
_EDGE_OF_TURN = re.compile(
    r"(?<!before the )(?<!prior to the )\b(?:start|beginning) of (?:its|the|his|her)\s+(?:\w+\s+)?turn\b"
    r"|\bend of (?:its|the|his|her)\s+(?:\w+\s+)?turn\b(?!\s+before)",
    re.IGNORECASE,
)
_COUNTED = re.compile(
    r"(?:[A-Za-z]-|#|\[|\b(?:run|test|number|no\.?|case|phase|step|milestone|stage|unit|item|day|version|v|scene"
    r"|act|exercise|lesson"
    r"|drill|variant|example|problem|task|file|claim|chapter|section|scenario|situation|question|part)\s?)$",
    re.IGNORECASE,
)
_UNREAL = re.compile(
    r"(?:^|[.;!?]\s+|,\s+)(?:had|were) (?:the|it|a|an)\b"
    r"|(?<!as )\bif \w+(?: \w+)? (?:were|had)\b|(?<!\bi )(?<!\bwe )\bwould(?: not|n't)? have\b(?! (?:to|liked to)\b)",
    re.IGNORECASE,
)
_ALL_BUT = re.compile(
    r"\b(?:any|every|no)thing (?:but|except|other than)\b(?! (?:to )?(?:follow|keep|stay|go|drive)\b)|\ball but\b",
    re.IGNORECASE,
)
_DEPENDS = re.compile(
    r"\b(?:provided|providing|assuming|on (?:the )?condition)(?: that)?\b(?![^,.;]*(?:\d|_(?:m|ft|s)\b))"
    r"|\bunless\b(?! (?:otherwise )?(?:stated|noted|specified|told))|\b(?:as|so) long as\b(?! (?:it|we|the \w+) "
    r"(?:needs?|takes?|requires?) to complete\b)|\bin case\b"
    r"|\b(?:only|even) if\b|\bexcept (?:when|if|that)\b(?! it is (?:ahead|in front) of)",
    re.IGNORECASE,
)
_CHANCE = re.compile(
    r"\b(?:half|most|some|many|few|a third|one|two|\d+ ?%|per ?cent)(?: out)? of (?:the |all )?"
    r"(?:runs|cases|times?|trials|tests|drivers)\b"
    r"|\bin (?:most|some|many|few|a few|certain|almost all) (?:cases|runs|instances)\b|\bnine times out of ten\b"
    r"|\b(?:sometimes|occasionally|now and then|every other)\b",
    re.IGNORECASE,
)
_ONE_OF = re.compile(
    r"\b(?:one|either|any) of (?:the two|them|these|the (?:two )?(?:vehicles|cars)) "
    r"(?:brakes|stops|accelerates|slows|yields|goes|passes|starts|begins|(?:is|has) (?:[\d.]+ |\w+_(?:m|s|ft)\b))",
    re.IGNORECASE,
)
_AGAIN_AND_AGAIN = re.compile(
    r"\b(?:as a rule|by and large|more often than not|over and over|time and again|keeps? up this"
    r"|for the rest of the|and so on|on the verge of|but thinks? better of)\b",
    re.IGNORECASE,
)
_TOUCHES = re.compile(
    r"(?<!the )\b(?:brush|clip|graz|scrap|touch|bump|scratch)(?:e?s|ing|ed|ping|ped)? (?:the|its|our|against"
    r"|into)\b(?! (?:brake|pedal|stop))",
    re.IGNORECASE,
)
_WHICH = re.compile(r"\bwhich of (?:the two|them|the (?:vehicles|cars)|these)\b", re.IGNORECASE)


def refuse_dangers(words: Words) -> None:
    """Refuse what cannot be orchestrated, before anything is read."""
    for pattern, message in (
        (_EDGE_OF_TURN, "a place within a turn is not read here"),
        (_UNREAL, "what did not happen is not read here"),
        (_ALL_BUT, "what does not happen is no scenario"),
        (_DEPENDS, "a condition like this cannot be orchestrated"),
        (_WHICH, "this is left open"),
        (_ONE_OF, "this is left open"),
        (_CHANCE, "what happens at times cannot be orchestrated"),
        (_AGAIN_AND_AGAIN, "this is not read here"),
        (_TOUCHES, "contact cannot be orchestrated"),
    ):
        if found := pattern.search(words.text):
            raise words.refuse(message, Span(*found.span()))
    for at, token in enumerate(words.tokens):
        said = token.text.lower() == "said" and words.has([at + 1], "area", "noun", "landmark")  # "along said road"
        if token.text.lower() in _DANGERS and words.tag(at + 1, "verb") != "want" and not said:
            raise words.refuse(f"'{token.text}' was not understood", token.span)
        if "unsupported" in token.tags and not _is_harmless(words, at):
            raise words.refuse(f"'{token.text}' cannot be orchestrated", token.span)
        if token.tags.get("determiner") == "another" and words.has([at + 1], "landmark"):
            raise words.refuse("there is one such place only", words.tokens[at + 1].span)
        if "bare_number" in token.tags and not _only_counts(words, at):
            raise words.refuse(f"'{token.text}' has no unit", token.span)


def _is_harmless(words: Words, at: int) -> bool:
    """Whether "crashes" or "traffic" only speaks of the world: "a frequent precursor of crashes"."""
    token, before, after = words.tokens[at], words.tags(at - 1), words.tags(at + 1)
    if words.word(at - 1) == "no":
        words.used.add(at - 1)
        return True  # "there are no pedestrians"
    if token.text.lower() == "traffic":
        later = " ".join(words.word(i) for i in range(at + 1, min(at + 9, len(words.tokens))))
        if re.search(
            r"(?:^it has to deal with |\b(?:consists? of|is limited to|amounts to) |^is (?:just |only )?|^):? "
            r"?(?:one|a single|a)\b",
            later,
        ):
            return True  # "Westbound traffic consists of one van"
        return bool(before.keys() & {"heading", "direction", "actor_adjective"})
    if token.text.lower() in ("third", "fourth") and words.word(at + 1) in _NO_VEHICLES:
        return True  # "in the third experiment"
    kind = token.tags["unsupported"]
    if kind == "collisions" and "quantity" in after:
        return True  # "the AV hits 35 m to the conflict point"
    if (not before or "end" in before) and after.keys() & {"colon", "end"}:
        return kind == "more than one other actor"  # "Actors:"
    if kind == "lateral manoeuvres":
        heads = not before or "end" in before  # "Cut-in from the driveway: a hero turns left ..."
        heads = heads and any(words.word(i) == ":" for i in range(at + 1, min(at + 7, len(words.tokens))))
        return heads or words.word(at - 1) in ("instead of", "rather than") or _only_goes_first(words, at)
    if kind in ("collisions", "alternatives and chance"):
        return _is_remark(words, at, kind) or (kind != "collisions" and _asks_people(words, at))
    return kind == "more than one other actor" and (
        before.get("bare_number", "").lower() in ("two", "2") or at in words.names.both
    )


def _only_goes_first(words: Words, at: int) -> bool:
    """Whether "cuts in" is what is told again: "accelerates and cuts in, passing the point before the ego does"."""
    rest = [i for i in words.sentence_at(at) if i > at]
    before = words.where(rest, "link", "before") is not None
    passes = "pass" in words.verbs(rest)
    return words.word(at) in ("cuts in", "cut in") and "comma" in words.tags(at + 1) and passes and before


def _asks_people(words: Words, at: int) -> bool:
    """Whether a sentence tells nothing of a drive: "Could one of you take this?"."""
    sentence = words.sentence_at(at)
    told = words.has(sentence, "quantity", "ego", "hero", "noun", "landmark", "pronoun", "area", "latter", "stop_noun")
    return not told and not words.verbs(sentence) & DEEDS


def _is_remark(words: Words, at: int, kind: str) -> bool:
    """Whether a sentence speaks of the test: "you might expect"; or "either" only stresses a denial."""
    sentence = words.sentence_at(at)
    if words.word(sentence.start) == "you" or (words.word(at) == "either" and words.has([at + 1], "end", "comma")):
        return True
    return kind == "collisions" and not words.has(sentence, "quantity", "ego")


def _only_counts(words: Words, at: int) -> bool:
    """Whether a number only counts sentences ("REQ-2:", "4.1 The POV ..."), or is "one" of the vehicles."""
    word = words.word(at)
    if word.replace(" ", "").isalpha() and not _COUNTED.search(words.text[: words.tokens[at].span.start]):
        return word == "two" or (word == "one" and "unsupported" not in words.tags(at + 1))
    span = words.tokens[at].span
    if words.text[span.end : span.end + 2] == ". " and (not at or words.has([at - 1], "end", "colon", "comma")):
        return True  # "Sequence: 1. The ego starts ..."
    if words.text[: span.start].endswith("(") and words.text[span.end :].startswith(")"):
        return True  # "(1) The ego ..."
    if _COUNTED.search(words.text[: span.start]):
        return True
    back = at - 1
    while words.has([back], "unknown", "numbered", "bare_number", "label") and "end" not in words.tags(back):
        back -= 1
    return back < 0 or "end" in words.tags(back)
