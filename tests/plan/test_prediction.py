"""Predictors: what each believes of an ego, and that any of them can take the place of another."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
import pytest

from scenewright.drive.hostile import Noisy
from scenewright.errors import InputError
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.motion.limits import Signs
from scenewright.motion.profile import Profile
from scenewright.orchestrate import case_of
from scenewright.plan.prediction import (
    ConstantSpeed,
    Driver,
    EgoSample,
    Predictor,
    predictor_called,
)
from scenewright.roads.load import load_map
from scenewright.roads.routes import Route, find_route
from stories import STORIES, Stage

MAP = load_map("t_intersection")
CRUISE_MPS = 13.9
SIGNS = Signs((0.0,), (CRUISE_MPS,))
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


@pytest.mark.parametrize("predictor", [ConstantSpeed(), Driver(SIGNS), Driver(SIGNS, ((500.0, 0.0),))])
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


def test_an_acceleration_lasts_for_a_while() -> None:
    profile = Driver(SIGNS).predict(steadily(30.0, 8.0, -1.5))
    assert profile.state(5.0)[:2] == pytest.approx((30.0 + 8.0 - 0.75, 6.5))
    assert profile.state(9.0)[1] == pytest.approx(6.5)


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
    ("accels_mpss", "goes_on_to_mpss"),
    [
        ([0.4] * 60, 0.4),
        ([0.0] * 40 + [-0.05 * k for k in range(1, 8)], -1.4),  # it has begun to brake
        ([-2.0 + 0.02 * k for k in range(60)], -0.4),
        ([0.3] * 40 + [-2.5] * 10, -2.5),  # another intention, there at once
        ([-1.0 + (0.2 if k % 2 else -0.2) for k in range(60)], -1.0),  # to and fro
        ([0.0] * 50 + [-0.3 * k for k in range(1, 7)], -1.05),  # too fast to go on so
    ],
)
def test_a_foot_goes_on_where_it_goes_one_way_and_slowly(accels_mpss: list[float], goes_on_to_mpss: float) -> None:
    past = past_of(accels_mpss)
    foreseen = Driver(SIGNS).predict(past)
    assert foreseen.state(past[-1][0] + 0.95)[2] == pytest.approx(goes_on_to_mpss, abs=0.1)


@pytest.mark.parametrize("predictor", [Driver(SIGNS), Driver(SIGNS, ((500.0, 0.0),))])
@pytest.mark.parametrize("seen", [6, 10, 20])
def test_who_begins_to_brake_is_foreseen_to_brake_harder(predictor: Predictor, seen: int) -> None:
    braking = [-2.0 * (1.0 - math.exp(-0.025 * k)) for k in range(100)]
    whole = past_of([0.0] * 40 + braking, speed_mps=12.0)
    past, after_s = whole[: 40 + seen], 0.6
    then = whole[40 + seen - 1 + round(after_s / 0.02)]
    held_mps = past[-1][2] + after_s * past[-1][3]
    foreseen_mps = predictor.predict(past).state(past[-1][0] + after_s)[1]
    assert abs(foreseen_mps - then[2]) < 0.4 * abs(held_mps - then[2])


def test_an_unsteady_foot_moves_what_is_foreseen_little() -> None:
    chance = random.Random(1)
    past = past_of([chance.gauss(-0.8, 0.15) for _ in range(80)])
    foreseen = [Driver(SIGNS).predict(past[:k]).state(past[k - 1][0] + 0.5)[2] for k in range(40, 80)]
    assert np.std(foreseen) < 0.5 * np.std([sample[3] for sample in past])


@pytest.mark.parametrize("speed_mps", [1.0, 6.0])
def test_who_speeds_up_on_purpose_goes_on_to_what_people_drive(speed_mps: float) -> None:
    whole = past_of([0.0] * 400)
    free, past = speed_mps, []
    for time_s, *_ in whole:
        accel = 1.5 * (1.0 - (free / CRUISE_MPS) ** 4)
        past.append((time_s, past[-1][1] + 0.02 * past[-1][2] if past else 0.0, free, accel))
        free += 0.02 * accel
    seen = past[:60]
    foreseen = Driver(SIGNS).predict(seen)
    then = past[60 + 200]
    assert foreseen.state(then[0])[1] == pytest.approx(then[2], abs=0.3)
    assert foreseen.state(then[0])[0] == pytest.approx(then[1], abs=0.6)
    gently = past_of([0.3] * 60, speed_mps)
    assert Driver(SIGNS).predict(gently).state(9.0)[1] == pytest.approx(gently[-1][2] + 0.3)


def test_ego_that_stands_sets_off_again() -> None:
    profile = Driver(SIGNS).predict([(4.0, 30.0, 0.0, 0.0)])
    assert profile.state(5.4)[:2] == pytest.approx((30.0, 0.0))
    assert profile.state(6.5)[1] == pytest.approx(1.2)
    assert profile.state(60.0)[1] == pytest.approx(5.0)


def test_ego_that_brakes_to_a_stand_stops_first_and_sets_off_then() -> None:
    profile = Driver(SIGNS).predict(steadily(30.0, 2.0, -4.0))
    assert profile.state(4.5)[:2] == pytest.approx((30.5, 0.0))
    assert profile.state(5.9)[1] == pytest.approx(0.0)
    assert profile.state(6.1)[1] > 0.0


def test_driver_stops_with_its_bumper_at_the_line() -> None:
    own = route("S", "W")
    line_m = own.landmarks["stop_line"]
    profile = Driver.on(own, SIGNS).predict([(4.0, line_m - 40.0, 8.0, 0.0)])
    stands_m = [s for s, v in (profile.state(4.0 + 0.05 * k)[:2] for k in range(400)) if v == 0.0]
    assert stands_m
    assert line_m - 3.5 <= stands_m[0] <= line_m - BUMPER_M
    assert profile.state(20.0)[0] > line_m + 10.0, "nobody stands for ever, or creeps"


def test_driver_slows_down_for_its_turn() -> None:
    own = route("E", "N")
    start_m, end_m = own.landmarks["turn_start"], own.landmarks["turn_end"]
    predictor = Driver.on(own, SIGNS)
    profile = predictor.predict([(4.0, start_m - 60.0, 13.0, 0.0)])
    assert profile.state(4.0)[1] == pytest.approx(13.0)
    in_turn = profile.state(profile.time_at(0.5 * (start_m + end_m)) or 0.0)[1]
    assert in_turn < 9.0
    assert profile.time_at(start_m) > ConstantSpeed().predict([(4.0, start_m - 60.0, 13.0, 0.0)]).time_at(start_m)


def test_driver_drives_no_bend_faster_than_people_do() -> None:
    own = route("E", "N")
    start_m, end_m = own.landmarks["turn_start"], own.landmarks["turn_end"]
    profile = Driver.on(own, SIGNS).predict([(4.0, start_m - 60.0, 13.0, 0.0)])
    for k in range(1, int(end_m - start_m)):
        _, speed_mps, _ = profile.state(profile.time_at(start_m + k) or 0.0)
        assert speed_mps**2 * abs(own.path.curvature(start_m + k)) < 2.5 * 1.2


@pytest.mark.parametrize(("turn", "place"), [(("E", "N"), "turn_start"), (("S", "W"), "stop_line")])
def test_when_a_driver_slows_down_does_not_depend_on_when_it_was_asked(turn: tuple[str, str], place: str) -> None:
    own = route(*turn)
    place_m, found = own.landmarks[place] - 3.0, []
    for k in range(20):
        asked_s = 0.02 * k
        past = [(0.02 * j, place_m - 60.0 + 0.24 * j, 12.0, 0.0) for j in range(k + 1)]
        arrives_s = Driver.on(own, SIGNS).predict(past).time_at(place_m)
        assert arrives_s is not None
        assert arrives_s > asked_s
        found.append(arrives_s)
    assert max(found) - min(found) < 0.03


def test_driver_believes_one_that_does_not_brake_in_time() -> None:
    own = route("S", "W")
    line_m = own.landmarks["stop_line"]
    speeds = {}
    for accel_mpss in (0.0, -2.0):
        profile = Driver(SIGNS, ((line_m - 2.6, 0.0),)).predict(steadily(line_m - 12.0, 9.0, accel_mpss))
        speeds[accel_mpss] = min(profile.state(4.0 + 0.05 * k)[1] for k in range(100))
    assert speeds[0.0] == pytest.approx(9.0)  # it would have to brake at 4.3 m/s^2 and does not even begin to
    assert speeds[-2.0] == 0.0


def test_driver_looks_at_nothing_behind_it() -> None:
    own = route("S", "W")
    past = steadily(own.landmarks["turn_end"] + 5.0, 8.0, 0.5)
    assert [s.accel_mpss for s in Driver.on(own, SIGNS).predict(past).segments] == [
        s.accel_mpss for s in Driver(SIGNS).predict(past).segments
    ]


def test_predictors_have_names() -> None:
    own = route("S", "W")
    assert predictor_called("speed", own, SIGNS) == ConstantSpeed()
    assert predictor_called("acceleration", own, SIGNS) == Driver(SIGNS)
    assert predictor_called("road", own, SIGNS) == Driver.on(own, SIGNS)
    with pytest.raises(InputError, match="no such predictor"):
        predictor_called("crystal ball", own, SIGNS)


@dataclass
class Counted:
    """Another predictor, with what it was asked."""

    inner: Predictor
    asked: list[float] = field(default_factory=list)

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        assert [sample[0] for sample in history] == sorted({sample[0] for sample in history})
        self.asked.append(history[-1][0])
        return self.inner.predict(history)


@pytest.mark.parametrize("inner", [ConstantSpeed(), Driver(SIGNS), Driver.on(route("W"), SIGNS)])
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
