"""What a plan starts from: now, the ego as it was seen and is foreseen, the heroes as they drive.

What enters: data. What leaves: the same, and a motion that is a little further on, to ask what an ego would make of it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.motion.profile import Profile
from scenewright.plan.prediction import EgoSample

States = Callable[[float], tuple[float, float, float]]  # place (m), speed (m/s) and acceleration (m/s^2) at a time


@dataclass(frozen=True, slots=True)
class Drive:
    """A hero on its way: from when on it can still be planned, in which piece it is then, and its motion."""

    begin_s: float
    piece: int
    motion: Profile


@dataclass(frozen=True, slots=True)
class Answer:
    """How an ego that follows a hero answers what that does, to first order, at the hero's trigger.

    For each metre by which the hero is further on than in the motion that the ego was foreseen with, the ego is
    `place` metres further on and `speed_mps` faster.
    """

    motion: Profile
    place: float
    speed_mps: float


@dataclass(frozen=True, slots=True)
class Lanes:
    """Heroes on the ego's lane, and what the ego makes of those ahead of it.

    Attributes
    ----------
    apart
        For each hero: 1 where it keeps ahead, -1 behind; what to add to its arc length there (m).
    answers
        For each hero that the ego follows, how.
    """

    apart: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    answers: Mapping[int, Answer] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Situation:
    """All that one plan starts from; moments are numbered as the lowered program's instants are.

    Attributes
    ----------
    time_s, ego
        Now; the ego's states by time.
    knots_s
        Times of moments that are known: passed, or foreseen of the ego alone.
    expected_s
        First guesses of the times of others.
    heroes
        Those that drive already; for the others `guesses` has motions that their first plans start from.
    planned_s
        When triggers are to come of which both decide when they do.
    settled_s
        From when on a hero, as it has driven, is settled for long enough for such a trigger.
    waits
        Heroes of whose trigger the ego decides when it comes.
    sure
        Whether the ego will drive as foreseen, as its policy promises.
    """

    time_s: float
    ego: States
    knots_s: Mapping[int, float]
    expected_s: Mapping[int, float]
    heroes: Mapping[int, Drive] = field(default_factory=dict)
    guesses: Mapping[int, Profile] = field(default_factory=dict)
    planned_s: Mapping[int, float] = field(default_factory=dict)
    settled_s: Mapping[int, float] = field(default_factory=dict)
    waits: frozenset[int] = frozenset()
    sure: bool = False
    lanes: Lanes = field(default_factory=Lanes)


@dataclass(frozen=True, slots=True)
class SeenAndForeseen:
    """The ego's past, as it was seen, and from the last sample on as it is foreseen."""

    samples: Sequence[EgoSample]
    prediction: Profile

    def __call__(self, time_s: float) -> tuple[float, float, float]:
        """Return place (m), speed (m/s) and acceleration (m/s^2) at a time."""
        if time_s >= self.samples[-1][0]:
            return self.prediction.state(time_s)
        k = max(bisect_right(self.samples, time_s, key=lambda sample: sample[0]) - 1, 0)
        then_s, s_m, speed, accel = self.samples[k]
        since = time_s - then_s
        return s_m + (speed + 0.5 * accel * since) * since, speed + accel * since, accel


@dataclass(frozen=True, slots=True)
class Further:
    """A motion that is a metre further on at an instant: ever more so from a time on, or `all_along`."""

    motion: Profile
    from_s: float
    at_s: float
    all_along: bool

    def state(self, time_s: float) -> tuple[float, float, float]:
        """Return place (m), speed (m/s) and acceleration (m/s^2) at a time."""
        s_m, speed_mps, accel = self.motion.state(time_s)
        if self.all_along:
            return s_m + 1.0, speed_mps, accel
        lasts, since = max(self.at_s - self.from_s, 0.1), max(0.0, time_s - self.from_s)
        return s_m + (since / lasts) ** 2, speed_mps + 2.0 * since / lasts**2, accel + 2.0 / lasts**2
