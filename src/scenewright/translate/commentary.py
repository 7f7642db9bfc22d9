"""Steps over what a text says about the test and not about what happens: its purpose, what the ego should cope with.

What enters: tokens. What leaves: tokens without commentary, and the stretches that were stepped over, which the
translation reports. A stretch with an amount, or with words that tell what the hero does, is never commentary.
"""

from __future__ import annotations

from itertools import pairwise

from scenewright.translate.geometry import remark_end
from scenewright.translate.letters import letter_end
from scenewright.translate.tokens import Token

_CONTENT = frozenset(("quantity", "bare_number"))


def without_commentary(tokens: list[Token]) -> tuple[list[Token], list[list[Token]]]:
    """Return the tokens that describe the scenario, and the stretches that comment on it."""
    kept: list[Token] = []
    skipped: list[list[Token]] = []
    at = 0
    while at < len(tokens):
        end = _comment_end(tokens, at, kept)
        if end is None:
            kept.append(tokens[at])
            at += 1
            continue
        skipped.append(tokens[at:end])
        while kept and (kept[-1].tags.keys() & {"comma"} or _is_and(kept[-1])):
            kept.pop()
        at = end
        if not kept or "end" in kept[-1].tags:  # nothing is left of the sentence so far: what follows begins it
            while at < len(tokens) and (tokens[at].tags.keys() & {"comma", "colon"}):
                at += 1
            if at < len(tokens) - 1 and "end" in tokens[at].tags:
                at += 1
    return kept, skipped


def denied(skipped: list[Token], ways: list[tuple[str, ...]]) -> Token | None:
    """Return the word of a skipped stretch that no vehicle's way fits: "a left turn" where nobody turns left.

    Parameters
    ----------
    ways
        For each vehicle its turn and its headings.
    """
    for token, following in pairwise([*skipped, None]):
        if token is None:
            break
        said = token.tags.get("direction") or token.tags.get("heading")
        turns = following is not None and "event_noun" in following.tags  # "a right turn", not "right at the line"
        if (turns or token.tags.get("adverb") != "just") and said is not None and not any(said in way for way in ways):
            return token
    return None


def _is_and(token: Token) -> bool:
    return token.text.lower() in ("and", "but", "thus", "so", "thereby")


def _comment_end(tokens: list[Token], at: int, kept: list[Token]) -> int | None:
    """Return where a comment that begins at `at` ends, or None where none does."""
    kind = tokens[at].tags.get("comment")
    fresh = not kept or bool(kept[-1].tags.keys() & {"end", "colon"})
    if fresh and (ended := letter_end(tokens, at)) is not None:
        return ended
    if kind is None and fresh:
        kind = _expectation(tokens, at)
    parted = fresh or bool(kept[-1].tags.keys() & {"comma"})
    if parted and (meets := remark_end(tokens, at)) is not None:
        return meets
    if kind is None or (kind == "sentence" and not fresh):
        return None
    if kind == "line":
        return at + 1
    end = at + 1
    while "end" not in tokens[end].tags:
        if "colon" in tokens[end].tags and end > at + 1:
            break  # "The AV copes with a pushy driver: the AV turns right ..."
        if kind == "clause" and "comma" in tokens[end].tags:
            break  # "To see how the AV copes, the car brakes", "..., forcing the AV to react, and ..."
        end += 1
    body = tokens[at:end]
    if any(token.tags.keys() & _CONTENT or token.quantity is not None for token in body):
        return None
    return end


def tells_way(words: list[Token]) -> bool:
    """Whether "is expected to turn left" tells where a vehicle goes, which is no comment on how it should cope."""
    if len(words) < 3 or words[0].text.lower() not in ("is expected to", "are expected to"):
        return False
    verb, after = words[1].tags.get("verb"), words[2]
    goes_on = after.tags.get("verb") == "lane_follow" or after.tags.get("direction") == "straight"
    goes_on = goes_on or after.text.lower() in ("to", "on", "in", "along") or words[1].text.endswith(" on")
    turns = any(token.tags.get("event_noun") == "turn" for token in words[2:])
    if verb in ("go", "make"):
        return goes_on if verb == "go" else turns
    return verb in ("turn", "lane_follow", "pull_out", "drive")


def _expectation(tokens: list[Token], at: int) -> str | None:
    """Read "The AV is expected to ..." as a comment: what the ego should do is for its own driving policy to decide."""
    at += tokens[at].tags.get("determiner") is not None
    if "ego" not in tokens[at].tags:
        return None
    at += 1 + ("noun" in tokens[at + 1].tags)
    if tells_way(tokens[at : at + 6]):
        return None
    return "sentence" if at < len(tokens) and "expected" in tokens[at].tags else None
