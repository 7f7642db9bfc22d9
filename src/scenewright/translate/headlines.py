"""Knows lines that only name a test: "Car-following check, T junction", "The polite-driver case.", "Scenario 14b:".

What enters: tokens and a position at which a sentence begins. What leaves: the position of the mark that ends such a
line, or None. A line with an amount, with the ego's or the hero's own name, or in which anybody acts, names no test.
"""

from __future__ import annotations

from scenewright.translate.tokens import Token

_LONGEST = 14
_NAMES = frozenset(
    ["test", "tests", "check", "checks", "case", "cases", "scenario", "scenarios", "study", "item", "items",
     "exercise", "drill", "experiment", "trial", "regression", "demo", "example", "variant", "variation",
     "evaluation", "assessment", "version", "encounter", "conflict", "story", "mover", "dilemma", "decision",
     "benchmark", "challenge", "probe", "run", "situation", "problem", "task", "use-case", "family", "suite",
     "catalogue", "catalog", "entry", "nr", "no", "id", "ref", "versus", "vs", "vs.", "interaction", "event",
     "opponent", "opponents", "this", "again", "study-case", "theme", "topic", "ticket",
     "issue", "bug", "request"]
)  # fmt: skip
_SAYS = frozenset(
    ("pair", "ego", "hero", "pronoun", "be", "auxiliary", "negation", "quantity", "bound", "key", "there")
)

_LEAD = frozenset(["lead", "leading", "vehicle", "car"])
_SLOWS = frozenset(["deceleration", "decelerating", "braking", "slowing", "stopping"])
_DEEDS = {"brake": "dec", "stop": "stop", "yield": "dec", "accelerate": "go", "go": "go", "pass": "go", "turn": "go"}
_DEEDS |= {"pull_out": "go", "complete": "go", "keep": "go", "wait": "dec", "not_yield": "go", "beat": "go"}


def headline_end(tokens: list[Token], at: int) -> int | None:
    """Return the position of the stop or colon after a line that only names a test, or None."""
    line: list[Token] = []
    for token in tokens[at : at + _LONGEST + 1]:
        if "colon" in token.tags or "end" in token.tags:
            break
        line.append(token)
    end = at + len(line)
    if not line or len(line) > _LONGEST or tokens[end].tags.get("end") == "text":
        return None
    colon = "colon" in tokens[end].tags
    if colon and all("label" in token.tags for token in line):
        return None
    if colon and _lead_slows(line):
        return end
    if not (_names_a_test(line) or (colon and _misjudges(line))) or any(_says(token) for token in line):
        return None
    if any("link" in token.tags for token in line[:1]) or (at > 0 and not colon):
        return None
    return end


def summary_end(tokens: list[Token], at: int) -> int | None:
    """Return the end of a first line without a main verb: "An oncoming car that stops and then turns", or None.

    Its verbs all stand behind "that" or "who"; whether the text goes on to tell what they say is for `untold`.
    """
    if at > 0:
        return None
    relative, end = False, at
    while not tokens[end].tags.keys() & {"end", "colon"}:
        token = tokens[end]
        if token.quantity is not None or end - at > _LONGEST + 6 or "label" in token.tags:
            return None
        if "heading" in token.tags or ("ego" in token.tags and not relative):
            return None  # that tells a way
        relative = relative or token.text.lower() in ("that", "who", "which")
        finite = token.tags.keys() & {"be", "auxiliary"} or ("verb" in token.tags and token.forms & {"s", "ed"})
        if finite and not relative and "event_noun" not in token.tags:
            return None
        end += 1
    acts = any(token.tags.get("verb") in _DEEDS for token in tokens[at:end])
    told = any("ego" in token.tags for token in tokens[end:])
    return end if relative and acts and told and tokens[end].tags.get("end") != "text" else None


def untold(stretch: list[Token], deeds: set[str]) -> Token | None:
    """Return the word of a skipped line for a deed that is not among `deeds`, or that is though it says it is not done.

    Deeds are "dec", "stop" and "go".
    """
    negated = sided = False
    for token in stretch:
        if "nobody_yields" in token.tags and "dec" in deeds:
            return token
        deed = _DEEDS.get(token.tags.get("verb", ""))
        finite = bool(token.forms & {"s", "ed"}) and not (sided and token.tags["verb"] == "turn")  # "two left turns"
        if deed is not None and ((negated and deed in deeds) or (finite and not negated and deed not in deeds)):
            return token
        negated = "negation" in token.tags or (negated and "verb" not in token.tags)
        sided = "direction" in token.tags
    return None


def _names_a_test(line: list[Token]) -> bool:
    words = [word for token in line for word in token.text.lower().replace("-", " ").split()]
    return any(word in _NAMES for word in words)


def _lead_slows(line: list[Token]) -> bool:
    """Whether a line names the test in which a lead vehicle brakes: "Lead-vehicle deceleration"."""
    words = {word for token in line for word in token.text.lower().replace("-", " ").split()}
    return bool(words & _SLOWS) and bool(words & _LEAD) and words <= _SLOWS | _LEAD


def _misjudges(line: list[Token]) -> bool:
    """Whether a line only tells of somebody's mistake: "What happens if the crossing driver misjudges the gap"."""
    told = any(token.tags.keys() & {"heading", "direction", "area"} for token in line)
    return not told and any(token.tags.get("verb") == "attitude" for token in line)


def _says(token: Token) -> bool:
    """Whether a token tells of a vehicle under its own name, or of somebody who acts."""
    if any(word in _NAMES for word in token.text.lower().split()) and "quantity" not in token.tags:
        return False
    if token.tags.keys() & _SAYS or token.quantity is not None:
        return True
    finite = bool(token.forms & {"s", "ed"}) and "event_noun" not in token.tags and "stop_noun" not in token.tags
    return "verb" in token.tags and finite and token.tags["verb"] != "attitude"
