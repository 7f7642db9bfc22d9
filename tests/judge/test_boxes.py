"""The distance that two boxes surely keep: never more than they keep, hardly less, whatever happens between samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.judge.boxes import distances_m, moving_box, surely_apart_m
from scenewright.roads.bodies import CAR
from scenewright.trace.model import ActorTrace, FloatArray

STEP_S, LASTS_S = 0.02, 4.0


def turning(time_s: FloatArray, from_m: tuple[float, float], heading: float, speed: float, turns: float) -> ActorTrace:
    """Return a car that drives a circle, or straight on where it does not turn (rad/s)."""
    ways = heading + turns * time_s
    if turns:
        x, y = speed / turns * (np.sin(ways) - np.sin(heading)), speed / turns * (np.cos(heading) - np.cos(ways))
    else:
        x, y = speed * np.cos(heading) * time_s, speed * np.sin(heading) * time_s
    even = np.full(len(time_s), speed)
    return ActorTrace(time_s, from_m[0] + x, from_m[1] + y, ways, even, 0.0 * even, speed * time_s, 0.0 * even)


@given(
    heading=st.floats(-3.1, 3.1),
    speeds=st.tuples(st.floats(0.0, 15.0), st.floats(0.0, 15.0)),
    turns=st.tuples(st.sampled_from([0.0, -0.4, 0.5]), st.sampled_from([0.0, 0.3])),
    from_m=st.tuples(st.floats(-30.0, 30.0), st.floats(-30.0, 30.0)),
)
def test_it_is_no_more_than_what_they_keep_and_hardly_less(
    heading: float, speeds: tuple[float, float], turns: tuple[float, float], from_m: tuple[float, float]
) -> None:
    def both(time_s: FloatArray) -> tuple[ActorTrace, ActorTrace]:
        return (
            turning(time_s, (0.0, 0.0), 0.0, speeds[0], turns[0]),
            turning(time_s, from_m, heading, speeds[1], turns[1]),
        )

    sure_m = surely_apart_m(*both(np.arange(0.0, LASTS_S, STEP_S)), (CAR, CAR))
    fine_s = np.arange(0.0, LASTS_S - STEP_S, STEP_S / 16)
    least_m = distances_m(*(moving_box(states, CAR, fine_s) for states in both(fine_s))).min()
    assert sure_m <= least_m + 1e-9
    assert sure_m >= least_m - 0.02 or sure_m == pytest.approx(least_m, abs=0.02 * sum(speeds) / 2)


def test_who_meets_between_two_samples_was_not_apart() -> None:
    """Two cars that are past each other at the next sample: seen at samples only they never touched."""
    time_s = np.array([0.0, 1.0])
    one = turning(time_s, (0.0, 0.0), 0.0, 15.0, 0.0)
    other = turning(time_s, (15.0, 0.0), np.pi, 15.0, 0.0)
    assert surely_apart_m(one, other, (CAR, CAR)) < 0.0
