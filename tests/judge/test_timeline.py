"""Motion between samples against the motion that the samples were taken from."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plays import AHEAD, STEP_S, Motion, actor_trace

from scenewright.judge.timeline import Timeline

TIMES = np.arange(0.0, 6.0, STEP_S)


def timeline(motion: Motion, times: np.ndarray = TIMES) -> Timeline:
    return Timeline(actor_trace(motion, times, AHEAD))


@settings(max_examples=60)
@given(
    speed=st.floats(2.0, 15.0),
    changes_s=st.floats(0.5, 5.0),
    rates=st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)),
    shares=st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3),
)
def test_speed_has_its_kink_where_a_piece_ended_between_samples(
    speed: float, changes_s: float, rates: tuple[float, float], shares: list[float]
) -> None:
    """Asked closely around the kink, and anywhere: the speed is the true one, the place within a millimetre."""
    motion = Motion(5.0, speed, [(changes_s, rates[0]), (9.0, rates[1])])
    asked = np.array([*(TIMES[-1] * np.array(shares)), changes_s, changes_s - 0.003, changes_s + 0.004])
    place, true_speed, _ = motion.states(asked)
    if true_speed.min() > 0.01 and motion.states(TIMES)[1].min() > 0.01:  # who stops is another matter, see `phases`
        assert timeline(motion).speed(asked) == pytest.approx(true_speed, abs=1e-6)
        assert timeline(motion).position(asked) == pytest.approx(place, abs=1e-3)


def test_acceleration_is_that_of_the_piece_before_and_behind_the_kink() -> None:
    braking = timeline(Motion(0.0, 12.0, [(3.007, 0.0), (9.0, -2.0)]))
    assert braking.acceleration(np.array([1.0, 3.0065, 3.0075, 4.0])) == pytest.approx([0.0, 0.0, -2.0, -2.0])


def test_slopes_are_those_of_speeds_alone() -> None:
    assert timeline(Motion(0.0, 4.0, [(9.0, 0.5)])).slopes() == pytest.approx(np.full(len(TIMES) - 1, 0.5))


def test_beyond_its_ends_it_stays_as_it_was() -> None:
    moving = timeline(Motion(7.0, 3.0, []))
    assert moving.position(np.array([-5.0, 99.0])) == pytest.approx([7.0, 7.0 + 3.0 * TIMES[-1]])
    alone = timeline(Motion(7.0, 3.0, []), np.array([2.0]))
    assert [float(f(2.5)) for f in (alone.position, alone.speed, alone.acceleration)] == [13.0, 3.0, 0.0]


@pytest.mark.parametrize(
    ("start_s", "end_s", "parts", "instants"),
    [
        (0.0, 0.04, 1, [0.0, 0.02, 0.04]),
        (0.0, 0.04, 2, [0.0, 0.01, 0.02, 0.03, 0.04]),
        (0.005, 0.033, 1, [0.005, 0.02, 0.033]),
        (0.011, 0.019, 1, [0.011, 0.019]),
        (0.5, 0.5, 4, [0.5]),
        (0.7, 0.3, 4, [0.7]),  # an interval that ends before it begins
        (-3.0, 0.01, 1, [0.0, 0.01]),
        (5.97, 99.0, 1, [5.97, 5.98]),
    ],
)
def test_instants_are_both_ends_and_samples_between(
    start_s: float, end_s: float, parts: int, instants: list[float]
) -> None:
    assert timeline(Motion(0.0, 1.0, [])).instants(start_s, end_s, parts) == pytest.approx(instants)
