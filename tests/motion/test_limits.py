"""What a vehicle can do: from the road it is on, at another pace, and what it may do before it is seen to begin."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from scenewright.motion.limits import LATERAL_MAX_MPSS, SPEED_OVER_LIMIT, Signs, calm_mpss, limits_on
from scenewright.motion.profile import Profile, chain
from scenewright.program.manner import USUAL, Manner
from scenewright.roads import find_route, load_map
from scenewright.roads.turns import tightest_curvature

T = load_map("t_intersection")
STRICT = Manner(
    begins_mpss=Fraction(3),
    begins_s=Fraction(1),
    settled_mpss=Fraction(3, 10),
    settled_s=Fraction(2),
    stands_s=Fraction(3),
)


@pytest.mark.parametrize("manner", [USUAL, STRICT, replace(USUAL, settled_mpss=Fraction(3))])
def test_who_is_settled_is_not_yet_seen_to_begin(manner: Manner) -> None:
    """What begins is seen from `begins_mpss` on, or from half of what it comes to: who is settled does less."""
    assert calm_mpss(manner) < manner.settled_mpss
    assert 2 * calm_mpss(manner) <= manner.begins_mpss


@pytest.mark.parametrize("headings", [("W",), ("E", "N"), ("S", "W")])
def test_limits_are_those_of_the_road_and_its_bends(headings: tuple[str, ...]) -> None:
    route = find_route(T, headings=headings)
    limits, signs = limits_on(route, T), [T.lanes[lane].speed_limit_mps for lane in route.lanes]
    assert limits.natural_approach_speed_mps == signs[0]
    assert limits.natural_speed_mps == max(sign for sign in signs if sign)
    assert limits.speed_max_mps == pytest.approx(SPEED_OVER_LIMIT * limits.natural_speed_mps)
    lateral_mpss = tightest_curvature(route) * limits.turn_speed_max_mps**2
    assert lateral_mpss <= LATERAL_MAX_MPSS + 1e-9
    if len(headings) == 2:
        assert limits.natural_turn_speed_mps < limits.turn_speed_max_mps
        assert lateral_mpss == pytest.approx(LATERAL_MAX_MPSS)


def test_signs_are_those_of_lanes_and_are_heeded_evenly() -> None:
    route = find_route(T, headings=("S", "W"))
    signs, along = Signs.of(route, T), np.arange(0.0, route.landmarks["route_end"], 0.5)
    told = [T.lanes[lane].speed_limit_mps for lane in route.lanes]
    assert told[0] < told[-1], "it turns into a faster road"
    assert [signs.at_mps(start_m) for start_m in route.lane_starts_m] == told
    assert signs.at_mps(-1.0) == told[0]
    heeded = signs.evenly_mps(along)
    assert heeded[0] == pytest.approx(told[0])
    assert heeded[-1] == pytest.approx(told[-1])
    rates = np.diff(heeded**2) / (2.0 * 0.5)
    assert 0.5 < np.abs(rates).max() < 2.5
    assert np.all(signs.up_to(1).evenly_mps(along) == told[0]), "nobody has come to the next one"
    there = np.array([signs.at_mps(s_m) for s_m in along])
    assert np.all(heeded <= there + 1e-9), "nobody is faster before the sign"


def test_at_another_pace_only_the_approach_is_slower() -> None:
    limits = limits_on(find_route(T, headings=("W",)), T)
    slow = limits.at_pace(0.5)
    assert slow.natural_approach_speed_mps == pytest.approx(0.5 * limits.natural_approach_speed_mps)
    posted = np.array([50 / 3.6, 30 / 3.6])
    most, natural = slow.before_trigger_mps(posted)
    assert natural == pytest.approx(0.5 * posted)
    assert most == pytest.approx(0.5 * SPEED_OVER_LIMIT * posted)
    assert replace(slow, natural_approach_speed_mps=limits.natural_approach_speed_mps, pace=1.0) == limits
    assert limits.at_pace(0.01).natural_approach_speed_mps >= 4.0, "nobody crawls"


def test_signs_as_driven_tell_what_one_takes_them_for() -> None:
    posted = Signs((0.0, 100.0, 200.0), (10.0, 10.0, 14.0))
    drive = Profile(chain(0.0, 50.0, 4.0, [(5.0, 0.0, 0), (5.0, 0.4, 0), (5.0, -1.0, 0), (20.0, 0.1, 0)]))
    found = posted.as_driven(drive)
    assert [found.at_mps(s_m) for s_m in (20.0, 150.0, 250.0)] == pytest.approx([6.0, 6.0, 8.4])


def test_one_that_never_drives_faster_has_no_faster_limits() -> None:
    limits = limits_on(find_route(T, headings=("W",)), T)
    slow = limits.no_faster(9.0)
    assert slow.speed_max_mps == slow.natural_approach_speed_mps == slow.turn_speed_max_mps == 9.0
    assert (slow.brake_max_mpss, slow.pace) == (limits.brake_max_mpss, limits.pace)
    assert limits.no_faster(100.0).natural_speed_mps == limits.natural_speed_mps
