"""Where a row of the benchmark plays: routes of both vehicles and the places that its story speaks of.

What enters: the taxonomy's facts about a row, a road map, and parameter values. What leaves: a `Setting`, in metres
along each vehicle's route. It is written from the facts alone: it reads no program and no description.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from scenewright.roads import Route, find_conflict, find_route, shared_offset_m
from scenewright.roads.model import RoadMap
from scenewright.study.benchmark.rows import BenchmarkRow

JUST_BEFORE_M = 5.0  # what "just before the stop line" means
_STATES = {"Driveway": ("driveway", None), "Westbound": ("road", "W"), "Eastbound": ("road", "E")}
_TURNS = {"Right turn": "right", "Left turn": "left", "Lane follow": "straight"}


@dataclass(frozen=True, slots=True)
class Side:
    """One condition on one vehicle: `value` metres, or seconds of time to arrival, short of a place on its route."""

    place_m: float
    value: float
    timed: bool
    text: str


@dataclass(frozen=True, slots=True)
class Lead:
    """The condition of a vehicle that is followed: `value` metres, or seconds of headway, ahead of the ego."""

    offset_m: float  # to be added to the hero's arc length to compare it with the ego's
    value: float
    timed: bool


@dataclass(frozen=True, slots=True)
class Setting:
    """A row on a map.

    Attributes
    ----------
    initial
        Conditions on the first state, by name of the vehicle.
    trigger
        Conditions on the trigger, by name of the vehicle; `lead` instead where the hero is followed.
    rate_mpss
        How hard the hero brakes; None where the row does not say.
    stop_m
        Where the hero stops, on its route; None where the row does not say.
    brakes, goes
        Whether the hero brakes to a stop, and whether it then (or at once) goes first.
    goal_m, deadline_m
        The hero is at `goal_m` of its route before the ego is at `deadline_m` of its own; None where nobody goes first.
    """

    routes: Mapping[str, Route]
    initial: Mapping[str, Side]
    trigger: Mapping[str, Side]
    lead: Lead | None
    rate_mpss: float | None
    stop_m: float | None
    brakes: bool
    goes: bool
    goal_m: float | None
    deadline_m: float | None


def setting_of(row: BenchmarkRow, parameters_si: Mapping[str, float], road_map: RoadMap) -> Setting:
    """Put a row on a map.

    Raises
    ------
    MapError
        If the map lacks a route of the row.
    KeyError
        If a parameter of the row has no value.
    """
    ego, hero = _route(road_map, row.ego_state, row.ego_intent), _route(road_map, row.hero_state, row.hero_intent)
    conflict = find_conflict(ego, hero)
    if conflict is None:
        raise ValueError(f"row {row.id}: the routes never meet")
    ego_m, hero_m = conflict.s_a_m, conflict.s_b_m
    timed = row.trigger == "Time"
    from_driveway = {"ego": row.ego_state == "Driveway", "hero": row.hero_state == "Driveway"}
    routes = {"ego": ego, "hero": hero}

    def side(actor: str, prefix: str, other_place: str) -> Side:
        place = "stop_line" if from_driveway[actor] else other_place
        at_m = routes[actor].landmarks["stop_line"] if from_driveway[actor] else ego_m if actor == "ego" else hero_m
        name = f"{prefix}{actor}_{'tta' if timed else 'distance'}_behind_{place}_{'s' if timed else 'm'}"
        return Side(at_m, parameters_si[name], timed, f"{actor} from the {place.replace('_', ' ')}")

    initial = {"ego": side("ego", "initial_", "intersection")}
    goes = row.interaction in ("Hero does not yield", "Hero yields then goes")
    brakes = row.interaction != "Hero does not yield"
    trigger: dict[str, Side] = {}
    lead = rate = stop = None
    if row.interaction == "Hero brakes":
        if from_driveway["hero"]:
            initial["hero"] = side("hero", "initial_", "intersection")
        offset = shared_offset_m(ego, hero)
        if offset is None:
            raise ValueError(f"row {row.id}: the ego cannot follow a hero whose lanes it does not share")
        name = "ego_headway_behind_hero_s" if timed else "ego_distance_behind_hero_m"
        lead = Lead(offset, parameters_si[name], timed)
        rate = abs(parameters_si["hero_deceleration_mpss"])
    else:
        trigger = {actor: side(actor, "", "conflict_point") for actor in ("ego", "hero")}
        if brakes and from_driveway["hero"]:
            stop = hero.landmarks["stop_line"] - JUST_BEFORE_M
        elif brakes:
            stop = hero_m - parameters_si["end_hero_distance_behind_conflict_point_m"]
    goal, deadline = _race(row, routes, ego_m, hero_m) if goes else (None, None)
    return Setting(routes, initial, trigger, lead, rate, stop, brakes, goes, goal, deadline)


def _race(row: BenchmarkRow, routes: Mapping[str, Route], ego_m: float, hero_m: float) -> tuple[float, float]:
    """Return what the hero has to reach before the ego reaches what."""
    ego_follows_lane = row.ego_intent == "Lane follow"
    into_road = row.hero_state == "Driveway"
    # Against an ego that goes straight on, a hero out of the driveway has gone first once its turn is complete.
    goal = routes["hero"].landmarks["turn_end"] if into_road and ego_follows_lane else hero_m
    # An ego that turns shows its decision when it begins to; where it crosses the path of a hero out of the driveway
    # the paper's texts (rows 39 and 80) have it pass the conflict point.
    deadline = ego_m if ego_follows_lane or into_road else routes["ego"].landmarks["turn_start"]
    return goal, deadline


def _route(road_map: RoadMap, state: str, intent: str) -> Route:
    kind, heading = _STATES[state]
    return find_route(road_map, origin_kind=kind, origin_heading=heading, turn=_TURNS[intent])
