"""Decides for each amount at which moment it holds: at the start, at the trigger, or of a deed.

What enters: words, amounts, deeds. What leaves: the moment of every amount. Nothing is guessed: what no word decides
is refused, but for amounts told before the trigger is, which hold at the start.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.facts import Bound
from scenewright.translate.gist.bare_triggers import BareTriggers
from scenewright.translate.gist.measured import Measured
from scenewright.translate.gist.starts import FROM_START, START_POINT, Moment, Starts
from scenewright.translate.gist.words import Clause, Deed, Words

UNCLEAR = "it is not clear at which moment this holds"
_STATE = ("verb", "be", "auxiliary")
# What names the moment itself where something comes near: "as soon as it is within 20 m".
_LIMITS = ("within",)
_BOUNDS: dict[str, Bound] = {
    "at least": ">=", "no less than": ">=", "not less than": ">=",
    "at most": "<=", "no more than": "<=", "not more than": "<=",
}  # fmt: skip
_PAST = ("was", "were", "had")
_THEN = (
    "then", "by then", "right then", "just then", "at the time", "at that time", "at that point", "at this point",
    "at that moment", "at this moment", "at that very moment", "at that instant", "at the same moment",
)  # fmt: skip
_FAR = 12
_AT_TRIGGER = re.compile(r"[Ss]peed of [\w ]+ at the trigger ?:|[\w ]+['\u2019]?s? speed at the trigger ?:")


@dataclass(slots=True)
class MomentReader:
    """Tells the moments of one text's amounts."""

    words: Words
    measured: list[Measured]
    deeds: list[Deed]
    moments: dict[int, Moment] = field(default_factory=dict)  # by where the amount stands
    starts: Starts = field(init=False)

    def __post_init__(self) -> None:
        self.starts = Starts(self.words, self.measured, self.deeds, self.moments)

    def read(self) -> dict[int, Moment]:
        """Return the moment of each amount.

        Raises
        ------
        TranslationError
            Where it is not clear, or where there are two triggers or none.
        """
        for made in self.measured:
            self.moments[made.at] = self._moment(made)
            if self.moments[made.at] == "trigger" and self._of_no_one(made):
                raise self.words.refuse("it is not clear whose amount this is", made.span)
        first = min((made.at for made in self.of("trigger")), default=None)
        if first is None:
            started = any(made.actor == EGO_ID and made.kind == "place" for made in self.of("start"))
            triggers = BareTriggers(self.words, self.deeds, self.of("open"), started).find()
            self.moments |= {made.at: "trigger" for made in triggers}
            first = min((made.at for made in triggers), default=None)
        self._just_before_the_moment()
        for made in self.of("open"):
            if first is None or made.at > first:
                raise self.words.refuse(UNCLEAR, made.span, "'at the start', 'when' or 'as soon as'")
            if made.kind == "place" and self._comes_there(made):
                raise self.words.refuse(UNCLEAR, made.span, "'at the start', 'when' or 'as soon as'")
            self.moments[made.at] = "start"
        if first is None:
            raise self.words.refuse("there is no trigger: it is not said when the hero reacts", None, "'when ...'")
        self._bounds()
        return self.moments

    def _comes_there(self, made: Measured) -> bool:
        """Whether a vehicle is on its way when it is there: "The ego gets to 12 m from the line."."""
        told = range(made.clause.start, made.at)
        return bool(self.words.verbs(told) & {"reach", "get_within"}) or self.words.has(told, "falls")

    def _just_before_the_moment(self) -> None:
        """Read "The ego gets to 3 s from the line. At this moment the van is 5 s from the point." as one moment."""
        first = next((each for each in self.words.clauses if each.link == "moment"), None)
        if first is None or self.words.sentence(first)[0] is not first:
            return
        whens = [each for each in self.words.clauses if each.link == "when" and each.sentence < first.sentence]
        told = [made for made in self.of("trigger") if made.clause.sentence == first.sentence]
        if not told or any("start" not in each.labels for each in whens):
            return
        for made in self.of("open"):
            if made.clause.sentence == first.sentence - 1 and made.kind in ("place", "gap", "ttc"):
                self.moments[made.at] = "trigger"

    def of(self, moment: Moment) -> list[Measured]:
        """Return the amounts that hold at a moment."""
        return [made for made in self.measured if self.moments[made.at] == moment]

    def _bounds(self) -> None:
        """Refuse "at least 2 s"."""
        for made in self.measured:
            bounds = [i for i in range(made.at - 2, made.at) if "bound" in self.words.tags(i)]
            at = next((i for i in bounds if self.words.word(i) not in _LIMITS), bounds[0] if bounds else None)
            limit = at is not None and self.words.word(at) in _LIMITS and self.moments[made.at] == "trigger"
            if self.words.has(range(made.at + 1, made.at + 2), "bound") and self.words.word(made.at + 1).startswith(
                "or "
            ):
                raise self.words.refuse("this is a bound, not a value", made.span)  # "12 m or more"
            bound = _BOUNDS.get(self.words.word(at)) if at is not None else None
            if bound is not None and made.kind in ("duration", "margin"):
                made.bound = bound
                continue
            if at is not None and not limit and self.words.word(at) != "up to":
                raise self.words.refuse("this is a bound, not a value", made.span)

    # -- one amount ---------------------------------------------------------------------------------------------------
    def _moment(self, made: Measured) -> Moment:
        clause = made.clause
        slowed = any(each.kind == "speed" and each.target and each.clause is clause for each in self.measured)
        slowed = slowed or self._slowed_there(made)
        if made.kind in ("rate", "duration", "margin") or (made.kind == "place" and slowed) or self._of_stop(made):
            return "deed"
        if made.kind == "clock":
            return "trigger"
        if made.kind == "speed" and self._stands(made):
            raise self.words.refuse("a vehicle that stands has no speed", made.span)
        if self.starts.holds(made):
            if clause.link == "when" or "trigger" in clause.labels:
                raise self.words.refuse("this is told of the start and of the trigger", made.span)
            return "start"
        if made.kind == "speed" and not made.target and self._at_that_moment(clause):
            return "trigger"
        if made.kind == "speed" and (self._is_within(made) or (self._is_asked(clause) and self._is_condition(made))):
            return "trigger"
        if made.kind == "speed" and clause.link in ("that", "moment") and self._is_then(made):
            return "trigger"
        ways = self.words.verbs(range(clause.start, made.at)) & {"lane_follow", "go", "drive", "come"}
        plain = made.kind == "speed" and made.actor == EGO_ID and not made.target and clause.link == "main"
        if plain and ways and not any(each.link == "when" for each in self.words.sentence(clause)):
            return "start"  # "The AV, for its part, follows the road at 25 mph": told after all else
        if made.kind == "speed" and clause.link == "that" and ways and not made.target:
            return "start"  # "when the ego, which goes straight on at 14 m/s, is 4 s from it"
        if made.kind == "speed" and not made.target and self._told_with_way(made):
            return "start"
        if made.kind == "speed":
            told = self._is_asked(clause) or self._deed_beside(clause)
            if told and not made.target and not self._after_trigger(clause) and not self._on_its_way(made):
                raise self.words.refuse(UNCLEAR, made.span)
            if made.actor == EGO_ID and not made.target and self._after_trigger(clause):
                raise self.words.refuse(UNCLEAR, made.span)  # nobody tells the ego how fast to go
            if made.target or not self._after_trigger(clause):
                return "deed" if made.target else "start"
            alone = clause.start == made.at and not self.words.has(clause.inside, "verb", "be")
            if alone and not self._is_keyed(clause):
                raise self.words.refuse("it is not clear whose speed this is", made.span)
            spoken = " ".join(self.words.span(each).excerpt(self.words.text) for each in self.words.sentence(clause))
            if "initial" in spoken or FROM_START.search(spoken):
                raise self.words.refuse(UNCLEAR, made.span)
            return "deed"
        asked = "trigger" in clause.labels or self._is_asked(clause)
        comes = self.words.verbs(range(clause.start, made.at)) & {"come", "drive", "go", "approach", "pull_out"}
        if self.words.word(made.at - 1) == "from" and made.kind == "place" and clause.link != "when" and comes:
            return "start"  # "is coming up from 50 m before its stop line"
        if self._goes_until(clause):
            if self.words.word(made.at - 1) == "from":
                return "start"  # "drives on from 27 m before it until ..."
            raise self.words.refuse(UNCLEAR, made.span)
        past = any(self.words.word(at) in _PAST for at in range(clause.start, made.at))
        if asked and clause.link == "that" and past:
            raise self.words.refuse(UNCLEAR, made.span)
        if made.kind == "place" and clause.link == "moment" and self._goes_on_at_start(clause):
            return "start"
        if made.kind == "place" and (clause.link == "moment" or self._at_that_moment(clause)):
            return "trigger"
        if made.kind == "place" and (self._when_it_acts(clause) or self._begins_here(made)):
            return "trigger"
        if asked:
            self._check_one_moment(made)
            return "trigger"
        if made.kind == "place" and self._is_told_then(clause):
            return "trigger"
        return "trigger" if self._deed_beside(clause) else "open"

    def _goes_on_at_start(self, clause: Clause) -> bool:
        """Whether this is "At that time the hero is 90 m from it" after "At the start the ego is 40 m from it"."""
        told = [each for each in self.measured if each.clause.sentence == clause.sentence - 1]
        start = bool(told) and all(self.moments.get(each.at) == "start" for each in told)
        acts = any(deed.clause.sentence == clause.sentence and deed.kind != "go" for deed in self.deeds)
        later = any(each.link == "when" and each.sentence > clause.sentence for each in self.words.clauses)
        return start and not acts and later and "trigger" not in self.words.word(clause.start - 1)

    def _stands(self, made: Measured) -> bool:
        """Whether a speed is one of who stands: "standing there at 2 m/s", "the ego, stationary there, does 4 m/s"."""
        own = [each for each in self.words.sentence(made.clause) if each.subject == made.actor and each.start < made.at]
        stands = any(self.words.where(each.inside, "actor_adjective", "standing") is not None for each in own)
        waits = self.words.verbs(range(made.clause.start, made.at)) == {"wait"} and not made.target
        return waits or (stands and made.clause in own and not self._is_asked(made.clause))

    def _is_keyed(self, clause: Clause) -> bool:
        """Whether a speed that stands alone goes on with what was told, or has a key: "Its speed: 9 m/s"."""
        if clause.link != "colon":
            return clause.link != "main"
        key = self.words.clauses[self.words.clauses.index(clause) - 1]
        return key.named or self.words.has(key.inside, "measure", "label", "possessive")

    def _is_told_then(self, clause: Clause) -> bool:
        """Whether this is told of the moment before: "it brakes when it is 8 m from it; the ego is 70 m away then"."""
        then = any(self.words.word(at) in _THEN for at in range(clause.start, clause.end + 1))
        known = [m.clause.sentence for m in self.measured if self.moments.get(m.at) == "trigger" and m.kind == "place"]
        acts = any(deed.clause is clause for deed in self.deeds)
        return then and not acts and clause.named and clause.sentence - 1 in known

    def _slowed_there(self, made: Measured) -> bool:
        """Whether a speed is reached there: "so that it is down to 3 m/s when it is 9 m before that point"."""
        at = self.words.clauses.index(made.clause)
        before = self.words.clauses[at - 1] if at else made.clause
        reached = any(each.kind == "speed" and each.target and each.clause is before for each in self.measured)
        own = made.clause.link == "when" and before.sentence == made.clause.sentence and made.actor == HERO_ID
        return own and reached and any(each.kind == "place" and each.at < before.start for each in self.measured)

    def _begins_here(self, made: Measured) -> bool:
        """Whether the hero begins to act there: "it starts to brake 10 m before the line, when the ego is ..."."""
        own = [d for d in self.deeds if d.clause is made.clause and d.actor == HERO_ID]
        brakes = len(own) == 1 and own[0].kind in ("brake", "accelerate") and made.actor == HERO_ID
        later = [each for each in self.words.sentence(made.clause) if each.start > made.clause.start]
        asked = any(each.link == "when" and self._has_amount(each) for each in later)
        return brakes and asked and self.begins(own[0]) and own[0].at < made.at

    def _when_it_acts(self, clause: Clause) -> bool:
        """Whether the deed is told as the moment: "it was 22 m from it, and ours 7 m from the line, when it braked"."""
        later = [each for each in self.words.sentence(clause) if each.start > clause.start and each.link == "when"]
        before = [each for each in self.words.sentence(clause) if each.start < clause.start and each.link == "when"]
        if before or len(later) != 1 or self._has_amount(later[0]):
            return False
        kinds = ("brake", "stop", "accelerate")
        acts = any(d.clause is later[0] and d.actor == HERO_ID and d.kind in kinds for d in self.deeds)
        return acts and not self._acts_early(clause)

    def _acts_early(self, clause: Clause) -> bool:
        """Whether the hero does something before this in the sentence."""
        return any(
            d.actor == HERO_ID and d.clause.sentence == clause.sentence and d.at < clause.end for d in self.deeds
        )

    def _of_stop(self, made: Measured) -> bool:
        """Whether a place is where the hero comes to rest."""
        clause = made.clause
        if made.actor == EGO_ID or made.kind != "place" or (clause.link == "when" and not self._stands_once(clause)):
            return False
        if clause.link == "when":
            return True
        if START_POINT.search(self.words.span(clause).excerpt(self.words.text).lower()):
            return False  # "its start point lies 95 m before it"
        own = [deed for deed in self.deeds if deed.clause is clause and deed.actor == HERO_ID]
        if any(deed.kind in ("stop", "wait") and not self._is_placed(deed) for deed in own):
            return True
        if clause.link == "that" and self.words.verbs(clause.inside) & {
            "reach",
            "make",
        }:  # "to a stop, which it reaches 9 m before"
            earlier = [deed for deed in self.deeds if deed.at < clause.start and deed.actor == HERO_ID]
            if earlier and earlier[-1].kind == "stop" and earlier[-1].clause.sentence == clause.sentence:
                return True
        brakes = [deed for deed in own if deed.kind == "brake"]
        if brakes and not self.begins(brakes[0]):
            message = "it is not clear whether the hero begins to brake there or comes to rest there"
            raise self.words.refuse(message, made.span)
        at = self.words.clauses.index(clause)  # "target stopped, 15 ft before the conflict point"
        before = self.words.clauses[at - 1] if at else clause
        if self._stops_next(made):
            return True
        late = any(moment == "trigger" for moment in self.moments.values())  # "is located on the driveway, 20 m before"
        goes_on = before.sentence == clause.sentence and not clause.named
        first = clause.start + ("be" in self.words.tags(clause.start))  # "its final position, at zero speed, is 5 m"
        verbless = not self.words.has(range(first, made.at), "verb", "be")
        return (
            goes_on
            and verbless
            and any(
                deed.clause is before
                and deed.actor == HERO_ID
                and (deed.kind == "stop" or (deed.kind == "wait" and late))
                for deed in self.deeds
            )
        )

    def _stops_next(self, made: Measured) -> bool:
        """Whether the deed follows in a clause of its own: "decelerates, and 10 m before the point it stops"."""
        clause, at = made.clause, self.words.clauses.index(made.clause)
        if (
            at + 1 >= len(self.words.clauses)
            or clause.named
            or self.words.has(clause.inside, "verb", "be", "auxiliary")
        ):
            return False
        following = self.words.clauses[at + 1]
        own = [d for d in self.deeds if d.clause is following and d.actor == HERO_ID]
        adjacent = following.sentence == clause.sentence and following.start <= clause.end + 1
        early = any(self.moments.get(each.at) == "trigger" for each in self.measured if each.at < made.at)
        early = early or made.quantity is None  # "Just before its stop line, the car comes to a complete stop"
        return adjacent and early and bool(own) and own[0].kind in ("stop", "wait") and following.link == "main"

    def _stands_once(self, clause: Clause) -> bool:
        """Whether this is where the hero stands: "It is stationary once it is 8 m from it", told after the trigger."""
        told = [each for each in self.words.sentence(clause) if self.words.has(each.inside, "quantity")]
        stands = [d for d in self.deeds if d.clause.sentence == clause.sentence and d.kind in ("stop", "wait")]
        early = any(self.moments.get(each.at) == "trigger" for each in self.measured) or self._both_told(clause)
        index = self.words.clauses.index(clause)
        before = self.words.clauses[index - 1] if index else clause
        own = [d for d in self.deeds if d.clause is before and d.actor == HERO_ID and d.kind in ("stop", "wait")]
        brakes = any(d.clause is before and d.kind == "brake" for d in self.deeds)
        alone = early and own and not brakes and before.sentence == clause.sentence
        if alone and not self.words.has(before.inside, "quantity"):
            return True  # "slows down and is at a complete stop when it is 8 m before it"
        return (
            early and told == [clause] and bool(stands) and stands[0].actor == HERO_ID and stands[0].at < clause.start
        )

    def _is_placed(self, deed: Deed) -> bool:
        """Whether this only tells where the hero is at first: "is positioned 20 m from the stop line"."""
        first = self.words.tag(deed.at, "verb") == "sit" and deed.kind == "wait"
        return first and not any(
            each.kind in ("brake", "stop") and each.actor == HERO_ID and each.at < deed.at for each in self.deeds
        )

    def _both_told(self, clause: Clause) -> bool:
        """Whether places of both were told before in the sentence: "At 10 yd for us and 28 yd for it, it brakes"."""
        told = [m for m in self.measured if m.kind == "place" and m.clause.sentence == clause.sentence]
        first = min((each.at for each in self.deeds if each.clause.sentence == clause.sentence), default=0)
        return {m.actor for m in told if m.at < min(first, clause.start)} >= {EGO_ID, HERO_ID}

    def begins(self, deed: Deed) -> bool:
        """Whether a deed is said to begin: "begins to brake"."""
        noun = self.words.tag(deed.at, "event_noun") in ("brake", "accelerate")
        noun = noun and self.words.has([deed.at - 1], "determiner", "end", "possessive")
        stretch = range(deed.clause.start, deed.clause.end if noun else deed.at)
        return "begin" in self.words.verbs(stretch) or (noun and self.words.has(stretch, "onset_verb"))

    def _is_condition(self, made: Measured) -> bool:
        """Whether a speed is part of a condition: "when the ego is 12 m from it and the hero's speed is 10 m/s"."""
        clause = made.clause
        measured = self.words.where(clause.inside, "measure", "speed") is not None
        acted = any(d.actor == HERO_ID and d.clause.sentence == clause.sentence and d.at < made.at for d in self.deeds)
        first = next(each for each in self.words.sentence(clause) if each.link == "when" or each is clause)
        return measured and not acted and not made.target and first.start <= clause.start

    def _is_then(self, made: Measured) -> bool:
        """Whether a speed is told of whoever then acts: "the truck, whose speed at that moment is 7 m/s, brakes"."""
        clause = made.clause
        at = self.words.clauses.index(clause)
        told = [i for each in self.words.clauses[max(0, at - 1) : at + 1] for i in each.inside]
        measured = self.words.where(told, "measure", "speed") is not None
        acted = any(d.actor == HERO_ID and d.clause.sentence == clause.sentence and d.at < made.at for d in self.deeds)
        asked = "trigger" in clause.labels or self._is_asked(clause)
        return measured and asked and not acted and self._after_trigger(clause) and not made.target

    def _is_within(self, made: Measured) -> bool:
        """Whether a speed is told within a condition: "when the van, then doing 30 km/h, is 3 s from it"."""
        sentence = self.words.sentence(made.clause)
        asked = next((each for each in sentence if each.link == "when"), None)
        if asked is None or made.target or made.at < asked.start or made.clause.link == "that":
            return False
        acts = (d.at for d in self.deeds if d.actor == HERO_ID and d.clause.sentence == made.clause.sentence)
        act = min((at for at in acts if at > asked.start), default=sentence[-1].end)
        own = [each for each in self.measured if each.kind == "place" and each.actor == made.actor]
        last = [each for each in own if each.at < made.at][-1:]
        before = [self.words.word(at) for at in range(made.clause.start - 1, made.at)]
        then = {"then", "by then", "at that"} & set(before)
        if made.clause.link == "and" and any(word in ("doing", "moving", "going") for word in before):
            return made.at < act and any(asked.start < each.at < made.clause.start for each in last)
        return bool(then) and any(made.at < each.at < act for each in own)

    def _is_asked(self, clause: Clause) -> bool:
        """Whether the sentence tells a condition: "when", "trigger"."""
        sentence = self.words.sentence(clause)
        labels = any(self.words.where(each.inside, "label", "when") is not None for each in sentence)
        return labels or any(each.link == "when" for each in sentence)

    def _at_that_moment(self, clause: Clause) -> bool:
        """Whether a sentence only tells how all stand: "At the trigger the ego is ..., and the van is ..."."""
        sentence = self.words.sentence(clause)
        opens = sentence[0].start - 1
        opens -= self.words.has([opens], "comma")  # "At the trigger, the ego is ..."
        first = sentence[0].link == "moment" and self.words.word(opens).endswith("the trigger")
        key = self.words.span(sentence[0]).union(self.words.span(sentence[-1])).excerpt(self.words.text)
        first = first or _AT_TRIGGER.match(key) is not None
        acted = any(d.actor == HERO_ID and d.clause.sentence == clause.sentence and d.kind != "go" for d in self.deeds)
        return first and not acted

    def _told_with_way(self, made: Measured) -> bool:
        """Whether a speed is told with a heading, as part of the way: "a van, westbound on the road at 25 mph,"."""
        words, clause = self.words, made.clause
        near = range(max(clause.start, made.at - 6), made.at)
        acts = words.verbs(range(clause.start, made.at)) & {"brake", "accelerate", "stop", "pass", "complete", "wait"}
        plain = words.word(made.at - 1) in ("at", "with") and clause.link != "when"
        return plain and words.has(near, "heading") and not acts and not words.has(near, "quantity", "measure")

    def _on_its_way(self, made: Measured) -> bool:
        """Whether a speed is told with the way, before a moment: "comes down the road at 5 m/s, and brakes when"."""
        clause = made.clause
        ways = self.words.verbs(range(clause.start, made.at)) & {"come", "drive", "go", "pull_out", "approach", "leave"}
        whens = [each for each in self.words.sentence(clause) if each.link == "when"]
        first = clause.link == "and" and clause is self.words.sentence(clause)[0]  # "With the ego on its way at 12 m/s"
        first = first or self.words.word(clause.start - 1) in ("while", "whilst")
        early = all(each.start > clause.start for each in whens) and (first or clause.link in ("main", "colon"))
        early = early and bool(whens)
        done = any(deed.clause is clause and deed.kind != "turn" for deed in self.deeds)
        earlier = [each for each in self.words.sentence(clause) if each.start < clause.start]
        way = any(self.words.has(each.inside, "heading", "direction", "area") for each in [*earlier, clause])
        verbless = way and not self.words.has(clause.inside, "verb", "be")
        return early and (bool(ways) or verbless) and not done

    def _goes_until(self, clause: Clause) -> bool:
        """Whether the moment is told after this clause as the end of it: "drives on until the gap is 16 m"."""
        later = [each for each in self.words.sentence(clause) if each.start > clause.start and each.link == "when"]
        return clause.link != "when" and bool(later) and self.words.word(later[0].start - 1) == "until"

    def _check_one_moment(self, made: Measured) -> None:
        clause = made.clause
        whens = [each for each in self.words.clauses if each.link == "when" and "start" not in each.labels]
        first = next((each for each in whens if self._has_amount(each)), None)
        if "trigger" in clause.labels:
            return
        if first is not None and clause.sentence != first.sentence:
            raise self.words.refuse("there is a second moment", made.span)
        before = [each for each in self.words.sentence(clause) if each.start <= clause.start]
        follows = any(
            each.link == "when" or self.words.where(each.inside, "label", "when") is not None for each in before
        )
        done = [d for d in self.deeds if d.actor == HERO_ID and d.clause.sentence == clause.sentence and d.at < made.at]
        acted = [d for d in done if d.kind in ("brake", "stop", "accelerate", "pass") and d.clause.link != "when"]
        if acted and not any(each.link == "when" and each.start > acted[-1].at for each in before):
            raise self.words.refuse(UNCLEAR, made.span)
        rest = [each for each in self.words.sentence(clause) if each.start > clause.start and each.link == "that"]
        follows = follows or any(self.words.where(each.inside, "label", "when") is not None for each in rest)
        then = any(self.words.word(at) in _THEN for at in clause.inside) and self._deed_beside(clause)
        if clause.link == "main" and not self.words.has(clause.inside, *_STATE) and not follows and not then:
            raise self.words.refuse(UNCLEAR, made.span)

    def _has_amount(self, clause: Clause) -> bool:
        following = [each for each in self.words.sentence(clause) if each.start >= clause.start][:6]
        return any(self.words.has(each.inside, "quantity") for each in following)

    def _deed_beside(self, clause: Clause) -> bool:
        """Whether the hero does something in the same sentence: "with the ego 12 m from the line, the van brakes"."""
        kinds = ["brake", "stop", "accelerate"]
        if self.words.word(self.words.sentence(clause)[0].start - 1) == "with":
            kinds += ["not_yield", "keep"]  # "With the ego 3 s from it, the van does not yield."
        own = [deed for deed in self.deeds if deed.actor == HERO_ID and deed.kind in kinds]
        return any(deed.clause.sentence == clause.sentence for deed in own)

    def _after_trigger(self, clause: Clause) -> bool:
        known = [made for made in self.measured if self.moments.get(made.at) == "trigger"]
        return any(made.clause.start <= clause.start for made in known)

    def _of_no_one(self, made: Measured) -> bool:
        """Whether no vehicle was named in the sentence near an amount: "At 30 m from it, it begins to brake"."""
        clause = made.clause
        told = clause.named or clause.both or {"trigger", "who"} & set(clause.labels)
        if told or clause.link != "main" or made.kind != "place" or self.words.has(clause.inside, *_STATE):
            return False
        first = self.words.sentence(clause)[0].start
        return self.words.named(range(first, made.at + _FAR + 1)) is None
