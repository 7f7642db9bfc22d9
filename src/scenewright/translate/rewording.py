"""Gives words the class that their neighbours show: "over the lane of the ego", "somebody in a hatchback", "E->N".

What enters: tokens. What leaves: tokens, some with other tags, and without words that only wrap a vehicle. It drops
nothing that tells of a place, an amount or an action.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from scenewright.errors import Span
from scenewright.translate.regrouping import regrouped
from scenewright.translate.tokens import Token

_SOMEBODY = ("somebody", "someone", "a person", "one person", "some person", "some driver")
_COMPASS = {"n": "N", "e": "E", "s": "S", "w": "W", "north": "N", "east": "E", "south": "S", "west": "W"}
_ARROW_LENGTH = 3
_TURN_EDGES = {"start": "turn_start", "beginning": "turn_start", "end": "turn_end", "completion": "turn_end"}
_CARRIES = {"carries": "s", "carry": "base", "carrying": "ing", "carried": "ed", "sees": "s", "seeing": "ing"}
_GETS = {"gets": "s", "get": "base", "getting": "ing", "got": "ed", "is": "s", "be": "base", "being": "ing"}
_EDGE_WORDS = 3  # "at the end"
_NOBODY = ("neither", "none", "nobody", "neither of them", "no one")
_NOBODY_WORDS = frozenset(
    ["of", "them", "the", "two", "vehicles", "vehicle", "car", "cars", "one", "will", "is", "are", "going", "to",
     "does", "do", "either", "both", "is to", "are to", "has", "plans"]
)  # fmt: skip


def reworded(tokens: list[Token]) -> list[Token]:
    """Return the tokens with the classes that their neighbours show."""
    tokens = regrouped(tokens)
    tokens = _having_started(_gone_over(_neither_nor(_its_own(tokens))))
    return _neither(
        _relative(
            _headed(_across(_without_somebody(_left_to(_second(_letters(_way_out(_ways(_turns(_carried(tokens))))))))))
        )
    )


def _having_started(tokens: list[Token]) -> list[Token]:
    """Let "having started 75 m before the intersection" be "starting 75 m before the intersection"."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        begun = token.text.lower() in ("started", "begun") and token.tags.get("verb") == "begin"
        placed = at + 1 < len(tokens) and tokens[at + 1].quantity is not None
        if not (begun and placed and at and tokens[at - 1].text.lower() == "having"):
            read.append(token)
            continue
        tags = {"verb": "begin", "onset_verb": "x", "onset": "x", "starting": "x"}
        having = read.pop()
        read.append(Token("starting", having.span.union(token.span), tags, frozenset(("ing",))))
    return read


def _its_own(tokens: list[Token]) -> list[Token]:
    """Let "completes its turn before the ego starts its own" be "... starts its own turn"."""
    read: list[Token] = []
    turn: Token | None = None
    for at, token in enumerate(tokens):
        read.append(token)
        if "end" in token.tags:
            turn = None
        elif token.tags.get("event_noun") == "turn":
            turn = token
        own = token.text.lower() in ("its own", "their own") and "possessive" in token.tags
        if own and turn is not None and tokens[at - 1].tags.get("verb") == "begin" and _ends(tokens, at + 1):
            read.append(replace(turn, span=token.span))
    return read


def _neither_nor(tokens: list[Token]) -> list[Token]:
    """Let "neither yields nor speeds up" be "does not yield and does not speed up"; so with ", nor does it"."""
    read: list[Token] = []
    at = 0
    denied = False  # a negation that "nor" goes on with
    while at < len(tokens):
        token, word = tokens[at], tokens[at].text.lower()
        denied = (denied or "negation" in token.tags) and "end" not in token.tags
        verb = at + 1 < len(tokens) and "verb" in tokens[at + 1].tags
        if word == "neither" and verb:
            read.append(Token(token.text, token.span, {"negation": "not"}))
            denied = True
        elif word == "nor" and denied:
            inverted = at + 3 < len(tokens) and tokens[at + 1].tags.get("auxiliary") == "do"
            inverted = inverted and "pronoun" in tokens[at + 2].tags and "verb" in tokens[at + 3].tags
            if not (verb or inverted):
                return tokens
            read.append(Token(token.text, token.span, {"link": "and"}))
            read.append(Token(token.text, token.span, {"negation": "not"}))
            at += 2 if inverted else 0
        else:
            read.append(token)
        at += 1
    return read


