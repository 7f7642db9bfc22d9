"""Refuses what this reader must not step over: what cannot be orchestrated, denials, bounds, words without a part.

What enters: words, before and after they were read. What leaves: nothing, or a refusal that names the words. Words
that are not known may be set aside; words that tell a fact may not.
"""

from __future__ import annotations

import re

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.clauses import BOUNDS, NEGATIVES
from scenewright.translate.gist.words import Clause, Deed, Words

# Limits that hold for a while, and what did not or will not happen: no reader of facts can tell what follows.
_DANGERS = frozenset(
    ["exceed", "exceeds", "exceeded", "exceeding", "higher", "lower", "maximum", "minimum", "max", "min", "limit",
     "limited", "cap", "capped", "predicts", "predicted", "says", "said", "twice", "thrice", "repeatedly",
     "backing", "backwards", "backward", "reversing", "supposedly", "allegedly", "hypothetically",
     "vanishes", "disappears", "flyover", "overpass", "underpass", "viaduct", "tunnel", "roundabout"]
)  # fmt: skip
_EDGE_OF_TURN = re.compile(r"\b(?:start|beginning|end) of (?:its|the|his|her)\s+(?:\w+\s+)?turn\b", re.IGNORECASE)
_COUNTED = re.compile(
    r"(?:[A-Za-z]-|#|\[|\b(?:run|test|number|no\.?|case|phase|step|milestone|stage|unit|item|day|version|v)\s?)$", re.IGNORECASE
)
_UNREAL = re.compile(
    r"(?:^|[.;!?]\s+|,\s+)(?:had|were) (?:the|it|a|an)\b"
    r"|(?<!as )\bif \w+(?: \w+)? (?:were|had)\b|(?<!\bi )(?<!\bwe )\bwould(?: not|n't)? have\b",
    re.IGNORECASE,
)
_ALL_BUT = re.compile(r"\b(?:any|every|no)thing (?:but|except|other than)\b|\ball but\b", re.IGNORECASE)
_DEPENDS = re.compile(
    r"\b(?:provided|providing|assuming|on (?:the )?condition)(?: that)?\b(?![^,.;]*\d)"
    r"|\b(?:as|so) long as\b|\bin case\b"
    r"|\b(?:only|even) if\b|\bexcept (?:when|if|that)\b",
    re.IGNORECASE,
)
_CHANCE = re.compile(
    r"\b(?:half|most|some|many|few|a third|one|two|\d+ ?%|per ?cent)(?: out)? of (?:the |all )?"
    r"(?:runs|cases|times?|trials|tests|drivers)\b|\b(?:sometimes|occasionally|now and then|every other)\b",
    re.IGNORECASE,
)
_AGAIN_AND_AGAIN = re.compile(
    r"\b(?:as a rule|by and large|more often than not|over and over|again and again|time and again|keeps? up this"
    r"|for the rest of the|and so on|on the verge of|but thinks? better of)\b",
    re.IGNORECASE,
)
_TOUCHES = re.compile(
    r"(?<!the )\b(?:brush|clip|graz|scrap|touch|bump|scratch)(?:e?s|ing|ed|ping|ped)? (?:the|its|our|against|into)\b(?! (?:brake|pedal|stop))",
    re.IGNORECASE,
)
_AT_TIMES = frozenset(
    ["usually", "normally", "often", "probably", "maybe", "perhaps", "likely", "typically", "generally", "mostly",
     "rarely", "seldom", "possibly", "hardly", "barely", "nearly", "almost"]
)  # fmt: skip
_MANNERS = ("altogether", "anew", "whole", "back", "enough", "once", "own", "time", "time's", "hurry", "haste", "force", "duration")
_HARMLESS = ("interest", "matters", "own", "more", "further", "still")
_WHICH = re.compile(r"\bwhich of (?:the two|them|the (?:vehicles|cars)|these)\b", re.IGNORECASE)
_DEEDS = frozenset(
    ["brake", "stop", "accelerate", "pass", "complete", "yield", "not_yield", "turn", "pull_out", "wait", "reach",
     "enter"]
)  # fmt: skip


