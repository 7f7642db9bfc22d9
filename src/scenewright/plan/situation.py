"""What a plan starts from, as data: now, the ego as it was seen and is foreseen, the heroes as they drive."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.motion.profile import Profile
from scenewright.plan.foresight import Answer, Clearance
from scenewright.plan.prediction import EgoSample

States = Callable[[float], tuple[float, float, float]]  # place (m), speed (m/s) and acceleration (m/s^2) at a time


@dataclass(frozen=True, slots=True)
class Drive:
    """A hero on its way: from when on it can still be planned, in which piece it is then, and its motion."""

    begin_s: float
    piece: int
    motion: Profile


@dataclass(frozen=True, slots=True)
class Situation:
    """All that one plan starts from; moments are numbered as the lowered program's instants are.

    Of the ego: its states by time, whether it is `sure` to drive as foreseen, as its policy promises, heroes that share
    its lane, and how it answers those that it follows. Of heroes: the drives of those that drive already, motions that
    first plans of the others start from. Of moments: those that are known (passed, or foreseen of the ego alone), first
    guesses of others, when triggers are to come of which both decide, and, by hero, when those come of which the ego
    does. `others` are first guesses of what is neither a moment nor a state nor a rate, by its number.
    """

    time_s: float
    ego: States
    sure: bool
    on_lane: Mapping[int, Clearance]
    answers: Mapping[int, Answer]
    guesses: Mapping[int, Profile]
    others: Mapping[int, float]
    heroes: dict[int, Drive] = field(default_factory=dict)
    knots_s: dict[int, float] = field(default_factory=dict)
    expected_s: dict[int, float] = field(default_factory=dict)
    planned_s: dict[int, float] = field(default_factory=dict)
    triggers_s: dict[int, float] = field(default_factory=dict)


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
