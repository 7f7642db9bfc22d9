"""What one vehicle did, read from its speeds: when it stood, since when it had braked for that, when it sped up.

What enters: the trace of one vehicle. What leaves: instants and measures. It is written apart from the judge's reading
of the same: it begins with what can be seen without doubt, a standstill or a place that is passed, and goes backwards
from there to where that began.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scenewright.trace.model import ActorTrace

FloatArray = NDArray[np.float64]

STILL_MPS = 0.1
LASTING_S = 0.3  # a standstill or a phase that is shorter is none
PLAIN_MPSS = 0.5  # below this a driver only corrects
_FAINT_MPSS = 0.1
_WAVERING_MPS = 1.0
_PAUSE_S = 0.1  # a shorter pause does not end a phase


@dataclass(frozen=True, slots=True)
class Stretch:
    """From when to when (s)."""

    start_s: float
    end_s: float


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """One vehicle's motion along its route."""

    states: ActorTrace

    @property
    def time_s(self) -> FloatArray:
        """The instants of the samples."""
        return self.states.time_s

    @property
    def slopes_mpss(self) -> FloatArray:
        """Mean acceleration of each sample interval, from the speeds."""
        return np.asarray(np.diff(self.states.speed_mps) / np.diff(self.time_s), dtype=np.float64)

    def position_m(self, time_s: FloatArray) -> FloatArray:
        """Return where it was: the speed is taken to be linear between samples."""
        times, speeds = self.time_s, self.states.speed_mps
        index = np.clip(np.searchsorted(times, time_s, side="right") - 1, 0, len(times) - 2)
        since = time_s - times[index]
        way = speeds[index] * since + 0.5 * self.slopes_mpss[index] * since**2
        # What the samples' positions add to the integral of speed is spread evenly over the interval.
        width = times[index + 1] - times[index]
        whole = self.states.s_m[index + 1] - self.states.s_m[index]
        rest = whole - 0.5 * (speeds[index] + speeds[index + 1]) * width
        return np.asarray(self.states.s_m[index] + way + rest * since / width, dtype=np.float64)

    def speed_mps(self, time_s: FloatArray) -> FloatArray:
        """Return how fast it was: linear between samples, with a knee where the slopes on both sides show one.

        A hero that brakes hard loses a tenth of a metre a second between two samples: enough to tilt a time to arrival.
        """
        times, speeds, slopes = self.time_s, self.states.speed_mps, self.slopes_mpss
        index = np.clip(np.searchsorted(times, time_s, side="right") - 1, 0, len(times) - 2)
        own, before, after = (
            slopes[index],
            slopes[np.maximum(index - 1, 0)],
            slopes[np.minimum(index + 1, len(slopes) - 1)],
        )
        first = speeds[index] + before * (time_s - times[index])
        then = speeds[index + 1] - after * (times[index + 1] - time_s)
        bent = (own - before) * (after - own) > 1e-6
        knee = np.where(before > after, np.minimum(first, then), np.maximum(first, then))
        return np.asarray(np.where(bent, knee, np.interp(time_s, times, speeds)), dtype=np.float64)

    def passes_s(self, place_m: float) -> float:
        """Return when it came to a place; infinite where it never did."""
        beyond = np.flatnonzero(self.states.s_m >= place_m)
        if not len(beyond):
            return float("inf")
        index = int(beyond[0])
        if index == 0:
            return float(self.time_s[0])
        instants = np.linspace(self.time_s[index - 1], self.time_s[index], 101)
        return float(np.interp(place_m, self.position_m(instants), instants))

    def rests(self, before_s: float = float("inf")) -> list[Stretch]:
        """Return the standstills that begin before an instant; one that lasts to the end of the trace may be short."""
        still = np.abs(self.states.speed_mps) < STILL_MPS
        rests = []
        for first, last in _runs(still):
            start, end = float(self.time_s[first]), float(self.time_s[last])
            if start < before_s and (end - start >= LASTING_S or last == len(still) - 1):
                rests.append(Stretch(start if first == 0 else self._stopped_s(first, last), end))
        return rests

    def beginnings(self, sign: int, end_s: float) -> list[float]:
        """Return, first to last, the instants at which it may be said to begin what ended at `end_s`.

        From there to the end it brakes (-1) or speeds up (1), but for a wavering that is judged elsewhere. A beginning
        is where the change first exceeds 0.5 m/s^2, or half of the strongest where that is less, and lasts.
        """
        times, speeds = self.time_s, sign * self.states.speed_mps
        behind = int(np.searchsorted(times, end_s))  # the first sample at or after the end
        if behind == 0:
            return []
        behind = min(behind, len(times) - 1)
        least_after = np.minimum.accumulate(speeds[: behind + 1][::-1])[::-1]
        against = np.flatnonzero(speeds[: behind + 1] - least_after > _WAVERING_MPS)
        first = int(against[-1]) + 1 if len(against) else 0
        change = sign * self.slopes_mpss[first:behind]
        if not len(change) or float(change.max()) < _FAINT_MPSS:
            return []
        level = min(PLAIN_MPSS, 0.5 * float(change.max()))
        runs = [(first + a, first + b) for a, b in _bridged(_runs(change > level), times[first:])]
        return [self._knee_s(a) for a, b in runs if times[b + 1] - times[a] >= LASTING_S or b + 1 >= behind]

    def strongest(self, sign: int, start_s: float, end_s: float) -> float:
        """Return the strongest slowing down (-1) or speeding up (1), in m/s^2, of any whole sample interval."""
        times = self.time_s
        inside = (times[:-1] >= start_s - 1e-9) & (times[1:] <= end_s + 1e-9)
        return max(0.0, float(np.max(sign * self.slopes_mpss[inside], initial=0.0)))

    def mean_slowing(self, start_s: float, end_s: float) -> float:
        """Return the mean deceleration (m/s^2) between the first and the last sample of a stretch."""
        inside = np.flatnonzero((self.time_s >= start_s) & (self.time_s <= end_s))
        if len(inside) < 2:
            return 0.0
        first, last = inside[0], inside[-1]
        fell = self.states.speed_mps[first] - self.states.speed_mps[last]
        return float(fell / (self.time_s[last] - self.time_s[first]))

    def against(self, sign: int, start_s: float, end_s: float) -> float:
        """Return by how much (m/s) the speed changed against the sense of a phase, between any two of its instants."""
        inside = (self.time_s >= start_s) & (self.time_s <= end_s)
        speeds = sign * self.states.speed_mps[inside]
        return float(np.max(np.maximum.accumulate(speeds) - speeds, initial=0.0)) if len(speeds) else 0.0

    def _knee_s(self, first: int) -> float:
        """Return where the line of speed before an interval meets the line behind it, found between samples."""
        times, speeds, slopes = self.time_s, self.states.speed_mps, self.slopes_mpss
        if first == 0:
            return float(times[0])
        # The knee lies in this interval or in the one before, which is then too mild to be counted as the beginning.
        before = float(slopes[first - 2]) if first >= 2 else 0.0
        after = float(slopes[min(first + 1, len(slopes) - 1)])
        if abs(after - before) < 1e-9:
            return float(times[first])
        left, right = first - 1, first + 1
        meeting = (speeds[left] - before * times[left] - speeds[right] + after * times[right]) / (after - before)
        return float(np.clip(meeting, times[left], times[right]))

    def _stopped_s(self, first: int, last: int) -> float:
        """Return when the speed ran out: below the level of standing it still falls for a moment."""
        speeds = np.abs(self.states.speed_mps[first : last + 1])
        slope = float(self.slopes_mpss[max(first - 2, 0)])
        lowest = float(speeds.min())
        settled = first + int(np.argmax(speeds <= lowest + 5e-3))
        if slope >= -1e-6 or lowest > 5e-3:
            return float(self.time_s[settled])
        ran_out = float(self.time_s[first - 1]) - float(self.states.speed_mps[first - 1]) / slope
        return float(np.clip(ran_out, self.time_s[first - 1], self.time_s[settled]))


def _runs(mask: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return first and last index of every stretch of true values."""
    padded = np.concatenate(([False], mask, [False]))
    starts, ends = np.flatnonzero(~padded[:-1] & padded[1:]), np.flatnonzero(padded[:-1] & ~padded[1:])
    return [(int(a), int(b) - 1) for a, b in zip(starts, ends, strict=True)]


def _bridged(runs: list[tuple[int, int]], times: FloatArray) -> list[tuple[int, int]]:
    joined: list[tuple[int, int]] = []
    for first, last in runs:
        if joined and times[first] - times[joined[-1][1] + 1] < _PAUSE_S:
            joined[-1] = (joined[-1][0], last)
        else:
            joined.append((first, last))
    return joined
