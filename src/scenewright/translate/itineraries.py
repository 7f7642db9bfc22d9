"""Chooses the two routes on a map that a description means, and says what had to be inferred.

What enters: `Facts` and a map. What leaves: one route for each actor. Where the words fit no route, or more than one,
it refuses; it never picks one silently.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from scenewright.errors import Place as ErrorPlace
from scenewright.errors import Span, TranslationError
from scenewright.program.types import DEFAULT_MAP
from scenewright.roads import RoadMap, Route, all_routes, find_conflict, load_map, shared_offset_m
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID
from scenewright.translate.facts import Condition, Facts, LaneRelation

COMPASS = {"N": "northbound", "E": "eastbound", "S": "southbound", "W": "westbound"}
OPPOSITE = {"N": "S", "S": "N", "E": "W", "W": "E"}
Pair = tuple[Route, Route]


@dataclass(frozen=True, slots=True)
class Itineraries:
    """The chosen routes and what was assumed to get there."""

    ego: Route
    hero: Route
    assumptions: tuple[str, ...]

    def of(self, actor: int) -> Route:
        """Return the route of an actor."""
        return self.ego if actor == EGO_ID else self.hero

    def share_approach(self) -> bool:
        """Whether both come down the same lane."""
        return self.ego.lanes[0] == self.hero.lanes[0]


@lru_cache(maxsize=1)
def default_map() -> RoadMap:
    """Load the map that descriptions are about where none is named."""
    return load_map(DEFAULT_MAP)


def choose_routes(facts: Facts, road_map: RoadMap, text: str, name: str) -> Itineraries:
    """Return the routes that fit everything said.

    Raises
    ------
    TranslationError
        Where nothing on the map fits, or where the words leave a choice open.
    """
    _one_leader(facts, text, name)
    options = {actor: _options(facts, actor, road_map, text, name) for actor in (EGO_ID, HERO_ID)}
    pairs = [(ego, hero) for ego in options[EGO_ID] for hero in options[HERO_ID]]
    for relation in facts.relations:
        kept = [pair for pair in pairs if _fits(relation, pair, road_map)]
        if not kept:
            span = relation.event.span
            raise TranslationError(
                "no pair of routes on this map fits these words together with the rest",
                place=ErrorPlace(name, text, span),
                found=span.excerpt(text),
                expected=_listed(road_map),
                fix="say where each vehicle comes from and where it goes",
            )
        pairs = kept
    # What a vehicle's own words leave open is filled in before its distance to the other one is used to find its lane.
    pairs, assumptions = _keep_to_road(facts, pairs, described=True)
    pairs = _behind_each_other(facts, pairs, text, name)
    pairs, more = _keep_to_road(facts, pairs, described=False)
    assumptions += more
    shapes = {(ego.headings, hero.headings) for ego, hero in pairs}
    if len(shapes) != 1:
        raise _ambiguous(facts, pairs, text, name)
    ego, hero = pairs[0]
    for actor, route in ((EGO_ID, ego), (HERO_ID, hero)):
        assumptions += _inferred(facts, actor, route, road_map)
    return Itineraries(ego, hero, tuple(assumptions))


def _one_leader(facts: Facts, text: str, name: str) -> None:
    """Refuse a text in which each of the two is in front of the other."""
    leads = [relation for relation in facts.relations if relation.kind in ("lead", "ego_leads")]
    second = next((each for each in leads if each.actor != leads[0].actor), None)
    if second is not None:
        raise TranslationError(
            "each of the two vehicles is said to be in front of the other",
            place=ErrorPlace(name, text, second.event.span),
            found=second.event.span.excerpt(text),
            expected=f"one order, as in '{leads[0].event.span.excerpt(text)}'",
            fix="say who is ahead, once",
        )


def _options(facts: Facts, actor: int, road_map: RoadMap, text: str, name: str) -> list[Route]:
    wishes = facts.wishes[actor]
    options = list(all_routes(road_map))
    for key, said in wishes.items():
        kept = [route for route in options if route_fact(route, key) == said.value]
        if not kept:
            raise TranslationError(
                f"no route on {road_map.name} fits what is said about the {ACTOR_NAMES[actor]}",
                place=ErrorPlace(name, text, said.event.span),
                found=said.event.span.excerpt(text),
                expected=f"one of {_listed(road_map)}",
                fix="check the turn and the directions of travel",
            )
        options = kept
    at_line = any(
        each.actor == actor and each.place is not None and each.place.target == "stop_line"
        for each in (*facts.initial, *facts.trigger)
    )
    # Who is said to be near "its stop line" comes from the minor road, unless something else was said.
    minor = [route for route in options if route.origin_kind == "driveway"]
    return minor if at_line and minor else options


def route_fact(route: Route, key: str) -> str:
    """Return one fact of a route by the name it has among wishes."""
    if key == "origin_heading":
        return route.headings[0]
    if key == "destination_heading":
        return route.headings[-1]
    return str(getattr(route, key))


def _lane_heading(route: Route) -> str:
    """Return the heading of "the ego's lane": the road lane that the route uses."""
    return route.headings[0] if route.origin_kind == "road" else route.headings[-1]


def _fits(relation: LaneRelation, pair: Pair, road_map: RoadMap) -> bool:
    mine, theirs = (pair[0], pair[1]) if relation.actor == EGO_ID else (pair[1], pair[0])
    match relation.kind:
        case "lead" | "ego_leads":
            return mine.lanes[0] == theirs.lanes[0]
        case "oncoming":
            return mine.origin_kind == theirs.origin_kind == "road" and mine.headings[0] == OPPOSITE[theirs.headings[0]]
        case "oncoming_origin":
            return mine.origin_kind == "road" and mine.headings[0] == OPPOSITE[_lane_heading(theirs)]
        case "oncoming_destination":
            return mine.destination_kind == "road" and mine.headings[-1] == OPPOSITE[_lane_heading(theirs)]
        case "lane_origin":
            return mine.origin_kind == "road" and mine.headings[0] == _lane_heading(theirs)
        case "lane_destination":
            return mine.destination_kind == "road" and mine.headings[-1] == _lane_heading(theirs)
        case "in_wanted_lane":
            return (
                mine.origin_kind == "road"
                and theirs.destination_kind == "road"
                and mine.headings[0] == theirs.headings[-1]
            )
        case "driveway_joins":
            joins = [r for r in all_routes(road_map) if r.origin_kind == "driveway" and r.turn == "right"]
            return mine.origin_kind == "road" and any(r.headings[-1] == mine.headings[0] for r in joins)
        case "across":
            conflict = find_conflict(*pair)
            return conflict is not None and conflict.kind == "crossing"
        case "across_or_into":
            return find_conflict(*pair) is not None and mine.lanes[0] != theirs.lanes[0]
        case "driveway_left" | "driveway_right":
            side = relation.kind.removeprefix("driveway_")
            ways = [route for route in all_routes(road_map) if route.lanes[0] == mine.lanes[0] and route.turn == side]
            return mine.origin_kind == "road" and any(route.destination_kind == "driveway" for route in ways)
        case "from_right" | "from_left":
            turned = "ENWS" if relation.kind == "from_right" else "ESWN"
            return mine.headings[0] == turned[(turned.index(theirs.headings[0]) + 1) % 4]
        case _:
            raise ValueError(relation.kind)


def _distances(facts: Facts) -> list[Condition]:
    """Return the conditions that are a distance between the two vehicles."""
    every = (*facts.initial, *facts.trigger)
    return [each for each in every if each.place is not None and isinstance(each.place.target, int)]


def _behind_each_other(facts: Facts, pairs: list[Pair], text: str, name: str) -> list[Pair]:
    """Keep the pairs in which a distance between the two vehicles means something."""
    gaps = _distances(facts)
    if not gaps:
        return pairs
    same = [pair for pair in pairs if pair[0].lanes[0] == pair[1].lanes[0]]
    shared = same or [pair for pair in pairs if shared_offset_m(*pair) is not None]
    if not shared:
        assert gaps[0].place is not None
        span = gaps[0].place.span
        raise TranslationError(
            "a distance between the two vehicles needs a lane that both use",
            place=ErrorPlace(name, text, span),
            found=span.excerpt(text),
            expected="two vehicles behind each other",
            fix="give each one's distance to a stop line or the conflict point",
        )
    return shared


def _keep_to_road(facts: Facts, pairs: list[Pair], *, described: bool) -> tuple[list[Pair], list[str]]:
    """Let a vehicle on the road that is not said to turn go straight on."""
    assumptions = []
    for actor in (EGO_ID, HERO_ID):
        wishes = facts.wishes[actor]
        told = wishes.keys() & {"turn", "destination_kind", "destination_heading"}
        turns = {pair[actor].turn for pair in pairs}
        straight = [pair for pair in pairs if pair[actor].turn == "straight"]
        beside = ("lead", "ego_leads", "oncoming", "from_left", "from_right")
        related = any(relation.kind in beside for relation in facts.relations) or _distances(facts)
        if not told and len(turns) > 1 and straight and (wishes if described else related):
            pairs = straight
            assumptions.append(f"the {ACTOR_NAMES[actor]} goes straight on: no turn of it was mentioned")
    return pairs, assumptions


def _ambiguous(facts: Facts, pairs: list[Pair], text: str, name: str) -> TranslationError:
    for actor in (EGO_ID, HERO_ID):
        routes = list({pair[actor].headings: pair[actor] for pair in pairs}.values())
        if len(routes) > 1:
            break
    who = ACTOR_NAMES[actor]
    said = [item.event.span for item in facts.wishes[actor].values()]
    span = said[0] if said else Span(0, len(text))
    choices = "; ".join(f"{route} ({' then '.join(COMPASS[h] for h in route.headings)})" for route in routes)
    if not said:
        message = f"it is not said where the {who} drives"
    else:
        message = f"it is not clear which way the {who} goes"
    return TranslationError(
        message,
        place=ErrorPlace(name, text, span),
        found=span.excerpt(text) if said else "nothing about its route",
        expected=f"one of: {choices}",
        fix=f"say for example 'the {who} travels westbound' or 'the {who} turns left'",
    )


def _inferred(facts: Facts, actor: int, route: Route, road_map: RoadMap) -> list[str]:
    wishes = facts.wishes[actor]
    told = [key for key in ("origin_kind", "origin_heading", "turn") if key in wishes]
    missing = [key for key in ("origin_kind", "origin_heading", "turn") if key not in told]
    if route.turn == "straight" and "turn" in missing:
        missing.remove("turn")  # said by `_keep_to_road`
    if route.turn == "straight" and "origin_heading" not in missing and "origin_kind" in missing:
        missing.remove("origin_kind")
    if not missing:
        return []
    values = []
    for key in missing:
        value = route_fact(route, key)
        values.append(
            {
                "origin_kind": f"it comes from the {value}",
                "turn": f"it goes {value}" if value == "straight" else f"it turns {value}",
            }.get(key, f"it starts {COMPASS.get(value, value)}")
        )
    reason = f"inferred from the map {road_map.name}: route {', '.join(route.headings)}"
    return [f"{ACTOR_NAMES[actor]}: {', '.join(values)} ({reason})"]


def _listed(road_map: RoadMap) -> str:
    return "; ".join(dict.fromkeys(str(route) for route in all_routes(road_map)))
