"""Searches of continuous time against functions whose minima and roots are known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scenewright.judge.instants import first_crossing, minima, sharpen, stretches
from scenewright.judge.tolerance import FloatArray

GRID = np.arange(0.0, 10.0 + 1e-9, 0.02)


@settings(max_examples=50)
@given(root=st.floats(0.0, 10.0), slope=st.sampled_from([-3.0, -0.01, 0.5, 40.0]))
def test_a_root_is_found_between_samples_from_either_side(root: float, slope: float) -> None:
    found = first_crossing(lambda t: slope * (t - root), GRID)
    assert found is not None
    assert found == pytest.approx(root, abs=1e-9)


def test_of_several_roots_the_first_is_found() -> None:
    assert first_crossing(np.cos, GRID) == pytest.approx(np.pi / 2, abs=1e-9)


def test_a_jump_across_zero_is_a_crossing_where_it_jumps() -> None:
    assert first_crossing(lambda t: np.where(t < 4.013, -1.0, 2.0), GRID) == pytest.approx(4.013, abs=1e-9)


def test_zero_at_the_start_counts_and_what_stays_on_one_side_is_no_crossing() -> None:
    assert first_crossing(lambda t: t, GRID) == 0.0
    assert first_crossing(lambda t: t + 1e-9, GRID) is None
    assert first_crossing(lambda t: -1.0 - t, GRID) is None


@settings(max_examples=50)
@given(at=st.floats(0.0, 10.0), high=st.floats(0.1, 50.0), low=st.floats(-5.0, 5.0))
def test_a_minimum_is_found_between_samples(at: float, high: float, low: float) -> None:
    """A kink, as errors have: the distance to a place on both sides of the moment at which it is passed."""
    (best, *_) = minima(lambda t: low + high * np.abs(t - at), GRID)
    assert best.time_s == pytest.approx(at, abs=1e-6)
    assert best.score == pytest.approx(low, abs=1e-6)


def test_minima_come_best_first_and_equally_good_ones_in_time() -> None:
    def valleys(t: FloatArray) -> FloatArray:
        return np.minimum.reduce([np.abs(t - 2.0), 0.5 + np.abs(t - 5.0), np.abs(t - 8.0)])

    assert [round(minimum.time_s, 6) for minimum in minima(valleys, GRID)] == [2.0, 8.0, 5.0]
    assert sharpen(valleys, GRID) == pytest.approx([2.0, 8.0, 5.0])


def test_of_a_stretch_that_is_equally_low_the_first_instant_counts() -> None:
    (best,) = minima(lambda t: np.maximum(0.0, 3.006 - t), GRID)
    assert best.time_s == pytest.approx(3.006, abs=1e-6)
    assert best.score == 0.0


def test_what_has_no_value_anywhere_has_no_minimum() -> None:
    assert minima(lambda t: np.full_like(t, np.inf), GRID) == []
    (best,) = minima(lambda t: np.where(t < 7.0, np.inf, t), GRID)
    assert best.time_s == pytest.approx(7.0, abs=1e-6)


@pytest.mark.parametrize(
    ("holds", "found"),
    [([], []), ([0, 0], []), ([1], [(0, 0)]), ([1, 1, 0, 0, 1], [(0, 1), (4, 4)]), ([0, 1, 1], [(1, 2)])],
)
def test_stretches_are_from_the_first_to_the_last_point_that_holds(
    holds: list[int], found: list[tuple[int, int]]
) -> None:
    assert stretches(np.array(holds, dtype=bool)) == found
