"""Braking, speeding up, standing and moving off, read from speeds: found where they began, between samples."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plays import AHEAD, STEP_S, Motion, actor_trace

from scenewright.judge.phases import BRAKING, SPEEDING_UP, Sign, move_off_after, phase_at, rest_after
from scenewright.judge.timeline import Timeline
from scenewright.program.manner import USUAL


def drive(*pieces: tuple[float, float], speed: float = 12.0, lasts_s: float = 16.0) -> Timeline:
    return Timeline(actor_trace(Motion(0.0, speed, pieces), np.arange(0.0, lasts_s, STEP_S), AHEAD))


@settings(max_examples=60)
@given(begins_s=st.floats(1.0, 5.0), rate=st.floats(0.3, 6.0), sign=st.sampled_from([BRAKING, SPEEDING_UP]))
def test_a_phase_begins_where_it_began_between_samples(begins_s: float, rate: float, sign: Sign) -> None:
    # Below twice the manner's number a phase is seen from half of what it comes to.
    phase = phase_at(drive((begins_s, 0.0), (1.2, sign * rate)), 0.0, sign, USUAL)
    assert phase is not None
    assert phase.start_s == pytest.approx(begins_s, abs=1e-6)
    assert phase.end_s == pytest.approx(begins_s + 1.2, abs=STEP_S + 1e-6)
    assert phase_at(drive((begins_s, 0.0), (1.2, sign * rate)), 0.0, -sign, USUAL) is None  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("pieces", "asked_s", "begins_s"),
    [
        ([(2.0, 0.0), (0.2, -3.0), (1.8, 0.0), (3.0, -3.0)], 0.0, 4.0),  # a twitch is passed over
        ([(2.0, 0.0), (0.4, -3.0), (1.6, 0.0), (3.0, -3.0)], 0.0, 2.0),
        ([(2.0, 0.0), (0.4, -3.0), (1.6, 0.0), (3.0, -3.0)], 2.3, 2.0),  # the one that is still on
        ([(2.0, 0.0), (0.4, -3.0), (1.6, 0.0), (3.0, -3.0)], 2.5, 4.0),
        ([(2.0, 0.0), (1.0, -3.0), (0.06, 0.0), (1.0, -3.0)], 3.05, 2.0),  # a pause of less than 0.1 s is none
        ([(2.0, 0.0), (1.0, -3.0), (0.2, 0.0), (1.0, -3.0)], 3.05, 3.2),
        ([(2.0, -0.4), (3.0, -3.0)], 0.0, 2.0),  # rolls out before it brakes
        ([(2.0, -0.6), (3.0, -3.0)], 0.0, 0.0),
        ([(2.0, 0.0), (0.2, -3.0)], 0.0, 2.0),  # where nothing lasts the twitch is all there is
    ],
)
def test_of_several_the_one_that_is_on_or_comes_next(
    pieces: Sequence[tuple[float, float]], asked_s: float, begins_s: float
) -> None:
    phase = phase_at(drive(*pieces), asked_s, BRAKING, USUAL)
    assert phase is not None
    assert phase.start_s == pytest.approx(begins_s, abs=0.021)


@pytest.mark.parametrize(("rate", "seen"), [(0.09, False), (0.11, True)])
def test_what_is_faint_is_no_braking(rate: float, seen: bool) -> None:
    assert (phase_at(drive((2.0, 0.0), (8.0, -rate)), 0.0, BRAKING, USUAL) is not None) == seen


def test_a_short_one_counts_where_it_ends_in_standing() -> None:
    timeline = drive((2.0, 0.0), (0.2, -3.0), (0.5, 0.0), (9.0, -4.0), speed=1.2)
    phase = phase_at(timeline, 2.3, BRAKING, USUAL)
    assert phase is not None
    assert phase.start_s == pytest.approx(2.7, abs=1e-6)


@settings(max_examples=60)
@given(speed=st.floats(2.0, 12.0), begins_s=st.floats(0.5, 3.0), rate=st.floats(1.5, 6.0))
def test_a_stop_is_where_the_speed_ran_out_between_samples(speed: float, begins_s: float, rate: float) -> None:
    rest = rest_after(drive((begins_s, 0.0), (20.0, -rate), speed=speed), 0.0, USUAL)
    assert rest is not None
    # But for the last 5 mm/s, which are no motion but rounding.
    assert begins_s + (speed - 0.005) / rate - 1e-6 <= rest.start_s <= begins_s + speed / rate + 1e-6
    assert rest.end_s == pytest.approx(16.0 - STEP_S)


@pytest.mark.parametrize(
    ("left_mps", "stands"),
    [(0.099, True), (0.101, False)],  # the manner says 0.1 m/s
)
def test_who_is_slower_than_that_stands_and_who_is_faster_rolls(left_mps: float, stands: bool) -> None:
    rolls = drive((2.0, 0.0), ((12.0 - left_mps) / 4.0, -4.0))
    assert (rest_after(rolls, 0.0, USUAL) is not None) == stands
    assert rest_after(rolls, 0.0, replace(USUAL, stands_mps=Fraction(1, 5))) is not None


def test_a_rest_is_looked_for_from_a_moment_on_and_ends_with_the_next_motion() -> None:
    stops = drive((2.0, 0.0), (3.0, -4.0), (1.5, 0.0), (4.0, 2.0), (4.0, -2.0), (9.0, 0.0), lasts_s=20.0)
    first, second = rest_after(stops, 0.0, USUAL), rest_after(stops, 7.0, USUAL)
    assert first is not None
    assert second is not None
    assert (first.start_s, first.end_s) == pytest.approx((5.0, 6.54), abs=0.03)
    assert second.start_s == pytest.approx(14.5, abs=1e-6)
    midway = rest_after(stops, 5.7, USUAL)
    assert midway is not None
    assert midway.start_s == 5.7


def test_moving_off_is_found_where_the_speed_left_zero() -> None:
    goes = drive((2.0, 0.0), (3.0, -4.0), (1.507, 0.0), (4.0, 2.0))
    assert move_off_after(goes, 5.0, USUAL) == pytest.approx(6.507, abs=1e-6)
    assert move_off_after(goes, 8.0, USUAL) == pytest.approx(8.0, abs=0.03)  # has moved off long since
    assert move_off_after(drive((2.0, 0.0), (3.0, -4.0)), 5.0, USUAL) is None
