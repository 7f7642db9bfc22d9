"""Post-encroachment time: how soon after one body has left a place another one's covers it.

What enters: the traces of two actors and their boxes. What leaves: one number. It rests on where the bodies were, so
that ways may cross at any angle, bend and merge; no place of the map is asked for. It is for two that never collide.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from scenewright.judge.boxes import MovingBox, moving_box, overlapping, reach_m
from scenewright.judge.case import Box
from scenewright.judge.tolerance import FloatArray
from scenewright.trace.model import ActorTrace

_ONE_LINE_M, _ONE_WAY_RAD = 0.1, 0.2  # lines that merge are further apart and askew a vehicle's length before they do
_STANDS_M = 1e-6
_BLOCK, _BLOCKS_AT_ONCE, _PAIRS_AT_ONCE = 32, 64, 4096
_PARTS, _ROUNDS = 8, 6  # instants for each sample, and halvings of two samples: to a few milliseconds

Index = NDArray[np.intp]


def post_encroachment_s(a: ActorTrace, b: ActorTrace, boxes: tuple[Box, Box]) -> float | None:
    """Return the least time (s) between one body being at a place and the other's covering some of it.

    It is the least ``|t - u|`` at which the box of one at `t` and that of the other at `u` overlap: where ways cross
    at a right angle, the time from the one leaving the square that both cover to the other entering it; where they
    merge, the least time gap from there on. None where no place was covered by both, and for two that come along one
    lane: there one follows the other, and passes nobody.
    """
    body_a, body_b = _moving(a, boxes[0]), _moving(b, boxes[1])
    blocks = _near_blocks(*body_a, *body_b)
    if not len(blocks[0]) or _begins_in_lane(a, b, reach_m(*boxes)) or _begins_in_lane(b, a, reach_m(*boxes)):
        return None
    found = _soonest(body_a, body_b, blocks)
    return None if found is None else _refined(a, b, boxes, found)


def _moving(states: ActorTrace, box: Box) -> tuple[FloatArray, MovingBox]:
    """Return the samples, of a standstill only the first and the last: in between the same place is covered."""
    goes = np.hypot(np.diff(states.x_m), np.diff(states.y_m)) + np.abs(np.diff(states.heading_rad)) > _STANDS_M
    times = states.time_s[np.append(True, goes) | np.append(goes, True)]
    return times, moving_box(states, box, times)


def _near_blocks(
    times_a: FloatArray, body_a: MovingBox, times_b: FloatArray, body_b: MovingBox
) -> tuple[Index, Index, FloatArray]:
    """Return pairs of blocks of samples with boxes that might overlap, and how far apart in time, in that order."""
    reach = reach_m(body_a.box, body_b.box)
    apart_m = [_between(getattr(body_a, axis), getattr(body_b, axis)) for axis in ("x_m", "y_m")]
    apart_s = _between(times_a, times_b)
    first, second = np.nonzero(np.hypot(*apart_m) <= reach)
    order = np.argsort(apart_s[first, second], kind="stable")
    return first[order], second[order], apart_s[first, second][order]


def _between(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return how far the values of each block of one are from those of each block of the other, at least."""
    (low_a, high_a), (low_b, high_b) = (
        (np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts))
        for values, starts in ((each, np.arange(0, len(each), _BLOCK)) for each in (a, b))
    )
    between: FloatArray = np.maximum(low_b[None, :] - high_a[:, None], low_a[:, None] - high_b[None, :])
    return np.maximum(between, 0.0)


def _soonest(
    a: tuple[FloatArray, MovingBox],
    b: tuple[FloatArray, MovingBox],
    blocks: tuple[Index, Index, FloatArray],
) -> float | None:
    """Return the least time between samples of which the boxes overlap: how much later (s) that of the second is."""
    (times_a, body_a), (times_b, body_b) = a, b
    reach, best_s, best = reach_m(body_a.box, body_b.box), np.inf, None
    for first, second, least_s in _batches(blocks):
        if least_s >= best_s:
            break
        i, j = _samples(first, second, len(times_a), len(times_b))
        apart_s = np.abs(times_a[i] - times_b[j])
        near = np.hypot(body_a.x_m[i] - body_b.x_m[j], body_a.y_m[i] - body_b.y_m[j]) <= reach
        near &= apart_s < best_s
        i, j, apart_s = i[near], j[near], apart_s[near]
        order = np.argsort(apart_s, kind="stable")
        for start in range(0, len(order), _PAIRS_AT_ONCE):
            some = order[start : start + _PAIRS_AT_ONCE]
            touch = np.flatnonzero(overlapping(body_a.at(i[some]), body_b.at(j[some])))
            if len(touch):
                at = some[touch[0]]
                best_s, best = float(apart_s[at]), float(times_b[j[at]] - times_a[i[at]])
                break
    return best


