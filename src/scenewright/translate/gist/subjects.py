"""Finds whom each clause is about: who is named in it, who a pronoun means, who was spoken of before.

What enters: words with names and clauses. What leaves: the clauses, with subjects.
"""

from __future__ import annotations

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.names import FIRST_PERSON, PERSONAL
from scenewright.translate.gist.objects import SEES, is_finite, is_object, seen
from scenewright.translate.gist.words import Clause, Words

_CUED = ("triggered", "activated", "acts", "reacts", "cued")
_MAIN = ("main", "and", "then", "moment", "colon")
_SUBORDINATE = ("before", "after", "until", "when", "that")
_STRONG = frozenset(("brake", "stop", "accelerate"))  # nobody tells the ego to do these
_DEEDS = _STRONG | {"pass", "complete", "wait", "keep"}
RUNS = frozenset(
    ["clock", "video", "clip", "film", "footage", "exposure", "drive", "journey", "trip",
     "trial", "run", "test", "recording", "simulation", "scene", "log", "scenario", "measurement"]
)  # fmt: skip
_HIS = PERSONAL | {"his", "her"}


def give_subjects(words: Words) -> None:
    """Find whom each clause is about, in the order of the text."""
    last: int | None = None
    acting = False  # whether the hero has begun to do something
    for index, clause in enumerate(words.clauses):
        before = words.clauses[index - 1] if index else None
        _name_subject(words, clause)
        clause.both = _is_about_both(words, clause, before)
        if _starts_it(words, clause):
            following = words.clauses[index + 1] if index + 1 < len(words.clauses) else clause
            opens = words.sentence(clause)[0] is clause
            verbless = not words.has(following.inside, "verb", "be") and words.has([following.start], "quantity")
            if following.start == clause.end or (
                (opens or verbless) and following.start == clause.end + 1
            ):  # "when the recording began it was 7 s from it"
                following.labels = [*following.labels, "start"]
            _mark_start(words, clause, before)
        if clause.aside and not clause.named:
            clause.subject = None
            continue
        if clause.subject is None:
            clause.subject = _unnamed(words, index, last, acting)
        verbs = words.verbs(clause.inside)
        if clause.subject == EGO_ID and not clause.named and verbs & {"pass", "complete"} and _beats_ego(words, index):
            clause.subject = HERO_ID
        main = clause.link not in _SUBORDINATE
        acts = verbs & _STRONG or (main and verbs & {"pass", "complete"})
        acting = acting or (clause.subject == HERO_ID and bool(acts))
        if words.word(clause.start - 1) not in SEES:
            last = clause.subject  # who sees the other one goes on: "sees the ego coming, and stops"
        last = _goes_on(words, index, last)


def _beats_ego(words: Words, index: int) -> bool:
    """Whether "before the ego does" follows: who passes before the ego is not the ego."""
    if index + 1 >= len(words.clauses):
        return False
    clause, following = words.clauses[index], words.clauses[index + 1]
    named = words.named(following.inside) == EGO_ID
    earlier = [each for each in words.sentence(clause) if each.start < clause.start]
    told = bool(earlier) and words.has(earlier[-1].inside, "quantity") and any(e.link == "when" for e in earlier)
    acted = bool(earlier) and earlier[-1].subject == EGO_ID and earlier[-1].named and earlier[-1].link in _MAIN
    pronoun = clause.start in words.names.pronouns or words.word(clause.start) in ("its", "his", "her")
    if pronoun:
        told = not acted  # "It completes its turn before the ego passes": whoever it is, it is not the ego
    if not told:
        return False  # "the ego pulls away, and completes its turn before the ego ..." is nonsense
    return following.link == "before" and following.sentence == clause.sentence and named


