"""Knows remarks on how two ways meet: "so their paths cross", "which means that both end up in one lane".

What enters: tokens and the position where such a remark may begin. What leaves: the position after it, or None. The
routes say such things anyway; a remark with an amount, a vehicle's action or words not listed here is none.
"""

from __future__ import annotations

from scenewright.translate.tokens import Token

_OPENERS = (
    "so", "so that", "such that", "which means that", "which means", "meaning that", "meaning", "thus", "hence",
    "therefore", "as a result", "and so", "and thus", "with the result that", "this means that", "this means",
    "that means", "that means that", "which is where", "which is why", "and hence", "and therefore", "consequently",
    "in other words", "i.e.", "with", "and", "where", "this way", "in this way", "that is",
)  # fmt: skip
_OWNERS = (
    "both", "they", "they both", "the two", "their", "their two", "the", "these", "these two", "both their",
    "both of them", "the two of them", "the two vehicles", "the two cars", "both vehicles", "both cars",
    "both of their", "the vehicles", "the cars",
)  # fmt: skip
_WAYS = (
    "paths", "routes", "ways", "lanes", "trajectories", "courses", "tracks", "itineraries", "directions", "lines",
    "intended paths", "planned paths", "intended routes", "planned routes", "paths of the two", "destinations",
    "paths of the two vehicles", "paths of both", "paths of both vehicles", "paths of the two cars", "driving paths",
)  # fmt: skip
_MEET = frozenset(
    ["cross", "crossing", "meet", "meeting", "merge", "merging", "intersect", "intersecting", "conflict",
     "conflicting", "coincide", "coinciding", "overlap", "overlapping", "join", "joining", "converge",
     "converging", "share", "sharing", "collide"]
)  # fmt: skip
_PHRASES = (
    "end up in", "ends up in", "ending up in", "end up on", "come together", "coming together", "run together",
    "are in conflict", "are in one", "use the same", "need the same", "want the same", "head for the same",
    "are heading for the same", "are bound for the same", "will use the same", "drive into the same",
    "turn into the same", "go into the same", "end in the same", "lead into the same", "run into the same",
    "finish in the same", "are on a collision course", "get in each other's way", "are the same", "become one",
)  # fmt: skip
_WILL = ("will", "would", "do", "are going to", "are about to", "are to", "must", "can", "may", "are", "have to")
_CONFLICTS = frozenset(
    f"{article}{kind} {noun}"
    for article in ("", "a ", "the ")
    for kind in ("merging", "merge", "crossing", "crossing-path", "crossing path", "path", "turning", "lane")
    for noun in ("conflict", "conflicts")
)
_REST = frozenset(
    ["each", "other", "one", "another", "at", "in", "on", "the", "into", "a", "single", "same", "lane", "lanes",
     "road", "driveway", "there", "point", "conflict", "intersection", "junction", "of", "eventually", "and",
     "here", "with", "path", "mouth", "place", "both", "front", "to", "exit", "westbound", "eastbound", "way",
     "right", "exactly", "just", "again", "s", "'", "’s", "'s", "T", "t", "afterwards", "paths"]
)  # fmt: skip


def remark_end(tokens: list[Token], at: int) -> int | None:
    """Return the position after a remark on how the two ways meet that begins at `at`, or None."""
    end = at
    while not tokens[end].tags.keys() & {"end", "comma", "colon"}:
        if tokens[end].quantity is not None:
            return None
        end += 1
    words = " ".join(token.text.lower().replace("’", "'") for token in tokens[at:end])
    if words in _CONFLICTS:
        return end
    rest = _without_ways(_after(words, _OPENERS))
    if rest is None:
        return None
    rest = _after(rest, _WILL) or rest
    left = _meeting(rest)
    return end if left is not None and all(word in _REST for word in left.split()) else None


def is_remark(stretch: list[Token]) -> bool:
    """Whether a stretch that was stepped over says that the two ways meet."""
    if not stretch:
        return False
    end = Token("", stretch[-1].span, {"end": "text"})
    return remark_end([*stretch, end], 0) == len(stretch)


def _without_ways(rest: str | None) -> str | None:
    """Step over who or what meets: "their paths", "both"."""
    if rest is None:
        return None
    owned = _after(rest, _OWNERS)
    if owned is None:
        return None
    ways = _after(owned, _WAYS)
    plain = rest.split()[0] in ("the", "their", "these") and not rest.startswith(
        ("the two", "these two", "the vehicles", "the cars")
    )
    return ways if ways is not None else None if plain else owned


def _meeting(rest: str) -> str | None:
    """Return the words after "cross", "end up in"; None where nothing is said to meet."""
    first, _, left = rest.partition(" ")
    return left if first in _MEET else _after(rest, _PHRASES)


def _after(words: str, beginnings: tuple[str, ...]) -> str | None:
    """Return what follows the longest of `beginnings` at the front of `words`."""
    fitting = [each for each in beginnings if words.startswith(each + " ") or words == each]
    return words[len(max(fitting, key=len)) :].strip() if fitting else None
