"""Concrete motion along one axis: what a plan or a prediction says an actor does.

What enters: a start state and accelerations, even or changing evenly, with durations. What leaves: position, speed and
acceleration at any instant, when a place is passed, and bounds over spans. Speed is continuous by construction; it
never reverses.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, replace

STANDSTILL_MPS = 1e-6
_HALVINGS = 40


@dataclass(frozen=True, slots=True)
class Segment:
    """A stretch of evenly changing acceleration: from `start_s` on for `duration_s`, beginning with a state.

    `accel_mpss` is the acceleration at its beginning; it changes by `jerk_mpsss` each second.
    """

    start_s: float
    duration_s: float
    s_m: float
    speed_mps: float
    accel_mpss: float
    piece: int = 0
    jerk_mpsss: float = 0.0

    @property
    def end_s(self) -> float:
        """When the segment ends (s)."""
        return self.start_s + self.duration_s

    @property
    def end_speed_mps(self) -> float:
        """Speed at the end of the segment (m/s)."""
        return max(0.0, self.after(self.duration_s)[1])

    @property
    def end_s_m(self) -> float:
        """Arc length at the end of the segment (m)."""
        return self.after(self.duration_s)[0]

    def after(self, elapsed_s: float) -> tuple[float, float, float]:
        """Return position (m), speed (m/s) and acceleration (m/s^2) so long after the beginning."""
        jerk, accel = self.jerk_mpsss * elapsed_s, self.accel_mpss
        return (
            self.s_m + (self.speed_mps + (0.5 * accel + jerk / 6.0) * elapsed_s) * elapsed_s,
            self.speed_mps + (accel + 0.5 * jerk) * elapsed_s,
            accel + jerk,
        )

    def part(self, from_s: float, to_s: float) -> Segment:
        """Return the stretch between two instants within this one."""
        s_m, speed_mps, accel_mpss = self.after(from_s - self.start_s)
        return Segment(from_s, to_s - from_s, s_m, max(0.0, speed_mps), accel_mpss, self.piece, self.jerk_mpsss)


class Profile:
    """Segments one after another; before the first and after the last the speed holds.

    Parameters
    ----------
    segments
        Consecutive segments, at least one; each begins where and how fast the one before it ends.
    knot_times_s
        When the actor's knots are passed (s), by knot name.
    """

    __slots__ = ("_starts", "knot_times_s", "segments")

    def __init__(self, segments: tuple[Segment, ...], knot_times_s: dict[str, float] | None = None) -> None:
        if not segments:
            raise ValueError("a profile has at least one segment")
        self.segments = segments
        self.knot_times_s = knot_times_s or {}
        self._starts = [segment.start_s for segment in segments]

    @property
    def start_s(self) -> float:
        """When the profile begins (s)."""
        return self._starts[0]

    @property
    def end_s(self) -> float:
        """When the last segment ends (s); afterwards the speed holds."""
        return self.segments[-1].end_s

    def state(self, time_s: float) -> tuple[float, float, float]:
        """Return position (m), speed (m/s) and acceleration (m/s^2) at `time_s`, right-continuous."""
        index = bisect_right(self._starts, time_s) - 1
        if index < 0:
            first = self.segments[0]
            return first.s_m + first.speed_mps * (time_s - first.start_s), first.speed_mps, 0.0
        segment = self.segments[index]
        elapsed = time_s - segment.start_s
        if elapsed < segment.duration_s:
            position, speed, accel = segment.after(elapsed)
            return position, max(0.0, speed), accel
        speed = segment.end_speed_mps
        return segment.end_s_m + speed * (elapsed - segment.duration_s), speed, 0.0

    def time_at(self, s_m: float) -> float | None:
        """Return the first instant at which position `s_m` is reached, or None if never."""
        first, last = self.segments[0], self.segments[-1]
        if first.s_m >= s_m:
            return self.start_s if first.s_m - s_m < 1e-6 else None
        for segment in self.segments:
            if segment.end_s_m >= s_m:
                return segment.start_s + _reach(s_m, segment)
        if last.end_speed_mps <= STANDSTILL_MPS:
            return None
        return last.end_s + (s_m - self.state(last.end_s)[0]) / last.end_speed_mps

    def cut(self, time_s: float) -> Profile:
        """Return the same motion from `time_s` on, beginning with a segment that starts exactly there."""
        rest: list[Segment] = []
        for segment in self.segments:
            if segment.end_s <= time_s:
                continue
            if segment.start_s <= time_s:
                rest.append(segment.part(time_s, segment.end_s))
            else:
                rest.append(segment)
        if not rest:
            position, speed, _ = self.state(time_s)
            rest.append(Segment(time_s, 0.0, position, speed, 0.0, self.segments[-1].piece))
        return Profile(tuple(rest), self.knot_times_s)

    def until(self, time_s: float) -> list[Segment]:
        """Return the segments up to a time, of which the last may end sooner: there may be none."""
        begun = [segment for segment in self.segments if segment.start_s < time_s - 1e-9]
        return [each if each.end_s <= time_s else each.part(each.start_s, time_s) for each in begun]

    def held(self, at_s: float, for_s: float) -> Profile:
        """Return the motion with its speed at `at_s` held for `for_s` seconds; what follows comes later and further on.

        Knots at that instant and after it come later too.
        """
        position, speed, _ = self.state(at_s)
        before = [segment for segment in self.segments if segment.start_s < at_s - 1e-9]
        after = [segment for segment in self.segments if segment.start_s >= at_s - 1e-9]
        if before and before[-1].end_s > at_s + 1e-9:
            whole = before[-1]
            before[-1] = whole.part(whole.start_s, at_s)
            after.insert(0, whole.part(at_s, whole.end_s))
        piece = before[-1].piece if before else after[0].piece
        held = Segment(at_s, for_s, position, speed, 0.0, piece)
        moved = [replace(s, start_s=s.start_s + for_s, s_m=s.s_m + speed * for_s) for s in after]
        times = {knot: time_s + for_s * (time_s >= at_s - 1e-9) for knot, time_s in self.knot_times_s.items()}
        return Profile((*before, held, *moved), times)

    def accelerations(self) -> tuple[float, float]:
        """Return the smallest and largest acceleration of the whole profile (m/s^2)."""
        ends = [(0.0, segment.duration_s) for segment in self.segments]
        values = [s.after(t)[2] for s, pair in zip(self.segments, ends, strict=True) for t in pair]
        return min(values), max(values)


def chain(start_s: float, s_m: float, speed_mps: float, moves: list[tuple[float, float, int]]) -> tuple[Segment, ...]:
    """Return the segments that start with a state and carry out ``(duration_s, accel_mpss, piece)`` one after another.

    A move that would reverse stops at standstill and waits for the rest of its duration.
    """
    segments: list[Segment] = []
    for duration_s, accel, piece in moves:
        if duration_s <= 0.0:
            continue
        if accel < 0 and speed_mps + accel * duration_s < -1e-9:
            braking_s = speed_mps / -accel
            parts = [(braking_s, accel), (duration_s - braking_s, 0.0)]
        else:
            parts = [(duration_s, accel)]
        for part_s, part_accel in parts:
            if part_s <= 0.0:
                continue
            segment = Segment(start_s, part_s, s_m, speed_mps, part_accel, piece)
            segments.append(segment)
            start_s, s_m, speed_mps = segment.end_s, segment.end_s_m, segment.end_speed_mps
            if speed_mps < STANDSTILL_MPS:
                speed_mps = 0.0
    if not segments:
        segments.append(Segment(start_s, 0.0, s_m, speed_mps, 0.0, moves[-1][2] if moves else 0))
    return tuple(segments)


def _reach(s_m: float, segment: Segment) -> float:
    """Return how long after its beginning a segment is at `s_m`, which it is known to reach."""
    distance_m, speed_mps, accel_mpss = s_m - segment.s_m, segment.speed_mps, segment.accel_mpss
    if segment.jerk_mpsss:
        low, high = 0.0, segment.duration_s
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if segment.after(middle)[0] < s_m else (low, middle)
        return high
    root = math.sqrt(max(0.0, speed_mps * speed_mps + 2.0 * accel_mpss * distance_m))
    denominator = speed_mps + root
    return 2.0 * distance_m / denominator if denominator > 0.0 else 0.0
