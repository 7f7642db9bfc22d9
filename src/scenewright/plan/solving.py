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
_SOFT_ROW, _SOFT = 8, 1e-5  # how daqp is told that a row may be broken, at a high price
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
    levels, rows, firm = np.array(bounds.values), np.array(bounds.slopes), np.array(bounds.firm)
    near = (levels > -np.abs(rows) @ longest) & np.any(rows != 0.0, axis=1)
    levels, rows, firm, most = levels[near], rows[near], firm[near], np.array(bounds.most)[near]
    softened = np.sqrt(np.minimum(1.0, most / np.maximum(levels, 1e-9)))
    levels, rows = levels * softened, rows * softened[:, None]
    priced = np.flatnonzero(~firm)
    # What may be broken at a price has a slack of its own; what is firm is left to the solver's own slacks.
    whole = size + len(priced)
    hessian = np.eye(whole)
    hessian[:size, :size] = slopes.T @ slopes + np.diag((_DAMPING / longest) ** 2)
    matrix = np.zeros((len(levels), whole))
    matrix[:, :size] = rows
    matrix[priced, size + np.arange(len(priced))] = -1.0
    free = np.full(len(priced), 1e30)
    x, _, flag, _ = daqp.solve(
        hessian,
        np.concatenate([slopes.T @ residuals, np.zeros(len(priced))]),
        matrix,
        np.concatenate([high, free, -levels]),
        np.concatenate([low, 0.0 * free, np.full(len(levels), -1e30)]),
        np.concatenate([np.zeros(whole, dtype=np.int32), np.where(firm, _SOFT_ROW, 0).astype(np.int32)]),
        rho_soft=_SOFT,
        primal_tol=1e-7,
        iter_limit=4000,
    )

    return None if flag < 1 else np.clip(np.asarray(x)[:size], low, high)
