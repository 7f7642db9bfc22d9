"""Turns headings, lists and numbered steps into running text: "Ego:", bullets under it, "Test case 7:", "Step 2".

What enters: tokens. What leaves: tokens without the marks of layout, in the order in which they were, and the titles
that were stepped over. It reads no clauses; what a heading means (whose lines follow, or that they are the trigger) is
told by its words.
"""

from __future__ import annotations

from dataclasses import replace

from scenewright.errors import Span
from scenewright.translate.headlines import headline_end, summary_end
from scenewright.translate.tokens import Token

_WHOSE = frozenset(("ego", "hero", "noun", "actor_adjective", "determiner", "aspect", "genitive", "pair"))
_SAYS = frozenset(("pair", "ego", "hero", "pronoun", "be", "auxiliary", "negation", "quantity", "measure", "bound"))
_LONGEST_TITLE = 13
_ACTIONS = ("brake", "stop", "yield", "accelerate", "go", "keep", "pass", "complete")
_LONG_ADVERB = 7
_NO_MANNER = frozenset(
    ["scarcely", "rarely", "mostly", "partially", "supposedly", "allegedly", "possibly", "probably", "randomly",
     "occasionally", "alternately", "alternatively", "repeatedly", "potentially", "presumably", "seemingly", "assembly",
     "anomaly", "multiply", "ideally", "usually", "generally", "typically", "optionally", "vertically", "laterally",
     "virtually", "practically", "temporarily", "exclusively", "conditionally"]
)  # fmt: skip


def lay_out(tokens: list[Token]) -> tuple[list[Token], list[list[Token]]]:
    """Return the tokens as running text, and the titles that say nothing of their own."""
    titles: list[list[Token]] = []
    tokens = _without_titles(_without_numbers(_plain_adjectives(tokens)), titles)
    return _lists(_reaches(_moments_within(_joined_conditions(tokens)))), titles


def _reaches(tokens: list[Token]) -> list[Token]:
    """Let "up to the conflict point" be a way, where no amount makes it a bound."""
    read = list(tokens)
    for at, token in enumerate(tokens[:-2]):
        after = at + 1 + ("determiner" in tokens[at + 1].tags or "possessive" in tokens[at + 1].tags)
        if "as_far_as" in token.tags and "landmark" in tokens[after].tags:
            read[at] = replace(token, tags={"as_far_as": token.tags["as_far_as"]})
    return read


def _moments_within(tokens: list[Token]) -> list[Token]:
    """Let "when the ego is within 12 m of the stop line" be the moment at which it is 12 m from it; it is noted."""
    read = list(tokens)
    for at, token in enumerate(tokens[:-1]):
        amount = tokens[at + 1].quantity
        if token.text.lower() != "within" or amount is None or amount.dimension not in ("length", "time"):
            continue
        back = at
        while back >= 0 and "end" not in tokens[back].tags and tokens[back].tags.get("verb") not in _ACTIONS:
            if tokens[back].tags.get("link") == "when" or tokens[back].tags.get("label") == "when":
                read[at] = replace(token, tags={"adverb": "about"})
                break
            back -= 1
    return read


def _joined_conditions(tokens: list[Token]) -> list[Token]:
    """Let a semicolon inside "Trigger: ...; ..." and "When ...; ..." be a comma: what follows belongs to it."""
    joined: list[Token] = []
    conditional, begins = False, True
    for at, token in enumerate(tokens):
        if begins:
            labelled = token.tags.get("label") == "when" and "colon" in tokens[at + 1].tags
            conditional = labelled or (token.tags.get("link") == "when" and not _has_action(tokens, at))
        begins = "end" in token.tags and not (conditional and token.text.strip() == ";")
        joined.append(token if begins or "end" not in token.tags else replace(token, tags={"comma": ","}))
    return joined


def _has_action(tokens: list[Token], at: int) -> bool:
    """Whether something is told to happen before the sentence (or its part before a semicolon) ends."""
    while "end" not in tokens[at].tags:
        if tokens[at].tags.get("verb") in _ACTIONS:
            return True
        at += 1
    return False


