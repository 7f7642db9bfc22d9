"""Finds people who stand for the vehicle that they drive: "a neighbour", "the resident's car", "my pupil in the ego".

What enters: tokens. What leaves: words, or whether a word is one.
"""

from __future__ import annotations

from scenewright.translate.gist.egos import is_called, is_tested
from scenewright.translate.tokens import Token

# Whoever these are, in a text about two vehicles they drive the one that is not under test.
PERSONS = frozenset(
    ["man", "woman", "guy", "chap", "bloke", "fellow", "lady", "gentleman", "kid", "teenager", "somebody", "someone",
     "stranger", "owner", "operator", "commuter", "courier", "trucker", "neighbour", "neighbor", "father", "mother",
     "human", "cabbie", "biker", "lad", "lass", "girl", "boy", "mate", "pal", "dude", "fella",
     "colleague", "friend", "student", "volunteer", "resident", "visitor", "uncle", "aunt", "grandmother", "grandma",
     "granny", "grandfather", "grandpa", "parent", "learner", "pupil", "tourist", "pensioner", "farmer", "postman",
     "plumber", "gardener", "nurse", "teacher", "policyholder", "claimant", "client", "defendant"]
)  # fmt: skip
_BRINGS_IN = frozenset(("a", "an", "one", "my", "our", "the"))


def drivers_of_ego(tokens: list[Token]) -> set[str]:
    """Return who drives the ego: "my pupil drives the ego", "the pupil in our car", "the learner's car, our ego"."""
    found: set[str] = set()
    for at, token in enumerate(tokens):
        if not _may_be_person(tokens, at):
            continue
        ahead = at + 1
        if is_tested(tokens, at) or is_called(tokens, at):
            found.add(token.text.lower())
            continue
        if ahead < len(tokens) and "genitive" in tokens[ahead].tags:
            owned = ahead + 1 < len(tokens) and "noun" in tokens[ahead + 1].tags
            if owned and (is_called(tokens, ahead + 1) or is_tested(tokens, ahead + 1)):
                found.add(token.text.lower())
            continue
        ahead += ahead < len(tokens) and "comma" in tokens[ahead].tags
        drives = ahead < len(tokens) and (
            tokens[ahead].text.lower() == "in" or tokens[ahead].tags.get("verb") == "drive"
        )
        ahead += 1
        while drives and ahead < len(tokens) and tokens[ahead].tags.keys() & {"determiner", "possessive"}:
            ahead += 1
        if drives and ahead < len(tokens) and ("ego" in tokens[ahead].tags or is_tested(tokens, ahead)):
            found.add(token.text.lower())
    return found


def short_names(tokens: list[Token]) -> dict[str, int]:
    """Return where the vehicle stands that a word is short for: "learner" for "a learner driver"; the first of them."""
    found: dict[str, int] = {}
    for at, token in enumerate(tokens[:-1]):
        if "unknown" not in token.tags or not token.text.isalpha() or not at:
            continue
        named = at + 1
        while named < len(tokens) - 1 and "unknown" in tokens[named].tags:
            named += 1
        if tokens[at - 1].tags.get("determiner") in ("indefinite", "definite") and "noun" in tokens[named].tags:
            found.setdefault(token.text.lower(), named)
    return found


def _may_be_person(tokens: list[Token], at: int) -> bool:
    """Whether a word that is not known, or names a person, is brought in by an article or a possessive."""
    token = tokens[at]
    if not at or not ("unknown" in token.tags or token.text.lower() in PERSONS):
        return False
    if at > 1 and "preposition" in tokens[at - 2].tags:
        return False  # "from my seat in the ego"
    return bool(tokens[at - 1].tags.keys() & {"determiner", "possessive"}) or tokens[at - 1].text.lower() in _BRINGS_IN


def owners(tokens: list[Token]) -> set[str]:
    """Return who drives the hero by what belongs to them: "resident" in "a resident's car"."""
    return {
        token.text.lower()
        for at, token in enumerate(tokens)
        if "unknown" in token.tags and owns(tokens, at) and at and "determiner" in tokens[at - 1].tags
    }


def sits_in_one(tokens: list[Token], at: int) -> bool:
    """Whether this is "mum" in "a mum in a station wagon"."""
    rest = tokens[at + 1 : at + 5]
    if "unknown" not in tokens[at].tags or not at or "determiner" not in tokens[at - 1].tags or len(rest) < 4:
        return False
    sits = rest[0].text.lower() == "in" and "determiner" in rest[1].tags
    makes = any("unknown" in each.tags and each.text[:1].isupper() for each in rest[2:3])
    return sits and (makes or any("noun" in each.tags for each in rest[2:4]))


def owns(tokens: list[Token], at: int) -> bool:
    """Whether "resident" is followed by "'s car"."""
    following = tokens[at + 1 : at + 3]
    return len(following) == 2 and "genitive" in following[0].tags and "noun" in following[1].tags
