"""Reads what the hero does, and the moments of the ego that it is held against.

What enters: tokens, names, clauses. What leaves: `Deed`s in their order, and the denials that were understood.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.clauses import NEGATIVES, Clause
from scenewright.translate.gist.names import Names
from scenewright.translate.tokens import Token

STRONG = {"brake": "brake", "stop": "stop", "accelerate": "accelerate", "pass": "pass", "complete": "complete", "reach": "pass"}
WEAK = {"go": "go", "keep": "keep", "wait": "wait", "drive": "go", "turn": "turn", "pull_out": "turn", "sit": "wait", "let": "let", "enter": "pass"}
YIELDS = {"yield": "yield", "not_yield": "not_yield"}
_TURN_WORDS = frozenset(("turn", "pull_out"))


@dataclass(slots=True)
class Deed:
    """One thing that the hero does, or a moment of the ego: ``brake``, ``stop``, ``wait``, ``accelerate``, ``go``, ``keep``,
    ``pass``, ``complete``, ``turn``, ``yield``, ``not_yield``, ``before``, ``after``."""

    kind: str
    at: int
    clause: Clause
    span: Span
    landmark: str | None = None
    actor: int = HERO_ID


@dataclass(slots=True)
class DeedReader:
    """Collects deeds clause by clause."""

    tokens: list[Token]
    names: Names
    clauses: list[Clause]
    deeds: list[Deed] = field(default_factory=list)
    straight: list[tuple[int | None, Span]] = field(default_factory=list)  # "does not turn"
    denied: set[int] = field(default_factory=set)  # negations that were understood
    used: set[int] = field(default_factory=set)

    def read(self) -> None:
        """Read every clause."""
        for clause in self.clauses:
            if clause.aside:
                self.denied |= {at for at in range(clause.start, clause.end) if "negation" in self.tokens[at].tags}
                continue
            bound = clause.link in ("before", "after", "until") or self._releases(clause)
            if bound and self._ego_moment(clause):
                continue
            self._clause(clause)

    def _releases(self, clause: Clause) -> bool:
        """Whether "once the ego has completed its turn" is a moment of the ego that the hero waits for."""
        inside = self.tokens[clause.start : clause.end]
        perfect = any(each.tags.get("auxiliary") == "have" for each in inside)
        told = any("quantity" in each.tags for each in inside)
        done = any(each.tags.get("verb") in ("complete", "pass") for each in inside)
        return clause.link == "when" and clause.subject == EGO_ID and perfect and done and not told

    def _clause(self, clause: Clause) -> None:
        negated: int | None = None
        wanted = False
        for at in range(clause.start, clause.end):
            token = self.tokens[at]
            tags = token.tags
            if "negation" in tags or token.text.lower() in ("no", "shall not", "must not", "should not", "cannot") or token.text.lower() in NEGATIVES:
                negated = at
                continue
            verb = tags.get("verb")
            if verb in ("want", "need") or "wanting" in tags or "ready" in tags or "intent_noun" in tags:
                wanted = True
            if "stop_noun" in tags and "verb" not in tags and negated is None:
                self._add("stop", at, clause)
            if verb is None and tags.get("event_noun") == "brake":
                verb = "brake"
            over = tags.get("bound") and token.text.lower() == "over" or tags.get("relation") == "past"
            if over and verb is None and clause.subject == HERO_ID and at and "quantity" not in self.tokens[at - 1].tags:
                if self._landmark(at, clause) == "conflict_point":
                    self._add("pass", at, clause)
            if "through" in tags and verb is None and self._landmark(at, clause) and clause.subject == HERO_ID:
                self._add("pass", at, clause)
            if "landmark" in tags and at and self.tokens[at - 1].tags.get("verb") == "approach":
                self.used.add(at)
            if verb is None or "heading" in tags:
                continue
            if negated is not None:
                if self._denied(verb, at, clause):
                    self.denied.add(negated)
                    negated = None
                continue
            if verb in _TURN_WORDS and wanted:
                continue
            if verb == "let" and clause.subject == HERO_ID and self._lets(at, clause):
                return
            if at + 1 in self.names.actors and ("actor_adjective" in tags or "ing" in token.forms):
                continue  # "a slow car", "the entering driver"
            if verb == "go" and at + 2 < clause.end and self.tokens[at + 1].text.lower() == "to" and "verb" in self.tokens[at + 2].tags:
                continue
            if wanted and verb in WEAK:
                continue
            if verb == "come":
                continue
            if verb in _TURN_WORDS and self._is_noun(at):
                continue
            if verb in ("go", "drive", "keep") and self._tells_way(at, clause):
                continue
            if verb == "reach" and at and self.tokens[at - 1].text.lower() in ("to", "from", "before") and any(
                "quantity" in self.tokens[b].tags for b in range(max(clause.start, at - 4), at)
            ):
                continue  # "needs 3 s to reach the stop line"
            if verb == "reach" and (clause.subject == EGO_ID or self._landmark(at, clause) is None):
                continue
            if verb in STRONG:
                self._add(STRONG[verb], at, clause)
            elif verb in WEAK:
                self._add(WEAK[verb], at, clause)
            elif verb in YIELDS:
                self._add(YIELDS[verb], at, clause)

    def _is_noun(self, at: int) -> bool:
        """Whether this is "the turn", of which another verb tells more: "completes its turn"."""
        before = self.tokens[at - 1].tags if at else {}
        if not before.keys() & {"determiner", "possessive", "direction", "genitive"} or "verb" in before:
            return False
        return not any(self.tokens[b].tags.get("verb") == "begin" for b in range(max(0, at - 4), at))

    def _tells_way(self, at: int, clause: Clause) -> bool:
        """Whether "goes" tells a way and no deed: "goes west", "keeps straight on"."""
        for ahead in range(at + 1, min(at + 5, clause.end)):
            tags = self.tokens[ahead].tags
            if tags.keys() & {"heading", "direction"} or tags.get("area") in ("road", "driveway"):
                return True
            if "quantity" in tags or "landmark" in tags:
                return False
        return False

    def _add(self, kind: str, at: int, clause: Clause) -> None:
        self.used.add(at)
        actor = clause.subject if clause.subject is not None else HERO_ID
        if at + 1 < clause.end and self.tokens[at + 1].tags.get("preposition") == "of":
            named = next((each for each in range(at + 2, min(at + 5, clause.end)) if each in self.names.actors), None)
            actor = self.names.actors[named] if named is not None else actor
        self.deeds.append(Deed(kind, at, clause, self.tokens[at].span, self._landmark(at, clause), actor))

    def _landmark(self, at: int, clause: Clause) -> str | None:
        for ahead in range(at + 1, clause.end):
            tags = self.tokens[ahead].tags
            if "landmark" in tags:
                self.used.add(ahead)
                return tags["landmark"]
            if "back_reference" in tags or "mark_noun" in tags:
                for back in range(at, -1, -1):
                    if "landmark" in self.tokens[back].tags:
                        return self.tokens[back].tags["landmark"]
            if "quantity" in tags:
                return None
        if any("be" in self.tokens[back].tags for back in range(clause.start, at)):
            for back in range(clause.start, at):
                if "landmark" in self.tokens[back].tags:
                    self.used.add(back)
                    return self.tokens[back].tags["landmark"]
        return None

    def _denied(self, verb: str, at: int, clause: Clause) -> bool:
        """Read "does not turn", "does not yield", "without speeding up", "does not set off until"."""
        span = self.tokens[at].span
        if verb == "attitude" or any("quantity" in self.tokens[each].tags for each in range(at, clause.end)):
            return False
        if verb in _TURN_WORDS and (clause.subject is not None or clause.both):
            self.straight += [(actor, span) for actor in ((EGO_ID, HERO_ID) if clause.both else (clause.subject,))]
            return True
        if clause.subject == EGO_ID:
            return False
        if verb in ("yield", "wait", "stop", "brake", "let"):
            self._add("not_yield", at, clause)
            return True
        if verb in ("drive", "go") and any(
            c.link in ("until", "before") and c.sentence == clause.sentence and c.start > clause.start and self._perfect(c)
            for c in self.clauses
        ):
            self._add("wait", at, clause)
            return True  # "does not set off until"
        if verb in ("drive", "go") and any(deed.kind in ("wait", "stop") for deed in self.deeds[-2:]):
            return True  # "sat there, not moving"
        if verb == "accelerate":
            self._add("keep", at, clause)
            return True
        return False

    def _lets(self, at: int, clause: Clause) -> bool:
        """Read "lets the ego complete its turn" as what the hero waits for."""
        if not any(self.names.actors.get(each) == EGO_ID for each in range(at + 1, clause.end)):
            return False
        rest = replace(clause, start=at + 1, link="let", subject=EGO_ID, named=True)
        verbs = [self.tokens[each].tags.get("verb") for each in range(at + 1, clause.end)]
        if not set(verbs) & {"complete", "pass", "turn", "pull_out"}:
            self._add("yield", at, clause)
            return True
        return self._ego_moment(rest)

    def _perfect(self, clause: Clause) -> bool:
        return clause.link == "until" or any(
            self.tokens[at].tags.get("auxiliary") == "have" for at in range(clause.start, clause.end)
        )

    def _ego_moment(self, clause: Clause) -> bool:
        """Read "before the ego begins to turn", "until it has passed the conflict point", "before us"."""
        hero_does = [at for at in range(clause.start, clause.end) if self.tokens[at].tags.get("verb") in ("brake", "stop", "accelerate", "wait")]
        named = clause.named and clause.subject == EGO_ID
        if not named and (hero_does or clause.subject != EGO_ID):
            return False
        verbs = [self.tokens[at].tags.get("verb") for at in range(clause.start, clause.end)]
        nouns = [self.tokens[at].tags.get("event_noun") for at in range(clause.start, clause.end)]
        marks = [self.tokens[at].tags["landmark"] for at in range(clause.start, clause.end) if "landmark" in self.tokens[at].tags]
        last = any("back_reference" in self.tokens[at].tags or "mark_noun" in self.tokens[at].tags for at in range(clause.start, clause.end))
        if "complete" in verbs:
            landmark = "turn_end"
        elif set(verbs) & {"pass", "reach", "enter"} or (marks and "turn" not in verbs):
            landmark = marks[0] if marks else "conflict_point"
        elif set(verbs) & _TURN_WORDS or "turn" in nouns or "begin" in verbs:
            perfect = any("auxiliary" in self.tokens[at].tags and self.tokens[at].tags["auxiliary"] == "have" for at in range(clause.start, clause.end))
            landmark = "turn_end" if perfect and "begin" not in verbs else "turn_start"
        else:
            landmark = "same" if not last else "conflict_point"
        if landmark in ("intersection", "junction_start") and not marks:
            landmark = "conflict_point"
        kind = {"before": "before", "let": "let_reach"}.get(clause.link, "after")
        self.used |= set(range(clause.start - 1, clause.end))
        self.deeds.append(Deed(kind, clause.start, clause, clause.span(self.tokens), landmark, EGO_ID))
        return True
