"""One hero's motion from now on as a function of unknowns: accelerations at nodes, times of knots, perhaps a start.

What enters: legs, each a stretch of one piece between two instants. What leaves: states at nodes and at any instant,
with their derivatives, and the motion as a `Profile`. Speed and place are exact integrals: whatever the unknowns are,
the motion is one that can be driven.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.limits import BRAKE_MAX_MPSS
from scenewright.motion.profile import Profile, Segment
from scenewright.program.types import PieceKind

Array = NDArray[np.float64]
Columns = NDArray[np.intp]

_HARDLY_MPS = 0.05  # by how much less than standing is a matter of rounding


@dataclass(frozen=True, slots=True)
class Quantity:
    """A time, a place or a speed: so much more than an unknown, or than zero where `unknown` is None."""

    constant: float
    unknown: int | None = None

    def value(self, z: Array | Sequence[float]) -> float:
        """Return how much it is (SI)."""
        return self.constant + (0.0 if self.unknown is None else float(z[self.unknown]))

    def slope(self, size: int) -> Array:
        """Return its derivative by all of so many unknowns."""
        slope = np.zeros(size)
        if self.unknown is not None:
            slope[self.unknown] = 1.0
        return slope


Start = tuple[Quantity, Quantity]  # the place (m) and the speed (m/s) that a motion begins with


@dataclass(frozen=True, slots=True)
class Leg:
    """A stretch of piece `piece`, in `cells` equal parts; its accelerations are unknowns, none where it stands.

    Within a cell the acceleration changes evenly; from leg to leg it may jump, unless they share one.
    """

    piece: int
    kind: PieceKind
    first: Quantity
    last: Quantity
    cells: int
    accels: tuple[int, ...]


@dataclass(slots=True)
class Shot:
    """A motion with its derivatives by all unknowns: one row of `d_...` for each node."""

    legs: Sequence[Leg]
    time: Array
    s: Array
    v: Array
    accel: Array  # that which begins at a node
    accel_after: Array  # that at the end of the cell that begins at a node
    d_time: Array
    d_s: Array
    d_v: Array
    first_node: list[int]  # of each leg; the last is that behind all legs
    driven: tuple[Columns, Columns, Columns]  # cells of legs with accelerations, and which they begin and end with
    z: Array

    def at_node(self, node: int) -> tuple[float, float, Array, Array]:
        """Return place and speed at a node, and their derivatives."""
        return float(self.s[node]), float(self.v[node]), self.d_s[node], self.d_v[node]

    def at(self, time_s: float, d_time: Array) -> tuple[float, float, Array, Array]:
        """Return place and speed at an instant, and their derivatives."""
        (place,), (speed,), (rate,), (d_place,), (d_speed,) = self.along(np.array([time_s]))
        return float(place), float(speed), d_place + speed * d_time, d_speed + rate * d_time

    def along(self, times: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Return places, speeds and rates at times that nothing moves.

        And the derivatives of places and speeds, a row for each.
        """
        last = len(self.time) - 1
        node = np.clip(np.searchsorted(self.time, times, side="right") - 1, 0, last)
        behind, beyond = np.minimum(node + 1, last), node == last
        since = times - self.time[node]
        lasts = np.where(beyond, 1.0, np.maximum(self.time[behind] - self.time[node], 1e-6))
        a, b = np.where(beyond, 0.0, self.accel[node]), np.where(beyond, 0.0, self.accel_after[node])
        jerk, d_time, d_lasts = (b - a) / lasts, self.d_time[node], self.d_time[behind] - self.d_time[node]
        rate, speed = a + jerk * since, self.v[node] + (a + 0.5 * jerk * since) * since
        place = self.s[node] + (self.v[node] + (0.5 * a + jerk * since / 6.0) * since) * since
        to_speed, to_place = 0.5 * since**2 / lasts, since**3 / 6.0 / lasts  # of a unit of the rate that it comes to
        d_speed = self.d_v[node] - rate[:, None] * d_time - (to_speed * jerk)[:, None] * d_lasts
        d_place = self.d_s[node] + since[:, None] * self.d_v[node]
        d_place += -speed[:, None] * d_time - (to_place * jerk)[:, None] * d_lasts
        cells, one, other = self.driven
        number = np.minimum(np.searchsorted(cells, node), len(cells) - 1)
        here = np.flatnonzero(cells[number] == node) if len(cells) else node[:0]
        first, second = one[number[here]], other[number[here]]
        d_speed[here, first] += since[here] - to_speed[here]
        d_speed[here, second] += to_speed[here]
        d_place[here, first] += 0.5 * since[here] ** 2 - to_place[here]
        d_place[here, second] += to_place[here]
        return place, speed, rate, d_place, d_speed

    def stands_for(self, nodes: slice) -> tuple[Array, Array]:
        """Return the time (s) that each of some nodes stands for, half of that to its neighbours, and its slopes."""
        both = self.time[nodes], self.d_time[nodes]
        lasts_s, d_lasts = (
            0.5 * (np.diff(each, axis=0, prepend=each[:1]) + np.diff(each, axis=0, append=each[-1:])) for each in both
        )
        return np.maximum(lasts_s, 1e-6), d_lasts

    def rate_at(self, time_s: float, before: bool) -> tuple[float, Array]:
        """Return the acceleration at an instant, that which begins there or that `before` it, with its derivatives."""
        last = len(self.time) - 1
        behind = np.searchsorted(self.time, time_s - 1e-9 if before else time_s + 1e-9, side="right")
        node = min(max(int(behind) - 1, 0), last)
        if node == last:
            return 0.0, np.zeros(len(self.z))
        lasts = max(float(self.time[node + 1] - self.time[node]), 1e-6)
        share = min(max((time_s - float(self.time[node])) / lasts, 0.0), 1.0)
        d_rate, (cells, one, other) = np.zeros(len(self.z)), self.driven
        d_rate[one[cells == node]] += 1.0 - share
        d_rate[other[cells == node]] += share
        return (1.0 - share) * float(self.accel[node]) + share * float(self.accel_after[node]), d_rate


