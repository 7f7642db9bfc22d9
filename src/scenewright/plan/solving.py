"""Solves a planning problem: Gauss-Newton steps, one convex problem each.

What enters: a `Problem` and first values. What leaves: the best values found, what they cost, and what they miss. The
number of steps is the only budget: the same problem has the same solution, however busy a machine is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.plan.problem import DAMPING, Missed, Problem
from scenewright.plan.rows import Rows

Array = NDArray[np.float64]

_ENOUGH = 1e-4  # a step that gains a smaller share is the last
# After a step that gains nothing, and one that does, the next may be so much as long; chosen. Shorter ones are none.
_SHORTER, _LONGER, _LEAST_TRUST, _NO_STEP = 0.3, 2.5, 1e-3, 1e-6
_FREE, _EXACT, _MOST_ITERATIONS = 1e30, 1e-9, 4000


@dataclass(frozen=True, slots=True)
class Solution:
    """Values of all unknowns, what they cost and what they miss, and in how many steps they were found."""

    z: Array
    cost: float
    missed: Missed
    steps: int


def solve(problem: Problem, z: Array, most_steps: int, enough: float = 0.0) -> Solution:
    """Return the best that so many steps from `z` lead to; where one gains nothing the next is shorter.

    One that gains or loses less than `enough` is the last, and one that comes so near to the best of the linear rows.
    """
    z = problem.ordered(z)
    costs, bounds, missed = problem.rows(z)
    cost, trusted = _cost(costs, bounds), 1.0
    for count in range(most_steps):
        step, promised = _step(problem, z, costs, bounds, trusted)
        if step is None or trusted < _LEAST_TRUST:
            return Solution(z, cost, missed, count)
        trial = problem.ordered(z + step)
        if np.max(np.abs(trial - z) / problem.step) < _NO_STEP:
            return Solution(z, cost, missed, count)
        found = problem.rows(trial)
        better = _cost(*found[:2])
        least = max(enough, _ENOUGH * (1.0 + cost))
        if 0.0 <= better - cost < enough:  # as good as the best: a shorter step hardly gains more
            return Solution(z, cost, missed, count + 1)
        if better >= cost:
            trusted *= _SHORTER
            continue
        arrived = better - promised < enough and np.all(np.abs(step) < 0.999 * trusted * problem.step)
        gained, cost, trusted = cost - better, better, min(1.0, _LONGER * trusted)
        z, (costs, bounds, missed) = trial, found
        if gained < least or arrived:
            return Solution(z, cost, missed, count + 1)
    return Solution(z, cost, missed, most_steps)


def _cost(costs: Rows, bounds: Rows) -> float:
    """Return the sum of half the squares; of a bound what is beyond it, and from `most` on evenly."""
    over, most = np.maximum(bounds.values, 0.0), bounds.most
    within = np.minimum(over, most)
    return 0.5 * float(np.sum(costs.values**2)) + float(np.sum(within * (over - 0.5 * within)))


def _step(problem: Problem, z: Array, costs: Rows, bounds: Rows, trusted: float) -> tuple[Array | None, float]:
    """Return the best step for the linearised rows, within a share of the longest, and what it costs at least.

    None where there is none.
    """
    if any(block.columns is not None for block in costs.blocks):
        from scenewright.plan.sparse_steps import sparse_step  # slow to import, and one hero needs none

        return sparse_step(problem, z, costs, bounds, trusted)
    import daqp

    longest, size = problem.step, problem.size
    residuals, slopes = costs.values, costs.slopes * longest
    levels, rows, most = bounds.values, bounds.slopes * longest, bounds.most
    softened = np.sqrt(np.minimum(1.0, most / np.maximum(levels, 1e-9)))
    levels, rows = levels * softened, rows * softened[:, None]
    # Unknowns are scaled so that each curves the cost alike: the solver stops far from the best where some curve it a
    # million times more.
    curved, slope = _product(slopes.T, slopes) + DAMPING**2 * np.eye(size), _product(slopes.T, residuals[:, None])[:, 0]
    scales = 1.0 / np.sqrt(np.diag(curved))
    curved, slope, rows = curved * scales[:, None] * scales, scales * slope, rows * scales
    low, high = (np.clip((bound - z) / longest, -trusted, trusted) for bound in (problem.low, problem.high))
    # Few bounds matter: those that the best step without them breaks are put in, until it breaks no other. Each has a
    # slack of its own, so that its price is the same here as in the cost.
    counted = levels > 0.0
    while True:
        count = int(np.count_nonzero(counted))
        hessian = np.eye(size + count)
        hessian[:size, :size] = curved
        x, _, flag, _ = daqp.solve(
            hessian,
            np.concatenate([slope, np.zeros(count)]),
            np.ascontiguousarray(np.hstack([rows[counted], -np.eye(count)])),
            np.concatenate([high / scales, np.full(count, _FREE), -levels[counted]]),
            np.concatenate([low / scales, np.zeros(count), np.full(count, -_FREE)]),
            np.zeros(size + 2 * count, dtype=np.int32),
            primal_tol=_EXACT,
            iter_limit=_MOST_ITERATIONS,
        )
        if flag < 1:
            return None, 0.0
        best = np.asarray(x)[:size]
        broken = (levels + _product(rows, best[:, None])[:, 0] > _EXACT) & ~counted
        if not np.any(broken):
            return np.clip(scales * best, low, high) * longest, 0.0
        counted |= broken


def _product(left: Array, right: Array) -> Array:
    """Return a matrix product that is summed in the same order on any machine, as tuned libraries do not."""
    return np.asarray(np.einsum("ij,jk->ik", left, right, optimize=False), dtype=np.float64)
