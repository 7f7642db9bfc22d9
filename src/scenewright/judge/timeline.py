"""One actor's motion as functions of continuous time, for whole arrays of instants at once.

What enters: an `ActorTrace`. What leaves: position, speed and acceleration at any instants, crossings and spans of
samples. It repeats the trace's own interpolation in a form made for searching, and adds the kinks of speed that the
stated accelerations show.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scenewright.judge.tolerance import FloatArray, Values
from scenewright.trace.model import ActorTrace


@dataclass(frozen=True, slots=True, eq=False)
class Timeline:
    """Arc length (m), speed (m/s) and acceleration (m/s^2) of one actor over time (s)."""

    states: ActorTrace

    @property
    def time_s(self) -> FloatArray:
        """The instants of the samples."""
        return self.states.time_s

    @property
    def start_s(self) -> float:
        """The first instant."""
        return float(self.time_s[0])

    @property
    def end_s(self) -> float:
        """The last instant."""
        return float(self.time_s[-1])

    def position(self, time_s: Values) -> FloatArray:
        """Return the arc length at each instant; beyond the ends the first or last one."""
        times, s, v = self.time_s, self.states.s_m, self.states.speed_mps
        at = np.clip(np.asarray(time_s, dtype=np.float64), times[0], times[-1])
        if len(times) == 1:
            return np.full_like(at, s[0])
        index = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
        width = times[index + 1] - times[index]
        u = (at - times[index]) / width
        v0, v1, rise = v[index] * width, v[index + 1] * width, s[index + 1] - s[index]
        result: FloatArray = s[index] + u * (v0 + u * ((3 * rise - 2 * v0 - v1) + u * (v0 + v1 - 2 * rise)))
        return result

    def speed(self, time_s: Values) -> FloatArray:
        """Return the speed at each instant: linear between samples, or with a kink where a piece ends between them."""
        return self._bent(time_s)[0]

    def acceleration(self, time_s: Values) -> FloatArray:
        """Return the acceleration at each instant: that of its sample interval, behind a kink that of the next."""
        return self._bent(time_s)[1]

    def _bent(self, time_s: Values) -> tuple[FloatArray, FloatArray]:
        states, times = self.states, self.time_s
        at = np.clip(np.asarray(time_s, dtype=np.float64), times[0], times[-1])
        if len(times) == 1:
            return np.full_like(at, states.speed_mps[0]), np.full_like(at, states.accel_mps2[0])
        index = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
        since, left = at - times[index], times[index + 1] - at
        a0, a1 = states.accel_mps2[index], states.accel_mps2[index + 1]
        before, after = states.speed_mps[index] + a0 * since, states.speed_mps[index + 1] - a1 * left
        rise = (states.speed_mps[index + 1] - states.speed_mps[index]) / (since + left)
        # Mean acceleration between the two stated ones: the one gave way to the other where their lines of speed meet.
        kinked = (rise - a0) * (a1 - rise) > 0
        behind = kinked & ((before - after) * (a0 - a1) >= 0)
        speed = np.where(kinked, np.where(behind, after, before), np.interp(at, times, states.speed_mps))
        return speed, np.where(behind | (left <= 0), a1, a0)

    def slopes(self) -> FloatArray:
        """Return the mean acceleration of each sample interval, from speeds alone, shape (N - 1,)."""
        return np.asarray(np.diff(self.states.speed_mps) / np.diff(self.time_s), dtype=np.float64)

    def instants(self, start_s: float, end_s: float, parts: int = 4) -> FloatArray:
        """Return both ends, all samples between them and `parts - 1` instants inside each sample interval."""
        start, end = max(start_s, self.start_s), min(max(end_s, start_s), self.end_s)
        times = self.time_s
        steps = np.arange(parts) / parts
        dense = np.append((times[:-1, None] + np.diff(times)[:, None] * steps).ravel(), times[-1])
        inside = dense[(dense > start) & (dense < end)]
        return np.unique(np.concatenate(([start], inside, [max(end, start)])))
