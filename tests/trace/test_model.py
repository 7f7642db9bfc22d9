"""States between samples: exact for constant acceleration."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.trace.model import COLUMNS, ActorTrace, Trace


def braking(steps: int, speed_mps: float, accel: float, step_s: float = 0.1) -> ActorTrace:
    t = np.arange(steps) * step_s
    zero = np.zeros(steps)
    s = speed_mps * t + 0.5 * accel * t**2
    return ActorTrace(t, s, zero, zero, speed_mps + accel * t, np.full(steps, accel), s, zero)


@given(st.floats(0, 20), st.floats(-3, 3), st.floats(0, 0.9))
def test_constant_acceleration_is_exact_between_samples(speed_mps: float, accel: float, time_s: float) -> None:
    actor = braking(10, speed_mps, accel)
    assert actor.position(time_s) == pytest.approx(speed_mps * time_s + 0.5 * accel * time_s**2, abs=1e-9)
    assert actor.speed(time_s) == pytest.approx(speed_mps + accel * time_s, abs=1e-9)
    assert actor.acceleration(time_s) == accel


def test_outside_its_time_a_trace_stays_at_its_ends() -> None:
    actor = braking(4, 10.0, -1.0)
    assert actor.position(-1.0) == 0.0
    assert actor.position(9.0) == actor.s_m[-1]
    assert actor.speed(9.0) == actor.speed_mps[-1]
    assert actor.acceleration(-5.0) == actor.acceleration(9.0) == -1.0


def test_acceleration_is_that_which_starts_at_the_sample() -> None:
    zero = np.zeros(3)
    actor = ActorTrace(np.array([0.0, 1.0, 2.0]), zero, zero, zero, zero, np.array([1.0, 2.0, 3.0]), zero, zero)
    assert [actor.acceleration(t) for t in (0.0, 0.99, 1.0, 1.5, 2.0)] == [1.0, 1.0, 2.0, 2.0, 3.0]


def test_one_sample_is_a_trace() -> None:
    actor = braking(1, 5.0, 0.0)
    assert actor.position(3.0) == 0.0
    assert Trace({"ego": actor}).duration_s == 0.0


def test_actors_share_one_time_axis() -> None:
    with pytest.raises(ValueError, match="one non-empty time axis"):
        Trace({"ego": braking(3, 1.0, 0.0), "hero": braking(4, 1.0, 0.0)})
    empty = ActorTrace(*(np.zeros(0) for _ in range(1 + len(COLUMNS))))
    with pytest.raises(ValueError, match="one non-empty time axis"):
        Trace({"ego": empty})


def test_traces_are_equal_where_all_samples_are() -> None:
    one, same, other = (Trace({"ego": braking(3, speed_mps, 0.0)}) for speed_mps in (1.0, 1.0, 1.5))
    assert one == same
    assert one != other
    assert one != Trace({"ego": braking(4, 1.0, 0.0)})
    assert one.actors["ego"] != "ego"
