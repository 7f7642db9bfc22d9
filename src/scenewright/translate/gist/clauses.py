"""Cuts tokens into clauses, each with the word that links it and the label it stands under.

What enters: words with names. What leaves: clauses without subjects; `subjects` finds those. No fact is read here.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field, replace

from scenewright.translate.events import HERO_ID
from scenewright.translate.gist.objects import SEES, SHARES, is_object
from scenewright.translate.gist.subjects import RUNS
from scenewright.translate.gist.words import Clause, Words

NEGATIVES = frozenset(("neither", "nor", "none", "no", "cannot", "nobody", "shall not", "must not", "should not"))
BOUNDS = ("before", "after", "until")
_OTHERS = ("target", "hero", "npc", "pov", "opponent", "challenger", "adversary", "other")
_DURING = ("while", "whilst", "when", "as", "with")
_LINKS = ("when", "then", "moment", "that", *BOUNDS)
_LABELS = {"when": "trigger", "main": "deed"}
_BEFORE_NAMES = frozenset(("determiner", "actor_adjective", "unknown", "adverb", "link", "heading"))
_AMOUNT_ENDS = ("landmark", "back_reference", "area", "hero", "ego", "noun", "quantity", "mark_noun", "pronoun")
_PLACES = ("landmark", "back_reference", "area", "mouth")


@dataclass(slots=True)
class _Cutter:
    words: Words
    clauses: list[Clause] = field(default_factory=list)
    sentence: int = 0
    start: int = 0
    link: str = "main"
    labels: list[str] = field(default_factory=list)
    labelled: int | None = None
    heading: tuple[list[str], int | None] = field(default_factory=lambda: ([], None))  # for the lines under it

    def run(self) -> list[Clause]:
        for at, token in enumerate(self.words.tokens):
            if "end" in token.tags:
                self._end(at)
            elif "comma" in token.tags:
                self._close(at)
            elif "colon" in token.tags:
                self._colon(at)
            elif (link := _link(self.words, at)) is not None:
                self._close(at, link)
            elif token.tags.get("link") == "and" and token.text.lower() != "yet" and self._parts(at):
                self._close(at, "and")
        self._close(len(self.words.tokens))
        return self.clauses

    def _close(self, at: int, link: str | None = None) -> None:
        if at > self.start:
            self.clauses.append(
                Clause(self.start, at, self.sentence, self.link, self.labelled, labels=list(self.labels))
            )
            self.link = "main"
        self.start = at + 1
        self.link = link or self.link

    def _end(self, at: int) -> None:
        text = self.words.tokens[at].text
        label = self._label(at) if at > self.start and text.startswith("\n") else None
        if label is not None:  # a line that is only "Trigger" or "Ego"
            named = self.words.named(range(self.start, at))
            first = self.words.word(self.start).split()[0]
            own = HERO_ID if label == "deed" and first in _OTHERS else None  # "Target action"
            self.heading = [label], named if named is not None else own
            self.start = at
        elif self.labels and text.startswith("\n") and "colon" in self.words.tags(at - 1):
            self.heading = list(self.labels), self.labelled
        self._close(at, "main")
        if not text.startswith(";"):
            if "\n\n" in text or text in (".", "!", "?"):
                self.heading = [], None
            self.labels, self.labelled = list(self.heading[0]), self.heading[1]
        self.sentence += 1

    def _colon(self, at: int) -> None:
        stretch = range(self.start, at)
        if "quantity" in self.words.tags(at + 1) and self.words.has(stretch, "measure", "measures"):
            return  # "time to arrival at the start: 8 s"
        label = self._label(at)
        if label is None:
            self._close(at, "colon")
            return
        fresh = not any(each.sentence == self.sentence for each in self.clauses)
        self.labels = [label] if fresh and label != "who" else [*self.labels, label]
        named = self.words.named(stretch)
        self.labelled = named if named is not None else self.labelled
        if label == "trigger" and self.words.has(stretch, "landmark", "measure", "measures"):
            self._close(at, "colon")  # "Trigger on the time to arrival at the conflict point: ego 4 s"
            return
        self.start, self.link = at + 1, "main"

    def _label(self, at: int) -> str | None:
        """Return what a short stretch before a colon announces."""
        stretch = [i for i in range(self.start, at) if "determiner" not in self.words.tags(i)]
        measured = bool(stretch) and "label" in self.words.tags(stretch[0]) and self.words.has(stretch, "measure")
        if not stretch or (len(stretch) > 3 and not measured) or self.words.has(stretch, "quantity"):
            return None  # "Trigger on the time to arrival at the conflict point: ego 4 s, ..."
        if (told := self.words.where(stretch, "label")) is not None:
            said = self.words.tags(told)["label"]
            return _LABELS.get(said, said)
        if self.words.where(stretch, "adverb", "initially") is not None:
            return "start"
        actors = self.words.names.actors
        names = all(i in actors or self.words.has([i], "actor_adjective") for i in stretch)
        return "who" if names and any(i in actors for i in stretch) else None

    def _begins_clause(self, at: int) -> bool:
        """Whether "and" is followed by a name or a verb, and not by "40 m" or "straight"."""
        names = self.words.names
        while at not in names.actors and self.words.tags(at).keys() & _BEFORE_NAMES:
            at += 1
        named = at in names.actors or at in names.pronouns or at in names.both
        return named or self.words.has([at], "verb", "auxiliary", "be", "negation")

    def _parts(self, at: int) -> bool:
        """Whether "and" begins a clause here; "begins with its turn" is one."""
        begins = self.words.word(at) == "with" and (
            self.words.tag(at - 1, "verb") == "begin"
            or "measure" in self.words.tags(at - 1)  # "the time to collision with the van"
            or self._has_something(at)
        )
        first = max(self.start, at - 5)
        shared = self.words.word(at) == "with" and any(self.words.word(i) in SHARES for i in range(first, at))
        return self._begins_clause(at + 1) and not self._between(at) and not begins and not shared

    def _has_something(self, at: int) -> bool:
        """Whether this is the "with" of "a car with a trailer"."""
        ahead = at + 1
        while "determiner" in self.words.tags(ahead):
            ahead += 1
        strange = "unknown" in self.words.tags(ahead) and ahead not in self.words.names.actors
        return strange and self.words.has([at - 1], "noun", "hero") and at - 1 in self.words.names.actors

    def _between(self, at: int) -> bool:
        """Whether this is the "and" of "between the ego and the line"."""
        return self.words.where(range(max(self.start, at - 4), at), "preposition", "between") is not None


def cut(words: Words) -> list[Clause]:
    """Return the clauses of a text, without their subjects."""
    joined = _joined(words, _Cutter(words).run())
    parts = [part for clause in joined for part in _parted(words, clause)]
    _turn_until_to_when(words, parts)
    _resume(words, parts)
    for part in parts:
        part.aside = _is_aside(words, part)
    return parts


def _resume(words: Words, clauses: list[Clause]) -> None:
    """Read "before the AV, which is turning left, begins its turn" as a bound that goes on after what is put in."""
    for number, clause in enumerate(clauses):
        rest = [at for at in clause.inside if not words.tags(at).keys() & {"determiner", "actor_adjective", "heading"}]
        bare = clause.link in BOUNDS and len(rest) == 1 and rest[0] in words.names.actors
        later = [each for each in clauses[number + 1 : number + 5] if each.sentence == clause.sentence]
        if not bare or not later or (later[0].link == "main" and _goes_on(words, later[0])):
            continue
        goes_on = next((each for each in later[1:] if each.link == "main" and _goes_on(words, each)), None)
        if goes_on is not None:
            goes_on.link, goes_on.subject, goes_on.named = clause.link, words.names.actors[rest[0]], True
            clause.link = "main"
            words.used.add(clause.start - 1)


def _goes_on(words: Words, clause: Clause) -> bool:
    """Whether a clause begins with its verb: "passes the conflict point"."""
    finite = "verb" in words.tags(clause.start) and words.tokens[clause.start].forms & {"s", "ed"}
    helps = words.has([clause.start], "be", "auxiliary") and not words.word(clause.start).endswith("ing")
    return bool(finite) or helps


def _turn_until_to_when(words: Words, clauses: list[Clause]) -> None:
    """Read "drives on until the ego is 12 m short of it; at that moment it brakes": the moment, told before."""
    for number, clause in enumerate(clauses):
        following = clauses[number + 1 : number + 6]
        then = next((each for each in following if each.link == "moment"), None)
        told = clause.link == "until" and words.has(clause.inside, "quantity")
        if told and then is not None and then.sentence - clause.sentence <= 1:
            clause.link = "when"


def _link(words: Words, at: int) -> str | None:
    """Return what a linking word links, or None where it is none, or is a preposition here."""
    link, word, following = words.tag(at, "link"), words.word(at), words.tags(at + 1)
    if word == "yet":
        return None
    if word == "when" and _is_over(words, at):
        return "before"
    if word in _DURING and _is_still_to_come(words, at):
        return "before"
    if word == "as" and (not at or words.has([at - 1], "end", "comma")) and _names_someone(words, at + 1):
        return "when"
    if word == "whose":
        return "that"
    if word in ("although", "though") and _names_someone(words, at + 1):
        return "and"  # "turns left although the ego is coming, westbound"
    if word == "from there" and "quantity" in words.tags(at - 1):
        return None  # "when it is 2 s from there"
    if word == "as" and words.tag(at, "frame") == "as" and _names_someone(words, at + 1) and _goes_along(words, at):
        return "and"  # "a van slows for its turn as the ego comes the other way"
    if word == "where" and "be" in words.tags(at - 1):
        return None  # "80 m before the intersection is where it begins"
    if word == "where" and (not at or words.has([at - 1], "end")):
        return None  # "Where it comes to rest, 8 m are left"
    if link not in _LINKS or (word == "the second" and "be" in following):
        return None  # "The second was the ego."
    if word == "following":
        return link if words.word(at + 1) in ("that", "this") else None
    if word in ("ahead of", "in front of"):
        first = words.sentence_at(at).start
        raced = words.verbs(range(max(first, at - 8), at)) & {"pass", "complete", "accelerate", "reach", "go"}
        return link if raced else None
    if link == "before" and "ing" in words.tokens[at + 1].forms and words.tag(at + 1, "verb") in ("go", "accelerate"):
        first = words.sentence_at(at).start
        if "wait" in words.verbs(range(first, at)):
            return "then"  # "waits for the ego to pass before starting off again"
    if (
        link == "before"
        and words.tags(at + 1).keys() & {"pronoun"}
        and words.tag(at + 2, "verb") in ("go", "accelerate")
    ):
        first = words.sentence_at(at).start
        if words.verbs(range(first, at)) & {"wait", "let"}:
            return "then"  # "lets the ego pass before it moves off again"
    if (word == "at the time" and words.has([at + 1], "comma")) or (word == "that" and words.word(at - 1) == "in"):
        return None  # "the van, 25 m from it at the time, brakes", "yields in that it brakes"
    if word == "after" and words.word(at + 1) in ("starting", "beginning") and words.has([at + 2], "quantity"):
        return "and"  # "passes eastbound after starting 88 m from the intersection"
    way = (
        words.tag(at + 1, "verb") in ("drive", "come", "go")
        and "ing" in words.tokens[min(at + 1, len(words.tokens) - 1)].forms
    )
    if word == "after" and way and words.has(range(at + 2, at + 5), "heading", "area"):
        return "and"  # "turns left into it after driving east"
    if word == "after" and "be" in words.tags(at - 1) and "determiner" in following:
        return None  # "both are after the same driveway"
    left = "left_over" in words.tags(at - 1) and words.has(range(at - 4, at), "quantity")
    if link == "until" and (left or words.has([at - 1], "measure", "quantity") or _measures_until(words, at)):
        return None  # "the time until the ego arrives at the conflict point is 4 s"
    if link in ("before", "after") and words.tag(at - 1, "quantity") == "time" and _is_margin(words, at):
        return link
    if link in BOUNDS:
        measured = words.tag(at - 1, "quantity") in ("length", "time") or words.tag(at - 1, "adverb") == "just"
        return None if measured or _names_place(words, at + 1) else link
    if word == "at that" and following.keys() & {"landmark", "mark_noun", "back_reference"}:
        return None
    second = following.get("preposition") == "of" or following.keys() & {"noun", "hero", "actor_adjective"}
    if word in ("the second", "second") and second:
        return None  # "the second of the two", "the second vehicle"
    if link == "that" and words.tag(at - 1, "link") == "when":
        return None  # "once that has dropped to 3 s"
    if link == "that":
        measures = following.get("preposition") in ("out", "of")  # "and that from the van to the line"
        points = "determiner" in words.tags(at) and words.has([at + 1], "mark_noun", "noun", *_PLACES)
        return None if measures or points else link
    return None if link == "when" and "label" in words.tags(at) and "colon" in following else link


def _measures_until(words: Words, at: int) -> bool:
    """Whether a measure goes on to a place: "the TTA of the ego until the stop line amounts to 3 s"."""
    first = words.sentence_at(at).start
    measure = words.where(range(at - 1, max(first, at - 6) - 1, -1), "measure")
    told = measure is not None and words.has(range(measure, at), "quantity", "verb", "be")
    amount = next((i for i in range(at - 1, max(first, at - 6), -1) if words.has([i], "quantity", "verb")), at)
    left = words.has([amount], "quantity") and words.tag(amount + 1, "preposition") == "for"
    place = at + 1
    while words.has([place], "determiner", "possessive", "area_adjective"):
        place += 1
    return (left or (measure is not None and not told)) and words.has([place], "landmark", "back_reference")


def _is_still_to_come(words: Words, at: int) -> bool:
    """Whether what follows has not happened: "while the ego has yet to begin its turn"."""
    for ahead in range(at + 1, len(words.tokens)):
        if words.has([ahead], "end", "comma", "quantity"):
            return False
        if words.word(ahead) == "yet" or words.word(ahead).endswith(" yet"):
            words.used |= set(range(at, ahead + 1))
            return True
    return False


def _is_over(words: Words, at: int) -> bool:
    """Whether something has happened by then: "so that it is already past the point when the ego begins to turn"."""
    first = next((i + 1 for i in range(at - 1, -1, -1) if words.has([i], "end", "comma")), 0)
    told = [words.word(i) for i in range(first, at)]
    beyond = words.has(range(first, at), "through") or words.where(range(first, at), "relation", "past") is not None
    passed = words.verbs(range(first, at)) & {"pass", "complete"} or beyond
    begins = words.verbs(range(at + 1, at + 7)) & {"begin", "turn", "pass", "reach"}
    return "already" in told and bool(passed) and bool(begins) and not words.has(range(first, at + 7), "quantity")


def _is_margin(words: Words, at: int) -> bool:
    """Whether a time is by how much a vehicle is first: "passes the conflict point 1 s before the ego does"."""
    first = next((i + 1 for i in range(at - 1, -1, -1) if words.has([i], "end", "comma")), 0)
    passes = words.verbs(range(first, at)) & {"pass", "complete"}
    return bool(passes) and _names_someone(words, at + 1)


def _goes_along(words: Words, at: int) -> bool:
    """Whether "as" is followed by where a vehicle goes, and no moment."""
    for ahead in range(at + 1, min(at + 8, len(words.tokens))):
        if words.has([ahead], "end", "comma", "link"):
            return False
        if words.has([ahead], "quantity", "landmark"):
            return False
        if words.has([ahead], "heading", "oncoming_way", "direction") or words.tag(ahead, "verb") == "lane_follow":
            return True
    return False


def _names_someone(words: Words, at: int) -> bool:
    """Whether a vehicle is named here and does something: "As the car under test reaches 32 m"."""
    while words.has([at], "determiner", "actor_adjective", "heading"):
        at += 1
    named = at in words.names.actors or at in words.names.pronouns
    return named and words.has([at + 1], "verb", "be", "auxiliary")


def _names_place(words: Words, at: int) -> bool:
    """Whether a place follows, and not a place that something happens to: "before the point is passed"."""
    while words.tags(at).keys() & {"determiner", "possessive", "area_adjective"}:
        at += 1
    return words.has([at], *_PLACES) and "be" not in words.tags(at + 1)


def _joined(words: Words, clauses: list[Clause]) -> list[Clause]:
    """Let "the ego and the van drive west" be one clause about both."""
    joined: list[Clause] = []
    for clause in clauses:
        before = joined[-1] if joined else None
        if before is not None and clause.link == "and" and before.end + 1 == clause.start:
            told = [at for at in before.inside if "actor_adjective" not in words.tags(at)]
            first = [words.names.actors[at] for at in before.inside if at in words.names.actors]
            second = words.named(clause.inside)
            bare = not words.has(told, "verb", "be", "quantity", "auxiliary")
            headed = words.has(told[1:], "heading", "direction") and words.has([before.end - 1], "heading", "direction")
            bare = bare and not headed  # "with the ego eastbound and a hero that comes out of the driveway"
            if bare and first and second is not None and first[-1] != second:
                joined[-1] = replace(clause, start=before.start, link=before.link, pair=True)
                continue
        joined.append(clause)
    return joined


def _parted(words: Words, clause: Clause) -> list[Clause]:
    """Cut "when the ego is 12 m from the stop line the hero brakes" before the second subject."""
    told = False
    for at in clause.inside:
        told |= "quantity" in words.tags(at)
        if clause.link == "when" and clause.start < at < clause.start + 4 and _begun(words, clause, at):
            return [replace(clause, end=at), *_parted(words, replace(clause, start=at, link="main"))]
        if at in words.names.actors and "ing" in words.tokens[at + 1].forms and (seen := _seen_from(words, at, clause)):
            return [replace(clause, end=seen), *_parted(words, replace(clause, start=seen, link="main"))]
        after_driveway = words.tag(at - 1, "area") == "driveway" and at > clause.start + 1 and not told
        if after_driveway and at in words.names.actors and words.has([at + 1], "be", "verb", "auxiliary"):
            # "turns into the driveway I'm coming out of"
            return [replace(clause, end=at), replace(clause, start=at, link="that")]
        if words.word(at) in ("so that", "so") and at > clause.start and _may(words, at + 1):
            return [replace(clause, end=at), replace(clause, start=at + 1, link="main")]
        if clause.link in BOUNDS and at > clause.start + 1 and _inverted(words, at):
            return [replace(clause, end=at), *_parted(words, replace(clause, start=at, link="then"))]
        if told and words.has([at], "be") and (cue := _cue_of(words, at)):
            return [replace(clause, end=at), *_parted(words, replace(clause, start=cue, link="main"))]
        acts = words.word(at) in ("he", "she", "it") and words.has([at + 1], "verb", "be", "auxiliary")
        if not told or not (acts or (at in words.names.actors and not is_object(words, at))):
            continue
        first = at
        while first > clause.start and words.has([first - 1], "determiner", "actor_adjective", "heading"):
            first -= 1
        if words.has([first - 1], *_AMOUNT_ENDS):
            rest = replace(clause, start=first, link="main")
            return [replace(clause, end=first), *_parted(words, rest)]
    return [clause]


def _may(words: Words, at: int) -> bool:
    """Whether this is "the ego can go first", after "so that"."""
    while words.has([at], "determiner", "actor_adjective", "heading") and at not in words.names.actors:
        at += 1
    return at in words.names.actors and words.word(at + 1) in ("can", "could", "may")


def _inverted(words: Words, at: int) -> bool:
    """Whether "does the van move" begins here: "not until it has passed the point does the van move"."""
    if words.word(at) not in ("does", "did", "do", "will", "shall", "can"):
        return False
    name = at + 1
    while words.has([name], "determiner", "actor_adjective", "heading") and name not in words.names.actors:
        name += 1
    return (name in words.names.actors or name in words.names.pronouns) and words.has([name + 1], "verb")


def _cue_of(words: Words, at: int) -> int | None:
    """Return where "the taxi's cue to brake" begins in "being 25 m from it is the taxi's cue to brake"."""
    name = at + 1
    while words.has([name], "determiner", "actor_adjective", "heading") and name not in words.names.actors:
        name += 1
    cue = name in words.names.actors and "genitive" in words.tags(name + 1)
    return at + 1 if cue and words.tag(name + 2, "label") == "when" else None


def _seen_from(words: Words, at: int, clause: Clause) -> int | None:
    """Return where "the ego driving west" begins in "the van sees the ego driving west"."""
    first = at
    while first > clause.start and words.has([first - 1], "determiner", "actor_adjective", "heading"):
        first -= 1
    return first if first > clause.start and words.word(first - 1) in SEES else None


def _begun(words: Words, clause: Clause, at: int) -> bool:
    """Whether "when the story starts" ends here: "when the story starts it is 100 m from it"."""
    named = words.named(range(clause.start, at)) is not None
    subject = at in words.names.pronouns or at in words.names.actors or "determiner" in words.tags(at)
    return words.tag(at - 1, "verb") == "begin" and subject and not named


def _is_aside(words: Words, clause: Clause) -> bool:
    """Whether a clause is about something else: "The courtesy did not last", "you might expect"."""
    at, names = clause.start, words.names
    told = [words.word(i) for i in clause.inside]
    begins = ("starts", "begins", "opens", "started", "began", "opened")
    if any(first in RUNS and second in begins for first, second in itertools.pairwise(told[:4])):
        return False  # "The video starts with our vehicle 7 s from the line"
    if clause.link == "that" and words.word(at - 1) in ("which", "who", "that"):
        return False  # "which therefore goes straight" has its subject
    if words.word(at) in ("i", "we") and words.word(at + 1) in ("have", "let", "had", "make", "made"):
        return words.named(clause.inside) is None  # "I have the ego begin 8 s away"
    by = words.where(clause.inside, "link", "by")
    if by is not None and words.named(range(by, min(by + 5, clause.end))) is not None:
        return False  # "Priority is not conceded by the van"
    if words.word(at) in ("you", "everyone") and at not in names.actors:
        return True
    while at < clause.end and words.has([at], "determiner", "actor_adjective", "area_adjective", "adverb"):
        if "hero" in words.tags(at):
            break
        at += 1
    if "unknown" not in words.tags(at) or words.word(at) in NEGATIVES or at in names.actors or at in names.pronouns:
        return False
    if words.tokens[clause.start].text.endswith("ly") and words.has([clause.start + 1], "verb"):
        return False  # "..., kindly stops"
    while at < clause.end and "unknown" in words.tags(at) and at not in names.actors:
        at += 1
    if at >= clause.end or at in names.actors:
        return False
    finite = "verb" in words.tags(at) and bool(words.tokens[at].forms & {"s", "ed"})
    return finite or words.has([at], "be", "auxiliary")