def refuse_dangers(words: Words) -> None:
    """Refuse what cannot be orchestrated, before anything is read."""
    for pattern, message in (
        (_EDGE_OF_TURN, "a place within a turn is not read here"),
        (_UNREAL, "what did not happen is not read here"),
        (_ALL_BUT, "what does not happen is no scenario"),
        (_DEPENDS, "a condition like this cannot be orchestrated"),
        (_WHICH, "this is left open"),
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


def refuse_strangers(words: Words) -> None:
    """Refuse a text in which somebody does something of whom it is not known who it is."""
    if words.names.unclear is not None:
        raise words.refuse("this may be either of the two vehicles", words.tokens[words.names.unclear].span)
    if len(words.names.kinds) > 1:
        raise words.refuse("more than one other vehicle is spoken of")
    for clause in words.clauses:
        acts = words.verbs(clause.inside) & {*_DEEDS, "lane_follow"} or words.has(clause.inside, "quantity")
        if clause.aside and acts:
            raise words.refuse("it is not clear who does this", words.span(clause))


def refuse_strange_conditions(words: Words, last: int) -> None:
    """Refuse "when the ego is 15 m from it, its indicator has come on and the hero is 33 m from it".

    `last` is where the last amount of the trigger stands: whatever is told before it has to be known.
    """
    sentence = words.sentence_at(last).start
    first = next((each.start for each in words.clauses if each.link == "when" and sentence <= each.start <= last), None)
    if first is None:
        return
    for at in range(first, _end_of_condition(words, last)):
        if "unknown" not in words.tags(at) or at in words.names.actors or words.word(at).endswith("ly"):
            continue
        if any(words.has([near], "landmark") for near in (at + 1, at - 1)) or words.word(at) in _HARMLESS:
            continue
        clause = next((each for each in words.clauses if at in each.inside), None)
        if clause is not None and not clause.aside and not _is_part_of_name(words, at):
            raise words.refuse(f"'{words.word(at)}' was not understood: it may be a condition", words.tokens[at].span)


def _end_of_condition(words: Words, last: int) -> int:
    """Return where a condition ends: "brakes when the ego is 7 m behind it and gives a long blast on its horn"."""
    end = last
    for clause in words.clauses:
        if last in clause.inside:
            end = clause.end
        elif clause.start == end + 1 and clause.link == "and" and words.word(end) == "and":
            acts = clause.named or words.verbs(clause.inside) & _DEEDS
            end = end if acts else clause.end
    return end


def _is_part_of_name(words: Words, at: int) -> bool:
    """Whether this is "ice cream" in "the ice cream van", or "trailer" in "the car with the trailer"."""
    ahead, back = at + 1, at - 1
    while "unknown" in words.tags(ahead) and ahead not in words.names.actors:
        ahead += 1
    while "unknown" in words.tags(back) or "determiner" in words.tags(back) or words.word(back) == "with":
        if back in words.names.actors:
            break
        back -= 1
    ahead += "genitive" in words.tags(ahead)  # "the learner's car"
    return ahead in words.names.actors or back in words.names.actors


def refuse_left_over(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse a text in which a word that tells a fact had no part."""
    _refuse_meanwhile(words, deeds, trigger_sentence)
    _refuse_unmeasured(words, trigger_sentence)
    _refuse_each(words, trigger_sentence)
    _refuse_turns_of_ego(words, trigger_sentence)
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


def refuse_third_parties(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse "... while a llama sings": somebody who is not known does something while it all happens."""
    for clause in (each for each in words.clauses if each.sentence >= trigger_sentence):
        _refuse_strange_subject(words, clause)
        _refuse_strange_cause(words, clause)
    acting = {deed.clause.sentence for deed in deeds if deed.clause.sentence >= trigger_sentence}
    for clause in (each for each in words.clauses if each.sentence in acting):
        for at in clause.inside:
            beside = words.tag(at, "link") == "and" and "determiner" in words.tags(at + 1)
            part = words.word(at) == "with" and at - 1 in words.names.actors  # "the car with the trailer"
            if beside and not part and _is_stranger(words, at + 2):
                raise words.refuse("it is not known who this is and what it changes", words.tokens[at + 2].span)
    for clause in words.clauses:
        if clause.sentence not in acting or clause.named or any(at in words.names.pronouns for at in clause.inside):
            continue
        unknown = [at for at in clause.inside if "unknown" in words.tags(at)]
        begins = "determiner" in words.tags(clause.start) and clause.start + 1 in unknown
        known = words.has(clause.inside, "landmark", "quantity", "direction", "heading", "area")
        only_is = len(clause.inside) == 3 and "be" in words.tags(clause.end - 1)  # "The decision is then revised"
        only_is = only_is or (words.word(clause.end) == ":" and words.has(clause.inside, "be") and clause.aside)
        if begins and not known and not only_is and (clause.aside or len(unknown) > 1):
            raise words.refuse("it is not known who this is and what it changes", words.span(clause))


def _refuse_strange_subject(words: Words, clause: Clause) -> None:
    """Refuse "the green arrow having gone out", "its trailer coming loose", "when the ego's planner has decided"."""
    others = [each for each in words.sentence(clause) if each is not clause]
    following = next((each for each in others if each.start > clause.start), None)
    told = following is not None and following.link in ("when", "colon")  # "Its policy is cooperative: ..."
    if not others or told or "start" in clause.labels:
        return
    at = clause.start
    while at < clause.end and words.has([at], "link", "adverb", "comma"):
        at += 1
    article = words.tags(at).keys() & {"determiner", "possessive"}
    name = at + bool(article)
    if name in words.names.actors and "genitive" in words.tags(name + 1):
        at, article = name + 1, {"genitive"}
    if not article or at in words.names.actors:
        return
    at += 1
    while (
        at < clause.end
        and words.has([at], "actor_adjective", "area_adjective", "unknown")
        and "unknown" not in words.tags(at)
    ):
        at += 1
    first = at
    while at < clause.end and "unknown" in words.tags(at) and at not in words.names.actors:
        at += 1
    if at == first or at >= clause.end or at in words.names.actors:
        return
    acts = words.has([at], "be", "auxiliary") or ("verb" in words.tags(at) and "base" not in words.tokens[at].forms)
    if acts or words.word(at) == "having" or "ing" in words.tokens[at].forms:
        raise words.refuse("it is not known who this is and what it changes", words.span(clause))


def _refuse_strange_cause(words: Words, clause: Clause) -> None:
    """Refuse "at the first sound of its horn it starts off", "the hero waits for the bus to go by"."""
    at = clause.start
    cause = words.word(at) in ("at", "on", "upon") and "determiner" in words.tags(at + 1)
    strange = any("unknown" in words.tags(i) and i not in words.names.actors for i in range(at + 2, at + 4))
    told = words.has(range(at, min(at + 6, clause.end)), "quantity", "measure", "landmark", "area")
    if cause and strange and not told:
        raise words.refuse("it is not known when this is", words.span(clause))
    for wait in clause.inside:
        waits = words.tag(wait, "verb") == "wait" and words.word(wait + 1) == "for" and clause.subject == HERO_ID
        if waits and words.named(range(wait + 2, min(wait + 5, clause.end))) == HERO_ID:
            raise words.refuse("it is not known for whom this one waits", words.span(clause))


def _denies_something(words: Words, at: int) -> bool:
    """Whether "no" and the like stand before a deed: "no stop", "shall not stop", but not "no worries"."""
    return words.has([at + 1], "verb", "stop_noun", "event_noun") or words.has([at + 2], "verb")


def refuse_strange_places(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse "comes to a halt level with the letter box": what a deed is told with has to be known."""
    for deed in deeds:
        clause = deed.clause
        late = deed.actor == HERO_ID and deed.kind in ("stop", "brake", "pass") and clause.sentence >= trigger_sentence
        if not late or clause.link == "when":
            continue
        for at in range(deed.at + 1, clause.end):
            beside = words.has([at - 1], "preposition", "determiner", "possessive", "genitive", "unknown")
            free = "unknown" in words.tags(at) and not _is_part_of_name(words, at) and at not in words.names.actors
            plain = words.word(at).endswith("ly") or words.word(at) in _MANNERS or words.has([at + 1], "noun", "landmark")
            if free and beside and not plain and words.word(at - 1) not in ("with", "without"):
                raise words.refuse("it is not known where this is", words.tokens[at].span)


def refuse_strange_deeds(words: Words, trigger_sentence: int) -> None:
    """Refuse "the hero stups": what a vehicle does from the trigger on has to be known."""
    for at, token in enumerate(words.tokens):
        if token.text.lower() in _AT_TIMES and words.verbs(range(at + 1, at + 4)) & _DEEDS:
            clause = next((each for each in words.clauses if at in each.inside), None)
            if clause is not None and clause.sentence >= trigger_sentence:
                raise words.refuse("what happens at times cannot be orchestrated", token.span)
        if "unknown" not in token.tags or at in words.names.actors or token.text.lower().endswith("ly"):
            continue
        clause = next((each for each in words.clauses if at in each.inside), None)
        acts = at - 1 in words.names.actors or words.has([at - 1], "pronoun")
        compound = words.has([at + 1], "noun", "hero", "ego") or words.word(at).endswith(("er", "or"))
        compound = compound or words.word(at) in ("priority", "precedence")  # "giving the ego priority"
        compound = compound or words.tag(at - 2, "verb") == "leave"  # "should leave the ego undisturbed"
        acts = acts or _is_done(words, at, clause)
        if clause is not None and clause.sentence >= trigger_sentence and acts and not compound:
            raise words.refuse(f"'{token.text}' was not understood: it may be what a vehicle does", token.span)


def _is_done(words: Words, at: int, clause: Clause | None) -> bool:
    """Whether a word that is not known is what a vehicle does or what is done to it: "but thinks", "it is deleted"."""
    word = words.word(at)
    if clause is None or clause.aside or clause.subject is None:
        return False
    passive = word.endswith("ed") and words.has([at - 1], "be") and words.has(range(clause.start, at), "pronoun")
    joined = words.word(at - 1) in ("but", "then") and word.endswith("s") and not word.endswith("ss")
    return passive or joined


def _is_stranger(words: Words, at: int) -> bool:
    """Whether a word that is not known does something: "a llama sings"."""
    if "unknown" not in words.tags(at) or at in words.names.actors:
        return False
    return words.has([at + 1], "unknown", "verb", "auxiliary", "be") and at + 1 not in words.names.actors


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
    again = bool(own) and all(deed.kind in ("stop", "brake", "wait") and deed.actor == HERO_ID for deed in own)
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
    acted = any(each.subject == HERO_ID and words.verbs(each.inside) & _DEEDS for each in earlier)
    pronoun = any(i in words.names.pronouns for i in clause.inside)
    main = clause is not asked and (clause.named or pronoun) and not words.has(clause.inside, "quantity")
    word = words.word(at)
    if at in words.names.pronouns or (clause is asked and len(clause.inside) == 1):
        return False
    if "start" in asked.labels:
        return False  # "when we press start"
    alone = not words.has([at + 1], "noun", "hero", "ego", "landmark", "area", "unknown")
    return not acted and not main and alone and len(word) > 3 and word.endswith("s")


def _is_harmless(words: Words, at: int) -> bool:
    """Whether "crashes" or "traffic" only speaks of the world: "a frequent precursor of crashes"."""
    token, before, after = words.tokens[at], words.tags(at - 1), words.tags(at + 1)
    if words.word(at - 1) == "no":
        words.used.add(at - 1)
        return True  # "there are no pedestrians"
    if token.text.lower() == "traffic":
        later = " ".join(words.word(i) for i in range(at + 1, min(at + 9, len(words.tokens))))
        if re.search(r"\b(?:consists? of|is limited to|amounts to) (?:one|a single|a)\b", later):
            return True  # "Westbound traffic consists of one van"
        return bool(before.keys() & {"heading", "direction", "actor_adjective"})
    kind = token.tags["unsupported"]
    if kind == "collisions" and "quantity" in after:
        return True  # "the AV hits 35 m to the conflict point"
    if (not before or "end" in before) and after.keys() & {"colon", "end"}:
        return kind == "more than one other actor"  # "Actors:"
    if kind == "lateral manoeuvres":
        return _only_goes_first(words, at)
    if kind in ("collisions", "alternatives and chance"):
        return _is_remark(words, at, kind) or (kind != "collisions" and _asks_people(words, at))
    return kind == "more than one other actor" and (before.get("bare_number", "").lower() == "two" or at in words.names.both)


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
    return not told and not words.verbs(sentence) & _DEEDS


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


def _is_defined(words: Words, at: int) -> bool:
    """Whether a landmark only says what a shorter name of it means: "CP (conflict point)"."""
    for near in range(at - 4, at + 5):
        same = near != at and words.tag(near, "landmark") == words.tags(at)["landmark"]
        between = range(min(near, at) + 1, max(near, at))
        if same and not words.has(between, "quantity", "verb", "end", "ego", "hero"):
            return True
    return False
