"""Finds who is spoken of: every word that stands for the ego or for the hero.

What enters: tokens. What leaves: `Names`. A vehicle, or its driver, that is not the ego is the hero.
"""

from __future__ import annotations

from itertools import pairwise

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.egos import (
    GENERIC,
    RELATIVE,
    is_called,
    is_our_own,
    is_ours,
    is_predicate,
    is_tested,
    kinds_of_ego,
    marks_of_ego,
    our_own_words,
)
from scenewright.translate.gist.people import PERSONS, drivers_of_ego, owners, owns, short_names, sits_in_one
from scenewright.translate.gist.words import Names
from scenewright.translate.tokens import Token

FIRST_PERSON = frozenset(("i", "me", "we", "us", "myself", "ourselves", "mine", "ours"))
PERSONAL = frozenset(("he", "she", "him", "himself", "herself", "hers"))
_GOES = ("turn", "go", "leave", "pull_out", "enter", "drive")
_THIS = ("this", "that", "said", "the said")
_NAMED = frozenset(("ego", "hero", "noun"))


def find_names(tokens: list[Token]) -> Names:
    """Return who the tokens stand for."""
    names = Names()
    kinds, marks = kinds_of_ego(tokens), marks_of_ego(tokens)
    speaker = _speaker(tokens)
    tails = {t.text.lower().split()[-1] for t in tokens if t.tags.keys() & {"noun", "hero"} and " " in t.text}
    unknown = _unknown_vehicle(tokens)
    owning, ours = owners(tokens), our_own_words(tokens)
    drivers = drivers_of_ego(tokens)
    ours |= drivers
    names.driven = bool(drivers) or any("ego" in each.tags and _is_person(each) for each in tokens)
    short = short_names(tokens)
    spoken = speaker == EGO_ID and any(each.text.lower() in ("we", "us") for each in tokens)
    brands = _brands(tokens)
    ours |= {"you"} if _drives_it(tokens) else set()
    for at, token in enumerate(tokens):
        word = token.text.lower()
        if word == "subject" and at + 1 < len(tokens) and "colon" in tokens[at + 1].tags:
            continue  # of a letter
        if word == "other" and at + 1 < len(tokens) and _is_no_vehicle(tokens[at + 1]):
            continue  # "in other words", "no other events", "other than that"
        if _is_director(tokens, at) or (speaker == HERO_ID and word in ("we", "us")):
            continue
        if word in FIRST_PERSON or _has_it(word) or _is_own_wish(tokens, at) or is_our_own(tokens, at):
            names.actors[at] = speaker
        elif "ego" in token.tags or ("unknown" in token.tags and word in ours):
            names.actors[at] = EGO_ID
        elif word in ("they", "them") and (spoken or _somebody(tokens, at)):
            names.actors[at] = HERO_ID  # "we ... they": whoever it is, it is not the ego
        elif word in ("cars", "vehicles") and _is_two(tokens, at):
            names.both.add(at)
        elif word in ("both", "they", "each") or ("pair" in token.tags and not _is_told_later(tokens, at)):
            if not _one_of_them(tokens, at) and not _both_and(tokens, at):
                names.both.add(at)
        elif word in PERSONAL or token.tags.keys() & {"latter", "pronoun", "possessive"}:
            names.pronouns.add(at)
        elif word == "driver" and at and tokens[at - 1].text.lower() == "whose" and names.actors:
            names.actors[at] = names.actors[max(names.actors)]  # "the ego, whose driver is attentive,"
        elif "noun" in token.tags and not token.slips and not _is_last_one(tokens, at):
            if _is_one_more(tokens, at) and HERO_ID in names.actors.values():
                names.kinds |= {"hero", "another"}
            _name_vehicle(
                tokens,
                at,
                names,
                kinds,
                marks,
                ours=(speaker == EGO_ID and is_ours(tokens, at)) or _owned_by(tokens, at, drivers),
            )
        elif short.get(word, at) < at and short[word] in names.actors and _is_definite(tokens, at):
            names.actors[at] = names.actors[short[word]]
        elif (word in owning and not owns(tokens, at)) or sits_in_one(tokens, at) or token.text in brands:
            names.actors[at] = HERO_ID
        elif word in PERSONS or word == unknown or _is_hero(tokens, at) or ("unknown" in token.tags and word in tails):
            names.actors[at] = HERO_ID
            another = at > 0 and tokens[at - 1].tags.get("determiner") == "another"
            if another and list(names.actors.values()).count(HERO_ID) > 1:
                names.kinds |= {"hero", "another"}
    named = [at for at, actor in names.actors.items() if actor == EGO_ID and not is_predicate(tokens, at)]
    egos = [tokens[at].text.lower() for at in named]
    names.spoken = bool(egos) and all(each.split()[0] in FIRST_PERSON for each in egos)
    names.guessed = unknown
    _name_by_kind(tokens, names)
    _name_this(tokens, names)
    names.unclear = _either(tokens, names)
    return names


