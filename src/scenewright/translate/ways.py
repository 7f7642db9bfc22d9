"""Puts the ways of a story on a map: whole routes where one fits the partial facts, questions where several do.

What enters: a `Story` and a `RoadMap`. What leaves: the story with the ways that its map leaves, who is ahead of whom
as a condition at the start, and a question with all ways that fit where there are more than one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from scenewright.errors import TranslationError
from scenewright.program.types import HeadingsRoute, LanesRoute
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route, all_routes, find_routes
from scenewright.translate import story as st
from scenewright.translate.compile import COMPASS, route_of
from scenewright.translate.decompile import way_of
from scenewright.translate.phrases import TURNING, Phrases, sentence

_INSTEAD = "it passes the conflict point"
# How somebody's way begins against another's, in quarters of the compass to the right of it.
BEARINGS = {"oncoming": 2, "from the left": 1, "from the right": 3, "ahead": 0, "behind": 0, "same way": 0}
IN_LINE = ("ahead", "behind", "same way")
_APART = (st.Quantity.GAP, st.Quantity.FREE_SPACE, st.Quantity.HEADWAY)


def put_on_map(story: st.Story, road_map: RoadMap, answers: Mapping[str, str] | None = None) -> st.Story:
    """Return `story` with whole ways; raises `TranslationError` where none on the map fits what is said of somebody."""
    story = _in_one_lane(story)
    fitting = {actor.id: _fitting(actor, road_map) for actor in story.actors}
    for _ in story.actors:  # what one relation leaves may decide another
        for actor in story.actors:
            for relation in actor.relations:
                _keep_related(fitting, actor.id, relation)
    phrases, questions, assumed, settled = Phrases(story), [*story.questions], [*story.assumptions], list[st.Actor]()
    for actor in story.actors:
        found = list(dict.fromkeys(_way(route, road_map) for route in fitting[actor.id]))
        if not found:
            there_are = "; ".join(dict.fromkeys(phrases.way(_way(route, road_map)) for route in all_routes(road_map)))
            message = f"no way on {road_map.name} fits what is said of {phrases.name(actor.id)}"
            expected = f"one of: {there_are}" if there_are else "a map with at least one way through"
            raise TranslationError(message, found=phrases.way(actor.way), expected=expected)
        straights = [number for number, way in enumerate(found) if way.turn == "straight"]
        if len(straights) == 1 < len(found) and not _is_open(actor, story):
            found = [found[straights[0]]]
            assumed.append(f"{actor.name} goes straight on")
        if len(found) > 1:
            asked, told_ways = f"Which way does {phrases.name(actor.id)} go?", tuple(map(phrases.way, found))
            question = st.Question(f"way of {actor.name}", asked, told_ways, next(iter(straights), 0), actor.quote)
            told = (answers or {}).get(question.slot, "")
            if told not in question.alternatives:
                questions.append(question)
                told = question.alternatives[question.default or 0]
            found = [found[question.alternatives.index(told)]]
        relations = tuple(each for each in actor.relations if each.kind not in BEARINGS)
        settled.append(replace(actor, way=found[0], relations=relations))
    placed = replace(_in_line(story), actors=tuple(settled), questions=tuple(questions), assumptions=tuple(assumed))
    return _fits_ways(placed, answers or {})


def _in_one_lane(story: st.Story) -> st.Story:
    """Let somebody of whose way nothing is told be in one lane with whom it has a distance at the start to."""
    pairs = [{each.actor, each.other} for each in story.moments[st.START].conditions
             if isinstance(each, st.Measure) and each.quantity in _APART]  # fmt: skip
    actors, assumed, phrases = list[st.Actor](), [*story.assumptions], Phrases(story)
    for actor in story.actors:
        others = [each for pair in pairs for each in pair - {actor.id} if actor.id in pair and each is not None]
        if others and actor.way == st.Way() and not actor.relations:
            assumed.append(f"{actor.name} begins in the lane of {phrases.name(others[0])}")
            actor = replace(actor, relations=(st.Relation("same way", others[0]),))
        actors.append(actor)
    return replace(story, actors=tuple(actors), assumptions=tuple(assumed))


def _is_open(actor: st.Actor, story: st.Story) -> bool:
    """Whether a way is asked about: nothing is told of it, or just that it is in one line with one who turns."""
    beside = {each.of for each in actor.relations if each.kind in IN_LINE}
    beside |= {one.id for one in story.actors if any(e.of == actor.id and e.kind in IN_LINE for e in one.relations)}
    may_turn = any(one.id in beside and one.way.turn not in (None, "straight") for one in story.actors)
    return actor.way.heading is None and (may_turn or (actor.way == st.Way() and not actor.relations))


def _fits_ways(story: st.Story, answers: Mapping[str, str]) -> st.Story:
    """Ask what an event of a turn means of somebody who does not turn, and refuse a collision of ways that cross."""
    ways = {actor.id: actor.way for actor in story.actors}
    phrases, questions = Phrases(story), {each.slot: each for each in story.questions}

    def fitted(each: st.Condition) -> st.Condition:
        if not isinstance(each, st.Measure):
            return each
        if each.quantity is st.Quantity.COLLISION and _cross(ways[each.actor], ways[each.other or 0]):
            found = each.quote.text if each.quote else phrases.clause(each)
            fix = "say the time to arrival of each: 'the ego is 3 s from the conflict point'"
            raise TranslationError("a time to collision needs a lane that both drive in", found=found, fix=fix)
        if each.place in TURNING and ways[each.actor].turn == "straight":
            name = phrases.name(each.actor)
            slot = f"turn of {name.removeprefix('the ')}"
            if answers.get(slot) == _INSTEAD:
                return replace(each, place=st.Place("conflict_point"))
            asked = f"{sentence(f'{name} does not turn')} What is meant by: {phrases.clause(each, passing=True)}?"
            questions.setdefault(slot, st.Question(slot, asked, (_INSTEAD,), None, each.quote))
        return each

    moments = tuple(replace(moment, conditions=tuple(map(fitted, moment.conditions))) for moment in story.moments)
    return replace(story, moments=moments, questions=tuple(questions.values()))


def _cross(one: st.Way, other: st.Way) -> bool:
    """Whether two whole ways begin and end in different directions."""
    ends = [way.headings if isinstance(way := route_of(each), HeadingsRoute) else () for each in (one, other)]
    return all(ends) and ends[0][0] != ends[1][0] and ends[0][-1] != ends[1][-1]


def _fitting(actor: st.Actor, road_map: RoadMap) -> list[Route]:
    way, route = actor.way, route_of(actor.way)
    if isinstance(route, HeadingsRoute):
        return list(find_routes(road_map, headings=route.headings))
    if isinstance(route, LanesRoute):
        return list(find_routes(road_map, lanes=route.lanes))
    kinds = find_routes(road_map, origin_kind=route.origin, destination_kind=route.destination, turn=route.turn)
    ends = find_routes(road_map, origin_heading=way.heading, destination_heading=way.destination_heading)
    return [each for each in kinds if each in ends]


def _keep_related(fitting: dict[int, list[Route]], actor: int, relation: st.Relation) -> None:
    """Leave only the ways of both that lie as the relation says to some way of the other."""
    if (quarters := BEARINGS.get(relation.kind)) is None:
        return

    def lies(own: Route, other: Route) -> bool:
        return (COMPASS.index(own.headings[0]) - COMPASS.index(other.headings[0])) % 4 == quarters

    mine, others = fitting[actor], fitting[relation.of]
    fitting[actor] = [own for own in mine if any(lies(own, other) for other in others)]
    fitting[relation.of] = [other for other in others if any(lies(own, other) for own in mine)]


def _way(route: Route, road_map: RoadMap) -> st.Way:
    """Return the shortest facts that this route alone meets."""
    if len(find_routes(road_map, headings=route.headings)) > 1:
        return st.Way(lanes=route.lanes)
    return way_of(HeadingsRoute(route.headings))


def _in_line(story: st.Story) -> st.Story:
    """Let who is said to be ahead or behind be so at the start."""
    start, *others = story.moments
    told = {(each.actor, each.other) for each in start.conditions
            if isinstance(each, st.Measure) and each.quantity is st.Quantity.GAP}  # fmt: skip
    added = []
    for who, relation in ((actor.id, each) for actor in story.actors for each in actor.relations):
        gap = st.in_line(who, relation)
        if gap is not None and (gap.actor, gap.other) not in told:
            added.append(gap)
    return replace(story, moments=(replace(start, conditions=(*start.conditions, *dict.fromkeys(added))), *others))
