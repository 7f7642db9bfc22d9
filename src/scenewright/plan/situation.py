"""What a plan starts from: now, the ego as it was seen and is foreseen, the heroes as they drive.

What enters: data. What leaves: the same, and a motion that is a little otherwise, to ask what an ego would make of it.
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

    Attributes
    ----------
    motion, trigger_s
        Of the hero, with which the ego was foreseen; when its trigger was to come.
    per_metre
        By how much the ego is further on (m) and faster (m/s) for each metre by which the hero is further on.
    per_mps
        Likewise for each metre a second by which the hero is faster all along, from the same place on; None where it
        is further on only by being ever faster from now on, as `per_metre` then says.
    """

    motion: Profile
    trigger_s: float
    per_metre: tuple[float, float]
    per_mps: tuple[float, float] | None = None

    def then(self, time_s: float) -> tuple[float, float, float]:
        """Return the hero's state with which the ego was foreseen, had its trigger not come."""
        late_s = time_s - self.trigger_s
        if late_s <= 0.0:
            return self.motion.state(time_s)
        s_m, speed_mps, _ = self.motion.state(self.trigger_s)
        return s_m + speed_mps * late_s, speed_mps, 0.0


@dataclass(frozen=True, slots=True)
class Lanes:
    """Heroes on the ego's lane, and what the ego makes of those ahead of it.

    Attributes
    ----------
    apart
        For each hero: 1 where it keeps ahead, -1 behind; what to add to its arc length there (m).
    answers
        For each hero that the ego follows, how.
    plainly
        Heroes whose trigger speaks of the distance: it is to change plainly there.
    behind
        Heroes that are behind it on its lane from the start on.
    """

    apart: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    answers: Mapping[int, Answer] = field(default_factory=dict)
    plainly: frozenset[int] = frozenset()
    behind: frozenset[int] = frozenset()


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
    others
        First guesses of what is neither a moment nor a state nor a rate, by its number.
    planned_s
        When triggers are to come of which both decide when they do.
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
    others: Mapping[int, float] = field(default_factory=dict)
    planned_s: Mapping[int, float] = field(default_factory=dict)
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
class Otherwise:
    """A motion that is otherwise from a time on: so much further on (m), faster (m/s), ever faster (m/s^2)."""

    motion: Profile
    from_s: float
    further_m: float = 0.0
    faster_mps: float = 0.0
    ever_faster_mpss: float = 0.0

    def state(self, time_s: float) -> tuple[float, float, float]:
        """Return place (m), speed (m/s) and acceleration (m/s^2) at a time."""
        s_m, speed_mps, accel = self.motion.state(time_s)
        since, more = max(0.0, time_s - self.from_s), self.ever_faster_mpss
        further_m = self.further_m + (self.faster_mps + 0.5 * more * since) * since
        return s_m + further_m, speed_mps + self.faster_mps + more * since, accel + more