def _goes_on(words: Words, index: int, last: int | None) -> int | None:
    """Return whom "it" means in the sentence after "The van goes once the ego has passed": who acts there."""
    clause = words.clauses[index]
    following = words.clauses[index + 1] if index + 1 < len(words.clauses) else clause
    if (
        words.has(clause.inside, "comment") and words.named(clause.inside) is None
    ):  # "I'd like to see what the ego does"
        told = " ".join(words.word(at) for at in clause.inside if "comment" in words.tags(at)).split()
        last = EGO_ID if "ego" in told else last
    bound = clause.link in ("before", "after", "until") or (clause.link == "when" and _is_perfect(words, clause))
    first = words.sentence(clause)[0]
    cued = clause.link == "when" and any(words.word(at).split()[-1] in _CUED for at in first.inside)
    if not (bound or cued) or following.sentence == clause.sentence:
        return last  # "The van is triggered when the ego is 12 m behind it. It brakes"
    acting = [each for each in words.sentence(clause) if each.link in _MAIN and each.subject is not None]
    return acting[-1].subject if acting else last


def _is_perfect(words: Words, clause: Clause) -> bool:
    """Whether something is over: "once the ego has passed"."""
    have = words.where(clause.inside, "auxiliary", "have") is not None
    return have and not words.has(clause.inside, "quantity")


def _name_subject(words: Words, clause: Clause) -> None:
    """Take who is named in a clause: as its subject, "by the ego", or "for the ego" where nothing else is said."""
    labelled = clause.subject is not None and clause.link not in ("before", "after", "until")
    if labelled and not _has_own_subject(words, clause):
        return  # told by a label: "Truck: westbound"
    names = [at for at in clause.inside if at in words.names.actors]
    found = next((at for at in names if not is_object(words, at)), None)
    if found is None:
        found = next((at for at in names if _stands_after(words, at, "by")), None)
    pronoun = any(at in words.names.pronouns for at in clause.inside)
    if found is None and not pronoun and not words.verbs(clause.inside) & {*_STRONG, "wait", "let", "yield"}:
        found = next((at for at in names if _stands_after(words, at, "for") and _is_for(words, clause, at)), None)
    if found is None and (apart := words.where(clause.inside, "separates")) is not None:
        first = words.skip(apart + 1, frozenset(("determiner", "actor_adjective")))
        found = first if first in names else None  # "85 m separate the ego from the intersection; it is westbound"
    if found is None:
        found = next((at for at in names if _is_turner(words, clause, at) or _is_keyed(words, clause, at)), None)
    if found is not None:
        clause.subject, clause.named = words.names.actors[found], True
    elif clause.link in ("before", "after", "until") and "our" in words.tags(clause.start).values():
        clause.subject, clause.named = EGO_ID, True  # "before our turn begins"


def _is_keyed(words: Words, clause: Clause, at: int) -> bool:
    """Whether a key names whose it is: "Position of the ego at time zero: 80 m before the intersection"."""
    back = at - 1
    while words.has([back], "determiner", "actor_adjective"):
        back -= 1
    keyed = words.word(back) == "of" and words.has([back - 1], "aspect", "key", "measure")
    if keyed and words.has([back - 1], "measure") and words.word(back - 1).startswith("initial"):
        return True  # "The initial distance of the ego to it is 65 m and its initial speed 8 m/s."
    return keyed and words.has([clause.end], "colon") and not words.has(clause.inside, "verb", "be")


def _is_turner(words: Words, clause: Clause, at: int) -> bool:
    """Whether a turn is told to be of this vehicle: "a left turn of the ego", "before the beginning of A's turn"."""
    if "genitive" in words.tags(at + 1):
        return clause.link in ("before", "after", "until") and words.tag(at + 2, "event_noun") == "turn"
    back = at - 1
    while words.has([back], "determiner", "actor_adjective"):
        back -= 1
    return words.word(back) == "of" and words.tag(back - 1, "event_noun") == "turn"


def _is_for(words: Words, clause: Clause, at: int) -> bool:
    """Whether nobody else does anything: "A left turn for the ego", "6 m are left for it", not "makes way for it"."""
    told = range(clause.start, at)
    return words.has(told, "quantity") or not (words.verbs(told) - {"turn"} or words.has(told, "auxiliary"))