def shoot(legs: Sequence[Leg], start: Start, z: Array) -> Shot:
    """Return the motion that the unknowns `z` stand for."""
    counts = np.array([leg.cells for leg in legs])
    first_node = [0, *np.cumsum(counts).tolist()]
    driven = [leg.accels for leg in legs if leg.accels]
    cells = np.flatnonzero(np.repeat([bool(leg.accels) for leg in legs], counts))
    one, other = (np.array([a for each in driven for a in each[k : len(each) - 1 + k]], dtype=np.intp) for k in (0, 1))
    nodes, size = first_node[-1] + 1, len(z)
    s, v, accel, after = np.zeros((4, nodes))
    d_s, d_v = np.zeros((2, nodes, size))
    place, speed = start
    s[0], d_s[0], v[0], d_v[0] = place.value(z), place.slope(size), speed.value(z), speed.slope(size)
    accel[cells], after[cells] = z[one], z[other]
    ends = np.array([[leg.first.value(z), leg.last.value(z)] for leg in legs])
    d_ends = np.array([[leg.first.slope(size) for leg in legs], [leg.last.slope(size) for leg in legs]])
    of_leg = np.repeat(np.arange(len(legs)), counts)
    lasts, d_lasts = ((ends[:, 1] - ends[:, 0]) / counts)[of_leg], ((d_ends[1] - d_ends[0]) / counts[:, None])[of_leg]
    since = np.arange(nodes - 1) - np.repeat(first_node[:-1], counts)
    time = np.append(ends[of_leg, 0] + since * lasts, ends[-1, 1])
    d_time = np.concatenate([d_ends[0, of_leg] + since[:, None] * d_lasts, d_ends[1, -1:]])
    mean, way = 0.5 * (accel + after)[:-1], (2.0 * accel + after)[:-1] / 6.0
    more = mean[:, None] * d_lasts
    more[cells, one] += 0.5 * lasts[cells]
    more[cells, other] += 0.5 * lasts[cells]
    v[1:], d_v[1:] = lasts * mean, more
    v, d_v = np.cumsum(v), np.cumsum(d_v, axis=0)
    more = lasts[:, None] * d_v[:-1] + (v[:-1] + 2.0 * way * lasts)[:, None] * d_lasts
    more[cells, one] += lasts[cells] ** 2 / 3.0
    more[cells, other] += lasts[cells] ** 2 / 6.0
    s[1:], d_s[1:] = (v[:-1] + way * lasts) * lasts, more
    s, d_s = np.cumsum(s), np.cumsum(d_s, axis=0)
    return Shot(legs, time, s, v, accel, after, d_time, d_s, d_v, first_node, (cells, one, other), z)


def profile_of(shot: Shot, knots_s: dict[str, float], past: Sequence[Segment]) -> Profile:
    """Return a motion, with what was driven before it, as a profile. Who stands does so exactly."""
    segments = list(past)
    s, v = float(shot.s[0]), max(0.0, float(shot.v[0]))
    for number, leg in enumerate(shot.legs):
        for node in range(shot.first_node[number], shot.first_node[number + 1]):
            lasts = float(shot.time[node + 1] - shot.time[node])
            if lasts <= 1e-9:
                continue
            begin, a, b = float(shot.time[node]), float(shot.accel[node]), float(shot.accel_after[node])
            if not leg.accels and v <= _HARDLY_MPS:
                v = 0.0
            elif not leg.accels:  # it is not yet slow enough, and nobody stands from one moment to the next
                a = b = -BRAKE_MAX_MPSS
            for segment in _forwards(begin, lasts, s, v, a, b, leg.piece):
                segments.append(segment)
                s, v = segment.end_s_m, segment.end_speed_mps
    return Profile(tuple(segments), knots_s)


def _forwards(begin_s: float, lasts_s: float, s_m: float, v: float, a: float, b: float, piece: int) -> list[Segment]:
    """Return one cell as segments; where rounding would have it roll back it stands instead."""
    lowest = v + 0.5 * (a + b) * lasts_s
    if -_HARDLY_MPS < lowest < 0.0 and b <= 0.0:  # it comes to stand at the end, not a moment before
        b, lowest = -2.0 * v / lasts_s - a, 0.0
    segment = Segment(begin_s, lasts_s, s_m, v, a, piece, (b - a) / lasts_s)
    if a < 0.0 < b:
        lowest = min(lowest, v - 0.5 * a * a * lasts_s / (b - a))
    if lowest >= -1e-9:
        return [segment]
    # Between the two instants at which its speed would be zero it stands; behind the second it drives on as it would.
    root = max(0.0, a * a - 2.0 * segment.jerk_mpsss * v) ** 0.5
    stops_s = -(a + root) / segment.jerk_mpsss if a > 0.0 else 2.0 * v / max(root - a, 1e-12)
    goes_s = min((root - a) / segment.jerk_mpsss, lasts_s) if segment.jerk_mpsss > 0.0 else lasts_s
    stopped = segment.part(begin_s, begin_s + stops_s)
    stands = Segment(begin_s + stops_s, goes_s - stops_s, stopped.end_s_m, 0.0, 0.0, piece)
    rate = a + segment.jerk_mpsss * goes_s
    goes = Segment(begin_s + goes_s, lasts_s - goes_s, stopped.end_s_m, 0.0, rate, piece, segment.jerk_mpsss)
    return [each for each in (stopped, stands, goes) if each.duration_s > 0.0]
