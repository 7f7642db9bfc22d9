"""Predictors: what each believes of an ego, and that any of them can take the place of another."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import pytest

from scenewright.drive.hostile import Noisy
from scenewright.errors import InputError
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.motion.profile import Profile
from scenewright.orchestrate import case_of
from scenewright.plan.prediction import (
    ConstantAcceleration,
    ConstantSpeed,
    EgoSample,
    Foot,
    Predictor,
    RoadAware,
    predictor_called,
    since_jump,
)
from scenewright.roads.load import load_map
from scenewright.roads.routes import Route, find_route
from stories import STORIES, Stage

MAP = load_map("t_intersection")
BUMPER_M = 2.25


def route(*headings: str) -> Route:
    return find_route(MAP, headings=headings)


def steadily(s_m: float, speed_mps: float, accel_mpss: float, steps: int = 20) -> list[EgoSample]:
    """A past of one acceleration that leads to a state at 4 s."""
    ages = [0.02 * k for k in range(steps - 1, -1, -1)]
    return [
        (4.0 - age, s_m - speed_mps * age + 0.5 * accel_mpss * age * age, speed_mps - accel_mpss * age, accel_mpss)
        for age in ages
    ]


@pytest.mark.parametrize("predictor", [ConstantSpeed(), ConstantAcceleration(), RoadAware(())])
@pytest.mark.parametrize("accel_mpss", [-6.0, -0.5, 0.0, 1.5])
def test_prediction_begins_where_the_ego_is_and_never_reverses(predictor: Predictor, accel_mpss: float) -> None:
    profile = predictor.predict(steadily(30.0, 8.0, accel_mpss))
    assert profile.start_s == 4.0
    assert profile.state(4.0)[:2] == pytest.approx((30.0, 8.0))
    places = [profile.state(4.0 + 0.1 * k)[0] for k in range(200)]
    assert all(after >= before for before, after in pairwise(places))


def test_constant_speed_keeps_the_last_speed() -> None:
    profile = ConstantSpeed().predict(steadily(30.0, 8.0, -3.0))
    assert profile.state(14.0)[:2] == pytest.approx((110.0, 8.0))


def test_constant_acceleration_lasts_for_a_while() -> None:
    profile = ConstantAcceleration(hold_s=2.0).predict(steadily(30.0, 8.0, 1.5))
    assert profile.state(5.0)[:2] == pytest.approx((30.0 + 8.0 + 0.75, 9.5))
    assert profile.state(6.0)[1] == pytest.approx(11.0)
    assert profile.state(9.0)[1] == pytest.approx(11.0)


@pytest.mark.parametrize(
    ("newest_first", "since"),
    [
        ([-3.0, 0.4, 0.3, 0.4], [0.4, 0.3, 0.4]),  # it brakes, or is it a twitch?
        ([-3.0, -2.8, 0.4, 0.3], [-3.0, -2.8]),  # it has begun to brake
        ([0.4, 0.2, 0.5, 0.3], [0.4, 0.2, 0.5, 0.3]),  # even all the time
        ([-1.0, 0.2, -0.8, 0.4, -0.9], [-1.0, 0.2, -0.8, 0.4, -0.9]),  # jitter is no change of mind
        ([1.2], [1.2]),
    ],
)
def test_a_jump_that_lasts_is_a_change_of_mind(newest_first: list[float], since: list[float]) -> None:
    assert list(since_jump(newest_first)) == since


def test_what_was_before_a_jump_tells_nothing_of_what_comes() -> None:
    past = steadily(50.0, 8.0, 0.3)
    time_s, s_m, speed_mps, _ = past[-1]
    twitch = [*past, (time_s + 0.02, s_m + 0.16, speed_mps - 0.06, -3.0)]
    assert Foot.of(twitch, 0.1).accel_mpss == pytest.approx(0.3)
    braking = [*twitch, (time_s + 0.04, s_m + 0.32, speed_mps - 0.12, -3.0)]
    assert Foot.of(braking, 0.1).accel_mpss == -3.0
    assert Foot.of(past, 0.1).accel_mpss == pytest.approx(0.3)


def test_acceleration_is_averaged_and_jitter_left_out() -> None:
    past = [(0.02 * k, 0.16 * k, 8.0, 2.0 if k % 2 else -1.0) for k in range(20)]
    assert -1.0 < Foot.of(past, 0.1).accel_mpss < 2.0
    assert Foot.of(past, 0.0).accel_mpss == 2.0
    assert Foot.of(steadily(0.0, 8.0, 0.01), 0.1).accel_mpss == 0.0


def past_of(accels_mpss: Sequence[float], speed_mps: float = 8.0) -> list[EgoSample]:
    """A past of these accelerations, one every 20 ms."""
    samples, s_m = [], 0.0
    for k, accel_mpss in enumerate(accels_mpss):
        samples.append((0.02 * k, s_m, speed_mps, accel_mpss))
        s_m += 0.02 * speed_mps
        speed_mps += 0.02 * accel_mpss
    return samples


def jitter(mean_mpss: float, by_mpss: float, steps: int = 60) -> list[float]:
    chance = random.Random(1)
    return [mean_mpss + chance.gauss(0.0, by_mpss) for _ in range(steps)]


@pytest.mark.parametrize(
    ("accels_mpss", "unsteady"),
    [
        (jitter(0.0, 0.15), True),
        (jitter(-1.2, 0.3), True),
        (jitter(0.0, 0.002), False),
        ([0.4] * 60, False),
        ([0.3] * 50 + [-2.5] * 10, False),  # it changed its mind, once
        ([-2.0 + 0.06 * k for k in range(60)], False),  # on its way to something else
        ([-1.0 + 0.01 * k for k in range(60)], False),
        (jitter(0.0, 0.3, steps=8), False),  # too short a past to tell
    ],
)
def test_a_foot_trembles_where_it_goes_to_and_fro_at_every_step(accels_mpss: list[float], unsteady: bool) -> None:
    assert Foot.of(past_of(accels_mpss), 0.1).trembles is unsteady


@pytest.mark.parametrize(
    ("accels_mpss", "change_mpsss"),
    [
        ([0.0] * 40 + [-0.05 * k for k in range(1, 8)], -2.5),  # it has begun to brake
        ([-2.0 + 0.02 * k for k in range(60)], 1.0),
        ([0.4] * 60, 0.0),
        ([0.3] * 40 + [-2.5] * 10, 0.0),  # there at once
        (jitter(0.0, 0.3), 0.0),  # whatever the last steps of one that trembles are
        ([*jitter(0.0, 0.3), 0.4, 0.8, 1.2, 1.6], 0.0),
    ],
)
def test_a_foot_that_goes_one_way_is_on_its_way(accels_mpss: list[float], change_mpsss: float) -> None:
    assert Foot.of(past_of(accels_mpss), 0.1).change_mpsss == pytest.approx(change_mpsss)


@pytest.mark.parametrize("predictor", [ConstantAcceleration(), RoadAware(((500.0, 0.0),))])
@pytest.mark.parametrize("seen", [5, 10, 20])
def test_who_begins_to_brake_is_foreseen_to_brake_harder(predictor: Predictor, seen: int) -> None:
    braking = [-2.0 * (1.0 - math.exp(-0.04 * k)) for k in range(100)]
    whole = past_of([0.0] * 40 + braking, speed_mps=12.0)
    past, after_s = whole[: 40 + seen], 0.6
    then = whole[40 + seen - 1 + round(after_s / 0.02)]
    held_mps = past[-1][2] + after_s * past[-1][3]
    foreseen_mps = predictor.predict(past).state(past[-1][0] + after_s)[1]
    assert abs(foreseen_mps - then[2]) < 0.4 * abs(held_mps - then[2])


@pytest.mark.parametrize("predictor", [ConstantAcceleration(), RoadAware(((500.0, 0.0),))])
def test_an_unsteady_acceleration_is_forgotten(predictor: Predictor) -> None:
    steady = past_of([-0.8] * 60)
    unsteady = past_of([-0.8 + (0.2 if k % 2 else -0.2) for k in range(60)])
    now_s, _, speed_mps, _ = unsteady[-1]
    foreseen, held = predictor.predict(unsteady), predictor.predict(steady)
    accels = [foreseen.state(now_s + after_s)[2] for after_s in (0.05, 1.3, 2.6)]
    assert accels[0] < -0.6
    assert accels[0] < accels[1] < accels[2]
    assert abs(accels[2]) < 0.1
    for after_s in (0.5, 1.0):  # soon it has lost less, and all the same it loses what one that is steady does
        assert foreseen.state(now_s + after_s)[1] > held.state(now_s + after_s)[1]
    assert foreseen.state(now_s + 5.0)[1] == pytest.approx(speed_mps - 0.8, abs=0.2)


def test_ego_that_stands_sets_off_again() -> None:
    predictor = ConstantAcceleration(standstill_s=1.5, restart_mpss=1.2, restart_speed_mps=5.0)
    profile = predictor.predict([(4.0, 30.0, 0.0, 0.0)])
    assert profile.state(5.4)[:2] == pytest.approx((30.0, 0.0))
    assert profile.state(6.5)[1] == pytest.approx(1.2)
    assert profile.state(60.0)[1] == pytest.approx(5.0)


def test_ego_that_brakes_to_a_stand_stops_first_and_sets_off_then() -> None:
    profile = ConstantAcceleration().predict(steadily(30.0, 2.0, -4.0))
    assert profile.state(4.5)[:2] == pytest.approx((30.5, 0.0))
    assert profile.state(5.9)[1] == pytest.approx(0.0)
    assert profile.state(6.1)[1] > 0.0


def test_road_aware_stops_with_its_bumper_at_the_line() -> None:
    own = route("S", "W")
    line_m = own.landmarks["stop_line"]
    profile = RoadAware.on(own).predict([(4.0, line_m - 40.0, 8.0, 0.0)])
    stands_m = [s for s, v in (profile.state(4.0 + 0.05 * k)[:2] for k in range(400)) if v == 0.0]
    assert stands_m
    assert line_m - 3.5 <= stands_m[0] <= line_m - BUMPER_M
    assert profile.state(20.0)[0] > line_m + 10.0, "nobody stands for ever, or creeps"


def test_road_aware_slows_down_for_its_turn() -> None:
    own = route("E", "N")
    start_m, end_m = own.landmarks["turn_start"], own.landmarks["turn_end"]
    predictor = RoadAware.on(own)
    profile = predictor.predict([(4.0, start_m - 60.0, 13.0, 0.0)])
    assert profile.state(4.0)[1] == pytest.approx(13.0)
    in_turn = profile.state(profile.time_at(0.5 * (start_m + end_m)) or 0.0)[1]
    assert in_turn < 9.0
    assert profile.time_at(start_m) > ConstantSpeed().predict([(4.0, start_m - 60.0, 13.0, 0.0)]).time_at(start_m)


def test_road_aware_drives_no_bend_faster_than_people_do() -> None:
    own = route("E", "N")
    start_m, end_m = own.landmarks["turn_start"], own.landmarks["turn_end"]
    profile = RoadAware.on(own).predict([(4.0, start_m - 60.0, 13.0, 0.0)])
    for k in range(1, int(end_m - start_m)):
        _, speed_mps, _ = profile.state(profile.time_at(start_m + k) or 0.0)
        assert speed_mps**2 * abs(own.path.curvature(start_m + k)) < 2.5 * 1.2


@pytest.mark.parametrize(("turn", "place"), [(("E", "N"), "turn_start"), (("S", "W"), "stop_line")])
def test_when_road_aware_slows_down_does_not_depend_on_when_it_was_asked(turn: tuple[str, str], place: str) -> None:
    own = route(*turn)
    place_m, found = own.landmarks[place] - 3.0, []
    for k in range(20):
        asked_s = 0.02 * k
        past = [(0.02 * j, place_m - 60.0 + 0.24 * j, 12.0, 0.0) for j in range(k + 1)]
        arrives_s = RoadAware.on(own).predict(past).time_at(place_m)
        assert arrives_s is not None
        assert arrives_s > asked_s
        found.append(arrives_s)
    assert max(found) - min(found) < 0.03


def test_road_aware_believes_one_that_does_not_brake_in_time() -> None:
    own = route("S", "W")
    line_m = own.landmarks["stop_line"]
    speeds = {}
    for accel_mpss in (0.0, -2.0):
        profile = RoadAware((((line_m - 2.6), 0.0),)).predict(steadily(line_m - 12.0, 9.0, accel_mpss))
        speeds[accel_mpss] = min(profile.state(4.0 + 0.05 * k)[1] for k in range(100))
    assert speeds[0.0] == pytest.approx(9.0)  # it would have to brake at 4.3 m/s^2 and does not even begin to
    assert speeds[-2.0] == 0.0


def test_road_aware_looks_at_nothing_behind_it() -> None:
    own = route("S", "W")
    past = steadily(own.landmarks["turn_end"] + 5.0, 8.0, 0.5)
    assert [s.accel_mpss for s in RoadAware.on(own).predict(past).segments] == [
        s.accel_mpss for s in ConstantAcceleration().predict(past).segments
    ]


def test_predictors_have_names() -> None:
    own = route("S", "W")
    assert predictor_called("speed", own) == ConstantSpeed()
    assert predictor_called("acceleration", own) == ConstantAcceleration()
    assert predictor_called("road", own) == RoadAware.on(own)
    with pytest.raises(InputError, match="no such predictor"):
        predictor_called("crystal ball", own)


@dataclass
class Counted:
    """Another predictor, with what it was asked."""

    inner: Predictor
    asked: list[float] = field(default_factory=list)

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        assert [sample[0] for sample in history] == sorted({sample[0] for sample in history})
        self.asked.append(history[-1][0])
        return self.inner.predict(history)


@pytest.mark.parametrize("inner", [ConstantSpeed(), ConstantAcceleration(), RoadAware.on(route("W"))])
def test_any_predictor_can_drive_the_loop(inner: Predictor) -> None:
    predictor = Counted(inner)
    stage = Stage(STORIES["yields, distance"], Noisy(), seed=3, predictor=predictor)
    assert stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 12.0).is_good
    run = stage.run()
    assert judge(case_of(stage.scene, run, stage.limits)).holds_at(TIGHT)
    looked = [record.time_s for record in run.replans if record.status != "frozen"]
    assert sorted(set(predictor.asked)) == pytest.approx(looked)
    assert len(looked) < len(run.replans)


def test_hero_of_a_predictor_that_errs_misses() -> None:
    class Parked:
        def predict(self, history: Sequence[EgoSample]) -> Profile:
            time_s, s_m, _, _ = history[-1]
            return ConstantSpeed().predict([(time_s, s_m, 0.3, 0.0)])

    stage = Stage(STORIES["yields, distance"], Noisy(), seed=3, predictor=Parked())
    start_m = stage.scene.landmarks_m[0]["intersection"] - 90.0
    stage.begin(start_m, 12.0)
    assert not judge(case_of(stage.scene, stage.run(), stage.limits)).holds_at(TIGHT)