def _gone_over(tokens: list[Token]) -> list[Token]:
    """Let "gets over the conflict point" and "is over it before" be "passes": no bound stands there."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        forms = _GETS.get(tokens[at - 1].text.lower()) if at else None
        after = at + 1 + ("determiner" in tokens[min(at + 1, len(tokens) - 1)].tags)
        named = after < len(tokens) and tokens[after].tags.get("landmark") == "conflict_point"
        if token.text.lower() != "over" or "bound" not in token.tags or forms is None or not named:
            read.append(token)
            continue
        gets = read.pop()
        read.append(Token(f"{gets.text} over", gets.span.union(token.span), {"verb": "pass"}, frozenset((forms,))))
    return read


def _carried(tokens: list[Token]) -> list[Token]:
    """Let "carries the turn through to its end" be "carries through the turn"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        form = _CARRIES.get(tokens[at].text.lower())
        owned = at + 3 < len(tokens) and bool(tokens[at + 1].tags.keys() & {"determiner", "possessive"})
        turn = owned and tokens[at + 2].tags.get("event_noun") == "turn"
        if form is None or not turn or "through" not in tokens[at + 3].tags:
            read.append(tokens[at])
            at += 1
            continue
        read.append(Token("carry through", tokens[at].span, {"verb": "complete"}, frozenset((form,))))
        read += tokens[at + 1 : at + 3]
        at += 4
        if [each.text.lower() for each in tokens[at : at + 3]] in (["to", "its", "end"], ["to", "the", "end"]):
            at += 3
    return read


def _turns(tokens: list[Token]) -> list[Token]:
    """Let "the end of its turn" be a place of its owner, as "its turn_end"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        if _is_at_turn(tokens, at):
            read.append(replace(tokens[at], tags={"landmark": "turn"}, forms=frozenset()))
            at += 1
            continue
        words = tokens[at].text.lower().split()
        place = _TURN_EDGES.get(words[-1]) if words else None
        end = _turn_of(tokens, at + 1) if place is not None and len(words) <= _EDGE_WORDS else None
        if place is None or end is None:
            read.append(tokens[at])
            at += 1
            continue
        if words[0] in ("at", "from"):
            read.append(Token(words[0], tokens[at].span, {"preposition": {"from": "out"}.get(words[0], "at")}))
        elif read and "determiner" in read[-1].tags:
            read.pop()
        read += tokens[at + 2 : end - 1]
        read.append(Token(_words(tokens[at:end]), tokens[end - 1].span, {"landmark": place}))
        at = end
    return read


def _is_at_turn(tokens: list[Token], at: int) -> bool:
    """Whether "turn" is a place, as in "is at the turn" and "20 m before its turn"."""
    if tokens[at].tags.get("event_noun") != "turn" or at < _EDGE_WORDS or not _ends(tokens, at + 1, "link"):
        return False
    owned = bool(tokens[at - 1].tags.keys() & {"determiner", "possessive"}) and tokens[at - 1].text.lower() != "a"
    before = tokens[at - 2].tags
    placed = before.get("preposition") == "at" or (
        before.get("relation") in ("from", "before") and tokens[at - 3].quantity is not None
    )
    return owned and placed


def _turn_of(tokens: list[Token], at: int) -> int | None:
    """Return the position after "of its turn" and "of the van's turn", or None."""
    if tokens[at].text.lower() != "of":
        return None
    at += 1
    while tokens[at].tags.keys() & {"determiner", "possessive", "ego", "hero", "noun", "genitive"}:
        at += 1
    return at + 1 if tokens[at].tags.get("event_noun") == "turn" else None


def _letters(tokens: list[Token]) -> list[Token]:
    """Let a capital W be west, and "the westbound traffic" after "into" a lane."""
    read = list(tokens)
    for at, token in enumerate(tokens):
        before: Mapping[str, str] = tokens[at - 1].tags if at else {}
        if "unknown" in token.tags and token.text in ("N", "E", "S", "W"):
            read[at] = replace(token, tags={"heading": token.text})
        elif token.text.lower() == "through" and _ends(tokens, at + 1) and before.keys() & {"heading", "comma"}:
            read[at] = replace(token, tags={"direction": "straight"})  # "westbound through."
        elif (
            token.text.lower() == "going through" and _ends(tokens, at + 1)
            and "comma" in before and at > 1 and "heading" in tokens[at - 2].tags
        ):  # fmt: skip
            read[at] = replace(token, tags={"direction": "straight"})  # "is westbound, going through, at 35 mph"
        elif token.text.lower() == "traffic" and "heading" in before and _joins(tokens, at - 2):
            read[at] = replace(token, tags={"area": "lane"})
    return read


def _ends(tokens: list[Token], at: int, *more: str) -> bool:
    return at >= len(tokens) or bool(tokens[at].tags.keys() & {"end", "comma", *more})


def _joins(tokens: list[Token], at: int) -> bool:
    """Whether "into", "into the" or "joins the" stands at `at` and before."""
    at -= at >= 0 and "determiner" in tokens[at].tags
    return at >= 0 and (tokens[at].tags.get("preposition") == "into" or tokens[at].tags.get("verb") == "pull_out")


def _neither(tokens: list[Token]) -> list[Token]:
    """Let "neither of them turns" be "both go straight"."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        alone = (at == 0 or "end" in tokens[at - 1].tags) and at + 1 < len(tokens) and "end" in tokens[at + 1].tags
        if alone and tokens[at].text.lower() in ("no turns", "no turn", "no turning"):  # "No turns."
            read.append(Token("both", tokens[at].span, {"pair": "pair"}))
            read.append(Token(tokens[at].text, tokens[at].span, {"verb": "lane_follow"}, frozenset(("base",))))
            at += 1
            continue
        end = at + 1
        while end < len(tokens) and tokens[end].text.lower() in _NOBODY_WORDS:
            end += 1
        turns = end < len(tokens) and tokens[end].text.lower() in ("turn", "turns", "turning", "turns off")
        ends = turns and bool(tokens[end + 1].tags.keys() & {"end", "comma", "link"})
        if tokens[at].text.lower() not in _NOBODY or not ends:
            read.append(tokens[at])
            at += 1
            continue
        span = tokens[at].span.union(tokens[end].span)
        read.append(Token("neither", tokens[at].span, {"pair": "pair"}))
        read.append(Token(_words(tokens[at : end + 1]), span, {"verb": "lane_follow"}, frozenset(("base",))))
        at = end + 1
    return read


