"""One Gauss-Newton step where each row is by a few unknowns: many heroes, each with its own.

What enters: rows with the unknowns that they are by. What leaves: the best step for them, as `solving` takes it. Dense
problems grow with the cube of all rows; of this one only the unknowns count, and of the rows those beyond their bounds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from scenewright.plan.problem import DAMPING
from scenewright.plan.rows import Columns, Rows

if TYPE_CHECKING:
    from scenewright.plan.problem import Problem

Array = NDArray[np.float64]
Matrix = sparse.csr_array

# A step beyond what an unknown may be costs as if a bound so dear were broken: at last none is by more than rounding.
# Newton's steps stop at each wall: where walls are low at first, many are found at once, in half as many steps.
_WALLS = 1e2, 1e5
_SYMMETRIC: dict[str, Any] = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
_STANDS, _MOST_NEWTON_STEPS = 1e-9, 100


def sparse_step(problem: Problem, z: Array, costs: Rows, bounds: Rows, trusted: float) -> tuple[Array, float]:
    """Return the best step for the linearised rows, within a share of the longest, and what they cost after it."""
    longest, size = problem.step, problem.size
    levels, most = bounds.values, bounds.most
    beyond = levels - most  # what grows evenly from there on costs more than its square where it is softened
    softened = np.sqrt(np.minimum(1.0, most / np.maximum(levels, 1e-9)))
    low, high = (np.clip((bound - z) / longest, -trusted, trusted) for bound in (problem.low, problem.high))
    slopes, values, x = _matrix(costs, longest), costs.values, np.zeros(size)
    hessian = slopes.T @ slopes + DAMPING**2 * sparse.eye_array(size, format="csr")
    for wall in _WALLS:
        rows = _matrix(bounds, longest, softened, wall)
        x = least(hessian, slopes.T @ values, rows, np.concatenate([softened * levels, -wall * high, wall * low]), x)
        if np.all((low <= x) & (x <= high)):
            break
    x = np.clip(x, low, high)
    after, over = values + slopes @ x, np.maximum(softened * levels + (rows @ x)[: len(levels)], 0.0)
    evenly = 0.5 * float(np.sum(most * beyond, where=beyond > 0.0))
    return np.asarray(x * longest, dtype=np.float64), 0.5 * float(after @ after + over @ over) + evenly


def least(hessian: Matrix, slope: Array, rows: Matrix, levels: Array, x: Array) -> Array:
    """Return where half a quadratic form, a slope and half the squares of what of rows is beyond zero are least.

    That is convex, and quadratic in parts: Newton's steps from `x`, each as long as is best, end there (Sun 1997).
    """
    over = levels + rows @ x
    for _ in range(_MOST_NEWTON_STEPS):
        beyond = over > 0.0
        counted, pull = rows[beyond], hessian @ x + slope
        bent = splu(sparse.csc_array(hessian + counted.T @ counted), "MMD_AT_PLUS_A", **_SYMMETRIC)
        way = -bent.solve(pull + counted.T @ over[beyond])
        changes = rows @ way
        after = over + changes
        if np.array_equal(beyond, after > 0.0) or np.max(np.abs(way)) < _STANDS:
            return x + way
        falls, bends = float(way @ pull), float(way @ (hessian @ way))
        more = np.sum(np.maximum(after, 0.0) ** 2 - np.maximum(over, 0.0) ** 2)
        share = 1.0 if falls + 0.5 * (bends + more) < 0.0 else _best_share(falls, bends, over, changes)
        x, over = x + share * way, over + share * changes
    return x


def _best_share(falls: float, bends: float, over: Array, changes: Array) -> float:
    """Return which share of a step is best: where its slope, that grows in pieces, is zero.

    Without the rows it falls by `falls` and bends by `bends`; each row counts while it is beyond zero.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        at = -over / changes
    turns = np.flatnonzero((at > 0.0) & np.isfinite(at))
    turns = turns[np.argsort(at[turns], kind="stable")]
    counts = (over > 0.0) | ((over == 0.0) & (changes > 0.0))
    sense = np.sign(changes[turns])
    falls_then = falls + over[counts] @ changes[counts] + np.cumsum([0.0, *(sense * over[turns] * changes[turns])])
    bends_then = bends + changes[counts] @ changes[counts] + np.cumsum([0.0, *(sense * changes[turns] ** 2)])
    zeros = -falls_then / np.maximum(bends_then, 1e-300)
    return float(zeros[np.argmax(zeros <= np.append(at[turns], np.inf))])


def _matrix(rows: Rows, longest: Array, weights: Array | None = None, wall: float = 0.0) -> Matrix:
    """Return the slopes of rows, weighted, by all unknowns, each in its longest step; below them both its walls."""
    columns, slopes, counts = list[Columns](), list[Array](), list[int]()
    for block in rows.blocks:
        by = np.flatnonzero(block.slopes.any(axis=0)) if block.columns is None else block.columns
        slopes.append((block.slopes[:, by] if block.columns is None else block.slopes).ravel())
        columns += [by] * len(block.values)
        counts += [len(by)] * len(block.values)
    column = np.concatenate(columns)
    values = np.concatenate(slopes) * longest[column]
    if weights is not None:
        values *= np.repeat(weights, counts)
    if wall:
        one = np.arange(len(longest))
        column, counts = np.concatenate([column, one, one]), [*counts, *[1] * (2 * len(one))]
        values = np.concatenate([values, np.full(len(one), wall), np.full(len(one), -wall)])
    return sparse.csr_array((values, column, np.cumsum([0, *counts])), (len(counts), len(longest)))
