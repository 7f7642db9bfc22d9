"""Finds what makes a vehicle the ego: "our shuttle", "the car we are testing", "the taxi, which is our ego".

What enters: tokens, and where a vehicle is named. What leaves: whether it is the ego, and the kinds and marks of it.
"""

from __future__ import annotations

import re
from itertools import pairwise

from scenewright.translate.lexicon import load_lexicon
from scenewright.translate.tokens import Token

# Kinds of vehicle that can be any vehicle, and names that say how a vehicle lies to the other or what it does.
GENERIC = frozenset(("car", "vehicle", "driver", "motorist", "actor", "agent", "traffic_one"))
RELATIVE = {
    "front_one": "lead",
    "rear_one": "rear",
    "left_turner": "left",
    "right_turner": "right",
    "through_one": "straight",
}

_TESTS = "test|trial|evaluation|assessment|examination|scrutiny|investigation|observation"
_TESTING = "test|evaluat|assess|validat|examin|judg|scrutinis|scrutiniz|investigat|check"
_TESTED = re.compile(
    rf"(, |is |\( )?(the (one|vehicle|car) |(which|that|who)( is| 's|'s) )?"
    rf"((under|on|in) (the |our )?({_TESTS})\b|(being|to be) ({_TESTING})(e?d)\b"
    rf"|((that|which|whom|whose (software|stack|planner|driver|policy)) )?(we|i)(( are| 're|'re| am| 'm|'m)"
    rf" ({_TESTING})ing| ({_TESTING})e?| (want|would like) to know about)\b)"
)


def is_predicate(tokens: list[Token], at: int) -> bool:
    """Whether this says what the ego is: "the ego is an old car", "the ego, a van,"."""
    back = at - 1
    while back > 0 and tokens[back].tags.keys() & {"actor_adjective", "heading", "unknown", "determiner"}:
        back -= 1
    own = back >= 1 and ("ego" in tokens[back - 1].tags or tokens[back - 1].text.lower() in ("ours", "mine"))
    if not own:
        return False
    if tokens[back].text.lower() == "as":
        return True  # "with the VUT as the rear one"
    closes = at + 1 >= len(tokens) or bool(tokens[at + 1].tags.keys() & {"comma", "end", "link"})
    closes = closes or (_opens(tokens, back - 1) and _is_on_an_area(tokens, at + 1))
    going = at + 1 < len(tokens) and "ing" in tokens[at + 1].forms
    closes = closes or (going and (_is_yielded_to(tokens, back - 1) or _ends_without_verb(tokens, at + 2)))
    if "colon" in tokens[back].tags:
        return not (tokens[at + 1].tags.keys() & {"be", "auxiliary"} or "s" in tokens[at + 1].forms)  # "Ego: a van"
    placed = back > 1 and "relation" in tokens[back - 2].tags  # "Ahead of the ego is a car"
    placed = placed or tokens[back - 1].text.lower() in ("us", "me")  # "Coming towards us is a van"
    if placed or any(each.tags.get("determiner") == "another" for each in tokens[back:at]):
        return False
    return "be" in tokens[back].tags or ("comma" in tokens[back].tags and back < at - 1 and closes)


def _opens(tokens: list[Token], at: int) -> bool:
    """Whether a name stands at the beginning of a sentence."""
    first = at - (at > 0 and "determiner" in tokens[at - 1].tags)
    return first == 0 or "end" in tokens[first - 1].tags


def _is_on_an_area(tokens: list[Token], at: int) -> bool:
    """Whether "on the road," follows: "the ego, an eastbound vehicle on the road, intends"."""
    area = at + 1 + ("determiner" in tokens[at + 1].tags)
    return "preposition" in tokens[at].tags and "area" in tokens[area].tags and "comma" in tokens[area + 1].tags


def _ends_without_verb(tokens: list[Token], at: int) -> bool:
    """Whether nothing finite follows in a sentence: "8 s for the ego, a westbound car staying on the road."."""
    for token in tokens[at:]:
        if "end" in token.tags:
            return True
        if token.tags.keys() & {"be", "auxiliary"} or ("verb" in token.tags and token.forms & {"s", "ed"}):
            return False
    return True


def _is_yielded_to(tokens: list[Token], at: int) -> bool:
    """Whether this is the ego of "must give way to the ego, a car going straight on"."""
    at -= 1
    while at > 0 and "determiner" in tokens[at].tags:
        at -= 1
    return at >= 0 and tokens[at].tags.get("verb") in ("yield", "not_yield", "let")


def our_own_words(tokens: list[Token]) -> set[str]:
    """Return words that are not known and stand for the ego: "our prototype turns left"."""
    if any("ego" in token.tags for token in tokens):
        return set()
    found: set[str] = set()
    for first, token in pairwise(range(len(tokens))):
        ours = "our" in tokens[first].tags.values() and "unknown" in tokens[token].tags
        acts = token + 1 < len(tokens) and "verb" in tokens[token + 1].tags and "s" in tokens[token + 1].forms
        again = any(each.text.lower() == tokens[token].text.lower() for each in tokens[token + 1 :])
        acts = acts or (again and token + 1 < len(tokens) and bool(tokens[token + 1].tags.keys() & {"comma", "end"}))
        if ours and (acts or (token + 1 < len(tokens) and "be" in tokens[token + 1].tags)):
            found.add(tokens[token].text.lower())
    return found if len(found) == 1 else set()