def _words(tokens: list[Token]) -> str:
    """Return the words of some tokens."""
    return " ".join(token.text for token in tokens)


def _way_out(tokens: list[Token]) -> list[Token]:
    """Let "are on their way out" be a verb of motion."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        words = [token.text.lower() for token in tokens[at : at + 4]]
        owned = len(words) > 1 and words[1] in ("its", "their", "the", "his", "her")
        if not owned or [words[0], *words[2:]] != ["on", "way", "out"] or not _ends(tokens, at + 4, "link"):
            read.append(tokens[at])
            at += 1
            continue
        span = tokens[at].span.union(tokens[at + 3].span)
        read.append(Token(" ".join(words), span, {"verb": "pull_out"}, frozenset(("ing",))))
        at += 4
    return read


def _headed(tokens: list[Token]) -> list[Token]:
    """Let "Actors:" be a heading and no word for a third vehicle."""
    read = list(tokens)
    for at, token in enumerate(tokens[:-1]):
        begins = at == 0 or "end" in tokens[at - 1].tags
        noted = begins and token.tags.keys() & {"ego", "hero"} and tokens[at + 1].text == "="
        if noted and tokens[at + 2].quantity is None:
            read[at + 1] = replace(tokens[at + 1], tags={"colon": ":"})  # "Ego = westbound"
        if token.tags.keys() >= {"label", "unsupported"} and "colon" in tokens[at + 1].tags:
            read[at] = replace(token, tags={key: tag for key, tag in token.tags.items() if key != "unsupported"})
    return read


def _second(tokens: list[Token]) -> list[Token]:
    """Let "the second vehicle" be a vehicle and no moment."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        named = at + 1 < len(tokens) and tokens[at + 1].tags.keys() & {"noun", "hero", "actor_adjective"}
        if token.text.lower() != "the second" or not named:
            read.append(token)
            continue
        middle = token.span.start + len("the")
        read.append(Token("the", Span(token.span.start, middle), {"determiner": "definite"}))
        read.append(Token("second", Span(middle + 1, token.span.end), {"actor_adjective": "other"}))
    return read