def _plain_adjectives(tokens: list[Token]) -> list[Token]:
    """Let an unknown word between an article and a vehicle or a road be an adjective that changes nothing."""
    read = list(tokens)
    for at in range(1, len(tokens) - 1):
        before, after = read[at - 1].tags.keys(), tokens[at + 1].tags.keys()
        described = before & {"determiner", "possessive", "actor_adjective", "area_adjective"}
        if (
            "unknown" in tokens[at].tags
            and tokens[at].text.isalpha()
            and described
            and after & {"noun", "hero", "area", "direction", "event_noun"}
        ):
            read[at] = replace(tokens[at], tags={"actor_adjective": "plain", "guess": "adjective"})
        elif "unknown" in tokens[at].tags and _is_manner(tokens[at].text.lower()):
            read[at] = replace(tokens[at], tags={"adverb": "gently", "guess": "adverb"})
    return read


def _is_manner(word: str) -> bool:
    """Whether a word looks like an adverb of manner ("courteously"), and not like one that takes something back."""
    return len(word) >= _LONG_ADVERB and word.endswith("ly") and word not in _NO_MANNER


def _without_numbers(tokens: list[Token]) -> list[Token]:
    """Drop the numbers of steps, cases and phases: "Step 2:", "case 7", "Phase 1 -"."""
    kept: list[Token] = []
    for token in tokens:
        numbered = "bare_number" in token.tags and kept and kept[-1].tags.keys() & {"numbered", "frame_noun"}
        if numbered and (kept[-1].tags.get("numbered") or len(kept) < 4):
            continue
        kept.append(token)
    return kept


def _without_titles(tokens: list[Token], titles: list[list[Token]]) -> list[Token]:
    """Drop "Unprotected left turn:" and "Step:" in front of a sentence."""
    kept: list[Token] = []
    at, begins = 0, True
    while at < len(tokens):
        end = (headline_end(tokens, at) or summary_end(tokens, at) or _title_end(tokens, at)) if begins else None
        named = _named_line(tokens, at) if begins and end is None else None
        if named is not None:
            titles.append(tokens[at:named])
            at = named + 1
            continue
        if end is not None:
            titles.append(tokens[at:end])
            at = end + 1
            continue
        begins = "end" in tokens[at].tags
        kept.append(tokens[at])
        at += 1
    return kept


def _named_line(tokens: list[Token], at: int) -> int | None:
    """Return the end of a line such as "Scenario: yielding car", which only gives a name."""
    if tokens[at].tags.get("label") != "none" or "colon" not in tokens[at + 1].tags:
        return None
    end = at + 2
    while "end" not in tokens[end].tags:
        token = tokens[end]
        finite = "verb" in token.tags and "s" in token.forms and "event_noun" not in token.tags
        if token.quantity is not None or token.tags.keys() & {"ego", "hero", "be", "auxiliary"} or finite:
            return None
        end += 1
    return end if end > at + 2 and tokens[end].tags["end"] != "text" else None


def _title_end(tokens: list[Token], at: int) -> int | None:
    """Return the position of the colon (or dash) that ends a title, or None where no title begins here."""
    line: list[Token] = []
    for token in tokens[at : at + _LONGEST_TITLE]:
        if "colon" in token.tags or (at == 0 and "end" in token.tags and token.tags["end"] != "text"):
            break
        if "end" in token.tags or token.quantity is not None:
            return None
        line.append(token)
    else:
        return None
    fragment = "colon" not in tokens[at + len(line)].tags  # "A left turn out of a side street."
    tags = {tag for token in line for tag in token.tags}
    if fragment and ("unknown" in tags or not any("ego" in token.tags for token in tokens[at + len(line) :])):
        return None
    first = line[1:] if line and "determiner" in line[0].tags else line
    named = any("noun" in token.tags for token in first[:2]) or (
        any("noun" in t.tags for t in first)
        and not (first and first[0].tags.keys() & {"direction", "event_noun", "unknown"})
    )
    if fragment and (named or any(token.forms & {"s", "ed"} and "event_noun" not in token.tags for token in line)):
        return None
    if "unknown" in tags and not fragment:
        tags.discard("measure")  # "A driver misjudges the gap:"
    if (
        not line
        or tags & _SAYS
        or ("label" in tags and not fragment)
        or any("link" in token.tags for token in line[:1])
    ):
        return None
    told = any("verb" in token.tags and "s" in token.forms and "event_noun" not in token.tags for token in line)
    if told and "unknown" not in tags:
        return None  # "An oncoming car turns left:" says something
    if "numbered" in line[0].tags or not all(token.tags.keys() & _WHOSE for token in line):
        return at + len(line)
    return None