def is_tested(tokens: list[Token], at: int) -> bool:
    """Whether a vehicle is said to be tested: "the car under test", "the shuttle we are testing"."""
    following = [each.text.lower() for each in tokens[at + 1 : at + 3]]
    tested = following and "test" in following[0] and "comment" in tokens[at + 1].tags  # "the shuttle we are testing"
    ahead = [each.text.lower() for each in tokens[at + 1 : at + 6]]
    apposed = ahead[1:3] == ["the", "one"] and any("comment" in each.tags for each in tokens[at + 4 : at + 5])
    said = " ".join(each.text.lower() for each in tokens[at + 1 : at + 9])
    return bool(tested) or (apposed and "test" in " ".join(ahead[3:])) or _TESTED.match(said) is not None


def _is_the_ego(tokens: list[Token], at: int) -> bool:
    """Whether a vehicle is said to be under test or the ego: "a robot car, the ego,"."""
    return is_tested(tokens, at) or ("comma" in tokens[min(at + 1, len(tokens) - 1)].tags and is_called(tokens, at))


def is_ours(tokens: list[Token], at: int) -> bool:
    """Whether this is "our car" or "my shuttle"; "my uncle's lorry" is not."""
    back = at - 1
    while back >= 0 and tokens[back].tags.keys() & {"actor_adjective", "unknown", "heading"}:
        back -= 1
    return back >= 0 and "our" in tokens[back].tags.values()


def is_our_own(tokens: list[Token], at: int) -> bool:
    """Whether "our" stands for the vehicle: "our being 4 s from it", "our distance to it"."""
    if "our" not in tokens[at].tags.values() or at + 1 >= len(tokens):
        return False
    following = tokens[at + 1].text.lower()
    return bool(tokens[at + 1].tags.keys() & {"measure", "measures", "aspect"}) or following in (
        "being",
        "run",
        "journey",
        "trip",
    )


def kinds_of_ego(tokens: list[Token]) -> set[str]:
    """Return the kinds of vehicle that the ego is called too: "the taxi, our ego,", "the ego is the rear one"."""
    entries = load_lexicon().entries
    kinds: set[str] = set()
    for at, token in enumerate(tokens):
        if "ego" in token.tags:
            last = token.text.lower().split()[-1]
            kinds |= {entries.get((last,), {}).get("noun", "")} - {*GENERIC, *RELATIVE, ""}
        kind = token.tags.get("noun")
        if kind is None or kind in GENERIC:
            continue
        if (
            is_tested(tokens, at)
            or is_called(tokens, at)
            or is_ours(tokens, at)
            or is_predicate(tokens, at)
            or (kind in RELATIVE and _ego_is(tokens, at))
        ):
            kinds.add(kind)
    return kinds


def is_called(tokens: list[Token], at: int) -> bool:
    """Whether a vehicle is said to be the ego: "the one behind is the ego", "the taxi, which is our ego,"."""
    if at + 1 < len(tokens) and tokens[at + 1].text.lower() in ("in", "at"):
        at = next((i - 1 for i in range(at + 2, min(at + 5, len(tokens))) if "be" in tokens[i].tags), at)
    if at + 2 >= len(tokens) or not tokens[at + 1].tags.keys() & {"comma", "be"}:
        return False  # "The car in the rear is the ego"
    which = tokens[at + 2].text.lower() in ("which", "that") and "be" in tokens[min(at + 3, len(tokens) - 1)].tags
    ahead = at + 2 + (2 if which else 0)
    ahead += ahead < len(tokens) and ("determiner" in tokens[ahead].tags or "our" in tokens[ahead].tags.values())
    if ahead >= len(tokens) or "ego" not in tokens[ahead].tags:
        return False
    after = min(ahead + 1, len(tokens) - 1)
    closes = bool(tokens[after].tags.keys() & {"comma", "end"}) or tokens[after].text.lower() in ("under", "under test")
    return closes or "be" in tokens[at + 1].tags


def _ego_is(tokens: list[Token], at: int) -> bool:
    back = at - 1
    while back > 0 and "determiner" in tokens[back].tags:
        back -= 1
    return back > 0 and "be" in tokens[back].tags and "ego" in tokens[back - 1].tags


def marks_of_ego(tokens: list[Token]) -> set[str]:
    """Return what sets the ego apart: "robot" in "the robot car under test"."""
    return {
        mark.text.lower()
        for at, (mark, named) in enumerate(pairwise(tokens))
        if "unknown" in mark.tags and ("ego" in named.tags or ("noun" in named.tags and _is_the_ego(tokens, at + 1)))
    }