def _is_no_vehicle(token: Token) -> bool:
    """Whether "other" before this is no vehicle: "other words", "other than"."""
    plural = token.text.lower().endswith("s") and "verb" not in token.tags and "unknown" in token.tags
    return plural or token.text.lower() == "than"


def _has_it(word: str) -> bool:
    """Whether this is "we have", "I've got"."""
    words = word.split()
    return len(words) > 1 and words[0] in ("we", "i") and words[-1] in ("have", "'ve", "\u2019ve", "got")


def _owned_by(tokens: list[Token], at: int, drivers: set[str]) -> bool:
    """Whether this is "the applicant's vehicle", of whom drives the ego."""
    return at > 1 and "genitive" in tokens[at - 1].tags and tokens[at - 2].text.lower() in drivers


def _is_person(token: Token) -> bool:
    """Whether this is "our insured", "our driver": "he" may be the ego then."""
    return token.text.lower().split()[-1] in (*PERSONS, "driver", "insured")


def _is_director(tokens: list[Token], at: int) -> bool:
    """Whether "we" stage the test here: "we let a vehicle turn left"."""
    if tokens[at].text.lower() not in ("we", "i") or at + 2 >= len(tokens):
        return False
    following = tokens[at + 2].tags
    if tokens[at + 1].text.lower() in ("let", "make", "have", "keep") and _is_third_person(tokens):
        return bool(following.keys() & {"determiner", "pronoun", "ego", "hero", "actor_adjective"})
    lets = tokens[at + 1].tags.get("verb") == "let"
    return lets and following.get("determiner") in ("indefinite", "another")


def _is_third_person(tokens: list[Token]) -> bool:
    """Whether the ego has a name that is not the teller's: "the ego", "the AV"."""
    return any(
        "ego" in each.tags and each.text.lower().split()[0] not in ("our", "my", *FIRST_PERSON) for each in tokens
    )


def _is_own_wish(tokens: list[Token], at: int) -> bool:
    """Whether "we want to" tells where the ego goes, and not what the test is for."""
    if tokens[at].tags.get("frame") != "wish" or tokens[at].text.lower().split()[0] not in FIRST_PERSON:
        return False
    verb = next((i for i in range(at + 1, min(at + 4, len(tokens))) if "verb" in tokens[i].tags), None)
    if verb is None or verb + 1 >= len(tokens):
        return False
    ways = bool(tokens[verb + 1].tags.keys() & {"direction", "preposition", "heading", "relation"})
    return tokens[verb].tags["verb"] in _GOES or (tokens[verb].tags["verb"] == "come" and ways)


def _is_one_more(tokens: list[Token], at: int) -> bool:
    """Whether this is "a second van": after the hero that is a third vehicle."""
    before = [each.text.lower() for each in tokens[max(0, at - 3) : at]]
    return any(first in ("a", "one") and more in ("second", "third", "further") for first, more in pairwise(before))


def _name_by_kind(tokens: list[Token], names: Names) -> None:
    """Let "the car" be the ego where that is "the car being tested", and the other one is a lorry."""
    words = {each for at, actor in names.actors.items() if actor == EGO_ID for each in tokens[at].text.lower().split()}
    generic = [at for at, actor in names.actors.items() if actor == HERO_ID and tokens[at].text.lower() in words]
    brought = [at for at in generic if at and tokens[at - 1].tags.get("determiner") != "definite"]
    if not names.kinds or brought or not words & {"car", "vehicle", "truck", "van"}:
        return
    for at in generic:
        names.actors[at] = EGO_ID


