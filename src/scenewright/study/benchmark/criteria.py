"""Whether a run is what a row of the benchmark asks for, criterion by criterion, by hand from the taxonomy's facts.

What enters: a row, parameter values in SI units, a trace with the vehicles "ego" and "hero", the road map. What leaves:
criteria with required and measured values. It is a second opinion beside the judge: it uses neither the gold program
nor any formula, neither translator, solver nor plan, and it shares with the judge nothing but the tolerances.

The trigger is read from what the hero did. Its beginning to brake (or to speed up) is found in its speeds, backwards
from the standstill (or the place to be passed) that it led to, between samples where it lies between them. Both sides
are measured at that very instant: "when the ego is here and the hero there, the hero begins to". Besides, the nearest
instant at which both sides are met best must be that instant but for the tolerance of time. Where a hero may be said to
have begun more than once, the beginning counts that the trigger explains best: a row says that there is such an
instant, not that it is the first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from scenewright.judge.tolerance import Tolerance
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.model import RoadMap
from scenewright.study.benchmark.motion import LASTING_S, PLAIN_MPSS, FloatArray, Motion, Stretch
from scenewright.study.benchmark.roadway import first_overlap_s, route_errors
from scenewright.study.benchmark.rows import BenchmarkRow
from scenewright.study.benchmark.setting import Setting, Side, setting_of
from scenewright.trace.model import Trace
from scenewright.units import Dimension

Kind = Literal["initial", "route", "trigger", "interaction", "outcome"]
NEAR_S = 3.0  # how far from the hero's beginning the instant of the trigger is looked for
SETTLED_S = 0.5  # how long before its beginning the hero must not do the same already
_STEP_S = 1e-3
_NEARER = 0.05  # what a second away from the hero's beginning counts: of equally good instants the nearest is meant


@dataclass(frozen=True, slots=True)
class Criterion:
    """One thing that must be so.

    Attributes
    ----------
    required, measured
        In SI units; None where there is no single number, or where it never came about.
    error
        Never negative; infinite where it never came about.
    dimension
        What tolerance applies; None where none does, and the error must be zero.
    """

    id: str
    kind: Kind
    text: str
    required: float | None
    measured: float | None
    error: float
    dimension: Dimension | None

    def holds_at(self, tolerance: Tolerance) -> bool:
        """Whether the error is within a tolerance."""
        return self.error <= tolerance.of(self.dimension)


def criteria_hold(criteria: Sequence[Criterion], tolerance: Tolerance) -> bool:
    """Whether every criterion holds at a tolerance."""
    return all(criterion.holds_at(tolerance) for criterion in criteria)


def criteria_of(
    row: BenchmarkRow, parameters_si: Mapping[str, float], trace: Trace, road_map: RoadMap
) -> tuple[Criterion, ...]:
    """Judge a run by what its row asks for.

    Parameters
    ----------
    parameters_si
        Value of every parameter of the row's program, in SI units.
    trace
        Of vehicles called ``"ego"`` and ``"hero"``.

    Raises
    ------
    KeyError
        If a parameter or a vehicle is missing.
    """
    setting = setting_of(row, parameters_si, road_map)
    motions = {name: Motion(trace.actors[name]) for name in ("ego", "hero")}
    goal_s = motions["hero"].passes_s(setting.goal_m) if setting.goal_m is not None else float("inf")
    trigger = _trigger(setting, motions, goal_s)
    return (
        *_routes(setting, trace),
        *(_initial(actor, side, motions[actor]) for actor, side in setting.initial.items()),
        *_trigger_criteria(setting, motions, trigger),
        *_interaction(setting, motions["hero"], trigger, goal_s),
        *_outcome(setting, motions["ego"], goal_s),
        _no_collision(trace, trigger),
    )


# -- route and start ---------------------------------------------------------------------------------------------------
def _routes(setting: Setting, trace: Trace) -> list[Criterion]:
    criteria = []
    for actor, route in setting.routes.items():
        for found in route_errors(route, trace.actors[actor]):
            criteria.append(
                Criterion(
                    f"route_{actor}_{found.id}", "route", f"{actor} {found.text}",
                    found.limit, found.measured, max(0.0, found.measured - found.limit), None,
                )
            )  # fmt: skip
    return criteria


def _initial(actor: str, side: Side, motion: Motion) -> Criterion:
    value = float(_short_of(side, motion, motion.time_s[:1])[0])
    return _equal(f"initial_{actor}", "initial", f"{side.text} at first", side.value, value, _dimension(side.timed))


# -- trigger -----------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class _Trigger:
    """When the hero began and the standstill that this led to; the nearest instant at which both sides are met best.

    Attributes
    ----------
    onset_s
        Infinite where the hero never began.
    measured
        Both sides at the hero's beginning; where it never began, at `moment_s`.
    missed
        The worst of both sides and of the time between the two instants, in tight tolerances.
    """

    onset_s: float
    rest: Stretch | None
    moment_s: float
    measured: Mapping[str, float]
    missed: float


def _trigger(setting: Setting, motions: Mapping[str, Motion], goal_s: float) -> _Trigger:
    """Choose among the hero's beginnings the one that the trigger explains best."""
    hero = motions["hero"]
    found: list[_Trigger] = []
    if setting.brakes:
        for rest in hero.rests(goal_s):
            found += [_best_instant(setting, motions, onset, rest) for onset in hero.beginnings(-1, rest.start_s)]
    elif np.isfinite(goal_s):
        found += [_best_instant(setting, motions, onset, None) for onset in hero.beginnings(1, goal_s)]
    if not found:
        return _best_instant(setting, motions, float("inf"), None)
    return min(found, key=lambda trigger: trigger.missed)


