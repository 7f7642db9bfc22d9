"""Solving: what is best is found, it never gets worse, and the number of steps is the only budget."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from situations import Array, near, problem_of

from scenewright.plan.problem import DAMPING, Missed
from scenewright.plan.rows import Rows
from scenewright.plan.solving import Solution, _step, solve
from stories import STORIES


class Made:
    """A problem with one unknown for each pull: each is drawn to a number, and further rows are added."""

    def __init__(self, pulls: list[float], bounds: Callable[[Array, Rows], None], reach: float = 100.0) -> None:
        self.size = len(pulls)
        self.guess = np.zeros(self.size)
        self.low, self.high = np.full(self.size, -reach), np.full(self.size, reach)
        self.step = np.full(self.size, 10.0)
        self._pulls, self._bounds = pulls, bounds

    def ordered(self, z: Array) -> Array:
        return np.clip(z, self.low, self.high)

    def rows(self, z: Array) -> tuple[Rows, Rows, Missed]:
        costs, bounds = Rows(), Rows()
        for k, pull in enumerate(self._pulls):
            costs.add(float(z[k]) - pull, np.eye(self.size)[k])
        self._bounds(z, bounds)
        return costs, bounds, Missed(max(bounds.values, default=0.0))


def _free(z: Array, bounds: Rows) -> None:
    """Add a bound that nobody meets: every plan has some."""
    bounds.add(-1.0, np.zeros(len(z)))


def found(made: Made, steps: int = 60) -> Solution:
    return solve(made, made.guess, steps)  # type: ignore[arg-type]


@given(pull=st.floats(-30.0, 30.0), reach=st.floats(1.0, 40.0))
def test_goes_to_where_it_is_drawn_as_far_as_it_may(pull: float, reach: float) -> None:
    z = found(Made([pull, 1.0], _free, reach)).z
    assert z == pytest.approx([np.clip(pull, -reach, reach), 1.0], abs=0.05)


@given(pull=st.floats(2.0, 30.0), price=st.floats(0.5, 30.0))
def test_a_bound_is_exceeded_as_far_as_its_price_lets_it(pull: float, price: float) -> None:
    solution = found(Made([pull], lambda z, bounds: bounds.add(float(z[0]) - 1.0, np.array([1.0]), price)))
    assert solution.z[0] == pytest.approx((pull + price**2) / (1.0 + price**2), abs=0.05)


@given(pull=st.floats(1.0, 30.0), price=st.floats(0.5, 4.0), most=st.floats(0.2, 4.0))
def test_from_some_cost_on_a_bound_costs_evenly(pull: float, price: float, most: float) -> None:
    made = Made([pull], lambda z, bounds: bounds.add(float(z[0]) - 1.0, np.array([1.0]), price, most))
    within = (pull + price**2) / (1.0 + price**2)
    wanted = within if price * (within - 1.0) <= most else pull - price * most
    costs = [solve(made, np.array([z]), 0).cost for z in (found(made, 400).z[0], wanted)]  # type: ignore[arg-type]
    assert costs[0] == pytest.approx(costs[1], rel=2e-3, abs=1e-3)


def test_bends_are_followed_step_by_step() -> None:
    """On a circle, as near as may be to a place outside it."""

    def circle(z: Array, bounds: Rows) -> None:
        bounds.add(float(z @ z) - 25.0, 2.0 * z, 30.0)

    solution = found(Made([6.0, 8.0], circle))
    assert solution.z == pytest.approx([3.0, 4.0], abs=0.02)
    assert solution.missed.by < 0.1


def test_what_nobody_draws_at_stays() -> None:
    made = Made([5.0], _free)
    made.guess = np.array([5.0])
    solution = found(made)
    assert solution.z[0] == 5.0
    assert solution.steps <= 1


@pytest.mark.parametrize("name", STORIES)
@settings(max_examples=3)
@given(seed=st.integers(0, 9999), at_s=st.sampled_from([0.0, 1.2]))
def test_cost_never_grows_from_step_to_step(name: str, seed: int, at_s: float) -> None:
    problem = problem_of(STORIES[name], at_s)
    start = near(problem, seed, 0.3)
    solutions = [solve(problem, start, count) for count in (0, 1, 2, 4, 8)]
    costs = [solution.cost for solution in solutions]
    assert all(after <= before for before, after in pairwise(costs))
    assert costs[-1] < costs[0]
    for count, solution in zip((0, 1, 2, 4, 8), solutions, strict=True):
        assert solution.steps <= count
        assert np.all((solution.z >= problem.low - 1e-9) & (solution.z <= problem.high + 1e-9))


@pytest.mark.parametrize("name", STORIES)
def test_the_same_problem_has_the_same_solution(name: str) -> None:
    problem = problem_of(STORIES[name], 1.2)
    first = solve(problem, near(problem, 1), 6)
    solve(problem, near(problem, 2), 6)
    again = solve(problem, near(problem, 1), 6)
    assert np.array_equal(first.z, again.z)
    assert (first.cost, first.missed, first.steps) == (again.cost, again.missed, again.steps)


@pytest.mark.parametrize("name", STORIES)
def test_of_linear_rows_no_other_step_is_better(name: str) -> None:
    """Most bounds are left out of the convex problem: it is as good as if they were in it."""
    problem = problem_of(STORIES[name])
    z = near(problem, 3, 0.3)
    costs, bounds, _ = problem.rows(z)
    step, _ = _step(problem, z, costs, bounds, 1.0)
    assert step is not None
    longest, most, levels = problem.step, bounds.most, bounds.values
    softened = np.sqrt(np.minimum(1.0, most / np.maximum(levels, 1e-9)))

    def cost(x: Array) -> float:
        over = np.maximum(softened * (levels + bounds.slopes @ (x * longest)), 0.0)
        left = costs.values + costs.slopes @ (x * longest)
        return 0.5 * float(left @ left + over @ over + DAMPING**2 * x @ x)

    low, high = (np.clip((bound - z) / longest, -1.0, 1.0) for bound in (problem.low, problem.high))
    chance, best = np.random.default_rng(0), step / longest
    for size in (1e-4, 1e-3, 1e-2, 0.1, 1.0):
        for _ in range(40):
            other = np.clip(best + size * chance.standard_normal(len(best)), low, high)
            assert cost(other) >= cost(best) - 1e-6 * (1.0 + cost(best))
