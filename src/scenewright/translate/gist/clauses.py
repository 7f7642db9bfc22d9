"""Cuts tokens into clauses, each with the word that links it, its subject and its place in the story.

What enters: tokens and who is named. What leaves: a list of `Clause`. No amount and no deed is read here.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from scenewright.errors import Span
from scenewright.translate.events import HERO_ID
from scenewright.translate.gist.names import Names
from scenewright.translate.tokens import Token

NEGATIVES = frozenset(("neither", "nor", "none", "no", "cannot", "nobody"))
_LINKS = ("when", "then", "moment", "before", "after", "until", "that")
_OBJECT_AFTER = frozenset(("relation", "separates"))
_OBJECT_PREPOSITIONS = frozenset(("to", "of", "for", "by", "between", "across", "into", "in", "on", "at", "out"))
_TAKES_OBJECT = frozenset(
    ("follow", "yield", "approach", "pass", "lead", "not_yield", "cut_in_front", "beat", "come_towards", "reach", "enter",
     "attitude", "get_within", "hit")
)


@dataclass(slots=True)
class Clause:
    """A stretch of tokens that says one thing.

    Attributes
    ----------
    link
        What ties it to the text: ``main``, ``when``, ``then``, ``before``, ``after``, ``until``, ``that``, or ``start``,
        ``trigger`` and ``deed`` where a label or a word says what part of the story it is.
    subject
        The actor that it is about, where known.
    owner
        Whether the subject was named in this very clause.
    """

    start: int
    end: int
    sentence: int
    link: str = "main"
    subject: int | None = None
    named: bool = False
    both: bool = False
    aside: bool = False
    pair: bool = False  # "the ego and the van"
    labels: list[str] = field(default_factory=list)

    def span(self, tokens: list[Token]) -> Span:
        """Return where the clause stands in the text."""
        return tokens[self.start].span.union(tokens[self.end - 1].span)


def cut(tokens: list[Token], names: Names) -> list[Clause]:
    """Return the clauses of a text."""
    clauses: list[Clause] = []
    sentence, start, link = 0, 0, "main"
    labels: list[str] = []
    labelled: int | None = None
    heading: tuple[list[str], int | None] = ([], None)  # of a heading line, for the lines under it

    def close(end: int) -> None:
        nonlocal start, link  # noqa
        if end > start:
            clauses.append(Clause(start, end, sentence, link, labelled, labels=list(labels)))
            link = "main"
        start = end

    for at, token in enumerate(tokens):
        if "end" in token.tags:
            alone = _heading(tokens, start, at, names)
            if alone is not None:
                heading = alone
                start = at
            elif labels and token.text.startswith("\n") and at and "colon" in tokens[at - 1].tags:
                heading = (list(labels), labelled)
            close(at)
            goes_on = token.text.startswith(";")
            labels, labelled = (labels, labelled) if goes_on else (list(heading[0]), heading[1])
            start, link = at + 1, "main"
            sentence += 1
            if "\n\n" in token.text or (token.text in (".", "!", "?") and heading[0] != []):
                heading = ([], None)
                labels, labelled = ([], None) if not goes_on else (labels, labelled)
        elif token.tags.keys() & {"comma"}:
            close(at)
            start = at + 1
        elif "colon" in token.tags and at + 1 < len(tokens) and "quantity" in tokens[at + 1].tags and _measures(tokens[start:at]):
            continue  # "time to arrival at the start: 8 s"
        elif "colon" in token.tags:
            label = _label(tokens, start, at)
            if label is not None:
                fresh = not any(each.sentence == sentence for each in clauses)
                labels = [label] if fresh and label != "who" else [*labels, label]
                labelled = next((names.actors[i] for i in range(start, at) if i in names.actors), labelled)
                start, link = at + 1, "main"
            else:
                close(at)
                start, link = at + 1, "colon"
        elif (found := _link(tokens, at, names)) is not None:
            close(at)
            start, link = at + 1, found
        elif (
            token.tags.get("link") == "and"
            and _begins_clause(tokens, at + 1, names)
            and not any(each.tags.get("preposition") == "between" for each in tokens[max(start, at - 4) : at])
        ):
            close(at)
            start, link = at + 1, "and"
    close(len(tokens))
    clauses = [part for clause in _joined(clauses, tokens, names) for part in _parted(clause, tokens, names)]
    for clause in clauses:
        clause.aside = _is_aside(clause, tokens, names)
    _give_subjects(clauses, tokens, names)
    return clauses


def _joined(clauses: list[Clause], tokens: list[Token], names: Names) -> list[Clause]:
    """Let "the ego and the van drive west" be one clause about both."""
    joined: list[Clause] = []
    for clause in clauses:
        before = joined[-1] if joined else None
        if before is not None and clause.link == "and" and before.sentence == clause.sentence and before.end + 1 == clause.start:
            words = tokens[before.start : before.end]
            bare = not any(each.tags.keys() & {"verb", "be", "quantity", "auxiliary"} and "actor_adjective" not in each.tags for each in words)
            first = [names.actors[at] for at in range(before.start, before.end) if at in names.actors]
            second = [names.actors[at] for at in range(clause.start, clause.end) if at in names.actors]
            if bare and first and second and first[-1] != second[0]:
                joined[-1] = replace(clause, start=before.start, link=before.link, pair=True)
                continue
        joined.append(clause)
    return joined


def _parted(clause: Clause, tokens: list[Token], names: Names) -> list[Clause]:
    """Cut "when the ego is 12 m from the stop line the hero brakes" before the second subject."""
    told = False
    for at in range(clause.start, clause.end):
        if "quantity" in tokens[at].tags:
            told = True
        if not told or at not in names.actors or is_object(tokens, at, names):
            continue
        first = at
        while first > clause.start and tokens[first - 1].tags.keys() & {"determiner", "actor_adjective", "heading"}:
            first -= 1
        before = tokens[first - 1].tags
        if before.keys() & {"landmark", "back_reference", "area", "hero", "ego", "noun", "quantity", "mark_noun"}:
            rest = replace(clause, start=first, link="main")
            return [replace(clause, end=first), *_parted(rest, tokens, names)]
    return [clause]


def _is_aside(clause: Clause, tokens: list[Token], names: Names) -> bool:
    """Whether a clause is about something else: "The courtesy did not last", "you might expect"."""
    at = clause.start
    if tokens[at].text.lower() in ("you", "nobody", "everyone"):
        return True
    while at < clause.end and tokens[at].tags.keys() & {"determiner", "actor_adjective", "area_adjective", "adverb"} and "hero" not in tokens[at].tags:
        at += 1
    if at >= clause.end or "unknown" not in tokens[at].tags or at in names.actors or at in names.pronouns:
        return False
    if tokens[at].text.lower() in NEGATIVES:
        return False
    while at < clause.end and "unknown" in tokens[at].tags:
        at += 1
    if at >= clause.end or at in names.actors:
        return False
    tags = tokens[at].tags
    finite = "be" in tags or "auxiliary" in tags or (("verb" in tags) and bool(tokens[at].forms & {"s", "ed"}))
    return finite


def _measures(stretch: list[Token]) -> bool:
    return any(each.tags.keys() & {"measure", "measures"} for each in stretch)


def _heading(
    tokens: list[Token], start: int, at: int, names: Names
) -> tuple[list[str], int | None] | None:
    """Return what a line that is only a heading announces: "Trigger", "Ego"."""
    if at == start or not tokens[at].text.startswith("\n"):
        return None
    label = _label(tokens, start, at)
    if label is None:
        return None
    return [label], next((names.actors[i] for i in range(start, at) if i in names.actors), None)


def _label(tokens: list[Token], start: int, at: int) -> str | None:
    """Return what a short stretch before a colon announces."""
    stretch = [each for each in tokens[start:at] if "determiner" not in each.tags]
    if not stretch or len(stretch) > 3:
        return None
    told = [each.tags["label"] for each in stretch if "label" in each.tags]
    if told:
        return {"when": "trigger", "main": "deed", "start": "start", "none": "none"}.get(told[0], told[0])
    if "initially" in [each.tags.get("adverb") for each in stretch]:
        return "start"
    named = any(each.tags.keys() & {"ego", "hero", "noun"} for each in stretch)
    if named and all(each.tags.keys() & {"ego", "hero", "noun", "actor_adjective"} for each in stretch):
        return "who"
    return None


def _link(tokens: list[Token], at: int, names: Names) -> str | None:
    """Return what a linking word links, or None where it is none, or is a preposition here."""
    token = tokens[at]
    link = token.tags.get("link")
    if "label" in token.tags and link is None:
        return None
    if link not in _LINKS:
        return None
    if token.text.lower() == "following" and not tokens[at + 1].text.lower() in ("that", "this"):
        return None
    if token.text.lower() in ("ahead of", "in front of"):
        back = [each.tags.get("verb") for each in tokens[max(0, at - 8) : at]]
        return link if set(back) & {"pass", "complete", "accelerate", "reach", "go"} else None
    if link in ("before", "after"):
        if at and ("quantity" in tokens[at - 1].tags or tokens[at - 1].tags.get("adverb") == "just"):
            return None
        return None if _names_place(tokens, at + 1) else link
    following = tokens[at + 1] if at + 1 < len(tokens) else token
    if token.text.lower() == "at that" and following.tags.keys() & {"landmark", "mark_noun", "back_reference"}:
        return None
    if token.text.lower() in ("the second", "second") and following.tags.get("preposition") == "of":
        return None
    if link == "that" and tokens[at + 1].tags.get("preposition") in ("out", "of"):
        return None
    if link == "that" and ("determiner" in token.tags and tokens[at + 1].tags.keys() & {"mark_noun", "back_reference", "area", "noun", "landmark"}):
        return None
    if link == "when" and token.tags.get("label") and at + 1 < len(tokens) and "colon" in tokens[at + 1].tags:
        return None
    return link


def _names_place(tokens: list[Token], at: int) -> bool:
    while at < len(tokens) and tokens[at].tags.keys() & {"determiner", "possessive", "area_adjective"}:
        at += 1
    if at >= len(tokens) or not tokens[at].tags.keys() & {"landmark", "back_reference", "area", "mouth"}:
        return False
    return at + 1 >= len(tokens) or "be" not in tokens[at + 1].tags


def _begins_clause(tokens: list[Token], at: int, names: Names) -> bool:
    """Whether "and" is followed by a name or a verb, and not by "40 m" or "straight"."""
    while at < len(tokens) and tokens[at].tags.keys() & {"determiner", "actor_adjective", "unknown", "adverb", "link"}:
        at += 1
    if at >= len(tokens):
        return False
    return at in names.actors or at in names.pronouns or at in names.both or bool(
        tokens[at].tags.keys() & {"verb", "auxiliary", "be", "negation"}
    )


def is_object(tokens: list[Token], at: int, names: Names) -> bool:
    """Whether the name at `at` stands after a preposition or as the object of a verb."""
    following = tokens[at + 1 : at + 3]
    if following and "genitive" in following[0].tags and any(t.tags.get("area") == "lane" for t in following):
        return True
    measured = bool(following) and bool(following[0].tags.keys() & {"measure", "quantity"})
    back = at - 1
    while back >= 0 and back not in names.actors and (
        tokens[back].tags.keys() & {"determiner", "actor_adjective", "possessive", "heading", "hero", "noun", "unknown", "direction"}
        and back not in names.pronouns
    ):
        tags = tokens[back].tags
        if tags.keys() & {"relation", "preposition", "verb", "link"} and not tags.keys() & {"determiner", "actor_adjective"}:
            break
        back -= 1
    if 0 < back < at and "ing" in tokens[back].forms and "determiner" in tokens[back - 1].tags:
        return is_object(tokens, back, names) if back not in names.actors else False  # "the entering car"
    if back < 0:
        return False
    tags = tokens[back].tags
    if tags.get("verb") in _TAKES_OBJECT and tags.get("verb") != "reach":
        return True
    if measured and tags.get("preposition") in ("at", "with", "of", "to"):
        return tags.get("preposition") in ("of", "to") and "measure" not in following[0].tags
    if "link" in tags and tags["link"] not in ("to", "by") and not (back and "quantity" in tokens[back - 1].tags):
        return False
    if tags.keys() & _OBJECT_AFTER and tags.get("link") not in ("when",):
        return True
    if tags.get("preposition") in _OBJECT_PREPOSITIONS:
        return True
    if tags.get("verb") == "let":
        return bool(tokens[back].forms & {"s", "ing"}) or (back > 0 and tokens[back - 1].text.lower() in ("to", "and"))
    return tags.get("verb") in _TAKES_OBJECT


def _give_subjects(clauses: list[Clause], tokens: list[Token], names: Names) -> None:
    """Find whom each clause is about; who is not named is who was spoken of before."""
    last: int | None = None
    acting = False
    for index, clause in enumerate(clauses):
        inside = range(clause.start, clause.end)
        verbs = {tokens[at].tags.get("verb") for at in inside}
        plural = clause.pair or any(at in names.both for at in inside)
        before = clauses[index - 1] if index else None
        plural = plural or _agrees_with_two(clause, clauses[:index], tokens, names)
        goes_on = before is not None and before.both and before.sentence == clause.sentence and clause.link in ("and", "main")
        clause.both = plural
        if clause.subject is None:
            named = next((at for at in inside if at in names.actors and not is_object(tokens, at, names)), None)
            agent = next((at for at in inside if at in names.actors and _is_agent(tokens, at)), None)
            given = next((at for at in inside if at in names.actors and _is_agent(tokens, at, ("for",))), None)
            no_pronoun = not any(at in names.pronouns for at in inside)
            found = named if named is not None else agent
            if found is None and given is not None and no_pronoun and not verbs & {"brake", "stop", "accelerate"}:
                found = given
            if found is not None:
                clause.subject, clause.named = names.actors[found], True
        if _starts_it(clause, tokens):
            clause.labels = [*clause.labels, "start"]
            if index and clauses[index - 1].sentence == clause.sentence:
                clauses[index - 1].labels = [*clauses[index - 1].labels, "start"]
        if clause.aside and not clause.named:
            clause.subject = None
            continue
        if goes_on and not clause.named and not any(at in names.pronouns for at in inside):
            clause.both = True
        if clause.subject is None:
            clause.subject = _unnamed(index, clauses, tokens, names, last, acting)
        main = clause.link not in ("before", "after", "until", "when", "that")
        if clause.subject == HERO_ID and (
            verbs & {"brake", "stop", "accelerate"} or (main and verbs & {"pass", "complete"})
        ):
            acting = True
        last = clause.subject


def _agrees_with_two(clause: Clause, before: list[Clause], tokens: list[Token], names: Names) -> bool:
    """Whether the verb is a plural: "a van and, behind it, the ego drive east"."""
    others = {names.actors[at] for each in before if each.sentence == clause.sentence for at in range(each.start, each.end) if at in names.actors}
    for at in range(clause.start + 1, clause.end):
        if "verb" in tokens[at].tags and tokens[at].forms == {"base"} and at - 1 in names.actors:
            return bool(others - {names.actors[at - 1]})
    return False


def _starts_it(clause: Clause, tokens: list[Token]) -> bool:
    """Whether this is "when the observation begins"."""
    inside = tokens[clause.start : clause.end]
    begins = bool(inside) and inside[-1].tags.get("verb") == "begin"
    return clause.link == "when" and begins and len(inside) <= 3 and any("unknown" in t.tags or "frame_noun" in t.tags for t in inside)


def _unnamed(
    index: int, clauses: list[Clause], tokens: list[Token], names: Names, last: int | None, acting: bool
) -> int | None:
    """Return whom a clause without a name is about."""
    clause = clauses[index]
    inside = range(clause.start, clause.end)
    pronouns = [at for at in inside if at in names.pronouns]
    verbs = {tokens[at].tags.get("verb") for at in inside}
    if any(tokens[at].text.lower() in ("he", "she", "him", "his", "her", "hers") for at in pronouns):
        return HERO_ID
    if any("latter" in tokens[at].tags for at in inside):
        back = next((at for at in range(clause.start - 1, -1, -1) if at in names.actors), None)
        return names.actors[back] if back is not None else last
    if names.spoken and pronouns and any(tokens[at].tags.keys() & {"pronoun", "possessive"} for at in pronouns):
        return HERO_ID
    if clause.link == "that":
        back = next((at for at in range(clause.start - 1, -1, -1) if at in names.actors), None)
        if back is not None and tokens[clause.start - 1].text.lower() in ("which", "who", "that", "where"):
            return names.actors[back]
    here = [c for c in clauses[:index] if c.sentence == clause.sentence]
    hero_here = acting or any(c.named and c.subject == HERO_ID for c in here)
    if pronouns and hero_here and verbs & {"brake", "stop", "accelerate"} and clause.link in ("main", "and", "then", "moment", "colon"):
        return HERO_ID
    told = ("main", "and", "then", "moment", "colon")
    deeds = {"brake", "stop", "accelerate", "pass", "complete", "wait", "keep"}
    after_moment = bool(here) and here[-1].link in ("when", "before", "after", "until")
    if clause.link == "then" or after_moment:
        deeds |= {"go", "turn"}
    if acting and clause.link in told and verbs & deeds:
        return HERO_ID
    chain = [*here, clause]
    fresh = all(not c.named and not _is_finite(c, tokens) for c in chain)
    owned = [at for at in pronouns if not (at and tokens[at - 1].tags.keys() & {"preposition", "relation", "verb"})]
    if fresh and not owned:
        for following in clauses[index + 1 :]:
            if following.sentence != clause.sentence or following.link in ("when", "before", "after", "until"):
                break
            named = next((at for at in range(following.start, following.end) if at in names.actors and not is_object(tokens, at, names)), None)
            if named is not None:
                return names.actors[named]
    return last


def _is_finite(clause: Clause, tokens: list[Token]) -> bool:
    return any(
        tokens[at].tags.keys() & {"be", "auxiliary"} or (tokens[at].forms & {"s"} and "verb" in tokens[at].tags)
        for at in range(clause.start, clause.end)
    )


def _is_agent(tokens: list[Token], at: int, words: tuple[str, ...] = ("by",)) -> bool:
    """Whether a name stands after "by": "the turn is made by the ego"."""
    back = at - 1
    while back >= 0 and tokens[back].tags.keys() & {"determiner", "actor_adjective", "heading", "noun", "unknown"}:
        back -= 1
    return back >= 0 and tokens[back].text.lower() in words