def _best_instant(setting: Setting, motions: Mapping[str, Motion], onset_s: float, rest: Stretch | None) -> _Trigger:
    """Measure both sides at a beginning, and find the instant near it at which they are met best."""
    first, last = motions["ego"].time_s[[0, -1]]
    began = bool(np.isfinite(onset_s))
    low, high = (onset_s - NEAR_S, onset_s + NEAR_S) if began else (first, last)
    times = np.arange(max(low, first), min(high, last) + 0.5 * _STEP_S, _STEP_S)
    late = np.abs(times - onset_s) if began else np.zeros_like(times)
    worst = _worst_side(setting, motions, times) + _NEARER * late
    padded = np.concatenate(([np.inf], worst, [np.inf]))
    lowest = np.flatnonzero((worst <= padded[:-2]) & (worst <= padded[2:]))
    # The sides may be met more than once near a beginning: the time that explains it best is meant.
    at = int(lowest[np.argmin(np.maximum(worst[lowest], late[lowest] / 0.1))])
    instant = np.array([onset_s if began else times[at]])
    measured = {actor: float(value[0]) for actor, _, _, value in _sides(setting, motions, instant)}
    missed = max(float(_worst_side(setting, motions, instant)[0]), float(late[at]) / 0.1)
    return _Trigger(onset_s, rest, float(times[at]), measured, missed)


def _worst_side(setting: Setting, motions: Mapping[str, Motion], times: FloatArray) -> FloatArray:
    """Return how far the worse side is from what is asked: a tenth of a second counts as much as half a metre."""
    sides = _sides(setting, motions, times)
    errors = [np.abs(measured - required) / (0.1 if timed else 0.5) for _, required, timed, measured in sides]
    return np.asarray(np.max(errors, axis=0), dtype=np.float64)


def _sides(
    setting: Setting, motions: Mapping[str, Motion], times: FloatArray
) -> list[tuple[str, float, bool, FloatArray]]:
    """Return vehicle, required value, whether it is a time, and measured values, for every side of the trigger."""
    if setting.lead is None:
        return [
            (actor, side.value, side.timed, _short_of(side, motions[actor], times))
            for actor, side in setting.trigger.items()
        ]
    ego, lead = motions["ego"], setting.lead
    gap = motions["hero"].position_m(times) + lead.offset_m - ego.position_m(times)
    value = _over(gap - VEHICLE_LENGTH_M, ego.speed_mps(times)) if lead.timed else gap  # a headway is between bodies
    return [("ego", lead.value, lead.timed, value)]


def _trigger_criteria(setting: Setting, motions: Mapping[str, Motion], trigger: _Trigger) -> list[Criterion]:
    criteria = []
    for actor, required, timed, _ in _sides(setting, motions, motions["ego"].time_s[:1]):
        text = "ego behind the hero" if setting.lead else setting.trigger[actor].text
        criteria.append(
            _equal(
                f"trigger_{actor}", "trigger", f"{text} at the trigger",
                required, trigger.measured[actor], _dimension(timed),
            )
        )  # fmt: skip
    begins = "brake" if setting.brakes else "speed up"
    measured = trigger.onset_s if np.isfinite(trigger.onset_s) else None
    text = f"hero begins to {begins} at the trigger"
    return [*criteria, _equal("trigger_onset", "trigger", text, trigger.moment_s, measured, "time")]


