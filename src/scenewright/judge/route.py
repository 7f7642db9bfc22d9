"""Whether each actor drove its route: beside its line, along it, forwards, in the expected directions.

What enters: a `Case`. What leaves: conditions of kind route.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.tolerance import FloatArray, Leaf
from scenewright.judge.verdict import Condition, unjudged
from scenewright.program.types import Actor
from scenewright.trace.model import ActorTrace
from scenewright.translate.phrases import called

MAX_LATERAL_M = 1.0
MAX_ANGLE_RAD = 0.5  # between where a car points and where it, or its line, goes: more is sliding, or another path
MAX_HEADING_RAD = float(np.pi / 3)  # from a cardinal direction
MAX_MAP_ERROR_M = 0.2
BACK_M = 0.05
_MOVING_MPS = 0.5
_CARDINALS = {"E": 0.0, "N": np.pi / 2, "W": np.pi, "S": -np.pi / 2}


def route_conditions(case: Case) -> list[Condition]:
    """Judge the route of every actor."""
    return [replace(each, owed_by=actor.name) for actor in case.program.actors for each in _route(case, actor)]


def _route(case: Case, actor: Actor) -> Iterator[Condition]:
    states, name, who = case.timelines[actor.id].states, actor.name, called(actor.name)
    lateral = float(np.max(np.abs(states.d_m)))
    yield _limit(f"route_{name}", f"{who} stays on the line of its route", MAX_LATERAL_M, lateral, "m")
    angle = _slip_angle(states)
    yield _limit(f"route_{name}_heading", f"{who} drives where it points", MAX_ANGLE_RAD, angle, "rad")
    back = float(np.max(np.maximum.accumulate(states.s_m) - states.s_m))
    yield _limit(f"route_{name}_progress", f"{who} never goes back along its route", BACK_M, back, "m")
    yield _headings(case, actor, case.expected_headings.get(name, ()))
    text = f"{who} is on the map where its route coordinates say"
    try:
        yield _limit(f"route_{name}_map", text, MAX_MAP_ERROR_M, _map_error(case, actor), "m")
    except CannotJudge as reason:
        yield unjudged(f"route_{name}_map", "route", text, str(reason))


def _limit(condition_id: str, text: str, limit: float, value: float, unit: str) -> Condition:
    error = max(0.0, value - limit)
    return Condition(condition_id, "route", text, limit, value, error, unit, Leaf(error, None))


def _slip_angle(states: ActorTrace) -> float:
    dx, dy = np.diff(states.x_m), np.diff(states.y_m)
    moving = 0.5 * (states.speed_mps[1:] + states.speed_mps[:-1]) > _MOVING_MPS
    if not moving.any():
        return 0.0
    middle = states.heading_rad[:-1] + 0.5 * _wrapped(np.diff(states.heading_rad))
    return float(np.max(np.abs(_wrapped(np.arctan2(dy, dx) - middle))[moving]))


def _headings(case: Case, actor: Actor, expected: tuple[str, ...]) -> Condition:
    """Compare every direction with that of the route's own line: a road may bend away from what its route is called.

    Without the map the first direction is compared at the start and, once the turn is behind the actor, the last one.
    """
    states = case.timelines[actor.id].states
    name, text = f"route_{actor.name}_directions", f"{called(actor.name)} is headed"
    told = f"{text} {', then '.join(expected)}"
    try:
        line = case.path(actor.id).poses(states.s_m)[:, 2]
    except CannotJudge as reason:
        if not expected:
            return unjudged(name, "route", f"{text} along the line of its route", str(reason))
    else:
        worst = float(np.max(np.abs(_wrapped(states.heading_rad - line))))
        along = f"{told}, along the line of its route" if expected else f"{text} along the line of its route"
        return _limit(name, along, MAX_ANGLE_RAD, worst, "rad")
    off = [_off(states.heading_rad[:1], expected[0])]
    try:
        turned = states.s_m >= case.landmark_m("turn_end", actor.id)
        off.append(_off(states.heading_rad[turned], expected[-1]))
    except CannotJudge:
        pass  # a route without a turn has one direction
    return _limit(name, told, MAX_HEADING_RAD, max(off), "rad")


def _off(headings: FloatArray, cardinal: str) -> float:
    return float(np.max(np.abs(_wrapped(headings - _CARDINALS[cardinal])), initial=0.0))


def _wrapped(angle: FloatArray) -> FloatArray:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi, dtype=np.float64)


def _map_error(case: Case, actor: Actor) -> float:
    states = case.timelines[actor.id].states
    x_m, y_m, heading = case.path(actor.id).poses(states.s_m).T
    off_x_m = states.x_m - (x_m - states.d_m * np.sin(heading))
    off_y_m = states.y_m - (y_m + states.d_m * np.cos(heading))
    return float(np.max(np.hypot(off_x_m, off_y_m)))
