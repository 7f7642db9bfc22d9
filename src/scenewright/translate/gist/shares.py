"""Lets amounts share what is told once: "the ego 40 m and the hero 20 m from the conflict point".

What enters: amounts as `amounts` read them. What leaves: the same, with places and owners filled in.
"""

from __future__ import annotations

from itertools import pairwise

from scenewright.translate.gist.measured import Measured
from scenewright.translate.gist.owners import told_for
from scenewright.translate.gist.words import DEEDS, Words

_BESIDE = ("and", "while", "whilst", "with", "but", "as")
_THIS_AMOUNT = ("this time", "that time", "this distance", "that distance")
_OTHERS = ("itself", "himself", "herself", "second", "other", "one", "latter", "the latter", "the second")


def share(words: Words, found: list[Measured]) -> None:
    """Fill in what one amount says for another."""
    _back_references(words, found)
    _respectively(words, found)
    _told_after(words, found)
    _told_before_colon(words, found)
    _told_in_front(words, found)
    _same_place(words, found)
    _in_order(words, found)
    _one_each(words, found)
    _speeds_of_each(words, found)


def _back_references(words: Words, found: list[Measured]) -> None:
    """Let "that point" be the landmark named last."""
    for made in found:
        back = words.landmark_before(made.at) if made.landmark == "last" else None
        if back is not None:
            made.landmark = words.tags(back)["landmark"]
            words.used.add(back)


def _respectively(words: Words, found: list[Measured]) -> None:
    """Read "15 m and 6 m away from the conflict point and the stop line, respectively"."""
    for at in range(len(words.tokens)):
        if "respectively" not in words.tags(at):
            continue
        first = words.sentence_at(at).start
        own = [made for made in found if first <= made.at < at and made.quantity is not None][-2:]
        marks = [i for i in range(own[-1].at, at) if "landmark" in words.tags(i)] if len(own) == 2 else []
        if len(marks) == 2:
            for made, mark in zip(own, marks, strict=True):
                made.kind, made.landmark, made.vague = "place", words.tags(mark)["landmark"], False
        if marks:
            words.used |= {at, *marks}


def _told_after(words: Words, found: list[Measured]) -> None:
    """Read "the ego at 4 s and the van at 3 s, both with respect to the conflict point"."""
    for clause in words.clauses:
        opens = [m for m in found if m.kind == "open" and m.clause.sentence == clause.sentence and m.at < clause.start]
        alike = len({made.quantity.dimension for made in opens if made.quantity is not None}) < 2
        begins = alike and words.has([clause.start], "measured_word", "preposition", "relation")
        mark = words.where(clause.inside, "landmark")
        if not opens or not begins or mark is None or words.has(clause.inside, "quantity", "verb", "be", "ego", "hero"):
            continue
        for made in opens:
            made.kind, made.landmark = "place", words.tags(mark)["landmark"]
        words.used |= set(clause.inside)


def _told_before_colon(words: Words, found: list[Measured]) -> None:
    """Read "Trigger on the time to arrival at the conflict point: ego 4 s, van 2.5 s"."""
    for clause in words.clauses:
        measure = words.where(clause.inside, "measure", "time", "length")
        measure = measure if measure is not None else words.where(clause.inside, "measures")
        if measure is None and any(words.word(i).startswith("measured") for i in clause.inside):
            measure = clause.start  # "Initial positions, measured back from the stop line: ..."
        mark = words.where(clause.inside, "landmark")
        rest = [each for each in words.sentence(clause) if each.start > clause.start]
        if measure is None or mark is None or not rest or rest[0].link != "colon" or clause.end + 1 != rest[0].start:
            continue
        if words.has(clause.inside, "quantity"):
            continue
        dimension = words.tag(measure, "measure") or words.tag(measure, "measures") or "length"
        for made in found:
            own = made.kind == "open" and made.clause.sentence == clause.sentence and made.at > clause.end
            if own and made.quantity is not None and made.quantity.dimension == dimension:
                made.kind, made.landmark = "place", words.tags(mark)["landmark"]
                words.used.add(mark)


