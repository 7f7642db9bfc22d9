"""The benchmark's criteria: they take what was asked for, driven by hand, and refuse it doctored."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from scenewright.judge.tolerance import LEVELS, LOOSE, TIGHT
from scenewright.roads import Route, find_conflict, find_route, load_map
from scenewright.study.benchmark import Criterion, benchmark_row, criteria_hold, criteria_of
from scenewright.trace.model import ActorTrace, Trace

MAP = load_map("t_intersection")
STEP_S = 0.02
Pieces = Sequence[tuple[float, float]]  # duration (s) and acceleration (m/s^2)


@dataclass(frozen=True)
class Drive:
    """One vehicle: where it is at the trigger, how fast, and what it does before and from then on."""

    headings: tuple[str, ...]
    s_m: float
    speed_mps: float
    pieces: Pieces = ()

    @property
    def route(self) -> Route:
        return find_route(MAP, headings=self.headings)

    def shifted(self, way_m: float) -> Drive:
        return replace(self, s_m=self.s_m + way_m)


def states(drive: Drive, trigger_s: float, times: np.ndarray, early_s: float = 0.0) -> ActorTrace:
    """Drive at constant speed up to `early_s` before the trigger, then piece by piece."""
    start = drive.s_m - drive.speed_mps * trigger_s
    s, v, a = np.zeros_like(times), np.zeros_like(times), np.zeros_like(times)
    for index, time in enumerate(times):
        left, place, speed, accel = time, start, drive.speed_mps, 0.0
        for duration, rate in ((trigger_s - early_s, 0.0), *drive.pieces, (np.inf, 0.0)):
            spent, accel = min(left, duration), rate
            place, speed = place + speed * spent + 0.5 * rate * spent**2, speed + rate * spent
            left -= spent
            if spent < duration:
                break
        s[index], v[index], a[index] = place, speed, accel
    poses = drive.route.path.poses(s)
    return ActorTrace(times, poses[:, 0], poses[:, 1], poses[:, 2], np.maximum(v, 0.0), a, s, np.zeros_like(s))


@dataclass(frozen=True)
class Play:
    """A run of a row that is as it should be."""

    row: int
    parameters: Mapping[str, float]
    ego: Drive
    hero: Drive
    trigger_s: float = 4.013  # between two samples
    duration_s: float = 12.0

    def trace(self, **changed: object) -> Trace:
        early_s = changed.pop("early_s", 0.0)
        play = replace(self, **changed)  # type: ignore[arg-type]
        times = np.arange(0.0, play.duration_s, STEP_S)
        return Trace(
            {
                "ego": states(play.ego, play.trigger_s, times),
                "hero": states(play.hero, play.trigger_s, times, early_s),  # type: ignore[arg-type]
            }
        )

    def criteria(self, trace: Trace) -> tuple[Criterion, ...]:
        return criteria_of(benchmark_row(self.row), self.parameters, trace, MAP)

    def failed(self, trace: Trace) -> set[str]:
        return {criterion.id for criterion in self.criteria(trace) if not criterion.holds_at(TIGHT)}


def conflict_m(ego: tuple[str, ...], hero: tuple[str, ...]) -> tuple[float, float]:
    found = find_conflict(find_route(MAP, headings=ego), find_route(MAP, headings=hero))
    assert found is not None
    return found.s_a_m, found.s_b_m


def yields() -> Play:
    """Ego at 10 m/s, 40 m before the conflict point; hero at 7 m/s, 20 m before, stops 6 m before."""
    ego, hero = conflict_m(("W",), ("E", "N"))
    names = ("initial_ego_distance_behind_intersection_m", "ego_distance_behind_conflict_point_m",
             "hero_distance_behind_conflict_point_m", "end_hero_distance_behind_conflict_point_m")  # fmt: skip
    values = dict(zip(names, (80.13, 40.0, 20.0, 6.0), strict=True))
    return Play(16, values, Drive(("W",), ego - 40, 10.0), Drive(("E", "N"), hero - 20, 7.0, [(4.0, -1.75)]))


def yields_by_time() -> Play:
    ego, hero = conflict_m(("W",), ("E", "N"))
    names = ("initial_ego_tta_behind_intersection_s", "ego_tta_behind_conflict_point_s",
             "hero_tta_behind_conflict_point_s", "end_hero_distance_behind_conflict_point_m")  # fmt: skip
    values = dict(zip(names, (8.013, 4.0, 3.0, 7.0), strict=True))
    return Play(56, values, Drive(("W",), ego - 40, 10.0), Drive(("E", "N"), hero - 21, 7.0, [(4.0, -1.75)]))


def does_not_yield() -> Play:
    """Hero out of the driveway at 4 m/s, 4 m before its stop line; the ego is slow and 40 m away."""
    ego, _ = conflict_m(("W",), ("S", "W"))
    line = find_route(MAP, headings=("S", "W")).landmarks["stop_line"]
    names = ("initial_ego_distance_behind_intersection_m", "ego_distance_behind_conflict_point_m",
             "hero_distance_behind_stop_line_m")  # fmt: skip
    values = dict(zip(names, (64.078, 40.0, 4.0), strict=True))
    return Play(20, values, Drive(("W",), ego - 40, 6.0), Drive(("S", "W"), line - 4, 4.0, [(2.0, 1.0)]))


def yields_then_goes() -> Play:
    ego, _ = conflict_m(("W",), ("S", "W"))
    line = find_route(MAP, headings=("S", "W")).landmarks["stop_line"]
    names = ("initial_ego_distance_behind_intersection_m", "ego_distance_behind_conflict_point_m",
             "hero_distance_behind_stop_line_m")  # fmt: skip
    values = dict(zip(names, (96.052, 80.0, 9.0), strict=True))
    hero = Drive(("S", "W"), line - 9, 4.0, [(2.0, -2.0), (1.0, 0.0), (3.0, 2.0)])
    return Play(21, values, Drive(("W",), ego - 80, 4.0), hero, duration_s=26.0)


def brakes() -> Play:
    ego, _ = conflict_m(("W",), ("W", "N"))
    names = ("initial_ego_distance_behind_intersection_m", "ego_distance_behind_hero_m", "hero_deceleration_mpss")
    values = dict(zip(names, (140.13, 25.0, 4.0), strict=True))
    hero = Drive(("W", "N"), ego - 75, 8.0, [(2.0, -4.0)])
    return Play(15, values, Drive(("W",), ego - 100, 10.0, [(4.0, -2.5)]), hero, duration_s=9.0)


def brakes_by_time() -> Play:
    names = ("initial_ego_tta_behind_intersection_s", "ego_headway_behind_hero_s", "hero_deceleration_mpss")
    return replace(brakes(), row=55, parameters=dict(zip(names, (14.013, 2.05, 4.0), strict=True)))


PLAYS = {
    play.__name__: play() for play in (yields, yields_by_time, does_not_yield, yields_then_goes, brakes, brakes_by_time)
}
EVERY = pytest.mark.parametrize("play", PLAYS.values(), ids=PLAYS)
STOPS = [play for name, play in PLAYS.items() if name != "does_not_yield"]
GOES = [PLAYS["does_not_yield"], PLAYS["yields_then_goes"]]


@EVERY
def test_what_was_asked_for_holds_at_every_tolerance(play: Play) -> None:
    criteria = play.criteria(play.trace())
    for tolerance in LEVELS.values():
        assert [c for c in criteria if not c.holds_at(tolerance)] == []
    assert criteria_hold(criteria, TIGHT)


@EVERY
@pytest.mark.parametrize("way_m", [-0.8, 0.8])
def test_a_side_of_the_trigger_that_is_shifted_is_refused(play: Play, way_m: float) -> None:
    if play.row > 40:
        way_m *= 2.5  # at 10 m/s a fifth of a second
    assert "trigger_ego" in play.failed(play.trace(ego=play.ego.shifted(way_m)))


@EVERY
def test_a_hero_that_begins_early_is_refused(play: Play) -> None:
    failed = play.failed(play.trace(early_s=0.4))
    assert failed & {"trigger_onset", "trigger_ego", "trigger_hero"}


@EVERY
def test_another_route_is_refused(play: Play) -> None:
    trace = play.trace()
    other = ("W",) if play.hero.headings[0] == "E" else ("E",)
    poses = find_route(MAP, headings=other).path.poses(trace.actors["hero"].s_m)
    driven = replace(trace.actors["hero"], x_m=poses[:, 0], y_m=poses[:, 1], heading_rad=poses[:, 2])
    assert "route_hero_line" in play.failed(Trace({**trace.actors, "hero": driven}))


@pytest.mark.parametrize("play", STOPS, ids=lambda play: str(play.row))
def test_a_hero_that_never_stops_is_refused_however_loosely(play: Play) -> None:
    first, rate = play.hero.pieces[0]
    trace = play.trace(hero=replace(play.hero, pieces=[(0.7 * first, rate)]))
    assert "hero_acts" in play.failed(trace)
    assert not criteria_hold(play.criteria(trace), LEVELS["coarse"])


@pytest.mark.parametrize("play", GOES, ids=lambda play: str(play.row))
def test_a_wrong_order_is_refused_however_loosely(play: Play) -> None:
    fast = replace(play.ego, pieces=[(3.0, 4.0)])
    trace = play.trace(ego=fast)
    assert play.failed(trace) == {"order"}
    assert not criteria_hold(play.criteria(trace), LEVELS["coarse"])


def test_an_ego_that_is_past_its_turn_from_the_first_is_no_ego_that_comes_later() -> None:
    """Who starts inside the turn has begun it: the hero was not there first."""
    play = does_not_yield()
    there = Drive(("W",), 340.0, 0.1)
    assert "order" in play.failed(play.trace(ego=there))


def test_a_wrong_place_to_stop_is_refused() -> None:
    play = yields()
    trace = play.trace(hero=replace(play.hero, pieces=[(3.6, -7.0 / 3.6)]))
    assert play.failed(trace) == {"hero_stop"}


def test_a_wrong_rate_is_refused() -> None:
    play = brakes()
    assert play.failed(play.trace(hero=replace(play.hero, pieces=[(2.2, -8.0 / 2.2)]))) == {"hero_rate"}


def test_a_hero_that_brakes_already_is_refused() -> None:
    play = yields()
    before = play.hero.pieces[0]
    hero = replace(play.hero, pieces=[(0.2, -2.0), (0.2, 2.0), before])
    assert play.failed(play.trace(hero=hero, early_s=0.4)) == {"hero_settled"}


def test_a_hero_that_wavers_while_it_brakes_is_refused() -> None:
    play = yields()
    hero = replace(play.hero, pieces=[(2.0, -1.75), (0.3, 2.0), (4.1 / 1.75, -1.75)])
    assert "hero_keeps_braking" in play.failed(play.trace(hero=hero))


def test_a_stop_of_no_duration_is_refused() -> None:
    play = yields_then_goes()
    hero = replace(play.hero, pieces=[(2.0, -2.0), (0.02, 0.0), (3.0, 2.0)])
    assert "hero_acts" in play.failed(play.trace(hero=hero))


def test_a_wrong_start_is_refused() -> None:
    play = yields()
    wrong = replace(play, parameters={**play.parameters, "initial_ego_distance_behind_intersection_m": 78.0})
    assert wrong.failed(play.trace()) == {"initial_ego"}
    assert not criteria_hold(wrong.criteria(play.trace()), LOOSE)


def test_a_crash_before_the_trigger_is_refused() -> None:
    play = replace(brakes(), parameters={**brakes().parameters, "ego_distance_behind_hero_m": 3.0})
    trace = play.trace(ego=play.ego.shifted(22.0))
    assert "no_collision" in play.failed(trace)
