"""Heroes keep clear of each other: surely so in whole runs, by rows whose slopes are right, unless contact is asked."""

from __future__ import annotations

import numpy as np
import pytest
from many_heroes import PROGRAMS, drive
from situations import planner_of, scene_of

from scenewright.motion.profile import Profile, chain
from scenewright.plan import planner as planning
from scenewright.plan.pairs import Meeting, PairRows, Way, in_order, meetings_of, needed, passes_s
from scenewright.plan.preferences import Preferences
from scenewright.plan.problem import Problem
from scenewright.program.structure import read_structure
from scenewright.program.types import EGO
from scenewright.simulate.loop import DEFAULT_STEP_S

SURELY_M = 0.3
REPLAN_S = 0.5
# Two cars on crossing ways, each told where to be when the ego is somewhere, and nothing of each other: as they are
# told, the second is in the junction while the first is.
ACROSS = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (there):
- E, N
- [t0, go, t1, acc, t2]

Actor 2 (back):
- S, E
- [t0, go, t1, acc, t2]

Constraints:
A0(t1) == A1(t1)
A0(t1) == A2(t1)
A0x(t1) == stop_line - 120
A1x(t1) == stop_line - 12
A2x(t1) == stop_line - 12
"""
IN_CONTACT = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (there):
- E, N
- [t0, go, t1, go, t2]

Actor 2 (back):
- S, E
- [t0, go, t1, go, t2]

Constraints:
A0(t1) == A1(t1)
A0(t1) == A2(t1)
A0x(t1) == stop_line - 60
A1x(t1) == stop_line + 16.4
A2x(t1) == stop_line + 11.5
"""


@pytest.mark.parametrize(
    ("program", "count", "ego"),
    [
        ("platoon", 3, "idm"),
        ("crossing", 6, "noisy"),
        ("mixed", 3, "dawdler"),
        ("chain", 3, "idm"),
    ],
)
def test_in_whole_runs_boxes_are_surely_apart_and_what_is_asked_is_met(program: str, count: int, ego: str) -> None:
    driven = drive(PROGRAMS[program](count), ego, replan_s=REPLAN_S)
    assert driven.apart_m(of_ego=False) >= SURELY_M
    assert driven.apart_m(of_ego=True) >= SURELY_M
    assert driven.met == count


