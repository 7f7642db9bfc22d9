"""One plan as one problem: what changes with which unknown and by how much, and that knots come one after another."""

from __future__ import annotations

import numpy as np
import pytest
from situations import HERO, PROGRAMS, Array, every_problem, near, problem_of

from scenewright.plan.asked import Caps
from scenewright.plan.problem import Problem
from scenewright.program.types import EGO
from stories import STORIES

STEP = 1e-6


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
    places, most, comfortable, signed = map(np.array, ([0.0, 1000.0], [22.0, 7.0], [14.0, 2.0], [9.0, 5.0]))
    even = Caps(places, most, comfortable, (0.0,), ((signed, signed),))
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
    place = problem._starts[HERO][0].unknown
    assert place is not None
    z[place] += 3.0  # everywhere 3 m further on: six tight tolerances at the trigger
    assert problem.rows(z)[2].by == pytest.approx(6.0, abs=0.1)
