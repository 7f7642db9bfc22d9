"""Finds whose an amount is: the vehicle named last before it, by its measure, or after it.

What enters: words with clauses, and where an amount stands. What leaves: an actor.
"""

from __future__ import annotations

from typing import Protocol

from scenewright.translate.gist.objects import is_object
from scenewright.translate.gist.words import Clause, Words

_ARTICLES = frozenset(("determiner", "possessive", "area_adjective"))
_MEASURES = ("length", "time", "ttc", "headway", "own")


class Owned(Protocol):
    """What has a place in the text and belongs to a vehicle."""

    kind: str
    at: int
    actor: int | None


def measure_of(words: Words, at: int) -> str | None:
    """Return what a word measures: "distance", "times to arrival", also "that" in "and that from the van to it"."""
    if words.word(at) == "that" and words.tag(at + 1, "preposition") in ("out", "of"):
        return "own"
    if words.word(at) in ("its own", "his own", "her own") and words.has([at + 1], "be", "preposition"):
        return "own"  # "when the ego's time to it is 4 s and its own is 3 s"
    if "genitive" in words.tags(at) and words.has([at + 1], "preposition", "relation", "be"):
        return "own"  # "the ego's time to the line is 2 s, and the target's to the conflict point 3 s"
    if _is_elliptic(words, at):
        return "own"
    return words.tag(at, "measure") or words.tag(at, "measures")


def _is_elliptic(words: Words, at: int) -> bool:
    """Whether this is the "'s" of "and the target's at the conflict point is 3 s", and no "is"."""
    short = "be" in words.tags(at) and words.tokens[at].span.excerpt(words.text).startswith(("'", "\u2019"))
    if not short or not words.has([at + 1], "preposition", "relation"):
        return False
    amount = next((i for i in range(at + 1, at + 8) if words.has([i], "quantity", "end")), at)
    return words.has(range(at + 1, amount), "be", "falls") or words.word(amount - 1) == "to"


def measure_word(words: Words, at: int, clause: Clause) -> str | None:
    """Return the measure that an amount is told by, if one stands before it in its clause."""
    for back in range(at - 1, clause.start - 1, -1):
        if (found := measure_of(words, back)) in _MEASURES:
            return found
        if "quantity" in words.tags(back):
            return None
    return _resumed(words, at, clause)


def _resumed(words: Words, at: int, clause: Clause) -> str | None:
    """Return the measure between the two that goes on here: "the headway of the ego, which follows, has shrunk to"."""
    index = next((i for i, each in enumerate(words.clauses) if at in each.inside), 0)
    if (
        index < 2
        or (words.clauses[index - 1].link != "that" and clause.link != "then")
        or not words.has([clause.start], "falls", "be", "auxiliary")
    ):
        return None
    before = words.clauses[index - 1 if clause.link == "then" else index - 2]
    if before.sentence != clause.sentence or words.has(before.inside, "quantity"):
        return None
    found = (measure_of(words, back) for back in reversed(before.inside))
    return next((each for each in found if each in ("headway", "ttc")), None)


def owner_of(words: Words, at: int, clause: Clause) -> int | None:
    """Return whose the amount at `at` is: by its measure, who was named last before it, or whom the clause is about."""
    told = _by_measure_after(words, at)
    told = told if told is not None else _by_measure(words, at, clause)
    if told is not None:
        return told
    if words.word(at - 1) in ("itself", "himself", "herself") and at - 2 not in words.names.actors:
        other = words.named(range(at - 1, words.sentence_at(at).start - 1, -1))
        if other is not None:
            return 1 - other  # "with the ego 26 m and itself 17 m from it"
    for back in range(at - 1, clause.start - 1, -1):
        if back in words.names.actors and (not is_object(words, back) or _just_for(words, back, at, clause)):
            return words.names.actors[back]
        if "quantity" in words.tags(back):
            break
    return _between(words, at, clause)


def _just_for(words: Words, name: int, at: int, clause: Clause) -> bool:
    """Whether an amount follows "for the hero": "and for the hero 2.7 s", "there are for the ego still 4 s"."""
    back = name - 1
    while words.has([back], "determiner", "actor_adjective"):
        back -= 1
    first = not words.has(range(clause.start, back), "quantity", "verb") and words.has([at], "quantity")
    elliptic = words.word(back) == "of" and back == clause.start  # "... 60 km/h, of the target 40 km/h"
    return (
        (words.word(back) == "for" or elliptic)
        and first
        and all("adverb" in words.tags(i) for i in range(name + 1, at))
    )