def _told_in_front(words: Words, found: list[Measured]) -> None:
    """Read "With respect to the stop line, the ego is 6.5 s out and the van 4 s out"."""
    for clause in words.clauses:
        rest = [at for at in clause.inside if not words.tags(at).keys() & {"determiner", "area_adjective"}]
        opens = (
            len(rest) == 2 and words.has(rest[:1], "measured_word", "preposition") and words.has(rest[1:], "landmark")
        )
        if not opens or words.sentence(clause)[0] is not clause:
            continue
        own = [made for made in found if made.clause.sentence == clause.sentence and made.quantity is not None]
        if own and all(made.kind == "open" for made in own):
            for made in own:
                made.kind, made.landmark = "place", words.tags(rest[1])["landmark"]
            words.used |= set(clause.inside)


def _same_place(words: Words, found: list[Measured]) -> None:
    """Let one place be that of two amounts next to each other, the one before it or the one after."""
    for first, second in pairwise(found):
        between = [at for at in range(first.at, second.at) if "left_over" not in words.tags(at)]
        acts = words.verbs(between) & {"brake", "stop", "accelerate", "pass", "complete", "wait"}
        shared = first.kind == "open" and second.kind == "place" and _alike(first, second)
        if shared and not acts and _is_short(words, first):
            _take_place(first, second)
    for first, second in pairwise(found):
        if (
            second.kind == "open"
            and _alike(first, second)
            and first.kind == "place"
            and None
            not in (
                first.actor,
                second.actor,
            )
        ):
            told_for(words, second, second.at + 1)
            if first.actor != second.actor:
                _take_place(second, first)


def _is_short(words: Words, made: Measured) -> bool:
    """Whether an amount ends without a place: "the ego is 12 m [...]", but not "2 s from over there"."""
    plain = (
        "adverb",
        "left_over",
        "comma",
        "link",
        "preposition",
        "ego",
        "hero",
        "noun",
        "determiner",
        "measured_word",
    )
    end = next((i for i in range(made.at + 1, made.clause.end) if "quantity" in words.tags(i)), made.clause.end)
    known = {*words.names.actors, *words.names.pronouns}
    return all(
        at in known or words.word(at) == "one" or words.tags(at).keys() & set(plain) for at in range(made.at + 1, end)
    )


def _alike(first: Measured, second: Measured) -> bool:
    if first.quantity is None or second.quantity is None or first.clause.sentence != second.clause.sentence:
        return False
    return _is_measured_alike(first, second)


def _take_place(made: Measured, other: Measured) -> None:
    made.kind, made.landmark, made.relation, made.vague = "place", other.landmark, other.relation, other.vague


def _in_order(words: Words, found: list[Measured]) -> None:
    """Let "the ego and the hero are 12 m and 30 m from it" tell of each in order."""
    actors = words.names.actors
    for clause in words.clauses:
        own = [made for made in found if made.clause is clause and made.kind == "place" and made.quantity is not None]
        if len(own) < 2 or own[0].landmark != own[1].landmark:
            continue
        first = words.sentence(clause)[0].start
        named = [at for at in range(first, own[0].at) if at in actors][-2:]
        they = any(words.word(at) == "they" for at in range(first, own[0].at))
        after = range(own[1].at, own[1].at + 9)
        if not named and they and words.has(after, "respectively"):  # in the order in which they came in
            came = list(dict.fromkeys(actors[at] for at in sorted(actors) if at < first))
            named = [next(at for at in sorted(actors) if actors[at] == actor) for actor in came]
        between = any(at in actors for at in range(own[0].at, own[1].at))
        if len(named) == 2 and not between and actors[named[0]] != actors[named[1]]:
            own[0].actor, own[1].actor = actors[named[0]], actors[named[1]]
            words.used |= {i for i in range(own[1].at, own[1].at + 9) if "respectively" in words.tags(i)}