def _has_own_subject(words: Words, clause: Clause) -> bool:
    """Whether a clause under a label is about somebody else: "A test with a van: it goes east, the ego turns"."""
    at = clause.start
    while at < clause.end and words.has([at], "determiner", "actor_adjective") and at not in words.names.actors:
        at += 1
    return at in words.names.actors and words.has([at + 1], "be", "auxiliary") and "start" not in clause.labels


def _stands_after(words: Words, at: int, preposition: str) -> bool:
    back = at - 1
    while words.has([back], "determiner", "actor_adjective", "heading", "noun", "unknown"):
        back -= 1
    return words.word(back) == preposition


def _is_about_both(words: Words, clause: Clause, before: Clause | None) -> bool:
    if clause.pair or any(at in words.names.both for at in clause.inside) or _agrees_with_two(words, clause):
        return True
    goes_on = before is not None and before.both and before.sentence == clause.sentence
    pronoun = any(at in words.names.pronouns for at in clause.inside)
    return goes_on and clause.link in ("and", "main") and not clause.named and not pronoun


def _agrees_with_two(words: Words, clause: Clause) -> bool:
    """Whether the verb is a plural: "a van and, behind it, the ego drive east"."""
    actors = words.names.actors
    for at in clause.inside[1:]:
        plural = "verb" in words.tags(at) and words.tokens[at].forms == {"base"} and at - 1 in actors
        plural = plural and words.word(at - 1) not in (*FIRST_PERSON, "you", "they")
        if plural and not words.verbs(clause.inside) & {"let", "make"} and not words.has(clause.inside, "frame"):
            earlier = [each for each in words.sentence(clause) if each.start < clause.start]
            return any(actors.get(i, actors[at - 1]) != actors[at - 1] for each in earlier for i in each.inside)
    return False


def _starts_it(words: Words, clause: Clause) -> bool:
    """Whether this is "when the observation begins", "when we start", "when things begin"."""
    earlier = [each for each in words.sentence(clause) if each.end < clause.start]
    if clause.link == "when" and len(earlier) == 1 and _begins_test(words, earlier[0]):
        clause.labels, clause.link = [*clause.labels, "start"], "main"  # "We start when the ego is 6.5 s from it."
        return False
    if clause.link == "when" and words.verbs(clause.inside) & {"begin"} and words.word(clause.end - 1) in RUNS:
        return not words.has(clause.inside, "quantity")
    if clause.link == "when" and _we_go(words, clause):
        return True
    last = words.word(clause.end - 1).split()[-1]
    begins = last in ("begin", "begins", "start", "starts", "began", "started") or (
        last in ("initiated", "launched") and words.has([clause.end - 2], "be")
    )
    out = any(words.word(at) in ("sets out", "starts out", "set out", "started out") for at in clause.inside[:3])
    if out and earlier and words.has(earlier[-1].inside, "quantity") and not words.has(clause.inside, "quantity"):
        return clause.link == "when"  # "its time to arrival is 8 s when it sets out eastbound"
    of_ego = len(clause.inside) == 2 and bool(earlier) and earlier[-1].subject == EGO_ID
    if begins and of_ego and words.word(clause.start) == "it" and words.has(earlier[-1].inside, "quantity"):
        return clause.link == "when"  # "it has 84 m to go to the intersection when it starts"
    begins = begins or (
        words.word(clause.end - 2) in ("press", "hit", "push") and last in ("play", "start", "go", "run")
    )
    vehicle = words.has(clause.inside, "hero", "noun") or any("ego" in words.word(at) for at in clause.inside)
    told = words.has(clause.inside, "quantity", "pronoun", "possessive", "event_noun", "onset_noun")
    return clause.link == "when" and begins and len(clause.inside) <= 5 and not vehicle and not told


def _we_go(words: Words, clause: Clause) -> bool:
    """Whether this is "when we get going", which is no deed of the story."""
    first = words.word(clause.start) in FIRST_PERSON
    told = [words.word(at) for at in clause.inside]
    lets = first and words.verbs(clause.inside) <= {"let", "go"} and told[1:2] == ["let"] and told[-1] == "go"
    return lets or (first and len(clause.inside) == 2 and words.verbs(clause.inside) in ({"go"}, {"begin"}))


