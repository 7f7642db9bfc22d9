"""States of all actors over time, as they really happened.

What enters: arrays sampled on one time axis. What leaves: a `Trace` that can be asked for a state at any instant
between its first and last sample. It knows nothing of plans; reading and writing files is in `trace.files`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class ActorState(NamedTuple):
    """One actor at one instant, as it really was.

    Position and heading of its box's centre in the map's frame, speed and acceleration along its heading, arc length on
    its route and offset from it, left positive. The acceleration is the one from now on where that is known, else that
    of the last step.
    """

    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    accel_mps2: float
    s_m: float
    d_m: float


COLUMNS = ActorState._fields


@dataclass(frozen=True, slots=True, eq=False)
class ActorTrace:
    """One actor's samples; all arrays have the shape of the trace's ``time_s``. Equal where all samples are.

    ``s_m`` is arc length along the actor's own route, ``d_m`` lateral offset (left positive), ``accel_mps2`` the
    acceleration that starts at the sample (right-continuous).
    """

    time_s: FloatArray
    x_m: FloatArray
    y_m: FloatArray
    heading_rad: FloatArray
    speed_mps: FloatArray
    accel_mps2: FloatArray
    s_m: FloatArray
    d_m: FloatArray

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ActorTrace):
            return NotImplemented
        return all(np.array_equal(getattr(self, each.name), getattr(other, each.name)) for each in fields(self))

    def __hash__(self) -> int:
        return hash(len(self.time_s))

    def position(self, time_s: float) -> float:
        """Return the arc length (m) at any instant: cubic Hermite between samples, exact for constant acceleration."""
        return self._hermite(time_s)[0]

    def speed(self, time_s: float) -> float:
        """Return the speed along the route (m/s) at any instant, linear between samples."""
        return float(np.interp(time_s, self.time_s, self.speed_mps))

    def acceleration(self, time_s: float) -> float:
        """Return the acceleration (m/s^2) of the sample interval that holds `time_s`."""
        index = int(np.searchsorted(self.time_s, time_s, side="right")) - 1
        return float(self.accel_mps2[min(max(index, 0), len(self.time_s) - 1)])

    def _hermite(self, time_s: float) -> tuple[float, float]:
        times = self.time_s
        if len(times) == 1 or time_s <= times[0]:
            return float(self.s_m[0]), float(self.speed_mps[0])
        if time_s >= times[-1]:
            return float(self.s_m[-1]), float(self.speed_mps[-1])
        index = int(np.searchsorted(times, time_s, side="right")) - 1
        width = float(times[index + 1] - times[index])
        u = (time_s - float(times[index])) / width
        s0, s1 = float(self.s_m[index]), float(self.s_m[index + 1])
        v0, v1 = float(self.speed_mps[index]) * width, float(self.speed_mps[index + 1]) * width
        rise = s1 - s0
        position = s0 + u * (v0 + u * ((3 * rise - 2 * v0 - v1) + u * (v0 + v1 - 2 * rise)))
        return position, (v0 + u * (2 * (3 * rise - 2 * v0 - v1) + 3 * u * (v0 + v1 - 2 * rise))) / width


@dataclass(frozen=True, slots=True)
class Trace:
    """What happened: samples of every actor, keyed by actor name, on one shared time axis."""

    actors: Mapping[str, ActorTrace]

    def __post_init__(self) -> None:
        lengths = {len(actor.time_s) for actor in self.actors.values()}
        if len(lengths) > 1 or 0 in lengths:
            raise ValueError("all actors of a trace share one non-empty time axis")

    @property
    def time_s(self) -> FloatArray:
        """The time axis (s), increasing, shape (N,)."""
        return next(iter(self.actors.values())).time_s

    @property
    def duration_s(self) -> float:
        """Time of the last sample (s)."""
        return float(self.time_s[-1])