def _one_each(words: Words, found: list[Measured]) -> None:
    """Read "when this time is 2 s and the van's is 4 s", "the ego is 20 m and himself 30 m from it" as one of each.

    One vehicle is not at two places at one moment: where one of two amounts names its vehicle and the other does not,
    that is the other's. A mere "it" decides nothing.
    """
    places = [made for made in found if made.kind == "place" and made.quantity is not None]
    for first, second in pairwise(places):
        alike = first.actor is not None and first.actor == second.actor
        if not alike or first.clause.sentence != second.clause.sentence or first.clause.labels != second.clause.labels:
            continue
        marks = [at for at in range(first.at + 1, second.at) if words.word(at) in _BESIDE]
        between = range(first.at + 1, second.at)
        if not marks or words.verbs(between) & DEEDS or words.has(between, "stop_noun"):
            continue
        asked = [each.start for each in words.clauses if each.link == "when" and each.start <= first.at]
        begin = max([*asked[-1:], words.sentence_at(first.at).start])
        parted = (
            at for at in range(first.at - 1, begin, -1) if words.word(at) in _BESIDE or words.has([at], "quantity")
        )
        here = range(next(parted, begin), marks[0])
        there = range(marks[-1] + 1, _end_of(words, second.at))
        own = {words.names.actors[at] for at in here if at in words.names.actors}
        other = {words.names.actors[at] for at in there if at in words.names.actors}
        if len(own) == 1 and len(other) == 1 and own != other:
            (first.actor,), (second.actor,) = own, other
        elif len(other) == 1 and not own and not any(at in words.names.actors for at in range(begin, first.at)):
            first.actor = 1 - next(iter(other))
            told = any(words.word(at) in _THIS_AMOUNT for at in here)
            told = told or any(words.word(at) in ("this", "that") and "measure" in words.tags(at + 1) for at in here)
            earlier = [m for m in places if m.at < begin and m.actor == first.actor and _is_measured_alike(m, first)]
            if told and not words.has(here, "landmark") and earlier:
                first.landmark, first.relation = earlier[-1].landmark, earlier[-1].relation  # "once this time is 2 s"
        elif len(own) == 1 and not other and any(_is_someone(words, at) for at in there if at < second.at):
            second.actor = 1 - next(iter(own))


def _is_measured_alike(first: Measured, second: Measured) -> bool:
    assert first.quantity is not None
    assert second.quantity is not None
    return first.quantity.dimension == second.quantity.dimension


def _speeds_of_each(words: Words, found: list[Measured]) -> None:
    """Read "the ego and the hero drive at 6 m/s and 12 m/s" and "6 m/s is the speed of A, and 12 m/s of B"."""
    speeds = [made for made in found if made.kind == "speed" and not made.target]
    for first, second in pairwise(speeds):
        alike = first.actor == second.actor and first.clause.sentence == second.clause.sentence
        if not alike or any(
            each is not first and each is not second and each.clause.sentence == first.clause.sentence
            for each in speeds
        ):
            continue
        sentence = words.sentence_at(first.at)
        actors = words.names.actors
        before = [actors[at] for at in range(sentence.start, first.at) if at in actors]
        between = [actors[at] for at in range(first.at + 1, second.at) if at in actors]
        after = [actors[at] for at in range(second.at + 1, sentence.stop) if at in actors]
        acts = words.verbs(sentence) & {"brake", "stop", "accelerate", "pass", "complete"}
        if acts or len({*before, *between, *after}) != 2:
            continue
        if len(before) == 2 and not between and not after:
            first.actor, second.actor = before
            words.used |= {at for at in sentence if "respectively" in words.tags(at)}
        elif not before and len(between) == 1 and len(after) == 1 and between != after:
            first.actor, second.actor = between[0], after[0]


def _end_of(words: Words, at: int) -> int:
    """Return where what is said of an amount ends."""
    parting = ("quantity", "comma", "end", "link", "colon")
    return next((i for i in range(at + 1, len(words.tokens)) if words.has([i], *parting)), len(words.tokens))


def _is_someone(words: Words, at: int) -> bool:
    """Whether a word stands for a vehicle that is not the one just named: "himself", "the second", "the grey one"."""
    return words.word(at) in _OTHERS or ("unknown" in words.tags(at) and "determiner" in words.tags(at - 1))