def _begins_test(words: Words, clause: Clause) -> bool:
    """Whether nothing is said but "We start", "The recording begins"."""
    begins = words.who_begins(clause)
    return begins is not None and words.word(begins) in ("we", "i", *RUNS)


def _mark_start(words: Words, clause: Clause, before: Clause | None) -> None:
    clause.labels = [*clause.labels, "start"]
    while before is not None and before.sentence == clause.sentence:
        before.labels = [*before.labels, "start"]
        index = words.clauses.index(before)
        before = words.clauses[index - 1] if index and before.link in ("main", "and") and not before.named else None


def _unnamed(words: Words, index: int, last: int | None, acting: bool) -> int | None:
    """Return whom a clause without a name is about."""
    clause = words.clauses[index]
    pronouns = [at for at in clause.inside if at in words.names.pronouns]
    verbs = words.verbs(clause.inside)
    if any(words.word(at) in _HIS for at in pronouns):
        return words.named(range(clause.start - 1, -1, -1)) if words.names.driven else HERO_ID
    if "deed" in clause.labels and not pronouns and verbs & {"brake", "stop", "accelerate"}:
        return HERO_ID  # "Hero action: brakes to standstill"
    begun = words.tag(clause.start + 1, "event_noun") in ("brake", "accelerate")
    if words.word(clause.start) in ("its", "his", "her") and begun and "begin" in verbs:
        return HERO_ID  # "Its deceleration begins when": the ego's would be its own affair
    own = [at for at in pronouns if not words.has([at - 1], "preposition")]
    far = bool(own) and words.has([own[0] + 2], "quantity") and words.word(own[0] + 3) == "to"  # "it's 82 yd to it"
    if words.names.spoken and words.has(own, "pronoun", "possessive") and not (far and clause.link in _MAIN):
        return HERO_ID  # "we" are the ego, so "it" is the other one
    if own and any(at > own[0] and words.word(at) in ("us", "me") for at in clause.inside):
        speaker = next(words.names.actors.get(at) for at in clause.inside if words.word(at) in ("us", "me"))
        return 1 - speaker if speaker is not None else last  # "it comes out in front of us"
    following = words.clauses[index + 1] if index + 1 < len(words.clauses) else clause
    asked = (
        following.link == "when" and following.sentence == clause.sentence and words.has(following.inside, "quantity")
    )
    if asked and clause.start in own and words.word(following.start).split()[0] in ("we", "i"):
        return HERO_ID  # "it begins its turn when we are 2.5 s away": "it" is not who speaks
    named_last = words.named(range(clause.start - 1, -1, -1))
    if words.where(clause.inside, "latter", "former") is not None:
        return _former(words, index, named_last)
    before = words.clauses[index - 1] if index else clause
    unclear = before.both and before.link == "main" and not words.has(before.inside, "measure")
    if unclear and clause.start in own and words.word(clause.start) == "it":
        raise words.refuse("it is not clear which vehicle is meant", words.span(clause))  # "Both turn left; it is 8 m"
    if clause.link == "colon" and before.named and own and not words.has(before.inside, "verb", "be", "quantity"):
        return before.subject  # "Hero action: it brakes"
    if (owner := _whose_measure(words, index)) is not None:
        return owner
    if (actor := seen(words, index)) is not None:
        return actor
    that = words.word(clause.start - 1) in ("that", "this") and words.tag(clause.start, "event_noun") == "turn"
    if that and acting:
        return HERO_ID  # "... speeds up to complete its turn ... That turn is a left turn"
    if clause.link in _MAIN and acting and "fail" in verbs:
        return HERO_ID  # "..., thereby failing to yield"
    relative = clause.link == "that" and words.word(clause.start - 1) in ("which", "who", "that", "where", "whose")
    its = before.start in words.names.pronouns and words.has([before.start + 1], "event_noun", "onset_noun")
    if relative and its and before.end <= before.start + 2:
        return before.subject  # "Its deceleration, which takes it to a stop"
    if (alike := _same_which(words, clause)) is not None:
        return alike.subject  # "a van comes, which brakes when ..., and which stops 6 m before it"
    if relative:
        _check_antecedent(words, index)
    if relative and before.named and named_last != before.subject and before.end == clause.start - 1:
        objects = [at for at in before.inside if at in words.names.actors][-1:]
        first_person = [words.word(at) in FIRST_PERSON for at in objects if is_object(words, at)]
        if any(first_person):
            return before.subject  # "a van coming towards us that is going to turn left"
    if named_last is not None and (relative or words.has(clause.inside, "latter")):
        return named_last
    if (first := _resumed(words, clause, pronouns)) is not None:
        return first.subject  # "The van, at 2 s from the line, with the ego at 3 s from the point, starts to brake"
    bare = words.clauses[index - 1] if index else clause
    told = words.has(bare.inside, "verb", "be", "quantity")
    if bare.named and bare.sentence == clause.sentence and not told and clause.link == "then":
        return bare.subject  # "The ego then passes it"
    earlier = [each for each in words.sentence(clause) if each.start < clause.start]
    led = [at for at in clause.inside if at in words.names.actors]
    if clause.start in pronouns and led and verbs & {"lead", "follow"} and all(is_object(words, at) for at in led):
        return 1 - words.names.actors[led[0]]  # "It precedes the ego"
    if pronouns and clause.link in ("after", "until") and bare in earlier and "let" in words.verbs(bare.inside):
        named = words.named(range(bare.start, bare.end))
        if _is_perfect(words, clause) and named == EGO_ID:
            return named  # "He lets our car go by, and after it has passed ..."
    if (other := _other_one(words, clause, earlier)) is not None:
        return other
    last_one = [each for each in words.clauses[:index] if each.sentence == clause.sentence - 1][:1]
    brought = [each for each in last_one if each.link == "main" and each.subject == HERO_ID]
    brought = [each for each in brought if each.named or each.start in words.names.pronouns]
    first_of_two = bool(brought and not earlier and clause.start in own and verbs & _STRONG) or (
        bool(earlier) and earlier[0].subject == HERO_ID and earlier[0].link == "main"
    )
    # "When it is 12 m from the line and the ego 30 m from the point, it begins to brake"
    same_one = bool(earlier) and earlier[0].subject == HERO_ID and earlier[0].start in words.names.pronouns
    hero_here = acting or first_of_two or same_one or any(each.named and each.subject == HERO_ID for each in earlier)
    participle = "ing" in words.tokens[clause.start].forms and clause.link in ("before", "after")
    if participle and hero_here and (verbs & _STRONG or words.has(clause.inside, "stop_noun")):
        return HERO_ID  # "After coming to a stop, it waits"
    deeds = _DEEDS | {"go", "turn", "follow"} if clause.link == "then" or _after_a_moment(earlier) else _DEEDS
    strong = verbs & _STRONG or words.has(clause.inside, "stop_noun")
    if clause.link == "until" and pronouns and strong and hero_here:
        return HERO_ID  # "the van brakes as soon as the ego is 3 s from it, until it has stopped"
    if clause.link in _MAIN and ((pronouns and hero_here and strong) or (acting and (verbs & deeds or strong))):
        return HERO_ID
    owned = [at for at in pronouns if not words.has([at - 1], "preposition", "relation", "verb")]
    if not owned and not any(each.named or is_finite(words, each) for each in [*earlier, clause]):
        beside = words.clauses[index + 1] if index + 1 < len(words.clauses) else clause
        with_it = "with" in (words.word(clause.end), words.word(clause.end + 1)) and words.has(
            [clause.start], "direction"
        )
        if with_it and beside.sentence == clause.sentence and words.named(beside.inside) is not None:
            return last  # "Left turn from the driveway, with a westbound truck"
        named_later = _named_later(words, index)
        return named_later if named_later is not None else last
    return last


