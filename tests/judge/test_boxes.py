"""Boxes: what overlaps, how far apart they are, when they would touch, and what distance they surely keep."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from brute import collision_s, larger
from hypothesis import given, settings
from hypothesis import strategies as st

from scenewright.judge.boxes import (
    MovingBox,
    closest_m,
    distances_m,
    moving_box,
    overlapping,
    surely_apart_m,
    times_to_collision_s,
)
from scenewright.judge.case import Box
from scenewright.roads.bodies import CAR
from scenewright.trace.model import ActorTrace, FloatArray

STEP_S, LASTS_S = 0.02, 2.0


def turning(time_s: FloatArray, from_m: tuple[float, float], heading: float, speed: float, turns: float) -> ActorTrace:
    """Return a car that drives a circle, or straight on where it does not turn (rad/s)."""
    ways = heading + turns * time_s
    if turns:
        x, y = speed / turns * (np.sin(ways) - np.sin(heading)), speed / turns * (np.cos(heading) - np.cos(ways))
    else:
        x, y = speed * np.cos(heading) * time_s, speed * np.sin(heading) * time_s
    even = np.full(len(time_s), speed)
    return ActorTrace(time_s, from_m[0] + x, from_m[1] + y, ways, even, 0.0 * even, speed * time_s, 0.0 * even)


@settings(max_examples=25)
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


def boxes_at(*poses: tuple[float, float, float]) -> MovingBox:
    x, y, heading = np.array(poses, dtype=float).T
    return MovingBox(Box(4.0, 2.0), x, y, heading, np.full(len(poses), 10.0))


def test_boxes_overlap_and_distance() -> None:
    a = boxes_at((0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0))
    b = boxes_at((4.5, 0, 0), (3.9, 0, 0), (3.1, 0, np.pi / 2), (0, 3.0, np.pi / 4))
    assert overlapping(a, b).tolist() == [False, True, False, True]
    distances = distances_m(a, b)
    assert distances[:3] == pytest.approx([0.5, 0.0, 0.1])
    assert closest_m(boxes_at((0, 0, 0)), boxes_at((10, 5, 0)))[0] == pytest.approx(np.hypot(6, 3))
    rotated = distances_m(boxes_at((0, 0, 0)), boxes_at((0, 3.5, np.pi / 4)))
    assert rotated == pytest.approx([3.5 - 1.0 - 3.0 * np.sqrt(0.5)])


def test_time_to_collision_of_boxes() -> None:
    standing = replace(boxes_at((24.0, 0, 0)), speed_mps=np.zeros(1))
    assert times_to_collision_s(boxes_at((0, 0, 0)), standing) == pytest.approx([2.0])
    assert times_to_collision_s(boxes_at((0, 10, 0)), standing) == [np.inf]
    assert times_to_collision_s(boxes_at((22.0, 0, 0)), standing) == [0.0], "they overlap already"
    assert times_to_collision_s(boxes_at((0, 0, np.pi)), standing) == [np.inf], "it drives away"
    # At a right angle, at 10 m/s each: the first is where they cross from 1.7 to 2.3 s, the second from 2.25 or 2.31 s.
    north = boxes_at((0, -25.5, np.pi / 2), (0, -26.1, np.pi / 2))
    assert times_to_collision_s(boxes_at((-20, 0, 0), (-20, 0, 0)), north) == pytest.approx([2.25, np.inf])


@settings(max_examples=60)
@given(
    headings=st.tuples(st.floats(-3.1, 3.1), st.floats(-3.1, 3.1)),
    speeds=st.tuples(st.floats(0.0, 20.0), st.floats(0.0, 20.0)),
    meets_s=st.floats(-1.0, 8.5),
    aside_m=st.tuples(st.floats(-4.0, 4.0), st.floats(-4.0, 4.0)),
)
def test_time_to_collision_is_what_small_steps_find(
    headings: tuple[float, float], speeds: tuple[float, float], meets_s: float, aside_m: tuple[float, float]
) -> None:
    """Two that would be `aside_m` of each other at some moment; contacts too short for a step are real, too."""
    one, other = (
        MovingBox(
            CAR,
            np.array([share * aside_m[0] - speed * meets_s * np.cos(heading)]),
            np.array([share * aside_m[1] - speed * meets_s * np.sin(heading)]),
            np.array([heading]),
            np.array([speed]),
        )
        for share, heading, speed in zip((0.0, 1.0), headings, speeds, strict=True)
    )
    found_s, step_s = float(times_to_collision_s(one, other)[0]), 0.002
    stepped_s = collision_s(one, other, step_s)
    assert found_s <= stepped_s
    if np.isfinite(stepped_s):
        assert found_s > stepped_s - step_s - 1e-9
    elif found_s < 8.0 - step_s:
        large = larger(CAR, 0.05)
        assert np.isfinite(collision_s(replace(one, box=large), replace(other, box=large), step_s)), "a graze"
    assert times_to_collision_s(other, one) == pytest.approx([found_s])
