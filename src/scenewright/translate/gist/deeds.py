"""Reads what the hero does, and the moments of the ego that it is held against.

What enters: words with clauses. What leaves: `Deed`s in their order, who does not turn, and the denials that were
understood. Which of them belong to the story is decided by `story`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.clauses import NEGATIVES
from scenewright.translate.gist.describing import TURNS, Describing
from scenewright.translate.gist.ego_moments import EgoMoments
from scenewright.translate.gist.words import Clause, Deed, Words

_DEEDS = {
    "brake": "brake",
    "stop": "stop",
    "accelerate": "accelerate",
    "pass": "pass",
    "reach": "pass",
    "beat": "pass",
    "cut_in_front": "pass",
    "complete": "complete",
    "yield": "yield",
    "not_yield": "not_yield",
}
# What a vehicle may as well be about to do, or do before anything happens.
_MOVES = {
    "go": "go",
    "drive": "go",
    "keep": "keep",
    "wait": "wait",
    "sit": "wait",
    "turn": "turn",
    "pull_out": "turn",
    "let": "let",
    "enter": "pass",
}
_BESIDE = frozenset(("determiner",))
_WAITS = frozenset(("yield", "wait", "stop", "brake", "let"))
_WISHES = ("wanting", "ready", "intent_noun")
# "Has to brake" tells what is done.
_NOUNS_AFTER = ("traffic", "reaction", "pedal", "test")
_OBLIGES = ("has to", "have to", "needs to", "need to", "had to")

_TO_THE_END = re.compile(r"\b(?:to|till|until|up to) the (?:very )?end\b(?! of the (?:turn|road|driveway))")


@dataclass(slots=True)
class DeedReader:
    """Collects deeds clause by clause.

    Attributes
    ----------
    straight
        Who "does not turn", and where that stands.
    """

    words: Words
    deeds: list[Deed] = field(default_factory=list)
    straight: list[tuple[int, int]] = field(default_factory=list)
    ego: EgoMoments = field(init=False)
    describing: Describing = field(init=False)

    def __post_init__(self) -> None:
        self.ego = EgoMoments(self.words, self.deeds)
        self.describing = Describing(self.words)

    def read(self) -> None:
        """Read every clause."""
        for clause in self.words.clauses:
            if self._follows_hero(clause) or self.ego.is_after_hero(clause):
                continue
            if self.ego.is_not_yet(clause) or self.ego.is_next(clause):
                self.words.used |= set(clause.inside)
                span = self.words.span(clause)
                place = self.ego.next_place(clause) or "turn_start"
                self.deeds.append(Deed("before", clause.start, clause, span, place, EGO_ID))
                continue
            if clause.aside:
                self.words.used |= set(clause.inside)
            elif not (
                (self.ego.is_bound(clause) or self.ego.is_allowed(clause))
                and self.ego.read(clause if self.ego.is_bound(clause) else replace(clause, link="until"))
            ):
                self.ego.check_told_when(clause)
                self._clause(clause)
        self._check_end()
        for deed in list(self.deeds):
            self._in_front(deed)

    def _check_end(self) -> None:
        """Refuse "It stands there to the end of the test. Then it drives on"."""
        own = [each for each in self.deeds if each.actor == HERO_ID]
        for index, deed in enumerate(own):
            told = self.words.span(deed.clause).excerpt(self.words.text)
            goes = any(each.kind in ("accelerate", "pass", "complete") for each in own[index + 1 :])
            if deed.kind in ("wait", "stop") and goes and _TO_THE_END.search(told):
                raise self.words.refuse("it stands to the end and yet goes on", self.words.span(deed.clause))

    def _clause(self, clause: Clause) -> None:
        if self._only_denies(clause) or self._calls(clause):
            return
        negation: int | None = None
        wanted = False
        for at in clause.inside:
            tags = self.words.tags(at)
            if tags.get("verb") == "pretend" and self.words.word(at + 1) == "to":
                return  # "seems to wait" is no wait
            if "negation" in tags or self.words.word(at) in NEGATIVES:
                negation = at
                given = {word for i in range(at + 1, min(at + 5, clause.end)) for word in self.words.word(i).split()}
                if clause.subject == HERO_ID and "priority" in given and given & {"give", "grant", "us"}:
                    self.words.used.add(at)
                    self._add("not_yield", at, clause)  # "does not give us priority"
                    return
                continue
            if (
                negation is not None
                and at > negation + 1
                and (at in self.words.names.actors or at in self.words.names.pronouns)
            ):
                following = self.words.tokens[min(at + 1, len(self.words.tokens) - 1)].forms
                negation = None if following & {"s", "ed"} else negation  # "instead of easing up he steps on it"
            wanted |= self._is_wish(at)
            told = self.words.word(at) in ("made to", "is made", "forced to", "told", "asked", "commanded", "ordered")
            wanted &= not told
            self._without_verb(at, clause, negation)
            if tags.get("verb") == "fail" and at + 1 in self.words.names.actors:
                self.words.used.add(at)  # "a refuse lorry"
                continue
            if tags.get("verb") == "fail":
                if negation is not None:
                    raise self.words.refuse("two negations are hard to read", self.words.span(clause))
                negation = at
                continue
            verb = tags.get("verb") or ("brake" if tags.get("event_noun") == "brake" else None)
            if verb is None and tags.get("event_noun") == "accelerate" and self._is_begun(at, clause):
                verb = "accelerate"
            if verb in ("pass", "brake") and self.words.word(at + 1) in _NOUNS_AFTER:
                continue  # "the cross traffic", "the brake reaction time"
            kept = self.words.word(at) in ("continued", "sustained", "maintained", "kept up")
            kept = kept or self.words.has(range(clause.start, at), "event_noun")  # "the braking continues until"
            until = self.words.tag(at + 1, "link") == "until" or self.words.word(at + 1) in ("until", "up to", "to")
            if verb == "go" and kept and (until or self.words.has([at - 1], "be")):
                continue  # "braking is continued until it is at rest"
            stop = [each for each in self.deeds[-1:] if each.kind == "stop"]
            if verb == "reach" and clause.link == "that" and stop and stop[0].clause.sentence == clause.sentence:
                continue  # "brakes to a complete stop, which it reaches just before the stop line"
            wholly = self.words.word(at) == "complete" and self.words.tag(at - 1, "verb") == "stop"
            if verb is None or "heading" in tags or wholly or self.words.word(at).startswith(("finds ", "found ")):
                continue  # "it stops complete", "finds itself 85 m before it"
            uses = self.words.word(at).startswith("us") and verb in ("go", "drive")
            if uses and not self.words.has(range(at + 1, clause.end), "area"):
                continue  # "using a deceleration of 3 m/s^2"
            if negation is not None and verb == "let" and self.words.word(at + 1) in ("up", "go", "off"):
                self.words.used.add(negation)  # "brakes and does not let up until it stands"
                return
            if negation is not None:
                if self._denied(verb, at, clause):
                    self.words.used.add(negation)
                    negation = None
            elif verb == "let" and self.words.word(at) == "given":
                continue  # "Given a time to arrival of 2 s for the ego"
            elif verb == "let" and at == clause.start and self._is_told_to(clause):
                continue  # "make the van stop, and only then let it drive on"
            elif (verb == "let" and clause.subject == HERO_ID and self._lets(at, clause)) or (
                verb == "wait" and self._waits_for(at + (self.words.word(at + 1) == "there"), clause)
            ):
                return
            elif verb == "leave" and self.words.has(range(at + 1, at + 3), "landmark"):
                self._add("pass", at, clause)  # "leaving the conflict point behind"
                return
            elif verb in _DEEDS and not self.describing.only_describes(verb, at, clause):
                stopped = verb == "complete" and self.words.has(range(at - 2, at + 4), "stop_noun")
                future = {"going", "is going", "are going"} & {self.words.word(i) for i in range(at - 3, at)}
                finite = bool(self.words.tokens[at].forms & {"s", "ed"}) and "base" not in self.words.tokens[at].forms
                if stopped or (wanted and not future and not finite and verb in ("brake", "stop", "accelerate")):
                    raise self.words.refuse("an intention like this is not read here", self.words.span(clause))
                self._add(_DEEDS[verb], at, clause)
            elif verb in _MOVES and not wanted and not self.describing.only_describes(verb, at, clause):
                self._add(_MOVES[verb], at, clause)

    def _is_begun(self, at: int, clause: Clause) -> bool:
        """Whether a noun is said to begin: "acceleration of the van is initiated"."""
        ahead = range(at + 1, min(at + 6, clause.end))
        begun = self.words.where(ahead, "onset_verb")
        return begun is not None and self.words.has([begun - 1], "be", "auxiliary")

    def _is_wish(self, at: int) -> bool:
        """Whether this is "wants", "is ready to"; "has to" and "is asked to" tell what is done."""
        tags = self.words.tags(at)
        asked = "demanded" in tags or self.words.word(at) in _OBLIGES
        going = self.words.word(at).endswith("going") and self.words.word(at + 1) != "to"
        return not asked and not going and (tags.get("verb") in ("want", "need") or self.words.has([at], *_WISHES))

    def _without_verb(self, at: int, clause: Clause, negation: int | None) -> None:
        """Read "to a full stop", "speed zero", "over the conflict point", "through it"."""
        tags = self.words.tags(at)
        if "stop_noun" in tags and "verb" not in tags and negation is None:
            self._add("wait" if self._is_placed_standing(at, clause) else "stop", at, clause)
        if tags.get("adverb") == "steady" and clause.subject == HERO_ID and negation is None:
            self._add("keep", at, clause)  # "passes it without any acceleration"
        there = tags.get("preposition") == "at" and "be" in self.words.tags(at - 1) and clause.subject == HERO_ID
        goal = self.words.where(range(at + 1, min(at + 3, clause.end)), "landmark", "conflict_point")
        if there and goal is not None and goal not in self.words.used:
            self._add("pass", at, clause)
        over = self.words.word(at) in ("over", "across") or tags.get("relation") == "past"
        across = over and "quantity" not in self.words.tags(at - 1)
        if (across or "through" in tags) and "verb" not in tags and clause.subject == HERO_ID:
            mark = self.words.where(range(at + 1, clause.end), "landmark", "conflict_point")
            back = self.words.where(range(at + 1, clause.end), "back_reference") or self.words.where(
                range(at + 1, clause.end), "mark_noun"
            )
            if mark is not None or back is not None:
                self._add("pass", at, clause)
        makes = self.words.tag(at - 2, "verb") == "make" and "possessive" in self.words.tags(at - 1)
        stopped = any(deed.kind in ("stop", "wait") and deed.actor == HERO_ID for deed in self.deeds)
        whole = makes and stopped and clause.link in ("then", "and") and clause.subject == HERO_ID
        if tags.get("event_noun") == "turn" and (whole or self.describing.is_done(at)):
            self._add("complete", at, clause)  # "then it makes its turn"
        back = at - 1
        while self.words.has([back], "determiner", "possessive"):
            back -= 1
        if "landmark" in tags and (
            self.words.tag(at - 1, "verb") == "approach" or self.words.word(back) in ("towards", "toward")
        ):
            self.words.used.add(at)  # "is rolling towards the stop line at 5 m/s"

    def _calls(self, clause: Clause) -> bool:
        """Whether a sentence is nothing but "Go." or "Over.", which calls to the one who runs the test."""
        sentence = self.words.sentence_at(clause.start)
        return len(sentence) == 1 and self.words.verbs(sentence) <= {"go", "begin"}

    def _only_denies(self, clause: Clause) -> bool:
        """Read "The van turns left, the ego won't": who does not do what the other does goes straight."""
        last, index = clause.end - 1, self.words.clauses.index(clause)
        before = self.words.clauses[index - 1] if index else clause
        alone = "negation" in self.words.tags(last) and not self.words.has(clause.inside, "verb", "be", "quantity")
        turn = self.words.where(before.inside, "direction", "left", "right")
        other = None not in (clause.subject, before.subject) and clause.subject != before.subject
        if not (
            alone and other and turn is not None and before.sentence == clause.sentence and clause.subject is not None
        ):
            return False
        self.words.used.add(last)
        self.straight.append((clause.subject, last))
        return True

    def _add(self, kind: str, at: int, clause: Clause) -> None:
        actor = clause.subject if clause.subject is not None else HERO_ID
        if kind in ("yield", "not_yield"):
            name = next((i for i in range(at + 1, min(at + 5, clause.end)) if i in self.words.names.actors), None)
            acts = name is not None and self._acts_on(name)
            of = self.words.word(at + 1) in ("of", "by")  # "Yielding of the van was modelled"
            if name is not None and self.words.names.actors[name] == actor and not acts and not of:
                raise self.words.refuse("a vehicle does not yield to itself", self.words.span(clause))
        if at + 1 < clause.end and self.words.tag(at + 1, "preposition") == "of" and kind != "not_yield":
            named = self.words.named(range(at + 2, min(at + 5, clause.end)))  # "the braking of the ego"
            actor = named if named is not None else actor
        self.words.used.add(at)
        first = self.words.where(clause.inside, "adverb", "initially") is not None or "start" in clause.labels
        if kind == "go" and first and self.words.has(clause.inside, "quantity"):
            return  # "The hero travels at 13 m/s at the beginning" is told after all
        if kind == "stop" and self._stands_already(at, clause):
            kind = "wait"
        span = self.words.tokens[at].span
        passed = self.describing.landmark(at, clause) if kind == "pass" else None
        other = self.words.names.actors.get(self.words.skip(at + 1, _BESIDE))
        overtakes = other == EGO_ID and "genitive" not in self.words.tags(self.words.skip(at + 1, _BESIDE) + 1)
        if kind == "pass" and overtakes and self.words.word(at) in ("cuts across", "cut across", "cutting across"):
            return  # across its path: that is how the ways lie
        if kind == "pass" and overtakes and actor == HERO_ID and self.words.tag(at, "verb") == "pass":
            raise self.words.refuse("overtaking cannot be orchestrated", self.words.span(clause))
        self.deeds.append(Deed(kind, at, clause, span, passed, actor))

    def _is_placed_standing(self, at: int, clause: Clause) -> bool:
        """Whether a vehicle is put somewhere standing: "is initialised at a standstill at the stop line"."""
        words = self.words
        asked = any(c.link == "when" and c.start < at and words.has(c.inside, "quantity") for c in words.clauses)
        at_rest = "at" in (words.word(at - 1), words.word(at - 2))
        comes = words.verbs(range(clause.start, at)) & {"brake", "come", "stop", "accelerate", "decelerate"}
        line = words.where(range(at + 1, min(at + 5, clause.end)), "landmark", "stop_line")
        return (
            at_rest
            and not asked
            and not comes
            and line is not None
            and words.has(range(clause.start, at), "be", "verb")
        )

    def _stands_already(self, at: int, clause: Clause) -> bool:
        """Whether this tells how a vehicle is before anything happens: "there is a van stopped at the stop line"."""
        words = self.words
        asked = any(c.link == "when" and c.start < at and words.has(c.inside, "quantity") for c in words.clauses)
        near = range(max(0, at - 4), at)
        state = words.has([at - 1], "be", "comma") or (at - 1 in words.names.actors and words.has(near, "be"))
        place = words.where(range(at + 1, min(at + 5, clause.end)), "landmark", "stop_line")
        return words.word(at) == "stopped" and state and not asked and place is not None

    def _acts_on(self, name: int) -> bool:
        """Whether a name is followed by what it does: "Instead of giving way the van then accelerates"."""
        at = name + 1
        while self.words.has([at], "adverb") or self.words.word(at) in ("then", "instead"):
            at += 1
        return "s" in self.words.tokens[min(at, len(self.words.tokens) - 1)].forms

    # -- denials ------------------------------------------------------------------------------------------------------
    def _denied(self, verb: str, at: int, clause: Clause) -> bool:
        """Read "does not turn", "does not yield", "without speeding up", "does not set off until"."""
        turning = verb in TURNS and "ing" in self.words.tokens[at].forms and self.words.has([at + 1], "quantity")
        if verb == "attitude" or (self.words.has(range(at, clause.end), "quantity") and not turning):
            return False
        actors = [EGO_ID, HERO_ID] if clause.both else [clause.subject]
        if verb in TURNS and None not in actors:
            self.straight += [(actor, at) for actor in actors if actor is not None]
            return True
        area = self.words.where(range(min(at + 4, clause.end) - 1, -1, -1), "area")
        if verb == "leave" and None not in actors and area is not None and self.words.tags(area)["area"] == "road":
            self.straight += [(actor, at) for actor in actors if actor is not None]
            return True  # "is on the road, which it does not leave"
        if clause.subject == EGO_ID:
            return False
        there = "there" in " ".join(self.words.word(i) for i in range(at, clause.end)).split()
        if verb in ("wait", "sit") and there and any(each.kind == "stop" for each in self.deeds[-1:]):
            return True  # "it stops, but it does not stay there"
        stopped = any(each.kind in ("stop", "wait") and each.actor == HERO_ID for each in self.deeds)
        later = self.words.verbs(range(at + 1, len(self.words.tokens))) & {"go", "accelerate", "drive", "pull_out"}
        timed = any(each.kind == "wait" and self.words.has(each.clause.inside, "quantity") for each in self.deeds)
        if verb == "wait" and timed and "stand" in self.words.word(at):
            raise self.words.refuse("it was said to stand for some time", self.words.span(clause))
        if verb == "wait" and stopped and ("ing" in self.words.tokens[at].forms or later):
            return True  # "Without waiting for the ego it then drives on"
        if verb in _WAITS:
            self._add("not_yield" if verb in ("yield", "let") else "not_stop", at, clause)
            return True
        if verb in ("drive", "go") and self.words.word(at - 1) == "no longer":
            self._add("stop", at, clause)  # "until it no longer moves"
            return True
        if verb in ("drive", "go"):
            return self._stays(at, clause)
        purpose = self.words.where(range(at, clause.end), "link", "to")
        if purpose is not None and self.words.verbs(range(purpose, clause.end)) & {"pass", "complete"}:
            return False  # "does not begin to accelerate to complete the turn": what is denied is not clear
        if verb == "accelerate" and not any(deed.kind in ("brake", "stop", "wait") for deed in self.deeds):
            self._add("keep", at, clause)
            return True
        return False

    def _stays(self, at: int, clause: Clause) -> bool:
        """Whether the hero "does not set off until ...", or "sat there, not moving"."""
        later = [each for each in self.words.sentence(clause) if each.start > clause.start]
        if any(each.link == "until" or (each.link == "before" and self.ego.is_perfect(each)) for each in later):
            self._add("wait", at, clause)
            return True
        stopped = any(deed.kind == "stop" and deed.actor == HERO_ID for deed in self.deeds)
        if stopped and not self.words.has(clause.inside, "direction", "heading", "area", "landmark"):
            self._add("wait", at, clause)  # "it does not drive on afterwards"
            return True
        only_waits = not any(deed.kind in ("brake", "stop") for deed in self.deeds)
        still = "ing" in self.words.tokens[at].forms or only_waits
        return still and any(deed.kind in ("wait", "stop") for deed in self.deeds[-2:])

    # -- moments of the ego -------------------------------------------------------------------------------------------

    def _is_told_to(self, clause: Clause) -> bool:
        """Whether the text tells somebody to stage it: "Let the AV ...", "Make the van ..."."""
        starts = [
            self.words.word(each.start)
            for each in self.words.clauses
            if each.start <= clause.start and not self.words.has([each.start], "determiner")
        ]
        firsts = [self.words.word(each.start) for each in self.words.clauses if each.link in ("main", "and", "then")]
        return clause.link in ("main", "and", "then") and bool(
            set(starts) & {"have", "make", "put", "send", "run", "keep"} or firsts[0] == "let"
        )

    def _follows_hero(self, clause: Clause) -> bool:
        """Read "the ego begins to turn only after the van has passed the point": the van passes before that."""
        following = next((each for each in self.words.clauses if each.start > clause.start), None)
        if following is None or not self.ego.is_after_hero(following) or clause.end > following.start:
            return False
        verbs = self.words.verbs(clause.inside)
        self.words.used |= set(range(clause.start, following.start))
        span = self.words.span(clause)
        done = self._verb_of(following)
        if self.words.tag(done, "verb") != "do_so":
            self._add("complete" if self.words.tag(done, "verb") == "complete" else "pass", done, following)
        self.words.used |= set(following.inside)
        self.deeds.append(Deed("before", clause.start, clause, span, self.ego.place(clause, verbs), EGO_ID))
        return True

    def _verb_of(self, clause: Clause) -> int:
        done = [at for at in clause.inside if "verb" in self.words.tags(at) and "event_noun" not in self.words.tags(at)]
        return done[0]

    def _in_front(self, deed: Deed) -> None:
        """Read "crosses in front of the ego" and "beats the ego to the conflict point" as passing before the ego."""
        clause, words = deed.clause, self.words
        if deed.kind not in ("pass", "accelerate") or deed.actor != HERO_ID:
            return
        for at in clause.inside:
            beside = words.tag(at, "relation") == "ahead" and at not in words.used
            left = words.tag(deed.at, "verb") == "leave"
            if (
                not left
                and words.tag(at, "relation") == "behind"
                and "quantity" not in words.tags(at - 1)
                and deed.kind == "pass"
            ):
                raise words.refuse("a place in a queue is no order of passing", words.span(clause))
            beats = words.tag(at, "verb") in ("beat", "cut_in_front") or beside
            ego = any(words.names.actors.get(i) == EGO_ID for i in range(at + 1, min(at + 4, clause.end)))
            if beats and ego and "quantity" not in words.tags(at - 1):
                words.used.add(at)
                self.deeds.append(Deed("before", at, clause, words.tokens[at].span, "same", EGO_ID))
                return

    def _lets(self, at: int, clause: Clause) -> bool:
        """Read "lets the ego complete its turn" as what the hero waits for."""
        rest, names = range(at + 1, clause.end), self.words.names
        if not (any(names.actors.get(each) == EGO_ID for each in rest) or at + 1 in names.pronouns):
            return False
        way = {word for i in rest for word in self.words.word(i).split()} & {"priority", "precedence", "right-of-way"}
        apart = any([self.words.word(i + step) for step in range(3)] == ["right", "of", "way"] for i in rest)
        if way or apart or any(self.words.word(i) == "right of way" for i in rest):
            self._add("yield", at, clause)  # "gives the ego the right of way by braking"
            return False
        let = replace(clause, start=at + 1, link="let", subject=EGO_ID, named=True)
        if self.words.has(rest, "landmark", "back_reference", "event_noun") or self.words.verbs(rest) & {
            "turn",
            "pull_out",
        }:
            return self.ego.read(let)
        self.words.used |= set(rest)  # "lets it pass", "lets the ego go first"
        self.deeds.append(Deed("let_reach", at, let, self.words.tokens[at].span, None, EGO_ID))
        return True

    def _waits_for(self, at: int, clause: Clause) -> bool:
        """Read "waits for the ego to complete its turn"."""
        if self.words.word(at + 1) != "for":
            return False
        rest = range(at + 2, clause.end)
        named = any(self.words.names.actors.get(each) == EGO_ID for each in rest[:3])
        done = self.words.verbs(rest) & {"complete", "pass"}
        if clause.subject != HERO_ID or not named or not done:
            return False
        self._add("wait", at, clause)
        return self.ego.read(replace(clause, start=at + 2, link="until", subject=EGO_ID, named=True))