def _whose_measure(words: Words, index: int) -> int | None:
    """Return whom "Its time to it is 7 s" is about after "The ego drives behind a van that is about to turn"."""
    clause = words.clauses[index]
    own = words.word(clause.start) == "its" and words.has([clause.start + 1], "measure")
    if not own or words.sentence(clause)[0] is not clause or not index:
        return None
    before = words.sentence(words.clauses[index - 1])
    first, last = before[0], before[-1]
    there = words.word(first.start) == "there" or first.both
    alone = first.named and first.subject is not None and not there and len(before) <= 2
    return first.subject if alone and last.link == "that" and last.subject != first.subject else None


def _former(words: Words, index: int, named_last: int | None) -> int | None:
    """Return who "the former" is: named first in the sentence, or not last before it."""
    clause = words.clauses[index]
    first = next((c.start for c in words.clauses if c.sentence >= clause.sentence - 1), 0)
    own = words.sentence(clause)[0].start
    former = words.named(range(own, clause.start))
    if former is not None:
        return former
    again = [c.subject for c in words.clauses[:index] if words.where(c.inside, "latter", "former") is not None]
    if again:
        return again[-1]
    latter = words.where(range(own, words.sentence_at(clause.start).stop), "latter", "x")
    if latter is not None and named_last is not None:
        return 1 - named_last  # "the former is 3 s from the line and the latter 4 s from the point"
    return words.named(range(first, clause.start))