def _left_to(tokens: list[Token]) -> list[Token]:
    """Let "turns left to continue east" be a turn, no distance left; "to the right at the moment" a side."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        sided = at > 1 and "determiner" in tokens[at - 1].tags and tokens[at - 2].text.lower() == "to"
        sided = sided or (at > 0 and tokens[at - 1].tags.get("verb") in ("turn", "pull_out"))
        if sided and token.text.lower().startswith("right ") and token.tags.get("link") == "when":
            middle = token.span.start + len("right")
            read.append(Token("right", Span(token.span.start, middle), {"direction": "right"}))
            read.append(Token(token.text[len("right ") :], Span(middle + 1, token.span.end), {"link": "when"}))
            continue
        turns = read and (read[-1].tags.get("verb") in ("turn", "pull_out", "go") or "bound_word" in read[-1].tags)
        if not turns or token.text.lower() != "left to":
            read.append(token)
            continue
        middle = token.span.start + len("left")
        read.append(Token("left", Span(token.span.start, middle), {"direction": "left"}))
        read.append(Token("to", Span(middle + 1, token.span.end), {"link": "to", "preposition": "to"}))
    return read


def _relative(tokens: list[Token]) -> list[Token]:
    """Let "in the driveway, from which it turns left" be "and it turns left": the place was named."""
    read: list[Token] = []
    for at, token in enumerate(tokens):
        which = (
            token.text.lower() == "which" and read and read[-1].tags.get("preposition") in ("out", "into", "on", "in")
        )
        after = tokens[at + 1].tags.keys() if at + 1 < len(tokens) else set()
        if which and after & {"pronoun", "ego", "hero", "determiner"}:
            read[-1] = Token(f"{read[-1].text} which", read[-1].span.union(token.span), {"link": "and"})
        else:
            read.append(token)
    return read


def _across(tokens: list[Token]) -> list[Token]:
    """Let "over" in front of a lane be a preposition and no bound."""
    read = list(tokens)
    for at, token in enumerate(tokens[:-2]):
        owned = tokens[at + 1].tags.keys() & {"determiner", "possessive"}
        if token.text.lower() != "over" or not owned:
            continue
        end = at + 2
        while tokens[end].tags.keys() & {"heading", "same", "area_adjective", "actor_adjective", "ego", "genitive"}:
            end += 1
        if tokens[end].tags.get("area") == "lane":
            read[at] = replace(token, tags={"preposition": "across"})
    return read


def _without_somebody(tokens: list[Token]) -> list[Token]:
    """Let "somebody in a hatchback" be the hatchback, and "somebody" alone a driver."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        if tokens[at].text.lower() not in _SOMEBODY:
            read.append(tokens[at])
            at += 1
            continue
        after = at + 1
        after += tokens[after].text.lower() in ("who is", "who's", "who", "else")
        wheel = [token.text.lower() for token in tokens[after : after + 4]]
        if wheel and wheel[0] in ("in", "driving", "on", "riding", "inside"):
            at = after + 1
        elif wheel == ["at", "the", "wheel", "of"]:
            at = after + 4
        else:
            article = Token("a", tokens[at].span, {"determiner": "indefinite"})
            read += [article, Token("driver", tokens[at].span, {"noun": "driver"})]
            at += 1
    return read


def _ways(tokens: list[Token]) -> list[Token]:
    """Let "E->N" be the two headings of a way, as a route is written in a program."""
    read: list[Token] = []
    at = 0
    while at < len(tokens):
        end = _way_end(tokens, at)
        if end is None:
            read.append(tokens[at])
            at += 1
            continue
        way = f"{_COMPASS[tokens[at].text.lower()]} {_COMPASS[tokens[end - 1].text.lower()]}"
        span = tokens[at].span.union(tokens[end - 1].span)
        read.append(Token(" ".join(token.text for token in tokens[at:end]), span, {"way": way}))
        at = end
    return read


def _way_end(tokens: list[Token], at: int) -> int | None:
    """Return the position after "E -> N" or "E→N", or None."""
    if tokens[at].text.lower() not in _COMPASS:
        return None
    end = at + 1
    while end < len(tokens) and end - at <= _ARROW_LENGTH and tokens[end].text in ("-", "–", "—", ">", "->", "=>", "→"):
        end += 1
    arrow = "".join(token.text for token in tokens[at + 1 : end])
    if not arrow.endswith((">", "→")) or end >= len(tokens) or tokens[end].text.lower() not in _COMPASS:
        return None
    return end + 1
