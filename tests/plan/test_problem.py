"""One plan as one problem: what changes with which unknown and by how much, and that knots come one after another."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from situations import HERO, Array, near, problem_of

from scenewright.plan.asked import Caps
from scenewright.plan.problem import Problem
from scenewright.program.types import EGO
from stories import STORIES

STEP = 1e-6
WAITS_TWICE = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, stop, t1, go, t2, dec, t3]

Constraints:
A0(t1) == A1(t2)
A0x(t1) == conflict_point - 25
A1x(t2) == conflict_point - 18
A1x(t3) == conflict_point - 6
A1v(t3) == 0
A1v(3.5) >= 2
"""
AT_TIMES = (
    STORIES["yields, distance"] + "A1v(2.0) == 4\nA1v(A0(t2)) == 0\nA1x(1.5) <= conflict_point - 25\nA1a(t1) <= -1\n"
)
PROGRAMS = {**STORIES, "waits twice": WAITS_TWICE, "at times": AT_TIMES}
TABLE = [(name, at_s) for name in PROGRAMS for at_s in (0.0, 1.2)]
every_problem = pytest.mark.parametrize(("name", "at_s"), TABLE)


def times_of(problem: Problem) -> set[int]:
    return {moment.unknown for moment in problem.moments if moment.unknown is not None}


def around(problem: Problem, z: Array, unknown: int) -> tuple[Array, Array]:
    low, high = z.copy(), z.copy()
    low[unknown] -= STEP
    high[unknown] += STEP
    return low, high


@every_problem
def test_states_change_with_the_unknowns_as_their_slopes_say(name: str, at_s: float) -> None:
    problem = problem_of(PROGRAMS[name], at_s)
    z, asked = near(problem, 0), problem.asked
    _, slopes = problem._point(z, problem.shots(z))
    # How a rate changes with the time of its moment is left out: between two nodes that is no more than comfort.
    rates = [number for number, unknown in enumerate(asked.events.unknowns) if unknown.kind == "rate"]
    for unknown in range(problem.size):
        before, after = (problem._point(x, problem.shots(x))[0] for x in around(problem, z, unknown))
        wanted = (after - before) / (2.0 * STEP)
        if unknown in times_of(problem):
            wanted[rates] = slopes[rates, unknown]
        assert slopes[:, unknown] == pytest.approx(wanted, rel=1e-3, abs=2e-3), unknown


@pytest.mark.parametrize("name", [name for name in PROGRAMS if ", time" not in name])
@pytest.mark.parametrize("at_s", [0.0, 1.2])
def test_rows_change_as_their_slopes_say(name: str, at_s: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a row has a kink, or a weight that depends on a time or a rate, nothing is told of its slope."""
    problem = problem_of(PROGRAMS[name], at_s)
    even = Caps(np.array([0.0, 1000.0]), np.array([22.0, 7.0]), np.array([14.0, 2.0]))
    monkeypatch.setattr(problem.asked, "caps", dict.fromkeys(problem.asked.caps, even))
    z, times = near(problem, 1), times_of(problem)
    here, compared = problem.rows(z)[:2], 0
    accels = {a for legs in problem._legs.values() for leg in legs for a in leg.accels}
    others = [k for k in range(problem.size) if k not in accels]
    for unknown in range(problem.size):
        low, high = (problem.rows(x)[:2] for x in around(problem, z, unknown))
        for kind, (at, before, after) in enumerate(zip(here, low, high, strict=True)):
            if not len(at.values) == len(before.values) == len(after.values):
                continue
            for value, slope, less, more in zip(at.values, at.slopes, before.values, after.values, strict=True):
                backward, forward = (value - less) / STEP, (more - value) / STEP
                of_comfort = unknown in times and not np.any(slope[others])
                weighed = kind == 0 and (of_comfort or name == "brakes at a rate")
                if weighed or abs(forward - backward) > 1e-2 * (1.0 + abs(forward)):
                    continue
                compared += 1
                assert slope[unknown] == pytest.approx(0.5 * (forward + backward), rel=1e-3, abs=2e-2), unknown
    assert compared > 10 * problem.size


@every_problem
@settings(max_examples=10)
@given(data=st.data())
def test_ordered_values_keep_knots_in_order_and_to_their_bounds(name: str, at_s: float, data: st.DataObject) -> None:
    problem = problem_of(PROGRAMS[name], at_s)
    share = data.draw(st.floats(0.0, 10.0))
    z = problem.ordered(near(problem, data.draw(st.integers(0, 9999)), share))
    assert np.all(z >= problem.low - 1e-12)
    assert problem.ordered(z) == pytest.approx(z)
    knots = problem.asked.scene.program.actor(HERO).sketch.knots
    times = [problem.moments[problem.asked.knot(HERO, knot)].value(z) for knot in knots]
    first = problem.now.heroes[HERO].piece + 1 if problem.now.heroes else 0
    assert all(after >= before + 0.049 for before, after in pairwise(times[first:]))
    # Pieces follow one another whatever the values are: no motion is made that goes back in time.
    assert np.all(np.diff(problem.shots(z)[HERO].time) >= -1e-9)


@every_problem
def test_first_values_are_ordered_within_their_bounds_and_go_on_as_planned(name: str, at_s: float) -> None:
    problem = problem_of(PROGRAMS[name], at_s)
    assert np.all((problem.low <= problem.guess) & (problem.guess <= problem.high))
    assert np.all(problem.step > 0.0)
    if not at_s:
        return
    drive, shot = problem.now.heroes[HERO], problem.shots(problem.guess)[HERO]
    assert shot.at_node(0)[:2] == pytest.approx(drive.motion.state(drive.begin_s)[:2])


def test_who_drives_already_begins_as_it_drives() -> None:
    problem = problem_of(STORIES["yields, distance"], 1.2)
    for seed in range(5):
        s_m, v, d_s, d_v = problem.shots(near(problem, seed))[HERO].at_node(0)
        assert (s_m, v) == pytest.approx(problem.now.heroes[HERO].motion.state(1.2)[:2])
        assert not np.any(d_s)
        assert not np.any(d_v)


def test_the_ego_is_where_it_is_foreseen_to_be() -> None:
    problem = problem_of(STORIES["yields, distance"], 1.2)
    z = near(problem, 1)
    point, _ = problem._point(z, problem.shots(z))
    instant = problem.asked.knot(EGO, "t1")
    state = problem.asked.events.states[EGO, instant]
    place = next(iter(state.place.terms))[0]
    assert point[place] == pytest.approx(problem.now.ego(problem.moments[instant].value(z))[0])


def test_what_is_missed_is_told_in_tight_tolerances() -> None:
    problem = problem_of(STORIES["yields, distance"])
    z = problem.guess.copy()
    _, _, missed = problem.rows(z)
    assert missed.by < 0.05, "it is a plan that was found good"
    place = problem._starts[HERO].place
    assert place is not None
    z[place] += 3.0  # everywhere 3 m further on: six tight tolerances at the trigger
    assert problem.rows(z)[2].by == pytest.approx(6.0, abs=0.1)
