"""Refuses what this reader must not step over: what cannot be orchestrated, denials, bounds, words without a part.

What enters: words, before and after they were read. What leaves: nothing, or a refusal that names the words. Words
that are not known may be set aside; words that tell a fact may not.
"""

from __future__ import annotations

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.clauses import BOUNDS, NEGATIVES
from scenewright.translate.gist.words import DEEDS, Clause, Deed, Words


def refuse_left_over(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse a text in which a word that tells a fact had no part."""
    _refuse_meanwhile(words, deeds, trigger_sentence)
    _refuse_unmeasured(words, trigger_sentence)
    _refuse_each(words, trigger_sentence)
    _refuse_turns_of_ego(words, trigger_sentence)
    _refuse_strange_links(words, trigger_sentence)
    _refuse_lost_orders(words, deeds, trigger_sentence)
    for at, token in enumerate(words.tokens):
        if at in words.used:
            continue
        clause = next((each for each in words.clauses if at in each.inside), None)
        following = next((each for each in words.clauses if each.start == at + 1), None)
        lost = "negation" in token.tags or "respectively" in token.tags or token.tags.get("verb") == "fail"
        lost = lost or (token.text.lower() in NEGATIVES and _denies_something(words, at))
        lost = lost and not _denies_nothing(words, at, clause, trigger_sentence)
        if "landmark" in token.tags:
            before = clause is not None and clause.sentence < trigger_sentence
            quiet = clause is not None and not words.has(clause.inside, "quantity")
            lost = (
                clause is not None
                and not (before and quiet)
                and not _is_defined(words, at)
                and at + 1 not in words.names.actors  # "the crossing car"
            )  # "pulls up to the stop line" before anything
        elif following is not None and following.link in BOUNDS:
            lost = not _repeats(words, following, deeds, trigger_sentence)
        elif following is not None and following.link == "when" and following.sentence >= trigger_sentence:
            denied = _asks_otherwise(words, at) and all(
                "negation" in words.tags(i) for i in following.inside
            )  # "If not, please build it."
            lost = not _tells_moment(words, following) and not denied
        elif clause is not None and ("unknown" in token.tags or token.tags.get("verb") == "attitude"):
            lost = _is_strange_condition(words, at, clause)
        if lost:
            raise words.refuse(f"'{token.text}' has no part in what was understood", token.span)


def _refuse_strange_links(words: Words, trigger_sentence: int) -> None:
    """Refuse "gets by that point ere the ego does": a word that is not known ties the ego to what the hero does."""
    for clause in (each for each in words.clauses if each.sentence >= trigger_sentence and not each.aside):
        for at in clause.inside[1:]:
            named = words.skip(at + 2, frozenset(("actor_adjective", "heading")))
            strange = "unknown" in words.tags(at) and at not in words.names.actors and not words.word(at).endswith("ly")
            tied = "determiner" in words.tags(at + 1) and words.names.actors.get(named) == EGO_ID
            acted = words.verbs(range(clause.start, at)) & DEEDS
            if strange and tied and acted and not words.has([at - 1], "comma", "end", "link"):
                raise words.refuse(f"'{words.word(at)}' was not understood: it may be an order", words.tokens[at].span)


def _refuse_meanwhile(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse "passes the conflict point while the ego is turning": neither before nor after it."""
    for clause in (each for each in words.clauses if each.sentence >= trigger_sentence):
        turns = words.verbs(clause.inside) & {"turn", "pull_out", "pass", "complete"}
        during = (
            clause.link == "and" and words.word(clause.start - 1) in ("while", "whilst") and clause.subject == EGO_ID
        )
        acted = any(each.actor == HERO_ID and each.clause.sentence == clause.sentence for each in deeds)
        if during and turns and acted and not words.has(clause.inside, "quantity"):
            raise words.refuse("what happens meanwhile cannot be compared", words.span(clause), "before or after it")


def _refuse_unmeasured(words: Words, trigger_sentence: int) -> None:
    """Refuse "when the ego is level with the mailbox and the van 15 m from it": half of the moment is not known."""
    for number, clause in enumerate(words.clauses):
        asked = clause.link == "when" and clause.sentence == trigger_sentence and clause.named
        if not asked or not words.has(clause.inside, "be"):
            continue
        following = [each for each in words.clauses[number + 1 : number + 3] if each.sentence == clause.sentence]
        rest = [each for each in following[:1] if not each.named and each.link == "and"]
        told = [at for each in (clause, *rest) for at in each.inside]
        measured = words.has(told, "quantity", "landmark", "back_reference", "area", "measure")
        strange = any("unknown" in words.tags(at) and at not in words.names.actors for at in told)
        if strange and not measured:
            raise words.refuse("it is not known where this is", words.span(clause), "a landmark of the map")
        for each in _condition(words, clause)[1:]:
            _refuse_strange_part(words, each)


def _refuse_turns_of_ego(words: Words, trigger_sentence: int) -> None:
    """Refuse "... precedes the beginning of the ego's turn": told after the trigger, it orders something."""
    for at in range(2, len(words.tokens)):
        owned = words.tag(at, "event_noun") == "turn" and "genitive" in words.tags(at - 1)
        if not owned or words.names.actors.get(at - 2) != EGO_ID or at in words.used:
            continue
        clause = next((each for each in words.clauses if at in each.inside), None)
        if clause is not None and clause.sentence > trigger_sentence and not clause.aside:
            raise words.refuse("it is not clear what this orders", words.span(clause))


def _refuse_lost_orders(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse "only then does the ego get there", told after the trigger, where it was not understood as an order."""
    for clause in (each for each in words.clauses if each.sentence >= trigger_sentence and each.link == "then"):
        own = clause.subject == EGO_ID and clause.named and not words.has(clause.inside, "quantity")
        moves = words.verbs(clause.inside) & {"pass", "reach", "turn", "complete", "begin", "enter"}
        if own and moves and not any(deed.clause.start == clause.start for deed in deeds):
            raise words.refuse("it is not clear what this orders", words.span(clause))


def _refuse_each(words: Words, trigger_sentence: int) -> None:
    """Refuse "when each is 30 m from it" where only one of the two was understood."""
    for clause in (each for each in words.clauses if each.sentence == trigger_sentence and not each.both):
        for at in clause.inside:
            alone = words.word(at) == "each" and words.word(at + 1) != "other"
            if (alone or words.word(at) == "each of them") and words.has(clause.inside, "quantity"):
                raise words.refuse("it is not clear whose amount this is", words.span(clause))


def _refuse_strange_part(words: Words, clause: Clause) -> None:
    """Refuse "when the ego is 6 m from it and its computer has understood the offer, ...": that cannot be seen."""
    known = ("quantity", "landmark", "back_reference", "area", "measure", "heading", "direction", "oncoming_way")
    finite = words.has(clause.inside, "be", "auxiliary")
    strange = any("unknown" in words.tags(at) and at not in words.names.actors for at in clause.inside)
    if clause.link == "and" and clause.named and finite and strange and not words.has(clause.inside, *known):
        raise words.refuse("it is not known when this is so", words.span(clause))


def _denies_something(words: Words, at: int) -> bool:
    """Whether "no" and the like stand before a deed: "no stop", "shall not stop", but not "no worries"."""
    return words.has([at + 1], "verb", "stop_noun", "event_noun") or words.has([at + 2], "verb")


def _denies_nothing(words: Words, at: int, clause: Clause | None, trigger_sentence: int) -> bool:
    """Whether a denial tells nothing of a drive: "it won't have the place to itself", "without regard for anybody"."""
    if clause is None or "negation" not in words.tags(at):
        return False
    if clause.link == "when" and len(clause.inside) == 1 and _asks_otherwise(words, clause.start - 1):
        return True  # "If not, please build it."
    if clause.link == "then" and at == clause.end - 1 and clause.sentence < trigger_sentence:
        return True  # "at first it yields and then does not: when ..."
    rest = range(at + 1, clause.end)
    if words.word(at + 1) in ("care", "mind", "bother") and not words.verbs(rest):
        return True  # "it does not care about us", but not "it does not bother to complete its turn"
    if words.word(at) == "rather than" and words.has([at + 1], "measure", "measures"):
        return True  # "We used times rather than distances here."
    plain = ("unknown", "determiner", "pronoun", "possessive", "preposition", "auxiliary", "link", "adverb")
    known = any(
        "relation" in words.tags(i)
        or (not words.tags(i).keys() & set(plain) and words.word(i) not in ("place", "end"))
        or i in words.names.actors
        for i in rest
    )
    done = any(words.word(i).endswith("ing") for i in rest) or words.has(rest, "verb", "heading", "direction")
    return len(rest) > 1 and "unknown" not in words.tags(at + 1) and not known and not done


def _asks_otherwise(words: Words, at: int) -> bool:
    """Whether this is the "If" of "If not, please build it."."""
    first = not at or "end" in words.tags(at - 1)
    return words.word(at) == "if" and first and "comma" in words.tags(at + 2)


def _repeats(words: Words, clause: Clause, deeds: list[Deed], trigger_sentence: int) -> bool:
    """Whether "until it has come to a stop" only repeats what the hero does, or a way is told: "before it turns"."""
    own = [deed for deed in deeds if deed.clause is clause]
    strange = any("unknown" in words.tags(at) and not words.word(at).endswith("ly") for at in clause.inside)
    again = (
        bool(own)
        and not strange
        and all(deed.kind in ("stop", "brake", "wait") and deed.actor == HERO_ID for deed in own)
    )
    early = clause.link == "before" and clause.subject == HERO_ID and clause.sentence < trigger_sentence
    way = early and not words.has(clause.inside, "quantity") and not words.verbs(clause.inside) & {"pass", "complete"}
    return way or (clause.link in ("until", "after") and again)


def _condition(words: Words, clause: Clause) -> list[Clause]:
    """Return the clauses of a condition, up to where the hero acts."""
    found: list[Clause] = []
    for each in (c for c in words.sentence(clause) if c.start >= clause.start):
        acts = each.link != "that" and words.verbs(each.inside) & {"brake", "stop", "accelerate", "pass", "complete"}
        if found and acts and not words.has(range(each.start, each.start + 3), "quantity"):
            break
        found.append(each)
    return found[:6]


def _tells_moment(words: Words, clause: Clause) -> bool:
    """Whether a "when" has an amount, or only tells when something begins that is known."""
    told = any(words.has(each.inside, "quantity") for each in _condition(words, clause))
    begins = words.verbs(clause.inside) & {"brake", "stop", "accelerate"} and clause.subject == HERO_ID
    begins = begins and len({words.names.actors[at] for at in clause.inside if at in words.names.actors}) < 2
    return told or bool(begins) or "start" in clause.labels


def _is_strange_condition(words: Words, at: int, clause: Clause) -> bool:
    """Whether something that is not known may be what the hero waits for: "when the ego, 30 m from it, honks"."""
    sentence = words.sentence(clause)
    asked = next((each for each in sentence if each.link == "when"), None)
    measured = asked is not None and any(words.has(each.inside, "quantity") for each in sentence)
    if asked is None or not measured or clause.start < asked.start or clause.link == "that":
        return False
    earlier = [each for each in sentence if asked.start <= each.start <= clause.start]
    acted = any(each.subject == HERO_ID and words.verbs(each.inside) & DEEDS for each in earlier)
    pronoun = any(i in words.names.pronouns for i in clause.inside)
    main = clause is not asked and (clause.named or pronoun) and not words.has(clause.inside, "quantity")
    word = words.word(at)
    if at in words.names.pronouns or (clause is asked and len(clause.inside) == 1):
        return False
    if "start" in asked.labels:
        return False  # "when we press start"
    alone = not words.has([at + 1], "noun", "hero", "ego", "landmark", "area", "unknown")
    return not acted and not main and alone and len(word) > 3 and word.endswith("s")


def _is_defined(words: Words, at: int) -> bool:
    """Whether a landmark only says what a shorter name of it means: "CP (conflict point)"."""
    for near in range(at - 4, at + 5):
        same = near != at and words.tag(near, "landmark") == words.tags(at)["landmark"]
        between = range(min(near, at) + 1, max(near, at))
        if same and not words.has(between, "quantity", "verb", "end", "ego", "hero"):
            return True
    return False
