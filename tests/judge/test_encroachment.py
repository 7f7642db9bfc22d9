"""Post-encroachment time: what it is by hand, against small steps for any two motions, and in runs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from brute import collision_s, encroachment_s, larger
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from plays import Motion, actor_trace

from scenewright.judge.boxes import moving_box, overlapping
from scenewright.judge.encroachment import post_encroachment_s
from scenewright.orchestrate import orchestrate
from scenewright.request import Request
from scenewright.roads.bodies import CAR
from scenewright.trace.model import ActorTrace, FloatArray

CARS = (CAR, CAR)
TIMES_S = np.arange(0.0, 8.0, 0.02)


def arc(time_s: FloatArray, speed_mps: float, turn_rad: float, bends: float) -> ActorTrace:
    """Return a car that passes the origin at half time, then headed by `turn_rad`, on a circle of 1 / `bends` (m)."""
    way = speed_mps * (time_s - time_s[-1] / 2.0)
    heading = turn_rad + bends * way
    if bends:
        x, y = (np.sin(heading) - np.sin(turn_rad)) / bends, (np.cos(turn_rad) - np.cos(heading)) / bends
    else:
        x, y = way * np.cos(turn_rad), way * np.sin(turn_rad)
    even = np.full(len(time_s), speed_mps)
    return ActorTrace(time_s, x, y, heading, even, 0.0 * even, way - way[0], 0.0 * even)


def later(states: ActorTrace, by_s: float) -> ActorTrace:
    """Return the same motion later, before that at a standstill."""
    at = states.time_s - by_s
    columns = ("x_m", "y_m", "heading_rad", "speed_mps", "s_m")
    return replace(states, **{name: np.interp(at, states.time_s, getattr(states, name)) for name in columns})


def begins_on_line(own: ActorTrace, other: ActorTrace) -> bool:
    """Whether one begins about where the other drives, headed about as it is."""
    near = np.hypot(other.x_m - own.x_m[0], other.y_m - own.y_m[0]) < 0.5
    beyond = np.hypot(other.x_m[[0, -1]] - own.x_m[0], other.y_m[[0, -1]] - own.y_m[0]) < 6.0
    alike = np.cos(other.heading_rad - own.heading_rad[0]) > np.cos(0.25)
    return bool((near & alike).any() or (beyond & alike[[0, -1]]).any())


@pytest.mark.parametrize("turned_deg", [90.0, -90.0])
def test_at_a_right_angle_it_is_between_leaving_the_square_and_entering_it(turned_deg: float) -> None:
    one = actor_trace(Motion(0.0, 10.0, []), TIMES_S, (-30.0, 0.0, 0.0))
    turned = np.radians(turned_deg)
    other = actor_trace(Motion(0.0, 8.0, []), TIMES_S, (0.0, -40.0 * np.sin(turned), turned))
    half_m = (CAR.length_m + CAR.width_m) / 2.0
    assert post_encroachment_s(one, other, CARS) == pytest.approx(
        (40.0 - half_m) / 8.0 - (30.0 + half_m) / 10.0, abs=4e-3
    )


@settings(max_examples=12)
@given(
    speeds=st.tuples(st.floats(2.0, 15.0), st.floats(2.0, 15.0)),
    turn_deg=st.floats(-170.0, 170.0),
    bends=st.tuples(st.sampled_from([0.0, 0.05, -0.1]), st.sampled_from([0.0, -0.03, 0.1])),
    by_s=st.floats(0.0, 3.0),
)
def test_it_is_what_small_steps_find_at_any_angle_and_on_bends(
    speeds: tuple[float, float], turn_deg: float, bends: tuple[float, float], by_s: float
) -> None:
    """Between two samples a car goes 0.3 m at most: what a little more overlaps does so at a sample, too."""
    one = arc(TIMES_S, speeds[0], 0.0, bends[0])
    other = later(arc(TIMES_S, speeds[1], np.radians(turn_deg), bends[1]), by_s)
    small, large = larger(CAR, -0.16), larger(CAR, 0.16)
    assume(encroachment_s(one, other, (large, large), most_s=0.0) > 0.0)  # who collides passes nobody
    found = post_encroachment_s(one, other, CARS)
    assert post_encroachment_s(other, one, CARS) == (None if found is None else pytest.approx(found, abs=0.01))
    if found is None:
        apart = not np.isfinite(encroachment_s(one, other, (small, small)))
        assert apart or begins_on_line(one, other) or begins_on_line(other, one)
        return
    assert found <= encroachment_s(one, other, (small, small), most_s=found + 1.0) + 1e-9
    assert found >= encroachment_s(one, other, (large, large), most_s=found + 0.1) - 0.02 - 1e-9


def test_whoever_had_been_so_much_later_would_have_been_touched() -> None:
    one = arc(TIMES_S, 9.0, 0.0, 0.0)
    other = later(arc(TIMES_S, 7.0, np.radians(35.0), 0.02), 2.0)
    apart_s = post_encroachment_s(one, other, CARS)
    assert apart_s is not None
    fine_s = np.arange(1.0, 7.0, 0.001)
    for by_s, touches in ((apart_s + 0.002, True), (apart_s - 0.005, False)):
        first = later(one, by_s)
        assert overlapping(moving_box(first, CAR, fine_s), moving_box(other, CAR, fine_s)).any() == touches


def test_a_standstill_counts_from_when_it_ends_and_until_it_begins() -> None:
    """One stands on the crossing for a long time; before that, or after it, another crosses."""
    times_s = np.arange(0.0, 40.0, 0.04)
    stands = actor_trace(Motion(-20.0, 5.0, [(2.0, 0.0), (4.0, -1.25), (20.0, 0.0), (20.0, 1.25)]), times_s, (0, 0, 0))
    assert stands.x_m[np.searchsorted(times_s, 20.0)] == pytest.approx(0.0)
    for crosses_s in (1.0, 34.0):
        crosses = actor_trace(Motion(-10.0 * crosses_s, 10.0, []), times_s, (0.0, 0.0, np.pi / 2))
        found = post_encroachment_s(stands, crosses, CARS)
        assert found == pytest.approx(encroachment_s(stands, crosses, CARS), abs=0.08)
        assert found is not None
        assert found > 1.0


def test_along_one_lane_nobody_is_passed_and_a_place_of_only_one_is_none() -> None:
    ahead = actor_trace(Motion(20.0, 8.0, []), TIMES_S, (0.0, 0.0, 0.0))
    behind = actor_trace(Motion(0.0, 9.0, []), TIMES_S, (0.0, 0.0, 0.0))
    beside = replace(behind, y_m=behind.y_m + 0.6, d_m=behind.d_m + 0.6)
    stops_short = actor_trace(Motion(0.0, 6.0, [(2.4, 0.0), (10.0, -6.0)]), TIMES_S, (0.0, 0.0, 0.0))
    assert stops_short.x_m[-1] == pytest.approx(17.4), "its nose is where the tail of the one ahead was"
    for follower in (behind, beside, stops_short):
        assert post_encroachment_s(ahead, follower, CARS) is None
        assert post_encroachment_s(follower, ahead, CARS) is None
    next_lane = replace(behind, y_m=behind.y_m + 3.5)
    assert post_encroachment_s(ahead, next_lane, CARS) is None


def test_who_comes_from_the_front_or_cuts_in_is_another_matter() -> None:
    on = actor_trace(Motion(0.0, 9.0, []), TIMES_S, (0.0, 0.0, 0.0))
    shares = np.clip((TIMES_S - 2.0) / 3.0, 0.0, 1.0)
    way = 15.0 + 9.0 * TIMES_S
    cuts_in = replace(on, x_m=way, y_m=3.5 * (1.0 - shares), s_m=way)
    assert post_encroachment_s(on, cuts_in, CARS) == pytest.approx((15.0 - CAR.length_m) / 9.0, abs=0.02)


AFTER = (
    "A0x(t1) == conflict_point - 50\nA1x(t1) == conflict_point - 30\nA0x(t2) == conflict_point\n"
    "A1x(t2) == conflict_point\nA1(t2) - A0(t2) >= 1.5\nA1(t2) - A0(t2) <= 2.5"
)
TURNS = "A0x(t1) == stop_line - 10\nA1x(t1) == conflict_point - 50\nA1v(t2) == 5\nA1x(t3) == conflict_point + 10"
MERGES = (
    "A0x(t1) == conflict_point - 15\nA1x(t1) == conflict_point - 40\nA0x(t2) == conflict_point\n"
    "A1x(t2) == conflict_point\nA1(t2) - A0(t2) == 2"
)
SHORTLY = "A0x(t1) == stop_line - 12\nA1x(t1) == conflict_point - 40"


@pytest.mark.parametrize(
    ("ego", "hero", "sketch", "asked", "policy"),
    [
        ("W", "E, N", "go, t2", AFTER, "idm"),  # the hero turns left behind the ego that comes towards it
        ("S, E", "W", "dec, t2, acc, t3", TURNS, "constant"),
        ("S, W", "W", "go, t2", MERGES, "noisy"),  # the hero follows the ego closely once they are in one lane
        ("S, E", "W", "go, t2", SHORTLY, "constant"),  # on a collision course, but would only graze each other
    ],
)
def test_runs_are_told_as_small_steps_find_them(ego: str, hero: str, sketch: str, asked: str, policy: str) -> None:
    text = (
        f"Actor 0 (ego):\n- {ego}\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- {hero}\n- [t0, go, t1, {sketch}]\n\n"
        f"Constraints:\nA0(t1) == A1(t1)\n{asked}\n"
    )
    result = orchestrate(Request(text, ego=policy, takes=1, explain="nothing", replan_hz=1.0))
    trace = result.takes[-1].trace
    assert trace is not None
    assert result.verdict is not None
    came = result.verdict.aftermath
    assert came.collision is None
    one, other = (trace.actors[name] for name in ("ego", "hero"))
    assert came.post_encroachment_s == pytest.approx(encroachment_s(one, other, CARS), abs=0.04)
    boxes = [moving_box(each, CAR, trace.time_s) for each in (one, other)]
    near = np.flatnonzero(np.hypot(boxes[0].x_m - boxes[1].x_m, boxes[0].y_m - boxes[1].y_m) < 60.0)
    least_s = min(collision_s(boxes[0].at(near[[k]]), boxes[1].at(near[[k]]), 0.02) for k in range(0, len(near), 2))
    assert (np.inf if came.min_ttc_s is None else came.min_ttc_s) == pytest.approx(least_s, abs=0.06)
