"""Whether a car can have moved like this: no jumps, no contradiction between columns, within limits, never backwards.

What enters: a `Case` and an actor. What leaves: conditions, and for the ego facts. That the columns of a trace agree is
owed by everybody, for all that is judged rests on them; limits are the heroes' own, for the ego is not ours.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scenewright.judge.case import Case
from scenewright.judge.tolerance import FloatArray
from scenewright.judge.verdict import Condition, bounded
from scenewright.program.types import EGO
from scenewright.trace.model import ActorTrace
from scenewright.translate.phrases import called
from scenewright.units import Dimension

_SUMMED_S = 1.0  # small steps beside what is stated are told from noise over this time
_TURN_OVER_S = 0.1  # headings are compared over this time, so that rounding in a map is not taken for swerving


@dataclass(frozen=True, slots=True)
class Finding:
    """The worst of one quantity over the run."""

    name: str
    text: str
    required: float
    measured: float
    error: float
    dimension: Dimension


def kinematic_findings(case: Case, actor_id: int) -> list[Finding]:
    """Measure the worst of each quantity for one actor."""
    return [*_agreements(case, actor_id), *_within_limits(case, actor_id)]


def _agreements(case: Case, actor_id: int) -> list[Finding]:
    states = case.timelines[actor_id].states
    jump, drift, slip = speed_jump(states), _position_drift(case, actor_id), map_drift(states)
    return [
        Finding("speed_jump", "speed changes only as its acceleration says", 0.0, jump, jump, "speed"),
        Finding("position_drift", "position changes only as its speed says", 0.0, drift, drift, "speed"),
        Finding("map_drift", "the way on the map is as long as its speed says", 0.0, slip, slip, "speed"),
    ]


def _within_limits(case: Case, actor_id: int) -> list[Finding]:
    states, limits = case.timelines[actor_id].states, case.limits_of(actor_id)
    low, high, lateral = float(states.accel_mps2.min()), float(states.accel_mps2.max()), _lateral(states)
    backwards = max(0.0, -float(states.speed_mps.min()))
    top = float(states.speed_mps.max())
    return [
        _above("acceleration", "acceleration stays within its limit", limits.accel_max_mpss, high, "acceleration"),
        _below("deceleration", "deceleration stays within its limit", limits.accel_min_mpss, low, "acceleration"),
        _above("speed", "speed stays within its limit", limits.speed_max_mps, top, "speed"),
        _above("lateral", "lateral acceleration stays within its limit", limits.lateral_accel_max_mpss, lateral,
               "acceleration"),
        Finding("reverse", "never drives backwards", 0.0, backwards, backwards, "speed"),
    ]  # fmt: skip


def kinematic_conditions(case: Case) -> list[Condition]:
    """Judge the agreement of columns for everybody, and limits for every orchestrated actor."""
    return [
        bounded(
            f"kin_{actor.name}_{finding.name}", "safety", f"{called(actor.name)}: {finding.text}",
            required=finding.required, measured=finding.measured, error=finding.error, dimension=finding.dimension,
            owed_by=actor.name,
        )
        for actor in case.program.actors
        for finding in (_agreements if actor.id == EGO else kinematic_findings)(case, actor.id)
    ]  # fmt: skip


def kinematic_facts(case: Case, actor_id: int) -> dict[str, float]:
    """Return the same quantities as facts."""
    return {finding.name: finding.measured for finding in kinematic_findings(case, actor_id)}


def _above(name: str, text: str, limit: float, value: float, dimension: Dimension) -> Finding:
    return Finding(name, text, limit, value, max(0.0, value - limit), dimension)


def _below(name: str, text: str, limit: float, value: float, dimension: Dimension) -> Finding:
    return Finding(name, text, limit, value, max(0.0, limit - value), dimension)


def speed_jump(states: ActorTrace) -> float:
    """Return by how much the speed changes in a step, or in a second, beyond what accelerations explain (m/s) at most.

    A piece may end between two samples: then the mean acceleration lies between the stated ones.
    """
    steps = np.diff(states.time_s)
    if not len(steps):
        return 0.0
    change, longest = np.diff(states.speed_mps), min(len(steps), max(1, round(_SUMMED_S / float(np.mean(steps)))))
    before, after = states.accel_mps2[:-1] * steps, states.accel_mps2[1:] * steps
    worst = 0.0
    for beyond in (change - np.maximum(before, after), np.minimum(before, after) - change):
        summed = np.append(0.0, np.cumsum(beyond))
        worst = max(worst, *(float(np.max(summed[count:] - summed[:-count])) for count in (1, longest)))
    return worst


def _position_drift(case: Case, actor_id: int) -> float:
    """Return by how much (m/s) the way in route coordinates differs from the speed at most.

    Beside the line of its route the way through a bend is shorter or longer than the line is, and some of it leads
    across.
    """
    states, path = case.timelines[actor_id].states, case.paths.get(case.name(actor_id))
    steps = np.diff(states.time_s)
    if not len(steps):
        return 0.0
    along = np.diff(states.s_m)
    if path is not None and states.d_m.any():
        turned = np.diff(np.unwrap(path.poses(states.s_m)[:, 2]))
        along = along - 0.5 * (states.d_m[1:] + states.d_m[:-1]) * turned
    way: FloatArray = np.copysign(np.hypot(along, np.diff(states.d_m)), along)
    mean = 0.5 * (states.speed_mps[1:] + states.speed_mps[:-1])
    return float(np.max(np.abs(way / steps - mean)))


def map_drift(states: ActorTrace) -> float:
    """Return by how much (m/s) the way on the map differs from the speed at most."""
    steps = np.diff(states.time_s)
    if not len(steps):
        return 0.0
    way: FloatArray = np.hypot(np.diff(states.x_m), np.diff(states.y_m)) / steps
    return float(np.max(np.abs(way - np.abs(0.5 * (states.speed_mps[1:] + states.speed_mps[:-1])))))


def _lateral(states: ActorTrace) -> float:
    """Return the largest speed times rate of turning (m/s^2), which is speed squared times curvature."""
    times, heading = states.time_s, np.unwrap(states.heading_rad)
    if len(times) < 2 or times[-1] - times[0] < 2 * _TURN_OVER_S:
        return 0.0
    middle = times[(times >= times[0] + _TURN_OVER_S) & (times <= times[-1] - _TURN_OVER_S)]
    turned = np.interp(middle + _TURN_OVER_S, times, heading) - np.interp(middle - _TURN_OVER_S, times, heading)
    speed = np.interp(middle, times, states.speed_mps)
    return float(np.max(np.abs(speed * turned / (2 * _TURN_OVER_S)), initial=0.0))