# -- interaction and outcome -------------------------------------------------------------------------------------------
def _interaction(setting: Setting, hero: Motion, trigger: _Trigger, goal_s: float) -> list[Criterion]:
    onset, rest = trigger.onset_s, trigger.rest
    if not np.isfinite(onset):
        what = "hero brakes to a standstill" if setting.brakes else "hero speeds up and passes its goal"
        return [Criterion("hero_acts", "interaction", what, None, None, float("inf"), None)]
    sign, before_s = -1 if setting.brakes else 1, min(onset, trigger.moment_s)
    criteria = [
        _at_most(
            "hero_settled", "interaction", "hero does not do the same already in the half second before",
            PLAIN_MPSS, hero.strongest(sign, before_s - SETTLED_S, before_s), "acceleration",
        )
    ]  # fmt: skip
    if setting.brakes and rest is not None:
        criteria += _stop(setting, hero, onset, rest)
    if setting.goes and np.isfinite(goal_s):
        since = rest.end_s if setting.brakes and rest else onset
        text = "hero does not slow down again until it has passed"
        criteria.append(_at_most("hero_keeps_going", "interaction", text, 0.0, hero.against(1, since, goal_s), "speed"))
    return criteria


def _stop(setting: Setting, hero: Motion, onset_s: float, rest: Stretch) -> list[Criterion]:
    criteria = [
        _at_most(
            "hero_keeps_braking", "interaction", "hero does not speed up while it brakes",
            0.0, hero.against(-1, onset_s, rest.start_s), "speed",
        )
    ]  # fmt: skip
    if setting.rate_mpss is not None:
        rate = hero.mean_slowing(onset_s, rest.start_s)
        criteria.append(_equal("hero_rate", "interaction", "hero brakes at", setting.rate_mpss, rate, "acceleration"))
    if setting.stop_m is not None:
        place = float(hero.position_m(np.array([rest.end_s]))[0])
        error = abs(place - setting.stop_m)
        criteria.append(Criterion("hero_stop", "interaction", "hero stops at", setting.stop_m, place, error, "length"))
    to_the_end = rest.end_s >= float(hero.time_s[-1])
    lasted = rest.end_s - rest.start_s
    error = 0.0 if to_the_end else max(0.0, LASTING_S - lasted)
    criteria.append(Criterion("hero_stands", "interaction", "hero stands still for", LASTING_S, lasted, error, "time"))
    return criteria


def _outcome(setting: Setting, ego: Motion, goal_s: float) -> list[Criterion]:
    if setting.deadline_m is None:
        return []
    ego_s = ego.passes_s(setting.deadline_m)
    text = "hero is past its goal before the ego gets where it must not be first"
    if not np.isfinite(goal_s):
        return [Criterion("order", "outcome", text, ego_s if np.isfinite(ego_s) else None, None, float("inf"), None)]
    error = 0.0 if goal_s < ego_s else max(goal_s - ego_s, 1e-3)
    return [Criterion("order", "outcome", text, ego_s if np.isfinite(ego_s) else None, goal_s, error, None)]


def _no_collision(trace: Trace, trigger: _Trigger) -> Criterion:
    until = min(max(trigger.onset_s, trigger.moment_s), trace.duration_s)
    first = first_overlap_s(trace, until)
    error = 0.0 if first is None else max(until - first, 1e-3)
    return Criterion("no_collision", "interaction", "nobody collides before the trigger", until, first, error, None)


# -- measures ----------------------------------------------------------------------------------------------------------
def _short_of(side: Side, motion: Motion, times: FloatArray) -> FloatArray:
    distance = side.place_m - motion.position_m(times)
    return _over(distance, motion.speed_mps(times)) if side.timed else distance


def _over(distance_m: FloatArray, speed_mps: FloatArray) -> FloatArray:
    moving = speed_mps > 1e-3
    return np.where(moving, distance_m / np.where(moving, speed_mps, 1.0), np.inf)


def _dimension(timed: bool) -> Dimension:
    return "time" if timed else "length"


def _equal(id: str, kind: Kind, text: str, required: float, measured: float | None, dimension: Dimension) -> Criterion:
    error = float("inf") if measured is None or not np.isfinite(measured) else abs(measured - required)
    return Criterion(id, kind, text, required, measured, error, dimension)


def _at_most(id: str, kind: Kind, text: str, limit: float, measured: float, dimension: Dimension) -> Criterion:
    return Criterion(id, kind, text, limit, measured, max(0.0, measured - limit), dimension)
