"""Reads where each vehicle comes from and goes: headings, turns, areas, and how the two lie to each other.

What enters: words with clauses. What leaves: `Way`s, each of one vehicle or of none ("Eastbound tailing case."), and
lane relations as `facts` holds them. Which routes fit is asked in `wishes`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from scenewright.errors import Span
from scenewright.translate.events import EGO_ID, HERO_ID, Event
from scenewright.translate.facts import LaneRelation
from scenewright.translate.gist.roles import Roles
from scenewright.translate.gist.words import Clause, Words
from scenewright.translate.itineraries import OPPOSITE

Key = Literal["heading", "origin_heading", "turn", "origin_kind", "destination_kind"]
_BESIDE = frozenset(("determiner", "possessive", "actor_adjective", "preposition", "unknown", "heading", "direction"))
_ALONG = ("in", "on", "along")
_DOES = ("does", "doing", "do", "did")
_CROSSING = frozenset(("turn", "pull_out", "cut_in_front", "pass"))


@dataclass(frozen=True, slots=True)
class Way:
    """One word about a way, where it stands, and of whom it is said."""

    key: Key
    value: str
    at: int
    span: Span
    actor: int | None


@dataclass(slots=True)
class WayReader:
    """Collects what is said about ways.

    Attributes
    ----------
    titles
        Ways of no vehicle, which one of them must fit: "Eastbound tailing case."
    alike
        Whose way is like the other's: "makes the same turn".
    unplaced
        Where the driveway is spoken of and it is not understood what a vehicle has to do with it: on a way that does
        not touch the driveway that was misread.
    """

    words: Words
    ways: list[Way] = field(default_factory=list)
    titles: list[Way] = field(default_factory=list)
    relations: list[LaneRelation] = field(default_factory=list)
    alike: list[tuple[int, int]] = field(default_factory=list)
    unplaced: list[tuple[int, Span]] = field(default_factory=list)
    roles: Roles = field(init=False)

    def __post_init__(self) -> None:
        self.roles = Roles(self.words)

    def read(self) -> None:
        """Read every clause, and what names and adjectives say."""
        for clause in self.words.clauses:
            for at in clause.inside if not clause.aside else ():
                self._word(at, clause)
            self._comes_from_there(clause)
        for at in range(len(self.words.tokens)):
            self._same_lane(at)
        for at, said in self.words.names.relative.items():
            self._by_name(said, self.words.names.actors[at], at)
        for at in range(len(self.words.tokens)):
            said = self.words.tag(at, "actor_adjective") or ""
            end = said == "rear" and self.words.word(at + 1) == "end"  # "a rear-end crash"
            if said in ("lead", "rear", "oncoming", "turns_left", "turns_right") and not end:
                self._adjective(at, said)

    def _word(self, at: int, clause: Clause) -> None:
        tags = self.words.tags(at)
        verb, area = tags.get("verb"), tags.get("area")
        if "heading" in tags:
            self._heading(at, clause)
        elif "direction" in tags:
            self._direction(at, clause)
        elif self.words.word(at).startswith("left ") and self.words.tag(at - 1, "verb") == "turn":
            self._say("turn", "left", at, clause.subject, clause)  # "turns left to the road"
        elif (tags.get("pronoun") == "it" or self.words.word(at) == "there") and self.roles.driveway_before(at):
            self._into_it(at, clause)
        elif verb == "lane_follow" or (verb == "go" and self._goes_along(at, clause)):
            self._say("turn", "straight", at, clause.subject, clause)
        elif area == "lane":
            self._lane(at, clause)
        elif area is not None and (verb is None or self.words.has([at - 1], "determiner", "preposition", "possessive")):
            self._area(at, clause)  # "I drive" is no drive
        elif "from_side" in tags and self._is_beside_driveway(at, clause):
            self._say("turn", tags["from_side"].removeprefix("on_"), at, clause.subject, clause)
        elif "from_side" in tags:
            self._relate(tags["from_side"].replace("on_", "from_"), self._whose(at, clause), at)
        elif "oncoming_way" in tags or (verb == "come_towards" and self._meets_someone(at)):
            self._relate("oncoming", self._whose(at, clause), at)
        elif tags.get("relation") in ("ahead", "behind"):
            self._in_line(at, clause)
        elif verb in ("follow", "lead") and "actor_adjective" not in tags and clause.subject is not None:
            self._follows(at, clause, verb)
        elif "direction_noun" in tags and (named := self._goes_there_too(at)) is not None:
            self._same_heading(at, named)
        elif "same" in tags or self.words.word(at) == "likewise":
            self._same(at, clause)
        elif self.words.word(at) in ("so", "as", "and so", "just as") and (alike := self._so_does(at)) is not None:
            self.alike.append((alike, at))

    def _comes_from_there(self, clause: Clause) -> None:
        """Read "into the driveway [that] I am coming out of"."""
        words, before = self.words, clause.start - 1
        before -= words.word(before) in ("that", "which")
        driveway = clause.link == "that" and words.tag(before, "area") == "driveway"
        last = clause.end - 1
        out = words.tag(last, "verb") in ("pull_out", "leave") or words.word(last).split()[-1] in ("from", "of")
        if (
            driveway
            and out
            and clause.subject is not None
            and words.verbs(clause.inside) & {"pull_out", "come", "leave"}
        ):
            self.ways.append(Way("origin_kind", "driveway", last, words.tokens[last].span, clause.subject))

    def _same_lane(self, at: int) -> None:
        """Read "the eastbound lane, in which the ego is already driving": both go that way."""
        words = self.words
        which = words.word(at).endswith(" which") or (words.word(at) == "which" and words.word(at - 1) in _ALONG)
        if not which or words.word(at).split()[0] not in (*_ALONG, "which"):
            return
        back = next((i for i in range(at - 1, max(-1, at - 6), -1) if words.has([i], "heading", "end", "quantity")), at)
        clause = next((each for each in words.clauses if at < each.end and each.end > at + 1), None)
        if "heading" not in words.tags(back) or clause is None or words.has(clause.inside, "heading", "quantity"):
            return
        rest = range(max(at + 1, clause.start), clause.end)
        actor = words.named(rest)
        going = any(words.word(i).endswith(("going", "travelling", "traveling")) for i in rest)
        if actor is not None and (going or words.verbs(rest) & {"drive", "go", "come", "lane_follow", "approach"}):
            self.ways.append(Way("origin_heading", words.tags(back)["heading"], at, words.tokens[at].span, actor))

    def _goes_along(self, at: int, clause: Clause) -> bool:
        """Whether this is "carries on along the road"."""
        ahead = self.words.skip(at + 2, _BESIDE)
        road = self.words.tag(ahead, "area") == "road" and ahead < clause.end
        return (
            road
            and self.words.word(at + 1) in ("along", "down")
            and self.words.word(at).split()[0][:4] in ("carr", "cont", "goes", "keep", "driv", "proc")
        )

    # -- headings and turns -------------------------------------------------------------------------------------------
    def _heading(self, at: int, clause: Clause) -> None:
        value, back = self.words.tags(at)["heading"], at - 1
        while "determiner" in self.words.tags(back):
            back -= 1
        lane = self.words.has([at + 1], "area", "noun", "hero", "side_noun")
        comes_from = False
        if self.words.word(back).split()[-1:] == ["from"] and not lane and not self.words.word(at).endswith("bound"):
            value, comes_from = OPPOSITE[value], True  # who comes from the east drives west
        from_lane = self.words.word(back) == "from" and self.words.has([at + 1], "area", "side_noun")
        comes = "ing" in self.words.tokens[at - 1].forms and at - 2 in self.words.names.actors
        if at > 1 and comes and self.words.has([at - 1], "verb"):  # "across a target coming westbound"
            owner = self.words.names.actors[at - 2]
            self.ways.append(Way("heading", value, at, self.words.tokens[at].span, owner))
            return
        over = self.words.tag(back, "verb") == "pass" or self.words.word(back).split()[-1:] in (["across"], ["over"])
        if over and self.words.tag(at + 1, "area") == "lane":
            return  # "has to cross the westbound lane"
        named = self.words.skip(at + 1, frozenset(("actor_adjective",)))
        if clause.both and len(clause.inside) == 1 and clause.start - 2 in self.words.names.actors:
            actor = self.words.names.actors[clause.start - 2]  # "a van and the AV, eastbound, have one goal"
            self.ways.append(Way("heading", value, at, self.words.tokens[at].span, actor))
            return
        if clause.both and named in self.words.names.actors:  # "a westbound pickup and the AV have one goal"
            self.ways.append(Way("heading", value, at, self.words.tokens[at].span, self.words.names.actors[named]))
            return
        shared = any(self.words.word(i).startswith("shar") for i in range(clause.start, at))
        if shared and self.words.named(range(at, clause.end)) is not None:  # "shares the westbound lane with the ego"
            self.ways += [
                Way("origin_heading", value, at, self.words.tokens[at].span, each) for each in (EGO_ID, HERO_ID)
            ]
            return
        key: Key = "origin_heading" if from_lane or comes_from else "heading"  # "a right turn from the westbound lane"
        self._say(key, value, at, self._whose(at, clause), clause)

    def _direction(self, at: int, clause: Clause) -> None:
        value, before, after = self.words.tags(at)["direction"], self.words.tags(at - 1), self.words.tags(at + 1)
        if value != "straight":
            if self.roles.is_no_turn(at):
                return
            if "genitive" in before and at - 2 in self.words.names.actors and after.get("event_noun") == "turn":
                self._say("turn", value, at, self.words.names.actors[at - 2], clause)  # "the AV's left turn"
                return
            if "genitive" in before and at - 2 in self.words.names.actors:
                self._relate(f"from_{value}", clause.subject, at)  # "from the ego's left"
                return
            whose = before.get("determiner") == "our" or self.words.word(at - 1) == "your"
            aside = whose and self.words.tag(at - 2, "preposition") in ("out", "on")
            if aside and (after.keys() & {"end", "comma", "link", "determiner"}):
                other = HERO_ID if clause.subject is None or "determiner" in after else clause.subject
                self._relate(f"from_{value}", other, at)  # "from my left"
                return
            verbless = not self.words.has(clause.inside, "verb", "be") and after.get("preposition") in ("out", "into")
            closes = verbless or after.keys() & {"end", "comma", "link"}
            if (
                at - 1 in self.words.names.actors and closes
            ):  # "the ego turns right, the car left", "ego left out of it"
                self._say("turn", value, at, self.words.names.actors[at - 1], clause)
                return
            if (
                not self.roles.is_turn(at)
                and self.roles.is_title(clause)
                and after.keys() & {"event_noun", "verb"}
                and clause.subject is None
            ):
                return  # "Two crossing left turns are studied."
            title = "actor_adjective" in before and not any(i < at for i in self.words.names.actors)
            if title and not self.roles.is_turn(at):  # "This is the classic unprotected left where ..."
                self.titles.append(Way("turn", value, at, self.words.tokens[at].span, None))
                return
            if not self.roles.is_turn(at):
                raise self.words.refuse("it is not clear who turns here", self.words.tokens[at].span)
        owner = self._let(at, clause)
        if "noun" in after and "verb" not in before:
            owner = self.words.names.actors.get(at + 1, owner)
        self._say("turn", value, at, owner, clause)

    def _let(self, at: int, clause: Clause) -> int | None:
        """Return who is let go this way, in "lets the ego make its left turn"; else whom the clause is about."""
        let = self.words.where(range(clause.start, at), "verb", "let")
        named = self.words.named(range(let + 1, min(let + 4, at))) if let is not None else None
        return named if named is not None else clause.subject

    def _goes_there_too(self, at: int) -> int | None:
        """Return who is named in "the direction in which the ego is driving", "the direction of the ego"."""
        if self.words.word(at + 1) not in ("in which", "of", "that", "which"):
            return None
        name = self.words.skip(at + 2, _BESIDE)
        return self.words.names.actors.get(name) if self.words.has([at - 1], "determiner", "same") else None

    def _same_heading(self, at: int, actor: int) -> None:
        """Let a vehicle go where the other one was said to go."""
        back = self.words.where(range(at - 1, -1, -1), "heading")
        first = self.words.sentence_at(max(0, self.words.sentence_at(at).start - 1)).start
        if back is not None and back >= first:
            value, span = self.words.tags(back)["heading"], self.words.tokens[at].span
            self.ways.append(Way("heading", value, at, span, actor))

    def _same(self, at: int, clause: Clause) -> None:
        """Read "makes the same turn", "heading the same way", "with the same intention"."""
        does = self.words.tag(at - 1, "verb") == "make" or self.words.word(at - 2) in _DOES
        does = does or (self.words.tag(at - 2, "adverb") == "exact" and self.words.word(at - 3) in _DOES)
        if does and self.words.has([at + 1], "end", "comma", "relation") and clause.subject is not None:
            self.alike.append((clause.subject, at))  # "does the same"
            return
        for ahead in (at + 1, at + 2):
            alike = self.words.tag(ahead, "event_noun") == "turn" or self.words.word(ahead) in (
                "way",
                "thing",
                "direction",
            )
            if clause.subject is not None and (
                alike or self.words.has([ahead], "direction_noun", "intent_noun", "wanting")
            ):
                self.alike.append((clause.subject, at))
                return

    def _so_does(self, at: int) -> int | None:
        """Return who does as the other one, in "and so is the hero", "as does the van"."""
        if not self.words.has([at + 1], "be", "auxiliary") and self.words.tag(at + 1, "verb") != "do_so":
            return None
        named = self.words.skip(at + 2, frozenset(("determiner", "actor_adjective")))
        ends = self.words.has([named + 1], "end", "comma", "relation") or self.words.has([named + 1], "link")
        if not ends or named not in self.words.names.actors:
            return None
        before = [each for each in self.words.clauses if each.end <= at][-1:]
        if any(self.words.has(each.inside, "quantity") for each in before):
            raise self.words.refuse("it is not clear what is alike", self.words.tokens[at].span)  # the place too?
        return self.words.names.actors[named]

    # -- areas --------------------------------------------------------------------------------------------------------

    def _meets_someone(self, at: int) -> bool:
        """Whether this is "comes towards it"; "comes towards the driveway" is not."""
        ahead = self.words.skip(at + 1, _BESIDE)
        return ahead in self.words.names.actors or ahead in self.words.names.pronouns

    def _is_beside_driveway(self, at: int, clause: Clause) -> bool:
        """Whether this is "for the driveway on its left", which tells a turn."""
        on = self.words.tags(at)["from_side"].startswith("on_") and self.words.tag(at - 1, "area") == "driveway"
        return on and clause.subject is not None and self.roles.role(at - 1, clause) == "into"

    def _into_it(self, at: int, clause: Clause) -> None:
        before = self.words.tags(at - 1)
        if self.words.word(at - 1) == "onto":  # nobody drives onto a driveway: the road is meant
            self._say("origin_kind", "driveway", at, clause.subject, clause)
        elif before.get("preposition") == "into" or before.get("verb") == "enter":
            self._say("destination_kind", "driveway", at, clause.subject, clause)
        out = before.get("preposition") == "out" and "relation" not in before
        if out or before.get("verb") == "leave" or "out of" in self.words.word(at - 1):
            self._say("origin_kind", "driveway", at, clause.subject, clause)

    def _area(self, at: int, clause: Clause) -> None:
        kind, role = self.words.tags(at)["area"], self.roles.role(at, clause)
        if role == "past":
            if kind == "driveway" and clause.subject is not None and clause.link not in ("before", "after", "until"):
                self._say("turn", "straight", at, clause.subject, clause)
        elif self._let(at, clause) != clause.subject and role is not None and kind == "driveway":
            key: Key = "destination_kind" if role == "into" else "origin_kind"
            self.ways.append(Way(key, "driveway", at, self.words.tokens[at].span, self._let(at, clause)))
        elif role in ("into", "from") and kind == "driveway" and clause.subject is None and not clause.both:
            if self.roles.is_title(clause):  # "It has to wait with its left turn into the driveway."
                place: Key = "destination_kind" if role == "into" else "origin_kind"
                self.titles.append(Way(place, "driveway", at, self.words.tokens[at].span, None))
        elif role is None and kind == "driveway" and clause.subject is not None and not clause.both:
            if not self.words.has(range(max(clause.start, at - 6), at), "quantity"):
                self.unplaced.append((clause.subject, self.words.tokens[at].span))
        elif role is not None and (clause.subject is not None or clause.both):
            if kind == "driveway":
                self._say(
                    "destination_kind" if role == "into" else "origin_kind", "driveway", at, clause.subject, clause
                )
            elif role == "into":
                self._say("origin_kind", "driveway", at, clause.subject, clause)
            else:  # "on the road", "leaves the road"
                self._say("origin_kind", "road", at, clause.subject, clause)

    def _lane(self, at: int, clause: Clause) -> None:
        """Read "into the ego's lane" and "into the lane that the ego is using"."""
        around = self.words.named(i for i in range(at - 3, at + 4) if self.words.names.actors.get(i) == EGO_ID)
        into = self.words.where(range(at - 4, at), "preposition", "into")
        if around is not None and into is not None and clause.subject == HERO_ID:
            self._relate("lane_destination", HERO_ID, at)

    # -- behind each other --------------------------------------------------------------------------------------------
    def _whose(self, at: int, clause: Clause) -> int | None:
        """Return whose an adjective is: "the eastbound car"; else whom the clause is about."""
        ahead = self.words.skip(at + 1, frozenset(("actor_adjective", "direction", "unknown")))
        if self.words.has([ahead], "noun", "hero", "ego", "actor_adjective"):
            return self.words.names.actors.get(ahead, clause.subject)
        return clause.subject

    def _follows(self, at: int, clause: Clause, verb: str) -> None:
        near = range(at + 1, at + 4)
        noun = self.words.has([at - 1], "determiner")
        noun = noun and (verb == "lead" or self.words.has([at + 1], "colon", "end", "comma"))  # "the lead brakes"
        if noun or self.words.word(at - 1) in ("one", "path", "way", "course", "lane", "route"):
            return  # "its path leading past the driveway", "I need the following:", "one following the other"
        if self.words.has(near, "through") or self.words.has(range(at + 1, at + 3), "landmark"):
            return  # "then follows it through the conflict point", "stays behind its stop line"
        road = "pronoun" in self.words.tags(at + 1) and self.roles.road_before(at)
        if verb == "follow" and road:  # "is on the road and follows it"
            self._say("turn", "straight", at, clause.subject, clause)
        elif clause.subject is not None and (
            any(i in self.words.names.actors or i in self.words.names.pronouns for i in near)
            or (self.words.has([at + 1], "end", "comma") and at - 1 in self.words.names.actors)  # "The ego leads."
        ):
            first = clause.subject
            if "ed" in self.words.tokens[at].forms and self.words.word(at + 1) == "by":  # "is preceded by a van"
                first = self.words.names.actors.get(self.words.skip(at + 2, _BESIDE), 1 - first)
            ahead = first if verb == "lead" else 1 - first
            self._relate("lead" if ahead == HERO_ID else "ego_leads", ahead, at)

    def _in_line(self, at: int, clause: Clause) -> None:
        """Read "in front of the ego": who is ahead, where both are in one lane."""
        names, value = self.words.names, self.words.tags(at)["relation"]
        crosses = bool(self.words.verbs(range(clause.start, at)) & _CROSSING)
        strange = any(
            "unknown" in self.words.tags(back) and back not in names.actors
            for back in range(max(clause.start, at - 2), at)
        )
        to_line = "landmark" in self.words.tags(self.words.skip(at + 1, _BESIDE) + 1)
        enters = self.words.tag(at - 1, "area") == "driveway" and self.roles.role(at - 1, clause) == "into"
        turned = self.words.where(range(clause.start, at), "direction", "left", "right") is not None
        crosses = crosses or (
            turned and "preposition" not in self.words.tags(at - 1)
        )  # "out to the left in front of us"
        strange = strange or self.words.has([at - 1], "event_noun", "landmark")  # "with no turn ahead of it"
        index = self.words.clauses.index(clause)
        before = self.words.clauses[index - 1] if index else clause
        if at == clause.start and before.sentence == clause.sentence and before is not clause:
            turns = self.words.where(before.inside, "direction", "left", "right") is not None
            crosses = crosses or (
                turns and self.words.named(clause.inside) is not None
            )  # "turn right, ahead of the van"
        if "quantity" in self.words.tags(at - 1) or crosses or strange or to_line or enters:
            return  # "sneaks in ahead of us" tells no order in a lane
        ahead = self.words.skip(at + 1, _BESIDE)
        other, mine = names.actors.get(ahead), clause.subject
        if other is not None and not self.words.word(at).endswith((" of", "behind", "ahead")):
            other, mine = 1 - other, other  # "in front the hero, at the rear the ego"
        if at == clause.start and ahead in names.pronouns and ahead == clause.end - 1:
            following = next((c for c in self.words.sentence(clause) if c.start > clause.start), None)
            mine = following.subject if following is not None and following.named else mine  # "and, behind it, the ego"
        near = self.words.named(range(at - 1, max(clause.start - 1, at - 4), -1))
        mine = near if near is not None else mine
        ends = self.words.has([ahead], "end", "comma", "link") or ahead >= len(self.words.tokens)
        ends = ends or self.words.tag(at + 1, "preposition") in ("in", "on")
        if other is None and mine is not None and (ahead in names.pronouns or ends):
            other = 1 - mine
        if other is not None:
            front = 1 - other if value == "ahead" else other
            self._relate("lead" if front == HERO_ID else "ego_leads", front, at)

    def _by_name(self, said: str, actor: int, at: int) -> None:
        """Read "the one in front", "the left turner", "the lead car"."""
        if said in ("lead", "rear"):
            front = actor if said == "lead" else 1 - actor
            self._relate("lead" if front == HERO_ID else "ego_leads", front, at)
        else:
            self.ways.append(Way("turn", said, at, self.words.tokens[at].span, actor))

    def _adjective(self, at: int, said: str) -> None:
        ahead = self.words.skip(at + 1, frozenset(("actor_adjective", "heading", "unknown", "direction")))
        actor = self.words.names.actors.get(at, self.words.names.actors.get(ahead))
        if actor is None and "determiner" in self.words.tags(at - 1) and "relation" in self.words.tags(at - 2):
            return  # "18 m behind the lead"
        if actor is None:
            actor = next((each.subject for each in self.words.clauses if at in each.inside), None)
        if actor is None:
            return
        if said == "oncoming":
            self._relate("oncoming", actor, at)
        else:
            self._by_name(said.removeprefix("turns_"), actor, at)

    # -- what was found -----------------------------------------------------------------------------------------------
    def _say(self, key: Key, value: str, at: int, actor: int | None, clause: Clause) -> None:
        span = self.words.tokens[at].span
        marks = [i for i in clause.inside if i in self.words.names.both]
        if clause.pair or (clause.both and (not clause.named or any(mark < at for mark in marks))):
            self.ways += [Way(key, value, at, span, EGO_ID), Way(key, value, at, span, HERO_ID)]
        elif actor is None and self.roles.is_title(clause):
            self.titles.append(Way(key, value, at, span, None))
        elif actor is None:
            raise self.words.refuse("it is not clear whose way this is", span)
        else:
            self.ways.append(Way(key, value, at, span, actor))

    def _relate(self, kind: str, actor: int | None, at: int) -> None:
        if actor is not None:
            self.relations.append(LaneRelation(kind, actor, Event("be", actor, self.words.tokens[at].span, -1)))