def _name_this(tokens: list[Token], names: Names) -> None:
    """Let "this car" be who was last called a car: "the car under test ... When this car is 80 m from it"."""
    for at, actor in names.actors.items():
        word = tokens[at].text.lower()
        if actor != HERO_ID or "noun" not in tokens[at].tags or not at or tokens[at - 1].text.lower() not in _THIS:
            continue
        called = [i for i in names.actors if i < at - 1 and word in tokens[i].text.lower().split()]
        if called and all(names.actors[i] == EGO_ID for i in called):
            names.actors[at] = EGO_ID


def _either(tokens: list[Token], names: Names) -> int | None:
    """Return where "the car" may be either: where the ego is called one too, and no other one was brought in."""
    ego_words = {tokens[at].text.lower().split()[-1] for at, actor in names.actors.items() if actor == EGO_ID}
    first = next((at for at, actor in names.actors.items() if actor == HERO_ID), None)
    if first is None or tokens[first].text.lower() not in ego_words or not first:
        return None
    beside = "relation" in tokens[first + 1].tags and any("ego" in each.tags for each in tokens[first + 2 : first + 4])
    return first if tokens[first - 1].tags.get("determiner") == "definite" and not beside else None


def _speaker(tokens: list[Token]) -> int:
    """Return who "I" am: the ego, or whoever drives "the target car" that I say I am in."""
    for at, token in enumerate(tokens):
        if token.text.lower() not in ("i", "me"):
            continue
        named = tokens[at + 1 : at + 4]
        if len(named) == 3 and "be" in named[0].tags and "determiner" in named[1].tags and "hero" in named[2].tags:
            return HERO_ID  # "I am the hero"
        for ahead in range(at + 1, min(at + 7, len(tokens))):
            tags = tokens[ahead].tags
            if tags.keys() & {"end", "comma", "ego"}:
                break
            drives = any(
                each.tags.get("verb") == "drive" or each.text.lower() == "in" for each in tokens[at + 1 : ahead]
            )
            if drives and tags.keys() & {"hero", "noun"} and not is_tested(tokens, ahead):
                return HERO_ID
    return HERO_ID if _meets_the_ego(tokens) else EGO_ID


def _meets_the_ego(tokens: list[Token]) -> bool:
    """Whether I drive the other vehicle: "I brake when the test car is 12 yards from its line"."""
    acts = False
    for at, token in enumerate(tokens[:-3]):
        if token.text.lower() not in ("i", "me", "my"):
            continue
        near = tokens[at + 1 : at + 7]
        end = next((i for i, each in enumerate(near) if each.tags.keys() & {"end", "comma"}), len(near))
        if any("ego" in each.tags for each in near[:end]):
            return False  # "I'm in the test car"
        strong = {"brake", "stop", "accelerate"}
        acts |= token.text.lower() == "i" and bool({each.tags.get("verb") for each in near[:3]} & strong)
    return acts and _is_third_person(tokens)


def _unknown_vehicle(tokens: list[Token]) -> str | None:
    """Return a word that is not known but can only be the other vehicle: "a dustcart ... the dustcart brakes"."""
    if any("hero" in t.tags or ("noun" in t.tags and t.tags["noun"] not in RELATIVE) for t in tokens):
        return None
    articles: dict[str, set[str]] = {}
    for at, token in enumerate(tokens[:-1]):
        if "unknown" not in token.tags or "unknown" in tokens[at + 1].tags or not token.text.isalpha():
            continue
        back = at - 1
        while back >= 0 and tokens[back].tags.keys() & {"unknown", "actor_adjective", "heading", "area"}:
            back -= 1
        article = tokens[back].tags.get("determiner") if back >= 0 else None
        acts = tokens[at + 1].tags.keys() & {"verb", "be", "auxiliary", "quantity", "preposition", "comma", "link"}
        if article in ("definite", "indefinite") and acts:
            articles.setdefault(token.text.lower(), set()).add(article)
    found = [word for word, seen in articles.items() if seen == {"definite", "indefinite"}]
    return found[0] if len(found) == 1 else None


