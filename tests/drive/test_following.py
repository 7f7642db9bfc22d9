"""Following, envelopes and repeatability of all policies."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from world import Car, Log, drive, route, start_of

from scenewright.drive.constant import Constant
from scenewright.drive.idm import Idm
from scenewright.drive.loading import BUILT_IN, load_policy

THROUGH, OUT_LEFT, IN_LEFT = route("W"), route("S", "E"), route("E", "N")
CAREFUL = ["idm", "dawdler", "staller", "stop-and-go"]


def build(name: str):
    return load_policy(name).policy


def busy(name: str, seed: int) -> Log:
    """Drive out of the driveway among two cars on the road."""
    others = [Car("hero", THROUGH, 180.0, 12.0), Car("third", route("E"), 150.0, 11.0)]
    return drive(build(name), OUT_LEFT, 80.0, 5.0, others, 20.0, seed)


@given(
    gap_m=st.floats(25.0, 80.0),
    speed_mps=st.floats(4.0, 13.9),
    leader_mps=st.floats(4.0, 13.9),
    brakes_s=st.floats(0.0, 6.0),
)
@settings(max_examples=40)
def test_never_hits_a_leader_that_brakes_hard(
    gap_m: float, speed_mps: float, leader_mps: float, brakes_s: float
) -> None:
    leader = Car("hero", THROUGH, 50.0 + gap_m, leader_mps, lambda t, car: -6.0 if t >= brakes_s else 0.0)
    log = drive(Idm(), THROUGH, 50.0, speed_mps, [leader], 25.0)
    assert not log.collided
    assert log.speed_mps[-1] < 0.3
    assert leader.s_m - log.s_m[-1] < 4.5 + 4.0  # box to box it closes up to about two metres


def test_follows_a_leader_that_turns_into_the_driveway_and_then_goes_on() -> None:
    leader = Car("hero", route("W", "N"), 270.0, 6.0, lambda t, car: -1.0 if car.speed_mps > 3.0 else 0.0)
    log = drive(Idm(), THROUGH, 235.0, 13.0, [leader], 25.0)
    assert not log.collided
    assert min(log.speed_mps) < 8.0
    assert log.speed_mps[-1] > 12.0


@pytest.mark.parametrize("ahead_m", [14.0, 20.0, 30.0])
@pytest.mark.parametrize("leader_mps", [3.0, 6.0, 10.0])
def test_follows_a_leader_through_a_junction_as_on_any_road(ahead_m: float, leader_mps: float) -> None:
    """One that drives ahead on the same way is not taken for one that comes from another road."""
    leader = Car("hero", THROUGH, 240.0 + ahead_m, leader_mps)
    log = drive(Idm(), THROUGH, 240.0, leader_mps, [leader], 25.0)
    assert log.s_m[-1] > 310.0
    assert min(log.accel_mpss) > -2.5


def test_slows_down_for_the_turn_comfortably() -> None:
    log = drive(Idm(), IN_LEFT, 150.0, 13.8, [], 25.0)
    inside = [v for s, v in zip(log.s_m, log.speed_mps, strict=True) if 302.0 <= s <= 324.0]
    curve = max(abs(IN_LEFT.path.curvature(s)) for s in range(302, 324))
    assert max(inside) ** 2 * curve < 2.5 * 1.1
    assert min(log.accel_mpss) > -2.1


@pytest.mark.parametrize("name", sorted(BUILT_IN))
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_keeps_its_promise_and_never_reverses(name: str, seed: int) -> None:
    policy = build(name)
    for ego, s_m, speed_mps in ((OUT_LEFT, 80.0, 5.0), (THROUGH, 200.0, 13.0), (IN_LEFT, 240.0, 16.0)):
        others = [Car("hero", THROUGH, 260.0, 9.0, lambda t, car: -3.0 if 2.0 < t < 4.0 else 1.0)]
        log = drive(policy, ego, s_m, speed_mps, others, 20.0, seed)
        promise = policy.envelope
        assert max(log.speed_mps) <= promise.speed_max_mps + 1e-6
        for speed, accel in zip(log.speed_mps, log.accel_mpss, strict=True):
            assert speed + accel * 0.02 >= -1e-9
            assert promise.accel_min_mpss - 1e-9 <= accel <= promise.accel_max_mpss + 1e-9
        if promise.holds_speed:
            assert max(log.speed_mps) == min(log.speed_mps)


@pytest.mark.parametrize("name", sorted(BUILT_IN))
def test_the_same_seed_gives_the_same_motion(name: str) -> None:
    assert busy(name, 5).accel_mpss == busy(name, 5).accel_mpss


@pytest.mark.parametrize("name", sorted(BUILT_IN))
def test_reset_forgets_the_run_before(name: str) -> None:
    policy = build(name)
    runs = [
        drive(policy, OUT_LEFT, 80.0, 5.0, [Car("hero", THROUGH, s_m, 12.0)], 12.0, seed=3).accel_mpss
        for s_m in (200.0, 250.0, 200.0)
    ]
    assert runs[0] == runs[2]


@pytest.mark.parametrize("name", ["speeder", "dawdler", "staller", "stop-and-go", "noisy"])
def test_another_seed_gives_another_motion(name: str) -> None:
    assert busy(name, 5).accel_mpss != busy(name, 6).accel_mpss


@pytest.mark.parametrize("name", CAREFUL)
@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_careful_ones_do_not_collide_out_of_the_driveway(name: str, seed: int) -> None:
    assert not busy(name, seed).collided


def test_speeder_is_too_fast_and_does_not_stop() -> None:
    log = drive(build("speeder"), THROUGH, 20.0, 13.0, [], 20.0)
    assert 1.25 * 13.89 < max(log.speed_mps) <= 1.05 * 1.5 * 13.89
    assert min(drive(build("speeder"), OUT_LEFT, 90.0, 5.0, [], 10.0).speed_mps) > 4.0


def test_dawdler_is_slow_and_stops_at_the_line() -> None:
    log = drive(build("dawdler"), THROUGH, 20.0, 6.0, [], 30.0)
    assert 0.38 * 13.89 < log.speed_mps[-1] < 0.62 * 13.89
    assert len(drive(build("dawdler"), OUT_LEFT, 90.0, 2.0, [], 30.0).halts()) == 1


def test_staller_stands_for_as_long_as_it_says() -> None:
    standing = []
    for seed in range(6):
        log = drive(build("staller"), THROUGH, 20.0, 10.0, [], 40.0, seed)
        lengths = [0]
        for speed in log.speed_mps:
            if speed < 0.05:
                lengths[-1] += 1
            elif lengths[-1]:
                lengths.append(0)
        standing += [0.02 * n for n in lengths[:-1]]
    assert len(standing) > 6
    assert all(1.4 <= s <= 4.2 for s in standing)
    assert max(standing) - min(standing) > 0.5


def test_stop_and_go_alternates() -> None:
    log = drive(build("stop-and-go"), THROUGH, 20.0, 8.0, [], 60.0)
    crawls = sum(before >= 2.0 > after for before, after in zip(log.speed_mps, log.speed_mps[1:], strict=False))
    assert crawls >= 4
    assert max(log.speed_mps) > 5.0


def test_noise_is_correlated_and_as_large_as_asked() -> None:
    alone = [drive(build(f"noisy:sigma_mpss={s}"), THROUGH, 20.0, 13.0, [], 60.0).accel_mpss for s in (0.0, 0.5)]
    assert max(map(abs, alone[0])) < 0.5
    steps = [abs(b - a) for a, b in zip(alone[1], alone[1][1:], strict=False)]
    assert max(alone[1]) - min(alone[1]) > 0.2
    assert sorted(steps)[len(steps) // 2] < 0.15


def test_delayed_reacts_later_than_the_careful_driver() -> None:
    def reaction_s(name: str) -> float:
        leader = Car("hero", THROUGH, 90.0, 12.0, lambda t, car: -6.0 if t >= 5.0 else 0.0)
        log = drive(build(name), THROUGH, 50.0, 12.0, [leader], 12.0)
        before = log.accel_mpss[249]
        return next(t for t, a in zip(log.time_s, log.accel_mpss, strict=True) if t > 5.0 and a < before - 0.2)

    assert reaction_s("delayed") - reaction_s("idm") == pytest.approx(0.4, abs=0.15)


def test_constant_holds_its_speed_and_goes_to_one_asked_for() -> None:
    assert set(drive(Constant(), THROUGH, 20.0, 7.3, [], 5.0).speed_mps) == {7.3}
    forced = Constant(speed_mps=9.0)
    log = drive(forced, THROUGH, 20.0, 6.0, [], 5.0)
    assert not forced.envelope.holds_speed
    assert log.speed_mps[-1] == pytest.approx(9.0)
    assert forced.preferred_speed_mps(start_of(THROUGH, 20.0, 0.0)) == 9.0
    drive(forced, THROUGH, 20.0, 9.0, [], 1.0)
    assert forced.envelope.holds_speed


@pytest.mark.parametrize("name", [name for name in sorted(BUILT_IN) if name != "constant"])
def test_preferred_speed_is_one_it_holds(name: str) -> None:
    policy = load_policy(name).policy
    speed_mps = policy.preferred_speed_mps(start_of(THROUGH, 20.0, 0.0, seed=4))
    log = drive(policy, THROUGH, 20.0, speed_mps, [], 1.0, seed=4)
    assert log.speed_mps[-1] == pytest.approx(speed_mps, abs=2.0)
    if name in ("idm", "speeder", "dawdler", "delayed"):
        assert log.speed_mps[-1] == pytest.approx(speed_mps, abs=0.05)


def test_who_drives_fast_sees_further() -> None:
    """On motorways a leader that was seen from 120 m on made a careful driver brake with 8 m/s^2."""

    def at_first(ahead_m: float, speed_mps: float) -> float:
        log = drive(build("speeder"), THROUGH, 50.0, speed_mps, [Car("hero", THROUGH, 50.0 + ahead_m, 0.0)], 0.1)
        return log.accel_mpss[0]

    assert at_first(150.0, 10.0) == at_first(250.0, 10.0)
    assert at_first(150.0, 19.0) < at_first(250.0, 19.0) - 0.5
