"""Refuses what is told of somebody, of a place, of a deed or in a condition, and is not known.

What enters: words, when they were read. What leaves: nothing, or a refusal that names the words. Remarks about
something else may be set aside; what may change the scenario may not.
"""

from __future__ import annotations

from scenewright.translate.events import HERO_ID
from scenewright.translate.gist.objects import SEES
from scenewright.translate.gist.words import DEEDS, Clause, Deed, Words

_AT_TIMES = frozenset(
    ["usually", "normally", "often", "probably", "maybe", "perhaps", "likely", "typically", "generally", "mostly",
     "rarely", "seldom", "possibly", "hardly", "barely", "nearly", "almost"]
)  # fmt: skip
_MANNERS = (
    "altogether",
    "anew",
    "whole",
    "back",
    "enough",
    "once",
    "own",
    "time",
    "time's",
    "hurry",
    "haste",
    "force",
    "duration",
)
_OVER = ("over", "across", "through", "onto", "around", "past", "along", "beside", "alongside")
_MEANWHILE = ("as", "while", "whilst", "and", "but")
_ACTS = ("brake", "stop", "accelerate", "go", "keep", "pass", "complete", "wait", "not_yield")
_HARMLESS = ("interest", "matters", "own", "more", "further", "still")


def refuse_strangers(words: Words) -> None:
    """Refuse a text in which somebody does something of whom it is not known who it is."""
    if words.names.unclear is not None:
        raise words.refuse("this may be either of the two vehicles", words.tokens[words.names.unclear].span)
    if len(words.names.kinds) > 1:
        raise words.refuse("more than one other vehicle is spoken of")
    for clause in words.clauses:
        acts = words.verbs(clause.inside) & {*DEEDS, "lane_follow"} or words.has(clause.inside, "quantity")
        if clause.aside and acts:
            raise words.refuse("it is not clear who does this", words.span(clause))


def refuse_strange_conditions(words: Words, last: int) -> None:
    """Refuse "when the ego is 15 m from it, its indicator has come on and the hero is 33 m from it".

    `last` is where the last amount of the trigger stands: whatever is told before it has to be known.
    """
    _refuse_strange_part_of_trigger(words)
    sentence = words.sentence_at(last).start
    first = next((each.start for each in words.clauses if each.link == "when" and sentence <= each.start <= last), None)
    if first is None:
        return
    for at in range(first, _end_of_condition(words, last)):
        clause = next((each for each in words.clauses if at in each.inside), None)
        felt = words.tag(at, "verb") == "attitude" and words.word(at) not in SEES
        if felt and clause is not None and clause.link in ("when", "and") and not words.has(clause.inside, "quantity"):
            raise words.refuse("a condition like this cannot be seen", words.span(clause))  # "and its driver waves"
        if "unknown" not in words.tags(at) or at in words.names.actors or words.word(at).endswith("ly"):
            continue
        if any(words.has([near], "landmark") for near in (at + 1, at - 1)) or words.word(at) in _HARMLESS:
            continue
        if at in words.used and words.word(at) == "clock":
            continue  # "when 5 s clock"
        clause = next((each for each in words.clauses if at in each.inside), None)
        if clause is not None and not clause.aside and not _is_part_of_name(words, at):
            raise words.refuse(f"'{words.word(at)}' was not understood: it may be a condition", words.tokens[at].span)


def _refuse_strange_part_of_trigger(words: Words) -> None:
    """Refuse "Trigger: ego 22 m from it, hero 27 m from it, hero's driver looking up from the phone"."""
    for clause in (each for each in words.clauses if "trigger" in each.labels and each.named):
        told = words.has(clause.inside, "quantity", "landmark", "measure") or words.verbs(clause.inside) & DEEDS
        strange = any("unknown" in words.tags(at) and words.word(at).endswith("ing") for at in clause.inside)
        felt = words.verbs(clause.inside) & {"attitude", "want"}
        if not told and (strange or felt):
            raise words.refuse("a condition like this cannot be seen", words.span(clause))


def _end_of_condition(words: Words, last: int) -> int:
    """Return where a condition ends: "brakes when the ego is 7 m behind it and gives a long blast on its horn"."""
    end = last
    for clause in words.clauses:
        if last in clause.inside:
            end = clause.end
        elif clause.start == end + 1 and clause.link == "and" and words.word(end) == "and":
            told = words.verbs(clause.inside) - {"attitude"} or words.has(clause.inside, "be", "auxiliary", "quantity")
            acts = (_is_named(words, clause) and told) or words.verbs(clause.inside) & DEEDS
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
    if back == at - 1 and back in words.names.actors and words.word(at).endswith(("s", "ed", "ing")):
        return ahead in words.names.actors  # "its driver waves" tells what he does
    ahead += "genitive" in words.tags(ahead)  # "the learner's car"
    return ahead in words.names.actors or back in words.names.actors


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
        waits = waits and "quantity" not in words.tags(wait - 1)  # "when 5 m remain for it to the line"
        if waits and words.named(range(wait + 2, min(wait + 5, clause.end))) == HERO_ID:
            raise words.refuse("it is not known for whom this one waits", words.span(clause))