def test_who_is_told_nothing_of_the_other_keeps_as_clear_of_it_as_the_manner_says(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert SURELY_M <= drive(ACROSS, "idm", replan_s=REPLAN_S).apart_m(of_ego=False) < 2.0
    assert drive("manner:\n- clear_m = 2\n" + ACROSS, "idm", replan_s=REPLAN_S).apart_m(of_ego=False) > 2.0
    monkeypatch.setattr(planning, "meetings_of", lambda scene: ())
    assert drive(ACROSS, "idm", replan_s=REPLAN_S).apart_m(of_ego=False) < 0.0


def test_who_comes_behind_keeps_clear_until_the_first_has_left_the_lane() -> None:
    """The first brakes to a stand just where it turns off: between two looks the second drove into its back."""
    turns_off = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (off):
- E, N
- [t0, go, t1, dec, t2]

Actor 2 (behind):
- E
- [t0, go, t1, acc, t2]

Constraints:
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 40
A1x(t1) == conflict_point - 25
A1v(t2) == 0
A2(t1) == A1(t1)
gap(A1, A2, t1) == -15
A2v(t2) - A2v(t1) == 2
"""
    assert drive(turns_off, "constant", replan_s=REPLAN_S).apart_m(of_ego=False) > 0.0


def test_who_is_to_be_in_contact_is_let() -> None:
    scene = scene_of(IN_CONTACT)
    driven = drive(IN_CONTACT, "constant", replan_s=REPLAN_S)
    motions = driven.run.last_plan.profiles
    assert not in_order(meetings_of(scene), scene, read_structure(scene.program), motions)
    assert driven.met == 2
    assert driven.apart_m(of_ego=False) < 0.0


@pytest.mark.parametrize("text", [ACROSS, PROGRAMS["chain"](3), PROGRAMS["mixed"](4)])
def test_slopes_are_those_of_the_rows(text: str) -> None:
    planner = planner_of(scene_of(text))
    planner.begin((0.0, 100.0, 9.0, 0.0))
    for k in range(1, 51):
        planner.observe((round(k * DEFAULT_STEP_S, 9), *planner.plan.profiles[EGO].state(k * DEFAULT_STEP_S)))
    situation, _ = planner._situation(1.0, planner._ego.foreseen(planner.plan.profiles))
    problem = Problem(planner._asked, situation, planner._meetings)
    direction = np.random.default_rng(3).normal(size=problem.size) * problem.step * 1e-5
    levels, slopes = [], []
    for z in (problem.guess - direction, problem.guess, problem.guess + direction):
        rows = list(problem._pairs(z, problem.shots(z))._all())
        levels.append(np.concatenate([row[1] for row in rows]))
        slopes.append(np.concatenate([row[2] @ direction[row[3]] for row in rows]))
    assert len(levels[1]) >= 2
    assert (levels[2] - levels[0]) / 2.0 == pytest.approx(slopes[1], abs=1e-6)


@pytest.mark.parametrize(("first", "late_s"), [(1, 0.0), (2, 5.0)])
def test_an_order_is_as_late_as_both_would_be_there(first: int, late_s: float) -> None:
    """The first is in the stretch from 1 s to 3 s, the second from 4 s to 6 s."""
    motions = {hero: Profile(chain(0.0, from_m, 10.0, [(9.0, 0.0, 0)])) for hero, from_m in ((1, 0.0), (2, -30.0))}
    meeting = Meeting(1, 2, ((10.0, 30.0), (10.0, 30.0)))
    assert passes_s(motions[2], 10.0) == pytest.approx(4.0)
    assert (meeting if first == 1 else meeting.turned()).late_s(motions) == pytest.approx(late_s)


def test_meetings_that_are_left_out_follow_from_others() -> None:
    """In any order of cars on two ways that merge, each keeps clear of all if each does of those next to it."""
    lane = ((0.0, np.inf), (0.0, np.inf))
    zones = ((50.0, 60.0), (80.0, 90.0))  # of ways 0 and 1
    random = np.random.default_rng(5)
    for count in (3, 6, 9):
        ways = random.integers(0, 2, count)  # by place in the order
        meetings = tuple(
            Meeting(a, b, None, lane)
            if ways[a] == ways[b]
            else Meeting(a, b, (zones[ways[a]], zones[ways[b]]), lane, zones[ways[a]][1] - zones[ways[b]][1])
            for a in range(count)
            for b in range(a + 1, count)
        )
        kept = needed(meetings)
        assert {(each.first, each.second) for each in kept} >= {(k, k + 1) for k in range(count - 1)}
        assert len(kept) <= 2 * count
        reached = {(each.first, each.second) for each in kept}
        for middle in range(count):
            reached |= {(a, b) for a, c in reached for d, b in reached if c == d == middle}
        assert reached == {(each.first, each.second) for each in meetings}


def test_nobody_follows_from_an_order_that_goes_round() -> None:
    lane = ((0.0, np.inf), (0.0, np.inf))
    circle = tuple(Meeting(a, b, None, lane) for a, b in ((1, 2), (2, 3), (3, 1)))
    assert needed(circle) == circle


def test_meetings_of_many_are_few() -> None:
    count = 12
    planner = planner_of(scene_of(PROGRAMS["platoon"](count)))
    planner.begin((0.0, 40.0, 9.0, 0.0))
    assert len(planner._meetings) == count - 1


@pytest.mark.parametrize("at_s", [0.0, 1.0])
def test_moments_between_two_are_midway(at_s: float) -> None:
    planner = planner_of(scene_of(ACROSS))
    planner.begin((0.0, 100.0, 9.0, 0.0))
    meeting = next(each for each in planner._meetings if each.zones_m is not None)
    situation, _ = planner._situation(at_s, planner._ego.foreseen(planner.plan.profiles))
    problem = Problem(planner._asked, situation, planner._meetings)
    z = problem.ordered(problem.guess)
    moment = next(moment for each, moment in problem._meetings if each == meeting and moment is not None)
    (_, out_m), (in_m, _) = meeting.zones_m or ((0.0, 0.0), (0.0, 0.0))
    motions = problem.shots(z)
    s_m = [float(motions[h].along(np.array([z[moment]]))[0][0]) for h in (meeting.first, meeting.second)]
    assert s_m[0] >= out_m
    assert s_m[1] <= in_m


def test_what_is_owed_in_a_lane_ends_evenly_where_the_first_leaves_it() -> None:
    """A row that was there in full and then was not refused every step of plans that ended just there."""
    shared_m = ((0.0, 50.0), (0.0, 50.0))

    def short_m(first_m: float) -> float:
        stand = {hero: Way(Profile(chain(0.0, s_m, 0.0, [(9.0, 0.0, 0)]))) for hero, s_m in ((1, first_m), (2, 47.0))}
        rows = PairRows(
            [(Meeting(1, 2, None, shared_m), None)], stand, np.zeros(1), {}, Preferences(), np.zeros(0), 20.0
        )
        return max((float(short[0]) for _, short, *_ in rows._all()), default=0.0)

    owed = np.array([short_m(float(first_m)) for first_m in np.arange(40.0, 53.0, 0.1)])
    assert np.all(np.abs(np.diff(owed)) < 0.1001)
    assert owed[0] > 5.0
    assert short_m(50.2) < 0.0, "it has left"
    assert short_m(49.8) == pytest.approx(0.2), "it has hardly to go on"