def _same_which(words: Words, clause: Clause) -> Clause | None:
    """Return the clause that "and which" goes on from."""
    which = words.word(clause.start - 1)
    if words.word(clause.start - 2) != "and" or which not in ("which", "who"):
        return None
    earlier = (each for each in reversed(words.sentence(clause)) if each.start < clause.start)
    begins = f"{which} begins"
    return next((c for c in earlier if words.word(c.start - 1) == which or words.word(c.start) == begins), None)


def _resumed(words: Words, clause: Clause, pronouns: list[int]) -> Clause | None:
    """Return the name that a sentence begins with, or an opposed one, where only amounts part it from its verb."""
    earlier = [each for each in words.sentence(clause) if each.start < clause.start]
    opposed = [each for each in earlier if words.word(each.start - 1) in ("while", "whereas", "whilst")]
    last = next((each for each in reversed(opposed) if each.named), None)
    for name in dict.fromkeys((last.start if last is not None else clause.start, words.sentence(clause)[0].start)):
        first = next(each for each in words.sentence(clause) if each.start == name)
        if (found := _resumed_after(words, clause, first, pronouns)) is not None:
            return found
    return None


def _resumed_after(words: Words, clause: Clause, first: Clause, pronouns: list[int]) -> Clause | None:
    """Return `first` where it is a mere name, and `clause` has its verb."""
    finite = any("verb" in words.tags(i) and "ing" not in words.tokens[i].forms for i in first.inside)
    alone = first is not clause and first.named and not finite
    forms = words.tokens[clause.start].forms
    denies = words.word(clause.start) in ("doesn't", "does not", "does")
    put_in = [each for each in words.sentence(clause) if first.start < each.start < clause.start]
    told = bool(put_in) and all(each.link == "that" or (each.link == "and" and not each.named) for each in put_in)
    denies = denies or (told and words.has([clause.start], "be"))  # "The ego, which nobody has seen, is 12 m from it"
    goes_on = clause.link == "main" and ((bool(forms & {"s", "ed"}) and "base" not in forms) or denies)
    placed = bool(put_in) and all(words.has(each.inside, "quantity") or _is_relative(words, each) for each in put_in)
    bare = not words.has(first.inside, "be", "quantity", "auxiliary") and clause.start not in pronouns
    return first if alone and goes_on and placed and bare else None


def _is_relative(words: Words, clause: Clause) -> bool:
    """Whether a clause is ", which intends to turn left", or goes on from one."""
    earlier = [each for each in words.sentence(clause) if each.start <= clause.start]
    return any(
        each.link == "that" and words.word(each.start - 1) in ("which", "who") and words.word(each.start - 2) == ","
        for each in earlier
    )


