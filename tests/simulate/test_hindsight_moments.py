"""What is claimed in hindsight speaks of every moment at which the ego was at its side of the trigger."""

from __future__ import annotations

import numpy as np

from scenewright.motion.profile import Profile, chain
from scenewright.program.types import EGO
from scenewright.simulate.hindsight import _moments_at
from scenewright.solve.arrival import TIGHT_TIME_S, LinearCondition, tight_of

# It brakes to a stand 10 m before the place, stands for 3 s and sets off again.
STOPS = Profile(chain(0.0, 0.0, 10.0, [(4.0, 0.0, 0), (5.0, -2.0, 0), (3.0, 0.0, 0), (5.0, 1.5, 0)]))
PLACE_M = 75.0


def arrival_in(seconds: float) -> LinearCondition:
    return LinearCondition("c", frozenset({(EGO, "t1")}), PLACE_M, {EGO: (-1.0, -seconds)})


def at(place_m: float) -> LinearCondition:
    return LinearCondition("c", frozenset({(EGO, "t1")}), -place_m, {EGO: (1.0, 0.0)})


def test_time_to_arrival_that_is_met_again_after_a_stop_counts_again() -> None:
    moments = _moments_at(arrival_in(4.0), STOPS, 17.0)
    assert min(moments) < 9.0
    assert max(moments) > 12.0


def test_no_moment_within_tolerance_is_farther_than_the_proof_allows() -> None:
    for side in (arrival_in(4.0), arrival_in(3.0), at(40.0), at(65.0), at(64.8)):
        moments = np.asarray(_moments_at(side, STOPS, 17.0))
        for time_s in np.arange(0.0, 17.0, 0.01):
            s_m, speed, _ = STOPS.state(float(time_s))
            if abs(side.value({EGO: (s_m, speed)})) <= tight_of(side, speed):
                assert np.min(np.abs(moments - time_s)) <= TIGHT_TIME_S + 1e-9


def test_standing_within_tolerance_lasts_as_long_as_it_stands() -> None:
    moments = _moments_at(at(64.8), STOPS, 17.0)
    assert sum(9.0 <= moment <= 12.0 for moment in moments) >= 29


def test_never_there_gives_none() -> None:
    assert _moments_at(at(500.0), STOPS, 17.0) == []
