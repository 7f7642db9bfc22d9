"""The careful driver at the T intersection: stop line, gaps, patience, left turns, and drivers who pull out."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from world import DT_S, LENGTH_M, Car, drive, overlap, route, start_of

from scenewright.drive.idm import Idm
from scenewright.drive.protocol import Observation
from scenewright.drive.streams import yields
from scenewright.roads import find_conflict

THROUGH, ONCOMING = route("W"), route("E")
OUT_LEFT, OUT_RIGHT, IN_LEFT = route("S", "E"), route("S", "W"), route("E", "N")
STOP_M = OUT_LEFT.landmarks["stop_line"]
ZONE = find_conflict(OUT_LEFT, THROUGH)


def at_line(policy: Idm, others: list[Car], duration_s: float = 20.0):
    """Drive from where the ego stands at the stop line, its obligatory stop just begun."""
    return drive(policy, OUT_LEFT, STOP_M - 0.5 * LENGTH_M - 0.3, 0.0, others, duration_s)


def arriving_in(seconds: float, speed_mps: float = 12.0) -> Car:
    return Car("hero", THROUGH, ZONE.zone_b_m[0] - seconds * speed_mps, speed_mps)


@pytest.mark.parametrize("ego", [OUT_LEFT, OUT_RIGHT], ids=str)
@pytest.mark.parametrize(("back_m", "speed_mps"), [(60.0, 5.0), (30.0, 8.0), (12.0, 2.0), (90.0, 14.0)])
def test_stops_at_the_line_within_a_metre_and_stays_there(ego, back_m: float, speed_mps: float) -> None:
    log = drive(Idm(min_stop_s=0.8), ego, STOP_M - back_m, speed_mps, [], 40.0)
    (halt_m,) = log.halts()
    bumper_m = halt_m + 0.5 * LENGTH_M
    assert STOP_M - 1.0 <= bumper_m <= STOP_M
    standing_s = sum(0.02 for v in log.speed_mps if v < 0.1)
    assert 0.8 <= standing_s <= 2.0
    assert log.s_m[-1] > ego.landmarks["turn_end"]


def test_road_traffic_does_not_stop_at_an_empty_junction() -> None:
    log = drive(Idm(), THROUGH, 200.0, 13.0, [], 15.0)
    assert min(log.speed_mps) > 12.5


def test_lets_a_car_pass_that_arrives_in_three_seconds() -> None:
    log = at_line(Idm(min_stop_s=0.0), [arriving_in(3.0)])
    assert log.passed_s(OUT_LEFT.landmarks["turn_start"]) > 2.0
    assert log.passed_s(ZONE.zone_a_m[0]) > log.other_passed_s(0, ZONE.zone_b_m[1])
    assert log.passed_s(ZONE.zone_a_m[1]) < 15.0
    assert not log.collided


def test_goes_before_a_car_that_arrives_in_twelve_seconds() -> None:
    log = at_line(Idm(), [arriving_in(12.0)])
    assert log.passed_s(ZONE.zone_a_m[1]) < log.other_passed_s(0, ZONE.zone_b_m[0]) - 2.0
    assert not log.collided


@pytest.mark.parametrize("patience_s", [1.0, 3.0])
def test_goes_after_patience_where_the_other_stands(patience_s: float) -> None:
    standing = Car("hero", THROUGH, ZONE.zone_b_m[0] - 6.0, 0.0)
    log = at_line(Idm(patience_s=patience_s), [standing])
    set_off_s = log.passed_s(log.s_m[0] + 0.1)
    assert patience_s <= set_off_s <= 1.25 * patience_s + 1.0
    assert log.s_m[-1] > OUT_LEFT.landmarks["turn_end"]


def test_does_not_drive_into_a_car_that_stands_across_its_way() -> None:
    blocking = Car("hero", THROUGH, ZONE.s_b_m, 0.0)
    log = at_line(Idm(), [blocking], 30.0)
    assert not log.collided
    assert log.speed_mps[-1] == pytest.approx(0.0, abs=0.05)
    assert log.s_m[-1] > STOP_M  # impatient, it goes as far as there is room


def brakes_to_stop_at(stop_m: float, decel_mpss: float):
    def accel(time_s: float, car: Car) -> float:
        return -decel_mpss if stop_m - car.s_m <= car.speed_mps**2 / (2.0 * decel_mpss) else 0.0

    return accel


def test_goes_when_the_car_with_the_right_of_way_stops_for_it() -> None:
    hero = Car("hero", THROUGH, 250.0, 11.0, brakes_to_stop_at(ZONE.s_b_m - 7.0, 2.5))
    log = at_line(Idm(min_stop_s=0.0), [hero])
    assert log.passed_s(ZONE.zone_a_m[1]) < 18.0
    assert not log.collided


@given(arrival_s=st.floats(0.5, 14.0), speed_mps=st.floats(5.0, 16.0), right=st.booleans())
@settings(max_examples=25)
def test_from_the_driveway_it_never_forces_a_road_user_into_a_collision(
    arrival_s: float, speed_mps: float, right: bool
) -> None:
    """Crossing: the other holds its speed. Merging: it follows once the ego is in front, as anyone would."""
    ego = OUT_RIGHT if right else OUT_LEFT
    hero = Car("hero", THROUGH, find_conflict(ego, THROUGH).zone_b_m[0] - arrival_s * speed_mps, speed_mps)
    duration_s = arrival_s + 2.0 if right else 20.0
    log = drive(Idm(), ego, 100.0, 5.5, [hero], duration_s)
    assert not log.collided


@pytest.mark.parametrize("hero_back_m", [30.0, 45.0, 60.0, 75.0])
def test_left_turn_yields_to_oncoming_traffic(hero_back_m: float) -> None:
    zone = find_conflict(IN_LEFT, THROUGH)
    hero = Car("hero", THROUGH, zone.zone_b_m[0] - hero_back_m, 13.0)
    log = drive(Idm(), IN_LEFT, 290.0, 5.0, [hero], 20.0)
    assert log.passed_s(zone.zone_a_m[0]) > log.other_passed_s(0, zone.zone_b_m[1]) - 0.2
    assert log.s_m[-1] > IN_LEFT.landmarks["turn_end"]
    assert not log.collided


def test_left_turn_waits_before_the_turn_for_a_stream_of_cars() -> None:
    stream = [Car(f"car{i}", THROUGH, 300.0 - 30.0 * i, 12.0) for i in range(6)]
    log = drive(Idm(), IN_LEFT, 250.0, 10.0, stream, 30.0)
    assert log.halts()[0] == pytest.approx(IN_LEFT.landmarks["turn_start"], abs=1.0)
    assert log.passed_s(IN_LEFT.landmarks["turn_end"]) > log.other_passed_s(5, 320.0)
    assert not log.collided


@pytest.mark.parametrize("pulls_out_s", [1.5, 2.0, 2.5])
def test_through_traffic_brakes_for_a_car_that_pulls_out(pulls_out_s: float) -> None:
    hero = Car("hero", OUT_LEFT, 132.0, 0.0, lambda t, car: 2.0 if t > pulls_out_s and car.speed_mps < 6.0 else 0.0)
    log = drive(Idm(), THROUGH, 225.0, 13.5, [hero], 20.0)
    assert min(log.accel_mpss) < -2.0
    assert not log.collided
    assert log.s_m[-1] > THROUGH.landmarks["junction_end"]


def test_through_traffic_does_not_brake_for_a_car_that_stops_at_its_line() -> None:
    hero = Car("hero", OUT_LEFT, 95.0, 5.5, brakes_to_stop_at(STOP_M - 0.5 * LENGTH_M, 2.0))
    log = drive(Idm(), THROUGH, 200.0, 13.5, [hero], 15.0)
    assert min(log.accel_mpss) > -0.2


def test_two_careful_drivers_in_turn_both_get_through() -> None:
    """Ego out of the driveway to the left, another careful driver from the road into the driveway to the left."""
    cars = [Car("a", OUT_LEFT, 90.0, 5.0), Car("b", IN_LEFT, 230.0, 10.0)]
    policies = [Idm(), Idm()]
    for seed, (car, policy) in enumerate(zip(cars, policies, strict=True)):
        policy.reset(start_of(car.route, car.s_m, car.speed_mps, seed))
    for step in range(2000):
        states = [car.state() for car in cars]
        assert not overlap(*states)
        accels = [
            policy.step(Observation(step * DT_S, states[i], (states[1 - i],)), DT_S)
            for i, policy in enumerate(policies)
        ]
        for car, accel in zip(cars, accels, strict=True):
            car.move(accel)
    assert all(car.s_m > car.route.landmarks["turn_end"] for car in cars)


@pytest.mark.parametrize(
    ("ego", "other", "expected"),
    [
        (OUT_LEFT, THROUGH, True),
        (THROUGH, OUT_LEFT, False),
        (IN_LEFT, THROUGH, True),
        (THROUGH, IN_LEFT, False),
        (OUT_LEFT, IN_LEFT, True),
        (route("W", "N"), IN_LEFT, False),
    ],
    ids=str,
)
def test_right_of_way(ego, other, expected: bool) -> None:
    assert yields(ego, other) is expected


def test_one_that_is_about_to_merge_is_not_followed_yet_but_given_way_to() -> None:
    """It stands across the corner of the ego's own way, and is not on it."""
    waits = Car("hero", route("W", "N"), 316.4, 0.0, lambda t, car: 4.0 if t >= 0.6 and car.speed_mps < 5.5 else 0.0)
    log = drive(Idm(), route("E", "N"), 289.0, 6.4, [waits], 12.0)
    assert not log.collided
    assert min(log.speed_mps) < 4.5