def _name_vehicle(
    tokens: list[Token], at: int, names: Names, ego_kinds: set[str], ego_marks: set[str], *, ours: bool
) -> None:
    kind = tokens[at].tags["noun"]
    marked = at > 0 and (tokens[at - 1].text.lower() in ego_marks or "ego" in tokens[at - 1].tags)  # "the ADS car"
    called = is_called(tokens, at)
    ego = marked or called or is_predicate(tokens, at) or kind in ego_kinds or is_tested(tokens, at) or ours
    names.actors[at] = EGO_ID if ego else HERO_ID
    if kind in RELATIVE:
        names.relative[at] = RELATIVE[kind]
    elif not ego and kind not in GENERIC:
        names.kinds.add(kind)
    if not ego and _is_third(tokens, at):
        names.kinds |= {"hero", kind}


def _is_third(tokens: list[Token], at: int) -> bool:
    """Whether a vehicle comes in after the hero was named as such: "the hero ... A tractor pulls out behind it"."""
    back = at - 1
    while back > 0 and tokens[back].tags.keys() & {"actor_adjective", "heading", "unknown"}:
        back -= 1
    if back < 1:
        return False
    if tokens[back].tags.get("determiner") == "definite":
        return _is_never_brought_in(tokens, at)
    if tokens[back].tags.get("determiner") not in ("indefinite", "another"):
        return False
    opens = "end" in tokens[back - 1].tags
    if tokens[back - 1].tags.keys() & {"be", "comma", "colon"} or ("comma" in tokens[at + 1].tags and not opens):
        return False  # "the hero, a truck,", "Hero: a truck"
    return any("hero" in each.tags and not each.tags.keys() & {"actor_adjective"} for each in tokens[:back])


def _is_never_brought_in(tokens: list[Token], at: int) -> bool:
    """Whether this is "the tractor" beside a hero that is called "hero vehicle" and nothing else."""
    kind = tokens[at].tags["noun"]
    if kind in GENERIC or kind in RELATIVE:
        return False
    alike = [i for i, each in enumerate(tokens) if each.tags.get("noun") == kind]
    named = any("hero" in each.tags and not each.tags.keys() & {"actor_adjective"} for each in tokens[:at])
    return named and alike == [at]


def _is_two(tokens: list[Token], at: int) -> bool:
    """Whether this is "two eastbound cars"."""
    back = at - 1
    while back > 0 and tokens[back].tags.keys() & {"heading", "actor_adjective"}:
        back -= 1
    return 0 <= back < at - 1 and tokens[back].text.lower() == "two"


def _somebody(tokens: list[Token], at: int) -> bool:
    """Whether "they" are the somebody who was brought in: "Somebody is on the road ... they brake"."""
    return any(each.text.lower() in ("somebody", "someone") for each in tokens[:at])


def _is_last_one(tokens: list[Token], at: int) -> bool:
    """Whether this is "Last one for today" and no vehicle."""
    relative = tokens[at].tags["noun"] in RELATIVE and tokens[at].text.lower().endswith("one")
    if (
        relative
        and tokens[at].text.lower() == "last one"
        and tokens[min(at + 1, len(tokens) - 1)].text.lower() == "for"
    ):
        return not at or "determiner" not in tokens[at - 1].tags
    return relative and (at == 0 or not tokens[at - 1].tags.keys() & {"determiner", "colon", "comma", "link"})


def _one_of_them(tokens: list[Token], at: int) -> bool:
    """Whether only one is meant: "the second of the two"; "neither of them" means both."""
    if at < 2 or tokens[at - 1].tags.get("preposition") != "of":
        return False
    if tokens[at].text.lower().split()[0] in ("both", "each") or "measure" in tokens[at - 2].tags:
        return False  # "the speed of both"
    return "negation" not in tokens[at - 2].tags and tokens[at - 2].text.lower() != "neither"


def _drives_it(tokens: list[Token]) -> bool:
    """Whether who is spoken to drives the ego: "You are following a car", "You (the ego) are", "You are in the ego"."""
    ways = ("follow", "drive", "come", "approach", "turn", "leave", "pull_out", "go", "sit")
    other = _is_third_person(tokens) or any(
        is_tested(tokens, at) for at, each in enumerate(tokens) if "noun" in each.tags
    )
    for at, token in enumerate(tokens[:-2]):
        if token.text.lower() == "you" and "comma" in tokens[at + 1].tags:
            named = at + 2 + ("determiner" in tokens[at + 2].tags)
            if "ego" in tokens[named].tags:
                return True
        if token.text.lower() != "you" or "be" not in tokens[at + 1].tags:
            continue
        acts = tokens[at + 2].tags.get("verb") in ways and "ing" in tokens[at + 2].forms
        if not other and (acts or "quantity" in tokens[at + 2].tags):
            return True
    return False


