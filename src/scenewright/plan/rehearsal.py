"""Foresees an ego that has been seen to drive: a simulation can be run again, and the last drive tells how it drives.

What enters: how the ego drove in an earlier take. What leaves: a predictor for the next one. Where the ego no longer
drives as it did, another predictor takes over: a rehearsal is a better guess, never knowledge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from scenewright.motion.profile import Profile, chain
from scenewright.plan.prediction import EgoSample, Predictor

# It is looked at so often (s) for the first seconds, and then that often: enough for what is planned again by then.
_FINE_S, _FINE_STEP_S, _COARSE_S = 4.0, 0.1, 0.4
_FINELY_S = np.arange(0.0, _FINE_S, _FINE_STEP_S)
_STANDING_MPS = 0.3
_OTHERWISE_S = 2.0  # after which one that is a little faster or slower than it was there drives as it did; chosen


@dataclass(frozen=True, slots=True)
class Rehearsed:
    """The ego soon goes on as it did when it was last where it is now.

    Attributes
    ----------
    drive
        How it drove.
    base
        What is believed of it where it is elsewhere, or faster or slower by more than `alike_mps`.
    """

    drive: Profile
    base: Predictor
    alike_mps: float = 1.0

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the rest of the drive from where the ego is, beginning with the speed that it has."""
        time_s, s_m, speed_mps, _ = history[-1]
        then_s = self._when(history)
        if then_s is None or abs(self.drive.state(then_s)[1] - speed_mps) > self.alike_mps:
            return self.base.predict(history)
        at_s = np.concatenate([_FINELY_S, np.arange(_FINE_S, self.drive.end_s - then_s, _COARSE_S)])
        then = np.array([self.drive.state(then_s + soon_s)[1] for soon_s in at_s])
        speeds = np.maximum(0.0, then + (speed_mps - then[0]) * np.maximum(0.0, 1.0 - at_s / _OTHERWISE_S))
        accels = np.diff(speeds) / np.diff(at_s)
        moves = [(lasts_s, accel, 0) for lasts_s, accel in zip(np.diff(at_s).tolist(), accels.tolist(), strict=True)]
        return Profile(chain(time_s, s_m, speed_mps, moves))

    def repeats(self, again: Profile) -> bool:
        """Whether another drive is alike all along: how one that decides anew each time drove tells nothing."""
        times_s = np.arange(0.0, self.drive.end_s, _COARSE_S).tolist()
        return all(abs(self.drive.state(t)[1] - again.state(t)[1]) <= self.alike_mps for t in times_s)

    def _when(self, history: Sequence[EgoSample]) -> float | None:
        """Return the moment of the drive that is like now: as long at this place as the ego has been by now."""
        time_s, s_m, speed_mps, _ = history[-1]
        if speed_mps >= _STANDING_MPS:
            when_s = self.drive.time_at(s_m)
            return when_s if when_s is not None and when_s <= self.drive.end_s else None
        place_m = s_m - 0.05
        came_s = next((sample[0] for sample in history if sample[1] >= place_m), time_s)
        arrived_s = self.drive.time_at(place_m)
        if arrived_s is None or arrived_s + time_s - came_s > self.drive.end_s:
            return None
        return arrived_s + time_s - came_s
