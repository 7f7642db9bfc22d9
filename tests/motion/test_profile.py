"""Concrete motion: speed is continuous, position is its integral, places are reached when they are."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from scenewright.motion.profile import Profile, Segment, chain

moves = st.lists(st.tuples(st.floats(0.0, 5.0), st.floats(-6.0, 4.0), st.just(0)), min_size=1, max_size=6)
speeds = st.floats(0.0, 18.0)
starts = st.floats(-3.0, 5.0)


def profile_of(start_s: float, speed_mps: float, moves_: list[tuple[float, float, int]]) -> Profile:
    return Profile(chain(start_s, 10.0, speed_mps, moves_))


@given(starts, speeds, moves)
def test_speed_and_position_are_continuous_and_never_reverse(
    start_s: float, speed_mps: float, moves_: list[tuple[float, float, int]]
) -> None:
    segments = chain(start_s, 10.0, speed_mps, moves_)
    for before, after in itertools.pairwise(segments):
        assert after.start_s == pytest.approx(before.end_s, abs=1e-9)
        assert after.s_m == pytest.approx(before.end_s_m, abs=1e-9)
        assert after.speed_mps == pytest.approx(before.end_speed_mps, abs=1e-5)
    for segment in segments:
        assert segment.speed_mps >= 0
        assert segment.speed_mps + segment.accel_mpss * segment.duration_s >= -1e-6
        assert segment.end_s_m >= segment.s_m - 1e-6


@given(starts, speeds, moves)
def test_position_is_the_integral_of_speed(
    start_s: float, speed_mps: float, moves_: list[tuple[float, float, int]]
) -> None:
    profile = profile_of(start_s, speed_mps, moves_)
    total = 10.0
    for segment in profile.segments:
        # Speed is linear within a segment, so the trapezoid is exact.
        inside = segment.start_s + segment.duration_s * np.array([0.0, 0.25, 0.5, 1.0])
        speeds_ = [segment.speed_mps + segment.accel_mpss * (t - segment.start_s) for t in inside]
        total += float(np.trapezoid(speeds_, inside))
        assert segment.end_s_m == pytest.approx(total, abs=1e-6)
    beyond = profile.end_s + 2.0
    held = profile.segments[-1].end_speed_mps
    assert profile.state(beyond)[0] == pytest.approx(total + 2.0 * held, abs=1e-6)


@given(starts, speeds, moves, st.floats(0.0, 1.0))
def test_time_at_is_the_inverse_of_state(
    start_s: float, speed_mps: float, moves_: list[tuple[float, float, int]], part: float
) -> None:
    profile = profile_of(start_s, speed_mps, moves_)
    time_s = profile.start_s + part * (profile.end_s + 1.0 - profile.start_s)
    place_m, speed, _ = profile.state(time_s)
    found = profile.time_at(place_m)
    if found is None:
        # A motion that has come to rest reaches its last place to rounding, not beyond.
        assert speed == pytest.approx(0.0, abs=1e-3)
        return
    assert found <= time_s + 1e-6 + 1e-3 / max(speed, 1e-3)
    assert profile.state(found)[0] == pytest.approx(place_m, abs=1e-5)


@given(speeds, moves, st.floats(0.01, 200.0))
def test_a_place_is_reached_for_the_first_time(
    speed_mps: float, moves_: list[tuple[float, float, int]], ahead_m: float
) -> None:
    profile = profile_of(0.0, speed_mps, moves_)
    found = profile.time_at(10.0 + ahead_m)
    samples = np.linspace(0.0, profile.end_s + 30.0, 400)
    positions = np.array([profile.state(float(t))[0] for t in samples])
    if found is None:
        assert positions.max() < 10.0 + ahead_m + 1e-3
        return
    assert all(positions[samples < found - 1e-6] < 10.0 + ahead_m + 1e-6)
    assert profile.state(found)[0] == pytest.approx(10.0 + ahead_m, abs=1e-5)


@given(starts, speeds, moves, st.floats(-0.5, 1.5), st.floats(0.0, 10.0))
def test_cutting_changes_nothing_that_is_still_to_come(
    start_s: float, speed_mps: float, moves_: list[tuple[float, float, int]], part: float, later_s: float
) -> None:
    profile = profile_of(start_s, speed_mps, moves_)
    cut_s = profile.start_s + part * (profile.end_s - profile.start_s)
    rest = profile.cut(cut_s)
    assume(rest.start_s <= cut_s + 1e-12 or cut_s < profile.start_s)
    wanted, got = profile.state(cut_s + later_s), rest.state(cut_s + later_s)
    assert got[0] == pytest.approx(wanted[0], abs=1e-6)
    assert got[1] == pytest.approx(wanted[1], abs=1e-6)


def test_braking_past_standstill_waits() -> None:
    profile = Profile(chain(0.0, 0.0, 4.0, [(5.0, -2.0, 1), (1.0, 1.0, 2)]))
    assert [segment.duration_s for segment in profile.segments] == pytest.approx([2.0, 3.0, 1.0])
    assert profile.state(4.0) == (4.0, 0.0, 0.0)
    assert profile.state(6.0)[1] == pytest.approx(1.0)
    assert profile.time_at(4.0) == pytest.approx(2.0)
    assert profile.time_at(4.25) == pytest.approx(5.0 + 0.5**0.5)


def test_a_standing_motion_never_gets_anywhere() -> None:
    profile = Profile(chain(0.0, 5.0, 0.0, [(3.0, 0.0, 0)]))
    assert profile.time_at(5.0) == 0.0
    assert profile.time_at(5.1) is None
    assert profile.time_at(4.0) is None


def test_before_the_first_segment_the_speed_holds() -> None:
    profile = Profile((Segment(2.0, 1.0, 10.0, 3.0, 1.0),))
    assert profile.state(0.0) == (4.0, 3.0, 0.0)
    assert profile.accelerations() == (1.0, 1.0)


def test_a_profile_has_a_segment() -> None:
    with pytest.raises(ValueError, match="at least one segment"):
        Profile(())


@given(starts, speeds, moves, st.floats(0.0, 1.0), st.floats(0.1, 3.0))
def test_held_motion_is_the_same_before_and_later_after(
    start_s: float, speed_mps: float, moves_: list[tuple[float, float, int]], share: float, for_s: float
) -> None:
    profile = profile_of(start_s, speed_mps, moves_)
    at_s = profile.start_s + share * (profile.end_s - profile.start_s)
    held = Profile(profile.segments, {"t0": start_s - 1.0, "t1": at_s}).held(at_s, for_s)
    place_m, speed, _ = profile.state(at_s)
    assert held.knot_times_s == {"t0": start_s - 1.0, "t1": pytest.approx(at_s + for_s)}
    for before_s in np.linspace(profile.start_s, at_s, 5):
        assert held.state(float(before_s))[:2] == pytest.approx(profile.state(float(before_s))[:2], abs=1e-5)
    assert held.state(at_s + 0.5 * for_s)[:2] == pytest.approx((place_m + 0.5 * for_s * speed, speed), abs=1e-5)
    for after_s in np.linspace(0.0, 8.0, 9):
        later = profile.state(at_s + float(after_s))
        expected = (later[0] + for_s * speed, later[1])
        assert held.state(at_s + for_s + float(after_s))[:2] == pytest.approx(expected, abs=1e-4)


# -- accelerations that change evenly ---------------------------------------------------------------------------------
@st.composite
def jerky(draw: st.DrawFn) -> Profile:
    """A motion whose acceleration changes evenly within segments, and which never reverses."""
    segments: list[Segment] = []
    time_s, s_m, speed_mps = draw(starts), 10.0, draw(st.floats(1.0, 15.0))
    for piece in range(draw(st.integers(1, 5))):
        segment = Segment(
            time_s,
            draw(st.floats(0.2, 3.0)),
            s_m,
            speed_mps,
            draw(st.floats(-3.0, 3.0)),
            piece,
            draw(st.floats(-3.0, 3.0)),
        )
        assume(min(segment.after(share * segment.duration_s)[1] for share in np.linspace(0.0, 1.0, 21)) > 0.2)
        segments.append(segment)
        time_s, s_m, speed_mps = segment.end_s, segment.end_s_m, segment.end_speed_mps
    return Profile(tuple(segments))


@settings(max_examples=30)
@given(profile=jerky())
def test_with_jerk_place_is_the_integral_of_speed_and_speed_that_of_acceleration(profile: Profile) -> None:
    times = np.linspace(profile.start_s, profile.end_s, 1501)
    place, speed, accel = np.array([profile.state(float(t)) for t in times]).T
    step_s = times[1] - times[0]
    travelled = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * step_s)])
    assert place - place[0] == pytest.approx(travelled, abs=12.0 * step_s)
    gained = np.concatenate([[0.0], np.cumsum(0.5 * (accel[1:] + accel[:-1]) * step_s)])
    assert speed - speed[0] == pytest.approx(gained, abs=60.0 * step_s)


@given(profile=jerky(), share=st.floats(0.0, 1.0))
def test_with_jerk_a_place_is_reached_when_it_is(profile: Profile, share: float) -> None:
    time_s = profile.start_s + share * (profile.end_s - profile.start_s)
    found = profile.time_at(profile.state(time_s)[0])
    assert found is not None
    assert found == pytest.approx(time_s, abs=1e-4)


@given(profile=jerky(), share=st.floats(0.0, 0.99), later_s=st.floats(0.0, 6.0))
def test_with_jerk_cutting_changes_nothing_that_is_still_to_come(
    profile: Profile, share: float, later_s: float
) -> None:
    cut_s = profile.start_s + share * (profile.end_s - profile.start_s)
    now_s = cut_s + later_s
    place_m, speed_mps, accel_mpss = profile.cut(cut_s).state(now_s)
    assert (place_m, speed_mps) == pytest.approx(profile.state(now_s)[:2], abs=1e-6)
    # Where one segment ends and another begins, rounding decides which of the two accelerations is that of the moment.
    either_side = [profile.state(now_s + off_s)[2] for off_s in (0.0, -1e-9, 1e-9)]
    assert any(accel_mpss == pytest.approx(each, abs=1e-6) for each in either_side)


@given(profile=jerky(), shares=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)))
def test_a_part_is_what_the_whole_is_then(profile: Profile, shares: tuple[float, float]) -> None:
    whole = profile.segments[-1]
    first_s, last_s = (whole.start_s + share * whole.duration_s for share in sorted(shares))
    part = whole.part(first_s, last_s)
    assert (part.start_s, part.end_s, part.piece) == (first_s, pytest.approx(last_s), whole.piece)
    for share in (0.0, 0.4, 1.0):
        elapsed_s = share * part.duration_s
        assert part.after(elapsed_s) == pytest.approx(whole.after(first_s - whole.start_s + elapsed_s), abs=1e-6)


@given(profile=jerky())
def test_the_strongest_accelerations_are_at_the_ends_of_segments(profile: Profile) -> None:
    least, most = profile.accelerations()
    sampled = [s.after(share * s.duration_s)[2] for s in profile.segments for share in np.linspace(0.0, 1.0, 9)]
    assert (least, most) == pytest.approx((min(sampled), max(sampled)))


@given(profile=jerky(), share=st.floats(0.0, 1.0), for_s=st.floats(0.1, 3.0))
def test_with_jerk_held_motion_is_the_same_before_and_later_after(profile: Profile, share: float, for_s: float) -> None:
    at_s = profile.start_s + share * (profile.end_s - profile.start_s)
    held, speed = profile.held(at_s, for_s), profile.state(at_s)[1]
    for before_s in np.linspace(profile.start_s, at_s, 5):
        assert held.state(float(before_s))[:2] == pytest.approx(profile.state(float(before_s))[:2], abs=1e-5)
    for after_s in (0.1, 1.0, 4.0):
        later = profile.state(at_s + after_s)
        expected = (later[0] + for_s * speed, later[1])
        assert held.state(at_s + for_s + after_s)[:2] == pytest.approx(expected, abs=1e-4)
