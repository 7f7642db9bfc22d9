"""Phases of one actor's motion, read from its speeds: it begins to brake or speed up, stands still, moves off again.

What enters: a `Timeline`, where to look, and the `Manner` that says what counts. What leaves: instants between samples.
It knows nothing else of programs: what a phase should have been is asked elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scenewright.judge.timeline import Timeline
from scenewright.judge.tolerance import FloatArray
from scenewright.program.manner import Manner

Sign = Literal[-1, 1]
BRAKING: Sign = -1
SPEEDING_UP: Sign = 1

# How sampled speeds are read; what the words mean is in the manner.
_REST_MPS = 0.005  # no motion but rounding: the instant of a stop is looked for where the speed first is that small
_JOIN_S = 0.1  # a shorter pause does not end a phase
_AFTER_S = 0.05  # a phase that has ended by now was not begun by what happens now


@dataclass(frozen=True, slots=True)
class Phase:
    """A stretch of braking or speeding up: when it began and ended (s)."""

    start_s: float
    end_s: float


@dataclass(frozen=True, slots=True)
class Rest:
    """A stretch of standing still: since when, until when (s); `end_s` is the end of the run where it lasts."""

    start_s: float
    end_s: float


def phase_at(timeline: Timeline, moment_s: float, sign: Sign, manner: Manner) -> Phase | None:
    """Return the first phase of that sign that is still on, or begins, after `moment_s`.

    It begins where the acceleration first exceeds `manner.begins_mpss`, or half of what the phase reaches where that is
    less, and stays there; the instant is found between samples, where the two straight lines of speed meet.
    """
    pull = sign * timeline.slopes()
    times = timeline.time_s
    found: list[tuple[int, int]] = []
    for first, last in _runs(pull > float(manner.faint_mpss), times):
        threshold = min(float(manner.begins_mpss), 0.5 * float(np.max(pull[first : last + 1])))
        strong = np.zeros(len(pull), dtype=bool)
        strong[first : last + 1] = pull[first : last + 1] > threshold
        found += [run for run in _runs(strong, times) if times[run[1] + 1] > moment_s + _AFTER_S]
    lasting = [run for run in found if _lasts(timeline, run, manner)]
    if not found:
        return None
    first, last = (lasting or found)[0]
    return Phase(_meeting(timeline, pull * sign, first, last), float(times[last + 1]))


def rest_after(timeline: Timeline, moment_s: float, manner: Manner) -> Rest | None:
    """Return the first standstill (slower than `manner.stands_mps`) at or after `moment_s`, or None."""
    times, speeds = timeline.time_s, timeline.states.speed_mps
    still = (np.abs(speeds) < float(manner.stands_mps)) & (times >= moment_s)
    if not still.any():
        return None
    first = int(np.argmax(still))
    moving = np.flatnonzero(~still[first:])
    last = first + int(moving[0]) - 1 if len(moving) else len(times) - 1
    span = np.abs(speeds[first : last + 1])
    at_rest = np.flatnonzero(span <= _REST_MPS)
    index = first + int(at_rest[0] if len(at_rest) else np.argmin(span))
    return Rest(max(_stop_before(timeline, index), moment_s), float(times[last]))


def move_off_after(timeline: Timeline, moment_s: float, manner: Manner) -> float | None:
    """Return the instant after `moment_s` at which a standing actor begins to move, or None where it does not."""
    times, speeds = timeline.time_s, timeline.states.speed_mps
    moving = np.flatnonzero((speeds > float(manner.stands_mps)) & (times > moment_s))
    if not len(moving):
        return None
    resting = np.flatnonzero((speeds[: moving[0]] <= _REST_MPS) & (times[: moving[0]] >= moment_s))
    if not len(resting):
        return float(times[moving[0]])
    index = int(resting[-1])
    slope = timeline.slopes()[min(index + 1, len(times) - 2)]
    if slope <= 0:
        return float(times[index])
    return float(np.clip(times[index + 1] - speeds[index + 1] / slope, times[index], times[index + 1]))


def _runs(mask: NDArray[np.bool_], times: FloatArray) -> list[tuple[int, int]]:
    """Return first and last interval of each stretch of true intervals, short pauses bridged."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], mask.astype(int), [0]))))
    runs: list[tuple[int, int]] = []
    for first, behind in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        if runs and times[first] - times[runs[-1][1] + 1] < _JOIN_S:
            runs[-1] = (runs[-1][0], behind - 1)
        else:
            runs.append((first, behind - 1))
    return runs


def _lasts(timeline: Timeline, run: tuple[int, int], manner: Manner) -> bool:
    first, last = run
    times = timeline.time_s
    to_the_end = last + 2 >= len(times) or abs(timeline.states.speed_mps[last + 1]) < float(manner.stands_mps)
    return bool(times[last + 1] - times[first] >= float(manner.begins_s) or to_the_end)


def _meeting(timeline: Timeline, slopes: FloatArray, first: int, last: int) -> float:
    """Return where the line of speed before interval `first` meets the line after it."""
    times, speeds = timeline.time_s, timeline.states.speed_mps
    if first == 0:
        return float(times[0])
    before = slopes[first - 2] if first >= 2 else 0.0
    inner = min(first + 1, last)
    after, t0, t1 = slopes[inner], times[first - 1], times[inner]
    if abs(after - before) < 1e-9:
        return float(times[first])
    meeting = (speeds[first - 1] - speeds[inner] + after * t1 - before * t0) / (after - before)
    return float(np.clip(meeting, t0, times[first + 1]))


def _stop_before(timeline: Timeline, index: int) -> float:
    """Return the instant within the interval before sample `index` at which the speed ran out."""
    times, speeds = timeline.time_s, timeline.states.speed_mps
    if index < 2 or abs(speeds[index]) > _REST_MPS:
        return float(times[index])
    slope = timeline.slopes()[index - 2]
    if slope >= 0:
        return float(times[index])
    return float(np.clip(times[index - 1] - speeds[index - 1] / slope, times[index - 1], times[index]))
