"""Looks for a motion of everybody that meets all constraints: Newton steps, one convex problem each.

What enters: events, constraints lowered over them, and a first guess. What leaves: values of all unknowns, or nothing.
At each step moments stand in the order of their present times, neighbours obey the law of the piece they lie in, of
alternatives the nearest is taken, and one convex problem with soft rows meets all of it as well as it can.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.compiled import Compiled
from scenewright.algebra.polynomials import Formula
from scenewright.motion.laws import Law, bounded, capped, fixed
from scenewright.solve.proofs.events import Events, Narrowing
from scenewright.solve.proofs.order import least_differences

Array = NDArray[np.float64]

DONE, NEARLY_DONE = 1e-6, 5e-5  # scaled: 0.5 mm, 0.05 ms, 0.1 mm/s where rounded numbers leave no more
_SCALE = {"time": 1.0, "place": 10.0, "speed": 2.0, "rate": 1.0, "other": 1.0}
_ENDS = np.array([_SCALE[kind] for kind in ("speed", "speed", "time", "place")])
_EITHER_WAY = np.concatenate([np.zeros((4, 1)), np.eye(4), -np.eye(4)], axis=1)[:, :, None]
_SOFT = 1e-5
_SOFT_ROW = 8  # how daqp is told that a row may be broken at a price
_STRICT = 1e-3  # by how much a strict comparison is to hold, in units of its scaled row
_MOST_STEPS = 40
# What a step is counted as beside the square of the number of unknowns. Measured: 0.55, 0.8, 5.4 and 36 ms with 16, 45,
# 157 and 398 unknowns.
_A_STEP = 2000
_CLEAR = 1e-4  # more than rounding
_TRUST = 4.0


class Search:
    """One search problem; `run` may be asked again from other guesses."""

    def __init__(self, events: Events, formulas: Sequence[Formula], narrowings: Sequence[Narrowing]) -> None:
        self.steps, self.work = 0, 0
        least, narrower = least_differences(events, formulas), [*events.pieces, *narrowings]
        self._size = len(events.unknowns)
        self._compiled = Compiled(formulas, self._size)
        self._low = np.array([float(each.low) for each in events.unknowns])
        self._high = np.array([float(each.high) for each in events.unknowns])
        self._scale = np.array([_SCALE[each.kind] for each in events.unknowns])
        free = np.array([each.kind == "other" for each in events.unknowns])
        self._scale = np.where(free, np.maximum(1.0, 0.25 * (self._high - self._low)), self._scale)
        self._lines = {
            actor.id: _Line(events, actor.id, least, [n for n in narrower if n.actor == actor.id])
            for actor in events.scene.program.actors
        }

    # -- the steps ----------------------------------------------------------------------------------------------------
    def run(self, guess: Array, generator: np.random.Generator | None = None) -> Array | None:
        """Return values that meet everything, starting from a guess; None where the steps do not get there.

        With a `generator` some alternatives are liked better than others, whatever is nearest.
        """
        count = len(self._compiled.atoms)
        liking = np.ones(count) if generator is None else np.exp(2.0 * generator.standard_normal(count))
        point = np.append(np.clip(guess, self._low, self._high), 1.0)
        trust, best, stale = _TRUST, np.inf, 0
        for _ in range(_MOST_STEPS):
            self.steps, self.work = self.steps + 1, self.work + _A_STEP + self._size**2
            rows, levels, equal = self._rows(point, liking)
            worst = float(np.max(np.where(equal, np.abs(levels), levels), initial=0.0))
            if worst < DONE:
                return point[:-1]
            if worst < 0.7 * best:
                best, stale = worst, 0
            else:
                stale += 1
                trust = max(0.25, 0.6 * trust)
                if worst < NEARLY_DONE and stale > 1:  # soft rows leave so much
                    return point[:-1]
                if stale > 8:
                    return None
            step = self._step(point, rows, levels, equal, trust)
            if step is None:
                return None
            point[:-1] = np.clip(point[:-1] + step, self._low, self._high)
        return None

    def _step(self, point: Array, rows: Array, levels: Array, equal: NDArray[np.bool_], trust: float) -> Array | None:
        """Return the least step that meets the linearised rows as well as can be."""
        import daqp

        scale, size = self._scale, self._size
        upper = np.minimum((self._high - point[:-1]) / scale, trust)
        lower = np.maximum((self._low - point[:-1]) / scale, -trust)
        above, below = -levels, np.where(equal, -levels, -1e30)
        sense = np.concatenate([np.zeros(size, dtype=np.int32), np.full(len(levels), _SOFT_ROW, dtype=np.int32)])
        x, _, flag, _ = daqp.solve(
            np.eye(size),
            np.zeros(size),
            np.ascontiguousarray(rows),
            np.concatenate([upper, above]),
            np.concatenate([lower, below]),
            sense,
            rho_soft=_SOFT,
            primal_tol=1e-8,
            iter_limit=2000,
        )
        return None if flag < 1 else np.asarray(x) * scale

    # -- rows ---------------------------------------------------------------------------------------------------------
    def _rows(self, point: Array, liking: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
        """Return linearised rows over scaled steps, their levels (to be at most zero, or zero) and which are equal."""
        compiled, count = self._compiled, len(self._compiled.atoms)
        parts = [(compiled.values(point), compiled.gradients(point), compiled.equal)]
        parts.append(_laws(self._lines.values(), point))
        levels, rows, equal = (np.concatenate([part[k] for part in parts]) for k in range(3))
        rows = rows[:, :-1] * self._scale
        norms = np.maximum(np.sqrt((rows * rows).sum(axis=1)), 1e-9)
        levels = levels / norms
        levels[:count] += np.where(compiled.strict, _STRICT, 0.0)
        errors = np.where(equal, np.abs(levels), levels)[:count]
        taken = [*compiled.chosen(errors * liking), *range(count, len(levels))]
        return rows[taken] / norms[taken, None], levels[taken], equal[taken]

    def way_of(self, point: Array, actor: int) -> tuple[list[int], list[Law]]:
        """Return an actor's instants in the order of their times, and the laws between them."""
        line, point = self._lines[actor], np.append(point, 1.0)
        order = line.sorted(point)
        bounds, _ = line.bounds_between(order, point)
        return [line.instants[k] for k in order], [Law(*map(Fraction, each)) for each in bounds.T.tolist()]


