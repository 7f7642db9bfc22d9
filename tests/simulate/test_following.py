"""An ego behind a hero is foreseen to react to it, unless it is seen not to."""

from __future__ import annotations

import pytest
from stories import HERO, driven

from scenewright.motion.profile import Profile, chain
from scenewright.roads.conflicts import VEHICLE_LENGTH_M
from scenewright.simulate.following import Leader, foresee_follower
from scenewright.simulate.prediction import ConstantAcceleration, EgoSample

CRUISE_MPS = 13.9


def idm(moments: int, leader: Leader, s_m: float, speed_mps: float, headway_s: float) -> list[EgoSample]:
    """Drive a textbook follower step by step, written apart from the project's own."""
    accel_max, brake, standstill_m, step_s = 1.5, 2.0, 2.0, 0.02
    samples = []
    for k in range(moments):
        time_s = k * step_s
        room_m, leader_mps = leader.ahead(time_s, s_m)
        wanted_m = standstill_m + max(
            0.0, speed_mps * headway_s + speed_mps * (speed_mps - leader_mps) / (2 * (accel_max * brake) ** 0.5)
        )
        accel = accel_max * (1 - (speed_mps / CRUISE_MPS) ** 4 - (wanted_m / room_m) ** 2)
        samples.append((time_s, s_m, speed_mps, accel))
        s_m += speed_mps * step_s
        speed_mps = max(0.0, speed_mps + accel * step_s)
    return samples


@pytest.mark.parametrize("headway_s", [1.0, 1.3, 1.8])
@pytest.mark.parametrize("then_mpss", [-2.0, 0.0, 1.0])
def test_a_follower_is_foreseen_better_than_without_its_leader(headway_s: float, then_mpss: float) -> None:
    leader = Leader(Profile(chain(0.0, 30.0, 9.0, [(1.0, 0.0, 0), (3.0, then_mpss, 0)])), 0.0)
    drive = idm(200, leader, 0.0, 10.0, headway_s)
    past, later = drive[:51], drive[-1]
    base = ConstantAcceleration(cruise_mps=CRUISE_MPS).predict(past)
    foreseen = foresee_follower(base, past, leader, CRUISE_MPS)
    off_m, base_off_m = (abs(profile.state(later[0])[0] - later[1]) for profile in (foreseen, base))
    assert off_m < (0.1 if headway_s == 1.3 and then_mpss == 0.0 else 0.9)
    assert off_m < max(base_off_m, 0.7)


def test_one_that_is_seen_not_to_heed_its_leader_is_taken_not_to() -> None:
    leader = Leader(Profile(chain(0.0, 14.0, 8.0, [(9.0, 0.0, 0)])), 0.0)
    past = [(0.02 * k, 0.16 * k, 8.0, 0.0) for k in range(60)]
    base = ConstantAcceleration().predict(past)
    assert foresee_follower(base, past, leader, CRUISE_MPS) is base


def test_a_leader_far_ahead_or_behind_changes_nothing() -> None:
    past = [(0.02 * k, 0.2 * k, 10.0, 0.0) for k in range(60)]
    base = ConstantAcceleration().predict(past)
    behind = Leader(Profile(chain(0.0, -20.0, 10.0, [(9.0, 0.0, 0)])), 0.0)
    assert foresee_follower(base, past, behind, CRUISE_MPS) is base
    far = Leader(Profile(chain(0.0, 400.0, 10.0, [(9.0, 0.0, 0)])), 0.0)
    foreseen = foresee_follower(base, past, far, CRUISE_MPS)
    assert foreseen.state(4.0)[:2] == pytest.approx(base.state(4.0)[:2], abs=0.05)


def test_bumpers_not_centres() -> None:
    leader = Leader(Profile(chain(0.0, 20.0, 5.0, [(1.0, 0.0, 0)])), 3.0)
    assert leader.ahead(0.0, 10.0) == pytest.approx((13.0 - VEHICLE_LENGTH_M, 5.0))


@pytest.mark.parametrize("ego", ["idm", "noisy", "staller"])
def test_a_hero_that_is_followed_does_not_stir_before_its_trigger(ego: str) -> None:
    run = driven("brakes at a rate", ego, 0).run
    assert run is not None
    hero = run.last_plan.profiles[HERO]
    before = [segment for segment in hero.segments if segment.end_s <= hero.knot_times_s["t1"] + 1e-6]
    changed_mps = sum(abs(segment.accel_mpss) * segment.duration_s for segment in before)
    assert changed_mps < 0.5
