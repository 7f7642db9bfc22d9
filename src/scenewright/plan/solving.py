"""Solves a planning problem: Gauss-Newton steps, one convex problem each.

What enters: a `Problem` and first values. What leaves: the best values found, what they cost, and what they miss.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.plan.problem import Problem, Rows, steps_and_bounds

Array = NDArray[np.float64]
DEBUG=False
_SOFT_ROW, _SOFT = 8, 1e-6  # how daqp is told that a row may be broken, at a high price
_DAMPING = 0.02
_ENOUGH = 1e-4
_HALVINGS = 6


@dataclass(frozen=True, slots=True)
class Solution:
    """Values of all unknowns; what heroes miss most, in tight tolerances; how late the latest is that is to be first."""

    z: Array
    cost: float
    missed: float
    late_s: float
    steps: int


def solve(problem: Problem, z: Array, most_steps: int) -> Solution:
    """Return the best that so many steps from `z` lead to."""
    longest, low, high = steps_and_bounds(problem)
    z = problem.ordered(z)
    costs, bounds, missed = problem.rows(z)
    merit = _merit(costs, bounds)
    for count in range(most_steps):
        step = _step(costs, bounds, np.maximum(low - z, -longest), np.minimum(high - z, longest), longest)
        if DEBUG: print('   ',count,round(merit,2),missed, None if step is None else round(float(np.max(np.abs(step)/longest)),3))
        if step is None:
            return Solution(z, merit, *missed, count)
        share = 1.0
        for _ in range(_HALVINGS):
            trial = problem.ordered(z + share * step)
            found = problem.rows(trial)
            better = _merit(*found[:2])
            if better < merit:
                break
            share *= 0.5
        else:
            if DEBUG: print('    no gain')
            return Solution(z, merit, *missed, count)
        gained, merit = merit - better, better
        z, (costs, bounds, missed) = trial, found
        if gained < _ENOUGH * (1.0 + merit):
            return Solution(z, merit, *missed, count + 1)
    return Solution(z, merit, *missed, most_steps)


def _merit(costs: Rows, bounds: Rows) -> float:
    over, most = np.maximum(np.array(bounds.values), 0.0), np.array(bounds.most)
    within = np.minimum(over, most)
    return 0.5 * float(np.sum(np.array(costs.values) ** 2)) + float(np.sum(within * (over - 0.5 * within)))


def _step(costs: Rows, bounds: Rows, low: Array, high: Array, longest: Array) -> Array | None:
    import daqp

    size = len(longest)
    residuals, slopes = np.array(costs.values), np.array(costs.slopes)
    levels, rows = np.array(bounds.values), np.array(bounds.slopes)
    near = (levels > -np.abs(rows) @ longest) & np.any(rows != 0.0, axis=1)
    levels, rows, most = levels[near], rows[near], np.array(bounds.most)[near]
    softened = np.sqrt(np.minimum(1.0, most / np.maximum(levels, 1e-9)))
    levels, rows = levels * softened, rows * softened[:, None]
    # Each row has a slack of its own, so that its price is the same here as in the merit.
    count = len(levels)
    slopes, rows = slopes * longest, rows * longest
    sizes = np.maximum(np.linalg.norm(rows, axis=1), 1.0)
    hessian = np.zeros((size + count, size + count))
    hessian[:size, :size] = slopes.T @ slopes + _DAMPING**2 * np.eye(size)
    hessian[size:, size:] = np.diag(sizes**2)
    scale = 1.0 / max(1.0, float(np.max(np.diag(hessian))))
    matrix = np.hstack([rows / sizes[:, None], -np.eye(count)])
    free = np.full(count, 1e30)
    x, _, flag, _ = daqp.solve(
        scale * hessian,
        scale * np.concatenate([slopes.T @ residuals, np.zeros(count)]),
        np.ascontiguousarray(matrix),
        np.concatenate([high / longest, free, -levels / sizes]),
        np.concatenate([low / longest, 0.0 * free, -free]),
        np.zeros(size + 2 * count, dtype=np.int32),
        primal_tol=1e-9,
        iter_limit=4000,
    )
    return None if flag < 1 else np.clip(np.asarray(x)[:size] * longest, low, high)