def _brands(tokens: list[Token]) -> set[str]:
    """Return names of makes that stand for a vehicle: "a Golf ... the Golf's driver"."""
    seen: dict[str, set[str]] = {}
    for at, token in enumerate(tokens):
        if not (token.text[:1].isupper() and token.text.isalpha() and "unknown" in token.tags):
            continue
        back = at - 1
        while back > 0 and "actor_adjective" in tokens[back].tags:
            back -= 1
        article = tokens[back].tags.get("determiner") if back >= 0 else None
        if article in ("indefinite", "definite"):
            seen.setdefault(token.text, set()).add(article)
        elif tokens[at + 1].tags.keys() & {"verb", "be", "quantity", "auxiliary"}:
            seen.setdefault(token.text, set()).add("bare")
    told = {token.text for token in tokens if token.text in seen and _acts_next(token, tokens)}
    found = [
        name
        for name, articles in seen.items()
        if ("indefinite" in articles and len(articles) > 1) or (articles == {"definite"} and name in told)
    ]
    return set(found) if len(found) == 1 else set()


def _is_definite(tokens: list[Token], at: int) -> bool:
    """Whether "the" stands before a word, and what it does, or where it is, after it."""
    acts = tokens[at + 1].tags.keys() & {"verb", "be", "auxiliary", "quantity", "comma", "link", "genitive"}
    return tokens[at - 1].tags.get("determiner") == "definite" and bool(acts)


def _acts_next(token: Token, tokens: list[Token]) -> bool:
    """Whether a name that stands after "the" several times does something: "the old Chevy ... the Chevy brakes"."""
    places = [at for at, each in enumerate(tokens[:-1]) if each.text == token.text]
    acts = any(tokens[at + 1].tags.keys() & {"quantity", "be"} or "s" in tokens[at + 1].forms for at in places)
    return len(places) > 1 and acts


def _is_told_later(tokens: list[Token], at: int) -> bool:
    """Whether this says of amounts that they are alike: "3 s and 4 s, both to the line", not "both of them turning"."""
    following = tokens[at + 1 : at + 3]
    acts = bool(following) and ("ing" in following[0].forms or "be" in following[0].tags)
    fast = len(following) > 1 and following[0].text.lower() == "at" and following[1].tags.get("quantity") == "speed"
    return "measured_word" in tokens[at].tags and not acts and not fast


def _both_and(tokens: list[Token], at: int) -> bool:
    """Whether "both" begins "both the ego ... and the van ..."."""
    ahead = at + 1
    while ahead < len(tokens) and tokens[ahead].tags.keys() & {"determiner", "actor_adjective"}:
        ahead += 1
    named = ahead < len(tokens) and bool(tokens[ahead].tags.keys() & _NAMED)
    return tokens[at].text.lower() == "both" and named


def _is_hero(tokens: list[Token], at: int) -> bool:
    """Whether a word names the hero: "the POV", "other" alone, "oncoming" in "oncoming 40 m before it"."""
    tags = tokens[at].tags
    following = tokens[at + 1] if at + 1 < len(tokens) else None
    if "hero" in tags and at and tokens[at - 1].text.lower() == "each":
        return False  # "each other"
    if "hero" in tags:
        describes = following is not None and bool(following.tags.keys() & {"noun", "actor_adjective", "hero"})
        return not ("actor_adjective" in tags and describes)
    if tags.get("actor_adjective") not in ("lead", "oncoming") or following is None:
        return False
    if at and tokens[at - 1].tags.keys() & {"be", "adverb", "auxiliary"}:
        return False
    if following.text.lower() == "one" and at and "determiner" in tokens[at - 1].tags:
        return True  # "ours is 30 m from it and the oncoming one 22 m"
    acts = "verb" in following.tags and "s" in following.forms
    return acts or bool(following.tags.keys() & {"quantity", "be"}) or following.text.lower() == "down to"
