"""An ego behind a hero is foreseen to react to it, in its own way."""

from __future__ import annotations

import numpy as np
import pytest
from followers import CRUISE_MPS, SIGNS, idm
from hypothesis import given
from hypothesis import strategies as st

from scenewright.motion.profile import Profile, chain
from scenewright.plan.following import Leader, foresee_follower
from scenewright.plan.prediction import Driver
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from stories import HERO, driven


@pytest.mark.parametrize("headway_s", [1.0, 1.3, 1.8, 2.2])
@pytest.mark.parametrize("then_mpss", [-2.0, 0.0, 1.0])
def test_a_follower_is_foreseen_at_the_headway_that_it_is_seen_to_keep(headway_s: float, then_mpss: float) -> None:
    leader = Leader(Profile(chain(0.0, 30.0, 9.0, [(1.0, 0.0, 0), (3.0, then_mpss, 0)])), 0.0)
    drive = idm(200, leader, 0.0, 10.0, headway_s)
    past, later = drive[:51], drive[-1]
    base = Driver(SIGNS).predict(past)
    foreseen = foresee_follower(base, past, leader, CRUISE_MPS)
    off_m, base_off_m = (abs(profile.state(later[0])[0] - later[1]) for profile in (foreseen, base))
    assert off_m < 0.1
    assert off_m < 0.5 * base_off_m


def test_one_that_does_otherwise_than_the_model_goes_on_to_for_a_moment() -> None:
    """It keeps its speed, as close as it is: it is foreseen to, and to fall back only later."""
    leader = Leader(Profile(chain(0.0, 10.0, 8.0, [(9.0, 0.0, 0)])), 0.0)
    past = [(0.02 * k, 0.16 * k, 8.0, 0.0) for k in range(60)]
    foreseen = foresee_follower(Driver(SIGNS).predict(past), past, leader, CRUISE_MPS)
    now_s, s_m, _, _ = past[-1]
    assert foreseen.state(now_s + 0.8)[:2] == pytest.approx((s_m + 6.4, 8.0), abs=0.1)
    assert foreseen.state(now_s + 8.0)[0] < s_m + 64.0


def test_a_leader_far_ahead_or_behind_changes_nothing() -> None:
    past = [(0.02 * k, 0.2 * k, 10.0, 0.0) for k in range(60)]
    base = Driver(SIGNS).predict(past)
    behind = Leader(Profile(chain(0.0, -20.0, 10.0, [(9.0, 0.0, 0)])), 0.0)
    assert foresee_follower(base, past, behind, CRUISE_MPS) is base
    far = Leader(Profile(chain(0.0, 400.0, 10.0, [(9.0, 0.0, 0)])), 0.0)
    foreseen = foresee_follower(base, past, far, CRUISE_MPS)
    assert foreseen.state(4.0)[:2] == pytest.approx(base.state(4.0)[:2], abs=0.05)


def test_bumpers_not_centres() -> None:
    leader = Leader(Profile(chain(0.0, 20.0, 5.0, [(1.0, 0.0, 0)])), 3.0)
    assert leader.ahead(0.0, 10.0) == pytest.approx((13.0 - VEHICLE_LENGTH_M, 5.0))


@pytest.mark.parametrize("ego", ["idm", "noisy", "staller"])
def test_a_hero_that_is_followed_hardly_stirs_before_its_trigger(ego: str) -> None:
    run = driven("brakes at a rate", ego, 0).run
    assert run is not None
    hero = run.last_plan.profiles[HERO]
    times = np.linspace(0.0, hero.knot_times_s["t1"] - 1e-3, 500)
    changed_mps = np.abs(np.diff([hero.state(float(t))[1] for t in times])).sum()
    assert changed_mps < 0.8


@given(
    at_s=st.floats(1.5, 8.0),
    from_s=st.floats(0.0, 1.0),
    further_m=st.floats(-2.0, 2.0),
    faster_mps=st.floats(-1.0, 1.0),
    ever_faster_mpss=st.floats(-0.5, 0.5),
)
def test_a_motion_otherwise_is_so_much_further_on_as_its_speeds_make_it(
    at_s: float, from_s: float, further_m: float, faster_mps: float, ever_faster_mpss: float
) -> None:
    motion = Profile(chain(0.0, 0.0, 8.0, [(3.0, -1.0, 0)]))
    other = Leader(motion, 0.0, from_s, further_m, faster_mps, ever_faster_mpss)
    assert other.state(from_s)[0] - motion.state(from_s)[0] == pytest.approx(further_m)
    times = np.linspace(from_s, at_s, 400)
    places, speeds = np.array([other.state(float(t))[:2] for t in times]).T
    travelled = np.sum(0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times))
    assert places[-1] - places[0] == pytest.approx(travelled, abs=1e-2)
    since = at_s - from_s
    expected = further_m + (faster_mps + 0.5 * ever_faster_mpss * since) * since
    assert places[-1] - motion.state(at_s)[0] == pytest.approx(expected)
    assert speeds[-1] - motion.state(at_s)[1] == pytest.approx(faster_mps + ever_faster_mpss * since)
