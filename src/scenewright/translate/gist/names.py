"""Finds who is spoken of: every word that stands for the ego or for the hero.

What enters: tokens. What leaves: the actor of each naming token. A vehicle that is not the ego is the hero; where more
than one other vehicle is spoken of, `several` says so.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.tokens import Token

_GENERIC = frozenset(("car", "vehicle", "driver", "motorist", "actor", "agent", "one", "traffic_one"))
_RELATIVE = {"front_one": "lead", "rear_one": "rear", "left_turner": "left", "right_turner": "right", "through_one": "straight"}
PERSONS = frozenset(
    "man woman uncle aunt grandmother grandma grandfather grandpa granny neighbour neighbor somebody someone guy lady "
    "gentleman fellow stranger owner father mother commuter courier chap bloke kid teenager trucker operator".split()
)
_MASCULINE = frozenset(("he", "she", "him", "himself", "herself", "hers"))
FIRST_PERSON = frozenset(("i", "me", "we", "us", "myself", "ourselves", "mine", "ours"))


@dataclass(slots=True)
class Names:
    """Who each token stands for.

    Attributes
    ----------
    actors
        Actor by index of the naming token.
    pronouns
        Indices of "it", "its", "he", ... that have yet to be resolved.
    both
        Indices of words for both vehicles.
    kinds
        Kinds of vehicle that the hero is called.
    """

    actors: dict[int, int] = field(default_factory=dict)
    pronouns: set[int] = field(default_factory=set)
    both: set[int] = field(default_factory=set)
    spoken: bool = False  # the ego is only "I" or "we", so that "it" is the other one
    relative: dict[int, str] = field(default_factory=dict)
    kinds: set[str] = field(default_factory=set)

    @property
    def several(self) -> bool:
        """Whether more than one other vehicle is spoken of."""
        return len(self.kinds) > 1


def find_names(tokens: list[Token]) -> Names:
    """Return who the tokens stand for."""
    names = Names()
    ego_kinds = _ego_kinds(tokens)
    ego_marks = _ego_marks(tokens)
    for at, token in enumerate(tokens):
        word = token.text.lower()
        if word == "subject" and at + 1 < len(tokens) and "colon" in tokens[at + 1].tags:
            continue
        if "ego" in token.tags or word in FIRST_PERSON:
            names.actors[at] = EGO_ID
        elif "pair" in token.tags and "measured_word" not in token.tags or word in ("both", "they", "each"):
            partitive = at > 1 and tokens[at - 1].tags.get("preposition") == "of" and "negation" not in tokens[at - 2].tags
            partitive = partitive and tokens[at - 2].text.lower() != "neither"
            if not partitive and not _both_and(tokens, at):
                names.both.add(at)
        elif "latter" in token.tags or word in _MASCULINE or "pronoun" in token.tags or "possessive" in token.tags:
            names.pronouns.add(at)
        elif "hero" in token.tags and not _is_adjective(tokens, at):
            names.actors[at] = HERO_ID
        elif "noun" in token.tags:
            kind = token.tags["noun"]
            marked = at and tokens[at - 1].text.lower() in ego_marks
            if token.slips:
                continue
            tested = [each.text.lower() for each in tokens[at + 1 : at + 3]] == ["under", "test"]
            if tested or _owned(tokens, at) or kind in ego_kinds or marked:
                names.actors[at] = EGO_ID
                if kind in _RELATIVE:
                    names.relative[at] = _RELATIVE[kind]
                continue
            names.actors[at] = HERO_ID
            if kind in _RELATIVE and kind not in ego_kinds:
                names.relative[at] = _RELATIVE[kind]
            elif kind not in _GENERIC:
                names.kinds.add(kind)
        elif word in PERSONS:
            names.actors[at] = HERO_ID
        elif token.tags.get("actor_adjective") in ("lead", "oncoming") and _alone(tokens, at):
            names.actors[at] = HERO_ID
    egos = [tokens[at].text.lower() for at, actor in names.actors.items() if actor == EGO_ID]
    names.spoken = bool(egos) and all(each in FIRST_PERSON or each.startswith("our") for each in egos)
    return names


def _both_and(tokens: list[Token], at: int) -> bool:
    """Whether "both" begins "both the ego ... and the van ..."."""
    ahead = at + 1
    while ahead < len(tokens) and tokens[ahead].tags.keys() & {"determiner", "actor_adjective"}:
        ahead += 1
    return tokens[at].text.lower() == "both" and ahead < len(tokens) and bool(tokens[ahead].tags.keys() & {"ego", "hero", "noun"})


def _alone(tokens: list[Token], at: int) -> bool:
    """Whether "lead" or "oncoming" stands for the vehicle itself: "oncoming 40 m before the conflict point"."""
    following = tokens[at + 1] if at + 1 < len(tokens) else None
    if following is None or at and tokens[at - 1].tags.keys() & {"be", "adverb", "auxiliary"}:
        return False
    return bool(following.tags.keys() & {"quantity", "be"}) or (
        "verb" in following.tags and "s" in following.forms
    ) or following.text.lower() == "down to"


def _is_adjective(tokens: list[Token], at: int) -> bool:
    """Whether "other" or "target" only tells which car: "the other car"."""
    following = tokens[at + 1].tags if at + 1 < len(tokens) else {}
    return "actor_adjective" in tokens[at].tags and bool(following.keys() & {"noun", "actor_adjective", "hero"})


def _owned(tokens: list[Token], at: int) -> bool:
    """Whether this is "our car" or "my shuttle"; "my uncle's lorry" is not."""
    back = at - 1
    while back >= 0 and tokens[back].tags.keys() & {"actor_adjective", "unknown"}:
        back -= 1
    return back >= 0 and "our" in tokens[back].tags.values()


def _ego_kinds(tokens: list[Token]) -> set[str]:
    """Return the kinds of vehicle that the ego is also called: "the taxi, our ego," and "the ego is a shuttle"."""
    from scenewright.translate.lexicon import load_lexicon

    kinds: set[str] = set()
    entries = load_lexicon().entries
    for at, token in enumerate(tokens):
        last = token.text.lower().split()[-1:] if "ego" in token.tags else []
        if last and (kind := entries.get(tuple(last), {}).get("noun")) and kind not in (*_GENERIC, *_RELATIVE):
            kinds.add(kind)
        tested = [each.text.lower() for each in tokens[at + 1 : at + 3]] == ["under", "test"]
        if tested and "noun" in token.tags and token.tags["noun"] not in _GENERIC:
            kinds.add(token.tags["noun"])
        if "noun" not in token.tags or token.tags["noun"] in _GENERIC:
            continue
        before = at - 1
        while before > 0 and tokens[before].tags.keys() & {"determiner"}:
            before -= 1
        if token.tags["noun"] in _RELATIVE and before > 0 and "be" in tokens[before].tags and "ego" in tokens[before - 1].tags:
            kinds.add(token.tags["noun"])
        after = at + 1
        linked = tokens[after].tags.keys() & {"comma", "be"} if after < len(tokens) else ()
        if linked and after + 2 < len(tokens):
            after += 1
            after += bool(tokens[after].tags.keys() & {"determiner"})
            if after < len(tokens) and "ego" in tokens[after].tags:
                ends = tokens[after + 1].tags.keys() & {"comma", "end"} if after + 1 < len(tokens) else True
                if ends or "be" in tokens[at + 1].tags:
                    kinds.add(token.tags["noun"])
    return kinds


def _ego_marks(tokens: list[Token]) -> set[str]:
    """Return what sets the ego apart: "robot" in "the robot car under test"."""
    found = set()
    for at, token in enumerate(tokens):
        if at and "ego" in token.tags and "unknown" in tokens[at - 1].tags:
            found.add(tokens[at - 1].text.lower())
    return found