class _Line:
    """One actor's moments along time: numbers of their unknowns; a known time is a multiple of the one at the end."""

    def __init__(self, events: Events, actor: int, least: Array, narrowings: Sequence[Narrowing]) -> None:
        self.instants = events.instants_of(actor)
        self.bounds = _bounds_of(events.law_of(actor))  # where nothing is narrower
        self.narrowings = [(each, _bounds_of(each.law)) for each in narrowings]
        self.before = least[np.ix_(self.instants, self.instants)] >= 0.0  # which certainly come before which
        times = [events.times[instant] for instant in self.instants]
        one = len(events.unknowns)  # behind all of them
        self.time = np.array([time.number if time.constant is None else one for time in times])
        self.time_factor = np.array([1.0 if time.constant is None else float(time.constant) for time in times])
        states = [events.state(actor, instant) for instant in self.instants]
        self.place = np.array([state.place.number for state in states])
        self.speed = np.array([state.speed.number for state in states])

    def sorted(self, point: Array) -> list[int]:
        """Return positions in the order of time; what is certain of their order stays."""
        times = self.time_factor * point[self.time]
        latest = np.where(self.before, times[:, None], -np.inf).max(axis=0)
        rank = self.before.sum(axis=0)
        return sorted(range(len(times)), key=lambda k: (latest[k], rank[k], k))

    def stretches(self, point: Array) -> tuple[NDArray[np.intp], Array, Array, NDArray[np.bool_]]:
        """Return what lies between neighbours: numbers of unknowns at both ends, factors of times, bounds, one rate.

        Rows are both speeds, times and places, the later one first but for speeds; and the times' factors.
        """
        order = self.sorted(point)
        early, late = order[:-1], order[1:]
        ends = [self.speed[early], self.speed[late], self.time[late], self.time[early]]
        columns = np.array([*ends, self.place[late], self.place[early]])
        factors = np.array([self.time_factor[late], self.time_factor[early]])
        return columns, factors, *self.bounds_between(order, point)

    def bounds_between(self, order: Sequence[int], point: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Return the bounds of the law between each two neighbours (see `_conditions`), and where there is one rate.

        What ends at a place that is passed when it begins, or begins at one that is passed never, narrows nothing.
        """
        where, place = {self.instants[k]: number for number, k in enumerate(order)}, point[self.place]
        bounds, even = np.tile(self.bounds[:, None], len(order) - 1), np.zeros(len(order) - 1, dtype=bool)
        for narrowing, narrower in self.narrowings:
            begin = max(where[instant] for instant in narrowing.begins())
            end = min(where[instant] for instant in narrowing.ends())
            edge = where[narrowing.first if narrowing.up_to_place else narrowing.last]
            past = place[order[edge]] > float(narrowing.place_m) - _CLEAR
            if narrowing.place is not None and past == narrowing.up_to_place:
                continue
            even[begin:end] |= narrowing.even
            lows, highs = bounds[::2, begin:end], bounds[1::2, begin:end]
            np.maximum(lows, narrower[::2, None], out=lows)
            np.minimum(highs, narrower[1::2, None], out=highs)
        return bounds, even


def _bounds_of(law: Law) -> Array:
    return np.array([float(each) for each in (law.rate_low, law.rate_high, law.speed_low, law.speed_high)])


def _laws(lines: Iterable[_Line], point: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Return the laws between neighbours on all lines: levels, slopes by all unknowns, and which are equal."""
    found = zip(*(line.stretches(point) for line in lines), strict=True)
    columns, (to, since), bounds, even = (np.concatenate(each, axis=-1) for each in found)
    first, second, late, early, there, here = point[columns]
    levels, slopes, equal, keep = _conditions(
        bounds, even, np.array([first, second, to * late - since * early, there - here])
    )
    rows, pair = np.zeros((*levels.shape, len(point))), np.arange(len(even))
    g1, g2, gd, gx = np.moveaxis(slopes, 1, 0)
    for column, slope in zip(columns, (g1, g2, gd * to, -gd * since, gx, -gx), strict=True):
        rows[:, pair, column] += slope
    return levels[keep], rows[keep], np.repeat(equal, len(even)).reshape(keep.shape)[keep]


def _conditions(
    laws: Array, even: NDArray[np.bool_], ends: Array
) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.bool_]]:
    """Return levels and slopes of `motion.laws.reach` for many stretches at once.

    All of it is of second degree, so half the difference over one unit either way is a slope, exactly.

    Parameters
    ----------
    laws, ends
        Least and greatest rate, lowest and top speed; first and second speed, duration, distance: shape (4, stretches).

    Returns
    -------
    levels, slopes
        Shape (rows, stretches), at most zero, or zero where equal; shape (rows, 4, stretches).
    equal, keep
        Which are equalities; which there are at all.
    """
    (al, be, lo, hi), (v1, v2, d, x) = laws, ends[:, None, :] + _EITHER_WAY
    free, always = be - al > 1e-12, np.ones_like(even)
    one_rate, one = fixed(al, v1, v2, d, x)
    equal = [(one_rate, ~free), (one, ~free | even)]
    rows = [(row, free) for row in bounded(al, be, lo, hi, v1, v2, d, x)]
    rows += [(row, always) for row in (-d, v1 - hi, lo - v1, v2 - hi, lo - v2)]
    pairs: Array = np.array(capped(al, be, lo, hi, v1, v2, d, x))
    sizes = np.sqrt(np.sum((_slopes(pairs) * _ENDS[:, None]) ** 2, axis=-2))
    for pair, (first, second) in zip(pairs, pairs[:, :, 0] / np.maximum(sizes, 1e-9), strict=True):
        rows.append((np.where(first <= second, *pair), free & (al < 0) & (be > 0)))
    values = np.array([row for row, _ in (*equal, *rows)])
    keep = np.array([there for _, there in (*equal, *rows)])
    return values[:, 0], _slopes(values), np.repeat([True, False], (len(equal), len(rows))), keep


def _slopes(values: Array) -> Array:
    half: Array = 0.5 * (values[..., 1:5, :] - values[..., 5:, :])
    return half