def _other_one(words: Words, clause: Clause, earlier: list[Clause]) -> int | None:
    """Return whom "it" means beside a vehicle whose place was told: "when we are 50 m and it is 12 m from it"."""
    it = words.word(clause.start) in ("it", "he", "she")
    if it and (beside := _told_beside(words, clause)) is not None:
        return 1 - beside
    if it and earlier and _is_first_person(words, earlier[-1]):
        return HERO_ID  # "we have closed up to 8 m behind it, it brakes"
    if not it or not earlier:
        return None
    if words.verbs(clause.inside) & _STRONG and earlier[0].subject == HERO_ID and clause.link == "when":
        return HERO_ID  # "it is 2 s from it, and the ego 4 s, when it begins to brake"
    told = [each for each in earlier if words.has(each.inside, "quantity")]
    placed = clause.link == "and" and told and told[-1] is earlier[-1] and earlier[-1].link in ("when", "and")
    asked = placed and any(each.link == "when" for each in earlier)
    if words.verbs(clause.inside) & _STRONG or words.has(clause.inside, "stop_noun"):
        return None
    if not asked or not (earlier[-1].named and _tells_place(words, earlier[-1]) and _tells_place(words, clause)):
        return None
    subject = earlier[-1].subject
    return None if subject is None else 1 - subject


def _is_first_person(words: Words, clause: Clause) -> bool:
    """Whether "we" or "I" is whom a clause is about, and the ego."""
    own = [at for at in clause.inside if at in words.names.actors and not is_object(words, at)]
    return clause.subject == EGO_ID and bool(own) and words.word(own[0]).split()[0] in FIRST_PERSON


def _told_beside(words: Words, clause: Clause) -> int | None:
    """Return whose place is told next to that of "it": "when it is 12 m from it and the ego is 30 m from it"."""
    if clause.link != "when" or not _tells_place(words, clause):
        return None
    later = [each for each in words.sentence(clause) if each.start > clause.start and each.link != "that"]
    following = next((each for each in later if words.has(each.inside, "quantity") or each.named), None)
    if following is None or following.link not in ("and", "main"):
        return None
    named = next((at for at in following.inside if at in words.names.actors), None)
    if named is None or is_object(words, named) or words.verbs(following.inside) & _STRONG:
        return None
    told = [each for each in later if following.start <= each.start][:2]
    amount = next((each for each in told if words.has(each.inside, "quantity")), None)
    placed = amount is not None and _tells_place(words, amount)
    return words.names.actors[named] if placed else None


def _tells_place(words: Words, clause: Clause) -> bool:
    """Whether nothing but a distance or a time to a place is told: "it is 12 m from its stop line"."""
    amounts = [at for at in clause.inside if "quantity" in words.tags(at)]
    lengths = all(words.tags(at)["quantity"] in ("length", "time") for at in amounts)
    apart = words.has(clause.inside, "measure") or any(
        words.tag(at, "relation") in ("behind", "ahead") and words.named(range(at, at + 4)) is not None
        for at in clause.inside
    )
    return bool(amounts) and lengths and not apart


def _check_antecedent(words: Words, index: int) -> None:
    """Refuse "the ego follows a car on the driveway, which is 20 m from it": either may be there."""
    clause, before = words.clauses[index], words.clauses[index - 1] if index else None
    if before is None or before.sentence != clause.sentence:
        return
    named = [at for at in before.inside if at in words.names.actors]
    actors = {words.names.actors[at] for at in named}
    if len(actors) == 2 and named[-1] != before.end - 1 and words.has(clause.inside, "quantity"):
        raise words.refuse("it is not clear which of the two vehicles is meant", words.span(clause))


def _after_a_moment(earlier: list[Clause]) -> bool:
    return bool(earlier) and earlier[-1].link in ("when", "before", "after", "until")


def _named_later(words: Words, index: int) -> int | None:
    """Return who is named next in the sentence: "Travelling eastbound, a lorry ..."."""
    clause = words.clauses[index]
    for following in words.clauses[index + 1 :]:
        if following.sentence != clause.sentence or following.link in ("when", "before", "after", "until"):
            return None
        if words.word(following.start - 1) == "with" and words.has(following.inside, "quantity"):
            continue  # "Three seconds from it, with the AV 2 s from the line, the van accelerates"
        for at in following.inside:
            if at in words.names.actors and not is_object(words, at):
                return words.names.actors[at]
    return None