def refuse_strange_places(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse "comes to a halt level with the letter box": what a deed is told with has to be known."""
    for deed in deeds:
        clause = deed.clause
        late = deed.actor == HERO_ID and deed.kind in _ACTS and clause.sentence >= trigger_sentence
        if not late or clause.link == "when":
            continue
        for at in range(deed.at + 1, clause.end):
            free = "unknown" in words.tags(at) and not _is_part_of_name(words, at) and at not in words.names.actors
            plain = (
                words.word(at).endswith("ly") or words.word(at) in _MANNERS or words.has([at + 1], "noun", "landmark")
            )
            beside = words.has([at - 1], "preposition", "determiner", "possessive", "genitive", "unknown")
            if free and beside and not plain and words.word(at - 1) not in ("with", "without"):
                raise words.refuse("it is not known where this is", words.tokens[at].span)


def refuse_strange_ways(words: Words) -> None:
    """Refuse "RT into drvwy": where a vehicle goes has to be known."""
    for at, token in enumerate(words.tokens):
        if token.tags.get("preposition") != "into":
            continue
        ahead = at + 1
        while words.has([ahead], "determiner", "actor_adjective", "area_adjective", "possessive", "same"):
            ahead += 1
        right = words.word(ahead) in ("priority", "precedence")  # "holds on to its priority"
        strange = "unknown" in words.tags(ahead) and ahead not in words.names.actors and not right
        if strange and words.has([ahead + 1], "end", "comma"):
            raise words.refuse("it is not known where this is", words.tokens[ahead].span)


def refuse_strange_company(words: Words, deeds: list[Deed], trigger_sentence: int) -> None:
    """Refuse "brakes, skating over ice" and "as the street lamps go out, it starts": what goes with a deed is known."""
    acting = {deed.clause.sentence for deed in deeds if deed.actor == HERO_ID and deed.kind in _ACTS}
    for clause in words.clauses:
        if clause.aside or clause.sentence not in acting or clause.sentence < trigger_sentence:
            continue
        first = clause.start
        parted = words.has([first - 1], "comma") or words.word(first - 1) == ";"
        parted = parted and words.word(first - 1) != "("
        if _is_free(words, first) and words.word(first).endswith(("ing", "ed", "wn")) and parted:
            beside = any(deed.clause.end == first - 1 for deed in deeds)
            beside = beside or not words.word(first).endswith("ing")
            if beside and words.has([first + 1], "preposition", "adverb", "unknown", "determiner", "relation"):
                message = f"'{words.tokens[first].text}' was not understood: it may be what a vehicle does"
                raise words.refuse(message, words.tokens[first].span)
        for at in clause.inside:
            if _is_free(words, at) and any(words.word(i) in _OVER for i in (at - 1, at - 2)):
                raise words.refuse("it is not known where this is", words.tokens[at].span)
        while words.word(first) in _MEANWHILE:
            first += 1
        known = clause.named or any(at in words.names.pronouns for at in clause.inside)
        told = words.has(clause.inside, "quantity", "landmark") or (known and any(d.clause is clause for d in deeds))
        article = "determiner" in words.tags(first) or _is_free(words, first)
        acts = any(
            words.tokens[at].forms & {"s", "base"} or words.has([at], "be") for at in range(first + 1, clause.end)
        )
        strange = any(_is_free(words, at) for at in clause.inside)
        beside = words.word(first - 1) in _MEANWHILE and article and not _is_named(words, clause)
        if beside and strange and acts and not told:
            raise words.refuse("it is not known who this is and what it changes", words.span(clause))


def _is_free(words: Words, at: int) -> bool:
    """Whether a word is not known and no part of a name."""
    known = words.word(at).endswith("ly") or at in words.names.actors or not words.word(at).isalpha()
    return "unknown" in words.tags(at) and not known and not _is_part_of_name(words, at)


def _is_named(words: Words, clause: Clause) -> bool:
    """Whether a vehicle is the subject of a clause, and nothing that belongs to it."""
    at = clause.start
    while words.has([at], "determiner", "actor_adjective", "heading") and at not in words.names.actors:
        at += 1
    return at in words.names.actors and "genitive" not in words.tags(at + 1)


def refuse_strange_deeds(words: Words, trigger_sentence: int) -> None:
    """Refuse "the hero stups": what a vehicle does from the trigger on has to be known."""
    for at, token in enumerate(words.tokens):
        if token.text.lower() in _AT_TIMES and words.verbs(range(at + 1, at + 4)) & DEEDS:
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
    obliged = ("has to", "have to", "had to", "must", "needs to", "is forced to", "ought to")
    if words.word(at - 1) in obliged or (words.word(at - 1) == "to" and words.word(at - 2) in ("has", "have", "needs")):
        return True  # "which has to dodge it"
    passive = word.endswith("ed") and words.has([at - 1], "be") and words.has(range(clause.start, at), "pronoun")
    joined = words.word(at - 1) in ("but", "then") and word.endswith("s") and not word.endswith("ss")
    does = words.word(at - 1) == "and" and word.endswith("s") and words.has([at + 1], "determiner", "possessive")
    if does and clause.start >= at - 1:
        return True  # "and dazzles the ego's camera"
    return passive or joined


def _is_stranger(words: Words, at: int) -> bool:
    """Whether a word that is not known does something: "a llama sings"."""
    if "unknown" not in words.tags(at) or at in words.names.actors:
        return False
    return words.has([at + 1], "unknown", "verb", "auxiliary", "be") and at + 1 not in words.names.actors
