"""Puts the facts of a free text together to one scenario, or says which of them does not fit.

What enters: tokens. What leaves: `Facts`, as the strict reader makes them, and the words that were set aside. It accepts a
text only where every amount has its place, every way and deed fits, and no denial, bound or order is left over.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.roads import RoadMap
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, Event, Place
from scenewright.translate.facts import Condition, Facts, Order, Phase
from scenewright.translate.gist.amounts import AmountReader, Measured
from scenewright.translate.gist.clauses import Clause, cut
from scenewright.translate.gist.deeds import Deed, DeedReader
from scenewright.translate.gist.names import Names, find_names
from scenewright.translate.gist.ways import Way, WayReader, _Clash
from scenewright.translate.tokens import Token

_DANGERS = frozenset(
    "exceed exceeds exceeded exceeding higher lower maximum minimum max min limit limited cap capped".split()
)
_EDGE_OF_TURN = re.compile(r"\b(?:start|beginning|end) of (?:its|the|his|her)\s+(?:\w+\s+)?turn\b", re.IGNORECASE)
_COUNTED = re.compile(r"(?:[A-Za-z]-|#|\[|\b(?:run|test|no\.?|case|phase|step|item|day|version|v)\s?)$", re.IGNORECASE)
_STANDS = re.compile(r"\b(?:stand|stood|stationary|stopped|standstill|still|rest|idl)", re.IGNORECASE)
_LIMITS = ("within", "less than", "closer than", "nearer than", "under", "below", "no more than")
_DEEDS = frozenset(
    ("brake", "stop", "accelerate", "pass", "complete", "yield", "not_yield", "turn", "pull_out", "wait", "reach", "enter")
)
_SLOWS = ("brake", "stop")
_GOES = ("accelerate", "go", "pass", "complete", "keep", "turn")


@dataclass(slots=True)
class GistReader:
    """Reads one text."""

    tokens: list[Token]
    text: str
    name: str
    road_map: RoadMap
    facts: Facts = field(default_factory=Facts)
    events: list[Event] = field(default_factory=list)
    names: Names = field(default_factory=Names)
    clauses: list[Clause] = field(default_factory=list)
    measured: list[Measured] = field(default_factory=list)
    deeds: list[Deed] = field(default_factory=list)
    titles: list[Way] = field(default_factory=list)
    moments: dict[int, str] = field(default_factory=dict)  # by index of the amount

    def read(self) -> Facts:
        """Return the facts of the text.

        Raises
        ------
        TranslationError
            Where something is left over, or what was found makes no whole scenario.
        """
        self._refuse_dangers()
        self.names = find_names(self.tokens)
        if self.names.several:
            raise self._refuse("more than one other vehicle is spoken of", Span(0, len(self.text)))
        self.clauses = cut(self.tokens, self.names)
        amounts = AmountReader(self.tokens, self.names, self.clauses)
        self.measured = amounts.read()
        for span in amounts.unplaced:
            raise self._refuse("it is not clear up to where this is measured", span)
        for clause in self.clauses:
            inside = self.tokens[clause.start : clause.end]
            if clause.aside and any(t.tags.get("verb") in _DEEDS or t.quantity is not None for t in inside):
                raise self._refuse("it is not clear who does this", clause.span(self.tokens))
        deeds = DeedReader(self.tokens, self.names, self.clauses)
        deeds.read()
        self.deeds = deeds.deeds
        self._ways(deeds)
        self._negations(deeds)
        self._moments()
        self._bounds()
        self._states()
        self._story()
        self._left_over(amounts.used | deeds.used | deeds.denied)
        self.facts.mentioned |= {EGO_ID, HERO_ID}
        return self.facts

    # -- what must not be there ---------------------------------------------------------------------------------------
    def _refuse_dangers(self) -> None:
        for token in self.tokens:
            if token.text.lower() in _DANGERS:
                raise self._refuse(f"'{token.text}' was not understood", token.span)
        if found := _EDGE_OF_TURN.search(self.text):
            raise self._refuse("a place within a turn is not read here", Span(*found.span()))
        for at, token in enumerate(self.tokens):
            if "unsupported" in token.tags and not self._harmless(at):
                raise self._refuse(f"'{token.text}' cannot be orchestrated", token.span)
            if "bare_number" in token.tags and not self._numbering(at):
                raise self._refuse(f"'{token.text}' has no unit", token.span)

    def _harmless(self, at: int) -> bool:
        """Whether "crashes" or "traffic" only speaks of the world: "a frequent precursor of crashes"."""
        token = self.tokens[at]
        if token.slips:
            return True  # "worries" is no slip of "lorries"
        before = self.tokens[at - 1].tags if at else {}
        if token.text.lower() == "traffic":
            return bool(before.keys() & {"heading", "direction", "actor_adjective"})
        after = self.tokens[at + 1].tags if at + 1 < len(self.tokens) else {}
        if (not at or "end" in before) and after.keys() & {"colon", "end"}:
            return True  # "Actors:"
        if token.tags["unsupported"] in ("collisions", "alternatives and chance"):
            sentence = self._sentence_of(at)
            if sentence[0].text.lower() == "you" or (token.text.lower() == "either" and after.keys() & {"end", "comma"}):
                return True
            quiet = not any("quantity" in each.tags or "ego" in each.tags for each in sentence)
            return quiet and token.tags["unsupported"] == "collisions"
        if token.tags["unsupported"] == "more than one other actor":
            return bool(before.get("bare_number") in ("two", "Two") and "noun" not in before)
        return False

    def _sentence_of(self, at: int) -> list[Token]:
        first = at
        while first > 0 and "end" not in self.tokens[first - 1].tags:
            first -= 1
        last = at
        while last < len(self.tokens) and "end" not in self.tokens[last].tags:
            last += 1
        return self.tokens[first:last]

    def _numbering(self, at: int) -> bool:
        """Whether a number only counts sentences ("REQ-2:", "4.1 The POV ..."), or is "one" of the vehicles."""
        token = self.tokens[at]
        if token.text.isalpha():
            following = self.tokens[at + 1].tags if at + 1 < len(self.tokens) else {}
            return token.text.lower() in ("one", "two") and "unsupported" not in following or token.text.lower() == "two"
        if _COUNTED.search(self.text[: token.span.start]):
            return True
        back = at - 1
        while back >= 0 and self.tokens[back].tags.keys() & {"unknown", "numbered", "bare_number", "label"} and "end" not in self.tokens[back].tags:
            back -= 1
        return back < 0 or "end" in self.tokens[back].tags

    def _negations(self, deeds: DeedReader) -> None:
        for at, token in enumerate(self.tokens):
            if "negation" in token.tags and at not in deeds.denied:
                raise self._refuse("this denial was not understood", token.span)

    def _defined(self, at: int) -> bool:
        """Whether a landmark only says what a shorter name of it means: "CP (conflict point)"."""
        near = [i for i in range(max(0, at - 4), min(len(self.tokens), at + 5)) if i != at]
        same = [i for i in near if self.tokens[i].tags.get("landmark") == self.tokens[at].tags["landmark"]]
        return any(
            not any(t.tags.keys() & {"quantity", "verb", "end", "ego", "hero"} for t in self.tokens[min(i, at) + 1 : max(i, at)])
            for i in same
        )

    def _left_over(self, used: set[int]) -> None:
        """Refuse a text in which a word that tells a fact had no part."""
        for at, token in enumerate(self.tokens):
            if at in used or any(clause.aside and clause.start <= at < clause.end for clause in self.clauses):
                continue
            word = None
            if "landmark" in token.tags:
                trigger = self._trigger_sentence()
                here = next((c for c in self.clauses if c.start <= at < c.end), None)
                if here is not None and here.sentence < trigger and not any("quantity" in t.tags for t in self.tokens[here.start : here.end]):
                    continue  # "pulls up to the stop line" before anything happens
                word = token.tags["landmark"] in ("stop_line", "conflict_point") and not self._defined(at)
            elif "respectively" in token.tags:
                word = True
            clause = next((each for each in self.clauses if each.start == at + 1), None)
            if clause is not None and clause.subject == HERO_ID and clause.sentence < self._trigger_sentence():
                if not any("quantity" in t.tags for t in self.tokens[clause.start : clause.end]):
                    continue  # "crosses the lane before it joins the eastbound one"
            if clause is not None and clause.link in ("before", "after", "until") and clause.start - 1 not in used:
                word = not self._rests(clause)
            if word:
                raise self._refuse(f"'{token.text}' was read but has no part in the scenario", token.span)

    def _trigger_sentence(self) -> int:
        return min(m.clause.sentence for m in self.measured if self.moments[m.at] == "trigger")

    def _rests(self, clause: Clause) -> bool:
        """Whether "until it has come to a stop" and "after stopping" only repeat what the hero does."""
        own = [deed for deed in self.deeds if deed.clause is clause]
        return clause.link in ("until", "after") and bool(own) and all(d.kind in ("stop", "brake", "wait") and d.actor == HERO_ID for d in own)

    # -- ways ---------------------------------------------------------------------------------------------------------
    def _ways(self, deeds: DeedReader) -> None:
        reader = WayReader(self.tokens, self.names, self.clauses)
        reader.read()
        for actor, span in deeds.straight:
            if actor is None:
                continue
            reader.ways.append(Way("turn", "straight", span, actor))
        for span in reader.strays:
            raise self._refuse("it is not clear who turns here", span)
        for way in reader.ways:
            if way.actor is None:
                raise self._refuse("it is not clear whose way this is", way.span)
        self.titles = reader.titles
        try:
            self.facts.wishes = reader.wishes(self.road_map)
        except _Clash as clash:
            raise self._refuse(
                f"no route fits what is said about the {ACTOR_NAMES[clash.actor]}", clash.ways[-1].span
            ) from None
        kinds = {(each.kind, each.actor): each for each in reader.relations}
        self.facts.relations = list(kinds.values())
        if {"lead", "ego_leads"} <= {each.kind for each in self.facts.relations}:
            raise self._refuse("each vehicle is said to be in front", self.facts.relations[-1].event.span)
        for wishes in self.facts.wishes.values():
            for said in wishes.values():
                if said.event not in self.events:
                    self.events.append(said.event)

    # -- when ---------------------------------------------------------------------------------------------------------
    def _moments(self) -> None:
        """Decide for each amount whether it holds at the start, at the trigger, or of a deed."""
        for made in self.measured:
            self.moments[made.at] = self._moment(made)
            inside = self.tokens[made.clause.start : made.clause.end]
            bare = not any(t.tags.keys() & {"verb", "be", "auxiliary"} for t in inside)
            unnamed = bare and not made.clause.named and not made.clause.both
            if self.moments[made.at] == "trigger" and unnamed and self._of_no_one(made):
                raise self._refuse("it is not clear whose amount this is", made.span)
        first = min((m.at for m in self.measured if self.moments[m.at] == "trigger"), default=None)
        if first is None:
            first = self._told_before_the_moment()
        for made in self.measured:
            if self.moments[made.at] != "open":
                continue
            if first is not None:
                if made.at > first:
                    raise self._refuse("it is not clear at which moment this holds", made.span)
                self.moments[made.at] = "start"
            else:
                raise self._refuse("it is not clear at which moment this holds", made.span)

    def _told_before_the_moment(self) -> int | None:
        """Read "The ego gets to 12 m before the line. At that moment the hero brakes"."""
        then = next((c for c in self.clauses if c.link == "moment"), None)
        if then is None:
            return self._told_before_a_colon()
        opens = [m for m in self.measured if self.moments[m.at] == "open" and m.at < then.start]
        latest = {made.actor: made for made in opens}
        for made in latest.values():
            self.moments[made.at] = "trigger"
        return min((made.at for made in latest.values()), default=None)

    def _told_before_a_colon(self) -> int | None:
        """Read "Ego 45 m from the conflict point: the car sets off" and "Cond: ego 12 m, van 30 m from it"."""
        opens = [m for m in self.measured if self.moments[m.at] == "open"]
        sentences = {m.clause.sentence for m in opens}
        if len(sentences) != 1 or not opens:
            return None
        inside = [c for c in self.clauses if c.sentence in sentences]
        after = any(c.link == "colon" and c.start > opens[-1].at for c in inside)
        before = any(c.link == "colon" and c.start <= opens[0].at for c in inside)
        if not after and not (before and {m.actor for m in opens} >= {EGO_ID, HERO_ID}):
            return None
        for made in opens:
            self.moments[made.at] = "trigger"
        return opens[0].at

    def _moment(self, made: Measured) -> str:
        clause = made.clause
        if made.kind in ("rate", "duration"):
            return "deed"
        if made.kind == "place" and any(o.kind == "speed" and o.target and o.clause is clause for o in self.measured):
            return "deed"
        if self._of_stop(made):
            return "deed"
        if self._cue(made, "start"):
            if clause.link == "when" or "trigger" in clause.labels:
                raise self._refuse("this is told of the start and of the trigger", made.span)
            return "start"
        if made.kind == "speed":
            return "deed" if made.target or self._after_trigger(clause) else "start"
        sentence = [each for each in self.clauses if each.sentence == clause.sentence]
        when = any(each.link == "when" for each in sentence)
        when = when or any(
            t.tags.get("label") == "when" for each in sentence for t in self.tokens[each.start : each.end]
        )
        past = any(t.text.lower() in ("was", "were", "had") for t in self.tokens[clause.start : made.at])
        if clause.link == "that" and when and past:
            raise self._refuse("it is not clear at which moment this holds", made.span)
        if clause.link == "moment" and made.kind == "place":
            return "trigger"
        if "trigger" in clause.labels or when:
            first = next((c.sentence for c in self.clauses if c.link == "when" and self._has_amount(c)), None)
            if first is not None and clause.sentence != first and "trigger" not in clause.labels:
                raise self._refuse("there is a second moment", made.span)
            bare = not any(t.tags.keys() & {"verb", "be", "auxiliary"} for t in self.tokens[clause.start : clause.end])
            if bare and clause.link == "main" and not self._follows_when(clause):
                raise self._refuse("it is not clear at which moment this holds", made.span)
            return "trigger"
        if made.kind in ("gap", "ttc"):
            return "trigger"
        if any(deed.clause.sentence == clause.sentence and deed.kind in (*_SLOWS, "accelerate") and deed.actor == HERO_ID for deed in self.deeds):
            return "trigger"
        return "open"

    def _has_amount(self, clause: Clause) -> bool:
        sentence = [c for c in self.clauses if c.sentence == clause.sentence and c.start >= clause.start]
        return any("quantity" in t.tags for c in sentence[:3] for t in self.tokens[c.start : c.end])

    def _of_no_one(self, made: Measured) -> bool:
        """Whether no vehicle was named in the sentence before an amount: "At 30 m from it, it begins to brake"."""
        inside = [c for c in self.clauses if c.sentence == made.clause.sentence and c.start <= made.clause.start]
        first = min(c.start for c in inside)
        labelled = bool({"trigger", "who"} & set(made.clause.labels))
        return not labelled and made.clause.link == "main" and made.kind == "place" and not any(first <= at <= made.at + 12 and at in self.names.actors for at in self.names.actors)

    def _follows_when(self, clause: Clause) -> bool:
        """Whether a stretch without a verb goes on with a condition: "when the ego is 12 m and the van 20 m from it"."""
        before = [c for c in self.clauses if c.sentence == clause.sentence and c.start <= clause.start]
        named = any(t.tags.get("label") == "when" for c in before for t in self.tokens[c.start : c.end])
        return named or any(c.link == "when" for c in before) or "trigger" in clause.labels

    def _of_stop(self, made: Measured) -> bool:
        """Whether a place is where the hero comes to rest."""
        clause = made.clause
        if made.actor == EGO_ID or made.kind != "place" or clause.link == "when":
            return False
        inside = [d for d in self.deeds if d.clause is clause and d.kind in ("stop", "wait") and d.actor == HERO_ID]
        if inside:
            return True
        brakes = [d for d in self.deeds if d.clause is clause and d.kind == "brake" and d.actor == HERO_ID]
        if brakes and not self._begins(brakes[0]):
            raise self._refuse("it is not clear whether the hero begins to brake there or comes to rest there", made.span)
        at = self.clauses.index(clause)
        if at and not any(t.tags.keys() & {"verb", "be"} for t in self.tokens[clause.start : made.at]):
            before = self.clauses[at - 1]
            if before.sentence == clause.sentence and not clause.named and any(d.clause is before and d.kind == "stop" for d in self.deeds):
                return True
        return False

    def _cue(self, made: Measured, what: str) -> bool:
        clause = made.clause
        if what in clause.labels:
            return True
        for at in range(clause.start, clause.end):
            tags = self.tokens[at].tags
            if tags.get("adverb") == "initially" or "starting" in tags:
                return True
            if tags.get("verb") == "begin" and at < made.at <= at + 5 and not any("verb" in t.tags for t in self.tokens[at + 1 : made.at]):
                return True
        text = clause.span(self.tokens).excerpt(self.text).lower()
        if "initial" in text or "starting position" in text:
            return True
        at = self.clauses.index(clause)
        if at and self.clauses[at - 1].sentence == clause.sentence:
            before = self.clauses[at - 1]
            verbless = not any(t.tags.keys() & {"verb", "be"} for t in self.tokens[clause.start : made.at])
            earlier = [m for m in self.measured if m.clause is before and self.moments.get(m.at) == "start"]
            if earlier and verbless and clause.link in ("and", "main") and clause.named:
                return True
            words = self.tokens[before.start : before.end]
            alone = all(t.tags.get("adverb") == "initially" or "determiner" in t.tags for t in words)
            return bool(words) and alone
        return False

    def _after_trigger(self, clause: Clause) -> bool:
        return any(
            self.moments.get(made.at) == "trigger" and made.clause.start <= clause.start for made in self.measured
        )

    # -- states -------------------------------------------------------------------------------------------------------
    def _bounds(self) -> None:
        """Refuse "at least 2 s"; "within 20 m" at the trigger is the moment at exactly 20 m."""
        for made in self.measured:
            near = self.tokens[max(0, made.at - 2) : made.at]
            bound = next((each for each in near if "bound" in each.tags), None)
            if bound is not None and (self.moments[made.at] != "trigger" or bound.text.lower() not in _LIMITS):
                raise self._refuse("this is a bound, not a value", made.span)

    def _states(self) -> None:
        for made in self.measured:
            moment = self.moments[made.at]
            if moment not in ("start", "trigger"):
                continue
            if made.quantity is None:
                if moment == "start" and made.actor == HERO_ID:
                    continue
                if made.kind == "place" and moment == "trigger":
                    if any(o is not made and o.actor == made.actor and self.moments[o.at] == "trigger" for o in self.measured):
                        continue
            known = self.facts.initial if moment == "start" else self.facts.trigger
            condition = self._condition(made)
            for old in known:
                same = (old.place is None) == (condition.place is None) and (old.ttc is None) == (condition.ttc is None)
                if old.actor == condition.actor and same:
                    raise self._refuse("two amounts are told for one moment", made.span)
            known.append(condition)
            self.events.append(condition.event)

    def _condition(self, made: Measured) -> Condition:
        actor = made.actor
        if made.kind == "open":
            raise self._refuse("it is not clear what this measures", made.span)
        if made.kind == "gap":
            assert made.quantity is not None
            if actor is None:
                event = Event("be", EGO_ID, made.span, made.clause.sentence)
                return Condition(EGO_ID, event, Place("from", HERO_ID, made.quantity, made.span))
            event = Event("be", actor, made.span, made.clause.sentence)
            return Condition(actor, event, Place("behind", 1 - actor, made.quantity, made.span))
        if made.kind == "ttc":
            event = Event("ttc", EGO_ID, made.span, made.clause.sentence)
            return Condition(EGO_ID, event, ttc=made.quantity)
        if actor is None:
            raise self._refuse("it is not clear whose amount this is", made.span)
        event = Event("be", actor, made.span, made.clause.sentence)
        if made.kind == "speed":
            return Condition(actor, event, speed=made.quantity)
        assert made.landmark is not None
        return Condition(actor, event, Place(made.relation, made.landmark, made.quantity, made.span, vague=made.vague))

    # -- the story ----------------------------------------------------------------------------------------------------
    def _story(self) -> None:
        for deed in self.deeds:
            if deed.actor == EGO_ID and deed.kind not in ("before", "after", "let_reach", "wait", "go", "turn", "let", "keep", "yield"):
                raise self._refuse("the ego cannot be told what to do: the policy under test drives it", deed.span)
        first = min((m.clause.start for m in self.measured if self.moments[m.at] == "trigger"), default=None)
        if first is None:
            raise self._refuse("no trigger was found", Span(0, len(self.text)))
        self._standing(first)
        sentence = next(c.sentence for c in self.clauses if c.start == first)
        told = [deed for deed in self.deeds if deed.actor == HERO_ID and self._counts(deed, sentence)]
        kinds = {deed.kind for deed in told}
        slows = [deed for deed in told if deed.kind in _SLOWS]
        goes = [deed for deed in told if deed.kind in ("accelerate", "pass", "complete", "keep", "go")]
        waits = [deed for deed in told if deed.kind == "wait"]
        if slows and goes and goes[0].at < slows[0].at:
            raise self._refuse("it is not clear in which order this happens", goes[0].span)
        denies = [deed for deed in told if deed.kind == "not_yield"]
        if denies and slows:
            raise self._refuse("the hero is said to stop and not to stop", denies[0].span)
        if any(deed.kind == "turn" for deed in told) and not goes:
            raise self._refuse("a turn at the trigger is not read here", told[0].span)
        if "keep" in kinds and "accelerate" in kinds:
            raise self._refuse("the hero is said to speed up and not to", told[0].span)
        if any(deed.kind == "turn" for deed in told) and not any(deed.kind in ("complete", "pass") for deed in goes):
            raise self._refuse("it is not clear up to where the hero goes", told[0].span)
        for clause in self.clauses:
            if clause.sentence < sentence or clause.subject != HERO_ID or clause.link in ("before", "after", "until", "when"):
                continue
            turns = [i for i in range(clause.start, clause.end) if self.tokens[i].tags.get("event_noun") == "turn"]
            owned = [i for i in turns if i and "possessive" in self.tokens[i - 1].tags]
            if owned and not any(d.clause is clause and d.kind in ("complete", "turn") for d in self.deeds):
                raise self._refuse("it is not clear up to where the hero goes", self.tokens[owned[0]].span)
        begun = [d for d in told if d.kind == "turn" and self._begins(d)]
        if begun:
            raise self._refuse("a turn at the trigger is not read here", begun[0].span)
        if not slows and not goes and not denies:
            raise self._refuse("it is not said what the hero does", Span(0, len(self.text)))
        if slows:
            self._slow(slows, waits)
        if goes or (denies and not slows):
            self._go(goes, denies, kinds, bool(slows))
        self._order(goes)

    def _standing(self, first: int | None) -> None:
        """Read "a taxi is standing at the stop line" before the trigger: it waits there until then."""
        if first is None:
            return
        sentence = next(c.sentence for c in self.clauses if c.start == first)
        for deed in self.deeds:
            stands = deed.kind == "wait" and deed.actor == HERO_ID and deed.clause.sentence < sentence
            if stands and _STANDS.search(deed.span.excerpt(self.text)):
                self.facts.standing = self.facts.standing or self._event(deed)

    def _begins(self, deed: Deed) -> bool:
        return any(self.tokens[at].tags.get("verb") == "begin" for at in range(deed.clause.start, deed.at))

    def _counts(self, deed: Deed, sentence: int) -> bool:
        """Whether a deed belongs to what the hero does after its trigger."""
        if deed.clause.link in ("when",) and deed.kind not in ("brake", "accelerate"):
            return False
        if deed.kind in ("brake", "accelerate", "not_yield", "complete"):
            return True
        if deed.kind == "pass" and deed.landmark is None:
            area = any(self.tokens[at].tags.get("area") == "lane" for at in range(deed.at, deed.clause.end))
            if area or deed.clause.sentence < sentence:
                return False
        if deed.kind in ("stop", "pass"):
            return deed.clause.sentence >= sentence or deed.clause.link != "that"
        if deed.kind == "yield":
            return False
        if deed.kind == "keep":
            return deed.clause.sentence >= sentence
        later = deed.clause.sentence > sentence
        return later or (deed.clause.sentence == sentence and deed.clause.start > min(m.at for m in self.measured if self.moments[m.at] == "trigger"))

    def _slow(self, slows: list[Deed], waits: list[Deed]) -> None:
        event = self._event(slows[0])
        phase = Phase("dec", [event])
        phase.to_stop = any(deed.kind == "stop" for deed in slows) or bool(waits)
        for made in self.measured:
            if self.moments[made.at] != "deed":
                continue
            if made.kind == "place":
                assert made.landmark is not None
                if phase.place is not None:
                    if made.quantity is None:
                        continue
                    if phase.place.amount is not None:
                        raise self._refuse("two places to stop are told", made.span)
                phase.place = Place(made.relation, made.landmark, made.quantity, made.span, vague=made.vague)
                phase.place_event = self._event_at(made)
            elif made.kind == "rate":
                if self._deed_of(made) not in _SLOWS:
                    continue
                phase.rate, phase.rate_event = made.quantity, self._event_at(made)
            elif made.kind == "duration":
                phase.wait = made.quantity
            elif made.kind == "speed":
                if self._deed_of(made, "pass", "go") not in _SLOWS:
                    continue
                phase.to_speed = made.quantity
        if phase.to_speed is not None and phase.to_stop:
            raise self._refuse("a stop and a speed are told", phase.to_speed.span)
        self.facts.phases.append(phase)

    def _go(self, goes: list[Deed], denies: list[Deed], kinds: set[str], after_stop: bool) -> None:
        deed = goes[0] if goes else denies[0]
        event = self._event(deed)
        phase = Phase("go" if "keep" in kinds and not after_stop else "acc", [event])
        goal = next((each for each in goes if each.kind in ("pass", "complete")), None)
        if goal is not None:
            phase.goal = "turn_end" if goal.kind == "complete" else goal.landmark or "conflict_point"
            phase.goal_event = self._event(goal)
        for made in self.measured:
            if self.moments[made.at] != "deed":
                continue
            if made.kind == "speed" and after_stop and self._deed_of(made, "pass", "go") in ("accelerate", "pass", "go"):
                phase.to_speed = made.quantity
            elif made.kind == "rate" and self._deed_of(made) == "accelerate":
                phase.rate, phase.rate_event = made.quantity, self._event_at(made)
            elif not after_stop:
                if made.kind == "rate":
                    phase.rate, phase.rate_event = made.quantity, self._event_at(made)
                elif made.kind == "speed":
                    phase.to_speed = made.quantity
                elif made.kind == "place" and made.quantity is None and self.facts.standing is not None:
                    if made.landmark != "stop_line":
                        raise self._refuse("a hero can stand at its stop line only", made.span)
                elif made.kind in ("duration", "place"):
                    raise self._refuse("this amount does not belong to what the hero does", made.span)
        self.facts.phases.append(phase)

    def _deed_of(self, made: Measured, *more: str) -> str | None:
        """Return the deed that a rate belongs to: the one told last before it."""
        near = [d for d in self.deeds if d.actor == HERO_ID and d.kind in (*_SLOWS, "accelerate", *more)]
        same = [d for d in near if d.clause.sentence == made.clause.sentence]
        before = [d for d in same if d.at < made.at]
        chosen = before[-1:] or same[:1] or near[:1]
        return chosen[0].kind if chosen else None

    def _order(self, goes: list[Deed]) -> None:
        trigger = self._trigger_sentence()
        acted = {deed.clause.sentence for deed in self.deeds if deed.actor == HERO_ID and deed.kind != "turn"}
        moments = [
            deed
            for deed in self.deeds
            if deed.kind in ("before", "after") and (deed.clause.sentence >= trigger or deed.clause.sentence in acted)
        ]
        lets = [deed for deed in self.deeds if deed.kind == "let_reach"]
        phase = self.facts.phases[-1]
        if not moments:
            moments = self._first(goes)
        if lets and any(deed.kind == "before" for deed in moments):
            raise self._refuse("the hero lets the ego go and also comes first", lets[0].span)
        if phase.goal == "stop_line":
            raise self._refuse("a stop line is no goal", moments[0].span if moments else Span(0, len(self.text)))
        if lets and not moments:
            event = Event("pass", EGO_ID, lets[0].span, lets[0].clause.sentence)
            self.events.append(event)
            if phase.kind == "dec":
                self.facts.let_goal = (lets[0].landmark or "conflict_point", event)
            else:
                self.facts.order = Order(False, lets[0].landmark or "conflict_point", event, at_start=True)
        first_landmark: str | None = None
        for deed in moments:
            landmark = deed.landmark or "conflict_point"
            if landmark == "same":
                landmark = phase.goal or "conflict_point"
                if landmark == "turn_end":
                    raise self._refuse("it is not clear which moment of the ego this is", deed.span)
            if phase.kind == "dec":
                raise self._refuse("a stop cannot be ordered against the ego", deed.span)
            known = self.facts.order
            if known is not None and known.hero_first == (deed.kind == "before") and "same" in (deed.landmark, first_landmark):
                continue  # "ahead of the ego, that is, before the ego does"
            if known is not None:
                raise self._refuse("two orders are told", deed.span)
            first_landmark = deed.landmark
            event = Event("pass", EGO_ID, deed.span, deed.clause.sentence)
            self.events.append(event)
            self.facts.order = Order(deed.kind == "before", landmark, event, at_start=deed.kind == "after" and deed.landmark != "same")
            if phase.goal is None and deed.kind == "before":
                phase.goal, phase.goal_event = "conflict_point", event

    def _first(self, goes: list[Deed]) -> list[Deed]:
        """Read "gets to the conflict point first"."""
        for deed in goes:
            for at in range(deed.clause.start, deed.clause.end):
                if self.tokens[at].tags.get("adverb") == "first":
                    return [Deed("before", at, deed.clause, self.tokens[at].span, "same", EGO_ID)]
        return []

    # -- helpers ------------------------------------------------------------------------------------------------------
    def _event(self, deed: Deed) -> Event:
        event = Event(deed.kind, HERO_ID, deed.clause.span(self.tokens), deed.clause.sentence)
        self.events.append(event)
        return event

    def _event_at(self, made: Measured) -> Event:
        event = Event("be", HERO_ID, made.span, made.clause.sentence)
        self.events.append(event)
        return event

    def _refuse(self, message: str, span: Span) -> TranslationError:
        return TranslationError(
            message, place=ErrorPlace(self.name, self.text, span), found=span.excerpt(self.text)[:80], expected=None
        )


