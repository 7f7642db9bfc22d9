"""Reads where each vehicle comes from and goes: headings, turns, areas, and how the two lie to each other.

What enters: tokens, names, clauses and a map. What leaves: wishes and relations, as `facts` holds them, and the words about
ways that no vehicle could be found for.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Span
from scenewright.roads import RoadMap, Route, all_routes
from scenewright.translate.events import EGO_ID, HERO_ID, Event
from scenewright.translate.facts import LaneRelation, Said, WishKey
from scenewright.translate.gist.clauses import Clause
from scenewright.translate.gist.names import Names
from scenewright.translate.itineraries import OPPOSITE
from scenewright.translate.tokens import Token

_INTO = frozenset(("into",))
_FROM = frozenset(("out",))
_LEAVING = frozenset(("leave", "pull_out"))
_VEHICLE = frozenset(("noun", "hero", "ego", "actor_adjective"))


@dataclass(slots=True)
class Way:
    """One word about a way, and of whom it is said."""

    key: str  # heading, turn, origin_kind, destination_kind
    value: str
    span: Span
    actor: int | None


@dataclass(slots=True)
class WayReader:
    """Collects what is said about ways."""

    tokens: list[Token]
    names: Names
    clauses: list[Clause]
    ways: list[Way] = field(default_factory=list)
    relations: list[LaneRelation] = field(default_factory=list)
    strays: list[Span] = field(default_factory=list)
    titles: list[Way] = field(default_factory=list)  # told of no vehicle: "Eastbound tailing case."
    alike: list[tuple[int, Span]] = field(default_factory=list)  # "the same turn": whose is like the other's

    def read(self) -> None:
        """Read every clause."""
        for clause in self.clauses:
            for at in range(clause.start, clause.end):
                if not clause.aside:
                    self._word(at, clause)
        for at, said in self.names.relative.items():
            actor = self.names.actors[at]
            self._told_by_name(said, actor, self.tokens[at].span)
        for at, token in enumerate(self.tokens):
            adjective = token.tags.get("actor_adjective")
            if adjective in ("lead", "rear", "oncoming", "turns_left", "turns_right"):
                self._adjective(at, adjective)

    def _word(self, at: int, clause: Clause) -> None:
        token = self.tokens[at]
        tags = token.tags
        if "heading" in tags:
            value = tags["heading"]
            back = at - 1
            while back >= 0 and "determiner" in self.tokens[back].tags:
                back -= 1
            lane = at + 1 < len(self.tokens) and self.tokens[at + 1].tags.keys() & {"area", "noun", "hero"}
            if back >= 0 and self.tokens[back].text.lower() == "from" and not lane:
                value = OPPOSITE[value]
            self._say("heading", value, token.span, self._whose(at, clause), clause)
        elif "direction" in tags:
            self._direction(at, clause)
        elif tags.get("pronoun") == "it" and at and self._driveway_before(at):
            before = self.tokens[at - 1].tags
            if before.get("preposition") == "into" or before.get("verb") == "enter":
                self._say("destination_kind", "driveway", token.span, clause.subject, clause)
            elif before.get("verb") == "leave" or "out of" in self.tokens[at - 1].text.lower() or before.get("preposition") == "out" and "relation" not in before:
                self._say("origin_kind", "driveway", token.span, clause.subject, clause)
        elif tags.get("verb") == "lane_follow":
            self._say("turn", "straight", token.span, clause.subject, clause)
        elif tags.get("area") == "lane":
            self._lane(at, clause)
        elif "area" in tags and "verb" in tags and not (at and self.tokens[at - 1].tags.keys() & {"determiner", "preposition", "possessive"}):
            return  # "I drive", no drive
        elif tags.get("area") in ("driveway", "road"):
            self._area(at, clause)
        elif "from_side" in tags:
            self._relate(tags["from_side"].replace("on_", "from_"), self._whose(at, clause), token.span)
        elif "oncoming_way" in tags:
            self._relate("oncoming", self._whose(at, clause), token.span)
        elif tags.get("relation") in ("ahead", "behind"):
            self._in_line(at, clause)
        elif tags.get("verb") in ("follow", "lead") and "actor_adjective" not in tags and clause.subject is not None:
            others = self.tokens[at + 1 : at + 4]
            if not any(i in self.names.actors or i in self.names.pronouns for i in range(at + 1, at + 1 + len(others))):
                return
            ahead = clause.subject if tags["verb"] == "lead" else 1 - clause.subject
            self._relate("lead" if ahead == HERO_ID else "ego_leads", ahead, token.span)
        elif "same" in tags or token.text.lower() == "likewise":
            following = self.tokens[at + 1 : at + 3]
            if any(each.tags.get("event_noun") == "turn" or each.text.lower() in ("way", "thing", "direction") or each.tags.keys() & {"direction_noun", "intent_noun", "wanting"} for each in following):
                if clause.subject is not None:
                    self.alike.append((clause.subject, token.span))

    def _driveway_before(self, at: int) -> bool:
        """Whether the driveway was the area named last: "comes out of it"."""
        back = next((b for b in range(at - 1, -1, -1) if "area" in self.tokens[b].tags), None)
        return back is not None and self.tokens[back].tags["area"] == "driveway"

    def _direction(self, at: int, clause: Clause) -> None:
        token, value = self.tokens[at], self.tokens[at].tags["direction"]
        before = self.tokens[at - 1].tags if at else {}
        after = self.tokens[at + 1].tags if at + 1 < len(self.tokens) else {}
        if value != "straight":
            if after.get("relation") in ("ahead", "behind"):
                return  # "right in front of me"
            if "genitive" in before and "link" in after or token.text.lower() == "right" and after.get("preposition") == "of":
                return  # "right of way"
            if "genitive" in before and at > 1 and at - 2 in self.names.actors:
                self._relate(f"from_{value}", clause.subject, token.span)
                return
            if at - 1 in self.names.actors and after.keys() & {"end", "comma", "link"} and "relation" not in after:
                self._say("turn", value, token.span, self.names.actors[at - 1], clause)  # "the ego turns right, the car left"
                return
            if token.tags.get("adverb") == "just" and after.get("preposition") == "at":
                return  # "stops right at the stop line"
            if "quantity" in before or ("left_over" in token.tags and after.get("preposition") == "to" and "link" not in before and "verb" not in before):
                return  # "30 m left to the stop line"
            turns = "turn" in (after.get("verb"), after.get("event_noun"), before.get("verb"), before.get("event_noun"))
            if token.tags.get("adverb") == "just" and after.keys() & {"relation"} and before.keys() & {"noun", "hero", "ego"}:
                return  # "right in front of me"
            turns = turns or "unknown" in before or before.get("verb") in ("go", "pull_out", "drive", "make", "come", "want") or before.get("preposition") == "to"
            turns = turns or before.keys() & {"determiner", "possessive", "comma", "colon", "end", "link", "area", "heading", "preposition"} or not before or "wanting" in before
            free = not after or after.keys() & {"end", "comma", "heading", "preposition", "link", "event_noun", "verb", "area", "unknown", "colon", "adverb", "relation", "pair", "auxiliary", "be", "negation", "side_noun"}
            if token.tags.get("adverb") == "just" and after.keys() & {"relation", "link"} and not turns:
                return
            if not turns or not free:
                self.strays.append(token.span)
                return
        if after.keys() & {"noun"} and "verb" not in before:
            self._say("turn", value, token.span, self.names.actors.get(at + 1, clause.subject), clause)
            return
        self._say("turn", value, token.span, clause.subject, clause)

    def _area(self, at: int, clause: Clause) -> None:
        kind = self.tokens[at].tags["area"]
        role, back = None, at - 1
        while back >= 0 and self.tokens[back].tags.keys() & {"determiner", "possessive", "area_adjective", "same", "side", "our", "adverb", "unknown"} and (
            "determiner" in self.tokens[back].tags or not self.tokens[back].tags.keys() & {"verb", "preposition", "link"}
        ):
            back -= 1
        tags = self.tokens[back].tags if back >= 0 else {}
        word = self.tokens[back].text.lower() if back >= 0 else ""
        verb = tags.get("verb")
        if tags.get("preposition") == "into" or verb in ("enter", "want") or word in ("for", "onto", "into"):
            role = "into"
        elif tags.get("preposition") == "out" or verb in _LEAVING or word in ("from", "down") or "out of" in word:
            role = "from"
        elif tags.get("relation") == "past" or verb == "pass":
            if clause.subject is not None and kind == "driveway" and clause.link not in ("before", "after", "until"):
                self._say("turn", "straight", self.tokens[at].span, clause.subject, clause)
            return
        elif tags.get("preposition") == "of" and back and self.tokens[back - 1].tags.keys() & {"mouth", "landmark"}:
            role = "on"  # "at the end of the driveway"
        elif tags.get("relation") is not None or tags.get("preposition") in ("of", "to", "at", "between"):
            if verb is None and tags.get("preposition") == "to" and "link" in tags and kind == "driveway":
                return
            return
        elif tags.get("preposition") in ("on", "in", "with") or not tags or tags.keys() & {"comma", "end", "colon"}:
            role = None if back > clause.start and "unknown" in self.tokens[back - 1].tags and (back - 1) not in self.names.actors else "on"
        passive = any("be" in t.tags for t in self.tokens[at : clause.end])
        verbs = {t.tags.get("verb") for t in self.tokens[at : clause.end]}
        if role == "on" and passive and verbs & {"enter", "leave"}:
            role = "into" if "enter" in verbs else "from"  # "the driveway is entered by a van"
        if role is None:
            return
        subject = clause.subject
        if subject is None and not clause.both:
            return  # only a place that is spoken of
        span = self.tokens[at].span
        if kind == "driveway":
            key = "destination_kind" if role == "into" else "origin_kind"
            self._say(key, "driveway", span, subject, clause)
        elif role == "into":
            self._say("origin_kind", "driveway", span, subject, clause)
        elif role == "on":
            self._say("origin_kind", "road", span, subject, clause)

    def _lane(self, at: int, clause: Clause) -> None:
        """Read "into the ego's lane" and "into the lane that the ego is using"."""
        around = [i for i in range(max(0, at - 3), min(at + 4, len(self.tokens))) if self.names.actors.get(i) == EGO_ID]
        into = any(self.tokens[b].tags.get("preposition") == "into" for b in range(max(0, at - 4), at))
        if around and into and clause.subject == HERO_ID:
            self._relate("lane_destination", HERO_ID, self.tokens[at].span)

    def _whose(self, at: int, clause: Clause) -> int | None:
        """Return whose an adjective is: "the eastbound car"; else whom the clause is about."""
        ahead = at + 1
        while ahead < len(self.tokens) and self.tokens[ahead].tags.keys() & {"actor_adjective", "direction", "unknown"} and ahead not in self.names.actors:
            ahead += 1
        if ahead in self.names.actors and self.tokens[ahead].tags.keys() & _VEHICLE:
            return self.names.actors[ahead]
        return clause.subject

    def _in_line(self, at: int, clause: Clause) -> None:
        """Read "in front of the ego": who is ahead, where both are in one lane."""
        if at and "quantity" in self.tokens[at - 1].tags:
            return
        if any("unknown" in self.tokens[b].tags and b not in self.names.actors for b in range(max(clause.start, at - 2), at)):
            return  # "sneaks in ahead of us"
        if any(self.tokens[b].tags.get("verb") in ("turn", "pull_out", "cut_in_front", "pass") for b in range(clause.start, at)):
            return
        value = self.tokens[at].tags["relation"]
        ahead = at + 1
        while ahead < len(self.tokens) and self.tokens[ahead].tags.keys() & {"determiner", "possessive", "actor_adjective", "preposition", "unknown"} and ahead not in self.names.actors and ahead not in self.names.pronouns:
            ahead += 1
        other = self.names.actors.get(ahead)
        mine = clause.subject
        if at == clause.start and ahead in self.names.pronouns and ahead == clause.end - 1:  # "and, behind it, the ego"
            following = next((c for c in self.clauses if c.start > clause.start and c.sentence == clause.sentence), None)
            mine = following.subject if following is not None and following.named else mine
        for back in range(at - 1, max(clause.start - 1, at - 4), -1):
            if back in self.names.actors:
                mine = self.names.actors[back]
                break
        if other is None and ahead in self.names.pronouns and mine is not None:
            other = 1 - mine
        if other is None and (ahead >= len(self.tokens) or self.tokens[ahead].tags.keys() & {"end", "comma", "link"}) and mine is not None:
            other = 1 - mine
        if other is None:
            return
        front = 1 - other if value == "ahead" else other
        self._relate("lead" if front == HERO_ID else "ego_leads", front, self.tokens[at].span)

    def _told_by_name(self, said: str, actor: int, span: Span) -> None:
        if said == "lead":
            self._relate("lead" if actor == HERO_ID else "ego_leads", actor, span)
        elif said == "rear":
            self._relate("ego_leads" if actor == HERO_ID else "lead", 1 - actor, span)
        else:
            self.ways.append(Way("turn", said, span, actor))

    def _adjective(self, at: int, said: str) -> None:
        ahead = at + 1
        while ahead < len(self.tokens) and self.tokens[ahead].tags.keys() & {"actor_adjective", "heading", "unknown", "direction"} and ahead not in self.names.actors:
            ahead += 1
        actor = self.names.actors.get(at, self.names.actors.get(ahead))
        if actor is None:
            clause = next((each for each in self.clauses if each.start <= at < each.end), None)
            actor = clause.subject if clause is not None else None
        if actor is None:
            return
        if said == "oncoming":
            self._relate("oncoming", actor, self.tokens[at].span)
        elif said in ("lead", "rear"):
            self._told_by_name(said, actor, self.tokens[at].span)
        else:
            self.ways.append(Way("turn", said.removeprefix("turns_"), self.tokens[at].span, actor))

    def _say(self, key: str, value: str, span: Span, actor: int | None, clause: Clause) -> None:
        if actor is None and not clause.both:
            inside = [c for c in self.clauses if c.sentence == clause.sentence]
            named = any(at in self.names.actors or at in self.names.pronouns for c in inside for at in range(c.start, c.end))
            if not named or not any(at < clause.end for at in self.names.actors):
                self.titles.append(Way(key, value, span, None))
                return
        if clause.both and not clause.named:
            self.ways += [Way(key, value, span, EGO_ID), Way(key, value, span, HERO_ID)]
        else:
            self.ways.append(Way(key, value, span, actor))

    def _relate(self, kind: str, actor: int | None, span: Span) -> None:
        if actor is not None:
            self.relations.append(LaneRelation(kind, actor, Event("be", actor, span, -1)))

    # -- wishes -------------------------------------------------------------------------------------------------------
    def wishes(self, road_map: RoadMap) -> dict[int, dict[WishKey, Said]]:
        """Return what each vehicle wants, with headings told apart by what fits the map."""
        found: dict[int, dict[WishKey, Said]] = {EGO_ID: {}, HERO_ID: {}}
        told = {actor: [way for way in self.ways if way.actor == actor] for actor in found}
        for actor, span in self.alike:
            if not any(way.key == "turn" for way in told[actor]):
                told[actor] += [Way(w.key, w.value, span, actor) for w in told[1 - actor] if w.key != "heading" or True]
        for actor, ways in told.items():
            options = [route for route in all_routes(road_map) if all(_fits(route, way) for way in ways)]
            for way in ways:
                key = _wish_key(way, options)
                said = Said(way.value, Event("be", actor, way.span, -1))
                if key in found[actor] and found[actor][key].value != way.value:
                    found[actor][key] = said  # refused later: two values fit no route
                    options = []
                found[actor][key] = found[actor].get(key, said)
            if ways and not options:
                raise _Clash(actor, ways)
        return found


class _Clash(Exception):
    """Raised where what is said about one vehicle fits no route."""

    def __init__(self, actor: int, ways: list[Way]) -> None:
        super().__init__(actor)
        self.actor, self.ways = actor, ways


def _fits(route: Route, way: Way) -> bool:
    if way.key == "heading":
        return way.value in route.headings
    return bool(getattr(route, way.key) == way.value)


def _wish_key(way: Way, options: list[Route]) -> WishKey:
    if way.key != "heading":
        return way.key  # type: ignore[return-value]
    last = options and all(route.headings[-1] == way.value for route in options)
    first = options and all(route.headings[0] == way.value for route in options)
    return "destination_heading" if last and not first else "origin_heading"