def _batches(blocks: tuple[Index, Index, FloatArray]) -> Iterator[tuple[Index, Index, float]]:
    for start in range(0, len(blocks[0]), _BLOCKS_AT_ONCE):
        some = slice(start, start + _BLOCKS_AT_ONCE)
        yield blocks[0][some], blocks[1][some], float(blocks[2][start])


def _samples(first: Index, second: Index, count_a: int, count_b: int) -> tuple[Index, Index]:
    """Return all pairs of samples of pairs of blocks."""
    inside = np.arange(_BLOCK)
    i = np.repeat(first[:, None] * _BLOCK + inside, _BLOCK, axis=1).ravel()
    j = np.tile(second[:, None] * _BLOCK + inside, _BLOCK).ravel()
    real = (i < count_a) & (j < count_b)  # the last block may be shorter
    return i[real], j[real]


def _refined(a: ActorTrace, b: ActorTrace, boxes: tuple[Box, Box], later_s: float) -> float:
    """Return by how little less the second may be later for the boxes to overlap still, between the samples too."""
    times, step_s = a.time_s, float(np.max(np.diff(a.time_s), initial=0.0))

    def both(at_s: FloatArray, by_s: float) -> tuple[MovingBox, MovingBox]:
        return moving_box(a, boxes[0], at_s), moving_box(b, boxes[1], at_s + by_s)

    one, other = both(times, later_s)
    near = np.hypot(one.x_m - other.x_m, one.y_m - other.y_m) <= 2.0 * reach_m(*boxes)
    at_s = (times[near, None] + step_s * np.arange(_PARTS) / _PARTS).ravel()
    way, low, high = np.sign(later_s), max(0.0, abs(later_s) - 2.0 * step_s), abs(later_s)
    for _ in range(_ROUNDS):
        middle = 0.5 * (low + high)
        seen = at_s[(at_s <= times[-1]) & (at_s + way * middle >= times[0]) & (at_s + way * middle <= times[-1])]
        low, high = (low, middle) if overlapping(*both(seen, way * middle)).any() else (middle, high)
    return high


def _begins_in_lane(own: ActorTrace, other: ActorTrace, reach: float) -> bool:
    """Whether one begins on the line of the other's route, headed along it, where the other is at some time.

    A body's reach before and behind counts, too: who stops short of where the other began was at its place.
    """
    places, start = _line(other), _line(own)[0]
    before = np.linspace(places[0] - reach * _ahead(places[0]), places[0], 32)
    behind = np.linspace(places[-1], places[-1] + reach * _ahead(places[-1]), 32)
    line = np.vstack([before, places, behind])
    from_m = start[:2] - line[:-1, :2]
    steps = np.diff(line[:, :2], axis=0)
    share = np.clip((from_m * steps).sum(1) / np.maximum((steps * steps).sum(1), _STANDS_M**2), 0.0, 1.0)
    beside_m = np.hypot(*(from_m - share[:, None] * steps).T)
    return bool(np.any((beside_m <= _ONE_LINE_M) & (np.cos(start[2] - line[:-1, 2]) >= np.cos(_ONE_WAY_RAD))))


def _line(states: ActorTrace) -> FloatArray:
    """Return places and headings (N, 3) of the line of an actor's route: it may drive beside it."""
    x, y, heading, d = states.x_m, states.y_m, states.heading_rad, states.d_m
    return np.column_stack([x + d * np.sin(heading), y - d * np.cos(heading), heading])


def _ahead(pose: FloatArray) -> FloatArray:
    return np.array([np.cos(pose[2]), np.sin(pose[2]), 0.0])
