"""What a plan starts from: the ego as it was seen and is foreseen."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.motion.profile import Profile, chain
from scenewright.plan.situation import SeenAndForeseen

STEP_S = 0.02


def seen(accels: list[float], speed_mps: float = 10.0) -> list[tuple[float, float, float, float]]:
    samples, s_m = [], 0.0
    for k, accel in enumerate([*accels, 0.0]):
        samples.append((k * STEP_S, s_m, speed_mps, accel))
        s_m += (speed_mps + 0.5 * accel * STEP_S) * STEP_S
        speed_mps += accel * STEP_S
    return samples


@given(accels=st.lists(st.floats(-4.0, 3.0), min_size=1, max_size=30), share=st.floats(0.0, 1.0))
def test_the_ego_is_where_it_was_seen_and_then_where_it_is_foreseen(accels: list[float], share: float) -> None:
    samples = seen(accels)
    now_s, s_m, speed_mps, _ = samples[-1]
    ego = SeenAndForeseen(samples, Profile(chain(now_s, s_m, speed_mps, [(2.0, -1.0, 0)])))
    for time_s, then_m, then_mps, accel in samples[:-1]:
        assert ego(time_s) == pytest.approx((then_m, then_mps, accel), abs=1e-6)
    assert ego(now_s) == pytest.approx((s_m, speed_mps, -1.0))
    assert ego(now_s + 1.0) == pytest.approx((s_m + speed_mps - 0.5, speed_mps - 1.0, -1.0))
    # Between two samples it goes on evenly: nothing jumps, and places are what the speeds make of them.
    time_s = share * now_s
    before, after = ego(time_s), ego(time_s + 1e-4)
    assert after[0] - before[0] == pytest.approx(1e-4 * 0.5 * (before[1] + after[1]), abs=1e-7)
    assert abs(after[1] - before[1]) <= 4e-4 + 1e-9


def test_before_anything_was_seen_it_was_on_its_way() -> None:
    ego = SeenAndForeseen(seen([0.0, 0.0]), Profile(chain(0.04, 0.4, 10.0, [(1.0, 0.0, 0)])))
    assert ego(-1.0)[:2] == pytest.approx((-10.0, 10.0))
