"""Asks which routes of a map fit the ways that a text tells, and puts them as `facts` holds them.

What enters: ways, a map. What leaves: wishes by actor. Whether a heading is that of the first road or of the last
follows from the map, or from whether it is told before the turn or after it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from scenewright.roads import RoadMap, Route, all_routes
from scenewright.translate.events import ACTOR_NAMES, EGO_ID, HERO_ID, Event
from scenewright.translate.facts import LaneRelation, Said, WishKey
from scenewright.translate.gist.ways import Way, WayReader
from scenewright.translate.gist.words import Words


def wishes(words: Words, reader: WayReader, road_map: RoadMap) -> dict[int, dict[WishKey, Said]]:
    """Return what each vehicle wants.

    Raises
    ------
    TranslationError
        Where what is said about a vehicle fits no route of the map.
    """
    told = {actor: [way for way in reader.ways if way.actor == actor] for actor in (EGO_ID, HERO_ID)}
    if reader.titles and {each.kind for each in reader.relations} & {"lead", "ego_leads"}:
        for actor, ways in told.items():  # "Car-following, eastbound. The hero leads, the ego follows."
            both = [*ways, *(replace(way, actor=actor) for way in reader.titles)]
            possible = any(all(fits(route, way) for way in both) for route in all_routes(road_map))
            ways[:] = both if possible else ways
    for actor in told:
        told[actor] += _by_title(actor, told, reader.titles, road_map)
    for actor, at in reader.alike:
        if not any(way.key == "turn" for way in told[actor]):
            span = words.tokens[at].span
            told[actor] += [Way(way.key, way.value, at, span, actor) for way in told[1 - actor]]
    found: dict[int, dict[WishKey, Said]] = {}
    for actor, ways in told.items():
        options = [route for route in all_routes(road_map) if all(fits(route, way) for way in ways)]
        if not options:
            raise words.refuse(f"no route fits what is said about the {ACTOR_NAMES[actor]}", ways[-1].span)
        found[actor] = {
            _key(words, way, ways, options): Said(way.value, Event("be", actor, way.span, -1)) for way in ways
        }
    return found


def _by_title(actor: int, told: dict[int, list[Way]], titles: list[Way], road_map: RoadMap) -> list[Way]:
    """Return the ways of a title for the vehicle of which none are told, if the other cannot go them."""
    if told[actor] or not titles or not told[1 - actor]:
        return []
    other = [route for route in all_routes(road_map) if all(fits(route, way) for way in [*told[1 - actor], *titles])]
    return [] if other else [replace(way, actor=actor) for way in titles]


def one_each(words: Words, relations: Sequence[LaneRelation]) -> list[LaneRelation]:
    """Return each relation once; refuse two vehicles that are both in front."""
    kept = list({(each.kind, each.actor): each for each in relations}.values())
    if {"lead", "ego_leads"} <= {each.kind for each in kept}:
        raise words.refuse("each vehicle is said to be in front of the other", kept[-1].event.span)
    return kept


def fits(route: Route, way: Way) -> bool:
    """Whether a route is as a way says."""
    if way.key == "heading":
        return way.value in route.headings
    if way.key == "origin_heading":
        return way.value == route.headings[0]
    return bool(getattr(route, way.key) == way.value)


def _key(words: Words, way: Way, ways: list[Way], options: list[Route]) -> WishKey:
    if way.key != "heading":
        return way.key
    if all(route.headings[0] == way.value for route in options):
        return "origin_heading"
    if all(route.headings[-1] == way.value for route in options):
        return "destination_heading"
    turns = [each.at for each in ways if each.key == "turn" and each.value != "straight" and each.at < way.at]
    return "destination_heading" if any(_goes_on(words, turn, way.at) for turn in turns) else "origin_heading"


def _goes_on(words: Words, turn: int, heading: int) -> bool:
    """Whether a heading is that after the turn: "turns left, eastbound", but not "turns left; it is eastbound"."""
    return not words.has(range(turn, heading), "end", "be", "ego", "hero", "noun")