def _by_measure_after(words: Words, at: int) -> int | None:
    """Return whose "4 s time to arrival of the ego" are: the measure follows the amount."""
    measured = measure_of(words, at + 1) in ("length", "time") and words.word(at + 2) == "of"
    return words.named(range(at + 3, at + 6)) if measured else None


def _by_measure(words: Words, at: int, clause: Clause) -> int | None:
    """Return whose a measure is: "the time to arrival of the hero", "the ego's distance", "ego TTA"."""
    for back in range(at - 1, clause.start - 1, -1):
        if "quantity" in words.tags(back):
            return None
        if measure_of(words, back) in (None, "rate"):
            continue
        if words.word(back).endswith(" own") or words.word(back - 1).endswith(" own"):
            other = words.named(range(back - 1, max(-1, clause.start - 12), -1))
            index = words.clauses.index(clause)
            before = words.clauses[index - 1] if index else clause
            first = words.named(range(clause.start, back)) is None and clause.link == "when"
            if first and before.sentence == clause.sentence and not words.has(before.inside, "quantity"):
                return before.subject  # "the van brakes when its own time to the line is 2 s"
            return None if other is None else 1 - other
        after = words.named(range(back + 1, at))
        its = words.word(back - 1) in ("its", "his", "her") and words.named(range(clause.start, at)) is None
        if its and words.named(range(at, clause.end)) is not None:
            index = words.clauses.index(clause)
            before = words.clauses[index - 1] if index else clause
            return before.subject if before.sentence == clause.sentence else None
        return after if after is not None else words.named(range(back - 1, max(-1, back - 3), -1))
    return None


def is_nobodys(words: Words, at: int, clause: Clause) -> bool:
    """Whether a measure in a condition has no owner: "when the distance to the conflict point is 20 m"."""
    measured = measure_word(words, at, clause) in ("length", "time")
    if words.word(clause.start) in ("that", "this"):
        return False  # "once that time has dropped to 3 s": whose it is was said
    if clause.link != "when" or clause.named or clause.both or not measured:
        return False
    return words.named(clause.inside) is None and not any(i in words.names.pronouns for i in clause.inside)


def _between(words: Words, at: int, clause: Clause) -> int | None:
    """Return whose "40 m between the ego and the conflict point" are, else whom the clause is about."""
    following = next((i for i in range(at + 1, clause.end) if "quantity" in words.tags(i)), clause.end)
    for mark in (*range(at, following), *range(clause.start, at)):
        if words.tag(mark, "preposition") == "between":
            named = words.named(range(mark + 1, mark + 5))
            if named is not None:
                return named
    return clause.subject


def told_by_for(words: Words, name: int, clause: Clause) -> bool:
    """Whether a name opens its clause after "for": "For the ego the stop line is 6 s away"."""
    back = name - 1
    while words.has([back], "determiner", "actor_adjective"):
        back -= 1
    return words.word(back) == "for" and back <= clause.start


def told_for(words: Words, made: Owned, at: int) -> None:
    """Read "3 s for the ego and 2 s for the van" and "25 m (ego)": whose it is stands after it."""
    bracket = words.in_brackets(made.at + 1) or words.in_brackets(at)  # "25 m (ego)", "25 m from the line (ego)"
    if bracket is not None:
        made.actor = bracket[1]
        return
    for ahead in range(made.at + 1, min(len(words.tokens), max(at, made.at + 1) + 4)):
        preposition = words.tag(ahead, "preposition")
        waits = words.tag(ahead, "verb") == "wait" and "left_over" not in words.tags(ahead)
        if words.has([ahead], "quantity", "end") or waits or words.word(ahead) == "and":
            return
        to = preposition == "to" and made.kind == "open"
        if preposition == "for" or to or (preposition == "of" and ahead == made.at + 1):
            if words.has([words.skip(ahead + 1, _ARTICLES)], "landmark"):
                return  # "needs 3 s more for the conflict point"
            named = words.named(range(ahead + 1, ahead + 5))
            made.actor = named if named is not None else made.actor
            return
