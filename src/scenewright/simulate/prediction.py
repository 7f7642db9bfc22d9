"""Predicts the ego: a part that can be changed, since a trigger is met as well as the ego is foreseen.

What enters: the ego's states up to now. What leaves: a `Profile` from now on. A predictor sees only what happened; it knows
no policy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from scenewright.motion.profile import Profile, chain

# (time_s, s_m, speed_mps, accel_mpss) of one past step.
EgoSample = tuple[float, float, float, float]


class Predictor(Protocol):
    """Foresees the ego's motion along its route."""

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the motion from the last sample on; `history` is not empty and in time order."""
        ...


@dataclass(frozen=True, slots=True)
class ConstantSpeed:
    """The ego goes on as fast as it is."""

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return motion at the last speed."""
        time_s, s_m, speed_mps, _ = history[-1]
        return Profile(chain(time_s, s_m, speed_mps, [(1.0, 0.0, 0)]))


@dataclass(frozen=True, slots=True)
class ConstantAcceleration:
    """The ego keeps its acceleration for a while, then its speed; one that stops sets off again.

    Attributes
    ----------
    hold_s
        How long the acceleration lasts.
    average_s
        Over how long a past the acceleration is averaged: policies jitter.
    standstill_s
        How long one that stands goes on standing, counted anew at every moment. Nobody stands for ever: a hero that
        believed so would give up its place; and one that did not wait would creep past it.
    restart_mpss, restart_speed_mps
        How it sets off.
    """

    hold_s: float = 1.0
    average_s: float = 0.1
    standstill_s: float = 1.5
    restart_mpss: float = 1.2
    restart_speed_mps: float = 5.0

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return motion with the recent acceleration for `hold_s`, then at constant speed."""
        time_s, s_m, speed_mps, _ = history[-1]
        accel = self._recent_acceleration(history)
        moves: list[tuple[float, float, int]] = []
        end_speed = max(0.0, speed_mps + accel * self.hold_s)
        if end_speed > 0.3:
            moves.append((self.hold_s, accel, 0))
        else:
            if speed_mps > 0.05 and accel < -0.05:
                moves.append((speed_mps / -accel, accel, 0))
            moves.append((self.standstill_s, 0.0, 0))
            moves.append((self.restart_speed_mps / self.restart_mpss, self.restart_mpss, 0))
        return Profile(chain(time_s, s_m, speed_mps if speed_mps > 0.05 else 0.0, moves))

    def _recent_acceleration(self, history: Sequence[EgoSample]) -> float:
        last = history[-1][0]
        values = [sample[3] for sample in history[-12:] if sample[0] >= last - self.average_s]
        mean = sum(values) / len(values)
        return 0.0 if abs(mean) < 0.02 else max(-9.0, min(5.0, mean))
