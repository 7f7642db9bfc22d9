"""Shares, percentiles and a median of many approaches."""

from __future__ import annotations

import pytest

from scenewright.explain.approach import Approach
from scenewright.study.naturalness import naturalness


def test_nothing_is_told_of_no_run() -> None:
    assert naturalness([]).runs == 0
    assert naturalness([]).reversing is None
    assert naturalness([Approach()]).pace_median is None


def test_many_runs_are_shares_percentiles_and_a_median() -> None:
    runs = [Approach(k >= 2, k == 3, [0.5] * 10, [0.1 * k] * 10, 0.5 + 0.1 * k) for k in range(4)]
    told = naturalness(runs)
    assert (told.runs, told.reversing, told.standing) == (4, 0.5, 0.25)
    assert (told.jerk_p95_mpsss, told.accel_p95_mpss) == (0.5, pytest.approx(0.3))
    assert told.pace_median == pytest.approx(0.65)
