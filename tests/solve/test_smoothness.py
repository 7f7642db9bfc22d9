"""The smoothest way ends as the given one does, never accelerates more in sum, and stays within bounds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from scenewright.motion.profile import Profile, chain
from scenewright.solve.smoothness import Leg, smoothest

legs = st.lists(st.tuples(st.floats(0.1, 2.0), st.floats(-1.0, 1.0)), min_size=1, max_size=6)


def end_of(ways: list[Leg], speed_mps: float, accels: list[float]) -> tuple[float, float]:
    moves = [(leg.duration_s, accel, 0) for leg, accel in zip(ways, accels, strict=True)]
    place_m, end_mps, _ = Profile(chain(0.0, 0.0, speed_mps, moves)).state(sum(leg.duration_s for leg in ways))
    return place_m, end_mps


def effort(ways: list[Leg], accels: list[float]) -> float:
    return sum(leg.duration_s * accel**2 for leg, accel in zip(ways, accels, strict=True))


@given(drawn=legs, speed_mps=st.floats(4.0, 14.0), most=st.floats(0.5, 5.0))
def test_ends_alike_within_bounds_and_never_with_more_effort(
    drawn: list[tuple[float, float]], speed_mps: float, most: float
) -> None:
    ways = [Leg(duration_s, -most, 0.8 * most) for duration_s, _ in drawn]
    accels = [max(-most, min(0.8 * most, share * most)) for _, share in drawn]
    gains = [leg.duration_s * accel for leg, accel in zip(ways, accels, strict=True)]
    assume(min(np.cumsum([speed_mps, *gains])) >= 0.0)  # a motion that is known is one that can be driven
    found = smoothest(ways, speed_mps, 60.0, accels)
    assert end_of(ways, speed_mps, found) == pytest.approx(end_of(ways, speed_mps, accels), abs=1e-6)
    assert effort(ways, found) <= effort(ways, accels) + 1e-9
    assert all(leg.least_mpss - 1e-6 <= accel <= leg.most_mpss + 1e-6 for leg, accel in zip(ways, found, strict=True))


def test_is_what_least_squares_says_where_no_bound_is_met() -> None:
    ways = [Leg(0.5, -9.0, 9.0), Leg(1.0, -9.0, 9.0), Leg(0.75, -9.0, 9.0), Leg(0.6, -9.0, 9.0)]
    accels = [4.0, -5.0, 3.0, -0.2]
    durations = np.array([leg.duration_s for leg in ways])
    remaining = durations[::-1].cumsum()[::-1] - 0.5 * durations
    sums = np.vstack([durations, durations * remaining])
    # Least norm in the variables a sqrt(d), found by the pseudo-inverse.
    scaled = np.linalg.pinv(sums / np.sqrt(durations)) @ (sums @ np.array(accels))
    assert smoothest(ways, 10.0, 30.0, accels) == pytest.approx(list(scaled / np.sqrt(durations)))


def test_a_zigzag_becomes_even() -> None:
    ways = [Leg(0.5, -6.0, 4.0)] * 4
    zigzag = [4.0, -4.0, 4.0, -4.0]
    assert effort(ways, smoothest(ways, 8.0, 18.0, zigzag)) < 0.25 * effort(ways, zigzag)


def test_keeps_the_way_known_where_a_smoother_one_would_reverse_or_speed() -> None:
    ways = [Leg(1.0, -6.0, 4.0)] * 3
    waits = [-2.0, 0.0, 3.0]  # to a stand, and off again
    assert min(np.cumsum([2.0, *smoothest(ways, 2.0, 18.0, waits)])) >= -1e-6
    assert smoothest([Leg(1.0, -1.0, 1.0)], 5.0, 18.0, [0.5]) == [0.5]