def _lists(tokens: list[Token]) -> list[Token]:
    """Let the lines under "Ego:" or "Trigger:" be one sentence, each line after a comma."""
    laid: list[Token] = []
    joining = False
    for at, token in enumerate(tokens):
        if joining and "key" in token.tags and "colon" in tokens[at + 1].tags:
            continue
        if joining and "colon" in token.tags and "key" in tokens[at - 1].tags:
            continue
        if "end" not in token.tags or token.tags["end"] == "text":
            laid.append(token)
            continue
        heading = _heading_before(laid) or (_bare_heading(laid) if _is_bullet(token) else None)
        if heading is not None:
            joining = heading != "main"
            continue  # the colon goes straight on to the first line
        if not joining or (_heading_at(tokens, at + 1) and "key" not in tokens[at + 1].tags):
            joining = False
            laid.append(token)
        elif _is_line_break(token):
            laid.append(replace(token, tags={"comma": ","}))
        elif not (at + 1 < len(tokens) and _is_line_break(tokens[at + 1])):
            joining = False
            laid.append(token)
    return laid


def _is_line_break(token: Token) -> bool:
    return "end" in token.tags and token.text.startswith("\n")


def _is_bullet(token: Token) -> bool:
    return _is_line_break(token) and bool(token.text.strip())


def _bare_heading(laid: list[Token]) -> str | None:
    """Say "actor" where the line before a list names a vehicle and nothing else, and what a heading alone on it is."""
    line: list[Token] = []
    for token in reversed(laid):
        if "end" in token.tags:
            break
        line.append(token)
    whose = line and all(token.tags.keys() & _WHOSE for token in line)
    label = line[0].tags.get("label") if len(line) == 1 else None
    if not whose and label is None:
        return None
    laid.append(replace(laid[-1], text=":", tags={"colon": ":"}, span=Span(laid[-1].span.end, laid[-1].span.end)))
    return label or "actor"


def _heading_before(laid: list[Token]) -> str | None:
    """Say which heading the line that was just laid is: an actor's, "when", "main", another; None where it is none."""
    if not laid or "colon" not in laid[-1].tags:
        return None
    line: list[Token] = []
    for token in reversed(laid[:-1]):
        if "end" in token.tags:
            break
        line.append(token)
    labels = [token.tags["label"] for token in line if "label" in token.tags]
    if labels:
        return labels[0]
    whose = line and all(token.tags.keys() & _WHOSE for token in line)
    return "actor" if whose else None


def _heading_at(tokens: list[Token], at: int) -> bool:
    """Whether a line that begins here has a colon after its first words."""
    for token in tokens[at : at + 5]:
        line = tokens[at : tokens.index(token)]
        if "colon" in token.tags:  # "initial distance to the intersection: 110 m" heads nothing
            return not (any("measure" in each.tags for each in line) and "quantity" in tokens[at + len(line) + 1].tags)
        if _is_bullet(token) and line and all(each.tags.keys() & _WHOSE for each in line):
            return True
        if _is_bullet(token) and len(line) == 1 and "label" in line[0].tags:
            return True
        if "end" in token.tags or token.quantity is not None:
            return False
    return False
