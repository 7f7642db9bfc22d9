"""Steps by each row's own unknowns are the steps by all of them, and are where the cost is least."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import sparse
from situations import near, problem_of

from scenewright.plan.solving import _step
from scenewright.plan.sparse_steps import least, sparse_step
from stories import STORIES

ROUNDING = 1e-6


@given(seed=st.integers(0, 10_000), size=st.integers(1, 12), count=st.integers(0, 30))
def test_nothing_near_what_is_found_costs_less(seed: int, size: int, count: int) -> None:
    random = np.random.default_rng(seed)
    root, slope = random.normal(size=(size, size)), random.normal(size=size)
    hessian = root @ root.T + 0.1 * np.eye(size)
    rows, levels = (
        random.normal(size=(count, size)) * random.choice([0.1, 1.0, 30.0], (count, 1)),
        random.normal(size=count),
    )

    def cost(x: np.ndarray) -> float:
        return float(0.5 * x @ hessian @ x + slope @ x + 0.5 * np.sum(np.maximum(rows @ x + levels, 0.0) ** 2))

    x = least(
        sparse.csr_array(hessian), slope, sparse.csr_array(rows.reshape(count, size)), levels, random.normal(size=size)
    )
    pull = hessian @ x + slope + rows.T @ np.maximum(rows @ x + levels, 0.0)
    assert np.max(np.abs(pull)) <= ROUNDING * (1.0 + np.max(np.abs(hessian)) + np.sum(rows**2))
    assert all(cost(x) <= cost(x + 0.1 * random.normal(size=size)) for _ in range(10))


@settings(max_examples=12, deadline=None)
@given(story=st.sampled_from(sorted(STORIES)), seed=st.integers(0, 1000), at_s=st.sampled_from([0.0, 1.0]))
def test_a_step_is_as_good_as_that_by_all_unknowns(story: str, seed: int, at_s: float) -> None:
    problem = problem_of(STORIES[story], at_s)
    z = problem.ordered(near(problem, seed))
    costs, bounds, _ = problem.rows(z)
    (dense, _), (own, promised) = _step(problem, z, costs, bounds, 1.0), sparse_step(problem, z, costs, bounds, 1.0)
    assert dense is not None

    def cost(step: np.ndarray) -> float:
        residuals = np.array(costs.values) + np.array(costs.slopes) @ step
        levels = np.array(bounds.values)
        softened = np.minimum(1.0, np.array(bounds.most) / np.maximum(levels, 1e-9))
        over = np.maximum(levels + np.array(bounds.slopes) @ step, 0.0)
        beyond = levels - np.array(bounds.most)
        evenly = 0.5 * float(np.sum(np.array(bounds.most) * beyond, where=beyond > 0.0))
        return float(0.5 * residuals @ residuals + 0.5 * softened @ over**2) + evenly

    assert cost(own) <= cost(dense) * 1.001 + 1e-3
    assert promised == pytest.approx(cost(own), rel=1e-3, abs=1e-3)
