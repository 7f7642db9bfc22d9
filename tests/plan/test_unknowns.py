"""The unknowns of a plan: first values go on as planned, and whatever the values are, knots come one after another."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from situations import HERO, PROGRAMS, every_problem, near, problem_of

from stories import STORIES, program

TWO_MOMENTS = program(
    "W",
    "t0, go, t1, dec, t2, go, t3, acc, t4",
    """
A0(t1) == A1(t1)
A0x(t1) == stop_line - 50
A1x(t1) == stop_line - 20
A1v(t2) == 6
A0(t2) == A1(t3)
A0x(t2) == stop_line - 30
A1v(t4) == 9
""",
)


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


@given(seed=st.integers(0, 9999))
@settings(max_examples=20)
def test_what_comes_between_two_moments_that_are_known_stays_between_them(seed: int) -> None:
    """A later moment of the ego's is known as its trigger is: what was to be done before it is done by then."""
    problem = problem_of(TWO_MOMENTS)
    moments = [problem.moments[problem.asked.knot(HERO, name)] for name in ("t1", "t2", "t3", "t4")]
    assert [moment.unknown is None for moment in moments] == [True, False, True, False]
    z = problem.ordered(near(problem, seed, 10.0))
    assert all(after.value(z) >= before.value(z) + 0.049 for before, after in pairwise(moments))
