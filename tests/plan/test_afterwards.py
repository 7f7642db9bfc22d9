"""Whoever has nothing more to do keeps clear of who goes first, and brakes no harder than that takes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from many_heroes import PROGRAMS
from situations import planner_of, scene_of

from scenewright.motion.profile import Profile, Segment
from scenewright.plan.afterwards import goes_on
from scenewright.plan.asked import Caps
from scenewright.plan.pairs import Meeting
from scenewright.plan.preferences import Preferences
from scenewright.program.types import EGO
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from stories import program

WANTED, TICK_S, LASTS_S = Preferences(), 0.1, 40.0
SURELY_M = 0.3
NEVER = np.inf
STRAIGHT = Caps(np.array([0.0]), *[np.array([NEVER])] * 4)
LANE = Meeting(1, 2, None, ((0.0, NEVER), (0.0, NEVER)))
LATER_LANE = Meeting(2, 3, None, ((0.0, NEVER), (0.0, NEVER)))


def even(s_m: float, speed_mps: float) -> Profile:
    return Profile((Segment(0.0, 1.0, s_m, speed_mps, 0.0),), {"t0": 0.0})


def stands_at(s_m: float, speed_mps: float, at_s: float) -> Profile:
    """Return a motion that holds its speed for a while and then brakes to a stand at 2 m/s^2."""
    braking = Segment(at_s, speed_mps / 2.0, s_m + speed_mps * at_s, speed_mps, -2.0)
    return Profile((Segment(0.0, at_s, s_m, speed_mps, 0.0), braking), {"t0": 0.0})


def driven(motions: dict[int, Profile], meetings: tuple[Meeting, ...], *heroes: int) -> dict[int, Profile]:
    """Return what becomes of motions of which these are looked at in every tick."""
    for k in range(1, round(LASTS_S / TICK_S)):
        for hero in heroes:
            motions[hero] = goes_on(hero, motions, meetings, k * TICK_S, WANTED, STRAIGHT)
    return motions


def places(motion: Profile) -> np.ndarray:
    return np.array([motion.state(float(t))[0] for t in np.arange(0.0, LASTS_S, 0.02)])


def hardest(motion: Profile) -> float:
    return -min(segment.accel_mpss for segment in motion.segments)


@example(gap_m=2.0, first_mps=0.0, closing_mps=0.25)
@given(gap_m=st.floats(1.2, 60.0), first_mps=st.floats(0.0, 14.0), closing_mps=st.floats(0.0, 10.0))
def test_who_is_faster_than_the_one_ahead_never_reaches_it(gap_m: float, first_mps: float, closing_mps: float) -> None:
    closing_mps = min(closing_mps, np.sqrt(2.0 * 4.0 * (gap_m - 1.2)))  # what 4 m/s^2 can still save
    motions = {1: even(VEHICLE_LENGTH_M + gap_m, first_mps), 2: even(0.0, first_mps + closing_mps)}
    motions = driven(motions, (LANE,), 2)
    room_m = places(motions[1]) - places(motions[2]) - VEHICLE_LENGTH_M
    assert room_m.min() >= SURELY_M
    assert motions[2].state(LASTS_S)[1] <= first_mps + closing_mps
    assert hardest(motions[2]) <= 8.0


@pytest.mark.parametrize("first_mpss", [-0.02, -0.3, -1.0, -3.0])
def test_who_is_ahead_may_brake_faintly_or_hard(first_mpss: float) -> None:
    """Where the one ahead would stand, one day, is no room for who comes to it before that."""
    slows = Profile((Segment(0.0, 6.8 / -first_mpss, VEHICLE_LENGTH_M + 9.0, 6.8, first_mpss),), {"t0": 0.0})
    motions = driven({1: slows, 2: even(0.0, 8.7)}, (LANE,), 2)
    assert (places(motions[1]) - places(motions[2]) - VEHICLE_LENGTH_M).min() >= SURELY_M
    assert hardest(motions[2]) <= 4.0 - first_mpss


def test_a_row_of_three_comes_to_stand_behind_one_that_does() -> None:
    motions = {1: stands_at(60.0, 10.0, 3.0), 2: even(48.0, 10.0), 3: even(36.0, 10.0)}
    motions = driven(motions, (LANE, LATER_LANE), 2, 3)
    for first, second in ((1, 2), (2, 3)):
        assert (places(motions[first]) - places(motions[second]) - VEHICLE_LENGTH_M).min() >= SURELY_M
        assert motions[second].state(LASTS_S)[1] == pytest.approx(0.0, abs=0.05)
        assert hardest(motions[second]) <= 4.0


@pytest.mark.parametrize("comes", [True, False])
def test_who_goes_second_waits_before_a_stretch_until_the_first_is_out(comes: bool) -> None:
    crossing = Meeting(1, 2, ((20.0, 30.0), (50.0, 60.0)))
    motions = driven({1: even(-30.0, 4.0) if comes else even(25.0, 0.0), 2: even(0.0, 8.0)}, (crossing,), 2)
    out, inside = places(motions[1]) >= 30.0, places(motions[2]) > 50.0
    assert not np.any(inside & ~out)
    assert hardest(motions[2]) <= 3.0


@given(bend_m=st.floats(30.0, 80.0), speed_mps=st.floats(2.0, 13.0), comfortable_mps=st.floats(4.0, 8.0))
def test_who_comes_to_a_bend_is_slow_enough_there_and_brakes_no_sooner_than_it_has_to(
    bend_m: float, speed_mps: float, comfortable_mps: float
) -> None:
    along, bend_m = np.arange(0.0, 300.0, 0.5), 0.5 * round(2.0 * bend_m)
    comfortable = np.where((along >= bend_m) & (along <= bend_m + 20.0), comfortable_mps, NEVER)
    caps = Caps(along, 1.5 * comfortable, comfortable, *[np.full_like(along, NEVER)] * 2)
    motion = even(0.0, speed_mps)
    for k in range(1, round(LASTS_S / TICK_S)):
        motion = goes_on(1, {1: motion}, (), k * TICK_S, WANTED, caps)
    least_mps = min(speed_mps, comfortable_mps)
    assert motion.state(LASTS_S)[1] == pytest.approx(least_mps, abs=0.05)
    if bend_m > (speed_mps**2 - comfortable_mps**2) / (2.0 * WANTED.accel_mpss) + speed_mps * TICK_S:
        assert hardest(motion) < WANTED.braking_mpss + 1e-9
    at_m = np.array([motion.state(float(t))[:2] for t in np.arange(0.0, LASTS_S, 0.02)])
    inside = at_m[(at_m[:, 0] >= bend_m) & (at_m[:, 0] <= bend_m + 20.0), 1]
    assert inside.max(initial=0.0) <= 1.5 * comfortable_mps + 1e-6


def test_who_is_in_nobodys_way_goes_on_as_it_does() -> None:
    motions = {1: even(20.0, 10.0), 2: even(0.0, 10.0)}
    assert goes_on(2, motions, (LANE,), 5.0, WANTED, STRAIGHT) is motions[2]
    assert goes_on(1, motions, (LANE,), 5.0, WANTED, STRAIGHT) is motions[1]


def test_a_planner_lets_nobody_whose_plan_is_over_reach_the_one_ahead() -> None:
    planner = planner_of(scene_of(PROGRAMS["platoon"](2)))
    planner.begin((0.0, 40.0, 9.0, 0.0))
    ahead, behind = (meeting := planner._meetings[0]).first, meeting.second
    over_s = max(max(planner.plan.profiles[hero].knot_times_s.values()) for hero in (ahead, behind)) + 3.0
    profiles = dict(planner.plan.profiles)
    profiles[ahead] = Profile((Segment(over_s, 1.0, 500.0, 0.0, 0.0),), profiles[ahead].knot_times_s)
    profiles[behind] = Profile((Segment(over_s, 1.0, 440.0, 8.0, 0.0),), profiles[behind].knot_times_s)
    planner.plan = type(planner.plan)(profiles)
    for k in range(1, 200):
        now_s = over_s + k * TICK_S
        planner.observe((now_s, *planner.plan.profiles[EGO].state(now_s)))
        planner.tick(now_s)
        places_m = [planner.plan.profiles[hero].state(now_s)[0] for hero in (ahead, behind)]
        assert places_m[0] - places_m[1] >= VEHICLE_LENGTH_M + SURELY_M


def test_nobody_whose_plan_is_over_reaches_the_ego() -> None:
    text = program("W", "t0, go, t1", "A1x(t0) == 84\nalways[0 s, 3 s] (gap(A1, A0) >= 14 and gap(A1, A0) <= 20)")
    planner = planner_of(scene_of(text))
    planner.begin((0.0, 100.0, 9.0, 0.0))
    ego_m, ego_mps = 100.0, 9.0
    for k in range(1, 200):
        braking_mpss = 1.0 if k * TICK_S > 4.0 and ego_mps > 0.0 else 0.0
        ego_m, ego_mps = ego_m + ego_mps * TICK_S, max(0.0, ego_mps - braking_mpss * TICK_S)
        planner.observe((k * TICK_S, ego_m, ego_mps, -braking_mpss))
        planner.tick(k * TICK_S)
        assert ego_m - planner.plan.profiles[1].state(k * TICK_S)[0] >= VEHICLE_LENGTH_M + SURELY_M
    assert planner.plan.profiles[1].state(k * TICK_S)[1] < 0.1
